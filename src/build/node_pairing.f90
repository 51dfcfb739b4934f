!> Pairs of facing nodes for matching sides of a joint, and the search of facing faces for the mortar projection.
module node_pairing
   use element_kinds, only: max_side_nodes
   use face_overlap, only: edge_lengths, face_frame, in_frame, make_frame, plane_points, seen_area
   use kinds, only: wp
   use lists, only: id_table_type
   use model_data, only: joint_cover, model_type, surface_type, whole_share
   use mortar_integrals, only: face_part, fit_face, add_overlap, cover_integrals, own_face, start_integrals, interface_sums_type
   use spatial_search, only: spatial_search_type
   use surface_build, only: side_influence, surface_node_list
   use text_tools, only: integer_text, plural, real_text
   implicit none
   private

   public :: pair_nodes, fit_side

   real(wp), parameter :: default_tolerance = 1.0e-3_wp ! of the shortest edge of SIDE1
   real(wp), parameter, public :: facing = -0.5_wp      !! cosine of the normals of two sides that face each other, at most

   !> The reason why there are no pairs: field of the JOINT card and text; no text: all nodes have partners.
   type, public :: pairing_fault
      logical :: in_tolerance = .false.                 !! the error is reported for TOL, else for SIDE2
      character(:), allocatable :: words
   end type pairing_fault

   real(wp), parameter :: twice = 1.01_wp     ! covered share above which faces lie behind one another

   real(wp), parameter, public :: default_reach = 0.1_wp !! of the longest side of a face of SIDE1

   !> Coverage of SIDE1 by SIDE2, face by face.
   type, public :: side_cover
      type(joint_cover) :: cover             !! of the whole side
      logical  :: is_any = .false.           !! whether anything is covered
      integer  :: double = 0                 !! a face of SIDE1 that is covered twice, 0: none
      real(wp) :: double_share = 0.0_wp      !! its covered share
      real(wp) :: reach = 0.0_wp             !! largest reach of the search [length]
      logical, allocatable :: partly(:)      !! (nodes of SIDE1) at a face that is partly covered
   end type side_cover

   !> The faces of SIDE2 for the search.
   type :: opposite_faces
      type(spatial_search_type) :: boxes
      real(wp), allocatable :: normal(:, :)  ! (3, n) at their centres
      real(wp), allocatable :: area(:)       ! (n) area projected along their normals
      logical, allocatable  :: covers(:)     ! (n) whether it covers any part of SIDE1
   end type opposite_faces

