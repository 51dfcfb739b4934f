!> The cards of properties and materials: PSHELL, PAXIS, PSOLID, PROD, MAT1. A table and a routine each.
module property_cards
   use bulk_data, only: bulk_data_type, mat1_card, prod_card, property_card
   use card_fields, only: card_values
   use card_reader, only: card_reader_type
   use elasticity, only: axisymmetric, plane_strain, plane_stress, solid
   use field_rules, only: blank_field, integer_field, real_field, word_field
   use kinds, only: wp
   use text_tools, only: real_text
   implicit none
   private

   public :: read_pshell, read_paxis, read_psolid, read_prod, read_mat1

contains

   !> PSHELL: a membrane of thickness T; MID2 = -1 plane strain, blank plane stress; MODES = YES on a continuation line
   !! adds the incompatible modes of Wilson and Taylor.
   subroutine read_pshell(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['PID ', 'MID1']), real_field('T', above=0.0_wp), &
         integer_field('MID2', default=0, least=-1, most=-1), blank_field(['12I/T**3', 'MID3    ', 'TS/T    ', 'NSM     ']), &
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

   !> PSOLID: solids. Field 7 (ISOP) = MODES adds the incompatible modes of Wilson and Taylor to CHEXA.
   subroutine read_psolid(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['PID', 'MID']), blank_field(['CORDM ', 'IN    ', 'STRESS']), &
         word_field('ISOP', '|PLAIN|MODES|'), blank_field('FCTN')])
      allocate (bulk%psolid(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%psolid(i) = property_card(line=cards%line, id=values%integers(1), material=values%integers(2), &
                                        state=solid, incompatible=values%words(6) == 'MODES')
      end do
   end subroutine read_psolid

   !> PROD: a bar of cross-section A.
   subroutine read_prod(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['PID', 'MID']), real_field('A', above=0.0_wp), blank_field(['J  ', 'C  ', 'NSM'])])
      allocate (bulk%prod(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%prod(i) = prod_card(line=cards%line, id=values%integers(1), material=values%integers(2), &
                                  area=values%reals(3))
      end do
   end subroutine read_prod

   !> MAT1: of E, G and NU two are enough, G = E/(2 (1 + NU)); all three must agree within one per cent.
   subroutine read_mat1(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('MID'), real_field(['E', 'G'], default=0.0_wp, above=0.0_wp), &
         real_field('NU', default=0.0_wp, above=-1.0_wp, below=0.5_wp), real_field('RHO', default=0.0_wp, least=0.0_wp), &
         real_field(['A   ', 'TREF', 'GE  '], default=0.0_wp)])
      allocate (bulk%mat1(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         if (values%ok) call fill_in(cards, values)
         bulk%mat1(i) = mat1_card(line=cards%line, id=values%integers(1), e=values%reals(2), nu=values%reals(4), &
                                  rho=values%reals(5))
      end do
   end subroutine read_mat1

   !> Of E, G and NU, data fields 2 to 4 of a MAT1, the one that is left blank.
   subroutine fill_in(cards, values)
      type(card_reader_type), intent(inout) :: cards
      type(card_values), intent(inout)      :: values

      associate (e => values%reals(2), g => values%reals(3), nu => values%reals(4), given => values%given)
         if (count(given(2:4)) < 2) then
            call cards%error('E', 'expected two of E, G and NU')
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
