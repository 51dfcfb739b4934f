!> The bolts of a model, bars or solids: their axes, the joints that they cross and what is clamped around them, the planes of
!! symmetry that cut them; the bending of solid bolts.
module bolt_places
   use analysis_state, only: analysis_type
   use body_elements, only: element_stiffness, element_thermal_forces
   use bolt_threads, only: thread_type
   use element_kinds, only: max_nodes, max_section_dofs
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use mesh_queries, only: element_points, n_points
   use model_data, only: model_type, n_bars, n_sections, section_type, temperature_type, tightening_type
   use node_coupling, only: corner_displacements
   use numbers, only: cross, first_largest
   use passing_forces, only: cut_passages, passage_type, start_passages
   use surface_build, only: surface_node_list, surface_nodes
   use symmetry_planes, only: cut_type, free_part, onto_planes, planes_through, symmetry_plane
   use tolerances, only: beside_bolt, parallel_in_mesh, symmetric_tie
   implicit none
   private

   public :: find_places, bending_moment, bolt_directions, find_clamping

   real(wp), parameter :: about_as_near = 0.45_wp ! of the bolt's length: own joint farther than the nearest one by this

   !> The data of a bolt that do not change.
   type, public :: bolt_place
      integer  :: id = 0                  !! of its BOLT card
      integer  :: bar = 0, section = 0    !! position of its bar or of its pretension section: one of them is 0
      type(tightening_type) :: tightening
      integer  :: joint = 0               !! position of the joint that it crosses, the largest of several; 0: none
      real(wp) :: point(3) = 0.0_wp       !! on its axis [length]
      real(wp) :: direction(3) = 0.0_wp   !! along it, unit
      real(wp) :: area = 0.0_wp           !! of its shank [length^2]
      real(wp) :: strength = 0.0_wp       !! ST of its material, 0: not given [pressure]
      type(cut_type) :: cut               !! the planes of symmetry through its axis
      type(thread_type) :: thread         !! count: number of real bolts that the bolt of the model is
   end type bolt_place

