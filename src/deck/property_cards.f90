!> Reads the cards of properties and materials, PSHELL, PAXIS, PSOLID, PROD, CONROD and MAT1, and PARAM.
module property_cards
   use bulk_data, only: bulk_data_type, conrod_card, prod_card, property_card
   use card_fields, only: card_fields_type
   use elasticity, only: axisymmetric, plane_strain, plane_stress, solid
   use field_rules, only: any_real, not_negative, parse_real, positive, real_range
   use kinds, only: wp
   use nastran_compatibility, only: take_parameter
   use text_tools, only: integer_text, real_text
   use tolerances, only: equal_ends
   implicit none
   private

   public :: read_pshell, read_body_property, read_rod, read_mat1, read_parameter

contains

   !> PSHELL: in the plane a membrane of thickness T; MID2 = -1 is plane strain, otherwise plane stress. MODES = YES on a continuation
   !! adds the incompatible modes of Wilson and Taylor; bending data have no effect there. In space a shell: MID1 membrane (blank: none,
   !! the mass is that of MID2), MID2 and 12I/T**3 bending, MID3 and TS/T transverse shear, Z1 and Z2 the fibres of stress output.
   subroutine read_pshell(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: modes
      real(wp) :: number
      logical  :: is_number

      associate (property => bulk%pshell(card%i))
         call card%field('PID', property%id)
         property%bends_alone = (card%text_at(2) == '' .or. card%text_at(2) == '0') .and. card%text_at(4) /= ''
         if (property%bends_alone) then
            call card%skip(['MID1'])
         else
            call card%field('MID1', property%material)
         end if
         call card%field('T', property%thickness, positive)
         call card%field('MID2', property%bending, default=0, least=-1)
         if (property%bends_alone) property%material = property%bending
         call card%field('12I/T**3', property%inertia_ratio, positive, default=1.0_wp)
         call card%field('MID3', property%shear, default=0)
         call card%field('TS/T', property%shear_ratio, positive, default=5.0_wp/6.0_wp)
         call card%field('NSM', property%extra_mass, not_negative, default=0.0_wp)
         modes = card%text_at(9) ! Z1, or MODES of a membrane
         call parse_real(card%text_at(9), number, is_number)
         if (is_number) then
            call card%field('Z1', property%fibre(1), default=0.0_wp)
            modes = 'NO'
         else
            call card%word('MODES', '|NO|YES|', modes)
         end if
         call card%field('Z2', property%fibre(2), default=0.0_wp)
         call card%blank(['MID4'])
         call card%finish(property%line)
         property%fibre_given = [is_number, card%text_at(10) /= '']
         where (.not. property%fibre_given) property%fibre = [-0.5_wp, 0.5_wp]*property%thickness
         property%state = merge(plane_strain, plane_stress, property%bending == -1)
         property%incompatible = modes == 'YES'
      end associate
   end subroutine read_pshell

   !> PAXIS: a body of revolution about y; its mesh lies in x >= 0. PSOLID: solids. CHEXA of 8 and CPENTA of 6 nodes have
   !! incompatible modes, as NASTRAN's have bubble functions, unless ISOP selects full integration. NASTRAN's reduced shear
   !! integration without bubble functions is not available; the incompatible modes also remove parasitic shear in bending. Output
   !! requests have no effect, nor has the system of an isotropic material.
   subroutine read_body_property(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(property_card) :: property
      character(8) :: isop, other

      call card%field('PID', property%id)
      call card%field('MID', property%material)
      if (card%name == 'PAXIS') then
         call card%finish(property%line)
         property%state = axisymmetric
         bulk%paxis(card%i) = property
      else
         call card%field('CORDM', property%system, default=0, least=-1)
         call card%word('IN', '|BUBBLE|GAUSS|TWO|THREE|0|1|2|3|', other)
         call card%skip(['STRESS'])
         call card%word('ISOP', '|MODES|PLAIN|FULL|REDUCED|0|1|2|3|', isop)
         call card%word('FCTN', '|SMECH|', other)
         call card%finish(property%line)
         property%state = solid
         property%incompatible = index('|PLAIN|FULL|1|2|3|', '|'//trim(isop)//'|') == 0
         bulk%psolid(card%i) = property
      end if
   end subroutine read_body_property

   !> PROD: a bar of cross-section A with the torsion constant J; C has no effect. CONROD: a CROD and its PROD on one card. PTUBE: the
   !! section of a tube.
   subroutine read_rod(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(conrod_card) :: rod

      if (card%name == 'PTUBE') then
         call read_tube(card, bulk%prod(card%i))
         return
      else if (card%name == 'PROD') then
         call card%field('PID', rod%id)
      else
         call card%field('EID', rod%id)
         call card%field(['G1', 'G2'], rod%nodes)
      end if
      call card%field('MID', rod%material)
      call card%field('A', rod%area, positive)
      call card%field('J', rod%torsion, not_negative, default=0.0_wp)
      call card%skip(['C'])
      call card%field('NSM', rod%extra_mass, not_negative, default=0.0_wp)
      call card%finish(rod%line)
      if (card%name == 'PROD') then
         bulk%prod(card%i) = rod%prod_card
      else
         bulk%conrod(card%i) = rod
      end if
   end subroutine read_rod

   !> PTUBE: outer diameter OD and wall T, 0 a solid rod. With another diameter OD2 at the second end a tube with the same wall and the
   !! same axial stiffness, of the mean wall diameter (OD - OD2)/ln((OD - T)/(OD2 - T)).
   subroutine read_tube(card, tube)
      type(card_fields_type), intent(inout) :: card
      type(prod_card), intent(inout)        :: tube
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: ends(2), mean, wall

      call card%field('PID', tube%id)
      call card%field('MID', tube%material)
      call card%field('OD', ends(1), positive)
      call card%field('T', wall, not_negative, default=0.0_wp)
      call card%field('NSM', tube%extra_mass, not_negative, default=0.0_wp)
      call card%field('OD2', ends(2), not_negative, default=ends(1))
      call card%finish(tube%line)
      if (card%is_faulty()) return
      if (.not. ends(2) > 0.0_wp) ends(2) = ends(1)
      if (2.0_wp*wall > minval(ends)) call card%error('T', 'more than half the diameter; expected the wall, or 0 for a solid rod')
      if (.not. wall > 0.0_wp .and. abs(ends(1) - ends(2)) > 0.0_wp) call card%error('OD2', 'differs from OD; expected a wall T')
      if (.not. wall > 0.0_wp) wall = 0.5_wp*minval(ends)
      if (card%is_faulty()) return
      mean = ends(1) - wall
      if (abs(ends(1) - ends(2)) > equal_ends*ends(1)) mean = (ends(1) - ends(2))/log((ends(1) - wall)/(ends(2) - wall))
      tube%area = pi*wall*mean
      tube%torsion = 0.25_wp*tube%area*(mean**2 + wall**2)
   end subroutine read_tube

   !> MAT1: two of E, G and NU suffice, with G = E/(2 (1 + NU)); E suffices for bars. Of all three, G
   !! holds for torsion and transverse shear, with a warning where they differ by more than one per cent. Of the
   !! stress limits, the limit in tension is compared with bolt stresses. The material system has no effect on an isotropic material.
   subroutine read_mat1(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp) :: g

      associate (mat1 => bulk%mat1(card%i))
         call card%field('MID', mat1%id)
         call card%field('E', mat1%e, positive, default=0.0_wp)
         call card%field('G', g, positive, default=0.0_wp)
         call card%field('NU', mat1%nu, real_range(-1.0_wp, 0.5_wp, above=.true., below=.true.), default=0.0_wp)
         call card%field('RHO', mat1%rho, not_negative, default=0.0_wp)
         call card%field('A', mat1%alpha, default=0.0_wp)
         call card%field('TREF', mat1%reference, default=0.0_wp)
         mat1%reference_given = card%given('TREF')
         call card%field('GE', mat1%damping, not_negative, default=0.0_wp)
         call card%field('ST', mat1%strength, not_negative, default=0.0_wp)
         call card%skip(['SC   ', 'SS   ', 'MCSID'])
         call card%finish(mat1%line)
         if (mat1%damping > 0.0_wp) call bulk%ignored%wait('GE of MAT1', card%line, needs_response=.false.)
      end associate
      associate (e => bulk%mat1(card%i)%e, nu => bulk%mat1(card%i)%nu, bars_only => bulk%mat1(card%i)%bars_only, &
                 has_e => bulk%mat1(card%i)%e > 0.0_wp, has_g => g > 0.0_wp, has_nu => card%given('NU'))
         bars_only = has_e .and. .not. (has_g .or. has_nu)
         if (card%is_faulty() .or. bars_only) return ! the blank one of the three follows
         if (.not. (has_e .or. (has_g .and. has_nu))) then
            call card%error('E', 'expected two of E, G and NU; for bars E alone suffices')
         else if (.not. has_e) then
            e = 2.0_wp*(1.0_wp + nu)*g
         else if (.not. has_nu) then
            nu = e/(2.0_wp*g) - 1.0_wp
            bars_only = nu <= -1.0_wp .or. nu >= 0.5_wp
            if (bars_only) call card%errors%warn('MAT1 '//card%text_at(1)//': E and G give NU = E/(2G) - 1 = '//real_text(nu)// &
                                                 ', not above -1 and below 0.5: the material is for bars and beams alone')
         else if (has_g) then
            if (abs(e/(2.0_wp*(1.0_wp + nu)) - g) > 0.01_wp*g) call card%errors%warn('MAT1 '//card%text_at(1)//': G = '// &
               real_text(g)//' does not agree with E and NU, which give G = '//real_text(e/(2.0_wp*(1.0_wp + nu)))// &
               '; G holds for the torsion and the transverse shear of beams, rods and shells, E and NU for all else')
         end if
         bulk%mat1(card%i)%shear = merge(g, 0.5_wp*e/(1.0_wp + nu), has_e .and. has_g .and. has_nu)
      end associate
   end subroutine read_mat1

   !> PARAM: a name and one or two values of any kind. Most PARAMs of NASTRAN have no effect here, some would change the answer.
   subroutine read_parameter(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: expected
      integer :: line

      call card%skip(['N ', 'V1', 'V2'])
      line = card%line
      if (card%n > 3) call bulk%ignored%add('fields behind V2 of PARAM '//card%text_at(1))
      if (.not. card%given('N')) call card%error('N', 'blank, expected the name of a parameter')
      if (.not. card%given('V1')) call card%error('V1', 'blank, expected the value of the parameter')
      if (.not. all(card%given(['N ', 'V1']))) return
      call take_parameter(card%text_at(1), card%text_at(2), line, bulk%parameters, bulk%ignored, expected)
      if (expected /= '') call card%error('V1', ''''//card%text_at(2)//''' for '//card%text_at(1)//', expected '//expected)
   end subroutine read_parameter

end module property_cards
