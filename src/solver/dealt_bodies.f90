!> The bodies as they are dealt out to several processes, each of which shows a piece: what results need of whoever deals them.
module dealt_bodies
   use body_parts, only: body_piece_type
   use kinds, only: wp
   use model_data, only: temperature_type
   implicit none
   private

   type, abstract, public :: dealt_bodies_type
      integer :: n = 0 !! pieces
   contains
      procedure(write_pieces), deferred :: write
   end type dealt_bodies_type

   abstract interface
      !> Write all pieces under the displacements U at this TEMPERATURE, each into the file of its name, which is there and empty. OK is
      !! false where one could not be written.
      subroutine write_pieces(self, u, temperature, notes, files, ok)
         import :: dealt_bodies_type, temperature_type, wp
         class(dealt_bodies_type), intent(in) :: self
         real(wp), intent(in)               :: u(:, :)  !! (dimension, n_nodes) [length]
         type(temperature_type), intent(in) :: temperature
         character(*), intent(in)           :: notes    !! for the piece_writer
         character(*), intent(in)           :: files(:) !! (n) their names
         logical, intent(out)               :: ok
      end subroutine write_pieces
   end interface

   public :: piece_writer

   abstract interface
      !> Write one PIECE into FILE, likewise: what every process is told to do with its own.
      subroutine piece_writer(piece, u, temperature, notes, file, ok)
         import :: body_piece_type, temperature_type, wp
         type(body_piece_type), intent(in)  :: piece
         real(wp), intent(in)               :: u(:, :)  !! (dimension, nodes of its model) [length]
         type(temperature_type), intent(in) :: temperature !! at these nodes
         character(*), intent(in)           :: notes, file
         logical, intent(out)               :: ok
      end subroutine piece_writer
   end interface

end module dealt_bodies
