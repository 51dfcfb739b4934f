!> METHOD = NEWTON: every increment iterated to equilibrium with the exact branch laws, consistent tangent and line search; the
!! states of the joints are committed only at equilibrium. An increment that does not converge is divided.
module newton_method
   use analysis_state, only: all_held, analysis_type, free_norm, pass_record, record_pass
   use coupled_solution, only: solve_coupled
   use equations, only: equation_system, form_structure_stiffness, solve_equations
   use failures, only: failure_type
   use joint_laws, only: element_state, element_stiffness_of
   use kinds, only: wp
   use load_path, only: support_force
   use model_data, only: joint_node_id, model_type
   use newton_trial, only: commit, evaluate, search, start_trial, swap, take_whole_step, trial_type
   use normal_stiffness, only: branch_name, branch_open
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: newton_increment

   integer, parameter  :: most_iterations = 40
   integer, parameter  :: most_halvings = 12
   real(wp), parameter :: little = 1.0e-7_wp          ! of the elastic stiffness: what the matrix has where an element has none
   real(wp), parameter :: far_below = 1.0e-3_wp       ! TOL: what is left there is not worth another iteration

   !> One attempt at a part of the increment: what it has to reach, and how it ended.
   type :: attempt_type
      character(:), allocatable :: where          ! stage and increment, for messages
      real(wp) :: left = 0.0_wp                   ! of the increment, when it is reached [-]
      real(wp), allocatable :: load(:, :)         ! (dimension, retained), then [force]
      real(wp), allocatable :: move(:, :)         ! of held components, that is still to be made, likewise [length]
      integer, allocatable  :: flips(:)           ! changes of branch, by interface element
      integer :: loose = 0                        ! a joint that is open or slips all over at its end, 0: none
      logical :: imprecise = .false.              ! rounding in the bodies is no small part of the load
      logical :: converged = .false.
      type(failure_type) :: trouble               ! a matrix that could not be factorised
   end type attempt_type

