!> The table of a card: one rule a field, and the one routine that reads a card by its table.
module card_fields
   use deck_cards, only: card_type
   use deck_errors, only: deck_error_list
   use deck_numbers, only: parse_integer, parse_real
   use kinds, only: wp
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: integer_field, real_field, word_field, blank_field, component_field, &
             decode_card, decode_integer, decode_real, field_error

   integer, parameter :: kind_integer = 1, kind_real = 2, kind_word = 3, kind_blank = 4, &
                         kind_components = 5

   !> What a field may hold.
   type, public :: field_rule
      character(8)  :: name     = ''           !! as in the card manual
      integer       :: kind     = kind_blank
      logical       :: required = .false.
      real(wp)      :: default  = 0.0_wp       !! of integer and real fields left blank
      real(wp)      :: least    = -huge(1.0_wp)
      real(wp)      :: most     = huge(1.0_wp)
      logical       :: above    = .false.      !! reals: LEAST itself is out
      logical       :: below    = .false.      !! reals: MOST itself is out
      logical       :: whole    = .false.      !! reals: an integer is a number too
      character(48) :: words    = ''           !! of a word field: '|STEP|BACK|', the first is the default
   end type field_rule

   !> The fields of one card, decoded. Field k is in INTEGERS(k) or REALS(k) or WORDS(k) by its rule.
   type, public :: card_values
      integer, allocatable      :: integers(:)
      real(wp), allocatable     :: reals(:)
      character(8), allocatable :: words(:)
      logical, allocatable      :: given(:)    !! false: blank, the default was taken
      logical                   :: ok = .true. !! false: some field was wrong
   end type card_values

