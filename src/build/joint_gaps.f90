!> The initial gaps of the joints, from JGAP cards to the interface elements.
!! Gaps at scattered points of a plane are interpolated linearly on the triangles of the Delaunay triangulation of the points; for
!! collinear points along their line. Outside the convex hull the value at the nearest point of the hull holds. The interpolation is
!! continuous and exact for linear values.
!!
!! The triangle around a place is found without the triangulation. With all points lifted onto the paraboloid z = x**2 + y**2, it is
!! the lowest triangle above the place. Starting from any triangle around the place, the point farthest below its plane replaces one
!! of the corners until no point is below (simplex method). For points on a grid both diagonals of a square are equally low.
!! Therefore the paraboloid is slightly tilted, in a direction that no grid is likely to have, and one diagonal is lower everywhere.
!! For squares for which the tilt makes no difference (turned by half a radian) points are lowered by infinitesimal amounts, the
!! first by most, each next one by much less (simulation of simplicity: Edelsbrunner and Muecke, ACM Transactions on Graphics 9
!! (1990) 66).
module joint_gaps
   use bulk_data, only: jgap_card
   use deck_check, only: checked_deck
   use interface_operator, only: at_first_end, joint_movement, nodes_of_end
   use joint_sides, only: joint_axes, joint_centroid
   use kinds, only: wp
   use model_data, only: joint_type, joints_type, mesh_type
   use text_tools, only: integer_text, real_text
   use tolerances, only: flat_height, off_square, same_gap_point, touching_faces
   implicit none
   private

   public :: warn_of_distance, build_gaps

   real(wp), parameter :: apart = 0.01_wp ! of the size of a face: a larger distance gives a warning
   real(wp), parameter :: oblique(2) = off_square*[0.54_wp, 0.84_wp] ! cos, sin of 1: no difference for squares turned by 1/2

   type, public :: gap_table_type
      private
      real(wp), allocatable :: x(:, :)         ! (2, n) relative to the centre, divided by the extent
      real(wp), allocatable :: height(:)       ! (n) on the paraboloid
      real(wp), allocatable :: values(:)       ! (n)
      integer, allocatable  :: outline(:)      ! corners of the convex hull, counter-clockwise; none: all points collinear
      real(wp) :: centre(2) = 0.0_wp, extent = 1.0_wp
      real(wp) :: along(2) = 0.0_wp            ! direction of the line of collinear points; zero: a single point
   contains
      procedure :: build
      procedure :: value_at
   end type gap_table_type

