# Decks of plates and shells: awk -v case=NAME -v n=ELEMENTS -v tri=0|1 -v second=0|1 -v load=... -f plates.awk. The problems of R. H. MacNeal and
# R. L. Harder, A proposed standard set of problems to test finite element accuracy, Finite Elements in Analysis and Design 1 (1985)
# 3-20: straight (shape: regular, trapezoid, parallel; `rows` of elements, regular), curved, twisted, plate (edges s or c, load p or f, aspect 1 or 5), roof,
# sphere, cylinder. The first line is a comment: the node and the component whose displacement is the answer.
function grid(x, y, z) { printf "GRID,%d,,%.12f,%.12f,%.12f\n", ++nodes, x, y, z; return nodes }
function quad(a, b, c, d) {
   if (!tri) printf "CQUAD4,%d,1,%d,%d,%d,%d\n", ++elements, a, b, c, d
   else { printf "CTRIA3,%d,1,%d,%d,%d\n", ++elements, a, b, c; printf "CTRIA3,%d,1,%d,%d,%d\n", ++elements, a, c, d }
}
function mesh(nx, ny,   i, j) {
   for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) {
      if (second && !tri && i % 2 && j % 2) continue # the centre of a CQUAD8
      place(i/nx, j/ny); at[i, j] = grid(x, y, z)
   }
   if (second) { # nx and ny even: elements of 2 x 2 intervals
      for (i = 0; i < nx; i += 2) for (j = 0; j < ny; j += 2) {
         if (!tri) printf "CQUAD8,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d\n", ++elements, at[i, j], at[i + 2, j], at[i + 2, j + 2], at[i, j + 2], at[i + 1, j], \
            at[i + 2, j + 1], at[i + 1, j + 2], at[i, j + 1]
         else printf "CTRIA6,%d,1,%d,%d,%d,%d,%d,%d\nCTRIA6,%d,1,%d,%d,%d,%d,%d,%d\n", ++elements, at[i, j], at[i + 2, j], at[i + 2, j + 2], at[i + 1, j], \
            at[i + 2, j + 1], at[i + 1, j + 1], ++elements, at[i, j], at[i + 2, j + 2], at[i, j + 2], at[i + 1, j + 1], at[i + 1, j + 2], at[i, j + 1]
      }
      return
   }
   for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) quad(at[i, j], at[i + 1, j], at[i + 1, j + 1], at[i, j + 1])
}
# where the point (a, b) of the unit square lies
function place(a, b,   r, f, t) {
   if (case == "straight") {
      r = a*6 + 0.5 - int(a*6 + 0.5); f = int(a*6 + 0.5)
      t = f == 0 || f == 6 || shape == "regular" ? 0 : shape == "parallel" || f % 2 == 0 ? 0.1 : -0.1
      x = (rows > 1 ? 6*a : f + t*(2*b - 1)); y = 0.2*b; z = 0
   } else if (case == "curved") {
      r = 4.12 + 0.2*b; x = r*sin(a*pi/2); y = r*cos(a*pi/2); z = 0
   } else if (case == "twisted") {
      x = 12*a; y = (b - 0.5)*1.1*cos(a*pi/2); z = (b - 0.5)*1.1*sin(a*pi/2)
   } else if (case == "plate") {
      x = a; y = b*aspect; z = 0
   } else if (case == "roof") {
      x = 25*sin(b*40*pi/180); y = 25*a; z = 25*cos(b*40*pi/180)
   } else if (case == "sphere") {
      t = b*72*pi/180; f = a*pi/2; x = 10*cos(t)*cos(f); y = 10*cos(t)*sin(f); z = 10*sin(t)
   } else {
      x = 300*sin(b*pi/2); y = 300*a; z = 300*cos(b*pi/2)
   }
}
function hold(node, components) { if (node) printf "SPC1,1,%s,%d\n", components, node }
function force(node, fx, fy, fz) { printf "FORCE,1,%d,,1.0,%.12f,%.12f,%.12f\n", node, fx, fy, fz }
function head(e, nu, t, rho) { printf "MODEL = SPACE\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  OUTPUT = LAST\nBEGIN BULK\nMAT1,1,%.6f,,%s,%s\nPSHELL,1,1,%s,1,,1\n", e, nu, rho, t }
function answer(node, component) { printf "$ %d %d\n", node, component }
# component 1, 2, 3 of a force over the nodes at[i, 0] to at[i, m], as a line load
function edge_load(i, m, c,   j, w) { for (j = 0; j <= m; j++) { w = (j == 0 || j == m ? 0.5 : 1)/m; force(at[i, j], c == 1 ? w : 0, c == 2 ? w : 0, c == 3 ? w : 0) } }
BEGIN {
   pi = 3.14159265358979323846
   if (case == "straight") {
      if (!rows) rows = 1
      head(1e7, "0.3", "0.1"); mesh(6*rows, rows)
      for (j = 0; j <= rows; j++) hold(at[0, j], 123456)
      if (load == 4) { force(at[6*rows, 0], 0, 0, -5); force(at[6*rows, rows], 0, 0, 5) } else edge_load(6*rows, rows, load)
      answer(at[6*rows, 0], load == 4 ? 3 : load)
   } else if (case == "curved") {
      head(1e7, "0.25", "0.1"); mesh(6, 1)
      hold(1, 123456); hold(2, 123456)
      edge_load(6, 1, load); answer(at[6, 0], load)
   } else if (case == "twisted") {
      head(29e6, "0.22", "0.32"); mesh(12, 2)
      for (j = 0; j <= 2; j++) hold(at[0, j], 123456)
      edge_load(12, 2, load); answer(at[12, 1], load)
   } else if (case == "plate") {
      head(1.7472e7, "0.3", thickness ? thickness : "0.0001"); mesh(n, n)
      for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) {
         c = "126"
         if (i == 0) c = c "5"
         if (j == 0) c = c "4"
         if (i == n) c = c (edges == "s" ? "34" : "345")
         if (j == n) c = c (edges == "s" ? "35" : "345")
         for (k = 1; k <= 6; k++) if (index(c, k)) hold(at[i, j], k)
      }
      if (load == "p") printf "PLOAD2,1,%s,1,THRU,%d\n", pressure ? pressure : "1.0-4", elements
      else force(at[0, 0], 0, 0, 1e-4)
      answer(at[0, 0], 3)
   } else {
      if (case == "roof") head(4.32e8, "0.0", "0.25", "360.0")
      if (case == "sphere") head(6.825e7, "0.3", "0.04")
      if (case == "cylinder") head(3e6, "0.3", "3.0")
      mesh(n, n)
      for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) {
         if (case == "sphere") {
            if (i == 0) hold(at[i, j], 246)
            if (i == n) hold(at[i, j], 156)
            continue
         }
         if (i == 0) hold(at[i, j], 246)
         if (i == n) hold(at[i, j], 13)
         if (j == 0) hold(at[i, j], 156)
         if (case == "cylinder" && j == n) hold(at[i, j], 345)
      }
      if (case == "roof") { print "GRAV,1,,1.0,0.0,0.0,-1.0"; answer(at[0, n], 3) }
      if (case == "sphere") { hold(at[0, int(n/2)], 3); force(at[0, 0], 1, 0, 0); force(at[n, 0], 0, -1, 0); answer(at[0, 0], 1) }
      if (case == "cylinder") { force(at[0, 0], 0, 0, -0.25); answer(at[0, 0], 3) }
   }
   print "ENDDATA"
}
