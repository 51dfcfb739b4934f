!> The equations of the structure, whichever solver has them: SKYLINE or TREE. The increments see displacements and forces of
!! nodes, and of these only the retained ones: all nodes with SKYLINE, with TREE those that are left when the bodies have been
!! condensed. One order of use: start_equations, form_body_stiffness; condense_load for every load; in every increment
!! form_structure_stiffness, then solve_equations and body_forces as often as needed; recover_displacements for all nodes.
module equations
   use bar_elements, only: bar_stiffness
   use case_control, only: solver_auto, solver_skyline, solver_tree
   use equation_numbering, only: equation_numbers, gather, number_joints, put
   use fault_report, only: report_fault
   use failures, only: failure_type
   use front_factor, only: add_to_moving, factorise_fixed
   use front_solve, only: eliminate_fixed, moving_times_vector, recover_fixed
   use front_tree, only: largest_diagonal
   use kinds, only: long, wp
   use model_data, only: model_type, n_bars, n_sections
   use moving_solution, only: forget_moving, form_moving, moving_factor_type, solve_with_joints
   use node_graph, only: build_node_graph, node_graph_type
   use skyline, only: skyline_times_vector, solve_skyline
   use skyline_solver, only: form_skyline_bodies, form_skyline_structure, lay_out_skyline, scatter, skyline_solver_type, &
                             start_skyline_solver
   use tree_solver, only: start_tree_solver, tree_solver_type
   implicit none
   private

   public :: start_equations, form_body_stiffness, add_bar, lock_unknown, condense_load, form_structure_stiffness, &
             solve_equations, check_solution, body_forces, recover_displacements

   ! AUTO takes SKYLINE for small structures, where the time does not matter and the method can be read, and for narrow ones,
   ! where it is the faster:
   integer, parameter :: small = 1000           ! unknowns
   integer, parameter :: narrow = 16            ! entries in a column, on the average
   integer, parameter :: most_tried = 100000    ! unknowns up to which the profile is looked at

   type, extends(equation_numbers), public :: equation_system
      logical :: is_tree = .false.              !! which of the two
      type(skyline_solver_type) :: skyline
      type(tree_solver_type)    :: tree
      integer, allocatable  :: retained(:)      !! nodes that the increments see, ascending
      integer, allocatable  :: equations(:)     !! their equations
      integer, allocatable  :: locked(:)        !! equations whose unknowns have been held since they were numbered
      integer, allocatable  :: joint_equations(:, :) !! (6, n) of interface elements, with SKYLINE
      real(wp) :: stiffest = 0.0_wp             !! largest diagonal entry of [k_b] [force/length]
      real(wp), allocatable :: k_int(:, :, :)   !! (6, 6, n) of the interface elements now, global axes [force/length]
      type(moving_factor_type) :: factor        !! with TREE: what that knows of k_int
      integer :: fault = 0                      !! of the last factorisation, as in front_factor
      character(:), allocatable :: where        !! stage and increment, for messages
   end type equation_system

