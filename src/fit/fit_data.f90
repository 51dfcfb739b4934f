!> Reads a data file of jointfit: test points or published cubics as plain text.
module fit_data
   use data_columns, only: branch_words, column_branch, column_d, column_lambda, column_names, column_p, column_run, &
                           column_tau, data_cubics, data_part, data_shear, entry_type, has_force, header_type, is_number, &
                           known_headers, n_columns, of_length, of_stress, read_header, read_number, read_system, &
                           reading_type, set_factors, split_entries, unit_system, unit_value
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type, read_deck_text
   use kinds, only: wp
   use text_tools, only: integer_text, real_text, upper
   use tolerances, only: whole_number
   implicit none
   private

   public :: read_test_data

   type, public :: test_data_type
      integer :: kind = 0                        !! data_shear, data_normal, data_cubics, data_stiffness or data_loss
      integer :: n    = 0                        !! rows
      logical :: has_branch = .false.            !! the rows name their branches
      logical :: has_run = .false.               !! the rows have run numbers
      logical :: in_order = .false.              !! the rows of a test are in the order of time
      logical :: is_record = .false.             !! and the branches are known from the order only
      real(wp), allocatable :: value(:, :)       !! (column, row) in the units of the cards
      integer, allocatable  :: branch(:)         !! (row)
      integer, allocatable  :: run(:)            !! (row) run of the row, 0: shared with all such rows of its branch and pressure
      logical, allocatable  :: joined(:)         !! (row) of a record: the test came to it from the row before
      integer, allocatable  :: part(:)           !! (row) number of its header
      integer, allocatable  :: line(:)           !! (row) in TEXT
      integer, allocatable  :: place(:, :, :)    !! (2, column, row) first and last place in the line
      integer  :: columns(2) = 0                 !! of the readings: d and tau, or lambda and p
      real(wp) :: range(2) = 1.0_wp              !! from the smallest reading to the largest one, in each of these columns
      real(wp) :: scatter = 0.0_wp               !! largest random deviation of a reading, as a share of RANGE
      real(wp) :: band = 0.0_wp                  !! noise: a smaller difference of two readings does not count, as a share of RANGE
      character(16) :: unit(n_columns) = ''      !! of the values, empty: unknown
      character(16) :: unit_read(n_columns) = '' !! of the file
      character(:), allocatable :: units         !! text after UNITS =, empty: no such line
      type(deck_error_list) :: warnings, notes   !! about the data
      type(deck_text_type)  :: text
   end type test_data_type

