!> Prints errors of decks and test data: the place, the line, a mark under its columns, and what was expected.
module error_report
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use lists, only: sorted_order
   use text_tools, only: integer_text, plural
   implicit none
   private

   public :: print_errors

   integer, parameter :: most_printed = 200
   integer, parameter :: most_of_kind = 10 ! printed errors whose messages differ only in numbers and quoted text
   character(*), parameter :: no_card = 'is not a card of' ! such an error is printed once for each name
   integer, parameter :: widest = 100 ! printed columns of a deck line

   type :: kind_type
      character(:), allocatable :: words   ! common part of its messages
      integer :: n = 0                     ! errors
      integer :: most = most_of_kind       ! largest number printed
      integer :: printed = 0               ! so far
      integer :: last = 0                  ! number of the error printed last
   end type kind_type

contains

   !> Print the errors on UNIT in the order of their lines; at most ten of one kind, and one for each unknown card.
   subroutine print_errors(unit, kind, outcome, text, errors)
      integer, intent(in)               :: unit
      character(*), intent(in)          :: kind    !! what the errors are in: 'DECK'
      character(*), intent(in)          :: outcome !! the consequence: 'nothing solved'
      type(deck_text_type), intent(in)  :: text
      type(deck_error_list), intent(in) :: errors
      type(kind_type), allocatable :: kinds(:)
      integer, allocatable :: order(:), kind_of(:)
      integer :: i, k, printed

      call sorted_order(errors%items(:errors%n)%line, order)
      call sort_into_kinds(errors, order, kinds, kind_of)
      printed = 0
      do k = 1, errors%n
         associate (item => errors%items(order(k)), this => kinds(kind_of(k)))
            this%n = this%n + 1
            if (this%n > this%most .or. printed == most_printed) cycle
            printed = printed + 1
            this%printed = this%printed + 1
            this%last = printed
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
         associate (this => kinds(i))
            if (this%printed < this%most .or. this%n == this%most) cycle
            write (unit, '(4a, /)') 'and ', plural(this%n - this%most, 'more error'), ', not printed, of the kind of ERROR ', &
               integer_text(this%last)
            printed = printed + this%n - this%most
         end associate
      end do
      if (errors%n > printed) write (unit, '(3a, /)') 'and ', plural(errors%n - printed, 'more error'), ', not printed'
      write (unit, '(5a)') text%place(0), ': ', plural(errors%n, 'error'), ', ', outcome
   end subroutine print_errors

   !> The kinds of ERRORS, and the kind of each error in this ORDER: errors of a kind have the same message without numbers, blanks and
   !! quoted text. Unknown cards are of one kind where the whole message is the same.
   subroutine sort_into_kinds(errors, order, kinds, kind_of)
      type(deck_error_list), intent(in)         :: errors
      integer, intent(in)                       :: order(:)
      type(kind_type), allocatable, intent(out) :: kinds(:)
      integer, allocatable, intent(out)         :: kind_of(:)
      character(:), allocatable :: words
      logical :: is_card, quoted
      integer :: i, k, n

      allocate (kinds(size(order)), kind_of(size(order)))
      n = 0
      do k = 1, size(order)
         associate (message => errors%items(order(k))%message)
            is_card = index(message, no_card) > 0
            quoted = .false.
            words = ''
            do i = 1, len(message)
               if (message(i:i) == '''') quoted = .not. quoted
               if (is_card .or. .not. (quoted .or. scan(message(i:i), ' 0123456789.+-') == 1)) words = words//message(i:i)
            end do
         end associate
         do i = 1, n
            if (kinds(i)%words == words) exit
         end do
         kind_of(k) = i
         if (i <= n) cycle
         n = n + 1
         kinds(n)%words = words
         if (is_card) kinds(n)%most = 1
      end do
      kinds = kinds(:n)
   end subroutine sort_into_kinds

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
