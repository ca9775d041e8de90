!> Elements at their tip: every element is a cantilever fixed at end 1, whatever its shape.
!>
!> With d the vector from end 1 to end 2, the tip deformation is
!> v = (u2 - u1 - r1 x d, r2 - r1) and the tip force q = k (v - v0); the force at end 1 follows
!> from statics, so an element is in balance to the last bit and rigid motions cost nothing.
module element
   use beam, only: beam_flexibility, beam_free_deformation, beam_stiffness
   use bend, only: arc_flexibility, arc_free_deformation, arc_moment
   use frame, only: cross, cross_matrix
   use kinds, only: ip, wp
   use status_codes, only: status_bad_section, status_ok, status_zero_length
   use taper, only: taper_flexibility, taper_free_deformation, taper_resultant
   implicit none (type, external)
   private
   public :: invert, kind_arc, kind_spring, kind_straight, kind_taper, n_form
   public :: tip_deformation, tip_flexibility, tip_resultant, tip_stiffness

   integer(ip), parameter :: kind_straight = 0_ip, kind_arc = 1_ip, kind_spring = 2_ip, &
      & kind_taper = 3_ip
   integer, parameter :: n_form = 8

contains

   !> Flexibility in the axes of end 1 (not of springs).
   pure function tip_flexibility(kind, form, rigidity, flex) result(f)
      integer(ip), intent(in) :: kind
      real(wp), intent(in) :: form(:), rigidity(4), flex
      real(wp) :: f(6, 6)

      if (kind == kind_arc) then
         f = arc_flexibility(form(2), form(3), rigidity, flex)
      else if (kind == kind_taper) then
         f = taper_flexibility(form, rigidity, flex)
      else
         f = beam_flexibility(form(1), rigidity, flex)
      end if
   end function tip_flexibility

   !> Free tip deformation in the axes of end 1 under load [N/m], strain and curvature.
   pure function tip_deformation(kind, form, rigidity, flex, load, strain, curvature) result(v)
      integer(ip), intent(in) :: kind
      real(wp), intent(in) :: form(:), rigidity(4), flex
      real(wp), intent(in) :: load(3, 3), strain, curvature
      real(wp) :: v(6)

      if (kind == kind_arc) then
         v = arc_free_deformation(form(2), form(3), rigidity, flex, load(:, 1), strain, curvature)
      else if (kind == kind_straight) then
         v = beam_free_deformation(form(1), rigidity, flex, load(:, 1), strain)
      else if (kind == kind_taper) then
         v = taper_free_deformation(form, rigidity, flex, load, strain)
      else
         v(:) = 0.0_wp
         v(1) = strain*form(1)      ! an expansion joint grows along its axis
      end if
   end function tip_deformation

   !> Resultant of the load: force, and moment about end 1, axes of end 1.
   pure function tip_resultant(kind, form, load) result(w)
      integer(ip), intent(in) :: kind
      real(wp), intent(in) :: form(:), load(3, 3)
      real(wp) :: w(6)

      w(:) = 0.0_wp
      if (kind == kind_arc) then
         w(1:3) = load(:, 1)*form(2)*form(3)
         w(4:6) = cross(arc_moment(form(2), 0.0_wp, form(3)), load(:, 1))
      else if (kind == kind_straight) then
         w(1:3) = load(:, 1)*form(1)
         w(4:6) = cross([0.5_wp*form(1)**2, 0.0_wp, 0.0_wp], load(:, 1))
      else if (kind == kind_taper) then
         w = taper_resultant(form, load)
      end if
   end function tip_resultant

   !> Stiffness at the tip in the axes of end 1.
   pure subroutine tip_stiffness(kind, form, rigidity, flex, spring, axes, d, k, status)
      integer(ip), intent(in) :: kind
      real(wp), intent(in) :: form(:), rigidity(4), flex
      real(wp), intent(in) :: spring(6)    !! stiffnesses at mid-distance, own axes
      real(wp), intent(in) :: axes(3, 3)   !! columns ex, ey, ez of end 1, global
      real(wp), intent(in) :: d(3)         !! from end 1 to end 2, global [m]
      real(wp), intent(out) :: k(6, 6)
      integer(ip), intent(out) :: status

      status = status_ok
      k(:, :) = 0.0_wp
      if (kind == kind_spring) then
         k = spring_stiffness(spring, matmul(d, axes))
         return
      end if
      if (.not. (form(1) > 0.0_wp)) then
         status = status_zero_length
         return
      end if
      if (.not. (minval(rigidity(1:3)) > 0.0_wp .and. flex > 0.0_wp)) then
         status = status_bad_section
         return
      end if
      if (kind == kind_arc) then
         call invert(arc_flexibility(form(2), form(3), rigidity, flex), k, status)
      else if (kind == kind_taper) then
         if (min(form(5) - form(6), form(7) - form(8)) > 0.0_wp) then
            call invert(taper_flexibility(form, rigidity, flex), k, status)
         else
            status = status_bad_section
         end if
      else
         k = beam_stiffness(form(1), rigidity, flex)
      end if
   end subroutine tip_stiffness

   !> A spring at mid-distance: its deformation there is v + (r2 - r1)/2 carried by -d.
   pure function spring_stiffness(spring, d) result(k)
      real(wp), intent(in) :: spring(6)
      real(wp), intent(in) :: d(3)           !! in its own axes
      real(wp) :: k(6, 6)

      real(wp) :: t(6, 6), diagonal(6, 6)
      integer :: i

      diagonal(:, :) = 0.0_wp
      do i = 1, 6
         diagonal(i, i) = spring(i)
      end do
      t(:, :) = 0.0_wp
      do i = 1, 6
         t(i, i) = 1.0_wp
      end do
      t(1:3, 4:6) = 0.5_wp*cross_matrix(d)
      k = matmul(transpose(t), matmul(diagonal, t))
      k = 0.5_wp*(k + transpose(k))
   end function spring_stiffness

   !> Inverse of a symmetric positive definite 6 by 6 by Cholesky, scaled to a unit diagonal.
   pure subroutine invert(f, k, status)
      real(wp), intent(in) :: f(6, 6)
      real(wp), intent(out) :: k(6, 6)
      integer(ip), intent(out) :: status

      real(wp) :: l(6, 6), x(6, 6), s(6), a
      integer :: i, j

      status = status_bad_section
      k(:, :) = 0.0_wp
      l(:, :) = 0.0_wp
      x(:, :) = 0.0_wp
      do i = 1, 6
         if (.not. f(i, i) > 0.0_wp) return
         s(i) = 1.0_wp/sqrt(f(i, i))
      end do
      do j = 1, 6
         do i = j, 6
            a = f(i, j)*s(i)*s(j) - dot_product(l(1:j - 1, i), l(1:j - 1, j))
            if (i == j) then
               if (.not. a > 0.0_wp) return
               l(j, j) = sqrt(a)
            else
               l(j, i) = a/l(j, j)
            end if
         end do
      end do
      do j = 1, 6                            ! X = L**-1, column j below its diagonal
         x(j, j) = 1.0_wp/l(j, j)
         do i = j + 1, 6
            x(i, j) = -dot_product(l(j:i - 1, i), x(j:i - 1, j))/l(i, i)
         end do
      end do
      do j = 1, 6
         do i = j, 6
            k(i, j) = s(i)*s(j)*dot_product(x(i:, i), x(i:, j))
            k(j, i) = k(i, j)
         end do
      end do
      status = status_ok
   end subroutine invert

end module element
