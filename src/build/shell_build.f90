!> Shells from their cards: sections and materials, laminates, directions of materials, edges between triangles.
module shell_build
   use bulk_data, only: plate_card, property_card
   use deck_check, only: checked_deck
   use displacement_systems, only: find_directions
   use elasticity, only: elasticity_matrix, max_stresses, plane_stress, shell
   use kinds, only: wp
   use laminate, only: make_ply, ply_type, shear_flexibility
   use lists, only: id_table_type
   use mesh_queries, only: element_points, is_beam, is_shell
   use model_data, only: mesh_type
   use shell_membrane, only: shell_frame, shell_frame_of, shell_law
   use structural_build, only: has_rotations
   use text_tools, only: integer_text, one_of
   use tolerances, only: along_the_beam
   implicit none
   private

   real(wp), parameter :: one_side = 0.5_wp   ! cosine: triangles at an edge less than 60 degrees apart lie on one side of it
   real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp

   public :: bow_edges, build_shells

contains

   !> Build the shells of the model, and set the positions of its beams.
   subroutine build_shells(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      type(shell_law), allocatable :: of_property(:)
      type(id_table_type) :: plates
      type(plate_card) :: plate
      integer :: e, i, n(2)

      do i = 1, size(deck%bulk%plate)
         associate (card => deck%bulk%element(deck%bulk%plate(i)%element), plate => deck%bulk%plate(i))
            if (.not. abs(plate%offset) > 0.0_wp .and. .not. any(plate%thickness > 0.0_wp)) cycle
            if (all(mesh%properties%id /= card%property .or. mesh%properties%state /= shell)) call deck%field_error(card%line, &
               one_of(abs(plate%offset) > 0.0_wp, 'ZOFFS', 'T'//integer_text(findloc(plate%thickness > 0.0_wp, .true., dim=1))), &
               'this and thicknesses at corners are for shells in a model of space; expected blanks')
         end associate
      end do
      if (.not. any([(has_rotations(mesh, e), e = 1, mesh%n_elements)])) return
      mesh%structural%place = spread(0, 1, mesh%n_elements)
      allocate (of_property(size(mesh%properties)))
      do i = 1, size(deck%bulk%pshell)
         if (mesh%properties(i)%state /= shell) cycle ! they come first
         if (allocated(deck%bulk%pshell(i)%plies)) then
            call find_laminate(deck, deck%bulk%pshell(i), of_property(i))
         else
            call find_shell(deck, deck%bulk%pshell(i), of_property(i))
         end if
      end do
      call plates%build([(deck%bulk%element(deck%bulk%plate(i)%element)%id, i = 1, size(deck%bulk%plate))])
      n = 0
      do e = 1, mesh%n_elements
         if (.not. has_rotations(mesh, e)) cycle
         i = merge(2, 1, is_beam(mesh, e))
         n(i) = n(i) + 1
         mesh%structural%place(e) = n(i)
      end do
      deallocate (mesh%structural%shells, mesh%structural%beams)
      allocate (mesh%structural%shells(n(1)), mesh%structural%beams(n(2)))
      do e = 1, mesh%n_elements
         if (.not. is_shell(mesh, e)) cycle
         associate (law => mesh%structural%shells(mesh%structural%place(e)))
            law = of_property(mesh%element_property(e))
            i = 0
            if (size(deck%bulk%plate) > 0) i = plates%find(mesh%element_id(e))
            plate = plate_card()
            if (i > 0) plate = deck%bulk%plate(i)
            law%offset = law%offset + plate%offset
            if (plate%is_relative) plate%thickness = plate%thickness*law%thickness
            if (allocated(law%plies) .and. any(plate%thickness > 0.0_wp)) call deck%field_error(mesh%element_line(e), 'T1', &
               'a laminate has the thickness of its plies; expected blanks')
            where (plate%thickness > 0.0_wp) law%thickness = plate%thickness
            if (any(abs(law%along) > 0.0_wp)) law%along = material_direction(deck, mesh, e, plate)
         end associate
      end do
   end subroutine build_shells

   !> The direction x of the material of shell E: at THETA from the side of corners 1 and 2, or that of the system MCID at the centre.
   function material_direction(deck, mesh, e, plate) result(along)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in)    :: mesh
      integer, intent(in)            :: e
      type(plate_card), intent(in)   :: plate
      real(wp) :: along(3), axes(3, 3)
      type(shell_frame) :: frame
      logical :: ok

      associate (x => mesh%x(:, element_points(mesh, e)))
         if (plate%system >= 0) then
            call find_directions(deck, mesh%systems, mesh%element_line(e), plate%system, sum(x, dim=2)/size(x, 2), axes, ok, &
                                 [character(8) :: 'THETA', 'a node'])
            along = axes(:, 1)
         else
            frame = shell_frame_of(x, 0.0_wp, x(:, 2) - x(:, 1))
            along = cos(degree*plate%angle)*frame%axes(:, 1) + sin(degree*plate%angle)*frame%axes(:, 2)
         end if
         frame = shell_frame_of(x, 0.0_wp)
      end associate
      if (norm2(matmul(along, frame%axes(:, :2))) <= along_the_beam) call deck%field_error(mesh%element_line(e), 'THETA', &
         'x of this system is normal to element '//integer_text(mesh%element_id(e))//' and gives no direction of its material', &
         called='MCID')
   end function material_direction

   !> Find the edges between triangular shells, which their drilling rotations bow (shell_membrane), once shared surfaces are split:
   !! triangles of three nodes lie on different sides of the edge, and no other shell has it. Triangles on the same nodes lie on one
   !! side.
   pure subroutine bow_edges(mesh)
      type(mesh_type), intent(inout) :: mesh
      integer :: b, e, i, k

      do e = 1, mesh%n_elements
         if (.not. is_shell(mesh, e)) cycle
         if (size(element_points(mesh, e)) /= 3) cycle
         associate (nodes => mesh%element_nodes(:3, e), law => mesh%structural%shells(mesh%structural%place(e)))
            do i = 1, 3
               b = nodes(modulo(i, 3) + 1)
               law%bowed(i) = .false.
               do k = mesh%first_at(nodes(i)), mesh%first_at(nodes(i) + 1) - 1
                  associate (other => mesh%elements_at(k))
                     if (.not. is_shell(mesh, other)) cycle
                     if (all(element_points(mesh, other) /= b)) cycle
                     if (size(element_points(mesh, other)) /= 3) then
                        law%bowed(i) = .false.
                        exit
                     end if
                     if (dot_product(across(e, nodes(i), b), across(other, nodes(i), b)) < one_side) law%bowed(i) = .true.
                  end associate
               end do
            end do
         end associate
      end do

   contains

      !> The direction from the edge between nodes A and B into triangle E.
      pure function across(e, a, b) result(inward)
         integer, intent(in) :: e, a, b
         real(wp) :: inward(3)

         associate (along => mesh%x(:, b) - mesh%x(:, a), centre => sum(mesh%x(:, mesh%element_nodes(:3, e)), dim=2)/3.0_wp)
            inward = centre - mesh%x(:, a)
            inward = inward - dot_product(inward, along)/max(dot_product(along, along), tiny(1.0_wp))*along
            inward = inward/max(norm2(inward), tiny(1.0_wp))
         end associate
      end function across

   end subroutine bow_edges

   !> The LAW of shells of a PSHELL.
   subroutine find_shell(deck, card, law)
      type(checked_deck), intent(in)  :: deck
      type(property_card), intent(in) :: card
      type(shell_law), intent(out)    :: law
      real(wp), dimension(3, 3) :: membrane, bending, unused
      real(wp) :: expansions(3), other(3), shear(2)
      logical  :: isotropic(3)

      call find_plane_stress(deck, card%line, card%material, 0, membrane, expansions, shear, isotropic(1))
      call find_plane_stress(deck, card%line, card%bending, 4, bending, other, shear, isotropic(2))
      call find_plane_stress(deck, card%line, card%shear, 6, unused, other, shear, isotropic(3))
      law%thickness = card%thickness
      law%shear = shear*card%shear_ratio
      law%d = membrane
      law%bending = card%inertia_ratio*bending
      law%heat(:, 1) = matmul(law%d, expansions)
      law%heat(:, 3) = matmul(law%bending, expansions)
      if (card%bends_alone) law%d = 0.0_wp
      if (card%bends_alone) law%heat(:, 1) = 0.0_wp
      if (.not. all(isotropic(:2)) .or. abs(law%shear(2) - law%shear(1)) > 0.0_wp) law%along = [1.0_wp, 0.0_wp, 0.0_wp]
   end subroutine find_shell

   !> Plane stress, expansions and transverse shear moduli of the material with this ID; zero for a missing one.
   subroutine find_plane_stress(deck, line, id, at, stress, expansions, shear, is_isotropic)
      type(checked_deck), intent(in)  :: deck
      integer, intent(in)             :: line    !! of the card that names it
      integer, intent(in)             :: id, at  !! its data field; 0: an error is reported elsewhere
      real(wp), intent(out)           :: stress(3, 3), expansions(3), shear(2)
      logical, intent(out)            :: is_isotropic
      real(wp) :: d(max_stresses, max_stresses)
      integer  :: k

      stress = 0.0_wp
      expansions = 0.0_wp
      shear = 0.0_wp
      is_isotropic = .true.
      k = findloc(deck%bulk%mat1%id, id, dim=1)
      if (k == 0 .and. id > 0 .and. at > 0) call deck%field_error(line, at, 'there is no MAT1 '//integer_text(id), called='MID'// &
                                                                  one_of(at <= 6, integer_text(at/2), ''))
      if (k == 0) return
      associate (material => deck%bulk%mat1(k))
         is_isotropic = material%name == 'MAT1'
         if (material%name == 'MAT9' .and. at > 0) call deck%field_error(line, at, 'MAT9 '//integer_text(id)// &
                                                      ' is for solids; expected MAT1, MAT2 or MAT8', called='MID')
         stress = material%stress
         expansions = material%expansions
         shear = material%shear_moduli
         if (.not. is_isotropic) return
         call elasticity_matrix(plane_stress, material%e, material%nu, d)
         stress = d(:3, :3)
         expansions(:2) = material%alpha
         shear = material%shear
      end associate
   end subroutine find_plane_stress

   !> The LAW of shells of a PCOMP: integrals over its plies about their mid-plane, which Z0 offsets from the nodes.
   subroutine find_laminate(deck, card, law)
      type(checked_deck), intent(in)  :: deck
      type(property_card), intent(in) :: card
      type(shell_law), intent(out)    :: law
      real(wp) :: stress(3, 3), expansions(3), flexibility, shear(2), z
      integer  :: i, k
      logical  :: is_isotropic

      allocate (law%plies(size(card%plies)))
      z = -0.5_wp*card%thickness
      associate (t => card%thickness, line => card%line)
         do i = 1, size(card%plies)
            associate (card => card%plies(i))
               call find_plane_stress(deck, line, card%material, merge(0, card%at, i == 1), stress, expansions, shear, is_isotropic)
            end associate
            associate (ply => law%plies(i))
               ply = ply_type(id=card%plies(i)%id, angle=degree*card%plies(i)%angle, shown=card%plies(i)%shown, from=z, &
                              to=z + card%plies(i)%thickness)
               call make_ply(stress, expansions, shear, ply)
               z = ply%to
               associate (q => [ply%to - ply%from, (ply%to**2 - ply%from**2)/2.0_wp, (ply%to**3 - ply%from**3)/3.0_wp])
                  law%d = law%d + q(1)/t*ply%q
                  law%coupling = law%coupling + q(2)/t**2*ply%q
                  law%bending = law%bending + 12.0_wp*q(3)/t**3*ply%q
                  law%heat = law%heat + spread(ply%heat, 2, 3)*spread(q/[t, t**2, t**3/12.0_wp], 1, 3)
               end associate
            end associate
         end do
         do k = 1, 2
            flexibility = shear_flexibility(law%plies, k)
            if (flexibility > 0.0_wp) law%shear(k) = 1.0_wp/(flexibility*t)
         end do
         law%thickness = t
         law%offset = card%lowest + 0.5_wp*t
      end associate
      law%along = [1.0_wp, 0.0_wp, 0.0_wp]
   end subroutine find_laminate

end module shell_build
