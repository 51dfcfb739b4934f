!> Systems whose matrix is a factorised symmetric one plus a small unsymmetric rest: ([k] + [r]) {x} = {b}. Friction makes the
!! tangent of a joint unsymmetric; the rest acts on few unknowns, and a few steps of GMRES with [k] as preconditioner do.
!! Beside it, systems whose supports move.
!! Source: Saad, Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869 (right-preconditioned, Gram-Schmidt modified).
module coupled_solution
   use equations, only: equation_system, solve_equations
   use kinds, only: wp
   use model_data, only: joint_movement, model_type
   implicit none
   private

   public :: solve_coupled, solve_moved

contains

   !> Displacements U of the retained nodes with ([k] + [r]) U = F on the free components; [k] is the stiffness in SYSTEM. The
   !! residual is brought below TOLERANCE times that of U = 0, or as far as MOST_STEPS steps go: the caller iterates anyway.
   subroutine solve_coupled(model, system, rest, f, tolerance, most_steps, u)
      type(model_type), intent(in)      :: model
      type(equation_system), intent(inout) :: system
      real(wp), intent(in)              :: rest(:, :, :) !! (3, 3, n) of the interface elements, in their axes [force/length]
      real(wp), intent(in)              :: f(:, :)   !! (dimension, n_nodes) [force]
      real(wp), intent(in)              :: tolerance
      integer, intent(in)               :: most_steps
      real(wp), intent(inout)           :: u(:, :)   !! (dimension, n_nodes), set where retained [length]
      real(wp), allocatable :: basis(:, :, :), shifted(:, :), h(:, :), cosine(:), sine(:), g(:), y(:)
      real(wp) :: rotated, size_of_f
      integer  :: i, j, steps

      associate (held => model%held(:, system%retained), retained => system%retained)
         allocate (basis(size(f, 1), size(retained), most_steps + 1), h(most_steps + 1, most_steps), source=0.0_wp)
         allocate (shifted, source=f)
         allocate (cosine(most_steps), sine(most_steps), g(most_steps + 1), source=0.0_wp)
         basis(:, :, 1) = merge(0.0_wp, f(:, retained), held)
         size_of_f = norm2(basis(:, :, 1))
         u(:, retained) = 0.0_wp
         if (size_of_f <= 0.0_wp) return
         basis(:, :, 1) = basis(:, :, 1)/size_of_f
         g(1) = size_of_f
         steps = 0
         do j = 1, most_steps
            steps = j
            shifted(:, retained) = basis(:, :, j)
            call solve_equations(system, shifted, u)
            call rest_times(model, system%retained, rest, u, shifted)
            basis(:, :, j + 1) = basis(:, :, j) + merge(0.0_wp, shifted(:, retained), held)
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
         shifted(:, retained) = 0.0_wp
         do i = 1, steps
            shifted(:, retained) = shifted(:, retained) + y(i)*basis(:, :, i)
         end do
      end associate
      call solve_equations(system, shifted, u)
   end subroutine solve_coupled


   !> Displacements U of the retained nodes under the forces F on them where held components are MOVED: the forces that this takes
   !! in the interface elements act on the others; those that it takes in the bodies are in F already.
   subroutine solve_moved(model, system, k_int, f, moved, u)
      type(model_type), intent(in)      :: model
      type(equation_system), intent(inout) :: system
      real(wp), intent(in)              :: k_int(:, :, :) !! (3, 3, n) as in the stiffness in SYSTEM [force/length]
      real(wp), intent(in)              :: f(:, :)        !! (dimension, n_nodes) [force]
      real(wp), intent(in)              :: moved(:, :)    !! (dimension, n_nodes), zero on free components [length]
      real(wp), intent(inout)           :: u(:, :)        !! (dimension, n_nodes), set where retained [length]
      real(wp), allocatable :: joint(:, :)

      allocate (joint, mold=f)
      call rest_times(model, system%retained, k_int, moved, joint)
      associate (retained => system%retained)
         joint(:, retained) = f(:, retained) - joint(:, retained)
         call solve_equations(system, joint, u)
         u(:, retained) = u(:, retained) + moved(:, retained)
      end associate
   end subroutine solve_moved


   !> F = [r] {U} on the RETAINED nodes: nodal forces of nodal displacements, by the interface elements.
   pure subroutine rest_times(model, retained, rest, u, f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: retained(:)
      real(wp), intent(in)         :: rest(:, :, :)
      real(wp), intent(in)         :: u(:, :)
      real(wp), intent(inout)      :: f(:, :)
      real(wp) :: force(3)
      integer  :: i

      f(:, retained) = 0.0_wp
      do i = 1, size(model%interface)
         force = matmul(model%interface(i)%axes, matmul(rest(:, :, i), joint_movement(model, u, i)))
         associate (nodes => model%interface(i)%nodes, d => model%dimension)
            f(:, nodes(1)) = f(:, nodes(1)) + force(:d)
            if (nodes(2) > 0) f(:, nodes(2)) = f(:, nodes(2)) - force(:d)
         end associate
      end do
   end subroutine rest_times

end module coupled_solution
