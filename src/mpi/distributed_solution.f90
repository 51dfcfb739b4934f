!> Solves the distributed equations with PETSc: conjugate gradients preconditioned by GAMG or by a MUMPS factor.
!! GAMG is smoothed aggregation with the rigid-body modes as near-null space. The first guess is the sum of earlier solutions with
!! the least energy. The preconditioner of an earlier stiffness is kept while that pays. All processes call every routine together.
!! Source: Adams, Bayraktar, Keaveny, Papadopoulos, Proc. SC2004; Amestoy et al., SIAM J. Matrix Anal. Appl. 23 (2001) 15-41.
!! First guess: Fischer, Comput. Methods Appl. Mech. Engrg. 163 (1998) 193-204.
module distributed_solution
   use distributed_matrix, only: distributed_matrix_type, drop_copy, put_vector, take_vector
   use factor_reuse, only: find_least_energy
   use kinds, only: wp
   use petscksp
   use ranks, only: n_ranks
   use tolerances, only: krylov_residual, loosest_residual, no_residual
   implicit none
   private

   public :: forget_vectors, renew_preconditioner, solve_distributed, free_solution, set_library_options

   integer, parameter :: most = 6                    !! earlier solutions kept

   type, public :: earlier_vectors_type
      integer :: n = 0                                ! number kept, the last one first
      type(tVec) :: u(most)
   end type earlier_vectors_type

   integer, parameter, public :: by_gamg = 1, by_mumps = 2

   type, public :: distributed_solution_type
      type(tKSP) :: solver
      logical  :: has_solver = .false.
      integer  :: way = by_gamg                !! or by_mumps
      type(earlier_vectors_type) :: earlier    !! solutions for the first guess
      integer  :: steps = 0                    !! number in the last solution
      real(wp) :: residual = 0.0_wp            !! of the last solution, as a fraction of the load
      real(wp) :: gained = 0.0_wp              !! digits by which the steps reduced the residual
      logical  :: converged = .true.
      logical  :: has_memory = .true.          !! MUMPS: for the factor
   end type distributed_solution_type

   integer, parameter  :: most_steps = 500
   integer, parameter, public :: no_limit = huge(1) !! no limit on the steps of a solution
   integer, parameter  :: lean_from = 600000     !! rows of a process, from which on the set-up of several takes a fifth less
                                                 !! memory, and several times longer
   integer, parameter  :: most_solutions = 3     !! at most, each from the result of the one before
   integer :: code                               ! of PETSc, see end_at_error

