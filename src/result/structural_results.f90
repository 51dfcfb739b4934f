!> The results of shells and beams, and their tables: stresses at both faces of shells, forces and moments per length, end forces
!! and stresses of beams.
module structural_results
   use analysis_state, only: analysis_type
   use beam_element, only: beam_end_forces, beam_section_at, beam_thermal_load
   use beam_sections, only: beam_section
   use body_elements, only: element_centre
   use bolt_locking, only: bar_tension
   use elasticity, only: max_stresses, von_mises
   use element_unknowns, only: displaced_nodes
   use joint_sides, only: joint_axes
   use kinds, only: wp
   use mesh_queries, only: element_points, is_beam, is_shell, n_points
   use model_data, only: a_bar, model_type, temperature_type
   use page_lines, only: in_units
   use result_page, only: page_type, shell_table, shows, table_columns, xyz
   use shell_element, only: most_shell_nodes
   use shell_membrane, only: shell_frame, shell_frame_of
   use shell_recovery, only: shell_forces
   use structural_elements, only: nodal_values, structural_stress
   use table_column, only: column
   use table_writer, only: table_type
   use temperatures, only: beam_slopes, element_rise, element_slope
   use text_tools, only: clean
   use tolerances, only: page_zero
   implicit none
   private

   public :: end_forces, face_stresses, list_beams, list_shell_forces, list_shells, node_peaks, section_stresses

   real(wp), parameter :: one_plate = 0.94_wp ! cosine of 20 degrees: shells at a node whose normals differ more are not averaged

