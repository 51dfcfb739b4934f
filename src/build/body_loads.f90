!> Loads on bodies: GRAV, ACCEL1, RFORCE and PLOAD1 as nodal forces and as end forces of beams.
!! GRAV, ACCEL1 and RFORCE act on masses, PLOAD1 along beams.
module body_loads
   use property_cards, only: load_types
   use beam_element, only: beam_axes, beam_length, beam_line_load, beam_nodal_forces, beam_point_load
   use body_elements, only: law_of
   use bulk_data, only: beam_load_card, gravity_card
   use deck_check, only: checked_deck
   use displacement_systems, only: rectangular_axes
   use element_kinds, only: max_nodes
   use isoparametric, only: body_forces
   use kinds, only: wp
   use load_checks, only: check_plane
   use mass_matrix, only: scalar_mass
   use model_data, only: corners_of, is_beam, is_shell, model_type, n_points, own_nodes, stage_load_type
   use node_coupling, only: add_section_share
   use numbers, only: cross, identity
   use structural_elements, only: onto_own
   use text_tools, only: integer_text
   implicit none
   private

   public :: add_beam_loads, add_gravity, check_beam_loads, check_gravity

   !> An acceleration of all masses, with the sign of its force: uniform (gravity), or linear in the distance from an axis (rotation),
   !! a(x) = UNIFORM + GRADIENT (x - ORIGIN).
   type :: acceleration_field
      logical  :: is_uniform = .true.
      real(wp) :: uniform(3) = 0.0_wp        ! [length/time^2]
      real(wp) :: gradient(3, 3) = 0.0_wp    ! [1/time^2]
      real(wp) :: origin(3) = 0.0_wp         ! [length]
   end type acceleration_field

   character(*), parameter :: everywhere = ' one direction everywhere'

