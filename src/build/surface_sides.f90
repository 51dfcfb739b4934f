!> The sides of a marked surface as neighbours: which stand at a node, and turned so that all face the same way.
module surface_sides
   use id_table, only: distinct, id_table_type
   use model_data, only: surface_type
   use reverse_lists, only: list_owners
   implicit none
   private

   public :: list_sides, face_one_way

   !> The sides of a surface at every node of it: side(first(k):first(k + 1) - 1) at node(k).
   type, public :: side_list
      integer :: n = 0                             !! nodes
      integer, allocatable :: node(:)              !! (n) positions in the model, ascending
      integer, allocatable :: first(:)             !! (n + 1)
      integer, allocatable :: side(:)
      type(id_table_type), private :: place        ! of a node in NODE
   end type side_list

contains

   !> The sides of SURFACE at every node.
   pure subroutine list_sides(surface, at)
      type(surface_type), intent(in) :: surface
      type(side_list), intent(out)   :: at
      integer, allocatable :: places(:, :)
      integer :: i, k

      associate (nodes => surface%nodes(:, :surface%n))
         call distinct(pack(nodes, nodes > 0), at%node)
      end associate
      at%n = size(at%node)
      call at%place%build(at%node)
      allocate (places(size(surface%nodes, 1), surface%n), source=0)
      do i = 1, surface%n
         do k = 1, surface%corners(i)
            places(k, i) = at%place%find(surface%nodes(k, i))
         end do
      end do
      call list_owners(at%n, places, at%first, at%side)
   end subroutine list_sides


   !> Turn sides of SURFACE round so that neighbours go on where the others end: the same body side on the left of all edges,
   !! inside all faces.
   pure subroutine face_one_way(surface, at)
      type(surface_type), intent(inout) :: surface
      type(side_list), intent(in)       :: at !! of SURFACE
      integer, allocatable :: queue(:)
      logical, allocatable :: done(:)
      integer :: side, first, i, j, k, n, last, other, place

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

end module surface_sides
