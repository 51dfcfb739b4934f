!> The step-wise tangent-stiffness method: one routine a box of the flow chart (Fig. 6a).
module step_method
   use body_elements, only: internal_forces
   use case_control, only: case_control_type, pressure_eq10
   use equations, only: equation_system, form_structure_stiffness, solve_equations
   use failures, only: failure_type
   use kinds, only: wp
   use model_data, only: model_type
   use normal_stiffness, only: branch_open, norm, normal_law, normal_state
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: start_analysis, start_stage, start_increment, interface_stiffness, structure_stiffness, &
             solve_increment, accumulate, joint_movement

   !> Everything that changes from increment to increment. Arrays over nodes are (dimension, n_nodes).
   type, public :: analysis_type
      integer  :: stage = 0, increment = 0
      real(wp) :: share = 0.0_wp                    !! of the stage's load change, this increment
      real(wp) :: fraction = 0.0_wp                 !! of it, so far: exactly 1 at the end of the stage
      logical  :: carry = .false.
      real(wp), allocatable :: load_before(:, :)    !! at the start of the stage [force]
      real(wp), allocatable :: load_after(:, :)     !! at its end
      real(wp), allocatable :: applied(:, :)        !! now
      real(wp), allocatable :: change(:, :)         !! load of this increment
      real(wp), allocatable :: u(:, :), du(:, :)    !! displacements, and of this increment [length]
      real(wp), allocatable :: unbalanced(:, :)     !! applied - internal forces; on held components minus the reaction
      type(normal_law), allocatable   :: laws(:)    !! of the joints
      type(normal_state), allocatable :: normal(:)  !! of the interface elements
      real(wp), allocatable :: k_n(:)               !! their stiffness in the next increment [force/length]
      integer  :: n_removed = 0                     !! interface elements removed by the last increment
   end type analysis_type

contains

   !> A structure at rest without load.
   subroutine start_analysis(model, control, analysis)
      type(model_type), intent(in)        :: model
      type(case_control_type), intent(in) :: control
      type(analysis_type), intent(out)    :: analysis
      integer :: j

      allocate (analysis%applied(model%dimension, model%n_nodes), source=0.0_wp)
      allocate (analysis%load_before, analysis%load_after, analysis%change, analysis%u, analysis%du, analysis%unbalanced, &
                source=analysis%applied)
      analysis%carry = control%carry
      allocate (analysis%laws(size(model%joints)))
      do j = 1, size(model%joints)
         associate (joint => model%joints(j))
            analysis%laws(j) = normal_law(c=joint%c, m=joint%m, e_u=joint%e_u, p_av=joint%p_av, &
                                          eq10=control%pressure == pressure_eq10)
         end associate
      end do
      allocate (analysis%normal(size(model%interface)))
      allocate (analysis%k_n(size(model%interface)), source=0.0_wp)
   end subroutine start_analysis


   !> The next stage begins where the last one ended; the joint remembers.
   subroutine start_stage(model, stage, analysis)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: stage
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      analysis%stage = stage
      analysis%increment = 0
      analysis%fraction = 0.0_wp
      analysis%load_before = analysis%applied
      analysis%load_after = 0.0_wp
      associate (loads => model%stage_loads(stage))
         do i = 1, loads%n
            analysis%load_after(:, loads%node(i)) = analysis%load_after(:, loads%node(i)) + loads%force(:model%dimension, i)
         end do
      end associate
   end subroutine start_stage


   !> {dF} of the next increment: its share of the stage's load change, and what is unbalanced where CARRY asks for it.
   subroutine start_increment(plan, analysis)
      type(stage_plan_type), intent(in)  :: plan
      type(analysis_type), intent(inout) :: analysis
      real(wp), allocatable :: target(:, :)

      associate (shares => plan%stages(analysis%stage)%shares)
         analysis%increment = analysis%increment + 1
         analysis%share = shares(analysis%increment)
         analysis%fraction = sum(shares(:analysis%increment))
         if (analysis%increment == size(shares)) then
            analysis%fraction = 1.0_wp
            target = analysis%load_after
         else
            target = analysis%load_before + analysis%fraction*(analysis%load_after - analysis%load_before)
         end if
      end associate
      analysis%change = target - analysis%applied
      analysis%applied = target
      if (analysis%carry) analysis%change = analysis%change + analysis%unbalanced
   end subroutine start_increment


   !> NORM for every interface element: its branch after the last increment, its stiffness for the next one.
   subroutine interface_stiffness(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      integer :: before, i

      analysis%n_removed = 0
      do i = 1, size(model%interface)
         before = analysis%normal(i)%branch
         call norm(analysis%laws(model%interface(i)%joint), model%interface(i)%area, analysis%normal(i), analysis%k_n(i))
         if (analysis%normal(i)%branch == branch_open .and. before /= branch_open) analysis%n_removed = analysis%n_removed + 1
      end do
      call find_unbalanced(model, analysis)
   end subroutine interface_stiffness


   !> [k_s] = sum [k_b] + sum [k_int], ready to solve.
   subroutine structure_stiffness(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(in)      :: analysis
      type(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure

      call form_structure_stiffness(model, analysis%k_n, 'stage '//integer_text(plan%stages(analysis%stage)%id)// &
                                    ', increment '//integer_text(analysis%increment), system, failure)
   end subroutine structure_stiffness


   !> {du} from [k_s] {du} = {dF}.
   subroutine solve_increment(system, analysis)
      type(equation_system), intent(in)  :: system
      type(analysis_type), intent(inout) :: analysis

      call solve_equations(system, analysis%change, analysis%du)
   end subroutine solve_increment


   !> Add the increment's displacements, deflections and forces to their sums.
   subroutine accumulate(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      real(wp) :: closing, movement(3)
      integer  :: i

      analysis%u = analysis%u + analysis%du
      do i = 1, size(model%interface)
         associate (state => analysis%normal(i))
            movement = joint_movement(model, analysis%du, i)
            closing = movement(3)
            state%k_n = analysis%k_n(i)
            state%lambda_before = state%lambda
            state%lambda = state%lambda + closing
            state%sigmaf = state%sumf
            state%sumf = state%sumf + state%k_n*closing
         end associate
      end do
   end subroutine accumulate


   !> Movement of end 1 of interface element I against end 2 in its own axes: the shear deflections delta_x, delta_y and
   !! the closing deflection lambda [length].
   pure function joint_movement(model, u, i) result(movement)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      integer, intent(in)          :: i
      real(wp) :: movement(3), between(3)

      associate (element => model%interface(i), d => model%dimension)
         between = 0.0_wp
         between(:d) = u(:, element%nodes(1))
         if (element%nodes(2) > 0) between(:d) = between(:d) - u(:, element%nodes(2))
         movement = matmul(between, element%axes)
      end associate
   end function joint_movement


   !> Applied load minus the forces in bodies and joints: what the increment leaves unbalanced, and on held components
   !! minus the reaction.
   subroutine find_unbalanced(model, analysis)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      call internal_forces(model, analysis%u, analysis%unbalanced)
      analysis%unbalanced = analysis%applied - analysis%unbalanced
      do i = 1, size(model%interface)
         associate (element => model%interface(i), d => model%dimension, force => analysis%normal(i)%sumf)
            associate (one => analysis%unbalanced(:, element%nodes(1)))
               one = one - force*element%axes(:d, 3)
            end associate
            if (element%nodes(2) == 0) cycle
            associate (two => analysis%unbalanced(:, element%nodes(2)))
               two = two + force*element%axes(:d, 3)
            end associate
         end associate
      end do
   end subroutine find_unbalanced


end module step_method
