!> Section constants of beams whose dimensions are given by PBARL and PBEAML.
!! y is the direction of plane 1, z is perpendicular to it; both start at the centroid. Area and moments of inertia are exact: round
!! sections in closed form, other sections as sums of rectangles. Torsion: exact for solid and round sections (Saint-Venant's series
!! for the rectangle), Bredt's formula for the closed box, sum of b t^3/3 for thin-walled open sections. Shear: 5/6 for a rectangle,
!! 0.9 for a circle, 0.5 for a tube; for the other sections the area of the walls parallel to the force.
!! Source: Timoshenko, Goodier, Theory of Elasticity, 3rd ed., sections 109, 112 and 116; dimensions as in the MSC Nastran Quick
!! Reference Guide, PBARL and PBEAML.
module beam_sections
   use kinds, only: wp
   implicit none
   private

   public :: section_of

   character(8), parameter, public :: section_names(18) = [character(8) :: 'ROD', 'TUBE', 'TUBE2', 'BAR', 'BOX', 'I', 'CHAN', &
      'T', 'L', 'I1', 'T1', 'T2', 'CHAN1', 'CHAN2', 'BOX1', 'CROSS', 'H', 'HAT']
   integer, parameter, public :: section_dimensions(18) = [1, 2, 2, 2, 4, 6, 4, 4, 4, 4, 4, 4, 4, 4, 6, 4, 4, 4] !! of each section

   type, public :: beam_section
      real(wp) :: area = 0.0_wp        !! [length^2]
      real(wp) :: inertia(3) = 0.0_wp  !! I1, I2, I12: integrals of y^2, z^2, y z over the section [length^4]
      real(wp) :: torsion = 0.0_wp     !! J [length^4]
      real(wp) :: shear(2) = 0.0_wp    !! K1, K2: shear area along y, z as a fraction of the area; 0: rigid in shear [-]
      real(wp) :: point(2, 4) = 0.0_wp !! y, z of the stress points C, D, E, F [length]
   end type beam_section

   real(wp), parameter :: pi = acos(-1.0_wp)

