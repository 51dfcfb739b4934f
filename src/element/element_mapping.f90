!> The map from local to global coordinates (gradients, volumes, shape checks) and the material law of an element.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., section 5.5; the incompatible modes: Taylor,
!! Beresford, Wilson, A non-conforming element for stress analysis, Int. J. Numer. Meth. Engng 10 (1976) 1211-1219.
module element_mapping
   use elasticity, only: axisymmetric, elasticity_matrix, max_stresses, plane_strain, solid
   use element_kinds, only: centre_point, element_table, is_second_order, kind_hexa8, kind_penta6, kind_quad4, max_nodes, &
                            node_point, side_kind
   use kinds, only: wp
   use numbers, only: cross
   use quadrature, only: body_rule, integration_rule, max_points, side_rule, volume_rule
   use shape_functions, only: shape_derivatives, shape_values
   use tolerances, only: degenerate
   implicit none
   private

   public :: has_modes, make_element_law, map_element, map_point, smallest_jacobian

   integer, parameter, public  :: max_shapes = max_nodes     !! shape functions of an element, incompatible modes included
   real(wp), parameter, public :: two_pi = 2.0_wp*acos(-1.0_wp)

   !> What elements of one kind, property and material have in common. The arrays have no default, because one is made for every
   !! element.
   type, public :: element_law
      integer  :: kind = 0                                !! kind_tria3 ... kind_hexa20
      integer  :: state = 0                               !! plane_stress ... solid
      real(wp) :: thickness = 1.0_wp                      !! of a plane body [length]; not used by the others
      logical  :: incompatible = .false.                  !! with the modes of Wilson and Taylor, if the kind has them
      logical  :: is_coupled = .false.                    !! a solid that is not orthotropic along the axes
      real(wp) :: d(max_stresses, max_stresses)           !! [D]: unless coupled, orthotropic along the axes [pressure]
      real(wp) :: expansion(max_stresses)                 !! free thermal strains per degree [1/temperature]
   end type element_law

   !> The nodes of one element and the quantities that are the same at all its points. The arrays have no default.
   type, public :: element_map
      integer  :: n = 0                                   !! number of nodes
      integer  :: n_modes = 0                             !! number of incompatible modes, each with one parameter per component
      real(wp) :: x(3, max_nodes)                         !! coordinates; only the components and nodes of the kind are set [length]
      real(wp) :: inverse(3, 3)                           !! of the Jacobian matrix at the centre [1/length], with modes
      real(wp) :: jacobian = 0.0_wp                       !! det J at the centre, with modes
   end type element_map

