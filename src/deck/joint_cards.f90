!> The card of the gaps, JGAP: one kind of card for five ways to say what the initial gap of a joint is.
!!
!! The cards of the joint: JOINT, CJOINT, PJOINT, JNORM, JSHEAR, JINCR. A table and a routine each.
module joint_cards
   use branch_cubic, only: cubic
   use bulk_data, only: bulk_data_type, cjoint_card, jgap_card, jincr_card, jnorm_card, joint_card, pjoint_card
   use card_lines, only: card_values, decode_integer, decode_real, card_type
   use card_reader, only: card_reader_type
   use field_rules, only: blank_field, integer_field, real_field, word_field
   use kinds, only: wp
   use load_cards, only: arithmetic_shares, geometric_shares
   use normal_curve, only: least_power, normal_law
   use shear_stiffness, only: shear_law
   use text_tools, only: integer_text, real_text
   implicit none
   private

   public :: read_jgap, read_joint, read_cjoint, read_pjoint, read_jnorm, read_jshear, read_jincr

   integer, parameter :: list_from = 9 ! the data field where the lists of TABLE and NODES begin: the first continuation

   integer, parameter :: most_increments = 100000
   integer, parameter :: most_reanalyses = 1000

contains

   !> JGAP: the initial gap of a joint.
   subroutine read_jgap(cards, bulk)
      type(card_reader_type), intent(inout) :: cards
      type(bulk_data_type), intent(inout)   :: bulk
      type(card_values) :: values
      integer :: i, k

      call cards%set_table([integer_field('JID'), word_field('KIND', '|CONST|PLANE|TABLE|NODES|TRUE|'), &
         real_field(['G0', 'SX', 'SY', 'CX', 'CY'], default=0.0_wp), blank_field('blank')], open_ended=.true.)
      allocate (bulk%jgap(cards%n))
      do i = 1, cards%n
         call cards%next(values)
         associate (jgap => bulk%jgap(i), reals => values%reals)
            jgap%line = cards%line
            jgap%joint = values%integers(1)
            jgap%kind = values%words(2)
            jgap%g0 = reals(3)
            jgap%slope = reals(4:5)
            jgap%crown = reals(6:7)
            allocate (jgap%node(0), jgap%gap(0), jgap%at(0), jgap%x(3, 0))
            if (.not. values%given(2)) call cards%error('KIND', 'blank, expected one of CONST, PLANE, TABLE, NODES, TRUE')
            if (cards%is_faulty()) cycle
            select case (jgap%kind)
            case ('CONST', 'PLANE')
               if (.not. values%given(3)) call cards%error('G0', 'blank, expected a real number')
               call check_blank(cards, merge(4, list_from, jgap%kind == 'CONST'))
            case ('TRUE')
               call check_blank(cards, 3)
            case default
               do k = 3, 7
                  if (values%given(k)) call no_entry(cards, k)
               end do
               if (jgap%kind == 'TABLE') call read_points(cards, jgap)
               if (jgap%kind == 'NODES') call read_nodes(cards, jgap)
            end select
         end associate
      end do
   end subroutine read_jgap

   !> From data field FIRST on the card must be blank.
   subroutine check_blank(cards, first)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: first
      integer :: k

      do k = first, cards%card%n
         if (cards%card%fields(k)%length > 0) call no_entry(cards, k)
      end do
   end subroutine check_blank

   subroutine no_entry(cards, k)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k

      associate (card => cards%card)
         call card%field_error(k, ''''//trim(card%fields(k)%text)//''' where the field must be blank: '// &
                               trim(card%fields(2)%text)//' has no such field', cards%errors)
      end associate
   end subroutine no_entry

   !> The points of TABLE: X, Y, Z, G four by four; a coordinate left blank is zero, four blank fields are no point.
   subroutine read_points(cards, jgap)
      type(card_reader_type), intent(inout) :: cards
      type(jgap_card), intent(inout)        :: jgap
      integer, allocatable :: groups(:)
      integer :: d, i

      call list_groups(cards, 4, groups)
      deallocate (jgap%x, jgap%gap)
      allocate (jgap%x(3, size(groups)), jgap%gap(size(groups)))
      do i = 1, size(groups)
         associate (first => groups(i))
            do d = 1, 3
               call read_real(cards, first + d - 1, achar(iachar('X') + d - 1), 'a real number, or blank', .false., &
                              jgap%x(d, i))
            end do
            call read_real(cards, first + 3, 'G', 'the gap at the point, a real number', .true., jgap%gap(i))
         end associate
      end do
      jgap%at = groups
   end subroutine read_points

   !> The nodes of NODES: G1 and its gap, two by two; two blank fields are no node.
   subroutine read_nodes(cards, jgap)
      type(card_reader_type), intent(inout) :: cards
      type(jgap_card), intent(inout)        :: jgap
      character(*), parameter :: expected = 'the number of a node'
      integer, allocatable :: groups(:)
      integer :: i
      logical :: ok

      call list_groups(cards, 2, groups)
      deallocate (jgap%node, jgap%gap)
      allocate (jgap%node(size(groups)), source=0)
      allocate (jgap%gap(size(groups)))
      do i = 1, size(groups)
         associate (first => groups(i), card => cards%card)
            if (card%fields(first)%length == 0) then
               call card%field_error(first, 'G: blank, expected '//expected, cards%errors)
            else
               call decode_integer(card, first, 'G', expected, jgap%node(i), ok, cards%errors)
            end if
            call read_real(cards, first + 1, 'GAP', 'the gap there, a real number', .true., jgap%gap(i))
         end associate
      end do
      jgap%at = groups
   end subroutine read_nodes

   !> Where in the list of the card the GROUPS of so many fields begin that are not blank; there must be some.
   subroutine list_groups(cards, length, groups)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: length
      integer, allocatable, intent(out)     :: groups(:)
      integer :: k

      associate (card => cards%card)
         groups = [(k, k = list_from, card%n, length)]
         groups = pack(groups, [(any(card%fields(k:min(k + length - 1, card%n))%length > 0), k = list_from, card%n, length)])
      end associate
      if (size(groups) == 0) call cards%card%field_error(2, 'KIND: '//trim(cards%card%fields(2)%text)// &
         ', but no list follows in continuation lines', cards%errors)
   end subroutine list_groups

   !> The real in data field K, NAME; blank it is zero, or an error where it is REQUIRED.
   subroutine read_real(cards, k, name, expected, required, value)
      type(card_reader_type), intent(inout) :: cards
      integer, intent(in)                   :: k
      character(*), intent(in)              :: name, expected
      logical, intent(in)                   :: required
      real(wp), intent(out)                 :: value
      logical :: is_blank, ok

      value = 0.0_wp
      is_blank = k > cards%card%n
      if (.not. is_blank) is_blank = cards%card%fields(k)%length == 0
      if (.not. is_blank) call decode_real(cards%card, k, name, expected, value, ok, cards%errors)
      if (is_blank .and. required) call cards%card%field_error(k, name//': blank, expected '//expected, cards%errors)
   end subroutine read_real

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
