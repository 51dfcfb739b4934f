!> The direction of an iteration of METHOD = NEWTON, and what an attempt at an increment is.
module newton_direction
   use analysis_state, only: analysis_type
   use equations, only: solve_coupled, equation_system, form_structure_stiffness, solve_equations
   use failures, only: failure_type
   use interface_operator, only: add_force
   use joint_laws, only: element_state, element_stiffness_of, is_apart
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: trial_type
   use normal_stiffness, only: branch_open
   implicit none
   private

   public :: find_direction, close_gaps, check_lifted, loose_joint

   integer, parameter  :: digits = 6                  ! of a direction: the next one corrects it
   real(wp), parameter :: little = 1.0e-7_wp          ! of the elastic stiffness: what the matrix has where an element has none

   !> One attempt at a part of the increment: what it has to reach, and how it ended.
   type, public :: attempt_type
      character(:), allocatable :: where          !! stage and increment, for messages
      real(wp) :: left = 0.0_wp                   !! of the increment, when it is reached [-]
      real(wp) :: left_over = 1.0_wp              !! of it, where no part of that could be made [-]
      real(wp), allocatable :: load(:, :)         !! (dimension, retained), then [force]
      real(wp), allocatable :: move(:, :)         !! of held components, that is still to be made, likewise [length]
      integer, allocatable  :: flips(:)           !! changes of branch, by interface element
      logical :: seats = .false.                  !! interference at rest, there is no load
      real(wp) :: seat_force = 0.0_wp             !! then what counts as one: p_av on the elements pressed [force]
      integer :: loose = 0                        !! a joint that is open or slips all over at its end, 0: none
      logical :: slides = .false.                 !! it is, and somewhere the friction limit is reached
      integer :: worst(2) = 0                     !! node and direction that are farthest from balance at its end
      logical :: imprecise = .false.              !! rounding in the bodies is no small part of the load
      logical :: holds = .false.                  !! joints that slip at all nodes are held by their elastic shear stiffness
      logical :: converged = .false.
      type(failure_type) :: trouble               !! a matrix that could not be factorised
   end type attempt_type

