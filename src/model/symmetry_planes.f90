!> Planes of symmetry of a half or quarter model, or of a sector, known from its supports.
!! A plane bounds the model on one side. All nodes of elements on it are held along its normal, none of them is moved along it, and
!! at least half of them are held along the normals of such planes only: a clamped face is no plane of symmetry. Where a plane cuts
!! a bolt, or the bodies on both sides of a joint, the mirror image balances the forces along its normal, and the moments about the
!! lines in the plane.
module symmetry_planes
   use kinds, only: wp
   use lists, only: distinct
   use mesh_queries, only: n_points
   use model_data, only: freedoms_type, model_type, supported
   use numbers, only: cross
   use tolerances, only: on_symmetry_plane, one_direction, parallel_in_mesh
   use unknowns, only: node_axes
   implicit none
   private

   public :: find_planes, planes_through, parts_cut, cut_by, free_part, axis_part, onto_planes

   type, public :: symmetry_plane
      real(wp) :: normal(3) = 0.0_wp         !! unit, into the model
      real(wp) :: offset = 0.0_wp            !! x . normal of its points [length]
      real(wp) :: near = 0.0_wp              !! distance within which a node lies on it [length]
   end type symmetry_plane

   !> A plane through supported nodes.
   type :: candidate_type
      type(symmetry_plane) :: plane
      real(wp) :: base(3) = 0.0_wp           !! one of these nodes [length]
      real(wp) :: along(3) = 0.0_wp          !! unit vector from there to another of them
      logical  :: has_line = .false.         !! there is one
      logical  :: spans = .false.            !! and in space a third one beside their line
   end type candidate_type

   !> The planes that cut something, as orthonormal directions: the first is the normal of the first plane.
   type, public :: cut_type
      integer  :: n = 0                      !! number of directions; planes that are parallel have one
      real(wp) :: direction(3, 3) = 0.0_wp   !! columns
      integer  :: plane(3) = 0               !! the plane of each
   end type cut_type

