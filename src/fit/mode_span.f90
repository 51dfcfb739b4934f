!> Frequencies of a structure from the modes that it has at the ends of its stages, where only the stiffness of its joints differs:
!! by Rayleigh and Ritz in the space of all these modes, which have the joints at several preloads,
!!
!!      [K + B^T dk B] {x} = omega^2 {x},   B the movements of the interface elements in a basis of this space, orthonormal in [m]
!!
!! The error of a frequency is of second order in the part of its shape that the space lacks. K of a stage needs no element: a mode
!! phi of any stage has [k] phi = lambda [m] phi there, and between stages only joints and bolts differ.
!!
!! Modes of a run in full begin with those of the last one, by inverse iteration with the factor that the increments have.
module mode_span
   use analysis_state, only: analysis_type
   use blas_lapack, only: dsygv
   use eigenpairs, only: find_eigenpairs, improve_eigenpairs, needs_all
   use equation_solver, only: equation_system, failure_type
   use equations, only: add_bar, form_structure_stiffness, lock_unknown
   use interface_operator, only: joint_movement
   use joint_laws, only: stiffness_matrices
   use kinds, only: wp
   use mass_matrix, only: mass_matrix_type, mass_times
   use model_data, only: model_type, n_bars, n_sections
   use natural_modes, only: beyond, spectrum_type
   use oscillating_structure, only: oscillating_type
   use structural_elements, only: add_bar_forces
   use tolerances, only: barely_held, in_the_span
   implicit none
   private

   public :: find_modes_again, span_modes, find_spanned, spanned

   !> The modes of a stage, and what the modes of all stages are in it.
   type, public :: stage_modes
      logical :: is_free = .false.             !! without supports
      logical, allocatable  :: is_elastic(:), is_locked(:) !! bars, pretension sections
      integer :: n_before = 0                  !! modes below the range
      real(wp), allocatable :: lambda(:)       !! (modes) omega^2 [1/time^2]; not allocated: none
      real(wp), allocatable :: u(:, :)         !! (components of all nodes, modes) of generalised mass 1
      real(wp), allocatable :: k(:)            !! (4 n) SPANNED stiffness of the interface elements under oscillation [force/length]
      real(wp), allocatable :: reduced(:, :)   !! (basis, basis) [K]
      real(wp), allocatable :: moved(:, :)     !! (4 n, basis) [B]
      real(wp), allocatable :: place(:, :)     !! (basis, modes) components of the modes of this stage
   end type stage_modes

