!> The answers of a structure to the rows of a measured file, at the end of a stage. Near a run with modes, their frequencies follow
!! from the change of the joint stiffness alone, in the space of the modes of that run. Those of a run in full begin near them.
module structure_answers
   use analysis_state, only: analysis_type
   use backbone, only: backbone_type, find_loop, start_backbone
   use bolt_locking, only: bar_tension, section_tension
   use element_mapping, only: two_pi
   use equation_solver, only: equation_system, failure_type
   use equations, only: recover_displacements
   use free_structure, only: release_supports
   use kinds, only: wp
   use load_path, only: recover_bodies
   use measured_data, only: a_bolt, a_displacement, a_frequency, a_loss, a_phase, a_stiffness, measured_type
   use mode_rows, only: answer_type, is_of_modes, is_predicted, match_rows, shapes_near, structure_type
   use mode_values, only: evaluate_modes, modes_type
   use modal_response, only: find_response, response_type
   use mode_span, only: find_modes_again, find_spanned, spanned
   use model_data, only: model_type
   use node_coupling, only: displacements, forces_on_unknowns
   use natural_modes, only: find_natural_modes, spectrum_type
   use oscillating_structure, only: oscillating_type, start_oscillation
   use shear_loops, only: oscillation_stiffness
   use stage_plan, only: merged
   use tolerances, only: search_modes
   use watched_nodes, only: find_watched, state_at_end, watch_answer, watch_state
   implicit none
   private

   public :: take_stage

   integer, parameter :: spare_modes = 4 ! beyond those of the deck: modes that change places stay among those found

