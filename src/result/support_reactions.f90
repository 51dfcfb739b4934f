!> What the supports take at the end of a stage: of every SPC1 card, of the SPC cards of a set, of every surface of SPCM, of PS on GRID,
!! of every joint to a rigid base, of the springs to the ground; and the balance with the loads.
module support_reactions
   use analysis_state, only: analysis_type, element_force
   use bolt_locking, only: bar_tension
   use interface_operator, only: at_first_end, named_node
   use kinds, only: wp
   use listing_table, only: axes, column, label_type, listing_table_type
   use model_data, only: a_rotation, has_ground_springs, model_type, n_bars, n_points, n_rotations, node_kind, place_in_kind
   use node_coupling, only: forces_on_unknowns
   use numbers, only: cross
   use output_file, only: output_file_type
   use text_tools, only: above, clean, csv_line_type
   implicit none
   private

   public :: find_reactions, print_reactions, write_reactions

   integer, parameter  :: most_rows = 40           ! of the block; the file has all
   real(wp), parameter :: remainder = 1.0e-7_wp    ! of the largest force: what less is left of sums is rounding

   !> A resultant.
   type, public :: reaction_type
      character(8) :: kind = ''                !! SPC, SPC1, SPCM, GRID; BASE: a joint to a rigid base; SPRINGS: to the ground
      integer  :: id = 0                       !! set, PMARK, or joint
      integer  :: line = 0                     !! of its card in the deck with its INCLUDE files, 0: none
      integer  :: nodes = 0                    !! that it acts on
      real(wp) :: centre(3) = 0.0_wp           !! mean place of these [length]
      real(wp) :: force(3) = 0.0_wp            !! as it acts on the structure [force]
      real(wp) :: moment(3) = 0.0_wp           !! about the origin [force x length]
      real(wp) :: about_centre(3) = 0.0_wp     !! and about the centre
   end type reaction_type

   !> All of them, their sum, and the loads.
   type, public :: reactions_type
      type(reaction_type), allocatable :: parts(:)
      type(reaction_type) :: total, loads
      real(wp) :: left(3) = 0.0_wp             !! sum of all forces: left unbalanced
   end type reactions_type

