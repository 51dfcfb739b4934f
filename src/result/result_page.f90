!> What all tables of the results share: the open files, the units, the stage and increment shown, and the columns of the CSV files.
!! A table and the CSV file of the same subject share one list of columns; the listing shows those with a heading.
module result_page
   use kinds, only: wp
   use model_data, only: model_type
   use output_file, only: output_file_type
   use page_lines, only: axes
   use restart_stream, only: restart_stream_type
   use table_column, only: column, column_type, csv
   implicit none
   private

   public :: set_labels, shows, has_gaps, has_parts, has_threads, table_columns, record_page

   character(1), parameter, public :: xyz(3) = ['x', 'y', 'z']
   real(wp), parameter, public :: largest_safety = 1000.0_wp !! against slip: tables leave a larger one blank

   ! the CSV files in the order of their endings; clamping, parts and safeties of the bolts are tables of the listing only
   integer, parameter, public :: joint_table = 1, stage_table = 2, bolt_table = 3, modes_table = 4, energy_table = 5, &
                                 response_table = 6, backbone_table = 7, loop_table = 8, bend_table = 9, watch_table = 10, &
                                 split_table = 11, reaction_table = 12, shell_table = 13, pair_table = 14, &
                                 pair_modes_table = 15, pair_response_table = 16, cases_table = 17, dmig_table = 18, &
                                 clamping_table = 19, parts_table = 20, vdi_table = 21
   character(*), parameter, public :: history_ending = '.joint.csv'
   character(22), parameter, public :: table_endings(18) = [character(22) :: history_ending, '.stage.csv', '.bolt.csv', &
      '.modes.csv', '.modes.energy.csv', '.response.csv', '.backbone.csv', '.loop.csv', '.backbone.response.csv', '.watch.csv', &
      '.watch.energy.csv', '.reaction.csv', '.shell.csv', '.between.csv', '.between.modes.csv', '.between.response.csv', &
      '.cases.csv', '.dmig']

   !> The values of a case in .cases.csv.
   character(9), parameter, public :: case_names(10) = [character(9) :: 'u_max', 'mises_max', 'p_max', 'contact', 'safety', &
      'bolt_min', 'use', 'along', 'stiffness', 'frequency']

   ! the six components of a joint in .stage.csv, in its axes
   character(14), parameter, public :: &
      resultant_names(6) = [character(14) :: 'force_x', 'force_y', 'force_n', 'moment_x', 'moment_y', 'moment_n'], &
      movement_names(6) = [character(14) :: 'move_x', 'move_y', 'move_n', 'turn_x', 'turn_y', 'turn_n'], &
      tangent_names(6) = [character(14) :: 'tangent_x', 'tangent_y', 'tangent_n', 'tangent_tilt_x', 'tangent_tilt_y', &
                          'tangent_twist'], &
      secant_names(6) = [character(14) :: 'secant_x', 'secant_y', 'secant_n', 'secant_tilt_x', 'secant_tilt_y', 'secant_twist']

   ! bolts: changes of the tension by kinds of stages; values of VDI 2230
   character(14), parameter, public :: &
      part_names(4) = [character(14) :: 'by_forces', 'by_temperature', 'by_pressure', 'by_several'], &
      vdi_names(10) = [character(14) :: 'assembly_force', 'allowed_force', 'working_load', 'residual', 'amplitude', 'yield', &
                       'fatigue', 'fatigue_rolled', 'slip', 'opening']

   !> The units of the numbers of the listing, blank where the deck names none.
   type, public :: label_type
      character(20) :: length = '', force = '', pressure = '', area = '', stiffness = '', moment = ''
      character(20) :: slope = ''     !! of pressure over length
      character(20) :: compliance = ''
   end type label_type

   !> The files and settings common to all tables.
   type, public :: page_type
      type(output_file_type) :: file          !! the listing
      type(output_file_type) :: screen        !! answers, for the standard output at the end
      type(output_file_type) :: tables(size(table_endings)) !! open where the deck asks for them
      type(label_type)       :: labels
      integer :: stage_id = 0                 !! number of the stage
      character(:), allocatable :: stage, now !! 'STAGE 2'; ', STAGE 2, INCREMENT 5' behind a title
      character(:), allocatable :: label, place !! of the stage; 'stage 2, increment 5' in messages
      real(wp) :: largest_force = 0.0_wp      !! largest applied so far, the scale of rounding
      logical, allocatable :: shown(:)        !! nodes to which the tables of this stage are limited; not allocated: all
      logical :: along_cd = .false.           !! nodal tables of this stage are along the systems CD
      character(:), allocatable :: date       !! date for the head, if wanted
   end type page_type

