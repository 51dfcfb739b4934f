!> Writes the piece of the bodies that this process owns.
!! Rank 0 sends the piece once, and the displacements of its nodes for every file. A piece has its own elements and all others that
!! meet at its nodes, so that no process asks another for its part of a nodal mean.
module subdomain_output
   use body_parts, only: body_piece_type
   use distribution, only: piece_writer
   use kinds, only: wp
   use lists, only: list_owners
   use model_data, only: n_sections, temperature_type
   use partition, only: pass_part
   use ranks, only: pass, pass_text, rank, sum_of_all
   implicit none
   private

   public :: writes_by, pass_piece, receive_piece, send_state, write_received, write_own, forget_piece

   type(body_piece_type), allocatable :: piece !! piece of this process; not of rank 0
   procedure(piece_writer), pointer :: write_piece => null()

contains

   !> Set the WRITER of the pieces.
   subroutine writes_by(writer)
      procedure(piece_writer) :: writer

      write_piece => writer
   end subroutine writes_by

   !> Send the piece OWN from rank 0 to process R.
   subroutine pass_piece(r, own)
      integer, intent(in)                  :: r
      type(body_piece_type), intent(inout) :: own
      integer :: n, n_shown

      call pass_part(r, own%model)
      associate (part => own%model, shown => own%shown)
         if (rank == 0) then
            n = n_sections(part)
            n_shown = size(shown%elements)
         end if
         call pass(r, shown%n_points, shown%is_warm, n_shown, n)
         if (rank /= 0) then
            allocate (shown%elements(n_shown), part%node_id(part%n_nodes), part%element_id(part%n_elements))
            call list_owners(part%n_nodes, part%element_nodes, part%first_at, part%elements_at)
            if (n > 0) allocate (part%element_section(part%n_elements), part%node_section(part%n_nodes), part%sections(n))
         end if
         call pass(r, shown%elements, part%node_id, part%element_id)
         if (n > 0) call pass(r, part%element_section, part%node_section, part%sections)
      end associate
   end subroutine pass_piece

   !> Receive the piece of this process from rank 0.
   subroutine receive_piece()
      call forget_piece()
      allocate (piece)
      call pass_piece(rank, piece)
   end subroutine receive_piece

   !> Send process R the displacements U and the TEMPERATURE of the NODES of its piece, and the data of its FILE.
   subroutine send_state(r, nodes, u, temperature, notes, file)
      integer, intent(in)                :: r, nodes(:)
      real(wp), intent(in)               :: u(:, :) !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      character(*), intent(in)           :: notes, file
      type(temperature_type)    :: own
      real(wp), allocatable     :: own_u(:, :)
      character(:), allocatable :: own_notes, own_file

      own = at_nodes(temperature, nodes)
      own_u = u(:, nodes)
      own_notes = notes
      own_file = file
      call pass_state(r, own_u, own, own_notes, own_file)
   end subroutine send_state

   !> Write the own piece in the state that rank 0 sends.
   subroutine write_received()
      type(temperature_type) :: temperature
      real(wp), allocatable  :: u(:, :)
      character(:), allocatable :: file, notes
      logical :: ok

      allocate (u(piece%model%dimension, piece%model%n_nodes))
      call pass_state(rank, u, temperature, notes, file)
      call write_piece(piece, u, temperature, notes, file, ok)
      call agree(ok)
   end subroutine write_received

   !> Send the state of a piece from rank 0 to process R.
   subroutine pass_state(r, u, temperature, notes, file)
      integer, intent(in)                      :: r
      real(wp), contiguous, intent(inout)      :: u(:, :)
      type(temperature_type), intent(inout)    :: temperature
      character(:), allocatable, intent(inout) :: notes, file
      integer :: n

      n = -1
      if (allocated(temperature%at)) n = size(temperature%at)
      call pass(r, u, temperature%reference_share, n)
      if (n >= 0 .and. rank /= 0) allocate (temperature%at(n))
      if (n >= 0) call pass(r, temperature%at)
      call pass_text(r, notes)
      call pass_text(r, file)
   end subroutine pass_state

   !> Rank 0: write the OWN piece. OK is false where any process could not write its piece.
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

   !> Whether the condition holds on all processes.
   subroutine agree(ok)
      logical, intent(inout) :: ok

      ok = sum_of_all(merge(0.0_wp, 1.0_wp, ok)) < 0.5_wp
   end subroutine agree

   !> The TEMPERATURE restricted to these NODES.
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
