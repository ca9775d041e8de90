!> The pattern of the stiffness: lower triangle by columns, in blocks of six a node.
module pattern
   use kinds, only: ip
   implicit none (type, external)
   private
   public :: pattern_columns

   integer(ip), parameter :: six = 6_ip

contains

   !> Column pointers and rows: a column of a node holds its own block from the diagonal down, then
   !> the blocks of its higher neighbours.
   pure subroutine pattern_columns(begin, higher, colptr, row)
      integer(ip), intent(in) :: begin(:)     !! (n + 1) neighbours of node i start at begin(i)
      integer(ip), intent(in) :: higher(:)    !! 0-based higher neighbours, ascending by node
      integer(ip), intent(out) :: colptr(:)   !! (6 n + 1) 0-based
      integer(ip), intent(inout) :: row(:)    !! 0-based, ascending in a column

      integer(ip) :: node, i, j, k, next

      next = 0_ip
      do node = 0_ip, size(begin, kind=ip) - 2_ip
         do i = 0_ip, six - 1_ip
            colptr(six*node + i + 1_ip) = next
            do k = i, six - 1_ip
               next = next + 1_ip
               row(next) = six*node + k
            end do
            do j = begin(node + 1_ip) + 1_ip, begin(node + 2_ip)
               do k = 0_ip, six - 1_ip
                  next = next + 1_ip
                  row(next) = six*higher(j) + k
               end do
            end do
         end do
      end do
      colptr(size(colptr)) = next
   end subroutine pattern_columns

end module pattern
