# The deck NAME, a curved cantilever of elements of second order under an end load and under its own weight:
# awk -v name=hexa20 -f second_order.awk
#
# Places stand in rows of 2 nx + 1 along x, these in rows along y, these in layers; corners at the even ones, the node of an edge
# half-way between its ends. All are off a box of 120 x 24 x 16 mm by smooth functions, so that edges are curved; ring: about y.

BEGIN {
   split("tetra10 CTETRA penta15 CPENTA hexa20 CHEXA tria6 CTRIA6 quad8 CQUAD8 strain8 CQUAD8 ring8 CQUAD8", word, " ")
   for (w = 1; w in word; w += 2) if (word[w] == name) kind = word[w + 1]
   if (kind == "") { print "second_order.awk: there is no deck " name > "/dev/stderr"; exit 1 }
   edges["CTRIA6"] = "12 23 31"
   edges["CQUAD8"] = "12 23 34 41"
   edges["CTETRA"] = "12 23 31 14 24 34"
   edges["CPENTA"] = "12 23 31 14 25 36 45 56 64"
   edges["CHEXA"] = "12 23 34 41 15 26 37 48 56 67 78 85"
   solid = kind !~ /CTRIA6|CQUAD8/
   nx = solid ? 4 : 6; ny = 2; nz = solid ? 2 : 0
   for (k = 0; k < (solid ? nz : 1); k++) for (j = 0; j < ny; j++) for (i = 0; i < nx; i++) {
      a = place(2 * i, 2 * j, 2 * k); b = a + 2; d = a + 2 * (2 * nx + 1); c = d + 2; l = 2 * (2 * nx + 1) * (2 * ny + 1)
      if (kind == "CHEXA") element(a " " b " " c " " d " " a + l " " b + l " " c + l " " d + l)
      if (kind == "CPENTA") { element(a " " b " " c " " a + l " " b + l " " c + l); element(a " " c " " d " " a + l " " c + l " " d + l) }
      if (kind == "CQUAD8") element(a " " b " " c " " d)
      if (kind == "CTRIA6") { element(a " " b " " c); element(a " " c " " d) }
      if (kind == "CTETRA") { # round the diagonal from a to the corner above c
         split(b " " c " " b + l " " b " " a + l " " b + l " " c " " d " " d " " d + l " " d + l " " a + l, pair, " ")
         for (p = 1; p <= 11; p += 2) element(a " " pair[p] " " pair[p + 1] " " c + l)
      }
   }
   print "UNITS = MM, N\nSPC = 1\nSUBCASE 1\n  LABEL = END LOAD\n  LOAD = 1\nSUBCASE 2\n  LABEL = OWN WEIGHT\n  LOAD = 2\nBEGIN BULK"
   for (k = 0; k <= 2 * nz; k++) for (j = 0; j <= 2 * ny; j++) for (i = 0; i <= 2 * nx; i++) {
      n = place(i, j, k)
      if (!(n in used)) continue
      x = 60 / nx * i + (j - 2) * sin(i / 3) + (k - 2) / 2 * cos(i / 2)
      y = 6 * j + 3 * sin(i / 4) + 0.1 * j * k
      z = 4 * k + 2 * cos(i / 3) + 0.1 * j * sin(i)
      if (!solid) z = 0
      printf "GRID,%d,,%.4f,%.4f,%.4f\n", n, (name == "ring8" ? 40 : 0) + x, y, z
      if (i == 0) supports = supports "SPC1,1," (solid ? 123 : 12) "," n "\n"
      if (i == 2 * nx) loads = loads "FORCE,1," n ",," 100 + 10 * j + k (solid ? ".0,0.5,0.25,-1.0\n" : ".0,0.5,-1.0,0.0\n")
   }
   printf "%s", cards
   print solid ? "PSOLID,1,1" : name == "ring8" ? "PAXIS,1,1" : "PSHELL,1,1,8.0" (name == "strain8" ? ",-1" : "")
   print "MAT1,1,210000.0,,0.3,7.85-6"
   printf "%s%s", supports, loads
   print "GRAV,2,,9.81," (name == "ring8" ? "0.0,-1.0,0.0" : solid ? "0.3,0.2,-1.0" : "0.3,-1.0,0.0")
   print "ENDDATA"
}

function place(i, j, k) { return 1 + i + (2 * nx + 1) * (j + (2 * ny + 1) * k) }

# A card with the corners, then the nodes of the edges.
function element(corners,   at, e, end, m, n, node, p) {
   n = split(corners, node, " ")
   m = split(edges[kind], end, " ")
   for (e = 1; e <= m; e++) node[n + e] = (node[substr(end[e], 1, 1)] + node[substr(end[e], 2, 1)]) / 2
   cards = cards kind "," ++elements ",1"
   for (p = 1; p <= n + m; p++) {
      used[node[p]] = 1
      cards = cards ((p + 1) % 8 == 0 && p > 1 ? "\n+," : ",") node[p]
   }
   cards = cards "\n"
}
