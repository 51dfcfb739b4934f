!> The listing NAME.out: increments of each stage, and the tables that OUTPUT asks for.
module listing
   use analysis_state, only: analysis_type, free_norm
   use case_control, only: method_back
   use deck_input, only: deck_type
   use determinate_joints, only: carried_resultant
   use equation_solver, only: equation_system
   use failures, only: failure_type
   use joint_motion, only: is_closed
   use kinds, only: wp
   use listing_bars, only: note_bars, note_sections, note_springs
   use listing_bodies, only: list_bodies
   use joint_tables, only: list_energy, list_interface, note_passes, note_resultants
   use listing_opening, only: write_opening
   use listing_plot, only: plot_joints
   use listing_states, only: list_condensed, list_states
   use listing_steps, only: farthest_type, note_distances, note_slips
   use listing_table, only: column, label_type, listing_table_type, noise, page_type
   use model_data, only: joint_node_id, model_type, stage_load_type
   use node_coupling, only: held_forces
   use normal_stiffness, only: branch_open
   use numbers, only: first_largest
   use range_watch, only: note_condition, note_division, range_watch_type, record_watch, say_ranges, start_watch, &
                          watch_balance, watch_ranges, watch_shear_laws, watch_unloading
   use restart_stream, only: restart_stream_type
   use stage_entries, only: output_all, output_joint, output_last
   use stage_plan, only: stage_plan_type
   use text_tools, only: above, clean, integer_text, plural, upper
   implicit none
   private

   public :: start_listing, list_increment, list_stage, finish_listing, record_listing

   type, public :: listing_type
      type(page_type) :: page
      integer :: method = 0
      type(listing_table_type) :: increments, distances, resultants, passes, slips, bars, springs, sections ! of the stage so far
      type(farthest_type) :: farthest !! from the laws
      character(:), allocatable :: poor_condition !! the last warning of it, '': none
      character(:), allocatable :: divided        !! what is said of the last increment that was, '': none
      integer :: n_increments = 0, n_removed = 0
      type(range_watch_type) :: watch
   end type listing_type

