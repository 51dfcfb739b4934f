!> The equations of the structure, independent of the solver, as the increments use them. The increments see forces and
!! displacements of the retained nodes: with SKYLINE all nodes, with TREE the nodes that remain after condensation of the
!! bodies. Arrays over retained nodes are (dimension, retained), those over all nodes (dimension, n_nodes).
module equations
   use control_words, only: solver_auto
   use equation_solver, only: equation_system, exact_digits, failure_type, solver_options
   use interface_operator, only: add_global_force, global_stiffness, relative_movement
   use kinds, only: wp
   use mass_matrix, only: coupled_bar_mass, coupled_point_mass, mass_nodes, n_masses
   use model_data, only: bar_nodes, model_type, n_bars
   use node_coupling, only: between_unknowns, list_on_unknowns, unknown_nodes
   use node_graph, only: build_node_graph, node_graph_type
   use numbers, only: is_measure
   use solver_choice, only: choose_solver
   use structural_elements, only: bar_stiffness
   use text_tools, only: one_of, real_text
   use unknowns, only: unknown_name
   implicit none
   private

   public :: equation_system, start_equations, form_body_stiffness, add_bar, lock_unknown, condense_load, &
             form_structure_stiffness, solve_equations, solve_by_last_factor, forces_in_bodies, recover_displacements

