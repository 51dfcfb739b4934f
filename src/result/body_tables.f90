!> Tables of the bodies: displacements, rotations, stresses, reactions, and the balance of the external forces. Where OUTPUT
!! limits a stage to some nodes, the tables have the rows of these nodes and of the elements with any of them. Nodal vectors are
!! given along the axes of the model, or with OUTPUT = CD along those of the displacement system of each node, whose number
!! follows the row.
module body_tables
   use analysis_state, only: analysis_type, element_force
   use body_elements, only: element_centre, element_stress, node_stresses, whole_stress
   use bolt_locking, only: bar_tension
   use elasticity, only: max_stresses, n_stresses, principal_stresses, von_mises
   use interface_operator, only: named_node
   use kinds, only: wp
   use table_writer, only: axes, column, column_type, in_units, table_type, noise, page_type, page_width, shows
   use model_data, only: a_point, corners_of, has_ground_springs, has_second_order, is_beam, is_shell, model_type, n_bars, &
                         n_points, n_rotations, node_kind, supported
   use node_coupling, only: held_forces, node_axes
   use stage_entries, only: output_request
   use structural_results, only: list_structural
   use text_tools, only: clean
   implicit none
   private

   public :: list_bodies

   ! All threads write long tables: rows are printed in blocks, and each thread writes pieces of a block.
   integer, parameter :: block_rows = 16384, piece = 512, few = 4096
   real(wp), parameter :: of_a_sum = 1.0e-14_wp ! of the sum of amounts: rounding error of a sum

