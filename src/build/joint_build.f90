!> Joints: laws from PJOINT, JNORM, JSHEAR and JIWAN cards, and interface elements from JOINT and CJOINT cards.
!! The elements lie between two facing surfaces, between a surface and a rigid base, or are given one by one.
module joint_build
   use branch_cubic, only: cubic
   use bulk_data, only: cjoint_card
   use deck_check, only: checked_deck
   use glued_surfaces, only: warn_of_few
   use interface_operator, only: connect_nodes, interface_element, nodes_of_end, weights_of_end
   use joint_gaps, only: warn_of_distance
   use joint_sides, only: joint_axes, outward, join_sides
   use kinds, only: wp
   use lists, only: id_table_type, list_owners
   use mesh_queries, only: n_points
   use model_data, only: joint_type, joints_type, mesh_type
   use model_kind, only: space_hint
   use node_build, only: find_nodes
   use shear_stiffness, only: shear_law
   use surface_parts, only: side_of_joint
   use text_tools, only: integer_text, one_of, real_text
   use tolerances, only: beside_each_other, closed_joint
   implicit none
   private

   public :: build_joints

   !> Tables to find the cards of a joint by their numbers.
   type :: joint_tables
      type(id_table_type) :: joint   !! the JOINT cards
      type(id_table_type) :: side    !! the sides of the JOINT cards, those of card j at 2 j - 1 and 2 j
      type(id_table_type) :: group   !! the CJOINT cards, by their PJOINT
      type(id_table_type) :: pjoint, jnorm, jshear, jiwan
   end type joint_tables

