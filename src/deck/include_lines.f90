!> Interprets an INCLUDE: recognises its line, finds whether its name goes on on the next line, and takes the name.
module include_lines
   use text_tools, only: upper
   implicit none
   private

   public :: is_include, is_open, file_named_by

contains

   !> Whether LINE (its card part) is an INCLUDE: the word, followed by a blank, a quote or an equals sign.
   pure logical function is_include(line)
      character(*), intent(in) :: line
      integer :: first

      is_include = .false.
      first = verify(line, ' ')
      if (first == 0) return
      if (line(first:first) /= 'I' .and. line(first:first) /= 'i') return ! the usual case
      is_include = upper(line(first:min(first + 6, len(line)))) == 'INCLUDE'
      if (is_include .and. len(line) > first + 6) is_include = scan(line(first + 7:first + 7), ' ''"=') == 1
   end function is_include

   !> Whether STATEMENT, an INCLUDE, ends within a name in quotes: the name goes on on the next line.
   pure logical function is_open(statement)
      character(*), intent(in) :: statement
      integer :: quote

      quote = scan(statement, '''"')
      is_open = quote > 0
      if (is_open) is_open = index(statement(quote + 1:), statement(quote:quote)) == 0
   end function is_open

   !> The name of the file in STATEMENT, an INCLUDE; empty where there is none.
   pure function file_named_by(statement) result(path)
      character(*), intent(in)  :: statement
      character(:), allocatable :: path
      integer :: closing

      path = adjustl(statement)
      path = trim(adjustl(path(8:)))
      if (index(path, '=') == 1) path = trim(adjustl(path(2:)))
      if (scan(path, '''"') == 1) then ! in quotes, the last character of the statement is the closing one
         closing = index(path(2:), path(1:1))
         path = path(2:merge(closing, 0, len(path) == closing + 1))
      end if
   end function file_named_by

end module include_lines
