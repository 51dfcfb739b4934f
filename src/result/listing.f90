!> The listing NAME.out: increments of each stage, and the tables that OUTPUT asks for.
module listing
   use case_control, only: method_back, method_newton, output_all, output_joint, output_last
   use deck_input, only: deck_type
   use determinate_joints, only: carried_resultant
   use equation_solver, only: equation_system
   use kinds, only: wp
   use listing_bars, only: list_bars, list_sections, note_bars, note_sections
   use listing_bodies, only: list_bodies
   use listing_joints, only: list_energy, list_interface, list_passes, list_resultants, note_passes, note_resultants
   use listing_opening, only: write_opening
   use listing_page, only: heading, in_column, label_type, noise, page_width, unit_labels
   use listing_plot, only: plot_joints
   use model_data, only: joint_node_id, model_type, stage_load_type
   use normal_stiffness, only: branch_open
   use output_file, only: output_file_type
   use range_watch, only: range_watch_type, watch_balance, watch_ranges, watch_unloading
   use row_buffer, only: row_buffer_type
   use stage_plan, only: stage_plan_type
   use analysis_state, only: analysis_type, free_norm
   use text_tools, only: clean, integer_text, plural, upper
   implicit none
   private

   public :: start_listing, list_increment, list_stage, finish_listing

   type, public :: listing_type
      type(output_file_type) :: file
      type(label_type) :: labels
      integer :: method = 0
      type(row_buffer_type) :: increments, resultants, passes, bars, sections ! of the stage so far
      integer  :: n_increments = 0, n_removed = 0
      type(range_watch_type) :: watch
      real(wp) :: largest_force = 0.0_wp            ! ever applied, for the noise
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

      call listing%file%start(path)
      listing%labels = unit_labels(deck%control)
      listing%method = deck%control%method
      call write_opening(listing%file, deck, model, plan, system)
   end subroutine start_listing


   !> Note the increment just completed; print its tables where OUTPUT = ALL or JOINT.
   subroutine list_increment(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      type(stage_load_type) :: now
      real(wp) :: unbalanced
      integer  :: j

      listing%n_increments = listing%n_increments + 1
      listing%n_removed = listing%n_removed + analysis%n_removed
      listing%largest_force = max(listing%largest_force, maxval(abs(analysis%applied(:, analysis%loaded))))
      if (analysis%is_moved) listing%largest_force = &
         max(listing%largest_force, maxval(abs(analysis%all_unbalanced), mask=model%held)) ! what moves the supports
      call current_load(model, analysis, now)
      unbalanced = free_norm(analysis%unbalanced, analysis%held)
      do j = 1, size(model%joints)
         call listing%increments%add(increment_row(listing, model, analysis, now, unbalanced, j))
      end do
      if (size(model%joints) == 0) call listing%increments%add(increment_row(listing, model, analysis, now, unbalanced, 0))
      call note_resultants(model, analysis, listing%largest_force, listing%resultants)
      call note_passes(analysis, listing%passes)
      call note_bars(model, analysis, listing%largest_force, listing%bars)
      call note_sections(model, analysis, listing%largest_force, listing%sections)
      call watch_ranges(model, plan, analysis, listing%watch)
      if (listing%method /= method_back) call watch_unloading(model, plan, analysis, listing%watch)
      associate (stage => plan%stages(analysis%stage))
         if (analysis%increment == size(stage%shares)) return ! the tables of the end of the stage follow
         if (stage%output == output_all .or. stage%output == output_joint) call list_interface( &
            listing%file, listing%labels, model, plan, analysis)
         if (stage%output == output_all) &
            call list_bodies(listing%file, listing%labels, listing%largest_force, model, plan, analysis)
      end associate
   end subroutine list_increment


   !> Print the table of increments of the stage just completed, and the tables of its end.
   subroutine list_stage(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(page_width) :: line
      character(:), allocatable :: words

      words = 'STAGE '//integer_text(plan%stages(analysis%stage)%id)
      associate (stage => plan%stages(analysis%stage), file => listing%file)
         call heading(file, 'INCREMENTS OF STAGE '//integer_text(stage%id)//'   '//trim(stage%label))
         call file%put('  INCR   SHARE   LOAD      JOINT OPEN   LAMBDA MAX    AT NODE        P MAX    AT NODE  JOINT FORCE'// &
                       '  APPLIED TO DIFFERENCE UNBALANCED')
         if (listing%labels%force /= '') then
            line = ''
            line(44:) = in_column(listing%labels%length, 9)
            line(62:) = in_column(listing%labels%pressure, 13)
            line(90:) = in_column(listing%labels%force, 9)
            line(102:) = in_column(listing%labels%force, 9)
            line(113:) = in_column(listing%labels%force, 9)
            line(124:) = in_column(listing%labels%force, 9)
            call file%put(line)
         end if
         call listing%increments%flush(file)
         call watch_balance(model, plan, analysis, listing%largest_force, listing%watch)
         if (listing%watch%rows%n > 0) then
            call file%put('')
            call listing%watch%rows%flush(file)
         end if
         call list_passes_of_method(listing, words)
         call list_resultants(file, listing%labels, words, model%dimension, listing%resultants)
         call list_bars(file, listing%labels, words, listing%bars)
         call list_sections(file, listing%labels, words, listing%sections)
         call list_energy(file, listing%labels, words, model, analysis)
         if (stage%output >= output_last) call list_interface(file, listing%labels, model, plan, analysis)
         if (stage%plot) call plot_joints(file, listing%labels, model, plan, analysis)
         if (stage%output == output_all .or. stage%output == output_last) &
            call list_bodies(file, listing%labels, listing%largest_force, model, plan, analysis)
      end associate
   end subroutine list_stage


   !> What was done in the increments of the stage besides solving once.
   subroutine list_passes_of_method(listing, stage)
      type(listing_type), intent(inout) :: listing
      character(*), intent(in)          :: stage

      select case (listing%method)
      case (method_newton)
         call list_passes(listing%file, 'CONVERGENCE HISTORY, '//stage//': UNBALANCED FORCE BEFORE AND AFTER EACH ITERATION', &
                          '  INCR  PART    ITER        BEFORE         AFTER     STEP  CHANGES', listing%passes)
      case (method_back)
         call list_passes(listing%file, 'ITERATIONS, '//stage//': LARGEST PRESSURE, AND ITS LARGEST CHANGE', &
                          '  INCR  ITER      PRESSURE        CHANGE', listing%passes)
      case default
         call list_passes(listing%file, 'RE-ANALYSES AFTER THE COULOMB CHECK, '//stage//': EXCESS OVER THE LIMITS', &
                          '  INCR  PASS        BEFORE         AFTER  REMOVED %   SLIPPING', listing%passes)
      end select
   end subroutine list_passes_of_method


   !> One line of the table of increments: joint J after the increment just completed (J = 0: no joints).
   function increment_row(listing, model, analysis, now, unbalanced, j) result(row)
      type(listing_type), intent(in)    :: listing
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      type(stage_load_type), intent(in) :: now        !! the load that acts
      real(wp), intent(in)              :: unbalanced !! norm of what is unbalanced on the free components [force]
      integer, intent(in)               :: j
      character(page_width) :: row
      real(wp) :: force, applied, floor
      integer  :: i, at_lambda, at_p, n_open

      floor = noise*listing%largest_force
      write (row, '(i6, f8.5, f7.4)') analysis%increment, analysis%share, analysis%fraction
      if (j > 0) then
         associate (joint => model%joints(j), state => analysis%states%normal)
            n_open = 0; force = 0.0_wp
            at_lambda = joint%first; at_p = joint%first
            do i = joint%first, joint%last
               if (state(i)%branch == branch_open) n_open = n_open + 1
               force = force + state(i)%sumf*dot_product(model%interface(i)%axes(:, 3), joint%normal)
               ! of values that rounding alone tells apart the first counts
               if (state(i)%lambda > state(at_lambda)%lambda + noise*analysis%largest_lambda) at_lambda = i
               if (state(i)%pressure > state(at_p)%pressure + noise*analysis%largest_p) at_p = i
            end do
            write (row(22:), '(i11, i5, 2(es13.5, i11), es13.5)') joint%id, n_open, &
               clean(state(at_lambda)%lambda, noise*analysis%largest_lambda), &
               joint_node_id(model, at_lambda, 1), &
               clean(state(at_p)%pressure, noise*analysis%largest_p), joint_node_id(model, at_p, 1), &
               clean(force, floor)
            if (joint%determinate) then
               applied = carried_resultant(model, joint, now)
               write (row(99:), '(es12.5, es11.3)') clean(applied, floor), clean(force - applied, floor)
            end if
         end associate
      end if
      write (row(122:), '(es11.3)') clean(unbalanced, floor)
   end function increment_row


   !> The load that acts now, as a list of nodal forces.
   pure subroutine current_load(model, analysis, now)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(stage_load_type), intent(out) :: now
      integer :: i

      now%n = size(analysis%loaded)
      allocate (now%node, source=analysis%loaded)
      allocate (now%force(3, now%n), source=0.0_wp)
      do i = 1, now%n
         now%force(:model%dimension, i) = analysis%applied(:, now%node(i))
      end do
   end subroutine current_load


   !> Close the listing under its name.
   subroutine finish_listing(listing, plan, ok)
      type(listing_type), intent(inout) :: listing
      type(stage_plan_type), intent(in) :: plan
      logical, intent(out)              :: ok

      call listing%file%put('')
      call listing%file%put(' END OF LISTING   '//upper(plural(size(plan%stages), 'stage')//', '// &
         plural(listing%n_increments, 'increment')//', '//plural(listing%n_removed, 'interface element'))//' REMOVED, '// &
         upper(plural(listing%watch%n_warnings, 'warning')))
      call listing%file%finish(ok)
   end subroutine finish_listing

end module listing
