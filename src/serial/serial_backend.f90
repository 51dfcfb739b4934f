!> Stands in for mpi_backend in the program of one process, which has no distributed solvers.
submodule(distribution) serial_backend
   use machine, only: peak_memory
   implicit none

contains

   module subroutine join_processes(write_piece)
      procedure(piece_writer) :: write_piece
      procedure(piece_writer), pointer :: told

      told => write_piece
      nullify (told) ! nobody has to be told
   end subroutine join_processes

   module subroutine leave_processes()
   end subroutine leave_processes

   module subroutine choose_distributed(wanted, system)
      integer, intent(in) :: wanted
      class(equation_system), allocatable, intent(out) :: system

      if (wanted < 0) deallocate (system) ! never true: there is no choice
   end subroutine choose_distributed

   module subroutine weigh_distributed(work, system)
      type(solver_work_type), intent(inout) :: work
      class(equation_system), allocatable, intent(out) :: system

      work%processes = 1
      if (work%processes < 1) deallocate (system) ! never true
   end subroutine weigh_distributed

   module subroutine distribute_bodies(model, system, output)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      class(subdomain_output_type), allocatable, intent(out) :: output

      if (model%n_nodes < 0 .and. system%n < 0) deallocate (output) ! never true
   end subroutine distribute_bodies

   module subroutine memory_of_all(bytes)
      real(wp), intent(out) :: bytes

      bytes = real(peak_memory(), wp)
   end subroutine memory_of_all

end submodule serial_backend
