!> Loads on bodies: GRAV, ACCEL1, RFORCE and PLOAD1 as nodal forces and as end forces of beams.
!! GRAV, ACCEL1 and RFORCE act on masses, PLOAD1 along beams.
module body_loads
   use beam_cards, only: load_types
   use beam_element, only: beam_axes, beam_length, beam_line_load, beam_nodal_forces, beam_point_load, beam_section_at
   use body_elements, only: law_of
   use bulk_data, only: beam_load_card, bulk_data_type
   use deck_check, only: checked_deck
   use displacement_systems, only: rectangular_axes
   use element_kinds, only: kind_edge2, max_nodes
   use element_unknowns, only: displaced_nodes
   use isoparametric, only: body_forces
   use kinds, only: wp
   use load_data, only: gravity_card
   use bubble_mass, only: area_mass
   use mass_matrix, only: bar_mass, scalar_mass
   use mesh_queries, only: element_points, is_beam, is_scalar_point, is_shell, n_points, node_kind
   use model_data, only: a_point, freedoms_type, mesh_type, stage_load_type
   use model_kind, only: space_hint
   use node_coupling, only: add_section_share
   use numbers, only: cross, identity
   use structural_elements, only: add_bubble_load, onto_own
   use tapered_beam, only: beam_station
   use text_tools, only: integer_text, one_of
   use tolerances, only: past_the_end, zero_component
   implicit none
   private

   public :: add_gravity, add_to_beam, check_plane, find_beam_loads, find_fields

   !> The acceleration of all masses by a card, with the sign of its force: uniform (gravity), or linear in the distance from an
   !! axis (rotation), a(x) = UNIFORM + GRADIENT (x - ORIGIN).
   type, extends(gravity_card), public :: acceleration_field
      real(wp) :: uniform(3) = 0.0_wp        !! [length/time^2]
      real(wp) :: gradient(3, 3) = 0.0_wp    !! [1/time^2]
      real(wp) :: origin(3) = 0.0_wp         !! [length]
   end type acceleration_field

