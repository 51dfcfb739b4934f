!> The tables of the answer at the end of a stage: a block for screen and listing, and its CSV files. The files are
!! NAME.stage.csv, .bolt.csv, .reaction.csv, .watch.csv and .watch.energy.csv.
module answer_tables
   use analysis_state, only: analysis_type
   use bolt_answers, only: bolt_answer_type
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use result_page, only: bolt_block_2, bolt_table, page_type, reaction_table, split_table, stage_table, table_columns, watch_table
   use stage_answer, only: peak_type, stage_answer_type
   use support_reactions, only: reaction_type, reactions_type
   use table_writer, only: axes, column, heading, table_type
   use text_tools, only: integer_text
   use watched_nodes, only: watch_answer
   implicit none
   private

   public :: print_answer, print_bolts, print_reactions, print_watched

   integer, parameter :: most_reactions = 40 ! rows of the block; the file has all rows

contains

   !> Print ANSWER under TITLE on the screen, and its rows into the file of the stages; without joints one row, with joint 0. The
   !! file has the share in contact and the safety as numbers; the block has the share in per cent and the safety below a million.
   subroutine print_answer(page, title, model, is_first, answer)
      type(page_type), intent(inout)      :: page
      character(*), intent(in)            :: title
      type(model_type), intent(in)        :: model
      logical, intent(in)                 :: is_first !! of the run: what holds for all stages is told
      type(stage_answer_type), intent(in) :: answer
      character(31), parameter :: names(3) = [character(31) :: 'LARGEST DISPLACEMENT', 'LARGEST VON MISES, CENTRES', &
                                              'LARGEST VON MISES, NODES']
      character(8), parameter  :: kinds(3) = [character(8) :: 'NODE', 'ELEMENT', 'NODE']
      character(12)    :: units(3)
      type(peak_type)  :: peaks(3)
      type(table_type) :: table
      integer :: j, k

      ! the largest displacement and stresses
      units = [character(12) :: page%labels%length, page%labels%pressure, page%labels%pressure]
      peaks = [answer%displacement, answer%at_centre, answer%at_node]
      call heading(page%screen, title)
      call table%start('', [column('', 'a33'), column('VALUE', 'es13.4'), column('', 'a13'), column('AT', 'a8'), &
                            column('NUMBER', 'i11'), column(axes(:model%dimension), 'es13.5', page%labels%length)], page%screen)
      do k = 1, 3
         if (.not. peaks(k)%is_there) cycle
         call table%add(names(k), [peaks(k)%value])
         call table%add(units(k))
         call table%add(trim(kinds(k)))
         call table%add([peaks(k)%id], peaks(k)%x(:model%dimension))
         call table%print_row(page%screen)
      end do

      ! the joints
      call table%start('', table_columns(stage_table, page%labels, model))
      if (size(answer%joints) == 0) then
         call begin_row(0)
         call table%print_row(csv_file=page%tables(stage_table))
         return
      end if
      call page%screen%put('')
      call table%print_head(page%screen)
      do j = 1, size(answer%joints)
         call begin_row(model%joints(j)%id)
         associate (joint => answer%joints(j), frame => model%joints(j)%frame)
            call table%add([model%joints(j)%area, frame%centroid])
            call table%add([merge(1, 0, frame%closed)])
            call table%add(frame%axes(:, 3), where=spread(.not. frame%closed, 1, 3))
            call table%add([joint%contact, 100.0_wp*joint%contact, joint%pressure])
            call add_node(joint%pressed_at)
            call table%add([joint%gap])
            call add_node(joint%open_at)
            call table%add([joint%slipping], [joint%normal, joint%shear, joint%moment])
            call table%add([joint%safety, min(joint%safety, 1.0e6_wp)], where=spread(joint%has_safety, 1, 2))
            call table%add(trim(merge('  CLOSED', '        ', frame%closed)))
            call table%add([joint%force, joint%movement, joint%tangent], where=[frame%exists, frame%exists, frame%exists])
            call table%add(joint%secant, where=joint%has_secant)
         end associate
         call table%print_row(page%screen, page%tables(stage_table))
      end do
      if (is_first) call note_cuts(page, 'THE BODIES OF JOINT', model%joints%id, answer%joints%n_cuts, &
                                   'T, MU N/T, M AND SECANT LEAVE OUT WHAT THE MIRROR IMAGE BALANCES')
      call print_stiffnesses(page, model, answer)

   contains

      !> Add the columns that do not concern a joint.
      subroutine begin_row(joint)
         integer, intent(in) :: joint

         call table%add([page%stage_id, joint])
         do k = 1, 3
            call table%add([peaks(k)%value], where=[peaks(k)%is_there])
            call table%add([peaks(k)%id], where=[peaks(k)%is_there])
         end do
      end subroutine begin_row

      !> Add the node of interface element I, or an empty field.
      subroutine add_node(i)
         integer, intent(in) :: i

         call table%add([joint_node_id(model, max(i, 1), 1)], where=[i > 0])
      end subroutine add_node

   end subroutine print_answer

   !> Print for each item with a number of CUTS that planes of symmetry cut it, and WHAT follows, in the first answer of the run.
   subroutine note_cuts(page, kind, id, cuts, what)
      type(page_type), intent(inout) :: page
      character(*), intent(in)       :: kind, what
      integer, intent(in)            :: id(:), cuts(:)
      integer :: i

      do i = 1, size(id)
         if (cuts(i) > 0) call page%screen%put('  NOTE: '//trim(merge('A PLANE OF SYMMETRY CUTS', 'PLANES OF SYMMETRY CUT  ', &
            cuts(i) == 1))//' '//kind//' '//integer_text(id(i))//': '//what)
      end do
   end subroutine note_cuts

   !> Print stiffnesses about the centroids.
   subroutine print_stiffnesses(page, model, answer)
      type(page_type), intent(inout)      :: page
      type(model_type), intent(in)        :: model
      type(stage_answer_type), intent(in) :: answer
      character(14), parameter :: names(6) = [character(14) :: 'ALONG X', 'ALONG Y', 'NORMAL', 'TILT ABOUT X', 'TILT ABOUT Y', &
                                              'TWIST']
      type(table_type) :: table
      character(20) :: unit(6)
      integer :: c, j
      logical :: shown(6)

      shown = [(any([(model%joints(j)%frame%exists(c), j = 1, size(answer%joints))]), c = 1, 6)]
      unit(:3) = page%labels%stiffness
      unit(4:) = page%labels%moment
      call page%screen%put('')
      call table%start('', [column('JOINT', 'i11'), column('STIFFNESS', 'a10'), &
                            column(pack(names, shown), 'es14.4', pack(unit, shown))], page%screen)
      do j = 1, size(answer%joints)
         associate (joint => answer%joints(j))
            call table%add([model%joints(j)%id])
            call table%add('TANGENT')
            call table%add(pack(joint%tangent, shown), where=pack(model%joints(j)%frame%exists, shown))
            call table%print_row(page%screen)
            call table%add([model%joints(j)%id])
            call table%add('SECANT')
            call table%add(pack(joint%secant, shown), where=pack(joint%has_secant, shown))
            call table%print_row(page%screen)
         end associate
      end do
   end subroutine print_stiffnesses

   !> Print the BOLTS of ANALYSIS: in the answer of a stage on the screen, after every increment in their file.
   subroutine print_bolts(page, model, analysis, bolts, in_answer)
      type(page_type), intent(inout)     :: page
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(bolt_answer_type), intent(in) :: bolts(:)
      logical, intent(in)                :: in_answer
      type(table_type) :: table
      integer :: block, i

      if (size(bolts) == 0) return
      do block = 1, merge(2, 1, in_answer .and. any(bolts%is_locked))
         call table%start('', table_columns(merge(bolt_table, bolt_block_2, block == 1), page%labels, model))
         if (in_answer) call page%screen%put('')
         if (in_answer) call table%print_head(page%screen)
         do i = 1, size(bolts)
            if (block == 2 .and. .not. bolts(i)%is_locked) cycle
            associate (bolt => bolts(i), clamps => bolts(i)%joint > 0)
               call table%add([page%stage_id, analysis%increment], [analysis%fraction])
               call table%add([bolt%id])
               call table%add([bolt%element, bolt%surface], where=[bolt%element, bolt%surface] > 0)
               call table%add([bolt%force, bolt%change])
               call table%add([bolt%load_change], where=[bolt%has_load])
               call table%add([bolt%ratio, bolt%moment], where=[bolt%has_ratio, bolt%has_moment])
               call table%add([bolt%longer])
               call table%add([bolt%element, bolt%surface])
               call table%add([bolt%tightened, bolt%largest, bolt%load], &
                              where=[bolt%is_locked, bolt%is_locked, bolt%is_locked .and. bolt%has_load])
               call table%add([bolt%share, bolt%stress, bolt%edge_stress, bolt%use, 100.0_wp*bolt%use], &
                              where=[bolt%has_share, .true., bolt%has_moment, bolt%has_strength, bolt%has_strength])
               call table%add([bolt%joint], where=[clamps])
               call table%add([bolt%clamping, bolt%loss, 100.0_wp*bolt%loss, bolt%safety, min(bolt%safety, 1.0e6_wp)], &
                              where=[clamps, clamps, clamps, bolt%has_safety, bolt%has_safety])
            end associate
            if (in_answer) call table%print_row(page%screen)
            if (.not. in_answer) call table%print_row(csv_file=page%tables(bolt_table))
         end do
      end do
      if (in_answer .and. analysis%stage == 1) call note_cuts(page, 'BOLT', bolts%id, bolts%n_cuts, &
         'FORCES AND BENDING ARE OF ITS PART IN THE MODEL, STRESS AND MU N/T OF THE WHOLE')
   end subroutine print_bolts

   !> Print the support reactions; the last line is the balance.
   subroutine print_reactions(page, model, answer)
      type(page_type), intent(inout)   :: page
      type(model_type), intent(in)     :: model
      type(reactions_type), intent(in) :: answer
      type(table_type) :: table
      integer :: i

      call page%screen%put('')
      call table%start('', table_columns(reaction_table, page%labels, model), page%screen)
      do i = 1, size(answer%parts)
         call row(answer%parts(i), i <= most_reactions)
      end do
      if (size(answer%parts) > most_reactions) call page%screen%put('  ... ALL OF THEM IN THE CSV FILE')
      call row(answer%total, size(answer%parts) > 1)
      call row(answer%loads, .true.)
      call table%add([page%stage_id])
      call table%add(' LEFT')
      call table%skip(7)
      call table%add(answer%left)
      call table%print_row(page%screen)

   contains

      subroutine row(part, is_listed)
         type(reaction_type), intent(in) :: part
         logical, intent(in)             :: is_listed !! also in the listing, not in the file only

         call table%add([page%stage_id])
         call table%add(' '//part%kind)
         call table%add([part%id], where=[part%id > 0])
         call table%add([part%id, part%line, part%nodes], [part%centre, part%force, part%moment, part%about_centre])
         call table%print_row(page%screen, page%tables(reaction_table), is_listed)
      end subroutine row

   end subroutine print_reactions

   !> Print how the nodes of WATCH move, and the share of each component in the compliance.
   subroutine print_watched(page, model, answer)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(watch_answer), intent(in) :: answer
      type(table_type) :: table
      integer :: k

      call page%screen%put('')
      call table%start('', table_columns(watch_table, page%labels, model), page%screen)
      do k = 1, size(answer%nodes)
         associate (node => answer%nodes(k))
            call table%add([page%stage_id, model%node_id(node%node)], [model%x(:, node%node), node%u, node%change, node%load])
            call table%add([norm2(node%load), node%along, norm2(node%load)], where=spread(node%is_loaded, 1, 3))
            call table%add([node%stiffness], where=[node%moves])
         end associate
         call table%print_row(page%screen, page%tables(watch_table))
      end do
      if (size(answer%parts) == 0) return
      call page%screen%put('')
      call table%start('', table_columns(split_table, page%labels, model), page%screen)
      do k = 1, size(answer%parts)
         associate (part => answer%parts(k))
            call table%add([page%stage_id])
            call table%add(' '//part%kind)
            call table%add([part%id], 100.0_wp*[sum(part%share), part%share])
            call table%add([part%first, part%last], where=spread(part%kind == 'BODY', 1, 2))
            call table%add([part%share, sum(part%share)*answer%work])
         end associate
         call table%print_row(page%screen, page%tables(split_table))
      end do
   end subroutine print_watched

end module answer_tables