contains

   !> The laws of a joint, by the id of its PJOINT.
   subroutine resolve_laws(deck, tables, id, dimension, joint)
      type(checked_deck), intent(in)  :: deck
      type(joint_tables), intent(in)  :: tables
      integer, intent(in)             :: id
      integer, intent(in)             :: dimension !! of the model
      type(joint_type), intent(inout) :: joint
      integer :: direction, i, k
      type(cubic) :: elastic

      i = 0
      if (id > 0) i = tables%pjoint%find(id)
      if (i == 0) return ! reported where the laws are checked
      associate (pjoint => deck%bulk%pjoint(i), law => joint%law)
         if (pjoint%p0_given) joint%p0 = pjoint%p0
         law%has_friction = pjoint%mu_given
         law%mu = pjoint%mu
         joint%n_reanalyses = pjoint%n_reanalyses
         k = tables%jnorm%find(pjoint%normal_law)
         if (k > 0) then ! else reported where PJOINT is checked
            law%normal = deck%bulk%jnorm(k)%law
            joint%e_u_given = deck%bulk%jnorm(k)%e_u_given
         end if
         do direction = 1, 2
            k = tables%jshear%find(pjoint%shear_laws(direction))
            if (k == 0 .or. pjoint%shear_laws(direction) == 0) cycle
            law%shear(direction) = deck%bulk%jshear(k)%law
         end do
         if (pjoint%mu > 0.0_wp .and. pjoint%iwan_law == 0 .and. .not. any(law%shear(:dimension - 1)%given)) &
            call deck%errors%warn('joint '//integer_text(joint%id)//': MU has no effect, because the joint has no law of '// &
                                  'shear; name a JSHEAR on PJOINT '//integer_text(pjoint%id))
         k = tables%jiwan%find(pjoint%iwan_law)
         if (k == 0 .or. pjoint%iwan_law == 0) return
         law%iwan = deck%bulk%jiwan(k)%law
         law%iwan%p_ref = pjoint%p_ref
         law%has_friction = .true.
         if (pjoint%p_ref > 0.0_wp) law%mu = law%iwan%f_s/pjoint%p_ref
         elastic%coefficients(1, 1) = law%iwan%k_t
         law%shear(:dimension - 1) = shear_law(given=.true., load=elastic, unload=elastic, reload=elastic)
      end associate
   end subroutine resolve_laws

   !> Values of JOINT that depend on E of the adjacent bodies. A blank unloading slope becomes the equivalent E of both bodies,
   !! 2 E1 E2/(E1 + E2), per unit length; on a rigid base E of the body. A P0 above E is an error: the bodies could not bear it, and
   !! the rounding tolerance of the joint laws, which scales with P0, would hide the tension of an element.
   subroutine compare_with_bodies(deck, mesh, joints, joint)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(joint_type), intent(inout) :: joint
      real(wp) :: e(2), lower, higher
      logical  :: is_there(2), lacks_slope
      integer  :: end

      lacks_slope = .not. joint%e_u_given .and. joint%law%normal%c > 0.0_wp
      if (.not. lacks_slope .and. joint%p0 <= 0.0_wp) return
      do end = 1, 2
         call find_modulus(mesh, joints, joint, end, e(end), is_there(end))
      end do
      if (lacks_slope .and. any(is_there)) then
         lower = minval(e, mask=is_there)
         higher = maxval(e, mask=is_there)
         if (higher > 0.0_wp) joint%law%normal%e_u = lower*(2.0_wp*higher/(lower + higher)) ! exactly E where both are the same
      else if (lacks_slope .and. joint%last >= joint%first) then
         call deck%errors%add(joint%line, 'joint '//integer_text(joint%id)// &
            ': EU is blank on the JNORM of this joint, and no body at the joint gives E: give EU')
      end if
      if (maxval(e) > 0.0_wp .and. joint%p0 > maxval(e)) call deck%errors%add(joint%line, 'joint '//integer_text(joint%id)// &
         ': P0 of its PJOINT, '//real_text(joint%p0)//', exceeds E of the adjacent bodies, '//real_text(maxval(e))// &
         ': give about the mean pressure of the first increment')
   end subroutine compare_with_bodies

   !> E of the bodies at END 1 or 2 of the interface elements of JOINT, if there are any: the mean over the elements at the nodes,
   !! weighted with the tributary areas, which are divided among the nodes of an end by their weights [pressure].
   pure subroutine find_modulus(mesh, joints, joint, end, e, is_there)
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(in) :: joints
      type(joint_type), intent(in) :: joint
      integer, intent(in)          :: end
      real(wp), intent(out)        :: e
      logical, intent(out)         :: is_there
      real(wp) :: total, weight
      integer, allocatable  :: nodes(:)
      real(wp), allocatable :: share(:)
      integer :: i, j, k

      e = 0.0_wp
      is_there = .false.
      total = 0.0_wp
      do i = joint%first, joint%last
         nodes = nodes_of_end(joints%element(i), end)
         share = weights_of_end(joints%element(i), end)
         share = share/sum(share)
         do k = 1, size(nodes)
            associate (elements => mesh%elements_at(mesh%first_at(nodes(k)):mesh%first_at(nodes(k) + 1) - 1))
               do j = 1, size(elements)
                  is_there = .true.
                  if (mesh%element_property(elements(j)) == 0) cycle      ! reported elsewhere
                  weight = joints%element(i)%area*share(k)/size(elements)
                  total = total + weight
                  e = e + (mesh%properties(mesh%element_property(elements(j)))%e - e)*(weight/max(total, tiny(1.0_wp)))
               end do
            end associate
         end do
      end do
   end subroutine find_modulus

   !> Build the joints and interface elements of the model. CJOINT cards with the same PJOINT form one joint.
   subroutine build_joints(deck, mesh, joints)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      type(interface_element), allocatable :: elements(:)
      type(joint_tables)   :: tables
      integer, allocatable :: first(:), leader(:), members(:)
      type(joints_type)    :: none ! glued surfaces are no joints
      integer :: highest, i, j, n, n_cards

      associate (cards => deck%bulk%joint, cjoints => deck%bulk%cjoint)
         call tables%joint%build(cards%id)
         call tables%side%build([(cards(j)%sides, j = 1, size(cards))])
         call tables%group%build(cjoints%law)
         call tables%pjoint%build(deck%bulk%pjoint%id)
         call tables%jnorm%build(deck%bulk%jnorm%id)
         call tables%jshear%build(deck%bulk%jshear%id)
         call tables%jiwan%build(deck%bulk%jiwan%id)
         leader = [(tables%group%find(cjoints(i)%law), i = 1, size(cjoints))] ! the first card of the group
         n_cards = count(.not. cards%is_glued)
         allocate (joints%list(n_cards + count(leader == [(i, i = 1, size(cjoints))])), joints%element(0), joints%glue(0))
         highest = max(0, maxval(cjoints%id))
         n = 0
         allocate (none%list(size(cards)))
         do j = n_cards + 1, size(cards)
            call joint_elements(deck, tables, j, mesh, none, highest, elements)
            joints%glue = [joints%glue, elements]
            associate (name => 'glue of surfaces '//integer_text(cards(j)%sides(1))//' and '//integer_text(cards(j)%sides(2)))
               call warn_of_distance(deck, mesh%dimension, none%list(j), name, 'nothing balances the moment of their shear')
               if (mesh%dimension == 3) call warn_of_few(deck, name, elements)
            end associate
         end do
         do j = 1, n_cards
            call joint_elements(deck, tables, j, mesh, joints, highest, elements)
            call add_elements(joints, n, j, cards(j)%id, cards(j)%line, elements)
            joints%list(j)%side_1 = side_of_joint(mesh, j, cards(j)%sides(1))
            call resolve_laws(deck, tables, cards(j)%law, mesh%dimension, joints%list(j))
         end do
         call list_owners(size(cjoints), reshape(leader, [1, size(cjoints)]), first, members)
         j = n_cards
         do i = 1, size(cjoints)
            if (leader(i) /= i) cycle
            j = j + 1
            call cjoint_elements(deck, cjoints(members(first(i):first(i + 1) - 1)), mesh, elements)
            call add_elements(joints, n, j, group_number(deck, tables%joint, cjoints(i)%law), cjoints(i)%line, elements)
            call resolve_laws(deck, tables, cjoints(i)%law, mesh%dimension, joints%list(j))
         end do
      end associate
      joints%element = joints%element(:n)
      do j = 1, size(joints%list)
         associate (joint => joints%list(j), elements => joints%element(joints%list(j)%first:joints%list(j)%last))
            joint%area = 0.0_wp
            joint%normal = 0.0_wp
            do i = 1, size(elements)
               joint%area = joint%area + elements(i)%area
               joint%normal = joint%normal + elements(i)%area*elements(i)%axes(:, 3)
            end do
            if (norm2(joint%normal) > closed_joint*joint%area) then
               joint%normal = joint%normal/norm2(joint%normal)
            else
               joint%normal = 0.0_wp
            end if
            call compare_with_bodies(deck, mesh, joints, joint)
         end associate
      end do
   end subroutine build_joints

   !> Store the interface elements of joint J behind the first N of the model; the array may have spare room.
   subroutine add_elements(joints, n, j, id, line, elements)
      type(joints_type), intent(inout) :: joints
      integer, intent(inout)                 :: n
      integer, intent(in)                    :: j, id, line
      type(interface_element), intent(inout) :: elements(:)
      type(interface_element), allocatable   :: longer(:)

      joints%list(j)%id = id
      joints%list(j)%line = line
      joints%list(j)%first = n + 1
      joints%list(j)%last = n + size(elements)
      elements%joint = j
      if (joints%list(j)%last > size(joints%element)) then
         allocate (longer(2*joints%list(j)%last))
         longer(:n) = joints%element(:n)
         call move_alloc(longer, joints%element)
      end if
      joints%element(n + 1:joints%list(j)%last) = elements
      n = joints%list(j)%last
   end subroutine add_elements

   !> Interface elements of JOINT card J, numbered from HIGHEST + 1; none in case of an error.
   subroutine joint_elements(deck, tables, j, mesh, joints, highest, elements)
      type(checked_deck), intent(in)                    :: deck
      type(joint_tables), intent(in)                    :: tables
      integer, intent(in)                               :: j
      type(mesh_type), intent(in) :: mesh
      type(joints_type), intent(inout) :: joints
      integer, intent(inout)                            :: highest
      type(interface_element), allocatable, intent(out) :: elements(:)
      integer :: first, surface(2), k
      logical :: shared(2)

      allocate (elements(0))
      associate (card => deck%bulk%joint(j))
         surface = 0
         do k = 1, 2
            if (card%sides(k) == 0) cycle
            surface(k) = side_of_joint(mesh, j, card%sides(k))
            if (surface(k) == 0) call deck%field_error(card%line, 'SIDE'//integer_text(k), &
                                                       'there is no PMARK '//integer_text(card%sides(k)))
            first = (tables%side%find(card%sides(k)) + 1)/2
            if (first < j .and. any([card%sides(2), deck%bulk%joint(first)%sides(2)] == 0)) call deck%field_error(card%line, &
               'SIDE'//integer_text(k), 'surface '//integer_text(card%sides(k))//' is a side of JOINT '// &
               integer_text(deck%bulk%joint(first)%id)//' already. Joints share a surface where both give SIDE2: expected '// &
               'SIDE2, or a PMARK for each joint')
         end do
         if (surface(1) == 0 .or. (surface(2) == 0 .and. card%sides(2) /= 0)) return
         if (any(mesh%surfaces(pack(surface, surface > 0))%n == 0)) return
         shared = .false. ! whether bodies lie on both sides of any part of a surface
         if (surface(2) > 0) shared = [(any(mesh%surfaces(surface(k))%other(:mesh%surfaces(surface(k))%n) > 0), k = 1, 2)]
         if (shared(2)) then
            call deck%field_error(card%line, 'SIDE2', 'bodies lie on both sides of surface '//integer_text(card%sides(2))// &
                                  ': name it as SIDE1 and leave SIDE2 blank, and the program splits it')
         else if (shared(1)) then
            call deck%field_error(card%line, 'SIDE1', 'bodies lie on both sides of surface '//integer_text(card%sides(1))// &
                                  ': leave SIDE2 blank, and the program splits it')
         else
            call join_sides(deck, j, mesh, joints, surface, elements)
         end if
         if (highest > huge(highest) - size(elements)) then
            call deck%field_error(card%line, 'JID', 'the numbers of its interface elements, which follow those of the CJOINTs, '// &
                                  'would exceed 2147483647')
            elements = [interface_element ::]
            return
         end if
      end associate
      elements%id = [(highest + k, k = 1, size(elements))]
      highest = highest + size(elements)
   end subroutine joint_elements

   !> The interface elements of CJOINT CARDS.
   subroutine cjoint_elements(deck, cards, mesh, elements)
      type(checked_deck), intent(in) :: deck
      type(cjoint_card), intent(in)  :: cards(:)
      type(mesh_type), intent(in) :: mesh
      type(interface_element), allocatable, intent(out) :: elements(:)
      real(wp) :: apart(3), beside, extent
      integer  :: first, k, n_beside, nodes(2)

      allocate (elements(size(cards)))
      extent = 0.0_wp
      if (n_points(mesh) > 0) extent = norm2(maxval(mesh%x(:, :n_points(mesh)), dim=2) - minval(mesh%x(:, :n_points(mesh)), dim=2))
      first = 0
      n_beside = 0
      do k = 1, size(cards)
         associate (card => cards(k), element => elements(k))
            element%id = card%id
            element%area = card%area
            call find_nodes(deck, card%line, card%nodes, mesh, nodes)
            call connect_nodes(element, nodes(1), nodes(2))
            if (mesh%dimension == 2 .and. abs(card%normal(3)) > 0.0_wp) &
               call deck%field_error(card%line, 'NZ', 'not zero, but a plane model lies in x-y'//space_hint(mesh))
            if (norm2(card%normal) > 0.0_wp) &
               element%axes = joint_axes(mesh, outward(mesh, nodes, card%normal/norm2(card%normal)))
            if (any(nodes == 0) .or. .not. norm2(card%normal) > 0.0_wp) cycle
            apart = mesh%x(:, nodes(2)) - mesh%x(:, nodes(1))
            apart = apart - dot_product(apart, card%normal)/norm2(card%normal)**2*card%normal
            if (norm2(apart) <= beside_each_other*extent) cycle
            n_beside = n_beside + 1
            if (first > 0) cycle
            first = card%id
            beside = norm2(apart)
         end associate
      end do
      if (n_beside > 0) call deck%errors%warn('the nodes of CJOINT '//integer_text(first)//' stand '//real_text(beside)// &
         ' beside each other'//one_of(n_beside > 1, ', and so do those of '//integer_text(n_beside - 1)//' more,', ',')// &
         ' and nothing balances the moment of its force')
   end subroutine cjoint_elements

   !> The number of a joint of CJOINTs: that of its PJOINT; if a JOINT has this number, the next free number.
   pure integer function group_number(deck, joints, law) result(number)
      type(checked_deck), intent(in)  :: deck
      type(id_table_type), intent(in) :: joints !! of the JOINT cards, by their ids
      integer, intent(in)             :: law
      integer :: highest, left

      number = law
      if (joints%find(law) == 0) return
      highest = max(maxval(deck%bulk%joint%id), maxval(deck%bulk%pjoint%id))
      if (law <= huge(law) - highest) then
         number = law + highest
         return
      end if
      left = findloc(deck%bulk%pjoint%id, law, dim=1) ! numbers behind the last one are free; each law takes one, from 1 on
      number = 0
      do while (left > 0)
         number = number + 1
         if (joints%find(number) == 0 .and. all(deck%bulk%pjoint%id /= number)) left = left - 1
      end do
   end function group_number

end module joint_build
