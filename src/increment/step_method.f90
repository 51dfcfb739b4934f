!> METHOD = STEP, the step-wise tangent-stiffness method: one routine for each box of the flow chart (Fig. 6a).
module step_method
   use analysis_state, only: analysis_type, book_friction, iteration_record, reach, record_iteration, slip_record, tally_work
   use equations, only: equation_system, forces_in_bodies, form_structure_stiffness, solve_equations
   use equation_solver, only: failure_type
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: exceeds_limit, flag_margin, friction_excess, friction_limit, is_apart
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use newton_method, only: cross_gaps
   use normal_stiffness, only: pressure_reached
   use numbers, only: first_largest
   use stage_entries, only: output_joint
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: structure_stiffness, solve_increment, accumulate, limit_friction

   integer, parameter  :: most_reanalyses = 2000               ! of NREAN = -1
   integer, parameter, public :: reanalyses_shown = 8          !! of many, and the last one

contains

   !> [k_s] = sum [k_b] + sum [k_int], ready to solve.
   subroutine structure_stiffness(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis !! crosses_gaps: there is no stiffness to solve with
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(failure_type) :: trouble
      real(wp), allocatable :: k_int(:, :, :)
      integer :: d

      if (failure%raised) return
      analysis%crosses_gaps = analysis%is_loose
      if (analysis%crosses_gaps) return
      allocate (k_int(3, 3, size(model%interface)), source=0.0_wp)
      do d = 1, 3
         k_int(d, d, :) = analysis%k(d, :)
      end do
      call form_structure_stiffness(model, k_int, where_in_plan(plan, analysis%stage, analysis%increment), system, trouble, &
                                    one_solution=.not. any(model%joints%law%has_friction))
      call decide_on(trouble, analysis, failure)
   end subroutine structure_stiffness

   !> TROUBLE with the stiffness is a failure, unless open gaps leave bodies loose: then this increment is iterated across the
   !! gaps.
   subroutine decide_on(trouble, analysis, failure)
      type(failure_type), intent(in)     :: trouble
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(inout)  :: failure

      analysis%crosses_gaps = trouble%raised .and. any(is_apart(analysis%states))
      if (trouble%raised .and. .not. analysis%crosses_gaps) failure = trouble
   end subroutine decide_on

   !> {du} from [k_s] {du} = {dF}; across gaps by NEWTON, to equilibrium, with nothing to accumulate.
   subroutine solve_increment(model, plan, system, analysis, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(inout)  :: failure
      type(failure_type) :: trouble

      if (failure%raised) return
      if (.not. analysis%crosses_gaps) then
         call solve_equations(model, system, analysis%change, analysis%du, trouble, moved=analysis%move)
         call decide_on(trouble, analysis, failure)
      end if
      if (analysis%crosses_gaps) call cross_gaps(model, plan, analysis, system, failure)
   end subroutine solve_increment

   !> Add the increment's displacements, deflections and forces to their sums.
   subroutine accumulate(model, system, analysis, failure)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(in)     :: failure
      integer :: i, k

      if (failure%raised .or. analysis%crosses_gaps) return
      analysis%record%kind = analysis%next_kind
      do i = 1, size(model%interface)
         associate (state => analysis%states(i))
            state%normal%k_n = analysis%k(3, i)
            state%normal%lambda_before = state%normal%lambda
            state%normal%sigmaf = state%normal%sumf
            do k = 1, 2
               state%shear(k)%k_s = analysis%k(k, i)
               state%shear(k)%delta_before = state%shear(k)%delta
               state%shear(k)%tau_before = state%shear(k)%tau
            end do
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
      real(wp), allocatable :: u(:, :), body(:, :)
      real(wp) :: movement(3), work(3), tau
      integer  :: i, k

      allocate (u, source=analysis%u + analysis%du)
      allocate (body, source=analysis%body + f)
      do i = 1, size(model%interface)
         movement = joint_movement(system%interface(i), analysis%du)
         associate (state => analysis%states(i), area => model%interface(i)%area)
            work = 0.0_wp
            do k = 1, 2
               tau = state%shear(k)%tau
               state%shear(k)%delta = state%shear(k)%delta + movement(k)
               state%shear(k)%tau = tau + analysis%k(k, i)*movement(k)/area
               work(1) = work(1) + 0.5_wp*area*(tau + state%shear(k)%tau)*movement(k)
            end do
            work(2) = (state%normal%sumf + 0.5_wp*analysis%k(3, i)*movement(3))*movement(3)
            state%normal%lambda = state%normal%lambda + movement(3)
            state%normal%sumf = state%normal%sumf + analysis%k(3, i)*movement(3)
            state%normal%pressure = pressure_reached(area, analysis%eq10, state%normal)
         end associate
         call tally_work(analysis%energy(model%interface(i)%joint), work)
         call add_force(system%interface(i), -analysis%k(:, i)*movement, body)
      end do
      if (size(system%locked) > 0) call forces_in_bodies(system, u, body) ! a locked unknown carries more than F
      call reach(system, u, body, analysis)
   end subroutine add_displacements

   !> Coulomb limit (section 4.4): where |tau| > mu p, the element is relieved of the excess. The excess is applied at its two
   !! ends, and the structure is analysed again with the same stiffness, NREAN times.
   subroutine limit_friction(model, plan, system, analysis, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(inout) :: system
      type(analysis_type), intent(inout) :: analysis
      type(failure_type), intent(inout)  :: failure
      real(wp), allocatable :: excess(:, :), relief(:, :)
      real(wp) :: total, total_after
      integer  :: reanalysis, worst
      logical  :: again, is_listed

      if (failure%raised .or. analysis%crosses_gaps .or. .not. any(model%joints%law%has_friction)) return
      allocate (excess(2, size(model%interface)))
      allocate (relief, mold=analysis%u)
      is_listed = plan%stages(analysis%stage)%output%level >= output_joint
      call find_excess(model, analysis, excess, total)
      do reanalysis = 1, most_reanalyses
         if (total <= 0.0_wp) return
         if (is_listed) call note_slipping(model, reanalysis, excess, analysis)
         call release(model, system, reanalysis, excess, analysis, relief, again)
         if (.not. again) return
         call solve_equations(model, system, relief, analysis%du, failure)
         if (failure%raised) return
         call add_displacements(model, system, relief, analysis)
         call find_excess(model, analysis, excess, total_after)
         if (is_listed) call note_relieved(model, analysis)
         call record_iteration(analysis, iteration_record(before=total, after=total_after, changes=count(analysis%states%slips)))
         total = total_after
      end do
      worst = first_largest(maxval(abs(excess), dim=1), model%joints(model%interface%joint)%n_reanalyses < 0)
      call failure%raise(where_in_plan(plan, analysis%stage, analysis%increment)//': after '//integer_text(most_reanalyses)// &
         ' re-analyses the friction of joint '//integer_text(model%joints(model%interface(worst)%joint)%id)// &
         ' is still exceeded, by '//real_text(total)//' in all, most at node '// &
         integer_text(joint_node_id(model, worst, 1))// &
         ' in its tangential direction: the joint slips as a whole')
   end subroutine limit_friction

   !> Record the elements that re-analysis number REANALYSIS relieves, before it: the first re-analyses, and the last one in
   !! place of those between.
   subroutine note_slipping(model, reanalysis, excess, analysis)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: reanalysis
      real(wp), intent(in)               :: excess(:, :)
      type(analysis_type), intent(inout) :: analysis
      type(slip_record) :: record
      integer :: i

      analysis%record%slips = pack(analysis%record%slips, analysis%record%slips%reanalysis <= reanalyses_shown)
      do i = 1, size(model%interface)
         if (.not. is_relieved(model, i, reanalysis, excess(:, i))) cycle
         record%reanalysis = reanalysis
         record%element = i
         record%delta(:, 1) = analysis%states(i)%shear%delta
         record%tau(:, 1) = analysis%states(i)%shear%tau
         record%limit(1) = friction_limit(model%joints(model%interface(i)%joint)%law, analysis%states(i)%normal%pressure)
         analysis%record%slips = [analysis%record%slips, record]
      end do
   end subroutine note_slipping

   !> Record the same elements after the re-analysis.
   pure subroutine note_relieved(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      do i = 1, size(analysis%record%slips)
         associate (record => analysis%record%slips(i), state => analysis%states(analysis%record%slips(i)%element))
            if (record%reanalysis <= analysis%record%n_iterations) cycle
            record%delta(:, 2) = state%shear%delta
            record%tau(:, 2) = state%shear%tau
            record%limit(2) = friction_limit(model%joints(model%interface(record%element)%joint)%law, state%normal%pressure)
         end associate
      end do
   end subroutine note_relieved

   !> Whether re-analysis number REANALYSIS relieves interface element I of its EXCESS.
   pure logical function is_relieved(model, i, reanalysis, excess)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i, reanalysis
      real(wp), intent(in)         :: excess(2)

      associate (allowed => model%joints(model%interface(i)%joint)%n_reanalyses)
         is_relieved = norm2(excess) > 0.0_wp .and. (allowed < 0 .or. reanalysis <= allowed)
      end associate
   end function is_relieved

   !> EXCESS(2, n) of all elements and the TOTAL of their sizes [force]; those that slip are marked.
   subroutine find_excess(model, analysis, excess, total)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      real(wp), intent(out)              :: excess(:, :), total
      integer :: i

      total = 0.0_wp
      do i = 1, size(model%interface)
         excess(:, i) = friction_excess(model%joints(model%interface(i)%joint)%law, model%interface(i)%area, analysis%states(i))
         total = total + norm2(excess(:, i))
         if (exceeds_limit(model%joints(model%interface(i)%joint)%law, analysis%states(i), flag_margin)) &
            analysis%states(i)%slips = .true.
      end do
   end subroutine find_excess

   !> Relieve the elements whose joints ask for re-analysis number REANALYSIS of their excess. RELIEF are the resulting nodal
   !! forces; AGAIN tells whether there are any. NREAN = -1 continues as long as any excess is left.
   subroutine release(model, system, reanalysis, excess, analysis, relief, again)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      integer, intent(in)                :: reanalysis
      real(wp), intent(in)               :: excess(:, :)
      type(analysis_type), intent(inout) :: analysis
      real(wp), intent(out)              :: relief(:, :)
      logical, intent(out)               :: again
      real(wp) :: slid(2)
      integer  :: i

      relief = 0.0_wp
      again = .false.
      do i = 1, size(model%interface)
         if (.not. is_relieved(model, i, reanalysis, excess(:, i))) cycle
         associate (element => system%interface(i))
            again = .true.
            slid = 0.0_wp
            where (analysis%k(:2, i) > 0.0_wp) slid = excess(:, i)/analysis%k(:2, i)
            analysis%states(i)%shear%tau = analysis%states(i)%shear%tau - excess(:, i)/element%area
            analysis%states(i)%shear%slid = analysis%states(i)%shear%slid + slid
            call book_friction(analysis%energy(model%interface(i)%joint), element%area*sum(analysis%states(i)%shear%tau*slid))
            call add_force(element, [excess(:, i), 0.0_wp], relief)
         end associate
      end do
   end subroutine release

end module step_method
