!> The straight laws from which METHOD = NEWTON takes its tangents, one for each interface element, and the search direction under
!! these laws.
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
   use analysis_state, only: analysis_type, free_norm
   use coupled_equations, only: solve_coupled
   use equations, only: equation_system, form_structure_stiffness, solve_equations
   use held_parts, only: find_held_parts, is_needed
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: element_state, force_of, friction_limit, is_apart, joint_law, stiffness_at_rest
   use kinds, only: wp
   use model_data, only: model_type
   use newton_trial, only: attempt_type, follow_law, given_law, trial_type
   use normal_curve, only: loading_deflection, loading_pressure, normal_law, normal_tangent
   use normal_stiffness, only: branch_load, branch_open, follow_normal, normal_state
   use shear_path, only: follow_shear
   use shear_stiffness, only: shear_state
   use tolerances, only: least_rho, on_the_graph, pressure_floor, rounding_of_deflections, rounding_of_entries, stand_in_stiffness
   implicit none
   private

   public :: first_laws, laws_at, next_laws, choose_sides, forces_at, residual_of, find_direction, loose_joints, point_of_rest

   integer, parameter  :: most_steps = 40
   real(wp), parameter :: right = 0.1_wp    !! of it: error up to which a straight law has crossed no kink
   real(wp), parameter :: farthest = 1.0e30_wp  !! point of rest from the origin and the movement: powers of it are finite [length]
   real(wp), parameter :: most  = 3.0_wp    !! times the residual: limit of the force of a movement
   integer, parameter, public :: direction_digits = 6 !! the next iteration corrects the direction

   !> The straight law of an interface element, in its axes: f = force + tangent (m - point).
   type, public :: straight_law
      real(wp) :: point(3) = 0.0_wp       !! movement of end 1 against end 2 [length]
      real(wp) :: force(3) = 0.0_wp       !! there [force]
      real(wp) :: tangent(3, 3) = 0.0_wp  !! [force/length]
      type(element_state) :: state        !! there
      real(wp) :: shift(3) = 0.0_wp       !! from the last movement to the point [length]
      real(wp) :: rho = 1.0_wp            !! relative to the initial rho
      real(wp) :: elastic(3) = 0.0_wp     !! k_sx, k_sy, k_n of the first increment [force/length]
   end type straight_law

