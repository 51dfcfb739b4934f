!> Which nodes of the two sides of a joint face each other.
module facing_nodes
   use id_table, only: id_table_type
   use kinds, only: wp
   use model_data, only: model_type, surface_type
   use position_search, only: position_search_type
   use surface_build, only: surface_node_list
   use text_tools, only: integer_text, plural, real_text
   implicit none
   private

   public :: pair_nodes

   real(wp), parameter :: default_tolerance = 1.0e-3_wp ! of the shortest edge of SIDE1
   real(wp), parameter, public :: facing = -0.5_wp      !! cosine of the normals of two sides that face each other, at most

   !> Why there are no pairs: the field of the JOINT card and what is wrong; no words: there are.
   type, public :: pairing_fault
      logical :: in_tolerance = .false.                 !! TOL may be wrong, else SIDE2
      character(:), allocatable :: words
   end type pairing_fault

contains

   !> For every node of side 1 the node of side 2 at the same place.
   subroutine pair_nodes(model, surface, side1, side2, tol, partner, fault)
      type(model_type), intent(in)        :: model
      integer, intent(in)                 :: surface(2)   !! of the model
      type(surface_node_list), intent(in) :: side1, side2 !! their nodes
      real(wp), intent(in)                :: tol          !! 0: the default [length]
      integer, intent(inout)              :: partner(:)
      type(pairing_fault), intent(out)    :: fault
      type(position_search_type) :: search
      real(wp) :: tolerance, distance, worst
      integer  :: k, found, lonely, shared, turned, worst_node
      logical, allocatable :: taken(:)
      character(:), allocatable :: place

      fault%words = ''
      tolerance = merge(tol, default_tolerance*shortest_edge(model, model%surfaces(surface(1))), tol > 0.0_wp)
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
         fault%words = 'the sides do not face each other node by node: '//plural(lonely, 'node')//' of '// &
            integer_text(side1%n)//' of SIDE1 found no partner within '//real_text(tolerance)//'; the farthest is node '// &
            integer_text(model%node_id(worst_node))//' at '//place//real_text(worst)//' away'
      else if (shared > 0) then
         fault%in_tolerance = .true.
         fault%words = 'within '//real_text(tolerance)//' '//plural(shared, 'node')// &
                       ' of SIDE1 found a partner that another one has'
      else if (turned > 0) then
         fault%words = 'the sides do not face each other: at '//plural(turned, 'node')// &
            ' their normals do not point against each other'
      else if (side2%n /= side1%n) then
         fault%words = 'SIDE2 has '//plural(side2%n, 'node')//', SIDE1 '//integer_text(side1%n)//': every node needs its partner'
      else if (.not. same_order(model, surface, side1, partner)) then
         fault%words = 'nodes at the middle of edges face corners: one side is of second order, the other is not'
      end if
   end subroutine pair_nodes

   !> Length of the shortest edge of SURFACE, between neighbouring nodes.
   pure real(wp) function shortest_edge(model, surface) result(shortest)
      type(model_type), intent(in)   :: model
      type(surface_type), intent(in) :: surface
      integer :: e, k

      shortest = huge(1.0_wp)
      do e = 1, surface%n
         associate (n => surface%corners(e))
            do k = 1, n
               shortest = min(shortest, norm2(model%x(:, surface%nodes(modulo(k, n) + 1, e)) - model%x(:, surface%nodes(k, e))))
            end do
         end associate
      end do
   end function shortest_edge

   !> Whether corners have corners for partners, and nodes between corners such nodes.
   pure logical function same_order(model, surface, side1, partner)
      type(model_type), intent(in)        :: model
      integer, intent(in)                 :: surface(2)
      type(surface_node_list), intent(in) :: side1
      integer, intent(in)                 :: partner(:) !! of its nodes, each another one
      type(id_table_type) :: between(2)
      integer :: k

      do k = 1, 2
         call between(k)%build(nodes_between(model%surfaces(surface(k))))
      end do
      same_order = all([(between(1)%find(side1%node(k)) > 0 .eqv. between(2)%find(partner(k)) > 0, k = 1, side1%n)])
   end function same_order

   !> The nodes of SURFACE that are no corners, as often as they have sides.
   pure function nodes_between(surface) result(nodes)
      type(surface_type), intent(in) :: surface
      integer, allocatable :: nodes(:)
      integer :: k

      nodes = [(surface%nodes(surface%corners(k) + 1:surface%n_nodes(k), k), k = 1, surface%n)]
   end function nodes_between

end module facing_nodes
