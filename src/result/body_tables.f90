!> Tables of the bodies: displacements, rotations, stresses, reactions, balance of the external forces, condensed stiffness. Where
!! OUTPUT limits a stage to some nodes, the tables have the rows of these nodes and of the elements with any of them. Nodal vectors
!! are given along the axes of the model, or with OUTPUT = CD along those of the displacement system of each node, whose number
!! follows the row.
module body_tables
   use analysis_state, only: analysis_type
   use body_elements, only: element_centre, element_stress, node_stresses, whole_stress
   use elasticity, only: max_stresses, n_stresses, principal_stresses, von_mises
   use element_kinds, only: is_second_order
   use kinds, only: wp
   use mesh_queries, only: element_points, is_beam, is_shell, n_points, n_rotations
   use model_data, only: model_type, supported
   use output_file, only: output_file_type
   use page_lines, only: axes, heading, in_units
   use ply_tables, only: list_plies
   use result_page, only: page_type, shows
   use stage_entries, only: output_request
   use structural_results, only: list_beams, list_shells
   use support_reactions, only: balance_springs, balance_supports, balance_type, find_balance
   use table_column, only: column
   use table_writer, only: table_type
   use text_tools, only: clean, integer_text, one_of, upper
   use tolerances, only: page_zero
   use unknowns, only: node_axes
   implicit none
   private

   public :: list_bodies, list_condensed

   ! All threads write long tables: rows are printed in blocks, and each thread writes pieces of a block.
   integer, parameter :: block_rows = 16384, piece = 512, few = 4096

