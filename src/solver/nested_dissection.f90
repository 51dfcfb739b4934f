!> The elimination order by nested dissection of the node graph. METIS dissects. Large graphs of plane meshes are coarsened
!! first, four nodes to one: the thinned separators of the coarse graph are as good as those of the fine one, and the time is
!! halved. For solid meshes the separators of the coarse graph cost a tenth more operations, and ordering is a small part of the
!! total: their graphs are not coarsened.
!!
!! Separators cut a graph in two, then the halves, and so on. The result is a binary tree, numbered as a heap: the children of
!! place h are 2h and 2h + 1. Inner places hold the separators, the leaves the remaining nodes. Of the places of two neighbours,
!! one is an ancestor of the other.
!! Source of the coarse graph: heavy-edge matching, Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392, section 3.1.
!! METIS 5.1: Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392.
module nested_dissection
   use, intrinsic :: iso_c_binding, only: c_funptr, c_int, c_int32_t, c_null_funptr, c_null_ptr, c_ptr
   use lists, only: list_owners
   use node_graph, only: node_graph_type, part_of_graph
   implicit none
   private

   public :: order_by_metis, separate_by_metis, part_by_metis, dissect, dissect_coarsely, weigh_links, coarsen, thin_separators

   integer, parameter :: n_options = 40         ! METIS_NOPTIONS
   integer, parameter :: compress = 13          ! METIS_OPTION_COMPRESS, from 1 on
   integer, parameter :: metis_ok = 1           ! METIS_OK
   integer, parameter :: words = 8              ! words of memory per node or link for METIS

   interface
      integer(c_int32_t) function metis_set_default_options(options) bind(c, name='METIS_SetDefaultOptions')
         import :: c_int32_t
         integer(c_int32_t), intent(out) :: options(*)
      end function metis_set_default_options

      integer(c_int32_t) function metis_node_nd(n, first, neighbours, weights, options, old_of_new, new_of_old) &
         bind(c, name='METIS_NodeND')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in)    :: n, first(*), neighbours(*)  !! from 0 on
         type(c_ptr), value                :: weights, options            !! null: defaults of METIS
         integer(c_int32_t), intent(out)   :: old_of_new(*), new_of_old(*)
      end function metis_node_nd

      integer(c_int32_t) function metis_node_ndp(n, first, neighbours, weights, parts, options, old_of_new, new_of_old, sizes) &
         bind(c, name='METIS_NodeNDP')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), value         :: n, parts
         integer(c_int32_t), intent(in)    :: first(*), neighbours(*), options(*)
         type(c_ptr), value                :: weights
         integer(c_int32_t), intent(out)   :: old_of_new(*), new_of_old(*)
         integer(c_int32_t), intent(inout) :: sizes(*)   !! (2 parts - 1) of leaves and separators, the root last
      end function metis_node_ndp

      integer(c_int32_t) function metis_part_kway(n, constraints, first, neighbours, weights, sizes, link_weights, parts, shares, &
                                                  imbalance, options, cut, part) bind(c, name='METIS_PartGraphKway')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in)  :: n, constraints, first(*), neighbours(*), parts
         type(c_ptr), value              :: weights, sizes, link_weights, shares, imbalance, options
         integer(c_int32_t), intent(out) :: cut, part(*)
      end function metis_part_kway

      !> The action at SIGNAL from now on, until it comes once; gives the previous action. A name of glibc.
      type(c_funptr) function c_sysv_signal(signal, handler) bind(c, name='sysv_signal')
         import :: c_funptr, c_int
         integer(c_int), value :: signal
         type(c_funptr), value :: handler
      end function c_sysv_signal
   end interface

   integer(c_int), parameter :: sigterm = 15 ! of Linux

   integer, parameter :: large = 20000      ! nodes from which on a graph is coarsened
   integer, parameter :: flat = 10          ! average number of neighbours up to which a mesh is taken as plane
   integer, parameter :: part_nodes = 700   ! largest part that is not coarsened

