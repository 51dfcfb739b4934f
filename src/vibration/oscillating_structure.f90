!> The structure that oscillates about the state at the end of a stage, and its equations [k] - sigma [m]. It has the bodies,
!! bars, tightened bolts, and the joints with their stiffness under oscillation. The equations are ordered once and factorised
!! at any shift.
module oscillating_structure
   use analysis_state, only: analysis_type
   use case_control, only: solver_skyline, solver_tree
   use equation_solver, only: equation_system, failure_type
   use equations, only: add_bar, form_body_stiffness, form_structure_stiffness, lock_unknown, start_equations
   use kinds, only: wp
   use mass_matrix, only: form_mass, mass_matrix_type
   use model_data, only: model_type, n_bars, n_sections, supported
   use shear_loops, only: oscillation_stiffness
   implicit none
   private

   public :: let_go, start_oscillation, factorise_at, hold_bolts

   type, public :: oscillating_type
      real(wp), allocatable :: k(:, :)       !! (3, n) k_sx, k_sy, k_n of interface elements [force/length]
      logical, allocatable  :: is_elastic(:) !! bars: no bolts, or tightened ones
      logical, allocatable  :: is_locked(:)  !! tightened pretension sections of solid bolts
      type(mass_matrix_type) :: mass
      class(equation_system), allocatable :: started !! ordered, without a matrix
   end type oscillating_type

contains

   !> MODEL without its supports; the condition on the axis of a ring remains.
   pure subroutine let_go(model)
      type(model_type), intent(inout) :: model
      logical :: free(model%dimension)
      integer :: i

      do i = 1, model%n_nodes - n_sections(model)
         free = supported(model, i)
         if (model%axisymmetric) free(1) = free(1) .and. abs(model%x(1, i)) > 0.0_wp
         model%held(:, i) = model%held(:, i) .and. .not. free
      end do
   end subroutine let_go

   !> Stiffness and mass about the state of ANALYSIS, and the order of the equations. The solver is SKYLINE if SYSTEM is
   !! SKYLINE, else TREE.
   subroutine start_oscillation(model, analysis, system, on_loading, structure, failure)
      type(model_type), intent(in)        :: model
      type(analysis_type), intent(in)     :: analysis
      class(equation_system), intent(in)  :: system
      logical, intent(in)                 :: on_loading !! STIFFNESS = LOAD
      type(oscillating_type), intent(out) :: structure
      type(failure_type), intent(inout)   :: failure
      integer :: i

      allocate (structure%k(3, size(model%interface)))
      do i = 1, size(model%interface)
         structure%k(:, i) = oscillation_stiffness(model%joints(model%interface(i)%joint)%law, model%interface(i)%area, &
                                                   analysis%states(i), on_loading)
      end do
      structure%is_elastic = [(model%bars(i)%bolt == 0 .or. model%bars(i)%stage <= analysis%stage, i = 1, n_bars(model))]
      structure%is_locked = [(model%sections(i)%stage <= analysis%stage, i = 1, n_sections(model))]
      call form_mass(model, structure%mass)
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
      real(wp) :: k(3, 3, size(structure%k, 2))
      integer  :: c, i

      if (failure%raised) return
      allocate (system, source=structure%started)
      system%shift = shift
      call form_body_stiffness(model, system, failure)
      if (failure%raised) return
      do i = 1, n_bars(model)
         if (model%bars(i)%bolt > 0 .and. structure%is_elastic(i)) call add_bar(model, i, system)
      end do
      call hold_bolts(model, structure, system)
      k = 0.0_wp
      do c = 1, 3
         k(c, c, :) = structure%k(c, :)
      end do
      call form_structure_stiffness(model, k, 'natural modes', system, failure)
   end subroutine factorise_at

   !> Hold the overlap of tightened solid bolts.
   subroutine hold_bolts(model, structure, system)
      type(model_type), intent(in)          :: model
      type(oscillating_type), intent(in)    :: structure
      class(equation_system), intent(inout) :: system
      integer :: i

      do i = 1, n_sections(model)
         if (structure%is_locked(i)) call lock_unknown(model%sections(i)%node, 1, system)
      end do
   end subroutine hold_bolts

end module oscillating_structure
