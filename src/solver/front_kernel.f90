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
   use blas_lapack, only: dgemm, dgemv, dtrsm, dtrsv
   use kinds, only: long, wp
   implicit none
   private

   public :: eliminate, top_row, touched_entries, substitute, substitute_back, substitute_columns, &
             substitute_columns_back, solve_lower, solve_upper, subtract_columns, &
             subtract_rows, eliminate_columns, divide_rows, add_to_square

   integer(long), parameter, public :: large = 8388608_long !! entries of a matrix whose pages are worth giving back

   integer, parameter :: least  = 8        ! columns of a panel that are eliminated one by one
   integer, parameter :: narrow = 4*least  ! columns of the squares on the diagonal that are filled whole
   real(wp), parameter :: small_pivot = 0.01_wp ! of what it was before the columns before it in its block
   integer, parameter, public :: wide = 384 !! columns of a tile, which is one task
   integer, parameter :: strip  = 768      ! its rows
   integer, parameter :: alone  = wide     ! rows up to which a front is not worth tasks

   integer, parameter :: together = 4        ! columns
   integer, parameter :: few_rows = 64       ! rows up to which own loops are faster than BLAS

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

      if (present(negative)) negative = [integer ::]
      fault = 0
      if (p > 0) call eliminate_columns(p + r, 1, p, tolerance*diagonal, panel, p + r, fault, negative)
      if (fault > 0 .or. r == 0) return
      call add_products(-1.0_wp, r, r, p, panel(p + 1, 1), p + r, update, r)
      if (present(negative)) call add_products(2.0_wp, r, r, size(negative), panel(p + 1:, negative), r, update, r)
   end subroutine eliminate

   !> Eliminate columns FIRST to LAST of a panel, from which the products of all columns before are subtracted, down to row M: one
   !! half after the other, so that most products are of many columns. FAULT is 0, or the first column whose pivot is not above
   !! LOWEST.
   recursive subroutine eliminate_columns(m, first, last, lowest, panel, n, fault, negative)
      integer, intent(in)     :: m, first, last
      integer, intent(in)     :: n !! leading dimension
      real(wp), intent(in)    :: lowest(*)
      real(wp), intent(inout) :: panel(n, *)
      integer, intent(out)    :: fault
      integer, allocatable, intent(inout), optional :: negative(:)
      integer, allocatable :: own(:)
      integer :: middle

      if (last - first < least) then
         call eliminate_block(m, first, last, lowest, panel, n, fault, negative)
         return
      end if
      middle = first - 1 + half_of(last - first + 1, merge(least, narrow, last - first < narrow))
      call eliminate_columns(m, first, middle, lowest, panel, n, fault, negative)
      if (fault > 0) return
      call add_products(-1.0_wp, m - middle, last - middle, middle - first + 1, panel(middle + 1, first), n, &
                        panel(middle + 1, middle + 1), n)
      if (present(negative)) then
         own = pack(negative, negative >= first)
         call add_products(2.0_wp, m - middle, last - middle, size(own), panel(middle + 1:m, own), m - middle, &
                           panel(middle + 1, middle + 1), n)
      end if
      call eliminate_columns(m, middle + 1, last, lowest, panel, n, fault, negative)
   end subroutine eliminate_columns

   !> About half of N, a multiple of STEP.
   pure integer function half_of(n, step)
      integer, intent(in) :: n, step

      half_of = step*((n + step)/(2*step))
   end function half_of

   !> C + ALPHA A B^T in the lower trapezoid C, (M, N), A (M, K), B the first N rows of A. Tiles are tasks.
   subroutine add_products(alpha, m, n, k, a, lda, c, ldc)
      real(wp), intent(in)    :: alpha
      integer, intent(in)     :: m, n, k, lda, ldc
      real(wp), intent(in)    :: a(lda, *)
      real(wp), intent(inout) :: c(ldc, *)
      integer :: i, j, width

      if (k == 0) return
      do j = 1, n, wide
         width = min(wide, n - j + 1)
         !$omp task default(shared) firstprivate(j, width) if(m > alone)
         call add_to_square(alpha, width, k, a(j, 1), lda, c(j, j), ldc)
         !$omp end task
         do i = j + width, m, strip
            !$omp task default(shared) firstprivate(i, j, width) if(m > alone)
            call dgemm('N', 'T', min(strip, m - i + 1), width, k, alpha, a(i, 1), lda, a(j, 1), lda, 1.0_wp, c(i, j), ldc)
            !$omp end task
         end do
      end do
      !$omp taskwait
   end subroutine add_products

   !> C + ALPHA A A^T in a square on the diagonal, which is halved until it is narrow: DGEMM is faster than DSYRK although it also
   !! fills the upper triangle.
   pure recursive subroutine add_to_square(alpha, n, k, a, lda, c, ldc)
      real(wp), intent(in)    :: alpha
      integer, intent(in)     :: n, k, lda, ldc
      real(wp), intent(in)    :: a(lda, *)
      real(wp), intent(inout) :: c(ldc, *)
      integer :: half

      if (n <= narrow) then
         call dgemm('N', 'T', n, n, k, alpha, a, lda, a, lda, 1.0_wp, c, ldc)
         return
      end if
      half = half_of(n, narrow)
      call add_to_square(alpha, half, k, a, lda, c, ldc)
      call dgemm('N', 'T', n - half, half, k, alpha, a(half + 1, 1), lda, a, lda, 1.0_wp, c(half + 1, 1), ldc)
      call add_to_square(alpha, n - half, k, a(half + 1, 1), lda, c(half + 1, half + 1), ldc)
   end subroutine add_to_square

   !> L in the few columns FIRST to LAST of a panel, likewise.
   subroutine eliminate_block(m, first, last, lowest, panel, n, fault, negative)
      integer, intent(in)     :: m, first, last, n
      real(wp), intent(in)    :: lowest(*)
      real(wp), intent(inout) :: panel(n, *)
      integer, intent(out)    :: fault
      integer, allocatable, intent(inout), optional :: negative(:)
      integer :: i, j, before

      before = 0
      if (present(negative)) before = size(negative)
      call factorise_square(first, last, lowest, panel(:, :last), fault, negative)
      if (fault > 0) return
      do i = last + 1, m, strip
         !$omp task default(shared) firstprivate(i) if(m > alone)
         call divide_rows(min(strip, m - i + 1), last - first + 1, panel(first, first), n, panel(i, first), n)
         !$omp end task
      end do
      !$omp taskwait
      if (.not. present(negative)) return
      do j = before + 1, size(negative)
         panel(last + 1:m, negative(j)) = -panel(last + 1:m, negative(j))
      end do
   end subroutine eliminate_block

   !> L in place of the square A = L S L^T of rows and columns FIRST to LAST. S is the identity unless NEGATIVE is present, to
   !! which the columns are appended whose sign is -1.
   pure subroutine factorise_square(first, last, lowest, a, fault, negative)
      integer, intent(in)     :: first, last
      real(wp), intent(in)    :: lowest(*)
      real(wp), intent(inout) :: a(:, :) !! lower triangle
      integer, intent(out)    :: fault
      integer, allocatable, intent(inout), optional :: negative(:)
      real(wp) :: s
      integer  :: i, j

      s = 1.0_wp
      do j = first, last
         fault = j
         if (present(negative)) s = sign(1.0_wp, a(j, j))
         if (.not. s*a(j, j) > max(0.0_wp, lowest(j))) return
         if (s < 0.0_wp) negative = [negative, j]
         a(j, j) = sqrt(s*a(j, j))
         a(j + 1:last, j) = s/a(j, j)*a(j + 1:last, j)
         do i = j + 1, last
            a(i:last, i) = a(i:last, i) - s*a(i, j)*a(i:last, j)
         end do
      end do
      fault = 0
   end subroutine factorise_square

   !> A = A L^-T, A (M, K), L (K, K) a lower triangle, of which few columns are inverted at a time: on processors with AVX-512
   !! DGEMM is four times faster than DTRSM. A pivot that is small beside its row is not inverted together with others: the rows
   !! would lose the digits that the pivot has lost.
   pure recursive subroutine divide_rows(m, k, l, ldl, a, lda)
      integer, intent(in)     :: m, k, ldl, lda
      real(wp), intent(in)    :: l(ldl, *)
      real(wp), intent(inout) :: a(lda, *)
      real(wp) :: before(m, min(k, least)), inverse(min(k, least), min(k, least))
      integer  :: half, i, j

      half = merge(half_of(k, least), 0, k > least)
      do j = 2, min(k, least)
         if (half == 0 .and. l(j, j)**2 < small_pivot*sum(l(j, :j - 1)**2)) half = half_of(k, 1)
      end do
      if (half > 0) then
         call divide_rows(m, half, l, ldl, a, lda)
         call dgemm('N', 'T', m, k - half, half, -1.0_wp, a, lda, l(half + 1, 1), ldl, 1.0_wp, a(1, half + 1), lda)
         call divide_rows(m, k - half, l(half + 1, half + 1), ldl, a(1, half + 1), lda)
         return
      end if
      inverse = 0.0_wp
      do j = 1, k
         do i = 1, j - 1
            inverse(:i, j) = inverse(:i, j) - l(j, i)*inverse(:i, i)
         end do
         inverse(:j - 1, j) = inverse(:j - 1, j)/l(j, j)
         inverse(j, j) = 1.0_wp/l(j, j)
      end do
      before = a(:m, :k)
      call dgemm('N', 'N', m, k, k, 1.0_wp, before, m, inverse, k, 0.0_wp, a, lda)
   end subroutine divide_rows

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

   !> The same as substitute for M columns of W. Strips of rows are tasks.
   subroutine substitute_columns(n, p, m, panel, w)
      integer, intent(in)     :: n, p, m
      real(wp), intent(in)    :: panel(n, p)
      real(wp), intent(inout) :: w(n, m)
      integer :: i

      call dtrsm('L', 'L', 'N', 'N', p, m, 1.0_wp, panel, n, w, n)
      do i = p + 1, n, strip
         !$omp task default(shared) firstprivate(i) if(n - p > strip)
         call dgemm('N', 'N', min(strip, n - i + 1), m, p, -1.0_wp, panel(i, 1), n, w, n, 1.0_wp, w(i, 1), n)
         !$omp end task
      end do
      !$omp taskwait
   end subroutine substitute_columns

   !> The same as substitute_back for M columns of W.
   subroutine substitute_columns_back(n, p, m, panel, w)
      integer, intent(in)     :: n, p, m
      real(wp), intent(in)    :: panel(n, p)
      real(wp), intent(inout) :: w(n, m)
      integer :: j

      do j = 1, merge(p, 0, n > p), strip
         !$omp task default(shared) firstprivate(j) if(p > strip)
         call dgemm('T', 'N', min(strip, p - j + 1), m, n - p, -1.0_wp, panel(p + 1, j), n, w(p + 1, 1), n, 1.0_wp, w(j, 1), n)
         !$omp end task
      end do
      !$omp taskwait
      call dtrsm('L', 'L', 'T', 'N', p, m, 1.0_wp, panel, n, w, n)
   end subroutine substitute_columns_back

   !> L y = w in the first P of M rows, w - L y in the others.
   pure subroutine solve_lower(n, m, p, l, w)
      integer, intent(in)     :: n       !! leading dimension
      integer, intent(in)     :: m, p
      real(wp), intent(in)    :: l(n, *)
      real(wp), intent(inout) :: w(m)
      integer :: i, j, k, last

      if (m > few_rows) then
         call dtrsv('L', 'N', 'N', p, l, n, w, 1)
         if (m > p) call dgemv('N', m - p, p, -1.0_wp, l(p + 1, 1), n, w, 1, 1.0_wp, w(p + 1), 1)
         return
      end if
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

      if (p > few_rows) then
         call dtrsv('L', 'T', 'N', p, l, n, w, 1)
         return
      end if
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

      if (m > few_rows) then
         call dgemv('N', m, columns, -1.0_wp, a, n, x, 1, 1.0_wp, y, 1)
         return
      end if
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

      if (m > few_rows) then
         call dgemv('T', m, columns, -1.0_wp, a, n, x, 1, 1.0_wp, y, 1)
         return
      end if
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
