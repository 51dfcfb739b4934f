!> METHOD = NEWTON: each increment is iterated to equilibrium with the exact branch laws. The states of the joints are committed
!! only at equilibrium. The increment of a stage without INCR is divided so that its parts follow the path; they stand. An increment
!! of INCR is divided only where it does not converge. The whole increment is then repeated from the result of its parts, so that
!! the answer does not depend on the division.
module newton_method
   use analysis_state, only: all_held, analysis_type, free_norm, path_error_type
   use equations, only: equation_system, form_structure_stiffness
   use equation_solver, only: failure_type
   use increment_parts, only: is_given_up, reach
   use joint_laws, only: element_state, is_apart, stiffness_at_rest, stiffness_matrices
   use kinds, only: wp
   use load_path, only: go_back
   use model_data, only: joint_node_id, model_type
   use newton_iterations, only: idle
   use newton_trial, only: attempt_type
   use node_coupling, only: forces_on_unknowns
   use normal_stiffness, only: at_rest, branch_name, branch_open
   use path_error, only: grading, measure_path, note_start, path_start_type
   use shear_stiffness, only: shear_state
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, one_of, real_text
   use unknowns, only: unknown_name
   implicit none
   private

   public :: newton_increment, seat_joints, crosses_gaps, close_gaps

   character(*), parameter, public :: no_balance = &
      'stiffnesses differ so much, or bodies move so far, that rounding prevents equilibrium'

   interface
      !> Go from equilibrium to equilibrium along the path, see path_following.
      module subroutine follow_path(model, analysis, system, attempt)
         type(model_type), intent(in)          :: model
         type(analysis_type), intent(inout)    :: analysis
         class(equation_system), intent(inout) :: system
         type(attempt_type), intent(inout)     :: attempt !! not converged: there is no equilibrium
      end subroutine follow_path
   end interface

