!> A whole CSV file: titles and cells.
module csv_table
   use comparison_text, only: text_file, open_text, next_line, close_text, next_field, text_of
   implicit none
   private

   public :: read_table, column_of

   integer, parameter, public :: cell_length = 48  !! characters of the longest cell

   !> Rows of cells; blanks around a cell are cut.
   type, public :: table
      character(len=:), allocatable :: name
      character(len=cell_length), allocatable :: titles(:)
      character(len=cell_length), allocatable :: cells(:, :)   !! (column, row)
      integer, allocatable :: lines(:)                         !! of the file, for each row
   end type table

   type :: text_line
      character(len=:), allocatable :: text
   end type text_line

contains

   !> Read the file. Lines that begin with # are comments. On failure `message` says why, otherwise it is empty.
   subroutine read_table(name, rows, message)
      character(len=*), intent(in) :: name
      type(table), intent(out) :: rows
      character(len=:), allocatable, intent(out) :: message
      type(text_line), allocatable :: lines(:)
      integer, allocatable :: numbers(:)
      integer :: n, i

      rows%name = name
      call read_lines(name, lines, numbers, n, message)
      if (message == '' .and. n == 0) message = name//': no titles of columns'
      if (message /= '') return
      rows%lines = numbers(2:n)
      allocate (rows%titles(count([(lines(1)%text(i:i) == ',', i=1, len(lines(1)%text))]) + 1))
      allocate (rows%cells(size(rows%titles), n - 1))
      call cut(lines(1)%text, name//':'//text_of(numbers(1)), rows%titles, message)
      do i = 2, n
         if (message == '') call cut(lines(i)%text, name//':'//text_of(numbers(i)), rows%cells(:, i - 1), message)
      end do
   end subroutine read_table

   !> The n lines of the file that are no comments, and their numbers.
   subroutine read_lines(name, lines, numbers, n, message)
      character(len=*), intent(in) :: name
      type(text_line), allocatable, intent(out) :: lines(:)
      integer, allocatable, intent(out) :: numbers(:)
      integer, intent(out) :: n
      character(len=:), allocatable, intent(out) :: message
      type(text_line), allocatable :: more(:)
      character(len=:), allocatable :: line
      type(text_file) :: file
      logical :: found

      n = 0
      allocate (lines(1024), numbers(0))
      call open_text(file, name, message)
      if (message /= '') return
      do
         call next_line(file, line, found, message)
         if (.not. found) exit
         if (index(line, '#') == 1) cycle
         n = n + 1
         if (n > size(lines)) then
            allocate (more(2*n))
            more(:n - 1) = lines
            call move_alloc(more, lines)
         end if
         lines(n)%text = line
         numbers = [numbers, file%line_number]
      end do
      call close_text(file)
   end subroutine read_lines

   !> The cells of a line, as many as there are titles.
   subroutine cut(line, place, cells, message)
      character(len=*), intent(in) :: line, place
      character(len=*), intent(out) :: cells(:)
      character(len=:), allocatable, intent(inout) :: message
      integer :: i, at, first, last

      at = 1
      do i = 1, size(cells)
         cells(i) = ''
         if (at > len(line) + 1) message = place//': fewer cells than titles'
         if (message /= '') return
         call next_field(line, at, first, last)
         cells(i) = adjustl(line(first:last))
         if (len_trim(adjustl(line(first:last))) > cell_length) message = place//': a cell that is too long'
      end do
      if (at <= len(line) + 1) message = place//': more cells than titles'
   end subroutine cut

   !> The column with this title, 0 where there is none.
   pure integer function column_of(rows, title)
      type(table), intent(in) :: rows
      character(len=*), intent(in) :: title

      do column_of = size(rows%titles), 1, -1
         if (rows%titles(column_of) == title) exit
      end do
   end function column_of

end module csv_table
