!> Measures the memory of the machine and sets the memory allocator and the threads of the program.
!! Linux gives the figures in the text files of /proc and /sys. The control groups give the limits of containers, batch systems and
!! systemd.
!! Source: Linux, Documentation/admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst; man 7 cgroups for /proc/self/cgroup.
module machine
   use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_loc, c_long, c_size_t
   use kinds, only: long, wp
   use omp_lib, only: omp_get_max_threads, omp_get_num_procs, omp_set_num_threads
   implicit none
   private

   public :: available_memory, memory_for, peak_memory, keep_memory, return_memory, give_back, &
             has_huge_pages, use_threads, kernel_figure, &
             memory_left_by_groups, &
             address_space_left, reserve_for_threads, note_first_call, for_threads, openblas_set_num_threads

   ! parameters of mallopt, malloc.h of glibc
   integer(c_int), parameter :: trim_threshold = -1, top_pad = -2, mmap_threshold = -3, mmap_max = -4, arena_max = -8
   integer(c_int), parameter :: dont_need = 4       ! advice of madvise, sys/mman.h of Linux
   integer(c_intptr_t), parameter :: page = 4096    ! size of a page of memory [bytes]; where pages are larger madvise refuses

   integer(long) :: of_thread = 0 ! address space that each thread will take for itself [bytes]
   integer :: n_served = 0        ! threads that have it

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

      integer(c_int) function madvise(first, length, advice) bind(c, name='madvise')
         import :: c_int, c_intptr_t, c_size_t
         integer(c_intptr_t), value :: first
         integer(c_size_t), value   :: length
         integer(c_int), value      :: advice
      end function madvise

      type(heap_figures) function mallinfo2() bind(c)
         import :: heap_figures
      end function mallinfo2

      integer(c_int) function pthread_getattr_default_np(attributes) bind(c, name='pthread_getattr_default_np')
         import :: c_int, c_long
         integer(c_long), intent(inout) :: attributes(*)
      end function pthread_getattr_default_np

      integer(c_int) function pthread_setattr_default_np(attributes) bind(c, name='pthread_setattr_default_np')
         import :: c_int, c_long
         integer(c_long), intent(in) :: attributes(*)
      end function pthread_setattr_default_np

      integer(c_int) function pthread_attr_getstacksize(attributes, bytes) bind(c, name='pthread_attr_getstacksize')
         import :: c_int, c_long, c_size_t
         integer(c_long), intent(in)    :: attributes(*)
         integer(c_size_t), intent(out) :: bytes
      end function pthread_attr_getstacksize

      integer(c_int) function pthread_attr_setstacksize(attributes, bytes) bind(c, name='pthread_attr_setstacksize')
         import :: c_int, c_long, c_size_t
         integer(c_long), intent(inout) :: attributes(*)
         integer(c_size_t), value       :: bytes
      end function pthread_attr_setstacksize

      subroutine openblas_set_num_threads(n) bind(c, name='openblas_set_num_threads')
         import :: c_int
         integer(c_int), value :: n
      end subroutine openblas_set_num_threads
   end interface

   integer(long), parameter, public :: no_figure = huge(1_long) !! unreadable, or a word such as `max`

