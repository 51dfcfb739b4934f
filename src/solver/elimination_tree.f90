!> The elimination tree of a symmetric matrix from its graph, the row counts of its factor, and its supernodes. A supernode is a
!! set of consecutive columns of the factor with the same rows. Small supernodes are merged into their parents.
!! Sources: Liu, SIAM J. Matrix Anal. Appl. 11 (1990) 134-172; Ashcraft, Grimes, ACM Trans. Math. Softw. 15 (1989) 291-309
!! (merging); Liu, SIAM Review 34 (1992) 82-109 (order of children).
module elimination_tree
   use front_kernel, only: touched_entries
   use kinds, only: wp
   use lists, only: sorted_order
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: find_parents, number_depth_first, order_depth_first, count_rows, find_supernodes, weigh_supernodes, &
             merge_supernodes, sorted_places

   !> Supernodes while they are merged. Columns and rows are places in the order of elimination.
   type, public :: supernodes_type
      integer :: n = 0
      integer, allocatable :: first(:)                           ! (n + 1) columns
      integer, allocatable :: first_row(:), rows(:)              ! rows below the columns
      integer, allocatable :: parent(:), top(:)                  ! (n) top: the supernode into which this one was merged
      integer, allocatable :: child(:), sibling(:)               ! (n) lists of supernodes that were not merged
      integer, allocatable :: member(:), last_member(:), next(:) ! (n) lists of merged supernodes
      logical, allocatable :: is_refactored(:)
      real(wp), allocatable :: pivots(:), beyond(:), zeros(:)    ! (n) unknowns; rows beyond; zeros stored in the front
      real(wp), allocatable :: peak(:)                           ! (n) entries of update matrices
   end type supernodes_type

   ! A child is merged into its parent where zeros do not exceed this share of the resulting front.
   integer, parameter  :: merged_pivots(4) = [16, 48, 96, huge(1)]
   real(wp), parameter :: merged_zeros(4) = [1.0_wp, 0.3_wp, 0.1_wp, 0.02_wp]

