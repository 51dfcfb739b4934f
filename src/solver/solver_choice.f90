!> Which solver a structure gets. A new one is a line here, and a word of case control.
module solver_choice
   use case_control, only: solver_auto, solver_skyline
   use distribution, only: choose_distributed
   use equation_solver, only: equation_system
   use kinds, only: long
   use model_data, only: model_type
   use node_graph, only: node_graph_type
   use skyline_solver, only: skyline_solver_type
   use tree_solver, only: tree_solver_type
   implicit none
   private

   public :: choose_solver

   ! AUTO takes SKYLINE for small structures, where the time does not matter and the method can be read, and for narrow ones,
   ! where it is the faster:
   integer, parameter :: small = 1000           ! unknowns
   integer, parameter :: narrow = 16            ! entries in a column, on the average
   integer, parameter :: most_tried = 100000    ! unknowns up to which the profile is looked at

contains

   !> The solver that case control WANTED, for N unknowns.
   subroutine choose_solver(model, graph, n, wanted, system)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n
      integer, intent(in)               :: wanted !! solver_* of case_control
      class(equation_system), allocatable, intent(out) :: system
      type(skyline_solver_type), allocatable :: candidate
      logical :: is_skyline

      call choose_distributed(wanted, system)
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
      else
         allocate (tree_solver_type :: system)
      end if
   end subroutine choose_solver

end module solver_choice
