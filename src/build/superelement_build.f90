!> The components of nodes on which OUTPUT = DMIG condenses the structure, those of ASET cards, and the coordinates of QSET cards for its
!! modes.
module superelement_build
   use deck_check, only: checked_deck
   use field_rules, only: has_component
   use kinds, only: wp
   use model_data, only: freedoms_type, mesh_type
   use text_tools, only: integer_text
   use unknowns, only: component_place, place_of_component
   implicit none
   private

   public :: find_retained

   type, public :: retained_type
      integer, allocatable :: id(:), component(:) !! (n) as in the deck, in ascending order
      type(component_place), allocatable :: place(:) !! (n) of their unknowns
      integer, allocatable :: mode_id(:), mode_component(:) !! coordinates of modes; none: the program numbers them
   end type retained_type

contains

   !> Find what the cards of DECK retain. Errors: components that do not exist, or are no unknowns.
   subroutine find_retained(deck, mesh, freedoms, retained)
      type(checked_deck), intent(in)   :: deck
      type(mesh_type), intent(in)      :: mesh
      type(freedoms_type), intent(in)  :: freedoms
      type(retained_type), intent(out) :: retained
      type(component_place) :: place
      logical :: is_wanted(6, mesh%n_nodes)
      integer :: c, i, id, k, node

      is_wanted = .false.
      allocate (retained%id(0), retained%component(0), retained%place(0), retained%mode_id(0), retained%mode_component(0))
      do i = 1, size(deck%bulk%matrices%retained)
         associate (card => deck%bulk%matrices%retained(i))
            do k = 1, size(card%nodes%first)
               do id = card%nodes%first(k), card%nodes%last(k)
                  node = mesh%node_table%find(id)
                  if (node == 0 .and. .not. card%of_modes .and. card%nodes%first(k) == card%nodes%last(k)) &
                     call deck%field_error(card%line, card%nodes%at(k), 'there is no GRID '//integer_text(id), called='G')
                  do c = 0, 6
                     if (.not. merge(card%components == 0, has_component(card%components, max(1, c)), c == 0)) cycle
                     if (card%of_modes) then
                        retained%mode_id = [retained%mode_id, id]
                        retained%mode_component = [retained%mode_component, c]
                     else if (node > 0) then
                        is_wanted(max(1, c), node) = .true.
                        place = place_of_component(mesh, node, max(1, c))
                        if (place%node > 0) then
                           if ((freedoms%held(place%d, place%node) .and. .not. freedoms%floats) .or. &
                               .not. freedoms%used(place%node)) place%node = 0
                        end if
                        if (place%node == 0) call deck%field_error(card%line, card%nodes%at(k), 'component '//integer_text(c)// &
                           ' of node '//integer_text(id)//' is supported, depends on others or does not exist', called='G')
                     end if
                  end do
               end do
            end do
         end associate
      end do
      do node = 1, mesh%n_nodes
         do c = 1, 6
            if (.not. is_wanted(c, node)) cycle
            retained%id = [retained%id, mesh%node_id(node)]
            retained%component = [retained%component, c]
            retained%place = [retained%place, place_of_component(mesh, node, c)]
         end do
      end do
      k = findloc(deck%control%stages%output%dmig, .true., dim=1)
      if (all(deck%bulk%matrices%retained%of_modes) .and. k > 0) call deck%errors%add(deck%control%stages(k)%output%line, &
         'OUTPUT: DMIG needs ASET or ASET1 cards, the components of nodes on which stiffness and mass are condensed')
   end subroutine find_retained

end module superelement_build
