!> The cards of temperatures: TEMP, TEMPD.
!!
!! The cards of properties and materials: PSHELL, PAXIS, PSOLID, PROD, CONROD, MAT1. A table and a routine each.
module property_cards
   use bulk_data, only: bulk_data_type, conrod_card, mat1_card, prod_card, property_card, temperature_card
   use card_lines, only: card_values
   use card_reader, only: card_reader_type
   use elasticity, only: axisymmetric, plane_strain, plane_stress, solid
   use field_rules, only: any_field, blank_field, integer_field, real_field, word_field
   use kinds, only: wp
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: read_temperature, read_pshell, read_paxis, read_psolid, read_prod, read_conrod, read_mat1

contains

   !> TEMP: temperatures T of up to three nodes G. TEMPD: of all nodes that have none in set SID, up to four sets.
   subroutine read_temperature(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      character(1) :: k
      logical :: for_all
      integer :: field, first, i, n

      call cards%set_table([integer_field(['SID', 'G1 ']), real_field('T1'), integer_field('G2', default=0), &
         real_field('T2', default=0.0_wp), integer_field('G3', default=0), real_field('T3', default=0.0_wp)], 'TEMP')
      call cards%set_table([integer_field('SID1'), real_field('T1'), integer_field('SID2', default=0), &
         real_field('T2', default=0.0_wp), integer_field('SID3', default=0), real_field('T3', default=0.0_wp), &
         integer_field('SID4', default=0), real_field('T4', default=0.0_wp)], 'TEMPD')
      allocate (bulk%temperature(4*cards%n))
      n = 0
      do i = 1, cards%n
         call cards%next(values)
         for_all = cards%card%name == 'TEMPD'
         first = merge(1, 2, for_all)
         do field = first, merge(7, 6, for_all), 2
            if (.not. any(values%given(field:field + 1))) cycle
            if (field > first .and. .not. all(values%given(field:field + 1))) then
               k = integer_text((field - first)/2 + 1)
               call cards%error(trim(merge('SID', 'G  ', for_all))//k, 'this and T'//k//' go together, one of them is blank')
               cycle
            end if
            n = n + 1
            bulk%temperature(n) = temperature_card(line=cards%line, set=values%integers(merge(field, 1, for_all)), &
               is_default=for_all, node=merge(0, values%integers(field), for_all), field=field, value=values%reals(field + 1))
         end do
      end do
      bulk%temperature = bulk%temperature(:n)
   end subroutine read_temperature

   !> PSHELL: a membrane of thickness T; MID2 = -1 plane strain, else plane stress; MODES = YES on a continuation line
   !! adds the incompatible modes of Wilson and Taylor. What bending out of the plane has means nothing in it.
   subroutine read_pshell(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['PID ', 'MID1']), real_field('T', above=0.0_wp), &
         integer_field('MID2', default=0, least=-1), any_field(['12I/T**3', 'MID3    ', 'TS/T    ']), blank_field('NSM'), &
         word_field('MODES', '|NO|YES|')])
      allocate (bulk%pshell(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%pshell(i) = property_card(line=cards%line, id=values%integers(1), material=values%integers(2), &
            state=merge(plane_strain, plane_stress, values%integers(4) == -1), thickness=values%reals(3), &
            incompatible=values%words(9) == 'YES')
      end do
   end subroutine read_pshell

   !> PAXIS: a body of revolution about y; its mesh lies in x >= 0.
   subroutine read_paxis(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table(integer_field(['PID', 'MID']))
      allocate (bulk%paxis(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%paxis(i) = property_card(line=cards%line, id=values%integers(1), material=values%integers(2), &
                                       state=axisymmetric)
      end do
   end subroutine read_paxis

   !> PSOLID: solids. CHEXA of 8 and CPENTA of 6 nodes have incompatible modes, as NASTRAN's have bubble functions, but where ISOP
   !! asks for full integration. NASTRAN's reduced shear without bubble functions is not there: like them, the modes take the shear
   !! from bending that does not belong to it. Output and the system of an isotropic material have no effect.
   subroutine read_psolid(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['PID', 'MID']), any_field(['CORDM']), &
         word_field('IN', '|BUBBLE|GAUSS|TWO|THREE|0|1|2|3|'), any_field(['STRESS']), &
         word_field('ISOP', '|MODES|PLAIN|FULL|REDUCED|0|1|2|3|'), word_field('FCTN', '|SMECH|')])
      allocate (bulk%psolid(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%psolid(i) = property_card(line=cards%line, id=values%integers(1), material=values%integers(2), &
                                        state=solid, incompatible=index('|PLAIN|FULL|1|2|3|', '|'//trim(values%words(6))//'|') == 0)
      end do
   end subroutine read_psolid

   !> PROD: a bar of cross-section A; J and C are of torsion, which a bar of this kind does not feel.
   subroutine read_prod(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['PID', 'MID']), real_field('A', above=0.0_wp), any_field(['J', 'C']), &
         real_field('NSM', default=0.0_wp, least=0.0_wp)])
      allocate (bulk%prod(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%prod(i) = prod_card(line=cards%line, id=values%integers(1), material=values%integers(2), &
                                  area=values%reals(3), extra_mass=values%reals(6))
      end do
   end subroutine read_prod

   !> CONROD: a CROD with its PROD on one card.
   subroutine read_conrod(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['EID', 'G1 ', 'G2 ', 'MID']), real_field('A', above=0.0_wp), any_field(['J', 'C']), &
         real_field('NSM', default=0.0_wp, least=0.0_wp)])
      allocate (bulk%conrod(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%conrod(i) = conrod_card(line=cards%line, id=values%integers(1), nodes=values%integers(2:3), &
                                      material=values%integers(4), area=values%reals(5), extra_mass=values%reals(8))
      end do
   end subroutine read_conrod

   !> MAT1: of E, G and NU two are enough, G = E/(2 (1 + NU)), and for bars E; all three must agree within one per cent. Stress
   !! limits and the system of the material mean nothing to an isotropic elastic one.
   subroutine read_mat1(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('MID'), real_field(['E', 'G'], default=0.0_wp, above=0.0_wp), &
         real_field('NU', default=0.0_wp, above=-1.0_wp, below=0.5_wp), real_field('RHO', default=0.0_wp, least=0.0_wp), &
         real_field(['A   ', 'TREF'], default=0.0_wp), real_field('GE', default=0.0_wp, least=0.0_wp), &
         any_field(['ST   ', 'SC   ', 'SS   ', 'MCSID'])])
      allocate (bulk%mat1(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         if (values%ok) call fill_in(cards, values)
         bulk%mat1(i) = mat1_card(line=cards%line, id=values%integers(1), e=values%reals(2), nu=values%reals(4), &
                                  rho=values%reals(5), alpha=values%reals(6), reference=values%reals(7), damping=values%reals(8), &
                                  bars_only=values%given(2) .and. .not. any(values%given(3:4)))
         if (values%reals(8) > 0.0_wp) call bulk%idle%wait('GE of MAT1', cards%line, needs_response=.false.)
      end do
   end subroutine read_mat1

   !> Of E, G and NU, data fields 2 to 4 of a MAT1, the one that is left blank.
   subroutine fill_in(cards, values)
      type(card_reader_type), intent(inout) :: cards
      type(card_values), intent(inout)      :: values

      associate (e => values%reals(2), g => values%reals(3), nu => values%reals(4), given => values%given)
         if (.not. any(given(2:3)) .or. (count(given(2:4)) < 2 .and. .not. given(2))) then
            call cards%error('E', 'expected two of E, G and NU; for bars E alone will do')
         else if (count(given(2:4)) < 2) then
            nu = 0.0_wp
         else if (.not. given(2)) then
            e = 2.0_wp*(1.0_wp + nu)*g
         else if (.not. given(4)) then
            nu = e/(2.0_wp*g) - 1.0_wp
            if (nu <= -1.0_wp .or. nu >= 0.5_wp) call cards%error('G', 'E and G give NU = E/(2G) - 1 = '//real_text(nu)// &
                                                                  ', expected above -1 and below 0.5')
         else if (given(3) .and. abs(e/(2.0_wp*(1.0_wp + nu)) - g) > 0.01_wp*g) then
            call cards%error('G', 'does not agree with E and NU, which give G = '//real_text(e/(2.0_wp*(1.0_wp + nu)))// &
                             '; leave one of the three blank')
         end if
      end associate
   end subroutine fill_in

end module property_cards
