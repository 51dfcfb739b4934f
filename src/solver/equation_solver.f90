!> What a solver of the equations is: SKYLINE and TREE extend this type, and so would a third one, which is a file of its own and a
!! line in solver_choice. Used through the module equations, in one order: start, form_bodies; condense for every load; in every
!! increment form_structure, then solve and multiply as often as needed; recover for all nodes.
!!
!! A solver numbers the unknowns, and the increments solve for some of these EQUATIONS: all, or those that are left when the
!! bodies have been condensed. Vectors go over all equations, and are set or read at these alone unless it says otherwise.
!! FAULT is 0, no_memory, no_solution, or an equation without stiffness.
module equation_solver
   use failures, only: failure_type
   use interface_operator, only: interface_element
   use kinds, only: long, wp
   use model_data, only: model_type
   use node_graph, only: node_graph_type
   use text_tools, only: integer_text
   use unknowns, only: what_is_loose
   implicit none
   private

   integer, parameter, public :: no_memory = -1                !! as FAULT: an allocation failed
   integer, parameter, public :: no_solution = -2              !! as FAULT: the solver has a COMPLAINT
   integer, parameter, public :: exact_digits = 11             !! of a solution that nothing corrects: its residual is below
                                                               !! 10**(-digits) of the load
   real(wp), parameter, public :: pivot_tolerance = 1.0e-12_wp !! of the diagonal entry: below it there is no stiffness

   !> A solver in numbers, for the listing and --times.
   type, public :: solver_description
      character(:), allocatable :: name              !! and its way, as the listing has it
      character(:), allocatable :: reason            !! why AUTO has taken it, where that is no matter of course
      character(40) :: words(3) = ''                 !! what NUMBERS count; '' behind the last
      integer(long) :: numbers(3) = 0
      real(wp) :: static_operations  = 0.0_wp         !! multiplications and additions of what is factorised once
      real(wp) :: refactored_operations = 0.0_wp         !! of what is factorised in every increment
      real(wp) :: assembly_time     = 0.0_wp         !! of the elements, all threads together [s]
      integer(long) :: solutions = 0                 !! so far, by steps of an iteration on several processes
      integer(long) :: steps = 0                     !! of all of them
      integer  :: most_steps = 0                     !! of one
   end type solver_description

   !> What is asked of a solver with the stiffness that it has.
   type, public :: solver_options
      logical :: one_solution = .false.              !! with this k_int the increment solves but once
      integer :: digits = exact_digits               !! that the next solution needs, where a solver iterates
   end type solver_options

   !> A direction in which a coupled system was solved.
   type, public :: solver_direction
      real(wp), allocatable :: u(:, :)               !! (dimension, retained) [length]
      real(wp), allocatable :: force(:, :)           !! the stiffness that is factorised times it [force]
      real(wp), allocatable :: product(:, :)         !! that of the coupled system times it [force]
   end type solver_direction

   !> Coupled systems that have been solved with the factor there is as preconditioner, in steps of conjugate residuals.
   type, public :: coupled_tally
      real(wp) :: tolerance = 1.0e-4_wp              !! of the residual
      integer :: most_steps = 25                     !! with a new factor
      integer :: price = 0                           !! steps that cost what a factorisation does; 0: it is always cheaper
      logical :: serves = .false.                    !! whether there is a factor of the bodies as they are
      real(wp) :: own = 0.0_wp                       !! steps for a digit with the factor of the system's own symmetric part
      integer :: extra = 0                           !! above these, in the last system
      integer :: spent = 0, solved = 0               !! in all since the factorisation, that included, for so many systems
      type(solver_direction), allocatable :: kept(:) !! of the last systems since the factorisation
   end type coupled_tally

   type, abstract, public :: equation_system
      integer :: n = 0                               !! unknowns
      integer, allocatable  :: number(:, :)          !! (dimension, n_nodes) equation, 0: held or without element
      integer, allocatable  :: node(:), direction(:) !! (n) what an equation belongs to
      integer, allocatable  :: equations(:)          !! that the increments solve for, ascending
      integer, allocatable  :: retained(:)           !! nodes that the increments see, ascending: those of the equations, and of
                                                     !! interface elements
      integer, allocatable  :: retained_index(:)     !! (n_nodes) where a node stands among the retained ones, 0: nowhere
      integer, allocatable  :: locked(:)             !! equations whose unknowns have been held since they were numbered
      type(interface_element), allocatable :: interface(:) !! the model's, each NODE a place among the retained ones
      real(wp) :: stiffest = 0.0_wp                  !! largest diagonal entry of [k_b] [force/length]
      real(wp), allocatable :: k_int(:, :, :)        !! (3, 3, n) between the ends of interface elements now, global axes
                                                     !! [force/length]
      integer :: factorisations = 20                 !! that are to be expected
      type(solver_options) :: options                !! set anew with every k_int
      type(coupled_tally) :: coupled                 !! how solve_coupled has fared
      real(wp) :: shift = 0.0_wp                     !! sigma: in place of [k_b] there is [k_b] - sigma [m], set before it is formed
                                                     !! [1/time^2]; above zero the factor is one with signs, [l] [s] [l]^T
      integer :: n_negative = 0                      !! pivots below zero of the factor there is: so many eigenvalues of
                                                     !! [k] {x} = lambda [m] {x} are below sigma (Sylvester)
      real(wp) :: weakest = 1.0_wp                   !! least pivot of the factor there is, as a share of its diagonal entry
                                                     !! before any elimination; 1: there is no factor
      character(:), allocatable :: formed_in         !! stage and increment of this k_int, for messages
      character(:), allocatable :: complaint         !! why there is no solution
      type(solver_description) :: description        !! of the solver, once it has started
   contains
      procedure(start_solver), deferred     :: start
      procedure(form_bodies), deferred      :: form_bodies
      procedure(add_to_bodies), deferred    :: add_to_bodies
      procedure :: number_unknowns, report_fault, lock, held_now, condense, recover, forget_past
      procedure(form_structure), deferred   :: form_structure
      procedure(solve_vector), deferred     :: solve
      procedure(multiply_vector), deferred  :: multiply
      procedure(diagonal_of_matrix), deferred :: diagonal_of_factor
      procedure(use_of_factor), deferred      :: solve_by_factor, multiply_by_factor
   end type equation_system

   abstract interface
      !> Order and number the unknowns, say which EQUATIONS and RETAINED nodes are left to the increments; no matrix yet.
      subroutine start_solver(self, model, graph, failure)
         import :: equation_system, failure_type, model_type, node_graph_type
         class(equation_system), intent(inout) :: self
         type(model_type), intent(in)          :: model
         type(node_graph_type), intent(in)     :: graph
         type(failure_type), intent(inout)     :: failure
      end subroutine start_solver

      !> [k_b] of the elements, and what is done with it once; STIFFEST.
      subroutine form_bodies(self, model, fault)
         import :: equation_system, model_type
         class(equation_system), intent(inout) :: self
         type(model_type), intent(in)          :: model
         integer, intent(out)                  :: fault
      end subroutine form_bodies

      !> Add the symmetric matrix K of the equations ROWS, which are retained, 0: held, to [k_b].
      subroutine add_to_bodies(self, rows, k)
         import :: equation_system, wp
         class(equation_system), intent(inout) :: self
         integer, intent(in)                   :: rows(:)
         real(wp), intent(in)                  :: k(:, :)
      end subroutine add_to_bodies

      !> [k_s] = [k_b] + sum of K_INT, Eq. (8), ready to solve; where OPTIONS want one solution an earlier factor may do
      !! for that. The unknowns of LOCKED equations are held.
      subroutine form_structure(self, fault)
         import :: equation_system
         class(equation_system), intent(inout) :: self
         integer, intent(out)                  :: fault
      end subroutine form_structure

      !> X, the load, becomes the solution; zero where LOCKED. Where only now the stiffness is factorised that may fail.
      subroutine solve_vector(self, x, fault)
         import :: equation_system, wp
         class(equation_system), intent(inout) :: self
         real(wp), intent(inout)               :: x(:)
         integer, intent(out)                  :: fault
      end subroutine solve_vector

      !> Y = [k_b] X, the other equations condensed into it.
      subroutine multiply_vector(self, x, y)
         import :: equation_system, wp
         class(equation_system), intent(in) :: self
         real(wp), intent(in)               :: x(:)
         real(wp), intent(inout)            :: y(:)
      end subroutine multiply_vector

      !> The diagonal of the matrix [k] that the factor there is is of, over all equations.
      function diagonal_of_matrix(self) result(diagonal)
         import :: equation_system, wp
         class(equation_system), intent(in) :: self
         real(wp) :: diagonal(self%n)
      end function diagonal_of_matrix

      !> X, over all equations, becomes [k]^-1 X (solve_by_factor) or [k] X (multiply_by_factor) by the factor there is, that of an
      !! earlier stiffness as well; where LOCKED zero or without meaning. The solver remains as it is.
      subroutine use_of_factor(self, x)
         import :: equation_system, wp
         class(equation_system), intent(in)  :: self
         real(wp), contiguous, intent(inout) :: x(:)
      end subroutine use_of_factor
   end interface

