!> Reads the entries of case control for one stage: its loads, its output and its vibration analysis.
!! MODES and FREQUENCY, with their options, ask for the vibration about the state at the end of the stage.
module stage_entries
   use case_entries, only: choose, entry_type, limit_type, read_limit, read_number, set_reference, stage_keys, value_error
   use deck_errors, only: deck_error_list
   use field_rules, only: largest_size, parse_integer, parse_real, smallest_size
   use kinds, only: wp
   use text_tools, only: one_of, upper
   implicit none
   private

   public :: read_stage_entry, check_vibration, read_pair, complete_response, show_nodes

   integer, parameter, public :: any_modes = -1 !! number of MODES: those that a response needs, as in a direct solution

   integer, parameter, public :: output_none = 0, output_last = 1, output_joint = 2, output_all = 3 !! OUTPUT =

   integer, parameter :: modes = 1, stiffness = 2, frequency = 5, dload = 6, response = 8 ! of KEYS
   character(11), parameter :: keys(*) = stage_keys(findloc(stage_keys, 'MODES', dim=1):)

   !> The vibration entries of one stage.
   type, public :: vibration_entries_type
      integer  :: line(size(keys)) = 0        !! line of each key, 0: not given
      type(set_reference) :: modes            !! EIGRL, EIGR
      logical  :: free = .false.              !! MODES(FREE)
      logical  :: by_method = .false.         !! METHOD = set: free where nothing supports the structure
      logical  :: on_loading = .false.        !! STIFFNESS = LOAD
      real(wp) :: amplitude = 0.0_wp          !! [length], 0: not given
      type(set_reference) :: backbone         !! JAMPL
      type(set_reference) :: frequency        !! FREQ1, FREQ4
      type(set_reference) :: load             !! set of the oscillating load
      type(set_reference) :: sequence         !! LOADSET: set of LSEQ cards; none: all of them
      type(set_reference) :: damping          !! TABDMP1
      type(limit_type), allocatable :: response(:) !! nodes of the response; not allocated: the loaded ones, in NASTRAN's decks
      type(limit_type), allocatable :: shown(:)    !! nodes of DISPLACEMENT and others, which stand for RESPONSE
   end type vibration_entries_type

   !> Which modes the listing shows; none given: all of them.
   type, public :: mode_filter
      real(wp)     :: least_mass = 0.0_wp !! effective, along an axis, of the mass of the structure [per cent]
      character(6) :: kind = ''           !! BODY, SHELLS, JOINT
      integer      :: id = 0
      logical      :: is_given = .false.
   end type mode_filter

   !> OUTPUT of a stage.
   type, public :: output_request
      integer :: line = 0
      type(mode_filter) :: modes
      integer :: level = output_last
      logical :: plot = .false., vtu = .false.
      logical :: steps = .false.          !! VTU files after every increment
      logical :: stress = .false.         !! principal stresses and von Mises in the listing
      logical :: forces = .false.         !! forces and moments per length of shells
      logical :: state = .false.          !! state variables of the interface elements
      logical :: condensed = .false.      !! [k_b] condensed on the interface
      logical :: dmig = .false.           !! stiffness and mass condensed on the nodes of ASET
      logical :: along_cd = .false.       !! nodal vectors in their systems CD
   end type output_request

   !> WATCH = 9001-9002: the second node against the first.
   type, public :: pair_reference
      integer :: nodes(2) = 0, line = 0
   end type pair_reference

   !> One SUBCASE: a stage of the load history.
   type, public :: stage_type
      integer :: id = 0, line = 0
      character(:), allocatable :: label
      type(set_reference) :: load         !! total load at the end of the stage; none: no load
      type(set_reference) :: increments, supports
      type(set_reference) :: from         !! SUBCASE from whose end it starts; none: the one before
      type(set_reference) :: temperature  !! at the end of the stage; none: TREF everywhere
      type(set_reference) :: initial      !! before any load, in place of TREF
      logical :: warms_materials = .false. !! a set of temperatures holds for the materials
      type(set_reference) :: equations    !! constraint equations, MPC
      integer :: combines = 0             !! SUBCOM: line of SUBSEQ, -1: not given; 0: no SUBCOM
      real(wp), allocatable :: factors(:) !! SUBSEQ: of the SUBCASEs before it, the last of them last
      type(set_reference) :: contact, glue, bolts !! of NX: BCSET, BGSET, BOLTLD
      type(output_request) :: output
      type(limit_type), allocatable :: only(:) !! not allocated: tables of all nodes and elements
      type(limit_type), allocatable :: watch(:) !! nodes whose displacement the answer gives; not allocated: none
      type(pair_reference), allocatable :: pairs(:) !! likewise, one node against another
      type(vibration_entries_type) :: vibration !! MODES, FREQUENCY and their options
   end type stage_type

