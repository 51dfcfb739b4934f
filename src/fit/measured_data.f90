!> Reads what was measured on a structure: the parameters that are sought, and rows of a value with its standard deviation. Has the
!! unknowns of the search in place of the parameters, and the differences of the rows.
!!
!!    parameter,   C1, 8.0E-3, 1.0E-3, 5.0E-2            name, start, and bounds; LINEAR: not in its logarithm
!!    frequency,   112.4, 1%, stage=2, mode=1            value, deviation (or a share of the value), and the place
module measured_data
   use data_columns, only: data_part, entry_type, read_number, split_entries
   use deck_errors, only: deck_error_list
   use deck_parameters, only: is_parameter_name
   use deck_text, only: deck_text_type, read_deck_text
   use field_rules, only: parse_integer
   use kinds, only: wp
   use text_tools, only: one_of, upper
   implicit none
   private

   public :: read_measured, differences, inner_value, outer_value, unknown_of, y_of

   integer, parameter, public :: a_frequency = 1, a_loss = 2, a_displacement = 3, a_stiffness = 4, a_bolt = 5, an_amplitude = 6, &
                                 a_phase = 7 !! kinds of rows
   character(12), parameter :: kinds(7) = [character(12) :: 'FREQUENCY', 'LOSS', 'DISPLACEMENT', 'STIFFNESS', 'BOLT', 'AMPLITUDE', &
                                           'PHASE']
   ! the keys of a row, and by their letters which ones each kind needs and which ones it may have
   character(9), parameter :: keys(8) = [character(9) :: 'STAGE', 'MODE', 'NODE', 'DIRECTION', 'BOLT', 'AMPLITUDE', 'FREQUENCY', &
                                         'SHAPE']
   character(*), parameter :: letters = 'SMNDBAFH'
   character(4), parameter :: needs(7) = ['S   ', 'S   ', 'SND ', 'SN  ', 'SB  ', 'SNDF', 'SNDF']
   character(4), parameter :: may_have(7) = ['MHA ', 'MHA ', '    ', 'D   ', '    ', '    ', '    ']
   character(4), parameter :: directions(0:3) = ['LINE', 'X   ', 'Y   ', 'Z   ']

   !> A parameter ${NAME} of the deck. In its logarithm unless IS_LINEAR.
   type, public :: sought_parameter
      character(:), allocatable :: name
      real(wp) :: start = 0.0_wp, low = 0.0_wp, high = 0.0_wp
      logical  :: is_bounded = .false., is_linear = .false.
      integer  :: line = 0                         !! in the text of the file
   end type sought_parameter

   type, public :: measured_row
      integer  :: kind = 0
      integer  :: line = 0
      real(wp) :: value = 0.0_wp, deviation = 0.0_wp
      integer  :: stage = 0                        !! number of its SUBCASE
      integer  :: mode = 0                         !! number in the table of frequencies, 0: by its shape
      integer  :: nodes(2) = 0                     !! numbers; the second one against the first, 0: one node
      integer  :: direction = -1                   !! 1 to 3; 0 along the line of two nodes
      integer  :: bolt = 0
      real(wp) :: amplitude = 0.0_wp, frequency = 0.0_wp !! 0: none
      integer, allocatable  :: at(:, :)            !! (2, points) node and direction of the shape
      real(wp), allocatable :: shape(:)            !! (points)
      character(:), allocatable :: words           !! kind and place
   end type measured_row

   type, public :: measured_type
      type(deck_text_type) :: text
      type(sought_parameter), allocatable :: parameters(:)
      type(measured_row), allocatable     :: rows(:)
   end type measured_type

