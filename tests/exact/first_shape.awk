# The first mode of a row of masses (ring_down.awk), its elements as they stick: inverse iteration, each step solved by Gauss-Seidel.
$1 == "mass" { m[$2] = $3; phi[$2] = 1 }
$1 == "spring" || $1 == "element" { k[$2, $3] += $4; diagonal[$2] += $4; diagonal[$3] += $4 }
END {
   for (step = 0; step < 30; step++) {
      largest = 0
      for (i in m) { f[i] = m[i]*phi[i] }
      for (sweep = 0; sweep < 3000; sweep++)
         for (i in m) {
            s = f[i]
            for (j in m) if (j != i) s += (k[i, j] + k[j, i])*u[j]
            u[i] = s/diagonal[i]
         }
      for (i in m) if (u[i]^2 > largest^2) largest = u[i]
      for (i in m) phi[i] = u[i]/largest
   }
   for (i in m) printf "shape %s %.12g\n", i, phi[i]
}
