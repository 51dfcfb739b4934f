!> Edges of second order that are marked by halves, from a corner to the mid-side node and from there to the other corner.
!! A program that writes the edges of a mesh of second order as linear ones marks all of them so. Both halves in one surface are the
!! whole edge. One half alone is an error: its integrals of the shape functions, 5/12, 2/3 and -1/12 of the half length, reach to
!! the corner beyond it.
module edge_halves
   use element_build, only: marked_side
   use element_kinds, only: element_table, is_second_order
   use model_data, only: mesh_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: half_edge_text, join_halves

contains

   !> Replace the first of two SIDES of one surface that are the halves of one edge by the edge, in the sense of the first, and drop
   !! the second. A half without the other one stays, and is no side of an element (HALF_EDGE_TEXT).
   pure subroutine join_halves(mesh, sides)
      type(mesh_type), intent(in)                   :: mesh
      type(marked_side), allocatable, intent(inout) :: sides(:)
      integer :: last(mesh%n_nodes)    ! half at each mid-side node that waits for the other one, 0: none
      integer :: before(size(sides))   ! the one that waits at the same node
      integer :: edge(3), element, i, j
      logical :: stays(size(sides))

      if (.not. any(is_second_order(mesh%element_kind))) return
      last = 0
      stays = .true.
      do i = 1, size(sides)
         if (sides(i)%corners /= 2 .or. any(sides(i)%nodes(:2) <= 0)) cycle
         call find_edge(mesh, sides(i)%nodes(:2), edge, element)
         if (element == 0) cycle
         associate (middle => edge(3))
            j = last(middle)
            do while (j > 0)
               if (sides(j)%property == sides(i)%property .and. corner_of(sides(j), middle) /= corner_of(sides(i), middle)) exit
               j = before(j)
            end do
            if (j > 0) then
               where (sides(j)%nodes(:2) == middle) sides(j)%nodes(:2) = corner_of(sides(i), middle)
               stays(i) = .false.
            end if
            before(i) = last(middle)
            if (j == 0) last(middle) = i
         end associate
      end do
      if (.not. all(stays)) sides = pack(sides, stays)
   end subroutine join_halves

   !> The corner of the half edge SIDE, whose other end is the node MIDDLE; 0 where it has been joined.
   pure integer function corner_of(side, middle) result(corner)
      type(marked_side), intent(in) :: side
      integer, intent(in)           :: middle

      corner = 0
      if (any(side%nodes(:2) == middle)) corner = merge(side%nodes(2), side%nodes(1), side%nodes(1) == middle)
   end function corner_of

   !> What the edge between two NODES is a half of, for a message; empty: it is none.
   pure function half_edge_text(mesh, nodes) result(words)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: nodes(:)
      character(:), allocatable   :: words
      integer :: edge(3), element

      words = ''
      if (size(nodes) /= 2) return
      call find_edge(mesh, nodes, edge, element)
      if (element == 0) return
      words = ', but half of the edge from node '//integer_text(mesh%node_id(edge(1)))//' by '// &
              integer_text(mesh%node_id(edge(3)))//' to '//integer_text(mesh%node_id(edge(2)))//' of element '// &
              integer_text(mesh%element_id(element))//', a '//trim(element_table(mesh%element_kind(element))%card)// &
              '; expected the whole edge, or both halves'
   end function half_edge_text

   !> The EDGE of ELEMENT of which the NODES, a corner and the node at the middle in either order, are a half: its corners, then the
   !! node at its middle. ELEMENT is 0 where there is none.
   pure subroutine find_edge(mesh, nodes, edge, element)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: nodes(2)
      integer, intent(out)        :: edge(3), element
      integer :: i, s

      do i = mesh%first_at(nodes(1)), mesh%first_at(nodes(1) + 1) - 1
         element = mesh%elements_at(i)
         associate (kind => element_table(mesh%element_kind(element)))
            do s = 1, kind%n_sides
               if (kind%side_corners(s) /= 2 .or. kind%side_size(s) /= 3) cycle
               edge = mesh%element_nodes(kind%side_nodes(:3, s), element)
               if (any(nodes == edge(3)) .and. (any(nodes == edge(1)) .or. any(nodes == edge(2)))) return
            end do
         end associate
      end do
      edge = 0
      element = 0
   end subroutine find_edge

end module edge_halves
