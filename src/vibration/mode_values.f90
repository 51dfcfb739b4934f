!> The values of a natural mode: frequency, shape, masses, participation, strain energy and loss factor. The strain energy is
!! given for each body, bar and joint, there separately for normal and shear stiffness; the loss factor has a contribution of
!! the joints. The forces [k] {u} are computed element by element and do not depend on the factor of the eigensolution.
!!
!!      generalised mass     m_r = u^T [m] u            participation  g_d = u^T [m] e_d/m_r, e_d all nodes by 1 along d
!!      effective mass       g_d^2 m_r; summed over all modes the mass that is not held at supports
!!      residual             |[k] u - lambda [m] u|/|[k] u| on free components; for a rigid-body mode over |sigma [m] u|
!!      loss factor          of materials PARAM G + sum of GE U_e/U, U_e the strain energy of an element or bar, U that of the mode;
!!                           and of joints sum of a_i W/(2 pi U): W the loss of their Masing loops at the amplitude asked for
!! Source of the share by strain energy: C. D. Johnson, D. A. Kienholz, Finite element prediction of damping in structures with
!! constrained viscoelastic layers, AIAA Journal 20 (1982) 1284-1290.
!!
!! Every combination of modes of equal frequency is a mode, as for the bending modes of a square column; rounding decides which
!! of them an algorithm finds. The choice is made unique here: the first mode has their whole participation along x, the next
!! the whole remaining participation along y, then z. Modes without participation are separated by the displacements of the
!! nodes, in their order.
module mode_values
   use analysis_state, only: analysis_type
   use body_elements, only: element_stiffness
   use eigenpairs, only: all_displacements, on_equations
   use element_kinds, only: max_section_dofs
   use element_mapping, only: two_pi
   use element_unknowns, only: displaced_nodes
   use equation_solver, only: equation_system
   use interface_operator, only: add_force, joint_movement
   use joint_laws, only: force_along
   use kinds, only: wp
   use mass_matrix, only: mass_times, total_mass
   use connected_bodies, only: find_bodies
   use mesh_queries, only: is_shell, n_points
   use model_data, only: bar_nodes, model_type, n_bars
   use natural_modes, only: spectrum_type
   use oscillating_structure, only: oscillating_type
   use normal_curve, only: normal_tangent
   use normal_stiffness, only: branch_open
   use shear_loops, only: loss_of_element
   use stage_plan, only: vibration_plan_type
   use structural_elements, only: add_axial_force, bar_elongation, matrix_forces
   use tolerances, only: equal_eigenvalues, undamped, weak_participation
   implicit none
   private

   public :: settle_equal_modes, settle_sign, evaluate_modes, strain_energies

   real(wp), parameter :: near = 0.9283_wp     ! of the largest component: rounding must not choose between equals

   !> Of one mode [force x length].
   type, public :: energy_type
      real(wp), allocatable :: body(:), shell(:)   !! (bodies), and the part of their shells in that
      real(wp), allocatable :: bar(:)              !! (bars)
      real(wp), allocatable :: normal(:), shear(:) !! (joints)
      real(wp) :: damped = 0.0_wp                  !! of bodies and bars, each part times GE; a cycle loses 2 pi times this
   contains
      procedure :: total, scale
   end type energy_type

   type, public :: mode_type
      real(wp) :: lambda = 0.0_wp                   !! omega^2 [1/time^2]
      real(wp) :: omega = 0.0_wp, frequency = 0.0_wp !! [1/time]
      logical  :: is_rigid = .false.                !! a rigid-body mode
      real(wp) :: mass = 0.0_wp                     !! generalised [force time^2/length]
      real(wp) :: participation(3) = 0.0_wp         !! along x, y, z; of a ring along y alone [-]
      real(wp) :: effective(3) = 0.0_wp             !! mass [force time^2/length]
      real(wp) :: residual = 0.0_wp                 !! [-]
      real(wp) :: loss = 0.0_wp                     !! loss factor of joints, where an amplitude is given [-]
      real(wp) :: material_loss = 0.0_wp            !! its part from materials and PARAM G [-]
      real(wp), allocatable :: u(:, :)              !! (dimension, n_nodes) shape [length]
      type(energy_type) :: energy                   !! shares of the strain energy, with sum 1; 0 for a rigid-body mode
   end type mode_type

   !> The modes of a stage.
   type, public :: modes_type
      type(mode_type), allocatable :: modes(:)
      integer  :: n_before = 0                      !! modes below the range
      integer  :: n_counted = 0                     !! modes below COUNTED_AT, all found
      real(wp) :: reach = 0.0_wp                    !! frequency up to which no mode is missing [1/time]; huge: these are all modes
      real(wp) :: counted_at = 0.0_wp               !! frequency [1/time]; no bound: huge
      real(wp) :: mass = 0.0_wp                     !! of the structure [force time^2/length]
      real(wp) :: centre(3) = 0.0_wp                !! of that [length]
      real(wp) :: inertia(6) = 0.0_wp               !! about its axes: I_xx, I_yy, I_zz, I_xy, I_yz, I_zx [force time^2 length]
      integer  :: n_touching = 0                     !! interface elements in contact, which have stiffness
      real(wp), allocatable :: steeper(:)           !! (joints) how many times stiffer the default E_u is than the loading curves
                                                    !! there; 0: E_u is given, or the stiffness is that of loading [-]
   end type modes_type

