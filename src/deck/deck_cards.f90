!> Assembles cards from their lines: a first line and its continuations, each cut into fields.
!! The formats are small field (8 columns), large field (16) and free field (commas).
module deck_cards
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use kinds, only: long
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: read_card, add_field_error, card_name, is_continuation, check_first_field, loose_text

   integer, parameter :: field_width = 32 !! longest entry of a field (free field only)

   !> One entry of a card and its position.
   type, public :: card_field
      character(field_width) :: text = ''  ! raised to capitals, left-justified
      integer :: length = 0                ! of the text
      integer :: line  = 0                 ! index in the deck text
      integer :: first = 0, last = 0       ! columns of the field
   end type card_field

   !> One card: its name and its data fields 1 to n; field 1 is NASTRAN's field 2. Each line of a card (each pair of lines in large
   !! field) gives eight fields, blank ones included up to the last entry.
   type, public :: card_type
      character(8) :: name = ''
      integer :: line = 0                    !! index of its first line
      integer :: n    = 0
      type(card_field), allocatable :: fields(:)
      character(8) :: marker = ''            !! field 10 of the line cut last
      logical, private :: half = .false.     ! that line is in large field and its second half is missing
      logical, private :: is_long = .false.  ! that line has the fields of its continuations
   contains
      procedure :: where_is, field_error
   end type card_type

