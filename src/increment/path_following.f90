!> Follows the path in the increment of a stage without INCR: NEWTON divides it in ever more parts until its end no longer depends on
!! them.
submodule(newton_method) path_following
   use analysis_state, only: path_error_type
   use path_error, only: error_size, go_to_start, is_within
   implicit none

   integer, parameter  :: most_parts = 64     ! of an increment: with so many the path is not divided further
   real(wp), parameter :: falling = 0.75_wp   ! of the error of path with half as many parts: one that is larger does not fall

   !> The end of a part that follows the path, and displacements near it.
   type :: goal_type
      real(wp) :: at = 1.0_wp               ! of the increment [-]
      real(wp), allocatable :: u(:, :)      ! (dimension, retained) there [length]; not allocated: unknown
      real(wp), allocatable :: half(:, :)   ! likewise half way from the goal before
   end type goal_type

contains

   !> Go from equilibrium to equilibrium along the path: in one ATTEMPT, and while the error of path at its end is above PATHTOL and
   !! falls, in twice as many parts, which start from the displacements that the last division has found. The parts stand. Those that
   !! do not converge are divided at once. If a finer division does not converge, the last one stands.
   module subroutine follow_path(model, analysis, system, attempt, failure)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(inout)    :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      type(failure_type), intent(inout)     :: failure
      type(goal_type), allocatable :: goals(:)
      type(path_start_type) :: first, last
      type(path_error_type) :: error
      real(wp), allocatable :: u_start(:, :)
      integer  :: before_open, n_parts
      logical  :: falls

      allocate (u_start, source=analysis%u)
      before_open = count(analysis%states%normal%branch == branch_open)
      analysis%record%follows_path = .true.
      call note_start(analysis, first)
      goals = [goal_type()]
      n_parts = 0
      do
         call reach_goals(model, analysis, system, attempt, goals)
         if (.not. attempt%converged) exit
         falls = n_parts < 2 .or. error_size(analysis%record%path_error) < falling*error_size(error)
         n_parts = size(goals)
         error = analysis%record%path_error
         if (is_within(error, n_parts, analysis%path_tolerance) .or. .not. falls .or. 2*n_parts > most_parts) exit
         call note_start(analysis, last)
         call go_to_start(first, analysis)
         call halve_goals(goals)
      end do
      if (n_parts == 0) then
         call fail(model, analysis, attempt, failure)
         return
      end if
      if (.not. attempt%converged) call go_to_start(last, analysis)
      analysis%record%path_error = error
      analysis%record%n_parts = n_parts
      analysis%du = analysis%u - u_start
      analysis%record%n_removed = max(0, count(analysis%states%normal%branch == branch_open) - before_open)
   end subroutine follow_path

   !> Reach the GOALS one after another, with the error of path at the last. A goal that is not reached is halved, down to the
   !! smallest part.
   subroutine reach_goals(model, analysis, system, attempt, goals)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(inout)    :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      type(goal_type), allocatable, intent(inout) :: goals(:) !! displacements there and half way to them become known
      type(element_state), allocatable :: way(:)
      type(path_start_type) :: start
      real(wp) :: done, part
      integer  :: k

      allocate (way, source=analysis%states)
      done = 0.0_wp
      k = 1
      do while (k <= size(goals))
         part = goals(k)%at - done
         analysis%record%n_parts = k - 1
         call note_start(analysis, start)
         if (allocated(goals(k)%u)) then
            call try_part(model, system, analysis, 1.0_wp - goals(k)%at, attempt, goals(k)%u)
            if (.not. attempt%converged) deallocate (goals(k)%u)
         end if
         if (.not. allocated(goals(k)%u)) call try_part(model, system, analysis, 1.0_wp - goals(k)%at, attempt)
         if (attempt%converged) then
            goals(k)%u = analysis%u
            call measure_path(model, system, start, part, analysis, attempt, way, analysis%record%path_error, goals(k)%half)
            done = goals(k)%at
            k = k + 1
         else if (part > 0.5_wp**most_halvings) then
            goals = [goals(:k - 1), goal_type(done + 0.5_wp*part), goals(k:)]
         else
            attempt%left_over = 1.0_wp - done
            return
         end if
      end do
   end subroutine reach_goals

   !> Halve the parts between GOALS, where displacements half way are known.
   subroutine halve_goals(goals)
      type(goal_type), allocatable, intent(inout) :: goals(:)
      type(goal_type), allocatable :: halves(:)
      real(wp) :: done
      integer  :: k

      allocate (halves(2*size(goals)))
      done = 0.0_wp
      do k = 1, size(goals)
         halves(2*k - 1)%at = 0.5_wp*(done + goals(k)%at)
         call move_alloc(goals(k)%half, halves(2*k - 1)%u)
         halves(2*k)%at = goals(k)%at
         call move_alloc(goals(k)%u, halves(2*k)%u)
         done = goals(k)%at
      end do
      call move_alloc(halves, goals)
   end subroutine halve_goals

end submodule path_following
