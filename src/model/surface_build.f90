!> Marked surfaces: which body elements their edges belong to, which way they face, the areas of their nodes.
module surface_build
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use id_table, only: id_table_type, sorted_order
   use kinds, only: wp
   use mesh_build, only: marked_edges
   use model_data, only: model_type, surface_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_surfaces, surface_nodes

   !> The nodes of a surface, each once, in ascending order of their numbers.
   type, public :: surface_node_list
      integer :: n = 0
      integer, allocatable  :: node(:)      !! (n) positions
      real(wp), allocatable :: area(:)      !! (n) areas of influence a_i [length^2]
      real(wp), allocatable :: normal(:, :) !! (3, n) unit normals out of the body
   end type surface_node_list

contains

   !> One surface for every PMARK card, with the edges that name it.
   subroutine build_surfaces(deck, edges, model, errors)
      type(deck_type), intent(in)          :: deck
      type(marked_edges), intent(in)       :: edges
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(id_table_type)  :: marks
      integer, allocatable :: surface(:), filled(:)
      integer :: i, k, n

      n = deck%bulk%n_pmark
      call marks%build(deck%bulk%pmark(:n)%id)
      allocate (model%surfaces(n), surface(edges%n), filled(n))
      filled = 0
      do i = 1, edges%n
         surface(i) = marks%find(edges%mark(i))
         if (surface(i) == 0 .and. edges%mark(i) > 0) then
            call add_field_error(deck%text, edges%line(i), edges%field(i), mark_name(edges%field(i)), 'there is no PMARK '// &
                                 integer_text(edges%mark(i)), errors)
         else if (surface(i) > 0) then
            filled(surface(i)) = filled(surface(i)) + 1
         end if
      end do
      do k = 1, n
         model%surfaces(k)%id = deck%bulk%pmark(k)%id
         model%surfaces(k)%n = 0
         allocate (model%surfaces(k)%nodes(2, filled(k)), model%surfaces(k)%element(filled(k)), &
                   model%surfaces(k)%other(filled(k)), model%surfaces(k)%line(filled(k)))
         if (filled(k) > 0 .or. model%surfaces(k)%id == 0) cycle
         if (findloc(deck%bulk%pmark(:k)%id, model%surfaces(k)%id, dim=1) < k) cycle ! a number given twice: said elsewhere
         call add_field_error(deck%text, deck%bulk%pmark(k)%line, 1, 'PID', 'surface '//integer_text(model%surfaces(k)%id)// &
                              ' has no edge: expected a CBAR, CROD or side of a block with this PID', errors)
      end do
      do i = 1, edges%n
         if (surface(i) == 0 .or. any(edges%nodes(:, i) == 0)) cycle
         call add_edge(edges, i, model, model%surfaces(surface(i)), errors)
      end do
      do k = 1, n
         call check_repeated(model, model%surfaces(k), errors)
      end do
   end subroutine build_surfaces


   !> The field that names a mark: PID of an edge, S1 to S4 of a block.
   pure function mark_name(field) result(name)
      integer, intent(in)       :: field
      character(:), allocatable :: name

      name = 'PID'
      if (field > 16) name = 'S'//integer_text(field - 16)
   end function mark_name


   !> Add edge I to its surface, run through with its body on the left.
   subroutine add_edge(edges, i, model, surface, errors)
      type(marked_edges), intent(in)       :: edges
      integer, intent(in)                  :: i
      type(model_type), intent(in)         :: model
      type(surface_type), intent(inout)    :: surface
      type(deck_error_list), intent(inout) :: errors
      integer :: left, right

      left = element_left_of(model, edges%nodes(1, i), edges%nodes(2, i))
      right = element_left_of(model, edges%nodes(2, i), edges%nodes(1, i))
      if (left == 0 .and. right == 0) then
         call errors%add(edges%line(i), 'the edge between nodes '//integer_text(model%node_id(edges%nodes(1, i)))//' and '// &
                         integer_text(model%node_id(edges%nodes(2, i)))//' is no side of a body element')
         return
      end if
      surface%n = surface%n + 1
      surface%line(surface%n) = edges%line(i)
      if (left > 0) then
         surface%nodes(:, surface%n) = edges%nodes(:, i)
         surface%element(surface%n) = left
         surface%other(surface%n) = right
      else
         surface%nodes(:, surface%n) = edges%nodes([2, 1], i)
         surface%element(surface%n) = right
         surface%other(surface%n) = 0
      end if
   end subroutine add_edge


   !> No edge stands twice on a surface: its area would count twice.
   subroutine check_repeated(model, surface, errors)
      type(model_type), intent(in)         :: model
      type(surface_type), intent(in)       :: surface
      type(deck_error_list), intent(inout) :: errors
      integer, allocatable :: order(:)
      integer :: j, k

      call sorted_order(minval(surface%nodes(:, :surface%n), dim=1), order)
      do k = 2, surface%n
         do j = k - 1, 1, -1
            associate (this => surface%nodes(:, order(k)), that => surface%nodes(:, order(j)))
               if (minval(this) /= minval(that)) exit
               if (maxval(this) /= maxval(that)) cycle
               call errors%add(max(surface%line(order(k)), surface%line(order(j))), 'surface '//integer_text(surface%id)// &
                  ': the edge between nodes '//integer_text(model%node_id(this(1)))//' and '// &
                  integer_text(model%node_id(this(2)))//' is marked twice')
            end associate
         end do
      end do
   end subroutine check_repeated


   !> The element that has the side A -> B in its counter-clockwise round, 0 for none.
   pure integer function element_left_of(model, a, b) result(element)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: a, b
      integer :: i, k

      do i = model%first_at(a), model%first_at(a + 1) - 1
         element = model%elements_at(i)
         do k = 1, 4
            if (model%element_nodes(k, element) == a .and. model%element_nodes(modulo(k, 4) + 1, element) == b) return
         end do
      end do
      element = 0
   end function element_left_of


   !> The nodes of SURFACE with their areas of influence, a_i = sum over the edges of the integral of N_i over the face:
   !! half the length times the thickness (section 4.1), and their normals (mean of the edges' by area).
   pure subroutine surface_nodes(model, surface, list)
      type(model_type), intent(in)         :: model
      type(surface_type), intent(in)       :: surface
      type(surface_node_list), intent(out) :: list
      integer, allocatable :: place(:)
      real(wp) :: along(2), area
      integer  :: e, k, lowest, highest, node

      if (surface%n == 0) then
         allocate (list%node(0), list%area(0), list%normal(3, 0))
         return
      end if
      lowest = minval(surface%nodes(:, :surface%n))
      highest = maxval(surface%nodes(:, :surface%n))
      allocate (place(lowest:highest), source=0)
      do e = 1, surface%n
         place(surface%nodes(:, e)) = 1
      end do
      do node = lowest, highest
         if (place(node) == 0) cycle
         list%n = list%n + 1
         place(node) = list%n
      end do
      allocate (list%node(list%n), source=0)
      allocate (list%area(list%n), source=0.0_wp)
      allocate (list%normal(3, list%n), source=0.0_wp)
      do e = 1, surface%n
         along = model%x(:2, surface%nodes(2, e)) - model%x(:2, surface%nodes(1, e))
         area = 0.0_wp
         if (model%element_property(surface%element(e)) > 0) &
            area = 0.5_wp*norm2(along)*model%properties(model%element_property(surface%element(e)))%thickness
         do k = 1, 2
            node = place(surface%nodes(k, e))
            list%node(node) = surface%nodes(k, e)
            list%area(node) = list%area(node) + area
            list%normal(:2, node) = list%normal(:2, node) + area*[along(2), -along(1)]/max(norm2(along), tiny(1.0_wp))
         end do
      end do
      do k = 1, list%n
         list%normal(:, k) = list%normal(:, k)/max(norm2(list%normal(:, k)), tiny(1.0_wp))
      end do
   end subroutine surface_nodes

end module surface_build
