!> The balance of the external forces after an increment. The reactions at the end of a stage, for each group of supports, and their
!! balance with the loads. The groups are every SPC1
!! card, the SPC cards of a set, every surface of SPCM, PS on GRID, every joint to a rigid base, and the springs to ground.
module support_reactions
   use analysis_state, only: analysis_type, element_force
   use bolt_locking, only: bar_tension
   use interface_operator, only: at_first_end, named_node
   use kinds, only: wp
   use mesh_queries, only: n_points, n_rotations, node_kind, place_in_kind, point_of
   use model_data, only: a_point, a_rotation, model_type, n_bars, supported
   use node_coupling, only: forces_on_unknowns, held_forces
   use numbers, only: cross
   use text_tools, only: above
   use tolerances, only: page_zero, rounding_of_sums, zero_remainder
   use unknowns, only: component_axes
   implicit none
   private

   public :: find_reactions, find_balance

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

   integer, parameter, public :: balance_loads = 1, balance_supports = 2, balance_bases = 3, balance_springs = 4, balance_left = 5

   !> The external forces: loads, supports, rigid bases through the joints, the ground through springs, and their sum, what is left.
   type, public :: balance_type
      real(wp), allocatable :: held(:, :)      !! (dimension, n_nodes) forces of supports on the structure [force]
      integer, allocatable  :: supported(:)    !! the points with supports
      real(wp), allocatable :: force(:, :)     !! (dimension, 5) [force]
      real(wp) :: floors(5) = 0.0_wp           !! smaller forces are rounding
   end type balance_type

