!> ISO metric threads of bolts with their strength class, and formulas of VDI 2230 Part 1 for them.
!! R1 to R12 are the calculation steps of its edition of 2015. Threads: ISO 261, ISO 724; stress area, strength classes: ISO 898-1.
module bolt_threads
   use kinds, only: wp
   implicit none
   private

   public :: complete_thread, in_units, assembly_limit, reduced_stress, endurance_rolled_last

   character(*), parameter, public :: strength_classes = '|8.8|10.9|12.9|', thread_sizes = &
      '|M3|M4|M5|M6|M8|M10|M12|M14|M16|M18|M20|M22|M24|M27|M30|M33|M36|M39|M42|M48|'
   real(wp), parameter :: pi = acos(-1.0_wp)
   integer, parameter  :: diameters(20) = [3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 27, 30, 33, 36, 39, 42, 48] ! [mm]
   real(wp), parameter :: coarse(20) = [0.5_wp, 0.7_wp, 0.8_wp, 1.0_wp, 1.25_wp, 1.5_wp, 1.75_wp, 2.0_wp, 2.0_wp, 2.5_wp, &
                                        2.5_wp, 2.5_wp, 3.0_wp, 3.0_wp, 3.5_wp, 3.5_wp, 4.0_wp, 4.0_wp, 4.5_wp, 5.0_wp] ! pitches [mm]
   real(wp), parameter :: nu = 0.9_wp               ! of the yield stress in assembly
   real(wp), parameter :: plastic = 0.75_wp         ! torsional stress where the whole section yields, over the elastic one
   real(wp), parameter :: k_tau = 0.5_wp            ! of the torsion left in service
   real(wp), parameter :: mean(2) = [0.3_wp, 1.0_wp] ! of the yield force: range of the mean force in (R9/6-1)

   type, public :: thread_type
      character(8) :: size = '', class = '' !! 'M16', '8.8'; '': no thread is given
      real(wp) :: pitch = 0.0_wp            !! P [length]
      real(wp) :: flank = 0.0_wp            !! flank diameter d_2 [length]
      real(wp) :: area = 0.0_wp             !! A_S [length^2]
      real(wp) :: yield = 0.0_wp            !! R_p0.2 min [pressure]
      real(wp) :: endurance = 0.0_wp        !! sigma_ASV, rolled before heat treatment [pressure]
      real(wp) :: tightening = 1.0_wp       !! alpha_A
      real(wp) :: friction = 0.0_wp         !! mu_G
      real(wp) :: count = 0.0_wp            !! number of real bolts that the bolt of the model is; 0: by planes of symmetry
   end type thread_type

contains

   !> Complete THREAD, whose size, class, and pitch (0: coarse) are known, in mm and N. The pitch is not OK above the coarse one.
   pure subroutine complete_thread(thread, ok)
      type(thread_type), intent(inout) :: thread
      logical, intent(out)             :: ok
      real(wp) :: d
      integer  :: k

      read (thread%size(2:), *) k
      d = real(k, wp)
      associate (largest => coarse(findloc(diameters, k, dim=1)))
         if (.not. thread%pitch > 0.0_wp) thread%pitch = largest
         ok = thread%pitch <= largest
      end associate
      thread%flank = d - 0.75_wp*sqrt(0.75_wp)*thread%pitch
      thread%area = 0.25_wp*pi*(d - 13.0_wp/12.0_wp*sqrt(0.75_wp)*thread%pitch)**2 ! of (d_2 + d_3)/2, d_3 = d - 17/12 sqrt(3/4) P
      select case (thread%class)
      case ('8.8')
         thread%yield = merge(640.0_wp, 660.0_wp, k <= 16)
      case ('10.9')
         thread%yield = 940.0_wp
      case default
         thread%yield = 1100.0_wp
      end select
      thread%endurance = 0.85_wp*(150.0_wp/d + 45.0_wp) ! (R9/5-1)
   end subroutine complete_thread

   !> THREAD in units of which MM and N_PER_MM2 are 1 mm and 1 N/mm2.
   pure function in_units(thread, mm, n_per_mm2) result(other)
      type(thread_type), intent(in) :: thread
      real(wp), intent(in)          :: mm, n_per_mm2
      type(thread_type) :: other

      other = thread
      other%pitch = thread%pitch*mm
      other%flank = thread%flank*mm
      other%area = thread%area*mm**2
      other%yield = thread%yield*n_per_mm2
      other%endurance = thread%endurance*n_per_mm2
   end function in_units

   !> F_M zul: the largest assembly force, of which tension and torsion use 90 % of the yield stress (section 5.5.1, Table A1).
   pure real(wp) function assembly_limit(thread)
      type(thread_type), intent(in) :: thread

      assembly_limit = nu*thread%yield*thread%area/sqrt(1.0_wp + 3.0_wp*(plastic*torsion(thread))**2)
   end function assembly_limit

   !> Elastic torsional stress while THREAD is tightened, over the tensile stress: M_G = F d_2/2 (P/(pi d_2) + 1.155 mu_G),
   !! W_P = pi d_S**3/16, d_S the diameter of the stress area.
   pure real(wp) function torsion(thread)
      type(thread_type), intent(in) :: thread

      torsion = 2.0_wp*thread%flank/sqrt(4.0_wp*thread%area/pi)*(thread%pitch/(pi*thread%flank) + 1.155_wp*thread%friction)
   end function torsion

   !> sigma_red,B in service (R8/4) of a bolt tightened to ASSEMBLY, at the LARGEST force.
   pure real(wp) function reduced_stress(thread, assembly, largest)
      type(thread_type), intent(in) :: thread
      real(wp), intent(in)          :: assembly, largest !! [force]

      reduced_stress = sqrt(largest**2 + 3.0_wp*(k_tau*torsion(thread)*assembly)**2)/thread%area
   end function reduced_stress

   !> sigma_ASG, rolled after heat treatment (R9/6-1), at the mean FORCE; 0 outside of its range.
   pure real(wp) function endurance_rolled_last(thread, force) result(endurance)
      type(thread_type), intent(in) :: thread
      real(wp), intent(in)          :: force !! F_Sm [force]

      endurance = 0.0_wp
      associate (ratio => force/(thread%yield*thread%area))
         if (ratio >= mean(1) .and. ratio < mean(2)) endurance = (2.0_wp - ratio)*thread%endurance
      end associate
   end function endurance_rolled_last

end module bolt_threads
