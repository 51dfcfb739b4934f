!> The forces that pass between the bodies that bolts clamp: the loads of the bolts.
!!
!! All joints and bolts between two bodies are cut. Where one side then has no support, the force between the bodies is the
!! resultant of the loads of the deck on this side: loads that balance themselves on it, and loads beside it, have no part in it.
!! Where both sides are supported, or connected by other joints or bolts, it is the force of the interface elements less the tensions of the
!! bolts; the shear of the shanks is left out there. What planes of symmetry balance is left out.
module passing_forces
   use analysis_state, only: analysis_type, element_force
   use connected_bodies, only: number_parts
   use interface_operator, only: nodes_of_end
   use kinds, only: wp
   use lists, only: join, root_of
   use mesh_queries, only: n_points, node_kind
   use model_data, only: a_point, model_type, n_bars, supported
   use symmetry_planes, only: cut_type, free_part
   use tolerances, only: parallel_in_mesh
   use unknowns, only: node_axes
   implicit none
   private

   public :: start_passages, cut_passages, forces_between

   !> The pairs of bodies between which interface elements stand. Bodies are parts that neither joints nor bolts connect; a rigid
   !! base is one. Of a body that faces itself each joint is a pair of its own.
   type, public :: passage_type
      integer :: n = 0                       !! number of pairs
      integer, allocatable :: of_element(:)  !! (interface elements) the pair
      integer, allocatable :: sense(:)       !! (interface elements) 1: end 1 is on the first body of the pair; -1: on the second
      type(cut_type), allocatable :: cut(:)  !! (pairs) the planes of symmetry that cut the bodies
      integer, allocatable, private :: part(:)     ! (n_nodes) the body of a node
      integer, allocatable, private :: pairs(:, :) ! (3, pairs) two bodies; the joint of a body that faces itself, else 0
      integer, private :: base = 0           ! number of the body of a rigid base, the last
      integer, allocatable, private :: side(:, :)  ! (bodies, pairs) 1: its loads pass from the first body to the second, -1: from
                                                   ! the second to the first, 0: they do not pass, or statics does not tell
      logical, allocatable, private :: by_statics(:) ! (pairs)
   end type passage_type

