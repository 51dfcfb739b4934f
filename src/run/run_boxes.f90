!> Runs the boxes of the flow chart that belong to no method: reading, building and printing.
!! Each box shows its phase on the terminal. After an end of the run the later boxes do nothing. Only finish_run reports
!! why the run ended.
module run_boxes
   use analysis_state, only: analysis_type, interface_stiffness, note_largest, start_analysis
   use backbone, only: backbone_type, find_loop, finish_backbone, start_backbone
   use c_library, only: end_run, make_folders, open_standard_outputs, tell_failed_writes
   use control_words, only: method_back, no_restart
   use command_line, only: command_type, deck_argument, is_result_of, read_command_line
   use condensed_interface, only: condense_on_joints
   use condition_estimate, only: watch_condition
   use deck_input, only: deck_type, read_deck
   use distribution, only: join_processes, leave_processes
   use equation_solver, only: equation_system, failure_type
   use enforced_motion, only: carry_along
   use equations, only: form_body_stiffness, start_equations
   use facing_bodies, only: loose_words
   use finite_state, only: check_state
   use free_structure, only: release_supports
   use incomplete_results, only: say_at_interrupts, watch_ends, watch_interrupts
   use joint_suggestions, only: suggest_joints
   use kinds, only: wp
   use law_error, only: follow_laws
   use load_path, only: recover_bodies
   use machine, only: keep_memory, note_first_call, use_threads
   use memory_need, only: check_buffers, check_model_size
   use mesh_queries, only: shown_number
   use modal_response, only: find_response, response_type
   use mode_values, only: evaluate_modes, modes_type
   use model_build, only: build_model
   use model_data, only: model_type
   use natural_modes, only: find_natural_modes, spectrum_type
   use oscillating_structure, only: oscillating_type, start_oscillation
   use newton_method, only: seat_joints
   use openblas, only: prepare_libraries, tell_kernel
   use nx_translation, only: translate_contacts
   use range_watch, only: watch_drops
   use restart_file, only: open_restart_file, take_up, write_restart
   use result_names, only: remove_old_results
   use results, only: end_stage, list_results => print_increment, print_modes, print_stage, start_results
   use run_of_deck, only: phase_backbone, phase_build, phase_factor, phase_increments, phase_modes, phase_order, &
                          phase_recover, phase_write, advance, enter, expect, goes_on, has_errors, is_over, is_unreadable, &
                          is_unwritten, run_type, start_run, tell, was_checked, was_searched, would_overwrite
   use structure_reduction, only: condense_structure
   use stage_plan, only: factorisations_of, shows_bodies, solves_once, &
                         stage_name, stage_plan_type, vibration_plan_type, where_in_plan
   use response_tables, only: list_pair_response, list_response, list_uncovered
   use vibration_tables, only: list_backbone
   use vtu_grids, only: write_piece
   implicit none
   private

   public :: start_program, read_data, build_structure, form_bodies, start_joints, another_stage, another_increment, &
             print_increment, go_on

