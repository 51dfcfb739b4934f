!> The bodies of a model, their outer sides, the pairs of facing bodies, and bodies without support.
!! Unsupported bodies are found from the connectivity, before any factorisation.
module facing_bodies
   use element_kinds, only: element_table
   use element_mapping, only: two_pi
   use face_overlap, only: edge_lengths
   use interface_operator, only: named_node
   use kinds, only: wp
   use lists, only: join, list_owners, root_of
   use connected_bodies, only: find_bodies
   use mesh_queries, only: element_points, is_shell, n_points
   use model_data, only: freedoms_type, joints_type, mesh_type, n_bars, supported
   use node_pairing, only: opposed => facing, reach => default_reach
   use numbers, only: cross
   use spatial_search, only: spatial_search_type
   use surface_sides, only: side_corners
   use text_tools, only: clean, integer_text, one_of, real_text
   use tolerances, only: on_rim
   implicit none
   private

   public :: list_bodies, body_words, box_words, list_outer_sides, find_facing, gather_facing, loose_words, rounded

   integer, parameter  :: most_said = 5        ! number of unsupported bodies that a message lists

   type, public :: body_type
      integer  :: first = huge(1), last = 0    !! lowest and highest number of its elements
      integer  :: n_elements = 0, n_nodes = 0
      real(wp) :: low(3) = huge(1.0_wp), high(3) = -huge(1.0_wp) !! the box around it [length]
   end type body_type

   !> A side of one element only, or one of the two faces of a shell.
   type, public :: outer_side
      integer  :: element = 0, body = 0
      integer  :: side = 0                     !! 0: the face of a shell along its normal, -1: the opposite face
      integer  :: n = 0                        !! number of corners
      integer  :: corners(4) = 0               !! positions of nodes
      real(wp) :: centre(3) = 0.0_wp           !! [length]
      real(wp) :: normal(3) = 0.0_wp           !! unit, out of the body
      real(wp) :: area = 0.0_wp                !! [length^2]
      real(wp) :: size = 0.0_wp                !! longest edge [length]
      integer  :: sees = 0                     !! the nearest side of another body over its centre, 0: none
      real(wp) :: apart = huge(1.0_wp)         !! their distance [length]
   end type outer_side

   !> Two facing bodies, with the sides whose centres face the other body. SIDE1, with the finer mesh, comes first.
   type, public :: facing_type
      integer  :: body(2) = 0
      integer  :: n(2) = 0                     !! number of sides of each body that face the other body
      real(wp) :: area(2) = 0.0_wp             !! area of these sides [length^2]
      real(wp) :: gap(2) = [huge(1.0_wp), -huge(1.0_wp)] !! smallest and largest distance along the normals [length]
      real(wp) :: normal(3) = 0.0_wp           !! mean of SIDE1, unit
   end type facing_type

