!> Marked sides: edges and faces that carry the id of a PMARK, from their cards and from the sides of blocks.
module side_build
   use bar_build, only: is_bar
   use block_mesh, only: block_type
   use card_names, only: card_name
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use element_build, only: is_face
   use element_kinds, only: element_table, max_side_nodes
   use model_data, only: model_type
   use node_build, only: raw_nodes, report_missing
   use text_tools, only: integer_text
   implicit none
   private

   public :: collect_sides

   !> Sides that carry a mark, before they are sorted into surfaces.
   type, public :: marked_sides
      integer :: n = 0
      integer, allocatable :: mark(:)      !! PMARK id
      integer, allocatable :: corners(:)   !! 2, 3 or 4
      integer, allocatable :: nodes(:, :)  !! (4, n)
      integer, allocatable :: line(:)      !! of its card
      integer, allocatable :: field(:)     !! data field with the mark's id
   end type marked_sides

contains

   !> CBAR and CROD edges in the plane, CTRIA3 and CQUAD4 faces of solids, and the marked sides of blocks.
   subroutine collect_sides(deck, blocks, raw, position, model, sides, errors)
      type(deck_type), intent(in)          :: deck
      type(block_type), intent(in)         :: blocks(:)
      type(raw_nodes), intent(in)          :: raw
      integer, intent(in)                  :: position(:)
      type(model_type), intent(in)         :: model
      type(marked_sides), intent(out)      :: sides
      type(deck_error_list), intent(inout) :: errors
      integer :: b, i, k, n, total

      total = deck%bulk%n_edge + sum(blocks%n_sides)
      if (model%dimension == 3) total = total + deck%bulk%n_element
      allocate (sides%mark(total), sides%corners(total), sides%line(total), sides%field(total))
      allocate (sides%nodes(max_side_nodes, total), source=0)
      n = 0
      do i = 1, deck%bulk%n_edge
         associate (edge => deck%bulk%edge(i))
            if (is_bar(deck, edge)) cycle
            if (model%dimension == 3) then
               call errors%add(edge%line, 'a CBAR, or a CROD without a PROD, marks an edge of a plane body; surfaces of '// &
                               'solids are marked with CTRIA3 and CQUAD4 faces')
               cycle
            end if
            call start_side(edge%property, 2, edge%line, 2)
            do k = 1, 2
               sides%nodes(k, n) = model%node_table%find(edge%nodes(k))
               if (sides%nodes(k, n) == 0) call report_missing(deck, edge%line, k + 2, 'node '//edge_node(deck, edge%line, k), &
                                                               edge%nodes(k), errors)
            end do
         end associate
      end do
      do i = 1, deck%bulk%n_element
         associate (face => deck%bulk%element(i))
            if (.not. is_face(model, face)) cycle
            call start_side(face%property, element_table(face%kind)%n_nodes, face%line, 2)
            do k = 1, sides%corners(n)
               sides%nodes(k, n) = model%node_table%find(face%nodes(k))
               if (sides%nodes(k, n) == 0) call report_missing(deck, face%line, k + 2, 'node G'//integer_text(k), face%nodes(k), &
                                                               errors)
            end do
         end associate
      end do
      do b = 1, size(blocks)
         do i = 1, blocks(b)%n_sides
            associate (corners => blocks(b)%side(:count(blocks(b)%side(:, i) > 0), i))
               call start_side(blocks(b)%mark(i), size(corners), blocks(b)%line, blocks(b)%mark_field(i))
               sides%nodes(:size(corners), n) = position(raw%place(raw%block_start(b) + corners))
            end associate
         end do
      end do
      sides%n = n

   contains

      subroutine start_side(mark, corners, line, field)
         integer, intent(in) :: mark, corners, line, field

         n = n + 1
         sides%mark(n) = mark
         sides%corners(n) = corners
         sides%line(n) = line
         sides%field(n) = field
      end subroutine start_side

   end subroutine collect_sides

   !> What the manual calls node K of the edge on LINE: GA, GB of a CBAR, G1, G2 of a CROD.
   function edge_node(deck, line, k) result(name)
      type(deck_type), intent(in) :: deck
      integer, intent(in)         :: line, k
      character(2) :: name

      name = merge('G1', 'G2', k == 1)
      if (card_name(deck%text%card_part(line)) == 'CBAR') name = merge('GA', 'GB', k == 1)
   end function edge_node

end module side_build
