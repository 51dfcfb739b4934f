!> The normal law of the joint, and NORM: the normal stiffness of the next increment (Fig. 6b).
!!
!!     p |                                              *
!!       |                                            *               LOAD    *  from 0 along lambda = c p**m, Eq. (1), through A on
!!   p_A |. . . . . . . . . . . . . . . . . . . . . A
!!       |                                        */.                 UNLOAD  /  from A, where the force fell, down AB, slope E_u
!!       |                                     *  / .
!!       |                                  *    /  .                 OPEN    -  from B, where the force has come to zero: removed,
!!       |                               *      /   .                            p = 0; lambda_B is the permanent set
!!       |                            *        /    .
!!       |                        *           /     .                 RELOAD  /  up BA, from where the force grew again or, after
!!       |                    *              /      .                            OPEN, from B, where the element is reintroduced;
!!       |             *                    /       .                            UNLOAD where it falls again, LOAD from A on
!!     0 *---------------------------------B--------+------
!!       0                             lambda_B  lambda_A   lambda
module normal_stiffness
   use kinds, only: wp
   use normal_curve, only: curve_work, loading_deflection, loading_pressure, normal_law, normal_secant, normal_tangent
   use tolerances, only: rounding_of_a_change
   implicit none
   private

   public :: at_rest, norm, is_virgin, pressure_reached, follow_normal, closed_share, branch_name, has_come_to
   public :: line_pressure, stored_work, law_deflection, force_reached

   integer, parameter, public :: branch_load = 1, branch_unload = 2, branch_open = 3, branch_reload = 4

   !> State of one interface element in its normal direction.
   type, public :: normal_state
      integer  :: branch   = branch_load
      real(wp) :: p_av     = 0.0_wp  !! mean pressure of the joint in the first increment [pressure], > 0
      real(wp) :: sigmaf   = 0.0_wp  !! sum of the incremental normal forces before the last increment [force]
      real(wp) :: sumf     = 0.0_wp  !! the same after it, compression positive [force]
      real(wp) :: gap      = 0.0_wp  !! g, the closing of the ends at which the faces touch; negative: interference [length]
      real(wp) :: lambda   = 0.0_wp  !! closing deflection of the joint: closing of the ends - gap [length]
      real(wp) :: lambda_before = 0.0_wp
      real(wp) :: k_n      = 0.0_wp  !! stiffness of the last increment [force/length]
      real(wp) :: pressure = 0.0_wp  !! p after the last increment [pressure]
      real(wp) :: lambda_a = 0.0_wp, p_a = 0.0_wp !! point A, where the last unloading left the loading curve
      real(wp) :: lambda_b = 0.0_wp  !! point B, deflection at which the element opened, its permanent set
   end type normal_state

