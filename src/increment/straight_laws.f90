!> The straight laws from which METHOD = NEWTON takes its tangents, one for each interface element.
!! An iteration replaces the law of every interface element by a straight line through a point of its graph, and solves the
!! structure with these lines. The solution gives a movement m. A kink of the graph may lie between the last point and m, and
!! the force beyond it may be a thousand times that of the straight line. The next point is therefore not the point of the graph
!! at m. It is the point at which the element would come to rest if the surrounding structure had the stiffness rho: the
!! intersection of the graph and the line f + rho m = constant through (m, f) of the straight law. A large rho gives the point
!! of equal movement, a small rho the point of equal force. A kink is not overshot from either side. If an element comes to rest
!! on the same side of the movement twice in succession, its rho is too large: rho is reduced until the element turns back. The
!! answer does not depend on rho. Source: resolvent of a monotone graph (Rockafellar, SIAM J. Control Optim. 14 (1976) 877-898),
!! used on rigid joints by Alart, Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353-375.
module straight_laws
   use analysis_state, only: analysis_type
   use equation_solver, only: equation_system
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: element_state, follow_element, friction_limit, is_apart, joint_law, rest_stiffness => stiffness_at_rest
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: trial_type
   use normal_curve, only: loading_deflection, loading_pressure, normal_law, normal_tangent, pressure_floor
   use normal_stiffness, only: branch_open, follow_normal, normal_state
   use shear_path, only: follow_shear
   use shear_stiffness, only: shear_state
   implicit none
   private

   public :: first_laws, laws_at, next_laws, residual_of, stiffness_at_rest, point_of_rest

   integer, parameter  :: most_steps = 40
   real(wp), parameter :: near  = 1.0e-6_wp !! of the force: a point on the graph
   real(wp), parameter :: right = 0.1_wp    !! of it: error up to which a straight law has crossed no kink
   real(wp), parameter :: least_rho = 1.0e-3_wp !! relative to the initial rho
   real(wp), parameter :: farthest = 1.0e30_wp  !! point of rest from the movement: powers of it are finite [length]
   real(wp), parameter :: most  = 3.0_wp    !! times the residual: limit of the force of a movement

   !> The straight laws of all interface elements, in their axes: f = force + tangent (m - point).
   type, public :: straight_laws_type
      real(wp), allocatable :: point(:, :)          !! (3, n) movement of end 1 against end 2 [length]
      real(wp), allocatable :: force(:, :)          !! (3, n) there [force]
      real(wp), allocatable :: tangent(:, :, :)     !! (3, 3, n) [force/length]
      type(element_state), allocatable :: states(:) !! (n) there
      real(wp), allocatable :: shift(:, :)          !! (3, n) from the last movement to the point [length]
      real(wp), allocatable :: rho(:)               !! (n) relative to the initial rho
   end type straight_laws_type

