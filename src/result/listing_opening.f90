!> The first pages of the listing: heading, deck echo, summary of the model, joints and stages.
module listing_opening
   use case_control, only: case_control_type, method_newton, method_step, pressure_eq10
   use deck_input, only: deck_type
   use equation_solver, only: equation_system, solver_description
   use kinds, only: long, wp
   use listing_echo, only: write_echo
   use listing_page, only: cut, heading, in_column, label_type, page_width, unit_labels
   use model_data, only: model_type, n_bars, n_points, n_sections
   use normal_stiffness, only: branch_load, branch_name, branch_reload, branch_unload, pressure_floor
   use output_file, only: output_file_type
   use shear_stiffness, only: cubic, cubic_of
   use stage_plan, only: stage_plan_type
   use text_tools, only: clean, real_text
   implicit none
   private

   public :: write_opening

contains

   !> Everything that can be said before the first increment.
   subroutine write_opening(file, deck, model, plan, system)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      class(equation_system), intent(in)    :: system

      call file%put(' '//repeat('-', page_width - 1))
      call file%put('  J O I N T F E M      TANGENT-STIFFNESS FINITE ELEMENT ANALYSIS OF JOINTED STRUCTURES')
      call file%put('  '//cut(deck%control%title, page_width - 2))
      call file%put(' '//repeat('-', page_width - 1))
      call write_echo(file, deck)
      call write_summary(file, deck, model, system)
      call write_joints(file, deck%control, model)
      call write_stages(file, deck%control, model, plan)
   end subroutine write_opening


   !> What the model has of everything, and how it is solved.
   subroutine write_summary(file, deck, model, system)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(in)          :: model
      class(equation_system), intent(in)    :: system
      type(solver_description) :: solver
      integer :: i

      call heading(file, 'MODEL SUMMARY')
      call count_line('NODES', int(n_points(model), long))
      if (.not. all(model%used)) call count_line('   OF THESE WITHOUT AN ELEMENT, LEFT OUT', &
                                                 count(.not. model%used, kind=long))
      if (any(model%twin > 0)) call count_line('   OF THESE DOUBLED AT SPLIT SURFACES', count(model%twin > 0, kind=long))
      call count_line('BODY ELEMENTS', int(model%n_elements, long))
      if (n_bars(model) > 0) call count_line('BARS, BOLTS INCLUDED', size(model%bars, kind=long))
      if (n_sections(model) > 0) call count_line('SOLID BOLTS', size(model%sections, kind=long))
      call count_line('JOINTS', size(model%joints, kind=long))
      call count_line('INTERFACE ELEMENTS', size(model%interface, kind=long))
      call count_line('SUPPORTED COMPONENTS', count(model%held(:, :n_points(model)), kind=long))
      call count_line('UNKNOWNS', int(system%n, long))
      call system%describe(solver)
      do i = 1, size(solver%words)
         if (solver%words(i) /= '') call count_line(trim(solver%words(i)), solver%numbers(i))
      end do
      call count_line('STAGES', size(deck%control%stages, kind=long))
      associate (control => deck%control)
         select case (control%method)
         case (method_step)
            call file%put('  METHOD STEP   PRESSURE '//trim(merge('EQ10', 'SUMF', control%pressure == pressure_eq10))// &
                          '   CARRY '//trim(merge('YES', 'NO ', control%carry))//'   SOLVER '//solver%name)
         case (method_newton)
            call file%put('  METHOD NEWTON   TOL '//real_text(control%tolerance)//'   SOLVER '//solver%name)
         case default
            call file%put('  METHOD BACK   SOLVER '//solver%name)
         end select
      end associate
      if (deck%control%length_unit /= '') call file%put('  UNITS, LABELS ONLY: LENGTH '// &
         trim(deck%control%length_unit)//', FORCE '//trim(deck%control%force_unit))

   contains

      subroutine count_line(words, number)
         character(*), intent(in)  :: words
         integer(long), intent(in) :: number
         character(80) :: line

         write (line, '(2x, a, t46, i12)') words, number
         call file%put(line)
      end subroutine count_line

   end subroutine write_summary


   !> Laws and areas of the joints.
   subroutine write_joints(file, control, model)
      type(output_file_type), intent(inout) :: file
      type(case_control_type), intent(in)   :: control
      type(model_type), intent(in)          :: model
      type(label_type) :: labels
      character(page_width) :: line
      integer :: j

      if (size(model%joints) == 0) return
      labels = unit_labels(control)
      call heading(file, 'JOINTS')
      if (model%dimension == 3) then
         call file%put('      JOINT ELEMENTS        A_INT            C      M            E_U   FIRST P (EQ.9)  LEAST P ON'// &
                       ' LOAD  NORMAL X  NORMAL Y  NORMAL Z')
      else
         call file%put('      JOINT ELEMENTS        A_INT            C      M            E_U   FIRST P (EQ.9)  LEAST P ON'// &
                       ' LOAD   NORMAL X   NORMAL Y')
      end if
      if (control%length_unit /= '') then
         line = ''
         line(21:) = in_column(labels%area, 13)
         line(54:) = in_column(trim(labels%pressure)//'/'//labels%length, 15)
         line(69:) = in_column(labels%pressure, 17)
         line(86:) = in_column(labels%pressure, 17)
         call file%put(line)
      end if
      do j = 1, size(model%joints)
         associate (joint => model%joints(j), law => model%joints(j)%law%normal)
            write (line, '(i11, i9, es13.5, es13.5, f7.4, es15.5, es17.5, es17.5)') joint%id, &
               joint%last - joint%first + 1, joint%area, law%c, law%m, law%e_u, joint%p_av, pressure_floor*joint%p_av
            if (model%dimension == 3) then
               write (line(103:), '(3f10.6)') clean(joint%normal, 1.0e-9_wp)
            else
               write (line(103:), '(2f11.6)') clean(joint%normal(:2), 1.0e-9_wp)
            end if
            call file%put(line)
         end associate
      end do
      call write_shear_laws(file, model)
   end subroutine write_joints


   !> Shear laws and friction of the joints that have them.
   subroutine write_shear_laws(file, model)
      type(output_file_type), intent(inout) :: file
      type(model_type), intent(in)          :: model
      integer, parameter :: branches(3) = [branch_load, branch_unload, branch_reload]
      character(page_width) :: line
      type(cubic) :: curve
      integer :: b, j, k

      if (.not. any(model%joints%law%shear(1)%given .or. model%joints%law%shear(2)%given .or. &
                    model%joints%law%has_friction)) return
      call heading(file, 'SHEAR LAWS: TAU = (C11 + C12 P) D + (C21 + C22 P) D**2 + (C31 + C32 P) D**3')
      call file%put('     JOINT AXIS  BRANCH          C11          C12          C21          C22          C31          C32')
      do j = 1, size(model%joints)
         associate (law => model%joints(j)%law)
            do k = 1, model%dimension - 1
               if (.not. law%shear(k)%given) cycle
               do b = 1, 3
                  curve = cubic_of(law%shear(k), branches(b))
                  write (line, '(i11, 3x, a1, 2x, a6, 6es13.5)') model%joints(j)%id, merge('X', 'Y', k == 1), &
                     branch_name(branches(b)), curve%coefficients
                  call file%put(line)
               end do
               if (law%shear(k)%p_max < huge(1.0_wp)) then
                  write (line, '(17x, a, es13.5)') 'TESTED UP TO P =', law%shear(k)%p_max
                  call file%put(line)
               end if
               if (law%shear(k)%d_max < huge(1.0_wp)) then
                  write (line, '(17x, a, es13.5)') 'TESTED UP TO D =', law%shear(k)%d_max
                  call file%put(line)
               end if
            end do
            if (law%has_friction) then
               write (line, '(i11, a, f10.6, a, i5)') model%joints(j)%id, '   FRICTION MU =', law%mu, '   RE-ANALYSES', &
                  model%joints(j)%n_reanalyses
               call file%put(line)
            end if
         end associate
      end do
   end subroutine write_shear_laws


   !> The load history: totals at the end of every stage.
   subroutine write_stages(file, control, model, plan)
      type(output_file_type), intent(inout) :: file
      type(case_control_type), intent(in)   :: control
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(label_type) :: labels
      character(page_width) :: line
      real(wp) :: total(3), largest
      integer  :: s

      labels = unit_labels(control)
      call heading(file, 'STAGES')
      if (model%dimension == 3) then
         call file%put('     STAGE  INCREMENTS   FIRST SHARE    LAST SHARE   TOTAL LOAD X   TOTAL LOAD Y   TOTAL LOAD Z   LABEL')
      else
         call file%put('     STAGE  INCREMENTS   FIRST SHARE    LAST SHARE   TOTAL LOAD X   TOTAL LOAD Y   LABEL')
      end if
      if (labels%force /= '') then
         line = ''
         line(51:) = in_column(labels%force, 15)
         line(66:) = in_column(labels%force, 15)
         if (model%dimension == 3) line(81:) = in_column(labels%force, 15)
         call file%put(line)
      end if
      do s = 1, size(plan%stages)
         associate (stage => plan%stages(s), loads => model%stage_loads(s))
            total = sum(loads%force(:, :loads%n), dim=2)
            largest = 0.0_wp
            if (loads%n > 0) largest = maxval(abs(loads%force(:, :loads%n)))
            write (line, '(i11, i11, 2es14.5, 3es15.5)') stage%id, size(stage%shares), stage%shares(1), &
               stage%shares(size(stage%shares)), clean(total(:model%dimension), 1.0e-9_wp*largest)
            line(54 + 15*model%dimension:) = cut(stage%label, 33)
            call file%put(line)
         end associate
      end do
   end subroutine write_stages

end module listing_opening
