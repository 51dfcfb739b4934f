!> Replaces ${NAME} in a deck by the number or word that the command gives with --set NAME=VALUE.
module deck_parameters
   use kinds, only: long
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: fill_parameters, is_parameter_name

   character(*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_'

   !> NAME=VALUE of the command line.
   type, public :: parameter_type
      character(:), allocatable :: name, value
      logical :: is_used = .false. !! the deck uses it
      logical :: is_long = .false. !! where VALUE does not fit, its line changes to free field
      character(:), allocatable :: cards !! names of the cards that use it, a blank before and behind each
   end type parameter_type

contains

   !> Whether NAME is valid between the braces: letters, digits, underscores.
   pure logical function is_parameter_name(name)
      character(*), intent(in) :: name

      is_parameter_name = len(name) > 0 .and. verify(name, letters) == 0
   end function is_parameter_name

   !> Put the values of PARAMETERS into BYTES, the lines of a file, outside of comments. Columns after a value keep their place as far
   !! as blanks after the value allow. FAULT names a parameter without a value or room; '' where there is no error.
   subroutine fill_parameters(bytes, parameters, fault)
      character(:), allocatable, intent(inout) :: bytes
      type(parameter_type), intent(inout)      :: parameters(:)
      character(:), allocatable, intent(out)   :: fault
      character(:), allocatable :: filled, line, wider
      integer(long) :: card, finish, start, used
      integer :: n

      fault = ''
      card = 1
      if (index(bytes, '${') == 0) return
      allocate (character(len(bytes, long) + len(bytes, long)/8 + 80) :: filled) ! a copy for each line would be quadratic in time
      used = 0
      start = 1
      n = 0
      do while (start <= len(bytes, long))
         n = n + 1
         finish = start - 1 + index(bytes(start:), achar(10), kind=long)
         if (finish < start) finish = len(bytes, long)
         line = bytes(start:finish)
         if (scan(line(1:1), '+*, $'//achar(10)) == 0) card = start
         if (index(line, '${') > 0) call fill_line(line, n, first_word(bytes(card:min(card + 8, finish))), parameters, fault)
         if (used + len(line) > len(filled, long)) then
            allocate (character(2*len(filled, long) + len(line)) :: wider)
            wider(:used) = filled(:used)
            call move_alloc(wider, filled)
         end if
         filled(used + 1:used + len(line)) = line
         used = used + len(line)
         start = finish + 1
      end do
      bytes = filled(:used)
   end subroutine fill_parameters

   !> The name of the card with this LINE.
   pure function first_word(line) result(name)
      character(*), intent(in)  :: line
      character(:), allocatable :: name

      name = upper(line(:scan(line//' ', ' ,*=') - 1))
   end function first_word

   !> LINE, a card or a continuation in fixed fields, in free field; a comment behind it is dropped. A parameter counts as a word.
   pure function in_free_field(line) result(free)
      character(*), intent(in)  :: line
      character(:), allocatable :: free, plain
      integer :: comment, first, width

      comment = 1
      do while (comment <= len(line))
         if (line(comment:comment) == '$' .and. line(comment:min(comment + 1, len(line))) /= '${') exit
         comment = comment + 1
      end do
      plain = line(:comment - 1)
      plain = plain(:verify(plain, ' '//achar(13)//achar(10), back=.true.))
      width = merge(16, 8, index(plain(:min(8, len(plain))), '*') > 0)
      free = trim(plain(:min(8, len(plain))))
      first = 9
      do while (first <= len(plain))
         free = free//','//trim(adjustl(plain(first:min(first + merge(8, width, first > 72) - 1, len(plain)))))
         first = first + width
      end do
      free = free//new_line('a')
   end function in_free_field

   !> Put the values into one LINE, number N of its file, of the CARD. A value is not searched for parameters.
   recursive subroutine fill_line(line, n, card, parameters, fault)
      character(:), allocatable, intent(inout) :: line
      integer, intent(in)                      :: n
      character(*), intent(in)                 :: card
      type(parameter_type), intent(inout)      :: parameters(:)
      character(:), allocatable, intent(inout) :: fault
      character(:), allocatable :: name, rest, value
      integer :: at, blanks, closing, done, k, room, width
      logical :: is_fixed, is_last

      done = 0 ! characters of the line behind which parameters are searched
      is_fixed = index(line, ',') == 0
      rest = ''
      value = ''
      do
         at = index(line(done + 1:), '$')
         if (at == 0 .or. at /= index(line(done + 1:), '${')) return ! a comment
         at = done + at
         closing = index(line(at:), '}')
         if (closing < 3) return
         name = line(at + 2:at + closing - 2)
         if (.not. is_parameter_name(name)) return
         do k = size(parameters), 1, -1
            if (parameters(k)%name == name) exit
         end do
         if (k == 0) then
            if (fault == '') fault = 'line '//integer_text(n)//': ${'//name//'} has no value, expected --set '//name//'=VALUE'
            return
         end if
         parameters(k)%is_used = .true.
         if (.not. allocated(parameters(k)%cards)) parameters(k)%cards = ' '
         if (index(parameters(k)%cards, ' '//card//' ') == 0) parameters(k)%cards = parameters(k)%cards//card//' '
         value = parameters(k)%value
         rest = line(at + closing:)
         width = max(closing, len(value))
         blanks = verify(rest//'x', ' ') - 1
         is_last = verify(rest, ' '//achar(13)//achar(10)) == 0
         room = closing + blanks
         if (is_last) room = merge(8, huge(room), index(line, '=') == 0) ! of a card, or of a line of case control
         if (is_fixed .and. parameters(k)%is_long .and. len(value) > room) then
            line = in_free_field(line)
            call fill_line(line, n, card, parameters, fault)
            return
         end if
         if (len(value) > closing .and. .not. is_last) then
            if (is_fixed .and. blanks < len(value) - closing .and. fault == '') fault = 'line '//integer_text(n)//': '//value// &
               ' in the place of ${'//name//'} does not fit in front of what follows'
            rest = rest(1 + min(blanks, len(value) - closing):)
         end if
         line = line(:at - 1)//value//repeat(' ', width - len(value))//rest
         done = at - 1 + len(value)
      end do
   end subroutine fill_line

end module deck_parameters
