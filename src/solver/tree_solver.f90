!> The solver TREE: the fronts of a nested dissection, of which only those on the way from the joints to the root move. The same
!! dissection is laid out in up to three ways, and the one with least work over all increments is taken:
!! joints last: the bodies are condensed onto the joints, one dense front with all their unknowns is left;
!! joints inside: they stay where the dissection puts them;
!! joints last in parts: in every subtree up to some size they come last, the bodies are condensed piece by piece.
module tree_solver
   use equation_numbering, only: equation_numbers, number_unknowns
   use failures, only: failure_type
   use front_layout, only: front_layout_type, lay_out_fronts, postpone_joints
   use front_tree, only: front_tree_type, start_front_tree
   use kinds, only: long, wp
   use least_factor, only: least_factor_bytes
   use memory_need, only: check_memory
   use model_data, only: model_type
   use nested_dissection, only: dissect
   use node_graph, only: node_graph_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: start_tree_solver

   real(wp), parameter :: entry_operations = 25.0_wp !! what it costs to move one entry of a front, in operations on it

   integer, parameter :: part_nodes(3) = [200, 800, 3200] ! sizes of subtrees that are tried

   type, public :: tree_solver_type
      type(front_tree_type) :: tree
      character(:), allocatable :: way            !! in which the joints are laid out
      integer(long) :: factor_entries = 0
      real(wp) :: fixed_operations  = 0.0_wp      !! of one factorisation of the fronts that do not move
      real(wp) :: moving_operations = 0.0_wp      !! of the others, in every increment that factorises
      real(wp) :: moving_entries = 0.0_wp         !! of the fronts that move
   end type tree_solver_type

contains

   !> Order, number the unknowns, lay out the fronts for so many FACTORISATIONS with new stiffnesses of the joints.
   subroutine start_tree_solver(model, graph, in_joint, factorisations, numbers, solver, failure)
      type(model_type), intent(in)           :: model
      type(node_graph_type), intent(in)      :: graph
      logical, intent(in)                    :: in_joint(:) !! (n_nodes) whether joints or bolts act on a node
      integer, intent(in)                    :: factorisations
      class(equation_numbers), intent(inout) :: numbers
      type(tree_solver_type), intent(out)    :: solver
      type(failure_type), intent(inout)      :: failure
      type(front_layout_type) :: layout
      integer, allocatable    :: order(:), weight(:)
      integer :: i
      logical :: ok

      allocate (weight(model%n_nodes))
      do i = 1, model%n_nodes
         weight(i) = merge(count(.not. model%held(:, i)), 0, model%used(i))
      end do
      call check_memory(sum(weight), 1, 'at least', least_factor_bytes(graph, weight), failure)
      if (failure%raised) return
      call dissect(graph, weight > 0, order, ok)
      if (.not. ok) then
         call failure%raise('no memory to order '//integer_text(count(weight > 0))//' nodes')
         return
      end if
      call choose_layout(graph, order, weight, in_joint, factorisations, layout, solver%way)
      call check_memory(sum(weight), model%dimension, 'about', bytes_needed(layout, sum(weight), model%dimension), failure)
      if (failure%raised) return
      call number_unknowns(model, layout%order, numbers)
      call start_front_tree(model, numbers%number, layout, solver%tree)
      solver%factor_entries = int(layout%factor_entries, long)
      solver%fixed_operations = layout%fixed_operations
      solver%moving_operations = layout%moving_operations
      solver%moving_entries = layout%moving_entries
   end subroutine start_tree_solver


   !> The LAYOUT with least work for so many FACTORISATIONS, and in words which WAY it has with the joints. Parts are tried only
   !! where joints inside take less than joints last.
   subroutine choose_layout(graph, order, weight, in_joint, factorisations, layout, way)
      type(node_graph_type), intent(in)      :: graph
      integer, intent(in)                    :: order(:), weight(:), factorisations
      logical, intent(in)                    :: in_joint(:)
      type(front_layout_type), intent(inout) :: layout
      character(:), allocatable, intent(out) :: way
      integer, allocatable :: postponed(:)
      integer :: i

      way = 'LAST'
      call lay_out_fronts(graph, order, weight, in_joint, .true., layout)
      call compare_with(order, 'INSIDE')
      if (way == 'LAST') return
      do i = 1, size(part_nodes)
         postponed = order
         call postpone_joints(graph, in_joint, part_nodes(i), postponed)
         call compare_with(postponed, 'LAST IN PARTS')
      end do

   contains

      subroutine compare_with(other, its_way)
         integer, intent(in)      :: other(:)
         character(*), intent(in) :: its_way
         type(front_layout_type)  :: candidate

         call lay_out_fronts(graph, other, weight, in_joint, .false., candidate)
         if (total_work(candidate, factorisations) >= total_work(layout, factorisations)) return
         layout = candidate
         way = its_way
      end subroutine compare_with

   end subroutine choose_layout


   !> Operations of the whole run.
   pure real(wp) function total_work(layout, factorisations)
      type(front_layout_type), intent(in) :: layout
      integer, intent(in)                 :: factorisations

      total_work = layout%fixed_operations &
                   + factorisations*(layout%moving_operations + entry_operations*layout%moving_entries)
   end function total_work


   !> The factor; what moving fronts begin with: what is left to them, and elements, which are kept entry by entry and with two
   !! indices, those of a regular mesh; the update matrices on the way.
   pure real(wp) function bytes_needed(layout, n, dimension)
      type(front_layout_type), intent(in) :: layout
      integer, intent(in)                 :: n         !! unknowns
      integer, intent(in)                 :: dimension
      real(wp) :: of_elements

      of_elements = 0.5_wp*dimension*3**dimension*n
      bytes_needed = 8.0_wp*(layout%panel_entries + layout%peak_entries) + 16.0_wp*(layout%kept_entries + of_elements)
   end function bytes_needed

end module tree_solver
