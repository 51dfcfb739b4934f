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
   use terminal, only: clear_line, open_line, show_line
   use text_tools, only: integer_text
   implicit none
   private

   public :: is_over

   integer, parameter, public :: phase_read = 1, phase_build = 2, phase_order = 3, phase_factor = 4, phase_increments = 5, &
                                 phase_recover = 6, phase_write = 7, phase_modes = 8, phase_backbone = 9
   character(10), parameter :: phase_name(9) = [character(10) :: 'read', 'build', 'order', 'factor', 'increments', 'recover', &
                                                'write', 'modes', 'backbone']

   type, public :: progress_type
      private
      logical :: timed = .false.
      integer :: phase = 0
      integer :: done  = 0, total = 0, before = 0 ! increments; before: by an earlier run
      integer(long), public :: began = 0          !! clock at the start of the run
      integer(long) :: entered = 0, increments_began = 0, rate = 1
      integer(long) :: ticks(size(phase_name)) = 0
      character(:), allocatable :: deck
      type(solver_description), public :: solver !! for the operations in the table at the end
   contains
      procedure :: start
      procedure :: enter
      procedure :: expect
      procedure :: advance
      procedure :: finish
   end type progress_type

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
      type(progress_type) :: progress
      integer :: ending = goes_on
      logical :: keeps_results = .false.               !! the run ended early, but its last equilibrium is a result
      integer(long) :: deck_sum = 0            !! checksum of the deck
      type(restart_stream_type) :: restart     !! the restart file to continue from, while it is read
      logical :: resumes = .false.             !! there is such a file
      character(:), allocatable :: problem     !! why the restart file cannot be used
      logical :: misses_output = .false.       !! a restart file, the answer or a VTU file could not be written
   end type run_type

contains

   !> Begin a run of COMMAND, of the deck of ARGUMENT, with the phase of reading.
   subroutine start(self, command, argument)
      class(progress_type), intent(inout) :: self
      type(command_type), intent(in)      :: command
      type(deck_argument), intent(in)     :: argument

      self%deck = argument%name
      if (argument%of == 1) call open_line(self%deck, command%quiet)
      if (argument%of > 1) call open_line(self%deck//' ('//integer_text(argument%number)//' of '//integer_text(argument%of)//')', &
                                          command%quiet)
      self%timed = command%times
      call system_clock(self%began, self%rate)
      self%entered = self%began
      self%phase = phase_read
   end subroutine start

   !> Begin the next PHASE.
   subroutine enter(self, phase)
      class(progress_type), intent(inout) :: self
      integer, intent(in)                 :: phase
      integer(long) :: now

      call system_clock(now)
      self%ticks(self%phase) = self%ticks(self%phase) + now - self%entered
      self%entered = now
      self%phase = phase
      if (phase < phase_increments .or. phase >= phase_modes) call show_line(trim(phase_name(phase)), at_once=.true.)
   end subroutine enter

   !> Count the increments of PLAN from now on; an earlier run has done the first N of them.
   subroutine expect(self, plan, n)
      class(progress_type), intent(inout) :: self
      type(stage_plan_type), intent(in)   :: plan
      integer, intent(in)                 :: n
      integer :: s

      self%before = n
      self%done = n
      self%total = sum([(size(plan%stages(s)%fractions), s = 1, size(plan%stages))])
      call system_clock(self%increments_began)
   end subroutine expect

   !> Count one more increment. The first one of a run is always shown.
   subroutine advance(self, stage, increment, increments)
      class(progress_type), intent(inout) :: self
      integer, intent(in)                 :: stage, increment, increments
      integer(long) :: now
      real(wp) :: left
      character(:), allocatable :: words

      self%done = self%done + 1
      call system_clock(now)
      left = real(now - self%increments_began, wp)/self%rate*(self%total - self%done)/(self%done - self%before)
      words = 'stage '//integer_text(stage)//', increment '//integer_text(increment)//' of '//integer_text(increments)// &
              ', '//integer_text(nint(left))//' s left'
      if (self%solver%solutions > 0) words = words//', '//integer_text(int(self%solver%steps/self%solver%solutions))// &
                                             ' steps a solution'
      call show_line(words, at_once=self%done == self%before + 1)
   end subroutine advance

   !> End the run: clear the line, print the times.
   subroutine finish(self)
      class(progress_type), intent(inout) :: self
      real(wp) :: bytes
      integer  :: i

      call self%enter(phase_write)
      call clear_line()
      if (.not. self%timed) return
      do i = 1, size(phase_name)
         write (error_unit, '(3a, f12.4, a)') self%deck, ': ', phase_name(i), real(self%ticks(i), wp)/self%rate, ' s'
      end do
      write (error_unit, '(3a, f12.4, a)') self%deck, ': ', 'elements  ', self%solver%assembly_time, ' s of factor'
      write (error_unit, '(3a, es12.4)') self%deck, ': ', 'operations static     ', self%solver%static_operations, &
         self%deck, ': ', 'operations refactored ', self%solver%refactored_operations
      if (self%solver%solutions > 0) write (error_unit, '(2a, 3(a, i0))') self%deck, ': ', 'solutions ', self%solver%solutions, &
         ', steps ', self%solver%steps, ', at most ', self%solver%most_steps
      call memory_of_all(bytes)
      write (error_unit, '(3a, i12, a)') self%deck, ': ', 'memory    ', nint(bytes/1048576.0_wp), ' MiB'
   end subroutine finish

   !> Whether the work on this deck has ended.
   pure logical function is_over(run)
      type(run_type), intent(in) :: run

      is_over = run%failure%raised .or. run%ending /= goes_on
   end function is_over

end module progress
