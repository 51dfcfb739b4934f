!> Consistent nodal forces and areas of influence: of body forces over an element, of pressures over its sides; thermal forces, which
!! the nodes of a warm element need to stay in their places, with the opposite sign. The temperature varies as the shape functions
!! between its values at the nodes; its forces are integrated as the stiffness is, so that an element free to expand under an even
!! temperature has no stress, whatever its shape.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., sections 2.2, 2.3 (initial strains) and 5.5.
module element_loads
   use elasticity, only: axisymmetric, solid
   use element_kinds, only: max_nodes, max_side_nodes, side_kind
   use element_mapping, only: element_law, element_map, map_element, map_point, max_shapes, two_pi
   use isoparametric, only: condensed_stiffness, max_unknowns
   use kinds, only: wp
   use numbers, only: cross
   use quadrature, only: body_rule, integration_rule, side_rule, volume_rule
   use shape_functions, only: shape_derivatives, shape_values
   implicit none
   private

   public :: body_forces, side_areas, side_forces, nodal_thermal_forces, condensed_thermal_forces

contains

   !> Nodal forces of a constant body force: F(:, i) = B times the integral of N_i over the element.
   pure subroutine body_forces(law, x, b, f)
      type(element_law), intent(in) :: law
      real(wp), intent(in)    :: x(:, :)      !! nodes (dimension, nodes) [length]
      real(wp), intent(in)    :: b(:)         !! (dimension) force per volume, as rho*g [force/length^3]
      real(wp), intent(inout) :: f(:, :)      !! (dimension, nodes) [force], set here
      type(element_map)      :: map
      type(integration_rule) :: rule
      real(wp) :: g(3, max_shapes), n(max_nodes), share(max_nodes), volume
      integer  :: i

      call map_element(law, x, map)
      call volume_rule(law%kind, law%state == axisymmetric, rule)
      share = 0.0_wp
      do i = 1, rule%n
         call map_point(law, map, rule%point(:, i), g, volume)
         call shape_values(law%kind, rule%point(:, i), n)
         share = share + n*(rule%weight(i)*volume)
      end do
      f(:size(b), :map%n) = spread(b, 2, map%n)*spread(share(:map%n), 1, size(b))
   end subroutine body_forces

   !> Areas of influence of one side, a_i = integral of N_i: an edge of a plane or axisymmetric body, a triangle or a
   !! quadrilateral of a solid. Their sum is the area of the side; at corners of second-order faces they are not positive.
   pure subroutine side_areas(state, thickness, x, area)
      integer, intent(in)     :: state        !! plane_stress ... solid
      real(wp), intent(in)    :: thickness    !! of a plane body [length]
      real(wp), intent(in)    :: x(:, :)      !! nodes of the side (dimension, 2 to 8) [length]
      real(wp), intent(inout) :: area(:)      !! (nodes of the side) [length^2], set here
      type(integration_rule) :: rule
      real(wp) :: n(max_side_nodes), normal(3)
      integer  :: i, nodes

      nodes = size(x, 2)
      call side_rule(side_kind(size(x, 1), nodes), rule)
      area(:nodes) = 0.0_wp
      do i = 1, rule%n
         call map_side(state, thickness, x, rule%point(:, i), n, normal)
         area(:nodes) = area(:nodes) + n(:nodes)*(rule%weight(i)*sqrt(sum(normal**2)))
      end do
   end subroutine side_areas

   !> Nodal forces of a pressure on one side, positive when it presses on the body: against the normal that points out; or of a
   !! traction along a DIRECTION. It varies as the shape functions between its values at the nodes. With a pressure of -1 at all nodes
   !! the result is the integral of N_i times the outward normal.
   pure subroutine side_forces(state, thickness, x, pressure, f, direction)
      integer, intent(in)     :: state        !! plane_stress ... solid
      real(wp), intent(in)    :: thickness    !! of a plane body [length]
      real(wp), intent(in)    :: x(:, :)      !! nodes of the side (dimension, 2 to 8), in the order of element_kinds
      real(wp), intent(in)    :: pressure(:)  !! (nodes of the side) [pressure]
      real(wp), intent(inout) :: f(:, :)      !! (dimension, nodes of the side) [force], set here
      real(wp), intent(in), optional :: direction(:) !! (dimension) unit
      type(integration_rule) :: rule
      real(wp) :: n(max_side_nodes), normal(3), p
      integer  :: d, i, k, nodes

      d = size(x, 1)
      nodes = size(x, 2)
      call side_rule(side_kind(size(x, 1), nodes), rule)
      f(:d, :nodes) = 0.0_wp
      do i = 1, rule%n
         call map_side(state, thickness, x, rule%point(:, i), n, normal)
         p = rule%weight(i)*dot_product(n(:nodes), pressure(:nodes))
         if (present(direction)) then
            p = rule%weight(i)*norm2(normal)*dot_product(n(:nodes), pressure(:nodes))
            normal(:d) = -direction
         end if
         do k = 1, nodes
            f(:d, k) = f(:d, k) - (p*n(k))*normal(:d)
         end do
      end do
   end subroutine side_forces

   !> Shape functions at a point of a side, and the outward normal there, as long as the area that a unit of weight stands for.
   pure subroutine map_side(state, thickness, x, point, n, normal)
      integer, intent(in)   :: state
      real(wp), intent(in)  :: thickness, x(:, :)
      real(wp), intent(in)  :: point(3)                 !! local coordinates of the side
      real(wp), intent(out) :: n(max_side_nodes)        !! [-]
      real(wp), intent(out) :: normal(3)                !! [length^2]
      real(wp) :: values(max_nodes), dn(3, max_nodes), a(3), b(3), scale
      integer  :: i, kind

      kind = side_kind(size(x, 1), size(x, 2))
      call shape_values(kind, point, values)
      call shape_derivatives(kind, point, dn)
      n = values(:max_side_nodes)
      if (state >= solid) then
         a = 0.0_wp
         b = 0.0_wp
         do i = 1, size(x, 2)
            a = a + dn(1, i)*x(:3, i)
            b = b + dn(2, i)*x(:3, i)
         end do
         normal = cross(a, b)
      else
         scale = thickness
         if (state == axisymmetric) scale = two_pi*dot_product(n(:size(x, 2)), x(1, :))
         normal = 0.0_wp
         do i = 1, size(x, 2)
            normal(1) = normal(1) + dn(1, i)*x(2, i)
            normal(2) = normal(2) - dn(1, i)*x(1, i)
         end do
         normal = normal*scale
      end if
   end subroutine map_side

   !> {f} = integral of [B]^T [D] {expansion} (T - TREF); with incompatible modes, their parameters condensed.
   pure subroutine nodal_thermal_forces(law, x, rise, f)
      type(element_law), intent(in) :: law
      real(wp), intent(in)    :: x(:, :)      !! nodes (dimension, nodes) [length]
      real(wp), intent(in)    :: rise(:)      !! (nodes) T - TREF [temperature]
      real(wp), intent(inout) :: f(:, :)      !! (dimension, nodes) [force], set here
      type(element_map) :: map
      real(wp) :: full(max_unknowns, max_unknowns), unknown(max_unknowns)
      integer  :: d, n, n_all

      call map_element(law, x, map)
      if (map%n_modes > 0) then
         call condensed_stiffness(law, x, full, n, n_all)
         call condensed_thermal_forces(law, x, rise, full, unknown)
      else
         call integrate(law, map, rise, unknown)
      end if
      d = merge(3, 2, law%state == solid)
      f(:d, :map%n) = reshape(unknown(:d*map%n), [d, map%n])
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
      integer  :: d, i, k

      d = merge(3, 2, law%state == solid)
      stress = matmul(law%d(:3, :3), law%expansion)
      f = 0.0_wp
      call body_rule(law%kind, law%state == axisymmetric, rule)
      do k = 1, rule%n
         call map_point(law, map, rule%point(:, k), g, volume)
         call shape_values(law%kind, rule%point(:, k), n)
         warmth = rule%weight(k)*volume*dot_product(n(:map%n), rise(:map%n))
         do i = 1, map%n + map%n_modes
            f(d*(i - 1) + 1:d*i) = f(d*(i - 1) + 1:d*i) + g(:d, i)*(stress(:d)*warmth)
            if (law%state == axisymmetric) f(2*i - 1) = f(2*i - 1) + g(3, i)*(stress(3)*warmth) ! the hoop
         end do
      end do
   end subroutine integrate

end module element_loads
