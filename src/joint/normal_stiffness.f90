!> NORM: the normal law of the joint, as the increments meet it (Fig. 6b).
module normal_stiffness
   use kinds, only: wp
   implicit none
   private

   public :: norm, branch_name, is_virgin

   integer, parameter, public :: branch_load = 1, branch_unload = 2, branch_open = 3, branch_reload = 4

   real(wp), parameter, public :: pressure_floor = 1.0e-6_wp !! of p_av: the least p that a loading element has
   real(wp), parameter :: rounding = 1.0e-10_wp              ! of its force, or of p_av a_i: a change below is none

   !> The normal law of one joint: lambda = c p^m (Eq. 1) and what goes with it.
   type, public :: normal_law
      real(wp) :: c    = 0.0_wp    !! [length/pressure^m], > 0
      real(wp) :: m    = 0.0_wp    !! [-], 0 < m <= 1
      real(wp) :: e_u  = 0.0_wp    !! E_u, slope dp/dlambda of unloading [pressure/length], > 0
      real(wp) :: p_av = 0.0_wp    !! pressure of the first increment [pressure], > 0
      logical  :: eq10 = .false.   !! p by Eq. (10) as printed instead of SUMF/a_i
   end type normal_law

   !> State of one interface element in its normal direction.
   type, public :: normal_state
      integer  :: branch   = branch_load
      real(wp) :: sigmaf   = 0.0_wp  !! sum of the incremental normal forces before the last increment [force]
      real(wp) :: sumf     = 0.0_wp  !! the same after it, compression positive [force]
      real(wp) :: lambda   = 0.0_wp  !! closing deflection [length]
      real(wp) :: lambda_before = 0.0_wp
      real(wp) :: k_n      = 0.0_wp  !! stiffness of the last increment [force/length]
      real(wp) :: pressure = 0.0_wp  !! p after the last increment [pressure]
      real(wp) :: lambda_a = 0.0_wp, p_a = 0.0_wp !! point A, where the last unloading left the loading curve
      real(wp) :: lambda_b = 0.0_wp  !! deflection at which the element opened, its permanent set
      real(wp) :: removed  = 0.0_wp  !! force left unbalanced by its removal in the last increment, <= 0 [force]
   end type normal_state

contains

   !> Normal stiffness of one interface element for the next increment, from what the last one did to it.
   !! Source: Edelugo, section 4.1-4.2, Fig. 6(b), Eqs. (9), (10), (11). Called once before the first increment, and
   !! after each increment once its forces and deflections are accumulated. The first increment is the element's own: the first
   !! that reaches it.
   pure subroutine norm(law, area, state, k_n)
      type(normal_law), intent(in)      :: law
      real(wp), intent(in)              :: area  !! area of influence a_i, > 0 [length^2]
      type(normal_state), intent(inout) :: state !! accumulated; its branch and points A, B are brought up to date
      real(wp), intent(out)             :: k_n   !! [force/length]
      real(wp) :: no_change
      logical  :: rises, falls

      if (is_virgin(law, area, state)) then                         ! Eq. (9): secant at the mean pressure
         state%pressure = state%sumf/area
         k_n = law%p_av**(1.0_wp - law%m)*area/law%c
         return
      end if
      no_change = rounding*max(abs(state%sumf), abs(state%sigmaf), law%p_av*area)
      rises = state%sumf > state%sigmaf + no_change
      falls = state%sumf < state%sigmaf - no_change
      state%removed = 0.0_wp
      state%pressure = state%sumf/area

      select case (state%branch)
      case (branch_load)
         if (falls) then
            state%lambda_a = state%lambda_before
            state%p_a = state%sigmaf/area
            state%branch = branch_unload
         else if (law%eq10) then                                    ! Eq. (10) as printed
            state%pressure = state%k_n*state%lambda/area
         end if
      case (branch_unload)
         if (state%sumf <= -rounding*max(state%p_a, law%p_av)*area) then
            call open_element(state)
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

      select case (state%branch)
      case (branch_load)                                            ! Eqs. (11)
         k_n = max(state%pressure, pressure_floor*law%p_av)**(1.0_wp - law%m)*area/(law%m*law%c)
      case (branch_unload, branch_reload)
         k_n = law%e_u*area
      case default
         k_n = 0.0_wp
      end select
   end subroutine norm


   !> Whether the element has not carried anything yet: at first, and until a load reaches it.
   pure logical function is_virgin(law, area, state)
      type(normal_law), intent(in)   :: law
      real(wp), intent(in)           :: area
      type(normal_state), intent(in) :: state

      is_virgin = state%branch == branch_load .and. &
                  max(abs(state%sumf), abs(state%sigmaf)) <= rounding*law%p_av*area
   end function is_virgin


   !> Remove an element: it stands at its point B and carries nothing. The tension it had is left unbalanced.
   pure subroutine open_element(state)
      type(normal_state), intent(inout) :: state

      state%branch = branch_open
      state%lambda_b = state%lambda
      state%removed = state%sumf
      state%sumf = 0.0_wp
      state%pressure = 0.0_wp
   end subroutine open_element


   !> The word for a branch in listing and CSV.
   pure function branch_name(branch) result(name)
      integer, intent(in)       :: branch
      character(:), allocatable :: name

      select case (branch)
      case (branch_load);   name = 'LOAD'
      case (branch_unload); name = 'UNLOAD'
      case (branch_open);   name = 'OPEN'
      case default;         name = 'RELOAD'
      end select
   end function branch_name

end module normal_stiffness
