!> What a bolt bears after an increment, and of which load: of bars and of solid bolts alike.
module bolt_answer
   use analysis_state, only: analysis_type
   use body_elements, only: element_thermal_forces, felt_stiffness
   use bolt_locking, only: bar_tension, elongation_now, overlap_now, section_tension
   use element_kinds, only: max_felt_dofs, max_nodes
   use kinds, only: wp
   use model_data, only: corners_of, model_type, n_bars, n_sections, section_type, temperature_type
   use section_coupling, only: corner_displacements
   use surface_build, only: surface_node_list, surface_nodes
   use vector_product, only: cross
   implicit none
   private

   public :: n_bolts, find_bolts, load_along, bending_moment

   type, public :: bolt_type
      integer  :: id = 0                  !! of its BOLT card
      integer  :: element = 0             !! its CROD; 0: a solid bolt
      integer  :: section = 0             !! of a solid bolt, its position among the sections of the model
      logical  :: is_tightened = .false.  !! in this stage
      real(wp) :: direction(3) = 0.0_wp   !! along it, unit
      real(wp) :: force = 0.0_wp          !! tension [force]
      real(wp) :: longer = 0.0_wp         !! a CROD: elongation; a solid bolt: minus what it was shortened by [length]
   end type bolt_type

contains

   !> How many bolts there are.
   pure integer function n_bolts(model) result(n)
      type(model_type), intent(in) :: model

      n = n_sections(model)
      if (n_bars(model) > 0) n = n + count(model%bars%bolt > 0)
   end function n_bolts

   !> All bolts as they are now: first those of CROD elements, then solid ones.
   pure function find_bolts(model, analysis) result(bolts)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(bolt_type), allocatable :: bolts(:)
      integer :: i, n

      allocate (bolts(n_bolts(model)))
      n = 0
      do i = 1, n_bars(model)
         associate (bar => model%bars(i))
            if (bar%bolt == 0) cycle
            n = n + 1
            bolts(n) = bolt_type(id=bar%bolt, element=bar%id, is_tightened=bar%stage == analysis%stage, &
                                 direction=bar%direction(:, 1), &
                                 force=bar_tension(model, analysis, i), longer=elongation_now(model, analysis, i))
         end associate
      end do
      do i = 1, n_sections(model)
         associate (section => model%sections(i))
            bolts(n + i) = bolt_type(id=section%bolt, section=i, is_tightened=section%stage == analysis%stage, &
                                     direction=section%direction, force=section_tension(model, analysis, i), &
                                     longer=-overlap_now(model, analysis, i))
         end associate
      end do
   end function find_bolts

   !> The load of the deck along DIRECTION when FRACTION of STAGE is done: of its nodal forces that way and of those against it
   !! the larger sum, so that of loads that balance each other one half counts [force]. Preloads are none of it.
   real(wp) function load_along(model, direction, stage, fraction) result(load)
      type(model_type), intent(in) :: model
      real(wp), intent(in)         :: direction(3)
      integer, intent(in)          :: stage    !! position; before the first there is no load
      real(wp), intent(in)         :: fraction
      real(wp), allocatable :: component(:)

      allocate (component(model%n_nodes), source=0.0_wp)
      if (stage > 0) call add(stage, fraction)
      if (stage > 1) call add(stage - 1, 1.0_wp - fraction)
      load = max(sum(component, mask=component > 0.0_wp), -sum(component, mask=component < 0.0_wp))

   contains

      subroutine add(s, share)
         integer, intent(in)  :: s
         real(wp), intent(in) :: share
         integer :: i

         if (share <= 0.0_wp) return
         associate (loads => model%stage_loads(s))
            do i = 1, loads%n
               component(loads%node(i)) = component(loads%node(i)) + share*dot_product(loads%force(:, i), direction)
            end do
         end associate
      end subroutine add

   end function load_along

   !> Bending moment at the section of a solid bolt: what the elements behind it exert on the nodes of the section, about the
   !! centroid of its area, across the bolt [force x length]. Weight of these elements is neglected.
   pure real(wp) function bending_moment(model, section, u, temperature) result(moment)
      type(model_type), intent(in)   :: model
      type(section_type), intent(in) :: section
      real(wp), intent(in)           :: u(:, :) !! (dimension, n_nodes) of all nodes [length]
      type(temperature_type), intent(in) :: temperature
      type(surface_node_list) :: list
      real(wp) :: centroid(3), force(3), thermal(3, max_nodes), total(3)
      real(wp) :: k(max_felt_dofs, max_felt_dofs), p(max_felt_dofs)
      integer  :: d, e, i, j, n, s

      d = model%dimension
      s = findloc(model%surfaces%id, section%surface, dim=1)
      call surface_nodes(model, model%surfaces(s), list)
      centroid = 0.0_wp
      do i = 1, list%n
         centroid = centroid + list%area(i)*model%x(:, list%node(i))/sum(list%area)
      end do
      total = 0.0_wp
      do j = model%first_at(section%node), model%first_at(section%node + 1) - 1
         e = model%elements_at(j)
         call felt_stiffness(model, e, k)
         call element_thermal_forces(model, e, temperature, thermal(:d, :))
         associate (nodes => corners_of(model, e))
            n = d*size(nodes)
            p(:n) = matmul(k(:n, :n), reshape(corner_displacements(model, e, u), [n]))
            do i = 1, size(nodes)
               if (model%node_section(nodes(i)) /= model%element_section(e)) cycle
               force = 0.0_wp
               force(:d) = p(d*(i - 1) + 1:d*i) - thermal(:d, i)
               total = total + cross(model%x(:, nodes(i)) - centroid, force)
            end do
         end associate
      end do
      total = total - dot_product(total, section%direction)*section%direction
      moment = norm2(total)
      if (model%axisymmetric) moment = 0.0_wp ! all round the ring it balances
   end function bending_moment

end module bolt_answer
