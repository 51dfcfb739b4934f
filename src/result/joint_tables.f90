!> Tables of the joints: interface elements, resultants, re-analyses or iterations, energies.
module joint_tables
   use analysis_state, only: analysis_type
   use case_control, only: method_back, method_newton
   use interface_operator, only: at_first_end
   use joint_laws, only: friction_limit
   use joint_motion, only: find_frame, find_resultant, joint_frame, joint_resultant
   use kinds, only: wp
   use listing_nodes, only: shows_interface
   use listing_table, only: axes, column, column_type, heading, joint_table, listing_table_type, noise, page_type
   use model_data, only: has_gaps, joint_node_id, model_type
   use normal_curve, only: loading_deflection
   use normal_stiffness, only: branch_name, branch_open, force_reached
   use text_tools, only: clean, csv_line_type, integer_text
   implicit none
   private

   public :: history_titles, write_history, list_interface, note_resultants, note_passes, list_energy

contains

   !> The titles of the columns of NAME.joint.csv. GAP and SLID only where the deck has any.
   pure function history_titles(model) result(titles)
      type(model_type), intent(in) :: model
      character(:), allocatable    :: titles

      titles = 'stage,increment,load,joint,element,node1,node2,x,y,z,area,branch,lambda,pressure,force,k_n,'// &
               'branch_x,delta_x,tau_x,k_sx,branch_y,delta_y,tau_y,k_sy,slip'
      if (has_gaps(model)) titles = titles//',gap'
      if (can_slide(model)) titles = titles//',slid_x,slid_y'
   end function history_titles

   !> One row an interface element, for the increment just completed, in the file of the joints. node2 is 0 for the rigid base; a direction without
   !! shear stiffness has no branch.
   subroutine write_history(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(csv_line_type) :: line
      integer  :: i, k, same
      logical  :: gaps, slides

      gaps = has_gaps(model)
      slides = can_slide(model)
      call line%add([page%stage_id, analysis%increment], clean([analysis%fraction]))
      same = line%length                  ! the columns that all rows have in common
      do i = 1, size(model%interface)
         line%length = same
         associate (element => model%interface(i), state => analysis%states(i)%normal)
            call line%add([model%joints(element%joint)%id, element%id, joint_node_id(model, i, 1), joint_node_id(model, i, 2)])
            call line%add(clean([at_first_end(element, model%x), element%area]))
            call line%add(branch_name(state%branch), clean([state%lambda, state%pressure, state%sumf, state%k_n]))
         end associate
         do k = 1, 2
            associate (state => analysis%states(i)%shear(k))
               if (model%joints(model%interface(i)%joint)%law%shear(k)%given) then
                  call line%add(branch_name(state%branch), clean([state%delta, state%tau, state%k_s]))
               else                       ! without a shear law the movement alone is a result
                  call line%add('', clean([analysis%movement(k, i), 0.0_wp, 0.0_wp]))
               end if
            end associate
         end do
         call line%add(merge('1', '0', analysis%states(i)%slips))
         if (gaps) call line%add(clean([model%interface(i)%gap]))
         if (slides) call line%add(clean(analysis%states(i)%shear%slid))
         call page%tables(joint_table)%put(line%text(:line%length))
      end do
   end subroutine write_history

   !> Whether any joint has a coefficient of friction.
   pure logical function can_slide(model)
      type(model_type), intent(in) :: model

      can_slide = any(model%joints%law%has_friction)
   end function can_slide

   !> The interface elements, joint by joint.
   subroutine list_interface(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(9), parameter  :: k_n(1) = ['K_N, USED'] ! in space only in the joint history
      type(listing_table_type) :: table
      real(wp) :: lambda_floor, p_floor, force_floor
      integer  :: i, j

      do j = 1, size(model%joints)
         associate (joint => model%joints(j), state => analysis%states%normal, labels => page%labels)
            call table%start('INTERFACE ELEMENTS OF JOINT '//integer_text(joint%id)//page%now, &
                             [column([character(7) :: 'ELEMENT', 'NODE 1', 'NODE 2'], 'i11'), &
                              column(axes(:model%dimension), 'es13.5', labels%length), column('AREA', 'es13.5', labels%area), &
                              column('BRANCH', 'a8'), column('LAMBDA', 'es13.5', labels%length), &
                              column('P', 'es13.5', labels%pressure), column('FORCE', 'es13.5', labels%force), &
                              column(k_n(:3 - model%dimension), 'es13.5', labels%stiffness(:12))], page%file)
            lambda_floor = noise*analysis%largest_lambda
            p_floor = noise*analysis%largest_p
            force_floor = p_floor*joint%area
            do i = joint%first, joint%last
               if (.not. shows_interface(page, model, i)) cycle
               associate (element => model%interface(i))
                  call table%add([element%id, joint_node_id(model, i, 1), joint_node_id(model, i, 2)])
                  call table%add(clean(at_first_end(element, model%x(:model%dimension, :))))
                  call table%add([element%area])
                  call table%add(branch_name(state(i)%branch))
                  call table%add([clean(state(i)%lambda, lambda_floor), clean(state(i)%pressure, p_floor), &
                                  clean(state(i)%sumf, force_floor)])
                  if (model%dimension == 2) call table%add([clean(state(i)%k_n)])
                  call table%print_row(page%file)
               end associate
            end do
            call list_stiffness(page, model, analysis, j)
            if (allocated(analysis%exact)) call list_removed(page, model, analysis, j)
            if (any(joint%law%shear%given)) call list_shear(page, model, analysis, j)
         end associate
      end do
   end subroutine list_interface

   !> Normal stiffness of the interface elements of joint J: what the increment used, and of which kind, and how far lambda is from
   !! the loading curve at the present p; where there are gaps, of which closing it is the rest.
   subroutine list_stiffness(page, model, analysis, j)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      character(7), parameter  :: kinds(4) = [character(7) :: '0', 'SECANT', 'TANGENT', 'E_U'] ! in the order of analysis_state
      type(listing_table_type) :: table
      real(wp) :: lambda_floor
      integer  :: i

      lambda_floor = noise*analysis%largest_lambda
      associate (joint => model%joints(j), labels => page%labels)
         call table%start('NORMAL STIFFNESS OF JOINT '//integer_text(joint%id)//page%now, &
                          [column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), &
                           column([character(6) :: 'LAMBDA', 'C P**M'], 'es13.5', labels%length), &
                           column('K_N, USED', 'es13.5', labels%stiffness(:12)), &
                           column(pack(['CLOSING', 'GAP    '], has_gaps(model)), 'es13.5', labels%length), column('KIND', 'a9')], &
                          page%file)
         do i = joint%first, joint%last
            if (.not. shows_interface(page, model, i)) cycle
            associate (state => analysis%states(i)%normal)
               call table%add([model%interface(i)%id, joint_node_id(model, i, 1)], [clean(state%lambda, lambda_floor), &
                               clean(loading_deflection(joint%law%normal, max(0.0_wp, state%pressure)), lambda_floor), &
                               clean(state%k_n)])
               if (has_gaps(model)) call table%add(clean([state%lambda + state%gap, state%gap], lambda_floor))
               call table%add(trim(kinds(analysis%record%kind(i))))
               call table%print_row(page%file)
            end associate
         end do
      end associate
   end subroutine list_stiffness

   !> STEP: the elements of joint J that the increment has removed, and the force that decided it, which they no longer have.
   subroutine list_removed(page, model, analysis, j)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      type(listing_table_type) :: table
      real(wp) :: lambda_floor, p_floor
      integer  :: i

      lambda_floor = noise*analysis%largest_lambda
      p_floor = noise*analysis%largest_p
      associate (joint => model%joints(j), labels => page%labels)
         call table%start('ELEMENTS REMOVED FROM JOINT '//integer_text(joint%id)//page%now, &
                          [column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), &
                           column([character(13) :: 'SIGMAF', 'SUMF, DECIDED'], ['es13.5', 'es15.5'], labels%force), &
                           column('LAMBDA B', 'es13.5', labels%length)])
         do i = joint%first, joint%last
            if (.not. shows_interface(page, model, i)) cycle
            associate (state => analysis%states(i)%normal, area => model%interface(i)%area)
               if (state%branch /= branch_open .or. force_reached(state) >= 0.0_wp) cycle
               call table%add([model%interface(i)%id, joint_node_id(model, i, 1)])
               call table%add([clean([state%sigmaf, force_reached(state)], p_floor*area), clean(state%lambda_b, lambda_floor)])
               call table%keep_row()
            end associate
         end do
         call table%print_kept(page%file)
      end associate
   end subroutine list_removed

   !> Shear of the interface elements of joint J. LIMIT is mu p.
   subroutine list_shear(page, model, analysis, j)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      type(listing_table_type) :: table
      real(wp) :: delta_floor, tau_floor
      integer  :: i, k

      associate (joint => model%joints(j), labels => page%labels)
         delta_floor = noise*analysis%largest_lambda
         tau_floor = noise*analysis%largest_p
         do k = 1, model%dimension - 1
            if (.not. joint%law%shear(k)%given) cycle
            call table%start('SHEAR IN DIRECTION '//axes(k)//' OF JOINT '//integer_text(joint%id)//page%now, &
                             [column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), column('BRANCH', 'a8'), &
                              column([character(9) :: 'DELTA', 'TAU', 'FORCE', 'K_S, USED', 'LIMIT'], 'es13.5', &
                                     [labels%length, labels%pressure, labels%force, labels%stiffness, labels%pressure], &
                                     unit_shift=1), column('', 'a')], page%file)
            do i = joint%first, joint%last
               if (.not. shows_interface(page, model, i)) cycle
               associate (state => analysis%states(i)%shear(k), element => model%interface(i))
                  call table%add([element%id, joint_node_id(model, i, 1)])
                  call table%add(branch_name(state%branch), [clean(state%delta, delta_floor), clean(state%tau, tau_floor), &
                                  clean(state%tau*element%area, tau_floor*element%area), clean(state%k_s)])
                  call table%add([clean(friction_limit(joint%law, analysis%states(i)%normal%pressure), tau_floor)], &
                                 where=[joint%law%has_friction])
                  if (analysis%states(i)%slips) call table%add('  SLIPS')
                  call table%print_row(page%file)
               end associate
            end do
         end do
      end associate
   end subroutine list_shear

   !> Note the resultants of all joints after the increment just completed: force of side 1 on side 2, moment about the
   !! centroid of the joint's area.
   subroutine note_resultants(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      character(12) :: headings(7)
      type(joint_frame)     :: frame
      type(joint_resultant) :: total
      real(wp) :: floor
      integer  :: j

      headings = [character(12) :: 'NORMAL FORCE', 'FORCE '//axes, 'MOMENT '//axes]
      if (model%dimension == 2) headings(2:5) = [character(12) :: 'SHEAR FORCE', 'FORCE X', 'FORCE Y', 'MOMENT Z']
      if (table%is_empty()) call table%start( &
         'RESULTANTS OF JOINTS, SIDE 1 ON SIDE 2 (MOMENT ABOUT THE CENTROID OF THE JOINT), '//page%stage, &
         [column('INCR', 'i6'), column('JOINT', 'i11'), column(headings(:4), 'es15.5', page%labels%force), &
          column(headings(5:2*model%dimension + 1), 'es15.5', page%labels%moment)])
      floor = noise*page%largest_force
      do j = 1, size(model%joints)
         associate (joint => model%joints(j))
            frame = find_frame(model, joint)
            total = find_resultant(model, analysis, joint, frame)
            call table%add([analysis%increment, joint%id])
            if (model%dimension == 3) then
               call table%add(clean([total%normal, total%force], floor))
               call table%add(clean(total%moment, floor*frame%extent))
            else
               call table%add(clean([total%normal, total%along(1), total%force(:2)], floor))
               call table%add([clean(total%moment(3), floor*frame%extent)])
            end if
            call table%keep_row()
         end associate
      end do
   end subroutine note_resultants

   !> Note the re-analyses after the Coulomb check, or the iterations, of the increment just completed.
   subroutine note_passes(page, method, analysis, table)
      type(page_type), intent(in)             :: page
      integer, intent(in)                     :: method
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      integer, parameter :: shown = 8 ! of many passes
      character(6) :: increment
      integer :: i

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
               call add_unbalanced(iteration%before)
               call add_unbalanced(iteration%after)
               call table%add([iteration%step])
               call table%add([iteration%changes])
            else
               call table%add([analysis%increment, i])
               if (iteration%part < 0) call table%add([iteration%step])
               call table%add([iteration%before, iteration%after])
               if (iteration%part == 0) then
                  call table%add([100.0_wp*(1.0_wp - iteration%after/max(iteration%before, tiny(1.0_wp)))])
                  call table%add([iteration%changes])
               end if
            end if
            call table%keep_row()
         end associate
      end do

   contains

      !> Below the tolerance the digits of an unbalanced FORCE are those of rounding.
      subroutine add_unbalanced(force)
         real(wp), intent(in) :: force

         if (force <= analysis%tolerance) then
            call table%add('BELOW TOL')
         else
            call table%add([force])
         end if
      end subroutine add_unbalanced

   end subroutine note_passes

   !> Work done on the joints in the stage, by normal forces, by shear and on friction; of the first two the difference is lost where
   !! the stage closes a loop, what friction takes is lost at once.
   subroutine list_energy(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(10), parameter :: names(3) = [character(10) :: 'PUT IN', 'GIVEN BACK', 'KEPT']
      type(listing_table_type) :: table
      type(column_type), allocatable :: columns(:)
      real(wp) :: floor
      integer  :: j, k
      logical  :: slides

      if (size(model%joints) == 0) return
      slides = any(model%joints%law%has_friction)
      call heading(page%file, 'ENERGY OF JOINTS, '//page%stage)
      call page%file%put('                 ------------- NORMAL -------------------   -------------- SHEAR -------------------'// &
                         trim(merge('   SLIDING', '          ', slides)))
      columns = [column('JOINT', 'i11', heading_shift=-1), column(names, ['es14.5', 'es13.5', 'es13.5']), &
                 column(names, ['es15.5', 'es13.5', 'es13.5'])]
      if (slides) columns = [columns, column('LOST', 'es15.5')]
      call table%start('', columns, page%file)
      if (page%labels%moment /= '') call page%file%put('                 ('//trim(page%labels%moment)//')')
      do j = 1, size(model%joints)
         associate (energy => analysis%energy(j))
            floor = noise*sum(energy%put_in)
            call table%add([model%joints(j)%id])
            do k = 2, 1, -1
               call table%add(clean([energy%put_in(k), energy%given_back(k), energy%put_in(k) - energy%given_back(k)], floor))
            end do
            if (slides) call table%add(clean([energy%put_in(3)], floor))
            call table%print_row(page%file)
         end associate
      end do
   end subroutine list_energy

end module joint_tables
