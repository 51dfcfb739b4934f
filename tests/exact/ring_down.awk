# Masses in a row and beams in the plane that swing freely, springs between them, and elements that stick (stiffness S) or slip (at a limit); by
# Newmark's method of average acceleration. A degree of freedom is a number, 0 the ground. Input:
#    mass I M; spring I J K
#    beam I J L EA EI M R H       Euler-Bernoulli; I, I + 1, I + 2: u, v and rotation of its first node, J likewise; mass M and rotary inertia R
#                                 a unit of length; its axis passes H above its nodes
#    element I J S LIMIT MU KN    with KN: a spring KN along I + 1 and J + 1, J above; the limit grows by MU times what it is pressed more
# The motion begins at rest with the velocity V times the first mode phi (greatest value 1) of the system that sticks; OTHERS is a damping of all
# other modes [1/time]. A system without ground has RIGID motions (default 0): the mode is the first with strain. Prints amplitude, frequency and loss factor of q = phi M u/(phi M phi) over every CYCLES cycles: frequency from the
# zeros of q, loss factor from the logarithmic decrement, 2 zeta = delta/pi.
function dof(name) { if (name == 0) return 0; if (!(name in number)) number[name] = ++n; return number[name] }
function add(s, i, j, x) { if (i && j) s[100*i + j] += x }
function tie(i, j, x) { add(k, i, i, x); add(k, j, j, x); add(k, i, j, -x); add(k, j, i, -x) }
function axial(s, a, b, x) { add(s, e[a], e[b], x); add(s, e[a + 2], e[b], -h*x); add(s, e[a], e[b + 2], -h*x); add(s, e[a + 2], e[b + 2], h*h*x) }
function bending(s, x, upper,   c, i, j, p) { # the upper triangle of a matrix of v, rotation L; v, rotation L
   split(upper, c)
   for (i = 1; i <= 4; i++) for (j = i; j <= 4; j++) {
      p = c[++c[0]]*x*(i % 2 ? 1 : l)*(j % 2 ? 1 : l)
      add(s, at(i), at(j), p)
      if (i != j) add(s, at(j), at(i), p)
   }
}
function at(i) { return e[i + 1 + (i > 2)] }
function invert(s,   i, j, r, p) { # Gauss-Jordan in place: all matrices here are positive definite
   for (r = 1; r <= n; r++) {
      p = 1/s[101*r]; s[101*r] = 1
      for (j = 1; j <= n; j++) s[100*r + j] *= p
      for (i = 1; i <= n; i++) if (i != r) {
         p = s[100*i + r]; s[100*i + r] = 0
         for (j = 1; j <= n; j++) s[100*i + j] -= p*s[100*r + j]
      }
   }
}
$1 == "mass" { add(m, dof($2), dof($2), $3) }
$1 == "spring" { tie(dof($2), dof($3), $4) }
$1 == "beam" {
   for (i = 1; i <= 3; i++) { e[i] = $2 ? dof($2 + i - 1) : 0; e[i + 3] = $3 ? dof($3 + i - 1) : 0 }
   l = $4; h = $9
   for (i = 1; i <= 4; i += 3) for (j = 1; j <= 4; j += 3) { axial(k, i, j, (i == j ? 1 : -1)*$5/l); axial(m, i, j, (i == j ? 2 : 1)*$7*l/6) }
   bending(k, $6/l^3, "12 6 -12 6 4 -6 2 12 -6 4")
   bending(m, $7*l/420, "156 22 54 -13 4 13 -3 156 -22 4")
   bending(m, $8/(30*l), "36 3 -36 3 4 -3 -1 36 -3 4")
}
$1 == "element" {
   a[++ne] = dof($2); b[ne] = dof($3); stiff[ne] = $4; limit[ne] = $5; mu[ne] = $6*$7
   tie(a[ne], b[ne], $4)
   if ($7) { na[ne] = dof($2 + 1); nb[ne] = dof($3 + 1); tie(na[ne], nb[ne], $7) }
}
END {
   pi = atan2(0, -1); h = step
   for (i = 1; i <= n; i++) for (j = 1; j <= n; j++) { inverse[100*i + j] = k[100*i + j] + (rigid ? m[100*i + j] : 0); x[100*i + j] = k[100*i + j] + 4/h^2*m[100*i + j]; phi[i] = i }
   invert(inverse)
   for (mode = 0; mode <= rigid; mode++) for (t = 1; t <= 60; t++) { # inverse iteration, orthogonal in [M] to the modes before
      for (i = 1; i <= n; i++) { w[i] = 0; for (j = 1; j <= n; j++) w[i] += m[100*i + j]*phi[j] }
      peak = 0
      for (i = 1; i <= n; i++) { phi[i] = 0; for (j = 1; j <= n; j++) phi[i] += inverse[100*i + j]*w[j] }
      for (o = 0; o < mode; o++) {
         d = 0; for (i = 1; i <= n; i++) d += of_mass[o, i]*phi[i]
         for (i = 1; i <= n; i++) phi[i] -= d*old[o, i]
      }
      for (i = 1; i <= n; i++) if (phi[i]^2 > peak^2) peak = phi[i]
      for (i = 1; i <= n; i++) phi[i] /= peak
      if (t < 60 || mode == rigid) continue
      mass = 0; for (i = 1; i <= n; i++) { w[i] = 0; for (j = 1; j <= n; j++) w[i] += m[100*i + j]*phi[j]; mass += w[i]*phi[i] }
      for (i = 1; i <= n; i++) { old[mode, i] = phi[i]/sqrt(mass); of_mass[mode, i] = w[i]/sqrt(mass); phi[i] = i^2 }
   }
   mass = 0
   for (i = 1; i <= n; i++) { w[i] = 0; for (j = 1; j <= n; j++) w[i] += m[100*i + j]*phi[j]; mass += w[i]*phi[i]; v[i] = V*phi[i] }
   # the damping is OTHERS ([M] - [M] phi phi [M]/mass)
   for (i = 1; i <= n; i++) for (j = 1; j <= n; j++) x[100*i + j] += 2*others/h*(m[100*i + j] - w[i]*w[j]/mass)
   invert(x)
   # u = [G] (4 u/h^2 + 4 v/h + acceleration) + [X] B' r: the elements stick in [X], r is what slip takes from their forces
   for (i = 1; i <= n; i++) for (j = 1; j <= n; j++) for (t = 1; t <= n; t++) g[100*i + j] += x[100*i + t]*m[100*t + j]
   for (t = 0; t < time; t += h) {
      for (i = 1; i <= n; i++) y[i] = 4*(u[i]/h + v[i])/h + acc[i]
      d = 0; for (i = 1; i <= n; i++) { z[i] = 2*u[i]/h + v[i]; d += w[i]*z[i]/mass }
      for (i = 1; i <= n; i++) z[i] = y[i] + others*(z[i] - d*phi[i])
      for (i = 1; i <= n; i++) { p = 0; for (j = 1; j <= n; j++) p += g[100*i + j]*z[j]; new[i] = free[i] = p }
      for (j = 1; j <= ne; j++) r[j] = 0
      for (more = 1; more;) {
         more = 0
         for (j = 1; j <= ne; j++) {
            d = new[b[j]] - new[a[j]]
            p = stiff[j]*(d - slid[j]); most = limit[j] + mu[j]*(new[na[j]] - new[nb[j]])
            if (most < 0) { print "an element opens"; exit }
            if (p > most) p = most
            if (p < -most) p = -most
            p = stiff[j]*d - p - r[j]
            if (p^2 < 1e-18*limit[j]^2) continue
            more = 1; r[j] += p
            for (i = 1; i <= n; i++) new[i] += (x[100*i + b[j]] - x[100*i + a[j]])*p
         }
      }
      for (j = 1; j <= ne; j++) slid[j] = r[j]/stiff[j]
      q2 = q1; q1 = q; q = 0
      for (i = 1; i <= n; i++) { p = 4*new[i]/h^2 - y[i]; v[i] += h/2*(acc[i] + p); acc[i] = p; u[i] = new[i]; q += w[i]*u[i]/mass }
      if (t > 2*h && q1 > q2 && q1 >= q && q1 > 0) { # a peak: the parabola through three points
         tops[++peaks] = q1 - (q - q2)^2/(8*(q - 2*q1 + q2))
      }
      if (t > 2*h && q1 < 0 && q >= 0) zero[++zeros] = t - h*q/(q - q1)
   }
   for (c = 1 + skip; c + cycles < peaks && c + cycles <= zeros; c += cycles)
      printf "%.9g %.9g %.9g\n", sqrt(tops[c]*tops[c + cycles]), cycles/(zero[c + cycles] - zero[c]), log(tops[c]/tops[c + cycles])/(pi*cycles)
}
