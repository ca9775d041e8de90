!> Chains of elements condensed to their ends, exactly and without solving anything.
!>
!> A chain is a cantilever like every element: fixed at its base, loaded at its tip.  Its forces
!> follow from statics, its flexibility is the sum of its members' (virtual work), and the
!> displacements inside follow from the members' deformations one after the other.  So a chain
!> enters the equations as one element, and what is inside is found in two sweeps: forces from
!> the tip to the base, displacements (double-double) from the base to the tip.
module chains
   use element, only: invert
   use extended, only: add_dd, add_product
   use frame, only: cross, cross_matrix, turn_to_global, turn_to_local
   use kinds, only: ip, wp
   use recover, only: deformation, end_forces
   use status_codes, only: status_ok
   implicit none (type, external)
   private
   public :: chain_end_forces, chain_loads, chain_stiffness

   real(wp), parameter :: closed = 16.0_wp*epsilon(1.0_wp)   !! misfit at the tip, relative

contains

   !> Tip stiffness, tip vector and axes of every chain; those of one member are given in.
   !>
   !> A chain's axes are those of its longest member: there a straight line's stiff axial and
   !> soft lateral ways do not mix.
   pure subroutine chain_stiffness(first, element, flip, f, axes, d, k, axes_c, d_c, status, info)
      integer(ip), intent(in) :: first(:), element(:), flip(:)   !! see `link_chains`
      real(wp), intent(in) :: f(:, :, :)            !! (6, 6, n_elem) tip flexibilities, own axes
      real(wp), intent(in) :: axes(:, :, :)         !! (3, 3, n_elem) columns ex, ey, ez
      real(wp), intent(in) :: d(:, :)               !! (3, n_elem) from end 1 to end 2 [m]
      real(wp), intent(inout) :: k(:, :, :)         !! (6, 6, n_chain) in the chain's axes
      real(wp), intent(out) :: axes_c(:, :, :)      !! (3, 3, n_chain)
      real(wp), intent(out) :: d_c(:, :)            !! (3, n_chain)
      integer(ip), intent(out) :: status, info

      real(wp) :: total(6, 6), lever(3)
      integer(ip) :: c, j, e

      status = status_ok
      info = -1_ip
      do c = 1_ip, size(k, 3, ip)
         e = longest(c, first, element, d)
         axes_c(:, :, c) = axes(:, :, e)
         d_c(:, c) = d(:, e)
         if (first(c + 1_ip) - first(c) == 1_ip) cycle
         total(:, :) = 0.0_wp
         lever(:) = 0.0_wp
         do j = first(c + 1_ip), first(c) + 1_ip, -1_ip
            e = element(j) + 1_ip
            if (flip(j) == 1_ip) lever = lever - d(:, e)
            call add_flexibility(f(:, :, e), axes(:, :, e), axes_c(:, :, c), lever, total)
            if (flip(j) == 0_ip) lever = lever + d(:, e)
         end do
         d_c(:, c) = lever
         call invert(0.5_wp*(total + transpose(total)), k(:, :, c), status)
         if (status /= status_ok) then
            info = element(first(c) + 1_ip)
            return
         end if
      end do
   end subroutine chain_stiffness

   !> Free tip deformation (chain's axes) and load resultant about the base (global).
   pure subroutine chain_loads(first, element, flip, far, f, axes, d, axes_c, v0, w, nodal, &
         & v0_c, w_c)
      integer(ip), intent(in) :: first(:), element(:), flip(:), far(:)
      real(wp), intent(in) :: f(:, :, :), axes(:, :, :), d(:, :), axes_c(:, :, :)
      real(wp), intent(in) :: v0(:, :), w(:, :)     !! (6, n_elem) as of `element_loads`
      real(wp), intent(in) :: nodal(:, :)           !! (6, n_node) loads at all nodes
      real(wp), intent(out) :: v0_c(:, :), w_c(:, :)

      real(wp) :: q(6), q_low(6), lever(3), ends(6, 2), low(6, 2), v(6)
      integer(ip) :: c, j, e

      do c = 1_ip, size(v0_c, 2, ip)
         if (first(c + 1_ip) - first(c) == 1_ip) then
            e = element(first(c + 1_ip)) + 1_ip
            v0_c(:, c) = v0(:, e)
            w_c(:, c) = w(:, e)
            cycle
         end if
         q(:) = 0.0_wp
         q_low(:) = 0.0_wp
         lever(:) = 0.0_wp
         v0_c(:, c) = 0.0_wp
         do j = first(c + 1_ip), first(c) + 1_ip, -1_ip
            e = element(j) + 1_ip
            if (j < first(c + 1_ip)) call add_dd(q, q_low, nodal(:, far(j) + 1_ip), 0.0_wp)
            call member_forces(q, q_low, d(:, e), w(:, e), flip(j), ends, low)
            v = v0(:, e) + matmul(f(:, :, e), turn_to_local(axes(:, :, e), ends(:, 2)))
            if (flip(j) == 1_ip) lever = lever - d(:, e)
            v = turn_to_local(axes_c(:, :, c), at_tip(turn_to_global(axes(:, :, e), v), lever))
            if (flip(j) == 1_ip) v = -v
            v0_c(:, c) = v0_c(:, c) + v
            if (flip(j) == 0_ip) lever = lever + d(:, e)
            q = -ends(:, 1_ip + flip(j))
            q_low = -low(:, 1_ip + flip(j))
         end do
         w_c(:, c) = q
      end do
   end subroutine chain_loads

   !> End forces on every element, displacements inside the chains, and the chains' forces taken
   !> off the out-of-balance `r` of the kept nodes.
   !>
   !> `u`, `low` hold all nodes; those of the kept ones are given.  Where the displacement that
   !> the sweep arrives at misses the tip's own, the tip force is corrected by the chain's
   !> stiffness: the law of the chain then holds to the last digits, however its stiffness was
   !> rounded.  `bias` keeps these corrections for the next call, which needs one sweep then.
   pure subroutine chain_end_forces(first, element, flip, far, base, place, f, axes, d, k, axes_c, &
         & d_c, v0, w, v0_c, w_c, nodal, most, bias, u, low, force, r)
      integer(ip), intent(in) :: first(:), element(:), flip(:), far(:)
      integer(ip), intent(in) :: base(:)                !! (n_chain) node at the base
      integer(ip), intent(in) :: place(:)               !! (n_node) number among the kept ones
      real(wp), intent(in) :: f(:, :, :), axes(:, :, :), d(:, :)
      real(wp), intent(in) :: k(:, :, :), axes_c(:, :, :), d_c(:, :)
      real(wp), intent(in) :: v0(:, :), w(:, :), v0_c(:, :), w_c(:, :), nodal(:, :)
      integer(ip), intent(in) :: most                   !! sweeps at the most
      real(wp), intent(inout) :: bias(:, :)             !! (6, n_chain) added to k v, its axes
      real(wp), intent(inout) :: u(:, :), low(:, :)     !! (6, n_node)
      real(wp), intent(out) :: force(:, :, :)           !! (6, 2, n_elem) global, on the element
      real(wp), intent(inout) :: r(:, :)                !! (6, n_kept)

      real(wp) :: q(6), q_low(6), v(6), miss(6), wrong, last, end_c(6, 2), low_c(6, 2)
      integer(ip) :: c, a, b, from, to, i

      do c = 1_ip, size(base, kind=ip)
         from = first(c) + 1_ip
         to = first(c + 1_ip)
         a = base(c) + 1_ip
         b = far(to) + 1_ip
         v = deformation(d_c(:, c), axes_c(:, :, c), u(:, a), low(:, a), u(:, b), low(:, b), &
            & v0_c(:, c))
         end_c = end_forces(k(:, :, c), axes_c(:, :, c), d_c(:, c), v, w_c(:, c))
         low_c(:, :) = 0.0_wp
         if (from == to) then
            force(:, :, element(to) + 1_ip) = end_c
         else
            q = end_c(:, 2)
            q_low(:) = 0.0_wp
            call add_dd(q, q_low, turn_to_global(axes_c(:, :, c), bias(:, c)), 0.0_wp)
            last = huge(1.0_wp)
            do i = 1_ip, most
               call sweep(element(from:to), flip(from:to), far(from:to), f, axes, d, v0, w, nodal, &
                  & a, q, q_low, norm2(d_c(:, c)), u, low, force, end_c, low_c, miss, wrong)
               if (wrong <= closed .or. .not. wrong < 0.5_wp*last) exit
               if (i == most) exit
               last = wrong
               miss = matmul(k(:, :, c), turn_to_local(axes_c(:, :, c), miss))
               bias(:, c) = bias(:, c) + miss
               call add_dd(q, q_low, turn_to_global(axes_c(:, :, c), miss), 0.0_wp)
            end do
         end if
         r(:, place(a) + 1_ip) = (r(:, place(a) + 1_ip) - end_c(:, 1)) - low_c(:, 1)
         r(:, place(b) + 1_ip) = (r(:, place(b) + 1_ip) - end_c(:, 2)) - low_c(:, 2)
      end do

   end subroutine chain_end_forces

   !> Forces on the members from a to b for the tip force q, displacements inside, the misfit at
   !> the tip, relative: to what the members' deformations may move and turn the tip.
   !>
   !> Forces are double-double on their way: loads inside may be many times what they leave over.
   pure subroutine sweep(member, flip, far, f, axes, d, v0, w, nodal, a, q, q_low, reach, u, low, &
         & force, end_c, low_c, miss, wrong)
      integer(ip), intent(in) :: member(:), flip(:), far(:)   !! of this chain
      real(wp), intent(in) :: f(:, :, :), axes(:, :, :), d(:, :), v0(:, :), w(:, :), nodal(:, :)
      integer(ip), intent(in) :: a              !! node at the base, 1-based
      real(wp), intent(in) :: q(6), q_low(6), reach
      real(wp), intent(inout) :: u(:, :), low(:, :), force(:, :, :)
      real(wp), intent(out) :: end_c(6, 2), low_c(6, 2)   !! on the chain at its base and tip
      real(wp), intent(out) :: miss(6), wrong

      real(wp) :: p(6), p_low(6), ends(6, 2), ends_low(6, 2), rest(6, size(member))
      real(wp) :: x(6), x_low(6), moved, turned
      integer(ip) :: j, m, n, last

      last = size(member, kind=ip)
      p = q
      p_low = q_low
      do j = last, 1_ip, -1_ip
         m = member(j) + 1_ip
         if (j < last) call add_dd(p, p_low, nodal(:, far(j) + 1_ip), 0.0_wp)
         call member_forces(p, p_low, d(:, m), w(:, m), flip(j), ends, ends_low)
         force(:, :, m) = ends
         rest(:, j) = ends_low(:, 2)
         p = -ends(:, 1_ip + flip(j))
         p_low = -ends_low(:, 1_ip + flip(j))
      end do
      end_c(:, 1) = -p
      low_c(:, 1) = -p_low
      end_c(:, 2) = q
      low_c(:, 2) = q_low
      x = u(:, a)
      x_low = low(:, a)
      moved = 0.0_wp
      turned = 0.0_wp
      do j = 1_ip, last
         m = member(j) + 1_ip
         n = far(j) + 1_ip
         p = turn_to_local(axes(:, :, m), force(:, 2, m)) + turn_to_local(axes(:, :, m), rest(:, j))
         p = turn_to_global(axes(:, :, m), v0(:, m) + matmul(f(:, :, m), p))
         call step_over(p, d(:, m), flip(j), x, x_low)
         turned = max(turned, maxval(abs(p(4:6))))
         moved = max(moved, maxval(abs(p(1:3))))
         if (j == last) exit
         u(:, n) = x
         low(:, n) = x_low
      end do
      p = u(:, n)
      miss = low(:, n)
      call add_dd(p, miss, -x, -x_low)
      miss = p + miss
      moved = max(moved + reach*turned, tiny(moved))
      turned = max(turned, moved/max(reach, 1.0_wp))
      wrong = max(maxval(abs(miss(1:3)))/moved, maxval(abs(miss(4:6)))/turned)
   end subroutine sweep

   !> Forces on a member at both ends for the force p on it at its far end.
   pure subroutine member_forces(p, p_low, d, w, flip, ends, low)
      real(wp), intent(in) :: p(6), p_low(6), d(3)
      real(wp), intent(in) :: w(6)           !! load resultant: force, moment about end 1
      integer(ip), intent(in) :: flip
      real(wp), intent(out) :: ends(6, 2), low(6, 2)

      integer(ip) :: near, far

      near = 1_ip + flip
      far = 3_ip - near
      ends(:, far) = p
      low(:, far) = p_low
      ends(:, near) = -p
      low(:, near) = -p_low
      call add_dd(ends(:, near), low(:, near), -w, 0.0_wp)
      call subtract_moment(d, ends(1:3, 2), low(1:3, 2), ends(4:6, near), low(4:6, near))
   end subroutine member_forces

   !> (m, m_low) <- (m, m_low) - d x (force, force_low).
   pure subroutine subtract_moment(d, force, force_low, m, m_low)
      real(wp), intent(in) :: d(3), force(3), force_low(3)
      real(wp), intent(inout) :: m(3), m_low(3)

      integer, parameter :: next(3) = [2, 3, 1], after(3) = [3, 1, 2]
      integer :: i, j, k

      do i = 1, 3
         j = next(i)
         k = after(i)
         call add_product(m(i), m_low(i), force(k), force_low(k), -d(j))
         call add_product(m(i), m_low(i), force(j), force_low(j), d(k))
      end do
   end subroutine subtract_moment

   !> Displacement (double-double) from a member's near end to its far end.
   pure subroutine step_over(v, d, flip, x, x_low)
      real(wp), intent(in) :: v(6)           !! deformation of end 2 against end 1, global
      real(wp), intent(in) :: d(3)
      integer(ip), intent(in) :: flip
      real(wp), intent(inout) :: x(6), x_low(6)

      integer, parameter :: next(3) = [2, 3, 1], after(3) = [3, 1, 2]
      real(wp) :: s
      integer :: i, j, k

      s = merge(1.0_wp, -1.0_wp, flip == 0_ip)
      if (flip == 1_ip) call add_dd(x(4:6), x_low(4:6), -v(4:6), 0.0_wp)
      do i = 1, 3                            ! the rotation of end 1 carries end 2: r1 x d
         j = next(i)
         k = after(i)
         call add_product(x(i), x_low(i), x(3 + j), x_low(3 + j), s*d(k))
         call add_product(x(i), x_low(i), x(3 + k), x_low(3 + k), -s*d(j))
      end do
      call add_dd(x(1:3), x_low(1:3), s*v(1:3), 0.0_wp)
      if (flip == 0_ip) call add_dd(x(4:6), x_low(4:6), v(4:6), 0.0_wp)
   end subroutine step_over

   !> What a deformation (global) moves a tip that lies `lever` beyond it.
   pure function at_tip(v, lever) result(t)
      real(wp), intent(in) :: v(6), lever(3)
      real(wp) :: t(6)

      t(1:3) = v(1:3) + cross(v(4:6), lever)
      t(4:6) = v(4:6)
   end function at_tip

   !> Add a member's share to the flexibility of its chain: S' F S with the statics S.
   pure subroutine add_flexibility(f, axes, axes_c, lever, total)
      real(wp), intent(in) :: f(6, 6)        !! in the member's axes
      real(wp), intent(in) :: axes(3, 3), axes_c(3, 3)
      real(wp), intent(in) :: lever(3)       !! from the member's end 2 to the tip, global [m]
      real(wp), intent(inout) :: total(6, 6)

      real(wp) :: a(3, 3), b(3, 3), m1(3, 3), m2(3, 3), m4(3, 3)

      a = matmul(transpose(axes), axes_c)    ! S = [a, 0; b, a]
      b = matmul(transpose(axes), matmul(cross_matrix(lever), axes_c))
      m1 = matmul(f(1:3, 1:3), a) + matmul(f(1:3, 4:6), b)
      m2 = matmul(f(4:6, 1:3), a) + matmul(f(4:6, 4:6), b)
      m4 = matmul(f(4:6, 4:6), a)
      total(1:3, 1:3) = total(1:3, 1:3) + matmul(transpose(a), m1) + matmul(transpose(b), m2)
      total(4:6, 1:3) = total(4:6, 1:3) + matmul(transpose(a), m2)
      total(4:6, 4:6) = total(4:6, 4:6) + matmul(transpose(a), m4)
      total(1:3, 4:6) = transpose(total(4:6, 1:3))
   end subroutine add_flexibility

   !> The longest member of chain c.
   pure function longest(c, first, element, d) result(e)
      integer(ip), intent(in) :: c, first(:), element(:)
      real(wp), intent(in) :: d(:, :)
      integer(ip) :: e

      real(wp) :: reach, most
      integer(ip) :: j, i

      most = -1.0_wp
      e = element(first(c) + 1_ip) + 1_ip
      do j = first(c) + 1_ip, first(c + 1_ip)
         i = element(j) + 1_ip
         reach = sum(d(:, i)**2)
         if (.not. reach > most) cycle
         most = reach
         e = i
      end do
   end function longest

end module chains
