!> Body elements: from their cards and the block generators to positions in the model, and whether they are sound.
module element_build
   use block_mesh, only: block_type
   use bulk_data, only: element_card
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use elasticity, only: axisymmetric
   use element_kinds, only: element_table, kind_quad4, kind_tria3, max_nodes
   use element_mapping, only: smallest_jacobian
   use id_table, only: id_table_type, sorted_order
   use kinds, only: wp
   use model_data, only: corners_of, model_type
   use node_build, only: raw_nodes, report_missing, report_repeated
   use property_build, only: check_property
   use text_tools, only: integer_text
   implicit none
   private

   public :: collect_elements, check_element_numbers, check_elements, check_one_state, is_face

contains

   !> Whether an element card marks a face: in a model of solids, CQUAD4 and CTRIA3 do nothing else.
   elemental logical function is_face(model, card)
      type(model_type), intent(in)   :: model
      type(element_card), intent(in) :: card

      is_face = model%dimension == 3 .and. element_table(card%kind)%dimension == 2
   end function is_face


   !> Elements of cards and of blocks, in ascending order of their numbers.
   subroutine collect_elements(deck, blocks, raw, position, model, errors)
      type(deck_type), intent(in)          :: deck
      type(block_type), intent(in)         :: blocks(:)
      type(raw_nodes), intent(in)          :: raw
      integer, intent(in)                  :: position(:)
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type)  :: properties
      integer, allocatable :: id(:), kind(:), nodes(:, :), property(:), line(:), order(:)
      integer :: b, i, k, n, total, most

      call properties%build(model%properties%id)
      total = deck%bulk%n_element
      do b = 1, size(blocks)
         total = total + size(blocks(b)%element_id)
      end do
      allocate (id(total), kind(total), property(total), line(total))
      allocate (nodes(max_nodes, total), source=0)
      n = 0
      do i = 1, deck%bulk%n_element
         associate (element => deck%bulk%element(i))
            if (is_face(model, element)) cycle
            n = n + 1
            id(n) = element%id
            kind(n) = element%kind
            line(n) = element%line
            do k = 1, element_table(element%kind)%n_nodes
               nodes(k, n) = model%node_table%find(element%nodes(k))
               if (nodes(k, n) == 0) call report_missing(deck, element%line, k + 2, 'node G'//integer_text(k), element%nodes(k), &
                                                         errors)
            end do
            property(n) = properties%find(element%property)
            call check_property(deck, model, element%line, element%property, element%kind, property(n), errors)
         end associate
      end do
      do b = 1, size(blocks)
         associate (block => blocks(b))
            k = properties%find(block%property)
            call check_property(deck, model, block%line, block%property, block%kind, k, errors)
            do i = 1, size(block%element_id)
               n = n + 1
               id(n) = block%element_id(i)
               kind(n) = block%kind
               line(n) = block%line
               property(n) = k
               associate (corners => element_table(block%kind)%n_nodes)
                  nodes(:corners, n) = position(raw%place(raw%block_start(b) + block%places(:corners, i)))
               end associate
            end do
         end associate
      end do
      call sorted_order(id(:n), order)
      most = maxval([4, element_table(kind(:n))%n_nodes])
      model%n_elements = n
      model%element_id = id(order)
      model%element_kind = kind(order)
      model%element_nodes = nodes(:most, order)
      model%element_property = property(order)
      model%element_line = line(order)
   end subroutine collect_elements


   !> No element number twice, bodies, faces, edges and interface elements counted together as NASTRAN does.
   subroutine check_element_numbers(deck, blocks, errors)
      type(deck_type), intent(in)          :: deck
      type(block_type), intent(in)         :: blocks(:)
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: id(:), line(:)
      integer :: b, n, n_cards, k, total

      associate (bulk => deck%bulk)
         n_cards = bulk%n_element + bulk%n_edge + bulk%n_cjoint
         total = n_cards
         do b = 1, size(blocks)
            total = total + size(blocks(b)%element_id)
         end do
         allocate (id(total), line(total))
         id(:n_cards) = [bulk%element(:bulk%n_element)%id, bulk%edge(:bulk%n_edge)%id, bulk%cjoint(:bulk%n_cjoint)%id]
         line(:n_cards) = [bulk%element(:bulk%n_element)%line, bulk%edge(:bulk%n_edge)%line, bulk%cjoint(:bulk%n_cjoint)%line]
         n = n_cards
         do b = 1, size(blocks)
            k = size(blocks(b)%element_id)
            id(n + 1:n + k) = blocks(b)%element_id
            line(n + 1:n + k) = blocks(b)%line
            n = n + k
         end do
      end associate
      call report_repeated(deck, id, line, n_cards, 'element', errors)
   end subroutine check_element_numbers


   !> Plane bodies and bodies of revolution cannot be mixed: the forces of the ones are those of their thickness, of the
   !! others those of the whole ring.
   subroutine check_one_state(model, errors)
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      logical :: rings, others
      integer :: e

      rings = .false.
      others = .false.
      do e = 1, model%n_elements
         if (model%element_property(e) == 0) cycle
         if (model%properties(model%element_property(e))%state == axisymmetric) then
            rings = .true.
         else
            others = .true.
         end if
         if (.not. (rings .and. others)) cycle
         call errors%add(model%element_line(e), 'element '//integer_text(model%element_id(e))//': PAXIS and PSHELL cannot be '// &
                         'mixed in one model')
         exit
      end do
      model%axisymmetric = rings
   end subroutine check_one_state


   !> Every plane element has a positive area at all its corners, every solid a positive volume where it is integrated.
   subroutine check_elements(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type)  :: doubtful_blocks ! by their lines
      logical, allocatable :: doubtful(:)
      integer :: e, i, last_line, node

      allocate (doubtful(model%n_nodes), source=.false.)
      do i = 1, deck%bulk%n_grid
         if (.not. deck%bulk%grid(i)%doubtful) cycle
         node = model%node_table%find(deck%bulk%grid(i)%id)
         if (node > 0) doubtful(node) = .true.
      end do
      associate (block2 => deck%bulk%block2(:deck%bulk%n_block2), block3 => deck%bulk%block3(:deck%bulk%n_block3))
         call doubtful_blocks%build([pack(block2%line, block2%doubtful), pack(block3%line, block3%doubtful)])
      end associate
      last_line = 0
      do e = 1, model%n_elements
         if (model%element_line(e) == last_line) cycle ! once a card
         associate (nodes => corners_of(model, e))
            if (any(nodes == 0)) cycle
            if (any(doubtful(nodes))) cycle
            if (doubtful_blocks%find(model%element_line(e)) > 0) cycle
            if (smallest_jacobian(model%element_kind(e), model%x(:model%dimension, nodes)) > 0.0_wp) cycle
         end associate
         last_line = model%element_line(e)
         call errors%add(model%element_line(e), 'element '//integer_text(model%element_id(e))//' has no positive '// &
                         shape_words(model%element_kind(e)))
      end do
   end subroutine check_elements


   !> What an element of a KIND lacks, and what was expected.
   pure function shape_words(kind) result(words)
      integer, intent(in)       :: kind
      character(:), allocatable :: words

      select case (kind)
      case (kind_quad4)
         words = 'area at some corner; expected four nodes counter-clockwise round a convex quadrilateral'
      case (kind_tria3)
         words = 'area at some corner; expected three nodes counter-clockwise'
      case default
         words = 'volume at some integration point; expected the corners in the order of '//trim(element_table(kind)%card)// &
                 ' in the card manual'
      end select
   end function shape_words

end module element_build
