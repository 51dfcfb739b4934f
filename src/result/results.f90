!> The results of one deck, as the main program uses them: opened, written after every increment, closed.
module results
   use analysis_state, only: analysis_type
   use answer_tables, only: bolt_columns, print_answer, print_bolts, print_reactions, print_watched, reaction_columns, &
                            split_columns, stage_columns, watch_columns
   use backbone, only: backbone_type
   use bolt_answers, only: bolt_answer_type, bolt_history, find_bolt_answers, keep_bolts, n_bolts, record_bolts, start_bolts
   use c_library, only: close_file, lock_folder
   use deck_input, only: deck_type
   use distribution, only: subdomain_output_type, distribute_bodies
   use equation_solver, only: equation_system, failure_type
   use incomplete_results, only: all_complete, give_up_parts, remove_old, what_is_in_the_way
   use kinds, only: wp
   use listing, only: finish_listing, list_increment, list_stage, listing_type, record_listing, start_listing
   use joint_tables, only: history_titles, write_history
   use table_writer, only: backbone_table, bend_table, bolt_table, csv_titles, energy_table, joint_table, loop_table, &
                            modes_table, &
                            reaction_table, response_table, shell_table, split_table, stage_table, table_endings, watch_table
   use modal_response, only: response_type
   use mode_values, only: modes_type
   use model_data, only: model_type
   use restart_stream, only: restart_stream_type
   use stage_answer, only: fault_of_answer, find_answer, stage_answer_type
   use stage_plan, only: stage_plan_type, where_in_plan
   use structural_results, only: shell_columns
   use support_reactions, only: find_reactions, reactions_type
   use text_tools, only: real_text
   use vibration_tables, only: backbone_columns, bend_columns, energy_columns, list_backbone, list_modes, list_response, &
                               loop_columns, modes_columns, response_columns
   use vtu_lists, only: is_vtu_ending, remove_old_vtu
   use vtu_results, only: discard_vtu, finish_vtu, record_vtu, start_vtu, vtu_names, vtu_results_type, write_modes, write_vtu
   use watched_nodes, only: find_watched, keep_watched, record_watched, start_watched, watch_answer, watch_state
   implicit none
   private

   public :: start_results, print_increment, print_stage, print_modes, print_backbone, print_response, finish_results, &
             discard_results, record_results, remove_old_results, show_answers, is_result_ending

   character(*), parameter, public :: listing_ending = '.out', restart_ending = '.restart'

   !> The values of a run in a row of a batch.
   type, public :: digest_type
      integer  :: stages = 0, increments = 0, iterations = 0 !! completed; iterations or re-analyses
      real(wp) :: u_max = 0.0_wp, mises_max = 0.0_wp         !! the largest at the end of any stage [length], [pressure]
      real(wp) :: strained = 0.0_wp                          !! largest von Mises stress over E, likewise
      real(wp) :: contact = 1.0_wp                           !! smallest share of any joint, likewise
      real(wp) :: safety = huge(1.0_wp)                      !! smallest against slip, likewise; huge: none
      real(wp) :: frequency = -1.0_wp                        !! the first nonzero one of the last stage with modes [1/time]
   end type digest_type

   type, public :: results_type
      type(digest_type)      :: digest
      type(watch_answer)     :: watched       !! of the last stage with watched nodes
      type(listing_type)     :: listing
      logical, private       :: has_table(size(table_endings)) = .false.
      type(vtu_results_type) :: vtu
      type(bolt_history), private :: bolts
      type(watch_state), private :: watched_before      ! likewise, where nodes are watched
      character(:), allocatable :: missing_vtu !! why requested files for ParaView are missing; '': they exist
      character(:), allocatable :: base !! beginning of the names of the files, folder included
   end type results_type

