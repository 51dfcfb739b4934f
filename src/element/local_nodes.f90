!> The nodes of every kind of element in local coordinates, and its centre.
!! Edge, quadrilateral and hexahedron: each coordinate from -1 to 1. Triangle and tetrahedron: from 0 to 1, corner 1 at the
!! origin. Wedge: a triangle in r, s, and t from -1 to 1. Nodes behind the corners lie at the middle of the edges.
module local_nodes
   use element_kinds, only: max_nodes, n_shapes
   use kinds, only: wp
   implicit none
   private

   real(wp), parameter :: half = 0.5_wp, third = 1.0_wp/3.0_wp
   real(wp), parameter :: none(3, max_nodes) = 0.0_wp

   ! corners, and where edges begin and end, in the order of element_kinds
   real(wp), parameter :: edge(3, 2) = reshape([real(wp) :: -1, 0, 0,  1, 0, 0], [3, 2])
   real(wp), parameter :: tria(3, 3) = reshape([real(wp) :: 0, 0, 0,  1, 0, 0,  0, 1, 0], [3, 3])
   real(wp), parameter :: quad(3, 4) = reshape([real(wp) :: -1, -1, 0,  1, -1, 0,  1, 1, 0,  -1, 1, 0], [3, 4])
   real(wp), parameter :: tetra(3, 4) = reshape([real(wp) :: 0, 0, 0,  1, 0, 0,  0, 1, 0,  0, 0, 1], [3, 4])
   real(wp), parameter :: penta(3, 6) = reshape([real(wp) :: 0, 0, -1,  1, 0, -1,  0, 1, -1,  0, 0, 1,  1, 0, 1,  0, 1, 1], [3, 6])
   real(wp), parameter :: hexa(3, 8) = reshape([real(wp) :: &
      -1, -1, -1,  1, -1, -1,  1, 1, -1,  -1, 1, -1,  -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1], [3, 8])
   real(wp), parameter :: of_tria(3, 3) = half*(tria + tria(:, [2, 3, 1]))
   real(wp), parameter :: of_quad(3, 4) = half*(quad + quad(:, [2, 3, 4, 1]))
   real(wp), parameter :: of_tetra(3, 6) = half*(tetra(:, [1, 2, 3, 1, 2, 3]) + tetra(:, [2, 3, 1, 4, 4, 4]))
   real(wp), parameter :: of_penta(3, 9) = half*(penta(:, [1, 2, 3, 1, 2, 3, 4, 5, 6]) + penta(:, [2, 3, 1, 4, 5, 6, 5, 6, 4]))
   real(wp), parameter :: of_hexa(3, 12) = &
      half*(hexa(:, [1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8]) + hexa(:, [2, 3, 4, 1, 5, 6, 7, 8, 6, 7, 8, 5]))

   !> Local coordinates of the nodes: (coordinate, node, kind), 0 beyond the nodes of the kind.
   real(wp), parameter, public :: node_point(3, max_nodes, n_shapes) = reshape([ &
      tria, none(:, 4:), quad, none(:, 5:), tetra, none(:, 5:), penta, none(:, 7:), hexa, none(:, 9:), &
      tria, of_tria, none(:, 7:), quad, of_quad, none(:, 9:), tetra, of_tetra, none(:, 11:), penta, of_penta, none(:, 16:), &
      hexa, of_hexa, edge, none(:, 3:), edge, none(:, 3:)], [3, max_nodes, n_shapes])

   !> Local coordinates of the centre: (coordinate, kind).
   real(wp), parameter, public :: centre_point(3, n_shapes) = reshape([real(wp) :: &
      third, third, 0,  0, 0, 0,  0.25_wp, 0.25_wp, 0.25_wp,  third, third, 0,  0, 0, 0, &
      third, third, 0,  0, 0, 0,  0.25_wp, 0.25_wp, 0.25_wp,  third, third, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0], [3, n_shapes])

end module local_nodes
