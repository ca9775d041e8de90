!> Largest movements and forces: what changes are measured against.  A NaN is the largest of all.
module sizes
   use contacts, only: at_offset
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: largest_forces, largest_moves

contains

   !> Largest translation and rotation.
   pure subroutine largest_moves(p, length, angle)
      real(wp), intent(in) :: p(:, :)         !! (6, n)
      real(wp), intent(out) :: length, angle

      real(wp) :: most(6)
      integer :: i, j

      most(:) = 0.0_wp
      do j = 1, ubound(p, 2)
         do i = 1, 6
            most(i) = larger(most(i), abs(p(i, j)))
         end do
      end do
      length = larger(larger(most(1), most(2)), most(3))
      angle = larger(larger(most(4), most(5)), most(6))
   end subroutine largest_moves

   !> Largest component of forces and of moments of contacts.
   pure subroutine largest_forces(at, a, force, moment)
      integer(ip), intent(in) :: at(:, :)
      real(wp), intent(in) :: a(:, :)
      real(wp), intent(out) :: force, moment

      integer :: i, j

      force = 0.0_wp
      moment = 0.0_wp
      do j = 1, ubound(a, 2)
         do i = 1, 3
            if (at(at_offset, j) == 0_ip) then
               force = larger(force, abs(a(i, j)))
            else
               moment = larger(moment, abs(a(i, j)))
            end if
         end do
      end do
   end subroutine largest_forces

   !> The larger of two, or the one that is no number.
   elemental function larger(a, b) result(c)
      real(wp), intent(in) :: a, b
      real(wp) :: c

      c = merge(a, b, a >= b .or. .not. a <= a)
   end function larger

end module sizes
