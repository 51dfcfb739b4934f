!> Text of the cards that jointfit writes: numbers with as many digits as the columns of a field hold.
module card_text
   use field_rules, only: parse_real
   use kinds, only: wp
   implicit none
   private

   public :: card_lines, number_fields, real_field_text

contains

   !> NUMBERS in all columns of a small field, or all but one of a large field, so that a blank separates them.
   function number_fields(numbers, small) result(fields)
      real(wp), intent(in) :: numbers(:)
      logical, intent(in)  :: small
      character(16) :: fields(size(numbers))
      integer :: k

      do k = 1, size(numbers)
         fields(k) = real_field_text(numbers(k), merge(8, 15, small))
      end do
   end function number_fields

   !> A card NAME (or + for a continuation) with its FIELDS, eight on a line, in large field eight on a pair of lines. Eight blank
   !! fields are a single +.
   function card_lines(name, fields, small) result(lines)
      character(*), intent(in)  :: name
      character(16), intent(in) :: fields(:) !! (8, 16, ...)
      logical, intent(in)       :: small
      character(80), allocatable :: lines(:)
      character(8) :: head
      integer :: first

      allocate (lines(0))
      head = name
      do first = 1, size(fields), 8
         associate (eight => fields(first:first + 7))
            if (all(eight == '')) then
               lines = [character(80) :: lines, joined('+', eight(:0), 8)]
            else if (small) then
               lines = [character(80) :: lines, joined(head, eight, 8)]
            else
               if (head == '+') head = ''
               lines = [character(80) :: lines, joined(trim(head)//'*', eight(:4), 16)]
               if (any(eight(5:) /= '') .or. first + 8 <= size(fields)) lines = [character(80) :: lines, joined('*', eight(5:), 16)]
            end if
         end associate
         head = '+'
      end do
   end function card_lines

   !> One line: HEAD in eight columns, then the FIELDS, each WIDTH columns wide.
   pure function joined(head, fields, width) result(line)
      character(*), intent(in)  :: head
      character(16), intent(in) :: fields(:)
      integer, intent(in)       :: width
      character(80) :: line
      character(8)  :: name

      name = head
      write (line, '(9a)') name, fields(:)(:width)
   end function joined

   !> VALUE in at most WIDTH columns as in NASTRAN: the nearest number that fits, as 0.0125, 260.8628 or, where that is nearer, in
   !! the short form with an exponent, 1.2346-5. It always has a decimal point, and parse_real reads it.
   function real_field_text(value, width) result(text)
      real(wp), intent(in)      :: value !! |value| below 1E99 and not below 1E-99, or zero
      integer, intent(in)       :: width !! 7 to 16
      character(:), allocatable :: text
      character(40) :: entry, best
      character(16) :: layout
      real(wp) :: error, least, read_back
      logical  :: ok
      integer  :: e, k

      best = '0.0'
      least = huge(least)
      do k = 1, 2*width - 1
         if (k <= width) then                ! a zero before the point if there is room
            if (abs(value) >= 1.0e16_wp) cycle
            write (layout, '(a, i0, a)') '(f0.', modulo(k, width), ')'
            write (entry, layout) value
            if (len_trim(entry) < width .and. entry(1:1) == '.') entry = '0'//trim(entry)
            if (len_trim(entry) < width .and. entry(1:2) == '-.') entry = '-0'//trim(entry(2:))
         else                                ! one digit before the point, and an exponent without E: -1.25+7
            write (layout, '(a, i0, a)') '(es40.', k - width - 1, 'e3)'
            write (entry, layout) value
            entry = adjustl(entry)
            e = index(entry, 'E')
            entry = entry(:e - 1)//entry(e + 1:e + 1)//entry(min(verify(entry(e + 2:), '0'), 3) + e + 1:)
         end if
         if (len_trim(entry) > width) cycle
         call parse_real(trim(entry), read_back, ok)
         if (.not. ok) cycle
         error = abs(read_back - value)
         if (error >= least) cycle
         least = error
         best = entry
      end do
      text = trim(best)
   end function real_field_text

end module card_text
