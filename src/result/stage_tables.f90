!> Tables of a whole stage, whose rows are kept until its end. Their subjects are increments, distance from the laws,
!! re-analyses or iterations, resultants of joints, forces of bars, bolts and springs.
module stage_tables
   use analysis_state, only: analysis_type, free_norm
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use case_control, only: method_back, method_newton
   use determinate_joints, only: carried_resultant
   use joint_resultants, only: find_largest_pressure, find_resultant, joint_resultant
   use kinds, only: wp
   use law_error, only: distance_type, normal_distance, shear_distance
   use model_data, only: a_spring, bar_nodes, joint_node_id, model_type, n_bars, n_sections, point_of, stage_load_type
   use normal_stiffness, only: branch_open
   use numbers, only: first_largest
   use range_watch, only: farthest_type
   use result_page, only: page_type
   use step_method, only: reanalyses_shown
   use table_writer, only: axes, column, noise, table_type
   use text_tools, only: above, clean, integer_text
   implicit none
   private

   public :: note_stage_tables

   ! the tables in the order of printing; warnings come before the passes
   integer, parameter, public :: pass_rows = 3, n_stage_tables = 8
   integer, parameter :: increment_rows = 1, distance_rows = 2, slip_rows = 4, resultant_rows = 5, bar_rows = 6, spring_rows = 7, &
                         section_rows = 8

