!> The listing NAME.out: increments of each stage, and the tables that OUTPUT asks for.
module listing
   use analysis_state, only: analysis_type
   use body_tables, only: list_bodies
   use case_control, only: method_back
   use deck_input, only: deck_type
   use equation_solver, only: equation_system, failure_type
   use joint_tables, only: list_joints, plot_joints
   use kinds, only: wp
   use listing_opening, only: write_opening
   use table_writer, only: axes, column, heading, label_type, table_type, noise, page_type
   use model_data, only: model_type, n_rotations
   use node_coupling, only: held_forces
   use range_watch, only: note_condition, note_division, range_watch_type, record_watch, say_ranges, start_watch, &
                          watch_balance, watch_ranges, watch_shear_laws, watch_unloading
   use restart_stream, only: restart_stream_type
   use stage_entries, only: output_all, output_joint, output_last
   use stage_plan, only: stage_plan_type
   use structural_results, only: list_shell_forces
   use stage_tables, only: farthest_type, n_stage_tables, note_stage_tables, pass_rows
   use text_tools, only: clean, integer_text, plural, upper
   implicit none
   private

   public :: start_listing, list_increment, list_stage, finish_listing, record_listing

   type, public :: listing_type
      type(page_type) :: page
      integer :: method = 0
      type(table_type) :: tables(n_stage_tables) !! of the stage so far
      type(farthest_type) :: farthest !! largest distance from the laws
      character(:), allocatable :: poor_condition !! its last warning, '': none
      character(:), allocatable :: divided        !! message about the last divided increment, '': none
      integer :: n_increments = 0, n_removed = 0
      type(range_watch_type) :: watch
   end type listing_type

