!> The echo of the deck in the listing.
module listing_echo
   use deck_cards, only: card_name, is_continuation
   use deck_input, only: deck_type
   use line_scan, only: is_include
   use listing_page, only: cut, heading, page_width
   use output_file, only: output_file_type
   use text_tools, only: integer_text, plural, upper
   implicit none
   private

   public :: write_echo

contains

   !> The deck as read, cards counted, under a field ruler. INCLUDE files are counted, not shown.
   subroutine write_echo(file, deck)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      character(:), allocatable :: line
      character(10) :: counter
      integer :: i, cards, hidden
      logical :: in_bulk

      if (.not. deck%control%echo) then
         call heading(file, 'DECK: '//integer_text(deck%bulk%n_cards)//' CARDS, NOT ECHOED')
         return
      end if
      call heading(file, 'DECK ECHO')
      cards = 0
      hidden = 0
      in_bulk = .false.
      do i = 1, deck%text%n
         line = deck%text%card_part(i)
         counter = ''
         if (in_bulk .and. line /= '' .and. .not. is_continuation(line)) then
            if (card_name(line) /= 'ENDDATA' .and. .not. is_include(line)) then
               cards = cards + 1
               write (counter, '(i9, a)') cards, '-'
            end if
         end if
         if (deck%text%file_number(i) > 1) then
            hidden = hidden + 1
         else
            call count_hidden(file, hidden)
            call file%put(' '//counter//' '//cut(deck%text%line(i), page_width - 13))
         end if
         if (.not. in_bulk .and. index(adjustl(upper(line)), 'BEGIN') == 1) then
            in_bulk = .true.
            call file%put('   CARD')
            call file%put('  COUNT-    .   1  ..   2  ..   3  ..   4  ..   5  ..   6  ..   7  ..   8  ..   9  ..  10  .')
         end if
      end do
      call count_hidden(file, hidden)
      call file%put('')
      call file%put('  TOTAL COUNT '//integer_text(cards)//' CARDS')
   end subroutine write_echo


   subroutine count_hidden(file, hidden)
      type(output_file_type), intent(inout) :: file
      integer, intent(inout)                :: hidden

      if (hidden > 0) call file%put('            ('//upper(plural(hidden, 'line'))// &
                                          ' OF INCLUDE FILES, NOT ECHOED)')
      hidden = 0
   end subroutine count_hidden

end module listing_echo
