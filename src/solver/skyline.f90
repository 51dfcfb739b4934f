!> Symmetric matrices in skyline storage, and their active-column Cholesky factor. The factor of a matrix that is not positive
!! definite has signs, A = U^T S U, S diagonal of +1 and -1.
!!
!! Column j of the upper triangle is stored from its first nonzero row m_j down to the diagonal, column after column:
!!
!!        | a11  a12   .   a14 |      values = a11 | a12 a22 | a33 | a14 a24 a34 a44
!!    A = |      a22   .   a24 |      diagonal =  1      3      4              8
!!        |           a33  a34 |
!!        |                a44 |      m = 1, 1, 3, 1
!!
!! Source: Bathe, Finite Element Procedures, 2nd ed., section 8.2.3 (the active column solution).
module skyline
   use blas_lapack, only: ddot
   use kinds, only: long, wp
   implicit none
   private

   public :: start_skyline, add_to_skyline, skyline_times_vector, factorise_skyline, solve_skyline, factor_times_vector

   type, public :: skyline_matrix
      integer :: n = 0                              !! order
      integer(long), allocatable :: diagonal(:)     !! (0:n) place of a_jj in values; diagonal(0) = 0
      real(wp), allocatable      :: values(:)       !! (diagonal(n))
      integer, allocatable       :: negative(:)     !! of a factor with signs: the columns whose sign is -1, ascending
   end type skyline_matrix

