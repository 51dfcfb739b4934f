!> METHOD = BACK, after Back, Burdekin and Cowley: the whole load in one step, with secants of the laws. Loading only. The
!! secants p(lambda) a_i/lambda are taken at the last deflections. The iterations oscillate. The average of two consecutive sets
!! of results damps the oscillation until the results settle.
!!
!!     p |                                 * On the law (*) the load stands at o. The secant 0-1 of a deflection beyond it bears the
!!       |                              1    load at 2, the secant of the deflection 2 bears it at 1 again: so for m = 1/2, on and
!!   p_F |- - - - - - - - 2 - - - - o        on; with a smaller m ever farther off, until that of the least p bounds it. The means
!!       |                      *            of both come near o, and settle for m above 1/4.
!!       |                *
!!     0 *---*----*------------------ lambda
module back_method
   use analysis_state, only: analysis_type, find_movements, find_unbalanced, force_noise, no_stiffness, iteration_record, &
                             record_iteration, secant_stiffness
   use equations, only: equation_system, forces_in_bodies, form_structure_stiffness, solve_equations
   use equation_solver, only: failure_type
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: back_stiffness, exceeds_limit, limit_cuts, slices_to, stiffness_matrices
   use joint_work, only: work_of_secants
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_curve, only: loading_deflection, loading_pressure, normal_tangent
   use normal_stiffness, only: branch_load, branch_open, has_come_to
   use numbers, only: first_largest
   use shear_stiffness, only: stand_at_limit
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   use tolerances, only: pressure_floor, rest_margin, rounding_of_deflections
   implicit none
   private

   public :: back_increment

   integer, parameter  :: most_averages = 1000 ! iterations with averaging
   integer, parameter  :: most_shown = 24      ! iterations without averaging: as many as the listing shows