contains

   !> ORDER(k) is the k-th node of GRAPH to be eliminated, by nested dissection. OK is false where METIS lacks memory.
   subroutine order_by_metis(graph, order, ok)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable, intent(out) :: order(:)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: old_of_new(graph%n), new_of_old(graph%n)

      ok = .true.
      old_of_new = 0
      if (graph%n > 1) ok = metis_node_nd(graph%n, graph%first - 1, graph%neighbours - 1, c_null_ptr, c_null_ptr, old_of_new, &
                                          new_of_old) == metis_ok
      if (ok) order = old_of_new + 1
   end subroutine order_by_metis

   !> Whether METIS has the memory for GRAPH.
   logical function has_room(graph)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable :: room(:, :)
      integer :: status

      allocate (room(words, graph%n + size(graph%neighbours)), stat=status)
      has_room = status == 0
   end function has_room

   !> Cut GRAPH by separators into N_PARTS, a power of 2: PLACE of every node in the tree of separators; 1 for all where METIS
   !! returns no separators. OK is false where memory is missing: METIS would end the program.
   subroutine separate_by_metis(graph, n_parts, place, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_parts
      integer, allocatable, intent(out) :: place(:) !! (graph%n)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: old_of_new(graph%n), new_of_old(graph%n), sizes(2*n_parts - 1), options(n_options)
      integer :: n, status

      ok = has_room(graph)
      if (.not. ok) return
      status = metis_set_default_options(options)
      options(compress) = 0   ! with compression the sizes would count compressed nodes
      sizes = 0
      ok = metis_node_ndp(graph%n, graph%first - 1, graph%neighbours - 1, c_null_ptr, n_parts, options, old_of_new, new_of_old, &
                          sizes) == metis_ok
      if (.not. ok) return
      allocate (place(graph%n), source=1)
      if (sum(sizes) /= graph%n) return
      n = 0
      call hand_out(1)

   contains

      !> Assign the nodes of the subtree of place TOP: METIS orders its second half first, the separator last.
      recursive subroutine hand_out(top)
         integer, intent(in) :: top

         if (top < n_parts) then
            call hand_out(2*top + 1)
            call hand_out(2*top)
         end if
         associate (m => sizes(2*n_parts - top))
            place(old_of_new(n + 1:n + m) + 1) = top
            n = n + m
         end associate
      end subroutine hand_out

   end subroutine separate_by_metis

   !> PART, 0 to N_PARTS - 1, of every node of GRAPH: parts of similar size with few links between them. OK as above.
   subroutine part_by_metis(graph, n_parts, part, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_parts
      integer, allocatable, intent(out) :: part(:) !! (graph%n)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: cut

      allocate (part(graph%n), source=0)
      ok = .true.
      if (n_parts == 1 .or. graph%n < n_parts) return
      ok = has_room(graph)
      if (.not. ok) return
      ok = metis_part_kway(graph%n, 1, graph%first - 1, graph%neighbours - 1, c_null_ptr, c_null_ptr, c_null_ptr, n_parts, &
                           c_null_ptr, c_null_ptr, c_null_ptr, cut, part) == metis_ok
   end subroutine part_by_metis

   !> ORDER(k) is the k-th node to be eliminated, of the nodes with TAKEN(node). The graph leaves the others out. OK is false
   !! where METIS lacks memory.
   subroutine dissect(graph, taken, order, ok)
      type(node_graph_type), intent(in)  :: graph
      logical, intent(in)                :: taken(:)
      integer, allocatable, intent(out)  :: order(:)
      logical, intent(out)               :: ok
      type(node_graph_type) :: part
      integer, allocatable  :: nodes(:), number(:)
      integer :: i

      nodes = pack([(i, i = 1, graph%n)], taken)
      allocate (number(graph%n), source=0)
      call part_of_graph(graph, nodes, number, part)
      if (part%n >= large .and. size(part%neighbours) <= flat*part%n) then
         call dissect_coarsely(part, part_nodes, order, ok)
      else
         call order_by_metis(part, order, ok)
      end if
      if (ok) order = nodes(order)
   end subroutine dissect

   !> ORDER as above. A coarse graph is cut into parts of MOST_NODES of GRAPH on average at most. METIS orders them one by one.
   !! The separators follow their parts.
   subroutine dissect_coarsely(graph, most_nodes, order, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: most_nodes
      integer, allocatable, intent(out) :: order(:)
      logical, intent(out)              :: ok
      type(node_graph_type) :: pairs, fours
      integer, allocatable  :: weight(:), pair_weight(:), four_weight(:), pair(:), four(:), place(:), first(:), nodes(:), number(:)
      integer :: n, n_parts

      n_parts = 1
      do while (n_parts*most_nodes < graph%n)
         n_parts = 2*n_parts
      end do
      call weigh_links(graph, weight)
      call coarsen(graph, weight, pairs, pair_weight, pair)
      call coarsen(pairs, pair_weight, fours, four_weight, four)
      call separate_by_metis(fours, n_parts, place, ok)
      if (.not. ok) return
      if (maxval(place) == 1) n_parts = 1   ! nothing was separated
      place = place(four(pair))
      call thin_separators(graph, n_parts, place)
      call list_owners(2*n_parts - 1, reshape(place, [1, graph%n]), first, nodes)
      allocate (order(graph%n), number(graph%n))
      number = 0
      n = 0
      call order_subtree(1)

   contains

      !> Order the nodes of the subtree of place TOP.
      recursive subroutine order_subtree(top)
         integer, intent(in)   :: top
         type(node_graph_type) :: part
         integer, allocatable  :: sequence(:)

         if (top < n_parts) then
            call order_subtree(2*top)
            call order_subtree(2*top + 1)
         end if
         associate (here => nodes(first(top):first(top + 1) - 1))
            if (top < n_parts) then
               order(n + 1:n + size(here)) = here
            else if (ok) then
               call part_of_graph(graph, here, number, part)
               call order_by_metis(part, sequence, ok)
               if (ok) order(n + 1:n + size(here)) = here(sequence)
            end if
            n = n + size(here)
         end associate
      end subroutine order_subtree

   end subroutine dissect_coarsely

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

   !> Called by METIS in place of the routine of the C library. METIS sets handlers of its own for its errors while it works: at SIGTERM
   !! it would give up the order, and the program would go on. The handler of the program stays for SIGTERM.
   type(c_funptr) function metis_signal(signal, handler) bind(c, name='__sysv_signal') result(before)
      integer(c_int), value :: signal
      type(c_funptr), value :: handler

      before = c_null_funptr
      if (signal /= sigterm) before = c_sysv_signal(signal, handler)
   end function metis_signal

end module nested_dissection
