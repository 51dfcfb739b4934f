!> The seam of distribution in the program for several processes: PETSc on all that mpirun has started.
submodule(distribution) several_processes
   use, intrinsic :: iso_c_binding, only: c_funloc, c_null_ptr
   use c_library, only: end_run
   use case_control, only: offer_petsc, solver_mumps, solver_petsc
   use dealt_pieces, only: deal_pieces, dealt_pieces_type
   use distributed_matrix, only: check
   use distributed_solution, only: by_gamg, by_mumps, set_library_options
   use engine, only: end_engine, obey, order, order_end, order_memory
   use incomplete_results, only: watch_ends
   use own_piece, only: writes_by
   use petsc_library, only: petsc_finalize, petsc_initialize, petsc_pop_signal_handler, petsc_push_error_handler, &
                            petsc_return_error_handler
   use petsc_solver, only: petsc_solver_type
   use omp_lib, only: omp_get_max_threads
   use kinds, only: wp
   use ranks, only: find_ranks, leave_ranks, n_ranks, rank
   use solver_weighing, only: solver_work_type, weigh_solvers, weighed, weighing_words
   implicit none

contains

   module subroutine join_processes(write_piece)
      procedure(piece_writer) :: write_piece

      call find_ranks()
      call offer_petsc()
      call set_library_options()
      call check(petsc_initialize())
      call check(petsc_pop_signal_handler())
      call check(petsc_push_error_handler(c_funloc(petsc_return_error_handler), c_null_ptr))
      call writes_by(write_piece)
      if (rank == 0) return
      call watch_ends() ! rank 0 has its own watch, and files
      call obey()
      call leave()
      call end_run(0)
   end subroutine join_processes

   module subroutine leave_processes()
      call order(order_end)
      call leave()
   end subroutine leave_processes

   subroutine leave()
      call end_engine()
      call check(petsc_finalize())
      call leave_ranks()
   end subroutine leave

   module subroutine choose_distributed(wanted, system)
      integer, intent(in) :: wanted
      class(equation_system), allocatable, intent(out) :: system
      type(petsc_solver_type), allocatable :: solver

      if (wanted /= solver_petsc .and. wanted /= solver_mumps) return
      allocate (solver)
      solver%wanted = merge(by_mumps, by_gamg, wanted == solver_mumps)
      call move_alloc(solver, system)
   end subroutine choose_distributed

   module subroutine weigh_distributed(work, system)
      type(solver_work_type), intent(inout) :: work
      class(equation_system), allocatable, intent(out) :: system
      real(wp) :: seconds(size(weighed))
      integer  :: best

      work%processes = n_ranks
      work%threads = omp_get_max_threads()
      call weigh_solvers(work, seconds, best)
      call choose_distributed(best, system)
      if (allocated(system)) system%description%reason = weighing_words(work)
   end subroutine weigh_distributed

   module subroutine deal_bodies(model, system, dealt)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      class(dealt_bodies_type), allocatable, intent(out) :: dealt
      type(dealt_pieces_type), allocatable :: pieces

      if (n_ranks == 1) return
      select type (system)
      type is (petsc_solver_type)
         allocate (pieces)
         call deal_pieces(model, system%deal%owner, pieces)
         call move_alloc(pieces, dealt)
      end select
   end subroutine deal_bodies

   module subroutine memory_of_all(bytes)
      real(wp), intent(out) :: bytes
      real(wp) :: values(1)

      values = 0.0_wp
      call order(order_memory, values=values)
      bytes = values(1)
   end subroutine memory_of_all

end submodule several_processes
