!> The box of the flow chart for natural modes: once a stage has come to its end, how the structure oscillates about it.
module run_modes
   use analysis_state, only: analysis_type
   use equation_solver, only: equation_system
   use modal_response, only: find_response, response_type
   use mode_values, only: evaluate_modes, modes_type
   use model_data, only: model_type
   use natural_modes, only: find_natural_modes, spectrum_type
   use oscillating_structure, only: let_go, oscillating_type, start_oscillation
   use progress, only: phase_increments, phase_modes
   use results, only: print_modes, print_response
   use run_state, only: is_over, run_type
   use stage_plan, only: stage_plan_type, where_in_plan
   use vibration_plan, only: vibration_plan_type
   implicit none
   private

   public :: find_modes

contains

   !> Find and print the natural modes where the increment has completed a stage that asks for them. Nothing of the analysis changes.
   subroutine find_modes(run, model, plan, system, analysis)
      type(run_type), intent(inout)      :: run
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(model_type), allocatable :: loose

      if (is_over(run)) return
      associate (stage => plan%stages(analysis%stage))
         if (analysis%increment < size(stage%shares) .or. .not. allocated(stage%vibration)) return
         call run%progress%enter(phase_modes)
         if (stage%vibration%free) then
            allocate (loose, source=model)
            call let_go(loose)
            call oscillate(run, loose, plan, stage%vibration, system, analysis)
         else
            call oscillate(run, model, plan, stage%vibration, system, analysis)
         end if
      end associate
      call run%progress%enter(phase_increments)
   end subroutine find_modes

   subroutine oscillate(run, model, plan, wanted, system, analysis)
      type(run_type), intent(inout)         :: run
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(vibration_plan_type), intent(in) :: wanted
      class(equation_system), intent(in)    :: system
      type(analysis_type), intent(in)       :: analysis
      type(oscillating_type) :: structure
      type(spectrum_type)    :: spectrum
      type(modes_type)       :: modes
      type(response_type)    :: response
      class(equation_system), allocatable :: shifted

      call start_oscillation(model, analysis, system, wanted%on_loading, structure, run%failure)
      call find_natural_modes(model, structure, wanted, spectrum, shifted, run%failure)
      if (run%failure%raised) then
         run%failure%message = where_in_plan(plan, analysis%stage, analysis%increment)//': '//run%failure%message
         return
      end if
      call evaluate_modes(model, analysis, structure, wanted, spectrum, shifted, modes)
      call print_modes(model, plan, analysis%stage, modes, run%results)
      if (.not. allocated(wanted%response)) return
      call find_response(model, structure, wanted%response, modes, shifted, response, run%failure)
      if (.not. run%failure%raised) call print_response(plan, analysis%stage, response, run%results)
   end subroutine oscillate

end module run_modes
