!> Tables of the interface elements: history in NAME.joint.csv, tables of each joint in the listing, and its plot.
module joint_tables
   use analysis_state, only: analysis_type
   use interface_operator, only: at_first_end
   use joint_laws, only: friction_limit
   use kinds, only: wp
   use model_data, only: joint_node_id, joint_type, model_type
   use normal_curve, only: loading_deflection
   use normal_stiffness, only: branch_name, branch_open, branch_reload, branch_unload, force_reached
   use page_lines, only: axes, heading, page_width
   use result_page, only: has_gaps, joint_table, page_type, shows, table_columns, xyz
   use shear_stiffness, only: branch_shift, curve_deflection
   use stage_entries, only: output_request
   use table_column, only: column, column_type
   use table_writer, only: table_type
   use text_tools, only: clean, integer_text, one_of
   use tolerances, only: page_zero
   implicit none
   private

   public :: write_history, list_joints, list_energy, plot_joint

   ! subjects of the tables
   integer, parameter :: of_elements = 1, of_stiffness = 2, of_removed = 3, of_shear = 4, of_state = 5, of_shear_state = 6

   integer, parameter :: width = 101 ! columns of the field of a plot: 0 to 100 per cent

contains

   !> Write a row for each interface element into the file of the joints, after the completed increment. node2 is 0 for the
   !! rigid base; a direction without shear stiffness has no branch.
   subroutine write_history(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      integer  :: i, k
      logical  :: gaps, slides

      gaps = has_gaps(model)
      slides = any(model%joints%list%law%has_friction)
      call table%start('', table_columns(joint_table, page%labels, model))
      do i = 1, size(model%joints%element)
         call table%put('stage', page%stage_id)
         call table%put('increment', analysis%increment)
         call table%put('load', analysis%fraction)
         associate (element => model%joints%element(i), state => analysis%states(i)%normal)
            call table%put('joint', model%joints%list(element%joint)%id)
            call table%put('element', element%id)
            call table%put('node1', joint_node_id(model, i, 1))
            call table%put('node2', joint_node_id(model, i, 2))
            call table%put(xyz, at_first_end(element, model%mesh%x))
            call table%put('area', element%area)
            call table%put('branch', branch_name(state%branch))
            call table%put('lambda', state%lambda)
            call table%put('pressure', state%pressure)
            call table%put('force', state%sumf)
            call table%put('k_n', state%k_n)
         end associate
         do k = 1, 2
            associate (state => analysis%states(i)%shear(k), &
               has_law => model%joints%list(model%joints%element(i)%joint)%law%shear(k)%given)
               call table%put('branch_'//xyz(k), branch_name(state%branch), where=has_law)
               call table%put('delta_'//xyz(k), merge(state%delta, analysis%movement(k, i), has_law)) ! else only the movement
               call table%put('tau_'//xyz(k), merge(state%tau, 0.0_wp, has_law))
               call table%put('k_s'//xyz(k), merge(state%k_s, 0.0_wp, has_law))
            end associate
         end do
         call table%put('slip', merge(1, 0, analysis%states(i)%slips))
         if (gaps) call table%put('gap', model%joints%element(i)%gap)
         if (slides) call table%put('slid_'//xyz(:2), analysis%states(i)%shear%slid)
         call table%print_row(csv_file=page%tables(joint_table))
      end do
   end subroutine write_history

   !> List the tables of the interface elements, joint by joint; their history where it is ASKED.
   subroutine list_joints(page, asked, model, analysis)
      type(page_type), intent(inout)  :: page
      type(output_request), intent(in) :: asked
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer :: j, k

      do j = 1, size(model%joints%list)
         call list_elements(page, of_elements, model, analysis, j)
         call list_elements(page, of_stiffness, model, analysis, j)
         if (allocated(analysis%exact)) call list_elements(page, of_removed, model, analysis, j) ! STEP
         do k = 1, model%mesh%dimension - 1
            call list_elements(page, of_shear, model, analysis, j, k)
         end do
      end do
      if (asked%state) then
         do j = 1, size(model%joints%list)
            call list_elements(page, of_state, model, analysis, j)
            do k = 1, model%mesh%dimension - 1
               call list_elements(page, of_shear_state, model, analysis, j, k)
            end do
         end do
      end if
   end subroutine list_joints

   !> The table of SUBJECT of joint J: a row for each element. A table of shear is for direction K, if that has a shear law.
   subroutine list_elements(page, subject, model, analysis, j, k)
      type(page_type), intent(inout)  :: page
      integer, intent(in)             :: subject
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      integer, intent(in), optional   :: k
      character(43), parameter :: titles(6) = [character(43) :: 'INTERFACE ELEMENTS', 'NORMAL STIFFNESS', &
         'ELEMENTS REMOVED FROM JOINT', 'SHEAR IN DIRECTION', 'STATE OF THE INTERFACE ELEMENTS', 'STATE OF SHEAR IN DIRECTION']
      type(table_type) :: table
      type(column_type), allocatable :: columns(:)
      character(:), allocatable :: title
      integer, allocatable :: list(:)
      integer :: i

      associate (joint => model%joints%list(j), normal => analysis%states%normal)
         list = pack([(i, i = joint%first, joint%last)], [(shows(page, model%joints%element(i)%node), i = joint%first, joint%last)])
         if (subject == of_removed) list = pack(list, normal(list)%branch == branch_open .and. force_reached(normal(list)) < 0.0_wp)
         if (subject == of_removed .and. size(list) == 0) return
         title = trim(titles(subject))
         if (present(k)) then
            if (.not. joint%law%shear(k)%given) return
            title = title//' '//axes(k)
         end if
         if (subject /= of_removed) title = title//' OF JOINT'
         title = title//' '//integer_text(joint%id)//page%now
      end associate
      associate (labels => page%labels, d => model%mesh%dimension)
         select case (subject)
         case (of_elements) ! K_N in space only in the joint history
            columns = [column('NODE 2', 'i11'), column(axes(:d), 'es13.5', labels%length), column('AREA', 'es13.5', labels%area), &
                       column('BRANCH', 'a8'), column('LAMBDA', 'es13.5', labels%length), column('P', 'es13.5', labels%pressure), &
                       column('FORCE', 'es13.5', labels%force), &
                       column('K_N, USED', 'es13.5', labels%stiffness(:12), is_listed=d == 2)]
         case (of_stiffness)
            columns = [column([character(6) :: 'LAMBDA', 'C P**M'], 'es13.5', labels%length), &
                       column('K_N, USED', 'es13.5', labels%stiffness(:12)), &
                       column(['CLOSING', 'GAP    '], 'es13.5', labels%length, is_listed=has_gaps(model)), &
                       column('KIND', 'a9')]
         case (of_removed)
            columns = [column([character(13) :: 'SIGMAF', 'SUMF, DECIDED'], ['es13.5', 'es15.5'], labels%force), &
                       column('LAMBDA B', 'es13.5', labels%length)]
         case (of_shear)
            columns = [column('BRANCH', 'a8'), column([character(9) :: 'DELTA', 'TAU', 'FORCE', 'K_S, USED', 'LIMIT'], 'es13.5', &
                       [labels%length, labels%pressure, labels%force, labels%stiffness, labels%pressure], unit_shift=1), &
                       column('', 'a', key='note')]
         case (of_state)
            columns = [column('BRANCH', 'a8'), column(['SIGMAF', 'SUMF  '], 'es13.5', labels%force), &
                       column([character(8) :: 'LAMBDA A', 'P A', 'LAMBDA B'], 'es13.5', &
                              [labels%length, labels%pressure, labels%length])]
         case default
            columns = [column('BRANCH', 'a8'), column('SENSE', 'i6'), column(['D  ', 'TAU', 'D_R'], 'es13.5', &
                       [labels%length, labels%pressure, labels%length]), &
                       column([character(5) :: 'TAU_R', 'O', 'B0', 'C0'], 'es13.5', labels%pressure)]
         end select
      end associate
      call table%start(title, [column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), columns], page%file)
      do i = 1, size(list)
         call table%put([character(7) :: 'ELEMENT', 'NODE 1'], [model%joints%element(list(i))%id, joint_node_id(model, list(i), 1)])
         if (present(k)) call add_shear(table, subject, model, analysis, list(i), k)
         if (.not. present(k)) call add_normal(table, subject, model, analysis, list(i))
         call table%print_row(page%file)
      end do
   end subroutine list_elements

   !> Add the normal values of interface element I. The normal stiffness is that used in the increment, with its kind. The
   !! difference of lambda from the loading curve at the present p follows; where gaps exist also the closing, of which lambda
   !! is the part beyond the gap. Elements removed: the tensile force that caused the removal, which they no longer carry.
   subroutine add_normal(table, subject, model, analysis, i)
      type(table_type), intent(inout)         :: table
      integer, intent(in)                     :: subject
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      integer, intent(in)                     :: i
      character(7), parameter :: kinds(4) = [character(7) :: '0', 'SECANT', 'TANGENT', 'E_U'] ! in the order of analysis_state
      real(wp) :: lambda_floor, p_floor

      lambda_floor = page_zero*analysis%largest_lambda
      p_floor = page_zero*analysis%largest_p
      associate (element => model%joints%element(i), joint => model%joints%list(model%joints%element(i)%joint), &
         state => analysis%states(i)%normal)
         select case (subject)
         case (of_elements)
            call table%put('NODE 2', joint_node_id(model, i, 2))
            call table%put(axes(:model%mesh%dimension), at_first_end(element, model%mesh%x(:model%mesh%dimension, :)))
            call table%put('AREA', element%area)
            call table%put('BRANCH', branch_name(state%branch))
            call table%put('LAMBDA', state%lambda, lambda_floor)
            call table%put('P', state%pressure, p_floor)
            call table%put('FORCE', state%sumf, p_floor*joint%area)
            call table%put('K_N, USED', state%k_n)
         case (of_stiffness)
            call table%put('LAMBDA', state%lambda, lambda_floor)
            call table%put('C P**M', loading_deflection(joint%law%normal, max(0.0_wp, state%pressure)), lambda_floor)
            call table%put('K_N, USED', state%k_n)
            call table%put(['CLOSING', 'GAP    '], [state%lambda + state%gap, state%gap], lambda_floor)
            call table%put('KIND', trim(kinds(analysis%record%kind(i))))
         case (of_removed)
            call table%put('SIGMAF', state%sigmaf, p_floor*element%area)
            call table%put('SUMF, DECIDED', force_reached(state), p_floor*element%area)
            call table%put('LAMBDA B', state%lambda_b, lambda_floor)
         case (of_state)
            call table%put('BRANCH', branch_name(state%branch))
            call table%put(['SIGMAF', 'SUMF  '], [state%sigmaf, state%sumf], p_floor*element%area)
            call table%put('LAMBDA A', state%lambda_a, lambda_floor)
            call table%put('P A', state%p_a, p_floor)
            call table%put('LAMBDA B', state%lambda_b, lambda_floor)
         end select
      end associate
   end subroutine add_normal

   !> Add the shear values in direction K. LIMIT is mu p; D and TAU of the state count in the sense of loading, as point A.
   subroutine add_shear(table, subject, model, analysis, i, k)
      type(table_type), intent(inout)         :: table
      integer, intent(in)                     :: subject
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      integer, intent(in)                     :: i, k
      real(wp) :: delta_floor, tau_floor, shift

      delta_floor = page_zero*analysis%largest_lambda
      tau_floor = page_zero*analysis%largest_p
      associate (element => model%joints%element(i), law => model%joints%list(model%joints%element(i)%joint)%law, &
                 state => analysis%states(i)%shear(k), p => analysis%states(i)%normal%pressure)
         call table%put('BRANCH', branch_name(state%branch))
         if (subject == of_shear) then
            call table%put('DELTA', state%delta, delta_floor)
            call table%put('TAU', state%tau, tau_floor)
            call table%put('FORCE', state%tau*element%area, tau_floor*element%area)
            call table%put('K_S, USED', state%k_s, page_zero*analysis%states(i)%normal%k_n)
            call table%put('LIMIT', friction_limit(law, p), tau_floor, where=law%has_friction)
            call table%put('note', one_of(analysis%states(i)%slips, '  SLIPS', ''))
         else
            shift = branch_shift(law%shear(k), state, max(0.0_wp, p), analysis%turns(k, i)%delta, analysis%turns(k, i)%tau)
            call table%put('SENSE', nint(state%sense))
            call table%put('D', curve_deflection(state), delta_floor)
            call table%put('TAU', state%sense*state%tau, tau_floor)
            call table%put('D_R', state%d_r, delta_floor)
            call table%put(['TAU_R', 'O    '], [state%tau_r, state%offset], tau_floor)
            call table%put(['B0', 'C0'], [shift, shift], tau_floor, where=state%branch == [branch_unload, branch_reload])
         end if
      end associate
   end subroutine add_shear

   !> Work on the joints in the stage: put in = given back + kept + lost by sliding. Over a closed loop of the branches what is kept
   !! is dissipated too.
   subroutine list_energy(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(10), parameter :: names(3) = [character(10) :: 'PUT IN', 'GIVEN BACK', 'KEPT']
      type(table_type) :: table
      real(wp) :: floor, kept(2)
      integer  :: j
      logical  :: slides

      if (size(model%joints%list) == 0) return
      slides = any(model%joints%list%law%has_friction)
      call heading(page%file, 'ENERGY OF JOINTS, '//page%stage)
      call page%file%put('                 ------------- NORMAL -------------------   -------------- SHEAR -------------------'// &
                         one_of(slides, '   SLIDING', ''))
      call table%start('', [column('JOINT', 'i11', heading_shift=-1), &
                            column(names, ['es14.5', 'es13.5', 'es13.5'], key='NORMAL '//names), &
                            column(names, ['es15.5', 'es13.5', 'es13.5'], key='SHEAR '//names), &
                            column('LOST', 'es15.5', is_listed=slides)], page%file)
      if (page%labels%moment /= '') call page%file%put('                 ('//trim(page%labels%moment)//')')
      do j = 1, size(model%joints%list)
         associate (energy => analysis%energy(j))
            floor = page_zero*sum(energy%put_in)
            kept = energy%kept()
            call table%put('JOINT', model%joints%list(j)%id)
            call table%put('NORMAL '//names, [energy%put_in(2), energy%given_back(2), kept(2)], floor)
            call table%put('SHEAR '//names, [energy%put_in(1), energy%given_back(1), kept(1)], floor)
            call table%put('LOST', energy%lost, floor)
            call table%print_row(page%file)
         end associate
      end do
   end subroutine list_energy

   !> Map of the pressure of JOINT over its plane, seen against its normal: x of the joint to the right, y upwards. A character
   !! shows the largest pressure of the interface elements there: tenths of the largest of all, which is *; - where all are
   !! open.
   subroutine map_joint(page, model, analysis, joint)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      real(wp), parameter     :: upright = 2.0_wp ! height of a character over its width
      character(*), parameter :: ranks = '-0123456789*' ! the later of two signs at one place is shown
      character(width), allocatable :: rows(:)
      character(page_width) :: line
      character(1) :: sign
      real(wp) :: place(3, joint%first:joint%last), low(3), high(3), step, p_most
      integer  :: column, i, row

      do i = joint%first, joint%last
         place(:, i) = at_first_end(model%joints%element(i), model%mesh%x) - joint%frame%centroid
         place(:, i) = matmul(place(:, i), joint%frame%axes)
      end do
      low = minval(place, dim=2)
      high = maxval(place, dim=2)
      step = sqrt(joint%area/(joint%last - joint%first + 1))/upright ! one row for each row of nodes of a uniform mesh
      step = max(step, (high(1) - low(1))/(width - 1), (high(2) - low(2))/(width - 1))
      allocate (rows(0:nint((high(2) - low(2))/(upright*step))))
      rows = ''
      p_most = max(maxval(analysis%states(joint%first:joint%last)%normal%pressure), tiny(1.0_wp))
      do i = joint%first, joint%last
         column = 1 + nint((place(1, i) - low(1))/step)
         row = nint((high(2) - place(2, i))/(upright*step))
         associate (state => analysis%states(i)%normal, there => rows(row)(column:column))
            sign = achar(iachar('0') + max(0, min(9, int(10.0_wp*(1.0_wp + page_zero)*state%pressure/p_most))))
            if (state%pressure >= (1.0_wp - page_zero)*p_most) sign = '*'
            if (state%branch == branch_open) sign = '-'
            if (index(ranks, sign) > index(ranks, there)) there = sign
         end associate
      end do
      call heading(page%file, 'MAP OF JOINT '//integer_text(joint%id)//page%now)
      write (line, '(2x, a, es13.5, 1x, a)') '0 TO 9: TENTHS OF P, *: P =', clean(p_most), trim(page%labels%pressure)
      call page%file%put(trim(line)//', -: OPEN')
      write (line, '(2x, 4(a, es13.5), 1x, a)') 'X FROM', clean(low(1)), ' TO', clean(high(1)), ', Y FROM', clean(low(2)), &
         ' (BELOW) TO', clean(high(2)), trim(page%labels%length)
      call page%file%put(trim(line)//' FROM THE CENTROID OF THE JOINT')
      call page%file%put('')
      do row = 0, ubound(rows, 1)
         call page%file%put('   |'//rows(row))
      end do
   end subroutine map_joint

   !> A map of JOINT where that has a plane in space. Otherwise a line for each interface element, P as *, LAMBDA as +, both as #
   !! where they coincide.
   subroutine plot_joint(page, model, analysis, joint)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      character(page_width) :: line
      real(wp) :: p_most, lambda_most, lambda_least
      integer  :: i

      if (model%mesh%dimension == 3 .and. .not. joint%frame%faces_all_ways) then
         call map_joint(page, model, analysis, joint)
         return
      end if
      associate (state => analysis%states%normal)
         p_most = max(maxval(state(joint%first:joint%last)%pressure), tiny(1.0_wp))
         lambda_least = min(0.0_wp, minval(state(joint%first:joint%last)%lambda))
         lambda_most = max(0.0_wp, maxval(state(joint%first:joint%last)%lambda), lambda_least + tiny(1.0_wp))
         call heading(page%file, 'PLOT OF JOINT '//integer_text(joint%id)//page%now)
         write (line, '(2x, a, es13.5, 1x, a)') '*  P       FROM  0.00000E+00 TO', clean(p_most), trim(page%labels%pressure)
         call page%file%put(line)
         write (line, '(2x, a, es13.5, a, es13.5, 1x, a)') '+  LAMBDA  FROM', clean(lambda_least), ' TO', &
            clean(lambda_most), trim(page%labels%length)
         call page%file%put(line)
         call page%file%put('      NODE            X  +'//repeat('---------+', 10))
         do i = joint%first, joint%last
            write (line, '(i10, es13.5)') joint_node_id(model, i, 1), clean(at_first_end(model%joints%element(i), &
               model%mesh%x(1:1, :)))
            line(26:26) = '|'
            line(25 + width:25 + width) = '|'
            call mark((state(i)%lambda - lambda_least)/(lambda_most - lambda_least), '+')
            call mark(state(i)%pressure/p_most, '*')
            call page%file%put(line)
         end do
         call page%file%put('                         +'//repeat('---------+', 10))
      end associate

   contains

      subroutine mark(share, sign)
         real(wp), intent(in)     :: share
         character(1), intent(in) :: sign
         integer :: column

         column = 26 + nint(min(1.0_wp, max(0.0_wp, share))*(width - 1))
         line(column:column) = merge('#', sign, line(column:column) == '+')
      end subroutine mark

   end subroutine plot_joint

end module joint_tables