contains

   !> The units above the columns, from those of LENGTH and FORCE. (A structure constructor is freed twice by gfortran 12 at -O0.)
   pure subroutine set_labels(length, force, labels)
      character(*), intent(in)        :: length, force
      type(label_type), intent(inout) :: labels

      labels%length = length
      labels%force = force
      labels%pressure = force//'/'//length//'2'
      labels%area = length//'2'
      labels%stiffness = force//'/'//length
      labels%moment = force//' '//length
      labels%slope = force//'/'//length//'2/'//length
      labels%compliance = length//'/'//force
   end subroutine set_labels

   !> Whether tables limited to some nodes show an item with these NODES.
   pure logical function shows(page, nodes)
      type(page_type), intent(in) :: page
      integer, intent(in)         :: nodes(:)

      shows = .true.
      if (allocated(page%shown)) shows = any(page%shown(nodes))
   end function shows

   !> Whether the deck gives the initial gap of any joint.
   pure logical function has_gaps(model)
      type(model_type), intent(in) :: model

      has_gaps = any(model%joints%list%gap_kind /= '')
   end function has_gaps

   !> Whether the tensions of bolts are said by kinds: a stage changes pressures or temperatures.
   pure logical function has_parts(model)
      type(model_type), intent(in) :: model
      integer :: s

      has_parts = any([(model%history%stages(s)%changes(2:), s = 1, size(model%history%stages))])
   end function has_parts

   !> Whether any bolt has a thread.
   pure logical function has_threads(model)
      type(model_type), intent(in) :: model

      has_threads = any(model%mesh%bars%thread%size /= '') .or. any(model%mesh%sections%thread%size /= '')
   end function has_threads

   !> The columns of one of the tables with a CSV file. Of a plane model the listing shows components in the plane and moments
   !! about z only.
   function table_columns(table, labels, model) result(columns)
      integer, intent(in)            :: table
      type(label_type), intent(in)   :: labels
      type(model_type), intent(in)   :: model
      type(column_type), allocatable :: columns(:)
      logical :: along(3), about(3)

      along = [.true., .true., model%mesh%dimension == 3]
      about = [model%mesh%dimension == 3, model%mesh%dimension == 3, .true.]
      select case (table)
      case (joint_table) ! a row for each interface element and increment; GAP and SLID only where the deck has them
         columns = csv([character(9) :: 'stage', 'increment', 'load', 'joint', 'element', 'node1', 'node2', xyz, 'area', 'branch', &
            'lambda', 'pressure', 'force', 'k_n', 'branch_x', 'delta_x', 'tau_x', 'k_sx', 'branch_y', 'delta_y', 'tau_y', 'k_sy', &
            'slip'])
         if (has_gaps(model)) columns = [columns, csv('gap')]
         if (any(model%joints%list%law%has_friction)) columns = [columns, csv(['slid_x', 'slid_y'])]
      case (stage_table) ! for each joint: peaks of the bodies, contact, forces, movement, stiffness; percent in the listing only
         columns = [csv('stage'), column('JOINT', 'i11', name='joint'), &
            csv([character(13) :: 'u_max', 'u_node', 'mises_centre', 'mises_element', 'mises_max', 'mises_node', 'area', xyz, &
            'closed', 'normal_'//xyz, 'contact']), column('CONTACT %', 'f10.2'), &
            column('P MAX', 'es12.4', labels%pressure, name='p_max'), column('AT NODE', 'i11', name='p_node'), &
            column('GAP MAX', 'es12.4', labels%length, name='gap_max'), column('AT NODE', 'i11', name='gap_node'), &
            column('SLIPPING', 'i9', name='slipping'), column(['N', 'T'], 'es12.4', labels%force, name=['n', 't']), &
            column('M', 'es12.4', labels%moment, name='m'), csv('safety'), column('MU N/T', 'f11.3'), column('', 'a', key='ring'), &
            csv([resultant_names, movement_names, tangent_names, secant_names])]
      case (bolt_table) ! for each bolt: the forces of the stage are listed; the file has the columns of both tables
         columns = [csv([character(9) :: 'stage', 'increment', 'load']), column('BOLT', 'i11', name='bolt'), &
            column(['ELEMENT', 'SURFACE'], 'i11'), &
            column([character(6) :: 'FORCE', 'CHANGE', 'LOAD'], 'es13.4', labels%force, &
            name=[character(11) :: 'force', 'change', 'load_change']), column('CHANGE/LOAD', 'f13.5', name='ratio'), &
            column('BENDING', 'es13.4', labels%moment, name='bending'), csv([character(11) :: 'longer', 'element', 'surface', &
            'tightened', 'largest', 'whole_load', 'share', 'stress', 'edge_stress', 'use', 'joint', 'clamping', 'loss', 'safety'])]
         if (has_parts(model)) columns = [columns, csv(part_names), csv('share_pressure')]
         if (has_threads(model)) columns = [columns, csv(vdi_names)]
      case (clamping_table) ! for each bolt: values since it was tightened, stress, clamping force
         columns = [column('BOLT', 'i11'), column([character(10) :: 'TIGHTENED', 'LARGEST', 'WHOLE LOAD'], 'es12.4', &
            labels%force), column('SHARE', 'f9.5'), column(['STRESS     ', 'AND BENDING'], 'es12.4', labels%pressure), &
            column('OF ST %', 'f9.2'), column('JOINT', 'i9'), column('CLAMPING', 'es12.4', labels%force), &
            column('LOSS %', 'f9.2'), column('MU N/T', 'f11.3')]
      case (parts_table) ! for each bolt: changes of its tension since assembly, by kinds of stages
         columns = [column('BOLT', 'i11'), column([character(14) :: 'BY FORCES', 'BY TEMPERATURE', 'BY PRESSURE', 'BY SEVERAL'], &
            'es15.4', labels%force, key=part_names), column(['SHARE         ', 'SHARE PRESSURE'], 'f15.5')]
      case (vdi_table) ! for each bolt with a thread
         columns = [column('BOLT', 'i11'), column('THREAD', 'a10'), column('ALPHA A', 'f9.2'), &
            column([character(8) :: 'ASSEMBLY', 'ALLOWED', 'WORKING', 'RESIDUAL'], 'es11.3', labels%force, key=vdi_names(:4)), &
            column('AMPLITUDE', 'es11.3', labels%pressure, key=vdi_names(5)), column([character(7) :: 'YIELD', 'FATIGUE', &
            'ROLLED', 'SLIP', 'OPENING'], 'f9.2', key=vdi_names(6:))]
      case (reaction_table) ! for each support, their sum, the loads
         columns = [csv('stage'), column('REACTIONS', 'a9', name='kind'), column('NUMBER', 'i11'), csv(['id  ', 'line']), &
            column('NODES', 'i8', name='nodes'), csv(xyz), &
            column('R'//axes, 'es12.4', labels%force, name='force_'//xyz, is_listed=along), &
            column('M'//axes, 'es11.3', labels%moment, name='moment_'//xyz, is_listed=about), &
            column('MC'//axes, 'es11.3', labels%moment, name='central_'//xyz, is_listed=about)]
      case (watch_table) ! for each node of WATCH
         columns = [csv('stage'), column('WATCHED', 'i11', name='node'), csv(xyz), &
            column('U'//axes, 'es13.4', labels%length, name='u_'//xyz, is_listed=along), &
            column('CHANGE '//axes, 'es13.4', labels%length, name='change_'//xyz, is_listed=along), csv('load_'//xyz), &
            column('LOAD', 'es13.4', labels%force), column('ALONG IT', 'es13.4', labels%length, name='along'), csv('load'), &
            column('STIFFNESS', 'es13.4', labels%stiffness, name='stiffness')]
      case default
         columns = more_columns(table, labels)
      end select
   end function table_columns

   !> The columns of the tables of work, shells and oscillation.
   function more_columns(table, labels) result(columns)
      integer, intent(in)            :: table
      type(label_type), intent(in)   :: labels
      type(column_type), allocatable :: columns(:)

      select case (table)
      case (split_table) ! for each body, joint, bar and spring: its share of the work of the stage
         columns = [csv('stage'), column('GIVES WAY', 'a11', name='kind'), column('NUMBER', 'i11', name='id'), &
            column([character(8) :: 'SHARE %', 'NORMAL %', 'SHEAR %'], 'f11.4'), &
            column([character(12) :: 'FROM ELEMENT', 'TO ELEMENT'], 'i14'), csv(['normal', 'shear ', 'work  '])]
      case (pair_table, pair_modes_table, pair_response_table) ! for each pair of WATCH and direction, each mode, each frequency
         columns = [column('BETWEEN', 'i11', name='from'), column('AND', 'i11', name='to'), column('ALONG', 'a6', name='along')]
         if (table == pair_table) columns = [csv('stage'), columns, &
            column([character(8) :: 'MOVEMENT', 'CHANGE'], 'es13.4', labels%length, name=[character(8) :: 'movement', 'change']), &
            column('LOAD', 'es13.4', labels%force, name='load'), column('STIFFNESS', 'es13.4', labels%stiffness, name='stiffness')]
         if (table == pair_modes_table) columns = [csv('stage'), column('MODE', 'i6', name='mode'), &
            column('FREQUENCY', 'es15.5', '1/TIME', name='frequency'), columns, column('MOVEMENT', 'es14.5', name='movement'), &
            column('COMPLIANCE', 'es14.5', labels%compliance, name='compliance')]
         if (table == pair_response_table) columns = [csv(['stage    ', 'frequency']), columns, &
            column('AMPLITUDE', 'es14.5', labels%length, name='amplitude'), csv('phase'), &
            column('AT FREQUENCY', 'es14.5', '1/TIME'), column(['COMPLIANCE     ', 'LEAST REAL PART'], 'es17.5', &
            labels%compliance), column('AT FREQUENCY', 'es14.5', '1/TIME', key='OF LEAST'), csv(['real     ', 'imaginary'])]
      case (shell_table) ! forces and moments per length: for the centre of each shell and, in the file, every corner
         columns = [csv([character(9) :: 'stage', 'increment', 'load']), column('ELEMENT', 'i11', name='element'), &
            csv([character(4) :: 'node', xyz]), &
            column(['N X ', 'N Y ', 'N XY'], 'es13.5', labels%stiffness, name=['n_x ', 'n_y ', 'n_xy']), &
            column(['M X ', 'M Y ', 'M XY'], 'es13.5', labels%force, name=['m_x ', 'm_y ', 'm_xy']), &
            column(['Q X', 'Q Y'], 'es13.5', labels%stiffness, name=['q_x', 'q_y'])]
      case (cases_table) ! for each case, then the worst of each column and its stage
         columns = [column('', 'a6', name='kind'), column('STAGE', 'i6', name='stage'), column('FROM', 'i6', name='from'), &
            column('U MAX', 'es11.3', labels%length, name='u_max'), &
            column(['MISES MAX', 'P MAX    '], 'es11.3', labels%pressure, name=['mises_max', 'p_max    ']), &
            column('CONTACT', 'f9.4', name='contact'), column('MU N/T', 'f9.3', name='safety'), &
            column('LEAST BOLT', 'es11.3', labels%force, name='bolt_min'), column('OF ST', 'f8.4', name='use'), &
            column('ALONG LOAD', 'es11.3', labels%length, name='along'), &
            column('STIFFNESS', 'es11.3', labels%stiffness, name='stiffness'), &
            column('FREQUENCY', 'es11.3', '1/TIME', name='frequency'), column('   LABEL', 'a')]
      case (modes_table) ! for each mode; the effective masses have a table of their own in the listing
         columns = [csv('stage'), column('MODE', 'i6', name='mode'), column('FREQUENCY', 'es15.5', '1/TIME', name='frequency'), &
            column('OMEGA', 'es15.5', 'RAD/TIME', name='omega'), column('GENERALISED MASS', 'es18.5'), &
            column('RESIDUAL', 'es12.1', name='residual'), csv('mass_'//xyz), &
            column('LOSS FACTOR', 'es15.5', name='loss_factor'), column('MOST ENERGY', 'a14', name='kind'), &
            column('NUMBER', 'i11', name='id'), column('PERCENT', 'f9.2'), csv('energy')]
      case (energy_table) ! for each body, joint and bar: its share of the strain energy; bodies and bars stand under normal
         columns = [csv('stage'), column('MODE', 'i6', name='mode'), column('PART', 'a8', name='kind'), &
            column('NUMBER', 'i11', name='id'), column(['ALL   ', 'NORMAL', 'SHEAR '], 'f10.2'), csv(['normal', 'shear '])]
      case (backbone_table) ! for each amplitude
         columns = [csv(['stage', 'mode ']), column('AMPLITUDE', 'es14.5', labels%length, name='amplitude'), &
            column('FREQUENCY', 'es14.5', '1/TIME', name='frequency'), column('SHIFT', 'f10.4', 'PERCENT'), &
            column('LOSS FACTOR', 'es14.4', name='loss_factor'), csv(['slipping', 'open    ']), &
            column('SLIPPING', 'f10.2', 'PERCENT'), column('OPEN', 'f8.2', 'PERCENT'), column('CENTRE', 'f9.4'), &
            column('NOT CLOSED', 'f12.6'), column('DISTORTION', 'f12.5', name='distortion'), column('LOOPS', 'i7')]
      case (bend_table) ! for each amplitude of the response of the mode alone, ascending; the listing has the resonances only
         columns = [csv(['stage', 'mode ']), column('AMPLITUDE', 'es14.5', labels%length, name='amplitude'), &
            column('FREQUENCY', 'es14.5', '1/TIME', name='below'), csv([character(11) :: 'phase_below', 'above', 'phase_above'])]
      case (loop_table) ! for each point of the last loop of each amplitude, from its upper turning point on
         columns = csv([character(9) :: 'stage', 'mode', 'amplitude', 'point', 'alpha', 'q'])
      case default ! the response: for each frequency, node and component
         columns = csv([character(9) :: 'stage', 'frequency', 'node', 'component', 'amplitude', 'phase'])
      end select
   end function more_columns

   !> Write the page to a restart file, or read it into the open files of the same deck. Labels and date are in the head of the
   !! listing.
   subroutine record_page(stream, page)
      type(restart_stream_type), intent(inout) :: stream
      type(page_type), intent(inout)           :: page
      integer :: i, n

      call stream%part('page_type', 1)
      call stream%item('stage_id', page%stage_id)
      call stream%text('stage', page%stage)
      call stream%text('now', page%now)
      call stream%text('label', page%label)
      call stream%text('place', page%place)
      call stream%item('largest_force', page%largest_force)
      call stream%item('along_cd', page%along_cd)
      n = -1
      if (allocated(page%shown)) n = size(page%shown)
      call stream%extent('shown', n, 4)
      if (.not. stream%writes .and. allocated(page%shown)) deallocate (page%shown)
      if (.not. stream%writes .and. n >= 0) allocate (page%shown(n))
      if (n >= 0) call stream%item('shown', page%shown)
      call page%file%record(stream)
      call page%screen%record(stream)
      do i = 1, size(page%tables)
         if (page%tables(i)%is_open) call page%tables(i)%record(stream)
      end do
   end subroutine record_page

end module result_page
