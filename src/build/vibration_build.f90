!> Requests of case control for the vibration after each stage, and the nodes to which tables are limited.
!! Requests are the range of EIGRL, the frequencies of FREQ1 and FREQ4, load, damping and nodes. OUTPUT may limit the tables of a
!! stage to sets of nodes or marked surfaces.
module vibration_build
   use case_entries, only: limit_type, number_set, numbers_in_set
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: freedoms_type, mesh_type, stage_load_type
   use stage_plan, only: stage_plan_type, backbone_plan, merged, response_plan, vibration_plan_type
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text, one_of
   use stage_entries, only: vibration_entries_type
   implicit none
   private

   public :: plan_vibrations, find_shown_nodes

contains

   !> Plan the vibration of the stages with MODES. A blank ND means the lowest mode, or with V2 all modes up to it, as in NASTRAN.
   !! Frequencies are not negative, so that V1 <= 0 is no limit.
   subroutine plan_vibrations(deck, mesh, freedoms, oscillating, plan)
      type(checked_deck), intent(in)       :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(stage_load_type), intent(in)    :: oscillating(:) !! (stages) the loads of DLOAD
      type(stage_plan_type), intent(inout) :: plan
      integer :: k, s, undamped

      undamped = 0
      do s = 1, size(plan%stages)
         if (deck%control%stages(s)%vibration%modes%id == 0) cycle
         plan%has_modes = .true.
         allocate (plan%stages(s)%vibration)
         associate (asked => deck%control%stages(s)%vibration, vibration => plan%stages(s)%vibration)
            vibration%id = asked%modes%id
            vibration%free = asked%free
            vibration%on_loading = asked%on_loading
            vibration%amplitude = asked%amplitude
            vibration%damping = deck%bulk%parameters%damping
            vibration%has_losses = vibration%amplitude > 0.0_wp .or. vibration%damping > 0.0_wp .or. &
                                   any(mesh%properties%damping > 0.0_wp) .or. any(mesh%bars%damping > 0.0_wp)
            k = findloc(deck%bulk%eigrl%id, asked%modes%id, dim=1)
            if (k == 0) then
               call deck%errors%add(asked%modes%line, 'MODES: there is no EIGRL '//integer_text(asked%modes%id))
            else
               vibration%eigrl_card = deck%bulk%eigrl(k)
               if (vibration%most == 0 .and. .not. vibration%has_highest) vibration%most = 1
               vibration%has_lowest = vibration%has_lowest .and. vibration%lowest > 0.0_wp
               if (.not. vibration%has_lowest) vibration%lowest = 0.0_wp
            end if
            if (asked%backbone%id > 0) call plan_backbone(deck, mesh, freedoms, asked, vibration)
            plan%has_backbones = plan%has_backbones .or. asked%backbone%id > 0
            if (asked%frequency%id == 0) cycle
            if (asked%damping%id == 0 .and. .not. vibration%has_losses .and. asked%frequency%line /= undamped) then
               undamped = asked%frequency%line ! one warning for an entry above all stages
               call deck%errors%add(undamped, 'FREQUENCY: expected damping: SDAMPING, AMPLITUDE for the loss factors of the '// &
                  'joints, PARAM G, or GE on a MAT1; without it peaks are unbounded')
            end if
            plan%has_responses = .true.
            allocate (vibration%response)
            call plan_response(deck, mesh, freedoms, asked, oscillating(s), vibration%response)
         end associate
      end do
   end subroutine plan_vibrations

   !> BACKBONE of one stage, with ascending amplitudes.
   subroutine plan_backbone(deck, mesh, freedoms, asked, vibration)
      type(checked_deck), intent(in)           :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(vibration_entries_type), intent(in) :: asked
      type(vibration_plan_type), intent(inout) :: vibration
      type(backbone_plan) :: backbone
      integer :: k, i

      if (asked%free) call deck%errors%add(asked%backbone%line, &
         'BACKBONE: expected also MODES = set, not MODES(FREE): a structure without supports has no equilibrium under a load')
      k = findloc(deck%bulk%jampl%id, asked%backbone%id, dim=1)
      if (k == 0) then
         call deck%errors%add(asked%backbone%line, 'BACKBONE: there is no JAMPL '//integer_text(asked%backbone%id))
         return
      end if
      associate (card => deck%bulk%jampl(k))
         backbone%jampl_card = card
         backbone%node = 0
         backbone%amplitudes = [(card%largest*card%ratio**(real(card%n - i, wp)/max(1, card%n - 1)), i = 1, card%n)]
         if (vibration%most > 0 .and. .not. vibration%has_lowest .and. card%mode > vibration%most) &
            call deck%errors%add(card%line, 'JAMPL: mode '//integer_text(card%mode)//' is not among the '// &
                                 integer_text(vibration%most)//' lowest that EIGRL '//integer_text(vibration%id)//' asks for')
         if (card%node > 0) then
            backbone%node = findloc(mesh%node_id == card%node .and. freedoms%used, .true., dim=1)
            if (backbone%node == 0 .and. .not. deck%errors%any()) call deck%errors%add(card%line, &
               'JAMPL: GID '//integer_text(card%node)//' is not a node of an element')
         end if
      end associate
      vibration%backbone = backbone
   end subroutine plan_backbone

   !> FREQUENCY of one stage.
   subroutine plan_response(deck, mesh, freedoms, asked, load, response)
      type(checked_deck), intent(in)           :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(vibration_entries_type), intent(in) :: asked
      type(stage_load_type), intent(in)        :: load
      type(response_plan), intent(out)         :: response
      logical, allocatable :: are_named(:)
      integer :: i, k

      allocate (response%frequencies(0))
      do i = 1, size(deck%bulk%frequency)
         associate (card => deck%bulk%frequency(i))
            if (card%set /= asked%frequency%id .or. card%spread > 0.0_wp) cycle
            if (card%last > 0.0_wp) then
               response%frequencies = merged(response%frequencies, &
                                             [(card%first*(card%last/card%first)**(real(k, wp)/card%n), k = 0, card%n)])
            else
               response%frequencies = merged(response%frequencies, [(card%first + k*card%step, k = 0, card%n)])
            end if
         end associate
      end do
      response%spreads = pack(deck%bulk%frequency, deck%bulk%frequency%set == asked%frequency%id .and. &
                                                   deck%bulk%frequency%spread > 0.0_wp) ! FREQ4
      if (size(response%frequencies) + size(response%spreads) == 0) call deck%errors%add(asked%frequency%line, &
         'FREQUENCY: there is no FREQ1, FREQ2 or FREQ4 with set '//integer_text(asked%frequency%id))
      response%is_structural = deck%bulk%parameters%is_structural
      allocate (response%force(3, mesh%n_nodes), source=0.0_wp)
      do k = 1, load%n
         response%force(:, load%node(k)) = response%force(:, load%node(k)) + load%force(:, k)
      end do
      if (allocated(load%moved)) call deck%errors%add(asked%load%line, 'DLOAD: set '//integer_text(asked%load%id)// &
         ' has prescribed displacements (SPCD); expected forces only')
      if (asked%damping%id > 0) then
         k = findloc(deck%bulk%tabdmp1%id, asked%damping%id, dim=1)
         if (k > 0) response%damping = deck%bulk%tabdmp1(k)
         if (k == 0) call deck%errors%add(asked%damping%line, 'SDAMPING: there is no TABDMP1 '//integer_text(asked%damping%id))
      end if
      if (.not. allocated(asked%response)) return
      call find_limited_nodes(deck, mesh, 'RESPONSE', asked%response, are_named)
      are_named = are_named .and. freedoms%used .and. mesh%node_id > 0
      response%nodes = pack([(k, k = 1, mesh%n_nodes)], are_named)
      if (size(response%nodes) == 0 .and. .not. deck%errors%any()) call deck%errors%add(asked%response(1)%line, &
         'RESPONSE: names no node of an element')
   end subroutine plan_response

   !> Set SHOWN of the limited stages of PLAN, and WATCHED of the stages with WATCH.
   subroutine find_shown_nodes(deck, mesh, freedoms, plan)
      type(checked_deck), intent(in)       :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(stage_plan_type), intent(inout) :: plan
      logical, allocatable :: are_named(:)
      integer :: i, s

      do s = 1, size(plan%stages)
         associate (given => deck%control%stages(s), stage => plan%stages(s))
            if (allocated(given%watch)) then
               plan%has_watched_nodes = .true.
               call find_limited_nodes(deck, mesh, 'WATCH', given%watch, are_named)
               stage%watched = pack([(i, i = 1, mesh%n_nodes)], are_named .and. freedoms%used .and. mesh%node_id > 0)
               if (size(stage%watched) == 0) call deck%errors%add(given%watch(1)%line, 'WATCH: names no node of an element')
            end if
            if (.not. allocated(given%only)) cycle
            call find_limited_nodes(deck, mesh, 'OUTPUT', given%only, stage%shown)
            do i = 1, size(given%only)
               associate (only => given%only(i))
                  stage%shown_words = stage%shown_words//one_of(only%is_mark, ', ONLY PMARK', ', ONLY SET')//' '// &
                                      integer_text(only%id)
               end associate
            end do
         end associate
      end do
   end subroutine find_shown_nodes

   !> The nodes of the model that entry KEY of case control names by its LIMITS. Errors: missing sets and surfaces.
   subroutine find_limited_nodes(deck, mesh, key, limits, are_named)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in) :: mesh
      character(*), intent(in)          :: key
      type(limit_type), intent(in)      :: limits(:)
      logical, allocatable, intent(out) :: are_named(:) !! (n_nodes)
      integer :: at, i

      allocate (are_named(mesh%n_nodes), source=.false.)
      do i = 1, size(limits)
         associate (only => limits(i))
            if (only%is_mark) then
               at = findloc(mesh%surfaces%id, only%id, dim=1)
               if (at > 0) are_named(nodes_of(mesh%surfaces(at))) = .true.
            else
               at = findloc(deck%control%sets%id, only%id, dim=1, back=.true.)
               if (at > 0) call add_set(deck%control%sets(at))
            end if
            if (at == 0) call deck%errors%add(only%line, key//': there is no '//one_of(only%is_mark, 'PMARK', 'SET')// &
                                              ' '//integer_text(only%id))
         end associate
      end do

   contains

      !> Add the nodes of SET: its numbers, those of NODEAT included, and the nodes of the marked surfaces that it names.
      subroutine add_set(set)
         type(number_set), intent(in) :: set
         integer, allocatable :: marks(:), numbers(:)
         logical, allocatable :: are_in(:)
         integer :: at, i

         allocate (numbers, source=[mesh%node_id, mesh%placed%id])
         allocate (are_in(size(numbers)))
         call numbers_in_set(set, numbers, are_in, marks, deck%errors)
         are_named = are_named .or. are_in(:mesh%n_nodes)
         do i = mesh%n_nodes + 1, size(numbers)
            if (are_in(i) .and. numbers(i) > 0) are_named(mesh%placed(i - mesh%n_nodes)%node) = .true.
         end do
         do i = 1, size(marks)
            at = findloc(mesh%surfaces%id, marks(i), dim=1)
            if (at > 0) are_named(nodes_of(mesh%surfaces(at))) = .true.
            if (at == 0) call deck%errors%add(set%line, 'SET '//integer_text(set%id)//': there is no PMARK '// &
                                              integer_text(marks(i)))
         end do
      end subroutine add_set

   end subroutine find_limited_nodes

end module vibration_build