contains

   !> The tangents of the laws at the movements of NOW.
   subroutine laws_at(model, system, now, laws)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(in)    :: system
      type(trial_type), intent(in)          :: now
      type(straight_law), allocatable, intent(out) :: laws(:)
      integer :: i

      allocate (laws(size(now%states)))
      do i = 1, size(laws)
         associate (element => model%joints%element(i), state => now%states(i))
            laws(i)%point = joint_movement(system%interface(i), now%u)
            laws(i)%force = force_of(element%area, state)
            laws(i)%tangent = now%tangent(:, :, i)
            laws(i)%state = state
            laws(i)%elastic = stiffness_at_rest(model%joints%list(element%joint)%law, element%area, state%normal%p_av)
         end associate
      end do
   end subroutine laws_at

   !> Change the LAWS at NOW, the committed state, to those of the first iteration. The direction of movement of an element is not
   !! yet known. An element on its first loading has the secants of Eq. (9). ELASTIC: an element that was pressed before has the
   !! stiffer side of its kink, that of unloading, like the elastic predictor of plasticity. The elements of a joint without
   !! pressure and with gaps are taken as closed
   !! where nothing else holds one of their bodies along the normal.
   subroutine first_laws(model, now, elastic, laws)
      type(model_type), intent(in)      :: model
      type(trial_type), intent(in)      :: now
      logical, intent(in)               :: elastic
      type(straight_law), intent(inout) :: laws(:)
      integer :: d, i
      logical :: is_first, closes, unloads, rests(model%mesh%dimension, model%freedoms%n_parts + 1)

      rests = find_held_parts(model, now%states)
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i), joint => model%joints%list(model%joints%element(i)%joint), &
                    state => now%states(i)%normal, tangent => laws(i)%tangent, k => laws(i)%elastic)
            is_first = abs(state%lambda_a) <= 0.0_wp .and. abs(element%gap) <= 0.0_wp
            closes = is_apart(now%states(i))
            if (closes) closes = is_needed(model, rests, i) .and. &
                                 all(now%states(joint%first:joint%last)%normal%pressure <= &
                                     pressure_floor*now%states(joint%first:joint%last)%normal%p_av)
            unloads = elastic .and. state%branch /= branch_open
            if (is_first .or. closes) then
               tangent(3, 3) = k(3)
            else if (unloads) then
               tangent(3, 3) = max(tangent(3, 3), joint%law%normal%e_u*element%area)
            else
               cycle
            end if
            if (closes) laws(i)%force(3) = k(3)*(state%lambda - state%lambda_b)
            if (elastic) tangent(:2, 3) = 0.0_wp
            do d = 1, 2
               tangent(d, d) = max(tangent(d, d), k(d))
            end do
         end associate
      end do
   end subroutine first_laws

   !> The straight laws for the next iteration, from the result NOW of the last ones with the residual UNBALANCED [force].
   !! Iterations that cycle get another rho. An element that has slipped in one sense and would slip in the other has jumped over
   !! the movements in which it sticks, and only these hold a body that slides: its law is the tangent of sticking at the start.
   subroutine next_laws(model, system, analysis, now, unbalanced, attempt, laws)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(trial_type), intent(in)       :: now
      real(wp), intent(in)               :: unbalanced
      type(attempt_type), intent(inout)  :: attempt
      type(straight_law), intent(inout)  :: laws(:)
      type(element_state) :: last
      type(joint_law) :: sticking
      real(wp) :: force(3), movement(3), rho(3), shift(3), softer, true_force(3)
      integer  :: i

      associate (n => attempt%iteration)
         if (n > 4) then
            if (now%size > 0.5_wp*minval(attempt%sizes(n - 2:n))) attempt%n_slow = attempt%n_slow + 1
         end if
      end associate
      softer = 1.0_wp
      if (attempt%n_slow > 0) softer = merge(10.0_wp, 0.1_wp, modulo(attempt%n_slow, 2) == 1)
      do i = 1, size(laws)
         associate (straight => laws(i), area => model%joints%element(i)%area, &
            law => model%joints%list(model%joints%element(i)%joint)%law)
            movement = joint_movement(system%interface(i), now%u)
            force = straight%force + matmul(straight%tangent, movement - straight%point)
            true_force = force_of(area, now%states(i))
            shift = 0.0_wp
            if (norm2(true_force - force) > right*norm2(true_force)) then
               rho = straight%rho*softer*straight%elastic
               rho = max(min(rho, most*unbalanced/max(abs(movement - straight%point), tiny(1.0_wp))), tiny(1.0_wp))
               if (allocated(attempt%seen)) then
                  shift = point_of_rest(given_law(law, attempt), area, analysis%states(i), movement, force, rho, &
                                        attempt%seen(i)) - movement
               else
                  shift = point_of_rest(law, area, analysis%states(i), movement, force, rho) - movement
               end if
               if (.not. norm2(shift) < farthest) shift = 0.0_wp ! no point of rest: the law at the movement serves
               if (dot_product(shift, straight%shift) > 0.0_wp) straight%rho = max(0.25_wp*straight%rho, least_rho)
               if (dot_product(shift, straight%shift) < 0.0_wp) straight%rho = min(4.0_wp*straight%rho, 1.0_wp)
               movement = movement + shift
            end if
            last = straight%state
            call follow_law(law, area, attempt, i, analysis%states(i), movement, straight%state, straight%tangent)
            if (last%slips .and. straight%state%slips .and. dot_product(last%shear%tau, straight%state%shear%tau) < 0.0_wp) then
               movement(:2) = analysis%states(i)%shear%delta + analysis%states(i)%origin
               sticking = law
               sticking%has_friction = .false.
               call follow_law(sticking, area, attempt, i, analysis%states(i), movement, straight%state, straight%tangent)
            end if
            straight%point = movement
            straight%shift = shift
            straight%force = force_of(area, straight%state)
         end associate
      end do
   end subroutine next_laws

   !> Give an element on its loading curve that has not moved in the increment, except for rounding, the tangent of unloading. It
   !! is at the kink of its law: without this rule the last digit of its lambda would choose the side, and with it the iterations.
   !! A step with the stiffer side does not overshoot the kink.
   pure subroutine choose_sides(model, laws)
      type(model_type), intent(in)      :: model
      type(straight_law), intent(inout) :: laws(:) !! at a trial, not at the committed state
      real(wp) :: k
      integer  :: i

      do i = 1, size(laws)
         associate (normal => laws(i)%state%normal, tangent => laws(i)%tangent, element => model%joints%element(i))
            if (normal%branch /= branch_load .or. .not. tangent(3, 3) > 0.0_wp) cycle
            if (abs(normal%lambda - normal%lambda_before) > rounding_of_deflections*abs(normal%lambda)) cycle
            k = model%joints%list(element%joint)%law%normal%e_u*element%area
            if (k > tangent(3, 3)) tangent(:, 3) = tangent(:, 3)*(k/tangent(3, 3)) ! column 3 is proportional to dp/dlambda
         end associate
      end do
   end subroutine choose_sides

   !> The forces of the straight LAWS at the movements of NOW, (3, n) [force].
   function forces_at(system, now, laws) result(force)
      class(equation_system), intent(in) :: system
      type(trial_type), intent(in)       :: now
      type(straight_law), intent(in)     :: laws(:)
      real(wp) :: force(3, size(laws))
      integer  :: i

      do i = 1, size(laws)
         force(:, i) = laws(i)%force + matmul(laws(i)%tangent, joint_movement(system%interface(i), now%u) - laws(i)%point)
      end do
   end function forces_at

   !> The residual at NOW under the LOAD with the FORCE of the straight laws in place of the joints' own, on retained nodes [force].
   function residual_of(system, load, now, force) result(residual)
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: load(:, :)
      type(trial_type), intent(in)       :: now
      real(wp), intent(in)               :: force(:, :) !! (3, n) [force]
      real(wp), allocatable :: residual(:, :)
      integer :: i

      residual = load - now%body
      do i = 1, size(force, 2)
         call add_force(system%interface(i), -force(:, i), residual)
      end do
   end function residual_of

   !> The DIRECTION that balances the RESIDUAL of the straight LAWS. The factorised matrix has the symmetric part of the tangents.
   !! This part is shifted where an eigenvalue is negative (a slipping element has one where its two shear laws differ), and has a
   !! small stiffness where an element has none. solve_coupled adds the remaining part: what friction gains with the pressure, and
   !! the antisymmetric part of an element whose stress turns while it slips. An ATTEMPT that creeps resists the movement of elements
   !! that slip or are open. A joint that is open at all nodes holds by a share of its
   !! elastic shear, which falls with the residual: a body that lies with clearance does not leave while others find their seats.
   !! Source: Levenberg-Marquardt method with a parameter that falls with the residual, Yamashita, Fukushima, Computing Suppl. 15
   !! (2001) 239-249.
   subroutine find_direction(model, residual, analysis, system, attempt, laws, direction)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: residual(:, :)
      type(analysis_type), intent(inout)    :: analysis
      class(equation_system), intent(inout) :: system
      type(attempt_type), intent(inout)     :: attempt
      type(straight_law), intent(inout)     :: laws(:) !! their tangents become those of the solved equations
      real(wp), intent(inout)               :: direction(:, :)
      real(wp), allocatable :: matrix(:, :, :), rest(:, :, :)
      real(wp) :: share ! of its elastic shear by which an open joint holds [-]
      real(wp) :: least ! eigenvalue
      integer  :: i, k
      logical  :: apart(size(model%joints%list)), is_coupled

      allocate (matrix(3, 3, size(laws)), rest(3, 3, size(laws)), source=0.0_wp)
      do i = 1, size(apart)
         associate (joint => model%joints%list(i))
            apart(i) = .not. attempt%with_limits .and. &
                       all(laws(joint%first:joint%last)%state%normal%branch == branch_open)
         end associate
      end do
      share = min(1.0_wp, free_norm(residual, analysis%held)/max(attempt%load_size, tiny(1.0_wp)))
      is_coupled = .false.
      do i = 1, size(laws)
         associate (tangent => laws(i)%tangent, elastic => laws(i)%elastic, element => model%joints%element(i))
            analysis%k(:, i) = [tangent(1, 1), tangent(2, 2), tangent(3, 3)]
            if (attempt%creep > 0.0_wp) call resist(attempt%creep*elastic, laws(i))
            matrix(3, 3, i) = max(tangent(3, 3), stand_in_stiffness*elastic(3))
            matrix(:2, :2, i) = 0.5_wp*(tangent(:2, :2) + transpose(tangent(:2, :2)))
            least = 0.5_wp*(matrix(1, 1, i) + matrix(2, 2, i)) - &
                    hypot(0.5_wp*(matrix(1, 1, i) - matrix(2, 2, i)), matrix(1, 2, i))
            do k = 1, 2
               matrix(k, k, i) = matrix(k, k, i) - min(0.0_wp, least) + stand_in_stiffness*elastic(k)
               if (apart(element%joint)) matrix(k, k, i) = max(matrix(k, k, i), share*elastic(k))
            end do
            rest(:2, :, i) = tangent(:2, :) - matrix(:2, :, i)
            is_coupled = is_coupled .or. any(abs(rest(:2, 3, i)) > 0.0_wp) .or. &
                         abs(rest(1, 2, i)) > rounding_of_entries*maxval(abs(tangent(:2, :2)))
         end associate
      end do
      direction = 0.0_wp ! where the equations cannot be solved
      attempt%unborne = 0.0_wp
      attempt%coupled = is_coupled .and. all(abs(attempt%move) <= 0.0_wp)
      if (attempt%coupled) then
         direction = residual
         call solve_coupled(model, matrix, rest, attempt%where, attempt%tolerance, system, direction, attempt%trouble, &
                            attempt%unborne)
      else
         rest = 0.0_wp
         call form_structure_stiffness(model, matrix, attempt%where, system, attempt%trouble, one_solution=.true.)
         call solve_equations(model, system, residual, direction, attempt%trouble, moved=attempt%move, digits=direction_digits)
      end if
      do i = 1, size(laws)
         laws(i)%tangent = matrix(:, :, i) + rest(:, :, i)
      end do
   end subroutine find_direction

   !> Add the stiffness K, by which a step is resisted, to an element that slips or is open. Its next point of rest is sought from the
   !! force with this stiffness, measured from the last point of rest; measured from the last movement, one of five decks that this
   !! way solves took more iterations than it has.
   pure subroutine resist(k, law)
      real(wp), intent(in)              :: k(3) !! along both axes of shear and the normal [force/length]
      type(straight_law), intent(inout) :: law
      integer :: d, n

      n = 0
      if (law%state%slips) n = 2
      if (law%state%normal%branch == branch_open) n = 3
      do d = 1, n
         law%tangent(d, d) = law%tangent(d, d) + k(d)
      end do
   end subroutine resist

   !> Which joints are loose: all their elements are open or slip in STATES.
   pure function loose_joints(model, states) result(loose)
      type(model_type), intent(in)    :: model
      type(element_state), intent(in) :: states(:)
      logical :: loose(size(model%joints%list))
      integer :: j

      do j = 1, size(loose)
         associate (of_joint => states(model%joints%list(j)%first:model%joints%list(j)%last))
            loose(j) = size(of_joint) > 0 .and. all(of_joint%slips .or. of_joint%normal%branch == branch_open)
         end associate
      end do
   end function loose_joints

   !> The movement at which an element would come to rest: that of the point of its graph, from the state BEFORE, on the line of
   !! slope -RHO through MOVEMENT and FORCE of its straight law. The normal direction is independent of the others and comes
   !! first; then, by Newton's method within bounds, each shear direction, whose force increases with the movement. A slipping
   !! element stays at its point if it slips there in the same direction.
   function point_of_rest(law, area, before, movement, force, rho, seen) result(point)
      type(joint_law), intent(in)     :: law
      real(wp), intent(in)            :: area        !! a_i [length^2]
      type(element_state), intent(in) :: before      !! in equilibrium
      real(wp), intent(in)            :: movement(3) !! [length]
      real(wp), intent(in)            :: force(3)    !! [force]
      real(wp), intent(in)            :: rho(3)      !! > 0 [force/length]
      type(normal_state), intent(in), optional :: seen !! as in follow_element
      real(wp) :: point(3)
      type(normal_state) :: normal
      real(wp) :: bounds(2), excess, goal(3), limit, slope, start, t(2), there(2), work
      integer  :: i, step

      goal = force + rho*movement
      point = movement
      point(3) = before%normal%gap + normal_rest(law%normal, area, before%normal, goal(3) - rho(3)*before%normal%gap, rho(3))
      call follow_normal(law%normal, area, before%normal, point(3) - before%normal%gap, normal, slope, work)
      if (present(seen)) normal = seen
      if (normal%branch == branch_open .or. before%normal%branch == branch_open) return
      if (law%iwan%given) return ! its kinks are small
      t = 0.0_wp
      there = 0.0_wp
      do i = 1, 2
         if (.not. law%shear(i)%given) cycle
         start = before%shear(i)%delta + before%origin(i)
         point(i) = start
         call shear_force(i, start, t(i), slope)
         excess = t(i) + rho(i)*start - goal(i)
         bounds = [min(start, start - excess/rho(i)), max(start, start - excess/rho(i))]
         do step = 1, most_steps
            if (abs(excess) <= on_the_graph*(abs(t(i)) + abs(goal(i) - rho(i)*start))) exit
            bounds(merge(2, 1, excess > 0.0_wp)) = point(i)
            point(i) = point(i) - excess/(rho(i) + slope)
            if (point(i) <= bounds(1) .or. point(i) >= bounds(2)) point(i) = 0.5_wp*sum(bounds)
            if (abs(point(i)) > farthest) then ! no point of rest: the caller takes the law at the movement
               point = huge(1.0_wp)
               return
            end if
            call shear_force(i, point(i), t(i), slope)
            excess = t(i) + rho(i)*point(i) - goal(i)
         end do
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
         real(wp) :: by_p

         call follow_shear(law%shear(i), before%shear(i), m - before%origin(i), [before%normal%pressure, normal%pressure], state, &
                           slope, by_p)
         t = area*state%tau
         slope = max(0.0_wp, area*slope)
      end subroutine shear_force

   end function point_of_rest

   !> lambda with a p(lambda) + rho lambda = GOAL on the graph of the exact normal law from the state BEFORE [length]: open, on
   !! the line of slope E_u, or, past point A, on the loading curve, with p between the values for half and for all of the goal.
   pure real(wp) function normal_rest(law, area, before, goal, rho) result(lambda)
      type(normal_law), intent(in)   :: law
      real(wp), intent(in)           :: area   !! a_i [length^2]
      type(normal_state), intent(in) :: before
      real(wp), intent(in)           :: goal   !! [force]
      real(wp), intent(in)           :: rho    !! > 0 [force/length]
      real(wp) :: bounds(2), excess, k_n, p
      integer  :: step

      lambda = goal/rho
      if (lambda <= before%lambda_a - before%p_a/law%e_u) return
      lambda = (goal - area*(before%p_a - law%e_u*before%lambda_a))/(rho + area*law%e_u)
      if (lambda <= before%lambda_a) return
      bounds = min([0.5_wp, 1.0_wp]*goal/area, loading_pressure(law, [0.5_wp, 1.0_wp]*goal/rho))
      p = bounds(2)
      if (p < tiny(p)) then ! the pressure underflows: the law bears nothing at this lambda
         lambda = goal/rho
         return
      end if
      do step = 1, most_steps
         lambda = loading_deflection(law, p)
         excess = area*p + rho*lambda - goal
         if (abs(excess) <= on_the_graph*goal) return
         bounds(merge(2, 1, excess > 0.0_wp)) = p
         k_n = normal_tangent(law, area, p, p_av=p) ! may underflow
         p = p - excess*k_n/(area*(k_n + rho))
         if (p <= bounds(1) .or. p >= bounds(2)) p = 0.5_wp*sum(bounds)
      end do
   end function normal_rest

end module straight_laws
