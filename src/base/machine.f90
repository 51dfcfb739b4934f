!> What the machine has, and what the program has taken of it.
module machine
   use, intrinsic :: iso_c_binding, only: c_int, c_size_t
   use kinds, only: long
   use omp_lib, only: omp_get_max_threads
   implicit none
   private

   public :: available_memory, peak_memory, keep_memory

   integer(long), parameter :: unknown = huge(1_long) ! a figure that cannot be read
   integer(c_int), parameter :: trim_threshold = -1, top_pad = -2, mmap_max = -4 ! parameters of mallopt, malloc.h of glibc

   !> What a thread's first call of OpenBLAS takes of the address space; where it cannot have that it tries for ever.
   integer(long), parameter :: blas_buffer = 134217728_long ! BUFFER_SIZE of its common_x86_64.h

   type, bind(c) :: heap_figures ! struct mallinfo2 of glibc's malloc.h
      integer(c_size_t) :: arena, ordblks, smblks, hblks, hblkhd, usmblks, fsmblks, uordblks, fordblks, keepcost
   end type heap_figures

   interface
      integer(c_int) function mallopt(parameter, value) bind(c, name='mallopt')
         import :: c_int
         integer(c_int), value :: parameter, value
      end function mallopt

      integer(c_int) function malloc_trim(left) bind(c, name='malloc_trim')
         import :: c_int, c_size_t
         integer(c_size_t), value :: left
      end function malloc_trim

      type(heap_figures) function mallinfo2() bind(c)
         import :: heap_figures
      end function mallinfo2
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


   !> Memory that the program can still take, of what the machine has free and what a limit on its address space leaves [bytes];
   !! huge where neither can be read. What has been kept of an earlier deck is given back first, or counted as free.
   function available_memory() result(bytes)
      integer(long)      :: bytes, limit, taken
      integer(c_int)     :: status
      type(heap_figures) :: heap

      status = malloc_trim(0_c_size_t)
      bytes = kernel_figure('/proc/meminfo', 'MemAvailable:', 1024)
      limit = kernel_figure('/proc/self/limits', 'Max address space', 1)
      taken = kernel_figure('/proc/self/status', 'VmSize:', 1024)
      if (limit == unknown .or. taken == unknown) return
      heap = mallinfo2()
      bytes = min(bytes, max(0_long, limit - taken + heap%fordblks - omp_get_max_threads()*blas_buffer))
   end function available_memory


   !> The most memory that this program has had [bytes]; huge where that cannot be read.
   function peak_memory() result(bytes)
      integer(long) :: bytes

      bytes = kernel_figure('/proc/self/status', 'VmHWM:', 1024)
   end function peak_memory


   !> The figure that stands behind NAME in a file of the kernel, there in units of so many bytes [bytes].
   function kernel_figure(path, name, unit_bytes) result(bytes)
      character(*), intent(in) :: path, name
      integer, intent(in)      :: unit_bytes
      integer(long) :: bytes
      character(80) :: line
      integer :: unit, status

      bytes = unknown
      open (newunit=unit, file=path, action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, name) == 1) then
            read (line(len(name) + 1:), *, iostat=status) bytes
            bytes = merge(unit_bytes*bytes, unknown, status == 0)
            exit
         end if
      end do
      close (unit)
   end function kernel_figure

end module machine
