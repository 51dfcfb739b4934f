!> The equations of the structure by the SKYLINE method: numbered along a profile ordering, [k_b] of the bodies formed
!! once, [k_s] = [k_b] + sum of [k_int] formed and factorised in every increment.
module equations
   use bar_elements, only: bar_stiffness
   use body_elements, only: coupled_stiffness
   use element_kinds, only: max_coupled_dofs
   use failures, only: failure_type
   use kinds, only: long, wp
   use machine, only: available_memory
   use model_data, only: model_type, n_bars, n_points
   use node_ordering, only: build_node_graph, node_graph, reverse_cuthill_mckee
   use section_coupling, only: coupled_nodes
   use skyline, only: add_to_skyline, factorise_skyline, skyline_matrix, solve_skyline, start_skyline
   use text_tools, only: integer_text
   implicit none
   private

   public :: add_bar, lock_unknown, start_equations, form_body_stiffness, form_structure_stiffness, solve_equations

   real(wp), parameter :: pivot_tolerance = 1.0e-12_wp ! of the diagonal entry: below it there is no stiffness
   real(wp), parameter :: locked_stiffness = 1.0e20_wp ! times the diagonal entry: what the others feel is lost in rounding

   type, public :: equation_system
      integer :: n = 0                              !! unknowns
      integer, allocatable :: number(:, :)          !! (dimension, n_nodes) equation, 0: held or without element
      integer, allocatable :: node(:), direction(:) !! (n) what an equation belongs to
      integer, allocatable :: locked(:)             !! equations whose unknowns have been held since they were numbered
      integer(long) :: profile = 0                  !! entries in the skyline
      integer(long) :: profile_as_numbered = 0      !! what they would be in the order of the node numbers
      type(skyline_matrix) :: body                  !! [k_b]
      type(skyline_matrix) :: structure             !! [k_s], then its factor
   end type equation_system

