!> Coulomb friction as a sequence of problems with given limits, for increments on which straight laws do not lead quickly to
!! equilibrium.
!! With given limits of friction, and given pressures for the shear laws, the force of every joint is a monotone function of its
!! movement: the equilibrium is the minimum of a convex energy, which Newton's method with a line search finds. The pressures of that
!! equilibrium give new limits, and so on. The first limits are those of the best trial of the straight laws, or nothing slips. From the
!! second equilibrium on the full tangents, which know that the limit grows with the pressure, try to finish; where one of them leaves
!! more than half of the residual, new limits follow.
!! Where the limits are those of the trial itself, its equilibrium is that of the exact laws: the answer is the same.
!! Source: P. D. Panagiotopoulos, Ing.-Arch. 44 (1975) 421-432; N. Kikuchi, J. T. Oden, Contact Problems in Elasticity, SIAM 1988.
module given_limits
   use analysis_state, only: analysis_type, subtract_joint_forces
   use equations, only: equation_system, forces_in_bodies
   use interface_operator, only: joint_movement
   use joint_laws, only: friction_limit
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: attempt_type, evaluate, trial_type, verdict_type
   use normal_stiffness, only: branch_load, branch_open
   use tolerances, only: farther_off, near_by, pressure_floor, same_work
   implicit none
   private

   public :: give_first_limits, renew_limits, take_exact_laws, falls_back, is_exact, minimise, judge_limits

   real(wp), parameter :: solved = 1.0e-1_wp   ! of the residual with the first trial under given limits: time for new limits
   real(wp), parameter :: below_tol = 0.1_wp   ! of the tolerance: likewise
   real(wp), parameter :: converges = 0.5_wp   ! of the residual: an iteration of the exact laws that leaves more does not converge
   real(wp), parameter :: close = 0.2_wp       ! of the work of the first unbalanced forces: what a line search may leave
   real(wp), parameter :: longest = 10.0_wp    ! times the last step: the next one of a line search
   real(wp), parameter :: enough = 0.8_wp      ! of that work: what a full step may leave
   integer, parameter  :: most_flat = 4        ! such trials, one behind the other
   real(wp), parameter :: most_of_work = 0.5_wp ! on a body that moves on: it falls if the load does less
   real(wp), parameter :: slides = 0.2_wp      ! of the work of the limits of friction: joints slide where pressures do less work
   real(wp), parameter :: hardly_falls = 0.97_wp ! of the work is left from NEAR_BY to FARTHER_OFF: a body moves on
   integer, parameter  :: most_moving = 2      ! such directions; one where given limits have not borne a part of the increment before
   integer, parameter  :: most_trials = 20     ! of a line search
   integer, parameter  :: patience = 40        ! iterations in which a problem is solved
   integer, parameter  :: most_returns = 10    ! of the exact laws: their limits have no equilibrium in common
   integer, parameter  :: diverging = 2        ! limits one behind the other, each with a greater residual than the one before
   integer, parameter  :: settled = 2          ! limits after which the exact laws try to finish