contains

   !> One increment of the load, from equilibrium to equilibrium.
   subroutine newton_increment(model, plan, analysis, system, failure, guess)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis !! NOW has the loads at the end of the increment
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      real(wp), intent(in), optional       :: guess(:, :) !! (dimension, retained) displacements at the end of a run nearby [length]
      type(attempt_type) :: attempt
      real(wp), allocatable :: from(:, :)
      real(wp) :: k(3, size(analysis%states))
      integer  :: before(size(analysis%states)), i, j
      logical  :: lifted, opens ! in this increment; at its end
      type(failure_type) :: hangs

      analysis%record%is_iterated = .true.
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
      if (present(guess) .and. .not. analysis%moves) from = merge(analysis%u, guess, analysis%held)
      call find_equilibrium(model, analysis, system, attempt, failure, plan%stages(analysis%stage)%follows_path, &
                            plan%measures_path, from)
      if (failure%raised) then
         call go_back(plan, attempt%left_over, analysis)
         if (analysis%record%ends_early .and. .not. allocated(plan%stages(analysis%stage)%path)) &
            failure%message = failure%message//'; the last state in equilibrium is at '// &
            real_text(anint(1.0e4_wp*analysis%fraction)*1.0e-4_wp)//' of stage '//integer_text(plan%stages(analysis%stage)%id)
         return
      end if

      ! bodies that moved supports have lifted off, by opening joints entirely, must be held without these joints: the small
      ! stiffness of open elements in find_direction hides a loose body; at the end of a stage a warning names any such body
      lifted = .false.
      opens = .false.
      do j = 1, size(model%joints%list)
         associate (was => before(model%joints%list(j)%first:model%joints%list(j)%last), &
                    now => analysis%states(model%joints%list(j)%first:model%joints%list(j)%last)%normal%branch)
            if (any(was /= branch_open) .and. all(now == branch_open)) lifted = .true.
            if (size(now) > 0 .and. all(now == branch_open)) opens = .true.
         end associate
      end do
      if (.not. analysis%moves) lifted = opens .and. .not. analysis%is_loose .and. &
                                         analysis%increment == size(plan%stages(analysis%stage)%fractions)
      if (.not. lifted) return
      k = 0.0_wp
      do i = 1, size(before)
         associate (element => model%joints%element(i), state => analysis%states(i)%normal)
            if (state%branch /= branch_open) &
               k(:, i) = stiffness_at_rest(model%joints%list(element%joint)%law, element%area, state%p_av)
         end associate
      end do
      call form_structure_stiffness(model, stiffness_matrices(k), attempt%where, system, hangs, one_solution=.true.)
      analysis%record%hangs = hangs%raised
      if (analysis%moves) failure = hangs
   end subroutine newton_increment

   !> STEP: whether no tangent leads through the increment, because open gaps leave a body loose: the structure has no stiffness, and
   !! FAILURE is raised.
   pure logical function crosses_gaps(analysis, failure)
      type(analysis_type), intent(in) :: analysis
      type(failure_type), intent(in)  :: failure

      crosses_gaps = failure%raised .and. (analysis%is_loose .or. any(is_apart(analysis%states)))
   end function crosses_gaps

   !> STEP: an increment that closes gaps is iterated to equilibrium, so that nothing is left to accumulate.
   subroutine close_gaps(model, plan, analysis, system, failure)
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(inout)    :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)     :: failure !! raised where the tangents have no stiffness: it is overcome here

      failure%raised = .false.
      call newton_increment(model, plan, analysis, system, failure)
      call free_idle_joints(model, analysis)
      analysis%record%n_iterations = 0 ! these are not re-analyses
   end subroutine close_gaps

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

      if (failure%raised .or. .not. any(model%joints%element%gap < 0.0_wp)) return
      allocate (rest, source=analysis)
      call press_apart(model, analysis, system, failure)
      if (analysis%is_loose .and. all([(is_idle(model, analysis, j), j = 1, size(model%joints%list))])) then
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
      attempt%seat_force = norm2(pack(analysis%states%normal%p_av*model%joints%element%area, model%joints%element%gap < 0.0_wp))
      attempt%where = 'interference (JGAP), before the first load'
      call find_equilibrium(model, analysis, system, attempt, failure, follows=.false., measures=.false.)
      call free_idle_joints(model, analysis)
   end subroutine press_apart

   !> Where interference has pushed a body away until nothing presses, mark its joint as never pressed and the body as loose.
   subroutine free_idle_joints(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      integer :: i, j

      analysis%is_loose = .false.
      analysis%loose_force = 0.0_wp
      do j = 1, size(model%joints%list)
         if (.not. is_idle(model, analysis, j)) cycle
         associate (elements => model%joints%element(model%joints%list(j)%first:model%joints%list(j)%last), &
                    states => analysis%states(model%joints%list(j)%first:model%joints%list(j)%last)%normal)
            do i = model%joints%list(j)%first, model%joints%list(j)%last ! their sliding under almost no pressure is arbitrary
               analysis%states(i)%shear = shear_state()
               if (allocated(analysis%states(i)%iwan)) deallocate (analysis%states(i)%iwan)
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

      associate (area => model%joints%element(model%joints%list(joint)%first:model%joints%list(joint)%last)%area, &
                 states => analysis%states(model%joints%list(joint)%first:model%joints%list(joint)%last)%normal)
         is_idle = norm2(max(states%pressure, states%p_a)*area) <= 10.0_wp*idle*norm2(states%p_av*area)
      end associate
   end function is_idle

   !> Go from equilibrium to equilibrium: along the path, or in one step, whose error of path is MEASURED.
   subroutine find_equilibrium(model, analysis, system, attempt, failure, follows, measures, guess)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)    :: attempt
      type(failure_type), intent(inout)    :: failure
      logical, intent(in)                  :: follows, measures
      real(wp), intent(in), optional       :: guess(:, :)
      type(element_state), allocatable :: way(:)
      type(path_start_type) :: start
      type(path_error_type) :: error
      real(wp), allocatable :: half(:, :), u_start(:, :)
      real(wp) :: growth, uncertainty
      integer  :: before_open

      allocate (u_start, source=analysis%u)
      before_open = count(analysis%states%normal%branch == branch_open)
      analysis%record%n_parts = 0
      if (follows) then
         call follow_path(model, analysis, system, attempt)
      else
         if (measures) then
            call note_start(analysis, start)
            allocate (way, source=analysis%states)
         end if
         if (present(guess)) then
            growth = attempt%growth
            attempt%growth = 0.0_wp
            attempt%renews = .true.
            call reach(model, analysis, system, attempt, [0.0_wp, 1.0_wp], guess)
            attempt%growth = growth
            attempt%renews = .false.
         end if
         if (.not. attempt%converged) call reach(model, analysis, system, attempt, [0.0_wp, 1.0_wp])
         if (measures .and. attempt%converged) then
            uncertainty = 0.0_wp
            call measure_path(model, system, start, [0.0_wp, 1.0_wp], grading(model, start, analysis), analysis, attempt, way, &
                              uncertainty, error, half)
            analysis%record%path_error = error
         end if
      end if
      if (attempt%converged) then
         analysis%du = analysis%u - u_start
         analysis%record%n_removed = max(0, count(analysis%states%normal%branch == branch_open) - before_open)
      else if (attempt%trouble%raised) then
         call failure%raise(attempt%trouble%message) ! a mechanism explains more than any iteration
      else
         call give_up(model, analysis, attempt, failure)
      end if
   end subroutine find_equilibrium

   !> No part of the increment is small enough: report the cause as far as known, and the element with the most changes of branch.
   subroutine give_up(model, analysis, attempt, failure)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(attempt_type), intent(in)    :: attempt
      type(failure_type), intent(inout) :: failure
      character(:), allocatable :: words
      real(wp) :: missing
      integer  :: at, worst

      words = attempt%where//': no equilibrium'
      if (is_given_up(analysis)) words = attempt%where//': given up after '// &
                                         integer_text(analysis%record%n_iterations)//' iterations'
      at = attempt%leaves
      if (at == 0) at = findloc(attempt%loose, .true., dim=1)
      if (at > 0) then
         associate (joint => model%joints%list(at), slips => attempt%loose(at))
            words = words//': joint '//integer_text(joint%id)// &
                    one_of(slips, ' slips or is open at all its nodes', ' moves without finding hold')// &
                    ', from node '//integer_text(joint_node_id(model, joint%first, 1))// &
                    ' on, and does not hold the load in the direction of its movement'
            missing = merge(attempt%missing, attempt%lacking, attempt%missing > analysis%tolerance)
            if (missing > analysis%tolerance) words = words//': '//real_text(missing)//' of force are missing'
            if (.not. slips .and. all(attempt%worst > 0)) &
               words = words//', most at '//unknown_name(model, attempt%worst(1), attempt%worst(2))
            if (attempt%is_unsure) words = words//'; the limit load is not confirmed: more increments show where it is'
         end associate
      else if (attempt%imprecise) then
         words = words//': '//no_balance
         if (all(attempt%worst > 0)) words = words//', most at '//unknown_name(model, attempt%worst(1), attempt%worst(2))
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
      if (any((model%joints%list%law%shear(1)%given .or. model%joints%list%law%shear(2)%given) .and. &
              .not. model%joints%list%law%has_friction)) words = words// &
         '; an element with shear and without friction drops its shear at once when it opens: give MU on PJOINT'
      call failure%raise(words)
   end subroutine give_up

end module newton_method
