!> The results of one deck, as the main program uses them: opened, written after every increment, closed.
module results
   use analysis_state, only: analysis_type
   use answer_tables, only: print_answer, print_bolts, print_reactions, print_watched, write_bolts
   use body_tables, only: list_bodies, list_condensed
   use body_values, only: body_values_type, fault_of_bodies, find_body_values
   use bolt_answers, only: bolt_answer_type, bolt_history, end_bolts => end_stage, fault_of_bolts, follow_bolts, record_bolts, &
                           start_bolts
   use c_library, only: close_file, lock_folder
   use case_table, only: case_row, is_case, note_case, print_cases, record_cases
   use deck_input, only: deck_type
   use distance_watch, only: default_slope_words
   use distribution, only: subdomain_output_type, distribute_bodies
   use equation_solver, only: equation_system, failure_type
   use finished_stages, only: count_frequencies, count_increment, count_stage, count_type, finished_type, listing_end, &
                              mark_finished, name_companion, record_counts, record_finished, return_to_finished
   use incomplete_results, only: all_complete, give_up_parts, what_is_in_the_way
   use joint_answers, only: fault_of_joints, find_joint_answers, joint_answer
   use joint_tables, only: list_energy, list_joints, plot_joint, write_history
   use joint_values, only: find_cuts, find_joint_values, joint_values_type
   use kinds, only: wp
   use listing_opening, only: write_opening
   use mode_values, only: modes_type
   use model_data, only: model_type
   use node_coupling, only: held_forces
   use range_watch, only: print_warnings, range_watch_type, record_watch, start_watch, warn, watch_increment, watch_stage
   use restart_stream, only: restart_stream_type
   use result_names, only: early_ending, listing_ending, remove_all
   use result_page, only: backbone_table, bend_table, bolt_table, case_names, cases_table, dmig_table, energy_table, joint_table, &
                          loop_table, modes_table, page_type, record_page, pair_modes_table, pair_response_table, pair_table, &
                          response_table, set_labels, shell_table, split_table, table_columns, table_endings, watch_table
   use stage_entries, only: output_all, output_joint, output_last
   use stage_plan, only: stage_name, stage_plan_type
   use stage_tables, only: n_stage_tables, note_stage_tables, pass_rows
   use structural_results, only: list_shell_forces
   use support_reactions, only: find_reactions, reactions_type
   use symmetry_planes, only: cut_type, symmetry_plane
   use table_column, only: csv_titles
   use table_writer, only: table_type
   use text_tools, only: integer_text, one_of, real_text, text_item, upper
   use unit_watch, only: stress_words
   use vibration_tables, only: list_modes
   use vtu_results, only: discard_vtu, finish_vtu, record_vtu, start_vtu, vtu_names, vtu_results_type, write_modes, write_vtu
   use watched_nodes, only: find_watched, record_watched, start_watched, state_at_end, watch_answer, watch_state
   implicit none
   private

   public :: start_results, print_increment, print_stage, print_modes, end_stage, keep_finished_stages, finish_results, &
             discard_results, record_results, record_reference, return_to_rest, show_answers

   type, public :: results_type
      type(count_type)       :: counts
      type(finished_type)    :: finished            !! what the stages have that have ended
      type(page_type)        :: page
      type(watch_answer)     :: watched             !! of the last stage with watched nodes
      type(text_item), allocatable :: kept(:)       !! (stages) the state at the end of a stage from which a later one starts
      type(range_watch_type) :: watch
      character(:), allocatable :: missing_vtu      !! why requested files for ParaView are missing; '': they exist
      character(:), allocatable :: base             !! beginning of the names of the files, folder included
      integer, private :: method = 0                ! of case control
      type(table_type), private :: stage_tables(n_stage_tables) ! of the stage so far
      type(vtu_results_type), private :: vtu
      type(bolt_history), private     :: bolts
      type(joint_values_type), allocatable, private :: joints_now(:) ! after the last increment
      type(bolt_answer_type), allocatable, private  :: bolts_now(:)
      type(cut_type), allocatable, private :: cuts(:) ! (joints) by planes of symmetry
      type(watch_state), private      :: watched_before ! at the end of the last stage
      type(case_row), allocatable, private :: cases(:) ! completed so far; none in a deck without FROM
   end type results_type

