!> The tables of the natural modes about the state at the end of a stage.
module listing_modes
   use kinds, only: wp
   use listing_table, only: axes, column, column_type, listing_table_type, noise, page_type
   use modal_response, only: missed_peak, response_type
   use mode_values, only: modes_type
   use model_data, only: model_type
   use numbers, only: first_largest
   use stage_plan, only: vibration_plan_type
   use text_tools, only: above, clean, integer_text, real_text
   implicit none
   private

   public :: list_modes, list_response

   real(wp), parameter :: percent = 100.0_wp
   real(wp), parameter :: least_share = 1.0e-4_wp  ! of the strain energy: what has less has no row
   real(wp), parameter :: no_part = 1.0e-9_wp      ! of the largest mass or participation possible: rounding

contains

   !> How they were found; frequencies; masses; where the strain energy is.
   subroutine list_modes(page, model, plan, modes)
      type(page_type), intent(inout)        :: page
      type(model_type), intent(in)          :: model
      type(vibration_plan_type), intent(in) :: plan
      type(modes_type), intent(in)          :: modes

      call page%file%put('')
      call page%file%put(' NATURAL MODES ABOUT THE END OF '//page%stage//'   '// &
                         trim(merge('JOINTS AS THEY LOAD  ', 'JOINTS AS THEY UNLOAD', plan%on_loading))//', '// &
                         trim(merge('SUPPORTS LET GO      ', 'SUPPORTS AS THEY ARE ', plan%free))//', '// &
                         trim(merge('LUMPED MASS    ', 'CONSISTENT MASS', model%lumped)))
      if (size(model%interface) > 0) call page%file%put('  INTERFACE ELEMENTS THAT TOUCH: '// &
         integer_text(modes%n_touching)//' OF '//integer_text(size(model%interface))//'; THE OTHERS TAKE NO PART')
      if (modes%counted_at < huge(1.0_wp)) then
         call page%file%put('  MODES BELOW THE FREQUENCY '//real_text(modes%counted_at)//': '//integer_text(modes%n_counted)// &
                            ', COUNTED BY THE SIGNS OF THE PIVOTS; NONE IS MISSING')
      else
         call page%file%put('  THE STRUCTURE HAS '//integer_text(modes%n_counted)//' MODES IN ALL, AND ALL HAVE BEEN FOUND')
      end if
      if (modes%n_before > 0) call page%file%put('  BELOW THE RANGE: '//integer_text(modes%n_before))
      if (size(modes%modes) == 0) call page%file%put('  THERE IS NONE IN THE RANGE')
      call list_mass(page, model, modes)
      if (size(modes%modes) == 0) return
      call list_frequencies(page, plan, modes)
      call list_participation(page, model, modes)
      call list_energies(page, model, modes)
   end subroutine list_modes

   !> Mass, centre and moments of inertia of the structure.
   subroutine list_mass(page, model, modes)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(modes_type), intent(in)   :: modes
      character(4), parameter :: moments(6) = ['I XX', 'I YY', 'I ZZ', 'I XY', 'I YZ', 'I ZX']
      type(column_type), allocatable :: columns(:)
      type(listing_table_type) :: table
      integer, allocatable :: shown(:)
      real(wp) :: size_of_it
      integer  :: c, d

      d = model%dimension
      allocate (shown, source=pack([(c, c = 1, 6)], [(d == 3 .or. (c == 3 .and. .not. model%axisymmetric), c = 1, 6)]))
      size_of_it = maxval(abs(model%x))
      columns = [column('MASS', 'es13.5'), column('CENTRE '//axes(:d), 'es13.5', page%labels%length)]
      columns = [columns, column(moments(shown), 'es13.5')]
      call table%start('MASS OF THE STRUCTURE', columns, page%file)
      call table%add([modes%mass, clean(modes%centre(:d), no_part*size_of_it)])
      call table%add(clean(modes%inertia(shown), no_part*modes%mass*size_of_it**2))
      call table%print_row(page%file)
   end subroutine list_mass

   subroutine list_frequencies(page, plan, modes)
      type(page_type), intent(inout)        :: page
      type(vibration_plan_type), intent(in) :: plan
      type(modes_type), intent(in)          :: modes
      type(listing_table_type) :: table
      integer :: m

      call table%start('FREQUENCIES', [column('MODE', 'i6'), column('FREQUENCY', 'es15.5', '1/TIME'), &
                       column('OMEGA', 'es15.5', 'RAD/TIME'), column('GENERALISED MASS', 'es18.5'), column('RESIDUAL', 'es12.1'), &
                       column('LOSS FACTOR', 'es15.5')], page%file)
      do m = 1, size(modes%modes)
         associate (mode => modes%modes(m))
            call table%add([modes%n_before + m], [mode%frequency, mode%omega, mode%mass, clean(mode%residual, noise)])
            if (plan%has_losses .and. .not. mode%is_rigid) call table%add([mode%loss])
            call table%print_row(page%file)
         end associate
      end do
      if (any(modes%modes%is_rigid)) call page%file%put('  FREQUENCY 0: THE STRUCTURE, OR A PART OF IT, MOVES WITHOUT STRAIN')
      if (plan%amplitude > 0.0_wp) call page%file%put('  LOSS FACTORS WHERE THE LARGEST DISPLACEMENT OF THE MODE IS '// &
                                                      real_text(plan%amplitude))
      if (plan%has_losses .and. plan%amplitude <= 0.0_wp) call page%file%put( &
         '  LOSS FACTORS OF MATERIALS (GE, PARAM G) ALONE: WHAT JOINTS LOSE DEPENDS ON AN AMPLITUDE')
   end subroutine list_frequencies

   subroutine list_participation(page, model, modes)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(modes_type), intent(in)   :: modes
      type(listing_table_type) :: table
      real(wp) :: sums(3)
      integer  :: d, m

      d = model%dimension
      call table%start('PARTICIPATION AND EFFECTIVE MASS', [column('MODE', 'i6'), column('PARTICIPATION '//axes(:d), 'es18.5'), &
                       column('MASS ALONG '//axes(:d), 'es15.5')], page%file)
      sums = 0.0_wp
      do m = 1, size(modes%modes)
         associate (mode => modes%modes(m))
            call table%add([modes%n_before + m])
            associate (largest => sqrt(modes%mass/mode%mass))
               call table%add(clean(above(mode%participation(:d), sqrt(no_part)*largest), no_part*largest))
            end associate
            call table%add(clean(mode%effective(:d), no_part*modes%mass))
            call table%print_row(page%file)
            sums = sums + mode%effective
         end associate
      end do
      if (.not. modes%mass > 0.0_wp) return
      call table%add('SUM')
      call table%skip(d)
      call table%add(clean(sums(:d), no_part*modes%mass))
      call table%print_row(page%file)
   end subroutine list_participation

   !> Where and at which frequency every component asked for has its largest amplitude.
   subroutine list_response(page, response)
      type(page_type), intent(inout)  :: page
      type(response_type), intent(in) :: response
      type(listing_table_type) :: table
      integer :: at, c, i

      if (size(response%frequency) == 0) then
         call page%file%put('')
         call page%file%put('  WARNING: NO RESPONSE TO THE OSCILLATING LOAD: NO MODE FOUND IS IN THE RANGE OF FREQ4')
         return
      end if
      call table%start('RESPONSE TO THE OSCILLATING LOAD, LARGEST AMPLITUDES OF '//integer_text(size(response%frequency))// &
                       ' FREQUENCIES', [column('NODE', 'i11'), column('ALONG', 'a7'), &
                       column('AMPLITUDE', 'es15.5', page%labels%length), column('AT FREQUENCY', 'es15.5', '1/TIME'), &
                       column('PHASE', 'f10.2', 'DEGREES')], page%file)
      do i = 1, size(response%node)
         do c = 1, size(response%amplitude, 1)
            at = first_largest(response%amplitude(c, i, :))
            call table%add([response%node(i)])
            call table%add(axes(c))
            call table%add([response%amplitude(c, i, at), response%frequency(at), response%phase(c, i, at)])
            call table%print_row(page%file)
         end do
      end do
      if (.not. response%is_complete) call page%file%put( &
         '  BY THESE MODES ALONE: THE STRUCTURE IS NOT HELD, AND HAS NO STATIC ANSWER')
      do i = 1, size(response%missed)
         call page%file%put(missed_words(response, response%missed(i)))
      end do
   end subroutine list_response

   !> The line that warns of a PEAK between the frequencies asked for.
   pure function missed_words(response, peak) result(words)
      type(response_type), intent(in) :: response
      type(missed_peak), intent(in)   :: peak
      character(:), allocatable       :: words
      character(12) :: amplitude, beside, frequency

      write (frequency, '(es12.5)') peak%frequency
      write (amplitude, '(es12.5)') peak%amplitude
      write (beside, '(es12.5)') peak%beside
      if (peak%amplitude <= 0.0_wp) amplitude = 'NO BOUND'
      words = '  WARNING: MODE '//integer_text(peak%mode)//' HAS ITS PEAK BETWEEN THE FREQUENCIES ASKED FOR: AT '// &
              trim(adjustl(frequency))//' NODE '//integer_text(response%node(peak%node))//' '//axes(peak%component)//' '// &
              trim(adjustl(amplitude))//', BESIDE IT '//trim(adjustl(beside))//'; SEE FREQ4'
   end function missed_words

   !> A row a mode for every body, joint and bar that has some of its strain energy.
   subroutine list_energies(page, model, modes)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(modes_type), intent(in)   :: modes
      type(listing_table_type) :: table
      integer :: i, m

      call table%start('STRAIN ENERGY OF THE MODES, PERCENT; WHAT HAS LESS THAN '//real_text(percent*least_share)// &
                       ' IS NOT LISTED', [column('MODE', 'i6'), column('PART', 'a8'), column('NUMBER', 'i11'), &
                        column('ALL', 'f10.2'), column('NORMAL', 'f10.2'), column('SHEAR', 'f10.2')], page%file)
      do m = 1, size(modes%modes)
         associate (energy => modes%modes(m)%energy)
            do i = 1, size(energy%body)
               call add_row('BODY', i, energy%body(i))
            end do
            do i = 1, size(energy%normal)
               call add_row('JOINT', model%joints(i)%id, energy%normal(i) + energy%shear(i), [energy%normal(i), energy%shear(i)])
            end do
            do i = 1, size(energy%bar)
               call add_row('BAR', model%bars(i)%id, energy%bar(i))
            end do
         end associate
      end do

   contains

      subroutine add_row(kind, id, share, of_joint)
         character(*), intent(in)       :: kind
         integer, intent(in)            :: id
         real(wp), intent(in)           :: share
         real(wp), intent(in), optional :: of_joint(2)

         if (share < least_share) return
         call table%add([modes%n_before + m])
         call table%add(kind)
         call table%add([id], [percent*share])
         if (present(of_joint)) call table%add(percent*of_joint)
         call table%print_row(page%file)
      end subroutine add_row

   end subroutine list_energies

end module listing_modes