contains

   !> Rotate the shapes of every group of equal LAMBDA among themselves: for each row of PARTICIPATION that is not weak, then of U,
   !! give the remaining components to one mode.
   subroutine settle_equal_modes(lambda, mass, participation, u)
      real(wp), intent(in)    :: lambda(:)           !! ascending
      real(wp), intent(in)    :: mass                !! of the structure
      real(wp), intent(inout) :: participation(:, :) !! (directions, modes)
      real(wp), intent(inout) :: u(:, :, :)          !! (dimension, n_nodes, modes), of generalised mass 1
      integer :: at(2), d, last, next

      last = 0
      do while (last < size(lambda))
         next = last + 1 ! the first mode of the group
         last = next
         do while (last < size(lambda))
            if (lambda(last + 1) - lambda(last) > equal_eigenvalues*abs(lambda(last + 1))) exit
            last = last + 1
         end do
         do d = 1, size(participation, 1)
            if (next == last) exit
            if (norm2(participation(d, next:last)) > weak_participation*sqrt(max(mass, 0.0_wp))) &
               call give_to_one((participation(d, next:last)))
         end do
         do while (next < last) ! the first component and node, in their order, whose displacement in all modes is almost
                                ! the largest
            associate (squares => sum(u(:, :, next:last)**2, dim=3))
               at = findloc(squares >= near**2*maxval(squares), .true.)
            end associate
            call give_to_one((u(at(1), at(2), next:last)))
         end do
      end do

   contains

      !> Reflect the modes from NEXT on (Householder) so that the first of them has all of ROW, and continue with the next.
      subroutine give_to_one(row)
         real(wp), intent(in) :: row(:)
         real(wp) :: v(size(row)), along
         integer  :: c, n

         v = row
         v(1) = row(1) + sign(norm2(row), row(1))
         v = v/norm2(v)
         do n = 1, size(participation, 1)
            along = dot_product(v, participation(n, next:last))
            participation(n, next:last) = participation(n, next:last) - 2.0_wp*along*v
         end do
         do n = 1, size(u, 2)
            do c = 1, size(u, 1)
               along = dot_product(v, u(c, n, next:last))
               u(c, n, next:last) = u(c, n, next:last) - 2.0_wp*along*v
            end do
         end do
         next = next + 1
      end subroutine give_to_one

   end subroutine settle_equal_modes

   !> Set the sign of a shape: its largest component, the first of almost equal ones, is positive.
   pure subroutine settle_sign(participation, u)
      real(wp), intent(inout) :: participation(:), u(:, :)
      integer :: at(2)

      at = findloc(abs(u) >= near*maxval(abs(u)), .true.)
      if (u(at(1), at(2)) >= 0.0_wp) return
      u = -u
      participation = -participation
   end subroutine settle_sign

   !> The modes of PLAN, from SPECTRUM.
   subroutine evaluate_modes(model, analysis, structure, plan, spectrum, system, modes)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      type(oscillating_type), intent(in)    :: structure
      type(vibration_plan_type), intent(in) :: plan
      type(spectrum_type), intent(in)       :: spectrum
      class(equation_system), intent(in)    :: system
      type(modes_type), intent(out)         :: modes
      real(wp), allocatable :: u(:, :, :), of_mass(:, :), e(:, :), f(:, :, :), g(:, :)
      type(energy_type), allocatable :: energies(:)
      integer :: d, m, n

      modes%n_before = spectrum%n_before
      modes%n_counted = spectrum%n_counted
      modes%reach = merge(sqrt(spectrum%reach)/two_pi, huge(1.0_wp), spectrum%reach < huge(1.0_wp))
      modes%counted_at = merge(sqrt(spectrum%counted_at)/two_pi, huge(1.0_wp), spectrum%counted_at < huge(1.0_wp))
      modes%n_touching = count(analysis%states%normal%branch /= branch_open)
      modes%steeper = [(merge(0.0_wp, default_steepness(model, analysis, d), plan%on_loading), d = 1, size(model%joints%list))]
      call total_mass(model, structure%mass, modes%mass, modes%centre, modes%inertia)
      n = size(spectrum%lambda)
      allocate (u(model%mesh%dimension, model%mesh%n_nodes, n), g(model%mesh%dimension, n))
      allocate (e(model%mesh%dimension, model%mesh%n_nodes), of_mass(model%mesh%dimension, model%mesh%n_nodes))
      do m = 1, n
         u(:, :, m) = all_displacements(model, system, spectrum%x(:, m))
      end do
      do d = 1, model%mesh%dimension                                       ! g(d, m) = u^T [m] e_d
         e = 0.0_wp
         e(d, :n_points(model%mesh)) = 1.0_wp
         where (model%mesh%is_scalar) e(d, :size(model%mesh%is_scalar)) = 0.0_wp
         call mass_times(model, structure%mass, e, of_mass)
         do m = 1, n
            g(d, m) = sum(u(:, :, m)*of_mass)
         end do
      end do
      if (model%mesh%axisymmetric) g(1, :) = 0.0_wp ! a ring has rigid-body motion along its axis only
      call settle_equal_modes(spectrum%lambda, modes%mass, g, u)
      n = spectrum%n_wanted
      do m = 1, n
         call settle_sign(g(:, m), u(:, :, m))
      end do
      allocate (energies(n), f(model%mesh%dimension, model%mesh%n_nodes, n), modes%modes(n))
      call strain_energies(model, structure, u(:, :, :n), energies, f)
      do m = 1, n
         call mass_times(model, structure%mass, u(:, :, m), of_mass)
         associate (mode => modes%modes(m))
            mode%lambda = spectrum%lambda(m)
            mode%is_rigid = m <= spectrum%n_rigid
            mode%participation(:model%mesh%dimension) = g(:, m)
            allocate (mode%u, source=u(:, :, m))
            mode%energy = energies(m)
            call evaluate_mode(model, analysis, plan, system, f(:, :, m), of_mass, mode)
         end associate
      end do
   end subroutine evaluate_modes

   !> The stiffness of the elements of joint J in contact by the default E_u over that of their loading curves; 0: E_u is given.
   pure real(wp) function default_steepness(model, analysis, j) result(ratio)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer, intent(in)             :: j
      real(wp) :: area, tangent
      integer  :: i

      ratio = 0.0_wp
      area = 0.0_wp
      tangent = 0.0_wp
      associate (joint => model%joints%list(j), law => model%joints%list(j)%law%normal)
         if (joint%e_u_given) return
         do i = joint%first, joint%last
            associate (state => analysis%states(i)%normal)
               if (state%branch == branch_open) cycle
               area = area + model%joints%element(i)%area
               tangent = tangent + normal_tangent(law, model%joints%element(i)%area, max(0.0_wp, state%pressure), joint%p_av)
            end associate
         end do
         if (tangent > 0.0_wp) ratio = law%e_u*(area/tangent)
      end associate
   end function default_steepness

   !> The values of MODE from lambda, the computed u, u^T [m] e_d as participation, the energies, F = [k] u and OF_MASS = [m] u.
   !! With NORM = MAX the shape is scaled so that its largest component at a point of the structure is 1; its sign is kept.
   subroutine evaluate_mode(model, analysis, plan, system, f, of_mass, mode)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      type(vibration_plan_type), intent(in) :: plan
      class(equation_system), intent(in)    :: system
      real(wp), intent(in)                  :: f(:, :), of_mass(:, :)
      type(mode_type), intent(inout)        :: mode
      real(wp) :: force(system%n), inertia(system%n), factor, share

      mode%omega = sqrt(max(0.0_wp, mode%lambda))
      mode%frequency = mode%omega/two_pi
      force = on_equations(model, system, f)
      inertia = on_equations(model, system, of_mass)
      if (mode%is_rigid) then
         mode%residual = norm2(force)/norm2(system%shift*inertia)
      else
         mode%residual = norm2(force - mode%lambda*inertia)/norm2(force)
      end if
      mode%mass = sum(mode%u*of_mass)
      mode%effective = mode%participation**2/mode%mass
      mode%participation = mode%participation/mode%mass
      if (plan%unit_mass) then
         factor = 1.0_wp/sqrt(mode%mass)
      else
         factor = 1.0_wp/maxval(abs(mode%u(:, :n_points(model%mesh))))
      end if
      mode%u = factor*mode%u
      mode%mass = factor**2*mode%mass
      mode%participation = mode%participation/factor
      call mode%energy%scale(factor**2)
      share = 0.0_wp
      if (.not. mode%is_rigid) then
         mode%material_loss = plan%damping
         if (mode%energy%damped > undamped*mode%energy%total()) &
            mode%material_loss = plan%damping + mode%energy%damped/mode%energy%total()
         mode%loss = mode%material_loss
         if (plan%amplitude > 0.0_wp) mode%loss = mode%loss + loss_of_joints(model, analysis, plan, mode)
         share = 1.0_wp/mode%energy%total()
      end if
      call mode%energy%scale(share)            ! convert the energies to shares
      mode%energy%body = abs(mode%energy%body) ! a negative value is rounding
   end subroutine evaluate_mode

   !> The contribution of joints to the loss factor of MODE, with the amplitude of PLAN as its largest displacement.
   pure real(wp) function loss_of_joints(model, analysis, plan, mode) result(loss)
      type(model_type), intent(in)          :: model
      type(analysis_type), intent(in)       :: analysis
      type(vibration_plan_type), intent(in) :: plan
      type(mode_type), intent(in)           :: mode
      real(wp) :: movement(3), lost, factor
      integer  :: i

      factor = plan%amplitude/sqrt(maxval(sum(mode%u(:, :n_points(model%mesh))**2, dim=1)))
      lost = 0.0_wp
      do i = 1, size(model%joints%element)
         associate (state => analysis%states(i), law => model%joints%list(model%joints%element(i)%joint)%law)
            if (state%normal%branch == branch_open) cycle
            movement = factor*joint_movement(model%joints%element(i), mode%u)
            lost = lost + model%joints%element(i)%area*loss_of_element(law, max(0.0_wp, state%normal%pressure), movement(:2))
         end associate
      end do
      loss = lost/(two_pi*factor**2*mode%energy%total())
   end function loss_of_joints

   !> The total energy.
   pure real(wp) function total(self)
      class(energy_type), intent(in) :: self

      total = sum(self%body) + sum(self%bar) + sum(self%normal) + sum(self%shear)
   end function total

   !> Multiply all parts by FACTOR.
   pure subroutine scale(self, factor)
      class(energy_type), intent(inout) :: self
      real(wp), intent(in)              :: factor

      self%body = factor*self%body
      self%shell = factor*self%shell
      self%bar = factor*self%bar
      self%normal = factor*self%normal
      self%shear = factor*self%shear
      self%damped = factor*self%damped
   end subroutine scale

   !> The strain energies of the shapes U, half of u^T [k] u for each part, and the forces F = [k] U. Each element is formed once,
   !! for all shapes.
   pure subroutine strain_energies(model, structure, u, energies, f)
      type(model_type), intent(in)       :: model
      type(oscillating_type), intent(in) :: structure
      real(wp), intent(in)               :: u(:, :, :)  !! (dimension, n_nodes, modes) [length]
      type(energy_type), intent(out)     :: energies(:) !! (modes)
      real(wp), intent(out)              :: f(:, :, :)  !! as U [force]
      real(wp), allocatable :: forces(:, :)
      real(wp) :: k(max_section_dofs, max_section_dofs), q(max_section_dofs, size(energies))
      real(wp) :: p(max_section_dofs, size(energies)), energy
      real(wp) :: elongation, movement(3), tension
      integer  :: body(model%mesh%n_elements), d, e, i, j, m, n, n_bodies

      d = model%mesh%dimension
      f = 0.0_wp
      call find_bodies(model%mesh, body, n_bodies)
      do m = 1, size(energies)
         allocate (energies(m)%body(n_bodies), energies(m)%shell(n_bodies), energies(m)%bar(n_bars(model%mesh)), &
                   energies(m)%normal(size(model%joints%list)), energies(m)%shear(size(model%joints%list)), source=0.0_wp)
      end do
      do e = 1, model%mesh%n_elements
         call element_stiffness(model, e, k)
         associate (nodes => displaced_nodes(model%freedoms, e))
            n = d*size(nodes)
            q(:n, :) = reshape(u(:, nodes, :), [n, size(energies)])
            p(:n, :) = matmul(k(:n, :n), q(:n, :))
            f(:, nodes, :) = f(:, nodes, :) + reshape(p(:n, :), [d, size(nodes), size(energies)])
         end associate
         do m = 1, size(energies)
            energy = 0.5_wp*dot_product(q(:n, m), p(:n, m))
            energies(m)%body(body(e)) = energies(m)%body(body(e)) + energy
            if (is_shell(model%mesh, e)) energies(m)%shell(body(e)) = energies(m)%shell(body(e)) + energy
            energies(m)%damped = energies(m)%damped + model%mesh%properties(model%mesh%element_property(e))%damping*energy
         end do
      end do
      do m = 1, size(energies)
         do i = 1, n_bars(model%mesh)
            if (.not. structure%is_elastic(i)) cycle
            associate (bar => model%mesh%bars(i))
               if (allocated(bar%matrix)) then
                  forces = matrix_forces(bar, u(:, :, m))
                  energies(m)%bar(i) = 0.5_wp*sum(u(:, bar%of_matrix, m)*forces)
                  f(:, bar%of_matrix, m) = f(:, bar%of_matrix, m) + forces
                  cycle
               end if
               elongation = bar_elongation(bar, u(:, bar_nodes(bar), m))
               tension = bar%stiffness*elongation
               energies(m)%bar(i) = 0.5_wp*tension*elongation
               energies(m)%damped = energies(m)%damped + bar%damping*energies(m)%bar(i)
               call add_axial_force(model, i, -tension, f(:, :, m))
            end associate
         end do
         do i = 1, size(model%joints%element)
            movement = joint_movement(model%joints%element(i), u(:, :, m))
            associate (force => force_along(structure%k(:, i), movement))
               j = model%joints%element(i)%joint
               energies(m)%shear(j) = energies(m)%shear(j) + 0.5_wp*sum(force(:2)*movement(:2))
               energies(m)%normal(j) = energies(m)%normal(j) + 0.5_wp*force(3)*movement(3)
               call add_force(model%joints%element(i), force, f(:, :, m))
            end associate
         end do
      end do
   end subroutine strain_energies

end module mode_values
