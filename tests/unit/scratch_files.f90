!> Files that tests write and remove.
module scratch_files
   implicit none
   private

   public :: scratch, put, there, n_parts

contains

   !> The path of a file of that name in the folder of this run, UNIT_SCRATCH, which no other run has; without it in the folder of
   !! the test program.
   function scratch(name) result(path)
      character(*), intent(in)  :: name
      character(:), allocatable :: path
      character(1000) :: folder
      integer :: length

      call get_environment_variable('UNIT_SCRATCH', folder, length)
      if (length > 0) then
         path = trim(folder)//'/'//name
      else
         call get_command_argument(0, folder)
         path = folder(:index(folder, '/', back=.true.))//name
      end if
   end function scratch

   !> A file of that name with these BYTES.
   subroutine put(name, bytes)
      character(*), intent(in) :: name, bytes
      integer :: unit

      open (newunit=unit, file=scratch(name), access='stream', form='unformatted', status='replace', action='write')
      write (unit) bytes
      close (unit)
   end subroutine put

   !> Whether there is a file of that PATH.
   logical function there(path)
      character(*), intent(in) :: path

      inquire (file=path, exist=there)
   end function there

   !> How many files there are that are to be PATH once they are complete.
   integer function n_parts(path)
      character(*), intent(in) :: path

      call execute_command_line('exit $(ls "'//path//'".??????.part 2>/dev/null | wc -l)', exitstat=n_parts)
   end function n_parts

end module scratch_files
