!> Warnings about cubics whose slope turns negative where the card may be used.
module slope_warnings
   use fit_branches, only: branch_words, fit_load, fit_reload, fit_unload
   use kinds, only: wp
   use slope_check, only: find_slope_loss
   use surface_fit, only: surface_fit_type
   use text_tools, only: real_text
   implicit none
   private

   public :: check_slopes

contains

   !> Look at every fitted branch in the range of its data and, where all is well there, in what the card covers: p from 0
   !! to PMAX, d to DMAX, and for unloading and reloading d below zero too, because these branches go on past zero to the
   !! mirror of their point A. A branch is followed as the joint does: unloading with falling d, the others with rising d.
   subroutine check_slopes(fit)
      type(surface_fit_type), intent(inout) :: fit
      integer  :: b
      real(wp) :: from, to

      do b = fit_load, fit_reload
         associate (branch => fit%branch(b))
            if (branch%n_points == 0) cycle
            from = 0.0_wp
            to = fit%d_max
            if (to <= 0.0_wp) to = huge(to)
            if (branch%from_points) then
               from = branch%d_low
               to = branch%d_high
               if (b == fit_load) from = min(from, 0.0_wp)
               if (b == fit_unload) call swap(from, to)
            end if
            if (loses_slope(fit, b, branch%p_low, branch%p_high, from, to, 'inside the tested range')) cycle
            if (.not. fit%has_loading) cycle
            from = 0.0_wp
            to = fit%d_max
            if (to <= 0.0_wp) to = huge(to)
            if (b /= fit_load .and. fit%d_max > 0.0_wp) from = -to
            if (b == fit_unload .and. fit%d_max > 0.0_wp) call swap(from, to)
            if (loses_slope(fit, b, 0.0_wp, fit%p_max, from, to, 'outside the tested range of the branch, but inside the '// &
                            'range of the card')) cycle
         end associate
      end do
   end subroutine check_slopes


   !> Whether branch B loses its slope in the range; then a warning names the place.
   logical function loses_slope(fit, b, p_low, p_high, from, to, range) result(found)
      type(surface_fit_type), intent(inout) :: fit
      integer, intent(in)      :: b
      real(wp), intent(in)     :: p_low, p_high, from, to
      character(*), intent(in) :: range
      real(wp) :: p, d

      call find_slope_loss(fit%card(:, :, b), p_low, p_high, from, to, found, p, d)
      if (found) call fit%warnings%add(0, trim(branch_words(b))//': the slope of tau is first not positive at p = '// &
                                       real_text(p)//', d = '//real_text(d)//', '//range)
   end function loses_slope


   pure subroutine swap(a, b)
      real(wp), intent(inout) :: a, b
      real(wp) :: kept

      kept = a
      a = b
      b = kept
   end subroutine swap

end module slope_warnings
