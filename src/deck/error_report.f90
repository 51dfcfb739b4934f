!> Errors of a deck, or of a file of test data, as a person reads them: where, the line itself, a mark under the columns,
!! what was expected.
module error_report
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use id_table, only: sorted_order
   use text_tools, only: integer_text, plural
   implicit none
   private

   public :: print_errors

   integer, parameter :: most_printed = 200
   integer, parameter :: widest = 100 ! columns of a deck line that are shown

contains

   !> Print all errors on UNIT in the order of the lines they are about.
   subroutine print_errors(unit, kind, outcome, text, errors)
      integer, intent(in)               :: unit
      character(*), intent(in)          :: kind    !! 'DECK', what the errors are of
      character(*), intent(in)          :: outcome !! 'nothing solved', what follows from them
      type(deck_text_type), intent(in)  :: text
      type(deck_error_list), intent(in) :: errors
      integer, allocatable :: order(:)
      integer :: k

      call sorted_order(errors%items(:errors%n)%line, order)
      do k = 1, min(errors%n, most_printed)
         associate (item => errors%items(order(k)))
            write (unit, '(5a, 3x, a)') kind, ' ERROR ', integer_text(k), ' OF ', integer_text(errors%n), text%place(item%line)
            if (item%line > 0) then
               write (unit, '(3x, a)') shown(text%line(item%line))
               if (item%first > 0) write (unit, '(3x, a)') mark(text%line(item%line), item%first, item%last)
            end if
            write (unit, '(3x, a, /)') item%message
         end associate
      end do
      if (errors%n > most_printed) write (unit, '(3a, /)') 'and ', plural(errors%n - most_printed, 'more error'), &
         ', not printed'
      write (unit, '(5a)') text%place(0), ': ', plural(errors%n, 'error'), ', ', outcome
   end subroutine print_errors

   !> LINE as it may be printed: cut where it is very long, control characters as '?'.
   pure function shown(line) result(words)
      character(*), intent(in)  :: line
      character(:), allocatable :: words
      integer :: i

      words = line(:min(len(line), widest))
      do i = 1, len(words)
         if (iachar(words(i:i)) < 32 .or. iachar(words(i:i)) == 127) words(i:i) = '?'
      end do
      if (len(line) > widest) words = words//' ...'
      words = trim(words)
   end function shown

   !> Carets under columns FIRST to LAST of LINE, drawn in to what is not blank there.
   pure function mark(line, first, last) result(words)
      character(*), intent(in)  :: line
      integer, intent(in)       :: first, last
      character(:), allocatable :: words
      integer :: from, to

      from = min(first, widest + 1)
      to = min(max(first, last), widest + 4)
      if (from <= len(line)) then
         if (line(from:min(to, len(line))) /= '') then
            to = from - 1 + len_trim(line(from:min(to, len(line))))
            from = from - 1 + verify(line(from:to), ' ')
         end if
      end if
      words = repeat(' ', from - 1)//repeat('^', to - from + 1)
   end function mark

end module error_report
