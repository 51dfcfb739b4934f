!> Elimination of the first P unknowns of a dense symmetric front of P + R, in blocks, by BLAS and LAPACK.
!!
!!        | A11      |      A11 = L11 L11^T,  L21 = A21 L11^-T,  A22 becomes A22 - L21 L21^T
!!        | A21  A22 |
!!
!! panel = (A11 over A21), (P + R, P); update = A22, (R, R). Both are lower triangles with square blocks on the diagonal.
!! Entries above these blocks are neither read nor written, so that in large fronts they take no memory. The blocks do not
!! depend on the number of threads, and each block is the work of one thread: the digits do not depend on it either.
!!
!! The factor of a front that is not positive definite has signs, A = L S L^T, S diagonal of +1 and -1: L21 = A21 L11^-T S. The
!! subtracted product is L S L^T = L L^T - 2 L_- L_-^T, L_- the columns whose sign is -1. A structure has few of these.
module front_kernel
   use blas_lapack, only: dgemm, dpotrf, dtrsm
   use kinds, only: long, wp
   implicit none
   private

   public :: eliminate, top_row, touched_entries, substitute, substitute_back, solve_lower, solve_upper, subtract_columns, &
             subtract_rows

   integer(long), parameter, public :: large = 8388608_long !! entries of a matrix whose pages are worth giving back

   integer, parameter, public :: narrow = 96 !! columns that are eliminated together
   integer, parameter :: wide   = 4*narrow ! columns of the update matrix that are one task
   integer, parameter :: strip  = 768      ! rows that are one task
   integer, parameter :: alone  = 300      ! rows up to which a front is not worth tasks

   integer, parameter :: together = 4        ! columns