contains

   !> Choose the solver; order and number the unknowns. SOLVER as in case control; FACTORISATIONS is their expected number. With
   !! a SHIFT the bodies are [k_b] - sigma [m].
   subroutine start_equations(model, system, failure, solver, factorisations, shift, solves_once)
      type(model_type), intent(in)      :: model
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type), intent(inout) :: failure
      integer, intent(in), optional     :: solver         !! AUTO
      integer, intent(in), optional     :: factorisations !! 20
      real(wp), intent(in), optional    :: shift          !! sigma, 0 [1/time^2]
      logical, intent(in), optional     :: solves_once    !! each stiffness, false
      type(node_graph_type) :: graph
      integer :: expected, i, n, wanted
      logical :: once

      wanted = solver_auto
      if (present(solver)) wanted = solver
      n = sum(merge(count(.not. model%freedoms%held, dim=1), 0, model%freedoms%used))
      if (n == 0 .and. present(shift)) then
         call failure%raise('nothing vibrates: all components of all nodes are supported')
         return
      end if
      call build_node_graph(model, graph, with_masses=present(shift))
      expected = 20
      if (present(factorisations)) expected = factorisations
      once = .false.
      if (present(solves_once)) once = solves_once
      call choose_solver(model, graph, n, wanted, expected, once, system)
      if (present(shift)) system%shift = shift
      allocate (system%locked(0), system%sliding(0))
      call system%start(model, graph, failure)
      if (failure%raised) return
      allocate (system%retained_index(model%mesh%n_nodes), source=0) ! positions, also in the interface elements
      system%retained_index(system%retained) = [(i, i = 1, size(system%retained))]
      call list_on_unknowns(model, system%interface)
      do i = 1, size(system%interface)
         system%interface(i)%node = system%retained_index(system%interface(i)%node)
      end do
      allocate (system%k_int(3, 3, size(system%interface)))
   end subroutine start_equations

   !> Form [k_b] of all bodies, bars included. A solver that condenses the bodies factorises their static part here; a direction without
   !! stiffness is a failure that names the node. WHERE names the increment that needs them.
   subroutine form_body_stiffness(model, system, failure, where)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)     :: failure
      character(*), intent(in), optional    :: where
      character(:), allocatable :: place
      integer :: fault, i

      place = ''
      if (present(where)) place = where//': '
      call system%form_bodies(model, fault)
      call system%report_fault(model, fault, place, failure)
      if (failure%raised) return
      do i = 1, n_bars(model%mesh)
         if (model%mesh%bars(i)%bolt == 0) call add_bar(model, i, system)
      end do
      if (.not. abs(system%shift) > 0.0_wp) return
      do i = 1, n_bars(model%mesh) ! - sigma [m] of bars, and of masses at nodes
         if (.not. model%mesh%bars(i)%mass > 0.0_wp) cycle
         call system%add_to_bodies([system%number(:, unknown_nodes(model%freedoms, bar_nodes(model%mesh%bars(i))))], &
                                   -system%shift*coupled_bar_mass(model, i))
      end do
      do i = 1, n_masses(model)
         call system%add_to_bodies([system%number(:, unknown_nodes(model%freedoms, mass_nodes(model, model%mesh%masses(i))))], &
                                   -system%shift*coupled_point_mass(model, model%mesh%masses(i)))
      end do
   end subroutine form_body_stiffness

   !> Add bar I to the stiffness of the bodies.
   subroutine add_bar(model, i, system)
      type(model_type), intent(in)          :: model
      integer, intent(in)                   :: i
      class(equation_system), intent(inout) :: system

      call system%add_to_bodies([system%number(:, unknown_nodes(model%freedoms, bar_nodes(model%mesh%bars(i))))], &
                                between_unknowns(model, bar_nodes(model%mesh%bars(i)), bar_stiffness(model, i)))
      system%stiffest = max(system%stiffest, model%mesh%bars(i)%stiffness)
      call system%forget_factors()
   end subroutine add_bar

   !> Hold component D of the retained NODE from now on. Its equation remains; every solution is zero there.
   subroutine lock_unknown(node, d, system)
      integer, intent(in)                   :: node, d
      class(equation_system), intent(inout) :: system

      if (system%number(d, node) == 0) return
      system%locked = [system%locked, system%number(d, node)]
      call system%forget_factors()
   end subroutine lock_unknown

   !> G: the nodal forces F condensed on the retained nodes.
   subroutine condense_load(system, f, g)
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: f(:, :) !! of all nodes [force]
      real(wp), intent(out)              :: g(:, :) !! of retained nodes; zero on held components
      real(wp), allocatable :: condensed(:), x(:)
      integer :: k

      allocate (condensed(system%n), x(system%n))
      call system%condense([(f(system%direction(k), system%node(k)), k = 1, system%n)], x)
      call system%condensed_load(x, condensed)
      call system%put(condensed, g)
   end subroutine condense_load

   !> Form [k_s] = [k_b] + sum of [k_int], Eq. (8), ready to solve; ONE_SOLUTION: to be solved only once. A direction without
   !! stiffness is a failure that names the node. WHERE names the increment.
   subroutine form_structure_stiffness(model, k_int, where, system, failure, one_solution)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: k_int(:, :, :) !! (3, 3, n) of interface elements, in their axes [force/length]
      character(*), intent(in)              :: where
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)     :: failure
      logical, intent(in), optional         :: one_solution   !! false
      integer :: fault, i

      system%options = solver_options()
      if (present(one_solution)) system%options%one_solution = one_solution
      system%formed_in = where//': '
      do i = 1, size(system%interface)
         system%k_int(:, :, i) = global_stiffness(system%interface(i), k_int(:, :, i))
      end do
      call system%form_structure(fault)
      system%has_failed = fault /= 0
      system%coupled%n_factors = system%coupled%n_factors + 1
      system%coupled%serves = fault == 0 .and. .not. system%options%one_solution
      call system%report_fault(model, fault, system%formed_in, failure)
   end subroutine form_structure_stiffness

   !> Displacements U of retained nodes under the forces F on them. Held components move by MOVED, whose effect F already
   !! contains, or stay zero, as locked ones do. A deferred factorisation may fail here. DIGITS suffice for an iterative solver
   !! where the caller corrects the solution.
   subroutine solve_equations(model, system, f, u, failure, moved, digits)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)                  :: f(:, :)     !! of retained nodes [force]
      real(wp), intent(inout)               :: u(:, :)     !! likewise [length]
      type(failure_type), intent(inout)     :: failure
      real(wp), intent(in), optional        :: moved(:, :) !! likewise, zero on free components [length]; zero
      integer, intent(in), optional         :: digits      !! exact_digits
      real(wp), allocatable :: x(:), less(:, :)
      integer :: fault, i
      logical :: moves

      if (failure%raised) return
      moves = .false.
      if (present(moved)) moves = any(abs(moved) > 0.0_wp)
      allocate (less, source=f)
      if (moves) then
         do i = 1, size(system%interface)
            associate (element => system%interface(i))
               call add_global_force(element, -matmul(system%k_int(:, :, i), relative_movement(element, moved)), less)
            end associate
         end do
      end if
      allocate (x(system%n))
      call system%gather(less, x)
      system%options%digits = exact_digits
      if (present(digits)) system%options%digits = digits
      call system%solve(x, fault)
      system%has_failed = system%has_failed .or. fault /= 0
      call system%report_fault(model, fault, system%formed_in, failure)
      if (failure%raised) return
      i = findloc(is_measure(x(system%equations)), .false., dim=1)
      if (i > 0) then
         i = system%equations(i)
         call failure%raise(system%formed_in//'the displacement of '//unknown_name(model, system%node(i), system%direction(i))// &
                            ' is '//real_text(x(i))//', too large; are loads and stiffnesses in consistent units'// &
                            one_of(any(model%joints%list%law%has_friction), ', and does friction alone hold a body?', '?'))
         return
      end if
      call system%put(x, u)
      if (moves) u = u + moved
   end subroutine solve_equations

   !> Displacements U of retained nodes under the forces F on them, by the factor of the last stiffness or of an earlier one: the caller
   !! corrects them. No later solution depends on this one.
   subroutine solve_by_last_factor(system, f, u)
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: f(:, :) !! of retained nodes [force]
      real(wp), intent(out)              :: u(:, :) !! likewise [length]; zero on held components
      real(wp), allocatable :: x(:)

      allocate (x(system%n), source=0.0_wp)
      call system%gather(f, x)
      call system%precondition(x)
      call system%put(x, u)
   end subroutine solve_by_last_factor

   !> F = [k_b] {U} on the free components of retained nodes, [k_b] condensed on these; zero on held components.
   subroutine forces_in_bodies(system, u, f)
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: u(:, :) !! of retained nodes [length]
      real(wp), intent(inout)            :: f(:, :) !! likewise [force]
      real(wp), allocatable :: x(:), y(:)

      allocate (x(system%n), y(system%n))
      call system%gather(u, x)
      call system%multiply(x, y)
      call system%put(y, f)
   end subroutine forces_in_bodies

   !> Displacements of all nodes from those of the retained ones and the forces F on all nodes; held components are zero.
   subroutine recover_displacements(system, f, u, all_u)
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: f(:, :)     !! of all nodes [force]
      real(wp), intent(in)               :: u(:, :)     !! of retained nodes [length]
      real(wp), intent(out)              :: all_u(:, :) !! of all nodes
      real(wp), allocatable :: x(:), at_retained(:)
      integer :: k

      allocate (x(system%n), at_retained(system%n))
      call system%condense([(f(system%direction(k), system%node(k)), k = 1, system%n)], x)
      call system%gather(u, at_retained)
      call system%recover(at_retained, x)
      all_u = 0.0_wp
      do k = 1, system%n
         all_u(system%direction(k), system%node(k)) = x(k)
      end do
   end subroutine recover_displacements

end module equations
