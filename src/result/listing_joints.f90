!> Tables of the joints: interface elements, resultants, re-analyses or iterations, energies.
module listing_joints
   use analysis_state, only: analysis_type, element_force
   use interface_operator, only: at_first_end
   use joint_laws, only: friction_limit
   use kinds, only: wp
   use listing_page, only: heading, in_column, label_type, noise, page_width, where_now
   use model_data, only: joint_node_id, model_type
   use normal_stiffness, only: branch_name
   use output_file, only: output_file_type
   use row_buffer, only: row_buffer_type
   use stage_plan, only: stage_plan_type
   use text_line, only: text_line_type
   use text_tools, only: clean, integer_text
   implicit none
   private

   public :: list_interface, note_resultants, list_resultants, note_passes, list_passes, list_energy

contains

   !> The interface elements, joint by joint.
   subroutine list_interface(file, labels, model, plan, analysis)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)      :: labels
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(page_width) :: line
      type(text_line_type)  :: row
      real(wp) :: lambda_floor, p_floor, force_floor
      integer  :: i, j

      do j = 1, size(model%joints)
         associate (joint => model%joints(j), state => analysis%states%normal)
            call heading(file, 'INTERFACE ELEMENTS OF JOINT '//integer_text(joint%id)//where_now(plan, analysis))
            if (model%dimension == 3) then
               call file%put('    ELEMENT     NODE 1     NODE 2            X            Y            Z         AREA  BRANCH '// &
                             '      LAMBDA            P        FORCE')
            else
               call file%put('    ELEMENT     NODE 1     NODE 2            X            Y         AREA  BRANCH       LAMBDA'// &
                             '            P        FORCE    K_N, USED')
            end if
            if (labels%force /= '') then
               line = ''
               line(37:) = in_column(labels%length, 10)
               line(50:) = in_column(labels%length, 10)
               line(63:) = in_column(labels%area, 10)
               line(84:) = in_column(labels%length, 10)
               line(94:) = in_column(labels%pressure, 13)
               line(110:) = in_column(labels%force, 10)
               line(121:) = in_column(labels%stiffness, 12)
               if (model%dimension == 3) line = line(:62)//in_column(labels%length, 10)//'   '//line(63:119)
               call file%put(line)
            end if
            lambda_floor = noise*analysis%largest_lambda
            p_floor = noise*analysis%largest_p
            force_floor = p_floor*joint%area
            do i = joint%first, joint%last
               associate (element => model%interface(i))
                  call row%clear()
                  call row%add_integer(element%id, 11)
                  call row%add_integer(joint_node_id(model, i, 1), 11)
                  call row%add_integer(joint_node_id(model, i, 2), 11)
                  call row%add_short(clean(at_first_end(element, model%x(:model%dimension, :))))
                  call row%add_short([element%area])
                  call row%add(branch_field(state(i)%branch))
                  call row%add_short([clean(state(i)%lambda, lambda_floor), clean(state(i)%pressure, p_floor), &
                                      clean(state(i)%sumf, force_floor)])
                  if (model%dimension == 2) call row%add_short([clean(state(i)%k_n)]) ! in space only in the joint history
                  call file%put(row%text(:row%length))
               end associate
            end do
            if (any(joint%law%shear%given)) call list_shear(file, labels, model, plan, analysis, j)
         end associate
      end do
   end subroutine list_interface


   !> A branch in its column, as 2x, a6.
   pure function branch_field(branch) result(field)
      integer, intent(in) :: branch
      character(8) :: field

      field = repeat(' ', 8 - len(branch_name(branch)))//branch_name(branch)
   end function branch_field


   !> Shear of the interface elements of joint J. LIMIT is mu p.
   subroutine list_shear(file, labels, model, plan, analysis, j)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)      :: labels
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      integer, intent(in)               :: j
      character(page_width) :: line
      type(text_line_type)  :: row
      real(wp) :: delta_floor, tau_floor
      integer  :: i, k

      associate (joint => model%joints(j))
         delta_floor = noise*analysis%largest_lambda
         tau_floor = noise*analysis%largest_p
         do k = 1, model%dimension - 1
            if (.not. joint%law%shear(k)%given) cycle
            call heading(file, 'SHEAR IN DIRECTION '//merge('X', 'Y', k == 1)//' OF JOINT '//integer_text(joint%id)// &
                         where_now(plan, analysis))
            call file%put('    ELEMENT     NODE 1  BRANCH        DELTA          TAU        FORCE    K_S, USED        LIMIT')
            if (labels%force /= '') then
               line = ''
               line(32:) = in_column(labels%length, 13)
               line(45:) = in_column(labels%pressure, 13)
               line(58:) = in_column(labels%force, 13)
               line(71:) = in_column(labels%stiffness, 13)
               line(84:) = in_column(labels%pressure, 13)
               call file%put(line)
            end if
            do i = joint%first, joint%last
               associate (state => analysis%states(i)%shear(k), element => model%interface(i))
                  call row%clear()
                  call row%add_integer(element%id, 11)
                  call row%add_integer(joint_node_id(model, i, 1), 11)
                  call row%add(branch_field(state%branch))
                  call row%add_short([clean(state%delta, delta_floor), clean(state%tau, tau_floor), &
                                      clean(state%tau*element%area, tau_floor*element%area), clean(state%k_s)])
                  if (joint%law%has_friction) call row%add_short( &
                     [clean(friction_limit(joint%law, analysis%states(i)%normal%pressure), tau_floor)])
                  if (analysis%states(i)%slips) call row%add(repeat(' ', 97 - row%length)//'SLIPS')
                  call file%put(row%text(:row%length))
               end associate
            end do
         end do
      end associate
   end subroutine list_shear


   !> Note the resultants of all joints after the increment just completed: force of side 1 on side 2, moment about the
   !! centroid of the joint's area.
   subroutine note_resultants(model, analysis, largest_force, rows)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(in)      :: analysis
      real(wp), intent(in)                 :: largest_force
      type(row_buffer_type), intent(inout) :: rows
      character(page_width) :: row
      real(wp) :: force(3), total(3), centroid(3), arm(3), moment(3), normal, along(2), floor, extent
      integer  :: i, j

      floor = noise*largest_force
      do j = 1, size(model%joints)
         associate (joint => model%joints(j))
            centroid = 0.0_wp
            do i = joint%first, joint%last
               centroid = centroid + model%interface(i)%area*at_first_end(model%interface(i), model%x)/joint%area
            end do
            total = 0.0_wp
            moment = 0.0_wp; normal = 0.0_wp; along = 0.0_wp; extent = 0.0_wp
            do i = joint%first, joint%last
               force = element_force(model%interface(i), analysis%states(i))
               arm = at_first_end(model%interface(i), model%x) - centroid
               extent = max(extent, norm2(arm))
               total = total + force
               moment = moment + [arm(2)*force(3) - arm(3)*force(2), arm(3)*force(1) - arm(1)*force(3), &
                                  arm(1)*force(2) - arm(2)*force(1)]
               normal = normal + analysis%states(i)%normal%sumf
               along = along + analysis%states(i)%shear%tau*model%interface(i)%area
            end do
            if (model%dimension == 3) then
               write (row, '(i6, i11, 7es15.5)') analysis%increment, joint%id, clean(normal, floor), clean(total, floor), &
                  clean(moment, floor*extent)
            else
               write (row, '(i6, i11, 5es15.5)') analysis%increment, joint%id, clean(normal, floor), clean(along(1), floor), &
                  clean(total(:2), floor), clean(moment(3), floor*extent)
            end if
            call rows%add(row)
         end associate
      end do
   end subroutine note_resultants


   subroutine list_resultants(file, labels, stage, dimension, rows)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      character(*), intent(in)              :: stage
      integer, intent(in)                   :: dimension
      type(row_buffer_type), intent(inout)  :: rows
      character(page_width) :: line

      if (rows%n == 0) return
      call heading(file, 'RESULTANTS OF JOINTS, SIDE 1 ON SIDE 2 (MOMENT ABOUT THE CENTROID OF THE JOINT), '//stage)
      if (dimension == 3) then
         call file%put('  INCR      JOINT   NORMAL FORCE        FORCE X        FORCE Y        FORCE Z       MOMENT X'// &
                       '       MOMENT Y       MOMENT Z')
      else
         call file%put('  INCR      JOINT   NORMAL FORCE    SHEAR FORCE        FORCE X        FORCE Y       MOMENT Z')
      end if
      if (labels%force /= '') then
         line = ''
         line(18:) = in_column(labels%force, 15)
         line(33:) = in_column(labels%force, 15)
         line(48:) = in_column(labels%force, 15)
         line(63:) = in_column(labels%force, 15)
         line(78:) = in_column(trim(labels%force)//' '//labels%length, 15)
         if (dimension == 3) then
            line(93:) = line(78:92)
            line(108:) = line(78:92)
         end if
         call file%put(line)
      end if
      call rows%flush(file)
   end subroutine list_resultants


   !> Note the re-analyses after the Coulomb check, or the iterations, of the increment just completed.
   subroutine note_passes(analysis, rows)
      type(analysis_type), intent(in)      :: analysis
      type(row_buffer_type), intent(inout) :: rows
      character(page_width) :: row
      integer, parameter :: shown = 8 ! of many passes
      integer :: i

      do i = 1, analysis%n_passes
         if (analysis%n_passes > 3*shown .and. i > shown .and. i < analysis%n_passes) then
            if (i == shown + 1) then
               write (row, '(i6, a, i0, a)') analysis%increment, '   ... ', analysis%n_passes - shown - 1, ' MORE ...'
               call rows%add(row)
            end if
            cycle
         end if
         associate (pass => analysis%passes(i))
            if (pass%part > 0) then
               write (row, '(2i6, i8, 2es14.3, f9.4, i9)') analysis%increment, pass%part, i, pass%before, pass%after, &
                  pass%step, pass%changes
            else if (pass%part < 0) then
               write (row, '(2i6, 2es14.5)') analysis%increment, i, pass%before, pass%after
            else
               write (row, '(2i6, 2es14.5, f10.2, i9)') analysis%increment, i, pass%before, pass%after, &
                  100.0_wp*(1.0_wp - pass%after/max(pass%before, tiny(1.0_wp))), pass%changes
            end if
            call rows%add(row)
         end associate
      end do
   end subroutine note_passes


   !> TITLE and COLUMNS say what the passes are.
   subroutine list_passes(file, title, columns, rows)
      type(output_file_type), intent(inout) :: file
      character(*), intent(in)              :: title, columns
      type(row_buffer_type), intent(inout)  :: rows

      if (rows%n == 0) return
      call heading(file, title)
      call file%put(columns)
      call rows%flush(file)
   end subroutine list_passes


   !> Work done on the joints in the stage, by shear and by normal forces; the difference is lost where the stage closes a loop.
   subroutine list_energy(file, labels, stage, model, analysis)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      character(*), intent(in)              :: stage
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      character(page_width) :: line
      real(wp) :: floor
      integer  :: j

      if (size(model%joints) == 0) return
      call heading(file, 'ENERGY OF JOINTS, '//stage)
      call file%put('                 ------------- NORMAL -------------------   -------------- SHEAR -------------------')
      call file%put('     JOINT         PUT IN   GIVEN BACK         KEPT         PUT IN   GIVEN BACK         KEPT')
      if (labels%force /= '') call file%put('                 ('//trim(labels%force)//' '//trim(labels%length)//')')
      do j = 1, size(model%joints)
         associate (energy => analysis%energy(j))
            floor = noise*sum(energy%put_in)
            write (line, '(i11, 1x, 3es13.5, 2x, 3es13.5)') model%joints(j)%id, &
               clean(energy%put_in(2), floor), clean(energy%given_back(2), floor), &
               clean(energy%put_in(2) - energy%given_back(2), floor), clean(energy%put_in(1), floor), &
               clean(energy%given_back(1), floor), clean(energy%put_in(1) - energy%given_back(1), floor)
            call file%put(line)
         end associate
      end do
   end subroutine list_energy

end module listing_joints
