!> METHOD = STEP, the step-wise tangent-stiffness method: one routine for each box of the flow chart (Fig. 6a).
module step_method
   use analysis_state, only: analysis_type, find_movements, iteration_record, record_iteration, slip_record
   use equations, only: equation_system, forces_in_bodies, form_structure_stiffness, solve_equations
   use equation_solver, only: failure_type
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: element_state, exceeds_limit, friction_excess, friction_limit, stiffness_matrices
   use joint_work, only: work_of_tangents
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_stiffness, only: pressure_reached
   use numbers, only: first_largest
   use stage_entries, only: output_joint
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   use tolerances, only: flag_margin, no_excess
   implicit none
   private

   public :: structure_stiffness, solve_increment, accumulate, limit_friction

   integer, parameter  :: most_reanalyses = 2000               ! of NREAN = -1
   integer, parameter, public :: reanalyses_shown = 8          !! of many, and the last one

contains

   !> [k_s] = sum [k_b] + sum [k_int], ready to solve.
   subroutine structure_stiffness(model, plan, analysis, system, failure)
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(in)       :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)     :: failure !! raised: there is no stiffness to solve with

      if (analysis%is_loose) call failure%raise('interference has pushed a body away from all joints')
      if (failure%raised) return
      call form_structure_stiffness(model, stiffness_matrices(analysis%k), where_in_plan(plan, analysis%stage, &
                                    analysis%increment), system, failure, &
                                    one_solution=.not. any(model%joints%list%law%has_friction))
   end subroutine structure_stiffness

   !> {du} from [k_s] {du} = {dF}.
   subroutine solve_increment(model, system, analysis, failure)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout)    :: analysis
      type(failure_type), intent(inout)     :: failure

      if (failure%raised) return
      call solve_equations(model, system, analysis%change, analysis%du, failure, moved=analysis%move)
   end subroutine solve_increment

   !> Add the increment's displacements, deflections and forces to their sums.
   subroutine accumulate(model, system, analysis, failure)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(in)     :: failure
      integer :: i

      if (failure%raised) return
      analysis%record%kind = analysis%next_kind
      do i = 1, size(model%joints%element)
         associate (state => analysis%states(i))
            state%normal%k_n = analysis%k(3, i)
            state%normal%lambda_before = state%normal%lambda
            state%normal%sigmaf = state%normal%sumf
            state%shear%k_s = analysis%k(:2, i)
            state%shear%delta_before = state%shear%delta
            state%shear%tau_before = state%shear%tau
            state%slips = .false.
         end associate
      end do
      call add_displacements(model, system, analysis%change, analysis)
   end subroutine accumulate

   !> Add {du}, the displacements under the forces F, and the resulting forces of the interface elements at the stiffness of
   !! this increment. The bodies carry the rest of F: [k_b] {du} = F - sum of [k_int] {du}.
   subroutine add_displacements(model, system, f, analysis)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: f(:, :) !! (dimension, retained) [force]
      type(analysis_type), intent(inout) :: analysis
      real(wp) :: movement(3)
      integer  :: i

      analysis%u = analysis%u + analysis%du
      analysis%body = analysis%body + f
      do i = 1, size(model%joints%element)
         movement = joint_movement(system%interface(i), analysis%du)
         associate (state => analysis%states(i), area => model%joints%element(i)%area)
            state%shear%delta = state%shear%delta + movement(:2)
            state%shear%tau = state%shear%tau + analysis%k(:2, i)*movement(:2)/area
            state%normal%lambda = state%normal%lambda + movement(3)
            state%normal%sumf = state%normal%sumf + analysis%k(3, i)*movement(3)
            state%normal%pressure = pressure_reached(area, analysis%eq10, state%normal)
         end associate
         call add_force(system%interface(i), -analysis%k(:, i)*movement, analysis%body)
      end do
      if (size(system%locked) > 0) call forces_in_bodies(system, analysis%u, analysis%body) ! a locked unknown carries more than F
      call find_movements(system, analysis)
   end subroutine add_displacements

   !> The last box that changes forces: the Coulomb limit. Then the work of the increment is known.
   subroutine limit_friction(model, plan, system, analysis, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(inout)  :: failure
      integer :: i

      if (failure%raised) return
      if (any(model%joints%list%law%has_friction)) call relieve(model, plan, system, analysis, failure)
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i))
            call analysis%energy(element%joint)%add(work_of_tangents(model%joints%list(element%joint)%law, element%area, &
                                                                     analysis%states(i)))
         end associate
      end do
   end subroutine limit_friction

   !> Coulomb limit (section 4.4): where |tau| > mu p, the element is relieved of the excess. The excess is applied at its two
   !! ends, and the structure is analysed again with the same stiffness, NREAN times; for NREAN = -1 until the excess is
   !! rounding.
   subroutine relieve(model, plan, system, analysis, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: excess(:, :), relief(:, :)
      real(wp) :: slid(2), total, total_after
      integer  :: i, passes(size(model%joints%element)), reanalysis, worst
      logical  :: is_listed, relieved(size(model%joints%element))
      type(slip_record) :: record

      allocate (excess(2, size(model%joints%element)))
      allocate (relief, mold=analysis%u)
      passes = model%joints%list(model%joints%element%joint)%n_reanalyses
      is_listed = plan%stages(analysis%stage)%output%level >= output_joint
      call find_excess(model, analysis, excess, total)
      do reanalysis = 1, most_reanalyses
         if (total <= 0.0_wp) return
         relieved = any(abs(excess) > 0.0_wp, dim=1) .and. (passes < 0 .or. reanalysis <= passes)
         ! an element in tension has the limit zero: each re-analysis reduces its excess, but never to zero
         if (sum(norm2(excess, dim=1), mask=relieved) <= &
             no_excess*sum([(model%joints%element(i)%area*friction_limit(model%joints%list(model%joints%element(i)%joint)%law, &
                                                                         analysis%states(i)%normal%pressure), &
                             i = 1, size(relieved))])) return
         ! the listing has the first re-analyses, and the last one in place of those between
         if (is_listed) analysis%record%slips = pack(analysis%record%slips, analysis%record%slips%reanalysis <= reanalyses_shown)
         relief = 0.0_wp
         do i = 1, size(relieved)
            if (.not. relieved(i)) cycle
            if (is_listed) then
               record = slip_record(reanalysis=reanalysis, element=i)
               call note_slip(model, analysis%states, 1, record)
               analysis%record%slips = [analysis%record%slips, record]
            end if
            ! the element slides by the excess over its stiffness
            associate (shear => analysis%states(i)%shear, area => model%joints%element(i)%area)
               slid = 0.0_wp
               where (analysis%k(:2, i) > 0.0_wp) slid = excess(:, i)/analysis%k(:2, i)
               shear%tau = shear%tau - excess(:, i)/area
               shear%slid = shear%slid + slid
            end associate
            call add_force(system%interface(i), [excess(:, i), 0.0_wp], relief)
         end do
         call solve_equations(model, system, relief, analysis%du, failure)
         if (failure%raised) return
         call add_displacements(model, system, relief, analysis)
         call find_excess(model, analysis, excess, total_after)
         do i = 1, size(analysis%record%slips)
            associate (record => analysis%record%slips(i))
               if (record%reanalysis == reanalysis) call note_slip(model, analysis%states, 2, record)
            end associate
         end do
         call record_iteration(analysis, iteration_record(before=total, after=total_after, changes=count(analysis%states%slips)))
         total = total_after
      end do
      worst = first_largest(maxval(abs(excess), dim=1), passes < 0)
      call failure%raise(where_in_plan(plan, analysis%stage, analysis%increment)//': after '//integer_text(most_reanalyses)// &
         ' re-analyses the friction of joint '//integer_text(model%joints%list(model%joints%element(worst)%joint)%id)// &
         ' is still exceeded, by '//real_text(total)//' in all, most at node '// &
         integer_text(joint_node_id(model, worst, 1))//' in its tangential direction: the joint slips as a whole')
   end subroutine relieve

   !> EXCESS(2, n) of all elements and the TOTAL of their sizes [force]; those that slip are marked.
   subroutine find_excess(model, analysis, excess, total)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      real(wp), intent(out)              :: excess(:, :), total
      integer :: i

      total = 0.0_wp
      do i = 1, size(model%joints%element)
         associate (law => model%joints%list(model%joints%element(i)%joint)%law, state => analysis%states(i))
            excess(:, i) = friction_excess(law, model%joints%element(i)%area, state)
            total = total + norm2(excess(:, i))
            if (exceeds_limit(law, state, flag_margin)) state%slips = .true.
         end associate
      end do
   end subroutine find_excess

   !> Note deflections, stresses and limit of the element of RECORD, WHEN = 1 before a re-analysis, 2 after it.
   pure subroutine note_slip(model, states, when, record)
      type(model_type), intent(in)     :: model
      type(element_state), intent(in)  :: states(:)
      integer, intent(in)              :: when
      type(slip_record), intent(inout) :: record

      associate (state => states(record%element))
         record%delta(:, when) = state%shear%delta
         record%tau(:, when) = state%shear%tau
         record%limit(when) = friction_limit(model%joints%list(model%joints%element(record%element)%joint)%law, &
            state%normal%pressure)
      end associate
   end subroutine note_slip

end module step_method
