!> JNORM and JSHEAR as lines of a deck, their numbers with the most digits that the columns hold.
module law_cards
   use deck_numbers, only: parse_real
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: jnorm_card, jshear_card, coefficient_line, real_field_text

contains

   !> JNORM NID C M EU; a zero E_U leaves its field blank.
   function jnorm_card(id, c, m, e_u, small) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: c, m  !! [length/pressure^m], [-]
      real(wp), intent(in) :: e_u   !! [pressure/length]
      logical, intent(in)  :: small !! fields of 8 columns, else of 16
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(1) = integer_text(id)
      fields(2:4) = number_fields([c, m, e_u], small)
      if (e_u <= 0.0_wp) fields(4) = ''
      lines = card_lines('JNORM', fields, small)
   end function jnorm_card

   !> JSHEAR SID A11 A12 A21 A22 A31 A32, the continuations B11 to B32, C11 to C32, and PMAX DMAX. A branch that is not
   !! GIVEN leaves its continuation blank, which means as loading; so does a zero D_MAX its field.
   function jshear_card(id, coefficients, given, p_max, d_max, small) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: coefficients(2, 3, 3) !! (., k, branch): a_k1 and a_k2 for load, unload, reload
      logical, intent(in)  :: given(3)              !! the first is true
      real(wp), intent(in) :: p_max, d_max          !! tested range [pressure], [length]
      logical, intent(in)  :: small
      character(80), allocatable :: lines(:)
      character(16) :: fields(32)
      integer, parameter :: first(3) = [2, 9, 17]
      integer :: branch

      fields = ''
      fields(1) = integer_text(id)
      do branch = 1, 3
         if (given(branch)) fields(first(branch):first(branch) + 5) = number_fields([coefficients(:, :, branch)], small)
      end do
      fields(25:26) = number_fields([p_max, d_max], small)
      if (d_max <= 0.0_wp) fields(26) = ''
      lines = card_lines('JSHEAR', fields, small)
   end function jshear_card

   !> The continuation with the COEFFICIENTS of one branch alone.
   function coefficient_line(coefficients, small) result(lines)
      real(wp), intent(in) :: coefficients(2, 3)
      logical, intent(in)  :: small
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(:6) = number_fields([coefficients], small)
      lines = card_lines('+', fields, small)
   end function coefficient_line

   !> NUMBERS in all columns of a small field, all but one of a large one, so that they stand apart.
   function number_fields(numbers, small) result(fields)
      real(wp), intent(in) :: numbers(:)
      logical, intent(in)  :: small
      character(16) :: fields(size(numbers))
      integer :: k

      do k = 1, size(numbers)
         fields(k) = real_field_text(numbers(k), merge(8, 15, small))
      end do
   end function number_fields

   !> A card NAME (or + for a continuation) with its FIELDS, eight a line, in large field eight a pair of lines. Eight blank
   !! ones are a lone +.
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

   !> One line: HEAD in eight columns, then the FIELDS, WIDTH columns each.
   pure function joined(head, fields, width) result(line)
      character(*), intent(in)  :: head
      character(16), intent(in) :: fields(:)
      integer, intent(in)       :: width
      character(80) :: line
      integer :: first, k

      line = head
      do k = 1, size(fields)
         first = 9 + (k - 1)*width
         line(first:first + width - 1) = fields(k)
      end do
   end function joined

   !> VALUE in at most WIDTH columns, as NASTRAN writes it: the nearest number that fits, as 0.0125, 260.8628 or, where that
   !! is nearer, in the short form with an exponent, 1.2346-5. It always has a decimal point, and reads back by parse_real.
   function real_field_text(value, width) result(text)
      real(wp), intent(in)      :: value !! |value| below 1E99 and not below 1E-99, or zero
      integer, intent(in)       :: width !! 7 to 16
      character(:), allocatable :: text
      character(40) :: entry, best
      real(wp) :: error, least, read_back
      logical  :: ok
      integer  :: k

      best = '0.0'
      least = huge(least)
      do k = 1, 2*width - 1
         if (k <= width) then
            entry = plain_form(value, modulo(k, width), width)
         else
            entry = short_form(value, k - width - 1)
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

   !> VALUE with DECIMALS digits behind the point; a zero before the point where there is room, none where not.
   function plain_form(value, decimals, width) result(entry)
      real(wp), intent(in) :: value
      integer, intent(in)  :: decimals, width
      character(40) :: entry
      character(12) :: layout

      entry = repeat('*', len(entry))
      if (abs(value) >= 1.0e16_wp) return
      write (layout, '(a, i0, a)') '(f0.', decimals, ')'
      write (entry, layout) value
      if (len_trim(entry) >= width) return
      if (entry(1:1) == '.') entry = '0'//trim(entry)
      if (entry(1:2) == '-.') entry = '-0'//trim(entry(2:))
   end function plain_form

   !> VALUE with one digit before the point, DECIMALS behind it and an exponent without E: -1.25+7.
   function short_form(value, decimals) result(entry)
      real(wp), intent(in) :: value
      integer, intent(in)  :: decimals
      character(40) :: entry
      character(16) :: layout
      integer :: e, first

      write (layout, '(a, i0, a)') '(es40.', decimals, 'e3)'
      write (entry, layout) value
      entry = adjustl(entry)
      e = index(entry, 'E')
      first = min(verify(entry(e + 2:), '0'), 3) + e + 1
      entry = entry(:e - 1)//entry(e + 1:e + 1)//entry(first:)
   end function short_form

end module law_cards
