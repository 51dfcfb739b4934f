!> The matrices of K2GG and M2GG: stiffness and mass between components of nodes, from DMIG cards.
module matrix_build
   use case_control, only: matrix_term
   use deck_check, only: checked_deck
   use kinds, only: wp
   use mesh_queries, only: n_points
   use model_data, only: a_matrix, bar_type, mesh_type, point_mass_type
   use text_tools, only: integer_text
   use tolerances, only: zero_component_along
   use unknowns, only: component_place, node_axes, place_of_component
   implicit none
   private

   public :: build_matrices

contains

   !> Append the stiffness of K2GG to the bars of MESH, the mass of M2GG to its masses.
   subroutine build_matrices(deck, mesh)
      type(checked_deck), intent(in) :: deck
      type(mesh_type), intent(inout) :: mesh
      type(bar_type), allocatable    :: bars(:)
      type(point_mass_type), allocatable :: masses(:)
      integer, allocatable  :: nodes(:)
      real(wp), allocatable :: a(:, :), t(:)
      integer :: d, i, k

      do k = 1, size(deck%control%matrices)
         call assemble(deck, deck%control%matrices(k), mesh, nodes, a)
         if (size(nodes) == 0 .or. deck%errors%any()) cycle
         if (deck%control%matrices(k)%of_mass) then
            allocate (masses(size(mesh%masses) + 1))
            masses(:size(mesh%masses)) = mesh%masses
            associate (mass => masses(size(masses)))
               mass%node = nodes(1)
               mass%nodes = nodes
               mass%matrix = a
            end associate
            call move_alloc(masses, mesh%masses)
            cycle
         end if
         allocate (bars(size(mesh%bars) + 1))
         bars(:size(mesh%bars)) = mesh%bars
         associate (bar => bars(size(bars)))
            bar%kind = a_matrix
            bar%nodes = [nodes(1), nodes(size(nodes))]
            bar%of_matrix = nodes
            bar%matrix = a
            do d = 1, mesh%dimension ! with a force under a translation it holds to the ground
               t = [(merge(1.0_wp, 0.0_wp, modulo(i - d, mesh%dimension) == 0 .and. &
                           nodes((i - 1)/mesh%dimension + 1) <= n_points(mesh)), i = 1, size(a, 1))]
               if (norm2(matmul(a, t)) > zero_component_along*norm2(a)) bar%nodes(2) = 0
            end do
         end associate
         call move_alloc(bars, mesh%bars)
      end do
   end subroutine build_matrices

   !> The matrix A of TERM, its factor included, between the displacements of NODES, components of the first node first.
   subroutine assemble(deck, term, mesh, nodes, a)
      type(checked_deck), intent(in)     :: deck
      type(matrix_term), intent(in)      :: term
      type(mesh_type), intent(in)        :: mesh
      integer, allocatable, intent(out)  :: nodes(:)
      real(wp), allocatable, intent(out) :: a(:, :) !! [force/length], [force x time^2/length]
      type(component_place) :: column, row
      real(wp) :: along(3, 2)
      integer  :: at(mesh%n_nodes), c, d, h, i, pass, r, t

      d = mesh%dimension
      at = 0
      allocate (nodes(0), a(0, 0))
      associate (cards => deck%bulk%matrices%dmig, name => term%name)
         h = findloc(cards%name == name .and. cards%form > 0, .true., dim=1)
         if (h == 0) then
            call deck%errors%add(term%line, 'there is no DMIG '//trim(name)//' with a header (GJ = 0)')
            return
         end if
         do pass = 1, 2 ! the nodes, the terms
            do i = 1, size(cards)
               if (cards(i)%name /= name .or. cards(i)%form > 0 .or. .not. allocated(cards(i)%nodes)) cycle
               call find_place(cards(i)%line, 2, cards(i)%node, cards(i)%component, column, along(:, 1))
               do t = 1, size(cards(i)%nodes)
                  call find_place(cards(i)%line, cards(i)%at(t), cards(i)%nodes(t), cards(i)%components(t), row, along(:, 2))
                  if (pass == 1 .or. row%node == 0 .or. column%node == 0) cycle
                  r = d*(at(row%node) - 1)
                  c = d*(at(column%node) - 1)
                  a(r + 1:r + d, c + 1:c + d) = a(r + 1:r + d, c + 1:c + d) + &
                     cards(i)%values(t)*spread(along(:d, 2), 2, d)*spread(along(:d, 1), 1, d)
                  if (cards(h)%form == 1 .or. (row%node == column%node .and. row%d == column%d)) cycle
                  a(c + 1:c + d, r + 1:r + d) = a(c + 1:c + d, r + 1:r + d) + &
                     cards(i)%values(t)*spread(along(:d, 1), 2, d)*spread(along(:d, 2), 1, d)
               end do
            end do
            if (pass == 1) a = reshape([real(wp) ::], [d*size(nodes), d*size(nodes)], pad=[0.0_wp])
         end do
         a = term%factor*a
         if (norm2(a - transpose(a)) > zero_component_along*norm2(a)) call deck%errors%add(cards(h)%line, &
            'DMIG '//trim(name)//' is not symmetric, as a stiffness or mass is; IFO = 6 needs one of two equal terms')
      end associate

   contains

      !> The PLACE of COMPONENT of node ID in data field FIELD, and the displacement ALONG that is 1 there; node 0: an error.
      subroutine find_place(line, field, id, component, place, along)
         integer, intent(in)                :: line, field, id, component
         type(component_place), intent(out) :: place
         real(wp), intent(out)              :: along(3)
         real(wp) :: axes(3, 3)
         integer  :: node

         along = 0.0_wp
         node = mesh%node_table%find(id)
         if (node > 0) place = place_of_component(mesh, node, max(1, component))
         if (place%node == 0) then
            if (pass == 1) call deck%field_error(line, field, 'there is no component '//integer_text(component)//' of a node '// &
                                                 integer_text(id), called='G')
            return
         end if
         axes = node_axes(mesh, node)
         if (d == 2 .and. component > 3) axes(:, 1) = [1.0_wp, 0.0_wp, 0.0_wp]
         along = axes(:, place%d)/place%scale
         if (at(place%node) > 0) return
         nodes = [nodes, place%node]
         at(place%node) = size(nodes)
      end subroutine find_place

   end subroutine assemble

end module matrix_build
