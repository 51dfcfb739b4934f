!> The interface elements of a JOINT card and their axes, and the axes and centroid of a joint.
!! Sides with matching meshes are connected by pairs of nodes, other sides by lists of nodes with weights; one side alone is
!! connected to its duplicate or to a rigid base. The normal points from node 1 to node 2.
module joint_sides
   use bulk_data, only: fit_no, fit_yes
   use deck_check, only: checked_deck
   use element_kinds, only: max_nodes, max_side_nodes, side_kind
   use interface_operator, only: at_first_end, connect_nodes, interface_element
   use kinds, only: wp
   use lists, only: id_table_type
   use mesh_queries, only: element_points
   use model_data, only: joint_cover, joint_frame, joint_type, joints_type, mesh_type, surface_type
   use mortar_integrals, only: face_part, whole_shares, interface_sums_type
   use node_pairing, only: aside_type, pair_nodes, fit_side
   use numbers, only: cross
   use quadrature, only: integration_rule, side_rule
   use shape_functions, only: shape_values
   use surface_build, only: side_influence, surface_node_list, surface_nodes
   use text_tools, only: integer_text, one_of, plural, real_text
   use tolerances, only: no_inertia, parallel_in_mesh, zero_cosine
   implicit none
   private

   public :: join_sides, is_coarser, joint_axes, outward, joint_centroid, find_frame

