!> Reads the command line of jointfit, its options and data files, and prints `jointfit --help`.
module fit_command
   use branch_fit, only: fit_choice
   use c_library, only: is_same_file
   use terminal, only: command_reader, complain, input_argument, next_option, say, version
   use data_columns, only: branch_words, reading_type, read_number, read_system
   use deck_parameters, only: is_parameter_name, parameter_type
   use field_rules, only: parse_integer
   use kinds, only: wp
   use text_tools, only: integer_text, plural, upper
   implicit none
   private

   public :: read_fit_command

   character(*), parameter :: program = 'jointfit', nl = new_line('a')
   character(*), parameter :: standard_output = '/dev/stdout'
   character(13), parameter :: options_with_value(16) = [character(13) :: '--id', '--branch', '--as', '--p-tolerance', '--dmax', &
                                                        '--noise', '--units', '--columns', '--plot', '--area', &
                                                         '--bulk', '--structure', '--measured', '--start', '--starts', '--set']
   integer, parameter :: largest_in_small_field = 99999999

   character(*), parameter :: help = &
      'usage: jointfit [options] DATA...'//nl// &
      ''//nl// &
      'examples:'//nl// &
      '   jointfit normal.dat > law.bdf                     a JNORM card from points `lambda p`'//nl// &
      '   jointfit --units mm,n --plot fit.gp shear.csv     cards in mm and N, and a picture of data and fit'//nl// &
      '   jointfit --structure a.bdf --measured a.csv       parameters of a deck from what was measured on the structure'//nl// &
      ''//nl// &
      'Fits the laws of a joint to test data. The cards for a deck of jointfem go to standard output, with the'//nl// &
      'residuals as comments. Each file holds the data of one surface; `-` is standard input. One line of a file'//nl// &
      'names its columns, in any order:'//nl// &
      ''//nl// &
      '   d tau p             points of shear tests: a JSHEAR card'//nl// &
      '   lambda p            points of normal tests: a JNORM card'//nl// &
      '   k p                 stiffnesses k = dp/dlambda of normal tests: a JNORM card'//nl// &
      '   c1 c2 c3 p branch   cubics tau = c1 d + c2 d^2 + c3 d^3 published for several p: a JSHEAR card'//nl// &
      '   d loss p            loss of a cycle per area, as MPa*um, at the amplitude d, with its tau if known: a JIWAN'//nl// &
      '                       card'//nl// &
      ''//nl// &
      'A column f in place of p holds the normal force; --area is the area under it. Points may have two further'//nl// &
      'columns:'//nl// &
      ''//nl// &
      '   branch   LOAD, UNLOAD or RELOAD: consecutive rows of one branch and pressure are a run; rows in no order'//nl// &
      '            share one run'//nl// &
      '   run      number of the run from one reversal to the next: every run of unloading or reloading starts at'//nl// &
      '            its own point (b0, c0); without a column branch the direction of the run gives its branch'//nl// &
      ''//nl// &
      'Without both columns the rows are a record in the order of time, which is cut where the test reverses by more'//nl// &
      'than the noise of the readings. After a reversal the test reloads up to the end of the previous loading (p'//nl// &
      'of a normal test, d of a shear test) and loads beyond it. Unloading and reloading of a normal test do not'//nl// &
      'enter c and m; straight lines through them give EU. A second line of headings, another pressure of a shear'//nl// &
      'test, or a reading equal to the first one begins a new test.'//nl// &
      ''//nl// &
      'Blanks, tabs, commas or semicolons separate entries (with semicolons 1,5 is 1.5); # and $ begin a comment.'//nl// &
      'Headings may give units, as `lambda [um]; p [MPa]`; `UNITS = ...` is copied to the comments. The cards are in'//nl// &
      'the units of the data, or of --units.'//nl// &
      ''//nl// &
      'the data:'//nl// &
      '   --units L,F       units of length and force of the cards, such as mm,n or mm,kgf or m,n'//nl// &
      '   --decimal-comma   1,5 is 1.5 without semicolons too'//nl// &
      '   --columns NAMES   names of the columns, in place of headings; - omits a column: -,p [MPa],lambda [um]'//nl// &
      '   --noise X         noise band, relative to the range of the readings: smaller reversals do not count, and a'//nl// &
      '                     first reading less below zero is an offset (default: from the record, at least 0.01)'//nl// &
      '   --zero            subtract the first reading of each test from all its readings'//nl// &
      '   --unordered       rows without a branch are in no order: all are loading'//nl// &
      ''//nl// &
      'normal tests:'//nl// &
      '   --area A          area of the joint, in the units of the cards, for a column f'//nl// &
      '   --bulk E,H        compression of a specimen between the gauges, taken off lambda: modulus and height, in the'//nl// &
      '                     units of the cards; E,H,E,H for two specimens'//nl// &
      '   --seat            fit an offset of lambda, or of lambda and p, and take it off: the test was zeroed under a'//nl// &
      '                     seating load, or a gauge was not at zero. All tests of a file share it. Without --seat an'//nl// &
      '                     offset that an F test finds significant is told'//nl// &
      ''//nl// &
      'shear:'//nl// &
      '   --iwan            a JIWAN card from points `d tau p` in the order of time, in place of JSHEAR'//nl// &
      '   --joint-fit       fit the coefficients to all points of a branch at once, instead of straight lines'//nl// &
      '                     through the coefficients of the cubics of each pressure'//nl// &
      '   --one-pressure    accept data at one pressure; the card then does not depend on the pressure'//nl// &
      '   --p-tolerance X   pressures that differ by less than this share count as one (default 0.001)'//nl// &
      '   --branch BRANCH   use only this branch of the data'//nl// &
      '   --as BRANCH       with --branch: use the data for this branch of the card'//nl// &
      '   --dmax X          DMAX of the card, in its units (default: the largest d of the loading data)'//nl// &
      ''//nl// &
      'a structure:'//nl// &
      '   --structure DECK  parameters ${N} of DECK from what was measured on the structure, in place of DATA; the deck''s'//nl// &
      '                     cards with the values go to standard output, below tables of parameters and rows'//nl// &
      '   --measured FILE   rows of measured values, and the parameters with their starts and bounds'//nl// &
      '   --start N=V       begin the search of ${N} at V'//nl// &
      '   --starts N        search from N starts between the bounds (default 1)'//nl// &
      '   --set N=V         a parameter of the deck that keeps the value V'//nl// &
      ''//nl// &
      'output:'//nl// &
      '   --id N            number of the first card (default 1); the cards of further files have the next numbers'//nl// &
      '   --plot FILE       write data and fit as a script for gnuplot, which draws an SVG picture in the same folder'//nl// &
      '   --large           numbers in fields of 16 columns (default)'//nl// &
      '   --small           numbers in fields of 8 columns'//nl// &
      '   --version         print the version'//nl// &
      '   --help            print this text'//nl// &
      ''//nl// &
      'exit status: 0 all cards written, 1 wrong usage or unreadable file, 2 errors in the data, 3 the structure cannot be'//nl// &
      'solved with the start values, or an interrupt, 4 output could not be written; of several files the highest.'

   type, public :: fit_command_type
      integer  :: id        = 1          !! --id: of the card of the first file
      logical  :: small     = .false.    !! --small: fields of eight columns
      integer  :: only      = 0          !! --branch: the branch of the data to use, 0: all
      integer  :: as        = 0          !! --as: the branch of the card that takes these data
      real(wp) :: d_max     = 0.0_wp     !! --dmax: DMAX of the card [length], 0: the largest d of the data
      real(wp) :: noise     = 0.0_wp     !! --noise: noise as a share of the range of the readings, 0: estimated
      logical  :: zero      = .false.    !! --zero: subtract the first reading of a test from all its readings
      logical  :: seat      = .false.    !! --seat: fit the offset of a normal test
      real(wp) :: bulk      = 0.0_wp     !! --bulk: compression of the specimens under unit pressure [length/pressure]
      logical  :: iwan      = .false.    !! --iwan: a JIWAN card from points of shear tests
      logical  :: unordered = .false.    !! --unordered: rows that do not name their branch are loading
      character(:), allocatable :: plot  !! --plot: a file for gnuplot, empty: none
      type(fit_choice)   :: fit          !! --p-tolerance, --joint-fit, --one-pressure
      type(reading_type) :: reading      !! --units, --columns, --decimal-comma
      type(input_argument), allocatable :: files(:)
      type(input_argument) :: structure, measured           !! --structure, --measured: PATH empty: none
      type(parameter_type), allocatable :: start(:), set(:) !! --start, --set
      integer :: n_starts = 1            !! --starts
   end type fit_command_type