contains

   !> Read the card that begins on line CURSOR of TEXT (not a continuation) with all its continuations. CURSOR then is the line after
   !! the card. Errors of format go to ERRORS.
   subroutine read_card(text, cursor, card, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(inout)               :: cursor
      type(card_type), intent(inout)       :: card
      type(deck_error_list), intent(inout) :: errors
      integer(long) :: first, last
      integer :: comma, errors_before, file
      character(8) :: given

      card%line = cursor
      card%n = 0
      card%marker = ''
      card%half = .false.
      card%is_long = .false.
      if (.not. allocated(card%fields)) allocate (card%fields(64))
      call text%find(cursor, file, first, last, comma)
      card%name = card_name(text%files(file)%bytes(first:last), comma)
      errors_before = errors%n
      call check_first_field(text%files(file)%bytes(first:last), comma, cursor, errors)
      if (errors%n > errors_before) card%name = '' ! the card cannot be interpreted
      do
         call cut_line(text%files(file)%bytes(first:last), comma, cursor, card, errors)
         cursor = cursor + 1
         do while (cursor <= text%n)
            call text%find(cursor, file, first, last, comma)
            if (last >= first) exit
            cursor = cursor + 1
         end do
         if (cursor > text%n) exit
         if (.not. is_continuation(text%files(file)%bytes(first:last), comma)) exit
         if (card%is_long) call errors%add(cursor, 'a continuation of a line with more than 8 entries after the name: which '// &
                                           'of them are continued? expected 8 on each line, or all on one')
         associate (line => text%files(file)%bytes(first:last), marker => card%marker(2:))
            given = line(:min(8, end_of_first_field(line, comma))) ! a name, `+AB`, must be that in field 10 of the line before
            if (given(2:) == '' .or. upper(given(2:)) == upper(marker)) cycle
            if (marker == '') then
               call errors%add(cursor, 'continuation '''//trim(given)//''': the line before it has no such mark in its last '// &
                               'field; expected '//given(1:1)//' alone, or the same mark there', 1, len_trim(given))
            else
               call errors%add(cursor, 'continuation '''//trim(given)//''' does not follow its card: the line before it ends '// &
                               'in '''//trim(card%marker)//'''', 1, len_trim(given))
            end if
         end associate
      end do
      do while (card%n > 0)
         if (card%fields(card%n)%length > 0) exit
         card%n = card%n - 1
      end do
   end subroutine read_card

   !> Add an error about data field K of the card on line LINE, found long after the card was read: the card is cut once more to find
   !! the columns. NAME is the name of the field in the message.
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

   !> The name in field 1 of LINE (without comment), without the * of large field; blank for a continuation.
   pure function card_name(line, comma) result(name)
      character(*), intent(in)      :: line
      integer, intent(in), optional :: comma !! column of the first comma, 0: none; default: searched
      character(8) :: name
      integer :: first, last, star

      name = ''
      if (is_continuation(line, comma)) return
      last = end_of_first_field(line, comma)
      first = max(1, verify(line(:last), ' '))
      name = upper(line(first:last))
      star = index(name(2:), '*')
      if (star > 0 .and. name(1:1) /= '*') name(star + 1:) = ''
   end function card_name

   !> Whether LINE continues the card before it: +, * or blank in field 1.
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

   !> The column from which the text of LINE, in fixed fields and longer than 72, is not read: in columns 73 to 80 text that is no
   !! continuation mark, or past column 80; 0: none. NEXT, the line behind it, may have that text as its mark.
   pure integer function loose_text(line, next) result(column)
      character(*), intent(in) :: line, next
      character(8) :: mark

      column = 0
      mark = adjustl(line(73:min(80, len(line))))
      if (mark /= '' .and. scan(mark(1:1), '+*') == 0) column = 73
      if (column == 73 .and. next(:min(1, len(next))) == '+') then
         if (upper(next(2:min(8, len(next)))) == upper(mark(2:)) .and. mark(2:) /= '') column = 0
      end if
      if (column == 0 .and. len(line) > 80) column = 81
   end function loose_text

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

   !> Field 1 of LINE may hold only the name and the * of large field; the first comma is in column COMMA.
   subroutine check_first_field(line, comma, at, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      type(deck_error_list), intent(inout) :: errors
      integer :: end, first, last, star

      last = end_of_first_field(line, comma)
      first = max(1, verify(line(:last), ' '))
      end = max(first, len_trim(line(:last)))
      if (end > first) then
         if (line(end - 1:end) == ' *') end = max(first, len_trim(line(:end - 1))) ! it may stand apart, in column 8
      end if
      associate (entry => line(first:end))
         star = index(entry, '*')
         if (star > 1 .and. star < len(entry)) then
            call errors%add(at, '''*'' inside field 1, expected after the name', 1, last)
         else if (len(entry) > 8 .or. index(entry, ' ') > 0) then
            call errors%add(at, ''''//entry(:min(len(entry), 40))//''' in field 1: expected the name of a card alone', 1, last)
         end if
      end associate
   end subroutine check_first_field

   !> Cut one line into fields and append them to CARD. Fixed fields: eight of 8 columns, or four of 16, after the name; columns 73-80
   !! are the continuation mark, text behind them is not read. Free field: eight or four entries between commas, and one more for the
   !! mark. A small free-field line with more entries, none of them a mark, is several lines in one: the next eight entries are those of
   !! a continuation.
   subroutine cut_line(line, comma, at, card, errors)
      character(*), intent(in)             :: line     !! its card part
      integer, intent(in)                  :: comma    !! column of the first comma, 0: none
      integer, intent(in)                  :: at       !! index in the deck text
      type(card_type), intent(inout)       :: card
      type(deck_error_list), intent(inout) :: errors
      integer :: first, k, last, most
      logical :: large

      large = index(line(:merge(comma - 1, min(8, len(line)), comma > 0)), '*') > 0
      do while (card%half .and. .not. large .and. modulo(card%n, 8) /= 0) ! the second half of a large-field line is missing
         call push(card, '', at, 0, 0, errors)
      end do
      card%marker = ''
      card%is_long = .false.
      most = merge(4, 8, large)
      first = merge(comma + 1, 9, comma > 0)
      do
         do k = 1, most
            if (comma > 0) then
               last = index(line(min(first, len(line) + 1):), ',')
               last = merge(len(line), first + last - 2, last == 0)
               call push(card, line(first:last), at, first, max(first, last), errors)
               first = last + 2
            else
               last = first + 64/most - 1
               call push(card, line(first:min(last, len(line))), at, first, last, errors)
               first = last + 1
            end if
         end do
         card%half = large .and. modulo(card%n, 8) == 4
         if (first > len(line)) return
         last = merge(len(line), min(80, len(line)), comma > 0)
         if (comma == 0 .or. verify(line(first:), ' ,') == 0) exit
         k = verify(line(first:), ' ')
         if (large .or. scan(line(first + k - 1:first + k - 1), '+*') == 1) exit
         card%is_long = .true.
      end do
      card%marker = adjustl(line(first:last))
      if (comma == 0) return
      k = index(line(first:)//',', ',')
      card%marker = adjustl(line(first:first + k - 2))
      if ((card%marker /= '' .and. scan(card%marker(1:1), '+*') == 0) .or. card%is_long .or. &
          verify(line(min(first + k, len(line) + 1):), ' ,') > 0) call errors%add(at, 'more than '//integer_text(most)// &
         ' entries after the name: use a continuation line', first, last)
   end subroutine cut_line

   !> Append a field: ENTRY without surrounding blanks, in capitals.
   subroutine push(card, entry, at, first, last, errors)
      type(card_type), intent(inout)       :: card
      character(*), intent(in)             :: entry
      integer, intent(in)                  :: at, first, last
      type(deck_error_list), intent(inout) :: errors
      type(card_field), allocatable :: wider(:)
      integer :: code, from, i, to

      if (card%n == size(card%fields)) then
         allocate (wider(2*card%n))
         wider(:card%n) = card%fields
         call move_alloc(wider, card%fields)
      end if
      card%n = card%n + 1
      from = max(1, verify(entry, ' '))
      to = len_trim(entry)
      associate (field => card%fields(card%n))
         field%line = at
         field%first = first
         field%last = last
         field%length = min(to - from + 1, field_width)
         field%text = ''
         do i = 1, field%length ! upper, inline
            code = iachar(entry(from + i - 1:from + i - 1))
            if (code >= iachar('a') .and. code <= iachar('z')) code = code - 32
            field%text(i:i) = achar(code)
         end do
      end associate
      if (to - from + 1 > field_width) call errors%add(at, card%where_is(card%n)//': an entry of more than '// &
                                                       integer_text(field_width)//' characters', first, last)
   end subroutine push

   !> The name of data field K in messages: 'CQUAD4, field 7'. NASTRAN counts fields 2 to 9 on every line of a card.
   pure function where_is(self, k) result(words)
      class(card_type), intent(in) :: self
      integer, intent(in)          :: k
      character(:), allocatable    :: words

      words = trim(self%name)//', field '//integer_text(modulo(k - 1, 8) + 2)
      if (k > 8) words = words//' of continuation '//integer_text((k - 1)/8)
   end function where_is

   !> Add an error about data field K with its place and columns.
   subroutine field_error(self, k, message, errors)
      class(card_type), intent(in)         :: self
      integer, intent(in)                  :: k
      character(*), intent(in)             :: message
      type(deck_error_list), intent(inout) :: errors

      if (k >= 1 .and. k <= self%n) then
         associate (field => self%fields(k))
            call errors%add(field%line, self%where_is(k)//', '//message, field%first, field%last)
         end associate
      else
         call errors%add(self%line, self%where_is(k)//', '//message)
      end if
   end subroutine field_error

end module deck_cards
