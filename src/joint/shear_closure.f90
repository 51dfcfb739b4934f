!> Whether the branches of a shear law close a loop: loaded to d under a constant pressure, unloaded until tau is gone and reloaded
!! to d, how far the stress then is from the one that was left. Cycles under one load creep by what is missing.
module shear_closure
   use branch_cubic, only: cubic_secant, cubic_slope, cubic_value, value_on_way
   use kinds, only: wp
   use polynomial_zeros, only: find_zeros, zero_list
   use shear_stiffness, only: shear_law
   implicit none
   private

   public :: closure_at, worst_closure

   real(wp), parameter, public :: wide_gap = 0.05_wp !! that is warned of

   integer, parameter  :: divisions = 20        ! of the tested range
   real(wp), parameter :: alike = 1.0e-9_wp     ! gaps of loops that rounding alone tells apart: the first counts

   !> The gap of a loop and where it is.
   type, public :: loop_closure
      logical  :: is_known = .false.            !! whether any loop is unloaded to tau = 0 on B
      real(wp) :: share = 0.0_wp                !! |tau of C at d_r - tau_r|/tau_r
      real(wp) :: p = 0.0_wp, d = 0.0_wp        !! [pressure], [length]; D = 0: of the smallest loops
   end type loop_closure

contains

   !> The widest gap over the tested range; without a largest pressure at P_AV, without a largest deflection of the smallest loops.
   pure type(loop_closure) function worst_closure(law, p_av) result(worst)
      type(shear_law), intent(in) :: law
      real(wp), intent(in)        :: p_av !! [pressure]
      type(loop_closure) :: here
      real(wp) :: p, d
      integer  :: i, k

      do i = 1, divisions
         p = p_av
         if (law%p_max < huge(1.0_wp)) p = law%p_max*i/divisions
         do k = 1, divisions
            d = 0.0_wp
            if (law%d_max < huge(1.0_wp)) d = law%d_max*k/divisions
            here = closure_at(law, p, d)
            if (.not. here%is_known) cycle
            if (.not. worst%is_known .or. here%share > worst%share + alike) worst = here
         end do
      end do
   end function worst_closure

   !> The gap of the loop to D under the pressure P; of the smallest loops, D = 0, it is that of the first slopes: |c_1/b_1 - 1|.
   pure type(loop_closure) function closure_at(law, p, d) result(closure)
      type(shear_law), intent(in) :: law
      real(wp), intent(in)        :: p    !! [pressure]
      real(wp), intent(in)        :: d    !! [length]
      type(zero_list) :: zeros
      real(wp) :: stress, unloading(0:4), slopes(2)

      closure%p = p
      closure%d = d
      if (d <= 0.0_wp) then
         slopes = [cubic_slope(law%unload, 0.0_wp, p), cubic_slope(law%reload, 0.0_wp, p)]
         closure%is_known = slopes(1) > 0.0_wp
         if (closure%is_known) closure%share = abs(slopes(2)/slopes(1) - 1.0_wp)
         return
      end if
      stress = d*cubic_secant(law%load, d, p)
      if (stress <= 0.0_wp) return
      unloading = value_on_way(law%unload, [d, -d], [p, 0.0_wp]) ! over f, d falling from d to -d
      unloading(0) = stress
      call find_zeros(unloading, 0.0_wp, 2.0_wp, zeros)
      closure%is_known = zeros%n > 0
      if (closure%is_known) closure%share = abs((cubic_value(law%reload, d, p) &
                                                 - cubic_value(law%reload, d*(1.0_wp - zeros%x(1)), p))/stress - 1.0_wp)
   end function closure_at

end module shear_closure
