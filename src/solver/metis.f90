!> METIS: the order of a graph by nested dissection, a separator, parts. Several threads may call it at the same time for different
!! graphs: what METIS takes from the C library and all threads would share, random numbers and handlers of signals, is replaced here.
!! Source: METIS 5.1, Karypis, Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392.
module metis
   use, intrinsic :: iso_c_binding, only: c_associated, c_funptr, c_int, c_int32_t, c_long, c_null_funptr, c_null_ptr, c_ptr, &
                                          c_size_t
   use node_graph, only: node_graph_type
   use omp_lib, only: omp_in_parallel
   implicit none
   private

   public :: order_by_metis, separate_by_metis, part_by_metis, has_room, restore_abort

   integer, parameter :: metis_ok = 1           ! METIS_OK
   integer, parameter :: words = 8              ! words of memory per node or link for METIS

   interface
      integer(c_int32_t) function metis_node_nd(n, first, neighbours, weights, options, old_of_new, new_of_old) &
         bind(c, name='METIS_NodeND')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in)    :: n, first(*), neighbours(*)  !! from 0 on
         type(c_ptr), value                :: weights, options            !! null: defaults of METIS
         integer(c_int32_t), intent(out)   :: old_of_new(*), new_of_old(*)
      end function metis_node_nd

      integer(c_int32_t) function metis_separator(n, first, neighbours, weights, options, n_separated, side) &
         bind(c, name='METIS_ComputeVertexSeparator')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in)    :: n, first(*), neighbours(*)  !! from 0 on
         type(c_ptr), value                :: weights, options            !! likewise
         integer(c_int32_t), intent(out)   :: n_separated, side(*)        !! 0 or 1; 2: in the separator
      end function metis_separator

      integer(c_int32_t) function metis_part_kway(n, constraints, first, neighbours, weights, sizes, link_weights, parts, shares, &
                                                  imbalance, options, cut, part) bind(c, name='METIS_PartGraphKway')
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in)  :: n, constraints, first(*), neighbours(*), parts
         type(c_ptr), value              :: weights, sizes, link_weights, shares, imbalance, options
         integer(c_int32_t), intent(out) :: cut, part(*)
      end function metis_part_kway

      !> The action at SIGNAL from now on, until it comes once; gives the previous action. A name of glibc.
      type(c_funptr) function c_sysv_signal(signal, handler) bind(c, name='sysv_signal')
         import :: c_funptr, c_int
         integer(c_int), value :: signal
         type(c_funptr), value :: handler
      end function c_sysv_signal

      !> Begin and continue the random numbers of rand with a generator of one's own. Names of glibc.
      integer(c_int) function c_initstate_r(seed, state, bytes, generator) bind(c, name='initstate_r')
         import :: c_int, c_long, c_size_t
         integer(c_int), value            :: seed
         integer(c_size_t), value         :: bytes
         integer(c_long), intent(inout)   :: state(*), generator(*)
      end function c_initstate_r

      integer(c_int) function c_random_r(generator, number) bind(c, name='random_r')
         import :: c_int, c_int32_t, c_long
         integer(c_long), intent(inout)  :: generator(*)
         integer(c_int32_t), intent(out) :: number
      end function c_random_r
   end interface

   integer(c_int), parameter :: sigabrt = 6, sigterm = 15 ! of Linux

   integer(c_long), save :: generator(8) = 0, state(16)   ! of this thread: random_data of glibc, and 128 bytes as rand has them
   !$omp threadprivate(generator, state)

contains

   !> ORDER(k) is the k-th node of GRAPH to be eliminated, by nested dissection. OK is false where METIS lacks memory.
   subroutine order_by_metis(graph, order, ok)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable, intent(out) :: order(:)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: old_of_new(graph%n), new_of_old(graph%n)

      ok = .true.
      old_of_new = 0
      if (graph%n > 1) ok = metis_node_nd(graph%n, graph%first - 1, graph%neighbours - 1, c_null_ptr, c_null_ptr, old_of_new, &
                                          new_of_old) == metis_ok
      if (ok) order = old_of_new + 1
   end subroutine order_by_metis

   !> Whether METIS has the memory for GRAPH.
   logical function has_room(graph)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable :: room(:, :)
      integer :: status

      allocate (room(words, graph%n + size(graph%neighbours)), stat=status)
      has_room = status == 0
   end function has_room

   !> Cut GRAPH in two: SIDE of every node is 0, 1, or 2 for the separator. OK is false where METIS fails; without memory it would end
   !! the program.
   subroutine separate_by_metis(graph, side, ok)
      type(node_graph_type), intent(in) :: graph
      integer, allocatable, intent(out) :: side(:)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: n_separated

      allocate (side(graph%n), source=2)
      ok = metis_separator(graph%n, graph%first - 1, graph%neighbours - 1, c_null_ptr, c_null_ptr, n_separated, side) == metis_ok
   end subroutine separate_by_metis

   !> PART, 0 to N_PARTS - 1, of every node of GRAPH: parts of similar size with few links between them. OK as above.
   subroutine part_by_metis(graph, n_parts, part, ok)
      type(node_graph_type), intent(in) :: graph
      integer, intent(in)               :: n_parts
      integer, allocatable, intent(out) :: part(:) !! (graph%n)
      logical, intent(out)              :: ok
      integer(c_int32_t) :: cut

      allocate (part(graph%n), source=0)
      ok = .true.
      if (n_parts == 1 .or. graph%n < n_parts) return
      ok = has_room(graph)
      if (.not. ok) return
      ok = metis_part_kway(graph%n, 1, graph%first - 1, graph%neighbours - 1, c_null_ptr, c_null_ptr, c_null_ptr, n_parts, &
                           c_null_ptr, c_null_ptr, c_null_ptr, cut, part) == metis_ok
   end subroutine part_by_metis

   !> After calls by several threads: SIGABRT is again that of the system.
   subroutine restore_abort()
      type(c_funptr) :: before

      before = c_sysv_signal(sigabrt, c_null_funptr)
   end subroutine restore_abort

   !> Called by METIS in place of the routine of the C library. METIS sets handlers of its own for its errors while it works: at SIGTERM
   !! it would give up the order, and the program would go on. The handler of the program stays for SIGTERM. Among several threads
   !! none removes the handler for want of memory, which the others use: order_parts does.
   type(c_funptr) function metis_signal(signal, handler) bind(c, name='__sysv_signal') result(before)
      integer(c_int), value :: signal
      type(c_funptr), value :: handler

      before = c_null_funptr
      if (omp_in_parallel() .and. .not. c_associated(handler)) return
      if (signal /= sigterm) before = c_sysv_signal(signal, handler)
   end function metis_signal

   !> Called by METIS in place of rand and srand of the C library, whose numbers all threads share: with a generator for each thread
   !! the numbers that METIS meets after each of its calls of srand are the same whatever other threads do.
   subroutine metis_srand(seed) bind(c, name='srand')
      integer(c_int), value :: seed

      integer(c_int) :: status

      generator = 0
      status = c_initstate_r(seed, state, 128_c_size_t, generator)
   end subroutine metis_srand

   integer(c_int) function metis_rand() bind(c, name='rand')
      if (generator(1) == 0) call metis_srand(1_c_int) ! rand without srand
      if (c_random_r(generator, metis_rand) /= 0) metis_rand = 0
   end function metis_rand

end module metis
