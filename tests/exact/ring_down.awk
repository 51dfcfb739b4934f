# Masses in a row that swing freely, between them springs, and elements that stick (stiffness s) or slip (at limit l); by Newmark's method with beta = 0 (central
# differences). Input: `mass NODE M`, `spring NODE NODE K` (node 0: the ground), `element NODE NODE S L`, `shape NODE PHI`, of which the
# motion begins with the velocity V PHI. Prints amplitude, frequency and loss factor of q = sum of PHI M u over every CYCLES cycles:
# amplitude at the node that moves most, frequency from the zeros of q, loss factor from the logarithmic decrement, 2 zeta = delta/pi.
$1 == "mass" { m[$2] = $3; nodes[++n] = $2 }
$1 == "spring" { a[++ns] = $2; b[ns] = $3; k[ns] = $4 }
$1 == "element" { ea[++ne] = $2; eb[ne] = $3; s[ne] = $4; limit[ne] = $5 }
$1 == "shape" { phi[$2] = $3; if ($3^2 > peak^2) peak = $3 < 0 ? -$3 : $3 }
END {
   pi = atan2(0, -1)
   for (i in m) mass += m[i]*phi[i]^2
   for (i in m) { u[i] = 0; v[i] = V*phi[i] }
   u[0] = 0
   h = step
   for (t = 0; t < time; t += h) {
      for (i in m) f[i] = 0
      for (j = 1; j <= ns; j++) { p = k[j]*(u[b[j]] - u[a[j]]); f[a[j]] += p; f[b[j]] -= p }
      for (j = 1; j <= ne; j++) {
         p = s[j]*(u[eb[j]] - u[ea[j]] - slid[j])
         if (p > limit[j]) { slid[j] += (p - limit[j])/s[j]; p = limit[j] }
         if (p < -limit[j]) { slid[j] += (p + limit[j])/s[j]; p = -limit[j] }
         f[ea[j]] += p; f[eb[j]] -= p
      }
      q2 = q1; q1 = q; q = 0
      for (i in m) { v[i] += (t > 0 ? h : h/2)*f[i]/m[i]; u[i] += h*v[i]; q += m[i]*phi[i]*u[i]/mass }
      if (t > 2*h && q1 > q2 && q1 >= q && q1 > 0) { # a peak: the parabola through three points
         top = q1 - (q - q2)^2/(8*(q - 2*q1 + q2))
         tops[++peaks] = top; at[peaks] = t
      }
      if (t > 2*h && q1 < 0 && q >= 0) zero[++zeros] = t - h*q/(q - q1)
   }
   for (c = 1 + skip; c + cycles < peaks && c + cycles <= zeros; c += cycles)
      printf "%.9g %.9g %.9g\n", peak*sqrt(tops[c]*tops[c + cycles]), cycles/(zero[c + cycles] - zero[c]), log(tops[c]/tops[c + cycles])/(pi*cycles)
}
