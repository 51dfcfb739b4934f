!> The joints whose normal resultant statics alone determines, because no other support or joint takes part of the load, and that
!! resultant.
module determinate_joints
   use interface_operator, only: nodes_of_end
   use kinds, only: wp
   use lists, only: join, root_of, distinct
   use mesh_queries, only: n_points, node_kind, place_in_kind
   use model_data, only: a_point, an_overlap, freedoms_type, joint_type, joints_type, mesh_type, n_bars, n_sections, &
                         stage_load_type, supported
   use node_coupling, only: coupling_parts, is_coupled
   use tolerances, only: same_direction, zero_cosine
   implicit none
   private

   public :: find_determinate_joints, carried_resultant, parts_at

contains

   !> Cut joint J. Where one of its sides then has no support along the normal of the joint, the joint alone carries the load of
   !! this side.
   pure subroutine find_determinate_joints(mesh, joints, freedoms)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      type(freedoms_type), intent(inout) :: freedoms
      integer, allocatable :: group(:)              ! parts connected by all other joints; the base is the last one
      integer, allocatable :: pair(:, :)            ! (4, pairs) of list_pairs
      logical, allocatable :: grounded(:), on_side(:, :), held(:, :)
      integer :: base, i, j, k, node, side

      base = freedoms%n_parts + 1
      allocate (group(base), grounded(base), on_side(base, 2))
      call list_pairs(joints, freedoms, pair)
      ! the components of parts that supports and grounded springs hold
      allocate (held(mesh%dimension, freedoms%n_parts), source=.false.)
      do node = 1, n_points(mesh)
         if (is_coupled(freedoms, [node])) cycle ! its unknowns have other directions: see below
         held(:, freedoms%part(node)) = held(:, freedoms%part(node)) .or. supported(mesh, freedoms, node)
      end do
      do i = 1, n_bars(mesh)
         associate (spring => mesh%bars(i))
            if (spring%nodes(2) > 0) cycle ! else to the ground
            associate (part => freedoms%part(spring%nodes(1)))
               held(:, part) = held(:, part) .or. abs(spring%direction(:mesh%dimension, 1)) > zero_cosine
            end associate
         end associate
      end do
      do j = 1, size(joints%list)
         associate (joint => joints%list(j))
            joint%carries = spread(.false., 1, freedoms%n_parts)
            joint%determinate = .false.
            if (norm2(joint%normal) <= 0.0_wp) cycle
            if (mesh%axisymmetric .and. abs(joint%normal(1)) > zero_cosine) cycle ! hoop stresses carry the rest
            ! cut the joint: groups of parts that all other joints connect, and groups that are held along the normal
            group = [(k, k = 1, base)]
            do i = 1, size(pair, 2)
               if (pair(3, i) /= j) call join(group, pair(1, i), pair(2, i))
            end do
            do i = 1, n_sections(mesh) ! bolts that are being tightened hold normal to their axis
               associate (section => mesh%sections(i))
                  if (abs(dot_product(section%direction, joint%normal)) < 1.0_wp - same_direction) &
                     call join(group, freedoms%part(section%node), freedoms%part(section%point))
               end associate
            end do
            grounded = .false.
            grounded(root_of(group, base)) = .true.
            do k = 1, freedoms%n_parts
               if (any(held(:, k) .and. abs(joint%normal(:mesh%dimension)) > zero_cosine)) grounded(root_of(group, k)) = .true.
            end do
            do i = 1, n_points(mesh) ! coupled nodes: held in a direction that is not perpendicular to the normal
               associate (parts => coupling_parts(freedoms, i))
                  do k = parts(1), parts(2)
                     if (any(freedoms%held(:, freedoms%coupling%node(k)) .and. &
                             abs(matmul(joint%normal(:mesh%dimension), freedoms%coupling%t(:, :, k))) > zero_cosine)) &
                        grounded(root_of(group, freedoms%part(i))) = .true.
                  end do
               end associate
            end do
            ! the groups on each side of the joint; where none of them is held, the joint carries their load
            on_side = .false.
            do i = 1, size(pair, 2)
               if (pair(3, i) == j) on_side(root_of(group, pair(2, i)), pair(4, i)) = .true.
            end do
            if (any(on_side(:, 1) .and. on_side(:, 2))) cycle
            do side = 1, 2
               if (any(on_side(:, side) .and. grounded)) cycle
               joint%determinate = .true.
               joint%direction = merge(1.0_wp, -1.0_wp, side == 1)
               joint%carries = [(on_side(root_of(group, k), side), k = 1, freedoms%n_parts)]
               exit
            end do
         end associate
      end do
   end subroutine find_determinate_joints

   !> The parts that joints connect: PAIR(:, i) are two parts, or one part and the base (the last number), the joint, and the end on
   !! which the second part lies. The first part of end 1 is connected to itself and to all others. Most neighbouring interface
   !! elements connect the same parts; such a pair is listed once.
   pure subroutine list_pairs(joints, freedoms, pair)
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(in) :: freedoms
      integer, allocatable, intent(out) :: pair(:, :) !! (4, pairs)
      integer :: i, k, n, side, candidate(4)

      allocate (pair(4, 2*size(joints%element)), source=0)
      n = 0
      do side = 1, 2
         do i = 1, size(joints%element)
            associate (first => parts_at(joints, freedoms, i, 1), parts => parts_at(joints, freedoms, i, side))
               do k = 1, size(parts)
                  candidate = [first(1), parts(k), joints%element(i)%joint, side]
                  if (n > 0) then
                     if (all(candidate == pair(:, n))) cycle
                  end if
                  if (n == size(pair, 2)) pair = reshape([pair, pair], [4, 2*n])
                  n = n + 1
                  pair(:, n) = candidate
               end do
            end associate
         end do
      end do
      pair = pair(:, :n)
   end subroutine list_pairs

   !> The parts of end SIDE of interface element I, each once; the rigid base has the number behind the last part.
   pure function parts_at(joints, freedoms, i, side) result(parts)
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)          :: i, side
      integer, allocatable :: parts(:)

      associate (nodes => nodes_of_end(joints%element(i), side))
         if (size(nodes) == 0) then
            parts = [freedoms%n_parts + 1]
         else if (all(freedoms%part(nodes) == freedoms%part(nodes(1)))) then
            parts = [freedoms%part(nodes(1))]
         else
            call distinct(freedoms%part(nodes), parts)
         end if
      end associate
   end function parts_at

   !> Normal resultant of LOADS through a determinate JOINT, compression positive [force].
   pure real(wp) function carried_resultant(mesh, freedoms, joint, loads) result(resultant)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(joint_type), intent(in)      :: joint
      type(stage_load_type), intent(in) :: loads
      integer :: i, node

      resultant = 0.0_wp
      do i = 1, loads%n
         node = loads%node(i)
         if (node_kind(mesh, node) == an_overlap) then ! the pair of forces of a pretension section
            associate (section => mesh%sections(place_in_kind(mesh, node)))
               if (joint%carries(freedoms%part(node))) resultant = resultant + normal_part(loads%force(1, i)*section%direction)
               if (joint%carries(freedoms%part(section%point))) &
                  resultant = resultant - normal_part(loads%force(1, i)*section%direction)
            end associate
         else if (node_kind(mesh, node) == a_point .and. joint%carries(freedoms%part(node))) then ! other nodes have moments
            resultant = resultant + normal_part(loads%force(:, i))
         end if
      end do

   contains

      !> The part of FORCE along the normal of the joint, compression positive.
      pure real(wp) function normal_part(force)
         real(wp), intent(in) :: force(3)

         normal_part = joint%direction*dot_product(force, joint%normal)
      end function normal_part

   end function carried_resultant

end module determinate_joints
