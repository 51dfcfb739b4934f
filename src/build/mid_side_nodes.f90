!> Mid-side nodes of second-order elements: those that cards leave blank are put at the middle of their edge, one for all elements
!! that share it; and all elements at an edge must have the same node there, or none.
module mid_side_nodes
   use deck_check, only: checked_deck
   use element_kinds, only: element_table
   use kinds, only: wp
   use model_data, only: has_second_order, model_type
   use node_build, only: append_nodes
   use reverse_lists, only: list_owners
   use text_tools, only: integer_text
   implicit none
   private

   public :: fill_mid_sides

   integer, parameter, public :: blank_node = -1   !! in element_nodes, until fill_mid_sides: left blank on the card

   !> The edges of all elements, element by element: one that several elements share stands here as often.
   type :: edge_list
      integer :: n = 0
      integer, allocatable :: ends(:, :)     ! (2, n) corners, the lower position first
      integer, allocatable :: element(:)     ! (n)
      integer, allocatable :: place(:)       ! (n) of its mid-side node in element_nodes(:, element); 0: a linear element
      integer, allocatable :: first(:)       ! (n) the first edge between the same corners
      integer, allocatable :: namer(:)       ! (n) of that first one: the first of them that names its mid-side node, else the first
   end type edge_list                        ! that is of second order, else itself

contains

   !> Put nodes at the middle of the edges whose mid-side node is blank: the one that another element names there, else a new one,
   !! numbered behind all nodes that there are, in the order of the elements. Elements that share an edge and differ in what they
   !! have at its middle are errors.
   subroutine fill_mid_sides(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(edge_list) :: edges
      integer :: i, n_new

      if (.not. has_second_order(model)) return
      call list_edges(model, edges)
      call match_edges(model, edges)
      call check_orders(deck, model, edges)
      n_new = 0
      do i = 1, edges%n
         if (node_at(model, edges, i) /= blank_node) cycle
         associate (own => model%element_nodes(edges%place(i), edges%element(i)))
            own = node_at(model, edges, edges%namer(edges%first(i)))
            if (own /= blank_node) cycle
            n_new = n_new + 1
            own = model%n_nodes + n_new
         end associate
      end do
      model%n_filled = n_new
      model%first_filled = model%n_nodes + 1
      if (n_new > 0) call place_nodes(deck, model, edges, n_new)
      where (model%element_nodes == blank_node) model%element_nodes = 0 ! of edges whose corners are in error
   end subroutine fill_mid_sides

   !> The edges of all elements, those without their corners left out.
   pure subroutine list_edges(model, edges)
      type(model_type), intent(in) :: model
      type(edge_list), intent(out) :: edges
      integer :: e, ends(2), k, total

      total = sum(element_table(model%element_kind)%n_edges)
      allocate (edges%ends(2, total), edges%element(total), edges%place(total))
      do e = 1, model%n_elements
         associate (kind => element_table(model%element_kind(e)))
            do k = 1, kind%n_edges
               ends = model%element_nodes(kind%edges(:, k), e)
               if (any(ends == 0)) cycle ! said already
               edges%n = edges%n + 1
               edges%ends(:, edges%n) = [minval(ends), maxval(ends)]
               edges%element(edges%n) = e
               edges%place(edges%n) = merge(kind%n_corners + k, 0, kind%n_nodes > kind%n_corners)
            end do
         end associate
      end do
   end subroutine list_edges

   !> Which edges lie between the same corners, and who names the node there.
   pure subroutine match_edges(model, edges)
      type(model_type), intent(in)   :: model
      type(edge_list), intent(inout) :: edges
      integer, allocatable :: start(:), at(:)
      integer :: c, i, k, node

      call list_owners(model%n_nodes, reshape(edges%ends(1, :edges%n), [1, edges%n]), start, at)
      allocate (edges%first(edges%n), edges%namer(edges%n))
      do node = 1, model%n_nodes
         do i = start(node), start(node + 1) - 1
            c = at(i)
            edges%first(c) = c
            edges%namer(c) = c
            do k = start(node), i - 1
               if (edges%ends(2, at(k)) /= edges%ends(2, c)) cycle
               edges%first(c) = edges%first(at(k))
               exit
            end do
            associate (namer => edges%namer(edges%first(c)))
               if (weight(c) > weight(namer)) namer = c
            end associate
         end do
      end do

   contains

      !> What edge I says about its middle: 2 names a node, 1 leaves it to be filled, 0 has none.
      pure integer function weight(i)
         integer, intent(in) :: i

         weight = 0
         if (edges%place(i) > 0) weight = merge(2, 1, node_at(model, edges, i) > 0)
      end function weight

   end subroutine match_edges

   !> The mid-side node of edge I: 0 where there is none, or where that which the card names is not there, blank_node where blank.
   pure integer function node_at(model, edges, i) result(node)
      type(model_type), intent(in) :: model
      type(edge_list), intent(in)  :: edges
      integer, intent(in)          :: i

      node = 0
      if (edges%place(i) > 0) node = model%element_nodes(edges%place(i), edges%element(i))
   end function node_at

   !> All elements at an edge have one node at its middle, or none has; an element is named once.
   subroutine check_orders(deck, model, edges)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(edge_list), intent(in)    :: edges
      integer :: i, last, node, other
      character(:), allocatable :: edge, own

      last = 0
      own = ''
      edge = ''
      do i = 1, edges%n
         other = edges%namer(edges%first(i))
         if (edges%element(i) == last .or. other == i) cycle
         node = node_at(model, edges, i)
         if (edges%place(i) == 0 .and. edges%place(other) == 0) cycle
         if (edges%place(i) > 0 .and. (node <= 0 .or. node == node_at(model, edges, other))) cycle
         last = edges%element(i)
         own = 'element '//integer_text(model%element_id(last))
         associate (a => model%node_id(edges%ends(1, i)), b => model%node_id(edges%ends(2, i)))
            edge = 'the edge between nodes '//integer_text(a)//' and '//integer_text(b)//' with element '// &
                   integer_text(model%element_id(edges%element(other)))
         end associate
         if (edges%place(i) == 0) then
            call deck%errors%add(model%element_line(last), own//' is linear, and shares '//edge//', which is of second order; '// &
               'expected both of one order, or bodies that do not share their nodes and a JOINT between them')
         else
            call deck%errors%add(model%element_line(last), own//' has node '//integer_text(model%node_id(node))// &
               ' at the middle of '//edge//', which has node '//integer_text(model%node_id(node_at(model, edges, other)))//' there')
         end if
      end do
   end subroutine check_orders

   !> Put the N_NEW nodes that elements have behind those of MODEL at the middle of their edges.
   subroutine place_nodes(deck, model, edges, n_new)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      type(edge_list), intent(in)     :: edges
      integer, intent(in)             :: n_new
      real(wp), allocatable :: x(:, :)
      integer :: i, n, node

      n = model%n_nodes
      if (model%node_id(n) > huge(1) - n_new) then
         call deck%errors%add(0, 'the mid-side nodes that are left blank are numbered behind node '// &
                              integer_text(model%node_id(n))//', and their numbers would pass 2147483647')
         where (model%element_nodes > n) model%element_nodes = 0
         return
      end if
      allocate (x(3, n_new))
      do i = 1, edges%n
         node = node_at(model, edges, i)
         if (node > n) x(:, node - n) = 0.5_wp*(model%x(:, edges%ends(1, i)) + model%x(:, edges%ends(2, i)))
      end do
      call append_nodes(model, x)
   end subroutine place_nodes

end module mid_side_nodes
