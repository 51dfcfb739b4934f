!> Supports of the drilling rotation, that about the normal, at nodes of flat shells. The shells of NASTRAN have no stiffness there, so
!! that its decks hold component 6 of all nodes of a plate, and their answer does not depend on it. Here this rotation is that of the
!! membrane: held, it would forbid that the plate turns in its plane. Such a support has no effect where the node is held in no
!! direction of the plane; at an edge of symmetry it has one.
module drilling_supports
   use deck_check, only: checked_deck
   use kinds, only: wp
   use mesh_queries, only: element_points, is_shell, n_points, point_of
   use model_data, only: freedoms_type, mesh_type, n_bars
   use numbers, only: cross
   use surface_sides, only: nodes_of
   use text_tools, only: plural
   use tolerances, only: flat_shell
   use unknowns, only: component_place, node_axes, place_of_component
   implicit none
   private

   public :: free_drilling

contains

   !> Free the drilling rotations that supports hold at nodes of flat shells. They stay held where the node is held in the plane too,
   !! where the rotation is prescribed, and where something else has it: beams, rods with torsion, springs, rigid elements, equations,
   !! matrices, masses, a moment.
   subroutine free_drilling(deck, mesh, freedoms)
      type(checked_deck), intent(in)     :: deck
      type(mesh_type), intent(in)        :: mesh
      type(freedoms_type), intent(inout) :: freedoms
      type(component_place) :: place
      real(wp), allocatable :: normal(:, :) ! (3, points) of the shells at a node [-], 0: none, or not flat
      logical, allocatable  :: is_taken(:)
      real(wp) :: axes(3, 3)
      integer  :: d, k, n, node

      if (mesh%dimension < 3 .or. size(mesh%structural%place) == 0) return
      call find_normals(mesh, normal)
      call find_taken(deck, mesh, is_taken)
      n = 0
      do node = 1, n_points(mesh)
         if (is_taken(node) .or. .not. norm2(normal(:, node)) > 0.0_wp) cycle
         axes = node_axes(mesh, node)
         d = findloc(abs(matmul(normal(:, node), axes)) > 1.0_wp - flat_shell**2, .true., dim=1)
         if (d == 0) cycle
         if (any(freedoms%held(:, node) .and. [(k /= d, k = 1, 3)])) cycle
         place = place_of_component(mesh, node, d + 3)
         if (place%node == 0) cycle
         if (.not. freedoms%held(place%d, place%node) .or. mesh%duplicate(place%node) > 0) cycle
         if (freedoms%support_groups(freedoms%support_of(place%d, place%node))%kind == 'FREE') cycle
         freedoms%held(place%d, place%node) = .false.
         freedoms%support_of(place%d, place%node) = 0
         n = n + 1
      end do
      if (n > 0) call deck%errors%warn('supports hold the rotation about the normal at '//plural(n, 'node')// &
         ' of flat shells; as in NASTRAN, this has no effect where the node is held in no direction of their plane')
   end subroutine free_drilling

   !> The NORMAL of the shells at each point; none where they differ, where one is not flat, and where there are other elements.
   subroutine find_normals(mesh, normal)
      type(mesh_type), intent(in)        :: mesh
      real(wp), allocatable, intent(out) :: normal(:, :)
      logical  :: differs(n_points(mesh))
      real(wp) :: across(3)
      integer  :: e, i

      allocate (normal(3, n_points(mesh)), source=0.0_wp)
      differs = .false.
      do e = 1, mesh%n_elements
         associate (points => element_points(mesh, e))
            across = 0.0_wp
            if (is_shell(mesh, e)) then ! one with a membrane
               if (mesh%structural%shells(mesh%structural%place(e))%d(1, 1) > 0.0_wp) across = normal_of(mesh%x(:, points))
            end if
            do i = 1, size(points)
               associate (here => normal(:, points(i)))
                  differs(points(i)) = differs(points(i)) .or. .not. norm2(across) > 0.0_wp
                  if (norm2(here) > 0.0_wp) differs(points(i)) = differs(points(i)) .or. norm2(cross(here, across)) > flat_shell
                  here = across
               end associate
            end do
         end associate
      end do
      do i = 1, size(differs)
         if (differs(i)) normal(:, i) = 0.0_wp
      end do
   end subroutine find_normals

   !> The unit normal of a shell with nodes at X; zero where it is not flat.
   pure function normal_of(x) result(normal)
      real(wp), intent(in) :: x(:, :) !! (3, nodes), corners first [length]
      real(wp) :: normal(3)

      if (modulo(size(x, 2), 4) == 0) then
         normal = cross(x(:, 3) - x(:, 1), x(:, 4) - x(:, 2))
      else
         normal = cross(x(:, 2) - x(:, 1), x(:, 3) - x(:, 1))
      end if
      associate (area => norm2(normal))
         normal = normal/max(area, tiny(1.0_wp))
         if (any(abs(matmul(normal, x - spread(x(:, 1), 2, size(x, 2)))) > flat_shell*sqrt(area))) normal = 0.0_wp
      end associate
   end function normal_of

   !> Whether something beside shells and supports has the rotation of a node, or may have it.
   subroutine find_taken(deck, mesh, is_taken)
      type(checked_deck), intent(in)    :: deck
      type(mesh_type), intent(in)       :: mesh
      logical, allocatable, intent(out) :: is_taken(:)
      integer :: i, k

      allocate (is_taken(0:mesh%n_nodes), source=.false.)
      do i = 1, size(deck%bulk%spring)
         call take(deck%bulk%spring(i)%nodes)
      end do
      do i = 1, size(deck%bulk%equation)
         call take(deck%bulk%equation(i)%node)
      end do
      do i = 1, size(deck%rigid)
         call take([deck%rigid(i)%node, deck%rigid(i)%nodes])
         do k = 1, size(mesh%surfaces)
            if (deck%rigid(i)%surface > 0 .and. mesh%surfaces(k)%id == deck%rigid(i)%surface) &
               is_taken(nodes_of(mesh%surfaces(k))) = .true.
         end do
      end do
      do i = 1, size(mesh%masses)
         associate (mass => mesh%masses(i))
            if (any(abs(mass%inertia) > 0.0_wp)) is_taken(mass%node) = .true.
            if (allocated(mass%nodes)) is_taken([(point_of(mesh, mass%nodes(k)), k = 1, size(mass%nodes))]) = .true.
         end associate
      end do
      do i = 1, n_bars(mesh)
         if (mesh%bars(i)%torsion > 0.0_wp) is_taken(mesh%bars(i)%nodes) = .true.
         if (.not. allocated(mesh%bars(i)%of_matrix)) cycle
         is_taken([(point_of(mesh, mesh%bars(i)%of_matrix(k)), k = 1, size(mesh%bars(i)%of_matrix))]) = .true.
      end do
      call take(pack(deck%bulk%force%node, deck%bulk%force%is_moment))
      call take(deck%bulk%displacement%node)
      do i = 1, size(deck%bulk%support)
         if (abs(deck%bulk%support(i)%value) > 0.0_wp) call take(deck%bulk%support(i)%first)
      end do

   contains

      subroutine take(ids)
         integer, intent(in) :: ids(:)
         integer :: j

         do j = 1, size(ids)
            is_taken(mesh%node_table%find(ids(j))) = .true.
         end do
      end subroutine take

   end subroutine find_taken

end module drilling_supports
