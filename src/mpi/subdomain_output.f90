!> The piece of the bodies that this process writes. Rank 0 sends it once, and for every file how its nodes have moved. Beside its own
!! elements a piece has all that meet at its nodes, so that no process has to ask another for its part of a mean.
module subdomain_output
   use body_parts, only: body_piece_type
   use distribution, only: piece_writer
   use kinds, only: wp
   use lists, only: list_owners
   use model_data, only: n_sections, temperature_type
   use partition, only: receive_part, send_part
   use ranks, only: receive, send, sum_of_all
   implicit none
   private

   public :: writes_by, send_piece, receive_piece, send_state, write_received, write_own, forget_piece

   type(body_piece_type), allocatable :: piece !! of the other ranks
   procedure(piece_writer), pointer :: write_piece => null()

contains

   !> From now on pieces are written by WRITER.
   subroutine writes_by(writer)
      procedure(piece_writer) :: writer

      write_piece => writer
   end subroutine writes_by

   !> Send process R its OWN piece.
   subroutine send_piece(own, r)
      type(body_piece_type), intent(in) :: own
      integer, intent(in)               :: r
      integer :: i

      associate (part => own%model)
         call send_part(part, r)
         call send(r, [own%shown%n_points, merge(1, 0, own%shown%is_warm), n_sections(part)])
         call send(r, own%shown%elements)
         call send(r, part%node_id)
         call send(r, part%element_id)
         if (n_sections(part) == 0) return
         call send(r, part%element_section)
         call send(r, part%node_section)
         call send(r, part%sections%node)
         call send(r, [(part%sections(i)%direction, i = 1, n_sections(part))])
      end associate
   end subroutine send_piece

   !> The piece that rank 0 has sent.
   subroutine receive_piece()
      integer, allocatable  :: sizes(:), words(:)
      real(wp), allocatable :: values(:)
      integer :: i

      call forget_piece()
      allocate (piece)
      associate (part => piece%model)
         call receive_part(part)
         call receive(sizes)
         piece%shown%n_points = sizes(1)
         piece%shown%is_warm = sizes(2) == 1
         call receive(piece%shown%elements)
         call receive(part%node_id)
         call receive(part%element_id)
         call list_owners(part%n_nodes, part%element_nodes, part%first_at, part%elements_at)
         if (sizes(3) == 0) return
         call receive(part%element_section)
         call receive(part%node_section)
         call receive(words)
         call receive(values)
         allocate (part%sections(sizes(3)))
         do i = 1, size(part%sections)
            part%sections(i)%node = words(i)
            part%sections(i)%direction = values(3*i - 2:3*i)
         end do
      end associate
   end subroutine receive_piece

   !> Send process R the displacements U and the TEMPERATURE of the NODES of its piece, and what it has to know of its FILE.
   subroutine send_state(r, nodes, u, temperature, notes, file)
      integer, intent(in)                :: r, nodes(:)
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      character(*), intent(in)           :: notes, file
      type(temperature_type) :: own

      own = at_nodes(temperature, nodes)
      call send(r, reshape(u(:, nodes), [size(u, 1)*size(nodes)]))
      call send(r, [merge(1, 0, allocated(own%at))])
      call send(r, [own%reference_share])
      if (allocated(own%at)) call send(r, own%at)
      call send(r, notes)
      call send(r, file)
   end subroutine send_state

   !> Write the own piece in the state that rank 0 has sent.
   subroutine write_received()
      type(temperature_type) :: temperature
      integer, allocatable      :: has(:)
      real(wp), allocatable     :: u(:), reference_share(:)
      character(:), allocatable :: file, notes
      logical :: ok

      call receive(u)
      call receive(has)
      call receive(reference_share)
      temperature%reference_share = reference_share(1)
      if (has(1) == 1) call receive(temperature%at)
      call receive(notes)
      call receive(file)
      call write_piece(piece, reshape(u, [piece%model%dimension, piece%model%n_nodes]), temperature, notes, file, ok)
      call agree(ok)
   end subroutine write_received

   !> Rank 0: write its OWN piece likewise. OK is false where any process could not write its own.
   subroutine write_own(own, nodes, u, temperature, notes, file, ok)
      type(body_piece_type), intent(in)  :: own
      integer, intent(in)                :: nodes(:)
      real(wp), intent(in)               :: u(:, :)
      type(temperature_type), intent(in) :: temperature
      character(*), intent(in)           :: notes, file
      logical, intent(out)               :: ok

      call write_piece(own, u(:, nodes), at_nodes(temperature, nodes), notes, file, ok)
      call agree(ok)
   end subroutine write_own

   !> Whether it is so in all processes.
   subroutine agree(ok)
      logical, intent(inout) :: ok

      ok = sum_of_all(merge(0.0_wp, 1.0_wp, ok)) < 0.5_wp
   end subroutine agree

   !> The TEMPERATURE of these NODES alone.
   pure type(temperature_type) function at_nodes(temperature, nodes)
      type(temperature_type), intent(in) :: temperature
      integer, intent(in)                :: nodes(:)

      at_nodes%reference_share = temperature%reference_share
      if (allocated(temperature%at)) at_nodes%at = temperature%at(nodes)
   end function at_nodes

   subroutine forget_piece()
      if (allocated(piece)) deallocate (piece)
   end subroutine forget_piece

end module subdomain_output
