!> The tables of the answer at the end of a stage: a block for screen and listing, and its CSV files. The files are
!! NAME.stage.csv, .bolt.csv, .reaction.csv, .watch.csv and .watch.energy.csv. A table and the CSV file of the same subject
!! share one list of columns.
module answer_tables
   use analysis_state, only: analysis_type
   use bolt_answers, only: bolt_answer_type
   use kinds, only: wp
   use table_writer, only: axes, bolt_table, column, column_type, csv, heading, label_type, table_type, page_type, &
                            reaction_table, split_table, stage_table, watch_table
   use model_data, only: joint_node_id, model_type
   use output_file, only: output_file_type
   use stage_answer, only: peak_type, stage_answer_type
   use support_reactions, only: reaction_type, reactions_type
   use watched_nodes, only: watch_answer
   implicit none
   private

   public :: stage_columns, bolt_columns, reaction_columns, watch_columns, split_columns, print_answer, print_bolts, &
             print_reactions, &
             print_watched

   integer, parameter      :: most_reactions = 40 ! rows of the block; the file has all rows
   character(1), parameter :: xyz(3) = ['x', 'y', 'z']

contains

   !> A row for each joint: the largest values of the bodies, contact, transmitted forces, movement of the sides, stiffness. The
   !! file has the share in contact and the safety as numbers; the block has the share in per cent and the safety below a
   !! million.
   function stage_columns(labels) result(columns)
      type(label_type), intent(in)   :: labels
      type(column_type), allocatable :: columns(:)

      columns = [csv('stage'), column('JOINT', 'i11', name='joint'), &
                 csv([character(13) :: 'u_max', 'u_node', 'mises_centre', 'mises_element', 'mises_max', 'mises_node', 'area', xyz, &
                      'closed', 'normal_'//xyz, 'contact']), column('CONTACT %', 'f10.2'), &
                 column('P MAX', 'es12.4', labels%pressure, name='p_max'), column('AT NODE', 'i11', name='p_node'), &
                 column('GAP MAX', 'es12.4', labels%length, name='gap_max'), column('AT NODE', 'i11', name='gap_node'), &
                 column('SLIPPING', 'i9', name='slipping'), column(['N', 'T'], 'es12.4', labels%force, name=['n', 't']), &
                 column('M', 'es12.4', labels%moment, name='m'), csv('safety'), column('MU N/T', 'f11.3'), column('', 'a'), &
                 csv([character(14) :: 'force_x', 'force_y', 'force_n', 'moment_x', 'moment_y', 'moment_n', &
                      'move_x', 'move_y', 'move_n', 'turn_x', 'turn_y', 'turn_n', &
                      'tangent_x', 'tangent_y', 'tangent_n', 'tangent_tilt_x', 'tangent_tilt_y', 'tangent_twist', &
                      'secant_x', 'secant_y', 'secant_n', 'secant_tilt_x', 'secant_tilt_y', 'secant_twist'])]
   end function stage_columns

   !> A row for each bolt. The listing has two blocks: forces of the stage; and values since the bolt was tightened, with its
   !! stress and clamping force.
   function bolt_columns(labels, block) result(columns)
      type(label_type), intent(in)   :: labels
      integer, intent(in)            :: block !! 1 or 2
      type(column_type), allocatable :: columns(:)
      logical :: first, second

      first = block == 1
      second = block == 2
      columns = [csv([character(9) :: 'stage', 'increment', 'load']), column('BOLT', 'i11', name='bolt'), &
                 column(['ELEMENT', 'SURFACE'], 'i11', is_listed=first), &
                 column([character(6) :: 'FORCE', 'CHANGE', 'LOAD'], 'es13.4', labels%force, &
                        name=[character(11) :: 'force', 'change', 'load_change'], is_listed=first), &
                 column('CHANGE/LOAD', 'f13.5', name='ratio', is_listed=first), &
                 column('BENDING', 'es13.4', labels%moment, name='bending', is_listed=first), csv(['longer ', 'element', &
                                                                                                   'surface']), &
                 column([character(9) :: 'TIGHTENED', 'LARGEST', 'ALL LOADS'], 'es12.4', labels%force, &
                        name=[character(9) :: 'tightened', 'largest', 'all_loads'], is_listed=second), &
                 column('SHARE', 'f9.5', name='share', is_listed=second), &
                 column(['STRESS     ', 'AND BENDING'], 'es12.4', labels%pressure, name=['stress     ', 'edge_stress'], &
                        is_listed=second), &
                 csv('use'), column('OF ST %', 'f9.2', is_listed=second), column('JOINT', 'i9', name='joint', is_listed=second), &
                 column('CLAMPING', 'es12.4', labels%force, name='clamping', is_listed=second), &
                 csv('loss'), column('LOSS %', 'f9.2', is_listed=second), csv('safety'), column('MU N/T', 'f11.3', &
                                                                                                is_listed=second)]
   end function bolt_columns

   !> A row for each support, their sum, the loads. A plane model has the moment about z only.
   function reaction_columns(labels, dimension) result(columns)
      type(label_type), intent(in)   :: labels
      integer, intent(in)            :: dimension
      type(column_type), allocatable :: columns(:)
      logical :: along(3), about(3)

      along = [.true., .true., dimension == 3]
      about = [dimension == 3, dimension == 3, .true.]
      columns = [csv('stage'), column('REACTIONS', 'a9', name='kind'), column('NUMBER', 'i11'), csv(['id  ', 'line']), &
                 column('NODES', 'i8', name='nodes'), csv(xyz), &
                 column('R'//axes, 'es12.4', labels%force, name='force_'//xyz, is_listed=along), &
                 column('M'//axes, 'es11.3', labels%moment, name='moment_'//xyz, is_listed=about), &
                 column('MC'//axes, 'es11.3', labels%moment, name='central_'//xyz, is_listed=about)]
   end function reaction_columns

   !> A row for each node of WATCH.
   function watch_columns(labels, dimension) result(columns)
      type(label_type), intent(in)   :: labels
      integer, intent(in)            :: dimension
      type(column_type), allocatable :: columns(:)
      logical :: along(3)

      along = [.true., .true., dimension == 3]
      columns = [csv('stage'), column('WATCHED', 'i11', name='node'), csv(xyz), &
                 column('U'//axes, 'es13.4', labels%length, name='u_'//xyz, is_listed=along), &
                 column('CHANGE '//axes, 'es13.4', labels%length, name='change_'//xyz, is_listed=along), csv('load_'//xyz), &
                 column('LOAD', 'es13.4', labels%force), column('ALONG IT', 'es13.4', labels%length, name='along'), csv('load'), &
                 column('STIFFNESS', 'es13.4', labels%stiffness, name='stiffness')]
   end function watch_columns

   !> A row for each body, joint, bar and spring: its share of the work of the stage.
   function split_columns() result(columns)
      type(column_type), allocatable :: columns(:)

      columns = [csv('stage'), column('GIVES WAY', 'a11', name='kind'), column('NUMBER', 'i11', name='id'), &
                 column([character(8) :: 'SHARE %', 'NORMAL %', 'SHEAR %'], 'f11.4'), &
                 column([character(12) :: 'FROM ELEMENT', 'TO ELEMENT'], 'i14'), csv(['normal', 'shear ', 'work  '])]
   end function split_columns

   !> Print ANSWER under TITLE on the screen, and its rows into the file of the stages; without joints one row, with joint 0.
   subroutine print_answer(page, title, model, answer)
      type(page_type), intent(inout)      :: page
      character(*), intent(in)            :: title
      type(model_type), intent(in)        :: model
      type(stage_answer_type), intent(in) :: answer
      type(table_type) :: table
      integer :: j

      call heading(page%screen, title)
      call print_peaks(page%screen, page%labels, model, answer)
      call table%start('', stage_columns(page%labels))
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
            call table%add([joint%safety, min(joint%safety, 999999.0_wp)], where=spread(joint%has_safety, 1, 2))
            call table%add(trim(merge('  CLOSED', '        ', frame%closed)))
            call table%add([joint%force, joint%movement, joint%tangent], where=[frame%exists, frame%exists, frame%exists])
            call table%add(joint%secant, where=joint%has_secant)
         end associate
         call table%print_row(page%screen, page%tables(stage_table))
      end do
      call print_stiffnesses(page%screen, page%labels, model, answer)

   contains

      !> Add the columns that do not concern a joint.
      subroutine begin_row(joint)
         integer, intent(in) :: joint

         call table%add([page%stage_id, joint])
         call add_peak(answer%displacement)
         call add_peak(answer%at_centre)
         call add_peak(answer%at_node)
      end subroutine begin_row

      subroutine add_peak(peak)
         type(peak_type), intent(in) :: peak

         call table%add([peak%value], where=[peak%is_there])
         call table%add([peak%id], where=[peak%is_there])
      end subroutine add_peak

      !> Add the node of interface element I, or an empty field.
      subroutine add_node(i)
         integer, intent(in) :: i

         call table%add([joint_node_id(model, max(i, 1), 1)], where=[i > 0])
      end subroutine add_node

   end subroutine print_answer

   !> Print displacement and stress.
   subroutine print_peaks(file, labels, model, answer)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      type(model_type), intent(in)          :: model
      type(stage_answer_type), intent(in)   :: answer
      type(table_type) :: table

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
         call table%add(name, [peak%value])
         call table%add(label)
         call table%add(kind)
         call table%add([peak%id], peak%x(:model%dimension))
         call table%print_row(file)
      end subroutine row

   end subroutine print_peaks

   !> Print stiffnesses about the centroids.
   subroutine print_stiffnesses(file, labels, model, answer)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      type(model_type), intent(in)          :: model
      type(stage_answer_type), intent(in)   :: answer
      character(14), parameter :: names(6) = [character(14) :: 'ALONG X', 'ALONG Y', 'NORMAL', 'TILT ABOUT X', 'TILT ABOUT Y', &
                                              'TWIST']
      type(table_type) :: table
      character(20) :: unit(6)
      integer :: c, j
      logical :: shown(6)

      shown = [(any([(model%joints(j)%frame%exists(c), j = 1, size(answer%joints))]), c = 1, 6)]
      unit(:3) = labels%stiffness
      unit(4:) = labels%moment
      call file%put('')
      call table%start('', [column('JOINT', 'i11'), column('STIFFNESS', 'a10'), &
                            column(pack(names, shown), 'es14.4', pack(unit, shown))], file)
      do j = 1, size(answer%joints)
         associate (joint => answer%joints(j))
            call row('TANGENT', joint%tangent, model%joints(j)%frame%exists)
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

   !> Print the BOLTS of ANALYSIS: in the answer of a stage on the screen, after every increment in their file.
   subroutine print_bolts(page, analysis, bolts, in_answer)
      type(page_type), intent(inout)     :: page
      type(analysis_type), intent(in)    :: analysis
      type(bolt_answer_type), intent(in) :: bolts(:)
      logical, intent(in)                :: in_answer
      type(table_type) :: table
      integer :: block, i

      do block = 1, merge(2, 1, in_answer .and. any(bolts%is_locked))
         if (size(bolts) == 0) return
         call table%start('', bolt_columns(page%labels, block))
         if (in_answer) call page%screen%put('')
         if (in_answer) call table%print_head(page%screen)
         do i = 1, size(bolts)
            if (block == 2 .and. .not. bolts(i)%is_locked) cycle
            call fill_row(bolts(i), bolts(i)%is_locked, bolts(i)%joint > 0)
            if (in_answer) call table%print_row(page%screen)
            if (.not. in_answer) call table%print_row(csv_file=page%tables(bolt_table))
         end do
      end do

   contains

      subroutine fill_row(bolt, locked, clamps)
         type(bolt_answer_type), intent(in) :: bolt
         logical, intent(in)                :: locked, clamps

         call table%add([page%stage_id, analysis%increment], [analysis%fraction])
         call table%add([bolt%id])
         call table%add([bolt%element, bolt%surface], where=[bolt%element, bolt%surface] > 0)
         call table%add([bolt%force, bolt%change, bolt%load_change])
         call table%add([bolt%ratio, bolt%moment], where=[bolt%has_ratio, bolt%has_moment])
         call table%add([bolt%longer])
         call table%add([bolt%element, bolt%surface])
         call table%add([bolt%tightened, bolt%largest, bolt%load], where=spread(locked, 1, 3))
         call table%add([bolt%share, bolt%stress, bolt%edge_stress, bolt%use, 100.0_wp*bolt%use], &
                        where=[bolt%has_share, .true., bolt%has_moment, bolt%has_strength, bolt%has_strength])
         call table%add([bolt%joint], where=[clamps])
         call table%add([bolt%clamping, bolt%loss, 100.0_wp*bolt%loss, bolt%safety, min(bolt%safety, 999999.0_wp)], &
                        where=[clamps, clamps, clamps, bolt%has_safety, bolt%has_safety])
      end subroutine fill_row

   end subroutine print_bolts

   !> Print the support reactions; the last line is the balance.
   subroutine print_reactions(page, model, answer)
      type(page_type), intent(inout)   :: page
      type(model_type), intent(in)     :: model
      type(reactions_type), intent(in) :: answer
      type(table_type) :: table
      integer :: i

      call page%screen%put('')
      call table%start('', reaction_columns(page%labels, model%dimension), page%screen)
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
      call table%start('', watch_columns(page%labels, model%dimension), page%screen)
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
      call table%start('', split_columns(), page%screen)
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
