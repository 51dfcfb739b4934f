!> METHOD = NEWTON: each increment is iterated to equilibrium with the exact branch laws. The states of the joints are committed
!! only at equilibrium. The increment of a stage without INCR is divided so that its parts follow the path; they stand. An increment
!! of INCR is divided only where it does not converge. The whole increment is then repeated from the result of its parts, so that
!! the answer does not depend on the division.
module newton_method
   use analysis_state, only: all_held, analysis_type, free_norm
   use equations, only: equation_system, form_structure_stiffness
   use equation_solver, only: failure_type
   use joint_laws, only: element_state, is_apart, stiffness_at_rest, stiffness_matrices
   use kinds, only: wp
   use load_path, only: go_back
   use model_data, only: joint_node_id, model_type
   use newton_iterations, only: idle, iterate
   use newton_trial, only: attempt_type
   use node_coupling, only: forces_on_unknowns
   use normal_stiffness, only: at_rest, branch_name, branch_open
   use path_error, only: measure_path, note_start, path_start_type
   use shear_stiffness, only: shear_state
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: least_share
   use unknowns, only: unknown_name
   implicit none
   private

   public :: newton_increment, seat_joints, crosses_gaps, close_gaps
   public :: reach ! for path_following

   character(*), parameter, public :: no_balance = &
      'stiffnesses differ so much, or bodies move so far, that rounding prevents equilibrium'
   integer, parameter  :: most_halvings = 12
   integer, parameter  :: most_of_path = 10000    ! iterations in all parts of an increment: 1 + 2 + ... + 64 equal ones have fewer
   integer, parameter  :: most_of_increment = 2000 ! likewise in an increment of INCR: it is given up
   real(wp), parameter :: promising = 0.9_wp      ! of the first residual: given limits go on from a trial that leaves less
   integer, parameter  :: most_cuts = 5           ! to the share of a load that the limits seem to bear, without one that they bear
   integer, parameter  :: extrapolated = 1, straight = 2, from_best = 3, sticking = 4 ! ways of an attempt
   integer, parameter  :: most_before_limit = 45  ! iterations after which a limit is not approached
   real(wp), parameter :: just_below = 0.999_wp   ! of the limit: an answer that shows it to three digits
   real(wp), parameter :: below_limit = 0.85_wp  ! of this share: so near to their limit joints do not yet slip everywhere
   real(wp), parameter :: above_limit = 1.05_wp   ! of it
   real(wp), parameter :: agreement = 0.08_wp     ! of the limit: estimates of it that differ by less are one
   real(wp), parameter :: near_limit = 0.03_wp    ! of the load borne so far: where so much more is too much, the limit is found
   real(wp), parameter :: least_cut = 0.1_wp      ! of a part: a cut leaves at least this, as limits may grow with the load

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
   subroutine newton_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis !! NOW has the loads at the end of the increment
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(attempt_type) :: attempt
      real(wp) :: k(3, size(analysis%states))
      integer  :: before(size(analysis%states)), i, j
      logical  :: lifted

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
      call find_equilibrium(model, analysis, system, attempt, failure, plan%stages(analysis%stage)%follows_path, plan%measures_path)
      if (failure%raised) then
         call go_back(plan, attempt%left_over, analysis)
         if (analysis%record%ends_early .and. .not. allocated(plan%stages(analysis%stage)%path)) &
            failure%message = failure%message//'; the last state in equilibrium is at '// &
            real_text(anint(1.0e4_wp*analysis%fraction)*1.0e-4_wp)//' of stage '//integer_text(plan%stages(analysis%stage)%id)
         return
      end if
      if (.not. analysis%moves) return

      ! bodies that moved supports have lifted off, by opening joints entirely, must be held without these joints: the small
      ! stiffness of open elements in find_direction hides a loose body
      lifted = .false.
      do j = 1, size(model%joints%list)
         associate (was => before(model%joints%list(j)%first:model%joints%list(j)%last), &
                    now => analysis%states(model%joints%list(j)%first:model%joints%list(j)%last)%normal%branch)
            if (any(was /= branch_open) .and. all(now == branch_open)) lifted = .true.
         end associate
      end do
      if (.not. lifted) return
      k = 0.0_wp
      do i = 1, size(before)
         associate (element => model%joints%element(i), state => analysis%states(i)%normal)
            if (state%branch /= branch_open) &
               k(:, i) = stiffness_at_rest(model%joints%list(element%joint)%law, element%area, state%p_av)
         end associate
      end do
      call form_structure_stiffness(model, stiffness_matrices(k), attempt%where, system, failure, one_solution=.true.)
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
   subroutine find_equilibrium(model, analysis, system, attempt, failure, follows, measures)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)    :: attempt
      type(failure_type), intent(inout)    :: failure
      logical, intent(in)                  :: follows, measures
      type(element_state), allocatable :: way(:)
      type(path_start_type) :: start
      real(wp), allocatable :: half(:, :), u_start(:, :)
      integer  :: before_open

      allocate (u_start, source=analysis%u)
      before_open = count(analysis%states%normal%branch == branch_open)
      analysis%record%n_parts = 0
      if (follows) then
         call follow_path(model, analysis, system, attempt)
      else
         if (measures) call note_start(analysis, start)
         if (measures) allocate (way, source=analysis%states)
         call reach(model, analysis, system, attempt, [0.0_wp, 1.0_wp])
         if (measures .and. attempt%converged) &
            call measure_path(model, system, start, 1.0_wp, analysis, attempt, way, analysis%record%path_error, half)
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

   !> Go from equilibrium to equilibrium between ENDS of the increment by ATTEMPTs: commit an attempt that converges, divide one that
   !! does not. What was divided is repeated as a whole, from its start and the displacements that its parts have reached: the laws
   !! depend on the path, and rounding decides on the division. If the whole does not converge, the parts stand. The first attempt
   !! starts from GUESS, unless this is poor.
   subroutine reach(model, analysis, system, attempt, ends, guess)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)    :: attempt
      real(wp), intent(in)                 :: ends(2) !! done before and after [-], 0 to 1
      real(wp), intent(in), optional       :: guess(:, :) !! (dimension, retained) displacements at the end [length]
      type(analysis_type), allocatable :: whole
      real(wp) :: done, left, limit, missing, part
      integer  :: n_cut
      logical  :: agrees

      if (present(guess)) then
         call try_part(model, system, analysis, 1.0_wp - ends(2), attempt, guess)
         if (attempt%converged) then
            analysis%record%n_parts = analysis%record%n_parts + 1
            return
         end if
      end if
      done = ends(1)
      part = ends(2) - ends(1)
      n_cut = 0
      limit = -1.0_wp
      missing = 0.0_wp
      attempt%is_limited = .false.
      attempt%only = 0
      do while (done < ends(2))
         part = min(part, ends(2) - done)
         left = 1.0_wp - ends(2)
         if (done + part < ends(2)) left = 1.0_wp - done - part
         call try_part(model, system, analysis, left, attempt)
         if (attempt%converged) then
            done = done + part
            part = merge(max(above_limit*limit - done, near_limit*done), 2.0_wp*part, attempt%is_limited)
            n_cut = 0
            analysis%record%n_parts = analysis%record%n_parts + 1
         else if (attempt%runs .or. attempt%n_moving > 0) then
            agrees = done > ends(1) .and. abs(limit - done - attempt%bearable*part) <= agreement*(limit - ends(1))
            if (n_cut == most_cuts .or. agrees .or. part <= max(least_share, near_limit*(done - ends(1)))) then
               if (agrees) attempt%missing = missing
               limit = min(limit, done + attempt%bearable*part)
               call approach_limit(model, system, analysis, attempt, just_below*limit, done)
               attempt%left_over = 1.0_wp - done
               return
            end if
            limit = done + attempt%bearable*part
            missing = attempt%missing
            n_cut = n_cut + 1
            if (.not. allocated(whole)) allocate (whole, source=analysis) ! nothing is committed yet
            attempt%is_limited = .true.
            part = part*merge(0.5_wp, 1.0_wp, n_cut > 1)
            part = max(below_limit*(min(limit, done + part) - ends(1)) + ends(1) - done, near_limit*(done - ends(1)), &
                       least_cut*part)
         else if (part > 0.5_wp**most_halvings) then
            if (.not. allocated(whole)) allocate (whole, source=analysis)
            part = 0.5_wp*part
         else
            attempt%left_over = 1.0_wp - done
            return
         end if
      end do
      if (.not. allocated(whole)) return
      attempt%is_limited = .false.
      whole%record = analysis%record
      whole%tolerance = analysis%tolerance
      call try_part(model, system, whole, 1.0_wp - ends(2), attempt, analysis%u)
      if (attempt%converged) then
         analysis = whole
      else
         attempt%converged = .true.
         analysis%record = whole%record
         analysis%record%is_whole = .false.
      end if
   end subroutine reach

   !> Go on from the share DONE of the increment to the share SHARE, just below the limit, if straight laws lead there.
   subroutine approach_limit(model, system, analysis, attempt, share, done)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(in)        :: attempt !! that found the limit
      real(wp), intent(in)                  :: share   !! [-]
      real(wp), intent(inout)               :: done    !! [-]
      type(attempt_type), allocatable :: last

      if (share <= done .or. analysis%record%n_iterations > most_before_limit) return
      allocate (last, source=attempt)
      last%only = straight
      call try_part(model, system, analysis, 1.0_wp - share, last)
      if (.not. last%converged) return
      analysis%record%n_parts = analysis%record%n_parts + 1
      done = share
   end subroutine approach_limit

   !> An ATTEMPT up to the point where LEFT of the increment, or of the interference, remains. Straight laws start from the
   !! extrapolated last increment if this one continues it, otherwise from the committed state. If they do not lead quickly to
   !! equilibrium, the attempt is repeated with given limits of friction: from the best trial of the straight laws if this has left
   !! less than their first, and if that fails too, from a structure in which nothing slips, unless these limits do not bear the load.
   subroutine try_part(model, system, analysis, left, attempt, from)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      real(wp), intent(in)                  :: left
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(in), optional        :: from(:, :) !! (dimension, retained) initial displacements, supports moved [length]
      type(failure_type) :: none
      real(wp), allocatable :: u(:, :)
      real(wp) :: first
      integer  :: way

      attempt%left = left
      attempt%load = analysis%now%condensed_load - left*analysis%change
      if (attempt%seats) analysis%states%normal%gap = merge((1.0_wp - left)*model%joints%element%gap, model%joints%element%gap, &
                                                            model%joints%element%gap < 0.0_wp)
      attempt%least = huge(1.0_wp)
      first = 0.0_wp
      attempt%converged = .false.
      if (.not. allocated(attempt%flips)) allocate (attempt%flips(size(analysis%states)), source=0)
      if (is_given_up(analysis)) then
         attempt%trouble = none
         return
      end if
      do way = merge(extrapolated, straight, attempt%growth > 0.0_wp), sticking
         if (attempt%only > 0 .and. way /= attempt%only) cycle
         if (way == from_best .and. .not. attempt%least < promising*first) cycle
         if (way /= extrapolated) attempt%growth = 0.0_wp
         attempt%moves = analysis%moves
         attempt%move = merge(analysis%now%moved(:, system%retained) - left*analysis%move - analysis%u, 0.0_wp, &
                              system%number(:, system%retained) == 0)
         attempt%with_limits = way >= from_best
         attempt%from_best = way == from_best
         if (allocated(attempt%seen)) deallocate (attempt%seen)
         attempt%iteration = 0
         attempt%gain = 1.0_wp
         attempt%n_slow = 0
         attempt%flips = 0
         attempt%largest_noise = 0.0_wp
         attempt%converged = .false.
         attempt%trouble = none
         if (present(from)) u = from
         if (way == from_best) u = attempt%best
         call iterate(model, system, analysis, attempt, u)
         if (attempt%converged) exit
         if (way == straight) first = attempt%sizes(0)
         if (allocated(u)) deallocate (u)
      end do
   end subroutine try_part

   !> Whether the increment has taken more iterations than one that ends.
   pure logical function is_given_up(analysis)
      type(analysis_type), intent(in) :: analysis

      is_given_up = analysis%record%n_iterations >= merge(most_of_path, most_of_increment, analysis%record%follows_path)
   end function is_given_up

   !> No part of the increment is small enough: report the cause as far as known, and the element with the most changes of branch.
   subroutine give_up(model, analysis, attempt, failure)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(attempt_type), intent(in)    :: attempt
      type(failure_type), intent(inout) :: failure
      character(:), allocatable :: words
      integer :: worst

      words = attempt%where//': no equilibrium'
      if (is_given_up(analysis)) words = attempt%where//': given up after '// &
                                         integer_text(analysis%record%n_iterations)//' iterations'
      if (max(attempt%loose, attempt%leaves) > 0) then
         associate (joint => model%joints%list(merge(attempt%loose, attempt%leaves, attempt%loose > 0)))
            words = words//': joint '//integer_text(joint%id)// &
                    one_of(attempt%loose > 0, ' slips or is open at all its nodes', ' moves by more than its size')// &
                    ', from node '//integer_text(joint_node_id(model, joint%first, 1))// &
                    ' on, and does not hold the load in the direction of its movement'
            if (attempt%missing > 0.0_wp) words = words//': '//real_text(attempt%missing)//' of force are missing'
            if (attempt%loose == 0 .and. all(attempt%worst > 0)) &
               words = words//', most at '//unknown_name(model, attempt%worst(1), attempt%worst(2))
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
