!> The parts of the structure go on as rigid bodies to where they rest, under given limits of friction. A body that hardly anything
!! holds goes along the direction of an iteration until its first interface elements touch, perhaps a thousandth of the way, and the
!! next ones would come one by one, an iteration each. Instead the parts move to the least energy under these limits. With the
!! rigid-body motions [B] of the parts, the movements [J] of the interface elements and their tangents [T], Newton's method solves
!!
!!      [B]^T ([K] + [J]^T [T] [J]) [B] {a} = [B]^T {r}
!!
!! for a direction [B]{a}, which a line search follows; no other matrix is factorised. What the parts need as elastic bodies the
!! iterations find.
!! Source: the motions are the coarse space of R. A. Nicolaides, SIAM J. Numer. Anal. 24 (1987) 355-365.
module rigid_seating
   use analysis_state, only: analysis_type
   use blas_lapack, only: dposv
   use equations, only: equation_system, forces_in_bodies
   use interface_operator, only: joint_movement
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: attempt_type, search, swap, trial_type
   use tolerances, only: seated, stand_in_stiffness
   use unknowns, only: motions_of, n_motions
   implicit none
   private

   public :: seat_parts

   integer, parameter :: most_steps = 25 ! of Newton's method

   !> How the motions move an interface element: those of the parts at its ends alone.
   type :: element_motions
      integer, allocatable  :: motion(:)
      real(wp), allocatable :: w(:, :)      ! (3, size(motion)): [J] [B]
   end type element_motions

   !> The rigid-body motions of the parts that have interface elements, each scaled to 1 where it moves most.
   type :: motions_type
      integer, allocatable  :: part_of(:)   ! (retained)
      real(wp), allocatable :: u(:, :, :)   ! (dimension, motions of a part, retained), 0 at supports
      integer, allocatable  :: first(:)     ! (parts + 1) motions first(p) to first(p + 1) - 1 are those of part p
      integer, allocatable  :: number(:)    ! (motions) which one of U it is
      type(element_motions), allocatable :: at(:) ! (elements)
      real(wp), allocatable :: k(:, :)      ! (motions, motions): [B]^T [K] [B] [force/length]
   end type motions_type

