!> The routines of BLAS and LAPACK that the solvers call. Reference: netlib.org/lapack. Arrays are of assumed size, so that the
!! actual argument a(i, j) passes the block that begins there.
module blas_lapack
   use kinds, only: wp
   implicit none
   private

   public :: ddot, dgemm, dgemv, dgesv, dlacn2, dposv, dpotrf, dpstrf, dsygv, dsymv, dsyrk, dtrmv, dtrsm, dtrsv, zgesv

   interface

      !> x.y
      pure function ddot(n, x, incx, y, incy) result(product)
         import :: wp
         integer, intent(in)  :: n, incx, incy
         real(wp), intent(in) :: x(*), y(*)
         real(wp) :: product
      end function ddot

      !> C = alpha op(A) op(B) + beta C
      pure subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
         import :: wp
         character, intent(in)   :: transa, transb
         integer, intent(in)     :: m, n, k, lda, ldb, ldc
         real(wp), intent(in)    :: alpha, beta, a(lda, *), b(ldb, *)
         real(wp), intent(inout) :: c(ldc, *)
      end subroutine dgemm

      !> y = alpha op(A) x + beta y
      pure subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: wp
         character, intent(in)   :: trans
         integer, intent(in)     :: m, n, lda, incx, incy
         real(wp), intent(in)    :: alpha, beta, a(lda, *), x(*)
         real(wp), intent(inout) :: y(*)
      end subroutine dgemv

      !> A X = B by the factors P L U of A, which replace it; X replaces B. INFO > 0: that pivot is zero, and B stays.
      pure subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in)     :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out)    :: ipiv(*), info
      end subroutine dgesv

      !> As dgesv, of complex A and B.
      pure subroutine zgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in)        :: n, nrhs, lda, ldb
         complex(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out)       :: ipiv(*), info
      end subroutine zgesv

      !> Estimates the 1-norm of a matrix from a few products with it. Begin with KASE = 0. On return KASE = 1 asks for X = A X,
      !! KASE = 2 for X = A^T X, each before the next call; KASE = 0 ends the estimate EST = norm(V)/norm(W), V = A W.
      pure subroutine dlacn2(n, v, x, isgn, est, kase, isave)
         import :: wp
         integer, intent(in)     :: n
         real(wp), intent(inout) :: v(*), x(*), est
         integer, intent(inout)  :: isgn(*), kase, isave(3)
      end subroutine dlacn2

      !> A X = B by the factor A = L L^T, which replaces A; X replaces B. INFO > 0: A is not positive definite, and B stays.
      pure subroutine dposv(uplo, n, nrhs, a, lda, b, ldb, info)
         import :: wp
         character, intent(in)   :: uplo
         integer, intent(in)     :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out)    :: info
      end subroutine dposv

      !> A = L L^T in place; INFO > 0: the leading minor of that order is not positive.
      pure subroutine dpotrf(uplo, n, a, lda, info)
         import :: wp
         character, intent(in)   :: uplo
         integer, intent(in)     :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out)    :: info
      end subroutine dpotrf

      !> P^T A P = L L^T in place, A symmetric and positive semidefinite: the largest remaining pivot first, until none exceeds TOL.
      !! PIV are the rows of A in this order, of which RANK have a pivot.
      pure subroutine dpstrf(uplo, n, a, lda, piv, rank, tol, work, info)
         import :: wp
         character, intent(in)   :: uplo
         integer, intent(in)     :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out)    :: piv(*), rank, info
         real(wp), intent(in)    :: tol
         real(wp), intent(inout) :: work(*) !! (2 N)
      end subroutine dpstrf

      !> All eigenvalues W, ascending, and eigenvectors (returned in A) of A x = w B x (ITYPE = 1); B is positive definite, x^T
      !! B x = 1.
      subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
         import :: wp
         integer, intent(in)     :: itype, n, lda, ldb, lwork
         character, intent(in)   :: jobz, uplo
         real(wp), intent(inout) :: a(lda, *), b(ldb, *), w(*), work(*)
         integer, intent(out)    :: info
      end subroutine dsygv

      !> C = alpha A A^T + beta C (TRANS = 'N'), only the triangle UPLO of C
      pure subroutine dsyrk(uplo, trans, n, k, alpha, a, lda, beta, c, ldc)
         import :: wp
         character, intent(in)   :: uplo, trans
         integer, intent(in)     :: n, k, lda, ldc
         real(wp), intent(in)    :: alpha, beta, a(lda, *)
         real(wp), intent(inout) :: c(ldc, *)
      end subroutine dsyrk

      !> y = alpha A x + beta y, A symmetric
      pure subroutine dsymv(uplo, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: wp
         character, intent(in)   :: uplo
         integer, intent(in)     :: n, lda, incx, incy
         real(wp), intent(in)    :: alpha, beta, a(lda, *), x(*)
         real(wp), intent(inout) :: y(*)
      end subroutine dsymv

      !> x = op(A) x, A triangular
      pure subroutine dtrmv(uplo, trans, diag, n, a, lda, x, incx)
         import :: wp
         character, intent(in)   :: uplo, trans, diag
         integer, intent(in)     :: n, lda, incx
         real(wp), intent(in)    :: a(lda, *)
         real(wp), intent(inout) :: x(*)
      end subroutine dtrmv

      !> x = op(inv(A)) x, A triangular
      pure subroutine dtrsv(uplo, trans, diag, n, a, lda, x, incx)
         import :: wp
         character, intent(in)   :: uplo, trans, diag
         integer, intent(in)     :: n, lda, incx
         real(wp), intent(in)    :: a(lda, *)
         real(wp), intent(inout) :: x(*)
      end subroutine dtrsv

      !> B = alpha op(inv(A)) B or alpha B op(inv(A)), A triangular
      pure subroutine dtrsm(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb)
         import :: wp
         character, intent(in)   :: side, uplo, transa, diag
         integer, intent(in)     :: m, n, lda, ldb
         real(wp), intent(in)    :: alpha, a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
      end subroutine dtrsm

   end interface

end module blas_lapack
