!> Values of the global stiffness in its fixed pattern.
!>
!> The pattern is the lower triangle by columns, in blocks of six freedoms a node: column c of
!> node j holds its 6 - c diagonal entries, then six rows for each higher neighbour in order.
!> So the place of a block is one number, the neighbour's `rank` in node j's list.
module assembly
   use frame, only: cross_matrix, turn_matrix
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: add_contact, add_element, add_pair, add_pair_3

contains

   !> Add the 12 by 12 of an element with tip stiffness `local`.
   pure subroutine add_element(local, axes, d, ends, rank, colptr, val)
      real(wp), intent(in) :: local(6, 6)      !! at the tip, element axes
      real(wp), intent(in) :: axes(3, 3)       !! columns ex, ey, ez, global
      real(wp), intent(in) :: d(3)             !! from end 1 to end 2 [m]
      integer(ip), intent(in) :: ends(2)       !! 0-based nodes
      integer(ip), intent(in) :: rank          !! 0-based, of the higher node at the lower one
      integer(ip), intent(in) :: colptr(:)
      real(wp), intent(inout) :: val(:)

      real(wp) :: k(6, 6), k12(6, 6), k11(6, 6), s(3, 3)

      ! v = b u1 + u2 with b = [-1, [d]; 0, -1], so K12 = b' k and K11 = b' k b
      k = turn_matrix(axes, local)
      s = cross_matrix(d)
      k12(1:3, :) = -k(1:3, :)
      k12(4:6, :) = matmul(transpose(s), k(1:3, :)) - k(4:6, :)
      k11(:, 1:3) = -k12(:, 1:3)
      k11(:, 4:6) = matmul(k12(:, 1:3), s) - k12(:, 4:6)
      call add_pair(k11, k12, k, ends, rank, colptr, val)
   end subroutine add_element

   !> Add the blocks of a symmetric 12 by 12 of two nodes.
   pure subroutine add_pair(k11, k12, k22, ends, rank, colptr, val)
      real(wp), intent(in) :: k11(6, 6), k12(6, 6), k22(6, 6)
      integer(ip), intent(in) :: ends(2), rank, colptr(:)   !! as in `add_element`
      real(wp), intent(inout) :: val(:)

      call add_diagonal(k11, ends(1), colptr, val)
      call add_diagonal(k22, ends(2), colptr, val)
      if (ends(1) > ends(2)) then
         call add_block(k12, ends(2), rank, colptr, val)
      else
         call add_block(transpose(k12), ends(1), rank, colptr, val)
      end if
   end subroutine add_pair

   !> Add a 3 by 3 contact stiffness between a node and its cnode (or ground, -1).
   pure subroutine add_contact(k, offset, node, cnode, rank, colptr, val)
      real(wp), intent(in) :: k(3, 3)
      integer(ip), intent(in) :: offset        !! 0 translations, 3 rotations
      integer(ip), intent(in) :: node, cnode, rank
      integer(ip), intent(in) :: colptr(:)
      real(wp), intent(inout) :: val(:)

      call add_diagonal_3(k, offset, node, colptr, val)
      if (cnode < 0_ip) return
      call add_diagonal_3(k, offset, cnode, colptr, val)
      call add_pair_3(-k, offset, min(node, cnode), rank, colptr, val)
   end subroutine add_contact

   pure subroutine add_diagonal(k, node, colptr, val)
      real(wp), intent(in) :: k(6, 6)
      integer(ip), intent(in) :: node, colptr(:)
      real(wp), intent(inout) :: val(:)

      integer(ip) :: c, first

      do c = 1_ip, 6_ip
         first = colptr(6_ip*node + c)
         val(first + 1_ip:first + 7_ip - c) = val(first + 1_ip:first + 7_ip - c) + k(c:6, c)
      end do
   end subroutine add_diagonal

   pure subroutine add_block(k, column, rank, colptr, val)
      real(wp), intent(in) :: k(6, 6)
      integer(ip), intent(in) :: column, rank, colptr(:)
      real(wp), intent(inout) :: val(:)

      integer(ip) :: c, first

      do c = 1_ip, 6_ip
         first = colptr(6_ip*column + c) + 7_ip - c + 6_ip*rank
         val(first + 1_ip:first + 6_ip) = val(first + 1_ip:first + 6_ip) + k(:, c)
      end do
   end subroutine add_block

   pure subroutine add_diagonal_3(k, offset, node, colptr, val)
      real(wp), intent(in) :: k(3, 3)
      integer(ip), intent(in) :: offset, node, colptr(:)
      real(wp), intent(inout) :: val(:)

      integer(ip) :: c, first

      do c = 1_ip, 3_ip
         first = colptr(6_ip*node + offset + c)
         val(first + 1_ip:first + 4_ip - c) = val(first + 1_ip:first + 4_ip - c) + k(c:3, c)
      end do
   end subroutine add_diagonal_3

   !> Add a symmetric 3 by 3 to the off-diagonal block `rank` of a column node.
   pure subroutine add_pair_3(k, offset, column, rank, colptr, val)
      real(wp), intent(in) :: k(3, 3)
      integer(ip), intent(in) :: offset, column, rank, colptr(:)
      real(wp), intent(inout) :: val(:)

      integer(ip) :: c, first

      do c = 1_ip, 3_ip
         first = colptr(6_ip*column + offset + c) + 6_ip - offset - c + 1_ip + 6_ip*rank + offset
         val(first + 1_ip:first + 3_ip) = val(first + 1_ip:first + 3_ip) + k(:, c)
      end do
   end subroutine add_pair_3

end module assembly
