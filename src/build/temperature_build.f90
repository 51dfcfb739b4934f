!> Temperatures from TEMP, TEMPD and TEMPP1: how warm nodes and shells are at the end of every stage.
module temperature_build
   use bulk_data, only: plate_temperature_card
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use kinds, only: wp
   use lists, only: id_table_type
   use model_data, only: a_bar, corners_of, is_shell, model_type, n_bars, n_points, temperature_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_temperatures

contains

   !> Of every stage that names a set of TEMP and TEMPD cards the temperatures of all nodes, in its load of MODEL.
   subroutine build_temperatures(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      logical, allocatable :: given(:)
      type(id_table_type) :: elements
      integer :: before, s

      call check_nodes(deck, model)
      if (size(deck%bulk%plate_temperature) > 0) call elements%build(model%element_id)
      call check_plates(deck, model, elements)
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
            if (all(abs(model%properties%alpha) <= 0.0_wp) .and. .not. has_warm_bar(model)) then
               call deck%errors%add(reference%line, 'TEMPERATURE: nothing expands; give A on a MAT1')
               cycle
            end if
            associate (temperature => model%stage_loads(s)%temperature)
               allocate (temperature%at(model%n_nodes), source=0.0_wp)
               temperature%reference_share = 1.0_wp
               call fill_in(deck, model, reference%id, temperature%at, given)
               call warm_plates(deck, model, elements, reference%id, temperature, given)
            end associate
            if (.not. deck%errors%any()) call check_whole(deck, model, s, given)
         end associate
      end do
   end subroutine build_temperatures

   !> Whether any bar expands.
   pure logical function has_warm_bar(model)
      type(model_type), intent(in) :: model

      has_warm_bar = .false.
      if (n_bars(model) > 0) has_warm_bar = any(abs(model%bars%expansion) > 0.0_wp)
   end function has_warm_bar

   !> TEMP cards name nodes that are there, each once a set; a set has one TEMPD.
   subroutine check_nodes(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer :: i, k, node
      integer, allocatable :: last(:) ! (nodes) card that named it last

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
   end subroutine check_nodes

   !> The temperatures AT all nodes in SET, and which are GIVEN: by TEMP, else by TEMPD; the twin of a node of a split surface has
   !! the same, a node on the face of a shell that of the shell, a node put at the middle of an edge the mean of its ends.
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
         associate (twin => model%duplicate(i))
            if (given(i) .and. .not. given(twin)) at(twin) = at(i)
            given(twin) = given(twin) .or. given(i)
            is_filled(twin) = is_filled(i)
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

   !> Every TEMPP1 names shells, each of them once a set.
   subroutine check_plates(deck, model, shells)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(in)    :: model
      type(id_table_type), intent(in) :: shells !! their numbers
      integer :: i, j, k
      integer, allocatable :: last(:) ! (elements) card that named it last

      allocate (last(model%n_elements), source=0)
      do i = 1, size(deck%bulk%plate_temperature)
         associate (card => deck%bulk%plate_temperature(i))
            if (card%element == 0) cycle ! said already
            do k = 0, size(card%ranges%first)
               associate (named => plates_of(model, shells, card, k), at => merge(card%ranges%at(max(k, 1)), 2, k > 0))
                  if (size(named) == 0) call deck%field_error(card%line, at, 'there is no shell with this number; '// &
                     'expected CQUAD4 or CTRIA3 with a PSHELL in a model of space', called='EID')
                  do j = 1, size(named)
                     if (last(named(j)) > 0) then
                        if (deck%bulk%plate_temperature(last(named(j)))%set == card%set) then
                           call deck%field_error(card%line, at, 'element '//integer_text(model%element_id(named(j)))// &
                              ' has a TEMPP1 in set '//integer_text(card%set)//' already, in '// &
                              deck%text%place(deck%bulk%plate_temperature(last(named(j)))%line), called='EID')
                           exit
                        end if
                     end if
                     last(named(j)) = i
                  end do
               end associate
            end do
         end associate
      end do
   end subroutine check_plates

   !> The shells that CARD names in its range K; 0: the first element alone.
   pure function plates_of(model, shells, card, k) result(named)
      type(model_type), intent(in)             :: model
      type(id_table_type), intent(in)          :: shells
      type(plate_temperature_card), intent(in) :: card
      integer, intent(in)                      :: k
      integer, allocatable :: named(:)
      integer :: e, range(2)

      range = card%element
      if (k > 0) range = [card%ranges%first(k), card%ranges%last(k)]
      if (range(1) < range(2)) then
         named = pack([(e, e = 1, model%n_elements)], model%element_id >= range(1) .and. model%element_id <= range(2))
         named = pack(named, [(is_shell(model, named(e)), e = 1, size(named))])
      else
         named = pack([shells%find(range(1))], [shells%find(range(1)) > 0])
      end if
   end function plates_of

   !> The shells of SET that TEMPP1 warms. Nodes that have no temperature but that of such shells get it, and are GIVEN then.
   subroutine warm_plates(deck, model, shells, set, temperature, given)
      type(checked_deck), intent(in)        :: deck
      type(model_type), intent(in)          :: model
      type(id_table_type), intent(in)       :: shells
      integer, intent(in)                   :: set
      type(temperature_type), intent(inout) :: temperature
      logical, intent(inout)                :: given(:)
      integer :: card_of(model%n_elements), e, i, k, node

      if (all(deck%bulk%plate_temperature%set /= set)) return
      card_of = 0
      do i = 1, size(deck%bulk%plate_temperature)
         if (deck%bulk%plate_temperature(i)%set /= set .or. deck%bulk%plate_temperature(i)%element == 0) cycle
         do k = 0, size(deck%bulk%plate_temperature(i)%ranges%first)
            card_of(plates_of(model, shells, deck%bulk%plate_temperature(i), k)) = i
         end do
      end do
      do node = 1, n_points(model)
         associate (elements => model%elements_at(model%first_at(node):model%first_at(node + 1) - 1))
            if (given(node) .or. size(elements) == 0 .or. any(card_of(elements) == 0)) cycle
            temperature%at(node) = sum(deck%bulk%plate_temperature(card_of(elements))%mean)/size(elements)
            given(node) = .true.
         end associate
      end do
      allocate (temperature%plate(5, size(model%structural%shells)), source=0.0_wp)
      do e = 1, model%n_elements
         if (card_of(e) == 0) cycle
         associate (card => deck%bulk%plate_temperature(card_of(e)), nodes => corners_of(model, e), &
                    plate => temperature%plate(:, model%structural%place(e)))
            plate(:size(nodes)) = card%mean - temperature%at(nodes)
            plate(5) = card%slope
         end associate
      end do
   end subroutine warm_plates

   !> Every node of a body or of a bar has a temperature in stage S.
   subroutine check_whole(deck, model, s, given)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: s
      logical, intent(in)            :: given(:)
      integer :: i

      associate (reference => deck%control%stages(s)%temperature)
         do i = 1, n_points(model)
            if (given(i) .or. .not. is_warmed(i)) cycle
            call deck%errors%add(reference%line, 'TEMPERATURE: node '//integer_text(model%node_id(i))// &
               ' has no temperature in set '//integer_text(reference%id)//'; expected a TEMP of it, or a TEMPD')
            return
         end do
      end associate

   contains

      pure logical function is_warmed(node)
         integer, intent(in) :: node
         integer :: k

         is_warmed = model%first_at(node + 1) > model%first_at(node)
         do k = 1, n_bars(model)
            is_warmed = is_warmed .or. (model%bars(k)%kind == a_bar .and. any(model%bars(k)%nodes == node))
         end do
      end function is_warmed

   end subroutine check_whole

end module temperature_build