contains

   !> Errors: GRAV or RFORCE without a mass, or in a direction that the model does not have.
   subroutine check_gravity(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      real(wp) :: axes(3, 3), acceleration(3)
      integer  :: i

      do i = 1, size(deck%bulk%gravity)
         associate (card => deck%bulk%gravity(i))
            if (card%is_spin) then
               call rectangular_axes(deck, model%systems, card%line, card%system, 'the axis has'//everywhere, axes)
               call check_spin(deck, model, card, axes)
            else
               call rectangular_axes(deck, model%systems, card%line, card%system, 'gravity has'//everywhere, axes)
               acceleration = matmul(axes, card%acceleration)
               if (allocated(card%nodes%first)) call check_listed(deck, model, card)
               call check_plane(deck, model, card%line, acceleration, turned=card%system > 0)
               if (model%axisymmetric .and. abs(acceleration(1)) > 1.0e-12_wp*norm2(acceleration)) &
                  call deck%field_error(card%line, 'N1', 'not zero, but in an axisymmetric model gravity acts along y')
            end if
            if (all(model%properties%rho <= 0.0_wp) .and. all(deck%bulk%mass%mass <= 0.0_wp)) call deck%errors%add(card%line, &
               trim(merge('RFORCE', 'GRAV  ', card%is_spin))//': no body has a mass; give RHO on its MAT1')
         end associate
      end do
   end subroutine check_gravity

   !> Errors of an ACCEL1: missing nodes; beams in the model, because the mass of a beam does not belong to its nodes.
   subroutine check_listed(deck, model, card)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(gravity_card), intent(in) :: card
      integer :: k

      do k = 1, size(card%nodes%first)
         if (.not. any(model%node_id >= card%nodes%first(k) .and. model%node_id <= card%nodes%last(k))) &
            call deck%field_error(card%line, card%nodes%at(k), 'there is no GRID '//integer_text(card%nodes%first(k)), &
                                  called='GRID')
      end do
      if (any([(is_beam(model, k), k = 1, model%n_elements)])) call deck%errors%add(card%line, &
         'ACCEL1: the masses of beams belong to no node; expected GRAV, or CONM2 in place of RHO')
   end subroutine check_listed

   !> Errors of an RFORCE whose axis, given along AXES, is not z in the plane, or not y in an axisymmetric model.
   subroutine check_spin(deck, model, card, axes)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(gravity_card), intent(in) :: card
      real(wp), intent(in)           :: axes(3, 3)
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: axis(3)

      if (card%node > 0 .and. model%node_table%find(card%node) == 0) &
         call deck%field_error(card%line, 'G', 'there is no GRID '//integer_text(card%node))
      axis = abs(matmul(axes, card%spin)) + abs(matmul(axes, card%spin_rate))
      if (model%axisymmetric) then
         if (maxval(axis([1, 3])) > rounding*maxval(axis)) call deck%field_error(card%line, 'R1', &
            'a ring turns about y; expected R1 and R3 zero')
         if (any(abs(card%spin_rate) > 0.0_wp)) call deck%field_error(card%line, 'RACC', &
            'not zero, but an axisymmetric model has no circumferential forces')
      else if (model%dimension == 2) then
         if (maxval(axis(:2)) > rounding*maxval(axis)) call deck%field_error(card%line, 'R1', &
            'a plane model turns about z; expected R1 and R2 zero')
      end if
   end subroutine check_spin

   !> Add FACTOR times the GRAV, ACCEL1 and RFORCE of SET: end forces of beams to LOADS, nodal forces to FORCE.
   subroutine add_gravity(deck, model, set, factor, loads, force)
      type(checked_deck), intent(in)       :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      type(acceleration_field) :: field
      integer :: i

      do i = 1, size(deck%bulk%gravity)
         if (deck%bulk%gravity(i)%set /= set) cycle
         field = field_of(deck, model, deck%bulk%gravity(i), factor)
         if (allocated(deck%bulk%gravity(i)%nodes%first)) then
            call add_listed(model, field, deck%bulk%gravity(i), force)
            cycle
         end if
         call add_body_gravity(model, field, force)
         call add_beam_gravity(model, field, loads, force)
         call add_mass_weights(model, field, force)
      end do
   end subroutine add_gravity

   !> Add the forces of the nodal masses.
   pure subroutine add_mass_weights(model, field, force)
      type(model_type), intent(in)         :: model
      type(acceleration_field), intent(in) :: field
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      integer :: k

      do k = 1, size(model%masses)
         associate (point => model%masses(k), a => acceleration_at(field, model%x(:, model%masses(k)%node)))
            force(:, point%node) = force(:, point%node) + point%mass*a + matmul(point%directed, a)
         end associate
      end do
   end subroutine add_mass_weights

   !> Add the forces of FIELD on the masses at the nodes of CARD, an ACCEL1.
   subroutine add_listed(model, field, card, force)
      type(model_type), intent(in)         :: model
      type(acceleration_field), intent(in) :: field
      type(gravity_card), intent(in)       :: card
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      real(wp) :: all_nodes(size(force, 1), size(force, 2))
      integer  :: node

      all_nodes = 0.0_wp
      call add_body_gravity(model, field, all_nodes)
      call add_mass_weights(model, field, all_nodes)
      do node = 1, n_points(model)
         associate (id => model%node_id(node))
            if (any(id >= card%nodes%first .and. id <= card%nodes%last)) force(:, node) = force(:, node) + all_nodes(:, node)
         end associate
      end do
   end subroutine add_listed

   !> The field of CARD times FACTOR. RFORCE: a = -(w x (w x r)) - dw/dt x r, r from its node, with the sign of the force.
   function field_of(deck, model, card, factor) result(field)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      type(gravity_card), intent(in) :: card
      real(wp), intent(in)           :: factor
      type(acceleration_field) :: field
      real(wp) :: axes(3, 3)
      integer  :: c, node

      call rectangular_axes(deck, model%systems, card%line, card%system, 'masses have'//everywhere, axes)
      field%uniform = factor*matmul(axes, card%acceleration)
      if (.not. card%is_spin) return
      field%is_uniform = .false.
      node = 0
      if (card%node > 0) node = model%node_table%find(card%node)
      if (node > 0) field%origin = model%x(:, node)
      associate (w => matmul(axes, card%spin), rate => matmul(axes, card%spin_rate))
         do c = 1, 3
            field%gradient(:, c) = -factor*(cross(w, cross(w, identity(:, c))) + cross(rate, identity(:, c)))
         end do
      end associate
      if (model%axisymmetric) field%gradient(:, 3) = 0.0_wp
   end function field_of

   !> The acceleration of FIELD at X [length/time^2].
   pure function acceleration_at(field, x) result(a)
      type(acceleration_field), intent(in) :: field
      real(wp), intent(in)                 :: x(3)
      real(wp) :: a(3)

      a = field%uniform
      if (.not. field%is_uniform) a = a + matmul(field%gradient, x - field%origin)
   end function acceleration_at

   !> Add the nodal forces of the masses of all bodies except beams under an acceleration FIELD.
   subroutine add_body_gravity(model, field, force)
      type(model_type), intent(in)         :: model
      type(acceleration_field), intent(in) :: field
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes)
      real(wp) :: a(3, 2*max_nodes), f(model%dimension, 2*max_nodes), m(2*max_nodes, 2*max_nodes)
      integer  :: e, k

      do e = 1, model%n_elements
         if (any(corners_of(model, e) == 0) .or. model%element_property(e) == 0 .or. is_beam(model, e)) cycle
         associate (nodes => own_nodes(model, e), d => model%dimension)
            if (field%is_uniform .and. .not. is_shell(model, e)) then
               call body_forces(law_of(model, e), model%x(:d, corners_of(model, e)), &
                                model%properties(model%element_property(e))%rho*field%uniform(:d), f)
            else ! from the translational mass alone: at constant speed rotations do not accelerate
               associate (corners => corners_of(model, e))
                  call scalar_mass(model, e, m)
                  f = 0.0_wp
                  do k = 1, size(corners)
                     a(:, k) = acceleration_at(field, model%x(:, corners(k)))
                  end do
                  f(:, :size(corners)) = matmul(a(:d, :size(corners)), m(:size(corners), :size(corners)))
               end associate
            end if
            force(:d, nodes) = force(:d, nodes) + f(:, :size(nodes))
            call add_section_share(model, e, nodes, f, force)
         end associate
      end do
   end subroutine add_body_gravity

   !> Add the forces of an acceleration FIELD on all beams: end forces to LOADS, nodal forces to FORCE.
   subroutine add_beam_gravity(model, field, loads, force)
      type(model_type), intent(in)         :: model
      type(acceleration_field), intent(in) :: field
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes)
      real(wp) :: q(6, 2), x(3, 2)
      integer  :: e, end

      do e = 1, model%n_elements
         if (.not. is_beam(model, e)) cycle
         x = model%x(:, corners_of(model, e))
         associate (law => model%structural%beams(model%structural%place(e)))
            q = 0.0_wp
            do end = 1, 2
               q(:3, end) = (law%rho*law%area + law%extra_mass)*acceleration_at(field, x(:, end) + law%offset(:, end))
            end do
            call add_to_beam(model, e, beam_line_load(law, x, q, 0.0_wp, 1.0_wp), loads, force)
         end associate
      end do
   end subroutine add_beam_gravity

   !> Errors of PLOAD1: no such beam, a position beyond its end, a direction that a plane model does not have.
   subroutine check_beam_loads(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      real(wp) :: length
      integer  :: e, i

      do i = 1, size(deck%bulk%beam_load)
         associate (card => deck%bulk%beam_load(i))
            e = beam_of(model, card)
            if (card%element > 0 .and. e == 0) call deck%field_error(card%line, 'EID', 'there is no beam '// &
               integer_text(card%element)//': no CBAR or CBEAM with a PBAR, PBARL, PBEAM or PBEAML')
            if (e == 0 .or. deck%errors%any()) cycle
            length = beam_length(model%structural%beams(model%structural%place(e)), model%x(:, corners_of(model, e)))
            if (.not. card%is_fraction .and. any(card%x > length*(1.0_wp + 1.0e-9_wp))) &
               call deck%field_error(card%line, 'X1', 'X1 or X2 lies beyond the end of the beam')
            if (model%dimension == 2 .and. card%kind <= 6 .and. any(load_types(card%kind) == ['FZ ', 'MX ', 'MY '])) &
               call deck%field_error(card%line, 'TYPE', trim(load_types(card%kind))//' in a plane model, which lies in x-y')
         end associate
      end do
   end subroutine check_beam_loads

   !> The beam that a CARD names; 0: there is none.
   pure integer function beam_of(model, card) result(e)
      type(model_type), intent(in)     :: model
      type(beam_load_card), intent(in) :: card

      e = findloc(model%element_id, card%element, dim=1)
      if (e == 0) return
      if (.not. is_beam(model, e)) e = 0
   end function beam_of

   !> Add FACTOR times the end forces of the PLOAD1 of SET to LOADS, and their nodal forces to FORCE.
   subroutine add_beam_loads(deck, model, set, factor, loads, force)
      type(checked_deck), intent(in)       :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      integer :: e, i

      do i = 1, size(deck%bulk%beam_load)
         if (deck%bulk%beam_load(i)%set /= set) cycle
         e = beam_of(model, deck%bulk%beam_load(i))
         if (e > 0) call add_to_beam(model, e, factor*at_ends(model, e, deck%bulk%beam_load(i)), loads, force)
      end do
   end subroutine add_beam_loads

   !> The end forces of beam E under the load of CARD, in the axes of the beam.
   pure function at_ends(model, e, card) result(f)
      type(model_type), intent(in)     :: model
      integer, intent(in)              :: e
      type(beam_load_card), intent(in) :: card
      real(wp) :: f(12), axes(3, 3), q(6, 2), s(2), direction(3)
      integer  :: first, k

      associate (law => model%structural%beams(model%structural%place(e)), x => model%x(:, corners_of(model, e)))
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
   subroutine add_to_beam(model, e, f, loads, force)
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: e
      real(wp), intent(in)                 :: f(12)
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      real(wp) :: own(model%dimension, 4)

      associate (place => model%structural%place(e), d => model%dimension)
         if (.not. allocated(loads%beam)) allocate (loads%beam(12, size(model%structural%beams)), source=0.0_wp)
         loads%beam(:, place) = loads%beam(:, place) + f
         call onto_own(model, e, beam_nodal_forces(model%structural%beams(place), model%x(:, corners_of(model, e)), f), own)
         associate (nodes => own_nodes(model, e))
            force(:d, nodes) = force(:d, nodes) + own
         end associate
      end associate
   end subroutine add_to_beam

end module body_loads
