!> What a front that moves begins with in every increment: a block of a matrix, kept whole, or entry by entry where most are zero.
module front_blocks
   use blas_lapack, only: dgemv, dsymv
   use front_kernel, only: top_row
   use kinds, only: long, wp
   implicit none
   private

   public :: keep_block, restore_block, add_to_block, block_times_vector

   !> A block with N_ROWS rows; its first N_COLUMNS rows are a lower triangle.
   type, public :: kept_block
      integer :: n_rows = 0, n_columns = 0
      real(wp), allocatable :: whole(:, :)            !! (n_rows, n_columns), or
      real(wp), allocatable :: values(:)              !! entries, at
      integer, allocatable  :: row(:), column(:)
   end type kept_block

contains

   !> Keep A, set as the kernel wants it. OK is false where there is no memory for it.
   subroutine keep_block(a, block, ok)
      real(wp), intent(in)          :: a(:, :)
      type(kept_block), intent(out) :: block
      logical, intent(out)          :: ok
      integer(long) :: k
      integer :: i, j, status

      block%n_rows = size(a, 1)
      block%n_columns = size(a, 2)
      k = 0
      do j = 1, block%n_columns
         k = k + count(abs(a(j:, j)) > 0.0_wp)
      end do
      if (2*k > int(block%n_rows, long)*block%n_columns/2) then
         allocate (block%whole(block%n_rows, block%n_columns), stat=status)
         ok = status == 0
         if (.not. ok) return
         do j = 1, block%n_columns
            block%whole(top_row(j):, j) = a(top_row(j):, j)
         end do
         return
      end if
      allocate (block%values(k), block%row(k), block%column(k), stat=status)
      ok = status == 0
      if (.not. ok) return
      k = 0
      do j = 1, block%n_columns
         do i = j, block%n_rows
            if (.not. abs(a(i, j)) > 0.0_wp) cycle
            k = k + 1
            block%values(k) = a(i, j)
            block%row(k) = i
            block%column(k) = j
         end do
      end do
   end subroutine keep_block

   !> A = BLOCK, as far as the kernel touches it.
   pure subroutine restore_block(block, a)
      type(kept_block), intent(in) :: block
      real(wp), intent(inout)      :: a(block%n_rows, block%n_columns)
      integer(long) :: k
      integer :: i, j

      do j = 1, block%n_columns
         if (allocated(block%whole)) then
            !$omp simd
            do i = top_row(j), block%n_rows
               a(i, j) = block%whole(i, j)
            end do
         else
            !$omp simd
            do i = top_row(j), block%n_rows
               a(i, j) = 0.0_wp
            end do
         end if
      end do
      if (allocated(block%whole)) return
      do k = 1, size(block%values, kind=long)
         a(block%row(k), block%column(k)) = block%values(k)
      end do
   end subroutine restore_block

   !> Add VALUE at row I, column J of BLOCK.
   subroutine add_to_block(block, i, j, value)
      type(kept_block), intent(inout) :: block
      integer, intent(in)             :: i, j
      real(wp), intent(in)            :: value
      integer(long) :: k

      if (allocated(block%whole)) then
         block%whole(i, j) = block%whole(i, j) + value
         return
      end if
      do k = 1, size(block%values, kind=long)
         if (block%row(k) /= i .or. block%column(k) /= j) cycle
         block%values(k) = block%values(k) + value
         return
      end do
      block%values = [block%values, value]
      block%row = [block%row, i]
      block%column = [block%column, j]
   end subroutine add_to_block

   !> Y = Y + BLOCK X, the block as part of a symmetric matrix over the unknowns of its rows.
   subroutine block_times_vector(block, x, y)
      type(kept_block), intent(in) :: block
      real(wp), intent(in)         :: x(block%n_rows)
      real(wp), intent(inout)      :: y(block%n_rows)
      integer(long) :: k
      integer :: m, n

      m = block%n_rows
      n = block%n_columns
      if (allocated(block%whole)) then
         if (n == 0) return
         call dsymv('L', n, 1.0_wp, block%whole, m, x, 1, 1.0_wp, y, 1)
         if (m == n) return
         call dgemv('N', m - n, n, 1.0_wp, block%whole(n + 1, 1), m, x, 1, 1.0_wp, y(n + 1), 1)
         call dgemv('T', m - n, n, 1.0_wp, block%whole(n + 1, 1), m, x(n + 1), 1, 1.0_wp, y, 1)
      else
         do k = 1, size(block%values, kind=long)
            associate (i => block%row(k), j => block%column(k))
               y(i) = y(i) + block%values(k)*x(j)
               if (i /= j) y(j) = y(j) + block%values(k)*x(i)
            end associate
         end do
      end if
   end subroutine block_times_vector

end module front_blocks
