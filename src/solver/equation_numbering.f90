!> Which unknown is which equation.
module equation_numbering
   use model_data, only: model_type
   implicit none
   private

   public :: number_unknowns

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

end module equation_numbering
