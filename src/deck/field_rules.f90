!> Reads numbers as NASTRAN writes them (12, 1., -.5, 7.0E+1, 1.D-3, 1.5-3) and applies the rules of fields.
!!
!! A rule is a range of numbers, a list of words or a list of components. Each rule can be put into words.
module field_rules
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_null_char, c_null_ptr, c_ptr
   use kinds, only: long, wp
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: parse_integer, parse_real, integer_words, real_words, blank_words, in_range, is_component_list, list_of

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
      if (i <= length) call parse_exponent(text(i:length), point, exponent, ok)
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
      if (i <= length) plain = text(:i - 1)//'E'//text(i + verify(text(i:i), '+-'):length)//c_null_char ! the letter may be D or none
      value = strtod(plain, c_null_ptr)
      ok = ieee_is_finite(value) .and. .not. (abs(value) < tiny(value) .and. digits > 0)
   end subroutine parse_real

   !> The exponent after the mantissa: E or D and an integer, or a signed integer alone.
   pure subroutine parse_exponent(text, point, exponent, ok)
      character(*), intent(in) :: text
      logical, intent(in)      :: point !! the mantissa has a decimal point
      integer, intent(out)     :: exponent
      logical, intent(out)     :: ok

      exponent = 0
      ok = .false.
      select case (text(1:1))
      case ('E', 'D', 'e', 'd')
         call parse_integer(text(2:), exponent, ok)
      case ('+', '-')
         if (point) call parse_integer(text, exponent, ok)
      end select
      ok = ok .and. abs(exponent) < 10000
   end subroutine parse_exponent

   !> The words for an integer from LEAST to MOST.
   pure function integer_words(least, most) result(words)
      integer, intent(in)           :: least
      integer, intent(in), optional :: most !! default: no limit
      character(:), allocatable     :: words

      words = 'an integer of '//integer_text(least)//' or more'
      if (present(most)) words = 'an integer from '//integer_text(least)//' to '//integer_text(most)
   end function integer_words

   !> The words for a real in RANGE.
   pure function real_words(range) result(words)
      type(real_range), intent(in) :: range
      character(:), allocatable    :: words

      words = 'a real number'
      associate (has_least => range%least > -huge(1.0_wp), has_most => range%most < huge(1.0_wp))
         if (has_least) words = words//trim(merge(' above      ', ' of at least', range%above))//' '//real_text(range%least)
         if (has_least .and. has_most) words = words//' and'
         if (has_most) words = words//trim(merge(' below  ', ' at most', range%below))//' '//real_text(range%most)
      end associate
   end function real_words

   !> The end of the words for what is expected where the field may be empty.
   pure function blank_words(or_blank) result(words)
      logical, intent(in), optional :: or_blank !! default: false
      character(:), allocatable     :: words

      words = ''
      if (present(or_blank)) words = trim(merge(', or blank', repeat(' ', 10), or_blank))
   end function blank_words

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

end module field_rules