contains

   !> The normal states that the laws along x and y see first: those of the first trial NOW where it is the best one of straight laws,
   !! otherwise those of the start, under which nothing slips. An element that has never been pressed then has the pressure of Eq. (9);
   !! with HOLDS_ALL an element that is open at the start holds in shear as if it were closed, with this pressure.
   subroutine give_first_limits(model, system, analysis, attempt, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(trial_type), intent(inout)    :: now

      attempt%n_limits = 0
      attempt%n_returns = 0
      attempt%verdict_type = verdict_type()
      attempt%n_still = 0
      attempt%n_growing = 0
      attempt%asked = attempt%load - analysis%body
      call subtract_joint_forces(system%interface, analysis%states, attempt%asked)
      if (attempt%from_best) then
         attempt%to_solve = huge(1.0_wp)
         call give_limits(model, system, analysis, attempt, now)
         return
      end if
      attempt%seen = analysis%states%normal
      where (attempt%seen%branch == branch_load .and. attempt%seen%pressure <= pressure_floor*attempt%seen%p_av) &
         attempt%seen%pressure = attempt%seen%p_av
      if (attempt%holds_all) then
         where (attempt%seen%branch == branch_open)
            attempt%seen%branch = branch_load
            attempt%seen%pressure = attempt%seen%p_av
            attempt%seen%lambda_b = attempt%seen%lambda_before
            attempt%seen%lambda = attempt%seen%lambda_before + 1.0_wp ! all of their movement counts
         end where
      end if
      attempt%sticks = .true.
      attempt%sees_own = .false.
      attempt%to_solve = 0.0_wp
      attempt%since = 0
      attempt%released = 0.0_wp
      call evaluate(model, system, attempt, analysis, now)
   end subroutine give_first_limits

   !> Take the limits of the trial NOW where it is almost in equilibrium under the present ones; after some of them, the exact laws.
   subroutine renew_limits(model, system, analysis, attempt, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(trial_type), intent(inout)    :: now

      attempt%sees_own = .false.
      if (.not. allocated(attempt%seen)) return
      if (attempt%sticks .and. .not. attempt%moves) attempt%to_solve = max(attempt%to_solve, now%size)
      if (attempt%moves .or. now%size > max(solved*attempt%to_solve, below_tol*analysis%tolerance)) return
      if (attempt%n_limits >= settled) then
         call take_exact_laws(model, system, analysis, attempt, now)
      else
         call give_limits(model, system, analysis, attempt, now)
      end if
   end subroutine renew_limits

   !> The limits of the trial NOW itself. Where the exact laws have failed to finish again, new limits may overshoot, as under wedges:
   !! the pressures are then the means of these and of the last ones.
   subroutine give_limits(model, system, analysis, attempt, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(trial_type), intent(inout)    :: now

      if (allocated(attempt%seen)) call move_alloc(attempt%seen, attempt%last)
      attempt%seen = now%states%normal
      attempt%sees_own = attempt%n_returns <= 1
      if (.not. attempt%sees_own) then
         where (attempt%seen%branch == branch_open) attempt%seen = attempt%last
         attempt%seen%pressure = 0.5_wp*(attempt%last%pressure + now%states%normal%pressure)
      end if
      if (attempt%sticks) attempt%to_solve = huge(1.0_wp) ! that of no limits
      attempt%sticks = .false.
      attempt%n_limits = attempt%n_limits + 1
      call evaluate(model, system, attempt, analysis, now)
      attempt%n_growing = merge(attempt%n_growing + 1, 0, now%size > max(attempt%to_solve, analysis%tolerance))
      if (attempt%n_growing == diverging) then ! the body goes on the way that it went since the last limits
         associate (way => now%u - attempt%u_at_limits)
            attempt%lacking = missing_force(model, system, analysis, attempt, way, &
                                            sum(now%residual*way, mask=.not. analysis%held), &
                                            sum(analysis%change*way, mask=.not. analysis%held))
         end associate
      end if
      attempt%u_at_limits = now%u
      attempt%to_solve = now%size
      attempt%since = attempt%iteration
      attempt%released = 0.0_wp
   end subroutine give_limits

   !> Let the laws see the trial NOW itself.
   subroutine take_exact_laws(model, system, analysis, attempt, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(trial_type), intent(inout)    :: now

      call move_alloc(attempt%seen, attempt%last)
      call evaluate(model, system, attempt, analysis, now)
   end subroutine take_exact_laws

   !> The step along DIRECTION from NOW to NEXT at which the energy under the given limits is (almost) least: where the work of the
   !! unbalanced forces on DIRECTION, which falls all the way, has fallen to CLOSE of the first. A full step that goes beyond is taken
   !! too where the energy rises by no more than the last step has released: a step that ends at the first kinks goes too short a way.
   !! Where the work hardly falls over the size of a joint, or after many extensions, the body moves on.
   !! Source: Grippo, Lampariello, Lucidi, SIAM J. Numer. Anal. 23 (1986) 707-716, with a memory of one step.
   subroutine minimise(model, system, analysis, attempt, now, direction, next)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(inout)  :: attempt         !! its STEP is the result
      type(trial_type), intent(in)       :: now
      real(wp), intent(in)               :: direction(:, :) !! (dimension, retained) [length]
      type(trial_type), intent(inout)    :: next
      type(trial_type), allocatable :: there
      real(wp), allocatable :: body(:, :)
      real(wp) :: farthest, first, released, work, low(2), high(2) ! steps and the works there
      integer  :: flat, i
      logical  :: is_least

      flat = 0
      allocate (body, mold=direction)
      call forces_in_bodies(system, direction, body)
      first = sum(now%residual*direction, mask=.not. analysis%held)
      low = [0.0_wp, first]
      high = [-1.0_wp, 0.0_wp]
      farthest = step_off_the_joint(model, system, direction)
      if (moves_on()) attempt%n_moving = attempt%n_moving + 1
      attempt%runs = attempt%n_moving >= merge(1, most_moving, attempt%is_limited)
      if (attempt%runs) return
      attempt%step = min(1.0_wp, farthest)
      do i = 1, most_trials
         next%u = now%u + attempt%step*direction
         next%body = now%body + attempt%step*body
         call evaluate(model, system, attempt, analysis, next)
         work = -huge(1.0_wp)**0.25_wp
         if (next%size < huge(1.0_wp)) work = sum(next%residual*direction, mask=.not. analysis%held)
         is_least = next%size <= 0.5_wp*now%size .or. abs(work) <= close*abs(first)
         if (is_least .or. (i == 1 .and. first > 0.0_wp .and. work <= enough*first)) then
            released = released_energy(work)
            if (is_least .or. released >= -attempt%released) then
               attempt%released = max(0.0_wp, released)
               return
            end if
         end if
         if (.not. first > 0.0_wp) exit
         if (work > 0.0_wp) then
            flat = merge(flat + 1, 0, work > (1.0_wp - same_work)*low(2))
            low = [attempt%step, work]
            if (high(1) < 0.0_wp .and. (flat == most_flat .or. attempt%step >= farthest)) exit
         else
            high = [attempt%step, work]
         end if
         if (high(1) < 0.0_wp) then ! beyond it
            attempt%step = longest*low(1)
            if (work < first) attempt%step = min(attempt%step, low(1)*first/(first - work))
            attempt%step = min(max(attempt%step, 2.0_wp*low(1)), farthest)
         else
            attempt%step = (low(1)*high(2) - high(1)*low(2))/(high(2) - low(2))
            associate (margin => 0.1_wp*(high(1) - low(1)))
               attempt%step = min(max(attempt%step, low(1) + margin), high(1) - margin)
            end associate
         end if
      end do
      attempt%released = 0.0_wp
      if (first > 0.0_wp) then
         attempt%runs = high(1) < 0.0_wp
         if (attempt%runs) call note_missing(low(2))
         if (attempt%runs) attempt%n_moving = attempt%n_moving + 1
         return
      end if
      next = now ! the energy does not fall along this direction
      attempt%step = 0.0_wp

   contains

      !> Whether the body moves on along DIRECTION: the work falls so little that it would last over a third of the width of a joint.
      logical function moves_on()
         real(wp) :: work(2)
         integer  :: k

         moves_on = .false.
         if (farther_off*farthest > 1.0_wp .or. .not. first > 0.0_wp) return
         do k = 1, 2
            attempt%step = merge(near_by, farther_off, k == 1)*farthest
            next%u = now%u + attempt%step*direction
            next%body = now%body + attempt%step*body
            call evaluate(model, system, attempt, analysis, next)
            if (.not. next%size < huge(1.0_wp)) return
            work(k) = sum(next%residual*direction, mask=.not. analysis%held)
         end do
         moves_on = work(1) > 0.0_wp .and. work(2) > hardly_falls*work(1) .and. & ! and by the load that the part adds
                    work(2) < sum(attempt%asked*direction, mask=.not. analysis%held)
         if (moves_on) call note_missing(work(2))
      end function moves_on

      !> The energy released from NOW to NEXT, by the trapezoidal rule on the WORK of the unbalanced forces there and between.
      real(wp) function released_energy(work) result(released)
         real(wp), intent(in) :: work
         integer, parameter :: n = 4
         integer  :: k

         if (.not. allocated(there)) allocate (there, source=now)
         released = 0.5_wp*(first + work)
         do k = 1, n - 1
            there%u = now%u + (k*attempt%step/n)*direction
            there%body = now%body + (k*attempt%step/n)*body
            call evaluate(model, system, attempt, analysis, there)
            released = released + sum(there%residual*direction, mask=.not. analysis%held)
         end do
         released = attempt%step*released/n
      end function released_energy

      !> The limits do not bear the load: the WORK of the unbalanced forces does not vanish however far the body moves. Of the
      !! directions the one along which they bear least counts. Source: upper bound theorem of limit analysis, Prager, Hodge, Theory of
      !! Perfectly Plastic Solids, Wiley 1951.
      subroutine note_missing(work)
         real(wp), intent(in) :: work
         real(wp) :: asked, bearable, whole
         integer  :: i

         asked = sum(attempt%asked*direction, mask=.not. analysis%held)
         bearable = max(0.0_wp, 1.0_wp - work/max(asked, work))
         if (attempt%n_moving > 0 .and. bearable >= attempt%bearable) return
         attempt%bearable = bearable
         whole = sum(analysis%change*direction, mask=.not. analysis%held) ! of the load of the increment
         attempt%falls = whole < most_of_work*work
         attempt%missing = missing_force(model, system, analysis, attempt, direction, work, whole)
         i = maxloc([(norm2(joint_movement(system%interface(i), direction)), i = 1, size(system%interface))], dim=1)
         attempt%leaves = model%joints%element(i)%joint
      end subroutine note_missing

   end subroutine minimise

   !> The force that is missing at the end of the increment for the movement along DIRECTION, per unit of the largest movement of a
   !! node. From the end of the part to the end of the increment the limits of sliding joints change at the rate that they have in the
   !! part; they do not fall below zero. They are left as they are where pressures do work too, or where limits diverge, as in a taper
   !! that comes out: there the limits follow the movement.
   pure real(wp) function missing_force(model, system, analysis, attempt, direction, work, whole) result(missing)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(in)     :: attempt
      real(wp), intent(in)               :: direction(:, :) !! (dimension, retained) [length]
      real(wp), intent(in)               :: work            !! of the unbalanced forces now [force*length]
      real(wp), intent(in)               :: whole           !! of the load of the whole increment [force*length]
      real(wp) :: along(2) ! work of the limits of friction before the part and at its end [force*length]
      real(wp) :: across   ! work of the pressures at its end [force*length]
      real(wp) :: way(3)   ! movement at an element [length]
      integer  :: i

      along = 0.0_wp
      across = 0.0_wp
      do i = 1, size(system%interface)
         if (attempt%sticks .or. .not. attempt%left > 0.0_wp .or. attempt%n_growing >= diverging) exit
         associate (element => model%joints%element(i), law => model%joints%list(model%joints%element(i)%joint)%law)
            way = joint_movement(system%interface(i), direction)
            along = along + norm2(merge(way(:2), 0.0_wp, law%shear%given))*element%area* &
                            [friction_limit(law, analysis%states(i)%normal%pressure), friction_limit(law, attempt%seen(i)%pressure)]
            across = across + way(3)*element%area*attempt%seen(i)%pressure
         end associate
      end do
      missing = work + attempt%left*whole
      if (abs(across) < slides*along(2)) missing = missing - max(attempt%left/attempt%part*(along(2) - along(1)), -along(2))
      missing = max(0.0_wp, missing)/max(maxval(norm2(direction, dim=1)), tiny(1.0_wp))
   end function missing_force

   !> The step along DIRECTION at which an interface element has moved by the width of the largest joint: no body finds hold beyond it.
   pure real(wp) function step_off_the_joint(model, system, direction) result(step)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: direction(:, :) !! (dimension, retained) [length]
      real(wp) :: width
      integer  :: i

      step = huge(1.0_wp)
      width = joint_width(model)
      if (.not. width > 0.0_wp) return
      do i = 1, size(system%interface)
         associate (way => norm2(joint_movement(system%interface(i), direction)))
            if (way*step > width) step = width/way
         end associate
      end do
   end function step_off_the_joint

   !> Twice the distance of the farthest interface element from the centroid of its joint [length].
   pure real(wp) function joint_width(model)
      type(model_type), intent(in) :: model

      joint_width = 2.0_wp*maxval(model%joints%list%frame%extent)
   end function joint_width

   !> Whether an iteration of the exact laws from NOW to NEXT does not converge. New limits at NOW follow then.
   logical function falls_back(model, system, analysis, attempt, now, next)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(attempt_type), intent(inout)  :: attempt
      type(trial_type), intent(inout)    :: now
      type(trial_type), intent(in)       :: next

      falls_back = attempt%with_limits .and. .not. allocated(attempt%seen)
      if (falls_back) falls_back = .not. next%size <= max(converges*now%size, analysis%tolerance)
      if (.not. falls_back) return
      attempt%n_returns = attempt%n_returns + 1
      call give_limits(model, system, analysis, attempt, now)
      attempt%n_limits = settled - 1 ! two problems more before the exact laws try again
   end function falls_back

   !> End the ATTEMPT where the body moves on under the present limits, where many iterations have not solved their problem, where
   !! limits diverge or the exact laws have failed to finish again and again, or where a joint leaves its place: its ends have
   !! moved by more than the largest joint is wide.
   subroutine judge_limits(model, system, analysis, now, attempt)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(trial_type), intent(in)       :: now
      type(attempt_type), intent(inout)  :: attempt !! its ENDS is the result
      real(wp) :: width
      integer  :: i

      attempt%ends = attempt%ends .or. attempt%runs .or. attempt%n_still > 1 .or. attempt%n_growing >= diverging .or. &
                     attempt%iteration - attempt%since > patience .or. attempt%n_returns > most_returns
      width = joint_width(model)
      if (attempt%ends .or. .not. (allocated(attempt%seen) .and. width > 0.0_wp)) return
      do i = 1, size(system%interface)
         if (norm2(joint_movement(system%interface(i), now%u) - analysis%movement(:, i)) <= width) cycle
         attempt%ends = .true.
         if (attempt%n_moving == 0) attempt%leaves = model%joints%element(i)%joint
         return
      end do
   end subroutine judge_limits

   !> Whether the trial of ATTEMPT follows the exact laws.
   pure logical function is_exact(attempt)
      type(attempt_type), intent(in) :: attempt

      is_exact = .not. allocated(attempt%seen) .or. attempt%sees_own
   end function is_exact

end module given_limits
