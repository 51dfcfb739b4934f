!> Temperatures of elements from TEMPP1 and TEMPRB: of shells, beams and rods, with their gradients over the section.
module element_temperatures
   use deck_check, only: checked_deck
   use kinds, only: wp
   use lists, only: first_not_below
   use load_data, only: own_temperature_card
   use mesh_queries, only: element_points, is_beam, is_shell, n_points, own_column
   use model_data, only: a_bar, mesh_type, n_bars, slope_row, temperature_type
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: check_element_temperatures, set_element_temperatures

contains

   !> Errors of TEMPP1 and TEMPRB: missing elements, an element named twice in a set.
   subroutine check_element_temperatures(deck, mesh)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      integer :: i, k, twice
      integer, allocatable :: set_of(:) ! (elements, bars) set of the last card that named the element

      allocate (set_of(mesh%n_elements + size(mesh%bars)), source=0)
      do i = 1, size(deck%bulk%own_temperature)
         associate (card => deck%bulk%own_temperature(i))
            do k = 1, size(card%ranges%first)
               if (card%ranges%first(k) == 0) cycle ! reported already
               associate (named => named_by(mesh, card, k))
                  twice = findloc(set_of(named), card%set, dim=1)
                  if (size(named) == 0) then
                     call deck%field_error(card%line, card%ranges%at(k), 'there is no '//one_of(card%is_plate, &
                        'shell with this number; expected CQUAD4 or CTRIA3 with a PSHELL in a model of space', &
                        'beam or rod with this number; expected CBAR, CBEAM, CROD or CONROD'), called='EID')
                  else if (twice > 0) then
                     call deck%field_error(card%line, card%ranges%at(k), 'element '//integer_text(number_of(named(twice)))// &
                        ' has a '//one_of(card%is_plate, 'TEMPP1', 'TEMPRB')//' in set '//integer_text(card%set)//' already', &
                        called='EID')
                  end if
                  set_of(named) = card%set
               end associate
            end do
         end associate
      end do

   contains

      !> The number of the element or bar with this PLACE.
      integer function number_of(place)
         integer, intent(in) :: place

         if (place <= mesh%n_elements) number_of = mesh%element_id(min(place, mesh%n_elements))
         if (place > mesh%n_elements) number_of = mesh%bars(place - mesh%n_elements)%id
      end function number_of

   end subroutine check_element_temperatures

   !> The shells that range K of CARD names, or the beams and bars: places of elements, then of bars behind them.
   pure function named_by(mesh, card, k) result(named)
      type(mesh_type), intent(in)            :: mesh
      type(own_temperature_card), intent(in) :: card
      integer, intent(in)                    :: k
      integer, allocatable :: named(:)
      integer :: e, i

      associate (id => mesh%element_id, first => card%ranges%first(k), most => max(card%ranges%first(k), card%ranges%last(k)))
         named = [(e, e = first_not_below(id, first), min(first_not_below(id, most), size(id)))]
         named = pack(named, id(named) >= first .and. id(named) <= most)
         if (card%is_plate) then
            named = pack(named, [(is_shell(mesh, named(e)), e = 1, size(named))])
         else
            named = [pack(named, [(is_beam(mesh, named(e)), e = 1, size(named))]), &
                     pack([(mesh%n_elements + i, i = 1, n_bars(mesh))], &
                          mesh%bars%kind == a_bar .and. mesh%bars%id >= first .and. mesh%bars%id <= most)]
         end if
      end associate
   end function named_by

   !> Temperatures of the elements of SET from TEMPP1 and TEMPRB. Nodes that have no other temperature get that of these elements, and
   !! are then GIVEN.
   subroutine set_element_temperatures(deck, mesh, set, temperature, given)
      type(checked_deck), intent(in)        :: deck
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                   :: set
      type(temperature_type), intent(inout) :: temperature
      logical, intent(inout)                :: given(:)
      integer :: card_of(mesh%n_elements + size(mesh%bars)), i, k, node, parts(mesh%n_nodes)
      logical :: lacks(mesh%n_nodes)
      real(wp) :: total(mesh%n_nodes)

      if (all(deck%bulk%own_temperature%set /= set)) return
      card_of = 0
      do i = 1, size(deck%bulk%own_temperature)
         associate (card => deck%bulk%own_temperature(i))
            if (card%set /= set) cycle
            do k = 1, size(card%ranges%first)
               card_of(named_by(mesh, card, k)) = i
            end do
         end associate
      end do
      lacks = given
      total = 0.0_wp
      parts = 0
      do i = 1, size(card_of)
         if (i <= mesh%n_elements) then
            call add_part(element_points(mesh, i))
         else if (mesh%bars(i - mesh%n_elements)%kind == a_bar) then
            call add_part(mesh%bars(i - mesh%n_elements)%nodes)
         end if
      end do
      do k = 1, size(mesh%faces)
         associate (face => mesh%faces(k))
            total(face%node) = total(face%point)
            parts(face%node) = parts(face%point)
            lacks(face%node) = lacks(face%point)
         end associate
      end do
      do node = 1, n_points(mesh)
         if (given(node) .or. lacks(node) .or. parts(node) == 0) cycle
         temperature%at(node) = total(node)/parts(node)
         given(node) = .true.
      end do
      allocate (temperature%own(slope_row, size(mesh%structural%shells) + size(mesh%structural%beams) + size(mesh%bars)), &
                source=0.0_wp)
      do i = 1, size(card_of)
         if (card_of(i) == 0) cycle
         associate (card => deck%bulk%own_temperature(card_of(i)))
            if (i > mesh%n_elements) then
               associate (bar => mesh%bars(i - mesh%n_elements))
                  temperature%own(1, bar%column) = 0.5_wp*sum(card%mean - temperature%at(bar%nodes))
               end associate
            else
               associate (own => temperature%own(:, own_column(mesh, i)), nodes => element_points(mesh, i))
                  own(:size(nodes)) = card%mean(1) - temperature%at(nodes)
                  own(slope_row) = card%slope(1)
                  if (.not. card%is_plate) own(2:6) = [card%mean(2) - temperature%at(nodes(2)), card%slope]
               end associate
            end if
         end associate
      end do

   contains

      !> Add the temperature of element or bar I to its NODES.
      subroutine add_part(nodes)
         integer, intent(in) :: nodes(:)

         if (any(nodes == 0)) return ! reported already
         if (card_of(i) == 0) then
            lacks(nodes) = .true.
         else
            total(nodes) = total(nodes) + 0.5_wp*sum(deck%bulk%own_temperature(card_of(i))%mean)
            parts(nodes) = parts(nodes) + 1
         end if
      end subroutine add_part

   end subroutine set_element_temperatures

end module element_temperatures
