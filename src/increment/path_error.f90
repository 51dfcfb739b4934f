!> The error of path of METHOD = NEWTON: how far the end of an increment, or of a part of it, is from the limit of many increments.
!! An increment takes every interface element from its start to its end in one movement. An element that the load presses and lets
!! go meanwhile, or whose shear and pressure do not grow in proportion, has another force at the end. The way is found from the
!! displacements half way: a few corrections with the factor of the last iteration, from the mean of both ends under the mean load.
!! The exact laws, followed along the parabola through the three states, give the forces that the path leads to; one more solution
!! with the factor gives the displacements that their difference causes.
module path_error
   use analysis_state, only: analysis_type, path_error_type, turning_point
   use equations, only: equation_system, solve_coupled_again, solve_equations
   use interface_operator, only: joint_movement
   use joint_laws, only: element_state, follow_element, force_of, rest_when_open
   use joint_work, only: joint_energy
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: attempt_type, evaluate_at, trial_type
   use normal_stiffness, only: branch_open
   use straight_laws, only: direction_digits
   use tolerances, only: contact_pressure, tight_direction
   implicit none
   private

   public :: note_start, go_to_start, measure_path, is_within

   integer, parameter  :: most_corrections = 3, most_shortenings = 3
   real(wp), parameter :: close_enough = 1.0e-3_wp   ! of the residual of the mean of both ends: left half way
   real(wp), parameter :: contact_per_tol = 10.0_wp  ! share of the area that may change its contact, in PATHTOL
   real(wp), parameter :: equal_shares = 1.0e-6_wp   ! of the limit: rounding of a sum of areas

   !> What an attempt changes when it is committed.
   type, public :: path_start_type
      private
      real(wp), allocatable :: u(:, :), body(:, :), unbalanced(:, :), movement(:, :)
      type(element_state), allocatable :: states(:)
      type(joint_energy), allocatable  :: energy(:)
      type(turning_point), allocatable :: turns(:, :)
      integer, allocatable :: kind(:)
   end type path_start_type