contains

   !> The straight laws for the first iteration from NOW, the committed state. The direction of movement of an element is not
   !! yet known. An element on its first loading has the secants of Eq. (9). ELASTIC: an element that was pressed before has the
   !! stiffer side of its kink, that of unloading, like the elastic predictor of plasticity. The elements of a joint without
   !! pressure and with gaps are taken as closed.
   subroutine first_laws(model, system, analysis, now, elastic, laws)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(in)    :: system
      type(analysis_type), intent(in)       :: analysis
      type(trial_type), intent(in)          :: now
      logical, intent(in)                   :: elastic
      type(straight_laws_type), intent(out) :: laws
      real(wp) :: k(3)
      integer  :: d, i
      logical  :: is_first, closes

      call laws_at(model, system, now, laws)
      do i = 1, size(model%interface)
         associate (element => model%interface(i), state => now%states(i)%normal)
            k = stiffness_at_rest(model, analysis, i)
            is_first = abs(state%lambda_a) <= 0.0_wp .and. abs(element%gap) <= 0.0_wp
            closes = is_apart(now%states(i)) .and. bears_nothing(model, now%states, element%joint)
            if (is_first .or. closes) then
               laws%tangent(3, 3, i) = k(3)
            else if (elastic .and. state%branch /= branch_open) then
               laws%tangent(3, 3, i) = max(laws%tangent(3, 3, i), model%joints(element%joint)%law%normal%e_u*element%area)
            end if
            if (closes) laws%force(3, i) = k(3)*(state%lambda - state%lambda_b)
            if (.not. (is_first .or. closes .or. (elastic .and. state%branch /= branch_open))) cycle
            if (elastic) laws%tangent(:2, 3, i) = 0.0_wp
            do d = 1, 2
               laws%tangent(d, d, i) = max(laws%tangent(d, d, i), k(d))
            end do
         end associate
      end do
   end subroutine first_laws

   !> The tangents of the laws at the movements of NOW.
   subroutine laws_at(model, system, now, laws)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(in)    :: system
      type(trial_type), intent(in)          :: now
      type(straight_laws_type), intent(out) :: laws
      integer :: i

      allocate (laws%point(3, size(now%states)), laws%force(3, size(now%states)))
      allocate (laws%shift(3, size(now%states)), source=0.0_wp)
      allocate (laws%rho(size(now%states)), source=1.0_wp)
      laws%tangent = now%tangent
      laws%states = now%states
      do i = 1, size(now%states)
         laws%point(:, i) = joint_movement(system%interface(i), now%u)
         laws%force(:, i) = force_of(model%interface(i)%area, now%states(i))
      end do
   end subroutine laws_at

   !> The straight laws for the next iteration, from the result NOW of the last ones with the residual UNBALANCED [force].
   !! SOFTER: rho relative to the first stiffness of an element; FLIPS: elements that have begun or stopped slipping.
   subroutine next_laws(model, system, analysis, now, unbalanced, softer, laws, flips)
      type(model_type), intent(in)            :: model
      class(equation_system), intent(in)      :: system
      type(analysis_type), intent(in)         :: analysis
      type(trial_type), intent(in)            :: now
      real(wp), intent(in)                    :: unbalanced
      real(wp), intent(in)                    :: softer
      type(straight_laws_type), intent(inout) :: laws
      integer, intent(out)                    :: flips
      real(wp) :: force(3), movement(3), rho(3), shift(3), true_force(3), work(3)
      integer  :: i
      logical  :: slipped

      flips = 0
      do i = 1, size(model%interface)
         associate (element => model%interface(i), law => model%joints(model%interface(i)%joint)%law)
            movement = joint_movement(system%interface(i), now%u)
            force = laws%force(:, i) + matmul(laws%tangent(:, :, i), movement - laws%point(:, i))
            true_force = force_of(element%area, now%states(i))
            if (norm2(true_force - force) > right*norm2(true_force)) then
               rho = laws%rho(i)*softer*stiffness_at_rest(model, analysis, i)
               rho = max(min(rho, most*unbalanced/max(abs(movement - laws%point(:, i)), tiny(1.0_wp))), tiny(1.0_wp))
               shift = point_of_rest(law, element%area, analysis%states(i), movement, force, rho) - movement
               if (.not. norm2(shift) < farthest) shift = 0.0_wp ! no point of rest: the law at the movement serves
               if (dot_product(shift, laws%shift(:, i)) > 0.0_wp) laws%rho(i) = max(0.25_wp*laws%rho(i), least_rho)
               if (dot_product(shift, laws%shift(:, i)) < 0.0_wp) laws%rho(i) = min(4.0_wp*laws%rho(i), 1.0_wp)
               movement = movement + shift
               laws%shift(:, i) = shift
            else
               laws%shift(:, i) = 0.0_wp
            end if
            slipped = laws%states(i)%slips
            call follow_element(law, element%area, analysis%states(i), movement, laws%states(i), laws%tangent(:, :, i), work)
            laws%point(:, i) = movement
            laws%force(:, i) = force_of(element%area, laws%states(i))
            if (slipped .neqv. laws%states(i)%slips) flips = flips + 1
         end associate
      end do
   end subroutine next_laws

   !> The residual at NOW under the LOAD with the straight LAWS in place of the joints' own, on retained nodes [force].
   function residual_of(system, load, now, laws) result(residual)
      class(equation_system), intent(in)   :: system
      real(wp), intent(in)                 :: load(:, :)
      type(trial_type), intent(in)         :: now
      type(straight_laws_type), intent(in) :: laws
      real(wp), allocatable :: residual(:, :)
      integer :: i

      residual = load - now%body
      do i = 1, size(laws%states)
         associate (element => system%interface(i))
            call add_force(element, -laws%force(:, i) - matmul(laws%tangent(:, :, i), joint_movement(element, now%u) - &
                                                               laws%point(:, i)), residual)
         end associate
      end do
   end function residual_of

   !> Whether JOINT carries no pressure.
   pure logical function bears_nothing(model, states, joint)
      type(model_type), intent(in)    :: model
      type(element_state), intent(in) :: states(:)
      integer, intent(in)             :: joint

      associate (normal => states(model%joints(joint)%first:model%joints(joint)%last)%normal)
         bears_nothing = all(normal%pressure <= pressure_floor*normal%p_av)
      end associate
   end function bears_nothing

   !> The force of an element in this STATE, in its axes [force].
   pure function force_of(area, state) result(force)
      real(wp), intent(in)            :: area
      type(element_state), intent(in) :: state
      real(wp) :: force(3)

      force = [state%shear%tau*area, state%normal%sumf]
   end function force_of

   !> (k_sx, k_sy, k_n) of interface element I in its first increment [force/length].
   pure function stiffness_at_rest(model, analysis, i) result(k)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i
      real(wp) :: k(3)

      k = rest_stiffness(model%joints(model%interface(i)%joint)%law, model%interface(i)%area, analysis%states(i)%normal%p_av)
   end function stiffness_at_rest

   !> The movement at which an element would come to rest: that of the point of its graph, from the state BEFORE, on the line of
   !! slope -RHO through MOVEMENT and FORCE of its straight law. The normal direction is independent of the others and comes
   !! first. A slipping element stays at its point if it slips there in the same direction.
   function point_of_rest(law, area, before, movement, force, rho) result(point)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area        !! a_i [length^2]
      type(element_state), intent(in) :: before      !! in equilibrium
      real(wp), intent(in)            :: movement(3) !! [length]
      real(wp), intent(in)            :: force(3)    !! [force]
      real(wp), intent(in)            :: rho(3)      !! > 0 [force/length]
      real(wp) :: point(3)
      type(normal_state) :: normal
      real(wp) :: goal(3), limit, slope, t(2), there(2), work
      integer  :: i

      goal = force + rho*movement
      point = movement
      point(3) = before%normal%gap + normal_rest(law%normal, area, before%normal, goal(3) - rho(3)*before%normal%gap, rho(3))
      call follow_normal(law%normal, area, before%normal, point(3) - before%normal%gap, normal, slope, work)
      if (normal%branch == branch_open .or. is_apart(before)) return
      t = 0.0_wp
      there = 0.0_wp
      do i = 1, 2
         if (.not. law%shear(i)%given) cycle
         call find_shear_rest(i)
         call shear_force(i, movement(i), there(i), slope)
      end do
      limit = area*friction_limit(law, normal%pressure)
      if (.not. law%has_friction .or. norm2(t) <= limit) return
      point(:2) = (goal(:2) - t/norm2(t)*limit)/rho(:2)
      if (norm2(there) > limit .and. dot_product(t, there) > 0.9_wp*norm2(t)*norm2(there)) point(:2) = movement(:2)

   contains

      !> T of the shear law in direction I at the movement M under the pressure found, without friction [force], and its SLOPE.
      pure subroutine shear_force(i, m, t, slope)
         integer, intent(in)   :: i
         real(wp), intent(in)  :: m
         real(wp), intent(out) :: t, slope
         type(shear_state) :: state
         real(wp) :: by_p, work

         call follow_shear(law%shear(i), before%shear(i), m - before%origin(i), [before%normal%pressure, normal%pressure], state, &
                           slope, by_p, work)
         t = area*state%tau
         slope = max(0.0_wp, area*slope)
      end subroutine shear_force

      !> POINT and T in direction I by Newton's method within bounds, from the state before; t increases with the movement.
      subroutine find_shear_rest(i)
         integer, intent(in) :: i
         real(wp) :: bounds(2), excess, slope, start
         integer  :: step

         start = before%shear(i)%delta + before%origin(i)
         point(i) = start
         call shear_force(i, start, t(i), slope)
         excess = t(i) + rho(i)*start - goal(i)
         bounds = [min(start, start - excess/rho(i)), max(start, start - excess/rho(i))]
         do step = 1, most_steps
            if (abs(excess) <= near*(abs(t(i)) + abs(goal(i) - rho(i)*start))) exit
            bounds(merge(2, 1, excess > 0.0_wp)) = point(i)
            point(i) = point(i) - excess/(rho(i) + slope)
            if (point(i) <= bounds(1) .or. point(i) >= bounds(2)) point(i) = 0.5_wp*sum(bounds)
            call shear_force(i, point(i), t(i), slope)
            excess = t(i) + rho(i)*point(i) - goal(i)
         end do
      end subroutine find_shear_rest

   end function point_of_rest

   !> lambda with a p(lambda) + rho lambda = GOAL on the graph of the exact normal law from the state BEFORE [length]: open, on
   !! the line of slope E_u, or, past point A, on the loading curve, with p between the values for half and for all of the goal.
   pure real(wp) function normal_rest(law, area, before, goal, rho) result(lambda)
      type(normal_law), intent(in)   :: law
      real(wp), intent(in)           :: area   !! a_i [length^2]
      type(normal_state), intent(in) :: before
      real(wp), intent(in)           :: goal   !! [force]
      real(wp), intent(in)           :: rho    !! > 0 [force/length]
      real(wp) :: bounds(2), excess, p
      integer  :: step

      lambda = goal/rho
      if (lambda <= before%lambda_a - before%p_a/law%e_u) return
      lambda = (goal - area*(before%p_a - law%e_u*before%lambda_a))/(rho + area*law%e_u)
      if (lambda <= before%lambda_a) return
      bounds = min([0.5_wp, 1.0_wp]*goal/area, loading_pressure(law, [0.5_wp, 1.0_wp]*goal/rho))
      p = bounds(2)
      if (p <= 0.0_wp) then ! the pressure underflows: the law bears nothing at this lambda
         lambda = goal/rho
         return
      end if
      do step = 1, most_steps
         lambda = loading_deflection(law, p)
         excess = area*p + rho*lambda - goal
         if (abs(excess) <= near*goal) return
         bounds(merge(2, 1, excess > 0.0_wp)) = p
         p = p - excess/(area + rho*area/normal_tangent(law, area, p, p_av=p))
         if (p <= bounds(1) .or. p >= bounds(2)) p = 0.5_wp*sum(bounds)
      end do
   end function normal_rest

end module straight_laws
