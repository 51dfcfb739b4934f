!> Branches of shear at constant pressure by their definition (method of the loading curve A, unloading B, reloading C), for tests: from
!! turning point to turning point, with scans and bisection in place of polynomials in the fraction of a path.
module branch_paths
   use kinds, only: wp
   implicit none
   private

   public :: go, work_of_go

   integer, parameter :: load = 1, unload = 2, reload = 3, cells = 400
   real(wp), parameter :: touching = 1.0e-10_wp ! of stresses of about 50

   !> A, B, C at one pressure.
   type, public :: path_law
      real(wp) :: a(3) = 0.0_wp, returning(3, 2:3) = 0.0_wp
      logical  :: from_branch = .false.
   end type path_law

   type, public :: path_state
      integer  :: branch = load
      real(wp) :: s = 1.0_wp, d = 0.0_wp, tau = 0.0_wp ! sense, movement, stress
      real(wp) :: d_r = 0.0_wp, o = 0.0_wp, start = 0.0_wp
   end type path_state

contains

   pure real(wp) function value(c, x)
      real(wp), intent(in) :: c(3), x

      value = c(1)*x + c(2)*x**2 + c(3)*x**3
   end function value

   pure real(wp) function slope(c, x)
      real(wp), intent(in) :: c(3), x

      slope = c(1) + 2.0_wp*c(2)*x + 3.0_wp*c(3)*x**2
   end function slope

   !> Move STATE to TARGET.
   subroutine go(law, state, target)
      type(path_law), intent(in)      :: law
      type(path_state), intent(inout) :: state
      real(wp), intent(in)            :: target
      real(wp) :: from, g, low, high, middle, tau_from, to, x
      integer  :: i

      if (state%s*(target - state%d) < 0.0_wp .neqv. state%branch == unload) then ! turned, or loading and reloading on
         if (state%branch == load .and. state%s*(target - state%d) < 0.0_wp) state%d_r = state%s*state%d
         if (state%branch == unload) then
            state%branch = reload
            state%start = state%d
         else if (state%s*(target - state%d) < 0.0_wp) then
            state%branch = unload
            state%start = state%d
         end if
      end if
      if (state%branch /= load) then
         g = merge(-state%s, state%s, state%branch == unload)
         from = g*state%d
         tau_from = g*state%tau
         to = min(g*target, state%d_r)
         if (from < to) then
            x = from                              ! up to d_r: the first crossing of the loading curve beyond its beginning
            do i = 0, cells
               low = x
               x = max(from, 0.0_wp) + (to - max(from, 0.0_wp))*i/cells
               if (to < 0.0_wp) exit
               if (i == 0 .or. (excess(x) > 0.0_wp .eqv. excess(low) > 0.0_wp)) cycle
               high = x
               do while (high - low > 2.0_wp*spacing(high))
                  middle = 0.5_wp*(low + high)
                  if (excess(middle) > 0.0_wp .eqv. excess(low) > 0.0_wp) low = middle
                  if (excess(middle) > 0.0_wp .neqv. excess(low) > 0.0_wp) high = middle
               end do
               call join(high)
               exit
            end do
         end if
         if (state%branch /= load .and. g*target <= state%d_r) then
            state%tau = g*stress(g*target)
         else if (state%branch /= load) then      ! past d_r
            low = max(from, state%d_r)
            if (abs(excess(low)) <= touching) then
               call join(low)
            else if (excess(low) > 0.0_wp) then
               state%tau = g*stress(low)
               state%o = state%o + excess(low)
               call join(low)
            else
               tau_from = stress(low)
               from = low
               high = g*target
               if (excess_past(high) > 0.0_wp) then
                  do while (high - low > 2.0_wp*spacing(high))
                     middle = 0.5_wp*(low + high)
                     if (excess_past(middle) > 0.0_wp) high = middle
                     if (excess_past(middle) <= 0.0_wp) low = middle
                  end do
                  call join(high)
               else
                  state%tau = g*(tau_from + steeper(high))
               end if
            end if
         end if
      end if
      if (state%branch == load) state%tau = state%s*(value(law%a, state%s*target) + state%o)
      state%d = target

   contains

      !> Argument of the branch where the movement is X in the sense gone to.
      pure real(wp) function argument(x)
         real(wp), intent(in) :: x

         argument = x*g*state%s
         if (law%from_branch) argument = x - g*state%start
      end function argument

      !> Stress on the branch in the sense gone to.
      pure real(wp) function stress(x)
         real(wp), intent(in) :: x
         real(wp) :: turned

         turned = merge(1.0_wp, g*state%s, law%from_branch)
         stress = tau_from + turned*(value(law%returning(:, state%branch), argument(x)) - value(law%returning(:, state%branch), argument(from)))
      end function stress

      pure real(wp) function excess(x)
         real(wp), intent(in) :: x

         excess = stress(x) - value(law%a, x) - state%o
      end function excess

      !> Integral of the steeper slope from FROM to X: three Gauss points between the places where the two slopes are equal.
      pure real(wp) function steeper(x) result(gain)
         real(wp), intent(in) :: x
         real(wp) :: ends(4), c(0:2), root, b(3), t
         real(wp), parameter :: gauss(2) = [-1.0_wp, 1.0_wp]/sqrt(3.0_wp)
         integer  :: i, k

         b = law%returning(:, state%branch)
         t = argument(from) - from
         if (.not. law%from_branch) t = 0.0_wp
         if (.not. law%from_branch) b(2) = b(2)*g*state%s
         c = [slope(b, t) - law%a(1), 2.0_wp*b(2) + 6.0_wp*b(3)*t - 2.0_wp*law%a(2), 3.0_wp*(b(3) - law%a(3))]
         ends = [from, x, x, x]
         root = c(1)**2 - 4.0_wp*c(2)*c(0)
         if (root > 0.0_wp .and. abs(c(2)) > 0.0_wp) ends(2:3) = ((-c(1) + sqrt(root)*[-1, 1]*sign(1.0_wp, c(2)))/(2.0_wp*c(2)))
         if (.not. abs(c(2)) > 0.0_wp .and. abs(c(1)) > 0.0_wp) ends(2) = -c(0)/c(1)
         ends(2:3) = max(from, min(x, ends(2:3)))
         if (ends(3) < ends(2)) ends(2:3) = ends([3, 2])
         gain = 0.0_wp
         do i = 1, 3
            do k = 1, 2
               root = 0.5_wp*(ends(i) + ends(i + 1) + gauss(k)*(ends(i + 1) - ends(i)))
               gain = gain + 0.5_wp*(ends(i + 1) - ends(i))*max(slope(law%a, root), slope(b, root + t))
            end do
         end do
      end function steeper

      pure real(wp) function excess_past(x)
         real(wp), intent(in) :: x

         excess_past = tau_from + steeper(x) - value(law%a, x) - state%o
      end function excess_past

      subroutine join(x)
         real(wp), intent(in) :: x

         state%branch = load
         state%s = g
         state%d = g*x
      end subroutine join

   end subroutine go

   !> Work of a movement of STATE to TARGET, of many small ones by Simpson's rule.
   real(wp) function work_of_go(law, state, target) result(work)
      type(path_law), intent(in)   :: law
      type(path_state), intent(in) :: state
      real(wp), intent(in)         :: target
      type(path_state) :: now
      real(wp) :: tau(3)
      integer  :: i
      integer, parameter :: n = 400

      now = state
      work = 0.0_wp
      do i = 1, n
         tau(1) = now%tau
         call go(law, now, state%d + (target - state%d)*(i - 0.5_wp)/n)
         tau(2) = now%tau
         call go(law, now, state%d + (target - state%d)*i/n)
         tau(3) = now%tau
         work = work + (tau(1) + 4.0_wp*tau(2) + tau(3))/6.0_wp*(target - state%d)/n
      end do
   end function work_of_go

end module branch_paths