contains

   !> Eliminate in place. FAULT is 0, or the first unknown whose pivot is not above TOLERANCE times its entry in DIAGONAL: the
   !! unknown has no stiffness left, and the front is not complete. If NEGATIVE is present, a pivot may be below zero; NEGATIVE
   !! lists the columns whose sign is -1.
   subroutine eliminate(p, r, panel, update, diagonal, tolerance, fault, negative)
      integer, intent(in)     :: p, r
      real(wp), intent(inout) :: panel(p + r, p), update(r, r)
      real(wp), intent(in)    :: diagonal(p)     !! of the matrix before any elimination
      real(wp), intent(in)    :: tolerance
      integer, intent(out)    :: fault
      integer, allocatable, intent(inout), optional :: negative(:)
      real(wp), allocatable :: of_negative(:, :) ! the columns whose sign is -1, all rows
      integer :: j, k, n

      n = p + r
      if (present(negative)) negative = [integer ::]
      allocate (of_negative(n, 0))
      fault = 0
      do k = 1, p, narrow
         call subtract_products(k, min(p, k + narrow - 1))
         call eliminate_block(n, k, min(p, k + narrow - 1), tolerance*diagonal, panel, of_negative, fault, negative)
         if (fault > 0) return
      end do
      do j = 1, r, wide
         !$omp task default(shared) firstprivate(j) if(n > alone)
         call update_columns(j, min(r, j + wide - 1))
         !$omp end task
      end do
      !$omp taskwait

   contains

      !> Subtract from columns FIRST to LAST of the panel the products of the columns before.
      subroutine subtract_products(first, last)
         integer, intent(in) :: first, last
         integer :: i, m

         if (first == 1) return
         do i = first, n, strip
            m = min(strip, n - i + 1)
            !$omp task default(shared) firstprivate(i, m) if(n > alone)
            call dgemm('N', 'T', m, last - first + 1, first - 1, -1.0_wp, panel(i, 1), n, panel(first, 1), n, 1.0_wp, &
                       panel(i, first), n)
            !$omp end task
         end do
         !$omp taskwait
         m = size(of_negative, 2)
         if (m > 0) call dgemm('N', 'T', n - first + 1, last - first + 1, m, 2.0_wp, of_negative(first, 1), n, &
                               of_negative(first, 1), n, 1.0_wp, panel(first, first), n)
      end subroutine subtract_products

      !> A22 - L21 L21^T in columns FIRST to LAST. The part below the square on the diagonal is one block. The square is
      !! computed in narrow blocks: DGEMM is faster than DSYRK although it also fills the upper triangle.
      subroutine update_columns(first, last)
         integer, intent(in) :: first, last
         integer :: column, m, width

         m = size(of_negative, 2)
         if (last < r) call dgemm('N', 'T', r - last, last - first + 1, p, -1.0_wp, panel(p + last + 1, 1), n, &
                                  panel(p + first, 1), n, 1.0_wp, update(last + 1, first), r)
         do column = first, last, narrow
            width = min(narrow, last - column + 1)
            call dgemm('N', 'T', last - column + 1, width, p, -1.0_wp, panel(p + column, 1), n, panel(p + column, 1), n, &
                       1.0_wp, update(column, column), r)
            if (m > 0) call dgemm('N', 'T', r - column + 1, width, m, 2.0_wp, of_negative(p + column, 1), n, &
                                  of_negative(p + column, 1), n, 1.0_wp, update(column, column), r)
         end do
      end subroutine update_columns

   end subroutine eliminate

   !> L in the columns FIRST to LAST of PANEL, from which all products of earlier columns are subtracted. FAULT is 0, or the first
   !! column whose pivot is not above LEAST. OF_NEGATIVE are all columns so far whose sign is -1.
   subroutine eliminate_block(n, first, last, least, panel, of_negative, fault, negative)
      integer, intent(in)  :: n, first, last
      real(wp), intent(in) :: least(:)
      real(wp), intent(inout) :: panel(n, size(least))
      real(wp), allocatable, intent(inout) :: of_negative(:, :)
      integer, intent(out) :: fault
      integer, allocatable, intent(inout), optional :: negative(:) !! list of these columns; a pivot may be below zero
      real(wp) :: as_it_was(first:last, first:last)
      integer  :: column, i, info, m

      if (present(negative)) as_it_was = panel(first:last, first:last)
      call dpotrf('L', last - first + 1, panel(first, first), n, info)
      if (info > 0 .and. present(negative)) then
         panel(first:last, first:last) = as_it_was
         call factorise_with_signs(first, last, panel(first:last, first:last), negative)
         info = 0
      end if
      do column = first, merge(first + info - 1, last, info > 0)
         fault = column
         if (.not. panel(column, column)**2 > least(column) .or. column == first + info - 1) return
      end do
      fault = 0
      do i = last + 1, n, strip
         m = min(strip, n - i + 1)
         !$omp task default(shared) firstprivate(i, m) if(n > alone)
         call dtrsm('R', 'L', 'T', 'N', m, last - first + 1, 1.0_wp, panel(first, first), n, panel(i, first), n)
         !$omp end task
      end do
      !$omp taskwait
      if (.not. present(negative)) return
      do i = size(of_negative, 2) + 1, size(negative)
         panel(last + 1:, negative(i)) = -panel(last + 1:, negative(i))
      end do
      if (size(negative) > 0) of_negative = panel(:, negative)
   end subroutine eliminate_block

   !> A = L S L^T in place, for columns FIRST to LAST of a front. Columns whose sign is -1 are appended to NEGATIVE. A zero
   !! pivot leaves zero on the diagonal and its column unchanged.
   pure subroutine factorise_with_signs(first, last, a, negative)
      integer, intent(in)                 :: first, last
      real(wp), intent(inout)             :: a(first:last, first:last) !! lower triangle
      integer, allocatable, intent(inout) :: negative(:)
      real(wp) :: s
      integer  :: i, j

      do j = first, last
         s = sign(1.0_wp, a(j, j))
         if (s < 0.0_wp) negative = [negative, j]
         a(j, j) = sqrt(abs(a(j, j)))
         if (.not. a(j, j) > 0.0_wp) return
         a(j + 1:, j) = s*a(j + 1:, j)/a(j, j)
         do i = j + 1, last
            a(i:, i) = a(i:, i) - s*a(i, j)*a(i:, j)
         end do
      end do
   end subroutine factorise_with_signs

   !> The first row that is touched in column J of a panel or an update matrix; rows from there on must be set.
   elemental integer function top_row(j)
      integer, intent(in) :: j

      top_row = j - mod(j - 1, narrow)
   end function top_row

   !> Entries of a panel or update matrix of M rows and N columns that take memory: whole pages above the top rows take none.
   elemental real(wp) function touched_entries(m, n)
      real(wp), intent(in) :: m, n
      real(wp), parameter  :: page = 512.0_wp !! entries

      touched_entries = m*n - 0.5_wp*max(0.0_wp, n - page - narrow)**2
   end function touched_entries

   !> Forward substitution: the first P of W become y, the others are reduced.
   pure subroutine substitute(n, p, panel, w)
      integer, intent(in)     :: n, p
      real(wp), intent(in)    :: panel(n, p) !! lower triangle, and all below it
      real(wp), intent(inout) :: w(n)

      call solve_lower(n, n, p, panel, w)
   end subroutine substitute

   !> Back substitution: the first P of W become x; the others are known.
   pure subroutine substitute_back(n, p, panel, w)
      integer, intent(in)     :: n, p
      real(wp), intent(in)    :: panel(n, p)
      real(wp), intent(inout) :: w(n)

      if (n > p) call subtract_rows(n, n - p, p, panel(p + 1, 1), w(p + 1), w)
      call solve_upper(n, p, panel, w)
   end subroutine substitute_back

   !> L y = w in the first P of M rows, w - L y in the others.
   pure subroutine solve_lower(n, m, p, l, w)
      integer, intent(in)     :: n       !! leading dimension
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
      real(wp), intent(in)    :: a(n, *), x(columns)
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
      real(wp), intent(in)    :: a(n, *), x(m)
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

end module front_kernel
