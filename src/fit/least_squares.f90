!> Linear least squares by LAPACK.
module least_squares
   use kinds, only: wp
   implicit none
   private

   public :: solve_least_squares, fit_line

   real(wp), parameter :: singular = 1.0e-12_wp ! reciprocal condition number of the scaled columns that counts as rank lost

   interface
      subroutine dgelsy(m, n, nrhs, a, lda, b, ldb, jpvt, rcond, rank, work, lwork, info)
         import :: wp
         integer, intent(in)     :: m, n, nrhs, lda, ldb, lwork
         real(wp), intent(in)    :: rcond
         real(wp), intent(inout) :: a(lda, *), b(ldb, *), work(*)
         integer, intent(inout)  :: jpvt(*)
         integer, intent(out)    :: rank, info
      end subroutine dgelsy
   end interface

contains

   !> The X that makes norm2(MATRIX X - RHS) least, by an orthogonal factorisation with pivoting (DGELSY). The columns are
   !! scaled to length one first, so that d, d^2, d^3 in any unit do no harm. OK is false where MATRIX has fewer rows than
   !! columns or, to rounding, dependent columns; X is then zero.
   subroutine solve_least_squares(matrix, rhs, x, ok)
      real(wp), intent(in)  :: matrix(:, :) !! (points, unknowns)
      real(wp), intent(in)  :: rhs(:)       !! (points)
      real(wp), intent(out) :: x(:)         !! (unknowns)
      logical, intent(out)  :: ok
      real(wp), allocatable :: a(:, :), b(:, :), work(:)
      real(wp) :: length(size(matrix, 2)), best_size(1)
      integer  :: pivots(size(matrix, 2)), info, k, m, n, rank

      m = size(matrix, 1)
      n = size(matrix, 2)
      x = 0.0_wp
      ok = .false.
      if (m < n) return
      length = [(norm2(matrix(:, k)), k = 1, n)]
      if (any(length <= 0.0_wp)) return
      a = matrix/spread(length, 1, m)
      b = reshape(rhs, [m, 1])
      pivots = 0
      call dgelsy(m, n, 1, a, m, b, m, pivots, singular, rank, best_size, -1, info)
      allocate (work(int(best_size(1))))
      call dgelsy(m, n, 1, a, m, b, m, pivots, singular, rank, work, size(work), info)
      ok = info == 0 .and. rank == n
      if (ok) x = b(:n, 1)/length
   end subroutine solve_least_squares

   !> The straight line y = LINE(1) + LINE(2) x nearest to the points. OK is false for fewer than two different x.
   subroutine fit_line(x, y, line, ok)
      real(wp), intent(in)  :: x(:), y(:)
      real(wp), intent(out) :: line(2)
      logical, intent(out)  :: ok
      real(wp) :: matrix(size(x), 2)

      matrix(:, 1) = 1.0_wp
      matrix(:, 2) = x
      call solve_least_squares(matrix, y, line, ok)
   end subroutine fit_line

end module least_squares
