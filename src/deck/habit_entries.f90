!> Lines of case control that are none of the program's own keys, but NASTRAN's; and ECHO, which it has in more words.
module habit_entries
   use case_entries, only: choose, entry_type, value_error
   use deck_errors, only: deck_error_list
   use entry_tally, only: entry_tally_type
   use nastran_habits, only: control_habit, parameters_type, take_parameter
   use text_tools, only: upper
   implicit none
   private

   public :: read_habit, read_echo

contains

   !> What a line says that is none of the program's own keys: it has no effect, or is not known.
   subroutine read_habit(entry, parameters, idle, errors)
      type(entry_type), intent(in)           :: entry
      type(parameters_type), intent(inout)   :: parameters
      type(entry_tally_type), intent(inout)  :: idle        !! entries without effect
      type(deck_error_list), intent(inout)   :: errors
      integer :: choice

      choice = 0
      select case (entry%key)
      case ('INCLUDE', 'CEND') ! lines of an INCLUDE file follow in the deck text; CEND is the end of NASTRAN's executive control
      case ('APP', 'ANALYSIS')
         call choose(entry, '|STATICS|STATIC|DISP|DISPLACEMENT|', choice, errors)
         call idle%add(entry%key)
      case ('PARAM')
         call read_parameter(entry, parameters, idle, errors)
      case default
         if (control_habit(entry%key) /= '') then
            call idle%add(control_habit(entry%key))
         else
            call errors%add(entry%line, ''''//entry%key(:min(40, len(entry%key)))//''' is no key of case control; '// &
                            'expected TITLE, UNITS, METHOD, TOL, PRESSURE, CARRY, AVERAGE, SOLVER, MASS, RESTART, ECHO, SPC, '// &
                            'MPC, SUBCASE, LABEL, LOAD, TEMPERATURE(LOAD), INCR, OUTPUT, MODES, STIFFNESS, AMPLITUDE, '// &
                            'FREQUENCY, DLOAD, SDAMPING, RESPONSE or BEGIN BULK')
         end if
      end select
   end subroutine read_habit

   !> 'PARAM,POST,-1' in case control.
   subroutine read_parameter(entry, parameters, idle, errors)
      type(entry_type), intent(in)           :: entry
      type(parameters_type), intent(inout)   :: parameters
      type(entry_tally_type), intent(inout)  :: idle        !! entries without effect
      type(deck_error_list), intent(inout)   :: errors
      character(:), allocatable :: expected, name, value
      integer :: comma

      value = upper(adjustl(entry%value))
      if (index(value, ',') == 1) value = adjustl(value(2:))
      comma = scan(value//',', ', ')
      name = value(:comma - 1)
      value = trim(adjustl(value(min(comma + 1, len(value) + 1):)))
      call take_parameter(name, value, entry%line, parameters, idle, expected)
      if (expected /= '') then
         call errors%add(entry%line, 'PARAM '//name//': '''//value//''', expected '//expected, entry%first, entry%last)
      end if
   end subroutine read_parameter

   !> ECHO = NO or NONE, or any of the words by which NASTRAN prints the deck, in whatever order, to whatever file.
   subroutine read_echo(entry, is_on, errors)
      type(entry_type), intent(in)         :: entry
      logical, intent(out)                 :: is_on
      type(deck_error_list), intent(inout) :: errors
      character(*), parameter :: off = '|NO|NONE|', on = '|YES|BOTH|SORT|UNSORT|PUNCH|FILE|'
      character(:), allocatable :: word

      word = '|'//upper(entry%value(:scan(entry%value//',', ' ,(') - 1))//'|'
      if (word == '||' .or. index(off//on, word) == 0) call value_error(entry, 'YES or NO, or NASTRAN''s BOTH, SORT, UNSORT, '// &
                                                                        'PUNCH or NONE', errors)
      is_on = index(off, word) == 0
   end subroutine read_echo

end module habit_entries
