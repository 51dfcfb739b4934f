!> An attempt of METHOD = NEWTON at an increment, and its trials: displacements, joint states and residual; the step, the line
!! search and the commit.
module newton_trial
   use analysis_state, only: analysis_type, find_movements, free_norm, kind_on_branch, note_turns, subtract_joint_forces
   use equations, only: equation_system, forces_in_bodies
   use equation_solver, only: failure_type
   use interface_operator, only: joint_movement
   use joint_laws, only: element_state, follow_element, joint_law, rest_when_open
   use joint_work, only: work_along
   use kinds, only: wp
   use model_data, only: model_type
   use normal_stiffness, only: branch_load, branch_open, branch_reload, branch_unload, normal_state
   use shear_stiffness, only: shear, shear_state
   use tolerances, only: rounding_of_forces, tight_direction
   implicit none
   private

   public :: evaluate, evaluate_at, follow_law, given_law, swap, search, commit

   real(wp), parameter :: longest = 10.0_wp           ! line search: largest extension of a step at once
   real(wp), parameter :: enough = 0.8_wp             ! line search: a step with more of the unbalanced work left is searched
   integer, parameter, public :: most_iterations = 60
   real(wp), parameter, public :: no_bounds(2) = [1.0_wp, 0.0_wp] !! of EXPECTED: the first is the larger one
   integer, parameter, public :: extrapolated = 1, straight = 2, creeping = 3, from_best = 4, sticking = 5, holding = 6 !! ways of an attempt
   integer, parameter, public :: every = -1       !! of these ways, also after one by which a body moves on
   integer, parameter, public :: others = -2      !! all ways but STICKING, by which the part has just not been borne

   !> What given limits say of a part that they do not bear.
   type, public :: verdict_type
      integer  :: n_moving = 0                    !! steps along which a body moved on
      integer  :: leaves = 0                      !! the joint that moved most along them, or left its place, 0: none
      logical  :: falls = .false.                 !! the body moves by itself: most of the work is not that of the load
      real(wp) :: bearable = 1.0_wp               !! share of the load of the part that they bear [-]
      real(wp) :: missing = 0.0_wp                !! force that they lack at the end of the increment [force]
   end type verdict_type

   !> One attempt at a part of the increment.
   type, public, extends(verdict_type) :: attempt_type
      ! the goal
      character(:), allocatable :: where          !! stage and increment, for messages
      real(wp) :: part = 1.0_wp                   !! fraction of the increment from the committed state to the goal [-]
      real(wp) :: left = 0.0_wp                   !! fraction of the increment left at the goal [-]
      real(wp), allocatable :: load(:, :)         !! (dimension, retained) at the goal [force]
      real(wp), allocatable :: move(:, :)         !! likewise, movement of held components still to do [length]
      logical  :: moves = .false.                 !! the next step makes this movement
      real(wp) :: growth = 0.0_wp                 !! ratio to the last increment of the stage, 0: not its continuation
      real(wp) :: creep = 0.0_wp                  !! part of its elastic stiffness by which friction resists a step, 0: it does not [-]
      logical  :: seats = .false.                 !! interference at rest without load
      real(wp) :: seat_force = 0.0_wp             !! then the reference force: p_av on the pressed elements [force]
      logical  :: with_limits = .false.           !! friction by a sequence of given limits
      logical  :: renews = .false.                !! an iteration at least: other runs go on with its factor
      logical  :: is_limited = .false.            !! given limits have not borne a part of the increment
      real(wp) :: expected(2) = no_bounds         !! bounds of BEARABLE that agree with such a part [-]
      integer  :: most = most_iterations          !! most iterations of the present way
      integer  :: until = huge(1)                 !! count of iterations of the increment at which attempts end
      integer  :: only = 0                        !! the ways that are tried, see increment_parts
      logical  :: tried_all = .false.             !! no way is left that could bear the part
      logical  :: from_best = .false.             !! the first ones are those of BEST; otherwise nothing slips at first
      ! the course of the iterations
      integer  :: iteration = 0
      real(wp) :: sizes(0:most_iterations) = 0.0_wp !! residuals [force]
      real(wp) :: at_start = 0.0_wp               !! residual at the start of the way, before an extrapolation [force]
      real(wp) :: step = 1.0_wp                   !! length of the last step, in directions [-]
      real(wp) :: gain = 1.0_wp                   !! part of the present residual that the next step should leave [-]
      real(wp) :: tolerance = tight_direction     !! residual that the next direction may leave, relative [-]
      real(wp) :: unborne = 0.0_wp                !! part of the residual that the last direction has left [-]
      logical  :: coupled = .false.               !! the last direction was that of a coupled system
      integer  :: n_short = 0                     !! the last steps that were shortened
      integer  :: n_slow = 0                      !! iterations that did not halve the residual
      integer, allocatable :: flips(:)            !! changes of branch of each interface element
      real(wp), allocatable :: best(:, :)         !! displacements of the least residual along straight laws, (dimension, retained) [length]
      real(wp) :: least = 0.0_wp                  !! this residual [force]
      real(wp) :: load_size = 0.0_wp              !! reference force of the residuals [force]
      real(wp) :: noise = 0.0_wp                  !! present rounding error of the forces in the bodies [force]
      real(wp) :: largest_noise = 0.0_wp          !! its largest value since these forces were computed [force]
      real(wp) :: displacement_scale = 0.0_wp     !! of the supports or anything, at the beginning [length]
      logical  :: carried = .false.               !! bodies only move with supports, and no force acts
      ! ... with given limits
      type(normal_state), allocatable :: seen(:)  !! that the shear laws and friction see; unallocated: those of the trial
      type(normal_state), allocatable :: last(:)  !! SEEN before the exact laws tried to finish
      integer  :: n_returns = 0                   !! how often they did not
      logical  :: sees_own = .false.              !! SEEN is that of the trial
      logical  :: sticks = .false.                !! nothing slips
      logical  :: holds_all = .false.             !! nothing slips, and elements that are open at the start hold
      real(wp) :: to_solve = 0.0_wp               !! residual of the first trial under the present limits [force]
      integer  :: n_limits = 0                    !! limits given so far
      integer  :: n_growing = 0                   !! the last ones that were farther off than those before
      real(wp), allocatable :: u_at_limits(:, :)  !! displacements at which the present ones were given, (dimension, retained) [length]
      real(wp) :: lacking = 0.0_wp                !! force that is missing at the end of the increment where limits diverge [force]
      integer  :: since = 0                       !! iteration at which the present ones were given
      real(wp) :: released = 0.0_wp               !! energy that the last step under them has released [force*length]
      real(wp), allocatable :: asked(:, :)        !! the load that the part adds, (dimension, retained) [force]
      integer  :: n_still = 0                     !! the last steps that released no energy
      logical  :: runs = .false.                  !! the body moves without end: the limits do not bear the load
      ! the outcome
      logical  :: converged = .false.
      logical  :: ends = .false.                  !! no further iteration
      logical  :: fails = .false.                 !! given limits, not cut short, have led to no equilibrium
      type(failure_type) :: trouble               !! a matrix that could not be factorised
      logical  :: is_unsure = .false.             !! no second estimate has confirmed the limit load
      real(wp) :: left_over = 1.0_wp              !! fraction of the increment left where no part of it was possible [-]
      logical, allocatable :: loose(:)            !! joints that are open or slip entirely at the end
      integer  :: worst(2) = 0                    !! node and direction of the largest residual at the end
      logical  :: imprecise = .false.             !! rounding in the bodies is not small compared with the load
   end type attempt_type

   !> A trial: displacements, the joint states that follow from them, and the residual. Arrays over nodes are those of the
   !! retained ones.
   type, public :: trial_type
      real(wp), allocatable :: u(:, :), body(:, :)    ! (dimension, retained) displacements, forces in the bodies
      type(element_state), allocatable :: states(:)
      real(wp), allocatable :: tangent(:, :, :)       ! (3, 3, n) in joint axes
      real(wp), allocatable :: residual(:, :)
      real(wp) :: size = 0.0_wp                       ! of the residual on free components [force]
   end type trial_type

