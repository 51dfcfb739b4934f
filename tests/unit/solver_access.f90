!> The solver behind an equation_system, for tests that look inside, whose system is a target then; and the way through it.
module solver_access
   use equations, only: condense_load, equation_system, form_structure_stiffness, recover_displacements, solve_equations
   use equation_solver, only: failure_type
   use front_tree, only: front_tree_type
   use kinds, only: wp
   use model_data, only: model_type
   use skyline_solver, only: skyline_solver_type
   use tree_solver, only: tree_solver_type
   implicit none
   private

   public :: is_tree, tree_of, fronts_of, skyline_of, solve_all

contains

   !> Whether SYSTEM is solved by TREE.
   pure logical function is_tree(system)
      class(equation_system), intent(in) :: system

      select type (system)
      type is (tree_solver_type)
         is_tree = .true.
      class default
         is_tree = .false.
      end select
   end function is_tree

   !> SYSTEM, which is TREE.
   function tree_of(system) result(tree)
      class(equation_system), target, intent(in) :: system
      type(tree_solver_type), pointer :: tree

      select type (system)
      type is (tree_solver_type)
         tree => system
      class default
         error stop 'solver_access: the solver is not TREE'
      end select
   end function tree_of

   !> The fronts of SYSTEM, which is TREE.
   function fronts_of(system) result(fronts)
      class(equation_system), target, intent(in) :: system
      type(front_tree_type), pointer :: fronts
      type(tree_solver_type), pointer :: tree

      tree => tree_of(system)
      fronts => tree%fronts
   end function fronts_of

   !> SYSTEM, which is SKYLINE.
   function skyline_of(system) result(skyline)
      class(equation_system), target, intent(in) :: system
      type(skyline_solver_type), pointer :: skyline

      select type (system)
      type is (skyline_solver_type)
         skyline => system
      class default
         error stop 'solver_access: the solver is not SKYLINE'
      end select
   end function skyline_of

   !> Displacements U of all nodes as the increments find them: the load condensed, retained nodes solved, the others recovered.
   subroutine solve_all(model, system, k_int, f, u, failure)
      type(model_type), intent(in)          :: model
      class(equation_system), intent(inout) :: system
      real(wp), intent(in)                  :: k_int(:, :, :) !! (3, 3, n) [force/length]
      real(wp), intent(in)                  :: f(:, :)        !! (dimension, n_nodes) [force]
      real(wp), allocatable, intent(out)    :: u(:, :)        !! likewise [length]
      type(failure_type), intent(inout)     :: failure
      real(wp) :: on_retained(model%mesh%dimension, size(system%retained)), of_retained(model%mesh%dimension, size(system%retained))

      allocate (u, source=99.0_wp + 0.0_wp*f)
      of_retained = 99.0_wp
      call condense_load(system, f, on_retained)
      call form_structure_stiffness(model, k_int, 'here', system, failure)
      call solve_equations(model, system, on_retained, of_retained, failure)
      call recover_displacements(system, f, of_retained, u)
   end subroutine solve_all

end module solver_access
