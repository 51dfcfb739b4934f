!> Judges the kind of analysis that a NASTRAN deck asks for, by SOL, APP or ANALYSIS, and the parts of a deck that describe a second
!! structure or change NASTRAN itself.
module nastran_solutions
   use case_entries, only: entry_type
   use deck_errors, only: deck_error_list
   use text_tools, only: one_of, upper
   implicit none
   private

   public :: is_direct, is_statics, judge_solution, starts_dmap, warn_of_dmap

   character(*), parameter :: offer = 'jointfem has statics (101, SESTATIC; 1, 24, 66, 106, NLSTATIC), modes (103, SEMODES; 3) '// &
                                      'and the response to an oscillating load (108, 111)'

   ! SOL in numbers and names: those of statics, modes and response
   character(*), parameter :: static = '|1|24|66|101|106|STATIC|STATICS|SESTATIC|SESTATICS|NLSTATIC|NLSTATICS|LINEAR|NONLINEAR|'
   character(*), parameter :: solved = static//'3|103|MODES|MODE|SEMODES|NORMAL|26|30|8|11|108|111|SEDFREQ|SEMFREQ|DFREQ|MFREQ|'
   character(*), parameter :: optimised = '|200|DESOPT|'
   ! APP and ANALYSIS
   character(*), parameter :: analysed = '|STATICS|STATIC|DISP|DISPLACEMENT|MODES|NLSTAT|NLSTATIC|NLSTATICS|MFREQ|DFREQ|'

   !> Other kinds of analysis, and their words in SOL, APP and ANALYSIS.
   type :: other_type
      character(180) :: words
      character(90)  :: kind
   end type other_type
   type(other_type), parameter :: others(9) = [ &
      other_type('|5|65|105|BUCKLING|SEBUCKL|BUCK|', 'buckling'), &
      other_type('|28|29|107|110|SEDCEIG|SEMCEIG|DCEIG|MCEIG|', 'complex eigenvalues'), &
      other_type('|27|31|109|112|129|99|SEDTRAN|SEMTRAN|NLTRAN|DTRAN|MTRAN|NLTRANS|', 'transient response'), &
      other_type('|21|75|144|145|146|AESTAT|SEFLUTTR|SEAERO|SAERO|FLUT|FLUTTER|DIVERG|DIVERGE|', 'aeroelasticity'), &
      other_type('|61|74|89|153|159|NLSCSH|NLTCSH|HEAT|HSTAT|HTRAN|', 'heat conduction'), &
      other_type('|47|48|114|115|116|118|CYCSTATX|CYCMODE|CYCBUCKL|CYCFREQ|', 'cyclic symmetry'), &
      other_type('|400|401|402|600|601|700|701|NONLIN|NLSTEP|', &
                 'a nonlinear analysis of other laws than those of joints (plasticity, large movements)'), &
      other_type('|RANDOM|PRELOAD|', 'an analysis that follows another one'), &
      other_type('|DMAP|100|USERDMAP|', 'a program of the user''s own in DMAP')]

contains

   !> Judge ENTRY, a SOL, APP or ANALYSIS. REFUSAL is the error message of a kind of analysis that is not available, WARNING what is done
   !! instead; both are empty where the analysis is as asked for.
   pure subroutine judge_solution(entry, refusal, warning)
      type(entry_type), intent(in)           :: entry
      character(:), allocatable, intent(out) :: refusal, warning
      character(:), allocatable :: word
      integer :: i

      refusal = ''
      warning = ''
      word = word_of(entry)
      if (word /= '||') then
         if (entry%key == 'SOL' .and. index(solved, word) > 0) return
         if (entry%key == 'SOL' .and. index(optimised, word) > 0) then
            warning = 'SOL '//word(2:len(word) - 1)//': the design of the property cards is analysed once; nothing is '// &
                      'optimised, and DESVAR, DVPREL1 and the like have no effect, initial values of DESVAR neither'
            return
         end if
         if (entry%key /= 'SOL' .and. index(analysed, word) > 0) return
      end if
      do i = 1, size(others)
         if (word == '||' .or. index(others(i)%words, word) == 0) cycle
         refusal = entry%key//': '//word(2:len(word) - 1)//' is '//trim(others(i)%kind)//'; '//offer
         return
      end do
      refusal = entry%key//': '//one_of(word == '||', 'no value', ''''//entry%value(:min(40, len(entry%value)))//'''')// &
                ', expected a kind of analysis; '//offer
   end subroutine judge_solution

   !> Whether ENTRY, a SOL, asks for statics: a METHOD = set has no effect.
   pure logical function is_statics(entry)
      type(entry_type), intent(in) :: entry

      is_statics = word_of(entry) /= '||' .and. index(static, word_of(entry)) > 0
   end function is_statics

   !> Whether ENTRY, a SOL, asks for the direct response, which needs no modes in case control.
   pure logical function is_direct(entry)
      type(entry_type), intent(in) :: entry

      is_direct = any(word_of(entry) == [character(9) :: '|8|', '|26|', '|108|', '|SEDFREQ|', '|DFREQ|'])
   end function is_direct

   !> The first word of the value of ENTRY between bars.
   pure function word_of(entry) result(word)
      type(entry_type), intent(in) :: entry
      character(:), allocatable :: word

      word = '|'//upper(entry%value(:scan(entry%value//',', ' ,(') - 1))//'|'
   end function word_of

   !> Whether the line with KEY starts instructions in DMAP, NASTRAN's own language, in executive control: they end at CEND.
   pure logical function starts_dmap(key)
      character(*), intent(in) :: key

      starts_dmap = any(key == [character(8) :: 'COMPILE', 'ALTER', 'MALTER', 'RFALTER', 'LINK'])
   end function starts_dmap

   !> Warn that the DMAP from line LINE on is not followed.
   pure subroutine warn_of_dmap(key, place, errors)
      character(*), intent(in)             :: key, place
      type(deck_error_list), intent(inout) :: errors

      call errors%warn(key//' ('//place//'): the DMAP up to CEND is not followed; where it changes the answer of NASTRAN, it '// &
                       'does not change this one')
   end subroutine warn_of_dmap

end module nastran_solutions
