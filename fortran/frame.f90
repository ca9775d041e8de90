!> Vectors and the turning of element quantities between local and global axes.
module frame
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: cross, cross_matrix, turn_matrix, turn_to_global, turn_to_local

contains

   pure function cross(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)

      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

   !> The matrix that takes b to a x b.
   pure function cross_matrix(a) result(m)
      real(wp), intent(in) :: a(3)
      real(wp) :: m(3, 3)

      m(:, 1) = [0.0_wp, a(3), -a(2)]
      m(:, 2) = [-a(3), 0.0_wp, a(1)]
      m(:, 3) = [a(2), -a(1), 0.0_wp]
   end function cross_matrix

   !> A vector pair (translations or forces, rotations or moments) from local to global axes.
   pure function turn_to_global(axes, v) result(g)
      real(wp), intent(in) :: axes(3, 3)   !! columns ex, ey, ez
      real(wp), intent(in) :: v(6)
      real(wp) :: g(6)

      g(1:3) = matmul(axes, v(1:3))
      g(4:6) = matmul(axes, v(4:6))
   end function turn_to_global

   pure function turn_to_local(axes, g) result(v)
      real(wp), intent(in) :: axes(3, 3), g(6)
      real(wp) :: v(6)

      v(1:3) = matmul(g(1:3), axes)
      v(4:6) = matmul(g(4:6), axes)
   end function turn_to_local

   !> A symmetric 6 by 6 in local axes, in global ones; symmetric to the last bit.
   pure function turn_matrix(axes, local) result(k)
      real(wp), intent(in) :: axes(3, 3), local(6, 6)
      real(wp) :: k(6, 6)

      real(wp) :: t(6, 6)
      integer :: i, j

      do j = 1, 6
         t(:, j) = turn_to_global(axes, local(:, j))
      end do
      do i = 1, 6
         k(i, :) = turn_to_global(axes, t(i, :))
      end do
      do j = 1, 5
         do i = j + 1, 6
            k(i, j) = 0.5_wp*(k(i, j) + k(j, i))
            k(j, i) = k(i, j)
         end do
      end do
   end function turn_matrix

end module frame
