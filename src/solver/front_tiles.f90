!> Elimination of the first P unknowns of a large dense front of P + R in square tiles. Each operation on a tile is a task of OpenMP
!! that begins as soon as the tiles it reads are ready: no task waits for a whole column. The tiles do not depend on the number of
!! threads, and each has its additions in one order, so that the digits do not depend on it either.
!! Source: Buttari, Langou, Kurzak, Dongarra, Parallel Comput. 35 (2009) 38-53. The matrices are those of front_kernel.
module front_tiles
   use blas_lapack, only: dgemm
   use front_kernel, only: add_to_square, divide_rows, eliminate_columns, solve_lower, solve_upper, subtract_columns, &
                           subtract_rows, tile => wide
   use kinds, only: wp
   use task_record, only: is_recorded, key, record_task, task_begins
   implicit none
   private

   public :: eliminate_in_tiles, substitute_in_tiles

   integer, parameter, public :: tiled_rows = 1024 !! rows of a front from which on it has tiles
   integer, parameter :: solved = 384             ! rows and columns of a tile in a substitution
   integer, parameter :: deep = 2                 ! columns of tiles whose products are subtracted together

contains

   !> Eliminate in place, as eliminate of front_kernel. FRONT names the front in a record of tasks.
   subroutine eliminate_in_tiles(front, p, r, panel, update, diagonal, tolerance, fault)
      integer, intent(in)     :: front, p, r
      real(wp), intent(inout) :: panel(p + r, p), update(r, r)
      real(wp), intent(in)    :: diagonal(p) !! of the matrix before any elimination
      real(wp), intent(in)    :: tolerance
      integer, intent(out)    :: fault
      integer, allocatable :: ready(:, :), first(:) ! tiles of pivots, then tiles of rows beyond them; first rows, and the end
      integer :: i, j, k, last, low, n, n_pivots

      n = p + r
      n_pivots = (p - 1)/tile + 1
      allocate (first, source=[(i, i=1, p, tile), (i, i=p + 1, n, tile), n + 1])
      allocate (ready(size(first) - 1, size(first) - 1))
      fault = 0
      do k = 1, n_pivots
         !$omp task default(shared) firstprivate(k) depend(inout: ready(k, k))
         call factorise(k)
         !$omp end task
         do i = k + 1, size(ready, 1)
            !$omp task default(shared) firstprivate(i, k) depend(in: ready(k, k)) depend(inout: ready(i, k))
            call divide(i, k)
            !$omp end task
         end do
         last = min(n_pivots, k - mod(k - 1, deep) + deep - 1)
         low = merge(last - mod(last - 1, deep), k, k == last)
         do j = k + 1, merge(size(ready, 1), last, k == last)
            do i = j, size(ready, 1)
               !$omp task default(shared) firstprivate(i, j, k, low) depend(inout: ready(i, j)) &
               !$omp depend(in: ready(i, k), ready(j, k), ready(i, low), ready(j, low))
               call subtract(i, j, low, k)
               !$omp end task
            end do
         end do
      end do
      !$omp taskwait

   contains

      logical function is_faulty()
         integer :: now

         !$omp atomic read
         now = fault
         is_faulty = now > 0
      end function is_faulty

      !> L in the tile (K, K).
      subroutine factorise(k)
         integer, intent(in) :: k
         real(wp) :: began
         integer  :: found

         if (is_faulty()) return
         began = task_begins()
         associate (from => first(k), m => first(k + 1) - first(k))
            call eliminate_columns(m, 1, m, tolerance*diagonal(from:from + m - 1), panel(from, from), n, found)
            if (found > 0) found = found + from - 1
         end associate
         if (found > 0) then
            !$omp atomic write
            fault = found
         end if
         if (is_recorded) call record_task(began, 'factorise', key('<', front)//key('<', front, k, k)// &
                                           key('>', front, k, k)//key('+', -front))
      end subroutine factorise

      !> L in the tile (I, K), given that in (K, K).
      subroutine divide(i, k)
         integer, intent(in) :: i, k
         real(wp) :: began

         if (is_faulty()) return
         began = task_begins()
         associate (m => first(i + 1) - first(i), from => first(k), until => first(k + 1))
            call divide_rows(m, until - from, panel(from, from), n, panel(first(i), from), n)
         end associate
         if (is_recorded) call record_task(began, 'divide', key('<', front)//key('<', front, k, k)//key('<', front, i, k)// &
                                           key('>', front, i, k)//key('+', -front))
      end subroutine divide

      !> Subtract from the tile (I, J) the products of the tiles in columns LOW to HIGH of its rows I and J; on the diagonal only the
      !! lower part, in narrow blocks.
      subroutine subtract(i, j, low, high)
         integer, intent(in) :: i, j, low, high
         real(wp) :: began

         if (is_faulty()) return
         began = task_begins()
         associate (depth => first(high + 1) - first(low), from => first(low), row => first(i), column => first(j), &
                    m => first(i + 1) - first(i), width => first(j + 1) - first(j))
            if (i == j .and. j <= n_pivots) then
               call add_to_square(-1.0_wp, m, depth, panel(row, from), n, panel(row, row), n)
            else if (i == j) then
               call add_to_square(-1.0_wp, m, depth, panel(row, from), n, update(row - p, row - p), r)
            else if (j <= n_pivots) then
               call dgemm('N', 'T', m, width, depth, -1.0_wp, panel(row, from), n, panel(column, from), n, 1.0_wp, &
                          panel(row, column), n)
            else
               call dgemm('N', 'T', m, width, depth, -1.0_wp, panel(row, from), n, panel(column, from), n, 1.0_wp, &
                          update(row - p, column - p), r)
            end if
         end associate
         if (is_recorded) call record_task(began, 'subtract', key('<', front, i, high)//key('<', front, j, high)// &
                                           key('<', front, i, j)//key('>', front, i, j)//key('+', -front))
      end subroutine subtract

   end subroutine eliminate_in_tiles

   !> Forward substitution in front F, the first P of W becoming y and the others reduced; or, BACK, the first P becoming x, the others
   !! being known.
   subroutine substitute_in_tiles(f, n, p, panel, w, back)
      integer, intent(in)     :: f, n, p
      real(wp), intent(in)    :: panel(n, p)
      real(wp), intent(inout) :: w(n)
      logical, intent(in)     :: back
      integer, allocatable :: ready(:), first(:)
      integer :: i, j, k, n_pivots

      n_pivots = (p - 1)/solved + 1
      allocate (first, source=[(i, i=1, p, solved), (i, i=p + 1, n, solved), n + 1])
      allocate (ready(size(first) - 1))
      do j = merge(size(ready), 1, back), merge(1, n_pivots, back), merge(-1, 1, back)
         do k = merge(min(j, n_pivots), j, back), merge(1, size(ready), back), merge(-1, 1, back)
            !$omp task default(shared) firstprivate(j, k) depend(in: ready(j)) depend(inout: ready(k))
            call take(j, k)
            !$omp end task
         end do
      end do
      !$omp taskwait

   contains

      !> What the part J of W, which is known, brings to the part K.
      subroutine take(j, k)
         integer, intent(in) :: j, k
         real(wp) :: began

         began = task_begins()
         associate (a => first(j), m => first(j + 1) - first(j), b => first(k), width => first(k + 1) - first(k))
            if (j < k) then
               call subtract_columns(n, width, m, panel(b, a), w(a), w(b))
            else if (j > k) then
               call subtract_rows(n, m, width, panel(a, b), w(a), w(b))
            else if (back) then
               call solve_upper(n, m, panel(a, a), w(a))
            else
               call solve_lower(n, m, m, panel(a, a), w(a))
            end if
         end associate
         if (is_recorded) call record_task(began, 'take', key('<', f, 0)//key('<', f, j)//key('<', f, k)//key('>', f, k)// &
                                           key('+', f))
      end subroutine take

   end subroutine substitute_in_tiles

end module front_tiles
