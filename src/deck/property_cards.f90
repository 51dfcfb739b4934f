!> The cards of properties and materials: PSHELL, PAXIS, PSOLID, PROD, MAT1. A table and a routine each.
module property_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_values, decode_card, field_error
   use card_lines, only: card_type
   use deck_errors, only: deck_error_list
   use field_rules, only: blank_field, field_rule, integer_field, real_field, word_field
   use kinds, only: wp
   use text_tools, only: real_text
   implicit none
   private

   public :: read_pshell, read_paxis, read_psolid, read_prod, read_mat1

contains

   !> PSHELL: a membrane of thickness T; MID2 = -1 plane strain, blank plane stress; MODES = YES on a continuation line
   !! adds the incompatible modes of Wilson and Taylor.
   subroutine read_pshell(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('PID'), integer_field('MID1'), real_field('T', above=0.0_wp), &
         integer_field('MID2', default=0, least=-1, most=-1), blank_field('12I/T**3'), blank_field('MID3'), &
         blank_field('TS/T'), blank_field('NSM'), word_field('MODES', '|NO|YES|')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_pshell = bulk%n_pshell + 1
      associate (pshell => bulk%pshell(bulk%n_pshell))
         pshell%line = card%line
         pshell%id = values%integers(1)
         pshell%material = values%integers(2)
         pshell%thickness = values%reals(3)
         pshell%plane_strain = values%integers(4) == -1
         pshell%incompatible = values%words(9) == 'YES'
      end associate
   end subroutine read_pshell


   !> MAT1: of E, G and NU two are enough, G = E/(2 (1 + NU)); all three must agree within one per cent.
   subroutine read_mat1(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      real(wp) :: e, g, nu

      if (.not. allocated(table)) table = [integer_field('MID'), real_field('E', default=0.0_wp, above=0.0_wp), &
         real_field('G', default=0.0_wp, above=0.0_wp), real_field('NU', default=0.0_wp, above=-1.0_wp, below=0.5_wp), &
         real_field('RHO', default=0.0_wp, least=0.0_wp), real_field('A', default=0.0_wp), &
         real_field('TREF', default=0.0_wp), real_field('GE', default=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      e = values%reals(2)
      g = values%reals(3)
      nu = values%reals(4)
      if (values%ok) then
         if (count(values%given(2:4)) < 2) then
            call field_error(card, 2, 'E: expected two of E, G and NU', errors)
         else if (.not. values%given(2)) then
            e = 2.0_wp*(1.0_wp + nu)*g
         else if (.not. values%given(4)) then
            nu = e/(2.0_wp*g) - 1.0_wp
            if (nu <= -1.0_wp .or. nu >= 0.5_wp) call field_error(card, 3, 'G: '// &
               'E and G give NU = E/(2G) - 1 = '//real_text(nu)//', expected above -1 and below 0.5', errors)
         else if (values%given(3) .and. abs(e/(2.0_wp*(1.0_wp + nu)) - g) > 0.01_wp*g) then
            call field_error(card, 3, 'G: does not agree with E and NU, which give G = '// &
                                 real_text(e/(2.0_wp*(1.0_wp + nu)))//'; leave one of the three blank', errors)
         end if
      end if
      bulk%n_mat1 = bulk%n_mat1 + 1
      associate (mat1 => bulk%mat1(bulk%n_mat1))
         mat1%line = card%line
         mat1%id = values%integers(1)
         mat1%e = e
         mat1%nu = nu
         mat1%rho = values%reals(5)
      end associate
   end subroutine read_mat1


   !> PAXIS: a body of revolution about y; its mesh lies in x >= 0.
   subroutine read_paxis(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('PID'), integer_field('MID')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_paxis = bulk%n_paxis + 1
      associate (paxis => bulk%paxis(bulk%n_paxis))
         paxis%line = card%line
         paxis%id = values%integers(1)
         paxis%material = values%integers(2)
      end associate
   end subroutine read_paxis


   !> PSOLID: solids. Field 7 (ISOP) = MODES adds the incompatible modes of Wilson and Taylor to CHEXA.
   subroutine read_psolid(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('PID'), integer_field('MID'), &
         blank_field('CORDM'), blank_field('IN'), blank_field('STRESS'), word_field('ISOP', '|PLAIN|MODES|'), &
         blank_field('FCTN')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_psolid = bulk%n_psolid + 1
      associate (psolid => bulk%psolid(bulk%n_psolid))
         psolid%line = card%line
         psolid%id = values%integers(1)
         psolid%material = values%integers(2)
         psolid%incompatible = values%words(6) == 'MODES'
      end associate
   end subroutine read_psolid


   !> PROD: a bar of cross-section A.
   subroutine read_prod(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('PID'), integer_field('MID'), &
         real_field('A', above=0.0_wp), blank_field('J'), blank_field('C'), blank_field('NSM')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_prod = bulk%n_prod + 1
      associate (prod => bulk%prod(bulk%n_prod))
         prod%line = card%line
         prod%id = values%integers(1)
         prod%material = values%integers(2)
         prod%area = values%reals(3)
      end associate
   end subroutine read_prod

end module property_cards
