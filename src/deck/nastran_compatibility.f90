!> Notes the entries of NASTRAN decks that the program reads without effect, and those whose effect depends on the stages.
!!
!! The module also interprets PARAM, the lines of case control that NASTRAN knows and this program does not, and NASTRAN's forms of ECHO.
module nastran_compatibility
   use case_entries, only: entry_type, global_keys, stage_keys, value_error
   use deck_errors, only: deck_error_list
   use field_rules, only: list_of, parse_integer, parse_real
   use kinds, only: wp
   use nastran_words, only: control_habit, is_idle_card, of_reduction, of_response
   use text_tools, only: integer_text, one_of, upper
   implicit none
   private

   public :: take_idle_card, take_parameter, read_habit, read_echo, not_reduced

   integer, parameter :: name_length = 40
   character(*), parameter :: not_reduced = 'the modes are those of the whole model, which is not reduced'
   integer, parameter :: with_modes = 1, with_response = 2, with_materials = 3, always = 4, & ! temperatures of materials
      with_mass = 5

   !> An entry whose effect depends on the stages.
   type :: waiting_entry
      character(name_length) :: name = ''
      integer :: n = 0                        ! number of entries of this name
      integer :: line = 0                     ! line of the first in the deck text
      integer :: need = with_modes            ! the stages in which it has an effect
      character(:), allocatable :: refusal    ! error message where the entry has an effect; empty: no error
      character(:), allocatable :: warning    ! likewise
   end type waiting_entry

   !> The entries without effect of one deck.
   type, public :: ignored_entries_type
      integer :: n = 0                                        !! number of entries
      character(:), allocatable, private :: names             ! ', PARAM, DISPLACEMENT': each once, in the order of appearance
      type(waiting_entry), allocatable, private :: waiting(:)
   contains
      procedure :: wait, settle
      procedure :: add, drop
      procedure :: words
   end type ignored_entries_type

   !> The parameters given by the PARAM cards of a deck.
   type, public :: parameters_type
      real(wp) :: mass_factor = 1.0_wp        !! WTMASS: densities are multiplied by it
      real(wp) :: damping = 0.0_wp            !! G: overall structural damping [-]
      integer  :: mass_line = 0               !! line of COUPMASS, 0: not given
      integer  :: relief_line = 0             !! line of INREL, 0: not given
      integer  :: relief = 0                  !! its value: -1 with SUPORT, -2 without
      logical  :: holds_idle = .true.         !! AUTOSPC: components without stiffness are held
      logical  :: lumped = .false.            !! COUPMASS below 1
      logical  :: is_structural = .false.     !! KDAMP = -1: the damping of SDAMPING is structural
   end type parameters_type

   real(wp), parameter     :: all_frequencies = 1.0e30_wp ! default of HFREQ in NASTRAN
   character(*), parameter :: which_modes = 'expected none: V1, V2 and ND of EIGRL say which modes take part'

