!> METHOD = NEWTON: every increment iterated to equilibrium with the exact branch laws, consistent tangent and line search; the
!! states of the joints are committed only at equilibrium. An increment that does not converge is divided.
module newton_method
   use analysis_state, only: analysis_type, free_norm, pass_record, record_pass
   use coupled_solution, only: solve_coupled, solve_moved
   use equations, only: check_solution, equation_system, form_structure_stiffness, solve_equations
   use failures, only: failure_type
   use joint_laws, only: element_state, element_stiffness_of
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: commit, evaluate, search, start_trial, support_force, swap, take_whole_step, trial_type
   use normal_stiffness, only: branch_name, branch_open
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: newton_increment

   integer, parameter  :: most_iterations = 40
   integer, parameter  :: most_halvings = 12
   real(wp), parameter :: little = 1.0e-7_wp          ! of the elastic stiffness: what the matrix has where an element has none

contains

   !> One increment of the load, from equilibrium to equilibrium.
   subroutine newton_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis !! applied is the load at the end of the increment
      type(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      real(wp), allocatable :: load(:, :), u_start(:, :), moved(:, :)
      integer, allocatable  :: flips(:)
      real(wp) :: done, part, left
      logical  :: converged, imprecise
      type(failure_type) :: trouble
      integer  :: before_open, i, loose

      allocate (load, source=analysis%felt)
      allocate (u_start, source=analysis%u)
      allocate (moved, source=analysis%moved)
      before_open = count(analysis%states%normal%branch == branch_open)
      allocate (flips(size(model%interface)), source=0)
      done = 0.0_wp
      part = 1.0_wp
      analysis%n_parts = 0
      analysis%tolerance = max(analysis%tolerance, analysis%load_tolerance*free_norm(model, analysis%applied, &
                                                                         [(i, i=1, model%n_nodes)]), tiny(1.0_wp))
      do while (done < 1.0_wp)
         part = min(part, 1.0_wp - done)
         left = merge(1.0_wp - done - part, 0.0_wp, done + part < 1.0_wp)
         associate (r => analysis%retained)
            load(:, r) = analysis%felt(:, r) - left*analysis%change(:, r)
            moved(:, r) = analysis%moved(:, r) - left*analysis%move(:, r)
         end associate
         call iterate(model, load, moved, left, where_in_plan(plan, analysis%stage, analysis%increment), analysis, system, &
                      flips, loose, imprecise, trouble, converged)
         if (converged) then
            done = done + part
            part = 2.0_wp*part
            analysis%n_parts = analysis%n_parts + 1
         else if (part > 0.5_wp**most_halvings) then
            part = 0.5_wp*part
         else
            if (trouble%raised) then
               call failure%raise(trouble%message) ! a mechanism says more than any iteration
               return
            end if
            call give_up(model, plan, analysis, flips, loose, imprecise, failure)
            return
         end if
      end do
      associate (r => analysis%retained)
         analysis%du(:, r) = analysis%u(:, r) - u_start(:, r)
      end associate
      analysis%n_removed = max(0, count(analysis%states%normal%branch == branch_open) - before_open)
   end subroutine newton_increment


   !> Newton iterations under the nodal forces LOAD with held components MOVED, from the committed state; converged, they are
   !! committed. The first iteration moves the supports, in one go and with the tangent of the committed state.
   subroutine iterate(model, load, moved, left, place, analysis, system, flips, loose, imprecise, trouble, converged)
      type(model_type), intent(in)         :: model
      real(wp), intent(in)                 :: load(:, :), moved(:, :)
      real(wp), intent(in)                 :: left  !! of the increment, when LOAD and MOVED are reached [-]
      character(*), intent(in)             :: place !! stage and increment, for messages
      type(analysis_type), intent(inout)   :: analysis
      type(equation_system), intent(inout) :: system
      integer, intent(inout)               :: flips(:)  !! changes of branch in these iterations
      integer, intent(out)                 :: loose     !! a joint that is open or slips all over at their end, 0: none
      type(failure_type), intent(out)      :: trouble   !! a matrix that could not be factorised
      logical, intent(out)                 :: imprecise !! rounding in the bodies is no small part of the load
      logical, intent(out)                 :: converged
      type(trial_type)      :: now, next
      real(wp), allocatable :: direction(:, :), move(:, :)
      real(wp) :: load_size, noise, rounding, step, travel
      integer  :: iteration, changes
      logical  :: moves, carried

      allocate (direction, mold=load)
      allocate (move, source=merge(moved - analysis%u, 0.0_wp, system%number == 0))
      moves = any(abs(move) > 0.0_wp)
      travel = max(maxval(abs(moved)), maxval(abs(analysis%u(:, analysis%retained))))
      converged = .false.
      flips = 0
      call start_trial(model, system, analysis, now)
      call start_trial(model, system, analysis, next)
      call evaluate(model, load, analysis, now)
      load_size = analysis%tolerance/analysis%load_tolerance ! the largest so far
      do iteration = 0, most_iterations
         ! forces in the bodies are differences of large numbers: what rounding leaves of them is no residual, and where it is no
         ! small part of the load, a body has moved away and nothing is in equilibrium
         noise = 10.0_wp*epsilon(1.0_wp)*system%stiffest*maxval(abs(now%u(:, analysis%retained)))
         ! ... unless it only goes with supports that are moved, and nothing bears a force
         rounding = 10.0_wp*epsilon(1.0_wp)*system%stiffest*travel*sqrt(real(size(load), wp))
         carried = load_size <= rounding .and. maxval(abs(now%u(:, analysis%retained))) <= 10.0_wp*travel
         converged = now%size <= max(analysis%tolerance, 0.1_wp*noise) .and. noise <= 1.0e-5_wp*load_size
         converged = .not. moves .and. (converged .or. (carried .and. now%size <= rounding))
         if (converged .or. iteration == most_iterations .or. (noise > load_size .and. .not. (carried .or. moves))) exit
         call find_direction(model, now, analysis, iteration == 0, move, place, system, direction, trouble)
         if (trouble%raised) exit
         if (moves) then
            call take_whole_step(model, system, load, analysis, now, direction, next)
            step = 1.0_wp
            moves = .false.
            move = 0.0_wp
            analysis%tolerance = max(analysis%tolerance, &
                                     analysis%load_tolerance*support_force(model, system, analysis, next%u, left))
            load_size = analysis%tolerance/analysis%load_tolerance ! what the supports take is a load here
         else
            call search(model, system, load, analysis, now, direction, next, step)
         end if
         changes = count(next%states%normal%branch /= now%states%normal%branch .or. (next%states%slips .neqv. now%states%slips))
         where (next%states%normal%branch /= now%states%normal%branch .or. (next%states%slips .neqv. now%states%slips)) &
            flips = flips + 1
         call record_pass(analysis, pass_record(before=now%size, after=next%size, step=step, changes=changes, &
                                           part=analysis%n_parts + 1))
         if (.not. next%size < huge(1.0_wp)) exit
         call swap(now, next)
      end do
      imprecise = noise > 1.0e-5_wp*load_size .and. .not. carried
      loose = loose_joint(model, now)
      if (converged) call commit(model, now, analysis)
   end subroutine iterate


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
   subroutine find_direction(model, now, analysis, first, move, place, system, direction, failure)
      type(model_type), intent(in)         :: model
      type(trial_type), intent(in)         :: now
      type(analysis_type), intent(inout)   :: analysis
      logical, intent(in)                  :: first
      real(wp), intent(in)                 :: move(:, :) !! of held components, that is still to be made
      character(*), intent(in)             :: place !! stage and increment, for messages
      type(equation_system), intent(inout) :: system
      real(wp), intent(inout)              :: direction(:, :)
      type(failure_type), intent(inout)    :: failure
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
      call form_structure_stiffness(model, matrix, place, system, failure, many_solutions=coupled)
      if (failure%raised) return
      if (any(abs(move(:, analysis%retained)) > 0.0_wp)) then
         call solve_moved(model, system, matrix, now%residual, move, direction)
      else if (coupled) then
         call solve_coupled(model, system, rest, now%residual, 1.0e-4_wp, 25, direction)
      else
         call solve_equations(system, now%residual, direction)
      end if
      call check_solution(model, system, failure)
   end subroutine find_direction


   !> No part of the increment is small enough: say why, as far as it can be told, and which element changed its branch most
   !! often.
   subroutine give_up(model, plan, analysis, flips, loose, imprecise, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(in)    :: analysis
      integer, intent(in)                :: flips(:), loose
      logical, intent(in)                :: imprecise
      type(failure_type), intent(inout)  :: failure
      character(:), allocatable :: words
      integer :: worst

      words = where_in_plan(plan, analysis%stage, analysis%increment)//': no equilibrium'
      if (loose > 0) then
         words = words//': joint '//integer_text(model%joints(loose)%id)//' slips or is open at all its nodes, from node '// &
                 integer_text(model%node_id(model%interface(model%joints(loose)%first)%nodes(1)))// &
                 ' on, and does not hold the load in the direction of its movement'
      else if (imprecise) then
         words = words//': stiffnesses differ so much, or bodies moved so far, that rounding leaves no balance of forces'
      else if (analysis%n_passes > 0) then
         words = words//', '//real_text(analysis%passes(analysis%n_passes)%after)//' of force are left unbalanced'
      end if
      if (size(flips) > 0) then
         worst = maxloc(flips, dim=1)
         if (flips(worst) > 1) words = words//'; node '//integer_text(model%node_id(model%interface(worst)%nodes(1)))// &
            ' changes its branch back and forth ('//integer_text(flips(worst))//' times, committed: '// &
            branch_name(analysis%states(worst)%normal%branch)//')'
      end if
      if (any((model%joints%law%shear(1)%given .or. model%joints%law%shear(2)%given) .and. &
              .not. model%joints%law%has_friction)) words = words// &
         '; an element with shear and without friction drops its shear at once when it opens: give MU on PJOINT'
      call failure%raise(words)
   end subroutine give_up

end module newton_method
