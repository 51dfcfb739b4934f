!> Writes a gnuplot script that plots the data and the fit of a surface: the test points, and lines through the fit at these points.
module fit_plot
   use branch_cubic, only: cubic, cubic_value
   use branch_fit, only: branch_fit_type
   use data_columns, only: branch_letters, branch_words, column_d, column_k, column_lambda, column_p, column_loss, column_symbols, &
                           column_tau, data_loss, data_normal, data_shear, data_stiffness, fit_load, fit_reload, fit_unload
   use fit_command, only: fit_command_type
   use fit_data, only: test_data_type
   use kinds, only: wp
   use output_file, only: output_file_type
   use surface_fit, only: surface_fit_type
   use text_tools, only: integer_text, one_of, real_text
   implicit none
   private

   public :: write_plot, put_block, quoted

contains

   !> Add the plot of surface NUMBER of the command to OUT: p over lambda, tau over d, or for published cubics Fig. 2, their
   !! coefficients over p. The fit of a normal test is the power law of loading, and lines of the slope E_u; that of a run of shear
   !! is the law of the card with its best constant, and, as a thin line, the one of the other ORIGIN; that of the coefficients is
   !! their lines.
   subroutine write_plot(command, number, data, fit, out)
      type(fit_command_type), intent(in)    :: command
      integer, intent(in)                   :: number
      type(test_data_type), intent(in)      :: data
      type(surface_fit_type), intent(in)    :: fit
      type(output_file_type), intent(inout) :: out
      character(:), allocatable :: picture, plots ! arguments of the plot command
      integer, allocatable  :: rows(:)
      real(wp), allocatable :: d(:), fitted(:), p(:)
      character(32) :: label
      integer :: axes(2), b, g, i, k, look

      picture = command%plot
      k = index(picture, '.', back=.true.)
      if (k > index(picture, '/', back=.true.) + 1) picture = picture(:k - 1)
      if (size(command%files) > 1) picture = picture//'_'//integer_text(command%id + number - 1)
      call out%put('# '//command%files(number)%name//' and its fit by jointfit; gnuplot draws '//picture//'.svg')
      call out%put('reset')

      ! blocks of points with the fit at each of them
      plots = ''
      if (data%kind == data_stiffness) then
         rows = [(i, i = 1, data%n)]
         p = data%value(column_p, rows)
         fitted = p**(1.0_wp - fit%normal%m)/(fit%normal%m*fit%normal%c)
         call put_block(out, plots, 'k', [fit_load, fit_load], p, data%value(column_k, rows), p, fitted)
      else if (fit%kind == data_normal) then
         associate (loops => fit%normal%loops)
            do k = 0, size(loops%lines)
               rows = pack([(i, i = 1, data%n)], loops%line_of == k)
               p = data%value(column_p, rows)
               b = fit_load
               fitted = fit%normal%c*max(p, 0.0_wp)**fit%normal%m
               if (k > 0) b = loops%lines(k)%branch
               if (k > 0) fitted = 0.0_wp*p + loops%lines(k)%lambda
               if (k > 0 .and. loops%e_u > 0.0_wp) fitted = fitted + (p - loops%lines(k)%p)/loops%e_u
               call put_block(out, plots, trim(branch_words(b)), [b, b], data%value(column_lambda, rows), p, fitted, p)
            end do
         end associate
      end if
      if (fit%kind == data_loss) then
         axes = [column_d, merge(column_loss, column_tau, data%kind == data_loss)]
         rows = [(i, i = 1, data%n)]
         call put_block(out, plots, trim(column_symbols(axes(2))), [fit_load, fit_load], data%value(column_d, rows), &
                        data%value(axes(2), rows), data%value(column_d, rows), fit%iwan%fitted)
      end if
      do b = fit_load, fit_reload
         associate (branch => fit%branch(b))
            if (branch%n_points == 0 .or. (fit%one_shape .and. b == fit_reload)) cycle
            if (fit%kind == data_shear) then
               do k = 1, size(branch%start)
                  rows = pack(branch%row, branch%curve == k)
                  g = branch%group(branch%curve_at(k))
                  look = merge(data%branch(rows(1)), b, fit%one_shape .and. b == fit_unload) ! of both, one cubic
                  d = data%value(column_d, rows)
                  call put_block(out, plots, trim(branch_words(look))//', p = '//real_text(branch%group_p(g)), [look, g], d, &
                                 data%value(column_tau, rows), d, law_of_run(data, branch, fit%card(:, :, b), k))
               end do
            else
               do k = 1, 3
                  call put_block(out, plots, branch_letters(b)//integer_text(k), [b, k], branch%group_p, branch%cubic(k, :), &
                                 branch%group_p, branch%lines(1, k) + branch%lines(2, k)*branch%group_p)
               end do
            end if
         end associate
      end do
      do b = fit_unload, fit_reload
         associate (branch => fit%other(b))
            if (branch%n_points == 0) cycle
            do k = 1, size(branch%start)
               d = data%value(column_d, pack(branch%row, branch%curve == k))
               call put_block(out, plots, 'ORIGIN '//one_of(fit%from_branch, 'CURVE', 'BRANCH'), [0, 0], [real(wp) ::], &
                              [real(wp) ::], d, law_of_run(data, branch, fit%other_card(:, :, b), k))
            end do
         end associate
      end do

      ! the picture and its axes
      call out%put('set terminal svg size 900,600 noenhanced background "white"')
      call out%put('set output '//quoted(picture//'.svg'))
      call out%put('set title '//quoted(command%files(number)%name))
      if (fit%kind /= data_loss) axes = [column_p, 0] ! 0: coefficients
      if (fit%kind == data_normal) axes = [column_lambda, column_p]
      if (data%kind == data_stiffness) axes = [column_p, column_k]
      if (fit%kind == data_shear) axes = [column_d, column_tau]
      do k = 1, count(axes > 0)
         label = column_symbols(axes(k))
         if (data%unit(axes(k)) /= '') label = trim(label)//' ['//trim(data%unit(axes(k)))//']'
         call out%put('set '//merge('x', 'y', k == 1)//'label '//quoted(label))
      end do
      if (data%kind == data_loss) call out%put('set logscale xy')
      call out%put('set key outside right')
      call out%put('set grid')
      call out%put('plot '//plots(3:))
   end subroutine write_plot

   !> tau of the law with the coefficients LINES at the points of RUN of BRANCH, with its best constant [stress].
   function law_of_run(data, branch, lines, run) result(tau)
      type(test_data_type), intent(in)  :: data
      type(branch_fit_type), intent(in) :: branch
      real(wp), intent(in)              :: lines(2, 3)
      integer, intent(in)               :: run
      real(wp), allocatable :: sense(:), tau(:), x(:)
      integer, allocatable  :: at(:)
      integer :: i

      at = pack([(i, i = 1, size(branch%curve))], branch%curve == run)
      sense = branch%sense(at)
      x = sense*(data%value(column_d, branch%row(at)) - branch%from(at))
      tau = sense*cubic_value(cubic(lines), x, branch%group_p(branch%group(at(1))))
      if (branch%constant) tau = tau + sum(data%value(column_tau, branch%row(at)) - tau)/size(at)
   end function law_of_run

   !> Add a block of points X, Y with the fit FITTED_X, FITTED_Y at each point, in a LOOK of shape and colour, or where there are no
   !! X a thin line of the fit alone. Consecutive blocks of one TITLE share an entry of the key.
   subroutine put_block(out, plots, title, look, x, y, fitted_x, fitted_y)
      type(output_file_type), intent(inout)    :: out
      character(:), allocatable, intent(inout) :: plots !! arguments of the plot command so far
      character(*), intent(in) :: title
      integer, intent(in)      :: look(2)
      real(wp), intent(in)     :: x(:), y(:), fitted_x(:), fitted_y(:)
      character(:), allocatable :: block, colour, name
      integer :: i

      i = 1
      do while (index(plots, '$data_'//integer_text(i)//' ') > 0)
         i = i + 1
      end do
      block = '$data_'//integer_text(i)
      call out%put(block//' << EOD')
      do i = 1, size(fitted_x)
         name = ''
         if (size(x) > 0) name = real_text(x(i))//' '//real_text(y(i))//' '
         call out%put(name//real_text(fitted_x(i))//' '//real_text(fitted_y(i)))
      end do
      call out%put('EOD')
      name = ' title '//quoted(title)
      if (index(plots, name) > 0) name = ' notitle'
      colour = ' lc '//integer_text(look(2))
      if (size(x) == 0) plots = plots//', '//block//' using 1:2 with lines lw 1 lc rgb "black"'//name
      if (size(x) == 0) return
      plots = plots//', '//block//' using 1:2 with points pt '//integer_text(2*look(1) + 3)//colour//name//', '//block// &
              ' using 3:4 with lines lw 2 dt '//integer_text(look(1))//colour//' notitle'
   end subroutine put_block

   !> TEXT quoted for gnuplot.
   pure function quoted(text) result(words)
      character(*), intent(in)  :: text
      character(:), allocatable :: words
      integer :: k

      words = ''''
      do k = 1, len_trim(text)
         words = words//text(k:k)
         if (text(k:k) == '''') words = words//''''
      end do
      words = words//''''
   end function quoted

end module fit_plot
