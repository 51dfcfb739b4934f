!> Supports: which components of which nodes are held.
module support_build
   use bulk_data, only: has_component, support_card
   use deck_check, only: checked_deck
   use model_data, only: model_type, n_bars, n_points
   use reference_nodes, only: place_of_component
   use set_sums, only: check_sums, summed_sets
   use surface_build, only: find_surface
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_supports, support_sets

contains

   !> Nodes that some element holds, and the components that the SPC set of case control and PS of GRID support.
   subroutine build_supports(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      integer, allocatable :: sets(:)
      integer :: i, set, set_line

      allocate (model%held(model%dimension, model%n_nodes), source=.false.)
      allocate (model%used(model%n_nodes))
      model%used = model%first_at(2:) > model%first_at(:model%n_nodes)
      do i = 1, size(model%interface)
         model%used(model%interface(i)%node) = .true.
      end do
      do i = 1, n_bars(model)
         model%used(pack(model%bars(i)%nodes, model%bars(i)%nodes > 0)) = .true.
      end do
      do i = 1, size(deck%bulk%grid)
         if (deck%bulk%grid(i)%ps == 0) cycle
         call hold(model, model%node_table%find(deck%bulk%grid(i)%id), deck%bulk%grid(i)%ps)
      end do
      set = 0
      if (size(deck%control%stages) > 0) then
         set = deck%control%stages(1)%supports%id
         set_line = deck%control%stages(1)%supports%line
      end if
      allocate (sets, source=support_sets(deck))
      do i = 1, size(deck%bulk%support)
         call apply_support(deck, deck%bulk%support(i), any(sets == deck%bulk%support(i)%set), model)
      end do
      call check_sums(deck, 'SPCADD', deck%bulk%support_sum, deck%bulk%support%set, 'SPC, SPC1 or SPCM')
      if (set > 0 .and. all(deck%bulk%support%set /= set) .and. all(deck%bulk%support_sum%set /= set)) &
         call deck%errors%add(set_line, 'SPC: there is no SPC, SPC1, SPCM or SPCADD with set '//integer_text(set))
   end subroutine build_supports

   !> The sets of supports that hold: that of case control, or those of its SPCADD.
   pure function support_sets(deck) result(sets)
      type(checked_deck), intent(in) :: deck
      integer, allocatable :: sets(:)
      integer :: set

      set = 0
      if (size(deck%control%stages) > 0) set = deck%control%stages(1)%supports%id
      sets = summed_sets(deck%bulk%support_sum, set)
   end function support_sets

   !> Check one support card, and hold its nodes where it is of the ACTIVE set.
   subroutine apply_support(deck, support, active, model)
      type(checked_deck), intent(in)  :: deck
      type(support_card), intent(in)  :: support
      logical, intent(in)             :: active
      type(model_type), intent(inout) :: model
      integer, allocatable :: nodes(:)
      integer :: k, node, surface
      logical :: any_node

      if (support%surface > 0) then
         call find_surface(deck, support%line, 'PID', support%surface, model, surface)
         if (surface == 0 .or. .not. active) return
         nodes = nodes_of(model%surfaces(surface))
         do k = 1, size(nodes)
            call hold(model, nodes(k), support%components)
         end do
         return
      end if
      do k = 1, size(support%first)
         if (support%first(k) == support%last(k)) then
            node = model%node_table%find(support%first(k))
            if (node > 0 .and. active) call hold(model, node, support%components)
            cycle
         end if
         ! G1 THRU G2: the nodes that are there, as in NASTRAN; there must be one
         any_node = support%last(k) < support%first(k) ! said already
         do node = first_from(model, support%first(k)), n_points(model)
            if (model%node_id(node) > support%last(k)) exit
            any_node = .true.
            if (active) call hold(model, node, support%components)
         end do
         if (.not. any_node) call deck%field_error(support%line, support%at(k), 'there is no GRID from '// &
            integer_text(support%first(k))//' to '//integer_text(support%last(k)), called='G')
      end do
   end subroutine apply_support

   !> The first node whose number is ID or more.
   pure integer function first_from(model, id) result(node)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: id
      integer :: low, high, middle

      low = 1
      high = n_points(model) + 1
      do while (low < high)
         middle = (low + high)/2
         if (model%node_id(middle) < id) then
            low = middle + 1
         else
            high = middle
         end if
      end do
      node = low
   end function first_from

   !> Hold NODE in COMPONENTS, those of rotations where it has any; what a node does not have (3 to 5 in the plane) is held anyway.
   pure subroutine hold(model, node, components)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: node, components
      integer :: d

      if (node == 0) return
      do d = 1, 6
         if (.not. has_component(components, d)) cycle
         associate (place => place_of_component(model, node, d))
            if (place%node == 0) cycle
            model%held(place%d, place%node) = .true.
            if (model%twin(place%node) > 0) model%held(d, model%twin(node)) = .true. ! a split node: both of it
         end associate
      end do
   end subroutine hold

end module support_build
