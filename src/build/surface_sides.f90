!> The sides of a marked surface as neighbours: which stand at a node, turned so that all face the same way, and which body elements
!! lie behind them.
module surface_sides
   use element_kinds, only: element_table
   use id_table, only: distinct, id_table_type
   use model_data, only: model_type, surface_type
   use reverse_lists, only: list_owners
   implicit none
   private

   public :: nodes_of, list_sides, turn_side, face_one_way, elements_behind

   !> The sides of a surface at every node of it: side(first(k):first(k + 1) - 1) at node(k).
   type, public :: side_list
      integer :: n = 0                             !! nodes
      integer, allocatable :: node(:)              !! (n) positions in the model, ascending
      integer, allocatable :: first(:)             !! (n + 1)
      integer, allocatable :: side(:)
      type(id_table_type), private :: place        ! of a node in NODE
   end type side_list

contains

   !> The nodes of SURFACE, each once, in ascending order.
   pure function nodes_of(surface) result(nodes)
      type(surface_type), intent(in) :: surface
      integer, allocatable :: nodes(:)

      call distinct(pack(surface%nodes(:, :surface%n), surface%nodes(:, :surface%n) > 0), nodes)
   end function nodes_of

   !> The sides of SURFACE at every node.
   pure subroutine list_sides(surface, at)
      type(surface_type), intent(in) :: surface
      type(side_list), intent(out)   :: at
      integer, allocatable :: places(:, :)
      integer :: i, k

      at%node = nodes_of(surface)
      at%n = size(at%node)
      call at%place%build(at%node)
      allocate (places(size(surface%nodes, 1), surface%n), source=0)
      do i = 1, surface%n
         do k = 1, surface%n_nodes(i)
            places(k, i) = at%place%find(surface%nodes(k, i))
         end do
      end do
      call list_owners(at%n, places, at%first, at%side)
   end subroutine list_sides

   !> Turn SIDE of SURFACE round: it is then a side of the element that was behind it.
   pure subroutine turn_side(surface, side)
      type(surface_type), intent(inout) :: surface
      integer, intent(in)               :: side
      integer :: element, m

      m = surface%corners(side)
      associate (nodes => surface%nodes(:, side))
         nodes(:m) = nodes(m:1:-1)
         if (surface%n_nodes(side) == 2*m) nodes(m + 1:2*m - 1) = nodes(2*m - 1:m + 1:-1) ! the last lies between the last and the first
      end associate
      element = surface%element(side)
      surface%element(side) = surface%other(side)
      surface%other(side) = element
   end subroutine turn_side

   !> Turn sides of SURFACE round so that neighbours go on where the others end: the same body side on the left of all edges,
   !! inside all faces.
   pure subroutine face_one_way(surface, at)
      type(surface_type), intent(inout) :: surface
      type(side_list), intent(in)       :: at !! of SURFACE
      integer, allocatable :: queue(:)
      logical, allocatable :: done(:)
      integer :: side, first, i, k, n, last, other, place

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
               place = at%place%find(surface%nodes(k, side))
               do i = at%first(place), at%first(place + 1) - 1
                  other = at%side(i)
                  if (done(other)) cycle
                  select case (common_sense(surface, side, k, other))
                  case (0)
                     cycle
                  case (1)
                     call turn_side(surface, other)
                  end select
                  done(other) = .true.
                  last = last + 1
                  queue(last) = other
               end do
            end do
         end do
      end do
   end subroutine face_one_way

   !> How side OTHER shares what begins at corner K of SIDE (in the plane this node, of a face the rim to the next corner): 0 not
   !! at all, 1 in the same sense, which is wrong for neighbours, -1 in the opposite one.
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

   !> The elements BEHIND surface S at node K of it: those that hang together with the back of one of its sides there without
   !! crossing the surface. None where they hang together with the front too.
   pure subroutine elements_behind(model, s, at, k, behind)
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: s
      type(side_list), intent(in)       :: at        !! its sides at its nodes
      integer, intent(in)               :: k
      integer, allocatable, intent(out) :: behind(:)
      integer, allocatable :: around(:), group(:)
      logical, allocatable :: touch(:, :)
      integer :: i, j, n, node
      logical :: is_tip, more

      node = at%node(k)
      n = model%first_at(node + 1) - model%first_at(node)
      allocate (around, source=model%elements_at(model%first_at(node):model%first_at(node + 1) - 1))
      allocate (group(n), source=0)
      do i = at%first(k), at%first(k + 1) - 1
         where (around == model%surfaces(s)%element(at%side(i))) group = 1
         where (around == model%surfaces(s)%other(at%side(i))) group = 2
      end do
      allocate (touch(n, n), source=.false.)
      do i = 1, n
         do j = 1, i - 1
            touch(i, j) = common_side(model, s, at, k, around(i), around(j))
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
      allocate (behind(merge(0, count(group == 2), is_tip)))
      if (.not. is_tip) behind(:) = pack(around, group == 2)
   end subroutine elements_behind

   !> Whether elements A and B share a side at node PLACE of surface S that is not of it.
   pure logical function common_side(model, s, at, place, a, b)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: s, place, a, b
      type(side_list), intent(in)  :: at
      integer :: common(size(model%element_nodes, 1)), i, k, n

      n = 0
      do k = 1, element_table(model%element_kind(a))%n_corners ! elements at an edge alone share its mid-side node too
         if (all(model%element_nodes(:, b) /= model%element_nodes(k, a))) cycle
         n = n + 1
         common(n) = model%element_nodes(k, a)
      end do
      common_side = n >= model%dimension
      do i = at%first(place), at%first(place + 1) - 1
         if (.not. common_side) return
         associate (side => model%surfaces(s)%nodes(:model%surfaces(s)%corners(at%side(i)), at%side(i)))
            common_side = any([(all(side /= common(k)), k = 1, n)])
         end associate
      end do
   end function common_side

end module surface_sides
