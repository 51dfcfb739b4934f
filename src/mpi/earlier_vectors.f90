!> Earlier solutions of the distributed equations as a first guess: what of them, taken together, comes nearest to the next one in
!! the energy of its own matrix. All processes call every routine in step.
!! Source: Fischer, Comput. Methods Appl. Mech. Engrg. 163 (1998) 193-204.
module earlier_vectors
   use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
   use distributed_matrix, only: check, distributed_matrix_type
   use kinds, only: wp
   use least_energy, only: find_least_energy
   use petsc_library, only: mat_mult, vec_copy, vec_destroy, vec_duplicate, vec_many_axpy, vec_many_dot, vec_scale
   implicit none
   private

   public :: note_vector, guess_vector, forget_vectors

   integer, parameter :: most = 6                    !! that are kept

   type, public :: earlier_vectors_type
      private
      integer :: n = 0                                ! kept, the last one first
      type(c_ptr) :: u(most) = c_null_ptr
   end type earlier_vectors_type

contains

   !> The solution X is kept, the oldest one makes room.
   subroutine note_vector(x, earlier)
      type(c_ptr), intent(in)                   :: x
      type(earlier_vectors_type), intent(inout) :: earlier
      type(c_ptr) :: place

      if (earlier%n < most) then
         earlier%n = earlier%n + 1
         call check(vec_duplicate(x, earlier%u(earlier%n)))
      end if
      place = earlier%u(earlier%n)
      earlier%u(2:earlier%n) = earlier%u(:earlier%n - 1)
      earlier%u(1) = place
      call check(vec_copy(x, place))
   end subroutine note_vector

   !> X: of all sums of earlier solutions the one with the least energy x'[k] x/2 - b'x, [k] the STIFFNESS now, b its vector;
   !! zero where there is none.
   subroutine guess_vector(stiffness, earlier)
      type(distributed_matrix_type), intent(in) :: stiffness
      type(earlier_vectors_type), intent(in)    :: earlier
      real(wp) :: energy(earlier%n, earlier%n), work(earlier%n), share(earlier%n)
      integer  :: i

      call check(vec_scale(stiffness%x, 0.0_wp))
      if (earlier%n == 0) return
      do i = 1, earlier%n
         call check(mat_mult(stiffness%products, earlier%u(i), stiffness%r))
         call check(vec_many_dot(stiffness%r, earlier%n, earlier%u, energy(:, i)))
      end do
      call check(vec_many_dot(stiffness%b, earlier%n, earlier%u, work))
      call find_least_energy(energy, work, share)
      call check(vec_many_axpy(stiffness%x, earlier%n, share, earlier%u))
   end subroutine guess_vector

   subroutine forget_vectors(earlier)
      type(earlier_vectors_type), intent(inout) :: earlier
      integer :: i

      do i = 1, earlier%n
         call check(vec_destroy(earlier%u(i)))
      end do
      earlier%n = 0
   end subroutine forget_vectors

end module earlier_vectors
