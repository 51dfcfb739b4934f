!> The one line on the terminal that tells where a run is: written over what stood there, five times a second at most. Nothing where
!! standard error is no terminal.
module terminal_line
   use c_library, only: is_terminal
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: long
   implicit none
   private

   public :: open_line, show_line, clear_line, say_line

   integer, parameter :: width = 80 ! of the words
   logical :: shown = .false.
   character(:), allocatable :: name
   integer(long) :: last = 0

contains

   !> A line for DECK, where QUIET does not forbid it.
   subroutine open_line(deck, quiet)
      character(*), intent(in) :: deck
      logical, intent(in)      :: quiet

      shown = .false.
      if (.not. quiet) shown = is_terminal(2)
      name = deck
      last = 0
   end subroutine open_line

   !> WORDS behind the name of the deck; AT_ONCE: also where the line is new.
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

   !> Clear the line; nothing more is shown.
   subroutine clear_line()
      call empty_line()
      shown = .false.
   end subroutine clear_line

   !> A line that stays, above the one that tells where the run is.
   subroutine say_line(words)
      character(*), intent(in) :: words

      call empty_line()
      write (error_unit, '(a)') words
   end subroutine say_line

   subroutine empty_line()
      if (shown) write (error_unit, '(a)', advance='no') achar(13)//repeat(' ', len(name) + width + 2)//achar(13)
   end subroutine empty_line

end module terminal_line
