!> Handles what both programs share on the terminal: command arguments, input files, error messages, progress line.
!! The progress line overwrites itself at most five times a second. It appears only where standard error is a terminal. A log has a
!! line for each step instead: where it is asked for, and elsewhere from the first minute of a run on.
module terminal
   use, intrinsic :: iso_fortran_env, only: error_unit
   use, intrinsic :: iso_c_binding, only: c_int
   use c_library, only: c_isatty, folder_file, kind_of_file, no_file, write_bytes
   use kinds, only: long
   implicit none
   private

   public :: argument_text, next_option, say, complain, complain_of_input, open_line, show_line, log_line, clear_line, empty_line, &
             say_line

   character(*), parameter, public :: version = '0.1.0'
   character(*), parameter, public :: standard_input = '/dev/stdin' !! the path of the file that `-` means

   !> An input file of the command.
   type, public :: input_argument
      character(:), allocatable :: path !! to read; /dev/stdin for `-`
      character(:), allocatable :: name !! as the user wrote it
   end type input_argument

   !> The arguments of the command that have been read.
   type, public :: command_reader
      type(input_argument), allocatable :: files(:)
      integer, private :: n_read = 0
      logical, private :: has_options = .true. ! false behind `--`
   end type command_reader

   integer, parameter :: width = 80 ! columns of the words in the progress line
   real, parameter    :: patience = 60.0 ! [s] until a run that is not on a terminal writes its progress unasked
   logical, protected, public :: line_is_shown = .false. !! the line of progress: standard error is a terminal
   logical :: logs = .false.
   integer(long) :: opened = 0, unasked = 0 ! clock at the start, and when the log begins
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

   !> The next OPTION of the command, '' at its end. For an option among VALUED, VALUE is the argument behind it; IS_MISSING is true
   !! where the command ends there. An argument without a dash, `-` for the standard input, and any argument behind `--` are files.
   subroutine next_option(command, valued, option, value, is_missing)
      type(command_reader), intent(inout)    :: command
      character(*), intent(in)               :: valued(:)
      character(:), allocatable, intent(out) :: option, value
      logical, intent(out)                   :: is_missing
      type(input_argument), allocatable :: more(:)
      integer :: n

      if (.not. allocated(command%files)) allocate (command%files(0))
      value = ''
      is_missing = .false.
      do while (command%n_read < command_argument_count())
         command%n_read = command%n_read + 1
         option = argument_text(command%n_read)
         if (command%has_options .and. option == '--') then
            command%has_options = .false.
         else if (command%has_options .and. option /= '-' .and. index(option, '-') == 1) then
            if (all(option /= valued)) return
            is_missing = command%n_read == command_argument_count()
            command%n_read = command%n_read + 1
            value = argument_text(command%n_read)
            return
         else
            n = size(command%files)
            allocate (more(n + 1)) ! (an array constructor would leak its names in gfortran 12)
            more(:n) = command%files
            more(n + 1)%path = option
            more(n + 1)%name = option
            if (option == '-') more(n + 1)%path = standard_input
            if (option == '-') more(n + 1)%name = 'standard input'
            call move_alloc(more, command%files)
         end if
      end do
      option = ''
   end subroutine next_option

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

   !> Begin the progress line of DECK, unless QUIET; IN_LINES asks for a log in its place.
   subroutine open_line(deck, quiet, in_lines)
      character(*), intent(in) :: deck
      logical, intent(in)      :: quiet, in_lines
      integer(long) :: rate

      line_is_shown = .false.
      if (.not. (quiet .or. in_lines)) line_is_shown = c_isatty(2_c_int) == 1
      logs = in_lines .or. .not. (quiet .or. line_is_shown)
      call system_clock(opened, rate)
      unasked = opened
      if (.not. in_lines) unasked = opened + nint(patience*real(rate), long)
      name = deck
      last = 0
   end subroutine open_line

   !> Show WORDS behind the name of the deck; AT_ONCE: even if the line was just written; IS_LOGGED: also in a log.
   subroutine show_line(words, at_once, is_logged)
      character(*), intent(in) :: words
      logical, intent(in)      :: at_once
      logical, intent(in), optional :: is_logged !! default: no
      integer(long) :: now, rate

      if (present(is_logged)) call log_line(words)
      if (.not. line_is_shown) return
      call system_clock(now, rate)
      if (.not. at_once .and. 5*(now - last) < rate) return
      last = now
      write (error_unit, '(a)', advance='no') achar(13)//name//': '//words//repeat(' ', max(0, width - len(words)))
      flush (error_unit)
   end subroutine show_line

   !> Write WORDS as a line of the log, behind the name of the deck and the seconds so far.
   subroutine log_line(words)
      character(*), intent(in) :: words
      integer(long) :: now, rate

      if (.not. logs) return
      call system_clock(now, rate)
      if (now < unasked) return
      write (error_unit, '(2a, i0, 2a)') name, ', ', (now - opened)/rate, ' s: ', words
      flush (error_unit)
   end subroutine log_line

   !> Clear the line and show no more.
   subroutine clear_line()
      call empty_line()
      line_is_shown = .false.
   end subroutine clear_line

   !> Print a permanent line above the progress line.
   subroutine say_line(words)
      character(*), intent(in) :: words

      call empty_line()
      write (error_unit, '(a)') words
   end subroutine say_line

   !> Clear the progress line; the next words show it again.
   subroutine empty_line()
      if (line_is_shown) write (error_unit, '(a)', advance='no') achar(13)//repeat(' ', len(name) + width + 2)//achar(13)
   end subroutine empty_line

end module terminal