contains

   !> Keep deallocated memory in the program for the next allocation: new pages cost a sixth of a factorisation. Where glibc
   !! refuses, nothing is lost.
   subroutine keep_memory()
      integer, allocatable, volatile :: first(:)
      integer(c_int) :: status

      status = mallopt(trim_threshold, huge(1_c_int))
      status = mallopt(top_pad, 64_c_int*1048576_c_int)
      status = mallopt(mmap_max, 0_c_int)
      allocate (first(131072)) ! the heap grows here, where the status is checked: the compiler does not check every allocation
      first(1) = 0
      deallocate (first)
   end subroutine keep_memory

   !> Take large arrays from the machine and return them to it from now on: for a run with few large arrays that stay, whose
   !! preparation takes as much memory again.
   subroutine return_memory()
      integer(c_int), parameter :: large = 4_c_int*1048576_c_int
      integer(c_int) :: status

      status = mallopt(mmap_max, 65536_c_int)
      status = mallopt(mmap_threshold, large)
      status = mallopt(trim_threshold, 2_c_int*large)
      status = mallopt(top_pad, large)
      status = malloc_trim(0_c_size_t)
   end subroutine return_memory

   !> Return the whole pages inside A, a(first + 1) to a(last - 1), to the machine. They read as zero and take memory again when
   !! written. OK is false where this is refused. A must be on the heap.
   subroutine give_back(n, a, ok, first, last)
      integer(long), intent(in)       :: n
      real(wp), intent(inout), target :: a(n)
      logical, intent(out)            :: ok
      integer(long), intent(out)      :: first, last
      integer(c_intptr_t), parameter  :: bytes = storage_size(1.0_wp)/8
      integer(c_intptr_t) :: begin, end

      begin = transfer(c_loc(a), begin)
      end = begin + bytes*n
      first = (page*((begin + page - 1)/page) - begin)/bytes
      last = (page*(end/page) - begin)/bytes + 1
      ok = last - 1 > first
      if (ok) ok = madvise(begin + bytes*first, int(bytes*(last - 1 - first), c_size_t), dont_need) == 0
   end subroutine give_back

   !> Whether the heap is in huge pages, 2 MiB on x86-64: entries of a matrix that are not touched then take memory too.
   logical function has_huge_pages()
      character(1000) :: tunables
      integer :: status

      call get_environment_variable('GLIBC_TUNABLES', tunables, status=status)
      has_huge_pages = status == 0 .and. index(tunables, 'glibc.malloc.hugetlb=1') > 0
   end function has_huge_pages

   !> Memory that the program can still take [bytes]: the least of the free memory of the machine, the rest of its control groups (a
   !! container's limit) and the rest of a limit on its address space; huge where none of them can be read.
   function available_memory() result(bytes)
      integer(long)      :: bytes, left
      type(heap_figures) :: heap

      bytes = min(kernel_figure('/proc/meminfo', 'MemAvailable:', 1024), memory_left_by_groups(''))
      left = address_space_left()
      if (left == no_figure) return
      heap = mallinfo2()
      bytes = min(bytes, max(0_long, left + heap%fordblks - for_threads()))
   end function available_memory

   !> What a limit on the address space of this program leaves [bytes]; huge where there is none.
   function address_space_left() result(bytes)
      integer(long) :: bytes, taken

      bytes = kernel_figure('/proc/self/limits', 'Max address space', 1)
      taken = kernel_figure('/proc/self/status', 'VmSize:', 1024)
      if (taken == no_figure) bytes = no_figure
      if (bytes /= no_figure) bytes = bytes - taken
   end function address_space_left

   !> Each thread will take BYTES of address space for itself, which the arrays cannot have: the buffer of its first call of OpenBLAS.
   subroutine reserve_for_threads(bytes)
      integer(long), intent(in) :: bytes

      of_thread = bytes
   end subroutine reserve_for_threads

   !> One thread has taken its space. Whether others have is not known.
   subroutine note_first_call()
      n_served = 1
   end subroutine note_first_call

   !> What the threads will still take for themselves [bytes].
   integer(long) function for_threads()
      for_threads = (omp_get_max_threads() - n_served)*of_thread
   end function for_threads

   !> Memory that the program can still take [bytes]. Where it is less than the bytes WANTED, the memory kept for reuse is returned
   !! first. It is not returned earlier, because its pages would have to be made anew.
   function memory_for(wanted) result(bytes)
      real(wp), intent(in) :: wanted
      integer(long)  :: bytes
      integer(c_int) :: status

      bytes = available_memory()
      if (wanted <= real(bytes, wp)) return
      status = malloc_trim(0_c_size_t)
      bytes = available_memory()
   end function memory_for

   !> The peak memory of this program [bytes]; huge where it cannot be read.
   function peak_memory() result(bytes)
      integer(long) :: bytes

      bytes = kernel_figure('/proc/self/status', 'VmHWM:', 1024)
   end function peak_memory

   !> Use at most N threads, 0: OMP_NUM_THREADS, and never more than there are cores. BLAS has one thread in each: one order of
   !! additions gives the same digits everywhere. All threads share one heap, so that one reuses what another has deallocated; this
   !! must be set before the threads exist. Their stacks have the user's limit (ulimit -s), but at least the usual size.
   subroutine use_threads(n)
      integer, intent(in) :: n
      integer(c_size_t), parameter :: usual = 8388608_c_size_t ! bytes of a stack, ulimit -s 8192
      integer(c_long)   :: attributes(64)                      ! a pthread_attr_t of glibc has 56 bytes
      integer(c_size_t) :: stack
      integer(c_int)    :: status

      status = mallopt(arena_max, 1_c_int)
      attributes = 0
      stack = usual
      if (pthread_getattr_default_np(attributes) == 0) status = pthread_attr_getstacksize(attributes, stack)
      if (stack < usual) then ! a small limit of the user is not enough for the element kernels
         if (pthread_attr_setstacksize(attributes, usual) == 0) status = pthread_setattr_default_np(attributes)
      end if
      call openblas_set_num_threads(1_c_int)
      call omp_set_num_threads(min(merge(n, omp_get_max_threads(), n > 0), omp_get_num_procs()))
   end subroutine use_threads

   !> The figure after NAME in the file PATH [bytes], where it stands in the given units; an empty NAME: the figure alone in the first
   !! line. Huge where there is none.
   function kernel_figure(path, name, unit_bytes) result(bytes)
      character(*), intent(in) :: path, name
      integer, intent(in)      :: unit_bytes
      integer(long) :: bytes
      character(80) :: line
      integer :: unit, status

      bytes = no_figure
      open (newunit=unit, file=path, action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, name) == 1) then
            read (line(len(name) + 1:), *, iostat=status) bytes
            bytes = merge(unit_bytes*bytes, no_figure, status == 0)
            exit
         end if
      end do
      close (unit)
   end function kernel_figure

   !> The memory left in the control groups of this program, from its own group up to the root: the least of their limits less the
   !! memory in use [bytes]; huge where no group has a limit. ROOT is the prefix of /proc and /sys, empty except in tests. A line of
   !! the group file is `number:controllers:path`: version 2 has number 0 and no controllers, version 1 names its controllers.
   function memory_left_by_groups(root) result(bytes)
      character(*), intent(in) :: root
      integer(long)   :: bytes, limit, reclaimable, used
      character(4096) :: line
      character(:), allocatable :: folder, path
      character(24) :: names(3) ! the files of limit and memory of a group, and the reclaimable part of the memory
      integer :: first, second, status, unit

      bytes = no_figure
      folder = ''
      open (newunit=unit, file=root//'/proc/self/cgroup', action='read', status='old', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         first = index(line, ':')
         second = first + index(line(first + 1:), ':')
         if (first == 0 .or. second == first) cycle
         if (second == first + 1) then
            folder = root//'/sys/fs/cgroup'
            names = [character(24) :: '/memory.max', '/memory.current', 'inactive_file']
         else if (index(','//line(first + 1:second - 1)//',', ',memory,') > 0) then
            folder = root//'/sys/fs/cgroup/memory'
            names = [character(24) :: '/memory.limit_in_bytes', '/memory.usage_in_bytes', 'total_inactive_file']
         else
            cycle
         end if
         path = trim(line(second + 1:))
         do ! in a container these groups may be absent, or the path is that of the host: they give no limit
            limit = kernel_figure(folder//path//trim(names(1)), '', 1)
            used = kernel_figure(folder//path//trim(names(2)), '', 1)
            if (limit /= no_figure .and. used /= no_figure) then ! unused file pages do not count, the kernel reclaims them
               reclaimable = kernel_figure(folder//path//'/memory.stat', trim(names(3))//' ', 1)
               if (reclaimable /= no_figure) used = max(0_long, used - reclaimable)
               bytes = min(bytes, max(0_long, limit - used))
            end if
            if (path == '') exit
            path = path(:index(path, '/', back=.true.) - 1)
         end do
      end do
      close (unit)
   end function memory_left_by_groups

end module machine
