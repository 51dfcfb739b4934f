!> Temperatures of nodes and shells at the end of every stage, from TEMP, TEMPD and TEMPP1.
module temperature_build
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use kinds, only: wp
   use lists, only: first_not_below
   use model_data, only: a_bar, corners_of, is_shell, model_type, n_bars, n_points, temperature_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_temperatures

contains

   !> The nodal temperatures of every stage that names a set of TEMP and TEMPD cards, in its load of MODEL.
   subroutine build_temperatures(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      logical, allocatable :: given(:)
      logical :: needs_one(model%n_nodes) ! nodes of bodies and bars
      integer :: before, i, s

      call check_cards(deck, model)
      do s = 1, size(deck%control%stages)
         associate (reference => deck%control%stages(s)%temperature, stages => deck%control%stages)
            if (reference%id == 0) cycle
            before = findloc(stages(:s - 1)%temperature%id, reference%id, dim=1)
            if (before > 0) then
               model%stage_loads(s)%temperature = model%stage_loads(before)%temperature
               cycle
            end if
            if (all(deck%bulk%temperature%set /= reference%id) .and. all(deck%bulk%plate_temperature%set /= reference%id)) then
               call deck%errors%add(reference%line, 'TEMPERATURE: there is no TEMP, TEMPD or TEMPP1 with set '// &
                                    integer_text(reference%id))
               cycle
            end if
            if (all(abs(model%properties%alpha) <= 0.0_wp) .and. all(abs(model%bars%expansion) <= 0.0_wp)) then
               call deck%errors%add(reference%line, 'TEMPERATURE: nothing expands; give A on a MAT1')
               cycle
            end if
            associate (temperature => model%stage_loads(s)%temperature)
               allocate (temperature%at(model%n_nodes), source=0.0_wp)
               temperature%reference_share = 1.0_wp
               call fill_in(deck, model, reference%id, temperature%at, given)
               call set_plate_temperatures(deck, model, reference%id, temperature, given)
            end associate
            if (deck%errors%any()) cycle
            needs_one = model%first_at(2:) > model%first_at(:model%n_nodes)
            do i = 1, n_bars(model)
               if (model%bars(i)%kind == a_bar) needs_one(model%bars(i)%nodes) = .true.
            end do
            i = findloc(needs_one(:n_points(model)) .and. .not. given(:n_points(model)), .true., dim=1)
            if (i > 0) call deck%errors%add(reference%line, 'TEMPERATURE: node '//integer_text(model%node_id(i))// &
               ' has no temperature in set '//integer_text(reference%id)//'; expected a TEMP of it, or a TEMPD')
         end associate
      end do
   end subroutine build_temperatures

   !> Errors of TEMP and TEMPP1: missing nodes or shells, a node or shell named twice in a set; of TEMPD: two of one set.
   subroutine check_cards(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer :: i, k, node, twice
      integer, allocatable :: last(:)   ! (nodes) last card that named the node
      integer, allocatable :: set_of(:) ! (elements) set of the last TEMPP1 that named the element

      allocate (last(model%n_nodes), source=0)
      do i = 1, size(deck%bulk%temperature)
         associate (card => deck%bulk%temperature(i))
            if (card%is_default) then
               k = findloc(deck%bulk%temperature(:i - 1)%is_default .and. deck%bulk%temperature(:i - 1)%set == card%set, &
                           .true., dim=1)
               if (k > 0 .and. card%set > 0) call deck%field_error(card%line, card%field, 'set '//integer_text(card%set)// &
                  ' has a TEMPD already, in '//deck%text%place(deck%bulk%temperature(k)%line))
               cycle
            end if
            if (card%node == 0) cycle
            node = model%node_table%find(card%node)
            if (node == 0) then
               call deck%field_error(card%line, card%field, 'there is no GRID '//integer_text(card%node))
               cycle
            end if
            k = last(node)
            last(node) = i
            if (k == 0) cycle
            if (deck%bulk%temperature(k)%set == card%set) call deck%field_error(card%line, card%field, 'node '// &
               integer_text(card%node)//' has a temperature in set '//integer_text(card%set)//' already, in '// &
               deck%text%place(deck%bulk%temperature(k)%line))
         end associate
      end do

      allocate (set_of(model%n_elements), source=0)
      do i = 1, size(deck%bulk%plate_temperature)
         associate (card => deck%bulk%plate_temperature(i))
            do k = 1, size(card%ranges%first)
               if (card%ranges%first(k) == 0) cycle ! reported already
               associate (named => plates_of(model, card%ranges%first(k), card%ranges%last(k)))
                  twice = findloc(set_of(named), card%set, dim=1)
                  if (size(named) == 0) then
                     call deck%field_error(card%line, card%ranges%at(k), 'there is no shell with this number; expected '// &
                                           'CQUAD4 or CTRIA3 with a PSHELL in a model of space', called='EID')
                  else if (twice > 0) then
                     call deck%field_error(card%line, card%ranges%at(k), 'element '// &
                                           integer_text(model%element_id(named(twice)))//' has a TEMPP1 in set '// &
                                           integer_text(card%set)//' already', called='EID')
                  end if
                  set_of(named) = card%set
               end associate
            end do
         end associate
      end do
   end subroutine check_cards

   !> The temperatures AT all nodes in SET, and whether they are GIVEN: by TEMP, else by TEMPD. The duplicate of a node and the face
   !! node of a shell have the temperature of their node, an added mid-edge node has the mean of the ends.
   subroutine fill_in(deck, model, set, at, given)
      type(checked_deck), intent(in)    :: deck
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: set
      real(wp), intent(inout)           :: at(:)
      logical, allocatable, intent(out) :: given(:)
      logical :: is_filled(model%n_nodes)
      integer :: corners(2), e, i, k, node

      allocate (given(model%n_nodes), source=.false.)
      do i = 1, size(deck%bulk%temperature)
         associate (card => deck%bulk%temperature(i))
            if (card%is_default .or. card%set /= set) cycle
            node = model%node_table%find(card%node)
            if (node == 0) cycle
            at(node) = card%value
            given(node) = .true.
         end associate
      end do
      is_filled = .false.
      is_filled(model%first_filled:model%first_filled + model%n_filled - 1) = .true.
      do i = 1, n_points(model)
         if (model%duplicate(i) == 0) cycle
         associate (duplicate => model%duplicate(i))
            if (given(i) .and. .not. given(duplicate)) at(duplicate) = at(i)
            given(duplicate) = given(duplicate) .or. given(i)
            is_filled(duplicate) = is_filled(i)
         end associate
      end do
      i = findloc(deck%bulk%temperature%is_default .and. deck%bulk%temperature%set == set, .true., dim=1)
      if (i > 0) then
         where (.not. (given .or. is_filled)) at = deck%bulk%temperature(i)%value
         given = given .or. .not. is_filled
      end if
      do e = 1, model%n_elements
         associate (kind => element_table(model%element_kind(e)), nodes => corners_of(model, e))
            do k = kind%n_corners + 1, kind%n_nodes
               if (any(nodes == 0)) exit
               corners = nodes(kind%edges(:, k - kind%n_corners))
               if (given(nodes(k)) .or. .not. all(given(corners))) cycle
               at(nodes(k)) = 0.5_wp*sum(at(corners))
               given(nodes(k)) = .true.
            end do
         end associate
      end do
      if (.not. allocated(model%faces)) return
      do k = 1, size(model%faces)
         associate (face => model%faces(k))
            at(face%node) = at(face%point)
            given(face%node) = given(face%point)
         end associate
      end do
   end subroutine fill_in

   !> The shells with numbers from FIRST to LAST.
   pure function plates_of(model, first, last) result(named)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: first, last
      integer, allocatable :: named(:)
      integer :: e

      associate (id => model%element_id, low => first_not_below(model%element_id, first), most => max(first, last))
         named = [(e, e = low, min(first_not_below(id, most), size(id)))]
         named = pack(named, id(named) >= first .and. id(named) <= most)
      end associate
      named = pack(named, [(is_shell(model, named(e)), e = 1, size(named))])
   end function plates_of

   !> Temperatures of the shells of SET from TEMPP1. Nodes that have no other temperature get that of these shells, and are then
   !! GIVEN.
   subroutine set_plate_temperatures(deck, model, set, temperature, given)
      type(checked_deck), intent(in)        :: deck
      type(model_type), intent(in)          :: model
      integer, intent(in)                   :: set
      type(temperature_type), intent(inout) :: temperature
      logical, intent(inout)                :: given(:)
      integer :: card_of(model%n_elements), e, i, k, node

      if (all(deck%bulk%plate_temperature%set /= set)) return
      card_of = 0
      do i = 1, size(deck%bulk%plate_temperature)
         associate (card => deck%bulk%plate_temperature(i))
            do k = 1, merge(size(card%ranges%first), 0, card%set == set)
               card_of(plates_of(model, card%ranges%first(k), card%ranges%last(k))) = i
            end do
         end associate
      end do
      do node = 1, n_points(model)
         associate (around => model%elements_at(model%first_at(node):model%first_at(node + 1) - 1))
            if (given(node) .or. size(around) == 0 .or. any(card_of(around) == 0)) cycle
            temperature%at(node) = sum(deck%bulk%plate_temperature(card_of(around))%mean)/size(around)
            given(node) = .true.
         end associate
      end do
      allocate (temperature%plate(5, size(model%structural%shells)), source=0.0_wp)
      do e = 1, model%n_elements
         if (card_of(e) == 0) cycle
         associate (card => deck%bulk%plate_temperature(card_of(e)), nodes => corners_of(model, e), &
                    place => model%structural%place(e))
            temperature%plate(:size(nodes), place) = card%mean - temperature%at(nodes)
            temperature%plate(5, place) = card%slope
         end associate
      end do
   end subroutine set_plate_temperatures

end module temperature_build
