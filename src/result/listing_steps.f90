!> Tables of what the steps of STEP leave open: how far they are from the laws, and what each re-analysis does.
module listing_steps
   use analysis_state, only: analysis_type
   use kinds, only: wp
   use law_error, only: distance_type, normal_distance, shear_distance
   use listing_table, only: axes, column, column_type, listing_table_type, noise, page_type
   use model_data, only: joint_node_id, model_type
   use stage_plan, only: stage_plan_type, where_in_plan
   use step_method, only: reanalyses_shown
   use text_tools, only: clean, integer_text, real_text
   implicit none
   private

   public :: note_distances, note_slips, distance_words

   real(wp), parameter :: far = 0.02_wp !! of the largest deflection or stress: the answer is another one than that of the laws

   !> The largest distance from a law in a run.
   type, public :: farthest_type
      real(wp) :: relative = 0.0_wp        !! of the largest deflection or stress of the joint in the increment
      integer  :: node = 0                 !! its number
      character(:), allocatable :: quantity, place !! in words
   end type farthest_type

contains

   !> Note how far the joints are from their laws after the increment just completed, and where that is most in the run.
   subroutine note_distances(page, model, plan, analysis, table, farthest)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(stage_plan_type), intent(in)       :: plan
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      type(farthest_type), intent(inout)      :: farthest
      type(column_type), allocatable :: columns(:)
      type(distance_type) :: normal, shear
      logical :: has_shear
      integer :: j

      if (.not. allocated(analysis%exact) .or. size(model%joints) == 0) return
      has_shear = any([(model%joints(j)%law%shear%given, j = 1, size(model%joints))])
      if (table%is_empty()) then
         associate (p => page%labels%pressure, length => page%labels%length)
            columns = [column('INCR', 'i6'), column('JOINT', 'i11'), column('LAMBDA OFF %', 'f13.3'), column('AT NODE', 'i11'), &
                       column(['LAMBDA    ', 'LAMBDA LAW'], 'es13.5', length)]
            if (has_shear) columns = [columns, column('TAU OFF %', 'f11.3'), column('AT NODE', 'i11'), column('ALONG', 'a6'), &
                                      column(['TAU    ', 'TAU LAW'], 'es13.5', p)]
         end associate
         call table%start('DISTANCE FROM THE LAWS, '//page%stage//': LARGEST |LAMBDA - LAMBDA LAW| OF THE LARGEST LAMBDA'// &
                          trim(merge(', |TAU - TAU LAW| OF THE LARGEST TAU', repeat(' ', 36), has_shear)), columns)
      end if
      do j = 1, size(model%joints)
         normal = normal_distance(model, analysis, j)
         shear = shear_distance(model, analysis, j)
         call table%add([analysis%increment, model%joints(j)%id])
         call add(normal, analysis%largest_lambda)
         if (shear%is_there) call add(shear, analysis%largest_p)
         call table%keep_row()
         call remember(normal, 'deflection')
         call remember(shear, 'shear stress')
      end do

   contains

      !> The columns of one DISTANCE, of values of which LARGEST is the largest so far.
      subroutine add(distance, largest)
         type(distance_type), intent(in) :: distance
         real(wp), intent(in)            :: largest

         if (.not. distance%is_there) then
            call table%skip(4)
            return
         end if
         call table%add([100.0_wp*clean(distance%relative, noise)])
         call table%add([joint_node_id(model, distance%element, 1)])
         if (distance%direction < 3) call table%add(axes(distance%direction))
         call table%add(clean([distance%actual, distance%by_law], noise*largest))
      end subroutine add

      !> Keep DISTANCE if it is the largest so far.
      subroutine remember(distance, quantity)
         type(distance_type), intent(in) :: distance
         character(*), intent(in)        :: quantity

         if (.not. distance%is_there .or. distance%relative <= farthest%relative) return
         farthest%relative = distance%relative
         farthest%node = joint_node_id(model, distance%element, 1)
         farthest%quantity = quantity
         farthest%place = where_in_plan(plan, analysis%stage, analysis%increment)
      end subroutine remember

   end subroutine note_distances

   !> The line on the screen at the end of a run that was FAR from its laws; '' where it was not.
   pure function distance_words(farthest) result(words)
      type(farthest_type), intent(in) :: farthest
      character(:), allocatable :: words

      words = ''
      if (farthest%relative > far) words = 'STEP is up to '//real_text(0.1_wp*anint(1000.0_wp*farthest%relative))// &
         ' % of the largest '//farthest%quantity//' away from its law, at node '//integer_text(farthest%node)//' in '// &
         farthest%place//'; METHOD = NEWTON gives the answer of the laws'
   end function distance_words

   !> Note the slipping elements before and after each re-analysis of the increment just completed, t_1 and t_1' of Fig. 5(b).
   subroutine note_slips(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      real(wp) :: delta_floor, tau_floor
      integer  :: i, k, side

      if (size(analysis%record%slips) == 0) return
      associate (length => page%labels%length, pressure => page%labels%pressure)
         if (table%is_empty()) call table%start( &
            'SLIPPING ELEMENTS BEFORE AND AFTER EACH RE-ANALYSIS, '//page%stage//' (POINTS T_1 AND T_1'' OF FIG. 5B)', &
            [column(['INCR', 'PASS'], 'i6'), column([character(7) :: 'ELEMENT', 'NODE 1'], 'i11'), column('ALONG', 'a6'), &
             column('DELTA', 'es13.5', length), column([character(5) :: 'TAU', 'LIMIT'], 'es13.5', pressure), &
             column('DELTA AFTER', 'es14.5', length), column([character(11) :: 'TAU AFTER', 'LIMIT AFTER'], 'es13.5', pressure)])
      end associate
      delta_floor = noise*analysis%largest_lambda
      tau_floor = noise*analysis%largest_p
      do i = 1, size(analysis%record%slips)
         associate (slip => analysis%record%slips(i))
            if (slip%reanalysis > reanalyses_shown + 1 .and. all(analysis%record%slips(:i - 1)%reanalysis < slip%reanalysis)) &
               call table%keep_line('        ...')
            do k = 1, model%dimension - 1
               if (.not. model%joints(model%interface(slip%element)%joint)%law%shear(k)%given) cycle
               call table%add([analysis%increment, slip%reanalysis, model%interface(slip%element)%id, &
                               joint_node_id(model, slip%element, 1)])
               call table%add(axes(k))
               do side = 1, 2 ! before and after
                  call table%add([clean(slip%delta(k, side), delta_floor), clean([slip%tau(k, side), slip%limit(side)], tau_floor)])
               end do
               call table%keep_row()
            end do
         end associate
      end do
   end subroutine note_slips

end module listing_steps
