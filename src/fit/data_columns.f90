!> The words of a data file: its columns, the units in its headings, the branches; and the header line that names the columns.
module data_columns
   use data_entries, only: entry_type, split_entries, split_unit
   use data_units, only: has_force, unit_system, unit_value
   use deck_errors, only: deck_error_list
   use kinds, only: wp
   use text_tools, only: upper
   implicit none
   private

   public :: branch_number, read_header, set_factors, check_system

   !> The branches of the shear law.
   integer, parameter, public :: fit_load = 1, fit_unload = 2, fit_reload = 3
   character(6), parameter, public :: branch_words(3) = [character(6) :: 'LOAD', 'UNLOAD', 'RELOAD']
   character(1), parameter, public :: branch_letters(3) = ['a', 'b', 'c'] !! of the coefficients, as in Eqs. (3b), (5), (6)

   !> Columns that a file may have, each a power of stress times one of length, and the kinds of file that they make.
   integer, parameter, public :: column_d = 1, column_tau = 2, column_p = 3, column_lambda = 4, column_c(3) = [5, 6, 7], &
                                 column_branch = 8, column_run = 9, n_columns = 9
   character(6), parameter, public :: column_names(n_columns) = [character(6) :: 'D', 'TAU', 'P', 'LAMBDA', 'C1', 'C2', 'C3', &
                                                                 'BRANCH', 'RUN']
   character(6), parameter, public :: column_symbols(n_columns) = [character(6) :: 'd', 'tau', 'p', 'lambda', 'c1', 'c2', 'c3', &
                                                                   'branch', 'run'] !! the same in running text
   integer, parameter         :: stress_power(n_columns) = [0, 1, 1, 0, 1, 1, 1, 0, 0]
   integer, parameter         :: length_power(n_columns) = [1, 0, 0, 1, -1, -2, -3, 0, 0]
   integer, parameter, public :: data_shear = 1, data_normal = 2, data_cubics = 3
   integer, parameter         :: needed(3) = [sum(2**[column_d, column_tau, column_p]), sum(2**[column_lambda, column_p]), &
                                              sum(2**[column_c, column_p, column_branch])]
   integer, parameter         :: allowed(3) = needed + sum(2**[column_branch, column_run])*[1, 1, 0]
   character(*), parameter, public :: known_headers = 'expected a line with the names of the columns: '// &
      '''d tau p branch'', ''lambda p'' or ''c1 c2 c3 p branch'', or --columns with them'

   !> How the command wants its files to be read.
   type, public :: reading_type
      type(unit_system) :: deck                 !! --units
      character(:), allocatable :: columns      !! --columns: the header of every file, empty: it has its own
      logical :: decimal_comma = .false.        !! --decimal-comma
   end type reading_type

   type, public :: header_type
      integer :: line   = 0                     !! in the text of the file
      integer :: part   = 0                     !! of the file that it begins, 0: no header yet
      integer :: kind   = 0                     !! data_shear, data_normal or data_cubics
      integer :: holds  = 0                     !! sum of 2**column
      logical :: decimal_comma = .false.        !! of the rows below it
      integer, allocatable :: columns(:)        !! (entries of a row) 0: left out; of size 0: the header is wrong
      character(16) :: units(n_columns) = ''    !! in the headings
      real(wp)      :: factors(n_columns) = 1.0_wp !! from there to the units of the cards
   end type header_type

contains

   !> The number of the branch called WORD (in capitals), 0 for any other word.
   pure integer function branch_number(word) result(branch)
      character(*), intent(in) :: word

      branch = findloc(branch_words == word, .true., 1)
   end function branch_number

   !> Read the header LINE. A file may hold several, each for the rows below it, of one kind.
   subroutine read_header(line, at, reading, header, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at      !! its place in the file, 0: it is from the command
      type(reading_type), intent(in)       :: reading
      type(header_type), intent(inout)     :: header !! the one before, and now this one
      type(deck_error_list), intent(inout) :: errors
      type(entry_type), allocatable :: entries(:)
      character(:), allocatable     :: name, unit
      integer, allocatable          :: columns(:)
      integer :: errors_before, holds, k, kind

      errors_before = errors%n
      call split_entries(line, entries, .true.)
      columns = [(0, k = 1, size(entries))]
      do k = 1, size(entries)
         associate (first => entries(k)%first, last => entries(k)%last)
            call split_unit(line(first:last), name, unit)
            columns(k) = findloc(column_names == upper(name), .true., 1)
            if (name == '-') then
               cycle
            else if (columns(k) == 0) then
               call errors%add(at, ''''//name//''' is no column that jointfit knows (--columns tells what it is, - that it '// &
                               'does not count); '//known_headers, first, last)
            else if (any(columns(:k - 1) == columns(k))) then
               call errors%add(at, 'column '''//name//''' a second time', first, last)
            else if (unit /= '') then
               associate (known => header%units(columns(k)))
                  if (known /= '' .and. unit /= known .and. reading%deck%length <= 0.0_wp) &
                     call errors%add(at, name//' in '//unit//', but above in '//trim(known)//': --units mm,n converts both', &
                                     first, last)
                  known = unit
               end associate
            end if
         end associate
      end do
      holds = sum(2**pack(columns, columns > 0))
      kind = findloc(iand(holds, needed) == needed .and. iand(holds, allowed) == holds, .true., 1)
      if (errors%n == errors_before) then
         if (kind == 0) then
            call errors%add(at, 'these columns do not go together; '//known_headers)
         else if (header%holds /= 0 .and. holds /= header%holds) then
            call errors%add(at, 'a header of another kind than the one above: expected one kind of data in a file')
         end if
      end if
      header%line = at
      header%part = header%part + 1
      header%decimal_comma = reading%decimal_comma .or. index(line, ';') > 0
      header%columns = columns
      if (errors%n > errors_before) header%columns = [integer ::]
      if (errors%n > errors_before) return
      header%kind = kind
      header%holds = holds
   end subroutine read_header

   !> The factors from the units of the data, those of the headings or of FILE, the line UNITS =, to those of the cards.
   subroutine set_factors(reading, file, header, errors)
      type(reading_type), intent(in)       :: reading
      type(unit_system), intent(in)        :: file
      type(header_type), intent(inout)     :: header
      type(deck_error_list), intent(inout) :: errors
      real(wp) :: unit
      integer  :: column, k

      if (reading%deck%length <= 0.0_wp) return
      do k = 1, size(header%columns)
         column = header%columns(k)
         if (column == 0 .or. column == column_branch .or. column == column_run) cycle
         unit = unit_in(file, column)
         if (header%units(column) /= '' .and. length_power(column) >= 0) &
            unit = unit_value(trim(header%units(column)), stress_power(column))
         header%factors(column) = unit/unit_in(reading%deck, column)
         if (unit > 0.0_wp) cycle
         if (header%units(column) /= '') then
            call errors%add(header%line, ''''//trim(header%units(column))//''' is no unit of '//trim(column_symbols(column))// &
                            ' that --units knows: expected um, mm, m, in; MPa, kgf/cm2, bar, psi and the like')
         else
            call errors%add(header%line, 'the unit of '//trim(column_symbols(column))//' is not said, and --units needs it: '// &
                            'expected a heading as lambda [um], here or in --columns, or a line UNITS = um, MPa')
         end if
      end do
   end subroutine set_factors

   !> The unit of COLUMN in SYSTEM [SI], 0 where this is none.
   pure real(wp) function unit_in(system, column) result(unit)
      type(unit_system), intent(in) :: system
      integer, intent(in)           :: column

      unit = 0.0_wp
      if (system%length > 0.0_wp) unit = system%stress**stress_power(column)*system%length**length_power(column)
   end function unit_in

   !> What without --units speaks against the units in the headings: two of stress, or none of force that goes with them.
   subroutine check_system(header, warnings)
      type(header_type), intent(in)        :: header
      type(deck_error_list), intent(inout) :: warnings
      character(16) :: length, stress(2)
      real(wp) :: values(2)

      length = header%units(merge(column_d, column_lambda, header%kind == data_shear))
      stress = header%units(merge([column_p, column_tau], column_p, header%kind == data_shear))
      values = [unit_value(trim(length), 0), unit_value(trim(stress(1)), 1)]
      if (any(values <= 0.0_wp) .or. any(stress == '')) return
      if (stress(1) == stress(2) .and. has_force(values(1), values(2))) return
      if (stress(1) /= stress(2)) length = stress(2)
      call warnings%add(0, trim(length)//' and '//trim(stress(1))//' are no units of one deck: --units mm,n converts both')
   end subroutine check_system

end module data_columns
