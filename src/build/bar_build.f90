!> Bars and bolts: CROD elements with a PROD, CONROD elements, and the BOLT cards that tighten some of them.
module bar_build
   use bulk_data, only: bolt_card, edge_crod, element_card, prod_card
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
      integer :: i, n, prod

      allocate (model%bars(size(deck%bulk%edge) + size(deck%bulk%conrod)))
      n = 0
      do i = 1, size(deck%bulk%edge)
         associate (edge => deck%bulk%edge(i))
            if (.not. is_bar(deck, edge)) cycle
            n = n + 1
            prod = findloc(deck%bulk%prod%id, edge%property, dim=1)
            model%bars(n)%id = edge%id
            call find_nodes(deck, edge%line, edge%nodes(:2), model, model%bars(n)%nodes)
            call build_bar(deck, edge%line, deck%bulk%prod(prod), model, model%bars(n))
         end associate
      end do
      do i = 1, size(deck%bulk%conrod)
         associate (rod => deck%bulk%conrod(i))
            n = n + 1
            model%bars(n)%id = rod%id
            call find_nodes(deck, rod%line, rod%nodes, model, model%bars(n)%nodes, first=2)
            call build_bar(deck, rod%line, prod_card(line=rod%line, material=rod%material, area=rod%area, &
                           extra_mass=rod%extra_mass), model, model%bars(n))
         end associate
      end do
      model%bars = model%bars(:n)
      do i = 1, size(deck%bulk%bolt)
         if (deck%bulk%bolt(i)%element > 0) call tighten(deck, deck%bulk%bolt(i), model) ! else a solid bolt
      end do
   end subroutine build_bars

   !> The stiffness and mass of BAR, whose card is on LINE and whose nodes are known, with the section of PROD.
   subroutine build_bar(deck, line, prod, model, bar)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line
      type(prod_card), intent(in)    :: prod
      type(model_type), intent(in)   :: model
      type(bar_type), intent(inout)  :: bar
      integer  :: material
      real(wp) :: along(3), length

      material = findloc(deck%bulk%mat1%id, prod%material, dim=1)
      if (material == 0) then
         if (prod%material > 0) call deck%field_error(prod%line, 'MID', 'there is no MAT1 '//integer_text(prod%material))
         return
      end if
      if (any(bar%nodes == 0)) return
      along = model%x(:, bar%nodes(2)) - model%x(:, bar%nodes(1))
      length = norm2(along)
      if (length <= 0.0_wp) then
         call deck%errors%add(line, 'bar '//integer_text(bar%id)//' has no length')
         return
      end if
      bar%direction = spread(along/length, 2, 2)
      bar%stiffness = deck%bulk%mat1(material)%e*prod%area/length
      bar%mass = deck%bulk%parameters%mass_factor*(deck%bulk%mat1(material)%rho*prod%area + prod%extra_mass)*length
      bar%expansion = deck%bulk%mat1(material)%alpha*length
      bar%reference = deck%bulk%mat1(material)%reference
      bar%damping = deck%bulk%mat1(material)%damping
      if (model%axisymmetric .and. abs(bar%direction(1, 1)) > 1.0e-9_wp) call deck%errors%add(line, 'bar '// &
         integer_text(bar%id)//': in an axisymmetric model bars stand along y; their area is that of all round the ring')
   end subroutine build_bar

   !> The BOLT of a bar: which one it is, and in which stage it is tightened.
   subroutine tighten(deck, card, model)
      type(checked_deck), intent(in)  :: deck
      type(bolt_card), intent(in)     :: card
      type(model_type), intent(inout) :: model
      integer :: k, stage

      k = findloc(model%bars%id, card%element, dim=1)
      call find_stage(deck, card, stage)
      if (k == 0) call deck%field_error(card%line, 'EID', 'there is no CROD '//integer_text(card%element)// &
                                           ' with a PROD, nor a CONROD')
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
