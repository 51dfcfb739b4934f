!> What a run on many processes would have to do, counted in the partition of its mesh, without the run:
!!
!!    partition_plan DECK PROCESSES
!!
!! One line a quantity: `name least mean most` over the processes; what is of the whole has one number. The nodes are dealt as the
!! program deals them. A product of the matrix with a vector sends the displacements of the nodes at the border, once to each
!! process that has a neighbour of them; a step has six such products on the finest level, and three sums over all processes.
!! Memory is counted of what is known before the solution: rows of the matrix, as many again above their diagonal, the vectors.
program partition_plan
   use, intrinsic :: iso_fortran_env, only: error_unit
   use terminal, only: argument_text
   use deck_errors, only: deck_error_list
   use deck_input, only: deck_type, read_deck
   use kinds, only: wp
   use metis, only: part_by_metis
   use model_build, only: build_model
   use model_data, only: model_type
   use node_graph, only: build_node_graph, node_graph_type
   use stage_plan, only: stage_plan_type
   implicit none
   integer, parameter :: vectors = 20                 ! of steps, levels and earlier solutions
   type(deck_type)       :: deck
   type(deck_error_list) :: errors
   type(model_type)      :: model
   type(stage_plan_type) :: plan
   type(node_graph_type) :: graph
   character(:), allocatable :: text
   integer, allocatable  :: part(:), seen(:)
   real(wp), allocatable :: nodes(:), links(:), inside(:), received(:), sent(:), partners(:)
   logical, allocatable  :: meets(:, :)
   integer :: i, k, n, other, own, status
   logical :: ok, readable

   call read_deck(argument_text(1), deck, errors, readable)
   if (.not. readable) call stop_with('the deck cannot be read')
   call build_model(deck, model, plan, errors)
   if (errors%any()) call stop_with('the deck has errors')
   text = argument_text(2)
   read (text, *, iostat=status) n
   if (status /= 0) call stop_with('the number of processes is no number')
   call build_node_graph(model, graph)
   call part_by_metis(graph, n, part, ok)
   if (.not. ok) call stop_with('METIS deals nothing')

   allocate (nodes(n), links(n), inside(n), received(n), sent(n), partners(n), source=0.0_wp)
   allocate (seen(n), source=0)
   allocate (meets(n, n), source=.false.)
   do i = 1, model%mesh%n_nodes
      own = part(i) + 1
      nodes(own) = nodes(own) + 1.0_wp
      do k = graph%first(i), graph%first(i + 1) - 1
         other = part(graph%neighbours(k)) + 1
         if (other == own) then
            inside(own) = inside(own) + 1.0_wp
            cycle
         end if
         links(own) = links(own) + 1.0_wp
         if (seen(other) == i) cycle
         seen(other) = i
         sent(own) = sent(own) + 1.0_wp
         received(other) = received(other) + 1.0_wp
         meets(own, other) = .true.
      end do
   end do
   partners = real(count(meets, dim=2), wp)

   associate (d => real(model%mesh%dimension, wp))
      print '(a, 1x, i0)', 'processes', n
      print '(a, 1x, i0)', 'unknowns', model%mesh%dimension*model%mesh%n_nodes
      print '(a, 1x, f0.0)', 'edge_cut', 0.5_wp*sum(links)
      call show('nodes', nodes)
      call show('partners', partners)
      call show('halo_nodes', received)
      call show('bytes_sent_a_product', 8.0_wp*d*sent)
      call show('bytes_of_the_matrix', (8.0_wp*d*d + 4.0_wp*d*d)*(inside + links + nodes))
      call show('bytes_of_upper_blocks', (8.0_wp*d*d + 4.0_wp)*(0.5_wp*(inside + links) + nodes))
      call show('bytes_of_vectors', 8.0_wp*vectors*d*(nodes + received))
   end associate

contains

   subroutine show(name, values)
      character(*), intent(in) :: name
      real(wp), intent(in)     :: values(:)

      print '(a, 3(1x, f0.0))', name, minval(values), sum(values)/size(values), maxval(values)
   end subroutine show

   subroutine stop_with(words)
      character(*), intent(in) :: words

      write (error_unit, '(2a)') 'partition_plan: ', words
      error stop 1
   end subroutine stop_with

end program partition_plan
