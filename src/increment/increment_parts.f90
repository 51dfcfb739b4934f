!> The parts of an increment of METHOD = NEWTON, and the ways of an attempt at a part: straight laws, then given limits of friction.
!! A part that does not converge is halved. Where given limits do not bear it, the share that they bear says where its limit load is:
!! the increment goes on to a state below it, and from there to one above it by all ways. Where this fails too and gives the same
!! limit load, there is no equilibrium. Where two estimates do not agree in 60 iterations, or no part is small enough, what slips
!! creeps on, and if it finds no hold, the increment ends without a confirmed limit load.
module increment_parts
   use analysis_state, only: analysis_type
   use equation_solver, only: failure_type
   use equations, only: equation_system
   use kinds, only: wp
   use limit_load, only: agreement, cut, ends_above_limit, falls_too, follows_refused, go_on, is_alike, is_expected, is_near, &
                         leaves_as_expected, limit_search, missing_by_parts, near_limit
   use model_data, only: model_type
   use newton_iterations, only: iterate
   use newton_trial, only: attempt_type, creeping, every, extrapolated, from_best, holding, most_iterations, no_bounds, others, &
                           sticking, straight, verdict_type
   use normal_stiffness, only: branch_open
   use tolerances, only: least_share
   implicit none
   private

   public :: reach, try_part, is_given_up, never_falls

   integer, parameter  :: most_halvings = 12
   integer, parameter  :: most_of_path = 10000    ! iterations in all parts of an increment: 1 + 2 + ... + 64 equal ones have fewer
   integer, parameter  :: most_of_increment = 2000 ! likewise in an increment of INCR: it is given up
   real(wp), parameter :: promising = 0.9_wp      ! of the first residual: given limits go on from a trial that leaves less
   integer, parameter  :: to_fall = 7             ! extrapolated, iterations of which one must leave less than their first residual
   integer, parameter  :: most_creeping = 20      ! those against a resistance, and after them that state
   real(wp), parameter :: first_creep = 1.0_wp    ! this resistance at first, of the elastic stiffness
   integer, parameter  :: clear = 2               ! steps along which a body moves on
   real(wp), parameter :: almost = 0.7_wp         ! of the part: given limits that bear so much are near to the limit load
   ! where given limits of friction do not bear a part
   integer, parameter  :: most_cuts = 5           ! one behind the other, without a part that they bear
   real(wp), parameter :: just_below = 0.999_wp   ! of the limit load: the last state, so that the answer shows the limit load to three digits
   real(wp), parameter :: one_estimate = 0.03_wp  ! largest difference of the shares that are borne of two parts: a larger one confirms nothing
   integer, parameter  :: most_without = 60       ! iterations of an increment without equilibrium, its last state included, but for
   integer, parameter  :: least_after = 12        ! iterations that may follow the first part that given limits have not borne
   integer, parameter  :: least_to_it = 8         ! iterations that the last state needs; kept for it where nothing is borne