contains

   !> For every node of side 1 the coincident node of side 2.
   subroutine pair_nodes(model, surface, side1, side2, tol, partner, fault)
      type(model_type), intent(in)        :: model
      integer, intent(in)                 :: surface(2)   !! of the model
      type(surface_node_list), intent(in) :: side1, side2 !! their nodes
      real(wp), intent(in)                :: tol          !! 0: the default [length]
      integer, intent(inout)              :: partner(:)
      type(pairing_fault), intent(out)    :: fault
      type(spatial_search_type) :: search
      real(wp) :: tolerance, distance, worst
      integer  :: k, found, lonely, shared, turned, worst_node
      logical, allocatable :: taken(:)
      character(:), allocatable :: place

      fault%words = ''
      tolerance = tol
      if (tol <= 0.0_wp) then
         associate (side => model%surfaces(surface(1)))
            tolerance = default_tolerance*minval([(minval(edge_lengths(model%x(:, side%nodes(:side%corners(k), k)))), &
                                                   k = 1, side%n)])
         end associate
      end if
      call search%build(model%x(:, side2%node))
      allocate (taken(side2%n), source=.false.)
      lonely = 0
      turned = 0
      shared = 0
      worst = 0.0_wp
      worst_node = 0
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
                       ' of SIDE1 have the partner of another node'
      else if (turned > 0) then
         fault%words = 'the sides do not face each other: at '//plural(turned, 'node')// &
            ' their normals are not opposite'
      else if (side2%n /= side1%n) then
         fault%words = 'SIDE2 has '//plural(side2%n, 'node')//', SIDE1 '//integer_text(side1%n)//': every node needs its partner'
      else if (.not. same_order(model, surface, side1, partner)) then
         fault%words = 'mid-side nodes face corner nodes: one side is of second order, the other is not'
      end if
   end subroutine pair_nodes

   !> Whether corners have corners as partners, and mid-side nodes have mid-side nodes.
   pure logical function same_order(model, surface, side1, partner)
      type(model_type), intent(in)        :: model
      integer, intent(in)                 :: surface(2)
      type(surface_node_list), intent(in) :: side1
      integer, intent(in)                 :: partner(:) !! of its nodes, all different
      type(id_table_type) :: between(2) ! mid-side nodes
      integer :: k, s

      do k = 1, 2
         associate (side => model%surfaces(surface(k)))
            call between(k)%build([(side%nodes(side%corners(s) + 1:side%n_nodes(s), s), s = 1, side%n)])
         end associate
      end do
      same_order = all([(between(1)%find(side1%node(k)) > 0 .eqv. between(2)%find(partner(k)) > 0, k = 1, side1%n)])
   end function same_order

   !> The mortar projection of the elements at the NODES of SIDE1. REACH of the search along the normal, 0: the default.
   subroutine fit_side(model, side1, side2, nodes, reach, sums, found)
      type(model_type), intent(in)             :: model
      type(surface_type), intent(in)           :: side1, side2
      type(surface_node_list), intent(in)      :: nodes !! of SIDE1
      real(wp), intent(in)                     :: reach
      type(interface_sums_type), intent(inout) :: sums  !! empty
      type(side_cover), intent(out)            :: found
      type(opposite_faces)  :: opposite
      type(id_table_type)   :: place
      type(plane_points)    :: points
      type(cover_integrals) :: integrals
      type(face_part)       :: part
      type(own_face)        :: face
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes), share, all_area
      integer  :: elements(max_side_nodes), k, n, own_parts, s
      integer, allocatable :: near(:)

      found%cover%fitted = .true.
      found%cover%share = 0.0_wp
      call place%build(nodes%node)
      call sums%start(nodes%n, model%n_nodes)
      call list_opposite(model, side2, opposite)
      allocate (found%partly(nodes%n), source=.false.)
      allocate (near(0))
      all_area = 0.0_wp
      own_parts = 0
      do s = 1, side1%n
         n = side1%n_nodes(s)
         call side_influence(model, side1, s, area, normal)
         all_area = all_area + sum(area)
         call set_own_face(model, side1, s, reach, face)
         found%reach = max(found%reach, face%reach)
         call cover_face(model, side2, face, opposite, near, points, integrals)
         share = integrals%seen/max(seen_area(face%seen), tiny(1.0_wp))
         if (share > max(twice, found%double_share)) then
            found%double = s
            found%double_share = share
         end if
         if (integrals%seen <= 0.0_wp) cycle
         found%is_any = .true.
         own_parts = own_parts + n_parts(model%dimension, n)
         found%cover%spacing(1) = found%cover%spacing(1) + seen_area(face%seen)
         call fit_face(model%dimension, n, share >= whole_share, integrals, part)
         do k = 1, n
            elements(k) = place%find(side1%nodes(k, s))
            if (share < whole_share) found%partly(elements(k)) = .true.
         end do
         call sums%add_face(elements(:n), side1%nodes(:n, s), integrals%node(:integrals%n), part)
         found%cover%share = found%cover%share + merge(1.0_wp, share, share >= whole_share)*sum(area)
         found%cover%farthest = max(found%cover%farthest, integrals%farthest)
      end do
      call sums%finish()
      found%cover%share = found%cover%share/max(all_area, tiny(1.0_wp))
      found%cover%spacing(1) = found%cover%spacing(1)/max(1, own_parts)
      found%cover%spacing(2) = sum(opposite%area, mask=opposite%covers) &
                         /max(1, sum([(n_parts(model%dimension, side2%n_nodes(s)), s = 1, side2%n)], mask=opposite%covers))
   end subroutine fit_side

   !> The number of linear edges or triangles that a face with N nodes counts for when mesh sizes are compared.
   pure integer function n_parts(dimension, n)
      integer, intent(in) :: dimension, n

      n_parts = n - dimension + 1
   end function n_parts

   !> The faces of SIDE2 for the search.
   subroutine list_opposite(model, side2, opposite)
      type(model_type), intent(in)      :: model
      type(surface_type), intent(in)    :: side2
      type(opposite_faces), intent(out) :: opposite
      type(face_frame) :: frame
      real(wp), allocatable :: box(:, :, :)
      integer :: s

      allocate (box(3, 2, side2%n), opposite%normal(3, side2%n), opposite%area(side2%n))
      allocate (opposite%covers(side2%n), source=.false.)
      do s = 1, side2%n
         associate (x => model%x(:, side2%nodes(:side2%n_nodes(s), s)))
            box(:, 1, s) = minval(x, dim=2)
            box(:, 2, s) = maxval(x, dim=2)
            call make_frame(model%dimension, x, frame)
            opposite%area(s) = seen_area(in_frame(model%dimension, x, frame))
         end associate
         opposite%normal(:, s) = frame%axes(:, 3)
      end do
      call opposite%boxes%build(box)
   end subroutine list_opposite

   !> Face S of SIDE1 in its own frame.
   subroutine set_own_face(model, side1, s, reach, face)
      type(model_type), intent(in)   :: model
      type(surface_type), intent(in) :: side1
      integer, intent(in)            :: s
      real(wp), intent(in)           :: reach
      type(own_face), intent(out)    :: face
      real(wp) :: longest

      associate (x => model%x(:, side1%nodes(:side1%n_nodes(s), s)))
         call make_frame(model%dimension, x, face%frame)
         face%seen = in_frame(model%dimension, x, face%frame)
         longest = maxval(edge_lengths(x(:, :side1%corners(s))))
      end associate
      face%on_ring = model%axisymmetric
      if (model%dimension == 2) face%thickness = model%properties(model%element_property(side1%element(s)))%thickness
      face%reach = merge(reach, default_reach*longest, reach > 0.0_wp)
   end subroutine set_own_face

   !> INTEGRALS over the part of FACE that SIDE2 covers.
   subroutine cover_face(model, side2, face, opposite, near, points, integrals)
      type(model_type), intent(in)         :: model
      type(surface_type), intent(in)       :: side2
      type(own_face), intent(in)           :: face
      type(opposite_faces), intent(inout)  :: opposite
      integer, allocatable, intent(inout)  :: near(:)
      type(plane_points), intent(inout)    :: points
      type(cover_integrals), intent(inout) :: integrals
      real(wp) :: low(3), high(3), before
      integer  :: d, i, n

      call start_integrals(integrals)
      do d = 1, 3
         associate (x => face%frame%centre(d) + matmul(face%frame%axes(d, :), face%seen%x(:, :face%seen%n)))
            low(d) = minval(x) - face%reach
            high(d) = maxval(x) + face%reach
         end associate
      end do
      call opposite%boxes%list_meeting(low, high, near, n)
      do i = 1, n
         associate (f => near(i))
            if (dot_product(opposite%normal(:, f), face%frame%axes(:, 3)) > facing) cycle
            before = integrals%seen
            associate (nodes => side2%nodes(:side2%n_nodes(f), f))
               call add_overlap(face, in_frame(model%dimension, model%x(:, nodes), face%frame), nodes, points, integrals)
            end associate
            if (integrals%seen > before) opposite%covers(f) = .true.
         end associate
      end do
   end subroutine cover_face

end module node_pairing
