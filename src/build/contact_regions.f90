!> The sides of regions of contact and glue, and of the sections of solid bolts, that cards of NX name by elements or nodes.
module contact_regions
   use bulk_data, only: bolt_card, region_card
   use card_fields, only: id_ranges
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions
   use elasticity, only: shell
   use element_build, only: marked_side
   use element_kinds, only: element_table
   use kinds, only: wp
   use lists, only: first_not_below
   use model_data, only: mesh_type
   use surface_sides, only: side_corners
   use text_tools, only: integer_text
   implicit none
   private

   public :: add_regions

contains

   !> Append to SIDES those of the regions and sections that became marked surfaces.
   subroutine add_regions(deck, mesh, sides)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh
      type(marked_side), allocatable, intent(inout) :: sides(:)
      type(marked_side), allocatable :: added(:)
      integer :: i, n

      allocate (added(16))
      n = 0
      do i = 1, size(deck%bulk%region)
         if (deck%bulk%region(i)%surface > 0) call add_region(deck%bulk%region(i))
      end do
      do i = 1, size(deck%bulk%bolt)
         if (deck%bulk%bolt(i)%kind > 1 .and. all(deck%bulk%bolt(:i - 1)%surface /= deck%bulk%bolt(i)%surface)) &
            call add_section(deck%bulk%bolt(i))
      end do
      if (n > 0) sides = [sides, added(:n)]

   contains

      subroutine add_region(card)
         type(region_card), intent(in) :: card
         integer :: corners(3), e, k, m, s
         logical :: is_meant

         do k = 1, size(card%ranges%first)
            associate (first => card%ranges%first(k), last => card%ranges%last(k))
               e = 1
               if (.not. card%by_property) e = first_not_below(mesh%element_id, first)
               m = n
               do while (e <= mesh%n_elements)
                  if (.not. card%by_property .and. mesh%element_id(e) > last) exit
                  if (mesh%element_property(e) > 0) then
                     associate (property => mesh%properties(mesh%element_property(e)))
                        is_meant = .not. card%by_property .or. (property%id >= first .and. property%id <= last)
                        if (is_meant .and. property%state == shell) then
                           call add(card%line, card%surface, side_corners(mesh, e, 0), card%is_bottom)
                        else if (is_meant .and. allocated(card%corners)) then
                           corners = [(mesh%node_table%find(card%corners(s, k)), s = 1, 3)]
                           do s = 1, element_table(mesh%element_kind(e))%n_sides
                              if (all([any(side_corners(mesh, e, s) == corners(1)), any(side_corners(mesh, e, s) == corners(2)), &
                                       any(side_corners(mesh, e, s) == corners(3))])) &
                                 call add(card%line, card%surface, side_corners(mesh, e, s), .false.)
                           end do
                        else if (is_meant) then
                           do s = 1, element_table(mesh%element_kind(e))%n_sides
                              if (behind(e, s) == 0) call add(card%line, card%surface, side_corners(mesh, e, s), .false.)
                           end do
                        end if
                     end associate
                  end if
                  e = e + 1
               end do
               if (n == m .and. (allocated(card%corners) .or. first == last)) call deck%field_error(card%line, card%ranges%at(k), &
                  integer_text(first)//' gives no face to this region; expected '//what_of(card), called='EID')
            end associate
         end do
      end subroutine add_region

      !> The section of a solid bolt: the faces whose corners are all among its nodes, or those between its elements on both sides of
      !! the plane through its node across its axis.
      subroutine add_section(card)
         type(bolt_card), intent(in) :: card
         real(wp) :: axes(3, 3), height(mesh%n_elements)
         integer  :: e, m, other, s
         logical  :: is_meant(max(mesh%n_nodes, mesh%n_elements)), ok

         m = n
         height = 0.0_wp
         if (card%kind == 2) then
            is_meant(:mesh%n_nodes) = in_ranges(card%parts, mesh%node_id)
         else
            is_meant(:mesh%n_elements) = in_ranges(card%parts, mesh%element_id)
            s = mesh%node_table%find(card%node)
            if (s == 0) then
               call deck%field_error(card%line, 5, 'there is no GRID '//integer_text(card%node), called='GP')
               return
            end if
            call find_directions(deck, mesh%systems, card%line, card%system, mesh%x(:, s), axes, ok, ['CSID', 'GP  '])
            do e = 1, mesh%n_elements
               associate (nodes => mesh%element_nodes(:element_table(mesh%element_kind(e))%n_corners, e))
                  if (is_meant(e) .and. all(nodes > 0)) height(e) = &
                     dot_product(axes(:, card%axis), sum(mesh%x(:, nodes), dim=2)/size(nodes) - mesh%x(:, s))
               end associate
            end do
         end if
         do e = 1, mesh%n_elements
            if (element_table(mesh%element_kind(e))%dimension < 3) cycle
            do s = 1, element_table(mesh%element_kind(e))%n_sides
               if (card%kind == 2) then
                  if (.not. all(is_meant(side_corners(mesh, e, s)))) cycle
               else if (.not. is_meant(e) .or. height(e) >= 0.0_wp) then
                  cycle
               end if
               other = behind(e, s)
               if (other == 0) cycle
               if (card%kind == 2 .and. other < e) cycle
               if (card%kind == 3) then
                  if (.not. is_meant(other) .or. height(other) < 0.0_wp) cycle
               end if
               call add(card%line, card%surface, side_corners(mesh, e, s), .false.)
            end do
         end do
         if (n == m) call deck%errors%add(card%line, 'BOLT '//integer_text(card%id)// &
                                          ': no faces between solids lie in this section')

      end subroutine add_section

      !> The solid behind side S of element E, 0: none.
      pure integer function behind(e, s) result(other)
         integer, intent(in) :: e, s
         integer :: i, k

         associate (corners => side_corners(mesh, e, s))
            do i = mesh%first_at(corners(1)), mesh%first_at(corners(1) + 1) - 1
               other = mesh%elements_at(i)
               if (other == e .or. element_table(mesh%element_kind(other))%dimension < 3) cycle
               if (all([(any(mesh%element_nodes(:, other) == corners(k)), k = 1, size(corners))])) return
            end do
         end associate
         other = 0
      end function behind

      !> Append the side with CORNERS, or the same face seen from behind.
      subroutine add(line, surface, corners, reverse)
         integer, intent(in) :: line, surface, corners(:)
         logical, intent(in) :: reverse
         type(marked_side) :: side

         if (any(corners <= 0)) return ! reported already
         side%line = line
         side%property = surface
         side%corners = size(corners)
         side%n_nodes = size(corners)
         side%nodes(:size(corners)) = corners
         if (reverse) side%nodes(:size(corners)) = corners(size(corners):1:-1)
         if (n == size(added)) added = [added, added]
         n = n + 1
         added(n) = side
      end subroutine add

   end subroutine add_regions

   !> Which of IDS are in RANGES.
   pure function in_ranges(ranges, ids) result(are_in)
      type(id_ranges), intent(in) :: ranges
      integer, intent(in)         :: ids(:)
      logical :: are_in(size(ids))
      integer :: i

      are_in = .false.
      do i = 1, size(ranges%first)
         are_in = are_in .or. (ids >= ranges%first(i) .and. ids <= ranges%last(i))
      end do
   end function in_ranges

   !> What the numbers of a region CARD name.
   pure function what_of(card) result(words)
      type(region_card), intent(in) :: card
      character(:), allocatable :: words

      words = 'elements with free faces'
      if (card%by_property) words = 'properties of elements with free faces'
      if (allocated(card%corners)) words = 'a solid and three corners of one of its faces'
   end function what_of

end module contact_regions
