!> The cards of body elements: CQUAD4, CTRIA3, CHEXA, CPENTA, CTETRA. One routine, a table each. In a model of solids, faces of
!! marked surfaces are CQUAD4 and CTRIA3 too.
module element_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_values, decode_card
   use card_lines, only: card_type
   use deck_errors, only: deck_error_list
   use element_kinds, only: kind_hexa8, kind_penta6, kind_quad4, kind_tetra4, kind_tria3
   use field_rules, only: blank_field, field_rule, integer_field
   implicit none
   private

   public :: read_element

contains

   !> Read the element CARD of a KIND. THETA, ZOFFS and corner thicknesses of plates mean nothing to an isotropic membrane of one
   !! thickness, and must be blank; so must the midside nodes of solids.
   subroutine read_element(card, kind, bulk, values, errors)
      type(card_type), intent(in)          :: card
      integer, intent(in)                  :: kind !! of element_kinds
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: quad(:), tria(:), hexa(:), penta(:), tetra(:)
      integer :: n

      if (.not. allocated(quad)) then
         quad = [corners(4), blank_field('THETA'), blank_field('ZOFFS')]
         tria = [corners(3), blank_field('THETA'), blank_field('ZOFFS')]
         hexa = corners(8)
         penta = corners(6)
         tetra = corners(4)
      end if
      select case (kind)
      case (kind_quad4)
         call decode_card(card, quad, .false., values, errors)
         n = 4
      case (kind_tria3)
         call decode_card(card, tria, .false., values, errors)
         n = 3
      case (kind_hexa8)
         call decode_card(card, hexa, .false., values, errors)
         n = 8
      case (kind_penta6)
         call decode_card(card, penta, .false., values, errors)
         n = 6
      case default
         call decode_card(card, tetra, .false., values, errors)
         n = 4
      end select
      bulk%n_element = bulk%n_element + 1
      associate (element => bulk%element(bulk%n_element))
         element%line = card%line
         element%kind = kind
         element%id = values%integers(1)
         element%property = values%integers(2)
         element%nodes(:n) = values%integers(3:2 + n)
      end associate
   end subroutine read_element


   !> EID, PID and N corner nodes.
   pure function corners(n) result(table)
      integer, intent(in) :: n
      type(field_rule) :: table(n + 2)
      integer :: k

      table(1) = integer_field('EID')
      table(2) = integer_field('PID')
      do k = 1, n
         table(k + 2) = integer_field('G'//achar(iachar('0') + k))
      end do
   end function corners

end module element_cards
