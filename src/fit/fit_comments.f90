!> Writes the comments above the fitted cards: data, residuals, range, coefficients and warnings.
module fit_comments
   use branch_fit, only: branch_fit_type, residual_type
   use terminal, only: version
   use data_columns, only: branch_letters, branch_words, column_d, column_p, column_symbols, data_normal, fit_load, fit_reload, &
                           fit_unload, n_columns
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use law_cards, only: coefficient_line, jnorm_card, jshear_card
   use output_file, only: output_file_type
   use surface_fit, only: normal_fit_type, surface_fit_type
   use text_tools, only: integer_text, plural, real_text
   implicit none
   private

   public :: write_cards

contains

   !> Write the card of one surface with its comments. NAME is the data file, ID the id of the card.
   subroutine write_cards(name, data, command, id, fit, out)
      character(*), intent(in)              :: name
      type(test_data_type), intent(in)      :: data
      type(fit_command_type), intent(in)    :: command
      integer, intent(in)                   :: id
      type(surface_fit_type), intent(in)    :: fit
      type(output_file_type), intent(inout) :: out
      character(:), allocatable :: words
      integer :: k

      call comment(out, '', 'fitted by jointfit '//version//' to '//name)
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
      else
         call describe_shear(data, command, fit, out)
      end if
      do k = 1, fit%warnings%n
         call comment(out, 'WARNING', fit%warnings%items(k)%message)
      end do
      if (fit%kind == data_normal) then
         call put_lines(out, '', jnorm_card(id, fit%normal%c, fit%normal%m, fit%normal%loops%e_u, command%small))
      else if (fit%has_loading) then
         call put_lines(out, '', jshear_card(id, fit%card, fit%branch%n_points > 0, fit%p_max, fit%d_max, command%small))
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

      points = plural(fit%n_points, 'point')
      if (size(fit%loops%lines) > 0) points = points//' of loading'
      call comment(out, 'law', 'lambda = c p^m, c = '//real_text(fit%c)//', m = '//real_text(fit%m))
      call comment(out, 'data', points//', p '//range_text(fit%p_low, fit%p_high)//', lambda to '//real_text(fit%lambda_high))
      call comment(out, 'residual', 'of lambda: rms '//real_text(fit%rms)//', largest '//real_text(fit%largest)// &
                   ' at p = '//real_text(fit%p_largest))
      associate (loops => fit%loops) ! the lines of unloading and reloading do not contribute to c and m
         if (size(loops%lines) == 0) return
         call comment(out, 'unload', 'E_u = '//real_text(loops%e_u)//', standard error '// &
                      real_text(0.01_wp*nint(1.0e4_wp*min(loops%error, 1.0e4_wp)))//' %, from '// &
                      plural(size(loops%lines), 'line')//' through '//plural(loops%n_points, 'point')//' apart from loading')
         call comment(out, '', 'residual of lambda about lines of this slope: rms '//real_text(loops%rms))
         call comment_row(out, [character(14) :: 'line', 'p from', 'to', 'lambda, p = 0', 'E_u', 'points'])
         do k = 1, size(loops%lines)
            associate (line => loops%lines(k))
               cells = [character(14) :: branch_words(line%branch), real_text(line%p_low), real_text(line%p_high), &
                        real_text(line%set), real_text(line%e_u), integer_text(line%n_points)]
            end associate
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
      do b = fit_load, fit_reload
         if (fit%branch(b)%n_points == 0) then
            if (b /= fit_load .and. fit%has_loading) call comment(out, branch_words(b), 'no data: left blank, as loading')
            cycle
         end if
         if (fit%source(b) /= b) call comment(out, branch_words(b), 'taken from the '//trim(branch_words(fit%source(b)))//' data')
         call describe_branch(data, fit, b, command%fit%one_step, out)
      end do
      if (fit%has_loading) then
         associate (closure => fit%closure)
            words = 'unloading does not reach tau = 0'
            if (closure%is_known) words = real_text(0.01_wp*nint(1.0e4_wp*min(closure%share, 1.0e4_wp)))//' % of tau_r, '// &
               trim(merge('widest at                              ', 'of the smallest loops, DMAX unknown, at', &
                          closure%d > 0.0_wp))//' p = '//real_text(closure%p)//', d = '//real_text(closure%d)
            call comment(out, 'closure', words)
         end associate
      end if
      is_used = data%branch(:data%n) == 0      ! rows without a branch have been reported as ignored
      do b = fit_load, fit_reload
         if (fit%branch(b)%n_points > 0) is_used(fit%branch(b)%row) = .true.
      end do
      if (.not. all(is_used)) call comment(out, '', plural(count(.not. is_used), 'row')//' of other branches left out')
      if (fit%has_loading .and. fit%d_max <= 0.0_wp) call comment(out, 'DMAX', 'left blank: the data do not show it')
   end subroutine describe_shear

   !> Write branch B of the card: the cubic of each pressure, which are the points of Fig. 2, the lines through them and, for test points,
   !! the one-step fit.
   subroutine describe_branch(data, fit, b, joint_fit, out)
      type(test_data_type), intent(in)      :: data
      type(surface_fit_type), intent(in)    :: fit
      integer, intent(in)                   :: b
      logical, intent(in)                   :: joint_fit
      type(output_file_type), intent(inout) :: out
      character(14) :: cells(6)
      integer :: first, i, last

      associate (branch => fit%branch(b), points => fit%branch(b)%from_points, letter => branch_letters(b), &
                 rows => fit%branch(b)%row)
         if (points) then
            call comment(out, branch_words(b), plural(branch%n_points, 'point')//' at '// &
                         plural(size(branch%group_p), 'pressure')//', p '//range_text(branch%p_low, branch%p_high)//', d '// &
                         range_text(branch%d_low, branch%d_high))
         else
            call comment(out, branch_words(b), plural(branch%n_points, 'cubic')//' given, p '// &
                         range_text(branch%p_low, branch%p_high))
         end if
         if (branch%two_step) then
            first = merge(2, 3, branch%constant .and. size(branch%start) == size(branch%group_p)) ! one constant at a pressure
            last = merge(6, 5, points)
            cells = [character(14) :: 'p', letter//'0', letter//'1', letter//'2', letter//'3', 'points']
            call comment_row(out, [cells(1), cells(first:last)])
            do i = 1, size(branch%group_p)
               cells = [character(14) :: real_text(branch%group_p(i)), '', real_text(branch%cubic(1, i)), &
                        real_text(branch%cubic(2, i)), real_text(branch%cubic(3, i)), integer_text(count(branch%group == i))]
               if (first == 2) cells(2) = real_text(branch%start(branch%curve(findloc(branch%group, i, 1))))
               call comment_row(out, [cells(1), cells(first:last)])
            end do
            if (size(branch%start) > size(branch%group_p) .and. branch%constant) &
               call table_of_runs(branch, letter, data%run(rows), data%value(column_d, rows), out)
            if (points) call comment(out, '', 'residual of these cubics: '//residual_words(branch%of_cubics))
            call comment(out, '', 'lines through their coefficients (Fig. 2)'//on_card(.not. (points .and. joint_fit))//':')
            call lines_of_coefficients(branch, b, branch%lines, .true., out)
            if (points) call comment(out, '', '   residual: '//residual_words(branch%of_lines))
         end if
         if (.not. points) return
         call comment(out, '', 'all points in one step'//on_card(joint_fit)//':')
         call lines_of_coefficients(branch, b, branch%joint, .false., out)
         call comment(out, '', '   residual: '//residual_words(branch%of_joint))
      end associate

   contains

      function residual_words(residual) result(words)
         type(residual_type), intent(in) :: residual
         character(:), allocatable :: words

         words = 'rms '//real_text(residual%rms)//', largest '//real_text(residual%largest)//' at p = '// &
                 real_text(data%value(column_p, fit%branch(b)%row(residual%at)))//', d = '// &
                 real_text(data%value(column_d, fit%branch(b)%row(residual%at)))
      end function residual_words

   end subroutine describe_branch

   !> Write the constant of each run; RUN and D belong to the points.
   subroutine table_of_runs(branch, letter, run, d, out)
      type(branch_fit_type), intent(in)     :: branch
      character(*), intent(in)              :: letter
      integer, intent(in)                   :: run(:)
      real(wp), intent(in)                  :: d(:)
      type(output_file_type), intent(inout) :: out
      character(14) :: cells(6)
      integer :: i

      call comment_row(out, [character(14) :: 'run', 'p', letter//'0', 'd from', 'to', 'points'])
      do i = 1, size(branch%start)
         associate (at => branch%curve_at(i), own => branch%curve == i)
            cells = [character(14) :: integer_text(run(at)), real_text(branch%group_p(branch%group(at))), &
                     real_text(branch%start(i)), real_text(minval(d, own)), real_text(maxval(d, own)), integer_text(count(own))]
         end associate
         call comment_row(out, cells)
      end do
   end subroutine table_of_runs

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

   pure function on_card(chosen) result(words)
      logical, intent(in)       :: chosen
      character(:), allocatable :: words

      words = trim(merge(', on the card', '             ', chosen))
   end function on_card

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

end module fit_comments
