!> The error of path of METHOD = NEWTON: how far the end of an increment is from the limit of many increments.
!! An increment, or a part of it, takes every interface element from its start to its end in one movement. An element that the load
!! presses and lets go meanwhile, or whose shear and pressure do not grow in proportion, would come to another force along the path.
!! The displacements half way follow from the mean of both ends under the mean load, and where the error would be within its
!! limit, those at a quarter from it and the start. The exact laws are followed over the quarter and along the parabola through
!! start, half and end up to three quarters, and from there to the equilibrium at the end. The equilibria are found without a
!! factorisation where corrections lead near enough. Where the unbalanced forces that these leave could change whether the error
!! is within its limit, those half way and at the end are found by iterations. These states go on from part to part.
!! Where elements with shear are pressed from nearly nothing, shear and pressure grow together from there, and the first of equal parts
!! is like the whole. The parts are graded then: the pressure grows from part to part by shares of itself.
module path_error
   use analysis_state, only: analysis_type, path_error_type, turning_point
   use equation_solver, only: coupled_tally, failure_type
   use equations, only: equation_system
   use interface_operator, only: joint_movement
   use joint_laws, only: element_state, follow_element, force_of, rest_when_open
   use joint_work, only: joint_energy
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: attempt_type
   use normal_stiffness, only: branch_load, branch_open
   use straight_laws, only: loose_joints
   use tolerances, only: equal_shares, least_start, loose_direction, no_contact, off_path
   use way_points, only: correction, find_equilibrium
   implicit none
   private

   public :: note_start, go_to_start, grading, share_of, measure_path, change_since, expect, is_within, error_size

   real(wp), parameter :: contact_per_tol = 10.0_wp  ! share of the area that may change its contact, in PATHTOL
   real(wp), parameter :: from_nothing = 0.01_wp     ! share of the last pressure at the start of an element: parts are graded below it
   real(wp), parameter :: by_few = 0.1_wp            ! share of the shear that such elements bear: below it parts are equal
   real(wp), parameter :: at_quarter = 0.25_wp       ! of the way
   real(wp), parameter :: certain = 0.01_wp          ! of the limit: uncertainty of equilibria that are known
   integer, parameter  :: grade = 5                  ! power of the load along graded parts
   real(wp), parameter, public :: none = 1.0_wp      ! as grading: equal parts

   !> What an attempt changes when it is committed.
   type, public :: path_start_type
      private
      real(wp), allocatable :: u(:, :), body(:, :), unbalanced(:, :), movement(:, :)
      type(element_state), allocatable :: states(:)
      type(joint_energy), allocatable  :: energy(:)
      type(turning_point), allocatable :: turns(:, :)
      integer, allocatable :: kind(:)
   end type path_start_type

