!> Which nodes of the two sides of a joint face each other.
module facing_nodes
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type
   use position_search, only: position_search_type
   use surface_build, only: surface_node_list
   use text_tools, only: integer_text, plural, real_text
   implicit none
   private

   public :: pair_nodes

   real(wp), parameter :: default_tolerance = 1.0e-3_wp ! of the shortest edge of SIDE1
   real(wp), parameter :: facing = -0.5_wp              ! cosine of the normals of two sides that face each other, at most

contains

   !> For every node of side 1 the node of side 2 at the same place.
   subroutine pair_nodes(deck, j, model, surface, side1, side2, partner)
      type(checked_deck), intent(in)      :: deck
      integer, intent(in)                 :: j, surface
      type(model_type), intent(in)        :: model
      type(surface_node_list), intent(in) :: side1, side2
      integer, intent(inout)              :: partner(:)
      type(position_search_type) :: search
      real(wp) :: tolerance, distance, shortest, worst
      integer  :: k, found, lonely, shared, turned, worst_node, e
      logical, allocatable :: taken(:)
      character(:), allocatable :: place

      associate (card => deck%bulk%joint(j), edges => model%surfaces(surface))
         shortest = huge(1.0_wp)
         do e = 1, edges%n
            do k = 1, edges%n_corners(e)
               shortest = min(shortest, norm2(model%x(:, edges%nodes(modulo(k, edges%n_corners(e)) + 1, e)) &
                                              - model%x(:, edges%nodes(k, e))))
            end do
         end do
         tolerance = card%tolerance
         if (tolerance <= 0.0_wp) tolerance = default_tolerance*shortest
         call search%build(model%x(:, side2%node))
         allocate (taken(side2%n), source=.false.)
         lonely = 0; turned = 0; shared = 0; worst = 0.0_wp; worst_node = 0
         do k = 1, side1%n
            call search%nearest(model%x(:, side1%node(k)), tolerance, found, distance)
            if (found == 0) then
               lonely = lonely + 1
               call search%nearest(model%x(:, side1%node(k)), huge(1.0_wp), found, distance)
               if (distance > worst) then
                  worst = distance
                  worst_node = side1%node(k)
               end if
            else
               partner(k) = side2%node(found)
               if (taken(found)) shared = shared + 1
               taken(found) = .true.
               if (dot_product(side1%normal(:, k), side2%normal(:, found)) > facing) turned = turned + 1
            end if
         end do
         if (lonely > 0) then
            place = ''
            do k = 1, model%dimension
               place = place//real_text(model%x(k, worst_node))//', '
            end do
            call deck%field_error(card%line, 'SIDE2', 'the sides do not face each other node by node: '// &
               plural(lonely, 'node')//' of '//integer_text(side1%n)//' of SIDE1 found no partner within '// &
               real_text(tolerance)//'; the farthest is node '//integer_text(model%node_id(worst_node))//' at '// &
               place//real_text(worst)//' away')
         else if (shared > 0) then
            call deck%field_error(card%line, trim(merge('TOL  ', 'SIDE2', card%tolerance > 0.0_wp)), 'within '// &
               real_text(tolerance)//' '//plural(shared, 'node')//' of SIDE1 found a partner that another one has', &
               called='TOL')
         else if (turned > 0) then
            call deck%field_error(card%line, 'SIDE2', 'the sides do not face each other: at '//plural(turned, 'node')// &
                                  ' their normals do not point against each other')
         else if (side2%n /= side1%n) then
            call deck%field_error(card%line, 'SIDE2', 'SIDE2 has '//plural(side2%n, 'node')//', SIDE1 '// &
                                  integer_text(side1%n)//': every node needs its partner')
         end if
      end associate
   end subroutine pair_nodes

end module facing_nodes
