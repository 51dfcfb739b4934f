!> The elimination of the first P unknowns of a dense symmetric front of P + R, by blocks that BLAS and LAPACK work on:
!!
!!        | A11      |      A11 = L11 L11^T,  L21 = A21 L11^-T,  A22 becomes A22 - L21 L21^T
!!        | A21  A22 |
!!
!! panel = (A11 over A21), (P + R, P); update = A22, (R, R); lower triangles throughout. The blocks are the same for any number
!! of threads, and each is the work of one: so are the digits.
module front_kernel
   use blas_lapack, only: dgemm, dpotrf, dsyrk, dtrsm
   use kinds, only: wp
   implicit none
   private

   public :: eliminate

   integer, parameter :: block = 192     ! columns of the panel that are eliminated together
   integer, parameter :: strip = 512     ! rows of a strip that is one task
   integer, parameter :: tile  = 384     ! columns of the update matrix that are one task
   integer, parameter :: alone = 300     ! rows up to which a front is not worth tasks

contains

   !> Eliminate in place. FAULT is 0, or the first unknown whose pivot is not above TOLERANCE times its entry in DIAGONAL:
   !! it has no stiffness left, and the front is not complete.
   subroutine eliminate(p, r, panel, update, diagonal, tolerance, fault)
      integer, intent(in)     :: p, r
      real(wp), intent(inout) :: panel(p + r, p)
      real(wp), intent(inout) :: update(r, r)
      real(wp), intent(in)    :: diagonal(p)     !! of the matrix before any elimination
      real(wp), intent(in)    :: tolerance
      integer, intent(out)    :: fault
      integer :: i, info, j, k, kb, m, n

      n = p + r
      do k = 1, p, block
         kb = min(block, p - k + 1)
         if (k > 1) then ! all that the columns before do to these
            do i = k, n, strip
               m = min(strip, n - i + 1)
               !$omp task default(shared) firstprivate(i, m) if(n > alone)
               call dgemm('N', 'T', m, kb, k - 1, -1.0_wp, panel(i, 1), n, panel(k, 1), n, 1.0_wp, panel(i, k), n)
               !$omp end task
            end do
            !$omp taskwait
         end if
         call dpotrf('L', kb, panel(k, k), n, info)
         do j = k, merge(k + info - 1, k + kb - 1, info > 0)
            if (panel(j, j)**2 > tolerance*diagonal(j) .and. j /= k + info - 1) cycle
            fault = j
            return
         end do
         do i = k + kb, n, strip
            m = min(strip, n - i + 1)
            !$omp task default(shared) firstprivate(i, m) if(n > alone)
            call dtrsm('R', 'L', 'T', 'N', m, kb, 1.0_wp, panel(k, k), n, panel(i, k), n)
            !$omp end task
         end do
         !$omp taskwait
      end do
      fault = 0
      do j = 1, r, tile
         m = min(tile, r - j + 1)
         !$omp task default(shared) firstprivate(j, m) if(n > alone)
         call dsyrk('L', 'N', m, p, -1.0_wp, panel(p + j, 1), n, 1.0_wp, update(j, j), r)
         if (j + m <= r) call dgemm('N', 'T', r - j - m + 1, m, p, -1.0_wp, panel(p + j + m, 1), n, panel(p + j, 1), n, &
                                    1.0_wp, update(j + m, j), r)
         !$omp end task
      end do
      !$omp taskwait
   end subroutine eliminate

end module front_kernel
