!> The processes of a run, as MPI numbers them from 0 on. Rank 0 reads, steps and writes; the others wait for its commands.
module ranks
   use mpi_f08, only: mpi_abort, mpi_allreduce, mpi_bcast, mpi_character, mpi_comm_rank, mpi_comm_size, mpi_comm_world, &
                      mpi_double_precision, mpi_finalize, mpi_gatherv, mpi_init, mpi_integer, mpi_max, mpi_recv, mpi_scatterv, &
                      mpi_send, mpi_status_ignore, mpi_sum
   use incomplete_results, only: remove_incomplete
   use kinds, only: wp
   use, intrinsic :: iso_fortran_env, only: error_unit
   implicit none
   private

   public :: find_ranks, leave_ranks, tell, send, receive, scatter, gather, largest_of_all, sum_of_all, give_up

   integer, public, protected :: rank = 0, n_ranks = 1

   interface send
      module procedure :: send_integers, send_reals, send_text
   end interface send

   interface receive
      module procedure :: receive_integers, receive_reals, receive_text
   end interface receive

contains

   !> How many there are, and which one this is.
   subroutine find_ranks()
      call mpi_init()
      call mpi_comm_rank(mpi_comm_world, rank)
      call mpi_comm_size(mpi_comm_world, n_ranks)
   end subroutine find_ranks

   subroutine leave_ranks()
      call mpi_finalize()
   end subroutine leave_ranks

   !> WORDS of rank 0 become those of all.
   subroutine tell(words)
      integer, intent(inout) :: words(:)

      call mpi_bcast(words, size(words), mpi_integer, 0, mpi_comm_world)
   end subroutine tell

   subroutine send_integers(to, values)
      integer, intent(in) :: to, values(:)

      call mpi_send([size(values)], 1, mpi_integer, to, 1, mpi_comm_world)
      call mpi_send(values, size(values), mpi_integer, to, 2, mpi_comm_world)
   end subroutine send_integers

   subroutine send_reals(to, values)
      integer, intent(in)  :: to
      real(wp), intent(in) :: values(:)

      call mpi_send([size(values)], 1, mpi_integer, to, 1, mpi_comm_world)
      call mpi_send(values, size(values), mpi_double_precision, to, 3, mpi_comm_world)
   end subroutine send_reals

   subroutine send_text(to, text)
      integer, intent(in)      :: to
      character(*), intent(in) :: text

      call mpi_send([len(text)], 1, mpi_integer, to, 1, mpi_comm_world)
      call mpi_send(text, len(text), mpi_character, to, 4, mpi_comm_world)
   end subroutine send_text

   !> What rank 0 has sent.
   subroutine receive_integers(values)
      integer, allocatable, intent(out) :: values(:)
      integer :: n

      call mpi_recv(n, 1, mpi_integer, 0, 1, mpi_comm_world, mpi_status_ignore)
      allocate (values(n))
      call mpi_recv(values, n, mpi_integer, 0, 2, mpi_comm_world, mpi_status_ignore)
   end subroutine receive_integers

   subroutine receive_reals(values)
      real(wp), allocatable, intent(out) :: values(:)
      integer :: n

      call mpi_recv(n, 1, mpi_integer, 0, 1, mpi_comm_world, mpi_status_ignore)
      allocate (values(n))
      call mpi_recv(values, n, mpi_double_precision, 0, 3, mpi_comm_world, mpi_status_ignore)
   end subroutine receive_reals

   subroutine receive_text(text)
      character(:), allocatable, intent(out) :: text
      integer :: n

      call mpi_recv(n, 1, mpi_integer, 0, 1, mpi_comm_world, mpi_status_ignore)
      allocate (character(n) :: text)
      call mpi_recv(text, n, mpi_character, 0, 4, mpi_comm_world, mpi_status_ignore)
   end subroutine receive_text

   !> OWN: the next COUNTS(rank) of ALL, which rank 0 has, and COUNTS with it.
   subroutine scatter(all, counts, own)
      real(wp), intent(in)  :: all(:)
      integer, intent(in)   :: counts(:) !! (ranks)
      real(wp), intent(out) :: own(:)
      integer :: first(size(counts)), i

      first = [(sum(counts(:i - 1)), i = 1, size(counts))]
      call mpi_scatterv(all, counts, first, mpi_double_precision, own, size(own), mpi_double_precision, 0, mpi_comm_world)
   end subroutine scatter

   !> The reverse: ALL of rank 0 from the OWN of each.
   subroutine gather(own, counts, all)
      real(wp), intent(in)    :: own(:)
      integer, intent(in)     :: counts(:) !! (ranks)
      real(wp), intent(inout) :: all(:)
      integer :: first(size(counts)), i

      first = [(sum(counts(:i - 1)), i = 1, size(counts))]
      call mpi_gatherv(own, size(own), mpi_double_precision, all, counts, first, mpi_double_precision, 0, mpi_comm_world)
   end subroutine gather

   real(wp) function largest_of_all(value) result(largest)
      real(wp), intent(in) :: value

      call mpi_allreduce(value, largest, 1, mpi_double_precision, mpi_max, mpi_comm_world)
   end function largest_of_all

   real(wp) function sum_of_all(value) result(total)
      real(wp), intent(in) :: value

      call mpi_allreduce(value, total, 1, mpi_double_precision, mpi_sum, mpi_comm_world)
   end function sum_of_all

   !> No process can go on: say why, leave no incomplete file, end all of them with status 3.
   subroutine give_up(why)
      character(*), intent(in) :: why

      write (error_unit, '(a,i0,2a)') 'jointfem, process ', rank, ': ', why
      call remove_incomplete()
      call mpi_abort(mpi_comm_world, 3)
   end subroutine give_up

end module ranks
