!> Cards put together from their lines: the first one and its continuations.
module deck_cards
   use card_lines, only: card_type, cut_line
   use card_names, only: card_name, check_first_field, check_marker, is_continuation
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use kinds, only: long
   implicit none
   private

   public :: read_card, add_field_error

contains

   !> Read the card that begins on line CURSOR of TEXT (a line that is no continuation) with all its continuations;
   !! CURSOR is left on the line behind it. Faults of form go to ERRORS.
   subroutine read_card(text, cursor, card, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(inout)               :: cursor
      type(card_type), intent(inout)       :: card
      type(deck_error_list), intent(inout) :: errors
      character(8) :: marker
      integer(long) :: first, last
      integer :: file, comma
      logical :: half, carries_on  ! HALF: the first line of a large-field pair has been read

      card%line = cursor
      card%n = 0
      half = .false.
      marker = ''
      if (.not. allocated(card%fields)) allocate (card%fields(64))
      call text%find(cursor, file, first, last, comma)
      call first_line(text%files(file)%bytes(first:last), comma, cursor, text%has_tabs, card, half, marker, errors)
      do
         cursor = cursor + 1
         if (cursor > text%n) exit
         call text%find(cursor, file, first, last, comma)
         if (last < first) cycle
         call next_line(text%files(file)%bytes(first:last), comma, cursor, text%has_tabs, card, half, marker, carries_on, errors)
         if (.not. carries_on) exit
      end do
      do while (card%n > 0)
         if (card%fields(card%n)%length > 0) exit
         card%n = card%n - 1
      end do
   end subroutine read_card


   !> The line that a card begins with. LINE (its card part) stands at index AT and has its first comma in column COMMA; it may
   !! hold a tab only where the deck HAS_TABS.
   subroutine first_line(line, comma, at, has_tabs, card, half, marker, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      logical, intent(in)                  :: has_tabs
      type(card_type), intent(inout)       :: card
      logical, intent(inout)               :: half
      character(8), intent(inout)          :: marker
      type(deck_error_list), intent(inout) :: errors
      integer :: errors_before

      card%name = card_name(line, comma)
      errors_before = errors%n
      call check_first_field(line, comma, at, errors)
      if (errors%n > errors_before) card%name = '' ! not to be understood
      call cut_line(line, comma, at, has_tabs, card, half, marker, errors)
   end subroutine first_line


   !> A line behind it: CARRIES_ON tells whether it belongs to the card.
   subroutine next_line(line, comma, at, has_tabs, card, half, marker, carries_on, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      logical, intent(in)                  :: has_tabs
      type(card_type), intent(inout)       :: card
      logical, intent(inout)               :: half
      character(8), intent(inout)          :: marker
      logical, intent(out)                 :: carries_on
      type(deck_error_list), intent(inout) :: errors

      carries_on = is_continuation(line, comma)
      if (.not. carries_on) return
      call check_marker(line, comma, at, marker, errors)
      call cut_line(line, comma, at, has_tabs, card, half, marker, errors)
   end subroutine next_line


   !> Add an error about data field K of the card that begins on line LINE, found long after it was read: the card is
   !! cut once more to point at the columns. NAME is the name of the field in the manual.
   subroutine add_field_error(text, line, k, name, message, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(in)                  :: line, k
      character(*), intent(in)             :: name, message
      type(deck_error_list), intent(inout) :: errors
      type(card_type)       :: card
      type(deck_error_list) :: said_already
      integer :: cursor, first

      cursor = line
      call read_card(text, cursor, card, said_already)
      if (k > card%n .or. k < 1) then
         call errors%add(line, card%where_is(k)//', '//name//': '//message)
         return
      end if
      associate (field => card%fields(k))
         first = field%first
         call errors%add(field%line, card%where_is(k)//', '//name//': '//message, first, field%last)
      end associate
   end subroutine add_field_error

end module deck_cards
