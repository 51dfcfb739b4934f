!> Result files that appear under their names only when they are complete: written as NAME.part, renamed at the end.
!! With no name the lines go to the standard output, at the end too.
module output_file
   use, intrinsic :: iso_fortran_env, only: output_unit
   use c_library, only: remove_file, rename_file
   implicit none
   private

   type, public :: output_file_type
      private
      character(:), allocatable :: path          ! empty: standard output
      integer :: unit   = 0
      integer :: status = 0                      ! of the first write that failed
      logical, public :: is_open = .false.
   contains
      procedure :: start
      procedure :: put
      procedure :: failed
      procedure :: finish
      procedure :: discard
   end type output_file_type

   character(*), parameter :: suffix = '.part'
   integer, parameter :: longest_line = 1024

contains

   !> Open the file that will be PATH (empty: standard output).
   subroutine start(self, path)
      class(output_file_type), intent(inout) :: self
      character(*), intent(in)               :: path

      self%path = path
      if (path == '') then
         open (newunit=self%unit, status='scratch', action='readwrite', recl=longest_line, iostat=self%status)
      else
         open (newunit=self%unit, file=path//suffix, status='replace', action='write', recl=longest_line, &
               iostat=self%status)
      end if
      self%is_open = self%status == 0
   end subroutine start


   !> Write one line, without the blanks at its end.
   subroutine put(self, line)
      class(output_file_type), intent(inout) :: self
      character(*), intent(in)               :: line

      if (self%status == 0) write (self%unit, '(a)', iostat=self%status) trim(line)
   end subroutine put


   !> Whether anything could not be written.
   pure logical function failed(self)
      class(output_file_type), intent(in) :: self

      failed = self%status /= 0
   end function failed


   !> Close the file and give it its name. OK is false, and no file of that name is left by us, where that failed.
   subroutine finish(self, ok)
      class(output_file_type), intent(inout) :: self
      logical, intent(out)                   :: ok
      character(longest_line) :: line
      integer :: status

      ok = .false.
      if (.not. self%is_open) return
      if (self%status == 0) flush (self%unit, iostat=self%status)
      if (self%status /= 0) then
         call self%discard()
         return
      end if
      if (self%path /= '') then
         close (self%unit, iostat=self%status)
         self%is_open = .false.
         if (self%status == 0) call rename_file(self%path//suffix, self%path, ok)
         if (.not. ok) call remove_file(self%path//suffix)
         return
      end if
      rewind (self%unit)
      do
         read (self%unit, '(a)', iostat=status) line
         if (status /= 0) exit
         write (output_unit, '(a)', iostat=self%status) trim(line)
         if (self%status /= 0) exit
      end do
      if (self%status == 0) flush (output_unit, iostat=self%status)
      close (self%unit)
      self%is_open = .false.
      ok = self%status == 0
   end subroutine finish


   !> Leave nothing behind.
   subroutine discard(self)
      class(output_file_type), intent(inout) :: self
      integer :: status

      if (.not. self%is_open) return
      close (self%unit, iostat=status)
      self%is_open = .false.
      if (self%path /= '') call remove_file(self%path//suffix)
   end subroutine discard

end module output_file
