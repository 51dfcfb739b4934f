!> The direction of an iteration of METHOD = NEWTON, and what an attempt at an increment is.
module newton_direction
   use analysis_state, only: analysis_type
   use equations, only: solve_coupled, equation_system, form_structure_stiffness, solve_equations
   use failures, only: failure_type
   use joint_laws, only: element_state
   use kinds, only: wp
   use model_data, only: model_type
   use normal_stiffness, only: branch_open
   use straight_laws, only: stiffness_at_rest, straight_laws_type
   implicit none
   private

   public :: find_direction, check_lifted, loose_joint

   integer, parameter  :: digits = 6                  ! of a direction: the next one corrects it
   real(wp), parameter :: little = 1.0e-7_wp          ! of the elastic stiffness: what the matrix has where an element has none
   real(wp), parameter :: far = 1.0e3_wp               ! times the last direction: nothing holds the body

   !> One attempt at a part of the increment: what it has to reach, and how it ended.
   type, public :: attempt_type
      character(:), allocatable :: where          !! stage and increment, for messages
      real(wp) :: left = 0.0_wp                   !! of the increment, when it is reached [-]
      real(wp) :: left_over = 1.0_wp              !! of it, where no part of that could be made [-]
      real(wp), allocatable :: load(:, :)         !! (dimension, retained), then [force]
      real(wp), allocatable :: move(:, :)         !! of held components, that is still to be made, likewise [length]
      integer, allocatable  :: flips(:)           !! changes of branch, by interface element
      real(wp) :: growth = 0.0_wp                 !! this increment over the last one of the stage, 0: there is none that goes on
      logical :: seats = .false.                  !! interference at rest, there is no load
      real(wp) :: seat_force = 0.0_wp             !! then what counts as one: p_av on the elements pressed [force]
      integer :: loose = 0                        !! a joint that is open or slips all over at its end, 0: none
      logical :: slides = .false.                 !! it is, and somewhere the friction limit is reached
      logical :: searches = .false.               !! along the tangents of the laws themselves, by line search
      integer :: worst(2) = 0                     !! node and direction that are farthest from balance at its end
      logical :: imprecise = .false.              !! rounding in the bodies is no small part of the load
      logical :: settled = .false.                !! no element has begun or ended to slip in the last iteration
      logical :: floats = .false.                 !! nothing but friction holds a body: it stays held
      real(wp) :: length = 0.0_wp                 !! of the last direction [length]
      logical :: converged = .false.
      type(failure_type) :: trouble               !! a matrix that could not be factorised
   end type attempt_type

contains

   !> The DIRECTION that balances what the straight LAWS leave as RESIDUAL. A joint that slips at all nodes is held by its elastic stiffness
   !! at first: nodes that turn back are found so, when no tangent tells of them. When no node turns any more its tangent counts, which
   !! squares the residual, unless nothing else holds the body in the direction of its movement.
   subroutine find_direction(model, residual, analysis, system, attempt, laws, direction)
      type(model_type), intent(in)            :: model
      real(wp), intent(in)                    :: residual(:, :)
      type(analysis_type), intent(inout)      :: analysis
      class(equation_system), intent(inout)   :: system
      type(attempt_type), intent(inout)       :: attempt
      type(straight_laws_type), intent(inout) :: laws !! their tangents become those of the equations solved
      real(wp), intent(inout)                 :: direction(:, :)
      real(wp) :: tangent(3, 3, size(laws%states))
      logical  :: is_loose

      direction = 0.0_wp ! what it is where the equations cannot be solved
      is_loose = loose_joint(model, laws%states) > 0
      tangent = laws%tangent
      call solve_laws(model, residual, is_loose .and. (attempt%floats .or. .not. attempt%settled), analysis, system, attempt, &
                      laws%tangent, direction)
      if (is_loose .and. attempt%settled .and. .not. attempt%floats .and. norm2(direction) > far*attempt%length) then
         attempt%floats = .true.
         laws%tangent = tangent
         call solve_laws(model, residual, .true., analysis, system, attempt, laws%tangent, direction)
      end if
      attempt%length = norm2(direction)
   end subroutine find_direction

   !> The DIRECTION under the TANGENTs of the joints, which become those of the equations solved. The factorised matrix has the
   !! symmetric part of them, shifted where an eigenvalue is below zero (an element that slips has one where its two
   !! shear laws differ), with a little where an element has no stiffness; what it lacks is brought in by solve_coupled.
   !! HOLDS: no element slips.
   subroutine solve_laws(model, residual, holds, analysis, system, attempt, tangent, direction)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: residual(:, :)
      logical, intent(in)                   :: holds
      type(analysis_type), intent(inout)    :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(inout)               :: tangent(:, :, :)
      real(wp), intent(inout)               :: direction(:, :)
      real(wp), allocatable :: matrix(:, :, :), rest(:, :, :)
      real(wp) :: elastic(3), least ! its eigenvalue
      integer  :: i, k
      logical  :: coupled

      allocate (matrix(3, 3, size(model%interface)), rest(3, 3, size(model%interface)), source=0.0_wp)
      do i = 1, size(model%interface)
         elastic = stiffness_at_rest(model, analysis, i)
         analysis%k(:, i) = [tangent(1, 1, i), tangent(2, 2, i), tangent(3, 3, i)]
         matrix(3, 3, i) = max(tangent(3, 3, i), little*elastic(3))
         matrix(:2, :2, i) = 0.5_wp*(tangent(:2, :2, i) + transpose(tangent(:2, :2, i)))
         least = 0.5_wp*(matrix(1, 1, i) + matrix(2, 2, i)) - hypot(0.5_wp*(matrix(1, 1, i) - matrix(2, 2, i)), matrix(1, 2, i))
         do k = 1, 2
            matrix(k, k, i) = matrix(k, k, i) - min(0.0_wp, least) + little*elastic(k)
            if (holds) matrix(k, k, i) = max(matrix(k, k, i), elastic(k))
         end do
         rest(:2, :, i) = tangent(:2, :, i) - matrix(:2, :, i)
         if (holds) rest(:2, :2, i) = 0.0_wp
      end do
      coupled = any(abs(rest(:2, 3, :)) > 0.0_wp) .and. all(abs(attempt%move) <= 0.0_wp)
      associate (failure => attempt%trouble)
         if (coupled) then
            call solve_coupled(model, matrix, rest, residual, attempt%where, system, direction, failure)
            tangent = matrix + rest
         else
            call form_structure_stiffness(model, matrix, attempt%where, system, failure, one_solution=.true.)
            call solve_equations(model, system, residual, direction, failure, moved=attempt%move, digits=digits)
            tangent = matrix
         end if
      end associate
   end subroutine solve_laws

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
         k = stiffness_at_rest(model, analysis, i)
         do d = 1, 3
            matrix(d, d, i) = k(d)
         end do
      end do
      call form_structure_stiffness(model, matrix, where, system, failure, one_solution=.true.)
   end subroutine check_lifted

   !> The first joint whose elements all are open or slip in STATES, 0 for none.
   pure integer function loose_joint(model, states) result(joint)
      type(model_type), intent(in)    :: model
      type(element_state), intent(in) :: states(:)

      do joint = 1, size(model%joints)
         associate (of_joint => states(model%joints(joint)%first:model%joints(joint)%last))
            if (size(of_joint) > 0 .and. all(of_joint%slips .or. of_joint%normal%branch == branch_open)) return
         end associate
      end do
      joint = 0
   end function loose_joint

end module newton_direction
