!> Right-hand sides and solutions in a tree of fronts, factorised by front_factor: L y = b, L^T x = y, in the two parts that the
!! increments need, the fronts that do not move and those that do. A factor with signs, L S L^T, has S L^T x = y.
module front_solve
   use blas_lapack, only: dgemv, dtrmv, dtrsv
   use front_blocks, only: block_times_vector
   use front_tree, only: front_tree_type, front_type
   use kinds, only: wp
   implicit none
   private

   public :: eliminate_fixed, recover_fixed, solve_moving, moving_times_vector, factor_times_vector

   real(wp), parameter :: task_work = 2.0e6_wp ! operations of the factorisation of a subtree that is worth a task

contains

   !> Carry X, loads on all equations, over to the equations that move: L y = x on the fronts that do not move. There X is y then.
   subroutine eliminate_fixed(tree, x)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(inout)           :: x(tree%n)
      real(wp) :: work(tree%most_rows)
      integer  :: f

      do f = 1, size(tree%fronts)
         if (.not. tree%fronts(f)%moves) call forward(tree, f, x, work)
      end do
   end subroutine eliminate_fixed

   !> The other way: X holds y of eliminate_fixed on the fronts that do not move and the solution on those that do; it is the
   !! solution everywhere then. Independent subtrees are tasks of OpenMP.
   subroutine recover_fixed(tree, x)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(inout)           :: x(tree%n)
      integer :: f
      logical :: begins

      !$omp parallel default(shared) private(begins) if(tree%is_parallel)
      !$omp single
      do f = size(tree%fronts), 1, -1
         begins = .not. tree%fronts(f)%moves
         if (begins .and. tree%fronts(f)%parent > 0) begins = tree%fronts(tree%fronts(f)%parent)%moves
         if (.not. begins) cycle
         !$omp task default(shared) firstprivate(f) if(tree%fronts(f)%work > task_work)
         call recover_subtree(tree, f, x)
         !$omp end task
      end do
      !$omp end single
      !$omp end parallel
   end subroutine recover_fixed

   !> Front F, then those of its subtree.
   recursive subroutine recover_subtree(tree, f, x)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: f
      real(wp), intent(inout)           :: x(tree%n)
      real(wp), allocatable :: work(:)
      integer :: c, i

      allocate (work(tree%fronts(f)%r))
      call backward(tree, f, x, work)
      deallocate (work)
      do i = 1, size(tree%fronts(f)%children)
         c = tree%fronts(f)%children(i)
         !$omp task default(shared) firstprivate(c) if(tree%fronts(c)%work > task_work)
         call recover_subtree(tree, c, x)
         !$omp end task
      end do
      !$omp taskwait
   end subroutine recover_subtree

   !> Solve for the equations that move; X is not touched on the others.
   subroutine solve_moving(tree, x)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(inout)           :: x(tree%n)
      real(wp) :: work(tree%most_rows)
      integer  :: k

      do k = 1, size(tree%moving)
         call forward(tree, tree%moving(k), x, work)
      end do
      do k = size(tree%moving), 1, -1
         call backward(tree, tree%moving(k), x, work)
      end do
   end subroutine solve_moving

   !> L y = x in front F, and what y does to the rows beyond.
   subroutine forward(tree, f, x, work)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: f
      real(wp), intent(inout)           :: x(tree%n)
      real(wp), intent(out)             :: work(:)
      integer :: i

      associate (front => tree%fronts(f), p => tree%fronts(f)%p, r => tree%fronts(f)%r, first => tree%fronts(f)%first)
         where (tree%locked(first:first + p - 1)) x(first:first + p - 1) = 0.0_wp
         if (all(abs(x(first:first + p - 1)) <= 0.0_wp)) return ! loads act on few fronts, and on those above them
         call dtrsv('L', 'N', 'N', p, front%panel, p + r, x(first), 1)
         if (r == 0) return
         call dgemv('N', r, p, -1.0_wp, front%panel(p + 1, 1), p + r, x(first), 1, 0.0_wp, work, 1)
         do i = 1, r
            x(front%rows(i)) = x(front%rows(i)) + work(i)
         end do
      end associate
   end subroutine forward

   !> L^T x = y in front F, x known in the rows beyond.
   subroutine backward(tree, f, x, work)
      type(front_tree_type), intent(in) :: tree
      integer, intent(in)               :: f
      real(wp), intent(inout)           :: x(tree%n)
      real(wp), intent(out)             :: work(:)

      associate (front => tree%fronts(f), p => tree%fronts(f)%p, r => tree%fronts(f)%r, first => tree%fronts(f)%first)
         call apply_signs(front, x)
         work(:r) = x(front%rows)
         if (r > 0) call dgemv('T', r, p, -1.0_wp, front%panel(p + 1, 1), p + r, work, 1, 1.0_wp, x(first), 1)
         call dtrsv('L', 'T', 'N', p, front%panel, p + r, x(first), 1)
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

   !> Y = [k_b] X on the equations that move, the others condensed into it, interface elements left out; Y is not touched on them.
   subroutine moving_times_vector(tree, x, y)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(in)              :: x(tree%n)
      real(wp), intent(inout)           :: y(tree%n)
      real(wp) :: x_f(tree%most_rows), y_f(tree%most_rows)
      integer  :: i, k

      do k = 1, size(tree%moving)
         associate (front => tree%fronts(tree%moving(k)))
            y(front%first:front%first + front%p - 1) = 0.0_wp
         end associate
      end do
      do k = 1, size(tree%moving)
         associate (front => tree%fronts(tree%moving(k)))
            associate (p => front%p, last => front%first + front%p - 1)
               x_f(:p) = x(front%first:last)
               x_f(p + 1:p + front%r) = x(front%rows)
               y_f(:p + front%r) = 0.0_wp
               call block_times_vector(front%start%panel, x_f, y_f)
               call block_times_vector(front%start%update, x_f(p + 1:), y_f(p + 1:))
               y(front%first:last) = y(front%first:last) + y_f(:p)
               do i = 1, front%r
                  y(front%rows(i)) = y(front%rows(i)) + y_f(p + i)
               end do
            end associate
         end associate
      end do
   end subroutine moving_times_vector

   !> X = L S L^T X on all equations, zero where they are locked: the product with the matrix that the factor is of.
   subroutine factor_times_vector(tree, x)
      type(front_tree_type), intent(in) :: tree
      real(wp), intent(inout)           :: x(tree%n)
      real(wp) :: work(tree%most_rows)
      integer  :: f, i

      where (tree%locked) x = 0.0_wp
      do f = 1, size(tree%fronts) ! L^T x: the rows beyond are those of fronts that follow
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
            do i = 1, r
               x(front%rows(i)) = x(front%rows(i)) + work(i)
            end do
            call dtrmv('L', 'N', 'N', p, front%panel, p + r, x(first), 1)
         end associate
      end do
      where (tree%locked) x = 0.0_wp
   end subroutine factor_times_vector

end module front_solve
