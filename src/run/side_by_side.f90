!> The runs of the command one after another; those of one deck with the rows of --set side by side, each in a process of its own.
!! The first run of a deck goes on alone and tells the memory that the others need: as many of them go on as there are cores and
!! memory for. What they write on the screen appears in the order of the runs, so that nothing depends on the number of cores. A run
!! that ends for want of memory, or without a report, runs once more alone. At an interrupt each run keeps its finished stages.
module side_by_side
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_null_char
   use, intrinsic :: iso_fortran_env, only: error_unit
   use c_library, only: c_usleep, close_file, end_run, read_all_bytes, write_bytes
   use case_control, only: has_petsc
   use command_line, only: command_type
   use incomplete_results, only: hold_interrupts, interrupt_so_far
   use kinds, only: long
   use machine, only: available_memory, kernel_figure, peak_memory, use_threads
   use omp_lib, only: omp_get_max_threads
   use openblas, only: c_fork, c_waitpid
   use run_summary, only: named_value, status_unsolved, status_unwritten, summary_row
   use terminal, only: clear_line, empty_line, open_line, say_line, show_line
   use text_tools, only: integer_text
   implicit none
   private

   public :: another_run, c_kill, c_memfd_create

   character(*), parameter, public :: streams_at = '/proc/self/fd/' ! a process opens them there at their beginning
   integer, parameter :: most_ahead = 100 ! of the first run that is not shown: the streams of all stay open until then

   !> The process of a run.
   type :: process_type
      integer(c_int) :: child = 0       ! its number while it goes on
      integer(c_int) :: streams(3) = -1 ! its standard output and standard error, its report
      logical :: alone = .false.        ! no other run goes on beside it
      logical :: has_ended = .false.
   end type process_type

   type(process_type), allocatable :: processes(:)
   integer :: n_shown = 0               ! runs whose words are on the screen
   integer :: told = 0                  ! the interrupt that the processes know
   integer :: report = -1               ! stream of this process, where it is that of a run
   integer(long) :: need = 0            ! largest memory of a run of this deck so far [bytes]

   interface
      integer(c_int) function c_kill(process, signal) bind(c, name='kill')
         import :: c_int
         integer(c_int), value :: process, signal
      end function c_kill

      !> A file that is in no folder; negative on failure.
      integer(c_int) function c_memfd_create(name, flags) bind(c, name='memfd_create')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*)
         integer(c_int), value :: flags
      end function c_memfd_create

      integer(c_int) function c_dup2(descriptor, number) bind(c, name='dup2')
         import :: c_int
         integer(c_int), value :: descriptor, number
      end function c_dup2

      integer(c_int) function c_prctl(option, value) bind(c, name='prctl')
         import :: c_int, c_long
         integer(c_int), value  :: option
         integer(c_long), value :: value
      end function c_prctl
   end interface

