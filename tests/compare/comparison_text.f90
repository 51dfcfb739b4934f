!> The text that is compared: files read line by line without a limit on the length of a line, tokens between blanks, numbers,
!! defects.
module comparison_text
   use, intrinsic :: iso_fortran_env, only: error_unit, real64, int64
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   implicit none
   private

   public :: text_file, open_text, next_line, close_text, argument, give_up
   public :: next_token, next_field, word, number_kind, number_value, same_integer, defect, text_of

   !> What number_kind finds in a token.
   integer, parameter, public :: not_a_number = 0, an_integer = 1, a_real = 2

   integer, parameter :: block_length = 2**20      ! characters read at a time
   integer, parameter :: overflow_shortest = 3     ! asterisks in a row: fewer are a mark,
   integer, parameter :: overflow_longest = 32     ! more are a ruled line, not a field

   !> A file that is read once, from the first line to the last.
   type :: text_file
      character(len=:), allocatable :: name
      integer :: line_number = 0                   !! of the line read last; at the end: lines in all
      logical :: complete = .true.                 !! the line read last ended with a line end
      integer, private :: unit = 0
      integer, private :: position = 1             !! next character of the block
      integer, private :: filled = 0               !! characters in the block
      integer(int64), private :: left = 0          !! characters of the file not yet in the block
      character(len=:), allocatable, private :: block
   end type text_file

