!> The tables of oscillation about the state at the end of a stage: natural modes and backbone. The CSV files are
!! NAME.modes.csv, .modes.energy.csv, .backbone.csv, .backbone.response.csv and .loop.csv.
module vibration_tables
   use backbone, only: backbone_type
   use element_mapping, only: two_pi
   use kinds, only: wp
   use mode_parts, only: is_selected, main_part, mode_part
   use mode_values, only: modes_type
   use model_data, only: model_type
   use page_lines, only: axes, in_form
   use result_page, only: backbone_table, bend_table, energy_table, loop_table, modes_table, page_type, pair_modes_table, &
                          table_columns, xyz
   use stage_plan, only: between, pair_names, planned_stage
   use table_column, only: column
   use table_writer, only: table_type
   use text_tools, only: above, integer_text, one_of, plural, real_text, upper
   use tolerances, only: centre_floor, least_loss_factor, listed_share, page_zero, zero_loop_share, zero_mass
   implicit none
   private

   public :: list_modes, list_backbone

   real(wp), parameter :: percent = 100.0_wp
   real(wp), parameter :: steep = 2.0_wp           ! times the stiffness of the loading curves: a stiffer default is warned of
   real(wp), parameter :: wide_gap = 0.01_wp       ! of q: a loop with a wider one does not close
   integer, parameter  :: few = 5                  ! interface elements: the curve is that of the mesh where fewer slip