contains

   !> Whether there is ANOTHER RUN, the number of which is then RUN; ROWS has those that have ended. Of processes side by side, each
   !! has one run, and the parent none.
   logical function another_run(command, rows, run)
      type(command_type), intent(inout) :: command
      type(summary_row), intent(inout)  :: rows(:)
      integer, intent(inout)            :: run !! 0 at first
      integer :: next

      if (report >= 0) call end_child(rows(run))
      another_run = run < size(rows)
      if (command%n_rows == 1 .or. has_petsc) then
         run = run + 1
         return
      end if
      allocate (processes(size(rows)))
      processes(1::command%n_rows)%alone = .true.
      call open_line('all runs', command%quiet, command%in_lines)
      call hold_interrupts(.true.)
      do
         call look_at_processes(command, rows)
         next = findloc(processes%child == 0 .and. .not. processes%has_ended, .true., dim=1)
         if ((next == 0 .or. told /= 0) .and. all(processes%child == 0)) exit
         another_run = .false.
         if (next > 0 .and. told == 0) call start_if_room(command, next, another_run)
         if (another_run) run = next
         if (another_run) return
         if (c_usleep(3000_c_int) /= 0) cycle ! a signal interrupts the wait
      end do
      another_run = .false.
      do next = 1, size(rows)
         if (.not. processes(next)%has_ended) call read_report(command, next, rows(next))
      end do
      call clear_line()
   end function another_run

   !> Start run NEXT where no run that has to be alone goes on, and a core and memory are free, less what the others will still take.
   !! IS_CHILD is true in its process.
   subroutine start_if_room(command, next, is_child)
      type(command_type), intent(inout) :: command
      integer, intent(in)               :: next
      logical, intent(out)              :: is_child
      integer(c_int), parameter :: at_end_of_parent = 1, sigterm = 15 ! PR_SET_PDEATHSIG of Linux
      integer(c_int) :: status
      integer(long)  :: rest
      integer :: cores, k

      is_child = .false.
      cores = omp_get_max_threads()
      associate (process => processes(next), goes_on => processes%child > 0)
         if (any(goes_on)) then
            if (process%alone .or. any(goes_on .and. processes%alone) .or. count(goes_on) >= cores) return
            if (next > n_shown + most_ahead) return
            rest = available_memory()
            do k = 1, size(processes)
               if (goes_on(k)) rest = rest - max(0_long, need - kernel_figure('/proc/'// &
                                                 integer_text(int(processes(k)%child))//'/status', 'VmRSS:', 1024))
            end do
            if (need > rest) return
         end if
         if (modulo(next - 1, command%n_rows) == 0) need = 0
         flush (error_unit)
         if (any(process%streams < 0)) process%streams = [(c_memfd_create('jointfem'//c_null_char, 0_c_int), k = 1, 3)]
         status = -1
         if (all(process%streams >= 0)) status = c_fork()
         process%child = max(0_c_int, status)
         if (status < 0 .and. .not. any(goes_on)) told = -1
         if (told < 0) call say_line('no process can be started for the runs of --set')
         is_child = status == 0
         if (.not. is_child) return
         status = c_prctl(at_end_of_parent, int(sigterm, c_long))
         status = c_dup2(process%streams(1), 1_c_int)
         if (.not. command%in_lines) status = c_dup2(process%streams(2), 2_c_int)
         report = int(process%streams(3))
         command%quiet = .not. command%in_lines ! the parent shows progress
         if (.not. process%alone) call use_threads(cores/min(cores, command%n_rows - 1))
      end associate
      call hold_interrupts(.false.)
   end subroutine start_if_room

   !> Take the rows and words of the processes that have ended; tell the others of an interrupt.
   subroutine look_at_processes(command, rows)
      type(command_type), intent(in)   :: command
      type(summary_row), intent(inout) :: rows(:)
      integer(c_int), parameter :: at_once = 1 ! WNOHANG
      integer(c_int) :: status
      integer :: interrupt, k

      interrupt = interrupt_so_far()
      do k = 1, size(processes)
         associate (process => processes(k))
            if (process%child == 0) cycle
            if (interrupt /= told) status = c_kill(process%child, int(interrupt, c_int))
            if (c_waitpid(process%child, status, at_once) == 0) cycle
            process%child = 0
            call read_report(command, k, rows(k))
            process%has_ended = process%alone .or. .not. rows(k)%is_short .or. interrupt_so_far() /= 0
            process%alone = .true.
            if (process%has_ended .and. iand(status, 127_c_int) /= 0 .and. interrupt_so_far() == 0) &
               call say_line(rows(k)%name//': ended by signal '//integer_text(int(iand(status, 127_c_int)))//'; no results')
            if (.not. process%has_ended) call take_words(process%streams, rows(k), are_shown=.false.)
            call show_line(integer_text(count(processes%has_ended))//' of '//integer_text(size(rows))//' have ended', &
                           at_once=.true., is_logged=.true.)
         end associate
      end do
      if (told >= 0) told = interrupt
      do while (n_shown < size(rows))
         if (.not. processes(n_shown + 1)%has_ended) exit
         n_shown = n_shown + 1
         call take_words(processes(n_shown)%streams, rows(n_shown), are_shown=.true.)
      end do
   end subroutine look_at_processes

   !> Take what the run of ROW has written into its STREAMS. It goes to the screen if the words ARE SHOWN.
   subroutine take_words(streams, row, are_shown)
      integer(c_int), intent(inout)    :: streams(3) !! closed
      type(summary_row), intent(inout) :: row
      logical, intent(in)              :: are_shown
      character(:), allocatable :: words
      logical :: ok
      integer :: k

      if (any(streams < 0)) return
      call empty_line()
      do k = 3, 1, -1
         if (k < 3) call read_all_bytes(streams_at//integer_text(int(streams(k))), words, ok)
         call close_file(int(streams(k)), ok)
         if (k < 3 .and. are_shown) call write_bytes(k, words, ok)
      end do
      streams = -1
      if (ok .or. .not. are_shown) return
      row%exit = max(row%exit, status_unwritten)
      call say_line(row%name//': the standard output cannot be written')
   end subroutine take_words

   !> Report ROW and the memory of this process to its parent, and end.
   subroutine end_child(row)
      type(summary_row), intent(in) :: row
      integer :: unit

      open (newunit=unit, file=streams_at//integer_text(report), access='stream', action='write', status='old')
      write (unit) row%ended, row%status, row%exit, row%seconds, row%is_short, peak_memory(), size(row%values), row%values
      close (unit)
      call end_run(row%exit)
   end subroutine end_child

   !> Read the ROW of run K and its memory from the report of its process, if it has left one.
   subroutine read_report(command, k, row)
      type(command_type), intent(in)   :: command
      integer, intent(in)              :: k
      type(summary_row), intent(inout) :: row
      integer(long) :: memory
      integer :: n, status, unit

      row%name = command%decks(k)%name
      row%values = [named_value ::]
      status = -1
      if (processes(k)%streams(3) >= 0) then
         open (newunit=unit, file=streams_at//integer_text(int(processes(k)%streams(3))), access='stream', action='read', &
               status='old')
         read (unit, iostat=status) row%ended, row%status, row%exit, row%seconds, row%is_short, memory, n
         if (status == 0) then
            need = max(need, memory)
            deallocate (row%values)
            allocate (row%values(n))
            read (unit) row%values
         end if
         close (unit)
      end if
      if (status == 0) return
      row%ended = 'NO RESULTS'
      if (interrupt_so_far() /= 0) row%ended = 'INTERRUPTED'
      row%status = status_unsolved
      row%exit = status_unsolved
      row%is_short = .true.
   end subroutine read_report

end module side_by_side