contains

   !> The state of an element at rest that has never been pressed. An element with a gap is open. Its points A and B are at the
   !! origin: after closing it follows the loading curve from there.
   elemental type(normal_state) function at_rest(p_av, gap) result(state)
      real(wp), intent(in) :: p_av   !! [pressure], > 0
      real(wp), intent(in) :: gap    !! [length]

      state%p_av = p_av
      state%gap = gap
      state%lambda = 0.0_wp - gap ! no -0.0
      if (gap > 0.0_wp) state%branch = branch_open
   end function at_rest

   !> Normal stiffness of one interface element for the next increment, from what the last one did to it.
   !! Source: Edelugo, section 4.1-4.2, Fig. 6(b), Eqs. (9), (10), (11). Called once before the first increment, and after each
   !! increment once its forces and deflections are accumulated. The first increment of an element is the first in which a force
   !! acts on it.
   pure subroutine norm(law, area, eq10, state, k_n)
      type(normal_law), intent(in)      :: law
      real(wp), intent(in)              :: area  !! area of influence a_i, > 0 [length^2]
      logical, intent(in)               :: eq10  !! p on the loading curve by Eq. (10) as printed, not SUMF/a_i
      type(normal_state), intent(inout) :: state !! accumulated; its branch and points A and B are updated
      real(wp), intent(out)             :: k_n   !! [force/length]

      state%pressure = pressure_reached(area, eq10, state)
      if (.not. is_virgin(area, state)) call ask_diamonds(area, state)
      if (state%branch == branch_open) state%pressure = 0.0_wp
      state%sumf = max(0.0_wp, state%sumf) ! below zero by rounding: the diamonds remove what is below it by more
      state%pressure = max(0.0_wp, state%pressure)
      select case (state%branch)
      case (branch_load)
         if (.not. is_virgin(area, state)) then
            k_n = normal_tangent(law, area, state%pressure, state%p_av)
         else if (state%lambda_a > 0.0_wp .and. state%lambda > 0.0_wp) then ! it has closed past A
            k_n = normal_tangent(law, area, loading_pressure(law, state%lambda), state%p_av)
         else
            k_n = normal_secant(law, area, state%p_av)
         end if
      case (branch_open)
         k_n = 0.0_wp
      case default
         k_n = law%e_u*area
      end select
   end subroutine norm

   !> p after the last increment: SUMF/a_i, or on the loading curve that of Eq. (10) [pressure].
   pure real(wp) function pressure_reached(area, eq10, state) result(p)
      real(wp), intent(in)           :: area
      logical, intent(in)            :: eq10
      type(normal_state), intent(in) :: state

      p = state%sumf/area
      if (.not. eq10 .or. state%branch /= branch_load .or. is_virgin(area, state) .or. force_falls(area, state)) return
      p = state%k_n*state%lambda/area
   end function pressure_reached

   !> The diamonds of Fig. 6(b), applied in order to the state after the increment: the branch of the element for the next
   !! increment. Point A is set where the element leaves the loading curve, point B where it opens. A removed element carries no
   !! force; its former tension is left unbalanced. Hence no element enters an increment with tension. As in the exact law, an
   !! element is removed only where its force is below zero by more than rounding, whose sign therefore does not matter.
   pure subroutine ask_diamonds(area, state)
      real(wp), intent(in)              :: area
      type(normal_state), intent(inout) :: state
      logical :: was_open

      was_open = state%branch == branch_open
      select case (state%branch)
      case (branch_load)
         if (force_falls(area, state)) then
            state%lambda_a = state%lambda_before
            state%p_a = state%sigmaf/area
            state%branch = branch_unload
         end if
      case (branch_reload)
         if (force_falls(area, state)) state%branch = branch_unload
      case (branch_unload)
         if (state%sumf > state%sigmaf + no_change(area, state)) state%branch = branch_reload
      end select
      if (state%branch == branch_unload .and. state%sumf <= -no_pressure(state)*area) then
         state%lambda_b = state%lambda
         state%sumf = 0.0_wp
         state%branch = branch_open
      end if
      if (was_open .and. has_come_to(state%lambda_b, state%lambda, size_of(state))) state%branch = branch_reload
      if (state%branch == branch_reload .and. has_come_to(state%lambda_a, state%lambda, size_of(state))) state%branch = branch_load
   end subroutine ask_diamonds

   !> Whether the last increment was tensile.
   pure logical function force_falls(area, state)
      real(wp), intent(in)           :: area
      type(normal_state), intent(in) :: state

      force_falls = state%sumf < state%sigmaf - no_change(area, state)
   end function force_falls

   !> The largest change of the force of STATE that counts as rounding [force].
   pure real(wp) function no_change(area, state)
      real(wp), intent(in)           :: area
      type(normal_state), intent(in) :: state

      no_change = rounding_of_a_change*max(abs(state%sumf), abs(state%sigmaf), state%p_av*area)
   end function no_change

   !> Whether the deflection LAMBDA has reached POINT, apart from the rounding of deflections of this SIZE.
   elemental logical function has_come_to(point, lambda, size)
      real(wp), intent(in) :: point, lambda, size !! [length]

      has_come_to = lambda >= point - rounding_of_a_change*size
   end function has_come_to

   !> The largest pressure of STATE that counts as rounding.
   elemental real(wp) function no_pressure(state)
      type(normal_state), intent(in) :: state

      no_pressure = rounding_of_a_change*max(state%p_a, state%p_av)
   end function no_pressure

   !> The largest deflection so far in STATE, as far as known [length].
   elemental real(wp) function size_of(state)
      type(normal_state), intent(in) :: state

      size_of = max(abs(state%lambda_a), abs(state%lambda_b), abs(state%gap))
   end function size_of

   !> Whether an element on its loading curve is unloaded: initially, until a load reaches it, and where it closes past A.
   pure logical function is_virgin(area, state)
      real(wp), intent(in)           :: area
      type(normal_state), intent(in) :: state

      is_virgin = state%branch == branch_load .and. max(abs(state%sumf), abs(state%sigmaf)) <= rounding_of_a_change*state%p_av*area
   end function is_virgin

   !> The exact law over one step, for methods that iterate to equilibrium, from the state BEFORE to the deflection LAMBDA: the
   !! loading curve beyond point A, the line below it, and zero pressure where that line falls below zero. A point within
   !! rounding of A is on the loading curve. A movement within rounding keeps the branch.
   pure subroutine follow_normal(law, area, before, lambda, after, slope, work)
      type(normal_law), intent(in)    :: law
      real(wp), intent(in)            :: area   !! a_i [length^2]
      type(normal_state), intent(in)  :: before !! in equilibrium; its point A is the farthest point of the loading curve
      real(wp), intent(in)            :: lambda !! [length]
      type(normal_state), intent(out) :: after
      real(wp), intent(out)           :: slope  !! dp/dlambda at LAMBDA [pressure/length]; zero where open
      real(wp), intent(out)           :: work   !! done on the element, integral of p a d lambda [force x length]
      real(wp) :: least, unloaded

      least = rounding_of_a_change*max(abs(before%lambda_a), loading_deflection(law, before%p_av))
      after = before
      after%lambda_before = before%lambda
      after%sigmaf = before%sumf
      after%lambda = lambda
      unloaded = line_pressure(law, before%lambda_a, before%p_a, lambda)
      if (lambda >= before%lambda_a .and. lambda > 0.0_wp) then
         after%branch = branch_load
         after%pressure = loading_pressure(law, lambda)
         after%lambda_a = lambda
         after%p_a = after%pressure
         slope = normal_tangent(law, 1.0_wp, after%pressure, before%p_av)
         after%k_n = slope*area
      else if (unloaded > merge(-no_pressure(before), 0.0_wp, before%p_a > 0.0_wp)) then
         if (lambda >= before%lambda_a - least) then
            after%branch = branch_load
         else if (lambda > before%lambda + least .or. before%branch == branch_open) then
            after%branch = branch_reload
         else if (lambda < before%lambda - least .or. before%branch == branch_load) then
            after%branch = branch_unload
         end if
         after%pressure = max(0.0_wp, unloaded)
         slope = law%e_u
         after%k_n = slope*area
         if (after%branch == branch_load) after%k_n = normal_tangent(law, area, after%pressure, before%p_av)
      else
         after%branch = branch_open
         after%pressure = 0.0_wp
         after%lambda_b = before%lambda_a - before%p_a/law%e_u
         slope = 0.0_wp
         after%k_n = 0.0_wp
         if (abs(lambda - before%lambda) <= least .and. before%sumf <= 0.0_wp) after%branch = before%branch ! at rest
      end if
      after%sumf = after%pressure*area
      work = area*(stored_work(law, after%lambda_a, after%p_a, after%pressure) &
                   - stored_work(law, before%lambda_a, before%p_a, before%pressure))
   end subroutine follow_normal

   !> Share of the last change of lambda in which a formerly open element was closed: the part beyond point B [-].
   pure real(wp) function closed_share(state) result(share)
      type(normal_state), intent(in) :: state

      share = min(1.0_wp, max(0.0_wp, (state%lambda - state%lambda_b)/max(state%lambda - state%lambda_before, tiny(1.0_wp))))
   end function closed_share

   !> p at LAMBDA on the line of slope E_u through the point A = (LAMBDA_A, P_A) [pressure]; below zero the element is open.
   pure real(wp) function line_pressure(law, lambda_a, p_a, lambda) result(p)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: lambda_a, p_a, lambda

      p = p_a - law%e_u*(lambda_a - lambda)
   end function line_pressure

   !> The deflection at which the exact law of STATE has the pressure P on its present branch: B_i of Fig. 3 [length].
   pure real(wp) function law_deflection(law, state, p) result(lambda)
      type(normal_law), intent(in)   :: law
      type(normal_state), intent(in) :: state !! exact, as follow_normal leaves it
      real(wp), intent(in)           :: p     !! >= 0 [pressure]

      if (state%branch == branch_load .or. p > state%p_a) then
         lambda = loading_deflection(law, p)
      else
         lambda = state%lambda_a - (state%p_a - p)/law%e_u
      end if
   end function law_deflection

   !> SUMF after the last increment of STEP, before NORM sets it to zero for a removed element [force].
   elemental real(wp) function force_reached(state) result(force)
      type(normal_state), intent(in) :: state

      force = state%sigmaf + state%k_n*(state%lambda - state%lambda_before)
   end function force_reached

   !> Integral of p d lambda from rest along the loading curve to A and back along the line to P [pressure x length].
   pure real(wp) function stored_work(law, lambda_a, p_a, p) result(work)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: lambda_a, p_a, p

      work = curve_work(law, lambda_a, p_a) - 0.5_wp*(p_a**2 - p**2)/law%e_u
   end function stored_work

   !> The word for a branch in listing and CSV.
   pure function branch_name(branch) result(name)
      integer, intent(in)       :: branch
      character(:), allocatable :: name
      character(6), parameter   :: names(4) = ['LOAD  ', 'UNLOAD', 'OPEN  ', 'RELOAD']

      name = trim(names(branch))
   end function branch_name

end module normal_stiffness
