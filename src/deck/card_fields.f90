!> Takes the data fields of a card one after another and checks each against its rule.
!! One line gives the name of a field, its rule and the component that the field fills:
!! `call card%field('EU', jnorm%law%e_u, positive, default=0.0_wp)`. The type of the component selects integer or real.
module card_fields
   use deck_cards, only: card_type
   use deck_errors, only: deck_error_list
   use field_rules, only: any_real, at_least_1, component_words, drop_blanks, in_range, integer_fault, is_component_list, is_zero, &
                          largest_size, list_of, number_of, parse_integer, parse_real, real_fault, real_range, &
                          real_words, smallest_size
   use kinds, only: wp
   use nastran_words, only: is_own_card
   use text_tools, only: integer_text, one_of
   implicit none
   private

   !> Ranges of identification numbers, FIRST(k) THRU LAST(k).
   type, public :: id_ranges
      integer, allocatable :: first(:), last(:), at(:) !! AT(k): data field of FIRST(k)
   end type id_ranges

   !> A card of which one field after another is taken.
   type, extends(card_type), public :: card_fields_type
      integer :: i = 0                               !! index of the array entry to fill; a routine that fills several increases it
      character(8), allocatable :: names(:)          !! names of the fields, as far as cards of this kind have been read
      type(deck_error_list), pointer :: errors => null()
      integer, private :: k = 0                      ! field taken last
      integer, private :: errors_before = 0          ! number of errors before the first field was taken
   contains
      procedure :: begin
      procedure, private :: integer_field, integer_fields, real_field, real_fields
      generic   :: field => integer_field, integer_fields, real_field, real_fields
      procedure :: components, word, blank, skip, finish, must_be_blank
      procedure :: text_at, given, is_faulty, error, error_at, wrong_entry, integer_at, real_at
      procedure :: check_direction, list_ranges
   end type card_fields_type

