!> The tree of dense fronts of a multifrontal factorisation. Static fronts have no unknown of a joint in their subtree; they are
!! factorised once. The other fronts are refactored in every increment.
!! Sources: Duff, Reid, ACM Trans. Math. Softw. 9 (1983) 302-325; Liu, SIAM Review 34 (1992) 82-109.
module front_tree
   use blas_lapack, only: dgemv, dsymv
   use element_unknowns, only: nodes_of_unknowns
   use front_kernel, only: top_row
   use front_layout, only: front_layout_type, front_operations
   use interface_equations, only: interface_equations_type, list_interface_equations
   use interface_operator, only: interface_element
   use kinds, only: long, wp
   use lists, only: first_not_below, list_owners, sorted_order
   use model_data, only: model_type
   use node_coupling, only: list_on_unknowns
   implicit none
   private

   public :: keep_block, restore_block, add_to_block, block_times_vector, start_front_tree, front_of, place_in

   !> A block with N_ROWS rows; its first N_COLUMNS rows are a lower triangle.
   type, public :: kept_block
      integer :: n_rows = 0, n_columns = 0
      real(wp), allocatable :: whole(:, :)            !! (n_rows, n_columns), or
      real(wp), allocatable :: values(:)              !! entries, column by column, rows ascending, at
      integer, allocatable  :: row(:), column(:)
   end type kept_block

   real(wp), parameter, public :: task_work = 2.0e6_wp !! operations in a subtree from which on it is a task
   real(wp), parameter :: parallel_work = 5.0e7_wp  ! operations of a factorisation from which on it uses several threads

   !> The initial content of a refactored front, which is the same in every increment.
   type :: front_start
      type(kept_block) :: panel, update
      real(wp), allocatable :: diagonal(:)        ! (p + r)
   end type front_start

   type, public :: front_type
      integer :: first = 0                        !! equation of its first pivot
      integer :: p = 0, r = 0                     !! pivots, rows beyond them
      integer :: parent = 0                       !! 0: none
      integer :: left = 0                         !! offset of its contributions to the rows beyond in a solution
      logical :: is_refactored = .false.
      logical :: is_top = .true.                  !! the parent, if there is one, is not of the same kind, refactored or static
      integer, allocatable  :: children(:)
      integer, allocatable  :: rows(:)            !! (r) equations beyond the pivots, ascending
      integer, allocatable  :: in_parent(:)       !! (r) their places in the front of the parent
      integer, allocatable  :: run(:)             !! where runs of places without gaps begin, and r + 1
      integer, allocatable  :: elements(:)        !! elements whose first equation this front eliminates
      integer, allocatable  :: springs(:)         !! interface elements likewise
      real(wp), allocatable :: panel(:, :)        !! (p + r, p), then the columns of the factor
      real(wp), allocatable :: update(:, :)       !! (r, r) update matrix for the parent; freed once the parent has added it
      real(wp), allocatable :: diagonal(:)        !! (p + r) of the original matrix, as assembled in the subtree; freed likewise
      integer, allocatable :: negative(:)         !! of a factor with signs: the pivots of this front whose sign is -1
      real(wp) :: weakest = 1.0_wp                !! smallest pivot relative to the original diagonal entry
      type(front_start), allocatable :: start     !! of a refactored front
      real(wp) :: work = 0.0_wp                   !! operations of its subtree
   end type front_type

   type, public :: front_tree_type
      integer :: n = 0                            !! equations
      real(wp) :: shift = 0.0_wp                  !! sigma, as equation_system has it
      integer, allocatable :: number(:, :)        !! (dimension, n_nodes) equation of a component, 0: held
      integer, allocatable :: of_equation(:)      !! (n) front that eliminates the equation
      type(interface_equations_type) :: joints
      real(wp), allocatable :: diagonal(:)        !! (n) of the factorised matrix
      logical, allocatable :: locked(:)           !! (n) locked unknowns, of refactored fronts only
      type(front_type), allocatable :: fronts(:)  !! children before parents
      integer, allocatable :: refactored(:)       !! refactored ones, ascending
      integer, allocatable :: equations(:)        !! that they eliminate, ascending
      integer :: most_rows = 0                    !! most rows of a front, pivots included
      integer :: n_left = 0                       !! rows beyond the pivots of all fronts together
      logical :: is_parallel = .false.            !! whether the model uses more than one thread
      real(wp) :: assembly_time = 0.0_wp          !! of the elements, all threads together [s]
   end type front_tree_type

