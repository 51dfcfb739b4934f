!> A cell of a table: nothing, a number or words; the rows that a table keeps, and their cells in a restart file.
module table_cell
   use kinds, only: long, wp
   use restart_stream, only: restart_stream_type
   implicit none
   private

   public :: set_words, record_rows

   ! what a cell has; words across all columns are the only cell of their row
   integer, parameter, public :: missing = 0, empty = 1, whole = 2, real_number = 3, in_words = 4, across = 5

   type, public :: cell_type
      integer  :: kind = missing
      integer  :: number = 0
      real(wp) :: value = 0.0_wp
      real(wp) :: shown = 0.0_wp      !! the same without its rounding, in the listing
      character(:), allocatable :: words
   end type cell_type

   type, public :: row_type
      type(cell_type), allocatable :: cells(:) !! (columns), or one across all columns
   end type row_type

contains

   !> Set the WORDS of CELL. (The compiler does not check the allocation of an assignment to a text of another length.)
   pure subroutine set_words(words, cell)
      character(*), intent(in)       :: words
      type(cell_type), intent(inout) :: cell

      if (allocated(cell%words)) then
         if (len(cell%words) /= len(words)) deallocate (cell%words)
      end if
      if (.not. allocated(cell%words)) allocate (character(len(words)) :: cell%words)
      cell%words = words
   end subroutine set_words

   !> Write the first N of ROWS to a restart file, or read N rows.
   subroutine record_rows(stream, n, rows)
      type(restart_stream_type), intent(inout)   :: stream
      integer, intent(inout)                     :: n
      type(row_type), allocatable, intent(inout) :: rows(:)
      type(cell_type), allocatable :: all_cells(:)
      integer, allocatable :: counts(:) ! cells of each row
      integer :: first, i, n_cells

      call stream%extent('n_kept', n, 4)
      allocate (counts(n), source=0)
      if (stream%writes) counts = [(size(rows(i)%cells), i = 1, n)]
      call stream%item('kept', counts)
      n_cells = 0
      if (stream%writes) n_cells = sum(counts)
      allocate (all_cells(n_cells))
      first = 0
      if (stream%writes) then
         do i = 1, n
            all_cells(first + 1:first + counts(i)) = rows(i)%cells
            first = first + counts(i)
         end do
      end if
      call record_cells(stream, all_cells)
      if (stream%writes) return
      if (any(counts < 0) .or. sum(int(counts, long)) /= size(all_cells)) call stream%fail('its rows have no cells')
      if (allocated(stream%fault)) n = 0
      if (allocated(rows)) deallocate (rows)
      allocate (rows(n))
      do i = 1, n
         rows(i)%cells = all_cells(first + 1:first + counts(i))
         first = first + counts(i)
      end do
   end subroutine record_rows

   !> The CELLS of all rows; the words of all cells are one text.
   subroutine record_cells(stream, cells)
      type(restart_stream_type), intent(inout)    :: stream
      type(cell_type), allocatable, intent(inout) :: cells(:)
      character(:), allocatable :: words
      integer, allocatable :: lengths(:) ! -1: not allocated
      integer :: i, n
      integer(long) :: last

      n = size(cells)
      call stream%part('cell_type', 1)
      call stream%extent('cells', n, 28)
      if (.not. stream%writes) then
         deallocate (cells)
         allocate (cells(n))
      end if
      allocate (lengths(n), source=-1)
      words = ''
      if (stream%writes) call join_words(cells, lengths, words)
      call stream%item('kind', cells%kind)
      call stream%item('number', cells%number)
      call stream%item('value', cells%value)
      call stream%item('shown', cells%shown)
      call stream%item('lengths', lengths)
      call stream%text('words', words)
      if (stream%writes) return
      last = 0
      if (allocated(words)) last = len(words, long)
      if (sum(int(max(0, lengths), long)) /= last) call stream%fail('its cells have no words')
      if (allocated(stream%fault)) return
      last = 0
      do i = 1, n
         if (lengths(i) >= 0) allocate (cells(i)%words, source=words(last + 1:last + lengths(i)))
         last = last + max(0, lengths(i))
      end do
   end subroutine record_cells

   !> The WORDS of CELLS as one text, and their LENGTHS, which are -1 where there are none.
   pure subroutine join_words(cells, lengths, words)
      type(cell_type), intent(in) :: cells(:)
      integer, intent(inout)      :: lengths(:)
      character(:), allocatable, intent(out) :: words
      integer(long) :: last
      integer :: i

      do i = 1, size(cells)
         if (allocated(cells(i)%words)) lengths(i) = len(cells(i)%words)
      end do
      allocate (character(sum(int(max(0, lengths), long))) :: words)
      last = 0
      do i = 1, size(cells)
         if (lengths(i) > 0) words(last + 1:last + lengths(i)) = cells(i)%words
         last = last + max(0, lengths(i))
      end do
   end subroutine join_words

end module table_cell
