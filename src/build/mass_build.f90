!> Masses: CONM2 and CMASS2 at nodes, consistent or lumped element masses, a check for bodies without mass.
module mass_build
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions, find_system
   use kinds, only: wp
   use model_data, only: freedoms_type, mesh_type, n_bars
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
   subroutine build_masses(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(component_place) :: place
      real(wp) :: along(3, 3), axes(3, 3)
      integer  :: c, i, n, n_off, system
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
      allocate (mesh%masses(2*size(deck%bulk%mass)))
      n = 0
      n_off = 0
      do i = 1, size(deck%bulk%mass)
         associate (card => deck%bulk%mass(i), node => mesh%node_table%find(deck%bulk%mass(i)%node))
            if (node == 0) cycle
            n = n + 1
            mesh%masses(n)%node = node
            if (card%component > 0) then ! directed; for a rotation the moment of inertia about its axis
               place = place_of_component(mesh, node, card%component)
               if (place%node == 0) call deck%field_error(card%line, 'C1', 'node '//integer_text(card%node)// &
                                                          ' has no component '//integer_text(card%component))
               axes = node_axes(mesh, node)
               c = modulo(card%component - 1, 3) + 1
               along = deck%bulk%parameters%mass_factor*card%mass*spread(axes(:, c), 2, 3)*spread(axes(:, c), 1, 3)
               if (card%component <= 3) mesh%masses(n)%directed = along
               if (card%component > 3) mesh%masses(n)%inertia = along
               cycle
            end if
            mesh%masses(n)%mass = deck%bulk%parameters%mass_factor*card%mass
            ! the inertia from the system of the card to global axes; I21 is the integral of x_1 x_2 over the mass
            associate (i11 => card%inertia(1), i21 => card%inertia(2), i22 => card%inertia(3), i31 => card%inertia(4), &
                       i32 => card%inertia(5), i33 => card%inertia(6), inertia => mesh%masses(n)%inertia)
               inertia = deck%bulk%parameters%mass_factor*reshape([i11, -i21, -i31, -i21, i22, -i32, -i31, -i32, i33], [3, 3])
               if (any(deck%control%stages%vibration%modes%id > 0) .and. .not. is_inertia(inertia)) call deck%field_error( &
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
      mesh%masses = mesh%masses(:n)
   end subroutine build_masses

   !> Error: the node of a mass belongs to no element.
   subroutine check_masses(deck, mesh, freedoms)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in)     :: mesh
      type(freedoms_type), intent(in) :: freedoms
      integer :: i

      do i = 1, size(deck%bulk%mass)
         associate (card => deck%bulk%mass(i), node => mesh%node_table%find(deck%bulk%mass(i)%node))
            if (node == 0) cycle
            if (.not. freedoms%used(node)) call deck%field_error(card%line, one_of(card%component > 0, 'G1', 'G'), 'node '// &
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

      i = findloc(deck%control%stages%vibration%modes%id > 0, .true., dim=1)
      if (i == 0) return
      line = deck%control%stages(i)%vibration%modes%line
      allocate (has_mass(freedoms%n_parts), source=.false.)
      do e = 1, mesh%n_elements
         if (mesh%properties(mesh%element_property(e))%rho > 0.0_wp) has_mass(freedoms%part(mesh%element_nodes(1, e))) = .true.
      end do
      do i = 1, size(mesh%masses)
         associate (mass => mesh%masses(i))
            if (mass%mass > 0.0_wp .or. any(mass%directed > 0.0_wp)) has_mass(freedoms%part(mass%node)) = .true.
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
