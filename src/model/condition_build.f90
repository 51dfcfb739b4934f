!> Supports and loads: which components are held, which forces act at the end of every stage.
module condition_build
   use bulk_data, only: support_card
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use model_data, only: model_type, stage_load_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_supports, build_loads

contains

   !> Nodes that some element holds, and the components that the SPC set of case control and PS of GRID support.
   subroutine build_supports(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i, node, set, set_line
      logical :: found

      allocate (model%held(model%dimension, model%n_nodes), source=.false.)
      allocate (model%used(model%n_nodes))
      model%used = model%first_at(2:) > model%first_at(:model%n_nodes)
      do i = 1, size(model%interface)
         do node = 1, 2
            if (model%interface(i)%nodes(node) > 0) model%used(model%interface(i)%nodes(node)) = .true.
         end do
      end do
      do i = 1, deck%bulk%n_grid
         if (deck%bulk%grid(i)%ps == 0) cycle
         call hold(model, model%node_table%find(deck%bulk%grid(i)%id), deck%bulk%grid(i)%ps)
      end do
      set = 0
      if (size(deck%control%stages) > 0) then
         set = deck%control%stages(1)%supports%id
         set_line = deck%control%stages(1)%supports%line
      end if
      found = .false.
      do i = 1, deck%bulk%n_support
         found = found .or. deck%bulk%support(i)%set == set
         call apply_support(deck, deck%bulk%support(i), deck%bulk%support(i)%set == set, model, errors)
      end do
      if (set > 0 .and. .not. found) call errors%add(set_line, 'SPC: there is no SPC, SPC1 or SPCM with set '// &
                                                     integer_text(set))
   end subroutine build_supports


   !> Check one support card, and hold its nodes where it is of the ACTIVE set.
   subroutine apply_support(deck, support, active, model, errors)
      type(deck_type), intent(in)          :: deck
      type(support_card), intent(in)       :: support
      logical, intent(in)                  :: active
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: e, k, node, surface
      logical :: any_node

      if (support%surface > 0) then
         surface = findloc(model%surfaces%id, support%surface, dim=1)
         if (surface == 0) then
            call add_field_error(deck%text, support%line, 3, 'PID', 'there is no PMARK '//integer_text(support%surface), errors)
            return
         end if
         if (.not. active) return
         do e = 1, model%surfaces(surface)%n
            do k = 1, 2
               call hold(model, model%surfaces(surface)%nodes(k, e), support%components)
            end do
         end do
         return
      end if
      do k = 1, size(support%first)
         if (support%first(k) == support%last(k)) then
            node = model%node_table%find(support%first(k))
            if (node == 0 .and. support%first(k) > 0) call add_field_error(deck%text, support%line, support%at(k), 'G', &
               'there is no GRID '//integer_text(support%first(k)), errors)
            if (node > 0 .and. active) call hold(model, node, support%components)
            cycle
         end if
         ! G1 THRU G2: the nodes that are there, as in NASTRAN; there must be one
         any_node = support%last(k) < support%first(k) ! said already
         do node = first_from(model, support%first(k)), model%n_nodes
            if (model%node_id(node) > support%last(k)) exit
            any_node = .true.
            if (active) call hold(model, node, support%components)
         end do
         if (.not. any_node) call add_field_error(deck%text, support%line, support%at(k), 'G', 'there is no GRID from '// &
            integer_text(support%first(k))//' to '//integer_text(support%last(k)), errors)
      end do
   end subroutine apply_support


   !> The first node whose number is ID or more.
   pure integer function first_from(model, id) result(node)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: id
      integer :: low, high, middle

      low = 1
      high = model%n_nodes + 1
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


   !> Hold NODE in COMPONENTS; those that a plane model does not have (3 to 6) are held anyway.
   pure subroutine hold(model, node, components)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: node, components
      integer :: rest, digit

      if (node == 0) return
      rest = components
      do while (rest > 0)
         digit = modulo(rest, 10)
         if (digit >= 1 .and. digit <= model%dimension) then
            model%held(digit, node) = .true.
            if (model%twin(node) > 0) model%held(digit, model%twin(node)) = .true. ! a split node: both of it
         end if
         rest = rest/10
      end do
   end subroutine hold


   !> The total load at the end of each stage.
   subroutine build_loads(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i, set, s

      call check_forces(deck, model, errors)
      allocate (model%stage_loads(size(deck%control%stages)))
      do s = 1, size(deck%control%stages)
         associate (loads => model%stage_loads(s), reference => deck%control%stages(s)%load)
            allocate (loads%node(deck%bulk%n_force), loads%force(3, deck%bulk%n_force))
            if (reference%id == 0) cycle
            i = findloc(deck%bulk%load(:deck%bulk%n_load)%set, reference%id, dim=1)
            if (i > 0) then
               do set = 1, size(deck%bulk%load(i)%sets)
                  call add_forces(deck, model, deck%bulk%load(i)%sets(set), &
                                  deck%bulk%load(i)%scale*deck%bulk%load(i)%factors(set), loads)
               end do
            else
               call add_forces(deck, model, reference%id, 1.0_wp, loads)
               if (loads%n == 0 .and. .not. any(deck%bulk%force(:deck%bulk%n_force)%set == reference%id)) &
                  call errors%add(reference%line, 'LOAD: there is no FORCE or LOAD with set '//integer_text(reference%id))
            end if
         end associate
      end do
   end subroutine build_loads


   !> Forces act on nodes that are there, in directions that they have; LOAD cards combine sets that are there.
   subroutine check_forces(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: i, k, node

      associate (bulk => deck%bulk)
         do i = 1, bulk%n_force
            node = model%node_table%find(bulk%force(i)%node)
            if (node == 0 .and. bulk%force(i)%node > 0) then
               call add_field_error(deck%text, bulk%force(i)%line, 2, 'G', 'there is no GRID '// &
                                    integer_text(bulk%force(i)%node), errors)
            else if (node > 0) then
               if (.not. model%used(node)) call add_field_error(deck%text, bulk%force(i)%line, 2, 'G', 'node '// &
                  integer_text(bulk%force(i)%node)//' belongs to no element', errors)
            end if
            if (abs(bulk%force(i)%force(3)) > 0.0_wp) call add_field_error(deck%text, bulk%force(i)%line, 7, 'N3', &
               'not zero, but a plane model lies in x-y', errors)
         end do
         do i = 1, bulk%n_load
            do k = 1, size(bulk%load(i)%sets)
               if (.not. any(bulk%force(:bulk%n_force)%set == bulk%load(i)%sets(k)) .and. bulk%load(i)%sets(k) > 0) &
                  call add_field_error(deck%text, bulk%load(i)%line, bulk%load(i)%at(k), 'L'//integer_text(k), &
                                       'there is no FORCE with set '//integer_text(bulk%load(i)%sets(k)), errors)
            end do
            if (any(bulk%force(:bulk%n_force)%set == bulk%load(i)%set)) call add_field_error(deck%text, bulk%load(i)%line, 1, &
               'SID', 'set '//integer_text(bulk%load(i)%set)//' is that of a FORCE too: case control could mean either', errors)
         end do
      end associate
   end subroutine check_forces


   !> Add FACTOR times the forces of SET to LOADS.
   subroutine add_forces(deck, model, set, factor, loads)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      integer,  allocatable :: node(:)
      real(wp), allocatable :: force(:, :)
      integer :: i

      do i = 1, deck%bulk%n_force
         if (deck%bulk%force(i)%set /= set) cycle
         if (loads%n == size(loads%node)) then ! a set may count more than once in a LOAD
            allocate (node(2*loads%n), force(3, 2*loads%n))
            node(:loads%n) = loads%node
            force(:, :loads%n) = loads%force
            call move_alloc(node, loads%node)
            call move_alloc(force, loads%force)
         end if
         loads%n = loads%n + 1
         loads%node(loads%n) = model%node_table%find(deck%bulk%force(i)%node)
         loads%force(:, loads%n) = factor*deck%bulk%force(i)%force
      end do
   end subroutine add_forces

end module condition_build
