!> The entries of case control that belong to one stage: what loads it, what is printed of it.
module stage_entries
   use case_entries, only: choose, entry_type, read_number, set_reference, value_error
   use deck_errors, only: deck_error_list
   use node_limits, only: limit_type, read_limit
   use text_tools, only: upper
   use vibration_entries, only: is_vibration_key, read_vibration_entry, vibration_entries_type
   implicit none
   private

   public :: read_stage_entry

   integer, parameter, public :: output_none = 0, output_last = 1, output_joint = 2, output_all = 3 !! OUTPUT =

   !> One SUBCASE: a stage of the load history.
   type, public :: stage_type
      integer :: id = 0, line = 0
      character(:), allocatable :: label
      type(set_reference) :: load     !! total load at the end of the stage; none: no load
      type(set_reference) :: increments
      type(set_reference) :: supports
      type(set_reference) :: temperature !! at the end of the stage; none: all is at its TREF
      type(set_reference) :: equations !! between components, MPC
      integer :: output = output_last
      logical :: plot   = .false.
      logical :: vtu    = .false.
      logical :: steps  = .false.   !! files for ParaView after every increment
      logical :: stress = .false.   !! principal stresses and von Mises in the listing
      logical :: state  = .false.   !! what the interface elements remember
      logical :: condensed = .false. !! [k_b] condensed on the interface
      logical :: along_cd = .false. !! vectors at nodes along their systems CD
      type(limit_type), allocatable :: only(:) !! not allocated: the tables have all nodes and elements
      type(vibration_entries_type) :: vibration !! MODES and what goes with it
   end type stage_type

contains

   !> One of LABEL, LOAD, INCR, SPC, TEMPERATURE, MPC, OUTPUT and the keys of vibration of STAGE.
   subroutine read_stage_entry(entry, stage, errors)
      type(entry_type), intent(in)         :: entry
      type(stage_type), intent(inout)      :: stage
      type(deck_error_list), intent(inout) :: errors

      if (is_vibration_key(entry%key)) call read_vibration_entry(entry, stage%vibration, errors)
      select case (entry%key)
      case ('LABEL')
         stage%label = entry%value
      case ('LOAD')
         call read_number(entry, stage%load, errors)
      case ('INCR')
         call read_number(entry, stage%increments, errors)
      case ('SPC')
         call read_number(entry, stage%supports, errors)
      case ('MPC')
         call read_number(entry, stage%equations, errors)
      case ('OUTPUT')
         call read_output(entry, stage, errors)
      case ('TEMPERATURE')
         call read_number(entry, stage%temperature, errors)
         if (entry%describers /= 'LOAD') call errors%add(entry%line, 'TEMPERATURE: expected TEMPERATURE(LOAD) = set, the '// &
            'temperatures at the end of the stage; those without thermal strain are TREF on MAT1')
      end select
   end subroutine read_stage_entry

   !> OUTPUT = LAST, PLOT: words between commas.
   subroutine read_output(entry, stage, errors)
      type(entry_type), intent(in)         :: entry
      type(stage_type), intent(inout)      :: stage
      type(deck_error_list), intent(inout) :: errors
      character(*), parameter :: beside = 'PLOT, STRESS, VTU, STEPS, STATE, CONDENSED, CD, SET N, PMARK N' ! not in place of a level
      character(:), allocatable :: rest, word
      integer :: comma, levels
      logical :: ok, twice

      stage%output = output_last
      stage%plot = .false.
      stage%vtu = .false.
      stage%steps = .false.
      if (allocated(stage%only)) deallocate (stage%only)
      stage%stress = .false.
      stage%state = .false.
      stage%condensed = .false.
      stage%along_cd = .false.
      levels = 0
      twice = .false.
      word = ''
      rest = upper(entry%value)
      if (rest == '') call value_error(entry, 'ALL or JOINT or LAST or NONE or '//beside, errors)
      do while (rest /= '')
         comma = index(rest//',', ',')
         levels = levels + 1
         word = trim(adjustl(rest(:comma - 1)))
         select case (word)
         case ('ALL');    stage%output = output_all
         case ('JOINT');  stage%output = output_joint
         case ('LAST');   stage%output = output_last
         case ('NONE');   stage%output = output_none
         case ('PLOT');   call switch_on(stage%plot)
         case ('STRESS'); call switch_on(stage%stress)
         case ('VTU');    call switch_on(stage%vtu)
         case ('STEPS');  call switch_on(stage%steps)
         case ('STATE');  call switch_on(stage%state)
         case ('CONDENSED'); call switch_on(stage%condensed)
         case ('CD');     call switch_on(stage%along_cd)
         case default
            call read_limit(word, entry%line, stage%only, ok)
            levels = levels - 1
            if (.not. ok) then
               call value_error(entry, 'ALL, JOINT, LAST or NONE, and with a comma '//beside, errors)
               return
            end if
         end select
         rest = rest(min(comma + 1, len(rest) + 1):)
      end do
      if (levels > 1 .or. twice) call value_error(entry, 'one of ALL, JOINT, LAST, NONE, and with commas '//beside, errors)

   contains

      !> A word that stands beside a level, not in place of one.
      subroutine switch_on(switch)
         logical, intent(inout) :: switch

         twice = twice .or. switch
         switch = .true.
         levels = levels - 1
      end subroutine switch_on

   end subroutine read_output

end module stage_entries
