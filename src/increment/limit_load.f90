!> The search of the limit load of an increment of METHOD = NEWTON: what its parts have told of it, and which part follows one that
!! was borne, or was not. A part that given limits of friction do not bear is cut to a state below the limit load that they tell; from
!! there a part above it confirms it.
module limit_load
   use kinds, only: wp
   use newton_trial, only: attempt_type, sticking, straight, verdict_type
   use tolerances, only: least_share
   implicit none
   private

   public :: go_on, cut, is_near, missing_by_parts, follows_refused, ends_above_limit, is_expected, is_alike, leaves_as_expected, &
             falls_too

   real(wp), parameter :: least_cut = 0.1_wp      ! of a part: a cut leaves no less, as limits may grow with the load
   real(wp), parameter :: below_limit = 0.7_wp    ! of the limit load: the next state; nearer to it almost everything slips
   real(wp), parameter :: above_limit = 1.05_wp   ! of it: the state after that, which there is if the limit load is a wrong one
   real(wp), parameter, public :: agreement = 0.1_wp   !! of it: two estimates that differ by less confirm each other
   real(wp), parameter :: alike = 0.25_wp         ! of the share that is borne of a larger part: limits grow as the load does
   real(wp), parameter, public :: near_limit = 0.03_wp !! of the load borne so far: so much more is the least part

   !> What the attempts so far tell of the limit load of an increment, with the verdict on the last part that was not borne.
   type, extends(verdict_type), public :: limit_search
      real(wp) :: limit = 0.0_wp              !! estimate of the last part that was not borne, as a share of the load; 0: none [-]
      real(wp) :: refused = huge(1.0_wp)      !! the least share that given limits have not borne [-]
      real(wp) :: unborne = huge(1.0_wp)      !! the least share for which an attempt under given limits FAILS [-]
      type(verdict_type) :: largest           !! verdict on the first part, the largest one, that given limits have not borne
      integer  :: n_cut = 0                   !! parts not borne since one was
      integer  :: only = 0                    !! way of the next attempt; 0: all, as far as needed; EVERY or OTHERS
   end type limit_search

contains

   !> The PART after one that was borne: twice as large, or towards the limit load, which is confirmed from a state near it.
   pure subroutine go_on(search, done, is_limited, part)
      type(limit_search), intent(inout) :: search
      real(wp), intent(in)              :: done       !! since the start of the increment [-]
      logical, intent(inout)            :: is_limited !! given limits have not borne a part; not if the load now is beyond it
      real(wp), intent(inout)           :: part       !! [-]

      search%only = 0
      search%n_cut = 0
      is_limited = is_limited .and. done < search%refused - least_share
      if (.not. is_limited) then
         search = limit_search()
         part = 2.0_wp*part
      else if (is_near(search, done)) then
         part = search%refused - done
      else if (done < above_limit*search%limit) then
         part = min(max(above_limit*search%limit - done, near_limit*done), search%refused - done)
      else
         part = 0.5_wp*(search%refused - done)
         search%only = sticking
      end if
   end subroutine go_on

   !> Whether the share that was not borne is so near that a part up to it confirms this.
   pure logical function is_near(search, done)
      type(limit_search), intent(in) :: search
      real(wp), intent(in)           :: done !! since the start of the increment [-]

      is_near = search%refused - done <= agreement*done
   end function is_near

   !> The PART instead of one that given limits have not borne: to a state below the limit load, which is there by straight laws, or
   !! where nothing tells the limit load, to half of the part or less. Where a part has not been borne before, given limits tell in
   !! fewer iterations whether they bear this one.
   pure subroutine cut(search, done, attempt, part)
      type(limit_search), intent(inout) :: search
      real(wp), intent(in)              :: done    !! since the start of the increment [-]
      type(attempt_type), intent(inout) :: attempt
      real(wp), intent(inout)           :: part    !! [-]

      search%refused = done + part
      if (attempt%n_moving > 0) then
         search%limit = merge(done + attempt%bearable*part, 0.0_wp, attempt%bearable > least_share)
         search%verdict_type = attempt%verdict_type
         if (search%largest%n_moving == 0) search%largest = attempt%verdict_type
      end if
      search%n_cut = search%n_cut + 1
      if (search%n_cut > 1) part = 0.5_wp*part
      part = max(below_limit*min(search%limit, done + part) - done, near_limit*done, &
                 merge(0.5_wp, least_cut, attempt%is_limited)*part)
      search%only = merge(straight, sticking, done + part < search%limit .and. .not. attempt%is_limited)
      attempt%is_limited = .true.
   end subroutine cut

   !> The force that is missing at the end of the load, WHOLE shares after the start of the increment: that of SEARCH, whose limit load
   !! is too high where less was not borne, and too low where more was. Beyond the limit load the force grows with the load. It stands
   !! where SEARCH has no limit load, and where a body falls that the load does not push.
   pure real(wp) function missing_by_parts(search, done, whole) result(missing)
      type(limit_search), intent(in) :: search
      real(wp), intent(in)           :: done  !! since the start of the increment [-]
      real(wp), intent(in)           :: whole !! likewise

      missing = search%missing
      if (search%limit > 0.0_wp .and. .not. search%falls) missing = missing* &
         (whole - min(max(search%limit, done), search%unborne))/max(whole - search%limit, least_share)
   end function missing_by_parts

   !> Whether given limits have not borne a larger part than that of ATTEMPT, from an earlier state: the load of ATTEMPT is expected
   !! to be above the limit load, or near it.
   pure logical function follows_refused(attempt)
      type(attempt_type), intent(in) :: attempt

      follows_refused = attempt%expected(1) <= attempt%expected(2)
   end function follows_refused

   !> Whether such a part ends above the limit load, as far as the larger one has told it, or within AGREEMENT below it.
   pure logical function ends_above_limit(attempt)
      type(attempt_type), intent(in) :: attempt

      ends_above_limit = follows_refused(attempt) .and. attempt%expected(1) <= 1.0_wp
   end function ends_above_limit

   !> Whether given limits have not borne the part, and bear the share of it that a larger part has let expect.
   pure logical function is_expected(attempt)
      type(attempt_type), intent(in) :: attempt

      is_expected = attempt%n_moving > 0 .and. attempt%bearable >= attempt%expected(1) .and. attempt%bearable <= attempt%expected(2)
   end function is_expected

   !> Whether given limits bear about the same share of the part as they do of a larger one, from the same state.
   pure logical function is_alike(attempt, larger)
      type(attempt_type), intent(in) :: attempt
      type(verdict_type), intent(in) :: larger

      is_alike = larger%n_moving > 0 .and. abs(attempt%bearable - larger%bearable) <= &
                 max(alike*larger%bearable, least_share)
   end function is_alike

   !> Whether a joint has left its place, though given limits tell no share that they bear, in a part that ends above the limit load
   !! that a larger part has told.
   pure logical function leaves_as_expected(attempt)
      type(attempt_type), intent(in) :: attempt

      leaves_as_expected = attempt%n_moving == 0 .and. attempt%leaves > 0 .and. ends_above_limit(attempt) .and. &
                           attempt%expected(2) > 0.0_wp
   end function leaves_as_expected

   !> Whether something falls as in a larger part, as SEARCH has it, or a joint leaves its place after that: a gib that nothing
   !! presses any more falls whatever the load of the part.
   pure logical function falls_too(search, attempt)
      type(limit_search), intent(in) :: search
      type(attempt_type), intent(in) :: attempt

      falls_too = search%falls .and. merge(attempt%falls, attempt%leaves > 0, attempt%n_moving > 0)
   end function falls_too

end module limit_load
