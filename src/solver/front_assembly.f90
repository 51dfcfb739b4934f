!> Assembly of a front from its children: extend-add of their update matrices. Strips of columns of a large front are tasks of
!! OpenMP. Every entry has its additions in one order, whatever the number of threads.
module front_assembly
   use front_kernel, only: large, top_row
   use front_tiles, only: tiled_rows
   use front_tree, only: front_tree_type, front_type
   use kept_blocks, only: strip
   use kinds, only: long, wp
   use machine, only: give_back
   use task_record, only: is_recorded, key, record_task, task_begins
   implicit none
   private

   public :: add_children, children_done, is_tiled, set_to_zero

contains

   !> Whether FRONT is so large that its parts are tasks.
   pure logical function is_tiled(front)
      type(front_type), intent(in) :: front

      is_tiled = front%p + front%r >= tiled_rows
   end function is_tiled

   !> The keys by which the tasks of FRONT wait for its children, of a record.
   pure function children_done(front) result(keys)
      type(front_type), intent(in) :: front
      character(:), allocatable :: keys
      integer :: i

      keys = ''
      do i = 1, size(front%children)
         keys = keys//key('<', -front%children(i))
      end do
   end function children_done

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

   !> Add the update matrices of the static or REFACTORED children of front F, and free them. Strips of columns of a large front are
   !! tasks. What a strip has taken of a large matrix is given back at once: child and front together never take much more memory
   !! than one of them.
   subroutine add_children(tree, f, refactored)
      type(front_tree_type), intent(inout) :: tree
      integer, intent(in)                  :: f
      logical, intent(in)                  :: refactored
      integer :: k, n, until, width

      n = tree%fronts(f)%p + tree%fronts(f)%r
      width = merge(strip, n, is_tiled(tree%fronts(f)))
      do until = width, n + width - 1, width
         !$omp task default(shared) firstprivate(until) if(n >= tiled_rows)
         call add_strip(until - width + 1, until)
         !$omp end task
      end do
      !$omp taskwait
      do k = 1, size(tree%fronts(f)%children)
         associate (child => tree%fronts(tree%fronts(f)%children(k)))
            if (child%is_refactored .neqv. refactored) cycle
            deallocate (child%update)
            if (.not. refactored) deallocate (child%diagonal)
         end associate
      end do

   contains

      !> Add to the columns FROM to UNTIL of the front.
      subroutine add_strip(from, until)
         integer, intent(in) :: from, until
         real(wp) :: began
         integer(long) :: begin, end
         integer :: first, k, last
         logical :: ok

         began = task_begins()
         do k = 1, size(tree%fronts(f)%children)
            associate (child => tree%fronts(tree%fronts(f)%children(k)))
               if (child%is_refactored .neqv. refactored) cycle
               first = count(child%in_parent < from) + 1
               last = count(child%in_parent <= until)
               if (first > last) cycle
               call add_update(child, tree%fronts(f), first, last)
               if (size(child%update, kind=long) >= large .and. .not. refactored) &
                  call give_back(int(child%r, long)*(last - first + 1), child%update(1, first), ok, begin, end)
            end associate
         end do
         if (is_recorded .and. is_tiled(tree%fronts(f))) call record_task(began, 'add', key('<', f, 0)//key('+', f))
      end subroutine add_strip

   end subroutine add_children

   !> Set to zero what the kernel touches. The pages of a large matrix are given back instead; they read as zero when they
   !! return. Their memory is taken when they are written, see start_front.
   subroutine set_to_zero(m, n, a, keys)
      integer, intent(in)     :: m, n
      real(wp), intent(inout) :: a(int(m, long)*n) !! (m, n), column by column
      character(*), intent(in) :: keys             !! of a record
      real(wp) :: began
      integer(long) :: first, last
      integer :: i, j
      logical :: ok

      if (size(a, kind=long) >= large) then
         call give_back(size(a, kind=long), a, ok, first, last)
         if (ok) then
            a(:first) = 0.0_wp
            a(last:) = 0.0_wp
            return
         end if
      end if
      do j = 1, n, strip
         !$omp task default(shared) firstprivate(j) private(began, i) if(m >= tiled_rows)
         began = task_begins()
         do i = j, min(n, j + strip - 1)
            a(int(m, long)*(i - 1) + top_row(i):int(m, long)*i) = 0.0_wp
         end do
         if (is_recorded .and. len(keys) > 0) call record_task(began, 'zero', keys)
         !$omp end task
      end do
      !$omp taskwait
   end subroutine set_to_zero

end module front_assembly
