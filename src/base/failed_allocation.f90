!> The last resort: an allocation that fails where nobody looks ends the program through the run-time library, with exit status 1
!! and words of its own. Here that becomes a message of the program and the status of what cannot be solved, and no result is
!! left half written.
module failed_allocation
   use, intrinsic :: iso_c_binding, only: c_associated, c_funloc, c_funptr, c_int, c_null_ptr, c_ptr
   use c_library, only: has_ended, write_bytes
   use incomplete_results, only: remove_incomplete
   implicit none
   private

   public :: watch_allocations

   integer(c_int), parameter :: status_of_library = 1, status_unsolved = 3

   interface
      integer(c_int) function c_on_exit(routine, argument) bind(c, name='on_exit')
         import :: c_funptr, c_int, c_ptr
         type(c_funptr), value :: routine
         type(c_ptr), value    :: argument
      end function c_on_exit

      subroutine c_exit_at_once(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit_at_once
   end interface

contains

   !> From now on. Where glibc does not do it the status stays 1.
   subroutine watch_allocations()
      integer(c_int) :: status

      status = c_on_exit(c_funloc(end_without_memory), c_null_ptr)
   end subroutine watch_allocations


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

end module failed_allocation
