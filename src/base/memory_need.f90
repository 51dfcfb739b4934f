!> What a factor needs against what the machine has: the message, before anything is started.
module memory_need
   use failures, only: failure_type
   use kinds, only: wp
   use machine, only: memory_for
   use text_tools, only: integer_text
   implicit none
   private

   public :: check_memory

contains

   !> A failure where so many BYTES for the factor of N equations are more than can be had; its message says what would fit.
   subroutine check_memory(n, dimension, how, bytes, failure)
      integer, intent(in)               :: n          !! unknowns
      integer, intent(in)               :: dimension  !! of the model; 1: a bound without fill
      character(*), intent(in)          :: how        !! 'about', 'at least'
      real(wp), intent(in)              :: bytes
      type(failure_type), intent(inout) :: failure
      real(wp), parameter :: inverse_growth(3) = [1.0_wp, 0.9_wp, 0.75_wp] ! bytes grow like n, n log n, n**(4/3)
      character(:), allocatable :: at_most
      real(wp) :: there, fits

      there = real(memory_for(bytes), wp)
      if (bytes <= there) return
      fits = n*(there/bytes)**inverse_growth(dimension)
      at_most = how
      if (how == 'at least') at_most = 'at most'
      call failure%raise('the factor of '//integer_text(n)//' equations needs '//how//' '// &
                         mebibytes(bytes)//' MiB, and the machine has '//mebibytes(there)// &
                         ' MiB to give; of this shape '//at_most//' '//integer_text(int(fits))//' equations would fit')
   end subroutine check_memory


   pure function mebibytes(bytes) result(text)
      real(wp), intent(in)      :: bytes
      character(:), allocatable :: text

      text = integer_text(int(min(bytes/1048576.0_wp, real(huge(1), wp))))
   end function mebibytes

end module memory_need
