!> A trial of METHOD = NEWTON: displacements, joint states and residual; the step, the line search and the commit.
module newton_trial
   use analysis_state, only: analysis_type, free_norm, kind_on_branch, note_turns, reach, subtract_joint_forces, tally_work
   use equations, only: equation_system, forces_in_bodies
   use interface_operator, only: joint_movement
   use joint_laws, only: element_state, follow_element, rest_when_open
   use kinds, only: wp
   use model_data, only: model_type
   implicit none
   private

   public :: start_trial, evaluate, swap, take_step, search, commit

   real(wp), parameter :: longest = 10.0_wp           ! line search: largest extension of a step at once
   real(wp), parameter :: enough = 0.8_wp             ! line search: a step with more of the unbalanced work left is searched

   !> A trial: displacements, the joint states that follow from them, and the residual. Arrays over nodes are those of the
   !! retained ones.
   type, public :: trial_type
      real(wp), allocatable :: u(:, :), body(:, :)    ! (dimension, retained) displacements, forces in the bodies
      type(element_state), allocatable :: states(:)
      real(wp), allocatable :: tangent(:, :, :)       ! (3, 3, n) in joint axes
      real(wp), allocatable :: work(:, :)             ! (3, n) since the committed state
      real(wp), allocatable :: residual(:, :)
      real(wp) :: size = 0.0_wp                       ! of the residual on free components [force]
   end type trial_type

contains

   !> The committed state as a trial.
   subroutine start_trial(system, analysis, trial)
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(trial_type), intent(out)      :: trial

      trial%u = analysis%u
      allocate (trial%body, trial%residual, mold=analysis%u)
      allocate (trial%tangent(3, 3, size(analysis%states)), trial%work(3, size(analysis%states)))
      trial%states = analysis%states
      call forces_in_bodies(system, trial%u, trial%body)
   end subroutine start_trial

   !> Exchange two trials.
   subroutine swap(a, b)
      type(trial_type), allocatable, intent(inout) :: a, b
      type(trial_type), allocatable :: c

      call move_alloc(a, c)
      call move_alloc(b, a)
      call move_alloc(c, b)
   end subroutine swap

   !> Joint states and residual of TRIAL, whose displacements and body forces are set.
   subroutine evaluate(model, system, load, analysis, trial)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: load(:, :)
      type(analysis_type), intent(in)    :: analysis
      type(trial_type), intent(inout)    :: trial
      integer :: i

      do i = 1, size(system%interface)
         associate (element => system%interface(i))
            call follow_element(model%joints(element%joint)%law, element%area, analysis%states(i), &
                                joint_movement(element, trial%u), trial%states(i), trial%tangent(:, :, i), trial%work(:, i))
         end associate
      end do
      trial%residual = load - trial%body
      call subtract_joint_forces(system%interface, trial%states, trial%residual)
      trial%size = free_norm(trial%residual, analysis%held)
   end subroutine evaluate

   !> Step from NOW along DIRECTION to NEXT.
   subroutine take_step(model, system, load, analysis, now, direction, next)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: load(:, :)
      type(analysis_type), intent(in)    :: analysis
      type(trial_type), intent(in)       :: now
      real(wp), intent(in)               :: direction(:, :)
      type(trial_type), intent(inout)    :: next

      next%u = now%u + direction
      call forces_in_bodies(system, next%u, next%body)
      call evaluate(model, system, load, analysis, next)
   end subroutine take_step

   !> Line search: the step along DIRECTION at which the work of the unbalanced forces on it (almost) vanishes. The step is
   !! extended while that work falls slowly: secants of an initial pressure far above the real one are too stiff. If the work
   !! neither changes sign nor falls, the path has a kink: the step is halved until the forces fall.
   subroutine search(model, system, load, analysis, now, direction, next, step)
      type(model_type), intent(in)      :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)              :: load(:, :)
      type(analysis_type), intent(in)   :: analysis
      type(trial_type), intent(in)      :: now
      real(wp), intent(in)              :: direction(:, :)
      type(trial_type), intent(inout)   :: next
      real(wp), intent(out)             :: step
      real(wp), allocatable :: body(:, :)
      real(wp) :: g_0, g, low, high, g_low, g_high, least
      integer  :: attempt
      logical  :: lengthens, halves

      allocate (body, mold=direction)
      call forces_in_bodies(system, direction, body)
      g_0 = sum(now%residual*direction, mask=.not. analysis%held) ! the work of the unbalanced forces on DIRECTION
      step = 1.0_wp
      call try(step, g)
      if (next%size <= 0.5_wp*now%size .or. abs(g) <= enough*abs(g_0)) return
      low = 0.0_wp
      g_low = g_0
      high = 1.0_wp
      g_high = g
      lengthens = hardly_falls(g)
      do attempt = 1, 12
         halves = .not. lengthens .and. (g_low > 0.0_wp .eqv. g_high > 0.0_wp)
         least = next%size
         if (lengthens) then
            low = high
            g_low = g_high
            step = min(longest*high, high*g_0/(g_0 - g_high))
         else if (halves) then
            step = 0.5_wp*step
         else
            step = (low*g_high - high*g_low)/(g_high - g_low)
            step = min(max(step, low + 0.05_wp*(high - low)), high - 0.05_wp*(high - low))
         end if
         call try(step, g)
         if (lengthens .and. .not. next%size < least) then
            step = low
            call try(step, g)
            return
         end if
         if (abs(g) <= 0.5_wp*abs(g_0) .or. next%size <= 0.5_wp*now%size) return
         if (halves .and. next%size <= (1.0_wp - 0.1_wp*step)*now%size) return
         lengthens = lengthens .and. hardly_falls(g)
         if (g_low*g > 0.0_wp .and. g_low*g_high <= 0.0_wp) then
            low = step
            g_low = g
         else
            high = step
            g_high = g
         end if
      end do

   contains

      !> Whether the work G is still most of the first.
      pure logical function hardly_falls(g)
         real(wp), intent(in) :: g

         hardly_falls = g*sign(1.0_wp, g_0) > 0.0_wp .and. abs(g) < 0.999_wp*abs(g_0)
      end function hardly_falls

      subroutine try(alpha, g_alpha)
         real(wp), intent(in)  :: alpha
         real(wp), intent(out) :: g_alpha

         next%u = now%u + alpha*direction
         next%body = now%body + alpha*body
         call evaluate(model, system, load, analysis, next)
         g_alpha = -sign(sqrt(huge(1.0_wp)), g_0)          ! far too long a step
         if (next%size < huge(1.0_wp)) g_alpha = sum(next%residual*direction, mask=.not. analysis%held)
      end subroutine try

   end subroutine search

   !> Commit the trial, which is in equilibrium, as the state of the structure.
   subroutine commit(model, system, trial, analysis)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(trial_type), intent(in)       :: trial
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      call reach(system, trial%u, trial%body, analysis)
      analysis%unbalanced = trial%residual
      analysis%states = trial%states
      do i = 1, size(model%interface)
         call tally_work(analysis%energy(model%interface(i)%joint), trial%work(:, i))
         associate (state => analysis%states(i))
            state%shear(1)%k_s = trial%tangent(1, 1, i)
            state%shear(2)%k_s = trial%tangent(2, 2, i)
            call rest_when_open(state, analysis%movement(:, i))
            analysis%record%kind(i) = kind_on_branch(state%normal%branch)
         end associate
      end do
      call note_turns(analysis%states, analysis%turns)
   end subroutine commit

end module newton_trial