contains

   !> The answers to the rows of stage S at its end, AT_END where nodes are watched; BEFORE is the end of the stage from which S
   !! started.
   subroutine take_stage(data, s, structure, analysis, before, at_end, answer, failure, near)
      type(measured_type), intent(in)         :: data
      integer, intent(in)                     :: s
      type(structure_type), intent(inout)     :: structure
      type(analysis_type), intent(in)         :: analysis
      type(watch_state), intent(in)           :: before
      type(watch_state), intent(inout)        :: at_end
      type(answer_type), intent(inout)        :: answer
      type(failure_type), intent(inout)       :: failure
      type(answer_type), intent(in), optional :: near
      type(analysis_type), allocatable :: whole ! a copy, as the increments go on from the original
      type(watch_answer) :: watched
      type(model_type), allocatable :: loose
      real(wp), allocatable :: q(:, :)
      logical :: needs_forces, of_modes(size(data%rows))
      integer :: i, k

      associate (model => structure%model, plan => structure%plan)
         of_modes = is_of_modes(data%rows) .and. data%rows%stage == plan%stages(s)%id
         if (present(near) .and. all(of_modes .eqv. data%rows%stage == plan%stages(s)%id) .and. is_predicted(data, s, plan) &
             .and. .not. allocated(plan%stages(s)%watched)) then
            if (any(of_modes)) call predict(s, of_modes, structure, analysis, near, answer)
            return
         end if
         allocate (whole, source=analysis)
         needs_forces = any(of_modes) .and. .not. is_predicted(data, s, plan)
         if (needs_forces .or. allocated(plan%stages(s)%watched) .or. any(data%rows%kind == a_bolt) .or. &
             any(abs(whole%now%moved) > 0.0_wp)) then
            call recover_bodies(model, structure%system, whole)
         else ! the displacements alone: the forces of all elements cost as much as a factorisation
            allocate (q, mold=whole%now%load)
            call recover_displacements(structure%system, forces_on_unknowns(model, whole%now%load), whole%u, q)
            whole%all_u = displacements(model, q)
         end if
         if (allocated(plan%stages(s)%watched)) then
            call find_watched(model, whole, plan%stages(s)%watched, plan%stages(s)%pairs, before, watched)
            at_end = state_at_end(model, whole)
         end if
         do i = 1, size(data%rows)
            associate (row => data%rows(i), value => answer%value(i))
               if (row%stage /= plan%stages(s)%id) cycle
               if (row%nodes(2) > 0) then
                  do k = size(watched%pairs), 2, -1
                     if (all(watched%pairs(k)%pair%ids == row%nodes)) exit
                  end do
               end if
               select case (row%kind)
               case (a_bolt)
                  k = findloc(model%mesh%bars%bolt, row%bolt, dim=1)
                  if (k > 0) value = bar_tension(model, whole, k)
                  if (k == 0) value = section_tension(model, whole, findloc(model%mesh%sections%bolt, row%bolt, dim=1))
               case (a_displacement)
                  if (row%nodes(2) == 0) value = whole%all_u(row%direction, model%mesh%node_table%find(row%nodes(1)))
                  if (row%nodes(2) > 0) value = watched%pairs(k)%moved(row%direction + 1)
               case (a_stiffness)
                  if (row%nodes(2) > 0) value = watched%pairs(k)%stiffness(row%direction + 1)
                  if (row%nodes(2) == 0) value = sum(watched%nodes%stiffness, &
                     mask=watched%nodes%node == model%mesh%node_table%find(row%nodes(1)))
               end select
            end associate
         end do
         if (.not. any(of_modes)) return
         if (present(near) .and. is_predicted(data, s, plan)) then
            call predict(s, of_modes, structure, whole, near, answer)
            return
         end if
         allocate (loose, source=model)
         if (plan%stages(s)%vibration%free) call release_supports(loose)
         call take_modes(data, s, of_modes, structure, loose, whole, answer, failure)
      end associate
   end subroutine take_stage

   !> The frequencies of the rows OF_MODES of stage S from the modes of the run NEAR.
   subroutine predict(s, of_modes, structure, analysis, near, answer)
      integer, intent(in)              :: s
      logical, intent(in)              :: of_modes(:)
      type(structure_type), intent(in) :: structure
      type(analysis_type), intent(in)  :: analysis
      type(answer_type), intent(in)    :: near
      type(answer_type), intent(inout) :: answer
      real(wp) :: lambda(size(near%stages(s)%lambda))
      integer  :: i

      call find_spanned(near%stages(s), stiffness_of(structure%model, analysis, structure%plan%stages(s)%vibration%on_loading), &
                        lambda)
      answer%mode = near%mode
      do i = 1, size(of_modes)
         if (of_modes(i)) answer%value(i) = sqrt(max(0.0_wp, lambda(near%mode(i))))/two_pi
      end do
   end subroutine predict

   !> The stiffness of the interface elements under oscillation.
   pure function stiffness_of(model, analysis, on_loading) result(k)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      logical, intent(in)             :: on_loading
      real(wp) :: k(4*size(model%joints%element))
      integer  :: i

      k = spanned(reshape([(oscillation_stiffness(model%joints%list(model%joints%element(i)%joint)%law, &
                                                  model%joints%element(i)%area, analysis%states(i), on_loading), &
                            i = 1, size(model%joints%element))], [4, size(model%joints%element)]))
   end function stiffness_of

   !> The answers of modes, backbone and response to the rows OF_MODES of stage S. LOOSE is the model, without supports where the
   !! modes are those of a free structure.
   subroutine take_modes(data, s, of_modes, structure, loose, analysis, answer, failure)
      type(measured_type), intent(in)     :: data
      integer, intent(in)                 :: s
      logical, intent(in)                 :: of_modes(:)
      type(structure_type), intent(inout) :: structure
      type(model_type), intent(in)        :: loose
      type(analysis_type), intent(inout)  :: analysis
      type(answer_type), intent(inout)    :: answer
      type(failure_type), intent(inout)   :: failure
      type(spectrum_type)    :: spectrum
      type(modes_type), allocatable :: modes
      type(response_type)    :: response
      class(equation_system), allocatable :: shifted
      real(wp), allocatable :: near(:, :)
      logical :: is_held
      integer :: f, i, n_sure

      associate (vibration => structure%plan%stages(s)%vibration, rows => data%rows, nodes => loose%mesh%node_table, &
                 oscillating => structure%oscillating(merge(1, 0, structure%plan%stages(s)%vibration%free)), &
                 stage => answer%stages(s))
         if (allocated(vibration%response) .and. all(rows%frequency <= 0.0_wp .or. .not. of_modes)) deallocate (vibration%response)
         if (allocated(vibration%response)) then ! of the frequencies and nodes of the rows alone
            vibration%response%spreads = vibration%response%spreads(:0)
            vibration%response%pairs = vibration%response%pairs(:0)
            vibration%response%frequencies = [real(wp) ::]
            do i = 1, size(rows)
               if (of_modes(i) .and. rows(i)%frequency > 0.0_wp) vibration%response%frequencies = &
                  merged(vibration%response%frequencies, [rows(i)%frequency])
            end do
            vibration%response%nodes = [(max(1, nodes%find(rows(i)%nodes(1))), i = 1, size(rows))]
         end if
         is_held = is_predicted(data, s, structure%plan) .and. vibration%most > 0 .and. .not. (allocated(vibration%response) .or. &
            vibration%free .or. vibration%has_lowest .or. vibration%has_highest)
         n_sure = max(vibration%most, maxval(structure%numbers, of_modes))
         if (vibration%most > 0 .and. .not. allocated(vibration%response)) vibration%most = vibration%most + spare_modes
         oscillating%is_counted = .false.
         oscillating%tolerance = search_modes
         near = shapes_near(s, structure, answer)
         do
            call start_oscillation(loose, analysis, structure%system, vibration%on_loading, oscillating, failure, is_held)
            if (is_held) call find_modes_again(loose, analysis, structure%system, oscillating, near, n_sure, vibration%most, &
                                               spectrum, shifted, is_held)
            if (.not. is_held) then
               call start_oscillation(loose, analysis, structure%system, vibration%on_loading, oscillating, failure)
               call find_natural_modes(loose, oscillating, vibration, spectrum, shifted, failure)
               if (failure%raised) return
               near = near(:, :0)
            end if
            allocate (modes)
            call evaluate_modes(loose, analysis, oscillating, vibration, spectrum, shifted, modes)
            stage%is_free = vibration%free
            stage%is_elastic = oscillating%is_elastic
            stage%is_locked = oscillating%is_locked
            stage%n_before = modes%n_before
            stage%k = spanned(oscillating%k)
            stage%lambda = modes%modes%lambda
            stage%u = reshape([(modes%modes(i)%u/sqrt(modes%modes(i)%mass), i = 1, size(modes%modes))], &
                              [size(loose%freedoms%held), size(modes%modes)])
            call match_rows(data, s, of_modes, structure, answer, failure)
            if (size(near, 2) == 0 .or. (.not. failure%raised .and. maxval(answer%mode, of_modes) <= n_sure)) exit
            near = stage%u ! a mode beyond those that are settled, which it is now; or one beyond those found: begin without shapes
            n_sure = maxval(answer%mode, of_modes)
            if (failure%raised) near = near(:, :0)
            failure = failure_type()
            deallocate (modes)
         end do
         if (.not. failure%raised .and. allocated(vibration%response)) &
            call find_response(loose, oscillating, vibration%response, spectrum, modes, shifted, response, failure)
         if (failure%raised) return
         do i = 1, size(rows)
            if (.not. of_modes(i)) cycle
            if (rows(i)%frequency > 0.0_wp) then
               f = minloc(abs(response%frequency - rows(i)%frequency), dim=1)
               answer%value(i) = merge(response%phase(rows(i)%direction, i, f), response%amplitude(rows(i)%direction, i, f), &
                                       rows(i)%kind == a_phase)
            else if (rows(i)%kind == a_loss) then
               answer%value(i) = modes%modes(answer%mode(i))%loss
            end if
         end do
      end associate
      if (any(of_modes .and. data%rows%amplitude > 0.0_wp)) &
         call take_backbone(data, s, of_modes .and. data%rows%amplitude > 0.0_wp, answer%mode, modes, structure, loose, analysis)

   contains

      !> The answers of the backbone to the rows OF_LOOPS, which follow the modes M.
      subroutine take_backbone(data, s, of_loops, m, modes, structure, loose, analysis)
         type(measured_type), intent(in)     :: data
         integer, intent(in)                 :: s, m(:)
         logical, intent(in)                 :: of_loops(:)
         type(modes_type), intent(in)        :: modes
         type(structure_type), intent(inout) :: structure
         type(model_type), intent(in)        :: loose
         type(analysis_type), intent(inout)  :: analysis
         type(backbone_type) :: found
         logical :: more
         integer :: i, k

         associate (wanted => structure%plan%stages(s)%vibration%backbone)
            wanted%mode = modes%n_before + m(findloc(of_loops, .true., dim=1))
            wanted%amplitudes = [real(wp) ::]
            do i = 1, size(m)
               if (of_loops(i)) wanted%amplitudes = merged(wanted%amplitudes, [data%rows(i)%amplitude])
            end do
            call start_backbone(loose, structure%plan, analysis, structure%system, modes, found, failure)
            more = .not. failure%raised
            do while (more)
               call find_loop(loose, structure%plan, analysis, found, more)
            end do
            if (.not. failure%raised .and. (found%problem /= '' .or. found%is_limited)) &
               call failure%raise('backbone: '//found%problem)
            do i = 1, merge(0, size(m), failure%raised)
               k = minloc(abs(wanted%amplitudes - data%rows(i)%amplitude), dim=1)
               if (of_loops(i)) answer%value(i) = merge(sqrt(found%loops(k)%omega_squared)/two_pi, found%loops(k)%loss, &
                                                        data%rows(i)%kind == a_frequency)
            end do
         end associate
      end subroutine take_backbone

   end subroutine take_modes

end module structure_answers
