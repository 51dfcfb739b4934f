!> The boxes of the flow chart that belong to no method: reading, building, printing, the end. Each says on the terminal where the
!! run is, and does nothing once one before it has ended the run; whatever ended it is said in one place, finish_run.
module run_boxes
   use analysis_state, only: analysis_type, interface_stiffness, note_largest, start_analysis
   use, intrinsic :: iso_fortran_env, only: error_unit
   use c_library, only: end_run, tell_failed_writes, write_bytes
   use case_control, only: method_back
   use command_arguments, only: complain_of_input
   use condensed_interface, only: condense_on_joints
   use condition_estimate, only: watch_condition
   use command_line, only: command_type, deck_argument, is_result_of, read_command_line
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type, read_deck
   use equation_solver, only: equation_system
   use equations, only: form_body_stiffness, start_equations
   use error_report, only: print_errors
   use failures, only: failure_type
   use finite_state, only: check_state
   use incomplete_results, only: watch_allocations
   use law_distance, only: follow_laws
   use listing_steps, only: distance_words
   use load_path, only: recover_bodies
   use kinds, only: wp
   use machine, only: keep_memory, use_threads
   use memory_need, only: check_model_size
   use model_build, only: build_model
   use model_data, only: model_type, n_points
   use model_warnings, only: tetra_words
   use newton_method, only: seat_joints
   use progress, only: phase_build, phase_factor, phase_increments, phase_order, phase_recover, phase_write, progress_type
   use results, only: discard_results, finish_results, history_ending, list_results => print_increment, listing_ending, &
                      print_stage_results => print_stage, remove_old_results, results_type, show_answers, start_results
   use stage_plan, only: factorisations_of, shows_bodies, stage_plan_type
   use text_tools, only: plural
   implicit none
   private

   public :: start_program, read_data, build_structure, form_bodies, start_joints, another_stage, another_increment, &
             print_increment, print_stage, finish_run, end_program

   ! how a run ended that did not come to its last increment, and the exit status that this is
   integer, parameter :: goes_on = 0, is_unreadable = 1, would_overwrite = 2, has_errors = 3, was_checked = 4, is_unsolved = 5, &
                         is_unwritten = 6
   integer, parameter :: status_of(0:6) = [0, 1, 1, 2, 0, 3, 4]

   integer :: exit_status = 0 ! the highest so far

   !> The run of one deck.
   type, public :: run_type
      type(failure_type) :: failure            !! the structure cannot be solved
      type(deck_argument), private   :: argument
      logical, private               :: check_only = .false., is_dated = .false.
      type(deck_error_list), private :: errors
      type(results_type), private    :: results
      type(progress_type), private   :: progress
      integer, private               :: ending = goes_on
      logical, private               :: keeps = .false. !! it ended early, but what there was in equilibrium is a result
   end type run_type

