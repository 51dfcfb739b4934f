!> The unsymmetric equations of NEWTON with friction: solved by conjugate residuals, with the factor of a symmetric stiffness as
!! preconditioner, which is kept while this pays.
module coupled_equations
   use equation_solver, only: coupled_tally, equation_system, failure_type
   use equations, only: form_structure_stiffness, solve_equations
   use interface_operator, only: add_global_force, global_stiffness, relative_movement
   use kept_directions, only: direction_set, make_room, orthonormalise, reduce_along, start_directions
   use kinds, only: wp
   use model_data, only: model_type
   use tolerances, only: rounding_of_directions
   implicit none
   private

   public :: solve_coupled, solve_coupled_again, solve_coupled_columns

   integer, parameter :: digits = 7          ! of an iterative solution within an iteration
   integer, parameter :: most_kept = 96      ! directions of earlier coupled systems and of the present one
   integer, parameter :: most_changed = 16   ! elements whose forces become directions at once, three each
   integer, parameter :: per_step = 8        ! directions whose solution at once costs as much as a step
   integer, parameter :: most_block_steps = 10 ! of several systems at once
   integer, parameter :: most_entries = 16000000 ! of their directions, 128 MB
   real(wp), parameter :: much = 0.1_wp      ! of the stiffness of an element, and of the largest change: one that is large
   real(wp), parameter :: grades = 5.0_wp    ! of changes: one grade is a factor of 1.2
   real(wp), parameter :: share_of_axis = 0.1_wp ! of the change in all axes: an axis in which it acts

