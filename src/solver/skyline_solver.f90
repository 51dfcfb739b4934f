!> The solver SKYLINE, the profile method of the period. [k_b] of the bodies is formed once in a profile. In every increment the
!! whole of [k_s] = [k_b] + sum of [k_int] is formed and factorised.
module skyline_solver
   use element_unknowns, only: nodes_of_unknowns
   use equation_solver, only: equation_system, failure_type
   use interface_equations, only: interface_equations_type, list_interface_equations
   use interface_operator, only: interface_element
   use kinds, only: long, wp
   use mass_matrix, only: coupled_dynamic_stiffness
   use memory_need, only: shortage
   use model_data, only: model_type
   use node_coupling, only: list_on_unknowns
   use node_graph, only: node_graph_type, reverse_cuthill_mckee
   use skyline, only: add_to_skyline, factor_times_vector, factorise_skyline, skyline_matrix, skyline_times_vector, &
                      solve_skyline, start_skyline
   use text_tools, only: integer_text
   use tolerances, only: pivot_tolerance
   implicit none
   private

   type, extends(equation_system), public :: skyline_solver_type
      integer(long) :: profile = 0                  !! entries in the skyline
      integer(long) :: profile_as_numbered = 0      !! the same in the order of the node numbers
      integer, allocatable :: first_row(:)          !! (n) of every column
      type(interface_equations_type) :: joints
      type(skyline_matrix) :: body                  !! [k_b]
      type(skyline_matrix) :: structure             !! [k_s], then its factor
   contains
      procedure :: lay_out, start, form_bodies, add_to_bodies, form_structure, multiply, solve_by_factor, multiply_by_factor
   end type skyline_solver_type

