!> Temperatures of nodes, shells and beams at the end of every stage, from TEMP, TEMPD, TEMPP1 and TEMPRB.
module temperature_build
   use bulk_data, only: rigid_card
   use constraint_equations, only: expansion_type
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use element_temperatures, only: check_element_temperatures, set_element_temperatures
   use field_rules, only: has_component
   use kinds, only: wp
   use mesh_queries, only: element_points, n_points
   use model_data, only: a_bar, freedoms_type, history_type, mesh_type, n_bars, stage_load_type
   use support_build, only: differ
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: least_misfit
   use unknowns, only: node_axes
   implicit none
   private

   public :: build_temperatures

contains

   !> The nodal temperatures of every stage that names a set of TEMP and TEMPD cards, in its load of the model; EXPANSIONS of rigid
   !! elements as movements of held components.
   subroutine build_temperatures(deck, expansions, mesh, freedoms, history)
      type(checked_deck), intent(in)  :: deck
      type(expansion_type), intent(in) :: expansions(:)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(history_type), intent(inout) :: history
      logical, allocatable :: given(:)
      logical :: needs_one(mesh%n_nodes) ! nodes of bodies and bars
      integer :: before, i, k, s

      call check_cards(deck, mesh)
      call check_element_temperatures(deck, mesh)
      do s = 1, size(deck%control%stages)
         associate (reference => deck%control%stages(s)%temperature, stages => deck%control%stages)
            if (reference%id == 0) cycle
            before = findloc(stages(:s - 1)%temperature%id, reference%id, dim=1)
            if (before > 0) then
               history%stages(s)%temperature = history%stages(before)%temperature
               cycle
            end if
            if (all(deck%bulk%temperature%set /= reference%id) .and. all(deck%bulk%own_temperature%set /= reference%id)) then
               call deck%errors%add(reference%line, 'TEMPERATURE: there is no TEMP, TEMPD, TEMPP1 or '// &
                                    'TEMPRB with set '//integer_text(reference%id))
               cycle
            end if
            if (.not. (expands(mesh) .or. size(expansions) > 0)) then
               call deck%errors%add(reference%line, 'TEMPERATURE: nothing expands, because no element has a material '// &
                                    'with A; expected one, as on MAT1')
               cycle
            end if
            associate (temperature => history%stages(s)%temperature)
               allocate (temperature%at(mesh%n_nodes), source=0.0_wp)
               temperature%reference_share = 1.0_wp
               call fill_in(deck, mesh, reference%id, temperature%at, given)
               call set_element_temperatures(deck, mesh, reference%id, temperature, given)
            end associate
            if (deck%errors%any()) cycle
            needs_one = mesh%first_at(2:) > mesh%first_at(:mesh%n_nodes)
            do i = 1, n_bars(mesh)
               if (mesh%bars(i)%kind == a_bar) needs_one(mesh%bars(i)%nodes) = .true.
            end do
            do k = 1, size(expansions)
               needs_one(expansions(k)%points) = .true.
            end do
            i = findloc(needs_one(:n_points(mesh)) .and. .not. given(:n_points(mesh)), .true., dim=1)
            if (i > 0) call deck%errors%add(reference%line, 'TEMPERATURE: node '//integer_text(mesh%node_id(i))// &
               ' has no temperature in set '//integer_text(reference%id)//'; expected a TEMP of it, or a TEMPD')
         end associate
      end do
      if (deck%errors%any()) return
      do s = 2, size(history%stages)
         if (history%stages(s)%from == 0) cycle
         associate (a => history%stages(history%stages(s)%from)%temperature, b => history%stages(s)%temperature)
            history%stages(s)%changes(3) = abs(a%reference_share - b%reference_share) > 0.0_wp .or. differ(a%own, b%own)
            if (allocated(a%at) .and. allocated(b%at)) history%stages(s)%changes(3) = history%stages(s)%changes(3) .or. &
               any(abs(a%at - b%at) > 0.0_wp)
         end associate
      end do
      do s = 1, size(history%stages)
         call expand(expansions, history%stages(s), mesh)
      end do
      call deck%errors%warn(reference_words(deck, mesh, freedoms, history))
      call deck%errors%warn(squeeze_words(deck, mesh, history))
   end subroutine build_temperatures

   !> Whether a body, a shell or a bar expands with temperature.
   pure logical function expands(mesh)
      type(mesh_type), intent(in) :: mesh
      integer :: i

      expands = any(abs(mesh%properties%alpha) > 0.0_wp) .or. any(abs(mesh%bars%expansion) > 0.0_wp)
      if (.not. allocated(mesh%structural%shells)) return
      do i = 1, size(mesh%structural%shells) ! a MAT8 may expand in one direction alone
         expands = expands .or. any(abs(mesh%structural%shells(i)%heat) > 0.0_wp)
      end do
   end function expands

   !> A warning for the RBE2 that squeezes its nodes most, because the body at them expands otherwise than the element; '' where none
   !! does.
   function squeeze_words(deck, mesh, history) result(words)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(history_type), intent(in) :: history
      character(:), allocatable      :: words
      real(wp) :: rise, strain, worst
      integer  :: at, e, i, k, n, node, s

      words = ''
      worst = least_misfit
      n = 0
      do i = 1, size(deck%rigid)
         associate (card => deck%rigid(i))
            if (card%is_mean .or. size(card%nodes) < 2) cycle
            strain = 0.0_wp
            e = 0
            do k = 1, size(card%nodes)
               node = mesh%node_table%find(card%nodes(k))
               if (mesh%first_at(node) == mesh%first_at(node + 1)) cycle
               at = mesh%elements_at(mesh%first_at(node))
               associate (property => mesh%properties(mesh%element_property(at)))
                  do s = 1, size(history%stages)
                     if (.not. allocated(history%stages(s)%temperature%at)) cycle
                     rise = history%stages(s)%temperature%at(node)
                     rise = property%alpha*(rise - property%reference) - card%alpha*(rise - card%reference)
                     if (abs(rise) <= abs(strain)) cycle
                     strain = rise
                     e = at
                  end do
               end associate
            end do
            if (e == 0) cycle
            if (held_extent(mesh, card) <= 0.0_wp) cycle
            if (abs(strain) > least_misfit) n = n + 1
            if (abs(strain) <= worst) cycle
            worst = abs(strain)
            associate (property => mesh%properties(mesh%element_property(e)), expands => abs(card%alpha) > 0.0_wp)
               words = 'RBE2 '//integer_text(card%id)//' holds nodes up to '//real_text(held_extent(mesh, card))// &
                       ' apart, where the warm body beside them would expand by '// &
                       real_text(merge(abs(strain), strain, expands)*held_extent(mesh, card))// &
                       one_of(expands, one_of(strain < 0.0_wp, ' less', ' more')//' than the RBE2', '')// &
                       ': a strain of '//real_text(strain)//', E times which is a stress of '//real_text(strain*property%e)//'; '
               if (expands) words = words//'its ALPHA '//real_text(card%alpha)//' and TREF '//real_text(card%reference)// &
                       ' are not those of the body, '//real_text(property%alpha)//' and '//real_text(property%reference)
               if (.not. expands) words = words//'give ALPHA and TREF, or an RBE3'
            end associate
         end associate
      end do
      if (n > 1) words = words//'; '//integer_text(n - 1)//one_of(n == 2, ' other does so too', ' others do so too')
   end function squeeze_words

   !> The largest distance of the nodes of CARD along a direction in which it holds them [length].
   pure real(wp) function held_extent(mesh, card) result(extent)
      type(mesh_type), intent(in) :: mesh
      type(rigid_card), intent(in) :: card
      real(wp) :: axes(3, 3)
      integer  :: nodes(size(card%nodes)), c, k

      nodes = [(mesh%node_table%find(card%nodes(k)), k = 1, size(nodes))]
      axes = node_axes(mesh, nodes(1))
      extent = 0.0_wp
      do c = 1, mesh%dimension
         if (.not. has_component(card%components, c)) cycle
         associate (along => matmul(axes(:, c), mesh%x(:, nodes)))
            extent = max(extent, maxval(along) - minval(along))
         end associate
      end do
   end function held_extent

   !> Move the components of EXPANSIONS by their growth at the temperatures of LOADS.
   pure subroutine expand(expansions, loads, mesh)
      type(expansion_type), intent(in)     :: expansions(:)
      type(stage_load_type), intent(inout) :: loads
      type(mesh_type), intent(in) :: mesh
      integer :: k

      if (size(expansions) == 0 .or. .not. allocated(loads%temperature%at)) return
      if (.not. allocated(loads%moved)) allocate (loads%moved(mesh%dimension, mesh%n_nodes), source=0.0_wp)
      do k = 1, size(expansions)
         associate (part => expansions(k))
            associate (moved => loads%moved(part%d, part%node)) ! a mean grows in several arms
               moved = moved + part%growth*(0.5_wp*sum(loads%temperature%at(part%points)) - part%reference)
            end associate
         end associate
      end do
   end subroutine expand

   !> A warning for the first MAT1 with expansion whose TREF is blank where a stage has temperatures; '' where there is none.
   function reference_words(deck, mesh, freedoms, history) result(words)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(history_type), intent(in) :: history
      character(:), allocatable      :: words
      real(wp) :: highest, lowest
      integer  :: i, s

      words = ''
      highest = -huge(1.0_wp)
      lowest = huge(1.0_wp)
      do s = 1, size(history%stages)
         if (.not. allocated(history%stages(s)%temperature%at)) cycle
         associate (at => pack(history%stages(s)%temperature%at(:n_points(mesh)), freedoms%used(:n_points(mesh))))
            highest = max(highest, maxval(at))
            lowest = min(lowest, minval(at))
         end associate
      end do
      i = findloc(abs(deck%bulk%mat1%alpha) > 0.0_wp .and. .not. deck%bulk%mat1%reference_given, .true., dim=1)
      if (i == 0 .or. highest < lowest) return
      words = 'MAT1 '//integer_text(deck%bulk%mat1(i)%id)//': TREF is blank, so that temperatures of '//real_text(lowest)
      if (highest > lowest) words = words//' to '//real_text(highest)
      words = words//' count from 0'
   end function reference_words

   !> Errors of TEMP: missing nodes, a node named twice in a set; of TEMPD: two of one set.
   subroutine check_cards(deck, mesh)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      integer :: i, k, node
      integer, allocatable :: last(:)   ! (nodes) last card that named the node

      allocate (last(mesh%n_nodes), source=0)
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
            node = mesh%node_table%find(card%node)
            if (node == 0) then
               call deck%field_error(card%line, card%field, 'there is no GRID '//integer_text(card%node))
               cycle
            end if
            k = last(node)
            last(node) = i
            if (k == 0) cycle
            if (.not. abs(deck%bulk%temperature(k)%value - card%value) > 0.0_wp) cycle
            if (deck%bulk%temperature(k)%set == card%set) call deck%field_error(card%line, card%field, 'node '// &
               integer_text(card%node)//' has a temperature in set '//integer_text(card%set)//' already, in '// &
               deck%text%place(deck%bulk%temperature(k)%line))
         end associate
      end do
   end subroutine check_cards

   !> The temperatures AT all nodes in SET, and whether they are GIVEN: by TEMP, else by TEMPD. The duplicate of a node and the face
   !! node of a shell have the temperature of their node, an added mid-edge node has the mean of the ends.
   subroutine fill_in(deck, mesh, set, at, given)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)               :: set
      real(wp), intent(inout)           :: at(:)
      logical, allocatable, intent(out) :: given(:)
      logical :: is_filled(mesh%n_nodes)
      integer :: corners(2), e, i, k, node

      allocate (given(mesh%n_nodes), source=.false.)
      do i = 1, size(deck%bulk%temperature)
         associate (card => deck%bulk%temperature(i))
            if (card%is_default .or. card%set /= set) cycle
            node = mesh%node_table%find(card%node)
            if (node == 0) cycle
            at(node) = card%value
            given(node) = .true.
         end associate
      end do
      is_filled = .false.
      is_filled(mesh%first_filled:mesh%first_filled + mesh%n_filled - 1) = .true.
      do i = 1, n_points(mesh)
         if (mesh%duplicate(i) == 0) cycle
         associate (duplicate => mesh%duplicate(i))
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
      do e = 1, mesh%n_elements
         associate (kind => element_table(mesh%element_kind(e)), nodes => element_points(mesh, e))
            do k = kind%n_corners + 1, kind%n_nodes
               if (any(nodes == 0)) exit
               corners = nodes(kind%edges(:, k - kind%n_corners))
               if (given(nodes(k)) .or. .not. all(given(corners))) cycle
               at(nodes(k)) = 0.5_wp*sum(at(corners))
               given(nodes(k)) = .true.
            end do
         end associate
      end do
      do k = 1, size(mesh%faces)
         associate (face => mesh%faces(k))
            at(face%node) = at(face%point)
            given(face%node) = given(face%point)
         end associate
      end do
   end subroutine fill_in

end module temperature_build
