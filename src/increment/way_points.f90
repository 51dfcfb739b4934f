!> Equilibria on the way between two states of METHOD = NEWTON, near known displacements: by corrections with the factor of the last
!! iteration, and by iterations of their own where these fail.
module way_points
   use analysis_state, only: analysis_type, force_noise
   use coupled_equations, only: solve_coupled_again
   use equation_solver, only: failure_type
   use equations, only: equation_system, solve_by_last_factor
   use increment_parts, only: try_part
   use joint_laws, only: element_state
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: attempt_type, evaluate_at, trial_type
   use tolerances, only: dependent_product, loose_direction, on_the_path, rough_direction
   implicit none
   private

   public :: find_equilibrium, correction
   public :: approach ! for runs beside another one

   integer, parameter  :: most_corrections = 8
   real(wp), parameter :: negligible = 0.01_wp ! of PATHTOL: uncertainty below which corrections end
   real(wp), parameter :: at_the_end = 0.1_wp  ! of the error of pressures on the way: what counts of it at its end

contains

   !> The equilibrium ALONG the way with LEFT of the increment to go, to which the states BEFORE lead: its displacements from U, and
   !! its states. Where corrections leave a greater UNCERTAINTY than is ALLOWED, it is reached as the end of a part is.
   subroutine find_equilibrium(model, system, left, u, before, allowed, analysis, attempt, along, uncertainty)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system   !! with the factor of the last iteration
      real(wp), intent(in)                  :: left     !! of the load [-], 0 to 1
      real(wp), allocatable, intent(inout)  :: u(:, :)  !! (dimension, retained) [length]
      type(element_state), allocatable, intent(inout) :: before(:) !! returned as they were
      real(wp), intent(in)                  :: allowed  !! uncertainty [-]
      type(analysis_type), intent(inout)    :: analysis !! returned as it was, but for the iterations made
      type(attempt_type), intent(inout)     :: attempt  !! likewise
      type(element_state), allocatable, intent(out)   :: along(:)
      real(wp), intent(out)                 :: uncertainty !! of its pressures, of the largest one [-]; 0: found
      type(trial_type) :: trial
      type(analysis_type), allocatable :: there
      type(attempt_type), allocatable  :: own
      real(wp) :: enough

      call approach(model, system, analysis%now%condensed_load - left*analysis%change, u, before, &
                    negligible*analysis%path_tolerance, analysis, attempt, trial, enough)
      uncertainty = 0.0_wp
      if (trial%size > max(enough, force_noise(system, trial%u))) uncertainty = uncertainty_of(model, system, trial, analysis%held)
      if (.not. uncertainty < huge(1.0_wp)) uncertainty = 0.0_wp ! nothing is pressed, and has a way
      if (uncertainty > allowed .and. attempt%iteration > 0) then
         allocate (there, source=analysis)
         there%states = before
         there%tolerance = max(enough, allowed/uncertainty*trial%size)
         allocate (own, source=attempt)
         own%growth = 0.0_wp
         call try_part(model, system, there, left, own, trial%u)
         call move_alloc(there%record%iterations, analysis%record%iterations)
         analysis%record%n_iterations = there%record%n_iterations
         attempt%coupled = own%coupled ! as the last factor is
         if (own%converged) then
            uncertainty = min(uncertainty, allowed)
            call move_alloc(there%u, u)
            call move_alloc(there%states, along)
            return
         end if
      end if
      call move_alloc(trial%u, u)
      call move_alloc(trial%states, along)
   end subroutine find_equilibrium

   !> The error of pressure that the residual of TRIAL leaves at the end of the way, of the largest pressure [-]: a share of the
   !! residual at the nodes of a joint per nodal area, root mean square over the joint, the largest of all joints. Huge where nothing
   !! is pressed.
   pure real(wp) function uncertainty_of(model, system, trial, held) result(uncertainty)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(trial_type), intent(in)       :: trial
      logical, intent(in)                :: held(:, :) !! (dimension, retained)
      logical  :: on(size(held, 2))
      real(wp) :: p
      integer  :: i, j

      uncertainty = huge(1.0_wp)
      p = max(maxval(trial%states%normal%p_a), maxval(trial%states%normal%pressure))
      if (.not. p > 0.0_wp) return
      uncertainty = 0.0_wp
      do j = 1, size(model%joints%list)
         associate (joint => model%joints%list(j))
            on = .false.
            do i = joint%first, joint%last
               on(system%interface(i)%node) = .true.
            end do
            uncertainty = max(uncertainty, sqrt((joint%last - joint%first + 1)* &
                                    sum(trial%residual**2, mask=spread(on, 1, size(held, 1)) .and. .not. held))/joint%area)
         end associate
      end do
      uncertainty = at_the_end*uncertainty/p
   end function uncertainty_of

   !> The TRIAL near equilibrium under the LOAD, to which the states BEFORE lead: from the displacements U by a few corrections with
   !! the factor of the last iteration. The factor is that of the end of the increment; what the corrections so far have changed in
   !! the residual replaces it where it errs. Source: Anderson, J. ACM 12 (1965) 547-560, in the form of Walker, Ni, SIAM J. Numer.
   !! Anal. 49 (2011) 1715-1735, with the factor as preconditioner.
   subroutine approach(model, system, load, u, before, least, analysis, attempt, trial, enough)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)                  :: load(:, :), u(:, :)
      type(element_state), allocatable, intent(inout) :: before(:) !! returned as they were
      real(wp), intent(in)                  :: least               !! uncertainty below which the corrections end too [-]
      type(analysis_type), intent(inout)    :: analysis            !! likewise
      type(attempt_type), intent(inout)     :: attempt             !! likewise
      type(trial_type), intent(out)         :: trial
      real(wp), intent(out)                 :: enough !! residual below which the corrections end [force]
      real(wp), allocatable :: goal(:, :) ! the load of the attempt
      type(trial_type) :: next, last
      type(failure_type) :: failure ! ends the corrections
      real(wp) :: steps(size(u, 1), size(u, 2), most_corrections), gains(size(u, 1), size(u, 2), most_corrections)
      real(wp) :: direction(size(u, 1), size(u, 2)), left(size(u, 1), size(u, 2)), share
      integer  :: first, i, k

      allocate (goal, source=attempt%load)
      attempt%load = load
      call exchange_states(before, analysis%states)
      call evaluate_at(model, system, attempt, analysis, u, trial)
      enough = max(on_the_path*trial%size, analysis%tolerance)
      last = trial
      first = 1
      do i = 1, most_corrections
         if (trial%size <= enough .or. attempt%iteration == 0) exit
         if (uncertainty_of(model, system, trial, analysis%held) < least) exit
         left = merge(0.0_wp, last%residual, analysis%held)
         steps(:, :, i) = 0.0_wp
         do k = first, i - 1
            share = sum(gains(:, :, k)*left)
            left = left - share*gains(:, :, k)
            steps(:, :, i) = steps(:, :, i) + share*steps(:, :, k)
         end do
         call correction(model, system, left, attempt%coupled, &
                         merge(loose_direction, rough_direction, analysis%record%follows_path), direction, failure)
         if (failure%raised) exit
         steps(:, :, i) = steps(:, :, i) + direction
         call evaluate_at(model, system, attempt, analysis, last%u + steps(:, :, i), next)
         if (.not. next%size < huge(1.0_wp)) exit
         left = merge(0.0_wp, last%residual - next%residual, analysis%held)
         gains(:, :, i) = left
         do k = first, i - 1
            share = sum(gains(:, :, k)*gains(:, :, i))
            gains(:, :, i) = gains(:, :, i) - share*gains(:, :, k)
            steps(:, :, i) = steps(:, :, i) - share*steps(:, :, k)
         end do
         share = norm2(gains(:, :, i))
         if (share > dependent_product*norm2(left)) then
            gains(:, :, i) = gains(:, :, i)/share
            steps(:, :, i) = steps(:, :, i)/share
         else
            first = i + 1 ! the corrections before have all directions that there are, as in a joint of one element: without them
         end if
         last = next
         if (last%size < trial%size) trial = last
      end do
      call exchange_states(before, analysis%states)
      call move_alloc(goal, attempt%load)
   end subroutine approach

   subroutine exchange_states(a, b)
      type(element_state), allocatable, intent(inout) :: a(:), b(:)
      type(element_state), allocatable :: c(:)

      call move_alloc(a, c)
      call move_alloc(b, a)
      call move_alloc(c, b)
   end subroutine exchange_states

   !> The DIRECTION that balances the RESIDUAL with the factor of the last iteration, and of coupled equations but a share PRECISION
   !! of it. Where the last factorisation has failed, as in an attempt that was given up, there is none.
   subroutine correction(model, system, residual, is_coupled, precision, direction, failure)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)                  :: residual(:, :)
      logical, intent(in)                   :: is_coupled
      real(wp), intent(in)                  :: precision !! [-]
      real(wp), intent(out)                 :: direction(:, :)
      type(failure_type), intent(inout)     :: failure

      if (system%has_failed) then
         call failure%raise('no factor')
      else if (is_coupled) then
         direction = residual
         call solve_coupled_again(model, precision, system, direction, failure)
      else
         call solve_by_last_factor(system, residual, direction)
      end if
   end subroutine correction

end module way_points