contains

   !> Note the state from which an attempt starts.
   subroutine note_start(analysis, start)
      type(analysis_type), intent(in)    :: analysis
      type(path_start_type), intent(out) :: start

      start%u = analysis%u
      start%body = analysis%body
      start%unbalanced = analysis%unbalanced
      start%movement = analysis%movement
      start%states = analysis%states
      start%energy = analysis%energy
      start%turns = analysis%turns
      start%kind = analysis%record%kind
   end subroutine note_start

   !> Return to the state from which an attempt has started.
   subroutine go_to_start(start, analysis)
      type(path_start_type), intent(in)  :: start
      type(analysis_type), intent(inout) :: analysis

      analysis%u = start%u
      analysis%body = start%body
      analysis%unbalanced = start%unbalanced
      analysis%movement = start%movement
      analysis%states = start%states
      analysis%energy = start%energy
      analysis%turns = start%turns
      analysis%record%kind = start%kind
   end subroutine go_to_start

   !> The ERROR of path of the committed ATTEMPT at a PART of the increment from START, alone and in all, and displacements HALF way.
   !! WAY goes on along the path, from the states to which it has led up to the start.
   subroutine measure_path(model, system, start, part, analysis, attempt, way, error, half)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system   !! with the factor of the last iteration
      type(path_start_type), intent(inout)  :: start    !! returned as it was
      real(wp), intent(in)                  :: part     !! of the increment [-]
      type(analysis_type), intent(inout)    :: analysis !! likewise
      type(attempt_type), intent(inout)     :: attempt
      type(element_state), allocatable, intent(inout) :: way(:)
      type(path_error_type), intent(out)    :: error(2) !! of the part, from the start of WAY
      real(wp), allocatable, intent(out)    :: half(:, :) !! (dimension, retained) [length]
      type(element_state), allocatable :: along(:)
      type(trial_type) :: trial

      half = 0.5_wp*(start%u + analysis%u)
      if (size(way) == 0 .or. attempt%iteration == 0) return ! at rest: there is no factor
      along = start%states
      call approach(model, system, attempt%load - 0.5_wp*part*analysis%change, half, along, analysis, attempt, trial)
      half = trial%u
      call find_error(model, system, start, half, analysis, attempt, along, error(1))
      call find_error(model, system, start, half, analysis, attempt, way, error(2))
   end subroutine measure_path

   !> The ERROR of the committed states: their difference from those ALONG the way over HALF, in equilibrium at its end.
   subroutine find_error(model, system, start, half, analysis, attempt, along, error)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(path_start_type), intent(in)     :: start
      real(wp), intent(in)                  :: half(:, :)
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      type(element_state), allocatable, intent(inout) :: along(:)
      type(path_error_type), intent(out)    :: error
      type(trial_type) :: trial
      integer :: i

      call follow_way(model, system, start, half, analysis, along)
      call approach(model, system, attempt%load, analysis%u, along, analysis, attempt, trial)
      along = trial%states
      do i = 1, size(along)
         call rest_when_open(along(i), joint_movement(system%interface(i), trial%u))
      end do
      call compare_states(model, system, analysis%states, along, trial%u - analysis%u, error)
   end subroutine find_error

   !> The TRIAL near equilibrium under the LOAD, to which the states BEFORE lead: from the displacements U, a few corrections with
   !! the factor of the last iteration. A correction that does not reduce the residual is shortened: the factor may be that of
   !! loading where elements unload.
   subroutine approach(model, system, load, u, before, analysis, attempt, trial)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)                  :: load(:, :), u(:, :)
      type(element_state), allocatable, intent(inout) :: before(:) !! returned as they were
      type(analysis_type), intent(inout)    :: analysis            !! likewise
      type(attempt_type), intent(inout)     :: attempt
      type(trial_type), intent(out)         :: trial
      type(trial_type) :: next
      real(wp) :: direction(size(u, 1), size(u, 2)), first
      integer  :: i, k

      call exchange_states(before, analysis%states)
      call evaluate_at(model, system, load, analysis, u, trial)
      first = trial%size
      do i = 1, most_corrections
         if (attempt%trouble%raised .or. trial%size <= max(close_enough*first, analysis%tolerance)) exit
         call correction(model, system, trial%residual, attempt, direction)
         if (attempt%trouble%raised) exit
         do k = 0, most_shortenings
            call evaluate_at(model, system, load, analysis, trial%u + 0.25_wp**k*direction, next)
            if (next%size < trial%size) exit
         end do
         if (.not. next%size < trial%size) exit
         trial = next
      end do
      call exchange_states(before, analysis%states)
   end subroutine approach

   subroutine exchange_states(a, b)
      type(element_state), allocatable, intent(inout) :: a(:), b(:)
      type(element_state), allocatable :: c(:)

      call move_alloc(a, c)
      call move_alloc(b, a)
      call move_alloc(c, b)
   end subroutine exchange_states

   !> The DIRECTION that balances the RESIDUAL with the factor of the last iteration.
   subroutine correction(model, system, residual, attempt, direction)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)                  :: residual(:, :)
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(out)                 :: direction(:, :)

      direction = merge(residual, 0.0_wp, attempt%coupled)
      attempt%tolerance = tight_direction
      if (attempt%coupled) then
         call solve_coupled_again(model, attempt%tolerance, system, direction, attempt%trouble)
      else
         call solve_equations(model, system, residual, direction, attempt%trouble, digits=direction_digits)
      end if
   end subroutine correction

   !> Follow the states ALONG the way from START over HALF up to three quarters of it.
   subroutine follow_way(model, system, start, half, analysis, along)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(path_start_type), intent(in)  :: start
      real(wp), intent(in)               :: half(:, :)
      type(analysis_type), intent(in)    :: analysis
      type(element_state), intent(inout) :: along(:)
      real(wp), parameter :: weights(3, 3) = reshape([0.375_wp, 0.75_wp, -0.125_wp, 0.0_wp, 1.0_wp, 0.0_wp, &
                                                      -0.125_wp, 0.75_wp, 0.375_wp], [3, 3])
      type(element_state) :: after
      real(wp) :: at(3, 3), movement(3), tangent(3, 3)
      integer  :: i, k

      do i = 1, size(along)
         associate (element => model%joints%element(i))
            at(:, 1) = start%movement(:, i)
            at(:, 2) = joint_movement(system%interface(i), half)
            at(:, 3) = analysis%movement(:, i)
            do k = 1, 3
               movement = matmul(at, weights(:, k))
               call follow_element(model%joints%list(element%joint)%law, element%area, along(i), movement, after, tangent)
               call rest_when_open(after, movement)
               along(i) = after
            end do
         end associate
      end do
   end subroutine follow_way

   !> The largest pressure or shear stress so far.
   pure real(wp) function pressure_scale(states) result(scale)
      type(element_state), intent(in) :: states(:)

      scale = max(maxval(states%normal%p_a), maxval(states%normal%pressure), maxval(abs(states%shear(1)%tau)), &
                  maxval(abs(states%shear(2)%tau)))
   end function pressure_scale

   !> The ERROR of the committed STATES, from those ALONG the way, whose displacements are larger by DIFFERENCE.
   subroutine compare_states(model, system, states, along, difference, error)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(element_state), intent(in)    :: states(:), along(:)
      real(wp), intent(in)               :: difference(:, :)
      type(path_error_type), intent(out) :: error
      real(wp) :: area(size(model%joints%list)), force(3), movement(3), lambda, stress, moved
      logical  :: closed(2)
      integer  :: i

      area = 0.0_wp
      stress = pressure_scale(along)
      lambda = max(maxval(along%normal%lambda_a), maxval(along%normal%lambda))
      if (.not. (stress > 0.0_wp .and. lambda > 0.0_wp)) return
      moved = max(lambda, maxval(abs(along%shear(1)%delta)), maxval(abs(along%shear(2)%delta)))
      do i = 1, size(states)
         associate (element => model%joints%element(i))
            closed = [states(i)%normal%branch, along(i)%normal%branch] /= branch_open
            if (.not. any(closed)) cycle
            movement = joint_movement(system%interface(i), difference)
            call note_larger(abs(movement(3))/lambda, i, error%deflection, error%deflected)
            call note_larger(maxval(abs(movement(:2)))/moved, i, error%deflection, error%deflected)
            force = force_of(element%area, along(i)) - force_of(element%area, states(i))
            call note_larger(maxval(abs(force))/(element%area*stress), i, error%pressure, error%pressed)
            if (closed(1) .neqv. closed(2)) then
               if (max(states(i)%normal%pressure, along(i)%normal%pressure) > contact_pressure*stress) &
                  area(element%joint) = area(element%joint) + element%area
            end if
         end associate
      end do
      error%contact = maxval(area/model%joints%list%area)
   end subroutine compare_states

   !> Let VALUE of ELEMENT be the LARGEST, found AT that element, where it is larger; of equal ones the first counts.
   pure subroutine note_larger(value, element, largest, at)
      real(wp), intent(in)    :: value
      integer, intent(in)     :: element
      real(wp), intent(inout) :: largest
      integer, intent(inout)  :: at

      if (.not. value > largest*(1.0_wp + equal_shares)) return
      largest = value
      at = element
   end subroutine note_larger

   !> Whether the ERROR of a PART of an increment is within TOLERANCE; errors of parts add up like independent ones. The contact is
   !! asked of states that are printed: elements of little pressure open and close meanwhile without effect on the end.
   pure logical function is_within(error, part, tolerance, at_end)
      type(path_error_type), intent(in) :: error
      real(wp), intent(in)              :: part      !! of the change of load of the stage [-]
      real(wp), intent(in)              :: tolerance !! PATHTOL
      logical, intent(in)               :: at_end    !! of the increment

      is_within = max(error%deflection, error%pressure) <= tolerance*sqrt(part)
      if (at_end) is_within = is_within .and. error%contact <= contact_per_tol*tolerance*(1.0_wp + equal_shares)
   end function is_within

end module path_error
