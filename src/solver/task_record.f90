!> Records the seconds of every task of the solver and what it waits for. tests/bench/schedule.awk predicts from this record what
!! more threads would gain. The environment variable JOINTFEM_TASKS names the file. Tasks are recorded in a run on one thread only,
!! where each is one line in the order of the program: seconds, name, then `<key` for what it waits for, `>key` and `+key` for what
!! it completes, alone or with others.
module task_record
   use kinds, only: wp
   use omp_lib, only: omp_get_max_threads, omp_get_wtime
   use text_tools, only: integer_text
   implicit none
   private

   public :: start_record, record_phase, record_task, task_begins, key

   logical, protected, public :: is_recorded = .false.
   integer :: unit

contains

   !> Open the file, where the user names one.
   subroutine start_record()
      integer :: length, n_threads, status

      n_threads = omp_get_max_threads()
      if (is_recorded .or. n_threads > 1) return
      call get_environment_variable('JOINTFEM_TASKS', length=length, status=status)
      if (status /= 0 .or. length == 0) return
      block
         character(length) :: path
         call get_environment_variable('JOINTFEM_TASKS', path)
         open (newunit=unit, file=path, action='write', status='replace', iostat=status)
      end block
      is_recorded = status == 0
   end subroutine start_record

   !> The tasks that follow belong to phase NAME, and wait for all before.
   subroutine record_phase(name)
      character(*), intent(in) :: name

      if (is_recorded) write (unit, '(2a)') 'phase ', name
   end subroutine record_phase

   !> The time at which a task begins.
   real(wp) function task_begins()
      task_begins = 0.0_wp
      if (is_recorded) task_begins = omp_get_wtime()
   end function task_begins

   !> Record the task NAME that began at BEGAN, with its KEYS.
   subroutine record_task(began, name, keys)
      real(wp), intent(in)     :: began
      character(*), intent(in) :: name, keys

      write (unit, '(es10.3, 3a)') omp_get_wtime() - began, ' ', name, keys
   end subroutine record_task

   !> MARK and the place F, or the tile (I, J) of front F, as a key.
   pure function key(mark, f, i, j)
      character(*), intent(in)      :: mark
      integer, intent(in)           :: f
      integer, intent(in), optional :: i, j
      character(:), allocatable :: key

      key = ' '//mark//integer_text(f)
      if (present(i)) key = key//'.'//integer_text(i)
      if (present(j)) key = key//'.'//integer_text(j)
   end function key

end module task_record