contains

   !> Begin with the first field of a card that has been read.
   subroutine begin(self)
      class(card_fields_type), intent(inout) :: self

      if (.not. allocated(self%names)) allocate (self%names(0))
      self%i = self%i + 1
      self%k = 0
      self%errors_before = self%errors%n
   end subroutine begin

   !> Advance to the next field, NAME, and find whether it IS_GIVEN.
   subroutine go_on(self, name, is_given)
      type(card_fields_type), intent(inout) :: self
      character(*), intent(in)              :: name
      logical, intent(out)                  :: is_given

      self%k = self%k + 1
      is_given = self%k <= self%n
      if (is_given) is_given = self%fields(self%k)%length > 0
      if (self%k > size(self%names)) self%names = [character(8) :: self%names, name]
   end subroutine go_on

   !> Take the integer VALUE from the next field, an id of at least 1 unless LEAST and MOST are present. It is required without DEFAULT;
   !! 0 passes for blank where it is the DEFAULT of a card of NASTRAN.
   subroutine integer_field(self, name, value, default, least, most)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: name !! as in the card manual
      integer, intent(out)                   :: value
      integer, intent(in), optional          :: default, least, most
      integer :: bounds(2)
      logical :: is_given, ok

      call go_on(self, name, is_given)
      bounds = at_least_1
      if (present(least)) bounds(1) = least
      if (present(most)) bounds(2) = most
      if (present(default) .and. is_given) then
         if (default == 0 .and. self%fields(self%k)%text == '0') is_given = is_own_card(self%name)
      end if
      if (present(default) .and. .not. is_given) then
         value = default
      else
         call self%integer_at(self%k, name, value, ok, bounds, or_blank=present(default))
      end if
   end subroutine integer_field

   !> Take the next fields by the same rule.
   subroutine integer_fields(self, names, values, default, least, most)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: names(:)
      integer, intent(out)                   :: values(:)
      integer, intent(in), optional          :: default, least, most
      integer :: i

      do i = 1, size(names)
         call self%integer_field(names(i), values(i), default, least, most)
      end do
   end subroutine integer_fields

   !> Take the real VALUE in RANGE from the next field; with WHOLE it may be an integer. DEFAULT is as above.
   subroutine real_field(self, name, value, range, default, whole)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: name
      real(wp), intent(out)                  :: value
      type(real_range), intent(in), optional :: range   !! default: any
      real(wp), intent(in), optional         :: default
      logical, intent(in), optional          :: whole
      integer :: number
      logical :: is_given, ok

      call go_on(self, name, is_given)
      ok = .false.
      if (is_given .and. present(default) .and. present(range)) then
         if (range%above .and. .not. abs(default) > 0.0_wp) is_given = is_own_card(self%name) .or. &
                                                                     .not. is_zero(self%text_at(self%k))
      end if
      if (is_given .and. present(whole)) then
         call parse_integer(self%fields(self%k)%text, number, ok)
         value = real(number, wp)
      end if
      if (.not. ok .and. (is_given .or. .not. present(default))) &
         call self%real_at(self%k, name, value, ok, range, or_blank=present(default))
      if (.not. ok .and. present(default)) value = default
   end subroutine real_field

   !> Take the next fields by the same rule.
   subroutine real_fields(self, names, values, range, default, whole)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: names(:)
      real(wp), intent(out)                  :: values(:)
      type(real_range), intent(in), optional :: range
      real(wp), intent(in), optional         :: default
      logical, intent(in), optional          :: whole
      integer :: i

      do i = 1, size(names)
         call self%real_field(names(i), values(i), range, default, whole)
      end do
   end subroutine real_fields

   !> Take a list of NASTRAN's components from the next field, as 123 or 1 2 3. It is required without DEFAULT; with it 0 is blank.
   subroutine components(self, name, value, default)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: name
      integer, intent(out)                   :: value
      integer, intent(in), optional          :: default
      logical :: is_given, ok

      call go_on(self, name, is_given)
      if (is_given) call drop_blanks(self%fields(self%k)%text, self%fields(self%k)%length)
      if (is_given .and. present(default)) is_given = self%fields(self%k)%text /= '0'
      if (present(default) .and. .not. is_given) then
         value = default
      else
         call self%integer_at(self%k, name, value, ok, or_blank=present(default), expected=component_words)
      end if
   end subroutine components

   !> Take one of the WORDS, '|ARITH|GEOM|LIST|', from the next field; a blank field is the first word.
   subroutine word(self, name, words, value)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: name, words
      character(8), intent(out)              :: value
      character(:), allocatable :: text
      logical :: is_given

      call go_on(self, name, is_given)
      if (is_given) then
         text = self%text_at(self%k)
         value = text
         if (index(words, '|'//text//'|') == 0 .or. index(text, '|') > 0) &
            call self%wrong_entry(self%k, name, 'is out of range, expected one of '//list_of(words, ', '))
      else
         value = words(2:index(words(2:), '|'))
      end if
   end subroutine word

   !> The next fields must stay blank; NAMES are their names in NASTRAN. A zero counts as blank.
   subroutine blank(self, names)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: names(:)
      integer :: i
      logical :: is_given

      do i = 1, size(names)
         call go_on(self, names(i), is_given)
         if (is_given .and. .not. is_zero(self%text_at(self%k))) &
            call self%wrong_entry(self%k, names(i), 'where the field must be blank')
      end do
   end subroutine blank

   !> Skip the next fields: the routine of the card takes them, or they have no effect.
   subroutine skip(self, names)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: names(:)
      integer :: i
      logical :: is_given

      do i = 1, size(names)
         call go_on(self, names(i), is_given)
      end do
   end subroutine skip

   !> The card must be blank after the fields taken. LINE is its first line.
   subroutine finish(self, line)
      class(card_fields_type), intent(inout) :: self
      integer, intent(out)                   :: line

      line = self%line
      call self%must_be_blank(self%k + 1, self%n, '')
   end subroutine finish

   !> The data fields FIRST to LAST must be blank or zero; WHY ends the message.
   subroutine must_be_blank(self, first, last, why)
      class(card_fields_type), intent(inout) :: self
      integer, intent(in)                    :: first, last
      character(*), intent(in)               :: why
      integer :: k

      do k = first, min(last, self%n)
         if (self%fields(k)%length == 0 .or. is_zero(self%text_at(k))) cycle
         call self%error_at(k, ''''//self%text_at(k)//''' where the field must be blank'//why)
      end do
   end subroutine must_be_blank

   !> The entry of data field K, empty where there is none.
   pure function text_at(self, k) result(text)
      class(card_fields_type), intent(in) :: self
      integer, intent(in)                 :: k
      character(:), allocatable           :: text

      text = ''
      if (k <= self%n) text = trim(self%fields(k)%text)
   end function text_at

   !> Whether the field with this NAME is filled.
   elemental logical function given(self, name)
      class(card_fields_type), intent(in) :: self
      character(*), intent(in)            :: name
      integer :: k

      k = number_of(self%names, name)
      given = k <= self%n
      if (given) given = self%fields(k)%length > 0
   end function given

   !> Whether an entry of the card so far was wrong.
   pure logical function is_faulty(self)
      class(card_fields_type), intent(in) :: self

      is_faulty = self%errors%n > self%errors_before
   end function is_faulty

   !> Add an error about the field NAME.
   subroutine error(self, name, message)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: name, message

      call self%error_at(number_of(self%names, name), name//': '//message)
   end subroutine error

   !> Add an error about data field K.
   subroutine error_at(self, k, message)
      class(card_fields_type), intent(inout) :: self
      integer, intent(in)                    :: k
      character(*), intent(in)               :: message

      call self%field_error(k, message, self%errors)
   end subroutine error_at

   !> Add an error about data field K, NAME: its entry, followed by WORDS.
   subroutine wrong_entry(self, k, name, words)
      class(card_fields_type), intent(inout) :: self
      integer, intent(in)                    :: k
      character(*), intent(in)               :: name, words

      call self%error_at(k, trim(name)//': '''//trim(self%fields(k)%text)//''' '//words)
   end subroutine wrong_entry

   !> The integer in data field K, NAME, within BOUNDS. If there is none, VALUE is 0, OK is false, and an error says what was
   !! EXPECTED. Where this is COMPONENT_WORDS the integer must be a list of components.
   subroutine integer_at(self, k, name, value, ok, bounds, or_blank, expected)
      class(card_fields_type), intent(inout) :: self
      integer, intent(in)                    :: k
      character(*), intent(in)               :: name
      integer, intent(out)                   :: value
      logical, intent(out)                   :: ok
      integer, intent(in), optional          :: bounds(2) !! least and most, huge: no most; default: any
      logical, intent(in), optional          :: or_blank  !! the error adds that the field may be blank; default: false
      character(*), intent(in), optional     :: expected  !! default: BOUNDS in words
      character(:), allocatable :: words
      logical :: is_integer

      value = 0
      is_integer = .false.
      if (k <= self%n) call parse_integer(self%fields(k)%text(:self%fields(k)%length), value, is_integer)
      ok = is_integer
      if (present(bounds)) ok = ok .and. value >= bounds(1) .and. value <= bounds(2)
      if (present(expected) .and. ok) then
         if (expected == component_words) ok = is_component_list(value)
      end if
      if (ok) return
      value = 0
      if (present(expected)) then
         words = expected
      else if (bounds(2) < huge(1)) then
         words = 'an integer from '//integer_text(bounds(1))//' to '//integer_text(bounds(2))
      else
         words = 'an integer of '//integer_text(bounds(1))//' or more'
      end if
      if (present(or_blank)) words = words//one_of(or_blank, ', or blank', '')
      call self%error_at(k, trim(name)//': '//integer_fault(self%text_at(k), is_integer, words))
   end subroutine integer_at

   !> The real in data field K, NAME, in RANGE. It must not be so large that a stiffness, area or volume overflows, nor, where it must be
   !! positive, so small that it vanishes beside others. If there is none, VALUE is 0, OK is false, and an error says what was EXPECTED.
   subroutine real_at(self, k, name, value, ok, range, or_blank, expected)
      class(card_fields_type), intent(inout) :: self
      integer, intent(in)                    :: k
      character(*), intent(in)               :: name
      real(wp), intent(out)                  :: value
      logical, intent(out)                   :: ok
      type(real_range), intent(in), optional :: range    !! default: any
      logical, intent(in), optional          :: or_blank !! the error adds that the field may be blank; default: false
      character(*), intent(in), optional     :: expected !! default: RANGE in words
      type(real_range) :: within
      character(:), allocatable :: words
      logical :: is_real

      within = any_real
      if (present(range)) within = range
      value = 0.0_wp
      is_real = .false.
      if (k <= self%n) call parse_real(self%fields(k)%text, value, is_real)
      ok = is_real .and. in_range(within, value) .and. abs(value) <= largest_size
      if (within%above .and. within%least >= 0.0_wp) ok = ok .and. value >= smallest_size
      if (ok) return
      words = real_words(within)
      if (present(expected)) words = expected
      if (present(or_blank)) words = words//one_of(or_blank, ', or blank', '')
      call self%error_at(k, trim(name)//': '//real_fault(self%text_at(k), value, is_real, within, words))
      value = 0.0_wp
   end subroutine real_at

   !> The numbers in the data fields from FROM on, with ranges G1 THRU G2. NAME is the name of the field in the manual, WHAT describes
   !! it: 'a node number'.
   subroutine list_ranges(self, from, name, what, ranges)
      class(card_fields_type), intent(inout) :: self
      integer, intent(in)                    :: from
      character(*), intent(in)               :: name, what
      type(id_ranges), intent(inout)         :: ranges
      integer :: k, n, value
      logical :: ok, through

      allocate (ranges%first(self%n), ranges%last(self%n), ranges%at(self%n), source=0)
      n = 0
      through = .false.
      do k = from, self%n
         if (self%text_at(k) == '') cycle
         if (self%text_at(k) == 'THRU') then
            if (n == 0 .or. through .or. k == self%n) call self%error_at(k, 'THRU: expected '//name//'1 THRU '//name//'2')
            through = .true.
            cycle
         end if
         call self%integer_at(k, name, value, ok, expected=what//' or THRU')
         if (.not. ok) cycle
         if (value < 1) call self%error_at(k, name//': '''//integer_text(value)//''' is no '//what(index(what, ' ') + 1:))
         if (through) then
            through = .false.
            if (n == 0) cycle
            ranges%last(n) = value
            if (value < ranges%first(n)) call self%error_at(k, name//': THRU goes down, expected '// &
                                                            integer_text(ranges%first(n))//' or more')
         else
            n = n + 1
            ranges%first(n) = value
            ranges%last(n) = value
            ranges%at(n) = k
         end if
      end do
      if (n == 0 .and. self%n < from) call self%error_at(from, name//'1: blank, expected '//what)
      ranges%first = ranges%first(:n)
      ranges%last = ranges%last(:n)
      ranges%at = ranges%at(:n)
   end subroutine list_ranges

   !> The direction of WHAT, in three fields from FIRST on, must not be zero.
   subroutine check_direction(self, first, what, direction)
      class(card_fields_type), intent(inout) :: self
      character(*), intent(in)               :: first, what
      real(wp), intent(in)                   :: direction(3)
      integer :: k

      if (self%is_faulty() .or. any(abs(direction) > 0.0_wp)) return
      k = number_of(self%names, first)
      call self%error(first, what//' has no direction, expected '//trim(self%names(k))//', '//trim(self%names(k + 1))// &
                      ', '//trim(self%names(k + 2))//' not all zero')
   end subroutine check_direction

end module card_fields