contains

   !> Exchange two trials.
   subroutine swap(a, b)
      type(trial_type), allocatable, intent(inout) :: a, b
      type(trial_type), allocatable :: c

      call move_alloc(a, c)
      call move_alloc(b, a)
      call move_alloc(c, b)
   end subroutine swap

   !> Joint states and residual of TRIAL, whose displacements and body forces are set.
   subroutine evaluate(model, system, attempt, analysis, trial)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(attempt_type), intent(in)     :: attempt
      type(analysis_type), intent(in)    :: analysis
      type(trial_type), intent(inout)    :: trial
      integer :: i

      do i = 1, size(system%interface)
         associate (element => system%interface(i), state => trial%states(i), tangent => trial%tangent(:, :, i))
            call follow_law(model%joints%list(element%joint)%law, element%area, attempt, i, analysis%states(i), &
                            joint_movement(element, trial%u), state, tangent)
         end associate
      end do
      trial%residual = attempt%load - trial%body
      call subtract_joint_forces(system%interface, trial%states, trial%residual)
      trial%size = free_norm(trial%residual, analysis%held)
   end subroutine evaluate

   !> The STATE of interface element I at MOVEMENT, from BEFORE, and its TANGENT: under the exact LAW, or under what ATTEMPT gives.
   pure subroutine follow_law(law, area, attempt, i, before, movement, state, tangent)
      type(joint_law), intent(in)      :: law
      real(wp), intent(in)             :: area
      type(attempt_type), intent(in)   :: attempt
      integer, intent(in)              :: i
      type(element_state), intent(in)  :: before
      real(wp), intent(in)             :: movement(3)   !! [length]
      type(element_state), intent(out) :: state
      real(wp), intent(out)            :: tangent(3, 3) !! [force/length]

      if (.not. allocated(attempt%seen)) then
         call follow_element(law, area, before, movement, state, tangent)
      else
         call follow_element(given_law(law, attempt), area, before, movement, state, tangent, attempt%seen(i))
      end if
   end subroutine follow_law

   !> LAW as ATTEMPT gives it: without a limit of friction where nothing slips.
   pure type(joint_law) function given_law(law, attempt)
      type(joint_law), intent(in)    :: law
      type(attempt_type), intent(in) :: attempt

      given_law = law
      given_law%has_friction = law%has_friction .and. .not. attempt%sticks
   end function given_law

   !> Put TRIAL at the displacements U.
   subroutine evaluate_at(model, system, attempt, analysis, u, trial)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(attempt_type), intent(in)     :: attempt
      type(analysis_type), intent(in)    :: analysis
      real(wp), intent(in)               :: u(:, :)
      type(trial_type), intent(inout)    :: trial

      if (.not. allocated(trial%states)) then
         allocate (trial%body, trial%residual, mold=u)
         allocate (trial%tangent(3, 3, size(analysis%states)))
         trial%states = analysis%states
      end if
      trial%u = u
      call forces_in_bodies(system, trial%u, trial%body)
      call evaluate(model, system, attempt, analysis, trial)
   end subroutine evaluate_at

   !> Line search: the step along DIRECTION at which the work of the unbalanced forces on it (almost) vanishes. The step is
   !! extended while that work falls slowly: secants of an initial pressure far above the real one are too stiff. If the work
   !! neither changes sign nor falls, the path has a kink: the step is halved until the forces fall.
   subroutine search(model, system, attempt, analysis, now, direction, next)
      type(model_type), intent(in)      :: model
      class(equation_system), intent(in) :: system
      type(attempt_type), intent(inout) :: attempt     !! its STEP is the result
      type(analysis_type), intent(in)   :: analysis
      type(trial_type), intent(in)      :: now
      real(wp), intent(in)              :: direction(:, :)
      type(trial_type), intent(inout)   :: next
      real(wp), allocatable :: body(:, :)
      real(wp) :: g_0, g, bracket(2), g_there(2), least
      integer  :: i, side
      logical  :: lengthens, halves

      allocate (body, mold=direction)
      call forces_in_bodies(system, direction, body)
      g_0 = sum(now%residual*direction, mask=.not. analysis%held) ! the work of the unbalanced forces on DIRECTION
      attempt%step = 1.0_wp
      call try(attempt%step, g)
      if (next%size <= 0.5_wp*now%size .or. abs(g) <= enough*abs(g_0)) return
      bracket = [0.0_wp, 1.0_wp]
      g_there = [g_0, g]
      lengthens = hardly_falls(g)
      do i = 1, 12
         halves = .not. lengthens .and. (g_there(1) > 0.0_wp .eqv. g_there(2) > 0.0_wp)
         least = next%size
         if (lengthens) then
            bracket(1) = bracket(2)
            g_there(1) = g_there(2)
            attempt%step = min(longest*bracket(2), bracket(2)*g_0/(g_0 - g_there(2)))
         else if (halves) then
            attempt%step = 0.5_wp*attempt%step
         else
            attempt%step = (bracket(1)*g_there(2) - bracket(2)*g_there(1))/(g_there(2) - g_there(1))
            associate (margin => 0.05_wp*(bracket(2) - bracket(1)))
               attempt%step = min(max(attempt%step, bracket(1) + margin), bracket(2) - margin)
            end associate
         end if
         call try(attempt%step, g)
         if (lengthens .and. .not. next%size < least) then
            attempt%step = bracket(1)
            call try(attempt%step, g)
            return
         end if
         if (abs(g) <= 0.5_wp*abs(g_0) .or. next%size <= 0.5_wp*now%size) return
         if (halves .and. next%size <= (1.0_wp - 0.1_wp*attempt%step)*now%size) return
         lengthens = lengthens .and. hardly_falls(g)
         side = merge(1, 2, g_there(1)*g > 0.0_wp .and. g_there(1)*g_there(2) <= 0.0_wp)
         bracket(side) = attempt%step
         g_there(side) = g
      end do

   contains

      !> Whether the work G is still most of the first.
      pure logical function hardly_falls(g)
         real(wp), intent(in) :: g

         hardly_falls = g*sign(1.0_wp, g_0) > 0.0_wp .and. abs(g) < 0.999_wp*abs(g_0)
      end function hardly_falls

      !> The step ALPHA to NEXT, and the work G_ALPHA there.
      subroutine try(alpha, g_alpha)
         real(wp), intent(in)  :: alpha
         real(wp), intent(out) :: g_alpha

         next%u = now%u + alpha*direction
         next%body = now%body + alpha*body
         call evaluate(model, system, attempt, analysis, next)
         g_alpha = -sign(sqrt(huge(1.0_wp)), g_0)          ! far too long a step
         if (next%size < huge(1.0_wp)) g_alpha = sum(next%residual*direction, mask=.not. analysis%held)
      end subroutine try

   end subroutine search

   !> Commit the trial, which is in equilibrium, as the state of the structure. An element does not leave its loading curve by the
   !! rounding of the displacements, which may exceed that of its deflection by far.
   subroutine commit(model, system, trial, analysis)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(trial_type), intent(in)       :: trial
      type(analysis_type), intent(inout) :: analysis
      type(shear_state) :: here(2)
      integer :: i, was

      analysis%u = trial%u
      analysis%body = trial%body
      call find_movements(system, analysis)
      analysis%unbalanced = trial%residual
      do i = 1, size(model%joints%element)
         associate (state => analysis%states(i), element => model%joints%element(i), movement => analysis%movement(:, i))
            call analysis%energy(element%joint)%add(work_along(model%joints%list(element%joint)%law, element%area, state, movement))
            was = state%normal%branch
            state = trial%states(i)
            if (was == branch_load .and. any(state%normal%branch == [branch_unload, branch_reload]) .and. &
                state%normal%lambda_a - state%normal%lambda <= rounding_of_forces &
                *maxval(abs(analysis%u(:, system%interface(i)%node)))) state%normal%branch = branch_load
            state%shear%k_s = [trial%tangent(1, 1, i), trial%tangent(2, 2, i)]
            if (.not. (state%slips .or. state%normal%branch == branch_open .or. allocated(state%iwan))) then
               here = state%shear ! under the pressure at the end, and not along the increment
               call shear(model%joints%list(element%joint)%law%shear, element%area, state%normal%pressure, here, state%shear%k_s)
            end if
            call rest_when_open(state, movement)
            analysis%record%kind(i) = kind_on_branch(state%normal%branch)
         end associate
      end do
      call note_turns(analysis)
   end subroutine commit

end module newton_trial
