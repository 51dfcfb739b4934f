!> The normal law of the joint, and NORM: how the increments meet it (Fig. 6b).
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
   implicit none
   private

   public :: norm, is_virgin, follow_normal, branch_name
   public :: loading_pressure, normal_secant, normal_tangent, line_pressure, stored_work

   integer, parameter, public :: branch_load = 1, branch_unload = 2, branch_open = 3, branch_reload = 4

   real(wp), parameter, public :: pressure_floor = 1.0e-6_wp !! of p_av: the least p that a loading element has
   real(wp), parameter :: rounding = 1.0e-10_wp              ! of its force, or of p_av a_i: a change below is none

   type, public :: normal_law
      real(wp) :: c   = 0.0_wp     !! [length/pressure^m], > 0
      real(wp) :: m   = 0.0_wp     !! [-], 0 < m <= 1
      real(wp) :: e_u = 0.0_wp     !! E_u, slope dp/dlambda of unloading [pressure/length], > 0
   end type normal_law

   !> State of one interface element in its normal direction.
   type, public :: normal_state
      integer  :: branch   = branch_load
      real(wp) :: p_av     = 0.0_wp  !! mean pressure of the joint in the first increment [pressure], > 0
      real(wp) :: sigmaf   = 0.0_wp  !! sum of the incremental normal forces before the last increment [force]
      real(wp) :: sumf     = 0.0_wp  !! the same after it, compression positive [force]
      real(wp) :: lambda   = 0.0_wp  !! closing deflection [length]
      real(wp) :: lambda_before = 0.0_wp
      real(wp) :: k_n      = 0.0_wp  !! stiffness of the last increment [force/length]
      real(wp) :: pressure = 0.0_wp  !! p after the last increment [pressure]
      real(wp) :: lambda_a = 0.0_wp, p_a = 0.0_wp !! point A, where the last unloading left the loading curve
      real(wp) :: lambda_b = 0.0_wp  !! point B, deflection at which the element opened, its permanent set
   end type normal_state