contains

   !> The elements between two sides: pairs if every node has a partner that faces it along the normal and the card does not request
   !! a projection; the coverage of projected sides is stored in joint J. FIT = NO makes pairs whose nodes stand aside, too.
   !! SURFACE(2) = 0: the elements between a surface and its duplicate, if the surface was split, or a rigid base.
   subroutine join_sides(deck, j, mesh, joints, surface, elements)
      type(checked_deck), intent(in)                       :: deck
      integer, intent(in)                                  :: j, surface(2)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      type(interface_element), allocatable, intent(inout)  :: elements(:)
      type(surface_node_list)   :: side1, side2
      character(:), allocatable :: fault, lack
      type(interface_sums_type) :: sums
      type(joint_cover) :: cover
      type(aside_type)  :: aside
      integer, allocatable :: kept(:), partner(:)
      logical, allocatable :: partly(:)
      logical :: in_tolerance
      integer :: k

      call surface_nodes(mesh, mesh%surfaces(surface(1)), side1)
      associate (card => deck%bulk%joint(j))
         fault = 'a fit is asked for'
         in_tolerance = .false.
         allocate (partner(side1%n), partly(side1%n))
         if (surface(2) == 0) then
            fault = ''
            if (any(mesh%duplicate(side1%node) > 0)) then ! without the nodes of the edge of a split surface inside a body
               kept = pack([(k, k = 1, side1%n)], mesh%duplicate(side1%node) > 0)
               side1 = surface_node_list(size(kept), side1%node(kept), side1%area(kept), side1%normal(:, kept))
            end if
            partner = mesh%duplicate(side1%node)
         else if (card%fit /= fit_yes) then
            call surface_nodes(mesh, mesh%surfaces(surface(2)), side2)
            call pair_nodes(mesh, surface, side1, side2, card%tolerance, partner, fault, in_tolerance, aside)
            if (aside%n > 0 .and. card%fit == fit_no) call deck%errors%warn('joint '//integer_text(card%id)//': '// &
               aside_words(mesh, aside)//'; FIT = NO pairs them, and nothing balances the moments of their forces')
            if (aside%n > 0 .and. card%fit /= fit_no) fault = aside_words(mesh, aside)
         end if
         lack = ''
         if (card%is_linear .and. (fault /= '' .or. any(mesh%surfaces(surface(1))%n_nodes(:mesh%surfaces(surface(1))%n) > &
                                                        mesh%surfaces(surface(1))%corners(:mesh%surfaces(surface(1))%n)))) then
            call deck%field_error(card%line, 'PRESSURE', 'LINEAR needs pairs of nodes on faces of first order'// &
                                  one_of(fault == '', '', '; '//fault))
         else if (card%is_linear) then
            call linear_elements(mesh, mesh%surfaces(surface(1)), side1, partner, elements)
         else if (fault == '') then
            call pair_elements(mesh, mesh%surfaces(surface(1)), side1, partner, elements, lack)
         else if (card%fit == fit_no) then
            fault = fault//'; FIT = AUTO joins faces that do not match'
            if (in_tolerance) then
               call deck%field_error(card%line, one_of(card%tolerance > 0.0_wp, 'TOL', 'SIDE2'), fault, called='TOL')
            else
               call deck%field_error(card%line, 'SIDE2', fault)
            end if
         else
            call fit_side(mesh, surface, side1, card%tolerance, sums, cover, partly, fault)
            if (fault /= '') then
               if (aside%n > 0) fault = fault//'; the nodes pair by FIT = NO, but '//aside_words(mesh, aside)
               call deck%field_error(card%line, 'SIDE2', fault)
            else
               joints%list(j)%cover = cover
               call summed_elements(mesh, side1, sums, partly, elements, lack)
            end if
         end if
         if (lack /= '') call deck%errors%add(card%line, 'surface '//integer_text(card%sides(1))//' has no area at node '//lack)
      end associate
   end subroutine join_sides

   !> Text about pairs whose nodes stand aside.
   function aside_words(mesh, aside) result(words)
      type(mesh_type), intent(in) :: mesh
      type(aside_type), intent(in) :: aside
      character(:), allocatable    :: words

      words = plural(aside%n, 'node')//' of SIDE1 and their partners do not face each other along the normal; node '// &
              integer_text(mesh%node_id(aside%nodes(1)))//' stands '//real_text(aside%distance)//' beside node '// &
              integer_text(mesh%node_id(aside%nodes(2)))
   end function aside_words

   !> Elements between the nodes of SIDE and their partners, 0: a rigid base. Faces with mid-side nodes have elements at these nodes
   !! alone, which are connected to the corners too.
   subroutine pair_elements(mesh, surface, side, partner, elements, lack)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)                      :: surface
      type(surface_node_list), intent(in)                 :: side
      integer, intent(in)                                 :: partner(:) !! (nodes of SIDE)
      type(interface_element), allocatable, intent(inout) :: elements(:)
      character(:), allocatable, intent(inout)            :: lack !! of area: the node and the reason, set if there is such a node
      type(interface_sums_type) :: sums
      type(id_table_type) :: place
      type(face_part)     :: part
      integer :: at(max_side_nodes), opposite(max_side_nodes), k, n, s
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes), share(max_side_nodes, max_side_nodes)

      if (any(surface%corners(:surface%n) < surface%n_nodes(:surface%n))) then
         call place%build(side%node)
         call sums%start(side%n, mesh%n_nodes)
         do s = 1, surface%n
            n = surface%n_nodes(s)
            call side_influence(mesh, surface, s, area, normal)
            share = whole_shares(mesh%dimension, n)
            part%n = n
            do k = 1, n
               part%same_side(:, k) = share(:, k)*area(k)
               at(k) = place%find(surface%nodes(k, s))
               opposite(k) = surface%nodes(k, s) ! a node at the edge of a split surface is its own partner
               if (at(k) > 0) opposite(k) = partner(at(k))
            end do
            part%opposite = part%same_side
            part%area = matmul(share, area)
            part%normal = matmul(normal, transpose(share))
            call sums%add_face(at(:n), surface%nodes(:n, s), opposite(:merge(n, 0, any(partner > 0))), part)
         end do
         call sums%finish()
         call summed_elements(mesh, side, sums, spread(.false., 1, side%n), elements, lack)
         return
      end if
      if (mesh%axisymmetric .and. any(side%area <= 0.0_wp)) then
         lack = integer_text(mesh%node_id(side%node(minloc(side%area, dim=1))))//': it lies on the axis'
         return
      end if
      deallocate (elements)
      allocate (elements(side%n))
      do k = 1, side%n
         call connect_nodes(elements(k), side%node(k), partner(k))
         elements(k)%area = side%area(k)
         elements(k)%axes = joint_axes(mesh, side%normal(:, k))
      end do
   end subroutine pair_elements

   !> PRESSURE LINEAR: elements at the Gauss points of the sides, 2 on an edge, 3 on a triangle, 2 x 2 on a quadrilateral. The
   !! movement of an element is the linear interpolation of those of its pairs, so that the sum of the elements of a side is the
   !! consistent matrix of this side, the integral of N^T k N. PARTNER as of pair_elements.
   subroutine linear_elements(mesh, surface, side, partner, elements)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)                      :: surface
      type(surface_node_list), intent(in)                 :: side
      integer, intent(in)                                 :: partner(:) !! (nodes of SIDE)
      type(interface_element), allocatable, intent(inout) :: elements(:)
      type(id_table_type)    :: place
      type(integration_rule) :: rule ! one point per corner
      integer  :: at(4), e, g, kind, n, nodes(4), opposite(4), s
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes), shape(max_nodes, 4), size_of(4), z(3)

      call place%build(side%node)
      deallocate (elements)
      allocate (elements(sum(surface%corners(:surface%n))))
      e = 0
      do s = 1, surface%n
         n = surface%corners(s)
         kind = side_kind(mesh%dimension, n)
         call side_rule(kind, rule)
         call side_influence(mesh, surface, s, area, normal)
         nodes(:n) = surface%nodes(:n, s)
         at(:n) = [(place%find(nodes(g)), g = 1, n)]
         opposite(:n) = nodes(:n) ! a node at the edge of a split surface is its own partner
         where (at(:n) > 0) opposite(:n) = partner(max(1, at(:n)))
         do g = 1, n
            call shape_values(kind, rule%point(:, g), shape(:, g))
            size_of(g) = dot_product(shape(:n, g), area(:n)) ! of a quadrilateral; equal ones where it is a parallelogram
            if (mesh%axisymmetric) size_of(g) = dot_product(shape(:n, g), mesh%x(1, nodes(:n)))
         end do
         size_of(:n) = size_of(:n)*sum(area(:n))/sum(size_of(:n))
         do g = 1, n
            e = e + 1
            associate (element => elements(e))
               element%n_1 = n
               element%named = nodes(g)
               element%node = pack([nodes(:n), opposite(:n)], [spread(.true., 1, n), opposite(:n) > 0])
               element%weight = pack([shape(:n, g), -shape(:n, g)], [spread(.true., 1, n), opposite(:n) > 0])
               element%area = size_of(g)
               z = matmul(normal(:, :n), shape(:n, g))
               element%axes = joint_axes(mesh, z/norm2(z))
            end associate
         end do
      end do
   end subroutine linear_elements

   !> The elements of SUMS at the nodes of SIDE, in their order.
   subroutine summed_elements(mesh, side, sums, may_lack, elements, lack)
      type(mesh_type), intent(in) :: mesh
      type(surface_node_list), intent(in)                 :: side
      type(interface_sums_type), intent(in)               :: sums
      logical, intent(in)                                 :: may_lack(:) !! whether the area at a node may be 0, as on the axis
      type(interface_element), allocatable, intent(inout) :: elements(:)
      character(:), allocatable, intent(inout)            :: lack        !! as of pair_elements
      integer, allocatable :: at(:)
      integer  :: k
      real(wp) :: normal(3)

      at = pack([(k, k = 1, side%n)], sums%around > 0.0_wp)
      k = findloc(sums%has_area(at) .or. (sums%has_none(at) .and. (may_lack(at) .or. mesh%axisymmetric)), .false., dim=1)
      if (k > 0) then
         lack = integer_text(mesh%node_id(side%node(at(k))))// &
                ', or a negative one: move the mid-side nodes back to the middle of the edges'
         return
      end if
      at = pack(at, sums%has_area(at))
      deallocate (elements)
      allocate (elements(size(at)))
      do k = 1, size(at)
         call sums%connect(at(k), elements(k))
         elements(k)%named = side%node(at(k))
         normal = sums%normal(:, at(k))
         elements(k)%axes = joint_axes(mesh, normal/max(norm2(normal), tiny(1.0_wp)))
      end do
   end subroutine summed_elements

   !> Axes of an interface element with normal Z (unit): columns x, y, z, right-handed. In the plane x is tangential to the joint
   !! and y is normal to the plane; x points towards +X (+Y where the joint is vertical). In space x is the projection of +X onto
   !! the joint, or of +Y where the normal is within 25 degrees of X.
   pure function joint_axes(mesh, z) result(axes)
      type(mesh_type), intent(in) :: mesh
      real(wp), intent(in)         :: z(3)
      real(wp) :: axes(3, 3), x(3)

      if (mesh%dimension == 3) then
         x = [1.0_wp, 0.0_wp, 0.0_wp]
         if (abs(z(1)) > 0.9_wp) x = [0.0_wp, 1.0_wp, 0.0_wp]
         x = x - dot_product(x, z)*z
         x = x/norm2(x)
      else
         x = [-z(2), z(1), 0.0_wp]
         if (x(1) < -zero_cosine .or. (abs(x(1)) <= zero_cosine .and. x(2) < 0.0_wp)) x = -x
      end if
      axes(:, 1) = x
      axes(:, 2) = cross(z, x)
      axes(:, 3) = z
   end function joint_axes

   !> Whether SIDE1 of a joint is coarser than SIDE2: its mean face is more than a tenth larger.
   pure logical function is_coarser(cover)
      type(joint_cover), intent(in) :: cover

      is_coarser = cover%spacing(1) > 1.1_wp*cover%spacing(2)
   end function is_coarser

   !> The normal of a CJOINT in the sense from node 1 to node 2: out of the body at node 1, else into the body at node 2,
   !! else as given. The card gives the line of the normal; the bodies give its sense, those in the plane of the joint give none.
   pure function outward(mesh, nodes, normal) result(z)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: nodes(2)
      real(wp), intent(in)         :: normal(3)
      real(wp) :: z(3), along, reach, to_body(3), to_centre(3)
      integer  :: i, side

      z = normal
      do side = 1, 2
         if (nodes(side) == 0) cycle
         to_body = 0.0_wp ! from the node to the centres of its elements
         reach = 0.0_wp
         do i = mesh%first_at(nodes(side)), mesh%first_at(nodes(side) + 1) - 1
            associate (corners => element_points(mesh, mesh%elements_at(i)))
               if (any(corners == 0)) cycle
               to_centre = sum(mesh%x(:, corners), dim=2)/size(corners) - mesh%x(:, nodes(side))
               to_body = to_body + to_centre
               reach = reach + norm2(to_centre)
            end associate
         end do
         along = dot_product(to_body, normal)
         if (.not. abs(along) > max(0.05_wp*norm2(to_body), parallel_in_mesh*reach)) cycle
         if ((side == 1) .eqv. (along > 0.0_wp)) z = -normal
         return
      end do
   end function outward

   !> The centroid of the area of JOINT [length].
   pure function joint_centroid(mesh, joints, joint) result(centroid)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(joint_type), intent(in) :: joint
      real(wp) :: centroid(3)
      integer  :: i

      centroid = 0.0_wp
      do i = joint%first, joint%last
         centroid = centroid + joints%element(i)%area*at_first_end(joints%element(i), mesh%x)/joint%area
      end do
   end function joint_centroid

   !> Axes and centroid of JOINT. The axes are those of an interface element with the mean normal; for a closed joint they are the
   !! axes of the model in space, and z is +Y in the plane.
   pure function find_frame(mesh, joints, joint) result(frame)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(joint_type), intent(in) :: joint
      type(joint_frame) :: frame
      real(wp), parameter :: closed_below = 0.1_wp ! length of the mean normal of a joint that faces all ways
      real(wp) :: arm(3), inertia(3), normal(3)
      integer  :: i

      normal = 0.0_wp ! area-weighted mean, of length 1 for a plane joint
      do i = joint%first, joint%last
         normal = normal + joints%element(i)%area*joints%element(i)%axes(:, 3)/joint%area
      end do
      frame%faces_all_ways = norm2(normal) < closed_below
      if (mesh%axisymmetric) normal(1) = 0.0_wp ! over the whole ring only the axial part remains
      frame%closed = norm2(normal) < closed_below
      if (frame%closed) then
         normal = 0.0_wp
         normal(mesh%dimension) = 1.0_wp
      end if
      frame%axes = joint_axes(mesh, normal/norm2(normal))
      frame%centroid = joint_centroid(mesh, joints, joint)
      inertia = 0.0_wp
      do i = joint%first, joint%last
         arm = at_first_end(joints%element(i), mesh%x) - frame%centroid
         arm = matmul(arm, frame%axes)
         frame%extent = max(frame%extent, norm2(arm))
         inertia = inertia + joints%element(i)%area*(dot_product(arm, arm) - arm**2)
      end do
      frame%exists = .true.
      if (mesh%dimension == 2) frame%exists = [.true., .false., .true., .false., .true., .false.]
      if (mesh%axisymmetric) frame%exists = [.false., .false., .true., .false., .false., .false.]
      frame%exists(4:) = frame%exists(4:) .and. inertia > no_inertia*maxval(inertia)
      if (frame%extent > no_inertia*norm2(frame%centroid)) return
      frame%extent = 0.0_wp ! all elements at one place, to rounding
      frame%exists(4:) = .false.
   end function find_frame

end module joint_sides
