!> The iterations of METHOD = NEWTON from a committed state, or from a guess, to equilibrium. An iteration takes full steps under
!! the tangents of straight_laws: the first one with new tangents, then corrections with these tangents while they pay.
module newton_iterations
   use analysis_state, only: analysis_type, force_noise, free_norm, iteration_record, precise, record_iteration
   use equations, only: equation_system, forces_in_bodies
   use kinds, only: wp
   use load_path, only: support_force
   use model_data, only: model_type
   use newton_direction, only: attempt_type, find_again, find_direction, loose_joint
   use newton_trial, only: commit, evaluate, search, start_trial, swap, take_step, trial_type
   use normal_curve, only: pressure_floor
   use numbers, only: first_largest
   use straight_laws, only: first_laws, laws_at, next_laws, residual_of, straight_laws_type
   implicit none
   private

   public :: iterate, tolerance_of

   integer, parameter  :: most_iterations = 60
   integer, parameter  :: most_corrections = 5
   integer, parameter  :: patience = 8                 ! iterations that must leave less than the same number before them
   real(wp), parameter :: progress = 0.9_wp            ! of it: the required reduction
   real(wp), parameter :: far_below = 1.0e-3_wp        ! of TOL: below it another iteration is not worth while
   real(wp), parameter :: half = 0.5_wp                ! of the residual of the load: a guess that leaves more is poor
   real(wp), parameter :: worth_while = 0.1_wp         ! of its residual: a correction that leaves more is the last one
   real(wp), parameter :: loose_end = 1.0e-2_wp, tight_end = 1.0e-4_wp, least_tolerance = 1.0e-12_wp ! what a direction may leave
   real(wp), parameter :: away = 100.0_wp              ! times the initial residual: the iterations diverge
   real(wp), parameter, public :: idle = 10.0_wp*pressure_floor !! of p_av: an interference pressure below it counts as none

   !> The course of the iterations of an attempt.
   type :: progress_type
      integer  :: iteration = 0
      real(wp) :: sizes(0:most_iterations) = 0.0_wp !! residuals [force]
      real(wp) :: gain = 1.0_wp                     !! part of the present residual that the next step should leave [-]
      integer  :: circles = 0                       !! iterations that did not halve the residual
      real(wp) :: load_size = 0.0_wp                !! reference force of the residuals [force]
      real(wp) :: noise = 0.0_wp                    !! present rounding error of the forces in the bodies [force]
      real(wp) :: spoilt = 0.0_wp                   !! its largest value since these forces were computed [force]
      real(wp) :: travel = 0.0_wp                   !! of the supports or anything, at the beginning [length]
      logical  :: moves = .false.                   !! the next iteration moves supports
      logical  :: carried = .false.                 !! bodies only move with supports, and no force acts
      logical  :: ends = .false.                    !! no further iteration
   end type progress_type

