! The routines of BLAS and LAPACK that the solvers call, written out: linked before OpenBLAS they let a sanitizer see which entries
! are read and written. As far as the program calls them; another case stops. See src/base/blas_lapack.f90.

subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
   use, intrinsic :: iso_fortran_env, only: wp => real64
   implicit none
   character, intent(in)   :: transa, transb
   integer, intent(in)     :: m, n, k, lda, ldb, ldc
   real(wp), intent(in)    :: alpha, beta, a(lda, *), b(ldb, *)
   real(wp), intent(inout) :: c(ldc, *)
   real(wp) :: factor
   integer  :: i, j, l

   do j = 1, n
      if (.not. abs(beta) > 0.0_wp) c(:m, j) = 0.0_wp
      if (abs(beta) > 0.0_wp) c(:m, j) = beta*c(:m, j)
      do l = 1, k
         if (transb == 'T') then
            factor = alpha*b(j, l)
         else
            factor = alpha*b(l, j)
         end if
         do i = 1, m
            if (transa == 'T') then
               c(i, j) = c(i, j) + factor*a(l, i)
            else
               c(i, j) = c(i, j) + factor*a(i, l)
            end if
         end do
      end do
   end do
end subroutine dgemm

subroutine dpotrf(uplo, n, a, lda, info)
   use, intrinsic :: iso_fortran_env, only: wp => real64
   implicit none
   character, intent(in)   :: uplo
   integer, intent(in)     :: n, lda
   real(wp), intent(inout) :: a(lda, *)
   integer, intent(out)    :: info
   integer :: i, j, l

   if (uplo /= 'L') error stop 'plain_blas: another case of DPOTRF'
   do j = 1, n
      do l = 1, j - 1
         do i = j, n
            a(i, j) = a(i, j) - a(i, l)*a(j, l)
         end do
      end do
      info = j
      if (.not. a(j, j) > 0.0_wp) return
      a(j, j) = sqrt(a(j, j))
      do i = j + 1, n
         a(i, j) = a(i, j)/a(j, j)
      end do
   end do
   info = 0
end subroutine dpotrf

subroutine dtrsm(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb)
   use, intrinsic :: iso_fortran_env, only: wp => real64
   implicit none
   character, intent(in)   :: side, uplo, transa, diag
   integer, intent(in)     :: m, n, lda, ldb
   real(wp), intent(in)    :: alpha, a(lda, *)
   real(wp), intent(inout) :: b(ldb, *)
   integer :: i, j, l

   if (uplo /= 'L' .or. diag /= 'N' .or. abs(alpha - 1.0_wp) > 0.0_wp) error stop 'plain_blas: another case of DTRSM'
   if (side == 'R' .and. transa == 'T') then
      do j = 1, n
         do l = 1, j - 1
            do i = 1, m
               b(i, j) = b(i, j) - b(i, l)*a(j, l)
            end do
         end do
         do i = 1, m
            b(i, j) = b(i, j)/a(j, j)
         end do
      end do
   else if (side == 'L' .and. transa == 'N') then
      do j = 1, n
         do i = 1, m
            b(i, j) = b(i, j)/a(i, i)
            do l = i + 1, m
               b(l, j) = b(l, j) - a(l, i)*b(i, j)
            end do
         end do
      end do
   else if (side == 'L') then
      do j = 1, n
         do i = m, 1, -1
            do l = i + 1, m
               b(i, j) = b(i, j) - a(l, i)*b(l, j)
            end do
            b(i, j) = b(i, j)/a(i, i)
         end do
      end do
   else
      error stop 'plain_blas: another case of DTRSM'
   end if
end subroutine dtrsm

subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
   use, intrinsic :: iso_fortran_env, only: wp => real64
   implicit none
   character, intent(in)   :: trans
   integer, intent(in)     :: m, n, lda, incx, incy
   real(wp), intent(in)    :: alpha, beta, a(lda, *), x(*)
   real(wp), intent(inout) :: y(*)
   integer :: i, j

   if (incx /= 1 .or. incy /= 1) error stop 'plain_blas: another case of DGEMV'
   do i = 1, merge(m, n, trans == 'N')
      if (abs(beta) > 0.0_wp) then
         y(i) = beta*y(i)
      else
         y(i) = 0.0_wp
      end if
   end do
   do j = 1, n
      do i = 1, m
         if (trans == 'N') y(i) = y(i) + alpha*a(i, j)*x(j)
         if (trans == 'T') y(j) = y(j) + alpha*a(i, j)*x(i)
      end do
   end do
end subroutine dgemv

subroutine dsymv(uplo, n, alpha, a, lda, x, incx, beta, y, incy)
   use, intrinsic :: iso_fortran_env, only: wp => real64
   implicit none
   character, intent(in)   :: uplo
   integer, intent(in)     :: n, lda, incx, incy
   real(wp), intent(in)    :: alpha, a(lda, *), x(*), beta
   real(wp), intent(inout) :: y(*)
   integer :: i, j

   if (uplo /= 'L' .or. incx /= 1 .or. incy /= 1) error stop 'plain_blas: another case of DSYMV'
   do i = 1, n
      if (abs(beta) > 0.0_wp) then
         y(i) = beta*y(i)
      else
         y(i) = 0.0_wp
      end if
   end do
   do j = 1, n
      y(j) = y(j) + alpha*a(j, j)*x(j)
      do i = j + 1, n
         y(i) = y(i) + alpha*a(i, j)*x(j)
         y(j) = y(j) + alpha*a(i, j)*x(i)
      end do
   end do
end subroutine dsymv

subroutine dtrsv(uplo, trans, diag, n, a, lda, x, incx)
   use, intrinsic :: iso_fortran_env, only: wp => real64
   implicit none
   character, intent(in)   :: uplo, trans, diag
   integer, intent(in)     :: n, lda, incx
   real(wp), intent(in)    :: a(lda, *)
   real(wp), intent(inout) :: x(*)
   integer :: i, j

   if (uplo /= 'L' .or. diag /= 'N' .or. incx /= 1) error stop 'plain_blas: another case of DTRSV'
   if (trans == 'N') then
      do j = 1, n
         x(j) = x(j)/a(j, j)
         do i = j + 1, n
            x(i) = x(i) - a(i, j)*x(j)
         end do
      end do
   else
      do j = n, 1, -1
         do i = j + 1, n
            x(j) = x(j) - a(i, j)*x(i)
         end do
         x(j) = x(j)/a(j, j)
      end do
   end if
end subroutine dtrsv