contains

   !> Find all BOLTS of MODEL, bars first, and the joints that each crosses.
   subroutine find_places(model, planes, cuts, bolts, passages, crossing)
      type(model_type), intent(in)               :: model
      type(symmetry_plane), intent(in)           :: planes(:)
      type(cut_type), intent(in)                 :: cuts(:)        !! (joints) by these planes
      type(bolt_place), allocatable, intent(out) :: bolts(:)
      type(passage_type), intent(out)            :: passages       !! the pairs of bodies, where there are bolts
      integer, allocatable, intent(out)          :: crossing(:, :) !! (pairs, bolts) as in forces_between
      real(wp) :: span(2)
      integer  :: i, n

      n = n_sections(model%mesh)
      if (n_bars(model%mesh) > 0) n = n + count(model%mesh%bars%bolt > 0)
      allocate (bolts(n))
      if (n > 0) call start_passages(model, cuts, passages)
      allocate (crossing(passages%n, n), source=0)
      n = 0
      do i = 1, n_bars(model%mesh)
         associate (bar => model%mesh%bars(i))
            if (bar%bolt == 0) cycle
            n = n + 1
            bolts(n) = bolt_place(id=bar%bolt, bar=i, tightening=bar%tightening, point=model%mesh%x(:, bar%nodes(1)), &
                                  direction=bar%direction(:, 1), area=bar%area, strength=bar%strength, thread=bar%thread, &
                                  cut=planes_along(model, planes, bar%nodes, bar%direction(:, 1)))
            span = [0.0_wp, norm2(model%mesh%x(:, bar%nodes(2)) - model%mesh%x(:, bar%nodes(1)))]
            call find_own_joint(model, span, passages, bolts(n), crossing(:, n))
         end associate
      end do
      do i = 1, n_sections(model%mesh)
         n = n + 1
         call place_section(model, planes, i, bolts(n), span)
         call find_own_joint(model, span, passages, bolts(n), crossing(:, n))
      end do
      do i = 1, n
         if (bolts(i)%thread%count <= 0.0_wp) bolts(i)%thread%count = modelled_part(planes, bolts(i)%cut)
      end do
      if (n > 0) call cut_passages(model, bolts%bar, bolts%section, crossing, passages)
   end subroutine find_places

   !> The BOLT of pretension section I, and its SPAN: that of the nodes of its body no farther from the axis than those of the
   !! section.
   subroutine place_section(model, planes, i, bolt, span)
      type(model_type), intent(in)     :: model
      type(symmetry_plane), intent(in) :: planes(:)
      integer, intent(in)              :: i
      type(bolt_place), intent(out)    :: bolt
      real(wp), intent(out)            :: span(2) !! from the point of the bolt, in its direction [length]
      type(surface_node_list) :: list
      real(wp) :: along, centroid(3), radius
      integer  :: node, s

      associate (section => model%mesh%sections(i))
         s = findloc(model%mesh%surfaces%id, section%surface, dim=1)
         call surface_nodes(model%mesh, model%mesh%surfaces(s), list)
         bolt = bolt_place(id=section%bolt, section=i, tightening=section%tightening, direction=section%direction, &
                           area=section%area, strength=section%strength, thread=section%thread, &
                           cut=planes_along(model, planes, list%node, section%direction))
         centroid = 0.0_wp
         do s = 1, list%n
            centroid = centroid + list%area(s)/sum(list%area)*model%mesh%x(:, list%node(s))
         end do
         bolt%point = onto_planes(bolt%cut, planes, centroid)
         radius = 0.0_wp
         do s = 1, list%n
            radius = max(radius, norm2(model%mesh%x(:, list%node(s)) - bolt%point))
         end do
         span = 0.0_wp
         do node = 1, n_points(model%mesh)
            if (model%freedoms%part(node) /= model%freedoms%part(section%point)) cycle
            if (distance(bolt, model%mesh%x(:, node)) > radius*(1.0_wp + beside_bolt)) cycle
            along = dot_product(model%mesh%x(:, node) - bolt%point, bolt%direction)
            span = [min(span(1), along), max(span(2), along)]
         end do
      end associate
   end subroutine place_section

   !> The part of a bolt in the model, of which CUT are the PLANES of symmetry: whole, half, or a sector.
   pure real(wp) function modelled_part(planes, cut) result(part)
      type(symmetry_plane), intent(in) :: planes(:)
      type(cut_type), intent(in)       :: cut

      part = 1.0_wp
      if (cut%n == 1) part = 0.5_wp
      if (cut%n == 2) part = 0.5_wp - &
         acos(dot_product(planes(cut%plane(1))%normal, planes(cut%plane(2))%normal))/(2.0_wp*acos(-1.0_wp))
   end function modelled_part

   !> Of the PLANES those that have DIRECTION in them and NODES on them.
   pure function planes_along(model, planes, nodes, direction) result(cut)
      type(model_type), intent(in)     :: model
      type(symmetry_plane), intent(in) :: planes(:)
      integer, intent(in)              :: nodes(:)
      real(wp), intent(in)             :: direction(3)
      type(cut_type) :: cut
      integer, allocatable :: along(:)
      integer :: k

      along = pack([(k, k = 1, size(planes))], [(abs(dot_product(planes(k)%normal, direction)) <= parallel_in_mesh, &
                                                 k = 1, size(planes))])
      cut = planes_through(model, planes(along), nodes)
      cut%plane(:cut%n) = along(cut%plane(:cut%n))
   end function planes_along

   !> The joints that BOLT crosses: the element nearest to the axis lies within the SPAN of the bolt and faces the axis. Joints much
   !! farther than the nearest one belong to other bolts. CROSSING tells the pairs of bodies on both sides. Of these joints its own
   !! is the one of largest area, the first of equal ones.
   pure subroutine find_own_joint(model, span, passages, bolt, crossing)
      type(model_type), intent(in)    :: model
      real(wp), intent(in)            :: span(2)     !! from the point of the bolt, in its direction [length]
      type(passage_type), intent(in)  :: passages
      type(bolt_place), intent(inout) :: bolt
      integer, intent(inout)          :: crossing(:) !! (pairs) 0 on entry
      real(wp) :: off(size(model%joints%list)), along, near
      logical  :: crossed(size(model%joints%list))
      integer  :: at(size(model%joints%list)), i, j

      crossed = .false.
      off = huge(1.0_wp)
      associate (length => span(2) - span(1))
         do j = 1, size(model%joints%list)
            do i = model%joints%list(j)%first, model%joints%list(j)%last
               near = distance(bolt, at_first_end(model%joints%element(i), model%mesh%x))
               if (near > off(j) - symmetric_tie*length) cycle
               off(j) = near
               at(j) = i
               along = dot_product(at_first_end(model%joints%element(i), model%mesh%x) - bolt%point, bolt%direction)
               crossed(j) = along > span(1) - symmetric_tie*length .and. along < span(2) + symmetric_tie*length .and. &
                            abs(dot_product(model%joints%element(i)%axes(:, 3), bolt%direction)) > 0.5_wp
            end do
         end do
         crossed = crossed .and. off <= minval(off, mask=crossed) + about_as_near*length
      end associate
      bolt%joint = first_largest(model%joints%list%area, crossed)
      do j = 1, size(model%joints%list) ! the normal of an element points from its end 1 to its end 2
         if (crossed(j)) crossing(passages%of_element(at(j))) = passages%sense(at(j))* &
            nint(sign(1.0_wp, dot_product(model%joints%element(at(j))%axes(:, 3), bolt%direction)))
      end do
   end subroutine find_own_joint

   !> (3, bolts) The directions of BOLTS.
   pure function bolt_directions(bolts) result(directions)
      type(bolt_place), intent(in) :: bolts(:)
      real(wp) :: directions(3, size(bolts))
      integer  :: i

      do i = 1, size(bolts)
         directions(:, i) = bolts(i)%direction
      end do
   end function bolt_directions

   !> Clamping and shear forces of the own joint around each bolt: sums over the elements of the joint nearest to the axis of
   !! this bolt. Elements equally near to several bolts are shared equally. The shear forces are those that no plane of symmetry
   !! through the bolt balances.
   pure subroutine find_clamping(model, analysis, bolts, clamping, shear)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(bolt_place), intent(in)    :: bolts(:)
      real(wp), intent(out)           :: clamping(:), shear(:) !! (bolts) [force]
      real(wp) :: along(3, size(bolts)), off(size(bolts)), share(size(bolts))
      integer  :: b, i

      clamping = 0.0_wp
      along = 0.0_wp
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i), state => analysis%states(i), of_joint => bolts%joint == &
            model%joints%element(i)%joint)
            if (.not. any(of_joint)) cycle
            do b = 1, size(bolts)
               off(b) = distance(bolts(b), at_first_end(element, model%mesh%x))
            end do
            share = merge(1.0_wp, 0.0_wp, of_joint .and. off <= (1.0_wp + symmetric_tie)*minval(off, mask=of_joint))
            share = share/sum(share)
            clamping = clamping + share*state%normal%sumf
            do b = 1, size(bolts)
               along(:, b) = along(:, b) + share(b)*matmul(element%axes(:, :2), state%shear%tau*element%area)
            end do
         end associate
      end do
      if (model%mesh%axisymmetric) along = 0.0_wp ! self-equilibrated around the ring
      do b = 1, size(bolts)
         shear(b) = norm2(free_part(bolts(b)%cut, along(:, b)))
      end do
   end subroutine find_clamping

   !> Bending moment at the pretension section of a solid bolt: the moment that the elements behind it exert on the nodes of the
   !! section, about the centroid of its area, across the bolt [force x length]. The weight of these elements is neglected.
   pure function bending_moment(model, section, u, temperature) result(moment)
      type(model_type), intent(in)   :: model
      type(section_type), intent(in) :: section
      real(wp), intent(in)           :: u(:, :) !! (dimension, n_nodes) of all nodes [length]
      type(temperature_type), intent(in) :: temperature
      type(surface_node_list) :: list
      real(wp) :: moment(3), centroid(3), force(3), thermal(3, max_nodes)
      real(wp) :: k(max_section_dofs, max_section_dofs), p(max_section_dofs)
      integer  :: d, e, i, j, n, s

      d = model%mesh%dimension
      s = findloc(model%mesh%surfaces%id, section%surface, dim=1)
      call surface_nodes(model%mesh, model%mesh%surfaces(s), list)
      centroid = 0.0_wp
      do i = 1, list%n
         centroid = centroid + list%area(i)*model%mesh%x(:, list%node(i))/sum(list%area)
      end do
      moment = 0.0_wp
      do j = model%mesh%first_at(section%node), model%mesh%first_at(section%node + 1) - 1
         e = model%mesh%elements_at(j)
         call element_stiffness(model, e, k)
         call element_thermal_forces(model, e, temperature, thermal(:d, :))
         associate (nodes => element_points(model%mesh, e))
            n = d*size(nodes)
            p(:n) = matmul(k(:n, :n), reshape(corner_displacements(model, e, u), [n]))
            do i = 1, size(nodes)
               if (model%mesh%node_section(nodes(i)) /= model%mesh%element_section(e)) cycle
               force = 0.0_wp
               force(:d) = p(d*(i - 1) + 1:d*i) - thermal(:d, i)
               moment = moment + cross(model%mesh%x(:, nodes(i)) - centroid, force)
            end do
         end associate
      end do
      moment = moment - dot_product(moment, section%direction)*section%direction
      if (model%mesh%axisymmetric) moment = 0.0_wp ! self-equilibrated around the ring
   end function bending_moment

   !> Distance of X from the axis of BOLT [length].
   pure real(wp) function distance(bolt, x)
      type(bolt_place), intent(in) :: bolt
      real(wp), intent(in)         :: x(3)

      distance = norm2(x - bolt%point - dot_product(x - bolt%point, bolt%direction)*bolt%direction)
   end function distance

end module bolt_places
