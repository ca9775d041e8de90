!> The law of one support contact and of one friction slider.
!>
!> Contact: closed when pushed beyond its gap, R = -k (d - g) along the normal.  Slider: elastic
!> stick up to the capacity, then radial return in its plane (Coulomb with an elastic tangent).
!> For capacities held fixed both are gradients of convex energies; the tangents are consistent.
module support
   use extended, only: add_dd, add_product, two_prod, two_sum
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: contact_law, project, slider_law
   public :: hold_minus, hold_none, hold_plus, hold_two_way
   public :: mode_open, mode_slip, mode_stick, side_both, side_minus, side_open, side_plus

   integer(ip), parameter :: side_open = 0_ip, side_minus = -1_ip, side_plus = 1_ip
   integer(ip), parameter :: side_both = 2_ip
   !> A contact may be held closed whatever its gap: two-way by nature, or frozen on one side.
   integer(ip), parameter :: hold_none = 0_ip, hold_two_way = 1_ip
   integer(ip), parameter :: hold_plus = 2_ip, hold_minus = 3_ip
   integer(ip), parameter :: mode_open = 0_ip, mode_stick = 2_ip, mode_slip = 3_ip

contains

   !> Component of a double-double vector along `normal`.
   pure subroutine project(normal, w, low, d, d_low)
      real(wp), intent(in) :: normal(3), w(3), low(3)
      real(wp), intent(out) :: d, d_low

      integer :: i

      d = 0.0_wp
      d_low = 0.0_wp
      do i = 1, 3
         call add_product(d, d_low, w(i), low(i), normal(i))
      end do
   end subroutine project

   !> Side, reaction on the pipe and tangent of one contact at the relative displacement w.
   pure subroutine contact_law(dim, normal, gap, k, hold, w, low, side, reaction, tangent)
      integer(ip), intent(in) :: dim            !! 1, or 2: radial in a plane of two normals
      real(wp), intent(in) :: normal(3, 2), gap(2), k
      integer(ip), intent(in) :: hold
      real(wp), intent(in) :: w(3), low(3)      !! displacement relative to the base [m]
      integer(ip), intent(out) :: side
      real(wp), intent(out) :: reaction(3)
      real(wp), intent(out) :: tangent(3, 3)

      real(wp) :: d, d_low

      if (dim == 2_ip) then
         call radial_law(normal, gap(1), k, hold, w, low, side, reaction, tangent)
         return
      end if
      call project(normal(:, 1), w, low, d, d_low)
      side = side_of(d, gap, hold)
      select case (side)
      case (side_both)
         d = d + d_low
      case (side_plus)
         call add_dd(d, d_low, -gap(2), 0.0_wp)
         d = d + d_low
         if (hold == hold_none) d = max(0.0_wp, d)
      case (side_minus)
         call add_dd(d, d_low, gap(1), 0.0_wp)
         d = d + d_low
         if (hold == hold_none) d = min(0.0_wp, d)
      case default                               ! open
         d = 0.0_wp
      end select
      reaction = -k*d*normal(:, 1)
      tangent(:, :) = 0.0_wp
      if (side /= side_open) tangent = k*outer(normal(:, 1), normal(:, 1))
   end subroutine contact_law

   !> The side on which a contact is closed; an exact tie is closed and carries nothing.
   pure function side_of(d, gap, hold) result(side)
      real(wp), intent(in) :: d, gap(2)
      integer(ip), intent(in) :: hold
      integer(ip) :: side

      if (hold == hold_two_way) then
         side = side_both
      else if (hold == hold_plus .or. (hold == hold_none .and. d - gap(2) >= 0.0_wp)) then
         side = side_plus
      else if (hold == hold_minus .or. (hold == hold_none .and. d + gap(1) <= 0.0_wp)) then
         side = side_minus
      else
         side = side_open
      end if
   end function side_of

   !> A guide around a vertical pipe: the distance in its plane against a radial gap.
   pure subroutine radial_law(normal, gap, k, hold, w, low, side, reaction, tangent)
      real(wp), intent(in) :: normal(3, 2), gap, k
      integer(ip), intent(in) :: hold
      real(wp), intent(in) :: w(3), low(3)
      integer(ip), intent(out) :: side
      real(wp), intent(out) :: reaction(3), tangent(3, 3)

      real(wp) :: a, a_low, b, b_low, r, p, e, q, f, excess, dir(3), share

      call project(normal(:, 1), w, low, a, a_low)
      call project(normal(:, 2), w, low, b, b_low)
      tangent = outer(normal(:, 1), normal(:, 1)) + outer(normal(:, 2), normal(:, 2))
      if (hold == hold_two_way) then
         side = side_both
         reaction = -k*((a + a_low)*normal(:, 1) + (b + b_low)*normal(:, 2))
         tangent = k*tangent
         return
      end if
      side = side_open
      reaction(:) = 0.0_wp
      r = hypot(a, b)
      if (.not. ((r >= gap .or. hold /= hold_none) .and. r > 0.0_wp)) then
         tangent(:, :) = 0.0_wp
         return
      end if
      side = side_both
      ! r in double-double by one Newton step, so that a wide gap costs no digits
      call two_prod(a, a, p, e)
      call two_prod(b, b, q, f)
      e = e + 2.0_wp*a*a_low
      call add_dd(p, e, q, f + 2.0_wp*b*b_low)
      call two_prod(r, r, q, f)
      call add_dd(p, e, -q, -f)
      excess = (r - gap) + (p + e)/(2.0_wp*r)
      if (hold == hold_none) excess = max(0.0_wp, excess)
      dir = (a*normal(:, 1) + b*normal(:, 2))/r
      reaction = -k*excess*dir
      share = excess/r
      tangent = k*(share*tangent + (1.0_wp - share)*outer(dir, dir))
   end subroutine radial_law

   !> Friction force on the pipe, mode and tangent of one slider of fixed capacity.
   pure subroutine slider_law(basis, kf, capacity, s, mode, friction, tangent)
      real(wp), intent(in) :: basis(3, 2)   !! directions of sliding, the second zero on a line
      real(wp), intent(in) :: kf            !! stick stiffness [N/m]
      real(wp), intent(in) :: capacity      !! mu N [N]
      real(wp), intent(in) :: s(3)          !! travel since the datum, in the plane [m]
      integer(ip), intent(out) :: mode
      real(wp), intent(out) :: friction(3), tangent(3, 3)

      real(wp) :: length, t(3)

      length = sqrt(dot_product(s, s))
      tangent = outer(basis(:, 1), basis(:, 1)) + outer(basis(:, 2), basis(:, 2))
      if (capacity <= 0.0_wp) then
         mode = mode_open
         friction(:) = 0.0_wp
         tangent(:, :) = 0.0_wp
      else if (kf*length <= capacity) then
         mode = mode_stick
         friction = -kf*s
         tangent = kf*tangent
      else
         mode = mode_slip
         t = s/length
         friction = -capacity*t
         tangent = (capacity/length)*(tangent - outer(t, t))
      end if
   end subroutine slider_law

   pure function outer(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3, 3)

      integer :: j

      do j = 1, 3
         c(:, j) = a*b(j)
      end do
   end function outer

end module support