contains

   !> Stresses of shell E at its faces Z1 and Z2, (xx, yy, zz, xy, yz, zx) in global axes, at its corners and then at its centre.
   pure subroutine face_stresses(model, e, u, temperature, stress)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      real(wp), intent(in)               :: u(:, :) !! (3, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(out)              :: stress(max_stresses, most_shell_nodes + 1, 2) !! (component, corner, face) [pressure]

      stress = 0.0_wp
      associate (n => size(element_points(model%mesh, e)) + 1)
         call structural_stress(model, e, u(:, displaced_nodes(model%freedoms, e)), temperature, &
                                model%mesh%properties(model%mesh%element_property(e))%fibre, stress(:, :n, :))
      end associate
   end subroutine face_stresses

   !> The end forces of beam E, column 1 at end A: the action of the part towards B on the part towards A, N, Q along y and z,
   !! T, M about y and z, in the axes of the beam [force], [force length].
   pure function end_forces(model, analysis, e) result(forces)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: e
      real(wp) :: forces(6, 2), load(12), s(12)

      associate (place => model%mesh%structural%place(e), now => analysis%now%temperature)
         load = beam_thermal_load(model%mesh%structural%beams(place), model%mesh%x(:, element_points(model%mesh, e)), &
                                  element_rise(model, e, now), beam_slopes(model, e, now))
         load = load + analysis%fraction*of_stage(analysis%stage) + (1.0_wp - analysis%fraction)* &
                of_stage(model%history%stages(analysis%stage)%from)
         s = beam_end_forces(model%mesh%structural%beams(place), model%mesh%x(:, element_points(model%mesh, e)), &
                             nodal_values(model, e, analysis%all_u(:, displaced_nodes(model%freedoms, e))), load)
      end associate
      forces = reshape([-s(:6), s(7:)], [6, 2])
      if (model%mesh%structural%beams(model%mesh%structural%place(e))%is_cut) forces(1, :) = bar_tension(model, analysis, &
         findloc(model%mesh%bars%id == model%mesh%element_id(e) .and. model%mesh%bars%kind == a_bar, .true., dim=1))

   contains

      !> The fixed-end forces of loads along the beam at the end of STAGE.
      pure function of_stage(stage) result(f)
         integer, intent(in) :: stage
         real(wp) :: f(12)

         f = 0.0_wp
         if (stage < 1) return
         if (allocated(model%history%stages(stage)%beam)) f = model%history%stages(stage)%beam(:, model%mesh%structural%place(e))
      end function of_stage

   end function end_forces

   !> Axial stress of a beam with the section LAW at C, D, E, F and at the centroid under its FORCES at an end, as end_forces has them [pressure].
   pure function section_stresses(law, forces) result(stress)
      class(beam_section), intent(in) :: law
      real(wp), intent(in)       :: forces(6)
      real(wp) :: stress(5), bent(2), det

      associate (i => law%inertia, n => forces(1), m_y => forces(5), m_z => forces(6))
         stress = 0.0_wp
         if (law%area > 0.0_wp) stress = n/law%area
         bent = 0.0_wp                       ! E v'', E w'' from M_z = E (I1 v'' + I12 w''), -M_y = E (I12 v'' + I2 w'')
         det = i(1)*i(2) - i(3)**2
         if (det > 0.0_wp) then
            bent = [i(2)*m_z + i(3)*m_y, -i(3)*m_z - i(1)*m_y]/det
         else if (i(1) > 0.0_wp) then
            bent(1) = m_z/i(1)
         else if (i(2) > 0.0_wp) then
            bent(2) = -m_y/i(2)
         end if
         stress(:4) = stress(:4) - matmul(bent, law%point)
      end associate
   end function section_stresses

   !> The largest von Mises stress of shells, and where ANALYSIS is present of beams, at every point of the model. Shells: at
   !! both faces, averaged over the shells that form one plate there. Beams: at the stress points. AT_CENTRE: at the centres of
   !! shells and the ends of beams, for every element; 0 for a body.
   subroutine node_peaks(model, u, temperature, at_node, at_centre, analysis)
      type(model_type), intent(in)       :: model
      real(wp), intent(in)               :: u(:, :)      !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(out)              :: at_node(:)   !! (points) [pressure]
      real(wp), intent(out)              :: at_centre(:) !! (n_elements)
      type(analysis_type), intent(in), optional :: analysis
      real(wp), allocatable :: stress(:, :, :, :), normal(:, :)
      type(shell_frame) :: frame
      real(wp) :: forces(6, 2), largest
      integer  :: e, end, node

      at_node = 0.0_wp
      at_centre = 0.0_wp
      if (size(model%mesh%structural%place) == 0) return
      associate (n => size(model%mesh%structural%shells))
         allocate (stress(max_stresses, most_shell_nodes + 1, 2, n), normal(3, n))
      end associate
      do e = 1, model%mesh%n_elements
         if (is_shell(model%mesh, e)) then
            associate (of_face => stress(:, :, :, model%mesh%structural%place(e)), n => size(element_points(model%mesh, e)))
               call face_stresses(model, e, u, temperature, of_face)
               frame = shell_frame_of(model%mesh%x(:, element_points(model%mesh, e)), 0.0_wp)
               normal(:, model%mesh%structural%place(e)) = frame%axes(:, 3)
               at_centre(e) = max(von_mises(of_face(:, n + 1, 1)), von_mises(of_face(:, n + 1, 2)))
            end associate
         else if (is_beam(model%mesh, e) .and. present(analysis)) then
            forces = end_forces(model, analysis, e)
            do end = 1, 2
               associate (law => model%mesh%structural%beams(model%mesh%structural%place(e)))
                  largest = maxval(abs(section_stresses(beam_section_at(law, end - 1.0_wp), forces(:, end))))
               end associate
               at_centre(e) = max(at_centre(e), largest)
               node = model%mesh%element_nodes(end, e)
               at_node(node) = max(at_node(node), largest)
            end do
         end if
      end do
      do node = 1, n_points(model%mesh)
         call average(node)
      end do

   contains

      !> The largest mean at NODE over the shells that form one plate there.
      subroutine average(node)
         integer, intent(in) :: node
         real(wp) :: total(max_stresses, 2)
         integer  :: corner, f, i, j, n

         do i = model%mesh%first_at(node), model%mesh%first_at(node + 1) - 1
            if (.not. is_shell(model%mesh, model%mesh%elements_at(i))) cycle
            total = 0.0_wp
            n = 0
            do j = model%mesh%first_at(node), model%mesh%first_at(node + 1) - 1
               if (.not. is_shell(model%mesh, model%mesh%elements_at(j))) cycle
               associate (first => model%mesh%structural%place(model%mesh%elements_at(i)), &
                          other => model%mesh%structural%place(model%mesh%elements_at(j)))
                  if (abs(dot_product(normal(:, first), normal(:, other))) < one_plate) cycle
                  corner = findloc(element_points(model%mesh, model%mesh%elements_at(j)), node, dim=1)
                  if (corner == 0) cycle
                  n = n + 1
                  do f = 1, 2 ! for a reversed shell the faces change places
                     total(:, f) = total(:, f) + stress(:, corner, merge(f, 3 - f, dot_product(normal(:, first), &
                                                                                              normal(:, other)) > 0.0_wp), other)
                  end do
               end associate
            end do
            if (n > 0) at_node(node) = max(at_node(node), von_mises(total(:, 1)/n), von_mises(total(:, 2)/n))
         end do
      end subroutine average

   end subroutine node_peaks

   !> The tables of shells, if any; their forces per length only with HAS_FORCES.
   subroutine list_shells(page, has_forces, model, analysis)
      type(page_type), intent(inout)  :: page
      logical, intent(in)             :: has_forces
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(9), parameter :: stresses(7) = [character(9) :: 'SIGMA X', 'SIGMA Y', 'SIGMA Z', 'TAU XY', 'TAU YZ', 'TAU ZX', &
                                                'VON MISES']
      type(table_type) :: table
      real(wp), allocatable :: centre(:, :, :)
      real(wp) :: stress(max_stresses, most_shell_nodes + 1, 2), floor
      integer  :: e, f

      if (size(model%mesh%structural%shells) == 0) return
      allocate (centre(max_stresses, 2, size(model%mesh%structural%shells)))
      do e = 1, model%mesh%n_elements
         if (.not. is_shell(model%mesh, e)) cycle
         call face_stresses(model, e, analysis%all_u, analysis%now%temperature, stress)
         centre(:, :, model%mesh%structural%place(e)) = stress(:, size(element_points(model%mesh, e)) + 1, :)
      end do
      floor = page_zero*maxval(abs(centre))
      call table%start('STRESSES AT THE FACES OF SHELLS, AT THEIR CENTRES'//page%now//in_units(page%labels%pressure), &
         [column('ELEMENT', 'i11'), column('HEIGHT', 'es13.5'), column(stresses, 'es13.5')], page%file)
      do e = 1, model%mesh%n_elements
         if (.not. is_shell(model%mesh, e)) cycle
         if (.not. shows(page, element_points(model%mesh, e))) cycle
         associate (of_element => centre(:, :, model%mesh%structural%place(e)), &
                    fibre => model%mesh%properties(model%mesh%element_property(e))%fibre)
            do f = 1, 2
               call table%put('ELEMENT', model%mesh%element_id(e))
               call table%put('HEIGHT', fibre(f))
               call table%put(stresses, [of_element(:, f), von_mises(of_element(:, f))], floor)
               call table%print_row(page%file)
            end do
         end associate
      end do
      if (has_forces) call list_shell_forces(page, model, analysis, is_listed=.true.)
   end subroutine list_shells

   !> Write forces and moments per length into the CSV file, and where IS_LISTED those at the centres into the listing. The
   !! directions x and y of a shell follow from its normal as those of a joint do.
   subroutine list_shell_forces(page, model, analysis, is_listed)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      logical, intent(in)             :: is_listed
      type(table_type) :: table
      type(shell_frame) :: frame
      real(wp), allocatable :: force(:, :, :)
      real(wp) :: axes(3, 3), floor(2), thickness, x(3)
      integer  :: e, i, node

      if (size(model%mesh%structural%place) == 0) return
      thickness = 0.0_wp
      allocate (force(8, most_shell_nodes + 1, size(model%mesh%structural%shells)), source=0.0_wp)
      do e = 1, model%mesh%n_elements
         if (.not. is_shell(model%mesh, e)) cycle
         associate (nodes => element_points(model%mesh, e))
            frame = shell_frame_of(model%mesh%x(:, nodes), 0.0_wp)
            axes = joint_axes(model%mesh, frame%axes(:, 3))
            call shell_forces(model%mesh%structural%shells(model%mesh%structural%place(e)), model%mesh%x(:, nodes), &
                              nodal_values(model, e, analysis%all_u(:, displaced_nodes(model%freedoms, e))), &
                              element_rise(model, e, analysis%now%temperature), &
                              element_slope(model, e, analysis%now%temperature), axes(:, 1), &
                              force(:, :size(nodes) + 1, model%mesh%structural%place(e)))
            thickness = max(thickness, maxval(model%mesh%structural%shells(model%mesh%structural%place(e))%thickness))
         end associate
      end do
      if (size(force) == 0) return
      floor = page_zero*max(maxval(abs(force([1, 2, 3, 7, 8], :, :))), maxval(abs(force(4:6, :, :)))/thickness)*[1.0_wp, thickness]
      call table%start('FORCES AND MOMENTS PER LENGTH OF SHELLS, AT THEIR CENTRES'//page%now, &
                       table_columns(shell_table, page%labels, model))
      if (is_listed) call table%print_head(page%file)
      do e = 1, model%mesh%n_elements
         if (.not. is_shell(model%mesh, e)) cycle
         associate (nodes => element_points(model%mesh, e), n => size(element_points(model%mesh, e)))
            if (.not. shows(page, nodes)) cycle
            do i = 1, n + 1
               node = 0
               x = element_centre(model, e)
               if (i <= n) node = model%mesh%node_id(nodes(i))
               if (i <= n) x = model%mesh%x(:, nodes(i))
               associate (of_corner => force(:, i, model%mesh%structural%place(e)))
                  call table%put('stage', page%stage_id)
                  call table%put('increment', analysis%increment)
                  call table%put('load', analysis%fraction)
                  call table%put('element', model%mesh%element_id(e))
                  call table%put('node', node)
                  call table%put(xyz, x)
                  call table%put(['n_x ', 'n_y ', 'n_xy'], of_corner(:3), floor(1))
                  call table%put(['m_x ', 'm_y ', 'm_xy'], of_corner(4:6), floor(2))
                  call table%put(['q_x', 'q_y'], of_corner(7:), floor(1))
               end associate
               call table%print_row(page%file, page%tables(shell_table), is_listed=is_listed .and. i > n)
            end do
         end associate
      end do
   end subroutine list_shell_forces

   !> The tables of beams, if any.
   subroutine list_beams(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(8), parameter :: force_names(3) = [character(8) :: 'AXIAL N', 'Q Y', 'Q Z'], &
                                 moment_names(3) = [character(8) :: 'TORQUE', 'M Y', 'M Z'], &
                                 points(5) = [character(8) :: 'AT C', 'AT D', 'AT E', 'AT F', 'CENTROID']
      type(table_type) :: table, stresses
      real(wp), allocatable :: forces(:, :, :), stress(:, :, :)
      real(wp) :: floor(3)
      integer  :: e, end

      if (size(model%mesh%structural%beams) == 0) return
      allocate (forces(6, 2, size(model%mesh%structural%beams)), stress(5, 2, size(model%mesh%structural%beams)))
      do e = 1, model%mesh%n_elements
         if (.not. is_beam(model%mesh, e)) cycle
         associate (place => model%mesh%structural%place(e))
            forces(:, :, place) = end_forces(model, analysis, e)
            do end = 1, 2
               associate (section => beam_section_at(model%mesh%structural%beams(place), end - 1.0_wp))
                  stress(:, end, place) = section_stresses(section, forces(:, end, place))
               end associate
            end do
         end associate
      end do
      floor = page_zero*[maxval(abs(forces(:3, :, :))), maxval(abs(forces(4:, :, :))), maxval(abs(stress))]
      call table%start('FORCES IN BEAMS, AT BOTH ENDS, IN THE AXES OF THE BEAM'//page%now, &
         [column('ELEMENT', 'i11'), column('NODE', 'i11'), column(force_names, 'es13.5', page%labels%force), &
          column(moment_names, 'es13.5', page%labels%moment)], page%file)
      call stresses%start('STRESSES IN BEAMS, AT BOTH ENDS'//page%now//in_units(page%labels%pressure), &
         [column('ELEMENT', 'i11'), column('NODE', 'i11'), column(points, 'es13.5')])
      do e = 1, model%mesh%n_elements
         if (.not. is_beam(model%mesh, e)) cycle
         if (.not. shows(page, element_points(model%mesh, e))) cycle
         associate (place => model%mesh%structural%place(e))
            do end = 1, 2
               call table%put('ELEMENT', model%mesh%element_id(e))
               call table%put('NODE', model%mesh%node_id(model%mesh%element_nodes(end, e)))
               call table%put(force_names, forces(:3, end, place), floor(1))
               call table%put(moment_names, forces(4:, end, place), floor(2))
               call table%print_row(page%file)
               call stresses%put('ELEMENT', model%mesh%element_id(e))
               call stresses%put('NODE', model%mesh%node_id(model%mesh%element_nodes(end, e)))
               call stresses%put(points, stress(:, end, place), floor(3))
               call stresses%keep_row()
            end do
         end associate
      end do
      call stresses%print_kept(page%file)
   end subroutine list_beams

end module structural_results
