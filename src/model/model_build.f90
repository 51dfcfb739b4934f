!> From a deck to the structure that is solved.
module model_build
   use bar_build, only: build_bars
   use connected_parts, only: find_parts
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use determinate_joints, only: find_determinate_joints
   use first_pressures, only: find_first_pressures
   use id_checks, only: check_ids
   use joint_build, only: build_joints
   use joint_split, only: split_shared_surfaces
   use load_build, only: build_loads
   use mesh_build, only: build_mesh, marked_sides
   use model_data, only: model_type, n_sections
   use section_build, only: build_sections
   use stage_plan, only: plan_stages, stage_plan_type
   use support_build, only: build_supports
   use surface_build, only: build_surfaces
   implicit none
   private

   public :: build_model

contains

   !> Build MODEL and the PLAN of its stages from DECK; what does not fit together goes to ERRORS, and then neither
   !! is fit to be solved.
   subroutine build_model(deck, model, plan, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(out)        :: model
      type(stage_plan_type), intent(out)   :: plan
      type(deck_error_list), intent(inout) :: errors
      type(marked_sides) :: sides

      if (.not. deck%is_whole) return
      call check_ids(deck, errors)
      call build_mesh(deck, model, sides, errors)
      call build_surfaces(deck, sides, model, errors)
      call split_shared_surfaces(deck, model, errors)
      call build_joints(deck, model, errors)
      call build_bars(deck, model, errors)
      call build_supports(deck, model, errors)
      call build_sections(deck, model, errors)
      call build_loads(deck, model, errors)
      call plan_stages(deck, plan, errors)
      if (.not. any(model%used)) call errors%add(0, 'nothing to solve: expected body elements or interface elements')
      if (errors%any()) return
      call find_parts(model, .false.)          ! bolts that are being tightened connect nothing yet
      call find_determinate_joints(model)
      call find_first_pressures(plan%stages(1)%shares(1), model, errors)
      if (all(model%bars%bolt == 0) .and. n_sections(model) == 0) return
      call find_parts(model, .true.)
      call find_determinate_joints(model)
   end subroutine build_model

end module model_build
