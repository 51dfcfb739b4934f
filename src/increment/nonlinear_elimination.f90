!> A few interface elements may hold up the iterations of METHOD = NEWTON, because they jump to and fro over a kink of their laws.
!! These elements take their exact laws, all others their straight ones, and the small problem that remains is solved, with the
!! stiffness of the iteration.
!! With w the movements of the elements S after the iteration, s(w) the forces of their straight laws there, f those of the exact laws,
!! and C the movements under unit forces at their ends,
!!
!!      x = w + C (s(x) - f(x))
!!
!! is solved by Newton's method. Where this does not converge, what is left of the equations is removed in parts.
!! Source: Lanzkron, Rose, Wilkes, SIAM J. Numer. Anal. 33 (1996) 1157-1178.
module nonlinear_elimination
   use analysis_state, only: analysis_type
   use blas_lapack, only: dgesv
   use coupled_equations, only: solve_coupled_columns
   use equations, only: equation_system, solve_equations
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: element_state, force_of
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: attempt_type, evaluate_at, follow_law, trial_type
   use straight_laws, only: direction_digits, straight_law
   use tolerances, only: loose_direction, on_the_graph
   implicit none
   private

   public :: eliminate_few

   integer, parameter  :: most = 8            ! elements
   integer, parameter  :: most_steps = 12     ! of Newton's method
   real(wp), parameter :: least_part = 0.5_wp**10 ! of what is left of the equations, that is removed at once
   real(wp), parameter :: farthest = 1.0e3_wp ! times the movements: a step beyond leads nowhere
   real(wp), parameter :: share = 0.05_wp     ! of the largest difference between straight and exact force: an element that counts
   real(wp), parameter :: quick = 0.1_wp      ! of the residual: an iteration that leaves less needs no help

