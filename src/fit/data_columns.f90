!> Cuts a line of a data file into entries, reads its numbers, and interprets the header that names the columns.
!! The words for columns, branches and units stand here, with the SI value of each unit of data and decks.
module data_columns
   use deck_errors, only: deck_error_list
   use field_rules, only: parse_real
   use kinds, only: wp
   use text_tools, only: one_of, upper
   use tolerances, only: same_unit
   implicit none
   private

   public :: read_system, unit_value, has_force, read_header, set_factors, split_entries, data_part, split_unit, is_number, &
             read_number

   real(wp), parameter :: kgf = 9.80665_wp, inch = 0.0254_wp, lbf = 4.4482216152605_wp

   !> Kinds of units, the units of each kind in the table, and their values in SI units. The kind of a column that is a length or a
   !! stress is its stress_power.
   integer, parameter, public :: of_length = 0, of_stress = 1
   integer, parameter      :: of_force = 2
   integer, parameter      :: first_unit(0:2) = [1, 17, 10], last_unit(0:2) = [9, 23, 16]
   character(6), parameter :: unit_names(23) = [character(6) :: 'M', 'CM', 'MM', 'UM', 'MICRON', 'NM', 'IN', 'MIL', 'FT', &
      'N', 'DAN', 'KN', 'KGF', 'KP', 'LBF', 'KIP', 'PA', 'KPA', 'MPA', 'GPA', 'BAR', 'PSI', 'KSI']
   real(wp), parameter     :: unit_values(23) = [ &
      1.0_wp, 1.0e-2_wp, 1.0e-3_wp, 1.0e-6_wp, 1.0e-6_wp, 1.0e-9_wp, inch, 1.0e-3_wp*inch, 12.0_wp*inch, &
      1.0_wp, 10.0_wp, 1.0e3_wp, kgf, kgf, lbf, 1.0e3_wp*lbf, &
      1.0_wp, 1.0e3_wp, 1.0e6_wp, 1.0e9_wp, 1.0e5_wp, lbf/inch**2, 1.0e3_wp*lbf/inch**2]

   !> A unit of length and one of stress in SI units, and the user's names of them; values 0: none.
   type, public :: unit_system
      real(wp) :: length = 0.0_wp, stress = 0.0_wp
      character(:), allocatable :: length_name, stress_name
   end type unit_system

   !> The branches of the shear law.
   integer, parameter, public :: fit_load = 1, fit_unload = 2, fit_reload = 3
   character(6), parameter, public :: branch_words(3) = [character(6) :: 'LOAD', 'UNLOAD', 'RELOAD']
   character(1), parameter, public :: branch_letters(3) = ['a', 'b', 'c'] !! letters of the coefficients in Eqs. (3b), (5), (6)

   !> The columns of a file, each a power of stress times a power of length, and the kinds of file.
   integer, parameter, public :: column_d = 1, column_tau = 2, column_p = 3, column_lambda = 4, column_c(3) = [5, 6, 7], &
                                 column_branch = 8, column_run = 9, column_k = 10, column_loss = 11, n_columns = 11
   character(6), parameter, public :: column_names(n_columns) = [character(6) :: 'D', 'TAU', 'P', 'LAMBDA', 'C1', 'C2', 'C3', &
                                                                 'BRANCH', 'RUN', 'K', 'LOSS']
   character(6), parameter, public :: column_symbols(n_columns) = [character(6) :: 'd', 'tau', 'p', 'lambda', 'c1', 'c2', 'c3', &
                                                                   'branch', 'run', 'k', 'loss'] !! the names in running text
   integer, parameter         :: stress_power(n_columns) = [0, 1, 1, 0, 1, 1, 1, 0, 0, 1, 1]
   integer, parameter         :: length_power(n_columns) = [1, 0, 0, 1, -1, -2, -3, 0, 0, -1, 1]
   integer, parameter, public :: data_shear = 1, data_normal = 2, data_cubics = 3, data_stiffness = 4, data_loss = 5
   integer, parameter         :: needed(5) = [sum(2**[column_d, column_tau, column_p]), sum(2**[column_lambda, column_p]), &
                                              sum(2**[column_c, column_p, column_branch]), sum(2**[column_k, column_p]), &
                                              sum(2**[column_d, column_loss, column_p])]
   integer, parameter         :: allowed(5) = needed + sum(2**[column_branch, column_run])*[1, 1, 0, 0, 0] &
                                         + [0, 0, 0, 0, 2**column_tau]
   character(*), parameter, public :: known_headers = 'expected a line with the names of the columns: '// &
      '''d tau p branch'', ''lambda p'', ''k p'', ''d loss p'' or ''c1 c2 c3 p branch'', or --columns with them'

   !> The options of the command for reading its files.
   type, public :: reading_type
      type(unit_system) :: deck                 !! --units
      character(:), allocatable :: columns      !! --columns: the header of every file, empty: in the file
      logical :: decimal_comma = .false.        !! --decimal-comma
      real(wp) :: area = 0.0_wp                 !! --area: of the joint, where the column is a force [length^2]; 0: not given
   end type reading_type

   type, public :: header_type
      integer :: line   = 0                     !! in the text of the file
      integer :: part   = 0                     !! part of the file that the header begins, 0: no header yet
      integer :: kind   = 0                     !! data_shear, data_normal, data_cubics, data_stiffness or data_loss
      logical :: of_force = .false.             !! the column of p holds a force: p is the force over the area
      integer :: holds  = 0                     !! sum of 2**column
      logical :: decimal_comma = .false.        !! of the rows below the header
      integer, allocatable :: columns(:)        !! (entries of a row) 0: ignored; of size 0: the header is wrong
      character(16) :: units(n_columns) = ''    !! given in the headings
      real(wp)      :: factors(n_columns) = 1.0_wp !! from the unit of the heading to the unit of the cards
   end type header_type

   character(*), parameter :: blanks = ' '//achar(9)

   !> Position of an entry in its line; an empty entry between two separators has LAST < FIRST.
   type, public :: entry_type
      integer :: first = 0, last = 0
   end type entry_type

contains

   !> Read `mm, kgf` or `um, MPa`: a unit of length, and a unit of force or stress. With a force the stress is force/length^2.
   pure subroutine read_system(text, system, ok)
      character(*), intent(in)       :: text
      type(unit_system), intent(out) :: system
      logical, intent(out)           :: ok
      character(:), allocatable :: second
      real(wp) :: force
      integer  :: comma

      comma = index(text//',', ',')
      system%length_name = trim(adjustl(text(:comma - 1)))
      second = trim(adjustl(text(min(comma, len(text)) + 1:)))
      system%length = unit_value(system%length_name, of_length)
      system%stress_name = second
      system%stress = unit_value(second, of_stress)
      force = unit_value(second, of_force)
      if (force > 0.0_wp) system%stress_name = second//'/'//system%length_name//'2'
      if (force > 0.0_wp .and. system%length > 0.0_wp) system%stress = force/system%length**2
      ok = system%length > 0.0_wp .and. system%stress > 0.0_wp
   end subroutine read_system

   !> UNIT in SI units: a name, or of stress force/length2 too; 0 where it is not a unit of this KIND.
   pure recursive real(wp) function unit_value(unit, kind) result(value)
      character(*), intent(in) :: unit
      integer, intent(in)      :: kind
      character(:), allocatable :: word
      real(wp) :: length
      integer  :: k, last, slash

      word = plain(unit)
      last = len(word)
      k = findloc(unit_names(first_unit(kind):last_unit(kind)) == word, .true., 1)
      value = 0.0_wp
      if (k > 0) value = unit_values(first_unit(kind) + k - 1)
      slash = index(word, '/')
      if (kind /= of_stress .or. slash == 0 .or. last < slash + 2) return
      if (word(last:last) /= '2') return
      length = unit_value(word(slash + 1:last - 1), of_length)
      if (length > 0.0_wp) value = unit_value(word(:slash - 1), of_force)/length**2
   end function unit_value

   !> UNIT of a stiffness per area in SI units, as N/um/mm2, MPa/um or N/mm3; 0 where it is none.
   pure real(wp) function stiffness_value(unit) result(value)
      character(*), intent(in) :: unit
      character(:), allocatable :: word
      real(wp) :: length
      integer  :: last, middle, slash

      word = plain(unit)
      value = 0.0_wp
      slash = index(word, '/', back=.true.)
      last = len(word)
      if (slash < 2 .or. slash == last) return
      length = unit_value(word(slash + 1:), of_length)
      if (length > 0.0_wp) value = unit_value(word(:slash - 1), of_stress)/length
      length = unit_value(word(slash + 1:last - 1), of_length)
      if (length <= 0.0_wp .or. value > 0.0_wp) return
      middle = index(word(:slash - 1), '/')
      if (word(last:last) == '3') value = unit_value(word(:slash - 1), of_force)/length**3
      if (word(last:last) /= '2' .or. middle < 2 .or. middle == slash - 1) return
      value = unit_value(word(:middle - 1), of_force)/length**2
      length = unit_value(word(middle + 1:slash - 1), of_length)
      value = merge(value/max(length, tiny(length)), 0.0_wp, length > 0.0_wp)
   end function stiffness_value

   !> UNIT of a loss per area in SI units, as MPa*um; 0 where it is none.
   pure real(wp) function loss_value(unit) result(value)
      character(*), intent(in) :: unit
      integer :: star

      star = index(unit, '*')
      value = 0.0_wp
      if (star > 1) value = unit_value(unit(:star - 1), of_stress)*unit_value(unit(star + 1:), of_length)
   end function loss_value

   !> Whether a unit of force exists with which LENGTH and STRESS [SI] are consistent units of a deck.
   pure logical function has_force(length, stress)
      real(wp), intent(in) :: length, stress

      associate (forces => unit_values(first_unit(of_force):last_unit(of_force)))
         has_force = any(abs(forces - stress*length**2) <= same_unit*forces)
      end associate
   end function has_force

   !> UNIT in capitals without blanks and ^; the Greek mu becomes U, superscripts become digits.
   pure function plain(unit) result(word)
      character(*), intent(in)  :: unit
      character(:), allocatable :: word
      integer :: k

      word = ''
      do k = 1, len(unit)
         select case (iachar(unit(k:k)))
         case (178, 179)                  ! superscripts 2 and 3, their second byte in UTF-8
            word = word//achar(iachar(unit(k:k)) - 128)
         case (181, 188)                  ! the micro sign and the Greek mu, their second byte
            word = word//'U'
         case (194, 206, iachar(' '), iachar('^'), 9)
            cycle
         case default
            word = word//upper(unit(k:k))
         end select
      end do
   end function plain

   !> Read the header LINE. A file may have several headers of one kind, each for the rows below it.
   subroutine read_header(line, at, reading, header, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at      !! line in the file, 0: from the command
      type(reading_type), intent(in)       :: reading
      type(header_type), intent(inout)     :: header !! the previous header, and then this one
      type(deck_error_list), intent(inout) :: errors
      type(entry_type), allocatable :: entries(:)
      character(:), allocatable     :: name, unit
      integer, allocatable          :: columns(:)
      integer :: errors_before, holds, k, kind
      logical :: is_force

      errors_before = errors%n
      is_force = .false.
      call split_entries(line, entries, .true.)
      columns = [(0, k = 1, size(entries))]
      do k = 1, size(entries)
         associate (first => entries(k)%first, last => entries(k)%last)
            call split_unit(line(first:last), name, unit)
            columns(k) = findloc(column_names == upper(name), .true., 1)
            if (upper(name) == 'F') columns(k) = column_p
            if (upper(name) == 'F') is_force = .true.
            if (name == '-') then
               cycle
            else if (columns(k) == 0) then
               call errors%add(at, ''''//name//''' is not a column of jointfit (--columns renames it, - skips '// &
                  'it); '//known_headers, first, last)
            else if (any(columns(:k - 1) == columns(k))) then
               call errors%add(at, 'column '''//name//''' given twice', first, last)
            else if (unit /= '') then
               associate (known => header%units(columns(k)))
                  if (known /= '' .and. unit /= known .and. reading%deck%length <= 0.0_wp) call errors%add(at, name//' in '// &
                     unit//', but above in '//trim(known)//': --units mm,n converts both', first, last)
                  known = unit
               end associate
            end if
         end associate
      end do
      holds = sum(2**pack(columns, columns > 0))
      kind = findloc(iand(holds, needed) == needed .and. iand(holds, allowed) == holds, .true., 1)
      if (errors%n == errors_before) then
         if (kind == 0) then
            call errors%add(at, 'these columns are not a known combination; '//known_headers)
         else if (header%holds /= 0 .and. holds /= header%holds) then
            call errors%add(at, 'a header of a different kind: expected one kind of data in a file')
         else if (is_force .neqv. reading%area > 0.0_wp) then
            call errors%add(at, one_of(is_force, 'a column f, a force, needs --area, the area of the joint', &
                                       '--area needs a column f, a force, in place of p'))
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
      header%of_force = is_force
   end subroutine read_header

   !> The factors from the units of the data, given in the headings or in the line UNITS = of FILE, to the units of the cards.
   subroutine set_factors(reading, file, header, errors)
      type(reading_type), intent(in)       :: reading
      type(unit_system), intent(in)        :: file
      type(header_type), intent(inout)     :: header
      type(deck_error_list), intent(inout) :: errors
      real(wp) :: unit
      integer  :: column, k

      if (header%of_force) header%factors(column_p) = 1.0_wp/reading%area
      if (reading%deck%length <= 0.0_wp) return
      do k = 1, size(header%columns)
         column = header%columns(k)
         if (column == 0 .or. column == column_branch .or. column == column_run) cycle
         unit = unit_in(file, column)
         if (header%units(column) /= '' .and. length_power(column) >= 0) &
            unit = unit_value(trim(header%units(column)), stress_power(column))
         if (header%units(column) /= '' .and. column == column_loss) unit = loss_value(trim(header%units(column)))
         if (header%units(column) /= '' .and. column == column_k) unit = stiffness_value(trim(header%units(column)))
         if (header%of_force .and. column == column_p) unit = unit_value(trim(header%units(column)), of_force)/ &
                                                              (reading%area*reading%deck%length**2)
         header%factors(column) = unit/unit_in(reading%deck, column)
         if (unit > 0.0_wp) cycle
         if (header%units(column) /= '') then
            call errors%add(header%line, ''''//trim(header%units(column))//''' is no unit of '//trim(column_symbols(column))// &
                            ' known to --units: expected um, mm, m, in; MPa, kgf/cm2, bar, psi, of f N, of k N/um/mm2 and '// &
                            'the like')
         else
            call errors%add(header%line, 'the unit of '//trim(column_symbols(column))//' is missing, and --units needs it: '// &
               'expected a heading as lambda [um], here or in --columns, or a line UNITS = um, MPa')
         end if
      end do
   end subroutine set_factors

   !> The unit of COLUMN in SYSTEM [SI], 0 where it is unknown.
   pure real(wp) function unit_in(system, column) result(unit)
      type(unit_system), intent(in) :: system
      integer, intent(in)           :: column

      unit = 0.0_wp
      if (system%length > 0.0_wp) unit = system%stress**stress_power(column)*system%length**length_power(column)
   end function unit_in

   !> LINE up to its comment, # or $, without trailing blanks and tabs. Double quotes, which spreadsheets put around words, become
   !! blanks.
   pure function data_part(line) result(words)
      character(*), intent(in)  :: line
      character(:), allocatable :: words
      integer :: k

      words = line(:scan(line//'#', '#$') - 1)
      do k = 1, len(words)
         if (words(k:k) == '"') words(k:k) = ' '
      end do
      words = words(:verify(words, blanks, back=.true.))
   end function data_part

   !> Cut LINE at blanks, tabs, commas and semicolons. Blanks around a separator belong to it. An entry is empty between two
   !! separators, before the first and after the last one. Text in brackets and the blanks before it do not separate: `lambda [um]`
   !! is one entry. With DECIMAL_COMMA a comma before a digit does not separate, nor does it in a line with semicolons.
   pure subroutine split_entries(line, entries, decimal_comma)
      character(*), intent(in)                   :: line
      type(entry_type), allocatable, intent(out) :: entries(:)
      logical, intent(in)                        :: decimal_comma
      character(len(line)) :: open
      integer :: at, k, last
      logical :: waits  ! a separator waits for the entry after it

      open = line
      do          ! mark text in brackets, and blanks between a name and its brackets, by x
         at = scan(open, '[(')
         if (at == 0) exit
         last = min(at + scan(open(at:)//')', '])') - 1, len(line))
         k = verify(open(:at - 1), blanks, back=.true.)
         if (k > 0) then
            if (scan(line(k:k), ',;])') == 0) at = k + 1
         end if
         open(at:last) = repeat('x', last - at + 1)
      end do
      if (decimal_comma .or. index(open, ';') > 0) then
         do k = 1, len(line) - 1
            if (line(k:k) == ',' .and. scan(line(k + 1:k + 1), '0123456789') == 1) open(k:k) = 'x'
         end do
      end if
      allocate (entries(0))
      waits = .false.
      at = next(1)
      do while (at <= len(line))
         last = at + scan(open(at:)//' ', blanks//',;') - 2
         entries = [entries, entry_type(at, last)]
         at = next(last + 1)
         if (at > len(line)) return
         waits = scan(open(at:at), ',;') == 1
         if (waits) at = next(at + 1)
      end do
      if (waits) entries = [entries, entry_type(len(line) + 1, len(line))]

   contains

      !> The next nonblank position from FROM on.
      pure integer function next(from)
         integer, intent(in) :: from

         next = from + verify(open(from:)//',', blanks) - 1
      end function next

   end subroutine split_entries

   !> The NAME and the UNIT in an entry of a header, `lambda [um]` or `lambda(um)`; without brackets there is no unit.
   pure subroutine split_unit(entry, name, unit)
      character(*), intent(in)               :: entry
      character(:), allocatable, intent(out) :: name, unit
      integer :: first

      first = scan(entry//'[', '[(')
      name = entry(:verify(entry(:first - 1), blanks, back=.true.))
      unit = ''
      if (first < len(entry)) unit = trim(adjustl(entry(first + 1:first + scan(entry(first + 1:)//')', '])') - 1)))
   end subroutine split_unit

   !> Whether WORD begins like a number.
   pure logical function is_number(word)
      character(*), intent(in) :: word

      is_number = scan(word, '0123456789+-.,') == 1
   end function is_number

   !> Read a number of the data or the command. Unlike on cards, the decimal point may be missing or be a comma.
   pure subroutine read_number(text, value, ok)
      character(*), intent(in) :: text
      real(wp), intent(out)    :: value
      logical, intent(out)     :: ok
      character(len(text)) :: number
      integer :: comma

      number = text
      comma = index(text, ',')
      if (comma > 0) number(comma:comma) = '.'
      call parse_real(number, value, ok)
      if (.not. ok) call parse_real(number//'.', value, ok)
   end subroutine read_number

end module data_columns