contains

   !> Number the free components, node after node in ORDER.
   subroutine number_unknowns(self, model, order)
      class(equation_system), intent(inout) :: self
      type(model_type), intent(in)          :: model
      integer, intent(in)                   :: order(:)
      integer :: d, i

      self%n = 0
      self%number = spread([(0, d = 1, model%dimension)], 2, model%n_nodes)
      self%node = [(0, i = 1, count(.not. model%held(:, order)))]
      self%direction = self%node
      do i = 1, size(order)
         if (.not. model%used(order(i))) cycle
         do d = 1, model%dimension
            if (model%held(d, order(i))) cycle
            self%n = self%n + 1
            self%number(d, order(i)) = self%n
            self%node(self%n) = order(i)
            self%direction(self%n) = d
         end do
      end do
      self%node = self%node(:self%n)
      self%direction = self%direction(:self%n)
   end subroutine number_unknowns

   !> From now on the unknown of EQUATION is held: every solution has zero there.
   subroutine lock(self, equation)
      class(equation_system), intent(inout) :: self
      integer, intent(in)                   :: equation

      self%locked = [self%locked, equation]
      self%coupled%serves = .false.
   end subroutine lock

   !> Which components of retained nodes no solution moves: (dimension, retained).
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

   !> X: of the load F on all equations what is felt at the EQUATIONS, at the others what recover needs. Here all of it is felt.
   subroutine condense(self, f, x)
      class(equation_system), intent(in) :: self
      real(wp), intent(in)               :: f(:) !! (n) [force]
      real(wp), intent(out)              :: x(:) !! (n) likewise

      x(self%equations) = f(self%equations)
   end subroutine condense

   !> The displacements X of all equations: those at the EQUATIONS from U, the others by what condense left in X.
   subroutine recover(self, u, x)
      class(equation_system), intent(in) :: self
      real(wp), intent(in)               :: u(:) !! (n) [length], read at the EQUATIONS
      real(wp), intent(inout)            :: x(:) !! (n) [force] on entry, [length] on return

      x(self%equations) = u(self%equations)
   end subroutine recover

   !> What the increments so far have left, a factor or solutions, is of no use from now on: what follows is the same to the last
   !! digit as in a run that begins here. Here nothing is left.
   subroutine forget_past(self)
      class(equation_system), intent(inout) :: self

      self%options%one_solution = .false.
      self%coupled%serves = .false.
      self%weakest = 1.0_wp
   end subroutine forget_past

   !> FAULT, an equation without stiffness or no_memory, in words.
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
            self%direction(fault))//' (not supported there, or every joint that held it is open)')
      end if
   end subroutine report_fault

end module equation_solver