contains

   !> Store one entry of a stage in STAGE.
   subroutine read_stage_entry(entry, stage, errors)
      type(entry_type), intent(in)         :: entry
      type(stage_type), intent(inout)      :: stage
      type(deck_error_list), intent(inout) :: errors
      integer :: choice, key
      logical :: ok

      key = findloc(keys == entry%key, .true., dim=1)
      if (key > 0) stage%vibration%line(key) = entry%line
      associate (asked => stage%vibration)
         select case (entry%key)
         case ('LABEL')
            stage%label = entry%value
         case ('LOAD')
            call read_number(entry, stage%load, errors)
         case ('INCR')
            call read_number(entry, stage%increments, errors)
         case ('LOADSET')
            call read_number(entry, asked%sequence, errors)
         case ('FROM')
            call read_number(entry, stage%from, errors)
         case ('SPC')
            call read_number(entry, stage%supports, errors)
         case ('MPC')
            call read_number(entry, stage%equations, errors)
         case ('BCSET')
            call read_number(entry, stage%contact, errors)
         case ('BGSET')
            call read_number(entry, stage%glue, errors)
         case ('BOLTLD')
            call read_number(entry, stage%bolts, errors)
         case ('OUTPUT')
            call read_output(entry, stage, errors)
         case ('SUBSEQ')
            call read_factors(entry, stage, errors)
         case ('TEMPERATURE')
            call read_temperature(entry, stage, errors)
         case ('MODES')
            call read_number(entry, asked%modes, errors)
            asked%free = entry%describers == 'FREE'
            asked%by_method = entry%describers == 'METHOD'
            if (entry%describers /= '' .and. .not. (asked%free .or. asked%by_method)) call errors%add(entry%line, &
               'MODES('//entry%describers//'): expected MODES = set, or MODES(FREE) = set, modes without the supports')
         case ('STIFFNESS')
            choice = 1
            call choose(entry, '|UNLOAD|LOAD|', choice, errors)
            asked%on_loading = choice == 2
         case ('AMPLITUDE')
            call parse_real(upper(entry%value), asked%amplitude, ok)
            if (ok) ok = asked%amplitude >= smallest_size .and. asked%amplitude <= largest_size
            if (ok) return
            asked%amplitude = 1.0_wp ! a valid value prevents further messages
            call value_error(entry, 'a real number above 0, the largest displacement of the oscillation', errors)
         case ('BACKBONE')
            call read_number(entry, asked%backbone, errors)
         case ('FREQUENCY')
            call read_number(entry, asked%frequency, errors)
         case ('DLOAD')
            call read_number(entry, asked%load, errors)
         case ('SDAMPING')
            call read_number(entry, asked%damping, errors)
         case ('RESPONSE')
            call read_nodes(entry, asked%response, errors)
         case ('WATCH')
            call read_nodes(entry, stage%watch, errors, stage%pairs)
         end select
      end associate
   end subroutine read_stage_entry

   !> TEMPERATURE(LOAD) = set: at the end of the stage; of (BOTH), which may be left out, for the materials too, of (MATERIAL) for these
   !! alone; TEMPERATURE(INITIAL): the temperatures before any load.
   subroutine read_temperature(entry, stage, errors)
      type(entry_type), intent(in)         :: entry
      type(stage_type), intent(inout)      :: stage
      type(deck_error_list), intent(inout) :: errors
      type(set_reference) :: set

      call read_number(entry, set, errors)
      stage%warms_materials = stage%warms_materials .or. index(entry%describers, 'LOAD') /= 1
      select case (entry%describers)
      case ('LOAD', 'BOTH', '')
         stage%temperature = set
      case ('INIT', 'INITIAL')
         stage%initial = set
      case ('MATE', 'MATERIAL')
      case default
         call errors%add(entry%line, 'TEMPERATURE('//entry%describers//'): expected TEMPERATURE(LOAD) = set, the temperatures '// &
                         'at the end of the stage, or TEMPERATURE(INITIAL), (MATERIAL) or (BOTH)')
      end select
   end subroutine read_temperature

   !> SUBSEQ = 1.0, -0.5 of a SUBCOM.
   subroutine read_factors(entry, stage, errors)
      type(entry_type), intent(in)         :: entry
      type(stage_type), intent(inout)      :: stage
      type(deck_error_list), intent(inout) :: errors
      character(:), allocatable :: rest
      real(wp) :: factor
      integer  :: comma
      logical  :: ok

      rest = upper(entry%value)
      stage%factors = [real(wp) ::]
      ok = stage%combines /= 0
      if (.not. ok) call errors%add(entry%line, 'SUBSEQ: expected below a SUBCOM')
      do while (ok .and. rest /= '')
         comma = scan(rest//',', ', ')
         call parse_real(rest(:comma - 1), factor, ok)
         stage%factors = [stage%factors, factor]
         rest = adjustl(rest(min(comma + 1, len(rest) + 1):))
         if (index(rest, ',') == 1) rest = adjustl(rest(2:))
      end do
      if (stage%combines /= 0 .and. .not. (ok .and. size(stage%factors) > 0)) &
         call value_error(entry, 'real numbers with commas between them, a factor of each SUBCASE before', errors)
      if (stage%combines /= 0) stage%combines = entry%line
   end subroutine read_factors

   !> OUTPUT = LAST, PLOT: words with commas.
   subroutine read_output(entry, stage, errors)
      type(entry_type), intent(in)         :: entry
      type(stage_type), intent(inout)      :: stage
      type(deck_error_list), intent(inout) :: errors
      character(*), parameter :: beside = 'PLOT, STRESS, FORCES, VTU, STEPS, STATE, CONDENSED, DMIG, CD, SET N, PMARK N, '// &
                                          'of modes MASS P, and BODY N or SHELLS N or JOINT N'
      character(9), parameter :: switches(9) = [character(9) :: 'PLOT', 'STRESS', 'FORCES', 'VTU', 'STEPS', 'STATE', &
                                                'CONDENSED', 'CD', 'DMIG']
      character(5), parameter :: levels(0:3) = [character(5) :: 'NONE', 'LAST', 'JOINT', 'ALL'] ! by their numbers
      character(:), allocatable :: rest, word
      logical :: is_on(size(switches)), ok, twice
      integer :: comma, k, level, n_levels

      stage%output = output_request()
      stage%output%line = entry%line
      if (allocated(stage%only)) deallocate (stage%only)
      n_levels = 0
      word = ''
      is_on = .false.
      twice = .false.
      rest = upper(entry%value)
      if (rest == '') call value_error(entry, 'ALL or JOINT or LAST or NONE or '//beside, errors)
      do while (rest /= '')
         comma = index(rest//',', ',')
         word = trim(adjustl(rest(:comma - 1)))
         level = findloc(levels == word, .true., dim=1) - 1
         k = findloc(switches == word, .true., dim=1)
         if (level >= 0) then
            stage%output%level = level
            n_levels = n_levels + 1
         else if (k > 0) then
            twice = twice .or. is_on(k)
            is_on(k) = .true.
         else
            call read_filter(word, stage%output%modes, ok)
            if (.not. ok) call read_limit(word, entry%line, stage%only, ok)
            if (.not. ok) then
               call value_error(entry, 'ALL, JOINT, LAST or NONE, and with a comma '//beside, errors)
               return
            end if
         end if
         rest = rest(min(comma + 1, len(rest) + 1):)
      end do
      associate (output => stage%output)
         output%plot = is_on(1)
         output%stress = is_on(2)
         output%forces = is_on(3)
         output%vtu = is_on(4) .or. is_on(5)
         output%steps = is_on(5)
         output%state = is_on(6)
         output%condensed = is_on(7)
         output%along_cd = is_on(8)
         output%dmig = is_on(9)
      end associate
      if (n_levels > 1 .or. twice) call value_error(entry, 'one of ALL, JOINT, LAST, NONE, and with commas '//beside, errors)
   end subroutine read_output

   !> Put WORD, 'MASS 5.0' or 'BODY 2' in capitals, into FILTER; OK is false where WORD is neither, or says what is there.
   pure subroutine read_filter(word, filter, ok)
      character(*), intent(in)         :: word
      type(mode_filter), intent(inout) :: filter
      logical, intent(out)             :: ok
      real(wp) :: mass
      integer  :: blank, id

      blank = index(word//' ', ' ')
      select case (word(:blank - 1))
      case ('MASS')
         call parse_real(trim(adjustl(word(blank:))), mass, ok)
         ok = ok .and. mass > 0.0_wp .and. mass <= 100.0_wp .and. filter%least_mass <= 0.0_wp
         if (ok) filter%least_mass = mass
      case ('BODY', 'SHELLS', 'JOINT')
         call parse_integer(trim(adjustl(word(blank:))), id, ok)
         ok = ok .and. id > 0 .and. filter%kind == ''
         filter%kind = word(:blank - 1)
         filter%id = id
      case default
         ok = .false.
      end select
      filter%is_given = filter%is_given .or. ok
   end subroutine read_filter

   !> RESPONSE = SET 5, PMARK 20, and WATCH likewise, also with PAIRS 9001-9002: words with commas.
   subroutine read_nodes(entry, nodes, errors, pairs)
      type(entry_type), intent(in)         :: entry
      type(limit_type), allocatable, intent(inout) :: nodes(:)
      type(deck_error_list), intent(inout) :: errors
      type(pair_reference), allocatable, intent(inout), optional :: pairs(:)
      character(:), allocatable :: rest, word
      type(pair_reference) :: pair
      integer :: comma, dash
      logical :: ok

      if (allocated(nodes)) deallocate (nodes)
      if (present(pairs)) pairs = [pair_reference ::]
      rest = upper(entry%value)
      ok = rest /= ''
      do while (ok .and. rest /= '')
         comma = index(rest//',', ',')
         word = trim(adjustl(rest(:comma - 1)))
         dash = index(word, '-')
         if (present(pairs) .and. dash > 1) then
            call read_pair(word, pair, ok)
            pair%line = entry%line
            if (ok) pairs = [pairs, pair]
         else
            call read_limit(word, entry%line, nodes, ok)
         end if
         rest = rest(min(comma + 1, len(rest) + 1):)
      end do
      if (.not. ok) call value_error(entry, 'SET N or PMARK N, several with commas between them: the nodes to be written'// &
                                     one_of(present(pairs), ', or N-M, node M against node N', ''), errors)
   end subroutine read_nodes

   !> The PAIR of a WORD 9001-9002.
   pure subroutine read_pair(word, pair, ok)
      character(*), intent(in)          :: word
      type(pair_reference), intent(out) :: pair
      logical, intent(out)              :: ok
      integer :: dash

      dash = index(word, '-')
      call parse_integer(trim(word(:dash - 1)), pair%nodes(1), ok)
      if (ok) call parse_integer(trim(adjustl(word(dash + 1:))), pair%nodes(2), ok)
      ok = ok .and. all(pair%nodes > 0) .and. pair%nodes(1) /= pair%nodes(2)
   end subroutine read_pair

   !> Note the nodes that ENTRY, DISPLACEMENT(...) = ALL or a set, asks for; the number of the set ALL is ALL_NODES. An entry of a stage,
   !! on or behind line FIRST, replaces those above it.
   subroutine show_nodes(entry, first, all_nodes, asked)
      type(entry_type), intent(in) :: entry
      integer, intent(in)          :: first, all_nodes
      type(vibration_entries_type), intent(inout) :: asked
      integer :: set
      logical :: ok

      call parse_integer(entry%value, set, ok)
      if (upper(entry%value) == 'ALL') set = all_nodes
      if (.not. ok .and. set /= all_nodes) return
      if (.not. allocated(asked%shown)) allocate (asked%shown(0))
      asked%shown = [pack(asked%shown, asked%shown%line > first), limit_type(.false., set, entry%line)]
   end subroutine show_nodes

   !> Complete the response of a stage as in NASTRAN: without RESPONSE at the nodes of DISPLACEMENT; in a DIRECT solution with the modes
   !! that it needs. SHOWN: whether DISPLACEMENT has an effect.
   subroutine complete_response(asked, direct, of_nastran, shown)
      type(vibration_entries_type), intent(inout) :: asked
      logical, intent(in)    :: direct, of_nastran
      logical, intent(inout) :: shown

      if (asked%frequency%id == 0) return
      if (direct) asked%modes = set_reference(any_modes, asked%frequency%line)
      if (direct) asked%line(modes) = asked%frequency%line
      if (allocated(asked%response)) return
      if (allocated(asked%shown)) asked%response = asked%shown
      if (of_nastran .or. allocated(asked%shown)) asked%line(response) = asked%frequency%line
      shown = shown .or. allocated(asked%shown)
   end subroutine complete_response

   !> Check that each vibration entry has the key it needs. An entry above the first SUBCASE has been copied into each stage. It has no
   !! effect in a stage without MODES, or without FREQUENCY, but one stage must have the key.
   subroutine check_vibration(asked, line, condenses, errors)
      type(vibration_entries_type), intent(in) :: asked(:) !! of each stage
      integer, intent(in)                      :: line(:)  !! line of its SUBCASE, 0: none
      logical, intent(in)                      :: condenses(:) !! OUTPUT = DMIG, for which STIFFNESS has an effect too
      type(deck_error_list), intent(inout)     :: errors
      character(:), allocatable :: lacking
      integer :: key, need, s, said

      lacking = ''
      said = 0 ! line of the last FREQUENCY reported as incomplete
      do s = 1, size(asked)
         do key = stiffness, response
            need = merge(modes, frequency, key <= frequency)
            associate (at => asked(s)%line(key), has_it => asked%line(need) > 0 .or. (condenses .and. key == stiffness))
               if (at == 0 .or. has_it(s)) cycle
               if (at < line(s) .and. (s > 1 .or. any(has_it))) cycle ! reported in the first stage, or effective elsewhere
               call errors%add(at, trim(keys(key))//': has no effect without '//trim(keys(need))//', which is not given')
            end associate
         end do
         associate (at => asked(s)%line)
            if (at(frequency) == 0 .or. at(modes) == 0 .or. at(frequency) == said) cycle
            lacking = '' ! DAMPING is not required: damping may come from materials, which are unknown here
            if (at(dload) == 0) lacking = ', DLOAD (the set of the load that oscillates)'
            if (at(response) == 0) lacking = lacking//', RESPONSE (the nodes to be written)'
            if (lacking == '') cycle
            said = at(frequency)
            call errors%add(said, 'FREQUENCY: expected also '//lacking(3:))
         end associate
      end do
   end subroutine check_vibration

end module stage_entries
