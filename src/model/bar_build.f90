!> Bars and bolts: CROD elements with a PROD, and the BOLT cards that tighten some of them.
module bar_build
   use bulk_data, only: bolt_card, element_card
   use card_names, only: card_name
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use model_data, only: bar_type, model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_bars, is_bar, find_stage

contains

   !> Whether an edge is a bar: a CROD with the id of a PROD.
   logical function is_bar(deck, edge)
      type(deck_type), intent(in)    :: deck
      type(element_card), intent(in) :: edge

      is_bar = any(deck%bulk%prod(:deck%bulk%n_prod)%id == edge%property) .and. edge%property > 0
      if (is_bar) is_bar = card_name(deck%text%card_part(edge%line)) == 'CROD'
   end function is_bar


   !> Fill the bars of MODEL.
   subroutine build_bars(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i, n

      allocate (model%bars(deck%bulk%n_edge))
      n = 0
      do i = 1, deck%bulk%n_edge
         if (.not. is_bar(deck, deck%bulk%edge(i))) cycle
         n = n + 1
         call build_bar(deck, deck%bulk%edge(i), model, model%bars(n), errors)
      end do
      model%bars = model%bars(:n)
      call tighten(deck, model, errors)
   end subroutine build_bars


   subroutine build_bar(deck, edge, model, bar, errors)
      type(deck_type), intent(in)          :: deck
      type(element_card), intent(in)       :: edge
      type(model_type), intent(in)         :: model
      type(bar_type), intent(inout)        :: bar
      type(deck_error_list), intent(inout) :: errors
      integer  :: k, material, property
      real(wp) :: length

      bar%id = edge%id
      do k = 1, 2
         bar%nodes(k) = model%node_table%find(edge%nodes(k))
         if (bar%nodes(k) == 0 .and. edge%nodes(k) > 0) call add_field_error(deck%text, edge%line, k + 2, &
            'node G'//integer_text(k), 'there is no GRID '//integer_text(edge%nodes(k)), errors)
      end do
      property = findloc(deck%bulk%prod(:deck%bulk%n_prod)%id, edge%property, dim=1)
      associate (prod => deck%bulk%prod(property))
         material = findloc(deck%bulk%mat1(:deck%bulk%n_mat1)%id, prod%material, dim=1)
         if (material == 0) then
            if (prod%material > 0) call add_field_error(deck%text, prod%line, 2, 'MID', 'there is no MAT1 '// &
                                                        integer_text(prod%material), errors)
            return
         end if
         if (any(bar%nodes == 0)) return
         bar%direction = model%x(:, bar%nodes(2)) - model%x(:, bar%nodes(1))
         length = norm2(bar%direction)
         if (length <= 0.0_wp) then
            call errors%add(edge%line, 'bar '//integer_text(edge%id)//' has no length')
            return
         end if
         bar%direction = bar%direction/length
         bar%stiffness = deck%bulk%mat1(material)%e*prod%area/length
         if (model%axisymmetric .and. abs(bar%direction(1)) > 1.0e-9_wp) call errors%add(edge%line, 'bar '// &
            integer_text(edge%id)//': in an axisymmetric model bars stand along y; their area is that of all round the ring')
      end associate
   end subroutine build_bar


   !> BOLT cards: which bars are bolts, and in which stage they are tightened.
   subroutine tighten(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i, k, stage

      do i = 1, deck%bulk%n_bolt
         associate (card => deck%bulk%bolt(i))
            if (card%element == 0) cycle ! a solid bolt
            k = findloc(model%bars%id, card%element, dim=1)
            call find_stage(deck, card, stage, errors)
            if (k == 0) call add_field_error(deck%text, card%line, 2, 'EID', 'there is no CROD '// &
               integer_text(card%element)//' with a PROD', errors)
            if (k == 0 .or. stage == 0) cycle
            if (model%bars(k)%bolt > 0) then
               call add_field_error(deck%text, card%line, 2, 'EID', 'CROD '//integer_text(card%element)//' is BOLT '// &
                                    integer_text(model%bars(k)%bolt)//' already', errors)
               cycle
            end if
            model%bars(k)%bolt = card%id
            model%bars(k)%preload = card%preload
            model%bars(k)%stage = stage
         end associate
      end do
   end subroutine tighten


   !> Position of the STAGE in which the bolt of CARD is tightened; 0: it is not there.
   subroutine find_stage(deck, card, stage, errors)
      type(deck_type), intent(in)          :: deck
      type(bolt_card), intent(in)          :: card
      integer, intent(out)                 :: stage
      type(deck_error_list), intent(inout) :: errors

      stage = findloc(deck%control%stages%id, card%stage, dim=1)
      if (stage == 0 .and. card%stage > 0) call add_field_error(deck%text, card%line, 4, 'STAGE', &
         'there is no SUBCASE '//integer_text(card%stage), errors)
   end subroutine find_stage

end module bar_build
