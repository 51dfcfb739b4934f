!> Meshes of a few elements for tests: the patches of MacNeal and Harder, regular blocks, all of them of second order too; and
!! their dense stiffness.
!! Source: MacNeal, Harder, A proposed standard set of problems to test finite element accuracy, Finite Elements in Analysis
!! and Design 1 (1985) 3-20.
module patch_meshes
   use blas_lapack, only: dpotrf, dtrsm
   use element_kinds, only: element_table, kind_hexa8, kind_penta6, kind_pyram5, kind_quad4, kind_tetra4, kind_tria3, max_dofs, &
                            node_point
   use element_mapping, only: element_law
   use isoparametric, only: stiffness
   use kinds, only: wp
   implicit none
   private

   public :: block_mesh, dense_stiffness, inner_nodes, patch_mesh, solve_held

   type, public :: mesh_type
      integer :: kind = 0
      real(wp), allocatable :: x(:, :)      !! (dimension, nodes)
      integer, allocatable  :: cells(:, :)  !! (nodes of an element, elements)
   end type mesh_type

   real(wp), parameter :: in_plane(2, 8) = reshape([0.0_wp, 0.0_wp, 0.24_wp, 0.0_wp, 0.24_wp, 0.12_wp, 0.0_wp, 0.12_wp, &
      0.04_wp, 0.02_wp, 0.18_wp, 0.03_wp, 0.16_wp, 0.08_wp, 0.08_wp, 0.08_wp], [2, 8]) ! MacNeal and Harder
   integer, parameter  :: quads(4, 5) = reshape([1, 2, 6, 5, 2, 3, 7, 6, 3, 4, 8, 7, 4, 1, 5, 8, 5, 6, 7, 8], [4, 5])
   real(wp), parameter :: in_cube(3, 8) = reshape([0.249_wp, 0.342_wp, 0.192_wp, 0.826_wp, 0.288_wp, 0.288_wp, &
      0.850_wp, 0.649_wp, 0.263_wp, 0.273_wp, 0.750_wp, 0.230_wp, 0.320_wp, 0.186_wp, 0.643_wp, 0.677_wp, 0.305_wp, 0.683_wp, &
      0.788_wp, 0.693_wp, 0.644_wp, 0.165_wp, 0.745_wp, 0.702_wp], [3, 8])             ! MacNeal and Harder

