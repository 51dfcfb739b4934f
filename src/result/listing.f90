!> The listing NAME.out: increments of each stage, and the tables that OUTPUT asks for.
module listing
   use body_elements, only: element_stress
   use case_control, only: output_all, output_joint, output_last
   use deck_input, only: deck_type
   use equations, only: equation_system
   use joint_statics, only: carried_resultant
   use kinds, only: wp
   use listing_opening, only: heading, label_type, page_width, unit_labels, write_opening
   use model_data, only: model_type, stage_load_type
   use normal_stiffness, only: branch_name, branch_open
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use step_method, only: analysis_type
   use text_tools, only: clean, integer_text, plural, upper
   implicit none
   private

   public :: start_listing, list_increment, list_stage, finish_listing

   real(wp), parameter :: noise = 1.0e-9_wp ! of the largest number of its kind: below it only rounding is printed

   type, public :: listing_type
      type(output_file_type) :: file
      type(label_type) :: labels
      character(page_width), allocatable :: rows(:) ! of the increments of the stage so far
      integer  :: n_rows = 0
      integer  :: n_increments = 0, n_removed = 0
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
      type(equation_system), intent(in) :: system

      call listing%file%start(path)
      listing%labels = unit_labels(deck%control)
      allocate (listing%rows(64))
      call write_opening(listing%file, deck, model, plan, system)
   end subroutine start_listing


   !> Note the increment just completed; print its tables where OUTPUT = ALL or JOINT.
   subroutine list_increment(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      integer :: j

      listing%n_increments = listing%n_increments + 1
      listing%n_removed = listing%n_removed + analysis%n_removed
      listing%largest_force = max(listing%largest_force, maxval(abs(analysis%applied)))
      do j = 1, size(model%joints)
         call add_row(listing, increment_row(listing, model, analysis, j))
      end do
      if (size(model%joints) == 0) call add_row(listing, increment_row(listing, model, analysis, 0))
      associate (stage => plan%stages(analysis%stage))
         if (analysis%increment == size(stage%shares)) return ! the tables of the end of the stage follow
         if (stage%output == output_all .or. stage%output == output_joint) call list_interface(listing, model, plan, analysis)
         if (stage%output == output_all) call list_bodies(listing, model, plan, analysis)
      end associate
   end subroutine list_increment


   !> Print the table of increments of the stage just completed, and the tables of its end.
   subroutine list_stage(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(page_width) :: line
      integer :: i

      associate (stage => plan%stages(analysis%stage), file => listing%file)
         call heading(file, 'INCREMENTS OF STAGE '//integer_text(stage%id)//'   '//trim(stage%label))
         call file%put('  INCR     SHARE    LOAD  JOINT  OPEN   LAMBDA MAX AT NODE        P MAX AT NODE  JOINT FORCE'// &
                       '   APPLIED TO  DIFFERENCE  UNBALANCED')
         if (listing%labels%force /= '') then
            line = ''
            line(42:) = adjustr(listing%labels%length(:9))
            line(59:) = adjustr(listing%labels%pressure(:13))
            line(84:) = adjustr(listing%labels%force(:9))
            line(97:) = adjustr(listing%labels%force(:9))
            line(109:) = adjustr(listing%labels%force(:9))
            line(121:) = adjustr(listing%labels%force(:9))
            call file%put(line)
         end if
         do i = 1, listing%n_rows
            call file%put(listing%rows(i))
         end do
         listing%n_rows = 0
         if (stage%output >= output_last) call list_interface(listing, model, plan, analysis)
         if (stage%output == output_all .or. stage%output == output_last) call list_bodies(listing, model, plan, analysis)
      end associate
   end subroutine list_stage


   subroutine add_row(listing, row)
      type(listing_type), intent(inout) :: listing
      character(*), intent(in)          :: row
      character(page_width), allocatable :: longer(:)

      if (listing%n_rows == size(listing%rows)) then
         allocate (longer(2*listing%n_rows))
         longer(:listing%n_rows) = listing%rows
         call move_alloc(longer, listing%rows)
      end if
      listing%n_rows = listing%n_rows + 1
      listing%rows(listing%n_rows) = row
   end subroutine add_row


   !> One line of the table of increments: joint J after the increment just completed (J = 0: no joints).
   function increment_row(listing, model, analysis, j) result(row)
      type(listing_type), intent(in)  :: listing
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      character(page_width) :: row
      type(stage_load_type) :: now
      real(wp) :: force, applied, floor
      integer  :: i, at_lambda, at_p, n_open

      floor = noise*listing%largest_force
      write (row, '(i6, f10.6, f8.4)') analysis%increment, analysis%share, analysis%fraction
      if (j > 0) then
         associate (joint => model%joints(j), state => analysis%normal)
            n_open = 0; force = 0.0_wp
            at_lambda = joint%first; at_p = joint%first
            do i = joint%first, joint%last
               if (state(i)%branch == branch_open) n_open = n_open + 1
               force = force + state(i)%sumf*dot_product(model%interface(i)%axes(:, 3), joint%normal)
               if (state(i)%lambda > state(at_lambda)%lambda) at_lambda = i
               if (state(i)%pressure > state(at_p)%pressure) at_p = i
            end do
            write (row(25:), '(i7, i6, 2(es13.5, i8), es13.5)') joint%id, n_open, &
               clean(state(at_lambda)%lambda), model%node_id(model%interface(at_lambda)%nodes(1)), &
               clean(state(at_p)%pressure), model%node_id(model%interface(at_p)%nodes(1)), clean(force, floor)
            if (joint%determinate) then
               call current_load(model, analysis, now)
               applied = carried_resultant(model, joint, now)
               write (row(93:), '(es13.5, es12.4)') clean(applied, floor), clean(force - applied, floor)
            end if
         end associate
      end if
      write (row(118:), '(es12.4)') clean(unbalanced_force(model, analysis), floor)
   end function increment_row


   !> The load that acts now, as a list of nodal forces.
   pure subroutine current_load(model, analysis, now)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(stage_load_type), intent(out) :: now
      integer :: node

      allocate (now%node(model%n_nodes), now%force(3, model%n_nodes))
      do node = 1, model%n_nodes
         if (maxval(abs(analysis%applied(:, node))) <= 0.0_wp) cycle
         now%n = now%n + 1
         now%node(now%n) = node
         now%force(:, now%n) = 0.0_wp
         now%force(:model%dimension, now%n) = analysis%applied(:, node)
      end do
   end subroutine current_load


   !> Euclidean norm of what is unbalanced on the free components [force].
   pure real(wp) function unbalanced_force(model, analysis) result(force)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis

      force = sqrt(sum(analysis%unbalanced**2, mask=.not. model%held))
   end function unbalanced_force


   !> The interface elements, joint by joint.
   subroutine list_interface(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(page_width) :: line
      real(wp) :: lambda_floor, p_floor, force_floor
      integer  :: i, j, node2

      do j = 1, size(model%joints)
         associate (joint => model%joints(j), file => listing%file, state => analysis%normal)
            call heading(file, 'INTERFACE ELEMENTS OF JOINT '//integer_text(joint%id)//where_now(plan, analysis))
            call file%put('   ELEMENT   NODE 1   NODE 2            X            Y         AREA  BRANCH       LAMBDA'// &
                          '            P        FORCE    K_N, USED')
            if (listing%labels%force /= '') then
               line = ''
               line(41:) = listing%labels%length
               line(54:) = listing%labels%length
               line(66:) = listing%labels%area
               line(86:) = listing%labels%length
               line(97:) = listing%labels%pressure
               line(112:) = listing%labels%force
               line(123:) = listing%labels%stiffness
               call file%put(line)
            end if
            lambda_floor = noise*maxval(abs(state(joint%first:joint%last)%lambda))
            p_floor = noise*maxval(abs(state(joint%first:joint%last)%pressure))
            force_floor = noise*maxval(abs(state(joint%first:joint%last)%sumf))
            do i = joint%first, joint%last
               associate (element => model%interface(i))
                  node2 = 0
                  if (element%nodes(2) > 0) node2 = model%node_id(element%nodes(2))
                  write (line, '(i10, 2i9, 2es13.5, es13.5, 2x, a6, 4es13.5)') element%id, model%node_id(element%nodes(1)), &
                     node2, clean(model%x(:2, element%nodes(1))), element%area, branch_name(state(i)%branch), &
                     clean(state(i)%lambda, lambda_floor), clean(state(i)%pressure, p_floor), &
                     clean(state(i)%sumf, force_floor), clean(state(i)%k_n)
                  call file%put(line)
               end associate
            end do
         end associate
      end do
   end subroutine list_interface


   !> Displacements, stresses, reactions.
   subroutine list_bodies(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis

      call list_displacements(listing, model, plan, analysis)
      call list_stresses(listing, model, plan, analysis)
      call list_reactions(listing, model, plan, analysis)
   end subroutine list_bodies


   subroutine list_displacements(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(page_width) :: line
      real(wp) :: floor
      integer  :: node

      call heading(listing%file, 'DISPLACEMENTS OF NODES'//where_now(plan, analysis)//in_units(listing%labels%length))
      call listing%file%put('      NODE            X            Y           UX           UY')
      floor = noise*maxval(abs(analysis%u))
      do node = 1, model%n_nodes
         if (.not. model%used(node)) cycle
         write (line, '(i10, 4es13.5)') model%node_id(node), clean(model%x(:2, node)), clean(analysis%u(:, node), floor)
         call listing%file%put(line)
      end do
   end subroutine list_displacements


   subroutine list_stresses(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(page_width) :: line
      real(wp), allocatable :: stress(:, :)
      real(wp) :: floor
      integer  :: e

      if (model%n_elements == 0) return
      allocate (stress(3, model%n_elements))
      do e = 1, model%n_elements
         stress(:, e) = element_stress(model, e, analysis%u)
      end do
      floor = noise*maxval(abs(stress))
      call heading(listing%file, 'STRESSES AT THE CENTRES OF ELEMENTS'//where_now(plan, analysis)// &
                   in_units(listing%labels%pressure))
      call listing%file%put('   ELEMENT     CENTRE X     CENTRE Y      SIGMA X      SIGMA Y       TAU XY')
      do e = 1, model%n_elements
         write (line, '(i10, 5es13.5)') model%element_id(e), &
            clean(0.25_wp*sum(model%x(:2, model%element_nodes(:, e)), dim=2)), clean(stress(:, e), floor)
         call listing%file%put(line)
      end do
   end subroutine list_stresses


   !> Reactions at supports, and the balance of all outer forces: loads, supports, rigid bases.
   subroutine list_reactions(listing, model, plan, analysis)
      type(listing_type), intent(inout) :: listing
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(page_width) :: line
      real(wp) :: reaction(model%dimension), supports(model%dimension), base(model%dimension), loads(model%dimension), floor
      integer  :: i, node

      floor = noise*max(listing%largest_force, tiny(1.0_wp))
      call heading(listing%file, 'REACTIONS AT SUPPORTS'//where_now(plan, analysis)//in_units(listing%labels%force))
      call listing%file%put('      NODE            X            Y           RX           RY')
      supports = 0.0_wp
      do node = 1, model%n_nodes
         if (.not. any(model%held(:, node)) .or. .not. model%used(node)) cycle
         reaction = merge(-analysis%unbalanced(:, node), 0.0_wp, model%held(:, node))
         supports = supports + reaction
         write (line, '(i10, 4es13.5)') model%node_id(node), clean(model%x(:2, node)), clean(reaction, floor)
         call listing%file%put(line)
      end do
      base = 0.0_wp
      do i = 1, size(model%interface)
         if (model%interface(i)%nodes(2) > 0) cycle
         base = base - analysis%normal(i)%sumf*model%interface(i)%axes(:model%dimension, 3)
      end do
      loads = sum(analysis%applied, dim=2)
      call heading(listing%file, 'BALANCE OF FORCES'//where_now(plan, analysis)//in_units(listing%labels%force))
      call listing%file%put('                                               X            Y')
      call balance_line('LOADS', loads)
      call balance_line('SUPPORTS', supports)
      call balance_line('RIGID BASES, THROUGH THE JOINTS', base)
      call balance_line('SUM: LEFT UNBALANCED', loads + supports + base)

   contains

      subroutine balance_line(words, force)
         character(*), intent(in) :: words
         real(wp), intent(in)     :: force(:)

         write (line, '(2x, a, t36, 3es13.5)') words, clean(force, floor)
         call listing%file%put(line)
      end subroutine balance_line

   end subroutine list_reactions


   !> Close the listing under its name.
   subroutine finish_listing(listing, plan, ok)
      type(listing_type), intent(inout) :: listing
      type(stage_plan_type), intent(in) :: plan
      logical, intent(out)              :: ok

      call listing%file%put('')
      call listing%file%put(' END OF LISTING   '//upper(plural(size(plan%stages), 'stage')//', '// &
         plural(listing%n_increments, 'increment')//', '//plural(listing%n_removed, 'interface element'))//' REMOVED')
      call listing%file%finish(ok)
   end subroutine finish_listing


   pure function where_now(plan, analysis) result(words)
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(:), allocatable         :: words

      words = ', STAGE '//integer_text(plan%stages(analysis%stage)%id)//', INCREMENT '//integer_text(analysis%increment)
   end function where_now


   pure function in_units(label) result(words)
      character(*), intent(in)  :: label
      character(:), allocatable :: words

      words = ''
      if (label /= '') words = '   ('//trim(label)//')'
   end function in_units

end module listing