contains

   !> The Newton direction from NOW. The factorised matrix has the symmetric, positive part of the tangent, with a little where
   !! an element has no stiffness, and at the very first the secant of Eq. (9); what it lacks is brought in by solve_coupled. Where ATTEMPT
   !! holds a joint that slips at all nodes the elastic stiffness stays: nodes that turn back are found so, when no tangent tells of them.
   subroutine find_direction(model, now, analysis, first, system, attempt, direction)
      type(model_type), intent(in)          :: model
      type(trial_type), intent(in)          :: now
      type(analysis_type), intent(inout)    :: analysis
      logical, intent(in)                   :: first
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(inout)               :: direction(:, :)
      real(wp), allocatable :: matrix(:, :, :), rest(:, :, :)
      real(wp) :: elastic(3)
      integer  :: i, k
      logical  :: virgin, coupled, held

      allocate (matrix(3, 3, size(model%interface)), rest(3, 3, size(model%interface)), source=0.0_wp)
      coupled = .false.
      held = .false.
      if (attempt%holds) held = loose_joint(model, now) > 0
      do i = 1, size(model%interface)
         associate (element => model%interface(i))
            virgin = first .and. abs(analysis%states(i)%normal%lambda_a) <= 0.0_wp .and. abs(element%gap) <= 0.0_wp
            elastic = first_stiffness_of(model, analysis, i)
            matrix(3, 3, i) = max(now%tangent(3, 3, i), little*elastic(3))
            if (virgin) matrix(3, 3, i) = elastic(3)
            matrix(:2, :2, i) = 0.5_wp*(now%tangent(:2, :2, i) + transpose(now%tangent(:2, :2, i)))
            do k = 1, 2
               matrix(k, k, i) = max(0.0_wp, matrix(k, k, i)) + little*elastic(k)
               if (virgin .or. (held .and. now%states(i)%slips)) matrix(k, k, i) = max(matrix(k, k, i), elastic(k))
            end do
            analysis%k(:, i) = [now%tangent(1, 1, i), now%tangent(2, 2, i), now%tangent(3, 3, i)]
            rest(:2, :, i) = now%tangent(:2, :, i) - matrix(:2, :, i)
            if (held) rest(:2, :2, i) = 0.0_wp
            if (any(abs(now%tangent(:2, 3, i)) > 0.0_wp)) coupled = .true.
         end associate
      end do
      associate (failure => attempt%trouble)
         call form_structure_stiffness(model, matrix, attempt%where, system, failure, one_solution=.not. coupled)
         if (coupled .and. all(abs(attempt%move) <= 0.0_wp)) then
            call solve_coupled(model, system, rest, now%residual, 1.0e-4_wp, 25, direction, failure)
         else
            call solve_equations(model, system, now%residual, direction, failure, moved=attempt%move, digits=digits)
         end if
      end associate
   end subroutine find_direction

   !> A body that nothing holds before a gap closes: the direction from NOW in which all open elements with gaps close, and
   !! bear what is unbalanced with the secants of Eq. (9). ATTEMPT stays in trouble where there are none, or that does not help.
   subroutine close_gaps(model, now, analysis, system, attempt, direction)
      type(model_type), intent(in)          :: model
      type(trial_type), intent(in)          :: now
      type(analysis_type), intent(in)       :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(inout)               :: direction(:, :)
      real(wp), allocatable :: matrix(:, :, :), load(:, :)
      type(failure_type) :: none
      real(wp) :: k(3)
      integer  :: d, i

      if (.not. any(is_apart(now%states))) return
      attempt%trouble = none
      allocate (matrix(3, 3, size(model%interface)), source=0.0_wp)
      load = now%residual
      do i = 1, size(model%interface)
         k = first_stiffness_of(model, analysis, i)
         do d = 1, 3
            matrix(d, d, i) = max(0.0_wp, now%tangent(d, d, i)) + little*k(d)
         end do
         if (.not. is_apart(now%states(i))) cycle
         matrix(3, 3, i) = k(3)
         associate (state => now%states(i)%normal)
            call add_force(system%interface(i), [0.0_wp, 0.0_wp, k(3)*(state%lambda_b - state%lambda)], load)
         end associate
      end do
      call form_structure_stiffness(model, matrix, attempt%where, system, attempt%trouble, one_solution=.true.)
      call solve_equations(model, system, load, direction, attempt%trouble, digits=digits)
   end subroutine close_gaps

   !> Supports that are moved have opened joints all over, from the branches BEFORE: what they have lifted off must be held without
   !! these joints. The little stiffness that open elements have in find_direction hides what is not.
   subroutine check_lifted(model, before, analysis, where, system, failure)
      type(model_type), intent(in)          :: model
      integer, intent(in)                   :: before(:) !! branches of all interface elements in the normal direction
      type(analysis_type), intent(in)       :: analysis
      character(*), intent(in)              :: where     !! for the message
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)     :: failure
      real(wp), allocatable :: matrix(:, :, :)
      real(wp) :: k(3)
      integer  :: d, i, j
      logical  :: lifted

      lifted = .false.
      do j = 1, size(model%joints)
         associate (was => before(model%joints(j)%first:model%joints(j)%last), &
                    now => analysis%states(model%joints(j)%first:model%joints(j)%last)%normal%branch)
            if (any(was /= branch_open) .and. all(now == branch_open)) lifted = .true.
         end associate
      end do
      if (.not. lifted .or. .not. analysis%moves) return
      allocate (matrix(3, 3, size(model%interface)), source=0.0_wp)
      do i = 1, size(model%interface)
         if (analysis%states(i)%normal%branch == branch_open) cycle
         k = first_stiffness_of(model, analysis, i)
         do d = 1, 3
            matrix(d, d, i) = k(d)
         end do
      end do
      call form_structure_stiffness(model, matrix, where, system, failure, one_solution=.true.)
   end subroutine check_lifted

   !> (k_sx, k_sy, k_n) of interface element I in its first increment [force/length].
   pure function first_stiffness_of(model, analysis, i) result(k)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i
      real(wp) :: k(3)
      type(element_state) :: at_rest

      at_rest%normal%p_av = analysis%states(i)%normal%p_av
      associate (element => model%interface(i))
         call element_stiffness_of(model%joints(element%joint)%law, element%area, .false., [0.0_wp, 0.0_wp, 0.0_wp], at_rest, k)
      end associate
   end function first_stiffness_of

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

end module newton_direction