contains

   !> Apply the whole load: secants and solution in turn until they agree: within TOL of the largest pressure, or within the
   !! rounding of the deflections times the slope of the law. With AVERAGE = NO agreement is not required: the last iteration that
   !! the listing shows is the result.
   subroutine back_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      real(wp), dimension(3, size(model%joints%element)) :: k, taken, deflection ! secants, their deflections, those that result
      real(wp), dimension(size(model%joints%element)) :: change, left ! of the stresses of the laws between both [pressure]
      real(wp), allocatable :: load(:, :)
      real(wp) :: k_then(3), largest_p, p(2)
      integer  :: i, iteration, worst

      taken = 0.0_wp
      taken(3, :) = loading_deflection(model%joints%list(model%joints%element%joint)%law%normal, analysis%states%normal%p_av)
      do iteration = 1, merge(most_averages, most_shown, analysis%average)
         load = analysis%now%condensed_load
         do i = 1, size(change)
            associate (element => system%interface(i), law => model%joints%list(model%joints%element(i)%joint)%law)
               k(:, i) = back_stiffness(law, element%area, analysis%states(i)%normal%p_av, taken(:, i))
               ! the secant starts where the gap g is closed: k_n (closing - g)
               if (abs(element%gap) > 0.0_wp) call add_force(element, [0.0_wp, 0.0_wp, k(3, i)*element%gap], load)
            end associate
         end do
         call form_structure_stiffness(model, stiffness_matrices(k), where_in_plan(plan, analysis%stage, analysis%increment), &
                                       system, failure, one_solution=.true.)
         call solve_equations(model, system, load, analysis%u, failure, &
                              moved=merge(analysis%now%moved(:, system%retained), 0.0_wp, analysis%moves))
         if (failure%raised) return
         if (size(change) == 0) exit

         largest_p = 0.0_wp
         do i = 1, size(change)
            associate (element => system%interface(i), law => model%joints%list(model%joints%element(i)%joint)%law)
               deflection(:, i) = joint_movement(element, analysis%u) - [0.0_wp, 0.0_wp, element%gap]
               p = loading_pressure(law%normal, max(0.0_wp, [taken(3, i), deflection(3, i)]))
               k_then = back_stiffness(law, element%area, analysis%states(i)%normal%p_av, deflection(:, i))
               change(i) = max(abs(p(2) - p(1)), maxval(abs((k_then(:2) - k(:2, i))*deflection(:2, i))/element%area))
               largest_p = max(largest_p, p(2))
            end associate
         end do
         associate (p => max(largest_p, pressure_floor*maxval(analysis%states%normal%p_av)))
            do i = 1, size(change)
               associate (law => model%joints%list(model%joints%element(i)%joint)%law%normal)
                  left(i) = max(analysis%load_tolerance*p, rounding_of_deflections*loading_deflection(law, p)* &
                                normal_tangent(law, 1.0_wp, p, analysis%states(i)%normal%p_av))
               end associate
            end do
         end associate
         left = max(left, 0.1_wp*force_noise(system, analysis%u)/model%joints%element%area)
         call record_iteration(analysis, iteration_record(before=largest_p, after=maxval(change), &
                                                step=maxval(deflection(3, :)), part=-1))
         analysis%record%is_settled = all(change <= left)
         if (analysis%record%is_settled) exit
         taken = merge(0.5_wp*(taken + deflection), deflection, analysis%average)
      end do
      if (analysis%average .and. .not. analysis%record%is_settled) then
         worst = first_largest(change)
         call failure%raise(where_in_plan(plan, analysis%stage, analysis%increment)//': the pressures have not converged after '// &
            integer_text(analysis%record%n_iterations)//' iterations; that of node '// &
            integer_text(joint_node_id(model, worst, 1))//' still changes by '//real_text(change(worst))//'; use METHOD = NEWTON')
         return
      end if
      call store(model, k, deflection, analysis)
      call forces_in_bodies(system, analysis%u, analysis%body)
      call find_movements(system, analysis)
      call find_unbalanced(system, analysis)
   end subroutine back_increment

   !> Store the states of the elements from the last solution, with the secants K and the DEFLECTIONS.
   subroutine store(model, k, deflections, analysis)
      type(model_type), intent(in)       :: model
      real(wp), intent(in)               :: k(:, :), deflections(:, :) !! (3, n)
      type(analysis_type), intent(inout) :: analysis
      real(wp) :: largest
      integer  :: i

      largest = maxval(abs(deflections(3, :)))
      do i = 1, size(model%joints%element)
         associate (state => analysis%states(i), element => model%joints%element(i), deflection => deflections(:, i), &
                    law => model%joints%list(model%joints%element(i)%joint)%law)
            state%normal%branch = merge(branch_load, branch_open, has_come_to(0.0_wp, deflection(3), largest))
            state%normal%lambda = deflection(3)
            state%normal%k_n = k(3, i)
            analysis%record%kind(i) = merge(secant_stiffness, no_stiffness, state%normal%k_n > 0.0_wp)
            state%normal%sumf = max(0.0_wp, k(3, i)*deflection(3))
            state%normal%pressure = state%normal%sumf/element%area
            state%shear%sense = sign(1.0_wp, deflection(:2))
            state%shear%delta = deflection(:2)
            state%shear%k_s = k(:2, i)
            state%shear%tau = state%shear%k_s*deflection(:2)/element%area
            state%slips = exceeds_limit(law, state, rest_margin) .or. &
                          limit_cuts(law, state%normal%pressure, deflection(:2))
            if (law%iwan%given) then
               state%shear%slid = state%shear%delta - state%shear%tau/law%iwan%k_t
               if (allocated(state%iwan)) deallocate (state%iwan)
               state%iwan = slices_to(law, state)
            else if (state%slips) then
               call stand_at_limit(law%shear, max(0.0_wp, state%normal%pressure), state%shear)
               state%shear%slid = state%shear%delta_0
            end if
            call analysis%energy(element%joint)%add(work_of_secants(law, element%area, state))
         end associate
      end do
   end subroutine store

end module back_method
