!> What the command lines of the programs have in common: arguments, version, the standard output, complaints, why a file cannot
!! be read, threads.
module command_tools
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: error_unit
   use c_library, only: write_bytes
   use omp_lib, only: omp_set_num_threads
   implicit none
   private

   public :: argument_text, is_option, name_input, say, complain, why_unreadable, use_threads

   character(*), parameter, public :: version = '0.1.0'
   character(*), parameter, public :: standard_input = '/dev/stdin' !! the path of the file that `-` means

   interface
      subroutine openblas_set_num_threads(n) bind(c, name='openblas_set_num_threads')
         import :: c_int
         integer(c_int), value :: n
      end subroutine openblas_set_num_threads
   end interface

contains

   !> Argument I of the command, whole; empty where there is none.
   function argument_text(i) result(text)
      integer, intent(in)       :: i
      character(:), allocatable :: text
      integer :: length

      length = 0
      if (i <= command_argument_count()) call get_command_argument(i, length=length)
      allocate (character(length) :: text)
      if (length > 0) call get_command_argument(i, text)
   end function argument_text


   !> Whether ARGUMENT is an option and no file: it begins with a dash, is not the `-` of the standard input, and stands before
   !! the `--` that ends the options.
   pure logical function is_option(argument, before_dashes)
      character(*), intent(in) :: argument
      logical, intent(in)      :: before_dashes

      is_option = before_dashes .and. argument /= '-' .and. index(argument, '-') == 1
   end function is_option


   !> The file that ARGUMENT means: NAME as the user is told of it, PATH to read.
   pure subroutine name_input(argument, name, path)
      character(*), intent(in)               :: argument
      character(:), allocatable, intent(out) :: name, path

      name = argument
      path = argument
      if (argument == '-') then
         name = 'standard input'
         path = standard_input
      end if
   end subroutine name_input


   !> Write TEXT and a line end on the standard output; STATUS is 0, or 4 where it cannot be written.
   subroutine say(text, status)
      character(*), intent(in) :: text
      integer, intent(out)     :: status
      logical :: ok

      call write_bytes(1, text//new_line('a'), ok)
      status = merge(0, 4, ok)
   end subroutine say


   !> Say on the standard error what is wrong with the command of PROGRAM.
   subroutine complain(program, message)
      character(*), intent(in) :: program, message

      write (error_unit, '(a)') program//': '//message, program//' --help shows the usage'
   end subroutine complain


   !> Words for a file that cannot be read; EXPECTED is what it should have been, 'a deck'.
   function why_unreadable(path, expected) result(words)
      character(*), intent(in)  :: path, expected
      character(:), allocatable :: words
      logical :: there, is_folder

      is_folder = .false.
      inquire (file=path, exist=there)
      if (path /= '') inquire (file=path//'/.', exist=is_folder)
      if (is_folder) then
         words = 'a directory, expected '//expected
      else if (there .and. path /= '') then
         words = 'cannot be read'
      else
         words = 'no such file'
      end if
   end function why_unreadable


   !> N threads at most, 0: as many as there are cores. BLAS has one in each: one order of additions, the same digits everywhere.
   subroutine use_threads(n)
      integer, intent(in) :: n

      call openblas_set_num_threads(1_c_int)
      if (n > 0) call omp_set_num_threads(n)
   end subroutine use_threads

end module command_tools
