!> Mass of elements: consistent with their exact static shapes, or lumped at their ends.
!>
!> The shape between the ends is that of the unloaded element under its end displacements, on
!> straights and on arcs: the part before a point is a cantilever of its own under the tip force
!> moved to the point.  On a straight without shear this gives the cubics of the textbook, with
!> shear those of Przemieniecki (1968), section 11.
module mass
   use assembly, only: add_pair
   use bend, only: arc_point
   use element, only: kind_arc, kind_spring, n_form, tip_flexibility
   use frame, only: cross_matrix, turn_to_global
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: assemble_mass, consistent_mass, lumped_mass

   integer, parameter :: n_half = 5
   !> Positive half of the 10-point rule; Abramowitz and Stegun (1964), table 25.4.  Exact on
   !> straights, to rounding on arcs up to half a turn.
   real(wp), parameter :: half_node(n_half) = [ &
      & 0.1488743389816312109_wp, 0.4333953941292471908_wp, 0.6794095682990244062_wp, &
      & 0.8650633666889845107_wp, 0.9739065285171717201_wp]
   real(wp), parameter :: half_weight(n_half) = [ &
      & 0.2955242247147528702_wp, 0.2692667193099963551_wp, 0.2190863625159820440_wp, &
      & 0.1494513491505805932_wp, 0.0666713443086881376_wp]

