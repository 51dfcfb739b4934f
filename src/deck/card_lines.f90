!> A card, and a line of it cut into fields: small field (8 columns), large field (16), free field (commas).
!!
!! The one routine that reads a card by its table, and what it says of fields that do not keep to it.
module card_lines
   use deck_errors, only: deck_error_list
   use field_rules, only: parse_integer, parse_real, expectation, field_rule, in_range, kind_blank, kind_components, &
                          kind_integer, kind_real, kind_word
   use kinds, only: wp
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: cut_line, decode_card, decode_integer, decode_real

   integer, parameter, public :: field_width = 32 !! longest entry of a field (free field only)
   integer, parameter :: blank = iachar(' ')      ! codes are compared at once, characters by a call of the library

   !> One entry of a card and where it stands.
   type, public :: card_field
      character(field_width) :: text = ''  ! raised to capitals, left-justified
      integer :: length = 0                ! of the text
      integer :: line  = 0                 ! index in the deck text
      integer :: first = 0, last = 0       ! columns of the field
   end type card_field

   !> One card: its name and its data fields 1..n, field 1 being NASTRAN's field 2; each line of a card (each pair
   !! of lines in large field) gives eight, blank ones included up to the last entry.
   type, public :: card_type
      character(8) :: name = ''
      integer :: line = 0                    !! index of its first line
      integer :: n    = 0
      type(card_field), allocatable :: fields(:)
      character(8) :: marker = ''            !! what stands in field 10 of the line that was cut last
      logical, private :: half = .false.     ! that line is large field and waits for its second half
   contains
      procedure :: start
      procedure :: where_is
      procedure :: field_error
   end type card_type

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

   !> Make SELF the card that begins on LINE, without its name and fields yet.
   subroutine start(self, line)
      class(card_type), intent(inout) :: self
      integer, intent(in)             :: line

      self%line = line
      self%n = 0
      self%marker = ''
      self%half = .false.
      if (.not. allocated(self%fields)) allocate (self%fields(64))
   end subroutine start

   !> Cut one line into fields and put them at the end of CARD.
   recursive subroutine cut_line(line, comma, at, has_tabs, card, errors)
      character(*), intent(in)             :: line     !! its card part
      integer, intent(in)                  :: comma    !! column of its first comma, 0: none
      integer, intent(in)                  :: at       !! its index in the deck text
      logical, intent(in)                  :: has_tabs !! there may be tabs in it
      type(card_type), intent(inout)       :: card
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: plain
      integer :: tab
      logical :: large

      if (has_tabs) then
         tab = index(line, achar(9))
         if (tab > 0) then
            call errors%add(at, 'a tab in column '//integer_text(tab)//': expected blanks, fields are columns of eight', tab, tab)
            plain = without_tabs(line)
            call cut_line(plain, index(plain, ','), at, .false., card, errors)
            return
         end if
      end if
      card%marker = ''
      large = index(line(:merge(comma - 1, min(8, len(line)), comma > 0)), '*') > 0
      if (card%half .and. .not. large) then
         do while (modulo(card%n, 8) /= 0) ! the second half of a large-field line is not there
            call push(card, '', at, 0, 0, errors)
         end do
      end if
      if (comma > 0) then
         call cut_free(line, comma, at, card, large, errors)
      else
         call cut_fixed(line, at, card, large, errors)
      end if
      card%half = large .and. modulo(card%n, 8) == 4
   end subroutine cut_line

   !> TEXT with its tabs as blanks up to the next field, so that one tab makes one error.
   pure function without_tabs(text) result(plain)
      character(*), intent(in)  :: text
      character(:), allocatable :: plain
      integer :: i

      plain = ''
      do i = 1, len(text)
         if (text(i:i) == achar(9)) then
            plain = plain//repeat(' ', 8 - modulo(len(plain), 8))
         else
            plain = plain//text(i:i)
         end if
         if (len(plain) > 1000) return
      end do
   end function without_tabs

   !> Fixed fields: eight of 8 columns, or four of 16, behind the name; columns 73-80 are the continuation mark.
   subroutine cut_fixed(line, at, card, large, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(card_type), intent(inout)       :: card
      logical, intent(in)                  :: large
      type(deck_error_list), intent(inout) :: errors
      integer :: width, k, first, last

      if (len(line) > 80) then
         call errors%add(at, 'text past column 80: expected at most ten fields of eight columns', 81, len(line))
      end if
      width = merge(16, 8, large)
      do k = 1, 64/width
         first = 9 + (k - 1)*width
         last = first + width - 1
         if (first <= len(line)) then
            call push(card, line(first:min(last, len(line))), at, first, last, errors)
         else
            call push(card, '', at, first, last, errors)
         end if
      end do
      if (len(line) <= 72) return
      card%marker = adjustl(line(73:min(80, len(line))))
      if (card%marker /= '' .and. scan(card%marker(1:1), '+*') == 0) call errors%add(at, ''''//trim(card%marker)// &
         ''' in columns 73 to 80: expected a continuation mark that begins with + or *, or blanks', 73, min(80, len(line)))
   end subroutine cut_fixed

   !> Free field: entries between commas, eight (large: four) of them, and one more for the continuation mark.
   subroutine cut_free(line, comma, at, card, large, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      type(card_type), intent(inout)       :: card
      logical, intent(in)                  :: large
      type(deck_error_list), intent(inout) :: errors
      integer :: k, first, last, most

      most = merge(4, 8, large)
      first = comma + 1
      do k = 1, most
         last = min(first - 1, len(line))
         do while (last < len(line))
            if (line(last + 1:last + 1) == ',') exit
            last = last + 1
         end do
         call push(card, line(first:last), at, first, max(first, last), errors)
         first = last + 2
      end do
      if (first > len(line)) return
      card%marker = adjustl(line(first:))
      if (index(line(first:), ',') > 0 .or. scan(card%marker(1:1), '+*') == 0) then
         call errors%add(at, 'more than '//integer_text(most)//' entries behind the name: go on in a continuation line', &
                         first, len(line))
      end if
   end subroutine cut_free

   !> One more field: ENTRY without the blanks around it, in capitals.
   subroutine push(card, entry, at, first, last, errors)
      type(card_type), intent(inout)       :: card
      character(*), intent(in)             :: entry
      integer, intent(in)                  :: at, first, last
      type(deck_error_list), intent(inout) :: errors
      type(card_field), allocatable :: wider(:)
      integer :: from, to, i, code

      if (card%n == size(card%fields)) then
         allocate (wider(2*card%n))
         wider(:card%n) = card%fields
         call move_alloc(wider, card%fields)
      end if
      card%n = card%n + 1
      from = 1
      do while (from <= len(entry))
         if (iachar(entry(from:from)) /= blank) exit
         from = from + 1
      end do
      to = len(entry)
      do while (to >= from)
         if (iachar(entry(to:to)) /= blank) exit
         to = to - 1
      end do
      associate (field => card%fields(card%n))
         field%line = at
         field%first = first
         field%last = last
         field%length = min(to - from + 1, field_width)
         field%text = ''
         do i = 1, field%length
            code = iachar(entry(from + i - 1:from + i - 1))
            if (code >= iachar('a') .and. code <= iachar('z')) code = code - 32
            field%text(i:i) = achar(code)
         end do
      end associate
      if (to - from + 1 > field_width) call errors%add(at, card%where_is(card%n)//': an entry of more than '// &
                                                       integer_text(field_width)//' characters', first, last)
   end subroutine push

   !> Words for data field K: 'CQUAD4, field 7'; NASTRAN counts 2 to 9 on every line of a card.
   pure function where_is(self, k) result(words)
      class(card_type), intent(in) :: self
      integer, intent(in)          :: k
      character(:), allocatable    :: words

      words = trim(self%name)//', field '//integer_text(modulo(k - 1, 8) + 2)
      if (k > 8) words = words//' of continuation '//integer_text((k - 1)/8)
   end function where_is

   !> An error about data field K, its place and columns taken from the card.
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

end module card_lines
