!> Which part of the structure each process has. Nodes are dealt by METIS, so that few elements lie between two parts; an element
!! belongs to the part of its first node. The nodes that have unknowns are the BLOCKS of the equations, the part of rank 0 first, as
!! many rows in each as there are dimensions: of a held component the row is that of the identity.
module shares
   use body_parts, only: extract, nodes_of_elements
   use kinds, only: wp
   use metis, only: part_by_metis
   use model_data, only: corners_of, model_type
   use node_coupling, only: is_coupled
   use node_graph, only: node_graph_type
   use part_messages, only: receive_part, send_part
   use ranks, only: n_ranks, receive, send
   use section_coupling, only: section_node
   use unknown_motions, only: is_ordinary, motions_of, n_motions
   implicit none
   private

   public :: deal_blocks, share_of, is_entangled, send_share, receive_share, forget_elements

   !> How rank 0 has dealt the nodes.
   type, public :: deal_type
      integer, allocatable :: owner(:)        !! (n_nodes) rank, -1: no unknowns
      integer, allocatable :: block(:)        !! (n_nodes) from 0 on, -1: none
      integer, allocatable :: order(:)        !! (blocks) the node of each
      integer, allocatable :: counts(:)       !! (ranks) blocks of each
   end type deal_type

   !> What one process has.
   type, public :: share_type
      integer :: dimension = 0
      integer :: n_blocks = 0                 !! of all processes
      integer :: n_own = 0
      integer :: first = 0                    !! of the own blocks, from 0 on
      type(model_type) :: model               !! the elements, on nodes numbered anew: nothing else of it is set
      integer, allocatable  :: block(:)       !! (nodes of that)
      logical, allocatable  :: held(:, :)     !! (dimension, nodes of that)
      logical, allocatable  :: held_own(:, :) !! (dimension, own blocks)
      integer, allocatable  :: inside(:), outside(:) !! (own blocks) neighbours that this process has, itself counted, and others
      real(wp), allocatable :: x(:, :)        !! (dimension, own blocks) where they are [length]
      integer, allocatable  :: odd(:)         !! own blocks whose unknowns are no displacements in global axes
      real(wp), allocatable :: odd_motions(:, :, :) !! (dimension, motions, of these) as unknown_motions has them
   end type share_type

