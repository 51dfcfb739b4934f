!> Numbers as NASTRAN writes them: 12, 1., -.5, 7.0E+1, 1.D-3, 1.5-3.
module deck_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: long, wp
   implicit none
   private

   public :: parse_integer, parse_real

   integer, parameter :: max_exact = 22 ! 10**22 is the largest power of ten that a real64 holds exactly
   integer :: k
   real(wp), parameter :: power_of_ten(0:max_exact) = [(10.0_wp**k, k = 0, max_exact)]

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
      length = len_trim(text)
      if (length == 0) return
      first = 1
      if (scan(text(1:1), '+-') == 1) first = 2
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
      logical :: point, any_digit, exact
      character(48) :: plain

      value = 0.0_wp
      ok = .false.
      length = len_trim(text)
      if (length == 0 .or. length > 32) return
      i = 1
      if (scan(text(1:1), '+-') == 1) i = 2
      mantissa = 0; digits = 0; decimals = 0
      point = .false.; any_digit = .false.; exact = .true.
      do while (i <= length)
         digit = iachar(text(i:i)) - iachar('0')
         if (digit >= 0 .and. digit <= 9) then
            any_digit = .true.
            if (digits > 0 .or. digit > 0) digits = digits + 1
            if (digits <= 15) mantissa = 10*mantissa + digit
            if (point) decimals = decimals + 1
         else if (text(i:i) == '.' .and. .not. point) then
            point = .true.
         else
            exit
         end if
         i = i + 1
      end do
      if (.not. any_digit) return
      exact = digits <= 15
      plain = text(:i - 1)
      call parse_exponent(text(i:length), point, exponent, ok)
      if (.not. ok) return
      if (exact .and. abs(exponent - decimals) <= max_exact) then
         if (exponent >= decimals) then
            value = real(mantissa, wp)*power_of_ten(exponent - decimals)
         else
            value = real(mantissa, wp)/power_of_ten(decimals - exponent)
         end if
         if (text(1:1) == '-') value = -value
         return
      end if
      write (plain(i:), '(a, i0)') 'E', exponent
      read (plain, *, iostat=status) value
      ok = status == 0
      if (ok) ok = ieee_is_finite(value) .and. .not. (abs(value) < tiny(value) .and. digits > 0)
   end subroutine parse_real


   !> What stands behind the mantissa: nothing, E or D and an integer, or a signed integer alone.
   pure subroutine parse_exponent(text, point, exponent, ok)
      character(*), intent(in) :: text
      logical, intent(in)      :: point !! whether the mantissa has a decimal point
      integer, intent(out)     :: exponent
      logical, intent(out)     :: ok

      exponent = 0
      ok = point
      if (len(text) == 0) return
      if (scan(text(1:1), 'EDed') == 1) then
         call parse_integer(text(2:), exponent, ok)
      else if (scan(text(1:1), '+-') == 1 .and. point) then
         call parse_integer(text, exponent, ok)
      else
         ok = .false.
      end if
      ok = ok .and. abs(exponent) < 10000
   end subroutine parse_exponent

end module deck_numbers
