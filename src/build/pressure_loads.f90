!> PLOAD4, PLOADE, PLOAD and PLOAD2: the loaded sides, found by their corners or elements, and their nodal forces; those of PLOADM
!! and FORCEM.
module pressure_loads
   use deck_check, only: checked_deck
   use displacement_systems, only: rectangular_axes
   use element_build, only: is_face
   use element_kinds, only: element_table, kind_hexa8, kind_penta6, kind_pyram5, kind_tetra4, max_side_nodes
   use isoparametric, only: side_forces
   use kinds, only: wp
   use load_data, only: of_face, of_marks, of_nodes, pressure_card, surface_load_card
   use lists, only: id_table_type
   use mesh_queries, only: element_points, is_shell
   use model_data, only: mesh_type, surface_type
   use node_coupling, only: add_section_share
   use shell_element, only: node_normal
   use structural_elements, only: add_bubble_load
   use surface_build, only: side_influence
   use surface_sides, only: side_corners
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: find_pressed_sides, add_pressure, add_surface_load

   !> A face that a card names by its corners, and the order of these corners on it.
   type :: named_face
      integer :: element = 0, side = 0       ! 0: no such face
      integer :: first = 0                   ! position of the first named corner on the side
      logical :: outward = .false.           ! the right-hand normal of the named corners points out of the element
   end type named_face

   !> Where the pressure of a card acts.
   type, public :: pressed_side
      integer  :: card = 0                    !! among the pressure cards
      integer  :: element = 0, side = 0       !! side 0: the face of a shell, loaded against its normal
      real(wp) :: p(4) = 0.0_wp               !! at the corners of the side, in its order; positive into the body [pressure]
      real(wp) :: direction(3) = 0.0_wp       !! unit direction of a traction P; zero: along the normal
   end type pressed_side

   type :: pressed_list
      integer :: n = 0
      type(pressed_side), allocatable :: side(:) ! (at least n)
   end type pressed_list

