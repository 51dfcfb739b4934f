!> NAME.joint.csv: every interface element after every increment, in full precision.
module joint_history
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_stiffness, only: branch_name
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use analysis_state, only: analysis_type
   use text_line, only: text_line_type
   use text_tools, only: clean
   implicit none
   private

   public :: write_history_header, write_history

contains

   subroutine write_history_header(file)
      type(output_file_type), intent(inout) :: file

      call file%put('stage,increment,load,joint,element,node1,node2,x,y,z,area,branch,lambda,pressure,force,k_n,'// &
                    'branch_x,delta_x,tau_x,k_sx,branch_y,delta_y,tau_y,k_sy,slip')
   end subroutine write_history_header


   !> One row an interface element, for the increment just completed. node2 is 0 for the rigid base; a direction without
   !! shear stiffness has no branch.
   subroutine write_history(file, model, plan, analysis)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(in)       :: analysis
      type(text_line_type) :: line
      real(wp) :: x(3)
      integer  :: i, k, same

      call line%clear()                   ! the columns that all rows have in common
      call line%add_integer(plan%stages(analysis%stage)%id)
      call add_number(analysis%increment)
      call add_real(analysis%fraction)
      same = line%length
      do i = 1, size(model%interface)
         line%length = same
         associate (element => model%interface(i), state => analysis%states(i)%normal)
            call add_number(model%joints(element%joint)%id)
            call add_number(element%id)
            call add_number(joint_node_id(model, i, 1))
            call add_number(joint_node_id(model, i, 2))
            x = at_first_end(element, model%x)
            do k = 1, 3
               call add_real(x(k))
            end do
            call add_real(element%area)
            call line%add(','//branch_name(state%branch))
            call add_real(state%lambda)
            call add_real(state%pressure)
            call add_real(state%sumf)
            call add_real(state%k_n)
            call add_shear(1)
            call add_shear(2)
            call line%add(merge(',1', ',0', analysis%states(i)%slips))
            call file%put(line%text(:line%length))
         end associate
      end do

   contains

      subroutine add_number(value)
         integer, intent(in) :: value

         call line%add(',')
         call line%add_integer(value)
      end subroutine add_number


      !> A number with the 17 digits that make it come back the same.
      subroutine add_real(value)
         real(wp), intent(in) :: value

         call line%add(',')
         call line%add_full(clean(value))
      end subroutine add_real


      !> branch, delta, tau, k_s of element I in direction K. Without a shear law the movement alone is a result.
      subroutine add_shear(direction)
         integer, intent(in) :: direction
         real(wp) :: movement(3)

         associate (state => analysis%states(i)%shear(direction))
            if (model%joints(model%interface(i)%joint)%law%shear(direction)%given) then
               call line%add(','//branch_name(state%branch))
               call add_real(state%delta)
               call add_real(state%tau)
               call add_real(state%k_s)
            else
               movement = analysis%movement(:, i)
               call line%add(',')
               call add_real(movement(direction))
               call add_real(0.0_wp)
               call add_real(0.0_wp)
            end if
         end associate
      end subroutine add_shear

   end subroutine write_history

end module joint_history
