!> Implements the solvers PETSC and MUMPS: PETSc solves the equations of all nodes over the processes of the run.
!! As with SKYLINE nothing is condensed: the increments solve for all equations. This module has the part of rank 0, worker_loop the
!! part of all processes.
module petsc_solver
   use body_elements, only: coupled_stiffness
   use condition_estimate, only: first_large
   use distributed_matrix, only: add_blocks
   use distributed_solution, only: by_gamg, by_mumps, no_limit
   use element_unknowns, only: nodes_of_unknowns
   use equation_solver, only: equation_system, failure_type, no_memory, no_solution
   use factor_reuse, only: factor_reuse_type, may_reuse, note_factor, note_failure, note_steps
   use interface_equations, only: interface_equations_type, list_interface_equations
   use interface_operator, only: interface_element
   use kinds, only: long, wp
   use model_data, only: model_type
   use node_coupling, only: list_on_unknowns
   use node_graph, only: node_graph_type
   use partition, only: add_touched, is_entangled, list_touched, partition_nodes, partition_type, pass_subdomain, subdomain_of, &
                        subdomain_type, touched_type
   use ranks, only: n_ranks
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: pivot_tolerance
   use worker_loop, only: broadcast_command, command_diagonal, command_finish, command_forget, command_multiply, command_read, &
                          command_renew, command_solve, command_start, command_take, command_way, &
                          command_write, solution, stiffest_of_all => stiffest, stiffness, subdomain
   implicit none
   private

   integer, parameter :: steps_of_set_up = 30   ! number of steps that costs as much as a new preconditioner, GAMG
   integer, parameter :: few_steps = 10         ! steps beyond twice the expected number before an earlier preconditioner is dropped
   integer, parameter :: many_steps = 150       ! number of steps beyond which the MUMPS factor replaces GAMG
   integer, parameter :: small = 100000         ! unknowns up to which memory and time suffice for a factor
   real(wp), parameter :: enough_digits = 3.0_wp ! digits gained that suffice to measure the pace of the steps
   integer, parameter :: digits_of_estimate = 6 ! accuracy for the condition estimate, where one digit would do

   type, extends(equation_system), public :: petsc_solver_type
      integer :: wanted = by_gamg                 !! or by_mumps
      integer :: way = by_gamg                    !! preconditioner in use: MUMPS too where GAMG does not converge
      type(partition_type) :: parts
      type(touched_type) :: touched
      type(interface_equations_type) :: joints
      type(factor_reuse_type) :: reuse            !! when to use an earlier preconditioner
      real(wp) :: pace = 0.0_wp                   !! steps per digit with a preconditioner of the present stiffness
      integer, allocatable  :: row(:)             !! (0:n) row of the matrix, from 1; row(0) is 0
      real(wp), allocatable :: bodies(:, :, :)    !! (dimension, dimension, touched blocks) of the bodies [force/length]
      logical :: is_own = .false.                 !! whether the preconditioner is of the present stiffness
      logical :: is_probed = .false.              !! whether a stiffness has been probed since the run or its history began
      real(wp), allocatable :: structure(:)       !! values of the touched blocks with the joints
   contains
      procedure :: start, form_bodies, add_to_bodies, form_structure, solve, multiply, forget_past
      procedure :: solve_by_factor, multiply_by_factor
   end type petsc_solver_type

