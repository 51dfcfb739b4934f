!> Replaces tabs in a deck by blanks up to the next column of eight, where the next field of small fields begins.
!!
!! A deck whose entries are separated by tabs, not aligned by them, looks the same as long as its entries are shorter than a field.
!! An entry that fills a field and is followed by a tab has two meanings: the tab ends the field, or it skips the next one.
module tab_columns
   use kinds, only: long
   use text_tools, only: integer_text
   implicit none
   private

   public :: blank_tabs, expand_tabs

   integer, parameter :: width = 8

   character(1), parameter :: tab = achar(9)

contains

   !> A blank for every tab of BYTES.
   pure subroutine blank_tabs(bytes)
      character(*), intent(inout) :: bytes
      integer(long) :: i

      do i = 1, len(bytes, long)
         if (bytes(i:i) == tab) bytes(i:i) = ' '
      end do
   end subroutine blank_tabs

   !> Expand the tabs of BYTES. N lines have tabs outside of comments, the first of them is line FIRST. FAULT describes the first entry
   !! with two meanings; it is empty where there is none.
   subroutine expand_tabs(bytes, n, first, fault)
      character(:), allocatable, intent(inout) :: bytes
      integer, intent(out)                     :: n, first
      character(:), allocatable, intent(out)   :: fault
      character(:), allocatable :: wide
      integer(long) :: at, i
      integer :: column, field, line, run
      logical :: in_card, is_free, has_tab

      n = 0
      first = 0
      fault = ''
      if (index(bytes, tab) == 0) return
      allocate (character(len(bytes, long) + (width - 1)*number_of_tabs(bytes)) :: wide)
      at = 0
      line = 0
      call start_line()
      do i = 1, len(bytes, long)
         if (bytes(i:i) == tab) then
            if (in_card) then
               if (.not. has_tab) n = n + 1
               if (first == 0) first = line
               has_tab = .true.
               if (run >= field .and. .not. is_free .and. fault == '') fault = 'line '//integer_text(line)//': an entry of '// &
                  integer_text(run)//' characters before a tab, which ends its field or skips the next one; expected blanks '// &
                  'up to the column of the next field, or commas'
            end if
            run = 0
            do
               call put(' ')
               if (modulo(column, width) == 0) exit
            end do
            cycle
         end if
         if (bytes(i:i) == '$') in_card = .false.
         if (bytes(i:i) == ',') is_free = .true.
         if (bytes(i:i) == '*' .and. column < width) field = 2*width
         run = merge(0, run + 1, bytes(i:i) == ' ')
         call put(bytes(i:i))
         if (bytes(i:i) == achar(10)) call start_line()
      end do
      bytes = wide(:at)

   contains

      subroutine start_line()
         line = line + 1
         column = 0
         run = 0
         field = width
         in_card = .true.
         is_free = .false.
         has_tab = .false.
      end subroutine start_line

      subroutine put(letter)
         character(1), intent(in) :: letter

         at = at + 1
         column = column + 1
         wide(at:at) = letter
      end subroutine put

   end subroutine expand_tabs

   pure integer(long) function number_of_tabs(bytes) result(n)
      character(*), intent(in) :: bytes
      integer(long) :: i

      n = 0
      do i = 1, len(bytes, long)
         if (bytes(i:i) == tab) n = n + 1
      end do
   end function number_of_tabs

end module tab_columns
