!> Interface elements: between two facing surfaces, between a surface and a rigid base, or given outright.
module joint_build
   use case_control, only: pressure_eq10
   use deck_cards, only: add_field_error
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type
   use id_table, only: id_table_type
   use kinds, only: wp
   use model_data, only: corners_of, interface_element, joint_type, model_type
   use normal_stiffness, only: normal_law
   use position_search, only: position_search_type
   use surface_build, only: surface_node_list, surface_nodes
   use text_tools, only: integer_text, plural, real_text
   implicit none
   private

   public :: build_joints

   real(wp), parameter :: default_tolerance = 1.0e-3_wp ! of the shortest edge of SIDE1
   real(wp), parameter :: facing = -0.5_wp              ! cosine of the normals of two sides that face each other, at most

contains

   !> Fill the joints and interface elements of MODEL.
   subroutine build_joints(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(interface_element), allocatable :: elements(:)
      integer :: j, n_groups, highest

      n_groups = count_groups(deck)
      allocate (model%joints(deck%bulk%n_joint + n_groups), model%interface(0))
      highest = 0
      if (deck%bulk%n_cjoint > 0) highest = maxval(deck%bulk%cjoint%id)
      do j = 1, deck%bulk%n_joint
         call joint_elements(deck, j, model, highest, elements, errors)
         call add_elements(model, j, deck%bulk%joint(j)%id, deck%bulk%joint(j)%line, elements)
         call resolve_laws(deck, deck%bulk%joint(j)%law, model%joints(j), errors)
      end do
      call group_cjoints(deck, model, errors)
      do j = 1, size(model%joints)
         call sum_joint(model, model%joints(j))
         call default_slope(model, model%joints(j), errors)
      end do
   end subroutine build_joints


   !> Put the interface elements of joint J at the end of the model's.
   subroutine add_elements(model, j, id, line, elements)
      type(model_type), intent(inout)         :: model
      integer, intent(in)                     :: j, id, line
      type(interface_element), intent(inout)  :: elements(:)
      type(interface_element), allocatable    :: longer(:)
      integer :: n

      n = size(model%interface)
      model%joints(j)%id = id
      model%joints(j)%line = line
      model%joints(j)%first = n + 1
      model%joints(j)%last = n + size(elements)
      elements%joint = j
      allocate (longer(n + size(elements)))
      longer(:n) = model%interface
      longer(n + 1:) = elements
      call move_alloc(longer, model%interface)
   end subroutine add_elements


   !> Interface elements of JOINT card J, numbered from HIGHEST + 1.
   subroutine joint_elements(deck, j, model, highest, elements, errors)
      type(deck_type), intent(in)          :: deck
      integer, intent(in)                  :: j
      type(model_type), intent(in)         :: model
      integer, intent(inout)               :: highest
      type(interface_element), allocatable, intent(out) :: elements(:)
      type(deck_error_list), intent(inout) :: errors
      type(surface_node_list) :: side1, side2
      integer, allocatable :: partner(:)
      integer :: surface(2), k

      allocate (elements(0))
      associate (card => deck%bulk%joint(j))
         surface = 0
         do k = 1, 2
            if (card%sides(k) == 0) cycle
            surface(k) = findloc(model%surfaces%id, card%sides(k), dim=1)
            if (surface(k) == 0) call add_field_error(deck%text, card%line, k + 2, 'SIDE'//integer_text(k), &
               'there is no PMARK '//integer_text(card%sides(k)), errors)
         end do
         do k = 1, j - 1
            if (any(deck%bulk%joint(k)%sides == card%sides(1)) .or. (card%sides(2) > 0 .and. &
                any(deck%bulk%joint(k)%sides == card%sides(2)))) call add_field_error(deck%text, card%line, 3, 'SIDE1', &
               'one of the sides is a side of JOINT '//integer_text(deck%bulk%joint(k)%id)//' already', errors)
         end do
         if (surface(1) == 0 .or. (surface(2) == 0 .and. card%sides(2) > 0)) return
         if (model%surfaces(surface(1))%n == 0) return
         if (surface(2) > 0) then
            if (model%surfaces(surface(2))%n == 0) return
            if (any(model%surfaces(surface(2))%other(:model%surfaces(surface(2))%n) > 0)) then
               call add_field_error(deck%text, card%line, 4, 'SIDE2', 'bodies lie on both sides of surface '// &
                  integer_text(card%sides(2)), errors)
               return
            end if
         end if
         if (surface(2) > 0 .and. any(model%surfaces(surface(1))%other(:model%surfaces(surface(1))%n) > 0)) then
            call add_field_error(deck%text, card%line, 3, 'SIDE1', 'bodies lie on both sides of surface '// &
               integer_text(card%sides(1))//': leave SIDE2 blank, and the program splits it', errors)
            return
         end if
         call surface_nodes(model, model%surfaces(surface(1)), side1)
         allocate (partner(side1%n), source=0)
         if (surface(2) > 0) then
            call surface_nodes(model, model%surfaces(surface(2)), side2)
            call pair_nodes(deck, j, model, surface(1), side1, side2, partner, errors)
         else if (any(model%twin(side1%node) > 0)) then
            call drop_tips(model, side1)
            partner = model%twin(side1%node)
         end if
      end associate
      if (model%axisymmetric .and. any(side1%area <= 0.0_wp)) then
         call errors%add(deck%bulk%joint(j)%line, 'surface '//integer_text(deck%bulk%joint(j)%sides(1))// &
            ' has no area at node '//integer_text(model%node_id(side1%node(minloc(side1%area, dim=1))))//': it lies on the axis')
         return
      end if
      if (highest > huge(highest) - side1%n) then
         call add_field_error(deck%text, deck%bulk%joint(j)%line, 1, 'JID', 'the numbers of its interface '// &
            'elements, which follow those of the CJOINTs, would pass 2147483647', errors)
         return
      end if
      deallocate (elements)
      allocate (elements(side1%n))
      do k = 1, side1%n
         elements(k)%id = highest + k
         elements(k)%nodes = [side1%node(k), partner(k)]
         elements(k)%area = side1%area(k)
         elements(k)%axes = joint_axes(model, side1%normal(:, k))
      end do
      highest = highest + side1%n
   end subroutine joint_elements


   !> Leave out the nodes at which a split surface ends inside a body.
   pure subroutine drop_tips(model, side)
      type(model_type), intent(in)           :: model
      type(surface_node_list), intent(inout) :: side
      integer :: k, n

      n = 0
      do k = 1, side%n
         if (model%twin(side%node(k)) == 0) cycle
         n = n + 1
         side%node(n) = side%node(k)
         side%area(n) = side%area(k)
         side%normal(:, n) = side%normal(:, k)
      end do
      side%n = n
      side%node = side%node(:n)
      side%area = side%area(:n)
      side%normal = side%normal(:, :n)
   end subroutine drop_tips


   !> For every node of side 1 the node of side 2 at the same place.
   subroutine pair_nodes(deck, j, model, surface, side1, side2, partner, errors)
      type(deck_type), intent(in)          :: deck
      integer, intent(in)                  :: j, surface
      type(model_type), intent(in)         :: model
      type(surface_node_list), intent(in)  :: side1, side2
      integer, intent(inout)               :: partner(:)
      type(deck_error_list), intent(inout) :: errors
      type(position_search_type) :: search
      real(wp) :: tolerance, distance, shortest, worst
      integer  :: k, found, lonely, shared, turned, worst_node, e
      logical, allocatable :: taken(:)

      associate (card => deck%bulk%joint(j), edges => model%surfaces(surface))
         shortest = huge(1.0_wp)
         do e = 1, edges%n
            do k = 1, edges%corners(e)
               shortest = min(shortest, norm2(model%x(:, edges%nodes(modulo(k, edges%corners(e)) + 1, e)) &
                                              - model%x(:, edges%nodes(k, e))))
            end do
         end do
         tolerance = card%tolerance
         if (tolerance <= 0.0_wp) tolerance = default_tolerance*shortest
         call search%build(model%x(:, side2%node))
         allocate (taken(side2%n), source=.false.)
         lonely = 0; turned = 0; shared = 0; worst = 0.0_wp; worst_node = 0
         do k = 1, side1%n
            call search%nearest(model%x(:, side1%node(k)), tolerance, found, distance)
            if (found == 0) then
               lonely = lonely + 1
               call search%nearest(model%x(:, side1%node(k)), huge(1.0_wp), found, distance)
               if (distance > worst) then
                  worst = distance
                  worst_node = side1%node(k)
               end if
            else
               partner(k) = side2%node(found)
               if (taken(found)) shared = shared + 1
               taken(found) = .true.
               if (dot_product(side1%normal(:, k), side2%normal(:, found)) > facing) turned = turned + 1
            end if
         end do
         if (lonely > 0) then
            call add_field_error(deck%text, card%line, 4, 'SIDE2', 'the sides do not face each other node by node: '// &
               plural(lonely, 'node')//' of '//integer_text(side1%n)//' of SIDE1 found no partner within '// &
               real_text(tolerance)//'; the farthest is node '//integer_text(model%node_id(worst_node))//' at '// &
               place_text(model, worst_node)//', '//real_text(worst)//' away', errors)
         else if (shared > 0) then
            call add_field_error(deck%text, card%line, merge(5, 4, card%tolerance > 0.0_wp), 'TOL', 'within '// &
               real_text(tolerance)//' '//plural(shared, 'node')//' of SIDE1 found a partner that another one has', errors)
         else if (turned > 0) then
            call add_field_error(deck%text, card%line, 4, 'SIDE2', 'the sides do not face each other: at '// &
               plural(turned, 'node')//' their normals do not point against each other', errors)
         else if (side2%n /= side1%n) then
            call add_field_error(deck%text, card%line, 4, 'SIDE2', 'SIDE2 has '//plural(side2%n, 'node')//', SIDE1 '// &
               integer_text(side1%n)//': every node needs its partner', errors)
         end if
      end associate
   end subroutine pair_nodes


   !> Where a node lies, for messages.
   function place_text(model, node) result(text)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      character(:), allocatable    :: text

      text = real_text(model%x(1, node))//', '//real_text(model%x(2, node))
      if (model%dimension == 3) text = text//', '//real_text(model%x(3, node))
   end function place_text


   !> Axes of an interface element with normal Z (unit): columns x, y, z, right-handed. In the plane x lies in the joint and y
   !! out of the plane; x points towards +X (+Y where the joint stands upright). In space x is +X projected on the joint, or +Y
   !! where the normal is within 25 degrees of X.
   pure function joint_axes(model, z) result(axes)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: z(3)
      real(wp) :: axes(3, 3), x(3)

      if (model%dimension == 3) then
         x = [1.0_wp, 0.0_wp, 0.0_wp]
         if (abs(z(1)) > 0.9_wp) x = [0.0_wp, 1.0_wp, 0.0_wp]
         x = x - dot_product(x, z)*z
         x = x/norm2(x)
      else
         x = [-z(2), z(1), 0.0_wp]
         if (x(1) < -1.0e-9_wp .or. (abs(x(1)) <= 1.0e-9_wp .and. x(2) < 0.0_wp)) x = -x
      end if
      axes(:, 1) = x
      axes(:, 2) = [z(2)*x(3) - z(3)*x(2), z(3)*x(1) - z(1)*x(3), z(1)*x(2) - z(2)*x(1)]
      axes(:, 3) = z
   end function joint_axes


   !> How many different PJOINTs the CJOINT cards name: each is a joint.
   pure integer function count_groups(deck) result(n)
      type(deck_type), intent(in) :: deck
      type(id_table_type)  :: laws
      integer, allocatable :: again(:)

      n = 0
      if (deck%bulk%n_cjoint == 0) return
      call laws%build(deck%bulk%cjoint(:deck%bulk%n_cjoint)%law)
      call laws%list_repeated(again)
      n = deck%bulk%n_cjoint - size(again)
   end function count_groups


   !> CJOINT cards with the same PJOINT make up one joint, numbered as the PJOINT.
   subroutine group_cjoints(deck, model, errors)
      type(deck_type), intent(in)          :: deck
      type(model_type), intent(inout)      :: model
      type(deck_error_list), intent(inout) :: errors
      type(interface_element), allocatable :: elements(:)
      integer, allocatable :: members(:)
      logical, allocatable :: done(:)
      integer :: i, j, k, node

      j = deck%bulk%n_joint
      allocate (done(deck%bulk%n_cjoint), source=.false.)
      do i = 1, deck%bulk%n_cjoint
         if (done(i)) cycle
         members = pack([(k, k=1, deck%bulk%n_cjoint)], deck%bulk%cjoint%law == deck%bulk%cjoint(i)%law)
         done(members) = .true.
         if (allocated(elements)) deallocate (elements)
         allocate (elements(size(members)))
         do k = 1, size(members)
            associate (card => deck%bulk%cjoint(members(k)), element => elements(k))
               element%id = card%id
               element%area = card%area
               do node = 1, 2
                  if (card%nodes(node) == 0) cycle
                  element%nodes(node) = model%node_table%find(card%nodes(node))
                  if (element%nodes(node) == 0) call add_field_error(deck%text, card%line, node + 2, 'node G'// &
                     integer_text(node), 'there is no GRID '//integer_text(card%nodes(node)), errors)
               end do
               if (model%dimension == 2 .and. abs(card%normal(3)) > 0.0_wp) call add_field_error(deck%text, card%line, 8, 'NZ', &
                  'not zero, but a plane model lies in x-y', errors)
               if (norm2(card%normal) > 0.0_wp) &
                  element%axes = joint_axes(model, outward(model, element%nodes, card%normal/norm2(card%normal)))
            end associate
         end do
         j = j + 1
         call add_elements(model, j, free_number(deck, deck%bulk%cjoint(i)%law), deck%bulk%cjoint(i)%line, elements)
         call resolve_laws(deck, deck%bulk%cjoint(i)%law, model%joints(j), errors)
      end do
   end subroutine group_cjoints


   !> The number of a group of CJOINTs: that of its PJOINT, or where a JOINT has it already, the next that is free.
   pure integer function free_number(deck, law) result(number)
      type(deck_type), intent(in) :: deck
      integer, intent(in)         :: law

      number = law
      if (.not. any(deck%bulk%joint(:deck%bulk%n_joint)%id == law)) return
      number = law + max(maxval(deck%bulk%joint(:deck%bulk%n_joint)%id), maxval(deck%bulk%pjoint(:deck%bulk%n_pjoint)%id))
   end function free_number


   !> The normal of a CJOINT in the sense from node 1 to node 2: out of the body at node 1, else into the body at node 2,
   !! else as given. (The card gives the line; its sense follows from where the bodies lie.)
   pure function outward(model, nodes, normal) result(z)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: nodes(2)
      real(wp), intent(in)         :: normal(3)
      real(wp) :: z(3), towards
      integer  :: side

      z = normal
      do side = 1, 2
         if (nodes(side) == 0) cycle
         towards = body_side(model, nodes(side), normal)
         if (abs(towards) > 0.0_wp) then
            if ((side == 1) .eqv. (towards > 0.0_wp)) z = -normal
            return
         end if
      end do
   end function outward


   !> +1 where the body at NODE lies in the direction of NORMAL, -1 where against it, 0 where it cannot be told.
   pure real(wp) function body_side(model, node, normal) result(side)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp), intent(in)         :: normal(3)
      real(wp) :: to_body(3)
      integer  :: i

      to_body = 0.0_wp
      do i = model%first_at(node), model%first_at(node + 1) - 1
         associate (corners => corners_of(model, model%elements_at(i)))
            if (any(corners == 0)) cycle
            to_body = to_body + sum(model%x(:, corners), dim=2)/size(corners) - model%x(:, node)
         end associate
      end do
      side = 0.0_wp
      if (abs(dot_product(to_body, normal)) > 0.05_wp*norm2(to_body)) side = sign(1.0_wp, dot_product(to_body, normal))
   end function body_side


   !> The laws of a joint, by the id of its PJOINT.
   subroutine resolve_laws(deck, id, joint, errors)
      type(deck_type), intent(in)          :: deck
      integer, intent(in)                  :: id
      type(joint_type), intent(inout)      :: joint
      type(deck_error_list), intent(inout) :: errors
      integer :: direction, i, k

      if (id == 0) return
      i = findloc(deck%bulk%pjoint(:deck%bulk%n_pjoint)%id, id, dim=1)
      if (i == 0) then
         call add_field_error(deck%text, joint%line, 2, 'PJID', 'there is no PJOINT '//integer_text(id), errors)
         return
      end if
      associate (pjoint => deck%bulk%pjoint(i), law => joint%law)
         if (pjoint%p0_given) joint%p0 = pjoint%p0
         law%has_friction = pjoint%mu_given
         law%mu = pjoint%mu
         law%n_reanalyses = pjoint%n_reanalyses
         k = findloc(deck%bulk%jnorm(:deck%bulk%n_jnorm)%id, pjoint%normal_law, dim=1)
         if (k > 0) then ! else said where PJOINT is checked
            law%normal = normal_law(c=deck%bulk%jnorm(k)%c, m=deck%bulk%jnorm(k)%m, e_u=deck%bulk%jnorm(k)%e_u, &
                                    eq10=deck%control%pressure == pressure_eq10)
            joint%e_u_given = deck%bulk%jnorm(k)%e_u_given
         end if
         do direction = 1, 2
            k = findloc(deck%bulk%jshear(:deck%bulk%n_jshear)%id, pjoint%shear_laws(direction), dim=1)
            if (k == 0 .or. pjoint%shear_laws(direction) == 0) cycle
            law%shear(direction) = deck%bulk%jshear(k)%law
         end do
      end associate
   end subroutine resolve_laws


   !> The unloading slope that the card leaves blank: E of the body at the joint, per unit length.
   subroutine default_slope(model, joint, errors)
      type(model_type), intent(in)         :: model
      type(joint_type), intent(inout)      :: joint
      type(deck_error_list), intent(inout) :: errors
      integer :: i, node, side

      if (joint%e_u_given .or. joint%law%normal%c <= 0.0_wp) return
      do i = joint%first, joint%last
         do side = 1, 2
            node = model%interface(i)%nodes(side)
            if (node == 0) cycle
            if (model%first_at(node) == model%first_at(node + 1)) cycle
            associate (property => model%element_property(model%elements_at(model%first_at(node))))
               if (property > 0) joint%law%normal%e_u = model%properties(property)%e
            end associate
            return
         end do
      end do
      if (joint%last >= joint%first) call errors%add(joint%line, 'joint '//integer_text(joint%id)// &
         ': the JNORM of this joint leaves EU blank, and there is no body at the joint to take E from: give EU')
   end subroutine default_slope


   !> Area and mean normal of a joint.
   pure subroutine sum_joint(model, joint)
      type(model_type), intent(in)    :: model
      type(joint_type), intent(inout) :: joint
      integer :: i

      joint%area = 0.0_wp
      joint%normal = 0.0_wp
      do i = joint%first, joint%last
         joint%area = joint%area + model%interface(i)%area
         joint%normal = joint%normal + model%interface(i)%area*model%interface(i)%axes(:, 3)
      end do
      if (norm2(joint%normal) > 1.0e-6_wp*joint%area) then
         joint%normal = joint%normal/norm2(joint%normal)
      else
         joint%normal = 0.0_wp
      end if
   end subroutine sum_joint

end module joint_build