contains

   !> Replace the forces U on the retained nodes by the displacements with ([k_b] + sum of (K_INT + REST)) u = f on the free
   !! components, K_INT symmetric, by conjugate residuals with a factor as preconditioner. The present factor is kept while two
   !! conditions hold: its steps beyond those of a new factor cost less than a factorisation, and they are no more than the average
   !! since it was made. Otherwise [k_b] + sum of K_INT is factorised. The residual is reduced below TOLERANCE times that of u = 0,
   !! or as far as the steps reach.
   subroutine solve_coupled(model, k_int, rest, where, tolerance, system, u, failure, left)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: k_int(:, :, :) !! (3, 3, n) of interface elements, in their axes [force/length]
      real(wp), intent(in)                  :: rest(:, :, :)  !! likewise
      character(*), intent(in)              :: where          !! as in form_structure_stiffness
      real(wp), intent(in)                  :: tolerance
      class(equation_system), intent(inout) :: system
      real(wp), intent(inout)               :: u(:, :)        !! (dimension, retained) [force] on entry, [length] on return
      type(failure_type), intent(inout)     :: failure
      real(wp), intent(out), optional       :: left           !! part of the forces that U leaves [-]
      real(wp) :: load(size(u, 1), size(u, 2))
      integer, allocatable :: changed(:)
      integer  :: i, none(0), symmetric_steps, steps

      if (.not. allocated(system%coupled%change)) allocate (system%coupled%change, mold=rest)
      associate (tally => system%coupled)
         load = u
         if (tally%serves .and. tally%price > 0 .and. tally%extra*tally%solved <= tally%spent) then
            do i = 1, size(rest, 3)
               tally%change(:, :, i) = global_stiffness(system%interface(i), k_int(:, :, i) + rest(:, :, i)) - system%k_int(:, :, i)
            end do
            symmetric_steps = steps_of_own_factor(tally, tolerance)
            call follow_factor(tally)
            call find_changed(k_int, system, changed)
            call iterate_coupled(model, tolerance, symmetric_steps + tally%price, system, u, steps, failure, changed, part=left)
            if (failure%raised) return
            tally%extra = max(0, steps - symmetric_steps)
            tally%spent = tally%spent + tally%extra
            tally%solved = tally%solved + 1
            if (steps <= symmetric_steps + tally%price) return
         end if
         call form_structure_stiffness(model, k_int, where, system, failure)
         call follow_factor(tally)
         do i = 1, size(rest, 3)
            tally%change(:, :, i) = global_stiffness(system%interface(i), rest(:, :, i))
         end do
         u = load
         call iterate_coupled(model, tolerance, tally%most_steps, system, u, steps, failure, none, part=left)
         tally%symmetric_steps = steps/(-log10(tolerance))
         tally%extra = 0
         tally%spent = tally%price
         tally%solved = 1
      end associate
   end subroutine solve_coupled

   !> The steps to TOLERANCE with the factor of the system's own symmetric part.
   pure integer function steps_of_own_factor(tally, tolerance) result(steps)
      type(coupled_tally), intent(in) :: tally
      real(wp), intent(in)            :: tolerance

      steps = nint(tally%symmetric_steps*(-log10(tolerance)))
   end function steps_of_own_factor

   !> Forget the directions where they are those of another factor.
   subroutine follow_factor(tally)
      type(coupled_tally), intent(inout) :: tally
      integer :: i

      if (tally%kept_for == tally%n_factors) return
      tally%kept_for = tally%n_factors
      tally%kept%n = 0
      tally%largest = 0.0_wp
      tally%is_direction = [(.false., i=1, size(tally%change, 3))]
   end subroutine follow_factor

   !> Replace other forces U by the displacements under the stiffness of the last solve_coupled.
   subroutine solve_coupled_again(model, tolerance, system, u, failure)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: tolerance
      class(equation_system), intent(inout) :: system
      real(wp), intent(inout)               :: u(:, :)     !! (dimension, retained) [force] on entry, [length] on return
      type(failure_type), intent(inout)     :: failure
      integer :: beyond, steps

      call iterate_coupled(model, tolerance, system%coupled%most_steps, system, u, steps, failure)
      associate (tally => system%coupled)
         beyond = max(0, steps - steps_of_own_factor(tally, tolerance))
         tally%extra = tally%extra + beyond
         tally%spent = tally%spent + beyond
      end associate
   end subroutine solve_coupled_again

   !> Replace every column of forces U by the displacements under the stiffness of the last solve_coupled, up to a share TOLERANCE of
   !! the forces: all columns at once, each reduced along the directions of all.
   subroutine solve_coupled_columns(tolerance, system, u)
      real(wp), intent(in)                  :: tolerance
      class(equation_system), intent(inout) :: system
      real(wp), intent(inout)               :: u(:, :, :)  !! (dimension, retained, columns) [force] on entry, [length] on return
      type(direction_set) :: set
      logical  :: held(size(u, 1), size(u, 2))
      real(wp) :: enough(size(u, 3)), left(size(u, 1), size(u, 2), size(u, 3)), new(size(u, 1), size(u, 2))
      real(wp), allocatable :: x(:, :)
      integer, allocatable  :: unfinished(:)
      integer :: first, i, j, most, step

      held = system%held_now()
      left = merge(0.0_wp, u, spread(held, 3, size(u, 3)))
      u = 0.0_wp
      enough = [(tolerance*norm2(left(:, :, i)), i = 1, size(u, 3))]
      most = min(most_block_steps, most_entries/(3*size(u)) + 1)
      call start_directions(set, size(held), most*size(u, 3))
      do step = 1, most
         unfinished = pack([(i, i = 1, size(u, 3))], [(norm2(left(:, :, i)) > enough(i), i = 1, size(u, 3))])
         if (size(unfinished) == 0) exit
         allocate (x(system%n, size(unfinished)))
         do i = 1, size(unfinished)
            call system%gather(left(:, :, unfinished(i)), x(:, i))
         end do
         call system%precondition_many(x)
         first = set%n + 1
         do i = 1, size(unfinished)
            call system%put(x(:, i), new)
            j = set%n + i
            set%u(:, j) = reshape(new, [size(new)])
            set%force(:, j) = reshape(left(:, :, unfinished(i)), [size(new)])
            call add_change(system, held, set%u(:, j), set%force(:, j), set%product(:, j))
         end do
         deallocate (x)
         set%n = set%n + size(unfinished)
         call orthonormalise(set, first)
         if (set%n < first) exit ! no direction reduces the residuals
         call reduce_along(set, first, size(u, 3), left, u)
      end do
   end subroutine solve_coupled_columns

   !> Replace the forces U by the displacements with ([k] + sum of CHANGE) u = f by generalised conjugate residuals in STEPS steps,
   !! [k] being the stiffness in SYSTEM. STEPS exceeds MOST_STEPS where the residual is not below TOLERANCE times that of u = 0.
   !! Directions of earlier systems with the same [k] are kept: their products with [k] are known, so they cost no solution. Elements
   !! that have CHANGED since [k] was factorised would take a step each: their own forces become directions, all in one solution.
   !! Sources: Eisenstat, Elman, Schultz, SIAM J. Numer. Anal. 20 (1983) 345-357, preconditioned from the right; Parks et al.,
   !! SIAM J. Sci. Comput. 28 (2006) 1651-1674.
   subroutine iterate_coupled(model, tolerance, most_steps, system, u, steps, failure, changed, part)
      type(model_type), intent(in)          :: model
      real(wp), intent(in)                  :: tolerance
      integer, intent(in)                   :: most_steps
      class(equation_system), intent(inout) :: system
      real(wp), intent(inout)               :: u(:, :)
      integer, intent(out)                  :: steps
      type(failure_type), intent(inout)     :: failure
      integer, intent(in), optional         :: changed(:) !! elements; absent: the products of the kept directions are those of this
                                                          !! system
      real(wp), intent(out), optional       :: part       !! of the forces that U leaves [-]
      logical  :: held(size(u, 1), size(u, 2))
      real(wp) :: left(size(u, 1), size(u, 2)), enough, new(size(u, 1), size(u, 2))
      integer  :: first, lasting
      logical  :: lasts

      steps = 0
      if (present(part)) part = 0.0_wp
      held = system%held_now()
      left = merge(0.0_wp, u, held)
      u = 0.0_wp
      enough = tolerance*norm2(left)
      if (failure%raised .or. enough <= 0.0_wp) return
      associate (kept => system%coupled%kept)
         if (.not. allocated(kept%u)) &
            call start_directions(kept, size(u), merge(most_kept, min(most_kept, most_steps + 1), system%coupled%price > 0))
         if (present(changed)) call find_products(system, held, 1)
         call reduce_along(kept, 1, 1, left, u)
         if (present(changed) .and. norm2(left) > enough) then
            call add_forces(system, held, changed, first, steps)
            call reduce_along(kept, first, 1, left, u)
         end if
         system%coupled%largest = max(system%coupled%largest, enough/tolerance)
         lasting = kept%n
         do while (norm2(left) > enough)
            lasts = norm2(left) > rounding_of_directions*system%coupled%largest
            steps = steps + 1
            if (steps > most_steps) exit
            new = left
            call solve_equations(model, system, left, new, failure, digits=digits)
            if (failure%raised) return
            if (kept%n == size(kept%u, 2)) kept%n = min(kept%n, lasting) ! rounding is not combined with the others
            call make_room(kept, 1)
            lasting = min(lasting, kept%n)
            kept%n = kept%n + 1
            first = kept%n
            kept%u(:, first) = reshape(new, [size(u)])
            kept%force(:, first) = reshape(left, [size(u)])
            call find_products(system, held, first)
            if (kept%n < first) steps = most_steps ! no direction reduces the residual
            call reduce_along(kept, first, 1, left, u)
            if (lasts) lasting = kept%n
         end do
         if (present(part)) part = norm2(left)*tolerance/enough
         kept%n = min(kept%n, lasting) ! others would bring rounding to the next systems
      end associate
   end subroutine iterate_coupled

   !> Add directions whose forces are those of the elements CHANGED, in the axes in which CHANGE acts, FIRST being the first of them.
   !! STEPS is what their solution costs.
   subroutine add_forces(system, held, changed, first, steps)
      class(equation_system), intent(inout) :: system
      logical, intent(in)                   :: held(:, :)
      integer, intent(in)                   :: changed(:)
      integer, intent(out)                  :: first, steps
      real(wp), allocatable :: x(:, :)
      real(wp) :: acts(3), force(size(held, 1), size(held, 2)), u(size(held, 1), size(held, 2))
      integer  :: axis, i, j, n

      allocate (x(system%n, 3*size(changed)))
      n = 0
      associate (kept => system%coupled%kept)
         call make_room(kept, 3*size(changed))
         first = kept%n + 1
         do i = 1, size(changed)
            associate (element => system%interface(changed(i)))
               acts = norm2(matmul(transpose(element%axes), system%coupled%change(:, :, changed(i))), dim=2)
               do axis = 1, 3
                  if (.not. acts(axis) > share_of_axis*maxval(acts)) cycle
                  force = 0.0_wp
                  call add_global_force(element, element%axes(:, axis), force)
                  force = merge(0.0_wp, force, held)
                  if (.not. norm2(force) > 0.0_wp) cycle
                  n = n + 1
                  call system%gather(force, x(:, n))
                  kept%force(:, kept%n + n) = reshape(force, [size(force)])
               end do
            end associate
         end do
         call system%precondition_many(x(:, :n))
         do j = 1, n
            call system%put(x(:, j), u)
            kept%u(:, kept%n + j) = reshape(u, [size(u)])
         end do
         kept%n = kept%n + n
         system%coupled%is_direction(changed) = .true.
         steps = merge((n - 1)/per_step + 1, 0, n > 0)
         call find_products(system, held, first)
      end associate
   end subroutine add_forces

   !> The products of the coupled stiffness and the kept directions from FIRST on, orthonormalised.
   subroutine find_products(system, held, first)
      class(equation_system), intent(inout) :: system
      logical, intent(in)                   :: held(:, :) !! (dimension, retained)
      integer, intent(in)                   :: first
      integer :: j

      associate (kept => system%coupled%kept)
         !$omp parallel do default(shared) if(kept%n > first)
         do j = first, kept%n
            call add_change(system, held, kept%u(:, j), kept%force(:, j), kept%product(:, j))
         end do
         !$omp end parallel do
         call orthonormalise(kept, first)
      end associate
   end subroutine find_products

   !> PRODUCT = FORCE + the forces of CHANGE at the displacements U.
   subroutine add_change(system, held, u, force, product)
      class(equation_system), intent(in) :: system
      logical, intent(in)                :: held(:, :) !! (dimension, retained)
      real(wp), intent(in)               :: u(size(held, 1), size(held, 2)), force(size(held, 1), size(held, 2))
      real(wp), intent(out)              :: product(size(held, 1), size(held, 2))
      integer :: i

      product = 0.0_wp
      do i = 1, size(system%interface)
         associate (element => system%interface(i))
            call add_global_force(element, matmul(system%coupled%change(:, :, i), relative_movement(element, u)), product)
         end associate
      end do
      product = merge(0.0_wp, product, held) + force
   end subroutine add_change

   !> The elements whose stiffness K_INT has CHANGED most since it was factorised, without those whose forces are directions already. Of
   !! elements that have changed nearly alike, as in symmetric structures, the first ones are taken: last bits do not choose.
   subroutine find_changed(k_int, system, changed)
      real(wp), intent(in)                  :: k_int(:, :, :) !! (3, 3, n) in their axes
      class(equation_system), intent(in)    :: system
      integer, allocatable, intent(out)     :: changed(:)
      real(wp) :: change(size(k_int, 3)), now(3, 3), least
      integer  :: at, grade(size(k_int, 3)), i

      do i = 1, size(change)
         now = global_stiffness(system%interface(i), k_int(:, :, i))
         change(i) = norm2(now - system%k_int(:, :, i))
         if (.not. change(i) > much*max(norm2(now), norm2(system%k_int(:, :, i)))) change(i) = 0.0_wp
      end do
      allocate (changed(0))
      if (size(change) == 0) return
      least = much*maxval(change)
      where (system%coupled%is_direction .or. .not. change > least) change = 0.0_wp
      where (change > 0.0_wp) grade = nint(grades*log(change/least))
      where (.not. change > 0.0_wp) grade = -1
      do while (size(changed) < most_changed)
         at = maxloc(grade, dim=1)
         if (grade(at) < 0) exit
         changed = [changed, at]
         grade(at) = -1
      end do
   end subroutine find_changed

end module coupled_equations
