# Checks that every run of the sweep is correct or has ended with status 3.
#
#     awk -f sweep_judge.awk LIST STDERR d1.joint.csv d1.stage.csv ...
#
# Exact: every node bears p, lambda = c p^m, and the corner that moves farthest hypot(nu p s/E, lambda + p s/E). Prints the faults,
# then how many runs are correct, and how many ended with status 3.

BEGIN { FS = "[ ,]"; tolerance = 1e-6 }
FILENAME == ARGV[1] { for (i = 2; i <= 7; i++) given[$1, i] = $i; runs++; next }
FILENAME == ARGV[2] {
   if (/^d[0-9]+\.bdf: .*(; no results|; the results end there)$/) { k = $1; gsub(/[^0-9]/, "", k); ended[k] = 1 }
   next
}
FNR == 1 {
   k = FILENAME
   sub(/.*\/d/, "", k)
   sub(/\..*/, "", k)
   p = given[k, 5]
   lambda = given[k, 3] * p ^ given[k, 4]
   shorter = p * given[k, 6] / given[k, 2]
   next
}
FILENAME ~ /\.joint\.csv$/ { rows[k]++; note(k, $14, p); note(k, $13, lambda); next }
{ answers[k]++; note(k, $3, sqrt((given[k, 7] * shorter) ^ 2 + (lambda + shorter) ^ 2)) }

function note(k, value, exact,   off) {
   off = value / exact - 1
   if (off < 0) off = -off
   if (!(off <= error[k])) error[k] = off
}

END {
   for (k = 1; k <= runs; k++) {
      if (k in ended) three++
      else if (rows[k] == 3 && answers[k] == 1 && error[k] <= tolerance) right++
      else printf "FAILED: run %d: E %g, c %g, m %g, p %g, size %g, nu %g: off by %g, %d rows\n", k, given[k, 2], given[k, 3], \
                  given[k, 4], given[k, 5], given[k, 6], given[k, 7], error[k], rows[k]
   }
   print right + 0, three + 0
}