contains

   !> The table of VALUES at the points X(2, n). TWICE: two coincident points, and the table must not be used; 0: there are none.
   pure subroutine build(self, x, values, twice)
      class(gap_table_type), intent(inout) :: self
      real(wp), intent(in)                 :: x(:, :), values(:)
      integer, intent(out)                 :: twice(2)
      integer :: far, i, k

      self%centre = sum(x, dim=2)/size(x, 2)
      self%extent = maxval(maxval(x, dim=2) - minval(x, dim=2))
      if (self%extent <= 0.0_wp) self%extent = 1.0_wp
      self%x = (x - spread(self%centre, 2, size(x, 2)))/self%extent
      self%values = values
      twice = 0
      do i = 1, size(values)
         do k = i + 1, size(values)
            if (maxval(abs(self%x(:, i) - self%x(:, k))) > same_gap_point) cycle
            twice = [i, k]
            return
         end do
      end do
      self%height = sum(self%x**2, dim=1) + oblique(1)*(self%x(1, :)**2 - self%x(2, :)**2) &
                    + 2.0_wp*oblique(2)*self%x(1, :)*self%x(2, :)
      self%outline = [integer ::]
      self%along = 0.0_wp
      if (size(values) == 1) return
      far = maxloc(sum((self%x - spread(self%x(:, 1), 2, size(values)))**2, dim=1), dim=1)
      self%along = (self%x(:, far) - self%x(:, 1))/norm2(self%x(:, far) - self%x(:, 1))
      if (any([(abs(cross(self%along, self%x(:, i) - self%x(:, 1))) > same_gap_point, i = 1, size(values))])) &
         call find_outline(self)
   end subroutine build

   !> The corners of the convex hull, from the leftmost on: no point lies to the right of the line to the next corner. Points within
   !! SAME_GAP_POINT of a side lie on it and are no corners, because triangles of three such points would have no area.
   pure subroutine find_outline(self)
      class(gap_table_type), intent(inout) :: self
      real(wp) :: right
      integer  :: first, i, next, now

      first = 1
      do i = 2, size(self%values)
         if (self%x(1, i) < self%x(1, first) - same_gap_point .or. (abs(self%x(1, i) - self%x(1, first)) <= same_gap_point &
             .and. self%x(2, i) < self%x(2, first))) first = i
      end do
      now = first
      do while (size(self%outline) < size(self%values))
         self%outline = [self%outline, now]
         next = merge(2, 1, now == 1)
         do i = 1, size(self%values)
            if (i == now .or. i == next) cycle
            associate (here => self%x(:, i) - self%x(:, now), there => self%x(:, next) - self%x(:, now))
               right = cross(here, there)/max(norm2(here), norm2(there))
               if (right > same_gap_point .or. (abs(right) <= same_gap_point .and. norm2(here) > norm2(there))) next = i
            end associate
         end do
         now = next
         if (now == first) exit
      end do
   end subroutine find_outline

   !> The value at the place X; outside the convex hull that at the nearest point of the hull.
   pure real(wp) function value_at(self, x) result(value)
      class(gap_table_type), intent(in) :: self
      real(wp), intent(in)              :: x(2)
      real(wp) :: place(2), side(2), on_side(2), nearest(2), least, weights(3), at(size(self%values)), share, t
      integer  :: before, behind, corners(3), k, n
      logical  :: outside

      place = (x - self%centre)/self%extent
      n = size(self%outline)
      if (n == 0) then ! all points lie on a line: interpolate between the neighbours along it
         t = dot_product(place - self%x(:, 1), self%along)
         at = [(dot_product(self%along, self%x(:, k) - self%x(:, 1)), k = 1, size(at))]
         before = maxloc(at, mask=at <= t, dim=1)
         behind = minloc(at, mask=at > t, dim=1)
         if (before == 0) before = behind
         if (behind == 0) behind = before
         share = 0.0_wp
         if (behind /= before) share = (t - at(before))/(at(behind) - at(before))
         value = (1.0_wp - share)*self%values(before) + share*self%values(behind)
         return
      end if
      outside = .false.
      nearest = place
      least = huge(least)
      do k = 1, n
         associate (from => self%x(:, self%outline(k)), to => self%x(:, self%outline(modulo(k, n) + 1)))
            side = to - from
            if (cross(side, place - from) < 0.0_wp) outside = .true.
            on_side = from + side*min(1.0_wp, max(0.0_wp, dot_product(place - from, side)/dot_product(side, side)))
         end associate
         if (norm2(on_side - place) >= least) cycle
         least = norm2(on_side - place)
         nearest = on_side
      end do
      if (outside) place = nearest
      call find_triangle(self, place, corners, weights)
      value = dot_product(weights, self%values(corners))
   end function value_at

   !> The Delaunay triangle around PLACE, which is inside the convex hull: its CORNERS, and the WEIGHTS of their values there.
   pure subroutine find_triangle(self, place, corners, weights)
      class(gap_table_type), intent(in) :: self
      real(wp), intent(in)              :: place(2)
      integer, intent(out)              :: corners(3)
      real(wp), intent(out)             :: weights(3)
      real(wp) :: found(3), best, lowest, above, share(3), ratio
      integer  :: entering, exchanges, i, k, leaving

      best = -huge(best)
      do k = 2, size(self%outline) - 1
         found = shares(self%x(:, self%outline([1, k, k + 1])), place)
         if (minval(found) <= best) cycle
         best = minval(found)
         corners = self%outline([1, k, k + 1])
      end do
      do exchanges = 1, 10*size(self%values)
         lowest = 0.0_wp
         entering = 0
         do i = 1, size(self%values)
            if (any(corners == i)) cycle
            share = shares(self%x(:, corners), self%x(:, i))
            above = self%height(i) - dot_product(share, self%height(corners))
            if (abs(above) <= flat_height) then
               ! in the plane, the first of the four points decides, because it is lowered most: it is point i itself, or a corner
               ! with which the plane at i falls or rises
               k = minloc(corners, mask=abs(share) > same_gap_point, dim=1)
               above = merge(-flat_height, 0.0_wp, i < corners(k) .or. share(k) < 0.0_wp)
            end if
            if (above >= lowest) cycle
            lowest = above
            entering = i
         end do
         if (entering == 0) exit
         weights = max(0.0_wp, shares(self%x(:, corners), place))
         share = shares(self%x(:, corners), self%x(:, entering))
         leaving = maxloc(share, dim=1)
         ratio = weights(leaving)/share(leaving)
         do k = 1, 3
            if (share(k) <= same_gap_point) cycle
            if (weights(k)/share(k) >= ratio) cycle
            leaving = k
            ratio = weights(k)/share(k)
         end do
         corners(leaving) = entering
      end do
      weights = max(0.0_wp, shares(self%x(:, corners), place))
      weights = weights/sum(weights)
   end subroutine find_triangle

   !> Barycentric coordinates of a PLACE with respect to three CORNERS(2, 3); their sum is 1.
   pure function shares(corners, place)
      real(wp), intent(in) :: corners(:, :), place(2)
      real(wp) :: shares(3), a(2), b(2), c(2)

      a = corners(:, 2) - corners(:, 1)
      b = corners(:, 3) - corners(:, 1)
      c = place - corners(:, 1)
      shares(2) = cross(c, b)/cross(a, b)
      shares(3) = cross(a, c)/cross(a, b)
      shares(1) = 1.0_wp - shares(2) - shares(3)
   end function shares

   pure real(wp) function cross(a, b)
      real(wp), intent(in) :: a(2), b(2)

      cross = a(1)*b(2) - a(2)*b(1)
   end function cross

   !> Give the interface elements of the model their gaps.
   subroutine build_gaps(deck, mesh, joints)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      integer :: i, j

      do i = 1, size(deck%bulk%jgap)
         associate (card => deck%bulk%jgap(i))
            if (card%joint == 0) cycle ! a field that could not be read
            j = findloc(joints%list%id, card%joint, dim=1)
            if (j == 0) then
               call deck%field_error(card%line, 'JID', 'there is no joint '//integer_text(card%joint))
               cycle
            end if
            joints%list(j)%gap_kind = card%kind
            select case (card%kind)
            case ('CONST')
               joints%element(joints%list(j)%first:joints%list(j)%last)%gap = card%g0
            case ('PLANE', 'TABLE')
               call gaps_by_place(deck, card, joints%list(j), mesh, joints)
            case ('NODES')
               call gaps_by_node(deck, card, joints%list(j), mesh, joints)
            case ('TRUE')
               call true_gaps(deck, card, joints%list(j), mesh, joints)
            end select
         end associate
      end do
      do j = 1, size(joints%list)
         if (joints%list(j)%gap_kind == '') call warn_of_distance(deck, mesh%dimension, &
            joints%list(j), 'joint '//integer_text(joints%list(j)%id), 'JGAP TRUE makes these distances its gaps')
      end do
   end subroutine build_gaps

   !> Warn of a JOINT without JGAP, or of a glue, called NAME, whose projected faces are farther from each other than the sagittas of
   !! both and APART of a face together. END is the end of the message.
   subroutine warn_of_distance(deck, dimension, joint, name, end)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: dimension
      type(joint_type), intent(in)   :: joint
      character(*), intent(in)       :: name, end

      associate (cover => joint%cover)
         if (cover%farthest > sum(cover%sagitta) + apart*cover%spacing(1)**(1.0_wp/(dimension - 1))) &
            call deck%errors%warn(name//': its faces stand apart or overlap by up to '//real_text(cover%farthest)// &
               ', and are joined as if they touched; '//end)
      end associate
   end subroutine warn_of_distance

   !> PLANE and TABLE: the gap is a function of the position x, y of an element in the axes of the mean normal.
   subroutine gaps_by_place(deck, card, joint, mesh, joints)
      type(checked_deck), intent(in)  :: deck
      type(jgap_card), intent(in)     :: card
      type(joint_type), intent(in)    :: joint
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      character(*), parameter :: no_y = 'not zero, but a joint of a plane model has x alone'
      type(gap_table_type) :: table
      real(wp) :: axes(3, 3), centroid(3), place(2)
      real(wp), allocatable :: x(:, :)
      integer  :: i, twice(2)

      if (joint%last < joint%first) return ! reported elsewhere
      if (norm2(joint%normal) <= 0.0_wp) then
         call deck%field_error(card%line, 'KIND', trim(card%kind)//', but the normals of joint '//integer_text(joint%id)// &
                               ' point in all directions, so that it has no mean plane: expected CONST, NODES or TRUE')
         return
      end if
      axes = joint_axes(mesh, joint%normal)
      centroid = joint_centroid(mesh, joints, joint)
      if (mesh%axisymmetric) centroid(1) = 0.0_wp ! the centroid of a ring lies on the axis
      if (card%kind == 'TABLE') then
         if (size(card%gap) == 0) return ! reported where the card is read
         x = matmul(transpose(axes(:, :2)), card%x - spread(centroid, 2, size(card%gap)))
         if (mesh%dimension == 2) x(2, :) = 0.0_wp
         call table%build(x, card%gap, twice)
         if (twice(1) > 0) then
            call deck%field_error(card%line, card%at(twice(2)), 'point '//integer_text(twice(2))// &
               ' of the table coincides, seen along the normal of the joint, with point '//integer_text(twice(1)), called='X')
            return
         end if
      end if
      if (card%kind == 'PLANE' .and. mesh%dimension == 2) then
         if (abs(card%slope(2)) > 0.0_wp) call deck%field_error(card%line, 'SY', no_y)
         if (abs(card%crown(2)) > 0.0_wp) call deck%field_error(card%line, 'CY', no_y)
      end if
      do i = joint%first, joint%last
         associate (element => joints%element(i))
            place = matmul(at_first_end(element, mesh%x) - centroid, axes(:, :2))
            if (card%kind == 'TABLE') then
               element%gap = table%value_at(place)
            else
               element%gap = card%g0 + sum(card%slope*place + card%crown*place**2)
            end if
         end associate
      end do
      associate (gaps => joints%element(joint%first:joint%last)%gap)
         where (abs(gaps) <= touching_faces*maxval(abs(gaps))) gaps = 0.0_wp
      end associate
   end subroutine gaps_by_place

   !> NODES: gaps of nodes of SIDE1, zero for a node that is not given. An element on several nodes has their mean. A node without
   !! elements, such as a corner of a six-node face, is a node of SIDE1 too. For the face of a shell the card names the nodes of the
   !! shell.
   subroutine gaps_by_node(deck, card, joint, mesh, joints)
      type(checked_deck), intent(in)  :: deck
      type(jgap_card), intent(in)     :: card
      type(joint_type), intent(in)    :: joint
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      real(wp), allocatable :: gap(:, :)
      integer, allocatable  :: given_at(:) ! 0: not on SIDE1, -1: not given
      integer, allocatable  :: on_side(:)  ! the node itself; of a shell its face node on SIDE1
      integer :: i, node
      character(:), allocatable :: words

      allocate (gap(1, mesh%n_nodes), source=0.0_wp)
      allocate (given_at(mesh%n_nodes), source=0)
      allocate (on_side(mesh%n_nodes), source=[(i, i = 1, mesh%n_nodes)])
      do i = joint%first, joint%last
         given_at(nodes_of_end(joints%element(i), 1)) = -1
      end do
      if (joint%side_1 > 0) then
         associate (side => mesh%surfaces(joint%side_1))
            do i = 1, side%n
               given_at(side%nodes(:side%n_nodes(i), i)) = -1
            end do
         end associate
      end if
      do i = 1, size(mesh%faces)
         if (given_at(mesh%faces(i)%node) == -1) on_side(mesh%faces(i)%point) = mesh%faces(i)%node
      end do
      do i = 1, size(card%node)
         if (card%node(i) == 0) cycle
         words = ''
         node = mesh%node_table%find(card%node(i))
         if (node > 0) node = on_side(node)
         if (node == 0) then
            words = 'there is no GRID '//integer_text(card%node(i))
         else if (given_at(node) == 0) then
            words = 'node '//integer_text(card%node(i))//' is not on SIDE1 of joint '//integer_text(joint%id)
         else if (given_at(node) > 0) then
            words = 'node '//integer_text(card%node(i))//' is given twice'
         else
            given_at(node) = i
            gap(1, node) = card%gap(i)
         end if
         if (words /= '' .and. joint%last >= joint%first) call deck%field_error(card%line, card%at(i), words, called='G')
      end do
      do i = joint%first, joint%last
         joints%element(i)%gap = sum(at_first_end(joints%element(i), gap))
      end do
   end subroutine gaps_by_node

   !> TRUE: the distance of the faces in the mesh, along the normal from end 1 to end 2. Chords of curved faces stand for arcs; where
   !! the arcs stand out farther than the gaps are wide, a warning gives both.
   subroutine true_gaps(deck, card, joint, mesh, joints)
      type(checked_deck), intent(in)  :: deck
      type(jgap_card), intent(in)     :: card
      type(joint_type), intent(in)    :: joint
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      real(wp) :: closing(3)
      integer  :: i

      do i = joint%first, joint%last
         associate (element => joints%element(i))
            if (size(nodes_of_end(element, 2)) == 0) then
               call deck%field_error(card%line, 'KIND', 'TRUE, but joint '//integer_text(joint%id)// &
                                     ' lies on a rigid base, which has no position: expected CONST, PLANE, TABLE or NODES')
               return
            end if
            closing = joint_movement(element, mesh%x)
            closing(3) = closing(3) - dot_product(element%bulge, element%axes(:, 3))
            element%gap = 0.0_wp
            if (abs(closing(3)) > touching_faces*maxval(abs(mesh%x(:, element%node)))) element%gap = -closing(3)
         end associate
      end do
      associate (gaps => joints%element(joint%first:joint%last)%gap, sagitta => joint%cover%sagitta)
         if (size(gaps) == 0 .or. maxval(sagitta) <= max(maxval(abs(gaps)), touching_faces*maxval(abs(mesh%x)))) return
         call deck%errors%warn('joint '//integer_text(joint%id)//': JGAP TRUE finds gaps of '//real_text(minval(gaps))// &
            ' to '//real_text(maxval(gaps))//' between arcs through the nodes, whose chords lie up to '//real_text(sagitta(1))// &
            ' (SIDE1) and '//real_text(sagitta(2))//' (SIDE2) beside them; a finer mesh, or JGAP CONST, is surer')
      end associate
   end subroutine true_gaps

end module joint_gaps
