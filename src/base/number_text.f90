!> Numbers as text, character by character what the edit descriptors es13.5, es24.16e3 and i0 give, many times faster: tables of
!! a million lines and histories in full precision are written at the speed of the disk.
!!
!! A real is scaled by a power of ten to an integer of 6 or 17 digits by an exact product, which tells how it is rounded (coordinates
!! are often ties). Where the power of ten is no real and what is cut off lies near to one half, the run-time library, which is exact
!! too, writes the number.
!! Source of the exact product: Dekker, A floating-point technique for extending the available precision, Numer. Math. 18
!! (1971) 224-242.
module number_text
   use kinds, only: long, wp
   implicit none
   private

   public :: write_short, write_full, write_integer

   integer, parameter, public :: short_width = 13  !! characters of write_short
   integer, parameter, public :: full_width = 24   !! characters of write_full, at most
   integer, parameter, public :: integer_width = 11 !! characters of write_integer, at most

   integer, parameter  :: quad = selected_real_kind(30)
   integer, parameter  :: reach = 260                        ! of the decimal exponents that are scaled here
   integer, parameter  :: last_exact = 22                    ! 10**22 is the last power of ten that is a real
   real(wp), parameter :: least = 10.0_wp**(-reach), most = 10.0_wp**reach
   real(wp), parameter :: log10_of_2 = log10(2.0_wp)
   real(wp), parameter :: splitter = 2.0_wp**27 + 1.0_wp     ! halves the 53 bits of a real
   integer :: i, j
   real(quad), parameter   :: exact(-reach - 20:reach + 20) = [(10.0_quad**i, i = -reach - 20, reach + 20)]
   real(wp), parameter     :: ten(-reach - 20:reach + 20) = real(exact, wp)
   real(wp), parameter     :: ten_rest(-reach - 20:reach + 20) = real(exact - ten, wp) ! ten + ten_rest has 106 bits
   character(2), parameter :: pairs(0:99) = [((achar(48 + i)//achar(48 + j), j = 0, 9), i = 0, 9)]

contains

   !> VALUE as es13.5.
   pure subroutine write_short(value, text)
      real(wp), intent(in)                :: value
      character(short_width), intent(out) :: text
      integer(long) :: digits
      integer :: exponent10, n
      logical :: certain

      call round_digits(value, 6, digits, exponent10, certain)
      if (.not. certain) then
         write (text, '(es13.5)') value
         return
      end if
      n = int(digits)
      text(1:1) = ' '
      text(2:2) = merge('-', ' ', sign(1.0_wp, value) < 0.0_wp)
      text(3:3) = achar(48 + n/100000)
      text(4:4) = '.'
      text(5:6) = pairs(mod(n/1000, 100))
      text(7:8) = pairs(mod(n/10, 100))
      text(9:9) = achar(48 + mod(n, 10))
      n = abs(exponent10)
      text(10:10) = 'E'
      text(11:11) = merge('-', '+', exponent10 < 0)
      text(12:13) = pairs(mod(n, 100))
      if (n < 100) return
      text(10:10) = text(11:11)
      text(11:11) = achar(48 + n/100)
   end subroutine write_short

   !> VALUE as es24.16e3 without the blanks before it: the 17 digits that make it come back the same.
   pure subroutine write_full(value, text, length)
      real(wp), intent(in)               :: value
      character(full_width), intent(out) :: text
      integer, intent(out)               :: length !! of what was written
      integer(long) :: digits
      integer :: exponent10, k, n
      logical :: certain

      call round_digits(value, 17, digits, exponent10, certain)
      if (.not. certain) then
         write (text, '(es24.16e3)') value
      else
         text(1:1) = merge('-', ' ', sign(1.0_wp, value) < 0.0_wp)
         do k = 18, 4, -2
            text(k:k + 1) = pairs(int(mod(digits, 100_long)))
            digits = digits/100
         end do
         text(2:2) = achar(48 + int(digits))
         text(3:3) = '.'
         n = abs(exponent10)
         text(20:20) = 'E'
         text(21:21) = merge('-', '+', exponent10 < 0)
         text(22:22) = achar(48 + n/100)
         text(23:24) = pairs(mod(n, 100))
      end if
      text = adjustl(text)
      length = len_trim(text)
   end subroutine write_full

   !> So many PLACES of VALUE without its sign, digits 10**(exponent10 - places + 1), rounded to the nearest, of a tie to the even one;
   !! whether that is CERTAIN.
   pure subroutine round_digits(value, places, digits, exponent10, certain)
      real(wp), intent(in)       :: value
      integer, intent(in)        :: places     !! at most 17
      integer(long), intent(out) :: digits
      integer, intent(out)       :: exponent10
      logical, intent(out)       :: certain
      real(wp), parameter :: safe = 1.0e-6_wp  !! above the error of a number below 1E17 scaled with 106 bits, 1E-14
      integer(long) :: lowest
      real(wp) :: above

      digits = 0
      exponent10 = 0
      certain = abs(value) <= 0.0_wp
      if (.not. (abs(value) >= least .and. abs(value) <= most)) return
      lowest = 10_long**(places - 1)
      exponent10 = decimal_exponent(abs(value))
      call multiply(abs(value), places - 1 - exponent10, digits, above)
      if (digits < lowest) then ! by rounding of the power of ten
         exponent10 = exponent10 - 1
         call multiply(abs(value), places - 1 - exponent10, digits, above)
      end if
      certain = abs(above) >= safe .or. (exponent10 < places .and. exponent10 >= places - 1 - last_exact)
      if (above > 0.0_wp .or. (above >= 0.0_wp .and. modulo(digits, 2_long) == 1)) digits = digits + 1
      if (digits < 10*lowest) return
      digits = lowest
      exponent10 = exponent10 + 1
   end subroutine round_digits

   !> VALUE 10**K = WHOLE + 1/2 + ABOVE, -1/2 <= ABOVE < 1/2, with 106 bits; exactly where 10**K is a real.
   pure subroutine multiply(value, k, whole, above)
      real(wp), intent(in)       :: value  !! > 0
      integer, intent(in)        :: k
      integer(long), intent(out) :: whole
      real(wp), intent(out)      :: above
      real(wp) :: product, rest
      integer  :: carry

      call exact_product(value, k, product, rest)
      rest = rest + value*ten_rest(k)
      whole = int(product, long)
      product = product - real(whole, wp)
      carry = floor(product + rest)
      whole = whole + carry
      above = (product - carry - 0.5_wp) + rest
   end subroutine multiply

   !> VALUE ten(K) = PRODUCT + ERROR, exactly (Dekker).
   pure subroutine exact_product(value, k, product, error)
      real(wp), intent(in)  :: value
      integer, intent(in)   :: k
      real(wp), intent(out) :: product, error
      real(wp) :: high, low, ten_high, ten_low, cut

      cut = splitter*value
      high = cut - (cut - value)
      low = value - high
      cut = splitter*ten(k)
      ten_high = cut - (cut - ten(k))
      ten_low = ten(k) - ten_high
      product = value*ten(k)
      error = ((high*ten_high - product) + high*ten_low + low*ten_high) + low*ten_low
   end subroutine exact_product

   !> The e with 10**e <= VALUE < 10**(e + 1), the powers of ten rounded to the nearest real.
   pure integer function decimal_exponent(value) result(e)
      real(wp), intent(in) :: value !! > 0, normal

      e = floor((exponent(value) - 1)*log10_of_2)
      if (value >= ten(e + 1)) e = e + 1
   end function decimal_exponent

   !> VALUE as i0.
   pure subroutine write_integer(value, text, length)
      integer, intent(in)                   :: value
      character(integer_width), intent(out) :: text
      integer, intent(out)                  :: length !! of what was written
      integer(long) :: rest
      integer :: first

      rest = abs(int(value, long))
      first = integer_width + 1
      do
         first = first - 1
         text(first:first) = achar(48 + int(mod(rest, 10_long)))
         rest = rest/10
         if (rest == 0) exit
      end do
      if (value < 0) then
         first = first - 1
         text(first:first) = '-'
      end if
      length = integer_width + 1 - first
      text(:length) = text(first:)
      text(length + 1:) = ''
   end subroutine write_integer

end module number_text
