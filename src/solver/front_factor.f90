!> Factorisation in a tree of fronts: static fronts once, the others in every increment. Independent subtrees are tasks of
!! OpenMP. Every addition has its place in one order, whatever the number of threads.
module front_factor
   use element_unknowns, only: nodes_of_unknowns
   use equation_solver, only: no_memory
   use front_assembly, only: add_children, children_done, is_tiled, set_to_zero
   use front_kernel, only: eliminate
   use front_tiles, only: eliminate_in_tiles
   use front_tree, only: climb, front_of, front_tree_type, front_type, place_in
   use kept_blocks, only: add_to_block, keep_block, restore_block
   use kinds, only: wp
   use lists, only: sorted_order
   use mass_matrix, only: coupled_dynamic_stiffness
   use model_data, only: model_type
   use omp_lib, only: omp_get_num_threads, omp_get_wtime
   use task_record, only: is_recorded, key, record_phase, record_task, start_record, task_begins
   use tolerances, only: pivot_tolerance
   implicit none
   private

   public :: factorise_static, factorise_refactored, add_to_refactored

contains

   !> Add the symmetric matrix K of the EQUATIONS (0: held) to FRONT, whose rows include all of them.
   pure subroutine add_matrix(front, equations, k)
      type(front_type), intent(inout) :: front
      integer, intent(in)             :: equations(:)
      real(wp), intent(in)            :: k(:, :)
      integer :: places(size(equations)), i, j, row, column

      places = place_in(front, equations)
      do j = 1, size(equations)
         column = places(j)
         if (column == 0) cycle
         front%diagonal(column) = front%diagonal(column) + k(j, j)
         if (column <= front%p) then
            do i = 1, size(equations)
               row = places(i)
               if (row >= column) front%panel(row, column) = front%panel(row, column) + k(i, j)
            end do
         else
            do i = 1, size(equations)
               row = places(i)
               if (row >= column) front%update(row - front%p, column - front%p) = &
                  front%update(row - front%p, column - front%p) + k(i, j)
            end do
         end if
      end do
   end subroutine add_matrix

   !> Eliminate all static fronts, and keep the initial contents of the refactored fronts. FAULT is 0, no_memory, or the first
   !! equation without stiffness.
   subroutine factorise_static(model, tree, fault)
      type(model_type), intent(in)         :: model
      type(front_tree_type), intent(inout) :: tree
      integer, intent(out)                 :: fault
      real(wp) :: no_stiffness(3, 3, 0)
      integer, allocatable :: faults(:)
      integer :: k
      logical :: ok

      call start_record()
      call record_phase('factor')
      call eliminate_fronts(tree, faults, .false., no_stiffness, model)
      fault = first_fault(faults)
      if (fault /= 0) return
      !$omp parallel do schedule(dynamic, 8) default(shared) private(ok) if(tree%is_parallel)
      do k = 1, size(tree%refactored)
         associate (front => tree%fronts(tree%refactored(k)), own_fault => faults(tree%refactored(k)))
            call start_front(model, tree, tree%refactored(k), own_fault)
            if (own_fault /= 0) cycle
            allocate (front%start)
            call keep_block(front%panel, front%start%panel, ok)
            if (ok) call keep_block(front%update, front%start%update, ok)
            if (.not. ok) own_fault = no_memory
            front%start%diagonal = front%diagonal
            deallocate (front%update)
         end associate
      end do
      !$omp end parallel do
      fault = first_fault(faults)
   end subroutine factorise_static

   !> The first fault in the order of elimination, 0: none.
   pure integer function first_fault(faults) result(fault)
      integer, intent(in) :: faults(:)

      fault = 0
      if (any(faults > 0)) fault = minval(faults, mask=faults > 0)
      if (any(faults == no_memory)) fault = no_memory
   end function first_fault

   !> Eliminate all static fronts of MODEL, or all REFACTORED fronts with the stiffnesses K. (K is not optional: tasks would
   !! share an absent array with undefined bounds.)
   subroutine eliminate_fronts(tree, faults, refactored, k, model)
      type(front_tree_type), intent(inout)   :: tree
      integer, allocatable, intent(out)      :: faults(:)  !! (fronts)
      logical, intent(in)                    :: refactored
      real(wp), intent(in)                   :: k(:, :, :) !! of size zero where the fronts are static
      type(model_type), intent(in), optional :: model
      integer, allocatable :: left(:)
      integer :: f

      allocate (faults(size(tree%fronts)), source=0)
      left = tree%fronts%n_children
      !$omp parallel default(shared) if(tree%is_parallel)
      !$omp single
      do f = 1, size(tree%fronts)
         if (.not. tree%fronts(f)%is_start .or. (tree%fronts(f)%is_refactored .neqv. refactored)) cycle
         !$omp task default(shared) firstprivate(f) if(omp_get_num_threads() > 1) final(omp_get_num_threads() == 1)
         call eliminate_upwards(tree, f, left, faults, k, model)
         !$omp end task
      end do
      !$omp end single
      !$omp end parallel
   end subroutine eliminate_fronts

   !> Eliminate the subtree of front START, then the fronts above it up to one that waits for another subtree. The task that brings
   !! the last child eliminates the parent: no task waits for others, and one thread goes through the fronts in their order.
   subroutine eliminate_upwards(tree, start, left, faults, k, model)
      type(front_tree_type), intent(inout)   :: tree
      integer, intent(in)                    :: start
      integer, intent(inout)                 :: left(:)    !! children of every front that are not eliminated
      integer, intent(inout)                 :: faults(:)
      real(wp), intent(in)                   :: k(:, :, :)
      type(model_type), intent(in), optional :: model
      real(wp) :: began
      integer  :: f

      began = task_begins()
      do f = tree%fronts(start)%begin, start - 1
         if (tree%fronts(f)%is_refactored .eqv. tree%fronts(start)%is_refactored) call eliminate_front(tree, f, faults, k, model)
      end do
      if (is_recorded) call record_task(began, 'subtree', key('+', -(start - 1)))
      f = start
      do while (f > 0)
         call eliminate_front(tree, f, faults, k, model)
         call climb(tree, left, f)
      end do
   end subroutine eliminate_upwards

   !> Eliminate front F, whose children are eliminated.
   subroutine eliminate_front(tree, f, faults, k, model)
      type(front_tree_type), intent(inout)   :: tree
      integer, intent(in)                    :: f
      integer, intent(inout)                 :: faults(:)
      real(wp), intent(in)                   :: k(:, :, :)
      type(model_type), intent(in), optional :: model
      real(wp) :: began
      integer  :: i

      associate (front => tree%fronts(f), fault => faults(f))
         fault = first_fault(faults(front%children))
         if (fault /= 0) return
         began = task_begins()
         if (front%is_refactored) then
            call restart_front(tree, f, k, fault)
         else
            call start_front(model, tree, f, fault)
         end if
         if (fault /= 0) return
         tree%diagonal(front%first:front%first + front%p - 1) = front%diagonal(:front%p)
         if (tree%shift > 0.0_wp) then
            call eliminate(front%p, front%r, front%panel, front%update, abs(front%diagonal), pivot_tolerance, fault, front%negative)
         else if (is_tiled(front)) then
            call eliminate_in_tiles(f, front%p, front%r, front%panel, front%update, front%diagonal, pivot_tolerance, fault)
         else
            call eliminate(front%p, front%r, front%panel, front%update, front%diagonal, pivot_tolerance, fault)
         end if
         if (is_recorded .and. .not. is_tiled(front)) call record_task(began, 'front', children_done(front)//key('+', -f))
         if (fault > 0) then
            fault = front%first + fault - 1
         else
            front%weakest = minval([(front%panel(i, i)**2/max(abs(front%diagonal(i)), tiny(1.0_wp)), i = 1, front%p)])
         end if
         if (front%parent == 0) deallocate (front%update)
      end associate
   end subroutine eliminate_front

   !> Assemble FRONT: its elements, and the update matrices of its static children, which are freed.
   subroutine start_front(model, tree, f, fault)
      type(model_type), intent(in)         :: model
      type(front_tree_type), intent(inout) :: tree
      integer, intent(in)                  :: f
      integer, intent(out)                 :: fault !! 0, or no_memory
      character(:), allocatable :: keys
      real(wp), allocatable :: stiffness(:, :)
      real(wp) :: began, time
      integer :: k, status

      associate (front => tree%fronts(f))
         fault = no_memory
         allocate (front%panel(front%p + front%r, front%p), front%update(front%r, front%r), &
                   front%diagonal(front%p + front%r), stat=status)
         if (status /= 0) return
         keys = ''
         if (is_recorded .and. is_tiled(front)) keys = children_done(front)//key('+', f, 1)
         call set_to_zero(front%p + front%r, front%p, front%panel, keys)
         call set_to_zero(front%r, front%r, front%update, keys)
         front%diagonal = 0.0_wp
         began = task_begins()
         time = omp_get_wtime()
         do k = 1, size(front%elements)
            call coupled_dynamic_stiffness(model, front%elements(k), tree%shift, stiffness)
            associate (rows => pack(tree%number(:, nodes_of_unknowns(model%freedoms, front%elements(k))), .true.))
               call add_matrix(front, rows, stiffness(:size(rows), :size(rows)))
            end associate
         end do
         time = omp_get_wtime() - time
         !$omp atomic
         tree%assembly_time = tree%assembly_time + time
         if (is_recorded .and. is_tiled(front)) &
            call record_task(began, 'elements', children_done(front)//key('<', f, 1)//key('>', f, 0)//key('+', f))
      end associate
      call add_children(tree, f, .false.)
      fault = 0
   end subroutine start_front

   !> Eliminate all refactored fronts, with the stiffnesses K of the interface elements. FAULT as above.
   subroutine factorise_refactored(tree, k, fault)
      type(front_tree_type), intent(inout) :: tree
      real(wp), intent(in)                 :: k(:, :, :) !! (3, 3, n) between their ends, global axes [force/length]
      integer, intent(out)                 :: fault
      integer, allocatable :: faults(:)
      integer :: f, i

      call record_phase('increments')
      call eliminate_fronts(tree, faults, .true., k)
      fault = first_fault(faults)
      if (fault == 0) return
      do i = 1, size(tree%refactored)
         f = tree%refactored(i)
         if (allocated(tree%fronts(f)%update)) deallocate (tree%fronts(f)%update)
      end do
   end subroutine factorise_refactored

   !> Assemble refactored FRONT in an increment: what was kept, its interface elements, and the update matrices of its
   !! refactored children.
   subroutine restart_front(tree, f, k, fault)
      type(front_tree_type), intent(inout) :: tree
      integer, intent(in)                  :: f
      real(wp), intent(in)                 :: k(:, :, :)
      integer, intent(out)                 :: fault !! 0, or no_memory
      character(:), allocatable :: keys
      real(wp) :: began
      integer  :: c, i, j, status

      associate (front => tree%fronts(f))
         allocate (front%update(front%r, front%r), stat=status)
         fault = merge(0, no_memory, status == 0)
         if (fault /= 0) return
         keys = ''
         if (is_recorded .and. is_tiled(front)) keys = children_done(front)//key('+', f, 1)
         call restore_block(front%start%panel, front%panel, keys)
         call restore_block(front%start%update, front%update, keys)
         began = task_begins()
         front%diagonal = front%start%diagonal
         do i = 1, size(front%springs)
            c = front%springs(i)
            call add_matrix(front, tree%joints%rows_of(c), tree%joints%matrix_of(c, k(:, :, c)))
         end do
         if (is_recorded .and. is_tiled(front)) call record_task(began, 'springs', key('<', f, 1)//key('>', f, 0)//key('+', f))
         call add_children(tree, f, .true.)
         do j = 1, front%p                    ! rows and columns of locked pivots become those of the identity
            if (.not. tree%locked(front%first + j - 1)) cycle
            front%panel(j, :j - 1) = 0.0_wp
            front%panel(j:, j) = 0.0_wp
            front%panel(j, j) = 1.0_wp
            front%diagonal(j) = 1.0_wp
         end do
      end associate
   end subroutine restart_front

   !> Add the symmetric matrix K to refactored fronts permanently. Its EQUATIONS (0: held; others distinct) belong to these.
   subroutine add_to_refactored(tree, equations, k)
      type(front_tree_type), intent(inout) :: tree
      integer, intent(in)                  :: equations(:)
      real(wp), intent(in)                 :: k(:, :)
      integer, allocatable :: order(:), places(:)
      integer :: f, i, n

      f = front_of(tree, equations)
      if (f == 0) return
      associate (front => tree%fronts(f))
         places = place_in(front, equations)
         call sorted_order(places, order)
         order = pack(order, places(order) > 0)
         places = places(order)
         n = count(places <= front%p)
         do i = 1, size(places)
            front%start%diagonal(places(i)) = front%start%diagonal(places(i)) + k(order(i), order(i))
         end do
         call add_to_block(front%start%panel, places, places(:n), k(order, order(:n)))
         call add_to_block(front%start%update, places(n + 1:) - front%p, places(n + 1:) - front%p, k(order(n + 1:), order(n + 1:)))
      end associate
   end subroutine add_to_refactored

end module front_factor
