# The inner and the outer edge of the contact, radii at which the closing deflection is zero, at the last increment of a history in
# the order of the radii; 20 and 60, the edges of the flanges, where they touch up to there. Then the number of open elements and
# the sum of the forces.
BEGIN { FS = "," }
FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
$2 != increment { increment = $2; n = 0; force = 0; open = 0 }
{ n++; x[n] = $(at["x"]); lambda[n] = $(at["lambda"]); force += $(at["force"]); open += $(at["branch"]) == "OPEN" }
END {
   inner = x[1]; outer = x[n]
   for (i = 2; i <= n; i++) {
      if ((lambda[i] > 0) == (lambda[i - 1] > 0)) continue
      edge = x[i - 1] + (x[i] - x[i - 1]) * lambda[i - 1] / (lambda[i - 1] - lambda[i])
      if (lambda[i] > 0) inner = edge; else outer = edge
   }
   printf "%.6f %.6f %d %.17g\n", inner, outer, open, force
}
