!> The abstract type of an equation solver, which SKYLINE and TREE extend. A third solver needs a file of its own and a line in
!! solver_choice. The module equations calls a solver in one order: start, form_bodies; condense for every load; in every
!! increment form_structure, then solve and multiply as often as needed; recover for all nodes.
!!
!! A solver numbers the unknowns. The increments solve for some of these EQUATIONS: all, or those that remain after condensation
!! of the bodies. A vector has one entry for each equation; only the entries at the EQUATIONS are set or read unless stated
!! otherwise. FAULT is 0, no_memory, no_solution, or an equation without stiffness.
module equation_solver
   use interface_operator, only: interface_element
   use kept_directions, only: direction_set
   use kinds, only: long, wp
   use model_data, only: model_type
   use node_graph, only: node_graph_type
   use text_tools, only: integer_text
   use unknowns, only: what_is_loose
   implicit none
   private

   integer, parameter, public :: no_memory = -1                !! as FAULT: an allocation failed
   integer, parameter, public :: no_solution = -2              !! as FAULT: the solver has a COMPLAINT
   integer, parameter, public :: exact_digits = 11             !! of a direct solution: residual < 10**(-digits) of the load

   !> A numerical failure: that the structure cannot be solved, and why.
   type, public :: failure_type
      logical :: raised = .false.
      character(:), allocatable :: message
   contains
      procedure :: raise
   end type failure_type

   !> The data of a solver for the listing and --times.
   type, public :: solver_description
      character(:), allocatable :: name              !! name and variant, as in the listing
      character(:), allocatable :: reason            !! why AUTO chose this solver, where the choice needs a reason
      character(40) :: words(3) = ''                 !! what NUMBERS count; '' behind the last of them
      integer(long) :: numbers(3) = 0
      real(wp) :: static_operations = 0.0_wp         !! multiplications and additions of the single static factorisation
      real(wp) :: refactored_operations = 0.0_wp     !! the same of the factorisation in each increment
      real(wp) :: assembly_time = 0.0_wp             !! of the elements, all threads together [s]
      integer(long) :: solutions = 0                 !! number of iterative solutions on several processes so far
      integer(long) :: steps = 0                     !! iteration steps of all these solutions
      integer  :: most_steps = 0                     !! most steps of one solution
   end type solver_description

   !> The demands on a solver under the present stiffness.
   type, public :: solver_options
      logical :: one_solution = .false.              !! the increment solves only once with this k_int
      integer :: digits = exact_digits               !! digits that the next solution needs, for an iterative solver
   end type solver_options

   !> Statistics of coupled systems solved by conjugate residuals, with the present factor as preconditioner.
   type, public :: coupled_tally
      integer :: most_steps = 25                     !! with a new factor
      integer :: price = 0                           !! steps that cost as much as a factorisation; 0: never worth while
      logical :: serves = .false.                    !! whether a factor of the present bodies exists
      real(wp) :: symmetric_steps = 0.0_wp           !! steps per digit with the factor of the system's own symmetric part
      integer :: extra = 0                           !! steps beyond these in the last system, with its corrections
      integer :: spent = 0, solved = 0               !! cost in steps since and with the last factorisation; systems solved
      integer :: n_factors = 0                       !! how often a stiffness was formed so far
      integer :: kept_for = 0                        !! of these, the one whose directions are KEPT; 0: none
      type(direction_set) :: kept                    !! directions of the last systems since the factorisation
      real(wp) :: largest = 0.0_wp                   !! largest load since the factorisation, Euclidean norm [force]
      logical, allocatable :: is_direction(:)        !! (n) of interface elements: their forces have become directions
      real(wp), allocatable :: change(:, :, :)       !! (3, 3, n) the last system less the factorised k_int [force/length]
   end type coupled_tally

   type, abstract, public :: equation_system
      integer :: n = 0                               !! unknowns
      integer, allocatable  :: number(:, :)          !! (dimension, n_nodes) equation, 0: held or without element
      integer, allocatable  :: node(:), direction(:) !! (n) node and direction of each equation
      integer, allocatable  :: equations(:)          !! that the increments solve for, ascending
      integer, allocatable  :: sliding(:)            !! of these, unknowns that follow the others: no force moves them
      integer, allocatable  :: retained(:)           !! nodes of the equations and of interface elements, ascending
      integer, allocatable  :: retained_index(:)     !! (n_nodes) position of a node among the retained ones, 0: not retained
      integer, allocatable  :: locked(:)             !! equations whose unknowns have been held since they were numbered
      type(interface_element), allocatable :: interface(:) !! of the model, each NODE a position among the retained nodes
      real(wp) :: stiffest = 0.0_wp                  !! largest diagonal entry of [k_b] [force/length]
      real(wp), allocatable :: k_int(:, :, :)        !! (3, 3, n) between the ends of interface elements now, global axes
                                                     !! [force/length]
      integer :: factorisations = 20                 !! expected number of factorisations
      logical :: solves_once = .false.               !! each stiffness for one load, as STEP does
      type(solver_options) :: options                !! set anew with every k_int
      type(coupled_tally) :: coupled                 !! statistics of solve_coupled
      real(wp) :: shift = 0.0_wp                     !! sigma: [k_b] - sigma [m] takes the place of [k_b]; set before the bodies
                                                     !! are formed [1/time^2]. Above zero the factor has signs, [l] [s] [l]^T
      integer :: n_negative = 0                      !! negative pivots of the present factor: the number of eigenvalues of [k]
                                                     !! {x} = lambda [m] {x} below sigma (Sylvester)
      real(wp), allocatable :: diagonal(:)           !! (n) of the matrix whose factor the solver holds
      real(wp) :: weakest = 1.0_wp                   !! smallest pivot of the present factor relative to the original diagonal
                                                     !! entry; 1: no factor
      logical :: has_failed = .false.                !! the last factorisation has: there is no factor
      character(:), allocatable :: formed_in         !! stage and increment of the present k_int, for messages
      character(:), allocatable :: complaint         !! why there is no solution
      type(solver_description) :: description        !! of the solver, once it has started
   contains
      procedure(start_solver), deferred     :: start
      procedure(form_bodies), deferred      :: form_bodies
      procedure(add_to_bodies), deferred    :: add_to_bodies
      procedure(form_structure), deferred   :: form_structure
      procedure(multiply_vector), deferred  :: multiply
      procedure(use_of_factor), deferred    :: solve_by_factor, multiply_by_factor
      procedure :: number_unknowns, report_fault, held_now, gather, put, condense, condensed_load, solve, precondition, &
                   precondition_many, recover, solve_many, &
                   forget_factors, forget_past
   end type equation_system

   abstract interface
      !> Order and number the unknowns; set the EQUATIONS and RETAINED nodes. No matrix is formed yet.
      subroutine start_solver(self, model, graph, failure)
         import :: equation_system, failure_type, model_type, node_graph_type
         class(equation_system), intent(inout) :: self
         type(model_type), intent(in)          :: model
         type(node_graph_type), intent(in)     :: graph
         type(failure_type), intent(inout)     :: failure
      end subroutine start_solver

      !> Form [k_b] of the elements and STIFFEST, and factorise the static part.
      subroutine form_bodies(self, model, fault)
         import :: equation_system, model_type
         class(equation_system), intent(inout) :: self
         type(model_type), intent(in)          :: model
         integer, intent(out)                  :: fault
      end subroutine form_bodies

      !> Add the symmetric matrix K to [k_b]. Its ROWS are equations of retained nodes, 0: held.
      subroutine add_to_bodies(self, rows, k)
         import :: equation_system, wp
         class(equation_system), intent(inout) :: self
         integer, intent(in)                   :: rows(:)
         real(wp), intent(in)                  :: k(:, :)
      end subroutine add_to_bodies

      !> Form [k_s] = [k_b] + sum of K_INT, Eq. (8), ready to solve. Where OPTIONS ask for one solution only, an earlier factor
      !! may serve. The unknowns of LOCKED equations are held.
      subroutine form_structure(self, fault)
         import :: equation_system
         class(equation_system), intent(inout) :: self
         integer, intent(out)                  :: fault
      end subroutine form_structure

      !> Y = [k_b] X, with [k_b] condensed on the EQUATIONS.
      subroutine multiply_vector(self, x, y)
         import :: equation_system, wp
         class(equation_system), intent(in) :: self
         real(wp), intent(in)               :: x(:)
         real(wp), intent(inout)            :: y(:)
      end subroutine multiply_vector

      !> Replace X, over all equations, by [k]^-1 X (solve_by_factor) or [k] X (multiply_by_factor). [k] is the matrix of the
      !! present factor, which may be that of an earlier stiffness. Where LOCKED, X is zero or undefined. The solver is not
      !! changed.
      subroutine use_of_factor(self, x)
         import :: equation_system, wp
         class(equation_system), intent(in)  :: self
         real(wp), contiguous, intent(inout) :: x(:)
      end subroutine use_of_factor
   end interface

