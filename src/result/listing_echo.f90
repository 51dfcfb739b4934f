!> The echo of the deck at the head of the listing.
module listing_echo
   use deck_cards, only: card_name
   use deck_input, only: deck_type
   use deck_text, only: deck_text_type, is_include
   use kinds, only: long
   use table_writer, only: cut, heading, page_width
   use output_file, only: output_file_type
   use text_tools, only: integer_text, plural, upper
   implicit none
   private

   public :: write_echo

   integer, parameter :: most_echoed = 5000 ! cards of a deck that are echoed without ECHO

contains

   !> The deck as read, cards counted, under a field ruler. INCLUDE files are counted, not shown. The same holds for the cards
   !! of a very long deck, unless ECHO asks for them.
   subroutine write_echo(file, deck)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      character(10) :: counter
      character(8)  :: name
      integer :: cards, i, hidden !! lines of INCLUDE files since the last one shown
      logical :: begins, in_bulk, ended, is_own, shows_cards

      if (.not. deck%control%echo) then
         call heading(file, 'DECK: '//integer_text(deck%bulk%n_cards)//' CARDS, NOT ECHOED')
         return
      end if
      call heading(file, 'DECK ECHO')
      shows_cards = deck%control%echo_asked
      if (.not. shows_cards) shows_cards = .not. has_many_cards(deck)
      cards = 0
      hidden = 0
      in_bulk = .false.
      ended = .false.
      do i = 1, deck%text%n
         is_own = deck%text%file_number(i) == 1
         counter = ''
         begins = .false.
         if (in_bulk) then
            name = name_at(deck%text, i)
            if (name == 'ENDDATA') then
               in_bulk = .not. is_own
               ended = is_own
            else if (name /= '') then
               cards = cards + 1
               if (shows_cards) write (counter, '(i9, a)') cards, '-'
            end if
         else if (.not. ended) then
            begins = begins_bulk(deck%text%card_part(i))
         end if
         if (.not. is_own) then
            hidden = hidden + 1
         else if (shows_cards .or. .not. in_bulk) then
            call count_hidden()
            call file%put(' '//counter//' '//cut(deck%text%line(i), page_width - 13))
         end if
         if (begins) then
            in_bulk = .true.
            if (.not. shows_cards) cycle
            call file%put('   CARD')
            call file%put('  COUNT-    .   1  ..   2  ..   3  ..   4  ..   5  ..   6  ..   7  ..   8  ..   9  ..  10  .')
         end if
      end do
      call count_hidden()
      call file%put('')
      call file%put('  TOTAL COUNT '//integer_text(cards)//' CARDS')
      if (.not. shows_cards) call file%put('  THE DECK ITSELF HAS MORE THAN '//integer_text(most_echoed)// &
                                           ', NOT ECHOED: ECHO = YES SHOWS THEM')

   contains

      subroutine count_hidden()
         if (hidden > 0) call file%put('            ('//upper(plural(hidden, 'line'))//' OF INCLUDE FILES, NOT ECHOED)')
         hidden = 0
      end subroutine count_hidden

   end subroutine write_echo

   !> Whether the deck itself, without INCLUDE files, has more cards than are echoed without ECHO.
   logical function has_many_cards(deck)
      type(deck_type), intent(in) :: deck
      character(8) :: name
      integer :: i, n
      logical :: in_bulk

      n = 0
      in_bulk = .false.
      do i = 1, deck%text%n
         if (deck%text%file_number(i) > 1) cycle
         if (in_bulk) then
            name = name_at(deck%text, i)
            if (name == 'ENDDATA' .or. n > most_echoed) exit
            if (name /= '') n = n + 1
         else
            in_bulk = begins_bulk(deck%text%card_part(i))
         end if
      end do
      has_many_cards = n > most_echoed
   end function has_many_cards

   !> The name of the card that begins on line I of the bulk data, or ENDDATA; blank where none begins. The line is examined in
   !! place: copies of a long deck would take more time than the rest of the head.
   pure function name_at(text, i) result(name)
      type(deck_text_type), intent(in) :: text
      integer, intent(in)              :: i
      character(8) :: name
      integer(long) :: first, last
      integer :: comma, file

      call text%find(i, file, first, last, comma)
      name = card_name(text%files(file)%bytes(first:last), comma)
      if (is_include(text%files(file)%bytes(first:last))) name = ''
   end function name_at

   !> Whether LINE of the case control is BEGIN BULK.
   pure logical function begins_bulk(line)
      character(*), intent(in) :: line

      begins_bulk = index(adjustl(upper(line)), 'BEGIN') == 1
   end function begins_bulk

end module listing_echo
