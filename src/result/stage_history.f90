!> NAME.stage.csv: the answer of every stage, a row a joint; NAME.bolt.csv: every bolt after every increment. Both in full
!! precision; a field is empty where there is nothing to say.
module stage_history
   use csv_line, only: csv_line_type
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use output_file, only: output_file_type
   use stage_answer, only: bolt_answer_type, peak_type, stage_answer_type
   use text_tools, only: clean
   implicit none
   private

   public :: write_stage_header, write_stage, write_bolt_header, write_bolts

contains

   subroutine write_stage_header(file)
      type(output_file_type), intent(inout) :: file

      call file%put('stage,joint,u_max,u_node,mises_centre,mises_element,mises_max,mises_node,area,x,y,z,closed,'// &
                    'normal_x,normal_y,normal_z,contact,p_max,p_node,gap_max,gap_node,slipping,n,t,m,safety,'// &
                    'force_x,force_y,force_n,moment_x,moment_y,moment_n,move_x,move_y,move_n,turn_x,turn_y,turn_n,'// &
                    'tangent_x,tangent_y,tangent_n,tangent_tilt_x,tangent_tilt_y,tangent_twist,'// &
                    'secant_x,secant_y,secant_n,secant_tilt_x,secant_tilt_y,secant_twist')
   end subroutine write_stage_header

   !> The rows of the stage with the number STAGE; one, with joint 0, where there are no joints.
   subroutine write_stage(file, stage, model, answer)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage
      type(model_type), intent(in)          :: model
      type(stage_answer_type), intent(in)   :: answer
      integer, parameter :: of_joint = 42 ! fields of a row that say something of a joint
      type(csv_line_type) :: line
      integer :: j, k

      do j = min(1, size(model%joints)), size(model%joints)
         line%length = 0
         call line%add([stage])
         if (j == 0) call line%add([0])
         if (j > 0) call line%add([model%joints(j)%id])
         call add_peak(line, answer%displacement)
         call add_peak(line, answer%at_centre)
         call add_peak(line, answer%at_node)
         if (j > 0) then
            call add_joint(line, model, answer, j)
         else
            do k = 1, of_joint
               call line%add('')
            end do
         end if
         call file%put(line%text(:line%length))
      end do
   end subroutine write_stage

   subroutine add_peak(line, peak)
      type(csv_line_type), intent(inout) :: line
      type(peak_type), intent(in)        :: peak

      call add_where(line, [peak%is_there], [peak%value])
      if (peak%is_there) call line%add([peak%id])
      if (.not. peak%is_there) call line%add('')
   end subroutine add_peak

   !> What a row says of joint J.
   subroutine add_joint(line, model, answer, j)
      type(csv_line_type), intent(inout)  :: line
      type(model_type), intent(in)        :: model
      type(stage_answer_type), intent(in) :: answer
      integer, intent(in)                 :: j

      associate (joint => answer%joints(j), frame => answer%joints(j)%frame)
         call line%add(clean([model%joints(j)%area, frame%centroid]))
         call line%add(merge('1', '0', frame%closed))
         call add_where(line, spread(.not. frame%closed, 1, 3), clean(frame%axes(:, 3)))
         call line%add(clean([joint%contact, joint%pressure]))
         call add_node(joint%pressed_at)
         call line%add(clean([joint%gap]))
         call add_node(joint%open_at)
         call line%add([joint%slipping])
         call line%add(clean([joint%normal, joint%shear, joint%moment]))
         call add_where(line, [joint%has_safety], [joint%safety])
         call add_where(line, frame%exists, joint%force)
         call add_where(line, frame%exists, joint%movement)
         call add_where(line, frame%exists, joint%tangent)
         call add_where(line, joint%has_secant, joint%secant)
      end associate

   contains

      !> The node of interface element I; nothing where there is none.
      subroutine add_node(i)
         integer, intent(in) :: i

         if (i > 0) call line%add([joint_node_id(model, i, 1)])
         if (i == 0) call line%add('')
      end subroutine add_node

   end subroutine add_joint

   subroutine write_bolt_header(file)
      type(output_file_type), intent(inout) :: file

      call file%put('stage,increment,load,bolt,force,change,load_change,ratio,bending,longer,element,surface')
   end subroutine write_bolt_header

   !> A row a bolt after INCREMENT of the stage with the number STAGE, of whose load a FRACTION is on.
   subroutine write_bolts(file, stage, increment, fraction, model, bolts)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage, increment
      real(wp), intent(in)                  :: fraction
      type(model_type), intent(in)          :: model
      type(bolt_answer_type), intent(in)    :: bolts(:)
      type(csv_line_type) :: line
      integer :: i

      do i = 1, size(bolts)
         associate (bolt => bolts(i))
            line%length = 0
            call line%add([stage, increment])
            call line%add(clean([fraction]))
            call line%add([bolt%bolt%id])
            call line%add(clean([bolt%force, bolt%change, bolt%load_change]))
            call add_where(line, [bolt%has_ratio], [bolt%ratio])
            call add_where(line, [bolt%has_moment], [bolt%moment])
            call line%add(clean([bolt%bolt%longer]))
            call line%add([bolt%bolt%element])
            if (bolt%bolt%section > 0) call line%add([model%sections(bolt%bolt%section)%surface])
            if (bolt%bolt%section == 0) call line%add([0])
            call file%put(line%text(:line%length))
         end associate
      end do
   end subroutine write_bolts

   !> VALUES, an empty field for those that are not there.
   subroutine add_where(line, is_there, values)
      type(csv_line_type), intent(inout) :: line
      logical, intent(in)                :: is_there(:)
      real(wp), intent(in)               :: values(:)
      integer :: k

      do k = 1, size(values)
         if (is_there(k)) call line%add(clean(values(k:k)))
         if (.not. is_there(k)) call line%add('')
      end do
   end subroutine add_where

end module stage_history
