!> Bars: stiffness E A/L between two nodes along their line, thermal loads and nodal forces; springs are bars too.
!! A spring has directions of its own; where it has one node, its second node is the ground.
module bar_elements
   use kinds, only: wp
   use model_data, only: a_spring, bar_nodes, bar_type, model_type, temperature_type
   implicit none
   private

   public :: bar_elongation, thermal_pull, add_pull, add_bar_forces, bar_stiffness

contains

   !> Elongation of BAR under the displacements U of its bar_nodes [length].
   pure real(wp) function bar_elongation(bar, u) result(elongation)
      type(bar_type), intent(in) :: bar
      real(wp), intent(in)       :: u(:, :) !! (dimension, bar_nodes) [length]
      real(wp) :: second(size(u, 1))

      associate (d => size(u, 1))
         second = 0.0_wp
         if (size(u, 2) == 2) second = u(:, 2)
         elongation = dot_product(second - u(:, 1), bar%direction(:d, 2)) + &
                      dot_product(u(:, 1), bar%direction(:d, 2) - bar%direction(:d, 1))
      end associate
   end function bar_elongation

   !> Tension of BAR at constant length and at this TEMPERATURE: compression where the mean temperature along the bar rises above TREF;
   !! zero for a spring [force].
   pure real(wp) function thermal_pull(bar, temperature) result(tension)
      type(bar_type), intent(in)         :: bar
      type(temperature_type), intent(in) :: temperature

      tension = 0.0_wp
      if (bar%kind == a_spring .or. .not. allocated(temperature%at)) return
      tension = -bar%stiffness*bar%expansion* &
                (0.5_wp*sum(temperature%at(bar%nodes)) - temperature%reference_share*bar%reference)
   end function thermal_pull

   !> Add to F the nodal forces of bar I under a tension N.
   pure subroutine add_pull(model, i, n, f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp), intent(in)         :: n       !! [force]
      real(wp), intent(inout)      :: f(:, :) !! (dimension, n_nodes) [force]

      associate (bar => model%bars(i), d => model%dimension)
         f(:, bar%nodes(1)) = f(:, bar%nodes(1)) + n*bar%direction(:d, 1)
         if (bar%nodes(2) > 0) f(:, bar%nodes(2)) = f(:, bar%nodes(2)) - n*bar%direction(:d, 2)
      end associate
   end subroutine add_pull

   !> Add to F the internal forces of the elastic bars under the displacements U.
   pure subroutine add_bar_forces(model, is_elastic, u, f)
      type(model_type), intent(in) :: model
      logical, intent(in)          :: is_elastic(:) !! (bars)
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), intent(inout)      :: f(:, :) !! (dimension, n_nodes) [force]
      integer :: i

      do i = 1, size(is_elastic)
         associate (bar => model%bars(i))
            if (is_elastic(i)) call add_pull(model, i, -bar%stiffness*bar_elongation(bar, u(:, bar_nodes(bar))), f)
         end associate
      end do
   end subroutine add_bar_forces

   !> [k] of bar I between its nodes, components of node 1 first; zero for the ground [force/length].
   pure function bar_stiffness(model, i) result(k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp) :: k(2*model%dimension, 2*model%dimension), between(2*model%dimension)

      associate (bar => model%bars(i), d => model%dimension)
         between = [-bar%direction(:d, 1), bar%direction(:d, 2)]
         if (bar%nodes(2) == 0) between(d + 1:) = 0.0_wp
         k = spread(bar%stiffness*between, 2, 2*d)*spread(between, 1, 2*d)
      end associate
   end function bar_stiffness

end module bar_elements
