!> The engine that all processes drive together: the share of this process, its rows of the matrix, its part of the solution. Rank 0
!! gives an order and does its part of it; the others take orders until the run ends. One structure at a time.
module engine
   use distributed_matrix, only: distributed_matrix_type, finish_matrix, free_matrix, matrix_times_vector, &
                                 read_diagonal, read_touched, reserve_touched, start_matrix, write_touched
   use distributed_solution, only: distributed_solution_type, free_solution, renew_preconditioner, solve_distributed, &
                                   start_solution
   use earlier_vectors, only: forget_vectors
   use kinds, only: wp
   use machine, only: peak_memory, return_memory
   use own_piece, only: forget_piece, receive_piece, write_received
   use process_memory, only: check_rows, reserve_blas
   use ranks, only: rank, sum_of_all, tell
   use shares, only: forget_elements, receive_share, share_type
   implicit none
   private

   public :: order, obey, end_engine

   integer, parameter, public :: order_end = 0, order_take = 1, order_start = 2, order_touched = 3, order_finish = 4, &
                                 order_read = 5, order_write = 6, order_renew = 7, order_solve = 8, order_multiply = 9, &
                                 order_diagonal = 10, order_forget = 11, order_way = 12, order_memory = 13, &
                                 order_cut = 14, order_show = 15

   type(share_type), public                :: share
   type(distributed_matrix_type), public   :: stiffness
   type(distributed_solution_type), public :: solution
   logical, public, protected :: is_running = .false. !! there is a matrix
   real(wp), public, protected :: stiffest = 0.0_wp   !! largest entry of its diagonal [force/length]

contains

   !> Rank 0: WHAT all are to do, with these WORDS to it; then it does its own part.
   subroutine order(what, words, values)
      integer, intent(in)               :: what               !! order_*
      integer, intent(in), optional     :: words(:)
      real(wp), intent(inout), optional :: values(:)          !! of rank 0: load and solution, touched blocks
      integer  :: head(2)
      integer, allocatable  :: all_words(:)
      real(wp), allocatable :: nothing(:)

      allocate (all_words(0), nothing(0))
      if (present(words)) all_words = words
      head = [what, size(all_words)]
      call tell(head)
      call tell(all_words)
      if (present(values)) then
         call act(what, all_words, values)
      else
         call act(what, all_words, nothing)
      end if
   end subroutine order

   !> The other ranks: do what is ordered, until the end.
   subroutine obey()
      integer  :: head(2)
      integer, allocatable :: words(:)
      real(wp) :: nothing(0)

      do
         call tell(head)
         allocate (words(head(2)))
         call tell(words)
         if (head(1) == order_end) exit
         call act(head(1), words, nothing)
         deallocate (words)
      end do
   end subroutine obey

   !> The part of this process in an order.
   subroutine act(what, words, values)
      integer, intent(in)     :: what, words(:)
      real(wp), intent(inout) :: values(:)
      real(wp) :: bytes

      select case (what)
      case (order_take)
         call end_engine()
         call forget_piece()
         call return_memory()
         call reserve_blas()
         if (rank /= 0) call receive_share(share)
      case (order_start)                                     ! words: blocks of each rank
         call check_rows(share)
         call start_matrix(share, words, stiffness)
         is_running = .true.
      case (order_finish)                                    ! words: the preconditioner
         call finish_matrix(share, stiffness, stiffest)
         call start_solution(words(1), solution)
         call forget_elements(share)
      case (order_touched)
         call take_touched(words)
      case (order_read)
         call read_touched(share%dimension, stiffness, values)
      case (order_write)
         call write_touched(share%dimension, values, stiffness)
      case (order_renew)
         call renew_preconditioner(share, stiffness, solution)
      case (order_solve)                                     ! words: digits; steps at most; 1, that it is noted, or 0
         call solve_distributed(words, stiffness, solution, values)
      case (order_diagonal)
         call read_diagonal(stiffness, values)
      case (order_way)                                       ! words: the preconditioner
         call free_solution(solution)
         call start_solution(words(1), solution)
      case (order_forget)
         call forget_vectors(solution%earlier)
      case (order_memory)
         bytes = sum_of_all(real(peak_memory(), wp))
         if (rank == 0) values = bytes
      case (order_multiply)
         call multiply(values)
      case (order_cut)                                       ! rank 0 sends, see dealt_pieces
         if (rank /= 0) call receive_piece()
      case (order_show)                                      ! likewise
         if (rank /= 0) call write_received()
      end select
   end subroutine act

   !> The touched blocks of the own rows out of WORDS: how many each rank has, then rows and columns of all.
   subroutine take_touched(words)
      integer, intent(in) :: words(:)
      integer :: first, n, n_ranks

      n_ranks = size(stiffness%counts)
      n = (size(words) - n_ranks)/2
      first = n_ranks + sum(words(:rank))
      associate (own => words(rank + 1))
         allocate (stiffness%touched(2, own))
         stiffness%touched(1, :) = words(first + 1:first + own)
         stiffness%touched(2, :) = words(first + n + 1:first + n + own)
      end associate
      stiffness%touched_counts = share%dimension**2*words(:n_ranks)
      call reserve_touched(share, stiffness)
   end subroutine take_touched

   subroutine multiply(values)
      real(wp), intent(inout) :: values(:)
      real(wp) :: product(size(values))

      call matrix_times_vector(values, stiffness, product)
      values = product
   end subroutine multiply

   !> Give back what this process has of the structure.
   subroutine end_engine()
      if (is_running) then
         call free_solution(solution)
         call free_matrix(stiffness)
      end if
      is_running = .false.
   end subroutine end_engine

end module engine
