!> Which solver a structure gets. A new one is a line here, and a word of case control.
module solver_choice
   use control_words, only: solver_auto, solver_skyline
   use distribution, only: choose_distributed, n_processes, solver_work_type, weigh_solvers, weighed, weighing_words
   use equation_solver, only: equation_system
   use kinds, only: long, wp
   use machine, only: memory_for
   use model_data, only: model_type
   use node_graph, only: node_graph_type
   use omp_lib, only: omp_get_max_threads
   use skyline_solver, only: skyline_solver_type
   use tree_solver, only: tree_solver_type
   implicit none
   private

   public :: choose_solver

   ! AUTO takes SKYLINE for small structures, where time does not matter and the method is easy to read, and for narrow ones,
   ! where SKYLINE is faster:
   integer, parameter :: small = 1000           ! unknowns
   integer, parameter :: narrow = 16            ! average entries in a column
   integer, parameter :: most_tried = 100000    ! unknowns up to which the profile is examined

contains

   !> The solver that case control WANTED, for N unknowns and FACTORISATIONS expected factorisations, each for ONCE one solution.
   subroutine choose_solver(model, graph, n, wanted, factorisations, once, system)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n, factorisations
      integer, intent(in)               :: wanted !! solver_* of case_control
      logical, intent(in)               :: once
      class(equation_system), allocatable, intent(out) :: system
      type(skyline_solver_type), allocatable :: candidate
      type(tree_solver_type), allocatable :: tree
      type(solver_work_type) :: work
      real(wp) :: seconds(size(weighed))
      integer  :: best
      logical  :: is_skyline

      if (n > 0) call choose_distributed(wanted, system)
      if (allocated(system)) return
      is_skyline = wanted == solver_skyline
      if (wanted == solver_auto .and. n <= most_tried) then
         allocate (candidate)
         call candidate%lay_out(model, graph)
         is_skyline = n <= small .or. candidate%profile <= int(narrow, long)*n
      end if
      if (is_skyline .and. allocated(candidate)) then
         call move_alloc(candidate, system)
      else if (is_skyline) then
         allocate (skyline_solver_type :: system)
      else                        ! TREE with its fronts laid out; for AUTO its operations and memory decide
         allocate (tree)
         tree%factorisations = factorisations
         tree%solves_once = once
         call tree%lay_out(model, graph)
         if (wanted == solver_auto .and. tree%is_laid_out) then
            work%static_operations = tree%description%static_operations
            work%refactored_operations = tree%description%refactored_operations
            work%bytes = tree%bytes
            work%there = real(memory_for(work%bytes), wp)
            work%entries = real(model%mesh%dimension, wp)**2*(size(graph%neighbours) + real(model%mesh%n_nodes, wp))
            work%solutions = factorisations
            work%processes = n_processes
            work%threads = omp_get_max_threads()
            call weigh_solvers(work, seconds, best)
            call choose_distributed(best, system)
            if (allocated(system)) system%description%reason = weighing_words(work)
         end if
         if (.not. allocated(system)) call move_alloc(tree, system)
      end if
      system%factorisations = factorisations
   end subroutine choose_solver

end module solver_choice
