!> The seam of distribution in the program that runs as one process: there are no solvers behind it.
submodule(distribution) one_process
   use machine, only: peak_memory
   implicit none

contains

   module subroutine join_processes()
   end subroutine join_processes

   module subroutine leave_processes()
   end subroutine leave_processes

   module subroutine choose_distributed(wanted, system)
      integer, intent(in) :: wanted
      class(equation_system), allocatable, intent(out) :: system

      if (wanted < 0) deallocate (system) ! never: there is nothing to choose
   end subroutine choose_distributed

   module subroutine weigh_distributed(work, system)
      type(solver_work_type), intent(inout) :: work
      class(equation_system), allocatable, intent(out) :: system

      work%processes = 1
      if (work%processes < 1) deallocate (system) ! never, likewise
   end subroutine weigh_distributed

   module subroutine memory_of_all(bytes)
      real(wp), intent(out) :: bytes

      bytes = real(peak_memory(), wp)
   end subroutine memory_of_all

end submodule one_process
