!> Writes the piece of the bodies that this process owns.
!! Rank 0 sends the piece once, and the displacements of its nodes for every file. A piece has its own elements and all others that
!! meet at its nodes, so that no process asks another for its part of a nodal mean.
module subdomain_output
   use body_parts, only: body_piece_type, cut_piece
   use distribution, only: piece_writer
   use kinds, only: wp
   use lists, only: list_owners
   use model_data, only: model_type, n_sections, temperature_type
   use partition, only: pass_part
   use ranks, only: n_ranks, pass, pass_text, rank, sum_of_all
   implicit none
   private

   public :: writes_by, cut_pieces, receive_piece, write_all, write_received, forget_piece

   type :: list_type
      integer, allocatable :: nodes(:)
   end type list_type

   type(body_piece_type), allocatable :: piece    !! of this process
   type(list_type), allocatable :: lists(:)       !! (0:ranks - 1) on rank 0: the nodes of every piece
   procedure(piece_writer), pointer :: write_piece => null()

contains

   !> Set the WRITER of the pieces.
   subroutine writes_by(writer)
      procedure(piece_writer) :: writer

      write_piece => writer
   end subroutine writes_by

   !> Rank 0: cut the bodies of MODEL into the pieces of all processes, OWNER(node), and send them.
   subroutine cut_pieces(model, owner)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: owner(:) !! (n_nodes) rank
      integer :: r

      call forget_piece()
      allocate (piece, lists(0:n_ranks - 1))
      do r = n_ranks - 1, 0, -1
         call cut_piece(model, owner, r, piece, lists(r)%nodes)
         if (r > 0) call pass_piece(r, piece)
      end do
   end subroutine cut_pieces

   !> Send the piece OWN from rank 0 to process R.
   subroutine pass_piece(r, own)
      integer, intent(in)                  :: r
      type(body_piece_type), intent(inout) :: own
      integer :: n, n_shown

      call pass_part(r, own%model)
      associate (part => own%model, shown => own%shown)
         if (rank == 0) then
            n = n_sections(part%mesh)
            n_shown = size(shown%elements)
         end if
         call pass(r, shown%n_points, shown%is_warm, n_shown, n)
         if (rank /= 0) then
            allocate (shown%elements(n_shown), part%mesh%node_id(part%mesh%n_nodes), part%mesh%element_id(part%mesh%n_elements))
            call list_owners(part%mesh%n_nodes, part%mesh%element_nodes, part%mesh%first_at, part%mesh%elements_at)
            if (n > 0) deallocate (part%mesh%element_section, part%mesh%node_section, part%mesh%sections)
            if (n > 0) allocate (part%mesh%element_section(part%mesh%n_elements), part%mesh%node_section(part%mesh%n_nodes), &
               part%mesh%sections(n))
         end if
         call pass(r, shown%elements, part%mesh%node_id, part%mesh%element_id)
         if (n > 0) call pass(r, part%mesh%element_section, part%mesh%node_section, part%mesh%sections)
      end associate
   end subroutine pass_piece

   !> Receive the piece of this process from rank 0.
   subroutine receive_piece()
      call forget_piece()
      allocate (piece)
      call pass_piece(rank, piece)
   end subroutine receive_piece

   !> Rank 0: send every process the displacements U and the TEMPERATURE of the nodes of its piece, and the data of its file, and
   !! write the own piece. OK is false where any process could not write its piece.
   subroutine write_all(u, temperature, notes, files, ok)
      real(wp), intent(in)               :: u(:, :)  !! (dimension, n_nodes) [length]
      type(temperature_type), intent(in) :: temperature
      character(*), intent(in)           :: notes
      character(*), intent(in)           :: files(:) !! (ranks)
      logical, intent(out)               :: ok
      type(temperature_type)    :: own
      real(wp), allocatable     :: own_u(:, :)
      character(:), allocatable :: own_notes, file
      integer :: r

      own%reference_share = temperature%reference_share
      own_notes = notes
      do r = n_ranks - 1, 0, -1
         own_u = u(:, lists(r)%nodes)
         if (allocated(temperature%at)) own%at = temperature%at(lists(r)%nodes)
         file = trim(files(r + 1))
         if (r > 0) call pass_state(r, own_u, own, own_notes, file)
      end do
      call write_own(own_u, own, notes, trim(files(1)), ok)
   end subroutine write_all

   !> Write the own piece in the state that rank 0 sends.
   subroutine write_received()
      type(temperature_type) :: temperature
      real(wp), allocatable  :: u(:, :)
      character(:), allocatable :: file, notes
      logical :: ok

      allocate (u(piece%model%mesh%dimension, piece%model%mesh%n_nodes))
      call pass_state(rank, u, temperature, notes, file)
      call write_own(u, temperature, notes, file, ok)
   end subroutine write_received

   !> Write the own piece under the displacements U of its nodes. OK is false where any process could not write its piece.
   subroutine write_own(u, temperature, notes, file, ok)
      real(wp), intent(in)               :: u(:, :)
      type(temperature_type), intent(in) :: temperature
      character(*), intent(in)           :: notes, file
      logical, intent(out)               :: ok

      call write_piece(piece, u, temperature, notes, file, ok)
      ok = sum_of_all(merge(0.0_wp, 1.0_wp, ok)) < 0.5_wp
   end subroutine write_own

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

   subroutine forget_piece()
      if (allocated(piece)) deallocate (piece)
      if (allocated(lists)) deallocate (lists)
   end subroutine forget_piece

end module subdomain_output
