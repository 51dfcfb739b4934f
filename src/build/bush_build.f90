!> CBUSH: the axes of a bush, its point, and the rigid arms from its nodes to this point.
!! The springs along the axes connect the ends of both arms, which meet at the point of the bush; so forces across an arm give its
!! node a moment. An arm along all forces of the bush has no effect.
module bush_build
   use bulk_data, only: spring_card
   use coordinate_systems, only: position_in
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions, find_system
   use kinds, only: wp
   use model_data, only: face_node_type, mesh_type
   use node_build, only: find_nodes
   use numbers, only: cross, identity
   use text_tools, only: integer_text, one_of
   use tolerances, only: no_lever, zero_cosine
   implicit none
   private

   public :: find_bushes, add_ends, stiffness_turns

   !> The bush of a spring card; of a CELAS it is empty.
   type, public :: bush_type
      logical  :: is_whole = .false.         !! a CBUSH without errors
      integer  :: nodes(2) = 0               !! GA and GB, 0: the ground
      integer  :: property = 0               !! position of its PBUSH
      real(wp) :: axes(3, 3) = identity      !! columns, unit
      real(wp) :: lever(3, 2) = 0.0_wp       !! from each node to the point of the bush [length]
      logical  :: has_arm(2) = .false.       !! a force of the bush gives this node a moment
      integer  :: face(2) = 0                !! position of the end of this arm in the faces of the mesh
   end type bush_type

