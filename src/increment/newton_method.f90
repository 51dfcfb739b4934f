!> METHOD = NEWTON: each increment is iterated to equilibrium with the exact branch laws. The iterations take full steps under
!! the tangents of straight_laws. The states of the joints are committed only at equilibrium. An increment that does not
!! converge is divided. The whole increment is then repeated from the result of its parts, so that the answer does not depend on
!! the division.
module newton_method
   use analysis_state, only: all_held, analysis_type, force_noise, free_norm, iteration_record, precise, record_iteration
   use equations, only: equation_system, forces_in_bodies
   use equation_solver, only: failure_type
   use kinds, only: wp
   use load_path, only: go_back, support_force
   use model_data, only: joint_node_id, model_type
   use newton_direction, only: attempt_type, check_lifted, find_direction, loose_joint
   use newton_trial, only: commit, evaluate, search, start_trial, swap, take_step, trial_type
   use node_coupling, only: forces_on_unknowns
   use normal_curve, only: pressure_floor
   use normal_stiffness, only: at_rest, branch_name, branch_open
   use numbers, only: first_largest
   use shear_stiffness, only: shear_state
   use stage_plan, only: stage_plan_type, where_in_plan
   use straight_laws, only: first_laws, laws_at, next_laws, residual_of, straight_laws_type
   use text_tools, only: integer_text, real_text
   use unknowns, only: unknown_name
   implicit none
   private

   public :: newton_increment, cross_gaps, seat_joints, tolerance_of

   character(*), parameter, public :: no_balance = &
      'stiffnesses differ so much, or bodies move so far, that rounding prevents equilibrium'
   integer, parameter  :: most_iterations = 60
   integer, parameter  :: patience = 8                ! iterations that must leave less than the same number before them
   real(wp), parameter :: progress = 0.9_wp            ! of it: the required reduction
   integer, parameter  :: most_halvings = 12
   real(wp), parameter :: far_below = 1.0e-3_wp        ! of TOL: below it another iteration is not worth while
   real(wp), parameter :: half = 0.5_wp                ! of the residual of the load: a guess that leaves more is poor
   real(wp), parameter :: loose_end = 1.0e-2_wp, tight_end = 1.0e-4_wp, least_tolerance = 1.0e-12_wp ! what a direction may leave
   real(wp), parameter :: away = 100.0_wp              ! times the initial residual: the iterations diverge
   real(wp), parameter, public :: idle = 10.0_wp*pressure_floor !! of p_av: an interference pressure below it counts as none

   !> The course of the iterations of an attempt.
   type :: progress_type
      integer  :: iteration = 0
      real(wp) :: sizes(0:most_iterations) = 0.0_wp !! residuals [force]
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

   !> One increment of the load, from equilibrium to equilibrium.
   subroutine newton_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis !! applied is the load at the end of the increment
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(attempt_type) :: attempt
      integer :: before(size(analysis%states))

      if (analysis%is_loose .and. .not. (analysis%moves .or. any(abs(analysis%now%condensed_load) > 0.0_wp))) then
         call press_apart(model, analysis, system, failure)
         return
      end if
      before = analysis%states%normal%branch
      analysis%tolerance = max(analysis%tolerance, analysis%load_tolerance*free_norm(forces_on_unknowns(model, &
                               analysis%now%load), all_held(model, analysis)), tiny(1.0_wp))
      attempt%where = where_in_plan(plan, analysis%stage, analysis%increment)
      if (analysis%increment > 1) then
         associate (fractions => plan%stages(analysis%stage)%fractions, i => analysis%increment)
            attempt%growth = fractions(i)/fractions(i - 1)
         end associate
      end if
      call find_equilibrium(model, analysis, system, attempt, failure)
      if (.not. failure%raised) then
         call check_lifted(model, before, analysis, attempt%where, system, failure)
         return
      end if
      call go_back(plan, attempt%left_over, analysis)
      if (analysis%record%ends_early) failure%message = failure%message//'; the last state in equilibrium is at '// &
         real_text(anint(1.0e4_wp*analysis%fraction)*1.0e-4_wp)//' of stage '//integer_text(plan%stages(analysis%stage)%id)
   end subroutine newton_increment

   !> An increment of STEP in which gaps leave a body loose, iterated to equilibrium.
   subroutine cross_gaps(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure

      call newton_increment(model, plan, analysis, system, failure)
      call free_idle_joints(model, analysis)
      analysis%record%n_iterations = 0 ! these are not re-analyses
   end subroutine cross_gaps

   !> Interference presses before any load: the equilibrium at rest becomes the initial state of STEP and NEWTON. Nothing is
   !! done where no joint has a negative gap. If nothing presses at equilibrium, interference has pushed bodies away from all
   !! supports by an arbitrary distance. Then the structure stays at rest, and the interference acts with the first load.
   subroutine seat_joints(model, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis !! at rest
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(analysis_type), allocatable :: rest
      integer :: j

      if (failure%raised .or. .not. any(model%interface%gap < 0.0_wp)) return
      allocate (rest, source=analysis)
      call press_apart(model, analysis, system, failure)
      if (analysis%is_loose .and. all([(is_idle(model, analysis, j), j = 1, size(model%joints))])) then
         rest%is_loose = .true.
         rest%loose_force = analysis%loose_force
         analysis = rest
      end if
      if (allocated(analysis%exact)) analysis%exact = analysis%states
   end subroutine seat_joints

   !> The equilibrium of the structure under interference alone.
   subroutine press_apart(model, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(attempt_type) :: attempt

      analysis%tolerance = tiny(1.0_wp)
      attempt%seats = .true.
      attempt%seat_force = norm2(pack(analysis%states%normal%p_av*model%interface%area, model%interface%gap < 0.0_wp))
      attempt%where = 'interference (JGAP), before the first load'
      call find_equilibrium(model, analysis, system, attempt, failure)
      call free_idle_joints(model, analysis)
   end subroutine press_apart

   !> Where interference has pushed a body away until nothing presses, mark its joint as never pressed and the body as loose.
   subroutine free_idle_joints(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      integer :: i, j

      analysis%is_loose = .false.
      analysis%loose_force = 0.0_wp
      do j = 1, size(model%joints)
         if (.not. is_idle(model, analysis, j)) cycle
         associate (elements => model%interface(model%joints(j)%first:model%joints(j)%last), &
                    states => analysis%states(model%joints(j)%first:model%joints(j)%last)%normal)
            do i = model%joints(j)%first, model%joints(j)%last ! their sliding under almost no pressure is arbitrary
               analysis%states(i)%shear = shear_state()
               analysis%states(i)%origin = analysis%movement(:2, i)
            end do
            if (.not. any(elements%gap < 0.0_wp)) cycle
            states = at_rest(states%p_av, -states%lambda) ! with the remaining gap
            states%gap = elements%gap
            analysis%is_loose = .true.
            analysis%loose_force = norm2([analysis%loose_force, states%p_av*elements%area])
         end associate
      end do
   end subroutine free_idle_joints

   !> Whether JOINT has never carried a significant force.
   pure logical function is_idle(model, analysis, joint)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: joint

      associate (area => model%interface(model%joints(joint)%first:model%joints(joint)%last)%area, &
                 states => analysis%states(model%joints(joint)%first:model%joints(joint)%last)%normal)
         is_idle = norm2(max(states%pressure, states%p_a)*area) <= 10.0_wp*idle*norm2(states%p_av*area)
      end associate
   end function is_idle

   !> Go from equilibrium to equilibrium by ATTEMPTs: commit an attempt that converges, divide one that does not.
   subroutine find_equilibrium(model, analysis, system, attempt, failure)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)    :: attempt
      type(failure_type), intent(inout)    :: failure
      type(analysis_type), allocatable :: start
      real(wp), allocatable :: u_start(:, :)
      real(wp) :: done, part
      integer  :: before_open

      allocate (u_start, source=analysis%u)
      before_open = count(analysis%states%normal%branch == branch_open)
      done = 0.0_wp
      part = 1.0_wp
      analysis%record%n_parts = 0
      do while (done < 1.0_wp)
         part = min(part, 1.0_wp - done)
         call try_part(model, system, analysis, merge(1.0_wp - done - part, 0.0_wp, done + part < 1.0_wp), attempt)
         if (attempt%converged) then
            done = done + part
            part = 2.0_wp*part
            analysis%record%n_parts = analysis%record%n_parts + 1
         else if (part > 0.5_wp**most_halvings) then
            if (.not. allocated(start)) allocate (start, source=analysis) ! nothing is committed yet
            part = 0.5_wp*part
         else
            attempt%left_over = 1.0_wp - done
            if (attempt%trouble%raised) then
               call failure%raise(attempt%trouble%message) ! a mechanism explains more than any iteration
            else
               call give_up(model, analysis, attempt, failure)
            end if
            return
         end if
      end do
      if (allocated(start)) call make_whole(model, system, start, analysis, attempt)
      analysis%du = analysis%u - u_start
      analysis%record%n_removed = max(0, count(analysis%states%normal%branch == branch_open) - before_open)
   end subroutine find_equilibrium

   !> An ATTEMPT up to the point where LEFT of the increment remains. Straight laws start from the extrapolated last increment
   !! if this one continues it, otherwise from the committed state. If they cycle, a line search along the tangents follows. If
   !! a joint has slipped entirely, the attempt is repeated with the joints held.
   subroutine try_part(model, system, analysis, left, attempt, from)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      real(wp), intent(in)                  :: left
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(in), optional        :: from(:, :) !! (dimension, retained) initial displacements, supports moved [length]
      integer :: i

      do i = merge(0, 1, attempt%growth > 0.0_wp), 3
         if (i > 0) attempt%growth = 0.0_wp
         call start_attempt(model, system, analysis, left, attempt)
         attempt%searches = i > 1
         attempt%settled = i == 2
         attempt%floats = i == 3
         call iterate(model, system, analysis, attempt, from)
         if (attempt%converged .or. (i == 2 .and. .not. attempt%slides)) exit
      end do
   end subroutine try_part

   !> Repeat a divided increment as a whole, from the START and the displacements that its parts have reached: the laws depend
   !! on the path, and rounding decides on the division. If the whole does not converge, the parts stand.
   subroutine make_whole(model, system, start, analysis, attempt)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(in)       :: start
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      type(analysis_type), allocatable :: whole

      allocate (whole, source=start)
      whole%record = analysis%record
      whole%tolerance = analysis%tolerance
      call try_part(model, system, whole, 0.0_wp, attempt, analysis%u)
      if (attempt%converged) then
         analysis = whole
      else
         analysis%record = whole%record
         analysis%record%is_whole = .false.
      end if
   end subroutine make_whole

   !> Prepare the next ATTEMPT, up to the point where LEFT of the increment, or of the interference, remains.
   subroutine start_attempt(model, system, analysis, left, attempt)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      real(wp), intent(in)               :: left
      type(attempt_type), intent(inout)  :: attempt
      type(failure_type) :: none

      attempt%left = left
      if (attempt%seats) analysis%states%normal%gap = merge((1.0_wp - left)*model%interface%gap, model%interface%gap, &
                                                            model%interface%gap < 0.0_wp)
      attempt%load = analysis%now%condensed_load - left*analysis%change
      attempt%move = merge(analysis%now%moved(:, system%retained) - left*analysis%move - analysis%u, 0.0_wp, &
                           system%number(:, system%retained) == 0)
      if (.not. allocated(attempt%flips)) allocate (attempt%flips(size(analysis%states)))
      attempt%flips = 0
      attempt%converged = .false.
      attempt%trouble = none
   end subroutine start_attempt

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
      logical  :: guessed

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
         system%coupled%tolerance = tolerance_of(way%sizes(:iteration), far_below*analysis%tolerance, system%coupled%price > 0)
         call find_direction(model, residual, analysis, system, attempt, laws, direction)
         if (attempt%trouble%raised) exit
         step = 1.0_wp
         if (attempt%searches .and. .not. way%moves) then
            call search(model, system, attempt%load, analysis, now, direction, next, step)
         else
            call take_step(model, system, attempt%load, analysis, now, direction, next)
         end if
         if (way%moves) call note_move(model, system, next%u, analysis, attempt, way)
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

   !> The forcing term: the relative residual that a direction may leave, after trials with residuals SIZES. It is a small part
   !! of the residual of Newton's method, whose error is squared in each iteration, but not below ENOUGH. Early in an increment
   !! it is large where a factorisation is DEAR. Source: Eisenstat, Walker, SIAM J. Sci. Comput. 17 (1996) 16-32, choice 2.
   pure real(wp) function tolerance_of(sizes, enough, dear) result(tolerance)
      real(wp), intent(in) :: sizes(0:) !! [force]
      real(wp), intent(in) :: enough    !! [force]
      logical, intent(in)  :: dear
      integer :: n

      n = ubound(sizes, 1)
      tolerance = merge(loose_end, tight_end, dear)
      if (n > 0) then
         if (sizes(n - 1) < huge(1.0_wp)) tolerance = min(tolerance, (sizes(n)/sizes(n - 1))**2)
      end if
      tolerance = max(tolerance, min(tight_end, 0.1_wp*enough/max(sizes(n), tiny(1.0_wp))), least_tolerance)
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

   !> Record an iteration from NOW to NEXT for the listing, and the changes of branch.
   subroutine note_iteration(now, next, step, analysis, attempt)
      type(trial_type), intent(in)       :: now, next
      real(wp), intent(in)               :: step
      type(analysis_type), intent(inout) :: analysis
      type(attempt_type), intent(inout)  :: attempt
      logical :: flips(size(now%states))

      flips = next%states%normal%branch /= now%states%normal%branch .or. (next%states%slips .neqv. now%states%slips)
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
      system%coupled%tolerance = tight_end
      call find_direction(model, now%residual, analysis, system, attempt, laws, direction)
      if (attempt%trouble%raised) return
      call take_step(model, system, attempt%load, analysis, now, direction, next)
      if (.not. next%size < now%size) return
      call note_iteration(now, next, 1.0_wp, analysis, attempt)
      call swap(now, next)
   end subroutine refine

   !> No part of the increment is small enough: report the cause as far as known, and the element with the most changes of branch.
   subroutine give_up(model, analysis, attempt, failure)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(attempt_type), intent(in)    :: attempt
      type(failure_type), intent(inout) :: failure
      character(:), allocatable :: words
      integer :: worst

      words = attempt%where//': no equilibrium'
      if (attempt%loose > 0) then
      words = words//': joint '//integer_text(model%joints(attempt%loose)%id)//' slips or is open at all its nodes, from node '// &
                 integer_text(joint_node_id(model, model%joints(attempt%loose)%first, 1))// &
                 ' on, and does not hold the load in the direction of its movement'
      else if (attempt%imprecise) then
         words = words//': '//no_balance
      else if (analysis%record%n_iterations > 0) then
         words = words//', '//real_text(analysis%record%iterations(analysis%record%n_iterations)%after)// &
                 ' of force remain unbalanced'
         if (all(attempt%worst > 0)) words = words//', most at '//unknown_name(model, attempt%worst(1), attempt%worst(2))
      end if
      if (size(attempt%flips) > 0) then
         worst = maxloc(attempt%flips, dim=1)
         if (attempt%flips(worst) > 1) words = words//'; node '//integer_text(joint_node_id(model, worst, 1))// &
            ' changes its branch back and forth ('//integer_text(attempt%flips(worst))//' times, committed: '// &
            branch_name(analysis%states(worst)%normal%branch)//')'
      end if
      if (any((model%joints%law%shear(1)%given .or. model%joints%law%shear(2)%given) .and. &
              .not. model%joints%law%has_friction)) words = words// &
         '; an element with shear and without friction drops its shear at once when it opens: give MU on PJOINT'
      call failure%raise(words)
   end subroutine give_up

end module newton_method
