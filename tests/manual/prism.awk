# The worked example, computed independently of the program, for chapter 11 of the manual: 10 x 4 rectangles in plane stress,
# condensed on the 11 nodes of the joint, then the step-wise method in N increments, or (N = 0) Newton's method under the exact law in
# M equal increments (default 1). The exact law remembers the largest lambda of each node at equilibrium, its point A.
#    awk -v n=5 -f prism.awk          prints node, lambda, p, branch of the nodes 1, 6, ..., 51
#    awk -v n=0 -v m=40 -f prism.awk
function gauss(k) { return k % 2 ? 1/sqrt(3) : -1/sqrt(3) }

# stiffness of a rectangle W x H, thickness T: dofs ux, uy of its corners, counter-clockwise
function rectangle(w, h, t,   a, b, g, i, j, q, xi, eta, d11, d12, d33, sx, sy) {
   split("-1 1 1 -1", sx, " "); split("-1 -1 1 1", sy, " ")
   d11 = E/(1 - nu*nu); d12 = nu*d11; d33 = E/(2*(1 + nu))
   for (q = 0; q < 4; q++) {
      xi = gauss(q); eta = gauss(q >= 2 ? 1 : 0)
      for (i = 1; i <= 4; i++) { bx[i] = sx[i]*(1 + sy[i]*eta)/4*2/w; by[i] = sy[i]*(1 + sx[i]*xi)/4*2/h }
      g = t*w*h/4
      for (i = 1; i <= 4; i++) for (j = 1; j <= 4; j++) {
         ke[2*i-1, 2*j-1] += g*(d11*bx[i]*bx[j] + d33*by[i]*by[j])
         ke[2*i-1, 2*j] += g*(d12*bx[i]*by[j] + d33*by[i]*bx[j])
         ke[2*i, 2*j-1] += g*(d12*by[i]*bx[j] + d33*bx[i]*by[j])
         ke[2*i, 2*j] += g*(d11*by[i]*by[j] + d33*bx[i]*bx[j])
      }
   }
}
# row and column of a displacement: those of the joint last; 0 is held
function number(node, axis) { return axis == 1 && node > 50 ? 0 : order[node, axis] }

