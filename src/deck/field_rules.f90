!> Reads numbers as NASTRAN writes them (12, 1., -.5, 7.0E+1, 1.D-3, 1.5-3) and applies the rules of fields.
!!
!! A rule is a range of numbers, a list of words or a list of components. Each rule, and each fault of an entry, can be put into
!! words.
module field_rules
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_null_char, c_null_ptr, c_ptr
   use kinds, only: long, wp
   use text_tools, only: integer_text, one_of, real_text
   implicit none
   private

   public :: parse_integer, parse_real, integer_fault, real_fault, real_words, in_range, is_component_list, has_component, &
             list_of, is_zero, drop_blanks, number_of

   integer, parameter :: most_digits = 15, max_exact = 22 ! numbers of so many digits, and 10**22, are exact in real(wp)
   integer :: k
   real(wp), parameter :: power_of_ten(0:max_exact) = [(10.0_wp**k, k = 0, max_exact)]

   real(wp), parameter, public :: largest_size = 1.0e75_wp   !! of a number in a deck: its fourth power is still finite
   real(wp), parameter, public :: smallest_size = 1.0e-75_wp !! of a number that must be positive

   !> Range of a real number.
   type, public :: real_range
      real(wp) :: least = -huge(1.0_wp), most = huge(1.0_wp)
      logical  :: above = .false., below = .false. !! LEAST itself is excluded, MOST is excluded
   end type real_range

   integer, parameter, public :: at_least_1(2) = [1, huge(1)] !! bounds of an integer
   type(real_range), parameter, public :: any_real = real_range(), positive = real_range(0.0_wp, above=.true.), &
                                          not_negative = real_range(0.0_wp)
   character(*), parameter, public :: component_words = 'a list of components, different digits of 1 to 6'

   interface
      !> The correctly rounded number in TEXT, which a null character ends. END may be null.
      pure real(c_double) function strtod(text, end) bind(c, name='strtod')
         import :: c_char, c_double, c_ptr
         character(kind=c_char), intent(in) :: text(*)
         type(c_ptr), value, intent(in)     :: end
      end function strtod
   end interface