contains

   !> Read the file PATH, which messages call NAME. READABLE is false where it cannot be read; all else goes to ERRORS.
   subroutine read_measured(path, name, data, errors, readable)
      character(*), intent(in)             :: path, name
      type(measured_type), intent(out)     :: data
      type(deck_error_list), intent(inout) :: errors
      logical, intent(out)                 :: readable
      type(entry_type), allocatable :: entries(:)
      character(:), allocatable :: line
      integer :: i, k, n_parameters, n_rows

      call read_deck_text(path, data%text, errors, readable, has_fields=.false.)
      if (.not. readable) return
      data%text%files(1)%path = name
      allocate (data%parameters(data%text%n), data%rows(data%text%n))
      n_parameters = 0
      n_rows = 0
      do i = 1, merge(data%text%n, 0, data%text%is_text)
         line = data_part(data%text%line(i))
         do ! 1 % is 1%, in the same columns
            k = index(line, ' %')
            if (k == 0) exit
            line(k:k + 1) = '% '
         end do
         call split_entries(line, entries, .false.)
         if (size(entries) == 0) cycle
         select case (upper(line(entries(1)%first:entries(1)%last)))
         case ('WHAT') ! the headings of a table
            cycle
         case ('PARAMETER')
            n_parameters = n_parameters + 1
            call read_parameter(line, i, entries, data%parameters(:n_parameters), errors)
         case default
            n_rows = n_rows + 1
            call read_row(line, i, entries, data%rows(n_rows), errors)
         end select
      end do
      call cut(data, n_parameters, n_rows)
      if (errors%any()) return
      if (n_parameters == 0) call errors%add(0, 'no parameter: expected rows as parameter,C1,8.0E-3,1.0E-3,5.0E-2')
      if (n_rows == 0) call errors%add(0, 'no measured value: expected rows as frequency,112.4,1%,stage=1,mode=1')
   end subroutine read_measured

   !> Keep the first parameters and rows of DATA, those that have been read.
   subroutine cut(data, n_parameters, n_rows)
      type(measured_type), intent(inout) :: data
      integer, intent(in)                :: n_parameters, n_rows
      type(sought_parameter), allocatable :: parameters(:)
      type(measured_row), allocatable     :: rows(:)

      allocate (parameters(n_parameters), rows(n_rows)) ! (an array constructor would lose texts in gfortran 12)
      parameters = data%parameters(:n_parameters)
      rows = data%rows(:n_rows)
      call move_alloc(parameters, data%parameters)
      call move_alloc(rows, data%rows)
   end subroutine cut

   !> Read a parameter, the last of LIST, from the ENTRIES of LINE number AT: parameter, NAME, START, LOW, HIGH, LINEAR.
   subroutine read_parameter(line, at, entries, list, errors)
      character(*), intent(in)              :: line
      integer, intent(in)                   :: at
      type(entry_type), intent(in)          :: entries(:)
      type(sought_parameter), intent(inout) :: list(:)
      type(deck_error_list), intent(inout)  :: errors
      real(wp) :: values(3)
      integer  :: i, k, n
      logical  :: ok

      associate (new => list(size(list)))
         n = size(entries)
         new%line = at
         new%is_linear = upper(line(entries(n)%first:entries(n)%last)) == 'LINEAR'
         if (new%is_linear) n = n - 1
         new%name = ''
         if (n == 3 .or. n == 5) new%name = line(entries(2)%first:entries(2)%last)
         if (.not. is_parameter_name(new%name)) call errors%add(at, 'expected parameter,NAME,START or '// &
            'parameter,NAME,START,LOW,HIGH, C1 for ${C1} of the deck; LINEAR behind them for values of either sign')
         if (.not. is_parameter_name(new%name)) return
         do i = 1, size(list) - 1
            if (list(i)%name == new%name) call errors%add(at, 'parameter '//new%name//' is given twice')
         end do
         values = 0.0_wp
         do k = 3, n
            associate (entry => entries(k))
               call read_number(line(entry%first:entry%last), values(k - 2), ok)
               if (.not. ok) call errors%add(at, ''''//line(entry%first:entry%last)//''' is not a number', entry%first, entry%last)
               if (.not. ok) return
            end associate
         end do
         new%start = values(1)
         new%is_bounded = n == 5
         if (new%is_bounded) new%low = values(2)
         if (new%is_bounded) new%high = values(3)
         if (.not. new%is_linear .and. any(values(:n - 2) <= 0.0_wp)) then
            call errors%add(at, 'expected start and bounds above 0, or LINEAR behind them')
         else if (new%is_bounded .and. .not. (new%low < new%start .and. new%start < new%high)) then
            call errors%add(at, 'expected a start between its bounds, LOW below HIGH')
         end if
      end associate
   end subroutine read_parameter

   !> Read ROW from the ENTRIES of LINE number AT: kind, value, deviation, and KEY=ENTRY in any order.
   subroutine read_row(line, at, entries, row, errors)
      character(*), intent(in)             :: line
      integer, intent(in)                  :: at
      type(entry_type), intent(in)         :: entries(:)
      type(measured_row), intent(inout)    :: row
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: given
      integer :: k, key, n
      logical :: ok

      row%line = at
      row%words = upper(line(entries(1)%first:entries(1)%last))
      row%kind = findloc(kinds, row%words, dim=1)
      if (row%kind == 0) call errors%add(at, ''''//row%words//''': expected parameter, frequency, loss, displacement, '// &
                                         'stiffness, bolt, amplitude or phase', entries(1)%first, entries(1)%last)
      if (row%kind == 0) return
      allocate (row%at(2, 0), row%shape(0))
      do k = 2, 3
         ok = size(entries) >= k
         if (.not. ok) exit
         associate (entry => entries(k))
            n = entry%last
            if (k == 3 .and. line(n:n) == '%') n = n - 1
            call read_number(line(entry%first:n), row%deviation, ok)
            if (k == 2) row%value = row%deviation
            if (n < entry%last) row%deviation = 0.01_wp*row%deviation*abs(row%value)
            if (k == 3) ok = ok .and. row%deviation > 0.0_wp
            if (.not. ok) call errors%add(at, ''''//line(entry%first:entry%last)//''': expected '// &
               one_of(k == 2, 'a number', 'a standard deviation above 0, as 0.5 or 1%'), entry%first, entry%last)
         end associate
      end do
      if (size(entries) < 3) call errors%add(at, 'expected a value and its standard deviation, as '// &
                                              'frequency,112.4,1%,stage=1,mode=1')
      given = ''
      do k = 4, size(entries)
         associate (word => line(entries(k)%first:entries(k)%last))
            n = index(word//'=', '=')
            key = findloc(keys, upper(word(:n - 1)), dim=1)
            ok = key > 0 .and. n < len(word)
            if (ok) call take_key(word(n + 1:), letters(key:key), row, ok)
            if (ok) ok = index(given, letters(key:key)) == 0 .or. letters(key:key) == 'H'
            if (.not. ok) then
               call errors%add(at, ''''//word//''': expected one of stage=2, mode=1, node=51, node=51-62, direction=y, bolt=1, '// &
                  'amplitude=0.01, frequency=115, shape=51:y:1.0, each once but shape, without blanks', entries(k)%first, &
                  entries(k)%last)
               return ! what lacks is no error then
            end if
            if (index(needs(row%kind)//may_have(row%kind), letters(key:key)) == 0) &
               call errors%add(at, trim(keys(key))//'= has no meaning in this row', entries(k)%first, entries(k)%last)
            if (index(given, 'H') == 0 .or. letters(key:key) /= 'H') row%words = row%words//' '//upper(word)
            given = given//letters(key:key)
         end associate
      end do
      do k = 1, len_trim(needs(row%kind))
         key = index(letters, needs(row%kind)(k:k))
         if (index(given, letters(key:key)) == 0) call errors%add(at, 'expected '//trim(keys(key))//'=')
      end do
      if (any(row%kind == [a_frequency, a_loss]) .and. (scan(given, 'MH') == 0 .or. (index(given, 'A') > 0 .and. row%mode == 0))) &
         call errors%add(at, 'expected MODE=, or SHAPE= without AMPLITUDE=')
      if (row%nodes(2) > 0 .and. (row%frequency > 0.0_wp .or. row%direction < 0)) &
         call errors%add(at, 'two nodes are those of a displacement or stiffness, with DIRECTION=')
      if (row%nodes(2) == 0 .and. row%direction == 0) call errors%add(at, 'direction=line is that of two nodes, node=51-62')
   end subroutine read_row

   !> Take WORD, what follows = behind the key of this LETTER, into ROW.
   subroutine take_key(word, letter, row, ok)
      character(*), intent(in)          :: word, letter
      type(measured_row), intent(inout) :: row
      logical, intent(out)              :: ok
      integer  :: first, last, node
      real(wp) :: value

      select case (letter)
      case ('S')
         call parse_integer(word, row%stage, ok)
      case ('M')
         call parse_integer(word, row%mode, ok)
         ok = ok .and. row%mode > 0
      case ('B')
         call parse_integer(word, row%bolt, ok)
      case ('N')
         first = index(word//'-', '-')
         call parse_integer(word(:first - 1), row%nodes(1), ok)
         if (ok .and. first < len(word)) call parse_integer(word(first + 1:), row%nodes(2), ok)
         ok = ok .and. all(row%nodes >= [1, 0])
      case ('D')
         row%direction = findloc(directions, upper(word), dim=1) - 1
         ok = row%direction >= 0
      case ('A', 'F')
         call read_number(word, value, ok)
         ok = ok .and. value > 0.0_wp
         if (letter == 'A') row%amplitude = value
         if (letter == 'F') row%frequency = value
      case default
         first = index(word, ':')
         last = index(word, ':', back=.true.)
         ok = first > 1 .and. last == first + 2
         if (ok) call parse_integer(word(:first - 1), node, ok)
         if (ok) call read_number(word(last + 1:), value, ok)
         if (.not. ok) return
         row%shape = [row%shape, value]
         row%at = reshape([row%at, node, findloc(directions, upper(word(first + 1:first + 1)), dim=1) - 1], [2, size(row%shape)])
         ok = row%at(2, size(row%shape)) > 0
      end select
   end subroutine take_key

   !> The unknown y of PARAMETER at VALUE, and the value at the unknown Y.
   elemental real(wp) function inner_value(parameter, value) result(y)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: value

      if (parameter%is_linear) y = value/scale_of(parameter)
      if (.not. parameter%is_linear) y = log(value)
   end function inner_value

   elemental real(wp) function outer_value(parameter, y) result(value)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: y

      if (parameter%is_linear) value = y*scale_of(parameter)
      if (.not. parameter%is_linear) value = exp(y)
   end function outer_value

   !> The scale of a linear parameter: between its bounds, or its start.
   elemental real(wp) function scale_of(parameter) result(scale)
      type(sought_parameter), intent(in) :: parameter

      scale = abs(parameter%start)
      if (parameter%is_bounded) scale = parameter%high - parameter%low
      if (.not. scale > 0.0_wp) scale = 1.0_wp
   end function scale_of

   !> z of PARAMETER at the unknown Y, and y at Z.
   elemental real(wp) function unknown_of(parameter, y) result(z)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: y

      z = y
      if (.not. parameter%is_bounded) return
      associate (b => inner_value(parameter, parameter%low), c => inner_value(parameter, parameter%high))
         z = asin(max(-1.0_wp, min(1.0_wp, (2.0_wp*y - b - c)/(c - b))))
      end associate
   end function unknown_of

   elemental real(wp) function y_of(parameter, z) result(y)
      type(sought_parameter), intent(in) :: parameter
      real(wp), intent(in)               :: z

      y = z
      if (.not. parameter%is_bounded) return
      associate (b => inner_value(parameter, parameter%low), c => inner_value(parameter, parameter%high))
         y = 0.5_wp*(b + c) + 0.5_wp*(c - b)*sin(z)
      end associate
   end function y_of

   !> The differences of the VALUE of each row from that of DATA, over its deviation.
   pure function differences(data, value) result(d)
      type(measured_type), intent(in) :: data
      real(wp), intent(in)            :: value(:)
      real(wp) :: d(size(data%rows))

      d = value - data%rows%value
      where (data%rows%kind == a_phase) d = d - 360.0_wp*anint(d/360.0_wp)
      d = d/data%rows%deviation
   end function differences

end module measured_data
