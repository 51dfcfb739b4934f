!> The solver TREE: nested dissection; only fronts on the paths from the joints to the root are refactored. The dissection is
!! laid out in up to three ways. The way with least work over all increments is chosen:
!! joints last: the bodies are condensed onto the joints; one dense front with all joint unknowns remains;
!! joints inside: the joint unknowns stay where the dissection puts them;
!! joints last in parts: in every subtree up to some size the joint unknowns come last; the bodies are condensed piece by piece.
!!
!! Joints last, for STEP, of joint nodes with sliding components t only the components n along the normals come last. Between two joint
!! forces u_t = [G] u_n + h, h the movement under the loads where u_n = 0. The increments see one system of both:
!!    [S] u_n = f,  d (u_t - [G] u_n) = d h
!! with [k_b] condensed on u_n, and a stiffness d for each sliding component. [G] u_n is a back substitution in the static fronts.
module tree_solver
   use equation_solver, only: equation_system, exact_digits, failure_type
   use factor_reuse, only: earlier_solutions_type, factor_reuse_type, guess_solution, iterate_refactored, may_reuse, &
                           note_factor, note_failure, note_solution, note_steps, price_in_steps
   use front_factor, only: add_to_refactored, factorise_refactored, factorise_static
   use front_layout, only: choose_layout, front_layout_type
   use front_solve, only: solve_columns, factor_times_vector, refactored_times_vector, solve_refactored, sweep
   use front_tree, only: front_tree_type, start_front_tree
   use kinds, only: long, wp
   use memory_need, only: check_memory
   use model_data, only: model_type, n_sections
   use nested_dissection, only: dissect
   use node_graph, only: list_joined, node_graph_type
   use sliding_components, only: find_sliding
   use text_tools, only: integer_text
   use tolerances, only: sliding_stiffness, step_tolerance
   implicit none
   private

   !> The state of the present stiffness, beside the factor in the fronts.
   type :: interface_factor_type
      logical :: is_own = .false.                     !! whether the factor is that of the present stiffness, not an earlier one
      logical :: is_awaited = .false.                 !! whether the one solution asked for is still to come
      real(wp), allocatable :: k_int(:, :, :)         !! (3, 3, n) of interface elements in the factorised stiffness [force/length]
      type(factor_reuse_type) :: reuse                !! decides when to use an earlier factor
      type(earlier_solutions_type) :: earlier         !! for the first guess of conjugate gradients
   end type interface_factor_type

   type, extends(equation_system), public :: tree_solver_type
      type(front_tree_type) :: fronts
      type(interface_factor_type) :: factor       !! factor of the stiffness with the joints, and its state
      character(:), allocatable :: way            !! layout of the joints, in words
      real(wp) :: bytes = 0.0_wp                  !! memory needed
      logical  :: is_laid_out = .false.
      type(front_layout_type), private :: layout  !! freed by start
      logical, allocatable, private :: in_joint(:) !! (n_nodes) nodes whose stiffness changes in the run or is added to the bodies
      logical, allocatable, private :: slides(:, :) !! (dimension, n_nodes) sliding components
      real(wp), allocatable, private :: d(:)      !! of the sliding unknowns [force/length]
   contains
      procedure :: lay_out, start, form_bodies, add_to_bodies, condense, condensed_load, form_structure, solve, multiply, recover
      procedure :: forget_factors, forget_past, precondition, precondition_many, solve_by_factor, solve_many, multiply_by_factor
   end type tree_solver_type

