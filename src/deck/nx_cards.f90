!> Reads the cards of contact, glue and bolts as Simcenter Nastran (NX) and Femap write them: regions, their pairs, preloads.
!! nx_translation makes JOINT, PMARK and BOLT cards of this program from them.
module nx_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use field_rules, only: at_least_1, not_negative, parse_integer, positive
   use kinds, only: wp
   use load_data, only: bolt_card
   use text_tools, only: one_of
   implicit none
   private

   public :: is_nx_bolt, read_nx_bolt, read_region, read_pair, read_preload

contains

   !> Whether a BOLT is one of NX: an ETYPE of 1 to 3 where this program has EID, then no real number.
   logical function is_nx_bolt(card)
      type(card_fields_type), intent(in) :: card
      integer :: n(2)
      logical :: ok(2)

      call parse_integer(card%text_at(2), n(1), ok(1))
      call parse_integer(card%text_at(merge(3, 5, n(1) == 1)), n(2), ok(2))
      is_nx_bolt = all(ok) .and. n(1) >= 1 .and. n(1) <= 3 .and. index(card%text_at(3), '.') == 0
   end function is_nx_bolt

   !> BOLT of NX: ETYPE 1: the bars or beams EID; 2: the section through the nodes G; 3: the section of the solids EID at node GP.
   !! Axis IDIR of system CSID is the axis of the bolt.
   subroutine read_nx_bolt(card, bolt)
      type(card_fields_type), intent(inout) :: card
      type(bolt_card), intent(inout)        :: bolt
      logical :: ok

      bolt%line = card%line
      call card%field('BID', bolt%id)
      call card%integer_at(2, 'ETYPE', bolt%kind, ok, bounds=at_least_1)
      if (bolt%kind > 1) then
         if (card%text_at(3) /= '') call card%integer_at(3, 'CSID', bolt%system, ok, bounds=[0, huge(1)])
         if (card%text_at(4) /= '' .or. bolt%kind == 3) call card%integer_at(4, 'IDIR', bolt%axis, ok, bounds=[1, 3])
         if (bolt%kind == 3) call card%integer_at(5, 'GP', bolt%node, ok, bounds=at_least_1)
      end if
      call card%list_ranges(3*bolt%kind - merge(1, 0, bolt%kind == 2), one_of(bolt%kind == 2, 'G', 'EID'), &
                            one_of(bolt%kind == 2, 'a node number', 'an element number'), bolt%parts)
   end subroutine read_nx_bolt

   !> BSURF: elements; BCPROP, BCPROPS: properties; BSURFS: groups of an element and three corners of its face. BCRPARA: SURF.
   subroutine read_region(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: i, k, n
      logical :: ok

      associate (region => bulk%region(card%i))
         region%line = card%line
         call card%field('ID', region%id)
         region%by_property = index(card%name, 'BCPROP') == 1
         region%is_parameter = card%name == 'BCRPARA'
         region%is_bottom = region%is_parameter .and. card%text_at(2) == 'BOT'
         if (region%is_parameter .and. verify(card%text_at(3), '0.+-') > 0) &
            call card%error_at(3, 'OFFSET: '//card%text_at(3)//', expected zero or blank')
         if (region%is_parameter) return
         if (card%name /= 'BSURFS') then
            call card%list_ranges(2, 'ID', 'a number', region%ranges)
            return
         end if
         call card%must_be_blank(2, 4, '; the elements of BSURFS begin in field 6')
         n = max(0, (card%n - 1)/4)
         allocate (region%corners(3, n), region%ranges%first(n), source=0)
         n = 0
         do k = 5, card%n, 4
            if (card%text_at(k) == '') cycle
            n = n + 1
            call card%integer_at(k, 'EID', region%ranges%first(n), ok, bounds=at_least_1)
            do i = 1, 3
               call card%integer_at(k + i, 'G', region%corners(i, n), ok, bounds=at_least_1)
            end do
         end do
         if (n == 0) call card%error_at(5, 'EID1: blank, expected an element and three corners of its face')
         region%ranges%first = region%ranges%first(:n)
         region%ranges%last = region%ranges%first
      end associate
   end subroutine read_region

   !> BCTSET: pairs SID, TID, FRIC, MIND, MAXD; BGSET: pairs SID, TID, SDIST.
   subroutine read_pair(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: at, k, n
      logical :: ok

      associate (pair => bulk%pair(card%i))
         pair%line = card%line
         pair%is_glue = card%name == 'BGSET'
         call card%field('SID', pair%set)
         n = (card%n + 6)/8
         allocate (pair%regions(2, n), source=0)
         allocate (pair%mu(n), pair%reach(n), source=0.0_wp)
         n = 0
         do k = 2, card%n, 8
            if (card%text_at(k)//card%text_at(k + 1) == '') cycle
            n = n + 1
            at = k + merge(2, 4, pair%is_glue)
            call card%integer_at(k, 'SID', pair%regions(1, n), ok, bounds=at_least_1)
            call card%integer_at(k + 1, 'TID', pair%regions(2, n), ok, bounds=at_least_1)
            if (at > k + 2 .and. card%text_at(k + 2) /= '') call card%real_at(k + 2, 'FRIC', pair%mu(n), ok, not_negative)
            if (card%text_at(at) /= '') &
               call card%real_at(at, one_of(pair%is_glue, 'SDIST', 'MAXD'), pair%reach(n), ok, not_negative)
         end do
         if (n == 0) call card%error_at(2, 'SID1: blank, expected the number of a region')
         pair%regions = pair%regions(:, :n)
      end associate
   end subroutine read_pair

   !> BOLTFOR: the preload LOAD of bolts. BOLTSEQ: a line for each step, its order and the set of its preloads.
   subroutine read_preload(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: k, n
      logical :: ok

      associate (preload => bulk%preload(card%i))
         preload%line = card%line
         call card%field('SID', preload%set)
         if (card%name == 'BOLTFOR') then
            call card%field('LOAD', preload%force, positive)
            call card%list_ranges(3, 'B', 'a bolt number', preload%bolts)
            return
         end if
         n = (card%n - 1)/8
         allocate (preload%order(n), preload%sets(n), source=0)
         do k = 1, n
            call card%integer_at(8*k + 1, 'S_NO', preload%order(k), ok, bounds=at_least_1)
            call card%integer_at(8*k + 2, 'B_ID', preload%sets(k), ok, bounds=at_least_1)
         end do
         if (n == 0) call card%error_at(9, 'S_NO1: blank, expected the order of a step')
      end associate
   end subroutine read_preload

end module nx_cards
