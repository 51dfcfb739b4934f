!> The branches of the shear law as jointfit names and numbers them.
module fit_branches
   implicit none
   private

   integer, parameter, public :: fit_load = 1, fit_unload = 2, fit_reload = 3

   character(6), parameter, public :: branch_words(3) = [character(6) :: 'LOAD', 'UNLOAD', 'RELOAD']
   character(1), parameter, public :: branch_letters(3) = ['a', 'b', 'c'] !! of the coefficients, as in Eqs. (3b), (5), (6)

   public :: branch_number

contains

   !> The number of the branch called WORD (in capitals), 0 for any other word.
   pure integer function branch_number(word) result(branch)
      character(*), intent(in) :: word

      do branch = size(branch_words), 1, -1
         if (branch_words(branch) == word) return
      end do
   end function branch_number

end module fit_branches
