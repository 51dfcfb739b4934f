!> Handles what both programs share on the terminal: command arguments, input files, error messages, progress line.
!! The progress line overwrites itself at most five times a second. It appears only where standard error is a terminal.
module terminal
   use, intrinsic :: iso_fortran_env, only: error_unit
   use, intrinsic :: iso_c_binding, only: c_int
   use c_library, only: c_isatty, folder_file, kind_of_file, no_file, write_bytes
   use kinds, only: long
   implicit none
   private

   public :: argument_text, is_option, set_input, say, complain, complain_of_input, open_line, show_line, clear_line, say_line

   character(*), parameter, public :: version = '0.1.0'
   character(*), parameter, public :: standard_input = '/dev/stdin' !! the path of the file that `-` means

   !> An input file of the command.
   type, public :: input_argument
      character(:), allocatable :: path !! to read; /dev/stdin for `-`
      character(:), allocatable :: name !! as the user wrote it
   end type input_argument

   integer, parameter :: width = 80 ! columns of the words in the progress line
   logical :: shown = .false.
   character(:), allocatable :: name
   integer(long) :: last = 0

contains

   !> Argument I of the command in full length; empty where there is none.
   function argument_text(i) result(text)
      integer, intent(in)       :: i
      character(:), allocatable :: text
      integer :: length

      length = 0
      if (i <= command_argument_count()) call get_command_argument(i, length=length)
      allocate (character(length) :: text)
      if (length > 0) call get_command_argument(i, text)
   end function argument_text

   !> Whether ARGUMENT is an option: it begins with a dash, is not the `-` of the standard input, and stands before the `--` that
   !! ends the options.
   pure logical function is_option(argument, before_dashes)
      character(*), intent(in) :: argument
      logical, intent(in)      :: before_dashes

      is_option = before_dashes .and. argument /= '-' .and. index(argument, '-') == 1
   end function is_option

   !> Set INPUT to the file that ARGUMENT names.
   pure subroutine set_input(input, argument)
      class(input_argument), intent(inout) :: input
      character(*), intent(in)             :: argument

      input%path = argument
      input%name = argument
      if (argument /= '-') return
      input%path = standard_input
      input%name = 'standard input'
   end subroutine set_input

   !> Write TEXT and a line end on the standard output. STATUS is 0, or 4 with a message where the output cannot be written.
   subroutine say(text, status)
      character(*), intent(in) :: text
      integer, intent(out)     :: status
      logical :: ok

      call write_bytes(1, text//new_line('a'), ok)
      status = merge(0, 4, ok)
      if (.not. ok) write (error_unit, '(a)') 'the standard output cannot be written'
   end subroutine say

   !> Report an error in the command of PROGRAM on the standard error.
   subroutine complain(program, message)
      character(*), intent(in) :: program, message

      write (error_unit, '(a)') program//': '//message, program//' --help shows the usage'
   end subroutine complain

   !> Report on the standard error why INPUT cannot be read; EXPECTED is the expected content, 'a deck'.
   subroutine complain_of_input(input, expected)
      class(input_argument), intent(in) :: input
      character(*), intent(in)          :: expected
      character(:), allocatable :: words

      select case (kind_of_file(input%path))
      case (no_file)
         words = 'no such file'
      case (folder_file)
         words = 'a directory, expected '//expected
      case default
         words = 'cannot be read'
      end select
      write (error_unit, '(3a)') input%name, ': ', words
   end subroutine complain_of_input

   !> Begin the progress line of DECK, unless QUIET.
   subroutine open_line(deck, quiet)
      character(*), intent(in) :: deck
      logical, intent(in)      :: quiet

      shown = .false.
      if (.not. quiet) shown = c_isatty(2_c_int) == 1
      name = deck
      last = 0
   end subroutine open_line

   !> Show WORDS behind the name of the deck; AT_ONCE: even if the line was just written.
   subroutine show_line(words, at_once)
      character(*), intent(in) :: words
      logical, intent(in)      :: at_once
      integer(long) :: now, rate

      if (.not. shown) return
      call system_clock(now, rate)
      if (.not. at_once .and. 5*(now - last) < rate) return
      last = now
      write (error_unit, '(a)', advance='no') achar(13)//name//': '//words//repeat(' ', max(0, width - len(words)))
      flush (error_unit)
   end subroutine show_line

   !> Clear the line and show no more.
   subroutine clear_line()
      call empty_line()
      shown = .false.
   end subroutine clear_line

   !> Print a permanent line above the progress line.
   subroutine say_line(words)
      character(*), intent(in) :: words

      call empty_line()
      write (error_unit, '(a)') words
   end subroutine say_line

   subroutine empty_line()
      if (shown) write (error_unit, '(a)', advance='no') achar(13)//repeat(' ', len(name) + width + 2)//achar(13)
   end subroutine empty_line

end module terminal
