!> The slope E_u of the lines on which a joint is unloaded and reloaded, from the loops of a normal test.
module loop_fit
   use data_columns, only: fit_load
   use kinds, only: wp
   implicit none
   private

   public :: fit_loops

   !> One way down or up, lambda = LAMBDA + (p - P)/E_U about the middle of its points.
   type, public :: loop_line
      integer  :: branch = 0, n_points = 0
      real(wp) :: p_low = 0.0_wp, p_high = 0.0_wp !! [pressure]
      real(wp) :: lambda = 0.0_wp, p = 0.0_wp     !! means of its points [length], [pressure]
      real(wp) :: set = 0.0_wp                    !! lambda at p = 0 [length]
      real(wp) :: e_u = 0.0_wp                    !! [pressure/length], 0: no rising line
   end type loop_line

   type, public :: loop_fit_type
      type(loop_line), allocatable :: lines(:)
      integer  :: n_points = 0
      real(wp) :: e_u   = 0.0_wp  !! of all lines together [pressure/length], 0: none
      real(wp) :: error = 0.0_wp  !! standard error of E_U, as a share of it
      real(wp) :: rms   = 0.0_wp  !! of lambda about lines of this slope [length]
      integer, allocatable :: line_of(:) !! (points) 0: loading, -1: no line
   end type loop_fit_type

contains

   !> Lay lines of one slope through the runs that are not loading, each at its own height: lambda over p, because the pressure is
   !! what the test sets and the deflection what it reads. Of one run alone its own slope shows how far they scatter.
   subroutine fit_loops(p, lambda, branch, run, joined, fit)
      real(wp), intent(in) :: p(:), lambda(:)    !! (points) [pressure], [length]
      integer, intent(in)  :: branch(:), run(:)  !! (points)
      logical, intent(in)  :: joined(:)          !! (points) the point before is the one that the test came from
      type(loop_fit_type), intent(out) :: fit
      integer, allocatable :: points(:)
      type(loop_line) :: line
      real(wp) :: mean(2), sums(3), total(3)     ! of squares: p p, p lambda, lambda lambda about the means
      integer  :: freedom, i, k

      allocate (fit%lines(0))
      fit%line_of = merge(0, -1, branch == fit_load)
      total = 0.0_wp
      do i = 1, size(p)
         if (fit%line_of(i) >= 0) cycle
         points = pack([(k, k = 1, size(p))], run == run(i) .and. branch == branch(i))
         if (joined(i)) points = [i - 1, points]
         mean = [sum(p(points)), sum(lambda(points))]/size(points)
         sums = [sum((p(points) - mean(1))**2), sum((p(points) - mean(1))*(lambda(points) - mean(2))), &
                 sum((lambda(points) - mean(2))**2)]
         if (sums(1) <= 0.0_wp) cycle
         line = loop_line(branch(i), size(points), minval(p(points)), maxval(p(points)), mean(2), mean(1), &
                          mean(2) - mean(1)*sums(2)/sums(1))
         if (sums(2) > 0.0_wp) line%e_u = sums(1)/sums(2)
         fit%lines = [fit%lines, line]
         where (run == run(i) .and. branch == branch(i)) fit%line_of = size(fit%lines)
         total = total + sums
      end do
      if (size(fit%lines) == 0) return
      fit%n_points = sum(fit%lines%n_points)
      if (total(2) <= 0.0_wp) return
      fit%e_u = total(1)/total(2)
      fit%rms = sqrt(max(0.0_wp, total(3) - total(2)/fit%e_u)/fit%n_points)
      freedom = fit%n_points - size(fit%lines) - 1
      if (freedom > 0) fit%error = fit%rms*sqrt(fit%n_points/(freedom*total(1)))*fit%e_u
   end subroutine fit_loops

end module loop_fit
