!> The command line of jointfit: options and data files.
module fit_command
   use command_arguments, only: argument_text, complain, input_argument, input_of, is_option, say, version
   use deck_numbers, only: parse_integer
   use fit_data, only: branch_number, read_number
   use kinds, only: wp
   use text_tools, only: upper
   implicit none
   private

   public :: read_fit_command

   character(*), parameter :: program = 'jointfit'

   type, public :: fit_command_type
      integer  :: id          = 1         !! --id: of the first file's card
      logical  :: joint_fit   = .false.   !! --joint-fit: the one-step coefficients go on the card
      logical  :: small       = .false.   !! --small: fields of eight columns
      integer  :: only        = 0         !! --branch: the branch of the data to use, 0: all
      integer  :: as          = 0         !! --as: the branch of the card that it becomes
      real(wp) :: p_tolerance = 1.0e-3_wp !! --p-tolerance: pressures that count as one
      real(wp) :: d_max       = 0.0_wp    !! --dmax: DMAX of the card [length], 0: the largest d of the data
      type(input_argument), allocatable :: files(:)
   end type fit_command_type

contains

   !> Read the command. FINISHED is true where nothing is left to do: after --help and --version (STATUS 0), and after
   !! a wrong command (STATUS 1, said on the standard error).
   subroutine read_fit_command(command, finished, status)
      type(fit_command_type), intent(out) :: command
      logical, intent(out)                :: finished
      integer, intent(out)                :: status
      character(:), allocatable :: argument
      integer :: i
      logical :: ok, options

      allocate (command%files(0))
      finished = .true.
      status = 1
      options = .true.
      i = 0
      do while (i < command_argument_count())
         i = i + 1
         argument = argument_text(i)
         if (.not. is_option(argument, options)) then
            command%files = [command%files, input_of(argument)]
            cycle
         end if
         select case (argument)
         case ('--')
            options = .false.
         case ('--help', '-h')
            call print_help(status)
            return
         case ('--version')
            call say(program//' '//version, status)
            return
         case ('--joint-fit')
            command%joint_fit = .true.
         case ('--small', '--large')
            command%small = argument == '--small'
         case ('--id', '--branch', '--as', '--p-tolerance', '--dmax')
            i = i + 1
            call read_value(argument, argument_text(i), command, ok)
            if (.not. ok) return
         case default
            call complain(program, 'there is no option '//argument)
            return
         end select
      end do
      if (size(command%files) == 0) then
         call complain(program, 'no data file given')
      else if (command%as > 0 .and. command%only == 0) then
         call complain(program, '--as needs --branch: which branch of the data is meant?')
      else
         if (command%as == 0) command%as = command%only
         finished = .false.
         status = 0
      end if
   end subroutine read_fit_command


   !> The VALUE behind an OPTION; empty where the command ends.
   subroutine read_value(option, value, command, ok)
      character(*), intent(in)              :: option, value
      type(fit_command_type), intent(inout) :: command
      logical, intent(out)                  :: ok
      character(:), allocatable :: expected

      select case (option)
      case ('--id')
         call parse_integer(value, command%id, ok)
         ok = ok .and. command%id > 0
         expected = 'a number of 1 or more'
      case ('--branch')
         command%only = branch_number(upper(value))
         ok = command%only > 0
         expected = 'LOAD, UNLOAD or RELOAD'
      case ('--as')
         command%as = branch_number(upper(value))
         ok = command%as > 0
         expected = 'LOAD, UNLOAD or RELOAD'
      case ('--p-tolerance')
         call read_number(value, command%p_tolerance, ok)
         ok = ok .and. command%p_tolerance >= 0.0_wp .and. command%p_tolerance < 1.0_wp
         expected = 'a number from 0 to below 1, as 0.01'
      case default                                   ! --dmax
         call read_number(value, command%d_max, ok)
         ok = ok .and. command%d_max > 0.0_wp
         expected = 'a number above 0'
      end select
      if (.not. ok) call complain(program, option//' '//value//': expected '//expected)
   end subroutine read_value


   subroutine print_help(status)
      integer, intent(out) :: status
      character(*), parameter :: nl = new_line('a')

      call say( &
         'usage: jointfit [options] DATA...'//nl// &
         ''//nl// &
         'Fits the laws of a joint to test data and writes the cards for a deck of jointfem on the standard output,'//nl// &
         'with the residuals as comments. Each file is one surface; `-` is the standard input. A line with the names'//nl// &
         'of the columns, in any order, says what a file holds:'//nl// &
         ''//nl// &
         '   d tau p branch      points of shear tests; branch is LOAD, UNLOAD or RELOAD: a JSHEAR card'//nl// &
         '   c1 c2 c3 p branch   cubics tau = c1 d + c2 d^2 + c3 d^3 published for several p: a JSHEAR card'//nl// &
         '   lambda p            points of normal tests: a JNORM card'//nl// &
         ''//nl// &
         'Entries stand between blanks or commas, # and $ begin a comment, `UNITS = ...` is copied to the comments.'//nl// &
         'The cards are in the units of the data.'//nl// &
         ''//nl// &
         '   --id N            id of the first card (default 1), the cards of more files count up'//nl// &
         '   --joint-fit       shear: the coefficients fitted to all points of a branch at once, instead of the'//nl// &
         '                     straight lines through the coefficients of the cubics of each pressure'//nl// &
         '   --p-tolerance X   shear: pressures within this share of each other count as one (default 0.001)'//nl// &
         '   --branch BRANCH   shear: use only this branch of the data'//nl// &
         '   --as BRANCH       with --branch: as this branch of the card'//nl// &
         '   --dmax X          shear: DMAX of the card (default: the largest d of the loading data)'//nl// &
         '   --large           numbers in fields of 16 columns (default)'//nl// &
         '   --small           numbers in fields of 8 columns'//nl// &
         '   --version         print the version'//nl// &
         '   --help            print this'//nl// &
         ''//nl// &
         'exit status: 0 all cards written, 1 wrong usage or unreadable file, 2 errors in the data, 4 output that'//nl// &
         'cannot be written; of several files the highest.', status)
   end subroutine print_help

end module fit_command
