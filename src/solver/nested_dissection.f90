!> The elimination order by nested dissection of the node graph. METIS dissects. Large graphs of plane meshes are coarsened
!! first, four nodes to one: the thinned separators of the coarse graph are as good as those of the fine one, and the time is
!! halved. For solid meshes the separators of the coarse graph cost a tenth more operations, and ordering is a small part of the
!! total: their graphs are not coarsened.
!!
!! Separators cut a graph in two, then the halves, and so on. The result is a binary tree, numbered as a heap: the children of
!! place h are 2h and 2h + 1. Inner places hold the separators, the leaves the remaining nodes. Of the places of two neighbours,
!! one is an ancestor of the other.
!! Source of the coarse graph: heavy-edge matching, Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392, section 3.1.
module nested_dissection
   use kinds, only: wp
   use lists, only: list_owners
   use metis, only: has_room, order_by_metis, restore_abort, separate_by_metis
   use node_graph, only: node_graph_type, part_of_graph
   use task_record, only: is_recorded, key, record_phase, record_task, start_record, task_begins
   implicit none
   private

   public :: separate, dissect, dissect_coarsely, weigh_links, coarsen, thin_separators

   integer, parameter :: many = 2000         ! nodes from which on a part is a task
   integer, parameter :: large = 20000      ! nodes from which on a graph is coarsened
   integer, parameter :: flat = 10          ! average number of neighbours up to which a mesh is taken as plane
   integer, parameter :: part_nodes = 700   ! largest part that is not coarsened
   integer, parameter :: solid_nodes = 1500 ! largest part of a graph that is cut without
   integer, parameter :: smallest = 20      ! nodes that are worth a separator

