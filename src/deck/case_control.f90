!> Reads case control, the lines before BEGIN BULK, which say stage by stage what the program does.
module case_control
   use case_entries, only: choose, cut_entry, entry_type, global_keys, limit_type, number_set, read_number, &
                           read_set, set_reference, stage_keys, value_error
   use control_words, only: method_back, method_step, method_words, model_words, no_restart, pressure_sumf, pressure_words, &
                            solver_auto, solver_mumps, solver_petsc, solver_words
   use deck_errors, only: deck_error_list
   use deck_text, only: deck_text_type
   use field_rules, only: parse_integer, parse_real
   use kinds, only: wp
   use nastran_compatibility, only: ignored_entries_type, parameters_type, read_echo, read_habit
   use nastran_solutions, only: is_direct, is_statics, judge_solution, starts_dmap, warn_of_dmap
   use nastran_words, only: control_habit
   use stage_entries, only: check_vibration, complete_response, read_stage_entry, show_nodes, &
                            stage_type, vibration_entries_type
   use text_tools, only: integer_text, upper
   use tolerances, only: back_tol, least_tol, newton_tol, path_tol
   implicit none
   private

   public :: read_case_control, offer_petsc

   character(12), parameter :: motions(5) = [character(12) :: 'DISPLACEMENT', 'VECTOR', 'SVECTOR', 'VELOCITY', 'ACCELERATION']
   integer, parameter  :: all_nodes = -2 ! number of the set of DISPLACEMENT = ALL, -1 that of --watch

   !> A matrix that K2GG or M2GG adds.
   type, public :: matrix_term
      logical      :: of_mass = .false.                  !! M2GG
      character(8) :: name = ''                          !! of DMIG
      real(wp)     :: factor = 1.0_wp
      integer      :: line = 0
   end type matrix_term

   type, public :: case_control_type
      character(:), allocatable :: title
      character(8) :: length_unit = '', force_unit = ''  !! labels only
      integer :: method = method_step
      logical :: method_is_given = .false.
      integer :: pressure = pressure_sumf
      logical :: carry = .false.
      logical :: average = .true.                        !! BACK: average two consecutive sets of results
      integer :: solver = solver_auto
      real(wp) :: tolerance = newton_tol           !! NEWTON: unbalanced force over largest load; BACK: change of pressures
      real(wp) :: path_tolerance = path_tol              !! NEWTON without INCR: of the largest deflection and pressure
      integer :: restart = no_restart                    !! increments of a stage between restart files
      logical :: echo  = .true.
      logical :: echo_asked = .false.                    !! by ECHO: for any number of cards
      logical :: of_nastran = .false.                    !! SOL or CEND: the deck was written for NASTRAN
      logical :: refused = .false.                       !! a kind of analysis that is not available: the only error
      logical :: is_static = .false.                     !! SOL of statics: METHOD = set has no effect
      logical :: is_direct = .false.                     !! SOL 108: its response needs no MODES
      type(matrix_term), allocatable :: matrices(:)      !! K2GG, M2GG
      logical :: lumped = .false.                        !! MASS = LUMPED: the mass of elements is lumped at their nodes
      logical :: mass_is_given = .false.                 !! MASS is given
      integer :: model = 0, model_line = 0               !! MODEL, 0: not given
      type(number_set), allocatable :: sets(:)
      type(parameters_type) :: parameters                !! of PARAM
      type(ignored_entries_type) :: ignored
      type(stage_type), allocatable :: stages(:)
   end type case_control_type

   logical, public, protected :: has_petsc = .false. !! see offer_petsc

