!> Isoparametric elements, plane, axisymmetric and solid: stiffness, mass and nodal forces of loads.
!! Linear elements have incompatible modes on request. The consistent mass is the integral of N_i N_j over the body, the same for
!! every component of the displacements; the lumped mass is diagonal. Nodal forces are consistent: body forces over an element,
!! pressures over its sides; a tributary area is the nodal force of a unit pressure. The temperature is interpolated by the shape
!! functions from nodal values. Thermal loads are integrated with the rule of the stiffness, so that an unconstrained element of any
!! shape has no stress under a uniform temperature.
!! Sources: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., chapters 2, 5 and 6, initial strains in section 2.2;
!! Taylor, Beresford, Wilson 1976; consistent mass: Archer, J. Struct. Div. ASCE 89 (1963) 161-178; lumped mass, positive for
!! second-order elements too: Hinton, Rock, Zienkiewicz, Earthquake Engng Struct. Dyn. 4 (1976) 245-249.
module isoparametric
   use elasticity, only: axisymmetric, max_stresses, solid, strain_of
   use element_kinds, only: element_table, max_nodes, max_side_nodes, side_kind
   use element_mapping, only: element_law, element_map, map_element, map_point, max_shapes, two_pi
   use kinds, only: wp
   use numbers, only: cross
   use quadrature, only: body_rule, integration_rule, mass_rule, side_rule, volume_rule
   use shape_functions, only: shape_derivatives, shape_values
   implicit none
   private

   public :: stiffness, condensed_stiffness, shape_products, lump, body_forces, side_areas, side_forces, nodal_thermal_forces, &
             condensed_thermal_forces

   integer, parameter, public :: max_unknowns = 3*max_shapes         !! components of nodes and parameters of modes
   integer, parameter         :: max_pairs = max_shapes*(max_shapes + 1)/2

