!> Holds the run of one deck, which its boxes share: state, progress on the terminal, end.
!! The progress line has the phase, the increment and the time left; it appears only where standard error is a terminal. With
!! --times the run ends with a table: the seconds of each phase, operations, memory.
module run_of_deck
   use c_library, only: write_bytes
   use command_line, only: command_type, deck_argument, is_result_of
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use distance_watch, only: distance_words
   use distribution, only: memory_of_all
   use equation_solver, only: equation_system, failure_type, solver_description
   use error_report, only: print_errors
   use incomplete_results, only: say_at_interrupts, what_is_in_the_way
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: long, wp
   use mesh_queries, only: n_points
   use model_data, only: model_type
   use openblas, only: kernel_words
   use output_file, only: output_file_type
   use range_watch, only: tetra_words
   use restart_stream, only: restart_stream_type
   use result_page, only: history_ending
   use result_names, only: listing_ending, restart_ending
   use results, only: discard_results, finish_results, keep_finished_stages, results_type, show_answers
   use run_summary, only: status_unsolved, status_unwritten, summarise, summary_row
   use stage_plan, only: stage_plan_type
   use terminal, only: clear_line, complain_of_input, log_line, open_line, say_line, show_line
   use text_tools, only: integer_text, plural
   use unit_watch, only: stress_words
   implicit none
   private

   public :: start_run, enter, expect, advance, is_over, tell, finish_run

   integer, parameter, public :: phase_read = 1, phase_build = 2, phase_order = 3, phase_factor = 4, phase_increments = 5, &
                                 phase_recover = 6, phase_write = 7, phase_modes = 8, phase_backbone = 9
   character(10), parameter :: phase_name(9) = [character(10) :: 'read', 'build', 'order', 'factor', 'increments', 'recover', &
                                                'write', 'modes', 'backbone']

   ! early ends of a run, and the exit status of each
   integer, parameter, public :: goes_on = 0, is_unreadable = 1, would_overwrite = 2, has_errors = 3, was_checked = 4, &
                                 is_unsolved = 5, is_unwritten = 6, is_refused = 7, was_searched = 8
   integer, parameter :: status_of(0:8) = [0, 1, 1, 2, 0, status_unsolved, status_unwritten, 1, 0]

   !> Equations of independent cases whose supports come again.
   type, public :: kept_equations
      class(equation_system), allocatable :: system
   end type kept_equations

   !> The run of one deck.
   type, public :: run_type
      type(failure_type) :: failure            !! why the structure cannot be solved
      type(deck_argument) :: argument
      logical :: check_only = .false., is_dated = .false., suggests = .false. !! of the command; suggests: --joints
      type(output_file_type) :: suggestions    !! of --joints, for the standard output
      type(deck_error_list) :: errors
      type(results_type) :: results
      integer :: ending = goes_on
      logical :: keeps_results = .false.       !! the run ended early, but its last equilibrium is a result
      logical :: keeps_stages = .false.        !! ... or its finished stages are
      integer(long) :: deck_sum = 0            !! checksum of the deck
      type(restart_stream_type) :: restart     !! the restart file to continue from, while it is read
      logical :: resumes = .false.             !! there is such a file
      character(:), allocatable :: problem     !! why the restart file cannot be used
      type(kept_equations), allocatable :: kept(:) !! of each of the freedoms of the model
      logical :: misses_output = .false.       !! a restart file, the answer or a VTU file could not be written
      integer(long), private :: began = 0      ! clock at the start
      type(solver_description) :: solver       !! for the operations in the table at the end
      logical, private :: is_timed = .false.   ! --times
      integer, private :: phase = 0
      integer, private :: done = 0, total = 0, before = 0 ! increments; before: by an earlier run
      integer(long), private :: entered = 0, increments_began = 0, rate = 1
      integer(long), private :: ticks(size(phase_name)) = 0
   end type run_type