contains

   !> Error: a z component of VECTOR in a plane model, from FIELD of the card on LINE.
   subroutine check_plane(deck, mesh, line, vector, field)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)            :: line
      real(wp), intent(in)           :: vector(3) !! in global axes
      character(*), intent(in)       :: field     !! N3; CID, or the first node of a line that gives the direction

      if (mesh%dimension == 3 .or. abs(vector(3)) <= zero_component*norm2(vector)) return
      call deck%field_error(line, field, one_of(field == 'N3', 'not zero', 'the load points out of the plane')// &
                            ', but a plane model lies in x-y'//space_hint(mesh))
   end subroutine check_plane

   !> Whether a body, a bar or a node has a mass.
   pure logical function has_mass(deck, mesh)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh

      has_mass = any(mesh%properties%rho > 0.0_wp) .or. any(mesh%properties%extra_mass > 0.0_wp) .or. &
                 any(deck%bulk%beam_property%extra_mass > 0.0_wp) .or. any(deck%bulk%mass%mass > 0.0_wp) .or. &
                 any(mesh%bars%mass > 0.0_wp)
   end function has_mass

   !> Whether SET has no forces and pressures, nor a LOAD that adds other sets to it.
   pure logical function is_alone(bulk, set)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: set
      integer :: k

      is_alone = all(bulk%force%set /= set) .and. all(bulk%pressure%set /= set) .and. all(bulk%surface_load%set /= set)
      do k = 1, size(bulk%load)
         associate (parts => bulk%load(k)%sets)
            is_alone = is_alone .and. (all(parts /= set) .or. all(parts == set))
         end associate
      end do
   end function is_alone

   !> The FIELDS of the GRAV, ACCEL1 and RFORCE cards. Errors: no mass; a direction or an axis that the model does not have.
   subroutine find_fields(deck, mesh, fields)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      type(acceleration_field), allocatable, intent(out) :: fields(:)
      real(wp) :: axes(3, 3)
      integer  :: i

      allocate (fields(size(deck%bulk%gravity)))
      do i = 1, size(fields)
         fields(i)%gravity_card = deck%bulk%gravity(i)
         associate (field => fields(i))
            call rectangular_axes(deck, mesh%systems, field%line, field%system, &
                                  one_of(field%is_spin, 'the axis has', 'gravity has')//' one direction everywhere', axes)
            field%uniform = matmul(axes, field%acceleration)
            if (field%is_spin) then
               call set_spin(field)
            else
               if (allocated(field%nodes%first)) call check_listed(field)
               call check_plane(deck, mesh, field%line, field%uniform, one_of(field%system > 0, 'CID', 'N3'))
               if (mesh%axisymmetric .and. abs(field%uniform(1)) > zero_component*norm2(field%uniform)) &
                  call deck%field_error(field%line, 'N1', 'not zero, but in an axisymmetric model gravity acts along y')
            end if
            if (has_mass(deck, mesh)) cycle
            if (is_alone(deck%bulk, field%set)) then
               call deck%errors%add(field%line, deck%card_on(field%line)//': no body has a mass; give RHO on its MAT1')
            else
               call deck%errors%warn(deck%card_on(field%line)//' ('//deck%text%place(field%line)//') has no effect: no body '// &
                                     'has a mass; RHO on MAT1 would give one')
            end if
         end associate
      end do

   contains

      !> Errors of an ACCEL1: missing nodes; beams in the model, because the mass of a beam does not belong to its nodes.
      subroutine check_listed(card)
         class(gravity_card), intent(in) :: card
         integer :: k

         do k = 1, size(card%nodes%first)
            if (.not. any(mesh%node_id >= card%nodes%first(k) .and. mesh%node_id <= card%nodes%last(k))) &
               call deck%field_error(card%line, card%nodes%at(k), 'there is no GRID '//integer_text(card%nodes%first(k)), &
                                     called='GRID')
         end do
         if (any([(is_beam(mesh, k), k = 1, mesh%n_elements)])) call deck%errors%add(card%line, &
            'ACCEL1: the masses of beams belong to no node; expected GRAV, or CONM2 in place of RHO')
      end subroutine check_listed

      !> The FIELD of an RFORCE: a = -(w x (w x r)) - dw/dt x r, r from its node, with the sign of the force.
      !! Errors: an axis other than z in the plane, or y in an axisymmetric model.
      subroutine set_spin(field)
         type(acceleration_field), intent(inout) :: field
         real(wp) :: axis(3), rate(3), w(3)
         integer  :: c, node

         node = 0
         if (field%node > 0) then
            node = mesh%node_table%find(field%node)
            if (node == 0) call deck%field_error(field%line, 'G', 'there is no GRID '//integer_text(field%node))
         end if
         if (node > 0) field%origin = mesh%x(:, node)
         w = matmul(axes, field%spin)
         rate = matmul(axes, field%spin_rate)
         do c = 1, 3
            field%gradient(:, c) = -(cross(w, cross(w, identity(:, c))) + cross(rate, identity(:, c)))
         end do
         axis = abs(w) + abs(rate)
         if (mesh%axisymmetric) then
            field%gradient(:, 3) = 0.0_wp
            if (maxval(axis([1, 3])) > zero_component*maxval(axis)) call deck%field_error(field%line, 'R1', &
               'a ring turns about y; expected R1 and R3 zero')
            if (any(abs(field%spin_rate) > 0.0_wp)) call deck%field_error(field%line, 'RACC', &
               'not zero, but an axisymmetric model has no circumferential forces')
         else if (mesh%dimension == 2) then
            if (maxval(axis(:2)) > zero_component*maxval(axis)) call deck%field_error(field%line, 'R1', &
               'a plane model turns about z; expected R1 and R2 zero'//space_hint(mesh))
         end if
      end subroutine set_spin

   end subroutine find_fields

   !> Add FACTOR times the FIELDS of SET: end forces of beams to LOADS, nodal forces to FORCE. An ACCEL1 acts at its nodes alone.
   subroutine add_gravity(mesh, freedoms, fields, set, factor, loads, force)
      type(mesh_type), intent(in)          :: mesh
      type(freedoms_type), intent(in)      :: freedoms
      type(acceleration_field), intent(in) :: fields(:)
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      type(acceleration_field) :: field
      real(wp), allocatable :: everywhere(:, :)
      integer :: i, node

      do i = 1, size(fields)
         if (fields(i)%set /= set) cycle
         field = fields(i)
         field%uniform = factor*field%uniform
         field%gradient = factor*field%gradient
         if (.not. allocated(field%nodes%first)) then
            call add_field(mesh, freedoms, field, loads, force)
            cycle
         end if
         everywhere = spread(spread(0.0_wp, 1, 3), 2, mesh%n_nodes)
         call add_field(mesh, freedoms, field, loads, everywhere)
         do node = 1, n_points(mesh)
            associate (id => mesh%node_id(node))
               if (any(id >= field%nodes%first .and. id <= field%nodes%last)) force(:, node) = force(:, node) + everywhere(:, node)
            end associate
         end do
      end do
   end subroutine add_gravity

   !> The stations x/L of beam E: its ends and those of its PBEAM.
   pure function stations_of(mesh, e) result(at)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e
      real(wp), allocatable :: at(:)

      associate (law => mesh%structural%beams(mesh%structural%place(e)))
         if (allocated(law%stations)) then
            at = law%stations%at
         else
            at = [0.0_wp, 1.0_wp]
         end if
      end associate
   end function stations_of

   !> The acceleration of FIELD at X [length/time^2].
   pure function acceleration_at(field, x) result(a)
      type(acceleration_field), intent(in) :: field
      real(wp), intent(in)                 :: x(3)
      real(wp) :: a(3)

      a = field%uniform
      if (field%is_spin) a = a + matmul(field%gradient, x - field%origin)
   end function acceleration_at

   !> Add the forces of an acceleration FIELD on all masses: end forces of beams to LOADS, nodal forces to FORCE.
   subroutine add_field(mesh, freedoms, field, loads, force)
      type(mesh_type), intent(in)          :: mesh
      type(freedoms_type), intent(in)      :: freedoms
      type(acceleration_field), intent(in) :: field
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes)
      real(wp) :: a(3, 2*max_nodes), f(mesh%dimension, 2*max_nodes), m(2*max_nodes, 2*max_nodes), q(6, 2), x(3, 2)
      real(wp) :: load(12)
      type(beam_station) :: section
      integer  :: e, end, i, k

      do e = 1, mesh%n_elements
         if (any(element_points(mesh, e) == 0) .or. mesh%element_property(e) == 0 .or. is_beam(mesh, e)) cycle
         associate (corners => element_points(mesh, e), d => mesh%dimension)
            if (.not. field%is_spin .and. .not. is_shell(mesh, e)) then
               call body_forces(law_of(mesh, e), mesh%x(:d, corners), &
                                mesh%properties(mesh%element_property(e))%rho*field%uniform(:d), f)
            else ! from the translational mass alone: at constant speed rotations do not accelerate
               call scalar_mass(mesh, e, .false., m) ! weight does not depend on MASS
               do k = 1, size(corners)
                  a(:, k) = acceleration_at(field, mesh%x(:, corners(k)))
               end do
               f(:, :size(corners)) = matmul(a(:d, :size(corners)), m(:size(corners), :size(corners)))
            end if
            force(:d, corners) = force(:d, corners) + f(:, :size(corners))
            call add_section_share(mesh, e, corners, f, force)
            if (is_shell(mesh, e)) call add_bubble_load(mesh, e, a(:, :size(corners))*spread(area_mass(mesh, e), 1, 3), force)
         end associate
      end do
      do e = 1, mesh%n_elements
         if (.not. is_beam(mesh, e)) cycle
         x = mesh%x(:, element_points(mesh, e))
         associate (law => mesh%structural%beams(mesh%structural%place(e)), at => stations_of(mesh, e))
            load = 0.0_wp
            do k = 1, size(at) - 1
               q = 0.0_wp
               do end = 1, 2
                  section = beam_section_at(law, at(k - 1 + end))
                  q(:3, end) = (law%rho*section%area + section%extra_mass)*acceleration_at(field, (1.0_wp - at(k - 1 + end))* &
                     (x(:, 1) + law%offset(:, 1)) + at(k - 1 + end)*(x(:, 2) + law%offset(:, 2)))
               end do
               load = load + beam_line_load(law, x, q, at(k), at(k + 1))
            end do
            call add_to_beam(mesh, freedoms, e, load, loads, force)
         end associate
      end do
      do k = 1, size(mesh%bars)
         associate (bar => mesh%bars(k), d => mesh%dimension)
            if (.not. bar%mass > 0.0_wp) cycle
            do end = 1, 2
               a(:, end) = acceleration_at(field, mesh%x(:, bar%nodes(end)))
            end do
            force(:d, bar%nodes) = force(:d, bar%nodes) + matmul(a(:d, :2), bar_mass(mesh, k))
         end associate
      end do
      do k = 1, size(mesh%masses)
         if (is_scalar_point(mesh, mesh%masses(k)%node)) cycle
         associate (point => mesh%masses(k), acceleration => acceleration_at(field, mesh%x(:, mesh%masses(k)%node)))
            force(:, point%node) = force(:, point%node) + point%mass*acceleration + matmul(point%directed, acceleration)
            if (.not. allocated(point%matrix)) cycle
            do i = 1, size(point%nodes) ! all its points have this acceleration
               if (node_kind(mesh, point%nodes(i)) /= a_point) cycle
               associate (d => mesh%dimension, n => size(point%nodes))
                  force(:d, point%nodes) = force(:d, point%nodes) + &
                                           reshape(matmul(point%matrix(:, d*(i - 1) + 1:d*i), acceleration(:d)), [d, n])
               end associate
            end do
         end associate
      end do
   end subroutine add_field

   !> The BEAM that each PLOAD1 loads, and its end forces F in the axes of the beam [force], [moment]; 0 for a card in error.
   !! Errors: no such beam, a position beyond its end, a direction that a plane model does not have.
   subroutine find_beam_loads(deck, mesh, beam, f)
      type(checked_deck), intent(in)     :: deck
      type(mesh_type), intent(in) :: mesh
      integer, allocatable, intent(out)  :: beam(:) !! (cards) the element
      real(wp), allocatable, intent(out) :: f(:, :) !! (12, cards)
      real(wp) :: length
      integer  :: e, i

      allocate (beam(size(deck%bulk%beam_load)), source=0)
      allocate (f(12, size(beam)), source=0.0_wp)
      do i = 1, size(beam)
         associate (card => deck%bulk%beam_load(i))
            e = findloc(mesh%element_id == card%element .and. mesh%element_kind == kind_edge2, .true., dim=1)
            if (card%element > 0 .and. e == 0) call deck%field_error(card%line, 'EID', 'there is no beam '// &
               integer_text(card%element)//': no CBAR or CBEAM with a PBAR, PBARL, PBEAM or PBEAML')
            if (e == 0 .or. deck%errors%any()) cycle
            length = beam_length(mesh%structural%beams(mesh%structural%place(e)), mesh%x(:, element_points(mesh, e)))
            if (.not. card%is_fraction .and. any(card%x > length*(1.0_wp + past_the_end))) &
               call deck%field_error(card%line, 'X1', 'X1 or X2 lies beyond the end of the beam')
            if (mesh%dimension == 2 .and. card%kind <= 6 .and. any(load_types(card%kind) == ['FZ ', 'MX ', 'MY '])) &
               call deck%field_error(card%line, 'TYPE', trim(load_types(card%kind))//' in a plane model, which lies in x-y'// &
                                     space_hint(mesh))
            beam(i) = e
            f(:, i) = at_ends(mesh, e, card)
         end associate
      end do
   end subroutine find_beam_loads

   !> The end forces of beam E under the load of CARD, in the axes of the beam.
   pure function at_ends(mesh, e, card) result(f)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)              :: e
      type(beam_load_card), intent(in) :: card
      real(wp) :: f(12), axes(3, 3), q(6, 2), s(2), direction(3)
      integer  :: first, k

      associate (law => mesh%structural%beams(mesh%structural%place(e)), x => mesh%x(:, element_points(mesh, e)))
         s = card%x
         if (.not. card%is_fraction) s = min(1.0_wp, s/beam_length(law, x))
         axes = beam_axes(law, x)
         direction = 0.0_wp
         direction(modulo(card%kind - 1, 3) + 1) = 1.0_wp
         if (card%kind > 6) direction = axes(:, modulo(card%kind - 1, 3) + 1)
         q = 0.0_wp
         first = merge(3, 0, modulo(card%kind - 1, 6) >= 3)
         do k = 1, 2
            q(first + 1:first + 3, k) = card%p(k)*direction
         end do
         if (s(2) > s(1)) then
            if (card%is_projected .and. card%kind <= 6) q = q*norm2(direction - dot_product(direction, axes(:, 1))*axes(:, 1))
            f = beam_line_load(law, x, q, s(1), s(2))
         else
            f = beam_point_load(law, x, q(:, 1), s(1))
         end if
      end associate
   end function at_ends

   !> Add the end forces F of beam E to LOADS, and the equivalent nodal forces to FORCE.
   subroutine add_to_beam(mesh, freedoms, e, f, loads, force)
      type(mesh_type), intent(in)          :: mesh
      type(freedoms_type), intent(in)      :: freedoms
      integer, intent(in)                  :: e
      real(wp), intent(in)                 :: f(12)
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      real(wp) :: nodal(mesh%dimension, 4)

      associate (place => mesh%structural%place(e), d => mesh%dimension)
         if (.not. allocated(loads%beam)) allocate (loads%beam(12, size(mesh%structural%beams)), source=0.0_wp)
         loads%beam(:, place) = loads%beam(:, place) + f
         call onto_own(mesh, e, beam_nodal_forces(mesh%structural%beams(place), mesh%x(:, element_points(mesh, e)), f), nodal)
         associate (nodes => displaced_nodes(freedoms, e))
            force(:d, nodes) = force(:d, nodes) + nodal
         end associate
      end associate
   end subroutine add_to_beam

end module body_loads
