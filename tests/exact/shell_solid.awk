# The same structure of shells or, solid=1, of solids of second order: awk -v case=tube|lap|tee [-v solid=1] -f shell_solid.awk
#
# tee:  a wall of 100 x 100 x 8 on a foot of solids, 100 x 64 x 20, clamped below, the wall of shells tied by SHELLTO; above it moves as a
#       rigid body, node 99999, under a force across, one along, and a moment about the upright, a stage each; n elements of the foot along,
#       m across it, w of the wall of shells along
# tube: a box column, walls of thickness 6, mean width 200, height 600, clamped below; above it moves as a rigid body under a force along
#       x and a moment about z at node 99999; n elements a wall, m along it; frequencies as many as `modes`
# lap:  two sheets of 120 x 40 x 5 that overlap by 40, their joint with MU 0.2, a bolt of 5000 through its middle, the lower one clamped
#       at x = 0, the upper one loaded at x = 200, node 99993, by fx and fz; elements of 5/r
function line(i) { return i == 0 ? -100 - t0/2 : i == n + 2 ? 100 + t0/2 : (200 - t0)*((i - 1)/n - 0.5) }
function kept(i, j) { return i == 0 || j == 0 || i == n + 1 || j == n + 1 }
function id(i, j, k) { return 1 + i + (n + 3)*(j + (n + 3)*k) }
function shell_id(s, i, j) { return 1 + s*10000 + i*(ny + 1) + j }
function solid_id(s, i, j, k) { return 1 + s*10000 + (i*(ny + 1) + j)*3 + k }
function outer(s, i, j) { return solid ? solid_id(s, i, j, s ? 2 : 0) : shell_id(s, i, j) }
BEGIN { t0 = 6; if (case == "tube") tube(); else if (case == "tee") tee(); else lap() }
function foot(i, j, k) { return 1 + i + (n + 1)*(j + (m + 1)*k) }
function wall(i, j, k) { return k == 0 ? foot(i, m/2 - 1 + j, 4) : 60001 + i + (n + 1)*(j + 3*k) }
function brick(a, b, c, d, e, f, g, h) { printf "CHEXA,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d,,,,,,\n+,,,,,,\n", ++bricks, a, b, c, d, e, f, g, h }
function tee(   f, i, j, k, text) {
   print "MODEL = SPACE\nSPC = 1\nOUTPUT = LAST\nSUBCASE 1\n  LOAD = 1\nSUBCASE 2\n  LOAD = 2\nSUBCASE 3\n  LOAD = 3\nBEGIN BULK\nMAT1,1,210000.,,.3"
   print "PSOLID,1,1\nPMARK,5\nPMARK,6\nSPCM,1,123,5\nGRID,99999,,50.,0.,100."
   print "FORCE,1,99999,,100.,0.,1.,0.\nFORCE,2,99999,,1000.,1.,0.,0.\nMOMENT,3,99999,,1.+5,0.,0.,1."
   for (k = 0; k <= 4; k++) for (j = 0; j <= m; j++) for (i = 0; i <= n; i++) printf "GRID,%d,,%.6f,%.6f,%.6f\n", foot(i, j, k), 100*i/n, 64*j/m - 32, 5*k - 20
   for (k = 0; k < 4; k++) for (j = 0; j < m; j++) for (i = 0; i < n; i++)
      brick(foot(i, j, k), foot(i + 1, j, k), foot(i + 1, j + 1, k), foot(i, j + 1, k), foot(i, j, k + 1), foot(i + 1, j, k + 1), foot(i + 1, j + 1, k + 1), foot(i, j + 1, k + 1))
   for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
      printf "CQUAD4,%d,5,%d,%d,%d,%d\n", 80000 + ++f, foot(i, j, 0), foot(i, j + 1, 0), foot(i + 1, j + 1, 0), foot(i + 1, j, 0)
      if (!solid) printf "CQUAD4,%d,6,%d,%d,%d,%d\n", 90000 + f, foot(i, j, 4), foot(i + 1, j, 4), foot(i + 1, j + 1, 4), foot(i, j + 1, 4)
   }
   if (solid) {
      for (k = 1; k <= 12; k++) for (j = 0; j < 3; j++) for (i = 0; i <= n; i++) printf "GRID,%d,,%.6f,%.6f,%.6f\n", wall(i, j, k), 100*i/n, 4*j - 4, 100*k/12
      for (k = 0; k < 12; k++) for (j = 0; j < 2; j++) for (i = 0; i < n; i++) {
         brick(wall(i, j, k), wall(i + 1, j, k), wall(i + 1, j + 1, k), wall(i, j + 1, k), wall(i, j, k + 1), wall(i + 1, j, k + 1), wall(i + 1, j + 1, k + 1), wall(i, j + 1, k + 1))
         if (k == 11) printf "CQUAD4,%d,6,%d,%d,%d,%d\n", 90000 + ++f, wall(i, j, 12), wall(i + 1, j, 12), wall(i + 1, j + 1, 12), wall(i, j + 1, 12)
      }
      print "RBE2M,99998,99999,123456,6\nENDDATA"
      return
   }
   print "PSHELL,2,1,8.,1,,1\nPMARK,7\nSHELLTO,7,6"
   text = "RBE2,99998,99999,123456"
   for (k = 0; k <= 12; k++) for (i = 0; i <= w; i++) printf "GRID,%d,,%.6f,0.,%.6f\n", 50001 + i + (w + 1)*k, 100*i/w, 100*k/12
   for (k = 0; k < 12; k++) for (i = 0; i < w; i++) { j = 50001 + i + (w + 1)*k; printf "CQUAD4,%d,2,%d,%d,%d,%d\n", 70000 + ++f, j, j + 1, j + w + 2, j + w + 1 }
   for (i = 0; i < w; i++) printf "CBAR,%d,7,%d,%d\n", 95000 + i, 50001 + i, 50002 + i
   for (i = 0; i <= w; i++) text = text (i % 8 == 5 ? "\n+," : ",") 50001 + i + (w + 1)*12
   print text "\nENDDATA"
}
function tube(   e, f, i, j, k, q, s, t, w, x, y, text) {
   printf "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  MODES = 1\n  OUTPUT = LAST\nBEGIN BULK\nMAT1,1,210000.,,.3,7.85-9\nEIGRL,1,,,%d\n", modes
   printf "FORCE,1,99999,,1000.,%s\nMOMENT,1,99999,,1.+6,%s\nGRID,99999,,0.,0.,600.\n", "1.,0.,0.", "0.,0.,1."
   if (solid) {
      print "PSOLID,1,1\nPMARK,5\nPMARK,6\nSPCM,1,123,5\n" "RBE2M,99998,99999,123456,6"
      for (k = 0; k <= m; k++) for (j = 0; j <= n + 2; j++) for (i = 0; i <= n + 2; i++)
         if (i < 2 || j < 2 || i > n || j > n) printf "GRID,%d,,%.9f,%.9f,%.9f\n", id(i, j, k), line(i), line(j), 600*k/m
      for (k = 0; k < m; k++) for (j = 0; j <= n + 1; j++) for (i = 0; i <= n + 1; i++) if (kept(i, j)) {
         printf "CHEXA,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d,,,,,,\n+,,,,,,\n", ++e, id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)
         if (k == 0) printf "CQUAD4,%d,5,%d,%d,%d,%d\n", 50000 + ++f, id(i, j, 0), id(i + 1, j, 0), id(i + 1, j + 1, 0), id(i, j + 1, 0)
         if (k == m - 1) printf "CQUAD4,%d,6,%d,%d,%d,%d\n", 50000 + ++f, id(i, j, m), id(i + 1, j, m), id(i + 1, j + 1, m), id(i, j + 1, m)
      }
   } else {
      print "PSHELL,1,1," t0 ".,1,,1"
      w = 4*n
      for (k = 0; k <= m; k++) for (i = 0; i < w; i++) {
         s = i % n; q = int(i/n); t = -100 + 200*s/n
         x = q == 0 ? t : q == 1 ? 100 : q == 2 ? -t : -100; y = q == 0 ? -100 : q == 1 ? t : q == 2 ? 100 : -t
         printf "GRID,%d,,%.9f,%.9f,%.9f\n", 1 + i + w*k, x, y, 600*k/m
         if (k == 0) printf "SPC1,1,123456,%d\n", 1 + i
         if (k < m) printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++e, 1 + i + w*k, 1 + (i + 1)%w + w*k, 1 + (i + 1)%w + w*(k + 1), 1 + i + w*(k + 1)
      }
      text = "RBE2,99998,99999,123456"
      for (i = 0; i < w; i++) { text = text "," 1 + i + w*m; if ((i + 4) % 8 == 7) text = text "\n+" }
      print text
   }
   print "ENDDATA"
}
function lap(   a, b, c, d, e, f, g, i, j, k, m, s, text) {
   if (!r) r = 1
   nx = 24*r; ny = 8*r
   print "METHOD = NEWTON\nMODEL = SPACE\nSPC = 1\nSUBCASE 1\n  INCR = 1\nSUBCASE 2\n  LOAD = 1\n  INCR = 1\nBEGIN BULK\nJINCR,1,4\nMAT1,1,210000.,,.3"
   print "PMARK,11\nPMARK,12\nJOINT,1,1,11,12,.01\nPJOINT,1,1,1,1,.2\nJNORM,1,2.-3,.5,1.+5\nJSHEAR,1,5000.\nCROD,90001,9,99991,99992\nPROD,9,1,50.\nBOLT,1,90001,5000.,1"
   print solid ? "PSOLID,1,1" : "PSHELL,1,1,5.,1,,1"
   for (s = 0; s < 2; s++) {
      for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) for (k = 0; k <= (solid ? 2 : 0); k++)
         printf "GRID,%d,,%.6f,%.6f,%.6f\n", solid ? solid_id(s, i, j, k) : shell_id(s, i, j), 80*s + 5*i/r, 5*j/r, solid ? 5*s + 2.5*k : 2.5 + 5*s
      for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) {
         if (!solid) {
            a = shell_id(s, i, j); b = shell_id(s, i + 1, j); c = b + 1; d = a + 1
            printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++e, a, b, c, d
            if (s == 0 && i >= 16*r) printf "CQUAD4,%d,11,%d,%d,%d,%d\n", 50000 + ++f, a, b, c, d
            if (s == 1 && i < 8*r) printf "CQUAD4,%d,12,%d,%d,%d,%d\n", 50000 + ++f, d, c, b, a
            continue
         }
         for (k = 0; k < 2; k++) printf "CHEXA,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d,,,,,,\n+,,,,,,\n", ++e, solid_id(s, i, j, k), solid_id(s, i + 1, j, k), solid_id(s, i + 1, j + 1, k), solid_id(s, i, j + 1, k), solid_id(s, i, j, k + 1), solid_id(s, i + 1, j, k + 1), solid_id(s, i + 1, j + 1, k + 1), solid_id(s, i, j + 1, k + 1)
         k = s ? 0 : 2
         if (s == 0 && i >= 16*r || s == 1 && i < 8*r) printf "CQUAD4,%d,%d,%d,%d,%d,%d\n", 50000 + ++f, 11 + s, solid_id(s, i, j, k), solid_id(s, i + 1, j, k), solid_id(s, i + 1, j + 1, k), solid_id(s, i, j + 1, k)
      }
   }
   for (j = 0; j <= ny; j++) for (k = 0; k <= (solid ? 2 : 0); k++) printf "SPC1,1,123456,%d\n", solid ? solid_id(0, 0, j, k) : shell_id(0, 0, j)
   if (solid) { print "PMARK,20\nSPCM,1,123,20"; for (j = 0; j < ny; j++) for (k = 0; k < 2; k++) printf "CQUAD4,%d,20,%d,%d,%d,%d\n", 60000 + ++g, solid_id(0, 0, j, k), solid_id(0, 0, j + 1, k), solid_id(0, 0, j + 1, k + 1), solid_id(0, 0, j, k + 1) }
   printf "GRID,99991,,100.,20.,0.\nGRID,99992,,100.,20.,10.\nGRID,99993,,200.,20.,7.5\n"
   for (s = 0; s < 2; s++) {
      text = "RBE3," 80001 + s ",," 99991 + s ",123,1.,123"; m = 7
      for (i = (19 - 16*s)*r; i <= (21 - 16*s)*r; i++) for (j = ny/2 - r; j <= ny/2 + r; j++) { if (m++ % 8 == 0) text = text "\n+"; text = text "," outer(s, i, j) }
      print text
   }
   text = "RBE3,80003,,99993,123,1.,123"; m = 7
   for (j = 0; j <= ny; j++) { if (m++ % 8 == 0) text = text "\n+"; text = text "," (solid ? solid_id(1, nx, j, 1) : shell_id(1, nx, j)) }
   print text
   printf "FORCE,1,99993,,1.,%s,0.,%s\nENDDATA\n", fx, fz
}
