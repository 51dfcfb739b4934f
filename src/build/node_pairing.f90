!> Pairs of facing nodes for matching sides of a joint, and the search of facing faces for the mortar projection.
module node_pairing
   use curved_faces, only: find_tilts, largest_sagitta
   use element_kinds, only: max_side_nodes
   use face_overlap, only: edge_lengths, face_frame, in_frame, make_frame, plane_points, seen_area, seen_face
   use kinds, only: wp
   use lists, only: distinct, id_table_type
   use model_data, only: joint_cover, mesh_type, surface_type, whole_share
   use mortar_integrals, only: face_part, fit_face, add_overlap, cover_integrals, own_face, interface_sums_type
   use spatial_search, only: spatial_search_type
   use surface_build, only: side_influence, side_name, surface_node_list
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text, plural, real_text
   use tolerances, only: most_aside, pairing_reach
   implicit none
   private

   public :: pair_nodes, fit_side, shares_facing

   real(wp), parameter, public :: facing = -0.5_wp      !! cosine of the normals of two sides that face each other, at most

   real(wp), parameter, public :: twice = 1.01_wp !! covered share above which faces lie behind one another

   real(wp), parameter, public :: default_reach = 0.1_wp !! of the longest side of a face of SIDE1

   !> Pairs whose nodes do not face each other along the normal.
   type, public :: aside_type
      integer  :: n = 0                      !! number of such pairs
      integer  :: nodes(2) = 0               !! the pair with the largest offset
      real(wp) :: distance = 0.0_wp          !! its offset across the normal [length]
   end type aside_type

   !> The faces of SIDE2 for the search, and work space.
   type :: opposite_faces
      type(spatial_search_type) :: boxes
      real(wp), allocatable :: normal(:, :)  ! (3, n) at their centres
      real(wp), allocatable :: area(:)       ! (n) area projected along their normals
      real(wp), allocatable :: tilt(:, :)    ! (4, n) angles of the tangents where the surface is curved
      real(wp), allocatable :: own_tilt(:, :) ! likewise of SIDE1
      logical, allocatable  :: covers(:)     ! (n) whether it covers any part of SIDE1
      integer, allocatable  :: near(:)       ! faces that the search has found
      type(plane_points)    :: points
   end type opposite_faces