contains

   !> Report the failure; the first message counts.
   subroutine raise(self, message)
      class(failure_type), intent(inout) :: self
      character(*), intent(in)           :: message

      if (self%raised) return
      self%raised = .true.
      self%message = message
   end subroutine raise

   !> Number the free components, node after node in ORDER. A node may stand in ORDER twice: the first time for its components
   !! with EARLY, then for the others.
   subroutine number_unknowns(self, model, order, early)
      class(equation_system), intent(inout) :: self
      type(model_type), intent(in)          :: model
      integer, intent(in)                   :: order(:)
      logical, intent(in), optional         :: early(:, :) !! (dimension, n_nodes)
      logical, allocatable :: is_free(:, :)
      integer :: d, i
      integer :: first(model%mesh%n_nodes) ! place in ORDER

      allocate (is_free, source=.not. model%freedoms%held(:, order) .and. spread(model%freedoms%used(order), 1, &
         model%mesh%dimension))
      if (present(early)) then
         first = 0
         do i = 1, size(order)
            associate (node => order(i))
               if (first(node) == 0) then
                  first(node) = i
               else
                  is_free(:, i) = is_free(:, i) .and. .not. early(:, node)
                  is_free(:, first(node)) = is_free(:, first(node)) .and. early(:, node)
               end if
            end associate
         end do
      end if
      self%n = count(is_free)
      self%node = pack(spread(order, 1, model%mesh%dimension), is_free)
      self%direction = pack(spread([(d, d = 1, model%mesh%dimension)], 2, size(order)), is_free)
      self%number = spread([(0, d = 1, model%mesh%dimension)], 2, model%mesh%n_nodes)
      do i = 1, self%n
         self%number(self%direction(i), self%node(i)) = i
      end do
   end subroutine number_unknowns

   !> Which components of retained nodes are held: (dimension, retained).
   pure function held_now(self) result(held)
      class(equation_system), intent(in) :: self
      logical :: held(size(self%number, 1), size(self%retained))
      integer :: i

      held = self%number(:, self%retained) == 0
      do i = 1, size(self%locked)
         associate (k => self%locked(i))
            held(self%direction(k), self%retained_index(self%node(k))) = .true.
         end associate
      end do
   end function held_now

   !> X(equation), at the EQUATIONS only, from an ARRAY over retained nodes.
   subroutine gather(self, array, x)
      class(equation_system), intent(in) :: self
      real(wp), intent(in)               :: array(:, :) !! (dimension, retained)
      real(wp), intent(inout)            :: x(:)        !! (n)
      integer :: i, k

      do i = 1, size(self%equations)
         k = self%equations(i)
         x(k) = array(self%direction(k), self%retained_index(self%node(k)))
      end do
   end subroutine gather

   !> An ARRAY over retained nodes from X(equation); zero on held components.
   subroutine put(self, x, array)
      class(equation_system), intent(in) :: self
      real(wp), intent(in)               :: x(:)        !! (n)
      real(wp), intent(out)              :: array(:, :) !! (dimension, retained)
      integer :: i, k

      array = 0.0_wp
      do i = 1, size(self%equations)
         k = self%equations(i)
         array(self%direction(k), self%retained_index(self%node(k))) = x(k)
      end do
   end subroutine put

   !> Condense the load F on all equations: X is what recover and condensed_load need. In the abstract type X is F.
   subroutine condense(self, f, x)
      class(equation_system), intent(in) :: self
      real(wp), intent(in)               :: f(:) !! (n) [force]
      real(wp), intent(out)              :: x(:) !! (n) likewise

      x(self%equations) = f(self%equations)
   end subroutine condense

   !> G: the condensed load at the EQUATIONS, from X of condense.
   subroutine condensed_load(self, x, g)
      class(equation_system), intent(in) :: self
      real(wp), intent(in)               :: x(:) !! (n) [force]
      real(wp), intent(inout)            :: g(:) !! (n) likewise

      g(self%equations) = x(self%equations)
   end subroutine condensed_load

   !> Replace the load X by the solution; zero where LOCKED. A deferred factorisation may fail here. The abstract type uses the
   !! factor.
   subroutine solve(self, x, fault)
      class(equation_system), intent(inout) :: self
      real(wp), contiguous, intent(inout)   :: x(:) !! (n), at the EQUATIONS
      integer, intent(out)                  :: fault

      fault = 0
      call self%solve_by_factor(x)
   end subroutine solve

   !> Replace X, at the EQUATIONS, by [k]^-1 X, as solve_by_factor does: no later result depends on whether this was done.
   subroutine precondition(self, x)
      class(equation_system), intent(in)  :: self
      real(wp), contiguous, intent(inout) :: x(:) !! (n)

      call self%solve_by_factor(x)
   end subroutine precondition

   !> Replace every column of X, over all equations, by [k]^-1 times it, as solve_by_factor does; zero where LOCKED. The
   !! abstract type takes one column after the other.
   subroutine solve_many(self, x)
      class(equation_system), intent(in)  :: self
      real(wp), contiguous, intent(inout) :: x(:, :) !! (n, columns)
      integer :: i

      do i = 1, size(x, 2)
         x(self%locked, i) = 0.0_wp
         call self%solve_by_factor(x(:, i))
         x(self%locked, i) = 0.0_wp
      end do
   end subroutine solve_many

   !> Replace every column of X, at the EQUATIONS, by [k]^-1 times it, as precondition does. The abstract type takes one column after
   !! the other.
   subroutine precondition_many(self, x)
      class(equation_system), intent(in)  :: self
      real(wp), contiguous, intent(inout) :: x(:, :) !! (n, columns)
      integer :: i

      do i = 1, size(x, 2)
         call self%precondition(x(:, i))
      end do
   end subroutine precondition_many

   !> The displacements X of all equations: at the EQUATIONS from U, elsewhere from what condense left in X.
   subroutine recover(self, u, x)
      class(equation_system), intent(in) :: self
      real(wp), intent(in)               :: u(:) !! (n) [length], read at the EQUATIONS
      real(wp), intent(inout)            :: x(:) !! (n) [force] on entry, [length] on return

      x(self%equations) = u(self%equations)
   end subroutine recover

   !> The bodies or the LOCKED equations have changed: factors and solutions of before are of no use.
   subroutine forget_factors(self)
      class(equation_system), intent(inout) :: self

      self%coupled%serves = .false.
   end subroutine forget_factors

   !> Discard factors and solutions of earlier increments, so that all further results equal, to the last digit, those of a run
   !! that begins here. The abstract type has nothing to discard.
   subroutine forget_past(self)
      class(equation_system), intent(inout) :: self

      self%options%one_solution = .false.
      self%coupled%serves = .false.
      self%weakest = 1.0_wp
   end subroutine forget_past

   !> Put FAULT, an equation without stiffness or no_memory, into words.
   subroutine report_fault(self, model, fault, where, failure)
      class(equation_system), intent(in) :: self
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: fault
      character(*), intent(in)           :: where
      type(failure_type), intent(inout)  :: failure

      if (fault == no_memory) then
         call failure%raise(where//'no memory for the factor of '//integer_text(self%n)//' equations')
      else if (fault == no_solution) then
         call failure%raise(where//self%complaint)
      else if (fault > 0) then
         call failure%raise(where//'the structure is a mechanism: '//what_is_loose(model, self%node(fault), &
            self%direction(fault))//' ('//what_let_go(model)//')')
      end if
   end subroutine report_fault

   !> Why a component may have no stiffness.
   pure function what_let_go(model) result(words)
      type(model_type), intent(in) :: model
      character(:), allocatable    :: words
      integer :: j

      words = 'not supported there'
      if (size(model%joints%element) == 0) return
      words = words//', or every joint there is open'
      if (any([(any(.not. model%joints%list(j)%law%shear(:model%mesh%dimension - 1)%given), j = 1, size(model%joints%list))])) &
         words = words//' or has no law of shear in this direction'
   end function what_let_go

end module equation_solver
