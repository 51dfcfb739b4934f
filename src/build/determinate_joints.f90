!> The pressure of the first increment of each joint, Eq. (9): from the user, from statics, or a guess.
!! Statics determines it where no other support or joint takes part of the load. The guess is for methods whose result does not
!! depend on it.
module determinate_joints
   use deck_errors, only: deck_error_list
   use interface_operator, only: nodes_of_end
   use kinds, only: wp
   use lists, only: join, root_of, distinct
   use load_build, only: add_force
   use mesh_queries, only: n_points, node_kind, place_in_kind
   use model_data, only: a_point, an_overlap, freedoms_type, history_type, joint_type, joints_type, mesh_type, n_bars, n_sections, &
                         stage_load_type, supported
   use node_coupling, only: coupling_parts, is_coupled
   use normal_curve, only: loading_pressure
   use text_tools, only: integer_text, real_text
   use tolerances, only: equal_gaps, pressure_of_no_load, same_direction, zero_cosine, zero_resultant
   implicit none
   private

   public :: find_determinate_joints, carried_resultant, find_first_pressures

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

   !> p_av of every joint: P0 of the user, else the resultant of the first increment (FIRST_SHARE of the load of the first stage)
   !! over A_int. Where neither gives a compression the pressure is guessed; where a guess is not allowed, the deck is in error.
   subroutine find_first_pressures(first_share, guess_will_do, mesh, joints, freedoms, history, errors)
      real(wp), intent(in)                 :: first_share
      logical, intent(in)                  :: guess_will_do !! the result of the method does not depend on the guess
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      type(freedoms_type), intent(in) :: freedoms
      type(history_type), intent(in) :: history
      type(deck_error_list), intent(inout) :: errors
      type(stage_load_type) :: loads ! of the first stage, with the preloads of the bolts that this stage tightens
      real(wp) :: area, first, last, resultant, total
      integer  :: i, j

      loads = history%stages(1)
      do i = 1, n_bars(mesh)
         associate (bar => mesh%bars(i))
            if (bar%stage /= 1) cycle
            call add_force(bar%nodes(1), bar%preload*bar%direction(:, 1), loads)
            call add_force(bar%nodes(2), -bar%preload*bar%direction(:, 2), loads)
         end associate
      end do
      do i = 1, n_sections(mesh)
         associate (section => mesh%sections(i))
            if (section%stage == 1) call add_force(section%node, [section%preload, 0.0_wp, 0.0_wp], loads)
         end associate
      end do
      total = sum(norm2(loads%force(:, :loads%n), dim=1))
      do j = 1, size(joints%list)
         if (joints%list(j)%determinate) call orient_by_load(mesh, joints, freedoms, history, loads, j)
         associate (joint => joints%list(j))
            resultant = 0.0_wp
            if (joint%determinate) resultant = first_share*carried_resultant(mesh, freedoms, joint, loads)
            if (joint%p0 > 0.0_wp) then
               joint%p_av = joint%p0
            else if (guess_will_do .and. (.not. joint%determinate .or. resultant <= zero_resultant*first_share*total)) then
               joint%p_av = guessed_pressure(mesh, joints, history, joint)
            else if (.not. joint%determinate) then
               call errors%add(joint%line, 'joint '//integer_text(joint%id)//' does not carry all the load (supports or '// &
                  'other joints take a share), so the pressure of the first increment is not known: give P0 on its PJOINT')
            else if (resultant <= zero_resultant*first_share*total) then
               call errors%add(joint%line, 'the first increment does not press joint '//integer_text(joint%id)// &
                  ' (normal force '//real_text(resultant)//'), so its pressure is not known: give P0 on its PJOINT')
            else ! over A_int; with gaps, over the area that is closed at first; where none is, over the area that closes first
               associate (elements => joints%element(joint%first:joint%last))
                  area = joint%area
                  first = minval(elements%gap)
                  last = maxval(elements%gap)
                  if (last > max(0.0_wp, first)) &
                     area = sum(elements%area, mask=elements%gap <= max(0.0_wp, first) + equal_gaps*(last - first))
               end associate
               joint%p_av = resultant/area
            end if
         end associate
      end do
   end subroutine find_first_pressures

   !> Reverse the normals of joint J, and the y axes, so that the axes stay right-handed, where the first stage that loads the joint
   !! opens it and none of its nodes belongs to a body: then only the load shows which sense of the normal closes the joint.
   pure subroutine orient_by_load(mesh, joints, freedoms, history, first_loads, j)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      type(freedoms_type), intent(in) :: freedoms
      type(history_type), intent(in) :: history
      type(stage_load_type), intent(in) :: first_loads !! of the first stage, with its bolts
      integer, intent(in)               :: j
      real(wp) :: resultant
      integer  :: i, s

      associate (joint => joints%list(j))
         resultant = carried_resultant(mesh, freedoms, joint, first_loads)
         do s = 2, size(history%stages)
            if (abs(resultant) > 0.0_wp) exit
            resultant = carried_resultant(mesh, freedoms, joint, history%stages(s))
         end do
         if (.not. resultant < 0.0_wp) return
         do i = joint%first, joint%last
            associate (nodes => joints%element(i)%node)
               if (any(mesh%first_at(nodes + 1) > mesh%first_at(nodes))) return
            end associate
         end do
         joint%normal = -joint%normal
         do i = joint%first, joint%last
            associate (element => joints%element(i))
               element%axes(:, 2:3) = -element%axes(:, 2:3)
               if (joint%gap_kind == 'TRUE') element%gap = -element%gap ! a distance along the normal
            end associate
         end do
      end associate
   end subroutine orient_by_load

   !> A guess of the pressure in JOINT: the largest total load of a stage over the joint area, or the pressure that its law gives
   !! for the largest prescribed displacement or interference; where none of these exists, a small fraction of the modulus of the
   !! bodies.
   pure real(wp) function guessed_pressure(mesh, joints, history, joint) result(p)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(history_type), intent(in) :: history
      type(joint_type), intent(in) :: joint
      real(wp) :: force, moved
      integer  :: s

      force = 0.0_wp
      if (n_bars(mesh) > 0) force = force + sum(abs(mesh%bars%preload))
      if (n_sections(mesh) > 0) force = force + sum(abs(mesh%sections%preload))
      moved = max(0.0_wp, -minval(joints%element(joint%first:joint%last)%gap))
      do s = 1, size(history%stages)
         associate (loads => history%stages(s))
            force = max(force, sum(norm2(loads%force(:, :loads%n), dim=1)))
            if (allocated(loads%moved)) moved = max(moved, maxval(abs(loads%moved)))
         end associate
      end do
      p = force/joint%area
      if (p <= 0.0_wp) p = loading_pressure(joint%law%normal, moved)
      if (p <= 0.0_wp) p = pressure_of_no_load*maxval(mesh%properties%e)
      if (p <= 0.0_wp) p = 1.0_wp ! nothing indicates the units
   end function guessed_pressure

end module determinate_joints
