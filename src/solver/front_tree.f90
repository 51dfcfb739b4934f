!> The tree of dense fronts of a multifrontal factorisation. Fronts that do not move have no unknown of a joint in their subtree;
!! they are eliminated once. The others are assembled and eliminated again and again.
!! Sources: Duff, Reid, ACM Trans. Math. Softw. 9 (1983) 302-325; Liu, SIAM Review 34 (1992) 82-109.
module front_tree
   use front_blocks, only: kept_block
   use front_layout, only: front_layout_type, front_operations
   use interface_equations, only: interface_equations_type, list_interface_equations
   use interface_operator, only: interface_element
   use kinds, only: wp
   use model_data, only: model_type
   use node_coupling, only: list_on_unknowns
   use reverse_lists, only: list_owners
   use section_coupling, only: coupled_nodes
   implicit none
   private

   public :: start_front_tree, front_of, largest_diagonal

   real(wp), parameter :: parallel_work = 5.0e7_wp  ! operations of a factorisation that is worth more than one thread

   !> What a front that moves begins with in every increment: all that does not move.
   type :: front_start
      type(kept_block) :: panel, update
      real(wp), allocatable :: diagonal(:)        ! (p + r)
   end type front_start

   type, public :: front_type
      integer :: first = 0                        !! equation of its first pivot
      integer :: p = 0, r = 0                     !! pivots, rows beyond them
      integer :: parent = 0                       !! 0: none
      integer :: left = 0                         !! behind which place what it leaves for the rows beyond stands in a solution
      logical :: moves = .false.
      integer, allocatable  :: children(:)
      integer, allocatable  :: rows(:)            !! (r) equations beyond the pivots, ascending
      integer, allocatable  :: in_parent(:)       !! (r) their places in the front of the parent
      integer, allocatable  :: run(:)             !! where runs of places without gaps begin, and r + 1
      integer, allocatable  :: elements(:)        !! whose first equation it eliminates
      integer, allocatable  :: springs(:)         !! interface elements likewise
      real(wp), allocatable :: panel(:, :)        !! (p + r, p), then the columns of the factor
      real(wp), allocatable :: update(:, :)       !! (r, r) what is left for the parent; gone once that has it
      real(wp), allocatable :: diagonal(:)        !! (p + r) of the matrix before any elimination, as far as the subtree knows it;
                                                  !! gone likewise
      integer, allocatable :: negative(:)         !! of a factor with signs: the pivots of this front whose sign is -1
      real(wp) :: weakest = 1.0_wp                !! least pivot, as a share of its diagonal entry before any elimination
      type(front_start), allocatable :: start     !! of a front that moves
      real(wp) :: work = 0.0_wp                   !! operations of its subtree
   end type front_type

   type, public :: front_tree_type
      integer :: n = 0                            !! equations
      real(wp) :: shift = 0.0_wp                  !! sigma, as equation_system has it
      integer, allocatable :: number(:, :)        !! (dimension, n_nodes) equation of a component, 0: held
      integer, allocatable :: of_equation(:)      !! (n) front that eliminates it
      type(interface_equations_type) :: joints
      real(wp), allocatable :: diagonal(:)        !! (n) of the matrix that the factor is of
      logical, allocatable :: locked(:)           !! (n) unknowns that do not change any more; of fronts that move
      type(front_type), allocatable :: fronts(:)  !! children before parents
      integer, allocatable :: moving(:)           !! those that move, ascending
      integer, allocatable :: equations(:)        !! that they eliminate, ascending
      integer :: most_rows = 0                    !! pivots and rows beyond them of the largest
      integer :: n_left = 0                       !! rows beyond the pivots of all fronts together
      logical :: is_parallel = .false.            !! whether the model is worth more than one thread
      real(wp) :: assembly_time = 0.0_wp          !! of the elements, all threads together [s]
   end type front_tree_type

