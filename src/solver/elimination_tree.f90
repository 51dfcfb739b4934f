!> The elimination tree of a symmetric matrix from its graph, the row counts of its factor, and its supernodes. A supernode is a
!! set of consecutive columns of the factor with the same rows. Small supernodes are merged into their parents.
!! Sources: Liu, SIAM J. Matrix Anal. Appl. 11 (1990) 134-172; Ashcraft, Grimes, ACM Trans. Math. Softw. 15 (1989) 291-309
!! (merging); Liu, SIAM Review 34 (1992) 82-109 (order of children).
module elimination_tree
   use front_kernel, only: touched_entries
   use kinds, only: wp
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: find_parents, number_depth_first, count_rows, find_supernodes, merge_supernodes

   !> Supernodes while they are merged. Columns and rows are places in the order of elimination.
   type, public :: supernodes_type
      integer :: n = 0
      integer, allocatable :: first(:)                        ! (n + 1) columns
      integer, allocatable :: first_row(:), rows(:)           ! rows below the columns, ascending
      integer, allocatable :: parent(:), top(:)               ! (n) top: the supernode into which this one was merged
      integer, allocatable :: child(:), sibling(:)            ! (n) lists of children, after merging of those that remain
      logical, allocatable :: is_refactored(:)
      real(wp), allocatable :: pivots(:), beyond(:), zeros(:) ! (n) unknowns; rows beyond; zeros stored in the front
      real(wp), allocatable :: update(:), peak(:)             ! (n) entries of the update matrix; most of those in the subtree
   end type supernodes_type

   ! A child is merged into its parent where zeros do not exceed this share of the resulting front.
   integer, parameter  :: merged_pivots(4) = [16, 48, 96, huge(1)]
   real(wp), parameter :: merged_zeros(4) = [1.0_wp, 0.3_wp, 0.1_wp, 0.02_wp]

