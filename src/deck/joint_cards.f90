!> The cards of the joint: JOINT, CJOINT, PJOINT, JNORM, JSHEAR, JINCR. A table and a routine each.
module joint_cards
   use bulk_data, only: bulk_data_type, jincr_card
   use card_fields, only: card_values, check_direction, decode_card, decode_real, field_error
   use card_lines, only: card_type
   use deck_errors, only: deck_error_list
   use field_rules, only: blank_field, field_rule, integer_field, real_field, word_field
   use kinds, only: wp
   use load_shares, only: arithmetic_shares, geometric_shares
   use shear_stiffness, only: cubic, shear_law
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: read_joint, read_cjoint, read_pjoint, read_jnorm, read_jshear, read_jincr

   integer, parameter :: most_increments = 100000
   integer, parameter :: most_reanalyses = 1000

contains

   !> JOINT: interface elements between two marked surfaces, or one marked surface and a rigid base.
   subroutine read_joint(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('JID'), integer_field('PJID'), integer_field('SIDE1'), &
         integer_field('SIDE2', default=0), real_field('TOL', default=0.0_wp, above=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      if (values%integers(4) == values%integers(3) .and. values%integers(3) > 0) then
         call field_error(card, 4, 'SIDE2: the same surface as SIDE1', errors)
      end if
      bulk%n_joint = bulk%n_joint + 1
      associate (joint => bulk%joint(bulk%n_joint))
         joint%line = card%line
         joint%id = values%integers(1)
         joint%law = values%integers(2)
         joint%sides = values%integers(3:4)
         joint%tolerance = values%reals(5)
      end associate
   end subroutine read_joint


   !> CJOINT: one interface element given outright.
   subroutine read_cjoint(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('EID'), integer_field('PJID'), integer_field('G1'), &
         integer_field('G2', default=0), real_field('AREA', above=0.0_wp), real_field('NX', default=0.0_wp), &
         real_field('NY', default=0.0_wp), real_field('NZ', default=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      call check_direction(card, table, 6, 'the normal', values, errors)
      if (values%integers(4) == values%integers(3) .and. values%integers(3) > 0) then
         call field_error(card, 4, 'G2: the same node as G1', errors)
      end if
      bulk%n_cjoint = bulk%n_cjoint + 1
      associate (cjoint => bulk%cjoint(bulk%n_cjoint))
         cjoint%line = card%line
         cjoint%id = values%integers(1)
         cjoint%law = values%integers(2)
         cjoint%nodes = values%integers(3:4)
         cjoint%area = values%reals(5)
         cjoint%normal = values%reals(6:8)
      end associate
   end subroutine read_cjoint


   !> PJOINT: the laws of a joint.
   subroutine read_pjoint(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('PJID'), integer_field('NID'), &
         integer_field('SIDX', default=0), integer_field('SIDY', default=0), real_field('MU', default=0.0_wp, least=0.0_wp), &
         integer_field('NREAN', default=1, least=-1, most=most_reanalyses), real_field('P0', default=0.0_wp, above=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      bulk%n_pjoint = bulk%n_pjoint + 1
      associate (pjoint => bulk%pjoint(bulk%n_pjoint))
         pjoint%line = card%line
         pjoint%id = values%integers(1)
         pjoint%normal_law = values%integers(2)
         pjoint%shear_laws = values%integers(3:4)
         pjoint%mu = values%reals(5)
         pjoint%mu_given = values%given(5)
         pjoint%n_reanalyses = values%integers(6)
         pjoint%p0 = values%reals(7)
         pjoint%p0_given = values%given(7)
      end associate
   end subroutine read_pjoint


   !> JNORM: lambda = C p^M, unloading slope EU.
   subroutine read_jnorm(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('NID'), real_field('C', above=0.0_wp), &
         real_field('M', above=0.0_wp, most=1.0_wp), real_field('EU', default=0.0_wp, above=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      bulk%n_jnorm = bulk%n_jnorm + 1
      associate (jnorm => bulk%jnorm(bulk%n_jnorm))
         jnorm%line = card%line
         jnorm%id = values%integers(1)
         jnorm%c = values%reals(2)
         jnorm%m = values%reals(3)
         jnorm%e_u = values%reals(4)
         jnorm%e_u_given = values%given(4)
      end associate
   end subroutine read_jnorm


   !> JSHEAR: the shear law of one direction. The card has the loading coefficients A; the first continuation has those of
   !! unloading (B), the second those of reloading (C), either left blank as loading; the third the tested range.
   subroutine read_jshear(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      type(cubic) :: curves(3)
      integer :: first, k

      if (.not. allocated(table)) table = [integer_field('SID'), real_field('A11'), coefficient('A12'), coefficient('A21'), &
         coefficient('A22'), coefficient('A31'), coefficient('A32'), blank_field('blank'), &
         coefficient('B11'), coefficient('B12'), coefficient('B21'), coefficient('B22'), coefficient('B31'), &
         coefficient('B32'), blank_field('blank'), blank_field('blank'), &
         coefficient('C11'), coefficient('C12'), coefficient('C21'), coefficient('C22'), coefficient('C31'), &
         coefficient('C32'), blank_field('blank'), blank_field('blank'), &
         real_field('PMAX', default=huge(1.0_wp), above=0.0_wp), real_field('DMAX', default=huge(1.0_wp), above=0.0_wp)]
      call decode_card(aligned(card), table, .false., values, errors)
      bulk%n_jshear = bulk%n_jshear + 1
      associate (jshear => bulk%jshear(bulk%n_jshear), x => values%reals)
         jshear%line = card%line
         jshear%id = values%integers(1)
         do k = 1, 3
            first = 8*k - 7
            if (k == 1) first = 2
            if (.not. any(values%given(first:first + 5))) then
               curves(k) = curves(1)
            else
               curves(k) = cubic(reshape(x(first:first + 5), [2, 3]))
               if (k > 1 .and. .not. values%given(first)) call field_error(card, first, trim(table(first)%name)// &
                  ': blank, expected a real number: the first coefficient of a branch that is given', errors)
            end if
         end do
         jshear%law = shear_law(given=.true., load=curves(1), unload=curves(2), reload=curves(3), p_max=x(25), d_max=x(26))
      end associate

   contains

      pure function coefficient(name) result(rule)
         character(*), intent(in) :: name
         type(field_rule) :: rule

         rule = real_field(name, default=0.0_wp)
      end function coefficient

   end subroutine read_jshear


   !> A JSHEAR card whose continuation lines begin in field 2, where they stand under A11 in field 3.
   pure function aligned(card) result(moved)
      type(card_type), intent(in) :: card
      type(card_type) :: moved
      integer :: before, entries

      moved = card
      do before = 8, 24, 8
         entries = merge(6, 2, before < 24)
         if (before + 1 + entries > card%n) cycle
         if (card%fields(before + 1)%text /= '' .or. card%fields(before + 1 + entries)%text == '') cycle
         moved%fields(before + 1:before + entries) = card%fields(before + 2:before + 1 + entries)
         moved%fields(before + 1 + entries) = card%fields(before + 1)
      end do
   end function aligned


   !> JINCR: the increments of a stage, turned into shares that add up to 1.
   subroutine read_jincr(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)
      logical :: ok

      if (.not. allocated(table)) table = [integer_field('SID'), integer_field('N', default=0, most=most_increments), &
         word_field('PROG', '|ARITH|GEOM|LIST|'), real_field('FIRST', default=0.05_wp, above=0.0_wp, most=1.0_wp)]
      call decode_card(card, table(:merge(3, 4, card_is_list(card))), card_is_list(card), values, errors)
      bulk%n_jincr = bulk%n_jincr + 1
      associate (jincr => bulk%jincr(bulk%n_jincr), n => values%integers(2), first => values%reals(4))
         jincr%line = card%line
         jincr%id = values%integers(1)
         jincr%shares = [1.0_wp]
         if (.not. values%ok) return
         if (values%words(3) == 'LIST') then
            call read_list(card, values, jincr, errors)
            return
         end if
         if (.not. values%given(2)) then
            call field_error(card, 2, 'N: blank, expected the number of increments', errors)
         else if (values%words(3) == 'ARITH') then
            call arithmetic_shares(n, first, jincr%shares, ok)
            if (.not. ok) call field_error(card, 4, 'FIRST: with '//integer_text(n)//' increments in arithmetic progression'// &
               ' and a first share of '//real_text(first)//' the last share is not positive, expected FIRST below '// &
               real_text(2.0_wp/n), errors)
         else
            call geometric_shares(n, first, jincr%shares, ok)
            if (.not. ok) call field_error(card, 4, 'FIRST: no geometric progression of '//integer_text(n)// &
               ' increments begins with '//real_text(first), errors)
         end if
      end associate
   end subroutine read_jincr


   pure logical function card_is_list(card)
      type(card_type), intent(in) :: card

      card_is_list = .false.
      if (card%n >= 3) card_is_list = card%fields(3)%text == 'LIST'
   end function card_is_list


   !> The shares of PROG = LIST; they stand from FIRST on and add up to 1 (to 1E-4: then they are scaled to do so).
   subroutine read_list(card, values, jincr, errors)
      type(card_type), intent(in)          :: card
      type(card_values), intent(in)        :: values
      type(jincr_card), intent(inout)      :: jincr
      type(deck_error_list), intent(inout) :: errors
      real(wp), allocatable :: shares(:)
      integer :: k, n, errors_before
      logical :: ok

      errors_before = errors%n
      allocate (shares(card%n), source=0.0_wp)
      n = 0
      do k = 4, card%n
         if (card%fields(k)%text == '') cycle
         n = n + 1
         call decode_real(card, k, 'SHARE', 'a share of the load change', shares(n), ok, errors)
         if (ok .and. shares(n) <= 0.0_wp) call field_error(card, k, 'SHARE: '//real_text(shares(n))// &
                                                            ', expected above 0', errors)
      end do
      if (errors%n > errors_before) return
      if (values%given(2) .and. values%integers(2) /= n) then
         call field_error(card, 2, 'N: '//integer_text(values%integers(2))//', but '//integer_text(n)//' shares follow', errors)
      else if (abs(sum(shares(:n)) - 1.0_wp) > 1.0e-4_wp) then
         call field_error(card, 4, 'SHARE: the shares add up to '//real_text(sum(shares(:n)))//', expected 1', errors)
      else
         jincr%shares = shares(:n)/sum(shares(:n))
      end if
   end subroutine read_list

end module joint_cards
