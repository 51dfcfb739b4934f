!> The seam to solvers that work on several processes. What is behind it is decided where the program is linked: src/serial, one
!! process and no such solver, or src/mpi, PETSc on the processes that mpirun has started.
module distribution
   use equation_solver, only: equation_system
   use kinds, only: wp
   use solver_weighing, only: solver_work_type
   implicit none
   private

   public :: join_processes, leave_processes, choose_distributed, weigh_distributed, memory_of_all

   interface
      !> At the start of the program: of several processes the first goes on, the others come back from here only at the end of
      !! the run, and end.
      module subroutine join_processes()
      end subroutine join_processes

      !> At its end: the other processes end too.
      module subroutine leave_processes()
      end subroutine leave_processes

      !> The solver that case control WANTED where it is one of these; else it is left unallocated.
      module subroutine choose_distributed(wanted, system)
         integer, intent(in) :: wanted !! solver_* of case_control
         class(equation_system), allocatable, intent(out) :: system
      end subroutine choose_distributed

      !> For AUTO: the one of these that does the WORK in less time than TREE, or has the memory that TREE would not have; else it is
      !! left unallocated.
      module subroutine weigh_distributed(work, system)
         type(solver_work_type), intent(inout) :: work !! how many processes and threads there are is set here
         class(equation_system), allocatable, intent(out) :: system
      end subroutine weigh_distributed

      !> The most memory that each process has had, added up; the others wait for orders.
      module subroutine memory_of_all(bytes)
         real(wp), intent(out) :: bytes
      end subroutine memory_of_all
   end interface

end module distribution
