!> Connected bodies: elements that share nodes, and parts, which are bodies and nodes that bars and bolts connect.
!! Joints do not connect parts.
module connected_bodies
   use lists, only: join, root_of
   use model_data, only: model_type, n_bars, n_rotations, n_sections
   use node_coupling, only: coupling_parts, section_node
   implicit none
   private

   public :: find_bodies, find_parts, join_coupled, number_parts

contains

   !> The BODY of each element, numbered in the order of their first elements. Elements that share nodes, and the halves of a solid
   !! bolt, form one body.
   pure subroutine find_bodies(model, body, n_bodies)
      type(model_type), intent(in) :: model
      integer, intent(out)         :: body(:) !! (n_elements)
      integer, intent(out)         :: n_bodies
      integer :: parent(model%mesh%n_nodes), number(model%mesh%n_nodes), e, k, root

      parent = [(k, k = 1, model%mesh%n_nodes)]
      call join_elements(model, .true., parent)
      number = 0
      n_bodies = 0
      do e = 1, model%mesh%n_elements
         root = root_of(parent, uncut(model, e, 1))
         if (number(root) == 0) then
            n_bodies = n_bodies + 1
            number(root) = n_bodies
         end if
         body(e) = number(root)
      end do
   end subroutine find_bodies

   !> Number the connected parts in MODEL.
   pure subroutine find_parts(model, with_bolts)
      type(model_type), intent(inout) :: model
      logical, intent(in)             :: with_bolts
      integer, allocatable :: part(:)
      integer :: n_parts

      call number_parts(model, with_bolts, part, n_parts)
      call move_alloc(part, model%freedoms%part)
      model%freedoms%n_parts = n_parts
   end subroutine find_parts

   !> The connected PART of each node. A node without a body is a part of its own; a dependent node belongs to the part of its
   !! masters.
   pure subroutine number_parts(model, with_bolts, part, n_parts)
      type(model_type), intent(in)      :: model
      logical, intent(in)               :: with_bolts !! whether bolts connect bodies, as other bars do
      integer, allocatable, intent(out) :: part(:)    !! (n_nodes)
      integer, intent(out)              :: n_parts
      integer, allocatable :: parent(:)
      integer :: k, node, root

      allocate (parent, source=[(node, node = 1, model%mesh%n_nodes)])
      call join_elements(model, with_bolts, parent)
      do k = 1, n_bars(model)
         if (model%mesh%bars(k)%nodes(2) == 0) cycle ! the ground
         if (with_bolts .or. model%mesh%bars(k)%bolt == 0) call join(parent, model%mesh%bars(k)%nodes(1), &
            model%mesh%bars(k)%nodes(2))
      end do
      call join_coupled(model, parent)
      allocate (part(model%mesh%n_nodes), source=0)
      n_parts = 0
      do node = 1, model%mesh%n_nodes
         root = root_of(parent, node)
         if (part(root) == 0) then
            n_parts = n_parts + 1
            part(root) = n_parts
         end if
         part(node) = part(root)
      end do
   end subroutine number_parts

   !> Join dependent nodes with the nodes that they depend on, and points with their rotations, in the union-find PARENT.
   pure subroutine join_coupled(model, parent)
      type(model_type), intent(in) :: model
      integer, intent(inout)       :: parent(:) !! (n_nodes)
      integer :: k, node

      do node = 1, model%mesh%n_nodes
         associate (parts => coupling_parts(model, node))
            do k = parts(1), parts(2)
               call join(parent, node, model%freedoms%coupling%node(k))
            end do
         end associate
      end do
      do k = 1, n_rotations(model)
         call join(parent, model%mesh%rotations(k)%point, model%mesh%rotations(k)%node)
      end do
   end subroutine join_coupled

   !> Join the nodes of every element, and WITH_BOLTS the halves of each solid bolt. For an element behind a pretension section the
   !! section node replaces the nodes that are cut.
   pure subroutine join_elements(model, with_bolts, parent)
      type(model_type), intent(in) :: model
      logical, intent(in)          :: with_bolts
      integer, intent(inout)       :: parent(:)
      integer :: e, first, k

      do e = 1, model%mesh%n_elements
         first = uncut(model, e, 1)
         do k = 2, size(model%mesh%element_nodes, 1)
            call join(parent, first, uncut(model, e, k))
         end do
      end do
      if (with_bolts) then
         do k = 1, n_sections(model)
            call join(parent, model%mesh%sections(k)%node, model%mesh%sections(k)%point)
         end do
      end if
   end subroutine join_elements

   !> Corner I of element E, or the section node that replaces it.
   pure integer function uncut(model, e, i) result(corner)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e, i

      corner = model%mesh%element_nodes(i, e)
      if (corner == 0 .or. section_node(model, e) == 0) return
      if (model%mesh%node_section(corner) == model%mesh%element_section(e)) corner = section_node(model, e)
   end function uncut

end module connected_bodies
