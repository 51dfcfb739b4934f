!> Shells tied to solids without a joint, SHELLTO: the nodes of a marked edge of shells move with a marked face.
!!
!! Each side of the edge gives its two nodes four points of the footprint of the shell on the face: half a thickness above and
!! below the node, and as far along the edge in both senses, at an end of the edge beyond it: the node is amid its points, so that
!! a strain of the face does not move it against them. The shape functions of the face move these points; the node has the rigid-body motion
!! that fits them best (mean_motion). Its rotations are therefore those of the face over the thickness, and its forces and moments
!! act on the face in equilibrium. Edges between linear shells and shells of second order are tied likewise.
module shell_ties
   use constraint_equations, only: add_dependence, add_term, dependence_list
   use deck_check, only: checked_deck
   use element_kinds, only: kind_tria3, kind_tria6, max_nodes, max_side_nodes
   use face_overlap, only: face_frame, find_point, in_frame, make_frame, map_point, seen_face
   use kinds, only: wp
   use mesh_queries, only: element_points, is_shell
   use model_data, only: mesh_type, surface_type
   use numbers, only: identity
   use rigid_fit, only: mean_motion
   use shell_element, only: node_normal, node_thickness
   use surface_build, only: find_surface
   use text_tools, only: integer_text, real_text
   use unknowns, only: component_place, node_axes, place_of_component
   implicit none
   private

   public :: add_middles, add_ties, find_ties

   integer, parameter :: most_points = 24 !! of a node: four for each side of the edge at it

   !> A node of a shell and the points of a face to which it is tied.
   type, public :: tie_type
      integer  :: line = 0, node = 0
      integer  :: n = 0                                 !! number of points
      real(wp) :: arm(3, most_points) = 0.0_wp          !! of the points from the node [length]
      integer  :: at(8, most_points) = 0                !! nodes of the face at the points, 0 behind the last
      real(wp) :: share(8, most_points) = 0.0_wp           !! shape functions of the face there [-]
   end type tie_type