contains

   !> The tree of LAYOUT with the equations NUMBER: no matrix yet.
   subroutine start_front_tree(model, number, layout, tree)
      type(model_type), intent(in)        :: model
      integer, intent(in)                 :: number(:, :)   !! numbered along layout%order
      type(front_layout_type), intent(in) :: layout
      type(front_tree_type), intent(out)  :: tree
      integer, allocatable :: first(:), weight(:), first_child(:), children(:)
      integer :: d, f, i, k, node, n_rows

      tree%is_parallel = layout%fixed_operations + layout%moving_operations > parallel_work
      tree%number = number
      allocate (tree%fronts(layout%n))
      allocate (first(size(layout%order)), weight(size(layout%order)))
      tree%n = 0
      do k = 1, size(layout%order)
         first(k) = tree%n + 1
         weight(k) = count(number(:, layout%order(k)) > 0)
         tree%n = tree%n + weight(k)
      end do
      allocate (tree%of_equation(tree%n))
      allocate (tree%diagonal(tree%n), source=0.0_wp)
      allocate (tree%locked(tree%n), source=.false.)
      !$omp parallel do schedule(dynamic, 64) default(shared) private(d, i, n_rows, node) if(tree%is_parallel)
      do f = 1, layout%n
         associate (front => tree%fronts(f), low => layout%first_pivot(f), high => layout%first_pivot(f + 1) - 1, &
                    rows => layout%rows(layout%first_row(f):layout%first_row(f + 1) - 1))
            front%first = first(low)
            front%p = sum(weight(low:high))
            front%moves = layout%moves(f)
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
      do f = 1, layout%n
         tree%fronts(f)%left = tree%n_left
         tree%n_left = tree%n_left + tree%fronts(f)%r
      end do
      call list_owners(layout%n, reshape(layout%parent, [1, layout%n]), first_child, children)
      !$omp parallel do schedule(dynamic, 64) default(shared) private(i, k) if(tree%is_parallel)
      do f = 1, layout%n
         tree%fronts(f)%children = children(first_child(f):first_child(f + 1) - 1)
         if (tree%fronts(f)%parent == 0) cycle
         associate (front => tree%fronts(f), parent => tree%fronts(tree%fronts(f)%parent))
            allocate (front%in_parent(front%r))
            k = 0
            do i = 1, front%r
               if (front%rows(i) < parent%first + parent%p) then
                  front%in_parent(i) = front%rows(i) - parent%first + 1
               else
                  do
                     k = k + 1
                     if (parent%rows(k) == front%rows(i)) exit
                  end do
                  front%in_parent(i) = parent%p + k
               end if
            end do
            front%run = [pack([(i, i=1, front%r)], [(is_gap(front, parent%p, i), i=1, front%r)]), front%r + 1]
         end associate
      end do
      !$omp end parallel do
      call hand_out_elements(model, tree)
      do f = 1, layout%n
         associate (front => tree%fronts(f))
            front%work = front%work + front_operations(real(front%p, wp), real(front%r, wp))
            if (front%parent > 0) tree%fronts(front%parent)%work = tree%fronts(front%parent)%work + front%work
         end associate
      end do
      tree%moving = pack([(f, f = 1, layout%n)], layout%moves(:layout%n))
      tree%equations = pack([(i, i = 1, tree%n)], tree%fronts(tree%of_equation)%moves)
      tree%most_rows = maxval(tree%fronts%p + tree%fronts%r)
   end subroutine start_front_tree

   !> Whether row I has its place in the parent's front not right behind that of the row before, or not in the same part of it.
   pure logical function is_gap(front, parent_pivots, i)
      type(front_type), intent(in) :: front
      integer, intent(in)          :: parent_pivots, i

      is_gap = i == 1
      if (.not. is_gap) is_gap = front%in_parent(i) /= front%in_parent(i - 1) + 1 .or. front%in_parent(i) == parent_pivots + 1
   end function is_gap

   !> Every element, and every interface element, to the front that eliminates its first equation: the others are rows there.
   subroutine hand_out_elements(model, tree)
      type(model_type), intent(in)         :: model
      type(front_tree_type), intent(inout) :: tree
      type(interface_element), allocatable :: elements(:)
      integer, allocatable :: front(:, :), first(:), list(:)
      integer :: e, f

      allocate (front(1, max(model%n_elements, size(model%interface))))
      !$omp parallel do schedule(dynamic, 512) default(shared) if(tree%is_parallel)
      do e = 1, model%n_elements
         front(1, e) = front_of(tree, pack(tree%number(:, coupled_nodes(model, e)), .true.))
      end do
      !$omp end parallel do
      call list_owners(size(tree%fronts), front(:, :model%n_elements), first, list)
      do f = 1, size(tree%fronts)
         tree%fronts(f)%elements = list(first(f):first(f + 1) - 1)
      end do
      call list_on_unknowns(model, elements)
      call list_interface_equations(elements, tree%number, tree%joints)
      do e = 1, size(model%interface)
         front(1, e) = front_of(tree, tree%joints%rows_of(e))
      end do
      call list_owners(size(tree%fronts), front(:, :size(model%interface)), first, list)
      do f = 1, size(tree%fronts)
         tree%fronts(f)%springs = list(first(f):first(f + 1) - 1)
      end do
   end subroutine hand_out_elements

   !> The front that eliminates the first of EQUATIONS, 0 where all are 0.
   pure integer function front_of(tree, equations) result(f)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: equations(:)
      integer :: first

      first = minval(equations, mask=equations > 0)
      f = 0
      if (first <= tree%n) f = tree%of_equation(first)
   end function front_of

   !> The largest diagonal entry of the matrix without what moves, when the fronts that do not move have been eliminated and those
   !! that do have not.
   pure real(wp) function largest_diagonal(tree) result(largest)
      type(front_tree_type), intent(in) :: tree
      real(wp), allocatable :: diagonal(:)
      integer :: k

      allocate (diagonal, source=tree%diagonal)
      diagonal(tree%equations) = 0.0_wp
      do k = 1, size(tree%moving)
         associate (front => tree%fronts(tree%moving(k)))
            associate (first => front%first, last => front%first + front%p - 1)
               diagonal(first:last) = diagonal(first:last) + front%start%diagonal(:front%p)
               diagonal(front%rows) = diagonal(front%rows) + front%start%diagonal(front%p + 1:)
            end associate
         end associate
      end do
      largest = maxval(diagonal)
   end function largest_diagonal

end module front_tree