contains

   !> Go on from NEXT by rigid-body motions of the parts to the least energy under the given limits of ATTEMPT, or as far as
   !! Newton's method leads.
   subroutine seat_parts(model, system, analysis, attempt, next)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(inout)  :: attempt !! its STEP stays that of the iteration
      type(trial_type), allocatable, intent(inout) :: next
      type(motions_type) :: motions
      type(trial_type), allocatable :: there
      real(wp), allocatable :: a(:), direction(:, :), matrix(:, :)
      real(wp) :: first, step, work
      integer  :: i, info, n

      call find_motions(model, system, analysis, motions)
      n = size(motions%number)
      if (n == 0) return
      step = attempt%step
      allocate (a(n), matrix(n, n), direction(size(next%u, 1), size(next%u, 2)))
      allocate (there, source=next)
      first = 0.0_wp
      do i = 1, most_steps
         a = forces_on(motions, next%residual)
         if (i == 1) first = norm2(a)
         if (.not. norm2(a) > seated*first) exit
         matrix = stiffness_of(motions, next%tangent)
         call dposv('L', n, 1, matrix, n, a, n, info)
         if (info /= 0) exit
         direction = moved_by(motions, a)
         work = sum(next%residual*direction)
         call search(model, system, attempt, analysis, next, direction, there)
         if (.not. there%size < huge(1.0_wp)) exit
         if (.not. abs(sum(there%residual*direction)) < work) exit
         call swap(next, there)
      end do
      attempt%step = step
   end subroutine seat_parts

   !> The MOTIONS, the movements of the interface elements by them and what springs and supports have against them.
   subroutine find_motions(model, system, analysis, motions)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(motions_type), intent(out)    :: motions
      real(wp), allocatable :: force(:, :), u(:, :)
      real(wp) :: largest, movement(3)
      logical  :: has_elements(model%freedoms%n_parts), moves
      integer  :: i, k, m, n, part

      m = n_motions(model%mesh%dimension)
      motions%part_of = model%freedoms%part(system%retained)
      allocate (motions%u(model%mesh%dimension, m, size(system%retained)))
      do i = 1, size(system%retained)
         motions%u(:, :, i) = merge(0.0_wp, motions_of(model, system%retained(i)), spread(analysis%held(:, i), 2, m))
      end do
      allocate (motions%first(model%freedoms%n_parts + 1), motions%number(m*model%freedoms%n_parts))
      allocate (motions%at(size(system%interface)))
      has_elements = .false.
      do i = 1, size(motions%at)
         has_elements(model%freedoms%part(system%interface(i)%node)) = .true.
         allocate (motions%at(i)%motion(0), motions%at(i)%w(3, 0))
      end do
      allocate (u, force, mold=analysis%u)
      n = 0
      do part = 1, model%freedoms%n_parts
         motions%first(part) = n + 1
         if (.not. has_elements(part)) cycle
         do k = 1, m
            u = merge(motions%u(:, k, :), 0.0_wp, spread(motions%part_of == part, 1, size(u, 1)))
            largest = max(maxval(abs(u)), tiny(1.0_wp))
            do i = 1, size(system%retained)
               if (motions%part_of(i) == part) motions%u(:, k, i) = motions%u(:, k, i)/largest
            end do
            moves = .false.
            do i = 1, size(motions%at)
               movement = joint_movement(system%interface(i), u)/largest
               if (.not. any(abs(movement) > 0.0_wp)) cycle
               moves = .true.
               motions%at(i) = element_motions([motions%at(i)%motion, n + 1], &
                                               reshape([motions%at(i)%w, movement], [3, size(motions%at(i)%motion) + 1]))
            end do
            if (.not. moves) cycle
            n = n + 1
            motions%number(n) = k
         end do
      end do
      motions%first(part) = n + 1
      motions%number = motions%number(:n)
      allocate (motions%k(n, n))
      do k = 1, n
         call forces_in_bodies(system, moved_by(motions, [(merge(1.0_wp, 0.0_wp, i == k), i = 1, n)]), force)
         motions%k(:, k) = forces_on(motions, force)
      end do
   end subroutine find_motions

   !> [B]{a}: the displacements by shares A of the motions.
   pure function moved_by(motions, a) result(u)
      type(motions_type), intent(in) :: motions
      real(wp), intent(in)           :: a(:)
      real(wp) :: u(size(motions%u, 1), size(motions%u, 3))
      integer  :: i, k

      u = 0.0_wp
      do i = 1, size(u, 2)
         do k = motions%first(motions%part_of(i)), motions%first(motions%part_of(i) + 1) - 1
            u(:, i) = u(:, i) + a(k)*motions%u(:, motions%number(k), i)
         end do
      end do
   end function moved_by

   !> [B]^T {f}: what the forces F are on the motions.
   pure function forces_on(motions, f) result(a)
      type(motions_type), intent(in) :: motions
      real(wp), intent(in)           :: f(:, :) !! (dimension, retained) [force]
      real(wp) :: a(size(motions%number))
      integer  :: i, k

      a = 0.0_wp
      do i = 1, size(f, 2)
         do k = motions%first(motions%part_of(i)), motions%first(motions%part_of(i) + 1) - 1
            a(k) = a(k) + dot_product(motions%u(:, motions%number(k), i), f(:, i))
         end do
      end do
   end function forces_on

   !> The matrix of Newton's method with the TANGENTs of the interface elements. Where none of them holds a part, all do a little.
   pure function stiffness_of(motions, tangent) result(a)
      type(motions_type), intent(in) :: motions
      real(wp), intent(in)           :: tangent(:, :, :) !! (3, 3, elements) [force/length]
      real(wp) :: a(size(motions%k, 1), size(motions%k, 1)), t(3, 3)
      integer  :: axis, i

      a = motions%k
      do i = 1, size(tangent, 3)
         t = 0.5_wp*(tangent(:, :, i) + transpose(tangent(:, :, i)))
         do axis = 1, 3
            t(axis, axis) = t(axis, axis) + stand_in_stiffness*maxval(tangent)
         end do
         associate (k => motions%at(i)%motion, w => motions%at(i)%w)
            a(k, k) = a(k, k) + matmul(transpose(w), matmul(t, w))
         end associate
      end do
   end function stiffness_of

end module rigid_seating
