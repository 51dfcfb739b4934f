!> The kinds of body element: their nodes, sides and edges, and their names in NASTRAN decks and VTK files.
!! A shell has a plane kind, a beam is an edge of two nodes.
!! Corners are numbered as on the cards: plane elements counter-clockwise; solids with the base counter-clockwise as seen
!! from the opposite face or corner, then that face in the same sense. The corners of a second-order kind are followed by the
!! mid-edge nodes, in the order of the edges below.
!! Source: MSC Nastran Quick Reference Guide, CTRIA3, CTRIA6, CQUAD4, CQUAD8, CTETRA, CPENTA, CPYRAM, CHEXA; VTK file formats,
!! linear and quadratic cell types.
!! Local coordinates of edge, quadrilateral and hexahedron: each from -1 to 1. Triangle and tetrahedron: from 0 to 1, corner 1 at
!! the origin. Wedge: a triangle in r, s, and t from -1 to 1. Pyramid: those of a hexahedron whose upper corners, t = 1, are one.
!! Mid-edge nodes lie at the middle of the edges.
module element_kinds
   use kinds, only: wp
   implicit none
   private

   public :: is_second_order, side_kind

   integer, parameter, public :: kind_tria3 = 1, kind_quad4 = 2     !! plane or axisymmetric
   integer, parameter, public :: kind_tetra4 = 3, kind_penta6 = 4, kind_hexa8 = 5, kind_pyram5 = 6
   integer, parameter, public :: kind_tria6 = 7, kind_quad8 = 8     !! second order, serendipity
   integer, parameter, public :: kind_tetra10 = 9, kind_penta15 = 10, kind_hexa20 = 11
   integer, parameter, public :: n_kinds = 11, n_linear_kinds = 6
   integer, parameter, public :: kind_edge2 = n_kinds + 1, kind_edge3 = n_kinds + 2 !! sides of plane elements, no body kinds
   integer, parameter, public :: n_shapes = n_kinds + 2             !! all kinds with shape functions: body elements and edges

   integer, parameter, public :: max_nodes = 20, max_dofs = 60      !! of one element
   integer, parameter, public :: max_section_dofs = max_dofs + 3    !! with the node of a pretension section
   integer, parameter, public :: max_sides = 6, max_side_nodes = 8, max_edges = 12

   !> The properties of one kind. Sides of plane elements are edges, in the direction that has the body on its left;
   !! sides of solids are faces, whose right-hand normal points out of the body.
   type, public :: element_kind
      character(6) :: card                                          !! name of its card; findloc finds the linear kind first
      integer :: dimension                                          !! of the element: 1 a beam, 2 plane or a shell, 3 a solid
      integer :: n_nodes
      integer :: n_corners
      integer :: linear                                             !! the linear kind with the same corners; itself if linear
      integer :: jacobian_scale                                     !! 1/det J of an element with edges of length 1 at right angles
      integer :: n_sides
      integer :: n_edges
      integer :: vtk_type                                           !! cell type; VTK orients the linear wedge in the opposite sense
      integer :: vtk_nodes(max_nodes)                               !! the nodes in the order of VTK, 0 beyond n_nodes
      integer :: edges(2, max_edges)                                !! the two corners beside mid-edge node n_corners + k
      integer :: side_corners(max_sides)                            !! number of corners of every side, 0 beyond n_sides
      integer :: side_size(max_sides)                               !! number of nodes of every side, 0 beyond n_sides
      integer :: side_nodes(max_side_nodes, max_sides)              !! corners of the side, then its mid-edge nodes from the edge
                                                                    !! between corners 1 and 2 on; 0 beyond side_size
   end type element_kind

   integer, parameter :: in_turn(max_nodes) = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20]
   integer, parameter :: upright_last_15(max_nodes) = [in_turn(:9), 13, 14, 15, 10, 11, 12, 0, 0, 0, 0, 0]
   integer, parameter :: upright_last_20(max_nodes) = [in_turn(:12), 17, 18, 19, 20, 13, 14, 15, 16]

   integer, parameter :: no(8) = 0
   integer, parameter :: tria(2, 12) = reshape([1, 2, 2, 3, 3, 1], [2, 12], pad=no)
   integer, parameter :: quad(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1], [2, 12], pad=no)
   integer, parameter :: tetra(2, 12) = reshape([1, 2, 2, 3, 3, 1, 1, 4, 2, 4, 3, 4], [2, 12], pad=no)
   integer, parameter :: penta(2, 12) = reshape([1, 2, 2, 3, 3, 1, 1, 4, 2, 5, 3, 6, 4, 5, 5, 6, 6, 4], [2, 12], pad=no)
   integer, parameter :: pyram(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 1, 5, 2, 5, 3, 5, 4, 5], [2, 12], pad=no)
   integer, parameter :: hexa(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 1, 5, 2, 6, 3, 7, 4, 8, 5, 6, 6, 7, 7, 8, 8, 5], [2, 12])

   type(element_kind), parameter, public :: element_table(n_kinds + 1) = [ &
      element_kind('CTRIA3', 2, 3, 3, kind_tria3, 1, 3, 3, 5, [in_turn(:3), no, no, 0], tria, [2, 2, 2, 0, 0, 0], &
         [2, 2, 2, 0, 0, 0], reshape([1, 2, no(:6), 2, 3, no(:6), 3, 1], [8, 6], pad=no)), &
      element_kind('CQUAD4', 2, 4, 4, kind_quad4, 4, 4, 4, 9, [in_turn(:4), no, no], quad, [2, 2, 2, 2, 0, 0], [2, 2, 2, 2, 0, 0], &
         reshape([1, 2, no(:6), 2, 3, no(:6), 3, 4, no(:6), 4, 1], [8, 6], pad=no)), &
      element_kind('CTETRA', 3, 4, 4, kind_tetra4, 1, 4, 6, 10, [in_turn(:4), no, no], tetra, [3, 3, 3, 3, 0, 0], &
         [3, 3, 3, 3, 0, 0], reshape([1, 3, 2, no(:5), 1, 2, 4, no(:5), 2, 3, 4, no(:5), 3, 1, 4], [8, 6], pad=no)), &
      element_kind('CPENTA', 3, 6, 6, kind_penta6, 2, 5, 9, 13, [1, 3, 2, 4, 6, 5, no, no(:6)], penta, [3, 3, 4, 4, 4, 0], &
         [3, 3, 4, 4, 4, 0], &
         reshape([1, 3, 2, no(:5), 4, 5, 6, no(:5), 1, 2, 5, 4, no(:4), 2, 3, 6, 5, no(:4), 3, 1, 4, 6], [8, 6], pad=no)), &
      element_kind('CHEXA ', 3, 8, 8, kind_hexa8, 8, 6, 12, 12, [in_turn(:8), no, no(:4)], hexa, [4, 4, 4, 4, 4, 4], &
         [4, 4, 4, 4, 4, 4], &
         reshape([1, 4, 3, 2, no(:4), 5, 6, 7, 8, no(:4), 1, 2, 6, 5, no(:4), 2, 3, 7, 6, no(:4), 3, 4, 8, 7, no(:4), 4, 1, 5, 8], &
                 [8, 6], pad=no)), &
      element_kind('CPYRAM', 3, 5, 5, kind_pyram5, 8, 5, 8, 14, [in_turn(:5), no, no(:7)], pyram, [4, 3, 3, 3, 3, 0], &
         [4, 3, 3, 3, 3, 0], &
         reshape([1, 4, 3, 2, no(:4), 1, 2, 5, no(:5), 2, 3, 5, no(:5), 3, 4, 5, no(:5), 4, 1, 5], [8, 6], pad=no)), &
      element_kind('CTRIA6', 2, 6, 3, kind_tria3, 1, 3, 3, 22, [in_turn(:6), no, no(:6)], tria, [2, 2, 2, 0, 0, 0], &
         [3, 3, 3, 0, 0, 0], reshape([1, 2, 4, no(:5), 2, 3, 5, no(:5), 3, 1, 6], [8, 6], pad=no)), &
      element_kind('CQUAD8', 2, 8, 4, kind_quad4, 4, 4, 4, 23, [in_turn(:8), no, no(:4)], quad, [2, 2, 2, 2, 0, 0], &
         [3, 3, 3, 3, 0, 0], reshape([1, 2, 5, no(:5), 2, 3, 6, no(:5), 3, 4, 7, no(:5), 4, 1, 8], [8, 6], pad=no)), &
      element_kind('CTETRA', 3, 10, 4, kind_tetra4, 1, 4, 6, 24, [in_turn(:10), no, 0, 0], tetra, [3, 3, 3, 3, 0, 0], &
         [6, 6, 6, 6, 0, 0], reshape([1, 3, 2, 7, 6, 5, 0, 0, 1, 2, 4, 5, 9, 8, 0, 0, 2, 3, 4, 6, 10, 9, 0, 0, &
                                      3, 1, 4, 7, 8, 10], [8, 6], pad=no)), &
      element_kind('CPENTA', 3, 15, 6, kind_penta6, 2, 5, 9, 26, upright_last_15, penta, [3, 3, 4, 4, 4, 0], [6, 6, 8, 8, 8, 0], &
         reshape([1, 3, 2, 9, 8, 7, 0, 0, 4, 5, 6, 13, 14, 15, 0, 0, 1, 2, 5, 4, 7, 11, 13, 10, 2, 3, 6, 5, 8, 12, 14, 11, &
                  3, 1, 4, 6, 9, 10, 15, 12], [8, 6], pad=no)), &
      element_kind('CHEXA ', 3, 20, 8, kind_hexa8, 8, 6, 12, 25, upright_last_20, hexa, [4, 4, 4, 4, 4, 4], [8, 8, 8, 8, 8, 8], &
         reshape([1, 4, 3, 2, 12, 11, 10, 9, 5, 6, 7, 8, 17, 18, 19, 20, 1, 2, 6, 5, 9, 14, 17, 13, 2, 3, 7, 6, 10, 15, 18, 14, &
                  3, 4, 8, 7, 11, 16, 19, 15, 4, 1, 5, 8, 12, 13, 20, 16], [8, 6])), &
      element_kind('CBAR  ', 1, 2, 2, kind_edge2, 1, 0, 0, 3, [1, 2, no, no, 0, 0], reshape(no, [2, 12], pad=no), no(:6), no(:6), &
         reshape(no, [8, 6], pad=no))]

   real(wp), parameter :: half = 0.5_wp, third = 1.0_wp/3.0_wp
   real(wp), parameter :: none(3, max_nodes) = 0.0_wp

   ! corner coordinates, in the order of the corners; of an edge its first and its last node
   real(wp), parameter :: edge_at(3, 2) = reshape([real(wp) :: -1, 0, 0,  1, 0, 0], [3, 2])
   real(wp), parameter :: tria_at(3, 3) = reshape([real(wp) :: 0, 0, 0,  1, 0, 0,  0, 1, 0], [3, 3])
   real(wp), parameter :: quad_at(3, 4) = reshape([real(wp) :: -1, -1, 0,  1, -1, 0,  1, 1, 0,  -1, 1, 0], [3, 4])
   real(wp), parameter :: tetra_at(3, 4) = reshape([real(wp) :: 0, 0, 0,  1, 0, 0,  0, 1, 0,  0, 0, 1], [3, 4])
   real(wp), parameter :: penta_at(3, 6) = reshape([real(wp) :: &
      0, 0, -1,  1, 0, -1,  0, 1, -1,  0, 0, 1,  1, 0, 1,  0, 1, 1], [3, 6])
   real(wp), parameter :: hexa_at(3, 8) = reshape([real(wp) :: &
      -1, -1, -1,  1, -1, -1,  1, 1, -1,  -1, 1, -1,  -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1], [3, 8])
   real(wp), parameter :: pyram_at(3, 5) = reshape([real(wp) :: -1, -1, -1,  1, -1, -1,  1, 1, -1,  -1, 1, -1,  0, 0, 1], [3, 5])
   real(wp), parameter :: of_tria(3, 3) = half*(tria_at + tria_at(:, [2, 3, 1]))
   real(wp), parameter :: of_quad(3, 4) = half*(quad_at + quad_at(:, [2, 3, 4, 1]))
   real(wp), parameter :: of_tetra(3, 6) = half*(tetra_at(:, [1, 2, 3, 1, 2, 3]) + tetra_at(:, [2, 3, 1, 4, 4, 4]))
   real(wp), parameter :: of_penta(3, 9) = &
      half*(penta_at(:, [1, 2, 3, 1, 2, 3, 4, 5, 6]) + penta_at(:, [2, 3, 1, 4, 5, 6, 5, 6, 4]))
   real(wp), parameter :: of_hexa(3, 12) = &
      half*(hexa_at(:, [1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8]) + hexa_at(:, [2, 3, 4, 1, 5, 6, 7, 8, 6, 7, 8, 5]))

   !> Local coordinates of the nodes: (coordinate, node, kind), 0 beyond the nodes of the kind.
   real(wp), parameter, public :: node_point(3, max_nodes, n_shapes) = reshape([ &
      tria_at, none(:, 4:), quad_at, none(:, 5:), tetra_at, none(:, 5:), penta_at, none(:, 7:), hexa_at, none(:, 9:), &
      pyram_at, none(:, 6:), &
      tria_at, of_tria, none(:, 7:), quad_at, of_quad, none(:, 9:), tetra_at, of_tetra, none(:, 11:), &
      penta_at, of_penta, none(:, 16:), &
      hexa_at, of_hexa, edge_at, none(:, 3:), edge_at, none(:, 3:)], [3, max_nodes, n_shapes])

   !> Local coordinates of the centre: (coordinate, kind).
   real(wp), parameter, public :: centre_point(3, n_shapes) = reshape([real(wp) :: &
      third, third, 0,  0, 0, 0,  0.25_wp, 0.25_wp, 0.25_wp,  third, third, 0,  0, 0, 0, &
      0, 0, -0.5_wp, &
      third, third, 0,  0, 0, 0,  0.25_wp, 0.25_wp, 0.25_wp,  third, third, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0], [3, n_shapes])

contains

   !> Whether elements of KIND, a body's, have mid-side nodes.
   elemental logical function is_second_order(kind)
      integer, intent(in) :: kind

      is_second_order = element_table(kind)%linear /= kind
   end function is_second_order

   !> The kind of a side from its dimension and number of nodes: an edge in the plane, a face in space; 0: no such side exists. A
   !! side of three nodes is a second-order edge in the plane and a triangle in space.
   pure integer function side_kind(dimension, n_nodes)
      integer, intent(in) :: dimension                              !! of the space, 2 or 3
      integer, intent(in) :: n_nodes                                !! of the side
      integer, parameter  :: edge(8) = [0, kind_edge2, kind_edge3, 0, 0, 0, 0, 0]
      integer, parameter  :: face(8) = [0, 0, kind_tria3, kind_quad4, 0, kind_tria6, 0, kind_quad8]

      side_kind = merge(edge(n_nodes), face(n_nodes), dimension == 2)
   end function side_kind

end module element_kinds
