# A quarter of the cylinder: nodes 1 and 10001 + 100 i + j, i along the arc from its lowest point, j from the arc to the core
BEGIN {
   n = 44; m = 22; q = 1.06; s = 1.13; pi = atan2(0, -1)
   print "$ written by konter.awk\nGRID,1,,0.0,50.0"
   for (i = 0; i <= n; i++) for (j = 0; j < m; j++) {
      t = pi/2*(q^i - 1)/(q^n - 1); r = 50 - 42*(s^j - 1)/(s^(m - 1) - 1)
      printf "GRID,%d,,%.7g,%.7g\n", 10001 + 100*i + j, r*sin(t), i || j ? 50 - r*cos(t) : 0
   }
   for (i = 0; i < n; i++) {
      for (j = 0; j < m - 1; j++) printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++e, k = 10001 + 100*i + j, k + 100, k + 101, k + 1
      printf "CTRIA3,%d,1,%d,%d,1\n", ++e, k = 10000 + 100*i + m, k + 100
      if (i < 18) printf "CBAR,%d,31,%d,%d\n", ++e, 10001 + 100*i, 10101 + 100*i
   }
   for (j = 0; j < m - 1; j++) { printf "CBAR,%d,14,%d,%d\nCBAR,%d,11,%d,%d\n", ++e, 10001 + 100*n + j, 10002 + 100*n + j, ++e, 10001 + j, 10002 + j }
   printf "CBAR,%d,14,%d,1\nCBAR,%d,11,%d,1\n", ++e, 10000 + 100*n + m, ++e, 10000 + m
}
