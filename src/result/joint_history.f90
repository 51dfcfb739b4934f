!> NAME.joint.csv: every interface element after every increment, in full precision.
module joint_history
   use kinds, only: wp
   use model_data, only: model_type
   use normal_stiffness, only: branch_name
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use step_method, only: analysis_type, joint_movement
   use text_tools, only: clean, integer_text
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
      character(:), allocatable :: now
      real(wp) :: delta(3)
      integer  :: i, node2

      now = integer_text(plan%stages(analysis%stage)%id)//','//integer_text(analysis%increment)//','// &
            full(analysis%fraction)
      do i = 1, size(model%interface)
         associate (element => model%interface(i), state => analysis%normal(i))
            node2 = 0
            if (element%nodes(2) > 0) node2 = model%node_id(element%nodes(2))
            delta = joint_movement(model, analysis%u, i)
            call file%put(now//','//integer_text(model%joints(element%joint)%id)//','//integer_text(element%id)//','// &
                          integer_text(model%node_id(element%nodes(1)))//','//integer_text(node2)//','// &
                          full(model%x(1, element%nodes(1)))//','//full(model%x(2, element%nodes(1)))//','// &
                          full(model%x(3, element%nodes(1)))//','//full(element%area)//','//branch_name(state%branch)//','// &
                          full(state%lambda)//','//full(state%pressure)//','//full(state%sumf)//','//full(state%k_n)//',,'// &
                          full(delta(1))//','//full(0.0_wp)//','//full(0.0_wp)//',,'// &
                          full(delta(2))//','//full(0.0_wp)//','//full(0.0_wp)//',0')
         end associate
      end do
   end subroutine write_history


   !> A number with the 17 digits that make it come back the same.
   pure function full(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(24) :: buffer

      write (buffer, '(es24.16e3)') clean(value)
      text = trim(adjustl(buffer))
   end function full

end module joint_history
