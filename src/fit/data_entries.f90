!> One line of a data file cut into its entries, and the numbers among them.
module data_entries
   use deck_numbers, only: parse_real
   use kinds, only: wp
   implicit none
   private

   public :: split_entries, data_part, split_unit, is_number, read_number

   character(*), parameter :: blanks = ' '//achar(9)

   !> Where an entry stands in its line; an entry left out between two separators has LAST < FIRST.
   type, public :: entry_type
      integer :: first = 0, last = 0
   end type entry_type

contains

   !> LINE up to its comment, which # or $ begins, without blanks and tabs at its end; double quotes, which spreadsheets put
   !! around words, become blanks.
   pure function data_part(line) result(words)
      character(*), intent(in)  :: line
      character(:), allocatable :: words
      integer :: k

      words = line(:scan(line//'#', '#$') - 1)
      do k = 1, len(words)
         if (words(k:k) == '"') words(k:k) = ' '
      end do
      words = words(:verify(words, blanks, back=.true.))
   end function data_part

   !> Cut LINE at blanks, tabs, commas and semicolons. Blanks around a separator go with it; nothing between two, or before the
   !! first or behind the last, is an entry left out. What stands in brackets, and blanks before them, cuts nothing: `lambda [um]`
   !! is one entry; nor does the DECIMAL_COMMA, one before a digit, which a line with semicolons has anyway.
   pure subroutine split_entries(line, entries, decimal_comma)
      character(*), intent(in)                   :: line
      type(entry_type), allocatable, intent(out) :: entries(:)
      logical, intent(in)                        :: decimal_comma
      character(len(line)) :: open
      integer :: at, k, last
      logical :: waits  ! a separator has been read and waits for the entry behind it

      open = without_brackets(line)
      if (decimal_comma .or. index(open, ';') > 0) then
         do k = 1, len(line) - 1
            if (line(k:k) == ',' .and. scan(line(k + 1:k + 1), '0123456789') == 1) open(k:k) = 'x'
         end do
      end if
      allocate (entries(0))
      waits = .false.
      at = next(1)
      do while (at <= len(line))
         last = at + scan(open(at:)//' ', blanks//',;') - 2
         entries = [entries, entry_type(at, last)]
         at = next(last + 1)
         if (at > len(line)) return
         waits = scan(open(at:at), ',;') == 1
         if (waits) at = next(at + 1)
      end do
      if (waits) entries = [entries, entry_type(len(line) + 1, len(line))]

   contains

      !> The next place from FROM on that is not blank.
      pure integer function next(from)
         integer, intent(in) :: from

         next = from + verify(open(from:)//',', blanks) - 1
      end function next

   end subroutine split_entries

   !> LINE with x for all that stands in brackets and for the blanks between a name and its brackets.
   pure function without_brackets(line) result(masked)
      character(*), intent(in) :: line
      character(len(line))     :: masked
      integer :: first, last, name

      masked = line
      do
         first = scan(masked, '[(')
         if (first == 0) return
         last = first + scan(masked(first:)//')', '])') - 1
         last = min(last, len(line))
         name = verify(masked(:first - 1), blanks, back=.true.)
         if (name > 0) then
            if (scan(line(name:name), ',;])') == 0) first = name + 1
         end if
         masked(first:last) = repeat('x', last - first + 1)
      end do
   end function without_brackets

   !> The NAME and the UNIT in an entry of a header, `lambda [um]` or `lambda(um)`; no brackets: no unit.
   pure subroutine split_unit(entry, name, unit)
      character(*), intent(in)               :: entry
      character(:), allocatable, intent(out) :: name, unit
      integer :: first

      first = scan(entry//'[', '[(')
      name = entry(:verify(entry(:first - 1), blanks, back=.true.))
      unit = ''
      if (first < len(entry)) unit = trim(adjustl(entry(first + 1:first + scan(entry(first + 1:)//')', '])') - 1)))
   end subroutine split_unit

   !> Whether WORD begins like a number.
   pure logical function is_number(word)
      character(*), intent(in) :: word

      is_number = scan(word, '0123456789+-.,') == 1
   end function is_number

   !> A number of the data or the command, which may do without the decimal point that cards need, or have a comma for it.
   pure subroutine read_number(text, value, ok)
      character(*), intent(in) :: text
      real(wp), intent(out)    :: value
      logical, intent(out)     :: ok
      character(len(text)) :: number
      integer :: comma

      number = text
      comma = index(text, ',')
      if (comma > 0) number(comma:comma) = '.'
      call parse_real(number, value, ok)
      if (.not. ok) call parse_real(number//'.', value, ok)
   end subroutine read_number

end module data_entries
