!> Which body elements at a node lie behind a surface through it.
module behind_surface
   use model_data, only: model_type
   use surface_sides, only: side_list
   implicit none
   private

   public :: elements_behind

contains

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
      do k = 1, size(model%element_nodes, 1)
         if (model%element_nodes(k, a) == 0) exit
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

end module behind_surface