contains

   !> The bush of each spring card of DECK. Errors: missing nodes, properties and systems, axes that do not follow from the card.
   subroutine find_bushes(deck, mesh, bushes)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh
      type(bush_type), allocatable, intent(out) :: bushes(:) !! (spring cards)
      real(wp) :: extent, point(3)
      integer  :: end, i, k, system

      allocate (bushes(size(deck%bulk%spring)))
      if (.not. any(deck%bulk%spring%is_bush)) return
      extent = norm2(maxval(mesh%x, dim=2) - minval(mesh%x, dim=2))
      do i = 1, size(bushes)
         associate (card => deck%bulk%spring(i), bush => bushes(i), laws => deck%bulk%spring_property)
            if (.not. card%is_bush) cycle
            bush%property = findloc(laws%id == card%property .and. laws%is_bush .and. (laws%is_damper .eqv. card%is_damper), &
                                    .true., dim=1)
            if (card%property > 0 .and. bush%property == 0) call deck%field_error(card%line, 'PID', 'there is no '// &
               one_of(card%is_damper, 'PVISC ', 'PBUSH ')//integer_text(card%property))
            call find_nodes(deck, card%line, card%nodes, mesh, bush%nodes)
            if (bush%property == 0 .or. bush%nodes(1) == 0 .or. (bush%nodes(2) == 0 .and. card%nodes(2) > 0)) cycle
            call find_axes(deck, card, mesh, bush%nodes, laws(bush%property)%stiffness, bush%axes, bush%is_whole)
            point = mesh%x(:, bush%nodes(1))
            if (bush%nodes(2) > 0) point = point + card%share*(mesh%x(:, bush%nodes(2)) - point)
            if (card%point_system == 0) point = card%point
            if (card%point_system > 0) then
               call find_system(deck, card%line, 'OCID', card%point_system, mesh%systems, system)
               bush%is_whole = bush%is_whole .and. system > 0
               if (system > 0) point = position_in(mesh%systems(system), card%point)
            end if
            do end = 1, 2
               if (bush%nodes(end) == 0) cycle
               bush%lever(:, end) = point - mesh%x(:, bush%nodes(end))
               associate (law => laws(bush%property))
                  bush%has_arm(end) = any([(law%stiffness(k) + law%viscous(k) > 0.0_wp .and. &
                     norm2(cross(bush%lever(:, end), bush%axes(:, k))) > no_lever*extent, k = 1, mesh%dimension)])
               end associate
            end do
         end associate
      end do
   end subroutine find_bushes

   !> The axes of a CBUSH: those of its system at GA; without a system along the line between its nodes, y in the plane of this line and
   !! the orientation; global axes where the nodes coincide. Without an orientation both directions across the line must be alike.
   subroutine find_axes(deck, card, mesh, nodes, stiffness, axes, ok)
      type(checked_deck), intent(in) :: deck
      type(spring_card), intent(in)  :: card
      type(mesh_type), intent(in)    :: mesh
      integer, intent(in)            :: nodes(2)
      real(wp), intent(in)           :: stiffness(6)
      real(wp), intent(out)          :: axes(3, 3) !! columns, unit
      logical, intent(out)           :: ok
      real(wp) :: along(3), cd(3, 3), toward(3)
      integer  :: i, other
      logical  :: is_oriented

      axes = identity
      ok = .true.
      if (card%system > 0) call find_directions(deck, mesh%systems, card%line, card%system, mesh%x(:, nodes(1)), axes, ok, &
                                                ['CID', 'GA '])
      if (card%system >= 0) return
      is_oriented = card%other > 0 .or. any(abs(card%orientation) > 0.0_wp)
      along = 0.0_wp
      if (nodes(2) > 0) along = mesh%x(:, nodes(2)) - mesh%x(:, nodes(1))
      if (.not. norm2(along) > 0.0_wp) then
         ok = .not. (is_oriented .or. card%is_damper)
         if (card%is_damper .and. nodes(2) > 0) call deck%field_error(card%line, 'G2', &
            'lies at the place of G1; expected nodes that are apart')
         if (is_oriented) call deck%field_error(card%line, 'CID', 'blank, and GA and GB are not apart, so that '// &
            'GO or X1, X2, X3 give no axes; expected the system of its axes, 0 for global axes')
         return
      end if
      axes(:, 1) = along/norm2(along)
      if (is_oriented) then
         other = 0
         if (card%other > 0) other = mesh%node_table%find(card%other)
         ok = other > 0 .or. card%other == 0
         if (.not. ok) call deck%field_error(card%line, 'GO', 'there is no GRID '//integer_text(card%other))
         if (.not. ok) return
         if (other > 0) then
            toward = mesh%x(:, other) - mesh%x(:, nodes(1))
         else ! in the displacement system of GA
            i = findloc(deck%bulk%grid%id, card%nodes(1), dim=1)
            cd = identity
            if (i > 0) call find_directions(deck, mesh%systems, deck%bulk%grid(i)%line, deck%bulk%grid(i)%cd, &
                                            mesh%x(:, nodes(1)), cd, ok)
            toward = matmul(cd, card%orientation)
         end if
      else
         ok = abs(stiffness(2) - stiffness(3)) + abs(stiffness(5) - stiffness(6)) <= 0.0_wp
         if (.not. ok) call deck%field_error(card%line, 'CID', 'blank, as are GO and X1, X2, X3, but GA and GB '// &
            'are apart and the stiffnesses across the line between them differ, K2 and K3 or K5 and K6; expected one of these '// &
            'fields, CID 0 for global axes')
         toward = identity(:, minloc(abs(along), dim=1))
      end if
      axes(:, 3) = cross(axes(:, 1), toward)
      if (ok .and. norm2(axes(:, 3)) <= zero_cosine*norm2(toward)) then
         ok = .false.
         call deck%field_error(card%line, 'GO', 'the orientation lies along the line from GA to GB; expected a direction across it')
      end if
      if (.not. ok) return
      axes(:, 3) = axes(:, 3)/norm2(axes(:, 3))
      axes(:, 2) = cross(axes(:, 3), axes(:, 1))
   end subroutine find_axes

   !> Append to FACES the ends of the arms of BUSHES.
   pure subroutine add_ends(bushes, faces)
      type(bush_type), intent(inout) :: bushes(:)
      type(face_node_type), allocatable, intent(inout) :: faces(:)
      integer :: end, i

      do i = 1, size(bushes)
         if (.not. bushes(i)%is_whole) cycle
         do end = 1, 2
            if (.not. bushes(i)%has_arm(end)) cycle
            faces = [faces, face_node_type(point=bushes(i)%nodes(end), lever=bushes(i)%lever(:, end))]
            bushes(i)%face(end) = size(faces)
         end do
      end do
   end subroutine add_ends

   !> Whether spring card I acts on a rotation of its node at END, directly or by an arm; ARM is a length that scales this rotation.
   pure subroutine stiffness_turns(deck, bushes, i, end, turns, arm)
      type(checked_deck), intent(in) :: deck
      type(bush_type), intent(in)    :: bushes(:)
      integer, intent(in)            :: i, end
      logical, intent(out)           :: turns
      real(wp), intent(out)          :: arm !! [length]

      arm = norm2(bushes(i)%lever(:, end))
      turns = deck%bulk%spring(i)%components(end) > 3 .or. bushes(i)%has_arm(end)
      if (bushes(i)%is_whole) then
         associate (law => deck%bulk%spring_property(bushes(i)%property), &
                    k => deck%bulk%spring_property(bushes(i)%property)%stiffness)
            turns = turns .or. any(k(4:) + law%viscous(4:) > 0.0_wp)
            if (.not. arm > 0.0_wp .and. any(k(:3) > 0.0_wp)) arm = sqrt(maxval(k(4:))/maxval(k(:3)))
         end associate
      end if
      if (.not. arm > 0.0_wp) arm = 1.0_wp
   end subroutine stiffness_turns

end module bush_build