contains

   !> Add the mass of every element to the values of the global mass matrix.
   pure subroutine assemble_mass(kind, form, rigidity, flex, k, axes, line, inertia, lumped, &
         & ends, rank, colptr, val)
      integer(ip), intent(in) :: kind(:)
      real(wp), intent(in) :: form(:, :)       !! (n_form, n) see `element`
      real(wp), intent(in) :: rigidity(:, :), flex(:)
      real(wp), intent(in) :: k(:, :, :)       !! tip stiffness, element axes
      real(wp), intent(in) :: axes(:, :, :)
      real(wp), intent(in) :: line(:)          !! mass per length of axis [kg/m]
      real(wp), intent(in) :: inertia(:, :)    !! (2, n) about the axis, across it [kg m]
      logical, intent(in) :: lumped
      integer(ip), intent(in) :: ends(:, :), rank(:), colptr(:)
      real(wp), intent(inout) :: val(:)

      real(wp) :: m(12, 12)
      integer(ip) :: i

      do i = 1_ip, size(kind, kind=ip)
         if (kind(i) == kind_spring) cycle
         if (lumped) then
            m = lumped_mass(kind(i), form(1, i), form(3, i), line(i), inertia(:, i))
         else
            m = consistent_mass(kind(i), form(:, i), rigidity(:, i), flex(i), k(:, :, i), &
               & line(i), inertia(:, i))
         end if
         m = turn_12(axes(:, :, i), m)
         call add_pair(m(1:6, 1:6), m(1:6, 7:12), m(7:12, 7:12), ends(:, i), rank(i), colptr, val)
      end do
   end subroutine assemble_mass

   !> Integral of N' m N along the axis, axes of end 1; freedoms of end 1, then of end 2.
   pure function consistent_mass(kind, form, rigidity, flex, k, line, inertia) result(m)
      integer(ip), intent(in) :: kind
      real(wp), intent(in) :: form(:), rigidity(4), flex
      real(wp), intent(in) :: k(6, 6)                 !! tip stiffness, axes of end 1
      real(wp), intent(in) :: line, inertia(2)        !! as in `assemble_mass`
      real(wp) :: m(12, 12)

      real(wp) :: n(6, 12), t(6, 6), x
      integer :: i

      m(:, :) = 0.0_wp
      do i = 1, 2*n_half
         x = abscissa(i)
         n = shape_functions(kind, form, rigidity, flex, k, x)
         t = section_mass(line, inertia, merge(x*form(3), 0.0_wp, kind == kind_arc))
         m = m + weight(i)*form(1)*matmul(transpose(n), matmul(t, n))
      end do
   end function consistent_mass

   !> Half of the mass at each end; no coupling of the ends.
   pure function lumped_mass(kind, length, angle, line, inertia) result(m)
      integer(ip), intent(in) :: kind
      real(wp), intent(in) :: length, angle, line, inertia(2)   !! as in `consistent_mass`
      real(wp) :: m(12, 12)

      m(:, :) = 0.0_wp
      m(1:6, 1:6) = 0.5_wp*length*section_mass(line, inertia, 0.0_wp)
      m(7:12, 7:12) = 0.5_wp*length &
         & *section_mass(line, inertia, merge(angle, 0.0_wp, kind == kind_arc))
   end function lumped_mass

   !> Displacements at a fraction x of the axis by those of both ends, axes of end 1.
   pure function shape_functions(kind, form, rigidity, flex, k, x) result(n)
      integer(ip), intent(in) :: kind
      real(wp), intent(in) :: form(:), rigidity(4), flex, k(6, 6), x
      real(wp) :: n(6, 12)

      real(wp) :: at(3), tip(3), carry(6, 6), g(6, 6), part(n_form)

      if (kind == kind_arc) then
         at = arc_point(form(2), x*form(3))
         tip = arc_point(form(2), form(3))
      else
         at = x*[form(1), form(4), 0.0_wp]
         tip = [form(1), form(4), 0.0_wp]
      end if
      part = [x*form(1), form(2), x*form(3), x*form(4), form(5:6), &
         & form(5:6) + x*(form(7:8) - form(5:6))]
      ! A force at the tip acts at the point with its moment; transposed, that is rigid motion.
      carry = transpose(rigid(tip - at))
      g = matmul(tip_flexibility(kind, part, rigidity, flex), &
         & matmul(carry, k))
      n(:, 1:6) = rigid(at) - matmul(g, rigid(tip))
      n(:, 7:12) = g
   end function shape_functions

   !> Displacement at x by that of the origin of a rigid body.
   pure function rigid(x) result(r)
      real(wp), intent(in) :: x(3)
      real(wp) :: r(6, 6)

      integer :: i

      r(:, :) = 0.0_wp
      do i = 1, 6
         r(i, i) = 1.0_wp
      end do
      r(1:3, 4:6) = -cross_matrix(x)
   end function rigid

   !> Mass and rotary inertia per length of a section turned by t about z.
   pure function section_mass(line, inertia, t) result(m)
      real(wp), intent(in) :: line, inertia(2), t
      real(wp) :: m(6, 6)

      real(wp) :: e(2)
      integer :: i

      m(:, :) = 0.0_wp
      do i = 1, 3
         m(i, i) = line
         m(3 + i, 3 + i) = inertia(2)
      end do
      e = [cos(t), sin(t)]
      do i = 1, 2
         m(4:5, 3 + i) = m(4:5, 3 + i) + (inertia(1) - inertia(2))*e(i)*e
      end do
   end function section_mass

   !> A symmetric 12 by 12 in element axes, in global ones; symmetric to the last bit.
   pure function turn_12(axes, local) result(m)
      real(wp), intent(in) :: axes(3, 3), local(12, 12)
      real(wp) :: m(12, 12)

      integer :: pass, j

      m = local
      do pass = 1, 2
         do j = 1, 12
            m(1:6, j) = turn_to_global(axes, m(1:6, j))
            m(7:12, j) = turn_to_global(axes, m(7:12, j))
         end do
         m = transpose(m)
      end do
      m = 0.5_wp*(m + transpose(m))
   end function turn_12

   !> Abscissa of point i of the rule on (0, 1).
   pure function abscissa(i) result(x)
      integer, intent(in) :: i
      real(wp) :: x

      if (i <= n_half) then
         x = 0.5_wp*(1.0_wp - half_node(i))
      else
         x = 0.5_wp*(1.0_wp + half_node(i - n_half))
      end if
   end function abscissa

   pure function weight(i) result(w)
      integer, intent(in) :: i
      real(wp) :: w

      w = 0.5_wp*half_weight(merge(i, i - n_half, i <= n_half))
   end function weight

end module mass
