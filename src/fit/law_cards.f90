!> Writes the fitted JNORM, JSHEAR and JIWAN cards below comments: data, residuals, range, coefficients and warnings.
!! The numbers on the cards have as many digits as the columns hold.
module law_cards
   use branch_fit, only: branch_fit_type, residual_type
   use terminal, only: version
   use data_columns, only: branch_letters, branch_words, column_d, column_p, column_symbols, data_loss, data_normal, fit_load, &
                           fit_reload, fit_unload, n_columns
   use card_text, only: card_lines, number_fields, real_field_text
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use output_file, only: output_file_type
   use surface_fit, only: normal_fit_type, surface_fit_type
   use text_tools, only: integer_text, one_of, plural, real_text
   implicit none
   private

   public :: write_cards, jnorm_card, jshear_card, coefficient_line, real_field_text

contains

   !> Write the card of surface NUMBER of the command with its comments.
   subroutine write_cards(command, number, data, fit, out)
      type(fit_command_type), intent(in)    :: command
      integer, intent(in)                   :: number
      type(test_data_type), intent(in)      :: data
      type(surface_fit_type), intent(in)    :: fit
      type(output_file_type), intent(inout) :: out
      character(:), allocatable :: words
      integer :: id, k

      id = command%id + (number - 1)
      call comment(out, '', 'fitted by jointfit '//version//' to '//command%files(number)%name)
      if (data%units /= '') call comment(out, 'units', data%units)
      words = ''
      do k = 1, n_columns
         if (data%unit_read(k) /= '') words = words//', '//trim(column_symbols(k))//' ['//trim(data%unit_read(k))//']'
      end do
      if (command%reading%deck%length > 0.0_wp) then ! the cards have units of their own
         if (words /= '') words = ', converted from'//words(2:)
         call comment(out, 'units', trim(data%unit(column_d))//', '//trim(data%unit(column_p))//words)
      else if (words /= '') then
         call comment(out, 'units', words(3:))
      end if
      do k = 1, data%notes%n
         call comment(out, 'record', data%notes%items(k)%message)
      end do
      if (fit%kind == data_normal) then
         call describe_normal(fit%normal, out)
      else if (fit%kind == data_loss) then
         do k = 1, fit%iwan%comments%n
            call comment(out, 'law', fit%iwan%comments%items(k)%message)
         end do
      else
         call describe_shear(data, command, fit, out)
      end if
      do k = 1, fit%warnings%n
         call comment(out, 'WARNING', fit%warnings%items(k)%message)
      end do
      if (fit%kind == data_normal) then
         call put_lines(out, '', jnorm_card(id, fit%normal%c, fit%normal%m, fit%normal%loops%e_u, command%small))
      else if (fit%kind == data_loss) then
         associate (law => fit%iwan%law)
            call put_lines(out, '', jiwan_card(id, [law%f_s, law%k_t, law%chi, law%beta], command%small))
         end associate
      else if (fit%has_loading) then
         call put_lines(out, '', jshear_card(id, fit%card, fit%branch%n_points > 0, fit%p_max, fit%d_max, command%small, &
                                          fit%from_branch))
      else
         do k = fit_unload, fit_reload
            if (fit%branch(k)%n_points == 0) cycle
            call comment(out, '', 'no card: there are no loading data. The '//trim(branch_words(k))// &
                         ' continuation of a JSHEAR card, without its $:')
            call put_lines(out, '$', coefficient_line(fit%card(:, :, k), command%small))
         end do
      end if
   end subroutine write_cards

   subroutine describe_normal(fit, out)
      type(normal_fit_type), intent(in)     :: fit
      type(output_file_type), intent(inout) :: out
      character(:), allocatable :: points
      character(14) :: cells(6)
      integer :: k

      points = plural(fit%n_points, 'point')//one_of(size(fit%loops%lines) > 0, ' of loading', '')
      call comment(out, 'law', 'lambda = c p^m, c = '//real_text(fit%c)//', m = '//real_text(fit%m))
      points = points//', p '//range_text(fit%p_low, fit%p_high)//', '//trim(fit%reading)//' to '//real_text(fit%high)
      call comment(out, 'data', points)
      call comment(out, 'residual', 'of '//trim(fit%reading)//': rms '//real_text(fit%residual%rms)//', largest '// &
                   real_text(fit%residual%largest)//' at p = '//real_text(fit%p_largest))
      associate (loops => fit%loops, lines => fit%loops%lines) ! the lines of unloading and reloading do not contribute to c and m
         if (size(lines) == 0) return
         call comment(out, 'unload', 'E_u = '//real_text(loops%e_u)//', standard error '// &
                      real_text(0.01_wp*nint(1.0e4_wp*min(loops%error, 1.0e4_wp)))//' %, from '// &
                      plural(size(lines), 'line')//' through '//plural(loops%n_points, 'point')//' apart from loading')
         call comment(out, '', 'residual of lambda about lines of this slope: rms '//real_text(loops%rms))
         call comment_row(out, [character(14) :: 'line', 'p from', 'to', 'lambda, p = 0', 'E_u', 'points'])
         do k = 1, size(lines)
            cells = [character(14) :: branch_words(lines(k)%branch), real_text(lines(k)%p_low), real_text(lines(k)%p_high), &
                     real_text(lines(k)%set), real_text(lines(k)%e_u), integer_text(lines(k)%n_points)]
            call comment_row(out, cells)
         end do
      end associate
   end subroutine describe_normal

   subroutine describe_shear(data, command, fit, out)
      type(test_data_type), intent(in)      :: data
      type(fit_command_type), intent(in)    :: command
      type(surface_fit_type), intent(in)    :: fit
      type(output_file_type), intent(inout) :: out
      character(:), allocatable :: words
      logical :: is_used(data%n)
      integer :: b

      call comment(out, 'law', 'tau = (a11 + a12 p) d + (a21 + a22 p) d^2 + (a31 + a32 p) d^3, b unloading, c reloading')
      is_used = data%branch(:data%n) == 0      ! rows without a branch have been reported as ignored
      do b = fit_load, fit_reload
         if (fit%branch(b)%n_points == 0) then
            if (b /= fit_load .and. fit%has_loading) call comment(out, branch_words(b), 'no data: left blank, as loading')
            cycle
         end if
         is_used(fit%branch(b)%row) = .true.
         if (fit%one_shape .and. b == fit_reload) then
            call comment(out, branch_words(b), 'one shape with unloading, fitted together with it')
            cycle
         end if
         if (fit%source(b) /= b) call comment(out, branch_words(b), 'taken from the '//trim(branch_words(fit%source(b)))//' data')
         call describe_branch(data, fit, b, command%fit%one_step, out)
      end do
      if (allocated(fit%origin)) call comment(out, 'origin', fit%origin)
      if (fit%has_loading) then
         words = 'unloading does not reach tau = 0'
         if (fit%closure%is_known) words = real_text(0.01_wp*nint(1.0e4_wp*min(fit%closure%share, 1.0e4_wp)))//' % of tau_r, '// &
            one_of(fit%closure%d > 0.0_wp, 'widest at', 'of the smallest loops, DMAX unknown, at')//' p = '// &
            real_text(fit%closure%p)//', d = '//real_text(fit%closure%d)
         call comment(out, 'closure', words)
      end if
      if (.not. all(is_used)) call comment(out, '', plural(count(.not. is_used), 'row')//' of other branches left out')
      if (fit%has_loading .and. fit%d_max <= 0.0_wp) call comment(out, 'DMAX', 'left blank: the data do not show it')
   end subroutine describe_shear

   !> Write branch B of the card: the cubic of each pressure (the points of Fig. 2), the constant of each run, the lines through the
   !! cubics and, for test points, the one-step fit.
   subroutine describe_branch(data, fit, b, joint_fit, out)
      type(test_data_type), intent(in)      :: data
      type(surface_fit_type), intent(in)    :: fit
      integer, intent(in)                   :: b
      logical, intent(in)                   :: joint_fit
      type(output_file_type), intent(inout) :: out
      character(14) :: cells(6), on_card(2)
      integer :: first, i, last
      logical :: by_run

      on_card = ', on the card'                      ! the lines of the two steps, those of the one step
      on_card(merge(1, 2, joint_fit .and. fit%branch(b)%from_points)) = ''
      associate (branch => fit%branch(b), points => fit%branch(b)%from_points, letter => branch_letters(b))
         if (points) then
            call comment(out, branch_words(b), plural(branch%n_points, 'point')//' at '// &
                         plural(size(branch%group_p), 'pressure')//', p '//range_text(branch%p_low, branch%p_high)//', d '// &
                         range_text(branch%d_low, branch%d_high))
         else
            call comment(out, branch_words(b), plural(branch%n_points, 'cubic')//' given, p '// &
                         range_text(branch%p_low, branch%p_high))
         end if
         if (branch%two_step) then
            by_run = branch%constant .and. size(branch%start) > size(branch%group_p) ! several constants at a pressure
            first = merge(2, 3, branch%constant .and. .not. by_run)
            last = merge(6, 5, points)
            cells = [character(14) :: 'p', letter//'0', letter//'1', letter//'2', letter//'3', 'points']
            call comment_row(out, [cells(1), cells(first:last)])
            do i = 1, size(branch%group_p)
               cells = [character(14) :: real_text(branch%group_p(i)), '', real_text(branch%cubic(1, i)), &
                        real_text(branch%cubic(2, i)), real_text(branch%cubic(3, i)), integer_text(count(branch%group == i))]
               if (first == 2) cells(2) = real_text(start_of(branch, branch%curve(findloc(branch%group, i, 1))))
               call comment_row(out, [cells(1), cells(first:last)])
            end do
            if (by_run) then
               call comment_row(out, [character(14) :: 'run', 'p', letter//'0', 'd from', 'to', 'points'])
               do i = 1, size(branch%start)
                  associate (at => branch%curve_at(i), of_run => branch%curve == i, d => data%value(column_d, branch%row))
                     cells = [character(14) :: integer_text(data%run(branch%row(at))), &
                              real_text(branch%group_p(branch%group(at))), real_text(start_of(branch, i)), &
                              real_text(minval(d, of_run)), real_text(maxval(d, of_run)), integer_text(count(of_run))]
                  end associate
                  call comment_row(out, cells)
               end do
            end if
            if (points) call comment(out, '', 'residual of these cubics: '//residual_words(branch%of_cubics))
            call comment(out, '', 'lines through their coefficients (Fig. 2)'//trim(on_card(1))//':')
            call lines_of_coefficients(branch, b, branch%lines, .true., out)
            if (points) call comment(out, '', '   residual: '//residual_words(branch%of_lines))
         end if
         if (.not. points) return
         call comment(out, '', 'all points in one step'//trim(on_card(2))//':')
         call lines_of_coefficients(branch, b, branch%joint, .false., out)
         call comment(out, '', '   residual: '//residual_words(branch%of_joint))
      end associate

   contains

      !> tau of the curve I at d = 0, or where the branch began.
      pure real(wp) function start_of(branch, i)
         type(branch_fit_type), intent(in) :: branch
         integer, intent(in)               :: i

         start_of = branch%sense(branch%curve_at(i))*branch%start(i)
      end function start_of

      function residual_words(residual) result(words)
         type(residual_type), intent(in) :: residual
         character(:), allocatable :: words

         words = 'rms '//real_text(residual%rms)//', largest '//real_text(residual%largest)//' at p = '// &
                 real_text(data%value(column_p, fit%branch(b)%row(residual%at)))//', d = '// &
                 real_text(data%value(column_d, fit%branch(b)%row(residual%at)))
      end function residual_words

   end subroutine describe_branch

   !> Write a1 = a11 + a12 p and so on; WITH_SCATTER adds the scatter of the coefficients of the cubics.
   subroutine lines_of_coefficients(branch, b, lines, with_scatter, out)
      type(branch_fit_type), intent(in)     :: branch
      integer, intent(in)                   :: b
      real(wp), intent(in)                  :: lines(2, 3)
      logical, intent(in)                   :: with_scatter
      type(output_file_type), intent(inout) :: out
      character(120) :: words
      integer :: k

      do k = 1, 3
         words = '   '//branch_letters(b)//integer_text(k)//' = '//real_text(lines(1, k))// &
                 merge(' - ', ' + ', lines(2, k) < 0.0_wp)//real_text(abs(lines(2, k)))//' p'
         associate (off => branch%of_coefficients(k))
            if (with_scatter) words(41:) = 'scatter rms '//real_text(off%rms)//', largest '//real_text(off%largest)// &
                                           ' at p = '//real_text(branch%group_p(off%at))
         end associate
         call comment(out, '', words)
      end do
   end subroutine lines_of_coefficients

   pure function range_text(low, high) result(words)
      real(wp), intent(in)      :: low, high
      character(:), allocatable :: words

      words = real_text(low)//' to '//real_text(high)
   end function range_text

   !> Write one comment line: a word in its own column, then the text.
   subroutine comment(out, label, words)
      type(output_file_type), intent(inout) :: out
      character(*), intent(in)              :: label, words
      character(9) :: column

      column = label
      call out%put('$ '//column//words)
   end subroutine comment

   !> Write one row of a table.
   subroutine comment_row(out, cells)
      type(output_file_type), intent(inout) :: out
      character(14), intent(in)             :: cells(:)
      character(84) :: words

      write (words, '(6a)') cells
      call comment(out, '', '   '//words)
   end subroutine comment_row

   subroutine put_lines(out, before, lines)
      type(output_file_type), intent(inout) :: out
      character(*), intent(in)              :: before
      character(80), intent(in)             :: lines(:)
      integer :: k

      do k = 1, size(lines)
         call out%put(before//lines(k))
      end do
   end subroutine put_lines

   !> JNORM NID C M EU; a zero E_U leaves its field blank.
   function jnorm_card(id, c, m, e_u, small) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: c, m  !! [length/pressure^m], [-]
      real(wp), intent(in) :: e_u   !! [pressure/length]
      logical, intent(in)  :: small !! fields of 8 columns, otherwise 16
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(1) = integer_text(id)
      fields(2:4) = number_fields([c, m, e_u], small)
      if (e_u <= 0.0_wp) fields(4) = ''
      lines = card_lines('JNORM', fields, small)
   end function jnorm_card

   !> JIWAN IID FS KT CHI BETA, the NUMBERS.
   function jiwan_card(id, numbers, small) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: numbers(4)
      logical, intent(in)  :: small
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(1) = integer_text(id)
      fields(2:5) = number_fields(numbers, small)
      lines = card_lines('JIWAN', fields, small)
   end function jiwan_card

   !> JSHEAR SID A11 A12 A21 A22 A31 A32, the continuations B11 to B32, C11 to C32, and PMAX DMAX ORIGIN. The continuation of a
   !! branch that is not GIVEN is blank, which means as loading. A zero D_MAX leaves its field blank.
   function jshear_card(id, coefficients, given, p_max, d_max, small, from_branch) result(lines)
      integer, intent(in)  :: id
      real(wp), intent(in) :: coefficients(2, 3, 3) !! (., k, branch): a_k1 and a_k2 for load, unload, reload
      logical, intent(in)  :: given(3)              !! the first must be true
      logical, intent(in), optional :: from_branch  !! ORIGIN BRANCH
      real(wp), intent(in) :: p_max, d_max          !! tested range [pressure], [length]
      logical, intent(in)  :: small
      character(80), allocatable :: lines(:)
      character(16) :: fields(32)
      integer, parameter :: first(3) = [2, 9, 17]
      integer :: branch

      fields = ''
      fields(1) = integer_text(id)
      do branch = 1, 3
         if (given(branch)) fields(first(branch):first(branch) + 5) = number_fields([coefficients(:, :, branch)], small)
      end do
      fields(25:26) = number_fields([p_max, d_max], small)
      if (d_max <= 0.0_wp) fields(26) = ''
      if (present(from_branch)) fields(27) = one_of(from_branch, 'BRANCH', '')
      lines = card_lines('JSHEAR', fields, small)
   end function jshear_card

   !> The continuation with the COEFFICIENTS of one branch.
   function coefficient_line(coefficients, small) result(lines)
      real(wp), intent(in) :: coefficients(2, 3)
      logical, intent(in)  :: small
      character(80), allocatable :: lines(:)
      character(16) :: fields(8)

      fields = ''
      fields(:6) = number_fields([coefficients], small)
      lines = card_lines('+', fields, small)
   end function coefficient_line

end module law_cards
