!> One line of case control: its key, its value, and what a value may be.
module case_entries
   use deck_errors, only: deck_error_list
   use field_rules, only: parse_integer, list_of
   use text_tools, only: upper
   implicit none
   private

   public :: cut_entry, check_repeated, choose, read_number, value_error

   !> Keys that hold for all stages, and those of a stage.
   character(8), parameter, public :: global_keys(13) = [character(8) :: 'SOL', 'TITLE', 'UNITS', 'METHOD', 'TOL', 'PRESSURE', &
      'CARRY', 'AVERAGE', 'SOLVER', 'ECHO', 'RESTART', 'MASS', 'MODEL']
   character(11), parameter, public :: stage_keys(16) = [character(11) :: 'SPC', 'MPC', 'LABEL', 'LOAD', 'INCR', 'OUTPUT', &
      'TEMPERATURE', 'WATCH', 'MODES', 'STIFFNESS', 'AMPLITUDE', 'BACKBONE', 'FREQUENCY', 'DLOAD', 'SDAMPING', 'RESPONSE']
   character(11), parameter :: short_keys(3) = [character(11) :: 'TEMPERATURE', 'FREQUENCY', 'SDAMPING'] ! four letters will do

   !> A key with a number, and the line it stands on (0: not given).
   type, public :: set_reference
      integer :: id = 0, line = 0
   end type set_reference

   !> The line as it is being read, cut into key and value.
   type, public :: entry_type
      integer :: line = 0
      character(:), allocatable :: key, value
      character(:), allocatable :: describers !! what stands in parentheses behind the key, empty without them
      integer :: first = 0, last = 0  !! columns of the value
   end type entry_type

contains

   !> 'UNITS = MM, KGF' into key and value; a blank serves for the equals sign. 'STRESS(PLOT) = ALL' has a describer too.
   subroutine cut_entry(line, at, entry)
      character(*), intent(in)      :: line
      integer, intent(in)           :: at
      type(entry_type), intent(out) :: entry
      integer :: first, last, closing, k

      entry%line = at
      entry%describers = ''
      first = verify(line, ' ')
      last = scan(line(first:), ' =,(')
      last = merge(len(line), first + last - 2, last == 0)
      entry%key = upper(line(first:last))
      do k = 1, size(short_keys)
         if (len(entry%key) >= 4 .and. index(short_keys(k), entry%key) == 1) entry%key = trim(short_keys(k))
      end do
      first = last + max(1, verify(line(last + 1:), ' '))
      if (line(first:min(first, len(line))) == '(') then
         closing = index(line(first:), ')')
         last = merge(len(line), first + closing - 1, closing == 0)
         entry%describers = upper(line(first + 1:last - merge(0, 1, closing == 0)))
      end if
      entry%first = last + 1
      first = verify(line(last + 1:), ' ')
      if (first > 0) then
         first = last + first
         if (line(first:first) == '=') then
            entry%first = first
            first = first + max(1, verify(line(first + 1:), ' '))
         end if
         entry%first = min(first, len(line))
         entry%value = line(min(first, len(line) + 1):)
      else
         entry%value = ''
      end if
      if (entry%value == '=') entry%value = ''
      entry%last = len(line)
      entry%first = min(entry%first, entry%last)
   end subroutine cut_entry

   !> No key twice in the same place (above the stages, or in the same stage).
   subroutine check_repeated(entry, keys_seen, errors)
      type(entry_type), intent(in)             :: entry
      character(:), allocatable, intent(inout) :: keys_seen
      type(deck_error_list), intent(inout)     :: errors

      if (entry%key == 'SUBCASE') then
         keys_seen = '|'
      else if (index(keys_seen, '|'//entry%key//'('//entry%describers//')|') > 0) then
         call errors%add(entry%line, entry%key//': given twice in the same place')
      else
         keys_seen = keys_seen//entry%key//'('//entry%describers//')|'
      end if
   end subroutine check_repeated

   !> The value must be one of WORDS, '|A|B|': CHOICE is which, and stays where it is none.
   subroutine choose(entry, words, choice, errors)
      type(entry_type), intent(in)         :: entry
      character(*), intent(in)             :: words
      integer, intent(inout)               :: choice
      type(deck_error_list), intent(inout) :: errors
      integer :: at, i

      at = index(words, '|'//upper(entry%value)//'|')
      if (at == 0 .or. entry%value == '' .or. index(entry%value, '|') > 0) then
         call value_error(entry, list_of(words, ' or '), errors)
      else
         choice = count([(words(i:i) == '|', i = 1, at)])
      end if
   end subroutine choose

   !> The value of ENTRY is not what was EXPECTED.
   subroutine value_error(entry, expected, errors)
      type(entry_type), intent(in)         :: entry
      character(*), intent(in)             :: expected
      type(deck_error_list), intent(inout) :: errors

      if (entry%value == '') then
         call errors%add(entry%line, entry%key//': no value, expected '//expected)
      else
         call errors%add(entry%line, entry%key//': '''//entry%value(:min(60, len(entry%value)))//''', expected '//expected, &
                         entry%first, entry%last)
      end if
   end subroutine value_error

   !> The value of ENTRY as the number of a set or a stage, 1 and up.
   subroutine read_number(entry, reference, errors)
      type(entry_type), intent(in)         :: entry
      type(set_reference), intent(out)     :: reference
      type(deck_error_list), intent(inout) :: errors
      logical :: ok

      call parse_integer(entry%value, reference%id, ok)
      if (.not. ok .or. reference%id < 1) then
         call value_error(entry, 'an integer of 1 or more', errors)
         reference%id = 0
      else
         reference%line = entry%line
      end if
   end subroutine read_number

end module case_entries
