!> Removes incomplete result files where the program fails, is interrupted or runs out of memory; the part of them that belongs to
!! finished stages can be kept.
!! An allocation that fails unchecked is the last case. The run-time library then ends the program with exit status 1 and its own
!! message. Where the compiler allocates on assignment without a check, the program uses a null address instead. Both become a message
!! of the program here, with the exit status of a problem that cannot be solved.
!!
!! A file is written as NAME.abcdef.part with letters of its own, so that two runs in one folder do not collide. The complete file
!! gets its final name and replaces any file or link of that name.
module incomplete_results
   use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_funloc, c_funptr, c_int, c_null_char, c_null_funptr, &
                                          c_null_ptr, c_ptr
   use c_library, only: append_bytes, at_signals, block_file, c_raise, c_rename, c_truncate, c_unlink, create_unique, device_file, &
                        folder_file, has_ended, kind_of_file, no_file, pipe_file, regular_file, remove_file, rename_file, &
                        write_bytes
   use kinds, only: long
   implicit none
   private

   public :: create_part, name_part, remove_incomplete, give_up_parts, remove_old, all_complete, watch_ends, what_is_in_the_way, &
             watch_interrupts, say_at_interrupts, keep_at_ends, forget_kept, keep_finished, hold_interrupts, interrupt_so_far

   character(*), parameter, public :: suffix = '.part' !! of an incomplete file
   integer, parameter :: replaceable(2) = [no_file, regular_file] ! a result may take the place of these; links are followed

   character(:), allocatable :: names     ! each ends with a null character
   character(:), allocatable :: in_the_way ! what blocks the name of the first file that could not be created

   character(:), allocatable :: last_words ! message at an interrupt, with its end of line
   character(:), allocatable :: kept_words ! likewise, of the finished stages

   !> A file that is kept where the run is interrupted or runs out of memory: its first LENGTH bytes, and TAIL behind them.
   type :: kept_file
      character(:), allocatable :: part, path, tail ! PART and PATH end with a null character
      integer(long) :: length = 0
   end type kept_file
   type(kept_file), allocatable :: kept(:)
   logical :: is_kept = .false.            ! all of KEPT have their names

   logical, volatile        :: is_changing = .false. ! NAMES is about to change
   integer(c_int), volatile :: interrupt = 0         ! signal that came during the change
   logical, volatile        :: is_held = .false.     ! an interrupt waits until other work is done
   logical, volatile        :: is_ending = .false.   ! a thread ends the run; a signal that comes twice may reach two

   integer(c_int), parameter :: status_of_library = 1, status_unsolved = 3
   integer(c_int), parameter :: sigsegv = 11, enomem = 12 ! of Linux

   interface
      integer(c_int) function c_on_exit(routine, argument) bind(c, name='on_exit')
         import :: c_funptr, c_int, c_ptr
         type(c_funptr), value :: routine
         type(c_ptr), value    :: argument
      end function c_on_exit

      type(c_ptr) function c_errno_place() bind(c, name='__errno_location')
         import :: c_ptr
      end function c_errno_place

      subroutine c_exit_at_once(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_at_once
   end interface

contains

   !> An interrupt waits while it is HELD.
   subroutine hold_interrupts(held)
      logical, intent(in) :: held

      is_held = held
      if (.not. held) call end_of_change()
   end subroutine hold_interrupts

   !> The signal that waits, 0: none.
   integer function interrupt_so_far()
      interrupt_so_far = int(interrupt)
   end function interrupt_so_far

   !> Set the WORDS that an interrupt prints; empty: none.
   subroutine say_at_interrupts(words)
      character(*), intent(in) :: words

      is_changing = .true.
      last_words = words//new_line('a')
      call end_of_change()
   end subroutine say_at_interrupts

   !> Keep the first LENGTH bytes of PART, with TAIL behind them, as PATH where the run is interrupted or runs out of memory; an
   !! interrupt says WORDS.
   subroutine keep_at_ends(part, path, length, tail, words)
      character(*), intent(in)  :: part, path, tail, words
      integer(long), intent(in) :: length
      type(kept_file), allocatable :: more(:)
      integer :: k

      is_changing = .true.
      if (.not. allocated(kept)) allocate (kept(0))
      allocate (more(size(kept) + 1))
      do k = 1, size(kept)
         more(k) = kept(k)
      end do
      associate (last => more(size(more))) ! a constructor with texts put together here would lose their memory
         last%part = part//c_null_char
         last%path = path//c_null_char
         last%tail = tail
         last%length = length
      end associate
      call move_alloc(more, kept)
      kept_words = words//new_line('a')
      call end_of_change()
   end subroutine keep_at_ends

   !> Keep nothing of what KEEP_AT_ENDS has named.
   subroutine forget_kept()
      is_changing = .true.
      if (allocated(kept)) deallocate (kept)
      call end_of_change()
   end subroutine forget_kept

   !> Give the kept files their names. Needs no memory.
   subroutine keep_finished()
      integer :: k
      integer(c_int) :: status
      logical :: ok

      is_kept = .false.
      if (.not. allocated(kept)) return
      do k = 1, size(kept)
         ok = c_truncate(kept(k)%part, kept(k)%length) == 0
         if (ok .and. len(kept(k)%tail) > 0) call append_bytes(kept(k)%part, kept(k)%tail, ok)
         if (ok) status = c_rename(kept(k)%part, kept(k)%path)
         if (.not. ok .or. status /= 0) return ! the first is the mark ENDED EARLY: no file is kept without it
      end do
      is_kept = .true.
   end subroutine keep_finished

   !> Create the file PART, which will become PATH. DESCRIPTOR is negative on failure, and where PATH exists and is a folder, a pipe
   !! or a device, which cannot be replaced.
   subroutine create_part(path, part, descriptor)
      character(*), intent(in)               :: path
      character(:), allocatable, intent(out) :: part
      integer, intent(out)                   :: descriptor
      character(14) :: words
      integer :: kind

      part = ''
      descriptor = -1
      kind = kind_of_file(path)
      if (all(kind /= replaceable)) then
         if (allocated(in_the_way)) return
         words = 'something else'
         if (kind == folder_file) words = 'a folder'
         if (kind == pipe_file) words = 'a pipe'
         if (kind == device_file .or. kind == block_file) words = 'a device'
         in_the_way = path//' is '//trim(words)//' and no file'
         return
      end if
      is_changing = .true.
      if (interrupt == 0 .or. is_held) call create_unique(path, suffix, part, descriptor) ! else another thread is removing the files
      if (descriptor >= 0) call note(part)
      call end_of_change()
   end subroutine create_part

   !> Rename the complete PART to PATH. An interrupt still removes PATH until all files have their names, unless it STAYS. OK is false
   !! where the renaming failed; PART is then removed.
   subroutine name_part(part, path, ok, stays)
      character(*), intent(in)      :: part, path
      logical, intent(out)          :: ok
      logical, intent(in), optional :: stays !! default: false
      logical :: is_noted

      is_noted = .true.
      if (present(stays)) is_noted = .not. stays
      is_changing = .true.
      call rename_file(part, path, ok)
      if (ok .and. is_noted) call note(path)
      if (.not. ok) call remove_file(part)
      call end_of_change()
   end subroutine name_part

   !> Add PATH to the files that are removed where a run is given up.
   subroutine note(path)
      character(*), intent(in) :: path

      if (.not. allocated(names)) names = ''
      names = names//path//c_null_char
   end subroutine note

   !> Handle a signal that came during the change.
   subroutine end_of_change()
      is_changing = .false.
      if (interrupt /= 0 .and. .not. is_held) call end_by_interrupt(interrupt)
   end subroutine end_of_change

   !> Why the first file could not be created; empty where its name was free.
   function what_is_in_the_way() result(words)
      character(:), allocatable :: words

      words = ''
      if (allocated(in_the_way)) words = in_the_way
   end function what_is_in_the_way

   !> Remove the result PATH of an earlier run if it exists, but no folder, pipe or device of that name.
   subroutine remove_old(path)
      character(*), intent(in) :: path

      if (any(kind_of_file(path) == replaceable)) call remove_file(path)
   end subroutine remove_old

   !> Remove the noted files and deallocate their list.
   subroutine give_up_parts()
      is_changing = .true.
      call remove_incomplete()
      if (allocated(names)) deallocate (names)
      if (allocated(kept)) deallocate (kept)
      call end_of_change()
   end subroutine give_up_parts

   !> Forget the noted files: all are results now, or there are none yet.
   subroutine all_complete()
      is_changing = .true.
      if (allocated(names)) deallocate (names)
      if (allocated(in_the_way)) deallocate (in_the_way)
      if (allocated(kept)) deallocate (kept)
      call end_of_change()
   end subroutine all_complete

   !> Remove the noted files that exist. Needs no memory.
   subroutine remove_incomplete()
      integer :: first, length
      integer(c_int) :: status

      if (.not. allocated(names)) return
      first = 1
      do while (first <= len(names))
         length = index(names(first:), c_null_char)
         status = c_unlink(names(first:first + length - 1))
         first = first + length
         if (status /= 0) cycle ! there is no such file
      end do
   end subroutine remove_incomplete

   !> Watch allocations and interrupts from now on. Where the C library cannot watch allocations the exit status stays 1.
   subroutine watch_ends()
      integer(c_int) :: status

      status = c_on_exit(c_funloc(end_without_memory), c_null_ptr)
      call watch_interrupts()
   end subroutine watch_ends

   !> Watch interrupts alone: once more where a library has set handlers of its own since, as that of MPI does.
   subroutine watch_interrupts()
      call at_signals([sigsegv], c_funloc(end_at_no_address))
      call at_signals([1, 2, 15], c_funloc(end_by_interrupt)) ! SIGHUP, SIGINT, SIGTERM of Linux
   end subroutine watch_interrupts

   !> Called when SIGNAL interrupts the program. The program ends as without a handler, but leaves no incomplete file. While the list
   !! of files changes the end has to wait.
   subroutine end_by_interrupt(signal) bind(c)
      integer(c_int), value :: signal
      integer(c_int) :: status
      logical :: ok

      interrupt = signal
      if (is_changing .or. is_held .or. is_ending) return
      is_ending = .true.
      call keep_finished()
      call remove_incomplete()
      if (allocated(last_words)) then
         if (is_kept .or. len(last_words) > 1) call write_bytes(2, new_line('a'), ok) ! behind the progress line
         if (len(last_words) > 1) call write_bytes(2, last_words, ok)
      end if
      if (is_kept) call write_bytes(2, kept_words, ok)
      call at_signals([signal], c_null_funptr) ! SIG_DFL
      status = c_raise(signal)
      if (status /= 0) return ! the signal was not delivered
   end subroutine end_by_interrupt

   !> Called by the kernel at an access to an invalid address. The cause is a failed allocation where that is the last error that the C
   !! library has reported to this thread. Otherwise the program ends at the same place as without a handler.
   recursive subroutine end_at_no_address(signal) bind(c)
      integer(c_int), value   :: signal
      integer(c_int), pointer :: error

      call c_f_pointer(c_errno_place(), error)
      if (error == enomem) call end_without_memory(status_of_library, c_null_ptr)
      call at_signals([signal], c_null_funptr)
   end subroutine end_at_no_address

   !> Called by the C library when the program ends with STATUS.
   subroutine end_without_memory(status, argument) bind(c)
      integer(c_int), value :: status
      type(c_ptr), value    :: argument !! null
      logical :: ok

      if (has_ended .or. c_associated(argument)) return
      if (status == status_of_library) call keep_finished()
      call remove_incomplete()
      if (status /= status_of_library) return
      if (is_kept) then
         call write_bytes(2, 'the memory of the machine, or the permitted part of it, does not suffice'//new_line('a'), ok)
         call write_bytes(2, kept_words, ok)
      else
         call write_bytes(2, 'the memory of the machine, or the permitted part of it, does not suffice; no results'// &
                          new_line('a'), ok)
      end if
      call c_exit_at_once(status_unsolved)
   end subroutine end_without_memory

end module incomplete_results