contains

   !> The section NAME with dimensions D. EXPECTED is the requirement that the dimensions violate; it is empty where they are valid.
   pure subroutine section_of(name, d, section, expected)
      character(*), intent(in)               :: name
      real(wp), intent(in)                   :: d(:) !! [length], > 0
      type(beam_section), intent(out)        :: section
      character(:), allocatable, intent(out) :: expected
      real(wp) :: inner, r(4, 5) ! r: rectangles: height (negative where one is subtracted), width along z, y and z of the centre
      integer  :: n

      expected = ''
      n = 0
      r = 0.0_wp
      select case (name)
      case ('ROD', 'TUBE', 'TUBE2')
         inner = 0.0_wp
         if (name == 'TUBE') inner = d(2)
         if (name == 'TUBE2') inner = d(1) - d(2)
         if (name == 'TUBE' .and. .not. d(1) > inner) expected = 'DIM1, the outer radius, larger than DIM2, the inner one'
         if (name == 'TUBE2' .and. inner < 0.0_wp) expected = 'DIM2, the thickness, at most DIM1, the outer radius'
         if (expected /= '') return
         section%area = pi*(d(1)**2 - inner**2)
         section%inertia(:2) = 0.25_wp*pi*(d(1)**4 - inner**4)
         section%torsion = 2.0_wp*section%inertia(1)
         section%shear = merge(0.9_wp, 0.5_wp, name == 'ROD')
         section%point = d(1)*reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, -1.0_wp, 0.0_wp, 0.0_wp, -1.0_wp], [2, 4])
         return
      case ('BAR') ! width along z, height along y
         n = 1
         r(:, 1) = [d(2), d(1), 0.0_wp, 0.0_wp]
         section%torsion = of_rectangle(maxval(d), minval(d))
         section%shear = 5.0_wp/6.0_wp
      case ('BOX') ! width, height, thickness of the walls along z, of those along y
         if (.not. (2.0_wp*d(3) < d(2) .and. 2.0_wp*d(4) < d(1))) &
            expected = 'walls thinner than half the box: 2 DIM3 below DIM2, 2 DIM4 below DIM1'
         n = 2
         r(:, 1) = [d(2), d(1), 0.0_wp, 0.0_wp]
         r(:, 2) = [2.0_wp*d(3) - d(2), d(1) - 2.0_wp*d(4), 0.0_wp, 0.0_wp]
         associate (b => d(1) - d(4), h => d(2) - d(3))
            section%torsion = 2.0_wp*(b*h)**2/(b/d(3) + h/d(4))
         end associate
         section%shear = [2.0_wp*d(4)*d(2), 2.0_wp*d(3)*d(1)]
      case ('I') ! height, width below, width above, web, thickness below, above
         if (d(5) + d(6) >= d(1)) expected = 'flanges thinner than the section is high: DIM5 + DIM6 below DIM1'
         if (d(4) > min(d(2), d(3))) expected = 'a web, DIM4, no wider than the flanges'
         n = 3
         r(:, 1) = [d(5), d(2), 0.5_wp*d(5), 0.0_wp]
         r(:, 2) = [d(1) - d(5) - d(6), d(4), 0.5_wp*(d(1) + d(5) - d(6)), 0.0_wp]
         r(:, 3) = [d(6), d(3), d(1) - 0.5_wp*d(6), 0.0_wp]
         section%torsion = (d(2)*d(5)**3 + d(3)*d(6)**3 + (d(1) - d(5) - d(6))*d(4)**3)/3.0_wp
         section%shear = [d(4)*d(1), 5.0_wp/6.0_wp*(d(2)*d(5) + d(3)*d(6))]
      case ('CHAN') ! width, height, web, flanges
         if (2.0_wp*d(4) >= d(2)) expected = 'flanges thinner than half the height: 2 DIM4 below DIM2'
         if (d(3) >= d(1)) expected = 'a web, DIM3, thinner than the section is wide, DIM1'
         n = 3
         r(:, 1) = [d(4), d(1), 0.5_wp*d(4), 0.5_wp*d(1)]
         r(:, 2) = [d(2) - 2.0_wp*d(4), d(3), 0.5_wp*d(2), 0.5_wp*d(3)]
         r(:, 3) = [d(4), d(1), d(2) - 0.5_wp*d(4), 0.5_wp*d(1)]
         section%torsion = (2.0_wp*d(1)*d(4)**3 + (d(2) - 2.0_wp*d(4))*d(3)**3)/3.0_wp
         section%shear = [d(3)*d(2), 5.0_wp/6.0_wp*2.0_wp*d(1)*d(4)]
      case ('T') ! width of the flange, height, thickness of the flange, of the stem
         if (d(3) >= d(2)) expected = 'a flange thinner than the section is high: DIM3 below DIM2'
         if (d(4) > d(1)) expected = 'a stem, DIM4, no wider than the flange, DIM1'
         n = 2
         r(:, 1) = [d(3), d(1), d(2) - 0.5_wp*d(3), 0.0_wp]
         r(:, 2) = [d(2) - d(3), d(4), 0.5_wp*(d(2) - d(3)), 0.0_wp]
         section%torsion = (d(1)*d(3)**3 + (d(2) - d(3))*d(4)**3)/3.0_wp
         section%shear = [d(4)*d(2), 5.0_wp/6.0_wp*d(1)*d(3)]
      case ('L') ! width of the lower leg, height of the upright one, thickness of the lower, of the upright leg
         if (d(3) >= d(2) .or. d(4) >= d(1)) expected = 'legs thinner than they are long: DIM3 below DIM2, DIM4 below DIM1'
         n = 2
         r(:, 1) = [d(3), d(1), 0.5_wp*d(3), 0.5_wp*d(1)]
         r(:, 2) = [d(2) - d(3), d(4), 0.5_wp*(d(2) + d(3)), 0.5_wp*d(4)]
         section%torsion = (d(1)*d(3)**3 + (d(2) - d(3))*d(4)**3)/3.0_wp
         section%shear = [d(4)*d(2), d(3)*d(1)]*5.0_wp/6.0_wp
      case default
         call other_walls(name, d, r, n, section, expected)
      end select
      if (expected /= '') return
      call add_up(r(:, :n), section)
      if (name /= 'BAR') section%shear = section%shear/section%area
   end subroutine section_of

   !> The N rectangles R of the walls of section NAME with dimensions D, as in section_of; torsion and shear areas of SECTION.
   pure subroutine other_walls(name, d, r, n, section, expected)
      character(*), intent(in)                 :: name
      real(wp), intent(in)                     :: d(:)
      real(wp), intent(inout)                  :: r(:, :)
      integer, intent(out)                     :: n
      type(beam_section), intent(inout)        :: section
      character(:), allocatable, intent(inout) :: expected
      real(wp) :: t

      n = 3
      t = 0.0_wp
      select case (name)
      case ('I1', 'CHAN1') ! flanges beside the web, web, height inside, outside
         if (d(4) <= d(3)) expected = 'a height outside, DIM4, larger than that inside, DIM3'
         t = 0.5_wp*(d(4) - d(3))
         r(:, 1) = [t, d(1) + d(2), 0.5_wp*t, 0.0_wp]
         r(:, 2) = [d(3), d(2), 0.5_wp*d(4), 0.0_wp]
         r(:, 3) = [t, d(1) + d(2), d(4) - 0.5_wp*t, 0.0_wp]
         if (name == 'CHAN1') r(4, :3) = 0.5_wp*[d(1), 0.0_wp, d(1)]
         section%shear = [d(2)*d(4), 5.0_wp/6.0_wp*2.0_wp*t*(d(1) + d(2))]
      case ('T1') ! height of the flange, length of the stem beside it, thickness of the flange, of the stem
         n = 2
         if (d(4) > d(1)) expected = 'a stem, DIM4, no thicker than the flange is high, DIM1'
         r(:, 1) = [d(1), d(3), 0.0_wp, 0.5_wp*d(3)]
         r(:, 2) = [d(4), d(2), 0.0_wp, d(3) + 0.5_wp*d(2)]
         section%shear = [5.0_wp/6.0_wp*d(1)*d(3), d(4)*(d(2) + d(3))]
      case ('T2') ! width of the flange, height, thickness of the flange, of the stem
         n = 2
         if (d(3) >= d(2) .or. d(4) > d(1)) expected = 'DIM3 below DIM2, and DIM4 at most DIM1'
         r(:, 1) = [d(3), d(1), 0.5_wp*d(3), 0.0_wp]
         r(:, 2) = [d(2) - d(3), d(4), 0.5_wp*(d(2) + d(3)), 0.0_wp]
         section%shear = [d(4)*d(2), 5.0_wp/6.0_wp*d(1)*d(3)]
      case ('CHAN2') ! thickness of the legs, of the base, height, width
         if (d(2) >= d(3) .or. 2.0_wp*d(1) >= d(4)) expected = 'DIM2 below DIM3, and 2 DIM1 below DIM4'
         r(:, 1) = [d(2), d(4) - 2.0_wp*d(1), 0.5_wp*d(2), 0.0_wp] ! cut as that of CHAN, for the same torsion
         r(:, 2) = [d(3), d(1), 0.5_wp*d(3), 0.5_wp*(d(4) - d(1))]
         r(:, 3) = [r(1:3, 2), -r(4, 2)]
         section%shear = [5.0_wp/6.0_wp*2.0_wp*d(1)*d(3), d(2)*d(4)]
      case ('BOX1') ! width, height, thickness above, below, and of both sides
         n = 4
         t = d(2) - d(3) - d(4)
         if (t <= 0.0_wp .or. d(5) + d(6) >= d(1)) &
            expected = 'walls thinner than the box: DIM3 + DIM4 below DIM2, DIM5 + DIM6 below DIM1'
         if (abs(d(3) - d(4)) > 0.0_wp .and. abs(d(5) - d(6)) > 0.0_wp) expected = 'DIM3 = DIM4 or DIM5 = DIM6'
         r(:, 1) = [d(3), d(1), d(2) - 0.5_wp*d(3), 0.0_wp]
         r(:, 2) = [d(4), d(1), 0.5_wp*d(4), 0.0_wp]
         r(:, 3) = [t, d(5), d(4) + 0.5_wp*t, 0.5_wp*(d(5) - d(1))]
         r(:, 4) = [t, d(6), d(4) + 0.5_wp*t, 0.5_wp*(d(1) - d(6))]
         section%shear = [(d(5) + d(6))*d(2), (d(3) + d(4))*d(1)]
      case ('CROSS', 'H') ! arms beside the uprights, or web between them; uprights together; height; thickness of the arms or web
         if (d(4) > d(3)) expected = 'arms, DIM4, no thicker than the section is high, DIM3'
         if (name == 'CROSS') then
            r(:, 1) = [d(3), d(2), 0.0_wp, 0.0_wp]
            r(:, 2) = [d(4), 0.5_wp*d(1), 0.0_wp, 0.25_wp*d(1) + 0.5_wp*d(2)]
         else
            r(:, 1) = [d(4), d(1), 0.0_wp, 0.0_wp]
            r(:, 2) = [d(3), 0.5_wp*d(2), 0.0_wp, 0.5_wp*d(1) + 0.25_wp*d(2)]
         end if
         r(:, 3) = [r(1:3, 2), -r(4, 2)]
         section%shear = [5.0_wp/6.0_wp*d(2)*d(3), d(4)*(d(1) + d(2))]
         if (name == 'CROSS') section%shear(2) = 5.0_wp/6.0_wp*section%shear(2)
      case ('HAT') ! height, thickness, width of the top, of a brim beside it
         n = 5
         if (2.0_wp*d(2) >= min(d(1), d(3))) expected = 'walls, 2 DIM2, thinner than the height DIM1 and the top DIM3'
         r(:, 1) = [d(2), d(3), d(1) - 0.5_wp*d(2), 0.0_wp]
         r(:, 2) = [d(1) - 2.0_wp*d(2), d(2), 0.5_wp*d(1), 0.5_wp*(d(3) - d(2))]
         r(:, 3) = [r(1:3, 2), -r(4, 2)]
         r(:, 4) = [d(2), d(4) + d(2), 0.5_wp*d(2), 0.5_wp*(d(3) + d(4) - d(2))]
         r(:, 5) = [r(1:3, 4), -r(4, 4)]
         section%shear = [2.0_wp*d(2)*d(1), 5.0_wp/6.0_wp*d(2)*(d(3) + 2.0_wp*(d(4) + d(2)))]
      end select
      associate (a => maxval(r(:2, :n), dim=1), b => minval(r(:2, :n), dim=1))
         section%torsion = sum(a*b**3)/3.0_wp
      end associate
      if (name /= 'BOX1') return
      associate (b => d(1) - 0.5_wp*(d(5) + d(6)), h => d(2) - 0.5_wp*(d(3) + d(4)))
         section%torsion = 4.0_wp*(b*h)**2/(b/d(3) + b/d(4) + h/d(5) + h/d(6))
      end associate
   end subroutine other_walls

   !> Area, moments of inertia and stress points of rectangles R: height (negative: subtracted), width, y and z of the centre. C and
   !! E are the top and bottom corners of the outline at its largest z, D and F those at its smallest z.
   pure subroutine add_up(r, section)
      real(wp), intent(in)              :: r(:, :)
      type(beam_section), intent(inout) :: section
      real(wp) :: centre(2), low(2), high(2), area(size(r, 2))
      integer  :: k

      area = r(1, :)*r(2, :)
      section%area = sum(area)
      centre = [dot_product(area, r(3, :)), dot_product(area, r(4, :))]/section%area
      section%inertia = 0.0_wp
      do k = 1, size(area)
         associate (y => r(3, k) - centre(1), z => r(4, k) - centre(2))
            section%inertia = section%inertia + area(k)*[r(1, k)**2/12.0_wp + y**2, r(2, k)**2/12.0_wp + z**2, y*z]
         end associate
      end do
      low = [minval(r(3, :) - 0.5_wp*abs(r(1, :))), minval(r(4, :) - 0.5_wp*r(2, :))] - centre
      high = [maxval(r(3, :) + 0.5_wp*abs(r(1, :))), maxval(r(4, :) + 0.5_wp*r(2, :))] - centre
      section%point = reshape([high(1), high(2), low(1), high(2), low(1), low(2), high(1), low(2)], [2, 4])
   end subroutine add_up

   !> Torsion of a rectangle of sides A >= B: a b^3 (1/3 - 64/pi^5 b/a sum over odd n of tanh(n pi a/(2 b))/n^5).
   pure real(wp) function of_rectangle(a, b) result(torsion)
      real(wp), intent(in) :: a, b
      real(wp) :: total
      integer  :: n

      total = 0.0_wp
      do n = 41, 1, -2
         total = total + tanh(0.5_wp*n*pi*a/b)/real(n, wp)**5
      end do
      torsion = a*b**3*(1.0_wp/3.0_wp - 64.0_wp/pi**5*b/a*total)
   end function of_rectangle

end module beam_sections