contains

   !> The command line; where it leaves nothing to do the program ends. Threads, and a watch on the memory.
   subroutine start_program(command)
      type(command_type), intent(out) :: command
      logical :: finished
      integer :: status

      call watch_allocations()
      call read_command_line(command, finished, status)
      if (finished) call end_program(status)
      call use_threads(command%threads)
      call tell_failed_writes()
   end subroutine start_program

   !> Whether nothing more is to be done for this deck.
   pure logical function is_over(run)
      type(run_type), intent(in) :: run

      is_over = run%failure%raised .or. run%ending /= goes_on
   end function is_over

   !> Read the deck of ARGUMENT.
   subroutine read_data(command, argument, run, deck)
      type(command_type), intent(in)  :: command
      type(deck_argument), intent(in) :: argument
      type(run_type), intent(out)     :: run
      type(deck_type), intent(out)    :: deck
      logical :: readable
      integer :: i

      run%argument = argument
      run%check_only = command%check_only
      run%is_dated = command%dated
      call run%progress%start(argument%name, command%quiet, command%times)
      call read_deck(argument%path, deck, run%errors, readable)
      if (.not. readable) then
         run%ending = is_unreadable
         return
      end if
      do i = 2, deck%text%n_files
         if (is_result_of(deck%text%files(i)%true_path, argument)) run%ending = would_overwrite
      end do
      if (.not. (is_over(run) .or. command%check_only)) then
         call remove_old_results(argument%base)
      end if
   end subroutine read_data

   !> Bodies, joints, supports, loads, stages.
   subroutine build_structure(run, deck, model, plan)
      type(run_type), intent(inout)      :: run
      type(deck_type), intent(in)        :: deck
      type(model_type), intent(out)      :: model
      type(stage_plan_type), intent(out) :: plan

      if (is_over(run)) return
      call keep_memory()
      call run%progress%enter(phase_build)
      if (.not. (run%check_only .or. run%errors%any())) call check_model_size(deck, run%failure)
      if (is_over(run)) return
      call build_model(deck, model, plan, run%errors)
      if (run%errors%any()) then
         run%ending = has_errors
      else if (run%check_only) then
         run%ending = was_checked
      end if
   end subroutine build_structure

   !> [k_b] of the bodies, factorised as far as no joint moves it; the listing can be opened then.
   subroutine form_bodies(run, deck, model, plan, system)
      type(run_type), intent(inout)     :: run
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), allocatable, intent(out) :: system
      logical :: ok

      if (is_over(run)) return
      call run%progress%enter(phase_order)
      call start_equations(model, system, run%failure, deck%control%solver, factorisations_of(plan, deck%control%method))
      call run%progress%enter(phase_factor)
      if (.not. run%failure%raised) call form_body_stiffness(model, system, run%failure)
      if (run%failure%raised) return
      call run%progress%enter(phase_write)
      run%progress%solver = system%description
      if (run%is_dated) run%results%listing%page%date = date_and_hour()
      call start_results(run%argument%base, deck, model, plan, system, run%results, ok)
      if (.not. ok) run%ending = is_unwritten
   end subroutine form_bodies

   !> Now, as 2026-11-22 09:30.
   function date_and_hour() result(words)
      character(16) :: words
      character(8)  :: date
      character(10) :: time

      call date_and_time(date, time)
      words = date(:4)//'-'//date(5:6)//'-'//date(7:)//' '//time(:2)//':'//time(3:4)
   end function date_and_hour

   !> NORM and SHEAR for a structure at rest, its interference in equilibrium (BACK takes all at once).
   subroutine start_joints(run, deck, model, plan, system, analysis)
      type(run_type), intent(inout)      :: run
      type(deck_type), intent(in)        :: deck
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), allocatable, intent(inout) :: system
      type(analysis_type), intent(out)   :: analysis

      if (is_over(run)) return
      call start_analysis(model, system, deck%control, analysis)
      if (deck%control%method /= method_back) call seat_joints(model, analysis, system, run%failure)
      call interface_stiffness(model, system, analysis, run%failure)
      call run%progress%expect(plan)
      call run%progress%enter(phase_increments)
   end subroutine start_joints

   !> Whether a stage is left.
   pure logical function another_stage(run, plan, analysis)
      type(run_type), intent(in)        :: run
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      another_stage = .not. is_over(run)
      if (another_stage) another_stage = analysis%stage < size(plan%stages)
   end function another_stage

   !> Whether an increment of the stage is left.
   pure logical function another_increment(run, plan, analysis)
      type(run_type), intent(in)        :: run
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      another_increment = .not. is_over(run)
      if (another_increment) another_increment = analysis%increment < size(plan%stages(analysis%stage)%shares)
   end function another_increment

   !> Print the increment just completed, and recover for that what the bodies do where it is shown.
   subroutine print_increment(run, model, plan, system, analysis)
      type(run_type), intent(inout)      :: run
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type)    :: overflow
      real(wp), allocatable :: u(:, :), unbalanced(:, :)

      run%keeps = run%failure%raised .and. run%ending == goes_on .and. analysis%ends_early
      if (is_over(run) .and. .not. run%keeps) return
      if (run%keeps .and. .not. analysis%is_partial) then ! it is printed, but for the tables of the end
         call recover_bodies(model, system, analysis)
         return
      end if
      call note_largest(analysis)
      call follow_laws(model, analysis)
      call watch_condition(system, analysis%condition)
      if (plan%stages(analysis%stage)%condensed .and. analysis%increment == 1) &
         call condense_on_joints(model, system, analysis%felt_before, analysis%felt_after, analysis%condensed)
      call run%progress%enter(phase_recover)
      if (run%keeps .or. analysis%moves .or. shows_bodies(plan, analysis%stage, analysis%increment)) then
         call recover_bodies(model, system, analysis)
      else if (analysis%increment == size(plan%stages(analysis%stage)%shares)) then
         u = analysis%u                   ! for the answer of the stage alone: what goes on from here is left as it is
         unbalanced = analysis%unbalanced
         call recover_bodies(model, system, analysis)
         analysis%u = u
         analysis%unbalanced = unbalanced
      end if
      call check_state(model, plan, system, analysis, overflow)
      if (overflow%raised) then
         run%failure = overflow
         run%keeps = .false.
         return
      end if
      call run%progress%enter(phase_write)
      call list_results(model, plan, analysis, run%results)
      call run%progress%advance(analysis%stage, analysis%increment, size(plan%stages(analysis%stage)%shares))
      call run%progress%enter(phase_increments)
   end subroutine print_increment

   !> Print the stage just completed.
   subroutine print_stage(run, model, plan, analysis)
      type(run_type), intent(inout)     :: run
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(failure_type) :: overflow

      if (is_over(run) .and. .not. run%keeps) return
      if (analysis%increment == 0) return
      call run%progress%enter(phase_write)
      call print_stage_results(model, plan, analysis, run%results, overflow)
      if (overflow%raised) then
         run%failure = overflow
         run%keeps = .false.
      end if
      call run%progress%enter(phase_increments)
   end subroutine print_stage

   !> The end of a run, the one there is: the results get their names, or what is wrong is said. Nothing else is left on the line
   !! of the terminal.
   subroutine finish_run(run, deck, model, plan)
      type(run_type), intent(inout)     :: run
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      character(:), allocatable :: words
      logical :: ok, shown

      if (run%keeps .or. .not. is_over(run)) then
         call run%progress%enter(phase_write)
         call finish_results(plan, run%failure, run%results, ok)
         call run%progress%finish()
         associate (n => run%results%listing%watch%n_warnings)
            if (n > 0) write (error_unit, '(4a)') run%argument%name, ': ', plural(n, 'warning'), ' in the listing'
         end associate
         words = run%results%listing%poor_condition
         if (words /= '') write (error_unit, '(3a)') run%argument%name, ': ', words
         words = distance_words(run%results%listing%farthest)
         if (words /= '') write (error_unit, '(3a)') run%argument%name, ': ', words
         if (tetra_words(model) /= '') write (error_unit, '(3a)') run%argument%name, ': ', tetra_words(model)
         call say_of_deck(run, deck)
         if (ok) then
            call show_answers(model, run%results, shown)
            if (.not. shown) exit_status = max(exit_status, status_of(is_unwritten))
         else
            run%ending = is_unwritten
         end if
      end if
      if (run%failure%raised) run%ending = is_unsolved
      call run%progress%clear()
      call say_how_it_ended(run, deck, model, plan)
      exit_status = max(exit_status, status_of(run%ending))
   end subroutine finish_run

   !> What of the deck has no effect, and how NASTRAN would read it otherwise.
   subroutine say_of_deck(run, deck)
      type(run_type), intent(in)  :: run
      type(deck_type), intent(in) :: deck

      if (deck%bulk%idle%n > 0) write (error_unit, '(3a)') run%argument%name, ': ', deck%bulk%idle%words()
      if (size(deck%control%stages) > 1) write (error_unit, '(4a)') run%argument%name, ': ', &
         plural(size(deck%control%stages), 'SUBCASE'), ' are stages of one history, each goes on from the end of the one before'
   end subroutine say_of_deck

   !> What is wrong, or that a deck is in order; no result is left of a run that did not come to its end.
   subroutine say_how_it_ended(run, deck, model, plan)
      type(run_type), intent(inout)     :: run
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      logical :: ok
      integer :: i

      associate (name => run%argument%name, base => run%argument%base)
         select case (run%ending)
         case (is_unreadable)
            call complain_of_input(run%argument, 'a deck')
         case (would_overwrite)
            do i = 2, deck%text%n_files
               if (is_result_of(deck%text%files(i)%true_path, run%argument)) write (error_unit, '(3a)') name, &
                  ': its results would overwrite the INCLUDE file ', deck%text%files(i)%path
            end do
         case (has_errors)
            call print_errors(error_unit, 'DECK', 'nothing solved', deck%text, run%errors)
         case (was_checked)
            call say_of_deck(run, deck)
            call write_bytes(1, name//': no errors; '//plural(n_points(model), 'node')//', '// &
                             plural(model%n_elements, 'body element')//', '// &
                             plural(size(model%interface), 'interface element')//', '//plural(size(plan%stages), 'stage')// &
                             new_line('a'), ok)
            if (.not. ok) exit_status = max(exit_status, status_of(is_unwritten))
         case (is_unsolved)
            write (error_unit, '(4a)') name, ': ', run%failure%message, &
               trim(merge('; the results end there', '; no results           ', run%keeps))
            if (.not. run%keeps) call discard_results(run%results)
         case (is_unwritten)
            if (base == '') then
               write (error_unit, '(2a)') name, ': the listing cannot be written to the standard output'
            else
               write (error_unit, '(5a)') name, ': the results ', base//listing_ending, ' and ', base//history_ending, &
                  ' cannot be written: is the folder there, and is there room on the disk?'
            end if
            call discard_results(run%results)
         end select
      end associate
   end subroutine say_how_it_ended

   !> End with STATUS, or the highest of the decks where that is higher.
   subroutine end_program(status)
      integer, intent(in), optional :: status !! 0

      if (present(status)) exit_status = max(exit_status, status)
      call end_run(exit_status)
   end subroutine end_program

end module run_boxes
