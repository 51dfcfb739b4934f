!> The iterations of METHOD = NEWTON from a committed state, or from a guess, to equilibrium. An iteration takes full steps under
!! the tangents of straight_laws: the first one with new tangents, then corrections with these tangents while they pay. Under given
!! limits of friction a line search follows the direction of an iteration, and from a guess that of a first step that leads far off.
module newton_iterations
   use analysis_state, only: analysis_type, force_noise, free_norm, iteration_record, record_iteration
   use coupled_equations, only: solve_coupled_again
   use equations, only: equation_system, forces_in_bodies, solve_equations
   use given_limits, only: falls_back, give_first_limits, is_exact, judge_limits, minimise, renew_limits, take_exact_laws
   use kinds, only: wp
   use load_path, only: support_force
   use model_data, only: model_type
   use nonlinear_elimination, only: eliminate_few
   use newton_trial, only: attempt_type, commit, evaluate, evaluate_at, search, swap, trial_type
   use numbers, only: first_largest
   use rigid_seating, only: seat_parts
   use straight_laws, only: choose_sides, direction_digits, find_direction, first_laws, forces_at, laws_at, &
                            loose_joints, next_laws, residual_of, straight_law
   use tolerances, only: far_below_tol, finest_direction, loose_direction, most_rounding_of_forces, pressure_floor, &
                         rounding_of_forces, shortest_step, tight_direction
   implicit none
   private

   public :: iterate, tolerance_of

   integer, parameter  :: most_corrections = 5
   integer, parameter  :: quick = 8                    ! iterations along straight laws that must leave less than WORTH_WHILE
   integer, parameter  :: patience = 8                 ! iterations that must leave less than the same number before them
   real(wp), parameter :: progress = 0.9_wp            ! of it: the required reduction
   integer, parameter  :: still = 3                    ! residuals one behind the other: they stand still
   real(wp), parameter :: standstill = 0.01_wp         ! if they differ by less than this part of them
   real(wp), parameter :: half = 0.5_wp                ! of the residual of the load: a guess that leaves more is poor
   real(wp), parameter :: near = 10.0_wp               ! times the tolerance: rounding that is allowed where no iteration falls
   real(wp), parameter :: worth_while = 0.1_wp         ! of its residual: a correction that leaves more is the last one
   real(wp), parameter :: not_borne = 0.9_wp           ! of a residual that straight laws leave: they do not bear it
   integer, parameter  :: most_short = 1               ! steps one behind the other that would lead FAR_AWAY
   real(wp), parameter :: away = 100.0_wp              ! times the initial residual: the iterations diverge
   real(wp), parameter :: far_off = 10.0_wp            ! times the residual of a guess: its first step is searched
   real(wp), parameter :: far_away = 1.0e6_wp          ! times the residual before it: a step that leaves more is shortened,
   real(wp), parameter :: shorter = 0.1_wp             ! to this part of it, but not below SHORTEST_STEP
   real(wp), parameter :: short = 0.1_wp               ! step under given limits [-]: after a shorter one the next straight laws are tangents
   ! creeping
   real(wp), parameter :: much_more = 2.0_wp           ! times the residual: a step that leaves so much is not taken,
   real(wp), parameter :: rise_for_it = 4.0_wp         ! and the resistance grows to so much
   real(wp), parameter :: more = 1.02_wp               ! times the residual: a step that leaves so much is taken,
   real(wp), parameter :: rise = 2.0_wp                ! and the resistance grows to so much
   real(wp), parameter :: fall = 0.5_wp                ! of the ratio of the residuals: of the resistance after any other step,
   real(wp), parameter :: least_fall = 0.01_wp         ! but not less
   real(wp), parameter :: to_a_seat = 0.1_wp           ! of a direction: a body has touched another where the least energy is before it
   real(wp), parameter, public :: idle = 10.0_wp*pressure_floor !! of p_av: an interference pressure below it counts as none

