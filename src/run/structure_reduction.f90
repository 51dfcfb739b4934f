!> The box of OUTPUT = DMIG: the structure at the end of a stage, condensed on the components of ASET.
module structure_reduction
   use analysis_state, only: analysis_type
   use deck_check, only: checked_deck
   use deck_input, only: deck_type
   use dmig_file, only: list_superelement
   use equation_solver, only: equation_system
   use model_data, only: model_type
   use oscillating_structure, only: oscillating_type, start_oscillation
   use run_of_deck, only: run_type
   use stage_plan, only: stage_plan_type, where_in_plan
   use superelement, only: reduce_structure, reduced_type
   use superelement_build, only: find_retained, retained_type
   implicit none
   private

   public :: condense_structure

contains

   !> Condense the structure in the state of ANALYSIS, with the joints as in its natural modes, and write the matrices, where the stage
   !! asks for them.
   subroutine condense_structure(run, deck, model, plan, system, analysis)
      type(run_type), intent(inout)      :: run
      type(deck_type), intent(in), target :: deck
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(checked_deck)     :: checked
      type(oscillating_type) :: structure
      type(reduced_type)     :: reduced
      type(retained_type)    :: retained

      associate (stage => plan%stages(analysis%stage), failure => run%failure)
         if (.not. stage%output%dmig .or. failure%raised) return
         call checked%start(deck, run%errors)
         call find_retained(checked, model%mesh, model%freedoms, retained)
         call start_oscillation(model, analysis, system, deck%control%stages(analysis%stage)%vibration%on_loading, structure, &
                                failure)
         call reduce_structure(model, structure, retained, stage%vibration, reduced, failure)
         if (failure%raised) then
            failure%message = where_in_plan(plan, analysis%stage, analysis%increment)//': '//failure%message
            return
         end if
         call list_superelement(run%results%page, model, count(plan%stages%output%dmig) > 1, reduced)
      end associate
   end subroutine condense_structure

end module structure_reduction
