!> Reads the cards of loads that depend on frequency: RLOAD1, RLOAD2, DLOAD, DAREA, LSEQ and TABLED1 to TABLED4.
module response_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use field_rules, only: any_real, parse_integer, positive, real_range
   use frequency_loads, only: darea_card
   use kinds, only: wp
   use load_cards, only: read_combination
   use text_tools, only: integer_text, one_of
   use vibration_cards, only: check_order, find_endt
   implicit none
   private

   public :: read_rload, read_dload, read_darea, read_lseq, read_tabled

   integer, parameter :: list_from = 9 ! data field in which the list of a table begins
   integer, parameter :: n_given(4) = [3, 2, 3, 5] ! data fields of TABLED1 to TABLED4 in the first line
   character(4), parameter :: motions(0:3) = ['LOAD', 'DISP', 'VELO', 'ACCE']

contains

   !> RLOAD1, RLOAD2. An integer TC, TD, TB or TP is a table, a real number a constant.
   subroutine read_rload(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: text
      integer :: k
      logical :: ok

      associate (rload => bulk%dynamic%rload(card%i))
         rload%is_polar = card%name == 'RLOAD2'
         call card%field('SID', rload%id)
         call card%field('EXCITEID', rload%excite)
         call card%skip([character(8) :: 'DELAY', 'DPHASE', merge('TB', 'TC', rload%is_polar), merge('TP', 'TD', rload%is_polar), &
                         'TYPE'])
         call card%finish(rload%line)
         call constant(3, 'DELAY', rload%delay)
         call constant(4, 'DPHASE', rload%phase)
         do k = 1, 2
            text = card%text_at(4 + k)
            call parse_integer(text, rload%tables(k), ok)
            if (ok .and. rload%tables(k) >= 0) cycle
            rload%tables(k) = 0
            if (text /= '') call card%real_at(4 + k, card%names(4 + k), rload%constants(k), ok, any_real, &
                                              expected='the number of a TABLED, a real number or blank')
         end do
         if (all(rload%tables == 0) .and. all(abs(rload%constants) <= 0.0_wp) .and. .not. card%is_faulty()) &
            call card%error(trim(card%names(5)), 'no factor of the load: expected the number of a TABLED, or a real number')
         text = card%text_at(7)
         do k = 3, 0, -1
            if (text == motions(k) .or. text == motions(k)(:1) .or. text == motions(k)(:2) .or. text == motions(k)(:3) .or. &
                text == integer_text(k) .or. k == 0) exit
         end do
         rload%motion = k
         if (k == 0 .and. text /= '' .and. index('|LOAD|LOA|LO|L|0|', '|'//text//'|') == 0) &
            call card%error('TYPE', ''''//text//''', expected LOAD, DISP, VELO, ACCE, or 0 to 3')
      end associate

   contains

      !> The real number in data field K, zero where it is blank; the sets of DELAY and DPHASE cards are not known.
      subroutine constant(k, name, value)
         integer, intent(in)      :: k
         character(*), intent(in) :: name
         real(wp), intent(inout)  :: value
         integer :: set
         logical :: ok

         call parse_integer(card%text_at(k), set, ok)
         if (ok .and. set == 0 .or. card%text_at(k) == '') return
         if (ok) call card%error_at(k, name//': '//integer_text(set)//' is a set of '//name// &
                                    ' cards; expected a real number, the same for the whole load, or blank')
         if (.not. ok) call card%real_at(k, name, value, ok, any_real, or_blank=.true.)
      end subroutine constant

   end subroutine read_rload

   !> DLOAD: a combination of RLOAD1 and RLOAD2.
   subroutine read_dload(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      call read_combination(card, bulk%dload(card%i))
   end subroutine read_dload

   !> DAREA: one or two nodes with a component and a value.
   subroutine read_darea(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(darea_card) :: areas(2)
      integer :: n

      call card%field('SID', areas(1)%set)
      call card%field('P1', areas(1)%node)
      call card%field('C1', areas(1)%component, default=0, least=0, most=6)
      call card%field('A1', areas(1)%value, default=0.0_wp)
      call card%field('P2', areas(2)%node, default=0)
      call card%field('C2', areas(2)%component, default=0, least=0, most=6)
      call card%field('A2', areas(2)%value, default=0.0_wp)
      call card%finish(areas(1)%line)
      areas(2)%line = areas(1)%line
      areas(2)%set = areas(1)%set
      areas%field = [2, 5]
      n = merge(2, 1, areas(2)%node > 0)
      if (n == 1 .and. any(card%given(['C2', 'A2']))) call card%error('P2', 'node, component C2 and value A2 go together')
      bulk%dynamic%darea(card%i:card%i + n - 1) = areas(:n)
      card%i = card%i + n - 1
   end subroutine read_darea

   !> LSEQ: a load set for the EXCITEID of RLOAD cards.
   subroutine read_lseq(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (lseq => bulk%dynamic%lseq(card%i))
         call card%field('SID', lseq%set)
         call card%field('EXCITEID', lseq%excite)
         call card%field('LID', lseq%load, default=0)
         call card%blank(['TID'])
         call card%finish(lseq%line)
      end associate
   end subroutine read_lseq

   !> TABLED1 to TABLED4.
   subroutine read_tabled(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(real_range) :: ranges(2)
      character(8) :: axis(2)
      real(wp) :: x, y
      integer  :: k, last
      logical  :: ok

      associate (table => bulk%dynamic%tabled(card%i))
         table%line = card%line
         call card%field('TID', table%id)
         read (card%name(7:7), '(i1)') table%kind
         ranges = any_real
         select case (table%kind)
         case (1)
            call card%word('XAXIS', '|LINEAR|LOG|', axis(1))
            call card%word('YAXIS', '|LINEAR|LOG|', axis(2))
            table%is_log = axis == 'LOG'
            where (table%is_log)
               ranges%least = positive%least
               ranges%above = positive%above
            end where
         case (2)
            call card%field('X1', table%shift, default=0.0_wp)
         case default
            call card%field('X1', table%shift, default=0.0_wp)
            call card%field('X2', table%scale, default=1.0_wp)
            if (abs(table%scale) <= 0.0_wp) call card%error('X2', 'zero, expected the unit of the argument')
            if (table%kind == 4) call card%field('X3', table%ends(1), default=-huge(1.0_wp))
            if (table%kind == 4) call card%field('X4', table%ends(2), default=huge(1.0_wp))
         end select
         call card%blank(spread('blank', 1, list_from - 1 - n_given(table%kind)))
         allocate (table%x(0), table%y(0))
         call find_endt(card, list_from, last, one_of(table%kind == 4, 'coefficient', 'pair of X and Y'))
         if (card%is_faulty()) return
         do k = list_from, last - 1, merge(1, 2, table%kind == 4)
            y = 0.0_wp
            if (table%kind == 4) then
               if (card%text_at(k) /= '') call card%real_at(k, 'A', y, ok, any_real)
            else
               if (card%text_at(k) == '' .and. (card%text_at(k + 1) == '' .or. k + 1 == last)) cycle
               if (card%text_at(k) == 'SKIP' .or. card%text_at(k + 1) == 'SKIP') cycle
               call card%real_at(k, 'X', x, ok, ranges(1))
               call card%real_at(k + 1, 'Y', y, ok, ranges(2))
               table%x = [table%x, x]
            end if
            table%y = [table%y, y]
         end do
         if (table%kind < 4) call check_order(card, list_from, 'X', table%x, table%y)
         if (size(table%y) == 0 .and. .not. card%is_faulty()) call card%error_at(list_from, 'no coefficient before ENDT')
      end associate
   end subroutine read_tabled

end module response_cards
