!> The cards of temperatures: TEMP, TEMPD.
module temperature_cards
   use bulk_data, only: bulk_data_type, temperature_card
   use card_fields, only: card_values
   use card_reader, only: card_reader_type
   use field_rules, only: integer_field, real_field
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_temperature

contains

   !> TEMP: temperatures T of up to three nodes G. TEMPD: of all nodes that have none in set SID, up to four sets.
   subroutine read_temperature(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      character(1) :: k
      logical :: for_all
      integer :: field, first, i, n

      call cards%set_table([integer_field(['SID', 'G1 ']), real_field('T1'), integer_field('G2', default=0), &
         real_field('T2', default=0.0_wp), integer_field('G3', default=0), real_field('T3', default=0.0_wp)], 'TEMP')
      call cards%set_table([integer_field('SID1'), real_field('T1'), integer_field('SID2', default=0), &
         real_field('T2', default=0.0_wp), integer_field('SID3', default=0), real_field('T3', default=0.0_wp), &
         integer_field('SID4', default=0), real_field('T4', default=0.0_wp)], 'TEMPD')
      allocate (bulk%temperature(4*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         for_all = cards%card%name == 'TEMPD'
         first = merge(1, 2, for_all)
         do field = first, merge(7, 6, for_all), 2
            if (.not. any(values%given(field:field + 1))) cycle
            if (field > first .and. .not. all(values%given(field:field + 1))) then
               k = integer_text((field - first)/2 + 1)
               call cards%error(trim(merge('SID', 'G  ', for_all))//k, 'this and T'//k//' go together, one of them is blank')
               cycle
            end if
            n = n + 1
            bulk%temperature(n) = temperature_card(line=cards%line, set=values%integers(merge(field, 1, for_all)), &
               is_default=for_all, node=merge(0, values%integers(field), for_all), field=field, value=values%reals(field + 1))
         end do
      end do
      bulk%temperature = bulk%temperature(:n)
   end subroutine read_temperature

end module temperature_cards
