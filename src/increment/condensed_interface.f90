!> The stiffness [k_b] condensed on the joint unknowns, with any solver, for the listing of a small model. With it an increment
!! can be done by hand.
module condensed_interface
   use blas_lapack, only: dpotrf, dtrsm
   use equation_solver, only: equation_system
   use interface_operator, only: nodes_of_end
   use kinds, only: wp
   use model_data, only: model_type
   use node_coupling, only: unknown_nodes
   use text_tools, only: integer_text
   implicit none
   private

   public :: condense_on_joints

   integer, parameter :: most_unknowns = 40    ! limit of a page
   integer, parameter :: most_equations = 3000 ! limit of the condensation as a full matrix

   type, public :: condensed_type
      character(:), allocatable :: problem        !! reason why there is no matrix; '': there is one
      integer, allocatable  :: node(:)            !! (n) positions, joint after joint, side 1 before side 2
      integer, allocatable  :: direction(:)       !! (n) 1, 2, 3
      real(wp), allocatable :: k(:, :)            !! (n, n) [force/length]
      real(wp), allocatable :: load(:, :)         !! (n, 2) at the start of the stage and at its end [force]
   end type condensed_type

contains

   !> [k_b] and the condensed loads LOAD_BEFORE and LOAD_AFTER on the free joint unknowns: K_jj - K_jg K_gg^-1 K_gj and f_j -
   !! K_jg K_gg^-1 f_g, g the other unknowns, with the Cholesky factor of K_gg.
   subroutine condense_on_joints(model, system, load_before, load_after, condensed)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      real(wp), intent(in)               :: load_before(:, :), load_after(:, :) !! (dimension, retained) [force]
      type(condensed_type), intent(out)  :: condensed
      real(wp), allocatable :: k(:, :), load(:, :), x(:), y(:)
      integer, allocatable  :: joints(:), gone(:), order(:)
      integer :: i, info, m, n

      call find_unknowns(model, system, joints, gone)
      n = size(joints)
      m = size(gone)
      condensed%problem = ''
      if (n > most_unknowns) then
         condensed%problem = integer_text(n)//' unknowns of joints; at most '//integer_text(most_unknowns)//' are shown'
      else if (n + m > most_equations) then
         condensed%problem = integer_text(n + m)//' equations are left, more than '//integer_text(most_equations)// &
                             '; SOLVER = TREE leaves fewer'
      else if (n == 0) then
         condensed%problem = 'no unknown of a joint is free'
      end if
      if (condensed%problem /= '') return
      condensed%node = system%node(joints)
      condensed%direction = system%direction(joints)
      order = [joints, gone]
      allocate (k(n + m, n + m), load(n + m, 2), x(system%n), y(system%n), source=0.0_wp)
      do i = 1, n + m
         associate (d => system%direction(order(i)), node => system%retained_index(system%node(order(i))))
            load(i, :) = [load_before(d, node), load_after(d, node)]
         end associate
         x(order(i)) = 1.0_wp
         call system%multiply(x, y)
         k(:, i) = y(order)
         x(order(i)) = 0.0_wp
      end do
      if (m > 0) then
         call dpotrf('L', m, k(n + 1, n + 1), n + m, info)
         if (info /= 0) then
            condensed%problem = 'the bodies move without their joints'
            return
         end if
         call dtrsm('L', 'L', 'N', 'N', m, n, 1.0_wp, k(n + 1, n + 1), n + m, k(n + 1, 1), n + m)
         call dtrsm('L', 'L', 'N', 'N', m, 2, 1.0_wp, k(n + 1, n + 1), n + m, load(n + 1, 1), n + m)
      end if
      condensed%k = k(:n, :n) - matmul(transpose(k(n + 1:, :n)), k(n + 1:, :n))
      condensed%load = load(:n, :) - matmul(transpose(k(n + 1:, :n)), load(n + 1:, :))
   end subroutine condense_on_joints

   !> The equations of the JOINTS, joint after joint, side 1 before side 2, node after node, and the condensed ones, GONE.
   pure subroutine find_unknowns(model, system, joints, gone)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      integer, allocatable, intent(out)  :: joints(:), gone(:)
      integer, allocatable :: equations(:)
      logical :: is_open(system%n) ! solved for and not yet listed
      integer :: end, i, j, k

      is_open = .false.
      is_open(system%equations) = .true.
      is_open(system%locked) = .false.
      allocate (joints(0))
      do j = 1, size(model%joints%list)
         do end = 1, 2
            do i = model%joints%list(j)%first, model%joints%list(j)%last
               equations = [system%number(:, unknown_nodes(model%freedoms, nodes_of_end(model%joints%element(i), end)))]
               equations = pack(equations, equations > 0)
               do k = 1, size(equations)
                  if (is_open(equations(k))) joints = [joints, equations(k)]
                  is_open(equations(k)) = .false.
               end do
            end do
         end do
      end do
      allocate (gone, source=pack([(i, i = 1, system%n)], is_open))
   end subroutine find_unknowns

end module condensed_interface
