!> Stands in for mpi_backend in the program of one process, which has no distributed solvers.
submodule(distribution) serial_backend
   use machine, only: peak_memory
   implicit none

contains

   module procedure join_processes
   end procedure join_processes

   module procedure leave_processes
   end procedure leave_processes

   module procedure choose_distributed
   end procedure choose_distributed

   module procedure distribute_bodies
   end procedure distribute_bodies

   module procedure memory_of_all
      bytes = real(peak_memory(), wp)
   end procedure memory_of_all

end submodule serial_backend
