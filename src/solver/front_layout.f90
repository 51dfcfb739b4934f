!> The fronts of a multifrontal factorisation: which nodes each eliminates, which rows it has beyond them, whose child it is.
!! Everything here is symbolic and counts nodes; WEIGHT(node) is how many unknowns a node has.
!! Sources: Liu, SIAM Review 34 (1992) 82-109 (elimination tree, fronts, order of children); Ashcraft, Grimes, ACM Trans. Math.
!! Softw. 15 (1989) 291-309 (merging of small fronts).
module front_layout
   use id_table, only: sorted_order
   use kinds, only: wp
   use node_graph, only: node_graph_type
   implicit none
   private

   public :: lay_out_fronts, front_operations

   !> Fronts stand in the order of elimination: children before parents, a subtree without gaps.
   type, public :: front_layout_type
      integer :: n = 0                          !! fronts
      integer, allocatable :: order(:)          !! (nodes) in order of elimination
      integer, allocatable :: first_pivot(:)    !! (n + 1) front f eliminates order(first_pivot(f):first_pivot(f+1)-1)
      integer, allocatable :: first_row(:)      !! (n + 1) and has the rows beyond
      integer, allocatable :: rows(:)           !! rows(first_row(f):first_row(f+1)-1), ascending places in order
      integer, allocatable :: parent(:)         !! (n) 0: none
      logical, allocatable :: moves(:)          !! (n) whether a node of a joint is eliminated in its subtree
      real(wp) :: fixed_operations  = 0.0_wp    !! of one factorisation of the fronts that do not move
      real(wp) :: moving_operations = 0.0_wp    !! of the others
      real(wp) :: factor_entries = 0.0_wp       !! of all panels, as stored
      real(wp) :: moving_entries = 0.0_wp       !! entries of the moving fronts, whole lower triangles
      real(wp) :: peak_entries   = 0.0_wp       !! most that stand in update matrices at once, one subtree after the other
   end type front_layout_type

   !> Supernodes while they are merged.
   type :: supernodes_type
      integer :: n = 0
      integer, allocatable :: first(:)                           ! (n + 1) columns
      integer, allocatable :: first_row(:), rows(:)              ! rows below the columns
      integer, allocatable :: parent(:), top(:)                  ! (n) top: the one it was merged into
      integer, allocatable :: child(:), sibling(:)               ! (n) lists of what was not merged
      integer, allocatable :: member(:), last_member(:), next(:) ! (n) lists of what was
      logical, allocatable :: moves(:)
      real(wp), allocatable :: pivots(:), beyond(:), zeros(:)    ! (n) unknowns; entries that are stored for nothing
      real(wp), allocatable :: peak(:)                           ! (n) entries of update matrices
   end type supernodes_type

   ! A child goes into its parent where no larger share of the front that results is zeros.
   integer, parameter  :: merged_pivots(4) = [16, 48, 96, huge(1)]
   real(wp), parameter :: merged_zeros(4) = [1.0_wp, 0.5_wp, 0.2_wp, 0.05_wp]

