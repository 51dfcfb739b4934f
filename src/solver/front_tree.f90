!> The tree of dense fronts of a multifrontal factorisation. Static fronts have no unknown of a joint in their subtree; they are
!! factorised once. The other fronts are refactored in every increment.
!! Sources: Duff, Reid, ACM Trans. Math. Softw. 9 (1983) 302-325; Liu, SIAM Review 34 (1992) 82-109.
module front_tree
   use element_unknowns, only: nodes_of_unknowns
   use front_layout, only: front_layout_type, front_operations
   use interface_equations, only: interface_equations_type, list_interface_equations
   use interface_operator, only: interface_element
   use kept_blocks, only: kept_block
   use kinds, only: wp
   use lists, only: first_not_below, list_owners
   use model_data, only: model_type
   use node_coupling, only: list_on_unknowns
   implicit none
   private

   public :: start_front_tree, front_of, place_in, climb

   real(wp), parameter, public :: task_work = 2.0e6_wp !! operations in a subtree from which on it is a task
   real(wp), parameter, public :: task_entries = 2.0e5_wp !! entries of the factor likewise, in a substitution: some 0.1 ms
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
      logical :: is_followed = .false.            !! in every increment displacements of its pivots are computed
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
      real(wp) :: work = 0.0_wp                   !! operations of its subtree, fronts of the same kind
      integer :: n_children = 0                   !! children of the same kind
      integer :: begin = 0                        !! the first front of its subtree
      logical :: is_start = .false.               !! a task begins with its subtree, waiting for no other
      real(wp) :: entries = 0.0_wp                !! of the factor, in its subtree likewise
      logical :: starts_sweep = .false.           !! a task of a substitution likewise
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
      integer, allocatable :: followed(:)         !! static fronts that the displacements of sliding components use, ascending
      integer :: most_rows = 0                    !! most rows of a front, pivots included
      integer :: n_left = 0                       !! rows beyond the pivots of all fronts together
      logical :: is_parallel = .false.            !! whether the model uses more than one thread
      real(wp) :: assembly_time = 0.0_wp          !! of the elements, all threads together [s]
   end type front_tree_type

contains

   !> The tree of LAYOUT with the equations NUMBER; no matrix is formed yet.
   subroutine start_front_tree(model, number, layout, tree)
      type(model_type), intent(in)        :: model
      integer, intent(in)                 :: number(:, :)   !! numbered along layout%order, layout%unknowns in each place
      type(front_layout_type), intent(in) :: layout
      type(front_tree_type), intent(out)  :: tree
      integer, allocatable :: first(:), weight(:), first_child(:), children(:)
      integer :: d, f, i, k, node, n_rows

      tree%is_parallel = layout%static_operations + layout%refactored_operations > parallel_work
      tree%number = number
      allocate (weight, first, source=layout%unknowns)
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
            front%is_followed = layout%is_followed(f)
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
            front%in_parent = places_in(parent, front%rows)
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
            front%begin = minval([f, tree%fronts(front%children)%begin])
            front%is_start = front%n_children == 0 .or. front%is_top .and. front%work <= task_work
            front%entries = front%entries + real(front%p, wp)*(front%p + front%r)
            front%starts_sweep = front%n_children == 0 .or. front%is_top .and. front%entries <= task_entries
            if (front%is_top) cycle
            associate (parent => tree%fronts(front%parent))
               parent%work = parent%work + front%work
               parent%entries = parent%entries + front%entries
               parent%n_children = parent%n_children + 1
            end associate
         end associate
      end do
      do f = 1, layout%n
         associate (front => tree%fronts(f))
            if (front%is_top) cycle
            if (front%work <= task_work) front%is_start = tree%fronts(front%parent)%work > task_work
            if (front%entries <= task_entries) front%starts_sweep = tree%fronts(front%parent)%entries > task_entries
         end associate
      end do
      tree%refactored = pack([(f, f = 1, layout%n)], layout%is_refactored(:layout%n))
      tree%followed = pack([(f, f = 1, layout%n)], layout%is_followed)
      tree%equations = pack([(i, i = 1, tree%n)], tree%fronts(tree%of_equation)%is_refactored)
      tree%most_rows = maxval(tree%fronts%p + tree%fronts%r)
   end subroutine start_front_tree

   !> Assign every element and interface element to the front that eliminates its first equation. The other equations are rows
   !! of that front.
   subroutine hand_out_elements(model, tree)
      type(model_type), intent(in)         :: model
      type(front_tree_type), intent(inout) :: tree
      type(interface_element), allocatable :: elements(:)
      integer, allocatable :: front(:, :), first(:), list(:), number(:, :)
      integer :: d, e, f, i

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
      allocate (number, source=tree%number) ! of refactored fronts: others are of sliding components
      do i = 1, size(number, 2)
         do d = 1, size(number, 1)
            if (number(d, i) == 0) cycle
            if (.not. tree%fronts(tree%of_equation(number(d, i)))%is_refactored) number(d, i) = 0
         end do
      end do
      call list_interface_equations(elements, number, tree%joints)
      front(1, :size(elements)) = [(front_of(tree, tree%joints%rows_of(e)), e = 1, size(elements))]
      call list_owners(size(tree%fronts), front(:, :size(elements)), first, list)
      do f = 1, size(tree%fronts)
         tree%fronts(f)%springs = list(first(f):first(f + 1) - 1)
      end do
   end subroutine hand_out_elements

   !> From front F, whose subtree is done, to the front that can follow: the parent if it is of the same kind and F is the last of its
   !! children; otherwise 0. LEFT counts the children of every front that are not done.
   subroutine climb(tree, left, f)
      type(front_tree_type), intent(in) :: tree
      integer, intent(inout)            :: left(:), f
      integer :: n

      f = merge(0, tree%fronts(f)%parent, tree%fronts(f)%is_top)
      if (f == 0) return
      !$omp atomic capture seq_cst
      left(f) = left(f) - 1
      n = left(f)
      !$omp end atomic
      if (n > 0) f = 0
   end subroutine climb

   !> The front that eliminates the first of EQUATIONS, 0 where all are 0.
   pure integer function front_of(tree, equations) result(f)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: equations(:)
      integer :: first

      f = 0
      first = minval(equations, mask=equations > 0)
      if (first <= tree%n) f = tree%of_equation(first)
   end function front_of

   !> The rows in FRONT of ascending EQUATIONS, its pivots or rows.
   pure function places_in(front, equations) result(places)
      type(front_type), intent(in) :: front
      integer, intent(in)          :: equations(:)
      integer :: places(size(equations))
      integer :: i, k

      places = equations - front%first + 1
      k = 1
      do i = 1, size(equations)
         if (places(i) <= front%p) cycle
         do while (front%rows(k) < equations(i))
            k = k + 1
         end do
         places(i) = front%p + k
      end do
   end function places_in

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