contains

   !> Distribute the structure. All equations are left to the increments.
   subroutine start(self, model, graph, failure)
      class(petsc_solver_type), intent(inout) :: self
      type(model_type), intent(in)            :: model
      type(node_graph_type), intent(in)       :: graph
      type(failure_type), intent(inout)       :: failure
      type(interface_element), allocatable :: elements(:)
      type(subdomain_type) :: other
      integer :: i, r
      logical :: ok

      call partition_nodes(model, graph, self%parts, ok)
      if (.not. ok) then
         call failure%raise('no memory to deal out '//integer_text(model%mesh%n_nodes)//' nodes')
         return
      end if
      call self%number_unknowns(model, self%parts%order)
      allocate (self%row(0:self%n), source=0)
      self%row(1:) = [(model%mesh%dimension*self%parts%block(self%node(i)) + self%direction(i), i = 1, self%n)]
      call broadcast_command(command_take)
      do r = 1, n_ranks - 1
         call subdomain_of(model, graph, self%parts, r, other)
         call pass_subdomain(r, other)
      end do
      call subdomain_of(model, graph, self%parts, 0, subdomain)
      self%equations = [(i, i = 1, self%n)]
      self%retained = pack([(i, i = 1, model%mesh%n_nodes)], model%freedoms%used)
      call list_on_unknowns(model, elements)
      call list_interface_equations(elements, self%number, self%joints)
      call list_touched(model, graph, self%parts, elements, self%touched)
      allocate (self%bodies(model%mesh%dimension, model%mesh%dimension, self%touched%n), source=0.0_wp)
      allocate (self%diagonal(self%n), source=0.0_wp)
      self%reuse%most_steps = steps_of_set_up
      associate (description => self%description)
         description%name = one_of(self%wanted == by_gamg, 'PETSC, CONJUGATE GRADIENTS WITH GAMG', 'PETSC, FACTOR BY MUMPS')
         description%words(1) = 'ENTRIES OF THE STIFFNESS MATRIX'
         description%numbers(1) = int(model%mesh%dimension, long)**2*(size(graph%neighbours) + int(model%mesh%n_nodes, long))
      end associate
   end subroutine start

   !> [k_b]: every process forms its elements; rank 0 also forms those with dependent unknowns.
   subroutine form_bodies(self, model, fault)
      class(petsc_solver_type), intent(inout) :: self
      type(model_type), intent(in)            :: model
      integer, intent(out)                    :: fault
      real(wp), allocatable :: blocks(:), k(:, :)
      integer  :: e, n

      fault = 0
      call broadcast_command(command_start, [self%parts%counts, self%touched%counts, self%touched%row, self%touched%column])
      do e = 1, model%mesh%n_elements
         if (.not. is_entangled(model, e)) cycle
         call coupled_stiffness(model, e, k)
         associate (nodes => nodes_of_unknowns(model%freedoms, e))
            n = model%mesh%dimension*size(nodes)
            call add_blocks(self%parts%block(nodes), model%freedoms%held(:, nodes), k(:n, :n), stiffness)
         end associate
      end do
      self%way = self%wanted
      call broadcast_command(command_finish, [self%way])
      self%stiffest = stiffest_of_all
      allocate (blocks(size(self%bodies)))
      call broadcast_command(command_read, values=blocks) ! the contributions of the elements to the touched blocks
      self%bodies = self%bodies + reshape(blocks, shape(self%bodies))
   end subroutine form_bodies

   subroutine add_to_bodies(self, rows, k)
      class(petsc_solver_type), intent(inout) :: self
      integer, intent(in)                     :: rows(:)
      real(wp), intent(in)                    :: k(:, :)

      call add_touched(self%touched, self%row(rows), k, self%bodies)
      self%is_own = .false.
   end subroutine add_to_bodies

   !> [k_s] = [k_b] + sum of [k_int], Eq. (8), in the matrix; the row and column of a locked equation become those of the identity
   !! times the UNIT of the matrix. An earlier preconditioner is kept while that pays.
   subroutine form_structure(self, fault)
      class(petsc_solver_type), intent(inout) :: self
      integer, intent(out)                    :: fault
      real(wp), allocatable :: values(:, :, :)
      integer :: block, c, i, k
      logical :: reuse

      allocate (values, source=self%bodies)
      do i = 1, self%joints%n
         call add_touched(self%touched, self%row(self%joints%rows_of(i)), self%joints%matrix_of(i, self%k_int(:, :, i)), values)
      end do
      do i = 1, size(self%locked)
         block = (self%row(self%locked(i)) - 1)/size(values, 1)
         c = self%row(self%locked(i)) - size(values, 1)*block
         do k = 1, self%touched%n
            associate (in_row => self%touched%row(k) == block, in_column => self%touched%column(k) == block)
               if (in_row) values(c, :, k) = 0.0_wp
               if (in_column) values(:, c, k) = 0.0_wp
               if (in_row .and. in_column) values(c, c, k) = stiffness%unit
            end associate
         end do
      end do
      self%structure = reshape(values, [size(values)])
      call broadcast_command(command_write, values=self%structure)
      call act_on(self, command_diagonal, self%diagonal)
      self%is_own = .false.
      fault = findloc(self%diagonal > 0.0_wp, .false., dim=1)
      if (fault > 0) return
      call may_reuse(self%reuse, reuse)
      if (.not. reuse) call renew(self)
      if (.not. self%is_probed) call probe(self, fault)
   end subroutine form_structure

   subroutine renew(self)
      class(petsc_solver_type), intent(inout) :: self

      call broadcast_command(command_renew)
      self%is_own = .true.
      call note_factor(self%reuse)
   end subroutine renew

   subroutine solve(self, x, fault)
      class(petsc_solver_type), intent(inout) :: self
      real(wp), contiguous, intent(inout)     :: x(:)
      integer, intent(out)                    :: fault
      integer :: steps

      fault = 0
      x(self%locked) = 0.0_wp
      call solve_somehow(self, 1, x, steps)
      associate (done => self%description)
         done%solutions = done%solutions + 1
         done%steps = done%steps + steps
         done%most_steps = max(done%most_steps, steps)
      end associate
      if (.not. solution%converged) then
         call say_why(self, x, fault)
      else if (self%is_own) then
         ! after a good first guess the few digits gained say little
         if (solution%gained >= enough_digits .or. self%pace <= 0.0_wp) &
            self%pace = solution%steps/max(1.0_wp, solution%gained)
         if (solution%steps > many_steps .and. self%n <= small) call take_way(self, by_mumps)
      else
         call note_steps(self%reuse, max(0, solution%steps - nint(self%pace*solution%gained)))
      end if
   end subroutine solve

   !> Replace the load X by the solution; STEPS is the number of steps. If the preconditioner of an earlier stiffness does not
   !! converge, a new one is built, and at last the factor of MUMPS.
   subroutine solve_somehow(self, noted, x, steps)
      class(petsc_solver_type), intent(inout) :: self
      integer, intent(in)                     :: noted !! 1: later solutions use this one for their first guess; 0
      real(wp), intent(inout)                 :: x(:)
      integer, intent(out)                    :: steps
      real(wp) :: load(size(self%equations))

      load = x(self%equations)
      call act_on(self, command_solve, x, &
                  [self%options%digits, merge(no_limit, 2*nint(self%pace*self%options%digits) + few_steps, self%is_own), noted])
      steps = solution%steps
      do while (.not. solution%converged)
         if (.not. self%is_own) then
            call note_failure(self%reuse)
         else if (self%way == by_gamg) then
            call take_way(self, by_mumps)
         else
            exit
         end if
         call renew(self)
         x(self%equations) = load
         call act_on(self, command_solve, x, [self%options%digits, no_limit, noted])
         steps = steps + solution%steps
      end do
   end subroutine solve_somehow

   !> Build preconditioners in this WAY from now on.
   subroutine take_way(self, way)
      class(petsc_solver_type), intent(inout) :: self
      integer, intent(in)                     :: way !! by_gamg, by_mumps

      if (self%way == way) return
      self%way = way
      self%is_own = .false.
      self%pace = 0.0_wp
      self%reuse%has_factor = .false.
      call broadcast_command(command_way, [way])
   end subroutine take_way

   !> Find motions with little or no stiffness, which the loads of the run may not excite: solve for a load that excites every
   !! motion. FAULT is an equation of such a motion. The load of an equation is irregular and proportional to sqrt(k_ii), so that
   !! units do not matter. The inverse of the largest displacement, relative to 1/sqrt(k_ii), takes the place of the smallest pivot.
   subroutine probe(self, fault)
      class(petsc_solver_type), intent(inout) :: self
      integer, intent(inout)                  :: fault
      real(wp), parameter :: golden = 0.6180339887498949_wp
      real(wp) :: size_of(self%n), x(self%n)
      integer  :: steps

      size_of = sqrt(self%diagonal)
      x = size_of*(2.0_wp*modulo(golden*(size(self%number, 1)*self%node + self%direction), 1.0_wp) - 1.0_wp)
      x(self%locked) = 0.0_wp
      call broadcast_command(command_forget)
      call solve_somehow(self, 0, x, steps)
      self%is_probed = .true.
      if (solution%converged) then
         self%weakest = 1.0_wp/max(1.0_wp, maxval(size_of*abs(x)))
      else
         call say_why(self, x, fault)
      end if
      call broadcast_command(command_forget)
   end subroutine probe

   !> Report that there is no solution; X is the last iterate. FAULT is an equation of a motion without stiffness where X is one,
   !! x'[k]x <= pivot_tolerance x'[d]x with [d] the diagonal; otherwise no_memory, or no_solution with a COMPLAINT.
   subroutine say_why(self, x, fault)
      class(petsc_solver_type), intent(inout) :: self
      real(wp), intent(in)                    :: x(:)
      integer, intent(out)                    :: fault
      real(wp) :: force(size(x)), moved(size(x)), size_of(size(x))
      integer  :: direction, node
      character(:), allocatable :: words

      self%reuse%has_factor = .false.
      fault = no_solution
      words = 'PETSc does not solve the '//integer_text(self%n)//' equations: '
      if (.not. solution%has_memory) then
         fault = no_memory
      else if (.not. solution%residual <= huge(1.0_wp)) then
         words = words//'there is no factor of their matrix'
      else
         words = words//'after '//integer_text(solution%steps)//' steps the residual is '//real_text(solution%residual)// &
                 ' of the load'
         size_of = sqrt(self%diagonal)
         moved = x/max(maxval(size_of*abs(x)), tiny(1.0_wp))
         force = moved
         call self%multiply_by_factor(force)
         if (sum(moved*force) <= pivot_tolerance*sum((size_of*moved)**2)) then
            call first_large(self, size_of*abs(moved), node, direction)
            fault = self%number(direction, node)
         end if
      end if
      self%complaint = words//'; the structure may be a mechanism, which SOLVER = TREE would name'
   end subroutine say_why

   !> Y = [k_b] X, with the joints temporarily removed from the matrix.
   subroutine multiply(self, x, y)
      class(petsc_solver_type), intent(in) :: self
      real(wp), intent(in)                 :: x(:)
      real(wp), intent(inout)              :: y(:)
      real(wp), allocatable :: blocks(:)

      blocks = reshape(self%bodies, [size(self%bodies)])
      call broadcast_command(command_write, values=blocks)
      y(self%equations) = x(self%equations)
      call act_on(self, command_multiply, y)
      if (allocated(self%structure)) then
         blocks = self%structure
         call broadcast_command(command_write, values=blocks)
      end if
   end subroutine multiply

   subroutine forget_past(self)
      class(petsc_solver_type), intent(inout) :: self

      call broadcast_command(command_forget)
      self%reuse%has_factor = .false.
      self%options%one_solution = .false.
      self%weakest = 1.0_wp
      self%is_probed = .false.
      call take_way(self, self%wanted)
   end subroutine forget_past

   subroutine solve_by_factor(self, x)
      class(petsc_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout)  :: x(:)

      x(self%locked) = 0.0_wp
      call act_on(self, command_solve, x, [digits_of_estimate, no_limit, 0])
   end subroutine solve_by_factor

   subroutine multiply_by_factor(self, x)
      class(petsc_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout)  :: x(:)

      call act_on(self, command_multiply, x)
   end subroutine multiply_by_factor

   !> Replace X, by equation, by the result of the command WHAT on all processes.
   subroutine act_on(self, what, x, words)
      class(petsc_solver_type), intent(in) :: self
      integer, intent(in)                  :: what !! command_solve, command_multiply, command_diagonal
      real(wp), intent(inout)              :: x(:)
      integer, intent(in), optional        :: words(:)
      real(wp), allocatable :: values(:)

      allocate (values(size(self%parts%order)*size(self%number, 1)), source=0.0_wp)
      values(self%row(1:)) = x(self%equations)
      call broadcast_command(what, words, values)
      x(self%equations) = values(self%row(1:))
   end subroutine act_on

end module petsc_solver
