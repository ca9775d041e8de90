!> Deformations and end forces of elements from displacements in double-double.
module recover
   use extended, only: add_dd, add_product
   use frame, only: cross, turn_to_global
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: deformation, end_forces

contains

   !> Tip deformation less the free one, in the element's axes.
   !>
   !> Rigid motion is taken out, the rest turned and the free part taken off before anything is
   !> rounded: a stiff direction must not see the round-off of a soft one.
   pure function deformation(d, axes, u1, l1, u2, l2, v0) result(v)
      real(wp), intent(in) :: d(3)           !! from end 1 to end 2 [m]
      real(wp), intent(in) :: axes(3, 3)     !! columns ex, ey, ez of end 1, global
      real(wp), intent(in) :: u1(6), l1(6)   !! displacement of end 1, high and low part
      real(wp), intent(in) :: u2(6), l2(6)
      real(wp), intent(in) :: v0(6)          !! free deformation, element axes
      real(wp) :: v(6)

      real(wp) :: g(6), g_low(6), low
      integer, parameter :: next(3) = [2, 3, 1], after(3) = [3, 1, 2]
      integer :: i, j, k

      g = u2
      g_low = l2
      call add_dd(g, g_low, -u1, -l1)
      do i = 1, 3                            ! - r1 x d
         j = next(i)
         k = after(i)
         call add_product(g(i), g_low(i), -u1(3 + j), -l1(3 + j), d(k))
         call add_product(g(i), g_low(i), u1(3 + k), l1(3 + k), d(j))
      end do
      do i = 1, 6
         j = merge(0, 3, i <= 3)
         v(i) = -v0(i)
         low = 0.0_wp
         do k = 1, 3
            call add_product(v(i), low, g(j + k), g_low(j + k), axes(k, i - j))
         end do
         v(i) = v(i) + low
      end do
   end function deformation

   !> Forces and moments on the element at both ends, global, from its deformation.
   pure function end_forces(k, axes, d, v, w) result(f)
      real(wp), intent(in) :: k(6, 6)        !! tip stiffness, element axes
      real(wp), intent(in) :: axes(3, 3), d(3)
      real(wp), intent(in) :: v(6)           !! `deformation`
      real(wp), intent(in) :: w(6)           !! load resultant: force, moment about end 1, global
      real(wp) :: f(6, 2)

      f(:, 2) = turn_to_global(axes, matmul(k, v))
      f(1:3, 1) = -f(1:3, 2) - w(1:3)
      f(4:6, 1) = -f(4:6, 2) - cross(d, f(1:3, 2)) - w(4:6)
   end function end_forces

end module recover
