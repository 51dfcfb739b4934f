# A record of a normal test, 200 points: lambda = 2.5 p^0.5 to p = 2, 4, 6, from each of these along a line of slope 3 down to p = 0
# and up again, and after the last loop to p = 7. A quarter of the points are on loading.
#
#    awk [-v noise=0.01 -v seed=1] -f normal_loops.awk
#
# NOISE is the standard deviation of every reading, relative to the reading.
function normal(  k, sum) {
   for (k = 0; k < 12; k++) { seed = (seed * 16807) % 2147483647; sum += seed / 2147483647 }
   return sum - 6
}
function row(lambda, p) { printf "%.6f; %.6f\n", lambda * (1 + noise * normal()), p * (1 + noise * normal()) }
BEGIN {
   seed = seed * 7919 + 1
   print "lambda [um]; p [MPa]"
   row(0, 0)
   split("2 4 6 7", top)
   for (k = 1; k <= 4; k++) {
      n = k < 4 ? 12 : 16
      for (j = 1; j <= n; j++) { p = from + (top[k] - from) * j / n; row(2.5 * sqrt(p), p) }
      from = top[k]
      for (j = 24; j >= -25 && k < 4; j--) { p = from * (j < 0 ? -j : j) / 25; if (j) row(2.5 * sqrt(from) - (from - p) / 3, p) }
   }
}
