!> jointfem: structures with flexible joints by the step-wise tangent-stiffness method.
!! The program is the flow chart of the method (Edelugo, Fig. 6a), one call a box.
program jointfem
   use analysis_state, only: analysis_type, interface_stiffness, note_largest, start_analysis
   use back_method, only: back_increment
   use block_size, only: check_block_size
   use bolt_locking, only: lock_bolts
   use case_control, only: method_back, method_newton
   use command_line, only: command_type, deck_argument, read_command_line
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type, read_deck
   use equations, only: equation_system, form_body_stiffness, start_equations
   use failed_allocation, only: watch_allocations
   use failures, only: failure_type
   use load_path, only: recover_bodies, start_increment, start_stage
   use machine, only: keep_memory, use_threads
   use model_build, only: build_model
   use model_data, only: model_type
   use newton_method, only: newton_increment
   use progress, only: phase_build, phase_factor, phase_increments, phase_order, phase_recover, phase_write, progress_type
   use results, only: finish_results, print_increment, print_stage, remove_old_results, results_type, start_results
   use run_control, only: end_program, overwrites_input, report_checked, report_errors, report_failure, &
                          report_unreadable, report_unwritten, report_warnings
   use stage_plan, only: factorisations_of, shows_bodies, stage_plan_type
   use step_method, only: accumulate, limit_friction, solve_increment, structure_stiffness
   implicit none
   type(command_type) :: command
   integer :: i, status
   logical :: finished

   call read_command_line(command, finished, status)
   if (finished) call end_program(status)
   call use_threads(command%threads)
   call keep_memory()
   call watch_allocations()
   do i = 1, size(command%decks)
      call analyse(command%decks(i))
   end do
   call end_program(status)

contains

   subroutine analyse(argument)
      type(deck_argument), intent(in) :: argument
      type(deck_type)       :: deck
      type(deck_error_list) :: errors
      type(model_type)      :: model
      type(stage_plan_type) :: plan
      type(equation_system) :: system
      type(analysis_type)   :: analysis
      type(results_type)    :: results
      type(progress_type)   :: progress
      type(failure_type)    :: failure
      integer :: stage, increment
      logical :: readable, ok

      ! ------------------------------------------------------------------ READ THE DATA
      call progress%start(argument%name, command%quiet, command%times)
      call read_deck(argument%path, deck, errors, readable)
      if (.not. readable) then
         call progress%clear()
         call report_unreadable(argument)
         return
      else if (overwrites_input(argument, deck)) then
         return
      end if
      if (.not. command%check_only) call remove_old_results(argument%base)

      ! ------------------------------------------------------------------ BODIES, JOINTS, LOADS
      call progress%enter(phase_build)
      if (.not. (command%check_only .or. errors%any())) call check_block_size(deck, failure)
      if (failure%raised) then
         call report_failure(argument, failure, results)
         return
      end if
      call build_model(deck, model, plan, errors)
      if (errors%any()) then
         call progress%clear()
         call report_errors(deck, errors)
         return
      else if (command%check_only) then
         call progress%clear()
         call report_checked(argument, model, plan)
         return
      end if

      ! ------------------------------------------------------------------ [k_b] OF THE BODIES, ONCE
      call progress%enter(phase_order)
      call start_equations(model, system, failure, deck%control%solver, factorisations_of(plan, deck%control%method))
      call progress%enter(phase_factor)
      if (.not. failure%raised) call form_body_stiffness(model, system, failure)
      if (failure%raised) then
         call progress%clear()
         call report_failure(argument, failure, results)
         return
      end if
      call progress%enter(phase_write)
      call progress%count_operations(system%tree%fixed_operations, system%tree%moving_operations, &
                                     system%tree%tree%assembly_time)
      call start_results(argument%base, deck, model, plan, system, results, ok)
      if (.not. ok) then
         call report_unwritten(argument, results)
         return
      end if

      ! ------------------------------------------------------------------ NORM, SHEAR: FIRST STIFFNESS OF THE JOINTS
      call start_analysis(model, system, deck%control%carry, deck%control%tolerance, analysis)
      call interface_stiffness(model, analysis)
      call progress%expect(plan)

      do stage = 1, size(plan%stages)
         ! --------------------------------------------------------------- BOLTS OF THE STAGE BEFORE LOCKED, NEXT STAGE
         call progress%enter(phase_increments)
         call lock_bolts(stage, model, system, analysis)
         call start_stage(model, system, stage, analysis)
         do increment = 1, size(plan%stages(stage)%shares)

            ! ------------------------------------------------------------ NEXT INCREMENT OF THE LOAD
            call progress%enter(phase_increments)
            call start_increment(plan, analysis)

            select case (deck%control%method)
            case (method_newton)
               ! --------------------------------------------------------- ITERATE TO EQUILIBRIUM
               call newton_increment(model, plan, analysis, system, failure)

            case (method_back)
               ! --------------------------------------------------------- SECANTS UNTIL THE PRESSURES SETTLE
               call back_increment(model, plan, analysis, system, failure)

            case default ! a box does nothing once one before it has failed
               ! --------------------------------------------------------- [k_s] = SUM [k_b] + SUM [k_int]
               call structure_stiffness(model, plan, analysis, system, failure)

               ! --------------------------------------------------------- SOLVE [k_s] {du} = {dF}
               call solve_increment(model, plan, system, analysis, failure)

               ! --------------------------------------------------------- ACCUMULATE {u}, DEFLECTIONS, FORCES
               call accumulate(model, system, analysis, failure)

               ! --------------------------------------------------------- COULOMB LIMIT EXCEEDED: RE-ANALYSE
               call limit_friction(model, plan, system, analysis, failure)

               ! --------------------------------------------------------- NORM, SHEAR: BRANCHES, NEXT STIFFNESS
               call interface_stiffness(model, analysis)
            end select
            if (failure%raised) then
               call progress%clear()
               call report_failure(argument, failure, results)
               return
            end if

            ! ------------------------------------------------------------ PRINT
            call note_largest(analysis)
            call progress%enter(phase_recover)
            if (analysis%moves .or. shows_bodies(plan, stage, increment)) call recover_bodies(model, system, analysis)
            call progress%enter(phase_write)
            call print_increment(model, plan, analysis, results)
            call progress%advance(stage, increment, size(plan%stages(stage)%shares))
         end do
         call print_stage(model, plan, analysis, results)
      end do
      call finish_results(plan, results, ok)
      call progress%finish()
      call report_warnings(argument, results)
      if (.not. ok) call report_unwritten(argument, results)
   end subroutine analyse

end program jointfem
