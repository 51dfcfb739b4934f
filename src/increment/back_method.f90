!> METHOD = BACK, after Back, Burdekin and Cowley: the whole load at once with secant stiffnesses at the last pressures, two
!! consecutive pressures averaged, until they settle. Loading only.
module back_method
   use analysis_state, only: analysis_type, find_movements, find_unbalanced, record_pass, pass_record, tally_work
   use equations, only: equation_system, forces_in_bodies, form_structure_stiffness, solve_equations
   use failures, only: failure_type
   use interface_operator, only: joint_movement
   use joint_laws, only: element_state, joint_law
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_stiffness, only: branch_load, branch_open, pressure_floor
   use shear_stiffness, only: shear_law
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: back_increment

   integer, parameter  :: most_iterations = 1000
   real(wp), parameter :: settled = 1.0e-11_wp !! of the largest pressure: change from one iteration to the next

contains

   !> The whole load in one go: secant k_n = p**(1-m) a/c, and P(d)/d a for shear, not above mu p/|delta| a.
   subroutine back_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      real(wp), allocatable :: p(:), p_new(:), k_shear(:, :), movement(:, :), k_int(:, :, :)
      real(wp) :: change
      integer  :: i, iteration, k, n, worst

      n = size(model%interface)
      allocate (p(n), p_new(n), k_shear(2, n), movement(3, n), k_int(3, 3, n), source=0.0_wp)
      do i = 1, n
         p(i) = model%joints(model%interface(i)%joint)%law%normal%p_av
      end do
      do iteration = 1, most_iterations
         do i = 1, n
            call secants(i)
         end do
         call form_structure_stiffness(model, k_int, where_in_plan(plan, analysis%stage, analysis%increment), system, failure, &
                                       one_solution=.true.)
         call solve_equations(model, system, analysis%felt, analysis%u, failure, &
                              moved=merge(analysis%moved(:, system%retained), 0.0_wp, analysis%moves))
         if (failure%raised) return
         do i = 1, n
            movement(:, i) = joint_movement(system%interface(i), analysis%u)
            p_new(i) = max(0.0_wp, k_int(3, 3, i)*movement(3, i)/model%interface(i)%area)
         end do
         if (n == 0) exit
         change = maxval(abs(p_new - p))
         do i = 1, n ! the shear secants must be those of the deflections that they led to
            k_shear(:, i) = shear_secants(i)
            do k = 1, 2
               change = max(change, abs((k_shear(k, i) - k_int(k, k, i))*movement(k, i))/model%interface(i)%area)
            end do
         end do
         call record_pass(analysis, pass_record(before=maxval(abs(p)), after=change, part=-1))
         if (change <= settled*max(maxval(p), pressure_floor*maxval(model%joints%law%normal%p_av))) exit
         p = 0.5_wp*(p + p_new)
      end do
      if (iteration > most_iterations) then
         worst = maxloc(abs(p_new - p), dim=1)
         call failure%raise(where_in_plan(plan, analysis%stage, analysis%increment)//': the pressures have not settled after '// &
            integer_text(most_iterations)//' iterations; the one of node '// &
            integer_text(joint_node_id(model, worst, 1))//' still changes by '//real_text(change))
         return
      end if
      call store()

   contains

      !> Normal secant at the pressure, shear secants halfway between the last two.
      subroutine secants(j)
         integer, intent(in) :: j
         real(wp) :: k_x, k_y

         associate (law => model%joints(model%interface(j)%joint)%law%normal, area => model%interface(j)%area)
            k_x = k_int(1, 1, j)
            k_y = k_int(2, 2, j)
            k_int(:, :, j) = 0.0_wp
            if (p(j) < pressure_floor*law%p_av .and. movement(3, j) < 0.0_wp) return ! open
            k_int(3, 3, j) = max(p(j), pressure_floor*law%p_av)**(1.0_wp - law%m)*area/law%c
            if (iteration == 1) k_shear(:, j) = shear_secants(j)
            k_int(1, 1, j) = k_shear(1, j)
            k_int(2, 2, j) = k_shear(2, j)
            if (iteration < 3) return
            k_int(1, 1, j) = 0.5_wp*(k_shear(1, j) + k_x)
            k_int(2, 2, j) = 0.5_wp*(k_shear(2, j) + k_y)
         end associate
      end subroutine secants

      !> P(d)/d a in both directions, at the movement and pressure of element J, and not above mu p a/|delta|.
      function shear_secants(j) result(secant)
         integer, intent(in) :: j
         real(wp) :: secant(2), moved
         integer  :: direction

         associate (law => model%joints(model%interface(j)%joint)%law, area => model%interface(j)%area)
            secant = 0.0_wp
            do direction = 1, 2
               if (law%shear(direction)%given) secant(direction) = area*shear_secant(law%shear(direction), &
                                                                  movement(direction, j), max(p(j), 0.0_wp))
            end do
            moved = norm2(movement(:2, j))
            if (law%has_friction .and. moved > 0.0_wp) secant = min(secant, law%mu*max(p(j), 0.0_wp)*area/moved)
         end associate
      end function shear_secants

      subroutine store()

         do i = 1, n
            associate (state => analysis%states(i), element => model%interface(i))
               state%normal%branch = merge(branch_load, branch_open, movement(3, i) > 0.0_wp)
               state%normal%lambda = movement(3, i)
               state%normal%k_n = k_int(3, 3, i)
               state%normal%sumf = max(0.0_wp, k_int(3, 3, i)*movement(3, i))
               state%normal%pressure = state%normal%sumf/element%area
               do k = 1, 2
                  state%shear(k)%sense = sign(1.0_wp, movement(k, i))
                  state%shear(k)%delta = movement(k, i)
                  state%shear(k)%k_s = k_int(k, k, i)
                  state%shear(k)%tau = k_int(k, k, i)*movement(k, i)/element%area
               end do
               associate (law => model%joints(element%joint)%law)
                  state%slips = law%has_friction .and. any(law%shear%given) .and. &
                                norm2(state%shear%tau) >= (1.0_wp - 1.0e-6_wp)*law%mu*state%normal%pressure .and. &
                                norm2(state%shear%tau) > 0.0_wp
                  call tally_work(analysis%energy(element%joint), [element%area*sum(shear_work(law, state)), &
                     element%area*state%normal%pressure*state%normal%lambda/(1.0_wp + 1.0_wp/law%normal%m)])
               end associate
            end associate
         end do
         call forces_in_bodies(system, analysis%u, analysis%body)
         call find_movements(system, analysis)
         call find_unbalanced(system, analysis)
      end subroutine store

   end subroutine back_increment


   !> Work of the shear stresses on the way to where they are, in both directions: along the loading curve, and where the limit
   !! was reached along the limit from the deflection on at which the initial slope reaches it [pressure x length].
   pure function shear_work(law, state) result(work)
      type(joint_law), intent(in)     :: law
      type(element_state), intent(in) :: state
      real(wp) :: work(2), a(3), d, tau, slope
      integer  :: k

      work = 0.0_wp
      do k = 1, 2
         if (.not. law%shear(k)%given) cycle
         d = abs(state%shear(k)%delta)
         tau = abs(state%shear(k)%tau)
         a = law%shear(k)%coefficients(1, :, branch_load) + law%shear(k)%coefficients(2, :, branch_load)*state%normal%pressure
         work(k) = d**2*(a(1)/2.0_wp + d*(a(2)/3.0_wp + d*a(3)/4.0_wp))
         slope = shear_secant(law%shear(k), 0.0_wp, state%normal%pressure)
         if (state%slips .and. slope > 0.0_wp) work(k) = tau*(d - 0.5_wp*tau/slope)
      end do
   end function shear_work


   !> P(d)/d of the loading curve at |DELTA| under the pressure P; its first slope at rest [pressure/length].
   pure real(wp) function shear_secant(law, delta, p) result(secant)
      type(shear_law), intent(in) :: law
      real(wp), intent(in)        :: delta, p
      real(wp) :: a(3), d

      d = abs(delta)
      a = law%coefficients(1, :, branch_load) + law%coefficients(2, :, branch_load)*p
      secant = max(0.0_wp, a(1) + d*(a(2) + d*a(3)))
   end function shear_secant

end module back_method
