!> Which unknown is which equation.
module equation_numbering
   use kinds, only: wp
   use model_data, only: model_type
   implicit none
   private

   public :: number_unknowns, number_joints, gather, put

   type, public :: equation_numbers
      integer :: n = 0                              !! unknowns
      integer, allocatable :: number(:, :)          !! (dimension, n_nodes) equation, 0: held or without element
      integer, allocatable :: node(:), direction(:) !! (n) what an equation belongs to
   end type equation_numbers

contains

   !> Number the free components, node after node in ORDER.
   subroutine number_unknowns(model, order, numbers)
      type(model_type), intent(in)           :: model
      integer, intent(in)                    :: order(:)
      class(equation_numbers), intent(inout) :: numbers
      integer :: d, i, n

      n = 0
      if (.not. allocated(numbers%number)) allocate (numbers%number(model%dimension, model%n_nodes))
      numbers%number = 0
      do i = 1, size(order)
         if (.not. model%used(order(i))) cycle
         do d = 1, model%dimension
            if (model%held(d, order(i))) cycle
            n = n + 1
            numbers%number(d, order(i)) = n
         end do
      end do
      numbers%n = n
      if (.not. allocated(numbers%node)) allocate (numbers%node(n), numbers%direction(n))
      do i = 1, model%n_nodes
         do d = 1, model%dimension
            if (numbers%number(d, i) == 0) cycle
            numbers%node(numbers%number(d, i)) = i
            numbers%direction(numbers%number(d, i)) = d
         end do
      end do
   end subroutine number_unknowns


   !> The EQUATIONS of the interface elements: components of node 1, of node 2 from the fourth on; 0: held, none such, base.
   subroutine number_joints(model, number, equations)
      type(model_type), intent(in)      :: model
      integer, intent(in)               :: number(:, :)    !! (dimension, n_nodes) as in equation_numbers
      integer, allocatable, intent(out) :: equations(:, :) !! (6, n)
      integer :: d, i

      d = model%dimension
      allocate (equations(6, size(model%interface)), source=0)
      do i = 1, size(model%interface)
         associate (nodes => model%interface(i)%nodes)
            equations(:d, i) = number(:, nodes(1))
            if (nodes(2) > 0) equations(4:3 + d, i) = number(:, nodes(2))
         end associate
      end do
   end subroutine number_joints


   !> X(equation) from an array over nodes, for the EQUATIONS.
   subroutine gather(numbers, equations, array, x)
      class(equation_numbers), intent(in) :: numbers
      integer, intent(in)               :: equations(:)
      real(wp), intent(in)              :: array(:, :) !! (dimension, n_nodes)
      real(wp), intent(inout)           :: x(:)        !! (n), not touched for others
      integer :: i

      do i = 1, size(equations)
         associate (k => equations(i))
            x(k) = array(numbers%direction(k), numbers%node(k))
         end associate
      end do
   end subroutine gather


   !> An array over nodes from X(equation), of the EQUATIONS.
   subroutine put(numbers, equations, x, array)
      class(equation_numbers), intent(in) :: numbers
      integer, intent(in)               :: equations(:)
      real(wp), intent(in)              :: x(:)        !! (n)
      real(wp), intent(inout)           :: array(:, :) !! (dimension, n_nodes)
      integer :: i

      do i = 1, size(equations)
         associate (k => equations(i))
            array(numbers%direction(k), numbers%node(k)) = x(k)
         end associate
      end do
   end subroutine put

end module equation_numbering