contains

   !> The integer in TEXT (no blanks inside or in front). OK is false for anything else and for more than 32 bits.
   pure subroutine parse_integer(text, value, ok)
      character(*), intent(in) :: text
      integer, intent(out)     :: value
      logical, intent(out)     :: ok
      integer(long) :: total
      integer :: i, digit, first, length

      value = 0
      ok = .false.
      length = len_trim(text)
      if (length == 0) return
      first = 1
      if (text(1:1) == '+' .or. text(1:1) == '-') first = 2
      if (first > length) return
      total = 0
      do i = first, length
         digit = iachar(text(i:i)) - iachar('0')
         if (digit < 0 .or. digit > 9) return
         total = 10*total + digit
         if (total > huge(value)) return
      end do
      value = int(total)
      if (text(1:1) == '-') value = -value
      ok = .true.
   end subroutine parse_integer

   !> The real number in TEXT, correctly rounded. It needs a decimal point or an E or D, as in NASTRAN: `12` is an integer. OK is false
   !! for anything else, for a number too large for a real64, and for a nonzero number that would become zero.
   pure subroutine parse_real(text, value, ok)
      character(*), intent(in) :: text
      real(wp), intent(out)    :: value
      logical, intent(out)     :: ok
      integer(long) :: mantissa
      integer :: i, length, digits, decimals, exponent, digit
      logical :: point, any_digit
      character(48) :: plain

      value = 0.0_wp
      ok = .false.
      length = len_trim(text)
      if (length == 0 .or. length > 32) return
      i = 1
      if (text(1:1) == '+' .or. text(1:1) == '-') i = 2
      mantissa = 0; digits = 0; decimals = 0
      point = .false.; any_digit = .false.
      do while (i <= length)
         digit = iachar(text(i:i)) - iachar('0')
         if (digit >= 0 .and. digit <= 9) then
            any_digit = .true.
            if (digits > 0 .or. digit > 0) digits = digits + 1
            if (digits <= most_digits) mantissa = 10*mantissa + digit
            if (point) decimals = decimals + 1
         else if (text(i:i) == '.' .and. .not. point) then
            point = .true.
         else
            exit
         end if
         i = i + 1
      end do
      if (.not. any_digit) return
      exponent = 0
      ok = point
      if (i <= length) then ! E or D and an integer, or a signed integer alone
         select case (text(i:i))
         case ('E', 'D', 'e', 'd')
            call parse_integer(text(i + 1:length), exponent, ok)
         case ('+', '-')
            if (point) call parse_integer(text(i:length), exponent, ok)
         case default
            ok = .false.
         end select
         ok = ok .and. abs(exponent) < 10000
      end if
      if (.not. ok) return
      if (digits <= most_digits .and. abs(exponent - decimals) <= max_exact) then
         if (exponent >= decimals) then
            value = real(mantissa, wp)*power_of_ten(exponent - decimals)
         else
            value = real(mantissa, wp)/power_of_ten(decimals - exponent)
         end if
         if (text(1:1) == '-') value = -value
         return
      end if
      plain = text(:length)//c_null_char
      ! the letter may be D or none
      if (i <= length) plain = text(:i - 1)//'E'//text(i + verify(text(i:i), '+-'):length)//c_null_char
      value = strtod(plain, c_null_ptr)
      ok = ieee_is_finite(value) .and. .not. (abs(value) < tiny(value) .and. digits > 0)
   end subroutine parse_real

   !> Why TEXT is not the EXPECTED integer.
   pure function integer_fault(text, is_integer, expected) result(words)
      character(*), intent(in)  :: text, expected
      logical, intent(in)       :: is_integer !! but not the expected one
      character(:), allocatable :: words

      if (text == '') then
         words = 'blank'
      else if (is_integer) then
         words = ''''//text//''' is out of range'
      else if (is_number_shape(text, '0123456789+-') .and. scan(text(2:), '+-') == 0) then
         words = ''''//text//''' is too large for an integer'
      else
         words = ''''//text//''' is not an integer'
      end if
      words = words//', expected '//expected
   end function integer_fault

   !> Why TEXT is not the EXPECTED real number, or not one of a size to compute with.
   pure function real_fault(text, value, is_real, range, expected) result(words)
      character(*), intent(in)     :: text, expected
      real(wp), intent(in)         :: value   !! of TEXT
      logical, intent(in)          :: is_real !! TEXT is a real number
      type(real_range), intent(in) :: range
      character(:), allocatable    :: words
      integer :: whole
      logical :: is_integer

      call parse_integer(text, whole, is_integer)
      if (text == '') then
         words = 'blank, expected '//expected
      else if (is_real .and. .not. in_range(range, value)) then
         words = ''''//text//''' is out of range, expected '//expected
      else if (is_real .and. abs(value) > largest_size) then
         words = ''''//text//''' is too large to compute with, expected no more than '//real_text(largest_size)
      else if (is_real) then
         words = ''''//text//''' is too small to compute with, expected at least '//real_text(smallest_size)
      else if (is_number_shape(text, '0123456789.+-ED') .and. scan(text, '.ED') > 0) then
         words = ''''//text//''' is too large or too small for a real number, or not one, expected '//expected
      else if (is_integer) then
         words = ''''//text//''' is an integer, expected '//expected//': write it with a decimal point'
      else
         words = ''''//text//''' is not a real number, expected '//expected
      end if
   end function real_fault

   !> Whether TEXT consists of LETTERS only and begins and ends like a number.
   pure logical function is_number_shape(text, letters)
      character(*), intent(in) :: text, letters

      is_number_shape = index(text, '.') == index(text, '.', back=.true.) .and. &
                        verify(trim(text), letters) == 0 .and. scan(text(1:1), '0123456789+-.') == 1 .and. &
                        scan(text(len_trim(text):len_trim(text)), '0123456789.') == 1
   end function is_number_shape

   !> The words for a real in RANGE.
   pure function real_words(range) result(words)
      type(real_range), intent(in) :: range
      character(:), allocatable    :: words

      words = 'a real number'
      associate (has_least => range%least > -huge(1.0_wp), has_most => range%most < huge(1.0_wp))
         if (has_least) words = words//one_of(range%above, ' above', ' of at least')//' '//real_text(range%least)
         if (has_least .and. has_most) words = words//' and'
         if (has_most) words = words//one_of(range%below, ' below', ' at most')//' '//real_text(range%most)
      end associate
   end function real_words

   !> Whether VALUE is in RANGE.
   pure logical function in_range(range, value)
      type(real_range), intent(in) :: range
      real(wp), intent(in)         :: value

      in_range = value >= range%least .and. value <= range%most
      if (range%above) in_range = in_range .and. value > range%least
      if (range%below) in_range = in_range .and. value < range%most
   end function in_range

   !> WORDS = '|STEP|BACK|' as a list with this SEPARATOR.
   pure function list_of(words, separator) result(list)
      character(*), intent(in)  :: words, separator
      character(:), allocatable :: list
      integer :: i

      list = ''
      do i = 2, len(words) - 1
         if (words(i:i) == '|') then
            list = list//separator
         else
            list = list//words(i:i)
         end if
      end do
   end function list_of

   !> Whether COMPONENTS is a list of NASTRAN's degrees of freedom: different digits of 1 to 6.
   pure logical function is_component_list(components)
      integer, intent(in) :: components
      character(:), allocatable :: digits
      integer :: i

      digits = integer_text(components)
      is_component_list = verify(digits, '123456') == 0 .and. all([(index(digits, digits(i:i)) == i, i = 1, len(digits))])
   end function is_component_list

   !> Whether TEXT is a zero, which passes for a blank.
   pure logical function is_zero(text)
      character(*), intent(in) :: text

      is_zero = verify(text, '0.+-') == 0 .and. index(text, '0') > 0
   end function is_zero

   !> Position of FIELD among the NAMES of fields. A name that is not there is an error of the source.
   pure integer function number_of(names, field)
      character(8), intent(in) :: names(:)
      character(*), intent(in) :: field

      number_of = findloc(names, field, dim=1)
      if (number_of == 0) error stop 'no card has a field '//field
   end function number_of

   !> Take the blanks out of TEXT of this LENGTH.
   pure subroutine drop_blanks(text, length)
      character(*), intent(inout) :: text
      integer, intent(inout)      :: length
      integer :: i

      do i = length, 1, -1
         if (text(i:i) == ' ') text(i:) = text(i + 1:)
      end do
      length = len_trim(text)
   end subroutine drop_blanks

   !> Whether digit D, 1 to 6, is among COMPONENTS.
   elemental logical function has_component(components, d)
      integer, intent(in) :: components, d
      integer :: k

      has_component = any([(modulo(components/10**k, 10) == d, k = 0, 5)])
   end function has_component

end module field_rules