contains

   !> Open the listing PATH (empty: standard output) and write what is known before the first increment.
   subroutine start_listing(listing, path, deck, model, plan, system)
      type(listing_type), intent(inout) :: listing
      character(*), intent(in)          :: path
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), intent(in) :: system

      call listing%page%file%start(path)
      listing%method = deck%control%method
      listing%poor_condition = ''
      listing%divided = ''
      if (deck%control%length_unit /= '') call set_labels(trim(deck%control%length_unit), trim(deck%control%force_unit), &
                                                          listing%page%labels)
      call write_opening(listing%page, deck, model, plan, system)
      call start_watch(model, listing%watch)
   end subroutine start_listing

   !> The units that stand over the columns, of those of LENGTH and FORCE.
   pure subroutine set_labels(length, force, labels)
      character(*), intent(in)        :: length, force
      type(label_type), intent(inout) :: labels

      labels%length = length
      labels%force = force
      labels%pressure = force//'/'//length//'2'
      labels%area = length//'2'
      labels%stiffness = force//'/'//length
      labels%moment = force//' '//length
      labels%slope = force//'/'//length//'2/'//length
   end subroutine set_labels

   !> Note the increment just completed; print its tables where OUTPUT = ALL or JOINT.
   subroutine list_increment(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(40) :: words

      listing%n_increments = listing%n_increments + 1
      listing%n_removed = listing%n_removed + analysis%record%n_removed
      associate (stage => plan%stages(analysis%stage), page => listing%page)
         page%stage_id = stage%id
         page%stage = 'STAGE '//integer_text(stage%id)
         page%now = ', '//page%stage//', INCREMENT '//integer_text(analysis%increment)//stage%shown_words
         page%along_cd = stage%along_cd
         if (analysis%increment == 1) then
            if (allocated(page%shown)) deallocate (page%shown)
            if (allocated(stage%shown)) page%shown = stage%shown
         end if
         page%largest_force = max(page%largest_force, maxval(abs(analysis%now%load(:, analysis%loaded))))
         if (analysis%is_moved) page%largest_force = &
            max(page%largest_force, maxval(abs(held_forces(model, analysis%all_unbalanced)))) ! what moves the supports
         if (any(model%interface%gap < 0.0_wp)) page%largest_force = &
            max(page%largest_force, maxval(abs(analysis%states%normal%sumf)))              ! what interference presses
         call note_increment(page, trim(stage%label), model, analysis, listing%increments)
         call note_distances(page, model, plan, analysis, listing%distances, listing%farthest)
         call note_resultants(page, model, analysis, listing%resultants)
         call note_passes(page, listing%method, analysis, listing%passes)
         call note_slips(page, model, analysis, listing%slips)
         call note_bars(page, model, analysis, listing%bars)
         call note_springs(page, model, analysis, listing%springs)
         call note_sections(page, model, analysis, listing%sections)
         if (analysis%record%condition%is_new) call note_condition(model, plan, analysis, listing%watch, listing%poor_condition)
         call note_division(plan, analysis, listing%watch, listing%divided)
         call watch_ranges(model, analysis, listing%watch)
         if (listing%method /= method_back) then
            call watch_shear_laws(model, plan, analysis, listing%watch)
            call watch_unloading(model, plan, analysis, listing%watch)
         end if
         if (stage%condensed .and. analysis%increment == 1) call list_condensed(page, model, analysis)
         if (stage%output == output_all .or. stage%output == output_joint .or. &
             (stage%output == output_last .and. analysis%increment == size(stage%fractions))) then
            write (words, '(2(a, f8.5))') '   SHARE', analysis%increment_fraction, '   LOAD', analysis%fraction
            call page%file%put('')
            call page%file%put(' '//page%stage//', INCREMENT '//integer_text(analysis%increment)//trim(words))
         end if
         if (analysis%increment == size(stage%fractions)) return ! list_stage prints its tables
         if (stage%output == output_all .or. stage%output == output_joint) call list_joints(page, stage%state, model, analysis)
         if (stage%output == output_all) call list_bodies(page, stage%stress, model, analysis)
      end associate
   end subroutine list_increment

   !> Print the tables of the end of the stage just completed, which are those of its last increment, and then its own.
   subroutine list_stage(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      associate (stage => plan%stages(analysis%stage), page => listing%page)
         if (stage%output >= output_last) call list_joints(page, stage%state, model, analysis)
         if (stage%plot) call plot_joints(page, model, analysis)
         if (stage%output == output_all .or. stage%output == output_last) call list_bodies(page, stage%stress, model, analysis)
         call listing%increments%print_kept(page%file)
         call listing%distances%print_kept(page%file)
         call say_ranges(model, plan, analysis, listing%watch)
         call watch_balance(model, plan, analysis, page%largest_force, listing%watch)
         call listing%watch%rows%print_kept(page%file)
         call listing%passes%print_kept(page%file)
         call listing%slips%print_kept(page%file)
         call listing%resultants%print_kept(page%file)
         call listing%bars%print_kept(page%file)
         call listing%springs%print_kept(page%file)
         call listing%sections%print_kept(page%file)
         call list_energy(page, model, analysis)
      end associate
   end subroutine list_stage

   !> The interface elements, and WITH_STATE what they remember.
   subroutine list_joints(page, with_state, model, analysis)
      type(page_type), intent(inout)  :: page
      logical, intent(in)             :: with_state
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis

      call list_interface(page, model, analysis)
      if (with_state) call list_states(page, model, analysis)
   end subroutine list_joints

   !> Note the increment just completed, of the stage with LABEL: a row a joint, or one where there are none.
   subroutine note_increment(page, label, model, analysis, table)
      type(page_type), intent(in)             :: page
      character(*), intent(in)                :: label
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      type(stage_load_type) :: now !! the load that acts
      real(wp) :: unbalanced
      integer  :: j

      associate (labels => page%labels)
         ! in this table the unit of LAMBDA stands two characters behind its numbers
         if (table%is_empty()) call table%start('INCREMENTS OF '//page%stage//'   '//label, &
            [column('INCR', 'i6'), column('SHARE', 'f8.5'), column('LOAD', 'f7.4'), column('JOINT', 'i11'), column('OPEN', 'i5'), &
             column('LAMBDA MAX', 'es13.5', labels%length, unit_shift=2), column('AT NODE', 'i11'), &
             column('P MAX', 'es13.5', labels%pressure), column('AT NODE', 'i11'), &
             column('JOINT FORCE', 'es13.5', labels%force), column('APPLIED TO', 'es12.5', labels%force), &
             column(['DIFFERENCE', 'UNBALANCED'], 'es11.3', labels%force)])
      end associate
      now%n = size(analysis%loaded)
      allocate (now%node, source=analysis%loaded)
      allocate (now%force(3, now%n), source=0.0_wp)
      now%force(:model%dimension, :) = analysis%now%load(:, now%node)
      unbalanced = clean(free_norm(analysis%unbalanced, analysis%held), noise*page%largest_force)
      do j = min(1, size(model%joints)), size(model%joints)
         call table%add([analysis%increment], [analysis%increment_fraction, analysis%fraction])
         if (j > 0) call add_joint(model, analysis, now, j, noise*page%largest_force, table)
         if (j == 0) call table%skip(9)
         call table%add([unbalanced])
         call table%keep_row()
      end do
   end subroutine note_increment

   !> What a row of the table of increments says of joint J.
   subroutine add_joint(model, analysis, now, j, floor, table)
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(stage_load_type), intent(in)       :: now   !! the load that acts
      integer, intent(in)                     :: j
      real(wp), intent(in)                    :: floor !! of forces
      type(listing_table_type), intent(inout) :: table
      real(wp), allocatable :: lambda(:), p(:)
      real(wp) :: force, applied
      integer  :: i, at_lambda, at_p

      associate (joint => model%joints(j), state => analysis%states%normal)
         allocate (lambda(joint%first:joint%last), p(joint%first:joint%last))
         lambda = state(joint%first:joint%last)%lambda
         p = state(joint%first:joint%last)%pressure
         force = 0.0_wp
         do i = joint%first, joint%last
            force = force + state(i)%sumf*dot_product(model%interface(i)%axes(:, 3), joint%normal)
         end do
         at_lambda = joint%first - 1 + first_largest(above(lambda, noise*analysis%largest_lambda))
         at_p = joint%first - 1 + first_largest(above(p, noise*analysis%largest_p))
         call table%add([joint%id, count(state(joint%first:joint%last)%branch == branch_open)], &
                        [clean(maxval(lambda), noise*analysis%largest_lambda)])
         call table%add([joint_node_id(model, at_lambda, 1)], [clean(maxval(p), noise*analysis%largest_p)])
         call table%add([joint_node_id(model, at_p, 1)])
         call table%add([clean(force, floor)], where=[.not. is_closed(model, joint)])
         if (joint%determinate) then
            applied = carried_resultant(model, joint, now)
            call table%add(clean([applied, force - applied], floor))
         else
            call table%skip(2)
         end if
      end associate
   end subroutine add_joint

   !> Close the listing under its name.
   subroutine finish_listing(listing, plan, failure, ok)
      type(listing_type), intent(inout) :: listing
      type(stage_plan_type), intent(in) :: plan
      type(failure_type), intent(in)    :: failure !! raised: the listing ends before it
      logical, intent(out)              :: ok

      call listing%page%file%put('')
      if (failure%raised) then
         call listing%page%file%put(' *** THE RUN ENDED EARLY, ABOVE IS THE LAST STATE IN EQUILIBRIUM ***')
         call listing%page%file%put('  '//upper(failure%message))
         call listing%page%file%put('')
      end if
      call listing%page%file%put(trim(merge(' ENDED EARLY   ', ' END OF LISTING', failure%raised))//'   '// &
         upper(plural(size(plan%stages), 'stage')//', '//plural(listing%n_increments, 'increment')//', '// &
         plural(listing%n_removed, 'interface element'))//' REMOVED, '//upper(plural(listing%watch%n_warnings, 'warning')))
      call listing%page%file%finish(ok)
   end subroutine finish_listing

   !> Write the listing so far, and what it keeps, to a restart file, or read it into one that start_listing has opened for the same
   !! deck. Its units and the way that the tables are limited come from the deck; its date stands in its head.
   subroutine record_listing(stream, listing)
      type(restart_stream_type), intent(inout) :: stream
      type(listing_type), intent(inout)        :: listing
      integer :: n_shown

      associate (page => listing%page, farthest => listing%farthest)
         call page%file%record(stream)
         n_shown = -1
         if (allocated(page%shown)) n_shown = size(page%shown)
         call stream%extent(n_shown, 4)
         if (.not. stream%writes) then
            if (allocated(page%shown)) deallocate (page%shown)
            if (n_shown >= 0) allocate (page%shown(n_shown))
         end if
         if (n_shown >= 0) call stream%item(page%shown)
         call stream%any_text(page%stage)
         call stream%any_text(page%now)
         call stream%any_text(farthest%quantity)
         call stream%any_text(farthest%place)
         call stream%any_text(listing%poor_condition)
         call stream%any_text(listing%divided)
         call stream%item(page%largest_force, farthest%relative, farthest%node, listing%n_increments, listing%n_removed)
      end associate
      call listing%increments%record(stream)
      call listing%distances%record(stream)
      call listing%resultants%record(stream)
      call listing%passes%record(stream)
      call listing%slips%record(stream)
      call listing%bars%record(stream)
      call listing%springs%record(stream)
      call listing%sections%record(stream)
      call record_watch(stream, listing%watch)
   end subroutine record_listing

end module listing