contains

   !> Open the listing PATH (empty: standard output) and write the pages before the first increment.
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

   !> The units above the columns, from those of LENGTH and FORCE. (A structure constructor is freed twice by gfortran 12 at -O0.)
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
         page%along_cd = stage%output%along_cd
         if (analysis%increment == 1) then
            if (allocated(page%shown)) deallocate (page%shown)
            if (allocated(stage%shown)) page%shown = stage%shown
         end if
         page%largest_force = max(page%largest_force, maxval(abs(analysis%now%load(:, analysis%loaded))))
         if (analysis%is_moved) page%largest_force = &
            max(page%largest_force, maxval(abs(held_forces(model, analysis%all_unbalanced)))) ! forces that move the supports
         if (any(model%interface%gap < 0.0_wp)) page%largest_force = &
            max(page%largest_force, maxval(abs(analysis%states%normal%sumf)))              ! forces of interference
         call note_stage_tables(page, listing%method, model, plan, analysis, listing%tables, listing%farthest)
         if (analysis%record%condition%is_new) call note_condition(model, plan, analysis, listing%watch, listing%poor_condition)
         call note_division(plan, analysis, listing%watch, listing%divided)
         call watch_ranges(model, analysis, listing%watch)
         if (listing%method /= method_back) then
            call watch_shear_laws(model, plan, analysis, listing%watch)
            call watch_unloading(model, plan, analysis, listing%watch)
         end if
         if (stage%output%condensed .and. analysis%increment == 1) call list_condensed(page, model, analysis)
         if (stage%output%level >= merge(output_last, output_joint, analysis%increment == size(stage%fractions))) then
            write (words, '(2(a, f8.5))') '   SHARE', analysis%increment_fraction, '   LOAD', analysis%fraction
            call page%file%put('')
            call page%file%put(' '//page%stage//', INCREMENT '//integer_text(analysis%increment)//trim(words))
         end if
         if (analysis%increment == size(stage%fractions)) return ! list_stage prints its tables
         if (stage%output%level >= output_joint) call list_joints(page, stage%output, model, analysis)
         if (stage%output%level == output_all) call list_bodies(page, stage%output, model, analysis)
      end associate
   end subroutine list_increment

   !> Print the tables of the last increment of the completed stage, and then those of the stage.
   subroutine list_stage(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      integer :: i

      associate (stage => plan%stages(analysis%stage), page => listing%page)
         if (stage%output%level >= output_last) call list_joints(page, stage%output, model, analysis)
         if (stage%output%plot) call plot_joints(page, model, analysis)
         if (any(stage%output%level == [output_all, output_last])) then
            call list_bodies(page, stage%output, model, analysis)
         else if (stage%output%forces) then
            call list_shell_forces(page, model, analysis, is_listed=.false.)
         end if
         call say_ranges(model, plan, analysis, listing%watch)
         call watch_balance(model, plan, analysis, page%largest_force, listing%watch)
         do i = 1, n_stage_tables
            if (i == pass_rows) call listing%watch%rows%print_kept(page%file)
            call listing%tables(i)%print_kept(page%file)
         end do
         call list_energy(page, model, analysis)
      end associate
   end subroutine list_stage

   !> Work on the joints in the stage, by normal forces, by shear and on friction. Over a closed loop the difference of work put
   !! in and given back is lost; the work on friction is lost at once.
   subroutine list_energy(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(10), parameter :: names(3) = [character(10) :: 'PUT IN', 'GIVEN BACK', 'KEPT']
      type(table_type) :: table
      real(wp) :: floor
      integer  :: j, k
      logical  :: slides

      if (size(model%joints) == 0) return
      slides = any(model%joints%law%has_friction)
      call heading(page%file, 'ENERGY OF JOINTS, '//page%stage)
      call page%file%put('                 ------------- NORMAL -------------------   -------------- SHEAR -------------------'// &
                         trim(merge('   SLIDING', '          ', slides)))
      call table%start('', [column('JOINT', 'i11', heading_shift=-1), column(names, ['es14.5', 'es13.5', 'es13.5']), &
                            column(names, ['es15.5', 'es13.5', 'es13.5']), column('LOST', 'es15.5', is_listed=slides)], page%file)
      if (page%labels%moment /= '') call page%file%put('                 ('//trim(page%labels%moment)//')')
      do j = 1, size(model%joints)
         associate (energy => analysis%energy(j))
            floor = noise*sum(energy%put_in)
            call table%add([model%joints(j)%id])
            do k = 2, 1, -1
               call table%add([energy%put_in(k), energy%given_back(k), energy%put_in(k) - energy%given_back(k)], floor)
            end do
            call table%add(energy%put_in(3:), floor)
            call table%print_row(page%file)
         end associate
      end do
   end subroutine list_energy

   !> [k_b] condensed on the joint unknowns, and the condensed loads before and after the stage; columns in groups.
   subroutine list_condensed(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, parameter :: across = 8
      type(table_type) :: table
      character(12), allocatable :: names(:)
      real(wp), allocatable :: scale(:)
      real(wp) :: k_floor, load_floor
      integer  :: i, first, k, last, n

      associate (condensed => analysis%record%condensed)
         if (condensed%problem /= '') then
            call heading(page%file, '[K_B] CONDENSED ON THE INTERFACE, '//page%stage//': NOT PRINTED, '//upper(condensed%problem))
            return
         end if
         n = size(condensed%node)
         k_floor = noise*maxval(abs(condensed%k))
         load_floor = noise*max(page%largest_force, maxval(abs(condensed%load)))
         allocate (names(n))
         allocate (scale(n), source=1.0_wp)
         do i = 1, n ! 12Y, or 900RZ for a rotation of node 900, whose rows hold moments over its arm
            associate (node => condensed%node(i), d => condensed%direction(i))
               k = 0
               if (n_rotations(model) > 0) k = findloc(model%rotations%node, node, dim=1)
               if (k == 0) names(i) = integer_text(model%node_id(node))//axes(d)
               if (k == 0) cycle
               names(i) = integer_text(model%node_id(model%rotations(k)%point))//'R'//axes(merge(d, 3, model%dimension == 3))
               scale(i) = model%rotations(k)%arm
            end associate
         end do
         do first = 1, n, across
            last = min(n, first + across - 1)
            call table%start('[K_B] CONDENSED ON THE INTERFACE, '//page%stage, &
                             [column('UNKNOWN', 'a13'), column(names(first:last), 'es13.5', page%labels%stiffness)], page%file)
            do i = 1, n
               call table%add(adjustr(names(i)))
               call table%add(clean(condensed%k(i, first:last), k_floor)*scale(i)*scale(first:last))
               call table%print_row(page%file)
            end do
         end do
         call table%start('LOAD CONDENSED ON THE INTERFACE, '//page%stage//': AN INCREMENT BRINGS ITS SHARE OF THE DIFFERENCE', &
                          [column('UNKNOWN', 'a13'), column([character(10) :: 'BEFORE', 'AFTER', 'DIFFERENCE'], 'es13.5', &
                           page%labels%force)], page%file)
         do i = 1, n
            call table%add(adjustr(names(i)))
            call table%add(clean([condensed%load(i, :), condensed%load(i, 2) - condensed%load(i, 1)], load_floor)*scale(i))
            call table%print_row(page%file)
         end do
      end associate
   end subroutine list_condensed

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

   !> Write the present listing and its state to a restart file, or read them into a listing that start_listing has opened for
   !! the same deck. Units and limits of the tables come from the deck; the date is in the head.
   subroutine record_listing(stream, listing)
      type(restart_stream_type), intent(inout) :: stream
      type(listing_type), intent(inout)        :: listing
      integer :: i, n_shown

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
      do i = 1, n_stage_tables
         call listing%tables(i)%record(stream)
      end do
      call record_watch(stream, listing%watch)
   end subroutine record_listing

end module listing
