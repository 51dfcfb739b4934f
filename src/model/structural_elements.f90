!> Shells and beams in terms of the unknowns of nodes and rotation nodes; stiffness and nodal forces of bars and springs.
!! Matrices, forces and displacements of shells and beams are transformed. The components of a node of rotations are rotations times
!! an arm; in the plane only the first one, about z, is used. Springs are bars with directions of their own; where a spring has one
!! node, its second node is the ground.
module structural_elements
   use kinds, only: wp
   use mesh_queries, only: element_points
   use model_data, only: a_spring, bar_nodes, bar_type, mesh_type, model_type, temperature_type
   use shell_element, only: shell_bubble_load
   use shell_recovery, only: shell_stresses
   use temperatures, only: element_rise, element_slope
   implicit none
   private

   public :: structural_stress, nodal_values, between_own, onto_own, own_to_values, add_bubble_load
   public :: bar_elongation, thermal_tension, add_axial_force, add_bar_forces, bar_stiffness, unit_tension, matrix_forces

   integer, parameter, public :: most_own = 16 !! own nodes of an element: its nodes and their rotations

contains

   !> T: the nodal values (3, 2 corners) of element E, as defined in shell_element and beam_element, due to a unit of each unknown
   !! of its own nodes (one column each), components of node 1 first.
   pure function own_to_values(mesh, e) result(t)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e
      real(wp), allocatable :: t(:, :)            !! (6 corners, 2 dimension corners)
      integer :: c, d, i, m

      d = mesh%dimension
      associate (nodes => element_points(mesh, e))
         m = size(nodes)
         allocate (t(6*m, 2*d*m), source=0.0_wp)
         do i = 1, m
            associate (arm => mesh%rotations(mesh%rotation_of(nodes(i)))%arm)
               do c = 1, d
                  t(3*(i - 1) + c, d*(i - 1) + c) = 1.0_wp
                  if (d == 3) t(3*(m + i - 1) + c, d*(m + i - 1) + c) = 1.0_wp/arm
               end do
               if (d == 2) t(3*(m + i), d*(m + i - 1) + 1) = 1.0_wp/arm
            end associate
         end do
      end associate
   end function own_to_values

   !> Transform FULL, a matrix between the nodal values of element E, to K between its unknowns.
   pure subroutine between_own(model, e, full, k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: full(:, :)
      real(wp), intent(inout)      :: k(:, :) !! set here; one row and column per unknown

      associate (t => own_to_values(model%mesh, e))
         k(:size(t, 2), :size(t, 2)) = matmul(matmul(transpose(t), full(:size(t, 1), :size(t, 1))), t)
      end associate
   end subroutine between_own

   !> Transform forces on the nodal values to forces F on the own nodes.
   pure subroutine onto_own(mesh, e, nodal, f)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: e
      real(wp), intent(in)         :: nodal(:, :) !! (3, 2 corners) [force], [force length]
      real(wp), intent(inout)      :: f(:, :)     !! (dimension, own nodes) [force], set here

      associate (t => own_to_values(mesh, e), d => mesh%dimension)
         f(:d, :size(t, 2)/d) = reshape(matmul(reshape(nodal, [size(t, 1)]), t), [d, size(t, 2)/d])
      end associate
   end subroutine onto_own

   !> Add to FORCE what a load Q per area [force/length^2] on the bubble of shell E exerts on its nodes, if it has eight.
   pure subroutine add_bubble_load(mesh, e, q, force)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: e
      real(wp), intent(in)        :: q(:, :)      !! (3, nodes)
      real(wp), intent(inout)     :: force(:, :)  !! (3, n_nodes) [force]
      real(wp) :: f(3, most_own), nodal(3, most_own)

      associate (nodes => element_points(mesh, e))
         if (size(nodes) /= most_own/2) return
         call shell_bubble_load(mesh%structural%shells(mesh%structural%place(e)), mesh%x(:, nodes), q, nodal)
         call onto_own(mesh, e, nodal, f)
         associate (own => [nodes, mesh%rotations(mesh%rotation_of(nodes))%node])
            force(:, own) = force(:, own) + f
         end associate
      end associate
   end subroutine add_bubble_load

   !> The nodal values (3, 2 corners) of element E for displacements U of its own nodes [length], [rad].
   pure function nodal_values(model, e, u) result(values)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :)     !! (dimension, own nodes) [length]
      real(wp), allocatable :: values(:, :)

      associate (t => own_to_values(model%mesh, e))
         values = reshape(matmul(t, reshape(u, [size(u)])), [3, size(u, 2)])
      end associate
   end function nodal_values

   !> Stresses of shell E in global axes, (xx, yy, zz, xy, yz, zx), at the heights Z above its mean plane, at its corners and then
   !! at its centre, under displacements U of its own nodes.
   pure subroutine structural_stress(model, e, u, temperature, z, stress)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      real(wp), intent(in)         :: u(:, :)     !! (3, own nodes) [length]
      type(temperature_type), intent(in) :: temperature
      real(wp), intent(in)         :: z(:)        !! [length]
      real(wp), intent(out)        :: stress(:, :, :) !! (6, corners + 1, heights) [pressure]

      call shell_stresses(model%mesh%structural%shells(model%mesh%structural%place(e)), &
                          model%mesh%x(:, element_points(model%mesh, e)), nodal_values(model, e, u), &
                          element_rise(model, e, temperature), element_slope(model, e, temperature), z, stress)
   end subroutine structural_stress

   !> Elongation of BAR under the displacements U of its bar_nodes [length].
   pure real(wp) function bar_elongation(bar, u) result(elongation)
      type(bar_type), intent(in) :: bar
      real(wp), intent(in)       :: u(:, :) !! (dimension, bar_nodes) [length]
      real(wp) :: second(size(u, 1))

      associate (d => size(u, 1))
         second = 0.0_wp
         elongation = 0.0_wp
         if (allocated(bar%matrix)) return
         if (size(u, 2) == 2) second = u(:, 2)
         elongation = dot_product(second - u(:, 1), bar%direction(:d, 2)) + &
                      dot_product(u(:, 1), bar%direction(:d, 2) - bar%direction(:d, 1))
      end associate
   end function bar_elongation

   !> Tension of BAR at constant length and at this TEMPERATURE: compression where the mean temperature along the bar rises above
   !! TREF; zero for a spring [force].
   pure real(wp) function thermal_tension(bar, temperature) result(tension)
      type(bar_type), intent(in)         :: bar
      type(temperature_type), intent(in) :: temperature

      tension = 0.0_wp
      if (bar%kind == a_spring .or. .not. allocated(temperature%at)) return
      tension = 0.5_wp*sum(temperature%at(bar%nodes)) - temperature%reference_share*bar%reference
      if (allocated(temperature%own)) tension = tension + temperature%own(1, bar%column)
      tension = -bar%stiffness*bar%expansion*tension
   end function thermal_tension

   !> Add to F the nodal forces of bar I under a tension N.
   pure subroutine add_axial_force(model, i, n, f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp), intent(in)         :: n       !! [force]
      real(wp), intent(inout)      :: f(:, :) !! (dimension, n_nodes) [force]

      associate (bar => model%mesh%bars(i), d => model%mesh%dimension)
         f(:, bar%nodes(1)) = f(:, bar%nodes(1)) + n*bar%direction(:d, 1)
         if (bar%nodes(2) > 0) f(:, bar%nodes(2)) = f(:, bar%nodes(2)) - n*bar%direction(:d, 2)
      end associate
   end subroutine add_axial_force

   !> The nodal forces of bar I under the tension 1; their product with displacements is the bar's shortening.
   pure function unit_tension(model, i) result(f)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp), allocatable :: f(:, :) !! (dimension, n_nodes) [-]

      allocate (f(model%mesh%dimension, model%mesh%n_nodes), source=0.0_wp)
      call add_axial_force(model, i, 1.0_wp, f)
   end function unit_tension

   !> Add to F the internal forces of the elastic bars under the displacements U.
   pure subroutine add_bar_forces(model, is_elastic, u, f)
      type(model_type), intent(in) :: model
      logical, intent(in)          :: is_elastic(:) !! (bars)
      real(wp), intent(in)         :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp), intent(inout)      :: f(:, :) !! (dimension, n_nodes) [force]
      integer :: i

      do i = 1, size(is_elastic)
         associate (bar => model%mesh%bars(i))
            if (allocated(bar%matrix)) f(:, bar%of_matrix) = f(:, bar%of_matrix) + matrix_forces(bar, u)
            if (is_elastic(i)) call add_axial_force(model, i, -bar%stiffness*bar_elongation(bar, u(:, bar_nodes(bar))), f)
         end associate
      end do
   end subroutine add_bar_forces

   !> [k] of bar I between its nodes, components of node 1 first; zero for the ground [force/length].
   pure function bar_stiffness(model, i) result(k)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      real(wp), allocatable :: k(:, :)
      real(wp) :: between(2*model%mesh%dimension)

      associate (bar => model%mesh%bars(i), d => model%mesh%dimension)
         between = [-bar%direction(:d, 1), bar%direction(:d, 2)]
         if (bar%nodes(2) == 0) between(d + 1:) = 0.0_wp
         k = spread(bar%stiffness*between, 2, 2*d)*spread(between, 1, 2*d)
         if (allocated(bar%matrix)) k = bar%matrix
      end associate
   end function bar_stiffness

   !> The internal forces of a BAR with a matrix on its nodes under the displacements U.
   pure function matrix_forces(bar, u) result(f)
      type(bar_type), intent(in) :: bar
      real(wp), intent(in)       :: u(:, :) !! (dimension, n_nodes) [length]
      real(wp) :: f(size(u, 1), size(bar%of_matrix))
      integer  :: d, i, j

      d = size(u, 1)
      f = 0.0_wp
      do j = 1, size(f, 2)
         do i = 1, size(f, 2)
            f(:, i) = f(:, i) + matmul(bar%matrix(d*(i - 1) + 1:d*i, d*(j - 1) + 1:d*j), u(:, bar%of_matrix(j)))
         end do
      end do
   end function matrix_forces

end module structural_elements
