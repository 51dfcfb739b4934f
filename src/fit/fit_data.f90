!> The data file of jointfit: test points, or published cubics, as plain text.
module fit_data
   use data_entries, only: entry_type, split_entries, without_comment
   use deck_errors, only: deck_error_list
   use deck_numbers, only: parse_real
   use deck_text, only: deck_text_type, read_deck_text
   use fit_branches, only: branch_number, branch_words, fit_load
   use kinds, only: wp
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: read_test_data

   integer, parameter, public :: data_shear = 1, data_normal = 2, data_cubics = 3 !! kinds of file

   !> Columns that a file may have.
   integer, parameter, public :: column_d = 1, column_tau = 2, column_p = 3, column_lambda = 4, column_c(3) = [5, 6, 7]
   integer, parameter         :: column_branch = 8, n_columns = 8
   character(6), parameter    :: column_names(n_columns) = [character(6) :: 'D', 'TAU', 'P', 'LAMBDA', 'C1', 'C2', 'C3', &
                                                            'BRANCH']
   character(*), parameter    :: known_headers = 'expected a line with the names of the columns: '// &
                                 '''d tau p branch'', ''lambda p'' or ''c1 c2 c3 p branch'''

   type, public :: test_data_type
      integer :: kind = 0                        !! data_shear, data_normal or data_cubics
      integer :: n    = 0                        !! rows
      real(wp), allocatable :: value(:, :)       !! (column, row)
      integer, allocatable  :: branch(:)         !! (row)
      integer, allocatable  :: line(:)           !! (row) in TEXT
      character(:), allocatable :: units         !! what stands behind UNITS =, empty: no such line
      type(deck_text_type)  :: text
   end type test_data_type

