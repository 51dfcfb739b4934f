!> The table of the response to an oscillating load, with what it misses: peaks between the frequencies asked for, and frequencies
!! above the modes. The CSV files are NAME.response.csv and, of one node against another, NAME.between.response.csv.
module response_tables
   use kinds, only: wp
   use modal_response, only: response_type
   use modal_superposition, only: phase_of
   use mode_values, only: modes_type
   use model_data, only: model_type
   use numbers, only: first_largest
   use page_lines, only: axes, in_form
   use result_page, only: page_type, pair_response_table, response_table, table_columns, xyz
   use stage_plan, only: node_pair, pair_names
   use table_column, only: column
   use table_writer, only: table_type
   use text_tools, only: integer_text, one_of, real_text
   implicit none
   private

   public :: list_response, list_pair_response, list_uncovered

contains

   !> Say by which MODES a response of SOL 108 is computed. Warn of frequencies of RESPONSE above the MODES: no peak of a higher mode can
   !! be there.
   subroutine list_uncovered(page, model, modes, response, n_warnings)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(modes_type), intent(in)    :: modes
      type(response_type), intent(in) :: response
      integer, intent(inout)          :: n_warnings
      character(:), allocatable :: reached
      integer :: c

      if (response%is_direct) then
         call page%file%put('')
         call page%file%put('  SOL 108 BY ITS MODES: '//integer_text(size(modes%modes))//' MODES UP TO '// &
            real_text(maxval([0.0_wp, modes%modes%frequency]))//one_of(response%is_complete, &
            ', ALL UP TO TWICE THE HIGHEST FREQUENCY, AND THE STATIC RESPONSE OF THE OTHERS', ''))
      end if
      if (response%n_beyond == 0) return
      n_warnings = n_warnings + 1
      reached = ''
      do c = 1, model%mesh%dimension
         reached = reached//', '//trim(adjustl(in_form(100.0_wp*sum(modes%modes%effective(c))/modes%mass, '(f8.1)', 8)))// &
                   ' % ALONG '//axes(c)
      end do
      call page%file%put('')
      call page%file%put('  WARNING: '//integer_text(response%n_beyond)//' OF '//integer_text(size(response%frequency))// &
         ' FREQUENCIES, UP TO '//real_text(maxval(response%frequency))//', ARE ABOVE THE HIGHEST MODE, MODE '// &
         integer_text(modes%n_before + size(modes%modes))//' AT '//real_text(maxval([0.0_wp, modes%modes%frequency]))// &
         ': PEAKS OF HIGHER MODES ARE MISSING')
      call page%file%put('  THE MODES HAVE AN EFFECTIVE MASS OF '//reached(3:)// &
                         '; WITHOUT V2 AND ND ON EIGRL ENOUGH MODES ARE TAKEN')
   end subroutine list_uncovered

   !> The largest amplitude of every wanted component, with its frequency; the CSV file has all amplitudes, ordered by frequency,
   !! node and component. N_WARNINGS counts warnings.
   subroutine list_response(page, model, response, n_warnings)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(response_type), intent(in) :: response
      integer, intent(inout)          :: n_warnings
      type(table_type) :: table
      character(12) :: amplitude
      integer :: at, c, f, i

      n_warnings = n_warnings + size(response%missed) + merge(1, 0, size(response%frequency) == 0)
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
            call table%put('NODE', response%node(i))
            call table%put('ALONG', axes(c))
            call table%put('AMPLITUDE', response%amplitude(c, i, at))
            call table%put('AT FREQUENCY', response%frequency(at))
            call table%put('PHASE', response%phase(c, i, at))
            call table%print_row(page%file)
         end do
      end do
      if (.not. response%is_complete) call page%file%put( &
         '  BY THESE MODES ALONE: THE STATIC PART OF THE OTHER MODES NEEDS ALL RIGID-BODY MODES AND ONE MODE WITH STRAIN')
      do i = 1, size(response%missed)
         associate (peak => response%missed(i))
            amplitude = in_form(peak%amplitude, '(es12.5)', 12)
            if (peak%amplitude <= 0.0_wp) amplitude = 'NO BOUND'
            call page%file%put('  WARNING: MODE '//integer_text(peak%mode)// &
               ' HAS ITS PEAK BETWEEN THE REQUESTED FREQUENCIES: AT '//trim(adjustl(in_form(peak%frequency, '(es12.5)', 12)))// &
               ' NODE '//integer_text(response%node(peak%node))//' '//axes(peak%component)//' '//trim(adjustl(amplitude))// &
               ', IN THE TABLE '//trim(adjustl(in_form(peak%beside, '(es12.5)', 12)))//'; SEE FREQ4')
         end associate
      end do
      call table%start('', table_columns(response_table, page%labels, model)) ! in the CSV file only
      do f = 1, size(response%frequency)
         do i = 1, size(response%node)
            do c = 1, size(response%amplitude, 1)
               call table%put('stage', page%stage_id)
               call table%put('frequency', response%frequency(f))
               call table%put('node', response%node(i))
               call table%put('component', xyz(c))
               call table%put('amplitude', response%amplitude(c, i, f))
               call table%put('phase', response%phase(c, i, f))
               call table%print_row(csv_file=page%tables(response_table))
            end do
         end do
      end do
   end subroutine list_response

   !> The response of PAIRS of nodes, one against the other: amplitude, and where the load acts between them the compliance,
   !! movement over force, with its largest size and its least real part, which decides on chatter.
   subroutine list_pair_response(page, model, pairs, response)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(node_pair), intent(in)     :: pairs(:)
      type(response_type), intent(in) :: response
      type(table_type) :: table
      complex(wp) :: g(size(response%frequency)) ! movement over force, or over 1 without one
      logical :: is_forced
      integer :: at, f, i, k, least

      if (size(pairs) == 0 .or. size(response%frequency) == 0) return
      call table%start('RESPONSE BETWEEN TWO NODES; COMPLIANCE: MOVEMENT OVER THE FORCE BETWEEN THEM', &
                       table_columns(pair_response_table, page%labels, model), page%file)
      do k = 1, size(pairs)
         do i = 1, size(pair_names)
            if (.not. any(abs(pairs(k)%along(:, i)) > 0.0_wp)) cycle
            is_forced = all(abs(response%force(i, k, :)) > 0.0_wp)
            g = response%between(i, k, :)/merge(response%force(i, k, :), (1.0_wp, 0.0_wp), is_forced)
            at = first_largest(abs(g))
            least = first_largest(-real(g))
            call put_pair(at)
            call table%put('AT FREQUENCY', response%frequency(at))
            call table%put([character(15) :: 'COMPLIANCE', 'LEAST REAL PART', 'OF LEAST'], &
                           [abs(g(at)), real(g(least)), response%frequency(least)], where=spread(is_forced, 1, 3))
            call table%leave_rest()
            call table%print_row(page%file)
            do f = 1, size(response%frequency)
               call put_pair(f)
               call table%put(['real     ', 'imaginary'], [real(g(f)), aimag(g(f))], where=spread(is_forced, 1, 2))
               call table%leave_rest()
               call table%print_row(csv_file=page%tables(pair_response_table))
            end do
         end do
      end do

   contains

      subroutine put_pair(f)
         integer, intent(in) :: f

         call table%put('stage', page%stage_id)
         call table%put('frequency', response%frequency(f))
         call table%put(['from', 'to  '], pairs(k)%ids)
         call table%put('along', trim(pair_names(i)))
         call table%put('amplitude', abs(response%between(i, k, f)))
         call table%put('phase', phase_of(response%between(i, k, f)))
      end subroutine put_pair

   end subroutine list_pair_response

end module response_tables