contains

   !> Begin a run of COMMAND, of the deck of ARGUMENT, with the phase of reading.
   subroutine start_run(command, argument, run)
      type(command_type), intent(in)  :: command
      type(deck_argument), intent(in) :: argument
      type(run_type), intent(out)     :: run
      character(:), allocatable :: words

      run%argument = argument
      run%check_only = command%check_only .or. command%suggest
      run%suggests = command%suggest
      run%is_dated = command%dated
      run%is_timed = command%times
      words = ''
      if (argument%of > 1) words = ' ('//integer_text(argument%number)//' of '//integer_text(argument%of)//')'
      call open_line(argument%name//words, command%quiet, command%in_lines)
      call system_clock(run%began, run%rate)
      run%entered = run%began
      run%phase = phase_read
   end subroutine start_run

   !> Begin the next PHASE.
   subroutine enter(run, phase)
      type(run_type), intent(inout) :: run
      integer, intent(in)           :: phase
      integer(long) :: now

      call system_clock(now)
      run%ticks(run%phase) = run%ticks(run%phase) + now - run%entered
      run%entered = now
      run%phase = phase
      if (phase < phase_increments .or. phase >= phase_modes) call show_line(trim(phase_name(phase)), at_once=.true.)
   end subroutine enter

   !> Count the increments of PLAN from now on; an earlier run has done those up to INCREMENT of STAGE.
   subroutine expect(run, plan, stage, increment)
      type(run_type), intent(inout)     :: run
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage, increment
      integer :: s

      associate (increments => [(size(plan%stages(s)%fractions), s = 1, size(plan%stages))])
         run%before = sum(increments(:stage - 1)) + increment
         run%total = sum(increments)
      end associate
      run%done = run%before
      call system_clock(run%increments_began)
   end subroutine expect

   !> Count one more increment. The first one of a run is always shown.
   subroutine advance(run, stage, increment, increments, iterations)
      type(run_type), intent(inout) :: run
      integer, intent(in)           :: stage, increment, increments, iterations
      integer(long) :: now
      real(wp) :: left
      character(:), allocatable :: words

      run%done = run%done + 1
      call system_clock(now)
      left = real(now - run%increments_began, wp)/run%rate*(run%total - run%done)/(run%done - run%before)
      words = 'stage '//integer_text(stage)//', increment '//integer_text(increment)//' of '//integer_text(increments)
      call log_line(words//', '//plural(iterations, 'iteration')//', '//integer_text(nint(left))//' s left')
      words = words//', '//integer_text(nint(left))//' s left'
      if (run%solver%solutions > 0) words = words//', '//integer_text(int(run%solver%steps/run%solver%solutions))// &
                                            ' steps a solution'
      call show_line(words, at_once=run%done == run%before + 1)
   end subroutine advance

   !> End the progress: clear the line, print the times.
   subroutine end_progress(run)
      type(run_type), intent(inout) :: run
      real(wp) :: bytes
      integer  :: i

      call enter(run, phase_write)
      call clear_line()
      if (.not. run%is_timed) return
      associate (deck => run%argument%name, solver => run%solver)
         do i = 1, size(phase_name)
            write (error_unit, '(3a, f12.4, a)') deck, ': ', phase_name(i), real(run%ticks(i), wp)/run%rate, ' s'
         end do
         write (error_unit, '(3a, f12.4, a)') deck, ': ', 'elements  ', solver%assembly_time, ' s of factor'
         write (error_unit, '(3a, es12.4)') deck, ': ', 'operations static     ', solver%static_operations, &
            deck, ': ', 'operations refactored ', solver%refactored_operations
         if (solver%solutions > 0) write (error_unit, '(2a, 3(a, i0))') deck, ': ', 'solutions ', solver%solutions, &
            ', steps ', solver%steps, ', at most ', solver%most_steps
         write (error_unit, '(3a)') deck, ': ', kernel_words()
         call memory_of_all(bytes)
         write (error_unit, '(3a, i12, a)') deck, ': ', 'memory    ', nint(bytes/1048576.0_wp), ' MiB'
      end associate
   end subroutine end_progress

   !> Whether the work on this deck has ended.
   pure logical function is_over(run)
      type(run_type), intent(in) :: run

      is_over = run%failure%raised .or. run%ending /= goes_on
   end function is_over

   !> Print WORDS about the deck of RUN, if any.
   subroutine tell(run, words)
      type(run_type), intent(in) :: run
      character(*), intent(in)   :: words

      if (words /= '') call say_line(run%argument%name//': '//words)
   end subroutine tell

   !> End the current run: name the results or report the error, and set its ROW. The progress line is cleared.
   subroutine finish_run(run, deck, model, plan, row)
      type(run_type), intent(inout)     :: run
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(summary_row), intent(out)    :: row
      integer(long) :: now, rate
      logical :: ok, shown

      run%keeps_stages = run%failure%raised .and. run%ending == goes_on .and. .not. run%keeps_results
      if (run%keeps_stages) call keep_finished_stages(run%results, run%keeps_stages)
      if (run%keeps_stages .or. run%keeps_results .or. .not. is_over(run)) then
         call enter(run, phase_write)
         call finish_results(model, plan, run%failure, run%results, ok)
         call end_progress(run)
         associate (watch => run%results%watch)
            if (watch%n_warnings > 0) call tell(run, plural(watch%n_warnings, 'warning')//' in the listing')
            call tell(run, watch%poor_condition)
            call tell(run, stress_words(run%results%counts%digest%strained))
            call tell(run, watch%divided)
            call tell(run, watch%overloaded)
            call tell(run, distance_words(watch%farthest))
         end associate
         call tell(run, tetra_words(model))
         call say_of_deck(run, deck, model, plan)
         if (ok) then
            call show_answers(run%results, shown)
            if (.not. shown) call miss_output(run)
            run%misses_output = run%misses_output .or. run%results%missing_vtu /= ''
            if (run%results%missing_vtu /= '') &
               call tell(run, 'the files for ParaView cannot be written: '//run%results%missing_vtu)
         else
            run%ending = is_unwritten
         end if
      end if
      if (run%failure%raised) run%ending = is_unsolved
      call clear_line()
      call say_at_interrupts('')
      call say_how_it_ended(run, deck, model, plan)
      call system_clock(now, rate)
      call summarise(run%argument%name, model, run%results, run%failure, run%keeps_results, status_of(run%ending), row)
      row%exit = max(row%status, merge(status_unwritten, 0, run%misses_output))
      row%seconds = real(now - run%began, wp)/real(rate, wp)
   end subroutine finish_run

   !> Report that the standard output is full or closed.
   subroutine miss_output(run)
      type(run_type), intent(inout) :: run

      call tell(run, 'the standard output cannot be written')
      run%misses_output = .true.
   end subroutine miss_output

   !> Report the kind of the model where the deck leaves a choice, the entries without effect, and how NASTRAN would read the deck
   !! differently.
   subroutine say_of_deck(run, deck, model, plan)
      type(run_type), intent(in)   :: run
      type(deck_type), intent(in)  :: deck
      type(model_type), intent(in) :: model
      type(stage_plan_type), intent(in) :: plan
      integer :: i

      if (allocated(model%mesh%kind_words)) call tell(run, model%mesh%kind_words)
      if (deck%bulk%ignored%n > 0) call tell(run, deck%bulk%ignored%words())
      if (allocated(deck%bulk%told)) then
         do i = 1, size(deck%bulk%told)
            call tell(run, deck%bulk%told(i)%words)
         end do
      end if
      if (deck%control%of_nastran .and. size(plan%stages) > 1 .and. .not. plan%is_independent) call tell(run, &
         plural(size(plan%stages), 'SUBCASE')//' are stages of one history: each starts from the end of the previous one, '// &
         'or of the one that FROM names')
   end subroutine say_of_deck

   !> Report the error, or that a deck is in order. A run that did not finish leaves no result.
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
         case (is_refused)
            call tell(run, base//restart_ending//' cannot be resumed: '//run%problem)
            call discard_results(run%results)
         case (would_overwrite)
            do i = 2, deck%text%n_files
               if (is_result_of(deck%text%files(i)%true_path, run%argument)) &
                  call tell(run, 'its results would overwrite the INCLUDE file '//deck%text%files(i)%path)
            end do
         case (has_errors)
            if (allocated(model%mesh%kind_words)) call tell(run, model%mesh%kind_words)
            if (allocated(run%errors%warnings)) then
               do i = 1, size(run%errors%warnings)
                  call tell(run, run%errors%warnings(i)%words)
               end do
            end if
            call print_errors(error_unit, 'DECK', 'nothing solved', deck%text, run%errors)
         case (was_checked)
            call say_of_deck(run, deck, model, plan)
            call write_bytes(1, name//': no errors; '//plural(n_points(model%mesh), 'node')//', '// &
                             plural(model%mesh%n_elements, 'body element')//', '// &
                             plural(size(model%joints%element), 'interface element')//', '//plural(size(plan%stages), 'stage')// &
                             new_line('a'), ok)
            if (.not. ok) call miss_output(run)
         case (was_searched)
            call say_of_deck(run, deck, model, plan)
            call run%suggestions%finish(ok)
            if (.not. ok) call miss_output(run)
         case (is_unsolved)
            if (run%keeps_results) then
               call tell(run, run%failure%message//'; the results end there')
            else if (run%keeps_stages) then
               call tell(run, run%failure%message//'; the results end at '//run%results%page%place)
            else
               call tell(run, run%failure%message//'; no results')
               call discard_results(run%results)
            end if
         case (is_unwritten)
            if (base == '') then
               call tell(run, 'the listing cannot be written to the standard output')
            else if (what_is_in_the_way() /= '') then
               call tell(run, 'the results cannot be written: '//what_is_in_the_way()// &
                              '; remove it, or take another folder by -o')
            else
               call tell(run, 'the results '//base//listing_ending//' and '//base//history_ending// &
                              ' cannot be written: is the folder there, and is there room on the disk?')
            end if
            call discard_results(run%results)
         end select
      end associate
   end subroutine say_how_it_ended

end module run_of_deck
