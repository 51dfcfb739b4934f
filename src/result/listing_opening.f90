!> The first pages of the listing: heading, bodies, joints and stages; between them echo and summary.
module listing_opening
   use branch_cubic, only: cubic
   use deck_input, only: deck_type
   use equation_solver, only: equation_system
   use facing_bodies, only: body_type, list_bodies
   use interface_operator, only: named_node
   use iwan_law, only: greatest_phi
   use joint_sides, only: is_coarser
   use kinds, only: wp
   use listing_summary, only: write_echo, write_summary
   use mesh_queries, only: n_points
   use model_data, only: model_type, whole_share
   use normal_curve, only: normal_tangent
   use normal_stiffness, only: branch_load, branch_name, branch_reload, branch_unload
   use output_file, only: output_file_type
   use page_lines, only: axes, cut, in_form, page_width, put_lines
   use result_page, only: has_gaps, page_type
   use shear_loops, only: loop_closure, worst_closure
   use shear_stiffness, only: cubic_of
   use stage_plan, only: has_unloading_modes, stage_plan_type
   use table_column, only: column
   use table_writer, only: table_type
   use terminal, only: standard_input, version
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: page_zero, pressure_floor
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
      type(table_type) :: table
      real(wp) :: total(3), largest
      integer  :: i, s

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
      if (size(model%joints%list) > 0) call write_joints(page, model, has_unloading_modes(plan))
      call write_shear_laws(page%file, model)
      ! the load history: totals at the end of every stage
      call table%start('STAGES', [column('STAGE', 'i11', heading_shift=-1), &
                                  column('FROM', 'i6', is_listed=any(plan%stages%from > 0)), column('INCREMENTS', 'i11'), &
                                  column(['FIRST SHARE', 'LAST SHARE '], 'es14.5'), &
                                  column('TOTAL LOAD '//axes(:model%mesh%dimension), 'es15.5', page%labels%force), &
                                  column('   LABEL', 'a')], page%file)
      do s = 1, size(plan%stages)
         associate (stage => plan%stages(s), loads => model%history%stages(s))
            ! no moments
            total = sum(loads%force(:, :loads%n), dim=2, mask=spread(loads%node(:loads%n) <= n_points(model%mesh), 1, 3))
            largest = max(0.0_wp, maxval(abs(loads%force(:, :loads%n))))
            call table%put([character(10) :: 'STAGE', 'INCREMENTS'], [stage%id, size(stage%fractions)])
            call table%put('FROM', stage%from, where=stage%from > 0)
            call table%put([character(11) :: 'FIRST SHARE', 'LAST SHARE'], stage%fractions([1, size(stage%fractions)]))
            call table%put('TOTAL LOAD '//axes(:model%mesh%dimension), total(:model%mesh%dimension), page_zero*largest)
            call table%put('LABEL', '   '//cut(stage%label, 33))
            call table%print_row(page%file)
         end associate
      end do
      if (plan%is_independent) call page%file%put('  THE DECK IS LINEAR: EVERY STAGE IS A CASE BY ITSELF, WHICH STARTS FROM REST')
      if (size(plan%first_with) > 1) call page%file%put('  SUPPORTS OR CONSTRAINT EQUATIONS DIFFER: '// &
                                                        integer_text(size(plan%first_with))//' SETS')
      do s = 1, size(plan%stages)
         if (.not. allocated(plan%stages(s)%parts)) cycle
         words = '  STAGE '//integer_text(plan%stages(s)%id)//' ='
         do i = 1, size(plan%stages(s)%parts)
            words = words//one_of(i > 1, ' +', '')//' '//real_text(plan%stages(s)%factors(i))//' STAGE '// &
                    integer_text(plan%stages(plan%stages(s)%parts(i))%id)
         end do
         call put_lines(page%file, words(3:), ' ')
      end do
   end subroutine write_opening

   !> The bodies, if several, with their numbers in the answers and in the energies of modes; and the nodes that the deck names
   !! by place, NODEAT with its distance from there, and the reference nodes of RBE2M and RBE3M.
   subroutine write_bodies(page, model)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(table_type) :: table
      type(body_type), allocatable :: bodies(:)
      integer :: body(model%mesh%n_elements), d, i

      d = model%mesh%dimension
      call list_bodies(model%mesh, body, bodies)
      if (size(bodies) > 1) call table%start('BODIES', &
         [column('BODY', 'i11'), column([character(8) :: 'ELEMENTS', 'NODES'], 'i11'), &
          column([character(12) :: 'FROM ELEMENT', 'TO ELEMENT'], 'i13'), &
          column('FROM '//axes(:d), 'es12.4', page%labels%length), &
          column('TO '//axes(:d), 'es12.4', page%labels%length)], page%file)
      if (size(bodies) > 1) then
         do i = 1, size(bodies)
            associate (b => bodies(i))
               call table%put([character(12) :: 'BODY', 'ELEMENTS', 'NODES', 'FROM ELEMENT', 'TO ELEMENT'], &
                              [i, b%n_elements, b%n_nodes, b%first, b%last])
               call table%put('FROM '//axes(:d), b%low(:d))
               call table%put('TO '//axes(:d), b%high(:d))
               call table%print_row(page%file)
            end associate
         end do
      end if
      if (size(model%mesh%placed) == 0) return ! nodes by place
      call table%start('NODES BY PLACE AND SURFACE', [column([character(8) :: 'NODE', 'NODEAT', 'ELEMENT', 'PMARK'], 'i11'), &
                       column(axes(:d), 'es14.5', page%labels%length), column('DISTANCE', 'es12.3', page%labels%length)], page%file)
      do i = 1, size(model%mesh%placed)
         associate (placed => model%mesh%placed(i), x => model%mesh%x(:, model%mesh%placed(i)%node))
            call table%put([character(7) :: 'NODE', 'NODEAT', 'ELEMENT', 'PMARK'], &
                           [placed%number, placed%id, placed%element, placed%surface])
            call table%put(axes(:d), x(:d))
            call table%put('DISTANCE', merge(norm2(x - placed%x), 0.0_wp, placed%id > 0))
            call table%print_row(page%file)
         end associate
      end do
   end subroutine write_bodies

   !> Laws and areas of the joints, and the cover of joint sides that do not match node by node. Initial gaps: of the elements of a
   !! joint how many stand open, and how many are pressed by interference at rest.
   subroutine write_joints(page, model, modes_tell)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      logical, intent(in)            :: modes_tell !! modes about unloading name joints whose E_u is the default
      type(table_type) :: table
      integer :: d, i, j, lists(size(model%joints%list)) ! interface elements coupled to lists of nodes
      logical :: shown(size(model%joints%list))

      ! laws and areas
      d = model%mesh%dimension
      associate (labels => page%labels)
         call table%start('JOINTS', [column('JOINT', 'i11'), column('ELEMENTS', 'i9'), column('A_INT', 'es13.5', labels%area), &
                                     column('C', 'es13.5'), column('M', 'f7.4'), column('E_U', 'es15.5', labels%slope), &
                                     column(['FIRST P (EQ.9) ', 'LEAST P ON LOAD'], 'es17.5', labels%pressure), &
                                     column('NORMAL '//axes(:d), merge('f10.6', 'f11.6', d == 3))], page%file)
      end associate
      do j = 1, size(model%joints%list)
         associate (joint => model%joints%list(j), law => model%joints%list(j)%law%normal)
            call table%put([character(8) :: 'JOINT', 'ELEMENTS'], [joint%id, joint%last - joint%first + 1])
            call table%put([character(15) :: 'A_INT', 'C', 'M', 'E_U', 'FIRST P (EQ.9)', 'LEAST P ON LOAD'], &
                           [joint%area, law%c, law%m, law%e_u, joint%p_av, pressure_floor*joint%p_av])
            if (joint%frame%faces_all_ways) call table%put('NORMAL X', ' CLOSED')
            if (joint%frame%faces_all_ways) call table%leave_rest()
            if (.not. joint%frame%faces_all_ways) call table%put('NORMAL '//axes(:d), joint%normal(:d), page_zero)
            call table%print_row(page%file)
            lists(j) = count([(model%joints%element(i)%n_1 > 1 .or. named_node(model%joints%element(i), 2) < 0, i = joint%first, &
               joint%last)])
         end associate
      end do

      if (.not. modes_tell) then
         do j = 1, size(model%joints%list)
            associate (joint => model%joints%list(j), law => model%joints%list(j)%law%normal)
               if (.not. joint%e_u_given .and. law%c > 0.0_wp) call page%file%put('  NOTE: E_U OF JOINT '// &
                  integer_text(joint%id)//' IS THE DEFAULT, E OF THE BODIES,'// &
                  in_form(law%e_u/normal_tangent(law, 1.0_wp, joint%p_av, joint%p_av), '(es10.2)', 10)// &
                  ' TIMES THE SLOPE OF LOADING AT ITS FIRST P')
            end associate
         end do
      end if

      ! the cover of sides that do not match
      shown = model%joints%list%cover%fitted .and. (lists > 0 .or. model%joints%list%cover%share < whole_share)
      if (any(shown)) call table%start('JOINTS OF FACES THAT DO NOT MATCH', [column('JOINT', 'i11'), &
                                       column(['PAIRS', 'LISTS'], 'i9'), column('SIDE1 COVERED', 'f15.6'), &
                                       column('FARTHEST APART', 'es17.5', page%labels%length)], page%file)
      do j = 1, size(model%joints%list)
         if (.not. shown(j)) cycle
         associate (joint => model%joints%list(j))
            call table%put(['JOINT', 'PAIRS', 'LISTS'], [joint%id, joint%last - joint%first + 1 - lists(j), lists(j)])
            call table%put('SIDE1 COVERED', joint%cover%share)
            call table%put('FARTHEST APART', joint%cover%farthest, page_zero*sqrt(joint%area))
            call table%print_row(page%file)
         end associate
      end do
      do j = 1, size(model%joints%list)
         associate (joint => model%joints%list(j))
            if (shown(j) .and. joint%cover%share < whole_share) call page%file%put( &
               '  NOTE: SIDE2 COVERS ONLY A PART OF SIDE1 OF JOINT '//integer_text(joint%id)//'. THE REST OF SIDE1 HAS NO JOINT.')
            if (shown(j) .and. is_coarser(joint%cover)) call page%file%put('  NOTE: SIDE1 OF JOINT '//integer_text(joint%id)// &
               ' IS COARSER THAN SIDE2. EXCHANGE THEM FOR BETTER STRESSES BESIDE THE JOINT.')
         end associate
      end do

      ! initial gaps
      if (.not. has_gaps(model)) return
      call table%start('INITIAL GAPS, NEGATIVE: INTERFERENCE', &
                       [column('JOINT', 'i11'), column('GIVEN BY', 'a10'), column(['SMALLEST', 'LARGEST '], 'es15.5', &
                        page%labels%length), column(['OPEN   ', 'PRESSED'], 'i9')], page%file)
      do j = 1, size(model%joints%list)
         associate (joint => model%joints%list(j), &
            gaps => model%joints%element(model%joints%list(j)%first:model%joints%list(j)%last)%gap)
            if (joint%gap_kind == '') cycle
            call table%put('JOINT', joint%id)
            call table%put('GIVEN BY', trim(joint%gap_kind))
            call table%put(['SMALLEST', 'LARGEST '], [minval(gaps), maxval(gaps)])
            call table%put(['OPEN   ', 'PRESSED'], [count(gaps > 0.0_wp), count(gaps < 0.0_wp)])
            call table%print_row(page%file)
         end associate
      end do
   end subroutine write_joints

   !> Shear laws and friction of the joints that have them.
   subroutine write_shear_laws(file, model)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model
      integer, parameter :: branches(3) = [branch_load, branch_unload, branch_reload]
      character(3), parameter :: cubic_names(6) = ['C11', 'C12', 'C21', 'C22', 'C31', 'C32']
      type(table_type) :: table
      character(*), parameter :: behind = repeat(' ', 17)
      character(page_width) :: line
      type(loop_closure) :: closure
      type(cubic) :: curve
      integer :: b, j, k

      call write_iwan_laws(file, model)
      if (.not. any(.not. model%joints%list%law%iwan%given .and. (model%joints%list%law%shear(1)%given .or. &
                    model%joints%list%law%shear(2)%given .or. model%joints%list%law%has_friction))) return
      call table%start('SHEAR LAWS: TAU = (C11 + C12 P) D + (C21 + C22 P) D**2 + (C31 + C32 P) D**3', &
                       [column('JOINT', 'i11', heading_shift=-1), column('AXIS', 'a4'), column('BRANCH', 'a8'), &
                        column(cubic_names, 'es13.5')], file)
      do j = 1, size(model%joints%list)
         associate (law => model%joints%list(j)%law)
            if (law%iwan%given) cycle
            do k = 1, model%mesh%dimension - 1
               associate (shear => law%shear(k))
                  if (.not. shear%given) cycle
                  do b = 1, 3
                     curve = cubic_of(shear, branches(b))
                     call table%put('JOINT', model%joints%list(j)%id)
                     call table%put('AXIS', axes(k))
                     call table%put('BRANCH', branch_name(branches(b)))
                     call table%put(cubic_names, pack(curve%coefficients, .true.))
                     call table%print_row(file)
                  end do
                  if (shear%from_branch) call file%put(behind//'ORIGIN BRANCH: D OF UNLOAD AND RELOAD COUNTS FROM THEIR START')
                  if (shear%p_max < huge(1.0_wp)) call file%put(behind//'TESTED UP TO P ='//in_form(shear%p_max, '(es13.5)', 13))
                  if (shear%d_max < huge(1.0_wp)) call file%put(behind//'TESTED UP TO D ='//in_form(shear%d_max, '(es13.5)', 13))
                  closure = worst_closure(shear, model%joints%list(j)%p_av) ! of the loops: the widest gap and its place
               end associate
               line = '   D ='//in_form(closure%d, '(es13.5)', 13)
               if (.not. closure%d > 0.0_wp) line = '   OF SMALL LOOPS: THE CARD HAS NO DMAX'
               if (closure%is_known) call file%put(behind//'CLOSURE'//in_form(100.0_wp*closure%share, '(f9.3)', 9)// &
                  ' PER CENT OF TAU_R'//one_of(closure%d > 0.0_wp, ', WIDEST', '')//' AT P ='// &
                  in_form(closure%p, '(es13.5)', 13)//line)
               if (.not. closure%is_known) call file%put(behind//'CLOSURE: UNLOADING DOES NOT REACH TAU = 0')
            end do
            if (law%has_friction) then
               write (line, '(i11, 3a, i5)') model%joints%list(j)%id, '   FRICTION MU =', in_form(law%mu, '(f10.6)', 10), &
                  '   RE-ANALYSES', model%joints%list(j)%n_reanalyses
               call file%put(line)
            end if
         end associate
      end do
   end subroutine write_shear_laws

   !> The Iwan laws of the joints that have them.
   subroutine write_iwan_laws(file, model)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model
      character(7), parameter :: names(6) = [character(7) :: 'FS', 'KT', 'CHI', 'BETA', 'PHI_MAX', 'PREF']
      type(table_type) :: table
      integer :: j

      if (.not. any(model%joints%list%law%iwan%given)) return
      call table%start('IWAN LAWS OF SHEAR AND FRICTION: PHI_MAX = FS (1+BETA)/(KT (BETA + (CHI+1)/(CHI+2))), AT PREF', &
                       [column('JOINT', 'i11', heading_shift=-1), column(names, 'es13.5'), column('SLICES', 'i8'), &
                        column('RE-ANALYSES', 'i13')], file)
      do j = 1, size(model%joints%list)
         associate (law => model%joints%list(j)%law%iwan)
            if (.not. law%given) cycle
            call table%put('JOINT', model%joints%list(j)%id)
            call table%put(names(:5), [law%f_s, law%k_t, law%chi, law%beta, greatest_phi(law)])
            call table%put('PREF', law%p_ref, where=law%p_ref > 0.0_wp)
            call table%put(['SLICES     ', 'RE-ANALYSES'], [size(law%stiffness), model%joints%list(j)%n_reanalyses])
            call table%print_row(file)
         end associate
      end do
   end subroutine write_iwan_laws

end module listing_opening