contains

   !> Choose the solver, order and number the unknowns. SOLVER as in case control; so many FACTORISATIONS are to be expected.
   subroutine start_equations(model, system, failure, solver, factorisations)
      type(model_type), intent(in)         :: model
      type(equation_system), intent(out)   :: system
      type(failure_type), intent(inout)    :: failure
      integer, intent(in), optional        :: solver         !! AUTO
      integer, intent(in), optional        :: factorisations !! 20
      type(node_graph_type) :: graph
      logical, allocatable  :: in_joint(:)
      integer :: i, n, repeated, wanted

      wanted = solver_auto
      if (present(solver)) wanted = solver
      repeated = 20
      if (present(factorisations)) repeated = factorisations
      n = 0
      do i = 1, model%n_nodes
         if (model%used(i)) n = n + count(.not. model%held(:, i))
      end do
      allocate (system%locked(0))
      if (n == 0) then
         call failure%raise('nothing to solve: all components of all nodes are supported')
         return
      end if
      call build_node_graph(model, graph)
      system%is_tree = wanted == solver_tree .or. (wanted == solver_auto .and. n > small)
      if (.not. system%is_tree .or. (wanted == solver_auto .and. n <= most_tried)) then
         call lay_out_skyline(model, graph, system, system%skyline)
         if (wanted == solver_auto .and. system%skyline%profile <= int(narrow, long)*n) system%is_tree = .false.
      end if
      if (system%is_tree) then
         call mark_joints(model, in_joint)
         call start_tree_solver(model, graph, in_joint, repeated, system, system%tree, failure)
         if (failure%raised) return
         associate (tree => system%tree%tree)
            system%equations = pack([(i, i = 1, system%n)], tree%fronts(tree%of_equation)%moves)
         end associate
         call system%factor%reuse%set_costs(system%tree%moving_operations, system%tree%moving_entries)
         in_joint(system%node(system%equations)) = .true.
         system%retained = pack([(i, i = 1, model%n_nodes)], in_joint)
      else
         call start_skyline_solver(system%skyline, failure)
         system%equations = [(i, i = 1, system%n)]
         system%retained = pack([(i, i = 1, model%n_nodes)], model%used)
         call number_joints(model, system%number, system%joint_equations)
      end if
   end subroutine start_equations


   !> The nodes whose stiffness changes in the run: those of interface elements, and of bolts.
   subroutine mark_joints(model, in_joint)
      type(model_type), intent(in)      :: model
      logical, allocatable, intent(out) :: in_joint(:) !! (n_nodes)
      integer :: i, k

      allocate (in_joint(model%n_nodes), source=.false.)
      do i = 1, size(model%interface)
         do k = 1, 2
            if (model%interface(i)%nodes(k) > 0) in_joint(model%interface(i)%nodes(k)) = .true.
         end do
      end do
      do i = 1, n_bars(model)
         in_joint(model%bars(i)%nodes) = .true.
      end do
      do i = 1, n_sections(model)
         in_joint(model%sections(i)%node) = .true.
      end do
   end subroutine mark_joints


   !> [k_b] of all bodies, bars included; TREE eliminates of it what no joint moves.
   subroutine form_body_stiffness(model, system, failure)
      type(model_type), intent(in)         :: model
      type(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      integer :: fault, i

      if (system%is_tree) then
         call factorise_fixed(model, system%tree%tree, fault)
         call report_fault(model, system, fault, '', failure)
         if (failure%raised) return
         system%stiffest = largest_diagonal(system%tree%tree)
      else
         call form_skyline_bodies(model, system, system%skyline)
         associate (body => system%skyline%body)
            system%stiffest = maxval(body%values(body%diagonal(1:)))
         end associate
      end if
      do i = 1, n_bars(model)
         if (model%bars(i)%is_elastic) call add_bar(model, i, system)
      end do
   end subroutine form_body_stiffness


   !> Add bar I to the stiffness of the bodies.
   subroutine add_bar(model, i, system)
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: i
      type(equation_system), intent(inout) :: system

      associate (nodes => model%bars(i)%nodes)
         associate (equations => [system%number(:, nodes(1)), system%number(:, nodes(2))])
            if (system%is_tree) then
               call add_to_moving(system%tree%tree, equations, bar_stiffness(model, i))
            else
               call scatter(system%skyline%body, equations, bar_stiffness(model, i))
            end if
         end associate
         system%stiffest = max(system%stiffest, model%bars(i)%stiffness)
         call forget_moving(system%factor)
      end associate
   end subroutine add_bar


   !> Hold component D of NODE, a retained one, from now on: it keeps its equation, and every solution has zero there.
   subroutine lock_unknown(node, d, system)
      integer, intent(in)                  :: node, d
      type(equation_system), intent(inout) :: system

      if (system%number(d, node) == 0) return
      system%locked = [system%locked, system%number(d, node)]
      call forget_moving(system%factor)
      if (system%is_tree) system%tree%tree%locked(system%number(d, node)) = .true.
   end subroutine lock_unknown


   !> G: what retained nodes feel of the nodal forces F on all nodes; zero elsewhere.
   subroutine condense_load(system, f, g)
      type(equation_system), intent(in) :: system
      real(wp), intent(in)              :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp), intent(out)             :: g(:, :) !! likewise
      real(wp), allocatable :: x(:)
      integer :: i

      if (.not. system%is_tree) then
         g = f
         return
      end if
      allocate (x(system%n))
      call gather(system, [(i, i = 1, system%n)], f, x)
      call eliminate_fixed(system%tree%tree, x)
      g = 0.0_wp
      call put(system, system%equations, x, g)
   end subroutine condense_load


   !> [k_s] = [k_b] + sum of [k_int], Eq. (8), factorised; with TREE, and where one solution is all that is wanted, an earlier
   !! factor may do for that instead. A structure without stiffness in some direction is a failure that names the node; WHERE
   !! says in which increment.
   subroutine form_structure_stiffness(model, k_int, where, system, failure, many_solutions)
      type(model_type), intent(in)         :: model
      real(wp), intent(in)                 :: k_int(:, :, :) !! (3, 3, n) of interface elements, in their axes [force/length]
      character(*), intent(in)             :: where
      type(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      logical, intent(in), optional        :: many_solutions !! true
      real(wp) :: k_global(3, 3)
      integer  :: i
      logical  :: one_solution

      one_solution = .false.
      if (present(many_solutions)) one_solution = .not. many_solutions
      system%where = where
      if (.not. allocated(system%k_int)) allocate (system%k_int(6, 6, size(model%interface)))
      do i = 1, size(model%interface)
         k_global = matmul(model%interface(i)%axes, matmul(k_int(:, :, i), transpose(model%interface(i)%axes)))
         system%k_int(:3, :3, i) = k_global
         system%k_int(4:, 4:, i) = k_global
         system%k_int(:3, 4:, i) = -k_global
         system%k_int(4:, :3, i) = -k_global
      end do
      if (system%is_tree) then
         call form_moving(system%tree%tree, system%k_int, one_solution, system%factor, system%fault)
      else
         call form_skyline_structure(system%k_int, system%joint_equations, system%locked, system%skyline, system%fault)
      end if
      call check_solution(model, system, failure)
   end subroutine form_structure_stiffness


   !> A factorisation that failed, in form_structure_stiffness or since then in solve_equations, as a failure.
   subroutine check_solution(model, system, failure)
      type(model_type), intent(in)      :: model
      type(equation_system), intent(in) :: system
      type(failure_type), intent(inout) :: failure

      call report_fault(model, system, system%fault, system%where//': ', failure)
   end subroutine check_solution


   !> Displacements U of the retained nodes under the forces F on them; held components, locked ones too, stay zero. Where only
   !! now the stiffness had to be factorised, that may have failed: check_solution says so.
   subroutine solve_equations(system, f, u)
      type(equation_system), intent(inout) :: system
      real(wp), intent(in)                 :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp), intent(inout)              :: u(:, :) !! (dimension, n_nodes), set where retained [length]
      real(wp), allocatable :: x(:)

      allocate (x(system%n))
      call gather(system, system%equations, f, x)
      if (system%is_tree) then
         call solve_with_joints(system%tree%tree, system%equations, system%locked, system%k_int, system%factor, x, system%fault)
      else if (system%fault == 0) then
         x(system%locked) = 0.0_wp
         call solve_skyline(system%skyline%structure, x)
      end if
      if (system%fault /= 0) return
      u(:, system%retained) = 0.0_wp
      call put(system, system%equations, x, u)
   end subroutine solve_equations


   !> F = [k_b] {U} on the free components of retained nodes, the others condensed into it.
   subroutine body_forces(system, u, f)
      type(equation_system), intent(in) :: system
      real(wp), intent(in)              :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), intent(inout)           :: f(:, :) !! (dimension, n_nodes), set where retained; zero on held components [force]
      real(wp), allocatable :: x(:), y(:)

      allocate (x(system%n), y(system%n))
      call gather(system, system%equations, u, x)
      if (system%is_tree) then
         call moving_times_vector(system%tree%tree, x, y)
      else
         call skyline_times_vector(system%skyline%body, x, y)
      end if
      f(:, system%retained) = 0.0_wp
      call put(system, system%equations, y, f)
   end subroutine body_forces


   !> Displacements of all nodes from those of the retained ones and the forces F on all nodes. Held components are not touched.
   subroutine recover_displacements(system, f, u)
      type(equation_system), intent(in) :: system
      real(wp), intent(in)              :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp), intent(inout)           :: u(:, :) !! (dimension, n_nodes), of retained nodes; set for the others [length]
      real(wp), allocatable :: x(:)
      integer :: i

      if (.not. system%is_tree) return
      allocate (x(system%n))
      call gather(system, [(i, i = 1, system%n)], f, x)
      call eliminate_fixed(system%tree%tree, x)
      do i = 1, size(system%equations)
         associate (k => system%equations(i))
            x(k) = u(system%direction(k), system%node(k))
         end associate
      end do
      call recover_fixed(system%tree%tree, x)
      call put(system, [(i, i = 1, system%n)], x, u)
   end subroutine recover_displacements

end module equations