contains

   !> The search for the modes, mass, frequencies, participation, and shares of strain energy.
   subroutine list_modes(page, model, planned, modes, n_warnings)
      type(page_type), intent(inout)        :: page
      type(model_type), intent(in)          :: model
      type(planned_stage), intent(in)       :: planned
      type(modes_type), intent(in)          :: modes
      integer, intent(inout)                :: n_warnings
      character(4), parameter :: moments(6) = ['I XX', 'I YY', 'I ZZ', 'I XY', 'I YZ', 'I ZX']
      type(mode_part)  :: part
      type(table_type) :: parts, table
      integer, allocatable :: shown(:)
      real(wp) :: extent
      integer  :: c, d, j, m
      logical  :: warns, shows(size(modes%modes))

      call page%file%put('')
      call page%file%put(' NATURAL MODES ABOUT THE END OF '//page%stage//'   '// &
                         one_of(planned%vibration%on_loading, 'STIFFNESS OF LOADING', 'STIFFNESS OF UNLOADING')//', '// &
                         one_of(planned%vibration%free, 'SUPPORTS RELEASED', 'SUPPORTS HELD')//', '// &
                         one_of(model%mesh%lumped, 'LUMPED MASS', 'CONSISTENT MASS'))
      if (size(model%joints%element) > 0) call page%file%put('  INTERFACE ELEMENTS IN CONTACT: '// &
         integer_text(modes%n_touching)//' OF '//integer_text(size(model%joints%element))//'; THE OTHERS HAVE NO STIFFNESS')
      do j = 1, size(model%joints%list)
         if (.not. modes%steeper(j) > 0.0_wp) cycle
         warns = modes%steeper(j) > steep
         call page%file%put(one_of(warns, '  WARNING: E_U OF JOINT', '  NOTE: E_U OF JOINT')//' '// &
            integer_text(model%joints%list(j)%id)//' IS THE DEFAULT, AND MAKES IT '//trim(adjustl(in_form(modes%steeper(j), &
            '(es10.2)', 10)))//' TIMES AS STIFF AS ITS LOADING CURVES'//one_of(warns, ': GIVE EU ON JNORM', ''))
         if (warns) n_warnings = n_warnings + 1
      end do
      if (modes%counted_at < huge(1.0_wp)) then
         call page%file%put('  MODES BELOW THE FREQUENCY '//real_text(modes%counted_at)//': '//integer_text(modes%n_counted)// &
                            ', COUNTED BY THE SIGNS OF THE PIVOTS; NONE IS MISSING')
      else
         call page%file%put('  THE STRUCTURE HAS '//upper(plural(modes%n_counted, 'mode'))//' IN ALL, '// &
                            one_of(modes%n_counted == 1, 'AND IT HAS BEEN FOUND', 'AND ALL HAVE BEEN FOUND'))
      end if
      if (modes%n_before > 0) call page%file%put('  BELOW THE RANGE: '//integer_text(modes%n_before))
      if (size(modes%modes) == 0) call page%file%put('  NO MODE IS IN THE RANGE')

      ! mass, centre and moments of inertia
      d = model%mesh%dimension
      shown = pack([(c, c = 1, 6)], [(d == 3 .or. (c == 3 .and. .not. model%mesh%axisymmetric), c = 1, 6)])
      extent = maxval(abs(model%mesh%x))
      call table%start('MASS OF THE STRUCTURE', [column('MASS', 'es13.5'), column('CENTRE '//axes(:d), 'es13.5', &
                       page%labels%length), column(moments(shown), 'es13.5')], page%file)
      call table%put('MASS', modes%mass)
      call table%put('CENTRE '//axes(:d), modes%centre(:d), page_zero*extent)
      call table%put(moments(shown), modes%inertia(shown), page_zero*modes%mass*extent**2)
      call table%print_row(page%file)
      if (size(modes%modes) == 0) return

      ! frequencies, participation and effective masses
      shows = [(is_selected(model, planned%output%modes, modes%mass, modes%modes(m)), m = 1, size(modes%modes))]
      call table%start('FREQUENCIES', table_columns(modes_table, page%labels, model), page%file)
      call parts%start('PARTICIPATION AND EFFECTIVE MASS', [column('MODE', 'i6'), column('PARTICIPATION '//axes(:d), 'es18.5'), &
                       column('MASS ALONG '//axes(:d), 'es15.5')])
      do m = 1, size(modes%modes)
         part = main_part(model, modes%modes(m)%energy)
         associate (mode => modes%modes(m), largest => sqrt(max(modes%mass, 0.0_wp)/modes%modes(m)%mass))
            call table%put('stage', page%stage_id)
            call table%put('mode', modes%n_before + m)
            call table%put('frequency', mode%frequency)
            call table%put('omega', mode%omega)
            call table%put('GENERALISED MASS', mode%mass)
            call table%put('residual', mode%residual, page_zero)
            call table%put('mass_'//xyz, above(mode%effective, zero_mass*modes%mass))
            call table%put('loss_factor', mode%loss, where=planned%vibration%has_losses .and. .not. mode%is_rigid)
            call table%put('kind', trim(part%kind), where=part%kind /= '')
            call table%put('id', part%id, where=part%kind /= '')
            call table%put('energy', part%share, where=part%kind /= '')
            call table%put('PERCENT', percent*part%share, where=part%kind /= '')
            call table%print_row(page%file, page%tables(modes_table), is_listed=shows(m))
            if (.not. shows(m)) cycle
            call parts%put('MODE', modes%n_before + m)
            call parts%put('PARTICIPATION '//axes(:d), above(mode%participation(:d), sqrt(page_zero)*largest), page_zero*largest)
            call parts%put('MASS ALONG '//axes(:d), mode%effective(:d), page_zero*modes%mass)
            call parts%keep_row()
         end associate
      end do
      if (modes%mass > 0.0_wp) then
         call parts%put('MODE', 'SUM')
         call parts%put('MASS ALONG '//axes(:d), [(sum(modes%modes%effective(c)), c = 1, d)], page_zero*modes%mass)
         call parts%leave_rest()
         call parts%keep_row()
      end if
      if (planned%output%modes%is_given) call page%file%put('  LISTED: '//integer_text(count(shows))//' OF '// &
         integer_text(size(shows))//' MODES, WHICH OUTPUT SELECTS; THE FILES AND THE SUM HAVE ALL')
      if (any(modes%modes%is_rigid)) call page%file%put('  FREQUENCY 0: THE STRUCTURE, OR A PART OF IT, MOVES WITHOUT STRAIN')
      associate (plan => planned%vibration)
         if (plan%amplitude > 0.0_wp) call page%file%put('  LOSS FACTORS FOR A LARGEST DISPLACEMENT OF THE MODE OF '// &
                                                         real_text(plan%amplitude))
         if (plan%has_losses .and. plan%amplitude <= 0.0_wp) call page%file%put( &
            '  LOSS FACTORS OF MATERIALS (GE, PARAM G) ALONE: THE LOSS OF JOINTS NEEDS AN AMPLITUDE')
      end associate
      call parts%print_kept(page%file)
      call list_energies(page, model, modes, shows)
      if (allocated(planned%pairs)) call list_pairs(page, model, planned, modes, shows)
   end subroutine list_modes

   !> The movement of the pairs of WATCH in each mode, and the compliance of the mode between the nodes: phi^2/(m omega^2), whose
   !! sum over all modes is that of two opposite forces on them.
   subroutine list_pairs(page, model, planned, modes, shows)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(planned_stage), intent(in) :: planned
      type(modes_type), intent(in)    :: modes
      logical, intent(in)             :: shows(:) !! (modes) in the listing
      type(table_type) :: table
      real(wp) :: moved(size(pair_names)), stiffness
      integer  :: i, k, m

      if (size(planned%pairs) == 0) return
      call table%start('MODES BETWEEN TWO NODES', table_columns(pair_modes_table, page%labels, model), page%file)
      do m = 1, size(modes%modes)
         stiffness = modes%modes(m)%mass*modes%modes(m)%lambda
         do k = 1, size(planned%pairs)
            moved = between(planned%pairs(k), modes%modes(m)%u)
            where (abs(moved) <= sqrt(page_zero)*maxval(abs(modes%modes(m)%u))) moved = 0.0_wp
            do i = 1, size(pair_names)
               if (.not. any(abs(planned%pairs(k)%along(:, i)) > 0.0_wp)) cycle
               call table%put('stage', page%stage_id)
               call table%put('mode', modes%n_before + m)
               call table%put('frequency', modes%modes(m)%frequency)
               call table%put(['from', 'to  '], planned%pairs(k)%ids)
               call table%put('along', trim(pair_names(i)))
               call table%put('movement', moved(i))
               call table%put('compliance', moved(i)**2/max(stiffness, tiny(1.0_wp)), where=stiffness > 0.0_wp)
               call table%print_row(page%file, page%tables(pair_modes_table), is_listed=shows(m))
            end do
         end do
      end do
   end subroutine list_pairs

   !> The shares of strain energy; a rigid-body mode has no rows.
   subroutine list_energies(page, model, modes, shows)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(modes_type), intent(in)   :: modes
      logical, intent(in)            :: shows(:) !! (modes) in the listing
      type(table_type) :: table
      integer :: i, m

      call table%start('STRAIN ENERGY OF THE MODES, PERCENT; SHARES BELOW '//real_text(percent*listed_share)// &
                       ' ARE NOT LISTED', table_columns(energy_table, page%labels, model), page%file)
      do m = 1, size(modes%modes)
         if (modes%modes(m)%is_rigid) cycle
         associate (energy => modes%modes(m)%energy)
            do i = 1, size(energy%body)
               call put('BODY', i, [energy%body(i), 0.0_wp])
            end do
            do i = 1, size(energy%normal)
               call put('JOINT', model%joints%list(i)%id, [energy%normal(i), energy%shear(i)])
            end do
            do i = 1, size(energy%bar)
               call put('BAR', model%mesh%bars(i)%id, [energy%bar(i), 0.0_wp])
            end do
         end associate
      end do

   contains

      subroutine put(kind, id, shares)
         character(*), intent(in) :: kind
         integer, intent(in)      :: id
         real(wp), intent(in)     :: shares(2)

         call table%put('stage', page%stage_id)
         call table%put('mode', modes%n_before + m)
         call table%put('kind', kind)
         call table%put('id', id)
         call table%put('ALL', percent*sum(shares))
         call table%put(['NORMAL', 'SHEAR '], percent*shares, where=spread(kind == 'JOINT', 1, 2))
         call table%put(['normal', 'shear '], shares)
         call table%print_row(page%file, page%tables(energy_table), is_listed=sum(shares) >= listed_share .and. shows(m))
      end subroutine put

   end subroutine list_energies

   !> The backbone FOUND, a row for each amplitude, and the contribution of every joint to the loss. N_WARNINGS counts warnings.
   subroutine list_backbone(page, model, found, n_warnings)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(backbone_type), intent(in) :: found
      integer, intent(inout)          :: n_warnings
      type(table_type) :: table
      real(wp) :: linear
      integer  :: i, k

      call page%file%put('')
      call page%file%put(' BACKBONE OF MODE '//integer_text(found%mode)//' ABOUT THE END OF '//page%stage// &
                         '   LOOPS UNDER +/- ALPHA [M] PHI, BY NEWTON')
      if (size(found%loops) > 0) then
         linear = sqrt(found%omega_squared)/two_pi
         call page%file%put('  AMPLITUDE: OF THE MODE AT NODE '//integer_text(model%mesh%node_id(found%node))// &
                            '; SHIFT: FROM THE FREQUENCY OF MODES; LOSS FACTOR: THAT OF THE JOINTS, TWICE ZETA')
         call table%start('FREQUENCY AND LOSS AGAINST AMPLITUDE', table_columns(backbone_table, page%labels, model), page%file)
         do i = 1, size(found%loops)
            associate (loop => found%loops(i), frequency => sqrt(found%loops(i)%omega_squared)/two_pi)
               call table%put('stage', page%stage_id)
               call table%put('mode', found%mode)
               call table%put('amplitude', loop%q*found%peak)
               call table%put('frequency', frequency)
               call table%put('SHIFT', percent*(sqrt(loop%omega_squared)/(two_pi*linear) - 1.0_wp), percent*zero_loop_share)
               call table%put('loss_factor', loop%loss)
               call table%put('slipping', loop%slipping)
               call table%put('open', loop%open)
               call table%put('SLIPPING', percent*loop%slipping)
               call table%put('OPEN', percent*loop%open)
               call table%put('CENTRE', loop%centre, centre_floor) ! the last digit
               call table%put('NOT CLOSED', loop%gap, zero_loop_share)
               call table%put('distortion', loop%distortion, zero_loop_share)
               call table%put('LOOPS', loop%n_loops)
            end associate
            call table%print_row(page%file, page%tables(backbone_table))
         end do
         if (size(model%joints%list) > 1) then ! the contribution of every joint to the loss
            call table%start('SHARE OF THE LOSS BY JOINT', [column('AMPLITUDE', 'es14.5', page%labels%length), &
                             column('JOINT', 'i11'), column('SHARE', 'f10.2', 'PERCENT')], page%file)
            do i = 1, size(found%loops)
               if (found%loops(i)%loss > least_loss_factor) then
                  do k = 1, size(model%joints%list)
                     call table%put('AMPLITUDE', found%loops(i)%q*found%peak)
                     call table%put('JOINT', model%joints%list(k)%id)
                     call table%put('SHARE', percent*found%loops(i)%shares(k), zero_loop_share)
                     call table%print_row(page%file)
                  end do
               end if
            end do
         end if
         if (allocated(found%answers)) call list_resonances(page, model, found)
      end if
      call judge_loops(page, model, found, n_warnings)
      if (found%problem /= '') n_warnings = n_warnings + 1
      if (found%is_limited) then
         call page%file%put('  WARNING: LARGER AMPLITUDES HAVE NO EQUILIBRIUM; THE LAST ROW IS FOR THE LARGEST LOAD FOUND')
         call page%file%put('  '//upper(found%problem))
      else if (found%problem /= '') then
         call page%file%put('  WARNING: NO BACKBONE: '//upper(found%problem))
      end if
      call table%start('', table_columns(loop_table, page%labels, model)) ! in the CSV file only
      do i = 1, size(found%loops)
         do k = 1, size(found%loops(i)%way, 2)
            call table%put('stage', page%stage_id)
            call table%put('mode', found%mode)
            call table%put('amplitude', found%loops(i)%q*found%peak)
            call table%put('point', k - 1)
            call table%put(['alpha', 'q    '], found%loops(i)%way(:, k))
            call table%print_row(csv_file=page%tables(loop_table))
         end do
      end do
   end subroutine list_backbone

   !> Notes and warnings on the loops of FOUND: unsettled ones, gaps, negative losses, slip of single nodes. N_WARNINGS counts
   !! warnings.
   subroutine judge_loops(page, model, found, n_warnings)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(backbone_type), intent(in) :: found
      integer, intent(inout)          :: n_warnings
      character(:), allocatable :: amplitude
      integer :: i, k, n, n_unsettled

      n = size(model%joints%element)
      k = 1 ! the amplitude whose loops are farthest from having settled
      do i = 2, size(found%loops)
         if (found%loops(i)%unsettled > found%loops(k)%unsettled) k = i
      end do
      if (size(found%loops) > 0) then
         n_unsettled = count(found%loops%unsettled > least_loss_factor)
         if (n_unsettled > 0) call warn('AT '//integer_text(n_unsettled)//' OF '//integer_text(size(found%loops))// &
            ' AMPLITUDES THE LOOPS HAVE NOT SETTLED: AT AMPLITUDE '//real_text(found%loops(k)%q*found%peak)// &
            ' LOOP '//integer_text(found%loops(k)%n_loops)//' HAS STILL CHANGED THE '// &
            'LOSS FACTOR BY'//in_form(found%loops(k)%unsettled, '(es10.3)', 10)//'; CYCLES OF JAMPL REPEATS THEM')
      end if
      do i = 1, size(found%loops)
         associate (loop => found%loops(i))
            amplitude = real_text(loop%q*found%peak)
            if (abs(loop%gap) > wide_gap) call warn('THE LOOP OF AMPLITUDE '//amplitude//' DOES NOT CLOSE: AFTER '// &
               integer_text(loop%n_loops)//' LOOPS THE STRUCTURE STILL MOVES BY '//in_form(loop%gap, '(f7.4)', 7)//' OF Q A LOOP')
            if (loop%loss < -least_loss_factor) call warn('THE LAWS GIVE BACK MORE THAN THEY ABSORB AT AMPLITUDE '//amplitude// &
               ', LOSS FACTOR '//in_form(loop%loss, '(es11.4)', 11)//': UNLOADING IS LESS STEEP THAN LOADING')
         end associate
      end do
      i = findloc([(nint(found%loops(i)%slipping*n) > 0 .and. nint(found%loops(i)%slipping*n) < min(few, n), &
                    i = 1, size(found%loops))], .true., dim=1, back=.true.)
      if (i > 0) call page%file%put('  NOTE: UP TO AMPLITUDE '//real_text(found%loops(i)%q*found%peak)//' FEWER THAN '// &
         integer_text(min(few, n))//' INTERFACE ELEMENTS SLIP: SHIFT AND LOSS ARE STEPS OF SINGLE NODES OF THIS MESH')

   contains

      subroutine warn(words)
         character(*), intent(in) :: words

         n_warnings = n_warnings + 1
         call page%file%put('  WARNING: '//words)
      end subroutine warn

   end subroutine judge_loops

   !> The resonances of the mode alone, with the frequency and loss of the backbone, under the oscillating load.
   subroutine list_resonances(page, model, found)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(backbone_type), intent(in) :: found
      real(wp), parameter :: at_resonance = -90.0_wp
      type(table_type) :: table
      integer :: i

      call table%start('RESPONSE OF THIS MODE ALONE BY ITS BACKBONE: RESONANCES', &
                       table_columns(bend_table, page%labels, model), page%file)
      do i = 1, size(found%answers, 2)
         associate (answer => found%answers(:, i))
            call table%put('stage', page%stage_id)
            call table%put('mode', found%mode)
            call table%put('amplitude', answer(1))
            call table%put([character(11) :: 'below', 'phase_below'], answer(2:3), where=spread(answer(2) >= 0.0_wp, 1, 2))
            call table%put([character(11) :: 'above', 'phase_above'], answer(4:5))
            call table%print_row(page%file, page%tables(bend_table), &
                                 is_listed=answer(3) <= at_resonance .and. answer(5) >= at_resonance)
         end associate
      end do
      if (.not. any(found%answers(3, :) <= at_resonance)) call page%file%put( &
         '  NONE UP TO THE LARGEST AMPLITUDE: THE BRANCHES DO NOT MEET')
   end subroutine list_resonances

end module vibration_tables
