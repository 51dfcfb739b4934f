!> Integration points and weights, in the local coordinates of shape_functions. The points of a rule with as many points as
!! corners stand in the order of the corners, each in the direction of its corner from the centre.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., section 5.11.
module quadrature
   use element_kinds, only: kind_tria3, max_nodes, n_kinds
   use kinds, only: wp
   implicit none
   private

   public :: body_rule, side_rule

   type, public :: integration_rule
      integer  :: n                          !! points
      real(wp) :: point(3, max_nodes)        !! local coordinates, 0 beyond n
      real(wp) :: weight(max_nodes)          !! [-], their sum is the size of the local domain; 0 beyond n
   end type integration_rule

   real(wp), parameter, public :: gauss = 1.0_wp/sqrt(3.0_wp) !! the two points of Gauss are -gauss and gauss
   real(wp), parameter :: u = 1.0_wp/6.0_wp, v = 2.0_wp/3.0_wp, third = 1.0_wp/3.0_wp, o = 0.0_wp

   type(integration_rule), parameter :: edge_2 = integration_rule(2, &
      reshape([-gauss, o, o, gauss, o, o], [3, 8], pad=[o]), [1, 1, 0, 0, 0, 0, 0, 0])
   type(integration_rule), parameter :: triangle_1 = integration_rule(1, &
      reshape([third, third, o], [3, 8], pad=[o]), [0.5_wp, o, o, o, o, o, o, o])
   type(integration_rule), parameter :: triangle_3 = integration_rule(3, &
      reshape([u, u, o, v, u, o, u, v, o], [3, 8], pad=[o]), [u, u, u, o, o, o, o, o])
   type(integration_rule), parameter :: quadrilateral_4 = integration_rule(4, &
      reshape(gauss*[-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], [3, 8], pad=[o]), [1, 1, 1, 1, 0, 0, 0, 0])
   type(integration_rule), parameter :: tetrahedron_1 = integration_rule(1, &
      reshape([0.25_wp, 0.25_wp, 0.25_wp], [3, 8], pad=[o]), [u, o, o, o, o, o, o, o])
   type(integration_rule), parameter :: wedge_6 = integration_rule(6, &
      reshape([u, u, -gauss, v, u, -gauss, u, v, -gauss, u, u, gauss, v, u, gauss, u, v, gauss], [3, 8], pad=[o]), &
      [u, u, u, u, u, u, o, o])
   type(integration_rule), parameter :: hexahedron_8 = integration_rule(8, &
      reshape(gauss*[-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], [3, 8]), &
      [1, 1, 1, 1, 1, 1, 1, 1])

   type(integration_rule), parameter :: none = integration_rule(0, o, o)
   type(integration_rule), parameter :: of_body(0:n_kinds) = &
      [none, triangle_1, quadrilateral_4, tetrahedron_1, wedge_6, hexahedron_8]
   type(integration_rule), parameter :: of_side(4) = [none, edge_2, triangle_3, quadrilateral_4]

contains

   !> The rule over the body of an element. It integrates the volume, the nodal forces of a constant body force and, where
   !! strains are constant, the stiffness exactly, in an axisymmetric model too.
   pure subroutine body_rule(kind, axisymmetric, rule)
      integer, intent(in) :: kind            !! kind_tria3 ... kind_hexa8; 0: no points
      logical, intent(in) :: axisymmetric    !! a triangle then needs three points, for the radius in the integrand
      type(integration_rule), intent(out) :: rule

      rule = of_body(kind)
      if (kind == kind_tria3 .and. axisymmetric) rule = triangle_3
   end subroutine body_rule

   !> The rule over a side: an edge (2 nodes, coordinate from -1 to 1), a triangle (3) or a quadrilateral (4); 1: no points.
   pure subroutine side_rule(n_nodes, rule)
      integer, intent(in) :: n_nodes
      type(integration_rule), intent(out) :: rule

      rule = of_side(n_nodes)
   end subroutine side_rule

end module quadrature
