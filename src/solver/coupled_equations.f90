!> The unsymmetric equations of NEWTON with friction: solved by conjugate residuals, with the factor of a symmetric stiffness as
!! preconditioner, which is kept while this pays.
module coupled_equations
   use equation_solver, only: equation_system, failure_type, solver_direction
   use equations, only: form_structure_stiffness, solve_equations
   use interface_operator, only: add_global_force, global_stiffness, relative_movement
   use kinds, only: wp
   use model_data, only: model_type
   use tolerances, only: dependent_product
   implicit none
   private

   public :: solve_coupled, solve_coupled_again

   integer, parameter :: digits = 7      ! of an iterative solution within an iteration
   integer, parameter :: most_kept = 24  ! directions of earlier coupled systems

contains

   !> Replace the forces U on the retained nodes by the displacements with ([k_b] + sum of (K_INT + REST)) u = f on the free
   !! components, K_INT symmetric, by conjugate residuals with a factor as preconditioner. The present factor is kept while two
   !! conditions hold: its steps beyond those of a new factor cost less than a factorisation, and they are no more than the average
   !! since it was made. Otherwise [k_b] + sum of K_INT is factorised. The residual is reduced below TOLERANCE times that of u = 0,
   !! or as far as the steps reach.
   subroutine solve_coupled(model, k_int, rest, where, tolerance, system, u, failure)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: k_int(:, :, :) !! (3, 3, n) of interface elements, in their axes [force/length]
      real(wp), intent(in)                  :: rest(:, :, :)  !! likewise
      character(*), intent(in)              :: where          !! as in form_structure_stiffness
      real(wp), intent(in)                  :: tolerance
      class(equation_system), intent(inout) :: system
      real(wp), intent(inout)               :: u(:, :)        !! (dimension, retained) [force] on entry, [length] on return
      type(failure_type), intent(inout)     :: failure
      real(wp) :: digits_wanted, load(size(u, 1), size(u, 2))
      integer  :: i, symmetric_steps, steps

      if (.not. allocated(system%coupled%change)) allocate (system%coupled%change, mold=rest)
      associate (tally => system%coupled)
         digits_wanted = -log10(tolerance)
         load = u
         if (tally%serves .and. tally%price > 0 .and. tally%extra*tally%solved <= tally%spent) then
            do i = 1, size(rest, 3)
               tally%change(:, :, i) = global_stiffness(system%interface(i), k_int(:, :, i) + rest(:, :, i)) - system%k_int(:, :, i)
            end do
            symmetric_steps = nint(tally%symmetric_steps*digits_wanted)
            call iterate_coupled(model, tolerance, symmetric_steps + tally%price, system, u, steps, failure)
            if (failure%raised) return
            tally%extra = max(0, steps - symmetric_steps)
            tally%spent = tally%spent + tally%extra
            tally%solved = tally%solved + 1
            if (steps <= symmetric_steps + tally%price) return
         end if
         if (allocated(tally%kept)) deallocate (tally%kept)
         call form_structure_stiffness(model, k_int, where, system, failure)
         do i = 1, size(rest, 3)
            tally%change(:, :, i) = global_stiffness(system%interface(i), rest(:, :, i))
         end do
         u = load
         call iterate_coupled(model, tolerance, tally%most_steps, system, u, steps, failure)
         tally%symmetric_steps = steps/digits_wanted
         tally%extra = 0
         tally%spent = tally%price
         tally%solved = 1
      end associate
   end subroutine solve_coupled

   !> Replace other forces U by the displacements under the stiffness of the last solve_coupled.
   subroutine solve_coupled_again(model, tolerance, system, u, failure)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: tolerance
      class(equation_system), intent(inout) :: system
      real(wp), intent(inout)               :: u(:, :)     !! (dimension, retained) [force] on entry, [length] on return
      type(failure_type), intent(inout)     :: failure
      integer :: steps

      call iterate_coupled(model, tolerance, system%coupled%most_steps, system, u, steps, failure, again=.true.)
   end subroutine solve_coupled_again

   !> Replace the forces U by the displacements with ([k] + sum of CHANGE) u = f by generalised conjugate residuals in STEPS steps,
   !! [k] being the stiffness in SYSTEM. STEPS exceeds MOST_STEPS where the residual is not below TOLERANCE times that of u = 0.
   !! Directions of earlier systems with the same [k] are kept: their products with [k] are known, so they cost no solution.
   !! Sources: Eisenstat, Elman, Schultz, SIAM J. Numer. Anal. 20 (1983) 345-357, preconditioned from the right; Parks et al.,
   !! SIAM J. Sci. Comput. 28 (2006) 1651-1674.
   subroutine iterate_coupled(model, tolerance, most_steps, system, u, steps, failure, again)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: tolerance
      integer, intent(in)                   :: most_steps
      class(equation_system), intent(inout) :: system
      real(wp), intent(inout)               :: u(:, :)
      integer, intent(out)                  :: steps
      type(failure_type), intent(inout)     :: failure
      logical, intent(in), optional         :: again       !! the kept directions are those of this system; false
      type(solver_direction), allocatable :: directions(:)
      logical  :: held(size(u, 1), size(u, 2))
      real(wp) :: left(size(u, 1), size(u, 2)), enough
      integer  :: i, n, n_kept

      steps = 0
      held = system%held_now()
      left = merge(0.0_wp, u, held)
      u = 0.0_wp
      enough = tolerance*norm2(left)
      if (failure%raised .or. enough <= 0.0_wp) return
      n_kept = 0
      if (allocated(system%coupled%kept)) n_kept = size(system%coupled%kept)
      allocate (directions(n_kept + most_steps))
      if (n_kept > 0) directions(:n_kept) = system%coupled%kept
      n = merge(n_kept, 0, present(again))
      do i = 1, n
         call go_along(directions(i))
      end do
      do i = n + 1, n_kept ! new directions replace useless ones
         if (i > n + 1) directions(n + 1) = directions(i)
         call add_direction()
      end do
      do while (norm2(left) > enough)
         steps = steps + 1
         if (steps > most_steps) exit
         associate (new => directions(n + 1))
            new%force = left
            new%u = left
            call solve_equations(model, system, left, new%u, failure, digits=digits)
         end associate
         if (failure%raised) return
         i = n
         call add_direction()
         if (n == i) steps = most_steps ! no direction reduces the residual
      end do
      system%coupled%kept = directions(max(0, n - most_kept) + 1:n)

   contains

      !> Reduce LEFT along direction N + 1 too, unless nothing new remains of it.
      subroutine add_direction()
         logical :: is_new

         call complete_direction(system, held, directions(:n + 1), is_new)
         if (.not. is_new) return
         n = n + 1
         call go_along(directions(n))
      end subroutine add_direction

      !> Reduce LEFT along a DIRECTION.
      subroutine go_along(direction)
         type(solver_direction), intent(in) :: direction
         real(wp) :: share

         share = sum(direction%product*left)
         left = left - share*direction%product
         u = u + share*direction%u
      end subroutine go_along

   end subroutine iterate_coupled

   !> Find the product of the coupled stiffness and the last of DIRECTIONS, orthogonalise it against those of the others, and give
   !! it the length 1. IS_NEW is false where nothing but rounding remains of it.
   subroutine complete_direction(system, held, directions, is_new)
      class(equation_system), intent(in)    :: system
      logical, intent(in)                   :: held(:, :)    !! (dimension, retained)
      type(solver_direction), intent(inout) :: directions(:)
      logical, intent(out)                  :: is_new
      real(wp) :: length, product(size(held, 1), size(held, 2)), share
      integer  :: i

      associate (new => directions(size(directions)))
         product = 0.0_wp
         do i = 1, size(system%interface)
            associate (element => system%interface(i))
               call add_global_force(element, matmul(system%coupled%change(:, :, i), relative_movement(element, new%u)), product)
            end associate
         end do
         new%product = merge(0.0_wp, product, held) + new%force
         length = norm2(new%product)
         do i = 1, size(directions) - 1
            share = sum(directions(i)%product*new%product)
            new%product = new%product - share*directions(i)%product
            new%u = new%u - share*directions(i)%u
            new%force = new%force - share*directions(i)%force
         end do
         is_new = norm2(new%product) > dependent_product*length
         if (.not. is_new) return
         length = norm2(new%product)
         new%product = new%product/length
         new%u = new%u/length
         new%force = new%force/length
      end associate
   end subroutine complete_direction

end module coupled_equations
