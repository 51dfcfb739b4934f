!> Defines the kinds of real and integer numbers used throughout.
module kinds
   use, intrinsic :: iso_fortran_env, only: int64, real64
   implicit none
   private

   integer, parameter, public :: wp   = real64 !! working precision of every real
   integer, parameter, public :: long = int64  !! positions in files, in the profile, operation counts

end module kinds
