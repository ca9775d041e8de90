!> Exact line search on the convex energy of fixed capacities.
module search
   use contacts, only: at_dim, at_hold, in_plane, rate, relative
   use kinds, only: ip, wp
   use support, only: hold_minus, hold_none, hold_plus, hold_two_way, project
   implicit none (type, external)
   private
   public :: line_search

   integer, parameter :: n_try = 60
   real(wp), parameter :: good = 1.0e-2_wp   !! slope left, of the slope at the start

contains

   !> Step length at which the energy's slope along p vanishes (or has nearly done so).
   !>
   !> The slope starts at -work(1), the out-of-balance force times p, and grows because the
   !> energy is convex: by the part of p'Kp = work(2) that never changes, and by the work of
   !> the contacts and sliders that may change.  Their displacements are taken along the line
   !> once, in double-double, so that a trial costs a few operations and is sharp to the last
   !> digits.
   pure subroutine line_search(at, normal, gap, k, base, slider_at, basis, kf, capacity, &
         & slider_base, datum, u, low, p, work, step, slope)
      integer(ip), intent(in) :: at(:, :), slider_at(:, :)
      real(wp), intent(in) :: normal(:, :, :), gap(:, :), k(:), base(:, :)
      real(wp), intent(in) :: basis(:, :, :), kf(:), capacity(:), slider_base(:, :), datum(:, :)
      real(wp), intent(in) :: u(:, :), low(:, :), p(:, :), work(2)
      real(wp), intent(out) :: step
      real(wp), intent(out) :: slope(2)         !! at 0 and at the step

      real(wp), allocatable :: c(:, :), t(:, :)   ! along p: components and their rates
      real(wp) :: a, b, fa, fb, f, start, linear
      integer :: i

      allocate (c(6, size(k)), t(4, size(kf)))
      call contact_lines(at, normal, base, u, low, p, c)
      call slider_lines(slider_at, basis, slider_base, datum, u, low, p, t)
      linear = work(2)
      start = 0.0_wp
      call pass(0.0_wp, start, linear)
      slope(1) = -work(1)
      step = 1.0_wp
      f = slope_at(step)
      slope(2) = f
      if (.not. slope(1) < 0.0_wp) return
      if (abs(f) <= good*abs(slope(1))) return
      a = 0.0_wp
      fa = slope(1)
      b = 1.0_wp
      fb = f
      do i = 1, n_try                            ! bracket: the energy may fall beyond 1
         if (fb > 0.0_wp) exit
         a = b
         fa = fb
         b = 2.0_wp*b
         fb = slope_at(b)
      end do
      do i = 1, n_try                            ! Illinois variant of the false position
         step = a - fa*(b - a)/(fb - fa)
         if (.not. (step > a .and. step < b)) step = 0.5_wp*(a + b)
         f = slope_at(step)
         if (abs(f) <= good*abs(slope(1)) .or. b - a <= epsilon(b)*b) exit
         if (f < 0.0_wp) then
            a = step
            fa = f
            fb = 0.5_wp*fb
         else
            b = step
            fb = f
            fa = 0.5_wp*fa
         end if
      end do
      slope(2) = f

   contains

      pure function slope_at(s) result(g)
         real(wp), intent(in) :: s
         real(wp) :: g

         real(wp) :: force_work, dummy

         force_work = 0.0_wp
         dummy = 0.0_wp
         call pass(s, force_work, dummy)
         g = slope(1) + s*linear + (start - force_work)
      end function slope_at

      !> Add the work of the changing forces at u + s p, and take off that of their tangents.
      pure subroutine pass(s, force_work, tangent_work)
         real(wp), intent(in) :: s
         real(wp), intent(inout) :: force_work, tangent_work

         real(wp) :: slope_part, stiffness
         integer(ip) :: j

         do j = 1_ip, size(k, kind=ip)
            if (at(at_hold, j) == hold_two_way) cycle
            call contact_work(at(at_dim, j), gap(:, j), k(j), at(at_hold, j), c(:, j), s, &
               & slope_part, stiffness)
            force_work = force_work + slope_part
            tangent_work = tangent_work - stiffness
         end do
         do j = 1_ip, size(kf, kind=ip)
            call slider_work(kf(j), capacity(j), t(:, j), s, slope_part, stiffness)
            force_work = force_work + slope_part
            tangent_work = tangent_work - stiffness
         end do
      end subroutine pass

   end subroutine line_search

   !> Components of every contact's displacement along its normals: high, low, rate, twice.
   pure subroutine contact_lines(at, normal, base, u, low, p, c)
      integer(ip), intent(in) :: at(:, :)
      real(wp), intent(in) :: normal(:, :, :), base(:, :), u(:, :), low(:, :), p(:, :)
      real(wp), intent(out) :: c(:, :)

      real(wp) :: w(3), w_low(3), dw(3)
      integer(ip) :: j

      do j = 1_ip, size(c, 2, ip)
         call relative(at(:, j), base(:, j), u, low, w, w_low)
         call rate(at(:, j), p, dw)
         call project(normal(:, 1, j), w, w_low, c(1, j), c(2, j))
         call project(normal(:, 2, j), w, w_low, c(4, j), c(5, j))
         c(3, j) = dot_product(normal(:, 1, j), dw)
         c(6, j) = dot_product(normal(:, 2, j), dw)
      end do
   end subroutine contact_lines

   !> Travel of every slider in its plane: two components, two rates.
   pure subroutine slider_lines(at, basis, base, datum, u, low, p, t)
      integer(ip), intent(in) :: at(:, :)
      real(wp), intent(in) :: basis(:, :, :), base(:, :), datum(:, :), u(:, :), low(:, :), p(:, :)
      real(wp), intent(out) :: t(:, :)

      real(wp) :: w(3), w_low(3), dw(3), s(3)
      integer(ip) :: j

      do j = 1_ip, size(t, 2, ip)
         call relative(at(:, j), base(:, j), u, low, w, w_low)
         call rate(at(:, j), p, dw)
         s = in_plane(basis(:, :, j), w, w_low, datum(:, j))
         t(1:2, j) = matmul(s, basis(:, :, j))
         t(3:4, j) = matmul(dw, basis(:, :, j))
      end do
   end subroutine slider_lines

   !> Work rate of a contact's force along the line, and of its tangent; the law of `support`.
   pure subroutine contact_work(dim, gap, k, hold, c, s, work, stiffness)
      integer(ip), intent(in) :: dim, hold
      real(wp), intent(in) :: gap(2), k, c(6), s
      real(wp), intent(out) :: work, stiffness

      real(wp) :: x, a, b, r, along, excess

      work = 0.0_wp
      stiffness = 0.0_wp
      if (dim == 2_ip) then
         a = c(1) + (c(2) + s*c(3))
         b = c(4) + (c(5) + s*c(6))
         r = hypot(a, b)
         if (.not. ((r >= gap(1) .or. hold /= hold_none) .and. r > 0.0_wp)) return
         excess = r - gap(1)
         along = (a*c(3) + b*c(6))/r
         work = -k*excess*along
         stiffness = k*(along**2 + (excess/r)*(c(3)**2 + c(6)**2 - along**2))
         return
      end if
      if (hold == hold_plus .or. hold == hold_none) then
         x = (c(1) - gap(2)) + (c(2) + s*c(3))
         if (hold == hold_plus .or. x >= 0.0_wp) then
            work = -k*x*c(3)
            stiffness = k*c(3)**2
            return
         end if
      end if
      x = (c(1) + gap(1)) + (c(2) + s*c(3))
      if (hold == hold_minus .or. (hold == hold_none .and. x <= 0.0_wp)) then
         work = -k*x*c(3)
         stiffness = k*c(3)**2
      end if
   end subroutine contact_work

   !> Work rate of a friction force along the line, and of its tangent; the law of `support`.
   pure subroutine slider_work(kf, capacity, t, s, work, stiffness)
      real(wp), intent(in) :: kf, capacity, t(4), s
      real(wp), intent(out) :: work, stiffness

      real(wp) :: a, b, r, along, whole

      work = 0.0_wp
      stiffness = 0.0_wp
      if (capacity <= 0.0_wp) return
      a = t(1) + s*t(3)
      b = t(2) + s*t(4)
      r = hypot(a, b)
      along = a*t(3) + b*t(4)
      whole = t(3)**2 + t(4)**2
      if (kf*r <= capacity) then
         work = -kf*along
         stiffness = kf*whole
      else
         work = -(capacity/r)*along
         stiffness = (capacity/r)*(whole - (along/r)**2)
      end if
   end subroutine slider_work

end module search
