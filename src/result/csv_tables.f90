!> The tables beside the listing, in full precision; a field is empty where there is nothing to say. NAME.joint.csv: every interface
!! element after every increment; NAME.stage.csv: the answer of every stage, a row a joint; NAME.bolt.csv: every bolt after every
!! increment; NAME.reaction.csv: what the supports of every stage take; NAME.modes.csv: the natural modes of every stage that asks for
!! them; NAME.modes.energy.csv: the shares of their strain energy; NAME.watch.csv: how the nodes of WATCH move; NAME.watch.energy.csv:
!! who gives way by how much; NAME.response.csv: amplitude and phase of the nodes asked, over the frequency of a load that oscillates;
!! NAME.backbone.csv and NAME.loop.csv: frequency and loss of a mode over its amplitude, and the loops that they are read from.
module csv_tables
   use analysis_state, only: analysis_type
   use interface_operator, only: at_first_end
   use element_mapping, only: two_pi
   use kinds, only: wp
   use backbone, only: backbone_type
   use bolt_answers, only: bolt_answer_type
   use modal_response, only: response_type
   use mode_values, only: modes_type
   use model_data, only: has_gaps, joint_node_id, model_type
   use normal_stiffness, only: branch_name
   use output_file, only: output_file_type
   use stage_answer, only: peak_type, stage_answer_type
   use stage_plan, only: stage_plan_type, vibration_plan_type
   use text_tools, only: csv_line_type, above, clean
   implicit none
   private

   public :: write_headers, write_history, write_stage, write_bolts, write_modes, write_energies, write_response, &
             write_backbone, write_loops, write_answers

   ! the tables in the order of their endings
   integer, parameter, public :: joint_table = 1, stage_table = 2, bolt_table = 3, modes_table = 4, energy_table = 5, &
                                 response_table = 6, backbone_table = 7, loop_table = 8, bend_table = 9, watch_table = 10, &
                                 split_table = 11, reaction_table = 12
   character(*), parameter, public :: history_ending = '.joint.csv'
   character(22), parameter, public :: table_endings(12) = [character(22) :: history_ending, '.stage.csv', '.bolt.csv', &
      '.modes.csv', '.modes.energy.csv', '.response.csv', '.backbone.csv', '.loop.csv', '.backbone.response.csv', '.watch.csv', &
      '.watch.energy.csv', '.reaction.csv']

   real(wp), parameter :: no_mass = 1.0e-12_wp ! of the structure's: rounding

