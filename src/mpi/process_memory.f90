!> The memory of one process: what its rows will need is told before they are formed, and what BLAS takes is taken in time.
module process_memory
   use blas_lapack, only: dpotrf
   use kinds, only: wp
   use machine, only: available_memory
   use memory_need, only: shortage
   use ranks, only: give_up, rank
   use shares, only: share_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: reserve_blas, check_rows, bytes_of_rows

   real(wp), parameter :: entry_bytes = 30.0_wp !! measured, of an entry of the matrix: itself, coarser levels, what makes these

contains

   !> BLAS takes a buffer at its first call that needs one; where it cannot have that it tries for ever. So it has to be there now.
   subroutine reserve_blas()
      real(wp) :: one(1, 1)
      integer  :: info

      if (available_memory() <= 0) call give_up('the memory that is allowed does not suffice for BLAS')
      one = 1.0_wp
      call dpotrf('L', 1, one, 1, info)
   end subroutine reserve_blas

   !> Ends the run where the machine does not have what the rows of SHARE need.
   subroutine check_rows(share)
      type(share_type), intent(in) :: share
      character(:), allocatable :: words
      real(wp) :: part

      call shortage('the equations of process '//integer_text(rank)//' need about', &
                    bytes_of_rows(real(share%dimension, wp)**2*(sum(real(share%inside, wp)) + sum(real(share%outside, wp)))), &
                    words, part)
      if (words /= '') call give_up(words)
   end subroutine check_rows

   !> Bytes for a matrix of so many ENTRIES, with the preconditioner GAMG.
   pure real(wp) function bytes_of_rows(entries)
      real(wp), intent(in) :: entries

      bytes_of_rows = entry_bytes*entries
   end function bytes_of_rows

end module process_memory
