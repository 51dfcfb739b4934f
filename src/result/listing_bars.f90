!> The table of bars and bolts: their forces after every increment.
module listing_bars
   use analysis_state, only: analysis_type
   use bar_elements, only: bar_elongation
   use bolt_locking, only: bar_tension
   use kinds, only: wp
   use listing_opening, only: heading, label_type, noise, page_width
   use model_data, only: model_type, n_bars
   use output_file, only: output_file_type
   use row_buffer, only: row_buffer_type
   use text_tools, only: clean
   implicit none
   private

   public :: note_bars, list_bars

contains

   !> Note the forces of all bars after the increment just completed.
   subroutine note_bars(model, analysis, largest_force, rows)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(in)      :: analysis
      real(wp), intent(in)                 :: largest_force !! ever applied, for the noise
      type(row_buffer_type), intent(inout) :: rows
      character(page_width) :: row
      integer :: i

      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            write (row, '(i6, 11x, 3i11, 2es15.5)') analysis%increment, bar%id, model%node_id(bar%nodes), &
               clean(bar_tension(model, analysis, i), noise*largest_force), &
               clean(bar_elongation(model, analysis%u, i), noise*maxval(abs(analysis%u)))
            if (bar%bolt > 0) then
               write (row(7:17), '(i11)') bar%bolt
               if (bar%stage == analysis%stage) row(82:) = 'TIGHTENED'
               if (bar%is_elastic) row(82:) = 'LOCKED'
            end if
            call rows%add(row)
         end associate
      end do
   end subroutine note_bars


   subroutine list_bars(file, labels, stage, rows)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      character(*), intent(in)              :: stage
      type(row_buffer_type), intent(inout)  :: rows
      character(page_width) :: line

      if (rows%n == 0) return
      call heading(file, 'BOLT FORCES, AND FORCES OF OTHER BARS (TENSION POSITIVE), '//stage)
      call file%put('  INCR       BOLT    ELEMENT     NODE 1     NODE 2          FORCE     ELONGATION')
      if (labels%force /= '') then
         line = ''
         line(51:) = adjustr(labels%force(:15))
         line(66:) = adjustr(labels%length(:15))
         call file%put(line)
      end if
      call rows%flush(file)
   end subroutine list_bars

end module listing_bars
