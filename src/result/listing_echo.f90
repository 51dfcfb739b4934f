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
      integer, parameter :: outside = 0, begins = 1, a_card = 2, in_card = 3 ! where a line is: in the bulk data or not
      integer, allocatable :: part(:)
      character(10) :: counter
      character(8)  :: name
      integer :: cards, i, hidden !! lines of INCLUDE files since the last one shown
      logical :: ended, shows_cards

      if (.not. deck%control%echo) then
         call heading(file, 'DECK: '//integer_text(deck%bulk%n_cards)//' CARDS, NOT ECHOED')
         return
      end if
      call heading(file, 'DECK ECHO')
      associate (text => deck%text, is_own => [(deck%text%file_number(i) == 1, i = 1, deck%text%n)])
         allocate (part(0:text%n), source=outside)
         ended = .false.
         do i = 1, text%n
            if (part(i - 1) /= outside) then
               name = name_at(text, i)
               part(i) = merge(in_card, a_card, name == '' .or. name == 'ENDDATA')
               ended = name == 'ENDDATA' .and. is_own(i)
               if (ended) part(i) = outside
            else if (.not. ended) then
               if (index(adjustl(upper(text%card_part(i))), 'BEGIN') == 1) part(i) = begins
            end if
         end do
         shows_cards = deck%control%echo_asked .or. count(is_own .and. part(1:) == a_card) <= most_echoed
         cards = 0
         hidden = 0
         do i = 1, text%n
            if (part(i) == a_card) cards = cards + 1
            counter = ''
            if (shows_cards .and. part(i) == a_card) write (counter, '(i9, a)') cards, '-'
            if (.not. is_own(i)) then
               hidden = hidden + 1
            else if (shows_cards .or. part(i) <= begins) then
               call count_hidden()
               call file%put(' '//counter//' '//cut(text%line(i), page_width - 13))
            end if
            if (part(i) /= begins .or. .not. shows_cards) cycle
            call file%put('   CARD')
            call file%put('  COUNT-    .   1  ..   2  ..   3  ..   4  ..   5  ..   6  ..   7  ..   8  ..   9  ..  10  .')
         end do
      end associate
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

end module listing_echo