contains

   !> Displacements, rotations in radians, stresses, reactions; where stresses are ASKED also principal stresses, and those at
   !! nodes of second-order elements.
   subroutine list_bodies(page, asked, model, analysis)
      type(page_type), intent(inout)  :: page
      type(output_request), intent(in) :: asked
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      real(wp), allocatable :: stress(:, :)
      integer, allocatable  :: list(:), shown(:)
      real(wp) :: floor
      logical  :: has_bodies
      integer  :: e, m, node

      list = pack([(node, node = 1, n_points(model%mesh))], [(model%freedoms%used(node) .and. shows(page, [node]), node = 1, &
         n_points(model%mesh))])
      call list_vectors(page, model, [character(22) :: 'DISPLACEMENTS OF NODES', 'U.', page%labels%length], list, &
                        analysis%all_u(:, list), spread(page_zero*maxval(abs(analysis%all_u(:, :n_points(model%mesh)))), 1, &
                           size(list)))
      m = merge(3, 1, model%mesh%dimension == 3)
      associate (rotations => model%mesh%rotations)
         if (n_rotations(model%mesh) > 0) call list_vectors(page, model, &
            [character(28) :: 'ROTATIONS OF REFERENCE NODES', 'THETA .', 'RADIANS'], rotations%point, &
            analysis%all_u(:m, rotations%node)/spread(rotations%arm, 1, m), page_zero*maxval(abs(analysis%all_u))/rotations%arm, &
            turns=.true.)
      end associate
      has_bodies = model%mesh%n_elements > 0
      if (size(model%mesh%structural%place) > 0) has_bodies = any(model%mesh%structural%place == 0)
      if (has_bodies) call list_stresses(page, asked%stress, model, analysis)
      if (size(model%mesh%structural%place) > 0) then
         call list_shells(page, asked%forces, model, analysis)
         call list_plies(page, model, analysis)
         call list_beams(page, model, analysis)
      end if
      has_bodies = any(is_second_order(model%mesh%element_kind) .and. &
                       [(.not. is_shell(model%mesh, e), e = 1, model%mesh%n_elements)])
      if (asked%stress .and. has_bodies) then ! stresses at nodes, averaged over their elements
         allocate (stress(max_stresses, n_points(model%mesh)))
         call node_stresses(model, analysis%all_u, analysis%now%temperature, stress)
         floor = page_zero*maxval(abs(stress))
         shown = shown_stresses(model)
         call table%start('STRESSES AT NODES, MEAN OF THEIR ELEMENTS'//page%now//in_units(page%labels%pressure), &
                          [column('NODE', 'i11'), column([character(10) :: stress_names(model), 'VON MISES'], 'es13.5')], page%file)
         do node = 1, n_points(model%mesh)
            if (model%mesh%first_at(node + 1) == model%mesh%first_at(node) .or. .not. shows(page, [node])) cycle
            call table%put('NODE', model%mesh%node_id(node))
            call table%put(stress_names(model), stress(shown, node), floor)
            call table%put('VON MISES', von_mises(stress(:, node)), floor)
            call table%print_row(page%file)
         end do
      end if
      call list_reactions(page, model, analysis)
   end subroutine list_bodies

   !> Print a table of the VECTORS at NODES, given in global axes; values below the FLOORS of their rows are zero. Rotations and
   !! moments of a plane model have one component, about z, and their rows no places.
   subroutine list_vectors(page, model, words, nodes, vectors, floors, turns)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      character(*), intent(in)       :: words(3)      !! title; name of the components before a point; unit
      integer, intent(in)            :: nodes(:)
      real(wp), intent(in)           :: vectors(:, :) !! (components, nodes)
      real(wp), intent(in)           :: floors(:)     !! (nodes)
      logical, intent(in), optional  :: turns         !! rotations or moments; default: no
      character(1), parameter :: numbers(3) = ['1', '2', '3']
      type(table_type) :: table
      real(wp), allocatable :: along(:, :), values(:, :)
      character(len(words)), allocatable :: keys(:) ! of the number, the places, the components
      integer, allocatable  :: system(:)
      real(wp) :: directions(3, 3)
      integer  :: first, i, last, n_places

      first = 1
      last = size(vectors, 1)
      n_places = model%mesh%dimension
      if (present(turns)) n_places = 0
      if (n_places == 0) first = 4 - last
      if (n_places == 0) last = 3
      allocate (along, source=vectors)
      allocate (system(size(nodes)), source=0)
      if (page%along_cd) then
         do i = 1, size(nodes)
            directions = node_axes(model%mesh, nodes(i))
            along(:, i) = matmul(along(:, i), directions(first:last, first:last))
            if (size(model%mesh%node_system) > 0) system(i) = model%mesh%node_system(nodes(i))
            if (system(i) > 0) system(i) = model%mesh%systems(system(i))%id
         end do
      end if
      allocate (keys(1 + n_places + size(along, 1)))
      keys(1) = 'NODE'
      keys(2:1 + n_places) = axes(:n_places)
      keys(2 + n_places:) = words(2)(:index(words(2), '.') - 1)//merge(numbers(first:last), axes(first:last), page%along_cd)
      call table%start(trim(words(1))//one_of(page%along_cd, ' ALONG THEIR SYSTEMS CD (0: X, Y, Z)', '')// &
                       page%now//in_units(words(3)), [column(keys(1), 'i11'), column(keys(2:), 'es13.5'), &
                       column('CD', 'i11', is_listed=page%along_cd)], page%file)
      allocate (values(n_places + size(along, 1), size(nodes)))
      values(:n_places, :) = clean(model%mesh%x(:n_places, nodes))
      values(n_places + 1:, :) = clean(along, spread(floors, 1, size(along, 1)))
      call print_rows(page, table, keys, model%mesh%node_id(nodes), values, system)
   end subroutine list_vectors

   !> Print the rows of TABLE: under the first of KEYS the ID, under the others VALUES, and the number of a SYSTEM under CD if given.
   subroutine print_rows(page, table, keys, id, values, system)
      type(page_type), intent(inout)       :: page
      type(table_type), intent(in)         :: table
      character(*), intent(in)             :: keys(:)      !! (n + 1)
      integer, intent(in)                  :: id(:)        !! (rows)
      real(wp), intent(in)                 :: values(:, :) !! (n, rows)
      integer, intent(in), optional        :: system(:)    !! (rows)
      type(table_type), allocatable       :: pieces(:)
      type(output_file_type), allocatable :: lines(:)      ! of each piece
      integer :: first, k, last, part

      allocate (pieces(min(block_rows, size(id) + piece - 1)/piece), lines(min(block_rows, size(id) + piece - 1)/piece))
      pieces = table
      do first = 1, size(id), block_rows
         last = min(size(id), first + block_rows - 1)
         !$omp parallel do schedule(dynamic, 1) default(shared) private(k) if(size(id) > few)
         do part = 1, (last - first)/piece + 1
            call lines(part)%start('')
            do k = first + (part - 1)*piece, min(last, first + part*piece - 1)
               call pieces(part)%put(trim(keys(1)), id(k))
               call pieces(part)%put(keys(2:), values(:, k))
               if (present(system)) call pieces(part)%put('CD', system(k))
               call pieces(part)%print_row(lines(part))
            end do
         end do
         !$omp end parallel do
         do part = 1, (last - first)/piece + 1
            call page%file%put_lines(lines(part)%text_behind(0))
         end do
      end do
   end subroutine print_rows

   !> Stresses at the centres of elements, and if HAS_PRINCIPAL the principal stresses and the equivalent stress of von Mises there.
   subroutine list_stresses(page, has_principal, model, analysis)
      type(page_type), intent(inout)  :: page
      logical, intent(in)             :: has_principal
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(9), parameter :: principal(4) = [character(9) :: 'SIGMA 1', 'SIGMA 2', 'SIGMA 3', 'VON MISES']
      type(table_type) :: table
      real(wp), allocatable :: stress(:, :), centre(:, :), values(:, :)
      integer, allocatable  :: list(:)
      real(wp) :: floor, full(max_stresses)
      integer  :: e, i, n

      allocate (stress(max_stresses, model%mesh%n_elements), source=0.0_wp)
      allocate (centre(model%mesh%dimension, model%mesh%n_elements))
      n = size(stress_names(model))
      !$omp parallel do schedule(dynamic, piece) default(shared) if(model%mesh%n_elements > few)
      do e = 1, model%mesh%n_elements
         if (is_shell(model%mesh, e) .or. is_beam(model%mesh, e)) cycle
         stress(:n_stresses(model%mesh%properties(model%mesh%element_property(e))%state), e) = &
            element_stress(model, e, analysis%all_u, analysis%now%temperature)
         centre(:, e) = element_centre(model, e)
      end do
      !$omp end parallel do
      floor = page_zero*maxval(abs(stress))
      call table%start('STRESSES AT THE CENTRES OF ELEMENTS'//page%now//in_units(page%labels%pressure), &
                       [column('ELEMENT', 'i11'), column('CENTRE '//axes(:model%mesh%dimension), 'es13.5'), &
                        column(stress_names(model), 'es13.5')], page%file)
      list = pack([(e, e = 1, model%mesh%n_elements)], [(shows(page, element_points(model%mesh, e)) .and. &
                  .not. (is_shell(model%mesh, e) .or. is_beam(model%mesh, e)), e = 1, model%mesh%n_elements)])
      allocate (values(model%mesh%dimension + n, size(list)))
      values(:model%mesh%dimension, :) = clean(centre(:, list))
      values(model%mesh%dimension + 1:, :) = clean(stress(:n, list), floor)
      call print_rows(page, table, [character(10) :: 'ELEMENT', 'CENTRE '//axes(:model%mesh%dimension), stress_names(model)], &
                      model%mesh%element_id(list), values)
      if (.not. has_principal) return
      call table%start('PRINCIPAL STRESSES AT THE CENTRES OF ELEMENTS'//page%now//in_units(page%labels%pressure), &
                       [column('ELEMENT', 'i11'), column(principal, 'es13.5')], page%file)
      do i = 1, size(list)
         full = whole_stress(model, list(i), analysis%all_u, analysis%now%temperature)
         call table%put('ELEMENT', model%mesh%element_id(list(i)))
         call table%put(principal, [principal_stresses(full), von_mises(full)], floor)
         call table%print_row(page%file)
      end do
   end subroutine list_stresses

   !> Which of the stresses (xx, yy, zz, xy, yz, zx) the tables of MODEL show.
   pure function shown_stresses(model) result(shown)
      type(model_type), intent(in) :: model
      integer, allocatable         :: shown(:)
      integer :: k

      shown = [(k, k = 1, max_stresses)]
      if (model%mesh%dimension == 2) shown = [1, 2, 4]
      if (model%mesh%axisymmetric) shown = [1, 2, 3, 4]
   end function shown_stresses

   !> Names of the stresses; the stress across the plane of an axisymmetric model is the hoop stress.
   pure function stress_names(model) result(names)
      type(model_type), intent(in) :: model
      character(10), allocatable   :: names(:)
      character(10) :: all_names(max_stresses)

      all_names = [character(10) :: 'SIGMA X', 'SIGMA Y', 'SIGMA Z', 'TAU XY', 'TAU YZ', 'TAU ZX']
      if (model%mesh%axisymmetric) all_names(3) = 'SIGMA HOOP'
      names = all_names(shown_stresses(model))
   end function stress_names

   !> Reactions at supports, the balance of all external forces, which are loads, supports and rigid bases, and support moments.
   subroutine list_reactions(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(33), parameter :: names(5) = [character(33) :: 'LOADS', 'SUPPORTS', 'RIGID BASES, THROUGH THE JOINTS', &
                                              'GROUND, THROUGH SPRINGS', 'SUM: LEFT UNBALANCED']
      type(table_type) :: table
      type(balance_type) :: balance
      integer, allocatable :: list(:)
      real(wp) :: floor
      integer  :: first, i, m

      call find_balance(model, analysis, page%largest_force, balance)
      floor = balance%floors(balance_supports)
      list = pack(balance%supported, [(shows(page, balance%supported(i:i)), i = 1, size(balance%supported))])
      call list_vectors(page, model, [character(21) :: 'REACTIONS AT SUPPORTS', 'R.', page%labels%force], list, &
                        balance%held(:, list), spread(floor, 1, size(list)))
      ! the balance
      first = merge(2, 1, model%mesh%axisymmetric)
      call table%start('BALANCE OF FORCES'//page%now//in_units(page%labels%force), &
                       [column('', 'a35', key='of'), column(axes(first:model%mesh%dimension), 'es13.5'), &
                        column(one_of(model%mesh%axisymmetric, '  (THE RADIAL FORCES BALANCE ROUND THE RING)', ''), 'a', &
                               key='note')], page%file)
      do i = 1, size(names)
         if (i == balance_springs .and. all(model%mesh%bars%nodes(2) > 0)) cycle
         call table%put('of', names(i))
         call table%put(axes(first:model%mesh%dimension), balance%force(first:, i), balance%floors(i))
         call table%leave_rest()
         call table%print_row(page%file)
      end do
      ! support moments, where any rotation is supported
      list = pack([(i, i = 1, n_rotations(model%mesh))], [(any(supported(model%mesh, model%freedoms, &
         model%mesh%rotations(i)%node)), i = 1, n_rotations(model%mesh))])
      if (size(list) == 0) return
      m = merge(3, 1, model%mesh%dimension == 3)
      associate (rotations => model%mesh%rotations(list))
         call list_vectors(page, model, [character(19) :: 'MOMENTS AT SUPPORTS', 'M.', ''], rotations%point, &
                           balance%held(:m, rotations%node)*spread(rotations%arm, 1, m), floor*rotations%arm, turns=.true.)
      end associate
   end subroutine list_reactions

   !> [k_b] condensed on the joint unknowns, and the condensed loads before and after the stage; columns in groups.
   subroutine list_condensed(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, parameter :: across = 8
      character(10), parameter :: states(3) = [character(10) :: 'BEFORE', 'AFTER', 'DIFFERENCE']
      type(table_type) :: table
      character(12), allocatable :: names(:)
      real(wp), allocatable :: scale(:)
      real(wp) :: k_floor, load_floor
      integer  :: i, first, k, last, n

      associate (condensed => analysis%record%condensed)
         if (condensed%problem /= '') then
            call heading(page%file, '[K_B] CONDENSED ON THE INTERFACE, '//page%stage//': NOT PRINTED, '//upper(condensed%problem))
            return
         end if
         n = size(condensed%node)
         k_floor = page_zero*maxval(abs(condensed%k))
         load_floor = page_zero*max(page%largest_force, maxval(abs(condensed%load)))
         allocate (names(n))
         allocate (scale(n), source=1.0_wp)
         do i = 1, n ! 12Y, or 900RZ for a rotation of node 900, whose rows hold moments over its arm
            associate (node => condensed%node(i), d => condensed%direction(i))
               k = 0
               if (n_rotations(model%mesh) > 0) k = findloc(model%mesh%rotations%node, node, dim=1)
               if (k == 0) names(i) = integer_text(model%mesh%node_id(node))//axes(d)
               if (k == 0) cycle
               names(i) = integer_text(model%mesh%node_id(model%mesh%rotations(k)%point))//'R'//axes(merge(d, 3, &
                  model%mesh%dimension == 3))
               scale(i) = model%mesh%rotations(k)%arm
            end associate
         end do
         do first = 1, n, across
            last = min(n, first + across - 1)
            call table%start('[K_B] CONDENSED ON THE INTERFACE, '//page%stage, &
                             [column('UNKNOWN', 'a13'), column(names(first:last), 'es13.5', page%labels%stiffness)], page%file)
            do i = 1, n
               call table%put('UNKNOWN', adjustr(names(i)))
               call table%put(names(first:last), clean(condensed%k(i, first:last), k_floor)*scale(i)*scale(first:last))
               call table%print_row(page%file)
            end do
         end do
         call table%start('LOAD CONDENSED ON THE INTERFACE, '//page%stage//': AN INCREMENT BRINGS ITS SHARE OF THE DIFFERENCE', &
                          [column('UNKNOWN', 'a13'), column(states, 'es13.5', page%labels%force)], page%file)
         do i = 1, n
            call table%put('UNKNOWN', adjustr(names(i)))
            call table%put(states, clean([condensed%load(i, :), condensed%load(i, 2) - condensed%load(i, 1)], load_floor)*scale(i))
            call table%print_row(page%file)
         end do
      end associate
   end subroutine list_condensed

end module body_tables
