!> Connected bodies: elements that share nodes, and parts, which are bodies and nodes that bars and bolts connect.
!! Joints do not connect parts.
module connected_bodies
   use lists, only: join, root_of
   use mesh_queries, only: n_rotations
   use model_data, only: bar_nodes, freedoms_type, mesh_type, n_bars, n_sections
   use node_coupling, only: coupling_parts, section_node
   implicit none
   private

   public :: find_bodies, find_parts, join_coupled, number_parts

contains

   !> The BODY of each element, numbered in the order of their first elements. Elements that share nodes, and the halves of a solid
   !! bolt, form one body.
   pure subroutine find_bodies(mesh, body, n_bodies)
      type(mesh_type), intent(in) :: mesh
      integer, intent(out)         :: body(:) !! (n_elements)
      integer, intent(out)         :: n_bodies
      integer :: parent(mesh%n_nodes), number(mesh%n_nodes), e, k, root

      parent = [(k, k = 1, mesh%n_nodes)]
      call join_elements(mesh, .true., parent)
      number = 0
      n_bodies = 0
      do e = 1, mesh%n_elements
         root = root_of(parent, uncut(mesh, e, 1))
         if (number(root) == 0) then
            n_bodies = n_bodies + 1
            number(root) = n_bodies
         end if
         body(e) = number(root)
      end do
   end subroutine find_bodies

   !> Number the connected parts in the model.
   pure subroutine find_parts(mesh, freedoms, with_bolts)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      logical, intent(in)             :: with_bolts
      integer, allocatable :: part(:)
      integer :: n_parts

      call number_parts(mesh, freedoms, with_bolts, part, n_parts)
      call move_alloc(part, freedoms%part)
      freedoms%n_parts = n_parts
   end subroutine find_parts

   !> The connected PART of each node. A node without a body is a part of its own; a dependent node belongs to the part of its
   !! masters.
   pure subroutine number_parts(mesh, freedoms, with_bolts, part, n_parts)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      logical, intent(in)               :: with_bolts !! whether bolts connect bodies, as other bars do
      integer, allocatable, intent(out) :: part(:)    !! (n_nodes)
      integer, intent(out)              :: n_parts
      integer, allocatable :: parent(:)
      integer :: k, node, root

      allocate (parent, source=[(node, node = 1, mesh%n_nodes)])
      call join_elements(mesh, with_bolts, parent)
      do k = 1, n_bars(mesh)
         associate (nodes => bar_nodes(mesh%bars(k)))
            do node = 2, merge(size(nodes), 0, allocated(mesh%bars(k)%matrix))
               call join(parent, nodes(1), nodes(node))
            end do
         end associate
         if (mesh%bars(k)%nodes(2) == 0) cycle ! the ground
         if (with_bolts .or. mesh%bars(k)%bolt == 0) call join(parent, mesh%bars(k)%nodes(1), mesh%bars(k)%nodes(2))
      end do
      call join_coupled(mesh, freedoms, parent)
      allocate (part(mesh%n_nodes), source=0)
      n_parts = 0
      do node = 1, mesh%n_nodes
         root = root_of(parent, node)
         if (part(root) == 0) then
            n_parts = n_parts + 1
            part(root) = n_parts
         end if
         part(node) = part(root)
      end do
   end subroutine number_parts

   !> Join dependent nodes with the nodes that they depend on, and points with their rotations, in the union-find PARENT.
   pure subroutine join_coupled(mesh, freedoms, parent)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(inout)       :: parent(:) !! (n_nodes)
      integer :: k, node

      do node = 1, mesh%n_nodes
         associate (parts => coupling_parts(freedoms, node))
            do k = parts(1), parts(2)
               call join(parent, node, freedoms%coupling%node(k))
            end do
         end associate
      end do
      do k = 1, n_rotations(mesh)
         call join(parent, mesh%rotations(k)%point, mesh%rotations(k)%node)
      end do
   end subroutine join_coupled

   !> Join the nodes of every element, and WITH_BOLTS the halves of each solid bolt. For an element behind a pretension section the
   !! section node replaces the nodes that are cut.
   pure subroutine join_elements(mesh, with_bolts, parent)
      type(mesh_type), intent(in) :: mesh
      logical, intent(in)          :: with_bolts
      integer, intent(inout)       :: parent(:)
      integer :: e, first, k

      do e = 1, mesh%n_elements
         first = uncut(mesh, e, 1)
         do k = 2, size(mesh%element_nodes, 1)
            call join(parent, first, uncut(mesh, e, k))
         end do
      end do
      if (with_bolts) then
         do k = 1, n_sections(mesh)
            call join(parent, mesh%sections(k)%node, mesh%sections(k)%point)
         end do
      end if
   end subroutine join_elements

   !> Corner I of element E, or the section node that replaces it.
   pure integer function uncut(mesh, e, i) result(corner)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e, i

      corner = mesh%element_nodes(i, e)
      if (corner == 0 .or. section_node(mesh, e) == 0) return
      if (mesh%node_section(corner) == mesh%element_section(e)) corner = section_node(mesh, e)
   end function uncut

end module connected_bodies
