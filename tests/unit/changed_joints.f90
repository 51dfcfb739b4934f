!> Models by TREE whose joints have stiffnesses that differ by a share from those of some_stiffnesses, and loads on what moves.
module changed_joints
   use control_words, only: solver_tree
   use deck_models, only: model_of_cards, sample_cards, some_forces, some_stiffnesses
   use equations, only: equation_system, form_body_stiffness, form_structure_stiffness, start_equations
   use equation_solver, only: failure_type
   use kinds, only: wp
   use model_data, only: model_type
   use tree_solver, only: tree_solver_type
   implicit none
   private

   public :: prepare, changed, load

   real(wp), parameter, public :: untouched = 7.0_wp

contains

   !> Sample model WHICH, the fourth of those with joints being the low plate, by TREE, laid out for so many FACTORISATIONS,
   !! factorised with stiffnesses that differ by a SHARE.
   subroutine prepare(which, factorisations, share, model, system)
      integer, intent(in)                :: which, factorisations
      real(wp), intent(in)               :: share
      type(model_type), intent(out)      :: model
      type(tree_solver_type), intent(out) :: system
      class(equation_system), allocatable :: by_tree
      type(failure_type) :: failure
      character(:), allocatable :: problem

      call model_of_cards(sample_cards(merge(5, which, which == 4)), model, problem)
      if (problem /= '') error stop 'changed_joints: the model has errors'
      call start_equations(model, by_tree, failure, solver_tree, factorisations)
      select type (by_tree)
      type is (tree_solver_type)
         system = by_tree
      end select
      call form_body_stiffness(model, system, failure)
      call form_structure_stiffness(model, changed(model, share), 'here', system, failure)
      if (failure%raised) error stop 'changed_joints: no factor'
   end subroutine prepare

   !> Stiffnesses of the joints larger or smaller by up to a SHARE.
   pure function changed(model, share) result(k)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: share
      real(wp) :: k(3, 3, size(model%joints%element))
      integer  :: i

      k = some_stiffnesses(model, 1)
      do i = 1, size(model%joints%element)
         k(:, :, i) = k(:, :, i)*(1.0_wp + share*(modulo(7*i, 11) - 5)/5.0_wp)
      end do
   end function changed

   !> Forces on the refactored equations, UNTOUCHED on the others.
   subroutine load(model, system, x)
      type(model_type), intent(in)       :: model
      type(tree_solver_type), intent(in) :: system
      real(wp), allocatable, intent(out) :: x(:)
      integer :: i

      allocate (x(system%n), source=untouched)
      associate (f => some_forces(model), e => system%equations)
         x(e) = [(f(system%direction(e(i)), system%node(e(i))), i = 1, size(e))]
      end associate
   end subroutine load

end module changed_joints
