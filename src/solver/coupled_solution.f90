!> Systems whose matrix is a factorised symmetric one plus a small unsymmetric rest: ([k] + [r]) {x} = {b}. Friction makes the
!! tangent of a joint unsymmetric; the rest acts on few unknowns, and a few steps of GMRES with [k] as preconditioner do.
!! Source: Saad, Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869 (right-preconditioned, Gram-Schmidt modified).
module coupled_solution
   use equations, only: equation_system, solve_equations
   use failures, only: failure_type
   use interface_operator, only: add_force, interface_element, joint_movement
   use kinds, only: wp
   use model_data, only: model_type
   implicit none
   private

   public :: solve_coupled

   integer, parameter :: digits = 7 ! of a step, where it is iterated itself

contains

   !> Displacements U of the retained nodes with ([k] + [r]) U = F on the free components; [k] is the stiffness in SYSTEM. The
   !! residual is brought below TOLERANCE times that of U = 0, or as far as MOST_STEPS steps go: the caller iterates anyway.
   subroutine solve_coupled(model, system, rest, f, tolerance, most_steps, u, failure)
      type(model_type), intent(in)      :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)              :: rest(:, :, :) !! (3, 3, n) of the interface elements, in their axes [force/length]
      real(wp), intent(in)              :: f(:, :)   !! (dimension, retained) [force]
      real(wp), intent(in)              :: tolerance
      integer, intent(in)               :: most_steps
      real(wp), intent(inout)           :: u(:, :)   !! likewise [length]
      type(failure_type), intent(inout) :: failure
      real(wp), allocatable :: basis(:, :, :), shifted(:, :), h(:, :), cosine(:), sine(:), g(:), y(:)
      real(wp) :: rotated, size_of_f
      integer  :: i, j, steps

      if (failure%raised) return
      associate (held => system%held_now())
         allocate (basis(size(f, 1), size(f, 2), most_steps + 1), h(most_steps + 1, most_steps), source=0.0_wp)
         allocate (shifted, source=f)
         allocate (cosine(most_steps), sine(most_steps), g(most_steps + 1), source=0.0_wp)
         basis(:, :, 1) = merge(0.0_wp, f, held)
         size_of_f = norm2(basis(:, :, 1))
         u = 0.0_wp
         if (size_of_f <= 0.0_wp) return
         basis(:, :, 1) = basis(:, :, 1)/size_of_f
         g(1) = size_of_f
         steps = 0
         do j = 1, most_steps
            steps = j
            shifted = basis(:, :, j)
            call solve_equations(model, system, shifted, u, failure, digits=digits)
            if (failure%raised) return
            call rest_times(system%interface, rest, u, shifted)
            basis(:, :, j + 1) = basis(:, :, j) + merge(0.0_wp, shifted, held)
            do i = 1, j
               h(i, j) = sum(basis(:, :, i)*basis(:, :, j + 1))
               basis(:, :, j + 1) = basis(:, :, j + 1) - h(i, j)*basis(:, :, i)
            end do
            h(j + 1, j) = norm2(basis(:, :, j + 1))
            if (h(j + 1, j) > 0.0_wp) basis(:, :, j + 1) = basis(:, :, j + 1)/h(j + 1, j)
            do i = 1, j - 1                                  ! Givens rotations keep h triangular
               rotated = cosine(i)*h(i, j) + sine(i)*h(i + 1, j)
               h(i + 1, j) = -sine(i)*h(i, j) + cosine(i)*h(i + 1, j)
               h(i, j) = rotated
            end do
            rotated = hypot(h(j, j), h(j + 1, j))
            if (rotated <= 0.0_wp) exit
            cosine(j) = h(j, j)/rotated
            sine(j) = h(j + 1, j)/rotated
            h(j, j) = rotated
            g(j + 1) = -sine(j)*g(j)
            g(j) = cosine(j)*g(j)
            if (abs(g(j + 1)) <= tolerance*size_of_f) exit
         end do
         allocate (y(steps), source=0.0_wp)
         do i = steps, 1, -1
            if (abs(h(i, i)) <= 0.0_wp) cycle
            y(i) = (g(i) - dot_product(h(i, i + 1:steps), y(i + 1:)))/h(i, i)
         end do
         shifted = 0.0_wp
         do i = 1, steps
            shifted = shifted + y(i)*basis(:, :, i)
         end do
      end associate
      call solve_equations(model, system, shifted, u, failure, digits=digits)
   end subroutine solve_coupled

   !> F = [r] {U}: forces of displacements of retained nodes, by the interface ELEMENTS.
   pure subroutine rest_times(elements, rest, u, f)
      type(interface_element), intent(in) :: elements(:)
      real(wp), intent(in)                :: rest(:, :, :)
      real(wp), intent(in)                :: u(:, :)
      real(wp), intent(out)               :: f(:, :)
      integer :: i

      f = 0.0_wp
      do i = 1, size(elements)
         call add_force(elements(i), matmul(rest(:, :, i), joint_movement(elements(i), u)), f)
      end do
   end subroutine rest_times

end module coupled_solution
