!> Which part of the structure each process has. Nodes are dealt by METIS, so that few elements lie between two parts; an element
!! belongs to the part of its first node. The nodes that have unknowns are the BLOCKS of the equations, the part of rank 0 first, as
!! many rows in each as there are dimensions: of a held component the row is that of the identity.
module partition
   use body_parts, only: extract, nodes_of_elements
   use kinds, only: wp
   use model_data, only: corners_of, model_type
   use nested_dissection, only: part_by_metis
   use node_coupling, only: is_coupled, section_node
   use node_graph, only: node_graph_type
   use ranks, only: n_ranks, receive, send
   use unknowns, only: is_ordinary, motions_of, n_motions
   implicit none
   private

   public :: partition_nodes, subdomain_of, is_entangled, send_subdomain, receive_subdomain, forget_elements, send_part, &
             receive_part

   !> How rank 0 has dealt the nodes.
   type, public :: partition_type
      integer, allocatable :: owner(:)        !! (n_nodes) rank, -1: no unknowns
      integer, allocatable :: block(:)        !! (n_nodes) from 0 on, -1: none
      integer, allocatable :: order(:)        !! (blocks) the node of each
      integer, allocatable :: counts(:)       !! (ranks) blocks of each
   end type partition_type

   !> What one process has.
   type, public :: subdomain_type
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
      real(wp), allocatable :: odd_motions(:, :, :) !! (dimension, motions, of these) as motions_of has them
   end type subdomain_type

   integer, parameter :: words_each = 3, values_each = 5 !! of a property

