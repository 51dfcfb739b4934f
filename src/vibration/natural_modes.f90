!> Natural modes of a structure about the state at the end of a stage: choice of eigenvalues, shift, and count that proves none is
!! missing.
!!
!! The factor of [k] - sigma [m] has as many negative pivots as there are eigenvalues below sigma (Sylvester's law of inertia).
!! A range of frequencies is counted at both ends before the search. The lowest modes are counted behind the last one.
!! Source: Parlett, The Symmetric Eigenvalue Problem, SIAM 1998, sections 3.3 and 15.
module natural_modes
   use eigenpairs, only: find_eigenpairs, needs_all, on_equations
   use element_mapping, only: two_pi
   use equation_solver, only: equation_system, failure_type
   use kinds, only: wp
   use mesh_queries, only: n_points, node_kind
   use model_data, only: a_point, damped_bars, model_type
   use oscillating_structure, only: count_below, factorise_at, factorise_beside, hold_bolts, most_trials, oscillating_type
   use stage_plan, only: vibration_plan_type
   use structural_elements, only: unit_tension
   use text_tools, only: integer_text
   use tolerances, only: barely_held, rigid_motion, wide_gap, zero_at_shift, zero_eigenvalue
   implicit none
   private

   public :: find_natural_modes

   integer, parameter, public :: beyond = 3              ! extra modes: the last wanted one may have equals

   type, public :: spectrum_type
      real(wp), allocatable :: lambda(:)          !! ascending, 0 for a rigid-body mode [1/time^2]
      real(wp), allocatable :: x(:, :)            !! (equations, modes) x^T [m] x = 1
      integer  :: n_rigid = 0                     !! number of rigid-body modes
      integer  :: n_before = 0                    !! modes below the range
      integer  :: n_wanted = 0                    !! wanted modes, from the first on; the others complete the last group
      real(wp) :: shift = 0.0_wp                  !! shift of the search
      integer  :: n_counted = 0                   !! eigenvalues below COUNTED_AT, all found
      real(wp) :: counted_at = 0.0_wp             !! [1/time^2]
      real(wp) :: reach = 0.0_wp                  !! up to here no mode is missing among the wanted ones; huge: they are all [1/time^2]
      real(wp), allocatable :: load(:, :)         !! (equations, waves, then dampers) of the response, where one is wanted [force]
      real(wp), allocatable :: at_rest(:, :)      !! likewise, under this load at rest, where a factor without shift was made
   end type spectrum_type

contains

   !> The modes of STRUCTURE for PLAN, in the numbering of SYSTEM, which has no factor. There is never more than one factor at a
   !! time.
   subroutine find_natural_modes(model, structure, plan, spectrum, system, failure)
      type(model_type), intent(in)          :: model
      type(oscillating_type), intent(in)    :: structure
      type(vibration_plan_type), intent(in) :: plan
      type(spectrum_type), intent(out)      :: spectrum
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type), intent(inout)     :: failure
      integer :: i

      if (failure%raised) return
      spectrum%n_wanted = merge(plan%most, huge(1), plan%most > 0)
      if (allocated(plan%response)) then
         associate (n => size(plan%response%waves), dampers => damped_bars(model%mesh))
            allocate (spectrum%load(structure%started%n, n + size(dampers)))
            do i = 1, n
               spectrum%load(:, i) = on_equations(model, structure%started, plan%response%waves(i)%force(:model%mesh%dimension, :))
            end do
            do i = 1, size(dampers)
               spectrum%load(:, n + i) = on_equations(model, structure%started, unit_tension(model, dampers(i)))
            end do
         end associate
      end if
      if (needs_all(structure%started, plan%most)) then
         call find_all(model, structure, plan, spectrum, failure)
      else
         call find_some(model, structure, plan, spectrum, failure)
      end if
      if (failure%raised) return
      associate (n => spectrum%n_wanted)
         if (max(spectrum%reach, spectrum%counted_at) < huge(1.0_wp) .or. spectrum%n_before + n < spectrum%n_counted) then
            spectrum%reach = 0.0_wp
            if (n > 0) spectrum%reach = spectrum%lambda(n) ! the last mode or, where ND has not limited them, the end of the range
            if (plan%has_highest .and. n /= plan%most) spectrum%reach = (two_pi*plan%highest)**2
         else
            spectrum%reach = huge(1.0_wp)
         end if
      end associate
      allocate (system, source=structure%started)
      system%shift = spectrum%shift
      call hold_bolts(model, structure, system)
   end subroutine find_natural_modes

   !> Some of the modes of a large structure, from the lower end of the range on or from below. They are found until their number
   !! agrees with the count: at the upper end of the range, or without an end in the first clear gap behind the last wanted mode,
   !! or behind all modes where few nodes have mass.
   subroutine find_some(model, structure, plan, spectrum, failure)
      type(model_type), intent(in)          :: model
      type(oscillating_type), intent(in)    :: structure
      type(vibration_plan_type), intent(in) :: plan
      type(spectrum_type), intent(inout)    :: spectrum
      type(failure_type), intent(inout)     :: failure
      class(equation_system), allocatable   :: system
      integer :: below_end, last, n, trial, under

      below_end = huge(1)
      if (plan%has_highest) then
         spectrum%counted_at = (two_pi*plan%highest)**2
         call count_below(model, structure, spectrum%counted_at, below_end, failure)
         spectrum%n_counted = below_end
      end if
      if (plan%has_lowest) then
         spectrum%shift = (two_pi*plan%lowest)**2
         call factorise_beside(model, structure, spectrum%shift, system, failure)
         if (.not. failure%raised) spectrum%n_before = system%n_negative
      end if
      if (failure%raised) return
      spectrum%n_wanted = min(spectrum%n_wanted, below_end - spectrum%n_before)
      if (needs_all(structure%started, spectrum%n_wanted)) then
         if (allocated(system)) deallocate (system)
         call find_all(model, structure, plan, spectrum, failure)
         return
      else if (spectrum%n_wanted <= 0) then
         spectrum%n_wanted = 0
         allocate (spectrum%lambda(0), spectrum%x(structure%started%n, 0))
         return
      end if

      if (.not. plan%has_lowest) call search_from_below(model, structure, spectrum%n_wanted + beyond, spectrum, system, failure)
      n = spectrum%n_wanted + beyond
      do trial = 1, most_trials
         n = min(n, structure%started%n - 1)
         if (.not. allocated(system)) call factorise_at(model, structure, spectrum%shift, system, failure)
         if (.not. failure%raised .and. (trial > 1 .or. .not. allocated(spectrum%lambda))) &
            call find_eigenpairs(model, structure%mass, system, n, structure%tolerance, spectrum%lambda, spectrum%x, failure)
         if (failure%raised) return
         last = spectrum%n_rigid
         if (spectrum%shift < 0.0_wp) call count_rigid(model, structure, system, spectrum) ! an earlier trial may have missed one
         spectrum%n_rigid = max(last, spectrum%n_rigid)
         spectrum%lambda(:spectrum%n_rigid) = 0.0_wp
         associate (lambda => spectrum%lambda, wanted => spectrum%n_wanted)
            if (wanted == below_end - spectrum%n_before) then ! the whole range, which has been counted; a mode may be at its end
               if (count(lambda < (1.0_wp - wide_gap)*spectrum%counted_at) <= wanted .and. &
                   count(lambda < (1.0_wp + wide_gap)*spectrum%counted_at) >= wanted) return
               n = n + beyond
               cycle
            end if
            last = findloc(lambda(wanted + 1:) - lambda(wanted:size(lambda) - 1) > wide_gap*abs(lambda(wanted + 1:)), .true., dim=1)
            if (last > 0) then
               last = wanted - 1 + last
               spectrum%counted_at = 0.5_wp*(lambda(last) + lambda(last + 1))
            else if (size(lambda) < n) then ! no more modes exist
               last = size(lambda)
               spectrum%counted_at = 2.0_wp*maxval([lambda, abs(spectrum%shift)])
               spectrum%reach = huge(1.0_wp)
               if (.not. spectrum%counted_at > 0.0_wp) then ! no free unknown has mass
                  wanted = 0
                  return
               end if
            else
               n = 2*n
               cycle
            end if
            if (.not. structure%is_counted) then
               wanted = min(wanted, last)
               return
            end if
            deallocate (system)
            call count_below(model, structure, spectrum%counted_at, under, failure)
            if (failure%raised) return
            spectrum%n_counted = under
            if (under - spectrum%n_before == last) then
               wanted = min(wanted, last)
               return
            end if
            n = max(n, under - spectrum%n_before) + beyond
         end associate
      end do
      call failure%raise('MODES: '//integer_text(spectrum%n_counted)//' modes were counted, and '// &
                         integer_text(spectrum%n_before + size(spectrum%lambda))//' found in '// &
                         integer_text(most_trials)//' trials')
   end subroutine find_some

   !> All modes of a small structure, and the range of them.
   subroutine find_all(model, structure, plan, spectrum, failure)
      type(model_type), intent(in)          :: model
      type(oscillating_type), intent(in)    :: structure
      type(vibration_plan_type), intent(in) :: plan
      type(spectrum_type), intent(inout)    :: spectrum
      type(failure_type), intent(inout)     :: failure
      class(equation_system), allocatable   :: system
      integer :: n

      call search_from_below(model, structure, structure%started%n, spectrum, system, failure)
      if (failure%raised) return
      spectrum%lambda(:spectrum%n_rigid) = 0.0_wp
      associate (lambda => spectrum%lambda)
         n = size(lambda)
         if (plan%has_lowest) spectrum%n_before = count(lambda < (two_pi*plan%lowest)**2)
         if (plan%has_highest) n = count(lambda <= (two_pi*plan%highest)**2)
         spectrum%n_wanted = min(spectrum%n_wanted, max(0, n - spectrum%n_before))
         spectrum%n_counted = size(lambda)
         spectrum%counted_at = huge(1.0_wp)
      end associate
      spectrum%n_rigid = max(0, spectrum%n_rigid - spectrum%n_before)
      spectrum%lambda = spectrum%lambda(spectrum%n_before + 1:)
      spectrum%x = spectrum%x(:, spectrum%n_before + 1:)
   end subroutine find_all

   !> N modes from below all of them: without a shift, or for a structure without sufficient supports from a negative shift. Its
   !! size is that of the first mode with strain.
   subroutine search_from_below(model, structure, n, spectrum, system, failure)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      integer, intent(in)                :: n
      type(spectrum_type), intent(inout) :: spectrum
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type), intent(inout)  :: failure
      type(failure_type) :: loose
      real(wp) :: before, extent, first, scale
      integer  :: i, trial

      spectrum%shift = 0.0_wp
      call factorise_at(model, structure, spectrum%shift, system, loose)
      if (.not. loose%raised) loose%raised = system%weakest < barely_held
      if (.not. loose%raised) then
         if (allocated(spectrum%load)) then
            spectrum%at_rest = spectrum%load
            do i = 1, size(spectrum%at_rest, 2)
               call system%solve_by_factor(spectrum%at_rest(:, i))
            end do
         end if
         call find_eigenpairs(model, structure%mass, system, n, structure%tolerance, spectrum%lambda, spectrum%x, failure)
         return
      end if

      ! the square of the frequency of a wave through the structure: E/rho over its size^2
      associate (x => model%mesh%x(:, :n_points(model%mesh)))
         extent = norm2(maxval(x, dim=2) - minval(x, dim=2))
      end associate
      scale = 0.0_wp
      do i = 1, size(model%mesh%properties)
         if (model%mesh%properties(i)%rho > 0.0_wp) scale = max(scale, &
            model%mesh%properties(i)%e/(model%mesh%properties(i)%rho*extent**2))
      end do
      if (.not. scale > 0.0_wp) scale = 1.0_wp ! nodal masses only: the search finds its own scale
      spectrum%shift = -scale
      before = -scale
      do trial = 1, most_trials
         call factorise_at(model, structure, spectrum%shift, system, failure)
         if (failure%raised .and. trial > 1) then ! what seemed the first mode with strain is a rigid-body mode but for rounding
            spectrum%shift = before
            failure = failure_type()
            call factorise_at(model, structure, spectrum%shift, system, failure)
            associate (lambda => spectrum%lambda, m => size(spectrum%lambda))
               spectrum%n_rigid = findloc(lambda(:m - 1) < rigid_motion*lambda(2:m), .true., dim=1, back=.true.)
            end associate
            exit
         end if
         if (failure%raised) return
         before = spectrum%shift
         call find_eigenpairs(model, structure%mass, system, n, structure%tolerance, spectrum%lambda, spectrum%x, failure)
         if (failure%raised) return
         call count_rigid(model, structure, system, spectrum)
         if (spectrum%n_rigid == size(spectrum%lambda)) exit
         first = spectrum%lambda(spectrum%n_rigid + 1)
         if (first > 1.0e-2_wp*abs(spectrum%shift) .and. first < 1.0e3_wp*abs(spectrum%shift)) exit
         spectrum%shift = -first
      end do
   end subroutine search_from_below

   !> The number of rigid-body modes in SPECTRUM: eigenvalues zero but for rounding, below the least one and far below the next.
   subroutine count_rigid(model, structure, system, spectrum)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      class(equation_system), intent(in) :: system
      type(spectrum_type), intent(inout) :: spectrum
      integer :: i

      associate (lambda => spectrum%lambda)
         do i = count(lambda < max(zero_eigenvalue*stiffest(model, structure, system), zero_at_shift*abs(spectrum%shift))), 1, -1
            if (i == size(lambda)) exit
            if (lambda(i) < rigid_motion*lambda(i + 1)) exit
         end do
         spectrum%n_rigid = i
      end associate
   end subroutine count_rigid

   !> Estimate of the largest eigenvalue: the largest k_ii/m_ii.
   real(wp) function stiffest(model, structure, system) result(largest)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      class(equation_system), intent(in) :: system
      integer  :: i, k

      largest = 0.0_wp
      do i = 1, system%n
         associate (node => system%node(i))
            if (node_kind(model%mesh, node) /= a_point) cycle
            do k = structure%mass%first(node), structure%mass%first(node + 1) - 1
               if (structure%mass%column(k) /= node .or. .not. structure%mass%value(k) > 0.0_wp) cycle
               largest = max(largest, system%diagonal(i)/structure%mass%value(k))
            end do
         end associate
      end do
   end function stiffest

end module natural_modes
