!> Beams with 12 dofs: axial force, bending in two planes with shear (Timoshenko), torsion.
!! Torsion is that of Saint-Venant. The shape functions are the deflections of a beam that is loaded at its ends alone; therefore
!! the stiffness and the nodal forces of loads along the beam are exact. A beam whose section changes has those of tapered_beam.
!! Source: J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968, sections 5.6 and 11.6.
!!
!! End values, in the axes of the beam: u, v, w, theta_x, theta_y, theta_z of end A, then of end B. Nodal values, (3, 4), in global
!! axes: displacements of both nodes [length], then their rotations [rad]; nodal forces likewise, then moments.
module beam_element
   use beam_sections, only: beam_section
   use kinds, only: wp
   use numbers, only: cross
   use tapered_beam, only: beam_station, carried, flexibility, gauss_at, gauss_weight, section_between, tapered_stiffness
   use tolerances, only: along_the_beam, released_pivot
   implicit none
   private

   public :: beam_axes, beam_length, beam_stiffness, beam_mass, beam_line_load, beam_point_load, beam_end_forces, &
             beam_nodal_forces, beam_section_at, beam_thermal_load

   !> A beam: its section and its connection to its nodes. Plane 1 contains the axis and the direction y of the beam (ORIENTATION).
   type, extends(beam_section), public :: beam_law
      real(wp) :: e = 0.0_wp, g = 0.0_wp       !! [pressure]
      real(wp) :: orientation(3) = 0.0_wp      !! v, in global axes
      real(wp) :: offset(3, 2) = 0.0_wp        !! of the ends from the nodes, in global axes [length]
      logical  :: released(12) = .false.       !! PA, PB: end values whose force is zero
      logical  :: is_cut = .false.             !! a bolt: a parallel bar carries its axial force
      real(wp) :: rho = 0.0_wp                 !! mass density
      real(wp) :: extra_mass = 0.0_wp          !! NSM, mass per unit length
      real(wp) :: expansion = 0.0_wp           !! alpha [1/temperature]
      logical  :: is_cbeam = .false.           !! lumped mass keeps the inertia about the axis
      type(beam_station), allocatable :: stations(:) !! where the section changes
   end type beam_law