contains

   !> Number the unknowns and lay out the profile: reverse Cuthill-McKee, or the nodes' own order where that is tighter.
   subroutine start_equations(model, system, failure)
      type(model_type), intent(in)         :: model
      type(equation_system), intent(out)   :: system
      type(failure_type), intent(inout)    :: failure
      type(node_graph)     :: graph
      integer, allocatable :: order(:), first_row(:), first_row_as_numbered(:)
      integer :: i
      logical :: ok

      allocate (system%locked(0))
      call build_node_graph(model, graph)
      call reverse_cuthill_mckee(graph, order)
      call number_unknowns(model, [(i, i = 1, model%n_nodes)], system)
      call lay_out_profile(model, system, first_row_as_numbered, system%profile_as_numbered)
      call number_unknowns(model, order, system)
      call lay_out_profile(model, system, first_row, system%profile)
      if (system%profile >= system%profile_as_numbered) then
         call number_unknowns(model, [(i, i = 1, model%n_nodes)], system)
         call move_alloc(first_row_as_numbered, first_row)
         system%profile = system%profile_as_numbered
      end if
      if (system%n == 0) then
         call failure%raise('nothing to solve: all components of all nodes are supported')
      else if (16*system%profile > available_memory()) then
         call failure%raise('the skyline of '//integer_text(system%n)//' equations needs '// &
                            integer_text(int(16*system%profile/1048576))//' MiB, and the machine has '// &
                            integer_text(int(available_memory()/1048576))//' MiB to give')
      else
         call start_skyline(first_row, system%body, ok)
         if (.not. ok) call failure%raise('no memory for the skyline of '//integer_text(system%n)//' equations')
      end if
   end subroutine start_equations


   !> Number the free components, node after node in ORDER.
   subroutine number_unknowns(model, order, system)
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: order(:)
      type(equation_system), intent(inout) :: system
      integer :: d, i, n

      n = 0
      if (.not. allocated(system%number)) allocate (system%number(model%dimension, model%n_nodes))
      system%number = 0
      do i = 1, size(order)
         if (.not. model%used(order(i))) cycle
         do d = 1, model%dimension
            if (model%held(d, order(i))) cycle
            n = n + 1
            system%number(d, order(i)) = n
         end do
      end do
      system%n = n
      if (.not. allocated(system%node)) allocate (system%node(n), system%direction(n))
      do i = 1, model%n_nodes
         do d = 1, model%dimension
            if (system%number(d, i) == 0) cycle
            system%node(system%number(d, i)) = i
            system%direction(system%number(d, i)) = d
         end do
      end do
   end subroutine number_unknowns


   !> First row of every column: the lowest equation that shares an element or interface element.
   subroutine lay_out_profile(model, system, first_row, profile)
      type(model_type), intent(in)      :: model
      type(equation_system), intent(in) :: system
      integer, allocatable, intent(out) :: first_row(:)
      integer(long), intent(out)        :: profile
      integer :: e, i

      allocate (first_row, source=[(i, i = 1, system%n)])
      do e = 1, model%n_elements
         call couple(coupled_nodes(model, e))
      end do
      do i = 1, size(model%interface)
         call couple(pack(model%interface(i)%nodes, model%interface(i)%nodes > 0))
      end do
      do i = 1, n_bars(model)
         call couple(model%bars(i)%nodes)
      end do
      profile = 0
      do i = 1, system%n
         profile = profile + i - first_row(i) + 1
      end do

   contains

      subroutine couple(nodes)
         integer, intent(in) :: nodes(:)
         integer :: d, k, equation, lowest

         lowest = huge(lowest)
         do k = 1, size(nodes)
            do d = 1, model%dimension
               equation = system%number(d, nodes(k))
               if (equation > 0) lowest = min(lowest, equation)
            end do
         end do
         do k = 1, size(nodes)
            do d = 1, model%dimension
               equation = system%number(d, nodes(k))
               if (equation > 0) first_row(equation) = min(first_row(equation), lowest)
            end do
         end do
      end subroutine couple

   end subroutine lay_out_profile


   !> [k_b]: the stiffness of all bodies, bars included.
   subroutine form_body_stiffness(model, system)
      type(model_type), intent(in)         :: model
      type(equation_system), intent(inout) :: system
      real(wp) :: k(max_coupled_dofs, max_coupled_dofs)
      integer  :: d, e, i, n, rows(max_coupled_dofs)

      d = model%dimension
      do e = 1, model%n_elements
         call coupled_stiffness(model, e, k)
         associate (nodes => coupled_nodes(model, e))
            n = d*size(nodes)
            do i = 1, size(nodes)
               rows(d*(i - 1) + 1:d*i) = system%number(:, nodes(i))
            end do
         end associate
         call scatter(system%body, rows(:n), k(:n, :n))
      end do
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
         call scatter(system%body, [system%number(:, nodes(1)), system%number(:, nodes(2))], bar_stiffness(model, i))
      end associate
   end subroutine add_bar


   !> Hold component D of NODE from now on: it keeps its equation, and every solution has zero there.
   subroutine lock_unknown(node, d, system)
      integer, intent(in)                  :: node, d
      type(equation_system), intent(inout) :: system

      if (system%number(d, node) > 0) system%locked = [system%locked, system%number(d, node)]
   end subroutine lock_unknown


   !> [k_s] = [k_b] + sum of [k_int], Eq. (8), factorised. A structure without stiffness in some direction is a failure
   !! that names the node; WHERE says in which increment.
   subroutine form_structure_stiffness(model, k_int, where, system, failure)
      type(model_type), intent(in)         :: model
      real(wp), intent(in)                 :: k_int(:, :, :) !! (3, 3, n) of interface elements, in their axes [force/length]
      character(*), intent(in)             :: where
      type(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      real(wp) :: k(6, 6), k_global(3, 3)
      integer  :: d, fault, i, rows(6)

      system%structure = system%body
      d = model%dimension
      do i = 1, size(model%interface)
         associate (nodes => model%interface(i)%nodes)
            k_global = matmul(model%interface(i)%axes, matmul(k_int(:, :, i), transpose(model%interface(i)%axes)))
            k(:d, :d) = k_global(:d, :d)
            k(d + 1:2*d, d + 1:2*d) = k(:d, :d)
            k(:d, d + 1:2*d) = -k(:d, :d)
            k(d + 1:2*d, :d) = -k(:d, :d)
            rows(:d) = system%number(:, nodes(1))
            rows(d + 1:2*d) = 0
            if (nodes(2) > 0) rows(d + 1:2*d) = system%number(:, nodes(2))
            call scatter(system%structure, rows(:2*d), k(:2*d, :2*d))
         end associate
      end do
      do i = 1, size(system%locked)
         associate (diagonal => system%structure%values(system%structure%diagonal(system%locked(i))))
            diagonal = locked_stiffness*diagonal
         end associate
      end do
      call factorise_skyline(system%structure, pivot_tolerance, fault)
      if (fault > 0) call failure%raise(where//': the structure is a mechanism: '// &
         what_is_loose(model, system%node(fault), system%direction(fault))// &
         ' (not supported there, or every joint that held it is open)')
   end subroutine form_structure_stiffness


   !> What has no stiffness, in words.
   pure function what_is_loose(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: words
      character(1), parameter :: direction_name(3) = ['X', 'Y', 'Z']

      if (node <= n_points(model)) then
         words = 'node '//integer_text(model%node_id(node))//' has no stiffness in direction '//direction_name(d)
      else
         words = 'nothing holds BOLT '//integer_text(model%sections(node - n_points(model))%bolt)//' together at its section'
      end if
   end function what_is_loose


   !> Add an element matrix to the upper triangle; row 0 is a held component.
   pure subroutine scatter(matrix, rows, k)
      type(skyline_matrix), intent(inout) :: matrix
      integer, intent(in)                 :: rows(:)
      real(wp), intent(in)                :: k(:, :)
      integer :: i, j

      do j = 1, size(rows)
         if (rows(j) == 0) cycle
         do i = 1, size(rows)
            if (rows(i) == 0 .or. rows(i) > rows(j)) cycle
            call add_to_skyline(matrix, rows(i), rows(j), k(i, j))
         end do
      end do
   end subroutine scatter


   !> Displacements U of all nodes under the nodal forces F; held components, locked ones too, stay zero.
   subroutine solve_equations(system, f, u)
      type(equation_system), intent(in) :: system
      real(wp), intent(in)              :: f(:, :) !! (dimension, n_nodes) [force]
      real(wp), intent(out)             :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), allocatable :: x(:)
      integer :: i

      allocate (x(system%n))
      do i = 1, system%n
         x(i) = f(system%direction(i), system%node(i))
      end do
      x(system%locked) = 0.0_wp
      call solve_skyline(system%structure, x)
      x(system%locked) = 0.0_wp
      u = 0.0_wp
      do i = 1, system%n
         u(system%direction(i), system%node(i)) = x(i)
      end do
   end subroutine solve_equations

end module equations
