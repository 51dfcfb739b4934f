!> The tables of the results, for the listing, the screen and CSV files. A table is a list of columns. A column has a heading,
!! the edit descriptor of its values, a unit, and a name in the CSV file. The lines of headings and units, the titles of the CSV
!! file and every row of both follow from it:
!!
!!    call table%start('REACTIONS', [csv('stage'), column('NODE', 'i11', name='node'), &
!!                                   column('R'//axes, 'es13.5', labels%force)], file)
!!    call table%add([stage, node], reaction)
!!    call table%print_row(file, csv_file)
!!
!! The values of a row are added from left to right. Values of a column without a heading are written only to the CSV file,
!! those of a column without a name only to the listing. The tables of a whole stage keep their rows until they are printed.
module table_writer
   use kinds, only: wp
   use output_file, only: output_file_type
   use restart_stream, only: restart_stream_type
   use text_tools, only: clean, csv_line_type, fitted_text, integer_width, short_width, write_integer, write_short
   implicit none
   private

   public :: column, csv, csv_titles, heading, put_lines, cut, in_form, in_units

   integer, parameter, public      :: page_width = 132
   real(wp), parameter, public     :: noise = 1.0e-9_wp !! of the largest number of its kind: smaller values are rounding
   character(1), parameter, public :: axes(3) = ['X', 'Y', 'Z']

   type, public :: column_type
      private
      character(48) :: heading = ''
      character(16) :: name = ''      ! in the CSV file
      character(12) :: form = ''      ! length without padding: columns are copied to restart files
      character(20) :: unit = ''
      integer :: width = 0            ! 0: text to the end of the row
      integer :: last = 0             ! last character of its values in the row
      integer :: heading_shift = 0, unit_shift = 0
      logical :: is_listed = .true.
      logical :: is_short = .false.   ! written by the fast write_short
   end type column_type

   type, public :: table_type
      private
      character(:), allocatable :: title
      character(page_width) :: row = ''
      type(csv_line_type) :: line     ! the same row for the CSV file
      type(column_type), allocatable :: columns(:)
      integer :: used = 0             ! columns of the row
      integer :: n_kept = 0           ! characters of
      character(:), allocatable :: kept ! rows, each with its end
   contains
      procedure :: is_empty
      procedure :: start
      procedure :: print_head
      generic   :: add => add_integers, add_reals, add_text
      procedure :: skip
      procedure :: print_row
      procedure :: keep_row
      procedure :: keep_line
      procedure :: print_kept
      procedure :: record
      procedure, private :: add_integers, add_reals, add_text
   end type table_type

contains

   !> A column. FORM is the edit descriptor of its values: i11, es13.5, f9.4, a8; 'a' is text to the end of the row. Heading and
   !! unit end where the values end, or the given number of characters behind.
   elemental function column(heading, form, unit, heading_shift, unit_shift, name, is_listed) result(item)
      character(*), intent(in)           :: heading, form
      character(*), intent(in), optional :: unit, name    !! default: none
      integer, intent(in), optional      :: heading_shift, unit_shift
      logical, intent(in), optional      :: is_listed     !! default: yes
      type(column_type) :: item
      integer :: point

      if (present(name)) item%name = name
      if (present(is_listed)) item%is_listed = is_listed
      if (.not. item%is_listed) return
      item%heading = heading
      item%form = '('//form//')'
      if (present(unit)) item%unit = unit
      if (present(heading_shift)) item%heading_shift = heading_shift
      if (present(unit_shift)) item%unit_shift = unit_shift
      point = index(form//'.', '.')
      if (form /= 'a') read (form(scan(form, '0123456789'):point - 1), *) item%width
      item%is_short = index(form, 'es') == 1 .and. form(point:) == '.5' .and. item%width >= short_width
   end function column

   !> A column of the CSV file only.
   elemental function csv(name) result(item)
      character(*), intent(in) :: name
      type(column_type) :: item

      item = column('', '', name=name, is_listed=.false.)
   end function csv

   !> The first line of the CSV file of a table with these COLUMNS.
   pure function csv_titles(columns) result(titles)
      type(column_type), intent(in) :: columns(:)
      character(:), allocatable     :: titles
      integer :: i

      titles = ''
      do i = 1, size(columns)
         if (columns(i)%name /= '') titles = titles//','//trim(columns(i)%name)
      end do
      titles = titles(2:)
   end function csv_titles

   !> Whether no rows are kept: a table of a stage begins.
   pure logical function is_empty(self)
      class(table_type), intent(in)         :: self

      is_empty = self%n_kept == 0
   end function is_empty

   !> Begin a table of these COLUMNS, without rows; write its head into FILE if present. TITLE is empty where other words
   !! precede the headings.
   subroutine start(self, title, columns, file)
      class(table_type), intent(inout)         :: self
      character(*), intent(in)                 :: title
      type(column_type), intent(in)            :: columns(:)
      type(output_file_type), intent(inout), optional :: file
      integer :: i

      self%title = title
      self%columns = columns
      do i = 1, size(columns)
         self%columns(i)%last = sum(columns(:i)%width)
      end do
      self%used = 0
      self%n_kept = 0
      if (present(file)) call self%print_head(file)
   end subroutine start

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

   !> The next values of the row, where WHERE is true, followed by REALS. A value too wide for its column is printed with an
   !! exponent and fewer digits, after a blank.
   subroutine add_integers(self, values, reals, where)
      class(table_type), intent(inout)         :: self
      integer, intent(in)                      :: values(:)
      real(wp), intent(in), optional           :: reals(:)
      logical, intent(in), optional            :: where(:) !! (values) default: all
      character(integer_width) :: digits
      logical :: is_there
      integer :: i, length

      is_there = .true.
      do i = 1, size(values)
         self%used = self%used + 1
         if (present(where)) is_there = where(i)
         associate (column => self%columns(self%used))
            if (column%name /= '') call self%line%add([values(i)], where=[is_there])
            if (.not. (column%is_listed .and. is_there)) cycle
            call write_integer(values(i), digits, length)
            if (length > column%width) then
               call place(self%row, fitted_text(real(values(i), wp), column%width - 1), column%last)
            else
               call place(self%row, digits(:length), column%last)
            end if
         end associate
      end do
      if (present(reals)) call self%add_reals(reals)
   end subroutine add_integers

   !> Values below FLOOR are zero in the listing.
   subroutine add_reals(self, values, floor, where)
      class(table_type), intent(inout)         :: self
      real(wp), intent(in)                     :: values(:)
      real(wp), intent(in), optional           :: floor
      logical, intent(in), optional            :: where(:)
      logical :: is_there
      integer :: i

      is_there = .true.
      do i = 1, size(values)
         self%used = self%used + 1
         if (present(where)) is_there = where(i)
         associate (column => self%columns(self%used), value => clean(values(i), floor))
            if (column%name /= '') call self%line%add([clean(values(i))], where=[is_there])
            if (.not. (column%is_listed .and. is_there)) cycle
            if (column%is_short) then
               call write_short(value, self%row(column%last - short_width + 1:column%last))
            else
               call place(self%row, in_form(value, column%form, column%width), column%last)
            end if
         end associate
      end do
   end subroutine add_reals

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

   !> WORDS with all their blanks, at the end of their column, followed by REALS; the CSV file has WORDS without the blanks.
   subroutine add_text(self, words, reals)
      class(table_type), intent(inout)         :: self
      character(*), intent(in)                 :: words
      real(wp), intent(in), optional           :: reals(:)

      self%used = self%used + 1
      associate (column => self%columns(self%used))
         if (column%name /= '') call self%line%add(trim(adjustl(words)))
         if (column%is_listed .and. column%width == 0) self%row(column%last + 1:) = words
         if (column%is_listed .and. column%width > 0) call place(self%row, words, column%last)
      end associate
      if (present(reals)) call self%add_reals(reals)
   end subroutine add_text

   !> Leave the next N columns empty.
   subroutine skip(self, n)
      class(table_type), intent(inout)         :: self
      integer, intent(in)                      :: n
      integer :: i

      do i = self%used + 1, self%used + n
         if (self%columns(i)%name /= '') call self%line%add('')
      end do
      self%used = self%used + n
   end subroutine skip

   !> Complete the row, with empty fields for the remaining columns, and print it into FILE, and into the CSV file if open.
   subroutine print_row(self, file, csv_file, is_listed)
      class(table_type), intent(inout)         :: self
      type(output_file_type), intent(inout), optional :: file, csv_file
      logical, intent(in), optional :: is_listed !! not only in the CSV file; default: yes
      logical :: lists

      if (present(csv_file)) then
         call self%skip(size(self%columns) - self%used)
         if (csv_file%is_open) call csv_file%put(self%line%text(:self%line%length))
      end if
      lists = present(file)
      if (present(is_listed)) lists = lists .and. is_listed
      if (lists) call file%put(self%row)
      self%row = ''
      self%line%length = 0
      self%used = 0
   end subroutine print_row

   !> Complete the row and keep it until the table is printed.
   subroutine keep_row(self)
      class(table_type), intent(inout)         :: self

      call self%keep_line(self%row)
      call self%print_row() ! into no file: only the next row begins
   end subroutine keep_row

   !> Keep a LINE across all columns.
   pure subroutine keep_line(self, line)
      class(table_type), intent(inout)         :: self
      character(*), intent(in)                 :: line
      integer, parameter :: room = 8192 ! characters at first
      character(:), allocatable :: longer
      integer :: length

      length = len_trim(line(:min(len(line), page_width)))
      if (.not. allocated(self%kept)) allocate (character(room) :: self%kept)
      if (self%n_kept + length + 1 > len(self%kept)) then
         allocate (character(2*len(self%kept) + length + 1) :: longer)
         longer(:self%n_kept) = self%kept(:self%n_kept)
         call move_alloc(longer, self%kept)
      end if
      self%kept(self%n_kept + 1:self%n_kept + length + 1) = line(:length)//new_line('a')
      self%n_kept = self%n_kept + length + 1
   end subroutine keep_line

   !> Print the kept rows, and clear them; under title and headings, if any, or AS_ROWS behind earlier rows.
   subroutine print_kept(self, file, as_rows)
      class(table_type), intent(inout)         :: self
      type(output_file_type), intent(inout)    :: file
      logical, intent(in), optional            :: as_rows !! default: no
      logical :: has_head

      if (self%n_kept == 0) return
      has_head = .true.
      if (present(as_rows)) has_head = .not. as_rows
      if (has_head .and. allocated(self%columns)) call self%print_head(file)
      if (.not. allocated(self%columns)) call file%put('')
      call file%put_lines(self%kept(:self%n_kept))
      self%n_kept = 0
   end subroutine print_kept

   !> Write the state of the table between two rows to a restart file, or read it.
   subroutine record(self, stream)
      class(table_type), intent(inout)         :: self
      type(restart_stream_type), intent(inout) :: stream
      character(:), allocatable :: kept
      integer :: n

      call stream%any_text(self%title)
      n = -1
      if (allocated(self%columns)) n = size(self%columns)
      call stream%extent(n, 100)
      if (.not. stream%writes .and. allocated(self%columns)) deallocate (self%columns)
      if (.not. stream%writes .and. n >= 0) allocate (self%columns(n))
      if (n >= 0) call stream%item(self%columns)
      if (stream%writes .and. self%n_kept > 0) kept = self%kept(:self%n_kept)
      call stream%any_text(kept)
      self%n_kept = 0
      if (allocated(kept)) self%n_kept = len(kept)
      if (allocated(kept)) call move_alloc(kept, self%kept)
   end subroutine record

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

end module table_writer
