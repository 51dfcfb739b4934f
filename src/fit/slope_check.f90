!> Warnings about fitted cubics whose slope turns negative where the card may be used: a joint has no negative stiffness.
module slope_check
   use data_columns, only: branch_words, fit_load, fit_reload, fit_unload
   use kinds, only: wp
   use surface_fit, only: surface_fit_type
   use text_tools, only: real_text
   implicit none
   private

   public :: check_slopes, find_slope_loss

contains

   !> Look at every fitted branch in the range of its data and, where all is well there, in what the card covers: p from 0
   !! to PMAX, d to DMAX, and for unloading and reloading d below zero too, because these branches go on past zero to the
   !! mirror of their point A. A branch is followed as the joint does: unloading with falling d, the others with rising d.
   subroutine check_slopes(fit)
      type(surface_fit_type), intent(inout) :: fit
      integer  :: b
      real(wp) :: d_max, way(2)

      d_max = fit%d_max
      if (d_max <= 0.0_wp) d_max = huge(d_max)
      do b = fit_load, fit_reload
         associate (branch => fit%branch(b))
            if (branch%n_points == 0) cycle
            way = [0.0_wp, d_max]
            if (branch%from_points) way = [branch%d_low, branch%d_high]
            if (b == fit_load) way(1) = min(way(1), 0.0_wp)
            if (b == fit_unload .and. branch%from_points) way = way([2, 1])
            if (loses_slope(fit, b, [branch%p_low, branch%p_high], way, 'inside the tested range')) cycle
            if (.not. fit%has_loading) cycle
            way = [0.0_wp, d_max]
            if (b /= fit_load .and. fit%d_max > 0.0_wp) way(1) = -d_max
            if (b == fit_unload .and. fit%d_max > 0.0_wp) way = way([2, 1])
            if (loses_slope(fit, b, [0.0_wp, fit%p_max], way, 'outside the tested range of the branch, but inside the '// &
                            'range of the card, which --dmax sets')) cycle
         end associate
      end do
   end subroutine check_slopes

   !> Whether branch B loses its slope for P between these two, on the WAY from one d to another; then a warning names the place.
   logical function loses_slope(fit, b, p, way, range) result(lost)
      type(surface_fit_type), intent(inout) :: fit
      integer, intent(in)      :: b
      real(wp), intent(in)     :: p(2), way(2)
      character(*), intent(in) :: range
      real(wp) :: p_lost, d_lost

      call find_slope_loss(fit%card(:, :, b), p(1), p(2), way(1), way(2), lost, p_lost, d_lost)
      if (lost) call fit%warnings%add(0, trim(branch_words(b))//': the slope of tau is first not positive at p = '// &
                                      real_text(p_lost)//', d = '//real_text(d_lost)//', '//range)
   end function loses_slope

   !> On the way from d = FROM to d = TO, the first d at which dP/dd = sum over k of k (a_k1 + a_k2 p) d^(k-1) is no longer
   !! positive for some p between P_LOW and P_HIGH. The slope is linear in p, so it is least at one end: two quadratics
   !! in d tell all.
   pure subroutine find_slope_loss(lines, p_low, p_high, from, to, found, p, d)
      real(wp), intent(in)  :: lines(2, 3)   !! a_k1 and a_k2 for k = 1, 2, 3
      real(wp), intent(in)  :: p_low, p_high !! [pressure]
      real(wp), intent(in)  :: from, to      !! [length], TO = +-huge: without end
      logical, intent(out)  :: found
      real(wp), intent(out) :: p, d          !! the place, where found
      real(wp) :: ends(2), place
      logical  :: lost
      integer  :: i

      found = .false.
      p = 0.0_wp
      d = 0.0_wp
      ends = [p_low, p_high]
      do i = 1, 2
         call find_first_root(lines(1, :) + lines(2, :)*ends(i), from, to, lost, place)
         if (.not. lost .or. (found .and. abs(place - from) >= abs(d - from))) cycle
         found = .true.
         p = ends(i)
         d = place
      end do
   end subroutine find_slope_loss

   !> The first d from FROM to TO with a(1) + 2 a(2) d + 3 a(3) d^2 <= 0.
   pure subroutine find_first_root(a, from, to, found, d)
      real(wp), intent(in)  :: a(3), from, to
      logical, intent(out)  :: found
      real(wp), intent(out) :: d
      real(wp) :: discriminant, q, roots(2), sense
      logical  :: inside(2)

      d = from
      found = a(1) + from*(2.0_wp*a(2) + from*3.0_wp*a(3)) <= 0.0_wp
      if (found) return
      discriminant = a(2)**2 - 3.0_wp*a(3)*a(1)
      if (discriminant < 0.0_wp) return
      q = -(a(2) + sign(sqrt(discriminant), a(2)))
      roots = from
      if (abs(q) > 0.0_wp) then                ! the two roots q/(3 a3) and a1/q, without cancellation
         roots(1) = a(1)/q
         if (abs(a(3)) > tiny(q)) roots(2) = q/(3.0_wp*a(3))
      end if
      sense = sign(1.0_wp, to - from)
      inside = (roots - from)*sense > 0.0_wp .and. (roots - to)*sense <= 0.0_wp
      found = any(inside)
      if (found) d = roots(minloc(abs(roots - from), 1, inside))
   end subroutine find_first_root

end module slope_check
