!> NAME.joint.csv: every interface element after every increment, in full precision.
module joint_history
   use csv_line, only: csv_line_type
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use model_data, only: has_gaps, joint_node_id, model_type
   use normal_stiffness, only: branch_name
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use analysis_state, only: analysis_type
   use text_tools, only: clean
   implicit none
   private

   public :: write_history_header, write_history

contains

   !> The titles of the columns; GAP only where the deck has any.
   subroutine write_history_header(file, model)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model

      call file%put('stage,increment,load,joint,element,node1,node2,x,y,z,area,branch,lambda,pressure,force,k_n,'// &
                    'branch_x,delta_x,tau_x,k_sx,branch_y,delta_y,tau_y,k_sy,slip'// &
                    trim(merge(',gap', '    ', has_gaps(model)))//trim(merge(',slid_x,slid_y', '              ', can_slide(model))))
   end subroutine write_history_header

   !> One row an interface element, for the increment just completed. node2 is 0 for the rigid base; a direction without
   !! shear stiffness has no branch.
   subroutine write_history(file, model, plan, analysis)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(in)       :: analysis
      type(csv_line_type) :: line
      integer  :: i, k, same
      logical  :: gaps, slides

      gaps = has_gaps(model)
      slides = can_slide(model)
      call line%add([plan%stages(analysis%stage)%id, analysis%increment])
      call line%add(clean([analysis%fraction]))
      same = line%length                  ! the columns that all rows have in common
      do i = 1, size(model%interface)
         line%length = same
         associate (element => model%interface(i), state => analysis%states(i)%normal)
            call line%add([model%joints(element%joint)%id, element%id, joint_node_id(model, i, 1), joint_node_id(model, i, 2)])
            call line%add(clean([at_first_end(element, model%x), element%area]))
            call line%add(branch_name(state%branch))
            call line%add(clean([state%lambda, state%pressure, state%sumf, state%k_n]))
         end associate
         do k = 1, 2
            associate (state => analysis%states(i)%shear(k))
               if (model%joints(model%interface(i)%joint)%law%shear(k)%given) then
                  call line%add(branch_name(state%branch))
                  call line%add(clean([state%delta, state%tau, state%k_s]))
               else                       ! without a shear law the movement alone is a result
                  call line%add('')
                  call line%add(clean([analysis%movement(k, i), 0.0_wp, 0.0_wp]))
               end if
            end associate
         end do
         call line%add(merge('1', '0', analysis%states(i)%slips))
         if (gaps) call line%add(clean([model%interface(i)%gap]))
         if (slides) call line%add(clean(analysis%states(i)%shear%slid))
         call file%put(line%text(:line%length))
      end do
   end subroutine write_history

   !> Whether any joint has a coefficient of friction.
   pure logical function can_slide(model)
      type(model_type), intent(in) :: model

      can_slide = any(model%joints%law%has_friction)
   end function can_slide

end module joint_history
