!> What a NASTRAN deck leaves open and the program takes from its cards: where the bulk data begin without BEGIN BULK, the sets of a deck
!! without case control, and initial temperatures in place of TREF.
module nastran_defaults
   use bulk_data, only: bulk_data_type
   use case_entries, only: set_reference
   use deck_cards, only: card_name
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use deck_lines, only: is_include
   use nastran_words, only: is_idle_card
   use stage_entries, only: stage_type
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: find_first_card, take_only_sets, take_initial_temperature

contains

   !> In a deck TEXT without BEGIN BULK, FIRST_CARD is the line of the first card, whose name is among NAMES; 0: there is a BEGIN BULK,
   !! or no card. The cards are ALONE where nothing stands before them. Keys of case control have the names of cards too (SPC, LOAD,
   !! PARAM): such a line is a card if a comma follows the name, or a third entry.
   subroutine find_first_card(text, names, first_card, alone, errors)
      type(deck_text_type), intent(in)     :: text
      character(8), intent(in)             :: names(:)
      integer, intent(out)                 :: first_card
      logical, intent(out)                 :: alone
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: line
      character(8) :: name
      integer :: i

      first_card = 0
      alone = .true.
      do i = 1, text%n
         line = text%card_part(i)
         if (line == '' .or. is_include(line)) cycle
         name = card_name(line)
         if (index(upper(adjustl(line)), 'BEGIN') == 1) then
            first_card = 0
            return
         end if
         if (first_card > 0) cycle
         if (any(names == name) .or. is_idle_card(name)) then
            if (is_card(line, trim(name))) first_card = i
         end if
         alone = alone .and. first_card > 0
      end do
      if (first_card == 0) return
      if (alone) call errors%warn('no case control and no BEGIN BULK: all lines are cards, and one case is solved')
   end subroutine find_first_card

   !> Whether LINE with NAME in field 1 is a card and not a key of case control with its value.
   pure logical function is_card(line, name)
      character(*), intent(in) :: line, name
      character(:), allocatable :: rest
      integer :: blank

      rest = adjustl(line)
      rest = trim(adjustl(rest(len(name) + 1:)))
      blank = index(rest//' ', ' ')
      is_card = rest /= '' .and. scan(rest(:min(1, len(rest))), '=(') == 0 .and. index(rest, '=') == 0
      if (is_card .and. any(name == [character(8) :: 'SPC', 'MPC', 'LOAD', 'PARAM', 'ECHOON', 'ECHOOFF', 'TRIM', 'SET1'])) &
         is_card = rest(1:1) == ',' .or. len_trim(rest(min(blank, len(rest)):)) > 0
   end function is_card

   !> For cards without case control: the STAGE takes the supports, equations, loads and modes whose set is the only one in BULK.
   subroutine take_only_sets(bulk, stage, errors)
      type(bulk_data_type), intent(in)     :: bulk
      type(stage_type), intent(inout)      :: stage
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: several, taken

      several = ''
      taken = ''
      call take('SPC', [bulk%support%set, bulk%support_sum%set], bulk%support_sum%set, stage%supports)
      call take('MPC', [bulk%equation%set, bulk%equation_sum%set], bulk%equation_sum%set, stage%equations)
      call take('LOAD', [bulk%force%set, bulk%pressure%set, bulk%surface_load%set, bulk%gravity%set, bulk%beam_load%set, &
                         bulk%displacement%set, bulk%load%set], bulk%load%set, stage%load)
      call take('TEMPERATURE(LOAD)', [bulk%temperature%set, bulk%own_temperature%set], [integer ::], stage%temperature)
      if (taken /= '') call errors%warn('the only sets of their kinds are taken: '//taken(3:))
      if (several /= '') call errors%warn('sets that no case control chooses have no effect: '//several(3:))

   contains

      !> Take the only one of SETS; a sum of sets comes before its parts.
      subroutine take(key, sets, sums, chosen)
         character(*), intent(in)           :: key
         integer, intent(in)                :: sets(:), sums(:)
         type(set_reference), intent(inout) :: chosen

         if (size(sets) == 0) return
         if (all(sets == sets(1))) then
            chosen%id = sets(1)
         else if (size(sums) == 1) then
            chosen%id = sums(1)
         else
            several = several//', '//key
            return
         end if
         taken = taken//', '//key//' = '//integer_text(chosen%id)
      end subroutine take

   end subroutine take_only_sets

   !> TEMPERATURE(INITIAL), the last one of INITIAL: its temperature, the same everywhere, takes the place of TREF of all materials.
   subroutine take_initial_temperature(initial, bulk, errors)
      type(set_reference), intent(in)      :: initial(:) !! of each stage
      type(bulk_data_type), intent(inout)  :: bulk
      type(deck_error_list), intent(inout) :: errors
      integer :: i

      do i = size(initial), 1, -1
         if (initial(i)%id == 0) cycle
         associate (values => pack(bulk%temperature%value, bulk%temperature%set == initial(i)%id))
            if (size(values) == 0) then
               call errors%add(initial(i)%line, 'TEMPERATURE: there is no TEMP or TEMPD with set '//integer_text(initial(i)%id))
            else if (any(abs(values - values(1)) > 0.0)) then
               call errors%add(initial(i)%line, 'TEMPERATURE(INITIAL): set '//integer_text(initial(i)%id)// &
                               ' is not the same everywhere; expected a TEMPD alone')
            else
               bulk%mat1%reference = values(1)
               bulk%mat1%reference_given = .true.
            end if
         end associate
         return
      end do
   end subroutine take_initial_temperature

end module nastran_defaults
