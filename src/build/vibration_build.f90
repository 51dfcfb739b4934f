!> Requests of case control for the vibration after each stage: the range of EIGRL, the frequencies of FREQ1 and FREQ4, load, damping
!! and nodes.
module vibration_build
   use connected_bodies, only: find_bodies
   use deck_check, only: checked_deck
   use kinds, only: wp
   use mesh_queries, only: is_shell
   use model_data, only: freedoms_type, mesh_type, n_sections, supported
   use stage_plan, only: stage_plan_type, backbone_plan, merged, node_pair, response_plan, vibration_plan_type, wave_type
   use stage_build, only: find_limited_nodes
   use text_tools, only: integer_text, one_of
   use stage_entries, only: any_modes, vibration_entries_type
   use wave_build, only: planned_wave
   implicit none
   private

   public :: plan_vibrations

   real(wp), parameter :: covering = 2.0_wp  ! times the highest frequency of the response: V2 where EIGRL has neither V2 nor ND
   integer, parameter  :: most_covering = 200 ! modes likewise
   real(wp), parameter :: no_end = 1.0e19_wp ! an F2 of FREQ4 beyond it is no end of the range

contains

   !> Plan the vibration of the stages with MODES. A blank ND means the lowest mode, or with V2 all modes up to it, as in NASTRAN;
   !! where both are blank and a response is asked for, the modes that cover its frequencies. Frequencies are not negative, so that
   !! V1 <= 0 is no limit.
   subroutine plan_vibrations(deck, mesh, joint_ids, sets, waves, plan)
      type(checked_deck), intent(in)       :: deck
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                  :: joint_ids(:)
      type(freedoms_type), intent(in) :: sets(:) !! of the plan
      type(planned_wave), intent(in)       :: waves(:) !! the loads of DLOAD
      type(stage_plan_type), intent(inout) :: plan
      integer :: k, s, undamped
      logical :: covers

      undamped = 0
      call check_filters(deck, mesh, joint_ids, plan)
      do s = 1, size(plan%stages)
         if (deck%control%stages(s)%vibration%modes%id == 0) cycle
         plan%has_modes = .true.
         allocate (plan%stages(s)%vibration)
         associate (asked => deck%control%stages(s)%vibration, vibration => plan%stages(s)%vibration, &
                    freedoms => sets(plan%stages(s)%supports))
            vibration%id = asked%modes%id
            vibration%free = asked%free .or. (asked%by_method .and. any(freedoms%support_groups%kind == 'FREE'))
            vibration%on_loading = asked%on_loading
            vibration%amplitude = asked%amplitude
            vibration%damping = deck%bulk%parameters%damping
            vibration%has_losses = vibration%amplitude > 0.0_wp .or. vibration%damping > 0.0_wp .or. &
                                   any(mesh%properties%damping > 0.0_wp) .or. any(mesh%bars%damping + mesh%bars%viscous > 0.0_wp)
            covers = .false.
            k = findloc(deck%bulk%eigrl%id, asked%modes%id, dim=1)
            if (asked%modes%id == any_modes) then
               covers = .true.
               vibration%most = 1
            else if (k == 0) then
               call deck%errors%add(asked%modes%line, 'MODES: there is no EIGRL '//integer_text(asked%modes%id))
            else
               vibration%eigrl_card = deck%bulk%eigrl(k)
               if (vibration%by_point) call deck%errors%warn('EIGR '//integer_text(asked%modes%id)// &
                  ': NORM = POINT, but the shapes are scaled as by MAX')
               covers = vibration%most == 0 .and. .not. vibration%has_highest
               if (covers) vibration%most = 1
               vibration%has_lowest = vibration%has_lowest .and. vibration%lowest > 0.0_wp
               if (.not. vibration%has_lowest) vibration%lowest = 0.0_wp
            end if
            plan%has_backbones = plan%has_backbones .or. asked%backbone%id > 0
            if (asked%frequency%id > 0) then
               plan%has_responses = .true.
               allocate (vibration%response)
               call plan_response(deck, mesh, freedoms, asked, waves, s, vibration%response)
               vibration%response%is_direct = asked%modes%id == any_modes
               vibration%response%pairs = [node_pair ::]
               if (allocated(plan%stages(s)%pairs)) vibration%response%pairs = plan%stages(s)%pairs
               if (covers) call cover(vibration)
            end if
            if (asked%backbone%id > 0) call plan_backbone(deck, mesh, freedoms, asked, vibration)
            if (asked%frequency%id == 0) cycle
            if (asked%damping%id == 0 .and. .not. vibration%has_losses .and. asked%frequency%line /= undamped .and. &
                .not. deck%control%of_nastran) then
               undamped = asked%frequency%line ! one warning for an entry above all stages
               call deck%errors%add(undamped, 'FREQUENCY: expected damping: SDAMPING, AMPLITUDE for the loss factors of the '// &
                  'joints, PARAM G, or GE on a MAT1; without it peaks are unbounded')
            end if
         end associate
      end do
   end subroutine plan_vibrations

   !> Let the modes of VIBRATION cover the frequencies of its response, those of FREQ1 and FREQ2 and the ranges of FREQ4.
   pure subroutine cover(vibration)
      type(vibration_plan_type), intent(inout) :: vibration
      real(wp) :: highest

      associate (response => vibration%response)
         highest = covering*max(maxval([0.0_wp, response%frequencies]), &
                                maxval([0.0_wp, response%spreads%last], mask=[0.0_wp, response%spreads%last] < no_end))
      end associate
      if (highest <= max(0.0_wp, vibration%lowest)) return
      vibration%has_highest = .true.
      vibration%highest = highest
      vibration%most = merge(0, most_covering, vibration%response%is_direct)
   end subroutine cover

   !> Check that there is what OUTPUT limits the tables of modes to: once for an entry above all stages.
   subroutine check_filters(deck, mesh, joint_ids, plan)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in)       :: mesh
      integer, intent(in)               :: joint_ids(:)
      type(stage_plan_type), intent(in) :: plan
      logical :: is_there
      integer :: body(mesh%n_elements), e, n, s

      do s = 1, size(plan%stages)
         associate (output => plan%stages(s)%output, given => deck%control%stages)
            if (.not. output%modes%is_given .or. any(given(:s - 1)%output%line == output%line)) cycle
            if (.not. any(given%output%line == output%line .and. given%vibration%modes%id > 0)) call deck%errors%add(output%line, &
               'OUTPUT: MASS, BODY, SHELLS and JOINT limit the tables of modes and have no effect without MODES')
            if (output%modes%kind == '') cycle
            call find_bodies(mesh, body, n)
            is_there = output%modes%id <= n
            if (output%modes%kind == 'SHELLS') is_there = any([(is_shell(mesh, e) .and. body(e) == output%modes%id, &
                                                                e = 1, mesh%n_elements)])
            if (output%modes%kind == 'JOINT') is_there = any(joint_ids == output%modes%id)
            if (is_there .or. deck%errors%any()) cycle
            call deck%errors%add(output%line, 'OUTPUT: there is no '//trim(output%modes%kind)//' '// &
                                 integer_text(output%modes%id)//one_of(output%modes%kind == 'JOINT', '', &
                                 '; the bodies have the numbers 1 to '//integer_text(n)))
         end associate
      end do
   end subroutine check_filters

   !> BACKBONE of one stage, with ascending amplitudes.
   subroutine plan_backbone(deck, mesh, freedoms, asked, vibration)
      type(checked_deck), intent(in)           :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(vibration_entries_type), intent(in) :: asked
      type(vibration_plan_type), intent(inout) :: vibration
      type(backbone_plan) :: backbone
      integer :: k, i

      if (vibration%free .and. .not. freedoms%floats .and. &
          any([(supported(mesh, freedoms, i), i = 1, mesh%n_nodes - n_sections(mesh))])) call deck%errors%add(asked%backbone%line, &
         'BACKBONE with MODES(FREE): expected a deck without supports and all its MODES (FREE): the supports of this deck '// &
         'would bear a part of the inertia forces of the mode')
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
            backbone%node = mesh%node_table%find(card%node)
            if (backbone%node > 0) backbone%node = merge(backbone%node, 0, freedoms%used(backbone%node))
            if (backbone%node == 0 .and. .not. deck%errors%any()) call deck%errors%add(card%line, &
               'JAMPL: GID '//integer_text(card%node)//' is not a node of an element')
         end if
      end associate
      vibration%backbone = backbone
   end subroutine plan_backbone

   !> FREQUENCY of one stage.
   subroutine plan_response(deck, mesh, freedoms, asked, waves, stage, response)
      type(checked_deck), intent(in)           :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(vibration_entries_type), intent(in) :: asked
      type(planned_wave), intent(in)           :: waves(:)
      integer, intent(in)                      :: stage
      type(response_plan), intent(out)         :: response
      logical, allocatable :: about_modes(:), are_named(:)
      integer, allocatable :: ours(:)
      integer :: i, k

      allocate (response%frequencies(0))
      associate (cards => deck%bulk%frequency)
         about_modes = [(cards(i)%spread > 0.0_wp .or. cards(i)%cluster > 0.0_wp .or. &
                         (allocated(cards(i)%list) .and. cards(i)%last > 0.0_wp), i = 1, size(cards))]
      end associate
      do i = 1, size(deck%bulk%frequency)
         associate (card => deck%bulk%frequency(i))
            if (card%set /= asked%frequency%id .or. about_modes(i)) cycle
            if (allocated(card%list)) then
               response%frequencies = merged(response%frequencies, card%list)
            else if (card%last > 0.0_wp) then
               response%frequencies = merged(response%frequencies, &
                                             [(card%first*(card%last/card%first)**(real(k, wp)/card%n), k = 0, card%n)])
            else
               response%frequencies = merged(response%frequencies, [(card%first + k*card%step, k = 0, card%n)])
            end if
         end associate
      end do
      ours = pack([(i, i = 1, size(about_modes))], deck%bulk%frequency%set == asked%frequency%id .and. about_modes)
      response%spreads = deck%bulk%frequency(ours)
      if (size(response%frequencies) + size(response%spreads) == 0) call deck%errors%add(asked%frequency%line, &
         'FREQUENCY: there is no FREQ, FREQ1 to FREQ5 with set '//integer_text(asked%frequency%id))
      response%is_structural = deck%bulk%parameters%is_structural
      ours = pack([(i, i = 1, size(waves))], waves%stage == stage)
      allocate (response%waves(size(ours)))
      do i = 1, size(ours)
         associate (load => waves(ours(i))%load, wave => response%waves(i))
            wave%law = waves(ours(i))%law
            allocate (wave%force(3, mesh%n_nodes), source=0.0_wp)
            do k = 1, load%n
               if (load%node(k) == 0) cycle ! reported already
               wave%force(:, load%node(k)) = wave%force(:, load%node(k)) + load%force(:, k)
            end do
            if (allocated(load%moved) .and. wave%law%card%motion > 0) wave%moved = load%moved
            if (allocated(load%moved) .and. .not. allocated(wave%law%tables)) call deck%errors%add(asked%load%line, &
               'DLOAD: set '//integer_text(asked%load%id)//' has prescribed displacements (SPCD); expected forces only')
         end associate
      end do
      if (asked%damping%id > 0) then
         k = findloc(deck%bulk%tabdmp1%id, asked%damping%id, dim=1)
         if (k > 0) response%damping = deck%bulk%tabdmp1(k)
         if (k == 0) call deck%errors%add(asked%damping%line, 'SDAMPING: there is no TABDMP1 '//integer_text(asked%damping%id))
      end if
      if (allocated(asked%response)) then
         call find_limited_nodes(deck, mesh, 'RESPONSE', asked%response, are_named)
      else
         are_named = spread(.false., 1, mesh%n_nodes)
         do i = 1, size(response%waves)
            are_named = are_named .or. any(abs(response%waves(i)%force) > 0.0_wp, dim=1)
            do k = 1, merge(mesh%n_nodes, 0, allocated(response%waves(i)%moved))
               are_named(k) = are_named(k) .or. any(abs(response%waves(i)%moved(:, k)) > 0.0_wp)
            end do
         end do
         do k = 1, size(mesh%rotations) ! a moment is on the node of rotations
            associate (rotation => mesh%rotations(k))
               are_named(rotation%point) = are_named(rotation%point) .or. are_named(rotation%node)
            end associate
         end do
      end if
      are_named = are_named .and. freedoms%used .and. mesh%node_id > 0
      response%nodes = pack([(k, k = 1, mesh%n_nodes)], are_named)
      if (size(response%nodes) == 0 .and. .not. deck%errors%any()) call deck%errors%add(asked%line(size(asked%line)), &
         'RESPONSE: names no node of an element')
   end subroutine plan_response

end module vibration_build
