# Mesh of the Brake-Reuss beam: CHEXA of two halves that lap, holes, faces of three zones of the joint, nodes round the holes. Left half: number
# below 10000, right half: 10000 more. -v nb= elements of a half before the lap, nz= over the height of a leaf
function put(s, i, j, k) { return s*10000 + (i*(ny + 1) + j)*(2*nz + 1) + k + 1 }
function x_of(i) { return i < nb ? 300*(1 - (1 - i/nb)^1.4) : i <= nb + nx ? 300 + lap[i - nb + 1] : 420 + 300*((i - nb - nx)/nb)^1.4 }
function corner(n, i, j, k) { if (!(n in seen)) { seen[n]; printf "GRID,%d,,%.6g,%.6g,%.6g\n", n, x_of(i), 25.4*j/ny, 12.7*k/nz } return n }
function middle(i) { return (x_of(i) + x_of(i + 1))/2 - 300 }
function is_hole(i, j) { return j == 1 && middle(i) % 30 < 1e-6 && middle(i) > 29 && middle(i) < 91 }
function face(pid, s, i, j, k) { print "CQUAD4," ++e "," pid "," put(s, i, j, k) "," put(s, i + 1, j, k) "," put(s, i + 1, j + 1, k) "," put(s, i, j + 1, k) }
BEGIN {
   if (!nb) nb = 16
   if (!nz) nz = 2
   ny = 3
   nx = split("0 6 12 19 26.3 33.7 41.5 48.5 56.3 63.7 71.5 78.5 86.3 93.7 101 108 114 120", lap, " ") - 1
   split("0 1 1 0 0 1 1 0", a, " "); split("0 0 1 1 0 0 1 1", b, " ")
   for (s = 0; s < 2; s++) for (i = s ? nb : 0; i < nb + nx + s*nb; i++) for (j = 0; j < ny; j++) for (k = 0; k < 2*nz; k++) {
      in_lap = i >= nb && i < nb + nx
      if (in_lap && ((k < nz) == s || is_hole(i, j))) continue
      for (c = 1; c <= 8; c++) n[c] = corner(put(s, i + a[c], j + b[c], k + (c > 4)), i + a[c], j + b[c], k + (c > 4))
      printf "CHEXA,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d\n", ++e, n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]
   }
   for (i = nb; i < nb + nx; i++) for (j = 0; j < ny; j++) {
      if (is_hole(i, j)) continue
      c = middle(i); if (c > 60) c = 120 - c
      for (s = 0; s < 2; s++) face(31 + 10*s + (c > 6) + (c > 12), s, i, j, nz)
   }
   for (i = nb; i < nb + nx; i++) if (is_hole(i, 1)) for (s = 0; s < 2; s++) { # the washer: its force goes into four nodes round the hole
      g = 40000 + 10*(++hole[s]) + s
      printf "GRID,%d,,%.6g,12.7,%.6g\nRBE3,%d,,%d,123456,1.0,123,%d,%d,+\n+,%d,%d\n", g, 300 + middle(i), 28.6*s - 1.6, 1000 + g, g,
         put(s, i, 1, 2*nz*s), put(s, i + 1, 1, 2*nz*s), put(s, i, 2, 2*nz*s), put(s, i + 1, 2, 2*nz*s)
   }
}
