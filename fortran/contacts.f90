!> Passes over all support contacts and friction sliders of a model.
module contacts
   use assembly, only: add_contact
   use extended, only: add_dd
   use kinds, only: ip, wp
   use support, only: contact_law, hold_two_way, mode_slip, project, slider_law
   implicit none (type, external)
   private
   public :: accumulate, add_tangents, contact_pass, contact_product, coupling_product
   public :: gather, in_plane, rate, relative, scatter

   ! rows of `at`: where a contact or a slider acts
   integer, parameter, public :: at_node = 1, at_cnode = 2, at_rank = 3, at_offset = 4
   integer, parameter, public :: at_dim = 5, at_hold = 6, n_at = 6

contains

   !> Force, tangent and next state of every contact and slider; adds the forces to `r`.
   !>
   !> Capacities are given, or `coupled` to the present normal forces: mu N.  With `changing`
   !> only the forces that may change their state are added to `r`.
   pure subroutine contact_pass(at, normal, gap, k, base, preload, slider_at, basis, kf, mu, &
         & coupled, changing, slider_base, datum, first, list, u, low, capacity, side, reaction, &
         & tangent, mode, friction, slide, slider_tangent, n_force, r)
      integer(ip), intent(in) :: at(:, :)                    !! (n_at, n_contact)
      real(wp), intent(in) :: normal(:, :, :), gap(:, :), k(:)
      real(wp), intent(in) :: base(:, :), preload(:, :)      !! (3, n_contact) [m], [N]
      integer(ip), intent(in) :: slider_at(:, :)             !! (n_at, n_slider)
      real(wp), intent(in) :: basis(:, :, :), kf(:), mu(:)
      logical, intent(in) :: coupled, changing
      real(wp), intent(in) :: slider_base(:, :), datum(:, :)
      integer(ip), intent(in) :: first(:), list(:)           !! contacts of each slider
      real(wp), intent(in) :: u(:, :), low(:, :)
      real(wp), intent(inout) :: capacity(:)                 !! of each slider [N]
      integer(ip), intent(out) :: side(:), mode(:)
      real(wp), intent(out) :: reaction(:, :), tangent(:, :, :)
      real(wp), intent(out) :: friction(:, :), slide(:, :), slider_tangent(:, :, :)
      real(wp), intent(out) :: n_force(:)                    !! N of each slider [N]
      real(wp), intent(inout) :: r(:, :)

      real(wp) :: w(3), w_low(3)
      integer(ip) :: i

      do i = 1_ip, size(k, kind=ip)
         call relative(at(:, i), base(:, i), u, low, w, w_low)
         call contact_law(at(at_dim, i), normal(:, :, i), gap(:, i), k(i), &
            & at(at_hold, i), w, w_low, side(i), reaction(:, i), tangent(:, :, i))
         reaction(:, i) = reaction(:, i) + preload(:, i)
         if (changing .and. at(at_hold, i) == hold_two_way) cycle
         call add_force(at(:, i), reaction(:, i), r)
      end do
      do i = 1_ip, size(kf, kind=ip)
         n_force(i) = norm2(resultant(i, first, list, reaction))
         if (coupled) capacity(i) = mu(i)*n_force(i)
         call relative(slider_at(:, i), slider_base(:, i), u, low, w, w_low)
         slide(:, i) = in_plane(basis(:, :, i), w, w_low, datum(:, i))
         call slider_law(basis(:, :, i), kf(i), capacity(i), slide(:, i), mode(i), &
            & friction(:, i), slider_tangent(:, :, i))
         call add_force(slider_at(:, i), friction(:, i), r)
      end do
   end subroutine contact_pass

   !> Displacement of a node relative to its base or cnode, in double-double.
   pure subroutine relative(at, base, u, low, w, w_low)
      integer(ip), intent(in) :: at(:)
      real(wp), intent(in) :: base(3), u(:, :), low(:, :)
      real(wp), intent(out) :: w(3), w_low(3)

      integer(ip) :: o, n

      o = at(at_offset)
      n = at(at_node) + 1_ip
      w = u(o + 1:o + 3, n)
      w_low = low(o + 1:o + 3, n)
      call add_dd(w, w_low, -base, 0.0_wp)
      if (at(at_cnode) < 0_ip) return
      n = at(at_cnode) + 1_ip
      call add_dd(w, w_low, -u(o + 1:o + 3, n), -low(o + 1:o + 3, n))
   end subroutine relative

   !> Travel in the plane of sliding since the datum.
   pure function in_plane(basis, w, w_low, datum) result(s)
      real(wp), intent(in) :: basis(3, 2), w(3), w_low(3), datum(3)
      real(wp) :: s(3)

      real(wp) :: a, a_low, b, b_low, x(3), x_low(3)

      x = w
      x_low = w_low
      call add_dd(x, x_low, -datum, 0.0_wp)
      call project(basis(:, 1), x, x_low, a, a_low)
      call project(basis(:, 2), x, x_low, b, b_low)
      s = a*basis(:, 1) + b*basis(:, 2)
   end function in_plane

   pure subroutine add_force(at, f, r)
      integer(ip), intent(in) :: at(:)
      real(wp), intent(in) :: f(3)
      real(wp), intent(inout) :: r(:, :)

      integer(ip) :: o, n

      o = at(at_offset)
      n = at(at_node) + 1_ip
      r(o + 1:o + 3, n) = r(o + 1:o + 3, n) + f
      if (at(at_cnode) < 0_ip) return
      n = at(at_cnode) + 1_ip
      r(o + 1:o + 3, n) = r(o + 1:o + 3, n) - f
   end subroutine add_force

   !> Vector sum of the reactions that press on slider i.
   pure function resultant(i, first, list, reaction) result(n)
      integer(ip), intent(in) :: i, first(:), list(:)
      real(wp), intent(in) :: reaction(:, :)
      real(wp) :: n(3)

      integer(ip) :: j

      n(:) = 0.0_wp
      do j = first(i) + 1_ip, first(i + 1_ip)
         n = n + reaction(:, list(j) + 1_ip)
      end do
   end function resultant

   !> Subtract the contacts' share of K p from `r`; of those that may change, or of the `whole`.
   pure subroutine contact_product(at, tangent, whole, p, r)
      integer(ip), intent(in) :: at(:, :)
      real(wp), intent(in) :: tangent(:, :, :), p(:, :)
      logical, intent(in) :: whole
      real(wp), intent(inout) :: r(:, :)

      real(wp) :: dw(3)
      integer(ip) :: i

      do i = 1_ip, size(at, 2, ip)
         if (at(at_hold, i) == hold_two_way .and. .not. whole) cycle
         call rate(at(:, i), p, dw)
         call add_force(at(:, i), -matmul(tangent(:, :, i), dw), r)
      end do
   end subroutine contact_product

   !> Relative displacements of the contacts for displacements p, in plain reals.
   pure subroutine gather(at, p, w)
      integer(ip), intent(in) :: at(:, :)
      real(wp), intent(in) :: p(:, :)
      real(wp), intent(out) :: w(:, :)

      integer(ip) :: i

      do i = 1_ip, size(at, 2, ip)
         call rate(at(:, i), p, w(:, i))
      end do
   end subroutine gather

   !> Add contact forces to their nodes, and the opposites to their cnodes.
   pure subroutine scatter(at, force, r)
      integer(ip), intent(in) :: at(:, :)
      real(wp), intent(in) :: force(:, :)
      real(wp), intent(inout) :: r(:, :)

      integer(ip) :: i

      do i = 1_ip, size(at, 2, ip)
         call add_force(at(:, i), force(:, i), r)
      end do
   end subroutine scatter

   !> u + low + s p, renormalised.
   pure subroutine accumulate(p, s, u, low)
      real(wp), intent(in) :: p(:, :), s
      real(wp), intent(inout) :: u(:, :), low(:, :)

      real(wp) :: q(6)
      integer(ip) :: i

      do i = 1_ip, size(p, 2, ip)
         q = s*p(:, i)
         call add_dd(u(:, i), low(:, i), q, 0.0_wp)
      end do
   end subroutine accumulate

   !> Add the tangents of contacts and sliders to the values of the stiffness.
   !> `two_way` false leaves out the contacts that never change.
   pure subroutine add_tangents(at, tangent, two_way, colptr, val)
      integer(ip), intent(in) :: at(:, :)
      real(wp), intent(in) :: tangent(:, :, :)
      logical, intent(in) :: two_way
      integer(ip), intent(in) :: colptr(:)
      real(wp), intent(inout) :: val(:)

      integer(ip) :: i

      do i = 1_ip, size(at, 2, ip)
         if ((at(at_hold, i) == hold_two_way) .neqv. two_way) cycle
         call add_contact(tangent(:, :, i), at(at_offset, i), at(at_node, i), at(at_cnode, i), &
            & at(at_rank, i), colptr, val)
      end do
   end subroutine add_tangents

   !> Change of the sliding friction forces through their normal forces, for a change p of u:
   !> dF = (F/|F|) mu dN.  This is the unsymmetric part of the consistent tangent.
   pure subroutine coupling_product(at, tangent, slider_at, mu, mode, friction, first, list, &
         & reaction, p, change, r)
      integer(ip), intent(in) :: at(:, :), slider_at(:, :), mode(:), first(:), list(:)
      real(wp), intent(in) :: tangent(:, :, :), mu(:), friction(:, :), reaction(:, :), p(:, :)
      real(wp), intent(out) :: change(:)       !! dN of each slider, zero where it does not slip
      real(wp), intent(inout) :: r(:, :)

      real(wp) :: w(3), n(3), length
      integer(ip) :: i, j, c

      do i = 1_ip, size(mu, kind=ip)
         change(i) = 0.0_wp
         if (mode(i) /= mode_slip) cycle
         n = resultant(i, first, list, reaction)
         length = norm2(n)
         if (length <= 0.0_wp) cycle
         do j = first(i) + 1_ip, first(i + 1_ip)
            c = list(j) + 1_ip
            call rate(at(:, c), p, w)
            change(i) = change(i) - dot_product(n, matmul(tangent(:, :, c), w))/length
         end do
         w = friction(:, i)/norm2(friction(:, i))
         call add_force(slider_at(:, i), w*(mu(i)*change(i)), r)
      end do
   end subroutine coupling_product

   !> Relative displacement of a contact for the displacements p, in plain reals.
   pure subroutine rate(at, p, w)
      integer(ip), intent(in) :: at(:)
      real(wp), intent(in) :: p(:, :)
      real(wp), intent(out) :: w(3)

      integer(ip) :: o

      o = at(at_offset)
      w = p(o + 1:o + 3, at(at_node) + 1_ip)
      if (at(at_cnode) >= 0_ip) w = w - p(o + 1:o + 3, at(at_cnode) + 1_ip)
   end subroutine rate

end module contacts
