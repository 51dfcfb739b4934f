!> Factorisation in a tree of fronts: static fronts once, the others in every increment. Independent subtrees are tasks of
!! OpenMP. Every addition has its place in one order, whatever the number of threads.
module front_factor
   use element_unknowns, only: nodes_of_unknowns
   use equation_solver, only: no_memory
   use front_kernel, only: eliminate, large, top_row
   use front_tree, only: add_to_block, front_of, front_tree_type, front_type, keep_block, place_in, restore_block, task_work
   use kinds, only: long, wp
   use lists, only: sorted_order
   use machine, only: give_back
   use mass_matrix, only: coupled_dynamic_stiffness
   use model_data, only: model_type
   use omp_lib, only: omp_get_wtime
   use tolerances, only: pivot_tolerance
   implicit none
   private

   public :: factorise_static, factorise_refactored, add_to_refactored

   integer, parameter  :: strip = 128                  ! columns whose memory is given back together

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

   !> Add columns FROM to UNTIL of the update matrix of CHILD to FRONT.
   pure subroutine add_update(child, front, from, until)
      type(front_type), intent(in)    :: child
      type(front_type), intent(inout) :: front
      integer, intent(in)             :: from, until
      integer :: column, first, i, j, k, last, row, run_at

      run_at = 1                                     ! the run that contains column J
      do j = from, until
         do while (j >= child%run(run_at + 1))
            run_at = run_at + 1
         end do
         column = child%in_parent(j)
         front%diagonal(column) = front%diagonal(column) + child%diagonal(child%p + j)
         do k = run_at, size(child%run) - 1
            first = max(j, child%run(k))
            last = child%run(k + 1) - 1
            row = child%in_parent(first)
            if (column <= front%p) then
               !$omp simd
               do i = 0, last - first
                  front%panel(row + i, column) = front%panel(row + i, column) + child%update(first + i, j)
               end do
            else
               row = row - front%p
               !$omp simd
               do i = 0, last - first
                  front%update(row + i, column - front%p) = front%update(row + i, column - front%p) + child%update(first + i, j)
               end do
            end if
         end do
      end do
   end subroutine add_update

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

      call eliminate_fronts(tree, faults, .false., no_stiffness, model)
      fault = first_fault(faults)
      if (fault /= 0) return
      !$omp parallel do schedule(dynamic, 8) default(shared) private(ok) if(tree%is_parallel)
      do k = 1, size(tree%refactored)
         associate (front => tree%fronts(tree%refactored(k)), own_fault => faults(tree%refactored(k)))
            call start_front(model, tree, front, own_fault)
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
      integer :: f

      allocate (faults(size(tree%fronts)), source=0)
      !$omp parallel default(shared) if(tree%is_parallel)
      !$omp single
      do f = 1, size(tree%fronts)
         if (.not. tree%fronts(f)%is_top .or. (tree%fronts(f)%is_refactored .neqv. refactored)) cycle
         !$omp task default(shared) firstprivate(f) if(tree%fronts(f)%work > task_work)
         call eliminate_subtree(tree, f, faults, k, model)
         !$omp end task
      end do
      !$omp end single
      !$omp end parallel
   end subroutine eliminate_fronts

   !> Eliminate front F after the fronts of its subtree of the same kind, refactored or static.
   recursive subroutine eliminate_subtree(tree, f, faults, k, model)
      type(front_tree_type), intent(inout)   :: tree
      integer, intent(in)                    :: f
      integer, intent(inout)                 :: faults(:)
      real(wp), intent(in)                   :: k(:, :, :)
      type(model_type), intent(in), optional :: model
      integer :: c, i

      do i = 1, size(tree%fronts(f)%children)
         c = tree%fronts(f)%children(i)
         if (tree%fronts(c)%is_refactored .neqv. tree%fronts(f)%is_refactored) cycle
         !$omp task default(shared) firstprivate(c) if(tree%fronts(c)%work > task_work)
         call eliminate_subtree(tree, c, faults, k, model)
         !$omp end task
      end do
      !$omp taskwait
      associate (front => tree%fronts(f), fault => faults(f))
         fault = first_fault(faults(front%children))
         if (fault /= 0) return
         if (front%is_refactored) then
            call restart_front(tree, front, k, fault)
         else
            call start_front(model, tree, front, fault)
         end if
         if (fault /= 0) return
         tree%diagonal(front%first:front%first + front%p - 1) = front%diagonal(:front%p)
         if (tree%shift > 0.0_wp) then
            call eliminate(front%p, front%r, front%panel, front%update, abs(front%diagonal), pivot_tolerance, fault, front%negative)
         else
            call eliminate(front%p, front%r, front%panel, front%update, front%diagonal, pivot_tolerance, fault)
         end if
         if (fault > 0) then
            fault = front%first + fault - 1
         else
            front%weakest = minval([(front%panel(i, i)**2/max(abs(front%diagonal(i)), tiny(1.0_wp)), i = 1, front%p)])
         end if
         if (front%parent == 0) deallocate (front%update)
      end associate
   end subroutine eliminate_subtree

   !> Assemble FRONT: its elements, and the update matrices of its static children, which are freed.
   subroutine start_front(model, tree, front, fault)
      type(model_type), intent(in)         :: model
      type(front_tree_type), intent(inout) :: tree
      type(front_type), intent(inout)      :: front
      integer, intent(out)                 :: fault !! 0, or no_memory
      real(wp), allocatable :: stiffness(:, :)
      real(wp) :: time
      integer(long) :: first, last
      integer :: j, k, status, until
      logical :: ok

      fault = no_memory
      allocate (front%panel(front%p + front%r, front%p), front%update(front%r, front%r), &
                front%diagonal(front%p + front%r), stat=status)
      if (status /= 0) return
      call set_to_zero(front%p + front%r, front%p, front%panel)
      call set_to_zero(front%r, front%r, front%update)
      front%diagonal = 0.0_wp
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
      do k = 1, size(front%children)
         associate (child => tree%fronts(front%children(k)))
            if (child%is_refactored) cycle
            if (size(child%update, kind=long) < large) then
               call add_update(child, front, 1, child%r)
            else           ! freed strip by strip: child and front together never take much more memory than one of them
               do j = 1, child%r, strip
                  until = min(child%r, j + strip - 1)
                  call add_update(child, front, j, until)
                  call give_back(int(child%r, long)*(until - j + 1), child%update(1, j), ok, first, last)
               end do
            end if
            deallocate (child%update, child%diagonal)
         end associate
      end do
      fault = 0
   end subroutine start_front

   !> Set to zero what the kernel touches. The pages of a large matrix are given back instead; they read as zero when they
   !! return. Their memory is taken when they are written, see start_front.
   subroutine set_to_zero(m, n, a)
      integer, intent(in)     :: m, n
      real(wp), intent(inout) :: a(int(m, long)*n) !! (m, n), column by column
      integer(long) :: first, last
      integer :: j
      logical :: ok

      if (size(a, kind=long) >= large) then
         call give_back(size(a, kind=long), a, ok, first, last)
         if (ok) then
            a(:first) = 0.0_wp
            a(last:) = 0.0_wp
            return
         end if
      end if
      do j = 1, n
         a(int(m, long)*(j - 1) + top_row(j):int(m, long)*j) = 0.0_wp
      end do
   end subroutine set_to_zero

   !> Eliminate all refactored fronts, with the stiffnesses K of the interface elements. FAULT as above.
   subroutine factorise_refactored(tree, k, fault)
      type(front_tree_type), intent(inout) :: tree
      real(wp), intent(in)                 :: k(:, :, :) !! (3, 3, n) between their ends, global axes [force/length]
      integer, intent(out)                 :: fault
      integer, allocatable :: faults(:)
      integer :: f, i

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
   subroutine restart_front(tree, front, k, fault)
      type(front_tree_type), intent(inout) :: tree
      type(front_type), intent(inout)      :: front
      real(wp), intent(in)                 :: k(:, :, :)
      integer, intent(out)                 :: fault !! 0, or no_memory
      integer :: c, i, j, status

      allocate (front%update(front%r, front%r), stat=status)
      fault = merge(0, no_memory, status == 0)
      if (fault /= 0) return
      call restore_block(front%start%panel, front%panel)
      call restore_block(front%start%update, front%update)
      front%diagonal = front%start%diagonal
      do i = 1, size(front%springs)
         c = front%springs(i)
         call add_matrix(front, tree%joints%rows_of(c), tree%joints%matrix_of(c, k(:, :, c)))
      end do
      do i = 1, size(front%children)
         c = front%children(i)
         if (.not. tree%fronts(c)%is_refactored) cycle
         call add_update(tree%fronts(c), front, 1, tree%fronts(c)%r)
         deallocate (tree%fronts(c)%update)
      end do
      do j = 1, front%p                    ! rows and columns of locked pivots become those of the identity
         if (.not. tree%locked(front%first + j - 1)) cycle
         front%panel(j, :j - 1) = 0.0_wp
         front%panel(j:, j) = 0.0_wp
         front%panel(j, j) = 1.0_wp
         front%diagonal(j) = 1.0_wp
      end do
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
