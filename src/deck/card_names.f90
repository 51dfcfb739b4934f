!> Field 1 of a line of bulk data: the name of a card, or what carries on the card before it.
module card_names
   use deck_errors, only: deck_error_list
   use text_tools, only: upper
   implicit none
   private

   public :: card_name, is_continuation, check_first_field, check_marker

contains

   !> The name in field 1 of LINE (its card part), without the * of large field; blank for a continuation.
   pure function card_name(line, comma) result(name)
      character(*), intent(in)      :: line
      integer, intent(in), optional :: comma !! column of the first comma, 0: none; left out, it is looked for
      character(8) :: name
      integer :: i, first, last, n, code

      name = ''
      if (present(comma)) then
         if (is_continuation(line, comma)) return
         last = comma - 1
      else
         if (is_continuation(line)) return
         last = index(line, ',') - 1
      end if
      if (last < 0) last = min(8, len(line))
      first = 1
      do while (first <= last)
         if (line(first:first) /= ' ') exit
         first = first + 1
      end do
      n = min(8, last - first + 1)
      do i = 1, n
         code = iachar(line(first + i - 1:first + i - 1))
         if (code == iachar('*') .and. i > 1 .and. name(1:1) /= '*') exit
         if (code >= iachar('a') .and. code <= iachar('z')) code = code - 32
         name(i:i) = achar(code)
      end do
   end function card_name


   !> Whether LINE carries on the card before it: +, * or blank in field 1.
   pure logical function is_continuation(line, comma)
      character(*), intent(in)      :: line
      integer, intent(in), optional :: comma !! as above
      integer :: last

      is_continuation = .false.
      if (len(line) == 0) return
      select case (line(1:1))
      case ('+', '*', ',')
         is_continuation = .true.
      case (' ')
         if (present(comma)) then
            last = comma - 1
         else
            last = index(line, ',') - 1
         end if
         if (last < 0) last = min(8, len(line))
         is_continuation = len_trim(line(:last)) == 0 .and. len_trim(line) > 0
      end select
   end function is_continuation


   !> Nothing but the name, and perhaps the * of large field, may stand in field 1 of LINE, whose first comma is in column COMMA.
   subroutine check_first_field(line, comma, at, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      type(deck_error_list), intent(inout) :: errors
      integer :: first, last, behind, star

      last = merge(comma - 1, min(8, len(line)), comma > 0)
      behind = last + 1 ! of the entry
      do while (behind > 1)
         if (line(behind - 1:behind - 1) /= ' ') exit
         behind = behind - 1
      end do
      first = max(1, verify(line(:behind - 1), ' '))
      associate (entry => line(first:behind - 1))
         star = index(entry, '*')
         if (star > 1 .and. star < len(entry)) then
            call errors%add(at, '''*'' inside field 1, expected it behind the name', 1, last)
         else if (len(entry) > 8 .or. index(entry, ' ') > 0) then
            call errors%add(at, ''''//entry(:min(len(entry), 40))//''' in field 1: expected the name of a card alone', 1, last)
         end if
      end associate
   end subroutine check_first_field


   !> The name that the user gave a continuation (`+AB`) must be the one in field 10 of the line before, MARKER.
   subroutine check_marker(line, comma, at, marker, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: comma, at
      character(8), intent(in)             :: marker
      type(deck_error_list), intent(inout) :: errors
      character(8) :: given

      given = line(:min(8, len(line)))
      if (comma > 0) given = line(:min(8, comma - 1))
      if (given(2:) == '') return
      if (upper(given(2:)) == upper(marker(2:))) return
      if (marker(2:) == '') then
         call errors%add(at, 'continuation '''//trim(given)//''': the line before it has no such mark in its last field; '// &
                         'expected '//given(1:1)//' alone, or the same mark there', 1, len_trim(given))
      else
         call errors%add(at, 'continuation '''//trim(given)//''' does not follow its card: the line before it ends in '''// &
                         trim(marker)//'''', 1, len_trim(given))
      end if
   end subroutine check_marker

end module card_names
