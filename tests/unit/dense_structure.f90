!> The stiffness and the mass of a whole structure as dense matrices, solved and condensed by LAPACK: what the solvers are compared with.
!! Row (node - 1) dimension + direction, held components and all.
module dense_structure
   use body_elements, only: coupled_stiffness, law_of
   use element_kinds, only: max_nodes
   use isoparametric, only: lump, shape_products
   use kinds, only: wp
   use mesh_queries, only: element_points
   use model_data, only: model_type, n_bars
   implicit none
   private

   public :: dense_bodies, dense_joints, dense_mass, free_rows, solve_dense, condense_dense

   interface
      subroutine dposv(uplo, n, nrhs, a, lda, b, ldb, info)
         import :: wp
         character(1), intent(in) :: uplo
         integer, intent(in)      :: n, nrhs, lda, ldb
         real(wp), intent(inout)  :: a(lda, *), b(ldb, *)
         integer, intent(out)     :: info
      end subroutine dposv
   end interface

contains

   !> Elements, and bars that are no bolts.
   function dense_bodies(model) result(k)
      type(model_type), intent(in) :: model
      real(wp), allocatable :: k(:, :)
      real(wp), allocatable :: k_e(:, :)
      real(wp) :: end_directions(2*model%mesh%dimension)
      integer  :: e, i

      allocate (k(model%mesh%dimension*model%mesh%n_nodes, model%mesh%dimension*model%mesh%n_nodes), source=0.0_wp)
      do e = 1, model%mesh%n_elements
         call coupled_stiffness(model, e, k_e)
         call add(rows_of(model, element_points(model%mesh, e)), k_e)
      end do
      do i = 1, n_bars(model%mesh)
         if (model%mesh%bars(i)%bolt > 0) cycle
         associate (d => model%mesh%dimension, bar => model%mesh%bars(i))
            end_directions(:d) = bar%direction(:d, 1)
            end_directions(d + 1:) = -bar%direction(:d, 2)
            call add(rows_of(model, bar%nodes), bar%stiffness*matmul(reshape(end_directions, [2*d, 1]), reshape(end_directions, &
               [1, 2*d])))
         end associate
      end do

   contains

      subroutine add(rows, part)
         integer, intent(in)  :: rows(:)
         real(wp), intent(in) :: part(:, :)
         integer :: j, m

         m = size(rows)
         do j = 1, m
            k(rows, rows(j)) = k(rows, rows(j)) + part(:m, j)
         end do
      end subroutine add

   end function dense_bodies

   !> Elements, bars, and masses at nodes; no inertia of rotations, no sections.
   function dense_mass(model) result(m)
      type(model_type), intent(in) :: model
      real(wp), allocatable :: m(:, :)
      real(wp) :: m_e(max_nodes, max_nodes)
      integer  :: c, e, i

      allocate (m(model%mesh%dimension*model%mesh%n_nodes, model%mesh%dimension*model%mesh%n_nodes), source=0.0_wp)
      do e = 1, model%mesh%n_elements
         associate (corners => element_points(model%mesh, e))
            call shape_products(law_of(model%mesh, e), model%mesh%x(:model%mesh%dimension, corners), m_e)
            associate (n => size(corners))
               m_e(:n, :n) = model%mesh%properties(model%mesh%element_property(e))%rho*m_e(:n, :n)
               if (model%mesh%lumped) call lump(m_e(:n, :n))
            end associate
            call add(corners, m_e)
         end associate
      end do
      do i = 1, n_bars(model%mesh)
         m_e(:2, :2) = reshape([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp], [2, 2])*model%mesh%bars(i)%mass/6.0_wp
         if (model%mesh%lumped) m_e(:2, :2) = reshape([3.0_wp, 0.0_wp, 0.0_wp, 3.0_wp], [2, 2])*model%mesh%bars(i)%mass/6.0_wp
         if (model%mesh%bars(i)%mass > 0.0_wp) call add(model%mesh%bars(i)%nodes, m_e)
      end do
      do i = 1, size(model%mesh%masses)
         m_e(1, 1) = model%mesh%masses(i)%mass
         call add([model%mesh%masses(i)%node], m_e)
      end do

   contains

      !> PART between NODES, the same for every component.
      subroutine add(nodes, part)
         integer, intent(in)  :: nodes(:)
         real(wp), intent(in) :: part(:, :)
         integer :: j

         do j = 1, size(nodes)
            do c = 1, model%mesh%dimension
               associate (d => model%mesh%dimension)
                  m(d*(nodes - 1) + c, d*(nodes(j) - 1) + c) = m(d*(nodes - 1) + c, d*(nodes(j) - 1) + c) + part(:size(nodes), j)
               end associate
            end do
         end do
      end subroutine add

   end function dense_mass

   !> Interface elements with the stiffnesses K_INT in their axes.
   function dense_joints(model, k_int) result(k)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: k_int(:, :, :) !! (3, 3, n)
      real(wp), allocatable :: k(:, :)
      real(wp), allocatable :: movement(:, :) ! (3, rows) in the axes, of the nodes' displacements
      integer  :: a, i
      integer, allocatable :: rows(:)

      allocate (k(model%mesh%dimension*model%mesh%n_nodes, model%mesh%dimension*model%mesh%n_nodes), source=0.0_wp)
      do i = 1, size(model%joints%element)
         associate (d => model%mesh%dimension, element => model%joints%element(i))
            rows = rows_of(model, element%node)
            allocate (movement(3, size(rows)))
            do a = 1, size(element%node)
               movement(:, d*(a - 1) + 1:d*a) = element%weight(a)*transpose(element%axes(:d, :))
            end do
            k(rows, rows) = k(rows, rows) + matmul(transpose(movement), matmul(k_int(:, :, i), movement))
            deallocate (movement)
         end associate
      end do
   end function dense_joints

   pure function rows_of(model, nodes) result(rows)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: nodes(:)
      integer :: rows(model%mesh%dimension*size(nodes)), d, i

      do i = 1, size(nodes)
         rows(model%mesh%dimension*(i - 1) + 1:model%mesh%dimension*i) = [(model%mesh%dimension*(nodes(i) - 1) + d, d = 1, &
            model%mesh%dimension)]
      end do
   end function rows_of

   !> The rows of components that are neither held nor without an element.
   pure function free_rows(model) result(rows)
      type(model_type), intent(in) :: model
      integer, allocatable :: rows(:)
      logical :: is_free(model%mesh%dimension, model%mesh%n_nodes)
      integer :: i

      do i = 1, model%mesh%n_nodes
         is_free(:, i) = .not. model%freedoms%held(:, i) .and. model%freedoms%used(i)
      end do
      allocate (rows, source=pack([(i, i = 1, size(is_free))], reshape(is_free, [size(is_free)])))
   end function free_rows

   !> X: K(ROWS, ROWS) X(ROWS) = F(ROWS), zero elsewhere.
   function solve_dense(k, rows, f) result(x)
      real(wp), intent(in) :: k(:, :), f(:)
      integer, intent(in)  :: rows(:)
      real(wp), allocatable :: x(:), a(:, :), b(:, :)
      integer :: info

      allocate (a, source=k(rows, rows))
      allocate (b, source=reshape(f(rows), [size(rows), 1]))
      info = 0
      if (size(rows) > 0) call dposv('U', size(rows), 1, a, size(rows), b, size(rows), info)
      if (info /= 0) b = huge(b)
      allocate (x(size(f)), source=0.0_wp)
      x(rows) = b(:, 1)
   end function solve_dense

   !> A(:, :n): K(KEPT, KEPT) - K(KEPT, GONE) K(GONE, GONE)^-1 K(GONE, KEPT); A(:, n + 1): F condensed likewise.
   function condense_dense(k, kept, gone, f) result(a)
      real(wp), intent(in) :: k(:, :), f(:)
      integer, intent(in)  :: kept(:), gone(:)
      real(wp), allocatable :: a(:, :), square(:, :), b(:, :)
      integer :: info, n

      n = size(kept)
      allocate (a(n, n + 1))
      a(:, :n) = k(kept, kept)
      a(:, n + 1) = f(kept)
      if (size(gone) == 0) return
      allocate (square, source=k(gone, gone))
      allocate (b(size(gone), n + 1))
      b(:, :n) = k(gone, kept)
      b(:, n + 1) = f(gone)
      call dposv('U', size(gone), n + 1, square, size(gone), b, size(gone), info)
      if (info /= 0) b = huge(b)
      a = a - matmul(k(kept, gone), b)
   end function condense_dense

end module dense_structure
