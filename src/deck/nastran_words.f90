!> The words of NASTRAN decks that the program reads without effect: keys of executive and case control, and names of cards.
!! They ask for output, choose a solution method, or belong to what nothing uses. A word that would change an answer is not among them.
module nastran_words
   implicit none
   private

   public :: control_habit, is_idle_card, is_own_card

   ! of executive control and case control
   character(12), parameter :: control_words(124) = [character(12) :: &
      'SCREEN', 'FORMAT', &
      'ID', 'TIME', 'NASTRAN', 'INIT', 'ASSIGN', 'DIAG', 'GEOMCHECK', 'ECHOON', 'ECHOOFF', 'SUBTITLE', 'LINE', &
      'MAXLINES', 'PAGE', 'POST', 'ELSUM', 'GROUNDCHECK', 'WEIGHTCHECK', 'AUTOSPC', 'NLPARM', 'NLSTRESS', 'DISPLACEMENT', &
      'VECTOR', 'SVECTOR', 'VELOCITY', 'ACCELERATION', 'STRESS', 'ELSTRESS', 'STRAIN', 'ELSTRAIN', 'FORCE', 'ELFORCE', &
      'SPCFORCES', 'MPCFORCES', 'OLOAD', 'GPFORCE', 'GPSTRESS', 'GPSTRAIN', 'GPSDCON', 'ELSDCON', 'GPKE', 'ESE', 'EKE', &
      'EDE', 'STRFIELD', 'SURFACE', 'VOLUME', 'BOUTPUT', 'DATAREC', 'THERMAL', 'FLUX', 'HOUTPUT', 'ENTHALPY', 'MEFFMASS', &
      'MODALKE', 'OTIME', 'OFREQUENCY', 'OMODES', 'PLOTID', 'SETP', 'XYPLOT', 'XYPRINT', 'SEALL', 'VUGRID', &
      'ELDATA', 'MPFACTOR', 'EQUILIBRIUM', 'ELSTRN', 'PLSTRN', 'THSTRN', 'OTEMP', 'MAXMIN', 'NOUTPUT', 'SDISPLACEMEN', &
      'PRESSURES', 'BCRESULTS', 'BGRESULTS', 'BOLTRESULTS', 'GKRESULTS', 'MODALSE', 'PARTN', 'PFMODE', 'FILE', 'MEMORY', &
      'CHKPNT', 'PROJ', 'GPRSORT', 'SHELLTHK', 'OUTRCV', 'MATPRN', &                      ! output requests
      'SUPER', 'SEDR', 'SEFINAL', 'SELG', 'SELR', 'SEMG', 'SEMR', 'SEKR', 'SEEXCLUDE', 'EXTSEOUT', &   ! superelements
      'DESOBJ', 'DESSUB', 'DESGLB', 'MODTRAK', 'DSAPRT', 'DRSPAN', &                                   ! optimisation
      'TRIM', 'FMETHOD', 'AESYMXZ', 'AESYMXY', 'AECONFIG', 'AEROF', 'APRESSURE', 'MONITOR', 'DIVERG', & ! air
      'CMETHOD', 'TSTEP', 'TSTEPNL', 'IC', 'RIGID', 'NLOPRM', 'BC', 'SEQDEP'] ! of other kinds of analysis
   ! of the bulk data: plots, and properties and materials of unsupported elements
   character(8), parameter :: card_names(141) = [character(8) :: &
      'MAT4', 'MAT5', 'DTI', 'BCTPARM', 'BGPARM', &
      'PLOTEL', 'PLOTEL3', 'PLOTEL4', 'PLOTEL6', 'PLOTEL8', 'ECHOON', 'ECHOOFF', 'NLPARM', 'PBCOMP', &
      'PBEND', 'PBUSH1D', 'PCOMPS', 'PFAST', 'PGAP', 'PLPLANE', 'PLSOLID', &
      'PRAC2D', 'PRAC3D', 'PSHEAR', 'PTUBE', 'PWELD', 'MAT3', &
      'MAT10', 'MAT11', 'TABLEM1', 'MDLPRM', 'ABSNMVS', 'ABSTRCT', &
      'DEBUG', 'USET', 'USET1', 'SNORM', 'SEQGP', 'CBARAO', 'RVDOF', 'RVDOF1', 'TABLEM2', 'TABLEM3', 'TABLEM4', 'TABLEST', &
      'MATHP', 'PDAMPT', 'PDAMP5', 'PFASTT', 'ACMODL', 'SWLDPRM', 'GROUP', &
      ! optimisation
      'DESVAR', 'DCONSTR', 'DCONADD', 'DRESP1', 'DRESP2', 'DRESP3', 'DVPREL1', 'DVPREL2', 'DVMREL1', 'DVMREL2', 'DVCREL1', &
      'DVCREL2', 'DVGRID', 'DVBSHAP', 'DVSHAP', 'DVTREL1', 'DVLREL1', 'DOPTPRM', 'DLINK', 'DTABLE', 'DEQATN', 'DSCREEN', &
      'DDVAL', 'TOPVAR', 'DMNCON', 'MODTRAK', &
      ! air
      'AERO', 'AEROS', 'CAERO1', 'CAERO2', 'CAERO3', 'CAERO4', 'CAERO5', 'PAERO1', 'PAERO2', 'PAERO3', 'PAERO4', 'PAERO5', &
      'SPLINE1', 'SPLINE2', 'SPLINE3', 'SPLINE4', 'SPLINE5', 'SET1', 'SET2', 'SET3', 'FLFACT', 'FLUTTER', 'MKAERO1', 'MKAERO2', &
      'TRIM', 'AESTAT', 'AESURF', 'AESURFS', 'AELIST', 'AEFACT', 'AELINK', 'AEPARM', 'AECOMP', 'AECOMPL', 'MONPNT1', 'MONPNT2', &
      'MONPNT3', 'MONDSP1', 'DIVERG', 'CSSCHD', 'GUST', &
      ! sets of other kinds of analysis, which no key of statics, modes or response selects
      'TLOAD1', 'TLOAD2', 'TSTEP', 'TSTEP1', 'TSTEPNL', 'TIC', 'EIGB', 'EIGC', 'EIGP', 'TF', 'NLPCI', 'NLSTEP', 'RANDT1', &
      'RANDPS', 'TABRND1', 'TABRNDG', 'DEFORM', &
      ! superelements, and points of controls without structure
      'SELABEL', 'SETREE', 'SEBNDRY', 'SEELT', 'EPOINT']

   ! with an effect on a response: springs that depend on the frequency
   character(6), parameter, public :: of_response(1) = [character(6) :: 'PELAST']
   ! with an effect on modes: reduction to some of the unknowns
   character(7), parameter, public :: of_reduction(11) = [character(7) :: 'CSET', 'CSET1', 'OMIT', 'OMIT1', 'SESET', 'SEBSET', &
      'SEBSET1', 'SECSET', 'SECSET1', 'SEQSET', 'SEQSET1']

   character(7), parameter :: own_cards(22) = [character(7) :: 'JOINT', 'CJOINT', 'PJOINT', 'JNORM', 'JSHEAR', 'JIWAN', 'JGAP', &
      'JINCR', 'JAMPL', 'BOLT', 'BLOCK2', 'BLOCK3', 'PMARK', 'NODEAT', 'SHELLTO', 'PAXIS', 'PLOADE', 'PLOADM', 'FORCEM', 'SPCM', &
      'RBE2M', 'RBE3M']

contains

   !> The word of case control without effect that KEY stands for, in at least four letters or in the plural; empty: none.
   pure function control_habit(key) result(word)
      character(*), intent(in)  :: key !! in capitals
      character(:), allocatable :: word
      integer :: i

      word = ''
      do i = 1, size(control_words)
         word = trim(control_words(i))
         if (key == word .or. (len(key) >= 4 .and. index(word, key) == 1)) return
         if (len(word) >= 4 .and. (key == word//'S' .or. key == word//'ES')) return
      end do
      word = ''
   end function control_habit

   !> Whether a card of bulk data has no effect, by its NAME.
   pure logical function is_idle_card(name)
      character(*), intent(in) :: name

      is_idle_card = any(card_names == name)
   end function is_idle_card

   !> Whether a card with this NAME is one of the program's own, in which 0 is a number.
   pure logical function is_own_card(name)
      character(*), intent(in) :: name

      is_own_card = any(own_cards == name)
   end function is_own_card

end module nastran_words
