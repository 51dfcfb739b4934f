!> METHOD = BACK, after Back, Burdekin and Cowley: the whole load at once with secant stiffnesses at the last pressures, two
!! consecutive pressures averaged, until they settle. Loading only.
module back_method
   use analysis_state, only: analysis_type, find_movements, find_unbalanced, pass_record, record_pass, tally_work
   use equations, only: equation_system, forces_in_bodies, form_structure_stiffness, solve_equations
   use failures, only: failure_type
   use interface_operator, only: joint_movement
   use joint_laws, only: back_stiffness, exceeds_limit, loading_work, rest_margin
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type
   use normal_stiffness, only: branch_load, branch_open, pressure_floor
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: back_increment

   integer, parameter  :: most_iterations = 1000
   real(wp), parameter :: settled = 1.0e-11_wp !! of the largest pressure: change from one iteration to the next

   !> The interface elements in one iteration, n of them.
   type :: iterate_type
      real(wp), allocatable :: p(:), p_new(:)     ! pressures of the secants, and those that they lead to
      real(wp), allocatable :: movement(:, :)     ! (3, n) that they lead to
      real(wp), allocatable :: k_shear(:, :)      ! (2, n) shear secants of that movement
      real(wp), allocatable :: k_int(:, :, :)     ! (3, 3, n) stiffness, in joint axes
   end type iterate_type

contains

   !> The whole load in one go: secants, a solution, what it says of the secants, until they agree.
   subroutine back_increment(model, plan, analysis, system, failure)
      type(model_type), intent(in)         :: model
      type(stage_plan_type), intent(in)    :: plan
      type(analysis_type), intent(inout)   :: analysis
      class(equation_system), intent(inout) :: system
      type(failure_type), intent(inout)    :: failure
      type(iterate_type) :: now
      real(wp) :: change
      integer  :: iteration, n, worst

      n = size(model%interface)
      allocate (now%p_new(n), now%k_shear(2, n), now%movement(3, n), now%k_int(3, 3, n), source=0.0_wp)
      now%p = analysis%states%normal%p_av
      do iteration = 1, most_iterations
         call take_secants(model, analysis, iteration, now)
         call form_structure_stiffness(model, now%k_int, where_in_plan(plan, analysis%stage, analysis%increment), system, &
                                       failure, one_solution=.true.)
         call solve_equations(model, system, analysis%felt, analysis%u, failure, &
                              moved=merge(analysis%moved(:, system%retained), 0.0_wp, analysis%moves))
         if (failure%raised) return
         if (n == 0) exit
         call read_off(model, system, analysis, now, change)
         call record_pass(analysis, pass_record(before=maxval(abs(now%p)), after=change, part=-1))
         if (change <= settled*max(maxval(now%p), pressure_floor*maxval(analysis%states%normal%p_av))) exit
         now%p = 0.5_wp*(now%p + now%p_new)
      end do
      if (iteration > most_iterations) then
         worst = maxloc(abs(now%p_new - now%p), dim=1)
         call failure%raise(where_in_plan(plan, analysis%stage, analysis%increment)//': the pressures have not settled after '// &
            integer_text(most_iterations)//' iterations; the one of node '// &
            integer_text(joint_node_id(model, worst, 1))//' still changes by '//real_text(change))
         return
      end if
      call store(model, now, analysis)
      call forces_in_bodies(system, analysis%u, analysis%body)
      call find_movements(system, analysis)
      call find_unbalanced(system, analysis)
   end subroutine back_increment


   !> Normal secants at the pressures, shear secants halfway between the last two; an open element has none.
   subroutine take_secants(model, analysis, iteration, now)
      type(model_type), intent(in)      :: model
      type(analysis_type), intent(in)   :: analysis
      integer, intent(in)               :: iteration
      type(iterate_type), intent(inout) :: now
      real(wp) :: k(3)
      integer  :: d, i

      do i = 1, size(model%interface)
         associate (element => model%interface(i), p_av => analysis%states(i)%normal%p_av)
            k = back_stiffness(model%joints(element%joint)%law, element%area, p_av, now%p(i), now%movement(:, i))
         end associate
         if (iteration > 1) k(:2) = now%k_shear(:, i)
         if (iteration > 2) k(:2) = 0.5_wp*(k(:2) + [now%k_int(1, 1, i), now%k_int(2, 2, i)])
         if (k(3) <= 0.0_wp) k = 0.0_wp
         do d = 1, 3
            now%k_int(d, d, i) = k(d)
         end do
      end do
   end subroutine take_secants


   !> What the solution moves and presses, and by how much stresses differ from those of the secants [pressure]. The shear secants
   !! must be those of the deflections that they led to.
   subroutine read_off(model, system, analysis, now, change)
      type(model_type), intent(in)       :: model
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(iterate_type), intent(inout)  :: now
      real(wp), intent(out)              :: change
      real(wp) :: k(3), tau_change(2)
      integer  :: i

      change = 0.0_wp
      do i = 1, size(model%interface)
         associate (element => model%interface(i), movement => now%movement(:, i), p_av => analysis%states(i)%normal%p_av)
            now%movement(:, i) = joint_movement(system%interface(i), analysis%u)
            now%p_new(i) = max(0.0_wp, now%k_int(3, 3, i)*movement(3)/element%area)
            k = back_stiffness(model%joints(element%joint)%law, element%area, p_av, now%p(i), movement)
            now%k_shear(:, i) = k(:2)
            tau_change = abs((k(:2) - [now%k_int(1, 1, i), now%k_int(2, 2, i)])*movement(:2))/element%area
            change = max(change, abs(now%p_new(i) - now%p(i)), tau_change(1), tau_change(2))
         end associate
      end do
   end subroutine read_off


   !> The secants have settled: the states of the elements.
   subroutine store(model, now, analysis)
      type(model_type), intent(in)       :: model
      type(iterate_type), intent(in)     :: now
      type(analysis_type), intent(inout) :: analysis
      integer :: i

      do i = 1, size(model%interface)
         associate (state => analysis%states(i), element => model%interface(i), movement => now%movement(:, i), &
                    law => model%joints(model%interface(i)%joint)%law)
            state%normal%branch = merge(branch_load, branch_open, movement(3) > 0.0_wp)
            state%normal%lambda = movement(3)
            state%normal%k_n = now%k_int(3, 3, i)
            state%normal%sumf = max(0.0_wp, now%k_int(3, 3, i)*movement(3))
            state%normal%pressure = state%normal%sumf/element%area
            state%shear%sense = sign(1.0_wp, movement(:2))
            state%shear%delta = movement(:2)
            state%shear%k_s = [now%k_int(1, 1, i), now%k_int(2, 2, i)]
            state%shear%tau = state%shear%k_s*movement(:2)/element%area
            state%slips = exceeds_limit(law, state, rest_margin)
            call tally_work(analysis%energy(element%joint), loading_work(law, element%area, state))
         end associate
      end do
   end subroutine store

end module back_method
