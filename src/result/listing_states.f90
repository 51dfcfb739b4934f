!> OUTPUT = STATE: what the interface elements remember; OUTPUT = CONDENSED: [k_b] on the interface. With both an increment can be
!! done by hand.
module listing_states
   use analysis_state, only: analysis_type
   use branch_starts, only: branch_shift
   use kinds, only: wp
   use listing_nodes, only: shows_interface
   use listing_table, only: axes, column, heading, listing_table_type, noise, page_type
   use model_data, only: joint_node_id, model_type, n_rotations
   use normal_stiffness, only: branch_name, branch_reload, branch_unload
   use shear_stiffness, only: curve_deflection
   use text_tools, only: clean, integer_text, upper
   implicit none
   private

   public :: list_states, list_condensed

contains

   !> What the elements remember of their normal way, joint by joint, and of their shear ways.
   subroutine list_states(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(listing_table_type) :: table
      real(wp) :: lambda_floor, p_floor
      integer  :: i, j, k

      lambda_floor = noise*analysis%largest_lambda
      p_floor = noise*analysis%largest_p
      do j = 1, size(model%joints)
         associate (joint => model%joints(j), labels => page%labels)
            call table%start('STATE OF THE INTERFACE ELEMENTS OF JOINT '//integer_text(joint%id)//page%now, &
                             [column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), column('BRANCH', 'a8'), &
                              column(['SIGMAF', 'SUMF  '], 'es13.5', labels%force), &
                              column('LAMBDA A', 'es13.5', labels%length), column('P A', 'es13.5', labels%pressure), &
                              column('LAMBDA B', 'es13.5', labels%length)], page%file)
            do i = joint%first, joint%last
               if (.not. shows_interface(page, model, i)) cycle
               associate (state => analysis%states(i)%normal, element => model%interface(i))
                  call table%add([element%id, joint_node_id(model, i, 1)])
                  call table%add(branch_name(state%branch), clean([state%sigmaf, state%sumf], p_floor*element%area))
                  call table%add([clean(state%lambda_a, lambda_floor), clean(state%p_a, p_floor), &
                                  clean(state%lambda_b, lambda_floor)])
                  call table%print_row(page%file)
               end associate
            end do
            do k = 1, model%dimension - 1
               if (joint%law%shear(k)%given) call list_shear_state(page, model, analysis, j, k)
            end do
         end associate
      end do
   end subroutine list_states

   !> Likewise of the shear way of joint J in direction K. D and TAU count in the sense of the loading, like point A.
   subroutine list_shear_state(page, model, analysis, j, k)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j, k
      type(listing_table_type) :: table
      real(wp) :: delta_floor, tau_floor, shift
      integer  :: i

      delta_floor = noise*analysis%largest_lambda
      tau_floor = noise*analysis%largest_p
      associate (joint => model%joints(j), length => page%labels%length, pressure => page%labels%pressure)
         call table%start('STATE OF SHEAR IN DIRECTION '//axes(k)//' OF JOINT '//integer_text(joint%id)//page%now, &
                          [column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), column('BRANCH', 'a8'), column('SENSE', 'i6'), &
                           column('D', 'es13.5', length), column('TAU', 'es13.5', pressure), column('D_R', 'es13.5', length), &
                           column([character(5) :: 'TAU_R', 'O', 'B0', 'C0'], 'es13.5', pressure)], page%file)
         do i = joint%first, joint%last
            if (.not. shows_interface(page, model, i)) cycle
            associate (state => analysis%states(i)%shear(k), element => model%interface(i))
               shift = clean(branch_shift(joint%law%shear(k), state, max(0.0_wp, analysis%states(i)%normal%pressure), &
                                          analysis%turns(k, i)), tau_floor)
               call table%add([element%id, joint_node_id(model, i, 1)])
               call table%add(branch_name(state%branch))
               call table%add([nint(state%sense)])
               call table%add([clean(curve_deflection(state), delta_floor), clean(state%sense*state%tau, tau_floor), &
                               clean(state%d_r, delta_floor), clean([state%tau_r, state%offset], tau_floor)])
               call table%add([shift, shift], where=state%branch == [branch_unload, branch_reload])
               call table%print_row(page%file)
            end associate
         end do
      end associate
   end subroutine list_shear_state

   !> [k_b] condensed on the unknowns of the joints, and the loads that these feel before and after the stage; columns in groups.
   subroutine list_condensed(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, parameter :: across = 8
      type(listing_table_type) :: table
      character(12), allocatable :: names(:)
      real(wp), allocatable :: scale(:)
      real(wp) :: k_floor, load_floor
      integer  :: i, first, k, last, n

      associate (condensed => analysis%record%condensed)
         if (condensed%problem /= '') then
            call heading(page%file, '[K_B] CONDENSED ON THE INTERFACE, '//page%stage//': NOT PRINTED, '//upper(condensed%problem))
            return
         end if
         n = size(condensed%node)
         k_floor = noise*maxval(abs(condensed%k))
         load_floor = noise*max(page%largest_force, maxval(abs(condensed%load)))
         allocate (names(n))
         allocate (scale(n), source=1.0_wp)
         do i = 1, n ! 12Y, or 900RZ where it is a rotation of node 900: by its arm its rows hold moments
            associate (node => condensed%node(i), d => condensed%direction(i))
               k = 0
               if (n_rotations(model) > 0) k = findloc(model%rotations%node, node, dim=1)
               if (k == 0) names(i) = integer_text(model%node_id(node))//axes(d)
               if (k == 0) cycle
               names(i) = integer_text(model%node_id(model%rotations(k)%point))//'R'//axes(merge(d, 3, model%dimension == 3))
               scale(i) = model%rotations(k)%arm
            end associate
         end do
         do first = 1, n, across
            last = min(n, first + across - 1)
            call table%start('[K_B] CONDENSED ON THE INTERFACE, '//page%stage, &
                             [column('UNKNOWN', 'a13'), column(names(first:last), 'es13.5', page%labels%stiffness)], page%file)
            do i = 1, n
               call table%add(adjustr(names(i)))
               call table%add(clean(condensed%k(i, first:last), k_floor)*scale(i)*scale(first:last))
               call table%print_row(page%file)
            end do
         end do
         call table%start('LOAD CONDENSED ON THE INTERFACE, '//page%stage//': AN INCREMENT BRINGS ITS SHARE OF THE DIFFERENCE', &
                          [column('UNKNOWN', 'a13'), column([character(10) :: 'BEFORE', 'AFTER', 'DIFFERENCE'], 'es13.5', &
                           page%labels%force)], page%file)
         do i = 1, n
            call table%add(adjustr(names(i)))
            call table%add(clean([condensed%load(i, :), condensed%load(i, 2) - condensed%load(i, 1)], load_floor)*scale(i))
            call table%print_row(page%file)
         end do
      end associate
   end subroutine list_condensed

end module listing_states