contains

   !> Length of a beam between nodes at X [length].
   pure real(wp) function beam_length(law, x) result(length)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! [length]

      length = norm2(x(:, 2) + law%offset(:, 2) - x(:, 1) - law%offset(:, 1))
   end function beam_length

   !> The directions x, y, z of a beam, columns: z = x cross orientation. They are zero where the beam has no length or is parallel
   !! to its orientation vector.
   pure function beam_axes(law, x) result(axes)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! [length]
      real(wp) :: axes(3, 3), across(3), along(3)

      axes = 0.0_wp
      if (beam_length(law, x) <= 0.0_wp) return
      along = (x(:, 2) + law%offset(:, 2) - x(:, 1) - law%offset(:, 1))/beam_length(law, x)
      across = cross(along, law%orientation)
      if (norm2(across) <= along_the_beam*norm2(law%orientation)) return
      axes(:, 1) = along
      axes(:, 3) = across/norm2(across)
      axes(:, 2) = cross(axes(:, 3), along)
   end function beam_axes

   !> The section of a beam at S = x/L.
   pure type(beam_station) function beam_section_at(law, s) result(section)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: s

      if (allocated(law%stations)) then
         section = section_between(law%stations, s)
      else
         section%beam_section = law%beam_section
         section%extra_mass = law%extra_mass
      end if
   end function beam_section_at

   !> 12 E I/(K A G L^2) of the planes 1 and 2: the ratio of shear flexibility to bending flexibility [-].
   pure function shear_softness(law, length) result(phi)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: length
      real(wp) :: phi(2)

      phi = 0.0_wp
      where (law%shear > 0.0_wp) phi = 12.0_wp*law%e*law%inertia(:2)/(law%shear*law%area*law%g*length**2)
   end function shear_softness

   !> The shape functions of bending in one plane at S = x/L: deflection V and rotation R from the deflection and rotation of end A,
   !! then of end B.
   pure subroutine beam_shapes(phi, length, s, v, r)
      real(wp), intent(in)  :: phi, length, s
      real(wp), intent(out) :: v(4), r(4)

      v = [1.0_wp - 3.0_wp*s**2 + 2.0_wp*s**3 + phi*(1.0_wp - s), length*(s - 2.0_wp*s**2 + s**3 + 0.5_wp*phi*(s - s**2)), &
           3.0_wp*s**2 - 2.0_wp*s**3 + phi*s, length*(s**3 - s**2 + 0.5_wp*phi*(s**2 - s))]/(1.0_wp + phi)
      r = [6.0_wp*(s**2 - s)/length, 1.0_wp - 4.0_wp*s + 3.0_wp*s**2 + phi*(1.0_wp - s), &
           6.0_wp*(s - s**2)/length, 3.0_wp*s**2 - 2.0_wp*s + phi*s]/(1.0_wp + phi)
   end subroutine beam_shapes

   !> The matrix that gives u, v, w, theta_x, theta_y, theta_z at S = x/L from the end values.
   pure function movement_at(law, length, s) result(m)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: length, s
      real(wp) :: m(6, 12), phi(2), r(4), v(4)

      if (allocated(law%stations)) then
         m(:, 7:) = matmul(flexibility(law%stations, law%e, law%g, length, s), &
                           tapered_stiffness(law%stations, law%e, law%g, length))
         m(:, :6) = transpose(carried(s*length)) - matmul(m(:, 7:), transpose(carried(length)))
         if (all(law%stations%torsion > 0.0_wp)) return
         m(4, [4, 10]) = [1.0_wp - s, s]
         return
      end if
      m = 0.0_wp
      phi = shear_softness(law, length)
      m(1, [1, 7]) = [1.0_wp - s, s]
      m(4, [4, 10]) = [1.0_wp - s, s]
      call beam_shapes(phi(1), length, s, v, r)
      m(2, [2, 6, 8, 12]) = v
      m(6, [2, 6, 8, 12]) = r
      call beam_shapes(phi(2), length, s, v, r) ! theta_y is minus the slope of w
      m(3, [3, 5, 9, 11]) = v*[1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp]
      m(5, [3, 5, 9, 11]) = r*[-1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp]
   end function movement_at

   !> [k] between the end values before releases. I12 couples bending in the two planes, here without shear: a beam that has both has
   !! STATIONS.
   pure function end_stiffness(law, length) result(k)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: length
      real(wp) :: k(12, 12), bend(4, 4), phi(2), sign_of(4)
      integer  :: at(4, 2), plane

      if (allocated(law%stations)) then
         k(7:, 7:) = tapered_stiffness(law%stations, law%e, law%g, length)
         k(7:, :6) = -matmul(k(7:, 7:), transpose(carried(length)))
         k(:6, 7:) = transpose(k(7:, :6))
         k(:6, :6) = -matmul(carried(length), k(7:, :6))
         if (law%is_cut) k([1, 7], :) = 0.0_wp ! nothing else is coupled along the beam
         if (law%is_cut) k(:, [1, 7]) = 0.0_wp
         return
      end if
      k = 0.0_wp
      if (.not. law%is_cut) k([1, 7], [1, 7]) = law%e*law%area/length*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      k([4, 10], [4, 10]) = law%g*law%torsion/length*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      phi = shear_softness(law, length)
      at = reshape([2, 6, 8, 12, 3, 5, 9, 11], [4, 2])
      sign_of = [1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp]
      do plane = 1, 2
         bend = law%e*law%inertia(plane)*of_bending(phi(plane))
         if (plane == 2) bend = bend*spread(sign_of, 1, 4)*spread(sign_of, 2, 4)
         k(at(:, plane), at(:, plane)) = bend
      end do
      if (.not. abs(law%inertia(3)) > 0.0_wp) return
      bend = law%e*law%inertia(3)*of_bending(0.0_wp)*spread(sign_of, 1, 4)
      k(at(:, 1), at(:, 2)) = bend
      k(at(:, 2), at(:, 1)) = transpose(bend)

   contains

      !> The bending stiffness of a beam with E I = 1.
      pure function of_bending(softness) result(b)
         real(wp), intent(in) :: softness
         real(wp) :: b(4, 4)

         associate (l => length, f => softness)
            b = reshape([12.0_wp, 6.0_wp*l, -12.0_wp, 6.0_wp*l, 6.0_wp*l, (4.0_wp + f)*l**2, -6.0_wp*l, (2.0_wp - f)*l**2, &
                         -12.0_wp, -6.0_wp*l, 12.0_wp, -6.0_wp*l, 6.0_wp*l, (2.0_wp - f)*l**2, -6.0_wp*l, (4.0_wp + f)*l**2], &
                        [4, 4])/(l**3*(1.0_wp + f))
         end associate
      end function of_bending

   end function end_stiffness

   !> The matrix that gives the end values from the nodal values; a column is one nodal value of (3, 4) in array order.
   pure function from_nodes(law, x) result(t)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)
      real(wp) :: t(12, 12), axes(3, 3), unit(3)
      integer  :: c, end

      t = 0.0_wp
      axes = beam_axes(law, x)
      do end = 1, 2
         do c = 1, 3
            unit = 0.0_wp
            unit(c) = 1.0_wp
            t(6*end - 5:6*end - 3, 3*end - 3 + c) = axes(c, :)
            t(6*end - 5:6*end - 3, 3*end + 3 + c) = matmul(cross(unit, law%offset(:, end)), axes)
            t(6*end - 2:6*end, 3*end + 3 + c) = axes(c, :)
         end do
      end do
   end function from_nodes

   !> Release end values: condense those whose force is zero out of [k], of the forces F and of the mass M.
   pure subroutine release(law, k, f, m)
      type(beam_law), intent(in)        :: law
      real(wp), intent(inout)           :: k(12, 12)
      real(wp), intent(inout), optional :: f(12), m(12, 12)
      real(wp) :: ratio(12), whole(12)
      integer  :: r

      whole = [(k(r, r), r = 1, 12)]
      do r = 1, 12
         if (.not. law%released(r)) cycle
         ratio = 0.0_wp
         if (k(r, r) > released_pivot*whole(r)) ratio = k(r, :)/k(r, r) ! an earlier release may leave none
         ratio(r) = 1.0_wp
         if (present(f)) f = f - ratio*f(r)
         if (present(m)) then
            ratio(r) = 0.0_wp
            m = m - spread(m(:, r), 2, 12)*spread(ratio, 1, 12)
            m = m - spread(m(r, :), 1, 12)*spread(ratio, 2, 12)
            m(r, :) = 0.0_wp
            m(:, r) = 0.0_wp
         end if
         k = k - spread(k(:, r), 2, 12)*spread(ratio, 1, 12)
         k(r, :) = 0.0_wp
         k(:, r) = 0.0_wp
      end do
   end subroutine release

   !> [k] between the nodal values.
   pure function beam_stiffness(law, x) result(k)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! nodes [length]
      real(wp) :: k(12, 12), t(12, 12)

      k = end_stiffness(law, beam_length(law, x))
      call release(law, k)
      t = from_nodes(law, x)
      k = matmul(transpose(t), matmul(k, t))
   end function beam_stiffness

   !> [m] between the nodal values: from the shape functions and the rotary inertia of the section, or LUMPED: half of the mass at
   !! each end, without rotary inertia but that of a CBEAM about its axis, rho (I1 + I2) per unit length, as in NASTRAN.
   pure function beam_mass(law, x, lumped) result(m)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! [length]
      logical, intent(in)        :: lumped
      real(wp) :: m(12, 12), k(12, 12), t(12, 12), moved(6, 12), section_mass(6, 6), length
      integer  :: i

      length = beam_length(law, x)
      m = 0.0_wp
      do i = 1, size(gauss_at)
         section_mass = mass_of(beam_section_at(law, gauss_at(i)))
         if (lumped) then
            m(:3, :3) = m(:3, :3) + 0.5_wp*gauss_weight(i)*length*section_mass(:3, :3)
            if (law%is_cbeam) m(4, 4) = m(4, 4) + 0.5_wp*gauss_weight(i)*length*section_mass(4, 4)
            m(7:10, 7:10) = m(:4, :4)
         else
            moved = movement_at(law, length, gauss_at(i))
            m = m + gauss_weight(i)*length*matmul(transpose(moved), matmul(section_mass, moved))
         end if
      end do
      k = end_stiffness(law, length)
      call release(law, k, m=m)
      t = from_nodes(law, x)
      m = matmul(transpose(t), matmul(m, t))

   contains

      !> The mass of SECTION per unit length, with its rotary inertia.
      pure function mass_of(section) result(m)
         type(beam_station), intent(in) :: section
         real(wp) :: m(6, 6)
         integer  :: i

         m = 0.0_wp
         do i = 1, 3
            m(i, i) = law%rho*section%area + section%extra_mass
         end do
         m(4, 4) = law%rho*(section%inertia(1) + section%inertia(2))
         m(5, 5) = law%rho*section%inertia(2)
         m(6, 6) = law%rho*section%inertia(1)
         m(5, 6) = -law%rho*section%inertia(3)
         m(6, 5) = m(5, 6)
      end function mass_of

   end function beam_mass

   !> End forces that are equivalent to a distributed force and moment: Q(:, 1) per unit length at S = FROM, Q(:, 2) at S = TO,
   !! linear between them, zero elsewhere; in global axes [force], [force length].
   pure function beam_line_load(law, x, q, from, to) result(f)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! [length]
      real(wp), intent(in)       :: q(6, 2)    !! [force/length], [force]
      real(wp), intent(in)       :: from, to   !! x/L
      real(wp) :: f(12), s
      integer  :: i, k, n

      f = 0.0_wp
      n = 1
      if (allocated(law%stations)) n = 8 ! then the shape functions are no polynomials
      do k = 1, n
         do i = 1, size(gauss_at)
            s = (real(k - 1, wp) + gauss_at(i))/n
            f = f + gauss_weight(i)*(to - from)/n*beam_length(law, x)*beam_point_load(law, x, (1.0_wp - s)*q(:, 1) + s*q(:, 2), &
                                                                                      from + s*(to - from))
         end do
      end do
   end function beam_line_load

   !> End forces that are equivalent to a concentrated force and moment LOAD at S.
   pure function beam_point_load(law, x, load, s) result(f)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! [length]
      real(wp), intent(in)       :: load(6), s
      real(wp) :: f(12), axes(3, 3)

      axes = beam_axes(law, x)
      f = matmul([matmul(load(:3), axes), matmul(load(4:), axes)], movement_at(law, beam_length(law, x), s))
   end function beam_point_load

   !> End forces of a thermal load: those that would move end B as the free beam moves it, from end A on. RISE is the temperature of
   !! the ends above the reference temperature, SLOPE its gradient along y and z over the section, linear along the beam: strains
   !! alpha (RISE + SLOPE_y y + SLOPE_z z), and curvatures v'' = -alpha SLOPE_y, w'' = -alpha SLOPE_z.
   pure function beam_thermal_load(law, x, rise, slope) result(f)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)     !! [length]
      real(wp), intent(in)       :: rise(2)     !! [temperature]
      real(wp), intent(in)       :: slope(2, 2) !! (end, y or z) [temperature/length]
      real(wp) :: f(12), free(6), k(12, 12)

      associate (l => beam_length(law, x), a => law%expansion)
         free = [a*l*sum(rise)/2.0_wp, -a*l**2*matmul([2.0_wp, 1.0_wp], slope)/6.0_wp, 0.0_wp, a*l*sum(slope(:, 2))/2.0_wp, &
                 -a*l*sum(slope(:, 1))/2.0_wp]
         k = end_stiffness(law, l)
      end associate
      f = matmul(k(:, 7:), free)
   end function beam_thermal_load

   !> The nodal forces (3, 4) that are equivalent to the end forces F.
   pure function beam_nodal_forces(law, x, f) result(nodal)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! [length]
      real(wp), intent(in)       :: f(12)
      real(wp) :: nodal(3, 4), k(12, 12), end_forces(12)

      end_forces = f
      k = end_stiffness(law, beam_length(law, x))
      call release(law, k, f=end_forces)
      nodal = reshape(matmul(end_forces, from_nodes(law, x)), [3, 4])
   end function beam_nodal_forces

   !> The forces and moments at the ends of a beam under the nodal values U; F are the end forces equivalent to the loads along it.
   pure function beam_end_forces(law, x, u, f) result(s)
      type(beam_law), intent(in) :: law
      real(wp), intent(in)       :: x(3, 2)    !! [length]
      real(wp), intent(in)       :: u(3, 4)    !! [length], [rad]
      real(wp), intent(in)       :: f(12)
      real(wp) :: s(12), k(12, 12), end_forces(12)

      end_forces = f
      k = end_stiffness(law, beam_length(law, x))
      call release(law, k, f=end_forces)
      s = matmul(k, matmul(from_nodes(law, x), reshape(u, [12]))) - end_forces
   end function beam_end_forces

end module beam_element