contains

   !> For every node of side 1 the coincident node of side 2, or the reason why there are no pairs. ASIDE is the largest offset of a
   !! partner across the normal, above MOST_ASIDE of the shortest edge at its node: the forces of such a pair have a moment that
   !! nothing balances.
   subroutine pair_nodes(mesh, surface, side1, side2, tol, partner, fault, in_tolerance, aside)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                 :: surface(2)   !! of the model
      type(surface_node_list), intent(in) :: side1, side2 !! their nodes
      real(wp), intent(in)                :: tol          !! 0: the default [length]
      integer, intent(out)                :: partner(:)   !! nodes of the model, of use where there is no fault
      character(:), allocatable, intent(out) :: fault     !! '': all nodes have partners
      logical, intent(out)                :: in_tolerance !! the error is reported for TOL, else for SIDE2
      type(aside_type), intent(out)       :: aside
      type(spatial_search_type) :: search
      real(wp) :: tolerance, distance, worst
      integer  :: k, found(side1%n), nearest, turned, worst_node
      integer, allocatable :: each(:)

      fault = ''
      in_tolerance = .false.
      tolerance = tol
      if (tol <= 0.0_wp) then
         associate (side => mesh%surfaces(surface(1)))
            tolerance = pairing_reach*minval([(minval(edge_lengths(mesh%x(:, side%nodes(:side%corners(k), k)))), &
                                                   k = 1, side%n)])
         end associate
      end if
      call search%build(mesh%x(:, side2%node))
      do k = 1, side1%n
         call search%nearest(mesh%x(:, side1%node(k)), tolerance, found(k), distance)
      end do
      if (any(found == 0)) then
         worst = 0.0_wp
         worst_node = 0
         do k = 1, side1%n
            if (found(k) > 0) cycle
            call search%nearest(mesh%x(:, side1%node(k)), huge(1.0_wp), nearest, distance)
            if (distance <= worst) cycle
            worst = distance
            worst_node = side1%node(k)
         end do
         fault = 'the sides do not face each other node by node: '//plural(count(found == 0), 'node')//' of '// &
            integer_text(side1%n)//' of SIDE1 found no partner within '//real_text(tolerance)//'; the farthest is node '// &
            integer_text(mesh%node_id(worst_node))//' at '
         do k = 1, mesh%dimension
            fault = fault//real_text(mesh%x(k, worst_node))//', '
         end do
         fault = fault//real_text(worst)//' away'
         return
      end if
      partner = side2%node(found)
      call distinct(found, each)
      turned = count([(dot_product(side1%normal(:, k), side2%normal(:, found(k))) > facing, k = 1, side1%n)])
      if (size(each) < side1%n) then
         in_tolerance = .true.
         fault = 'within '//real_text(tolerance)//' '//plural(side1%n - size(each), 'node')// &
                 ' of SIDE1 have the partner of another node'
      else if (turned > 0) then
         fault = 'the sides do not face each other: at '//plural(turned, 'node')//' their normals are not opposite'
      else if (side2%n /= side1%n) then
         fault = 'SIDE2 has '//plural(side2%n, 'node')//', SIDE1 '//integer_text(side1%n)//': every node needs its partner'
      else if (.not. same_order(mesh, surface, side1, partner)) then
         fault = 'mid-side nodes face corner nodes: one side is of second order, the other is not'
      else
         call find_aside(mesh, mesh%surfaces(surface(1)), side1, partner, aside)
      end if
   end subroutine pair_nodes

   !> The pair of SURFACE that stands farthest ASIDE: the offset of its nodes across the normal.
   pure subroutine find_aside(mesh, surface, side, partner, aside)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)      :: surface
      type(surface_node_list), intent(in) :: side       !! its nodes
      integer, intent(in)                 :: partner(:) !! of these nodes
      type(aside_type), intent(out)       :: aside
      type(id_table_type) :: place
      real(wp) :: offset(3), shortest(side%n), distance
      integer  :: at(max_side_nodes), k, n, s

      call place%build(side%node)
      shortest = huge(1.0_wp)
      do s = 1, surface%n
         n = surface%n_nodes(s)
         do k = 1, n
            at(k) = place%find(surface%nodes(k, s))
         end do
         shortest(at(:n)) = min(shortest(at(:n)), minval(edge_lengths(mesh%x(:, surface%nodes(:surface%corners(s), s)))))
      end do
      do k = 1, side%n
         offset = mesh%x(:, partner(k)) - mesh%x(:, side%node(k))
         offset = offset - dot_product(offset, side%normal(:, k))*side%normal(:, k)
         distance = norm2(offset)
         if (distance <= most_aside*shortest(k)) cycle
         aside%n = aside%n + 1
         if (distance <= aside%distance) cycle
         aside%distance = distance
         aside%nodes = [side%node(k), partner(k)]
      end do
   end subroutine find_aside

   !> Whether corners have corners as partners, and mid-side nodes have mid-side nodes.
   pure logical function same_order(mesh, surface, side1, partner)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                 :: surface(2)
      type(surface_node_list), intent(in) :: side1
      integer, intent(in)                 :: partner(:) !! of its nodes, all different
      type(id_table_type) :: between(2) ! mid-side nodes
      integer :: k, s

      do k = 1, 2
         associate (side => mesh%surfaces(surface(k)))
            call between(k)%build([(side%nodes(side%corners(s) + 1:side%n_nodes(s), s), s = 1, side%n)])
         end associate
      end do
      same_order = all([(between(1)%find(side1%node(k)) > 0 .eqv. between(2)%find(partner(k)) > 0, k = 1, side1%n)])
   end function same_order

   !> The mortar projection of the elements at the NODES of side 1, or the reason why there is none.
   subroutine fit_side(mesh, surface, nodes, reach, sums, cover, partly, fault)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                      :: surface(2) !! of the model
      type(surface_node_list), intent(in)      :: nodes      !! of side 1
      real(wp), intent(in)                     :: reach      !! of the search along the normal, 0: the default [length]
      type(interface_sums_type), intent(inout) :: sums       !! empty
      type(joint_cover), intent(out)           :: cover
      logical, intent(out)                     :: partly(:)  !! (nodes) at a face that is partly covered
      character(:), allocatable, intent(out)   :: fault      !! ''; or nothing is covered, or a face is covered twice
      type(opposite_faces)  :: opposite
      type(id_table_type)   :: place
      type(cover_integrals) :: integrals
      type(face_part)       :: part
      type(own_face)        :: face
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes), share, all_area, highest, farthest_reach
      integer  :: elements(max_side_nodes), k, n, own_parts, s, double ! parts: linear edges or triangles, to compare the mesh sizes

      cover%fitted = .true.
      cover%share = 0.0_wp
      partly = .false.
      fault = ''
      call place%build(nodes%node)
      call sums%start(nodes%n, mesh%n_nodes)
      all_area = 0.0_wp
      own_parts = 0
      double = 0
      highest = twice
      farthest_reach = 0.0_wp
      associate (side1 => mesh%surfaces(surface(1)), side2 => mesh%surfaces(surface(2)))
         call list_opposite(mesh, side2, opposite)
         call find_tilts(mesh, side1, opposite%own_tilt)
         do s = 1, side1%n
            n = side1%n_nodes(s)
            call side_influence(mesh, side1, s, area, normal)
            all_area = all_area + sum(area)
            call cover_face(mesh, side1, s, side2, reach, opposite, face, integrals)
            farthest_reach = max(farthest_reach, face%reach)
            if (integrals%seen <= 0.0_wp) cycle
            share = integrals%seen/max(seen_area(face%seen), tiny(1.0_wp))
            if (share > highest) double = s
            highest = max(highest, share)
            own_parts = own_parts + n - mesh%dimension + 1
            cover%spacing(1) = cover%spacing(1) + seen_area(face%seen)
            call fit_face(mesh%dimension, n, share >= whole_share, integrals, part)
            do k = 1, n
               elements(k) = place%find(side1%nodes(k, s))
               if (share < whole_share) partly(elements(k)) = .true.
            end do
            call sums%add_face(elements(:n), side1%nodes(:n, s), integrals%node, part)
            cover%share = cover%share + merge(1.0_wp, share, share >= whole_share)*sum(area)
            cover%farthest = max(cover%farthest, integrals%farthest)
            cover%sagitta(1) = max(cover%sagitta(1), largest_sagitta(mesh%x(:, side1%nodes(:side1%corners(s), s)), &
                                                                     opposite%own_tilt(:, s)))
         end do
         do s = 1, side2%n
            if (opposite%covers(s)) cover%sagitta(2) = max(cover%sagitta(2), largest_sagitta( &
               mesh%x(:, side2%nodes(:side2%corners(s), s)), opposite%tilt(:, s)))
         end do
         ! coverage and mean sizes of the faces; faults
         call sums%finish()
         cover%share = cover%share/max(all_area, tiny(1.0_wp))
         cover%spacing(1) = cover%spacing(1)/max(1, own_parts)
         cover%spacing(2) = sum(opposite%area, mask=opposite%covers) &
                            /max(1, sum(side2%n_nodes(:side2%n) - mesh%dimension + 1, mask=opposite%covers))
         if (own_parts == 0) then
            fault = 'surface '//integer_text(side2%id)//' does not cover SIDE1: none of its faces is opposite to a face of '// &
                    'SIDE1 within '//real_text(farthest_reach)//' along the normal; the nearest nodes are '// &
                    real_text(shortest_distance(mesh, nodes%node, nodes_of(side2)))//' apart. Mark the sides that face '// &
                    'each other, or give a larger TOL'
         else if (double > 0) then
            fault = 'faces of surface '//integer_text(side2%id)//' lie behind each other and cover the '// &
                    side_name(mesh, side1%nodes(:side1%corners(double), double))//' of SIDE1 '//real_text(highest)// &
                    ' times: mark only the nearer ones, or give a TOL below their distance'
         end if
      end associate
   end subroutine fit_side

   !> The SHARE of each face of SURFACE that faces the surface OTHER within REACH, as of fit_side.
   subroutine shares_facing(mesh, surface, other, reach, share)
      type(mesh_type), intent(in)    :: mesh
      type(surface_type), intent(in) :: surface, other
      real(wp), intent(in)           :: reach
      real(wp), intent(out)          :: share(:) !! (faces) of its area
      type(opposite_faces)  :: opposite
      type(cover_integrals) :: integrals
      type(own_face)        :: face
      integer :: s

      call list_opposite(mesh, other, opposite)
      call find_tilts(mesh, surface, opposite%own_tilt)
      do s = 1, surface%n
         call cover_face(mesh, surface, s, other, reach, opposite, face, integrals)
         share(s) = integrals%seen/max(seen_area(face%seen), tiny(1.0_wp))
      end do
   end subroutine shares_facing

   !> The shortest distance between two lists of nodes [length].
   real(wp) function shortest_distance(mesh, nodes, others) result(shortest)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: nodes(:), others(:)
      type(spatial_search_type) :: search
      real(wp) :: distance
      integer  :: found, k

      shortest = huge(1.0_wp)
      call search%build(mesh%x(:, others))
      do k = 1, size(nodes)
         call search%nearest(mesh%x(:, nodes(k)), shortest, found, distance)
         shortest = min(shortest, distance)
      end do
   end function shortest_distance

   !> The faces of SIDE2 for the search.
   subroutine list_opposite(mesh, side2, opposite)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)    :: side2
      type(opposite_faces), intent(out) :: opposite
      type(face_frame) :: frame
      real(wp), allocatable :: box(:, :, :)
      integer :: s

      allocate (box(3, 2, side2%n), opposite%normal(3, side2%n), opposite%area(side2%n))
      allocate (opposite%covers(side2%n), source=.false.)
      allocate (opposite%near(0))
      do s = 1, side2%n
         associate (x => mesh%x(:, side2%nodes(:side2%n_nodes(s), s)))
            box(:, 1, s) = minval(x, dim=2)
            box(:, 2, s) = maxval(x, dim=2)
            call make_frame(mesh%dimension, x, frame)
            opposite%area(s) = seen_area(in_frame(mesh%dimension, x, frame))
         end associate
         opposite%normal(:, s) = frame%axes(:, 3)
      end do
      call opposite%boxes%build(box(:, 1, :), box(:, 2, :))
      call find_tilts(mesh, side2, opposite%tilt)
   end subroutine list_opposite

   !> FACE S of SIDE1 in its own frame, and the INTEGRALS over the part of it that SIDE2 covers.
   subroutine cover_face(mesh, side1, s, side2, reach, opposite, face, integrals)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)       :: side1, side2
      integer, intent(in)                  :: s
      real(wp), intent(in)                 :: reach
      type(opposite_faces), intent(inout)  :: opposite !! of SIDE2
      type(own_face), intent(out)          :: face
      type(cover_integrals), intent(out)   :: integrals
      type(seen_face) :: other
      real(wp) :: low(3), high(3), before
      integer  :: d, i, n

      associate (x => mesh%x(:, side1%nodes(:side1%n_nodes(s), s)))
         call make_frame(mesh%dimension, x, face%frame)
         face%seen = in_frame(mesh%dimension, x, face%frame)
         call bend(face%seen, opposite%own_tilt(:, s), [0.0_wp, 0.0_wp, 1.0_wp])
         face%reach = merge(reach, default_reach*maxval(edge_lengths(x(:, :side1%corners(s)))), reach > 0.0_wp)
      end associate
      face%on_ring = mesh%axisymmetric
      if (mesh%dimension == 2) face%thickness = mesh%properties(mesh%element_property(side1%element(s)))%thickness
      do d = 1, 3
         associate (x => face%frame%centre(d) + matmul(face%frame%axes(d, :), face%seen%x(:, :face%seen%n)))
            low(d) = minval(x) - face%reach
            high(d) = maxval(x) + face%reach
         end associate
      end do
      call opposite%boxes%list_meeting(low, high, opposite%near, n)
      do i = 1, n
         associate (f => opposite%near(i))
            if (dot_product(opposite%normal(:, f), face%frame%axes(:, 3)) > facing) cycle
            before = integrals%seen
            associate (nodes => side2%nodes(:side2%n_nodes(f), f))
               other = in_frame(mesh%dimension, mesh%x(:, nodes), face%frame)
               call bend(other, opposite%tilt(:, f), matmul(opposite%normal(:, f), face%frame%axes))
               call add_overlap(face, other, nodes, opposite%points, integrals)
            end associate
            if (integrals%seen > before) opposite%covers(f) = .true.
         end associate
      end do
   end subroutine cover_face

   !> Make a face the chords of arcs with the angles TILT of their tangents; NORMAL is that of the face in its coordinates.
   pure subroutine bend(face, tilt, normal)
      type(seen_face), intent(inout) :: face
      real(wp), intent(in)           :: tilt(4), normal(3)

      face%is_curved = any(abs(tilt) > 0.0_wp)
      face%tilt = tilt
      face%normal = normal
   end subroutine bend

end module node_pairing
