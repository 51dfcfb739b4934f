!> What the machine has, and what the program has taken of it.
module machine
   use, intrinsic :: iso_c_binding, only: c_int
   use kinds, only: long
   implicit none
   private

   public :: available_memory, peak_memory, keep_memory

   integer(c_int), parameter :: trim_threshold = -1, top_pad = -2, mmap_max = -4 ! parameters of mallopt, malloc.h of glibc

   interface
      integer(c_int) function mallopt(parameter, value) bind(c, name='mallopt')
         import :: c_int
         integer(c_int), value :: parameter, value
      end function mallopt
   end interface

contains

   !> What is deallocated stays with the program for the next allocation: new pages cost a sixth of a factorisation. Where glibc
   !! does not do it nothing is lost.
   subroutine keep_memory()
      integer(c_int) :: status

      status = mallopt(trim_threshold, huge(1_c_int))
      status = mallopt(top_pad, 64_c_int*1048576_c_int)
      status = mallopt(mmap_max, 0_c_int)
   end subroutine keep_memory


   !> Memory that a program can still take [bytes]; huge where that cannot be read.
   function available_memory() result(bytes)
      integer(long) :: bytes

      bytes = kernel_figure('/proc/meminfo', 'MemAvailable:')
   end function available_memory


   !> The most memory that this program has had [bytes]; huge where that cannot be read.
   function peak_memory() result(bytes)
      integer(long) :: bytes

      bytes = kernel_figure('/proc/self/status', 'VmHWM:')
   end function peak_memory


   !> The figure that stands behind NAME in a file of the kernel, kibibytes there [bytes].
   function kernel_figure(path, name) result(bytes)
      character(*), intent(in) :: path, name
      integer(long) :: bytes
      character(80) :: line
      integer :: unit, status

      bytes = huge(bytes)
      open (newunit=unit, file=path, action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, name) == 1) then
            read (line(len(name) + 1:), *, iostat=status) bytes
            if (status == 0) bytes = 1024*bytes
            exit
         end if
      end do
      close (unit)
   end function kernel_figure

end module machine
