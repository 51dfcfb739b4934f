!> Prepares OpenBLAS: takes a kernel that suits the processor, and measures the buffer that a thread needs at its first call.
!! OpenBLAS compares the number of the processor with those that it knows; where it knows none, it takes a kernel without AVX2, two
!! to three times slower. Prepares OpenMP: a thread that waits for another one sleeps after a short while; libgomp alone lets it
!! count to 300,000 first, on the processor that the other thread wants where other programs run: five to ten times slower. On many
!! processors it asks for huge pages: threads that touch new memory at the same time wait for each other at every page.
!! Environment variables are read only when a library is loaded: the program starts itself anew.
!! Source: OpenBLAS, driver/others/dynamic.c (OPENBLAS_CORETYPE, openblas_get_corename), memory.c (one buffer a thread); GNU Offloading
!! and Multi Processing Runtime Library, section 4.21 (GOMP_SPINCOUNT); GNU C Library, section 38.2 (glibc.malloc.hugetlb).
module openblas
   use blas_lapack, only: dgemm, dpotrf, dsyrk, dtrsm
   use c_library, only: c_isatty
   use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_int, c_loc, c_long, c_null_char, c_null_ptr, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: long, wp
   use machine, only: address_space_left, kernel_figure, no_figure, openblas_set_num_threads, reserve_for_threads
   use omp_lib, only: omp_get_max_threads, omp_get_num_procs
   use terminal, only: argument_text
   use tolerances, only: rounding_of_sums
   implicit none
   private

   public :: prepare_libraries, kernels_for, kernel_is_right, processor_flags, tell_kernel, kernel_words
   public :: c_fork, c_waitpid ! for side_by_side

   ! environment variables
   character(*), parameter :: choice = 'OPENBLAS_CORETYPE'      ! the kernel, of the user or of this program
   character(*), parameter :: mark = 'JOINTFEM_REPLACED_KERNEL' ! OpenBLAS's own kernel, for the program that is started anew
   character(*), parameter :: trial = 'JOINTFEM_TRIAL'          ! a process that only tries
   character(*), parameter :: spins = 'GOMP_SPINCOUNT'          ! what a thread counts before it sleeps
   character(*), parameter :: few_spins = '1000'                ! as libgomp where there are more threads than processors
   character(*), parameter :: more_spins = '20000'              ! on many processors
   character(*), parameter :: tunables = 'GLIBC_TUNABLES', huge_pages = 'glibc.malloc.hugetlb=1'
   integer, parameter :: many_processors = 8                    ! from which on threads rarely wait for a processor
   character(*), parameter :: space_trial = 'space', kernel_trial = 'kernel'

   character(*), parameter :: without_avx2 = ' Katmai Coppermine Northwood Prescott Banias Atom Core2 Penryn Dunnington '// &
      'Nehalem Athlon Opteron Opteron_SSE3 Barcelona Bobcat Nano Sandybridge Bulldozer Piledriver Steamroller '

   integer(long), parameter :: unit_bytes = 4194304_long !! of the space of a first call

   character(:), allocatable :: replaced !! OpenBLAS's own kernel, where the program runs with another

   interface
      type(c_ptr) function openblas_get_corename() bind(c, name='openblas_get_corename')
         import :: c_ptr
      end function openblas_get_corename

      integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
      end function c_strlen

      integer(c_int) function c_setenv(name, value, overwrite) bind(c, name='setenv')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*), value(*)
         integer(c_int), value :: overwrite
      end function c_setenv

      integer(c_int) function c_unsetenv(name) bind(c, name='unsetenv')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: name(*)
      end function c_unsetenv

      !> Returns only on failure.
      integer(c_int) function c_execv(path, arguments) bind(c, name='execv')
         import :: c_char, c_int, c_ptr
         character(kind=c_char), intent(in) :: path(*)
         type(c_ptr), intent(in) :: arguments(*)
      end function c_execv

      !> 0 in the child, the child's number in the parent, -1 on failure.
      integer(c_int) function c_fork() bind(c, name='fork')
         import :: c_int
      end function c_fork

      integer(c_int) function c_waitpid(child, status, options) bind(c, name='waitpid')
         import :: c_int
         integer(c_int), value       :: child, options
         integer(c_int), intent(out) :: status
      end function c_waitpid

      subroutine c_exit(status) bind(c, name='_exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit

      !> A signal after the time TIMES(3:4) [s, microseconds].
      integer(c_int) function c_setitimer(clock, times, before) bind(c, name='setitimer')
         import :: c_int, c_long, c_ptr
         integer(c_int), value       :: clock
         integer(c_long), intent(in) :: times(4)
         type(c_ptr), value          :: before
      end function c_setitimer
   end interface

contains

   !> At the start of the program: measure the first call, choose the kernel, let waiting threads sleep, or be the trial of another
   !! process. What the user has set stays.
   subroutine prepare_libraries()
      integer(long) :: left
      integer :: processors, threads
      logical :: has_space, is_changed

      select case (environment(trial))
      case (space_trial)
         call c_exit(int(space_of_first_call(), c_int))
      case (kernel_trial)
         call c_exit(merge(0_c_int, 1_c_int, kernel_is_right()))
      end select
      processors = omp_get_num_procs()
      threads = omp_get_max_threads()
      is_changed = environment(spins)//environment('OMP_WAIT_POLICY') == ''
      if (is_changed) call set(spins, trim(merge(more_spins, few_spins//' ', processors >= many_processors)))
      left = no_figure
      if (processors >= many_processors) left = address_space_left()
      if (processors >= many_processors .and. left == no_figure) then
         if (environment(tunables) == '') then
            call set(tunables, huge_pages)
            is_changed = .true.
         end if
      end if
      if (is_changed .and. threads > 1) call execute_this()
      replaced = environment(mark)
      call unset(mark)
      call measure_buffer(has_space)
      if (environment(choice) /= '') return
      if (has_space) call choose_kernel()
   end subroutine prepare_libraries

   !> Run with a kernel that suits the processor: where OpenBLAS has chosen a kernel without AVX2 on a processor that has AVX2, start
   !! this program anew with the first of kernels_for that computes right.
   subroutine choose_kernel()
      character(16), allocatable :: names(:)
      integer :: i

      allocate (names, source=kernels_for(kernel_name(), processor_flags('/proc/cpuinfo')))
      do i = 1, size(names)
         if (found_by_trial(kernel_trial, trim(names(i))) /= 0) cycle
         call set(mark, kernel_name())
         call set(choice, trim(names(i)))
         call execute_this()
         call unset(choice) ! it could not be started
         call unset(mark)
      end do
   end subroutine choose_kernel

   !> Names of the kernels to try, the best first, where OpenBLAS has chosen the kernel NAME on a processor with these FLAGS; none
   !! where its choice is good.
   pure function kernels_for(name, flags) result(names)
      character(*), intent(in)   :: name
      character(*), intent(in)   :: flags !! words as in /proc/cpuinfo
      character(16), allocatable :: names(:)

      names = [character(16) ::]
      if (index(without_avx2, ' '//name//' ') == 0 .or. .not. has([character(8) :: 'avx2', 'fma'])) return
      names = [character(16) :: 'Haswell']
      if (has([character(8) :: 'avx512f', 'avx512dq', 'avx512cd', 'avx512bw', 'avx512vl'])) &
         names = [character(16) :: 'SkylakeX', names]

   contains

      !> Whether all WORDS are among the flags.
      pure logical function has(words)
         character(*), intent(in) :: words(:)
         integer :: i

         has = all([(index(' '//flags//' ', ' '//trim(words(i))//' ') > 0, i = 1, size(words))])
      end function has

   end function kernels_for

   !> The flags of the first processor in the file PATH, as /proc/cpuinfo; empty where there is none.
   function processor_flags(path) result(flags)
      character(*), intent(in)  :: path
      character(:), allocatable :: flags
      character(8192) :: line
      integer :: status, unit

      flags = ''
      open (newunit=unit, file=path, action='read', status='old', iostat=status)
      if (status /= 0) return
      do while (flags == '')
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, 'flags') == 1) flags = trim(line(index(line, ':') + 1:))
      end do
      close (unit)
   end function processor_flags

   !> Say once, on the terminal, that the program runs with another kernel than OpenBLAS's choice.
   subroutine tell_kernel()
      if (replaced == '') return
      if (c_isatty(2_c_int) /= 0) write (error_unit, '(a)') 'jointfem: '//kernel_words()
   end subroutine tell_kernel

   !> The kernel in use, in words.
   function kernel_words() result(words)
      character(:), allocatable :: words

      words = 'OpenBLAS kernel '//kernel_name()
      if (replaced /= '') words = words//'; OpenBLAS itself takes '//replaced//' on this processor, which is slower'
   end function kernel_words

   !> The name of the kernel in use, as OpenBLAS gives it.
   function kernel_name() result(name)
      character(:), allocatable :: name
      character(kind=c_char), pointer :: text(:)
      type(c_ptr) :: pointer
      integer :: i

      pointer = openblas_get_corename()
      call c_f_pointer(pointer, text, [c_strlen(pointer)])
      allocate (character(size(text)) :: name)
      do i = 1, size(text)
         name(i:i) = text(i)
      end do
   end function kernel_name

   !> The value of the environment variable NAME; empty where it is not set.
   function environment(name) result(value)
      character(*), intent(in)  :: name
      character(:), allocatable :: value
      integer :: length, status

      call get_environment_variable(name, length=length, status=status)
      allocate (character(merge(length, 0, status == 0)) :: value)
      if (len(value) > 0) call get_environment_variable(name, value)
   end function environment

   !> Set the environment variable NAME to VALUE.
   subroutine set(name, value)
      character(*), intent(in) :: name, value
      integer(c_int) :: status

      status = c_setenv(name//c_null_char, value//c_null_char, 1_c_int)
      if (status /= 0) return ! no memory: the program goes on as it is
   end subroutine set

   !> Remove the environment variable NAME.
   subroutine unset(name)
      character(*), intent(in) :: name
      integer(c_int) :: status

      status = c_unsetenv(name//c_null_char)
      if (status /= 0) return
   end subroutine unset

   !> Replace this process by the same program with the same arguments. Returns only on failure.
   subroutine execute_this()
      character(:), allocatable, target :: texts ! the arguments, one behind the other
      type(c_ptr), allocatable :: arguments(:)
      integer, allocatable :: first(:)
      integer :: i, status

      allocate (first(0:command_argument_count()))
      texts = ''
      do i = 0, command_argument_count()
         first(i) = len(texts) + 1
         texts = texts//argument_text(i)//c_null_char
      end do
      arguments = [(c_loc(texts(first(i):first(i))), i = 0, command_argument_count()), c_null_ptr]
      status = c_execv('/proc/self/exe'//c_null_char, arguments)
      if (status /= 0) return
   end subroutine execute_this

   !> What another process of this program finds as its trial WHAT, with KERNEL (none: OpenBLAS's choice): 0 to 254; -1 where it crashes,
   !! hangs or cannot be started.
   integer function found_by_trial(what, kernel) result(found)
      character(*), intent(in) :: what, kernel
      integer(c_long), parameter :: half_second(4) = [0_c_long, 0_c_long, 0_c_long, 500000_c_long]
      integer(c_int), parameter  :: processor_time = 2 ! ITIMER_PROF of Linux; its signal ends a process
      integer(c_int) :: child, status

      found = -1
      call set(trial, what)
      if (kernel /= '') call set(choice, kernel)
      child = c_fork()
      if (child == 0) then
         if (c_setitimer(processor_time, half_second, c_null_ptr) == 0) call execute_this()
         call c_exit(255_c_int)
      end if
      call unset(trial)
      if (kernel /= '') call unset(choice)
      if (child < 0) return
      if (c_waitpid(child, status, 0_c_int) /= child) return
      if (iand(status, 127) == 0) found = ibits(status, 8, 8) ! it has ended by itself
      if (found == 255) found = -1
   end function found_by_trial

   !> Measure the address space that a thread takes at its first call of OpenBLAS, where that space is limited: without it OpenBLAS asks
   !! for ever, so that another process tries first. Where it does not succeed, more than what is left is needed.
   subroutine measure_buffer(has_space)
      logical, intent(out) :: has_space !! for the first call
      integer(long) :: left
      integer :: units

      has_space = .true.
      left = address_space_left()
      if (left == no_figure) return
      units = found_by_trial(space_trial, '')
      has_space = units >= 0
      call reserve_for_threads(merge(unit_bytes*units, left + unit_bytes, has_space))
   end subroutine measure_buffer

   !> The address space that the first call takes, in units, rounded up.
   integer function space_of_first_call() result(units)
      integer(long) :: before
      logical :: is_right

      before = kernel_figure('/proc/self/status', 'VmSize:', 1024)
      is_right = kernel_is_right()
      units = int((kernel_figure('/proc/self/status', 'VmSize:', 1024) - before + unit_bytes - 1)/unit_bytes)
      if (.not. is_right) units = max(units, 1)
   end function space_of_first_call

   !> Whether dgemm, dsyrk, dpotrf and dtrsm agree with plain loops, in blocks and below the size of a block.
   logical function kernel_is_right() result(is_right)
      integer, parameter :: sizes(2) = [11, 88]
      real(wp), allocatable :: a(:, :), b(:, :), c(:, :), l(:, :), x(:, :)
      integer :: i, info, j, n, s

      call openblas_set_num_threads(1_c_int)
      is_right = .true.
      do s = 1, size(sizes)
         n = sizes(s)
         allocate (a(n, n), b(n, n), c(n, n), l(n, n), x(n, n))
         do j = 1, n
            do i = 1, n
               a(i, j) = modulo(0.618_wp*i + 0.37_wp*j*j, 1.0_wp) - 0.5_wp
               b(i, j) = modulo(0.414_wp*j + 0.73_wp*i*i, 1.0_wp) - 0.5_wp
            end do
         end do
         c = b
         call dgemm('N', 'T', n, n, n, -1.0_wp, a, n, b, n, 1.0_wp, c, n)
         call compare(c, b, -1.0_wp, a, transpose(b), .false.)
         c = b
         call dgemm('T', 'N', n, n, n, 1.0_wp, a, n, b, n, 0.0_wp, c, n)
         call compare(c, 0.0_wp*b, 1.0_wp, transpose(a), b, .false.)
         c = b
         call dsyrk('L', 'N', n, n, -1.0_wp, a, n, 1.0_wp, c, n)
         call compare(c, b, -1.0_wp, a, transpose(a), .true.)
         l = 0.0_wp ! A positive definite matrix and its factor: L L^T gives it back
         call dsyrk('L', 'N', n, n, 1.0_wp, a, n, 0.0_wp, l, n)
         do i = 1, n
            l(i, i) = l(i, i) + 1.0_wp
         end do
         c = l
         call dpotrf('L', n, l, n, info)
         is_right = is_right .and. info == 0
         call compare(c, 0.0_wp*b, 1.0_wp, l, transpose(l), .true.)
         x = b
         call dtrsm('R', 'L', 'T', 'N', n, n, 1.0_wp, l, n, x, n)
         call compare(b, 0.0_wp*b, 1.0_wp, x, transpose(l), .false.)
         deallocate (a, b, c, l, x)
      end do

   contains

      !> Compare FOUND, of IS_LOWER only the lower triangle, with FIRST + FACTOR P Q by plain loops.
      subroutine compare(found, first, factor, p, q, is_lower)
         real(wp), intent(in) :: found(:, :), first(:, :), factor, p(:, :), q(:, :)
         logical, intent(in)  :: is_lower
         real(wp) :: column(size(p, 1)), sizes(size(p, 1))
         integer  :: j, k

         do j = 1, size(q, 2)
            column = first(:, j)
            sizes = abs(column)
            do k = 1, size(p, 2)
               column = column + factor*p(:, k)*q(k, j)
               sizes = sizes + abs(p(:, k)*q(k, j))
            end do
            k = merge(j, 1, is_lower)
            is_right = is_right .and. all(abs(found(k:, j) - column(k:)) <= rounding_of_sums*size(p, 2)*sizes(k:))
         end do
      end subroutine compare

   end function kernel_is_right

end module openblas
