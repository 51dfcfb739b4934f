!> What statics alone says of a joint: the normal resultant that the loads send through it, where no other support or
!! joint can take a share, and from it the pressure of the first increment, Eq. (9).
module joint_statics
   use deck_errors, only: deck_error_list
   use kinds, only: wp
   use model_data, only: joint_type, model_type, n_bars, n_points, n_sections, stage_load_type
   use section_coupling, only: section_node
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: find_parts, find_determinate_joints, find_first_pressures, carried_resultant

contains

   !> Number the connected bodies (a node without a body is a part of its own). Behind the section of a solid bolt the node of the
   !! section stands for those that it cuts.
   pure subroutine find_parts(model, with_bolts)
      type(model_type), intent(inout) :: model
      logical, intent(in)             :: with_bolts !! whether bolts connect bodies as other bars do
      integer, allocatable :: parent(:)
      integer :: e, first, k, node, root

      allocate (parent(model%n_nodes))
      parent = [(node, node = 1, model%n_nodes)]
      do e = 1, model%n_elements
         first = uncut(e, 1)
         do k = 2, size(model%element_nodes, 1)
            call join(parent, first, uncut(e, k))
         end do
      end do
      do k = 1, n_bars(model)
         if (with_bolts .or. model%bars(k)%bolt == 0) call join(parent, model%bars(k)%nodes(1), model%bars(k)%nodes(2))
      end do
      if (with_bolts) then
         do k = 1, n_sections(model)
            call join(parent, model%sections(k)%node, model%sections(k)%point)
         end do
      end if
      if (allocated(model%part)) deallocate (model%part)
      allocate (model%part(model%n_nodes), source=0)
      model%n_parts = 0
      do node = 1, model%n_nodes
         root = root_of(parent, node)
         if (model%part(root) == 0) then
            model%n_parts = model%n_parts + 1
            model%part(root) = model%n_parts
         end if
         model%part(node) = model%part(root)
      end do

   contains

      !> Corner I of element J, or what stands for it behind a section.
      pure integer function uncut(j, i) result(corner)
         integer, intent(in) :: j, i

         corner = model%element_nodes(i, j)
         if (corner == 0 .or. section_node(model, j) == 0) return
         if (model%node_section(corner) == model%element_section(j)) corner = section_node(model, j)
      end function uncut

   end subroutine find_parts


   !> Joint J is cut: where one of its sides then hangs on nothing along the joint's normal, the joint alone carries that
   !! side's load.
   pure subroutine find_determinate_joints(model)
      type(model_type), intent(inout) :: model
      integer, allocatable :: group(:)              ! parts joined by all the other joints; the base is the last one
      integer, allocatable :: pair(:, :)            ! (3, pairs) two parts and the joint between them, each once
      logical, allocatable :: grounded(:), on_side(:, :), held(:, :)
      integer :: base, i, j, k, node, side

      base = model%n_parts + 1
      allocate (group(base), grounded(base), on_side(base, 2))
      call list_pairs(model, pair)
      allocate (held(model%dimension, model%n_parts), source=.false.)
      do node = 1, n_points(model)
         held(:, model%part(node)) = held(:, model%part(node)) .or. model%held(:, node)
      end do
      do j = 1, size(model%joints)
         associate (joint => model%joints(j))
            if (allocated(joint%carries)) deallocate (joint%carries)
            allocate (joint%carries(model%n_parts), source=.false.)
            joint%determinate = .false.
            if (norm2(joint%normal) <= 0.0_wp) cycle
            if (model%axisymmetric .and. abs(joint%normal(1)) > 1.0e-9_wp) cycle ! hoop stresses carry the rest
            group = [(k, k = 1, base)]
            do i = 1, size(pair, 2)
               if (pair(3, i) /= j) call join(group, pair(1, i), pair(2, i))
            end do
            do i = 1, n_sections(model) ! bolts that are being tightened hold across their axis
               associate (section => model%sections(i))
                  if (abs(dot_product(section%direction, joint%normal)) < 1.0_wp - 1.0e-9_wp) &
                     call join(group, model%part(section%node), model%part(section%point))
               end associate
            end do
            grounded = .false.
            grounded(root_of(group, base)) = .true.
            do k = 1, model%n_parts
               if (any(held(:, k) .and. abs(joint%normal(:model%dimension)) > 1.0e-9_wp)) grounded(root_of(group, k)) = .true.
            end do
            on_side = .false.
            do i = joint%first, joint%last
               do side = 1, 2
                  on_side(root_of(group, part_of(model, i, side)), side) = .true.
               end do
            end do
            if (any(on_side(:, 1) .and. on_side(:, 2))) cycle
            do side = 1, 2
               if (any(on_side(:, side) .and. grounded)) cycle
               joint%determinate = .true.
               joint%direction = merge(1.0_wp, -1.0_wp, side == 1)
               do k = 1, model%n_parts
                  joint%carries(k) = on_side(root_of(group, k), side)
               end do
               exit
            end do
         end associate
      end do
   end subroutine find_determinate_joints


   !> Which parts the joints connect: PAIR(:, i) are two of them, or one and the base behind the last, and the joint. Neighbouring
   !! interface elements mostly connect the same parts: these count once.
   pure subroutine list_pairs(model, pair)
      type(model_type), intent(in)      :: model
      integer, allocatable, intent(out) :: pair(:, :) !! (3, pairs)
      integer, allocatable :: all_pairs(:, :)
      integer :: i, n, this(3)

      allocate (all_pairs(3, size(model%interface)))
      n = 0
      do i = 1, size(model%interface)
         this = [part_of(model, i, 1), part_of(model, i, 2), model%interface(i)%joint]
         if (n > 0) then
            if (all(this == all_pairs(:, n))) cycle
         end if
         n = n + 1
         all_pairs(:, n) = this
      end do
      allocate (pair, source=all_pairs(:, :n))
   end subroutine list_pairs


   !> The part at end SIDE of interface element I; the rigid base is the part behind the last.
   pure integer function part_of(model, i, side)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i, side

      part_of = model%n_parts + 1
      if (model%interface(i)%nodes(side) > 0) part_of = model%part(model%interface(i)%nodes(side))
   end function part_of


   !> Normal resultant (compression positive) that LOADS send through a determinate JOINT [force].
   pure real(wp) function carried_resultant(model, joint, loads) result(resultant)
      type(model_type), intent(in)      :: model
      type(joint_type), intent(in)      :: joint
      type(stage_load_type), intent(in) :: loads
      integer :: i, node

      resultant = 0.0_wp
      do i = 1, loads%n
         node = loads%node(i)
         if (node > n_points(model)) then  ! a pair of forces that shortens a solid bolt
            associate (section => model%sections(node - n_points(model)))
               if (joint%carries(model%part(node))) call add(loads%force(1, i)*section%direction)
               if (joint%carries(model%part(section%point))) call add(-loads%force(1, i)*section%direction)
            end associate
         else if (joint%carries(model%part(node))) then
            call add(loads%force(:, i))
         end if
      end do

   contains

      pure subroutine add(force)
         real(wp), intent(in) :: force(3)

         resultant = resultant + joint%direction*dot_product(force, joint%normal)
      end subroutine add

   end function carried_resultant


   !> p_av of every joint: the user's P0, else the resultant of the first increment (the share FIRST_SHARE of the first
   !! stage's load) over A_int. Where neither gives a compression the deck is in error.
   subroutine find_first_pressures(first_share, model, errors)
      real(wp), intent(in)                 :: first_share
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(stage_load_type) :: loads
      real(wp) :: resultant, total
      integer  :: i, j

      call first_loads(model, loads)
      total = 0.0_wp
      do i = 1, loads%n
         total = total + norm2(loads%force(:, i))
      end do
      do j = 1, size(model%joints)
         associate (joint => model%joints(j))
            resultant = 0.0_wp
            if (joint%determinate) then
               resultant = first_share*carried_resultant(model, joint, loads)
               if (.not. touches_body(model, joint)) then
                  if (opens_first(model, joint, loads)) then
                     call turn_round(model, joint)
                     resultant = -resultant
                  end if
               end if
            end if
            if (joint%p0 > 0.0_wp) then
               joint%law%normal%p_av = joint%p0
            else if (.not. joint%determinate) then
               call errors%add(joint%line, 'joint '//integer_text(joint%id)//' does not carry all the load (supports or '// &
                  'other joints take a share), so the pressure of the first increment is not known: give P0 on its PJOINT')
            else if (resultant <= 1.0e-12_wp*first_share*total) then
               call errors%add(joint%line, 'the first increment does not press joint '//integer_text(joint%id)// &
                  ' together (normal force '//real_text(resultant)//'), so its pressure is not known: give P0 on its PJOINT')
            else
               joint%law%normal%p_av = resultant/joint%area
            end if
         end associate
      end do
   end subroutine find_first_pressures


   !> The load of the first stage with the preloads of the bolts that it tightens.
   pure subroutine first_loads(model, loads)
      type(model_type), intent(in)       :: model
      type(stage_load_type), intent(out) :: loads
      integer :: i, k, n

      n = model%stage_loads(1)%n
      allocate (loads%node(n + 2*n_bars(model) + n_sections(model)))
      allocate (loads%force(3, size(loads%node)))
      loads%node(:n) = model%stage_loads(1)%node(:n)
      loads%force(:, :n) = model%stage_loads(1)%force(:, :n)
      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            if (bar%stage /= 1) cycle
            do k = 1, 2
               n = n + 1
               loads%node(n) = bar%nodes(k)
               loads%force(:, n) = merge(1.0_wp, -1.0_wp, k == 1)*bar%preload*bar%direction
            end do
         end associate
      end do
      do i = 1, n_sections(model)
         if (model%sections(i)%stage /= 1) cycle
         n = n + 1
         loads%node(n) = model%sections(i)%node
         loads%force(:, n) = [model%sections(i)%preload, 0.0_wp, 0.0_wp]
      end do
      loads%n = n
   end subroutine first_loads


   !> Whether the first stage that sends any load through JOINT pulls it open in the sense of its normal.
   pure logical function opens_first(model, joint, loads)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint
      type(stage_load_type), intent(in) :: loads !! of the first stage, with its bolts
      real(wp) :: resultant
      integer  :: s

      opens_first = .false.
      do s = 1, size(model%stage_loads)
         resultant = carried_resultant(model, joint, model%stage_loads(s))
         if (s == 1) resultant = carried_resultant(model, joint, loads)
         if (abs(resultant) <= 0.0_wp) cycle
         opens_first = resultant < 0.0_wp
         return
      end do
   end function opens_first


   !> Whether there is a body at any node of JOINT. If not, nothing but the load tells which sense of its normal closes it.
   pure logical function touches_body(model, joint)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint
      integer :: i, node, side

      touches_body = .false.
      do i = joint%first, joint%last
         do side = 1, 2
            node = model%interface(i)%nodes(side)
            if (node > 0) touches_body = touches_body .or. model%first_at(node + 1) > model%first_at(node)
         end do
      end do
   end function touches_body


   !> Reverse the normals of a joint (and y with them, so that the axes stay right-handed).
   pure subroutine turn_round(model, joint)
      type(model_type), intent(inout) :: model
      type(joint_type), intent(inout) :: joint
      integer :: i

      joint%normal = -joint%normal
      do i = joint%first, joint%last
         model%interface(i)%axes(:, 2:3) = -model%interface(i)%axes(:, 2:3)
      end do
   end subroutine turn_round


   !> Union of the sets of A and B (union-find with path halving); a zero is nothing.
   pure subroutine join(parent, a, b)
      integer, intent(inout) :: parent(:)
      integer, intent(in)    :: a, b
      integer :: i, j

      if (a == 0 .or. b == 0) return
      i = a
      do while (parent(i) /= i)
         parent(i) = parent(parent(i))
         i = parent(i)
      end do
      j = b
      do while (parent(j) /= j)
         parent(j) = parent(parent(j))
         j = parent(j)
      end do
      if (i < j) then
         parent(j) = i
      else
         parent(i) = j
      end if
   end subroutine join


   pure integer function root_of(parent, member) result(root)
      integer, intent(in) :: parent(:), member

      root = member
      do while (parent(root) /= root)
         root = parent(root)
      end do
   end function root_of

end module joint_statics