contains

   !> Displacements, stresses, reactions; where stresses are ASKED also principal stresses, and those at nodes of second-order
   !! elements.
   subroutine list_bodies(page, asked, model, analysis)
      type(page_type), intent(inout)  :: page
      type(output_request), intent(in) :: asked
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      logical :: has_bodies

      call list_displacements(page, model, analysis)
      call list_rotations(page, model, analysis)
      has_bodies = model%n_elements > 0
      if (allocated(model%structural%place)) has_bodies = any(model%structural%place == 0)
      if (has_bodies) call list_stresses(page, asked%stress, model, analysis)
      call list_structural(page, asked, model, analysis)
      if (asked%stress .and. has_second_order(model)) call list_node_stresses(page, model, analysis)
      call list_reactions(page, model, analysis)
      call list_moments(page, model, analysis)
   end subroutine list_bodies

   subroutine list_displacements(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      integer, allocatable :: list(:)
      real(wp) :: floor
      integer  :: node

      call table%start('DISPLACEMENTS OF NODES'//direction_words(page)//page%now//in_units(page%labels%length), &
                       [column('NODE', 'i11'), column(axes(:model%dimension), 'es13.5'), &
                        direction_columns(page, 'U', model%dimension)], page%file)
      floor = noise*maxval(abs(analysis%all_u(:, :n_points(model))))
      if (.not. page%along_cd) then
         list = pack([(node, node = 1, n_points(model))], &
                     [(model%used(node) .and. shows(page, [node]), node = 1, n_points(model))])
         call print_rows(page, table, model%node_id(list), clean(model%x(:model%dimension, list)), &
                         clean(analysis%all_u(:, list), floor))
         return
      end if
      do node = 1, n_points(model)
         if (.not. model%used(node) .or. .not. shows(page, [node])) cycle
         call table%add([model%node_id(node)], clean(model%x(:model%dimension, node)))
         call add_directed(page, model, node, analysis%all_u(:, node), floor, table)
         call table%print_row(page%file)
      end do
   end subroutine list_displacements

   !> Print the rows of TABLE: ID, the place X, VALUES.
   subroutine print_rows(page, table, id, x, values)
      type(page_type), intent(inout)       :: page
      type(table_type), intent(in)         :: table
      integer, intent(in)                  :: id(:)        !! (rows)
      real(wp), intent(in)                 :: x(:, :)      !! (dimension, rows)
      real(wp), intent(in)                 :: values(:, :) !! (n, rows)
      character(piece*(page_width + 1)), allocatable :: lines(:)
      integer :: first, last, part, used(block_rows/piece)

      allocate (lines(min(block_rows, size(id) + piece - 1)/piece))
      do first = 1, size(id), block_rows
         last = min(size(id), first + block_rows - 1)
         !$omp parallel do schedule(dynamic, 1) default(shared) if(size(id) > few)
         do part = 1, (last - first)/piece + 1
            call write_piece(first + (part - 1)*piece, min(last, first + part*piece - 1), lines(part), used(part))
         end do
         !$omp end parallel do
         do part = 1, (last - first)/piece + 1
            call page%file%put_lines(lines(part)(:used(part)))
         end do
      end do

   contains

      !> The LINES of rows FROM to UNTIL, and the number of characters USED.
      subroutine write_piece(from, until, lines, used)
         integer, intent(in)         :: from, until
         character(*), intent(inout) :: lines
         integer, intent(out)        :: used
         type(table_type) :: mine
         integer :: k

         mine = table
         used = 0
         do k = from, until
            call mine%add([id(k)], x(:, k))
            call mine%add(values(:, k))
            call mine%take_line(lines, used)
         end do
      end subroutine write_piece

   end subroutine print_rows

   subroutine list_stresses(page, principal, model, analysis)
      type(page_type), intent(inout)  :: page
      logical, intent(in)             :: principal
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      real(wp), allocatable :: stress(:, :), centre(:, :)
      integer, allocatable  :: list(:)
      real(wp) :: floor
      integer  :: e, n

      allocate (stress(max_stresses, model%n_elements), source=0.0_wp)
      allocate (centre(model%dimension, model%n_elements))
      n = size(stress_names(model))
      !$omp parallel do schedule(dynamic, piece) default(shared) if(model%n_elements > few)
      do e = 1, model%n_elements
         if (is_shell(model, e) .or. is_beam(model, e)) cycle
         stress(:n_stresses(model%properties(model%element_property(e))%state), e) = &
            element_stress(model, e, analysis%all_u, analysis%now%temperature)
         centre(:, e) = element_centre(model, e)
      end do
      !$omp end parallel do
      floor = noise*maxval(abs(stress))
      call table%start('STRESSES AT THE CENTRES OF ELEMENTS'//page%now//in_units(page%labels%pressure), &
                       [column('ELEMENT', 'i11'), column('CENTRE '//axes(:model%dimension), 'es13.5'), &
                        column(stress_names(model), 'es13.5')], page%file)
      list = pack([(e, e = 1, model%n_elements)], [(shows_body(page, model, e), e = 1, model%n_elements)])
      call print_rows(page, table, model%element_id(list), clean(centre(:, list)), clean(stress(:n, list), floor))
      if (principal) call list_principal(page, model, analysis, floor)
   end subroutine list_stresses

   !> Whether the tables of bodies have element E.
   pure logical function shows_body(page, model, e)
      type(page_type), intent(in)  :: page
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      shows_body = shows(page, corners_of(model, e)) .and. .not. (is_shell(model, e) .or. is_beam(model, e))
   end function shows_body

   !> Which of the stresses (xx, yy, zz, xy, yz, zx) the tables of MODEL show.
   pure function shown_stresses(model) result(shown)
      type(model_type), intent(in) :: model
      integer, allocatable         :: shown(:)
      integer :: k

      shown = [(k, k = 1, max_stresses)]
      if (model%dimension == 2) shown = [1, 2, 4]
      if (model%axisymmetric) shown = [1, 2, 3, 4]
   end function shown_stresses

   !> Names of the stresses; the stress across the plane of an axisymmetric model is the hoop stress.
   pure function stress_names(model) result(names)
      type(model_type), intent(in) :: model
      character(10), allocatable   :: names(:)
      character(10) :: all_names(max_stresses)

      all_names = [character(10) :: 'SIGMA X', 'SIGMA Y', 'SIGMA Z', 'TAU XY', 'TAU YZ', 'TAU ZX']
      if (model%axisymmetric) all_names(3) = 'SIGMA HOOP'
      names = all_names(shown_stresses(model))
   end function stress_names

   !> Stresses at nodes, averaged over their elements, and their equivalent stress of von Mises.
   subroutine list_node_stresses(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      real(wp), allocatable :: stress(:, :)
      integer, allocatable  :: shown(:)
      real(wp) :: floor
      integer  :: node

      allocate (stress(max_stresses, n_points(model)))
      call node_stresses(model, analysis%all_u, analysis%now%temperature, stress)
      floor = noise*maxval(abs(stress))
      shown = shown_stresses(model)
      call table%start('STRESSES AT NODES, MEAN OF THEIR ELEMENTS'//page%now//in_units(page%labels%pressure), &
                       [column('NODE', 'i11'), column([character(10) :: stress_names(model), 'VON MISES'], 'es13.5')], page%file)
      do node = 1, n_points(model)
         if (model%first_at(node + 1) == model%first_at(node) .or. .not. shows(page, [node])) cycle
         call table%add([model%node_id(node)], clean([stress(shown, node), von_mises(stress(:, node))], floor))
         call table%print_row(page%file)
      end do
   end subroutine list_node_stresses

   !> Principal stresses and the equivalent stress of von Mises at the centres.
   subroutine list_principal(page, model, analysis, floor)
      type(page_type), intent(inout) :: page
      type(model_type), intent(in)   :: model
      type(analysis_type), intent(in) :: analysis
      real(wp), intent(in)           :: floor
      type(table_type) :: table
      real(wp) :: full(max_stresses)
      integer  :: e

      call table%start('PRINCIPAL STRESSES AT THE CENTRES OF ELEMENTS'//page%now//in_units(page%labels%pressure), &
                       [column('ELEMENT', 'i11'), &
                        column([character(9) :: 'SIGMA 1', 'SIGMA 2', 'SIGMA 3', 'VON MISES'], 'es13.5')], page%file)
      do e = 1, model%n_elements
         if (.not. shows_body(page, model, e)) cycle
         full = whole_stress(model, e, analysis%all_u, analysis%now%temperature)
         call table%add([model%element_id(e)], clean([principal_stresses(full), von_mises(full)], floor))
         call table%print_row(page%file)
      end do
   end subroutine list_principal

   !> Reactions at supports, and the balance of all external forces: loads, supports, rigid bases.
   subroutine list_reactions(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      real(wp), dimension(model%dimension) :: reaction, supports, base, ground, loads
      real(wp), allocatable :: held(:, :)
      real(wp) :: floor, force(3)
      integer  :: first, i, node

      call table%start('REACTIONS AT SUPPORTS'//direction_words(page)//page%now//in_units(page%labels%force), &
                       [column('NODE', 'i11'), column(axes(:model%dimension), 'es13.5'), &
                        direction_columns(page, 'R', model%dimension)], page%file)
      floor = noise*max(page%largest_force, tiny(1.0_wp))
      supports = 0.0_wp
      allocate (held, source=held_forces(model, analysis%all_unbalanced))
      do node = 1, n_points(model)
         if (.not. any(supported(model, node)) .or. .not. model%used(node)) cycle
         reaction = -held(:, node)
         supports = supports + reaction
         if (.not. shows(page, [node])) cycle
         call table%add([model%node_id(node)], clean(model%x(:model%dimension, node)))
         call add_directed(page, model, node, reaction, floor, table)
         call table%print_row(page%file)
      end do
      base = 0.0_wp
      do i = 1, size(model%interface)
         if (named_node(model%interface(i), 2) /= 0) cycle
         force = element_force(model%interface(i), analysis%states(i))
         base = base - force(:model%dimension)
      end do
      ground = 0.0_wp
      do i = 1, n_bars(model)
         if (model%bars(i)%nodes(2) > 0 .or. node_kind(model, model%bars(i)%nodes(1)) /= a_point) cycle
         ground = ground + bar_tension(model, analysis, i)*model%bars(i)%direction(:model%dimension, 1)
      end do
      loads = sum(analysis%now%load(:, :n_points(model)), dim=2)
      first = merge(2, 1, model%axisymmetric)
      call table%start('BALANCE OF FORCES'//page%now//in_units(page%labels%force), &
                       [column('', 'a35'), column(axes(first:model%dimension), 'es13.5'), &
                        column(merge('  (THE RADIAL FORCES BALANCE ROUND THE RING)', repeat(' ', 44), model%axisymmetric), 'a')], &
                       page%file)
      call balance_line('LOADS', loads(first:), min(floor, of_a_sum*sum(abs(analysis%now%load))))
      call balance_line('SUPPORTS', supports(first:), floor)
      call balance_line('RIGID BASES, THROUGH THE JOINTS', base(first:), floor)
      if (has_ground_springs(model)) call balance_line('GROUND, THROUGH SPRINGS', ground(first:), floor)
      call balance_line('SUM: LEFT UNBALANCED', loads(first:) + supports(first:) + base(first:) + ground(first:), floor)

   contains

      subroutine balance_line(words, resultant, floor)
         character(*), intent(in) :: words
         real(wp), intent(in)     :: resultant(:)
         real(wp), intent(in)     :: floor !! values below it are rounding [force]
         character(33) :: name

         name = words
         call table%add(name, clean(resultant, floor))
         call table%print_row(page%file)
      end subroutine balance_line

   end subroutine list_reactions

   !> Columns of a vector whose parts are called PART, along M directions: the first ones, or BEHIND the last ones.
   function direction_columns(page, part, m, behind) result(columns)
      type(page_type), intent(in)   :: page
      character(*), intent(in)      :: part
      integer, intent(in)           :: m
      logical, intent(in), optional :: behind !! default: the first ones
      type(column_type), allocatable :: columns(:)
      character(1), parameter :: numbers(3) = ['1', '2', '3']
      integer :: first

      first = 1
      if (present(behind)) first = merge(4 - m, 1, behind)
      associate (names => merge(numbers, axes, page%along_cd))
         columns = [column(part//names(first:first + m - 1), 'es13.5'), column('CD', 'i11', is_listed=page%along_cd)]
      end associate
   end function direction_columns

   !> The words behind the title of such a table.
   pure function direction_words(page) result(words)
      type(page_type), intent(in) :: page
      character(:), allocatable :: words

      words = ''
      if (page%along_cd) words = ' ALONG THEIR SYSTEMS CD (0: X, Y, Z)'
   end function direction_words

   !> Add the VECTOR at NODE, given in global axes, to the row of TABLE, with values below FLOOR as zero, and the node's system.
   subroutine add_directed(page, model, node, vector, floor, table)
      type(page_type), intent(in)             :: page
      type(model_type), intent(in)            :: model
      integer, intent(in)                     :: node
      real(wp), intent(in)                    :: vector(:), floor
      type(table_type), intent(inout)         :: table
      real(wp) :: directions(3, 3)
      integer  :: system

      if (.not. page%along_cd) then
         call table%add(clean(vector, floor))
         return
      end if
      directions = node_axes(model, node)
      system = 0
      if (allocated(model%node_system)) system = model%node_system(node)
      if (system > 0) system = model%systems(system)%id
      if (size(vector) == 1) then ! about z for a plane model
         call table%add(clean(vector*directions(3, 3), floor))
      else
         associate (d => size(vector))
            call table%add(clean(matmul(vector, directions(:d, :d)), floor))
         end associate
      end if
      call table%add([system])
   end subroutine add_directed

   !> Rotations in radians about the global axes, or those of the systems CD.
   subroutine list_rotations(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      real(wp) :: floor
      integer  :: i, m

      if (n_rotations(model) == 0) return
      m = merge(3, 1, model%dimension == 3)
      call table%start('ROTATIONS OF REFERENCE NODES'//direction_words(page)//page%now//'   (RADIANS)', &
                       [column('NODE', 'i11'), direction_columns(page, 'THETA ', m, behind=.true.)], page%file)
      associate (rotations => model%rotations)
         floor = noise*maxval(abs(analysis%all_u)) ! of displacements
         do i = 1, size(rotations)
            call table%add([model%node_id(rotations(i)%point)])
            call add_directed(page, model, rotations(i)%point, analysis%all_u(:m, rotations(i)%node)/rotations(i)%arm, &
                              floor/rotations(i)%arm, table)
            call table%print_row(page%file)
         end do
      end associate
   end subroutine list_rotations

   !> Support moments about these axes, where any rotation is supported.
   subroutine list_moments(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(table_type) :: table
      real(wp), allocatable :: held(:, :)
      real(wp) :: floor
      integer  :: i, m

      if (.not. any([(any(supported(model, model%rotations(i)%node)), i = 1, n_rotations(model))])) return
      m = merge(3, 1, model%dimension == 3)
      call table%start('MOMENTS AT SUPPORTS'//direction_words(page)//page%now, &
                       [column('NODE', 'i11'), direction_columns(page, 'M', m, behind=.true.)], page%file)
      held = held_forces(model, analysis%all_unbalanced)
      do i = 1, size(model%rotations)
         associate (rotation => model%rotations(i))
            if (.not. any(supported(model, rotation%node))) cycle
            floor = noise*max(page%largest_force, tiny(1.0_wp))*rotation%arm
            call table%add([model%node_id(rotation%point)])
            call add_directed(page, model, rotation%point, -held(:m, rotation%node)*rotation%arm, floor, table)
            call table%print_row(page%file)
         end associate
      end do
   end subroutine list_moments

end module body_tables
