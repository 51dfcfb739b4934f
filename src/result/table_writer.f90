!> The tables of the results, for the listing, the screen and CSV files. A table is a list of columns. A column has a heading,
!! the edit descriptor of its values, a unit, and a name in the CSV file. The lines of headings and units, the titles of the CSV
!! file and every row of both follow from it:
!!
!!    call table%start('REACTIONS', [csv('stage'), column('NODE', 'i11', name='node'), &
!!                                   column('R'//axes, 'es13.5', labels%force)], file)
!!    call table%put('stage', stage)
!!    call table%put('node', node)
!!    call table%put('R'//axes, reaction)
!!    call table%print_row(file, csv_file)
!!
!! A cell is put by the key of its column: the name in the CSV file, else the heading, unless the column gives another key. The program
!! ends where a key is unknown, is put twice, or is missing in a row: any run that prints the table shows such an error. Values of a column without a heading are written only to the CSV file, those of a column without a name only to the
!! listing. A table of a whole stage keeps the values of its rows until they are printed.
module table_writer
   use kinds, only: wp
   use output_file, only: output_file_type
   use page_lines, only: heading, in_form, page_width
   use restart_stream, only: restart_stream_type
   use table_cell, only: across, cell_type, empty, in_words, missing, real_number, record_rows, row_type, set_words, whole
   use table_column, only: column_type
   use text_tools, only: clean, csv_line_type, fitted_text, integer_width, short_width, write_integer, write_short
   implicit none
   private

   type, public :: table_type
      private
      character(:), allocatable :: title
      type(column_type), allocatable :: columns(:)
      type(cell_type), allocatable   :: cells(:) ! of the row so far
      integer :: last = 0                        ! the column that was put last
      integer :: n_kept = 0                      ! rows
      type(row_type), allocatable    :: kept(:)
      type(csv_line_type) :: line
   contains
      procedure :: has_begun
      procedure :: is_empty
      procedure :: start
      procedure :: print_head
      generic   :: put => put_integer, put_real, put_text, put_integers, put_reals
      procedure :: leave_rest
      procedure :: fault_of_row
      procedure :: print_row
      procedure :: keep_row
      procedure :: keep_line
      procedure :: print_kept
      procedure :: record
      procedure, private :: put_integer, put_real, put_text, put_integers, put_reals
   end type table_type

contains

   !> Whether the table has title and columns: those of a stage do not have them before the first row of the stage.
   pure logical function has_begun(self)
      class(table_type), intent(in) :: self

      has_begun = allocated(self%columns)
   end function has_begun

   !> Whether no rows are kept.
   pure logical function is_empty(self)
      class(table_type), intent(in) :: self

      is_empty = self%n_kept == 0
   end function is_empty

   !> Begin a table of these COLUMNS; write its head into FILE if present. TITLE is empty where other words precede the headings.
   !! Rows that a restart file has brought stay.
   subroutine start(self, title, columns, file)
      class(table_type), intent(inout)         :: self
      character(*), intent(in)                 :: title
      type(column_type), intent(in)            :: columns(:)
      type(output_file_type), intent(inout), optional :: file
      integer :: i

      self%title = title
      self%columns = columns
      do i = 1, size(columns)
         self%columns(i)%last = columns(i)%width + merge(self%columns(max(1, i - 1))%last, 0, i > 1)
      end do
      call begin_row(self)
      if (present(file)) call self%print_head(file)
   end subroutine start

   subroutine begin_row(self)
      class(table_type), intent(inout) :: self

      if (allocated(self%cells)) then
         if (size(self%cells) /= size(self%columns)) deallocate (self%cells)
      end if
      if (.not. allocated(self%cells)) allocate (self%cells(size(self%columns)))
      self%cells%kind = missing
      self%last = 0
   end subroutine begin_row

   !> Title, headings, and units if any.
   subroutine print_head(self, file)
      class(table_type), intent(in)         :: self
      type(output_file_type), intent(inout) :: file
      character(page_width + 1) :: headings, units
      integer :: i

      headings = ''
      units = ''
      do i = 1, size(self%columns)
         associate (column => self%columns(i))
            if (.not. column%is_listed) cycle
            if (column%width == 0) then
               headings(column%last + 1:) = column%heading
            else
               call place(headings, trim(column%heading), column%last + column%heading_shift)
               call place(units, column%unit(:min(len_trim(column%unit), column%width)), column%last + column%unit_shift)
            end if
         end associate
      end do
      if (self%title /= '') call heading(file, self%title)
      call file%put(headings)
      if (units /= '') call file%put(units)
   end subroutine print_head

   !> Put WORDS into LINE so that they end at character LAST.
   pure subroutine place(line, words, last)
      character(*), intent(inout) :: line
      character(*), intent(in)    :: words
      integer, intent(in)         :: last

      line(last - len(words) + 1:last) = words
   end subroutine place

   !> Find the cell of the column with KEY, which gets content of this KIND, none where WHERE is false. The search begins behind the
   !! column that was put last.
   subroutine find_cell(self, key, kind, at, where)
      class(table_type), intent(inout) :: self
      character(*), intent(in)         :: key
      integer, intent(in)              :: kind
      integer, intent(out)             :: at
      logical, intent(in), optional    :: where !! default: true
      integer :: k

      associate (n => size(self%columns))
         do k = 0, n - 1
            at = self%last + 1 + k
            if (at > n) at = at - n
            if (self%columns(at)%key == key) exit
         end do
         if (k >= n) error stop 'table '//self%title//' has no column '//key
      end associate
      if (self%cells(at)%kind /= missing) error stop 'table '//self%title//': column '//key//' is put twice'
      self%last = at
      self%cells(at)%kind = kind
      if (present(where)) self%cells(at)%kind = merge(kind, empty, where)
   end subroutine find_cell

   !> Put VALUE into the column with KEY of the row; the cell is empty where WHERE is false.
   subroutine put_integer(self, key, value, where)
      class(table_type), intent(inout) :: self
      character(*), intent(in)         :: key
      integer, intent(in)              :: value
      logical, intent(in), optional    :: where !! default: true
      integer :: at

      call find_cell(self, key, whole, at, where)
      self%cells(at)%number = value
   end subroutine put_integer

   !> The same with a real number; below FLOOR it is zero in the listing.
   subroutine put_real(self, key, value, floor, where)
      class(table_type), intent(inout) :: self
      character(*), intent(in)         :: key
      real(wp), intent(in)             :: value
      real(wp), intent(in), optional   :: floor
      logical, intent(in), optional    :: where
      integer :: at

      call find_cell(self, key, real_number, at, where)
      self%cells(at)%value = clean(value)
      self%cells(at)%shown = clean(value, floor)
   end subroutine put_real

   !> The same with WORDS: with all their blanks at the end of their column in the listing, without blanks in the CSV file.
   subroutine put_text(self, key, words, where)
      class(table_type), intent(inout) :: self
      character(*), intent(in)         :: key, words
      logical, intent(in), optional    :: where
      integer :: at

      call find_cell(self, key, in_words, at, where)
      call set_words(words, self%cells(at))
   end subroutine put_text

   subroutine put_integers(self, keys, values, where)
      class(table_type), intent(inout) :: self
      character(*), intent(in)         :: keys(:)
      integer, intent(in)              :: values(:) !! (keys)
      logical, intent(in), optional    :: where(:)
      integer :: i
      logical :: is_there

      is_there = .true.
      do i = 1, size(keys)
         if (present(where)) is_there = where(i)
         call self%put_integer(keys(i), values(i), is_there)
      end do
   end subroutine put_integers

   subroutine put_reals(self, keys, values, floor, where)
      class(table_type), intent(inout) :: self
      character(*), intent(in)         :: keys(:)
      real(wp), intent(in)             :: values(:) !! (keys)
      real(wp), intent(in), optional   :: floor
      logical, intent(in), optional    :: where(:)
      integer :: i
      logical :: is_there

      is_there = .true.
      do i = 1, size(keys)
         if (present(where)) is_there = where(i)
         call self%put_real(keys(i), values(i), floor, is_there)
      end do
   end subroutine put_reals

   !> Leave all other cells of the row empty.
   pure subroutine leave_rest(self)
      class(table_type), intent(inout) :: self

      where (self%cells%kind == missing) self%cells%kind = empty
   end subroutine leave_rest

   !> The error that the row lacks a cell, '': it is complete.
   pure function fault_of_row(self) result(fault)
      class(table_type), intent(in) :: self
      character(:), allocatable :: fault
      integer :: at

      fault = ''
      at = findloc(self%cells%kind, missing, dim=1)
      if (at > 0) fault = 'table '//self%title//': a row has no '//trim(self%columns(at)%key)
   end function fault_of_row

   !> The row of CELLS in the listing. A value too wide for its column is printed with an exponent and fewer digits, after a blank.
   function listed(self, cells) result(row)
      class(table_type), intent(in) :: self
      type(cell_type), intent(in)   :: cells(:)
      character(page_width) :: row
      character(integer_width) :: digits
      integer :: i, length

      row = ''
      do i = 1, size(cells)
         associate (column => self%columns(i), cell => cells(i))
            if (.not. column%is_listed .and. cell%kind /= across) cycle
            select case (cell%kind)
            case (whole)
               call write_integer(cell%number, digits, length)
               if (length > column%width) then
                  call place(row, fitted_text(real(cell%number, wp), column%width - 1), column%last)
               else
                  call place(row, digits(:length), column%last)
               end if
            case (real_number)
               if (column%is_short) then
                  call write_short(cell%shown, row(column%last - short_width + 1:column%last))
               else
                  call place(row, in_form(cell%shown, column%form, column%width), column%last)
               end if
            case (in_words)
               if (column%width == 0) row(column%last + 1:) = cell%words
               if (column%width > 0) call place(row, cell%words, column%last)
            case (across)
               row = cell%words
            end select
         end associate
      end do
   end function listed

   !> Put the row into the CSV FILE.
   subroutine put_csv(self, file)
      class(table_type), intent(inout)      :: self
      type(output_file_type), intent(inout) :: file
      integer :: i

      self%line%length = 0
      do i = 1, size(self%cells)
         if (self%columns(i)%name == '') cycle
         associate (cell => self%cells(i))
            select case (cell%kind)
            case (whole)
               call self%line%add([cell%number])
            case (real_number)
               call self%line%add([cell%value])
            case (in_words)
               call self%line%add(trim(adjustl(cell%words)))
            case default
               call self%line%add('')
            end select
         end associate
      end do
      call file%put(self%line%text(:self%line%length))
   end subroutine put_csv

   !> Error: the row lacks a cell.
   subroutine require_all(self)
      class(table_type), intent(in) :: self
      character(:), allocatable :: fault

      if (all(self%cells%kind /= missing)) return
      fault = self%fault_of_row()
      error stop fault
   end subroutine require_all

   !> Print the row into FILE, and into the CSV file if open; the next row begins.
   subroutine print_row(self, file, csv_file, is_listed)
      class(table_type), intent(inout)         :: self
      type(output_file_type), intent(inout), optional :: file, csv_file
      logical, intent(in), optional :: is_listed !! not only in the CSV file; default: yes
      logical :: lists

      call require_all(self)
      if (present(csv_file)) then
         if (csv_file%is_open) call put_csv(self, csv_file)
      end if
      lists = present(file)
      if (present(is_listed)) lists = lists .and. is_listed
      if (lists) call file%put(listed(self, self%cells))
      call begin_row(self)
   end subroutine print_row

   !> Keep the row until the table is printed; the next row begins.
   subroutine keep_row(self)
      class(table_type), intent(inout) :: self

      call require_all(self)
      call make_room(self)
      call move_alloc(self%cells, self%kept(self%n_kept)%cells)
      call begin_row(self)
   end subroutine keep_row

   !> Keep a LINE across all columns.
   subroutine keep_line(self, line)
      class(table_type), intent(inout) :: self
      character(*), intent(in)         :: line

      call make_room(self)
      allocate (self%kept(self%n_kept)%cells(1))
      self%kept(self%n_kept)%cells(1)%kind = across
      call set_words(line, self%kept(self%n_kept)%cells(1))
   end subroutine keep_line

   !> Make room for one more row.
   subroutine make_room(self)
      class(table_type), intent(inout) :: self
      integer, parameter :: first_rows = 32
      type(row_type), allocatable :: longer(:)
      integer :: i

      if (.not. allocated(self%kept)) allocate (self%kept(0))
      if (self%n_kept == size(self%kept)) then
         allocate (longer(max(first_rows, 2*self%n_kept)))
         do i = 1, self%n_kept
            call move_alloc(self%kept(i)%cells, longer(i)%cells)
         end do
         call move_alloc(longer, self%kept)
      end if
      self%n_kept = self%n_kept + 1
      if (allocated(self%kept(self%n_kept)%cells)) deallocate (self%kept(self%n_kept)%cells)
   end subroutine make_room

   !> Print the kept rows under title and headings. The table ends: it has neither rows nor columns behind this.
   subroutine print_kept(self, file)
      class(table_type), intent(inout)      :: self
      type(output_file_type), intent(inout) :: file
      integer :: i

      if (self%n_kept > 0) call self%print_head(file)
      do i = 1, self%n_kept
         call file%put(listed(self, self%kept(i)%cells))
      end do
      self%n_kept = 0
      if (allocated(self%columns)) deallocate (self%columns)
   end subroutine print_kept

   !> Write the values of the kept rows to a restart file, or read them; title and columns come with the next row.
   subroutine record(self, stream)
      class(table_type), intent(inout)         :: self
      type(restart_stream_type), intent(inout) :: stream

      call stream%part('table_type', 1)
      call record_rows(stream, self%n_kept, self%kept)
      if (stream%writes) return
      if (allocated(self%columns)) deallocate (self%columns)
      if (allocated(self%cells)) deallocate (self%cells)
   end subroutine record

end module table_writer
