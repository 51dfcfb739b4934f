!> Decks solved as the main program does, by STEP or by NEWTON, without any output.
module deck_runs
   use analysis_state, only: analysis_type, interface_stiffness, start_analysis
   use case_control, only: case_control_type
   use control_words, only: method_newton
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type, read_deck
   use deck_models, only: read_lines
   use equations, only: equation_system, form_body_stiffness, start_equations
   use equation_solver, only: failure_type
   use load_path, only: recover_bodies, start_increment, start_stage
   use model_build, only: build_model
   use model_data, only: model_type
   use newton_method, only: close_gaps, crosses_gaps, newton_increment, seat_joints
   use stage_plan, only: stage_plan_type
   use step_method, only: accumulate, limit_friction, solve_increment, structure_stiffness
   implicit none
   private

   public :: build_lines, run_stages, run_lines, run_file

   type, public :: run_type
      type(case_control_type) :: control
      type(model_type)        :: model
      type(stage_plan_type)   :: plan
      class(equation_system), allocatable :: system
      type(analysis_type)     :: analysis              !! after the last increment
      type(analysis_type), allocatable :: states(:)    !! after each increment
      type(failure_type)      :: failure
      character(:), allocatable :: problem             !! the first error of the deck: nothing is solved then; '': none
   end type run_type

contains

   !> Solve the deck with these LINES, up to stage LAST or all of it; a semicolon ends a line.
   subroutine run_lines(lines, run, last)
      character(*), intent(in)      :: lines
      type(run_type), intent(out)   :: run
      integer, intent(in), optional :: last

      call build_lines(lines, run)
      call run_stages(run, last)
   end subroutine run_lines

   !> Solve the deck PATH; SOLVER as in case control, AUTO.
   subroutine run_file(path, run, last, solver)
      character(*), intent(in)      :: path
      type(run_type), intent(out)   :: run
      integer, intent(in), optional :: last, solver
      type(deck_type)       :: deck
      type(deck_error_list) :: errors
      logical :: readable

      call read_deck(path, deck, errors, readable)
      if (.not. readable) call errors%add(0, 'unreadable')
      call build_deck(deck, errors, run)
      call run_stages(run, last, solver)
   end subroutine run_file

   !> The model and the plan of the deck with these LINES, to be solved by RUN_STAGES.
   subroutine build_lines(lines, run)
      character(*), intent(in)    :: lines
      type(run_type), intent(out) :: run
      type(deck_type)       :: deck
      type(deck_error_list) :: errors

      call read_lines(lines, deck, errors)
      call build_deck(deck, errors, run)
   end subroutine build_lines

   subroutine build_deck(deck, errors, run)
      type(deck_type), intent(in)          :: deck
      type(deck_error_list), intent(inout) :: errors
      type(run_type), intent(inout)        :: run

      run%control = deck%control
      if (.not. errors%any()) call build_model(deck, run%model, run%plan, errors)
      run%problem = ''
      if (errors%any()) run%problem = errors%items(1)%message
   end subroutine build_deck

   !> Solve what is built, up to stage LAST or all of it; SOLVER as in case control, AUTO.
   subroutine run_stages(run, last, solver)
      type(run_type), intent(inout) :: run
      integer, intent(in), optional :: last, solver
      integer :: i, s, stages

      if (run%problem /= '') return
      stages = size(run%plan%stages)
      if (present(last)) stages = last
      call start_equations(run%model, run%system, run%failure, solver)
      call form_body_stiffness(run%model, run%system, run%failure)
      call start_analysis(run%model, run%system, run%control, run%analysis)
      call seat_joints(run%model, run%analysis, run%system, run%failure)
      call interface_stiffness(run%model, run%system, run%analysis, run%failure)
      allocate (run%states(0))
      do s = 1, stages
         call start_stage(run%model, run%system, run%analysis)
         do i = 1, size(run%plan%stages(s)%fractions)
            call start_increment(run%plan, run%system, run%analysis)
            if (run%control%method == method_newton) then
               call newton_increment(run%model, run%plan, run%analysis, run%system, run%failure)
            else
               call step(run)
            end if
            if (run%failure%raised) return
            call recover_bodies(run%model, run%system, run%analysis)
            run%states = [run%states, run%analysis]
         end do
      end do
   end subroutine run_stages

   !> An increment of STEP.
   subroutine step(run)
      type(run_type), intent(inout) :: run

      call structure_stiffness(run%model, run%plan, run%analysis, run%system, run%failure)
      call solve_increment(run%model, run%system, run%analysis, run%failure)
      if (crosses_gaps(run%analysis, run%failure)) then
         call close_gaps(run%model, run%plan, run%analysis, run%system, run%failure)
      else
         call accumulate(run%model, run%system, run%analysis, run%failure)
         call limit_friction(run%model, run%plan, run%system, run%analysis, run%failure)
      end if
      call interface_stiffness(run%model, run%system, run%analysis, run%failure)
   end subroutine step

end module deck_runs
