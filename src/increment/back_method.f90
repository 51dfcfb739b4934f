!> METHOD = BACK, after Back, Burdekin and Cowley: the whole load in one step, with secants of the laws. Loading only. The
!! secants p(lambda) a_i/lambda are taken at the last deflections. The iterations oscillate. The average of two consecutive sets
!! of results damps the oscillation until the results settle.
!!
!!     p |                                 *    On the law (*) the load stands at o. The secant 0-1 of a deflection beyond it bears the
!!       |                              1       load at 2, the secant of the deflection 2 bears it at 1 again: so for m = 1/2, on and
!!   p_F |- - - - - - - - 2 - - - - o           on; with a smaller m ever farther off, until that of the least p bounds it. The means
!!       |                      *               of both come near o, and settle for m above 1/4.
!!       |                *
!!     0 *---*----*------------------ lambda
module back_method
   use analysis_state, only: analysis_type, find_unbalanced, force_noise, no_stiffness, iteration_record, reach, record_iteration, &
                             secant_stiffness, tally_work
   use equations, only: equation_system, forces_in_bodies, form_structure_stiffness, solve_equations
   use equation_solver, only: failure_type
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: back_stiffness, exceeds_limit, loading_work, rest_margin
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_curve, only: loading_deflection, loading_pressure, normal_tangent, pressure_floor
   use normal_stiffness, only: branch_load, branch_open, has_come_to
   use numbers, only: first_largest
   use shear_stiffness, only: stand_at_limit
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: back_increment

   integer, parameter  :: most_averages = 1000 ! iterations with averaging
   integer, parameter  :: most_shown = 24      ! iterations without averaging: as many as the listing shows
   real(wp), parameter :: rounding = 1.0e-12_wp ! of the deflections; TOL is at least the resulting change of pressure

   !> The n interface elements in one iteration.
   type :: iterate_type
      real(wp), allocatable :: taken(:, :)        ! (3, n) deflections of the secants: x, y, lambda
      real(wp), allocatable :: deflection(:, :)   ! (3, n) resulting deflections
      real(wp), allocatable :: change(:)          ! (n) largest change of a stress of the laws between both [pressure]
      real(wp), allocatable :: k_int(:, :, :)     ! (3, 3, n) stiffness, in joint axes
      real(wp) :: largest_p = 0.0_wp              ! of the laws at the resulting deflections [pressure]
   end type iterate_type

