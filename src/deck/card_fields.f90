!> The one routine that reads a card by its table, and what it says of fields that do not keep to it.
module card_fields
   use card_lines, only: card_type
   use deck_errors, only: deck_error_list
   use deck_numbers, only: parse_integer, parse_real
   use field_rules, only: expectation, field_rule, in_range, kind_blank, kind_components, kind_integer, kind_real, kind_word
   use kinds, only: wp
   use text_tools, only: real_text
   implicit none
   private

   public :: decode_card, decode_integer, decode_real

   integer, parameter :: most_rules = 32

   real(wp), parameter, public :: largest_size = 1.0e75_wp !! of a number in a deck: its fourth power is still one
   real(wp), parameter, public :: smallest_size = 1.0e-75_wp !! of one that must be above zero

   !> The fields of one card, decoded. Field k is in INTEGERS(k) or REALS(k) or WORDS(k) by its rule.
   type, public :: card_values
      integer      :: integers(most_rules) = 0
      real(wp)     :: reals(most_rules) = 0.0_wp
      character(8) :: words(most_rules) = ''
      logical      :: given(most_rules) = .false. !! false: blank, the default was taken
      logical      :: ok = .true.                 !! false: some field was wrong
   end type card_values

contains

   !> Decode CARD by its table RULES. Behind the last rule the card must be blank, unless OPEN_ENDED: then what
   !! follows is left to the card's own routine. All that is wrong goes to ERRORS.
   subroutine decode_card(card, rules, open_ended, values, errors)
      type(card_type), intent(in)          :: card
      type(field_rule), intent(in)         :: rules(:)   !! at most MOST_RULES
      logical, intent(in)                  :: open_ended
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      integer :: k, errors_before

      errors_before = errors%n
      values%given(:size(rules)) = .false.
      do k = 1, size(rules)
         if (k <= card%n) values%given(k) = card%fields(k)%length > 0
         if (values%given(k)) then
            call decode_field(card, k, rules(k), values, errors)
         else
            call take_default(card, k, rules(k), values, errors)
         end if
      end do
      if (.not. open_ended) then
         do k = size(rules) + 1, card%n
            if (card%fields(k)%length > 0) &
               call card%field_error(k, ''''//trim(card%fields(k)%text)//''' where the field must be blank', errors)
         end do
      end if
      values%ok = errors%n == errors_before
   end subroutine decode_card

   subroutine take_default(card, k, rule, values, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      type(field_rule), intent(in)         :: rule
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors

      if (rule%required) call card%field_error(k, trim(rule%name)//': blank, expected '//expectation(rule), errors)
      values%integers(k) = 0
      values%reals(k) = rule%default
      if (rule%kind == kind_integer .or. rule%kind == kind_components) values%integers(k) = nint(rule%default)
      if (rule%kind == kind_word) values%words(k) = rule%words(2:index(rule%words(2:), '|'))
   end subroutine take_default

   subroutine decode_field(card, k, rule, values, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      type(field_rule), intent(in)         :: rule
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      logical :: ok

      select case (rule%kind)
      case (kind_integer, kind_components)
         call parse_integer(card%fields(k)%text(:card%fields(k)%length), values%integers(k), ok)
         if (.not. ok) then
            call decode_integer(card, k, rule%name, expectation(rule), values%integers(k), ok, errors)
         else if (.not. in_range(rule, real(values%integers(k), wp))) then
            call wrong_entry(card, k, rule%name, 'is out of range, expected '//expectation(rule), errors)
            values%integers(k) = 0
         end if
      case (kind_real)
         if (rule%whole) then
            call parse_integer(card%fields(k)%text(:card%fields(k)%length), values%integers(k), ok)
            values%reals(k) = real(values%integers(k), wp)
            if (ok) return
         end if
         call parse_real(card%fields(k)%text(:card%fields(k)%length), values%reals(k), ok)
         if (.not. ok) call decode_real(card, k, rule%name, expectation(rule), values%reals(k), ok, errors)
         if (.not. ok) return
         ok = in_range(rule, values%reals(k))
         if (ok) then
            call check_size(card, k, rule%name, rule%above .and. rule%least >= 0.0_wp, values%reals(k), ok, errors)
         else
            call wrong_entry(card, k, rule%name, 'is out of range, expected '//expectation(rule), errors)
         end if
         if (.not. ok) values%reals(k) = rule%default
      case (kind_word)
         values%words(k) = card%fields(k)%text(:8)
         if (index(rule%words, '|'//trim(card%fields(k)%text)//'|') == 0 .or. index(card%fields(k)%text, '|') > 0) &
            call wrong_entry(card, k, rule%name, 'is out of range, expected '//expectation(rule), errors)
      case (kind_blank)
         if (verify(trim(card%fields(k)%text), '0.+-') > 0 .or. index(card%fields(k)%text, '0') == 0) & ! a zero is a blank too
            call wrong_entry(card, k, rule%name, 'where the field must be blank', errors)
      end select
   end subroutine decode_field

   !> An error about data field K of CARD, NAME, that says of its entry what the WORDS say.
   subroutine wrong_entry(card, k, name, words, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      character(*), intent(in)             :: name, words
      type(deck_error_list), intent(inout) :: errors

      call card%field_error(k, trim(name)//': '''//trim(card%fields(k)%text)//''' '//words, errors)
   end subroutine wrong_entry

   !> The integer in data field K of CARD. Not OK, and said so with what was EXPECTED, where it is none.
   subroutine decode_integer(card, k, name, expected, value, ok, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      character(*), intent(in)             :: name, expected
      integer, intent(out)                 :: value
      logical, intent(out)                 :: ok
      type(deck_error_list), intent(inout) :: errors

      call parse_integer(card%fields(k)%text, value, ok)
      if (ok) return
      value = 0
      if (is_number_shape(card%fields(k)%text, '0123456789+-') .and. scan(trim(card%fields(k)%text(2:)), '+-') == 0) then
         call wrong_entry(card, k, name, 'is too large for an integer, expected '//expected, errors)
      else
         call wrong_entry(card, k, name, 'is not an integer, expected '//expected, errors)
      end if
   end subroutine decode_integer

   !> The real in data field K of CARD, likewise.
   subroutine decode_real(card, k, name, expected, value, ok, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      character(*), intent(in)             :: name, expected
      real(wp), intent(out)                :: value
      logical, intent(out)                 :: ok
      type(deck_error_list), intent(inout) :: errors
      integer :: whole
      logical :: is_integer

      call parse_real(card%fields(k)%text, value, ok)
      if (ok) then
         call check_size(card, k, name, .false., value, ok, errors)
         if (.not. ok) value = 0.0_wp
         return
      end if
      value = 0.0_wp
      call parse_integer(card%fields(k)%text, whole, is_integer)
      if (is_number_shape(card%fields(k)%text, '0123456789.+-ED') .and. scan(card%fields(k)%text, '.ED') > 0) then
         call wrong_entry(card, k, name, 'is too large or too small for a real number, or not one, expected '//expected, errors)
      else if (is_integer) then
         call wrong_entry(card, k, name, 'is an integer, expected '//expected//': write it with a decimal point', errors)
      else
         call wrong_entry(card, k, name, 'is not a real number, expected '//expected, errors)
      end if
   end subroutine decode_real

   !> Of numbers beyond all measure a stiffness, an area, a volume is none any more: such a VALUE in data field K of CARD is not OK,
   !! and said so. One that must be above zero, IS_POSITIVE, must not vanish beside others either.
   subroutine check_size(card, k, name, is_positive, value, ok, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      character(*), intent(in)             :: name
      logical, intent(in)                  :: is_positive
      real(wp), intent(in)                 :: value
      logical, intent(out)                 :: ok
      type(deck_error_list), intent(inout) :: errors

      ok = .false.
      if (abs(value) > largest_size) then
         call wrong_entry(card, k, name, 'is too large to compute with, expected no more than '//real_text(largest_size), errors)
      else if (is_positive .and. value < smallest_size) then
         call wrong_entry(card, k, name, 'is too small to compute with, expected at least '//real_text(smallest_size), &
                          errors)
      else
         ok = .true.
      end if
   end subroutine check_size

   !> Whether TEXT consists of LETTERS only, begins and ends like a number.
   pure logical function is_number_shape(text, letters)
      character(*), intent(in) :: text, letters

      is_number_shape = index(text, '.') == index(text, '.', back=.true.) .and. &
                        verify(trim(text), letters) == 0 .and. scan(text(1:1), '0123456789+-.') == 1 .and. &
                        scan(text(len_trim(text):len_trim(text)), '0123456789.') == 1
   end function is_number_shape

end module card_fields
