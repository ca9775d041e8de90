!> Deformations and end forces of elements from displacements in double-double.
module recover
   use extended, only: add_dd, add_product
   use frame, only: cross
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: deformation, end_forces

contains

   !> Tip deformation less the free one: rigid motion is taken out before anything is rounded.
   pure function deformation(d, u1, l1, u2, l2, v0) result(v)
      real(wp), intent(in) :: d(3)           !! from end 1 to end 2 [m]
      real(wp), intent(in) :: u1(6), l1(6)   !! displacement of end 1, high and low part
      real(wp), intent(in) :: u2(6), l2(6)
      real(wp), intent(in) :: v0(6)          !! free deformation, global
      real(wp) :: v(6)

      real(wp) :: low(6)
      integer, parameter :: next(3) = [2, 3, 1], after(3) = [3, 1, 2]
      integer :: i, j, k

      v = u2
      low = l2
      call add_dd(v, low, -u1, -l1)
      do i = 1, 3                            ! - r1 x d
         j = next(i)
         k = after(i)
         call add_product(v(i), low(i), -u1(3 + j), -l1(3 + j), d(k))
         call add_product(v(i), low(i), u1(3 + k), l1(3 + k), d(j))
      end do
      call add_dd(v, low, -v0, 0.0_wp)
      v = v + low
   end function deformation

   !> Forces and moments on the element at both ends, global, from its deformation.
   pure function end_forces(k, d, v, w) result(f)
      real(wp), intent(in) :: k(6, 6)   !! tip stiffness, global
      real(wp), intent(in) :: d(3)
      real(wp), intent(in) :: v(6)      !! `deformation`
      real(wp), intent(in) :: w(6)      !! load resultant: force, moment about end 1
      real(wp) :: f(6, 2)

      f(:, 2) = matmul(k, v)
      f(1:3, 1) = -f(1:3, 2) - w(1:3)
      f(4:6, 1) = -f(4:6, 2) - cross(d, f(1:3, 2)) - w(4:6)
   end function end_forces

end module recover
