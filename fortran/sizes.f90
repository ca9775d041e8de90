!> Largest movements and forces: what changes are measured against.  A NaN is the largest of all.
module sizes
   use contacts, only: at_offset
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: largest_forces, largest_move

contains

   !> Largest of (6, n) displacements; a rotation counts with what it moves over `reach`.
   pure function largest_move(p, reach) result(size)
      real(wp), intent(in) :: p(:, :), reach
      real(wp) :: size

      integer :: i, j

      size = 0.0_wp
      do j = 1, ubound(p, 2)
         do i = 1, 3
            size = larger(size, abs(p(i, j)))
            size = larger(size, reach*abs(p(3 + i, j)))
         end do
      end do
   end function largest_move

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
   pure function larger(a, b) result(c)
      real(wp), intent(in) :: a, b
      real(wp) :: c

      c = merge(b, a, b > a .or. b /= b)
      if (a /= a) c = a
   end function larger

end module sizes
