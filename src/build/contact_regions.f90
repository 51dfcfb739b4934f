!> The sides of regions of contact and glue, and of the sections of solid bolts, that cards of NX name by elements or nodes.
module contact_regions
   use card_fields, only: id_ranges
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions
   use elasticity, only: shell
   use element_build, only: marked_side
   use element_kinds, only: element_table
   use kinds, only: wp
   use load_data, only: bolt_card, region_card
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
      integer :: i

      if (deck%mesh_is_faulty()) return
      do i = 1, size(deck%bulk%region)
         if (deck%bulk%region(i)%surface > 0) call add_region(deck, mesh, deck%bulk%region(i), sides)
      end do
      do i = 1, size(deck%bulk%bolt)
         if (deck%bulk%bolt(i)%kind > 1) call add_section(deck, mesh, deck%bulk%bolt(i), sides)
      end do
   end subroutine add_regions

   !> The faces of the elements of a region: of shells, the free ones of solids, or those with three corners that the CARD gives.
   subroutine add_region(deck, mesh, card, sides)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh
      type(region_card), intent(in)  :: card
      type(marked_side), allocatable, intent(inout) :: sides(:)
      type(marked_side), allocatable :: added(:)
      integer :: corners(3), e, i, k, n, n_before, property, s
      logical :: is_meant

      allocate (added(16))
      n = 0
      do k = 1, size(card%ranges%first)
         associate (first => card%ranges%first(k), last => card%ranges%last(k))
            n_before = n
            e = 1
            if (.not. card%by_property) e = first_not_below(mesh%element_id, first)
            do e = e, mesh%n_elements
               if (.not. card%by_property .and. mesh%element_id(e) > last) exit
               property = mesh%element_property(e)
               if (property == 0) cycle ! reported already
               if (card%by_property .and. (mesh%properties(property)%id < first .or. mesh%properties(property)%id > last)) cycle
               if (mesh%properties(property)%state == shell) then
                  call append(added, n, new_side(card%line, card%surface, side_corners(mesh, e, 0), card%is_bottom))
                  cycle
               end if
               do s = 1, element_table(mesh%element_kind(e))%n_sides
                  if (allocated(card%corners)) then
                     corners = [(mesh%node_table%find(card%corners(i, k)), i = 1, 3)]
                     is_meant = all([(any(side_corners(mesh, e, s) == corners(i)), i = 1, 3)])
                  else
                     is_meant = solid_behind(mesh, e, s) == 0
                  end if
                  if (is_meant) call append(added, n, new_side(card%line, card%surface, side_corners(mesh, e, s), .false.))
               end do
            end do
            if (n == n_before .and. first == last) call deck%errors%add(card%line, integer_text(first)// &
               ' gives no face to region '//integer_text(card%id)// &
               '; expected shells, solids with free faces, or three corners of a face of a solid')
         end associate
      end do
      sides = [sides, added(:n)]
   end subroutine add_region

   !> The section of a solid bolt: the faces between solids whose corners are all among its nodes, or those between its elements on
   !! both sides of the plane through its node across its axis.
   subroutine add_section(deck, mesh, card, sides)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh
      type(bolt_card), intent(in)    :: card
      type(marked_side), allocatable, intent(inout) :: sides(:)
      type(marked_side), allocatable :: added(:)
      integer  :: e, half(mesh%n_elements), n, other, s ! half: below the plane -1, above it 1, of other elements 0
      logical  :: is_meant(mesh%n_nodes), ok
      real(wp) :: axes(3, 3)

      is_meant = in_ranges(card%parts, mesh%node_id)
      half = merge(1, 0, in_ranges(card%parts, mesh%element_id))
      if (card%kind == 3 .and. min(card%node, card%axis) == 0) return ! reported already
      if (card%kind == 3) then
         n = mesh%node_table%find(card%node)
         if (n == 0) call deck%field_error(card%line, 5, 'there is no GRID '//integer_text(card%node), called='GP')
         if (n == 0) return
         call find_directions(deck, mesh%systems, card%line, card%system, mesh%x(:, n), axes, ok, ['CSID', 'GP  '])
         do e = 1, mesh%n_elements
            associate (nodes => mesh%element_nodes(:element_table(mesh%element_kind(e))%n_corners, e))
               if (any(nodes <= 0)) return ! reported already
               if (dot_product(axes(:, card%axis), sum(mesh%x(:, nodes), dim=2)/size(nodes) - mesh%x(:, n)) < 0.0_wp) &
                  half(e) = -half(e)
            end associate
         end do
      end if
      allocate (added(16))
      n = 0
      do e = 1, mesh%n_elements
         if (element_table(mesh%element_kind(e))%dimension < mesh%dimension .or. (card%kind == 3 .and. half(e) >= 0)) cycle
         do s = 1, element_table(mesh%element_kind(e))%n_sides
            if (card%kind == 2) then
               if (.not. all(is_meant(side_corners(mesh, e, s)))) cycle
            end if
            other = solid_behind(mesh, e, s)
            if (other == 0 .or. (card%kind == 2 .and. other < e)) cycle
            if (card%kind == 3 .and. half(max(1, other)) <= 0) cycle
            call append(added, n, new_side(card%line, card%surface, side_corners(mesh, e, s), .false.))
         end do
      end do
      if (n == 0) call deck%errors%add(card%line, 'BOLT '//integer_text(card%id)//': no faces between solids lie in this section')
      sides = [sides, added(:n)]
   end subroutine add_section

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

   !> The solid, or plane element of a plane model, behind side S of element E, 0: none.
   pure integer function solid_behind(mesh, e, s) result(other)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e, s
      integer :: i, k

      associate (corners => side_corners(mesh, e, s))
         do i = mesh%first_at(corners(1)), mesh%first_at(corners(1) + 1) - 1
            other = mesh%elements_at(i)
            if (other == e .or. element_table(mesh%element_kind(other))%dimension < mesh%dimension) cycle
            if (all([(any(mesh%element_nodes(:, other) == corners(k)), k = 1, size(corners))])) return
         end do
      end associate
      other = 0
   end function solid_behind

   !> The side with CORNERS, or the same face seen from behind.
   pure type(marked_side) function new_side(line, surface, corners, reverse) result(side)
      integer, intent(in) :: line, surface, corners(:)
      logical, intent(in) :: reverse

      side%line = line
      side%property = surface
      side%corners = size(corners)
      side%n_nodes = size(corners)
      side%nodes(:size(corners)) = corners
      if (reverse) side%nodes(:size(corners)) = corners(size(corners):1:-1)
   end function new_side

   !> Append SIDE to ADDED(:N), which grows where it is full.
   pure subroutine append(added, n, side)
      type(marked_side), allocatable, intent(inout) :: added(:)
      integer, intent(inout)                        :: n
      type(marked_side), intent(in)                 :: side

      if (n == size(added)) added = [added, added]
      n = n + 1
      added(n) = side
   end subroutine append

end module contact_regions