contains

   !> Keep A, of which the kernel touches the lower part. OK is false where memory is missing.
   subroutine keep_block(a, block, ok)
      real(wp), intent(in)          :: a(:, :)
      type(kept_block), intent(out) :: block
      logical, intent(out)          :: ok
      integer(long) :: k
      integer :: i, j, status

      block%n_rows = size(a, 1)
      block%n_columns = size(a, 2)
      k = sum([(int(count(abs(a(j:, j)) > 0.0_wp), long), j = 1, block%n_columns)])
      if (2*k > int(block%n_rows, long)*block%n_columns/2) then
         allocate (block%whole(block%n_rows, block%n_columns), stat=status)
         ok = status == 0
         if (.not. ok) return
         do j = 1, block%n_columns
            block%whole(top_row(j):, j) = a(top_row(j):, j)
         end do
         return
      end if
      allocate (block%values(k), block%row(k), block%column(k), stat=status)
      ok = status == 0
      if (.not. ok) return
      k = 0
      do j = 1, block%n_columns
         do i = j, block%n_rows
            if (.not. abs(a(i, j)) > 0.0_wp) cycle
            k = k + 1
            block%values(k) = a(i, j)
            block%row(k) = i
            block%column(k) = j
         end do
      end do
   end subroutine keep_block

   !> A = BLOCK, in the part that the kernel touches.
   pure subroutine restore_block(block, a)
      type(kept_block), intent(in) :: block
      real(wp), intent(inout)      :: a(block%n_rows, block%n_columns)
      integer(long) :: k
      integer :: i, j

      do j = 1, block%n_columns
         if (allocated(block%whole)) then
            !$omp simd
            do i = top_row(j), block%n_rows
               a(i, j) = block%whole(i, j)
            end do
         else
            !$omp simd
            do i = top_row(j), block%n_rows
               a(i, j) = 0.0_wp
            end do
         end if
      end do
      if (allocated(block%whole)) return
      do k = 1, size(block%values, kind=long)
         a(block%row(k), block%column(k)) = block%values(k)
      end do
   end subroutine restore_block

   !> Add to BLOCK at these ROWS and COLUMNS the entries of K that do not lie above its diagonal.
   subroutine add_to_block(block, rows, columns, k)
      type(kept_block), intent(inout) :: block
      integer, intent(in)             :: rows(:), columns(:) !! ascending, each once
      real(wp), intent(in)            :: k(:, :)             !! (rows, columns)
      integer, allocatable  :: by_row(:), column(:), order(:), row(:)
      real(wp), allocatable :: values(:)
      logical :: is_lower(size(rows), size(columns))
      integer :: i, j, n

      is_lower = spread(rows, 2, size(columns)) >= spread(columns, 1, size(rows))
      if (allocated(block%whole)) then
         do j = 1, size(columns)
            do i = 1, size(rows)
               if (is_lower(i, j)) block%whole(rows(i), columns(j)) = block%whole(rows(i), columns(j)) + k(i, j)
            end do
         end do
         return
      end if
      row = [block%row, pack(spread(rows, 2, size(columns)), is_lower)]
      column = [block%column, pack(spread(columns, 1, size(rows)), is_lower)]
      values = [block%values, pack(k, is_lower)]
      call sorted_order(row, by_row)
      call sorted_order(column(by_row), order)
      order = by_row(order)
      block%row = row(order)
      block%column = column(order)
      block%values = values(order)
      n = min(1, size(order))
      do i = 2, size(order) ! an entry at the place of the one before is added to it
         if (block%row(i) == block%row(n) .and. block%column(i) == block%column(n)) then
            block%values(n) = block%values(n) + block%values(i)
         else
            n = n + 1
            block%row(n) = block%row(i)
            block%column(n) = block%column(i)
            block%values(n) = block%values(i)
         end if
      end do
      block%row = block%row(:n)
      block%column = block%column(:n)
      block%values = block%values(:n)
   end subroutine add_to_block

   !> Y = Y + BLOCK X, BLOCK being part of a symmetric matrix over the unknowns of its rows.
   subroutine block_times_vector(block, x, y)
      type(kept_block), intent(in) :: block
      real(wp), intent(in)         :: x(block%n_rows)
      real(wp), intent(inout)      :: y(block%n_rows)
      integer(long) :: k
      integer :: m, n

      m = block%n_rows
      n = block%n_columns
      if (allocated(block%whole)) then
         if (n == 0) return
         call dsymv('L', n, 1.0_wp, block%whole, m, x, 1, 1.0_wp, y, 1)
         if (m == n) return
         call dgemv('N', m - n, n, 1.0_wp, block%whole(n + 1, 1), m, x, 1, 1.0_wp, y(n + 1), 1)
         call dgemv('T', m - n, n, 1.0_wp, block%whole(n + 1, 1), m, x(n + 1), 1, 1.0_wp, y, 1)
      else
         do k = 1, size(block%values, kind=long)
            associate (i => block%row(k), j => block%column(k))
               y(i) = y(i) + block%values(k)*x(j)
               if (i /= j) y(j) = y(j) + block%values(k)*x(i)
            end associate
         end do
      end if
   end subroutine block_times_vector

   !> The tree of LAYOUT with the equations NUMBER; no matrix is formed yet.
   subroutine start_front_tree(model, number, layout, tree)
      type(model_type), intent(in)        :: model
      integer, intent(in)                 :: number(:, :)   !! numbered along layout%order
      type(front_layout_type), intent(in) :: layout
      type(front_tree_type), intent(out)  :: tree
      integer, allocatable :: first(:), weight(:), first_child(:), children(:)
      integer :: d, f, i, k, node, n_rows

      tree%is_parallel = layout%static_operations + layout%refactored_operations > parallel_work
      tree%number = number
      allocate (weight, first, source=count(number(:, layout%order) > 0, dim=1))
      tree%n = 0
      do k = 1, size(weight)
         first(k) = tree%n + 1
         tree%n = tree%n + weight(k)
      end do
      allocate (tree%fronts(layout%n), tree%of_equation(tree%n))
      allocate (tree%diagonal(tree%n), source=0.0_wp)
      allocate (tree%locked(tree%n), source=.false.)
      !$omp parallel do schedule(dynamic, 64) default(shared) private(d, i, n_rows, node) if(tree%is_parallel)
      do f = 1, layout%n
         associate (front => tree%fronts(f), low => layout%first_pivot(f), high => layout%first_pivot(f + 1) - 1, &
                    rows => layout%rows(layout%first_row(f):layout%first_row(f + 1) - 1))
            front%first = first(low)
            front%p = sum(weight(low:high))
            front%is_refactored = layout%is_refactored(f)
            front%parent = layout%parent(f)
            front%r = sum(weight(rows))
            allocate (front%rows(front%r))
            n_rows = 0
            do i = 1, size(rows)
               node = rows(i)
               do d = 0, weight(node) - 1
                  n_rows = n_rows + 1
                  front%rows(n_rows) = first(node) + d
               end do
            end do
            tree%of_equation(front%first:front%first + front%p - 1) = f
         end associate
      end do
      !$omp end parallel do
      call list_owners(layout%n, reshape(layout%parent, [1, layout%n]), first_child, children)
      !$omp parallel do schedule(dynamic, 64) default(shared) private(i) if(tree%is_parallel)
      do f = 1, layout%n
         tree%fronts(f)%children = children(first_child(f):first_child(f + 1) - 1)
         if (tree%fronts(f)%parent == 0) cycle
         associate (front => tree%fronts(f), parent => tree%fronts(tree%fronts(f)%parent))
            front%is_top = front%is_refactored .neqv. parent%is_refactored
            front%in_parent = place_in(parent, front%rows)
            ! a run ends where the next place in the parent is not consecutive, or is the first beyond the pivots of the parent
            front%run = [pack([(i, i=1, front%r)], front%in_parent /= [0, front%in_parent(:front%r - 1) + 1] .or. &
                                                   front%in_parent == parent%p + 1), front%r + 1]
         end associate
      end do
      !$omp end parallel do
      call hand_out_elements(model, tree)
      do f = 1, layout%n
         associate (front => tree%fronts(f))
            front%left = tree%n_left
            tree%n_left = tree%n_left + front%r
            front%work = front%work + front_operations(real(front%p, wp), real(front%r, wp))
            if (front%parent > 0) tree%fronts(front%parent)%work = tree%fronts(front%parent)%work + front%work
         end associate
      end do
      tree%refactored = pack([(f, f = 1, layout%n)], layout%is_refactored(:layout%n))
      tree%equations = pack([(i, i = 1, tree%n)], tree%fronts(tree%of_equation)%is_refactored)
      tree%most_rows = maxval(tree%fronts%p + tree%fronts%r)
   end subroutine start_front_tree

   !> Assign every element and interface element to the front that eliminates its first equation. The other equations are rows
   !! of that front.
   subroutine hand_out_elements(model, tree)
      type(model_type), intent(in)         :: model
      type(front_tree_type), intent(inout) :: tree
      type(interface_element), allocatable :: elements(:)
      integer, allocatable :: front(:, :), first(:), list(:)
      integer :: e, f

      allocate (front(1, max(model%mesh%n_elements, size(model%joints%element))))
      !$omp parallel do schedule(dynamic, 512) default(shared) if(tree%is_parallel)
      do e = 1, model%mesh%n_elements
         front(1, e) = front_of(tree, pack(tree%number(:, nodes_of_unknowns(model%freedoms, e)), .true.))
      end do
      !$omp end parallel do
      call list_owners(size(tree%fronts), front(:, :model%mesh%n_elements), first, list)
      do f = 1, size(tree%fronts)
         tree%fronts(f)%elements = list(first(f):first(f + 1) - 1)
      end do
      call list_on_unknowns(model, elements)
      call list_interface_equations(elements, tree%number, tree%joints)
      front(1, :size(elements)) = [(front_of(tree, tree%joints%rows_of(e)), e = 1, size(elements))]
      call list_owners(size(tree%fronts), front(:, :size(elements)), first, list)
      do f = 1, size(tree%fronts)
         tree%fronts(f)%springs = list(first(f):first(f + 1) - 1)
      end do
   end subroutine hand_out_elements

   !> The front that eliminates the first of EQUATIONS, 0 where all are 0.
   pure integer function front_of(tree, equations) result(f)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: equations(:)

      f = minval(equations, mask=equations > 0)
      f = merge(0, tree%of_equation(min(f, tree%n)), f > tree%n)
   end function front_of

   !> Row of EQUATION, one of its pivots or rows, in FRONT; 0 for equation 0.
   elemental integer function place_in(front, equation) result(place)
      type(front_type), intent(in) :: front
      integer, intent(in)          :: equation

      place = 0
      if (equation == 0) return
      place = equation - front%first + 1
      if (place > front%p) place = front%p + first_not_below(front%rows, equation)
   end function place_in

end module front_tree
