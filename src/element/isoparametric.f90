!> Stiffness of the linear isoparametric elements: plane, axisymmetric and solid, with incompatible modes where asked for.
!! Source: Zienkiewicz, Taylor, Zhu, The Finite Element Method, 6th ed., chapters 2, 5 and 6; Taylor, Beresford, Wilson 1976.
module isoparametric
   use elasticity, only: axisymmetric, solid
   use element_kinds, only: max_nodes
   use element_mapping, only: element_law, element_map, map_element, map_point, max_shapes
   use kinds, only: wp
   use quadrature, only: body_rule, integration_rule
   implicit none
   private

   public :: stiffness, condensed_stiffness

   integer, parameter, public :: max_unknowns = 3*max_shapes         !! components of nodes and parameters of modes
   integer, parameter         :: max_pairs = max_shapes*(max_shapes + 1)/2

contains

   !> [k] = integral of [B]^T [D] [B]; with incompatible modes, their parameters condensed.
   pure subroutine stiffness(law, x, k)
      type(element_law), intent(in) :: law
      real(wp), intent(in)          :: x(:, :)   !! corners (dimension, nodes), of positive volume, r >= 0 [length]
      real(wp), intent(inout)       :: k(:, :)   !! (dimension*nodes, dimension*nodes), set here; u_x, u_y (, u_z) of corner 1,
                                                 !! of corner 2, ... [force/length]; 2 pi r of force in an axisymmetric body
      real(wp) :: full(max_unknowns, max_unknowns)
      integer  :: i, j, n, n_all

      call condensed_stiffness(law, x, full, n, n_all)
      do j = 1, n
         do i = 1, j
            k(i, j) = full(i, j)
            k(j, i) = full(i, j)
         end do
      end do
   end subroutine stiffness


   !> The upper triangle of [k], and beyond the unknowns of the nodes the columns from which the parameters of the modes
   !! follow: q(p) = -sum of full(:p-1, p) q(:p-1)/full(p, p), for p from N + 1 to N_ALL in turn.
   pure subroutine condensed_stiffness(law, x, full, n, n_all)
      type(element_law), intent(in) :: law
      real(wp), intent(in)          :: x(:, :)                              !! as in stiffness
      real(wp), intent(inout)       :: full(max_unknowns, max_unknowns)     !! [force/length]
      integer, intent(out)          :: n, n_all                             !! unknowns of the nodes; of nodes and modes
      type(element_map) :: map
      real(wp) :: products(9, max_pairs), factor
      integer  :: i, j, p

      call map_element(law, x, map)
      if (law%state == solid) then
         call integrate_products_3(law, map, products)
         call assemble_solid(law, map%n + map%n_modes, products, full)
         n = 3*map%n
         n_all = n + 3*map%n_modes
      else
         if (law%state == axisymmetric) then
            call integrate_products_3(law, map, products)
            call assemble_axisymmetric(law, map%n, products, full)
         else
            call integrate_products_2(law, map, products)
            call assemble_plane(law, map%n + map%n_modes, products, full)
         end if
         n = 2*map%n
         n_all = n + 2*map%n_modes
      end if
      do p = n_all, n + 1, -1
         do j = 1, p - 1
            factor = full(j, p)/full(p, p)
            do i = 1, j
               full(i, j) = full(i, j) - factor*full(i, p)
            end do
         end do
      end do
   end subroutine condensed_stiffness


   !> Integrals of g_a(i) g_b(j) for all pairs of shape functions i <= j, three components: a runs first, then b.
   pure subroutine integrate_products_3(law, map, products)
      type(element_law), intent(in) :: law
      type(element_map), intent(in) :: map
      real(wp), intent(inout)       :: products(9, max_pairs)               !! pairs (1,1), (1,2), (2,2), (1,3), ... are set
      type(integration_rule) :: rule
      real(wp) :: g(3, max_shapes), volume, w, w1, w2, w3
      integer  :: i, j, k, n, pair

      n = map%n + map%n_modes
      products(:, :n*(n + 1)/2) = 0.0_wp
      call body_rule(law%kind, law%state == axisymmetric, rule)
      do k = 1, rule%n
         call map_point(law, map, rule%point(:, k), g, volume)
         w = rule%weight(k)*volume
         pair = 0
         do j = 1, n
            w1 = w*g(1, j)
            w2 = w*g(2, j)
            w3 = w*g(3, j)
            do i = 1, j
               pair = pair + 1
               products(1, pair) = products(1, pair) + g(1, i)*w1
               products(2, pair) = products(2, pair) + g(2, i)*w1
               products(3, pair) = products(3, pair) + g(3, i)*w1
               products(4, pair) = products(4, pair) + g(1, i)*w2
               products(5, pair) = products(5, pair) + g(2, i)*w2
               products(6, pair) = products(6, pair) + g(3, i)*w2
               products(7, pair) = products(7, pair) + g(1, i)*w3
               products(8, pair) = products(8, pair) + g(2, i)*w3
               products(9, pair) = products(9, pair) + g(3, i)*w3
            end do
         end do
      end do
   end subroutine integrate_products_3


   !> The same with the two components of a plane body.
   pure subroutine integrate_products_2(law, map, products)
      type(element_law), intent(in) :: law
      type(element_map), intent(in) :: map
      real(wp), intent(inout)       :: products(9, max_pairs)               !! four products of every pair are set
      type(integration_rule) :: rule
      real(wp) :: g(3, max_shapes), volume, w, w1, w2
      integer  :: i, j, k, n, pair

      n = map%n + map%n_modes
      products(:4, :n*(n + 1)/2) = 0.0_wp
      call body_rule(law%kind, .false., rule)
      do k = 1, rule%n
         call map_point(law, map, rule%point(:, k), g, volume)
         w = rule%weight(k)*volume
         pair = 0
         do j = 1, n
            w1 = w*g(1, j)
            w2 = w*g(2, j)
            do i = 1, j
               pair = pair + 1
               products(1, pair) = products(1, pair) + g(1, i)*w1
               products(2, pair) = products(2, pair) + g(2, i)*w1
               products(3, pair) = products(3, pair) + g(1, i)*w2
               products(4, pair) = products(4, pair) + g(2, i)*w2
            end do
         end do
      end do
   end subroutine integrate_products_2


   !> [B_i]^T [D] [B_j] for all i <= j, with strains xx = g_x u, yy = g_y v, xy = g_y u + g_x v.
   pure subroutine assemble_plane(law, n, products, full)
      type(element_law), intent(in) :: law
      integer, intent(in)           :: n                                    !! shape functions
      real(wp), intent(in)          :: products(9, max_pairs)
      real(wp), intent(inout)       :: full(max_unknowns, max_unknowns)     !! upper triangle; below it nothing is of use
      integer :: c, i, j, pair, r

      pair = 0
      do j = 1, n
         c = 2*j - 1
         do i = 1, j
            r = 2*i - 1
            pair = pair + 1
            associate (d => law%d, xx => products(1, pair), yx => products(2, pair), xy => products(3, pair), &
                       yy => products(4, pair))
               full(r, c) = d(1, 1)*xx + d(3, 3)*yy
               full(r + 1, c) = d(2, 1)*yx + d(3, 3)*xy
               full(r, c + 1) = d(1, 2)*xy + d(3, 3)*yx
               full(r + 1, c + 1) = d(2, 2)*yy + d(3, 3)*xx
            end associate
         end do
      end do
   end subroutine assemble_plane


   !> The same with strains rr = g_r u, zz = g_z v, theta theta = h u, rz = g_z u + g_r v, where h = N/r.
   pure subroutine assemble_axisymmetric(law, n, products, full)
      type(element_law), intent(in) :: law
      integer, intent(in)           :: n
      real(wp), intent(in)          :: products(9, max_pairs)
      real(wp), intent(inout)       :: full(max_unknowns, max_unknowns)
      integer :: c, i, j, pair, r

      pair = 0
      do j = 1, n
         c = 2*j - 1
         do i = 1, j
            r = 2*i - 1
            pair = pair + 1
            associate (d => law%d, rr => products(1, pair), zr => products(2, pair), hr => products(3, pair), &
                       rz => products(4, pair), zz => products(5, pair), hz => products(6, pair), &
                       rh => products(7, pair), zh => products(8, pair), hh => products(9, pair))
               full(r, c) = d(1, 1)*rr + d(1, 3)*rh + d(3, 1)*hr + d(3, 3)*hh + d(4, 4)*zz
               full(r + 1, c) = d(2, 1)*zr + d(2, 3)*zh + d(4, 4)*rz
               full(r, c + 1) = d(1, 2)*rz + d(3, 2)*hz + d(4, 4)*zr
               full(r + 1, c + 1) = d(2, 2)*zz + d(4, 4)*rr
            end associate
         end do
      end do
   end subroutine assemble_axisymmetric


   !> The same with strains xx = g_x u, yy = g_y v, zz = g_z w, xy = g_y u + g_x v, yz = g_z v + g_y w, zx = g_x w + g_z u.
   pure subroutine assemble_solid(law, n, products, full)
      type(element_law), intent(in) :: law
      integer, intent(in)           :: n
      real(wp), intent(in)          :: products(9, max_pairs)
      real(wp), intent(inout)       :: full(max_unknowns, max_unknowns)
      integer :: c, i, j, pair, r

      pair = 0
      do j = 1, n
         c = 3*j - 2
         do i = 1, j
            r = 3*i - 2
            pair = pair + 1
            associate (d => law%d, xx => products(1, pair), yx => products(2, pair), zx => products(3, pair), &
                       xy => products(4, pair), yy => products(5, pair), zy => products(6, pair), &
                       xz => products(7, pair), yz => products(8, pair), zz => products(9, pair))
               full(r, c) = d(1, 1)*xx + d(4, 4)*yy + d(6, 6)*zz
               full(r + 1, c) = d(2, 1)*yx + d(4, 4)*xy
               full(r + 2, c) = d(3, 1)*zx + d(6, 6)*xz
               full(r, c + 1) = d(1, 2)*xy + d(4, 4)*yx
               full(r + 1, c + 1) = d(2, 2)*yy + d(4, 4)*xx + d(5, 5)*zz
               full(r + 2, c + 1) = d(3, 2)*zy + d(5, 5)*yz
               full(r, c + 2) = d(1, 3)*xz + d(6, 6)*zx
               full(r + 1, c + 2) = d(2, 3)*yz + d(5, 5)*zy
               full(r + 2, c + 2) = d(3, 3)*zz + d(5, 5)*yy + d(6, 6)*xx
            end associate
         end do
      end do
   end subroutine assemble_solid

end module isoparametric