contains

   !> All bodies, and the body of each element.
   pure subroutine list_bodies(mesh, body, bodies)
      type(mesh_type), intent(in) :: mesh
      integer, intent(out)           :: body(:) !! (n_elements)
      type(body_type), allocatable, intent(out) :: bodies(:)
      integer :: seen(mesh%n_nodes), e, i, n

      call find_bodies(mesh, body, n)
      allocate (bodies(n))
      seen = 0
      do e = 1, mesh%n_elements
         associate (record => bodies(body(e)), nodes => element_points(mesh, e))
            record%first = min(record%first, mesh%element_id(e))
            record%last = max(record%last, mesh%element_id(e))
            record%n_elements = record%n_elements + 1
            do i = 1, size(nodes)
               if (seen(nodes(i)) == body(e)) cycle
               seen(nodes(i)) = body(e)
               record%n_nodes = record%n_nodes + 1
               record%low = min(record%low, mesh%x(:, nodes(i)))
               record%high = max(record%high, mesh%x(:, nodes(i)))
            end do
         end associate
      end do
   end subroutine list_bodies

   !> Text such as 'body 3 (elements 1201 to 2400, 347 nodes, box (0, 0, 40) to (90, 30, 80))'.
   pure function body_words(number, body) result(words)
      integer, intent(in)         :: number
      type(body_type), intent(in) :: body
      character(:), allocatable   :: words

      words = 'body '//integer_text(number)//' (elements '//integer_text(body%first)//' to '//integer_text(body%last)//', '// &
              integer_text(body%n_nodes)//' nodes, box '//box_words(body%low)//' to '//box_words(body%high)//')'
   end function body_words

   !> Text such as '(0, 0, 40)'.
   pure function box_words(x) result(words)
      real(wp), intent(in)      :: x(3)
      character(:), allocatable :: words

      words = '('//real_text(clean(x(1)))//', '//real_text(clean(x(2)))//', '//real_text(clean(x(3)))//')'
   end function box_words

   !> The outer SIDES of all bodies, in the order of the elements.
   pure subroutine list_outer_sides(mesh, body, sides)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: body(:) !! (n_elements)
      type(outer_side), allocatable, intent(out) :: sides(:)
      integer, allocatable :: first(:), owners(:), least(:, :)
      logical, allocatable :: is_outer(:)
      integer :: e, i, j, n, s

      n = sum([(merge(2, element_table(mesh%element_kind(e))%n_sides, is_shell(mesh, e)), e = 1, mesh%n_elements)])
      allocate (sides(n), is_outer(n), least(1, n))
      i = 0
      do e = 1, mesh%n_elements
         do s = 1, merge(2, element_table(mesh%element_kind(e))%n_sides, is_shell(mesh, e))
            i = i + 1
            sides(i)%element = e
            sides(i)%side = merge(1 - s, s, is_shell(mesh, e))
            sides(i)%body = body(e)
            associate (corners_here => side_corners(mesh, e, max(0, sides(i)%side)))
               sides(i)%n = size(corners_here)
               sides(i)%corners(:size(corners_here)) = corners_here
               if (sides(i)%side < 0) sides(i)%corners(:size(corners_here)) = corners_here(size(corners_here):1:-1)
               least(1, i) = merge(minval(corners_here), 0, sides(i)%side > 0) ! the face of a shell is equal to no other side
            end associate
         end do
      end do
      call list_owners(mesh%n_nodes, least, first, owners)
      is_outer = .true.
      do i = 1, n
         if (sides(i)%side <= 0) cycle
         do j = first(least(1, i)), first(least(1, i) + 1) - 1
            if (owners(j) == i) cycle
            associate (own => sides(i)%corners(:sides(i)%n), other => sides(owners(j))%corners(:sides(owners(j))%n))
               if (size(own) /= size(other)) cycle
               if (all([(any(own(s) == other), s = 1, size(own))])) is_outer(i) = .false.
            end associate
         end do
      end do
      sides = pack(sides, is_outer)
      do i = 1, size(sides)
         call measure(mesh, sides(i))
      end do
   end subroutine list_outer_sides

   !> Centre, normal, area and size of SIDE from its corners.
   pure subroutine measure(mesh, side)
      type(mesh_type), intent(in) :: mesh
      type(outer_side), intent(inout) :: side
      real(wp) :: vector(3)

      associate (x => mesh%x(:, side%corners(:side%n)))
         side%centre = sum(x, dim=2)/side%n
         side%size = maxval(edge_lengths(x))
         select case (side%n)
         case (2) ! body on the left of the edge
            vector = [x(2, 2) - x(2, 1), x(1, 1) - x(1, 2), 0.0_wp]
         case (3)
            vector = 0.5_wp*cross(x(:, 2) - x(:, 1), x(:, 3) - x(:, 1))
         case default
            vector = 0.5_wp*cross(x(:, 3) - x(:, 1), x(:, 4) - x(:, 2))
         end select
      end associate
      side%area = norm2(vector)
      side%normal = vector/max(side%area, tiny(1.0_wp))
      if (side%side <= 0) then
         associate (law => mesh%structural%shells(mesh%structural%place(side%element)))
            side%centre = side%centre + side%normal* &
                          (0.5_wp*sum(law%thickness(:side%n))/side%n + merge(1, -1, side%side == 0)*law%offset)
         end associate
      end if
      if (side%n > 2) return
      if (mesh%axisymmetric) then
         side%area = side%area*two_pi*side%centre(1)
      else
         side%area = side%area*mesh%properties(mesh%element_property(side%element))%thickness
      end if
   end subroutine measure

   !> What each of SIDES sees.
   subroutine find_facing(mesh, sides)
      type(mesh_type), intent(in) :: mesh
      type(outer_side), intent(inout) :: sides(:)
      type(spatial_search_type) :: search
      real(wp), allocatable :: boxes(:, :, :)
      integer, allocatable  :: found(:)
      real(wp) :: distance
      integer  :: i, k, n

      allocate (boxes(3, 2, size(sides)))
      do i = 1, size(sides)
         associate (x => mesh%x(:, sides(i)%corners(:sides(i)%n)))
            boxes(:, 1, i) = min(minval(x, dim=2), sides(i)%centre) ! the centre of a shell face lies off its nodes
            boxes(:, 2, i) = max(maxval(x, dim=2), sides(i)%centre)
         end associate
      end do
      call search%build(boxes(:, 1, :), boxes(:, 2, :))
      allocate (found(64))
      do i = 1, size(sides)
         associate (side => sides(i))
            call search%list_meeting(side%centre - reach*side%size, side%centre + reach*side%size, found, n)
            do k = 1, n
               if (sides(found(k))%body == side%body) cycle
               distance = distance_over(mesh, side, sides(found(k)))
               if (distance >= side%apart) cycle
               side%apart = distance
               side%sees = found(k)
            end do
         end associate
      end do
   end subroutine find_facing

   !> The groups of facing sides with the same two bodies and equal columns of KEY, in the order of their first sides; GROUP of
   !! each side, 0: it sees none.
   pure subroutine gather_facing(sides, key, pairs, group)
      type(outer_side), intent(in) :: sides(:)
      integer, intent(in)          :: key(:, :) !! (any, sides)
      type(facing_type), allocatable, intent(out) :: pairs(:)
      integer, allocatable, intent(out) :: group(:)
      integer, allocatable :: first(:)          ! side of each group
      integer :: bodies(2), i, p

      allocate (group(size(sides)), source=0)
      allocate (pairs(0), first(0))
      do i = 1, size(sides)
         if (sides(i)%sees == 0) cycle
         bodies = [sides(i)%body, sides(sides(i)%sees)%body]
         bodies = [minval(bodies), maxval(bodies)]
         do p = 1, size(pairs)
            if (all(pairs(p)%body == bodies) .and. all(key(:, first(p)) == key(:, i))) exit
         end do
         if (p > size(pairs)) then
            pairs = [pairs, facing_type(body=bodies)]
            first = [first, i]
         end if
         group(i) = p
         associate (pair => pairs(p), side => sides(i), k => merge(1, 2, sides(i)%body == pairs(p)%body(1)))
            pair%n(k) = pair%n(k) + 1
            pair%area(k) = pair%area(k) + side%area
            pair%gap = [min(pair%gap(1), side%apart), max(pair%gap(2), side%apart)]
            pair%normal = pair%normal + merge(1, -1, k == 1)*side%area*side%normal
         end associate
      end do
      do p = 1, size(pairs)
         associate (pair => pairs(p))
            pair%normal = pair%normal/max(norm2(pair%normal), tiny(1.0_wp))
            if (pair%n(2) > pair%n(1)) then
               pair%body = pair%body([2, 1])
               pair%n = pair%n([2, 1])
               pair%area = pair%area([2, 1])
               pair%normal = -pair%normal
            end if
         end associate
      end do
   end subroutine gather_facing

   !> Distance of the centre of SIDE from OTHER along its normal, gap or overlap [length]; huge where OTHER does not face SIDE
   !! there, or is farther away than the reach of the search.
   pure real(wp) function distance_over(mesh, side, other) result(distance)
      type(mesh_type), intent(in) :: mesh
      type(outer_side), intent(in) :: side, other
      real(wp) :: point(3), along(3), a(3), b(3), cosine
      logical  :: lies_over
      integer  :: k

      distance = huge(1.0_wp)
      cosine = dot_product(side%normal, other%normal)
      if (cosine > opposed) return
      distance = dot_product(other%centre - side%centre, other%normal)/cosine
      point = side%centre + distance*side%normal
      distance = abs(distance)
      lies_over = distance <= reach*side%size
      if (other%n == 2) then
         a = mesh%x(:, other%corners(1))
         b = mesh%x(:, other%corners(2))
         associate (share => dot_product(point - a, b - a)/dot_product(b - a, b - a))
            lies_over = lies_over .and. share >= -on_rim .and. share <= 1.0_wp + on_rim
         end associate
      else
         do k = 1, other%n
            a = mesh%x(:, other%corners(k))
            b = mesh%x(:, other%corners(1 + modulo(k, other%n)))
            along = cross(b - a, point - a)
            lies_over = lies_over .and. dot_product(along, other%normal) >= -on_rim*other%size**2
         end do
      end if
      if (.not. lies_over) distance = huge(1.0_wp)
   end function distance_over

   !> Text that lists the unsupported bodies; '' where elements, bars, rigid elements and joints (open or closed) connect
   !! every body to a support, a rigid base or a grounded spring.
   function loose_words(mesh, joints, freedoms) result(words)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(in) :: freedoms
      character(:), allocatable    :: words
      type(body_type), allocatable :: bodies(:)
      integer :: body(mesh%n_elements), parent(freedoms%n_parts + 1), e, ground, i, k, said
      integer, allocatable :: part(:) ! of each body; of connected parts the first, 0: connected to the ground

      words = ''
      if (mesh%n_elements == 0) return
      call list_bodies(mesh, body, bodies)
      allocate (part(size(bodies)))
      ! join the parts that joints connect, and those that a support, a grounded spring or a rigid base holds to the ground
      ground = freedoms%n_parts + 1
      parent = [(i, i = 1, ground)]
      do i = 1, n_points(mesh)
         if (any(supported(mesh, freedoms, i))) call join(parent, freedoms%part(i), ground)
      end do
      do i = 1, n_bars(mesh)
         if (mesh%bars(i)%nodes(2) == 0) call join(parent, freedoms%part(mesh%bars(i)%nodes(1)), ground)
      end do
      do i = 1, size(joints%element)
         associate (parts => freedoms%part(joints%element(i)%node))
            do k = 2, size(parts)
               call join(parent, parts(1), parts(k))
            end do
            if (named_node(joints%element(i), 2) == 0) call join(parent, parts(1), ground)
         end associate
      end do
      do e = mesh%n_elements, 1, -1
         part(body(e)) = root_of(parent, freedoms%part(mesh%element_nodes(1, e)))
      end do
      where (part == root_of(parent, ground)) part = 0

      said = 0
      do i = 1, size(bodies)
         if (part(i) == 0 .or. any(part(:i - 1) == part(i))) cycle
         said = said + 1
         if (said > most_said) exit
         if (words /= '') words = words//'; '
         words = words//body_words(i, bodies(i))
         k = count(part == part(i)) - 1
         if (k > 0) then
            words = words//', on which '//integer_text(k)//one_of(k == 1, ' other body hangs,', ' other bodies hang,')
            words = words//' is held by no support'
         else
            words = words//' is held by no support, joint, bolt or spring'//neighbour_words(mesh, body, i)
         end if
      end do
      if (said > most_said) words = words//'; and others'
   end function loose_words

   !> Text about the body next to body I, ', 0 from body 1 over an area of about 1250: a JOINT?'; '' where there is none.
   function neighbour_words(mesh, body, i) result(words)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: body(:) !! (n_elements)
      integer, intent(in)          :: i
      character(:), allocatable    :: words
      type(outer_side), allocatable  :: sides(:)
      type(facing_type), allocatable :: pairs(:)
      type(spatial_search_type) :: search
      integer, allocatable :: group(:), of_body(:), others(:)
      real(wp) :: distance, nearest
      integer  :: body_at(mesh%n_nodes), k, p, point

      words = ''
      call list_outer_sides(mesh, body, sides)
      call find_facing(mesh, sides)
      call gather_facing(sides, reshape([integer ::], [0, size(sides)]), pairs, group)
      pairs = pack(pairs, [(any(pairs(k)%body == i), k = 1, size(pairs))])
      if (size(pairs) > 0) then
         associate (pair => pairs(maxloc([(maxval(pairs(k)%n), k = 1, size(pairs))], dim=1)))
            words = '; it lies '//real_text(rounded(pair%gap(1)))
            if (pair%gap(2) - pair%gap(1) > 0.01_wp*pair%gap(2)) words = words//' to '//real_text(rounded(pair%gap(2)))
            words = words//' from body '//integer_text(sum(pair%body) - i)//' over an area of about '// &
                    real_text(rounded(pair%area(1)))//'; is a JOINT missing?'
         end associate
      end if
      if (words /= '') return
      body_at = 0
      do k = 1, mesh%n_elements
         body_at(element_points(mesh, k)) = body(k)
      end do
      of_body = pack([(k, k = 1, size(body_at))], body_at == i)
      others = pack([(k, k = 1, size(body_at))], body_at /= i .and. body_at > 0)
      if (size(others) == 0) return
      call search%build(mesh%x(:, others))
      p = others(1)
      nearest = huge(1.0_wp)
      do k = 1, size(of_body)
         call search%nearest(mesh%x(:, of_body(k)), huge(1.0_wp), point, distance)
         if (distance >= nearest) cycle
         nearest = distance
         p = others(point)
      end do
      words = '; the nearest body is '//integer_text(body_at(p))//', with nodes '//real_text(rounded(nearest))//' apart'
   end function neighbour_words

   !> VALUE rounded to three digits.
   pure real(wp) function rounded(value)
      real(wp), intent(in) :: value
      character(16) :: text

      write (text, '(es10.2)') value
      read (text, *) rounded
   end function rounded

end module facing_bodies
