!> Prints errors of decks and test data: the place, the line, a mark under its columns, and what was expected.
module error_report
   use deck_errors, only: deck_error_list, error_kind, sort_into_kinds
   use deck_text, only: deck_text_type
   use lists, only: sorted_order
   use text_tools, only: integer_text, plural
   implicit none
   private

   public :: print_errors

   integer, parameter :: most_printed = 200
   integer, parameter :: widest = 100 ! printed columns of a deck line

contains

   !> Print the errors on UNIT in the order of their lines; at most ten of one kind, and one for each unknown card.
   subroutine print_errors(unit, kind, outcome, text, errors)
      integer, intent(in)               :: unit
      character(*), intent(in)          :: kind    !! what the errors are in: 'DECK'
      character(*), intent(in)          :: outcome !! the consequence: 'nothing solved'
      type(deck_text_type), intent(in)  :: text
      type(deck_error_list), intent(in) :: errors
      type(error_kind), allocatable :: kinds(:)
      integer, allocatable :: order(:), kind_of(:)
      integer :: i, k, printed

      call sorted_order(errors%items(:errors%n)%line, order)
      call sort_into_kinds(errors, order, kinds, kind_of)
      printed = 0
      do k = 1, errors%n
         associate (item => errors%items(order(k)), group => kinds(kind_of(k)))
            group%n = group%n + 1
            if (group%n > group%most .or. printed == most_printed) cycle
            printed = printed + 1
            group%printed = group%printed + 1
            group%last = printed
            write (unit, '(5a, 3x, a)') kind, ' ERROR ', integer_text(printed), ' OF ', integer_text(errors%n), &
               text%place(item%line)
            if (item%line > 0) then
               write (unit, '(3x, a)') shown(text%line(item%line))
               if (item%first > 0) write (unit, '(3x, a)') mark(text%line(item%line), item%first, item%last)
            end if
            write (unit, '(3x, a, /)') item%message
         end associate
      end do
      do i = 1, size(kinds)
         associate (group => kinds(i))
            if (group%printed < group%most .or. group%n == group%most) cycle
            write (unit, '(4a, /)') 'and ', plural(group%n - group%most, 'more error'), ', not printed, of the kind of ERROR ', &
               integer_text(group%last)
            printed = printed + group%n - group%most
         end associate
      end do
      if (errors%n > printed) write (unit, '(3a, /)') 'and ', plural(errors%n - printed, 'more error'), ', not printed'
      write (unit, '(5a)') text%place(0), ': ', plural(errors%n, 'error'), ', ', outcome
   end subroutine print_errors

   !> LINE for print: a long line is cut, control characters become '?'.
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

   !> Carets under columns FIRST to LAST of LINE, without the blanks at both ends.
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
