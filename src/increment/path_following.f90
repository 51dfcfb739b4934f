!> Follows the path in the increment of a stage without INCR: NEWTON divides it into ever more parts, equal or graded, until its end
!! no longer depends on them.
submodule(newton_method) path_following
   use analysis_state, only: path_error_type
   use path_error, only: change_since, error_size, expect, go_to_start, grading, is_within, none, share_of
   implicit none

   integer, parameter  :: most_parts = 64   ! of an increment
   integer, parameter  :: first_parts = 8   ! with twice as many the error must fall, and from there on
   real(wp), parameter :: falling = 0.75_wp ! of the error of path with half as many parts: one that is larger does not fall
   real(wp), parameter :: second_order = 0.25_wp, first_order = 0.5_wp ! of the change of the last division: the change of the next

   !> Displacements that the last division has found.
   type :: known_type
      real(wp), allocatable :: u(:, :)      ! (dimension, retained) at the end of a part [length]
      real(wp), allocatable :: half(:, :)   ! likewise half way to it
   end type known_type

contains

   !> Go from equilibrium to equilibrium along the path: in one ATTEMPT, and while the error of path at its end is above PATHTOL and
   !! falls, in twice as many parts, which start from the displacements that the last division has found. The parts stand. If a finer
   !! division does not converge, the last one stands.
   module subroutine follow_path(model, analysis, system, attempt)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(inout)    :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      type(known_type), allocatable :: known(:)
      type(path_start_type) :: first, last
      type(path_error_type) :: error, change
      real(wp) :: e, q, size_before, uncertainty
      integer  :: n
      logical  :: falls, is_known, is_whole

      analysis%record%follows_path = .true.
      call note_start(analysis, first)
      allocate (known(1))
      e = none
      size_before = 0.0_wp
      n = 0
      is_whole = .true.
      do
         analysis%record%is_whole = .true.
         call reach_in_parts(model, analysis, system, attempt, e, known, uncertainty)
         if (.not. attempt%converged) exit
         if (n > 0) then
            change = change_since(model, last, analysis)
            is_known = .false.
            q = merge(first_order, second_order, error%unseen)
            if (n > 1) then
               is_known = error_size(change) <= first_order*size_before .and. .not. analysis%record%path_error%unseen
               q = min(max(error_size(change)/size_before, second_order), falling)
            end if
            size_before = max(error_size(change), tiny(1.0_wp))
            ! one part cannot see what is let go: what two equal ones change tells nothing of the next change
            if (n > 1 .or. e < none .or. .not. error%lets_go) call expect(change, q, is_known, analysis%record%path_error)
         end if
         falls = n < first_parts .or. &
                 error_size(analysis%record%path_error) < max(falling*error_size(error), analysis%path_tolerance)
         n = size(known)
         is_whole = analysis%record%is_whole
         error = analysis%record%path_error
         if ((is_within(error, n, e, analysis%path_tolerance) .and. uncertainty <= analysis%path_tolerance) .or. &
             .not. falls .or. 2*n > most_parts) exit
         call note_start(analysis, last)
         call go_to_start(first, analysis)
         call halve_parts(known)
      end do
      if (n == 0) return
      if (.not. attempt%converged) call go_to_start(last, analysis)
      attempt%converged = .true.
      analysis%record%is_whole = is_whole
      analysis%record%path_error = error
      analysis%record%n_parts = n
   end subroutine follow_path

   !> Reach the end of the increment in parts, as many as KNOWN has, with the error of path there.
   subroutine reach_in_parts(model, analysis, system, attempt, e, known, uncertainty)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(inout)    :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(inout)               :: e        !! of grading; one part decides on it
      real(wp), intent(out)                 :: uncertainty !! of the way [-]
      type(known_type), intent(inout)       :: known(:) !! of the last division; becomes that of this one
      type(element_state), allocatable :: way(:)
      type(path_start_type) :: start
      type(path_error_type) :: error
      real(wp) :: ends(2)
      integer  :: k, n

      allocate (way, source=analysis%states)
      n = size(known)
      uncertainty = 0.0_wp
      do k = 1, n
         ends = [real(k - 1, wp), real(k, wp)]/real(n, wp)
         analysis%record%n_parts = k - 1
         call note_start(analysis, start)
         if (allocated(known(k)%u)) then
            call reach(model, analysis, system, attempt, share_of(ends, e), known(k)%u)
         else
            call reach(model, analysis, system, attempt, ends)
         end if
         if (.not. attempt%converged) return
         known(k)%u = analysis%u
         if (n == 1) e = grading(model, start, analysis)
         call measure_path(model, system, start, ends, e, analysis, attempt, way, uncertainty, error, known(k)%half)
         analysis%record%path_error = error
      end do
   end subroutine reach_in_parts

   !> Halve the parts: twice as many have KNOWN displacements.
   pure subroutine halve_parts(known)
      type(known_type), allocatable, intent(inout) :: known(:)
      type(known_type), allocatable :: halves(:)
      integer :: k

      allocate (halves(2*size(known)))
      do k = 1, size(known)
         call move_alloc(known(k)%half, halves(2*k - 1)%u)
         call move_alloc(known(k)%u, halves(2*k)%u)
      end do
      call move_alloc(halves, known)
   end subroutine halve_parts

end submodule path_following
