!> Replaces ${NAME} in a deck by the number or word that the command gives with --set NAME=VALUE.
module deck_parameters
   use kinds, only: long
   use text_tools, only: integer_text
   implicit none
   private

   public :: fill_parameters, is_parameter_name

   character(*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_'

   !> NAME=VALUE of the command line.
   type, public :: parameter_type
      character(:), allocatable :: name, value
      logical :: is_used = .false. !! the deck uses it
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
      integer(long) :: finish, start, used
      integer :: n

      fault = ''
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
         if (index(line, '${') > 0) call fill_line(line, n, parameters, fault)
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

   !> Put the values into one LINE, number N of its file. A value is not searched for parameters.
   subroutine fill_line(line, n, parameters, fault)
      character(:), allocatable, intent(inout) :: line
      integer, intent(in)                      :: n
      type(parameter_type), intent(inout)      :: parameters(:)
      character(:), allocatable, intent(inout) :: fault
      character(:), allocatable :: name, rest, value
      integer :: at, blanks, closing, done, k, width
      logical :: is_fixed

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
         value = parameters(k)%value
         rest = line(at + closing:)
         width = max(closing, len(value))
         if (len(value) > closing .and. verify(rest, ' '//achar(13)//achar(10)) > 0) then
            blanks = verify(rest, ' ') - 1
            if (is_fixed .and. blanks < len(value) - closing .and. fault == '') fault = 'line '//integer_text(n)//': '//value// &
               ' in the place of ${'//name//'} does not fit in front of what follows'
            rest = rest(1 + min(blanks, len(value) - closing):)
         end if
         line = line(:at - 1)//value//repeat(' ', width - len(value))//rest
         done = at - 1 + len(value)
      end do
   end subroutine fill_line

end module deck_parameters