contains

   !> A zero matrix whose column j begins in row FIRST_ROW(j). OK is false where memory is missing.
   subroutine start_skyline(first_row, matrix, ok)
      integer, intent(in)               :: first_row(:) !! (n), 1 <= first_row(j) <= j
      type(skyline_matrix), intent(out) :: matrix
      logical, intent(out)              :: ok
      integer :: j, status

      matrix%n = size(first_row)
      allocate (matrix%diagonal(0:matrix%n))
      matrix%diagonal(0) = 0
      do j = 1, matrix%n
         matrix%diagonal(j) = matrix%diagonal(j - 1) + j - first_row(j) + 1
      end do
      allocate (matrix%values(matrix%diagonal(matrix%n)), stat=status)
      ok = status == 0
      if (ok) matrix%values = 0.0_wp
   end subroutine start_skyline

   !> a_ij = a_ij + VALUE, for 1 <= i, j <= n inside the profile (either triangle).
   pure subroutine add_to_skyline(matrix, i, j, value)
      type(skyline_matrix), intent(inout) :: matrix
      integer, intent(in)                 :: i, j
      real(wp), intent(in)                :: value
      integer(long) :: place

      place = matrix%diagonal(max(i, j)) - abs(j - i)
      matrix%values(place) = matrix%values(place) + value
   end subroutine add_to_skyline

   !> Y = A X for a matrix not yet factorised.
   pure subroutine skyline_times_vector(matrix, x, y)
      type(skyline_matrix), intent(in) :: matrix
      real(wp), intent(in)             :: x(:) !! (n)
      real(wp), intent(out)            :: y(:) !! (n)
      integer(long) :: top
      integer :: j, height, first

      y = 0.0_wp
      do j = 1, matrix%n
         top = matrix%diagonal(j - 1) + 1
         height = int(matrix%diagonal(j) - top)   ! entries above the diagonal
         first = j - height
         y(j) = y(j) + matrix%values(matrix%diagonal(j))*x(j)
         if (height == 0) cycle
         associate (column => matrix%values(top:top + height - 1))
            y(j) = y(j) + dot_product(column, x(first:j - 1))
            y(first:j - 1) = y(first:j - 1) + column*x(j)
         end associate
      end do
   end subroutine skyline_times_vector

   !> A = U^T S U in place, column by column: u_ij = (a_ij - sum_k s_k u_ki u_kj)/(s_i u_ii), s_j u_jj^2 = a_jj - sum_k s_k u_kj^2.
   !! FAULT is 0, or the number of the first column whose pivot is not above PIVOT_TOLERANCE times its diagonal entry: the equation
   !! has no stiffness left, and the factor is not complete. Only WITH_SIGNS may a pivot be below zero.
   subroutine factorise_skyline(matrix, pivot_tolerance, fault, with_signs)
      type(skyline_matrix), intent(inout) :: matrix
      real(wp), intent(in)                :: pivot_tolerance
      integer, intent(out)                :: fault
      logical, intent(in), optional       :: with_signs !! false
      integer(long) :: column, above  ! places of (row 0) of columns j and i: entry k stands at column + k
      real(wp) :: pivot, diagonal_entry
      integer  :: i, j, first_i, first_j, first, negative(matrix%n), n_negative
      logical  :: any_sign

      any_sign = .false.
      if (present(with_signs)) any_sign = with_signs
      n_negative = 0
      do j = 1, matrix%n
         column = matrix%diagonal(j) - j
         first_j = int(matrix%diagonal(j - 1) + 1 - column)
         do i = first_j, j - 1
            above = matrix%diagonal(i) - i
            first_i = int(matrix%diagonal(i - 1) + 1 - above)
            first = max(first_i, first_j)
            if (first < i) matrix%values(column + i) = matrix%values(column + i) - product_of(above, column, first, i - 1)
            matrix%values(column + i) = matrix%values(column + i)/matrix%values(above + i)
            if (n_negative == 0) cycle
            if (any(negative(:n_negative) == i)) matrix%values(column + i) = -matrix%values(column + i)
         end do
         diagonal_entry = matrix%values(column + j)
         pivot = diagonal_entry
         if (first_j < j) pivot = pivot - product_of(column, column, first_j, j - 1)
         if (any_sign .and. pivot < 0.0_wp) then
            n_negative = n_negative + 1
            negative(n_negative) = j
            pivot = -pivot
            diagonal_entry = abs(diagonal_entry)
         end if
         if (.not. pivot > pivot_tolerance*diagonal_entry) then
            fault = j
            return
         end if
         matrix%values(column + j) = sqrt(pivot)
      end do
      matrix%negative = negative(:n_negative)
      fault = 0

   contains

      !> Sum of s_k a_k b_k over the rows FROM to UNTIL of the columns A and B.
      real(wp) function product_of(a, b, from, until) result(product)
         integer(long), intent(in) :: a, b
         integer, intent(in)       :: from, until
         integer :: k

         product = ddot(until - from + 1, matrix%values(a + from), 1, matrix%values(b + from), 1)
         do k = n_negative, 1, -1
            if (negative(k) > until) cycle
            if (negative(k) < from) exit
            product = product - 2.0_wp*matrix%values(a + negative(k))*matrix%values(b + negative(k))
         end do
      end function product_of

   end subroutine factorise_skyline

   !> Solve U^T S U X = X in place, U and S from factorise_skyline.
   subroutine solve_skyline(factor, x)
      type(skyline_matrix), intent(in)    :: factor
      real(wp), contiguous, intent(inout) :: x(:) !! (n) right-hand side on entry, solution on return
      integer(long) :: column
      integer :: j, first

      do j = 1, factor%n          ! U^T y = b
         column = factor%diagonal(j) - j
         first = int(factor%diagonal(j - 1) + 1 - column)
         if (first < j) x(j) = x(j) - ddot(j - first, factor%values(column + first), 1, x(first:j - 1), 1)
         x(j) = x(j)/factor%values(column + j)
      end do
      x(factor%negative) = -x(factor%negative) ! S is its own inverse
      do j = factor%n, 1, -1      ! U x = y
         column = factor%diagonal(j) - j
         first = int(factor%diagonal(j - 1) + 1 - column)
         x(j) = x(j)/factor%values(column + j)
         if (first < j) x(first:j - 1) = x(first:j - 1) - x(j)*factor%values(column + first:column + j - 1)
      end do
   end subroutine solve_skyline

   !> X = U^T S U X, U and S from factorise_skyline: the product with the factorised matrix.
   pure subroutine factor_times_vector(factor, x)
      type(skyline_matrix), intent(in) :: factor
      real(wp), intent(inout)          :: x(:) !! (n)
      integer(long) :: column
      integer :: j, first

      do j = 1, factor%n          ! U x, column by column: later columns need only later entries of x
         column = factor%diagonal(j) - j
         first = int(factor%diagonal(j - 1) + 1 - column)
         if (first < j) x(first:j - 1) = x(first:j - 1) + x(j)*factor%values(column + first:column + j - 1)
         x(j) = x(j)*factor%values(column + j)
      end do
      x(factor%negative) = -x(factor%negative)
      do j = factor%n, 1, -1
         column = factor%diagonal(j) - j
         first = int(factor%diagonal(j - 1) + 1 - column)
         x(j) = x(j)*factor%values(column + j)
         if (first < j) x(j) = x(j) + dot_product(factor%values(column + first:column + j - 1), x(first:j - 1))
      end do
   end subroutine factor_times_vector

end module skyline
