!> The checksum of bytes: CRC-64 as in the xz format.
!! It detects every damage within 64 consecutive bits, and any other damage but with a probability of 2**-64.
!! Source: ECMA-182, annex B (polynomial), in the reflected form of the .xz file format 1.1.0, section 6; the sum of '123456789'
!! is 995DC9BBDF1939FA.
module checksum
   use, intrinsic :: iso_fortran_env, only: int64
   use kinds, only: long
   implicit none
   private

   public :: add_to_checksum

   integer(int64), parameter, public :: no_bytes = 0_int64 !! the checksum of no bytes, the start value

   integer :: i
   integer(int64), parameter :: polynomial = ior(shiftl(int(z'C96C5795', int64), 32), int(z'D7870F42', int64))

   ! the remainder of each byte after eight shifts
   integer(int64), parameter :: t0(0:255) = [(int(i, int64), i = 0, 255)]
   integer(int64), parameter :: t1(0:255) = ieor(shiftr(t0, 1), iand(t0, 1_int64)*polynomial)
   integer(int64), parameter :: t2(0:255) = ieor(shiftr(t1, 1), iand(t1, 1_int64)*polynomial)
   integer(int64), parameter :: t3(0:255) = ieor(shiftr(t2, 1), iand(t2, 1_int64)*polynomial)
   integer(int64), parameter :: t4(0:255) = ieor(shiftr(t3, 1), iand(t3, 1_int64)*polynomial)
   integer(int64), parameter :: t5(0:255) = ieor(shiftr(t4, 1), iand(t4, 1_int64)*polynomial)
   integer(int64), parameter :: t6(0:255) = ieor(shiftr(t5, 1), iand(t5, 1_int64)*polynomial)
   integer(int64), parameter :: t7(0:255) = ieor(shiftr(t6, 1), iand(t6, 1_int64)*polynomial)
   integer(int64), parameter :: table(0:255) = ieor(shiftr(t7, 1), iand(t7, 1_int64)*polynomial)

contains

   !> Extend the checksum SUM by BYTES.
   pure subroutine add_to_checksum(bytes, sum)
      character(*), intent(in)      :: bytes
      integer(int64), intent(inout) :: sum
      integer(long) :: k

      sum = not(sum)
      do k = 1, len(bytes, long)
         sum = ieor(table(ieor(int(iand(sum, 255_int64)), iachar(bytes(k:k)))), shiftr(sum, 8))
      end do
      sum = not(sum)
   end subroutine add_to_checksum

end module checksum
