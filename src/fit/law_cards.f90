!> JNORM and JSHEAR as lines of a deck.
module law_cards
   use field_numbers, only: real_field_text
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: jnorm_card, jshear_card, coefficient_line, card_lines

contains

   !> JNORM NID C M.
   function jnorm_card(id, c, m, small) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: c, m  !! [length/pressure^m], [-]
      logical, intent(in)  :: small !! fields of 8 columns, else of 16
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(1) = integer_text(id)
      fields(2) = real_field_text(c, width_of(small))
      fields(3) = real_field_text(m, width_of(small))
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
      integer :: branch, first

      fields = ''
      fields(1) = integer_text(id)
      do branch = 1, 3
         if (.not. given(branch)) cycle
         first = 8*branch - 7
         if (branch == 1) first = 2
         fields(first:first + 5) = coefficient_fields(coefficients(:, :, branch), small)
      end do
      fields(25) = real_field_text(p_max, width_of(small))
      if (d_max > 0.0_wp) fields(26) = real_field_text(d_max, width_of(small))
      lines = card_lines('JSHEAR', fields, small)
   end function jshear_card


   !> The continuation with the COEFFICIENTS of one branch alone.
   function coefficient_line(coefficients, small) result(lines)
      real(wp), intent(in) :: coefficients(2, 3)
      logical, intent(in)  :: small
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(:6) = coefficient_fields(coefficients, small)
      lines = card_lines('+', fields, small)
   end function coefficient_line


   function coefficient_fields(coefficients, small) result(fields)
      real(wp), intent(in) :: coefficients(2, 3)
      logical, intent(in)  :: small
      character(16) :: fields(6)
      integer :: j, k

      do k = 1, 3
         do j = 1, 2
            fields(2*k - 2 + j) = real_field_text(coefficients(j, k), width_of(small))
         end do
      end do
   end function coefficient_fields


   !> Columns that a number may take: all of a small field, all but one of a large one, so that its numbers stand apart.
   pure integer function width_of(small)
      logical, intent(in) :: small

      width_of = merge(8, 15, small)
   end function width_of


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
               lines = [lines, lone_plus()]
            else if (small) then
               lines = [lines, joined(head, eight, 8)]
            else
               if (head == '+') head = ''
               lines = [lines, joined(trim(head)//'*', eight(:4), 16)]
               if (any(eight(5:) /= '') .or. first + 8 <= size(fields)) lines = [lines, joined('*', eight(5:), 16)]
            end if
         end associate
         head = '+'
      end do
   end function card_lines


   pure function lone_plus() result(line)
      character(80) :: line

      line = '+'
   end function lone_plus


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

end module law_cards
