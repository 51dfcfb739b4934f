!> Constraint equations c = sum of factor c_k, from rigid elements and MPC: checks, elimination, and RBE3.
!! Dependent components are eliminated: their nodes move with the unknowns of the independent components. UM of RBE3 solves the
!! equations for other components.
module constraint_equations
   use blas_lapack, only: dgesv
   use deck_check, only: checked_deck
   use kinds, only: wp
   use mesh_queries, only: node_kind, open_left_out, point_of, shown_number
   use model_data, only: a_rotation, freedoms_type, mesh_type
   use node_coupling, only: couple_node
   use text_tools, only: integer_text, one_of
   use tolerances, only: zero_pivot_of_equations
   use unknowns, only: component_axes, component_place
   implicit none
   private

   public :: add_dependence, add_expansion, add_term, check_dependences, eliminate, invert, solve_for

   !> What a rigid element adds to a constraint equation when it is warmed: GROWTH times T - REFERENCE, T the mean of two POINTS.
   type, public :: expansion_type
      integer  :: node = 0, d = 0            !! the dependent component
      integer  :: points(2) = 0
      integer  :: line = 0                   !! of the card
      real(wp) :: growth = 0.0_wp            !! [length/temperature]
      real(wp) :: reference = 0.0_wp         !! TREF [temperature]
   end type expansion_type

   !> A constraint equation of one dependent component, D of NODE. Components are unknowns, along the axes of their nodes. Where it
   !! has a part that is no component, an expansion, this part is the place of the component itself, which is held and moved.
   type, public :: dependence_type
      integer :: node = 0, d = 0
      integer :: line = 0, field = 0         !! of the card, and the data field that names the node
      integer :: n = 0                       !! number of terms
      type(component_place), allocatable :: on(:) !! (at least n) independent components, SCALE is the factor; one may occur twice
      logical :: expands = .false.
   end type dependence_type

   type, public :: dependence_list
      integer :: n = 0
      type(dependence_type), allocatable :: item(:)
      type(expansion_type), allocatable :: expansions(:) !! (at least N_EXPANSIONS) of rigid elements
      integer :: n_expansions = 0
      integer, allocatable :: of(:, :)       !! (dimension, n_nodes) the equation of a component, 0: none
      logical, allocatable :: without(:)     !! (n_nodes) the node belongs to a rigid element or an equation, not to an element
   end type dependence_list