contains

   !> The N lowest modes of STRUCTURE without shift, in the numbering of SHIFTED: the equations SYSTEM of the increments, whose
   !! bodies are condensed, with the joints under oscillation. From shapes NEAR by subspace iteration until N_SURE of them are
   !! settled, else by the Lanczos method. IS_FOUND: false where the structure is not held, or is small.
   subroutine find_modes_again(model, analysis, system, structure, near, n_sure, n, spectrum, shifted, is_found)
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      class(equation_system), intent(in) :: system
      type(oscillating_type), intent(in) :: structure
      real(wp), intent(in)               :: near(:, :) !! (components of all nodes, modes; 0: none) [length]
      integer, intent(in)                :: n
      integer, intent(inout)             :: n_sure     !! N by Lanczos
      type(spectrum_type), intent(out)   :: spectrum
      class(equation_system), allocatable, intent(out) :: shifted
      logical, intent(out)               :: is_found
      type(failure_type) :: failure
      integer :: i

      is_found = .false.
      if (needs_all(system, n)) return
      allocate (shifted, source=system)
      do i = 1, n_bars(model%mesh)
         if (structure%is_elastic(i) .and. .not. analysis%is_elastic(i)) call add_bar(model, i, shifted)
      end do
      do i = 1, n_sections(model%mesh)
         if (structure%is_locked(i) .and. .not. analysis%is_locked(i)) call lock_unknown(model%mesh%sections(i)%node, 1, shifted)
      end do
      call form_structure_stiffness(model, stiffness_matrices(structure%k), 'natural modes', shifted, failure)
      if (failure%raised) return
      if (shifted%weakest < barely_held) return
      if (size(near, 2) >= n) call improve_eigenpairs(model, structure%mass, shifted, near, n_sure, structure%tolerance, &
                                                      spectrum%lambda, spectrum%x, is_found)
      if (.not. is_found) then
         call find_eigenpairs(model, structure%mass, shifted, n + beyond, structure%tolerance, spectrum%lambda, spectrum%x, failure)
         n_sure = n
      end if
      is_found = .not. failure%raised
      if (is_found) spectrum%n_wanted = min(n, size(spectrum%lambda))
   end subroutine find_modes_again

   !> Fill [K], [B] and the places of the STAGES that have modes. A stage shares the modes of those with the same supports and
   !! pretension sections held.
   subroutine span_modes(model, mass, stages)
      type(model_type), intent(in)       :: model
      type(mass_matrix_type), intent(in) :: mass
      type(stage_modes), intent(inout)   :: stages(:)
      real(wp), allocatable :: b(:, :), f(:, :), g(:, :), k(:, :), m(:, :), nu(:), t(:, :), u(:, :), unit(:, :), v(:, :), work(:)
      integer, allocatable  :: of(:)
      real(wp) :: movement(3)
      integer :: d, i, info, j, n, own, s

      d = model%mesh%dimension
      do s = 1, size(stages)
         if (.not. allocated(stages(s)%lambda)) cycle
         if (size(stages(s)%lambda) == 0) cycle
         of = spread(s, 1, size(stages(s)%lambda)) ! its own first: without a change of the joints they are exact
         do i = 1, size(stages)
            if (i == s .or. .not. allocated(stages(i)%lambda)) cycle
            if ((stages(i)%is_free .eqv. stages(s)%is_free) .and. all(stages(i)%is_locked .eqv. stages(s)%is_locked)) &
               of = [of, spread(i, 1, size(stages(i)%lambda))]
         end do
         n = size(of)
         allocate (v(size(stages(s)%u, 1), n), b(size(stages(s)%k), n), k(n, n), m(n, n), nu(n), work(34*n))
         allocate (u(d, size(v, 1)/d), f(d, size(v, 1)/d))
         do j = 1, n
            i = count(of(:j) == of(j))
            v(:, j) = stages(of(j))%u(:, i)
            nu(j) = stages(of(j))%lambda(i)
            u = reshape(v(:, j), shape(u))
            do i = 1, size(model%joints%element)
               movement = joint_movement(model%joints%element(i), u)
               b(4*i - 3:4*i, j) = [movement, movement(1) + movement(2)]
            end do
         end do
         do j = 1, n
            u = reshape(v(:, j), shape(u))
            call mass_times(model, mass, u, f)
            m(:, j) = matmul(reshape(f, [size(f)]), v)
            f = 0.0_wp
            call add_bar_forces(model, stages(of(j))%is_elastic, u, f)
            f = -f
            call add_bar_forces(model, stages(s)%is_elastic, u, f)
            k(:, j) = nu(j)*m(:, j) + matmul(reshape(f, [size(f)]), v) + matmul((stages(s)%k - stages(of(j))%k)*b(:, j), b)
         end do
         own = size(stages(s)%lambda)
         t = identity(n)
         i = 0
         if (n > own) then ! what the modes of other stages have beside, in combinations that are orthonormal
            g = m(own + 1:, own + 1:) - matmul(m(own + 1:, :own), m(:own, own + 1:))
            unit = identity(n - own)
            call dsygv(1, 'V', 'U', n - own, g, n - own, unit, n - own, nu, work, size(work), info)
            i = count(nu(:n - own) > in_the_span)
            g = g(:, n - own - i + 1:)/spread(sqrt(nu(n - own - i + 1:n - own)), 1, n - own)
            t(own + 1:, own + 1:own + i) = g
            t(:own, own + 1:own + i) = -matmul(m(:own, own + 1:), g)
         end if
         associate (basis => t(:, :own + i))
            stages(s)%reduced = 0.5_wp*matmul(transpose(basis), matmul(k + transpose(k), basis))
            stages(s)%moved = matmul(b, basis)
            stages(s)%place = matmul(transpose(basis), m(:, :own))
         end associate
         deallocate (b, f, k, m, nu, t, u, v, work)
      end do
   end subroutine span_modes

   !> The stiffness K of interface elements as four springs each: along x, y, the normal, and x and y together, which have k_sxy.
   pure function spanned(k) result(springs)
      real(wp), intent(in) :: k(:, :) !! (4, n) k_sx, k_sy, k_n, k_sxy [force/length]
      real(wp) :: springs(size(k))
      integer :: i

      springs = [(k(:3, i) - k(4, i)*[1.0_wp, 1.0_wp, 0.0_wp], k(4, i), i = 1, size(k, 2))]
   end function spanned

   !> LAMBDA, omega^2 of the modes of STAGE where its interface elements have the stiffness K, each mode the one most like it.
   subroutine find_spanned(stage, k, lambda)
      type(stage_modes), intent(in) :: stage
      real(wp), intent(in)          :: k(:)      !! (4 n) SPANNED [force/length]
      real(wp), intent(out)         :: lambda(:) !! (modes) [1/time^2]
      real(wp), dimension(size(stage%reduced, 1), size(stage%reduced, 1)) :: a, unit
      real(wp) :: mu(size(a, 1)), work(34*size(a, 1))
      integer  :: i, info, n

      n = size(a, 1)
      a = stage%reduced + matmul(transpose(stage%moved), spread(k - stage%k, 2, n)*stage%moved)
      unit = identity(n)
      call dsygv(1, 'V', 'U', n, a, n, unit, n, mu, work, size(work), info)
      do i = 1, size(lambda)
         lambda(i) = mu(maxloc(abs(matmul(stage%place(:, i), a)), dim=1))
      end do
   end subroutine find_spanned

   pure function identity(n) result(unit)
      integer, intent(in) :: n
      real(wp) :: unit(n, n)
      integer  :: i

      unit = 0.0_wp
      do i = 1, n
         unit(i, i) = 1.0_wp
      end do
   end function identity

end module mode_span
