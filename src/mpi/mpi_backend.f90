!> Provides the solvers and the output of several processes: PETSc on all processes that mpirun has started.
!! Rank 0 partitions the bodies as it partitions the equations. Every process writes its own piece.
submodule(distribution) mpi_backend
   use c_library, only: end_run
   use case_control, only: offer_petsc
   use distributed_matrix, only: end_at_error
   use distributed_solution, only: by_gamg, by_mumps, set_library_options
   use incomplete_results, only: watch_ends
   use mpi_f08, only: mpi_finalize
   use petscsys, only: PETSC_NULL_INTEGER, PetscFinalize, PetscInitialize
   use petsc_solver, only: petsc_solver_type
   use ranks, only: find_ranks, n_ranks, rank
   use subdomain_output, only: cut_pieces, write_all, writes_by
   use worker_loop, only: broadcast_command, command_cut, command_end, command_memory, command_show, free_worker, serve
   implicit none

   type, extends(subdomain_output_type) :: pieces_type
   contains
      procedure :: write => write_pieces_of_all
   end type pieces_type

contains

   module procedure join_processes
      integer :: code ! of PETSc, see end_at_error

      call find_ranks()
      n_processes = n_ranks
      call offer_petsc()
      call set_library_options()
      call PetscInitialize(code)
      call PetscPopSignalHandler(code)
      call PetscPushErrorHandler(end_at_error, PETSC_NULL_INTEGER, code)
      call writes_by(write_piece)
      if (rank == 0) return
      call watch_ends() ! rank 0 watches itself, and has files of its own
      call serve()
      call leave()
      call end_run(0)
   end procedure join_processes

   module procedure leave_processes
      call broadcast_command(command_end)
      call leave()
   end procedure leave_processes

   subroutine leave()
      integer :: code

      call free_worker()
      call PetscFinalize(code)
      call mpi_finalize()
   end subroutine leave

   module procedure choose_distributed
      type(petsc_solver_type), allocatable :: solver

      if (wanted /= solver_petsc .and. wanted /= solver_mumps) return
      allocate (solver)
      solver%wanted = merge(by_mumps, by_gamg, wanted == solver_mumps)
      call move_alloc(solver, system)
   end procedure choose_distributed

   module procedure distribute_bodies
      if (n_ranks == 1 .or. size(model%mesh%structural%place) > 0) return ! rank 0 has all shells and beams, and writes them
      select type (system)
      type is (petsc_solver_type)
         allocate (pieces_type :: output)
         output%n = n_ranks
         call broadcast_command(command_cut)
         call cut_pieces(model, system%parts%owner)
      end select
   end procedure distribute_bodies

   subroutine write_pieces_of_all(self, u, temperature, notes, files, ok)
      class(pieces_type), intent(in)     :: self
      real(wp), intent(in)               :: u(:, :)
      type(temperature_type), intent(in) :: temperature
      character(*), intent(in)           :: notes, files(:)
      logical, intent(out)               :: ok

      call broadcast_command(command_show)
      call write_all(u, temperature, notes, files(:self%n), ok)
   end subroutine write_pieces_of_all

   module procedure memory_of_all
      real(wp) :: values(1)

      values = 0.0_wp
      call broadcast_command(command_memory, values=values)
      bytes = values(1)
   end procedure memory_of_all

end submodule mpi_backend
