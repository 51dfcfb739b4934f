!> Integration points and weights, in the local coordinates of element_kinds.
!! A rule with one point per corner has its points in the order of the corners, each in the direction of its corner from the centre.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., section 5.11; of the fifth degree in triangles and
!! tetrahedra: Stroud, Approximate calculation of multiple integrals, 1971, T2:5-1 and T3:5-1; of the sixth degree in triangles:
!! Dunavant, High degree efficient symmetrical Gaussian quadrature rules for the triangle, Int. J. Numer. Meth. Engng 21 (1985)
!! 1129-1148, p = 6, its numbers to 20 digits from the equations of the moments.
module quadrature
   use element_kinds, only: kind_pyram5, kind_tria3, kind_tria6, n_kinds, n_linear_kinds, n_shapes
   use kinds, only: wp
   implicit none
   private

   public :: body_rule, mass_rule, side_product_rule, side_rule, stress_rule, volume_rule

   integer, parameter, public :: max_points = 27

   type, public :: integration_rule
      integer  :: n                          !! number of points
      real(wp) :: point(3, max_points)       !! local coordinates of n points
      real(wp) :: weight(max_points)         !! [-]; their sum is the size of the local domain
   end type integration_rule

   real(wp), parameter, public :: gauss = 1.0_wp/sqrt(3.0_wp) !! the two Gauss points: -gauss and gauss
   !> Four points of a tetrahedron: the barycentric coordinate of the nearest corner, and that of the three other corners.
   real(wp), parameter, public :: tetra_near = (5.0_wp + 3.0_wp*sqrt(5.0_wp))/20.0_wp, tetra_far = (5.0_wp - sqrt(5.0_wp))/20.0_wp
   real(wp), parameter :: u = 1.0_wp/6.0_wp, v = 2.0_wp/3.0_wp, third = 1.0_wp/3.0_wp, o = 0.0_wp
   real(wp), parameter :: h = sqrt(0.6_wp), wm = 8.0_wp/9.0_wp, we = 5.0_wp/9.0_wp ! the three Gauss points: -h, 0, h

   type(integration_rule), parameter :: edge_2 = integration_rule(2, &
      reshape([-gauss, o, o, gauss, o, o], [3, 27], pad=[o]), reshape([real(wp) :: 1, 1], [27], pad=[o]))
   type(integration_rule), parameter :: edge_3 = integration_rule(3, &
      reshape([-h, o, o, o, o, o, h, o, o], [3, 27], pad=[o]), reshape([we, wm, we], [27], pad=[o]))
   type(integration_rule), parameter :: triangle_1 = integration_rule(1, &
      reshape([third, third, o], [3, 27], pad=[o]), reshape([0.5_wp], [27], pad=[o]))
   type(integration_rule), parameter :: triangle_3 = integration_rule(3, &
      reshape([u, u, o, v, u, o, u, v, o], [3, 27], pad=[o]), reshape([u, u, u], [27], pad=[o]))
   type(integration_rule), parameter :: quadrilateral_4 = integration_rule(4, &
      reshape(gauss*[-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], [3, 27], pad=[o]), reshape([real(wp) :: 1, 1, 1, 1], [27], pad=[o]))
   type(integration_rule), parameter :: quadrilateral_9 = integration_rule(9, &
      reshape(h*[-1, -1, 0, 0, -1, 0, 1, -1, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0], [3, 27], pad=[o]), &
      reshape([we*[we, wm, we], wm*[we, wm, we], we*[we, wm, we]], [27], pad=[o]))
   type(integration_rule), parameter :: tetrahedron_1 = integration_rule(1, &
      reshape([0.25_wp, 0.25_wp, 0.25_wp], [3, 27], pad=[o]), reshape([u], [27], pad=[o]))
   type(integration_rule), parameter :: tetrahedron_4 = integration_rule(4, &
      reshape([tetra_far, tetra_far, tetra_far, tetra_near, tetra_far, tetra_far, tetra_far, tetra_near, tetra_far, &
               tetra_far, tetra_far, tetra_near], [3, 27], pad=[o]), reshape(0.25_wp*[u, u, u, u], [27], pad=[o]))
   type(integration_rule), parameter :: wedge_6 = integration_rule(6, &
      reshape([u, u, -gauss, v, u, -gauss, u, v, -gauss, u, u, gauss, v, u, gauss, u, v, gauss], [3, 27], pad=[o]), &
      reshape([u, u, u, u, u, u], [27], pad=[o]))
   type(integration_rule), parameter :: wedge_9 = integration_rule(9, &
      reshape([u, u, -h, v, u, -h, u, v, -h, u, u, o, v, u, o, u, v, o, u, u, h, v, u, h, u, v, h], [3, 27], pad=[o]), &
      reshape(u*[we, we, we, wm, wm, wm, we, we, we], [27], pad=[o]))
   type(integration_rule), parameter :: hexahedron_8 = integration_rule(8, &
      reshape(gauss*[-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1], [3, 27], pad=[o]), &
      reshape([real(wp) :: 1, 1, 1, 1, 1, 1, 1, 1], [27], pad=[o]))
   type(integration_rule), parameter :: pyramid_1 = integration_rule(1, & ! at its centroid
      reshape([real(wp) :: 0, 0, -0.5_wp], [3, 27], pad=[o]), reshape([real(wp) :: 8], [27], pad=[o]))
   type(integration_rule), parameter :: hexahedron_27 = integration_rule(27, &
      reshape(h*[-1, -1, -1, 0, -1, -1, 1, -1, -1, -1, 0, -1, 0, 0, -1, 1, 0, -1, -1, 1, -1, 0, 1, -1, 1, 1, -1, &
                 -1, -1, 0, 0, -1, 0, 1, -1, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0, &
                 -1, -1, 1, 0, -1, 1, 1, -1, 1, -1, 0, 1, 0, 0, 1, 1, 0, 1, -1, 1, 1, 0, 1, 1, 1, 1, 1], [3, 27]), &
      [we*quadrilateral_9%weight(:9), wm*quadrilateral_9%weight(:9), we*quadrilateral_9%weight(:9)])

   ! seven points of a triangle: the centre, (a, a) and its symmetric images near the corners, and those near the middle of the
   ! sides
   real(wp), parameter :: s15 = sqrt(15.0_wp)
   real(wp), parameter :: a1 = (6.0_wp - s15)/21.0_wp, b1 = 1.0_wp - 2.0_wp*a1, w1 = (155.0_wp - s15)/2400.0_wp
   real(wp), parameter :: a2 = (6.0_wp + s15)/21.0_wp, b2 = 1.0_wp - 2.0_wp*a2, w2 = (155.0_wp + s15)/2400.0_wp, w0 = 9.0_wp/80.0_wp
   real(wp), parameter :: of_seven(7) = [w0, w1, w1, w1, w2, w2, w2]
   type(integration_rule), parameter :: triangle_7 = integration_rule(7, &
      reshape([third, third, o, a1, a1, o, b1, a1, o, a1, b1, o, a2, a2, o, b2, a2, o, a2, b2, o], [3, 27], pad=[o]), &
      reshape(of_seven, [27], pad=[o]))
   type(integration_rule), parameter :: wedge_21 = integration_rule(21, &
      reshape([third, third, -h, a1, a1, -h, b1, a1, -h, a1, b1, -h, a2, a2, -h, b2, a2, -h, a2, b2, -h, &
               third, third, o, a1, a1, o, b1, a1, o, a1, b1, o, a2, a2, o, b2, a2, o, a2, b2, o, &
               third, third, h, a1, a1, h, b1, a1, h, a1, b1, h, a2, a2, h, b2, a2, h, a2, b2, h], [3, 27], pad=[o]), &
      reshape([we*of_seven, wm*of_seven, we*of_seven], [27], pad=[o]))

   ! twelve points of a triangle: two sets (a, a) and one set (x, y), each with its symmetric images
   real(wp), parameter :: a3 = 0.2492867451709104212916_wp, b3 = 1.0_wp - 2.0_wp*a3, w3 = 0.05839313786318968301264_wp
   real(wp), parameter :: a4 = 0.06308901449150222834033_wp, b4 = 1.0_wp - 2.0_wp*a4, w4 = 0.02542245318510340846047_wp
   real(wp), parameter :: x5 = 0.05314504984481694735325_wp, y5 = 0.3103524510337844054166_wp, z5 = 1.0_wp - x5 - y5
   real(wp), parameter :: w5 = 0.04142553780918678759678_wp
   type(integration_rule), parameter :: triangle_12 = integration_rule(12, &
      reshape([a3, a3, o, b3, a3, o, a3, b3, o, a4, a4, o, b4, a4, o, a4, b4, o, &
               x5, y5, o, y5, x5, o, x5, z5, o, z5, x5, o, y5, z5, o, z5, y5, o], [3, 27], pad=[o]), &
      reshape([w3, w3, w3, w4, w4, w4, w5, w5, w5, w5, w5, w5], [27], pad=[o]))

   ! fifteen points of a tetrahedron: the centre, two sets near corners and faces, one set near the edges
   real(wp), parameter :: c1 = (7.0_wp - s15)/34.0_wp, d1 = 1.0_wp - 3.0_wp*c1, v1 = (2665.0_wp + 14.0_wp*s15)/226800.0_wp
   real(wp), parameter :: c2 = (7.0_wp + s15)/34.0_wp, d2 = 1.0_wp - 3.0_wp*c2, v2 = (2665.0_wp - 14.0_wp*s15)/226800.0_wp
   real(wp), parameter :: e1 = (5.0_wp - s15)/20.0_wp, e2 = 0.5_wp - e1, v0 = 8.0_wp/405.0_wp, v3 = 5.0_wp/567.0_wp, q = 0.25_wp
   type(integration_rule), parameter :: tetrahedron_15 = integration_rule(15, &
      reshape([q, q, q, c1, c1, c1, d1, c1, c1, c1, d1, c1, c1, c1, d1, c2, c2, c2, d2, c2, c2, c2, d2, c2, c2, c2, d2, &
               e1, e1, e2, e1, e2, e1, e2, e1, e1, e1, e2, e2, e2, e1, e2, e2, e2, e1], [3, 27], pad=[o]), &
      reshape([v0, v1, v1, v1, v1, v2, v2, v2, v2, v3, v3, v3, v3, v3, v3], [27], pad=[o]))

   type(integration_rule), parameter :: none = integration_rule(0, o, o)
   type(integration_rule), parameter :: of_body(0:n_kinds) = &
      [none, triangle_1, quadrilateral_4, tetrahedron_1, wedge_6, hexahedron_8, &
       hexahedron_8, & ! a pyramid is a hexahedron whose upper corners are one
       triangle_3, quadrilateral_9, tetrahedron_4, wedge_9, hexahedron_27]
   type(integration_rule), parameter :: of_volume(n_linear_kinds + 1:n_kinds) = &
      [triangle_7, quadrilateral_9, tetrahedron_15, wedge_21, hexahedron_27]
   type(integration_rule), parameter :: of_stress(n_kinds) = &
      [of_body(1:5), pyramid_1, triangle_3, quadrilateral_4, tetrahedron_4, wedge_6, hexahedron_8]
   type(integration_rule), parameter :: of_side(0:n_shapes) = &
      [none, triangle_3, quadrilateral_4, none, none, none, none, triangle_7, quadrilateral_9, none, none, none, edge_2, edge_3]