contains

   !> Iterate ATTEMPT from the committed state or from a guess, which is dropped if poor; commit a converged trial. The guess is
   !! FROM, or an extrapolation along the last increment: under a continued load, elements continue on their branches and in their
   !! sliding. Where a joint slides on as a whole, a poor guess has the right tangents, and the committed state has not.
   subroutine iterate(model, system, analysis, attempt, from)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(in), optional        :: from(:, :) !! the first trial, if not the committed state
      type(trial_type), allocatable :: now, next
      type(straight_law), allocatable :: laws(:)
      real(wp), allocatable :: at_now(:, :), direction(:, :), residual(:, :)
      integer :: at
      logical :: anew, guessed, moves
      logical :: goes_back ! creeping, the last step is not taken

      goes_back = .false.
      allocate (direction, mold=analysis%u)
      attempt%displacement_scale = max(maxval(abs(analysis%now%moved)), maxval(abs(analysis%u)))
      attempt%load_size = analysis%tolerance/analysis%load_tolerance ! the largest so far
      guessed = present(from)
      allocate (now)
      if (guessed) then
         attempt%moves = .false.
         attempt%move = 0.0_wp
         call evaluate_at(model, system, attempt, analysis, from, now)
      else
         call evaluate_at(model, system, attempt, analysis, analysis%u, now)
      end if
      attempt%at_start = merge(huge(1.0_wp), now%size, attempt%moves)
      if (attempt%with_limits) call give_first_limits(model, system, analysis, attempt, now)
      allocate (next, source=now)
      if (attempt%growth > 0.0_wp) then
         moves = attempt%moves
         direction = merge(attempt%growth*analysis%du, attempt%move, system%number(:, system%retained) > 0)
         call advance(model, system, analysis, attempt, now, direction, .true., next)
         guessed = next%size <= half*merge(attempt%load_size, now%size, moves) .or. &
                   (any(loose_joints(model, next%states)) .and. .not. any(next%states%slips .neqv. analysis%states%slips))
         call swap(now, next)
         if (.not. guessed) return
      end if
      do
         if (attempt%with_limits) call renew_limits(model, system, analysis, attempt, now)
         call judge(model, system, analysis, attempt, now)
         if (.not. (attempt%with_limits .or. attempt%moves) .and. now%size < attempt%least) then
            attempt%best = now%u
            attempt%least = now%size
         end if
         if ((attempt%converged .and. (attempt%iteration > 0 .or. .not. attempt%renews)) .or. attempt%ends) exit
         anew = attempt%iteration == 0 .or. goes_back
         ! a short step shows that the straight laws do not follow the energy; the tangents do, unless interference parts bodies
         if (attempt%with_limits) anew = anew .or. is_exact(attempt) .or. (attempt%step < short .and. .not. attempt%seats)
         if (anew) call laws_at(model, system, now, laws)
         if (attempt%iteration == 0 .and. .not. guessed) then
            call first_laws(model, now, analysis%increment <= 1, laws)
         else
            call choose_sides(model, laws)
         end if
         at_now = forces_at(system, now, laws)
         residual = residual_of(system, attempt%load, now, at_now)
         attempt%tolerance = tolerance_of(attempt%gain, now%size, far_below_tol*analysis%tolerance, system%coupled%price > 0)
         call find_direction(model, residual, analysis, system, attempt, laws, direction)
         if (attempt%trouble%raised) exit
         moves = attempt%moves
         call advance(model, system, analysis, attempt, now, direction, .false., next)
         if (.not. (moves .or. attempt%runs .or. attempt%is_limited .or. attempt%creep > 0.0_wp)) then ! near a limit load this takes longer
            if (attempt%iteration > 0) then
               call eliminate_few(model, system, analysis, attempt, now, at_now, laws, next)
            else if (guessed .and. .not. attempt%with_limits .and. next%size > far_off*now%size) then ! laws: the tangents at NOW
               call search(model, system, attempt, analysis, now, direction, next)
            end if
         end if
         attempt%gain = 1.0_wp
         if (.not. (moves .or. allocated(attempt%seen))) call correct(model, system, analysis, attempt, now, next)
         call note_iteration(now, next, analysis, attempt)
         if (.not. next%size < huge(1.0_wp)) exit
         attempt%iteration = attempt%iteration + 1
         call change_creep(now, next, attempt, goes_back)
         if (goes_back) cycle
         if (falls_back(model, system, analysis, attempt, now, next)) cycle
         if (.not. attempt%with_limits .or. allocated(attempt%seen)) &
            call next_laws(model, system, analysis, next, free_norm(residual, analysis%held), attempt, laws)
         call swap(now, next)
      end do

      ! for the message about an attempt that fails
      attempt%imprecise = attempt%noise > most_rounding_of_forces*attempt%load_size .and. .not. attempt%carried
      attempt%loose = loose_joints(model, now%states)
      attempt%worst = 0
      at = first_largest(pack(abs(now%residual), .true.), pack(.not. analysis%held, .true.))
      if (at > 0) attempt%worst = [system%retained((at - 1)/model%mesh%dimension + 1), modulo(at - 1, model%mesh%dimension) + 1]
      if (attempt%seats) analysis%tolerance = analysis%load_tolerance*attempt%load_size
      if (.not. attempt%converged) return

      attempt%creep = 0.0_wp
      if (allocated(attempt%seen)) call take_exact_laws(model, system, analysis, attempt, now)
      if (now%size > max(far_below_tol*analysis%tolerance, attempt%noise)) call refine(model, system, analysis, attempt, now, next)
      call commit(model, system, now, analysis)
   end subroutine iterate

   !> Go from NOW along DIRECTION to NEXT: to the least energy under given limits of friction, by a line search where the caller
   !! SEARCHES, or by a full step, which is shortened only where it leads FAR_AWAY: a body that hardly anything holds. Where the least
   !! energy is at a small part of DIRECTION, a body has touched another: the parts go on as rigid bodies. The step that moves the
   !! supports is a full one; from there on the support forces are the reference load.
   subroutine advance(model, system, analysis, attempt, now, direction, searches, next)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(trial_type), intent(in)       :: now
      real(wp), intent(in)               :: direction(:, :)
      logical, intent(in)                :: searches
      type(trial_type), allocatable, intent(inout) :: next

      if (allocated(attempt%seen) .and. .not. attempt%moves) then
         call minimise(model, system, analysis, attempt, now, direction, next)
         if (attempt%step > 0.0_wp .and. attempt%step < to_a_seat .and. .not. attempt%runs) &
            call seat_parts(model, system, analysis, attempt, next)
         attempt%n_still = merge(0, attempt%n_still + 1, attempt%step > 0.0_wp)
         return
      end if
      if (searches .and. .not. attempt%moves) then
         call search(model, system, attempt, analysis, now, direction, next)
         return
      end if
      attempt%step = 1.0_wp
      do
         call evaluate_at(model, system, attempt, analysis, now%u + attempt%step*direction, next)
         if (attempt%moves .or. searches .or. attempt%step <= shortest_step) exit
         if (.not. next%size > far_away*max(now%size, analysis%tolerance)) exit
         attempt%step = shorter*attempt%step
      end do
      attempt%n_short = merge(attempt%n_short + 1, 0, attempt%step < 1.0_wp)
      if (.not. attempt%moves) return
      attempt%moves = .false.
      attempt%move = 0.0_wp
      analysis%tolerance = max(analysis%tolerance, &
                               analysis%load_tolerance*support_force(model, system, analysis, next%u, attempt%left))
      attempt%load_size = analysis%tolerance/analysis%load_tolerance
   end subroutine advance

   !> The resistance of an ATTEMPT that creeps, after the step from NOW to NEXT: it falls with the residual, so that the last steps
   !! are those without it. Where a step leads up, it grows, and a step that leaves much more is not taken.
   !! Source: pseudo-transient continuation, Kelley, Keyes, SIAM J. Numer. Anal. 35 (1998) 508-523.
   pure subroutine change_creep(now, next, attempt, goes_back)
      type(trial_type), intent(in)      :: now, next
      type(attempt_type), intent(inout) :: attempt   !! its ITERATION includes this step
      logical, intent(out)              :: goes_back !! from NEXT to NOW

      goes_back = .false.
      if (.not. attempt%creep > 0.0_wp .or. attempt%iteration == 1) return ! the first step has the first laws
      goes_back = next%size > much_more*now%size
      if (goes_back) then
         attempt%creep = rise_for_it*attempt%creep
      else if (next%size > more*now%size) then
         attempt%creep = rise*attempt%creep
      else
         attempt%creep = max(fall*next%size/now%size, least_fall)*attempt%creep
      end if
   end subroutine change_creep

   !> Correct NEXT with the tangents of the step from NOW to NEXT while each correction leaves less than WORTH_WHILE of the
   !! residual. A correction takes a solution but no factorisation. The error of the tangents is that of the step, so each
   !! correction leaves about as much of its residual as the step left of the first one. A step that crosses a kink is not
   !! corrected. Source: Shamanskii, Ukr. Mat. Zh. 19 (1967) 133-138; Kelley, Iterative Methods, SIAM 1995, section 5.4.3.
   subroutine correct(model, system, analysis, attempt, now, next)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      type(trial_type), intent(in)          :: now
      type(trial_type), allocatable, intent(inout) :: next
      type(trial_type), allocatable :: corrected
      real(wp), allocatable :: direction(:, :)
      real(wp) :: enough, first
      integer  :: i

      attempt%gain = 1.0_wp
      if (.not. now%size > 0.0_wp) return ! in equilibrium to the last digit: no share of a residual is left
      first = next%size/now%size
      attempt%gain = first**2
      enough = max(half*far_below_tol*analysis%tolerance, attempt%noise)
      if (first > worth_while .or. next%size <= enough .or. any(changes(now, next))) return
      allocate (corrected, source=next)
      do i = 1, most_corrections
         attempt%tolerance = max(half*first, 0.1_wp*enough/next%size, finest_direction)
         direction = merge(next%residual, 0.0_wp, attempt%coupled)
         if (attempt%coupled) then
            call solve_coupled_again(model, attempt%tolerance, system, direction, attempt%trouble)
         else
            call solve_equations(model, system, next%residual, direction, attempt%trouble, &
                                 digits=min(direction_digits, ceiling(-log10(attempt%tolerance))))
         end if
         if (attempt%trouble%raised) return
         call evaluate_at(model, system, attempt, analysis, next%u + direction, corrected)
         if (.not. corrected%size < next%size) exit
         call swap(corrected, next)
         if (next%size > worth_while*corrected%size .or. next%size <= enough) exit
      end do
      attempt%gain = first*(next%size/now%size)
   end subroutine correct

   !> The forcing term: the relative residual that a direction may leave, not below ENOUGH. It is GAIN, the part of the residual that the
   !! next step of Newton's method should leave. Where a factorisation is DEAR more is left, since corrections with the same tangents
   !! find the rest where the laws are nearly straight; where they are not, a finer direction would not leave less.
   !! Source: Eisenstat, Walker, SIAM J. Sci. Comput. 17 (1996) 16-32, choice 2.
   pure real(wp) function tolerance_of(gain, size, enough, dear) result(tolerance)
      real(wp), intent(in) :: gain   !! see attempt_type [-]
      real(wp), intent(in) :: size   !! present residual [force]
      real(wp), intent(in) :: enough !! [force]
      logical, intent(in)  :: dear

      tolerance = merge(loose_direction, min(tight_direction, gain), dear)
      tolerance = max(tolerance, min(tight_direction, 0.1_wp*enough/max(size, tiny(1.0_wp))), finest_direction)
   end function tolerance_of

   !> Whether the trial NOW is in equilibrium, or the iterations fail. Forces in the bodies are differences of large numbers:
   !! their rounding error does not count as residual. Where this error is not small compared with the load, a body has moved
   !! away and there is no equilibrium, unless the body only moves with supports and no force acts.
   subroutine judge(model, system, analysis, attempt, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(trial_type), intent(inout)    :: now
      real(wp) :: enough, pressed, rounding

      if (attempt%seats) then ! the joint pressures on the bodies are the load
         pressed = free_norm(now%body, analysis%held)
         attempt%load_size = max(pressed, attempt%seat_force)
         analysis%tolerance = analysis%load_tolerance*attempt%load_size
         if (pressed <= idle*attempt%seat_force) analysis%tolerance = idle*attempt%seat_force ! the bodies have separated
      end if
      associate (noise => attempt%noise, load_size => attempt%load_size, n => attempt%iteration)
         noise = force_noise(system, now%u)
         attempt%largest_noise = max(attempt%largest_noise, noise)
         if (attempt%largest_noise > max(10.0_wp*noise, 0.1_wp*analysis%tolerance)) then
            ! summed from step to step, these forces have an error that after a distant trial is no longer small: compute them anew
            call forces_in_bodies(system, now%u, now%body)
            call evaluate(model, system, attempt, analysis, now)
            attempt%largest_noise = noise
         end if
         rounding = rounding_of_forces*system%stiffest*attempt%displacement_scale*sqrt(real(size(analysis%now%load), wp))
         attempt%carried = load_size <= rounding .and. maxval(abs(now%u)) <= 10.0_wp*attempt%displacement_scale
         enough = max(analysis%tolerance, 0.1_wp*noise)
         if (n > 0) then
            if (now%size > half*attempt%sizes(n - 1)) enough = max(enough, min(noise, near*analysis%tolerance)) ! only rounding is left
         end if
         attempt%converged = now%size <= enough .and. noise <= most_rounding_of_forces*load_size
         attempt%converged = attempt%converged .or. (attempt%carried .and. now%size <= rounding)
         attempt%converged = attempt%converged .and. is_exact(attempt) .and. .not. attempt%moves
         attempt%sizes(n) = merge(huge(1.0_wp), now%size, attempt%moves)
         attempt%ends = n == attempt%most
         if (attempt%with_limits) then
            call judge_limits(model, system, analysis, now, attempt)
         else if (attempt%creep > 0.0_wp) then
            if (n >= patience) attempt%ends = attempt%ends .or. stands_still(attempt%sizes(n - patience + 1:n))
         else
            attempt%ends = attempt%ends .or. leads_nowhere(attempt%sizes(:n)) .or. &
                           is_slow(attempt%sizes(:n)) .or. attempt%unborne > not_borne .or. attempt%n_short > most_short
         end if
         if (attempt%ends) attempt%converged = attempt%converged .or. &
                                               now%size <= idle*max(attempt%seat_force, analysis%loose_force)
         attempt%ends = attempt%ends .or. (noise > load_size .and. .not. (attempt%carried .or. attempt%moves))
      end associate
   end subroutine judge

   !> Which interface elements change their branch, or begin or stop slipping, from NOW to NEXT.
   pure function changes(now, next)
      type(trial_type), intent(in) :: now, next
      logical :: changes(size(now%states))

      changes = next%states%normal%branch /= now%states%normal%branch .or. (next%states%slips .neqv. now%states%slips)
   end function changes

   !> Record an iteration from NOW to NEXT for the listing, and the changes of branch.
   subroutine note_iteration(now, next, analysis, attempt)
      type(trial_type), intent(in)       :: now, next
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      logical :: flips(size(now%states))

      flips = changes(now, next)
      where (flips) attempt%flips = attempt%flips + 1
      call record_iteration(analysis, iteration_record(before=now%size, after=next%size, step=attempt%step, changes=count(flips), &
                                             part=analysis%record%n_parts + 1))
   end subroutine note_iteration

   !> Whether the residuals SIZES differ by less than STANDSTILL.
   pure logical function stands_still(sizes)
      real(wp), intent(in) :: sizes(:) !! [force]

      stands_still = maxval(sizes) < (1.0_wp + standstill)*minval(sizes)
   end function stands_still

   !> Whether iterations with residuals SIZES fail: the last of them hardly reduce the residual, or they diverge. A fixed number
   !! of iterations would not do: rounding would decide which of them is the last.
   pure logical function leads_nowhere(sizes)
      real(wp), intent(in) :: sizes(:) !! [force]
      integer :: n

      n = size(sizes)
      leads_nowhere = n > still
      if (leads_nowhere) leads_nowhere = stands_still(sizes(n - still + 1:))
      if (leads_nowhere) return
      leads_nowhere = n > patience
      if (leads_nowhere) leads_nowhere = minval(sizes(n - patience/2:n)) > away*sizes(1)
      if (leads_nowhere) return
      leads_nowhere = n >= 2*patience
      if (leads_nowhere) leads_nowhere = minval(sizes(n - patience + 1:)) > &
                                         progress*minval(sizes(n - 2*patience + 1:n - patience))
   end function leads_nowhere

   !> Whether the last QUICK iterations with residuals SIZES have left more than WORTH_WHILE of the one before them.
   pure logical function is_slow(sizes)
      real(wp), intent(in) :: sizes(:) !! [force]
      integer :: n

      n = size(sizes)
      is_slow = n > quick + 1
      if (is_slow) is_slow = minval(sizes(n - quick + 1:)) > worth_while*sizes(n - quick)
   end function is_slow

   !> One iteration more from the converged NOW. It squares the residual that TOL has left, so that the state does not depend on
   !! the path of the iterations, which rounding influences. It is accepted where it reduces the residual.
   subroutine refine(model, system, analysis, attempt, now, next)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt !! a failure of this iteration does not count
      type(trial_type), allocatable, intent(inout) :: now, next
      type(straight_law), allocatable :: laws(:)
      real(wp), allocatable :: direction(:, :)

      allocate (direction, mold=analysis%u)
      call laws_at(model, system, now, laws)
      call choose_sides(model, laws)
      attempt%tolerance = tight_direction
      call find_direction(model, now%residual, analysis, system, attempt, laws, direction)
      if (attempt%trouble%raised) return
      call advance(model, system, analysis, attempt, now, direction, .false., next)
      if (.not. next%size < now%size) return
      call note_iteration(now, next, analysis, attempt)
      call swap(now, next)
   end subroutine refine

end module newton_iterations
