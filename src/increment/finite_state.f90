!> The test of the state after an increment for values that are not finite or beyond all bounds. No such value gets into a
!! result; the message names the first place.
module finite_state
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use analysis_state, only: analysis_type, force_noise
   use equations, only: equation_system
   use equation_solver, only: failure_type
   use kinds, only: wp
   use model_data, only: joint_node_id, model_type, n_bars
   use newton_iterations, only: idle
   use newton_method, only: no_balance
   use numbers, only: is_measure, largest_measure
   use stage_plan, only: stage_plan_type, where_in_plan
   use text_tools, only: integer_text, real_text
   use tolerances, only: most_rounding_of_forces
   use unknowns, only: unknown_name
   implicit none
   private

   public :: check_state

   integer, parameter :: many = 10000 ! nodes from which on several threads test them

contains

   !> FAILURE names the first load, displacement, interface element, bolt, joint or unbalanced force of the completed increment
   !! that is not finite or beyond all bounds. The displacements of all nodes are those of the last recovery.
   !! Otherwise FAILURE states that the rounding error is not small compared with the joint forces: soft joints under stiff bodies,
   !! or bodies that have moved far. Bodies that moved supports carry along or that interference has pushed away carry no force,
   !! and are not tested.
   subroutine check_state(model, plan, system, analysis, failure)
      type(model_type), intent(in)       :: model
      type(stage_plan_type), intent(in)  :: plan
      class(equation_system), intent(in) :: system
      type(analysis_type), intent(in)    :: analysis
      type(failure_type), intent(inout)  :: failure
      character(17), parameter :: nouns(6) = [character(17) :: 'deflection lambda', 'pressure', 'normal force', &
                                              'shear deflection', 'shear stress', 'stiffness']
      integer, parameter :: last_of(5) = [3, 5, 6, 8, 10] ! among the values of an interface element, the last of a noun
      character(:), allocatable :: place
      real(wp) :: noise, values(16)
      integer  :: at, i

      place = where_in_plan(plan, analysis%stage, analysis%increment)//': '
      call check_nodes('the load', analysis%now%load, [(i, i = 1, model%mesh%n_nodes)])
      call check_nodes('the displacement', analysis%u, system%retained)
      do i = 1, size(model%joints%element)
         associate (normal => analysis%states(i)%normal, shear => analysis%states(i)%shear, k => analysis%k(:, i))
            values = [normal%lambda, normal%lambda_a, normal%lambda_b, normal%pressure, normal%p_a, normal%sumf, shear%delta, &
                      shear%tau, normal%k_n, shear%k_s, k]
            at = findloc(is_measure(values), .false., dim=1)
            if (at > 0) call check('the '//trim(nouns(count(at > last_of) + 1))//' of interface element '// &
                                   integer_text(model%joints%element(i)%id)//' at node '//integer_text(joint_node_id(model, i, &
                                      1)), values(at:at))
         end associate
      end do
      do i = 1, size(model%joints%list)
         call check('the work done on joint '//integer_text(model%joints%list(i)%id), [analysis%energy(i)%put_in, &
                                                                analysis%energy(i)%given_back, analysis%energy(i)%lost])
      end do
      do i = 1, n_bars(model%mesh)
         call check('the tension of element '//integer_text(model%mesh%bars(i)%id), [analysis%rest_tension(i)])
      end do
      call check_nodes('the force out of balance', analysis%unbalanced, system%retained)
      call check_nodes('the displacement', analysis%all_u, [(i, i = 1, model%mesh%n_nodes)])
      call check_nodes('the force out of balance or of support', analysis%all_unbalanced, [(i, i = 1, model%mesh%n_nodes)])

      if (size(model%joints%element) == 0) return
      noise = force_noise(system, analysis%u)
      if (noise <= most_rounding_of_forces*analysis%largest_load) return
      if (analysis%is_loose .and. analysis%largest_load <= 10.0_wp*idle*analysis%loose_force) return
      if (noise >= analysis%largest_load .and. (analysis%is_moved .or. any(model%joints%element%gap < 0.0_wp))) return
      call failure%raise(place//no_balance//', '//real_text(noise)//' of force where '//real_text(analysis%largest_load)// &
                         ' act: see CONDITION OF THE STIFFNESS in the manual')

   contains

      !> Test an ARRAY over NODES.
      subroutine check_nodes(noun, array, nodes)
         character(*), intent(in) :: noun
         real(wp), intent(in)     :: array(:, :) !! (dimension, nodes)
         integer, intent(in)      :: nodes(:)
         integer :: at(2), i
         logical :: sound

         sound = .true.
         !$omp parallel do schedule(static) default(shared) reduction(.and.: sound) if(size(array, 2) > many)
         do i = 1, size(array, 2) ! in every increment
            if (all(ieee_is_finite(array(:, i)))) then
               sound = sound .and. all(abs(array(:, i)) <= largest_measure)
            else
               sound = .false.
            end if
         end do
         !$omp end parallel do
         if (sound) return
         at = findloc(is_measure(array), .false.)
         if (at(1) > 0) call check(noun//' of '//unknown_name(model, nodes(at(2)), at(1)), [array(at(1), at(2))])
      end subroutine check_nodes

      !> Test the VALUES of WHAT.
      subroutine check(what, values)
         character(*), intent(in) :: what
         real(wp), intent(in)     :: values(:)
         integer :: at

         at = findloc(is_measure(values), .false., dim=1)
         if (at > 0) call failure%raise(place//what//' is '//real_text(values(at))// &
            ', too large; are loads, lengths and stiffnesses in consistent units?')
      end subroutine check

   end subroutine check_state

end module finite_state
