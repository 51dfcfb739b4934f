!> The table of unknowns: element -> nodes. It is made once, when supports and couplings are known.
!! Row E holds first the nodes whose displacements enter element E: its points in the order of the card, then the nodes of the
!! rotations at these points if it is a shell or a beam, then the node of the pretension section that it touches from behind. The
!! matrix of the element itself is between the components of these nodes. Where any of them is coupled, the row goes on with the
!! nodes of the unknowns, each once, in the order in which node_coupling finds them: between their components is the transformed
!! matrix, which the equations add up. Where none is coupled, both lists are the same one.
!! Two other lists are none of unknowns of an element: `element_points` of mesh_queries are the points of its geometry, and
!! `unknown_nodes` of node_coupling are the unknowns of any nodes, such as those of a bar, a mass or an interface element.
module element_unknowns
   use mesh_queries, only: element_points
   use model_data, only: freedoms_type, mesh_type, unknowns_table
   use node_coupling, only: is_coupled, section_node, unknown_nodes
   implicit none
   private

   public :: make_table, displaced_nodes, last_displaced, nodes_of_unknowns

contains

   !> Make the table of FREEDOMS for all elements of MESH, which has no errors.
   pure subroutine make_table(mesh, freedoms)
      type(mesh_type), intent(in)        :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      integer, allocatable :: row(:), longer(:)
      integer :: e, n

      associate (table => freedoms%table)
         allocate (table%first(mesh%n_elements + 1), table%first_unknown(mesh%n_elements))
         allocate (table%node((size(mesh%element_nodes, 1) + 1)*mesh%n_elements), row(0))
         n = 0
         do e = 1, mesh%n_elements
            table%first(e) = n + 1
            table%first_unknown(e) = n + 1
            row = displaced_by(mesh, e)
            if (is_coupled(freedoms, row)) then
               table%first_unknown(e) = n + size(row) + 1
               row = [row, unknown_nodes(freedoms, row)]
            end if
            if (n + size(row) > size(table%node)) then
               allocate (longer(2*size(table%node) + size(row)))
               longer(:n) = table%node(:n)
               call move_alloc(longer, table%node)
            end if
            table%node(n + 1:n + size(row)) = row
            n = n + size(row)
         end do
         table%first(mesh%n_elements + 1) = n + 1
         table%node = table%node(:n)
      end associate
   end subroutine make_table

   !> The nodes whose displacements enter element E, from the mesh.
   pure function displaced_by(mesh, e) result(nodes)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e
      integer, allocatable :: nodes(:)

      nodes = element_points(mesh, e)
      if (size(mesh%structural%place) > 0) then
         if (mesh%structural%place(e) > 0) nodes = [nodes, mesh%rotations(mesh%rotation_of(nodes))%node]
      end if
      if (section_node(mesh, e) > 0) nodes = [nodes, section_node(mesh, e)]
   end function displaced_by

   !> The nodes whose displacements enter element E.
   pure function displaced_nodes(freedoms, e) result(nodes)
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)             :: e
      integer :: nodes(last_displaced(freedoms%table, e) - freedoms%table%first(e) + 1)

      nodes = freedoms%table%node(freedoms%table%first(e):last_displaced(freedoms%table, e))
   end function displaced_nodes

   !> The position in TABLE of the last of these nodes; the first is at table%first(e).
   pure integer function last_displaced(table, e) result(last)
      type(unknowns_table), intent(in) :: table
      integer, intent(in)              :: e

      last = table%first(e + 1) - 1
      if (table%first_unknown(e) > table%first(e)) last = table%first_unknown(e) - 1
   end function last_displaced

   !> The nodes whose unknowns element E couples.
   pure function nodes_of_unknowns(freedoms, e) result(nodes)
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)             :: e
      integer :: nodes(freedoms%table%first(e + 1) - freedoms%table%first_unknown(e))

      nodes = freedoms%table%node(freedoms%table%first_unknown(e):freedoms%table%first(e + 1) - 1)
   end function nodes_of_unknowns

end module element_unknowns
