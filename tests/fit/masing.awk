# A shear test of growing amplitude by Masing's rule, at each of p = 0.25, 0.5, 1: loaded to 0.003, 0.006, 0.009, 0.012 by the loading curve A;
# from each of these a cycle on curves twice as large, A moved and doubled, back to the load zero or to the mirror; N points a way.
#
#    awk -v form=FORM [-v n=12] [-v noise=0] [-v most=4] [-v steeper=0] -f masing.awk
#
# FORM: zero, full (records d tau p), words (zero with the names of the branches). NOISE: uniform, of tau. MOST: number of amplitudes.
# STEEPER: reloading is steeper by this share, and ends at 0.9 of the way.
function A(d) { return (50 + 40 * p) * d - (1500 + 1000 * p) * d^2 + (2e4 + 2e4 * p) * d^3 }
function row(d, tau, branch) {
   seed = (seed * 16807 + 11) % 2147483647
   printf "%.17g %.17g %g%s\n", d, tau + noise * (2 * seed / 2147483647 - 1), p, form == "words" ? " " branch : ""
}
BEGIN {
   if (!n) n = 12
   if (!most) most = 4
   print "d tau p" (form == "words" ? " branch" : "")
   split("0.25 0.5 1", pressures, " ")
   for (i = 1; i <= 3; i++) {
      p = pressures[i]; from = 0
      row(0, 0, "LOAD")
      for (k = 1; k <= most; k++) {
         top = 0.003 * k
         for (j = 1; j <= n; j++) { d = from + (top - from) * j / n; row(d, A(d), "LOAD") }
         low = -top; high = top
         for (j = 0; j < 100 && form != "full"; j++) { back = (low + high) / 2; if (A(top) - 2 * A((top - back) / 2) > 0) high = back; else low = back }
         back = form == "full" ? -top : high
         for (j = 1; j <= n; j++) { d = top + (back - top) * j / n; row(d, A(top) - 2 * A((top - d) / 2), "UNLOAD") }
         tau = A(top) - 2 * A((top - back) / 2)
         for (j = 1; j <= (steeper ? 0.9 : 1) * n; j++) { d = back + (top - back) * j / n; row(d, tau + (1 + steeper) * 2 * A((d - back) / 2), "RELOAD") }
         from = top
      }
   }
}
