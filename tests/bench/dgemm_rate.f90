!> What one thread of this machine does in DGEMM, the measure of all other rates: best of a few products of 2000 x 2000. Prints
!! the rate [GFlop/s], the kernel of OpenBLAS, chosen as by jointfem, and its version.
program dgemm_rate
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_ptr
   use blas_lapack, only: dgemm
   use machine, only: use_threads
   use kinds, only: long, wp
   use openblas, only: prepare_libraries
   implicit none
   integer, parameter :: n = 2000, repeats = 5

   interface
      function openblas_get_corename() bind(c, name='openblas_get_corename') result(name)
         import :: c_ptr
         type(c_ptr) :: name
      end function openblas_get_corename

      function openblas_get_config() bind(c, name='openblas_get_config') result(text)
         import :: c_ptr
         type(c_ptr) :: text
      end function openblas_get_config
   end interface

   real(wp), allocatable :: a(:, :), b(:, :), c(:, :)
   real(wp) :: best
   integer(long) :: before, after, rate
   integer :: i

   call prepare_libraries()
   call use_threads(1)
   allocate (a(n, n), b(n, n), c(n, n))
   call random_number(a)
   call random_number(b)
   best = 0.0_wp
   do i = 1, repeats
      call system_clock(before, rate)
      call dgemm('N', 'N', n, n, n, 1.0_wp, a, n, b, n, 0.0_wp, c, n)
      call system_clock(after)
      best = max(best, 2.0e-9_wp*real(n, wp)**3*rate/(after - before))
   end do
   print '(a, f0.2)', 'rate ', best
   print '(2a)', 'kernel ', text_at(openblas_get_corename())
   print '(2a)', 'library ', text_at(openblas_get_config())

contains

   !> The text of C at ADDRESS.
   function text_at(address) result(text)
      type(c_ptr), intent(in)   :: address
      character(:), allocatable :: text
      integer, parameter :: longest = 200
      character(kind=c_char), pointer :: letters(:)
      integer :: i

      text = ''
      if (.not. c_associated(address)) return
      call c_f_pointer(address, letters, [longest])
      do i = 1, longest
         if (iachar(letters(i)) == 0) exit
         text = text//letters(i)
      end do
   end function text_at

end program dgemm_rate
