!> Small services for text: case, numbers as words, clean zeros; a line of comma-separated values put together field by field, without
!! formats, which cost more than all else where the lines are many.
module text_tools
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use number_text, only: full_width, integer_width, write_full, write_integer
   implicit none
   private

   public :: upper, integer_text, real_text, fitted_text, plural, above, clean

   integer, parameter :: room = 2048 ! characters at first, doubled where a line is longer

   type, public :: csv_line_type
      integer                   :: length = 0  !! used of TEXT; 0 begins a new line
      character(:), allocatable :: text        !! where anything was added
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

   !> A real as a person would write it in a message: at most six significant digits, no padding: 0, 0.05, 1.5E-7.
   pure function real_text(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(24) :: buffer
      integer :: last

      if (.not. ieee_is_finite(value)) then
         write (buffer, '(f24.1)') value ! NaN, Infinity
         text = trim(adjustl(buffer))
         return
      else if (abs(value) < tiny(1.0_wp)) then
         text = '0'
         return
      else if (abs(value) >= 1.0e-3_wp .and. abs(value) < 1.0e6_wp) then
         write (buffer, '(f0.6)') value
         if (abs(value) >= 10.0_wp) write (buffer, '(f0.4)') value
         if (abs(value) >= 1000.0_wp) write (buffer, '(f0.2)') value
         last = verify(trim(buffer), '0', back=.true.)
         if (buffer(last:last) == '.') last = last - 1
         text = buffer(:last)
         if (text(1:1) == '.') text = '0'//text
         if (len(text) > 1) then
            if (text(1:2) == '-.') text = '-0'//text(2:)
         end if
         return
      end if
      text = scientific(value, 5)
   end function real_text

   !> A finite VALUE as 1.5E-7, with at most so many DECIMALS.
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

   !> VALUE with as many digits as there is ROOM for, for what its column cannot hold: 123456 in four characters is 1E5.
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

   !> VALUE in full, or zero where it lies below FLOOR; zero has no sign.
   elemental real(wp) function above(value, floor)
      real(wp), intent(in) :: value, floor

      above = value
      if (abs(value) < max(floor, tiny(1.0_wp))) above = 0.0_wp
   end function above

   !> VALUE for print: what lies below FLOOR counts as zero, what stands above is rounded to the power of ten of FLOOR, and zero has no
   !! sign. FLOOR [unit of value], default 0, takes away digits that another compiler or processor would not reproduce.
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
      power = nint(log10(floor) - 0.5_wp + 1.0e-6_wp) ! a floor of 1E-9 is one on any machine
      unit = 10.0_wp**abs(power)
      if (abs(printed) >= 0.1_wp*in_full*merge(unit, 1.0_wp/unit, power > 0)) return ! all six: print rounds them, once
      if (power < 0) printed = anint(printed*unit)/unit ! by a whole power, so that the decimal is the nearest number
      if (power > 0) printed = anint(printed/unit)*unit
      if (power == 0) printed = anint(printed)
   end function clean

   !> WORDS as they stand, behind a comma where they are not the first field, and REALS behind them.
   pure recursive subroutine add_text(self, words, reals)
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

   !> VALUES as i0, a field each, empty but WHERE there are any; REALS behind them.
   pure subroutine add_integers(self, values, reals, where)
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

   !> VALUES with the 17 digits that make them come back the same, as es24.16e3 without blanks, a field each, empty but WHERE there are
   !! any.
   pure recursive subroutine add_reals(self, values, where)
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
