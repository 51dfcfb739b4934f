!> Writes JNORM and JSHEAR cards and warns where the slope of a fitted cubic turns negative in the range of the card.
!! The numbers have as many digits as the columns hold. A joint has no negative stiffness.
module law_cards
   use data_columns, only: branch_words, fit_load, fit_reload, fit_unload
   use field_rules, only: parse_real
   use kinds, only: wp
   use surface_fit, only: surface_fit_type
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: check_slopes, find_slope_loss, jnorm_card, jshear_card, coefficient_line, real_field_text

contains

   !> Check the slope of every fitted branch in the range of its data and, if it is positive there, in the range of the card: p from 0 to
   !! PMAX, d to DMAX, and d below zero too for unloading and reloading, because these branches extend past zero to the mirror image of
   !! their point A. A branch is followed as in the joint: unloading with decreasing d, the others with increasing d.
   subroutine check_slopes(fit)
      type(surface_fit_type), intent(inout) :: fit
      character(:), allocatable :: words
      integer  :: b, k
      logical  :: lost
      real(wp) :: d, d_max, p, pressures(2), way(2)

      d_max = fit%d_max
      if (d_max <= 0.0_wp) d_max = huge(d_max)
      do b = fit_load, fit_reload
         associate (branch => fit%branch(b))
            if (branch%n_points == 0) cycle
            do k = 1, merge(2, 1, fit%has_loading)
               way = [0.0_wp, d_max]
               if (k == 1) then
                  pressures = [branch%p_low, branch%p_high]
                  if (branch%from_points) way = [branch%d_low, branch%d_high]
                  if (b == fit_load) way(1) = min(way(1), 0.0_wp)
                  words = ', inside the tested range'
               else
                  pressures = [0.0_wp, fit%p_max]
                  if (b /= fit_load .and. fit%d_max > 0.0_wp) way(1) = -d_max
                  words = ', outside the tested range of the branch, but inside the range of the card, which --dmax sets'
               end if
               if (b == fit_unload .and. merge(branch%from_points, fit%d_max > 0.0_wp, k == 1)) way = way([2, 1])
               call find_slope_loss(fit%card(:, :, b), pressures(1), pressures(2), way(1), way(2), lost, p, d)
               if (lost) call fit%warnings%add(0, trim(branch_words(b))//': the slope of tau becomes zero or negative at p = '// &
                                               real_text(p)//', d = '//real_text(d)//words)
               if (lost) exit
            end do
         end associate
      end do
   end subroutine check_slopes

   !> From d = FROM to d = TO, find the first d at which dtau/dd = sum over k of k (a_k1 + a_k2 p) d^(k-1) is not positive for some p
   !! between P_LOW and P_HIGH. The slope is linear in p, so its minimum is at P_LOW or P_HIGH: two quadratics in d decide.
   pure subroutine find_slope_loss(lines, p_low, p_high, from, to, found, p, d)
      real(wp), intent(in)  :: lines(2, 3)   !! a_k1 and a_k2 for k = 1, 2, 3
      real(wp), intent(in)  :: p_low, p_high !! [pressure]
      real(wp), intent(in)  :: from, to      !! [length], TO = +-huge: unbounded
      logical, intent(out)  :: found
      real(wp), intent(out) :: p, d          !! the place, if FOUND
      real(wp) :: a(3), ends(2), discriminant, places(3), q, sense
      logical  :: lost(3)
      integer  :: first, i

      found = .false.
      p = 0.0_wp
      d = 0.0_wp
      ends = [p_low, p_high]
      sense = sign(1.0_wp, to - from)
      do i = 1, 2
         a = lines(1, :) + lines(2, :)*ends(i)
         places = from                            ! the start, and the roots of a1 + 2 a2 d + 3 a3 d^2
         discriminant = a(2)**2 - 3.0_wp*a(3)*a(1)
         q = -(a(2) + sign(sqrt(max(discriminant, 0.0_wp)), a(2)))
         if (discriminant >= 0.0_wp .and. abs(q) > 0.0_wp) then ! the two roots q/(3 a3) and a1/q, without cancellation
            places(2) = a(1)/q
            if (abs(a(3)) > tiny(q)) places(3) = q/(3.0_wp*a(3))
         end if
         lost = (places - from)*sense > 0.0_wp .and. (places - to)*sense <= 0.0_wp
         lost(1) = a(1) + from*(2.0_wp*a(2) + from*3.0_wp*a(3)) <= 0.0_wp
         if (.not. any(lost)) cycle
         first = minloc(abs(places - from), 1, lost)
         if (found .and. abs(places(first) - from) >= abs(d - from)) cycle
         found = .true.
         p = ends(i)
         d = places(first)
      end do
   end subroutine find_slope_loss

   !> JNORM NID C M EU; a zero E_U leaves its field blank.
   function jnorm_card(id, c, m, e_u, small) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: c, m  !! [length/pressure^m], [-]
      real(wp), intent(in) :: e_u   !! [pressure/length]
      logical, intent(in)  :: small !! fields of 8 columns, otherwise 16
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(1) = integer_text(id)
      fields(2:4) = number_fields([c, m, e_u], small)
      if (e_u <= 0.0_wp) fields(4) = ''
      lines = card_lines('JNORM', fields, small)
   end function jnorm_card

   !> JSHEAR SID A11 A12 A21 A22 A31 A32, the continuations B11 to B32, C11 to C32, and PMAX DMAX. The continuation of a branch that is
   !! not GIVEN is blank, which means as loading. A zero D_MAX leaves its field blank.
   function jshear_card(id, coefficients, given, p_max, d_max, small) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: coefficients(2, 3, 3) !! (., k, branch): a_k1 and a_k2 for load, unload, reload
      logical, intent(in)  :: given(3)              !! the first must be true
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

   !> The continuation with the COEFFICIENTS of one branch.
   function coefficient_line(coefficients, small) result(lines)
      real(wp), intent(in) :: coefficients(2, 3)
      logical, intent(in)  :: small
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(:6) = number_fields([coefficients], small)
      lines = card_lines('+', fields, small)
   end function coefficient_line

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

   !> A card NAME (or + for a continuation) with its FIELDS, eight on a line, in large field eight on a pair of lines. Eight blank fields
   !! are a single +.
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

   !> VALUE in at most WIDTH columns as in NASTRAN: the nearest number that fits, as 0.0125, 260.8628 or, where that is nearer, in the
   !! short form with an exponent, 1.2346-5. It always has a decimal point, and parse_real reads it.
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

end module law_cards