contains

   !> One increment of the load, from equilibrium to equilibrium.
   subroutine newton_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis !! applied is the load at the end of the increment
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(attempt_type)    :: attempt
      real(wp), allocatable :: u_start(:, :)
      real(wp) :: done, part
      integer  :: before_open

      allocate (u_start, source=analysis%u)
      before_open = count(analysis%states%normal%branch == branch_open)
      done = 0.0_wp
      part = 1.0_wp
      analysis%n_parts = 0
      analysis%tolerance = max(analysis%tolerance, analysis%load_tolerance*free_norm(analysis%applied, all_held(model, analysis)), &
                               tiny(1.0_wp))
      attempt%where = where_in_plan(plan, analysis%stage, analysis%increment)
      do while (done < 1.0_wp)
         part = min(part, 1.0_wp - done)
         call start_attempt(system, analysis, merge(1.0_wp - done - part, 0.0_wp, done + part < 1.0_wp), attempt)
         call iterate(model, system, analysis, attempt)
         if (attempt%converged) then
            done = done + part
            part = 2.0_wp*part
            analysis%n_parts = analysis%n_parts + 1
         else if (part > 0.5_wp**most_halvings) then
            part = 0.5_wp*part
         else
            if (attempt%trouble%raised) then
               call failure%raise(attempt%trouble%message) ! a mechanism says more than any iteration
            else
               call give_up(model, analysis, attempt, failure)
            end if
            return
         end if
      end do
      analysis%du = analysis%u - u_start
      analysis%n_removed = max(0, count(analysis%states%normal%branch == branch_open) - before_open)
   end subroutine newton_increment

   !> The next ATTEMPT goes to where so much of the increment is LEFT.
   subroutine start_attempt(system, analysis, left, attempt)
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      real(wp), intent(in)               :: left
      type(attempt_type), intent(inout)  :: attempt
      type(failure_type) :: none

      attempt%left = left
      attempt%load = analysis%felt - left*analysis%change
      attempt%move = merge(analysis%moved(:, system%retained) - left*analysis%move - analysis%u, 0.0_wp, &
                           system%number(:, system%retained) == 0)
      if (.not. allocated(attempt%flips)) allocate (attempt%flips(size(analysis%states)))
      attempt%flips = 0
      attempt%converged = .false.
      attempt%trouble = none
   end subroutine start_attempt

   !> Newton iterations of ATTEMPT from the committed state; converged, they are committed. The first iteration moves the supports,
   !! in one go and with the tangent of the committed state.
   subroutine iterate(model, system, analysis, attempt)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      type(trial_type)      :: now, next
      real(wp), allocatable :: direction(:, :)
      logical  :: flips(size(analysis%states))
      real(wp) :: load_size, noise, rounding, step, travel
      integer  :: iteration
      logical  :: moves, carried

      allocate (direction, mold=analysis%u)
      moves = analysis%moves
      travel = max(maxval(abs(analysis%moved)), maxval(abs(analysis%u)))
      call start_trial(system, analysis, now)
      call start_trial(system, analysis, next)
      call evaluate(model, system, attempt%load, analysis, now)
      load_size = analysis%tolerance/analysis%load_tolerance ! the largest so far
      do iteration = 0, most_iterations
         ! forces in the bodies are differences of large numbers: what rounding leaves of them is no residual, and where it is no
         ! small part of the load, a body has moved away and nothing is in equilibrium
         noise = 10.0_wp*epsilon(1.0_wp)*system%stiffest*maxval(abs(now%u))
         ! ... unless it only goes with supports that are moved, and nothing bears a force
         rounding = 10.0_wp*epsilon(1.0_wp)*system%stiffest*travel*sqrt(real(size(analysis%applied), wp))
         carried = load_size <= rounding .and. maxval(abs(now%u)) <= 10.0_wp*travel
         attempt%converged = now%size <= max(analysis%tolerance, 0.1_wp*noise) .and. noise <= 1.0e-5_wp*load_size
         attempt%converged = .not. moves .and. (attempt%converged .or. (carried .and. now%size <= rounding))
         if (attempt%converged .or. iteration == most_iterations) exit
         if (noise > load_size .and. .not. (carried .or. moves)) exit
         call find_direction(model, now, analysis, iteration == 0, system, attempt, direction)
         if (attempt%trouble%raised) exit
         if (moves) then
            call take_whole_step(model, system, attempt%load, analysis, now, direction, next)
            step = 1.0_wp
            moves = .false.
            attempt%move = 0.0_wp
            analysis%tolerance = max(analysis%tolerance, &
                                     analysis%load_tolerance*support_force(model, system, analysis, next%u, attempt%left))
            load_size = analysis%tolerance/analysis%load_tolerance ! what the supports take is a load here
         else
            call search(model, system, attempt%load, analysis, now, direction, next, step)
         end if
         flips = next%states%normal%branch /= now%states%normal%branch .or. (next%states%slips .neqv. now%states%slips)
         where (flips) attempt%flips = attempt%flips + 1
         call record_pass(analysis, pass_record(before=now%size, after=next%size, step=step, changes=count(flips), &
                                                part=analysis%n_parts + 1))
         if (.not. next%size < huge(1.0_wp)) exit
         call swap(now, next)
      end do
      attempt%imprecise = noise > 1.0e-5_wp*load_size .and. .not. carried
      attempt%loose = loose_joint(model, now)
      if (.not. attempt%converged) return
      if (now%size > max(far_below*analysis%tolerance, noise)) call refine(model, system, analysis, attempt, now, next)
      call commit(model, system, now, analysis)
   end subroutine iterate

   !> One iteration more from NOW, which has converged: it squares what TOL has left, so that the state does not depend on the way
   !! to it, which rounding rules. It counts where it leaves less.
   subroutine refine(model, system, analysis, attempt, now, next)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(in)        :: attempt
      type(trial_type), intent(inout)       :: now, next
      type(attempt_type)    :: last
      real(wp), allocatable :: direction(:, :)

      last = attempt
      allocate (direction, mold=analysis%u)
      call find_direction(model, now, analysis, .false., system, last, direction)
      if (last%trouble%raised) return
      call take_whole_step(model, system, attempt%load, analysis, now, direction, next)
      if (.not. next%size < now%size) return
      call record_pass(analysis, pass_record(before=now%size, after=next%size, step=1.0_wp, changes=0, part=analysis%n_parts + 1))
      call swap(now, next)
   end subroutine refine

   !> The first joint whose elements all are open or slip in TRIAL, 0 for none.
   pure integer function loose_joint(model, trial) result(joint)
      type(model_type), intent(in) :: model
      type(trial_type), intent(in) :: trial

      do joint = 1, size(model%joints)
         associate (states => trial%states(model%joints(joint)%first:model%joints(joint)%last))
            if (size(states) > 0 .and. all(states%slips .or. states%normal%branch == branch_open)) return
         end associate
      end do
      joint = 0
   end function loose_joint

   !> The Newton direction from NOW. The factorised matrix has the symmetric, positive part of the tangent, with a little where
   !! an element has no stiffness, and at the very first the secant of Eq. (9); what it lacks is brought in by solve_coupled.
   subroutine find_direction(model, now, analysis, first, system, attempt, direction)
      type(model_type), intent(in)          :: model
      type(trial_type), intent(in)          :: now
      type(analysis_type), intent(inout)    :: analysis
      logical, intent(in)                   :: first
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(inout)               :: direction(:, :)
      real(wp), allocatable :: matrix(:, :, :), rest(:, :, :)
      type(element_state) :: at_rest
      real(wp) :: elastic(3)
      integer  :: i, k
      logical  :: virgin, coupled

      allocate (matrix(3, 3, size(model%interface)), rest(3, 3, size(model%interface)), source=0.0_wp)
      coupled = .false.
      do i = 1, size(model%interface)
         associate (element => model%interface(i), law => model%joints(model%interface(i)%joint)%law)
            virgin = first .and. abs(analysis%states(i)%normal%lambda_a) <= 0.0_wp
            at_rest = element_state()
            at_rest%normal%p_av = analysis%states(i)%normal%p_av
            call element_stiffness_of(law, element%area, .false., [0.0_wp, 0.0_wp, 0.0_wp], at_rest, elastic)
            matrix(3, 3, i) = max(now%tangent(3, 3, i), little*elastic(3))
            if (virgin) matrix(3, 3, i) = elastic(3)
            matrix(:2, :2, i) = 0.5_wp*(now%tangent(:2, :2, i) + transpose(now%tangent(:2, :2, i)))
            do k = 1, 2
               matrix(k, k, i) = max(0.0_wp, matrix(k, k, i)) + little*elastic(k)
               if (virgin) matrix(k, k, i) = max(matrix(k, k, i), elastic(k))
            end do
            analysis%k(:, i) = [now%tangent(1, 1, i), now%tangent(2, 2, i), now%tangent(3, 3, i)]
            rest(:2, :, i) = now%tangent(:2, :, i) - matrix(:2, :, i)
            if (any(abs(now%tangent(:2, 3, i)) > 0.0_wp)) coupled = .true.
         end associate
      end do
      associate (failure => attempt%trouble)
         call form_structure_stiffness(model, matrix, attempt%where, system, failure, one_solution=.not. coupled)
         if (coupled .and. all(abs(attempt%move) <= 0.0_wp)) then
            call solve_coupled(model, system, rest, now%residual, 1.0e-4_wp, 25, direction, failure)
         else
            call solve_equations(model, system, now%residual, direction, failure, moved=attempt%move)
         end if
      end associate
   end subroutine find_direction

   !> No part of the increment is small enough: say why, as far as it can be told, and which element changed its branch most
   !! often.
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
         words = words//': stiffnesses differ so much, or bodies moved so far, that rounding leaves no balance of forces'
      else if (analysis%n_passes > 0) then
         words = words//', '//real_text(analysis%passes(analysis%n_passes)%after)//' of force are left unbalanced'
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
