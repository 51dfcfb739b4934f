!> Numbers given twice, and laws of joints whose parts are missing.
module id_checks
   use deck_check, only: checked_deck
   use id_table, only: id_table_type, sorted_order
   use text_tools, only: integer_text
   implicit none
   private

   public :: check_ids, report_repeated

contains

   !> Every id of its kind once among the cards that are few; properties and PMARK share theirs, as properties do in NASTRAN.
   subroutine check_ids(deck)
      type(checked_deck), intent(in) :: deck
      integer :: direction, i

      associate (bulk => deck%bulk)
         call report_repeated(deck, 'property', [bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, bulk%pmark%id], &
                              [bulk%pshell%line, bulk%paxis%line, bulk%psolid%line, bulk%prod%line, bulk%pmark%line])
         call report_repeated(deck, 'MAT1', bulk%mat1%id, bulk%mat1%line)
         call report_repeated(deck, 'LOAD', bulk%load%set, bulk%load%line)
         call report_repeated(deck, 'BLOCK2', bulk%block2%id, bulk%block2%line)
         call report_repeated(deck, 'BLOCK3', bulk%block3%id, bulk%block3%line)
         call report_repeated(deck, 'BOLT', bulk%bolt%id, bulk%bolt%line)
         call report_repeated(deck, 'JOINT', bulk%joint%id, bulk%joint%line)
         call report_repeated(deck, 'PJOINT', bulk%pjoint%id, bulk%pjoint%line)
         call report_repeated(deck, 'JNORM', bulk%jnorm%id, bulk%jnorm%line)
         call report_repeated(deck, 'JSHEAR', bulk%jshear%id, bulk%jshear%line)
         call report_repeated(deck, 'JINCR', bulk%jincr%id, bulk%jincr%line)
         do i = 1, size(bulk%pjoint)
            associate (card => bulk%pjoint(i))
               do direction = 1, 2
                  if (card%shear_laws(direction) == 0 .or. any(bulk%jshear%id == card%shear_laws(direction))) cycle
                  call deck%field_error(card%line, merge('SIDX', 'SIDY', direction == 1), 'there is no JSHEAR '// &
                                        integer_text(card%shear_laws(direction)))
               end do
               if (card%normal_law == 0 .or. any(bulk%jnorm%id == card%normal_law)) cycle
               call deck%field_error(card%line, 'NID', 'there is no JNORM '//integer_text(card%normal_law))
            end associate
         end do
      end associate
   end subroutine check_ids


   !> Say which of the numbers ID(n), given on the cards of LINE(n), are given twice; a card that gives many is named once.
   subroutine report_repeated(deck, noun, id, line, n_cards)
      type(checked_deck), intent(in) :: deck
      character(*), intent(in)       :: noun    !! what they are the numbers of
      integer, intent(in)            :: id(:), line(:)
      integer, intent(in), optional  :: n_cards !! the first so many are given one by one, in data field 1 of their cards, the
                                                      !! others by blocks, nodes from N1 and elements from E1 on; left out: all
      type(id_table_type)  :: table
      integer, allocatable :: again(:), order(:)
      integer :: k, last
      logical :: by_block
      character(:), allocatable :: words

      call table%build(id)
      call table%list_repeated(again)
      call sorted_order(line(again), order)
      last = 0
      do while (last < size(again))
         k = last + 1
         last = k
         do while (last < size(again))
            if (line(again(order(last + 1))) /= line(again(order(k)))) exit
            last = last + 1
         end do
         associate (this => again(order(k)))
            if (id(this) == 0) cycle ! a field that could not be read
            words = noun//' '//integer_text(id(this))
            if (last > k) words = words//', and more of this card,'
            words = words//' is given twice, first in '//deck%text%place(line(table%find(id(this))))
            by_block = .false.
            if (present(n_cards)) by_block = this > n_cards
            if (by_block) then
               call deck%field_error(line(this), merge('N1', 'E1', noun == 'node'), words)
            else
               call deck%field_error(line(this), 1, words)
            end if
         end associate
      end do
   end subroutine report_repeated

end module id_checks
