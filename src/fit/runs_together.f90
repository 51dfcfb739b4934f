!> Runs of one structure with several sets of values side by side on the cores, each in a process of its own that is forked behind
!! the bodies: all share the factor of their static part. This process itself never starts a thread, which a fork would lose.
module runs_together
   use, intrinsic :: iso_c_binding, only: c_int, c_null_char
   use c_library, only: c_usleep, close_file, end_run
   use control_words, only: method_newton
   use incomplete_results, only: interrupt_so_far
   use kinds, only: wp
   use machine, only: use_threads
   use measured_data, only: measured_type
   use openblas, only: c_fork, c_waitpid
   use side_by_side, only: c_kill, c_memfd_create, streams_at
   use mode_rows, only: answer_type, is_predicted, structure_type
   use structure_run, only: run_structure
   use terminal, only: open_line
   use text_tools, only: integer_text
   implicit none
   private

   public :: run_all

contains

   !> The ANSWERS of the runs with VALUES, (parameters, runs), on at most CORES. NEAR as in run_structure. TOGETHER: where only laws
   !! differ, the others run beside the first one, which is not run where there are none; what has no equilibrium so runs alone.
   subroutine run_all(data, structure, values, cores, answers, near, together)
      type(measured_type), intent(in)         :: data
      type(structure_type), intent(inout)     :: structure
      real(wp), intent(in)                    :: values(:, :)
      integer, intent(in)                     :: cores
      type(answer_type), allocatable, intent(out) :: answers(:)
      type(answer_type), intent(in), optional :: near
      logical, intent(in), optional           :: together
      integer(c_int), parameter :: at_once = 1, sigkill = 9 ! at_once: WNOHANG
      integer(c_int) :: child(size(values, 2)), status, stream(size(values, 2))
      logical :: beside(size(values, 2)), waits(size(values, 2))
      integer :: i, k

      allocate (answers(size(values, 2)))
      beside = .false.
      if (present(together) .and. present(near)) beside(2:) = [(can_be_beside(data, structure, values(:, [1, k]), near), &
                                                               k = 2, size(beside))]
      child = 0
      waits = .not. beside
      if (present(together)) waits(1) = any(beside)
      do while (any(waits) .or. any(child > 0))
         k = findloc(waits, .true., dim=1)
         if (k > 0 .and. count(child > 0) < cores .and. interrupt_so_far() == 0) then
            waits(k) = .false.
            stream(k) = c_memfd_create('jointfit'//c_null_char, 0_c_int)
            child(k) = c_fork()
            if (child(k) == 0) then
               call open_line('', quiet=.true., in_lines=.false.)
               call use_threads(max(1, cores/size(child)))
               associate (group => group_of(k))
                  call run_structure(data, values(:, group), structure, answers(:size(group)), near)
                  call send(int(stream(k)), answers(:size(group)))
               end associate
               call end_run(0)
            end if
         else
            status = c_usleep(1000_c_int)
         end if
         do k = 1, size(child)
            if (child(k) <= 0) cycle
            if (interrupt_so_far() /= 0) status = c_kill(child(k), sigkill)
            if (c_waitpid(child(k), status, at_once) == 0) cycle
            child(k) = 0
            call receive(int(stream(k)), group_of(k), answers)
            if (k > 1) cycle
            do i = 2, size(beside)
               if (beside(i)) waits(i) = answers(i)%fault /= ''
            end do
            beside = .false.
         end do
         if (interrupt_so_far() /= 0) waits = .false.
      end do
      do k = 1, size(answers)
         answers(k)%set = values(:, k)
         if (.not. allocated(answers(k)%fault)) answers(k)%fault = 'interrupted'
      end do

   contains

      !> The runs of the process of run K: itself, and those beside the first one.
      pure function group_of(k) result(group)
         integer, intent(in)  :: k
         integer :: group(merge(1 + count(beside), 1, k == 1))
         integer :: i

         group = pack([(i, i = 1, size(beside))], [(i == k .or. (beside(i) .and. k == 1), i = 1, size(beside))])
      end function group_of

   end subroutine run_all

   !> Whether the run with the second of two sets of VALUES can be beside that with the first one.
   logical function can_be_beside(data, structure, values, near) result(can)
      type(measured_type), intent(in)  :: data
      type(structure_type), intent(in) :: structure
      real(wp), intent(in)             :: values(:, :)
      type(answer_type), intent(in)    :: near
      integer :: s

      can = structure%deck%control%method == method_newton .and. .not. any(structure%plan%stages%follows_path)
      can = can .and. all(structure%keeps_bodies .or. (abs(values(:, 1) - near%set) <= 0.0_wp .and. &
                                                       abs(values(:, 2) - near%set) <= 0.0_wp))
      can = can .and. all([(is_predicted(data, s, structure%plan), s = 1, size(structure%plan%stages))])
   end function can_be_beside

   !> Write the ANSWERS to the stream of this process.
   subroutine send(stream, answers)
      integer, intent(in)              :: stream
      type(answer_type), intent(inout) :: answers(:)
      integer :: k, s, unit

      open (newunit=unit, file=streams_at//integer_text(stream), access='stream', action='write', status='old')
      do k = 1, size(answers)
         associate (answer => answers(k))
            write (unit) len(answer%fault), answer%fault
            if (answer%fault == '') then
               if (k > 1) answer%reached = reshape([real(wp) ::], [0, 0, 0])
               write (unit) shape(answer%shapes), size(answer%stages), shape(answer%reached), answer%value, answer%off_number, &
                  answer%mac, answer%mode, answer%shapes, answer%reached
               do s = 1, size(answer%stages)
                  associate (stage => answer%stages(s))
                     write (unit) allocated(stage%reduced)
                     if (allocated(stage%reduced)) write (unit) shape(stage%moved), shape(stage%u), stage%n_before, stage%lambda, &
                        stage%u, stage%k, stage%reduced, stage%moved, stage%place
                  end associate
               end do
            end if
         end associate
      end do
      close (unit)
   end subroutine send

   !> Read the answers with the numbers GROUP of ANSWERS from the STREAM of a process that has ended, and close it.
   subroutine receive(stream, group, answers)
      integer, intent(in)              :: stream, group(:)
      type(answer_type), intent(inout) :: answers(:)
      integer :: k, length, n(2), path(3), rows(3), s, status, unit
      logical :: is_there, ok

      open (newunit=unit, file=streams_at//integer_text(stream), access='stream', action='read', status='old')
      do k = 1, size(group)
         associate (answer => answers(group(k)))
            read (unit, iostat=status) length
            answer%fault = 'the run has ended without a report'
            if (status == 0) then
               deallocate (answer%fault)
               allocate (character(length) :: answer%fault)
               read (unit) answer%fault
               if (length == 0) then
                  read (unit) rows, path
                  allocate (answer%value(rows(2)), answer%off_number(rows(2)), answer%mac(rows(2)), answer%mode(rows(2)), &
                            answer%shapes(rows(1), rows(2)), answer%stages(rows(3)), answer%reached(path(1), path(2), path(3)))
                  read (unit) answer%value, answer%off_number, answer%mac, answer%mode, answer%shapes, answer%reached
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
         end associate
      end do
      close (unit)
      call close_file(stream, ok)
   end subroutine receive

end module runs_together