contains

   !> The rule for the stiffness of an element. It is exact for an undistorted element, whose nodes lie at the middle of straight
   !! edges, except for the hoop strain of an axisymmetric model. For a linear element it also integrates the volume and the nodal
   !! forces of a constant body force exactly.
   pure subroutine body_rule(kind, axisymmetric, rule)
      integer, intent(in) :: kind            !! kind_tria3 ... kind_hexa20; 0: no points
      logical, intent(in) :: axisymmetric    !! a triangle then needs more points, because the integrand contains r
      type(integration_rule), intent(out) :: rule

      if (axisymmetric .and. kind == kind_tria3) then
         call take(triangle_3, rule)
      else if (axisymmetric .and. kind == kind_tria6) then
         call take(triangle_7, rule)
      else
         call take(of_body(kind), rule)
      end if
   end subroutine body_rule

   !> Copy to RULE the points of a TABLE; points beyond its number are not copied, because most rules have few.
   pure subroutine take(table, rule)
      type(integration_rule), intent(in)    :: table
      type(integration_rule), intent(inout) :: rule

      rule%n = table%n
      rule%point(:, :table%n) = table%point(:, :table%n)
      rule%weight(:table%n) = table%weight(:table%n)
   end subroutine take

   !> The rule for integrals of shape functions over the body of an element, forces and masses. For an undistorted second-order
   !! element it integrates products of two shape functions exactly.
   pure subroutine volume_rule(kind, axisymmetric, rule)
      integer, intent(in) :: kind            !! kind_tria3 ... kind_hexa20
      logical, intent(in) :: axisymmetric
      type(integration_rule), intent(out) :: rule

      if (kind <= n_linear_kinds) call body_rule(kind, axisymmetric, rule)
      if (kind > n_linear_kinds) call take(of_volume(kind), rule)
   end subroutine volume_rule

   !> The rule for products of two shape functions over the body of an element: that of the second-order kind with the same
   !! corners, of a pyramid that of the hexahedron. The mass of a linear element of any shape is exact, and so are its first and
   !! second moments.
   pure subroutine mass_rule(kind, rule)
      integer, intent(in) :: kind            !! kind_tria3 ... kind_hexa20
      type(integration_rule), intent(out) :: rule

      if (kind == kind_pyram5) then
         call take(hexahedron_27, rule)
      else
         call volume_rule(merge(kind + n_linear_kinds, kind, kind <= n_linear_kinds), .false., rule)
      end if
   end subroutine mass_rule

   !> The points at which stresses are evaluated for extrapolation to the nodes, one per corner or one alone: there second-order
   !! elements have their most accurate strains. Source: Barlow, Optimal stress locations in finite element models, Int. J. Numer.
   !! Meth. Engng 10 (1976) 243-251.
   pure subroutine stress_rule(kind, axisymmetric, rule)
      integer, intent(in) :: kind            !! kind_tria3 ... kind_hexa20
      logical, intent(in) :: axisymmetric    !! a triangle then has three points
      type(integration_rule), intent(out) :: rule

      call take(of_stress(merge(kind_tria6, kind, kind == kind_tria3 .and. axisymmetric)), rule)
   end subroutine stress_rule

   !> The rule over a side: exact for the forces of a pressure that the shape functions interpolate, on edges of rings too, and of a
   !! constant pressure on curved sides.
   pure subroutine side_rule(kind, rule)
      integer, intent(in) :: kind            !! of the side, from side_kind; 0: no points
      type(integration_rule), intent(out) :: rule

      call take(of_side(kind), rule)
   end subroutine side_rule

   !> The rule over the triangles of a subdivided face, for products of two shape functions: of degree 4 for faces with up to four
   !! nodes (MOST_NODES), of degree 6 for faces with eight.
   pure subroutine side_product_rule(most_nodes, rule)
      integer, intent(in) :: most_nodes
      type(integration_rule), intent(out) :: rule

      if (most_nodes == 8) call take(triangle_12, rule)
      if (most_nodes /= 8) call take(triangle_7, rule)
   end subroutine side_product_rule

end module quadrature
