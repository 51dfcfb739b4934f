!> What a deck written for NASTRAN holds besides: entries that ask for output, choose a way of solving or belong to what nothing
!! uses. They are read and have no effect; what would change an answer is not among them.
module nastran_habits
   use deck_numbers, only: parse_integer, parse_real
   use kinds, only: wp
   implicit none
   private

   public :: control_habit, is_idle_card, judge_parameter

   integer, parameter, public :: parameter_idle = 0, parameter_mass = 1, parameter_refused = 2 !! what a PARAM is

   ! of the executive control and of the case control
   character(12), parameter :: control_words(63) = [character(12) :: &
      'ID', 'TIME', 'NASTRAN', 'INIT', 'ASSIGN', 'DIAG', 'GEOMCHECK', 'ECHOON', 'ECHOOFF', 'SUBTITLE', 'LINE', &
      'MAXLINES', 'PAGE', 'POST', 'ELSUM', 'GROUNDCHECK', 'WEIGHTCHECK', 'AUTOSPC', 'NLPARM', 'NLSTRESS', 'DISPLACEMENT', &
      'VECTOR', 'SVECTOR', 'VELOCITY', 'ACCELERATION', 'STRESS', 'ELSTRESS', 'STRAIN', 'ELSTRAIN', 'FORCE', 'ELFORCE', &
      'SPCFORCES', 'MPCFORCES', 'OLOAD', 'GPFORCE', 'GPSTRESS', 'GPSTRAIN', 'GPSDCON', 'ELSDCON', 'GPKE', 'ESE', 'EKE', &
      'EDE', 'STRFIELD', 'SURFACE', 'VOLUME', 'BOUTPUT', 'DATAREC', 'THERMAL', 'FLUX', 'HOUTPUT', 'ENTHALPY', 'MEFFMASS', &
      'MODALKE', 'OTIME', 'OFREQUENCY', 'OMODES', 'PLOTID', 'SETP', 'XYPLOT', 'XYPRINT', 'SEALL', 'VUGRID']
   ! of the bulk data: plots, and properties and materials of elements that there are none of
   character(8), parameter :: card_names(42) = [character(8) :: &
      'PLOTEL', 'PLOTEL3', 'PLOTEL4', 'PLOTEL6', 'PLOTEL8', 'ECHOON', 'ECHOOFF', 'NLPARM', 'PBAR', 'PBARL', 'PBEAM', &
      'PBEAML', 'PBCOMP', 'PBEND', 'PBUSH1D', 'PCOMP', 'PCOMPG', 'PCOMPS', 'PDAMP', 'PFAST', 'PGAP', 'PLPLANE', 'PLSOLID', &
      'PMASS', 'PRAC2D', 'PRAC3D', 'PSHEAR', 'PTUBE', 'PVISC', 'PWELD', 'BAROR', 'BEAMOR', 'MAT2', 'MAT3', 'MAT8', 'MAT9', &
      'MAT10', 'MAT11', 'TABLEM1', 'MDLPRM', 'ABSNMVS', 'ABSTRCT']

contains

   !> The word of case control without effect that KEY is, four letters of it or more; empty: none.
   pure function control_habit(key) result(word)
      character(*), intent(in)  :: key !! in capitals
      character(:), allocatable :: word
      integer :: i

      word = ''
      do i = 1, size(control_words)
         if (control_words(i) == key .or. (len(key) >= 4 .and. index(control_words(i), key) == 1)) exit
      end do
      if (i <= size(control_words)) word = trim(control_words(i))
   end function control_habit

   !> Whether a card of bulk data has no effect, by its NAME.
   pure logical function is_idle_card(name)
      character(*), intent(in) :: name

      is_idle_card = any(card_names == name)
   end function is_idle_card

   !> What the PARAM called NAME with this VALUE is: without effect, WTMASS (then MASS is what densities are multiplied by), or
   !! one that asks for another answer; then EXPECTED says what of it would be understood.
   pure subroutine judge_parameter(name, value, what, mass, expected)
      character(*), intent(in)               :: name, value !! in capitals, no blanks in front
      integer, intent(out)                   :: what        !! parameter_idle, ...
      real(wp), intent(out)                  :: mass
      character(:), allocatable, intent(out) :: expected
      integer :: number
      logical :: ok

      what = parameter_idle
      mass = 1.0_wp
      expected = ''
      call parse_integer(value, number, ok)
      select case (name)
      case ('WTMASS')
         what = parameter_mass
         call parse_real(value, mass, ok)
         if (ok) ok = mass > 0.0_wp
         if (.not. ok) expected = 'a real number above 0: densities are multiplied by it'
      case ('INREL')
         if (.not. ok .or. number /= 0) expected = '0: bodies without supports are not held by their inertia here'
      case ('LGDISP')
         if (.not. ok .or. number > 0) expected = '-1 or 0: displacements are small here'
      end select
      if (expected /= '') what = parameter_refused
   end subroutine judge_parameter

end module nastran_habits
