!> Chains of elements: which runs of the model hang together with nothing on the way.
module links
   use kinds, only: ip, wp
   implicit none (type, external)
   private
   public :: keep_uneven, link_chains

   integer(ip), parameter :: cut = 2_ip   !! mark of a node kept because a chain was long

contains

   !> Keep the nodes where a soft element meets a stiff one: their sum would keep few digits of it.
   pure subroutine keep_uneven(ends, joins, ei, length, apart, keep)
      integer(ip), intent(in) :: ends(:, :), joins(:)   !! see `link_chains`
      real(wp), intent(in) :: ei(:), length(:)          !! [N m2], [m]
      real(wp), intent(in) :: apart                     !! ratio of EI/L**3 that is too large
      integer(ip), intent(inout) :: keep(:)

      real(wp), allocatable :: least(:), most(:)
      real(wp) :: stiff
      integer(ip) :: i, j, node

      allocate (least(size(keep)), most(size(keep)))
      least(:) = huge(stiff)
      most(:) = 0.0_wp
      do i = 1_ip, size(joins, kind=ip)
         if (joins(i) == 0_ip) cycle
         stiff = ei(i)/length(i)**3
         do j = 1_ip, 2_ip
            node = ends(j, i) + 1_ip
            least(node) = min(least(node), stiff)
            most(node) = max(most(node), stiff)
         end do
      end do
      where (most/apart > least) keep = 1_ip
   end subroutine keep_uneven

   !> Order the elements into chains from kept node to kept node.
   !>
   !> A node is inside a chain when just two elements meet there, both may join, and `keep` does
   !> not hold it.  Rings and runs of more than `limit` elements are cut at further kept nodes,
   !> so that a chain has two different ends.  A chain of one element runs from its end 1 to its
   !> end 2.
   pure subroutine link_chains(ends, joins, limit, keep, n_chain, first, element, flip, far)
      integer(ip), intent(in) :: ends(:, :)     !! (2, n_elem) 0-based nodes
      integer(ip), intent(in) :: joins(:)       !! (n_elem) 1 where an element may join
      integer(ip), intent(in) :: limit          !! most elements of a chain
      integer(ip), intent(inout) :: keep(:)     !! (n_node) 1 where a node stays
      integer(ip), intent(out) :: n_chain
      integer(ip), intent(out) :: first(:)      !! (n_elem + 1) members of chain c start here
      integer(ip), intent(out) :: element(:)    !! (n_elem) 0-based, chain after chain
      integer(ip), intent(out) :: flip(:)       !! (n_elem) 1 where a member runs from end 2 to 1
      integer(ip), intent(out) :: far(:)        !! (n_elem) 0-based node at a member's far end

      logical, allocatable :: done(:)
      integer(ip), allocatable :: meeting(:, :)
      integer(ip) :: i, e, node, n

      allocate (done(size(joins)), meeting(2, size(keep)))
      call meet(ends, joins, keep, meeting)
      done(:) = .false.
      first(:) = 0_ip
      n_chain = 0_ip
      n = 0_ip
      do i = 1_ip, size(joins, kind=ip)
         if (done(i)) cycle
         call back_to_kept(i, ends, meeting, keep, e, node)
         run: do
            call one_chain(ends, meeting, limit, keep, done, e, node, n, n_chain, first, element, &
               & flip, far)
            if (keep(node) /= cut) exit run
            keep(node) = 1_ip                   ! the run goes on behind the cut
            e = meeting(1, node) + meeting(2, node) - e
         end do run
      end do
   end subroutine link_chains

   !> Collect a chain from its first element `e` and node; leaves its last element and node.
   pure subroutine one_chain(ends, meeting, limit, keep, done, e, node, n, n_chain, first, &
         & element, flip, far)
      integer(ip), intent(in) :: ends(:, :), meeting(:, :), limit
      integer(ip), intent(inout) :: keep(:)
      logical, intent(inout) :: done(:)
      integer(ip), intent(inout) :: e, node, n, n_chain
      integer(ip), intent(inout) :: first(:), element(:), flip(:), far(:)

      integer(ip) :: start, base, middle

      start = n
      base = node
      do
         done(e) = .true.
         n = n + 1_ip
         element(n) = e - 1_ip
         flip(n) = merge(0_ip, 1_ip, ends(1, e) + 1_ip == node)
         node = opposite(ends, e, node)
         far(n) = node - 1_ip
         if (keep(node) /= 0_ip) exit
         if (n - start == limit) then
            keep(node) = cut
            exit
         end if
         e = meeting(1, node) + meeting(2, node) - e
      end do
      if (node == base .and. n - start > 1_ip) then      ! a ring on one node
         middle = start + (n - start)/2_ip
         keep(far(middle) + 1_ip) = 1_ip
         call close_chain(start, middle, base, n_chain, first, flip, far)
         call close_chain(middle, n, far(middle) + 1_ip, n_chain, first, flip, far)
      else
         call close_chain(start, n, base, n_chain, first, flip, far)
      end if
   end subroutine one_chain

   pure subroutine close_chain(start, last, base, n_chain, first, flip, far)
      integer(ip), intent(in) :: start, last, base
      integer(ip), intent(inout) :: n_chain, first(:), flip(:), far(:)

      n_chain = n_chain + 1_ip
      first(n_chain + 1_ip) = last
      if (last - start > 1_ip .or. flip(last) == 0_ip) return
      flip(last) = 0_ip
      far(last) = base - 1_ip
   end subroutine close_chain

   !> The two elements at each node (1-based), and a mark on nodes that cannot be inside a chain.
   pure subroutine meet(ends, joins, keep, meeting)
      integer(ip), intent(in) :: ends(:, :), joins(:)
      integer(ip), intent(inout) :: keep(:)
      integer(ip), intent(out) :: meeting(:, :)

      integer(ip), allocatable :: degree(:)
      integer(ip) :: i, j, node

      allocate (degree(size(keep)))
      degree(:) = 0_ip
      meeting(:, :) = 0_ip
      do i = 1_ip, size(joins, kind=ip)
         do j = 1_ip, 2_ip
            node = ends(j, i) + 1_ip
            degree(node) = degree(node) + 1_ip
            if (degree(node) <= 2_ip) meeting(degree(node), node) = i
            if (joins(i) == 0_ip) keep(node) = 1_ip
         end do
      end do
      where (degree /= 2_ip) keep = 1_ip
   end subroutine meet

   !> From element `i` against its sense to a kept node; a ring is cut where it closes.
   pure subroutine back_to_kept(i, ends, meeting, keep, e, node)
      integer(ip), intent(in) :: i, ends(:, :), meeting(:, :)
      integer(ip), intent(inout) :: keep(:)
      integer(ip), intent(out) :: e, node

      integer(ip) :: other

      e = i
      node = ends(1, i) + 1_ip
      do while (keep(node) == 0_ip)
         other = meeting(1, node) + meeting(2, node) - e
         if (other == i) then
            keep(node) = 1_ip
            return
         end if
         e = other
         node = opposite(ends, e, node)
      end do
   end subroutine back_to_kept

   pure function opposite(ends, e, node) result(other)
      integer(ip), intent(in) :: ends(:, :), e, node
      integer(ip) :: other

      other = ends(1, e) + ends(2, e) + 2_ip - node
   end function opposite

end module links
