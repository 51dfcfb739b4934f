!> The interface elements of a JOINT card: between two sides that match, by pairs of nodes; between sides that do not, by lists of
!! nodes; between a surface and its twin or a rigid base.
module joint_sides
   use bulk_data, only: fit_no, fit_yes
   use deck_check, only: checked_deck
   use face_fit, only: face_part
   use face_shares, only: whole_shares
   use facing_nodes, only: pair_nodes, pairing_fault
   use id_table, only: id_table_type
   use interface_axes, only: joint_axes
   use interface_operator, only: hang_on, interface_element
   use interface_sums, only: interface_sums_type
   use kinds, only: wp
   use model_data, only: model_type, surface_type
   use position_search, only: position_search_type
   use side_fit, only: fit_side, side_cover
   use surface_build, only: side_influence, side_name, surface_node_list, surface_nodes
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: join_one_side, join_two_sides

contains

   !> The elements between a surface and its twin, where it was split, or a rigid base.
   subroutine join_one_side(deck, j, model, surface, side, elements)
      type(checked_deck), intent(in)                       :: deck
      integer, intent(in)                                  :: j, surface
      type(model_type), intent(in)                         :: model
      type(surface_node_list), intent(inout)               :: side
      type(interface_element), allocatable, intent(inout)  :: elements(:)

      if (any(model%twin(side%node) > 0)) call drop_tips(model, side)
      call pair_elements(deck, j, model, model%surfaces(surface), side, model%twin(side%node), elements)
   end subroutine join_one_side

   !> The elements between two sides: pairs where every node has its partner and the card does not ask for a fit.
   subroutine join_two_sides(deck, j, model, surface, side1, elements)
      type(checked_deck), intent(in)                       :: deck
      integer, intent(in)                                  :: j, surface(2)
      type(model_type), intent(inout)                      :: model
      type(surface_node_list), intent(in)                  :: side1
      type(interface_element), allocatable, intent(inout)  :: elements(:)
      type(surface_node_list) :: side2
      type(pairing_fault)     :: fault
      integer :: partner(side1%n)

      associate (card => deck%bulk%joint(j))
         fault%words = 'a fit is asked for'
         if (card%fit /= fit_yes) then
            call surface_nodes(model, model%surfaces(surface(2)), side2)
            partner = 0
            call pair_nodes(model, surface, side1, side2, card%tolerance, partner, fault)
         end if
         if (fault%words == '') then
            call pair_elements(deck, j, model, model%surfaces(surface(1)), side1, partner, elements)
         else if (card%fit == fit_no) then
            fault%words = fault%words//'; FIT = AUTO joins faces that do not match'
            if (fault%in_tolerance) then
               call deck%field_error(card%line, trim(merge('TOL  ', 'SIDE2', card%tolerance > 0.0_wp)), fault%words, called='TOL')
            else
               call deck%field_error(card%line, 'SIDE2', fault%words)
            end if
         else
            call fitted_elements(deck, j, model, surface, side1, elements)
         end if
      end associate
   end subroutine join_two_sides

   !> Leave out the nodes at which a split surface ends inside a body.
   pure subroutine drop_tips(model, side)
      type(model_type), intent(in)           :: model
      type(surface_node_list), intent(inout) :: side
      integer, allocatable :: kept(:)
      integer :: k

      kept = pack([(k, k = 1, side%n)], model%twin(side%node) > 0)
      side%n = size(kept)
      side%node = side%node(kept)
      side%area = side%area(kept)
      side%normal = side%normal(:, kept)
   end subroutine drop_tips

   !> Elements between the nodes of SIDE and their partners, 0: a rigid base. Faces with mid-side nodes have theirs between these
   !! alone, which hang on the corners too.
   subroutine pair_elements(deck, j, model, surface, side, partner, elements)
      type(checked_deck), intent(in)                      :: deck
      integer, intent(in)                                 :: j
      type(model_type), intent(in)                        :: model
      type(surface_type), intent(in)                      :: surface
      type(surface_node_list), intent(in)                 :: side
      integer, intent(in)                                 :: partner(:) !! (nodes of SIDE)
      type(interface_element), allocatable, intent(inout) :: elements(:)
      type(interface_sums_type) :: sums
      integer :: k

      if (any(surface%corners(:surface%n) < surface%n_nodes(:surface%n))) then
         call add_pairs(model, surface, side, partner, sums)
         call summed_elements(deck, j, model, side, sums, spread(.false., 1, side%n), elements)
         return
      end if
      if (model%axisymmetric .and. any(side%area <= 0.0_wp)) then
         call no_area(deck, j, model, side%node(minloc(side%area, dim=1)), ': it lies on the axis')
         return
      end if
      deallocate (elements)
      allocate (elements(side%n))
      do k = 1, side%n
         call hang_on(elements(k), side%node(k), partner(k))
         elements(k)%area = side%area(k)
         elements(k)%axes = joint_axes(model, side%normal(:, k))
      end do
   end subroutine pair_elements

   !> SUMS over the faces of SURFACE, every node opposite its partner. What has none, at the tip of a split surface, is its own.
   subroutine add_pairs(model, surface, side, partner, sums)
      type(model_type), intent(in)             :: model
      type(surface_type), intent(in)           :: surface
      type(surface_node_list), intent(in)      :: side
      integer, intent(in)                      :: partner(:)
      type(interface_sums_type), intent(inout) :: sums
      type(id_table_type) :: place
      type(face_part)     :: part
      integer :: elements(size(part%area)), opposite(size(part%area)), k, n, s
      real(wp) :: area(size(part%area)), normal(3, size(part%area)), share(size(part%area), size(part%area))

      call place%build(side%node)
      call sums%start(side%n, model%n_nodes)
      do s = 1, surface%n
         n = surface%n_nodes(s)
         call side_influence(model, surface, s, area, normal)
         share = whole_shares(model%dimension, n)
         part%n = n
         do k = 1, n
            part%own(:, k) = share(:, k)*area(k)
            elements(k) = place%find(surface%nodes(k, s))
            opposite(k) = surface%nodes(k, s)
            if (elements(k) > 0) opposite(k) = partner(elements(k))
         end do
         part%opposite = part%own
         part%area = matmul(share, area)
         part%normal = matmul(normal, transpose(share))
         if (any(partner > 0)) then
            call sums%add_face(elements(:n), surface%nodes(:n, s), opposite(:n), part)
         else
            call sums%add_face(elements(:n), surface%nodes(:n, s), opposite(:0), part)
         end if
      end do
      call sums%finish()
   end subroutine add_pairs

   !> Elements of faces that do not match; how well they cover each other goes to joint J of MODEL.
   subroutine fitted_elements(deck, j, model, surface, side1, elements)
      type(checked_deck), intent(in)                      :: deck
      integer, intent(in)                                 :: j, surface(2)
      type(model_type), intent(inout)                     :: model
      type(surface_node_list), intent(in)                 :: side1
      type(interface_element), allocatable, intent(inout) :: elements(:)
      type(interface_sums_type) :: sums
      type(side_cover)          :: found

      associate (card => deck%bulk%joint(j), own => model%surfaces(surface(1)))
         call fit_side(model, own, model%surfaces(surface(2)), side1, card%tolerance, sums, found)
         if (.not. found%is_any) then
            call deck%field_error(card%line, 'SIDE2', 'surface '//integer_text(card%sides(2))//' covers nothing of SIDE1: no '// &
               'face of it looks at one of SIDE1 within '//real_text(found%reach)//' along the normal; the nearest nodes are '// &
               real_text(nearest_nodes(model, surface))//' apart. Mark the sides that face each other, or '// &
               'give a larger TOL')
         else if (found%double > 0) then
            call deck%field_error(card%line, 'SIDE2', 'faces of surface '//integer_text(card%sides(2))//' lie behind one '// &
               'another, and cover the '//side_name(model, own%nodes(:own%corners(found%double), found%double))//' of SIDE1 '// &
               real_text(found%double_share)//' times: mark the nearer ones alone, or give a TOL below their distance')
         else
            model%joints(j)%cover = found%cover
            call summed_elements(deck, j, model, side1, sums, found%partly, elements)
         end if
      end associate
   end subroutine fitted_elements

   !> The shortest distance between a node of one surface and one of the other [length].
   pure real(wp) function nearest_nodes(model, surface) result(shortest)
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: surface(2) !! of MODEL
      type(position_search_type) :: search
      real(wp) :: distance
      integer  :: found, k

      shortest = huge(1.0_wp)
      call search%build(model%x(:, nodes_of(model%surfaces(surface(2)))))
      associate (nodes => nodes_of(model%surfaces(surface(1))))
         do k = 1, size(nodes)
            call search%nearest(model%x(:, nodes(k)), shortest, found, distance)
            shortest = min(shortest, distance)
         end do
      end associate
   end function nearest_nodes

   !> The elements that SUMS has at the nodes of SIDE, in their order.
   subroutine summed_elements(deck, j, model, side, sums, may_lack, elements)
      type(checked_deck), intent(in)                      :: deck
      integer, intent(in)                                 :: j
      type(model_type), intent(in)                        :: model
      type(surface_node_list), intent(in)                 :: side
      type(interface_sums_type), intent(in)               :: sums
      logical, intent(in)                                 :: may_lack(:) !! whether the area at a node may be 0, as on the axis
      type(interface_element), allocatable, intent(inout) :: elements(:)
      integer, allocatable :: at(:)
      integer  :: k
      real(wp) :: normal(3)

      at = pack([(k, k = 1, side%n)], [(sums%around(k) > 0.0_wp, k = 1, side%n)])
      do k = 1, size(at)
         associate (i => at(k))
            if (sums%has_area(i) .or. (sums%has_none(i) .and. (may_lack(i) .or. model%axisymmetric))) cycle
            call no_area(deck, j, model, side%node(i), ', or less than none: move the nodes at the middle of edges back there')
            return
         end associate
      end do
      at = pack(at, sums%has_area(at))
      deallocate (elements)
      allocate (elements(size(at)))
      do k = 1, size(at)
         call sums%hang(at(k), elements(k))
         elements(k)%named = side%node(at(k))
         normal = sums%normal(:, at(k))
         elements(k)%axes = joint_axes(model, normal/max(norm2(normal), tiny(1.0_wp)))
      end do
   end subroutine summed_elements

   !> SIDE1 of JOINT card J has no area at NODE.
   subroutine no_area(deck, j, model, node, words)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: j, node
      type(model_type), intent(in)   :: model
      character(*), intent(in)       :: words

      call deck%errors%add(deck%bulk%joint(j)%line, 'surface '//integer_text(deck%bulk%joint(j)%sides(1))// &
                           ' has no area at node '//integer_text(model%node_id(node))//words)
   end subroutine no_area

end module joint_sides
