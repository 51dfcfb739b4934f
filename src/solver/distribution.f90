!> The seam to solvers that work on several processes. What is behind it is decided where the program is linked: src/serial, one
!! process and no such solver, or src/mpi, PETSc on the processes that mpirun has started.
module distribution
   use dealt_bodies, only: dealt_bodies_type, piece_writer
   use equation_solver, only: equation_system
   use kinds, only: wp
   use model_data, only: model_type
   use solver_weighing, only: solver_work_type
   implicit none
   private

   public :: join_processes, leave_processes, choose_distributed, weigh_distributed, deal_bodies, memory_of_all

   interface
      !> At the start of the program: of several processes the first goes on, the others come back from here only at the end of
      !! the run, and end; WRITE_PIECE is what all do where a piece of the bodies is to be written.
      module subroutine join_processes(write_piece)
         procedure(piece_writer) :: write_piece
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

      !> DEALT: the bodies of MODEL as the processes of SYSTEM write them; left unallocated where the equations are those of one process.
      module subroutine deal_bodies(model, system, dealt)
         type(model_type), intent(in)       :: model
         class(equation_system), intent(in) :: system
         class(dealt_bodies_type), allocatable, intent(out) :: dealt
      end subroutine deal_bodies

      !> The most memory that each process has had, added up; the others wait for orders.
      module subroutine memory_of_all(bytes)
         real(wp), intent(out) :: bytes
      end subroutine memory_of_all
   end interface

end module distribution