contains

   !> [k] = integral of [B]^T [D] [B]; the parameters of incompatible modes are condensed.
   pure subroutine stiffness(law, x, k)
      type(element_law), intent(in) :: law
      real(wp), intent(in)          :: x(:, :)   !! nodes (dimension, nodes), of positive volume, r >= 0 [length]
      real(wp), intent(inout)       :: k(:, :)   !! (dimension*nodes, dimension*nodes), set here; u_x, u_y (, u_z) of node 1,
                                                 !! of node 2, ... [force/length]; of an axisymmetric body for the whole ring
      real(wp) :: full(max_unknowns, max_unknowns)
      integer  :: i, j, n, n_all

      call condensed_stiffness(law, x, full, n, n_all)
      do j = 1, n
         do i = 1, j
            k(i, j) = full(i, j)
            k(j, i) = full(i, j)
         end do
      end do
   end subroutine stiffness

   !> The upper triangle of [k] with the modes condensed. The columns beyond the unknowns of the nodes give the parameters of the
   !! modes: q(p) = -sum of full(:p-1, p) q(:p-1)/full(p, p), for p from N + 1 to N_ALL in turn.
   pure subroutine condensed_stiffness(law, x, full, n, n_all)
      type(element_law), intent(in) :: law
      real(wp), intent(in)          :: x(:, :)                              !! as in stiffness
      real(wp), intent(inout)       :: full(max_unknowns, max_unknowns)     !! [force/length]
      integer, intent(out)          :: n, n_all                             !! unknowns of the nodes; of nodes and modes
      type(element_map)      :: map
      type(integration_rule) :: rule
      real(wp) :: products(3, 3, max_pairs), factor, g(3, max_shapes), volume, w, w1, w2, w3
      integer  :: i, j, k, p, pair, shapes
      logical  :: has_three

      ! integrals of g_a(i) g_b(j) in (a, b) for all pairs of shape functions i <= j, (1,1), (1,2), (2,2), (1,3), ...; for a plane
      ! body of two components
      call map_element(law, x, map)
      has_three = law%state == solid .or. law%state == axisymmetric
      shapes = map%n + map%n_modes
      products(:, :, :shapes*(shapes + 1)/2) = 0.0_wp
      call body_rule(law%kind, law%state == axisymmetric, rule)
      do k = 1, rule%n
         call map_point(law, map, rule%point(:, k), g, volume)
         w = rule%weight(k)*volume
         pair = 0
         do j = 1, shapes
            w1 = w*g(1, j)
            w2 = w*g(2, j)
            if (has_three) w3 = w*g(3, j)
            do i = 1, j
               pair = pair + 1
               products(1, 1, pair) = products(1, 1, pair) + g(1, i)*w1
               products(2, 1, pair) = products(2, 1, pair) + g(2, i)*w1
               products(1, 2, pair) = products(1, 2, pair) + g(1, i)*w2
               products(2, 2, pair) = products(2, 2, pair) + g(2, i)*w2
               if (.not. has_three) cycle
               products(3, 1, pair) = products(3, 1, pair) + g(3, i)*w1
               products(3, 2, pair) = products(3, 2, pair) + g(3, i)*w2
               products(1, 3, pair) = products(1, 3, pair) + g(1, i)*w3
               products(2, 3, pair) = products(2, 3, pair) + g(2, i)*w3
               products(3, 3, pair) = products(3, 3, pair) + g(3, i)*w3
            end do
         end do
      end do
      call assemble(law, shapes, products, full)
      associate (d => merge(3, 2, law%state == solid))
         n = d*map%n
         n_all = n + d*map%n_modes
      end associate
      do p = n_all, n + 1, -1
         do j = 1, p - 1
            factor = full(j, p)/full(p, p)
            do i = 1, j
               full(i, j) = full(i, j) - factor*full(i, p)
            end do
         end do
      end do
   end subroutine condensed_stiffness

   !> [B_i]^T [D] [B_j] of a solid with any [D]; G(a, b) = integral of the products of the derivatives of N_i along a and N_j along b.
   pure function coupled_block(d, g) result(block)
      real(wp), intent(in) :: d(:, :), g(3, 3)
      real(wp) :: block(3, 3)
      integer  :: a, b, p

      block = 0.0_wp
      do b = 1, 3
         do a = 1, 3
            do p = 1, 3
               block(p, :) = block(p, :) + d(strain_of(p, a), strain_of(:, b))*g(a, b)
            end do
         end do
      end do
   end function coupled_block

   !> [B_i]^T [D] [B_j] for all i <= j of N shape functions. Strains in the plane: xx = g_x u, yy = g_y v, xy = g_y u + g_x v;
   !! axisymmetric: rr = g_r u, zz = g_z v, theta theta = h u, rz = g_z u + g_r v, where h = N/r; of a solid: xx = g_x u,
   !! yy = g_y v, zz = g_z w, xy = g_y u + g_x v, yz = g_z v + g_y w, zx = g_x w + g_z u.
   pure subroutine assemble(law, n, products, full)
      type(element_law), intent(in) :: law
      integer, intent(in)           :: n
      real(wp), intent(in)          :: products(3, 3, max_pairs)
      real(wp), intent(inout)       :: full(max_unknowns, max_unknowns)     !! upper triangle; the lower one is undefined
      integer :: c, components, i, j, pair, r

      components = merge(3, 2, law%state == solid)
      pair = 0
      do j = 1, n
         do i = 1, j
            pair = pair + 1
            r = components*(i - 1) + 1
            c = components*(j - 1) + 1
            associate (d => law%d, g => products(:, :, pair))
               select case (law%state)
               case (solid)
                  if (law%is_coupled) then
                     full(r:r + 2, c:c + 2) = coupled_block(d, g)
                     cycle
                  end if
                  full(r, c) = d(1, 1)*g(1, 1) + d(4, 4)*g(2, 2) + d(6, 6)*g(3, 3)
                  full(r + 1, c) = d(2, 1)*g(2, 1) + d(4, 4)*g(1, 2)
                  full(r + 2, c) = d(3, 1)*g(3, 1) + d(6, 6)*g(1, 3)
                  full(r, c + 1) = d(1, 2)*g(1, 2) + d(4, 4)*g(2, 1)
                  full(r + 1, c + 1) = d(2, 2)*g(2, 2) + d(4, 4)*g(1, 1) + d(5, 5)*g(3, 3)
                  full(r + 2, c + 1) = d(3, 2)*g(3, 2) + d(5, 5)*g(2, 3)
                  full(r, c + 2) = d(1, 3)*g(1, 3) + d(6, 6)*g(3, 1)
                  full(r + 1, c + 2) = d(2, 3)*g(2, 3) + d(5, 5)*g(3, 2)
                  full(r + 2, c + 2) = d(3, 3)*g(3, 3) + d(5, 5)*g(2, 2) + d(6, 6)*g(1, 1)
               case (axisymmetric)
                  full(r, c) = d(1, 1)*g(1, 1) + d(1, 3)*g(1, 3) + d(3, 1)*g(3, 1) + d(3, 3)*g(3, 3) + d(4, 4)*g(2, 2)
                  full(r + 1, c) = d(2, 1)*g(2, 1) + d(2, 3)*g(2, 3) + d(4, 4)*g(1, 2)
                  full(r, c + 1) = d(1, 2)*g(1, 2) + d(3, 2)*g(3, 2) + d(4, 4)*g(2, 1)
                  full(r + 1, c + 1) = d(2, 2)*g(2, 2) + d(4, 4)*g(1, 1)
               case default
                  full(r, c) = d(1, 1)*g(1, 1) + d(3, 3)*g(2, 2)
                  full(r + 1, c) = d(2, 1)*g(2, 1) + d(3, 3)*g(1, 2)
                  full(r, c + 1) = d(1, 2)*g(1, 2) + d(3, 3)*g(2, 1)
                  full(r + 1, c + 1) = d(2, 2)*g(2, 2) + d(3, 3)*g(1, 1)
               end select
            end associate
         end do
      end do
   end subroutine assemble

   !> M(i, j) = integral of N_i N_j over the element; over the whole ring of an axisymmetric element [length^3].
   pure subroutine shape_products(law, x, m)
      type(element_law), intent(in) :: law
      real(wp), intent(in)          :: x(:, :) !! nodes (dimension, nodes) [length]
      real(wp), intent(inout)       :: m(:, :) !! (nodes, nodes), set here
      type(element_map)      :: map
      type(integration_rule) :: rule
      real(wp) :: g(3, max_shapes), n(max_nodes), volume
      integer  :: i, j

      call map_element(law, x, map)
      call mass_rule(law%kind, rule)
      associate (nodes => map%n)
         m(:nodes, :nodes) = 0.0_wp
         do i = 1, rule%n
            call map_point(law, map, rule%point(:, i), g, volume)
            call shape_values(law%kind, rule%point(:, i), n)
            do j = 1, nodes
               m(:nodes, j) = m(:nodes, j) + n(:nodes)*(n(j)*(rule%weight(i)*volume))
            end do
         end do
      end associate
   end subroutine shape_products

   !> Lump the mass matrix M: keep its diagonal, scaled so that the total mass remains.
   pure subroutine lump(m)
      real(wp), intent(inout) :: m(:, :)
      real(wp) :: diagonal(size(m, 1)), total
      integer  :: i

      do i = 1, size(m, 1)
         diagonal(i) = m(i, i)
      end do
      total = sum(m)
      m = 0.0_wp
      do i = 1, size(m, 1)
         m(i, i) = diagonal(i)*(total/sum(diagonal))
      end do
   end subroutine lump

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

   !> Tributary areas of one side, a_i = integral of N_i: an edge of a plane or axisymmetric body, a triangle or a
   !! quadrilateral of a solid. Their sum is the area of the side. At the corners of second-order faces they are not positive.
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

   !> Nodal forces of a pressure on one side, positive towards the body, opposite to the outward normal; or of a traction along a
   !! DIRECTION. The shape functions interpolate the pressure between its nodal values. With a pressure of -1 at all nodes
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

   !> Shape functions at a point of a side, and the outward normal there, whose length is the area per unit of weight.
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

   !> {f} = integral of [B]^T [D] {expansion} (T - TREF); the parameters of incompatible modes are condensed.
   pure subroutine nodal_thermal_forces(law, x, rise, f)
      type(element_law), intent(in) :: law
      real(wp), intent(in)    :: x(:, :)      !! nodes (dimension, nodes) [length]
      real(wp), intent(in)    :: rise(:)      !! (nodes) T - TREF [temperature]
      real(wp), intent(inout) :: f(:, :)      !! (dimension, nodes) [force], set here
      real(wp) :: full(max_unknowns, max_unknowns), unknown(max_unknowns)
      integer  :: d, n, n_all

      if (law%incompatible) call condensed_stiffness(law, x, full, n, n_all)
      call condensed_thermal_forces(law, x, rise, full, unknown)
      d = merge(3, 2, law%state == solid)
      n = element_table(law%kind)%n_nodes
      f(:d, :n) = reshape(unknown(:d*n), [d, n])
   end subroutine nodal_thermal_forces

   !> The thermal forces on the unknowns of nodes and modes. The force on mode p has the modes behind p condensed, as in the
   !! condensation of the stiffness; the forces on nodes have all modes condensed.
   pure subroutine condensed_thermal_forces(law, x, rise, full, f)
      type(element_law), intent(in) :: law
      real(wp), intent(in)  :: x(:, :), rise(:)                         !! as above
      real(wp), intent(in)  :: full(max_unknowns, max_unknowns)         !! from condensed_stiffness; not used without modes
      real(wp), intent(out) :: f(max_unknowns)                          !! [force]
      type(element_map)      :: map
      type(integration_rule) :: rule
      real(wp) :: g(3, max_shapes), n(max_nodes), of_all(max_stresses), stress(3), volume, weighted_rise
      integer  :: d, i, k, p

      call map_element(law, x, map)
      d = merge(3, 2, law%state == solid)
      stress = matmul(law%d(:3, :3), law%expansion(:3))
      of_all = 0.0_wp
      if (law%is_coupled) of_all = matmul(law%d, law%expansion)
      f = 0.0_wp
      call body_rule(law%kind, law%state == axisymmetric, rule)
      do k = 1, rule%n
         call map_point(law, map, rule%point(:, k), g, volume)
         call shape_values(law%kind, rule%point(:, k), n)
         weighted_rise = rule%weight(k)*volume*dot_product(n(:map%n), rise(:map%n))
         do i = 1, map%n + map%n_modes
            if (law%is_coupled) then
               f(3*i - 2:3*i) = f(3*i - 2:3*i) + matmul(reshape(of_all(pack(strain_of, .true.)), [3, 3]), g(:, i))*weighted_rise
               cycle
            end if
            f(d*(i - 1) + 1:d*i) = f(d*(i - 1) + 1:d*i) + g(:d, i)*(stress(:d)*weighted_rise)
            if (law%state == axisymmetric) f(2*i - 1) = f(2*i - 1) + g(3, i)*(stress(3)*weighted_rise) ! the hoop
         end do
      end do
      do p = d*(map%n + map%n_modes), d*map%n + 1, -1
         f(:p - 1) = f(:p - 1) - full(:p - 1, p)*(f(p)/full(p, p))
      end do
   end subroutine condensed_thermal_forces

end module isoparametric
