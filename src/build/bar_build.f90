!> Bars and bolts: CROD elements with a PROD, and the BOLT cards that tighten some of them.
module bar_build
   use bulk_data, only: bolt_card, edge_crod, element_card
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: bar_type, model_type
   use node_build, only: find_nodes
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_bars, is_bar, find_stage

contains

   !> Whether an edge is a bar: a CROD with the id of a PROD.
   pure logical function is_bar(deck, edge)
      type(checked_deck), intent(in) :: deck
      type(element_card), intent(in) :: edge

      is_bar = edge%kind == edge_crod .and. edge%property > 0 .and. any(deck%bulk%prod%id == edge%property)
   end function is_bar

   !> Fill the bars of MODEL.
   subroutine build_bars(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      integer :: i, n

      allocate (model%bars(size(deck%bulk%edge)))
      n = 0
      do i = 1, size(deck%bulk%edge)
         if (.not. is_bar(deck, deck%bulk%edge(i))) cycle
         n = n + 1
         call build_bar(deck, deck%bulk%edge(i), model, model%bars(n))
      end do
      model%bars = model%bars(:n)
      do i = 1, size(deck%bulk%bolt)
         if (deck%bulk%bolt(i)%element > 0) call tighten(deck, deck%bulk%bolt(i), model) ! else a solid bolt
      end do
   end subroutine build_bars

   subroutine build_bar(deck, edge, model, bar)
      type(checked_deck), intent(in) :: deck
      type(element_card), intent(in) :: edge
      type(model_type), intent(in)   :: model
      type(bar_type), intent(inout)  :: bar
      integer  :: material
      real(wp) :: length

      bar%id = edge%id
      call find_nodes(deck, edge%line, edge%nodes(:2), model, bar%nodes)
      associate (prod => deck%bulk%prod(findloc(deck%bulk%prod%id, edge%property, dim=1)))
         material = findloc(deck%bulk%mat1%id, prod%material, dim=1)
         if (material == 0) then
            if (prod%material > 0) call deck%field_error(prod%line, 'MID', 'there is no MAT1 '//integer_text(prod%material))
            return
         end if
         if (any(bar%nodes == 0)) return
         bar%direction = model%x(:, bar%nodes(2)) - model%x(:, bar%nodes(1))
         length = norm2(bar%direction)
         if (length <= 0.0_wp) then
            call deck%errors%add(edge%line, 'bar '//integer_text(edge%id)//' has no length')
            return
         end if
         bar%direction = bar%direction/length
         bar%stiffness = deck%bulk%mat1(material)%e*prod%area/length
         if (model%axisymmetric .and. abs(bar%direction(1)) > 1.0e-9_wp) call deck%errors%add(edge%line, 'bar '// &
            integer_text(edge%id)//': in an axisymmetric model bars stand along y; their area is that of all round the ring')
      end associate
   end subroutine build_bar

   !> The BOLT of a bar: which one it is, and in which stage it is tightened.
   subroutine tighten(deck, card, model)
      type(checked_deck), intent(in)  :: deck
      type(bolt_card), intent(in)     :: card
      type(model_type), intent(inout) :: model
      integer :: k, stage

      k = findloc(model%bars%id, card%element, dim=1)
      call find_stage(deck, card, stage)
      if (k == 0) call deck%field_error(card%line, 'EID', 'there is no CROD '//integer_text(card%element)//' with a PROD')
      if (k == 0 .or. stage == 0) return
      associate (bar => model%bars(k))
         if (bar%bolt > 0) then
            call deck%field_error(card%line, 'EID', 'CROD '//integer_text(card%element)//' is BOLT '//integer_text(bar%bolt)// &
                                  ' already')
            return
         end if
         bar%bolt = card%id
         bar%preload = card%preload
         bar%stage = stage
      end associate
   end subroutine tighten

   !> Position of the STAGE in which the bolt of CARD is tightened; 0: it is not there.
   subroutine find_stage(deck, card, stage)
      type(checked_deck), intent(in) :: deck
      type(bolt_card), intent(in)    :: card
      integer, intent(out)           :: stage

      stage = findloc(deck%control%stages%id, card%stage, dim=1)
      if (stage == 0 .and. card%stage > 0) call deck%field_error(card%line, 'STAGE', &
         'there is no SUBCASE '//integer_text(card%stage))
   end subroutine find_stage

end module bar_build
