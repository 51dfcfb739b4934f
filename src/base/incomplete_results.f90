!> Which result files are being written, so that none stays behind where the program ends in the midst of it. The last resort is
!! for an allocation that fails where nobody looks: it ends the program through the run-time library, with exit status 1 and words
!! of its own; or, where the compiler allocates what is assigned and does not look either, it uses the address of nothing. Here
!! both become a message of the program and the status of what cannot be solved.
module incomplete_results
   use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_funloc, c_funptr, c_int, c_intptr_t, c_null_char, &
                                          c_null_ptr, c_ptr
   use c_library, only: has_ended, remove_terminated, write_bytes
   implicit none
   private

   public :: note_incomplete, remove_incomplete, all_complete, watch_allocations

   character(*), parameter, public :: suffix = '.part' !! that a file has until it is complete

   character(:), allocatable :: names ! one after the other, each with a null character at its end

   integer(c_int), parameter :: status_of_library = 1, status_unsolved = 3
   integer(c_int), parameter :: sigsegv = 11, enomem = 12 ! of Linux

   interface
      integer(c_int) function c_on_exit(routine, argument) bind(c, name='on_exit')
         import :: c_funptr, c_int, c_ptr
         type(c_funptr), value :: routine
         type(c_ptr), value    :: argument
      end function c_on_exit

      integer(c_intptr_t) function c_signal(signal, handler) bind(c, name='signal')
         import :: c_funptr, c_int, c_intptr_t
         integer(c_int), value :: signal
         type(c_funptr), value :: handler
      end function c_signal

      type(c_ptr) function c_errno_place() bind(c, name='__errno_location')
         import :: c_ptr
      end function c_errno_place

      subroutine c_exit_at_once(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_at_once
   end interface

contains

   !> The file PATH is about to be written: neither it nor PATH.part is a result yet.
   subroutine note_incomplete(path)
      character(*), intent(in) :: path   !! empty: the standard output, nothing to note

      if (path == '') return
      if (.not. allocated(names)) names = ''
      names = names//path//c_null_char//path//suffix//c_null_char
   end subroutine note_incomplete

   !> All files that have been noted are results now, or have been given up in an orderly way.
   subroutine all_complete()
      if (allocated(names)) deallocate (names)
   end subroutine all_complete

   !> Remove the files that have been noted, as far as they are there. Takes no memory.
   subroutine remove_incomplete()
      integer :: first, length

      if (.not. allocated(names)) return
      first = 1
      do while (first <= len(names))
         length = index(names(first:), c_null_char)
         call remove_terminated(names(first:first + length - 1))
         first = first + length
      end do
   end subroutine remove_incomplete

   !> Watch allocations from now on. Where glibc does not do it the status stays 1.
   subroutine watch_allocations()
      integer(c_int)      :: status
      integer(c_intptr_t) :: before

      status = c_on_exit(c_funloc(end_without_memory), c_null_ptr)
      before = c_signal(sigsegv, c_funloc(end_at_no_address))
   end subroutine watch_allocations

   !> Called by the kernel where an address is used at which nothing is. After an allocation that failed, the last that the C library
   !! tells this thread, that is why; otherwise the program ends as it would have done, at the same place.
   subroutine end_at_no_address(signal) bind(c)
      integer(c_int), value   :: signal
      integer(c_int), pointer :: error
      integer(c_intptr_t)     :: before

      call c_f_pointer(c_errno_place(), error)
      if (error == enomem) call end_without_memory(status_of_library, c_null_ptr)
      before = c_signal(signal, transfer(0_c_intptr_t, c_funloc(end_at_no_address))) ! 0: SIG_DFL
   end subroutine end_at_no_address

   !> Called by the C library when the program ends with STATUS.
   subroutine end_without_memory(status, argument) bind(c)
      integer(c_int), value :: status
      type(c_ptr), value    :: argument !! null
      logical :: ok

      if (has_ended .or. c_associated(argument)) return
      call remove_incomplete()
      if (status /= status_of_library) return
      call write_bytes(2, 'the memory of the machine, or what is allowed of it, does not suffice; no results'// &
                       new_line('a'), ok)
      call c_exit_at_once(status_unsolved)
   end subroutine end_without_memory

end module incomplete_results
