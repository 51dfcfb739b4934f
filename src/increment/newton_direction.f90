!> The search direction of an iteration of METHOD = NEWTON, and the data of an attempt at an increment.
module newton_direction
   use analysis_state, only: analysis_type
   use equations, only: equation_system, form_structure_stiffness, solve_coupled, solve_coupled_again, solve_equations
   use equation_solver, only: failure_type
   use joint_laws, only: element_state
   use kinds, only: wp
   use model_data, only: model_type
   use normal_stiffness, only: branch_open
   use straight_laws, only: stiffness_at_rest, straight_laws_type
   implicit none
   private

   public :: find_direction, find_again, check_lifted, loose_joint

   integer, parameter  :: digits = 6                  ! of a direction: the next iteration corrects it
   real(wp), parameter :: little = 1.0e-7_wp          ! of the elastic stiffness: substitute for zero stiffness of an element
   real(wp), parameter :: far = 1.0e3_wp               ! times the last direction: the body is not held

   !> One attempt at a part of the increment: its goal and its outcome.
   type, public :: attempt_type
      character(:), allocatable :: where          !! stage and increment, for messages
      real(wp) :: left = 0.0_wp                   !! fraction of the increment left at the goal [-]
      real(wp) :: left_over = 1.0_wp              !! of it, where no part of the increment was possible [-]
      real(wp), allocatable :: load(:, :)         !! (dimension, retained) at the goal [force]
      real(wp), allocatable :: move(:, :)         !! likewise, movement of held components still to do [length]
      integer, allocatable  :: flips(:)           !! changes of branch of each interface element
      real(wp) :: growth = 0.0_wp                 !! ratio to the last increment of the stage, 0: not its continuation
      logical :: seats = .false.                  !! interference at rest without load
      real(wp) :: seat_force = 0.0_wp             !! then the reference force: p_av on the pressed elements [force]
      integer :: loose = 0                        !! a joint that is open or slips entirely at the end, 0: none
      logical :: slides = .false.                 !! ... and the friction limit is reached somewhere
      logical :: searches = .false.               !! line search along the tangents of the laws themselves
      integer :: worst(2) = 0                     !! node and direction of the largest residual at the end
      logical :: imprecise = .false.              !! rounding in the bodies is not small compared with the load
      logical :: settled = .false.                !! no element has begun or stopped slipping in the last iteration
      logical :: floats = .false.                 !! only friction holds a body, which stays held
      real(wp) :: tolerance = 1.0e-4_wp           !! residual that the next direction may leave, relative [-]
      real(wp) :: length = 0.0_wp                 !! of the last direction [length]
      logical :: coupled = .false.                !! the last direction was that of a coupled system
      logical :: converged = .false.
      type(failure_type) :: trouble               !! a matrix that could not be factorised
   end type attempt_type

contains

   !> The DIRECTION that balances the RESIDUAL of the straight LAWS. A joint that slips at all nodes first has its elastic
   !! stiffness: this finds nodes that turn back, which no tangent shows. When no node turns back any more, the tangent is used,
   !! which gives quadratic convergence, unless nothing else holds the body in its direction of movement.
   subroutine find_direction(model, residual, analysis, system, attempt, laws, direction)
      type(model_type), intent(in)            :: model
      real(wp), intent(in)                    :: residual(:, :)
      type(analysis_type), intent(inout)      :: analysis
      class(equation_system), intent(inout)   :: system
      type(attempt_type), intent(inout)       :: attempt
      type(straight_laws_type), intent(inout) :: laws !! their tangents become those of the solved equations
      real(wp), intent(inout)                 :: direction(:, :)
      real(wp) :: tangent(3, 3, size(laws%states))
      logical  :: is_loose

      direction = 0.0_wp ! result where the equations cannot be solved
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

   !> The DIRECTION under the TANGENTs of the joints, which become those of the solved equations. The factorised matrix has the
   !! symmetric part of the tangents. This part is shifted where an eigenvalue is negative (a slipping element has one where its
   !! two shear laws differ), and has a small stiffness where an element has none. solve_coupled adds the remaining part. HOLDS:
   !! no element slips.
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
      attempt%coupled = any(abs(rest(:2, 3, :)) > 0.0_wp) .and. all(abs(attempt%move) <= 0.0_wp)
      associate (failure => attempt%trouble)
         if (attempt%coupled) then
            direction = residual
            call solve_coupled(model, matrix, rest, attempt%where, attempt%tolerance, system, direction, failure)
            tangent = matrix + rest
         else
            call form_structure_stiffness(model, matrix, attempt%where, system, failure, one_solution=.true.)
            call solve_equations(model, system, residual, direction, failure, moved=attempt%move, digits=digits)
            tangent = matrix
         end if
      end associate
   end subroutine solve_laws

   !> The DIRECTION that balances another RESIDUAL with the tangents of the last direction.
   subroutine find_again(model, residual, system, attempt, direction)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: residual(:, :)
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      real(wp), intent(inout)               :: direction(:, :)

      if (attempt%coupled) then
         direction = residual
         call solve_coupled_again(model, attempt%tolerance, system, direction, attempt%trouble)
      else
         direction = 0.0_wp
         call solve_equations(model, system, residual, direction, attempt%trouble, &
                              digits=min(digits, ceiling(-log10(attempt%tolerance))))
      end if
   end subroutine find_again

   !> Check bodies that moved supports have lifted off, by opening joints entirely, from the branches BEFORE: such a body must
   !! be held without these joints. The small stiffness of open elements in find_direction hides a loose body.
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

   !> The first joint whose elements are all open or slip in STATES, 0 for none.
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
