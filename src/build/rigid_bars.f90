!> Constraint equations of rigid elements whose independent components lie at several nodes: RBE1, RBAR with both ends, RROD.
!! Six independent components (three in the plane) determine the rigid-body motion, and so the dependent ones.
module rigid_bars
   use bulk_data, only: rigid_card
   use constraint_equations, only: add_dependence, add_expansion, add_term, dependence_list, invert
   use deck_check, only: checked_deck
   use field_rules, only: has_component
   use kinds, only: wp
   use model_data, only: mesh_type
   use numbers, only: cross
   use tolerances, only: zero_component_along, zero_cosine
   use unknowns, only: component_place, n_motions, node_axes, place_of_component, third_axis
   implicit none
   private

   public :: add_rigid_body, add_rod

contains

   !> The constraint equations of CARD, an RBE1 or RBAR, whose dependent NODES and INDEPENDENT nodes are known:
   !!    c = g x,  x = [A]^-1 (c_i - growth_i) + ...   x the motion at the first independent node, rows of [A] as g
   subroutine add_rigid_body(deck, card, mesh, nodes, independent, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(mesh_type), intent(in)          :: mesh
      integer, intent(in)                  :: nodes(:), independent(:)
      type(dependence_list), intent(inout) :: list
      type(component_place) :: on(6), place
      real(wp) :: a(n_motions(mesh%dimension), n_motions(mesh%dimension)), inverse(size(a, 1), size(a, 1)), extent
      real(wp) :: factor(size(a, 1)), growth(size(a, 1)), of_growth
      integer  :: at(6), digit, i, k, n
      logical  :: ok

      n = 0
      a = 0.0_wp
      extent = maxval([(norm2(mesh%x(:, nodes(k)) - mesh%x(:, independent(1))), k = 1, size(nodes))])
      if (.not. extent > 0.0_wp) extent = 1.0_wp
      do k = 1, size(independent)
         do digit = 1, 6
            place = place_of_component(mesh, independent(k), digit)
            if (place%node == 0 .or. .not. has_component(card%um_components(k), digit)) cycle
            n = n + 1
            if (n > size(a, 1)) exit
            on(n) = place
            at(n) = independent(k)
            call row_of(independent(k), digit, a(n, :), growth(n))
         end do
      end do
      ok = n == size(a, 1)
      if (ok) call invert(a, inverse, ok)
      if (.not. ok) call deck%field_error(card%line, card%um_at(1), 'the independent components do not determine the '// &
         'motion of a rigid body; expected six of them, which no rigid-body motion leaves at rest, and rotations only of nodes '// &
         'that have rotations', called='G')
      if (.not. ok) return
      do k = 1, size(nodes)
         do digit = 1, 6
            place = place_of_component(mesh, nodes(k), digit)
            if (place%node == 0 .or. .not. has_component(card%directions(k), digit)) cycle
            call row_of(nodes(k), digit, factor, of_growth)
            factor = matmul(factor, inverse)
            where (abs(factor) <= zero_component_along*maxval(abs(factor))) factor = 0.0_wp
            call add_dependence(list, place, card%line, card%at(k))
            do i = 1, size(factor)
               call add_term(list, on(i), factor(i)*place%scale/on(i)%scale)
               call add_expansion(list, [independent(1), at(i)], -factor(i)*growth(i)*place%scale, card%reference)
            end do
            call add_expansion(list, [independent(1), nodes(k)], of_growth*place%scale, card%reference)
         end do
      end do

   contains

      !> Component DIGIT of NODE for a unit of each motion, rotations times EXTENT, and its GROWTH per temperature.
      subroutine row_of(node, digit, row, growth)
         integer, intent(in)   :: node, digit
         real(wp), intent(out) :: row(:), growth
         real(wp) :: axes(3, 3), r(3), whole(6)

         axes = node_axes(mesh, node)
         if (mesh%dimension == 2) axes(:, 3) = third_axis(mesh, node)
         r = mesh%x(:, node) - mesh%x(:, independent(1))
         whole = 0.0_wp
         growth = 0.0_wp
         if (digit <= 3) then
            whole = [axes(:, digit), cross(r, axes(:, digit))/extent]
            growth = card%alpha*dot_product(axes(:, digit), r)
         else
            whole(4:) = axes(:, digit - 3)/extent
         end if
         if (mesh%dimension == 3) row = whole
         if (mesh%dimension == 2) row = whole([1, 2, 6])
      end subroutine row_of

   end subroutine add_rigid_body

   !> The constraint equation of an RROD between NODES, the dependent one first: both move equally along the line between them.
   subroutine add_rod(deck, card, mesh, nodes, list)
      type(checked_deck), intent(in)       :: deck
      type(rigid_card), intent(in)         :: card
      type(mesh_type), intent(in)          :: mesh
      integer, intent(in)                  :: nodes(2)
      type(dependence_list), intent(inout) :: list
      type(component_place) :: place
      real(wp) :: along(3), axes(3, 3), factor(3, 2), length
      integer  :: d, k

      along = mesh%x(:, nodes(1)) - mesh%x(:, nodes(2))
      length = norm2(along)
      do k = 1, 2
         axes = node_axes(mesh, nodes(k))
         factor(:, k) = matmul(along, axes)
      end do
      if (.not. abs(factor(card%components, 1)) > zero_cosine*length) then
         call deck%field_error(card%line, 'CMA', 'the dependent component is across the line from GA to GB; expected one along it')
         return
      end if
      place = place_of_component(mesh, nodes(1), card%components)
      call add_dependence(list, place, card%line, card%at(1))
      factor = factor/factor(card%components, 1)
      where (abs(factor) <= zero_component_along*maxval(abs(factor))) factor = 0.0_wp
      do d = 1, mesh%dimension
         if (d /= card%components) call add_term(list, component_place(nodes(1), d), -factor(d, 1))
         call add_term(list, component_place(nodes(2), d), factor(d, 2))
      end do
      axes = node_axes(mesh, nodes(1))
      call add_expansion(list, nodes, card%alpha*length**2/dot_product(along, axes(:, card%components)), card%reference)
   end subroutine add_rod

end module rigid_bars
