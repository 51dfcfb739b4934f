!> The solver SKYLINE, the method of the period: [k_b] of the bodies formed once in a profile; in every increment
!! [k_s] = [k_b] + sum of [k_int] formed and factorised, all of it.
module skyline_solver
   use body_elements, only: coupled_stiffness
   use element_kinds, only: max_coupled_dofs
   use equation_numbering, only: equation_numbers, number_unknowns
   use failures, only: failure_type
   use kinds, only: long, wp
   use machine, only: memory_for
   use model_data, only: model_type, n_bars
   use section_coupling, only: coupled_nodes
   use node_graph, only: node_graph_type
   use profile_ordering, only: reverse_cuthill_mckee
   use skyline, only: add_to_skyline, factorise_skyline, skyline_matrix, start_skyline
   use text_tools, only: integer_text
   implicit none
   private

   public :: lay_out_skyline, start_skyline_solver, form_skyline_bodies, form_skyline_structure, scatter

   real(wp), parameter :: pivot_tolerance = 1.0e-12_wp ! of the diagonal entry: below it there is no stiffness

   type, public :: skyline_solver_type
      integer(long) :: profile = 0                  !! entries in the skyline
      integer(long) :: profile_as_numbered = 0      !! what they would be in the order of the node numbers
      integer, allocatable :: first_row(:)          !! (n) of every column
      type(skyline_matrix) :: body                  !! [k_b]
      type(skyline_matrix) :: structure             !! [k_s], then its factor
   end type skyline_solver_type

contains

   !> Number the unknowns and lay out the profile: reverse Cuthill-McKee, or the nodes' own order where that is tighter.
   subroutine lay_out_skyline(model, graph, numbers, solver)
      type(model_type), intent(in)             :: model
      type(node_graph_type), intent(in)        :: graph
      class(equation_numbers), intent(inout)   :: numbers
      type(skyline_solver_type), intent(inout) :: solver
      integer, allocatable :: order(:), first_row_as_numbered(:)
      integer :: i

      call reverse_cuthill_mckee(graph, order)
      call number_unknowns(model, [(i, i = 1, model%n_nodes)], numbers)
      call lay_out_profile(model, numbers, first_row_as_numbered, solver%profile_as_numbered)
      call number_unknowns(model, order, numbers)
      call lay_out_profile(model, numbers, solver%first_row, solver%profile)
      if (solver%profile < solver%profile_as_numbered) return
      call number_unknowns(model, [(i, i = 1, model%n_nodes)], numbers)
      call move_alloc(first_row_as_numbered, solver%first_row)
      solver%profile = solver%profile_as_numbered
   end subroutine lay_out_skyline


   !> Make room for the matrix that is laid out.
   subroutine start_skyline_solver(solver, failure)
      type(skyline_solver_type), intent(inout) :: solver
      type(failure_type), intent(inout)        :: failure
      integer(long) :: there
      logical :: ok

      associate (n => size(solver%first_row), needed => 16*solver%profile)
         there = memory_for(real(needed, wp))
         if (needed > there) then
            call failure%raise('the skyline of '//integer_text(n)//' equations needs '// &
                               integer_text(int(needed/1048576))//' MiB, and the machine has '// &
                               integer_text(int(there/1048576))//' MiB to give; SOLVER = TREE needs less')
         else
            call start_skyline(solver%first_row, solver%body, ok)
            if (.not. ok) call failure%raise('no memory for the skyline of '//integer_text(n)//' equations')
         end if
      end associate
   end subroutine start_skyline_solver


   !> First row of every column: the lowest equation that shares an element or interface element.
   subroutine lay_out_profile(model, numbers, first_row, profile)
      type(model_type), intent(in)        :: model
      class(equation_numbers), intent(in) :: numbers
      integer, allocatable, intent(out)   :: first_row(:)
      integer(long), intent(out)          :: profile
      integer :: e, i

      allocate (first_row, source=[(i, i = 1, numbers%n)])
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
      do i = 1, numbers%n
         profile = profile + i - first_row(i) + 1
      end do

   contains

      subroutine couple(nodes)
         integer, intent(in) :: nodes(:)
         integer :: d, k, equation, lowest

         lowest = huge(lowest)
         do k = 1, size(nodes)
            do d = 1, model%dimension
               equation = numbers%number(d, nodes(k))
               if (equation > 0) lowest = min(lowest, equation)
            end do
         end do
         do k = 1, size(nodes)
            do d = 1, model%dimension
               equation = numbers%number(d, nodes(k))
               if (equation > 0) first_row(equation) = min(first_row(equation), lowest)
            end do
         end do
      end subroutine couple

   end subroutine lay_out_profile


   !> [k_b]: the stiffness of all bodies.
   subroutine form_skyline_bodies(model, numbers, solver)
      type(model_type), intent(in)             :: model
      class(equation_numbers), intent(in)      :: numbers
      type(skyline_solver_type), intent(inout) :: solver
      real(wp) :: k(max_coupled_dofs, max_coupled_dofs)
      integer  :: d, e, n, rows(max_coupled_dofs)

      d = model%dimension
      do e = 1, model%n_elements
         call coupled_stiffness(model, e, k)
         associate (nodes => coupled_nodes(model, e))
            n = d*size(nodes)
            rows(:n) = [numbers%number(:, nodes)]
         end associate
         call scatter(solver%body, rows(:n), k(:n, :n))
      end do
   end subroutine form_skyline_bodies


   !> [k_s] = [k_b] + sum of [k_int], Eq. (8), factorised. The LOCKED equations take no part. FAULT is 0 or the first equation
   !! without stiffness.
   subroutine form_skyline_structure(k_int, equations, locked, solver, fault)
      real(wp), intent(in)                     :: k_int(:, :, :)  !! (6, 6, n) of interface elements [force/length]
      integer, intent(in)                      :: equations(:, :) !! (6, n) their equations, 0: held
      integer, intent(in)                      :: locked(:)
      type(skyline_solver_type), intent(inout) :: solver
      integer, intent(out)                     :: fault
      integer :: i, j
      integer(long) :: place

      solver%structure = solver%body
      associate (matrix => solver%structure)
         do i = 1, size(equations, 2)
            call scatter(matrix, equations(:, i), k_int(:, :, i))
         end do
         do i = 1, size(locked)
            do j = locked(i), matrix%n
               place = matrix%diagonal(j) - (j - locked(i))
               if (place > matrix%diagonal(j - 1)) matrix%values(place) = 0.0_wp
            end do
            matrix%values(matrix%diagonal(locked(i) - 1) + 1:matrix%diagonal(locked(i))) = 0.0_wp
            matrix%values(matrix%diagonal(locked(i))) = 1.0_wp
         end do
         call factorise_skyline(matrix, pivot_tolerance, fault)
      end associate
   end subroutine form_skyline_structure


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

end module skyline_solver
