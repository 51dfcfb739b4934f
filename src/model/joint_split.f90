!> A joint on one shared surface: where bodies lie on both sides of a marked surface and share its nodes, the nodes are
!! doubled, so that interface elements can stand between them.
module joint_split
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use mesh_build, only: list_elements_of_nodes
   use model_data, only: model_type, surface_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: split_shared_surfaces, list_sides_of_nodes, right_of

   !> The nodes of a surface that was split, and the new node on the other side of each.
   type :: split_type
      integer, allocatable :: node(:), twin(:)
   end type split_type

   !> side(first(i):first(i+1)-1) are the sides of a surface at node i.
   type, public :: side_list
      integer, allocatable :: first(:), side(:)
   end type side_list

contains

   !> Split the shared surfaces that JOINT cards name as SIDE1 without a SIDE2. The elements on the left of the
   !! surface's edges, or inside its faces, keep the nodes; those behind get the twins, numbered from the highest node number on.
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
            call add_field_error(deck%text, deck%bulk%joint(j)%line, 3, 'SIDE1', 'bodies lie on both sides of some '// &
                                 merge('edges', 'faces', model%dimension == 2)//' of '// &
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
         do k = 1, model%surfaces(s)%corners(i)
            node = model%surfaces(s)%nodes(k, i)
            meets(node) = model%twin(node) > 0 .or. is_twin(node)
         end do
      end do
   end function meets_a_split


   subroutine split_surface(model, s)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      type(split_type)     :: split
      type(side_list)      :: at
      integer, allocatable :: right(:)
      integer :: n, node

      call list_sides_of_nodes(model, s, at)
      call face_one_way(model, s, at)
      allocate (split%node(model%n_nodes), split%twin(model%n_nodes), source=0)
      n = 0
      do node = 1, model%n_nodes
         if (at%first(node) == at%first(node + 1)) cycle
         call right_of(model, s, at, node, right)
         if (size(right) == 0) cycle          ! the surface ends inside a body here: the tip stays whole
         n = n + 1
         split%node(n) = node
         split%twin(n) = model%n_nodes + n
      end do
      split%node = split%node(:n)
      split%twin = split%twin(:n)
      call give_twins(model, s, at, split)
      call add_twins(model, split)
      call move_other_surfaces(model, s)
      model%surfaces(s)%other = 0
      model%surfaces(s)%was_split = .true.
   end subroutine split_surface


   !> The sides of surface S at every node.
   subroutine list_sides_of_nodes(model, s, at)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: s
      type(side_list), intent(out) :: at
      integer, allocatable :: filled(:)
      integer :: i, k, node

      allocate (at%first(model%n_nodes + 1), source=0)
      associate (surface => model%surfaces(s))
         do i = 1, surface%n
            do k = 1, surface%corners(i)
               node = surface%nodes(k, i)
               at%first(node + 1) = at%first(node + 1) + 1
            end do
         end do
         at%first(1) = 1
         do node = 1, model%n_nodes
            at%first(node + 1) = at%first(node) + at%first(node + 1)
         end do
         allocate (at%side(at%first(model%n_nodes + 1) - 1))
         allocate (filled, source=at%first)
         do i = 1, surface%n
            do k = 1, surface%corners(i)
               node = surface%nodes(k, i)
               at%side(filled(node)) = i
               filled(node) = filled(node) + 1
            end do
         end do
      end associate
   end subroutine list_sides_of_nodes


   !> Turn sides of surface S round so that neighbours go on where the others end: the same body side on the left of all edges,
   !! inside all faces.
   subroutine face_one_way(model, s, at)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      type(side_list), intent(in)     :: at
      integer, allocatable :: queue(:)
      logical, allocatable :: done(:)
      integer :: side, first, i, j, k, n, last, other

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
               side = queue(n)
               do k = 1, surface%corners(side)
                  do i = at%first(surface%nodes(k, side)), at%first(surface%nodes(k, side) + 1) - 1
                     other = at%side(i)
                     if (done(other)) cycle
                     select case (common_sense(surface, side, k, other))
                     case (0)
                        cycle
                     case (1)
                        surface%nodes(:surface%corners(other), other) = surface%nodes(surface%corners(other):1:-1, other)
                        j = surface%element(other)
                        surface%element(other) = surface%other(other)
                        surface%other(other) = j
                     end select
                     done(other) = .true.
                     last = last + 1
                     queue(last) = other
                  end do
               end do
            end do
         end do
      end associate
   end subroutine face_one_way


   !> How side OTHER shares what begins at corner K of SIDE (in the plane this node, of a face the rim to the next corner): 0 not at
   !! all, 1 in the same sense, which is wrong for neighbours, -1 in the opposite one.
   pure integer function common_sense(surface, side, k, other) result(sense)
      type(surface_type), intent(in) :: surface
      integer, intent(in)            :: side, k, other
      integer :: at, n, next

      n = surface%corners(other)
      at = findloc(surface%nodes(:n, other), surface%nodes(k, side), dim=1)
      sense = 0
      if (n == 2) then
         sense = merge(1, -1, at == k) ! both begin, or both end here
      else
         next = surface%nodes(modulo(k, surface%corners(side)) + 1, side)
         if (surface%nodes(modulo(at, n) + 1, other) == next) sense = 1
         if (surface%nodes(modulo(at - 2, n) + 1, other) == next) sense = -1
      end if
   end function common_sense


   !> The elements of NODE behind surface S: those that hang together with the back of one of its sides there without crossing
   !! the surface. None where they hang together with the front too.
   subroutine right_of(model, s, at, node, right)
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: s
      type(side_list), intent(in)       :: at
      integer, intent(in)               :: node
      integer, allocatable, intent(out) :: right(:)
      integer, allocatable :: around(:), group(:)
      logical, allocatable :: touch(:, :)
      integer :: i, j, n
      logical :: is_tip, more

      n = model%first_at(node + 1) - model%first_at(node)
      allocate (around, source=model%elements_at(model%first_at(node):model%first_at(node + 1) - 1))
      allocate (group(n), source=0)
      do i = at%first(node), at%first(node + 1) - 1
         where (around == model%surfaces(s)%element(at%side(i))) group = 1
         where (around == model%surfaces(s)%other(at%side(i))) group = 2
      end do
      allocate (touch(n, n), source=.false.)
      do i = 1, n
         do j = 1, i - 1
            touch(i, j) = common_side(model, s, at, node, around(i), around(j))
            touch(j, i) = touch(i, j)
         end do
      end do
      more = .true.
      do while (more)                        ! spread over common sides that are not of the surface
         more = .false.
         do i = 1, n
            if (group(i) /= 0) cycle
            do j = 1, n
               if (group(j) == 0 .or. .not. touch(i, j)) cycle
               group(i) = group(j)
               more = .true.
               exit
            end do
         end do
      end do
      is_tip = .false.
      do i = 1, n
         if (group(i) == 1) is_tip = is_tip .or. any(touch(:, i) .and. group == 2)
      end do
      allocate (right(merge(0, count(group == 2), is_tip)))
      if (.not. is_tip) right(:) = pack(around, group == 2)
   end subroutine right_of


   !> Whether elements A and B share a side at NODE that is not of surface S.
   pure logical function common_side(model, s, at, node, a, b)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: s, node, a, b
      type(side_list), intent(in)  :: at
      integer :: common(size(model%element_nodes, 1)), i, k, n

      n = 0
      do k = 1, size(model%element_nodes, 1)
         if (model%element_nodes(k, a) == 0) exit
         if (all(model%element_nodes(:, b) /= model%element_nodes(k, a))) cycle
         n = n + 1
         common(n) = model%element_nodes(k, a)
      end do
      common_side = n >= model%dimension
      do i = at%first(node), at%first(node + 1) - 1
         if (.not. common_side) return
         associate (side => model%surfaces(s)%nodes(:model%surfaces(s)%corners(at%side(i)), at%side(i)))
            common_side = any([(all(side /= common(k)), k = 1, n)])
         end associate
      end do
   end function common_side


   !> The elements behind surface S get the twins of its nodes.
   subroutine give_twins(model, s, at, split)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      type(side_list), intent(in)     :: at
      type(split_type), intent(in)    :: split
      integer, allocatable :: nodes(:, :), right(:)
      integer :: i, k

      allocate (nodes, source=model%element_nodes) ! the whole nodes are needed until all twins are given
      do k = 1, size(split%node)
         call right_of(model, s, at, split%node(k), right)
         do i = 1, size(right)
            associate (corners => nodes(:, right(i)))
               corners = merge(split%twin(k), corners, corners == split%node(k))
            end associate
         end do
      end do
      call move_alloc(nodes, model%element_nodes)
   end subroutine give_twins


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


   !> Sides of other surfaces follow their elements.
   subroutine move_other_surfaces(model, s)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s
      integer :: i, k, other, twin

      do other = 1, size(model%surfaces)
         if (other == s) cycle
         associate (surface => model%surfaces(other))
            do i = 1, surface%n
               do k = 1, surface%corners(i)
                  twin = model%twin(surface%nodes(k, i))
                  if (twin == 0) cycle
                  if (any(model%element_nodes(:, surface%element(i)) == twin)) surface%nodes(k, i) = twin
               end do
            end do
         end associate
      end do
   end subroutine move_other_surfaces

end module joint_split