contains

   subroutine forget_vectors(earlier)
      type(earlier_vectors_type), intent(inout) :: earlier
      integer :: i

      do i = 1, earlier%n
         call VecDestroy(earlier%u(i), code)
      end do
      earlier%n = 0
   end subroutine forget_vectors

   !> Set the options of the solver. This precedes the start of the library, so that the user's options (PETSC_OPTIONS) override
   !! them.
   subroutine set_library_options()
      call set_option('-jointfem_ksp_type', 'cg')
      call set_option('-jointfem_ksp_norm_type', 'unpreconditioned')
      call set_option('-jointfem_ksp_initial_guess_nonzero', '1')
      call set_option('-jointfem_pc_gamg_threshold', '0.01')
      call set_option('-jointfem_mg_levels_ksp_type', 'chebyshev')
      call set_option('-jointfem_mg_levels_pc_type', 'jacobi')
      call set_option('-jointfem_mg_levels_ksp_chebyshev_esteig', '0,0.05,0,1.1')
      call set_option('-jointfem_pc_gamg_use_sa_esteig', '0') ! those bounds are of the stiffness of the aggregates
      call set_option('-jointfem_pc_gamg_agg_nsmooths', '1')
      call set_option('-mat_product_clear', 'true') ! return the work space of matrix products at once
   end subroutine set_library_options

   subroutine set_option(name, value)
      character(*), intent(in) :: name, value

      call PetscOptionsSetValue(PETSC_NULL_OPTIONS, name, value, code)
   end subroutine set_option

   !> Build a solver with a preconditioner of the present stiffness. The old preconditioner and the copy for products are freed
   !! first.
   subroutine renew_preconditioner(stiffness, solution)
      type(distributed_matrix_type), intent(inout)   :: stiffness
      type(distributed_solution_type), intent(inout) :: solution
      type(tPC)  :: preconditioner
      type(tKSP) :: smoother
      integer    :: levels, reason

      if (solution%has_solver) call KSPDestroy(solution%solver, code)
      call drop_copy(stiffness)
      associate (ksp => solution%solver)
         call KSPCreate(PETSC_COMM_WORLD, ksp, code)
         solution%has_solver = .true.
         call KSPSetOptionsPrefix(ksp, 'jointfem_', code)
         call KSPSetOperators(ksp, stiffness%matrix, stiffness%matrix, code)
         call KSPGetPC(ksp, preconditioner, code)
         if (solution%way == by_gamg) then
            call PCSetType(preconditioner, 'gamg', code)
         else
            call PCSetType(preconditioner, 'cholesky', code)
            call PCFactorSetMatSolverType(preconditioner, 'mumps', code)
         end if
         call KSPSetTolerances(ksp, krylov_residual, no_residual, 1.0e5_wp, most_steps, code)
         call KSPSetFromOptions(ksp, code)
         if (n_ranks > 1 .and. sum(stiffness%counts) > n_ranks*lean_from) call set_option('-matptap_via', 'allatonce')
         call KSPSetUp(ksp, code)
         call KSPSetReusePreconditioner(ksp, PETSC_TRUE, code)
         call PCGetFailedReason(preconditioner, reason, code)
         solution%has_memory = reason /= PC_FACTOR_OUTMEMORY
         if (solution%way /= by_gamg) return
         call PCMGGetLevels(preconditioner, levels, code)
         if (levels < 2) return                 ! the finest level is the coarsest: a factor

         ! from now on the steps and the finest level multiply by the blocks on and above the diagonal, which take half the memory
         ! of the matrix and multiply a vector in a quarter of the time
         call MatConvert(stiffness%matrix, 'sbaij', MAT_INITIAL_MATRIX, stiffness%products, code)
         call MatSetOption(stiffness%products, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE, code)
         stiffness%has_copy = .true.
         call PCMGGetSmoother(preconditioner, levels - 1, smoother, code)
         call KSPSetOperators(smoother, stiffness%products, stiffness%matrix, code)
         call PCMGSetResidual(preconditioner, levels - 1, PCMGResidualDefault, stiffness%products, code)
         call KSPSetOperators(ksp, stiffness%products, stiffness%matrix, code)
      end associate
   end subroutine renew_preconditioner

   !> Replace the load X of rank 0, row after row, by the solution. HOW: digits, most steps at a time, and 1 where later solutions
   !! use this one for their first guess. STEPS, RESIDUAL and CONVERGED are results.
   subroutine solve_distributed(how, stiffness, solution, x)
      integer, intent(in)                            :: how(3)
      type(distributed_matrix_type), intent(in)      :: stiffness
      type(distributed_solution_type), intent(inout) :: solution
      real(wp), intent(inout)                        :: x(:)
      real(wp), dimension(solution%earlier%n) :: factor, work
      real(wp) :: energy(solution%earlier%n, solution%earlier%n)
      integer  :: again, i, reason, steps, usual
      real(wp) :: first, load, left, tolerance
      real(wp) :: relative, absolute, divergence ! limits in use: those of this routine, or the user's (PETSC_OPTIONS)

      tolerance = 10.0_wp**(-how(1))
      call put_vector(x, stiffness, stiffness%b)
      call KSPGetTolerances(solution%solver, relative, absolute, divergence, usual, code)
      call KSPSetTolerances(solution%solver, tolerance, absolute, divergence, min(usual, how(2)), code)
      call VecNorm(stiffness%b, NORM_2, load, code)
      solution%steps = 0
      solution%residual = 0.0_wp
      solution%gained = 0.0_wp
      solution%converged = .true.
      call VecScale(stiffness%x, 0.0_wp, code)
      associate (earlier => solution%earlier)
         if (load > 0.0_wp) then
            ! the first guess: of all sums of earlier solutions the one with the least energy x'[k] x/2 - b'x
            do i = 1, earlier%n
               call MatMult(stiffness%products, earlier%u(i), stiffness%r, code)
               call VecMDot(stiffness%r, earlier%n, earlier%u, energy(:, i), code)
            end do
            call VecMDot(stiffness%b, earlier%n, earlier%u, work, code)
            call find_least_energy(energy, work, factor)
            call VecMAXPY(stiffness%x, earlier%n, factor, earlier%u, code)
            call find_residual(stiffness, first)
            do again = 1, most_solutions            ! the recursive residual drifts from the true one
               call KSPSolve(solution%solver, stiffness%b, stiffness%x, code)
               call KSPGetIterationNumber(solution%solver, steps, code)
               call KSPGetConvergedReason(solution%solver, reason, code)
               solution%steps = solution%steps + steps
               call find_residual(stiffness, left)
               solution%residual = left/load
               if (reason <= 0 .or. solution%residual <= 10.0_wp*tolerance) exit
            end do
            if (left > 0.0_wp .and. first > left) solution%gained = log10(first/left)
            solution%converged = solution%residual <= max(loosest_residual, 10.0_wp*tolerance)
         end if
         if (load > 0.0_wp .and. solution%converged .and. how(3) == 1) then ! keep the solution in place of the oldest one
            if (earlier%n < most) then
               earlier%n = earlier%n + 1
               call VecDuplicate(stiffness%x, earlier%u(earlier%n), code)
            end if
            earlier%u(:earlier%n) = cshift(earlier%u(:earlier%n), -1)
            call VecCopy(stiffness%x, earlier%u(1), code)
         end if
      end associate
      call KSPSetTolerances(solution%solver, relative, absolute, divergence, usual, code)
      call take_vector(stiffness%x, stiffness, x)
   end subroutine solve_distributed

   !> LEFT is the norm of b - [k] x.
   subroutine find_residual(stiffness, left)
      type(distributed_matrix_type), intent(in) :: stiffness
      real(wp), intent(out)                     :: left !! [force]

      call MatMult(stiffness%products, stiffness%x, stiffness%r, code)
      call VecAYPX(stiffness%r, -1.0_wp, stiffness%b, code)
      call VecNorm(stiffness%r, NORM_2, left, code)
   end subroutine find_residual

   subroutine free_solution(solution)
      type(distributed_solution_type), intent(inout) :: solution

      call forget_vectors(solution%earlier)
      if (solution%has_solver) call KSPDestroy(solution%solver, code)
      solution%has_solver = .false.
   end subroutine free_solution

end module distributed_solution