contains

   !> The titles of the columns of all TABLES that are open. Of the interface elements GAP and SLID only where the deck has any.
   subroutine write_headers(tables, model)
      type(output_file_type), intent(inout) :: tables(:) !! in the order of table_endings
      type(model_type), intent(in)          :: model

      call put(joint_table, 'stage,increment,load,joint,element,node1,node2,x,y,z,area,branch,lambda,pressure,force,k_n,'// &
               'branch_x,delta_x,tau_x,k_sx,branch_y,delta_y,tau_y,k_sy,slip'// &
               trim(merge(',gap', '    ', has_gaps(model)))//trim(merge(',slid_x,slid_y', '              ', can_slide(model))))
      call put(stage_table, 'stage,joint,u_max,u_node,mises_centre,mises_element,mises_max,mises_node,area,x,y,z,closed,'// &
               'normal_x,normal_y,normal_z,contact,p_max,p_node,gap_max,gap_node,slipping,n,t,m,safety,'// &
               'force_x,force_y,force_n,moment_x,moment_y,moment_n,move_x,move_y,move_n,turn_x,turn_y,turn_n,'// &
               'tangent_x,tangent_y,tangent_n,tangent_tilt_x,tangent_tilt_y,tangent_twist,'// &
               'secant_x,secant_y,secant_n,secant_tilt_x,secant_tilt_y,secant_twist')
      call put(bolt_table, 'stage,increment,load,bolt,force,change,load_change,ratio,bending,longer,element,surface,'// &
               'tightened,largest,all_loads,share,stress,edge_stress,use,joint,clamping,loss,safety')
      call put(modes_table, 'stage,mode,frequency,omega,residual,mass_x,mass_y,mass_z,loss_factor')
      call put(energy_table, 'stage,mode,kind,id,normal,shear')
      call put(backbone_table, 'stage,mode,amplitude,frequency,loss_factor,slipping,open,distortion')
      call put(bend_table, 'stage,mode,amplitude,below,phase_below,above,phase_above')
      call put(loop_table, 'stage,mode,amplitude,point,alpha,q')
      call put(watch_table, 'stage,node,x,y,z,u_x,u_y,u_z,change_x,change_y,change_z,load_x,load_y,load_z,along,load,stiffness')
      call put(reaction_table, 'stage,kind,id,line,nodes,x,y,z,force_x,force_y,force_z,moment_x,moment_y,moment_z,'// &
               'central_x,central_y,central_z')
      call put(split_table, 'stage,kind,id,normal,shear,work')
      call put(response_table, 'stage,frequency,node,component,amplitude,phase')

   contains

      subroutine put(which, titles)
         integer, intent(in)      :: which
         character(*), intent(in) :: titles

         if (tables(which)%is_open) call tables(which)%put(titles)
      end subroutine put

   end subroutine write_headers

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
      call line%add([plan%stages(analysis%stage)%id, analysis%increment], clean([analysis%fraction]))
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
         call file%put(line%text(:line%length))
      end do
   end subroutine write_history

   !> Whether any joint has a coefficient of friction.
   pure logical function can_slide(model)
      type(model_type), intent(in) :: model

      can_slide = any(model%joints%law%has_friction)
   end function can_slide

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

      call line%add(clean([peak%value]), where=[peak%is_there])
      call line%add([peak%id], where=[peak%is_there])
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
         call line%add(clean(frame%axes(:, 3)), where=spread(.not. frame%closed, 1, 3))
         call line%add(clean([joint%contact, joint%pressure]))
         call add_node(joint%pressed_at)
         call line%add(clean([joint%gap]))
         call add_node(joint%open_at)
         call line%add([joint%slipping], clean([joint%normal, joint%shear, joint%moment]))
         call line%add(clean([joint%safety]), where=[joint%has_safety])
         call line%add(clean([joint%force, joint%movement, joint%tangent]), where=[frame%exists, frame%exists, frame%exists])
         call line%add(clean(joint%secant), where=joint%has_secant)
      end associate

   contains

      !> The node of interface element I; nothing where there is none.
      subroutine add_node(i)
         integer, intent(in) :: i

         call line%add([joint_node_id(model, max(i, 1), 1)], where=[i > 0])
      end subroutine add_node

   end subroutine add_joint

   !> A row a bolt after INCREMENT of the stage with the number STAGE, of whose load a FRACTION is on.
   subroutine write_bolts(file, stage, increment, fraction, bolts)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage, increment
      real(wp), intent(in)                  :: fraction
      type(bolt_answer_type), intent(in)    :: bolts(:)
      type(csv_line_type) :: line
      integer :: i

      do i = 1, size(bolts)
         associate (bolt => bolts(i), locked => bolts(i)%is_locked, clamps => bolts(i)%joint > 0)
            line%length = 0
            call line%add([stage, increment], clean([fraction]))
            call line%add([bolt%id], clean([bolt%force, bolt%change, bolt%load_change]))
            call line%add(clean([bolt%ratio, bolt%moment]), where=[bolt%has_ratio, bolt%has_moment])
            call line%add(clean([bolt%longer]))
            call line%add([bolt%element, bolt%surface])
            call line%add(clean([bolt%tightened, bolt%largest, bolt%load, bolt%share, bolt%stress, bolt%edge_stress, bolt%use]), &
                          where=[locked, locked, locked, bolt%has_share, .true., bolt%has_moment, bolt%has_strength])
            call line%add([bolt%joint], where=[clamps])
            call line%add(clean([bolt%clamping, bolt%loss, bolt%safety]), where=[clamps, clamps, bolt%has_safety])
            call file%put(line%text(:line%length))
         end associate
      end do
   end subroutine write_bolts

   !> The rows of STAGE, a mode each: effective masses are those of the mode; the loss factor where PLAN has losses.
   subroutine write_modes(file, stage, plan, modes)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage !! its number
      type(vibration_plan_type), intent(in) :: plan
      type(modes_type), intent(in)          :: modes
      type(csv_line_type) :: line
      integer :: m

      do m = 1, size(modes%modes)
         associate (mode => modes%modes(m))
            line%length = 0
            call line%add([stage, modes%n_before + m], [mode%frequency, mode%omega, mode%residual])
            call line%add(above(mode%effective, no_mass*modes%mass))
            call line%add([mode%loss], where=[plan%has_losses .and. .not. mode%is_rigid])
            call file%put(line%text(:line%length))
         end associate
      end do
   end subroutine write_modes

   !> The rows of STAGE: what bodies and bars have stands under normal; a motion without strain has no rows.
   subroutine write_energies(file, stage, model, modes)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage
      type(model_type), intent(in)          :: model
      type(modes_type), intent(in)          :: modes
      integer :: i, m

      do m = 1, size(modes%modes)
         if (modes%modes(m)%is_rigid) cycle
         associate (energy => modes%modes(m)%energy)
            do i = 1, size(energy%body)
               call put('BODY', i, [energy%body(i), 0.0_wp])
            end do
            do i = 1, size(energy%normal)
               call put('JOINT', model%joints(i)%id, [energy%normal(i), energy%shear(i)])
            end do
            do i = 1, size(energy%bar)
               call put('BAR', model%bars(i)%id, [energy%bar(i), 0.0_wp])
            end do
         end associate
      end do

   contains

      subroutine put(kind, id, shares)
         character(*), intent(in) :: kind
         integer, intent(in)      :: id
         real(wp), intent(in)     :: shares(2)
         type(csv_line_type) :: line

         line%length = 0
         call line%add([stage, modes%n_before + m])
         call line%add(kind)
         call line%add([id], shares)
         call file%put(line%text(:line%length))
      end subroutine put

   end subroutine write_energies

   !> The rows of STAGE: an amplitude each.
   subroutine write_backbone(file, stage, found)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage !! its number
      type(backbone_type), intent(in)       :: found
      type(csv_line_type) :: line
      integer :: i

      do i = 1, size(found%loops)
         associate (loop => found%loops(i))
            line%length = 0
            call line%add([stage, found%mode], clean([loop%q*found%peak, sqrt(loop%omega_squared)/two_pi, loop%loss, &
                                                      loop%slipping, loop%open, loop%distortion]))
            call file%put(line%text(:line%length))
         end associate
      end do
   end subroutine write_backbone

   !> The rows of STAGE: the points of the last loop of each amplitude, from its upper turning point on, alpha against q.
   subroutine write_loops(file, stage, found)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage
      type(backbone_type), intent(in)       :: found
      type(csv_line_type) :: line
      integer :: i, k

      do i = 1, size(found%loops)
         do k = 1, size(found%loops(i)%way, 2)
            line%length = 0
            call line%add([stage, found%mode], [found%loops(i)%q*found%peak])
            call line%add([k - 1], clean(found%loops(i)%way(:, k)))
            call file%put(line%text(:line%length))
         end do
      end do
   end subroutine write_loops

   !> The rows of STAGE: the response of the mode alone, its amplitudes ascending.
   subroutine write_answers(file, stage, found)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage
      type(backbone_type), intent(in)       :: found
      type(csv_line_type) :: line
      integer :: i

      if (.not. allocated(found%answers)) return
      do i = 1, size(found%answers, 2)
         line%length = 0
         call line%add([stage, found%mode], [found%answers(1, i)])
         call line%add(clean(found%answers(2:3, i)), where=spread(found%answers(2, i) >= 0.0_wp, 1, 2))
         call line%add(found%answers(4:5, i))
         call file%put(line%text(:line%length))
      end do
   end subroutine write_answers

   !> The rows of the ANSWER of STAGE: frequency by frequency, at each node by node, of each its components.
   subroutine write_response(file, stage, answer)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage !! number of the SUBCASE
      type(response_type), intent(in)       :: answer
      character(1), parameter :: component_names(3) = ['x', 'y', 'z']
      type(csv_line_type) :: line
      integer :: d, f, k

      do f = 1, size(answer%frequency)
         do k = 1, size(answer%node)
            do d = 1, size(answer%amplitude, 1)
               line%length = 0
               call line%add([stage], clean([answer%frequency(f)]))
               call line%add([answer%node(k)])
               call line%add(component_names(d), clean([answer%amplitude(d, k, f), answer%phase(d, k, f)]))
               call file%put(line%text(:line%length))
            end do
         end do
      end do
   end subroutine write_response

end module csv_tables
