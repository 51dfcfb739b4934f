!> The reactions at the end of a stage, for each group of supports, and their balance with the loads. The groups are every SPC1
!! card, the SPC cards of a set, every surface of SPCM, PS on GRID, every joint to a rigid base, and the springs to ground.
module support_reactions
   use analysis_state, only: analysis_type, element_force
   use bolt_answers, only: remainder
   use bolt_locking, only: bar_tension
   use interface_operator, only: at_first_end, named_node
   use kinds, only: wp
   use model_data, only: a_rotation, has_ground_springs, model_type, n_bars, n_points, n_rotations, node_kind, place_in_kind
   use node_coupling, only: coupling_parts, forces_on_unknowns
   use numbers, only: cross
   use text_tools, only: above
   implicit none
   private

   public :: find_reactions

   !> A resultant.
   type, public :: reaction_type
      character(8) :: kind = ''                !! SPC, SPC1, SPCM, GRID; BASE: a joint to a rigid base; SPRINGS: to the ground
      integer  :: id = 0                       !! set, PMARK, or joint
      integer  :: line = 0                     !! line of its card in the deck with its INCLUDE files, 0: none
      integer  :: nodes = 0                    !! number of its nodes
      real(wp) :: centre(3) = 0.0_wp           !! mean position of these [length]
      real(wp) :: force(3) = 0.0_wp            !! as it acts on the structure [force]
      real(wp) :: moment(3) = 0.0_wp           !! about the origin [force x length]
      real(wp) :: about_centre(3) = 0.0_wp     !! about the centre
   end type reaction_type

   !> All resultants, their sum, and the loads.
   type, public :: reactions_type
      type(reaction_type), allocatable :: parts(:)
      type(reaction_type) :: total, loads
      real(wp) :: left(3) = 0.0_wp             !! sum of all forces: the unbalanced force
   end type reactions_type

contains

   !> The reactions at the end of the stage just completed, the bodies recovered.
   subroutine find_reactions(model, analysis, largest_force, answer)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      real(wp), intent(in)              :: largest_force !! ever applied at a node, for the noise
      type(reactions_type), intent(out) :: answer
      real(wp) :: x(3)
      integer  :: base_of(size(model%joints)), i, j, n, node

      n = size(model%support_groups)
      allocate (answer%parts(n + size(model%joints) + 1))
      answer%parts(:n)%kind = model%support_groups%kind
      answer%parts(:n)%id = model%support_groups%id
      answer%parts(:n)%line = model%support_groups%line
      call add_supports(model, analysis, answer%parts)
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
               end if
               call act_on(model, bar%nodes(1), bar_tension(model, analysis, i)*bar%direction(:model%dimension, 1), answer%parts(n))
            end associate
         end do
      end if
      answer%parts = pack(answer%parts(:n), answer%parts(:n)%nodes > 0)
      answer%loads%kind = 'LOADS'
      do node = 1, n_points(model) + n_rotations(model)
         if (any(abs(analysis%now%load(:, node)) > 0.0_wp)) call act_on(model, node, analysis%now%load(:, node), answer%loads)
      end do
      answer%total%kind = 'ALL'
      do j = 1, size(answer%parts)
         answer%total%nodes = answer%total%nodes + answer%parts(j)%nodes
         answer%total%centre = answer%total%centre + answer%parts(j)%centre
         answer%total%force = answer%total%force + answer%parts(j)%force
         answer%total%moment = answer%total%moment + answer%parts(j)%moment
         call complete_part(model, largest_force, answer%parts(j))
      end do
      answer%left = answer%total%force + answer%loads%force
      if (model%axisymmetric) answer%left(1) = 0.0_wp
      answer%left = above(answer%left, remainder*largest_force)
      call complete_part(model, largest_force, answer%total)
      call complete_part(model, largest_force, answer%loads)
   end subroutine find_reactions

   !> Add the reactions of supported components to the PARTS of their groups.
   subroutine add_supports(model, analysis, parts)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      type(reaction_type), intent(inout) :: parts(:)
      real(wp), allocatable :: felt(:, :)
      real(wp) :: force(model%dimension)
      integer  :: d, g, k, node

      allocate (felt, source=forces_on_unknowns(model, analysis%all_unbalanced))
      do node = 1, size(model%support_of, 2)
         associate (groups => model%support_of(:, node), coupled => coupling_parts(model, node))
            do d = 1, model%dimension
               g = groups(d)
               if (g == 0 .or. any(groups(:d - 1) == g) .or. .not. model%used(node)) cycle
               force = -merge(felt(:, node), 0.0_wp, groups == g)
               do k = coupled(1), coupled(2) ! from the unknowns of the node to global axes
                  if (model%coupling%node(k) == node) force = matmul(model%coupling%t(:, :, k), force)
               end do
               call act_on(model, node, force, parts(g))
            end do
         end associate
      end do
   end subroutine add_supports

   !> Add FORCE on NODE; on the node of a rotation it is a moment.
   pure subroutine act_on(model, node, force, part)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: node
      real(wp), intent(in)               :: force(:) !! (dimension)
      type(reaction_type), intent(inout) :: part

      if (node_kind(model, node) /= a_rotation) then
         call act(part, model%x(:, node), force)
         return
      end if
      associate (arm => model%rotations(place_in_kind(model, node))%arm)
         if (model%dimension == 3) part%moment = part%moment + force*arm
         if (model%dimension == 2) part%moment(3) = part%moment(3) + force(1)*arm
      end associate
   end subroutine act_on

   !> Add FORCE at X.
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

   !> Complete PART: mean position and moment about it. Rounding becomes zero, and on a ring all self-equilibrated components.
   pure subroutine complete_part(model, largest_force, part)
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
   end subroutine complete_part

end module support_reactions
