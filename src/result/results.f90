!> The results of one deck, as the main program sees them: opened, fed after every increment, closed.
module results
   use c_library, only: remove_file
   use deck_input, only: deck_type
   use equation_solver, only: equation_system
   use incomplete_results, only: all_complete
   use joint_history, only: write_history, write_history_header
   use listing, only: finish_listing, list_increment, list_stage, listing_type, start_listing
   use model_data, only: model_type
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use analysis_state, only: analysis_type
   use vtu_results, only: discard_vtu, finish_vtu, is_vtu_ending, remove_old_vtu, start_vtu, vtu_results_type, write_vtu
   implicit none
   private

   public :: start_results, print_increment, print_stage, finish_results, discard_results, remove_old_results, is_result_ending

   character(*), parameter, public :: listing_ending = '.out', history_ending = '.joint.csv'

   type, public :: results_type
      type(listing_type)     :: listing
      type(output_file_type) :: history
      type(vtu_results_type) :: vtu
      character(:), allocatable :: base !! what the names of the files begin with, folder included
   end type results_type

contains

   !> Open the files whose names begin with BASE and write what opens them; without it the listing goes to the standard output,
   !! and nothing else is written. OK is false where that fails.
   subroutine start_results(base, deck, model, plan, system, results, ok)
      character(*), intent(in)          :: base
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), intent(in) :: system
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok

      results%base = base
      call start_vtu(results%vtu, base, plan)
      if (base == '') call start_listing(results%listing, '', deck, model, plan, system)
      if (base /= '') call start_listing(results%listing, base//listing_ending, deck, model, plan, system)
      ok = .not. results%listing%page%file%failed()
      if (base /= '') then
         call results%history%start(base//history_ending)
         call write_history_header(results%history, model)
         ok = ok .and. .not. results%history%failed()
      end if
   end subroutine start_results

   !> The increment just completed.
   subroutine print_increment(model, plan, analysis, results)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(results_type), intent(inout) :: results

      call list_increment(results%listing, model, plan, analysis)
      if (results%history%is_open) call write_history(results%history, model, plan, analysis)
   end subroutine print_increment

   !> The stage just completed.
   subroutine print_stage(model, plan, analysis, results)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(results_type), intent(inout) :: results

      call list_stage(results%listing, model, plan, analysis)
      call write_vtu(results%vtu, model, plan, analysis)
   end subroutine print_stage

   !> Give the files their names. All or none: OK is false where one could not be written.
   subroutine finish_results(plan, results, ok)
      type(stage_plan_type), intent(in) :: plan
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok

      ok = .true.
      if (results%history%is_open) call results%history%finish(ok)
      if (ok) call finish_vtu(results%vtu, ok)
      if (ok) call finish_listing(results%listing, plan, ok)
      if (.not. ok) then
         call discard_results(results)
         if (results%base /= '') call remove_file(results%base//history_ending)
      end if
      call all_complete()
   end subroutine finish_results

   !> Leave nothing behind that could be taken for a result.
   subroutine discard_results(results)
      type(results_type), intent(inout) :: results

      call results%listing%page%file%discard()
      call results%history%discard()
      call discard_vtu(results%vtu)
      call all_complete()
   end subroutine discard_results

   !> Remove what an earlier run of the same deck left: it is not the result of this deck any more, wherever the run ends.
   subroutine remove_old_results(base)
      character(*), intent(in) :: base

      if (base == '') return
      call remove_file(base//listing_ending)
      call remove_file(base//history_ending)
      call remove_old_vtu(base)
   end subroutine remove_old_results

   !> Whether the name of a result may end so, behind its base.
   pure logical function is_result_ending(ending)
      character(*), intent(in) :: ending

      is_result_ending = ending == listing_ending .or. ending == history_ending .or. is_vtu_ending(ending)
   end function is_result_ending

end module results
