!> Blocks of the fronts that are kept over the increments, whole or entry by entry. Strips of columns of a large block are tasks of
!! OpenMP.
module kept_blocks
   use blas_lapack, only: dgemv, dsymv
   use front_kernel, only: top_row
   use front_tiles, only: tiled_rows
   use kinds, only: long, wp
   use lists, only: sorted_order
   use task_record, only: is_recorded, record_task, task_begins
   implicit none
   private

   public :: keep_block, restore_block, add_to_block, block_times_vector

   !> A block with N_ROWS rows; its first N_COLUMNS rows are a lower triangle.
   type, public :: kept_block
      integer :: n_rows = 0, n_columns = 0
      real(wp), allocatable :: whole(:, :)            !! (n_rows, n_columns), or
      real(wp), allocatable :: values(:)              !! entries, column by column, rows ascending, at
      integer, allocatable  :: row(:), column(:)
   end type kept_block

   integer, parameter, public :: strip = 128        !! columns of a large front that are one task
   integer, parameter :: product_strip = 256       ! rows and columns of a block that are multiplied together

contains

   !> Keep A, of which the kernel touches the lower part. OK is false where memory is missing.
   subroutine keep_block(a, block, ok)
      real(wp), intent(in)          :: a(:, :)
      type(kept_block), intent(out) :: block
      logical, intent(out)          :: ok
      integer(long) :: filled(size(a, 2)), k
      integer :: first, i, j, last, status

      block%n_rows = size(a, 1)
      block%n_columns = size(a, 2)
      do first = 1, block%n_columns, strip
         last = min(block%n_columns, first + strip - 1)
         !$omp task default(shared) firstprivate(first, last) private(j) if(block%n_rows >= tiled_rows)
         do j = first, last
            filled(j) = count(abs(a(j:, j)) > 0.0_wp)
         end do
         !$omp end task
      end do
      !$omp taskwait
      k = sum(filled)
      if (2*k > int(block%n_rows, long)*block%n_columns/2) then
         allocate (block%whole(block%n_rows, block%n_columns), stat=status)
         ok = status == 0
         if (.not. ok) return
         do first = 1, block%n_columns, strip
            last = min(block%n_columns, first + strip - 1)
            !$omp task default(shared) firstprivate(first, last) private(j) if(block%n_rows >= tiled_rows)
            do j = first, last
               block%whole(top_row(j):, j) = a(top_row(j):, j)
            end do
            !$omp end task
         end do
         !$omp taskwait
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

   !> A = BLOCK, in the part that the kernel touches. Strips of columns are tasks; KEYS names them in a record.
   subroutine restore_block(block, a, keys)
      type(kept_block), intent(in) :: block
      real(wp), intent(inout)      :: a(block%n_rows, block%n_columns)
      character(*), intent(in)     :: keys
      real(wp) :: began
      integer(long) :: k
      integer :: first, i, j

      do first = 1, block%n_columns, strip
         !$omp task default(shared) firstprivate(first) private(began, i, j) if(block%n_rows >= tiled_rows)
         began = task_begins()
         do j = first, min(block%n_columns, first + strip - 1)
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
         if (is_recorded .and. len(keys) > 0) call record_task(began, 'restore', keys)
         !$omp end task
      end do
      !$omp taskwait
      if (allocated(block%whole)) return
      do k = 1, size(block%values, kind=long)
         a(block%row(k), block%column(k)) = block%values(k)
      end do
   end subroutine restore_block

   !> Add to BLOCK at these ROWS and COLUMNS the entries of K that do not lie above its diagonal.
   subroutine add_to_block(block, rows, columns, k)
      type(kept_block), intent(inout) :: block
      integer, intent(in)             :: rows(:), columns(:) !! ascending, each once
      real(wp), intent(in)            :: k(:, :)             !! (rows, columns)
      integer, allocatable  :: by_row(:), column(:), order(:), row(:)
      real(wp), allocatable :: values(:)
      logical :: is_lower(size(rows), size(columns))
      integer :: i, j, n

      is_lower = spread(rows, 2, size(columns)) >= spread(columns, 1, size(rows))
      if (allocated(block%whole)) then
         do j = 1, size(columns)
            do i = 1, size(rows)
               if (is_lower(i, j)) block%whole(rows(i), columns(j)) = block%whole(rows(i), columns(j)) + k(i, j)
            end do
         end do
         return
      end if
      row = [block%row, pack(spread(rows, 2, size(columns)), is_lower)]
      column = [block%column, pack(spread(columns, 1, size(rows)), is_lower)]
      values = [block%values, pack(k, is_lower)]
      call sorted_order(row, by_row)
      call sorted_order(column(by_row), order)
      order = by_row(order)
      block%row = row(order)
      block%column = column(order)
      block%values = values(order)
      n = min(1, size(order))
      do i = 2, size(order) ! an entry at the place of the one before is added to it
         if (block%row(i) == block%row(n) .and. block%column(i) == block%column(n)) then
            block%values(n) = block%values(n) + block%values(i)
         else
            n = n + 1
            block%row(n) = block%row(i)
            block%column(n) = block%column(i)
            block%values(n) = block%values(i)
         end if
      end do
      block%row = block%row(:n)
      block%column = block%column(:n)
      block%values = block%values(:n)
   end subroutine add_to_block

   !> Y = Y + BLOCK X, BLOCK being part of a symmetric matrix over the unknowns of its rows. Strips of its columns are tasks, whose
   !! products are added in their order.
   subroutine block_times_vector(block, x, y)
      type(kept_block), intent(in) :: block
      real(wp), intent(in)         :: x(block%n_rows)
      real(wp), intent(inout)      :: y(block%n_rows)
      real(wp), allocatable :: part(:, :)
      integer(long) :: k
      integer :: first, i, m, n, row, s

      m = block%n_rows
      n = block%n_columns
      if (allocated(block%whole)) then
         allocate (part(m, (n + product_strip - 1)/product_strip), source=0.0_wp)
         do s = 1, size(part, 2)
            !$omp task default(shared) firstprivate(s) private(first, i, row) if(m >= tiled_rows)
            first = product_strip*(s - 1) + 1
            i = min(n, first + product_strip - 1) - first + 1
            call dsymv('L', i, 1.0_wp, block%whole(first, first), m, x(first), 1, 0.0_wp, part(first, s), 1)
            do row = first + i, m, product_strip
               associate (rows => min(product_strip, m - row + 1))
                  call dgemv('N', rows, i, 1.0_wp, block%whole(row, first), m, x(first), 1, 1.0_wp, part(row, s), 1)
                  call dgemv('T', rows, i, 1.0_wp, block%whole(row, first), m, x(row), 1, 1.0_wp, part(first, s), 1)
               end associate
            end do
            !$omp end task
         end do
         !$omp taskwait
         do s = 1, size(part, 2)
            first = product_strip*(s - 1) + 1
            y(first:) = y(first:) + part(first:, s)
         end do
      else
         do k = 1, size(block%values, kind=long)
            associate (i => block%row(k), j => block%column(k))
               y(i) = y(i) + block%values(k)*x(j)
               if (i /= j) y(j) = y(j) + block%values(k)*x(i)
            end associate
         end do
      end if
   end subroutine block_times_vector

end module kept_blocks
