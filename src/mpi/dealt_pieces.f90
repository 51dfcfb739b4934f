!> The bodies in pieces as rank 0 sees them: it cuts them by the deal of the equations, and has every process write its own.
module dealt_pieces
   use body_parts, only: body_piece_type, cut_piece
   use dealt_bodies, only: dealt_bodies_type
   use engine, only: order, order_cut, order_show
   use kinds, only: wp
   use model_data, only: model_type, temperature_type
   use own_piece, only: send_piece, send_state, write_own
   use ranks, only: n_ranks
   implicit none
   private

   public :: deal_pieces

   type :: list_type
      integer, allocatable :: nodes(:)
   end type list_type

   type, extends(dealt_bodies_type), public :: dealt_pieces_type
      private
      type(list_type), allocatable :: lists(:)  !! (0:n - 1) the nodes of every piece
      type(body_piece_type) :: own              !! that of rank 0
   contains
      procedure :: write
   end type dealt_pieces_type

contains

   !> Cut the bodies of MODEL as its nodes are dealt, OWNER, and send every process its piece.
   subroutine deal_pieces(model, owner, dealt)
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: owner(:) !! (n_nodes) rank; -1: none
      type(dealt_pieces_type), intent(out) :: dealt
      type(body_piece_type) :: other
      integer :: r

      dealt%n = n_ranks
      allocate (dealt%lists(0:n_ranks - 1))
      call order(order_cut)
      do r = 1, n_ranks - 1
         call cut_piece(model, owner, r, other, dealt%lists(r)%nodes)
         call send_piece(other, r)
      end do
      call cut_piece(model, owner, 0, dealt%own, dealt%lists(0)%nodes)
   end subroutine deal_pieces

   subroutine write(self, u, temperature, notes, files, ok)
      class(dealt_pieces_type), intent(in) :: self
      real(wp), intent(in)                 :: u(:, :)
      type(temperature_type), intent(in)   :: temperature
      character(*), intent(in)             :: notes, files(:)
      logical, intent(out)                 :: ok
      integer :: r

      call order(order_show)
      do r = 1, self%n - 1
         call send_state(r, self%lists(r)%nodes, u, temperature, notes, trim(files(r + 1)))
      end do
      call write_own(self%own, self%lists(0)%nodes, u, temperature, notes, trim(files(1)), ok)
   end subroutine write

end module dealt_pieces
