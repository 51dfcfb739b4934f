!> The answer at the end of a stage as a block of short tables, the same in the listing and on the screen.
module answer_block
   use bolt_answers, only: bolt_answer_type
   use kinds, only: wp
   use listing_table, only: axes, column, heading, label_type, listing_table_type
   use model_data, only: joint_node_id, model_type
   use output_file, only: output_file_type
   use stage_answer, only: peak_type, stage_answer_type
   use text_tools, only: clean
   implicit none
   private

   public :: print_answer

contains

   !> Print ANSWER under TITLE into FILE.
   subroutine print_answer(file, labels, title, model, answer)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      character(*), intent(in)              :: title
      type(model_type), intent(in)          :: model
      type(stage_answer_type), intent(in)   :: answer

      call heading(file, title)
      call print_peaks(file, labels, model, answer)
      if (size(answer%joints) > 0) call print_joints(file, labels, model, answer)
      if (size(answer%joints) > 0) call print_stiffnesses(file, labels, model, answer)
      if (size(answer%bolts) > 0) call print_bolts(file, labels, answer%bolts)
   end subroutine print_answer

   !> Displacement and stress.
   subroutine print_peaks(file, labels, model, answer)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      type(model_type), intent(in)          :: model
      type(stage_answer_type), intent(in)   :: answer
      type(listing_table_type) :: table

      call table%start('', [column('', 'a33'), column('VALUE', 'es13.4'), column('', 'a13'), column('AT', 'a8'), &
                            column('NUMBER', 'i11'), column(axes(:model%dimension), 'es13.5', labels%length)], file)
      call row('LARGEST DISPLACEMENT', labels%length, 'NODE', answer%displacement)
      call row('LARGEST VON MISES, CENTRES', labels%pressure, 'ELEMENT', answer%at_centre)
      call row('LARGEST VON MISES, NODES', labels%pressure, 'NODE', answer%at_node)

   contains

      subroutine row(words, unit, kind, peak)
         character(*), intent(in)    :: words, unit, kind
         type(peak_type), intent(in) :: peak
         character(31) :: name
         character(12) :: label

         if (.not. peak%is_there) return
         name = words
         label = unit
         call table%add(name)
         call table%add([peak%value])
         call table%add(label)
         call table%add(kind)
         call table%add([peak%id])
         call table%add(clean(peak%x(:model%dimension)))
         call table%print_row(file)
      end subroutine row

   end subroutine print_peaks

   !> Contact, and what the joints transmit.
   subroutine print_joints(file, labels, model, answer)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      type(model_type), intent(in)          :: model
      type(stage_answer_type), intent(in)   :: answer
      type(listing_table_type) :: table
      integer :: j

      call file%put('')
      call table%start('', [column('JOINT', 'i11'), column('CONTACT %', 'f10.2'), column('P MAX', 'es12.4', labels%pressure), &
                            column('AT NODE', 'i11'), column('GAP MAX', 'es12.4', labels%length), column('AT NODE', 'i11'), &
                            column('SLIPPING', 'i9'), column(['N', 'T'], 'es12.4', labels%force), &
                            column('M', 'es12.4', labels%moment), column('MU N/T', 'f11.3'), column('', 'a')], file)
      do j = 1, size(answer%joints)
         associate (joint => answer%joints(j))
            call table%add([model%joints(j)%id], [100.0_wp*joint%contact, joint%pressure])
            call add_node(joint%pressed_at)
            call table%add([joint%gap])
            call add_node(joint%open_at)
            call table%add([joint%slipping], [joint%normal, joint%shear, joint%moment])
            call table%add([min(joint%safety, 999999.0_wp)], where=[joint%has_safety])
            if (joint%frame%closed) call table%add('  CLOSED')
            call table%print_row(file)
         end associate
      end do

   contains

      !> The node of interface element I; nothing where there is none.
      subroutine add_node(i)
         integer, intent(in) :: i

         call table%add([joint_node_id(model, max(i, 1), 1)], where=[i > 0])
      end subroutine add_node

   end subroutine print_joints

   !> Stiffnesses about the centroids.
   subroutine print_stiffnesses(file, labels, model, answer)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      type(model_type), intent(in)          :: model
      type(stage_answer_type), intent(in)   :: answer
      character(14), parameter :: names(6) = [character(14) :: 'ALONG X', 'ALONG Y', 'NORMAL', 'TILT ABOUT X', 'TILT ABOUT Y', &
                                              'TWIST']
      type(listing_table_type) :: table
      character(20) :: unit(6)
      integer :: c, j
      logical :: shown(6)

      shown = [(any([(answer%joints(j)%frame%exists(c), j = 1, size(answer%joints))]), c = 1, 6)]
      unit(:3) = labels%stiffness
      unit(4:) = labels%moment
      call file%put('')
      call table%start('', [column('JOINT', 'i11'), column('STIFFNESS', 'a10'), &
                            column(pack(names, shown), 'es14.4', pack(unit, shown))], file)
      do j = 1, size(answer%joints)
         associate (joint => answer%joints(j))
            call row('TANGENT', joint%tangent, joint%frame%exists)
            call row('SECANT', joint%secant, joint%has_secant)
         end associate
      end do

   contains

      subroutine row(kind, stiffness, is_there)
         character(*), intent(in) :: kind
         real(wp), intent(in)     :: stiffness(6)
         logical, intent(in)      :: is_there(6)

         call table%add([model%joints(j)%id])
         call table%add(kind)
         call table%add(pack(stiffness, shown), where=pack(is_there, shown))
         call table%print_row(file)
      end subroutine row

   end subroutine print_stiffnesses

   !> Forces of the stage; and since each bolt was tightened, with its stress and what it clamps.
   subroutine print_bolts(file, labels, bolts)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      type(bolt_answer_type), intent(in)    :: bolts(:)
      type(listing_table_type) :: table
      integer :: i

      call file%put('')
      call table%start('', [column([character(7) :: 'BOLT', 'ELEMENT', 'SURFACE'], 'i11'), &
                            column([character(6) :: 'FORCE', 'CHANGE', 'LOAD'], 'es13.4', labels%force), &
                            column('CHANGE/LOAD', 'f13.5'), column('BENDING', 'es13.4', labels%moment)], file)
      do i = 1, size(bolts)
         associate (bolt => bolts(i))
            call table%add([bolt%id])
            call table%add([bolt%element, bolt%surface], where=[bolt%element, bolt%surface] > 0)
            call table%add([bolt%force, bolt%change, bolt%load_change])
            call table%add([bolt%ratio, bolt%moment], where=[bolt%has_ratio, bolt%has_moment])
            call table%print_row(file)
         end associate
      end do
      if (.not. any(bolts%is_locked)) return
      call file%put('')
      call table%start('', [column('BOLT', 'i11'), &
                            column([character(9) :: 'TIGHTENED', 'LARGEST', 'ALL LOADS'], 'es12.4', labels%force), &
                            column('SHARE', 'f9.5'), column('STRESS', 'es12.4', labels%pressure), &
                            column('AND BENDING', 'es12.4', labels%pressure), column('OF ST %', 'f9.2'), column('JOINT', 'i9'), &
                            column('CLAMPING', 'es12.4', labels%force), column('LOSS %', 'f9.2'), column('MU N/T', 'f11.3')], file)
      do i = 1, size(bolts)
         associate (bolt => bolts(i))
            if (.not. bolt%is_locked) cycle
            call table%add([bolt%id], [bolt%tightened, bolt%largest, bolt%load])
            call table%add([bolt%share, bolt%stress, bolt%edge_stress, 100.0_wp*bolt%use], &
                           where=[bolt%has_share, .true., bolt%has_moment, bolt%has_strength])
            call table%add([bolt%joint], where=[bolt%joint > 0])
            call table%add([bolt%clamping, 100.0_wp*bolt%loss, min(bolt%safety, 999999.0_wp)], &
                           where=[bolt%joint > 0, bolt%joint > 0, bolt%has_safety])
            call table%print_row(file)
         end associate
      end do
   end subroutine print_bolts

end module answer_block
