!> Numbers as NASTRAN writes them: 12, 1., -.5, 7.0E+1, 1.D-3, 1.5-3.
!!
!! The rules that the table of a card is made of: one a field, with what the field may hold, and the same in words. Of
!! several names a rule makes as many fields alike.
module field_rules
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: long, wp
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: parse_integer, parse_real, integer_field, real_field, word_field, blank_field, any_field, component_field, &
             in_range, expectation, list_of

   integer, parameter :: quad = selected_real_kind(33)
   integer, parameter :: most_digits = 15, max_exact = 22           ! so many digits and 10**22 are exact in real(wp),
   integer, parameter :: most_digits_quad = 18, max_exact_quad = 48 ! these in integer(long) and real(quad)
   integer :: k
   real(wp), parameter :: power_of_ten(0:max_exact) = [(10.0_wp**k, k = 0, max_exact)]
   real(quad), parameter :: power_of_ten_quad(0:max_exact_quad) = [(10.0_quad**k, k = 0, max_exact_quad)]

   integer, parameter, public :: kind_integer = 1, kind_real = 2, kind_word = 3, kind_blank = 4, kind_components = 5, kind_any = 6

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

contains

   !> The integer in TEXT (no blanks inside or in front). OK is false for anything else, and beyond 32 bits.
   pure subroutine parse_integer(text, value, ok)
      character(*), intent(in) :: text
      integer, intent(out)     :: value
      logical, intent(out)     :: ok
      integer(long) :: total
      integer :: i, digit, first, length

      value = 0
      ok = .false.
      length = filled_length(text)
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

   !> The real number in TEXT. It needs a decimal point or an E or D, as in NASTRAN: `12` is an integer.
   !! OK is false for anything else, for a number too large for a real64, and for one so small that it would
   !! turn into zero. The value is correctly rounded.
   pure subroutine parse_real(text, value, ok)
      character(*), intent(in) :: text
      real(wp), intent(out)    :: value
      logical, intent(out)     :: ok
      integer(long) :: mantissa
      integer :: i, length, digits, decimals, exponent, digit, status
      logical :: point, any_digit
      character(48) :: plain

      value = 0.0_wp
      ok = .false.
      length = filled_length(text)
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
            if (digits <= most_digits_quad) mantissa = 10*mantissa + digit
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
      else if (digits <= most_digits_quad .and. abs(exponent - decimals) <= max_exact_quad) then
         call round_once(mantissa, exponent - decimals, value, ok)
         if (text(1:1) == '-') value = -value
         if (ok) return
      end if
      if (digits > 0 .and. digits + exponent - decimals > range(value) + 2) then ! the library would overflow
         ok = .false.
         return
      end if
      plain = text(:i - 1)
      write (plain(i:), '(a, i0)') 'E', exponent
      read (plain, *, iostat=status) value
      ok = status == 0
      if (ok) ok = ieee_is_finite(value) .and. .not. (abs(value) < tiny(value) .and. digits > 0)
   end subroutine parse_real

   !> VALUE = MANTISSA*10**EXPONENT by one operation of quadruple precision on exact operands, which is then rounded again. The
   !! second rounding errs only where the first ended in the middle between two reals: OK is false there.
   pure subroutine round_once(mantissa, exponent, value, ok)
      integer(long), intent(in) :: mantissa !! 0 to 10**18
      integer, intent(in)       :: exponent !! -48 to 48
      real(wp), intent(out)     :: value
      logical, intent(out)      :: ok
      real(quad) :: wide
      real(wp)   :: off ! how far VALUE is from it

      if (exponent >= 0) then
         wide = real(mantissa, quad)*power_of_ten_quad(exponent)
      else
         wide = real(mantissa, quad)/power_of_ten_quad(-exponent)
      end if
      value = real(wide, wp)
      off = abs(real(wide - real(value, quad), wp))
      ok = abs(off - 0.5_wp*spacing(value)) > 0.0_wp .and. abs(off - 0.25_wp*spacing(value)) > 0.0_wp ! 1/4: below a power of two
   end subroutine round_once

   !> What stands behind the mantissa: E or D and an integer, or a signed integer alone.
   pure subroutine parse_exponent(text, point, exponent, ok)
      character(*), intent(in) :: text
      logical, intent(in)      :: point !! whether the mantissa has a decimal point
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

   !> len_trim(TEXT), without a call of the library: for a comparison with a blank the compiler would put one in.
   pure integer function filled_length(text) result(length)
      character(*), intent(in) :: text

      length = len(text)
      do while (length > 0)
         if (iachar(text(length:length)) /= iachar(' ')) exit
         length = length - 1
      end do
   end function filled_length

   !> Rule for an integer: an id by default (1 and up).
   elemental function integer_field(name, default, least, most) result(rule)
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
   elemental function real_field(name, default, above, below, least, most, whole) result(rule)
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
   elemental function word_field(name, words) result(rule)
      character(*), intent(in) :: name, words
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_word
      rule%words = words
   end function word_field

   !> Rule for a list of NASTRAN's components: different digits of 1 to 6.
   elemental function component_field(name, default) result(rule)
      character(*), intent(in)      :: name
      integer, intent(in), optional :: default !! none: the field must be filled
      type(field_rule) :: rule

      rule = integer_field(name, default, least=1, most=654321)
      rule%kind = kind_components
   end function component_field

   !> Rule for a field that must stay blank (NAME says what NASTRAN has there); a zero is a blank too.
   elemental function blank_field(name) result(rule)
      character(*), intent(in) :: name
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_blank
   end function blank_field

   !> Rule for a field that is left to the card's own routine, or has no effect whatever stands in it.
   elemental function any_field(name) result(rule)
      character(*), intent(in) :: name
      type(field_rule) :: rule

      rule%name = name
      rule%kind = kind_any
   end function any_field

   !> Whether VALUE keeps to a RULE of integers or reals.
   pure logical function in_range(rule, value)
      type(field_rule), intent(in) :: rule
      real(wp), intent(in)         :: value

      if (rule%kind == kind_components) then
         in_range = is_component_list(nint(value))
         return
      end if
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
         if (has_least .and. has_most) then
            words = words//' from '//integer_text(nint(rule%least))//' to '//integer_text(nint(rule%most))
         else if (has_least) then
            words = words//' of '//integer_text(nint(rule%least))//' or more'
         end if
      case (kind_components)
         words = 'a list of components, different digits of 1 to 6'
      case (kind_real)
         words = 'a real number'
         if (has_least) words = words//trim(merge(' above      ', ' of at least', rule%above))//' '//real_text(rule%least)
         if (has_least .and. has_most) words = words//' and'
         if (has_most) words = words//trim(merge(' below  ', ' at most', rule%below))//' '//real_text(rule%most)
      case (kind_word)
         words = 'one of '//list_of(trim(rule%words), ', ')
      case default
         words = 'blank'
      end select
      if (.not. rule%required .and. rule%kind /= kind_blank .and. rule%kind /= kind_word) words = words//', or blank'
   end function expectation

   !> WORDS = '|STEP|BACK|' as a list with this SEPARATOR between them.
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

end module field_rules
