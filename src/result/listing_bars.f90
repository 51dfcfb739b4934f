!> The tables of bars and bolts: their forces after every increment.
module listing_bars
   use analysis_state, only: analysis_type
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use kinds, only: wp
   use listing_page, only: heading, in_column, label_type, noise, page_width
   use model_data, only: model_type, n_bars, n_sections
   use output_file, only: output_file_type
   use row_buffer, only: row_buffer_type
   use text_tools, only: clean
   implicit none
   private

   public :: note_bars, note_sections, list_bars, list_sections

   integer, parameter :: state_column = 82

contains

   !> Note the forces of all bars after the increment just completed.
   subroutine note_bars(model, analysis, largest_force, rows)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(in)      :: analysis
      real(wp), intent(in)                 :: largest_force !! ever applied, for the noise
      type(row_buffer_type), intent(inout) :: rows
      character(44) :: who
      character(9)  :: state
      real(wp) :: floor
      integer  :: i

      if (n_bars(model) == 0) return
      floor = noise*maxval(abs(analysis%u))
      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            write (who, '(11x, 3i11)') bar%id, model%node_id(bar%nodes)
            state = ''
            if (bar%bolt > 0) then
               write (who(:11), '(i11)') bar%bolt
               state = state_of_bolt(bar%stage == analysis%stage, analysis%is_elastic(i))
            end if
            call note(analysis%increment, who, clean(bar_tension(model, analysis, i), noise*largest_force), &
                      clean(elongation_now(model, analysis, i), floor), state, rows)
         end associate
      end do
   end subroutine note_bars


   !> Note the forces of all solid bolts after the increment just completed, and how much each was shortened at its section.
   subroutine note_sections(model, analysis, largest_force, rows)
      type(model_type), intent(in)         :: model
      type(analysis_type), intent(in)      :: analysis
      real(wp), intent(in)                 :: largest_force !! ever applied, for the noise
      type(row_buffer_type), intent(inout) :: rows
      character(44) :: who
      real(wp) :: floor
      integer  :: i

      if (n_sections(model) == 0) return
      floor = noise*maxval(abs(analysis%u))
      do i = 1, n_sections(model)
         associate (section => model%sections(i))
            write (who, '(2i11)') section%bolt, section%surface
            call note(analysis%increment, who, clean(section_tension(model, analysis, i), noise*largest_force), &
                      clean(overlap_now(model, analysis, i), floor), &
                      state_of_bolt(section%stage == analysis%stage, analysis%is_locked(i)), rows)
         end associate
      end do
   end subroutine note_sections


   !> A row of either table: whose force it is (BOLT ELEMENT NODE NODE, or BOLT SURFACE), the force, the length, the bolt's state.
   subroutine note(increment, who, tension, length, state, rows)
      integer, intent(in)                  :: increment
      character(44), intent(in)            :: who
      real(wp), intent(in)                 :: tension, length
      character(9), intent(in)             :: state
      type(row_buffer_type), intent(inout) :: rows
      character(page_width) :: row

      write (row, '(i6, a44, 2es15.5)') increment, who, tension, length
      row(state_column:) = state
      call rows%add(row)
   end subroutine note


   pure function state_of_bolt(is_tightened, is_locked) result(word)
      logical, intent(in) :: is_tightened, is_locked
      character(9) :: word

      word = ''
      if (is_tightened) word = 'TIGHTENED'
      if (is_locked) word = 'LOCKED'
   end function state_of_bolt


   subroutine list_bars(file, labels, stage, rows)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      character(*), intent(in)              :: stage
      type(row_buffer_type), intent(inout)  :: rows

      call list_forces(file, labels, 'BOLT FORCES, AND FORCES OF OTHER BARS (TENSION POSITIVE), '//stage, &
                       '  INCR       BOLT    ELEMENT     NODE 1     NODE 2          FORCE     ELONGATION', rows)
   end subroutine list_bars


   subroutine list_sections(file, labels, stage, rows)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      character(*), intent(in)              :: stage
      type(row_buffer_type), intent(inout)  :: rows

      call list_forces(file, labels, 'BOLT FORCES, SOLID BOLTS (TENSION POSITIVE), '//stage, &
                       '  INCR       BOLT    SURFACE                                FORCE   SHORTENED BY', rows)
   end subroutine list_sections


   !> A table of forces and lengths, where there are ROWS.
   subroutine list_forces(file, labels, title, columns, rows)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      character(*), intent(in)              :: title, columns
      type(row_buffer_type), intent(inout)  :: rows
      character(page_width) :: line

      if (rows%n == 0) return
      call heading(file, title)
      call file%put(columns)
      if (labels%force /= '') then
         line = ''
         line(51:) = in_column(labels%force, 15)
         line(66:) = in_column(labels%length, 15)
         call file%put(line)
      end if
      call rows%flush(file)
   end subroutine list_forces

end module listing_bars
