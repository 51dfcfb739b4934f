!> A joint on one shared surface: where bodies lie on both sides of a marked surface and share its nodes, the nodes are
!! doubled, so that interface elements can stand between them.
module joint_split
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use mesh_build, only: list_elements_of_nodes
   use model_data, only: model_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: split_shared_surfaces

   !> The nodes of a surface that was split, and the new node on the other side of each.
   type :: split_type
      integer, allocatable :: node(:), twin(:)
   end type split_type

contains

   !> Split the shared surfaces that JOINT cards name as SIDE1 without a SIDE2. The elements on the left of the surface's
   !! edges keep the nodes, those on the right get the twins, numbered from the highest node number on.
   subroutine split_shared_surfaces(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      integer :: j, s

      allocate (model%twin(model%n_nodes), source=0)
      do j = 1, deck%bulk%n_joint
         if (deck%bulk%joint(j)%sides(2) /= 0) cycle
         s = findloc(model%surfaces%id, deck%bulk%joint(j)%sides(1), dim=1)
         if (s == 0) cycle
         if (model%surfaces(s)%n == 0) cycle
         if (.not. any(model%surfaces(s)%other(:model%surfaces(s)%n) > 0)) cycle
         if (any(model%surfaces(s)%other(:model%surfaces(s)%n) == 0)) then
            call add_field_error(deck%text, deck%bulk%joint(j)%line, 3, 'SIDE1', 'bodies lie on both sides of some edges of '// &
                                 'surface '//integer_text(model%surfaces(s)%id)//' and on one side of others', errors)
            cycle
         end if
         if (any(meets_a_split(model, s))) then
            call add_field_error(deck%text, deck%bulk%joint(j)%line, 3, 'SIDE1', 'surface '// &
               integer_text(model%surfaces(s)%id)//' meets another surface that is split, at node '// &
               integer_text(model%node_id(findloc(meets_a_split(model, s), .true., dim=1)))// &
               ': mesh the bodies apart there and give both faces, SIDE1 and SIDE2', errors)
            cycle
         end if
         call split_surface(model, s)
         call list_elements_of_nodes(model)
      end do
   end subroutine split_shared_surfaces


   !> Which nodes of surface S belong to a surface that was split before, or are twins of its nodes.
   pure function meets_a_split(model, s) result(meets)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: s
      logical :: meets(model%n_nodes), is_twin(model%n_nodes)
      integer :: i, k, node

      meets = .false.
      is_twin = .false.
      is_twin(pack(model%twin, model%twin > 0)) = .true.
      do i = 1, model%surfaces(s)%n
         do k = 1, 2
            node = model%surfaces(s)%nodes(k, i)
            meets(node) = model%twin(node) > 0 .or. is_twin(node)
         end do
      end do
   end function meets_a_split


   subroutine split_surface(model, s)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      type(split_type)     :: split
      integer, allocatable :: edges_at(:, :), right(:)
      integer :: i, k, n, node

      call list_edges_of_nodes(model, s, edges_at)
      call face_one_way(model, s, edges_at)
      n = 0
      allocate (split%node(count(edges_at(1, :) > 0)), split%twin(count(edges_at(1, :) > 0)), source=0)
      do node = 1, model%n_nodes
         if (edges_at(1, node) == 0) cycle
         call right_of(model, s, edges_at(:, node), node, right)
         if (size(right) == 0) cycle          ! the surface ends inside a body here: the tip stays whole
         n = n + 1
         split%node(n) = node
         split%twin(n) = model%n_nodes + n
      end do
      split%node = split%node(:n)
      split%twin = split%twin(:n)
      do k = 1, n                             ! FIRST_AT and ELEMENTS_AT still are those of the whole nodes
         call right_of(model, s, edges_at(:, split%node(k)), split%node(k), right)
         do i = 1, size(right)
            associate (corners => model%element_nodes(:, right(i)))
               corners = merge(split%twin(k), corners, corners == split%node(k))
            end associate
         end do
      end do
      call add_twins(model, split)
      call move_other_surfaces(model, s)
      model%surfaces(s)%other = 0
   end subroutine split_surface


   !> The one or two edges of surface S at every node.
   subroutine list_edges_of_nodes(model, s, edges_at)
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: s
      integer, allocatable, intent(out) :: edges_at(:, :) !! (2, n_nodes)
      integer :: i, k, node

      allocate (edges_at(2, model%n_nodes), source=0)
      do i = 1, model%surfaces(s)%n
         do k = 1, 2
            node = model%surfaces(s)%nodes(k, i)
            edges_at(merge(1, 2, edges_at(1, node) == 0), node) = i
         end do
      end do
   end subroutine list_edges_of_nodes


   !> Turn edges of surface S round so that each goes on where another ends: the same body side on the left of all.
   subroutine face_one_way(model, s, at)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      integer, intent(in)             :: at(:, :)
      integer, allocatable :: queue(:)
      logical, allocatable :: done(:)
      integer :: edge, first, i, k, n, last, other, node

      associate (surface => model%surfaces(s))
         allocate (done(surface%n), queue(surface%n))
         done = .false.
         do first = 1, surface%n
            if (done(first)) cycle
            queue(1) = first
            done(first) = .true.
            n = 0
            last = 1
            do while (n < last)
               n = n + 1
               edge = queue(n)
               do k = 1, 2
                  node = surface%nodes(k, edge)
                  other = at(1, node)
                  if (other == edge) other = at(2, node)
                  if (other == 0) cycle
                  if (done(other)) cycle
                  if (surface%nodes(k, other) == node) then ! both begin, or both end here
                     surface%nodes(:, other) = surface%nodes([2, 1], other)
                     i = surface%element(other)
                     surface%element(other) = surface%other(other)
                     surface%other(other) = i
                  end if
                  done(other) = .true.
                  last = last + 1
                  queue(last) = other
               end do
            end do
         end do
      end associate
   end subroutine face_one_way


   !> The elements of NODE on the right of surface S: those that hang together with the right side of one of its edges there
   !! without crossing the surface. None where they hang together with the left side too.
   subroutine right_of(model, s, edges, node, right)
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: s
      integer, intent(in)               :: edges(2) !! of the surface at NODE, 0: none
      integer, intent(in)               :: node
      integer, allocatable, intent(out) :: right(:)
      integer, allocatable :: around(:), group(:)
      integer :: beyond(2), i, j, n, pass
      logical :: is_tip

      n = model%first_at(node + 1) - model%first_at(node)
      allocate (around, source=model%elements_at(model%first_at(node):model%first_at(node + 1) - 1))
      allocate (group(n), source=0)
      beyond = 0
      do i = 1, 2
         if (edges(i) == 0) cycle
         beyond(i) = sum(model%surfaces(s)%nodes(:, edges(i))) - node
         where (around == model%surfaces(s)%element(edges(i))) group = 1
         where (around == model%surfaces(s)%other(edges(i))) group = 2
      end do
      do pass = 1, n                         ! spread over common sides that are not of the surface
         do i = 1, n
            if (group(i) /= 0) cycle
            do j = 1, n
               if (group(j) > 0 .and. common_side(model, node, beyond, around(i), around(j))) group(i) = group(j)
            end do
         end do
      end do
      is_tip = .false.
      do i = 1, n
         do j = 1, n
            if (group(i) == 1 .and. group(j) == 2) &
               is_tip = is_tip .or. common_side(model, node, beyond, around(i), around(j))
         end do
      end do
      allocate (right(merge(0, count(group == 2), is_tip)))
      if (.not. is_tip) right(:) = pack(around, group == 2)
   end subroutine right_of


   !> Whether elements A and B share a side at NODE other than those to the nodes BEYOND.
   pure logical function common_side(model, node, beyond, a, b)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, beyond(2), a, b
      integer :: k, other

      common_side = .true.
      do k = 1, size(model%element_nodes, 1)
         other = model%element_nodes(k, a)
         if (other /= node .and. all(beyond /= other) .and. any(model%element_nodes(:, b) == other)) return
      end do
      common_side = .false.
   end function common_side


   !> Append the twins to the nodes of the model.
   subroutine add_twins(model, split)
      type(model_type), intent(inout) :: model
      type(split_type), intent(in)    :: split
      integer, allocatable  :: id(:), twin(:)
      real(wp), allocatable :: x(:, :)
      integer :: k, n, m

      n = model%n_nodes
      m = size(split%node)
      allocate (id(n + m), x(3, n + m), twin(n + m))
      id(:n) = model%node_id
      x(:, :n) = model%x
      twin = 0
      twin(:n) = model%twin
      do k = 1, m
         id(n + k) = model%node_id(n) + k
         x(:, n + k) = model%x(:, split%node(k))
         twin(split%node(k)) = n + k
      end do
      call move_alloc(id, model%node_id)
      call move_alloc(x, model%x)
      call move_alloc(twin, model%twin)
      model%n_nodes = n + m
      call model%node_table%build(model%node_id)
   end subroutine add_twins


   !> Edges of other surfaces follow their elements.
   subroutine move_other_surfaces(model, s)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      integer :: i, k, other, twin

      do other = 1, size(model%surfaces)
         if (other == s) cycle
         associate (surface => model%surfaces(other))
            do i = 1, surface%n
               do k = 1, 2
                  twin = model%twin(surface%nodes(k, i))
                  if (twin == 0) cycle
                  if (any(model%element_nodes(:, surface%element(i)) == twin)) surface%nodes(k, i) = twin
               end do
            end do
         end associate
      end do
   end subroutine move_other_surfaces

end module joint_split