contains

   !> The TIES of all SHELLTO cards, before edges of shells are cut into strips. Errors: surfaces that are not an edge of shells and
   !! a face of solids, or whose distance exceeds the thickness of the shell.
   subroutine find_ties(deck, mesh, ties)
      type(checked_deck), intent(in)           :: deck
      type(mesh_type), intent(in) :: mesh
      type(tie_type), allocatable, intent(out) :: ties(:)
      integer :: edge, face, i, s

      allocate (ties(0))
      do i = 1, size(deck%bulk%tie)
         associate (card => deck%bulk%tie(i))
            if (any(card%surfaces == 0)) cycle ! reported already
            call find_surface(deck, card%line, 'PID1', card%surfaces(1), mesh, edge)
            call find_surface(deck, card%line, 'PID2', card%surfaces(2), mesh, face)
            if (edge == 0 .or. face == 0) cycle
            associate (side => mesh%surfaces(edge), base => mesh%surfaces(face))
               if (any([(side%corners(s) /= 2 .or. .not. is_shell(mesh, side%element(s)), s = 1, side%n)])) then
                  call deck%field_error(card%line, 'PID1', 'surface '//integer_text(side%id)//' is no edge of shells; '// &
                                        'expected CBAR or CROD on free edges of shells')
               else if (any([(base%corners(s) == 2 .or. is_shell(mesh, base%element(s)), s = 1, base%n)])) then
                  call deck%field_error(card%line, 'PID2', 'surface '//integer_text(base%id)//' is not of solids; '// &
                                        'expected CTRIA3 or CQUAD4 on faces of solids')
               else
                  call tie(deck, mesh, card%line, side, base, ties)
               end if
            end associate
         end associate
      end do
   end subroutine find_ties

   !> Add the ties of the nodes of the edge SIDE to the face BASE, for a card on LINE.
   subroutine tie(deck, mesh, line, side, base, ties)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)             :: line
      type(surface_type), intent(in)  :: side, base
      type(tie_type), allocatable, intent(inout) :: ties(:)
      type(tie_type), allocatable :: added(:)
      type(face_frame)  :: frames(base%n)
      real(wp) :: along(3), arms(3, 4), farthest, miss, normal(3), t, thickness(max_side_nodes)
      integer  :: k, n, node, of_node(mesh%n_nodes), p, pair(2, 4), s

      do s = 1, base%n
         call make_frame(3, mesh%x(:, base%nodes(:base%n_nodes(s), s)), frames(s))
      end do
      allocate (added(3*side%n))
      of_node = 0
      n = 0
      do s = 1, side%n
         associate (corners => element_points(mesh, side%element(s)), &
                    law => mesh%structural%shells(mesh%structural%place(side%element(s))))
            thickness(:size(corners)) = node_thickness(law, size(corners))
            pair = reshape([1, 3, 3, 1, 3, 2, 2, 3], [2, 4]) ! an edge of three nodes has two parts
            if (side%n_nodes(s) == 2) pair(:, :2) = reshape([1, 2, 2, 1], [2, 2])
            do k = 1, 2*side%n_nodes(s) - 2 ! both ends of each part
               node = side%nodes(pair(1, k), s)
               along = mesh%x(:, side%nodes(pair(2, k), s)) - mesh%x(:, node)
               t = thickness(findloc(corners, node, dim=1))
               normal = node_normal(mesh%x(:, corners), findloc(corners, node, dim=1))
               along = along/norm2(along)
               arms = spread(law%offset*normal, 2, 4) + 0.5_wp*t*reshape([normal, -normal, along, -along], [3, 4])
               if (of_node(node) == 0) then
                  n = n + 1
                  of_node(node) = n
                  added(n) = tie_type(line=line, node=node)
               end if
               farthest = 0.0_wp
               do p = 1, size(arms, 2)
                  call attach_point(mesh, base, frames, arms(:, p), added(of_node(node)), miss)
                  farthest = max(farthest, miss)
               end do
               if (farthest <= t) cycle
               call deck%field_error(line, 'PID1', 'node '//integer_text(mesh%node_id(node))//' of the edge lies '// &
                  real_text(farthest)//' from surface '//integer_text(base%id)//'; expected no more than the thickness of '// &
                  'the shell')
               return
            end do
         end associate
      end do
      ties = [ties, added(:n)]
   end subroutine tie

   !> Add to TIE the point of BASE, whose sides have FRAMES, nearest to the position at ARM from its node; MISS is the distance.
   pure subroutine attach_point(mesh, base, frames, arm, tie, miss)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in) :: base
      type(face_frame), intent(in)   :: frames(:)
      real(wp), intent(in)           :: arm(3)  !! [length]
      type(tie_type), intent(inout)  :: tie
      real(wp), intent(out)          :: miss    !! [length]
      type(seen_face) :: face
      real(wp) :: beyond, place(3), point(3), share(max_nodes), size_of, there(3)
      logical  :: is_found
      integer  :: s

      miss = huge(1.0_wp)
      if (tie%n == most_points) return
      tie%n = tie%n + 1
      tie%arm(:, tie%n) = arm
      do s = 1, base%n
         associate (nodes => base%nodes(:base%n_nodes(s), s))
            size_of = norm2(mesh%x(:, nodes(1)) - frames(s)%centre)
            place = matmul(mesh%x(:, tie%node) + arm - frames(s)%centre, frames(s)%axes)
            if (norm2(place) - 2.0_wp*size_of >= miss) cycle
            face = in_frame(3, mesh%x(:, nodes), frames(s))
            call find_point(face, place(:2), point, is_found)
            if (.not. is_found) cycle
            call map_point(face, point, share, there)
            if (face%kind == kind_tria3 .or. face%kind == kind_tria6) then
               beyond = max(-point(1), -point(2), point(1) + point(2) - 1.0_wp, 0.0_wp)
            else
               beyond = max(maxval(abs(point(:2))) - 1.0_wp, 0.0_wp)
            end if
            beyond = beyond*size_of + abs(place(3) - there(3))
            if (beyond >= miss) cycle
            miss = beyond
            tie%at(:, tie%n) = 0
            tie%at(:size(nodes), tie%n) = nodes
            tie%share(:size(nodes), tie%n) = share(:size(nodes))
         end associate
      end do
   end subroutine attach_point

   !> The constraint equations of TIES, for all six components of their nodes.
   subroutine add_ties(mesh, ties, list)
      type(mesh_type), intent(in) :: mesh
      type(tie_type), intent(in)           :: ties(:)
      type(dependence_list), intent(inout) :: list
      real(wp) :: axes(3, 3), directions(3, 3), row(3), t(6, 3, most_points)
      logical  :: determined(6)
      type(component_place) :: place
      integer  :: c, digit, first, i, k, p

      do i = 1, size(ties)
         associate (tie => ties(i), n => ties(i)%n)
            call mean_motion(tie%arm(:, :n), spread(identity, 3, n), spread(spread(.true., 1, 3), 2, n), spread(1.0_wp, 1, n), &
                             t(:, :, :n), determined)
            axes = node_axes(mesh, tie%node)
            do digit = 1, 6
               place = place_of_component(mesh, tie%node, digit)
               call add_dependence(list, place, tie%line, 1)
               first = merge(0, 3, digit <= 3)
               do p = 1, n
                  row = place%scale*matmul(axes(:, digit - first), t(first + 1:first + 3, :, p))
                  do k = 1, count(tie%at(:, p) > 0)
                     directions = node_axes(mesh, tie%at(k, p))
                     do c = 1, 3
                        call add_term(list, component_place(tie%at(k, p), c), tie%share(k, p)*dot_product(row, directions(:, c)))
                     end do
                  end do
               end do
            end do
         end associate
      end do
   end subroutine add_ties

   !> The nodes at the middle of edges between linear shells and shells of second order move as the linear shell does: by half of
   !! both ends, displacements and rotations. Components that are held stay held.
   subroutine add_middles(mesh, held, list)
      type(mesh_type), intent(in)          :: mesh
      logical, intent(in)                  :: held(:, :) !! (dimension, n_nodes)
      type(dependence_list), intent(inout) :: list
      type(component_place) :: at_end, place
      real(wp) :: axes(3, 3), directions(3, 3)
      integer  :: c, d, first, i, k, node

      do i = 1, size(mesh%middles, 2)
         node = mesh%element_nodes(mesh%middles(1, i), mesh%middles(2, i))
         axes = node_axes(mesh, node)
         do c = 1, 6
            place = place_of_component(mesh, node, c)
            if (held(place%d, place%node)) cycle
            call add_dependence(list, place, mesh%middles(5, i), 1)
            first = merge(0, 3, c <= 3)
            do k = 3, 4
               directions = node_axes(mesh, mesh%middles(k, i))
               do d = 1, 3
                  at_end = place_of_component(mesh, mesh%middles(k, i), first + d)
                  call add_term(list, component_place(at_end%node, at_end%d), 0.5_wp*place%scale/at_end%scale* &
                                dot_product(axes(:, c - first), directions(:, d)))
               end do
            end do
         end do
      end do
   end subroutine add_middles

end module shell_ties
