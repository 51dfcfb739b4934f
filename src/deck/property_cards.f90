!> The cards of properties and materials, PSHELL, PAXIS, PSOLID, PROD, CONROD, MAT1; of temperatures, TEMP, TEMPD; and PARAM.
module property_cards
   use bulk_data, only: bulk_data_type, temperature_card
   use card_fields, only: card_fields_type
   use elasticity, only: axisymmetric, plane_strain, plane_stress, solid
   use field_rules, only: not_negative, parse_real, positive, real_range
   use kinds, only: wp
   use nastran_compatibility, only: take_parameter
   use text_tools, only: real_text
   implicit none
   private

   public :: read_temperature, read_pshell, read_paxis, read_psolid, read_prod, read_conrod, read_mat1, read_parameter

contains

   !> TEMP: temperatures T of up to three nodes G. TEMPD: of all nodes that have none in set SID, up to four sets.
   subroutine read_temperature(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(4) :: name(4)
      character(2) :: t(4)
      integer  :: k, line, n, number(4), set
      real(wp) :: value(4)
      logical  :: for_all

      for_all = card%name == 'TEMPD'
      n = merge(4, 3, for_all)
      name = merge(['SID1', 'SID2', 'SID3', 'SID4'], ['G1  ', 'G2  ', 'G3  ', 'G4  '], for_all)
      t = ['T1', 'T2', 'T3', 'T4']
      set = 0
      if (.not. for_all) call card%field('SID', set)
      call card%field(name(1), number(1))
      call card%field(t(1), value(1))
      do k = 2, n
         call card%field(name(k), number(k), default=0)
         call card%field(t(k), value(k), default=0.0_wp)
      end do
      call card%finish(line)
      card%i = card%i - 1
      do k = 1, n
         if (.not. (card%given(name(k)) .or. card%given(t(k)))) cycle
         if (k > 1 .and. .not. (card%given(name(k)) .and. card%given(t(k)))) then
            call card%error(trim(name(k)), 'this and '//t(k)//' go together, one of them is blank')
            cycle
         end if
         card%i = card%i + 1
         bulk%temperature(card%i) = temperature_card(line=line, set=merge(number(k), set, for_all), is_default=for_all, &
            node=merge(0, number(k), for_all), field=merge(2*k - 1, 2*k, for_all), value=value(k))
      end do
   end subroutine read_temperature

   !> PSHELL: in the plane a membrane of thickness T; MID2 = -1 plane strain, else plane stress; MODES = YES on a continuation line
   !! adds the incompatible modes of Wilson and Taylor; what bending out of the plane has means nothing there. In space a shell:
   !! MID1 membrane, MID2 and 12I/T**3 bending, MID3 and TS/T transverse shear, Z1 and Z2 where its stress is told.
   subroutine read_pshell(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: modes
      real(wp) :: number
      integer  :: k
      logical  :: is_number

      associate (property => bulk%pshell(card%i))
         call card%field('PID', property%id)
         call card%field('MID1', property%material)
         call card%field('T', property%thickness, positive)
         call card%field('MID2', property%bending, default=0, least=-1)
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
         do k = 1, 2
            if (.not. property%fibre_given(k)) property%fibre(k) = (k - 1.5_wp)*property%thickness
         end do
         property%state = merge(plane_strain, plane_stress, property%bending == -1)
         property%incompatible = modes == 'YES'
      end associate
   end subroutine read_pshell

   !> PAXIS: a body of revolution about y; its mesh lies in x >= 0.
   subroutine read_paxis(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (property => bulk%paxis(card%i))
         call card%field('PID', property%id)
         call card%field('MID', property%material)
         call card%finish(property%line)
         property%state = axisymmetric
      end associate
   end subroutine read_paxis

   !> PSOLID: solids. CHEXA of 8 and CPENTA of 6 nodes have incompatible modes, as NASTRAN's have bubble functions, but where ISOP
   !! asks for full integration. NASTRAN's reduced shear without bubble functions is not there: like them, the modes take the shear
   !! from bending that does not belong to it. Output and the system of an isotropic material have no effect.
   subroutine read_psolid(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(8) :: isop, other

      associate (property => bulk%psolid(card%i))
         call card%field('PID', property%id)
         call card%field('MID', property%material)
         call card%skip(['CORDM'])
         call card%word('IN', '|BUBBLE|GAUSS|TWO|THREE|0|1|2|3|', other)
         call card%skip(['STRESS'])
         call card%word('ISOP', '|MODES|PLAIN|FULL|REDUCED|0|1|2|3|', isop)
         call card%word('FCTN', '|SMECH|', other)
         call card%finish(property%line)
         property%state = solid
         property%incompatible = index('|PLAIN|FULL|1|2|3|', '|'//trim(isop)//'|') == 0
      end associate
   end subroutine read_psolid

   !> PROD: a bar of cross-section A; J and C are of torsion, which a bar of this kind does not feel.
   subroutine read_prod(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (prod => bulk%prod(card%i))
         call card%field('PID', prod%id)
         call card%field('MID', prod%material)
         call card%field('A', prod%area, positive)
         call card%skip(['J', 'C'])
         call card%field('NSM', prod%extra_mass, not_negative, default=0.0_wp)
         call card%finish(prod%line)
      end associate
   end subroutine read_prod

   !> CONROD: a CROD with its PROD on one card.
   subroutine read_conrod(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk

      associate (conrod => bulk%conrod(card%i))
         call card%field('EID', conrod%id)
         call card%field(['G1', 'G2'], conrod%nodes)
         call card%field('MID', conrod%material)
         call card%field('A', conrod%area, positive)
         call card%skip(['J', 'C'])
         call card%field('NSM', conrod%extra_mass, not_negative, default=0.0_wp)
         call card%finish(conrod%line)
      end associate
   end subroutine read_conrod

   !> MAT1: of E, G and NU two are enough, G = E/(2 (1 + NU)), and for bars E; all three must agree within one per cent. Of the
   !! stress limits that of tension is what bolts are compared with; the system of the material means nothing to an isotropic one.
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
         call card%field('GE', mat1%damping, not_negative, default=0.0_wp)
         call card%field('ST', mat1%strength, not_negative, default=0.0_wp)
         call card%skip(['SC   ', 'SS   ', 'MCSID'])
         call card%finish(mat1%line)
         if (mat1%damping > 0.0_wp) call bulk%ignored%wait('GE of MAT1', card%line, needs_response=.false.)
      end associate
      associate (e => bulk%mat1(card%i)%e, nu => bulk%mat1(card%i)%nu, bars_only => bulk%mat1(card%i)%bars_only, &
                 has_e => card%given('E'), has_g => card%given('G'), has_nu => card%given('NU'))
         bars_only = has_e .and. .not. (has_g .or. has_nu)
         if (card%is_faulty() .or. bars_only) return ! of the three the one that is left blank follows
         if (.not. (has_e .or. (has_g .and. has_nu))) then
            call card%error('E', 'expected two of E, G and NU; for bars E alone suffices')
         else if (.not. has_e) then
            e = 2.0_wp*(1.0_wp + nu)*g
         else if (.not. has_nu) then
            nu = e/(2.0_wp*g) - 1.0_wp
            if (nu <= -1.0_wp .or. nu >= 0.5_wp) call card%error('G', 'E and G give NU = E/(2G) - 1 = '//real_text(nu)// &
                                                                 ', expected above -1 and below 0.5')
         else if (has_g .and. abs(e/(2.0_wp*(1.0_wp + nu)) - g) > 0.01_wp*g) then
            call card%error('G', 'does not agree with E and NU, which give G = '//real_text(e/(2.0_wp*(1.0_wp + nu)))// &
                            '; leave one of the three blank')
         end if
      end associate
   end subroutine read_mat1

   !> PARAM: numbers that steer NASTRAN, a name and one value or two, of any kind. Most have no effect here, some would change the
   !! answer.
   subroutine read_parameter(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(:), allocatable :: expected
      integer :: line

      call card%skip(['N ', 'V1', 'V2'])
      call card%finish(line)
      if (.not. card%given('N')) call card%error('N', 'blank, expected the name of a parameter')
      if (.not. card%given('V1')) call card%error('V1', 'blank, expected the value of the parameter')
      if (.not. all(card%given(['N ', 'V1']))) return
      call take_parameter(card%text_at(1), card%text_at(2), line, bulk%parameters, bulk%ignored, expected)
      if (expected /= '') call card%error('V1', ''''//card%text_at(2)//''' for '//card%text_at(1)//', expected '//expected)
   end subroutine read_parameter

end module property_cards
