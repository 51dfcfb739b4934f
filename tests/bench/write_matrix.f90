!> The equations of the first increment of a deck, for a solver beside ours:
!!
!!    write_matrix DECK FILE
!!
!! [k_s] = [k_b] + the first [k_int] of every interface element, its lower triangle by columns; the load of the first increment;
!! and which displacements close which interface element, by which a solution can be compared with the listing. The unknowns are
!! the free components, node after node. FILE, without record marks, in the machine's own kinds:
!!
!!    integer         n, entries, m       equations, entries of the triangle, interface elements
!!    integer         start(n + 1)        entries start(j) + 1 to start(j + 1) are column j
!!    integer         row(entries)        from 0, in no order within a column
!!    real(wp)        value(entries)      [force/length]
!!    real(wp)        load(n)             {dF} [force]
!!    integer         closing_row(6, m)   from 0, -1: no displacement
!!    real(wp)        closing(6, m)       lambda = sum of closing*displacement
program write_matrix
   use, intrinsic :: iso_fortran_env, only: error_unit
   use body_elements, only: coupled_stiffness
   use terminal, only: argument_text
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type, read_deck
   use element_kinds, only: max_dofs
   use element_unknowns, only: nodes_of_unknowns
   use joint_laws, only: stiffness_at_rest
   use kinds, only: wp
   use model_build, only: build_model
   use model_data, only: model_type, n_bars, n_sections
   use skyline_solver, only: skyline_solver_type
   use stage_plan, only: stage_plan_type
   implicit none
   type(deck_type)        :: deck
   type(deck_error_list)  :: errors
   type(model_type)       :: model
   type(stage_plan_type)  :: plan
   type(skyline_solver_type) :: numbers ! of the unknowns; no matrix
   integer, allocatable  :: start(:), row(:), closing_row(:, :)
   real(wp), allocatable :: value(:), load(:), closing(:, :)
   integer :: i, status, unit
   logical :: readable

   call read_deck(argument_text(1), deck, errors, readable)
   if (.not. readable) call stop_with('cannot be read')
   call build_model(deck, model, plan, errors)
   if (errors%any()) call stop_with('has errors')
   if (n_bars(model%mesh) > 0 .or. n_sections(model%mesh) > 0) call stop_with('has bars or bolts')
   if (allocated(model%history%stages(1)%moved)) call stop_with('has moved supports')
   call numbers%number_unknowns(model, [(i, i = 1, model%mesh%n_nodes)])
   call assemble(start, row, value)
   call first_load(load)
   call closing_displacements(closing_row, closing)

   open (newunit=unit, file=argument_text(2), form='unformatted', access='stream', action='write', status='replace', &
         iostat=status)
   if (status == 0) write (unit, iostat=status) numbers%n, size(row), size(model%joints%element), start, row - 1, value, load, &
      closing_row - 1, closing
   if (status == 0) close (unit, iostat=status)
   if (status /= 0) call stop_with('its equations cannot be written to '//argument_text(2))

contains

   !> The lower triangle by columns: count the entries of all elements, deal them out to columns, add up each column.
   subroutine assemble(start, row, value)
      integer, allocatable, intent(out)  :: start(:), row(:)
      real(wp), allocatable, intent(out) :: value(:)
      integer, allocatable  :: place(:), rows(:), position(:)
      real(wp), allocatable :: values(:)
      integer :: filled, first, j, k, last

      allocate (place(numbers%n + 1), source=0)
      call visit_all(place)
      do j = 1, numbers%n
         place(j + 1) = place(j + 1) + place(j)
      end do
      allocate (rows(place(numbers%n + 1)), values(place(numbers%n + 1)))
      call visit_all(place, rows, values)
      ! now place(j) is where column j ends
      allocate (start(numbers%n + 1), position(numbers%n), source=0)
      filled = 0
      do j = 1, numbers%n
         first = 1
         if (j > 1) first = place(j - 1) + 1
         last = place(j)
         start(j) = filled
         do k = first, last
            if (position(rows(k)) <= start(j)) then
               filled = filled + 1
               position(rows(k)) = filled
               rows(filled) = rows(k)
               values(filled) = values(k)
            else
               values(position(rows(k))) = values(position(rows(k))) + values(k)
            end if
         end do
      end do
      start(numbers%n + 1) = filled
      allocate (row, source=rows(:filled))
      allocate (value, source=values(:filled))
   end subroutine assemble

   !> All elements and interface elements: without ROWS and VALUES, PLACE(j + 1) becomes the number of entries of column j; with
   !! them, PLACE(j) the last one so far.
   subroutine visit_all(place, rows, values)
      integer, intent(inout)            :: place(:)
      integer, intent(inout), optional  :: rows(:)
      real(wp), intent(inout), optional :: values(:)
      real(wp), allocatable :: k(:, :)
      real(wp) :: k_int(3), k_global(3, 3)
      integer :: d, e, i

      d = model%mesh%dimension
      allocate (k(max_dofs, max_dofs), source=0.0_wp)
      do e = 1, model%mesh%n_elements
         if (present(rows)) call coupled_stiffness(model, e, k)
         call visit(equations_of(nodes_of_unknowns(model%freedoms, e)), k, place, rows, values)
      end do
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i))
            k_int = stiffness_at_rest(model%joints%list(element%joint)%law, element%area, model%joints%list(element%joint)%p_av)
            k_global = matmul(element%axes*spread(k_int, 1, 3), transpose(element%axes))
            k(:d, :d) = k_global(:d, :d)
            k(d + 1:2*d, d + 1:2*d) = k_global(:d, :d)
            k(:d, d + 1:2*d) = -k_global(:d, :d)
            k(d + 1:2*d, :d) = -k_global(:d, :d)
            call visit(equations_of(element%node), k, place, rows, values)
         end associate
      end do
   end subroutine visit_all

   !> Equations of the components of NODES, 0: held.
   function equations_of(nodes) result(equations)
      integer, intent(in) :: nodes(:)
      integer :: equations(model%mesh%dimension*size(nodes))

      equations = reshape(numbers%number(:, nodes), [size(equations)])
   end function equations_of

   !> The lower triangle of one matrix K of EQUATIONS.
   subroutine visit(equations, k, place, rows, values)
      integer, intent(in)               :: equations(:)
      real(wp), intent(in)              :: k(:, :)
      integer, intent(inout)            :: place(:)
      integer, intent(inout), optional  :: rows(:)
      real(wp), intent(inout), optional :: values(:)
      integer :: a, b, column

      do b = 1, size(equations)
         column = equations(b)
         if (column == 0) cycle
         do a = 1, size(equations)
            if (equations(a) < column) cycle
            if (present(rows)) then
               place(column) = place(column) + 1
               rows(place(column)) = equations(a)
               values(place(column)) = k(a, b)
            else
               place(column + 1) = place(column + 1) + 1
            end if
         end do
      end do
   end subroutine visit

   !> {dF}: the share of the first increment.
   subroutine first_load(load)
      real(wp), allocatable, intent(out) :: load(:)
      integer :: d, equation, i

      allocate (load(numbers%n), source=0.0_wp)
      associate (loads => model%history%stages(1))
         do i = 1, loads%n
            do d = 1, model%mesh%dimension
               equation = numbers%number(d, loads%node(i))
               if (equation > 0) load(equation) = load(equation) + plan%stages(1)%fractions(1)*loads%force(d, i)
            end do
         end do
      end associate
   end subroutine first_load

   !> What closes the interface elements: the displacements of node 1 along the normal, those of node 2 against it.
   subroutine closing_displacements(rows, factors)
      integer, allocatable, intent(out)  :: rows(:, :)
      real(wp), allocatable, intent(out) :: factors(:, :)
      integer :: d, i, k

      d = model%mesh%dimension
      allocate (rows(6, size(model%joints%element)), source=0)
      allocate (factors(6, size(model%joints%element)), source=0.0_wp)
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i))
            do k = 1, size(element%node)
               rows(3*k - 2:3*k - 3 + d, i) = numbers%number(:, element%node(k))
               factors(3*k - 2:3*k - 3 + d, i) = element%weight(k)*element%axes(:d, 3)
            end do
         end associate
      end do
   end subroutine closing_displacements

   !> Say what is wrong with the deck, and end with status 1.
   subroutine stop_with(words)
      character(*), intent(in) :: words

      write (error_unit, '(4a)') 'write_matrix: ', argument_text(1), ': ', words
      stop 1, quiet=.true.
   end subroutine stop_with

end program write_matrix