function form(   node, axis, i, j, e, c, p, q, a, b) {
   rectangle(15, 25, 20)
   for (node = 1; node <= 55; node++) for (axis = 1; axis <= 2; axis++)
      if (!(axis == 1 && node > 50) && !(axis == 2 && node % 5 == 1)) order[node, axis] = ++inner
   for (node = 1; node <= 51; node += 5) order[node, 2] = inner + (node + 4)/5
   all = inner + 11
   for (i = 0; i < 10; i++) for (j = 0; j < 4; j++) {
      split((5*i + j + 1) " " (5*i + j + 6) " " (5*i + j + 7) " " (5*i + j + 2), c, " ")
      for (p = 1; p <= 8; p++) for (q = 1; q <= 8; q++) {
         a = number(c[int((p + 1)/2)], 2 - p % 2); b = number(c[int((q + 1)/2)], 2 - q % 2)
         if (a && b) k[a, b] += ke[p, q]
      }
   }
   f[order[55, 2]] = -800
}
# Gauss's elimination of the first N unknowns of k u = f
function eliminate(n,   i, j, l, r) {
   for (i = 1; i <= n; i++) for (j = i + 1; j <= all; j++) if (k[j, i]) {
      r = k[j, i]/k[i, i]; f[j] -= r*f[i]
      for (l = i; l <= all; l++) if (k[i, l]) k[j, l] -= r*k[i, l]
   }
}
# the 11 equations s + springs, right-hand side B: X
function solve(spring, b, x,   i, j, l, r, m) {
   for (i = 1; i <= 11; i++) { x[i] = b[i]; for (j = 1; j <= 11; j++) m[i, j] = k[inner + i, inner + j]; m[i, i] += spring[i] }
   for (i = 1; i <= 11; i++) for (j = i + 1; j <= 11; j++) { r = m[j, i]/m[i, i]; x[j] -= r*x[i]; for (l = i; l <= 11; l++) m[j, l] -= r*m[i, l] }
   for (i = 11; i >= 1; i--) { for (j = i + 1; j <= 11; j++) x[i] -= m[i, j]*x[j]; x[i] /= m[i, i] }
}
# NORM: branch and stiffness of element I for the next increment; SIGMAF before the last increment, SUMF after it
function norm(i,   p) {
   if (branch[i] == "LOAD" && sumf[i] < sigmaf[i]) { a_lambda[i] = before[i]; branch[i] = "UNLOAD" }
   else if (branch[i] == "RELOAD" && sumf[i] < sigmaf[i]) branch[i] = "UNLOAD"
   else if (branch[i] == "UNLOAD" && sumf[i] > sigmaf[i]) branch[i] = "RELOAD"
   if (branch[i] == "UNLOAD" && sumf[i] <= 0) { branch[i] = "OPEN"; sumf[i] = 0; b_lambda[i] = lambda[i] }
   else if (branch[i] == "OPEN" && lambda[i] >= b_lambda[i]) branch[i] = "RELOAD"
   if (branch[i] == "RELOAD" && lambda[i] >= a_lambda[i]) branch[i] = "LOAD"
   p = sumf[i]/area[i]; if (p < 1e-6*p_av) p = 1e-6*p_av
   return branch[i] == "OPEN" ? 0 : branch[i] == "LOAD" ? area[i]*sqrt(p)/(0.5*C) : E*area[i]
}
function step_wise(   i, s, share, db, x) {
   p_av = 800*0.05/3000
   for (i = 1; i <= 11; i++) { branch[i] = "LOAD"; kn[i] = sqrt(p_av)*area[i]/C }
   for (s = 1; s <= n; s++) {
      share = 0.05 + (1 - n*0.05)/(n*(n - 1)/2)*(s - 1)
      for (i = 1; i <= 11; i++) db[i] = share*g[i]
      solve(kn, db, x)
      for (i = 1; i <= 11; i++) { before[i] = lambda[i]; lambda[i] -= x[i]; sigmaf[i] = sumf[i]; sumf[i] -= kn[i]*x[i]; kn[i] = norm(i) }
   }
}
function newton(   i, j, r, u, x, s, p_a, pass) {
   for (i = 1; i <= 11; i++) { u[i] = -0.01; a_lambda[i] = 0 }
   for (s = 1; s <= m; s++) {
      for (pass = 1; pass <= 60; pass++) {
         for (i = 1; i <= 11; i++) {
            r[i] = s/m*g[i]; for (j = 1; j <= 11; j++) r[i] -= k[inner + i, inner + j]*u[j]
            lambda[i] = -u[i]; p_a = (a_lambda[i]/C)^2
            branch[i] = lambda[i] >= a_lambda[i] ? "LOAD" : p_a + E*(lambda[i] - a_lambda[i]) > 0 ? "UNLOAD" : "OPEN"
            if (branch[i] == "LOAD") { sumf[i] = area[i]*(lambda[i]/C)^2; kn[i] = 2*area[i]*lambda[i]/C^2 }
            else if (branch[i] == "UNLOAD") { sumf[i] = area[i]*(p_a + E*(lambda[i] - a_lambda[i])); kn[i] = E*area[i] }
            else sumf[i] = kn[i] = 0
            r[i] += sumf[i]
         }
         solve(kn, r, x); for (i = 1; i <= 11; i++) u[i] += x[i]
      }
      for (i = 1; i <= 11; i++) if (lambda[i] > a_lambda[i]) a_lambda[i] = lambda[i]
   }
}
BEGIN {
   E = 9500; nu = 0.25; C = 8e-3; if (!m) m = 1
   form(); eliminate(inner)
   for (i = 1; i <= 11; i++) { g[i] = f[inner + i]; area[i] = (i == 1 || i == 11 ? 7.5 : 15)*20; lambda[i] = sumf[i] = 0 }
   if (n) step_wise(); else newton()
   for (i = 1; i <= 11; i++) printf "%d %.12g %.12g %s\n", 5*i - 4, lambda[i], sumf[i]/area[i], branch[i]
}
