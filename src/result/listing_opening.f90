!> The first pages of the listing: heading, deck echo, summary of the model, joints and stages.
module listing_opening
   use branch_cubic, only: cubic
   use case_control, only: method_newton, method_step, pressure_eq10
   use terminal, only: standard_input, version
   use deck_input, only: deck_type
   use element_kinds, only: element_table
   use element_mapping, only: has_modes
   use equation_solver, only: equation_system
   use facing_bodies, only: body_type, list_bodies
   use interface_operator, only: named_node
   use joint_sides, only: is_coarser
   use kinds, only: long, wp
   use listing_echo, only: write_echo
   use table_writer, only: axes, column, cut, heading, in_form, table_type, page_type, page_width
   use model_data, only: a_spring, model_type, n_bars, n_points, n_rotations, n_sections, supported, &
                         whole_share
   use normal_curve, only: pressure_floor
   use normal_stiffness, only: branch_load, branch_name, branch_reload, branch_unload
   use output_file, only: output_file_type
   use range_watch, only: tetra_words
   use shear_loops, only: loop_closure, worst_closure
   use shear_stiffness, only: cubic_of
   use stage_plan, only: stage_plan_type
   use text_tools, only: clean, integer_text, real_text, upper
   implicit none
   private

   public :: write_opening

