!> Recognises the entries of NASTRAN decks that the program reads without effect.
!! These entries ask for output, choose a solution method, or belong to what nothing uses. An entry that would change an answer is
!! not among them.
!!
!! The module also recognises the lines of case control that NASTRAN knows and this program does not, and NASTRAN's forms of ECHO.
module nastran_compatibility
   use case_entries, only: choose, entry_type, value_error
   use deck_errors, only: deck_error_list
   use field_rules, only: parse_integer, parse_real
   use kinds, only: wp
   use text_tools, only: integer_text, one_of, upper
   implicit none
   private

   public :: control_habit, is_idle_card, take_parameter, read_habit, read_echo

   integer, parameter :: name_length = 40

   !> An entry whose effect depends on the stages.
   type :: waiting_entry
      character(name_length) :: name = ''
      integer :: n = 0                        ! number of entries of this name
      integer :: line = 0                     ! line of the first in the deck text
      logical :: needs_response = .false.     ! has an effect with FREQUENCY only; otherwise with MODES
      character(:), allocatable :: refusal    ! error message where the entry has an effect; empty: no error
   end type waiting_entry

   !> The entries without effect of one deck.
   type, public :: ignored_entries_type
      integer :: n = 0                                        !! number of entries
      character(:), allocatable, private :: names             ! ', PARAM, DISPLACEMENT': each once, in the order of appearance
      type(waiting_entry), allocatable, private :: waiting(:)
   contains
      procedure :: wait, settle
      procedure :: add
      procedure :: words
   end type ignored_entries_type

   !> The parameters given by the PARAM cards of a deck.
   type, public :: parameters_type
      real(wp) :: mass_factor = 1.0_wp        !! WTMASS: densities are multiplied by it
      real(wp) :: damping = 0.0_wp            !! G: overall structural damping [-]
      integer  :: mass_line = 0               !! line of COUPMASS, 0: not given
      logical  :: lumped = .false.            !! COUPMASS below 1
      logical  :: is_structural = .false.     !! KDAMP = -1: the damping of SDAMPING is structural
   end type parameters_type

   real(wp), parameter     :: all_frequencies = 1.0e30_wp ! default of HFREQ in NASTRAN
   character(*), parameter :: which_modes = 'expected none: V1, V2 and ND of EIGRL say which modes take part'

   ! of executive control and case control
   character(12), parameter :: control_words(68) = [character(12) :: &
      'SCREEN', 'FORMAT', 'BCRESULTS', 'BGRESULTS', 'BOLTRESULTS', &
      'ID', 'TIME', 'NASTRAN', 'INIT', 'ASSIGN', 'DIAG', 'GEOMCHECK', 'ECHOON', 'ECHOOFF', 'SUBTITLE', 'LINE', &
      'MAXLINES', 'PAGE', 'POST', 'ELSUM', 'GROUNDCHECK', 'WEIGHTCHECK', 'AUTOSPC', 'NLPARM', 'NLSTRESS', 'DISPLACEMENT', &
      'VECTOR', 'SVECTOR', 'VELOCITY', 'ACCELERATION', 'STRESS', 'ELSTRESS', 'STRAIN', 'ELSTRAIN', 'FORCE', 'ELFORCE', &
      'SPCFORCES', 'MPCFORCES', 'OLOAD', 'GPFORCE', 'GPSTRESS', 'GPSTRAIN', 'GPSDCON', 'ELSDCON', 'GPKE', 'ESE', 'EKE', &
      'EDE', 'STRFIELD', 'SURFACE', 'VOLUME', 'BOUTPUT', 'DATAREC', 'THERMAL', 'FLUX', 'HOUTPUT', 'ENTHALPY', 'MEFFMASS', &
      'MODALKE', 'OTIME', 'OFREQUENCY', 'OMODES', 'PLOTID', 'SETP', 'XYPLOT', 'XYPRINT', 'SEALL', 'VUGRID']
   ! of the bulk data: plots, and properties and materials of unsupported elements
   character(8), parameter :: card_names(41) = [character(8) :: 'BCTPARM', 'BGPARM', &
      'MAT4', 'MAT5', 'DTI', &
      'PLOTEL', 'PLOTEL3', 'PLOTEL4', 'PLOTEL6', 'PLOTEL8', 'ECHOON', 'ECHOOFF', 'NLPARM', 'PBCOMP', &
      'PBEND', 'PBUSH1D', 'PCOMP', 'PCOMPG', 'PCOMPS', 'PDAMP', 'PFAST', 'PGAP', 'PLPLANE', 'PLSOLID', &
      'PMASS', 'PRAC2D', 'PRAC3D', 'PSHEAR', 'PTUBE', 'PVISC', 'PWELD', 'MAT2', 'MAT3', 'MAT8', 'MAT9', &
      'MAT10', 'MAT11', 'TABLEM1', 'MDLPRM', 'ABSNMVS', 'ABSTRCT']

