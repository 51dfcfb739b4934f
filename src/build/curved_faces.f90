!> The curved surface that linear faces of a mesh stand for: each edge is the chord of an arc.
!! Two cylinders that touch, drawn with chords of different lengths, overlap in the mesh by the difference of their sagittas. The
!! normals of the surface at nodes, from the faces around, give the angle between a chord and the tangents of its arc:
!!
!!               . - ' ' - .             L chord, theta angle of its tangents at both ends
!!          . '      h       ' .         h = L^2 xi (1 - xi) sin theta/(sqrt(L^2/4 - u^2 sin^2 theta) + L/2 cos theta),
!!        o---------------------o        u = (xi - 1/2) L, the sagitta L/2 tan(theta/2)
!!
!! The smaller angle of the two ends counts, and none where they have different signs, so that a flat face beside a fillet stays
!! flat. Between edges the heights are blended (Coons; Farin, Curves and Surfaces for CAGD). Weights of the normals: Max, Weights
!! for computing vertex normals from facet normals, Journal of Graphics Tools 4 (1999) 1; they are exact on circles and spheres.
module curved_faces
   use face_overlap, only: edge_lengths, face_frame, make_frame
   use kinds, only: wp
   use lists, only: list_owners
   use model_data, only: mesh_type, surface_type
   use numbers, only: cross
   use tolerances, only: level_tangent
   implicit none
   private

   public :: find_tilts, height_over_chords, largest_sagitta

   real(wp), parameter, public :: smooth = 0.76_wp !! cosine of the angle between faces of one smooth surface, at least: 40 degrees