contains

   !> Rule for an integer: an id by default (1 and up).
   pure function integer_field(name, default, least, most) result(rule)
      character(*), intent(in)      :: name
      integer, intent(in), optional :: default !! none: the field must be filled
      integer, intent(in), optional :: least, most
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_integer
      rule%required = .not. present(default)
      rule%least = 1.0_wp
      if (present(default)) rule%default = real(default, wp)
      if (present(least)) rule%least = real(least, wp)
      if (present(most)) rule%most = real(most, wp)
   end function integer_field


   !> Rule for a real; ABOVE and BELOW exclude the bound, LEAST and MOST include it.
   pure function real_field(name, default, above, below, least, most, whole) result(rule)
      character(*), intent(in)       :: name
      real(wp), intent(in), optional :: default !! none: the field must be filled
      real(wp), intent(in), optional :: above, below, least, most
      logical, intent(in), optional  :: whole   !! true: an integer is taken too (default: NASTRAN's rule, it is not)
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_real
      rule%required = .not. present(default)
      if (present(default)) rule%default = default
      if (present(least)) rule%least = least
      if (present(most)) rule%most = most
      if (present(above)) rule%least = above
      if (present(below)) rule%most = below
      rule%above = present(above)
      if (present(whole)) rule%whole = whole
      rule%below = present(below)
   end function real_field


   !> Rule for a word out of a list, WORDS = '|ARITH|GEOM|LIST|'; a blank field takes the first.
   pure function word_field(name, words) result(rule)
      character(*), intent(in) :: name, words
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_word
      rule%words = words
   end function word_field


   !> Rule for a list of NASTRAN's components: different digits of 1 to 6.
   pure function component_field(name, default) result(rule)
      character(*), intent(in)      :: name
      integer, intent(in), optional :: default !! none: the field must be filled
      type(field_rule) :: rule

      rule = integer_field(name, default, least=1, most=654321)
      rule%kind = kind_components
   end function component_field


   !> Rule for a field that must stay blank (NAME says what NASTRAN has there); a zero is a blank too.
   pure function blank_field(name) result(rule)
      character(*), intent(in) :: name
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_blank
   end function blank_field


   !> Decode CARD by its table RULES. Behind the last rule the card must be blank, unless OPEN_ENDED: then what
   !! follows is left to the card's own routine. All that is wrong goes to ERRORS.
   subroutine decode_card(card, rules, open_ended, values, errors)
      type(card_type), intent(in)          :: card
      type(field_rule), intent(in)         :: rules(:)
      logical, intent(in)                  :: open_ended
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      integer :: k, errors_before

      errors_before = errors%n
      call make_room(values, size(rules))
      values%given(:size(rules)) = .false.
      do k = 1, size(rules)
         if (k > card%n) then
            call take_default(card, k, rules(k), values, errors)
         else if (card%fields(k)%length == 0) then
            call take_default(card, k, rules(k), values, errors)
         else
            values%given(k) = .true.
            call decode_field(card, k, rules(k), values, errors)
         end if
      end do
      if (.not. open_ended) then
         do k = size(rules) + 1, card%n
            if (card%fields(k)%text /= '') then
               call field_error(card, k, ''''//trim(card%fields(k)%text)//''' where the field must be blank', errors)
            end if
         end do
      end if
      values%ok = errors%n == errors_before
   end subroutine decode_card


   subroutine make_room(values, n)
      type(card_values), intent(inout) :: values
      integer, intent(in)              :: n
      integer :: room

      if (allocated(values%given)) then
         if (size(values%given) >= n) return
         deallocate (values%integers, values%reals, values%words, values%given)
      end if
      room = max(n, 32)
      allocate (values%integers(room), source=0)
      allocate (values%reals(room), source=0.0_wp)
      allocate (values%words(room), source='        ')
      allocate (values%given(room), source=.false.)
   end subroutine make_room


   subroutine take_default(card, k, rule, values, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      type(field_rule), intent(in)         :: rule
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors

      if (rule%required) then
         call field_error(card, k, trim(rule%name)//': blank, expected '//expectation(rule), errors)
      end if
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
      case (kind_integer)
         call integer_by_rule(card, k, rule, values%integers(k), ok, errors)
         if (ok .and. (values%integers(k) < rule%least .or. values%integers(k) > rule%most)) then
            call out_of_range(card, k, rule, errors)
            values%integers(k) = 0
         end if
      case (kind_components)
         call integer_by_rule(card, k, rule, values%integers(k), ok, errors)
         if (ok .and. .not. is_component_list(values%integers(k))) then
            call out_of_range(card, k, rule, errors)
            values%integers(k) = 0
         end if
      case (kind_real)
         if (rule%whole) then
            call parse_integer(card%fields(k)%text, values%integers(k), ok)
            values%reals(k) = real(values%integers(k), wp)
            if (ok) return
         end if
         call parse_real(card%fields(k)%text(:card%fields(k)%length), values%reals(k), ok)
         if (.not. ok) call decode_real(card, k, rule%name, expectation(rule), values%reals(k), ok, errors)
         if (ok .and. .not. in_range(rule, values%reals(k))) then
            call out_of_range(card, k, rule, errors)
            values%reals(k) = rule%default
         end if
      case (kind_word)
         values%words(k) = card%fields(k)%text(:8)
         if (index(rule%words, '|'//trim(card%fields(k)%text)//'|') == 0 .or. index(card%fields(k)%text, '|') > 0) then
            call out_of_range(card, k, rule, errors)
         end if
      case (kind_blank)
         if (.not. is_zero(card%fields(k)%text)) then
            call field_error(card, k, trim(rule%name)//': '''//trim(card%fields(k)%text)// &
                             ''' where the field must be blank', errors)
         end if
      end select
   end subroutine decode_field


   !> The integer in data field K of CARD by its RULE; the words for an error are made only where there is one.
   subroutine integer_by_rule(card, k, rule, value, ok, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      type(field_rule), intent(in)         :: rule
      integer, intent(out)                 :: value
      logical, intent(out)                 :: ok
      type(deck_error_list), intent(inout) :: errors

      call parse_integer(card%fields(k)%text(:card%fields(k)%length), value, ok)
      if (.not. ok) call decode_integer(card, k, rule%name, expectation(rule), value, ok, errors)
   end subroutine integer_by_rule


   subroutine out_of_range(card, k, rule, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      type(field_rule), intent(in)         :: rule
      type(deck_error_list), intent(inout) :: errors

      call field_error(card, k, trim(rule%name)//': '''//trim(card%fields(k)%text)//''' is out of range, expected '// &
                       expectation(rule), errors)
   end subroutine out_of_range


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
         call field_error(card, k, trim(name)//': '''//trim(card%fields(k)%text)//''' is too large for an integer, expected '// &
                          expected, errors)
         return
      end if
      call field_error(card, k, trim(name)//': '''//trim(card%fields(k)%text)// &
                                     ''' is not an integer, expected '//expected, errors)
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
      if (ok) return
      value = 0.0_wp
      if (is_number_shape(card%fields(k)%text, '0123456789.+-ED') .and. scan(card%fields(k)%text, '.ED') > 0) then
         call field_error(card, k, trim(name)//': '''//trim(card%fields(k)%text)//''' is too large or too small for a '// &
                          'real number, or not one, expected '//expected, errors)
         return
      end if
      call parse_integer(card%fields(k)%text, whole, is_integer)
      if (is_integer) then
         call field_error(card, k, trim(name)//': '''//trim(card%fields(k)%text)// &
                          ''' is an integer, expected '//expected//': write it with a decimal point', errors)
      else
         call field_error(card, k, trim(name)//': '''//trim(card%fields(k)%text)// &
                          ''' is not a real number, expected '//expected, errors)
      end if
   end subroutine decode_real


   !> Whether TEXT consists of LETTERS only, begins and ends like a number.
   pure logical function is_number_shape(text, letters)
      character(*), intent(in) :: text, letters

      is_number_shape = index(text, '.') == index(text, '.', back=.true.) .and. &
                        verify(trim(text), letters) == 0 .and. scan(text(1:1), '0123456789+-.') == 1 .and. &
                        scan(text(len_trim(text):len_trim(text)), '0123456789.') == 1
   end function is_number_shape


   !> An error about data field K of CARD, its place and columns taken from the card.
   subroutine field_error(card, k, message, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: k
      character(*), intent(in)             :: message
      type(deck_error_list), intent(inout) :: errors

      if (k <= card%n) then
         associate (field => card%fields(k))
            call errors%add(field%line, card%where_is(k)//', '//message, field%first, field%last)
         end associate
      else
         call errors%add(card%line, card%where_is(k)//', '//message)
      end if
   end subroutine field_error


   pure logical function in_range(rule, value)
      type(field_rule), intent(in) :: rule
      real(wp), intent(in)         :: value

      in_range = value >= rule%least .and. value <= rule%most
      if (rule%above) in_range = in_range .and. value > rule%least
      if (rule%below) in_range = in_range .and. value < rule%most
   end function in_range


   !> What a rule wants, in words.
   pure function expectation(rule) result(words)
      type(field_rule), intent(in) :: rule
      character(:), allocatable    :: words
      logical :: has_least, has_most

      has_least = rule%least > -huge(1.0_wp)
      has_most = rule%most < huge(1.0_wp)
      select case (rule%kind)
      case (kind_integer)
         words = 'an integer'
         if (has_least .and. has_most .and. nint(rule%least) == nint(rule%most)) then
            words = integer_text(nint(rule%least))
         else if (has_least .and. has_most) then
            words = words//' from '//integer_text(int(rule%least))//' to '//integer_text(int(rule%most))
         else if (has_least) then
            words = words//' of '//integer_text(int(rule%least))//' or more'
         end if
      case (kind_components)
         words = 'a list of components, different digits of 1 to 6'
      case (kind_real)
         words = 'a real number'
         if (has_least) words = words//' '//bound('above', 'of at least', rule%least, rule%above)
         if (has_least .and. has_most) words = words//' and'
         if (has_most) words = words//' '//bound('below', 'at most', rule%most, rule%below)
      case (kind_word)
         words = 'one of '//list_of(trim(rule%words))
      case default
         words = 'blank'
      end select
      if (.not. rule%required .and. rule%kind /= kind_blank .and. rule%kind /= kind_word) words = words//', or blank'
   end function expectation


   !> 'above 0', 'of at least 0': a bound that is out or in.
   pure function bound(out, in, value, is_out) result(words)
      character(*), intent(in)  :: out, in
      real(wp), intent(in)      :: value
      logical, intent(in)       :: is_out
      character(:), allocatable :: words

      words = in
      if (is_out) words = out
      words = words//' '//real_text(value)
   end function bound


   !> '|STEP|BACK|' as 'STEP, BACK'.
   pure function list_of(words) result(list)
      character(*), intent(in)  :: words
      character(:), allocatable :: list
      integer :: i

      list = ''
      do i = 2, len(words) - 1
         if (words(i:i) == '|') then
            list = list//', '
         else
            list = list//words(i:i)
         end if
      end do
   end function list_of


   pure logical function is_zero(text)
      character(*), intent(in) :: text

      is_zero = verify(trim(text), '0.+-') == 0 .and. index(text, '0') > 0
   end function is_zero


   !> Whether COMPONENTS is a list of NASTRAN's degrees of freedom: different digits of 1 to 6.
   pure logical function is_component_list(components)
      integer, intent(in) :: components
      integer :: rest, digit
      logical :: seen(6)

      seen = .false.
      is_component_list = .false.
      rest = components
      if (rest <= 0) return
      do while (rest > 0)
         digit = modulo(rest, 10)
         if (digit < 1 .or. digit > 6) return
         if (seen(digit)) return
         seen(digit) = .true.
         rest = rest/10
      end do
      is_component_list = .true.
   end function is_component_list

end module card_fields
