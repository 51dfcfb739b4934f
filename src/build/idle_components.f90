!> Components without stiffness: NASTRAN's AUTOSPC. Such a component of a node is held, and a warning names it.
!! The nodes are those of springs, bars and rigid elements, of beams without a section constant or with pins, and of shells without a
!! membrane or bending; other shells, beams and bodies give stiffness to all components of their nodes. A load along the idle motion
!! leaves the component free, and the structure a mechanism, as do idle motions of several nodes together.
module idle_components
   use body_elements, only: coupled_stiffness
   use element_unknowns, only: nodes_of_unknowns
   use kinds, only: wp
   use mesh_queries, only: element_points, is_beam, is_shell, n_points, n_rotations, node_kind, open_left_out, point_of, &
                           shown_number
   use model_data, only: a_rotation, bar_nodes, model_type, n_bars, stage_load_type
   use node_coupling, only: between_unknowns, forces_on_unknowns, unknown_nodes
   use structural_elements, only: bar_stiffness
   use text_tools, only: integer_text, plural, one_of
   use tolerances, only: idle_stiffness
   use unknowns, only: rotation_at
   use wave_build, only: planned_wave
   implicit none
   private

   public :: hold_idle

   integer, parameter :: most_named = 10

contains

   !> Hold the idle components of MODEL that no load of a stage or OSCILLATING load moves. WORDS: a warning that names them, or ''.
   subroutine hold_idle(oscillating, model, words)
      type(planned_wave), intent(in)    :: oscillating(:)
      type(model_type), intent(inout)   :: model
      character(:), allocatable, intent(out) :: words
      real(wp), allocatable :: k(:, :, :), f(:, :, :)
      integer, allocatable  :: place(:)      ! (n_nodes) among the nodes that are examined, 0: none
      integer :: c, d, i, n, n_held, n_named, node
      logical :: idle(model%mesh%dimension)

      words = ''
      call find_examined(model, place)
      n = maxval(place)
      if (n == 0) return
      d = model%mesh%dimension
      call add_stiffness(model, place, n, k)
      call add_loads(model, oscillating, place, n, f)
      n_held = 0
      n_named = 0
      do node = 1, size(place)
         if (place(node) == 0) cycle
         i = place(node)
         call find_idle(k(:, :, i), f(:, :, i), model%freedoms%held(:, node), idle)
         if (.not. any(idle)) cycle
         call open_left_out(model%mesh, model%freedoms)
         model%freedoms%left_out(:, node) = model%freedoms%left_out(:, node) .or. idle
         model%freedoms%held(:, node) = model%freedoms%held(:, node) .or. idle
         n_held = n_held + count(idle)
         n_named = n_named + 1
         if (n_named > most_named) cycle
         words = words//one_of(n_named == 1, ' ', '; ')//integer_text(shown_number(model%mesh, point_of(model%mesh, node)))//':'
         do c = 1, d
            if (idle(c)) words = words//' '//integer_text(merge(c, merge(c + 3, 6, d == 3), &
                                                          node_kind(model%mesh, node) /= a_rotation))
         end do
      end do
      if (n_named > most_named) words = words//'; and others'
      if (n_held > 0) words = plural(n_held, 'component')//' of nodes without stiffness '//one_of(n_held == 1, 'is', 'are')// &
                              ' held (PARAM AUTOSPC), with no load on '//one_of(n_held == 1, 'it', 'them')// &
                              '; node: components:'//words
   end subroutine hold_idle

   !> PLACE: the nodes to examine, numbered. Not examined: nodes without free unknowns, and nodes of an element that gives stiffness to
   !! all their components.
   subroutine find_examined(model, place)
      type(model_type), intent(in)      :: model
      integer, allocatable, intent(out) :: place(:)
      logical :: is_stiff(model%mesh%n_nodes)
      integer :: e, i, n, node, r

      is_stiff = .not. model%freedoms%used .or. all(model%freedoms%held, dim=1)
      is_stiff(n_points(model%mesh) + n_rotations(model%mesh) + 1:) = .true. ! pretension sections
      do e = 1, model%mesh%n_elements
         if (.not. is_complete(model, e)) cycle
         associate (points => element_points(model%mesh, e))
            is_stiff(points) = .true.
            if (.not. (is_beam(model%mesh, e) .or. is_shell(model%mesh, e))) cycle
            do i = 1, size(points)
               r = rotation_at(model%mesh, points(i))
               if (r > 0) is_stiff(model%mesh%rotations(r)%node) = .true.
            end do
         end associate
      end do
      do i = 1, size(model%joints%element)
         is_stiff(unknown_nodes(model%freedoms, model%joints%element(i)%node)) = .true.
      end do
      allocate (place(model%mesh%n_nodes), source=0)
      n = 0
      do node = 1, size(place)
         if (is_stiff(node)) cycle
         n = n + 1
         place(node) = n
      end do
   end subroutine find_examined

   !> Whether element E gives stiffness to all components of its nodes.
   pure logical function is_complete(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      is_complete = .true.
      if (size(model%mesh%structural%place) == 0) return
      associate (structural => model%mesh%structural, i => model%mesh%structural%place(e))
         if (i == 0) return
         if (is_beam(model%mesh, e)) then
            associate (law => structural%beams(i))
               is_complete = law%area > 0.0_wp .and. all(law%inertia(:2) > 0.0_wp) .and. law%torsion*law%g > 0.0_wp .and. &
                             .not. (any(law%released) .or. law%is_cut)
            end associate
         else
            is_complete = structural%shells(i)%d(1, 1) > 0.0_wp .and. structural%shells(i)%bending(1, 1) > 0.0_wp
         end if
      end associate
   end function is_complete

   !> K: the stiffness between the components of each of the N nodes that are examined, at its PLACE.
   subroutine add_stiffness(model, place, n, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: place(:), n
      real(wp), allocatable, intent(out) :: k(:, :, :) !! (dimension, dimension, n) [force/length]
      real(wp), allocatable :: of_element(:, :)
      integer :: e, i

      allocate (k(model%mesh%dimension, model%mesh%dimension, n), source=0.0_wp)
      do e = 1, model%mesh%n_elements
         associate (nodes => nodes_of_unknowns(model%freedoms, e))
            if (all(place(nodes) == 0)) cycle
            call coupled_stiffness(model, e, of_element)
            call add(nodes, of_element)
         end associate
      end do
      do i = 1, n_bars(model%mesh)
         associate (nodes => unknown_nodes(model%freedoms, bar_nodes(model%mesh%bars(i))))
            if (any(place(nodes) > 0)) call add(nodes, between_unknowns(model, bar_nodes(model%mesh%bars(i)), &
                                                                        bar_stiffness(model, i)))
         end associate
      end do

   contains

      subroutine add(nodes, of_nodes)
         integer, intent(in)  :: nodes(:)
         real(wp), intent(in) :: of_nodes(:, :)
         integer :: a

         associate (d => model%mesh%dimension)
            do a = 1, size(nodes)
               if (place(nodes(a)) > 0) k(:, :, place(nodes(a))) = k(:, :, place(nodes(a))) + &
                                                                  of_nodes(d*(a - 1) + 1:d*a, d*(a - 1) + 1:d*a)
            end do
         end associate
      end subroutine add

   end subroutine add_stiffness

   !> F: the loads at the end of each stage, and those that oscillate, on each of the N nodes that are examined, at its PLACE.
   subroutine add_loads(model, oscillating, place, n, f)
      type(model_type), intent(in)      :: model
      type(planned_wave), intent(in)    :: oscillating(:)
      integer, intent(in)               :: place(:), n
      real(wp), allocatable, intent(out) :: f(:, :, :) !! (dimension, loads, n) [force]
      integer :: s

      allocate (f(model%mesh%dimension, size(model%history%stages) + size(oscillating), n), source=0.0_wp)
      do s = 1, size(model%history%stages)
         call add(model%history%stages(s), s)
      end do
      do s = 1, size(oscillating)
         call add(oscillating(s)%load, size(model%history%stages) + s)
      end do

   contains

      subroutine add(loads, column)
         type(stage_load_type), intent(in) :: loads
         integer, intent(in) :: column
         real(wp) :: force(model%mesh%dimension, model%mesh%n_nodes)
         integer  :: i

         if (loads%n == 0) return
         force = 0.0_wp
         do i = 1, loads%n
            force(:, loads%node(i)) = force(:, loads%node(i)) + loads%force(:model%mesh%dimension, i)
         end do
         force = forces_on_unknowns(model, force)
         do i = 1, size(place)
            if (place(i) > 0) f(:, column, place(i)) = force(:, i)
         end do
      end subroutine add

   end subroutine add_loads

   !> IDLE: the components of a node with stiffness K, beside those HELD, that remain when pivots are taken from the largest down as
   !! far as they are not zero. None is idle where a load F moves them.
   pure subroutine find_idle(k, f, held, idle)
      real(wp), intent(in)  :: k(:, :) !! (dimension, dimension)
      real(wp), intent(in)  :: f(:, :) !! (dimension, loads)
      logical, intent(in)   :: held(:)
      logical, intent(out)  :: idle(:)
      real(wp) :: a(size(k, 1), size(k, 1)), b(size(k, 1), size(f, 2)), diagonal(size(k, 1)), scale
      integer  :: c, i

      a = k
      b = f
      idle = .not. held
      scale = maxval([(k(i, i), i = 1, size(k, 1))])
      do while (any(idle))
         diagonal = [(a(i, i), i = 1, size(k, 1))]
         c = maxloc(diagonal, dim=1, mask=idle)
         if (diagonal(c) <= idle_stiffness*scale) exit
         idle(c) = .false.
         b = b - spread(a(:, c)/diagonal(c), 2, size(b, 2))*spread(b(c, :), 1, size(b, 1))
         a = a - spread(a(:, c), 2, size(a, 1))*spread(a(c, :), 1, size(a, 1))/diagonal(c)
      end do
      do c = 1, size(idle)
         if (idle(c) .and. any(abs(b(c, :)) > idle_stiffness*maxval(abs(f)))) idle = .false.
      end do
   end subroutine find_idle

end module idle_components
