!> A reducer: a pipe whose diameters change linearly, fixed at end 1, tip at end 2.
!>
!> Axes at end 1: x along the axis of the pipes, y towards the offset of an eccentric reducer.
!> Sections are normal to x; their centres lie on the line (s L, s offset, 0), 0 < s < 1.  The
!> flexibility is Castigliano's integral with A(s) and I(s), taken by Gauss-Legendre quadrature
!> with 24 points: its error is below 1e-13 up to diameters of 10 to 1 (the integrands are
!> rational with their poles where a diameter vanishes).
module taper
   use bend, only: compliance
   use frame, only: cross, cross_matrix
   use kinds, only: wp
   use quadrature, only: n_point, station, weight
   implicit none (type, external)
   private
   public :: taper_flexibility, taper_free_deformation, taper_resultant

contains

   !> Tip deformations under unit tip forces: integral of A' C A dx.
   pure function taper_flexibility(form, rigidity, flex) result(f)
      real(wp), intent(in) :: form(:)       !! see `element`
      real(wp), intent(in) :: rigidity(4)   !! at end 1; EA [N], GJ, EI [N m2], GAs [N]; 0 rigid
      real(wp), intent(in) :: flex          !! factor on the bending flexibility
      real(wp) :: f(6, 6)

      real(wp) :: a(6, 6), c(6), s
      integer :: i, j

      f(:, :) = 0.0_wp
      do i = 1, n_point
         s = station(1.0_wp, i)
         c = compliance(rigidity_at(form, rigidity, s), flex)
         a = section_force((1.0_wp - s)*chord(form))
         do j = 1, 6
            f(:, j) = f(:, j) + weight(form(1), i)*matmul(transpose(a), c*a(:, j))
         end do
      end do
      f = 0.5_wp*(f + transpose(f))
   end function taper_flexibility

   !> Tip deformations of the free cantilever under a load along it and a free strain.
   pure function taper_free_deformation(form, rigidity, flex, load, strain) result(v)
      real(wp), intent(in) :: form(:), rigidity(4), flex   !! as in `taper_flexibility`
      real(wp), intent(in) :: load(3, 3)   !! see `element`, per length along x [N/m]
      real(wp), intent(in) :: strain       !! free strain in all directions
      real(wp) :: v(6)

      real(wp) :: a(6, 6), c(6), s, rest(6)
      integer :: i

      v(:) = 0.0_wp
      do i = 1, n_point
         s = station(1.0_wp, i)
         c = compliance(rigidity_at(form, rigidity, s), flex)
         a = section_force((1.0_wp - s)*chord(form))
         rest = load_beyond(form, load, s)
         v = v + weight(form(1), i)*matmul(transpose(a), c*rest)
      end do
      v(1:3) = v(1:3) + strain*chord(form)
   end function taper_free_deformation

   !> Resultant of the load: force, and moment about end 1.
   pure function taper_resultant(form, load) result(w)
      real(wp), intent(in) :: form(:), load(3, 3)   !! as in `taper_free_deformation`
      real(wp) :: w(6)

      w = load_beyond(form, load, 0.0_wp)
   end function taper_resultant

   !> Force of the load between s and the tip, and its moment about the point at s.
   pure function load_beyond(form, load, s) result(rest)
      real(wp), intent(in) :: form(:), load(3, 3), s
      real(wp) :: rest(6)

      real(wp) :: a(3, 0:2), r

      ! powers of s from Legendre's polynomials of 2 s - 1
      a(:, 0) = load(:, 1) - load(:, 2) + load(:, 3)
      a(:, 1) = 2.0_wp*load(:, 2) - 6.0_wp*load(:, 3)
      a(:, 2) = 6.0_wp*load(:, 3)
      r = 1.0_wp - s
      rest(1:3) = form(1)*r*(a(:, 0) + a(:, 1)*(1.0_wp + s)/2.0_wp &
         & + a(:, 2)*(1.0_wp + s + s**2)/3.0_wp)
      ! integrals of (t - s) t**n from s to 1 are r**2 times these sums
      rest(4:6) = form(1)*r**2*cross(chord(form), a(:, 0)/2.0_wp &
         & + a(:, 1)*(2.0_wp + s)/6.0_wp + a(:, 2)*(3.0_wp + 2.0_wp*s + s**2)/12.0_wp)
   end function load_beyond

   !> From end 1 to end 2.
   pure function chord(form) result(d)
      real(wp), intent(in) :: form(:)
      real(wp) :: d(3)

      d = [form(1), form(4), 0.0_wp]
   end function chord

   !> Rigidities of the section at s: those of end 1 times its area and second moment over theirs.
   pure function rigidity_at(form, rigidity, s) result(r)
      real(wp), intent(in) :: form(:), rigidity(4), s
      real(wp) :: r(4)

      real(wp) :: a, b, od, bore

      od = form(5) + s*(form(7) - form(5))
      bore = form(6) + s*(form(8) - form(6))
      a = (od - bore)*(od + bore)/((form(5) - form(6))*(form(5) + form(6)))
      b = a*(od**2 + bore**2)/(form(5)**2 + form(6)**2)
      r = [rigidity(1)*a, rigidity(2)*b, rigidity(3)*b, rigidity(4)*a]
   end function rigidity_at

   !> Forces and moments of a section under unit forces at the tip, which lies `arm` away.
   pure function section_force(arm) result(a)
      real(wp), intent(in) :: arm(3)
      real(wp) :: a(6, 6)

      integer :: i

      a(:, :) = 0.0_wp
      do i = 1, 6
         a(i, i) = 1.0_wp
      end do
      a(4:6, 1:3) = cross_matrix(arm)
   end function section_force

end module taper