contains

   !> The balance of the external forces after an increment, the bodies recovered.
   subroutine find_balance(model, analysis, largest_force, balance)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      real(wp), intent(in)            :: largest_force !! ever applied at a node, for the noise
      type(balance_type), intent(out) :: balance
      real(wp) :: force(3)
      integer  :: i

      allocate (balance%held, source=-held_forces(model, analysis%all_unbalanced))
      balance%supported = pack([(i, i = 1, n_points(model%mesh))], &
                               [(any(supported(model%mesh, model%freedoms, i)) .and. model%freedoms%used(i), i = 1, &
                                  n_points(model%mesh))])
      allocate (balance%force(model%mesh%dimension, balance_left), source=0.0_wp)
      balance%force(:, balance_loads) = sum(analysis%now%load(:, :n_points(model%mesh)), dim=2)
      balance%force(:, balance_supports) = sum(balance%held(:, balance%supported), dim=2)
      do i = 1, size(model%joints%element)
         if (named_node(model%joints%element(i), 2) /= 0) cycle
         force = element_force(model%joints%element(i), analysis%states(i))
         balance%force(:, balance_bases) = balance%force(:, balance_bases) - force(:model%mesh%dimension)
      end do
      do i = 1, n_bars(model%mesh)
         if (model%mesh%bars(i)%nodes(2) > 0 .or. node_kind(model%mesh, model%mesh%bars(i)%nodes(1)) /= a_point) cycle
         balance%force(:, balance_springs) = balance%force(:, balance_springs) + &
                                             bar_tension(model, analysis, i)*model%mesh%bars(i)%direction(:model%mesh%dimension, 1)
      end do
      balance%force(:, balance_left) = sum(balance%force, dim=2)
      balance%floors = page_zero*max(largest_force, tiny(1.0_wp))
      balance%floors(balance_loads) = min(balance%floors(balance_loads), rounding_of_sums*sum(abs(analysis%now%load)))
   end subroutine find_balance

   !> The reactions at the end of the stage just completed, the bodies recovered.
   subroutine find_reactions(model, analysis, largest_force, answer)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      real(wp), intent(in)              :: largest_force !! ever applied at a node, for the noise
      type(reactions_type), intent(out) :: answer
      real(wp), allocatable :: on_unknowns(:, :)
      real(wp) :: force(model%mesh%dimension)
      integer  :: d, g, i, j, last, n, node

      n = size(model%freedoms%support_groups)
      last = n + size(model%joints%list) + 1
      allocate (answer%parts(last))
      answer%parts(:n)%kind = model%freedoms%support_groups%kind
      answer%parts(:n)%id = model%freedoms%support_groups%id
      answer%parts(:n)%line = model%freedoms%support_groups%line
      answer%parts(n + 1:last - 1)%kind = 'BASE'
      answer%parts(n + 1:last - 1)%id = model%joints%list%id
      answer%parts(last)%kind = 'SPRINGS'
      allocate (on_unknowns, source=forces_on_unknowns(model, analysis%all_unbalanced))
      do node = 1, size(model%freedoms%support_of, 2)
         associate (groups => model%freedoms%support_of(:, node))
            do d = 1, model%mesh%dimension
               g = groups(d)
               if (g == 0 .or. any(groups(:d - 1) == g) .or. .not. model%freedoms%used(node)) cycle
               force = -merge(on_unknowns(:, node), 0.0_wp, groups == g)
               force = matmul(component_axes(model%mesh, node), force)
               call act_on(model, node, force, answer%parts(g))
               if (node_kind(model%mesh, node) /= a_rotation) cycle
               if (all(model%freedoms%support_of(:, point_of(model%mesh, node)) /= g)) &
                  call act(answer%parts(g), model%mesh%x(:, node), 0.0_wp*force) ! it holds rotations alone here
            end do
         end associate
      end do
      do i = 1, size(model%joints%element)
         associate (element => model%joints%element(i))
            if (named_node(element, 2) == 0) call act(answer%parts(n + element%joint), at_first_end(element, model%mesh%x), &
                                                      -element_force(element, analysis%states(i)))
         end associate
      end do
      do i = 1, n_bars(model%mesh)
         associate (bar => model%mesh%bars(i), part => answer%parts(last))
            if (bar%nodes(2) > 0) cycle
            if (node_kind(model%mesh, bar%nodes(1)) == a_rotation) &
               call act(part, model%mesh%x(:, bar%nodes(1)), spread(0.0_wp, 1, model%mesh%dimension))
            call act_on(model, bar%nodes(1), bar_tension(model, analysis, i)*bar%direction(:model%mesh%dimension, 1), part)
         end associate
      end do
      answer%parts = pack(answer%parts, answer%parts%nodes > 0)

      ! the loads, and the sum of the reactions
      answer%loads%kind = 'LOADS'
      do node = 1, n_points(model%mesh) + n_rotations(model%mesh)
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
      if (model%mesh%axisymmetric) answer%left(1) = 0.0_wp
      answer%left = above(answer%left, zero_remainder*largest_force)
      call complete_part(model, largest_force, answer%total)
      call complete_part(model, largest_force, answer%loads)
   end subroutine find_reactions

   !> Add FORCE on NODE; on the node of a rotation it is a moment.
   pure subroutine act_on(model, node, force, part)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: node
      real(wp), intent(in)               :: force(:) !! (dimension)
      type(reaction_type), intent(inout) :: part

      if (node_kind(model%mesh, node) /= a_rotation) then
         call act(part, model%mesh%x(:, node), force)
         return
      end if
      associate (arm => model%mesh%rotations(place_in_kind(model%mesh, node))%arm)
         if (model%mesh%dimension == 3) part%moment = part%moment + force*arm
         if (model%mesh%dimension == 2) part%moment(3) = part%moment(3) + force(1)*arm
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
      if (model%mesh%axisymmetric) then
         part%force(1) = 0.0_wp
         part%moment = 0.0_wp
         part%about_centre = 0.0_wp
      end if
      floor = zero_remainder*largest_force
      part%force = above(part%force, floor)
      floor = floor*maxval(abs(model%mesh%x(:, :n_points(model%mesh))))
      part%moment = above(part%moment, floor)
      part%about_centre = above(part%about_centre, floor)
   end subroutine complete_part

end module support_reactions
