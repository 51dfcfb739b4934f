!> The entries of case control that ask how the structure oscillates at the end of a stage: MODES and what goes with it, FREQUENCY
!! and what goes with that.
module vibration_entries
   use case_entries, only: choose, entry_type, read_number, set_reference, value_error
   use deck_errors, only: deck_error_list
   use field_rules, only: largest_size, parse_real, smallest_size
   use kinds, only: wp
   use node_limits, only: limit_type, read_limit
   use text_tools, only: upper
   implicit none
   private

   public :: is_vibration_key, read_vibration_entry, check_vibration

   character(9), parameter :: keys(*) = [character(9) :: 'MODES', 'STIFFNESS', 'AMPLITUDE', 'FREQUENCY', 'DLOAD', 'SDAMPING', &
                                         'RESPONSE']
   integer, parameter :: modes = 1, stiffness = 2, amplitude = 3, frequency = 4, dload = 5, sdamping = 6, response = 7 ! of KEYS

   !> What one stage asks.
   type, public :: vibration_entries_type
      integer  :: line(size(keys)) = 0        !! on which each of the keys stands, 0: not given
      type(set_reference) :: modes            !! EIGRL
      logical  :: free = .false.              !! MODES(FREE)
      logical  :: on_loading = .false.        !! STIFFNESS = LOAD
      real(wp) :: amplitude = 0.0_wp          !! [length], 0: not given
      type(set_reference) :: frequency        !! FREQ1, FREQ4
      type(set_reference) :: load             !! set of the load that oscillates
      type(set_reference) :: damping          !! TABDMP1
      type(limit_type), allocatable :: response(:) !! nodes whose response is asked; not allocated: none
   end type vibration_entries_type

contains

   !> Whether KEY is read here.
   pure logical function is_vibration_key(key)
      character(*), intent(in) :: key

      is_vibration_key = any(keys == key)
   end function is_vibration_key

   !> One entry into those of its stage.
   subroutine read_vibration_entry(entry, asked, errors)
      type(entry_type), intent(in)                :: entry
      type(vibration_entries_type), intent(inout) :: asked
      type(deck_error_list), intent(inout)        :: errors
      integer :: choice, key
      logical :: ok

      key = findloc(keys == entry%key, .true., dim=1)
      asked%line(key) = entry%line
      select case (key)
      case (modes)
         call read_number(entry, asked%modes, errors)
         asked%free = entry%describers == 'FREE'
         if (entry%describers /= '' .and. .not. asked%free) call errors%add(entry%line, 'MODES('//entry%describers// &
            '): expected MODES = set, or MODES(FREE) = set, the supports let go')
      case (stiffness)
         choice = 1
         call choose(entry, '|UNLOAD|LOAD|', choice, errors)
         asked%on_loading = choice == 2
      case (amplitude)
         call parse_real(upper(entry%value), asked%amplitude, ok)
         if (ok) ok = asked%amplitude >= smallest_size .and. asked%amplitude <= largest_size
         if (ok) return
         asked%amplitude = 1.0_wp ! that nothing more is said of it
         call value_error(entry, 'a real number above 0, the largest displacement of the oscillation', errors)
      case (frequency)
         call read_number(entry, asked%frequency, errors)
      case (dload)
         call read_number(entry, asked%load, errors)
      case (sdamping)
         call read_number(entry, asked%damping, errors)
      case (response)
         call read_response(entry, asked, errors)
      end select
   end subroutine read_vibration_entry

   !> RESPONSE = SET 5, PMARK 20: words between commas.
   subroutine read_response(entry, asked, errors)
      type(entry_type), intent(in)                :: entry
      type(vibration_entries_type), intent(inout) :: asked
      type(deck_error_list), intent(inout)        :: errors
      character(:), allocatable :: rest
      integer :: comma
      logical :: ok

      if (allocated(asked%response)) deallocate (asked%response)
      rest = upper(entry%value)
      ok = rest /= ''
      do while (ok .and. rest /= '')
         comma = index(rest//',', ',')
         call read_limit(trim(adjustl(rest(:comma - 1))), entry%line, asked%response, ok)
         rest = rest(min(comma + 1, len(rest) + 1):)
      end do
      if (.not. ok) call value_error(entry, 'SET N or PMARK N, several with commas between them: the nodes to be written', errors)
   end subroutine read_response

   !> What goes together stands together: of the stages, whose entries above the first SUBCASE have come down into each, the entries
   !! of its own. What stands above them all has no effect in a stage without MODES, or without FREQUENCY, but one must have it.
   subroutine check_vibration(asked, line, errors)
      type(vibration_entries_type), intent(in) :: asked(:) !! of each stage
      integer, intent(in)                      :: line(:)  !! of its SUBCASE, 0: there is none
      type(deck_error_list), intent(inout)     :: errors
      integer :: key, need, s, said

      said = 0
      do s = 1, size(asked)
         do key = stiffness, response
            need = merge(modes, frequency, key <= frequency)
            associate (at => asked(s)%line(key), has_it => asked%line(need) > 0)
               if (at == 0 .or. has_it(s)) cycle
               if (at < line(s) .and. (s > 1 .or. any(has_it))) cycle ! said of the first stage, or has an effect elsewhere
               call errors%add(at, trim(keys(key))//': has no effect without '//trim(keys(need))//', which is not given')
            end associate
         end do
         call check_response(asked(s), said, errors)
      end do
   end subroutine check_vibration

   !> FREQUENCY, where it has an effect, needs a load and nodes; damping may be that of materials, of which nothing is known here.
   subroutine check_response(asked, said, errors)
      type(vibration_entries_type), intent(in) :: asked !! of one stage
      integer, intent(inout)                   :: said  !! line of the FREQUENCY of which it was said last
      type(deck_error_list), intent(inout)     :: errors
      character(:), allocatable :: lacking

      if (asked%line(frequency) == 0 .or. asked%line(modes) == 0) return
      lacking = ''
      if (asked%line(dload) == 0) lacking = ', DLOAD (the set of the load that oscillates)'
      if (asked%line(response) == 0) lacking = lacking//', RESPONSE (the nodes to be written)'
      if (lacking == '' .or. asked%line(frequency) == said) return
      said = asked%line(frequency)
      call errors%add(said, 'FREQUENCY: expected beside it '//lacking(3:))
   end subroutine check_response

end module vibration_entries