contains

   !> Deal the nodes that have unknowns.
   subroutine partition_nodes(model, graph, parts, ok)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      type(partition_type), intent(out)      :: parts
      logical, intent(out)              :: ok
      integer :: i, n, r

      call part_by_metis(graph, n_ranks, parts%owner, ok)
      if (.not. ok) return
      where (.not. model%used) parts%owner = -1
      allocate (parts%block(model%n_nodes), source=-1)
      allocate (parts%order(count(model%used)), parts%counts(n_ranks))
      n = 0
      do r = 0, n_ranks - 1
         parts%counts(r + 1) = count(parts%owner == r)
         do i = 1, model%n_nodes
            if (parts%owner(i) /= r) cycle
            parts%block(i) = n
            n = n + 1
            parts%order(n) = i
         end do
      end do
   end subroutine partition_nodes

   !> The subdomain of process R.
   subroutine subdomain_of(model, graph, parts, r, subdomain)
      type(model_type), intent(in)      :: model
      type(node_graph_type), intent(in) :: graph
      type(partition_type), intent(in)       :: parts
      integer, intent(in)               :: r
      type(subdomain_type), intent(out)     :: subdomain
      integer :: b, i, k, node
      logical, allocatable :: is_odd(:)

      subdomain%dimension = model%dimension
      subdomain%n_blocks = size(parts%order)
      subdomain%n_own = parts%counts(r + 1)
      subdomain%first = sum(parts%counts(:r))
      allocate (subdomain%held_own(model%dimension, subdomain%n_own), subdomain%x(model%dimension, subdomain%n_own))
      allocate (subdomain%inside(subdomain%n_own), source=1)
      allocate (subdomain%outside(subdomain%n_own), source=0)
      do b = 1, subdomain%n_own
         node = parts%order(subdomain%first + b)
         subdomain%held_own(:, b) = model%held(:, node)
         subdomain%x(:, b) = model%x(:model%dimension, node)
         do k = graph%first(node), graph%first(node + 1) - 1
            i = parts%owner(graph%neighbours(k))
            if (i == r) then
               subdomain%inside(b) = subdomain%inside(b) + 1
            else if (i >= 0) then
               subdomain%outside(b) = subdomain%outside(b) + 1
            end if
         end do
      end do
      allocate (is_odd(subdomain%n_own))
      do b = 1, subdomain%n_own
         is_odd(b) = .not. is_ordinary(model, parts%order(subdomain%first + b))
      end do
      subdomain%odd = pack([(b, b = 1, subdomain%n_own)], is_odd)
      allocate (subdomain%odd_motions(model%dimension, n_motions(model%dimension), size(subdomain%odd)))
      do b = 1, size(subdomain%odd)
         subdomain%odd_motions(:, :, b) = motions_of(model, parts%order(subdomain%first + subdomain%odd(b)))
      end do
      call take_elements(model, parts, r, subdomain)
   end subroutine subdomain_of

   !> The elements of process R whose nodes have unknowns of their own, in global axes; rank 0 forms the others itself.
   subroutine take_elements(model, parts, r, subdomain)
      type(model_type), intent(in)    :: model
      type(partition_type), intent(in)     :: parts
      integer, intent(in)             :: r
      type(subdomain_type), intent(inout) :: subdomain
      integer, allocatable :: mine(:), nodes(:)
      integer :: e, n

      allocate (mine(model%n_elements))
      n = 0
      do e = 1, model%n_elements
         if (parts%owner(model%element_nodes(1, e)) /= r .or. is_entangled(model, e)) cycle
         n = n + 1
         mine(n) = e
      end do
      nodes = nodes_of_elements(model, mine(:n))
      call extract(model, mine(:n), nodes, subdomain%model)
      subdomain%block = parts%block(nodes)
      subdomain%held = model%held(:, nodes)
   end subroutine take_elements

   !> Whether element E has nodes that move with the unknowns of others, in axes of their own, or at the section of a bolt.
   pure logical function is_entangled(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      is_entangled = section_node(model, e) > 0
      if (.not. is_entangled) is_entangled = is_coupled(model, corners_of(model, e))
   end function is_entangled

   !> The matrix is there: what it was made of is not needed any more.
   subroutine forget_elements(subdomain)
      type(subdomain_type), intent(inout) :: subdomain
      type(model_type) :: nothing

      subdomain%model = nothing
      deallocate (subdomain%block, subdomain%held, subdomain%held_own, subdomain%inside, subdomain%outside, subdomain%x)
   end subroutine forget_elements

   !> Send SUBDOMAIN to process R.
   subroutine send_subdomain(subdomain, r)
      type(subdomain_type), intent(in) :: subdomain
      integer, intent(in)          :: r

      call send(r, [subdomain%dimension, subdomain%n_blocks, subdomain%n_own, subdomain%first])
      call send_part(subdomain%model, r)
      call send(r, subdomain%block)
      call send(r, reshape(merge(1, 0, subdomain%held), [size(subdomain%held)]))
      call send(r, reshape(merge(1, 0, subdomain%held_own), [size(subdomain%held_own)]))
      call send(r, subdomain%inside)
      call send(r, subdomain%outside)
      call send(r, reshape(subdomain%x, [size(subdomain%x)]))
      call send(r, subdomain%odd)
      call send(r, reshape(subdomain%odd_motions, [size(subdomain%odd_motions)]))
   end subroutine send_subdomain

   !> The SUBDOMAIN that rank 0 has sent.
   subroutine receive_subdomain(subdomain)
      type(subdomain_type), intent(out) :: subdomain
      integer, allocatable  :: words(:), sizes(:)
      real(wp), allocatable :: values(:)

      call receive(sizes)
      subdomain%dimension = sizes(1)
      subdomain%n_blocks = sizes(2)
      subdomain%n_own = sizes(3)
      subdomain%first = sizes(4)
      call receive_part(subdomain%model)
      associate (piece => subdomain%model, d => subdomain%dimension)
         call receive(subdomain%block)
         call receive(words)
         subdomain%held = reshape(words == 1, [d, piece%n_nodes])
         call receive(words)
         subdomain%held_own = reshape(words == 1, [d, subdomain%n_own])
         call receive(subdomain%inside)
         call receive(subdomain%outside)
         call receive(values)
         subdomain%x = reshape(values, [d, subdomain%n_own])
         call receive(subdomain%odd)
         call receive(values)
         subdomain%odd_motions = reshape(values, [d, n_motions(d), size(subdomain%odd)])
      end associate
   end subroutine receive_subdomain

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

end module partition
