!> Line-printer plots of a joint, as the period had them: pressure and deflection along the interface.
module listing_plot
   use analysis_state, only: analysis_type
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use listing_table, only: heading, page_type, page_width
   use model_data, only: joint_node_id, model_type
   use text_tools, only: clean, integer_text
   implicit none
   private

   public :: plot_joints

   integer, parameter :: width = 101 ! columns of the field of a plot: 0 to 100 per cent

contains

   !> A plot a joint: a line an interface element, P as *, LAMBDA as +, both as # where they meet.
   subroutine plot_joints(page, model, analysis)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      character(page_width) :: line
      real(wp) :: p_most, lambda_most, lambda_least
      integer  :: i, j

      do j = 1, size(model%joints)
         associate (joint => model%joints(j), state => analysis%states%normal)
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
               write (line, '(i10, es13.5)') joint_node_id(model, i, 1), &
                  clean(at_first_end(model%interface(i), model%x(1:1, :)))
               line(26:26) = '|'
               line(25 + width:25 + width) = '|'
               call mark((state(i)%lambda - lambda_least)/(lambda_most - lambda_least), '+')
               call mark(state(i)%pressure/p_most, '*')
               call page%file%put(line)
            end do
            call page%file%put('                         +'//repeat('---------+', 10))
         end associate
      end do

   contains

      subroutine mark(share, sign)
         real(wp), intent(in)     :: share
         character(1), intent(in) :: sign
         integer :: column

         column = 26 + nint(min(1.0_wp, max(0.0_wp, share))*(width - 1))
         line(column:column) = merge('#', sign, line(column:column) == '+')
      end subroutine mark

   end subroutine plot_joints

end module listing_plot