contains

   !> The FACE whose corners have the numbers ID, in either sense. There is none, and a PROBLEM, where the face is missing, or where
   !! bodies lie on both sides, because forces on its nodes would act on both.
   subroutine find_face(mesh, id, face, problem)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)                    :: id(:)  !! 3 or 4 corners in cyclic order
      type(named_face), intent(out)          :: face
      character(:), allocatable, intent(out) :: problem
      type(named_face) :: tried
      character(:), allocatable :: words
      integer :: found, i, node, s

      found = 0
      problem = ''
      node = mesh%node_table%find(id(1))
      do while (node > 0)
         do i = mesh%first_at(node), mesh%first_at(node + 1) - 1
            associate (e => mesh%elements_at(i))
               do s = merge(0, 1, is_shell(mesh, e)), element_table(mesh%element_kind(e))%n_sides
                  call compare_corners(mesh, e, s, id, tried)
                  if (tried%element == 0) cycle
                  found = found + 1
                  face = tried
               end do
            end associate
         end do
         node = mesh%duplicate(node)
      end do
      if (found == 1) return
      face = named_face()
      words = ' with the corners '//integer_text(id(1))
      do i = 2, size(id)
         words = words//', '//integer_text(id(i))
      end do
      problem = 'no body element has a face'//words
      if (found > 1) problem = 'bodies lie on both sides of the face'//words//': the loaded body is ambiguous'
   end subroutine find_face

   !> Side S of element E if the nodes with the numbers ID, or their duplicates, are its corners in cyclic order, else none.
   pure subroutine compare_corners(mesh, e, s, id, face)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)           :: e, s, id(:)
      type(named_face), intent(out) :: face
      integer :: k, place(size(id))
      logical :: outward

      associate (corners => side_corners(mesh, e, s))
         if (size(corners) /= size(id)) return
         place = [(place_of(mesh, id(k), corners), k = 1, size(id))]
      end associate
      if (any(place == 0)) return
      outward = all(place == cshift([(k, k = 1, size(id))], place(1) - 1))
      if (.not. outward .and. any(place /= cshift([(k, k = size(id), 1, -1)], size(id) - place(1)))) return ! not in cyclic order
      face = named_face(e, s, place(1), outward)
   end subroutine compare_corners

   !> The place of the node with number ID, or of its duplicate, among CORNERS; 0: none.
   pure integer function place_of(mesh, id, corners) result(place)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: id, corners(:)

      place = 0
      associate (node => mesh%node_table%find(id))
         if (node > 0) place = findloc(corners == node .or. corners == mesh%duplicate(node), .true., dim=1)
      end associate
   end function place_of

   !> The sides that PLOAD4, PLOADE, PLOAD and PLOAD2 cards load, without cards in error.
   subroutine find_pressed_sides(deck, mesh, pressed)
      type(checked_deck), intent(in)               :: deck
      type(mesh_type), intent(in) :: mesh
      type(pressed_side), allocatable, intent(out) :: pressed(:)
      type(id_table_type) :: elements, faces
      type(pressed_list)  :: list
      type(pressed_side)  :: new
      type(named_face)    :: face
      character(:), allocatable :: problem
      real(wp) :: axes(3, 3)
      integer  :: e, i, k
      logical  :: names_shell

      allocate (list%side(size(deck%bulk%pressure)))
      call elements%build(mesh%element_id)
      call faces%build(pack(deck%bulk%element%id, is_face(mesh, deck%bulk%element)))
      do i = 1, size(deck%bulk%pressure)
         associate (card => deck%bulk%pressure(i))
            call rectangular_axes(deck, mesh%systems, card%line, card%system, 'the pressure on a face has one direction', axes)
            new = pressed_side(card=i, direction=matmul(axes, card%direction/max(norm2(card%direction), tiny(1.0_wp))))
            if (card%kind == of_nodes) then
               if (any(card%corners(:3) == 0)) cycle ! reported already
               call find_face(mesh, card%corners(:merge(4, 3, card%corners(4) > 0)), face, problem)
               if (problem /= '') call deck%field_error(card%line, 'G1', problem)
               if (problem == '') call append(pressed_side(card=i, element=face%element, side=face%side, &
                                                           p=merge(-card%pressure, card%pressure, face%outward)), list)
               cycle
            else if (card%kind == of_marks) then
               do k = 1, size(card%ranges%first)
                  call press_on_marked(deck, mesh, new, card%ranges%at(k), [card%ranges%first(k), card%ranges%last(k)], list)
               end do
               cycle
            end if
            if (card%first == 0) cycle
            e = elements%find(card%first)
            names_shell = e > 0
            if (names_shell) names_shell = is_shell(mesh, e)
            if (card%kind == of_face .and. (card%last > card%first .or. faces%find(card%first) > 0 .or. names_shell)) then
               call press_on_marked(deck, mesh, new, 2, [card%first, card%last], list)
            else if (e == 0) then
               call deck%field_error(card%line, 'EID', 'there is no body element '//integer_text(card%first))
            else if (element_table(mesh%element_kind(e))%dimension /= merge(3, 2, card%kind == of_face)) then
               call deck%field_error(card%line, 'EID', 'element '//integer_text(card%first)//' is a '// &
                  trim(element_table(mesh%element_kind(e))%card)// &
                  one_of(card%kind == of_face, ': PLOAD4 is for faces of solids, and for shells in space', &
                         ': PLOADE is for plane edges'))
            else if (card%corners(1) == 0) then
               if (card%kind == of_face) call deck%field_error(card%line, 'G1', 'blank, expected a corner of the face')
            else
               call press_on_side(deck, mesh, e, new, list)
            end if
         end associate
      end do
      pressed = list%side(:list%n)
   end subroutine find_pressed_sides

   !> Append a side; the room is doubled when it is full.
   pure subroutine append(side, pressed)
      type(pressed_side), intent(in)   :: side
      type(pressed_list), intent(inout) :: pressed

      if (pressed%n == size(pressed%side)) pressed%side = [pressed%side, pressed%side]
      pressed%n = pressed%n + 1
      pressed%side(pressed%n) = side
   end subroutine append

   !> The PLOAD4 or PLOAD2 of NEW on the shells with numbers from RANGE(1) to RANGE(2), and on the faces that elements with these
   !! numbers, in data field AT, mark. The pressure acts along the right-hand normals of these elements, or along the direction of
   !! the card.
   subroutine press_on_marked(deck, mesh, new, at, range, pressed)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in) :: mesh
      type(pressed_side), intent(in)    :: new
      integer, intent(in)               :: at, range(2)
      type(pressed_list), intent(inout) :: pressed
      type(pressed_side) :: side
      type(named_face)   :: found
      character(:), allocatable :: problem
      integer :: e, f
      logical :: any_face, is_normal

      side = new
      is_normal = norm2(side%direction) <= 0.0_wp
      any_face = .false.
      associate (card => deck%bulk%pressure(new%card))
         if (allocated(mesh%structural%place)) then
            do e = 1, mesh%n_elements
               if (mesh%element_id(e) < range(1) .or. mesh%element_id(e) > range(2) .or. .not. is_shell(mesh, e)) cycle
               any_face = .true.
               side%element = e
               side%p = merge(-card%pressure, card%pressure, is_normal)
               call append(side, pressed)
            end do
         end if
         if (card%corners(1) > 0) then
            call deck%field_error(card%line, 'G1', 'element '//integer_text(card%first)//' marks a face; expected a blank, or '// &
                                  'in EID the solid that the face belongs to')
            return
         end if
         do f = 1, size(deck%bulk%element)
            associate (face => deck%bulk%element(f))
               if (face%id < range(1) .or. face%id > range(2)) cycle
               if (.not. is_face(mesh, face)) cycle
               any_face = .true.
               call find_face(mesh, face%nodes(:element_table(face%kind)%n_corners), found, problem)
               if (problem /= '') then
                  call deck%field_error(card%line, at, problem, called='EID')
                  cycle
               end if
               side%element = found%element
               side%side = found%side
               associate (c => element_table(face%kind)%n_corners)
                  if (lacks_corner(deck, card, c)) return
                  if (found%outward) then
                     side%p(:c) = cshift(card%pressure(:c), 1 - found%first)
                  else
                     side%p(:c) = cshift(card%pressure(c:1:-1), -found%first)
                  end if
                  if (found%outward .and. is_normal) side%p = -side%p
                  call append(side, pressed)
               end associate
            end associate
         end do
         if (.not. any_face .and. range(1) <= range(2)) call deck%field_error(card%line, at, 'no element from '// &
            integer_text(range(1))//' to '//integer_text(range(2))//' marks a face of a solid or is a shell; '// &
            one_of(card%kind == of_marks, 'PLOAD2', 'THRU')// &
            ' is for CTRIA3 and CQUAD4 with a PMARK or PSHELL', called='EID')
      end associate
   end subroutine press_on_marked

   !> Whether CARD gives a pressure at a fourth corner of a face with C corners, 3; this is an error.
   logical function lacks_corner(deck, card, c)
      type(checked_deck), intent(in)  :: deck
      type(pressure_card), intent(in) :: card
      integer, intent(in)             :: c

      lacks_corner = c == 3 .and. abs(card%pressure(4) - card%pressure(1)) > 0.0_wp
      if (lacks_corner) call deck%field_error(card%line, 'P4', 'a triangular face has no fourth corner, expected a blank or P1')
   end function lacks_corner

   !> The PLOAD4 or PLOADE of NEW, on the side of element E with the corners on the card. Error: there is no such side.
   subroutine press_on_side(deck, mesh, e, new, pressed)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)               :: e
      type(pressed_side), intent(inout) :: new
      type(pressed_list), intent(inout) :: pressed
      character(:), allocatable :: expected
      integer :: c, corner(2), k
      logical :: fits

      new%element = e
      associate (card => deck%bulk%pressure(new%card), kind => element_table(mesh%element_kind(e)))
         corner = 0
         do k = 1, 2
            if (card%corners(k) == 0) cycle
            corner(k) = place_of(mesh, card%corners(k), mesh%element_nodes(:kind%n_corners, e))
            if (corner(k) > 0) cycle
            call deck%field_error(card%line, one_of(k == 1, 'G1', one_of(card%kind == of_face, 'G34', 'G2')), 'node '// &
               integer_text(card%corners(k))//' is no corner of element '//integer_text(card%first))
            return
         end do
         do k = 1, kind%n_sides
            c = kind%side_corners(k)
            associate (side_nodes => kind%side_nodes(:c, k))
               if (all(side_nodes /= corner(1))) cycle
               select case (kind%linear)
               case (kind_tetra4)            ! G4 is the corner opposite to the face
                  fits = corner(2) > 0 .and. all(side_nodes /= corner(2))
               case (kind_hexa8, kind_penta6, kind_pyram5)
                  if (size(side_nodes) == 3 .and. kind%linear == kind_pyram5) then ! G1 and G3 are those of the base
                     fits = any(side_nodes(:2) == corner(1)) .and. any(side_nodes(:2) == corner(2)) .and. corner(1) /= corner(2)
                  else if (size(side_nodes) == 3) then
                     fits = corner(2) == 0
                  else                       ! G3 is opposite to G1
                     fits = side_nodes(modulo(findloc(side_nodes, corner(1), dim=1) + 1, 4) + 1) == corner(2)
                  end if
               case default
                  fits = any(side_nodes == corner(2)) .and. corner(1) /= corner(2)
               end select
               if (.not. fits) cycle
               if (lacks_corner(deck, card, c)) return
               new%side = k
               new%p(:c) = cshift(card%pressure(:c), 1 - findloc(side_nodes, corner(1), dim=1))
               call append(new, pressed)
               return
            end associate
         end do
         select case (kind%linear)
         case (kind_tetra4)
            expected = 'expected in G1 a corner of the face and in G4 the opposite corner'
         case (kind_hexa8)
            expected = 'expected in G1 and G34 two opposite corners of a face'
         case (kind_pyram5)
            expected = 'expected two opposite corners of the base, or the two corners of a triangular face at the base'
         case (kind_penta6)
            expected = 'expected two opposite corners of a quadrilateral face, or in G1 alone a corner of a triangular one'
         case default
            expected = 'expected the two ends of an edge'
         end select
         call deck%field_error(card%line, 'G1', 'no side of element '//integer_text(card%first)//' has these corners; '//expected)
      end associate
   end subroutine press_on_side

   !> Add to FORCE the nodal forces of FACTOR times the pressure on one side; a mid-side node has the mean of the adjacent corners.
   !! Source: side_forces.
   pure subroutine add_pressure(mesh, pressed, factor, force)
      type(mesh_type), intent(in) :: mesh
      type(pressed_side), intent(in) :: pressed
      real(wp), intent(in)           :: factor
      real(wp), intent(inout)        :: force(:, :)       !! (3, n_nodes) [force]
      real(wp) :: f(mesh%dimension, max_side_nodes), p(max_side_nodes), q(3, max_side_nodes)
      integer  :: c, k, n, nodes(max_side_nodes)

      associate (e => pressed%element, s => pressed%side, d => mesh%dimension, &
                 kind => element_table(mesh%element_kind(pressed%element)), &
                 property => mesh%properties(max(1, mesh%element_property(pressed%element))))
         if (s == 0) then
            n = kind%n_nodes
            nodes(:n) = element_points(mesh, e)
            c = kind%n_corners
         else
            n = kind%side_size(s)
            nodes(:n) = mesh%element_nodes(kind%side_nodes(:n, s), e)
            c = kind%side_corners(s)
         end if
         p(:c) = factor*pressed%p(:c)
         if (c <= 4) p(c + 1:2*c) = 0.5_wp*(p(:c) + cshift(p(:c), 1))
         if (norm2(pressed%direction) > 0.0_wp) then
            call side_forces(property%state, property%thickness, mesh%x(:d, nodes(:n)), p(:n), f, pressed%direction(:d))
         else
            call side_forces(property%state, property%thickness, mesh%x(:d, nodes(:n)), p(:n), f)
         end if
         force(:d, nodes(:n)) = force(:d, nodes(:n)) + f(:, :n)
         call add_section_share(mesh, e, nodes(:n), f, force)
         if (s > 0) return
         do k = 1, n
            q(:, k) = p(k)*pressed%direction
            if (.not. norm2(pressed%direction) > 0.0_wp) q(:, k) = -p(k)*node_normal(mesh%x(:, nodes(:n)), k)
         end do
         call add_bubble_load(mesh, e, q(:, :n), force)
      end associate
   end subroutine add_pressure

   !> Nodal forces of CARD on SURFACE, times FACTOR: a pressure, positive into the body, or a total force distributed uniformly over
   !! the area.
   pure subroutine add_surface_load(mesh, surface, card, factor, force)
      type(mesh_type), intent(in) :: mesh
      type(surface_type), intent(in)      :: surface
      type(surface_load_card), intent(in) :: card
      real(wp), intent(in)                :: factor
      real(wp), intent(inout)             :: force(:, :) !! (3, n_nodes)
      real(wp) :: area(max_side_nodes), f(3, max_side_nodes), normal(3, max_side_nodes), total_area
      integer  :: k, s

      total_area = 0.0_wp
      if (.not. card%is_pressure) then
         do s = 1, surface%n
            call side_influence(mesh, surface, s, area, normal)
            total_area = total_area + sum(area)
         end do
      end if
      if (total_area <= 0.0_wp .and. .not. card%is_pressure) return
      do s = 1, surface%n
         call side_influence(mesh, surface, s, area, normal)
         do k = 1, surface%n_nodes(s)
            if (card%is_pressure) f(:, k) = -factor*card%pressure*normal(:, k)
            if (.not. card%is_pressure) f(:, k) = area(k)/total_area*(factor*card%force)
            force(:, surface%nodes(k, s)) = force(:, surface%nodes(k, s)) + f(:, k)
         end do
         call add_section_share(mesh, surface%element(s), surface%nodes(:surface%n_nodes(s), s), f, force)
      end do
   end subroutine add_surface_load

end module pressure_loads