contains

   !> Add the completed increment to all TABLES, and the distance of the joints from their laws to FARTHEST.
   subroutine note_stage_tables(page, method, model, analysis, tables, farthest)
      type(page_type), intent(in)             :: page
      integer, intent(in)                     :: method !! of case control
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: tables(:)
      type(farthest_type), intent(inout)      :: farthest

      call note_increment(page, model, analysis, tables(increment_rows))
      if (allocated(analysis%exact) .and. size(model%joints) > 0) &
         call note_distances(page, model, analysis, tables(distance_rows), farthest)
      call note_passes(page, method, analysis, tables(pass_rows))
      call note_slips(page, model, analysis, tables(slip_rows))
      call note_resultants(page, model, analysis, tables(resultant_rows))
      call note_bars(page, model, analysis, tables(bar_rows), tables(spring_rows))
      call note_sections(page, model, analysis, tables(section_rows))
   end subroutine note_stage_tables

   !> A row for each joint, or one row without joints.
   subroutine note_increment(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: table
      type(stage_load_type) :: now !! present load
      type(joint_resultant) :: total
      real(wp) :: applied, floor, p_max, unbalanced
      integer  :: at_lambda, at_p, j

      associate (labels => page%labels)
         ! here the unit of LAMBDA ends two characters behind its numbers
         if (table%is_empty()) call table%start('INCREMENTS OF '//page%stage//'   '//page%label, &
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
      floor = noise*page%largest_force
      unbalanced = free_norm(analysis%unbalanced, analysis%held)
      do j = min(1, size(model%joints)), size(model%joints)
         call table%add([analysis%increment], [analysis%increment_fraction, analysis%fraction])
         if (j == 0) then
            call table%skip(9)
         else
            associate (joint => model%joints(j), first => model%joints(j)%first, &
                       state => analysis%states(model%joints(j)%first:model%joints(j)%last)%normal)
               total = find_resultant(model, analysis, joint)
               applied = 0.0_wp
               if (joint%determinate) applied = carried_resultant(model, joint, now)
               at_lambda = first - 1 + first_largest(above(state%lambda, noise*analysis%largest_lambda))
               call find_largest_pressure(analysis, joint, p_max, at_p)
               call table%add([joint%id, count(state%branch == branch_open)], &
                              [clean(maxval(state%lambda), noise*analysis%largest_lambda)])
               call table%add([joint_node_id(model, at_lambda, 1)], [clean(p_max, noise*analysis%largest_p)])
               call table%add([joint_node_id(model, max(at_p, 1), 1)], where=[at_p > 0])
               call table%add([total%across, applied, total%across - applied], floor, &
                              where=[.not. joint%frame%faces_all_ways, joint%determinate, joint%determinate])
            end associate
         end if
         call table%add([unbalanced], floor)
         call table%keep_row()
      end do
   end subroutine note_increment

   !> The distance of the joints from their laws, and its maximum in the run.
   subroutine note_distances(page, model, analysis, table, farthest)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: table
      type(farthest_type), intent(inout)      :: farthest
      character(12), parameter :: quantities(2) = [character(12) :: 'deflection', 'shear stress']
      type(distance_type) :: distances(2)
      real(wp) :: largest(2) ! so far
      logical :: has_shear
      integer :: j, k

      has_shear = any([(model%joints(j)%law%shear%given, j = 1, size(model%joints))])
      associate (p => page%labels%pressure, length => page%labels%length)
         if (table%is_empty()) call table%start('DISTANCE FROM THE LAWS, '//page%stage// &
            ': LARGEST |LAMBDA - LAMBDA LAW| OF THE LARGEST LAMBDA'// &
            trim(merge(', |TAU - TAU LAW| OF THE LARGEST TAU', repeat(' ', 36), has_shear)), &
            [column('INCR', 'i6'), column('JOINT', 'i11'), column('LAMBDA OFF %', 'f13.3'), column('AT NODE', 'i11'), &
             column(['LAMBDA    ', 'LAMBDA LAW'], 'es13.5', length), column('TAU OFF %', 'f11.3', is_listed=has_shear), &
             column('AT NODE', 'i11', is_listed=has_shear), column('ALONG', 'a6', is_listed=has_shear), &
             column(['TAU    ', 'TAU LAW'], 'es13.5', p, is_listed=has_shear)])
      end associate
      largest = [analysis%largest_lambda, analysis%largest_p]
      do j = 1, size(model%joints)
         distances = [normal_distance(model, analysis, j), shear_distance(model, analysis, j)]
         call table%add([analysis%increment, model%joints(j)%id])
         do k = 1, 2
            associate (distance => distances(k))
               if (.not. distance%is_there) call table%skip(4)
               if (.not. distance%is_there) cycle
               call table%add([100.0_wp*clean(distance%relative, noise)])
               call table%add([joint_node_id(model, distance%element, 1)])
               if (distance%direction < 3) call table%add(axes(distance%direction))
               call table%add(clean([distance%actual, distance%by_law], noise*largest(k)))
               if (distance%relative <= farthest%relative) cycle
               farthest%relative = distance%relative
               farthest%node = joint_node_id(model, distance%element, 1)
               farthest%quantity = trim(quantities(k))
               farthest%place = page%place
            end associate
         end do
         call table%keep_row()
      end do
   end subroutine note_distances

   !> The slipping elements before and after each re-analysis, t_1 and t_1' of Fig. 5(b).
   subroutine note_slips(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: table
      real(wp) :: delta_floor, tau_floor
      integer  :: i, k, side

      if (size(analysis%record%slips) == 0) return
      associate (length => page%labels%length, pressure => page%labels%pressure)
         if (table%is_empty()) call table%start( &
            'SLIPPING ELEMENTS BEFORE AND AFTER EACH RE-ANALYSIS, '//page%stage//' (POINTS T_1 AND T_1'' OF FIG. 5B)', &
            [column(['INCR', 'PASS'], 'i6'), column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), column('ALONG', 'a6'), &
             column('DELTA', 'es13.5', length), column([character(5) :: 'TAU', 'LIMIT'], 'es13.5', pressure), &
             column('DELTA AFTER', 'es14.5', length), column([character(11) :: 'TAU AFTER', 'LIMIT AFTER'], 'es13.5', pressure)])
      end associate
      delta_floor = noise*analysis%largest_lambda
      tau_floor = noise*analysis%largest_p
      do i = 1, size(analysis%record%slips)
         associate (slip => analysis%record%slips(i))
            if (slip%reanalysis > reanalyses_shown + 1 .and. all(analysis%record%slips(:i - 1)%reanalysis < slip%reanalysis)) &
               call table%keep_line('        ...')
            do k = 1, model%dimension - 1
               if (.not. model%joints(model%interface(slip%element)%joint)%law%shear(k)%given) cycle
               call table%add([analysis%increment, slip%reanalysis, model%interface(slip%element)%id, &
                               joint_node_id(model, slip%element, 1)])
               call table%add(axes(k))
               do side = 1, 2 ! before and after
                  call table%add([clean(slip%delta(k, side), delta_floor), clean([slip%tau(k, side), slip%limit(side)], tau_floor)])
               end do
               call table%keep_row()
            end do
         end associate
      end do
   end subroutine note_slips

   !> The resultants of all joints: force of side 1 on side 2, moment about the centroid of the joint's area.
   subroutine note_resultants(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: table
      character(12) :: headings(7)
      type(joint_resultant) :: total
      real(wp) :: floors(7), values(7)
      integer  :: j, n

      headings = [character(12) :: 'NORMAL FORCE', 'FORCE '//axes, 'MOMENT '//axes]
      if (model%dimension == 2) headings(2:5) = [character(12) :: 'SHEAR FORCE', 'FORCE X', 'FORCE Y', 'MOMENT Z']
      n = 2*model%dimension + 1
      if (table%is_empty()) call table%start( &
         'RESULTANTS OF JOINTS, SIDE 1 ON SIDE 2 (MOMENT ABOUT THE CENTROID OF THE JOINT), '//page%stage, &
         [column('INCR', 'i6'), column('JOINT', 'i11'), column(headings(:4), 'es15.5', page%labels%force), &
          column(headings(5:n), 'es15.5', page%labels%moment)])
      do j = 1, size(model%joints)
         associate (joint => model%joints(j))
            total = find_resultant(model, analysis, joint)
            values = [total%normal, total%force, total%moment]
            if (model%dimension == 2) values(2:5) = [total%along(1), total%force(:2), total%moment(3)]
            floors = noise*page%largest_force
            floors(5:) = floors(5:)*joint%frame%extent
            call table%add([analysis%increment, joint%id], clean(values(:n), floors(:n)))
            call table%keep_row()
         end associate
      end do
   end subroutine note_resultants

   !> The re-analyses after the Coulomb check, or the iterations.
   subroutine note_passes(page, method, analysis, table)
      type(page_type), intent(in)             :: page
      integer, intent(in)                     :: method
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: table
      integer, parameter :: shown = 8 ! of many passes
      character(6) :: increment
      real(wp) :: forces(2)
      integer  :: i, k

      if (table%is_empty()) then
         select case (method)
         case (method_newton)
            call table%start('CONVERGENCE HISTORY, '//page%stage//': UNBALANCED FORCE BEFORE AND AFTER EACH ITERATION', &
                             [column(['INCR', 'PART'], 'i6'), column('ITER', 'i8'), column(['BEFORE', 'AFTER '], 'es14.3'), &
                              column('STEP', 'f9.4'), column('CHANGES', 'i9')])
         case (method_back)
            call table%start('ITERATIONS, '//page%stage// &
                             ': LARGEST DEFLECTION, LARGEST PRESSURE OF THE LAWS THERE, LARGEST CHANGE', &
                             [column(['INCR', 'ITER'], 'i6'), column(['LAMBDA  ', 'PRESSURE', 'CHANGE  '], 'es14.5')])
         case default
            call table%start('RE-ANALYSES AFTER THE COULOMB CHECK, '//page%stage//': EXCESS OVER THE LIMITS', &
                             [column(['INCR', 'PASS'], 'i6'), column(['BEFORE', 'AFTER '], 'es14.5'), &
                              column('REMOVED %', 'f10.2', heading_shift=1), column('SLIPPING', 'i9', heading_shift=3)])
         end select
      end if
      do i = 1, analysis%record%n_iterations
         if (analysis%record%n_iterations > 3*shown .and. i > shown .and. i < analysis%record%n_iterations) then
            write (increment, '(i6)') analysis%increment
            if (i == shown + 1) call table%keep_line( &
               increment//'   ... '//integer_text(analysis%record%n_iterations - shown - 1)//' MORE ...')
            cycle
         end if
         associate (iteration => analysis%record%iterations(i))
            if (iteration%part > 0) then
               call table%add([analysis%increment, iteration%part, i])
               forces = [iteration%before, iteration%after]
               do k = 1, 2 ! below the tolerance the digits of an unbalanced force are rounding
                  if (forces(k) <= analysis%tolerance) call table%add('BELOW TOL')
                  if (.not. forces(k) <= analysis%tolerance) call table%add(forces(k:k))
               end do
               call table%add([iteration%step])
            else
               call table%add([analysis%increment, i])
               if (iteration%part < 0) call table%add([iteration%step])
               call table%add([iteration%before, iteration%after])
               if (iteration%part == 0) &
                  call table%add([100.0_wp*(1.0_wp - iteration%after/max(iteration%before, tiny(1.0_wp)))])
            end if
            if (iteration%part >= 0) call table%add([iteration%changes])
            call table%keep_row()
         end associate
      end do
   end subroutine note_passes

   !> The forces of all bars, bolts among them, and of all springs.
   subroutine note_bars(page, model, analysis, bars, springs)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: bars, springs
      real(wp) :: floors(2) ! of force and length: rounding becomes zero
      integer  :: i, id(2), k

      associate (force => column('FORCE', 'es15.5', page%labels%force), longer => column('ELONGATION', 'es15.5', &
                                                                                         page%labels%length))
         if (bars%is_empty()) call bars%start('BOLT FORCES, AND FORCES OF OTHER BARS (TENSION POSITIVE), '//page%stage, &
            [column('INCR', 'i6'), column([character(7) :: 'BOLT', 'ELEMENT', 'NODE 1', 'NODE 2'], 'i11'), force, longer, &
             column('', 'a')])
         if (springs%is_empty()) call springs%start( &
            'FORCES OF SPRINGS (CELAS: POSITIVE WHERE NODE 1 IS AHEAD OF NODE 2; CBUSH: NODE 2 OF NODE 1; 0: GROUND), '// &
            page%stage, [column('INCR', 'i6'), column([character(7) :: 'ELEMENT', 'NODE 1', 'NODE 2'], 'i11'), &
                         column('AXIS', 'a6'), force, longer])
      end associate
      floors = noise*[page%largest_force, maxval(abs(analysis%u))]
      do i = 1, n_bars(model)
         associate (bar => model%bars(i), &
                    values => clean([bar_tension(model, analysis, i), elongation_now(model, analysis, i)], floors))
            if (bar%kind == a_spring) then
               id = 0
               do k = 1, size(bar_nodes(bar))
                  id(k) = model%node_id(point_of(model, bar%nodes(k)))
               end do
               if (bar%ground_first) id = id([2, 1])
               call springs%add([analysis%increment, bar%id, id])
               call springs%add('  '//bar%axis//'  ', values)
               call springs%keep_row()
            else
               call bars%add([analysis%increment, bar%bolt], where=[.true., bar%bolt > 0])
               call bars%add([bar%id, model%node_id(bar%nodes)], values)
               if (bar%bolt > 0) call bars%add(state_of_bolt(bar%stage == analysis%stage, analysis%is_elastic(i)))
               call bars%keep_row()
            end if
         end associate
      end do
   end subroutine note_bars

   !> The forces of all solid bolts, and the shortening of each at its pretension section.
   subroutine note_sections(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: table
      real(wp) :: floors(2) ! of force and length
      integer  :: i

      if (table%is_empty()) call table%start('BOLT FORCES, SOLID BOLTS (TENSION POSITIVE), '//page%stage, &
         [column('INCR', 'i6'), column([character(7) :: 'BOLT', 'SURFACE'], 'i11'), column('', 'a22'), &
          column('FORCE', 'es15.5', page%labels%force), column('SHORTENED BY', 'es15.5', page%labels%length), column('', 'a')])
      floors = noise*[page%largest_force, maxval(abs(analysis%u))]
      do i = 1, n_sections(model)
         associate (section => model%sections(i))
            call table%add([analysis%increment, section%bolt, section%surface])
            call table%skip(1)
            call table%add(clean([section_tension(model, analysis, i), overlap_now(model, analysis, i)], floors))
            call table%add(state_of_bolt(section%stage == analysis%stage, analysis%is_locked(i)))
            call table%keep_row()
         end associate
      end do
   end subroutine note_sections

   !> The word behind the forces of a bolt.
   pure function state_of_bolt(is_tightened, is_locked) result(word)
      logical, intent(in) :: is_tightened, is_locked
      character(10) :: word

      word = ''
      if (is_tightened) word = ' TIGHTENED'
      if (is_locked) word = ' LOCKED'
   end function state_of_bolt

end module stage_tables