contains

   !> Normal stiffness of one interface element for the next increment, from what the last one did to it.
   !! Source: Edelugo, section 4.1-4.2, Fig. 6(b), Eqs. (9), (10), (11). Called once before the first increment, and
   !! after each increment once its forces and deflections are accumulated. The first increment is the element's own: the first
   !! that reaches it.
   pure subroutine norm(law, area, eq10, state, k_n)
      type(normal_law), intent(in)      :: law
      real(wp), intent(in)              :: area  !! area of influence a_i, > 0 [length^2]
      logical, intent(in)               :: eq10  !! p on the loading curve by Eq. (10) as printed, not SUMF/a_i
      type(normal_state), intent(inout) :: state !! accumulated; its branch and points A, B are brought up to date
      real(wp), intent(out)             :: k_n   !! [force/length]
      logical :: was_loading

      if (is_virgin(area, state)) then
         state%pressure = state%sumf/area
         k_n = normal_secant(law, area, state%p_av)
         return
      end if
      was_loading = state%branch == branch_load
      call ask_diamonds(area, state)
      state%pressure = state%sumf/area
      if (eq10 .and. was_loading .and. state%branch == branch_load) state%pressure = state%k_n*state%lambda/area
      select case (state%branch)
      case (branch_load)
         k_n = normal_tangent(law, area, state%pressure, state%p_av)
      case (branch_open)
         k_n = 0.0_wp
      case default
         k_n = law%e_u*area
      end select
   end subroutine norm


   !> The diamonds of Fig. 6(b): the branch that the element is on for the next increment, with point A where it leaves the loading
   !! curve and point B where it opens. A removed element carries nothing; the tension that it had is left unbalanced.
   pure subroutine ask_diamonds(area, state)
      real(wp), intent(in)              :: area
      type(normal_state), intent(inout) :: state
      real(wp) :: no_change
      logical  :: rises, falls

      no_change = rounding*max(abs(state%sumf), abs(state%sigmaf), state%p_av*area)
      rises = state%sumf > state%sigmaf + no_change
      falls = state%sumf < state%sigmaf - no_change
      select case (state%branch)
      case (branch_load)
         if (falls) then
            state%lambda_a = state%lambda_before
            state%p_a = state%sigmaf/area
            state%branch = branch_unload
         end if
      case (branch_unload)
         if (state%sumf <= -rounding*max(state%p_a, state%p_av)*area) then
            state%lambda_b = state%lambda
            state%sumf = 0.0_wp
            state%branch = branch_open
         else if (rises) then
            state%branch = branch_reload
         end if
      case (branch_open)
         if (state%lambda >= state%lambda_b) state%branch = branch_reload
      case (branch_reload)
         if (falls) then
            state%branch = branch_unload
         else if (state%lambda >= state%lambda_a) then
            state%branch = branch_load
         end if
      end select
   end subroutine ask_diamonds


   !> Whether the element has not carried anything yet: at first, and until a load reaches it.
   pure logical function is_virgin(area, state)
      real(wp), intent(in)           :: area
      type(normal_state), intent(in) :: state

      is_virgin = state%branch == branch_load .and. &
                  max(abs(state%sumf), abs(state%sigmaf)) <= rounding*state%p_av*area
   end function is_virgin


   !> The exact law over one step, for methods that iterate to equilibrium, from the state BEFORE to the deflection LAMBDA: the
   !! loading curve beyond point A, the line below it, and nothing once that line has come down to zero.
   pure subroutine follow_normal(law, area, before, lambda, after, slope, work)
      type(normal_law), intent(in)    :: law
      real(wp), intent(in)            :: area   !! a_i [length^2]
      type(normal_state), intent(in)  :: before !! in equilibrium; its point A is the farthest point of the loading curve
      real(wp), intent(in)            :: lambda !! [length]
      type(normal_state), intent(out) :: after
      real(wp), intent(out)           :: slope  !! dp/dlambda at LAMBDA [pressure/length]; zero where open
      real(wp), intent(out)           :: work   !! done on the element, integral of p a d lambda [force x length]
      real(wp) :: unloaded

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
      else if (unloaded > 0.0_wp) then
         after%branch = merge(branch_reload, branch_unload, lambda > before%lambda)
         after%pressure = unloaded
         slope = law%e_u
      else
         after%branch = branch_open
         after%pressure = 0.0_wp
         after%lambda_b = before%lambda_a - before%p_a/law%e_u
         slope = 0.0_wp
      end if
      if (abs(lambda - before%lambda) <= 0.0_wp) after%branch = before%branch ! at rest
      after%sumf = after%pressure*area
      work = area*(stored_work(law, after%lambda_a, after%p_a, after%pressure) &
                   - stored_work(law, before%lambda_a, before%p_a, before%pressure))
   end subroutine follow_normal


   !> p of the loading curve at LAMBDA >= 0, Eq. (1) [pressure].
   pure real(wp) function loading_pressure(law, lambda) result(p)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: lambda

      p = (lambda/law%c)**(1.0_wp/law%m)
   end function loading_pressure


   !> Secant of the loading curve from 0 to P, Eq. (9), times AREA [force/length].
   pure real(wp) function normal_secant(law, area, p) result(k_n)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: area, p

      k_n = p**(1.0_wp - law%m)*area/law%c
   end function normal_secant


   !> Tangent of the loading curve at P, Eqs. (11), times AREA [force/length]; it would vanish at p = 0: P counts as no less than
   !! the floor.
   pure real(wp) function normal_tangent(law, area, p, p_av) result(k_n)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: area, p, p_av

      k_n = max(p, pressure_floor*p_av)**(1.0_wp - law%m)*area/(law%m*law%c)
   end function normal_tangent


   !> p at LAMBDA on the line of slope E_u through the point A = (LAMBDA_A, P_A) [pressure]; below zero it is open.
   pure real(wp) function line_pressure(law, lambda_a, p_a, lambda) result(p)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: lambda_a, p_a, lambda

      p = p_a - law%e_u*(lambda_a - lambda)
   end function line_pressure


   !> Integral of p d lambda from rest along the loading curve to A and back along the line to P [pressure x length].
   pure real(wp) function stored_work(law, lambda_a, p_a, p) result(work)
      type(normal_law), intent(in) :: law
      real(wp), intent(in)         :: lambda_a, p_a, p

      work = p_a*lambda_a*law%m/(1.0_wp + law%m) - 0.5_wp*(p_a**2 - p**2)/law%e_u
   end function stored_work


   !> The word for a branch in listing and CSV.
   pure function branch_name(branch) result(name)
      integer, intent(in)       :: branch
      character(:), allocatable :: name
      character(6), parameter   :: names(4) = ['LOAD  ', 'UNLOAD', 'OPEN  ', 'RELOAD']

      name = trim(names(branch))
   end function branch_name

end module normal_stiffness
