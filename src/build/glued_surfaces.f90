!> Glued surfaces, BGSET: the mortar projection of a joint as constraint equations, one for each component of an interface element.
!! The movement of an element, sum v_k u_k of SIDE1 less sum w_j u_j of SIDE2, is zero; its own node of SIDE1 is dependent. Faces that
!! match move as one; on others the mean over a face moves with the other body, and a constant stress passes exactly.
module glued_surfaces
   use constraint_equations, only: add_dependence, add_term, dependence_list
   use deck_check, only: checked_deck
   use interface_operator, only: interface_element, named_node, nodes_of_end, weights_of_end
   use kinds, only: wp
   use model_data, only: freedoms_type, mesh_type
   use numbers, only: cross
   use text_tools, only: plural
   use unknowns, only: component_place, node_axes, place_of_component
   implicit none
   private

   public :: add_glue, warn_of_few

   real(wp), parameter :: least_own = 0.5_wp ! weight of its node in an element: on faces that are covered in part one with less is left out
   integer, parameter  :: few = 3            ! nodes hold a body in space; fewer of a pair give a warning

contains

   !> Add to LIST, whose equations are in order, those of the elements GLUE. In no equation a term is dependent, before and after.
   !! Components that are supported or dependent already keep what they have; a warning counts them.
   subroutine add_glue(deck, glue, mesh, freedoms, list)
      type(checked_deck), intent(in)       :: deck
      type(interface_element), intent(in)  :: glue(:)
      type(mesh_type), intent(in)          :: mesh
      type(freedoms_type), intent(in)      :: freedoms
      type(dependence_list), intent(inout) :: list
      logical, allocatable  :: is_term(:, :)        ! of an equation
      logical, allocatable  :: is_there(:, :)       ! in the equation in work
      real(wp), allocatable :: row(:, :)            ! of the equation in work
      type(component_place), allocatable :: terms(:) ! its components
      real(wp) :: axes(3, 3), own, x(3)
      integer  :: a, c, i, k, left, n, node

      if (size(glue) == 0) return
      allocate (is_term(mesh%dimension, mesh%n_nodes), is_there(mesh%dimension, mesh%n_nodes), source=.false.)
      allocate (row(mesh%dimension, mesh%n_nodes), source=0.0_wp)
      allocate (terms(64))
      do i = 1, list%n
         call note_terms(i)
      end do
      left = 0
      do i = 1, size(glue)
         node = named_node(glue(i), 1)
         if (.not. ties(glue(i))) cycle
         node = point_at(node)
         axes = node_axes(mesh, node)
         do c = 1, mesh%dimension
            if (freedoms%held(c, node) .or. list%of(c, node) > 0) then
               left = left + 1
               cycle
            end if
            n = 0
            do a = 1, size(glue(i)%node)
               call add_displacement(glue(i)%node(a), glue(i)%weight(a)*axes(:, c))
            end do
            own = row(c, node)
            if (abs(own) >= 0.5_wp*least_own) then
               call add_dependence(list, component_place(node, c, 1.0_wp), 0, 1)
               row(c, node) = 0.0_wp
               do k = 1, n
                  call add_term(list, terms(k), -row(terms(k)%d, terms(k)%node)/own)
               end do
               list%of(c, node) = list%n
               call note_terms(list%n)
               if (is_term(c, node)) call put_in_place(c, node)
            end if
            do k = 1, n
               row(terms(k)%d, terms(k)%node) = 0.0_wp
               is_there(terms(k)%d, terms(k)%node) = .false.
            end do
         end do
      end do
      if (left > 0) call deck%errors%warn('glued surfaces: '//plural(left, 'component')//' of nodes of SID are supported or '// &
                                          'dependent already and are not glued')

   contains

      !> The node whose unknowns NODE has: of the face of a shell its point.
      pure integer function point_at(node) result(point)
         integer, intent(in) :: node

         point = node
         if (size(mesh%face_of) == 0) return
         if (mesh%face_of(node) > 0) point = mesh%faces(mesh%face_of(node))%point
      end function point_at

      !> Add the displacement of NODE along DIRECTION to the row.
      subroutine add_displacement(node, direction)
         integer, intent(in)  :: node
         real(wp), intent(in) :: direction(3)
         real(wp) :: own_axes(3, 3)
         type(component_place) :: place
         integer  :: k

         own_axes = node_axes(mesh, point_at(node))
         do k = 1, mesh%dimension
            call add_component(point_at(node), k, dot_product(direction, own_axes(:, k)))
         end do
         if (point_at(node) == node) return
         x = cross(mesh%faces(mesh%face_of(node))%lever, direction) ! (theta x r) . e = theta . (r x e)
         do k = 4, 6
            place = place_of_component(mesh, point_at(node), k)
            if (place%node > 0) call add_component(place%node, place%d, dot_product(x, own_axes(:, k - 3))/place%scale)
         end do
      end subroutine add_displacement

      !> Add FACTOR times a component to the row, or what it depends on.
      recursive subroutine add_component(node, d, factor)
         integer, intent(in)  :: node, d
         real(wp), intent(in) :: factor
         integer :: m

         if (list%of(d, node) > 0) then
            associate (item => list%item(list%of(d, node)))
               do m = 1, item%n
                  call add_component(item%on(m)%node, item%on(m)%d, factor*item%on(m)%scale)
               end do
            end associate
         else if (abs(factor) > 0.0_wp) then
            row(d, node) = row(d, node) + factor
            if (is_there(d, node)) return
            is_there(d, node) = .true.
            if (n == size(terms)) terms = [terms, terms]
            n = n + 1
            terms(n) = component_place(node, d, 1.0_wp)
         end if
      end subroutine add_component

      !> Note the terms of equation I.
      subroutine note_terms(i)
         integer, intent(in) :: i
         integer :: m

         do m = 1, list%item(i)%n
            is_term(list%item(i)%on(m)%d, list%item(i)%on(m)%node) = .true.
         end do
      end subroutine note_terms

      !> Put the last equation in the place of its component in all others.
      subroutine put_in_place(d, node)
         integer, intent(in) :: d, node
         integer :: j, m

         do j = 1, list%n - 1
            associate (item => list%item(j), last => list%item(list%n))
               do ! a component may occur twice
                  m = findloc(item%on(:item%n)%node == node .and. item%on(:item%n)%d == d, .true., dim=1)
                  if (m == 0) exit
                  item%on = [item%on(:m - 1), item%on(m + 1:item%n), scaled(last%on(:last%n), item%on(m)%scale)]
                  item%n = size(item%on)
               end do
            end associate
         end do
      end subroutine put_in_place

      !> PLACE times FACTOR.
      elemental type(component_place) function scaled(place, factor)
         type(component_place), intent(in) :: place
         real(wp), intent(in)              :: factor

         scaled = component_place(place%node, place%d, place%scale*factor)
      end function scaled

   end subroutine add_glue

   !> Whether ELEMENT ties its own node: on faces that are covered in part one with little weight of it does not.
   pure logical function ties(element)
      type(interface_element), intent(in) :: element

      ties = .false.
      associate (node => named_node(element, 1))
         if (size(nodes_of_end(element, 2)) == 0 .or. node <= 0) return
         ties = sum(weights_of_end(element, 1), mask=nodes_of_end(element, 1) == node) >= least_own
      end associate
   end function ties

   !> Warn of the glue called NAME whose ELEMENTS tie fewer nodes than a body needs.
   subroutine warn_of_few(deck, name, elements)
      type(checked_deck), intent(in)      :: deck
      character(*), intent(in)            :: name
      type(interface_element), intent(in) :: elements(:)
      integer :: i, n

      n = count([(ties(elements(i)), i = 1, size(elements))])
      if (n < few) call deck%errors%warn(name//': it ties '//plural(n, 'node')//' of its side SID, as many as '// &
         'lie on the part that TID covers; the side with the smaller elements should be SID')
   end subroutine warn_of_few

end module glued_surfaces
