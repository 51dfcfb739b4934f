!> The cards of the joint: JOINT, CJOINT, PJOINT, JNORM, JSHEAR, JINCR. A table and a routine each.
module joint_cards
   use branch_cubic, only: cubic
   use bulk_data, only: bulk_data_type, cjoint_card, jincr_card, jnorm_card, joint_card, pjoint_card
   use card_fields, only: card_values, decode_real
   use card_lines, only: card_type
   use card_reader, only: card_reader_type
   use field_rules, only: blank_field, integer_field, real_field, word_field
   use kinds, only: wp
   use load_shares, only: arithmetic_shares, geometric_shares
   use normal_curve, only: least_power, normal_law
   use shear_stiffness, only: shear_law
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: read_joint, read_cjoint, read_pjoint, read_jnorm, read_jshear, read_jincr

   integer, parameter :: most_increments = 100000
   integer, parameter :: most_reanalyses = 1000

contains

   !> JOINT: interface elements between two marked surfaces, or one marked surface and a rigid base.
   subroutine read_joint(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['JID  ', 'PJID ', 'SIDE1']), integer_field('SIDE2', default=0), &
         real_field('TOL', default=0.0_wp, above=0.0_wp), word_field('FIT', '|AUTO|YES|NO|')])
      allocate (bulk%joint(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (integers => values%integers)
            if (integers(4) == integers(3) .and. integers(3) > 0) call cards%error('SIDE2', 'the same surface as SIDE1')
            bulk%joint(i) = joint_card(line=cards%line, id=integers(1), law=integers(2), sides=integers(3:4), &
                                       tolerance=values%reals(5), &
                                       fit=findloc([character(4) :: 'AUTO', 'YES', 'NO'], values%words(6), dim=1))
         end associate
      end do
   end subroutine read_joint

   !> CJOINT: one interface element given outright.
   subroutine read_cjoint(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['EID ', 'PJID', 'G1  ']), integer_field('G2', default=0), &
         real_field('AREA', above=0.0_wp), real_field(['NX', 'NY', 'NZ'], default=0.0_wp)])
      allocate (bulk%cjoint(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         call cards%check_direction('NX', 'the normal', values)
         associate (integers => values%integers, reals => values%reals)
            if (integers(4) == integers(3) .and. integers(3) > 0) call cards%error('G2', 'the same node as G1')
            bulk%cjoint(i) = cjoint_card(line=cards%line, id=integers(1), law=integers(2), nodes=integers(3:4), &
                                         area=reals(5), normal=reals(6:8))
         end associate
      end do
   end subroutine read_cjoint

   !> PJOINT: the laws of a joint.
   subroutine read_pjoint(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field(['PJID', 'NID ']), integer_field(['SIDX', 'SIDY'], default=0), &
         real_field('MU', default=0.0_wp, least=0.0_wp), integer_field('NREAN', default=1, least=-1, most=most_reanalyses), &
         real_field('P0', default=0.0_wp, above=0.0_wp, most=1.0e30_wp)]) ! above, the joint leaves no digits to the bodies
      allocate (bulk%pjoint(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (integers => values%integers, reals => values%reals, given => values%given)
            bulk%pjoint(i) = pjoint_card(line=cards%line, id=integers(1), normal_law=integers(2), &
               shear_laws=integers(3:4), mu=reals(5), mu_given=given(5), n_reanalyses=integers(6), p0=reals(7), &
               p0_given=given(7))
         end associate
      end do
   end subroutine read_pjoint

   !> JNORM: lambda = C p^M, unloading slope EU.
   subroutine read_jnorm(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i

      call cards%set_table([integer_field('NID'), real_field('C', above=0.0_wp), &
         real_field('M', least=least_power, most=1.0_wp), real_field('EU', default=0.0_wp, above=0.0_wp)])
      allocate (bulk%jnorm(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         bulk%jnorm(i) = jnorm_card(line=cards%line, id=values%integers(1), e_u_given=values%given(4), &
                                    law=normal_law(c=values%reals(2), m=values%reals(3), e_u=values%reals(4)))
      end do
   end subroutine read_jnorm

   !> JSHEAR: the shear law of one direction. The card has the loading coefficients A; the first continuation has those of
   !! unloading (B), the second those of reloading (C), either left blank as loading; the third the tested range.
   subroutine read_jshear(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      type(card_type) :: as_given
      type(cubic)     :: curves(3)
      integer :: first, i, k

      call cards%set_table([integer_field('SID'), real_field('A11'), &
         real_field(['A12', 'A21', 'A22', 'A31', 'A32'], default=0.0_wp), blank_field('blank'), &
         real_field(['B11', 'B12', 'B21', 'B22', 'B31', 'B32'], default=0.0_wp), blank_field(['blank', 'blank']), &
         real_field(['C11', 'C12', 'C21', 'C22', 'C31', 'C32'], default=0.0_wp), blank_field(['blank', 'blank']), &
         real_field(['PMAX', 'DMAX'], default=huge(1.0_wp), above=0.0_wp)])
      allocate (bulk%jshear(cards%n))
      do i = 1, cards%n
         call cards%take()
         as_given = cards%card
         cards%card = aligned(as_given)
         call cards%decode(values)
         cards%card = as_given
         associate (jshear => bulk%jshear(i), x => values%reals, given => values%given)
            jshear%line = cards%line
            jshear%id = values%integers(1)
            do k = 1, 3
               first = 8*k - 7
               if (k == 1) first = 2
               if (.not. any(given(first:first + 5))) then
                  curves(k) = curves(1)
               else
                  curves(k) = cubic(reshape(x(first:first + 5), [2, 3]))
                  if (k > 1 .and. .not. given(first)) call cards%error(achar(iachar('A') + k - 1)//'11', &
                     'blank, expected a real number: the first coefficient of a branch that is given')
               end if
            end do
            jshear%law = shear_law(given=.true., load=curves(1), unload=curves(2), reload=curves(3), p_max=x(25), d_max=x(26))
         end associate
      end do
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
   subroutine read_jincr(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i, n

      call cards%set_table([integer_field('SID'), integer_field('N', default=0, most=most_increments), &
         word_field('PROG', '|ARITH|GEOM|LIST|'), real_field('FIRST', default=0.05_wp, above=0.0_wp, most=1.0_wp)])
      allocate (bulk%jincr(cards%n))
      do i = 1, cards%n
         call cards%take()
         n = 4
         if (cards%card%n >= 3) n = merge(3, 4, cards%card%fields(3)%text == 'LIST')
         call cards%decode(values, n) ! behind LIST the shares follow
         bulk%jincr(i) = jincr_card(line=cards%line, id=values%integers(1), shares=[1.0_wp])
         if (values%ok) call share_out(cards, values, bulk%jincr(i)%shares)
      end do
   end subroutine read_jincr

   !> The SHARES of a JINCR; they stay where there is an error.
   subroutine share_out(cards, values, shares)
      type(card_reader_type), intent(inout) :: cards
      type(card_values), intent(in)         :: values
      real(wp), allocatable, intent(inout)  :: shares(:)
      logical :: ok

      associate (n => values%integers(2), first => values%reals(4))
         if (values%words(3) == 'LIST') then
            call read_list(cards, values, shares)
         else if (.not. values%given(2)) then
            call cards%error('N', 'blank, expected the number of increments')
         else if (values%words(3) == 'ARITH') then
            call arithmetic_shares(n, first, shares, ok)
            if (.not. ok) call cards%error('FIRST', 'with '//integer_text(n)//' increments in arithmetic progression'// &
               ' and a first share of '//real_text(first)//' the last share is not positive, expected FIRST below '// &
               real_text(2.0_wp/n))
         else
            call geometric_shares(n, first, shares, ok)
            if (.not. ok) call cards%error('FIRST', 'no geometric progression of '//integer_text(n)//' increments begins with '// &
                                           real_text(first))
         end if
      end associate
   end subroutine share_out

   !> The shares of PROG = LIST; they stand from FIRST on and add up to 1 (to 1E-4: then they are scaled to do so).
   subroutine read_list(cards, values, shares)
      type(card_reader_type), intent(inout) :: cards
      type(card_values), intent(in)         :: values
      real(wp), allocatable, intent(inout)  :: shares(:)
      real(wp), allocatable :: given(:)
      integer :: k, n
      logical :: ok

      associate (card => cards%card)
         allocate (given(card%n), source=0.0_wp)
         n = 0
         do k = 4, card%n
            if (card%fields(k)%text == '') cycle
            n = n + 1
            call decode_real(card, k, 'SHARE', 'a share of the load change', given(n), ok, cards%errors)
            if (ok .and. given(n) <= 0.0_wp) &
               call card%field_error(k, 'SHARE: '//real_text(given(n))//', expected above 0', cards%errors)
         end do
         if (cards%is_faulty()) return
         if (values%given(2) .and. values%integers(2) /= n) then
            call cards%error('N', integer_text(values%integers(2))//', but '//integer_text(n)//' shares follow')
         else if (abs(sum(given(:n)) - 1.0_wp) > 1.0e-4_wp) then
            call card%field_error(4, 'SHARE: the shares add up to '//real_text(sum(given(:n)))//', expected 1', cards%errors)
         else
            shares = given(:n)/sum(given(:n))
         end if
      end associate
   end subroutine read_list

end module joint_cards
