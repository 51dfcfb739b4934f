!> Lines of the listing: headings, long text, numbers in their formats, the level of rounding.
module page_lines
   use kinds, only: wp
   use output_file, only: output_file_type
   use text_tools, only: fitted_text
   implicit none
   private

   public :: heading, put_lines, cut, in_form, in_units

   integer, parameter, public      :: page_width = 132
   character(1), parameter, public :: axes(3) = ['X', 'Y', 'Z']

contains

   !> VALUE in the format FORM of WIDTH characters; a value too wide is given an exponent and fewer digits, after a blank. So is a
   !! value of more than seven digits in a wide format f: rounding leaves no more of a quotient of forces.
   pure function in_form(value, form, width) result(field)
      real(wp), intent(in)     :: value
      character(*), intent(in) :: form  !! '(f9.3)'
      integer, intent(in)      :: width
      character(width) :: field
      integer :: k

      write (field, form) value
      if (index(field, '*') > 0) then
         field = fitted_text(value, width - 1)
      else if (form(2:2) == 'f' .and. width >= 11 .and. count([(index('0123456789', field(k:k)) > 0, k=1, width)]) > 7) then
         write (field, '(es11.4)') value
      end if
      field = adjustr(field)
   end function in_form

   !> A heading of a table, with an empty line before it.
   subroutine heading(file, words)
      type(output_file_type), intent(inout) :: file
      character(*), intent(in)              :: words

      call file%put('')
      call file%put(' '//cut(words, page_width - 1))
      call file%put('')
   end subroutine heading

   !> Write WORDS in as many lines as the page needs, broken after a SEPARATOR.
   subroutine put_lines(file, words, separator)
      type(output_file_type), intent(inout) :: file
      character(*), intent(in)              :: words, separator
      integer :: first, last

      first = 1
      do while (first <= len(words))
         last = min(first + page_width - 6, len(words))
         if (last < len(words)) last = first - 1 + max(1, index(words(first:last), separator, back=.true.))
         call file%put('  '//repeat(' ', merge(0, 1, first == 1))//words(first:last))
         first = last + 1
      end do
   end subroutine put_lines

   !> The unit behind a heading, in brackets; empty where LABEL is blank.
   pure function in_units(label) result(words)
      character(*), intent(in)  :: label
      character(:), allocatable :: words

      words = ''
      if (label /= '') words = '   ('//trim(label)//')'
   end function in_units

   !> At most WIDTH characters of LINE, with tabs and other control characters as blanks.
   pure function cut(line, width) result(part)
      character(*), intent(in)  :: line
      integer, intent(in)       :: width
      character(:), allocatable :: part
      integer :: i

      part = line(:min(len(line), width))
      if (len(line) > width) part(width - 2:) = '...'
      do i = 1, len(part)
         if (iachar(part(i:i)) < 32) part(i:i) = ' '
      end do
   end function cut

end module page_lines
