!> Tables of a whole stage, whose rows are kept until its end. Their subjects are increments, distance from the laws,
!! re-analyses or iterations, resultants of joints, forces of bars, bolts and springs.
module stage_tables
   use analysis_state, only: analysis_type, free_norm
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use control_words, only: method_back, method_newton
   use joint_values, only: joint_values_type
   use kinds, only: wp
   use mesh_queries, only: point_of
   use model_data, only: a_matrix, a_spring, bar_nodes, joint_node_id, model_type, n_bars, n_sections
   use page_lines, only: axes
   use result_page, only: page_type
   use step_method, only: reanalyses_shown
   use table_column, only: column
   use table_writer, only: table_type
   use text_tools, only: clean, integer_text, one_of
   use tolerances, only: page_zero
   implicit none
   private

   public :: note_stage_tables

   ! the tables in the order of printing; warnings come before the passes
   integer, parameter, public :: pass_rows = 3, n_stage_tables = 8
   integer, parameter :: increment_rows = 1, distance_rows = 2, slip_rows = 4, resultant_rows = 5, bar_rows = 6, spring_rows = 7, &
                         section_rows = 8

contains

   !> Add the completed increment, with the values of JOINTS, to all TABLES.
   subroutine note_stage_tables(page, method, model, analysis, joints, tables)
      type(page_type), intent(in)             :: page
      integer, intent(in)                     :: method !! of case control
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(joint_values_type), intent(in)     :: joints(:)
      type(table_type), intent(inout)         :: tables(:)

      call note_increment(page, model, analysis, joints, tables(increment_rows))
      if (allocated(analysis%exact) .and. size(joints) > 0) &
         call note_distances(page, model, analysis, joints, tables(distance_rows))
      if (method == method_newton .and. size(joints) > 0) call note_path(page, analysis, tables(distance_rows))
      call note_passes(page, method, analysis, tables(pass_rows))
      call note_slips(page, model, analysis, tables(slip_rows))
      call note_resultants(page, model, analysis, joints, tables(resultant_rows))
      call note_bars(page, model, analysis, tables(bar_rows), tables(spring_rows))
      call note_sections(page, model, analysis, tables(section_rows))
   end subroutine note_stage_tables

   !> A row for each joint, or one row without joints.
   subroutine note_increment(page, model, analysis, joints, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(joint_values_type), intent(in)     :: joints(:)
      type(table_type), intent(inout)         :: table
      real(wp) :: floor
      integer  :: j

      associate (labels => page%labels)
         ! here the unit of LAMBDA ends two characters behind its numbers
         if (.not. table%has_begun()) call table%start('INCREMENTS OF '//page%stage//'   '//page%label, &
            [column('INCR', 'i6'), column('SHARE', 'f8.5'), column('LOAD', 'f7.4'), column('JOINT', 'i11'), column('OPEN', 'i5'), &
             column('LAMBDA MAX', 'es13.5', labels%length, unit_shift=2), column('AT NODE', 'i11', key='of lambda'), &
             column('P MAX', 'es13.5', labels%pressure), column('AT NODE', 'i11', key='of p'), &
             column('JOINT FORCE', 'es13.5', labels%force), column('APPLIED TO', 'es12.5', labels%force), &
             column(['DIFFERENCE', 'UNBALANCED'], 'es11.3', labels%force)])
      end associate
      floor = page_zero*page%largest_force
      do j = min(1, size(joints)), size(joints)
         call table%put('INCR', analysis%increment)
         call table%put('SHARE', analysis%increment_fraction)
         call table%put('LOAD', analysis%fraction)
         if (j > 0) then
            associate (joint => model%joints%list(j), now => joints(j))
               call table%put('JOINT', joint%id)
               call table%put('OPEN', now%n_open)
               call table%put('LAMBDA MAX', now%lambda, page_zero*analysis%largest_lambda)
               call table%put('of lambda', joint_node_id(model, now%lambda_at, 1))
               call table%put('P MAX', now%pressure, page_zero*analysis%largest_p)
               call table%put('of p', joint_node_id(model, max(now%pressed_at, 1), 1), where=now%pressed_at > 0)
               call table%put('JOINT FORCE', now%total%across, floor, where=.not. joint%frame%faces_all_ways)
               call table%put('APPLIED TO', now%applied, floor, where=now%has_applied)
               call table%put('DIFFERENCE', now%total%across - now%applied, floor, where=now%has_applied)
            end associate
         end if
         call table%put('UNBALANCED', free_norm(analysis%unbalanced, analysis%held), floor)
         call table%leave_rest()
         call table%keep_row()
      end do
   end subroutine note_increment

   !> The distance of the joints from their laws.
   subroutine note_distances(page, model, analysis, joints, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(joint_values_type), intent(in)     :: joints(:)
      type(table_type), intent(inout)         :: table
      logical :: has_shear
      integer :: j

      has_shear = any([(model%joints%list(j)%law%shear%given, j = 1, size(joints))])
      associate (p => page%labels%pressure, length => page%labels%length)
         if (.not. table%has_begun()) call table%start('DISTANCE FROM THE LAWS, '//page%stage// &
            ': LARGEST |LAMBDA - LAMBDA LAW| OF THE LARGEST LAMBDA'// &
            one_of(has_shear, ', |TAU - TAU LAW| OF THE LARGEST TAU', ''), &
            [column('INCR', 'i6'), column('JOINT', 'i11'), column('LAMBDA OFF %', 'f13.3'), &
             column('AT NODE', 'i11', key='of lambda'), column(['LAMBDA    ', 'LAMBDA LAW'], 'es13.5', length), &
             column('TAU OFF %', 'f11.3', is_listed=has_shear), column('AT NODE', 'i11', is_listed=has_shear, key='of tau'), &
             column('ALONG', 'a6', is_listed=has_shear), column(['TAU    ', 'TAU LAW'], 'es13.5', p, is_listed=has_shear)])
      end associate
      do j = 1, size(joints)
         call table%put('INCR', analysis%increment)
         call table%put('JOINT', model%joints%list(j)%id)
         associate (normal => joints(j)%distances(1), shear => joints(j)%distances(2))
            if (normal%is_there) then
               call table%put('LAMBDA OFF %', 100.0_wp*clean(normal%relative, page_zero))
               call table%put('of lambda', joint_node_id(model, normal%element, 1))
               call table%put(['LAMBDA    ', 'LAMBDA LAW'], [normal%actual, normal%by_law], page_zero*analysis%largest_lambda)
            end if
            if (shear%is_there) then
               call table%put('TAU OFF %', 100.0_wp*clean(shear%relative, page_zero))
               call table%put('of tau', joint_node_id(model, shear%element, 1))
               call table%put('ALONG', axes(shear%direction))
               call table%put(['TAU    ', 'TAU LAW'], [shear%actual, shear%by_law], page_zero*analysis%largest_p)
            end if
         end associate
         call table%leave_rest()
         call table%keep_row()
      end do
   end subroutine note_distances

   !> The error of path of NEWTON, and the parts of the increment.
   subroutine note_path(page, analysis, table)
      type(page_type), intent(in)     :: page
      type(analysis_type), intent(in) :: analysis
      type(table_type), intent(inout) :: table
      character(9), parameter :: headings(3) = [character(9) :: 'LAMBDA %', 'P %', 'CONTACT %']

      if (.not. table%has_begun()) call table%start('ERROR OF PATH, '//page%stage// &
         ': DISTANCE FROM MANY INCREMENTS, OF THE LARGEST LAMBDA, P, AND OF THE AREA', &
         [column('INCR', 'i6'), column('PARTS', 'i7'), column(headings, 'f12.2')])
      associate (record => analysis%record)
         call table%put('INCR', analysis%increment)
         call table%put('PARTS', record%n_parts)
         call table%put(headings, 100.0_wp*[record%path_error%deflection, record%path_error%pressure, record%path_error%contact])
      end associate
      call table%keep_row()
   end subroutine note_path

   !> The slipping elements before and after each re-analysis, t_1 and t_1' of Fig. 5(b).
   subroutine note_slips(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(table_type), intent(inout)         :: table
      character(11), parameter :: stresses(2, 2) = reshape([character(11) :: 'TAU', 'LIMIT', 'TAU AFTER', 'LIMIT AFTER'], [2, 2])
      real(wp) :: delta_floor, tau_floor
      integer  :: i, k, side

      if (size(analysis%record%slips) == 0 .and. table%is_empty()) return
      associate (length => page%labels%length, pressure => page%labels%pressure)
         if (.not. table%has_begun()) call table%start( &
            'SLIPPING ELEMENTS BEFORE AND AFTER EACH RE-ANALYSIS, '//page%stage//' (POINTS T_1 AND T_1'' OF FIG. 5B)', &
            [column(['INCR', 'PASS'], 'i6'), column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), column('ALONG', 'a6'), &
             column('DELTA', 'es13.5', length), column(stresses(:, 1), 'es13.5', pressure), &
             column('DELTA AFTER', 'es14.5', length), column(stresses(:, 2), 'es13.5', pressure)])
      end associate
      delta_floor = page_zero*analysis%largest_lambda
      tau_floor = page_zero*analysis%largest_p
      do i = 1, size(analysis%record%slips)
         associate (slip => analysis%record%slips(i))
            if (slip%reanalysis > reanalyses_shown + 1 .and. all(analysis%record%slips(:i - 1)%reanalysis < slip%reanalysis)) &
               call table%keep_line('        ...')
            do k = 1, model%mesh%dimension - 1
               if (.not. model%joints%list(model%joints%element(slip%element)%joint)%law%shear(k)%given) cycle
               call table%put(['INCR', 'PASS'], [analysis%increment, slip%reanalysis])
               call table%put([character(7) :: 'ELEMENT', 'NODE 1'], [model%joints%element(slip%element)%id, &
                                                                     joint_node_id(model, slip%element, 1)])
               call table%put('ALONG', axes(k))
               call table%put([character(11) :: 'DELTA', 'DELTA AFTER'], slip%delta(k, :), delta_floor)
               do side = 1, 2 ! before and after
                  call table%put(stresses(:, side), [slip%tau(k, side), slip%limit(side)], tau_floor)
               end do
               call table%keep_row()
            end do
         end associate
      end do
   end subroutine note_slips

   !> The resultants of all joints: force of side 1 on side 2, moment about the centroid of the joint's area.
   subroutine note_resultants(page, model, analysis, joints, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(joint_values_type), intent(in)     :: joints(:)
      type(table_type), intent(inout)         :: table
      character(12) :: headings(7)
      real(wp) :: floors(7), values(7)
      integer  :: j, n

      headings = [character(12) :: 'NORMAL FORCE', 'FORCE '//axes, 'MOMENT '//axes]
      if (model%mesh%dimension == 2) headings(2:5) = [character(12) :: 'SHEAR FORCE', 'FORCE X', 'FORCE Y', 'MOMENT Z']
      n = 2*model%mesh%dimension + 1
      if (.not. table%has_begun()) call table%start( &
         'RESULTANTS OF JOINTS, SIDE 1 ON SIDE 2 (MOMENT ABOUT THE CENTROID OF THE JOINT), '//page%stage, &
         [column('INCR', 'i6'), column('JOINT', 'i11'), column(headings(:4), 'es15.5', page%labels%force), &
          column(headings(5:n), 'es15.5', page%labels%moment)])
      do j = 1, size(model%joints%list)
         associate (joint => model%joints%list(j), total => joints(j)%total)
            values = [total%normal, total%force, total%moment]
            if (model%mesh%dimension == 2) values(2:5) = [total%along(1), total%force(:2), total%moment(3)]
            floors = page_zero*page%largest_force
            floors(5:) = floors(5:)*joint%frame%extent
            call table%put('INCR', analysis%increment)
            call table%put('JOINT', joint%id)
            call table%put(headings(:n), clean(values(:n), floors(:n)))
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
      character(6), parameter :: balance(2) = ['BEFORE', 'AFTER ']
      character(6) :: increment
      real(wp) :: forces(2)
      integer  :: i, k

      if (.not. table%has_begun()) then
         select case (method)
         case (method_newton)
            call table%start('CONVERGENCE HISTORY, '//page%stage//': UNBALANCED FORCE BEFORE AND AFTER EACH ITERATION', &
                             [column(['INCR', 'PART'], 'i6'), column('ITER', 'i8'), column(balance, 'es14.3'), &
                              column('STEP', 'f9.4'), column('CHANGES', 'i9')])
         case (method_back)
            call table%start('ITERATIONS, '//page%stage// &
                             ': LARGEST DEFLECTION, LARGEST PRESSURE OF THE LAWS THERE, LARGEST CHANGE', &
                             [column(['INCR', 'ITER'], 'i6'), column([character(8) :: 'LAMBDA', 'PRESSURE', 'CHANGE'], 'es14.5')])
         case default
            call table%start('RE-ANALYSES AFTER THE COULOMB CHECK, '//page%stage//': EXCESS OVER THE LIMITS', &
                             [column(['INCR', 'PASS'], 'i6'), column(balance, 'es14.5'), &
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
            call table%put('INCR', analysis%increment)
            select case (iteration%part)
            case (1:) ! of NEWTON
               call table%put('PART', iteration%part)
               call table%put('ITER', i)
               forces = [iteration%before, iteration%after]
               do k = 1, 2 ! below the tolerance the digits of an unbalanced force are rounding
                  if (forces(k) <= analysis%tolerance) call table%put(balance(k), 'BELOW TOL')
                  if (.not. forces(k) <= analysis%tolerance) call table%put(balance(k), forces(k))
               end do
               call table%put('STEP', iteration%step)
               call table%put('CHANGES', iteration%changes)
            case (0) ! a re-analysis of STEP
               call table%put('PASS', i)
               call table%put(balance, [iteration%before, iteration%after])
               call table%put('REMOVED %', 100.0_wp*(1.0_wp - iteration%after/max(iteration%before, tiny(1.0_wp))))
               call table%put('SLIPPING', iteration%changes)
            case default ! of BACK
               call table%put('ITER', i)
               call table%put('LAMBDA', iteration%step)
               call table%put([character(8) :: 'PRESSURE', 'CHANGE'], [iteration%before, iteration%after])
            end select
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
         if (.not. bars%has_begun()) call bars%start('BOLT FORCES, AND FORCES OF OTHER BARS (TENSION POSITIVE), '//page%stage, &
            [column('INCR', 'i6'), column([character(7) :: 'BOLT', 'ELEMENT', 'NODE 1', 'NODE 2'], 'i11'), force, longer, &
             column('', 'a', key='state')])
         if (.not. springs%has_begun()) call springs%start( &
            'FORCES OF SPRINGS (CELAS: POSITIVE WHERE NODE 1 IS AHEAD OF NODE 2; CBUSH: NODE 2 OF NODE 1; 0: GROUND), '// &
            page%stage, [column('INCR', 'i6'), column([character(7) :: 'ELEMENT', 'NODE 1', 'NODE 2'], 'i11'), &
                         column('AXIS', 'a6'), force, longer])
      end associate
      floors = page_zero*[page%largest_force, maxval(abs(analysis%u))]
      do i = 1, n_bars(model%mesh)
         associate (bar => model%mesh%bars(i), &
                    values => clean([bar_tension(model, analysis, i), elongation_now(model, analysis, i)], floors))
            if (bar%kind == a_matrix) cycle
            if (bar%kind == a_spring) then
               id = 0
               do k = 1, size(bar_nodes(bar))
                  id(k) = model%mesh%node_id(point_of(model%mesh, bar%nodes(k)))
               end do
               if (bar%ground_first) id = id([2, 1])
               call springs%put('INCR', analysis%increment)
               call springs%put([character(7) :: 'ELEMENT', 'NODE 1', 'NODE 2'], [bar%id, id])
               call springs%put('AXIS', '  '//bar%axis//'  ')
               call springs%put([character(10) :: 'FORCE', 'ELONGATION'], values)
               call springs%keep_row()
            else
               call bars%put('INCR', analysis%increment)
               call bars%put('BOLT', bar%bolt, where=bar%bolt > 0)
               call bars%put([character(7) :: 'ELEMENT', 'NODE 1', 'NODE 2'], [bar%id, model%mesh%node_id(bar%nodes)])
               call bars%put([character(10) :: 'FORCE', 'ELONGATION'], values)
               call bars%put('state', state_of_bolt(bar%tightening%is_in(analysis%stage), analysis%is_elastic(i)), &
                             where=bar%bolt > 0)
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

      if (.not. table%has_begun()) call table%start('BOLT FORCES, SOLID BOLTS (TENSION POSITIVE), '//page%stage, &
         [column('INCR', 'i6'), column([character(7) :: 'BOLT', 'SURFACE'], 'i11'), column('FORCE', 'es37.5', page%labels%force), &
          column('SHORTENED BY', 'es15.5', page%labels%length), column('', 'a', key='state')])
      floors = page_zero*[page%largest_force, maxval(abs(analysis%u))]
      do i = 1, n_sections(model%mesh)
         associate (section => model%mesh%sections(i))
            call table%put([character(7) :: 'INCR', 'BOLT', 'SURFACE'], [analysis%increment, section%bolt, section%surface])
            call table%put('FORCE', section_tension(model, analysis, i), floors(1))
            call table%put('SHORTENED BY', overlap_now(model, analysis, i), floors(2))
            call table%put('state', state_of_bolt(section%tightening%is_in(analysis%stage), analysis%is_locked(i)))
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