contains

   !> Start the equation of the component at PLACE, which is named in data field FIELD of the card on LINE.
   pure subroutine add_dependence(list, place, line, field)
      type(dependence_list), intent(inout) :: list
      type(component_place), intent(in)    :: place
      integer, intent(in)                  :: line, field

      if (.not. allocated(list%item)) allocate (list%item(8))
      if (list%n == size(list%item)) list%item = [list%item, list%item]
      list%n = list%n + 1
      list%item(list%n) = dependence_type(node=place%node, d=place%d, line=line, field=field)
      allocate (list%item(list%n)%on(8))
   end subroutine add_dependence

   !> Add FACTOR times the component at PLACE to the last equation; a zero FACTOR adds nothing.
   pure subroutine add_term(list, place, factor)
      type(dependence_list), intent(inout) :: list
      type(component_place), intent(in)    :: place
      real(wp), intent(in)                 :: factor

      if (abs(factor) <= 0.0_wp) return
      associate (item => list%item(list%n))
         if (item%n == size(item%on)) item%on = [item%on, item%on]
         item%n = item%n + 1
         item%on(item%n) = component_place(place%node, place%d, factor)
      end associate
   end subroutine add_term

   !> Add to the last equation what the element between two POINTS grows by, GROWTH [length/temperature] from the REFERENCE
   !! temperature on.
   pure subroutine add_expansion(list, points, growth, reference)
      type(dependence_list), intent(inout) :: list
      integer, intent(in)                  :: points(2)
      real(wp), intent(in)                 :: growth, reference

      if (abs(growth) <= 0.0_wp) return
      if (.not. allocated(list%expansions)) allocate (list%expansions(8))
      if (list%n_expansions == size(list%expansions)) list%expansions = [list%expansions, list%expansions]
      list%n_expansions = list%n_expansions + 1
      associate (item => list%item(list%n))
         item%expands = .true.
         list%expansions(list%n_expansions) = expansion_type(item%node, item%d, points, item%line, growth, reference)
      end associate
   end subroutine add_expansion

   !> Set OF of LIST, and put the equations of dependent components in their place in the terms of the others, so that all terms are
   !! independent. Errors: a component that depends twice, is supported too, depends on itself, or on one that expands.
   subroutine check_dependences(deck, mesh, freedoms, list)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      type(dependence_list), intent(inout) :: list
      character(:), allocatable :: words
      logical, allocatable :: is_named(:), is_open(:), is_done(:)
      integer :: i

      allocate (list%of(mesh%dimension, mesh%n_nodes), source=0)
      allocate (is_named(list%n), is_open(list%n), is_done(list%n), source=.false.)
      do i = 1, list%n
         associate (item => list%item(i))
            words = ''
            if (list%of(item%d, item%node) > 0) then
               words = ' is already dependent by '//name_of(deck, list%item(list%of(item%d, item%node))%line)
            else
               list%of(item%d, item%node) = i
               if (freedoms%held(item%d, item%node)) words = ' is supported by '//support_name(deck, freedoms, item%node, &
                  item%d)//' too; a component is either dependent or supported'
            end if
            if (words /= '') call name_once(i, component_text(mesh, item%node, item%d)//words)
         end associate
      end do
      do i = 1, list%n
         call make_independent(i)
      end do

   contains

      !> Put the equations of its dependent terms, made independent before, in their place in equation I.
      recursive subroutine make_independent(i)
         integer, intent(in) :: i
         type(component_place), allocatable :: on(:)
         integer :: j, k, m

         if (is_done(i)) return
         is_done(i) = .true.
         if (all([(list%of(list%item(i)%on(k)%d, list%item(i)%on(k)%node), k = 1, list%item(i)%n)] == 0)) return
         is_open(i) = .true.
         on = [component_place ::]
         do k = 1, list%item(i)%n
            associate (term => list%item(i)%on(k))
               j = list%of(term%d, term%node)
               if (j > 0) call make_independent(j)
               if (j == 0) then
                  on = [on, term]
               else if (is_open(j) .or. list%item(j)%expands) then
                  call name_once(i, component_text(mesh, term%node, term%d)//', on which this component depends, is itself '// &
                     'dependent by '//name_of(deck, list%item(j)%line)//one_of(is_open(j), ', in a circle', &
                     ', which expands')//'; expected an independent component: name its own independent nodes')
                  exit
               else
                  on = [on, [(component_place(list%item(j)%on(m)%node, list%item(j)%on(m)%d, &
                                              term%scale*list%item(j)%on(m)%scale), m = 1, list%item(j)%n)]]
               end if
            end associate
         end do
         is_open(i) = .false.
         list%item(i)%n = size(on)
         call move_alloc(on, list%item(i)%on)
      end subroutine make_independent

      !> One error per field of a card, though several components may be wrong.
      subroutine name_once(equation, message)
         integer, intent(in)      :: equation
         character(*), intent(in) :: message
         integer :: j

         do j = equation - 1, 1, -1
            if (list%item(j)%line /= list%item(equation)%line) exit
            if (list%item(j)%field == list%item(equation)%field .and. is_named(j)) return
         end do
         is_named(equation) = .true.
         call deck%field_error(list%item(equation)%line, list%item(equation)%field, message, &
                               called=one_of(deck%card_on(list%item(equation)%line) == 'SHELLTO', 'PID1', 'G'))
      end subroutine name_once

   end subroutine check_dependences

   !> Text such as 'RBAR 7 (deck.bdf, line 12)' for the card on LINE; an MPC has the number of its set, a SHELLTO none.
   function name_of(deck, line) result(name)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line
      character(:), allocatable :: name
      integer :: i

      name = ''
      i = findloc(deck%bulk%rigid%line, line, dim=1)
      if (i > 0) name = ' '//integer_text(deck%bulk%rigid(i)%id)
      i = findloc(deck%bulk%equation%line, line, dim=1)
      if (i > 0) name = ' of set '//integer_text(deck%bulk%equation(i)%set)
      name = deck%card_on(line)//name//' ('//deck%text%place(line)//')'
   end function name_of

   !> The same for the card that supports component D of NODE.
   function support_name(deck, freedoms, node, d) result(name)
      type(checked_deck), intent(in) :: deck
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)            :: node, d
      character(:), allocatable :: name
      integer :: group

      group = 0
      if (node <= size(freedoms%support_of, 2)) group = freedoms%support_of(d, node)
      name = 'a support'
      if (group == 0) return
      associate (source => freedoms%support_groups(group))
         name = trim(source%kind)
         if (source%kind == 'GRID') name = 'PS of GRID'
         if (source%kind == 'SPCM') name = name//' of surface '//integer_text(source%id)
         if (any(source%kind == ['SPC ', 'SPC1'])) name = name//' of set '//integer_text(source%id)
         if (source%kind == 'SPC1' .or. source%kind == 'SPCM') name = name//' ('//deck%text%place(source%line)//')'
      end associate
   end function support_name

   !> Text such as 'component 3 of node 7' for component D of NODE, which may be a node of rotations.
   pure function component_text(mesh, node, d) result(words)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node, d
      character(:), allocatable :: words
      integer :: digit

      digit = d
      if (node_kind(mesh, node) == a_rotation) digit = merge(d + 3, 6, mesh%dimension == 3)
      words = 'component '//integer_text(digit)//' of node '//integer_text(shown_number(mesh, point_of(mesh, node)))
   end function component_text

   !> Couple the nodes of LIST, whose cards have no errors: their dependent components lose their unknowns and follow the equations,
   !! their other components keep theirs. Components (rotations too) of reference nodes without elements that no equation uses lose
   !! their unknowns too.
   subroutine eliminate(list, mesh, freedoms)
      type(dependence_list), intent(in) :: list
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      real(wp), allocatable :: t(:, :, :)
      logical, allocatable  :: is_used(:, :)
      integer, allocatable  :: masters(:), column(:) ! of a node, and their places among them
      real(wp) :: axes(mesh%dimension, mesh%dimension)
      logical  :: expands(3)
      integer  :: d, i, j, k, n, node

      d = mesh%dimension
      call open_left_out(mesh, freedoms)
      allocate (is_used(d, mesh%n_nodes), source=.false.)
      allocate (masters(mesh%n_nodes), column(mesh%n_nodes), source=0)
      do i = 1, list%n
         associate (item => list%item(i))
            freedoms%left_out(item%d, item%node) = .true.
            do k = 1, item%n
               is_used(item%on(k)%d, item%on(k)%node) = .true.
            end do
         end associate
      end do
      do node = 1, mesh%n_nodes
         if (.not. any(freedoms%left_out(:, node))) cycle
         axes = component_axes(mesh, node)
         n = 0
         expands = .false.
         do j = 1, d
            if (list%of(j, node) > 0) expands(j) = list%item(list%of(j, node))%expands
         end do
         if (any(expands(:d) .or. .not. freedoms%left_out(:, node))) call add_master(node)
         do j = 1, d
            if (list%of(j, node) == 0) cycle
            associate (item => list%item(list%of(j, node)))
               do k = 1, item%n
                  call add_master(item%on(k)%node)
               end do
            end associate
         end do
         allocate (t(d, d, n), source=0.0_wp)
         do j = 1, d ! first all of them: a dependent component may follow others of its own node
            if (expands(j) .or. .not. freedoms%left_out(j, node)) t(:, j, 1) = axes(:, j)
         end do
         do j = 1, d
            if (list%of(j, node) == 0) cycle
            associate (item => list%item(list%of(j, node)))
               do k = 1, item%n
                  associate (on => item%on(k))
                     t(:, on%d, column(on%node)) = t(:, on%d, column(on%node)) + on%scale*axes(:, j)
                  end associate
               end do
            end associate
         end do
         call couple_node(freedoms%coupling, mesh%n_nodes, node, masters(:n), t)
         column(masters(:n)) = 0
         deallocate (t)
      end do
      do node = 1, mesh%n_nodes
         if (list%without(node)) freedoms%left_out(:, node) = freedoms%left_out(:, node) .or. &
                                                           (.not. is_used(:, node) .and. .not. freedoms%held(:, node))
      end do
      freedoms%held = freedoms%held .or. freedoms%left_out

   contains

      subroutine add_master(master)
         integer, intent(in) :: master

         if (column(master) > 0) return
         n = n + 1
         masters(n) = master
         column(master) = n
      end subroutine add_master

   end subroutine eliminate

   !> Rewrite the equations c_j = sum of factor c_k of LIST, from FIRST on, as equations of the components at PLACES (as many),
   !! named in data fields AT. With [A] the coefficients of these components in c_j - sum of factor c_k = 0, they are -[A]^-1 times
   !! the other terms. OK is false where [A] is singular.
   subroutine solve_for(list, first, places, at, ok)
      type(dependence_list), intent(inout) :: list
      integer, intent(in)                  :: first
      type(component_place), intent(in)    :: places(:)
      integer, intent(in)                  :: at(:) !! (places)
      logical, intent(out)                 :: ok
      type(dependence_list), allocatable :: solved ! on the heap: the compiler warns of its bounds where it is a local variable
      real(wp) :: a(size(places), size(places)), inverse(size(places), size(places))
      integer  :: i, j, k, n

      n = size(places)
      a = 0.0_wp
      do j = 1, n
         associate (item => list%item(first - 1 + j))
            i = among(item%node, item%d)
            if (i > 0) a(j, i) = 1.0_wp
            do k = 1, item%n
               i = among(item%on(k)%node, item%on(k)%d)
               if (i > 0) a(j, i) = a(j, i) - item%on(k)%scale
            end do
         end associate
      end do
      call invert(a, inverse, ok)
      if (.not. ok) return
      allocate (solved)
      do i = 1, n
         call add_dependence(solved, places(i), list%item(first)%line, at(i))
         do j = 1, n
            associate (item => list%item(first - 1 + j), by => inverse(i, j))
               call add_other(component_place(item%node, item%d), -by)
               do k = 1, item%n
                  call add_other(item%on(k), by*item%on(k)%scale)
               end do
            end associate
         end do
      end do
      list%item(first:list%n) = solved%item(:n)

   contains

      !> The position of component D of NODE among PLACES, 0: none.
      pure integer function among(node, d)
         integer, intent(in) :: node, d

         among = findloc(places%node == node .and. places%d == d, .true., dim=1)
      end function among

      subroutine add_other(place, factor)
         type(component_place), intent(in) :: place
         real(wp), intent(in)              :: factor

         if (among(place%node, place%d) == 0) call add_term(solved, place, factor)
      end subroutine add_other

   end subroutine solve_for

   !> The INVERSE of M. OK is false where M is singular to rounding.
   pure subroutine invert(m, inverse, ok)
      real(wp), intent(in)  :: m(:, :) !! (n, n)
      real(wp), intent(out) :: inverse(:, :)
      logical, intent(out)  :: ok
      real(wp) :: factors(size(m, 1), size(m, 1))
      integer  :: i, info, pivots(size(m, 1))

      factors = m
      inverse = 0.0_wp
      do i = 1, size(m, 1)
         inverse(i, i) = 1.0_wp
      end do
      call dgesv(size(m, 1), size(m, 1), factors, size(m, 1), pivots, inverse, size(m, 1), info)
      ok = info == 0 .and. all([(abs(factors(i, i)) > zero_pivot_of_equations*maxval(abs(m)), i = 1, size(m, 1))])
   end subroutine invert

end module constraint_equations