contains

   !> Read the file PATH, which messages call NAME. READABLE is false where it cannot be read; what is wrong in it
   !! goes to ERRORS, all of it.
   subroutine read_test_data(path, name, data, errors, readable)
      character(*), intent(in)           :: path, name
      type(test_data_type), intent(out)  :: data
      type(deck_error_list), intent(out) :: errors
      logical, intent(out)               :: readable
      type(entry_type), allocatable :: entries(:)
      integer, allocatable      :: columns(:)
      character(:), allocatable :: line
      integer :: i
      logical :: header_seen, header_ok

      call read_deck_text(path, data%text, errors, readable)
      if (.not. readable) return
      data%text%files(1)%path = name
      data%units = ''
      if (.not. data%text%is_text) then
         errors%items(errors%n)%message = 'the file is empty, or no text: expected test data as plain text'
         return
      end if
      allocate (data%value(n_columns, data%text%n), source=0.0_wp)
      allocate (data%branch(data%text%n), data%line(data%text%n), source=0)
      allocate (columns(0))
      header_seen = .false.
      header_ok = .false.
      do i = 1, data%text%n
         line = without_comment(data%text%line(i))
         call split_entries(line, entries)
         if (size(entries) == 0) cycle
         if (is_units(line)) then
            call read_units(line, i, data, errors)
         else if (is_header(line, entries)) then
            call read_header(line, i, entries, data, columns, header_ok, errors)
            header_seen = .true.
         else if (.not. header_seen) then
            call errors%add(i, 'numbers before the header line: '//known_headers)
            return
         else if (header_ok) then
            call read_row(line, i, entries, columns, data, errors)
         end if
      end do
      if (.not. header_seen) then
         call errors%add(0, 'no header line: '//known_headers)
      else if (data%n == 0 .and. .not. errors%any()) then
         call errors%add(0, 'no test data below the header line')
      end if
   end subroutine read_test_data


   pure logical function is_units(line)
      character(*), intent(in) :: line
      character(:), allocatable :: words

      words = adjustl(line)
      is_units = index(upper(words), 'UNITS') == 1 .and. index(words, '=') > 0
   end function is_units


   !> UNITS = anything: for the comments of the cards. A second one must say the same.
   subroutine read_units(line, at, data, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(test_data_type), intent(inout)  :: data
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: units

      units = trim(adjustl(line(index(line, '=') + 1:)))
      if (data%units /= '' .and. units /= data%units) then
         call errors%add(at, 'UNITS: '''//units//''', but above it was '''//data%units//'''')
      end if
      data%units = units
   end subroutine read_units


   !> A header line has no entry that begins like a number; every row has one.
   pure logical function is_header(line, entries)
      character(*), intent(in)     :: line
      type(entry_type), intent(in) :: entries(:)
      integer :: k

      is_header = .true.
      do k = 1, size(entries)
         if (scan(line(entries(k)%first:entries(k)%last), '0123456789+-.') == 1) is_header = .false.
      end do
   end function is_header


   pure integer function column_number(word) result(column)
      character(*), intent(in) :: word

      do column = n_columns, 1, -1
         if (upper(word) == column_names(column)) return
      end do
   end function column_number


   !> Which column each entry of a row belongs to, and the kind of the file. A file may hold several headers, each for
   !! the rows below it, of one kind.
   subroutine read_header(line, at, entries, data, columns, ok, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(entry_type), intent(in)         :: entries(:)
      type(test_data_type), intent(inout)  :: data
      integer, allocatable, intent(out)    :: columns(:) !! (entries)
      logical, intent(out)                 :: ok
      type(deck_error_list), intent(inout) :: errors
      integer :: errors_before, k, kind

      errors_before = errors%n
      allocate (columns(size(entries)))
      do k = 1, size(entries)
         associate (first => entries(k)%first, last => entries(k)%last)
            columns(k) = column_number(line(first:last))
            if (columns(k) == 0) then
               call errors%add(at, ''''//line(first:last)//''' is no column that jointfit knows; '//known_headers, first, last)
            else if (any(columns(:k - 1) == columns(k))) then
               call errors%add(at, 'column '''//line(first:last)//''' a second time', first, last)
            end if
         end associate
      end do
      ok = errors%n == errors_before
      if (.not. ok) return
      kind = kind_of(columns)
      ok = kind > 0 .and. (data%kind == 0 .or. kind == data%kind)
      if (kind == 0) then
         call errors%add(at, 'these columns do not go together; '//known_headers)
      else if (.not. ok) then
         call errors%add(at, 'a header of another kind than the one above: expected one kind of data in a file')
      else
         data%kind = kind
      end if
   end subroutine read_header


   !> The kind of a file with these COLUMNS, 0 for none.
   pure integer function kind_of(columns) result(kind)
      integer, intent(in) :: columns(:)

      kind = 0
      if (same([column_d, column_tau, column_p, column_branch])) kind = data_shear
      if (same([column_lambda, column_p])) kind = data_normal
      if (same([column_c, column_p, column_branch])) kind = data_cubics

   contains

      pure logical function same(wanted)
         integer, intent(in) :: wanted(:)
         integer :: k

         same = size(wanted) == size(columns) .and. all([(any(columns == wanted(k)), k = 1, size(wanted))])
      end function same

   end function kind_of


   !> One row of data.
   subroutine read_row(line, at, entries, columns, data, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(entry_type), intent(in)         :: entries(:)
      integer, intent(in)                  :: columns(:)
      type(test_data_type), intent(inout)  :: data
      type(deck_error_list), intent(inout) :: errors
      integer :: k, row

      if (size(entries) /= size(columns)) then
         k = min(size(entries), size(columns) + 1)
         call errors%add(at, 'entries on this line: '//integer_text(size(entries))//', expected '// &
                         integer_text(size(columns))//', one a column', entries(k)%first, entries(size(entries))%last)
         return
      end if
      row = data%n + 1
      data%n = row
      data%line(row) = at
      do k = 1, size(columns)
         associate (first => entries(k)%first, last => entries(k)%last)
            call read_entry(line(first:last), at, first, columns(k), data, errors)
         end associate
      end do
      if (data%kind == data_shear .and. data%branch(row) == fit_load .and. data%value(column_d, row) < 0.0_wp) then
         k = findloc(columns, column_d, 1)
         call errors%add(at, 'd of the LOAD branch is negative: expected d and tau counted in the sense of loading', &
                         entries(k)%first, entries(k)%last)
      end if
   end subroutine read_row


   !> The entry WORD in its COLUMN of the last row.
   subroutine read_entry(word, at, first, column, data, errors)
      character(*), intent(in)             :: word
      integer, intent(in)                  :: at, first, column
      type(test_data_type), intent(inout)  :: data
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: name
      integer :: last
      logical :: ok

      last = max(first, first + len(word) - 1)
      name = trim(column_names(column))
      associate (value => data%value(column, data%n))
         if (word == '') then
            call errors%add(at, name//': nothing between two commas, expected an entry', first, last)
         else if (column == column_branch) then
            data%branch(data%n) = branch_number(upper(word))
            if (data%branch(data%n) == 0) then
               call errors%add(at, name//': '''//word//''', expected '//trim(branch_words(1))//', '// &
                               trim(branch_words(2))//' or '//trim(branch_words(3)), first, last)
            end if
         else
            call parse_real(word, value, ok)
            if (.not. ok) call parse_real(word//'.', value, ok) ! data may do without the point
            if (.not. ok) then
               call errors%add(at, name//': '''//word//''' is not a number', first, last)
            else if (value < 0.0_wp .and. column == column_p) then
               call errors%add(at, name//': '''//word//''' is negative, expected 0 or more (compression is positive)', &
                               first, last)
            else if (abs(value) > 1.0e30_wp) then
               call errors%add(at, name//': '''//word//''' is beyond 1E30', first, last)
            end if
         end if
      end associate
   end subroutine read_entry

end module fit_data
