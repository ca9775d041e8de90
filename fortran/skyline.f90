!> A symmetric factor in double-double, for stiffnesses that doubles cannot solve.
!>
!> Where a 1 mm stub of steel stands beside a kilometre of soft pipe, the stiffness has a condition
!> number above 1e16 and no factor in doubles has a correct digit.  This one carries 32 digits: the
!> matrix is summed from the members' double stiffnesses without rounding to doubles in between, and
!> factored as L D L' (Jennings 1966, rows inside their envelope).  It is slow, some ten
!> nanoseconds an operation, and only called for where the fast factor has failed.
module skyline
   use extended, only: add_dd, add_product, multiply_dd, divide_dd
   use frame, only: cross_matrix
   use kinds, only: ip, wp
   use status_codes, only: status_not_spd, status_ok
   implicit none (type, external)
   private
   public :: skyline_contacts, skyline_factorise, skyline_members, skyline_solve

contains

   !> Add the members' stiffnesses to the envelope.
   pure subroutine skyline_members(k, axes, d, ends, place, first, hi, lo)
      real(wp), intent(in) :: k(:, :, :), axes(:, :, :), d(:, :)   !! see `assemble_elements`
      integer(ip), intent(in) :: ends(:, :)
      integer(ip), intent(in) :: place(:)              !! (n_node) position in the elimination
      integer(ip), intent(in) :: first(:)              !! (n_dof + 1) 0-based start of each row
      real(wp), intent(inout) :: hi(:), lo(:)

      real(wp) :: b(6, 12), kb(6, 12), b_low(6, 12), kb_low(6, 12), x, x_low
      integer(ip) :: node(2), row, column
      integer :: e, i, j, m

      do e = 1, size(k, 3)
         call strains(axes(:, :, e), d(:, e), b, b_low)
         do j = 1, 12
            do i = 1, 6
               kb(i, j) = 0.0_wp
               kb_low(i, j) = 0.0_wp
               do m = 1, 6
                  call add_product(kb(i, j), kb_low(i, j), b(m, j), b_low(m, j), k(i, m, e))
               end do
            end do
         end do
         node = place(ends(:, e) + 1_ip)
         do j = 1, 12
            column = 6_ip*node(merge(1, 2, j <= 6)) + int(mod(j - 1, 6), ip)
            do i = 1, 12
               row = 6_ip*node(merge(1, 2, i <= 6)) + int(mod(i - 1, 6), ip)
               if (row < column) cycle
               do m = 1, 6
                  call multiply_dd(b(m, i), b_low(m, i), kb(m, j), kb_low(m, j), x, x_low)
                  call add_at(row, column, x, x_low, first, hi, lo)
               end do
            end do
         end do
      end do
   end subroutine skyline_members

   !> Deformation of the tip for the displacements of both ends: v = b u, member's axes.
   pure subroutine strains(axes, d, b, b_low)
      real(wp), intent(in) :: axes(3, 3), d(3)
      real(wp), intent(out) :: b(6, 12), b_low(6, 12)

      real(wp) :: s(3, 3)
      integer :: i, j, m

      b(:, :) = 0.0_wp
      b_low(:, :) = 0.0_wp
      s = cross_matrix(d)                    ! - r1 x d = [d] r1
      b(1:3, 7:9) = transpose(axes)
      b(1:3, 1:3) = -b(1:3, 7:9)
      b(4:6, 10:12) = b(1:3, 7:9)
      b(4:6, 4:6) = -b(1:3, 7:9)
      do j = 1, 3
         do i = 1, 3
            do m = 1, 3
               call add_product(b(i, 3 + j), b_low(i, 3 + j), axes(m, i), 0.0_wp, s(m, j))
            end do
         end do
      end do
   end subroutine strains

   !> Add contact or slider tangents to the envelope, changing and fixed ones.
   pure subroutine skyline_contacts(at, tangent, place, first, hi, lo)
      integer(ip), intent(in) :: at(:, :)              !! see `contacts`
      real(wp), intent(in) :: tangent(:, :, :)
      integer(ip), intent(in) :: place(:), first(:)
      real(wp), intent(inout) :: hi(:), lo(:)

      integer(ip) :: a, b, i, j
      integer :: c

      do c = 1, size(at, 2)
         a = 6_ip*place(at(1, c) + 1_ip) + at(4, c)
         b = -1_ip
         if (at(2, c) >= 0_ip) b = 6_ip*place(at(2, c) + 1_ip) + at(4, c)
         do j = 0_ip, 2_ip
            do i = 0_ip, 2_ip
               if (i >= j) then
                  call add_at(a + i, a + j, tangent(i + 1, j + 1, c), 0.0_wp, first, hi, lo)
               end if
               if (b < 0_ip) cycle
               if (i >= j) then
                  call add_at(b + i, b + j, tangent(i + 1, j + 1, c), 0.0_wp, first, hi, lo)
               end if
               call add_at(max(a, b) + i, min(a, b) + j, -tangent(i + 1, j + 1, c), 0.0_wp, &
                  & first, hi, lo)
            end do
         end do
      end do
   end subroutine skyline_contacts

   pure subroutine add_at(row, column, x, x_low, first, hi, lo)
      integer(ip), intent(in) :: row, column           !! 0-based, row >= column
      real(wp), intent(in) :: x, x_low
      integer(ip), intent(in) :: first(:)
      real(wp), intent(inout) :: hi(:), lo(:)

      integer(ip) :: i

      i = first(row + 2_ip) - (row - column)
      call add_dd(hi(i), lo(i), x, x_low)
   end subroutine add_at

   !> L D L' in place.  `least` is the smallest pivot relative to its diagonal; a pivot that is not
   !> positive gives `status_not_spd` and its 0-based freedom.
   pure subroutine skyline_factorise(first, hi, lo, least, status, info)
      integer(ip), intent(in) :: first(:)
      real(wp), intent(inout) :: hi(:), lo(:)
      real(wp), intent(out) :: least
      integer(ip), intent(out) :: status, info

      real(wp) :: x, x_low, diagonal
      integer(ip) :: i, j, from, n, at_i, at_j, own

      n = size(first, kind=ip) - 1_ip
      status = status_not_spd
      info = -1_ip
      least = 1.0_wp
      do i = 1_ip, n
         own = i - (first(i + 1_ip) - first(i))        ! columns before the row's first
         at_i = first(i) - own                         ! entry (i, j) is at_i + j
         diagonal = hi(first(i + 1_ip))
         do j = own + 1_ip, i - 1_ip
            at_j = first(j + 1_ip) - j
            from = max(own, j - (first(j + 1_ip) - first(j))) + 1_ip
            call subtract_products(hi(at_i + from:at_i + j - 1_ip), &
               & lo(at_i + from:at_i + j - 1_ip), hi(at_j + from:at_j + j - 1_ip), &
               & lo(at_j + from:at_j + j - 1_ip), &
               & hi(at_i + j), lo(at_i + j))
         end do
         do j = own + 1_ip, i - 1_ip
            at_j = first(j + 1_ip)
            call divide_dd(hi(at_i + j), lo(at_i + j), hi(at_j), lo(at_j), x, x_low)
            call subtract_products([hi(at_i + j)], [lo(at_i + j)], [x], [x_low], &
               & hi(at_i + i), lo(at_i + i))
            hi(at_i + j) = x
            lo(at_i + j) = x_low
         end do
         if (.not. hi(at_i + i) > 0.0_wp) then
            info = i - 1_ip
            return
         end if
         least = min(least, hi(at_i + i)/diagonal)
      end do
      status = status_ok
   end subroutine skyline_factorise

   !> s - sum of a b.
   pure subroutine subtract_products(a, a_low, b, b_low, s, s_low)
      real(wp), intent(in) :: a(:), a_low(:), b(:), b_low(:)
      real(wp), intent(inout) :: s, s_low

      real(wp) :: p, p_low
      integer :: i

      do i = 1, size(a)
         call multiply_dd(a(i), a_low(i), b(i), b_low(i), p, p_low)
         call add_dd(s, s_low, -p, -p_low)
      end do
   end subroutine subtract_products

   !> Solve for right-hand sides b in the order of the nodes; x is rounded at the very end.
   pure subroutine skyline_solve(place, first, hi, lo, b, x)
      integer(ip), intent(in) :: place(:), first(:)
      real(wp), intent(in) :: hi(:), lo(:)
      real(wp), intent(in) :: b(:, :)                  !! (n_dof, n_rhs)
      real(wp), intent(out) :: x(:, :)

      real(wp), allocatable :: y(:), y_low(:)
      real(wp) :: p, p_low
      integer(ip) :: i, j, n, own, at_i, node, c
      integer :: rhs

      n = size(first, kind=ip) - 1_ip
      allocate (y(n), y_low(n))
      do rhs = 1, size(b, 2)
         do node = 1_ip, size(place, kind=ip)
            do c = 1_ip, 6_ip
               y(6_ip*place(node) + c) = b(6_ip*(node - 1_ip) + c, rhs)
            end do
         end do
         y_low(:) = 0.0_wp
         do i = 1_ip, n
            own = i - (first(i + 1_ip) - first(i))
            at_i = first(i) - own
            call subtract_products(hi(at_i + own + 1_ip:at_i + i - 1_ip), &
               & lo(at_i + own + 1_ip:at_i + i - 1_ip), y(own + 1_ip:i - 1_ip), &
               & y_low(own + 1_ip:i - 1_ip), y(i), y_low(i))
         end do
         do i = 1_ip, n
            call divide_dd(y(i), y_low(i), hi(first(i + 1_ip)), lo(first(i + 1_ip)), p, p_low)
            y(i) = p
            y_low(i) = p_low
         end do
         do i = n, 1_ip, -1_ip
            own = i - (first(i + 1_ip) - first(i))
            at_i = first(i) - own
            do j = own + 1_ip, i - 1_ip
               call multiply_dd(hi(at_i + j), lo(at_i + j), y(i), y_low(i), p, p_low)
               call add_dd(y(j), y_low(j), -p, -p_low)
            end do
         end do
         do node = 1_ip, size(place, kind=ip)
            do c = 1_ip, 6_ip
               i = 6_ip*place(node) + c
               x(6_ip*(node - 1_ip) + c, rhs) = y(i) + y_low(i)
            end do
         end do
      end do
   end subroutine skyline_solve

end module skyline
