!> Passes over all elements: stiffness, loads, end forces and their sum at the nodes.
module elements
   use assembly, only: add_element
   use element, only: tip_deformation, tip_resultant, tip_stiffness
   use frame, only: cross, turn_to_global
   use kinds, only: ip, wp
   use recover, only: deformation, end_forces
   use status_codes, only: status_ok
   implicit none (type, external)
   private
   public :: add_ends, assemble_elements, element_end_forces, element_loads, element_stiffness

contains

   !> Tip stiffness of every element in its axes; `info` is the first bad element.
   pure subroutine element_stiffness(kind, form, rigidity, flex, spring, axes, d, k, status, info)
      integer(ip), intent(in) :: kind(:)
      real(wp), intent(in) :: form(:, :)       !! (n_form, n) see `element`
      real(wp), intent(in) :: rigidity(:, :), flex(:), spring(:, :)
      real(wp), intent(in) :: axes(:, :, :), d(:, :)
      real(wp), intent(out) :: k(:, :, :)
      integer(ip), intent(out) :: status, info

      integer(ip) :: i

      status = status_ok
      info = -1_ip
      do i = 1_ip, size(kind, kind=ip)
         call tip_stiffness(kind(i), form(:, i), rigidity(:, i), flex(i), spring(:, i), &
            & axes(:, :, i), d(:, i), k(:, :, i), status)
         if (status /= status_ok) then
            info = i - 1_ip
            return
         end if
      end do
   end subroutine element_stiffness

   !> Free tip deformation (element axes) and load resultant about end 1 (global).
   pure subroutine element_loads(kind, form, rigidity, flex, axes, dist, strain, curvature, v0, w)
      integer(ip), intent(in) :: kind(:)
      real(wp), intent(in) :: form(:, :), rigidity(:, :), flex(:), axes(:, :, :)
      real(wp), intent(in) :: dist(:, :, :)     !! (3, 3, n) global, per length of axis [N/m]
      real(wp), intent(in) :: strain(:), curvature(:)   !! [-], [rad/m]
      real(wp), intent(out) :: v0(:, :), w(:, :)        !! (6, n)

      real(wp) :: load(3, 3)
      integer(ip) :: i

      do i = 1_ip, size(kind, kind=ip)
         load = matmul(transpose(axes(:, :, i)), dist(:, :, i))
         v0(:, i) = tip_deformation(kind(i), form(:, i), rigidity(:, i), flex(i), load, strain(i), &
            & curvature(i))
         w(:, i) = turn_to_global(axes(:, :, i), &
            & tip_resultant(kind(i), form(:, i), load))
      end do
   end subroutine element_loads

   !> Add every element to the values of the global stiffness.
   pure subroutine assemble_elements(k, axes, d, ends, rank, colptr, val)
      real(wp), intent(in) :: k(:, :, :), axes(:, :, :), d(:, :)
      integer(ip), intent(in) :: ends(:, :), rank(:), colptr(:)
      real(wp), intent(inout) :: val(:)

      integer(ip) :: i

      do i = 1_ip, size(rank, kind=ip)
         call add_element(k(:, :, i), axes(:, :, i), d(:, i), ends(:, i), rank(i), colptr, val)
      end do
   end subroutine assemble_elements

   !> End forces on every element; subtracts them from the nodes' out-of-balance `r`.
   pure subroutine element_end_forces(ends, axes, d, k, v0, w, u, low, f, r)
      integer(ip), intent(in) :: ends(:, :)
      real(wp), intent(in) :: axes(:, :, :), d(:, :), k(:, :, :), v0(:, :), w(:, :)
      real(wp), intent(in) :: u(:, :), low(:, :)   !! displacements (6, n_node), high and low
      real(wp), intent(out) :: f(:, :, :)          !! (6, 2, n) global, on the element
      real(wp), intent(inout) :: r(:, :)

      real(wp) :: v(6)
      integer(ip) :: i, a, b

      do i = 1_ip, size(ends, 2, ip)
         a = ends(1, i) + 1_ip
         b = ends(2, i) + 1_ip
         v = deformation(d(:, i), axes(:, :, i), u(:, a), low(:, a), u(:, b), low(:, b), v0(:, i))
         f(:, :, i) = end_forces(k(:, :, i), axes(:, :, i), d(:, i), v, w(:, i))
         r(:, a) = r(:, a) - f(:, 1, i)
         r(:, b) = r(:, b) - f(:, 2, i)
      end do
   end subroutine element_end_forces

   !> Add a share of every element's end forces to its nodes.
   !>
   !> With `bent` also the moment that is left over at end 1 where the vector to end 2 is wrong by
   !> such a share, another for each component.
   pure subroutine add_ends(ends, share, d, bent, f, r)
      integer(ip), intent(in) :: ends(:, :)
      real(wp), intent(in) :: share(:), d(:, :), f(:, :, :)
      logical, intent(in) :: bent
      real(wp), intent(inout) :: r(:, :)

      real(wp), parameter :: other(3) = [1.0_wp, -0.75_wp, -0.5_wp]
      integer(ip) :: i, j, n

      do i = 1_ip, size(share, kind=ip)
         do j = 1_ip, 2_ip
            n = ends(j, i) + 1_ip
            r(:, n) = r(:, n) + share(i)*f(:, j, i)
         end do
         if (.not. bent) cycle
         n = ends(1, i) + 1_ip
         r(4:6, n) = r(4:6, n) + share(i)*cross(other*d(:, i), f(1:3, 2, i))
      end do
   end subroutine add_ends

end module elements
