!> Pretension sections of solid bolts: BOLT cards that name a marked surface inside a body, at which it is cut.
module pretension_section
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions
   use element_kinds, only: max_side_nodes
   use kinds, only: wp
   use load_data, only: bolt_card
   use model_data, only: mesh_type, section_type
   use node_build, only: append_unknowns
   use spring_build, only: add_tightening, find_thread
   use surface_build, only: find_surface, side_influence, surface_node_list, surface_nodes
   use surface_sides, only: elements_behind, list_sides, side_list, reverse_side
   use text_tools, only: integer_text
   use tolerances, only: in_section, parallel_in_mesh
   implicit none
   private

   public :: build_sections

contains

   !> Build the pretension sections of the model and append their nodes.
   subroutine build_sections(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      integer, allocatable :: behind(:)
      integer :: e, i, k, n, same

      n = count(deck%bulk%bolt%surface > 0)
      if (n == 0) return
      deallocate (mesh%sections)
      allocate (mesh%sections(n))
      mesh%node_section = spread(0, 1, mesh%n_nodes)
      mesh%element_section = spread(0, 1, mesh%n_elements)
      k = 0
      do i = 1, size(deck%bulk%bolt)
         if (deck%bulk%bolt(i)%surface <= 0) cycle
         same = findloc(mesh%sections(:k)%surface, deck%bulk%bolt(i)%surface, dim=1)
         if (same == 0) then
            k = k + 1
            same = k
            call build_section(deck, deck%bulk%bolt(i), k, mesh)
         end if
         associate (section => mesh%sections(same), card => deck%bulk%bolt(i))
            call add_tightening(deck, card, section%bolt, 'surface '//integer_text(section%surface), section%tightening)
            if (section%thread%size == '') call find_thread(deck, card, mesh, section%thread)
         end associate
      end do
      n = k
      mesh%sections = mesh%sections(:n)
      if (any(mesh%sections%point == 0)) return ! there are errors
      do k = 1, n ! the section nodes follow all others, with the elements behind the section
         behind = pack([(e, e = 1, mesh%n_elements)], mesh%element_section == k)
         call append_unknowns(mesh, [mesh%sections(k)%point], [size(behind)], behind)
         mesh%sections(k)%node = mesh%n_nodes
      end do
   end subroutine build_sections

   !> Section K from its CARD: its direction, and the elements behind it.
   subroutine build_section(deck, card, k, mesh)
      type(checked_deck), intent(in)  :: deck
      type(bolt_card), intent(in)     :: card
      integer, intent(in)             :: k
      type(mesh_type), intent(inout) :: mesh
      type(surface_node_list) :: list
      real(wp), allocatable   :: centroid(:)
      character(:), allocatable :: fault
      real(wp) :: extent
      integer  :: i, s

      mesh%sections(k)%bolt = card%id
      mesh%sections(k)%surface = card%surface
      call find_surface(deck, card%line, 'PMARK', card%surface, mesh, s)
      if (s == 0) return
      if (mesh%surfaces(s)%n == 0) return ! reported already
      fault = ''
      if (mesh%surfaces(s)%was_split) then
         fault = 'is split by a JOINT: a bolt is cut at a surface inside its body'
      else if (any(mesh%surfaces(s)%other(:mesh%surfaces(s)%n) == 0)) then
         fault = 'lies on the outside of a body: expected elements on both sides of it'
      else
         call orient_as_first_side(mesh, s, mesh%sections(k))
         if (mesh%sections(k)%area <= 0.0_wp) return ! a body without property: reported already
         if (card%axis > 0) call take_axis(deck, card, mesh, s, mesh%sections(k))
         mesh%sections(k)%strength = mesh%properties(mesh%element_property(mesh%surfaces(s)%element(1)))%strength
         call surface_nodes(mesh, mesh%surfaces(s), list)
         allocate (centroid, source=matmul(mesh%x(:, list%node), list%area)/sum(list%area))
         ! the surface must be plane, and in an axisymmetric model across the axis
         if (mesh%axisymmetric .and. abs(mesh%sections(k)%direction(1)) > parallel_in_mesh) then
            fault = 'is not across the axis: in an axisymmetric model a bolt is cut at a plane y = constant'
         else if (card%axis == 0) then ! along a given axis the sides of any surface overlap as those of a plane
            extent = maxval([(norm2(mesh%x(:, list%node(i)) - centroid), i = 1, list%n)])
            i = findloc([(abs(dot_product(mesh%x(:, list%node(i)) - centroid, mesh%sections(k)%direction)) > in_section*extent, &
                          i = 1, list%n)], .true., dim=1)
            if (i > 0) fault = 'is not plane: node '//integer_text(mesh%node_id(list%node(i)))//' lies out of its mean plane'
         end if
      end if
      if (fault == '') call find_elements_behind(mesh, s, k, fault)
      if (fault /= '') call deck%field_error(card%line, 'PMARK', 'surface '//integer_text(card%surface)//' '//fault)
   end subroutine build_section

   !> Reverse the sides of surface S that face against the first one; the mean normal gives direction and area of SECTION.
   pure subroutine orient_as_first_side(mesh, s, section)
      type(mesh_type), intent(inout) :: mesh
      integer, intent(in)               :: s
      type(section_type), intent(inout) :: section
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes), of_side(3), total(3)
      integer  :: i

      section%area = 0.0_wp
      total = 0.0_wp
      do i = 1, mesh%surfaces(s)%n
         call side_influence(mesh, mesh%surfaces(s), i, area, normal)
         of_side = sum(normal, dim=2)
         if (dot_product(of_side, total) < 0.0_wp) then
            call reverse_side(mesh%surfaces(s), i)
            of_side = -of_side
         end if
         total = total + of_side
         section%area = section%area + sum(area)
      end do
      section%direction = -total/max(norm2(total), tiny(1.0_wp))
   end subroutine orient_as_first_side

   !> The direction of SECTION at surface S is the axis that a CARD of NX gives, its area that across this axis.
   subroutine take_axis(deck, card, mesh, s, section)
      type(checked_deck), intent(in)    :: deck
      type(bolt_card), intent(in)       :: card
      type(mesh_type), intent(in)       :: mesh
      integer, intent(in)               :: s
      type(section_type), intent(inout) :: section
      real(wp) :: area(max_side_nodes), axes(3, 3), normal(3, max_side_nodes)
      integer  :: i
      logical  :: ok

      call find_directions(deck, mesh%systems, card%line, card%system, mesh%x(:, mesh%surfaces(s)%nodes(1, 1)), axes, ok, &
                           ['CSID', 'G   '])
      associate (axis => axes(:, card%axis))
         section%direction = sign(1.0_wp, dot_product(axis, section%direction))*axis
      end associate
      section%area = 0.0_wp
      do i = 1, mesh%surfaces(s)%n
         call side_influence(mesh, mesh%surfaces(s), i, area, normal)
         section%area = section%area - dot_product(section%direction, sum(normal, dim=2))
      end do
   end subroutine take_axis

   !> The elements behind section K, which is surface S: at each node the elements that are connected to the
   !! back of a side without crossing the surface.
   subroutine find_elements_behind(mesh, s, k, fault)
      type(mesh_type), intent(inout) :: mesh
      integer, intent(in)                    :: s, k
      character(:), allocatable, intent(out) :: fault !! empty: none
      type(side_list)      :: at
      integer, allocatable :: behind(:)
      integer :: i

      fault = ''
      call list_sides(mesh%surfaces(s), at)
      do i = 1, at%n
         associate (node => at%node(i))
            call elements_behind(mesh, s, at, i, behind)
            if (size(behind) == 0) then
               fault = 'ends inside the body at node '//integer_text(mesh%node_id(node))// &
                       ': expected a section that cuts the whole body'
            else if (mesh%node_section(node) > 0) then
               fault = 'meets the section of BOLT '//integer_text(mesh%sections(mesh%node_section(node))%bolt)// &
                       ' at node '//integer_text(mesh%node_id(node))
            else if (any(mesh%element_section(behind) > 0 .and. mesh%element_section(behind) /= k)) then
               fault = 'is within one element of the section of another BOLT, at node '//integer_text(mesh%node_id(node))
            end if
            if (fault /= '') return
            mesh%node_section(node) = k
            mesh%element_section(behind) = k
         end associate
      end do
      mesh%sections(k)%point = at%node(1)
   end subroutine find_elements_behind

end module pretension_section
