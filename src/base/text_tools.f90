!> Provides small text services: case, numbers as text, clean zeros, and comma-separated lines built field by field.
!! Numbers are written character by character as the edit descriptors es13.5, es24.16e3 and i0 write them, but many times faster: with
!! formats a listing of 200,000 nodes takes as long again as their solution.
module text_tools
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_null_char, c_size_t
   use kinds, only: long, wp
   use tolerances, only: exact_power, near_half
   implicit none
   private

   public :: upper, integer_text, real_text, write_short, write_full, write_integer, fitted_text, plural, one_of, above, clean, &
             append

   integer, parameter, public :: short_width = 13   !! characters of write_short
   integer, parameter, public :: full_width = 24    !! of write_full, at most
   integer, parameter, public :: integer_width = 11 !! of write_integer, at most

   integer, parameter      :: reach = 260 ! decimal exponents that write_short scales
   integer :: i, j
   real(wp), parameter     :: ten(-reach:reach) = [(10.0_wp**i, i = -reach, reach)]
   character(2), parameter :: pairs(0:99) = [((achar(48 + i)//achar(48 + j), j = 0, 9), i = 0, 9)]

   interface
      !> Write VALUE as printf does under FORM, in at most N characters, the last one null; gives the length without the null.
      integer(c_int) function strfromd(text, n, form, value) bind(c, name='strfromd')
         import :: c_char, c_double, c_int, c_size_t
         character(kind=c_char), intent(out) :: text(*)
         integer(c_size_t), value            :: n
         character(kind=c_char), intent(in)  :: form(*)
         real(c_double), value               :: value
      end function strfromd
   end interface

   !> A text of its own length.
   type, public :: text_item
      character(:), allocatable :: words
   end type text_item

   integer, parameter :: room = 2048 ! initial length, doubled for a longer line

   type, public :: csv_line_type
      integer                   :: length = 0  !! used part of TEXT; 0 begins a new line
      character(:), allocatable :: text        !! allocated after the first field
   contains
      generic :: add => add_integers, add_reals, add_text
      procedure, private :: add_integers, add_reals, add_text
   end type csv_line_type

contains

   !> TEXT with a-z raised to A-Z; other bytes stay.
   pure function upper(text) result(raised)
      character(*), intent(in) :: text
      character(len(text))     :: raised
      integer :: i, code

      do i = 1, len(text)
         code = iachar(text(i:i))
         if (code >= iachar('a') .and. code <= iachar('z')) code = code - 32
         raised(i:i) = achar(code)
      end do
   end function upper

   !> An integer without blanks around it.
   pure function integer_text(value) result(text)
      integer, intent(in)       :: value
      character(:), allocatable :: text
      character(integer_width) :: digits
      integer :: length

      call write_integer(value, digits, length)
      text = digits(:length)
   end function integer_text

   !> VALUE as i0.
   pure subroutine write_integer(value, text, length)
      integer, intent(in)                   :: value
      character(integer_width), intent(out) :: text
      integer, intent(out)                  :: length !! of the text
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

   !> VALUE as es13.5, scaled by a power of ten to an integer of six digits. Where the remainder lies so near one half that the rounding
   !! of the product may decide, or where the power of ten is not a real number, the C library writes VALUE.
   subroutine write_short(value, text)
      real(wp), intent(in)                :: value
      character(short_width), intent(out) :: text
      character(short_width + 1) :: digits
      real(wp) :: scaled
      integer  :: e, n

      e = 0
      scaled = 0.0_wp
      if (abs(value) >= ten(10 - reach) .and. abs(value) < ten(reach - 10)) then
         e = floor((exponent(value) - 1)*log10(2.0_wp))
         if (abs(value) >= ten(e + 1)) e = e + 1
         scaled = abs(value)*ten(5 - e)
      end if
      n = int(scaled)
      if (abs(scaled - n - 0.5_wp) < near_half .or. .not. (scaled > 0.0_wp .or. abs(value) <= 0.0_wp)) then
         if (.not. ieee_is_finite(value)) then
            write (text, '(es13.5)') value
            return
         end if
         n = strfromd(digits, len(digits, c_size_t), '%.5E'//c_null_char, value)
         if (digits(n - 4:n - 4) == 'E') then ! an exponent of three digits takes the place of the E
            digits = digits(:n - 5)//digits(n - 3:n)
            n = n - 1
         end if
         text = repeat(' ', short_width - n)//digits(:n)
         return
      end if
      n = nint(scaled)
      if (n == 1000000) then
         n = 100000
         e = e + 1
      end if
      text(:2) = merge(' -', '  ', sign(1.0_wp, value) < 0.0_wp) ! piece by piece: // would copy the text eight times
      text(3:3) = achar(48 + n/100000)
      text(4:) = '.     E+'
      text(5:6) = pairs(mod(n/1000, 100))
      text(7:8) = pairs(mod(n/10, 100))
      text(9:9) = achar(48 + mod(n, 10))
      if (e < 0) text(11:11) = '-'
      text(12:) = pairs(mod(abs(e), 100))
      if (abs(e) >= 100) text(10:11) = merge('-', '+', e < 0)//achar(48 + abs(e)/100)
   end subroutine write_short

   !> VALUE as es24.16e3 without leading blanks: with 17 digits VALUE is recovered exactly.
   subroutine write_full(value, text, length)
      real(wp), intent(in)               :: value
      character(full_width), intent(out) :: text
      integer, intent(out)               :: length !! of the text
      character(full_width + 1) :: digits

      if (.not. ieee_is_finite(value)) then
         write (text, '(es24.16e3)') value
         text = adjustl(text)
         length = len_trim(text)
         return
      end if
      length = strfromd(digits, len(digits, c_size_t), '%.16E'//c_null_char, value)
      if (digits(length - 3:length - 3) == 'E') then ! an exponent of two digits gets a third
         digits = digits(:length - 2)//'0'//digits(length - 1:)
         length = length + 1
      end if
      text = digits(:length)
   end subroutine write_full

   !> A real for a message: at most six significant digits without padding: 0, 0.05, 1.5E-7.
   pure function real_text(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(24) :: buffer
      integer :: last

      if (.not. ieee_is_finite(value)) then
         write (buffer, '(f24.1)') value ! NaN, Infinity
         text = trim(adjustl(buffer))
      else if (abs(value) < tiny(1.0_wp)) then
         text = '0'
      else if (abs(value) >= 1.0e-3_wp .and. abs(value) < 1.0e6_wp) then
         write (buffer, '(f24.6)') value
         if (abs(value) >= 10.0_wp) write (buffer, '(f24.4)') value
         if (abs(value) >= 1000.0_wp) write (buffer, '(f24.2)') value
         last = verify(buffer, '0', back=.true.)
         if (buffer(last:last) == '.') last = last - 1
         text = trim(adjustl(buffer(:last)))
      else
         text = scientific(value, 5)
      end if
   end function real_text

   !> A finite VALUE as 1.5E-7, with at most DECIMALS decimals.
   pure function scientific(value, decimals) result(text)
      real(wp), intent(in)      :: value
      integer, intent(in)       :: decimals
      character(:), allocatable :: text
      character(24) :: buffer
      character(10) :: form
      integer :: e, exponent, last

      write (form, '(a, i0, a)') '(es24.', decimals, 'e3)'
      write (buffer, form) value
      buffer = adjustl(buffer)
      e = index(buffer, 'E')
      last = e - 1
      if (decimals > 0) last = verify(buffer(:e - 1), '0', back=.true.)
      if (buffer(last:last) == '.') last = last - 1
      read (buffer(e + 1:), *) exponent
      text = buffer(:last)//'E'//integer_text(exponent)
   end function scientific

   !> VALUE in at most ROOM characters, for a value too wide for its column: 123456 in four characters is 1E5.
   pure function fitted_text(value, room) result(text)
      real(wp), intent(in)      :: value
      integer, intent(in)       :: room !! at least 4: 8 for any real
      character(:), allocatable :: text
      integer :: decimals

      text = real_text(value)
      if (len(text) <= room) return
      if (.not. ieee_is_finite(value)) then
         text = text(:room)
         return
      end if
      do decimals = 4, 0, -1
         text = scientific(value, decimals)
         if (len(text) <= room) return
      end do
   end function fitted_text

   !> '1 error', '2 errors': a count with its noun.
   pure function plural(count, noun) result(text)
      integer, intent(in)       :: count
      character(*), intent(in)  :: noun
      character(:), allocatable :: text

      text = integer_text(count)//' '//noun
      if (count /= 1) text = text//'s'
   end function plural

   !> YES where CONDITION is true, otherwise NO: as merge, of texts of different lengths.
   pure function one_of(condition, yes, no) result(text)
      logical, intent(in)       :: condition
      character(*), intent(in)  :: yes, no
      character(:), allocatable :: text

      text = no
      if (condition) text = yes
   end function one_of

   !> Append WORDS to TEXTS, if there are any.
   pure subroutine append(texts, words)
      type(text_item), allocatable, intent(inout) :: texts(:) !! not allocated: empty
      character(*), intent(in)                    :: words
      type(text_item), allocatable :: longer(:)
      integer :: i, n

      if (words == '') return
      n = 0
      if (allocated(texts)) n = size(texts)
      allocate (longer(n + 1))
      do i = 1, n
         call move_alloc(texts(i)%words, longer(i)%words)
      end do
      longer(n + 1)%words = words
      call move_alloc(longer, texts)
   end subroutine append

   !> VALUE in full, or zero where it lies below FLOOR; zero has no sign.
   elemental real(wp) function above(value, floor)
      real(wp), intent(in) :: value, floor

      above = value
      if (abs(value) < max(floor, tiny(1.0_wp))) above = 0.0_wp
   end function above

   !> VALUE for print, rounded to the power of ten of FLOOR; a value below FLOOR is zero, and zero has no sign. FLOOR [unit of value],
   !! default 0, removes digits that another compiler or processor would not reproduce.
   elemental real(wp) function clean(value, floor) result(printed)
      real(wp), intent(in)           :: value
      real(wp), intent(in), optional :: floor
      real(wp), parameter :: in_full = 1.0e6_wp ! times FLOOR: more than six digits stand above it
      real(wp) :: unit
      integer  :: power

      if (.not. present(floor)) then
         printed = above(value, 0.0_wp)
         return
      end if
      printed = above(value, floor)
      if (abs(printed) >= in_full*floor .or. .not. floor > in_full*tiny(1.0_wp) .or. .not. abs(printed) > 0.0_wp) return
      power = nint(log10(floor) - 0.5_wp + exact_power) ! robust at exact powers: 1E-9 gives one power on any machine
      unit = 10.0_wp**abs(power)
      if (abs(printed) >= 0.1_wp*in_full*merge(unit, 1.0_wp/unit, power > 0)) return ! print rounds these once
      if (power < 0) printed = anint(printed*unit)/unit ! by a whole power, so that the decimal is the nearest number
      if (power > 0) printed = anint(printed/unit)*unit
      if (power == 0) printed = anint(printed)
   end function clean

   !> Append WORDS, after a comma unless they are the first field, and then REALS.
   recursive subroutine add_text(self, words, reals)
      class(csv_line_type), intent(inout) :: self
      character(*), intent(in)            :: words
      real(wp), intent(in), optional      :: reals(:)
      character(:), allocatable :: longer
      integer :: n

      n = len(words)
      if (.not. allocated(self%text)) allocate (character(room) :: self%text)
      if (self%length + 1 + n > len(self%text)) then
         allocate (character(2*(self%length + 1 + n)) :: longer)
         longer(:self%length) = self%text(:self%length)
         call move_alloc(longer, self%text)
      end if
      if (self%length > 0) then
         self%length = self%length + 1
         self%text(self%length:self%length) = ','
      end if
      self%text(self%length + 1:self%length + n) = words
      self%length = self%length + n
      if (present(reals)) call self%add_reals(reals)
   end subroutine add_text

   !> Append VALUES as i0, a field each, empty where WHERE is false, and then REALS.
   subroutine add_integers(self, values, reals, where)
      class(csv_line_type), intent(inout) :: self
      integer, intent(in)                 :: values(:)
      real(wp), intent(in), optional      :: reals(:)
      logical, intent(in), optional       :: where(:) !! (values) default: all
      character(integer_width) :: digits
      integer :: i, n

      do i = 1, size(values)
         call write_integer(values(i), digits, n)
         if (present(where)) n = merge(n, 0, where(i))
         call self%add_text(digits(:n))
      end do
      if (present(reals)) call self%add_reals(reals)
   end subroutine add_integers

   !> Append VALUES as es24.16e3 without blanks, 17 digits, so that they are recovered exactly; a field is empty where WHERE is
   !! false.
   recursive subroutine add_reals(self, values, where)
      class(csv_line_type), intent(inout) :: self
      real(wp), intent(in)                :: values(:)
      logical, intent(in), optional       :: where(:)
      character(full_width) :: field
      integer :: i, n

      do i = 1, size(values)
         call write_full(values(i), field, n)
         if (present(where)) n = merge(n, 0, where(i))
         call self%add_text(field(:n))
      end do
   end subroutine add_reals

end module text_tools
