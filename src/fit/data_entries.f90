!> One line of a data file cut into its entries.
module data_entries
   implicit none
   private

   public :: split_entries, without_comment

   !> Where an entry stands in its line; an entry left out between two commas has LAST < FIRST.
   type, public :: entry_type
      integer :: first = 0, last = 0
   end type entry_type

contains

   !> LINE up to its comment, which # or $ begins, without blanks and tabs at its end.
   pure function without_comment(line) result(words)
      character(*), intent(in)  :: line
      character(:), allocatable :: words
      integer :: length

      length = scan(line, '#$') - 1
      if (length < 0) length = len(line)
      words = line(:verify(line(:length), ' '//achar(9), back=.true.))
   end function without_comment


   !> Cut LINE at blanks, tabs and commas. Blanks around a comma go with it; nothing between two commas, or before the
   !! first or behind the last, is an entry left out.
   pure subroutine split_entries(line, entries)
      character(*), intent(in)                   :: line
      type(entry_type), allocatable, intent(out) :: entries(:)
      type(entry_type) :: found(len(line) + 1)
      integer :: at, length, n
      logical :: comma  ! one has been read and waits for the entry behind it

      n = 0
      at = 1
      comma = .false.
      do
         length = verify(line(at:), ' '//achar(9)) - 1
         if (length < 0) exit
         at = at + length
         n = n + 1
         length = scan(line(at:), ' ,'//achar(9)) - 1
         if (length < 0) length = len(line) - at + 1
         found(n) = entry_type(at, at + length - 1)
         at = at + length
         length = verify(line(at:), ' '//achar(9)) - 1
         if (length >= 0) at = at + length
         comma = .false.
         if (at <= len(line)) comma = line(at:at) == ','
         if (comma) at = at + 1
      end do
      if (comma) then
         n = n + 1
         found(n) = entry_type(len(line) + 1, len(line))
      end if
      entries = found(:n)
   end subroutine split_entries

end module data_entries