contains

   !> The elimination tree of the first N_INNER nodes of ORDER. The nodes behind them count as one, number N_INNER + 1. The nodes
   !! are renumbered depth first, so that every subtree is without gaps.
   subroutine find_parents(graph, n_inner, order, place, parent)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_inner
      integer, intent(inout)            :: order(:)
      integer, allocatable, intent(out) :: place(:)  !! (graph%n) in the new order, 0: none
      integer, allocatable, intent(out) :: parent(:) !! (n_inner) 0: none
      integer, allocatable :: ancestor(:), child(:), sibling(:), number(:), sequence(:)
      logical, allocatable :: is_root(:)
      integer :: i, k, next, r, row

      allocate (place(graph%n), source=0)
      place(order) = [(i, i = 1, size(order))]
      allocate (parent(n_inner), ancestor(n_inner), child(n_inner), sibling(n_inner), source=0)
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

      allocate (is_root, source=parent == 0 .or. parent > n_inner)
      do i = n_inner, 1, -1
         if (is_root(i)) cycle
         sibling(i) = child(parent(i))
         child(parent(i)) = i
      end do
      call number_depth_first(is_root, child, sibling, number, sequence)
      do i = 1, n_inner
         if (.not. is_root(i)) parent(i) = number(parent(i))
      end do
      parent = parent(sequence)
      order(:n_inner) = order(sequence)
      place(order) = [(i, i = 1, size(order))]
   end subroutine find_parents

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

   !> BEYOND(j): rows below the diagonal in column j of the factor. Row i has entries in the columns on the paths up the tree from its
   !! neighbours before i to i. These paths form a subtree. A column has as many rows as subtrees begin below it, less those that meet
   !! or end there: of every subtree only its leaves, and where the paths of two leaves one after the other meet, are looked at.
   !! Source: Gilbert, Ng, Peyton, SIAM J. Matrix Anal. Appl. 15 (1994) 1075-1091.
   subroutine count_rows(graph, order, place, parent, beyond)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: order(:), place(:), parent(:) !! depth first
      integer, allocatable, intent(out) :: beyond(:)
      integer :: first(size(parent))    ! descendant
      integer :: ancestor(size(parent)) ! of columns done, towards the root
      integer :: last_first(size(order)), last_leaf(size(order)) ! first descendant of the last leaf of every row, and this leaf
      integer :: at, i, j, k, n

      n = size(parent)
      first = [(j, j = 1, n)]
      ancestor = first
      last_first = 0
      last_leaf = 0
      allocate (beyond(n), source=1)
      do j = 1, n
         if (parent(j) == 0 .or. parent(j) > n) cycle
         first(parent(j)) = min(first(parent(j)), first(j))
         beyond(parent(j)) = 0
      end do
      do j = 1, n
         do k = graph%first(order(j)), graph%first(order(j) + 1) - 1
            i = place(graph%neighbours(k))
            if (i <= j .or. first(j) <= last_first(max(1, i))) cycle ! no leaf
            beyond(j) = beyond(j) + 1
            if (last_leaf(i) > 0) then
               at = meeting(last_leaf(i))
               if (at >= j) beyond(at) = beyond(at) - 1 ! below j: the root of another tree, left by a row behind all columns
            end if
            last_first(i) = first(j)
            last_leaf(i) = j
         end do
         if (parent(j) == 0 .or. parent(j) > n) cycle
         beyond(parent(j)) = beyond(parent(j)) - 1 ! row j ends
         ancestor(j) = parent(j)
      end do
      do j = 1, n
         if (.not. (parent(j) == 0 .or. parent(j) > n)) beyond(parent(j)) = beyond(parent(j)) + beyond(j)
      end do
      beyond = beyond - 1

   contains

      !> Where the path of LEAF meets that of column J.
      integer function meeting(leaf)
         integer, intent(in) :: leaf
         integer :: at, next

         meeting = leaf
         do while (ancestor(meeting) /= meeting)
            meeting = ancestor(meeting)
         end do
         at = leaf
         do while (ancestor(at) /= meeting .and. at /= meeting)
            next = ancestor(at)
            ancestor(at) = meeting ! path compression
            at = next
         end do
      end function meeting

   end subroutine count_rows

   !> Gather columns with the same rows into supernodes, and count their unknowns. All columns beyond those of PARENT form one more
   !! supernode. A supernode with a node IN_JOINT in its subtree is refactored. Row after row is appended to the supernodes on the
   !! paths up the tree from its neighbours before it: so the rows of every supernode are ascending.
   subroutine find_supernodes(graph, order, place, parent, beyond, weight, in_joint, supers)
      type(node_graph_type), intent(in)  :: graph
      integer, intent(in)                :: order(:), place(:), parent(:), beyond(:)
      integer, intent(in)                :: weight(:)   !! (graph%n) unknowns of a node
      logical, intent(in)                :: in_joint(:) !! (graph%n)
      type(supernodes_type), intent(out) :: supers
      integer, allocatable :: mark(:), of_column(:), next(:)
      logical, allocatable :: is_first(:)
      integer :: i, j, k, n, n_columns, n_inner, s

      n_columns = size(parent)
      allocate (is_first(n_columns + 1), source=.true.)
      is_first(2:n_columns) = parent(:n_columns - 1) /= [(j, j = 2, n_columns)] .or. beyond(:n_columns - 1) /= beyond(2:) + 1
      supers%first = pack([(j, j = 1, n_columns + 1)], is_first)
      n_inner = size(supers%first) - 1
      if (size(order) > n_columns) supers%first = [supers%first, size(order) + 1]
      n = size(supers%first) - 1
      supers%n = n
      allocate (supers%first_row(n + 1), supers%parent(n), supers%child(n), supers%sibling(n), mark(n), source=0)
      allocate (supers%pivots(n), supers%beyond(n), source=0.0_wp)
      allocate (supers%is_refactored(n), source=.false.)
      allocate (of_column(size(order)))
      do s = 1, n
         of_column(supers%first(s):supers%first(s + 1) - 1) = s
      end do
      supers%first_row(1) = 1
      do s = 1, n
         supers%first_row(s + 1) = supers%first_row(s)
         if (s > n_inner) cycle
         j = supers%first(s + 1) - 1 ! its last column
         supers%first_row(s + 1) = supers%first_row(s) + beyond(j)
         if (parent(j) > 0) supers%parent(s) = of_column(parent(j))
      end do
      allocate (supers%rows(supers%first_row(n + 1) - 1))
      next = supers%first_row(:n)
      do i = 1, size(order)
         associate (own => of_column(i), rows => weight(order(i)))
            mark(own) = i
            do k = graph%first(order(i)), graph%first(order(i) + 1) - 1
               j = place(graph%neighbours(k))
               if (j == 0 .or. j >= i) cycle
               s = of_column(j)
               do while (mark(s) /= i)
                  mark(s) = i
                  supers%rows(next(s)) = i
                  next(s) = next(s) + 1
                  supers%beyond(s) = supers%beyond(s) + rows
                  s = supers%parent(s)
                  if (s == 0) exit
               end do
            end do
            supers%pivots(own) = supers%pivots(own) + rows
            if (in_joint(order(i))) supers%is_refactored(own) = .true.
         end associate
      end do
      do s = 1, n
         if (supers%parent(s) == 0) cycle
         associate (p => supers%parent(s))
            supers%sibling(s) = supers%child(p)
            supers%child(p) = s
            supers%is_refactored(p) = supers%is_refactored(p) .or. supers%is_refactored(s)
         end associate
      end do
   end subroutine find_supernodes

   !> Merge small supernodes into their parents. With KEEP_LAST the last one stays as it is. The remaining children are ordered
   !! for the least memory: a child with a high peak and a small update matrix comes first (Liu, 1992).
   subroutine merge_supernodes(supers, keep_last)
      type(supernodes_type), intent(inout) :: supers
      logical, intent(in)                  :: keep_last
      real(wp) :: added, left, pivots, zeros
      integer  :: c, grandchild, next, s
      logical  :: merges

      allocate (supers%top(supers%n), source=[(s, s=1, supers%n)])
      allocate (supers%zeros(supers%n), supers%peak(supers%n), source=0.0_wp)
      supers%update = touched_entries(supers%beyond, supers%beyond)
      do s = 1, supers%n
         c = supers%child(s)
         supers%child(s) = 0
         do while (c /= 0)
            next = supers%sibling(c)
            pivots = supers%pivots(c) + supers%pivots(s)
            added = entries(pivots, supers%beyond(s)) - entries(supers%pivots(s), supers%beyond(s)) &
                    - entries(supers%pivots(c), supers%beyond(c))
            zeros = supers%zeros(c) + supers%zeros(s) + added
            merges = (supers%is_refactored(c) .eqv. supers%is_refactored(s)) .and. .not. (keep_last .and. s == supers%n)
            if (merges) merges = zeros <= merged_zeros(findloc(pivots <= real(merged_pivots, wp), .true., dim=1)) &
                                          *entries(pivots, supers%beyond(s))
            if (merges) then
               supers%pivots(s) = pivots
               supers%zeros(s) = zeros
               supers%top(c) = s
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
         left = 0.0_wp ! entries of the update matrices of the children so far
         c = supers%child(s)
         do while (c /= 0)
            supers%peak(s) = max(supers%peak(s), left + supers%peak(c))
            left = left + supers%update(c)
            c = supers%sibling(c)
         end do
         supers%peak(s) = max(supers%peak(s), left + supers%update(s))
      end do

   contains

      !> Insert NEW into the children of S, in descending order of peak less update matrix.
      subroutine insert(new)
         integer, intent(in) :: new
         integer :: before, at

         before = 0
         at = supers%child(s)
         do while (at /= 0)
            if (supers%peak(at) - supers%update(at) < supers%peak(new) - supers%update(new)) exit
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

      !> Entries of P columns of a lower triangle with R rows beyond them.
      elemental real(wp) function entries(p, r)
         real(wp), intent(in) :: p, r

         entries = p*(0.5_wp*(p + 1.0_wp) + r)
      end function entries

   end subroutine merge_supernodes

end module elimination_tree
