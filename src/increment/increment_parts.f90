!> The parts of an increment of METHOD = NEWTON, and the ways of an attempt at a part: straight laws, then given limits of friction.
!! A part that does not converge is halved. Where given limits do not bear it, the share that they bear says where its limit load is:
!! the increment goes on to a state below it, and from there to one above it by all ways. Where this fails too and gives the same
!! limit load, there is no equilibrium.
module increment_parts
   use analysis_state, only: analysis_type
   use equation_solver, only: failure_type
   use equations, only: equation_system
   use kinds, only: wp
   use model_data, only: model_type
   use newton_iterations, only: iterate
   use newton_trial, only: attempt_type
   use tolerances, only: least_share
   implicit none
   private

   public :: reach, try_part, is_given_up

   integer, parameter  :: most_halvings = 12
   integer, parameter  :: most_of_path = 10000    ! iterations in all parts of an increment: 1 + 2 + ... + 64 equal ones have fewer
   integer, parameter  :: most_of_increment = 2000 ! likewise in an increment of INCR: it is given up
   real(wp), parameter :: promising = 0.9_wp      ! of the first residual: given limits go on from a trial that leaves less
   integer, parameter  :: extrapolated = 1, straight = 2, from_best = 3, sticking = 4 ! ways of an attempt
   ! where given limits of friction do not bear a part
   integer, parameter  :: most_cuts = 5           ! one behind the other, without a part that they bear
   real(wp), parameter :: least_cut = 0.1_wp      ! of a part: a cut leaves no less, as limits may grow with the load
   real(wp), parameter :: below_limit = 0.85_wp   ! of the limit load: the next state; nearer to it almost everything slips
   real(wp), parameter :: above_limit = 1.05_wp   ! of it: the state after that, which there is if the limit load is a wrong one
   real(wp), parameter :: just_below = 0.999_wp   ! of it: the last state, so that the answer shows the limit load to three digits
   real(wp), parameter :: agreement = 0.08_wp     ! of it: two estimates that differ by less confirm each other
   real(wp), parameter :: near_limit = 0.03_wp    ! of the load borne so far: so much more is the least part
   integer, parameter  :: most_before = 45        ! iterations of an increment: after more of them there is no such last state

contains

   !> Go from equilibrium to equilibrium between ENDS of the increment by ATTEMPTs: commit an attempt that converges, divide one that
   !! does not. What was divided is repeated as a whole, from its start and the displacements that its parts have reached: the laws
   !! depend on the path, and rounding decides on the division. If the whole does not converge, the parts stand. With a GUESS
   !! nothing is divided.
   subroutine reach(model, analysis, system, attempt, ends, guess)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)    :: attempt
      real(wp), intent(in)                 :: ends(2) !! done before and after [-], 0 to 1
      real(wp), intent(in), optional       :: guess(:, :) !! (dimension, retained) displacements at the end [length]
      type(analysis_type), allocatable :: whole
      real(wp) :: done, left, part
      real(wp) :: estimate, limit   ! of the limit load: now and from the last part that was not borne [-]
      real(wp) :: missing           ! with the latter [force]
      integer  :: n_cut
      logical  :: agrees

      if (present(guess)) then
         call try_part(model, system, analysis, 1.0_wp - ends(2), attempt, guess)
         if (.not. attempt%converged) call try_part(model, system, analysis, 1.0_wp - ends(2), attempt)
         if (attempt%converged) analysis%record%n_parts = analysis%record%n_parts + 1
         return
      end if
      done = ends(1)
      part = ends(2) - ends(1)
      n_cut = 0
      limit = ends(1)
      missing = 0.0_wp
      attempt%is_limited = .false.
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
            cycle
         end if
         if (.not. allocated(whole)) allocate (whole, source=analysis) ! nothing is committed yet
         if (attempt%n_moving > 0) then
            estimate = done + attempt%bearable*part
            agrees = done > ends(1) .and. attempt%is_limited .and. &
                     abs(estimate - limit) <= agreement*(limit - ends(1))
            if (agrees .or. n_cut == most_cuts .or. part <= max(least_share, near_limit*(done - ends(1)))) then
               if (agrees) attempt%missing = missing ! of the larger part
               if (attempt%is_limited) estimate = min(estimate, limit)
               call approach_limit(model, system, analysis, attempt, just_below*estimate, done)
               exit
            end if
            limit = estimate
            missing = attempt%missing
            n_cut = n_cut + 1
            attempt%is_limited = .true.
            if (n_cut > 1) part = 0.5_wp*part
            part = max(below_limit*(min(limit, done + part) - ends(1)) + ends(1) - done, near_limit*(done - ends(1)), &
                       least_cut*part)
         else if (part > 0.5_wp**most_halvings) then
            part = 0.5_wp*part
         else
            exit
         end if
      end do
      attempt%left_over = 1.0_wp - done
      if (done < ends(2) .or. .not. allocated(whole)) return
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

   !> Go on from DONE to SHARE of the increment, just below the limit load, if straight laws lead there.
   subroutine approach_limit(model, system, analysis, attempt, share, done)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(attempt_type), intent(in)        :: attempt !! that found the limit
      real(wp), intent(in)                  :: share   !! [-]
      real(wp), intent(inout)               :: done    !! [-]
      type(attempt_type), allocatable :: last

      if (share <= done .or. analysis%record%n_iterations > most_before) return
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
   !! less than their first, and if that fails too, from a structure in which nothing slips.
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
      attempt%runs = .false.
      attempt%n_moving = 0
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

end module increment_parts