contains

   !> Open the files whose names begin with BASE, the CSV files that PLAN asks for among them, and write their heads. Without BASE
   !! the listing goes to the standard output, and no other file is written. OK is false where that fails.
   subroutine start_results(base, deck, model, plan, system, results, ok)
      character(*), intent(in)          :: base
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), intent(in) :: system
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok
      class(subdomain_output_type), allocatable :: subdomains
      type(symmetry_plane), allocatable :: planes(:)
      logical :: is_asked(size(table_endings))
      integer :: i

      call all_complete()
      results%base = base
      results%missing_vtu = ''
      results%method = deck%control%method
      call find_cuts(model, planes, results%cuts)
      call start_bolts(model, planes, results%cuts, results%bolts)
      call start_watched(model, results%watched_before)
      allocate (results%cases(0), results%kept(size(plan%stages)))
      call start_watch(model, results%watch)
      associate (page => results%page, control => deck%control)
         call page%file%start(one_of(base == '', '', base//listing_ending))
         if (control%length_unit /= '') call set_labels(trim(control%length_unit), trim(control%force_unit), page%labels)
         call write_opening(page, deck, model, plan, system)
         if (base /= '' .and. any(plan%stages%output%vtu)) call distribute_bodies(model, system, subdomains)
         call start_vtu(results%vtu, base, page%labels, plan, subdomains)
         ok = .not. page%file%fault
         call page%screen%start('')
      end associate
      if (base == '') return
      is_asked = .true. ! the other CSV files are always written
      is_asked(bolt_table) = size(results%bolts%before) > 0
      is_asked([modes_table, energy_table]) = plan%has_modes
      is_asked(response_table) = plan%has_responses
      is_asked([backbone_table, loop_table]) = plan%has_backbones
      is_asked(bend_table) = plan%has_backbones .and. plan%has_responses
      is_asked([watch_table, split_table]) = plan%has_watched_nodes
      is_asked([pair_table, pair_modes_table, pair_response_table]) = plan%has_pairs .and. &
                                                                      [.true., plan%has_modes, plan%has_responses]
      is_asked(dmig_table) = any(plan%stages%output%dmig)
      is_asked(shell_table) = any(plan%stages%output%forces)
      is_asked(cases_table) = any([(is_case(model%history, i), i = 1, size(plan%stages))])
      do i = 1, size(table_endings)
         if (.not. is_asked(i)) cycle
         associate (table => results%page%tables(i))
            call table%start(base//trim(table_endings(i)))
            ok = ok .and. .not. table%fault
            if (i == dmig_table) call table%put('$ stiffness and mass condensed on the components of ASET')
            if (i /= dmig_table) call table%put(csv_titles(table_columns(i, results%page%labels, model)))
         end associate
      end do
   end subroutine start_results

   !> Note the increment just completed; write the tables that OUTPUT = ALL or JOINT asks for, VTU with STEPS, and the rows of the
   !! CSV files.
   subroutine print_increment(model, plan, analysis, results)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(results_type), intent(inout) :: results
      character(40) :: words

      call count_increment(analysis%record%n_iterations, analysis%record%n_removed, results%counts)
      associate (stage => plan%stages(analysis%stage), page => results%page)
         ! what the page shows in this increment, and the scale of its forces
         page%stage_id = stage%id
         page%stage = upper(stage_name(stage))
         page%place = stage_name(stage)//', increment '//integer_text(analysis%increment)
         page%now = ', '//upper(page%place)//stage%shown_words
         page%label = trim(stage%label)
         page%along_cd = stage%output%along_cd
         if (allocated(page%shown)) deallocate (page%shown)
         if (allocated(stage%shown)) page%shown = stage%shown
         page%largest_force = max(page%largest_force, maxval(abs(analysis%now%load(:, analysis%loaded))))
         if (analysis%is_moved) page%largest_force = &
            max(page%largest_force, maxval(abs(held_forces(model, analysis%all_unbalanced)))) ! forces that move the supports
         if (any(model%joints%element%gap < 0.0_wp)) page%largest_force = &
            max(page%largest_force, maxval(abs(analysis%states%normal%sumf)))              ! forces of interference

         call find_values(model, analysis, results)
         call note_stage_tables(page, results%method, model, analysis, results%joints_now, results%stage_tables)
         call watch_increment(page, model, analysis, results%joints_now, results%method, results%watch)
         if (stage%output%condensed .and. analysis%increment == 1) call list_condensed(page, model, analysis)
         if (stage%output%level >= merge(output_last, output_joint, analysis%increment == size(stage%fractions))) then
            write (words, '(2(a, f8.5))') '   SHARE', analysis%increment_fraction, '   LOAD', analysis%fraction
            call page%file%put('')
            call page%file%put(' '//upper(page%place)//trim(words))
         end if
         if (analysis%increment < size(stage%fractions)) then ! print_stage prints the tables of the last increment
            if (stage%output%level >= output_joint) call list_joints(page, stage%output, model, analysis)
            if (stage%output%level == output_all) call list_bodies(page, stage%output, model, analysis)
         end if
         if (stage%output%steps) call write_vtu(results%vtu, model, plan, analysis)
         if (results%base == '') return
         call write_history(page, model, analysis)
         call write_bolts(page, model, analysis, results%bolts_now)
      end associate
   end subroutine print_increment

   !> The values of joints and bolts after the increment just completed, which all tables read.
   subroutine find_values(model, analysis, results)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(results_type), intent(inout) :: results

      call find_joint_values(model, analysis, results%joints_now)
      call follow_bolts(model, analysis, results%page%largest_force, results%bolts, results%bolts_now)
   end subroutine find_values

   !> Write the results of the completed stage: the tables of its last increment, those of the whole stage, and the answer. FAILURE
   !! is raised where a value of the answer is beyond all bounds.
   subroutine print_stage(model, plan, analysis, results, failure)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(results_type), intent(inout) :: results
      type(failure_type), intent(inout) :: failure
      type(body_values_type) :: bodies
      type(joint_answer), allocatable :: joints(:)
      type(reactions_type) :: reactions
      character(:), allocatable :: fault, title, words
      integer :: before, i

      associate (stage => plan%stages(analysis%stage), page => results%page)
         if (.not. allocated(results%joints_now)) call find_values(model, analysis, results) ! the run has resumed, and ends here
         if (stage%output%level >= output_last) call list_joints(page, stage%output, model, analysis)
         if (stage%output%plot) then
            do i = 1, size(model%joints%list)
               call plot_joint(page, model, analysis, model%joints%list(i))
            end do
         end if
         if (any(stage%output%level == [output_all, output_last])) then
            call list_bodies(page, stage%output, model, analysis)
         else if (stage%output%forces) then
            call list_shell_forces(page, model, analysis, is_listed=.false.)
         end if
         call watch_stage(page, model, analysis, results%watch)
         call find_body_values(model, analysis, bodies)
         words = upper(stress_words(bodies%strained))
         if (bodies%strained > results%counts%digest%strained .and. words /= '') &
            call warn(results%watch, '  WARNING: '//page%stage//': '//words)
         words = default_slope_words(model, analysis, results%watched_before)
         if (words /= '') call warn(results%watch, '  WARNING: '//page%stage//': '//words)
         do i = 1, n_stage_tables
            if (i == pass_rows) call print_warnings(results%watch, page%file)
            call results%stage_tables(i)%print_kept(page%file)
         end do
         call list_energy(page, model, analysis)
         call find_joint_answers(model, results%cuts, analysis, results%joints_now, results%method, page%largest_force, joints)
         fault = fault_of_bodies(bodies)
         if (fault == '') fault = fault_of_joints(model, joints)
         if (fault == '') fault = fault_of_bolts(results%bolts_now)
         if (fault /= '') call failure%raise(page%place//': '//fault// &
                                             ' is too large; are loads, lengths and stiffnesses in consistent units?')
         title = 'ANSWER AT THE END OF '//page%stage//'   '//stage%label
         if (analysis%record%ends_early) title = 'ANSWER WHERE THE RUN ENDED EARLY, '//page%stage//', LOAD '// &
                                          real_text(analysis%fraction)//'   '//stage%label
         before = page%screen%used
         call print_answer(page, title, model, model%history%stages(analysis%stage)%from == 0, bodies, joints)
         call print_bolts(page, model, analysis, results%bolts_now)
         call find_reactions(model, analysis, page%largest_force, reactions)
         call print_reactions(page, model, reactions)
         if (allocated(stage%watched)) then
            call find_watched(model, analysis, stage%watched, stage%pairs, results%watched_before, results%watched)
            call print_watched(page, model, results%watched)
         end if
         call page%file%put_lines(page%screen%text_behind(before)) ! the answer is repeated in the listing
      end associate
      call count_stage(.not. analysis%record%ends_early, bodies, joints, results%bolts_now, results%counts)
      call note_case(model, plan, analysis, bodies, joints, results%bolts_now, results%watched, results%cases)
      call end_bolts(analysis%stage, results%bolts_now, results%bolts)
      results%watched_before = state_at_end(model, analysis)
      if (.not. plan%stages(analysis%stage)%output%steps) call write_vtu(results%vtu, model, plan, analysis)
   end subroutine print_stage

   !> The natural modes about the state at the end of the stage just completed.
   subroutine print_modes(model, plan, stage, modes, results)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      integer, intent(in)               :: stage !! its position
      type(modes_type), intent(in)      :: modes
      type(results_type), intent(inout) :: results
      real(wp), allocatable :: elastic(:) ! frequencies

      elastic = pack(modes%modes%frequency, .not. modes%modes%is_rigid)
      call count_frequencies(elastic, results%counts)
      if (is_case(model%history, stage) .and. size(elastic) > 0) &
         results%cases(size(results%cases))%values(size(case_names)) = elastic(1)
      associate (planned => plan%stages(stage), page => results%page)
         page%stage_id = planned%id
         call list_modes(page, model, planned, modes, results%watch%n_warnings)
         if (results%base /= '' .and. planned%output%vtu) call write_modes(results%vtu, model, planned%id, modes)
      end associate
   end subroutine print_modes

   !> All of a stage of PLAN is in the files: they are kept up to here if the run ends early.
   subroutine end_stage(plan, results)
      type(stage_plan_type), intent(in) :: plan
      type(results_type), intent(inout) :: results

      results%counts%n_warnings = results%watch%n_warnings
      call mark_finished(results%base, results%page, results%vtu, size(plan%stages), results%counts, results%finished)
   end subroutine end_stage

   !> The run cannot continue: keep what the finished stages have. ANY_ENDED is false where none has ended.
   subroutine keep_finished_stages(results, any_ended)
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: any_ended

      call return_to_finished(results%page, results%vtu, results%counts, results%finished, any_ended)
      if (any_ended) results%watch%n_warnings = results%counts%n_warnings
   end subroutine keep_finished_stages

   !> Give the files their names, all or none: OK is false where a file could not be written. Files for ParaView, the largest,
   !! are an exception: where they cannot be written the tables and the listing stay, and MISSING_VTU gives the reason.
   subroutine finish_results(model, plan, failure, results, ok)
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(failure_type), intent(in)    :: failure !! raised: the results end before it
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok
      integer :: i, hold
      logical :: closed, has_vtu

      call lock_folder(results%base(:index(results%base, '/', back=.true.))//'.', hold)
      call remove_all(results%base) ! of two runs of one name the later one leaves its own files only
      results%counts%n_warnings = results%watch%n_warnings
      call print_cases(results%page, model, plan, results%cases)
      call name_companion(results%base, results%page, failure, results%finished, ok)
      do i = 1, size(table_endings)
         if (ok .and. results%page%tables(i)%is_open) call results%page%tables(i)%finish(ok)
      end do
      if (ok) then
         call finish_vtu(results%vtu, has_vtu)
         if (.not. has_vtu) results%missing_vtu = what_is_in_the_way()
         if (.not. has_vtu .and. results%missing_vtu == '') results%missing_vtu = 'is there room on the disk?'
         associate (file => results%page%file)
            call file%put_lines(listing_end(size(plan%stages), results%counts, results%page%place, failure))
            call file%finish(ok)
         end associate
      end if
      if (.not. ok) call discard_results(results)
      if (ok) call all_complete()
      call close_file(hold, closed)
   end subroutine finish_results

   !> Show the answers and the names of the files on the standard output. OK is false where that fails.
   subroutine show_answers(results, ok)
      type(results_type), intent(inout) :: results
      logical, intent(out)              :: ok
      character(:), allocatable :: names
      integer :: i

      ok = .true.
      if (results%base == '') return ! the listing is already there
      names = results%base//listing_ending//' (listing), '//results%base//trim(table_endings(joint_table))
      do i = joint_table + 1, size(table_endings)
         if (results%page%tables(i)%is_named) names = names//', '//trim(table_endings(i))
      end do
      names = names//vtu_names(results%vtu)
      if (results%finished%is_named()) names = names//', '//early_ending//' (ENDED EARLY)'
      call results%page%screen%put('')
      call results%page%screen%put(' RESULTS: '//names)
      call results%page%screen%finish(ok)
   end subroutine show_answers

   !> Discard all partial results of this run; files of another run are not touched.
   subroutine discard_results(results)
      type(results_type), intent(inout) :: results
      integer :: i

      call results%page%file%discard()
      do i = 1, size(table_endings)
         call results%page%tables(i)%discard()
      end do
      call results%page%screen%discard()
      call discard_vtu(results%vtu)
      call give_up_parts()
   end subroutine discard_results

   !> Write all results so far to a restart file, or read them into files that start_results has opened for the same deck. Units
   !! and limits of the tables come from the deck; the date is in the head of the listing.
   subroutine record_results(stream, results)
      type(restart_stream_type), intent(inout) :: stream
      type(results_type), intent(inout)        :: results
      integer :: i

      call stream%part('results_type', 2)
      call record_page(stream, results%page)
      call record_counts(stream, results%counts)
      do i = 1, n_stage_tables
         call results%stage_tables(i)%record(stream)
      end do
      call record_watch(stream, results%watch)
      call record_vtu(results%vtu, stream)
      call record_bolts(stream, results%bolts)
      call record_watched(stream, results%watched_before)
      call record_cases(stream, results%cases)
      do i = 1, size(results%kept)
         call stream%text('kept', results%kept(i)%words)
      end do
      call record_finished(stream, results%base, results%page, results%finished)
   end subroutine record_results

   !> Write or read the results to which those of a stage are referred: they belong to the stage from whose end it starts.
   subroutine record_reference(stream, results)
      type(restart_stream_type), intent(inout) :: stream
      type(results_type), intent(inout)        :: results

      call stream%item('largest_force', results%page%largest_force)
      call record_bolts(stream, results%bolts)
      if (allocated(results%watched_before%u)) call record_watched(stream, results%watched_before)
   end subroutine record_reference

   !> Refer the results of the next stage, an independent case, to the structure at rest.
   subroutine return_to_rest(model, results)
      type(model_type), intent(in)      :: model
      type(results_type), intent(inout) :: results

      results%page%largest_force = 0.0_wp
      call start_watched(model, results%watched_before)
   end subroutine return_to_rest

end module results
