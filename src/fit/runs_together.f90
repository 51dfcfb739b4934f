!> Runs of one structure with several sets of values side by side on the cores, each in a process of its own that is forked behind
!! the bodies: all share the factor of their static part. This process itself never starts a thread, which a fork would lose.
module runs_together
   use, intrinsic :: iso_c_binding, only: c_int, c_null_char
   use c_library, only: c_usleep, close_file, end_run
   use incomplete_results, only: interrupt_so_far
   use kinds, only: wp
   use machine, only: use_threads
   use measured_data, only: measured_type
   use openblas, only: c_fork, c_waitpid
   use side_by_side, only: c_kill, c_memfd_create, streams_at
   use structure_answers, only: answer_type, structure_type
   use structure_run, only: run_structure
   use terminal, only: open_line
   use text_tools, only: integer_text
   implicit none
   private

   public :: run_all

contains

   !> The ANSWERS of the runs with VALUES, (parameters, runs), on at most CORES. NEAR as in run_structure.
   subroutine run_all(data, structure, values, cores, answers, near)
      type(measured_type), intent(in)         :: data
      type(structure_type), intent(inout)     :: structure
      real(wp), intent(in)                    :: values(:, :)
      integer, intent(in)                     :: cores
      type(answer_type), allocatable, intent(out) :: answers(:)
      type(answer_type), intent(in), optional :: near
      integer(c_int), parameter :: at_once = 1, sigkill = 9 ! at_once: WNOHANG
      integer(c_int) :: child(size(values, 2)), status, stream(size(values, 2))
      integer :: k, started

      allocate (answers(size(values, 2)))
      child = 0
      started = 0
      do while (started < size(child) .or. any(child > 0))
         if (started < size(child) .and. count(child > 0) < cores .and. interrupt_so_far() == 0) then
            started = started + 1
            k = started
            stream(k) = c_memfd_create('jointfit'//c_null_char, 0_c_int)
            child(k) = c_fork()
            if (child(k) == 0) then
               call open_line('', quiet=.true., in_lines=.false.)
               call use_threads(max(1, cores/size(child)))
               call run_structure(data, values(:, k), structure, answers(k), near)
               call send(int(stream(k)), answers(k))
               call end_run(0)
            end if
         else
            status = c_usleep(1000_c_int)
         end if
         do k = 1, started
            if (child(k) <= 0) cycle
            if (interrupt_so_far() /= 0) status = c_kill(child(k), sigkill)
            if (c_waitpid(child(k), status, at_once) == 0) cycle
            child(k) = 0
            call receive(int(stream(k)), answers(k))
         end do
         if (interrupt_so_far() /= 0) started = size(child)
      end do
      do k = 1, size(answers)
         answers(k)%set = values(:, k)
         if (.not. allocated(answers(k)%fault)) answers(k)%fault = 'interrupted'
      end do
   end subroutine run_all

   !> Write ANSWER to the stream of this process.
   subroutine send(stream, answer)
      integer, intent(in)           :: stream
      type(answer_type), intent(in) :: answer
      integer :: s, unit

      open (newunit=unit, file=streams_at//integer_text(stream), access='stream', action='write', status='old')
      write (unit) len(answer%fault), answer%fault
      if (answer%fault == '') then
         write (unit) shape(answer%shapes), size(answer%stages), answer%value, answer%off_number, answer%mac, answer%mode, &
            answer%shapes
         do s = 1, size(answer%stages)
            associate (stage => answer%stages(s))
               write (unit) allocated(stage%reduced)
               if (allocated(stage%reduced)) write (unit) shape(stage%moved), shape(stage%u), stage%n_before, stage%lambda, &
                  stage%u, stage%k, stage%reduced, stage%moved, stage%place
            end associate
         end do
      end if
      close (unit)
   end subroutine send

   !> Read ANSWER from the STREAM of a process that has ended, and close it.
   subroutine receive(stream, answer)
      integer, intent(in)              :: stream
      type(answer_type), intent(inout) :: answer
      integer :: length, n(2), rows(3), s, status, unit
      logical :: is_there, ok

      open (newunit=unit, file=streams_at//integer_text(stream), access='stream', action='read', status='old')
      read (unit, iostat=status) length
      answer%fault = 'the run has ended without a report'
      if (status == 0) then
         deallocate (answer%fault)
         allocate (character(length) :: answer%fault)
         read (unit) answer%fault
         if (length == 0) then
            read (unit) rows
            allocate (answer%value(rows(2)), answer%off_number(rows(2)), answer%mac(rows(2)), answer%mode(rows(2)), &
                      answer%shapes(rows(1), rows(2)), answer%stages(rows(3)))
            read (unit) answer%value, answer%off_number, answer%mac, answer%mode, answer%shapes
            do s = 1, size(answer%stages)
               associate (stage => answer%stages(s))
                  read (unit) is_there
                  if (.not. is_there) cycle
                  read (unit) n, rows(:2)
                  allocate (stage%lambda(rows(2)), stage%u(rows(1), rows(2)), stage%k(n(1)), stage%reduced(n(2), n(2)), &
                            stage%moved(n(1), n(2)), stage%place(n(2), rows(2)))
                  read (unit) stage%n_before, stage%lambda, stage%u, stage%k, stage%reduced, stage%moved, stage%place
               end associate
            end do
         end if
      end if
      close (unit)
      call close_file(stream, ok)
   end subroutine receive

end module runs_together