contains

   !> Note the state from which an attempt starts.
   subroutine note_start(analysis, start)
      type(analysis_type), intent(in)    :: analysis
      type(path_start_type), intent(out) :: start

      start%u = analysis%u
      start%body = analysis%body
      start%unbalanced = analysis%unbalanced
      start%movement = analysis%movement
      start%states = analysis%states
      start%energy = analysis%energy
      start%turns = analysis%turns
      start%kind = analysis%record%kind
   end subroutine note_start

   !> Return to the state from which an attempt has started.
   subroutine go_to_start(start, analysis)
      type(path_start_type), intent(in)  :: start
      type(analysis_type), intent(inout) :: analysis

      analysis%u = start%u
      analysis%body = start%body
      analysis%unbalanced = start%unbalanced
      analysis%movement = start%movement
      analysis%states = start%states
      analysis%energy = start%energy
      analysis%turns = start%turns
      analysis%record%kind = start%kind
   end subroutine go_to_start

   !> The share of the load at which graded parts would begin, to the power of one over GRADE [-]: the least pressure at the START over
   !! that at the end, of the elements that bear shear at the end. If those pressed from nothing bear little of it, parts are equal.
   pure real(wp) function grading(model, start, analysis) result(e)
      type(model_type), intent(in)      :: model
      type(path_start_type), intent(in) :: start
      type(analysis_type), intent(in)   :: analysis
      real(wp) :: counts, least, ratio, shear(2)
      integer  :: i

      least = 1.0_wp
      shear = 0.0_wp
      counts = analysis%path_tolerance*maxval(analysis%states%normal%pressure)
      do i = 1, size(analysis%states)
         associate (after => analysis%states(i), area => model%joints%element(i)%area)
            if (.not. (norm2(after%shear%tau) > counts .and. after%normal%pressure > counts)) cycle
            ratio = start%states(i)%normal%pressure/after%normal%pressure
            least = min(least, ratio)
            shear = shear + area*norm2(after%shear%tau)*[1.0_wp, merge(1.0_wp, 0.0_wp, ratio < from_nothing)]
         end associate
      end do
      e = none
      if (shear(2) > by_few*shear(1)) e = max(least, least_start)**(1.0_wp/grade)
   end function grading

   !> The share of the increment's load at S of its parts, graded from E.
   elemental real(wp) function share_of(s, e) result(share)
      real(wp), intent(in) :: s !! [-], 0 to 1
      real(wp), intent(in) :: e !! of grading

      share = s
      if (e < none .and. s > 0.0_wp .and. s < 1.0_wp) share = ((e + (1.0_wp - e)*s)**grade - e**grade)/(1.0_wp - e**grade)
   end function share_of

   !> Follow the WAY from the start of the increment along the committed ATTEMPT at the part between ENDS of it, graded from E, from
   !! START, whose displacements HALF way are found. ERROR is that of the committed states from the end of the WAY.
   subroutine measure_path(model, system, start, ends, e, analysis, attempt, way, carried, error, half)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system   !! with the factor of the last iteration; returned with that of the last one
      type(path_start_type), intent(inout)  :: start    !! returned as it was
      real(wp), intent(in)                  :: ends(2)  !! of the part, before grading [-], 0 to 1
      real(wp), intent(in)                  :: e        !! of grading
      type(analysis_type), intent(inout)    :: analysis !! returned as it was, but for the iterations recorded
      type(attempt_type), intent(inout)     :: attempt  !! likewise, but for COUPLED and ITERATION
      type(element_state), allocatable, intent(inout) :: way(:) !! (interface elements)
      real(wp), intent(inout)               :: carried    !! uncertainty of the way before the part, then of that behind it [-]
      type(path_error_type), intent(out)    :: error
      real(wp), allocatable, intent(out)    :: half(:, :) !! (dimension, retained) [length]
      type(coupled_tally) :: tally
      type(element_state), allocatable :: along(:), before(:)
      real(wp), allocatable :: at_end(:, :), early(:, :)
      real(wp) :: shares(3) ! of the increment's load at the start, half way and at the end
      real(wp) :: share     ! at a quarter of the way
      real(wp) :: uncertainty(2) ! of the equilibria half way and at the end, in the measure of the error
      real(wp) :: allowed, limit, of_early
      logical  :: iterates
      integer  :: i

      limit = merge(analysis%path_tolerance, off_path, analysis%record%follows_path)
      allocate (before, source=way)
      shares = share_of([ends(1), 0.5_wp*sum(ends), ends(2)], e)
      half = start%u + (shares(2) - shares(1))/(shares(3) - shares(1))*(analysis%u - start%u)
      if (size(way) == 0) return
      ! an attempt that begins in equilibrium makes no factor; that of earlier iterations of the increment serves
      if (analysis%record%n_iterations > 0) attempt%iteration = max(1, attempt%iteration)
      tally = system%coupled
      iterates = .false.
      allowed = huge(1.0_wp)
      do
         uncertainty = 0.0_wp
         if (attempt%iteration > 0) & ! otherwise there may be no factor
            call find_equilibrium(model, system, attempt%left + shares(3) - shares(2), half, start%states, allowed, &
                                  analysis, attempt, along, uncertainty(1))
         way = before
         call follow_way(model, system, start, early, half, analysis, way)
         at_end = analysis%u
         call find_equilibrium(model, system, attempt%left, at_end, way, allowed, analysis, attempt, along, uncertainty(2))
         way = along
         do i = 1, size(way)
            call rest_when_open(way(i), joint_movement(system%interface(i), at_end))
         end do
         error = difference(model, analysis%states, way, analysis%path_tolerance)
         error%displacement = distance(at_end, analysis%u)
         if (analysis%record%follows_path .and. .not. error%unseen) &
            call look_ahead(model, system, (shares(3) - shares(1))*analysis%change, attempt, analysis, error%unseen)
         ! an error is within its limit only by a way that is known well enough, and over a quarter if that is known
         if (error_size(error) > limit .or. attempt%iteration == 0) exit
         if (analysis%record%follows_path .and. .not. &
             is_within(error, nint(1.0_wp/(ends(2) - ends(1))), e, analysis%path_tolerance)) exit
         if (error_size(error) + carried + sum(uncertainty) > limit) then
            if (iterates) exit
            iterates = .true.
            allowed = 0.5_wp*max(0.0_wp, limit - carried - error_size(error))
         else if (.not. allocated(early) .and. sum(uncertainty) <= certain*limit) then
            share = share_of(ends(1) + at_quarter*(ends(2) - ends(1)), e)
            early = start%u + (share - shares(1))/(shares(2) - shares(1))*(half - start%u)
            call find_equilibrium(model, system, attempt%left + shares(3) - share, early, start%states, huge(1.0_wp), &
                                  analysis, attempt, along, of_early)
            if (of_early > certain*limit) exit ! not known: the error is that of the way over HALF alone
         else
            exit
         end if
      end do
      carried = carried + sum(uncertainty)
      ! iterations may have made a factor of their own, to which the earlier directions do not belong; the cost of all steps counts
      if (system%coupled%n_factors == tally%n_factors) then
         tally%extra = system%coupled%extra
         tally%spent = system%coupled%spent
         system%coupled = tally
      end if
   end subroutine measure_path

   !> Whether the committed state TURNS back: if the part's CHANGE of load went on, an element on the loading branch would be let go
   !! by more than PATHTOL. It has been pressed more before, between the points of the way.
   subroutine look_ahead(model, system, change, attempt, analysis, turns)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)                  :: change(:, :) !! (dimension, retained) [force]
      type(attempt_type), intent(in)        :: attempt
      type(analysis_type), intent(in)       :: analysis
      logical, intent(out)                  :: turns
      real(wp) :: direction(size(change, 1), size(change, 2)), movement(3), largest
      type(failure_type) :: failure
      integer :: i

      turns = .false.
      if (attempt%iteration == 0) return
      call correction(model, system, merge(0.0_wp, change, analysis%held), attempt%coupled, loose_direction, direction, failure)
      if (failure%raised) return
      largest = max(maxval(analysis%states%normal%lambda_a), maxval(analysis%states%normal%lambda))
      do i = 1, size(analysis%states)
         if (analysis%states(i)%normal%branch /= branch_load) cycle
         movement = joint_movement(system%interface(i), direction)
         turns = turns .or. movement(3) < -analysis%path_tolerance*largest
      end do
   end subroutine look_ahead

   !> Follow the states ALONG the way from START over HALF up to three quarters of it, over EARLY at a quarter if this is known.
   subroutine follow_way(model, system, start, early, half, analysis, along)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(path_start_type), intent(in)  :: start
      real(wp), allocatable, intent(in)  :: early(:, :) !! (dimension, retained) [length]; not allocated: not known
      real(wp), intent(in)               :: half(:, :)  !! likewise
      type(analysis_type), intent(in)    :: analysis
      type(element_state), intent(inout) :: along(:)
      real(wp), parameter :: weights(3, 3) = reshape([0.375_wp, 0.75_wp, -0.125_wp, 0.0_wp, 1.0_wp, 0.0_wp, &
                                                      -0.125_wp, 0.75_wp, 0.375_wp], [3, 3])
      type(element_state) :: after
      real(wp) :: at(3, 3), movement(3), tangent(3, 3)
      integer  :: i, k

      do i = 1, size(along)
         associate (element => model%joints%element(i))
            at(:, 1) = start%movement(:, i)
            at(:, 2) = joint_movement(system%interface(i), half)
            at(:, 3) = analysis%movement(:, i)
            do k = 1, 3
               movement = matmul(at, weights(:, k))
               associate (ends => at(:, max(1, k - 1):min(k, 2) + 1))
                  ! no further than its ends: a parabola through uneven steps turns by itself
                  movement = min(max(movement, minval(ends, dim=2)), maxval(ends, dim=2))
               end associate
               if (k == 1 .and. allocated(early)) movement = joint_movement(system%interface(i), early)
               call follow_element(model%joints%list(element%joint)%law, element%area, along(i), movement, after, tangent)
               call rest_when_open(after, movement)
               along(i) = after
            end do
         end associate
      end do
   end subroutine follow_way

   !> The error of the STATES from those along the WAY: root mean square over each joint, the largest of all joints. Elements that
   !! are open in both do not count.
   pure type(path_error_type) function difference(model, states, way, tolerance) result(error)
      type(model_type), intent(in)    :: model
      type(element_state), intent(in) :: states(:), way(:)
      real(wp), intent(in)            :: tolerance !! PATHTOL
      real(wp) :: lambda, open_area, p, squares(2)
      logical  :: is_open(2)
      integer  :: i, j

      error%slides = slides(model, states) .or. slides(model, way)
      lambda = max(maxval(way%normal%lambda_a), maxval(way%normal%lambda))
      p = max(maxval(way%normal%p_a), maxval(way%normal%pressure))
      if (.not. (lambda > 0.0_wp .and. p > 0.0_wp)) return
      do j = 1, size(model%joints%list)
         squares = 0.0_wp
         open_area = 0.0_wp
         do i = model%joints%list(j)%first, model%joints%list(j)%last
            associate (area => model%joints%element(i)%area, a => states(i)%normal, b => way(i)%normal)
               is_open = [a%branch, b%branch] == branch_open
               if (all(is_open)) cycle
               error%unseen = error%unseen .or. abs(max(a%pressure, a%p_a) - max(b%pressure, b%p_a)) > tolerance*p
               squares = squares + area*([a%lambda - b%lambda, a%pressure - b%pressure]/[lambda, p])**2
               if (.not. any(is_open)) cycle
               error%lets_go = error%lets_go .or. max(a%pressure, b%pressure) > no_contact*p
               if (max(a%pressure, b%pressure) > tolerance*p) open_area = open_area + area
            end associate
         end do
         squares = squares/model%joints%list(j)%area
         error%deflection = max(error%deflection, sqrt(squares(1)))
         error%pressure = max(error%pressure, sqrt(squares(2)))
         error%contact = max(error%contact, open_area/model%joints%list(j)%area)
      end do
   end function difference

   !> The difference of the states from those at the end of the LAST division.
   pure type(path_error_type) function change_since(model, last, analysis) result(change)
      type(model_type), intent(in)      :: model
      type(path_start_type), intent(in) :: last
      type(analysis_type), intent(in)   :: analysis

      change = difference(model, analysis%states, last%states, analysis%path_tolerance)
      change%displacement = distance(analysis%u, last%u)
   end function change_since

   !> The ERROR is what further divisions would change, if each changes Q of the one before (a geometric series). Unless this IS_KNOWN,
   !! the error along the way counts too, and contact, which comes and goes at once, by it alone.
   elemental subroutine expect(change, q, is_known, error)
      type(path_error_type), intent(in)    :: change   !! of the last division
      real(wp), intent(in)                 :: q        !! [-], < 1
      logical, intent(in)                  :: is_known !! the changes fall as those of a series do
      type(path_error_type), intent(inout) :: error
      real(wp) :: along

      along = merge(0.0_wp, 1.0_wp, is_known)
      associate (rest => q/(1.0_wp - q))
         error%deflection = max(along*error%deflection, rest*change%deflection)
         error%pressure = max(along*error%pressure, rest*change%pressure)
         error%displacement = max(along*error%displacement, rest*change%displacement)
         if (is_known) error%contact = rest*change%contact
      end associate
   end subroutine expect

   !> Whether a joint slides in STATES: it is loose, and an element of it slips.
   pure logical function slides(model, states)
      type(model_type), intent(in)    :: model
      type(element_state), intent(in) :: states(:)
      logical :: loose(size(model%joints%list))

      loose = loose_joints(model, states)
      slides = any(states%slips .and. loose(model%joints%element%joint))
   end function slides

   !> The largest difference of displacements A and B, of the largest one.
   pure real(wp) function distance(a, b)
      real(wp), intent(in) :: a(:, :), b(:, :) !! (dimension, retained) [length]

      distance = maxval(abs(a - b))/max(maxval(abs(a)), maxval(abs(b)), tiny(1.0_wp))
   end function distance

   !> Whether the ERROR of an increment in N_PARTS is within TOLERANCE. An increment whose parts are graded is not taken in one part, nor
   !! one in which a joint slides, an element is let go, of whatever pressure, or the way may hold more than its points show. Of two
   !! graded parts the second is nearly the whole: they count as one.
   pure logical function is_within(error, n_parts, e, tolerance)
      type(path_error_type), intent(in) :: error
      integer, intent(in)               :: n_parts
      real(wp), intent(in)              :: e         !! of grading
      real(wp), intent(in)              :: tolerance !! PATHTOL

      is_within = error_size(error) <= tolerance*(1.0_wp + equal_shares) .and. &
                  n_parts >= merge(2, 1, e < none)*merge(2, 1, error%lets_go .or. error%slides .or. error%unseen)
   end function is_within

   !> The ERROR as a number to compare with PATHTOL. Displacements count where a joint slides.
   pure real(wp) function error_size(error) result(size)
      type(path_error_type), intent(in) :: error

      size = max(error%deflection, error%pressure, error%contact/contact_per_tol)
      if (error%slides) size = max(size, error%displacement)
   end function error_size

end module path_error
