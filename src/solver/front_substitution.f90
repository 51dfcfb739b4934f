!> The factor of a front and one right-hand side: of N rows, the first P with L11 on them, the others with L21,
!!
!!    forward   L11 y = w_1,  w_2 becomes w_2 - L21 y;      back   L11^T x = y - L21^T w_2
!!
!! All of the panel is read once, four columns together: what counts is how fast that comes from memory. The blocks of large fronts are
!! tasks of OpenMP, the same for any number of threads, and each is the work of one: so are the digits.
module front_substitution
   use kinds, only: wp
   implicit none
   private

   public :: substitute, substitute_back

   integer, parameter :: together = 4        ! columns
   integer, parameter :: alone = 1024        ! rows up to which a front is not worth tasks of its own; beyond that they are
   integer, parameter :: block = 256         ! columns whose unknowns are found together,
   integer, parameter :: strip_rows = 1024   ! so many rows of them a task forward,
   integer, parameter :: strip_columns = 64  ! so many columns of them a task back

contains

   !> Forward: the first P of W become y, the others what is left for the rows beyond. Called within a task.
   subroutine substitute(n, p, panel, w)
      integer, intent(in)     :: n, p
      real(wp), intent(in)    :: panel(n, p) !! lower triangle, and all below it
      real(wp), intent(inout) :: w(n)
      integer :: first, i, last, m

      if (n <= alone) then
         call solve_lower(n, n, p, panel, w)
         return
      end if
      do first = 1, p, block
         last = min(p, first + block - 1)
         call solve_lower(n, last - first + 1, last - first + 1, panel(first, first), w(first))
         do i = last + 1, n, strip_rows
            m = min(strip_rows, n - i + 1)
            !$omp task default(shared) firstprivate(i, m)
            call subtract_columns(n, m, last - first + 1, panel(i, first), w(first), w(i))
            !$omp end task
         end do
         !$omp taskwait
      end do
   end subroutine substitute

   !> Back: the first P of W become x; the others are known. Called within a task.
   subroutine substitute_back(n, p, panel, w)
      integer, intent(in)     :: n, p
      real(wp), intent(in)    :: panel(n, p)
      real(wp), intent(inout) :: w(n)
      integer :: first, j, last, m

      if (n <= alone) then
         if (n > p) call subtract_rows(n, n - p, p, panel(p + 1, 1), w(p + 1), w)
         call solve_upper(n, p, panel, w)
         return
      end if
      do first = 1 + block*((p - 1)/block), 1, -block
         last = min(p, first + block - 1)
         do j = first, last, strip_columns
            if (last == n) exit
            m = min(strip_columns, last - j + 1)
            !$omp task default(shared) firstprivate(j, m)
            call subtract_rows(n, n - last, m, panel(last + 1, j), w(last + 1), w(j))
            !$omp end task
         end do
         !$omp taskwait
         call solve_upper(n, last - first + 1, panel(first, first), w(first))
      end do
   end subroutine substitute_back

   !> L y = w in the first P of M rows, w - L y in the others.
   pure subroutine solve_lower(n, m, p, l, w)
      integer, intent(in)     :: n       !! rows from one column to the next
      integer, intent(in)     :: m, p
      real(wp), intent(in)    :: l(n, *)
      real(wp), intent(inout) :: w(m)
      integer :: i, j, k, last

      do j = 1, p, together
         last = min(p, j + together - 1)
         do k = j, last
            w(k) = w(k)/l(k, k)
            do i = k + 1, last
               w(i) = w(i) - l(i, k)*w(k)
            end do
         end do
         if (last < m) call subtract_columns(n, m - last, last - j + 1, l(last + 1, j), w(j), w(last + 1))
      end do
   end subroutine solve_lower

   !> L^T x = w.
   pure subroutine solve_upper(n, p, l, w)
      integer, intent(in)     :: n, p !! likewise
      real(wp), intent(in)    :: l(n, *)
      real(wp), intent(inout) :: w(p)
      integer :: i, j, k, last

      do j = 1 + together*((p - 1)/together), 1, -together
         last = min(p, j + together - 1)
         if (last < p) call subtract_rows(n, p - last, last - j + 1, l(last + 1, j), w(last + 1), w(j))
         do k = last, j, -1
            do i = k + 1, last
               w(k) = w(k) - l(i, k)*w(i)
            end do
            w(k) = w(k)/l(k, k)
         end do
      end do
   end subroutine solve_upper

   !> Y = Y - A X.
   pure subroutine subtract_columns(n, m, columns, a, x, y)
      integer, intent(in)     :: n, m, columns
      real(wp), intent(in)    :: a(n, *)
      real(wp), intent(in)    :: x(columns)
      real(wp), intent(inout) :: y(m)
      integer :: i, j

      do j = 1, columns - together + 1, together
         !$omp simd
         do i = 1, m
            y(i) = y(i) - ((a(i, j)*x(j) + a(i, j + 1)*x(j + 1)) + (a(i, j + 2)*x(j + 2) + a(i, j + 3)*x(j + 3)))
         end do
      end do
      do j = j, columns
         !$omp simd
         do i = 1, m
            y(i) = y(i) - a(i, j)*x(j)
         end do
      end do
   end subroutine subtract_columns

   !> Y = Y - A^T X.
   pure subroutine subtract_rows(n, m, columns, a, x, y)
      integer, intent(in)     :: n, m, columns
      real(wp), intent(in)    :: a(n, *)
      real(wp), intent(in)    :: x(m)
      real(wp), intent(inout) :: y(columns)
      real(wp) :: s1, s2, s3, s4
      integer  :: i, j

      do j = 1, columns - together + 1, together
         s1 = 0.0_wp
         s2 = 0.0_wp
         s3 = 0.0_wp
         s4 = 0.0_wp
         !$omp simd reduction(+:s1, s2, s3, s4)
         do i = 1, m
            s1 = s1 + a(i, j)*x(i)
            s2 = s2 + a(i, j + 1)*x(i)
            s3 = s3 + a(i, j + 2)*x(i)
            s4 = s4 + a(i, j + 3)*x(i)
         end do
         y(j:j + 3) = y(j:j + 3) - [s1, s2, s3, s4]
      end do
      do j = j, columns
         s1 = 0.0_wp
         !$omp simd reduction(+:s1)
         do i = 1, m
            s1 = s1 + a(i, j)*x(i)
         end do
         y(j) = y(j) - s1
      end do
   end subroutine subtract_rows

end module front_substitution