contains

   !> Go on from NEXT, the end of a full step from NOW along straight LAWS with the forces AT_NOW, to where the few elements follow
   !! their exact laws that leave nearly all of the residual at NEXT. NEXT is not changed where there are more of them, where the
   !! step was quick, or where this leaves more residual.
   subroutine eliminate_few(model, system, analysis, attempt, now, at_now, laws, next)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system   !! with the stiffness of the step
      type(analysis_type), intent(in)       :: analysis
      type(attempt_type), intent(inout)     :: attempt
      type(trial_type), intent(in)          :: now
      real(wp), intent(in)                  :: at_now(:, :) !! (3, n) [force]
      type(straight_law), intent(inout)     :: laws(:)  !! of the solved equations; the few elements get points of their graphs
      type(trial_type), allocatable, intent(inout) :: next
      type(trial_type), allocatable :: corrected
      integer, allocatable  :: few(:)
      real(wp), allocatable :: c(:, :), difference(:, :), reached(:, :), u(:, :), z(:, :, :)
      real(wp) :: straight(3, size(laws)), less(size(laws)), unit(3)
      logical  :: solved
      integer  :: axis, i, j, k

      if (attempt%step < 1.0_wp .or. .not. next%size < huge(1.0_wp) .or. next%size <= quick*now%size) return
      do i = 1, size(laws)
         straight(:, i) = at_now(:, i) + matmul(laws(i)%tangent, joint_movement(system%interface(i), next%u - now%u))
         less(i) = norm2(straight(:, i) - force_of(model%joints%element(i)%area, next%states(i)))
      end do
      allocate (few, source=pack([(i, i = 1, size(laws))], less > share*maxval(less)))
      if (size(few) == 0 .or. size(few) > most) return
      allocate (z(size(next%u, 1), size(next%u, 2), 3*size(few)), source=0.0_wp)
      allocate (c(3*size(few), 3*size(few)), reached(3, size(few)))
      do j = 1, size(few)
         do axis = 1, 3
            unit = 0.0_wp
            unit(axis) = 1.0_wp
            call add_force(system%interface(few(j)), unit, z(:, :, 3*(j - 1) + axis))
         end do
      end do
      call solve(model, system, attempt, z)
      if (attempt%trouble%raised) return
      do j = 1, size(few)
         do axis = 3*j - 2, 3*j
            c(:, axis) = [(joint_movement(system%interface(few(k)), z(:, :, axis)), k = 1, size(few))]
         end do
         reached(:, j) = joint_movement(system%interface(few(j)), next%u)
      end do
      allocate (difference, mold=reached)
      call solve_few(model, analysis, attempt, few, laws, reached, straight(:, few), c, difference, solved)
      if (.not. solved) return
      allocate (u, source=next%u)
      do j = 1, size(few)
         do axis = 1, 3
            u = u + difference(axis, j)*z(:, :, 3*(j - 1) + axis)
         end do
      end do
      allocate (corrected, source=next)
      call evaluate_at(model, system, attempt, analysis, u, corrected)
      if (.not. corrected%size < next%size) return
      call move_alloc(corrected, next)
      do j = 1, size(few)
         laws(few(j))%point = joint_movement(system%interface(few(j)), next%u)
         laws(few(j))%force = force_of(model%joints%element(few(j))%area, next%states(few(j)))
         laws(few(j))%shift = 0.0_wp
      end do
   end subroutine eliminate_few

   !> Replace the columns U of forces by the displacements under the stiffness of the last direction.
   subroutine solve(model, system, attempt, u)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(inout)               :: u(:, :, :) !! (dimension, retained, columns) [force] on entry, [length] on return
      real(wp) :: force(size(u, 1), size(u, 2))
      integer  :: i

      if (attempt%coupled) then
         call solve_coupled_columns(loose_direction, system, u)
         return
      end if
      do i = 1, size(u, 3)
         force = u(:, :, i)
         call solve_equations(model, system, force, u(:, :, i), attempt%trouble, digits=direction_digits)
      end do
   end subroutine solve

   !> The DIFFERENCE s(x) - f(x) at the movements x of the elements FEW with x = REACHED + C (s(x) - f(x)), s the straight force, which
   !! is STRAIGHT at REACHED. What is left of these equations at REACHED is removed at once, or in parts where Newton's method does
   !! not converge.
   subroutine solve_few(model, analysis, attempt, few, laws, reached, straight, c, difference, solved)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(attempt_type), intent(in)  :: attempt
      integer, intent(in)             :: few(:)
      type(straight_law), intent(in)  :: laws(:)
      real(wp), intent(in)            :: reached(:, :)  !! (3, few) [length]
      real(wp), intent(in)            :: straight(:, :) !! likewise [force]
      real(wp), intent(in)            :: c(:, :)        !! (3 few, 3 few) [length/force]
      real(wp), intent(out)           :: difference(:, :) !! (3, few) [force]
      logical, intent(out)            :: solved
      real(wp) :: first(3*size(few)), left(3*size(few)), matrix(3*size(few), 3*size(few)), tangents(3, 3, size(few))
      real(wp) :: there(3, size(few)), x(3, size(few)), part, remains
      integer  :: info, i, j, n, pivots(3*size(few))

      n = size(left)
      x = reached
      call find_left(x, first, tangents)
      remains = 1.0_wp
      part = 1.0_wp
      do while (remains > 0.0_wp)
         there = x
         do i = 1, most_steps
            call find_left(there, left, tangents)
            left = left - max(0.0_wp, remains - part)*first
            solved = norm2(left) <= on_the_graph*norm2(first)
            if (solved) exit
            matrix = 0.0_wp
            do j = 1, size(few)
               matrix(:, 3*j - 2:3*j) = -matmul(c(:, 3*j - 2:3*j), laws(few(j))%tangent - tangents(:, :, j))
            end do
            do j = 1, n
               matrix(j, j) = matrix(j, j) + 1.0_wp
            end do
            call dgesv(n, 1, matrix, n, pivots, left, n, info)
            if (info /= 0) exit
            if (.not. norm2(left) < farthest*(norm2(reached) + norm2(first))) exit
            there = there - reshape(left, shape(x))
         end do
         if (solved) then
            x = there
            remains = max(0.0_wp, remains - part)
            part = 2.0_wp*part
         else
            part = 0.5_wp*min(part, remains)
            if (part < least_part) return
         end if
      end do

   contains

      !> LEFT = y - REACHED - C (s(y) - f(y)) at the movements Y, the DIFFERENCE and the exact TANGENTS there.
      subroutine find_left(y, left, tangents)
         real(wp), intent(in)  :: y(:, :)
         real(wp), intent(out) :: left(:), tangents(:, :, :)
         type(element_state) :: state
         integer :: k

         do k = 1, size(few)
            associate (element => model%joints%element(few(k)))
               call follow_law(model%joints%list(element%joint)%law, element%area, attempt, few(k), analysis%states(few(k)), &
                               y(:, k), state, tangents(:, :, k))
               difference(:, k) = straight(:, k) + matmul(laws(few(k))%tangent, y(:, k) - reached(:, k)) - &
                                  force_of(element%area, state)
            end associate
         end do
         left = reshape(y - reached, [size(left)]) - matmul(c, reshape(difference, [size(left)]))
      end subroutine find_left

   end subroutine solve_few

end module nonlinear_elimination
