!> The interface to solvers that run on several processes. The linker chooses the implementation: src/serial, one process
!! without such a solver, or src/mpi, PETSc on the processes that mpirun has started.
module distribution
   use body_parts, only: body_piece_type
   use control_words, only: solver_mumps, solver_petsc, solver_tree
   use equation_solver, only: equation_system
   use kinds, only: wp
   use model_data, only: model_type, temperature_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: piece_writer, weigh_solvers, weighing_words, join_processes, leave_processes, choose_distributed, &
             distribute_bodies, memory_of_all

   integer, public, protected :: n_processes = 1 !! of the run; set by join_processes

   type, abstract, public :: subdomain_output_type
      integer :: n = 0 !! pieces
   contains
      procedure(write_pieces), deferred :: write
   end type subdomain_output_type

   abstract interface
      !> Write all pieces under the displacements U at this TEMPERATURE, each into its file, which exists and is empty. OK is
      !! false where a file could not be written.
      subroutine write_pieces(self, u, temperature, notes, files, ok)
         import :: subdomain_output_type, temperature_type, wp
         class(subdomain_output_type), intent(in) :: self
         real(wp), intent(in)               :: u(:, :)  !! (dimension, n_nodes) [length]
         type(temperature_type), intent(in) :: temperature
         character(*), intent(in)           :: notes    !! for the piece_writer
         character(*), intent(in)           :: files(:) !! (n) their names
         logical, intent(out)               :: ok
      end subroutine write_pieces

      !> Write one PIECE into FILE. Every process calls this routine for its own piece.
      subroutine piece_writer(piece, u, temperature, notes, file, ok)
         import :: body_piece_type, temperature_type, wp
         type(body_piece_type), intent(in)  :: piece
         real(wp), intent(in)               :: u(:, :)  !! (dimension, nodes of its model) [length]
         type(temperature_type), intent(in) :: temperature !! at these nodes
         character(*), intent(in)           :: notes, file
         logical, intent(out)               :: ok
      end subroutine piece_writer
   end interface

   !> The work of a run, and the number of processes that share it.
   type, public :: solver_work_type
      real(wp) :: static_operations = 0.0_wp  !! of TREE, once
      real(wp) :: refactored_operations = 0.0_wp !! of TREE, in every increment
      real(wp) :: bytes = 0.0_wp             !! memory that TREE needs
      real(wp) :: there = 0.0_wp             !! memory available to the process in which TREE runs
      real(wp) :: entries = 0.0_wp           !! of the stiffness matrix
      integer  :: solutions = 20             !! number of solutions, each with another joint stiffness
      integer  :: threads = 1, processes = 1
   end type solver_work_type

   integer, parameter, public :: weighed(3) = [solver_tree, solver_petsc, solver_mumps]

   ! Rates of one core that multiplies matrices at 60 GFlop/s, for blocks of 20 to 60 elements along each edge:
   real(wp), parameter :: tree_rate = 4.0e10_wp        ! operations in fronts [1/s]
   real(wp), parameter :: mumps_rate = 2.5e10_wp       ! the same of MUMPS, which refactors everything in each increment
   real(wp), parameter :: set_up_time = 2.2e-7_wp      ! set-up of GAMG, time of an entry [s]
   real(wp), parameter :: solution_time = 5.0e-8_wp    ! of an entry: some ten steps from the best initial guess [s]
   integer, parameter  :: solutions_a_set_up = 4       ! number of solutions for which a preconditioner is kept
   real(wp), parameter :: gain = 0.8_wp                ! relative speed gained by each further thread or process

   interface
      !> Called at the start of the program. The first process returns at once. The others serve it, return only at the end of
      !! the run, and end. WRITE_PIECE is called on all processes to write a piece of the bodies.
      module subroutine join_processes(write_piece)
         procedure(piece_writer) :: write_piece
      end subroutine join_processes

      !> Called at the end of the program: the other processes end too.
      module subroutine leave_processes()
      end subroutine leave_processes

      !> The distributed solver WANTED; unallocated where WANTED is none of these, or where there are none.
      module subroutine choose_distributed(wanted, system)
         integer, intent(in) :: wanted !! solver_* of case_control
         class(equation_system), allocatable, intent(out) :: system
      end subroutine choose_distributed

      !> OUTPUT: the bodies of MODEL as the processes of SYSTEM write them; unallocated where one process holds the equations.
      module subroutine distribute_bodies(model, system, output)
         type(model_type), intent(in)       :: model
         class(equation_system), intent(in) :: system
         class(subdomain_output_type), allocatable, intent(out) :: output
      end subroutine distribute_bodies

      !> The peak memory of each process, summed. The other processes serve.
      module subroutine memory_of_all(bytes)
         real(wp), intent(out) :: bytes
      end subroutine memory_of_all
   end interface

contains

   !> SECONDS of the solvers WEIGHED, and the BEST of them. Where a factor exceeds the memory only PETSC remains.
   pure subroutine weigh_solvers(work, seconds, best)
      type(solver_work_type), intent(in) :: work
      real(wp), intent(out)              :: seconds(size(weighed))
      integer, intent(out)               :: best !! solver_*

      associate (n => work%solutions, hands => 1.0_wp + gain*(work%processes - 1))
         seconds = [(work%static_operations + n*work%refactored_operations)/(tree_rate*(1.0_wp + gain*(work%threads - 1))), &
                    work%entries*(n*solution_time + (1 + n/solutions_a_set_up)*set_up_time)/hands, &
                    n*(work%static_operations + work%refactored_operations)/(mumps_rate*hands)]
      end associate
      best = weighed(minloc(seconds, dim=1, mask=[work%bytes <= work%there, .true., work%bytes <= work%there]))
   end subroutine weigh_solvers

   !> The reason for a solver other than TREE, for the listing.
   pure function weighing_words(work) result(words)
      type(solver_work_type), intent(in) :: work
      character(:), allocatable :: words
      real(wp) :: seconds(size(weighed))
      character(12) :: times(size(weighed))
      integer  :: best

      call weigh_solvers(work, seconds, best)
      words = ''
      if (best == solver_tree) return
      if (work%bytes > work%there) then
         words = 'AUTO: TREE WOULD NEED '//integer_text(nint(work%bytes/1048576.0_wp))//' MIB, MORE THAN AVAILABLE'
      else
         write (times, '(f12.1)') min(seconds/seconds(2), 1.0e6_wp)
         words = 'AUTO: BY ESTIMATE TREE TAKES '//trim(adjustl(times(1)))//' TIMES AS LONG AS PETSC, MUMPS '// &
                 trim(adjustl(times(3)))
      end if
   end function weighing_words

end module distribution
