!> The solver TREE: the fronts of a nested dissection, of which only those on the way from the joints to the root move. The same
!! dissection is laid out in up to three ways, and the one with least work over all increments is taken:
!! joints last: the bodies are condensed onto the joints, one dense front with all their unknowns is left;
!! joints inside: they stay where the dissection puts them;
!! joints last in parts: in every subtree up to some size they come last, the bodies are condensed piece by piece.
module tree_solver
   use equation_numbering, only: number_unknowns
   use equation_solver, only: equation_system, solver_description
   use failures, only: failure_type
   use front_factor, only: add_to_moving, factorise_fixed
   use front_layout, only: front_layout_type, lay_out_fronts, postpone_joints
   use front_solve, only: eliminate_fixed, moving_times_vector, recover_fixed
   use front_tree, only: front_tree_type, largest_diagonal, start_front_tree
   use kinds, only: long, wp
   use memory_need, only: check_memory
   use model_data, only: model_type, n_bars, n_sections
   use moving_solution, only: forget_moving, form_moving, moving_factor_type, solve_with_joints
   use nested_dissection, only: dissect
   use node_graph, only: node_graph_type
   use text_tools, only: integer_text
   implicit none
   private

   real(wp), parameter :: entry_operations = 25.0_wp !! what it costs to move one entry of a front, in operations on it

   integer, parameter :: part_nodes(3) = [200, 800, 3200] ! sizes of subtrees that are tried

   type, extends(equation_system), public :: tree_solver_type
      type(front_tree_type) :: fronts
      type(moving_factor_type) :: factor          !! of the stiffness with the joints, and what is known of it
      character(:), allocatable :: way            !! in which the joints are laid out
      integer(long) :: factor_entries = 0
      real(wp) :: fixed_operations  = 0.0_wp      !! of one factorisation of the fronts that do not move
      real(wp) :: moving_operations = 0.0_wp      !! of the others, in every increment that factorises
   contains
      procedure :: start
      procedure :: form_bodies
      procedure :: add_to_bodies
      procedure :: lock
      procedure :: condense
      procedure :: form_structure
      procedure :: solve
      procedure :: multiply
      procedure :: recover
      procedure :: describe
   end type tree_solver_type

contains

   !> Order, number the unknowns, lay out the fronts for as many factorisations with new stiffnesses of the joints as are expected.
   !! The equations of the fronts that move are left to the increments.
   subroutine start(self, model, graph, failure)
      class(tree_solver_type), intent(inout) :: self
      type(model_type), intent(in)           :: model
      type(node_graph_type), intent(in)      :: graph
      type(failure_type), intent(inout)      :: failure
      type(front_layout_type) :: layout
      integer, allocatable    :: order(:), weight(:)
      logical, allocatable    :: in_joint(:)
      integer :: i
      logical :: ok

      allocate (weight(model%n_nodes))
      do i = 1, model%n_nodes
         weight(i) = merge(count(.not. model%held(:, i)), 0, model%used(i))
      end do
      call dissect(graph, weight > 0, order, ok)
      if (.not. ok) then
         call failure%raise('no memory to order '//integer_text(count(weight > 0))//' nodes')
         return
      end if
      call mark_joints(model, in_joint)
      call choose_layout(graph, order, weight, in_joint, self%factorisations, layout, self%way)
      call check_memory(sum(weight), model%dimension, bytes_needed(layout, sum(weight), model%dimension), failure)
      if (failure%raised) return
      call number_unknowns(model, layout%order, self)
      call start_front_tree(model, self%number, layout, self%fronts)
      self%factor_entries = int(layout%factor_entries, long)
      self%fixed_operations = layout%fixed_operations
      self%moving_operations = layout%moving_operations
      call self%factor%reuse%set_costs(layout%moving_operations, layout%moving_entries)
      self%equations = self%fronts%equations
      in_joint(self%node(self%equations)) = .true.
      self%retained = pack([(i, i = 1, model%n_nodes)], in_joint)
   end subroutine start


   !> The nodes whose stiffness changes in the run: those of interface elements, and of bolts.
   subroutine mark_joints(model, in_joint)
      type(model_type), intent(in)      :: model
      logical, allocatable, intent(out) :: in_joint(:) !! (n_nodes)
      integer :: i

      allocate (in_joint(model%n_nodes), source=.false.)
      do i = 1, size(model%interface)
         in_joint(model%interface(i)%node) = .true.
      end do
      do i = 1, n_bars(model)
         in_joint(model%bars(i)%nodes) = .true.
      end do
      do i = 1, n_sections(model)
         in_joint(model%sections(i)%node) = .true.
      end do
   end subroutine mark_joints


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


   !> [k_b]; the fronts that do not move are eliminated.
   subroutine form_bodies(self, model, fault)
      class(tree_solver_type), intent(inout) :: self
      type(model_type), intent(in)           :: model
      integer, intent(out)                   :: fault

      call factorise_fixed(model, self%fronts, fault)
      if (fault == 0) self%stiffest = largest_diagonal(self%fronts)
   end subroutine form_bodies


   subroutine add_to_bodies(self, rows, k)
      class(tree_solver_type), intent(inout) :: self
      integer, intent(in)                    :: rows(:)
      real(wp), intent(in)                   :: k(:, :)

      call add_to_moving(self%fronts, rows, k)
      call forget_moving(self%factor)
   end subroutine add_to_bodies


   subroutine lock(self, equation)
      class(tree_solver_type), intent(inout) :: self
      integer, intent(in)                    :: equation

      self%locked = [self%locked, equation]
      self%fronts%locked(equation) = .true.
      call forget_moving(self%factor)
   end subroutine lock


   !> What the fronts that move feel of F; at the other equations L y = f, for recover.
   subroutine condense(self, f, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: f(:)
      real(wp), intent(out)               :: x(:)

      x = f
      call eliminate_fixed(self%fronts, x)
   end subroutine condense


   subroutine form_structure(self, fault)
      class(tree_solver_type), intent(inout) :: self
      integer, intent(out)                   :: fault

      call form_moving(self%fronts, self%k_int, self%one_solution, self%factor, fault)
   end subroutine form_structure


   subroutine solve(self, x, fault)
      class(tree_solver_type), intent(inout) :: self
      real(wp), intent(inout)                :: x(:)
      integer, intent(out)                   :: fault

      call solve_with_joints(self%fronts, self%locked, self%k_int, self%factor, x, fault)
   end subroutine solve


   subroutine multiply(self, x, y)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: x(:)
      real(wp), intent(inout)             :: y(:)

      call moving_times_vector(self%fronts, x, y)
   end subroutine multiply


   !> L^T x = y in the fronts that do not move.
   subroutine recover(self, u, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: u(:)
      real(wp), intent(inout)             :: x(:)

      x(self%equations) = u(self%equations)
      call recover_fixed(self%fronts, x)
   end subroutine recover


   subroutine describe(self, description)
      class(tree_solver_type), intent(in)   :: self
      type(solver_description), intent(out) :: description

      description%name = 'TREE, JOINTS '//self%way
      description%words = [character(40) :: 'FRONTS', 'ENTRIES OF THE FACTOR', 'UNKNOWNS LEFT AFTER CONDENSATION']
      description%numbers = [size(self%fronts%fronts, kind=long), self%factor_entries, size(self%equations, kind=long)]
      description%fixed_operations = self%fixed_operations
      description%moving_operations = self%moving_operations
      description%assembly_time = self%fronts%assembly_time
   end subroutine describe

end module tree_solver
