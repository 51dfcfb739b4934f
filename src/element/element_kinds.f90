!> The kinds of body element: their nodes and sides, their names in NASTRAN decks and VTK files.
!! Corners are numbered as on the cards: plane elements counter-clockwise; solids with the base counter-clockwise as seen
!! from the opposite face or corner, then that face in the same sense.
!! Source: MSC Nastran Quick Reference Guide, CTRIA3, CQUAD4, CTETRA, CPENTA, CHEXA; VTK file formats, linear cell types.
module element_kinds
   implicit none
   private

   integer, parameter, public :: kind_tria3 = 1, kind_quad4 = 2     !! plane or axisymmetric
   integer, parameter, public :: kind_tetra4 = 3, kind_penta6 = 4, kind_hexa8 = 5
   integer, parameter, public :: n_kinds = 5

   integer, parameter, public :: max_nodes = 8, max_dofs = 24       !! of one element
   integer, parameter, public :: max_coupled_dofs = max_dofs + 3    !! with the node of a section of a solid bolt
   integer, parameter, public :: max_sides = 6, max_side_nodes = 4

   !> What distinguishes one kind from another. Sides of plane elements are edges, run through with the body on the left;
   !! sides of solids are faces, their right-hand normal pointing out of the body.
   type, public :: element_kind
      character(6) :: card                                          !! name of its card
      integer :: dimension                                          !! of its space, 2 or 3
      integer :: n_nodes
      integer :: n_sides
      integer :: vtk_type                                           !! cell type; VTK numbers the corners in the same order
      integer :: side_size(max_sides)                               !! nodes of every side, 0 beyond n_sides
      integer :: side_nodes(max_side_nodes, max_sides)              !! its corners, 0 beyond side_size
   end type element_kind

   type(element_kind), parameter, public :: element_table(n_kinds) = [ &
      element_kind('CTRIA3', 2, 3, 3, 5, [2, 2, 2, 0, 0, 0], &
                   reshape([1, 2, 0, 0, 2, 3, 0, 0, 3, 1, 0, 0], [4, 6], pad=[0])), &
      element_kind('CQUAD4', 2, 4, 4, 9, [2, 2, 2, 2, 0, 0], &
                   reshape([1, 2, 0, 0, 2, 3, 0, 0, 3, 4, 0, 0, 4, 1, 0, 0], [4, 6], pad=[0])), &
      element_kind('CTETRA', 3, 4, 4, 10, [3, 3, 3, 3, 0, 0], &
                   reshape([1, 3, 2, 0, 1, 2, 4, 0, 2, 3, 4, 0, 3, 1, 4, 0], [4, 6], pad=[0])), &
      element_kind('CPENTA', 3, 6, 5, 13, [3, 3, 4, 4, 4, 0], &
                   reshape([1, 3, 2, 0, 4, 5, 6, 0, 1, 2, 5, 4, 2, 3, 6, 5, 3, 1, 4, 6], [4, 6], pad=[0])), &
      element_kind('CHEXA ', 3, 8, 6, 12, [4, 4, 4, 4, 4, 4], &
                   reshape([1, 4, 3, 2, 5, 6, 7, 8, 1, 2, 6, 5, 2, 3, 7, 6, 3, 4, 8, 7, 4, 1, 5, 8], [4, 6]))]

end module element_kinds
