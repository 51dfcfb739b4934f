!> The tables of the answer at the end of a stage: a block for screen and listing, and its CSV files. The files are
!! NAME.stage.csv, .bolt.csv, .reaction.csv, .watch.csv and .watch.energy.csv.
module answer_tables
   use analysis_state, only: analysis_type
   use body_values, only: body_values_type, peak_type
   use bolt_answers, only: bolt_answer_type, by_several
   use joint_answers, only: joint_answer
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use page_lines, only: axes, heading
   use result_page, only: bolt_table, clamping_table, has_parts, has_threads, largest_safety, movement_names, page_type, &
                          pair_table, part_names, parts_table, reaction_table, resultant_names, secant_names, split_table, &
                          stage_table, table_columns, tangent_names, vdi_names, vdi_table, watch_table, xyz
   use stage_plan, only: pair_names
   use support_reactions, only: reaction_type, reactions_type
   use table_column, only: column
   use table_writer, only: table_type
   use text_tools, only: integer_text, one_of
   use tolerances, only: page_zero
   use watched_nodes, only: watch_answer
   implicit none
   private

   public :: print_answer, print_bolts, print_reactions, print_watched, write_bolts

   integer, parameter :: most_reactions = 40 ! rows of the block; the file has all rows

contains

   !> Print the answer for BODIES and JOINTS under TITLE on the screen, and its rows into the file of the stages; without joints one
   !! row, with joint 0. The file has the share in contact as a number and every safety; the block has the share in per cent.
   subroutine print_answer(page, title, model, is_first, bodies, joints)
      type(page_type), intent(inout)     :: page
      character(*), intent(in)           :: title
      type(model_type), intent(in)       :: model
      logical, intent(in)                :: is_first !! of the run: what holds for all stages is told
      type(body_values_type), intent(in) :: bodies
      type(joint_answer), intent(in)     :: joints(:)
      character(31), parameter :: names(3) = [character(31) :: 'LARGEST DISPLACEMENT', 'LARGEST VON MISES, CENTRES', &
                                              'LARGEST VON MISES, NODES']
      character(8), parameter  :: kinds(3) = [character(8) :: 'NODE', 'ELEMENT', 'NODE']
      character(13), parameter :: columns(2, 3) = reshape([character(13) :: 'u_max', 'u_node', 'mises_centre', 'mises_element', &
                                                                            'mises_max', 'mises_node'], [2, 3])
      character(12)    :: units(3)
      type(peak_type)  :: peaks(3)
      type(table_type) :: table
      integer :: j, k

      ! the largest displacement and stresses
      units = [character(12) :: page%labels%length, page%labels%pressure, page%labels%pressure]
      peaks = [bodies%displacement, bodies%at_centre, bodies%at_node]
      call heading(page%screen, title)
      call table%start('', [column('', 'a33', key='what'), column('VALUE', 'es13.4'), column('', 'a13', key='unit'), &
                            column('AT', 'a8'), column('NUMBER', 'i11'), &
                            column(axes(:model%mesh%dimension), 'es13.5', page%labels%length)], page%screen)
      do k = 1, 3
         if (.not. peaks(k)%is_there) cycle
         call table%put('what', names(k))
         call table%put('VALUE', peaks(k)%value)
         call table%put('unit', units(k))
         call table%put('AT', trim(kinds(k)))
         call table%put('NUMBER', peaks(k)%id)
         call table%put(axes(:model%mesh%dimension), peaks(k)%x(:model%mesh%dimension))
         call table%print_row(page%screen)
      end do

      ! the joints
      call table%start('', table_columns(stage_table, page%labels, model))
      if (size(joints) == 0) then
         call begin_row(0)
         call table%leave_rest()
         call table%print_row(csv_file=page%tables(stage_table))
         return
      end if
      call page%screen%put('')
      call table%print_head(page%screen)
      do j = 1, size(joints)
         call begin_row(model%joints%list(j)%id)
         associate (joint => joints(j), now => joints(j)%now, frame => model%joints%list(j)%frame)
            call table%put('area', model%joints%list(j)%area)
            call table%put(xyz, frame%centroid)
            call table%put('closed', merge(1, 0, frame%closed))
            call table%put('normal_'//xyz, frame%axes(:, 3), where=spread(.not. frame%closed, 1, 3))
            call table%put('contact', now%contact)
            call table%put('CONTACT %', 100.0_wp*now%contact)
            call table%put('p_max', now%pressure)
            call table%put('p_node', joint_node_id(model, max(now%pressed_at, 1), 1), where=now%pressed_at > 0)
            call table%put('gap_max', now%gap)
            call table%put('gap_node', joint_node_id(model, max(now%open_at, 1), 1), where=now%open_at > 0)
            call table%put('slipping', now%slipping)
            call table%put(['n', 't', 'm'], [joint%normal, joint%shear, joint%moment])
            call table%put('safety', joint%safety, where=joint%has_safety)
            call table%put('MU N/T', joint%safety, where=joint%has_safety .and. joint%safety <= largest_safety)
            call table%put('ring', one_of(frame%closed, '  CLOSED', ''))
            call table%put(resultant_names, joint%force, where=frame%exists)
            call table%put(movement_names, joint%movement, where=frame%exists)
            call table%put(tangent_names, joint%tangent, where=frame%exists)
            call table%put(secant_names, joint%secant, where=joint%has_secant)
         end associate
         call table%print_row(page%screen, page%tables(stage_table))
      end do
      if (is_first) call note_cuts(page, 'THE BODIES OF JOINT', model%joints%list%id, joints%n_cuts, &
                                   'T, MU N/T, M AND SECANT LEAVE OUT WHAT THE MIRROR IMAGE BALANCES')
      call print_stiffnesses(page, model, joints)

   contains

      !> Add the columns that do not concern a joint.
      subroutine begin_row(joint)
         integer, intent(in) :: joint

         call table%put('stage', page%stage_id)
         call table%put('joint', joint)
         do k = 1, 3
            call table%put(trim(columns(1, k)), peaks(k)%value, where=peaks(k)%is_there)
            call table%put(trim(columns(2, k)), peaks(k)%id, where=peaks(k)%is_there)
         end do
      end subroutine begin_row

   end subroutine print_answer

   !> Print for each item with a number of CUTS that planes of symmetry cut it, and WHAT follows, in the first answer of the run.
   subroutine note_cuts(page, kind, id, cuts, what)
      type(page_type), intent(inout) :: page
      character(*), intent(in)       :: kind, what
      integer, intent(in)            :: id(:), cuts(:)
      integer :: i

      do i = 1, size(id)
         if (cuts(i) > 0) call page%screen%put('  NOTE: '//one_of(cuts(i) == 1, 'A PLANE OF SYMMETRY CUTS', &
            'PLANES OF SYMMETRY CUT')//' '//kind//' '//integer_text(id(i))//': '//what)
      end do
   end subroutine note_cuts

   !> Print stiffnesses about the centroids.
   subroutine print_stiffnesses(page, model, joints)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(joint_answer), intent(in) :: joints(:)
      character(14), parameter :: names(6) = [character(14) :: 'ALONG X', 'ALONG Y', 'NORMAL', 'TILT ABOUT X', 'TILT ABOUT Y', &
                                              'TWIST']
      type(table_type) :: table
      character(20) :: unit(6)
      integer :: c, j
      logical :: shown(6)

      shown = [(any([(model%joints%list(j)%frame%exists(c), j = 1, size(joints))]), c = 1, 6)]
      unit(:3) = page%labels%stiffness
      unit(4:) = page%labels%moment
      call page%screen%put('')
      call table%start('', [column('JOINT', 'i11'), column('STIFFNESS', 'a10'), &
                            column(pack(names, shown), 'es14.4', pack(unit, shown))], page%screen)
      do j = 1, size(joints)
         associate (joint => joints(j))
            call table%put('JOINT', model%joints%list(j)%id)
            call table%put('STIFFNESS', 'TANGENT')
            call table%put(pack(names, shown), pack(joint%tangent, shown), where=pack(model%joints%list(j)%frame%exists, shown))
            call table%print_row(page%screen)
            call table%put('JOINT', model%joints%list(j)%id)
            call table%put('STIFFNESS', 'SECANT')
            call table%put(pack(names, shown), pack(joint%secant, shown), where=pack(joint%has_secant, shown))
            call table%print_row(page%screen)
         end associate
      end do
   end subroutine print_stiffnesses

   !> Print the BOLTS in the answer of a stage: forces, then what is known of bolts that have been tightened.
   subroutine print_bolts(page, model, analysis, bolts)
      type(page_type), intent(inout)     :: page
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(bolt_answer_type), intent(in) :: bolts(:)
      type(table_type) :: table
      integer :: i

      if (size(bolts) == 0) return
      call page%screen%put('')
      call table%start('', table_columns(bolt_table, page%labels, model), page%screen)
      do i = 1, size(bolts)
         call fill_bolt_row(page%stage_id, model, analysis, bolts(i), table)
         call table%print_row(page%screen)
      end do
      if (any(bolts%is_locked)) then
         call page%screen%put('')
         call table%start('', table_columns(clamping_table, page%labels, model), page%screen)
         do i = 1, size(bolts)
            associate (bolt => bolts(i), clamps => bolts(i)%joint > 0)
               if (.not. bolt%is_locked) cycle
               call table%put('BOLT', bolt%id)
               call table%put(['TIGHTENED', 'LARGEST  '], [bolt%tightened, bolt%largest])
               call table%put('WHOLE LOAD', bolt%load, where=bolt%has_load)
               call table%put('SHARE', bolt%share, where=bolt%has_share)
               call table%put('STRESS', bolt%stress)
               call table%put('AND BENDING', bolt%edge_stress, where=bolt%has_moment)
               call table%put('OF ST %', 100.0_wp*bolt%use, where=bolt%has_strength)
               call table%put('JOINT', bolt%joint, where=clamps)
               call table%put(['CLAMPING', 'LOSS %  '], [bolt%clamping, 100.0_wp*bolt%loss], where=[clamps, clamps])
               call table%put('MU N/T', bolt%safety, where=bolt%has_safety .and. bolt%safety <= largest_safety)
               call table%print_row(page%screen)
            end associate
         end do
      end if
      if (has_parts(model) .and. any([(any(abs(bolts(i)%by) > 0.0_wp), i = 1, size(bolts))])) then
         call page%screen%put('')
         call table%start('', table_columns(parts_table, page%labels, model), page%screen)
         do i = 1, size(bolts)
            if (.not. bolts(i)%is_locked) cycle
            call table%put('BOLT', bolts(i)%id)
            call table%put(part_names, bolts(i)%by)
            call table%put('SHARE', bolts(i)%share, where=bolts(i)%has_share)
            call table%put('SHARE PRESSURE', bolts(i)%pressure_share, where=bolts(i)%has_pressure_share)
            call table%print_row(page%screen)
         end do
         if (any(abs(bolts%by(by_several)) > 0.0_wp)) call page%screen%put('    NOTE: A STAGE CHANGES LOADS OF SEVERAL KINDS: '// &
            'BY SEVERAL IS NOT SEPARABLE, AND NO PART OF A SHARE; GIVE EACH KIND A STAGE')
      end if
      call print_vdi(page, model, bolts)
      if (analysis%stage == 1) call note_cuts(page, 'BOLT', bolts%id, bolts%n_cuts, &
                     'FORCES AND BENDING ARE OF ITS PART IN THE MODEL, STRESS AND MU N/T OF THE WHOLE')
   end subroutine print_bolts

   !> Print the values of VDI 2230 of the BOLTS with a thread.
   subroutine print_vdi(page, model, bolts)
      type(page_type), intent(inout)     :: page
      type(model_type), intent(in)       :: model
      type(bolt_answer_type), intent(in) :: bolts(:)
      type(table_type) :: table
      integer :: i

      if (all(bolts%thread == '')) return
      call page%screen%put('')
      call page%screen%put('    ONE REAL BOLT AFTER VDI 2230: FORCES, AMPLITUDE OF THE STRESS, SAFETIES')
      call table%start('', table_columns(vdi_table, page%labels, model), page%screen)
      do i = 1, size(bolts)
         if (bolts(i)%thread == '') cycle
         call table%put('BOLT', bolts(i)%id)
         call table%put('THREAD', trim(bolts(i)%thread)//' '//trim(bolts(i)%class))
         call table%put('ALPHA A', bolts(i)%tightening)
         call table%put(vdi_names, bolts(i)%vdi, where=bolts(i)%has_vdi)
         call table%print_row(page%screen)
      end do
   end subroutine print_vdi

   !> Write the BOLTS after an increment into their file.
   subroutine write_bolts(page, model, analysis, bolts)
      type(page_type), intent(inout)     :: page
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(bolt_answer_type), intent(in) :: bolts(:)
      type(table_type) :: table
      integer :: i

      if (size(bolts) == 0) return
      call table%start('', table_columns(bolt_table, page%labels, model))
      do i = 1, size(bolts)
         call fill_bolt_row(page%stage_id, model, analysis, bolts(i), table)
         call table%print_row(csv_file=page%tables(bolt_table))
      end do
   end subroutine write_bolts

   !> Put the values of BOLT into a row of its TABLE.
   subroutine fill_bolt_row(stage, model, analysis, bolt, table)
      integer, intent(in)                :: stage !! its number
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(bolt_answer_type), intent(in) :: bolt
      type(table_type), intent(inout)    :: table

      call table%put('stage', stage)
      call table%put('increment', analysis%increment)
      call table%put('load', analysis%fraction)
      call table%put('bolt', bolt%id)
      call table%put(['ELEMENT', 'SURFACE'], [bolt%element, bolt%surface], where=[bolt%element, bolt%surface] > 0)
      call table%put([character(6) :: 'force', 'change'], [bolt%force, bolt%change])
      call table%put('load_change', bolt%load_change, where=bolt%has_load)
      call table%put('ratio', bolt%ratio, where=bolt%has_ratio)
      call table%put('bending', bolt%moment, where=bolt%has_moment)
      call table%put('longer', bolt%longer)
      call table%put(['element', 'surface'], [bolt%element, bolt%surface])
      call table%put(['tightened', 'largest  '], [bolt%tightened, bolt%largest], where=spread(bolt%is_locked, 1, 2))
      call table%put('whole_load', bolt%load, where=bolt%is_locked .and. bolt%has_load)
      call table%put('share', bolt%share, where=bolt%has_share)
      call table%put('stress', bolt%stress)
      call table%put('edge_stress', bolt%edge_stress, where=bolt%has_moment)
      call table%put('use', bolt%use, where=bolt%has_strength)
      call table%put('joint', bolt%joint, where=bolt%joint > 0)
      call table%put(['clamping', 'loss    '], [bolt%clamping, bolt%loss], where=spread(bolt%joint > 0, 1, 2))
      call table%put('safety', bolt%safety, where=bolt%has_safety)
      if (has_parts(model)) then
         call table%put(part_names, bolt%by, where=spread(bolt%is_locked, 1, 4))
         call table%put('share_pressure', bolt%pressure_share, where=bolt%has_pressure_share)
      end if
      if (has_threads(model)) call table%put(vdi_names, bolt%vdi, where=bolt%has_vdi)
   end subroutine fill_bolt_row

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
      call table%put('kind', ' LEFT')
      call table%put('force_'//xyz, answer%left)
      call table%leave_rest()
      call table%print_row(page%screen)

   contains

      subroutine row(part, is_listed)
         type(reaction_type), intent(in) :: part
         logical, intent(in)             :: is_listed !! also in the listing, not in the file only

         call table%put('stage', page%stage_id)
         call table%put('kind', ' '//part%kind)
         call table%put('NUMBER', part%id, where=part%id > 0)
         call table%put([character(5) :: 'id', 'line', 'nodes'], [part%id, part%line, part%nodes])
         call table%put(xyz, part%centre)
         call table%put('force_'//xyz, part%force)
         call table%put('moment_'//xyz, part%moment)
         call table%put('central_'//xyz, part%about_centre)
         call table%print_row(page%screen, page%tables(reaction_table), is_listed)
      end subroutine row

   end subroutine print_reactions

   !> Print how the nodes of WATCH move, and the share of each component in the compliance.
   subroutine print_watched(page, model, answer)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(watch_answer), intent(in) :: answer
      type(table_type) :: table
      integer :: i, k

      if (size(answer%nodes) > 0) then
         call page%screen%put('')
         call table%start('', table_columns(watch_table, page%labels, model), page%screen)
      end if
      do k = 1, size(answer%nodes)
         associate (node => answer%nodes(k))
            call table%put('stage', page%stage_id)
            call table%put('node', model%mesh%node_id(node%node))
            call table%put(xyz, model%mesh%x(:, node%node))
            call table%put([character(8) :: 'u_'//xyz, 'change_'//xyz], [node%u, node%change], &
                           page_zero*maxval(abs([node%u, node%change])))
            call table%put('load_'//xyz, node%load)
            call table%put(['LOAD ', 'along', 'load '], [norm2(node%load), node%along, norm2(node%load)], &
                           where=spread(node%is_loaded, 1, 3))
            call table%put('stiffness', node%stiffness, where=node%moves)
         end associate
         call table%print_row(page%screen, page%tables(watch_table))
      end do
      if (size(answer%pairs) > 0) then
         call page%screen%put('')
         call table%start('', table_columns(pair_table, page%labels, model), page%screen)
      end if
      do k = 1, size(answer%pairs)
         associate (pair => answer%pairs(k))
            do i = 1, size(pair_names)
               if (.not. any(abs(pair%pair%along(:, i)) > 0.0_wp)) cycle
               call table%put('stage', page%stage_id)
               call table%put(['from', 'to  '], pair%pair%ids)
               call table%put('along', trim(pair_names(i)))
               call table%put([character(8) :: 'movement', 'change'], [pair%moved(i), pair%change(i)], &
                              page_zero*maxval(abs([pair%moved, pair%change])))
               call table%put('load', pair%load(i), where=abs(pair%load(i)) > 0.0_wp)
               call table%put('stiffness', pair%stiffness(i), where=abs(pair%stiffness(i)) > 0.0_wp)
               call table%print_row(page%screen, page%tables(pair_table))
            end do
         end associate
      end do
      if (size(answer%parts) == 0) return
      call page%screen%put('')
      call table%start('', table_columns(split_table, page%labels, model), page%screen)
      do k = 1, size(answer%parts)
         associate (part => answer%parts(k))
            call table%put('stage', page%stage_id)
            call table%put('kind', ' '//part%kind)
            call table%put('id', part%id)
            call table%put([character(8) :: 'SHARE %', 'NORMAL %', 'SHEAR %'], 100.0_wp*[sum(part%share), part%share])
            call table%put([character(12) :: 'FROM ELEMENT', 'TO ELEMENT'], [part%first, part%last], &
                           where=spread(part%kind == 'BODY', 1, 2))
            call table%put(['normal', 'shear '], part%share)
            call table%put('work', sum(part%share)*answer%work)
         end associate
         call table%print_row(page%screen, page%tables(split_table))
      end do
   end subroutine print_watched

end module answer_tables