contains

   !> Read the command. STATUS is the exit status where nothing is left to do, after --help and --version, and after a wrong
   !! command, which has a message on the standard error; otherwise it is -1.
   subroutine read_fit_command(command, status)
      type(fit_command_type), intent(out) :: command
      integer, intent(out)                :: status
      type(command_reader) :: reader
      character(:), allocatable :: expected, option, value
      logical :: is_missing, ok

      command%plot = ''
      command%structure = input_argument('', '')
      command%measured = command%structure
      allocate (command%start(0), command%set(0))
      command%reading%columns = ''
      expected = ''
      status = 1
      ok = .true.
      do
         call next_option(reader, options_with_value, option, value, is_missing) ! VALUE is empty where it is missing
         select case (option)
         case ('')
            exit
         case ('--help', '-h')
            call say(help, status)
            return
         case ('--version')
            call say(program//' '//version, status)
            return
         case ('--joint-fit')
            command%fit%one_step = .true.
         case ('--one-pressure')
            command%fit%one_pressure = .true.
         case ('--zero')
            command%zero = .true.
         case ('--seat')
            command%seat = .true.
         case ('--iwan')
            command%iwan = .true.
         case ('--unordered')
            command%unordered = .true.
         case ('--decimal-comma')
            command%reading%decimal_comma = .true.
         case ('--small', '--large')
            command%small = option == '--small'
         case default
            if (all(option /= options_with_value)) then
               call complain(program, 'unknown option '//option)
               return
            end if
            call take_value(option, value, command, expected, ok)
         end select
         if (.not. ok) call complain(program, option//' '//value//': expected '//expected)
         if (.not. ok) return
      end do
      call move_alloc(reader%files, command%files)
      call complete_command(command, ok)
      if (ok) status = -1
   end subroutine read_fit_command

   !> Take the VALUE of an OPTION with one. OK is false where it is not as EXPECTED.
   subroutine take_value(option, value, command, expected, ok)
      character(*), intent(in)               :: option, value
      type(fit_command_type), intent(inout)  :: command
      character(:), allocatable, intent(out) :: expected
      logical, intent(out)                   :: ok
      integer :: branch

      ok = .false.
      expected = ''
      select case (option)
      case ('--id')
         call parse_integer(value, command%id, ok)
         ok = ok .and. command%id > 0
         expected = 'a number of 1 or more'
      case ('--branch', '--as')
         branch = findloc(branch_words == upper(value), .true., 1)
         if (option == '--branch') command%only = branch
         if (option == '--as') command%as = branch
         ok = branch > 0
         expected = 'LOAD, UNLOAD or RELOAD'
      case ('--p-tolerance')
         call read_number(value, command%fit%p_tolerance, ok)
         ok = ok .and. command%fit%p_tolerance >= 0.0_wp .and. command%fit%p_tolerance < 1.0_wp
         expected = 'a number from 0 to below 1, as 0.01'
      case ('--noise')
         call read_number(value, command%noise, ok)
         ok = ok .and. command%noise > 0.0_wp .and. command%noise < 0.5_wp
         expected = 'a share of the range of the readings, above 0 and below 0.5, as 0.02'
      case ('--dmax')
         call read_number(value, command%d_max, ok)
         ok = ok .and. command%d_max > 0.0_wp
         expected = 'a number above 0'
      case ('--area')
         call read_number(value, command%reading%area, ok)
         ok = ok .and. command%reading%area > 0.0_wp
         expected = 'an area above 0'
      case ('--bulk')
         call read_specimens(value, command%bulk, ok)
         expected = 'modulus and height of the specimen, as 210000,40, or of two, as 210000,40,120000,25'
      case ('--units')
         call read_system(value, command%reading%deck, ok)
         expected = 'the units of length and force of the deck, as mm,n or mm,kgf or m,n'
      case ('--columns')
         command%reading%columns = value
         ok = value /= ''
         expected = 'the names of the columns, as ''p [MPa], lambda [um]'''
      case ('--structure', '--measured')
         if (option == '--structure') command%structure = input_argument(value, value)
         if (option == '--measured') command%measured = input_argument(value, value)
         ok = value /= ''
         expected = 'the name of a file'
      case ('--starts')
         call parse_integer(value, command%n_starts, ok)
         ok = ok .and. command%n_starts > 0
         expected = 'a number of 1 or more'
      case ('--start', '--set')
         if (option == '--start') call add_parameter(value, command%start, ok)
         if (option == '--set') call add_parameter(value, command%set, ok)
         expected = 'NAME=VALUE'
      case ('--plot')
         command%plot = value
         ok = value /= ''
         expected = 'the name of a file for gnuplot'
      end select
   end subroutine take_value

   !> Add TEXT, NAME=VALUE, to LIST.
   subroutine add_parameter(text, list, ok)
      character(*), intent(in) :: text
      type(parameter_type), allocatable, intent(inout) :: list(:)
      logical, intent(out)     :: ok
      type(parameter_type), allocatable :: longer(:)
      real(wp) :: value
      integer  :: n

      n = index(text//'=', '=')
      ok = is_parameter_name(text(:n - 1))
      if (ok) call read_number(text(n + 1:), value, ok)
      if (.not. ok) return
      allocate (longer(size(list) + 1)) ! (an array constructor would lose texts in gfortran 12)
      longer(:size(list)) = list
      longer(size(longer))%name = text(:n - 1)
      longer(size(longer))%value = text(n + 1:)
      call move_alloc(longer, list)
   end subroutine add_parameter

   !> Read TEXT, E,H or E,H,E,H and so on, of specimens on each other: their compression BULK under unit pressure, the sum of H/E.
   subroutine read_specimens(text, bulk, ok)
      character(*), intent(in) :: text
      real(wp), intent(out)    :: bulk
      logical, intent(out)     :: ok
      real(wp) :: values(2)
      integer  :: first, k, n

      bulk = 0.0_wp
      first = 1
      n = 0
      do
         do k = 1, 2
            n = index(text(first:)//',', ',')
            call read_number(text(first:min(first + n - 2, len(text))), values(k), ok)
            ok = ok .and. (k == 2 .or. first + n - 1 <= len(text))
            if (ok) ok = values(k) > 0.0_wp
            if (.not. ok) return
            first = first + n
         end do
         bulk = bulk + values(2)/values(1)
         if (first > len(text) + 1) return
      end do
   end subroutine read_specimens

   !> Complete the command: check that the options go together, and that no output would replace a data file under any name; OK is
   !! false, with a message, where they do not.
   subroutine complete_command(command, ok)
      type(fit_command_type), intent(inout) :: command
      logical, intent(out)                  :: ok
      character(:), allocatable :: fault
      integer :: i

      fault = ''
      associate (n => size(command%files))
         if (command%structure%path /= '' .or. command%measured%path /= '') then
            if (n > 0 .or. command%structure%path == '' .or. command%measured%path == '') &
               fault = '--structure DECK and --measured FILE go together, without other files'
         else if (n == 0) then
            fault = 'no data file given'
         else if (command%as > 0 .and. command%only == 0) then
            fault = '--as needs --branch, the branch of the data'
         else if (command%id > huge(1) - (n - 1)) then
            fault = '--id '//integer_text(command%id)//': the laws of '//plural(n, 'file')//' would have numbers beyond '// &
                    integer_text(huge(1))
         else if (command%small .and. command%id > largest_in_small_field - (n - 1)) then
            fault = '--id '//integer_text(command%id)//': --small has eight columns for the numbers of '//plural(n, 'file')// &
                    ', they end at '//integer_text(largest_in_small_field)
         end if
      end associate
      do i = 1, size(command%files)
         if (fault /= '') exit
         associate (file => command%files(i))
            if (is_same_file(standard_output, file%path)) fault = 'the cards would be written to the data file '//file%name
            if (command%plot == '') cycle
            if (is_same_file(command%plot, file%path)) fault = '--plot '//command%plot//' would overwrite the data file '//file%name
         end associate
      end do
      ok = fault == ''
      if (.not. ok) call complain(program, fault)
      if (command%as == 0) command%as = command%only
   end subroutine complete_command

end module fit_command
