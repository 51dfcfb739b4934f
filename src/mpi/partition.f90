!> Which part of the structure each process has. Nodes are dealt by METIS, so that few elements lie between two parts; an element
!! belongs to the part of its first node. The nodes that have unknowns are the BLOCKS of the equations, the part of rank 0 first, as
!! many rows in each as there are dimensions: of a held component the row is that of the identity.
module partition
   use body_parts, only: extract, nodes_of_elements
   use kinds, only: wp
   use model_data, only: corners_of, is_beam, is_shell, model_type
   use nested_dissection, only: part_by_metis
   use node_coupling, only: is_coupled, section_node
   use node_graph, only: node_graph_type
   use ranks, only: n_ranks, pass, rank
   use unknowns, only: is_ordinary, motions_of, n_motions
   implicit none
   private

   public :: partition_nodes, subdomain_of, is_entangled, pass_subdomain, forget_elements, pass_part

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
      integer, allocatable :: mine(:), nodes(:)
      logical, allocatable :: is_odd(:)
      integer :: b, e, node

      subdomain%dimension = model%dimension
      subdomain%n_blocks = size(parts%order)
      subdomain%n_own = parts%counts(r + 1)
      subdomain%first = sum(parts%counts(:r))
      associate (d => model%dimension, n => subdomain%n_own)
         allocate (subdomain%held_own(d, n), subdomain%x(d, n), subdomain%inside(n), subdomain%outside(n), is_odd(n))
      end associate
      do b = 1, subdomain%n_own
         node = parts%order(subdomain%first + b)
         subdomain%held_own(:, b) = model%held(:, node)
         subdomain%x(:, b) = model%x(:model%dimension, node)
         is_odd(b) = .not. is_ordinary(model, node)
         associate (owners => parts%owner(graph%neighbours(graph%first(node):graph%first(node + 1) - 1)))
            subdomain%inside(b) = 1 + count(owners == r)
            subdomain%outside(b) = count(owners >= 0 .and. owners /= r)
         end associate
      end do
      subdomain%odd = pack([(b, b = 1, subdomain%n_own)], is_odd)
      allocate (subdomain%odd_motions(model%dimension, n_motions(model%dimension), size(subdomain%odd)))
      do b = 1, size(subdomain%odd)
         subdomain%odd_motions(:, :, b) = motions_of(model, parts%order(subdomain%first + subdomain%odd(b)))
      end do
      ! elements whose nodes have unknowns of their own, in global axes; rank 0 forms the others itself
      mine = pack([(e, e = 1, model%n_elements)], parts%owner(model%element_nodes(1, :)) == r)
      mine = pack(mine, [(.not. is_entangled(model, mine(e)), e = 1, size(mine))])
      nodes = nodes_of_elements(model, mine)
      call extract(model, mine, nodes, subdomain%model)
      subdomain%block = parts%block(nodes)
      subdomain%held = model%held(:, nodes)
   end subroutine subdomain_of

   !> Whether element E has nodes that move with the unknowns of others, in axes of their own, at the section of a bolt, or with rotations.
   pure logical function is_entangled(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      is_entangled = section_node(model, e) > 0 .or. is_shell(model, e) .or. is_beam(model, e)
      if (.not. is_entangled) is_entangled = is_coupled(model, corners_of(model, e))
   end function is_entangled

   !> The matrix is there: what it was made of is not needed any more.
   subroutine forget_elements(subdomain)
      type(subdomain_type), intent(inout) :: subdomain
      type(model_type) :: nothing

      subdomain%model = nothing
      deallocate (subdomain%block, subdomain%held, subdomain%held_own, subdomain%inside, subdomain%outside, subdomain%x)
   end subroutine forget_elements

   !> SUBDOMAIN gets from rank 0 to process R.
   subroutine pass_subdomain(r, subdomain)
      integer, intent(in)                 :: r
      type(subdomain_type), intent(inout) :: subdomain
      integer :: n_odd

      n_odd = 0
      if (rank == 0) n_odd = size(subdomain%odd)
      call pass(r, subdomain%dimension, subdomain%n_blocks, subdomain%n_own, subdomain%first, n_odd)
      call pass_part(r, subdomain%model)
      associate (d => subdomain%dimension, nodes => subdomain%model%n_nodes, own => subdomain%n_own)
         if (rank /= 0) then
            allocate (subdomain%block(nodes), subdomain%held(d, nodes), subdomain%held_own(d, own), subdomain%inside(own), &
                      subdomain%outside(own), subdomain%x(d, own), subdomain%odd(n_odd), &
                      subdomain%odd_motions(d, n_motions(d), n_odd))
         end if
      end associate
      call pass(r, subdomain%block, subdomain%held, subdomain%held_own, subdomain%inside, subdomain%outside)
      call pass(r, subdomain%x, subdomain%odd, subdomain%odd_motions)
   end subroutine pass_subdomain

   !> What extract of body_parts has set of PART gets from rank 0 to process R.
   subroutine pass_part(r, part)
      integer, intent(in)             :: r
      type(model_type), intent(inout) :: part
      integer :: n_corners, n_properties

      if (rank == 0) then
         n_corners = size(part%element_nodes, 1)
         n_properties = size(part%properties)
      end if
      call pass(r, part%dimension, part%n_elements, part%n_nodes, n_corners, n_properties)
      if (rank /= 0) then
         allocate (part%element_kind(part%n_elements), part%element_property(part%n_elements), part%x(3, part%n_nodes), &
                   part%element_nodes(n_corners, part%n_elements), part%properties(n_properties))
      end if
      call pass(r, part%element_kind, part%element_property, part%element_nodes, part%x, part%properties)
   end subroutine pass_part

end module partition
