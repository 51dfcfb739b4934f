!> Masses: CONM1, CONM2 and CMASS1 to CMASS4 at nodes, those of CBUSH, consistent or lumped element masses, a check of
!! bodies without mass.
module mass_build
   use bulk_data, only: mass_card
   use bush_build, only: bush_type
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions, find_system
   use kinds, only: wp
   use model_data, only: freedoms_type, mesh_type, n_bars, point_mass_type
   use numbers, only: identity
   use shell_faces, only: mass_offset
   use text_tools, only: integer_text, one_of
   use tolerances, only: indefinite_inertia
   use unknowns, only: component_place, node_axes, place_of_component, rotation_at
   implicit none
   private

   public :: build_masses, check_masses, check_mass

contains

   !> Fill the nodal masses of the model, times PARAM WTMASS, and set lumped or consistent element masses. A CONM2 with an offset has
   !! its mass at a node of its own, at the offset, and its inertia about its centre of mass.
   subroutine build_masses(deck, bushes, mesh)
      type(checked_deck), intent(in)  :: deck
      type(bush_type), intent(in)     :: bushes(:)
      type(mesh_type), intent(inout) :: mesh
      type(component_place) :: place
      real(wp) :: along(3, 3), axes(3, 3), mass
      integer  :: c, i, k, n, n_off, system
      logical  :: ok

      mesh%lumped = deck%control%lumped
      associate (parameters => deck%bulk%parameters)
         if (parameters%mass_line > 0 .and. .not. deck%control%mass_is_given) then
            mesh%lumped = parameters%lumped
         else if (parameters%mass_line > 0 .and. (parameters%lumped .neqv. mesh%lumped)) then
            call deck%errors%add(parameters%mass_line, 'PARAM COUPMASS asks for '// &
               one_of(parameters%lumped, 'lumped', 'consistent')//' mass, but MASS in case control does not; expected '// &
                  'only one of them')
         end if
      end associate
      deallocate (mesh%masses)
      allocate (mesh%masses(2*size(deck%bulk%mass) + 2*size(bushes)))
      n = 0
      n_off = 0
      do i = 1, size(deck%bulk%mass)
         associate (card => deck%bulk%mass(i), node => mesh%node_table%find(deck%bulk%mass(i)%node))
            if (node == 0) cycle
            n = n + 1
            mesh%masses(n)%node = node
            if (card%is_directed) then ! for a rotation the moment of inertia about its axis
               place = place_of_component(mesh, node, card%component)
               if (place%node == 0) call deck%field_error(card%line, one_of(card%is_scalar, 'S1', 'C1'), 'node '// &
                  integer_text(card%node)//' has no component '//integer_text(card%component))
               mass = card%mass
               k = findloc(deck%bulk%pmass%id, card%property, dim=1)
               if (card%property > 0 .and. k > 0) mass = deck%bulk%pmass(k)%mass
               if (card%property > 0 .and. k == 0) call deck%field_error(card%line, 'PID', 'there is no PMASS '// &
                                                                         integer_text(card%property))
               mass = deck%bulk%parameters%mass_factor*mass
               if (card%node_2 > 0) call join_components(deck, card, mass, mesh, mesh%masses(n))
               if (card%node_2 > 0 .or. place%node == 0) cycle
               axes = node_axes(mesh, node)
               c = modulo(max(card%component, 1) - 1, 3) + 1
               along = mass*spread(axes(:, c), 2, 3)*spread(axes(:, c), 1, 3)
               if (card%component <= 3) mesh%masses(n)%directed = along
               if (card%component > 3) mesh%masses(n)%inertia = along
               cycle
            end if
            if (allocated(card%matrix)) then
               call fill_matrix(deck, card, mesh, mesh%masses(n))
               cycle
            end if
            mesh%masses(n)%mass = deck%bulk%parameters%mass_factor*card%mass
            ! the inertia from the system of the card to global axes; I21 is the integral of x_1 x_2 over the mass
            associate (i11 => card%inertia(1), i21 => card%inertia(2), i22 => card%inertia(3), i31 => card%inertia(4), &
                       i32 => card%inertia(5), i33 => card%inertia(6), inertia => mesh%masses(n)%inertia)
               inertia = deck%bulk%parameters%mass_factor*reshape([i11, -i21, -i31, -i21, i22, -i32, -i31, -i32, i33], [3, 3])
               if (any(deck%control%stages%vibration%modes%id /= 0) .and. .not. is_inertia(inertia)) call deck%field_error( &
                  card%line, 'I11', 'not a possible inertia tensor: it must be positive semidefinite')
               call find_system(deck, card%line, 'CID', max(card%system, 0), mesh%systems, system)
               ok = system > 0 .and. any(abs(card%inertia) > 0.0_wp)
               if (ok) call find_directions(deck, mesh%systems, card%line, max(card%system, 0), mesh%x(:, node), axes, ok)
               if (ok) inertia = matmul(axes, matmul(inertia, transpose(axes)))
            end associate
            if (all(abs(mass_offset(card, mesh%x(:, node))) <= 0.0_wp)) cycle
            if (rotation_at(mesh, node) == 0) call deck%field_error(card%line, 'X1', 'node '//integer_text(card%node)// &
               ' has no rotations, by which a mass beside it would move; expected a node of shells or beams, or the reference '// &
               'node of an RBE2, RBE3 or RBAR')
            mesh%masses(n)%mass = 0.0_wp
            n = n + 1
            n_off = n_off + 1 ! nodes of masses with offset are the first face nodes
            mesh%masses(n)%node = node
            if (n_off <= size(mesh%faces)) mesh%masses(n)%node = mesh%faces(n_off)%node ! otherwise the deck has errors
            mesh%masses(n)%mass = deck%bulk%parameters%mass_factor*card%mass
         end associate
      end do
      do i = 1, size(bushes) ! half of M at each node of a bush
         if (.not. bushes(i)%is_whole) cycle
         mass = 0.5_wp*deck%bulk%parameters%mass_factor*deck%bulk%spring_property(bushes(i)%property)%mass
         do k = 1, merge(2, 1, bushes(i)%nodes(2) > 0)
            if (.not. mass > 0.0_wp) cycle
            n = n + 1
            mesh%masses(n)%node = bushes(i)%nodes(k)
            mesh%masses(n)%mass = mass
         end do
      end do
      mesh%masses = mesh%masses(:n)
   end subroutine build_masses

   !> MASS of a CMASS that resists the difference of two components: M e e^T, e = 1 at the first, -1 at the second.
   subroutine join_components(deck, card, m, mesh, mass)
      type(checked_deck), intent(in) :: deck
      type(mass_card), intent(in)    :: card
      real(wp), intent(in)           :: m
      type(mesh_type), intent(in)    :: mesh
      type(point_mass_type), intent(inout) :: mass
      type(component_place) :: place
      real(wp) :: axes(3, 3), e(2*mesh%dimension)
      integer  :: components(2), k, points(2)

      points = [mass%node, mesh%node_table%find(card%node_2)]
      components = [card%component, card%component_2]
      mass%nodes = points
      do k = 1, 2
         place = component_place()
         if (points(k) > 0) place = place_of_component(mesh, points(k), components(k))
         if (place%node == 0) call deck%field_error(card%line, one_of(card%is_scalar, 'S2', 'C2'), 'node '// &
            integer_text(card%node_2)//' has no component '//integer_text(components(k)))
         if (place%node == 0) return
         axes = node_axes(mesh, points(k))
         mass%nodes(k) = place%node
         associate (d => mesh%dimension)
            if (d == 2 .and. components(k) > 3) axes = identity ! the first component is the rotation
            e(d*(k - 1) + 1:d*k) = real(3 - 2*k, wp)*axes(:d, place%d)/place%scale
         end associate
      end do
      if (mass%nodes(1) == mass%nodes(2)) then ! components of one node
         mass%nodes = mass%nodes(:1)
         associate (d => mesh%dimension)
            e(:d) = e(:d) + e(d + 1:)
         end associate
      end if
      associate (n => mesh%dimension*size(mass%nodes))
         mass%matrix = m*spread(e(:n), 2, n)*spread(e(:n), 1, n)
      end associate
   end subroutine join_components

   !> MASS of a CONM1, a matrix between the components of its node in system CID.
   subroutine fill_matrix(deck, card, mesh, mass)
      type(checked_deck), intent(in) :: deck
      type(mass_card), intent(in)    :: card
      type(mesh_type), intent(in)    :: mesh
      type(point_mass_type), intent(inout) :: mass
      real(wp) :: axes(3, 3), m(6, 6), t(6, 6)
      integer  :: d, i, j, rotation
      logical  :: ok

      do i = 1, 6
         do j = 1, i
            m(i, j) = deck%bulk%parameters%mass_factor*card%matrix(i*(i - 1)/2 + j)
            m(j, i) = m(i, j)
         end do
      end do
      call find_directions(deck, mesh%systems, card%line, card%system, mesh%x(:, mass%node), axes, ok)
      t = 0.0_wp
      t(:3, :3) = axes
      t(4:, 4:) = axes
      m = matmul(t, matmul(m, transpose(t)))
      mass%inertia = m(4:, 4:)
      mass%nodes = [mass%node]
      d = mesh%dimension
      rotation = rotation_at(mesh, mass%node)
      if (rotation == 0) then
         mass%matrix = m(:d, :d)
         return
      end if
      mass%nodes = [mass%node, mesh%rotations(rotation)%node]
      m(4:, :) = m(4:, :)/mesh%rotations(rotation)%arm
      m(:, 4:) = m(:, 4:)/mesh%rotations(rotation)%arm
      if (d == 3) mass%matrix = m
      if (d == 3) return
      mass%matrix = reshape([(0.0_wp, i = 1, 16)], [4, 4]) ! the rotation about z is the first component of its node
      mass%matrix(:3, :3) = m([1, 2, 6], [1, 2, 6])
   end subroutine fill_matrix

   !> Error: the node of a mass belongs to no element.
   subroutine check_masses(deck, mesh, freedoms)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in)     :: mesh
      type(freedoms_type), intent(in) :: freedoms
      integer :: i
      logical :: is_used

      do i = 1, size(deck%bulk%mass)
         associate (card => deck%bulk%mass(i), node => mesh%node_table%find(deck%bulk%mass(i)%node))
            if (node == 0) cycle
            is_used = freedoms%used(node)
            if (rotation_at(mesh, node) > 0) is_used = is_used .or. freedoms%used(mesh%rotations(rotation_at(mesh, node))%node)
            if (.not. is_used) call deck%field_error(card%line, &
               one_of(card%is_directed, one_of(card%is_scalar, 'S1', 'G1'), 'G'), 'node '// &
                                                                 integer_text(card%node)//' belongs to no element')
         end associate
      end do
   end subroutine check_masses

   !> Whether A is positive semidefinite: no principal minor is negative, to rounding.
   pure logical function is_inertia(a)
      real(wp), intent(in) :: a(3, 3) !! symmetric
      real(wp) :: b(3, 3), size_of
      integer  :: i, j

      size_of = maxval(abs(a))
      is_inertia = .true.
      if (size_of <= 0.0_wp) return
      b = a/size_of
      do i = 1, 3
         j = modulo(i, 3) + 1
         is_inertia = is_inertia .and. b(i, i) >= 0.0_wp .and. b(i, i)*b(j, j) - b(i, j)**2 >= -indefinite_inertia
      end do
      is_inertia = is_inertia .and. b(1, 1)*(b(2, 2)*b(3, 3) - b(2, 3)**2) - b(1, 2)*(b(1, 2)*b(3, 3) - b(2, 3)*b(1, 3)) &
                   + b(1, 3)*(b(1, 2)*b(2, 3) - b(2, 2)*b(1, 3)) >= -indefinite_inertia
   end function is_inertia

   !> Error if the deck asks for MODES: a body without mass of its own, at its nodes, or in a bar connected to it.
   subroutine check_mass(deck, mesh, freedoms)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh !! with parts in which bolts connect bodies
      type(freedoms_type), intent(in) :: freedoms
      logical, allocatable :: has_mass(:)     ! (parts)
      integer :: e, i, line

      i = findloc(deck%control%stages%vibration%modes%id /= 0, .true., dim=1)
      if (i == 0) return
      line = deck%control%stages(i)%vibration%modes%line
      allocate (has_mass(freedoms%n_parts), source=.false.)
      do e = 1, mesh%n_elements
         if (mesh%properties(mesh%element_property(e))%rho > 0.0_wp) has_mass(freedoms%part(mesh%element_nodes(1, e))) = .true.
      end do
      do i = 1, size(mesh%masses)
         associate (mass => mesh%masses(i))
            if (mass%mass > 0.0_wp .or. any(mass%directed > 0.0_wp) .or. allocated(mass%matrix)) &
               has_mass(freedoms%part(mass%node)) = .true.
         end associate
      end do
      do i = 1, n_bars(mesh)
         if (mesh%bars(i)%mass > 0.0_wp) has_mass(freedoms%part(mesh%bars(i)%nodes)) = .true. ! springs have none
      end do
      if (.not. any(has_mass)) then
         call deck%errors%add(line, 'MODES: the structure has no mass; give RHO on MAT1, or CONM2')
         return
      end if
      do e = 1, mesh%n_elements
         associate (part => freedoms%part(mesh%element_nodes(1, e)))
            if (has_mass(part)) cycle
            call deck%errors%add(line, 'MODES: the body of element '//integer_text(mesh%element_id(e))// &
                                 ' has no mass; give RHO on its MAT1, or a CONM2 on it')
            has_mass(part) = .true. ! reported
         end associate
      end do
   end subroutine check_mass

end module mass_build