contains

   !> The PLANES of symmetry of MODEL.
   pure subroutine find_planes(model, planes)
      type(model_type), intent(in)                   :: model
      type(symmetry_plane), allocatable, intent(out) :: planes(:)
      type(candidate_type), allocatable :: found(:)
      logical, allocatable :: counts(:) ! nodes of elements
      integer :: i

      allocate (counts, source=model%mesh%first_at(2:n_points(model%mesh) + 1) > model%mesh%first_at(:n_points(model%mesh)))
      call find_candidates(model, counts, found)
      planes = pack(found%plane, found%spans)
      planes = pack(planes, [(is_held_plane(model, counts, planes(i)), i = 1, size(planes))])
      planes = pack(planes, [(holds_nothing_else(model, counts, planes, planes(i)), i = 1, size(planes))])
   end subroutine find_planes

   !> Planes through nodes that are held along the normal of the plane, with all outermost nodes of the model on one side of it.
   pure subroutine find_candidates(model, counts, found)
      type(model_type), intent(in)                   :: model
      logical, intent(in)                            :: counts(:)
      type(candidate_type), allocatable, intent(out) :: found(:)
      real(wp) :: axes(3, 3), near, offset
      real(wp), allocatable :: beyond(:), outer(:, :)
      logical  :: held(model%mesh%dimension)
      integer  :: d, k, node

      allocate (found(0))
      if (.not. any(counts)) return
      outer = outermost(model, counts)
      near = on_symmetry_plane*maxval(maxval(outer, dim=2) - minval(outer, dim=2))
      do node = 1, size(counts)
         if (.not. counts(node)) cycle
         held = supported(model%mesh, model%freedoms, node)
         if (.not. any(held)) cycle
         axes = node_axes(model%mesh, node)
         do d = 1, model%mesh%dimension
            if (.not. held(d) .or. (model%mesh%axisymmetric .and. abs(axes(1, d)) > one_direction)) cycle
            offset = dot_product(model%mesh%x(:, node), axes(:, d))
            beyond = matmul(axes(:, d), outer) - offset
            if (minval(beyond) < -near) then
               if (maxval(beyond) > near) cycle
               axes(:, d) = -axes(:, d)
               offset = -offset
            else if (.not. maxval(beyond) > near) then
               cycle ! the whole model lies in it
            end if
            do k = 1, size(found)
               if (is_along(found(k)%plane%normal, axes(:, d)) .and. abs(found(k)%plane%offset - offset) <= near) exit
            end do
            if (k > size(found)) found = [found, candidate_type(symmetry_plane(axes(:, d), offset, near), model%mesh%x(:, node))]
            call widen(model%mesh%dimension, model%mesh%x(:, node), found(k))
         end do
      end do
   end subroutine find_candidates

   !> Note that X is another point of a supported node of CANDIDATE.
   pure subroutine widen(dimension, x, candidate)
      integer, intent(in)                 :: dimension
      real(wp), intent(in)                :: x(3)
      type(candidate_type), intent(inout) :: candidate
      real(wp) :: arm(3)

      arm = x - candidate%base
      if (norm2(arm) <= candidate%plane%near) return
      if (.not. candidate%has_line) then
         candidate%has_line = .true.
         candidate%along = arm/norm2(arm)
         candidate%spans = dimension == 2
      else if (norm2(cross(candidate%along, arm)) > candidate%plane%near) then
         candidate%spans = .true.
      end if
   end subroutine widen

   !> (3, n) The positions of the outermost nodes in 13 directions and those against them.
   pure function outermost(model, counts) result(x)
      type(model_type), intent(in) :: model
      logical, intent(in)          :: counts(:)
      real(wp) :: x(3, 26)
      real(wp) :: along(size(counts)), direction(3)
      integer  :: i, n

      n = 0
      do i = 14, 26 ! the digits of i to the base 3, less 1
         direction = real([i/9, mod(i/3, 3), mod(i, 3)] - 1, wp)
         along = matmul(direction, model%mesh%x(:, :size(counts)))
         x(:, n + 1) = model%mesh%x(:, maxloc(along, dim=1, mask=counts))
         x(:, n + 2) = model%mesh%x(:, minloc(along, dim=1, mask=counts))
         n = n + 2
      end do
   end function outermost

   !> Whether unit vectors A and B have one direction, in either sense.
   pure logical function is_along(a, b)
      real(wp), intent(in) :: a(3), b(3)

      is_along = abs(dot_product(a, b)) > 1.0_wp - one_direction
   end function is_along

   !> Whether X lies on PLANE.
   pure logical function is_on(plane, x)
      type(symmetry_plane), intent(in) :: plane
      real(wp), intent(in)             :: x(3)

      is_on = abs(dot_product(plane%normal, x) - plane%offset) <= plane%near
   end function is_on

   !> Whether no node that counts lies beyond PLANE, and all on it are held along its normal and never moved.
   pure logical function is_held_plane(model, counts, plane) result(is_one)
      type(model_type), intent(in)     :: model
      logical, intent(in)              :: counts(:)
      type(symmetry_plane), intent(in) :: plane
      real(wp) :: axes(3, 3)
      logical  :: held(model%mesh%dimension)
      integer  :: d, k, node, s

      is_one = .false.
      do node = 1, size(counts)
         if (.not. counts(node)) cycle
         if (dot_product(plane%normal, model%mesh%x(:, node)) < plane%offset - plane%near) return
         if (.not. is_on(plane, model%mesh%x(:, node))) cycle
         if (size(model%freedoms%left_out) > 0) then
            if (all(model%freedoms%left_out(:, node))) cycle ! moves with other nodes
         end if
         axes = node_axes(model%mesh, node)
         held = supported(model%mesh, model%freedoms, node)
         d = findloc([(held(k) .and. is_along(axes(:, k), plane%normal), k = 1, model%mesh%dimension)], .true., dim=1)
         if (d == 0) return
         if (allocated(model%sets)) then ! of all stages
            if (.not. all([(held_in(model%sets(s)), s = 1, size(model%sets))])) return
         end if
         do s = 1, size(model%history%stages)
            if (.not. allocated(model%history%stages(s)%moved)) cycle
            if (abs(model%history%stages(s)%moved(d, node)) > 0.0_wp) return
         end do
      end do
      is_one = .true.

   contains

      !> Whether FREEDOMS hold component D of NODE.
      pure logical function held_in(freedoms)
         type(freedoms_type), intent(in) :: freedoms
         logical :: held(model%mesh%dimension)

         held = supported(model%mesh, freedoms, node)
         held_in = held(d)
      end function held_in

   end function is_held_plane

   !> Whether at least half of the nodes on PLANE are held along the normals of the PLANES through them only.
   pure logical function holds_nothing_else(model, counts, planes, plane) result(holds)
      type(model_type), intent(in)     :: model
      logical, intent(in)              :: counts(:)
      type(symmetry_plane), intent(in) :: planes(:), plane
      real(wp) :: axes(3, 3)
      logical  :: held(model%mesh%dimension), is_explained
      integer  :: d, k, n, node, n_explained

      n = 0
      n_explained = 0
      do node = 1, size(counts)
         if (.not. counts(node)) cycle
         if (.not. is_on(plane, model%mesh%x(:, node))) cycle
         n = n + 1
         held = supported(model%mesh, model%freedoms, node)
         axes = node_axes(model%mesh, node)
         is_explained = .true.
         do d = 1, model%mesh%dimension
            if (.not. held(d) .or. (model%mesh%axisymmetric .and. abs(model%mesh%x(1, node)) <= plane%near .and. d == 1)) cycle
            is_explained = is_explained .and. any([(is_on(planes(k), model%mesh%x(:, node)) .and. &
                                                    is_along(planes(k)%normal, axes(:, d)), k = 1, size(planes))])
         end do
         if (is_explained) n_explained = n_explained + 1
      end do
      holds = 2*n_explained >= n
   end function holds_nothing_else

   !> The PLANES that cut what has these NODES: at least two of them lie on such a plane, in the plane one.
   pure function planes_through(model, planes, nodes) result(cut)
      type(model_type), intent(in)     :: model
      type(symmetry_plane), intent(in) :: planes(:)
      integer, intent(in)              :: nodes(:)
      type(cut_type) :: cut
      integer, allocatable :: each(:)
      logical :: cuts(size(planes))
      integer :: i, k

      if (size(planes) == 0) return
      call distinct(nodes, each)
      do k = 1, size(planes)
         cuts(k) = count([(is_on(planes(k), model%mesh%x(:, each(i))), i = 1, size(each))]) >= model%mesh%dimension - 1
      end do
      cut = cut_by(planes, cuts)
   end function planes_through

   !> (parts, planes) Which of the PLANES cut the parts: at least two nodes of elements of a part lie on such a plane, in the plane
   !! one.
   pure function parts_cut(model, planes, part, n_parts) result(cuts)
      type(model_type), intent(in)     :: model
      type(symmetry_plane), intent(in) :: planes(:)
      integer, intent(in)              :: part(:) !! (n_nodes) of each node
      integer, intent(in)              :: n_parts
      logical :: cuts(n_parts, size(planes))
      integer :: k, n(n_parts), node

      do k = 1, size(planes)
         n = 0
         do node = 1, n_points(model%mesh)
            if (model%mesh%first_at(node + 1) == model%mesh%first_at(node)) cycle
            if (is_on(planes(k), model%mesh%x(:, node))) n(part(node)) = n(part(node)) + 1
         end do
         cuts(:, k) = n >= model%mesh%dimension - 1
      end do
   end function parts_cut

   !> The directions of those of the PLANES that CUT something.
   pure function cut_by(planes, cuts) result(cut)
      type(symmetry_plane), intent(in) :: planes(:)
      logical, intent(in)              :: cuts(:) !! (planes)
      type(cut_type) :: cut
      real(wp) :: rest(3)
      integer  :: k

      do k = 1, size(planes)
         if (.not. cuts(k)) cycle
         rest = free_part(cut, planes(k)%normal)
         if (norm2(rest) <= parallel_in_mesh) cycle
         cut%n = cut%n + 1
         cut%direction(:, cut%n) = rest/norm2(rest)
         cut%plane(cut%n) = k
      end do
   end function cut_by

   !> VECTOR without the components along the directions of CUT: of a force what the mirror images do not balance.
   pure function free_part(cut, vector) result(rest)
      type(cut_type), intent(in) :: cut
      real(wp), intent(in)       :: vector(3)
      real(wp) :: rest(3)
      integer  :: k

      rest = vector
      do k = 1, cut%n
         rest = rest - dot_product(cut%direction(:, k), vector)*cut%direction(:, k)
      end do
   end function free_part

   !> The part of a moment VECTOR that the mirror images do not balance: that about the normal of the only plane.
   pure function axis_part(cut, vector) result(rest)
      type(cut_type), intent(in) :: cut
      real(wp), intent(in)       :: vector(3)
      real(wp) :: rest(3)

      rest = vector
      if (cut%n == 1) rest = dot_product(cut%direction(:, 1), vector)*cut%direction(:, 1)
      if (cut%n > 1) rest = 0.0_wp
   end function axis_part

   !> X moved onto all PLANES of CUT, across them: the centroid of a part goes to that of the whole.
   pure function onto_planes(cut, planes, x) result(place)
      type(cut_type), intent(in)       :: cut
      type(symmetry_plane), intent(in) :: planes(:)
      real(wp), intent(in)             :: x(3) !! [length]
      real(wp) :: place(3)
      integer  :: k

      place = x
      do k = 1, cut%n
         associate (plane => planes(cut%plane(k)), along => cut%direction(:, k))
            place = place + (plane%offset - dot_product(plane%normal, place))/dot_product(plane%normal, along)*along
         end associate
      end do
   end function onto_planes

end module symmetry_planes
