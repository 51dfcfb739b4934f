!> Which result files are being written, so that none stays behind where the program ends in the midst of it.
module incomplete_results
   use, intrinsic :: iso_c_binding, only: c_null_char
   use c_library, only: remove_terminated
   implicit none
   private

   public :: note_incomplete, remove_incomplete, all_complete

   character(*), parameter, public :: suffix = '.part' !! that a file has until it is complete

   character(:), allocatable :: names ! one after the other, each with a null character at its end

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

end module incomplete_results
