!> The stages of the load history and the shares of their increments, as case control and JINCR cards give them.
module stage_plan
   use case_control, only: method_back, method_newton
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use kinds, only: wp
   use stage_entries, only: output_all, output_last
   use text_tools, only: integer_text
   use vibration_plan, only: vibration_plan_type
   implicit none
   private

   public :: any_modes, any_response, plan_stages, where_in_plan, factorisations_of, shows_bodies

   type, public :: planned_stage
      integer :: id = 0
      character(:), allocatable :: label
      integer :: output = 0                 !! output_* of case_control
      logical :: plot = .false., vtu = .false., steps = .false., stress = .false., state = .false., condensed = .false.
      logical :: along_cd = .false.         !! tables of nodes have the directions of their systems CD
      logical, allocatable :: shown(:)      !! nodes that its tables are limited to; not allocated: all
      character(:), allocatable :: shown_words !! of that, behind a title
      real(wp), allocatable :: shares(:)    !! of the stage's load change, one an increment, sum 1
      type(vibration_plan_type), allocatable :: vibration !! at its end; not allocated: none is asked
   end type planned_stage

   type, public :: stage_plan_type
      type(planned_stage), allocatable :: stages(:)
   end type stage_plan_type

contains

   !> A stage without INCR takes its load in one increment, and so does METHOD = BACK.
   subroutine plan_stages(deck, plan, errors)
      type(deck_type), intent(in)          :: deck
      type(stage_plan_type), intent(out)   :: plan
      type(deck_error_list), intent(inout) :: errors
      integer :: s, k

      allocate (plan%stages(size(deck%control%stages)))
      do s = 1, size(plan%stages)
         associate (stage => plan%stages(s), given => deck%control%stages(s))
            stage%id = given%id
            stage%label = given%label
            stage%output = given%output
            stage%plot = given%plot
            stage%vtu = given%vtu .or. given%steps
            stage%steps = given%steps
            stage%shown_words = ''
            stage%stress = given%stress
            stage%state = given%state
            stage%condensed = given%condensed
            stage%along_cd = given%along_cd
            stage%shares = [1.0_wp]
            if (given%increments%id == 0) cycle
            k = findloc(deck%bulk%jincr%id, given%increments%id, dim=1)
            if (k == 0) then
               call errors%add(given%increments%line, 'INCR: there is no JINCR '//integer_text(given%increments%id))
            else if (deck%control%method /= method_back) then
               stage%shares = deck%bulk%jincr(k)%shares
            end if
         end associate
      end do
   end subroutine plan_stages

   !> Whether natural modes are asked for after any stage.
   pure logical function any_modes(plan)
      type(stage_plan_type), intent(in) :: plan
      integer :: s

      any_modes = any([(allocated(plan%stages(s)%vibration), s = 1, size(plan%stages))])
   end function any_modes

   !> Whether the response to an oscillating load is asked for after any stage.
   pure logical function any_response(plan)
      type(stage_plan_type), intent(in) :: plan
      integer :: s

      any_response = .false.
      do s = 1, size(plan%stages)
         if (allocated(plan%stages(s)%vibration)) any_response = any_response .or. allocated(plan%stages(s)%vibration%response)
      end do
   end function any_response

   !> 'stage 2, increment 7', for messages.
   pure function where_in_plan(plan, stage, increment) result(words)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage, increment
      character(:), allocatable         :: words

      words = 'stage '//integer_text(plan%stages(stage)%id)//', increment '//integer_text(increment)
   end function where_in_plan

   !> How often the stiffness of the structure will be factorised, as a guess that orderings are chosen by.
   pure integer function factorisations_of(plan, method) result(n)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: method !! of case control
      integer :: s

      n = 0
      do s = 1, size(plan%stages)
         n = n + size(plan%stages(s)%shares)
      end do
      if (method == method_newton) n = 6*n
      if (method == method_back) n = 40*n
   end function factorisations_of

   !> Whether displacements, stresses or reactions of the bodies are printed after this increment.
   pure logical function shows_bodies(plan, stage, increment)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage, increment

      associate (planned => plan%stages(stage))
         shows_bodies = planned%output == output_all .or. planned%steps
         if (increment == size(planned%shares)) shows_bodies = shows_bodies .or. planned%output == output_last .or. planned%vtu
      end associate
   end function shows_bodies

end module stage_plan
