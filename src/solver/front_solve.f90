!> Forward and back substitution in a tree of fronts factorised by front_factor: L y = b, L^T x = y. Static and refactored
!! fronts are solved separately, as the increments need. A factor with signs, L S L^T, has S L^T x = y.
!!
!! Independent subtrees are tasks of OpenMP. On the way up every front keeps its contributions to the rows beyond until its
!! parent adds those of all its children in their order: no digit depends on the number of threads.
module front_solve
   use blas_lapack, only: dgemv, dtrmv
   use front_tree, only: climb, front_tree_type, front_type, task_entries
   use front_assembly, only: children_done, is_tiled
   use front_kernel, only: substitute, substitute_back, substitute_columns, substitute_columns_back
   use front_tiles, only: substitute_in_tiles
   use kept_blocks, only: block_times_vector
   use kinds, only: wp
   use omp_lib, only: omp_get_num_threads
   use task_record, only: is_recorded, key, record_phase, record_task, task_begins
   implicit none
   private

   integer, parameter :: together = 5   ! columns that are solved at once, whatever the number of threads
   integer, parameter :: more_together = 10 ! in the refactored fronts alone

   public :: sweep, solve_refactored, solve_columns, refactored_times_vector, factor_times_vector

contains

   !> Solve for the refactored equations; X is not changed on the others.
   subroutine solve_refactored(tree, x)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(inout)           :: x(tree%n)

      call sweep(tree, .true., .true., x)
      call sweep(tree, .true., .false., x)
   end subroutine solve_refactored

   !> L y = x (UP), or L^T x = y with X known beyond, in the REFACTORED or the static fronts. UP the static fronts the loads X on
   !! all equations are condensed on the refactored ones; down, the displacements of the bodies are recovered from y in the static
   !! fronts and the solution in the refactored ones, in those FOLLOWED only.
   subroutine sweep(tree, refactored, up, x, followed)
      type(front_tree_type), intent(in) :: tree
      logical, intent(in)               :: refactored, up
      real(wp), intent(inout)           :: x(tree%n)
      logical, intent(in), optional     :: followed        !! false: all

      call sweep_columns(tree, refactored, up, 1, x, followed)
   end subroutine sweep

   !> The same for M columns of X.
   subroutine sweep_columns(tree, refactored, up, m, x, followed)
      type(front_tree_type), intent(in) :: tree
      logical, intent(in)               :: refactored, up
      integer, intent(in)               :: m
      real(wp), intent(inout)           :: x(tree%n, m)
      logical, intent(in), optional     :: followed
      real(wp), allocatable :: left(:, :)  ! contributions of fronts to the rows beyond
      integer, allocatable  :: list(:)     ! fronts of this kind, and maybe others
      integer, allocatable  :: waiting(:)  ! children of every front that are not done
      integer, allocatable  :: done(:)     ! marks of the fronts, 0: of no front
      integer :: f, k
      logical :: all_fronts

      all_fronts = .true.
      if (present(followed)) all_fronts = .not. followed
      if (refactored) then
         allocate (list, source=tree%refactored)
      else if (.not. all_fronts) then
         allocate (list, source=tree%followed)
      else
         allocate (list, source=[(f, f = 1, size(tree%fronts))])
      end if
      allocate (left(merge(tree%n_left, 0, up), m), done(0:size(tree%fronts)))
      if (up) waiting = tree%fronts%n_children
      call record_phase(trim(merge('increments', 'bodies    ', refactored)))
      !$omp parallel default(shared) if(tree%is_parallel)
      !$omp single
      do k = merge(1, size(list), up), merge(size(list), 1, up), merge(1, -1, up)
         f = list(k)
         associate (front => tree%fronts(f))
            if (front%is_refactored .neqv. refactored) cycle
            if (up) then
               if (.not. front%starts_sweep) cycle
               !$omp task default(shared) firstprivate(f) if(omp_get_num_threads() > 1) final(omp_get_num_threads() == 1)
               call forward_from(tree, f, m, waiting, x, left)
               !$omp end task
            else
               if (front%entries <= task_entries .and. .not. front%starts_sweep) cycle ! part of the task of a front above it
               !$omp task default(shared) firstprivate(f) if(omp_get_num_threads() > 1) final(omp_get_num_threads() == 1) &
               !$omp depend(in: done(merge(0, front%parent, front%is_top))) depend(out: done(f))
               call backward_from(tree, f, m, all_fronts, x)
               !$omp end task
            end if
         end associate
      end do
      !$omp end single
      !$omp end parallel
      if (refactored .or. .not. up) return
      do f = 1, size(tree%fronts)
         if (.not. tree%fronts(f)%is_top .or. tree%fronts(f)%is_refactored) cycle
         associate (front => tree%fronts(f))
            x(front%rows, :) = x(front%rows, :) + left(front%left + 1:front%left + front%r, :)
         end associate
      end do
   end subroutine sweep_columns

   !> The subtree of front START, then the fronts above it up to one that waits for another subtree.
   subroutine forward_from(tree, start, m, waiting, x, left)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: start, m
      integer, intent(inout)            :: waiting(:)
      real(wp), intent(inout)           :: x(tree%n, m), left(:, :)
      real(wp) :: began
      integer  :: f

      began = task_begins()
      do f = tree%fronts(start)%begin, start - 1
         if (tree%fronts(f)%is_refactored .eqv. tree%fronts(start)%is_refactored) call forward(tree, f, m, x, left)
      end do
      f = start
      do while (f > 0)
         call forward(tree, f, m, x, left)
         if (is_recorded .and. .not. has_tiles(tree%fronts(f), m)) &
            call record_task(began, 'forward', children_done(tree%fronts(f))//key('+', -f))
         began = task_begins()
         call climb(tree, waiting, f)
      end do
   end subroutine forward_from

   !> Front F, and its subtree where that is one task.
   subroutine backward_from(tree, f, m, all_fronts, x)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: f, m
      logical, intent(in)               :: all_fronts !! or only those that are followed
      real(wp), intent(inout)           :: x(tree%n, m)
      real(wp) :: began
      integer  :: g

      began = task_begins()
      do g = f, merge(f, tree%fronts(f)%begin, tree%fronts(f)%entries > task_entries), -1
         if (tree%fronts(g)%is_refactored .neqv. tree%fronts(f)%is_refactored) cycle
         if (all_fronts .or. tree%fronts(g)%is_followed) call backward(tree, g, m, x)
      end do
      if (is_recorded .and. .not. has_tiles(tree%fronts(f), m)) &
         call record_task(began, 'backward', key('<', tree%fronts(f)%parent)//key('+', f))
   end subroutine backward_from

   !> Whether the substitution in FRONT is done in tiles: one column only.
   pure logical function has_tiles(front, m)
      type(front_type), intent(in) :: front
      integer, intent(in)          :: m

      has_tiles = m == 1 .and. is_tiled(front)
   end function has_tiles

   !> L y = x in front F, from M columns of X and the contributions LEFT by its children. The contributions of F are left likewise.
   subroutine forward(tree, f, m, x, left)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: f, m
      real(wp), intent(inout)           :: x(tree%n, m), left(:, :)
      real(wp), allocatable :: w(:, :) ! pivots, rows beyond
      real(wp) :: began
      integer  :: c, i

      began = task_begins()
      associate (front => tree%fronts(f), p => tree%fronts(f)%p, r => tree%fronts(f)%r, first => tree%fronts(f)%first)
         allocate (w(p + r, m))
         w(:p, :) = x(first:first + p - 1, :)
         w(p + 1:, :) = 0.0_wp
         do i = 1, size(front%children)
            associate (child => tree%fronts(front%children(i)))
               if (child%is_refactored .neqv. front%is_refactored) cycle
               do c = 1, m
                  w(child%in_parent, c) = w(child%in_parent, c) + left(child%left + 1:child%left + child%r, c)
               end do
            end associate
         end do
         do c = 1, m
            where (tree%locked(first:first + p - 1)) w(:p, c) = 0.0_wp
         end do
         if (any(abs(w(:p, :)) > 0.0_wp)) then ! loads act on few fronts and their ancestors
            if (has_tiles(front, m)) then
               if (is_recorded) call record_task(began, 'gather', children_done(front)//key('>', f, 0)//key('+', f))
               call substitute_in_tiles(f, p + r, p, front%panel, w, back=.false.)
               began = task_begins()
            else if (m == 1) then
               call substitute(p + r, p, front%panel, w)
            else
               call substitute_columns(p + r, p, m, front%panel, w)
            end if
         end if
         x(first:first + p - 1, :) = w(:p, :)
         left(front%left + 1:front%left + r, :) = w(p + 1:, :)
         if (is_recorded .and. has_tiles(front, m)) call record_task(began, 'scatter', key('<', f)//key('+', -f))
      end associate
   end subroutine forward

   !> L^T x = y in front F, M columns of X known in the rows beyond.
   subroutine backward(tree, f, m, x)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: f, m
      real(wp), intent(inout)           :: x(tree%n, m)
      real(wp), allocatable :: w(:, :) ! pivots, rows beyond
      real(wp) :: began
      integer  :: c

      began = task_begins()
      associate (front => tree%fronts(f), first => tree%fronts(f)%first, p => tree%fronts(f)%p, n => tree%fronts(f)%p + &
                                                                                                     tree%fronts(f)%r)
         allocate (w(n, m))
         do c = 1, m
            call apply_signs(front, x(:, c))
            w(:p, c) = x(first:first + p - 1, c)
            w(p + 1:, c) = x(front%rows, c)
         end do
         if (has_tiles(front, m)) then
            if (is_recorded) call record_task(began, 'gather', key('<', front%parent)//key('>', f, 0)//key('+', f))
            call substitute_in_tiles(f, n, p, front%panel, w, back=.true.)
         else if (m == 1) then
            call substitute_back(n, p, front%panel, w)
         else
            call substitute_columns_back(n, p, m, front%panel, w)
         end if
         x(first:first + p - 1, :) = w(:p, :)
      end associate
   end subroutine backward

   !> S of FRONT times X at its pivots.
   pure subroutine apply_signs(front, x)
      type(front_type), intent(in) :: front
      real(wp), intent(inout)      :: x(:)

      if (.not. allocated(front%negative)) return
      associate (places => front%first - 1 + front%negative)
         x(places) = -x(places)
      end associate
   end subroutine apply_signs

   !> Y = [k_b] X on the refactored equations, [k_b] condensed on them, without interface elements; other entries of Y are not
   !! changed.
   subroutine refactored_times_vector(tree, x, y)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(in)              :: x(tree%n)
      real(wp), intent(inout)           :: y(tree%n)
      real(wp), allocatable :: x_f(:), y_f(:)      ! pivots, rows beyond
      real(wp), allocatable :: own(:), left(:)     ! products in the pivots, in the rows beyond
      integer :: k

      allocate (own(tree%n), left(tree%n_left))
      !$omp parallel do schedule(dynamic, 2) default(shared) private(x_f, y_f) if(tree%is_parallel)
      do k = size(tree%refactored), 1, -1 ! the largest are among the last
         associate (front => tree%fronts(tree%refactored(k)), p => tree%fronts(tree%refactored(k))%p)
            x_f = [x(front%first:front%first + p - 1), x(front%rows)]
            allocate (y_f(p + front%r), source=0.0_wp)
            call block_times_vector(front%start%panel, x_f, y_f)
            call block_times_vector(front%start%update, x_f(p + 1:), y_f(p + 1:))
            own(front%first:front%first + p - 1) = y_f(:p)
            left(front%left + 1:front%left + front%r) = y_f(p + 1:)
            deallocate (y_f)
         end associate
      end do
      !$omp end parallel do
      y(tree%equations) = 0.0_wp
      do k = 1, size(tree%refactored)
         associate (front => tree%fronts(tree%refactored(k)))
            associate (last => front%first + front%p - 1)
               y(front%first:last) = y(front%first:last) + own(front%first:last)
            end associate
            y(front%rows) = y(front%rows) + left(front%left + 1:front%left + front%r)
         end associate
      end do
   end subroutine refactored_times_vector

   !> [L S L^T]^-1 X on all equations, or on the REFACTORED ones alone, for the columns of X, zero where locked. The panel of a front
   !! is read once for several columns.
   subroutine solve_columns(tree, refactored, x)
      type(front_tree_type), intent(in)   :: tree
      logical, intent(in)                 :: refactored
      real(wp), contiguous, intent(inout) :: x(:, :) !! (n, columns)
      integer :: at_once, c, last, m

      at_once = merge(more_together, together, refactored)
      do c = 1, size(x, 2), at_once
         last = min(size(x, 2), c + at_once - 1)
         m = last - c + 1
         if (tree%is_parallel) then
            if (.not. refactored) call sweep_columns(tree, .false., .true., m, x(:, c:last))
            call sweep_columns(tree, .true., .true., m, x(:, c:last))
            call sweep_columns(tree, .true., .false., m, x(:, c:last))
            if (.not. refactored) call sweep_columns(tree, .false., .false., m, x(:, c:last))
         else
            call solve_alone(tree, refactored, m, x(:, c:last))
         end if
      end do
   end subroutine solve_columns

   !> The same for M columns of a small model, by one thread: each front adds to the rows beyond at once.
   subroutine solve_alone(tree, refactored, m, x)
      type(front_tree_type), intent(in) :: tree
      logical, intent(in)               :: refactored
      integer, intent(in)               :: m
      real(wp), intent(inout)           :: x(tree%n, m)
      real(wp), allocatable :: w(:, :) ! pivots, rows beyond
      integer :: c, f

      do f = 1, size(tree%fronts)
         associate (front => tree%fronts(f), p => tree%fronts(f)%p, first => tree%fronts(f)%first)
            if (refactored .and. .not. front%is_refactored) cycle
            allocate (w(p + front%r, m))
            do c = 1, m
               w(:, c) = [merge(0.0_wp, x(first:first + p - 1, c), tree%locked(first:first + p - 1)), x(front%rows, c)]
            end do
            call substitute_columns(p + front%r, p, m, front%panel, w)
            x(first:first + p - 1, :) = w(:p, :)
            x(front%rows, :) = w(p + 1:, :)
            deallocate (w)
         end associate
      end do
      do f = size(tree%fronts), 1, -1
         if (refactored .and. .not. tree%fronts(f)%is_refactored) cycle
         call backward(tree, f, m, x)
      end do
   end subroutine solve_alone

   !> X = L S L^T X on all equations, zero where locked: the product with the factorised matrix.
   subroutine factor_times_vector(tree, x)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(inout)           :: x(tree%n)
      real(wp) :: work(tree%most_rows)
      integer  :: f

      where (tree%locked) x = 0.0_wp
      do f = 1, size(tree%fronts) ! L^T x: the rows beyond belong to later fronts
         associate (front => tree%fronts(f), p => tree%fronts(f)%p, r => tree%fronts(f)%r, first => tree%fronts(f)%first)
            call dtrmv('L', 'T', 'N', p, front%panel, p + r, x(first), 1)
            work(:r) = x(front%rows)
            if (r > 0) call dgemv('T', r, p, 1.0_wp, front%panel(p + 1, 1), p + r, work, 1, 1.0_wp, x(first), 1)
            call apply_signs(front, x)
         end associate
      end do
      do f = size(tree%fronts), 1, -1
         associate (front => tree%fronts(f), p => tree%fronts(f)%p, r => tree%fronts(f)%r, first => tree%fronts(f)%first)
            if (r > 0) call dgemv('N', r, p, 1.0_wp, front%panel(p + 1, 1), p + r, x(first), 1, 0.0_wp, work, 1)
            x(front%rows) = x(front%rows) + work(:r)
            call dtrmv('L', 'N', 'N', p, front%panel, p + r, x(first), 1)
         end associate
      end do
      where (tree%locked) x = 0.0_wp
   end subroutine factor_times_vector

end module front_solve
