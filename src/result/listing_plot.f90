!> Line-printer plots of a joint, as the period had them: pressure and deflection along the interface, in space the pressure as
!! a map over its plane.
module listing_plot
   use analysis_state, only: analysis_type
   use interface_operator, only: at_first_end
   use joint_motion, only: find_frame, is_closed, joint_frame
   use kinds, only: wp
   use listing_table, only: heading, noise, page_type, page_width
   use model_data, only: joint_node_id, joint_type, model_type
   use normal_stiffness, only: branch_open, normal_state
   use text_tools, only: clean, integer_text
   implicit none
   private

   public :: plot_joints

   integer, parameter :: width = 101 ! columns of the field of a plot: 0 to 100 per cent

contains

   !> A plot a joint; a map where it has a plane in space.
   subroutine plot_joints(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      integer :: j

      do j = 1, size(model%joints)
         if (model%dimension == 3 .and. .not. is_closed(model, model%joints(j))) then
            call map_joint(page, model, analysis, model%joints(j))
         else
            call plot_joint(page, model, analysis, model%joints(j))
         end if
      end do
   end subroutine plot_joints

   !> The pressure of JOINT over its plane, seen against its normal: x of the joint to the right, y upwards. A character has the
   !! largest pressure of the interface elements there: tenths of the largest of all, which is *; - where all are open.
   subroutine map_joint(page, model, analysis, joint)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      real(wp), parameter :: upright = 2.0_wp ! height of a character over its width
      character(width), allocatable :: rows(:)
      character(page_width) :: line
      type(joint_frame)     :: frame
      real(wp) :: place(3, joint%first:joint%last), low(3), high(3), step, p_most
      integer  :: column, i, row

      frame = find_frame(model, joint)
      do i = joint%first, joint%last
         place(:, i) = at_first_end(model%interface(i), model%x) - frame%centroid
         place(:, i) = matmul(place(:, i), frame%axes)
      end do
      low = minval(place, dim=2)
      high = maxval(place, dim=2)
      step = sqrt(joint%area/(joint%last - joint%first + 1))/upright ! a row for every row of nodes of an even mesh
      step = max(step, (high(1) - low(1))/(width - 1), (high(2) - low(2))/(width - 1))
      allocate (rows(0:nint((high(2) - low(2))/(upright*step))))
      rows = ''
      p_most = max(maxval(analysis%states(joint%first:joint%last)%normal%pressure), tiny(1.0_wp))
      do i = joint%first, joint%last
         column = 1 + nint((place(1, i) - low(1))/step)
         row = nint((high(2) - place(2, i))/(upright*step))
         associate (sign => map_sign(analysis%states(i)%normal, p_most), there => rows(row)(column:column))
            if (rank_of(sign) > rank_of(there)) there = sign
         end associate
      end do
      call heading(page%file, 'MAP OF JOINT '//integer_text(joint%id)//page%now)
      write (line, '(2x, a, es13.5, 1x, a)') '0 TO 9: TENTHS OF P, *: P =', clean(p_most), trim(page%labels%pressure)
      call page%file%put(trim(line)//', -: OPEN')
      write (line, '(2x, 4(a, es13.5), 1x, a)') 'X FROM', clean(low(1)), ' TO', clean(high(1)), ', Y FROM', clean(low(2)), &
         ' (BELOW) TO', clean(high(2)), trim(page%labels%length)
      call page%file%put(trim(line)//' FROM THE CENTROID OF THE JOINT')
      call page%file%put('')
      do row = 0, ubound(rows, 1)
         call page%file%put('   |'//rows(row))
      end do
   end subroutine map_joint

   !> What a map shows of an interface element in this STATE.
   pure character(1) function map_sign(state, p_most) result(sign)
      type(normal_state), intent(in) :: state
      real(wp), intent(in)           :: p_most

      sign = '-'
      if (state%branch == branch_open) return
      sign = achar(iachar('0') + max(0, min(9, int(10.0_wp*(1.0_wp + noise)*state%pressure/p_most))))
      if (state%pressure >= (1.0_wp - noise)*p_most) sign = '*'
   end function map_sign

   !> Which of two signs at one place is shown: that of the higher rank.
   pure integer function rank_of(sign) result(rank)
      character(1), intent(in) :: sign

      rank = index('-0123456789*', sign)
   end function rank_of

   !> A line an interface element of JOINT, P as *, LAMBDA as +, both as # where they meet.
   subroutine plot_joint(page, model, analysis, joint)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      character(page_width) :: line
      real(wp) :: p_most, lambda_most, lambda_least
      integer  :: i

      associate (state => analysis%states%normal)
         p_most = max(maxval(state(joint%first:joint%last)%pressure), tiny(1.0_wp))
         lambda_least = min(0.0_wp, minval(state(joint%first:joint%last)%lambda))
         lambda_most = max(0.0_wp, maxval(state(joint%first:joint%last)%lambda), lambda_least + tiny(1.0_wp))
         call heading(page%file, 'PLOT OF JOINT '//integer_text(joint%id)//page%now)
         write (line, '(2x, a, es13.5, 1x, a)') '*  P       FROM  0.00000E+00 TO', clean(p_most), trim(page%labels%pressure)
         call page%file%put(line)
         write (line, '(2x, a, es13.5, a, es13.5, 1x, a)') '+  LAMBDA  FROM', clean(lambda_least), ' TO', &
            clean(lambda_most), trim(page%labels%length)
         call page%file%put(line)
         call page%file%put('      NODE            X  +'//repeat('---------+', 10))
         do i = joint%first, joint%last
            write (line, '(i10, es13.5)') joint_node_id(model, i, 1), clean(at_first_end(model%interface(i), model%x(1:1, :)))
            line(26:26) = '|'
            line(25 + width:25 + width) = '|'
            call mark((state(i)%lambda - lambda_least)/(lambda_most - lambda_least), '+')
            call mark(state(i)%pressure/p_most, '*')
            call page%file%put(line)
         end do
         call page%file%put('                         +'//repeat('---------+', 10))
      end associate

   contains

      subroutine mark(share, sign)
         real(wp), intent(in)     :: share
         character(1), intent(in) :: sign
         integer :: column

         column = 26 + nint(min(1.0_wp, max(0.0_wp, share))*(width - 1))
         line(column:column) = merge('#', sign, line(column:column) == '+')
      end subroutine mark

   end subroutine plot_joint

end module listing_plot