contains

   !> Iterate ATTEMPT from the committed state or from a guess, which is dropped if poor; commit a converged trial. The first
   !! iteration moves the supports.
   subroutine iterate(model, system, analysis, attempt, from)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(in), optional        :: from(:, :) !! the first trial, if not the committed state
      type(trial_type), allocatable :: now, next
      type(straight_laws_type) :: laws
      type(progress_type)      :: way
      real(wp), allocatable :: direction(:, :), residual(:, :)
      real(wp) :: step
      integer  :: iteration
      logical  :: guessed, moves

      allocate (now, next)
      allocate (direction, mold=analysis%u)
      way%moves = analysis%moves .and. .not. present(from)
      way%travel = max(maxval(abs(analysis%now%moved)), maxval(abs(analysis%u)))
      way%load_size = analysis%tolerance/analysis%load_tolerance ! the largest so far
      call start_trial(system, analysis, now)
      call start_trial(system, analysis, next)
      if (present(from)) then
         attempt%move = 0.0_wp
         now%u = from
         call forces_in_bodies(system, now%u, now%body)
      end if
      call evaluate(model, system, attempt%load, analysis, now)
      guessed = present(from)
      if (attempt%growth > 0.0_wp) then
         call extrapolate(model, system, analysis, attempt, way, now, next, guessed)
         if (.not. guessed) return
      end if
      do iteration = 0, most_iterations
         call judge(model, system, iteration, analysis, attempt, way, now)
         if (attempt%converged .or. way%ends) exit
         if (guessed .and. iteration == 0) then
            call laws_at(model, system, now, laws)
         else if (iteration == 0) then
            call first_laws(model, system, analysis, now, analysis%increment <= 1 .and. .not. attempt%searches, laws)
         end if
         residual = residual_of(system, attempt%load, now, laws)
         attempt%tolerance = tolerance_of(way%gain, now%size, far_below*analysis%tolerance, system%coupled%price > 0)
         call find_direction(model, residual, analysis, system, attempt, laws, direction)
         if (attempt%trouble%raised) exit
         step = 1.0_wp
         if (attempt%searches .and. .not. way%moves) then
            call search(model, system, attempt%load, analysis, now, direction, next, step)
         else
            call take_step(model, system, attempt%load, analysis, now, direction, next)
         end if
         moves = way%moves
         if (moves) call note_move(model, system, next%u, analysis, attempt, way)
         way%gain = 1.0_wp
         if (.not. moves) call correct(model, system, analysis, attempt, now, next, way)
         call note_iteration(now, next, step, analysis, attempt)
         if (.not. next%size < huge(1.0_wp)) exit
         call renew_laws(model, system, analysis, next, free_norm(residual, analysis%held), attempt, way, laws)
         call swap(now, next)
      end do
      call note_end(model, system, now, way, analysis, attempt)
      if (.not. attempt%converged) return
      if (now%size > max(far_below*analysis%tolerance, way%noise)) call refine(model, system, analysis, attempt, now, next)
      call commit(model, system, now, analysis)
   end subroutine iterate

   !> Extrapolate NOW from the committed state along the last increment as far as the work of the unbalanced forces falls: under
   !! a continued load, elements continue on their branches and in their sliding. FOUND: the residual is smaller there.
   subroutine extrapolate(model, system, analysis, attempt, way, now, next, found)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(in)    :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      type(progress_type), intent(inout)    :: way
      type(trial_type), allocatable, intent(inout) :: now, next
      logical, intent(out)                  :: found
      real(wp), allocatable :: direction(:, :)
      real(wp) :: step

      allocate (direction, source=merge(attempt%growth*analysis%du, attempt%move, system%number(:, system%retained) > 0))
      if (way%moves) then
         call take_step(model, system, attempt%load, analysis, now, direction, next)
         call note_move(model, system, next%u, analysis, attempt, way)
         found = next%size <= half*way%load_size
      else
         call search(model, system, attempt%load, analysis, now, direction, next, step)
         found = next%size <= half*now%size
      end if
      call swap(now, next)
   end subroutine extrapolate

   !> The supports have been moved, to the displacements U: the support forces become the reference load.
   subroutine note_move(model, system, u, analysis, attempt, way)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: u(:, :)
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(progress_type), intent(inout) :: way

      way%moves = .false.
      attempt%move = 0.0_wp
      analysis%tolerance = max(analysis%tolerance, &
                               analysis%load_tolerance*support_force(model, system, analysis, u, attempt%left))
      way%load_size = analysis%tolerance/analysis%load_tolerance
   end subroutine note_move

   !> Correct NEXT with the tangents of the step from NOW to NEXT while each correction leaves less than WORTH_WHILE of the
   !! residual. A correction takes a solution but no factorisation. The error of the tangents is that of the step, so each
   !! correction leaves about as much of its residual as the step left of the first one. A step that crosses a kink is not
   !! corrected. Source: Shamanskii, Ukr. Mat. Zh. 19 (1967) 133-138; Kelley, Iterative Methods, SIAM 1995, section 5.4.3.
   subroutine correct(model, system, analysis, attempt, now, next, way)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      type(trial_type), intent(in)          :: now
      type(trial_type), allocatable, intent(inout) :: next
      type(progress_type), intent(inout)    :: way
      type(trial_type), allocatable :: corrected
      real(wp), allocatable :: direction(:, :)
      real(wp) :: enough, first
      integer  :: i

      first = next%size/now%size
      way%gain = first**2
      enough = max(half*far_below*analysis%tolerance, way%noise)
      if (attempt%searches .or. first > worth_while .or. next%size <= enough .or. any(changes(now, next))) return
      allocate (corrected, source=next)
      allocate (direction, mold=next%u)
      do i = 1, most_corrections
         attempt%tolerance = max(half*first, 0.1_wp*enough/next%size, least_tolerance)
         call find_again(model, next%residual, system, attempt, direction)
         if (attempt%trouble%raised) return
         call take_step(model, system, attempt%load, analysis, next, direction, corrected)
         if (.not. corrected%size < next%size) exit
         call swap(corrected, next)
         if (next%size > worth_while*corrected%size .or. next%size <= enough) exit
      end do
      way%gain = first*(next%size/now%size)
   end subroutine correct

   !> The forcing term: the relative residual that a direction may leave. It is GAIN, the part of the residual that the next step
   !! of Newton's method should leave, but not below ENOUGH. Early in an increment it is large where a factorisation is DEAR.
   !! Source: Eisenstat, Walker, SIAM J. Sci. Comput. 17 (1996) 16-32, choice 2.
   pure real(wp) function tolerance_of(gain, size, enough, dear) result(tolerance)
      real(wp), intent(in) :: gain   !! see progress_type [-]
      real(wp), intent(in) :: size   !! present residual [force]
      real(wp), intent(in) :: enough !! [force]
      logical, intent(in)  :: dear

      tolerance = min(merge(loose_end, tight_end, dear), gain)
      tolerance = max(tolerance, min(tight_end, 0.1_wp*enough/max(size, tiny(1.0_wp))), least_tolerance)
   end function tolerance_of

   !> Whether the trial NOW is in equilibrium, or the iterations fail. Forces in the bodies are differences of large numbers:
   !! their rounding error does not count as residual. Where this error is not small compared with the load, a body has moved
   !! away and there is no equilibrium, unless the body only moves with supports and no force acts.
   subroutine judge(model, system, iteration, analysis, attempt, way, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      integer, intent(in)                :: iteration
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(progress_type), intent(inout) :: way
      type(trial_type), intent(inout)    :: now
      real(wp) :: pressed, rounding

      if (attempt%seats) then ! the joint pressures on the bodies are the load
         pressed = free_norm(now%body, analysis%held)
         way%load_size = max(pressed, attempt%seat_force)
         analysis%tolerance = analysis%load_tolerance*way%load_size
         if (pressed <= idle*attempt%seat_force) analysis%tolerance = idle*attempt%seat_force ! the bodies have separated
      end if
      way%noise = force_noise(system, now%u)
      call renew_forces(model, system, analysis, attempt, way%noise, way%spoilt, now)
      rounding = 10.0_wp*epsilon(1.0_wp)*system%stiffest*way%travel*sqrt(real(size(analysis%now%load), wp))
      way%carried = way%load_size <= rounding .and. maxval(abs(now%u)) <= 10.0_wp*way%travel
      attempt%converged = now%size <= max(analysis%tolerance, 0.1_wp*way%noise) .and. way%noise <= precise*way%load_size
      attempt%converged = .not. way%moves .and. (attempt%converged .or. (way%carried .and. now%size <= rounding))
      way%sizes(iteration) = merge(huge(1.0_wp), now%size, way%moves)
      way%ends = iteration == most_iterations .or. leads_nowhere(way%sizes(:iteration))
      if (way%ends) attempt%converged = attempt%converged .or. now%size <= idle*max(attempt%seat_force, analysis%loose_force)
      way%ends = way%ends .or. (way%noise > way%load_size .and. .not. (way%carried .or. way%moves))
      way%iteration = iteration
   end subroutine judge

   !> Set the straight laws for the next iteration, from NEXT. Iterations that cycle get another rho.
   subroutine renew_laws(model, system, analysis, next, unbalanced, attempt, way, laws)
      type(model_type), intent(in)            :: model
      class(equation_system), intent(in)      :: system
      type(analysis_type), intent(in)         :: analysis
      type(trial_type), intent(in)            :: next
      real(wp), intent(in)                    :: unbalanced
      type(attempt_type), intent(inout)       :: attempt
      type(progress_type), intent(inout)      :: way
      type(straight_laws_type), intent(inout) :: laws
      real(wp) :: softer
      integer  :: flips

      if (attempt%searches) then
         call laws_at(model, system, next, laws)
         return
      end if
      associate (n => way%iteration)
         if (n > 4) then
            if (next%size > 0.5_wp*minval(way%sizes(n - 2:n))) way%circles = way%circles + 1
         end if
         softer = 1.0_wp
         if (way%circles > 0) softer = merge(10.0_wp, 0.1_wp, modulo(way%circles, 2) == 1)
         call next_laws(model, system, analysis, next, unbalanced, softer, laws, flips)
         attempt%settled = n > 1 .and. flips == 0
      end associate
   end subroutine renew_laws

   !> Which interface elements change their branch, or begin or stop slipping, from NOW to NEXT.
   pure function changes(now, next)
      type(trial_type), intent(in) :: now, next
      logical :: changes(size(now%states))

      changes = next%states%normal%branch /= now%states%normal%branch .or. (next%states%slips .neqv. now%states%slips)
   end function changes

   !> Record an iteration from NOW to NEXT for the listing, and the changes of branch.
   subroutine note_iteration(now, next, step, analysis, attempt)
      type(trial_type), intent(in)       :: now, next
      real(wp), intent(in)               :: step
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      logical :: flips(size(now%states))

      flips = changes(now, next)
      where (flips) attempt%flips = attempt%flips + 1
      call record_iteration(analysis, iteration_record(before=now%size, after=next%size, step=step, changes=count(flips), &
                                             part=analysis%record%n_parts + 1))
   end subroutine note_iteration

   !> Record the end of ATTEMPT at the trial NOW.
   subroutine note_end(model, system, now, way, analysis, attempt)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(trial_type), intent(in)       :: now
      type(progress_type), intent(in)    :: way
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      integer :: at

      attempt%imprecise = way%noise > precise*way%load_size .and. .not. way%carried
      attempt%loose = loose_joint(model, now%states)
      attempt%slides = attempt%loose > 0 .and. any(now%states%slips)
      at = first_largest(pack(abs(now%residual), .true.), pack(.not. analysis%held, .true.))
      attempt%worst = 0
      associate (n => size(now%residual, 1))
         if (at > 0) attempt%worst = [system%retained((at - 1)/n + 1), modulo(at - 1, n) + 1]
      end associate
      if (attempt%seats) analysis%tolerance = analysis%load_tolerance*way%load_size
   end subroutine note_end

   !> Whether iterations with residuals SIZES fail: the last of them hardly reduce the residual, or they diverge. A fixed number
   !! of iterations would not do: rounding would decide which of them is the last.
   pure logical function leads_nowhere(sizes)
      real(wp), intent(in) :: sizes(:) !! [force]
      integer :: n

      n = size(sizes)
      leads_nowhere = n > patience
      if (leads_nowhere) leads_nowhere = minval(sizes(n - patience/2:n)) > away*sizes(1)
      if (leads_nowhere) return
      leads_nowhere = n >= 2*patience
      if (leads_nowhere) leads_nowhere = minval(sizes(n - patience + 1:)) > &
                                         progress*minval(sizes(n - 2*patience + 1:n - patience))
   end function leads_nowhere

   !> Recompute the forces in the bodies, which are summed from step to step. After a distant trial their rounding error is no
   !! longer small compared with the NOISE at the present trial.
   subroutine renew_forces(model, system, analysis, attempt, noise, spoilt, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(in)     :: attempt
      real(wp), intent(in)               :: noise  !! rounding error at NOW [force]
      real(wp), intent(inout)            :: spoilt !! the largest since they were computed
      type(trial_type), intent(inout)    :: now

      spoilt = max(spoilt, noise)
      if (spoilt <= max(10.0_wp*noise, 0.1_wp*analysis%tolerance)) return
      call forces_in_bodies(system, now%u, now%body)
      call evaluate(model, system, attempt%load, analysis, now)
      spoilt = noise
   end subroutine renew_forces

   !> One iteration more from the converged NOW. It squares the residual that TOL has left, so that the state does not depend on
   !! the path of the iterations, which rounding influences. It is accepted where it reduces the residual.
   subroutine refine(model, system, analysis, attempt, now, next)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt !! a failure of this iteration does not count
      type(trial_type), allocatable, intent(inout) :: now, next
      real(wp), allocatable    :: direction(:, :)
      type(straight_laws_type) :: laws

      allocate (direction, mold=analysis%u)
      call laws_at(model, system, now, laws)
      attempt%tolerance = tight_end
      call find_direction(model, now%residual, analysis, system, attempt, laws, direction)
      if (attempt%trouble%raised) return
      call take_step(model, system, attempt%load, analysis, now, direction, next)
      if (.not. next%size < now%size) return
      call note_iteration(now, next, 1.0_wp, analysis, attempt)
      call swap(now, next)
   end subroutine refine

end module newton_iterations