contains

   !> A distorted patch of a kind, edges straight. Triangles: the quadrilaterals cut in two; wedges: these drawn out to two layers,
   !! the inner nodes between them moved; tetrahedra: the hexahedra each cut in twelve round a node of its own.
   pure type(mesh_type) function patch_mesh(kind) result(mesh)
      integer, intent(in) :: kind
      real(wp) :: x(3, 24)
      integer  :: triangles(3, 10), i, layer, side

      select case (element_table(kind)%linear)
      case (kind_quad4)
         mesh = mesh_type(kind_quad4, in_plane, quads)
      case (kind_tria3)
         mesh = mesh_type(kind_tria3, in_plane, cut_in_triangles(quads))
      case (kind_penta6)
         triangles = cut_in_triangles(quads)
         do layer = 0, 2
            do i = 1, 8
               x(:, 8*layer + i) = [in_plane(:, i), 0.1_wp*layer]
               if (layer == 1 .and. i > 4) x(:, 8 + i) = x(:, 8 + i) + 0.008_wp*[sin(1.0_wp*i), cos(2.0_wp*i), sin(3.0_wp*i)]
            end do
         end do
         mesh%kind = kind_penta6
         mesh%x = x
         allocate (mesh%cells(6, 20))
         do i = 1, 10
            mesh%cells(:, i) = [triangles(:, i), triangles(:, i) + 8]
            mesh%cells(:, 10 + i) = [triangles(:, i) + 8, triangles(:, i) + 16]
         end do
      case default
         allocate (mesh%cells(8, 7), mesh%x(3, 16))
         mesh%kind = kind_hexa8
         mesh%x(:, :8) = in_cube
         mesh%x(:, 9:) = 0.5_wp + 0.5_wp*node_point(:, :8, kind_hexa8)
         mesh%cells(:, 1) = [(i, i = 1, 8)]
         do side = 1, 6
            associate (face => element_table(kind_hexa8)%side_nodes(:4, side))
               mesh%cells(:, 1 + side) = [face, face + 8]
            end associate
         end do
         if (element_table(kind)%linear == kind_tetra4) call cut_in_tetrahedra(mesh)
         if (kind == kind_pyram5) call cut_in_pyramids(mesh)
      end select
      if (element_table(kind)%linear /= kind) call add_middles(kind, mesh)
   end function patch_mesh

   !> A block from 0 to 1 in every coordinate with N elements each way, triangles, wedges and tetrahedra by cutting its squares and
   !! cubes.
   pure type(mesh_type) function block_mesh(kind, n) result(mesh)
      integer, intent(in) :: kind
      integer, intent(in) :: n(3)           !! 0 along z in the plane
      integer, allocatable :: cells(:, :)
      integer :: c, i, j, k, linear

      linear = element_table(kind)%linear
      allocate (mesh%x(3, product(n + 1)), cells(8, n(1)*n(2)*max(n(3), 1)))
      mesh%kind = kind_hexa8
      do k = 0, n(3)
         do j = 0, n(2)
            do i = 0, n(1)
               mesh%x(:, place(i, j, k)) = real([i, j, k], wp)/max(n, 1)
            end do
         end do
      end do
      c = 0
      do k = 0, max(n(3), 1) - 1
         do j = 0, n(2) - 1
            do i = 0, n(1) - 1
               c = c + 1
               cells(:, c) = [place(i, j, k), place(i + 1, j, k), place(i + 1, j + 1, k), place(i, j + 1, k), &
                              place(i, j, k + 1), place(i + 1, j, k + 1), place(i + 1, j + 1, k + 1), place(i, j + 1, k + 1)]
            end do
         end do
      end do
      mesh%cells = cells
      select case (linear)
      case (kind_quad4)
         mesh = mesh_type(kind_quad4, mesh%x(:2, :), cells(:4, :))
      case (kind_tria3)
         mesh = mesh_type(kind_tria3, mesh%x(:2, :), cut_in_triangles(cells(:4, :)))
      case (kind_penta6)
         mesh = mesh_type(kind_penta6, mesh%x, reshape([cells([1, 2, 3, 5, 6, 7], :), cells([1, 3, 4, 5, 7, 8], :)], &
                                                       [6, 2*size(cells, 2)]))
      case (kind_pyram5)
         call cut_in_pyramids(mesh)
      case (kind_tetra4)
         call cut_in_tetrahedra(mesh)
      end select
      if (linear /= kind) call add_middles(kind, mesh)

   contains

      pure integer function place(i, j, k)
         integer, intent(in) :: i, j, k

         place = 1 + i + (n(1) + 1)*(j + (n(2) + 1)*k)
      end function place

   end function block_mesh

   !> Every quadrilateral of a mesh cut in two.
   pure function cut_in_triangles(cells) result(triangles)
      integer, intent(in) :: cells(:, :)
      integer :: triangles(3, 2*size(cells, 2))

      triangles(:, :size(cells, 2)) = cells([1, 2, 3], :)
      triangles(:, size(cells, 2) + 1:) = cells([1, 3, 4], :)
   end function cut_in_triangles

   !> Every hexahedron of MESH cut in twelve round a node of its own, faces along the diagonal through their lowest node.
   pure subroutine cut_in_tetrahedra(mesh)
      type(mesh_type), intent(inout) :: mesh
      integer  :: cells(4, 12*size(mesh%cells, 2)), face(4), c, m, n, side
      real(wp) :: centre(3, size(mesh%cells, 2))

      m = size(mesh%x, 2)
      n = 0
      do c = 1, size(mesh%cells, 2)
         centre(:, c) = sum(mesh%x(:, mesh%cells(:, c)), dim=2)/8.0_wp
         do side = 1, 6
            face = mesh%cells(element_table(kind_hexa8)%side_nodes(:4, side), c)
            face = cshift(face, minloc(face, dim=1) - 1)
            cells(:, n + 1) = [face([1, 3, 2]), m + c]
            cells(:, n + 2) = [face([1, 4, 3]), m + c]
            n = n + 2
         end do
      end do
      mesh = mesh_type(kind_tetra4, reshape([mesh%x, centre], [3, m + size(centre, 2)]), cells)
   end subroutine cut_in_tetrahedra

   !> Every hexahedron of MESH cut in six round a node of its own.
   pure subroutine cut_in_pyramids(mesh)
      type(mesh_type), intent(inout) :: mesh
      integer  :: cells(5, 6*size(mesh%cells, 2)), c, m, side
      real(wp) :: centre(3, size(mesh%cells, 2))

      m = size(mesh%x, 2)
      do c = 1, size(mesh%cells, 2)
         centre(:, c) = sum(mesh%x(:, mesh%cells(:, c)), dim=2)/8.0_wp
         do side = 1, 6
            cells(:, 6*(c - 1) + side) = [mesh%cells(element_table(kind_hexa8)%side_nodes(4:1:-1, side), c), m + c]
         end do
      end do
      mesh = mesh_type(kind_pyram5, reshape([mesh%x, centre], [3, m + size(centre, 2)]), cells)
   end subroutine cut_in_pyramids

   !> A node at the middle of every edge of a linear MESH.
   pure subroutine add_middles(kind, mesh)
      integer, intent(in)            :: kind !! the second-order kind
      type(mesh_type), intent(inout) :: mesh
      integer, allocatable  :: cells(:, :), ends(:, :)
      real(wp), allocatable :: x(:, :)
      integer :: c, corners, edge(2), k, m, n, node

      associate (entry => element_table(kind))
         corners = entry%n_corners
         m = size(mesh%x, 2)
         allocate (cells(entry%n_nodes, size(mesh%cells, 2)), ends(2, entry%n_edges*size(mesh%cells, 2)))
         cells(:corners, :) = mesh%cells
         n = 0
         do c = 1, size(cells, 2)
            do k = 1, entry%n_edges
               edge = cells(entry%edges(:, k), c)
               edge = [minval(edge), maxval(edge)]
               do node = 1, n
                  if (all(ends(:, node) == edge)) exit
               end do
               ends(:, node) = edge
               n = max(n, node)
               cells(corners + k, c) = m + node
            end do
         end do
      end associate
      allocate (x(size(mesh%x, 1), m + n))
      x(:, :m) = mesh%x
      x(:, m + 1:) = 0.5_wp*(mesh%x(:, ends(1, :n)) + mesh%x(:, ends(2, :n)))
      mesh = mesh_type(kind, x, cells)
   end subroutine add_middles

   !> Which nodes are on no side that one element alone has.
   pure function inner_nodes(mesh) result(inner)
      type(mesh_type), intent(in) :: mesh
      logical :: inner(size(mesh%x, 2))
      integer :: c, other, side, with

      inner = .true.
      associate (entry => element_table(mesh%kind))
         do c = 1, size(mesh%cells, 2)
            do side = 1, entry%n_sides
               associate (nodes => mesh%cells(entry%side_nodes(:entry%side_size(side), side), c))
                  with = 0
                  do other = 1, size(mesh%cells, 2)
                     if (has_all(mesh%cells(:, other), nodes)) with = with + 1
                  end do
                  if (with == 1) inner(nodes) = .false.
               end associate
            end do
         end do
      end associate
   end function inner_nodes

   pure logical function has_all(cell, nodes)
      integer, intent(in) :: cell(:), nodes(:)
      integer :: i

      has_all = .false.
      do i = 1, size(nodes)
         if (all(cell /= nodes(i))) return
      end do
      has_all = .true.
   end function has_all

   !> The stiffness of all elements of MESH, components of node 1 first.
   pure subroutine dense_stiffness(law, mesh, k)
      type(element_law), intent(in)      :: law
      type(mesh_type), intent(in)        :: mesh
      real(wp), allocatable, intent(out) :: k(:, :)
      real(wp) :: own(max_dofs, max_dofs)
      integer  :: c, d, i, j, n, rows(max_dofs)

      d = size(mesh%x, 1)
      allocate (k(size(mesh%x), size(mesh%x)), source=0.0_wp)
      n = size(mesh%cells, 1)
      do c = 1, size(mesh%cells, 2)
         call stiffness(law, mesh%x(:, mesh%cells(:, c)), own)
         rows(:d*n) = [((d*(mesh%cells(i, c) - 1) + j, j = 1, d), i = 1, n)]
         k(rows(:d*n), rows(:d*n)) = k(rows(:d*n), rows(:d*n)) + own(:d*n, :d*n)
      end do
   end subroutine dense_stiffness

   !> Solve K u = F with the components HELD kept at what U says.
   subroutine solve_held(k, f, held, u)
      real(wp), intent(in)    :: k(:, :), f(:)
      logical, intent(in)     :: held(:)
      real(wp), intent(inout) :: u(:)
      real(wp), allocatable :: a(:, :), b(:)
      integer, allocatable  :: free(:)
      integer :: i, info

      free = pack([(i, i = 1, size(u))], .not. held)
      where (.not. held) u = 0.0_wp
      a = k(free, free)
      b = f(free) - matmul(k(free, :), u)
      call dpotrf('L', size(free), a, size(free), info)
      if (info /= 0) error stop 'the structure is not held'
      call dtrsm('L', 'L', 'N', 'N', size(free), 1, 1.0_wp, a, size(free), b, size(free))
      call dtrsm('L', 'L', 'T', 'N', size(free), 1, 1.0_wp, a, size(free), b, size(free))
      u(free) = b
   end subroutine solve_held

end module patch_meshes
