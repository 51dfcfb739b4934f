!> What a linear least-squares problem says of its unknowns, from the singular values of its matrix: covariance, which rows
!! determine which unknown, and unknowns that no row determines. The rows are divided by their standard deviations.
module fit_statistics
   use kinds, only: wp
   implicit none
   private

   public :: weigh

   type, public :: statistics_type
      real(wp), allocatable :: deviation(:)      !! (unknowns) standard deviations
      real(wp), allocatable :: correlation(:, :) !! (unknowns, unknowns)
      real(wp), allocatable :: share(:, :)       !! (rows, unknowns) of the variance of the unknown, from the deviation of the row
      real(wp) :: least = 0.0_wp, largest = 0.0_wp !! singular values
      integer  :: weakest = 0                    !! the unknown with the largest part in the direction of the least one
   end type statistics_type

   interface
      subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
         import :: wp
         character, intent(in)   :: jobu, jobvt
         integer, intent(in)     :: m, n, lda, ldu, ldvt, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out)   :: s(*), u(ldu, *), vt(ldvt, *), work(*)
         integer, intent(out)    :: info
      end subroutine dgesvd
   end interface

contains

   !> The statistics of the unknowns with the weighted JACOBIAN (rows, unknowns), which has no fewer rows than unknowns.
   subroutine weigh(jacobian, statistics)
      real(wp), intent(in)               :: jacobian(:, :)
      type(statistics_type), intent(out) :: statistics
      real(wp) :: a(size(jacobian, 1), size(jacobian, 2)), inverse(size(jacobian, 2), size(jacobian, 1))
      real(wp) :: s(size(jacobian, 2)), u(size(jacobian, 1), size(jacobian, 2)), vt(size(s), size(s))
      real(wp) :: covariance(size(s), size(s)), work(10*size(jacobian) + 100)
      integer  :: info, k

      a = jacobian
      associate (m => size(a, 1), n => size(s))
         call dgesvd('S', 'S', m, n, a, m, s, u, m, vt, n, work, size(work), info)
         statistics%least = s(n)
         statistics%largest = s(1)
         statistics%weakest = maxloc(abs(vt(n, :)), dim=1)
         s = max(s, tiny(1.0_wp)**0.25_wp)
         inverse = matmul(transpose(vt/spread(s, 2, n)), transpose(u))
         covariance = matmul(inverse, transpose(inverse))
         statistics%deviation = [(sqrt(covariance(k, k)), k = 1, n)]
         statistics%correlation = covariance/(spread(statistics%deviation, 1, n)*spread(statistics%deviation, 2, n))
         statistics%share = transpose(inverse**2)/spread(statistics%deviation**2, 1, m)
      end associate
   end subroutine weigh

end module fit_statistics