contains

   !> Open the files whose names begin with BASE and write their heads. Without BASE the listing goes to the standard output,
   !! and no other file is written. OK is false where that fails.
   subroutine start_results(base, deck, model, plan, system, results, ok)
      character(*), intent(in)          :: base
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), intent(in) :: system
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok
      class(subdomain_output_type), allocatable :: dealt

      call all_complete()
      results%base = base
      results%missing_vtu = ''
      call start_bolts(model, results%bolts)
      if (plan%has_watched_nodes) call start_watched(model, results%watched_before)
      if (base == '') call start_listing(results%listing, '', deck, model, plan, system)
      if (base /= '') call start_listing(results%listing, base//listing_ending, deck, model, plan, system)
      if (base /= '' .and. any(plan%stages%output%vtu)) call distribute_bodies(model, system, dealt)
      call start_vtu(results%vtu, base, results%listing%page%labels, plan, dealt)
      ok = .not. results%listing%page%file%failed()
      call results%listing%page%screen%start('')
      if (base /= '') call start_tables(model, plan, results, ok)
   end subroutine start_results

   !> Open the CSV files that PLAN asks for, with the titles of their columns.
   subroutine start_tables(model, plan, results, ok)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(results_type), intent(inout) :: results
      logical, intent(inout)            :: ok

      associate (labels => results%listing%page%labels, d => model%dimension)
         call open_table(joint_table, .true., history_titles(model))
         call open_table(stage_table, .true., csv_titles(stage_columns(labels)))
         call open_table(bolt_table, n_bolts(model) > 0, csv_titles(bolt_columns(labels, 1)))
         call open_table(modes_table, plan%has_modes, csv_titles(modes_columns()))
         call open_table(energy_table, plan%has_modes, csv_titles(energy_columns()))
         call open_table(response_table, plan%has_responses, csv_titles(response_columns()))
         call open_table(backbone_table, plan%has_backbones, csv_titles(backbone_columns(labels)))
         call open_table(loop_table, plan%has_backbones, csv_titles(loop_columns()))
         call open_table(bend_table, plan%has_backbones .and. plan%has_responses, csv_titles(bend_columns(labels)))
         call open_table(watch_table, plan%has_watched_nodes, csv_titles(watch_columns(labels, d)))
         call open_table(split_table, plan%has_watched_nodes, csv_titles(split_columns()))
         call open_table(reaction_table, .true., csv_titles(reaction_columns(labels, d)))
         call open_table(shell_table, any(plan%stages%output%forces), csv_titles(shell_columns(labels)))
      end associate

   contains

      subroutine open_table(i, is_wanted, titles)
         integer, intent(in)      :: i
         logical, intent(in)      :: is_wanted
         character(*), intent(in) :: titles

         if (.not. is_wanted) return
         results%has_table(i) = .true.
         associate (table => results%listing%page%tables(i))
            call table%start(results%base//trim(table_endings(i)))
            ok = ok .and. .not. table%failed()
            call table%put(titles)
         end associate
      end subroutine open_table

   end subroutine start_tables

   !> Write the results of the completed increment.
   subroutine print_increment(model, plan, analysis, results)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(results_type), intent(inout) :: results
      type(bolt_answer_type), allocatable :: bolts(:)

      call list_increment(results%listing, model, plan, analysis)
      results%digest%increments = results%digest%increments + 1
      results%digest%iterations = results%digest%iterations + analysis%record%n_iterations
      if (plan%stages(analysis%stage)%output%steps) call write_vtu(results%vtu, model, plan, analysis)
      call find_bolt_answers(model, analysis, results%listing%page%largest_force, results%bolts, bolts)
      if (results%base == '') return
      call write_history(results%listing%page, model, analysis)
      if (n_bolts(model) == 0) return
      call print_bolts(results%listing%page, analysis, bolts, in_answer=.false.)
   end subroutine print_increment

   !> Write the results of the completed stage. FAILURE is raised where a value of its answer is beyond all bounds.
   subroutine print_stage(model, plan, analysis, results, failure)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(results_type), intent(inout) :: results
      type(failure_type), intent(inout) :: failure
      type(stage_answer_type) :: answer
      type(reactions_type)    :: reactions
      character(:), allocatable :: fault, title
      integer :: before

      call list_stage(results%listing, model, plan, analysis)
      associate (stage => plan%stages(analysis%stage), page => results%listing%page)
         call find_answer(model, analysis, results%listing%method, page%largest_force, results%bolts, answer)
         fault = fault_of_answer(model, answer)
         if (fault /= '') call failure%raise(where_in_plan(plan, analysis%stage, analysis%increment)//': '//fault// &
                                             ' is too large; are loads, lengths and stiffnesses in consistent units?')
         title = 'ANSWER AT THE END OF '//page%stage//'   '//stage%label
         if (analysis%record%ends_early) title = 'ANSWER WHERE THE RUN ENDED EARLY, '//page%stage//', LOAD '// &
                                          real_text(analysis%fraction)//'   '//stage%label
         before = page%screen%length()
         call print_answer(page, title, model, answer)
         call print_bolts(page, analysis, answer%bolts, in_answer=.true.)
         call find_reactions(model, analysis, page%largest_force, reactions)
         call print_reactions(page, model, reactions)
         if (allocated(stage%watched)) then
            call find_watched(model, analysis, stage%watched, results%watched_before, results%watched)
            call print_watched(page, model, results%watched)
         end if
         call page%file%put_lines(page%screen%text_behind(before)) ! the answer is repeated in the listing
      end associate
      associate (digest => results%digest)
         digest%stages = digest%stages + 1
         digest%u_max = max(digest%u_max, answer%displacement%value)
         digest%mises_max = max(digest%mises_max, answer%at_node%value)
         digest%strained = max(digest%strained, answer%strained)
         digest%contact = min(digest%contact, minval(answer%joints%contact))
         digest%safety = min(digest%safety, minval(answer%joints%safety, mask=answer%joints%has_safety))
      end associate
      call keep_bolts(answer%bolts, results%bolts)
      if (plan%has_watched_nodes) call keep_watched(model, analysis, results%watched_before)
      if (.not. plan%stages(analysis%stage)%output%steps) call write_vtu(results%vtu, model, plan, analysis)
   end subroutine print_stage

   !> The natural modes about the state at the end of the stage just completed.
   subroutine print_modes(model, plan, stage, modes, results)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage !! its position
      type(modes_type), intent(in)      :: modes
      type(results_type), intent(inout) :: results
      integer :: m

      results%digest%frequency = -1.0_wp
      do m = size(modes%modes), 1, -1
         if (.not. modes%modes(m)%is_rigid) results%digest%frequency = modes%modes(m)%frequency
      end do
      associate (planned => plan%stages(stage), page => results%listing%page)
         page%stage_id = planned%id
         call list_modes(page, model, planned%vibration, modes)
         if (results%base /= '' .and. planned%output%vtu) call write_modes(results%vtu, model, planned%id, modes)
      end associate
   end subroutine print_modes

   !> Frequency and loss of a mode over its amplitude, about that state.
   subroutine print_backbone(model, plan, stage, found, results)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage !! its position
      type(backbone_type), intent(in)   :: found
      type(results_type), intent(inout) :: results

      results%listing%page%stage_id = plan%stages(stage)%id
      call list_backbone(results%listing%page, model, found)
      if (found%problem /= '') results%listing%watch%n_warnings = results%listing%watch%n_warnings + 1
   end subroutine print_backbone

   !> The response to an oscillating load about that state.
   subroutine print_response(plan, stage, response, results)
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage !! its position
      type(response_type), intent(in)   :: response
      type(results_type), intent(inout) :: results

      results%listing%page%stage_id = plan%stages(stage)%id
      call list_response(results%listing%page, response)
      associate (watch => results%listing%watch)
         watch%n_warnings = watch%n_warnings + size(response%missed) + merge(1, 0, size(response%frequency) == 0)
      end associate
   end subroutine print_response

   !> Give the files their names, all or none: OK is false where a file could not be written. Files for ParaView, the largest,
   !! are an exception: where they cannot be written the tables and the listing stay, and MISSING_VTU gives the reason.
   subroutine finish_results(plan, failure, results, ok)
      type(stage_plan_type), intent(in) :: plan
      type(failure_type), intent(in)    :: failure !! raised: the results end before it
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok
      integer :: i, hold
      logical :: closed, has_vtu

      call lock_folder(folder_of(results%base), hold)
      call remove_all(results%base) ! of two runs of one name the later one leaves its own files only
      ok = .true.
      do i = 1, size(table_endings)
         if (ok .and. results%listing%page%tables(i)%is_open) call results%listing%page%tables(i)%finish(ok)
      end do
      if (ok) then
         call finish_vtu(results%vtu, has_vtu)
         if (.not. has_vtu) results%missing_vtu = what_is_in_the_way()
         if (.not. has_vtu .and. results%missing_vtu == '') results%missing_vtu = 'is there room on the disk?'
      end if
      if (ok) call finish_listing(results%listing, plan, failure, ok)
      if (.not. ok) call discard_results(results)
      if (ok) call all_complete()
      call close_file(hold, closed)
   end subroutine finish_results

   !> The folder of the files that begin with BASE.
   pure function folder_of(base) result(folder)
      character(*), intent(in)  :: base
      character(:), allocatable :: folder

      folder = base(:index(base, '/', back=.true.))//'.'
   end function folder_of

   !> Show the answers and the names of the files on the standard output. OK is false where that fails.
   subroutine show_answers(results, ok)
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok
      character(:), allocatable :: names
      integer :: i

      ok = .true.
      if (results%base == '') return ! the listing is already there
      names = results%base//listing_ending//' (listing)'
      names = names//', '//results%base//trim(table_endings(joint_table))
      do i = joint_table + 1, size(table_endings)
         if (results%has_table(i)) names = names//', '//trim(table_endings(i))
      end do
      call results%listing%page%screen%put('')
      call results%listing%page%screen%put(' RESULTS: '//names//vtu_names(results%vtu))
      call results%listing%page%screen%finish(ok)
   end subroutine show_answers

   !> Discard all partial results of this run; files of another run are not touched.
   subroutine discard_results(results)
      type(results_type), intent(inout) :: results
      integer :: i

      call results%listing%page%file%discard()
      do i = 1, size(table_endings)
         call results%listing%page%tables(i)%discard()
      end do
      call results%listing%page%screen%discard()
      call discard_vtu(results%vtu)
      call give_up_parts()
   end subroutine discard_results

   !> Write all results so far to a restart file, or read them into files that start_results has opened for the same deck.
   subroutine record_results(stream, results)
      type(restart_stream_type), intent(inout) :: stream
      type(results_type), intent(inout)        :: results
      integer :: i

      call record_listing(stream, results%listing)
      do i = 1, size(table_endings)
         if (results%listing%page%tables(i)%is_open) call results%listing%page%tables(i)%record(stream)
      end do
      call results%listing%page%screen%record(stream)
      call record_vtu(results%vtu, stream)
      call record_bolts(stream, results%bolts)
      call record_watched(stream, results%watched_before)
      associate (d => results%digest)
         call stream%item(d%stages, d%increments, d%iterations, d%u_max, d%mises_max, d%contact)
         call stream%item(d%safety, d%frequency, d%strained)
      end associate
   end subroutine record_results

   !> Remove the results of an earlier run of the same deck, which are no longer valid.
   subroutine remove_old_results(base)
      character(*), intent(in) :: base
      integer :: hold
      logical :: closed

      if (base == '') return
      call lock_folder(folder_of(base), hold)
      call remove_all(base)
      call close_file(hold, closed)
   end subroutine remove_old_results

   !> Remove the results whose names begin with BASE, none where it is empty.
   subroutine remove_all(base)
      character(*), intent(in) :: base
      integer :: i

      if (base == '') return
      call remove_old(base//listing_ending)
      do i = 1, size(table_endings)
         call remove_old(base//trim(table_endings(i)))
      end do
      call remove_old_vtu(base)
   end subroutine remove_all

   !> Whether ENDING, behind the base, is that of a result file.
   pure logical function is_result_ending(ending)
      character(*), intent(in) :: ending

      is_result_ending = any(ending == [character(22) :: listing_ending, restart_ending, table_endings]) .or. is_vtu_ending(ending)
   end function is_result_ending

end module results
