!> Nodes that no card gives, behind those of the deck: they keep unknowns that are no displacements of points.
module extra_nodes
   use model_data, only: model_type
   use kinds, only: wp
   implicit none
   private

   public :: append_node

contains

   !> Append a node at X with these components FREE, as a node of the ELEMENTS; its number is 0.
   subroutine append_node(model, x, free, elements)
      type(model_type), intent(inout) :: model
      real(wp), intent(in)            :: x(3)        !! [length]
      logical, intent(in)             :: free(:)     !! (dimension)
      integer, intent(in)             :: elements(:)

      associate (n => model%n_nodes + 1, d => model%dimension)
         model%node_id = [model%node_id, 0]
         model%twin = [model%twin, 0]
         model%x = reshape([model%x, x], [3, n])
         model%elements_at = [model%elements_at, elements]
         model%first_at = [model%first_at, size(model%elements_at) + 1]
         if (allocated(model%node_section)) model%node_section = [model%node_section, 0]
         if (allocated(model%used)) model%used = [model%used, .true.]
         if (allocated(model%held)) model%held = reshape([model%held, .not. free], [d, n])
         if (allocated(model%left_out)) model%left_out = reshape([model%left_out, .not. free], [d, n])
      end associate
      model%n_nodes = model%n_nodes + 1
   end subroutine append_node

end module extra_nodes
