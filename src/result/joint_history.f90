!> NAME.joint.csv: every interface element after every increment, in full precision.
module joint_history
   use kinds, only: wp
   use model_data, only: joint_movement, model_type
   use normal_stiffness, only: branch_name
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use analysis_state, only: analysis_type
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
      integer  :: i, node2

      now = integer_text(plan%stages(analysis%stage)%id)//','//integer_text(analysis%increment)//','// &
            full(analysis%fraction)
      do i = 1, size(model%interface)
         associate (element => model%interface(i), state => analysis%states(i)%normal)
            node2 = 0
            if (element%nodes(2) > 0) node2 = model%node_id(element%nodes(2))
            call file%put(now//','//integer_text(model%joints(element%joint)%id)//','//integer_text(element%id)//','// &
                          integer_text(model%node_id(element%nodes(1)))//','//integer_text(node2)//','// &
                          full(model%x(1, element%nodes(1)))//','//full(model%x(2, element%nodes(1)))//','// &
                          full(model%x(3, element%nodes(1)))//','//full(element%area)//','//branch_name(state%branch)//','// &
                          full(state%lambda)//','//full(state%pressure)//','//full(state%sumf)//','//full(state%k_n)// &
                          shear_columns(model, analysis, i, 1)//shear_columns(model, analysis, i, 2)//','// &
                          merge('1', '0', analysis%states(i)%slips))
         end associate
      end do
   end subroutine write_history


   !> branch, delta, tau, k_s of element I in direction K. Without a shear law the movement alone is a result.
   function shear_columns(model, analysis, i, k) result(columns)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: i, k
      character(:), allocatable       :: columns
      real(wp) :: movement(3)

      associate (state => analysis%states(i)%shear(k))
         if (model%joints(model%interface(i)%joint)%law%shear(k)%given) then
            columns = ','//branch_name(state%branch)//','//full(state%delta)//','//full(state%tau)//','//full(state%k_s)
         else
            movement = joint_movement(model, analysis%u, i)
            columns = ',,'//full(movement(k))//','//full(0.0_wp)//','//full(0.0_wp)
         end if
      end associate
   end function shear_columns


   !> A number with the 17 digits that make it come back the same.
   pure function full(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(24) :: buffer

      write (buffer, '(es24.16e3)') clean(value)
      text = trim(adjustl(buffer))
   end function full

end module joint_history
