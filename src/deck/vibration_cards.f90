!> The cards of oscillation: EIGRL, FREQ1, FREQ4, TABDMP1. A table and a routine each.
module vibration_cards
   use bulk_data, only: bulk_data_type, eigrl_card, freq1_card, freq4_card, tabdmp1_card
   use card_lines, only: card_values, decode_real, smallest_size
   use card_reader, only: card_reader_type
   use field_rules, only: any_field, blank_field, integer_field, real_field, word_field
   use kinds, only: wp
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: read_eigrl, read_freq1, read_freq4, read_tabdmp1

   integer, parameter :: most_frequencies = 100000 ! of one FREQ1, and of one mode by FREQ4
   integer, parameter :: list_from = 9             ! data field in which the list of a TABDMP1 begins

contains

   !> EIGRL: the modes between V1 and V2, ND of them at the most, scaled by NORM. How Lanczos' method is steered and what it prints
   !! is its own affair here.
   subroutine read_eigrl(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('SID'), real_field('V1', default=0.0_wp), &
         real_field('V2', default=0.0_wp, above=0.0_wp), integer_field('ND', default=0), &
         any_field(['MSGLVL', 'MAXSET', 'SHFSCL']), word_field('NORM', '|MASS|MAX|')])
      allocate (bulk%eigrl(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%eigrl(i) = eigrl_card(line=cards%line, id=values%integers(1), has_lowest=values%given(2), &
            has_highest=values%given(3), lowest=values%reals(2), highest=values%reals(3), most=values%integers(4), &
            unit_mass=values%words(8) == 'MASS')
         if (values%ok .and. all(values%given(2:3)) .and. values%reals(2) >= values%reals(3)) call cards%error('V2', &
            real_text(values%reals(3))//' is no more than V1, '//real_text(values%reals(2))//'; expected the end of the range')
      end do
   end subroutine read_eigrl

   !> FREQ1: the frequencies F1 + k DF, k = 0 to NDF. A set may have several.
   subroutine read_freq1(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('SID'), real_field('F1', least=0.0_wp), real_field('DF', above=0.0_wp), &
         integer_field('NDF', default=1, most=most_frequencies)])
      allocate (bulk%freq1(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%freq1(i) = freq1_card(line=cards%line, set=values%integers(1), first=values%reals(2), step=values%reals(3), &
                                    n=values%integers(4))
      end do
   end subroutine read_freq1

   !> FREQ4: NFM frequencies, an odd number so that the mode itself is one of them, spread by FSPD about every mode from F1 to F2.
   subroutine read_freq4(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('SID'), real_field('F1', default=0.0_wp, least=0.0_wp), &
         real_field('F2', default=1.0e20_wp, above=0.0_wp), real_field('FSPD', default=0.1_wp, above=0.0_wp, below=1.0_wp), &
         integer_field('NFM', default=3, most=most_frequencies)])
      allocate (bulk%freq4(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%freq4(i) = freq4_card(line=cards%line, set=values%integers(1), lowest=values%reals(2), highest=values%reals(3), &
                                    spread=values%reals(4), n=values%integers(5) + modulo(values%integers(5) + 1, 2))
         if (values%ok .and. values%reals(2) >= values%reals(3)) call cards%error('F2', real_text(values%reals(3))// &
            ' is no more than F1, '//real_text(values%reals(2))//'; expected the end of the range')
      end do
   end subroutine read_freq4

   !> TABDMP1: pairs of a frequency and the damping there, closed by ENDT. TYPE says what the damping is.
   subroutine read_tabdmp1(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('TID'), word_field('TYPE', '|G|CRIT|Q|'), &
         blank_field(['blank', 'blank', 'blank', 'blank', 'blank', 'blank'])], open_ended=.true.)
      allocate (bulk%tabdmp1(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (table => bulk%tabdmp1(i))
            table%line = cards%line
            table%id = values%integers(1)
            table%kind = values%words(2)
            allocate (table%frequency(0), table%value(0))
            if (values%ok) call read_pairs(cards, table)
            if (.not. cards%is_faulty()) call check_order(cards, table)
         end associate
      end do
   end subroutine read_tabdmp1

   !> The pairs up to ENDT; one with SKIP in it is none, nor are two blank fields.
   subroutine read_pairs(cards, table)
      type(card_reader_type), intent(inout) :: cards
      type(tabdmp1_card), intent(inout)     :: table
      real(wp) :: frequency, value
      integer  :: k, last

      associate (card => cards%card)
         last = list_from
         do while (last <= card%n)
            if (card%fields(last)%text == 'ENDT') exit
            last = last + 1
         end do
         if (last > card%n) then
            call card%field_error(card%n, 'ENDT: expected it behind the last pair of a frequency and its damping', cards%errors)
            return
         end if
         do k = last + 1, card%n
            if (card%fields(k)%length > 0) call card%field_error(k, ''''//trim(card%fields(k)%text)// &
               ''' behind ENDT, where the card must be blank', cards%errors)
         end do
         do k = list_from, last - 1, 2
            associate (first => card%fields(k), second => card%fields(k + 1))
               if (first%length == 0 .and. (second%length == 0 .or. second%text == 'ENDT')) cycle
               if (first%text == 'SKIP' .or. second%text == 'SKIP') cycle
            end associate
            call read_entry(cards, k, 'F', 'a frequency of 0 or more', 0.0_wp, frequency)
            if (table%kind == 'Q') then
               call read_entry(cards, k + 1, 'G', 'a real number above 0, the amplification Q there', smallest_size, value)
            else
               call read_entry(cards, k + 1, 'G', 'a real number of at least 0, the damping there', 0.0_wp, value)
            end if
            table%frequency = [table%frequency, frequency]
            table%value = [table%value, value]
         end do
      end associate
   end subroutine read_pairs

   !> The real in data field K, NAME, which must be at least LEAST.
   subroutine read_entry(cards, k, name, expected, least, value)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      character(*), intent(in)              :: name, expected
      real(wp), intent(in)                  :: least
      real(wp), intent(out)                 :: value
      logical :: ok

      value = least
      associate (card => cards%card)
         if (card%fields(k)%length == 0) then
            call card%field_error(k, name//': blank, expected '//expected, cards%errors)
            return
         end if
         call decode_real(card, k, name, expected, value, ok, cards%errors)
         if (ok .and. value < least) call card%field_error(k, name//': '''//trim(card%fields(k)%text)// &
            ''' is out of range, expected '//expected, cards%errors)
      end associate
   end subroutine read_entry

   !> Two points at the least, all ascending or all descending, which is turned round; where the value jumps a frequency stands twice,
   !! but not at the ends.
   subroutine check_order(cards, table)
      type(card_reader_type), intent(inout) :: cards
      type(tabdmp1_card), intent(inout)     :: table
      integer :: n

      n = size(table%frequency)
      if (n < 2) then
         call cards%card%field_error(cards%card%n, integer_text(n)//' points, expected two or more', cards%errors)
         return
      end if
      if (table%frequency(1) > table%frequency(n)) then
         table%frequency = table%frequency(n:1:-1)
         table%value = table%value(n:1:-1)
      end if
      associate (f => table%frequency)
         if (any(f(2:) < f(:n - 1))) then
            call cards%card%field_error(list_from, 'F: the frequencies are not in order, expected them ascending, or descending', &
                                        cards%errors)
         else if (f(1) >= f(2) .or. f(n - 1) >= f(n) .or. any(f(3:) <= f(:n - 2))) then
            call cards%card%field_error(list_from, 'F: a frequency stands twice at an end of the table, or three times', &
                                        cards%errors)
         end if
      end associate
   end subroutine check_order

end module vibration_cards