contains

   !> The law of an element of isotropic material. In plane strain the suppressed expansion alpha normal to the plane adds nu alpha
   !! to the free thermal strains in the plane.
   pure type(element_law) function make_element_law(kind, state, e, nu, thickness, incompatible, alpha) result(law)
      integer, intent(in)  :: kind, state                 !! kind_tria3 ... kind_hexa20; plane_stress ... solid
      real(wp), intent(in) :: e, nu                       !! [pressure], > 0; [-], -1 < nu < 0.5
      real(wp), intent(in) :: thickness                   !! of a plane body [length], > 0
      logical, intent(in)  :: incompatible                !! requested; linear quadrilaterals, hexahedra and wedges have modes
      real(wp), intent(in), optional :: alpha             !! thermal expansion, 0 [1/temperature]

      law%kind = kind
      law%state = state
      law%thickness = thickness
      law%incompatible = incompatible .and. has_modes(kind, state)
      call elasticity_matrix(state, e, nu, law%d)
      law%expansion = 0.0_wp
      if (.not. present(alpha)) return
      law%expansion(:2) = merge((1.0_wp + nu)*alpha, alpha, state == plane_strain)
      if (state == axisymmetric .or. state == solid) law%expansion(3) = alpha
   end function make_element_law

   !> Whether elements of a KIND in a STATE of stress can have incompatible modes. Linear quadrilaterals, hexahedra and wedges can:
   !! they represent bending poorly. Linear triangles and tetrahedra have constant strain, which the modes cannot improve. In an
   !! axisymmetric element the modes of the quadrilateral have a hoop strain that fails the patch test.
   pure logical function has_modes(kind, state)
      integer, intent(in) :: kind, state

      has_modes = kind == kind_hexa8 .or. kind == kind_penta6 .or. (kind == kind_quad4 .and. state /= axisymmetric)
   end function has_modes

   !> Set up the map of an element from its nodes.
   pure subroutine map_element(law, x, map)
      type(element_law), intent(in)  :: law
      real(wp), intent(in)           :: x(:, :)           !! nodes (dimension, nodes) in the order of the card [length]
      type(element_map), intent(out) :: map
      real(wp) :: dn(3, max_nodes)
      integer  :: d

      d = element_table(law%kind)%dimension
      map%n = element_table(law%kind)%n_nodes
      map%x(:d, :map%n) = x(:d, :map%n)
      if (.not. law%incompatible) return
      map%n_modes = merge(4, d, law%kind == kind_penta6)
      call shape_derivatives(law%kind, centre_point(:, law%kind), dn)
      call invert_jacobian(d, map%n, map%x, dn, map%inverse, map%jacobian)
   end subroutine map_element

   !> Gradients at a point and the volume per unit of weight there. The first components are d/dx, d/dy, d/dz; in an axisymmetric
   !! body the third is N/r, which gives the hoop strain. The incompatible modes follow the nodes. Their gradients are formed with J
   !! at the centre and the ratio of the determinants, so that their integral over an element of any shape is zero: this satisfies
   !! the patch test.
   pure subroutine map_point(law, map, point, g, volume)
      type(element_law), intent(in) :: law
      type(element_map), intent(in) :: map
      real(wp), intent(in)    :: point(3)                 !! local coordinates
      real(wp), intent(inout) :: g(3, max_shapes)         !! of nodes, then of modes [1/length]; two rows are set in the plane
      real(wp), intent(out)   :: volume                   !! [length^3]; det J times thickness, 2 pi r or 1
      real(wp) :: dn(3, max_nodes), dm(3, 4), n(max_nodes), inverse(3, 3), jacobian, radius, from_mean(2)
      integer  :: d, i, k

      call shape_derivatives(law%kind, point, dn)
      if (law%state == solid) then
         call invert_jacobian(3, map%n, map%x, dn, inverse, jacobian)
         do i = 1, map%n
            do k = 1, 3
               g(k, i) = inverse(k, 1)*dn(1, i) + inverse(k, 2)*dn(2, i) + inverse(k, 3)*dn(3, i)
            end do
         end do
         volume = jacobian
      else
         call invert_jacobian(2, map%n, map%x, dn, inverse, jacobian)
         do i = 1, map%n
            g(1, i) = inverse(1, 1)*dn(1, i) + inverse(1, 2)*dn(2, i)
            g(2, i) = inverse(2, 1)*dn(1, i) + inverse(2, 2)*dn(2, i)
         end do
         volume = jacobian*law%thickness
      end if
      if (law%state == axisymmetric) then
         call shape_values(law%kind, point, n)
         radius = dot_product(n(:map%n), map%x(1, :map%n))
         g(3, :map%n) = n(:map%n)/radius
         volume = jacobian*two_pi*radius
      end if
      if (map%n_modes == 0) return
      d = element_table(law%kind)%dimension
      ! dm(j, i), the derivatives of mode i, are zero at the centre, and their integrals over the element are zero. Quadrilateral
      ! and hexahedron: 1 - r**2, 1 - s**2, 1 - t**2. Wedge: 1 - t**2, and the three quadratic functions of the triangle without
      ! their mean linear part; all three are used, so that no corner is preferred
      dm = 0.0_wp
      if (law%kind == kind_penta6) then
         from_mean = point(:2) - 1.0_wp/3.0_wp
         dm(:, :3) = reshape([2.0_wp*from_mean(1), 0.0_wp, 0.0_wp, 0.0_wp, 2.0_wp*from_mean(2), 0.0_wp, &
                              from_mean(2), from_mean(1), 0.0_wp], [3, 3])
         dm(3, 4) = -2.0_wp*point(3)
      else
         do i = 1, 3
            dm(i, i) = -2.0_wp*point(i)
         end do
      end if
      do i = 1, map%n_modes
         do k = 1, d
            g(k, map%n + i) = sum(map%inverse(k, :d)*dm(:d, i))*(map%jacobian/jacobian)
         end do
      end do
   end subroutine map_point

   !> The derivatives of the local coordinates, and det J: d/dx_b = sum over a of inverse(b, a) d/d(local a).
   pure subroutine invert_jacobian(dimension, n, x, dn, inverse, jacobian)
      integer, intent(in)     :: dimension, n
      real(wp), intent(in)    :: x(3, max_nodes)          !! nodes [length]
      real(wp), intent(in)    :: dn(3, max_nodes)         !! as from shape_derivatives
      real(wp), intent(inout) :: inverse(3, 3)            !! dimension rows and columns are set [1/length]
      real(wp), intent(out)   :: jacobian                 !! [length^dimension], not zero
      real(wp) :: j(3, 3)

      call jacobian_matrix(dimension, n, x, dn, j, jacobian)
      if (dimension == 2) then
         inverse(1, 1) = j(2, 2)/jacobian
         inverse(1, 2) = -j(2, 1)/jacobian
         inverse(2, 1) = -j(1, 2)/jacobian
         inverse(2, 2) = j(1, 1)/jacobian
      else
         inverse(:, 1) = cross(j(:, 2), j(:, 3))/jacobian
         inverse(:, 2) = cross(j(:, 3), j(:, 1))/jacobian
         inverse(:, 3) = cross(j(:, 1), j(:, 2))/jacobian
      end if
   end subroutine invert_jacobian

   !> The Jacobian matrix, j(b, a) = d x_b/d(local a), and its determinant.
   pure subroutine jacobian_matrix(dimension, n, x, dn, j, jacobian)
      integer, intent(in)     :: dimension, n
      real(wp), intent(in)    :: x(3, max_nodes), dn(3, max_nodes)
      real(wp), intent(inout) :: j(3, 3)
      real(wp), intent(out)   :: jacobian
      integer :: i

      j = 0.0_wp
      if (dimension == 2) then
         do i = 1, n
            j(:2, 1) = j(:2, 1) + dn(1, i)*x(:2, i)
            j(:2, 2) = j(:2, 2) + dn(2, i)*x(:2, i)
         end do
         jacobian = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
      else
         do i = 1, n
            j(:, 1) = j(:, 1) + dn(1, i)*x(:, i)
            j(:, 2) = j(:, 2) + dn(2, i)*x(:, i)
            j(:, 3) = j(:, 3) + dn(3, i)*x(:, i)
         end do
         jacobian = dot_product(j(:, 1), cross(j(:, 2), j(:, 3)))
      end if
   end subroutine jacobian_matrix

   !> The smallest det J over the integration points and, of a linear element, the corners. It is divided by the longest edge to the
   !! power of the dimension and scaled so that a square or cube has 1 [-]. It is zero or negative for an element that is inverted,
   !! folded, or flat to 1E-12. In a linear solid the test at the corners is stricter than any integral over its volume or sides
   !! requires: one hexahedron of the patch of MacNeal and Harder has -0.0127 there. Where det J at the corners is not positive, the
   !! integration points of the sides are tested instead, and no two corners may coincide. In a second-order element the sides are
   !! always tested and the corners never: mid-edge nodes at the quarter points, as at a crack tip, are allowed.
   pure real(wp) function smallest_jacobian(kind, x) result(smallest)
      integer, intent(in)  :: kind                        !! kind_tria3 ... kind_hexa20
      real(wp), intent(in) :: x(:, :)                     !! nodes (dimension, nodes) [length]
      type(integration_rule) :: rule
      real(wp) :: nodes(3, max_nodes), longest, elsewhere
      integer  :: d, k, n

      n = element_table(kind)%n_nodes
      d = element_table(kind)%dimension
      nodes = 0.0_wp
      nodes(:d, :n) = x(:d, :n)
      longest = 0.0_wp
      do k = 1, element_table(kind)%n_edges
         associate (edge => element_table(kind)%edges(:, k))
            longest = max(longest, sum((nodes(:, edge(2)) - nodes(:, edge(1)))**2))
         end associate
      end do
      longest = sqrt(longest)
      call body_rule(kind, .false., rule)
      smallest = least_at(kind, nodes, rule%point(:, :rule%n))
      if (.not. is_second_order(kind)) then
         elsewhere = least_at(kind, nodes, node_point(:, :n, kind))
         if (d == 3 .and. .not. elsewhere > 0.0_wp .and. smallest > 0.0_wp) elsewhere = least_on_sides(kind, nodes, longest)
      else
         elsewhere = least_on_sides(kind, nodes, longest)
         n = rule%n
         call volume_rule(kind, .false., rule)
         if (rule%n > n) elsewhere = min(elsewhere, least_at(kind, nodes, rule%point(:, :rule%n)))
      end if
      smallest = element_table(kind)%jacobian_scale*min(smallest, elsewhere)
      if (.not. (smallest > degenerate*longest**d .and. longest**d >= tiny(longest))) smallest = min(smallest, 0.0_wp)
      if (longest**d >= tiny(longest)) smallest = smallest/longest**d
   end function smallest_jacobian

   !> The smallest det J at POINTS [length^dimension].
   pure real(wp) function least_at(kind, nodes, points) result(smallest)
      integer, intent(in)  :: kind
      real(wp), intent(in) :: nodes(3, max_nodes)         !! [length]
      real(wp), intent(in) :: points(:, :)                !! (3, n) local coordinates
      real(wp) :: dn(3, max_nodes), j(3, 3), jacobian
      integer  :: k

      smallest = huge(1.0_wp)
      do k = 1, size(points, 2)
         call shape_derivatives(kind, points(:, k), dn)
         call jacobian_matrix(element_table(kind)%dimension, element_table(kind)%n_nodes, nodes, dn, j, jacobian)
         smallest = min(smallest, jacobian)
      end do
   end function least_at

   !> The smallest det J at the integration points of the sides [length^dimension]; 0 where two nodes coincide.
   pure real(wp) function least_on_sides(kind, nodes, longest) result(smallest)
      integer, intent(in)  :: kind
      real(wp), intent(in) :: nodes(3, max_nodes)         !! [length]
      real(wp), intent(in) :: longest                     !! edge [length]
      type(integration_rule) :: rule
      real(wp) :: points(3, max_points), n(max_nodes)
      integer  :: i, k, of_side, side

      smallest = huge(1.0_wp)
      do side = 1, element_table(kind)%n_sides
         associate (m => element_table(kind)%side_size(side), side_nodes_of => element_table(kind)%side_nodes(:, side))
            of_side = side_kind(element_table(kind)%dimension, m)
            call side_rule(of_side, rule)
            do i = 1, rule%n
               call shape_values(of_side, rule%point(:, i), n)
               points(:, i) = matmul(node_point(:, side_nodes_of(:m), kind), n(:m))
            end do
            smallest = min(smallest, least_at(kind, nodes, points(:, :rule%n)))
         end associate
      end do
      do i = 2, element_table(kind)%n_nodes
         if (any([(sum((nodes(:, i) - nodes(:, k))**2) <= (degenerate*longest)**2, k = 1, i - 1)])) smallest = min(smallest, 0.0_wp)
      end do
   end function least_on_sides

end module element_mapping
