!> jointfem: structures with flexible joints by the step-wise tangent-stiffness method. The program is the flow chart of the
!! method (Edelugo, Fig. 6a), one call for each box. After an error that ends the run, the remaining boxes do nothing.
program jointfem
   use analysis_state, only: analysis_type, interface_stiffness
   use back_method, only: back_increment
   use control_words, only: method_back, method_newton, method_step
   use command_line, only: command_type, deck_argument
   use deck_input, only: deck_type
   use equation_solver, only: equation_system
   use load_path, only: start_increment, start_stage
   use model_data, only: model_type
   use newton_method, only: close_gaps, crosses_gaps, newton_increment
   use run_boxes, only: another_increment, another_stage, build_structure, form_bodies, go_on, print_increment, read_data, &
                        start_joints, start_program
   use run_of_deck, only: finish_run, run_type
   use run_summary, only: end_program, summary_row
   use restart_file, only: go_to_start
   use side_by_side, only: another_run
   use stage_plan, only: stage_plan_type
   use step_method, only: accumulate, limit_friction, solve_increment, structure_stiffness
   implicit none
   type(command_type) :: command
   type(summary_row), allocatable :: rows(:)
   integer :: i = 0

   call start_program(command)
   allocate (rows(size(command%decks)))
   do while (another_run(command, rows, i))
      call analyse(command%decks(i), rows(i))
   end do
   call end_program(command, rows)

contains

   !> Solve the deck of ARGUMENT; ROW becomes its row of the summary.
   subroutine analyse(argument, row)
      type(deck_argument), intent(in) :: argument
      type(summary_row), intent(out)  :: row
      type(run_type)        :: run
      type(deck_type)       :: deck
      type(model_type)      :: model
      type(stage_plan_type) :: plan
      type(analysis_type)   :: analysis
      class(equation_system), allocatable :: system

      ! ------------------------------------------------------------------ READ THE DATA
      call read_data(command, argument, run, deck)

      ! ------------------------------------------------------------------ BODIES, JOINTS, LOADS
      call build_structure(run, deck, model, plan)

      ! ------------------------------------------------------------------ [k_b] OF THE BODIES, ONCE
      call form_bodies(run, deck, model, plan, system)

      ! ------------------------------------------------------------------ NORM, SHEAR: FIRST STIFFNESS OF THE JOINTS
      call start_joints(run, deck, model, plan, system, analysis)

      do while (another_stage(run, plan, analysis))
         ! --------------------------------------------------------------- NOT IN THE CHART: FROM THE END OF AN EARLIER STAGE
         call go_to_start(run, deck, model, plan, system, analysis)

         ! --------------------------------------------------------------- NEXT STAGE
         if (.not. run%failure%raised) call start_stage(model, system, analysis)

         do while (another_increment(run, plan, analysis))
            ! ------------------------------------------------------------ NEXT INCREMENT OF THE LOAD
            call start_increment(plan, system, analysis)

            select case (deck%control%method)
            case (method_step)
               ! --------------------------------------------------------- [k_s] = SUM [k_b] + SUM [k_int]
               call structure_stiffness(model, plan, analysis, system, run%failure)

               ! --------------------------------------------------------- SOLVE [k_s] {du} = {dF}
               call solve_increment(model, system, analysis, run%failure)

               if (crosses_gaps(analysis, run%failure)) then
                  ! ------------------------------------------------------ NOT IN THE CHART: GAPS CLOSE, NO TANGENT LEADS ACROSS
                  call close_gaps(model, plan, analysis, system, run%failure)
               else
                  ! ------------------------------------------------------ ACCUMULATE {u}, DEFLECTIONS, FORCES
                  call accumulate(model, system, analysis, run%failure)

                  ! ------------------------------------------------------ COULOMB LIMIT EXCEEDED: RE-ANALYSE
                  call limit_friction(model, plan, system, analysis, run%failure)
               end if

               ! --------------------------------------------------------- NORM, SHEAR: BRANCHES, NEXT STIFFNESS
               call interface_stiffness(model, system, analysis, run%failure)

            case (method_newton)
               ! --------------------------------------------------------- ITERATE TO EQUILIBRIUM
               call newton_increment(model, plan, analysis, system, run%failure)

            case (method_back)
               ! --------------------------------------------------------- SECANTS UNTIL THE PRESSURES SETTLE
               call back_increment(model, plan, analysis, system, run%failure)
            end select

            ! ------------------------------------------------------------ PRINT
            call print_increment(run, model, plan, system, analysis)

            ! ------------------------------------------------------------ NOT IN THE CHART: NATURAL MODES, RESTART FILE
            call go_on(run, deck, model, plan, system, analysis)
         end do
      end do
      call finish_run(run, deck, model, plan, row)
   end subroutine analyse

end program jointfem