contains

   !> Two boxes that the chart of the paper lacks, between two increments: the natural modes, where the increment completes a stage
   !! that asks for them, which change nothing in the analysis; and the restart file.
   subroutine go_on(run, deck, model, plan, system, analysis)
      type(run_type), intent(inout)      :: run
      type(deck_type), intent(in)        :: deck
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), allocatable, intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      type(model_type), allocatable :: loose
      logical :: is_free

      if (is_over(run)) return
      associate (stage => plan%stages(analysis%stage))
         if (analysis%increment == size(stage%fractions) .and. (allocated(stage%vibration) .or. stage%output%dmig)) then
            call enter(run, phase_modes)
            is_free = .false.
            if (allocated(stage%vibration)) is_free = stage%vibration%free
            if (is_free) then
               allocate (loose, source=model)
               call release_supports(loose)
               call oscillate(run, deck, loose, plan, stage%vibration, system, analysis)
               call condense_structure(run, deck, loose, plan, system, analysis)
            else
               if (allocated(stage%vibration)) call oscillate(run, deck, model, plan, stage%vibration, system, analysis)
               call condense_structure(run, deck, model, plan, system, analysis)
            end if
            if (.not. run%failure%raised) call end_stage(plan, run%results)
            call enter(run, phase_increments)
         end if
      end associate
      call write_restart(run, deck, plan, system, analysis)
   end subroutine go_on

   !> Compute modes, backbone and response. With RESTART they are printed together, so that a restart file written meanwhile
   !! contains none of them; without it the modes stay where the backbone is interrupted.
   subroutine oscillate(run, deck, model, plan, asked, system, analysis)
      type(run_type), intent(inout)         :: run
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(vibration_plan_type), intent(in) :: asked
      class(equation_system), allocatable, intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(oscillating_type) :: structure
      type(spectrum_type)    :: spectrum
      type(modes_type), allocatable :: modes ! on the heap: the compiler warns of its bounds where it is a local variable
      type(response_type)    :: response
      type(backbone_type)    :: found
      type(vibration_plan_type) :: wanted ! with the motions of supports carried on to all nodes
      class(equation_system), allocatable :: shifted
      logical :: more

      wanted = asked
      call start_oscillation(model, analysis, system, wanted%on_loading, structure, run%failure)
      if (allocated(wanted%response)) call carry_along(model, structure, wanted%response%waves, run%failure)
      call find_natural_modes(model, structure, wanted, spectrum, shifted, run%failure)
      if (run%failure%raised) then
         run%failure%message = where_in_plan(plan, analysis%stage, analysis%increment)//': '//run%failure%message
         return
      end if
      allocate (modes)
      call evaluate_modes(model, analysis, structure, wanted, spectrum, shifted, modes)
      if (deck%control%restart == no_restart) call keep_modes()
      if (allocated(wanted%backbone)) then
         call enter(run, phase_backbone)
         call start_backbone(model, plan, analysis, system, modes, found, run%failure)
         more = .not. run%failure%raised
         do while (more)
            call find_loop(model, plan, analysis, found, more)
            if (more) call write_restart(run, deck, plan, system, analysis)
         end do
         if (.not. run%failure%raised) call finish_backbone(model, wanted, modes, found)
         if (allocated(analysis%kept)) deallocate (analysis%kept)
         call enter(run, phase_modes)
      end if
      if (deck%control%restart /= no_restart) call keep_modes()
      if (run%failure%raised) return
      associate (page => run%results%page, n_warnings => run%results%watch%n_warnings)
         if (allocated(wanted%backbone)) call list_backbone(page, model, found, n_warnings)
         if (.not. allocated(wanted%response)) return
         call find_response(model, structure, wanted%response, spectrum, modes, shifted, response, run%failure)
         if (run%failure%raised) then
            call end_stage(plan, run%results) ! the modes and the backbone are complete
            return
         end if
         call list_uncovered(page, model, modes, response, n_warnings)
         call list_response(page, model, response, n_warnings)
         call list_pair_response(page, model, wanted%response%pairs, response)
      end associate

   contains

      !> Print the modes; they stay if the run ends early.
      subroutine keep_modes()
         call print_modes(model, plan, analysis%stage, modes, run%results)
         call end_stage(plan, run%results)
      end subroutine keep_modes

   end subroutine oscillate

   !> Read the command line; end the program where nothing is left to do. Set the threads and the watch on the memory. With several
   !! processes rank 0 continues, and the others serve it from here on.
   subroutine start_program(command)
      type(command_type), intent(out) :: command
      integer :: status

      call open_standard_outputs()
      call watch_ends()
      call prepare_libraries()
      call join_processes(write_piece)
      call watch_interrupts()
      call read_command_line(command, status)
      if (status >= 0) then
         call leave_processes()
         call end_run(status)
      end if
      call use_threads(command%threads)
      call tell_failed_writes()
      if (.not. command%quiet) call tell_kernel()
   end subroutine start_program

   !> Read the deck of ARGUMENT.
   subroutine read_data(command, argument, run, deck)
      type(command_type), intent(in)  :: command
      type(deck_argument), intent(in) :: argument
      type(run_type), intent(out)     :: run
      type(deck_type), intent(out)    :: deck
      logical :: readable
      integer :: i

      call say_at_interrupts(argument%name//': interrupted; nothing of this run is kept (RESTART would keep its stages)')
      call start_run(command, argument, run)
      call read_deck(argument%path, deck, run%errors, readable, argument%parameters, command%watched, &
                     command%law)
      call translate_contacts(deck, run%errors)
      if (.not. readable) then
         run%ending = is_unreadable
         return
      end if
      do i = 2, deck%text%n_files
         if (is_result_of(deck%text%files(i)%true_path, argument)) run%ending = would_overwrite
      end do
      if (is_over(run)) return
      if (command%resume) call open_restart_file(deck, run)
      if (.not. (is_over(run) .or. run%check_only)) call remove_old_results(argument%base)
   end subroutine read_data

   !> Build bodies, joints, supports, loads and stages.
   subroutine build_structure(run, deck, model, plan)
      type(run_type), intent(inout)      :: run
      type(deck_type), intent(in)        :: deck
      type(model_type), intent(out)      :: model
      type(stage_plan_type), intent(out) :: plan
      character(:), allocatable :: loose
      integer :: i

      if (is_over(run)) return
      call keep_memory()
      call enter(run, phase_build)
      call check_buffers(run%failure) ! constraint equations and projections call LAPACK
      if (.not. (run%check_only .or. run%errors%any())) call check_model_size(deck, run%failure)
      if (is_over(run)) return
      call build_model(deck, model, plan, run%errors)
      loose = ''
      if (.not. run%errors%any()) then
         loose = loose_words(model%mesh, model%joints, model%freedoms)
         do i = 2, size(plan%first_with)
            if (loose /= '') exit
            loose = loose_words(model%mesh, model%joints, model%sets(i))
            if (loose /= '') loose = stage_name(plan%stages(plan%first_with(i)))//': '//loose
         end do
         if (loose /= '' .and. all(deck%control%stages%supports%id == 0) .and. any(deck%bulk%support%set > 0)) &
            loose = loose//'; case control has no SPC, so that no support of the deck acts'
      end if
      if (run%errors%any()) then
         run%ending = has_errors
      else if (run%suggests) then
         call run%suggestions%start('')
         call suggest_joints(run%argument%name, deck, model, run%suggestions)
         run%ending = was_searched
      else if (loose /= '') then
         call run%failure%raise(loose)
      else if (run%check_only) then
         run%ending = was_checked
      end if
      if (run%errors%any() .or. run%suggests) return
      do i = 1, size(model%warnings)
         call tell(run, model%warnings(i)%words)
      end do
      do i = 1, size(model%mesh%placed) ! from here on numbers are for print only
         model%mesh%node_id(model%mesh%placed(i)%node) = shown_number(model%mesh, model%mesh%placed(i)%node)
      end do
   end subroutine build_structure

   !> Form [k_b] of the bodies and factorise the part that no joint changes; then the listing can be opened.
   subroutine form_bodies(run, deck, model, plan, system)
      type(run_type), intent(inout)     :: run
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), allocatable, intent(out) :: system
      character(10) :: date, time
      logical :: ok

      if (is_over(run)) return
      call check_buffers(run%failure)
      if (is_over(run)) return
      call enter(run, phase_order)
      call start_equations(model, system, run%failure, deck%control%solver, factorisations_of(plan, deck%control%method), &
                           solves_once=solves_once(plan, deck%control%method))
      call enter(run, phase_factor)
      if (.not. run%failure%raised) call form_body_stiffness(model, system, run%failure, where_in_plan(plan, 1, 1))
      if (run%failure%raised) return
      if (system%description%static_operations > 0.0_wp) call note_first_call()
      call enter(run, phase_write)
      run%solver = system%description
      call date_and_time(date, time)
      if (run%is_dated) run%results%page%date = date(:4)//'-'//date(5:6)//'-'//date(7:8)//' '//time(:2)//':'//time(3:4)
      call make_folders(run%argument%base(:index(run%argument%base, '/', back=.true.)))
      call start_results(run%argument%base, deck, model, plan, system, run%results, ok)
      if (ok .and. run%argument%of > 1 .and. run%argument%base /= '') then
         call run%results%page%screen%put('')
         call run%results%page%screen%put(' DECK: '//run%argument%name)
      end if
      if (.not. ok) run%ending = is_unwritten
   end subroutine form_bodies

   !> NORM and SHEAR for a structure at rest, with its interference in equilibrium (BACK takes all loads at once). A restart file
   !! replaces this state.
   subroutine start_joints(run, deck, model, plan, system, analysis)
      type(run_type), intent(inout)      :: run
      type(deck_type), intent(in)        :: deck
      type(model_type), intent(inout)    :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), allocatable, intent(inout) :: system
      type(analysis_type), intent(out)   :: analysis

      if (is_over(run)) return
      call start_analysis(model, system, deck%control, analysis)
      if (.not. run%resumes) then
         if (deck%control%method /= method_back) call seat_joints(model, analysis, system, run%failure)
         call interface_stiffness(model, system, analysis, run%failure)
      end if
      call take_up(run, deck, model, plan, system, analysis)
      call expect(run, plan, analysis%stage, analysis%increment)
      call enter(run, phase_increments)
      if (any(model%joints%element%gap < 0.0_wp) .and. deck%control%method /= method_back) call note_drops(run, model, analysis)
      if (allocated(analysis%kept)) call go_on(run, deck, model, plan, system, analysis)
   end subroutine start_joints

   !> Say it once where an element has dropped its shear, in a state that NEWTON has iterated.
   subroutine note_drops(run, model, analysis)
      type(run_type), intent(inout)   :: run
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(:), allocatable :: words

      if (run%failure%raised) return
      call watch_drops(model, analysis, run%results%watch, words)
      if (words /= '') call tell(run, words)
   end subroutine note_drops

   !> Whether a stage is left, or the rest of a stage that has been resumed.
   pure logical function another_stage(run, plan, analysis)
      type(run_type), intent(in)        :: run
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      another_stage = .not. is_over(run)
      if (another_stage) another_stage = analysis%goes_on .or. analysis%next <= size(plan%stages)
   end function another_stage

   !> Whether the stage has an increment left.
   pure logical function another_increment(run, plan, analysis)
      type(run_type), intent(in)        :: run
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      another_increment = .not. is_over(run)
      if (another_increment) another_increment = analysis%increment < size(plan%stages(analysis%stage)%fractions)
   end function another_increment

   !> Print the completed increment, with the state of the bodies where OUTPUT asks for it, and the stage that it completes, or the
   !! part of the stage before an early end.
   subroutine print_increment(run, model, plan, system, analysis)
      type(run_type), intent(inout)      :: run
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type)    :: overflow
      real(wp), allocatable :: u(:, :), unbalanced(:, :)
      logical :: completes_stage

      run%keeps_results = run%failure%raised .and. run%ending == goes_on .and. analysis%record%ends_early
      if (is_over(run) .and. .not. run%keeps_results) return
      if (analysis%record%is_iterated) call note_drops(run, model, analysis)
      completes_stage = analysis%increment == size(plan%stages(analysis%stage)%fractions)
      if (run%keeps_results .and. .not. analysis%record%is_partial) then ! all is printed but the tables of the end
         call recover_bodies(model, system, analysis)
      else
         call note_largest(analysis)
         call follow_laws(model, analysis)
         call watch_condition(system, analysis%record%condition)
         if (plan%stages(analysis%stage)%output%condensed .and. analysis%increment == 1) &
            call condense_on_joints(model, system, analysis%before%condensed_load, analysis%after%condensed_load, &
                                    analysis%record%condensed)
         call enter(run, phase_recover)
         if (run%keeps_results .or. analysis%moves .or. shows_bodies(plan, analysis%stage, analysis%increment)) then
            call recover_bodies(model, system, analysis)
         else if (completes_stage) then
            u = analysis%u                   ! a copy for the answer of the stage: the analysis continues from the original
            unbalanced = analysis%unbalanced
            call recover_bodies(model, system, analysis)
            analysis%u = u
            analysis%unbalanced = unbalanced
         end if
         call check_state(model, plan, system, analysis, overflow)
         if (.not. overflow%raised) then
            call enter(run, phase_write)
            run%solver = system%description
            call list_results(model, plan, analysis, run%results)
            call advance(run, plan%stages(analysis%stage)%id, analysis%increment, &
                         size(plan%stages(analysis%stage)%fractions), analysis%record%n_iterations)
         end if
      end if
      if (analysis%increment > 0 .and. (completes_stage .or. run%keeps_results) .and. .not. overflow%raised) then
         call enter(run, phase_write)
         call print_stage(model, plan, analysis, run%results, overflow)
         if (completes_stage .and. .not. (run%keeps_results .or. overflow%raised)) call end_stage(plan, run%results)
      end if
      if (overflow%raised) then
         run%failure = overflow
         run%keeps_results = .false.
      end if
      call enter(run, phase_increments)
   end subroutine print_increment

end module run_boxes
