!> The seam of distribution in the program that runs as one process: there are no solvers behind it.
submodule(distribution) one_process
   implicit none

contains

   pure module logical function has_distributed()
      has_distributed = .false.
   end function has_distributed

   module subroutine join_processes()
   end subroutine join_processes

   module subroutine leave_processes()
   end subroutine leave_processes

   module subroutine choose_distributed(graph, n, dimension, wanted, system)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n, dimension, wanted
      class(equation_system), allocatable, intent(out) :: system

      if (graph%n + n + dimension + wanted < 0) deallocate (system)
   end subroutine choose_distributed

end submodule one_process