contains

   !> Open a file for next_line. On failure `message` says why, otherwise it is empty.
   subroutine open_text(file, name, message)
      type(text_file), intent(out) :: file
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: message
      character(len=200) :: system_message
      integer :: status

      message = ''
      file%name = name
      system_message = ''
      open (newunit=file%unit, file=name, access='stream', form='unformatted', action='read', &
            status='old', iostat=status, iomsg=system_message)
      if (status /= 0) then
         message = name//': cannot be read: '//trim(system_message)
         return
      end if
      inquire (unit=file%unit, size=file%left)
      if (file%left < 0) message = name//': cannot be read: its size is unknown'
      allocate (character(len=block_length) :: file%block)
   end subroutine open_text

   !> The next line, without its line end (LF or CR LF). `found` is false at the end of the file.
   !! A read error ends the file and is told in `message`, which is otherwise empty.
   subroutine next_line(file, line, found, message)
      type(text_file), intent(inout) :: file
      character(len=:), allocatable, intent(inout) :: line
      logical, intent(out) :: found
      character(len=:), allocatable, intent(inout) :: message
      integer :: length, status

      line = ''
      found = .false.
      status = 0
      do
         if (file%position > file%filled) call refill(file, status)
         if (status /= 0) then
            message = file%name//': a read error after line '//text_of(file%line_number)
            found = .false.
            return
         end if
         if (file%filled == 0) exit
         if (.not. found) file%line_number = file%line_number + 1
         found = .true.
         length = index(file%block(file%position:file%filled), new_line('a'))
         file%complete = length > 0
         if (length == 0) then                    ! the line goes on in the next block
            line = line//file%block(file%position:file%filled)
            file%position = file%filled + 1
         else
            line = line//file%block(file%position:file%position + length - 2)
            file%position = file%position + length
            exit
         end if
      end do
      length = len(line)
      if (length > 0) then
         if (line(length:length) == achar(13)) line = line(:length - 1)
      end if
   end subroutine next_line

   !> Fill the block with the next part of the file; `filled` is 0 at its end.
   subroutine refill(file, status)
      type(text_file), intent(inout) :: file
      integer, intent(out) :: status

      status = 0
      file%position = 1
      file%filled = int(min(file%left, int(block_length, int64)))
      if (file%filled == 0) return
      read (file%unit, iostat=status) file%block(:file%filled)
      file%left = file%left - file%filled
   end subroutine refill

   !> Close a file opened by open_text.
   subroutine close_text(file)
      type(text_file), intent(inout) :: file

      close (file%unit)
   end subroutine close_text

   !> The first token of `text` at or after `position`: text(first:last); first = 0 if there is none.
   !! On exit `position` stands behind it. Blanks and tabs separate tokens.
   pure subroutine next_token(text, position, first, last)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: position
      integer, intent(out) :: first, last

      first = 0
      last = -1
      do while (position <= len(text))
         if (.not. is_blank(text(position:position))) exit
         position = position + 1
      end do
      if (position > len(text)) return
      first = position
      do while (position <= len(text))
         if (is_blank(text(position:position))) exit
         position = position + 1
      end do
      last = position - 1
   end subroutine next_token

   !> Field text(first:last) that starts at `at`; then `at` is the start of the next one, past len(text) + 1 if none.
   pure subroutine next_field(text, at, first, last)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: at
      integer, intent(out) :: first, last
      integer :: comma

      comma = index(text(at:), ',')
      first = at
      last = merge(at + comma - 2, len(text), comma > 0)
      at = last + 2
   end subroutine next_field

   !> The n-th token of a short text, empty if there are fewer.
   pure function word(text, n) result(token)
      character(len=*), intent(in) :: text
      integer, intent(in) :: n
      character(len=:), allocatable :: token
      integer :: i, position, first, last

      token = ''
      position = 1
      do i = 1, n
         call next_token(text, position, first, last)
         if (first == 0) return
      end do
      if (n > 0) token = text(first:last)
   end function word

   pure logical function is_blank(c)
      character(len=1), intent(in) :: c

      is_blank = c == ' ' .or. c == achar(9)
   end function is_blank

   !> Is the token a number? Integers: 12, -3. Reals: 0.5, 1., 0.57407E+00, 1d-3, 2E5, and 0.5-103, as
   !! Fortran writes three digits of exponent; without a point 1-3 is text.
   pure integer function number_kind(token)
      character(len=*), intent(in) :: token
      integer :: i, whole, fraction, exponent
      logical :: point, letter

      number_kind = not_a_number
      i = 1
      if (has(token, i, '+-')) i = i + 1
      whole = digits_at(token, i)
      i = i + whole
      point = has(token, i, '.')
      fraction = 0
      if (point) then
         fraction = digits_at(token, i + 1)
         i = i + 1 + fraction
      end if
      if (whole + fraction == 0) return
      if (i > len(token)) then
         number_kind = merge(a_real, an_integer, point)
         return
      end if
      letter = has(token, i, 'EeDdQq')
      if (letter) i = i + 1
      if (has(token, i, '+-')) then
         i = i + 1
      else if (.not. letter) then
         return
      end if
      exponent = digits_at(token, i)
      if (exponent > 0 .and. i + exponent > len(token) .and. (letter .or. point)) number_kind = a_real
   end function number_kind

   !> Value of a token for which number_kind is not zero. `finite` is false where it is beyond the range.
   subroutine number_value(token, value, finite)
      character(len=*), intent(in) :: token
      real(real64), intent(out) :: value
      logical, intent(out) :: finite
      integer :: status

      read (token, *, iostat=status) value
      finite = status == 0
      if (finite) finite = ieee_is_finite(value)
      if (.not. finite) value = huge(value)
   end subroutine number_value

   !> Are two integer tokens of any length the same number? A real, such as 12.0, is never the same as 12.
   pure logical function same_integer(a, b)
      character(len=*), intent(in) :: a, b
      integer :: first_a, first_b

      first_a = verify(a, '+-0')
      first_b = verify(b, '+-0')
      if (first_a == 0 .or. first_b == 0) then
         same_integer = first_a == first_b
      else
         same_integer = a(first_a:) == b(first_b:) .and. (a(1:1) == '-' .eqv. b(1:1) == '-')
      end if
   end function same_integer

   !> What no result may contain: 'not finite' where the text has the word NaN, Inf or Infinity in any
   !! case, also touching digits (12.5Infinity), 'overflow field' where it has asterisks in a row as
   !! Fortran writes them into a field that is too narrow; empty if it has neither.
   pure function defect(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: defect
      integer :: i, length

      defect = ''
      i = 1
      do while (i <= len(text))
         length = 1
         select case (text(i:i))
         case ('*')
            length = run(text, i, '*')
            if (length >= overflow_shortest .and. length <= overflow_longest) then
               defect = 'overflow field'
               return
            end if
         case ('a':'z', 'A':'Z', '_')
            length = letters_at(text, i)
            if (length == 3 .or. length == 8) then
               select case (lower(text(i:i + length - 1)))
               case ('nan', 'inf', 'infinity')
                  defect = 'not finite'
                  return
               end select
            end if
         end select
         i = i + length
      end do
   end function defect

   pure logical function has(text, i, set)
      character(len=*), intent(in) :: text, set
      integer, intent(in) :: i

      has = .false.
      if (i <= len(text)) has = index(set, text(i:i)) > 0
   end function has

   pure integer function run(text, i, set)
      character(len=*), intent(in) :: text, set
      integer, intent(in) :: i

      run = verify(text(i:), set) - 1
      if (run < 0) run = len(text) - i + 1
   end function run

   pure integer function digits_at(text, i)
      character(len=*), intent(in) :: text
      integer, intent(in) :: i

      digits_at = 0
      if (i <= len(text)) digits_at = run(text, i, '0123456789')
   end function digits_at

   pure integer function letters_at(text, i)
      character(len=*), intent(in) :: text
      integer, intent(in) :: i

      letters_at = run(text, i, '_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ')
   end function letters_at

   pure function lower(text)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: lower
      integer :: i

      lower = text
      do i = 1, len(text)
         if (text(i:i) >= 'A' .and. text(i:i) <= 'Z') lower(i:i) = achar(iachar(text(i:i)) + 32)
      end do
   end function lower

   pure function text_of(n)
      integer, intent(in) :: n
      character(len=:), allocatable :: text_of
      character(len=12) :: digits

      write (digits, '(i0)') n
      text_of = trim(digits)
   end function text_of

   !> The i-th word of the command line.
   function argument(i)
      integer, intent(in) :: i
      character(len=:), allocatable :: argument
      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(len=length) :: argument)
      call get_command_argument(i, argument)
   end function argument

   !> Stop with exit status 2.
   subroutine give_up(why)
      character(len=*), intent(in) :: why

      write (error_unit, '(a)') why
      stop 2, quiet=.true.
   end subroutine give_up

end module comparison_text
