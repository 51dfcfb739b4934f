!> RBE3: the components of a reference node as the weighted mean of those of other nodes, or with UM others of these components
!! by the same equations; the rigid motion that comes nearest to given displacements of points. The nodes and components that
!! cards of rigid elements and equations name are looked up here.
module rbe3
   use bulk_data, only: has_component, rigid_card
   use constraint_equations, only: solve_for, add_dependence, add_term, dependence_list
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type
   use reference_nodes, only: component_place, node_axes, place_of_component, third_axis
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_node, no_displacement, by_rotation, mean_motion, add_mean

contains

   !> Whether COMPONENTS name no displacement of MODEL.
   pure logical function no_displacement(model, components)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: components
      integer :: d

      no_displacement = components > 0 .and. .not. any([(has_component(components, d), d = 1, model%dimension)])
   end function no_displacement

   !> The NODE with the number ID, which data field FIELD of the card on LINE names; 0, and an error, where there is none, or
   !! where a joint split it. A node that no element holds is WITHOUT.
   subroutine find_node(deck, line, field, id, model, without, node)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line, field, id
      type(model_type), intent(in)   :: model
      logical, intent(inout)         :: without(:)
      integer, intent(out)           :: node

      node = 0
      if (id == 0) return
      node = model%node_table%find(id)
      if (node == 0) then
         call deck%field_error(line, field, 'there is no GRID '//integer_text(id), called='G')
      else if (model%duplicate(node) > 0) then
         call deck%field_error(line, field, 'node '//integer_text(id)//' is split into two nodes by a JOINT, so that it is '// &
            'ambiguous; expected other nodes, or bodies meshed apart', called='G')
         node = 0
      else
         without(node) = without(node) .or. .not. model%used(node)
      end if
   end subroutine find_node

   !> [W] of a point at the ARM from the one that turns: its displacement is {u} + [W] {theta}, theta x arm.
   pure function by_rotation(arm) result(w)
      real(wp), intent(in) :: arm(3) !! [length]
      real(wp) :: w(3, 3)

      w = reshape([0.0_wp, -arm(3), arm(2), arm(3), 0.0_wp, -arm(1), -arm(2), arm(1), 0.0_wp], [3, 3])
   end function by_rotation

   !> [T] of RBE3, {u, theta} = sum of T(:, :, i) {c_i}: the rigid motion, displacement and rotation at the reference point, that
   !! makes the sum of the squares of the differences to the measured displacements least. Point i lies at the arm R(:, i) from it; c_i
   !! are its displacements along the directions AXES(:, 1 to 3, i), of which those USED count, with WEIGHT(i).
   !!    sum of w G^T (G {u, theta} - c) = 0,  G = directions^T [1 W]
   !! A component that this leaves open is not DETERMINED, and its row zero: of points on a line the rotation about it.
   pure subroutine mean_motion(r, axes, used, weight, t, determined)
      real(wp), intent(in)  :: r(:, :)       !! (3, points) [length]
      real(wp), intent(in)  :: axes(:, :, :) !! (3, 3, points), unit
      logical, intent(in)   :: used(:, :)    !! (3, points)
      real(wp), intent(in)  :: weight(:)     !! > 0
      real(wp), intent(out) :: t(:, :, :)    !! (6, 3, points) [-], rotations [1/length]
      logical, intent(out)  :: determined(6)
      real(wp) :: g(6, 3, size(weight)), a(6, 6), inverse(6, 6), size_of_it
      integer  :: c, i

      size_of_it = sqrt(sum(r**2)/size(weight))
      if (size_of_it <= 0.0_wp) size_of_it = 1.0_wp
      a = 0.0_wp
      do i = 1, size(weight)
         g(:3, :, i) = axes(:, :, i)
         g(4:, :, i) = matmul(transpose(by_rotation(r(:, i)/size_of_it)), axes(:, :, i)) ! rotations times the size: one unit
         do c = 1, 3
            if (.not. used(c, i)) g(:, c, i) = 0.0_wp
         end do
         a = a + weight(i)/sum(weight)*matmul(g(:, :, i), transpose(g(:, :, i)))
      end do
      call invert_where_determined(a, inverse, determined)
      do i = 1, size(weight)
         t(:, :, i) = weight(i)/sum(weight)*matmul(inverse, g(:, :, i))
         t(4:, :, i) = t(4:, :, i)/size_of_it
      end do
   end subroutine mean_motion

   !> Rows of the INVERSE of A, symmetric and not negative, for the components of x that A x = b determines, zero for the others: row j
   !! is y of A y = e_j where that has a solution. By elimination with the largest pivot left.
   pure subroutine invert_where_determined(a, inverse, determined)
      real(wp), intent(in)  :: a(6, 6)
      real(wp), intent(out) :: inverse(6, 6)
      logical, intent(out)  :: determined(6)
      real(wp), parameter :: rounding = 1.0e-12_wp ! of the largest entry: a pivot that is none
      real(wp) :: m(6, 12), pivot_row(12), residual(6)
      logical  :: done(6)
      integer  :: i, j, p

      m(:, :6) = a
      m(:, 7:) = 0.0_wp
      do i = 1, 6
         m(i, 6 + i) = 1.0_wp
      end do
      done = .false.
      do j = 1, 6
         p = maxloc([(m(i, i), i = 1, 6)], dim=1, mask=.not. done)
         if (m(p, p) <= rounding*maxval(abs(a))) exit
         done(p) = .true.
         pivot_row = m(p, :)/m(p, p)
         do i = 1, 6
            m(i, :) = m(i, :) - m(i, p)*pivot_row
         end do
         m(p, :) = pivot_row
      end do
      do j = 1, 6
         inverse(j, :) = merge(m(:, 6 + j), 0.0_wp, done) ! y, its open components zero
         residual = matmul(a, inverse(j, :))
         residual(j) = residual(j) - 1.0_wp
         determined(j) = done(j) .and. maxval(abs(residual)) <= 1.0e-8_wp
         if (.not. determined(j)) inverse(j, :) = 0.0_wp
      end do
   end subroutine invert_where_determined

   !> The dependences of an RBE3: the components REFC of its node are the weighted mean of those of its nodes.
   subroutine add_mean(deck, card, model, list, without)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(model_type), intent(in)         :: model
      type(dependence_list), intent(inout) :: list
      logical, intent(inout)               :: without(:)
      real(wp) :: t(6, 3, size(card%nodes)), direction(6)
      integer  :: before, digit, i, nodes(size(card%nodes)), point, c
      logical  :: determined(6)

      before = list%n
      call find_node(deck, card%line, card%node_at, card%node, model, without, point)
      do i = 1, size(card%nodes)
         call find_node(deck, card%line, card%at(i), card%nodes(i), model, without, nodes(i))
         if (nodes(i) == 0 .and. card%surface > 0) return ! one of a surface stands for all
      end do
      if (no_displacement(model, card%components) .and. .not. has_component(card%components, 6)) &
         call deck%field_error(card%line, 'REFC', 'contains no component of the nodes of this model')
      call check_directions(deck, card, model)
      if (point == 0 .or. any(nodes == 0) .or. deck%errors%any()) return
      call motion_of_mean(model, card, point, nodes, t, determined)
      do digit = 1, 6
         if (.not. has_component(card%components, digit)) cycle
         associate (place => place_of_component(model, point, digit))
            if (place%node == 0) cycle
            direction = direction_of(model, point, digit)
            if (any(.not. determined .and. abs(direction) > 1.0e-10_wp)) then
               call deck%field_error(card%line, 'REFC', 'component '//integer_text(digit)//' of node '// &
                  integer_text(card%node)//' does not follow from the components C of these nodes; nodes on a line, for '// &
                     'example, do not determine the rotation about it')
               return
            end if
            call add_dependence(list, place, card%line, card%node_at)
            do i = 1, size(nodes)
               do c = 1, model%dimension
                  call add_term(list, component_place(nodes(i), c), place%scale*dot_product(direction, t(:, c, i)))
               end do
            end do
         end associate
      end do
      if (allocated(card%um_nodes)) call exchange(deck, card, model, before + 1, list)
   end subroutine add_mean

   !> With UM other components depend than REFC: those that the pairs name, in place of what items FIRST and on of LIST are of.
   !! Errors: nodes and components that are not those of the card, not as many as REFC has, and equations that do not give them.
   subroutine exchange(deck, card, model, first, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: first
      type(dependence_list), intent(inout) :: list
      type(component_place) :: places(6*size(card%um_nodes))
      integer :: at(6*size(card%um_nodes)), digit, k, n
      logical :: ok

      n = 0
      do k = 1, size(card%um_nodes)
         if (card%um_nodes(k) /= card%node .and. all(card%nodes /= card%um_nodes(k))) then
            call deck%field_error(card%line, card%um_at(k), 'node '//integer_text(card%um_nodes(k))// &
               ' is neither REFGRID nor one of the nodes of this card', called='UM')
            return
         end if
         do digit = 1, 6
            if (.not. has_component(card%um_components(k), digit)) cycle
            n = n + 1
            places(n) = place_of_component(model, model%node_table%find(card%um_nodes(k)), digit)
            at(n) = card%um_at(k)
            if (places(n)%node == 0) n = n - 1 ! of a plane model those out of it
         end do
      end do
      ok = n == list%n - first + 1
      if (.not. ok) call deck%field_error(card%line, card%components_at, 'UM names '//integer_text(n)// &
         ' components, but REFC has '//integer_text(list%n - first + 1)//'; expected as many')
      if (.not. ok) return
      call solve_for(list, first, places(:n), at(:n), ok)
      if (.not. ok) call deck%field_error(card%line, card%um_at(1), 'the components after UM cannot be eliminated; expected '// &
         'components that constrain the reference node as REFC does', called='UM')
   end subroutine exchange

   !> What of displacement and rotation in global axes the component DIGIT of POINT is.
   pure function direction_of(model, point, digit) result(direction)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: point, digit
      real(wp) :: direction(6), axes(3, 3)

      axes = node_axes(model, point)
      if (model%dimension == 2) axes(:, 3) = third_axis(model, point)
      direction = 0.0_wp
      if (digit <= 3) direction(:3) = axes(:, digit)
      if (digit > 3) direction(4:) = axes(:, digit - 3)
      if (model%axisymmetric) direction([1, 3, 4, 5, 6]) = 0.0_wp
   end function direction_of

   !> [T] of mean_motion for the NODES of CARD; on a ring, whose rotation does not count, from their displacements along the axis.
   subroutine motion_of_mean(model, card, point, nodes, t, determined)
      type(model_type), intent(in) :: model
      type(rigid_card), intent(in) :: card
      integer, intent(in)          :: point, nodes(:)
      real(wp), intent(out)        :: t(:, :, :)
      logical, intent(out)         :: determined(6)
      real(wp) :: r(3, size(nodes)), axes(3, 3, size(nodes))
      logical  :: used(3, size(nodes))
      integer  :: c, i

      do i = 1, size(nodes)
         r(:, i) = model%x(:, nodes(i)) - model%x(:, point)
         axes(:, :, i) = node_axes(model, nodes(i))
         used(:, i) = [(c <= model%dimension .and. has_component(card%directions(i), c), c = 1, 3)]
      end do
      if (model%axisymmetric) then
         r = 0.0_wp
         axes([1, 3], :, :) = 0.0_wp
      end if
      call mean_motion(r, axes, used, card%weight, t, determined)
   end subroutine motion_of_mean

   !> The means are of displacements: C names some. Rotations in C are left out, as nodes of bodies have none; those of a reference node
   !! would count.
   subroutine check_directions(deck, card, model)
      type(checked_deck), intent(in) :: deck
      type(rigid_card), intent(in)   :: card
      type(model_type), intent(in)   :: model
      integer :: digit, i

      do i = 1, size(card%nodes)
         if (card%directions(i) == 0) cycle ! said already
         if (any([(place_of_rotation(i, digit), digit = 4, 6)])) then
            call deck%field_error(card%line, card%at(i), 'its components C, '//integer_text(card%directions(i))// &
               ', are rotations too, which this node has, as the reference node of a rigid element; expected C of 1 to 3', &
               called='G')
            return
         else if (no_displacement(model, card%directions(i))) then
            call deck%field_error(card%line, card%at(i), 'its components C, '//integer_text(card%directions(i))// &
               ', contain no displacement of the nodes of this model', called='G')
            return
         end if
      end do

   contains

      !> Whether C of node K names the rotation DIGIT, and the node has it.
      logical function place_of_rotation(k, digit)
         integer, intent(in) :: k, digit
         type(component_place) :: place
         integer :: node

         node = model%node_table%find(card%nodes(k))
         if (node > 0) place = place_of_component(model, node, digit)
         place_of_rotation = place%node > 0 .and. has_component(card%directions(k), digit)
      end function place_of_rotation

   end subroutine check_directions

end module rbe3