contains

   !> Write the pages before the first increment.
   subroutine write_opening(page, deck, model, plan, system)
      type(page_type), intent(inout)    :: page
      type(deck_type), intent(in)       :: deck
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      class(equation_system), intent(in) :: system
      character(:), allocatable :: words

      words = 'FROM THE STANDARD INPUT'
      associate (path => deck%text%files(1)%path) ! without its folder
         if (path /= standard_input) words = path(index(path, '/', back=.true.) + 1:)
      end associate
      words = 'DECK '//words//'   JOINTFEM '//version
      if (allocated(page%date)) words = words//'   '//page%date
      call page%file%put(' '//repeat('-', page_width - 1))
      call page%file%put('  J O I N T F E M      TANGENT-STIFFNESS FINITE ELEMENT ANALYSIS OF JOINTED STRUCTURES')
      call page%file%put('  '//cut(deck%control%title, page_width - 2))
      call page%file%put('  '//cut(words, page_width - 2))
      call page%file%put(' '//repeat('-', page_width - 1))
      call write_echo(page%file, deck)
      call write_summary(page%file, deck, model, system)
      call write_bodies(page, model)
      if (allocated(model%placed)) call write_placed(page, model)
      if (size(model%joints) > 0) call write_joints(page, model)
      if (any(model%joints%gap_kind /= '')) call write_gaps(page, model)
      call write_shear_laws(page%file, model)
      call write_stages(page, model, plan)
   end subroutine write_opening

   !> The numbers of the parts of the model, and the solver.
   subroutine write_summary(file, deck, model, system)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(in)          :: model
      class(equation_system), intent(in)    :: system
      integer :: i

      call heading(file, 'MODEL SUMMARY')
      call count_line(file, 'NODES', int(n_points(model), long))
      if (.not. all(model%used)) &
         call count_line(file, '   OF THESE WITHOUT AN ELEMENT, LEFT OUT', count(.not. model%used, kind=long))
      if (model%n_filled > 0) call count_line(file, '   OF THESE MADE AT THE MIDDLE OF EDGES', int(model%n_filled, long))
      if (any(model%duplicate > 0)) &
         call count_line(file, '   OF THESE DOUBLED AT SPLIT SURFACES', count(model%duplicate > 0, kind=long))
      call count_line(file, 'BODY ELEMENTS', int(model%n_elements, long))
      call count_formulations(file, model)
      associate (n_springs => count(model%bars%kind == a_spring, kind=long))
         if (n_bars(model) > n_springs) call count_line(file, 'BARS, BOLTS INCLUDED', n_bars(model) - n_springs)
         if (n_springs > 0) call count_line(file, 'SPRINGS, ONE A DIRECTION', n_springs)
      end associate
      if (n_sections(model) > 0) call count_line(file, 'SOLID BOLTS', size(model%sections, kind=long))
      call count_line(file, 'JOINTS', size(model%joints, kind=long))
      call count_line(file, 'INTERFACE ELEMENTS', size(model%interface, kind=long))
      call count_line(file, 'SUPPORTED COMPONENTS', &
                      sum([(count(supported(model, i), kind=long), i = 1, n_points(model) + n_rotations(model))]))
      if (size(deck%bulk%rigid) > 0) call count_line(file, 'RIGID ELEMENTS', size(deck%bulk%rigid, kind=long))
      if (allocated(model%left_out)) call count_line(file, 'COMPONENTS DEPENDENT OR IDLE', count(model%left_out, kind=long))
      call count_line(file, 'UNKNOWNS', int(system%n, long))
      do i = 1, size(system%description%words)
         if (system%description%words(i) /= '') &
            call count_line(file, trim(system%description%words(i)), system%description%numbers(i))
      end do
      call count_line(file, 'STAGES', size(deck%control%stages, kind=long))
      associate (control => deck%control, solver => system%description)
         select case (control%method)
         case (method_step)
            call file%put('  METHOD STEP   PRESSURE '//trim(merge('EQ10', 'SUMF', control%pressure == pressure_eq10))// &
                          '   CARRY '//trim(merge('YES', 'NO ', control%carry))//'   SOLVER '//solver%name)
         case (method_newton)
            call file%put('  METHOD NEWTON   TOL '//real_text(control%tolerance)//'   SOLVER '//solver%name)
         case default
            call file%put('  METHOD BACK   AVERAGE '//trim(merge('YES', 'NO ', control%average))//'   TOL '// &
                          real_text(control%tolerance)//'   SOLVER '//solver%name)
         end select
         if (allocated(solver%reason)) call file%put('  '//solver%reason)
      end associate
      if (deck%control%length_unit /= '') call file%put('  UNITS, LABELS ONLY: LENGTH '// &
         trim(deck%control%length_unit)//', FORCE '//trim(deck%control%force_unit))
      call write_folded(file, upper(deck%bulk%ignored%words()))
      if (tetra_words(model) /= '') call file%put('  WARNING: '//upper(tetra_words(model)))
   end subroutine write_summary

   !> Count the body elements of each kind and formulation.
   subroutine count_formulations(file, model)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model
      integer(long) :: n(2, size(element_table)) ! without and with incompatible modes
      integer :: e, k, m

      n = 0
      do e = 1, model%n_elements
         k = model%element_kind(e)
         associate (property => model%properties(model%element_property(e)))
            m = merge(2, 1, property%incompatible .and. has_modes(k, property%state))
         end associate
         n(m, k) = n(m, k) + 1
      end do
      do k = 1, size(element_table)
         associate (kind => element_table(k))
            if (n(1, k) > 0) call count_line(file, '   '//trim(kind%card)//' OF '//integer_text(kind%n_nodes)//' NODES, '// &
                                             trim(merge('PLAIN       ', 'SECOND ORDER', kind%linear == k)), n(1, k))
            if (n(2, k) > 0) call count_line(file, '   '//trim(kind%card)//' OF '//integer_text(kind%n_nodes)// &
                                             ' NODES, INCOMPATIBLE MODES', n(2, k))
         end associate
      end do
   end subroutine count_formulations

   !> The number of a kind of parts of the model.
   subroutine count_line(file, words, number)
      type(output_file_type), intent(inout) :: file
      character(*), intent(in)              :: words
      integer(long), intent(in)             :: number
      character(80) :: line
      character(20) :: digits

      write (digits, '(i20)') number
      line = '  '//words
      line(58 - len_trim(adjustl(digits)):57) = adjustl(digits)
      call file%put(line)
   end subroutine count_line

   !> The bodies, if several, with their numbers in the answers and in the energies of modes.
   subroutine write_bodies(page, model)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(table_type) :: table
      type(body_type), allocatable :: bodies(:)
      integer :: body(model%n_elements), d, i

      call list_bodies(model, body, bodies)
      if (size(bodies) < 2) return
      d = model%dimension
      call table%start('BODIES', [column('BODY', 'i11'), column([character(8) :: 'ELEMENTS', 'NODES'], 'i11'), &
                                  column([character(12) :: 'FROM ELEMENT', 'TO ELEMENT'], 'i13'), &
                                  column('FROM '//axes(:d), 'es12.4', page%labels%length), &
                                  column('TO '//axes(:d), 'es12.4', page%labels%length)], page%file)
      do i = 1, size(bodies)
         associate (b => bodies(i))
            call table%add([i, b%n_elements, b%n_nodes, b%first, b%last], clean([b%low(:d), b%high(:d)]))
            call table%print_row(page%file)
         end associate
      end do
   end subroutine write_bodies

   !> The nodes that the deck names by place, NODEAT with its distance from there, and the reference nodes of RBE2M and RBE3M.
   subroutine write_placed(page, model)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(table_type) :: table
      integer :: d, i

      d = model%dimension
      call table%start('NODES BY PLACE AND SURFACE', [column([character(8) :: 'NODE', 'NODEAT', 'ELEMENT', 'PMARK'], 'i11'), &
                       column(axes(:d), 'es14.5', page%labels%length), column('DISTANCE', 'es12.3', page%labels%length)], page%file)
      do i = 1, size(model%placed)
         associate (placed => model%placed(i))
            associate (x => model%x(:, placed%node))
               call table%add([model%node_id(placed%node), placed%id, placed%element, placed%surface], &
                              clean([x(:d), merge(norm2(x - placed%x), 0.0_wp, placed%id > 0)]))
            end associate
            call table%print_row(page%file)
         end associate
      end do
   end subroutine write_placed

   !> WORDS, a list with commas, in as many lines as needed; nothing for an empty list.
   subroutine write_folded(file, words)
      type(output_file_type), intent(inout) :: file
      character(*), intent(in)              :: words
      integer :: first, last

      first = 1
      do while (first <= len(words))
         last = min(first + page_width - 6, len(words))
         if (last < len(words)) last = first - 1 + max(1, index(words(first:last), ',', back=.true.))
         call file%put('  '//repeat(' ', merge(0, 1, first == 1))//words(first:last))
         first = last + 1
      end do
   end subroutine write_folded

   !> Laws and areas of the joints.
   subroutine write_joints(page, model)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(table_type) :: table
      integer :: d, j

      d = model%dimension
      associate (labels => page%labels)
         call table%start('JOINTS', [column('JOINT', 'i11'), column('ELEMENTS', 'i9'), column('A_INT', 'es13.5', labels%area), &
                                     column('C', 'es13.5'), column('M', 'f7.4'), column('E_U', 'es15.5', labels%slope), &
                                     column(['FIRST P (EQ.9) ', 'LEAST P ON LOAD'], 'es17.5', labels%pressure), &
                                     column('NORMAL '//axes(:d), merge('f10.6', 'f11.6', d == 3))])
      end associate
      call table%print_head(page%file)
      do j = 1, size(model%joints)
         associate (joint => model%joints(j), law => model%joints(j)%law%normal)
            call table%add([joint%id, joint%last - joint%first + 1])
            call table%add([joint%area, law%c, law%m, law%e_u, joint%p_av, pressure_floor*joint%p_av])
            if (joint%frame%faces_all_ways) then
               call table%add(' CLOSED')
            else
               call table%add(clean(joint%normal(:d), 1.0e-9_wp))
            end if
            call table%print_row(page%file)
         end associate
      end do
      call write_covers(page, model)
   end subroutine write_joints

   !> The initial gaps: of the elements of a joint how many stand open, and how many are pressed by interference at rest.
   subroutine write_gaps(page, model)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(table_type) :: table
      integer :: j

      call table%start('INITIAL GAPS, NEGATIVE: INTERFERENCE', &
                       [column('JOINT', 'i11'), column('GIVEN BY', 'a10'), column(['SMALLEST', 'LARGEST '], 'es15.5', &
                        page%labels%length), column(['OPEN   ', 'PRESSED'], 'i9')], page%file)
      do j = 1, size(model%joints)
         associate (joint => model%joints(j), gaps => model%interface(model%joints(j)%first:model%joints(j)%last)%gap)
            if (joint%gap_kind == '') cycle
            call table%add([joint%id])
            call table%add(trim(joint%gap_kind), clean([minval(gaps), maxval(gaps)]))
            call table%add([count(gaps > 0.0_wp), count(gaps < 0.0_wp)])
            call table%print_row(page%file)
         end associate
      end do
   end subroutine write_gaps

   !> Shear laws and friction of the joints that have them.
   subroutine write_shear_laws(file, model)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model
      integer, parameter :: branches(3) = [branch_load, branch_unload, branch_reload]
      type(table_type) :: table
      character(page_width)    :: line
      type(cubic) :: curve
      integer :: b, j, k

      if (.not. any(model%joints%law%shear(1)%given .or. model%joints%law%shear(2)%given .or. model%joints%law%has_friction)) return
      call table%start('SHEAR LAWS: TAU = (C11 + C12 P) D + (C21 + C22 P) D**2 + (C31 + C32 P) D**3', &
                       [column('JOINT', 'i11', heading_shift=-1), column('AXIS', 'a4'), column('BRANCH', 'a8'), &
                        column(['C11', 'C12', 'C21', 'C22', 'C31', 'C32'], 'es13.5')], file)
      do j = 1, size(model%joints)
         associate (law => model%joints(j)%law)
            do k = 1, model%dimension - 1
               if (.not. law%shear(k)%given) cycle
               do b = 1, 3
                  curve = cubic_of(law%shear(k), branches(b))
                  call table%add([model%joints(j)%id])
                  call table%add(axes(k))
                  call table%add(branch_name(branches(b)))
                  call table%add(pack(curve%coefficients, .true.))
                  call table%print_row(file)
               end do
               if (law%shear(k)%p_max < huge(1.0_wp)) then
                  write (line, '(17x, a, es13.5)') 'TESTED UP TO P =', law%shear(k)%p_max
                  call file%put(line)
               end if
               if (law%shear(k)%d_max < huge(1.0_wp)) then
                  write (line, '(17x, a, es13.5)') 'TESTED UP TO D =', law%shear(k)%d_max
                  call file%put(line)
               end if
               call file%put(closure_line(worst_closure(law%shear(k), model%joints(j)%p_av)))
            end do
            if (law%has_friction) then
               write (line, '(i11, 3a, i5)') model%joints(j)%id, '   FRICTION MU =', in_form(law%mu, '(f10.6)', 10), &
                  '   RE-ANALYSES', model%joints(j)%n_reanalyses
               call file%put(line)
            end if
         end associate
      end do
   end subroutine write_shear_laws

   !> Words about the closure of the loops of a shear law: the widest gap and its place.
   function closure_line(closure) result(line)
      type(loop_closure), intent(in) :: closure
      character(page_width) :: line

      if (.not. closure%is_known) then
         line = repeat(' ', 17)//'CLOSURE: UNLOADING DOES NOT REACH TAU = 0'
      else if (closure%d > 0.0_wp) then
         write (line, '(17x, 3a, es13.5, a, es13.5)') 'CLOSURE', in_form(100.0_wp*closure%share, '(f9.3)', 9), &
            ' PER CENT OF TAU_R, WIDEST AT P =', closure%p, '   D =', closure%d
      else
         write (line, '(17x, 3a, es13.5)') 'CLOSURE', in_form(100.0_wp*closure%share, '(f9.3)', 9), &
            ' PER CENT OF TAU_R AT P =', closure%p
         line = trim(line)//'   OF SMALL LOOPS: THE CARD HAS NO DMAX'
      end if
   end function closure_line

   !> The load history: totals at the end of every stage.
   subroutine write_stages(page, model, plan)
      type(page_type), intent(inout)    :: page
      type(model_type), intent(in)      :: model
      type(stage_plan_type), intent(in) :: plan
      type(table_type) :: table
      real(wp) :: total(3), largest
      integer  :: s

      call table%start('STAGES', [column('STAGE', 'i11', heading_shift=-1), column('INCREMENTS', 'i11'), &
                                  column(['FIRST SHARE', 'LAST SHARE '], 'es14.5'), &
                                  column('TOTAL LOAD '//axes(:model%dimension), 'es15.5', page%labels%force), &
                                  column('   LABEL', 'a')], page%file)
      do s = 1, size(plan%stages)
         associate (stage => plan%stages(s), loads => model%stage_loads(s))
            total = sum(loads%force(:, :loads%n), dim=2, mask=spread(loads%node(:loads%n) <= n_points(model), 1, 3)) ! no moments
            largest = 0.0_wp
            if (loads%n > 0) largest = maxval(abs(loads%force(:, :loads%n)))
            call table%add([stage%id, size(stage%fractions)])
            call table%add([stage%fractions(1), stage%fractions(size(stage%fractions))])
            call table%add(clean(total(:model%dimension), 1.0e-9_wp*largest))
            call table%add('   '//cut(stage%label, 33))
            call table%print_row(page%file)
         end associate
      end do
   end subroutine write_stages

   !> The cover of joint sides that do not match node by node.
   subroutine write_covers(page, model)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(table_type) :: table
      integer :: i, j, lists(size(model%joints)) ! interface elements coupled to lists of nodes
      integer, allocatable :: shown(:)

      lists = [(count([(model%interface(i)%n_1 > 1 .or. named_node(model%interface(i), 2) < 0, &
                        i = model%joints(j)%first, model%joints(j)%last)]), j = 1, size(model%joints))]
      shown = pack([(j, j = 1, size(model%joints))], model%joints%cover%fitted .and. &
                   (lists > 0 .or. model%joints%cover%share < whole_share))
      if (size(shown) == 0) return
      call table%start('JOINTS OF FACES THAT DO NOT MATCH', [column('JOINT', 'i11'), column(['PAIRS', 'LISTS'], 'i9'), &
                       column('SIDE1 COVERED', 'f15.6'), column('FARTHEST APART', 'es17.5', page%labels%length)], page%file)
      do j = 1, size(shown)
         associate (joint => model%joints(shown(j)))
            call table%add([joint%id, joint%last - joint%first + 1 - lists(shown(j)), lists(shown(j))])
            call table%add([joint%cover%share, clean(joint%cover%farthest, 1.0e-9_wp*sqrt(joint%area))])
            call table%print_row(page%file)
         end associate
      end do
      do j = 1, size(shown)
         associate (joint => model%joints(shown(j)))
            if (joint%cover%share < whole_share) call page%file%put('  NOTE: SIDE2 COVERS ONLY A PART OF SIDE1 OF JOINT '// &
               integer_text(joint%id)//'. THE REST OF SIDE1 HAS NO JOINT.')
            if (is_coarser(joint%cover)) call page%file%put('  NOTE: SIDE1 OF JOINT '//integer_text(joint%id)// &
               ' IS COARSER THAN SIDE2. EXCHANGE THEM FOR BETTER STRESSES BESIDE THE JOINT.')
         end associate
      end do
   end subroutine write_covers

end module listing_opening
