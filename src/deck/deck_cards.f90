!> Cards put together from their lines: what stands in field 1, the first line of a card and its continuations.
module deck_cards
   use card_lines, only: card_type, cut_line
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use kinds, only: long
   use text_tools, only: upper
   implicit none
   private

   public :: read_card, add_field_error, card_name, is_continuation, check_first_field

   integer, parameter :: blank = iachar(' '), asterisk = iachar('*') ! as codes: characters are compared by a call of the library

contains

   !> Read the card that begins on line CURSOR of TEXT (a line that is no continuation) with all its continuations;
   !! CURSOR is left on the line behind it. Faults of form go to ERRORS.
   subroutine read_card(text, cursor, card, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(inout)               :: cursor
      type(card_type), intent(inout)       :: card
      type(deck_error_list), intent(inout) :: errors
      integer(long) :: first, last
      integer :: comma, errors_before, file

      call card%start(cursor)
      call text%find(cursor, file, first, last, comma)
      card%name = card_name(text%files(file)%bytes(first:last), comma)
      errors_before = errors%n
      call check_first_field(text%files(file)%bytes(first:last), comma, cursor, errors)
      if (errors%n > errors_before) card%name = '' ! not to be understood
      do
         call cut_line(text%files(file)%bytes(first:last), comma, cursor, text%has_tabs, card, errors)
         cursor = cursor + 1
         do while (cursor <= text%n)
            call text%find(cursor, file, first, last, comma)
            if (last >= first) exit
            cursor = cursor + 1
         end do
         if (cursor > text%n) exit
         if (.not. is_continuation(text%files(file)%bytes(first:last), comma)) exit
         call check_marker(text%files(file)%bytes(first:last), comma, cursor, card%marker, errors)
      end do
      do while (card%n > 0)
         if (card%fields(card%n)%length > 0) exit
         card%n = card%n - 1
      end do
   end subroutine read_card

   !> Add an error about data field K of the card that begins on line LINE, found long after it was read: the card is
   !! cut once more to point at the columns. NAME is what the message calls the field.
   subroutine add_field_error(text, line, k, name, message, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(in)                  :: line, k
      character(*), intent(in)             :: name, message
      type(deck_error_list), intent(inout) :: errors
      type(card_type)       :: card
      type(deck_error_list) :: said_already
      integer :: cursor

      cursor = line
      call read_card(text, cursor, card, said_already)
      call card%field_error(k, name//': '//message, errors)
   end subroutine add_field_error

   !> The name in field 1 of LINE (its card part), without the * of large field; blank for a continuation.
   pure function card_name(line, comma) result(name)
      character(*), intent(in)      :: line
      integer, intent(in), optional :: comma !! column of the first comma, 0: none; left out, it is looked for
      character(8) :: name
      integer :: i, first, last, n, code

      name = ''
      if (is_continuation(line, comma)) return
      last = end_of_first_field(line, comma)
      first = 1
      do while (first <= last)
         if (iachar(line(first:first)) /= blank) exit
         first = first + 1
      end do
      n = min(8, last - first + 1)
      do i = 1, n
         code = iachar(line(first + i - 1:first + i - 1))
         if (code == asterisk .and. i > 1 .and. name(1:1) /= '*') exit
         if (code >= iachar('a') .and. code <= iachar('z')) code = code - 32
         name(i:i) = achar(code)
      end do
   end function card_name

   !> Whether LINE carries on the card before it: +, * or blank in field 1.
   pure logical function is_continuation(line, comma)
      character(*), intent(in)      :: line
      integer, intent(in), optional :: comma !! as above

      is_continuation = .false.
      if (len(line) == 0) return
      select case (line(1:1))
      case ('+', '*', ',')
         is_continuation = .true.
      case (' ')
         is_continuation = len_trim(line(:end_of_first_field(line, comma))) == 0 .and. len_trim(line) > 0
      end select
   end function is_continuation

   !> The last column of field 1 of LINE.
   pure integer function end_of_first_field(line, comma) result(last)
      character(*), intent(in)      :: line
      integer, intent(in), optional :: comma !! as above

      if (present(comma)) then
         last = comma - 1
      else
         last = index(line, ',') - 1
      end if
      if (last < 0) last = min(8, len(line))
   end function end_of_first_field

   !> Nothing but the name, and perhaps the * of large field, may stand in field 1 of LINE, whose first comma is in column COMMA.
   subroutine check_first_field(line, comma, at, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      type(deck_error_list), intent(inout) :: errors
      integer :: first, last, star

      last = end_of_first_field(line, comma)
      if (is_name_alone(line(:last))) return
      first = max(1, verify(line(:last), ' '))
      associate (entry => line(first:len_trim(line(:last))))
         star = index(entry, '*')
         if (star > 1 .and. star < len(entry)) then
            call errors%add(at, '''*'' inside field 1, expected it behind the name', 1, last)
         else if (len(entry) > 8 .or. index(entry, ' ') > 0) then
            call errors%add(at, ''''//entry(:min(len(entry), 40))//''' in field 1: expected the name of a card alone', 1, last)
         end if
      end associate
   end subroutine check_first_field

   !> Whether FIELD holds one word of at most eight characters, none of them a *: of most cards it does.
   pure logical function is_name_alone(field)
      character(*), intent(in) :: field
      integer :: i, length
      logical :: has_ended

      is_name_alone = .false.
      has_ended = .false.
      length = 0
      do i = 1, len(field)
         if (iachar(field(i:i)) == blank) then
            has_ended = length > 0
         else
            if (has_ended .or. iachar(field(i:i)) == asterisk) return
            length = length + 1
         end if
      end do
      is_name_alone = length <= 8
   end function is_name_alone

   !> The name that the user gave a continuation (`+AB`) must be the one in field 10 of the line before, MARKER.
   subroutine check_marker(line, comma, at, marker, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      character(8), intent(in)             :: marker
      type(deck_error_list), intent(inout) :: errors
      character(8) :: given

      given = line(:min(8, end_of_first_field(line, comma)))
      if (given(2:) == '') return
      if (upper(given(2:)) == upper(marker(2:))) return
      if (marker(2:) == '') then
         call errors%add(at, 'continuation '''//trim(given)//''': the line before it has no such mark in its last field; '// &
                         'expected '//given(1:1)//' alone, or the same mark there', 1, len_trim(given))
      else
         call errors%add(at, 'continuation '''//trim(given)//''' does not follow its card: the line before it ends in '''// &
                         trim(marker)//'''', 1, len_trim(given))
      end if
   end subroutine check_marker

end module deck_cards
