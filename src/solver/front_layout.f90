!> The fronts of a multifrontal factorisation: pivot nodes, rows beyond the pivots, parents. The layout is symbolic and counts
!! nodes; WEIGHT(node) is the number of unknowns of a node.
!! Source: Liu, SIAM Review 34 (1992) 82-109.
module front_layout
   use elimination_tree, only: count_rows, find_parents, find_supernodes, merge_supernodes, number_depth_first, supernodes_type
   use front_kernel, only: large, touched_entries
   use kinds, only: wp
   use lists, only: list_owners
   use machine, only: has_huge_pages
   use node_graph, only: node_graph_type
   use sliding_components, only: divide_nodes
   implicit none
   private

   public :: choose_layout, lay_out_fronts, postpone_joints, front_operations

   real(wp), parameter :: entry_operations = 25.0_wp      !! cost of moving one entry of a front, in operations
   integer, parameter  :: part_nodes(3) = [200, 800, 3200] !! sizes of subtrees that are tried
   integer, parameter  :: least_sliding = 60              !! sliding components that are worth dividing nodes
   integer, parameter  :: many = 20000                    !! nodes from which on each layout has a thread of its own

   !> Fronts stand in the order of elimination: children before parents, a subtree without gaps.
   type, public :: front_layout_type
      integer :: n = 0                          !! fronts
      integer, allocatable :: order(:)          !! (nodes) in order of elimination; a divided node stands in two places
      integer, allocatable :: unknowns(:)       !! (nodes) eliminated in each place
      integer, allocatable :: first_pivot(:)    !! (n + 1) front f eliminates order(first_pivot(f):first_pivot(f+1)-1)
      integer, allocatable :: first_row(:)      !! (n + 1) its rows beyond the pivots begin here
      integer, allocatable :: rows(:)           !! rows(first_row(f):first_row(f+1)-1), ascending places in order
      integer, allocatable :: parent(:)         !! (n) 0: none
      logical, allocatable :: is_refactored(:)  !! (n) whether a node of a joint is eliminated in its subtree
      logical, allocatable :: is_followed(:)    !! (n) static: whether the displacements of sliding components use it
      real(wp) :: static_operations = 0.0_wp    !! of one factorisation of the static fronts
      real(wp) :: refactored_operations = 0.0_wp !! of one factorisation of the refactored fronts
      real(wp) :: factor_entries = 0.0_wp       !! entries of all panels in full
      real(wp) :: refactored_entries = 0.0_wp   !! entries of the refactored fronts, whole lower triangles
      real(wp) :: solved_entries = 0.0_wp       !! of these, entries of the factor, which a solution uses
      real(wp) :: followed_entries = 0.0_wp     !! of the factor, which the displacements of sliding components use
      real(wp) :: kept_entries = 0.0_wp         !! lower triangles that static fronts leave to refactored fronts
      real(wp) :: peak_entries = 0.0_wp         !! peak of update matrices, subtrees one after the other
      real(wp) :: most_entries = 0.0_wp         !! peak of panels, update matrices and initial contents of refactored fronts
   end type front_layout_type

