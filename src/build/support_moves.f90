!> Supports that are moved: by SPCD, a total at the end of a stage among its loads, and by D of SPC, which stays from the end of the
!! first stage on.
module support_moves
   use bulk_data, only: has_component
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type, stage_load_type
   use reference_nodes, only: component_place, place_of_component
   use support_build, only: support_sets
   use text_tools, only: integer_text
   implicit none
   private

   public :: add_moves, keep_moved, check_kept

   integer, parameter :: most_places = 12 ! of one node: six components, of a split node twice

contains

   !> Add FACTOR times what the SPCD cards of load set SET move to LOADS.
   subroutine add_moves(deck, model, set, factor, loads)
      type(checked_deck), intent(in)       :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      type(component_place) :: places(most_places)
      integer :: i, k

      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            if (card%set /= set) cycle
            places = places_of(model, card%node, card%components)
            call provide(model, loads)
            do k = 1, count(places%node > 0)
               associate (moved => loads%moved(places(k)%d, places(k)%node))
                  moved = moved + factor*card%value*places(k)%scale
               end associate
            end do
         end associate
      end do
   end subroutine add_moves

   !> What SPC cards with D ask for at the end of a stage with load set SET: LOADS, without movements so far, moves the components
   !! that they hold to D, but for those that an SPCD among these loads names.
   subroutine keep_moved(deck, model, set, loads)
      type(checked_deck), intent(in)       :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: set !! of case control, 0: none
      type(stage_load_type), intent(inout) :: loads
      type(component_place) :: places(most_places)
      integer, allocatable :: holding(:), sets(:)
      integer :: i, k

      if (all(abs(deck%bulk%support%value) <= 0.0_wp)) return
      allocate (holding, source=support_sets(deck))
      do i = 1, size(deck%bulk%support)
         associate (card => deck%bulk%support(i))
            if (abs(card%value) <= 0.0_wp .or. all(holding /= card%set)) cycle
            places = places_of(model, card%first(1), card%components)
            call provide(model, loads)
            do k = 1, count(places%node > 0)
               loads%moved(places(k)%d, places(k)%node) = card%value*places(k)%scale
            end do
         end associate
      end do
      if (.not. allocated(loads%moved) .or. set == 0) return
      sets = [set]
      k = findloc(deck%bulk%load%set, set, dim=1)
      if (k > 0) sets = deck%bulk%load(k)%sets
      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            if (all(sets /= card%set)) cycle
            places = places_of(model, card%node, card%components)
            do k = 1, count(places%node > 0)
               loads%moved(places(k)%d, places(k)%node) = 0.0_wp
            end do
         end associate
      end do
   end subroutine keep_moved

   !> Errors: D of a component that the node does not have, and two SPC that hold a component at different D.
   subroutine check_kept(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(component_place) :: places(most_places)
      integer, allocatable :: holding(:), by(:, :) ! which card moves a component, 0: none
      integer :: d, i, other

      if (all(abs(deck%bulk%support%value) <= 0.0_wp)) return
      allocate (holding, source=support_sets(deck))
      allocate (by(model%dimension, model%n_nodes), source=0)
      do i = 1, size(deck%bulk%support)
         associate (card => deck%bulk%support(i))
            if (abs(card%value) <= 0.0_wp) cycle
            if (model%node_table%find(card%first(1)) == 0) cycle ! said already
            do d = 1, 6
               if (.not. has_component(card%components, d)) cycle
               places = places_of(model, card%first(1), d)
               if (places(1)%node == 0) then
                  call deck%field_error(card%line, card%at(1) + 1, named(d, card%first(1))// &
                     ' is not there to be moved by D; expected 1 to '//integer_text(model%dimension), called='C')
               else if (any(holding == card%set)) then
                  other = by(places(1)%d, places(1)%node) ! a twin has what the node has
                  by(places(1)%d, places(1)%node) = i
                  if (other == 0) cycle
                  if (abs(deck%bulk%support(other)%value - card%value) > 0.0_wp) call deck%field_error(card%line, &
                     card%at(1) + 2, named(d, card%first(1))//' is held at another displacement by the SPC of '// &
                     deck%text%place(deck%bulk%support(other)%line), called='D')
               end if
            end do
         end associate
      end do

   contains

      function named(d, id) result(words)
         integer, intent(in) :: d, id
         character(:), allocatable :: words

         words = 'component '//integer_text(d)//' of node '//integer_text(id)
      end function named

   end subroutine check_kept

   !> Where the COMPONENTS of the node with number ID stand, those that it has first, then places of no node; of a split node those
   !! of its twin too.
   pure function places_of(model, id, components) result(places)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: id, components
      type(component_place) :: places(most_places)
      type(component_place) :: place
      integer :: d, n, node

      n = 0
      node = model%node_table%find(id)
      if (node == 0) return
      do d = 1, 6
         if (.not. has_component(components, d)) cycle
         place = place_of_component(model, node, d)
         if (place%node == 0) cycle
         n = n + 1
         places(n) = place
         place%node = model%twin(place%node)
         if (place%node == 0) cycle
         n = n + 1
         places(n) = place
      end do
   end function places_of

   pure subroutine provide(model, loads)
      type(model_type), intent(in)         :: model
      type(stage_load_type), intent(inout) :: loads

      if (.not. allocated(loads%moved)) allocate (loads%moved(model%dimension, model%n_nodes), source=0.0_wp)
   end subroutine provide

end module support_moves
