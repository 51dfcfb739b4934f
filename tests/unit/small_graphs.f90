!> Graphs for tests of orderings, and the elimination of their dense patterns, the slow and sure way.
module small_graphs
   use, intrinsic :: iso_fortran_env, only: int64
   use kinds, only: wp
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: graph_of, grid, wide_grid, random_graph, join, mixed, eliminated, are_in_line

contains

   !> The graph whose nodes i, j are neighbours where EDGES(i, j), symmetric.
   subroutine graph_of(edges, graph)
      logical, intent(in)                :: edges(:, :)
      type(node_graph_type), intent(out) :: graph
      integer :: i, k, n

      n = size(edges, 1)
      graph%n = n
      allocate (graph%first(n + 1), graph%neighbours(count(edges)))
      graph%first(1) = 1
      do i = 1, n
         graph%first(i + 1) = graph%first(i) + count(edges(:, i))
         graph%neighbours(graph%first(i):graph%first(i + 1) - 1) = pack([(k, k = 1, n)], edges(:, i))
      end do
   end subroutine graph_of

   !> M by N nodes, number i + M (j - 1) in column i and row j, each with the up to eight around it as neighbours.
   subroutine grid(m, n, graph)
      integer, intent(in)                :: m, n
      type(node_graph_type), intent(out) :: graph
      logical :: edges(m*n, m*n)
      integer :: i, j

      do j = 1, m*n
         do i = 1, m*n
            edges(i, j) = i /= j .and. abs(modulo(i - 1, m) - modulo(j - 1, m)) <= 1 .and. abs((i - 1)/m - (j - 1)/m) <= 1
         end do
      end do
      call graph_of(edges, graph)
   end subroutine grid

   !> N nodes with at most so many edges, at random; another graph for every SEED.
   subroutine random_graph(n, n_edges, seed, graph)
      integer, intent(in)                :: n, n_edges, seed
      type(node_graph_type), intent(out) :: graph
      logical :: edges(n, n)
      integer :: ends(n), k

      edges = .false.
      do k = 1, n_edges
         ends = mixed(n, 100*seed + k)
         call join(edges, ends(1:1), ends(2:2))
      end do
      call graph_of(edges, graph)
   end subroutine random_graph

   !> A grid as above in linear time.
   subroutine wide_grid(m, n, graph)
      integer, intent(in)                :: m, n
      type(node_graph_type), intent(out) :: graph
      integer :: i, j, k, l, links

      graph%n = m*n
      allocate (graph%first(m*n + 1), graph%neighbours(8*m*n))
      links = 0
      do j = 1, n
         do i = 1, m
            graph%first(i + m*(j - 1)) = links + 1
            do l = max(1, j - 1), min(n, j + 1)
               do k = max(1, i - 1), min(m, i + 1)
                  if (k == i .and. l == j) cycle
                  links = links + 1
                  graph%neighbours(links) = k + m*(l - 1)
               end do
            end do
         end do
      end do
      graph%first(m*n + 1) = links + 1
      graph%neighbours = graph%neighbours(:links)
   end subroutine wide_grid

   !> Whether of the places of any two neighbours in a binary tree one is above the other, or the same: what separators are for.
   pure logical function are_in_line(graph, place)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: place(:)
      integer :: i, k, low, high

      are_in_line = .true.
      do i = 1, graph%n
         do k = graph%first(i), graph%first(i + 1) - 1
            high = min(place(i), place(graph%neighbours(k)))
            low = max(place(i), place(graph%neighbours(k)))
            do while (low > high)
               low = low/2
            end do
            are_in_line = are_in_line .and. low == high
         end do
      end do
   end function are_in_line

   !> An edge between ENDS(k) and OTHERS(k).
   pure subroutine join(edges, ends, others)
      logical, intent(inout) :: edges(:, :)
      integer, intent(in)    :: ends(:), others(:)
      integer :: k

      do k = 1, size(ends)
         edges(ends(k), others(k)) = .true.
         edges(others(k), ends(k)) = .true.
      end do
   end subroutine join

   !> 1..N in an order that looks like chance, another one for every SEED, the same on every machine.
   pure function mixed(n, seed) result(number)
      integer, intent(in) :: n, seed
      integer :: number(n), i, k, swap
      integer(int64) :: state

      number = [(i, i = 1, n)]
      state = 48271_int64*seed + 11
      do i = n, 2, -1
         state = modulo(state*16807_int64 + 7, 2147483647_int64)
         k = 1 + int(real(state, wp)/2147483648.0_wp*i)
         swap = number(i)
         number(i) = number(k)
         number(k) = swap
      end do
   end function mixed

   !> Pattern of the factor when the nodes of GRAPH are eliminated along ORDER: PATTERN(i, j), i > j, is row i of column j. What
   !! comes behind the first N_INNER nodes is taken as full.
   pure function eliminated(graph, order, n_inner) result(pattern)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: order(:), n_inner
      logical :: pattern(size(order), size(order))
      integer :: i, k, place(graph%n)

      place = 0
      place(order) = [(i, i = 1, size(order))]
      pattern = .false.
      do i = 1, size(order)
         do k = graph%first(order(i)), graph%first(order(i) + 1) - 1
            if (place(graph%neighbours(k)) > 0) pattern(place(graph%neighbours(k)), i) = .true.
         end do
      end do
      pattern(n_inner + 1:, n_inner + 1:) = .true.
      do i = 1, size(order)
         do k = i + 1, size(order)
            if (pattern(k, i)) pattern(i + 1:, k) = pattern(i + 1:, k) .or. pattern(i + 1:, i)
         end do
      end do
   end function eliminated

end module small_graphs
