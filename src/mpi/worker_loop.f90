!> Runs the command loop of all processes: rank 0 broadcasts commands, and every process does its part.
!! A process has its subdomain, its rows of the matrix and its part of the solution. The loop serves one structure at a time and
!! ends with the run. The memory for the rows of a process is checked before they are formed, and BLAS takes its buffer in time.
module worker_loop
   use blas_lapack, only: dpotrf
   use distributed_matrix, only: distributed_matrix_type, finish_matrix, free_matrix, multiply_by_matrix, read_diagonal, &
                                 read_touched, start_matrix, write_touched
   use distributed_solution, only: distributed_solution_type, forget_vectors, free_solution, renew_preconditioner, solve_distributed
   use kinds, only: wp
   use machine, only: available_memory, peak_memory, return_memory
   use memory_need, only: shortage
   use model_data, only: model_type
   use partition, only: pass_subdomain, subdomain_type
   use ranks, only: give_up, rank, sum_of_all, tell
   use subdomain_output, only: forget_piece, receive_piece, write_received
   use text_tools, only: integer_text
   implicit none
   private

   public :: broadcast_command, serve, free_worker

   real(wp), parameter :: entry_bytes = 30.0_wp !! measured memory of a matrix entry with its coarser levels and their set-up

   integer, parameter, public :: command_end = 0, command_take = 1, command_start = 2, command_finish = 3, command_read = 4, &
                                 command_write = 5, command_renew = 6, command_solve = 7, command_multiply = 8, &
                                 command_diagonal = 9, command_forget = 10, command_way = 11, command_memory = 12, &
                                 command_cut = 13, command_show = 14

   type(subdomain_type), public                :: subdomain
   type(distributed_matrix_type), public   :: stiffness
   type(distributed_solution_type), public :: solution
   logical, public, protected :: is_running = .false. !! a matrix exists
   real(wp), public, protected :: stiffest = 0.0_wp   !! largest entry of its diagonal [force/length]

contains

   !> Rank 0: broadcast the command WHAT with its WORDS; then do its own part.
   subroutine broadcast_command(what, words, values)
      integer, intent(in)               :: what               !! command_*
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
   end subroutine broadcast_command

   !> Other ranks: serve commands until the end.
   subroutine serve()
      integer  :: head(2)
      integer, allocatable :: words(:)
      real(wp) :: nothing(0)

      do
         call tell(head)
         allocate (words(head(2)))
         call tell(words)
         if (head(1) == command_end) exit
         call act(head(1), words, nothing)
         deallocate (words)
      end do
   end subroutine serve

   !> Do the part of this process in a command.
   subroutine act(what, words, values)
      integer, intent(in)     :: what, words(:)
      real(wp), intent(inout) :: values(:)
      character(:), allocatable :: shortfall
      real(wp) :: bytes, one(1, 1), part
      integer  :: info

      select case (what)
      case (command_take)
         call free_worker()
         call forget_piece()
         call return_memory()
         ! BLAS takes its buffer at its first call that needs one, and without memory tries for ever: it takes the buffer now
         if (available_memory() <= 0) call give_up('the permitted memory does not suffice for BLAS')
         one = 1.0_wp
         call dpotrf('L', 1, one, 1, info)
         if (rank /= 0) then
            subdomain = subdomain_type()
            call pass_subdomain(rank, subdomain)
         end if
      case (command_start)                                     ! words: see start_matrix
         call shortage('the equations of process '//integer_text(rank)//' need about', &
                       entry_bytes*real(subdomain%dimension, wp)**2* &
                       (sum(real(subdomain%inside, wp)) + sum(real(subdomain%outside, wp))), shortfall, part)
         if (shortfall /= '') call give_up(shortfall)
         call start_matrix(words, subdomain, stiffness)
         is_running = .true.
      case (command_finish)                                    ! words: the preconditioner
         call finish_matrix(subdomain, stiffness, stiffest)
         solution = distributed_solution_type(way=words(1))
         ! free what only the construction of the matrix needs
         subdomain%model = model_type()
         deallocate (subdomain%block, subdomain%held, subdomain%held_own, subdomain%inside, subdomain%outside, subdomain%motions)
      case (command_read)
         call read_touched(subdomain%dimension, stiffness, values)
      case (command_write)
         call write_touched(subdomain%dimension, values, stiffness)
      case (command_renew)
         call renew_preconditioner(stiffness, solution)
      case (command_solve)                                     ! words: digits; most steps; 1: for later first guesses, 0
         call solve_distributed(words, stiffness, solution, values)
      case (command_diagonal)
         call read_diagonal(stiffness, values)
      case (command_way)                                       ! words: the preconditioner
         call free_solution(solution)
         solution = distributed_solution_type(way=words(1))
      case (command_forget)
         call forget_vectors(solution%earlier)
      case (command_memory)
         bytes = sum_of_all(real(peak_memory(), wp))
         if (rank == 0) values = bytes
      case (command_multiply)
         call multiply_by_matrix(stiffness, values)
      case (command_cut)                                       ! rank 0 sends, see mpi_backend
         if (rank /= 0) call receive_piece()
      case (command_show)                                      ! rank 0 sends, see mpi_backend
         if (rank /= 0) call write_received()
      end select
   end subroutine act

   !> Free what this process holds of the structure.
   subroutine free_worker()
      if (is_running) then
         call free_solution(solution)
         call free_matrix(stiffness)
      end if
      is_running = .false.
   end subroutine free_worker

end module worker_loop
