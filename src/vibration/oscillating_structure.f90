!> The oscillating structure about the state at the end of a stage: its equations [k] - sigma [m].
!!
!! The structure has the bodies, bars, tightened bolts, and the joints with their stiffness under oscillation. Its equations are
!! ordered once and factorised at any shift.
module oscillating_structure
   use analysis_state, only: analysis_type
   use control_words, only: solver_skyline, solver_tree
   use equation_solver, only: equation_system, failure_type
   use equations, only: add_bar, form_body_stiffness, form_structure_stiffness, lock_unknown, start_equations
   use joint_laws, only: stiffness_matrices
   use kinds, only: wp
   use mass_matrix, only: form_mass, mass_matrix_type
   use model_data, only: model_type, n_bars, n_sections
   use shear_loops, only: oscillation_stiffness
   use tolerances, only: lanczos_tolerance, off_the_pole
   implicit none
   private

   public :: start_oscillation, factorise_at, factorise_beside, hold_bolts, count_below

   integer, parameter, public :: most_trials = 4  !! of a factorisation beside an eigenvalue

   type, public :: oscillating_type
      real(wp), allocatable :: k(:, :)       !! (4, n) k_sx, k_sy, k_n, k_sxy of interface elements [force/length]
      logical, allocatable  :: is_elastic(:) !! bars: no bolts, or tightened ones
      logical, allocatable  :: is_locked(:)  !! tightened pretension sections of solid bolts
      integer, allocatable  :: held(:, :)    !! (2, n) node and direction of unknowns that are held besides; not allocated: none
      type(mass_matrix_type) :: mass
      class(equation_system), allocatable :: started !! ordered, without a matrix
      logical :: is_counted = .true.         !! prove by a count that no mode is missing
      real(wp) :: tolerance = lanczos_tolerance !! of the eigenvalues, as in find_eigenpairs
   end type oscillating_type

contains

   !> Stiffness and mass about the state of ANALYSIS, and the order of the equations. The solver is SKYLINE if SYSTEM is
   !! SKYLINE, else TREE. Mass and equations that STRUCTURE has already stay. IS_ORDERED: it needs no equations of its own.
   subroutine start_oscillation(model, analysis, system, on_loading, structure, failure, is_ordered)
      type(model_type), intent(in)        :: model
      type(analysis_type), intent(in)     :: analysis
      class(equation_system), intent(in)  :: system
      logical, intent(in)                 :: on_loading !! STIFFNESS = LOAD
      type(oscillating_type), intent(inout) :: structure
      type(failure_type), intent(inout)   :: failure
      logical, intent(in), optional       :: is_ordered
      integer :: i

      if (.not. allocated(structure%k)) allocate (structure%k(4, size(model%joints%element)))
      do i = 1, size(model%joints%element)
         structure%k(:, i) = oscillation_stiffness(model%joints%list(model%joints%element(i)%joint)%law, &
            model%joints%element(i)%area, analysis%states(i), on_loading)
      end do
      structure%is_elastic = [(analysis%is_elastic(i) .or. model%mesh%bars(i)%tightening%is_in(analysis%stage), &
                               i = 1, n_bars(model%mesh))]
      structure%is_locked = [(analysis%is_locked(i) .or. model%mesh%sections(i)%tightening%is_in(analysis%stage), i = 1, &
                              n_sections(model%mesh))]
      if (.not. allocated(structure%mass%first)) call form_mass(model, structure%mass)
      if (allocated(structure%started)) return
      if (present(is_ordered)) then
         if (is_ordered) return
      end if
      call start_equations(model, structure%started, failure, &
                           merge(solver_skyline, solver_tree, system%description%name == 'SKYLINE'), factorisations=1, shift=0.0_wp)
   end subroutine start_oscillation

   !> Factorise [k] - SHIFT [m] of STRUCTURE in SYSTEM. FAILURE where the matrix is singular, as without shift for a structure
   !! without sufficient supports, or where memory is missing.
   subroutine factorise_at(model, structure, shift, system, failure)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      real(wp), intent(in)               :: shift !! sigma [1/time^2]
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type), intent(inout)  :: failure
      integer :: i

      if (failure%raised) return
      allocate (system, source=structure%started)
      system%shift = shift
      call form_body_stiffness(model, system, failure)
      if (failure%raised) return
      do i = 1, n_bars(model%mesh)
         if (model%mesh%bars(i)%bolt > 0 .and. structure%is_elastic(i)) call add_bar(model, i, system)
      end do
      call hold_bolts(model, structure, system)
      call form_structure_stiffness(model, stiffness_matrices(structure%k), 'natural modes', system, failure)
   end subroutine factorise_at

   !> Hold the overlap of tightened solid bolts, and what else STRUCTURE holds.
   subroutine hold_bolts(model, structure, system)
      type(model_type), intent(in)          :: model
      type(oscillating_type), intent(in)    :: structure
      class(equation_system), intent(inout) :: system
      integer :: i

      do i = 1, n_sections(model%mesh)
         if (structure%is_locked(i)) call lock_unknown(model%mesh%sections(i)%node, 1, system)
      end do
      if (.not. allocated(structure%held)) return
      do i = 1, size(structure%held, 2)
         call lock_unknown(structure%held(1, i), structure%held(2, i), system)
      end do
   end subroutine hold_bolts

   !> Count the eigenvalues BELOW a positive SHIFT.
   subroutine count_below(model, structure, shift, below, failure)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      real(wp), intent(in)               :: shift
      integer, intent(out)               :: below
      type(failure_type), intent(inout)  :: failure
      class(equation_system), allocatable :: system
      real(wp) :: at

      at = shift
      below = 0
      call factorise_beside(model, structure, at, system, failure)
      if (.not. failure%raised) below = system%n_negative
   end subroutine count_below

   !> Factorise at a positive SHIFT, or slightly below it where it is an eigenvalue.
   subroutine factorise_beside(model, structure, shift, system, failure)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      real(wp), intent(inout)            :: shift
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type), intent(inout)  :: failure
      type(failure_type) :: found
      integer :: trial

      if (failure%raised) return
      do trial = 1, most_trials
         found = failure
         call factorise_at(model, structure, shift, system, found)
         if (.not. found%raised) return
         shift = shift*(1.0_wp - off_the_pole*10.0_wp**trial)
      end do
      failure = found
   end subroutine factorise_beside

end module oscillating_structure