contains

   !> Cut GRAPH by separators into N_PARTS, a power of 2: PLACE of every node in the tree of separators. The halves are tasks. OK is
   !! false where memory is missing: METIS would end the program.
   subroutine separate(graph, n_parts, place, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_parts
      integer, allocatable, intent(out) :: place(:) !! (graph%n)
      logical, intent(out)              :: ok
      integer, allocatable :: number(:)
      integer :: i

      ok = has_room(graph)
      if (.not. ok) return
      allocate (place(graph%n), number(graph%n), source=0)
      call record_phase('order')
      !$omp parallel default(shared) if(graph%n >= many)
      !$omp single
      call cut([(i, i = 1, graph%n)], 1)
      !$omp end single
      !$omp end parallel

   contains

      !> Cut NODES, which have no neighbours but in separators, for the subtree of place TOP.
      recursive subroutine cut(nodes, top)
         integer, intent(in)   :: nodes(:), top
         type(node_graph_type) :: part
         integer, allocatable  :: side(:)
         logical  :: done
         real(wp) :: began

         if (top >= n_parts .or. size(nodes) < smallest) then
            place(nodes) = max(top, shiftl(top, leadz(top) - leadz(n_parts))) ! few nodes: all in the first part
            return
         end if
         began = task_begins()
         call part_of_graph(graph, nodes, number, part)
         call separate_by_metis(part, side, done)
         if (.not. done) then
            !$omp atomic write
            ok = .false.
         end if
         place(pack(nodes, side == 2)) = top
         if (is_recorded) call record_task(began, 'separate', key('<', top/2)//key('+', top))
         !$omp task default(shared) if(part%n >= many)
         call cut(pack(nodes, side == 0), 2*top)
         !$omp end task
         call cut(pack(nodes, side == 1), 2*top + 1)
         !$omp taskwait
      end subroutine cut

   end subroutine separate

   !> ORDER(k) is the k-th node to be eliminated, of the nodes with TAKEN(node). The graph leaves the others out. OK is false
   !! where METIS lacks memory.
   subroutine dissect(graph, taken, order, ok)
      type(node_graph_type), intent(in)  :: graph
      logical, intent(in)                :: taken(:)
      integer, allocatable, intent(out)  :: order(:)
      logical, intent(out)               :: ok
      type(node_graph_type) :: part
      integer, allocatable  :: nodes(:), number(:), place(:)
      integer :: i

      nodes = pack([(i, i = 1, graph%n)], taken)
      allocate (number(graph%n), source=0)
      call part_of_graph(graph, nodes, number, part)
      call start_record()
      if (part%n < large) then
         call order_by_metis(part, order, ok)
      else if (size(part%neighbours) <= flat*part%n) then
         call dissect_coarsely(part, part_nodes, order, ok)
      else
         call separate(part, parts_of(part%n, solid_nodes), place, ok)
         if (ok) call order_parts(part, parts_of(part%n, solid_nodes), place, order, ok)
      end if
      if (ok) order = nodes(order)
   end subroutine dissect

   !> The least power of 2 that divides N nodes into parts of MOST_NODES on average at most.
   pure integer function parts_of(n, most_nodes)
      integer, intent(in) :: n, most_nodes

      parts_of = 1
      do while (parts_of*most_nodes < n)
         parts_of = 2*parts_of
      end do
   end function parts_of

   !> ORDER as above. A coarse graph is cut into parts of MOST_NODES of GRAPH on average at most.
   subroutine dissect_coarsely(graph, most_nodes, order, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: most_nodes
      integer, allocatable, intent(out) :: order(:)
      logical, intent(out)              :: ok
      type(node_graph_type) :: pairs, fours
      integer, allocatable  :: weight(:), pair_weight(:), four_weight(:), pair(:), four(:), place(:)
      integer :: n_parts

      n_parts = parts_of(graph%n, most_nodes)
      call weigh_links(graph, weight)
      call coarsen(graph, weight, pairs, pair_weight, pair)
      call coarsen(pairs, pair_weight, fours, four_weight, four)
      call separate(fours, n_parts, place, ok)
      if (.not. ok) return
      place = place(four(pair))
      call thin_separators(graph, n_parts, place)
      call order_parts(graph, n_parts, place, order, ok)
   end subroutine dissect_coarsely

   !> ORDER as above. METIS orders the parts of PLACE one by one, in parallel. The separators follow their parts.
   subroutine order_parts(graph, n_parts, place, order, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_parts
      integer, intent(in)               :: place(:)
      integer, allocatable, intent(out) :: order(:)
      logical, intent(out)              :: ok
      type(node_graph_type) :: part
      integer, allocatable  :: first(:), nodes(:), number(:), sequence(:)
      integer :: begin(2*n_parts - 1) ! nodes before those of a place
      integer :: n, top
      logical :: done
      real(wp) :: began

      call list_owners(2*n_parts - 1, reshape(place, [1, graph%n]), first, nodes)
      n = 0
      call hand_out(1)
      allocate (order(graph%n), number(graph%n), source=0)
      ok = .true.
      call record_phase('order')
      !$omp parallel do schedule(dynamic, 1) default(shared) private(began, done, part, sequence) if(graph%n >= many)
      do top = 1, 2*n_parts - 1
         began = task_begins()
         associate (here => nodes(first(top):first(top + 1) - 1))
            if (top < n_parts) then
               order(begin(top) + 1:begin(top) + size(here)) = here
            else
               call part_of_graph(graph, here, number, part)
               call order_by_metis(part, sequence, done)
               if (done) order(begin(top) + 1:begin(top) + size(here)) = here(sequence)
               if (.not. done) then
                  !$omp atomic write
                  ok = .false.
               end if
            end if
         end associate
         if (is_recorded) call record_task(began, 'part', '')
      end do
      !$omp end parallel do
      if (graph%n >= many) call restore_abort()

   contains

      !> The places of the subtree of place TOP, in the sequence of elimination.
      recursive subroutine hand_out(top)
         integer, intent(in) :: top

         if (top < n_parts) then
            call hand_out(2*top)
            call hand_out(2*top + 1)
         end if
         begin(top) = n
         n = n + first(top + 1) - first(top)
      end subroutine hand_out

   end subroutine order_parts

   !> WEIGHT of every link: 1 plus the number of common neighbours of its ends.
   subroutine weigh_links(graph, weight)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable, intent(out) :: weight(:) !! as graph%neighbours
      integer, allocatable :: mark(:)
      integer :: i, j, k, l

      allocate (weight(size(graph%neighbours)), source=1)
      !$omp parallel default(shared) private(mark, j, k, l) if(graph%n >= large)
      allocate (mark(graph%n), source=0)
      !$omp do schedule(static)
      do i = 1, graph%n
         mark(graph%neighbours(graph%first(i):graph%first(i + 1) - 1)) = i
         do k = graph%first(i), graph%first(i + 1) - 1
            j = graph%neighbours(k)
            do l = graph%first(j), graph%first(j + 1) - 1
               if (mark(graph%neighbours(l)) == i) weight(k) = weight(k) + 1
            end do
         end do
      end do
      !$omp end do
      !$omp end parallel
   end subroutine weigh_links

   !> Halve a graph by heavy-edge matching: each node is paired with the unmatched neighbour of the heaviest link. The links of
   !! the COARSE graph carry the sums of weights.
   pure subroutine coarsen(graph, weight, coarse, coarse_weight, of_node)
      type(node_graph_type), intent(in)  :: graph
      integer, intent(in)                :: weight(:)        !! as graph%neighbours
      type(node_graph_type), intent(out) :: coarse
      integer, allocatable, intent(out)  :: coarse_weight(:) !! as coarse%neighbours
      integer, allocatable, intent(out)  :: of_node(:)       !! (graph%n) node of COARSE
      integer, allocatable :: members(:, :), at(:)
      integer :: best, c, i, j, k, m, most, n

      allocate (of_node(graph%n), source=0)
      allocate (members(2, graph%n), source=0)
      coarse%n = 0
      do i = 1, graph%n
         if (of_node(i) > 0) cycle
         best = 0
         most = 0
         do k = graph%first(i), graph%first(i + 1) - 1
            if (of_node(graph%neighbours(k)) > 0 .or. weight(k) <= most) cycle
            best = graph%neighbours(k)
            most = weight(k)
         end do
         coarse%n = coarse%n + 1
         members(:, coarse%n) = [i, best]
         of_node(i) = coarse%n
         if (best > 0) of_node(best) = coarse%n
      end do

      allocate (coarse%first(coarse%n + 1), coarse%neighbours(size(graph%neighbours)))
      allocate (coarse_weight(size(graph%neighbours)), source=0)
      allocate (at(coarse%n), source=0)               ! position of a neighbour in the list
      n = 0
      do c = 1, coarse%n
         coarse%first(c) = n + 1
         do m = 1, 2
            i = members(m, c)
            if (i == 0) cycle
            do k = graph%first(i), graph%first(i + 1) - 1
               j = of_node(graph%neighbours(k))
               if (j == c) cycle
               if (at(j) < coarse%first(c)) then
                  n = n + 1
                  at(j) = n
                  coarse%neighbours(n) = j
               end if
               coarse_weight(at(j)) = coarse_weight(at(j)) + weight(k)
            end do
         end do
      end do
      coarse%first(coarse%n + 1) = n + 1
      coarse%neighbours = coarse%neighbours(:n)
      coarse_weight = coarse_weight(:n)
   end subroutine coarsen

   !> Thin the separators of a coarse graph, which are thick in the fine one: PLACE(node). A node without neighbours on both
   !! sides of its separator moves down to the side with neighbours, until it separates or is in a leaf.
   pure subroutine thin_separators(graph, n_leaves, place)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_leaves  !! a power of 2; they are places n_leaves to 2 n_leaves - 1
      integer, intent(inout)            :: place(:)  !! (graph%n)
      logical :: on_one_side, on_the_other
      integer :: i

      do i = 1, graph%n
         do while (place(i) < n_leaves)
            on_one_side = is_below(2*place(i))
            on_the_other = is_below(2*place(i) + 1)
            if (on_one_side .eqv. on_the_other) exit
            place(i) = 2*place(i) + merge(0, 1, on_one_side)
         end do
      end do

   contains

      !> Whether a neighbour of node I stands in the subtree of place TOP.
      pure logical function is_below(top)
         integer, intent(in) :: top
         integer :: k, shift

         is_below = .false.
         do k = graph%first(i), graph%first(i + 1) - 1
            shift = leadz(top) - leadz(place(graph%neighbours(k)))
            if (shift < 0) cycle
            is_below = shiftr(place(graph%neighbours(k)), shift) == top
            if (is_below) return
         end do
      end function is_below

   end subroutine thin_separators

end module nested_dissection