contains

   !> Whether the program has the solvers PETSC and MUMPS.
   subroutine offer_petsc()
      has_petsc = .true.
   end subroutine offer_petsc

   !> Read from line CURSOR of TEXT up to BEGIN BULK or, where there is none, up to the first card, on line FIRST_CARD. CURSOR then is
   !! the line after BEGIN BULK, or FIRST_CARD; FOUND_BULK tells whether there is either.
   subroutine read_case_control(text, cursor, first_card, control, found_bulk, errors)
      type(deck_text_type), intent(in)     :: text
      integer, intent(inout)               :: cursor
      integer, intent(in)                  :: first_card !! 0: there is a BEGIN BULK, or no card
      type(case_control_type), intent(out) :: control
      logical, intent(out)                 :: found_bulk
      type(deck_error_list), intent(inout) :: errors
      type(stage_type) :: common           ! keys above the first SUBCASE hold for every stage
      type(entry_type) :: entry
      character(:), allocatable :: keys_seen ! in this place: above the stages, or in one stage
      character(:), allocatable :: line
      character(:), allocatable :: refusal, warning
      type(number_set) :: whole
      logical :: goes_on, in_dmap, in_plots, past_cend
      integer :: n_shown

      n_shown = 0
      goes_on = .false.
      in_dmap = .false.
      in_plots = .false.
      past_cend = .false.
      control%title = ''
      control%tolerance = 0.0_wp
      allocate (control%stages(0), control%sets(0), control%matrices(0))
      common%label = ''
      keys_seen = '|'
      found_bulk = .false.
      do while (cursor <= text%n)
         found_bulk = cursor == first_card
         if (found_bulk) exit
         line = text%card_part(cursor)
         cursor = cursor + 1
         if (line == '') cycle
         if (goes_on) then ! the continued list of an entry without effect
            goes_on = line(len(line):) == ','
            cycle
         end if
         call cut_entry(line, cursor - 1, entry)
         if (in_plots .and. entry%key /= 'BEGIN' .and. entry%key /= 'ENDDATA') cycle
         if (in_dmap .and. all(entry%key /= ['CEND ', 'BEGIN', 'SOL  '])) cycle
         if (entry%key == 'BEGIN') then
            found_bulk = .true.
            if (upper(entry%value) /= 'BULK') call refuse('BEGIN: '''//entry%value//''', expected BULK: there is '// &
                                                          'one structure, without superelements')
            if (control%refused) return
            exit
         else if (entry%key == 'ENDDATA') then
            cursor = cursor - 1
            exit
         end if
         control%of_nastran = control%of_nastran .or. entry%key == 'SOL' .or. entry%key == 'CEND'
         past_cend = past_cend .or. entry%key == 'CEND'
         in_dmap = in_dmap .and. .not. past_cend
         if (starts_dmap(entry%key) .and. .not. past_cend) then
            in_dmap = .true.
            call warn_of_dmap(entry%key, text%place(entry%line), errors)
            cycle
         else if (any(entry%key == ['SOL     ', 'APP     ', 'ANALYSIS'])) then
            call judge_solution(entry, refusal, warning)
            call errors%warn(warning)
            if (refusal /= '') call refuse(refusal)
            if (control%refused) return
            if (entry%key == 'SOL') control%is_static = is_statics(entry)
            if (entry%key == 'SOL') control%is_direct = is_direct(entry)
         end if
         if (entry%key == 'METHOD' .and. entry%value /= '' .and. verify(entry%value, '0123456789') == 0) then
            if (control%is_static) call control%ignored%add('METHOD')
            if (control%is_static) cycle
            entry%key = 'MODES'
            if (any(entry%describers == ['         ', 'BOTH     ', 'STRUCTURE'])) entry%describers = 'METHOD'
         end if
         do while (entry%key == 'SUBSEQ' .and. cursor <= text%n .and. index(entry%value//'|', ',|') > 0)
            entry%value = entry%value//' '//adjustl(text%card_part(cursor))
            cursor = cursor + 1
         end do
         in_plots = entry%key == 'OUTPUT' .and. entry%describers /= '' ! NASTRAN's plot requests: all lines up to BEGIN BULK
         if (in_plots .or. (entry%key == 'OUTPUT' .and. entry%value == '')) then
            call control%ignored%add('OUTPUT')
         else if (entry%key == 'SET') then
            call read_set(text, entry, cursor, control%sets, errors)
         else if (any(entry%key == ['SUBCASE', 'SUBCOM ']) .or. any(global_keys == entry%key) .or. &
                  any(stage_keys == entry%key)) then
            if (any(entry%key == ['SUBCASE', 'SUBCOM '])) keys_seen = '|'
            if (index(keys_seen, '|'//entry%key//'('//entry%describers//')|') > 0) &
               call errors%warn(entry%key//': given twice in the same place; the last one counts, in '//text%place(entry%line))
            keys_seen = keys_seen//entry%key//'('//entry%describers//')|'
            call read_entry(entry, control, common, errors)
         else
            call read_habit(entry, control%parameters, control%ignored, errors)
            if (any(control_habit(entry%key) == motions)) then
               n_shown = n_shown + 1
               associate (n => size(control%stages))
                  if (n == 0) call show_nodes(entry, 0, all_nodes, common%vibration)
                  if (n > 0) call show_nodes(entry, control%stages(n)%line, all_nodes, control%stages(n)%vibration)
               end associate
            end if
            goes_on = line(len(line):) == ','
         end if
      end do
      if (control%tolerance <= 0.0_wp) control%tolerance = merge(back_tol, newton_tol, control%method == method_back)
      call check_stages(control, common, n_shown, errors)
      call note_idle_sets(control)
      whole%id = all_nodes
      whole%text = 'ALL'
      control%sets = [control%sets, whole]

   contains

      !> Make WORDS about ENTRY the only error: nothing else of the deck is read.
      subroutine refuse(words)
         character(*), intent(in) :: words

         control%refused = .true.
         errors%n = 0
         call errors%add(entry%line, words, entry%first, entry%last)
      end subroutine refuse

   end subroutine read_case_control

   !> Note the sets that no OUTPUT, WATCH or RESPONSE names as entries without effect.
   pure subroutine note_idle_sets(control)
      type(case_control_type), intent(inout) :: control
      type(limit_type), allocatable :: named(:)
      integer :: i

      allocate (named(0))
      do i = 1, size(control%stages)
         associate (stage => control%stages(i))
            if (allocated(stage%only)) named = [named, stage%only]
            if (allocated(stage%watch)) named = [named, stage%watch]
            if (allocated(stage%vibration%response)) named = [named, stage%vibration%response]
         end associate
      end do
      do i = 1, size(control%sets)
         if (all(named%is_mark .or. named%id /= control%sets(i)%id)) call control%ignored%add('SET')
      end do
   end subroutine note_idle_sets

   !> Interpret one line of case control.
   subroutine read_entry(entry, control, common, errors)
      type(entry_type), intent(in)           :: entry
      type(case_control_type), intent(inout) :: control
      type(stage_type), intent(inout)        :: common
      type(deck_error_list), intent(inout)   :: errors
      integer :: choice, n
      logical :: ok

      n = size(control%stages)
      if (n > 0 .and. any(entry%key == ['TITLE', 'ECHO '])) then ! of a subcase
         call control%ignored%add(entry%key)
         return
      end if
      if (n > 0 .and. any(global_keys == entry%key)) &
         call errors%add(entry%line, entry%key//': holds for all stages, expected above the first SUBCASE')
      if (entry%describers /= '' .and. all(entry%key /= ['ECHO       ', 'TEMPERATURE', 'MODES      '])) &
         call errors%add(entry%line, entry%key//'('//entry%describers//'): expected no parentheses after '//entry%key)
      choice = 0
      if (any(stage_keys == entry%key)) then
         if (n == 0) then
            call read_stage_entry(entry, common, errors)
         else
            call read_stage_entry(entry, control%stages(n), errors)
         end if
         return
      end if
      select case (entry%key)
      case ('SUBCASE', 'SUBCOM')
         call start_stage(entry, control, common, errors)
      case ('TITLE')
         control%title = entry%value
      case ('K2GG', 'M2GG')
         call read_matrices(entry, control%matrices, errors)
      case ('UNITS')
         call read_units(entry, control, errors)
      case ('METHOD')
         call choose(entry, method_words, control%method, errors)
         control%method_is_given = .true.
      case ('TOL')
         call parse_real(upper(entry%value), control%tolerance, ok)
         if (.not. ok .or. control%tolerance < least_tol .or. control%tolerance > 0.01_wp) &
            call value_error(entry, 'a real number from 1.E-14 to 0.01', errors)
      case ('PATHTOL')
         call parse_real(upper(entry%value), control%path_tolerance, ok)
         if (.not. ok .or. .not. control%path_tolerance > 0.0_wp) call value_error(entry, 'a real number > 0', errors)
      case ('PRESSURE')
         call choose(entry, pressure_words, control%pressure, errors)
      case ('CARRY')
         call choose(entry, '|NO|YES|', choice, errors)
         control%carry = choice == 2
      case ('AVERAGE')
         call choose(entry, '|YES|NO|', choice, errors)
         control%average = choice /= 2
      case ('MODEL')
         call choose(entry, model_words, control%model, errors)
         control%model_line = entry%line
      case ('MASS')
         call choose(entry, '|CONSISTENT|LUMPED|', choice, errors)
         control%lumped = choice == 2
         control%mass_is_given = .true.
      case ('SOLVER')
         call choose(entry, solver_words, control%solver, errors)
         if (any(control%solver == [solver_petsc, solver_mumps]) .and. .not. has_petsc) then
            control%solver = solver_auto
            call value_error(entry, 'AUTO, SKYLINE or TREE; PETSC and MUMPS are solvers of the program that make mpi builds', &
                             errors)
         end if
      case ('RESTART')
         call parse_integer(entry%value, n, ok)
         if (.not. ok .or. n < 0) then
            call value_error(entry, 'a number of increments, 0: at the ends of stages only', errors)
         else
            control%restart = n
         end if
      case ('ECHO')
         call read_echo(entry, control%echo, errors)
         control%echo_asked = control%echo
      end select
   end subroutine read_entry

   !> Add the terms of K2GG or M2GG, 'A', '2.0*A', '2.0*A, 3.0*B', to MATRICES.
   subroutine read_matrices(entry, matrices, errors)
      type(entry_type), intent(in)                    :: entry
      type(matrix_term), allocatable, intent(inout)   :: matrices(:)
      type(deck_error_list), intent(inout)            :: errors
      character(:), allocatable :: rest, name
      type(matrix_term) :: term
      integer :: comma, times
      logical :: ok

      term%of_mass = entry%key == 'M2GG'
      term%line = entry%line
      rest = upper(entry%value)//','
      do while (rest /= '')
         comma = index(rest, ',')
         name = trim(adjustl(rest(:comma - 1)))
         rest = trim(rest(comma + 1:))
         times = index(name, '*')
         term%factor = 1.0_wp
         ok = .true.
         if (times > 0) call parse_real(trim(name(:times - 1)), term%factor, ok)
         name = trim(adjustl(name(times + 1:)))
         if (.not. ok .or. name == '' .or. len(name) > 8 .or. scan(name, ' *') > 0) then
            call value_error(entry, 'names of matrices of DMIG cards, each with a factor or none: A, or 2.0*A, 3.0*B', errors)
            return
         end if
         term%name = name
         matrices = [matrices, term]
      end do
   end subroutine read_matrices

   subroutine read_units(entry, control, errors)
      type(entry_type), intent(in)           :: entry
      type(case_control_type), intent(inout) :: control
      type(deck_error_list), intent(inout)   :: errors
      integer :: comma

      comma = index(entry%value, ',')
      if (comma < 2 .or. comma == len(entry%value) .or. comma /= index(entry%value, ',', back=.true.) .or. &
          comma > 9 .or. len_trim(adjustl(entry%value(comma + 1:))) > 8) then
         call value_error(entry, 'a unit of length and one of force of at most 8 letters each: UNITS = MM, KGF', errors)
         return
      end if
      control%length_unit = entry%value(:comma - 1)
      control%force_unit = adjustl(entry%value(comma + 1:))
   end subroutine read_units

   subroutine start_stage(entry, control, common, errors)
      type(entry_type), intent(in)           :: entry
      type(case_control_type), intent(inout) :: control
      type(stage_type), intent(in)           :: common
      type(deck_error_list), intent(inout)   :: errors
      type(set_reference) :: number
      integer :: n

      n = size(control%stages)
      call read_number(entry, number, errors)
      if (n > 0 .and. number%id > 0) then
         if (number%id <= control%stages(n)%id) call errors%add(entry%line, entry%key//': '//integer_text(number%id)// &
            ' after '//integer_text(control%stages(n)%id)//', expected ascending numbers: stages run in the order of the deck', &
            entry%first, entry%last)
      end if
      control%stages = [control%stages, common]
      control%stages(n + 1)%id = number%id
      control%stages(n + 1)%line = entry%line
      if (entry%key == 'SUBCASE') return
      associate (stage => control%stages(n + 1)) ! what the SUBCASEs before it have
         stage%combines = -1
         stage%load = set_reference()
         stage%temperature = set_reference()
         stage%vibration = vibration_entries_type()
      end associate
   end subroutine start_stage

   !> Without SUBCASE there is one stage. A SUBCOM has the supports of the SUBCASE before it, and no loads of its own.
   subroutine check_stages(control, common, n_shown, errors)
      type(case_control_type), intent(inout) :: control
      type(stage_type), intent(in)           :: common !! the only stage of a deck without SUBCASE
      integer, intent(in)                    :: n_shown !! number of entries such as DISPLACEMENT
      type(deck_error_list), intent(inout)   :: errors
      integer :: before, i
      logical :: shown

      before = 0 ! number of SUBCASEs
      if (size(control%stages) == 0) then
         control%stages = [common]
         control%stages(1)%id = 1
      end if
      if (control%method == method_back .and. size(control%stages) > 1) call errors%add(control%stages(2)%line, &
         'SUBCASE: METHOD = BACK solves one stage of loading only; expected METHOD = STEP or NEWTON for a history')
      do i = 1, size(control%stages)
         associate (stage => control%stages(i))
            if (stage%from%id > 0 .and. all(control%stages(:i - 1)%id /= stage%from%id)) call errors%add(stage%from%line, &
               'FROM: '//integer_text(stage%from%id)//', expected the number of an earlier SUBCASE')
            if (stage%combines == 0) before = before + 1
            if (stage%combines == 0) cycle
            if (stage%combines < 0) stage%factors = [real(wp) ::]
            if (stage%combines < 0) call errors%add(stage%line, 'SUBCOM: expected SUBSEQ = factors of the SUBCASEs before it')
            if (size(stage%factors) > before) call errors%add(stage%combines, 'SUBSEQ: '//integer_text(size(stage%factors))// &
               ' factors, but '//integer_text(before)//' SUBCASEs before this SUBCOM')
            stage%load = set_reference()
            stage%temperature = set_reference()
            if (before == 0) cycle
            stage%supports = control%stages(i - 1)%supports
            stage%equations = control%stages(i - 1)%equations
         end associate
      end do
      shown = .false.
      do i = 1, size(control%stages)
         call complete_response(control%stages(i)%vibration, control%is_direct, control%of_nastran, shown)
      end do
      if (shown) call control%ignored%drop(motions, n_shown)
      call check_vibration(control%stages%vibration, control%stages%line, control%stages%output%dmig, errors)
   end subroutine check_stages

end module case_control
