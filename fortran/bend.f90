!> A bend as one circular arc, fixed at end 1, tip at end 2.
!>
!> Axes at end 1: x along the tangent, y towards the centre, so that the point at angle t lies at
!> R (sin t, 1 - cos t, 0).  Castigliano's integrals along the arc are taken by Gauss-Legendre
!> quadrature: with 24 points they are exact to rounding for any arc up to a full turn (an
!> entire integrand), and they do not cancel on small angles as the closed forms do.
module bend
   use frame, only: cross
   use kinds, only: wp
   use quadrature, only: n_point, station, weight
   implicit none (type, external)
   private
   public :: arc_flexibility, arc_free_deformation, arc_moment, arc_point
   public :: compliance

contains

   !> Tip deformations under unit tip forces: f = integral of A' C A ds, with A the section
   !> forces under unit tip forces and C the section's compliances.
   pure function arc_flexibility(radius, angle, rigidity, flex) result(f)
      real(wp), intent(in) :: radius, angle   !! [m], [rad]
      real(wp), intent(in) :: rigidity(4)     !! EA [N], GJ, EI [N m2], GAs [N]; GAs = 0 rigid
      real(wp), intent(in) :: flex            !! flexibility factor k of bending
      real(wp) :: f(6, 6)

      real(wp) :: a(6, 6), c(6)
      integer :: i, j

      c = compliance(rigidity, flex)
      f(:, :) = 0.0_wp
      do i = 1, n_point
         a = section_force(radius, angle, station(angle, i))
         do j = 1, 6
            f(:, j) = f(:, j) + weight(radius*angle, i)*matmul(transpose(a), c*a(:, j))
         end do
      end do
      f = 0.5_wp*(f + transpose(f))
   end function arc_flexibility

   !> Tip deformations of the free cantilever arc under a uniform load, strain and opening.
   pure function arc_free_deformation(radius, angle, rigidity, flex, load, strain, curvature) &
         & result(v)
      real(wp), intent(in) :: radius, angle, rigidity(4), flex   !! as in `arc_flexibility`
      real(wp), intent(in) :: load(3)      !! per length of arc, axes of end 1 [N/m]
      real(wp), intent(in) :: strain       !! free strain of the axis (the radius grows too)
      real(wp), intent(in) :: curvature    !! free change of angle per length [rad/m]
      real(wp) :: v(6)

      real(wp) :: a(6, 6), c(6), s(6), t, rest(6)
      integer :: i

      c = compliance(rigidity, flex)
      v(:) = 0.0_wp
      do i = 1, n_point
         t = station(angle, i)
         a = section_force(radius, angle, t)
         rest(1:3) = load*radius*(angle - t)
         rest(4:6) = cross(arc_moment(radius, t, angle), load)
         s = c*to_section(t, rest)
         s(6) = s(6) + curvature
         v = v + weight(radius*angle, i)*matmul(transpose(a), s)
      end do
      v(1:3) = v(1:3) + strain*arc_point(radius, angle)   ! uniform dilatation turns nothing
   end function arc_free_deformation

   !> Point of the axis at angle t from end 1, axes of end 1 [m].
   pure function arc_point(radius, t) result(x)
      real(wp), intent(in) :: radius, t
      real(wp) :: x(3)

      x = [radius*sin(t), 2.0_wp*radius*sin(0.5_wp*t)**2, 0.0_wp]
   end function arc_point

   !> First moment of the axis from angle t to `angle` about the point at t [m2].
   pure function arc_moment(radius, t, angle) result(m)
      real(wp), intent(in) :: radius, t, angle
      real(wp) :: m(3)

      real(wp) :: b
      integer :: j

      m(:) = 0.0_wp
      do j = 1, n_point
         b = t + station(angle - t, j)
         m = m + weight(radius*(angle - t), j)*chord(radius, t, b)
      end do
   end function arc_moment

   !> Vector from the point at t to the point at b, without cancellation.
   pure function chord(radius, t, b) result(x)
      real(wp), intent(in) :: radius, t, b
      real(wp) :: x(3)

      real(wp) :: mean, c

      mean = 0.5_wp*(t + b)
      c = 2.0_wp*radius*sin(0.5_wp*(b - t))
      x = [c*cos(mean), c*sin(mean), 0.0_wp]
   end function chord

   !> Forces and moments of the section at t, in its own axes, under unit tip forces.
   pure function section_force(radius, angle, t) result(a)
      real(wp), intent(in) :: radius, angle, t
      real(wp) :: a(6, 6)

      real(wp) :: unit(6), x(3)
      integer :: j

      x = chord(radius, t, angle)
      do j = 1, 6
         unit(:) = 0.0_wp
         unit(j) = 1.0_wp
         unit(4:6) = unit(4:6) + cross(x, unit(1:3))
         a(:, j) = to_section(t, unit)
      end do
   end function section_force

   !> A force and a moment in the axes of end 1, in those of the section at t.
   pure function to_section(t, f) result(g)
      real(wp), intent(in) :: t, f(6)
      real(wp) :: g(6)

      real(wp) :: c, s

      c = cos(t)
      s = sin(t)
      g(1:3) = [c*f(1) + s*f(2), -s*f(1) + c*f(2), f(3)]
      g(4:6) = [c*f(4) + s*f(5), -s*f(4) + c*f(5), f(6)]
   end function to_section

   pure function compliance(rigidity, flex) result(c)
      real(wp), intent(in) :: rigidity(4), flex
      real(wp) :: c(6)

      c = [1.0_wp/rigidity(1), 0.0_wp, 0.0_wp, 1.0_wp/rigidity(2), &
         & flex/rigidity(3), flex/rigidity(3)]
      if (rigidity(4) > 0.0_wp) c(2:3) = 1.0_wp/rigidity(4)
   end function compliance

end module bend
