!> PLOAD4 and PLOADE: which side of which element a card presses on, and the nodal forces.
module pressed_sides
   use bulk_data, only: pressure_card
   use deck_check, only: checked_deck
   use element_kinds, only: element_table, kind_hexa8, kind_penta6, kind_tetra4, max_side_nodes
   use element_loads, only: side_forces
   use id_table, only: id_table_type
   use kinds, only: wp
   use model_data, only: corners_of, model_type
   use section_coupling, only: add_section_share
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_pressed_sides, add_pressure

   !> Where the pressure of a card acts: ELEMENT is 0 where the card is in error. FIRST is the position of G1 on the side.
   type, public :: pressed_side
      integer :: element = 0, side = 0, first = 0
   end type pressed_side

contains

   !> The sides that PLOAD4 and PLOADE cards press on.
   subroutine find_pressed_sides(deck, model, pressed)
      type(checked_deck), intent(in)               :: deck
      type(model_type), intent(in)                 :: model
      type(pressed_side), allocatable, intent(out) :: pressed(:)
      type(id_table_type) :: elements
      integer :: e, i

      allocate (pressed(size(deck%bulk%pressure)))
      if (size(pressed) == 0) return
      call elements%build(model%element_id)
      do i = 1, size(pressed)
         associate (card => deck%bulk%pressure(i))
            if (card%first == 0) cycle
            e = elements%find(card%first)
            if (e == 0) then
               call deck%field_error(card%line, 'EID', 'there is no body element '//integer_text(card%first))
            else if (element_table(model%element_kind(e))%dimension /= merge(3, 2, card%on_face)) then
               call deck%field_error(card%line, 'EID', 'element '//integer_text(card%first)//' is a '// &
                  trim(element_table(model%element_kind(e))%card)// &
                  trim(merge(': PLOAD4 is for faces of solids', ': PLOADE is for plane edges    ', card%on_face)))
            else if (any(corners_of(model, e) == 0)) then
               cycle ! said already
            else
               call find_side(deck, model, card, e, pressed(i))
            end if
         end associate
      end do
   end subroutine find_pressed_sides

   !> The side of element E that the CARD names by its corners.
   subroutine find_side(deck, model, card, e, pressed)
      type(checked_deck), intent(in)    :: deck
      type(model_type), intent(in)      :: model
      type(pressure_card), intent(in)   :: card
      integer, intent(in)               :: e
      type(pressed_side), intent(inout) :: pressed
      character(:), allocatable :: expected
      integer :: corner(2), k, side
      logical :: fits

      corner = 0
      do k = 1, 2
         if (card%corners(k) == 0) cycle
         corner(k) = own_corner(model, e, card%corners(k))
         if (corner(k) > 0) cycle
         call deck%field_error(card%line, trim(merge('G1 ', merge('G34', 'G2 ', card%on_face), k == 1)), 'node '// &
            integer_text(card%corners(k))//' is no corner of element '//integer_text(card%first))
         return
      end do
      if (corner(1) == 0) return ! said already
      associate (kind => element_table(model%element_kind(e)))
         do side = 1, kind%n_sides
            associate (own => kind%side_nodes(:kind%side_corners(side), side))
               if (all(own /= corner(1))) cycle
               select case (kind%linear)
               case (kind_tetra4)            ! G4 is the corner that the face does not have
                  fits = corner(2) > 0 .and. all(own /= corner(2))
               case (kind_hexa8, kind_penta6)
                  if (size(own) == 3) then
                     fits = corner(2) == 0
                  else                       ! G3 is opposite to G1
                     fits = own(modulo(findloc(own, corner(1), dim=1) + 1, 4) + 1) == corner(2)
                  end if
               case default
                  fits = any(own == corner(2)) .and. corner(1) /= corner(2)
               end select
               if (.not. fits) cycle
            end associate
            if (kind%side_corners(side) == 3 .and. abs(card%pressure(4) - card%pressure(1)) > 0.0_wp) then
               call deck%field_error(card%line, 'P4', 'a triangular face has no fourth corner, expected a blank or P1')
               return
            end if
            pressed%element = e
            pressed%side = side
            pressed%first = findloc(kind%side_nodes(:, side), corner(1), dim=1)
            return
         end do
      end associate
      select case (element_table(model%element_kind(e))%linear)
      case (kind_tetra4)
         expected = 'expected in G1 a corner of the face and in G4 the corner that it does not have'
      case (kind_hexa8)
         expected = 'expected in G1 and G3 two opposite corners of a face'
      case (kind_penta6)
         expected = 'expected two opposite corners of a quadrilateral face, or in G1 alone a corner of a triangular one'
      case default
         expected = 'expected the two ends of an edge'
      end select
      call deck%field_error(card%line, 'G1', 'no side of element '//integer_text(card%first)//' has these corners; '//expected)
   end subroutine find_side

   !> Which corner of element E node ID is, the twin of a split node too; 0: none.
   pure integer function own_corner(model, e, id) result(corner)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e, id
      integer :: node

      corner = 0
      node = model%node_table%find(id)
      if (node == 0) return
      associate (corners => model%element_nodes(:element_table(model%element_kind(e))%n_corners, e))
         corner = findloc(corners, node, dim=1)
         if (corner == 0 .and. model%twin(node) > 0) corner = findloc(corners, model%twin(node), dim=1)
      end associate
   end function own_corner

   !> Add to FORCE the nodal forces of a pressure on one side, P(1) to P(4) at its corners from G1 on, in the middle between two
   !! corners their mean.
   !! Errors: none. Source: side_forces.
   pure subroutine add_pressure(model, pressed, p, force)
      type(model_type), intent(in)   :: model
      type(pressed_side), intent(in) :: pressed
      real(wp), intent(in)           :: p(4)              !! [pressure], positive into the body
      real(wp), intent(inout)        :: force(:, :)       !! (3, n_nodes) [force]
      real(wp) :: f(model%dimension, max_side_nodes), at_nodes(max_side_nodes)

      associate (kind => element_table(model%element_kind(pressed%element)), e => pressed%element)
         associate (c => kind%side_corners(pressed%side))
            at_nodes(:c) = cshift(p(:c), 1 - pressed%first)
            at_nodes(c + 1:2*c) = 0.5_wp*(at_nodes(:c) + cshift(at_nodes(:c), 1))
         end associate
         associate (nodes => model%element_nodes(kind%side_nodes(:kind%side_size(pressed%side), pressed%side), e), &
                    property => model%properties(max(1, model%element_property(e))))
            call side_forces(property%state, property%thickness, model%x(:model%dimension, nodes), &
                             at_nodes(:size(nodes)), f)
            force(:model%dimension, nodes) = force(:model%dimension, nodes) + f(:, :size(nodes))
            call add_section_share(model, e, nodes, f, force)
         end associate
      end associate
   end subroutine add_pressure

end module pressed_sides
