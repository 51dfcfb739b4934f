!> The data file of jointfit: test points, or published cubics, as plain text.
module fit_data
   use deck_errors, only: deck_error_list
   use deck_numbers, only: parse_real
   use deck_text, only: deck_text_type, read_deck_text
   use kinds, only: wp
   use text_tools, only: integer_text, upper
   implicit none
   private

   public :: read_test_data, branch_number, read_number, split_entries, without_comment

   !> The branches of the shear law.
   integer, parameter, public :: fit_load = 1, fit_unload = 2, fit_reload = 3
   character(6), parameter, public :: branch_words(3) = [character(6) :: 'LOAD', 'UNLOAD', 'RELOAD']
   character(1), parameter, public :: branch_letters(3) = ['a', 'b', 'c'] !! of the coefficients, as in Eqs. (3b), (5), (6)

   !> Columns that a file may have, and the kinds of file that they make.
   integer, parameter, public :: column_d = 1, column_tau = 2, column_p = 3, column_lambda = 4, column_c(3) = [5, 6, 7]
   integer, parameter         :: column_branch = 8, n_columns = 8
   character(6), parameter    :: column_names(n_columns) = [character(6) :: 'D', 'TAU', 'P', 'LAMBDA', 'C1', 'C2', 'C3', &
                                                            'BRANCH']
   integer, parameter, public :: data_shear = 1, data_normal = 2, data_cubics = 3
   integer, parameter         :: columns_of_kind(3) = [sum(2**[column_d, column_tau, column_p, column_branch]), &
                                                       sum(2**[column_lambda, column_p]), &
                                                       sum(2**[column_c, column_p, column_branch])]
   character(*), parameter    :: known_headers = 'expected a line with the names of the columns: '// &
                                 '''d tau p branch'', ''lambda p'' or ''c1 c2 c3 p branch'''
   character(*), parameter    :: blanks = ' '//achar(9)

   !> Where an entry stands in its line; an entry left out between two commas has LAST < FIRST.
   type, public :: entry_type
      integer :: first = 0, last = 0
   end type entry_type

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

   !> The number of the branch called WORD (in capitals), 0 for any other word.
   pure integer function branch_number(word) result(branch)
      character(*), intent(in) :: word

      branch = findloc(branch_words == word, .true., 1)
   end function branch_number


   !> Read the file PATH, which messages call NAME. READABLE is false where it cannot be read; what is wrong in it
   !! goes to ERRORS, all of it.
   subroutine read_test_data(path, name, data, errors, readable)
      character(*), intent(in)           :: path, name
      type(test_data_type), intent(out)  :: data
      type(deck_error_list), intent(out) :: errors
      logical, intent(out)               :: readable
      type(entry_type), allocatable :: entries(:)
      integer, allocatable      :: columns(:) ! of the entries of a row; not yet: no header, of size 0: a wrong one
      character(:), allocatable :: line
      integer :: i

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
      do i = 1, data%text%n
         line = without_comment(data%text%line(i))
         call split_entries(line, entries)
         if (size(entries) == 0) cycle
         if (index(upper(adjustl(line)), 'UNITS') == 1 .and. index(line, '=') > 0) then
            call read_units(line, i, data, errors)
         else if (is_header(line, entries)) then
            call read_header(line, i, entries, data, columns, errors)
         else if (.not. allocated(columns)) then
            call errors%add(i, 'numbers before the header line: '//known_headers)
            return
         else if (size(columns) > 0) then
            call read_row(line, i, entries, columns, data, errors)
         end if
      end do
      if (.not. allocated(columns)) then
         call errors%add(0, 'no header line: '//known_headers)
      else if (data%n == 0 .and. .not. errors%any()) then
         call errors%add(0, 'no test data below the header line')
      end if
   end subroutine read_test_data


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

      is_header = .not. any([(scan(line(entries(k)%first:entries(k)%last), '0123456789+-.') == 1, k = 1, size(entries))])
   end function is_header


   !> Which column each entry of a row belongs to, and the kind of the file. A file may hold several headers, each for
   !! the rows below it, of one kind.
   subroutine read_header(line, at, entries, data, columns, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(entry_type), intent(in)         :: entries(:)
      type(test_data_type), intent(inout)  :: data
      integer, allocatable, intent(inout)  :: columns(:) !! (entries); empty: the header is wrong
      type(deck_error_list), intent(inout) :: errors
      integer :: errors_before, k, kind

      errors_before = errors%n
      columns = [(0, k = 1, size(entries))]
      do k = 1, size(entries)
         associate (first => entries(k)%first, last => entries(k)%last)
            columns(k) = findloc(column_names == upper(line(first:last)), .true., 1)
            if (columns(k) == 0) then
               call errors%add(at, ''''//line(first:last)//''' is no column that jointfit knows; '//known_headers, first, last)
            else if (any(columns(:k - 1) == columns(k))) then
               call errors%add(at, 'column '''//line(first:last)//''' a second time', first, last)
            end if
         end associate
      end do
      if (errors%n == errors_before) then
         kind = findloc(columns_of_kind, sum(2**columns), 1)
         if (kind == 0) then
            call errors%add(at, 'these columns do not go together; '//known_headers)
         else if (data%kind /= 0 .and. kind /= data%kind) then
            call errors%add(at, 'a header of another kind than the one above: expected one kind of data in a file')
         else
            data%kind = kind
         end if
      end if
      if (errors%n > errors_before) columns = [integer ::]
   end subroutine read_header


   !> One row of data.
   subroutine read_row(line, at, entries, columns, data, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(entry_type), intent(in)         :: entries(:)
      integer, intent(in)                  :: columns(:)
      type(test_data_type), intent(inout)  :: data
      type(deck_error_list), intent(inout) :: errors
      integer :: k

      if (size(entries) /= size(columns)) then
         k = min(size(entries), size(columns) + 1)
         call errors%add(at, 'entries on this line: '//integer_text(size(entries))//', expected '// &
                         integer_text(size(columns))//', one a column', entries(k)%first, entries(size(entries))%last)
         return
      end if
      data%n = data%n + 1
      data%line(data%n) = at
      do k = 1, size(columns)
         associate (first => entries(k)%first, last => entries(k)%last)
            call read_entry(line(first:last), at, first, columns(k), data, errors)
         end associate
      end do
      if (data%kind == data_shear .and. data%branch(data%n) == fit_load .and. data%value(column_d, data%n) < 0.0_wp) then
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
      character(:), allocatable :: fault
      logical :: ok

      fault = ''
      associate (value => data%value(column, data%n), branch => data%branch(data%n))
         if (word == '') then
            fault = 'nothing between two commas, expected an entry'
         else if (column == column_branch) then
            branch = branch_number(upper(word))
            if (branch == 0) fault = ''''//word//''', expected LOAD, UNLOAD or RELOAD'
         else
            call read_number(word, value, ok)
            if (.not. ok) then
               fault = ''''//word//''' is not a number'
            else if (value < 0.0_wp .and. column == column_p) then
               fault = ''''//word//''' is negative, expected 0 or more (compression is positive)'
            else if (abs(value) > 1.0e30_wp) then
               fault = ''''//word//''' is beyond 1E30'
            end if
         end if
      end associate
      if (fault /= '') call errors%add(at, trim(column_names(column))//': '//fault, first, max(first, first + len(word) - 1))
   end subroutine read_entry


   !> A number of the data or the command, which may do without the decimal point that cards need.
   subroutine read_number(text, value, ok)
      character(*), intent(in) :: text
      real(wp), intent(out)    :: value
      logical, intent(out)     :: ok

      call parse_real(text, value, ok)
      if (.not. ok) call parse_real(text//'.', value, ok)
   end subroutine read_number


   !> LINE up to its comment, which # or $ begins, without blanks and tabs at its end.
   pure function without_comment(line) result(words)
      character(*), intent(in)  :: line
      character(:), allocatable :: words
      integer :: length

      length = scan(line//'#', '#$') - 1
      words = line(:verify(line(:length), blanks, back=.true.))
   end function without_comment


   !> Cut LINE at blanks, tabs and commas. Blanks around a comma go with it; nothing between two commas, or before the
   !! first or behind the last, is an entry left out.
   pure subroutine split_entries(line, entries)
      character(*), intent(in)                   :: line
      type(entry_type), allocatable, intent(out) :: entries(:)
      integer :: at, last
      logical :: comma  ! one has been read and waits for the entry behind it

      allocate (entries(0))
      comma = .false.
      at = next(1)
      do while (at <= len(line))
         last = at + scan(line(at:)//' ', blanks//',') - 2
         entries = [entries, entry_type(at, last)]
         at = next(last + 1)
         if (at > len(line)) return
         comma = line(at:at) == ','
         if (comma) at = next(at + 1)
      end do
      if (comma) entries = [entries, entry_type(len(line) + 1, len(line))]

   contains

      !> The next place from FROM on that is not blank.
      pure integer function next(from)
         integer, intent(in) :: from

         next = from + verify(line(from:)//',', blanks) - 1
      end function next

   end subroutine split_entries

end module fit_data
