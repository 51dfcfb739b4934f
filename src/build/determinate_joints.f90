!> Joints that statics alone can speak of: where no other support or joint can take a share, the loads give the normal resultant.
module determinate_joints
   use disjoint_sets, only: join, root_of
   use id_table, only: distinct
   use interface_operator, only: nodes_of_end
   use kinds, only: wp
   use model_data, only: joint_type, model_type, n_bars, n_points, n_rotations, n_sections, stage_load_type, supported
   use node_coupling, only: is_coupled
   implicit none
   private

   public :: find_determinate_joints, carried_resultant

contains

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
         if (is_coupled(model, [node])) cycle ! its directions are others
         held(:, model%part(node)) = held(:, model%part(node)) .or. supported(model, node)
      end do
      do i = 1, n_bars(model)
         associate (spring => model%bars(i))
            if (spring%nodes(2) > 0) cycle ! else to the ground
            associate (part => model%part(spring%nodes(1)))
               held(:, part) = held(:, part) .or. abs(spring%direction(:model%dimension, 1)) > 1.0e-9_wp
            end associate
         end associate
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
            call ground_turned(model, joint, group, grounded)
            on_side = .false.
            do i = joint%first, joint%last
               do side = 1, 2
                  associate (parts => parts_at(model, i, side))
                     do k = 1, size(parts)
                        on_side(root_of(group, parts(k)), side) = .true.
                     end do
                  end associate
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

   !> Coupled nodes that are held in a direction that is not across the normal of JOINT ground their group too.
   pure subroutine ground_turned(model, joint, group, grounded)
      type(model_type), intent(in)  :: model
      type(joint_type), intent(in)  :: joint
      integer, intent(inout)        :: group(:)
      logical, intent(inout)        :: grounded(:)
      integer :: c, i, k

      if (.not. allocated(model%coupling%of_node)) return
      do i = 1, n_points(model)
         c = model%coupling%of_node(i)
         if (c == 0) cycle
         do k = model%coupling%first(c), model%coupling%first(c + 1) - 1
            if (any(model%held(:, model%coupling%node(k)) .and. &
                    abs(matmul(joint%normal(:model%dimension), model%coupling%t(:, :, k))) > 1.0e-9_wp)) &
               grounded(root_of(group, model%part(i))) = .true.
         end do
      end do
   end subroutine ground_turned

   !> Which parts the joints connect: PAIR(:, i) are two of them, or one and the base behind the last, and the joint. Neighbouring
   !! interface elements mostly connect the same parts: these count once. Where an end lies on several parts, the first of end 1 is
   !! connected with all others.
   pure subroutine list_pairs(model, pair)
      type(model_type), intent(in)      :: model
      integer, allocatable, intent(out) :: pair(:, :) !! (3, pairs)
      integer, allocatable :: longer(:, :)
      integer :: i, k, n, side, this(3)

      allocate (pair(3, size(model%interface)))
      n = 0
      do i = 1, size(model%interface)
         associate (first => parts_at(model, i, 1))
            do side = 1, 2
               associate (parts => parts_at(model, i, side))
                  do k = merge(2, 1, side == 1), size(parts)
                     this = [first(1), parts(k), model%interface(i)%joint]
                     if (n > 0) then
                        if (all(this == pair(:, n))) cycle
                     end if
                     if (n == size(pair, 2)) then
                        allocate (longer(3, 2*n))
                        longer(:, :n) = pair
                        call move_alloc(longer, pair)
                     end if
                     n = n + 1
                     pair(:, n) = this
                  end do
               end associate
            end do
         end associate
      end do
      pair = pair(:, :n)
   end subroutine list_pairs

   !> The parts that end SIDE of interface element I lies on, each once; the rigid base is the part behind the last.
   pure function parts_at(model, i, side) result(parts)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i, side
      integer, allocatable :: parts(:)

      associate (nodes => nodes_of_end(model%interface(i), side))
         if (size(nodes) == 0) then
            parts = [model%n_parts + 1]
         else if (all(model%part(nodes) == model%part(nodes(1)))) then
            parts = [model%part(nodes(1))]
         else
            call distinct(model%part(nodes), parts)
         end if
      end associate
   end function parts_at

   !> Normal resultant (compression positive) that LOADS send through a determinate JOINT [force].
   pure real(wp) function carried_resultant(model, joint, loads) result(resultant)
      type(model_type), intent(in)      :: model
      type(joint_type), intent(in)      :: joint
      type(stage_load_type), intent(in) :: loads
      integer :: i, node

      resultant = 0.0_wp
      do i = 1, loads%n
         node = loads%node(i)
         if (node > n_points(model) + n_rotations(model)) then  ! a pair of forces that shortens a solid bolt
            associate (section => model%sections(node - n_points(model) - n_rotations(model)))
               if (joint%carries(model%part(node))) call add(loads%force(1, i)*section%direction)
               if (joint%carries(model%part(section%point))) call add(-loads%force(1, i)*section%direction)
            end associate
         else if (node <= n_points(model) .and. joint%carries(model%part(node))) then ! behind these moments
            call add(loads%force(:, i))
         end if
      end do

   contains

      pure subroutine add(force)
         real(wp), intent(in) :: force(3)

         resultant = resultant + joint%direction*dot_product(force, joint%normal)
      end subroutine add

   end function carried_resultant

end module determinate_joints
