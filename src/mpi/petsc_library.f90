!> The functions of PETSc 3.18 that are used here, as its C headers have them: matrices, vectors and Krylov solvers are handles;
!! every function gives an error code, 0 for none. PetscInt is 32 bits, PetscScalar a double: the real build of Debian, with Open MPI.
!! Source: PETSc Users Manual, ANL-21/39 Rev 3.18.
module petsc_library
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int, c_ptr
   implicit none
   public

   integer, parameter :: petsc_int = c_int, petsc_scalar = c_double

   integer(c_int), parameter :: insert_values = 1, add_values = 2            ! InsertMode
   integer(c_int), parameter :: final_assembly = 0                           ! MatAssemblyType
   integer(c_int), parameter :: petsc_false = 0, petsc_true = 1              ! PetscBool
   integer(c_int), parameter :: norm_2 = 1                                   ! NormType
   integer(c_int), parameter :: mat_ignore_lower = 12, mat_spd = 15, mat_spd_eternal = 26 ! MatOption
   integer(c_int), parameter :: unpreconditioned = 2                         ! KSPNormType
   integer(c_int), parameter :: petsc_decide = -1, petsc_default = -2
   integer(c_int), parameter :: out_of_memory = 55                           ! PETSC_ERR_MEM
   integer(c_int), parameter :: no_memory_for_factor = 3                     ! PC_FACTOR_OUTMEMORY of PCFailedReason

   type(c_ptr), bind(c, name='PETSC_COMM_WORLD') :: petsc_comm_world

   ! Functions of the same arguments: a handle first; other handles, numbers and texts that they take or give.
   abstract interface
      integer(c_int) function no_arguments() bind(c)
         import :: c_int
      end function no_arguments

      integer(c_int) function gives_handle(handle, given) bind(c)
         import :: c_int, c_ptr
         type(c_ptr), value :: handle
         type(c_ptr), intent(out) :: given
      end function gives_handle

      integer(c_int) function destroys(handle) bind(c)
         import :: c_int, c_ptr
         type(c_ptr), intent(inout) :: handle
      end function destroys

      integer(c_int) function takes_handle(handle, other) bind(c)
         import :: c_int, c_ptr
         type(c_ptr), value :: handle, other
      end function takes_handle

      integer(c_int) function adds_vector(y, a, x) bind(c)
         import :: c_double, c_int, c_ptr
         type(c_ptr), value :: y
         real(c_double), value :: a
         type(c_ptr), value :: x
      end function adds_vector

      integer(c_int) function takes_text(handle, text) bind(c)
         import :: c_char, c_int, c_ptr
         type(c_ptr), value :: handle
         character(kind=c_char), intent(in) :: text(*)
      end function takes_text

      integer(c_int) function takes_integer(handle, value) bind(c)
         import :: c_int, c_ptr
         type(c_ptr), value :: handle
         integer(c_int), value :: value
      end function takes_integer

      integer(c_int) function takes_two_handles(handle, first, second) bind(c)
         import :: c_int, c_ptr
         type(c_ptr), value :: handle, first, second
      end function takes_two_handles

      integer(c_int) function acts(handle) bind(c)
         import :: c_int, c_ptr
         type(c_ptr), value :: handle
      end function acts

      integer(c_int) function gives_integer(handle, value) bind(c)
         import :: c_int, c_ptr
         type(c_ptr), value :: handle
         integer(c_int), intent(out) :: value
      end function gives_integer
   end interface

   ! the library itself
   procedure(no_arguments), bind(c, name='PetscInitializeNoArguments') :: petsc_initialize
   procedure(no_arguments), bind(c, name='PetscFinalize') :: petsc_finalize
   procedure(no_arguments), bind(c, name='PetscPopSignalHandler') :: petsc_pop_signal_handler

   ! vectors
   procedure(gives_handle), bind(c, name='VecDuplicate') :: vec_duplicate
   procedure(gives_handle), bind(c, name='VecGetArray') :: vec_get_array !! the values that this process has, until vec_restore_array.
   procedure(destroys), bind(c, name='VecDestroy') :: vec_destroy
   procedure(takes_handle), bind(c, name='VecCopy') :: vec_copy !! y = x
   procedure(adds_vector), bind(c, name='VecAXPY') :: vec_axpy !! y = y + a x
   procedure(adds_vector), bind(c, name='VecAYPX') :: vec_aypx !! y = x + a y

   ! matrices
   procedure(gives_handle), bind(c, name='MatCreate') :: mat_create
   procedure(takes_text), bind(c, name='MatSetType') :: mat_set_type
   procedure(takes_integer), bind(c, name='MatSetBlockSize') :: mat_set_block_size
   procedure(takes_integer), bind(c, name='MatAssemblyBegin') :: mat_assembly_begin
   procedure(takes_integer), bind(c, name='MatAssemblyEnd') :: mat_assembly_end
   procedure(takes_two_handles), bind(c, name='MatMult') :: mat_mult
   procedure(takes_handle), bind(c, name='MatGetDiagonal') :: mat_get_diagonal
   procedure(destroys), bind(c, name='MatNullSpaceDestroy') :: mat_null_space_destroy
   procedure(takes_handle), bind(c, name='MatSetNearNullSpace') :: mat_set_near_null_space
   procedure(destroys), bind(c, name='MatDestroy') :: mat_destroy

   ! solvers, preconditioners
   procedure(gives_handle), bind(c, name='KSPCreate') :: ksp_create
   procedure(takes_text), bind(c, name='KSPSetOptionsPrefix') :: ksp_set_options_prefix
   procedure(takes_text), bind(c, name='KSPSetType') :: ksp_set_type
   procedure(takes_integer), bind(c, name='KSPSetNormType') :: ksp_set_norm_type
   procedure(takes_integer), bind(c, name='KSPSetInitialGuessNonzero') :: ksp_set_initial_guess_nonzero
   procedure(takes_two_handles), bind(c, name='KSPSetOperators') :: ksp_set_operators
   procedure(takes_integer), bind(c, name='KSPSetReusePreconditioner') :: ksp_set_reuse_preconditioner
   procedure(acts), bind(c, name='KSPSetFromOptions') :: ksp_set_from_options
   procedure(acts), bind(c, name='KSPSetUp') :: ksp_set_up
   procedure(takes_two_handles), bind(c, name='KSPSolve') :: ksp_solve
   procedure(gives_integer), bind(c, name='KSPGetIterationNumber') :: ksp_get_iteration_number
   procedure(gives_integer), bind(c, name='KSPGetConvergedReason') :: ksp_get_converged_reason !! positive: it has converged
   procedure(gives_handle), bind(c, name='KSPGetPC') :: ksp_get_pc
   procedure(destroys), bind(c, name='KSPDestroy') :: ksp_destroy
   procedure(takes_text), bind(c, name='PCSetType') :: pc_set_type
   procedure(gives_integer), bind(c, name='PCMGGetLevels') :: pc_mg_get_levels !! levels of a multigrid preconditioner that is set up.
   procedure(gives_integer), bind(c, name='PCGetFailedReason') :: pc_get_failed_reason !! why a set-up has failed, 0: it has not.
   procedure(takes_text), bind(c, name='PCFactorSetMatSolverType') :: pc_factor_set_solver

   interface
      integer(c_int) function petsc_push_error_handler(handler, context) bind(c, name='PetscPushErrorHandler')
         import :: c_funptr, c_int, c_ptr
         type(c_funptr), value :: handler
         type(c_ptr), value    :: context
      end function petsc_push_error_handler

      !> Hands the error code on, without a word; to be given to petsc_push_error_handler.
      subroutine petsc_return_error_handler() bind(c, name='PetscReturnErrorHandler')
      end subroutine petsc_return_error_handler

      integer(c_int) function petsc_options_set_value(options, name, value) bind(c, name='PetscOptionsSetValue')
         import :: c_char, c_int, c_ptr
         type(c_ptr), value                 :: options
         character(kind=c_char), intent(in) :: name(*), value(*)
      end function petsc_options_set_value

      !> Vectors that MATRIX multiplies and gives.
      integer(c_int) function mat_create_vecs(matrix, right, left) bind(c, name='MatCreateVecs')
         import :: c_int, c_ptr
         type(c_ptr), value       :: matrix
         type(c_ptr), intent(out) :: right, left
      end function mat_create_vecs

      integer(c_int) function vec_restore_array(vector, values) bind(c, name='VecRestoreArray')
         import :: c_int, c_ptr
         type(c_ptr), value         :: vector
         type(c_ptr), intent(inout) :: values
      end function vec_restore_array

      integer(c_int) function vec_norm(vector, norm_type, norm) bind(c, name='VecNorm')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: vector
         integer(c_int), value       :: norm_type
         real(c_double), intent(out) :: norm
      end function vec_norm

      integer(c_int) function vec_dot(x, y, product) bind(c, name='VecDot')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: x, y
         real(c_double), intent(out) :: product
      end function vec_dot

      !> PRODUCTS of X and N other vectors.
      integer(c_int) function vec_many_dot(x, n, y, products) bind(c, name='VecMDot')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: x
         integer(c_int), value       :: n
         type(c_ptr), intent(in)     :: y(*)
         real(c_double), intent(out) :: products(*)
      end function vec_many_dot

      !> y = y + sum of a x
      integer(c_int) function vec_many_axpy(y, n, a, x) bind(c, name='VecMAXPY')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value         :: y
         integer(c_int), value      :: n
         real(c_double), intent(in) :: a(*)
         type(c_ptr), intent(in)    :: x(*)
      end function vec_many_axpy

      integer(c_int) function vec_scale(x, a) bind(c, name='VecScale')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value    :: x
         real(c_double), value :: a
      end function vec_scale

      integer(c_int) function mat_set_sizes(matrix, own_rows, own_columns, rows, columns) bind(c, name='MatSetSizes')
         import :: c_int, c_ptr
         type(c_ptr), value    :: matrix
         integer(c_int), value :: own_rows, own_columns, rows, columns
      end function mat_set_sizes

      !> Room for so many blocks in every row of blocks of this process: in its own columns, and in those of others; the second
      !! pair counts for types that keep the upper blocks alone.
      integer(c_int) function mat_set_preallocation(matrix, block_size, own, others, own_upper, others_upper) &
         bind(c, name='MatXAIJSetPreallocation')
         import :: c_int, c_ptr
         type(c_ptr), value         :: matrix
         integer(c_int), value      :: block_size
         integer(c_int), intent(in) :: own(*), others(*), own_upper(*), others_upper(*)
      end function mat_set_preallocation

      integer(c_int) function mat_set_option(matrix, option, value) bind(c, name='MatSetOption')
         import :: c_int, c_ptr
         type(c_ptr), value    :: matrix
         integer(c_int), value :: option, value
      end function mat_set_option

      !> VALUES row after row.
      integer(c_int) function mat_set_values_blocked(matrix, m, rows, n, columns, values, mode) &
         bind(c, name='MatSetValuesBlocked')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value         :: matrix
         integer(c_int), value      :: m, n
         integer(c_int), intent(in) :: rows(*), columns(*) !! of blocks, from 0 on
         real(c_double), intent(in) :: values(*)
         integer(c_int), value      :: mode
      end function mat_set_values_blocked

      integer(c_int) function mat_get_values(matrix, m, rows, n, columns, values) bind(c, name='MatGetValues')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: matrix
         integer(c_int), value       :: m, n
         integer(c_int), intent(in)  :: rows(*), columns(*) !! from 0 on
         real(c_double), intent(out) :: values(*)
      end function mat_get_values

      !> Row ROW, one of this process, from 0 on: N columns, ascending, and their values, until mat_restore_row.
      integer(c_int) function mat_get_row(matrix, row, n, columns, values) bind(c, name='MatGetRow')
         import :: c_int, c_ptr
         type(c_ptr), value          :: matrix
         integer(c_int), value       :: row
         integer(c_int), intent(out) :: n
         type(c_ptr), intent(out)    :: columns, values
      end function mat_get_row

      integer(c_int) function mat_restore_row(matrix, row, n, columns, values) bind(c, name='MatRestoreRow')
         import :: c_int, c_ptr
         type(c_ptr), value            :: matrix
         integer(c_int), value         :: row
         integer(c_int), intent(inout) :: n
         type(c_ptr), intent(inout)    :: columns, values
      end function mat_restore_row

      integer(c_int) function mat_null_space_create(comm, has_constant, n, vectors, null_space) &
         bind(c, name='MatNullSpaceCreate')
         import :: c_int, c_ptr
         type(c_ptr), value       :: comm
         integer(c_int), value    :: has_constant, n
         type(c_ptr), intent(in)  :: vectors(*)
         type(c_ptr), intent(out) :: null_space
      end function mat_null_space_create

      integer(c_int) function ksp_set_tolerances(solver, relative, absolute, divergence, most_steps) &
         bind(c, name='KSPSetTolerances')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value    :: solver
         real(c_double), value :: relative, absolute, divergence
         integer(c_int), value :: most_steps
      end function ksp_set_tolerances

      integer(c_int) function ksp_get_tolerances(solver, relative, absolute, divergence, most_steps) &
         bind(c, name='KSPGetTolerances')
         import :: c_double, c_int, c_ptr
         type(c_ptr), value          :: solver
         real(c_double), intent(out) :: relative, absolute, divergence
         integer(c_int), intent(out) :: most_steps
      end function ksp_get_tolerances

      integer(c_int) function pc_mg_get_smoother(preconditioner, level, smoother) bind(c, name='PCMGGetSmoother')
         import :: c_int, c_ptr
         type(c_ptr), value       :: preconditioner
         integer(c_int), value    :: level         !! 0: the coarsest
         type(c_ptr), intent(out) :: smoother
      end function pc_mg_get_smoother

      !> The matrix by which a level finds its residual; RESIDUAL null: as it does.
      integer(c_int) function pc_mg_set_residual(preconditioner, level, residual, matrix) bind(c, name='PCMGSetResidual')
         import :: c_funptr, c_int, c_ptr
         type(c_ptr), value    :: preconditioner, matrix
         integer(c_int), value :: level
         type(c_funptr), value :: residual
      end function pc_mg_set_residual
   end interface

end module petsc_library