contains

   !> Lay out the fronts of GRAPH eliminated along ORDER. With JOINTS_LAST the nodes with IN_JOINT go to the end, all into one front.
   subroutine lay_out_fronts(graph, order, weight, in_joint, joints_last, layout)
      type(node_graph_type), intent(in)    :: graph
      integer, intent(in)                  :: order(:)     !! nodes; those that it leaves out are no part of the matrix
      integer, intent(in)                  :: weight(:)    !! (graph%n)
      logical, intent(in)                  :: in_joint(:)  !! (graph%n)
      logical, intent(in)                  :: joints_last
      type(front_layout_type), intent(out) :: layout
      type(supernodes_type) :: supers
      integer, allocatable  :: place(:), parent(:), beyond(:)
      integer :: n_inner ! places up to here have columns of their own

      allocate (layout%order, source=order)
      n_inner = size(order)
      if (joints_last) then
         n_inner = count(.not. in_joint(order))
         layout%order(:n_inner) = pack(order, .not. in_joint(order))
         layout%order(n_inner + 1:) = pack(order, in_joint(order))
      end if
      call number_places(graph, layout%order, place)
      call find_parents(graph, layout%order, place, n_inner, parent)
      call order_depth_first(parent, layout%order(:n_inner))
      call number_places(graph, layout%order, place)
      call count_rows(graph, layout%order, place, parent, beyond)
      call find_supernodes(graph, layout%order, place, parent, beyond, supers)
      call weigh(layout%order, weight, in_joint, supers)
      call merge_supernodes(supers, joints_last)
      call number_fronts(supers, layout)
   end subroutine lay_out_fronts


   !> Multiplications and additions, taken together, of the elimination of P of P + R unknowns in a dense front.
   elemental real(wp) function front_operations(p, r) result(operations)
      real(wp), intent(in) :: p, r

      operations = p*(p*p/3.0_wp + p*r + r*r)
   end function front_operations


   !> PLACE(ORDER(k)) = k, 0 for other nodes.
   subroutine number_places(graph, order, place)
      type(node_graph_type), intent(in)   :: graph
      integer, intent(in)                 :: order(:)
      integer, allocatable, intent(inout) :: place(:)
      integer :: k

      if (.not. allocated(place)) allocate (place(graph%n), source=0)
      do k = 1, size(order)
         place(order(k)) = k
      end do
   end subroutine number_places


   !> The elimination tree of the first N_INNER places; what comes behind them is taken as one, number N_INNER + 1.
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
               ancestor(r) = row              ! the way is shorter next time
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
      integer, allocatable :: child(:), sibling(:), number(:), new_parent(:), new_order(:)
      integer :: j, n, roots, node, done

      n = size(parent)
      allocate (child(n), sibling(n), number(n), source=0)
      roots = 0
      do j = n, 1, -1
         if (parent(j) == 0 .or. parent(j) > n) then
            sibling(j) = roots
            roots = j
         else
            sibling(j) = child(parent(j))
            child(parent(j)) = j
         end if
      end do
      done = 0
      do while (roots /= 0)
         node = roots
         roots = sibling(roots)
         walk: do
            do while (child(node) /= 0)   ! down to the first child that is not numbered
               j = child(node)
               child(node) = sibling(j)
               node = j
            end do
            done = done + 1
            number(node) = done
            if (parent(node) == 0 .or. parent(node) > n) exit walk
            node = parent(node)
         end do walk
      end do
      allocate (new_parent(n), new_order(n))
      do j = 1, n
         new_order(number(j)) = order(j)
         new_parent(number(j)) = parent(j)
         if (parent(j) > 0 .and. parent(j) <= n) new_parent(number(j)) = number(parent(j))
      end do
      parent = new_parent
      order = new_order
   end subroutine order_depth_first


   !> BEYOND(j): rows below the diagonal in column j of the factor. Row i has an entry in column j where j lies on the way up
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


   !> Columns with the same rows in one supernode each; what comes behind the columns of PARENT is one more.
   subroutine find_supernodes(graph, order, place, parent, beyond, supers)
      type(node_graph_type), intent(in)    :: graph
      integer, intent(in)                  :: order(:), place(:), parent(:), beyond(:)
      type(supernodes_type), intent(inout) :: supers
      integer, allocatable :: of_column(:), mark(:), child(:), sibling(:)
      integer :: c, i, j, k, last, n, n_columns, row, s

      n_columns = size(parent)
      allocate (supers%first(size(order) + 2), of_column(n_columns + 1))
      n = 0
      do j = 1, n_columns
         if (.not. continues(j)) then
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

      !> Whether column J has the rows of the one before.
      pure logical function continues(column)
         integer, intent(in) :: column

         continues = column > 1
         if (continues) continues = parent(column - 1) == column .and. beyond(column - 1) == beyond(column) + 1
      end function continues

      subroutine take(new)
         integer, intent(in) :: new

         if (mark(new) == s) return
         mark(new) = s
         supers%rows(i) = new
         i = i + 1
      end subroutine take

   end subroutine find_supernodes


   function sorted_places(rows) result(places)
      integer, intent(in)  :: rows(:)
      integer, allocatable :: places(:)

      call sorted_order(rows, places)
   end function sorted_places


   !> Unknowns of the supernodes, and which of them move.
   subroutine weigh(order, weight, in_joint, supers)
      integer, intent(in)                  :: order(:), weight(:)
      logical, intent(in)                  :: in_joint(:)
      type(supernodes_type), intent(inout) :: supers
      integer :: s

      allocate (supers%pivots(supers%n), supers%beyond(supers%n), supers%moves(supers%n))
      do s = 1, supers%n
         associate (columns => order(supers%first(s):supers%first(s + 1) - 1), &
                    rows => order(supers%rows(supers%first_row(s):supers%first_row(s + 1) - 1)))
            supers%pivots(s) = sum(weight(columns))
            supers%beyond(s) = sum(weight(rows))
            supers%moves(s) = any(in_joint(columns))
         end associate
      end do
      do s = 1, supers%n
         if (supers%parent(s) > 0) supers%moves(supers%parent(s)) = supers%moves(supers%parent(s)) .or. supers%moves(s)
      end do
   end subroutine weigh


   !> Merge small supernodes into their parents. With KEEP_LAST the last one stays as it is. The children that are left stand in
   !! the order that needs least room: those first that need much for themselves and leave little behind.
   subroutine merge_supernodes(supers, keep_last)
      type(supernodes_type), intent(inout) :: supers
      logical, intent(in)                  :: keep_last
      integer, allocatable :: candidates(:), next_candidate(:)
      real(wp) :: pivots, zeros, added, left, most
      integer  :: c, next, s
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
            merge = (supers%moves(c) .eqv. supers%moves(s)) .and. .not. (keep_last .and. s == supers%n)
            if (merge) merge = zeros <= merged_zeros(findloc(pivots <= real(merged_pivots, wp), .true., dim=1)) &
                                        *entries(pivots, supers%beyond(s))
            if (merge) then
               supers%pivots(s) = pivots
               supers%zeros(s) = zeros
               supers%top(c) = s
               supers%next(supers%last_member(s)) = supers%member(c)
               supers%last_member(s) = supers%last_member(c)
               do while (supers%child(c) /= 0)
                  call adopt(supers%child(c))
               end do
            else
               call insert(c)
            end if
            c = next
         end do
         left = 0.0_wp
         most = 0.0_wp
         c = supers%child(s)
         do while (c /= 0)
            most = max(most, left + supers%peak(c))
            left = left + update_entries(c)
            c = supers%sibling(c)
         end do
         supers%peak(s) = max(most, left + update_entries(s))
         if (supers%parent(s) > 0) then
            next_candidate(s) = candidates(supers%parent(s))
            candidates(supers%parent(s)) = s
         end if
      end do

   contains

      !> The first child of C becomes one of S.
      subroutine adopt(first)
         integer, intent(in) :: first
         integer :: grandchild

         grandchild = first
         supers%child(c) = supers%sibling(grandchild)
         call insert(grandchild)
      end subroutine adopt

      !> Into the list of children of S, in descending order of peak less what is left.
      subroutine insert(new)
         integer, intent(in) :: new
         integer :: before, at

         before = 0
         at = supers%child(s)
         do while (at /= 0)
            if (supers%peak(at) - update_entries(at) < supers%peak(new) - update_entries(new)) exit
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

      pure real(wp) function update_entries(of)
         integer, intent(in) :: of

         update_entries = supers%beyond(of)**2
      end function update_entries

   end subroutine merge_supernodes


   !> Entries of P columns of a lower triangle with R rows beyond them.
   elemental real(wp) function entries(p, r)
      real(wp), intent(in) :: p, r

      entries = p*(0.5_wp*(p + 1.0_wp) + r)
   end function entries


   !> Number what is left of the supernodes depth first, and their nodes along with them.
   subroutine number_fronts(supers, layout)
      type(supernodes_type), intent(inout)   :: supers
      type(front_layout_type), intent(inout) :: layout
      integer, allocatable :: number(:), front_of(:), sequence(:), new_order(:), columns(:), new_place(:)
      integer :: f, i, k, member, n, s
      real(wp) :: rows

      allocate (number(supers%n), sequence(supers%n), source=0)
      n = 0
      do s = 1, supers%n
         if (supers%parent(s) == 0) call walk(s)
      end do
      layout%n = n
      allocate (layout%first_pivot(n + 1), layout%first_row(n + 1), layout%parent(n), layout%moves(n))
      allocate (new_order(size(layout%order)), new_place(size(layout%order)), columns(size(layout%order)))
      layout%first_pivot(1) = 1
      layout%first_row(1) = 1
      do f = 1, n
         s = sequence(f)
         k = 0
         member = supers%member(s)
         do while (member /= 0)
            associate (first => supers%first(member), last => supers%first(member + 1) - 1)
               columns(k + 1:k + last - first + 1) = [(i, i=first, last)]
               k = k + last - first + 1
            end associate
            member = supers%next(member)
         end do
         columns(:k) = columns(sorted_places(columns(:k)))
         associate (first => layout%first_pivot(f))
            layout%first_pivot(f + 1) = first + k
            new_order(first:first + k - 1) = layout%order(columns(:k))
            new_place(columns(:k)) = [(i, i=first, first + k - 1)]
         end associate
         layout%first_row(f + 1) = layout%first_row(f) + supers%first_row(s + 1) - supers%first_row(s)
         layout%moves(f) = supers%moves(s)
         rows = supers%pivots(s) + supers%beyond(s)
         layout%factor_entries = layout%factor_entries + rows*supers%pivots(s)
         if (layout%moves(f)) then
            layout%moving_operations = layout%moving_operations + front_operations(supers%pivots(s), supers%beyond(s))
            layout%moving_entries = layout%moving_entries + 0.5_wp*rows*(rows + 1.0_wp)
         else
            layout%fixed_operations = layout%fixed_operations + front_operations(supers%pivots(s), supers%beyond(s))
         end if
      end do
      layout%order = new_order
      allocate (layout%rows(layout%first_row(layout%n + 1) - 1), front_of(supers%n))
      layout%parent = 0
      layout%peak_entries = 0.0_wp
      do f = 1, layout%n
         s = sequence(f)
         layout%rows(layout%first_row(f):layout%first_row(f + 1) - 1) = &
            new_place(supers%rows(supers%first_row(s):supers%first_row(s + 1) - 1))
         layout%peak_entries = max(layout%peak_entries, supers%peak(s))
         s = supers%parent(s)
         if (s == 0) cycle
         do while (supers%top(s) /= s)
            s = supers%top(s)
         end do
         layout%parent(f) = number(s)
      end do

   contains

      !> Number a tree from its root S, children first.
      subroutine walk(root)
         integer, intent(in) :: root
         integer :: node, child

         node = root
         do
            do while (supers%child(node) /= 0)
               child = supers%child(node)
               supers%child(node) = supers%sibling(child)
               supers%sibling(child) = node   ! the way back
               node = child
            end do
            n = n + 1
            number(node) = n
            sequence(n) = node
            if (node == root) exit
            node = supers%sibling(node)
         end do
      end subroutine walk

   end subroutine number_fronts

end module front_layout