contains

   !> The word of case control without effect that KEY stands for, in at least four letters; empty: none.
   pure function control_habit(key) result(word)
      character(*), intent(in)  :: key !! in capitals
      character(:), allocatable :: word
      integer :: i

      word = ''
      i = findloc(control_words == key .or. (len(key) >= 4 .and. index(control_words, key) == 1), .true., dim=1)
      if (i > 0) word = trim(control_words(i))
   end function control_habit

   !> Whether a card of bulk data has no effect, by its NAME.
   pure logical function is_idle_card(name)
      character(*), intent(in) :: name

      is_idle_card = any(card_names == name)
   end function is_idle_card

   !> Store the PARAM NAME with this VALUE on LINE in PARAMETERS, or among the entries without effect, IGNORED. Where the PARAM would
   !! change the answer in an unsupported way, or its value is wrong, EXPECTED is the expected value.
   pure subroutine take_parameter(name, value, line, parameters, ignored, expected)
      character(*), intent(in)               :: name, value !! in capitals, no blanks in front
      integer, intent(in)                    :: line
      type(parameters_type), intent(inout)   :: parameters
      type(ignored_entries_type), intent(inout)  :: ignored
      character(:), allocatable, intent(out) :: expected
      character(:), allocatable :: refusal
      real(wp) :: x
      integer  :: number
      logical  :: is_default, is_integer, is_real

      expected = ''
      call parse_integer(value, number, is_integer)
      call parse_real(value, x, is_real)
      if (is_integer) x = real(number, wp)
      select case (name)
      case ('WTMASS')
         if (is_real) is_real = x > 0.0_wp
         if (is_real) parameters%mass_factor = x
         if (.not. is_real) expected = 'a real number above 0: densities are multiplied by it'
      case ('G')
         if (is_real) is_real = x >= 0.0_wp
         if (is_real) parameters%damping = x
         if (.not. is_real) expected = 'a real number of at least 0, the structural damping of everything'
         call ignored%wait('PARAM G', line, needs_response=.false.)
      case ('COUPMASS')
         parameters%lumped = number < 1
         parameters%mass_line = line
         if (.not. is_integer) expected = 'an integer: above 0 consistent mass, else lumped mass'
         call ignored%wait('PARAM COUPMASS', line, needs_response=.false.)
      case ('KDAMP')
         parameters%is_structural = number == -1
         if (.not. is_integer .or. abs(number) /= 1) expected = '1, SDAMPING is viscous, or -1, it is structural'
         call ignored%wait('PARAM KDAMP', line, needs_response=.true.)
      case ('ALPHA1', 'ALPHA2', 'LMODES', 'LFREQ', 'HFREQ')
         refusal = which_modes
         if (name(:5) == 'ALPHA') refusal = 'expected 0.0: damping is given by SDAMPING, AMPLITUDE, PARAM G and GE of MAT1'
         is_default = abs(x) <= 0.0_wp
         if (name == 'HFREQ') is_default = x >= all_frequencies
         if (is_default .and. (is_integer .or. is_real)) refusal = ''
         call ignored%wait('PARAM '//name, line, needs_response=.true., refusal=refusal)
      case default
         if (name == 'INREL' .and. (.not. is_integer .or. number /= 0)) then
            expected = '0: inertia relief is not available'
         else if (name == 'LGDISP' .and. (.not. is_integer .or. number > 0)) then
            expected = '-1 or 0: displacements are small here'
         else
            call ignored%add('PARAM '//name)
         end if
      end select
   end subroutine take_parameter

   !> Interpret a line without a key of the program: it has no effect, or is unknown.
   subroutine read_habit(entry, parameters, ignored, errors)
      type(entry_type), intent(in)           :: entry
      type(parameters_type), intent(inout)   :: parameters
      type(ignored_entries_type), intent(inout)  :: ignored
      type(deck_error_list), intent(inout)   :: errors
      character(:), allocatable :: expected, name, value
      integer :: choice, comma

      choice = 0
      select case (entry%key)
      case ('INCLUDE', 'CEND') ! lines of an INCLUDE file follow in the deck text; CEND is the end of NASTRAN's executive control
      case ('APP', 'ANALYSIS')
         call choose(entry, '|STATICS|STATIC|DISP|DISPLACEMENT|', choice, errors)
         call ignored%add(entry%key)
      case ('PARAM')
         value = upper(adjustl(entry%value)) ! 'PARAM,POST,-1'
         if (index(value, ',') == 1) value = adjustl(value(2:))
         comma = scan(value//',', ', ')
         name = value(:comma - 1)
         value = trim(adjustl(value(min(comma + 1, len(value) + 1):)))
         call take_parameter(name, value, entry%line, parameters, ignored, expected)
         if (expected /= '') call errors%add(entry%line, 'PARAM '//name//': '''//value//''', expected '//expected, &
                                             entry%first, entry%last)
      case default
         if (control_habit(entry%key) /= '') then
            call ignored%add(control_habit(entry%key))
         else
            call errors%add(entry%line, ''''//entry%key(:min(40, len(entry%key)))//''' is not a key of case control; expected '// &
               'TITLE, UNITS, METHOD, TOL, PATHTOL, PRESSURE, CARRY, AVERAGE, SOLVER, MASS, RESTART, ECHO, SPC, '// &
                            'MPC, SUBCASE, LABEL, LOAD, TEMPERATURE(LOAD), INCR, OUTPUT, WATCH, MODES, STIFFNESS, AMPLITUDE, '// &
                            'FREQUENCY, DLOAD, SDAMPING, RESPONSE or BEGIN BULK')
         end if
      end select
   end subroutine read_habit

   !> ECHO = NO or NONE, or any of NASTRAN's words for printing the deck, in any order, to any file.
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

   !> Count one more entry NAME.
   pure subroutine add(self, name)
      class(ignored_entries_type), intent(inout) :: self
      character(*), intent(in)               :: name

      if (.not. allocated(self%names)) self%names = ''
      self%n = self%n + 1
      if (index(self%names//',', ', '//trim(name)//',') == 0) self%names = self%names//', '//trim(name)
   end subroutine add

   !> Note the entry NAME on LINE, which has an effect in a stage with MODES or, if NEEDS_RESPONSE, with FREQUENCY. With a
   !! REFUSAL the effect is an error.
   pure subroutine wait(self, name, line, needs_response, refusal)
      class(ignored_entries_type), intent(inout) :: self
      character(*), intent(in)               :: name
      integer, intent(in)                    :: line
      logical, intent(in)                    :: needs_response
      character(*), intent(in), optional     :: refusal
      type(waiting_entry) :: entry
      integer :: i

      if (.not. allocated(self%waiting)) allocate (self%waiting(0))
      i = findloc(self%waiting%name == name, .true., dim=1)
      if (i == 0) then
         entry%name = name
         entry%line = line
         entry%needs_response = needs_response
         entry%refusal = ''
         self%waiting = [self%waiting, entry]
         i = size(self%waiting)
      end if
      self%waiting(i)%n = self%waiting(i)%n + 1
      if (present(refusal) .and. self%waiting(i)%refusal == '') self%waiting(i)%refusal = refusal
   end subroutine wait

   !> Decide the noted entries, now that it is known whether any stage has MODES and FREQUENCY.
   subroutine settle(self, has_modes, has_response, errors)
      class(ignored_entries_type), intent(inout) :: self
      logical, intent(in)                    :: has_modes, has_response
      type(deck_error_list), intent(inout)   :: errors
      integer :: i

      if (.not. allocated(self%waiting)) return
      do i = 1, size(self%waiting)
         associate (entry => self%waiting(i))
            if (.not. merge(has_response, has_modes, entry%needs_response)) then
               call self%add(trim(entry%name))
               self%n = self%n + entry%n - 1
            else if (entry%refusal /= '') then
               call errors%add(entry%line, trim(entry%name)//': this card would change the response; '//entry%refusal)
            end if
         end associate
      end do
      deallocate (self%waiting)
   end subroutine settle

   !> '12 entries without effect: PARAM, DISPLACEMENT'; empty where there are none.
   pure function words(self) result(text)
      class(ignored_entries_type), intent(in) :: self
      character(:), allocatable           :: text

      text = ''
      if (self%n > 0) text = integer_text(self%n)//one_of(self%n == 1, ' entry', ' entries')//' without effect: '// &
                             self%names(3:)
   end function words

end module nastran_compatibility
