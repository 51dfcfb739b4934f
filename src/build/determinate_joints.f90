!> The pressure of the first increment of each joint, Eq. (9): from the user, from statics, or a guess.
!! Statics determines it where no other support or joint takes part of the load. The guess is for methods whose result does not
!! depend on it.
module determinate_joints
   use deck_errors, only: deck_error_list
   use interface_operator, only: nodes_of_end
   use kinds, only: wp
   use lists, only: join, root_of, distinct
   use load_build, only: add_force
   use model_data, only: a_point, an_overlap, joint_type, model_type, n_bars, n_points, n_sections, node_kind, place_in_kind, &
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
   pure subroutine find_determinate_joints(model)
      type(model_type), intent(inout) :: model
      integer, allocatable :: group(:)              ! parts connected by all other joints; the base is the last one
      integer, allocatable :: pair(:, :)            ! (4, pairs) of list_pairs
      logical, allocatable :: grounded(:), on_side(:, :), held(:, :)
      integer :: base, i, j, k, node, side

      base = model%freedoms%n_parts + 1
      allocate (group(base), grounded(base), on_side(base, 2))
      call list_pairs(model, pair)
      ! the components of parts that supports and grounded springs hold
      allocate (held(model%mesh%dimension, model%freedoms%n_parts), source=.false.)
      do node = 1, n_points(model)
         if (is_coupled(model, [node])) cycle ! its unknowns have other directions: see below
         held(:, model%freedoms%part(node)) = held(:, model%freedoms%part(node)) .or. supported(model, node)
      end do
      do i = 1, n_bars(model)
         associate (spring => model%mesh%bars(i))
            if (spring%nodes(2) > 0) cycle ! else to the ground
            associate (part => model%freedoms%part(spring%nodes(1)))
               held(:, part) = held(:, part) .or. abs(spring%direction(:model%mesh%dimension, 1)) > zero_cosine
            end associate
         end associate
      end do
      do j = 1, size(model%joints%list)
         associate (joint => model%joints%list(j))
            joint%carries = spread(.false., 1, model%freedoms%n_parts)
            joint%determinate = .false.
            if (norm2(joint%normal) <= 0.0_wp) cycle
            if (model%mesh%axisymmetric .and. abs(joint%normal(1)) > zero_cosine) cycle ! hoop stresses carry the rest
            ! cut the joint: groups of parts that all other joints connect, and groups that are held along the normal
            group = [(k, k = 1, base)]
            do i = 1, size(pair, 2)
               if (pair(3, i) /= j) call join(group, pair(1, i), pair(2, i))
            end do
            do i = 1, n_sections(model) ! bolts that are being tightened hold normal to their axis
               associate (section => model%mesh%sections(i))
                  if (abs(dot_product(section%direction, joint%normal)) < 1.0_wp - same_direction) &
                     call join(group, model%freedoms%part(section%node), model%freedoms%part(section%point))
               end associate
            end do
            grounded = .false.
            grounded(root_of(group, base)) = .true.
            do k = 1, model%freedoms%n_parts
               if (any(held(:, k) .and. abs(joint%normal(:model%mesh%dimension)) > zero_cosine)) grounded(root_of(group, k)) = &
                  .true.
            end do
            do i = 1, n_points(model) ! coupled nodes: held in a direction that is not perpendicular to the normal
               associate (parts => coupling_parts(model, i))
                  do k = parts(1), parts(2)
                     if (any(model%freedoms%held(:, model%freedoms%coupling%node(k)) .and. &
                             abs(matmul(joint%normal(:model%mesh%dimension), model%freedoms%coupling%t(:, :, k))) > zero_cosine)) &
                        grounded(root_of(group, model%freedoms%part(i))) = .true.
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
               joint%carries = [(on_side(root_of(group, k), side), k = 1, model%freedoms%n_parts)]
               exit
            end do
         end associate
      end do
   end subroutine find_determinate_joints

   !> The parts that joints connect: PAIR(:, i) are two parts, or one part and the base (the last number), the joint, and the end on
   !! which the second part lies. The first part of end 1 is connected to itself and to all others. Most neighbouring interface
   !! elements connect the same parts; such a pair is listed once.
   pure subroutine list_pairs(model, pair)
      type(model_type), intent(in)      :: model
      integer, allocatable, intent(out) :: pair(:, :) !! (4, pairs)
      integer :: i, k, n, side, candidate(4)

      allocate (pair(4, 2*size(model%joints%element)), source=0)
      n = 0
      do side = 1, 2
         do i = 1, size(model%joints%element)
            associate (first => parts_at(model, i, 1), parts => parts_at(model, i, side))
               do k = 1, size(parts)
                  candidate = [first(1), parts(k), model%joints%element(i)%joint, side]
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
   pure function parts_at(model, i, side) result(parts)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i, side
      integer, allocatable :: parts(:)

      associate (nodes => nodes_of_end(model%joints%element(i), side))
         if (size(nodes) == 0) then
            parts = [model%freedoms%n_parts + 1]
         else if (all(model%freedoms%part(nodes) == model%freedoms%part(nodes(1)))) then
            parts = [model%freedoms%part(nodes(1))]
         else
            call distinct(model%freedoms%part(nodes), parts)
         end if
      end associate
   end function parts_at

   !> Normal resultant of LOADS through a determinate JOINT, compression positive [force].
   pure real(wp) function carried_resultant(model, joint, loads) result(resultant)
      type(model_type), intent(in)      :: model
      type(joint_type), intent(in)      :: joint
      type(stage_load_type), intent(in) :: loads
      integer :: i, node

      resultant = 0.0_wp
      do i = 1, loads%n
         node = loads%node(i)
         if (node_kind(model, node) == an_overlap) then ! the pair of forces of a pretension section
            associate (section => model%mesh%sections(place_in_kind(model, node)))
               if (joint%carries(model%freedoms%part(node))) resultant = resultant + normal_part(loads%force(1, &
                  i)*section%direction)
               if (joint%carries(model%freedoms%part(section%point))) &
                  resultant = resultant - normal_part(loads%force(1, i)*section%direction)
            end associate
         else if (node_kind(model, node) == a_point .and. joint%carries(model%freedoms%part(node))) then ! other nodes have moments
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
   subroutine find_first_pressures(first_share, guess_will_do, model, errors)
      real(wp), intent(in)                 :: first_share
      logical, intent(in)                  :: guess_will_do !! the result of the method does not depend on the guess
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(stage_load_type) :: loads ! of the first stage, with the preloads of the bolts that this stage tightens
      real(wp) :: area, first, last, resultant, total
      integer  :: i, j

      loads = model%history%stages(1)
      do i = 1, n_bars(model)
         associate (bar => model%mesh%bars(i))
            if (bar%stage /= 1) cycle
            call add_force(bar%nodes(1), bar%preload*bar%direction(:, 1), loads)
            call add_force(bar%nodes(2), -bar%preload*bar%direction(:, 2), loads)
         end associate
      end do
      do i = 1, n_sections(model)
         associate (section => model%mesh%sections(i))
            if (section%stage == 1) call add_force(section%node, [section%preload, 0.0_wp, 0.0_wp], loads)
         end associate
      end do
      total = sum(norm2(loads%force(:, :loads%n), dim=1))
      do j = 1, size(model%joints%list)
         if (model%joints%list(j)%determinate) call orient_by_load(model, loads, j)
         associate (joint => model%joints%list(j))
            resultant = 0.0_wp
            if (joint%determinate) resultant = first_share*carried_resultant(model, joint, loads)
            if (joint%p0 > 0.0_wp) then
               joint%p_av = joint%p0
            else if (guess_will_do .and. (.not. joint%determinate .or. resultant <= zero_resultant*first_share*total)) then
               joint%p_av = guessed_pressure(model, joint)
            else if (.not. joint%determinate) then
               call errors%add(joint%line, 'joint '//integer_text(joint%id)//' does not carry all the load (supports or '// &
                  'other joints take a share), so the pressure of the first increment is not known: give P0 on its PJOINT')
            else if (resultant <= zero_resultant*first_share*total) then
               call errors%add(joint%line, 'the first increment does not press joint '//integer_text(joint%id)// &
                  ' (normal force '//real_text(resultant)//'), so its pressure is not known: give P0 on its PJOINT')
            else ! over A_int; with gaps, over the area that is closed at first; where none is, over the area that closes first
               associate (elements => model%joints%element(joint%first:joint%last))
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
   pure subroutine orient_by_load(model, first_loads, j)
      type(model_type), intent(inout)   :: model
      type(stage_load_type), intent(in) :: first_loads !! of the first stage, with its bolts
      integer, intent(in)               :: j
      real(wp) :: resultant
      integer  :: i, s

      associate (joint => model%joints%list(j))
         resultant = carried_resultant(model, joint, first_loads)
         do s = 2, size(model%history%stages)
            if (abs(resultant) > 0.0_wp) exit
            resultant = carried_resultant(model, joint, model%history%stages(s))
         end do
         if (.not. resultant < 0.0_wp) return
         do i = joint%first, joint%last
            associate (nodes => model%joints%element(i)%node)
               if (any(model%mesh%first_at(nodes + 1) > model%mesh%first_at(nodes))) return
            end associate
         end do
         joint%normal = -joint%normal
         do i = joint%first, joint%last
            associate (element => model%joints%element(i))
               element%axes(:, 2:3) = -element%axes(:, 2:3)
               if (joint%gap_kind == 'TRUE') element%gap = -element%gap ! a distance along the normal
            end associate
         end do
      end associate
   end subroutine orient_by_load

   !> A guess of the pressure in JOINT: the largest total load of a stage over the joint area, or the pressure that its law gives
   !! for the largest prescribed displacement or interference; where none of these exists, a small fraction of the modulus of the
   !! bodies.
   pure real(wp) function guessed_pressure(model, joint) result(p)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint
      real(wp) :: force, moved
      integer  :: s

      force = 0.0_wp
      if (n_bars(model) > 0) force = force + sum(abs(model%mesh%bars%preload))
      if (n_sections(model) > 0) force = force + sum(abs(model%mesh%sections%preload))
      moved = max(0.0_wp, -minval(model%joints%element(joint%first:joint%last)%gap))
      do s = 1, size(model%history%stages)
         associate (loads => model%history%stages(s))
            force = max(force, sum(norm2(loads%force(:, :loads%n), dim=1)))
            if (allocated(loads%moved)) moved = max(moved, maxval(abs(loads%moved)))
         end associate
      end do
      p = force/joint%area
      if (p <= 0.0_wp) p = loading_pressure(joint%law%normal, moved)
      if (p <= 0.0_wp) p = pressure_of_no_load*maxval(model%mesh%properties%e)
      if (p <= 0.0_wp) p = 1.0_wp ! nothing indicates the units
   end function guessed_pressure

end module determinate_joints
