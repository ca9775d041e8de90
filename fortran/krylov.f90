!> Inner products of the iterations: summed in one order on every machine and thread count.
module krylov
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: inner, orthogonalise

contains

   !> Sum of a b, in eight interleaved parts: always the same ones.
   pure function inner(a, b) result(s)
      real(wp), intent(in) :: a(:), b(:)
      real(wp) :: s

      real(wp) :: part(8)
      integer :: i, whole

      part(:) = 0.0_wp
      whole = size(a) - mod(size(a), 8)
      do i = 1, whole, 8
         part = part + a(i:i + 7)*b(i:i + 7)
      end do
      s = sum(part)
      do i = whole + 1, size(a)
         s = s + a(i)*b(i)
      end do
   end function inner

   !> Take the first n vectors of an orthonormal basis out of w (modified Gram-Schmidt), and put
   !> what is left, at unit length, behind them.
   pure subroutine orthogonalise(n, basis, w, h)
      integer(ip), intent(in) :: n
      real(wp), intent(inout) :: basis(:, :)   !! (n_dof, most)
      real(wp), intent(in) :: w(:)
      real(wp), intent(out) :: h(:)            !! (n + 1) components, and the length of the rest

      real(wp), allocatable :: rest(:)
      integer(ip) :: i

      allocate (rest(size(w)))
      rest(:) = w
      do i = 1_ip, n
         h(i) = inner(basis(:, i), rest)
         rest(:) = rest - h(i)*basis(:, i)
      end do
      h(n + 1_ip) = sqrt(inner(rest, rest))
      if (h(n + 1_ip) > 0.0_wp) rest(:) = rest/h(n + 1_ip)
      basis(:, n + 1_ip) = rest
   end subroutine orthogonalise

end module krylov
