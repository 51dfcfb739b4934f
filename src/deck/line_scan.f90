!> One line of a deck, found in the bytes of its file: where it ends, its card part, its first comma; and the file that it brings in
!! where it is an INCLUDE 'mesh.bdf'.
module line_scan
   use, intrinsic :: iso_fortran_env, only: int8
   use kinds, only: long
   use text_tools, only: upper
   implicit none
   private

   public :: scan_line, is_include, included_path

   !> Where a line stands. Its card part is the line without its comment ($ to the end) and without blanks at its end.
   type, public :: line_place
      integer(long) :: start  = 0 !! byte of its file, from 1
      integer       :: length = 0 !! of the card part
      integer       :: comma  = 0 !! column of the first comma in the card part, 0: none
   end type line_place

   ! what a byte means
   integer, parameter :: plain = 0, line_feed = 1, carriage_return = 2, tab = 3, dollar = 4, comma = 5, control = 6
   integer :: code
   integer(int8), parameter :: meaning(0:255) = int([(control, code = 0, 8), tab, line_feed, control, control, carriage_return, &
      (control, code = 14, 31), (plain, code = 32, 35), dollar, (plain, code = 37, 43), comma, (plain, code = 45, 126), &
      control, (plain, code = 128, 255)], int8)

contains

   !> The line of BYTES that begins at START, each byte looked at once.
   pure subroutine scan_line(bytes, start, line, next, has_tab, bad)
      character(*), intent(in)      :: bytes
      integer(long), intent(in)     :: start
      type(line_place), intent(out) :: line
      integer(long), intent(out)    :: next    !! where the line behind it begins
      logical, intent(out)          :: has_tab !! in the card part
      integer, intent(out)          :: bad     !! code of the first byte that no text file holds (a control character other
                                               !! than a tab), -1: none
      integer(long) :: i, finish
      logical :: in_card ! the card part goes on

      bad = -1
      has_tab = .false.
      in_card = .true.
      line%start = start
      finish = len(bytes, long)
      next = finish + 1
      do i = start, len(bytes, long)
         select case (meaning(iachar(bytes(i:i))))
         case (plain)
            cycle
         case (comma)
            if (in_card .and. line%comma == 0) line%comma = int(i - start + 1)
         case (tab)
            has_tab = has_tab .or. in_card
         case (dollar)
            if (in_card) finish = i - 1
            in_card = .false.
         case (carriage_return)
            if (bad < 0 .and. .not. ends_line(bytes, i)) bad = iachar(bytes(i:i))
            if (in_card) finish = i - 1
            in_card = .false.
         case (line_feed)
            if (in_card) finish = i - 1
            next = i + 1
            exit
         case default
            if (bad < 0) bad = iachar(bytes(i:i))
         end select
      end do
      do while (finish >= start)
         if (iachar(bytes(finish:finish)) /= iachar(' ')) exit ! characters would be compared by a call of the library
         finish = finish - 1
      end do
      line%length = int(finish - start + 1)
   end subroutine scan_line

   !> Whether the carriage return at I stands at the end of its line.
   pure logical function ends_line(bytes, i)
      character(*), intent(in)  :: bytes
      integer(long), intent(in) :: i

      ends_line = i == len(bytes, long)
      if (.not. ends_line) ends_line = bytes(i + 1:i + 1) == achar(10)
   end function ends_line

   !> Whether LINE (its card part) is an INCLUDE: the word, then a blank, a quote or an equals sign.
   pure logical function is_include(line)
      character(*), intent(in) :: line
      integer :: first

      is_include = .false.
      first = verify(line, ' ')
      if (first == 0) return
      if (len(line) < first + 6) return
      if (line(first:first) /= 'I' .and. line(first:first) /= 'i') return ! most lines
      if (upper(line(first:first + 6)) /= 'INCLUDE') return
      is_include = .true.
      if (len(line) > first + 6) is_include = scan(line(first + 7:first + 7), ' ''"=') == 1
   end function is_include

   !> The file name in what follows the word INCLUDE: in quotes of either kind, or bare.
   pure function included_path(words) result(path)
      character(*), intent(in)  :: words
      character(:), allocatable :: path
      integer :: closing

      path = trim(adjustl(words))
      if (path == '') return
      if (path(1:1) == '=') path = trim(adjustl(path(2:)))
      if (path == '') return
      if (path(1:1) == '''' .or. path(1:1) == '"') then
         closing = index(path(2:), path(1:1))
         if (closing == 0) then
            path = ''
         else if (len_trim(path) > closing + 1) then
            path = ''
         else
            path = path(2:closing)
         end if
      end if
   end function included_path

end module line_scan
