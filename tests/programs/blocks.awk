# Two blocks of 60 x 20 x 30 mm, one on the other, 3000 N on a line across the top at x = 52.5: about half of the joint opens.
#
#    awk -v form=deck|ccx -v upper=16x4 -v lower=11x3 -v order=1|2 -f blocks.awk
#
# UPPER, LOWER: elements along x and y, UPPER such that a node stands at x = 52.5. ORDER 1: CHEXA with 8 nodes, six layers in a
# block; 2: with 20 nodes, three layers. The joint follows lambda = c p**0.5 without friction; CalculiX gets this law as a table of
# 190 pressures, NODE TO SURFACE, upper block slave. Bodies and joint are a thousand times as stiff as steel, so that the effect of
# large displacements in CalculiX is small.

BEGIN {
   young = 2.1e8; c = 1e-6; highest = 60
   layers = order == 2 ? 3 : 6
   split(upper, n, "x"); split(lower, m, "x")
   block(0, m[1], m[2], -30); block(1, n[1], n[2], 0)
   split(upper, n, "x"); line = 52.5 / 60 * order * n[1]
   if (line != int(line)) { print "blocks.awk: no node at x = 52.5" > "/dev/stderr"; exit 1 }
   for (j = 0; j <= order * n[2]; j++) if ((1, line, j, top) in number) {
      middle = order == 2 && j % 2; end = j == 0 || j == order * n[2]
      force[number[1, line, j, top]] = 3000 / n[2] * (order == 1 ? (end ? 1/2 : 1) : middle ? 4/6 : end ? 1/6 : 2/6)
   }
   if (form == "deck") deck(); else ccx()
}

# block(B, NX, NY, Z): nodes, elements, and the faces of its side of the joint
function block(b, nx, ny, z0,   i, j, k, s, e) {
   s = order; top = s * layers
   for (k = 0; k <= top; k++) for (j = 0; j <= s * ny; j++) for (i = 0; i <= s * nx; i++) {
      if (s == 2 && (i % 2) + (j % 2) + (k % 2) > 1) continue
      number[b, i, j, k] = ++nodes; x[nodes] = 60 * i / (s * nx); y[nodes] = 20 * j / (s * ny); z[nodes] = z0 + 30 * k / top
      if (b == 0 && k == 0) held[nodes] = "123"
   }
   if (b == 1) { held[number[1, 0, 0, top]] = "12"; held[number[1, 0, s * ny, top]] = "1" }
   for (k = 0; k < top; k += s) for (j = 0; j < s * ny; j += s) for (i = 0; i < s * nx; i += s) {
      e = ++elements
      corner[e] = ring(b, i, j, k, s) " " ring(b, i, j, k + s, s)
      if (s == 2) {
         below[e] = edges(b, i, j, k); above[e] = edges(b, i, j, k + 2)
         between[e] = number[b, i, j, k + 1] " " number[b, i + 2, j, k + 1] " " number[b, i + 2, j + 2, k + 1] " " number[b, i, j + 2, k + 1]
      }
      if (b == 0 && k + s == top) side(20, ring(b, i, j, top, s) (s == 2 ? " " edges(b, i, j, top) : ""), e ", S2\n")
      if (b == 1 && k == 0) side(21, ring(b, i, j, 0, s) (s == 2 ? " " edges(b, i, j, 0) : ""), e ", S1\n")
   }
}
function ring(b, i, j, k, s) { return number[b, i, j, k] " " number[b, i + s, j, k] " " number[b, i + s, j + s, k] " " number[b, i, j + s, k] }
function edges(b, i, j, k) { return number[b, i + 1, j, k] " " number[b, i + 2, j + 1, k] " " number[b, i + 1, j + 2, k] " " number[b, i, j + 1, k] }
function side(mark, list, of_calculix) { face[++faces] = list; mark_of[faces] = mark; surface[mark] = surface[mark] of_calculix }

function card(name, head, list,   count, q, w, text, fields) {
   count = split(list, w, " "); text = name "," head; fields = 2
   for (q = 1; q <= count; q++) { if (fields == 8) { text = text "\n+"; fields = 0 } text = text "," w[q]; fields++ }
   print text
}
function deck(   k) {
   print "UNITS = MM, N\nMETHOD = NEWTON\nECHO = NO\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 1\nBEGIN BULK"
   for (k = 1; k <= nodes; k++) printf "GRID,%d,,%.10f,%.10f,%.10f\n", k, x[k], y[k], z[k]
   for (k = 1; k <= elements; k++) card("CHEXA", k ",1", corner[k] (order == 2 ? " " below[k] " " between[k] " " above[k] : ""))
   for (k = 1; k <= faces; k++) card(order == 2 ? "CQUAD8" : "CQUAD4", elements + k "," mark_of[k], face[k])
   printf "PMARK,20\nPMARK,21\nPSOLID,1,1,,,,PLAIN\nMAT1,1,%.1f,,0.3\nJOINT,1,1,21,20\nPJOINT,1,1,,,,,1.0\nJNORM,1,%.3E,0.5,1.0+9\nJINCR,1,4\n", young, c
   for (k in held) print "SPC1,1," held[k] "," k
   for (k in force) printf "FORCE,1,%d,,%.10f,0.0,0.0,-1.0\n", k, force[k]
   print "ENDDATA"
}
function ccx(   k, p, w, q, count) {
   print "*NODE, NSET=NODES"; for (k = 1; k <= nodes; k++) printf "%d, %.10g, %.10g, %.10g\n", k, x[k], y[k], z[k]
   print "*ELEMENT, TYPE=C3D" (order == 2 ? 20 : 8) ", ELSET=ALL"
   for (k = 1; k <= elements; k++) {
      printf "%d", k; count = split(corner[k] (order == 2 ? " " below[k] " " above[k] " " between[k] : ""), w, " ")
      for (q = 1; q <= count; q++) printf "%s%d", q == 13 ? ",\n" : ", ", w[q]; print ""
   }
   print "*SURFACE, NAME=LOWER\n" surface[20] "*SURFACE, NAME=UPPER\n" surface[21] "*MATERIAL, NAME=BODY\n*ELASTIC"
   printf "%.10g, 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=BODY\n", young
   print "*SURFACE INTERACTION, NAME=JOINT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR"
   for (k = 0; k <= 190; k++) { p = highest * (k / 190)^2; printf "%.10g, %.10g\n", p, c * sqrt(p) }
   print "*CONTACT PAIR, INTERACTION=JOINT, TYPE=NODE TO SURFACE, SMALL SLIDING\nUPPER, LOWER\n*BOUNDARY"
   for (k in held) for (q = 1; q <= length(held[k]); q++) print k ", " substr(held[k], q, 1)
   print "*STEP, INC=200\n*STATIC\n0.1, 1.\n*CONTROLS, PARAMETERS=FIELD\n1e-8, 1e-8, 1e-3, , 1e-8\n*CLOAD"
   for (k in force) printf "%d, 3, %.10f\n", k, -force[k]
   print "*NODE PRINT, NSET=NODES, FREQUENCY=999\nU\n*CONTACT PRINT, FREQUENCY=999\nCSTR\n*END STEP"
}
