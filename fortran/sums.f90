!> Weighted sums of whole arrays: many load cases from a few answers, each entry read once.
module sums
   use extended, only: add_dd, split
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: weighted_sums, weighted_sums_dd

   integer(ip), parameter :: block = 256_ip   !! entries that stay in the nearest cache

contains

   !> Every sum of rows, in the order of the rows.
   pure subroutine weighted_sums(weight, row, total)
      real(wp), intent(in) :: weight(:, :)      !! (n_row, n_sum)
      real(wp), intent(in) :: row(:, :)         !! (n, n_row)
      real(wp), intent(out) :: total(:, :)      !! (n, n_sum)

      integer(ip) :: a, b, i, j

      do a = 1_ip, size(row, 1, ip), block
         b = min(a + block - 1_ip, size(row, 1, ip))
         do j = 1_ip, size(weight, 2, ip)
            total(a:b, j) = weight(1, j)*row(a:b, 1)
            do i = 2_ip, size(weight, 1, ip)
               total(a:b, j) = total(a:b, j) + weight(i, j)*row(a:b, i)
            end do
         end do
      end do
   end subroutine weighted_sums

   !> The same in double-double: products and sums as in `extended`, but no number is split twice.
   pure subroutine weighted_sums_dd(weight, row, row_low, total, total_low)
      real(wp), intent(in) :: weight(:, :)
      real(wp), intent(in) :: row(:, :), row_low(:, :)
      real(wp), intent(out) :: total(:, :), total_low(:, :)

      real(wp) :: first(block, size(row, 2)), rest(block, size(row, 2)), hi(block), lo(block)
      integer(ip) :: a, b, i, j, n

      do a = 1_ip, size(row, 1, ip), block
         b = min(a + block - 1_ip, size(row, 1, ip))
         n = b - a + 1_ip
         call split(row(a:b, :), first(:n, :), rest(:n, :))
         do j = 1_ip, size(weight, 2, ip)
            hi(:) = 0.0_wp
            lo(:) = 0.0_wp
            do i = 1_ip, size(weight, 1, ip)
               call add_products(n, weight(i, j), row(a:b, i), first(:, i), rest(:, i), &
                  & row_low(a:b, i), hi, lo)
            end do
            total(a:b, j) = hi(:n)
            total_low(a:b, j) = lo(:n)
         end do
      end do
   end subroutine weighted_sums_dd

   !> (hi, lo) <- (hi, lo) + w (x, x_low), where x = first + rest.
   pure subroutine add_products(n, w, x, first, rest, x_low, hi, lo)
      integer(ip), intent(in) :: n
      real(wp), intent(in) :: w, x(n), first(n), rest(n), x_low(n)
      real(wp), intent(inout) :: hi(n), lo(n)

      real(wp) :: p, e, w1, w2
      integer(ip) :: i

      call split(w, w1, w2)
      do i = 1_ip, n
         p = w*x(i)
         e = ((w1*first(i) - p) + w1*rest(i) + w2*first(i)) + w2*rest(i)
         call add_dd(hi(i), lo(i), p, e + w*x_low(i))
      end do
   end subroutine add_products

end module sums