contains

   !> Apply the whole load: secants and solution in turn until they agree. With AVERAGE = NO agreement is not required: the last
   !! iteration that the listing shows is the result.
   subroutine back_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(iterate_type) :: now
      real(wp), allocatable :: u(:, :), body(:, :), load(:, :)
      real(wp) :: k(3)
      integer  :: d, i, iteration, n, worst

      n = size(model%interface)
      allocate (now%taken(3, n), now%deflection(3, n), now%change(n), now%k_int(3, 3, n), source=0.0_wp)
      now%taken(3, :) = loading_deflection(model%joints(model%interface%joint)%law%normal, analysis%states%normal%p_av)
      do iteration = 1, merge(most_averages, most_shown, analysis%average)
         load = analysis%now%condensed_load
         do i = 1, n
            associate (element => system%interface(i), law => model%joints(model%interface(i)%joint)%law)
               k = back_stiffness(law, element%area, analysis%states(i)%normal%p_av, now%taken(:, i))
               do d = 1, 3
                  now%k_int(d, d, i) = k(d)
               end do
               ! the secant starts where the gap g is closed: k_n (closing - g)
               if (abs(element%gap) > 0.0_wp) call add_force(element, [0.0_wp, 0.0_wp, k(3)*element%gap], load)
            end associate
         end do
         call form_structure_stiffness(model, now%k_int, where_in_plan(plan, analysis%stage, analysis%increment), system, &
                                       failure, one_solution=.true.)
         call solve_equations(model, system, load, analysis%u, failure, &
                              moved=merge(analysis%now%moved(:, system%retained), 0.0_wp, analysis%moves))
         if (failure%raised) return
         if (n == 0) exit
         call read_off(model, system, analysis, now)
         call record_iteration(analysis, iteration_record(before=now%largest_p, after=maxval(now%change), &
                                                step=maxval(now%deflection(3, :)), part=-1))
         if (analysis%record%is_settled) exit
         now%taken = merge(0.5_wp*(now%taken + now%deflection), now%deflection, analysis%average)
      end do
      if (analysis%average .and. .not. analysis%record%is_settled) then
         worst = first_largest(now%change)
         call failure%raise(where_in_plan(plan, analysis%stage, analysis%increment)//': the pressures have not converged after '// &
            integer_text(analysis%record%n_iterations)//' iterations; that of node '// &
            integer_text(joint_node_id(model, worst, 1))// &
            ' still changes by '//real_text(now%change(worst))//'; use METHOD = NEWTON')
         return
      end if
      call store(model, now, analysis)
      allocate (u, body, source=analysis%u)
      call forces_in_bodies(system, u, body)
      call reach(system, u, body, analysis)
      call find_unbalanced(system, analysis)
   end subroutine back_increment

   !> Read from the solution the deflections and the difference of the stresses of the laws there from those at the last secants.
   !! The secants have settled where this is within TOL of the largest pressure, or within the rounding of the deflections times
   !! the slope of the law.
   subroutine read_off(model, system, analysis, now)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(iterate_type), intent(inout)  :: now
      real(wp) :: k(3), left(size(model%interface)), p(2)
      integer  :: i

      now%largest_p = 0.0_wp
      do i = 1, size(model%interface)
         associate (element => model%interface(i), deflection => now%deflection(:, i), &
                    law => model%joints(model%interface(i)%joint)%law)
            deflection = joint_movement(system%interface(i), analysis%u) - [0.0_wp, 0.0_wp, element%gap]
            p = loading_pressure(law%normal, max(0.0_wp, [now%taken(3, i), deflection(3)]))
            k = back_stiffness(law, element%area, analysis%states(i)%normal%p_av, deflection)
            k(:2) = abs((k(:2) - [now%k_int(1, 1, i), now%k_int(2, 2, i)])*deflection(:2))/element%area
            now%change(i) = max(abs(p(2) - p(1)), k(1), k(2))
            now%largest_p = max(now%largest_p, p(2))
         end associate
      end do
      associate (p => max(now%largest_p, pressure_floor*maxval(analysis%states%normal%p_av)))
         do i = 1, size(left)
            associate (law => model%joints(model%interface(i)%joint)%law%normal)
               left(i) = max(analysis%load_tolerance*p, rounding*loading_deflection(law, p)* &
                             normal_tangent(law, 1.0_wp, p, analysis%states(i)%normal%p_av))
            end associate
         end do
      end associate
      left = max(left, 0.1_wp*force_noise(system, analysis%u)/model%interface%area)
      analysis%record%is_settled = all(now%change <= left)
   end subroutine read_off

   !> Store the states of the elements from the last solution.
   subroutine store(model, now, analysis)
      type(model_type), intent(in)       :: model
      type(iterate_type), intent(in)     :: now
      type(analysis_type), intent(inout) :: analysis
      real(wp) :: largest
      integer  :: i

      largest = 0.0_wp
      if (size(model%interface) > 0) largest = maxval(abs(now%deflection(3, :)))
      do i = 1, size(model%interface)
         associate (state => analysis%states(i), element => model%interface(i), deflection => now%deflection(:, i), &
                    law => model%joints(model%interface(i)%joint)%law)
            state%normal%branch = merge(branch_load, branch_open, has_come_to(0.0_wp, deflection(3), largest))
            state%normal%lambda = deflection(3)
            state%normal%k_n = now%k_int(3, 3, i)
            analysis%record%kind(i) = merge(secant_stiffness, no_stiffness, state%normal%k_n > 0.0_wp)
            state%normal%sumf = max(0.0_wp, now%k_int(3, 3, i)*deflection(3))
            state%normal%pressure = state%normal%sumf/element%area
            state%shear%sense = sign(1.0_wp, deflection(:2))
            state%shear%delta = deflection(:2)
            state%shear%k_s = [now%k_int(1, 1, i), now%k_int(2, 2, i)]
            state%shear%tau = state%shear%k_s*deflection(:2)/element%area
            state%slips = exceeds_limit(law, state, rest_margin)
            if (state%slips) then
               call stand_at_limit(law%shear, max(0.0_wp, state%normal%pressure), state%shear)
               state%shear%slid = state%shear%delta_0
            end if
            call tally_work(analysis%energy(element%joint), loading_work(law, element%area, state))
         end associate
      end do
   end subroutine store

end module back_method
