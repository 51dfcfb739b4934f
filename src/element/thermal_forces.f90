!> Nodal forces of a warm element: those that its nodes need to stay in their places, with the opposite sign. The temperature
!! varies as the shape functions between its values at the nodes. Integrated as the stiffness is, so that an element free to expand
!! under an even temperature has no stress, whatever its shape.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., sections 2.2 and 2.3: initial strains.
module thermal_forces
   use elasticity, only: axisymmetric, solid
   use element_kinds, only: max_nodes
   use element_mapping, only: element_law, element_map, map_element, map_point, max_shapes
   use isoparametric, only: condensed_stiffness, max_unknowns
   use kinds, only: wp
   use quadrature, only: body_rule, integration_rule
   use shape_functions, only: shape_values
   implicit none
   private

   public :: nodal_thermal_forces, condensed_thermal_forces

contains

   !> {f} = integral of [B]^T [D] {expansion} (T - TREF); with incompatible modes, their parameters condensed.
   pure subroutine nodal_thermal_forces(law, x, rise, f)
      type(element_law), intent(in) :: law
      real(wp), intent(in)    :: x(:, :)      !! nodes (dimension, nodes) [length]
      real(wp), intent(in)    :: rise(:)      !! (nodes) T - TREF [temperature]
      real(wp), intent(inout) :: f(:, :)      !! (dimension, nodes) [force], set here
      type(element_map) :: map
      real(wp) :: full(max_unknowns, max_unknowns), unknown(max_unknowns)
      integer  :: d, i, n, n_all

      call map_element(law, x, map)
      if (map%n_modes > 0) then
         call condensed_stiffness(law, x, full, n, n_all)
         call condensed_thermal_forces(law, x, rise, full, unknown)
      else
         call integrate(law, map, rise, unknown)
      end if
      d = merge(3, 2, law%state == solid)
      do i = 1, map%n
         f(:d, i) = unknown(d*(i - 1) + 1:d*i)
      end do
   end subroutine nodal_thermal_forces

   !> The forces on all unknowns, of nodes and of modes: those of mode p as the condensation of the stiffness met them, the modes
   !! behind it eliminated, those of nodes with all modes eliminated.
   pure subroutine condensed_thermal_forces(law, x, rise, full, f)
      type(element_law), intent(in) :: law
      real(wp), intent(in)  :: x(:, :), rise(:)                         !! as above
      real(wp), intent(in)  :: full(max_unknowns, max_unknowns)         !! from condensed_stiffness
      real(wp), intent(out) :: f(max_unknowns)                          !! [force]
      type(element_map) :: map
      integer :: d, p

      call map_element(law, x, map)
      call integrate(law, map, rise, f)
      d = merge(3, 2, law%state == solid)
      do p = d*(map%n + map%n_modes), d*map%n + 1, -1
         f(:p - 1) = f(:p - 1) - full(:p - 1, p)*(f(p)/full(p, p))
      end do
   end subroutine condensed_thermal_forces

   !> The forces on the unknowns of nodes and modes, nothing condensed.
   pure subroutine integrate(law, map, rise, f)
      type(element_law), intent(in) :: law
      type(element_map), intent(in) :: map
      real(wp), intent(in)  :: rise(:)
      real(wp), intent(out) :: f(max_unknowns)
      type(integration_rule) :: rule
      real(wp) :: g(3, max_shapes), n(max_nodes), stress(3), volume, warmth
      integer  :: c, d, i, k

      d = merge(3, 2, law%state == solid)
      stress = matmul(law%d(:3, :3), law%expansion)
      f = 0.0_wp
      call body_rule(law%kind, law%state == axisymmetric, rule)
      do k = 1, rule%n
         call map_point(law, map, rule%point(:, k), g, volume)
         call shape_values(law%kind, rule%point(:, k), n)
         warmth = rule%weight(k)*volume*dot_product(n(:map%n), rise(:map%n))
         do i = 1, map%n + map%n_modes
            do c = 1, d
               f(d*(i - 1) + c) = f(d*(i - 1) + c) + g(c, i)*(stress(c)*warmth)
            end do
            if (law%state == axisymmetric) f(2*i - 1) = f(2*i - 1) + g(3, i)*(stress(3)*warmth) ! the hoop
         end do
      end do
   end subroutine integrate

end module thermal_forces