contains

   !> Number the unknowns and lay out the profile: reverse Cuthill-McKee, or the order of the nodes where its profile is smaller.
   subroutine lay_out(self, model, graph)
      class(skyline_solver_type), intent(inout) :: self
      type(model_type), intent(in)              :: model
      type(node_graph_type), intent(in)         :: graph
      integer, allocatable :: order(:), first_row_as_numbered(:)
      integer :: i

      call reverse_cuthill_mckee(graph, order)
      call self%number_unknowns(model, [(i, i = 1, model%mesh%n_nodes)])
      call lay_out_profile(graph, self, first_row_as_numbered, self%profile_as_numbered)
      call self%number_unknowns(model, order)
      call lay_out_profile(graph, self, self%first_row, self%profile)
      if (self%profile < self%profile_as_numbered) return
      call self%number_unknowns(model, [(i, i = 1, model%mesh%n_nodes)])
      call move_alloc(first_row_as_numbered, self%first_row)
      self%profile = self%profile_as_numbered
   end subroutine lay_out

   !> Lay out the profile, if not yet done, and allocate the matrix. The increments solve for all equations.
   subroutine start(self, model, graph, failure)
      class(skyline_solver_type), intent(inout) :: self
      type(model_type), intent(in)              :: model
      type(node_graph_type), intent(in)         :: graph
      type(failure_type), intent(inout)         :: failure
      character(:), allocatable :: words
      type(interface_element), allocatable :: elements(:)
      real(wp) :: share
      integer  :: i
      logical  :: ok

      if (.not. allocated(self%first_row)) call self%lay_out(model, graph)
      call shortage('the skyline of '//integer_text(self%n)//' equations needs', 16.0_wp*self%profile, words, share)
      if (words /= '') call failure%raise(words//'; SOLVER = TREE needs less')
      if (failure%raised) return
      call start_skyline(self%first_row, self%body, ok)
      if (.not. ok) call failure%raise('no memory for the skyline of '//integer_text(self%n)//' equations')
      self%equations = [(i, i = 1, self%n)]
      self%retained = pack([(i, i = 1, model%mesh%n_nodes)], model%freedoms%used)
      call list_on_unknowns(model, elements)
      call list_interface_equations(elements, self%number, self%joints)
      associate (description => self%description)
         description%name = 'SKYLINE'
         description%words(:2) = [character(40) :: 'PROFILE OF THE STIFFNESS MATRIX, ENTRIES', &
                                  '   IN THE ORDER OF THE NODE NUMBERS']
         description%numbers(:2) = [self%profile, self%profile_as_numbered]
      end associate
   end subroutine start

   !> First row of every column: the lowest equation of a node that shares an element or interface element with its own.
   subroutine lay_out_profile(graph, numbers, first_row, profile)
      type(node_graph_type), intent(in)  :: graph
      class(equation_system), intent(in) :: numbers
      integer, allocatable, intent(out)  :: first_row(:)
      integer(long), intent(out)         :: profile
      integer :: i, j

      allocate (first_row(numbers%n))
      do j = 1, numbers%n
         i = numbers%node(j)
         associate (rows => numbers%number(:, [i, graph%neighbours(graph%first(i):graph%first(i + 1) - 1)]))
            first_row(j) = minval(rows, mask=rows > 0)
         end associate
      end do
      profile = sum([(int(j - first_row(j) + 1, long), j = 1, numbers%n)])
   end subroutine lay_out_profile

   !> [k_b]: the stiffness of all bodies.
   subroutine form_bodies(self, model, fault)
      class(skyline_solver_type), intent(inout) :: self
      type(model_type), intent(in)              :: model
      integer, intent(out)                      :: fault
      real(wp), allocatable :: k(:, :)
      integer, allocatable  :: rows(:)
      integer :: e

      fault = 0
      allocate (rows(0))
      do e = 1, model%mesh%n_elements
         call coupled_dynamic_stiffness(model, e, self%shift, k)
         rows = [self%number(:, nodes_of_unknowns(model%freedoms, e))]
         call scatter(self%body, rows, k(:size(rows), :size(rows)))
      end do
      self%stiffest = max(0.0_wp, maxval(self%body%values(self%body%diagonal(1:))))
   end subroutine form_bodies

   subroutine add_to_bodies(self, rows, k)
      class(skyline_solver_type), intent(inout) :: self
      integer, intent(in)                       :: rows(:)
      real(wp), intent(in)                      :: k(:, :)

      call scatter(self%body, rows, k)
   end subroutine add_to_bodies

   !> [k_s] = [k_b] + sum of [k_int], Eq. (8), factorised without the locked equations.
   subroutine form_structure(self, fault)
      class(skyline_solver_type), intent(inout) :: self
      integer, intent(out)                      :: fault
      integer :: i, j
      integer(long) :: place

      self%structure = self%body
      associate (matrix => self%structure, locked => self%locked)
         do i = 1, self%joints%n
            call scatter(matrix, self%joints%rows_of(i), self%joints%matrix_of(i, self%k_int(:, :, i)))
         end do
         do i = 1, size(locked)
            do j = locked(i), matrix%n
               place = matrix%diagonal(j) - (j - locked(i))
               if (place > matrix%diagonal(j - 1)) matrix%values(place) = 0.0_wp
            end do
            matrix%values(matrix%diagonal(locked(i) - 1) + 1:matrix%diagonal(locked(i))) = 0.0_wp
            matrix%values(matrix%diagonal(locked(i))) = 1.0_wp
         end do
         self%diagonal = matrix%values(matrix%diagonal(1:))
         call factorise_skyline(matrix, pivot_tolerance, fault, with_signs=self%shift > 0.0_wp)
         self%weakest = 1.0_wp
         if (fault /= 0) return
         self%weakest = minval(matrix%values(matrix%diagonal(1:))**2/max(abs(self%diagonal), tiny(1.0_wp)))
         self%n_negative = size(matrix%negative)
      end associate
   end subroutine form_structure

   subroutine multiply(self, x, y)
      class(skyline_solver_type), intent(in) :: self
      real(wp), intent(in)                   :: x(:)
      real(wp), intent(inout)                :: y(:)

      call skyline_times_vector(self%body, x, y)
   end subroutine multiply

   subroutine solve_by_factor(self, x)
      class(skyline_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout)    :: x(:)

      x(self%locked) = 0.0_wp
      call solve_skyline(self%structure, x)
   end subroutine solve_by_factor

   subroutine multiply_by_factor(self, x)
      class(skyline_solver_type), intent(in) :: self
      real(wp), contiguous, intent(inout)    :: x(:)

      x(self%locked) = 0.0_wp
      call factor_times_vector(self%structure, x)
   end subroutine multiply_by_factor

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
