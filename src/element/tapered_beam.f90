!> Beams whose section changes along them, linearly between stations: their flexibility by integration, exact in statics.
!! Forces on a section are N, Q_y, Q_z, T, M_y, M_z, and movements u, v, w, theta_x, theta_y, theta_z likewise, in the axes of the
!! beam. Source: J. S. Przemieniecki, Theory of Matrix Structural Analysis, 1968, sections 5.6 and 7.3.
module tapered_beam
   use beam_sections, only: beam_section
   use kinds, only: wp
   implicit none
   private

   public :: carried, flexibility, section_between, tapered_stiffness

   !> The section at a station.
   type, extends(beam_section), public :: beam_station
      real(wp) :: at = 0.0_wp                  !! x/L
      real(wp) :: extra_mass = 0.0_wp          !! NSM, mass per unit length
   end type beam_station

   integer, parameter :: pieces = 4            ! of each part between stations, each with four Gauss points
   real(wp), parameter, public :: gauss_at(4) = 0.5_wp + 0.5_wp*[-0.8611363115940526_wp, -0.3399810435848563_wp, &
                                                                 0.3399810435848563_wp, 0.8611363115940526_wp] ! exact to degree 7
   real(wp), parameter, public :: gauss_weight(4) = 0.5_wp*[0.3478548451374538_wp, 0.6521451548625461_wp, &
                                                            0.6521451548625461_wp, 0.3478548451374538_wp]

contains

   !> The section at S = x/L, interpolated between STATIONS, which go from 0 to 1.
   pure type(beam_station) function section_between(stations, s) result(section)
      type(beam_station), intent(in) :: stations(:)
      real(wp), intent(in)           :: s
      real(wp) :: share
      integer  :: k

      k = max(1, min(count(stations%at <= s), size(stations) - 1))
      section = stations(k)
      associate (a => stations(k), b => stations(k + 1))
         share = (s - a%at)/(b%at - a%at)
         section%at = s
         section%area = (1.0_wp - share)*a%area + share*b%area
         section%inertia = (1.0_wp - share)*a%inertia + share*b%inertia
         section%torsion = (1.0_wp - share)*a%torsion + share*b%torsion
         section%extra_mass = (1.0_wp - share)*a%extra_mass + share*b%extra_mass
         section%point = (1.0_wp - share)*a%point + share*b%point
      end associate
   end function section_between

   !> The forces on a section from those at a section a DISTANCE farther on; its transposed gives the movement of a rigid body there
   !! from that of this section.
   pure function carried(distance) result(h)
      real(wp), intent(in) :: distance         !! [length]
      real(wp) :: h(6, 6)
      integer  :: i

      h = 0.0_wp
      do i = 1, 6
         h(i, i) = 1.0_wp
      end do
      h(5, 3) = -distance
      h(6, 2) = distance
   end function carried

   !> The movement at S = x/L of a beam clamped at end A under unit forces at end B, one column each. Torsion without stiffness at some
   !! station is left out.
   pure function flexibility(stations, e, g, length, s) result(f)
      type(beam_station), intent(in) :: stations(:)
      real(wp), intent(in)           :: e, g, length, s !! [pressure], [length], [-]
      type(beam_station) :: section
      real(wp) :: c(6, 6), f(6, 6), from, x, step
      integer  :: k, p

      f = 0.0_wp
      do k = 1, size(stations) - 1
         step = (min(s, stations(k + 1)%at) - stations(k)%at)/pieces
         if (step <= 0.0_wp) exit
         do p = 0, 4*pieces - 1
            from = stations(k)%at + step*real(p/4, wp)
            x = from + step*gauss_at(modulo(p, 4) + 1)
            section = section_between(stations, x)
            c = 0.0_wp
            c(1, 1) = 1.0_wp/(e*section%area)
            if (section%shear(1) > 0.0_wp) c(2, 2) = 1.0_wp/(section%shear(1)*section%area*g)
            if (section%shear(2) > 0.0_wp) c(3, 3) = 1.0_wp/(section%shear(2)*section%area*g)
            if (all(stations%torsion > 0.0_wp)) c(4, 4) = 1.0_wp/(g*section%torsion)
            associate (i => section%inertia, det => section%inertia(1)*section%inertia(2) - section%inertia(3)**2)
               c(5:6, 5:6) = reshape([i(1), i(3), i(3), i(2)], [2, 2])/(e*det)
            end associate
            f = f + gauss_weight(modulo(p, 4) + 1)*step*length* &
                matmul(transpose(carried((s - x)*length)), matmul(c, carried((1.0_wp - x)*length)))
         end do
      end do
   end function flexibility

   !> The forces at end B from the movement of end B where end A is clamped.
   pure function tapered_stiffness(stations, e, g, length) result(k)
      type(beam_station), intent(in) :: stations(:)
      real(wp), intent(in)           :: e, g, length    !! [pressure], [length]
      real(wp) :: k(6, 6), f(6, 6)
      integer  :: i, j

      f = flexibility(stations, e, g, length, 1.0_wp)
      if (.not. f(4, 4) > 0.0_wp) f(4, 4) = huge(1.0_wp)**0.25_wp
      k = 0.0_wp
      do i = 1, 6                              ! the inverse, by elimination
         k(i, i) = 1.0_wp
      end do
      do i = 1, 6
         k(i, :) = k(i, :)/f(i, i)
         f(i, :) = f(i, :)/f(i, i)
         do j = 1, 6
            if (j == i) cycle
            k(j, :) = k(j, :) - f(j, i)*k(i, :)
            f(j, :) = f(j, :) - f(j, i)*f(i, :)
         end do
      end do
      if (.not. all(stations%torsion > 0.0_wp)) k(4, :) = 0.0_wp
   end function tapered_stiffness

end module tapered_beam
