!> The routines of ARPACK that find a few eigenvalues of a large symmetric problem (Lehoucq, Sorensen, Yang, ARPACK Users' Guide, SIAM
!! 1998), by reverse communication: the caller does what IDO asks for, and calls again.
module arpack
   use kinds, only: wp
   implicit none
   private

   public :: dsaupd, dseupd

   interface

      !> One step of the implicitly restarted Lanczos method.
      subroutine dsaupd(ido, bmat, n, which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, workd, workl, lworkl, info)
         import :: wp
         integer, intent(inout)      :: ido
         character, intent(in)       :: bmat
         integer, intent(in)         :: n, nev, ncv, ldv, lworkl
         character(2), intent(in)    :: which
         real(wp), intent(in)        :: tol
         real(wp), intent(inout)     :: resid(n), v(ldv, ncv), workd(3*n), workl(lworkl)
         integer, intent(inout)      :: iparam(11), ipntr(11), info
      end subroutine dsaupd

      !> The eigenvalues D and, where RVEC, eigenvectors Z that dsaupd has come to; what follows SIGMA is as dsaupd left it.
      subroutine dseupd(rvec, howmny, select, d, z, ldz, sigma, bmat, n, which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, &
                        workd, workl, lworkl, info)
         import :: wp
         logical, intent(in)         :: rvec
         character, intent(in)       :: howmny, bmat
         integer, intent(in)         :: ldz, n, nev, ncv, ldv, lworkl
         logical, intent(inout)      :: select(ncv)
         real(wp), intent(inout)     :: d(nev), z(ldz, nev)
         real(wp), intent(in)        :: sigma, tol
         character(2), intent(in)    :: which
         real(wp), intent(inout)     :: resid(n), v(ldv, ncv), workd(2*n), workl(lworkl)
         integer, intent(inout)      :: iparam(7), ipntr(11), info
      end subroutine dseupd
   end interface

end module arpack
