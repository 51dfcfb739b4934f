!> The tables of bars, bolts and springs: their forces after every increment.
module listing_bars
   use analysis_state, only: analysis_type
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use kinds, only: wp
   use listing_table, only: column, listing_table_type, noise, page_type
   use model_data, only: a_bar, a_spring, bar_nodes, model_type, n_bars, n_sections, n_springs, point_of
   use text_tools, only: clean
   implicit none
   private

   public :: note_bars, note_springs, note_sections

contains

   !> Note the forces of all bars after the increment just completed.
   subroutine note_bars(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      real(wp) :: floor
      integer  :: i

      if (n_bars(model) == n_springs(model)) return
      if (table%is_empty()) call table%start( &
         'BOLT FORCES, AND FORCES OF OTHER BARS (TENSION POSITIVE), '//page%stage, &
         [column('INCR', 'i6'), column([character(7) :: 'BOLT', 'ELEMENT', 'NODE 1', 'NODE 2'], 'i11'), &
          column('FORCE', 'es15.5', page%labels%force), column('ELONGATION', 'es15.5', page%labels%length), column('', 'a')])
      floor = noise*maxval(abs(analysis%u))
      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            if (bar%kind == a_spring) cycle
            call table%add([analysis%increment])
            if (bar%bolt > 0) call table%add([bar%bolt])
            if (bar%bolt == 0) call table%skip(1)
            call table%add([bar%id, model%node_id(bar%nodes)])
            call table%add([clean(bar_tension(model, analysis, i), noise*page%largest_force), &
                            clean(elongation_now(model, analysis, i), floor)])
            if (bar%bolt > 0) call table%add(state_of_bolt(bar%stage == analysis%stage, analysis%is_elastic(i)))
            call table%keep_row()
         end associate
      end do
   end subroutine note_bars

   !> Note the forces of all springs after the increment just completed.
   subroutine note_springs(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      real(wp) :: floor
      integer  :: i, id(2), k

      if (n_springs(model) == 0) return
      if (table%is_empty()) call table%start( &
         'FORCES OF SPRINGS (CELAS: POSITIVE WHERE NODE 1 IS AHEAD OF NODE 2; CBUSH: NODE 2 OF NODE 1; 0: GROUND), '//page%stage, &
         [column('INCR', 'i6'), column([character(7) :: 'ELEMENT', 'NODE 1', 'NODE 2'], 'i11'), column('AXIS', 'a6'), &
          column('FORCE', 'es15.5', page%labels%force), column('ELONGATION', 'es15.5', page%labels%length)])
      floor = noise*maxval(abs(analysis%u))
      do i = 1, n_bars(model)
         associate (spring => model%bars(i))
            if (spring%kind == a_bar) cycle
            id = 0
            do k = 1, size(bar_nodes(spring))
               id(k) = model%node_id(point_of(model, spring%nodes(k)))
            end do
            if (spring%ground_first) id = id([2, 1])
            call table%add([analysis%increment, spring%id, id])
            call table%add('  '//spring%axis//'  ')
            call table%add([clean(bar_tension(model, analysis, i), noise*page%largest_force), &
                            clean(elongation_now(model, analysis, i), floor)])
            call table%keep_row()
         end associate
      end do
   end subroutine note_springs

   !> Note the forces of all solid bolts after the increment just completed, and how much each was shortened at its section.
   subroutine note_sections(page, model, analysis, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      type(analysis_type), intent(in)         :: analysis
      type(listing_table_type), intent(inout) :: table
      real(wp) :: floor
      integer  :: i

      if (n_sections(model) == 0) return
      if (table%is_empty()) call table%start( &
         'BOLT FORCES, SOLID BOLTS (TENSION POSITIVE), '//page%stage, &
         [column('INCR', 'i6'), column([character(7) :: 'BOLT', 'SURFACE'], 'i11'), column('', 'a22'), &
          column('FORCE', 'es15.5', page%labels%force), column('SHORTENED BY', 'es15.5', page%labels%length), column('', 'a')])
      floor = noise*maxval(abs(analysis%u))
      do i = 1, n_sections(model)
         associate (section => model%sections(i))
            call table%add([analysis%increment, section%bolt, section%surface])
            call table%skip(1)
            call table%add([clean(section_tension(model, analysis, i), noise*page%largest_force), &
                            clean(overlap_now(model, analysis, i), floor)])
            call table%add(state_of_bolt(section%stage == analysis%stage, analysis%is_locked(i)))
            call table%keep_row()
         end associate
      end do
   end subroutine note_sections

   pure function state_of_bolt(is_tightened, is_locked) result(word)
      logical, intent(in) :: is_tightened, is_locked
      character(10) :: word

      word = ''
      if (is_tightened) word = ' TIGHTENED'
      if (is_locked) word = ' LOCKED'
   end function state_of_bolt

end module listing_bars
