!> Parts of the model on their way from rank 0 to others: elements, their properties, where their nodes are.
module part_messages
   use kinds, only: wp
   use model_data, only: model_type
   use ranks, only: receive, send
   implicit none
   private

   public :: send_part, receive_part

   integer, parameter :: words_each = 3, values_each = 5 !! of a property

contains

   !> Send to process R what extract of body_parts has set of PART.
   subroutine send_part(part, r)
      type(model_type), intent(in) :: part
      integer, intent(in)          :: r
      integer  :: words(words_each, size(part%properties))
      real(wp) :: values(values_each, size(part%properties))
      integer  :: i

      do i = 1, size(part%properties)
         associate (property => part%properties(i))
            words(:, i) = [property%id, property%state, merge(1, 0, property%incompatible)]
            values(:, i) = [property%e, property%nu, property%thickness, property%alpha, property%reference]
         end associate
      end do
      call send(r, [part%dimension, part%n_elements, part%n_nodes, size(part%element_nodes, 1), size(part%properties)])
      call send(r, part%element_kind)
      call send(r, part%element_property)
      call send(r, reshape(part%element_nodes, [size(part%element_nodes)]))
      call send(r, reshape(part%x, [size(part%x)]))
      call send(r, reshape(words, [size(words)]))
      call send(r, reshape(values, [size(values)]))
   end subroutine send_part

   !> The PART that rank 0 has sent.
   subroutine receive_part(part)
      type(model_type), intent(out) :: part
      integer, allocatable  :: sizes(:), words(:)
      real(wp), allocatable :: values(:)
      integer :: i

      call receive(sizes)
      part%dimension = sizes(1)
      part%n_elements = sizes(2)
      part%n_nodes = sizes(3)
      call receive(part%element_kind)
      call receive(part%element_property)
      call receive(words)
      part%element_nodes = reshape(words, [sizes(4), part%n_elements])
      call receive(values)
      part%x = reshape(values, [3, part%n_nodes])
      allocate (part%properties(sizes(5)))
      call receive(words)
      call receive(values)
      do i = 1, size(part%properties)
         associate (property => part%properties(i), word => words_each*(i - 1), value => values_each*(i - 1))
            property%id = words(word + 1)
            property%state = words(word + 2)
            property%incompatible = words(word + 3) == 1
            property%e = values(value + 1)
            property%nu = values(value + 2)
            property%thickness = values(value + 3)
            property%alpha = values(value + 4)
            property%reference = values(value + 5)
         end associate
      end do
   end subroutine receive_part

end module part_messages