contains

   !> The pairs of bodies of MODEL; cut_passages completes them.
   pure subroutine start_passages(model, cuts, passages)
      type(model_type), intent(in)    :: model
      type(cut_type), intent(in)      :: cuts(:) !! (joints) by planes of symmetry
      type(passage_type), intent(out) :: passages
      integer, allocatable :: nodes(:), pairs(:, :)
      integer :: bodies(2), end, i, j, candidate(3)

      call number_parts(model%mesh, model%freedoms, .false., passages%part, passages%base)
      passages%base = passages%base + 1
      allocate (passages%of_element(size(model%joints%element)), passages%sense(size(model%joints%element)), source=1)
      allocate (pairs(3, 0))
      do i = 1, size(model%joints%element)
         do end = 1, 2
            nodes = nodes_of_end(model%joints%element(i), end)
            bodies(end) = passages%base
            if (size(nodes) > 0) bodies(end) = passages%part(nodes(1))
         end do
         if (bodies(1) > bodies(2)) passages%sense(i) = -1
         candidate = [minval(bodies), maxval(bodies), merge(model%joints%element(i)%joint, 0, bodies(1) == bodies(2))]
         do j = size(pairs, 2), 1, -1 ! most elements are of the last pair
            if (all(pairs(:, j) == candidate)) exit
         end do
         if (j == 0) pairs = reshape([pairs, candidate], [3, size(pairs, 2) + 1])
         passages%of_element(i) = merge(j, size(pairs, 2), j > 0)
      end do
      passages%n = size(pairs, 2)
      call move_alloc(pairs, passages%pairs)
      allocate (passages%cut(passages%n))
      do i = 1, size(model%joints%element)
         associate (known => passages%cut(passages%of_element(i)), cut => cuts(model%joints%element(i)%joint))
            if (cut%n > known%n) known = cut
         end associate
      end do
   end subroutine start_passages

   !> Find for each pair the side whose loads alone pass between its bodies.
   pure subroutine cut_passages(model, bar, section, crossing, passages)
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: bar(:), section(:) !! (bolts) positions, 0: none
      integer, intent(in)               :: crossing(:, :)     !! (pairs, bolts) as in forces_between
      type(passage_type), intent(inout) :: passages
      integer :: group(passages%base) ! bodies that the other joints and bolts connect
      logical :: grounded(passages%base)
      integer :: b, i, k, root(2), side

      allocate (passages%side(passages%base, passages%n), source=0)
      allocate (passages%by_statics(passages%n), source=.false.)
      do k = 1, passages%n
         group = [(i, i = 1, passages%base)]
         do i = 1, passages%n
            if (i /= k) call join(group, passages%pairs(1, i), passages%pairs(2, i))
         end do
         do b = 1, size(bar)
            if (crossing(k, b) /= 0) cycle
            if (bar(b) > 0) then
               associate (ends => model%mesh%bars(bar(b))%nodes)
                  call join(group, passages%part(ends(1)), passages%part(ends(2)))
               end associate
            else
               associate (halves => model%mesh%sections(section(b)))
                  call join(group, passages%part(halves%node), passages%part(halves%point))
               end associate
            end if
         end do
         root = [root_of(group, passages%pairs(1, k)), root_of(group, passages%pairs(2, k))]
         if (root(1) == root(2)) cycle
         grounded = grounded_bodies(model, passages, passages%cut(k))
         do side = 1, 2
            if (any([(grounded(i) .and. root_of(group, i) == root(side), i = 1, passages%base)])) cycle
            passages%side(:, k) = [(merge(merge(1, -1, side == 1), 0, root_of(group, i) == root(side)), i = 1, passages%base)]
            passages%by_statics(k) = .true.
            exit
         end do
      end do
   end subroutine cut_passages

   !> Which bodies are supported, but for supports along the normals of the planes of CUT; and the rigid base.
   pure function grounded_bodies(model, passages, cut) result(grounded)
      type(model_type), intent(in)   :: model
      type(passage_type), intent(in) :: passages
      type(cut_type), intent(in)     :: cut
      logical :: grounded(passages%base)
      real(wp) :: axes(3, 3)
      logical  :: held(model%mesh%dimension)
      integer  :: d, i, node

      grounded = .false.
      grounded(passages%base) = .true.
      if (.not. model%freedoms%floats) then
         do node = 1, n_points(model%mesh)
            if (grounded(passages%part(node))) cycle
            held = supported(model%mesh, model%freedoms, node)
            if (.not. any(held)) cycle
            axes = node_axes(model%mesh, node)
            do d = 1, model%mesh%dimension
               if (held(d)) call ground(node, axes(:, d))
            end do
         end do
      end if
      do i = 1, n_bars(model%mesh)
         if (model%mesh%bars(i)%nodes(2) == 0 .and. node_kind(model%mesh, model%mesh%bars(i)%nodes(1)) == a_point) &
            call ground(model%mesh%bars(i)%nodes(1), model%mesh%bars(i)%direction(:, 1))
      end do

   contains

      !> Something holds NODE along DIRECTION.
      pure subroutine ground(node, direction)
         integer, intent(in)  :: node
         real(wp), intent(in) :: direction(3)
         real(wp) :: along(3)

         along = free_part(cut, direction)
         if (model%mesh%axisymmetric) along(1) = 0.0_wp
         if (norm2(along) > parallel_in_mesh) grounded(passages%part(node)) = .true.
      end subroutine ground

   end function grounded_bodies

   !> (3, pairs) The force of the first body of each pair on the second, without what planes of symmetry balance [force].
   pure function forces_between(model, analysis, passages, crossing, direction, tension) result(force)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(passage_type), intent(in)  :: passages
      integer, intent(in)             :: crossing(:, :)  !! (pairs, bolts) 1 where the bolt goes from the first body to the second,
                                                         !! -1 in the other sense, 0: not across this pair
      real(wp), intent(in)            :: direction(:, :) !! (3, bolts) unit
      real(wp), intent(in)            :: tension(:)      !! (bolts) [force]
      real(wp) :: force(3, passages%n)
      integer  :: b, ends(2), i, k

      ends = [model%history%stages(analysis%stage)%from, analysis%stage]
      force = 0.0_wp
      do i = 1, size(model%joints%element)
         k = passages%of_element(i)
         if (.not. passages%by_statics(k)) &
            force(:, k) = force(:, k) + passages%sense(i)*element_force(model%joints%element(i), analysis%states(i))
      end do
      do k = 1, passages%n
         if (passages%by_statics(k)) then
            do i = merge(1, 2, ends(1) > 0), 2
               force(:, k) = force(:, k) + merge(analysis%fraction, 1.0_wp - analysis%fraction, ends(i) == analysis%stage)* &
                             resultant_on(model, passages, k, ends(i))
            end do
         else
            do b = 1, size(tension)
               force(:, k) = force(:, k) - crossing(k, b)*tension(b)*direction(:, b)
            end do
         end if
         if (model%mesh%axisymmetric) force(1, k) = 0.0_wp ! self-equilibrated around the ring
         force(:, k) = free_part(passages%cut(k), force(:, k))
      end do
   end function forces_between

   !> The resultant at the end of STAGE of the loads on the side of pair K, in the sense from its first body to its second, without
   !! preloads [force].
   pure function resultant_on(model, passages, k, stage) result(force)
      type(model_type), intent(in)   :: model
      type(passage_type), intent(in) :: passages
      integer, intent(in)            :: k, stage !! positions
      real(wp) :: force(3)
      integer  :: i

      force = 0.0_wp
      associate (loads => model%history%stages(stage))
         do i = 1, loads%n
            if (node_kind(model%mesh, loads%node(i)) == a_point) &
               force = force + passages%side(passages%part(loads%node(i)), k)*loads%force(:, i)
         end do
      end associate
   end function resultant_on

end module passing_forces