contains

   !> The reactions at the end of the stage just completed, the bodies recovered.
   subroutine find_reactions(model, analysis, largest_force, answer)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      real(wp), intent(in)              :: largest_force !! ever applied at a node, for the noise
      type(reactions_type), intent(out) :: answer
      real(wp) :: x(3)
      integer  :: base_of(size(model%joints)), d, i, j, n, node

      n = size(model%support_groups)
      allocate (answer%parts(n + size(model%joints) + 1))
      answer%parts(:n)%kind = model%support_groups%kind
      answer%parts(:n)%id = model%support_groups%id
      answer%parts(:n)%line = model%support_groups%line
      call add_supports(model, analysis, answer%parts)
      d = model%dimension
      base_of = 0
      do i = 1, size(model%interface)
         associate (element => model%interface(i))
            if (named_node(element, 2) /= 0) cycle
            if (base_of(element%joint) == 0) then
               n = n + 1
               base_of(element%joint) = n
               answer%parts(n)%kind = 'BASE'
               answer%parts(n)%id = model%joints(element%joint)%id
            end if
            x = at_first_end(element, model%x)
            call act(answer%parts(base_of(element%joint)), x, -element_force(element, analysis%states(i)))
         end associate
      end do
      if (has_ground_springs(model)) then
         n = n + 1
         answer%parts(n)%kind = 'SPRINGS'
         do i = 1, n_bars(model)
            associate (bar => model%bars(i))
               if (bar%nodes(2) > 0) cycle
               if (node_kind(model, bar%nodes(1)) == a_rotation) then
                  answer%parts(n)%nodes = answer%parts(n)%nodes + 1
                  answer%parts(n)%centre = answer%parts(n)%centre + model%x(:, bar%nodes(1))
                  call add_moment(model, place_in_kind(model, bar%nodes(1)), bar_tension(model, analysis, i)* &
                                  bar%direction(:model%dimension, 1), answer%parts(n))
               else
                  call act(answer%parts(n), model%x(:, bar%nodes(1)), bar_tension(model, analysis, i)*bar%direction(:, 1))
               end if
            end associate
         end do
      end if
      answer%parts = pack(answer%parts(:n), answer%parts(:n)%nodes > 0)
      answer%loads%kind = 'LOADS'
      do node = 1, n_points(model)
         if (any(abs(analysis%now%load(:, node)) > 0.0_wp)) call act(answer%loads, model%x(:, node), analysis%now%load(:, node))
      end do
      do j = 1, n_rotations(model)
         call add_moment(model, j, analysis%now%load(:, model%rotations(j)%node), answer%loads)
      end do
      answer%total%kind = 'ALL'
      do j = 1, size(answer%parts)
         answer%total%nodes = answer%total%nodes + answer%parts(j)%nodes
         answer%total%centre = answer%total%centre + answer%parts(j)%centre
         answer%total%force = answer%total%force + answer%parts(j)%force
         answer%total%moment = answer%total%moment + answer%parts(j)%moment
         call settle(model, largest_force, answer%parts(j))
      end do
      answer%left = answer%total%force + answer%loads%force
      if (model%axisymmetric) answer%left(1) = 0.0_wp
      answer%left = above(answer%left, remainder*largest_force)
      call settle(model, largest_force, answer%total)
      call settle(model, largest_force, answer%loads)
   end subroutine find_reactions

   !> What supported components take, to the PARTS of their groups.
   subroutine add_supports(model, analysis, parts)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(reaction_type), intent(inout) :: parts(:)
      real(wp), allocatable :: felt(:, :)
      integer, allocatable  :: rotation_at(:)
      real(wp) :: force(model%dimension)
      integer  :: d, g, k, node

      allocate (felt, source=forces_on_unknowns(model, analysis%all_unbalanced))
      allocate (rotation_at(model%n_nodes), source=0)
      do k = 1, n_rotations(model)
         rotation_at(model%rotations(k)%node) = k
      end do
      do node = 1, size(model%support_of, 2)
         associate (groups => model%support_of(:, node))
            do d = 1, model%dimension
               g = groups(d)
               if (g == 0 .or. any(groups(:d - 1) == g) .or. .not. model%used(node)) cycle
               force = -merge(felt(:, node), 0.0_wp, groups == g)
               if (allocated(model%coupling%of_node)) force = along_axes(model, node, force)
               if (rotation_at(node) > 0) then
                  call add_moment(model, rotation_at(node), force, parts(g))
               else
                  call act(parts(g), model%x(:, node), force)
               end if
            end do
         end associate
      end do
   end subroutine add_supports

   !> FORCE on the unknowns of NODE in global axes.
   pure function along_axes(model, node, force) result(turned)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp), intent(in)         :: force(:)
      real(wp) :: turned(size(force))
      integer  :: k

      turned = force
      associate (coupling => model%coupling, c => model%coupling%of_node(node))
         if (c == 0) return
         do k = coupling%first(c), coupling%first(c + 1) - 1
            if (coupling%node(k) == node) turned = matmul(coupling%t(:, :, k), force)
         end do
      end associate
   end function along_axes

   !> FORCE on the node of rotation K is a moment.
   pure subroutine add_moment(model, k, force, part)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: k
      real(wp), intent(in)               :: force(:) !! (dimension)
      type(reaction_type), intent(inout) :: part

      if (model%dimension == 3) part%moment = part%moment + force*model%rotations(k)%arm
      if (model%dimension == 2) part%moment(3) = part%moment(3) + force(1)*model%rotations(k)%arm
   end subroutine add_moment

   !> FORCE acts at X.
   pure subroutine act(part, x, force)
      type(reaction_type), intent(inout) :: part
      real(wp), intent(in)               :: x(3), force(:) !! (2 or 3)
      real(wp) :: whole(3)

      whole = 0.0_wp
      whole(:size(force)) = force
      part%nodes = part%nodes + 1
      part%centre = part%centre + x
      part%force = part%force + whole
      part%moment = part%moment + cross(x, whole)
   end subroutine act

   !> All of PART is there: the mean place, the moment about it; what is rounding is zero, and on a ring what balances round it.
   pure subroutine settle(model, largest_force, part)
      type(model_type), intent(in)       :: model
      real(wp), intent(in)               :: largest_force
      type(reaction_type), intent(inout) :: part
      real(wp) :: floor

      part%centre = part%centre/max(part%nodes, 1)
      part%about_centre = part%moment - cross(part%centre, part%force)
      if (model%axisymmetric) then
         part%force(1) = 0.0_wp
         part%moment = 0.0_wp
         part%about_centre = 0.0_wp
      end if
      floor = remainder*largest_force
      part%force = above(part%force, floor)
      floor = floor*maxval(abs(model%x(:, :n_points(model))))
      part%moment = above(part%moment, floor)
      part%about_centre = above(part%about_centre, floor)
   end subroutine settle

   !> A table behind the answer of a stage; its last line is the balance.
   subroutine print_reactions(file, labels, model, answer)
      type(output_file_type), intent(inout) :: file
      type(label_type), intent(in)          :: labels
      type(model_type), intent(in)          :: model
      type(reactions_type), intent(in)      :: answer
      type(listing_table_type) :: table
      integer :: d, first, i

      d = model%dimension
      first = merge(1, 3, d == 3) ! of the moments
      call file%put('')
      call table%start('', [column('REACTIONS', 'a9'), column('NUMBER', 'i11'), column('NODES', 'i8'), &
                            column('R'//axes(:d), 'es12.4', labels%force), column('M'//axes(first:), 'es11.3', labels%moment), &
                            column('MC'//axes(first:), 'es11.3', labels%moment)], file)
      do i = 1, min(size(answer%parts), most_rows)
         call row(answer%parts(i))
      end do
      if (size(answer%parts) > most_rows) call file%put('  ... ALL OF THEM IN THE CSV FILE')
      if (size(answer%parts) > 1) call row(answer%total)
      call row(answer%loads)
      call table%add(' LEFT')
      call table%skip(2)
      call table%add(clean(answer%left(:d)))
      call table%print_row(file)

   contains

      subroutine row(part)
         type(reaction_type), intent(in) :: part

         call table%add(' '//part%kind)
         call table%add([part%id], where=[part%id > 0])
         call table%add([part%nodes], clean([part%force(:d), part%moment(first:), part%about_centre(first:)]))
         call table%print_row(file)
      end subroutine row

   end subroutine print_reactions

   !> The rows of the stage with the number STAGE.
   subroutine write_reactions(file, stage, answer)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage
      type(reactions_type), intent(in)      :: answer
      integer :: i

      do i = 1, size(answer%parts)
         call row(answer%parts(i))
      end do
      call row(answer%total)
      call row(answer%loads)

   contains

      subroutine row(part)
         type(reaction_type), intent(in) :: part
         type(csv_line_type) :: line

         call line%add([stage])
         call line%add(trim(part%kind))
         call line%add([part%id, part%line, part%nodes], clean([part%centre, part%force, part%moment, part%about_centre]))
         call file%put(line%text(:line%length))
      end subroutine row

   end subroutine write_reactions

end module support_reactions
