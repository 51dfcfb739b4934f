!> Numbers the processes of a run from 0 as MPI does, and passes data between them.
!! Rank 0 reads, steps and writes. The other ranks wait for its commands.
module ranks
   use mpi_f08, only: mpi_abort, mpi_allreduce, mpi_bcast, mpi_byte, mpi_comm_rank, mpi_comm_size, mpi_comm_world, &
                      mpi_double_precision, mpi_gatherv, mpi_init, mpi_integer, mpi_recv, mpi_scatterv, &
                      mpi_send, mpi_status_ignore, mpi_sum
   use incomplete_results, only: remove_incomplete
   use kinds, only: long, wp
   use, intrinsic :: iso_fortran_env, only: error_unit
   implicit none
   private

   public :: find_ranks, tell, pass, pass_text, scatter, gather, sum_of_all, give_up

   integer, public, protected :: rank = 0, n_ranks = 1

contains

   !> Number of processes, and rank of this one.
   subroutine find_ranks()
      call mpi_init()
      call mpi_comm_rank(mpi_comm_world, rank)
      call mpi_comm_size(mpi_comm_world, n_ranks)
   end subroutine find_ranks

   !> Broadcast WORDS of rank 0.
   subroutine tell(words)
      integer, intent(inout) :: words(:)

      call mpi_bcast(words, size(words), mpi_integer, 0, mpi_comm_world)
   end subroutine tell

   !> Send up to six variables or contiguous arrays of any intrinsic type but character from rank 0 to process R. Both processes
   !! call this with the same sizes.
   subroutine pass(r, a, b, c, d, e, f)
      integer, intent(in)               :: r
      class(*), intent(inout)           :: a(..)
      class(*), intent(inout), optional :: b(..), c(..), d(..), e(..), f(..)

      call pass_bytes(r, storage_size(a)/8*size(a, kind=long), a)
      if (present(b)) call pass_bytes(r, storage_size(b)/8*size(b, kind=long), b)
      if (present(c)) call pass_bytes(r, storage_size(c)/8*size(c, kind=long), c)
      if (present(d)) call pass_bytes(r, storage_size(d)/8*size(d, kind=long), d)
      if (present(e)) call pass_bytes(r, storage_size(e)/8*size(e, kind=long), e)
      if (present(f)) call pass_bytes(r, storage_size(f)/8*size(f, kind=long), f)
   end subroutine pass

   !> Send a text of any length from rank 0 to process R.
   subroutine pass_text(r, text)
      integer, intent(in)                      :: r
      character(:), allocatable, intent(inout) :: text
      integer :: n

      n = 0
      if (rank == 0) n = len(text)
      call pass(r, n)
      if (rank /= 0) allocate (character(n) :: text)
      call pass_bytes(r, int(n, long), text)
   end subroutine pass_text

   !> The N bytes of VALUES.
   subroutine pass_bytes(r, n, values)
      integer, intent(in)       :: r
      integer(long), intent(in) :: n
      type(*), intent(inout)    :: values(..)

      if (n > huge(0)) call give_up('a part of the structure is too large to be sent; more processes have smaller ones')
      if (rank == 0) then
         call mpi_send(values, int(n), mpi_byte, r, 1, mpi_comm_world)
      else
         call mpi_recv(values, int(n), mpi_byte, 0, 1, mpi_comm_world, mpi_status_ignore)
      end if
   end subroutine pass_bytes

   !> Scatter ALL of rank 0: OWN gets its COUNTS(rank) entries. Rank 0 alone needs COUNTS.
   subroutine scatter(all, counts, own)
      real(wp), intent(in)  :: all(:)
      integer, intent(in)   :: counts(:) !! (ranks)
      real(wp), intent(out) :: own(:)
      integer :: first(size(counts)), i

      first = [(sum(counts(:i - 1)), i = 1, size(counts))]
      call mpi_scatterv(all, counts, first, mpi_double_precision, own, size(own), mpi_double_precision, 0, mpi_comm_world)
   end subroutine scatter

   !> Gather the OWN of each rank into ALL of rank 0.
   subroutine gather(own, counts, all)
      real(wp), intent(in)    :: own(:)
      integer, intent(in)     :: counts(:) !! (ranks)
      real(wp), intent(inout) :: all(:)
      integer :: first(size(counts)), i

      first = [(sum(counts(:i - 1)), i = 1, size(counts))]
      call mpi_gatherv(own, size(own), mpi_double_precision, all, counts, first, mpi_double_precision, 0, mpi_comm_world)
   end subroutine gather

   real(wp) function sum_of_all(value) result(total)
      real(wp), intent(in) :: value

      call mpi_allreduce(value, total, 1, mpi_double_precision, mpi_sum, mpi_comm_world)
   end function sum_of_all

   !> Abort all processes with status 3: print the reason and leave no incomplete file.
   subroutine give_up(why)
      character(*), intent(in) :: why

      write (error_unit, '(a,i0,2a)') 'jointfem, process ', rank, ': ', why
      call remove_incomplete()
      call mpi_abort(mpi_comm_world, 3)
   end subroutine give_up

end module ranks