contains

   !> The angle of the tangents of each edge of each face of SURFACE, edge k from corner k to the next; > 0 where the surface bulges
   !! out of its body. Faces of second order are curved themselves: zero.
   pure subroutine find_tilts(mesh, surface, tilt)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)     :: surface
      real(wp), allocatable, intent(out) :: tilt(:, :) !! (4, faces) [rad]
      type(face_frame) :: frames(surface%n)
      integer, allocatable :: first(:), owners(:)
      real(wp) :: ends(2)
      logical  :: goes_on(2)
      integer  :: a, b, k, n, s

      allocate (tilt(4, surface%n), source=0.0_wp)
      if (any(surface%n_nodes(:surface%n) /= surface%corners(:surface%n))) return
      do s = 1, surface%n
         call make_frame(mesh%dimension, mesh%x(:, surface%nodes(:surface%corners(s), s)), frames(s))
      end do
      call list_owners(mesh%n_nodes, surface%nodes(:, :surface%n), first, owners)
      do s = 1, surface%n
         n = surface%corners(s)
         do k = 1, merge(1, n, n == 2)
            a = surface%nodes(k, s)
            b = surface%nodes(modulo(k, n) + 1, s)
            call tilt_at(a, b, ends(1), goes_on(1))
            call tilt_at(b, a, ends(2), goes_on(2))
            if (.not. any(goes_on)) cycle
            if (.not. goes_on(1)) ends(1) = ends(2) ! the surface ends there: the arc goes on
            if (.not. goes_on(2)) ends(2) = ends(1)
            if (ends(1)*ends(2) <= 0.0_wp) cycle
            tilt(k, s) = sign(min(abs(ends(1)), abs(ends(2))), ends(1))
            if (abs(tilt(k, s)) < level_tangent) tilt(k, s) = 0.0_wp
         end do
      end do

   contains

      !> The angle THETA between the edge of face s from node AT to node TO and the tangent of the surface at AT; whether the surface
      !! goes on beyond AT.
      pure subroutine tilt_at(at, to, theta, goes_on)
         integer, intent(in)   :: at, to
         real(wp), intent(out) :: theta
         logical, intent(out)  :: goes_on
         real(wp) :: along(3), normal(3)
         integer  :: i

         normal = 0.0_wp
         goes_on = .false.
         associate (face_normal => frames(s)%axes(:, 3))
            along = mesh%x(:, to) - mesh%x(:, at)
            along = along - dot_product(along, face_normal)*face_normal
            along = along/max(norm2(along), tiny(1.0_wp))
            do i = first(at), first(at + 1) - 1
               associate (other => frames(owners(i)))
                  if (dot_product(other%axes(:, 3), face_normal) < smooth) cycle
                  normal = normal + weight_at(mesh, surface, owners(i), at)*other%axes(:, 3)
                  if (dot_product(other%centre - mesh%x(:, at), along) < -level_tangent*norm2(other%centre - mesh%x(:, at))) &
                     goes_on = .true.
               end associate
            end do
            theta = atan2(-dot_product(normal, along), dot_product(normal, face_normal))
         end associate
      end subroutine tilt_at

   end subroutine find_tilts

   !> The weight of the normal of face S of SURFACE at its corner NODE: sin of the angle there over the lengths of both edges.
   pure real(wp) function weight_at(mesh, surface, s, node) result(weight)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in) :: surface
      integer, intent(in)            :: s, node
      real(wp) :: a(3), b(3)
      integer  :: k, n

      n = surface%corners(s)
      associate (nodes => surface%nodes(:n, s))
         k = findloc(nodes, node, dim=1)
         a = mesh%x(:, nodes(modulo(k, n) + 1)) - mesh%x(:, node)
         b = mesh%x(:, nodes(modulo(k - 2, n) + 1)) - mesh%x(:, node)
      end associate
      weight = 1.0_wp/norm2(a)
      if (n > 2) weight = norm2(cross(a, b))/max(sum(a**2)*sum(b**2), tiny(1.0_wp))
   end function weight_at

   !> The height of the surface over a face with corners X and the tangent angles TILT, at the local coordinates POINT [length].
   pure real(wp) function height_over_chords(x, tilt, point) result(height)
      real(wp), intent(in) :: x(:, :)  !! (3, corners) [length]
      real(wp), intent(in) :: tilt(4)  !! [rad]
      real(wp), intent(in) :: point(3) !! in an edge, a triangle or a quadrilateral, as in element_kinds
      real(wp) :: lengths(size(x, 2)), l(3), share, xi, eta
      integer  :: k, next

      height = 0.0_wp
      if (.not. any(abs(tilt) > 0.0_wp)) return
      lengths = edge_lengths(x)
      xi = 0.5_wp*(1.0_wp + point(1))
      eta = 0.5_wp*(1.0_wp + point(2))
      select case (size(x, 2))
      case (2)
         height = arc(lengths(1), tilt(1), xi)
      case (3)
         l = [1.0_wp - point(1) - point(2), point(1), point(2)]
         do k = 1, 3
            next = modulo(k, 3) + 1
            share = l(k) + l(next)
            if (abs(share) > level_tangent) height = height + share**2*arc(lengths(k), tilt(k), l(next)/share)
         end do
      case default
         height = (1.0_wp - eta)*arc(lengths(1), tilt(1), xi) + eta*arc(lengths(3), tilt(3), xi) &
                  + (1.0_wp - xi)*arc(lengths(4), tilt(4), eta) + xi*arc(lengths(2), tilt(2), eta)
      end select
   end function height_over_chords

   !> The height of the arc over a chord of LENGTH at the share XI of it.
   pure real(wp) function arc(length, theta, xi)
      real(wp), intent(in) :: length, theta, xi

      arc = 0.0_wp
      if (abs(theta) <= 0.0_wp) return
      arc = length*xi*(1.0_wp - xi)*sin(theta) &
            /(sqrt(max(0.0_wp, 0.25_wp - ((xi - 0.5_wp)*sin(theta))**2)) + 0.5_wp*cos(theta))
   end function arc

   !> The largest sagitta of the edges of a face with corners X, in the sense of its height [length].
   pure real(wp) function largest_sagitta(x, tilt) result(sagitta)
      real(wp), intent(in) :: x(:, :), tilt(4)

      sagitta = maxval(abs(0.5_wp*edge_lengths(x)*tan(0.5_wp*tilt(:size(x, 2)))))
   end function largest_sagitta

end module curved_faces
