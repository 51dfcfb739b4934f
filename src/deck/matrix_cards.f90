!> Reads the cards of matrices between nodes: DMIG, and ASET, ASET1, BSET, BSET1, QSET and QSET1.
module matrix_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_fields_type
   use field_rules, only: any_real
   use kinds, only: wp
   implicit none
   private

   public :: read_dmig, read_retained

contains

   !> DMIG: with GJ = 0 the header of matrix NAME, else terms of the column of component CJ of node GJ.
   subroutine read_dmig(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      integer :: column, component, k, node
      real(wp) :: value
      logical :: ok(3)

      associate (dmig => bulk%matrices%dmig(card%i))
         dmig%line = card%line
         dmig%name = card%text_at(1)
         if (dmig%name == '') call card%error_at(1, 'NAME: blank, expected the name of the matrix')
         call card%integer_at(2, 'GJ', column, ok(1), bounds=[0, huge(1)])
         if (.not. ok(1)) return
         if (column == 0) then ! the header
            call card%integer_at(3, 'IFO', dmig%form, ok(1), bounds=[1, 9])
            call card%integer_at(4, 'TIN', k, ok(2), bounds=[1, 4])
            if (all(ok(:2)) .and. all(dmig%form /= [1, 6])) call card%error_at(3, &
               'IFO: expected 6, a symmetric matrix, or 1, a square one; others are no stiffness or mass')
            if (all(ok(:2)) .and. k > 2) call card%error_at(4, 'TIN: expected 1 or 2, a real matrix')
            dmig%form = max(dmig%form, 1)
            return
         end if
         dmig%node = column
         call read_component(3, 'CJ', dmig%component, ok(1))
         allocate (dmig%nodes(0), dmig%components(0), dmig%at(0), dmig%values(0))
         do k = 5, card%n, 4
            if (card%text_at(k)//card%text_at(k + 1)//card%text_at(k + 2) == '') cycle
            call card%integer_at(k, 'G', node, ok(1), bounds=[1, huge(1)])
            call read_component(k + 1, 'C', component, ok(2))
            call card%real_at(k + 2, 'A', value, ok(3), any_real)
            if (.not. all(ok)) cycle
            dmig%nodes = [dmig%nodes, node]
            dmig%components = [dmig%components, component]
            dmig%at = [dmig%at, k]
            dmig%values = [dmig%values, value]
         end do
      end associate

   contains

      !> The component in data field K; blank and 0: an SPOINT.
      subroutine read_component(k, name, component, ok)
         integer, intent(in)      :: k
         character(*), intent(in) :: name
         integer, intent(out)     :: component
         logical, intent(out)     :: ok

         component = 0
         ok = card%text_at(k) == ''
         if (.not. ok) call card%integer_at(k, name, component, ok, bounds=[0, 6])
      end subroutine read_component

   end subroutine read_dmig

   !> ASET, BSET, QSET: up to four nodes with their components. ASET1, BSET1, QSET1: components of a list of nodes.
   subroutine read_retained(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(2) :: name(2)
      integer :: components, k, n, node

      if (index(card%name, '1') > 0) then
         associate (retained => bulk%matrices%retained(card%i))
            retained%line = card%line
            retained%of_modes = card%name(:1) == 'Q'
            call card%components('C', retained%components, default=0)
            call card%list_ranges(2, 'G', 'a node number', retained%nodes)
         end associate
         return
      end if
      n = 0
      do k = 1, 4
         write (name, '(a, i1)') 'G', k, 'C', k
         if (k == 1) call card%field(name(1), node)
         if (k > 1) call card%field(name(1), node, default=0)
         call card%components(name(2), components, default=0)
         if (node == 0) cycle
         associate (retained => bulk%matrices%retained(card%i + n))
            retained%line = card%line
            retained%of_modes = card%name(:1) == 'Q'
            retained%components = components
            retained%nodes%first = [node]
            retained%nodes%last = [node]
            retained%nodes%at = [2*k - 1]
         end associate
         n = n + 1
      end do
      call card%must_be_blank(9, card%n, '')
      card%i = card%i + max(n, 1) - 1
   end subroutine read_retained

end module matrix_cards