contains

   !> Deal the nodes that have unknowns.
   subroutine deal_blocks(model, graph, deal, ok)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      type(deal_type), intent(out)      :: deal
      logical, intent(out)              :: ok
      integer :: i, n, r

      call part_by_metis(graph, n_ranks, deal%owner, ok)
      if (.not. ok) return
      where (.not. model%used) deal%owner = -1
      allocate (deal%block(model%n_nodes), source=-1)
      allocate (deal%order(count(model%used)), deal%counts(n_ranks))
      n = 0
      do r = 0, n_ranks - 1
         deal%counts(r + 1) = count(deal%owner == r)
         do i = 1, model%n_nodes
            if (deal%owner(i) /= r) cycle
            deal%block(i) = n
            n = n + 1
            deal%order(n) = i
         end do
      end do
   end subroutine deal_blocks

   !> The share of process R.
   subroutine share_of(model, graph, deal, r, share)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      type(deal_type), intent(in)       :: deal
      integer, intent(in)               :: r
      type(share_type), intent(out)     :: share
      integer :: b, i, k, node
      logical, allocatable :: is_odd(:)

      share%dimension = model%dimension
      share%n_blocks = size(deal%order)
      share%n_own = deal%counts(r + 1)
      share%first = sum(deal%counts(:r))
      allocate (share%held_own(model%dimension, share%n_own), share%x(model%dimension, share%n_own))
      allocate (share%inside(share%n_own), source=1)
      allocate (share%outside(share%n_own), source=0)
      do b = 1, share%n_own
         node = deal%order(share%first + b)
         share%held_own(:, b) = model%held(:, node)
         share%x(:, b) = model%x(:model%dimension, node)
         do k = graph%first(node), graph%first(node + 1) - 1
            i = deal%owner(graph%neighbours(k))
            if (i == r) then
               share%inside(b) = share%inside(b) + 1
            else if (i >= 0) then
               share%outside(b) = share%outside(b) + 1
            end if
         end do
      end do
      allocate (is_odd(share%n_own))
      do b = 1, share%n_own
         is_odd(b) = .not. is_ordinary(model, deal%order(share%first + b))
      end do
      share%odd = pack([(b, b = 1, share%n_own)], is_odd)
      allocate (share%odd_motions(model%dimension, n_motions(model%dimension), size(share%odd)))
      do b = 1, size(share%odd)
         share%odd_motions(:, :, b) = motions_of(model, deal%order(share%first + share%odd(b)))
      end do
      call take_elements(model, deal, r, share)
   end subroutine share_of

   !> The elements of process R whose nodes have unknowns of their own, in global axes; rank 0 forms the others itself.
   subroutine take_elements(model, deal, r, share)
      type(model_type), intent(in)    :: model
      type(deal_type), intent(in)     :: deal
      integer, intent(in)             :: r
      type(share_type), intent(inout) :: share
      integer, allocatable :: mine(:), nodes(:)
      integer :: e, n

      allocate (mine(model%n_elements))
      n = 0
      do e = 1, model%n_elements
         if (deal%owner(model%element_nodes(1, e)) /= r .or. is_entangled(model, e)) cycle
         n = n + 1
         mine(n) = e
      end do
      nodes = nodes_of_elements(model, mine(:n))
      call extract(model, mine(:n), nodes, share%model)
      share%block = deal%block(nodes)
      share%held = model%held(:, nodes)
   end subroutine take_elements

   !> Whether element E has nodes that move with the unknowns of others, in axes of their own, or at the section of a bolt.
   pure logical function is_entangled(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      is_entangled = section_node(model, e) > 0
      if (.not. is_entangled) is_entangled = is_coupled(model, corners_of(model, e))
   end function is_entangled

   !> The matrix is there: what it was made of is not needed any more.
   subroutine forget_elements(share)
      type(share_type), intent(inout) :: share
      type(model_type) :: nothing

      share%model = nothing
      deallocate (share%block, share%held, share%held_own, share%inside, share%outside, share%x)
   end subroutine forget_elements

   !> Send SHARE to process R.
   subroutine send_share(share, r)
      type(share_type), intent(in) :: share
      integer, intent(in)          :: r

      call send(r, [share%dimension, share%n_blocks, share%n_own, share%first])
      call send_part(share%model, r)
      call send(r, share%block)
      call send(r, reshape(merge(1, 0, share%held), [size(share%held)]))
      call send(r, reshape(merge(1, 0, share%held_own), [size(share%held_own)]))
      call send(r, share%inside)
      call send(r, share%outside)
      call send(r, reshape(share%x, [size(share%x)]))
      call send(r, share%odd)
      call send(r, reshape(share%odd_motions, [size(share%odd_motions)]))
   end subroutine send_share

   !> The SHARE that rank 0 has sent.
   subroutine receive_share(share)
      type(share_type), intent(out) :: share
      integer, allocatable  :: words(:), sizes(:)
      real(wp), allocatable :: values(:)

      call receive(sizes)
      share%dimension = sizes(1)
      share%n_blocks = sizes(2)
      share%n_own = sizes(3)
      share%first = sizes(4)
      call receive_part(share%model)
      associate (piece => share%model, d => share%dimension)
         call receive(share%block)
         call receive(words)
         share%held = reshape(words == 1, [d, piece%n_nodes])
         call receive(words)
         share%held_own = reshape(words == 1, [d, share%n_own])
         call receive(share%inside)
         call receive(share%outside)
         call receive(values)
         share%x = reshape(values, [d, share%n_own])
         call receive(share%odd)
         call receive(values)
         share%odd_motions = reshape(values, [d, n_motions(d), size(share%odd)])
      end associate
   end subroutine receive_share

end module shares
