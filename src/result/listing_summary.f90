!> The deck and the model on the first pages of the listing: the echo of the cards, the numbers of the parts of the model, the method.
module listing_summary
   use control_words, only: method_newton, method_step, pressure_eq10
   use deck_cards, only: card_name
   use deck_input, only: deck_type
   use deck_lines, only: is_include
   use element_kinds, only: element_table
   use element_mapping, only: has_modes
   use equation_solver, only: equation_system
   use kinds, only: long
   use mesh_queries, only: n_points, n_rotations
   use model_data, only: a_bar, a_matrix, a_spring, model_type, n_bars, n_sections, supported
   use output_file, only: output_file_type
   use page_lines, only: cut, heading, page_width, put_lines
   use range_watch, only: tetra_words
   use text_tools, only: integer_text, one_of, plural, real_text, upper
   implicit none
   private

   public :: write_echo, write_summary

   integer, parameter :: most_echoed = 5000 ! cards of a deck that are echoed without ECHO

contains

   !> The deck as read, cards counted, under a field ruler. INCLUDE files are counted, not shown. The same holds for the cards
   !! of a very long deck, unless ECHO asks for them.
   subroutine write_echo(file, deck)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      integer, parameter :: outside = 0, begins = 1, a_card = 2, in_card = 3 ! where a line is: in the bulk data or not
      integer, allocatable :: part(:)
      character(10) :: counter
      character(8)  :: name
      integer(long) :: first, last
      integer :: cards, comma, i, number
      integer :: hidden ! lines of INCLUDE files since the last one shown
      logical :: ended, shows_cards

      if (.not. deck%control%echo) then
         call heading(file, 'DECK: '//integer_text(deck%bulk%n_cards)//' CARDS, NOT ECHOED')
         return
      end if
      call heading(file, 'DECK ECHO')
      associate (text => deck%text, is_own => [(deck%text%file_number(i) == 1, i = 1, deck%text%n)])
         allocate (part(0:text%n), source=outside)
         ended = .false.
         do i = 1, text%n
            if (part(i - 1) /= outside) then
               call text%find(i, number, first, last, comma) ! examined in place: copies of a long deck take time
               associate (line => text%files(number)%bytes(first:last))
                  name = card_name(line, comma)
                  if (is_include(line)) name = ''
               end associate
               part(i) = merge(in_card, a_card, name == '' .or. name == 'ENDDATA')
               ended = name == 'ENDDATA' .and. is_own(i)
               if (ended) part(i) = outside
            else if (.not. ended) then
               if (index(adjustl(upper(text%card_part(i))), 'BEGIN') == 1) part(i) = begins
            end if
         end do
         shows_cards = deck%control%echo_asked .or. count(is_own .and. part(1:) == a_card) <= most_echoed
         cards = 0
         hidden = 0
         do i = 1, text%n
            if (part(i) == a_card) cards = cards + 1
            counter = ''
            if (shows_cards .and. part(i) == a_card) write (counter, '(i9, a)') cards, '-'
            if (.not. is_own(i)) then
               hidden = hidden + 1
            else if (shows_cards .or. part(i) <= begins) then
               call count_hidden()
               call file%put(' '//counter//' '//cut(text%line(i), page_width - 13))
            end if
            if (part(i) /= begins .or. .not. shows_cards) cycle
            call file%put('   CARD')
            call file%put('  COUNT-    .   1  ..   2  ..   3  ..   4  ..   5  ..   6  ..   7  ..   8  ..   9  ..  10  .')
         end do
      end associate
      call count_hidden()
      call file%put('')
      call file%put('  TOTAL COUNT '//integer_text(cards)//' CARDS')
      if (.not. shows_cards) call file%put('  THE DECK ITSELF HAS MORE THAN '//integer_text(most_echoed)// &
                                           ', NOT ECHOED: ECHO = YES SHOWS THEM')

   contains

      subroutine count_hidden()
         if (hidden > 0) call file%put('            ('//upper(plural(hidden, 'line'))//' OF INCLUDE FILES, NOT ECHOED)')
         hidden = 0
      end subroutine count_hidden

   end subroutine write_echo

   !> The numbers of the parts of the model, and the solver.
   subroutine write_summary(file, deck, model, system)
      type(output_file_type), intent(inout) :: file
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(in)          :: model
      class(equation_system), intent(in)    :: system
      integer(long) :: n(2, size(element_table)) ! body elements of a kind, without and with incompatible modes
      integer :: i, k, m

      call heading(file, 'MODEL SUMMARY')
      call count_line(file, 'NODES', int(n_points(model%mesh), long))
      if (.not. all(model%freedoms%used)) &
         call count_line(file, '   OF THESE WITHOUT AN ELEMENT, LEFT OUT', count(.not. model%freedoms%used, kind=long))
      if (model%mesh%n_filled > 0) call count_line(file, '   OF THESE MADE AT THE MIDDLE OF EDGES', int(model%mesh%n_filled, long))
      if (any(model%mesh%duplicate > 0)) &
         call count_line(file, '   OF THESE DOUBLED AT SPLIT SURFACES', count(model%mesh%duplicate > 0, kind=long))
      ! the elements, those of bodies by kind and formulation, and the constraints
      call count_line(file, 'BODY ELEMENTS', int(model%mesh%n_elements, long))
      n = 0
      do i = 1, model%mesh%n_elements
         k = model%mesh%element_kind(i)
         associate (property => model%mesh%properties(model%mesh%element_property(i)))
            m = merge(2, 1, property%incompatible .and. has_modes(k, property%state))
         end associate
         n(m, k) = n(m, k) + 1
      end do
      do k = 1, size(element_table)
         associate (kind => element_table(k))
            if (n(1, k) > 0) call count_line(file, '   '//trim(kind%card)//' OF '//integer_text(kind%n_nodes)//' NODES, '// &
                                             one_of(kind%linear == k, 'PLAIN', 'SECOND ORDER'), n(1, k))
            if (n(2, k) > 0) call count_line(file, '   '//trim(kind%card)//' OF '//integer_text(kind%n_nodes)// &
                                             ' NODES, INCOMPATIBLE MODES', n(2, k))
         end associate
      end do
      associate (n_springs => count(model%mesh%bars%kind == a_spring, kind=long))
         if (any(model%mesh%bars%kind == a_bar)) call count_line(file, 'BARS, BOLTS INCLUDED', &
                                                                 count(model%mesh%bars%kind == a_bar, kind=long))
         if (any(model%mesh%bars%kind == a_matrix)) call count_line(file, 'MATRICES OF STIFFNESS (K2GG)', &
                                                                    count(model%mesh%bars%kind == a_matrix, kind=long))
         if (n_springs > 0) call count_line(file, 'SPRINGS, ONE A DIRECTION', n_springs)
      end associate
      if (n_sections(model%mesh) > 0) call count_line(file, 'SOLID BOLTS', size(model%mesh%sections, kind=long))
      call count_line(file, 'JOINTS', size(model%joints%list, kind=long))
      call count_line(file, 'INTERFACE ELEMENTS', size(model%joints%element, kind=long))
      call count_line(file, 'SUPPORTED COMPONENTS', &
                      sum([(count(supported(model%mesh, model%freedoms, i), kind=long), i = 1, n_points(model%mesh) + &
                         n_rotations(model%mesh))]))
      if (size(deck%bulk%rigid) > 0) call count_line(file, 'RIGID ELEMENTS', size(deck%bulk%rigid, kind=long))
      if (size(model%freedoms%left_out) > 0) call count_line(file, 'COMPONENTS DEPENDENT OR IDLE', &
         count(model%freedoms%left_out, kind=long))
      call count_line(file, 'UNKNOWNS', int(system%n, long))
      do i = 1, size(system%description%words)
         if (system%description%words(i) /= '') &
            call count_line(file, trim(system%description%words(i)), system%description%numbers(i))
      end do
      call count_line(file, 'STAGES', size(deck%control%stages, kind=long))

      ! the method and the solver, the units, and the entries without effect
      associate (control => deck%control, solver => system%description)
         select case (control%method)
         case (method_step)
            call file%put('  METHOD STEP   PRESSURE '//one_of(control%pressure == pressure_eq10, 'EQ10', 'SUMF')// &
                          '   CARRY '//one_of(control%carry, 'YES', 'NO')//'   SOLVER '//solver%name)
         case (method_newton)
            call file%put('  METHOD NEWTON   TOL '//real_text(control%tolerance)//'   PATHTOL '// &
                          real_text(control%path_tolerance)//'   SOLVER '//solver%name)
         case default
            call file%put('  METHOD BACK   AVERAGE '//one_of(control%average, 'YES', 'NO')//'   TOL '// &
                          real_text(control%tolerance)//'   SOLVER '//solver%name)
         end select
         if (allocated(solver%reason)) call file%put('  '//solver%reason)
      end associate
      if (any(deck%control%stages%vibration%modes%id /= 0)) call file%put('  MASS '// &
         one_of(model%mesh%lumped, 'LUMPED', 'CONSISTENT (DEFAULT OF NASTRAN: LUMPED)'))
      if (deck%control%length_unit /= '') call file%put('  UNITS, LABELS ONLY: LENGTH '// &
         trim(deck%control%length_unit)//', FORCE '//trim(deck%control%force_unit))
      call put_lines(file, upper(deck%bulk%ignored%words()), ',')
      if (allocated(deck%bulk%told)) then
         do i = 1, size(deck%bulk%told)
            call put_lines(file, upper(deck%bulk%told(i)%words), ',')
         end do
      end if
      if (tetra_words(model) /= '') call file%put('  WARNING: '//upper(tetra_words(model)))
      do i = 1, size(model%warnings)
         call put_lines(file, 'WARNING: '//upper(model%warnings(i)%words), ' ')
      end do
   end subroutine write_summary

   !> The number of a kind of parts of the model.
   subroutine count_line(file, words, number)
      type(output_file_type), intent(inout) :: file
      character(*), intent(in)              :: words
      integer(long), intent(in)             :: number
      character(80) :: line
      character(20) :: digits

      write (digits, '(i20)') number
      line = '  '//words
      line(58 - len_trim(adjustl(digits)):57) = adjustl(digits)
      call file%put(line)
   end subroutine count_line

end module listing_summary
