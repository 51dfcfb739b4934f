!> The echo of the deck at the head of the listing.
module listing_echo
   use deck_cards, only: card_name
   use deck_input, only: deck_type
   use line_scan, only: is_include
   use listing_table, only: cut, heading, page_width
   use output_file, only: output_file_type
   use text_tools, only: integer_text, plural, upper
   implicit none
   private

   public :: write_echo

   integer, parameter :: most_echoed = 5000 ! cards of a deck that are echoed without being asked for

contains

   !> The deck as read, cards counted, under a field ruler. INCLUDE files are counted, not shown, and so are the cards of a deck
   !! that has very many of its own, unless ECHO asks for them.
   subroutine write_echo(file, deck)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      character(:), allocatable :: line
      character(10) :: counter
      integer :: i, cards, hidden !! lines of INCLUDE files since the last one shown
      logical :: in_bulk, ended, shows_cards

      if (.not. deck%control%echo) then
         call heading(file, 'DECK: '//integer_text(deck%bulk%n_cards)//' CARDS, NOT ECHOED')
         return
      end if
      call heading(file, 'DECK ECHO')
      cards = own_cards(deck)
      shows_cards = deck%control%echo_asked .or. cards <= most_echoed
      cards = 0
      hidden = 0
      in_bulk = .false.
      ended = .false.
      do i = 1, deck%text%n
         line = deck%text%card_part(i)
         counter = ''
         if (in_bulk .and. begins_card(line)) then
            cards = cards + 1
            write (counter, '(i9, a)') cards, '-'
         else if (in_bulk .and. card_name(line) == 'ENDDATA') then
            in_bulk = deck%text%file_number(i) > 1
            ended = .not. in_bulk
         end if
         if (deck%text%file_number(i) > 1) then
            hidden = hidden + 1
         else if (shows_cards .or. .not. in_bulk) then
            call count_hidden()
            call file%put(' '//counter//' '//cut(deck%text%line(i), page_width - 13))
         end if
         if (.not. (in_bulk .or. ended) .and. index(adjustl(upper(line)), 'BEGIN') == 1) then
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

   !> How many cards stand in the deck itself, not in INCLUDE files.
   integer function own_cards(deck) result(n)
      type(deck_type), intent(in) :: deck
      character(:), allocatable :: line
      integer :: i
      logical :: in_bulk

      n = 0
      in_bulk = .false.
      do i = 1, deck%text%n
         if (deck%text%file_number(i) > 1) cycle
         line = deck%text%card_part(i)
         if (in_bulk .and. begins_card(line)) n = n + 1
         if (in_bulk .and. card_name(line) == 'ENDDATA') exit
         if (.not. in_bulk) in_bulk = index(adjustl(upper(line)), 'BEGIN') == 1
      end do
   end function own_cards

   !> Whether a card begins with this LINE of the bulk data.
   pure logical function begins_card(line)
      character(*), intent(in) :: line

      begins_card = card_name(line) /= '' .and. card_name(line) /= 'ENDDATA' .and. .not. is_include(line)
   end function begins_card

end module listing_echo