contains

   !> Go from equilibrium to equilibrium between ENDS of the increment by ATTEMPTs: commit an attempt that converges, divide one that
   !! does not. What was divided is repeated as a whole, from its start and the displacements that its parts have reached: the laws
   !! depend on the path, and rounding decides on the division. If the whole does not converge, the parts stand. With a GUESS
   !! nothing is divided. Once given limits have not borne a part, the increment ends after MOST_WITHOUT iterations.
   subroutine reach(model, analysis, system, attempt, ends, guess)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)    :: attempt
      real(wp), intent(in)                 :: ends(2) !! done before and after [-], 0 to 1
      real(wp), intent(in), optional       :: guess(:, :) !! (dimension, retained) displacements at the end [length]
      type(analysis_type), allocatable :: whole
      type(limit_search) :: search
      real(wp) :: done, estimate, left, part
      integer  :: at_most, begun
      logical  :: agrees, alike, confirms, is_confirmed, is_last, is_spent, moves

      attempt%expected = no_bounds
      attempt%until = huge(1)
      attempt%is_unsure = .false.
      attempt%lacking = 0.0_wp
      at_most = huge(1)
      begun = analysis%record%n_iterations
      attempt%part = ends(2) - ends(1)
      if (present(guess)) then
         call try_part(model, system, analysis, 1.0_wp - ends(2), attempt, guess)
         if (.not. attempt%converged) call try_part(model, system, analysis, 1.0_wp - ends(2), attempt)
         if (attempt%converged) analysis%record%n_parts = analysis%record%n_parts + 1
         return
      end if
      done = ends(1)
      part = ends(2) - ends(1)
      attempt%is_limited = .false.
      do while (done < ends(2))
         part = min(part, ends(2) - done)
         left = 1.0_wp - ends(2)
         if (done + part < ends(2)) left = 1.0_wp - done - part
         attempt%expected = no_bounds
         if (done > ends(1) .and. attempt%is_limited) & ! without a limit load below zero: given limits begin, nothing agrees
            attempt%expected = (ends(1) + [1.0_wp - agreement, 1.0_wp + agreement]*search%limit - done)/part
         attempt%part = part
         attempt%only = search%only
         attempt%until = at_most
         if (search%n_moving > 0 .and. .not. done > ends(1)) attempt%until = at_most - least_to_it
         call try_part(model, system, analysis, left, attempt)
         if (attempt%converged) then
            done = done + part
            analysis%record%n_parts = analysis%record%n_parts + 1
            call go_on(search, done - ends(1), attempt%is_limited, part)
            if (search%n_moving == 0) at_most = huge(1)
            cycle
         end if
         if (.not. allocated(whole)) allocate (whole, source=analysis) ! nothing is committed yet
         moves = attempt%n_moving > 0
         if (attempt%fails) search%unborne = min(search%unborne, done + part - ends(1))
         if (moves) at_most = min(at_most, max(begun + most_without - 1, analysis%record%n_iterations + least_after)) ! 1 to refine
         is_spent = analysis%record%n_iterations >= min(at_most, attempt%until)
         confirms = (moves .or. .not. is_spent) .and. &
                    done + part - ends(1) > search%refused - least_share .and. is_near(search, done - ends(1))
         agrees = is_expected(attempt)
         is_confirmed = agrees .or. confirms .or. leaves_as_expected(attempt) .or. falls_too(search, attempt)
         is_last = is_confirmed .or. is_spent .or. &
                   search%n_cut == most_cuts .or. part <= max(least_share, near_limit*(done - ends(1)))
         if (is_last .and. (moves .or. (search%n_moving > 0 .and. (attempt%leaves > 0 .or. confirms .or. is_spent)))) then
            if (.not. (agrees .or. attempt%tried_all .or. is_spent)) then ! all ways have the last word
               search%only = merge(every, others, search%only == straight)
               cycle
            end if
            estimate = done
            if (moves) estimate = done + attempt%bearable*part
            alike = moves .and. .not. done > ends(1) .and. is_alike(attempt, search%largest)
            ! where the limits grow with the load, the largest part gives the best missing force
            if (alike) then
               attempt%missing = search%largest%missing
               attempt%leaves = search%largest%leaves
            else if (search%falls .or. .not. moves) then ! those of the larger part
               attempt%missing = search%missing
               attempt%leaves = search%leaves
               if (.not. moves) attempt%missing = missing_by_parts(search, done - ends(1), 1.0_wp - ends(1))
            end if
            if (search%limit > 0.0_wp .and. .not. agrees) estimate = min(estimate, ends(1) + search%limit)
            if (.not. estimate > done + least_share) estimate = done + 0.5_wp*part ! nothing tells it
            attempt%is_unsure = (is_spent .and. .not. is_confirmed) .or. &
                                (alike .and. abs(attempt%bearable - search%largest%bearable) > one_estimate)
            attempt%until = at_most
            if (attempt%is_unsure) call creep(model, system, analysis, attempt, ends(2), done)
            if (.not. done < ends(2)) exit
            call approach_limit(model, system, analysis, attempt, just_below*estimate, done)
            exit
         else if ((moves .or. attempt%leaves > 0) .and. .not. is_last) then
            call cut(search, done - ends(1), attempt, part)
         else if (part > 0.5_wp**most_halvings) then
            part = 0.5_wp*part
            search%only = 0
            attempt%is_limited = search%n_moving > 0
         else
            if (any(attempt%loose) .and. .not. (attempt%trouble%raised .or. attempt%seats)) &
               call creep(model, system, analysis, attempt, ends(2), done)
            exit
         end if
      end do
      attempt%only = 0
      attempt%left_over = 1.0_wp - done
      if (done < ends(2) .or. .not. allocated(whole)) return
      attempt%is_limited = .false.
      attempt%expected = no_bounds
      attempt%until = huge(1)
      attempt%part = ends(2) - ends(1)
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

   !> Go on from DONE to SHARE of the increment, just below the limit load, if straight laws lead there.
   subroutine approach_limit(model, system, analysis, attempt, share, done)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(in)        :: attempt !! that found the limit
      real(wp), intent(in)                  :: share   !! [-]
      real(wp), intent(inout)               :: done    !! [-]
      type(attempt_type), allocatable :: last

      if (share <= done .or. analysis%record%n_iterations > attempt%until - least_to_it) return
      allocate (last, source=attempt)
      last%only = straight
      last%part = share - done
      call try_part(model, system, analysis, 1.0_wp - share, last)
      if (.not. last%converged) return
      analysis%record%n_parts = analysis%record%n_parts + 1
      done = share
   end subroutine approach_limit

   !> Where the limit load is not confirmed, or no part is small enough: go on from DONE to the END of a part of the increment against
   !! a resistance of friction that vanishes with the unbalanced forces. A body that slips creeps to the place where it finds hold.
   subroutine creep(model, system, analysis, attempt, end, done)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(in)                  :: end  !! [-]
      real(wp), intent(inout)               :: done !! [-]
      type(attempt_type), allocatable :: last
      integer :: begun

      begun = analysis%record%n_iterations
      allocate (last, source=attempt)
      last%only = creeping
      last%part = end - done
      last%until = begun + most_creeping
      call try_part(model, system, analysis, 1.0_wp - end, last)
      if (attempt%until < huge(1)) attempt%until = attempt%until + analysis%record%n_iterations - begun
      if (.not. last%converged) return
      analysis%record%n_parts = analysis%record%n_parts + 1
      attempt%converged = .true.
      attempt%is_unsure = .false.
      done = end
   end subroutine creep

   !> An ATTEMPT up to the point where LEFT of the increment, or of the interference, remains. Straight laws start from the
   !! extrapolated last increment if this one continues it, then from the committed state, unless the extrapolation never left less
   !! than its first residual in many iterations. If they do not lead quickly to equilibrium, the attempt is repeated with given limits
   !! of friction: from the best trial of the straight laws if this has left less than their first, and if that fails too, from a
   !! structure in which nothing slips (STICKING). If a body moves on in it, elements that are open at the start hold this body too
   !! (HOLDING), because they may close. STICKING is the first way where given limits have not borne a larger part, as it shows this
   !! in fewer iterations, and the only one if a body then moves on above the limit load, unless EVERY way is asked for, or the
   !! OTHERS are: the verdict before stands where given limits say nothing more. CREEPING is a way where it is asked for alone: the
   !! straight laws, with a resistance against the movement of what slips or is open.
   subroutine try_part(model, system, analysis, left, attempt, from)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      real(wp), intent(in)                  :: left
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(in), optional        :: from(:, :) !! (dimension, retained) initial displacements, supports moved [length]
      type(failure_type) :: none
      type(verdict_type) :: before, hung ! the verdict of STICKING
      real(wp), allocatable :: u(:, :)
      real(wp) :: first
      integer  :: k, ways(5), way
      logical  :: hangs ! the last way was STICKING, and what is open at the start could hold the body that moves on
      logical  :: stays ! the last way was an extrapolation that NEVER_FALLS

      attempt%left = left
      attempt%load = analysis%now%condensed_load - left*analysis%change
      if (attempt%seats) analysis%states%normal%gap = merge((1.0_wp - left)*model%joints%element%gap, model%joints%element%gap, &
                                                            model%joints%element%gap < 0.0_wp)
      attempt%least = huge(1.0_wp)
      first = 0.0_wp
      attempt%converged = .false.
      attempt%fails = .false.
      stays = .false.
      attempt%tried_all = attempt%only <= 0
      before = attempt%verdict_type
      attempt%verdict_type = verdict_type()
      if (.not. allocated(attempt%flips)) allocate (attempt%flips(size(analysis%states)), source=0)
      if (.not. allocated(attempt%loose)) allocate (attempt%loose(size(model%joints%list)), source=.false.)
      attempt%trouble = none
      if (is_given_up(analysis)) return
      ways = [extrapolated, straight, from_best, sticking, holding]
      if (follows_refused(attempt)) ways = [sticking, holding, extrapolated, straight, from_best]
      if (attempt%only == creeping) ways(1) = creeping
      hangs = .false.
      do k = 1, size(ways)
         way = ways(k)
         attempt%most = min(most_iterations, attempt%until - analysis%record%n_iterations)
         if (attempt%most < 1) exit
         if (way == extrapolated .and. .not. attempt%growth > 0.0_wp) cycle
         if (way == straight .and. stays) cycle
         if (way == holding) then
            if (.not. hangs) cycle
         else
            if (attempt%only > 0 .and. way /= attempt%only .or. attempt%only == others .and. way == sticking) cycle
         end if
         if (way == from_best .and. .not. attempt%least < promising*first) cycle
         if (way /= extrapolated) attempt%growth = 0.0_wp
         attempt%moves = analysis%moves
         attempt%move = merge(analysis%now%moved(:, system%retained) - left*analysis%move - analysis%u, 0.0_wp, &
                              system%number(:, system%retained) == 0)
         attempt%creep = merge(first_creep, 0.0_wp, way == creeping)
         attempt%with_limits = way >= from_best
         attempt%from_best = way == from_best
         attempt%holds_all = way == holding
         if (allocated(attempt%seen)) deallocate (attempt%seen)
         attempt%iteration = 0
         attempt%gain = 1.0_wp
         attempt%unborne = 0.0_wp
         attempt%n_short = 0
         attempt%n_slow = 0
         attempt%flips = 0
         attempt%largest_noise = 0.0_wp
         attempt%runs = .false.
         attempt%converged = .false.
         attempt%trouble = none
         if (present(from)) u = from
         if (way == from_best) u = attempt%best
         call iterate(model, system, analysis, attempt, u)
         if (attempt%converged) exit
         attempt%fails = attempt%fails .or. (attempt%with_limits .and. attempt%iteration < attempt%most)
         if (way < from_best) first = attempt%at_start
         stays = way == extrapolated .and. never_falls(attempt%sizes(:attempt%iteration))
         hangs = way == sticking .and. attempt%sticks .and. attempt%n_moving > 0 .and. &
                 any(analysis%states%normal%branch == branch_open)
         if (hangs) then
            hung = attempt%verdict_type
            cycle
         end if
         if (way == holding .and. attempt%n_moving == 0) attempt%verdict_type = hung
         if (is_expected(attempt) .or. is_clear(attempt)) exit
         if (way >= sticking .and. attempt%only == 0 .and. attempt%n_moving > 0 .and. ends_above_limit(attempt)) then
            attempt%tried_all = .false.
            exit
         end if
         if (allocated(u)) deallocate (u)
      end do
      if (attempt%only == others .and. .not. attempt%converged .and. attempt%n_moving == 0) attempt%verdict_type = before
   end subroutine try_part

   !> Whether given limits have not borne the part, and nothing better is to be expected of another way: almost all of it, or nothing.
   pure logical function is_clear(attempt)
      type(attempt_type), intent(in) :: attempt

      is_clear = attempt%n_moving >= clear .and. (attempt%bearable > almost .or. attempt%bearable <= least_share)
   end function is_clear

   !> Whether TO_FALL iterations, or more, with residuals SIZES have all left more than the first.
   pure logical function never_falls(sizes)
      real(wp), intent(in) :: sizes(0:) !! [force]

      never_falls = size(sizes) > to_fall
      if (never_falls) never_falls = minval(sizes(1:)) > sizes(0)
   end function never_falls

   !> Whether the increment has taken more iterations than one that ends.
   pure logical function is_given_up(analysis)
      type(analysis_type), intent(in) :: analysis

      is_given_up = analysis%record%n_iterations >= merge(most_of_path, most_of_increment, analysis%record%follows_path)
   end function is_given_up

end module increment_parts
