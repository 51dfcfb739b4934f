!> The cards of supports: SPC, SPC1, SPCM, their sum SPCADD (MPCADD sums up equations likewise), and SPCD, which moves them.
module support_cards
   use bulk_data, only: bulk_data_type, displacement_card, set_sum_card, support_card
   use card_fields, only: card_fields_type
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_support, read_sum, read_displacement

contains

   !> SPC: one or two nodes held in the components C at the displacement D. SPC1: components C of the
   !! nodes G1, G2, ..., or G1 THRU G2. SPCM: components C of all nodes of the marked surface PID.
   subroutine read_support(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(displacement_card) :: moved(2)
      integer :: k, n

      if (card%name == 'SPC') then
         call read_moved(card, moved, n)
         do k = 1, n
            associate (this => moved(k))
               bulk%support(card%i + k - 1) = support_card(line=this%line, set=this%set, components=this%components, &
                  value=this%value, first=[this%node], last=[this%node], at=[this%field])
            end associate
         end do
         card%i = card%i + n - 1
         return
      end if
      associate (support => bulk%support(card%i))
         support%line = card%line
         call card%field('SID', support%set)
         call card%components('C', support%components)
         if (card%name == 'SPC1') then
            call card%list_ranges(3, 'G', 'a node number', support%id_ranges)
         else
            call card%field('PID', support%surface)
            call card%finish(support%line)
            allocate (support%first(0), support%last(0), support%at(0))
         end if
      end associate
   end subroutine read_support

   !> SPCADD: the supports of all sets S1, S2, ...; MPCADD: their equations.
   subroutine read_sum(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      if (card%name == 'SPCADD') then
         call add_up(card, 'a support set', bulk%support_sum(card%i))
      else
         call add_up(card, 'a set of equations', bulk%equation_sum(card%i))
      end if
   end subroutine read_sum

   !> The sets S1, S2, ... of a card, each the number of A_SET.
   subroutine add_up(card, a_set, total)
      type(card_fields_type), intent(inout) :: card
      character(*), intent(in)              :: a_set
      type(set_sum_card), intent(inout)     :: total
      integer :: k, set
      logical :: ok

      total%line = card%line
      call card%field('SID', total%set)
      call card%field('S1', set)
      total%sets = [set]
      total%at = [2]
      do k = 3, card%n
         if (card%text_at(k) == '') cycle
         call card%integer_at(k, 'S', 'the number of '//a_set, set, ok)
         if (ok .and. set < 1) call card%error_at(k, 'S: '''//integer_text(set)// &
                                                  ''' is out of range, expected the number of '//a_set//', 1 or more')
         total%sets = [total%sets, set]
         total%at = [total%at, k]
      end do
   end subroutine add_up

   !> SPCD: displacements of held components, in a load set: the total at the end of the stage, as for forces.
   subroutine read_displacement(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(displacement_card) :: moved(2)
      integer :: n

      call read_moved(card, moved, n)
      bulk%displacement(card%i:card%i + n - 1) = moved(:n)
      card%i = card%i + n - 1
   end subroutine read_displacement

   !> The fields of SPC and SPCD alike: N nodes, one or two.
   subroutine read_moved(card, moved, n)
      type(card_fields_type), intent(inout) :: card
      type(displacement_card), intent(out)  :: moved(2)
      integer, intent(out)                  :: n

      call card%field('SID', moved(1)%set)
      call card%field('G1', moved(1)%node)
      call card%components('C1', moved(1)%components)
      if (card%name == 'SPC') then
         call card%field('D1', moved(1)%value, default=0.0_wp)
      else
         call card%field('D1', moved(1)%value)
      end if
      call card%field('G2', moved(2)%node, default=0)
      call card%components('C2', moved(2)%components, default=0)
      call card%field('D2', moved(2)%value, default=0.0_wp)
      call card%finish(moved(1)%line)
      moved(2)%line = moved(1)%line
      moved(2)%set = moved(1)%set
      moved%field = [2, 5]
      n = merge(2, 1, card%given('G2'))
      if (any(card%given(['G2', 'C2', 'D2'])) .and. .not. all(card%given(['G2', 'C2']))) &
         call card%error('G2', 'node, components C2 and displacement D2 go together')
   end subroutine read_moved

end module support_cards
