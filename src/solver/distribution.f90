!> The seam to solvers that work on several processes. What is behind it is decided where the program is linked: src/serial, one
!! process and no such solver, or src/mpi, PETSc on the processes that mpirun has started.
module distribution
   use equation_solver, only: equation_system
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: has_distributed, join_processes, leave_processes, choose_distributed

   interface
      !> Whether the program has solvers that work on several processes.
      pure module logical function has_distributed()
      end function has_distributed

      !> At the start of the program: of several processes the first goes on, the others come back from here only at the end of
      !! the run, and end.
      module subroutine join_processes()
      end subroutine join_processes

      !> At its end: the other processes end too.
      module subroutine leave_processes()
      end subroutine leave_processes

      !> A solver for N unknowns, in a space of DIMENSION, where case control WANTED one of these, or AUTO finds it the cheaper;
      !! else it is left unallocated.
      module subroutine choose_distributed(graph, n, dimension, wanted, system)
         type(node_graph_type), intent(in) :: graph
         integer, intent(in)               :: n, dimension
         integer, intent(in)               :: wanted !! solver_* of case_control
         class(equation_system), allocatable, intent(out) :: system
      end subroutine choose_distributed
   end interface

end module distribution