contains

   !> The elimination tree of the first N_INNER places. The places behind them count as one node, number N_INNER + 1.
   subroutine find_parents(graph, order, place, n_inner, parent)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: order(:), place(:), n_inner
      integer, allocatable, intent(out) :: parent(:) !! (n_inner) 0: none
      integer, allocatable :: ancestor(:)
      integer :: i, k, next, r, row

      allocate (parent(n_inner), ancestor(n_inner), source=0)
      do i = 1, size(order)
         row = min(i, n_inner + 1)
         do k = graph%first(order(i)), graph%first(order(i) + 1) - 1
            r = place(graph%neighbours(k))
            if (r == 0 .or. r >= row) cycle
            do
               next = ancestor(r)
               if (next == row) exit
               ancestor(r) = row              ! path compression
               if (next == 0) then
                  parent(r) = row
                  exit
               end if
               r = next
            end do
         end do
      end do
   end subroutine find_parents

   !> Renumber a tree depth first, so that every subtree is without gaps; ORDER follows.
   subroutine order_depth_first(parent, order)
      integer, intent(inout) :: parent(:), order(:)
      integer, allocatable :: child(:), sibling(:), number(:), sequence(:)
      logical, allocatable :: is_root(:)
      integer :: j, n

      n = size(parent)
      allocate (is_root, source=parent == 0 .or. parent > n)
      allocate (child(n), sibling(n), source=0)
      do j = n, 1, -1
         if (is_root(j)) cycle
         sibling(j) = child(parent(j))
         child(parent(j)) = j
      end do
      call number_depth_first(is_root, child, sibling, number, sequence)
      do j = 1, n
         if (.not. is_root(j)) parent(j) = number(parent(j))
      end do
      parent = parent(sequence)
      order = order(sequence)
   end subroutine order_depth_first

   !> Number trees depth first, children first, from lists of children. NUMBER(i) is the number of node i, 0 where no root leads
   !! to node i. SEQUENCE is the inverse.
   pure subroutine number_depth_first(is_root, child, sibling, number, sequence)
      logical, intent(in)               :: is_root(:)
      integer, intent(inout)            :: child(:), sibling(:) !! first child, next child of the parent, 0: none; destroyed
      integer, allocatable, intent(out) :: number(:), sequence(:)
      integer :: first, n, node, root

      allocate (number(size(is_root)), sequence(size(is_root)), source=0)
      n = 0
      do root = 1, size(is_root)
         if (.not. is_root(root)) cycle
         node = root
         do
            do while (child(node) /= 0)
               first = child(node)
               child(node) = sibling(first)
               sibling(first) = node   ! link back to the parent
               node = first
            end do
            n = n + 1
            number(node) = n
            sequence(n) = node
            if (node == root) exit
            node = sibling(node)
         end do
      end do
      sequence = sequence(:n)
   end subroutine number_depth_first

   !> BEYOND(j): rows below the diagonal in column j of the factor. Row i has an entry in column j where j lies on the path up
   !! the tree from a neighbour of i to i.
   subroutine count_rows(graph, order, place, parent, beyond)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: order(:), place(:), parent(:)
      integer, allocatable, intent(out) :: beyond(:)
      integer, allocatable :: mark(:)
      integer :: i, j, k, n

      n = size(parent)
      allocate (beyond(n), mark(n), source=0)
      do i = 1, size(order)
         if (i <= n) mark(i) = i
         do k = graph%first(order(i)), graph%first(order(i) + 1) - 1
            j = place(graph%neighbours(k))
            if (j == 0 .or. j >= i .or. j > n) cycle
            do while (mark(j) /= i)
               mark(j) = i
               beyond(j) = beyond(j) + 1
               j = parent(j)
               if (j == 0 .or. j > n) exit
            end do
         end do
      end do
   end subroutine count_rows

   !> Gather columns with the same rows into supernodes. All columns beyond those of PARENT form one more supernode.
   subroutine find_supernodes(graph, order, place, parent, beyond, supers)
      type(node_graph_type), intent(in)    :: graph
      integer, intent(in)                  :: order(:), place(:), parent(:), beyond(:)
      type(supernodes_type), intent(inout) :: supers
      integer, allocatable :: of_column(:), mark(:), child(:), sibling(:)
      integer :: before, c, i, j, k, last, n, n_columns, row, s

      n_columns = size(parent)
      allocate (supers%first(size(order) + 2), of_column(n_columns + 1))
      n = 0
      do j = 1, n_columns
         before = max(1, j - 1)
         if (j == 1 .or. parent(before) /= j .or. beyond(before) /= beyond(j) + 1) then ! the rows differ from the last ones
            n = n + 1
            supers%first(n) = j
         end if
         of_column(j) = n
      end do
      if (size(order) > n_columns) then
         n = n + 1
         supers%first(n) = n_columns + 1
         of_column(n_columns + 1) = n
      end if
      supers%n = n
      supers%first(n + 1) = size(order) + 1
      supers%first = supers%first(:n + 1)
      allocate (supers%first_row(n + 1), supers%parent(n), child(n), sibling(n), source=0)
      supers%first_row(1) = 1
      do s = 1, n
         last = supers%first(s + 1) - 1
         supers%first_row(s + 1) = supers%first_row(s)
         if (last <= n_columns) supers%first_row(s + 1) = supers%first_row(s) + beyond(last)
      end do
      allocate (supers%rows(supers%first_row(n + 1) - 1))
      allocate (mark(size(order)), source=0)
      do s = 1, n
         last = supers%first(s + 1) - 1
         if (supers%first(s) > n_columns) cycle
         i = supers%first_row(s)
         do j = supers%first(s), last
            do k = graph%first(order(j)), graph%first(order(j) + 1) - 1
               row = place(graph%neighbours(k))
               if (row > last) call take(row)
            end do
         end do
         c = child(s)
         do while (c /= 0)
            do k = supers%first_row(c), supers%first_row(c + 1) - 1
               if (supers%rows(k) > last) call take(supers%rows(k))
            end do
            c = sibling(c)
         end do
         associate (rows => supers%rows(supers%first_row(s):supers%first_row(s + 1) - 1))
            if (size(rows) == 0) cycle
            rows = rows(sorted_places(rows))
            supers%parent(s) = of_column(min(rows(1), n_columns + 1))
         end associate
         sibling(s) = child(supers%parent(s))
         child(supers%parent(s)) = s
      end do

   contains

      subroutine take(new)
         integer, intent(in) :: new

         if (mark(new) == s) return
         mark(new) = s
         supers%rows(i) = new
         i = i + 1
      end subroutine take

   end subroutine find_supernodes

   !> The places of ROWS in ascending order.
   function sorted_places(rows) result(places)
      integer, intent(in)  :: rows(:)
      integer, allocatable :: places(:)

      call sorted_order(rows, places)
   end function sorted_places

   !> Count the unknowns of the supernodes, and mark the refactored supernodes.
   subroutine weigh_supernodes(order, weight, in_joint, supers)
      integer, intent(in)                  :: order(:), weight(:)
      logical, intent(in)                  :: in_joint(:)
      type(supernodes_type), intent(inout) :: supers
      integer :: s

      allocate (supers%pivots(supers%n), supers%beyond(supers%n), supers%is_refactored(supers%n))
      do s = 1, supers%n
         associate (columns => order(supers%first(s):supers%first(s + 1) - 1), &
                    rows => order(supers%rows(supers%first_row(s):supers%first_row(s + 1) - 1)))
            supers%pivots(s) = sum(weight(columns))
            supers%beyond(s) = sum(weight(rows))
            supers%is_refactored(s) = any(in_joint(columns))
         end associate
      end do
      do s = 1, supers%n
         associate (up => supers%parent(s))
            if (up > 0) supers%is_refactored(up) = supers%is_refactored(up) .or. supers%is_refactored(s)
         end associate
      end do
   end subroutine weigh_supernodes

   !> Merge small supernodes into their parents. With KEEP_LAST the last one stays as it is. The remaining children are ordered
   !! for the least memory: a child with a high peak and a small update matrix comes first (Liu, 1992).
   subroutine merge_supernodes(supers, keep_last)
      type(supernodes_type), intent(inout) :: supers
      logical, intent(in)                  :: keep_last
      integer, allocatable :: candidates(:), next_candidate(:)
      real(wp) :: pivots, zeros, added
      integer  :: c, grandchild, next, s
      logical  :: merge

      allocate (supers%top(supers%n), source=[(s, s=1, supers%n)])
      allocate (supers%member, supers%last_member, source=supers%top)
      allocate (supers%child(supers%n), supers%sibling(supers%n), supers%next(supers%n), candidates(supers%n), &
                next_candidate(supers%n), source=0)
      allocate (supers%zeros(supers%n), supers%peak(supers%n), source=0.0_wp)
      do s = 1, supers%n
         c = candidates(s)
         do while (c /= 0)
            next = next_candidate(c)
            pivots = supers%pivots(c) + supers%pivots(s)
            added = entries(pivots, supers%beyond(s)) - entries(supers%pivots(s), supers%beyond(s)) &
                    - entries(supers%pivots(c), supers%beyond(c))
            zeros = supers%zeros(c) + supers%zeros(s) + added
            merge = (supers%is_refactored(c) .eqv. supers%is_refactored(s)) .and. .not. (keep_last .and. s == supers%n)
            if (merge) merge = zeros <= merged_zeros(findloc(pivots <= real(merged_pivots, wp), .true., dim=1)) &
                                        *entries(pivots, supers%beyond(s))
            if (merge) then
               supers%pivots(s) = pivots
               supers%zeros(s) = zeros
               supers%top(c) = s
               supers%next(supers%last_member(s)) = supers%member(c)
               supers%last_member(s) = supers%last_member(c)
               do while (supers%child(c) /= 0)
                  grandchild = supers%child(c)
                  supers%child(c) = supers%sibling(grandchild)
                  call insert(grandchild)
               end do
            else
               call insert(c)
            end if
            c = next
         end do
         supers%peak(s) = peak_of(supers, s)
         if (supers%parent(s) > 0) then
            next_candidate(s) = candidates(supers%parent(s))
            candidates(supers%parent(s)) = s
         end if
      end do

   contains

      !> Insert NEW into the children of S, in descending order of peak less update matrix.
      subroutine insert(new)
         integer, intent(in) :: new
         integer :: before, at

         before = 0
         at = supers%child(s)
         do while (at /= 0)
            if (supers%peak(at) - update_entries(supers, at) < supers%peak(new) - update_entries(supers, new)) exit
            before = at
            at = supers%sibling(at)
         end do
         supers%sibling(new) = at
         if (before == 0) then
            supers%child(s) = new
         else
            supers%sibling(before) = new
         end if
      end subroutine insert

   end subroutine merge_supernodes

   !> The most entries of update matrices that exist at once while the subtree of S is eliminated, its children in their order.
   pure real(wp) function peak_of(supers, s) result(peak)
      type(supernodes_type), intent(in) :: supers
      integer, intent(in)               :: s
      real(wp) :: left ! entries of the update matrices of the children so far
      integer  :: c

      peak = 0.0_wp
      left = 0.0_wp
      c = supers%child(s)
      do while (c /= 0)
         peak = max(peak, left + supers%peak(c))
         left = left + update_entries(supers, c)
         c = supers%sibling(c)
      end do
      peak = max(peak, left + update_entries(supers, s))
   end function peak_of

   !> Entries of the update matrix of S.
   pure real(wp) function update_entries(supers, s)
      type(supernodes_type), intent(in) :: supers
      integer, intent(in)               :: s

      update_entries = touched_entries(supers%beyond(s), supers%beyond(s))
   end function update_entries

   !> Entries of P columns of a lower triangle with R rows beyond them.
   elemental real(wp) function entries(p, r)
      real(wp), intent(in) :: p, r

      entries = p*(0.5_wp*(p + 1.0_wp) + r)
   end function entries

end module elimination_tree
