!> Exact line search on the convex energy of fixed capacities.
module search
   use contacts, only: at_dim, at_hold, in_plane, rate, relative
   use extended, only: add_dd
   use kinds, only: ip, wp
   use support, only: contact_law, hold_two_way, slider_law
   implicit none (type, external)
   private
   public :: line_search

   integer, parameter :: n_try = 60
   real(wp), parameter :: good = 1.0e-2_wp   !! slope left, of the slope at the start

contains

   !> Step length at which the energy's slope along p vanishes (or has nearly done so).
   !>
   !> The slope starts at -work(1), the out-of-balance force times p, and grows because the
   !> energy is convex: by the part of p'Kp = work(2) that never changes, and by the work of
   !> the contacts and sliders that may change.  Their displacements are in double-double, so
   !> that the search is sharp to the last digits.
   pure subroutine line_search(at, normal, gap, k, base, slider_at, basis, kf, capacity, &
         & slider_base, datum, u, low, p, work, step, slope)
      integer(ip), intent(in) :: at(:, :), slider_at(:, :)
      real(wp), intent(in) :: normal(:, :, :), gap(:, :), k(:), base(:, :)
      real(wp), intent(in) :: basis(:, :, :), kf(:), capacity(:), slider_base(:, :), datum(:, :)
      real(wp), intent(in) :: u(:, :), low(:, :), p(:, :), work(2)
      real(wp), intent(out) :: step
      real(wp), intent(out) :: slope(2)         !! at 0 and at the step

      real(wp) :: a, b, fa, fb, f, start, linear
      integer :: i

      linear = work(2)
      start = 0.0_wp
      call pass(0.0_wp, start, linear)
      slope(1) = -work(1)
      step = 1.0_wp
      f = slope_at(step)
      slope(2) = f
      if (.not. slope(1) < 0.0_wp) return
      if (abs(f) <= good*abs(slope(1))) return
      a = 0.0_wp
      fa = slope(1)
      b = 1.0_wp
      fb = f
      do i = 1, n_try                            ! bracket: the energy may fall beyond 1
         if (fb > 0.0_wp) exit
         a = b
         fa = fb
         b = 2.0_wp*b
         fb = slope_at(b)
      end do
      do i = 1, n_try                            ! Illinois variant of the false position
         step = a - fa*(b - a)/(fb - fa)
         if (.not. (step > a .and. step < b)) step = 0.5_wp*(a + b)
         f = slope_at(step)
         if (abs(f) <= good*abs(slope(1)) .or. b - a <= epsilon(b)*b) exit
         if (f < 0.0_wp) then
            a = step
            fa = f
            fb = 0.5_wp*fb
         else
            b = step
            fb = f
            fa = 0.5_wp*fa
         end if
      end do
      slope(2) = f

   contains

      pure function slope_at(s) result(g)
         real(wp), intent(in) :: s
         real(wp) :: g

         real(wp) :: force_work, dummy

         force_work = 0.0_wp
         dummy = 0.0_wp
         call pass(s, force_work, dummy)
         g = slope(1) + s*linear + (start - force_work)
      end function slope_at

      !> Add the work of the changing forces at u + s p, and take off that of their tangents.
      pure subroutine pass(s, force_work, tangent_work)
         real(wp), intent(in) :: s
         real(wp), intent(inout) :: force_work, tangent_work

         real(wp) :: w(3), w_low(3), dw(3), force(3), tangent(3, 3)
         integer(ip) :: j, state

         do j = 1_ip, size(k, kind=ip)
            if (at(at_hold, j) == hold_two_way) cycle
            call along(at(:, j), base(:, j), u, low, p, s, w, w_low, dw)
            call contact_law(at(at_dim, j), normal(:, :, j), gap(:, j), k(j), at(at_hold, j), w, &
               & w_low, state, force, tangent)
            force_work = force_work + dot_product(force, dw)
            tangent_work = tangent_work - dot_product(dw, matmul(tangent, dw))
         end do
         do j = 1_ip, size(kf, kind=ip)
            call along(slider_at(:, j), slider_base(:, j), u, low, p, s, w, w_low, dw)
            call slider_law(basis(:, :, j), kf(j), capacity(j), &
               & in_plane(basis(:, :, j), w, w_low, datum(:, j)), state, force, tangent)
            force_work = force_work + dot_product(force, dw)
            tangent_work = tangent_work - dot_product(dw, matmul(tangent, dw))
         end do
      end subroutine pass

   end subroutine line_search

   !> Relative displacement of a contact at u + s p in double-double, and its rate.
   pure subroutine along(at, base, u, low, p, s, w, w_low, dw)
      integer(ip), intent(in) :: at(:)
      real(wp), intent(in) :: base(3), u(:, :), low(:, :), p(:, :), s
      real(wp), intent(out) :: w(3), w_low(3), dw(3)

      call relative(at, base, u, low, w, w_low)
      call rate(at, p, dw)
      call add_dd(w, w_low, s*dw, 0.0_wp)
   end subroutine along

end module search