contains

   !> Read the file PATH, which messages call NAME. READABLE is false where the file cannot be read. All errors in it go to ERRORS.
   subroutine read_test_data(path, name, reading, data, errors, readable)
      character(*), intent(in)           :: path, name
      type(reading_type), intent(in)     :: reading
      type(test_data_type), intent(out)  :: data
      type(deck_error_list), intent(out) :: errors
      logical, intent(out)               :: readable
      type(entry_type), allocatable :: entries(:)
      type(header_type) :: header
      type(unit_system) :: system                ! of the line UNITS =
      character(:), allocatable :: line
      integer :: i, k, rows
      logical :: ok, above                       ! the line above is a header

      call read_deck_text(path, data%text, errors, readable, has_fields=.false.)
      if (.not. readable) return
      data%text%files(1)%path = name
      data%units = ''
      if (.not. data%text%is_text) then
         errors%items(errors%n)%message = 'the file is empty or not text: expected test data as plain text'
         return
      end if
      rows = data%text%n
      allocate (data%value(n_columns, rows), source=0.0_wp)
      allocate (data%branch(rows), data%run(rows), data%part(rows), data%line(rows), data%place(2, n_columns, rows), source=0)
      allocate (data%joined(rows), source=.false.)
      above = reading%columns /= ''
      do i = 1, rows
         line = data_part(data%text%line(i))
         call split_entries(line, entries, header%decimal_comma .or. reading%decimal_comma)
         if (size(entries) == 0) cycle
         if (index(upper(adjustl(line)), 'UNITS') == 1 .and. index(line, '=') > 0) then
            line = trim(adjustl(line(index(line, '=') + 1:))) ! any text for the comments of the cards; for --units a SYSTEM
            if (data%units /= '' .and. line /= data%units) &
               call errors%add(i, 'UNITS: '''//line//''', but above it was '''//data%units//'''')
            data%units = line
            call read_system(line, system, ok)
         else if (.not. any([(is_number(line(entries(k)%first:entries(k)%last)), k = 1, size(entries))])) then
            if (reading%columns == '') call read_header(line, i, reading, header, errors)
            above = .true.
         else
            if (above .and. reading%columns /= '') call read_header(reading%columns, 0, reading, header, errors)
            if (header%part == 0) then
               call errors%add(i, 'numbers before the header line: '//known_headers)
               return
            end if
            if (above) call set_factors(reading, system, header, errors)
            above = .false.
            if (size(header%columns) > 0) call read_row(line, i, entries, header, data, errors)
         end if
      end do
      if (header%part == 0) then
         call errors%add(0, 'no header line: '//known_headers)
      else if (data%n == 0 .and. .not. errors%any()) then
         call errors%add(0, 'no test data below the header line')
      end if
      call complete_data(header, reading, data, errors)
   end subroutine read_test_data

   !> Complete DATA after the last HEADER: branches, runs and units. Without --units, warn of two units of stress in the headings,
   !! and of units without a consistent unit of force.
   subroutine complete_data(header, reading, data, errors)
      type(header_type), intent(in)        :: header
      type(reading_type), intent(in)       :: reading
      type(test_data_type), intent(inout)  :: data
      type(deck_error_list), intent(inout) :: errors
      character(16) :: length, stress(2)
      real(wp) :: values(2)
      integer  :: row

      data%has_branch = any(data%branch(:data%n) > 0)
      data%has_run = any(data%run(:data%n) > 0)
      row = findloc(data%branch(:data%n), 0, 1)
      if (data%has_branch .and. row > 0 .and. .not. errors%any()) &
         call errors%add(data%line(row), 'BRANCH: a number, but other rows name it: expected one or the other in all rows')
      data%unit_read = header%units
      data%unit = header%units
      if (header%of_force) data%unit(column_p) = ''
      if (header%of_force .and. header%units(column_p) /= '') data%unit_read(column_p) = trim(header%units(column_p))//' / area'
      if (header%of_force) call data%notes%add(0, 'p is the force f over the area '//real_text(reading%area)//' (--area)')
      if (reading%deck%length > 0.0_wp) then
         data%unit([column_d, column_lambda]) = upper(reading%deck%length_name)
         data%unit([column_p, column_tau]) = upper(reading%deck%stress_name)
         return
      end if
      length = header%units(merge(column_d, column_lambda, header%kind == data_shear))
      stress = header%units(merge([column_p, column_tau], column_p, header%kind == data_shear))
      values = [unit_value(trim(length), of_length), unit_value(trim(stress(1)), of_stress)]
      if (any(values <= 0.0_wp) .or. any(stress == '')) return
      if (stress(1) == stress(2) .and. has_force(values(1), values(2))) return
      if (stress(1) /= stress(2)) length = stress(2)
      call data%warnings%add(0, trim(length)//' and '//trim(stress(1))//' are not consistent units of a deck: --units mm,n '// &
                             'converts both')
   end subroutine complete_data

   !> Read one row of data.
   subroutine read_row(line, at, entries, header, data, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(entry_type), intent(in)         :: entries(:)
      type(header_type), intent(in)        :: header
      type(test_data_type), intent(inout)  :: data
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: fault
      integer :: column, k
      logical :: ok

      associate (n => size(entries), expected => size(header%columns))
         if (n /= expected) then
            fault = 'entries on this line: '//integer_text(n)//', expected '//integer_text(expected)//', one a column'
            if (n > expected .and. index(line, ',') > 0) fault = fault//'; --decimal-comma reads 1,5 as 1.5'
            call errors%add(at, fault, entries(min(n, expected + 1))%first, entries(n)%last)
            return
         end if
      end associate
      data%n = data%n + 1
      data%kind = header%kind
      data%part(data%n) = header%part
      data%line(data%n) = at
      do k = 1, size(header%columns)
         column = header%columns(k)
         if (column == 0) cycle
         fault = ''
         associate (word => line(entries(k)%first:entries(k)%last), place => data%place(:, column, data%n), &
                    value => data%value(column, data%n), branch => data%branch(data%n), run => data%run(data%n))
            if (word == '') then
               fault = 'nothing between two commas, expected an entry'
            else if (column == column_branch .and. (data%kind == data_cubics .or. .not. is_number(word))) then
               branch = findloc(branch_words == upper(word), .true., 1)
               if (branch == 0) fault = ''''//word//''', expected LOAD, UNLOAD or RELOAD'
            else if (column == column_run .or. column == column_branch) then
               call read_number(word, value, ok)
               ok = ok .and. abs(value) <= huge(run)
               if (ok) run = nint(value)
               if (ok) ok = run > 0 .and. abs(value - run) < whole_number
               if (.not. ok) fault = ''''//word//''' is not the number of a run, expected 1, 2, 3 and so on'
            else
               call read_number(word, value, ok)
               if (.not. ok) then
                  fault = ''''//word//''' is not a number'
               else if (abs(value) > 1.0e30_wp) then
                  fault = ''''//word//''' is beyond 1E30'
                  value = 0.0_wp ! reading continues and finds the errors in the next entries
               end if
               value = value*header%factors(column)
            end if
            place = [entries(k)%first, max(entries(k)%first, entries(k)%last)]
            if (fault /= '') call errors%add(at, trim(column_names(column))//': '//fault, place(1), place(2))
         end associate
      end do
   end subroutine read_row

end module fit_data
