!> The elimination of the first P unknowns of a dense symmetric front of P + R, by blocks that BLAS and LAPACK work on:
!!
!!        | A11      |      A11 = L11 L11^T,  L21 = A21 L11^-T,  A22 becomes A22 - L21 L21^T
!!        | A21  A22 |
!!
!! panel = (A11 over A21), (P + R, P); update = A22, (R, R); lower triangles throughout, with squares on the diagonal: what lies
!! above them is neither read nor written, so that of large fronts it takes no memory. The blocks are the same for any number
!! of threads, and each is the work of one: so are the digits.
!!
!! A front that is not positive definite has a factor with signs, A = L S L^T, S diagonal of +1 and -1: L21 = A21 L11^-T S, and
!! of what is subtracted, L S L^T = L L^T - 2 L_- L_-^T with the columns L_- whose sign is -1; in a structure these are few.
module front_kernel
   use blas_lapack, only: dgemm, dpotrf, dtrsm
   use kinds, only: long, wp
   implicit none
   private

   public :: eliminate, top_row, touched_entries

   integer(long), parameter, public :: large = 8388608_long !! entries of a matrix whose pages are worth to be given back

   integer, parameter :: narrow = 96       ! columns that are eliminated together
   integer, parameter :: wide   = 4*narrow ! columns of the update matrix that are one task
   integer, parameter :: strip  = 768      ! rows that are one task
   integer, parameter :: alone  = 300      ! rows up to which a front is not worth tasks

contains

   !> Eliminate in place. FAULT is 0, or the first unknown whose pivot is not above TOLERANCE times its entry in DIAGONAL:
   !! it has no stiffness left, and the front is not complete.
   !! Where NEGATIVE is there a pivot may be below zero: the factor has signs then, and these are the columns of -1.
   subroutine eliminate(p, r, panel, update, diagonal, tolerance, fault, negative)
      integer, intent(in)     :: p, r
      real(wp), intent(inout) :: panel(p + r, p)
      real(wp), intent(inout) :: update(r, r)
      real(wp), intent(in)    :: diagonal(p)     !! of the matrix before any elimination
      real(wp), intent(in)    :: tolerance
      integer, intent(out)    :: fault
      integer, allocatable, intent(inout), optional :: negative(:)
      real(wp), allocatable :: of_negative(:, :) ! the columns whose sign is -1, all rows
      integer :: j, k, n

      n = p + r
      if (present(negative)) negative = [integer ::]
      do k = 1, p, narrow
         call subtract_products(k, min(p, k + narrow - 1))
         call eliminate_block(k, min(p, k + narrow - 1), fault)
         if (fault > 0) return
      end do
      fault = 0
      do j = 1, r, wide
         !$omp task default(shared) firstprivate(j) if(n > alone)
         call update_columns(j, min(r, j + wide - 1))
         !$omp end task
      end do
      !$omp taskwait

   contains

      !> Take from the columns FIRST to LAST of the panel what the columns before do to them.
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
         if (has_signs()) call dgemm('N', 'T', n - first + 1, last - first + 1, size(negative), 2.0_wp, of_negative(first, 1), n, &
                                     of_negative(first, 1), n, 1.0_wp, panel(first, first), n)
      end subroutine subtract_products

      !> Whether any pivot so far was below zero.
      pure logical function has_signs()

         has_signs = present(negative)
         if (has_signs) has_signs = size(negative) > 0
      end function has_signs

      !> L in the columns FIRST to LAST.
      subroutine eliminate_block(first, last, fault)
         integer, intent(in)  :: first, last
         integer, intent(out) :: fault
         integer :: column, i, info, m, n_before
         real(wp) :: as_it_was(first:last, first:last)

         n_before = 0
         if (present(negative)) then
            n_before = size(negative)
            as_it_was = panel(first:last, first:last)
         end if
         call dpotrf('L', last - first + 1, panel(first, first), n, info)
         if (info > 0 .and. present(negative)) then
            panel(first:last, first:last) = as_it_was
            call factorise_with_signs(first, last, panel(first:last, first:last), negative)
            info = 0
         end if
         do column = first, merge(first + info - 1, last, info > 0)
            fault = column
            if (.not. panel(column, column)**2 > tolerance*diagonal(column) .or. column == first + info - 1) return
         end do
         fault = 0
         do i = last + 1, n, strip
            m = min(strip, n - i + 1)
            !$omp task default(shared) firstprivate(i, m) if(n > alone)
            call dtrsm('R', 'L', 'T', 'N', m, last - first + 1, 1.0_wp, panel(first, first), n, panel(i, first), n)
            !$omp end task
         end do
         !$omp taskwait
         if (.not. has_signs()) return
         do i = n_before + 1, size(negative)
            panel(last + 1:, negative(i)) = -panel(last + 1:, negative(i))
         end do
         of_negative = panel(:, negative)
      end subroutine eliminate_block

      !> A22 - L21 L21^T in columns FIRST to LAST: what lies below the square on the diagonal as one block, the square in narrow
      !! ones, which DGEMM does faster than DSYRK although it fills the upper triangle in vain.
      subroutine update_columns(first, last)
         integer, intent(in) :: first, last
         integer :: column, width

         if (last < r) call dgemm('N', 'T', r - last, last - first + 1, p, -1.0_wp, panel(p + last + 1, 1), n, &
                                  panel(p + first, 1), n, 1.0_wp, update(last + 1, first), r)
         do column = first, last, narrow
            width = min(narrow, last - column + 1)
            call dgemm('N', 'T', last - column + 1, width, p, -1.0_wp, panel(p + column, 1), n, panel(p + column, 1), n, &
                       1.0_wp, update(column, column), r)
            if (has_signs()) call dgemm('N', 'T', r - column + 1, width, size(negative), 2.0_wp, of_negative(p + column, 1), n, &
                                        of_negative(p + column, 1), n, 1.0_wp, update(column, column), r)
         end do
      end subroutine update_columns

   end subroutine eliminate

   !> A = L S L^T in place, of the columns FIRST to LAST of a front: those whose sign is -1 are put behind NEGATIVE. A pivot that is
   !! zero leaves zero on the diagonal and its column as it is.
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

   !> The first row that is touched in column J of a panel or an update matrix; from there on it has to be set.
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

end module front_kernel
