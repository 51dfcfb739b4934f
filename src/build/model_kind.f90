!> The kind of a model, plane or space: from the entry MODEL of case control, or from what the deck holds.
!! A deck without MODEL is one of space if it has solids, a node out of the x-y plane, or an entry that only space has: a shell that
!! bends, a beam, a load or a spring out of the plane. PAXIS, BLOCK2, and a PSHELL without bending material as the property of the
!! bodies make it plane. Bars do not decide, because the bolts of plane models are bars; supports do where there are no bars: the
!! supports of a plane truss often name all six components.
module model_kind
   use bulk_data, only: edge_cbeam
   use load_data, only: of_edge
   use control_words, only: model_axisymmetric, model_plane, model_space
   use coordinate_systems, only: directions_at
   use deck_check, only: checked_deck
   use elasticity, only: axisymmetric
   use element_kinds, only: element_table
   use field_rules, only: has_component
   use kinds, only: wp
   use model_data, only: mesh_type
   use structural_build, only: is_beam_edge
   use text_tools, only: integer_text, one_of
   use tolerances, only: zero_component
   implicit none
   private

   public :: find_kind, space_hint

contains

   !> Find the dimension of MODEL, whose nodes are known. Errors: a MODEL that contradicts the deck. MODEL%KIND_WORDS say why a deck
   !! without MODEL in x-y is what it is, and the word that changes it.
   subroutine find_kind(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      character(:), allocatable :: reason
      logical :: has_rings, has_solids

      associate (control => deck%control, bulk => deck%bulk)
         has_rings = size(bulk%paxis) > 0
         has_solids = any(bulk%block%dimension == 3) .or. any(element_table(bulk%element%kind)%dimension == 3)
         reason = ''
         if (.not. (has_solids .or. has_rings .or. any(bulk%block%dimension == 2))) reason = reason_for_space(deck, mesh)
         mesh%dimension = merge(3, 2, has_solids .or. reason /= '')
         select case (control%model)
         case (model_space)
            if (has_rings) call deck%errors%add(control%model_line, 'MODEL = SPACE, but the deck has a PAXIS; expected '// &
                                                'AXISYMMETRIC, or no PAXIS')
            if (.not. has_rings) mesh%dimension = 3
         case (model_plane, model_axisymmetric)
            if (has_solids) call deck%errors%add(control%model_line, 'MODEL: the deck has solids; expected SPACE')
            if (.not. has_solids) mesh%dimension = 2
            if (has_rings .eqv. control%model == model_plane) call deck%errors%add(control%model_line, &
               one_of(control%model == model_plane, 'MODEL = PLANE, but the deck has a PAXIS', &
                      'MODEL = AXISYMMETRIC, but the deck has no PAXIS'))
         case default
            if (has_solids .or. has_rings .or. any(bulk%block%dimension == 2)) return
            if (any(abs(mesh%x(3, :)) > 0.0_wp)) return
            if (mesh%dimension == 3) then
               mesh%kind_words = 'a model of space, because '//reason//'; MODEL = PLANE makes it plane'
            else if (size(bulk%joint) + size(bulk%cjoint) > 0) then ! joints on edges: plane by intent
               return
            else if (has_membranes(deck)) then
               mesh%kind_words = 'a plane model, because its PSHELL have no bending material; MID2 makes it a model of space'
            else
               mesh%kind_words = 'a plane model, nothing in it leaves x-y; MODEL = SPACE makes it a model of space'
            end if
         end select
      end associate
   end subroutine find_kind

   !> The end of a message about an entry that a plane MODEL does not have.
   pure function space_hint(mesh) result(words)
      type(mesh_type), intent(in) :: mesh
      character(:), allocatable :: words

      words = ' (MODEL = SPACE makes it a model of space)'
      if (any(mesh%properties%state < axisymmetric)) words = ' (MODEL = SPACE, and MID2 on PSHELL, make it a model of space)'
      if (mesh%axisymmetric) words = ''
   end function space_hint

   !> The first entry that only space has, in words; empty: there is none, or the bodies are plane.
   function reason_for_space(deck, mesh) result(words)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      character(:), allocatable :: words
      integer :: i, k

      words = ''
      associate (bulk => deck%bulk)
         do i = 1, size(bulk%element)
            associate (element => bulk%element(i))
               if (element%property == 0) cycle
               k = findloc(bulk%pshell%id, element%property, dim=1)
               if (k == 0) cycle
               if (bulk%pshell(k)%bending <= 0) cycle
               words = 'PSHELL '//integer_text(element%property)//' bends (MID2)'
               return
            end associate
         end do
         if (has_membranes(deck)) return
         k = findloc(abs(mesh%x(3, :)) > 0.0_wp, .true., dim=1)
         if (k > 0) words = 'node '//integer_text(mesh%node_id(k))//' lies out of x-y'
         do i = 1, size(bulk%edge)
            if (words /= '') return
            if (is_beam_edge(deck, bulk%edge(i))) words = one_of(bulk%edge(i)%kind == edge_cbeam, 'CBEAM', 'CBAR')//' '// &
                                                          integer_text(bulk%edge(i)%id)//' is a beam'
         end do
         do i = 1, size(bulk%spring)
            if (words /= '') return
            if (.not. bulk%spring(i)%is_bush .and. any(bulk%spring(i)%components >= 3 .and. bulk%spring(i)%components <= 5 .and. &
                                                       bulk%spring(i)%nodes > 0)) &
               words = 'the spring '//integer_text(bulk%spring(i)%id)//' acts out of x-y'
         end do
      end associate
      if (words == '') words = load_out_of_plane(deck, mesh)
      if (words == '') words = support_out_of_plane(deck)
   end function reason_for_space

   !> Whether an element has a PSHELL without bending material.
   pure logical function has_membranes(deck)
      type(checked_deck), intent(in) :: deck
      integer :: i

      has_membranes = .false.
      if (all(deck%bulk%pshell%bending > 0)) return
      associate (element => deck%bulk%element, pshell => deck%bulk%pshell)
         has_membranes = any([(any(pshell%id == element(i)%property .and. pshell%bending <= 0), i = 1, size(element))])
      end associate
   end function has_membranes

   !> The first load, or system of displacements, that only space has, in words; empty: none.
   function load_out_of_plane(deck, mesh) result(words)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(in) :: mesh
      character(:), allocatable :: words
      integer :: i

      words = ''
      associate (bulk => deck%bulk)
         do i = 1, size(bulk%force)
            associate (card => bulk%force(i))
               if (card%ends(1) > 0 .and. card%ends(3) == 0) cycle ! along a line between nodes
               if (card%ends(3) > 0) words = 'the FORCE2'
               if (card%ends(1) == 0 .and. card%is_moment .and. leaves([1, 2], card%system, card%node, card%force)) &
                  words = 'the MOMENT'
               if (card%ends(1) == 0 .and. .not. card%is_moment .and. leaves([3], card%system, card%node, card%force)) &
                  words = 'the FORCE'
               if (words /= '') words = words//' on node '//integer_text(card%node)//' acts out of x-y'
               if (words /= '') return
            end associate
         end do
         do i = 1, size(bulk%gravity)
            associate (card => bulk%gravity(i))
               if (leaves([3], card%system, 0, card%acceleration)) words = 'GRAV '//integer_text(card%set)//' acts out of x-y'
               if (leaves([1, 2], card%system, 0, abs(card%spin) + abs(card%spin_rate))) &
                  words = 'RFORCE '//integer_text(card%set)//' turns out of x-y'
               if (words /= '') return
            end associate
         end do
         if (any(bulk%pressure%kind /= of_edge)) words = 'there is a pressure on faces'
         if (any(abs(bulk%surface_load%force(3)) > 0.0_wp)) words = 'a FORCEM acts out of x-y'
         if (any(abs(bulk%mass%offset(3)) > 0.0_wp)) words = 'a CONM2 stands out of x-y'
         do i = 1, size(bulk%displacement)
            if (out_of_plane(bulk%displacement(i)%components) .and. abs(bulk%displacement(i)%value) > 0.0_wp) &
               words = 'the SPCD of node '//integer_text(bulk%displacement(i)%node)//' moves it out of x-y'
         end do
         do i = 1, size(bulk%grid)
            associate (grid => bulk%grid(i))
               if (grid%cd <= 0) cycle
               if (.not. (leaves([3], grid%cd, grid%id, [1.0_wp, 0.0_wp, 0.0_wp]) .or. &
                          leaves([3], grid%cd, grid%id, [0.0_wp, 1.0_wp, 0.0_wp]))) cycle
               if (.not. (any(bulk%edge%nodes(1) == grid%id .or. bulk%edge%nodes(2) == grid%id) .or. &
                          any(bulk%conrod%nodes(1) == grid%id .or. bulk%conrod%nodes(2) == grid%id))) cycle ! no bar
               words = 'the system CD of node '//integer_text(grid%id)//' leaves x-y'
               return
            end associate
         end do
      end associate

   contains

      !> Whether VECTOR in system CID at NODE has one of the global COMPONENTS.
      logical function leaves(components, cid, node, vector)
         integer, intent(in)  :: components(:), cid, node
         real(wp), intent(in) :: vector(3)
         real(wp) :: directions(3, 3), global(3), x(3)
         integer  :: k
         logical  :: ok

         global = vector
         k = 0
         if (cid > 0) k = findloc(deck%bulk%system%id, cid, dim=1)
         if (k > 0 .and. k <= size(mesh%systems)) then
            x = 0.0_wp
            if (mesh%node_table%find(node) > 0) x = mesh%x(:, mesh%node_table%find(node))
            call directions_at(mesh%systems(k), x, directions, ok)
            if (ok) global = matmul(directions, vector)
         end if
         leaves = any(abs(global(components)) > zero_component*norm2(global))
      end function leaves

   end function load_out_of_plane

   !> The first support that only space has, in words; empty: none, or there are bars.
   function support_out_of_plane(deck) result(words)
      type(checked_deck), intent(in) :: deck
      character(:), allocatable :: words
      integer :: i

      words = ''
      associate (bulk => deck%bulk)
         if (size(bulk%prod) + size(bulk%conrod) > 0) return
         do i = 1, size(bulk%support)
            if (out_of_plane(bulk%support(i)%components)) words = 'a support of set '//integer_text(bulk%support(i)%set)// &
                                                                  ' holds what a plane model does not have'
            if (words /= '') return
         end do
      end associate
   end function support_out_of_plane

   !> Whether COMPONENTS has 3, 4 or 5.
   pure logical function out_of_plane(components)
      integer, intent(in) :: components
      integer :: k

      out_of_plane = any([(has_component(components, k), k = 3, 5)])
   end function out_of_plane

end module model_kind
