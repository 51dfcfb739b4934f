!> The pressure of the first increment of each joint, Eq. (9): from the user, from statics, or a guess.
!! The guess is for methods whose result does not depend on it; the iterations are few where it is near.
module first_pressures
   use deck_errors, only: deck_error_list
   use determinate_joints, only: carried_resultant, parts_at
   use kinds, only: wp
   use load_build, only: add_force
   use mesh_queries, only: n_points
   use model_data, only: freedoms_type, history_type, joint_type, joints_type, mesh_type, n_bars, n_sections, &
                         stage_load_type, supported, tightening_type
   use normal_curve, only: loading_pressure
   use text_tools, only: integer_text, real_text
   use tolerances, only: equal_gaps, pressure_of_no_load, zero_cosine, zero_resultant
   implicit none
   private

   public :: find_first_pressures

   real(wp), parameter :: far_above = 0.01_wp ! of P0: a pressure of statics below it
   real(wp), parameter :: same_way = 0.5_wp ! cosine of the normals of two joints that share the load of a body

contains

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
      logical, allocatable :: on_side(:, :, :)
      integer  :: i, j, side

      allocate (on_side(freedoms%n_parts + 1, 2, size(joints%list)), source=.false.)
      do i = 1, size(joints%element)
         do side = 1, 2
            on_side(parts_at(joints, freedoms, i, side), side, joints%element(i)%joint) = .true.
         end do
      end do
      loads = history%stages(1)
      do i = 1, n_bars(mesh)
         associate (bar => mesh%bars(i))
            if (.not. bar%tightening%is_in(1)) cycle
            call add_force(bar%nodes(1), bar%tightening%preload_in(1)*bar%direction(:, 1), loads)
            call add_force(bar%nodes(2), -bar%tightening%preload_in(1)*bar%direction(:, 2), loads)
         end associate
      end do
      do i = 1, n_sections(mesh)
         associate (section => mesh%sections(i))
            if (section%tightening%is_in(1)) &
               call add_force(section%node, [section%tightening%preload_in(1), 0.0_wp, 0.0_wp], loads)
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
               if (guess_will_do) then ! P0 is a first guess: one far above the pressure of statics is not taken
                  first = resting_pressure(mesh, joints, freedoms, loads, on_side, j)
                  if (first > 0.0_wp .and. first < far_above*joint%p0) joint%p_av = first
               end if
            else if (guess_will_do .and. (.not. joint%determinate .or. resultant <= zero_resultant*first_share*total)) then
               joint%p_av = resting_pressure(mesh, joints, freedoms, loads, on_side, j)
               if (joint%p_av <= 0.0_wp) joint%p_av = guessed_pressure(mesh, joints, history, joint)
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

   !> The pressure in joint J with which each of its bodies would rest on it, from the LOADS on that body alone, its bolts cut: their
   !! resultant along the normal over the area of all joints of the body that face the same way. Of both sides the smaller one; a side
   !! that supports hold along the normal does not rest on the joint. Zero where the loads press no side against the joint.
   real(wp) function resting_pressure(mesh, joints, freedoms, loads, on_side, j) result(p)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(freedoms_type), intent(in) :: freedoms
      type(stage_load_type), intent(in) :: loads !! of the first stage, with its bolts
      logical, intent(in) :: on_side(:, :, :)    !! (parts and base, side, joint): which parts the joint touches
      integer, intent(in) :: j
      type(joint_type) :: joint
      real(wp) :: area, resultant, total, sense
      integer  :: k, other, side

      p = 0.0_wp
      joint = joints%list(j)
      if (norm2(joint%normal) <= 0.0_wp) return
      total = sum(norm2(loads%force(:, :loads%n), dim=1))
      do side = 1, 2
         if (on_side(freedoms%n_parts + 1, side, j)) cycle ! the rigid base
         joint%carries = on_side(:freedoms%n_parts, side, j)
         joint%direction = merge(1.0_wp, -1.0_wp, side == 1)
         if (is_held(joint)) cycle
         resultant = carried_resultant(mesh, freedoms, joint, loads)
         if (resultant <= zero_resultant*total) cycle
         area = 0.0_wp
         do k = 1, size(joints%list)
            do other = 1, 2
               sense = joint%direction*merge(1.0_wp, -1.0_wp, other == 1)*dot_product(joint%normal, joints%list(k)%normal)
               if (sense >= same_way .and. any(on_side(:freedoms%n_parts, other, k) .and. joint%carries)) &
                  area = area + joints%list(k)%area
            end do
         end do
         if (p <= 0.0_wp .or. resultant < p*area) p = resultant/area
      end do

   contains

      !> Whether supports hold one of the parts that JOINT carries along its normal.
      pure logical function is_held(joint)
         type(joint_type), intent(in) :: joint
         integer :: node

         is_held = .false.
         do node = 1, n_points(mesh)
            if (.not. joint%carries(freedoms%part(node))) cycle
            is_held = any(supported(mesh, freedoms, node) .and. abs(joint%normal(:mesh%dimension)) > zero_cosine)
            if (is_held) return
         end do
      end function is_held

   end function resting_pressure

   !> The preload of a bolt in its last stage, 0: no bolt [force].
   pure real(wp) function last_preload(tightening)
      type(tightening_type), intent(in) :: tightening

      last_preload = tightening%preload_in(tightening%last_until(huge(1)))
   end function last_preload

   !> A guess of the pressure in JOINT: the largest total load of a stage over the joint area, or the pressure that its law gives
   !! for the largest prescribed displacement or interference; where none of these exists, a small fraction of the modulus of the
   !! bodies.
   pure real(wp) function guessed_pressure(mesh, joints, history, joint) result(p)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(history_type), intent(in) :: history
      type(joint_type), intent(in) :: joint
      real(wp) :: force, moved
      integer  :: i, s

      force = 0.0_wp
      if (n_bars(mesh) > 0) force = force + sum([(last_preload(mesh%bars(i)%tightening), i = 1, n_bars(mesh))])
      if (n_sections(mesh) > 0) force = force + sum([(last_preload(mesh%sections(i)%tightening), i = 1, n_sections(mesh))])
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

end module first_pressures