contains

   !> Note the card NAME on LINE among the entries without effect, IGNORED, where it IS_ONE of them.
   pure subroutine take_idle_card(name, line, ignored, is_one)
      character(*), intent(in)                  :: name
      integer, intent(in)                       :: line
      type(ignored_entries_type), intent(inout) :: ignored
      logical, intent(out)                      :: is_one

      is_one = .true.
      if (is_idle_card(name)) then
         call ignored%add(name)
      else if (any(of_response == name)) then
         call ignored%wait(name, line, .true., refusal='expected none: damping is that of GE, PARAM G and SDAMPING')
      else if (any(of_reduction == name)) then
         call ignored%wait(name, line, .false., warning=not_reduced)
      else if (index(name, 'MATT') == 1) then
         call ignored%wait(name, line, .false., need=with_materials, refusal='expected MAT1 at the temperature of the set, '// &
                           'and TEMPERATURE(LOAD)')
      else
         is_one = .false.
      end if
   end subroutine take_idle_card

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
         call ignored%wait('PARAM COUPMASS', line, .false., need=with_mass)
      case ('AUTOSPC')
         parameters%holds_idle = value /= 'NO'
         call ignored%add('PARAM '//name)
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
            parameters%relief_line = line
            parameters%relief = number
            if (all(number /= [-1, -2])) expected = '0, or inertia relief: -1 with SUPORT, -2 without'
         else if (name == 'LGDISP' .and. (.not. is_integer .or. number > 0)) then
            call ignored%wait('PARAM LGDISP', line, .false., need=always, warning='displacements are small here')
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
      integer :: comma

      select case (entry%key)
      case ('INCLUDE', 'CEND') ! lines of an INCLUDE file follow in the deck text; CEND is the end of NASTRAN's executive control
      case ('APP', 'ANALYSIS') ! judged already
         call ignored%add(entry%key)
      case ('RESVEC')
         call ignored%wait(entry%key, entry%line, .true., refusal='expected none: MODES names the modes')
      case ('RANDOM')
         call ignored%wait(entry%key, entry%line, .true., warning='the response is that to DLOAD; none is random')
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
                            list_of('|TITLE|'//words_of(pack(global_keys, global_keys /= 'TITLE'))//words_of(stage_keys)// &
                                    'SUBCASE|SET|', ', ')//' or BEGIN BULK')
         end if
      end select
   end subroutine read_habit

   !> 'A|B|' of the words A, B.
   pure function words_of(list) result(words)
      character(*), intent(in)  :: list(:)
      character(:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, size(list)
         words = words//trim(list(i))//'|'
      end do
   end function words_of

   !> ECHO = NO or NONE, or any of NASTRAN's words for printing the deck, in any order, to any file.
   subroutine read_echo(entry, is_on, errors)
      type(entry_type), intent(in)         :: entry
      logical, intent(out)                 :: is_on
      type(deck_error_list), intent(inout) :: errors
      character(*), parameter :: off = '|NO|NONE|', on = '|YES|BOTH|SORT|SORTED|UNSORT|UNSORTED|PUNCH|FILE|ALL|'
      character(:), allocatable :: word

      word = '|'//upper(entry%value(:scan(entry%value//',', ' ,(') - 1))//'|'
      if (word == '||' .or. index(off//on, word) == 0) call value_error(entry, 'YES or NO, or NASTRAN''s BOTH, SORT, UNSORT, '// &
                                                                        'PUNCH or NONE', errors)
      is_on = index(off, word) == 0
   end subroutine read_echo

   !> Take the N entries NAMES out.
   pure subroutine drop(self, names, n)
      class(ignored_entries_type), intent(inout) :: self
      character(*), intent(in)                   :: names(:)
      integer, intent(in)                        :: n
      integer :: at, k

      if (.not. allocated(self%names)) return
      do k = 1, size(names)
         at = index(self%names//',', ', '//trim(names(k))//',')
         if (at > 0) self%names = self%names(:at - 1)//self%names(at + 2 + len_trim(names(k)):)
      end do
      self%n = self%n - n
   end subroutine drop

   !> Count one more entry NAME.
   pure subroutine add(self, name)
      class(ignored_entries_type), intent(inout) :: self
      character(*), intent(in)               :: name

      if (.not. allocated(self%names)) self%names = ''
      self%n = self%n + 1
      if (index(self%names//',', ', '//trim(name)//',') == 0) self%names = self%names//', '//trim(name)
   end subroutine add

   !> Note the entry NAME on LINE, which has an effect in a stage with MODES, if NEEDS_RESPONSE with FREQUENCY, or in those of NEED.
   !! With a REFUSAL the effect is an error, with a WARNING it is missing.
   pure subroutine wait(self, name, line, needs_response, refusal, warning, need)
      class(ignored_entries_type), intent(inout) :: self
      character(*), intent(in)               :: name
      integer, intent(in)                    :: line
      logical, intent(in)                    :: needs_response
      character(*), intent(in), optional     :: refusal, warning
      integer, intent(in), optional          :: need
      type(waiting_entry) :: entry
      integer :: i

      if (.not. allocated(self%waiting)) allocate (self%waiting(0))
      i = findloc(self%waiting%name == name, .true., dim=1)
      if (i == 0) then
         entry%name = name
         entry%line = line
         entry%need = merge(with_response, with_modes, needs_response)
         if (present(need)) entry%need = need
         entry%refusal = ''
         entry%warning = ''
         self%waiting = [self%waiting, entry]
         i = size(self%waiting)
      end if
      self%waiting(i)%n = self%waiting(i)%n + 1
      if (present(refusal) .and. self%waiting(i)%refusal == '') self%waiting(i)%refusal = refusal
      if (present(warning)) self%waiting(i)%warning = warning
   end subroutine wait

   !> Decide the noted entries, now that it is known whether any stage has MODES, FREQUENCY and temperatures of materials.
   !! HAS_MASS: beside MODES, inertia relief or OUTPUT = DMIG.
   subroutine settle(self, has_modes, has_response, has_materials, has_mass, errors)
      class(ignored_entries_type), intent(inout) :: self
      logical, intent(in)                    :: has_modes, has_response, has_materials, has_mass
      type(deck_error_list), intent(inout)   :: errors
      logical :: has(5)
      integer :: i

      if (.not. allocated(self%waiting)) return
      has([with_modes, with_response, with_materials, always, with_mass]) = [has_modes, has_response, has_materials, .true., &
                                                                            has_modes .or. has_mass]
      do i = 1, size(self%waiting)
         associate (entry => self%waiting(i))
            if (entry%refusal /= '' .and. has(entry%need)) then
               call errors%add(entry%line, trim(entry%name)//': this card would change the '// &
                               one_of(entry%need == with_response, 'response; ', 'answer; ')//entry%refusal)
            else if (entry%warning /= '' .and. has(entry%need)) then
               call errors%warn(trim(entry%name)//': '//entry%warning)
            else if (.not. has(entry%need)) then
               call self%add(trim(entry%name))
               self%n = self%n + entry%n - 1
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
