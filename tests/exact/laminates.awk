# Classical laminate theory by numbers: awk -v plies='E1 E2 NU12 G12 A1 A2 T THETA;...' -v load='NX NY NXY MX MY MXY' -v dt=RISE -f laminates.awk
# Prints the strains and curvatures about the mid-plane, xx yy xy, then for each ply the stresses 11 22 12 at its middle, then A11 B11 D11.
# The integrals over the thickness are sums over 2000 slices of each ply, with stresses of each slice by turning it into its axes.
function turn(strain, c, s) { # strains 11, 22, 12 of the ply
   e1 = c*c*strain[1] + s*s*strain[2] + c*s*strain[3]
   e2 = s*s*strain[1] + c*c*strain[2] - c*s*strain[3]
   e12 = 2*c*s*(strain[2] - strain[1]) + (c*c - s*s)*strain[3]
}
function stress(k, strain, warm, c, s, q) { # of ply k, in its axes: s1 s2 s12; in those of the laminate: sx[1] to sx[3]
   c = cos(p[k, 8]*pi/180); s = sin(p[k, 8]*pi/180)
   turn(strain, c, s)
   q = 1 - p[k, 3]^2*p[k, 2]/p[k, 1]
   e1 -= p[k, 5]*warm; e2 -= p[k, 6]*warm
   s1 = (p[k, 1]*e1 + p[k, 3]*p[k, 2]*e2)/q; s2 = (p[k, 3]*p[k, 2]*e1 + p[k, 2]*e2)/q; s12 = p[k, 4]*e12
   sx[1] = c*c*s1 + s*s*s2 - 2*c*s*s12; sx[2] = s*s*s1 + c*c*s2 + 2*c*s*s12; sx[3] = c*s*(s1 - s2) + (c*c - s*s)*s12
}
BEGIN {
   pi = 3.14159265358979323846
   n = split(plies, row, ";")
   for (k = 1; k <= n; k++) { split(row[k], v, " "); for (i = 1; i <= 8; i++) p[k, i] = v[i]; t += v[7] }
   split(load, f, " ")
   for (j = 0; j <= 6; j++) { # the forces of unit strains and curvatures, 0: of the temperature
      z0 = -t/2
      for (k = 1; k <= n; k++) {
         slices = 2000; dz = p[k, 7]/slices
         for (m = 0; m < slices; m++) {
            z = z0 + (m + 0.5)*dz
            for (i = 1; i <= 3; i++) unit[i] = (j == i) + z*(j == i + 3)
            stress(k, unit, j == 0 ? dt : 0)
            for (i = 1; i <= 3; i++) { a[i, j] += sx[i]*dz; a[i + 3, j] += sx[i]*z*dz }
         }
         z0 += p[k, 7]
      }
   }
   a11 = a[1, 1]; b11 = a[1, 4]; d11 = a[4, 4]
   for (i = 1; i <= 6; i++) x[i] = f[i] - a[i, 0]
   for (i = 1; i <= 6; i++) {
      for (r = 1; r <= 6; r++) {
         if (r == i) continue
         w = a[r, i]/a[i, i]
         for (j = 1; j <= 6; j++) a[r, j] -= w*a[i, j]
         x[r] -= w*x[i]
      }
   }
   for (i = 1; i <= 6; i++) { x[i] /= a[i, i]; printf "%.10e ", x[i] }
   print ""
   z0 = -t/2
   for (k = 1; k <= n; k++) {
      for (i = 1; i <= 3; i++) unit[i] = x[i] + (z0 + p[k, 7]/2)*x[i + 3]
      stress(k, unit, dt); printf "%.10e %.10e %.10e\n", s1, s2, s12
      z0 += p[k, 7]
   }
   printf "%.10e %.10e %.10e\n", a11, b11, d11
}
