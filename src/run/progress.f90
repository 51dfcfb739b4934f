!> Holds the state of the run of one deck, which its boxes share, and shows its progress on the terminal.
!! The progress line has the phase, the increment and the time left; it appears only where standard error is a terminal. With --times
!! the run ends with a table: the seconds of each phase, operations, memory.
module progress
   use command_line, only: command_type, deck_argument
   use deck_errors, only: deck_error_list
   use distribution, only: memory_of_all
   use equation_solver, only: failure_type, solver_description
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: long, wp
   use restart_stream, only: restart_stream_type
   use output_file, only: output_file_type
   use results, only: results_type
   use stage_plan, only: stage_plan_type
   use terminal, only: clear_line, open_line, say_line, show_line
   use text_tools, only: integer_text
   implicit none
   private

   public :: start_run, enter, expect, advance, end_progress, is_over, tell

   integer, parameter, public :: phase_read = 1, phase_build = 2, phase_order = 3, phase_factor = 4, phase_increments = 5, &
                                 phase_recover = 6, phase_write = 7, phase_modes = 8, phase_backbone = 9
   character(10), parameter :: phase_name(9) = [character(10) :: 'read', 'build', 'order', 'factor', 'increments', 'recover', &
                                                'write', 'modes', 'backbone']

   ! early ends of a run, and the exit status of each
   integer, parameter, public :: goes_on = 0, is_unreadable = 1, would_overwrite = 2, has_errors = 3, was_checked = 4, &
                                 is_unsolved = 5, is_unwritten = 6, is_refused = 7, was_searched = 8
   integer, parameter, public :: status_of(0:8) = [0, 1, 1, 2, 0, 3, 4, 1, 0]

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
      integer(long) :: deck_sum = 0            !! checksum of the deck
      type(restart_stream_type) :: restart     !! the restart file to continue from, while it is read
      logical :: resumes = .false.             !! there is such a file
      character(:), allocatable :: problem     !! why the restart file cannot be used
      logical :: misses_output = .false.       !! a restart file, the answer or a VTU file could not be written
      integer(long) :: began = 0               !! clock at the start
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
      call open_line(argument%name//words, command%quiet)
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
   subroutine advance(run, stage, increment, increments)
      type(run_type), intent(inout) :: run
      integer, intent(in)           :: stage, increment, increments
      integer(long) :: now
      real(wp) :: left
      character(:), allocatable :: words

      run%done = run%done + 1
      call system_clock(now)
      left = real(now - run%increments_began, wp)/run%rate*(run%total - run%done)/(run%done - run%before)
      words = 'stage '//integer_text(stage)//', increment '//integer_text(increment)//' of '//integer_text(increments)// &
              ', '//integer_text(nint(left))//' s left'
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

end module progress