contains

   !> Choose the LAYOUT with least work for FACTORISATIONS factorisations; WAY names its treatment of the joints. Layouts by
   !! parts are tried only where joints inside cost less than joints last. SLIDING components of joint nodes, so many, need not
   !! come last.
   subroutine choose_layout(graph, order, weight, in_joint, sliding, factorisations, layout, way)
      type(node_graph_type), intent(in)      :: graph
      integer, intent(in)                    :: order(:), weight(:), factorisations
      logical, intent(in)                    :: in_joint(:)
      integer, intent(in)                    :: sliding(:)   !! (graph%n)
      type(front_layout_type), intent(inout) :: layout
      character(:), allocatable, intent(out) :: way
      type(front_layout_type) :: last_and_inside(2), in_parts(size(part_nodes))
      integer, allocatable :: postponed(:)
      integer :: best, i

      !$omp parallel do schedule(dynamic, 1) default(shared) if(size(order) > many)
      do i = 1, 2
         if (i == 1 .and. sum(sliding) >= least_sliding) then
            call lay_out_divided(graph, order, weight, in_joint, sliding, last_and_inside(i))
         else
            call lay_out_fronts(graph, order, weight, in_joint, i == 1, last_and_inside(i))
         end if
      end do
      !$omp end parallel do
      way = 'LAST'
      layout = last_and_inside(1)
      if (total_work(last_and_inside(2), factorisations) >= total_work(layout, factorisations)) return
      way = 'INSIDE'
      layout = last_and_inside(2)
      !$omp parallel do schedule(dynamic, 1) default(shared) private(postponed) if(size(order) > many)
      do i = 1, size(part_nodes)
         postponed = order
         call postpone_joints(graph, in_joint, part_nodes(i), postponed)
         call lay_out_fronts(graph, postponed, weight, in_joint, .false., in_parts(i))
      end do
      !$omp end parallel do
      best = minloc([(total_work(in_parts(i), factorisations), i = 1, size(part_nodes))], dim=1)
      if (total_work(in_parts(best), factorisations) >= total_work(layout, factorisations)) return
      way = 'LAST IN PARTS'
      layout = in_parts(best)
   end subroutine choose_layout

   !> Operations of the whole run.
   pure real(wp) function total_work(layout, factorisations)
      type(front_layout_type), intent(in) :: layout
      integer, intent(in)                 :: factorisations

      total_work = layout%static_operations &
                   + factorisations*(layout%refactored_operations &
                                     + entry_operations*(layout%refactored_entries + layout%followed_entries))
   end function total_work

   !> Lay out the fronts of GRAPH along ORDER. With JOINTS_LAST the nodes with IN_JOINT come last, all in one front.
   subroutine lay_out_fronts(graph, order, weight, in_joint, joints_last, layout)
      type(node_graph_type), intent(in)    :: graph
      integer, intent(in)                  :: order(:)     !! nodes; nodes that are left out are no part of the matrix
      integer, intent(in)                  :: weight(:)    !! (graph%n)
      logical, intent(in)                  :: in_joint(:)  !! (graph%n)
      logical, intent(in)                  :: joints_last
      type(front_layout_type), intent(out) :: layout
      type(supernodes_type) :: supers
      integer, allocatable  :: place(:), parent(:), beyond(:), number(:), sequence(:)
      integer :: n_inner ! places up to n_inner have columns of their own

      layout%order = order
      n_inner = size(order)
      if (joints_last) then
         n_inner = count(.not. in_joint(order))
         layout%order(:n_inner) = pack(order, .not. in_joint(order))
         layout%order(n_inner + 1:) = pack(order, in_joint(order))
      end if
      call find_parents(graph, n_inner, layout%order, place, parent)
      call count_rows(graph, layout%order, place, parent, beyond)
      call find_supernodes(graph, layout%order, place, parent, beyond, weight, in_joint, supers)
      call merge_supernodes(supers, joints_last)
      call number_depth_first(supers%parent == 0, supers%child, supers%sibling, number, sequence)
      call make_fronts(supers, number, sequence, layout)
      layout%unknowns = weight(layout%order)
   end subroutine lay_out_fronts

   !> Lay out the fronts with joints last, of nodes with SLIDING components only their other components.
   subroutine lay_out_divided(graph, order, weight, in_joint, sliding, layout)
      type(node_graph_type), intent(in)    :: graph
      integer, intent(in)                  :: order(:), weight(:), sliding(:)
      logical, intent(in)                  :: in_joint(:)
      type(front_layout_type), intent(out) :: layout
      type(node_graph_type) :: divided
      integer, allocatable  :: node(:), all_order(:), all_weight(:)
      logical, allocatable  :: all_in_joint(:)
      integer :: f, p, r

      all_order = order
      all_weight = weight
      all_in_joint = in_joint
      call divide_nodes(graph, sliding, all_order, all_weight, all_in_joint, divided, node)
      call lay_out_fronts(divided, all_order, all_weight, all_in_joint, .true., layout)
      do f = 1, layout%n
         if (layout%is_refactored(f)) cycle
         associate (nodes => layout%order(layout%first_pivot(f):layout%first_pivot(f + 1) - 1), &
                    rows => layout%rows(layout%first_row(f):layout%first_row(f + 1) - 1), parent => layout%parent(f))
            if (any(sliding(pack(nodes, nodes <= graph%n)) > 0)) layout%is_followed(f) = .true.
            if (.not. layout%is_followed(f)) cycle
            p = sum(all_weight(nodes))
            r = sum(layout%unknowns(rows))
            layout%followed_entries = layout%followed_entries + real(p, wp)*(r + 0.5_wp*(p + 1))
            if (parent > 0) layout%is_followed(parent) = .not. layout%is_refactored(parent)
         end associate
      end do
      layout%order = node(layout%order)
   end subroutine lay_out_divided

   !> In every subtree of at most LARGEST nodes move the nodes with IN_JOINT to the end of its part of ORDER. The other nodes of
   !! the subtree are condensed onto them, as in joints last for whole bodies.
   subroutine postpone_joints(graph, in_joint, largest, order)
      type(node_graph_type), intent(in) :: graph
      logical, intent(in)               :: in_joint(:) !! (graph%n)
      integer, intent(in)               :: largest
      integer, intent(inout)            :: order(:)
      integer, allocatable :: place(:), parent(:), nodes(:)
      integer :: first, j, root

      call find_parents(graph, size(order), order, place, parent)
      allocate (nodes(size(order)), source=1)      ! of the subtree
      do j = 1, size(order)
         if (parent(j) > 0) nodes(parent(j)) = nodes(parent(j)) + nodes(j)
      end do
      root = size(order)
      do while (root > 0)
         first = root - nodes(root) + 1
         if (nodes(root) <= largest) then
            order(first:root) = [pack(order(first:root), .not. in_joint(order(first:root))), &
                                 pack(order(first:root), in_joint(order(first:root)))]
            root = first - 1
         else
            root = root - 1
         end if
      end do
   end subroutine postpone_joints

   !> Multiplications and additions, taken together, of the elimination of P of P + R unknowns in a dense front.
   elemental real(wp) function front_operations(p, r) result(operations)
      real(wp), intent(in) :: p, r

      operations = p*(p*p/3.0_wp + p*r + r*r)
   end function front_operations

   !> Make the fronts of LAYOUT from the supernodes that remain after merging, and count their work and entries. The columns of
   !! every front are numbered consecutively, in the order of the fronts.
   subroutine make_fronts(supers, number, sequence, layout)
      type(supernodes_type), intent(inout)   :: supers
      integer, intent(in)                    :: number(:)   !! front of a supernode that remains
      integer, intent(in)                    :: sequence(:) !! supernode of a front
      type(front_layout_type), intent(inout) :: layout
      integer, allocatable :: front(:, :), columns(:), new_place(:)
      integer  :: f, i, s
      real(wp), dimension(size(sequence)) :: p, r   ! unknowns of the pivots, rows beyond
      real(wp), dimension(size(sequence)) :: panel, update, work ! entries that take memory, operations
      real(wp), dimension(size(sequence)) :: filled ! initial entries of refactored fronts

      allocate (front(1, size(layout%order)), new_place(size(layout%order)))
      do s = supers%n, 1, -1
         supers%top(s) = supers%top(supers%top(s))
         front(1, supers%first(s):supers%first(s + 1) - 1) = number(supers%top(s))
      end do
      layout%n = size(sequence)
      call list_owners(layout%n, front, layout%first_pivot, columns)
      new_place(columns) = [(i, i = 1, size(columns))]
      layout%order = layout%order(columns)

      p = supers%pivots(sequence)
      r = supers%beyond(sequence)
      layout%is_refactored = supers%is_refactored(sequence)
      allocate (layout%is_followed(layout%n), source=.false.)
      work = front_operations(p, r)
      layout%static_operations = sum(work, mask=.not. layout%is_refactored)
      layout%refactored_operations = sum(work, mask=layout%is_refactored)
      layout%factor_entries = sum((p + r)*p)
      layout%refactored_entries = sum(0.5_wp*(p + r)*(p + r + 1.0_wp), mask=layout%is_refactored)
      layout%solved_entries = sum(p*(p + r - 0.5_wp*(p - 1.0_wp)), mask=layout%is_refactored)
      layout%peak_entries = max(0.0_wp, maxval(supers%peak(sequence)))

      allocate (layout%first_row(layout%n + 1), layout%parent(layout%n))
      allocate (layout%rows(sum(supers%first_row(sequence + 1) - supers%first_row(sequence))))
      layout%first_row(1) = 1
      layout%parent = 0
      filled = 0.0_wp
      do f = 1, layout%n
         s = sequence(f)
         associate (rows => supers%rows(supers%first_row(s):supers%first_row(s + 1) - 1), first => layout%first_row(f))
            layout%first_row(f + 1) = first + size(rows)
            layout%rows(first:first + size(rows) - 1) = new_place(rows)
         end associate
         if (supers%parent(s) == 0) cycle
         associate (parent => number(supers%top(supers%parent(s))))
            layout%parent(f) = parent
            if (layout%is_refactored(parent) .and. .not. layout%is_refactored(f)) &
               filled(parent) = filled(parent) + 0.5_wp*r(f)*(r(f) + 1.0_wp)
         end associate
      end do
      layout%kept_entries = sum(filled)
      panel = touched_entries(p + r, p)
      update = touched_entries(r, r)
      if (has_huge_pages()) then
         panel = (p + r)*p
         update = r*r
      end if
      ! two indices for each entry, or the whole front where that takes less memory
      layout%most_entries = most_standing(layout, panel, update, &
                                          sum(merge(panel + update, 2.0_wp*filled, filled > 0.25_wp*((p + r)*p + r**2))))
   end subroutine make_fronts

   !> The most entries that exist at once, given those of PANEL and UPDATE matrix of every front. Static fronts are eliminated
   !! first, one after the other, and leave KEPT entries to the refactored ones, which are eliminated next.
   pure real(wp) function most_standing(layout, panel, update, kept) result(most)
      type(front_layout_type), intent(in) :: layout
      real(wp), intent(in)                :: panel(:), update(:), kept
      real(wp) :: left(layout%n)           ! update entries that the children leave to a front
      real(wp) :: of_large(layout%n)       ! of these, entries of large matrices, whose memory the front takes over
      real(wp) :: now, need
      integer  :: f, pass

      most = 0.0_wp
      now = 0.0_wp
      do pass = 1, 2                       ! static fronts, then refactored ones
         left = 0.0_wp
         of_large = 0.0_wp
         if (pass == 2) now = sum(panel) + kept
         most = max(most, now)
         do f = 1, layout%n
            if (layout%is_refactored(f) .neqv. pass == 2) cycle
            need = update(f) + merge(panel(f), 0.0_wp, pass == 1)
            now = now + need
            most = max(most, now - min(need, of_large(f)))
            now = now - left(f)
            associate (parent => layout%parent(f))
               if (parent == 0) then
                  now = now - update(f)
                  cycle
               end if
               if (layout%is_refactored(parent) .neqv. layout%is_refactored(f)) cycle
               left(parent) = left(parent) + update(f)
               if (update(f) >= real(large, wp)) of_large(parent) = of_large(parent) + update(f)
            end associate
         end do
      end do
   end function most_standing

end module front_layout
