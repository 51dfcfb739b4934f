!> The cards of coordinate systems: CORD1R, CORD1C, CORD1S by three nodes, CORD2R, CORD2C, CORD2S by three points; GRDSET, the
!! defaults of GRID.
module system_cards
   use bulk_data, only: bulk_data_type, grid_defaults_card, system_card
   use card_fields, only: card_values
   use card_reader, only: card_reader_type
   use field_rules, only: any_field, blank_field, component_field, integer_field, real_field
   use kinds, only: wp
   implicit none
   private

   public :: read_system, read_grid_defaults, fill_grid_defaults

   character(6), parameter, public :: system_names(6) = ['CORD1R', 'CORD1C', 'CORD1S', 'CORD2R', 'CORD2C', 'CORD2S']

contains

   !> CORD1: one or two systems, each by its origin, a node on its z and one in its x-z plane. CORD2: the same by coordinates in
   !! system RID.
   subroutine read_system(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: first, i, kind, n

      do kind = 1, 3
         call cards%set_table([integer_field(['CIDA', 'G1A ', 'G2A ', 'G3A ']), &
                               integer_field(['CIDB', 'G1B ', 'G2B ', 'G3B '], default=0)], system_names(kind))
         call cards%set_table([integer_field('CID'), integer_field('RID', default=0, least=0), &
            real_field(['A1', 'A2', 'A3', 'B1', 'B2', 'B3', 'C1', 'C2', 'C3'], default=0.0_wp)], system_names(kind + 3))
      end do
      allocate (bulk%system(2*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         kind = findloc(system_names, cards%card%name(:6), dim=1)
         if (kind > 3) then
            n = n + 1
            bulk%system(n) = system_card(line=cards%line, id=values%integers(1), kind=kind - 3, reference=values%integers(2), &
                                         points=reshape(values%reals(3:11), [3, 3]))
         else
            if (any(values%given(5:8)) .and. .not. all(values%given(5:8))) &
               call cards%error('CIDB', 'a second system needs CIDB, G1B, G2B and G3B, all four')
            do first = 1, merge(5, 1, all(values%given(5:8))), 4
               n = n + 1
               bulk%system(n) = system_card(line=cards%line, id=values%integers(first), kind=kind, &
                                            field=first, nodes=values%integers(first + 1:first + 3))
            end do
         end if
      end do
      bulk%system = bulk%system(:n)
   end subroutine read_system

   !> GRDSET: what GRID has where its CP, CD and PS are blank; there is one at most.
   subroutine read_grid_defaults(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([any_field('-'), integer_field('CP', default=0, least=0), blank_field(['-', '-', '-']), &
         integer_field('CD', default=0, least=0), component_field('PS', default=0), blank_field('SEID')])
      do i = 1, cards%n
         call cards%next(values)
         if (i > 1) call cards%errors%add(cards%line, 'GRDSET: a second one; expected one at most in a deck')
         bulk%grid_defaults = grid_defaults_card(line=cards%line, cp=values%integers(2), cd=values%integers(6), &
                                                 ps=values%integers(7))
      end do
   end subroutine read_grid_defaults

   !> Fill the blank fields CP, CD and PS of all GRID cards from GRDSET.
   pure subroutine fill_grid_defaults(bulk)
      type(bulk_data_type), intent(inout) :: bulk

      associate (defaults => bulk%grid_defaults, grid => bulk%grid)
         where (grid%cp < 0) grid%cp = defaults%cp
         where (grid%cd < 0) grid%cd = defaults%cd
         where (grid%ps == 0) grid%ps = defaults%ps
      end associate
   end subroutine fill_grid_defaults

end module system_cards