contains

   !> Order the nodes and lay out the fronts for the expected number of factorisations. IS_LAID_OUT stays false where memory is
   !! missing.
   subroutine lay_out(self, model, graph)
      class(tree_solver_type), intent(inout) :: self
      type(model_type), intent(in)           :: model
      type(node_graph_type), intent(in)      :: graph
      integer, allocatable :: joined(:, :), order(:), weight(:)

      allocate (weight, source=merge(count(.not. model%freedoms%held, dim=1), 0, model%freedoms%used))
      call dissect(graph, weight > 0, order, self%is_laid_out)
      if (.not. self%is_laid_out) return
      call list_joined(model, graph%with_masses, .false., joined)
      allocate (self%in_joint(model%mesh%n_nodes), source=.false.)
      self%in_joint(pack(joined, joined > 0)) = .true.
      if (n_sections(model%mesh) > 0) self%in_joint(model%mesh%sections%node) = .true.
      if (self%solves_once .and. .not. graph%with_masses) then
         self%slides = find_sliding(model, joined)
      else
         allocate (self%slides, mold=model%freedoms%held)
         self%slides = .false.
      end if
      call choose_layout(graph, order, weight, self%in_joint, merge(count(self%slides, dim=1), 0, weight > 0), &
                         self%factorisations, self%layout, self%way)
      ! elements of refactored fronts are kept entry by entry with two indices, in number as for a regular mesh
      self%bytes = 8.0_wp*self%layout%most_entries + 16.0_wp*(0.5_wp*model%mesh%dimension*3**model%mesh%dimension*sum(weight))
      self%description%static_operations = self%layout%static_operations
      self%description%refactored_operations = self%layout%refactored_operations
   end subroutine lay_out

   !> Number the unknowns. The increments solve for the equations of the refactored fronts.
   subroutine start(self, model, graph, failure)
      class(tree_solver_type), intent(inout) :: self
      type(model_type), intent(in)           :: model
      type(node_graph_type), intent(in)      :: graph
      type(failure_type), intent(inout)      :: failure
      type(front_layout_type) :: none
      integer :: i

      if (.not. self%is_laid_out) call self%lay_out(model, graph)
      if (.not. self%is_laid_out) then
         call failure%raise('no memory to order '//integer_text(count(model%freedoms%used))//' nodes')
         return
      end if
      associate (layout => self%layout, description => self%description)
         call self%number_unknowns(model, layout%order, early=self%slides)
         call check_memory(self%n, model%mesh%dimension, self%bytes, failure)
         if (failure%raised) return
         call start_front_tree(model, self%number, layout, self%fronts)
         self%factor%reuse%most_steps = price_in_steps(layout%refactored_operations, layout%refactored_entries)
         self%coupled%price = price_in_steps(layout%refactored_operations, layout%solved_entries)
         description%name = 'TREE, JOINTS '//self%way
         description%words = [character(40) :: 'FRONTS', 'ENTRIES OF THE FACTOR', 'UNKNOWNS LEFT AFTER CONDENSATION']
         description%numbers = [int(layout%n, long), int(layout%factor_entries, long), size(self%fronts%equations, kind=long)]
      end associate
      self%layout = none
      self%in_joint(self%node(self%fronts%equations)) = .true.
      self%equations = pack([(i, i = 1, self%n)], self%in_joint(self%node))
      self%sliding = pack(self%equations, .not. self%fronts%fronts(self%fronts%of_equation(self%equations))%is_refactored)
      self%retained = pack([(i, i = 1, model%mesh%n_nodes)], self%in_joint)
   end subroutine start

   !> Form [k_b] and factorise the static fronts.
   subroutine form_bodies(self, model, fault)
      class(tree_solver_type), intent(inout) :: self
      type(model_type), intent(in)           :: model
      integer, intent(out)                   :: fault
      integer :: k

      self%fronts%shift = self%shift
      call factorise_static(model, self%fronts, fault)
      self%description%assembly_time = self%fronts%assembly_time
      if (fault /= 0) return
      self%diagonal = self%fronts%diagonal
      self%diagonal(self%fronts%equations) = 0.0_wp
      do k = 1, size(self%fronts%refactored)
         associate (front => self%fronts%fronts(self%fronts%refactored(k)), diagonal => self%diagonal)
            associate (pivots => diagonal(front%first:front%first + front%p - 1))
               pivots = pivots + front%start%diagonal(:front%p)
            end associate
            diagonal(front%rows) = diagonal(front%rows) + front%start%diagonal(front%p + 1:)
         end associate
      end do
      self%stiffest = max(0.0_wp, maxval(self%diagonal))
      self%d = sliding_stiffness*self%diagonal(self%sliding)
   end subroutine form_bodies

   subroutine add_to_bodies(self, rows, k)
      class(tree_solver_type), intent(inout) :: self
      integer, intent(in)                    :: rows(:)
      real(wp), intent(in)                   :: k(:, :)

      call add_to_refactored(self%fronts, rows, k)
   end subroutine add_to_bodies

   !> Condense F on the refactored fronts; at the other equations L y = f, for recover and condensed_load.
   subroutine condense(self, f, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: f(:)
      real(wp), intent(out)               :: x(:)

      x = f
      call sweep(self%fronts, refactored=.false., up=.true., x=x)
   end subroutine condense

   !> Of sliding components d h.
   subroutine condensed_load(self, x, g)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: x(:)
      real(wp), intent(inout)             :: g(:)
      real(wp) :: h(self%n)

      g(self%fronts%equations) = x(self%fronts%equations)
      if (size(self%sliding) == 0) return
      h = x
      h(self%fronts%equations) = 0.0_wp
      call sweep(self%fronts, refactored=.false., up=.false., x=h, followed=.true.)
      g(self%sliding) = self%d*h(self%sliding)
   end subroutine condensed_load

   !> [G] U at the sliding components, U at the equations of the refactored fronts.
   function following(self, u) result(u_t)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: u(:)
      real(wp) :: u_t(size(self%sliding))
      real(wp), allocatable :: x(:)

      if (size(self%sliding) == 0) return
      allocate (x(self%n), source=0.0_wp)
      x(self%fronts%equations) = u(self%fronts%equations)
      call sweep(self%fronts, refactored=.false., up=.false., x=x, followed=.true.)
      u_t = x(self%sliding)
   end function following

   !> Refactor the fronts with the present joint stiffness, unless an earlier factor serves.
   subroutine form_structure(self, fault)
      class(tree_solver_type), intent(inout) :: self
      integer, intent(out)                   :: fault
      logical :: reuse

      fault = 0
      reuse = .false.
      associate (factor => self%factor)
         if (self%options%one_solution) call may_reuse(factor%reuse, reuse)
         factor%is_awaited = self%options%one_solution .and. factor%reuse%most_steps > 0
         factor%is_own = .false.
      end associate
      if (.not. reuse) call factorise(self, fault)
   end subroutine form_structure

   subroutine factorise(self, fault)
      class(tree_solver_type), intent(inout) :: self
      integer, intent(out)                   :: fault
      integer :: f

      call factorise_refactored(self%fronts, self%k_int, fault)
      self%factor%is_own = fault == 0
      self%factor%reuse%has_factor = .false.
      self%weakest = 1.0_wp
      if (fault /= 0) return
      associate (fronts => self%fronts%fronts)
         self%weakest = minval(fronts%weakest)
         if (self%shift > 0.0_wp) self%n_negative = sum([(size(fronts(f)%negative), f = 1, size(fronts))])
      end associate
      self%diagonal(self%fronts%equations) = self%fronts%diagonal(self%fronts%equations)
      self%factor%k_int = self%k_int
      call note_factor(self%factor%reuse)
   end subroutine factorise

   !> Solve by the factor. An earlier factor preconditions conjugate gradients; where these fail, the fronts are refactored.
   subroutine solve(self, x, fault)
      class(tree_solver_type), intent(inout) :: self
      real(wp), contiguous, intent(inout)    :: x(:)
      integer, intent(out)                   :: fault
      real(wp), allocatable :: residual(:)
      real(wp) :: b(size(self%fronts%equations)), h(size(self%sliding)), tolerance, work
      integer  :: steps
      logical  :: found

      fault = 0
      b = x(self%fronts%equations)
      h = x(self%sliding)/self%d
      found = .false.
      if (.not. self%factor%is_own) then
         allocate (residual(self%n))
         associate (factor => self%factor, most_steps => self%factor%reuse%most_steps)
            call guess_solution(self%fronts, self%k_int, factor%earlier, b, x, residual, work)
            tolerance = step_tolerance
            if (self%options%digits < exact_digits) tolerance = 0.1_wp**self%options%digits
            call iterate_refactored(self%fronts, self%k_int - factor%k_int, work, tolerance, most_steps, residual, x, steps)
            found = steps <= most_steps
            if (found .and. tolerance > step_tolerance) b = b - residual(self%fronts%equations) ! the load that X balances
            if (found) call note_steps(factor%reuse, steps)
            if (.not. found) call note_failure(factor%reuse)
         end associate
         if (.not. found) call factorise(self, fault)
         if (fault /= 0) return
      end if
      if (.not. found) then
         x(self%fronts%equations) = b
         x(self%locked) = 0.0_wp
         call solve_refactored(self%fronts, x)
      end if
      x(self%sliding) = h + following(self, x)
      if (self%factor%is_awaited) call note_solution(self%fronts, self%k_int, b, x, self%factor%earlier)
      self%factor%is_awaited = .false.
   end subroutine solve

   subroutine forget_factors(self)
      class(tree_solver_type), intent(inout) :: self

      self%coupled%serves = .false.
      self%fronts%locked(self%locked) = .true.
      self%factor%reuse%has_factor = .false.
      self%factor%earlier%n = 0
   end subroutine forget_factors

   !> Return to the initial state, but keep the costs of a factorisation.
   subroutine forget_past(self)
      class(tree_solver_type), intent(inout) :: self

      call self%forget_factors()
      self%factor%reuse = factor_reuse_type(most_steps=self%factor%reuse%most_steps)
      self%factor%is_own = .false.
      self%factor%is_awaited = .false.
   end subroutine forget_past

   subroutine multiply(self, x, y)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: x(:)
      real(wp), intent(inout)             :: y(:)

      call refactored_times_vector(self%fronts, x, y)
      y(self%sliding) = self%d*(x(self%sliding) - following(self, x))
   end subroutine multiply

   !> L^T x = y in the static fronts, which gives the sliding components again.
   subroutine recover(self, u, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), intent(in)                :: u(:)
      real(wp), intent(inout)             :: x(:)

      x(self%fronts%equations) = u(self%fronts%equations)
      call sweep(self%fronts, refactored=.false., up=.false., x=x)
   end subroutine recover

   subroutine precondition(self, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout) :: x(:)

      x(self%locked) = 0.0_wp
      call solve_refactored(self%fronts, x)
      x(self%sliding) = x(self%sliding)/self%d + following(self, x)
   end subroutine precondition

   subroutine solve_by_factor(self, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout) :: x(:)

      call sweep(self%fronts, refactored=.false., up=.true., x=x)
      x(self%locked) = 0.0_wp
      call solve_refactored(self%fronts, x)
      call sweep(self%fronts, refactored=.false., up=.false., x=x)
   end subroutine solve_by_factor

   subroutine solve_many(self, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout) :: x(:, :)

      call solve_columns(self%fronts, refactored=.false., x=x)
   end subroutine solve_many

   subroutine precondition_many(self, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout) :: x(:, :)
      integer :: i

      call solve_columns(self%fronts, refactored=.true., x=x)
      if (size(self%sliding) == 0) return
      do i = 1, size(x, 2)
         x(self%sliding, i) = x(self%sliding, i)/self%d + following(self, x(:, i))
      end do
   end subroutine precondition_many

   subroutine multiply_by_factor(self, x)
      class(tree_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout) :: x(:)

      call factor_times_vector(self%fronts, x)
   end subroutine multiply_by_factor

end module tree_solver
