# Writes the deck NAME: awk -v name=tetra -f calculix_deck.awk
#
# A cantilever of distorted elements, 120 x 24 mm or 120 x 20 x 16 mm, under an end load and under its own weight; with second-order
# elements also under pressure on its end or on one long side. Nodes stand in rows of nx + 1 along x, rows in layers. Inner nodes
# are moved off the regular mesh, except in `modes`, whose elements are bricks. With second-order elements a row has a node between
# two corners, at their middle, or off it where the deck is `curved`. Curved triangles, tetrahedra and wedges have the end load
# alone: for weight and pressure CalculiX takes fewer integration points. `ring` is a thick ring, radii 30 and 80 mm, 40 mm high,
# under pressure on one end, under its own weight, and under inner pressure.

BEGIN {
   split("tetra CTETRA 1 hexa CHEXA 1 modes CHEXA 1 tria CTRIA3 1 quad CQUAD4 1 strain CTRIA3 1 " \
         "tetra10 CTETRA 2 tetra10_curved CTETRA 2 hexa20 CHEXA 2 hexa20_curved CHEXA 2 penta15 CPENTA 2 " \
         "penta15_curved CPENTA 2 tria6 CTRIA6 2 tria6_curved CTRIA6 2 quad8 CQUAD8 2 quad8_curved CQUAD8 2 " \
         "strain8 CQUAD8 2 stress8 CQUAD8 2 ring8 CQUAD8 2 ring8_curved CQUAD8 2", word, " ")
   for (w = 1; w in word; w += 3) if (word[w] == name) { kind = word[w + 1]; order = word[w + 2] }
   if (kind == "") { print "deck.awk: there is no deck " name > "/dev/stderr"; exit 1 }
   solid = kind !~ /CTRIA|CQUAD/; ring = name ~ /^ring/; off = name != "modes"
   curved = name ~ /curved/; few = curved && kind ~ /TRIA|TETRA|PENTA/
   nx = order == 2 ? 4 : solid ? 6 : 10; ny = solid || order == 2 ? 2 : 4; nz = solid ? 2 : 0
   mx = order * nx; my = order * ny; mz = order * nz
   print "UNITS = MM, N\nSPC = 1\nSUBCASE 1\n  LABEL = END LOAD\n  LOAD = 1"
   if (!few) print "SUBCASE 2\n  LABEL = OWN WEIGHT\n  LOAD = 2"
   if (order == 2 && !few) print "SUBCASE 3\n  LABEL = PRESSURE\n  LOAD = 3"
   print "BEGIN BULK"

   # corners count in steps of `order`; a cell is one hexahedron, one quadrilateral, or what fills it of other kinds
   for (k = 0; k < (solid ? mz : 1); k += order) for (j = 0; j < my; j += order) for (i = 0; i < mx; i += order) {
      a = at(i, j, k); b = at(i + order, j, k); c = at(i + order, j + order, k); d = at(i, j + order, k)
      A = at(i, j, k + order); B = at(i + order, j, k + order)
      C = at(i + order, j + order, k + order); D = at(i, j + order, k + order)
      even = (i + j) / order % 2 == 0
      if (kind == "CHEXA") element(a " " b " " c " " d " " A " " B " " C " " D, "1-2 2-3 3-4 4-1 1-5 2-6 3-7 4-8 5-6 6-7 7-8 8-5")
      if (kind == "CPENTA") {
         wedge = "1-2 2-3 3-1 1-4 2-5 3-6 4-5 5-6 6-4"
         element(a " " b " " c " " A " " B " " C, wedge); element(a " " c " " d " " A " " C " " D, wedge)
      }
      if (kind ~ /CQUAD/) element(a " " b " " c " " d, "1-2 2-3 3-4 4-1")
      if (kind ~ /CTRIA/ && even) { element(a " " b " " d, "1-2 2-3 3-1"); element(b " " c " " d, "1-2 2-3 3-1") }
      if (kind ~ /CTRIA/ && !even) { element(a " " b " " c, "1-2 2-3 3-1"); element(a " " c " " d, "1-2 2-3 3-1") }
      if (kind == "CTETRA") { # round the diagonal from a to C
         split(b " " c " " B " " b " " A " " B " " c " " d " " d " " D " " D " " A, pair, " ")
         for (p = 1; p <= 12; p += 2) element(a " " pair[p] " " pair[p + 1] " " C, "1-2 2-3 3-1 1-4 2-4 3-4")
      }
      if (order == 2) press(i, j, k)
   }
   for (k = 0; k <= mz; k++) for (j = 0; j <= my; j++) for (i = 0; i <= mx; i++) if (order == 1 || (at(i, j, k) in used)) {
      place(i, j, k)
      printf "GRID,%d,,%.4f,%.4f,%.4f\n", node(i, j, k), here[1], here[2], here[3]
      if (ring ? j == 0 : i == 0) print "SPC1,1," (solid ? "123," : ring ? "2," : "12,") node(i, j, k)
      if (!ring && i == mx) print "FORCE,1," node(i, j, k) ",," 100 + 10 * j + k (solid ? ".0,0.5,0.25,-1.0" : ".0,0.5,-1.0,0.0")
   }
   if (ring) print "PAXIS,1,1"
   else if (solid) print "PSOLID,1,1" (name == "hexa" ? ",,,,PLAIN" : "")
   else print "PSHELL,1,1," (name == "stress8" ? "0.02" : "8.0") (name ~ /strain/ ? ",-1" : "")
   print "MAT1,1,210000.0,,0.3,7.85-6"
   print solid ? "GRAV,2,,9.81,0.3,0.2,-1.0" : ring ? "GRAV,2,,9.81,0.0,-1.0,0.0" : "GRAV,2,,9.81,0.3,-1.0,0.0"
   print "ENDDATA"
}

function node(i, j, k) { return 1 + i + (mx + 1) * (j + (my + 1) * k) }
function at(i, j, k) { return i ":" j ":" k }

# element(CORNERS, EDGES): its nodes, those of second order by the edges on which they lie
function element(corners, edges,   n, m, e, c, p, q, s, k, line, fields) {
   n = split(corners, c, " ")
   if (order == 2) for (m = split(edges, e, " "); k < m; ) {
      split(e[++k], s, "-"); split(c[s[1]], p, ":"); split(c[s[2]], q, ":")
      c[++n] = at((p[1] + q[1]) / 2, (p[2] + q[2]) / 2, (p[3] + q[3]) / 2)
   }
   line = kind "," ++elements ",1"; fields = 2
   for (k = 1; k <= n; k++) {
      if (fields == 8) { line = line "\n+"; fields = 0 }
      split(c[k], p, ":"); used[c[k]]; line = line "," node(p[1], p[2], p[3]); fields++
   }
   print line
}

# here = the place of a node; odd numbers are between corners
function place(i, j, k,   s, c, lower) {
   if (order == 1) { corner(i, j, k); return }
   corner((i - i % 2) / 2, (j - j % 2) / 2, (k - k % 2) / 2)
   for (c = 1; c <= 3; c++) lower[c] = here[c]
   corner((i + i % 2) / 2, (j + j % 2) / 2, (k + k % 2) / 2)
   s = curved && (i % 2 || j % 2 || k % 2)
   for (c = 1; c <= 3; c++) here[c] = (here[c] + lower[c]) / 2
   here[1] += s * 0.9 * ((i + 2 * j + k) % 3 - 1.1); here[2] += s * 0.7 * ((2 * i + j + k) % 3 - 0.8)
   if (solid) here[3] += s * 0.6 * ((i + j + 2 * k) % 3 - 0.9)
}
function corner(i, j, k) {
   here[1] = 120 / nx * i + off * (i % nx ? 1.1 * (1 + j - 2 * k) : 0)
   here[2] = (solid ? 20 : 24) / ny * j + off * (j % ny ? 0.88 * (i % 3 - 1.3 + k) : 0)
   here[3] = 8 * k + off * (k == 1 ? 0.77 * (1 - i % 3 + j) : 0)
   if (ring) { here[1] = 30 + here[1] * 50 / 120; here[2] *= 40 / 24 }
}

# press(CELL): on the side y high; of a ring on the inner one, and as its end load on its upper one; solids on their end
function press(i, j, k) {
   if (ring && j + 2 == my) print "PLOADE,1," elements "," 30 + i ".0," node(i, j + 2, 0) "," node(i + 2, j + 2, 0)
   if (ring) { if (i == 0) print "PLOADE,3," elements ",50.0," node(i, j, 0) "," node(i, j + 2, 0) }
   else if (!solid) { if (j + 2 == my) print "PLOADE,3," elements ",2.0," node(i, j + 2, 0) "," node(i + 2, j + 2, 0) }
   else if (i + 2 == mx && kind != "CTETRA")
      print "PLOAD4,3," elements - (kind == "CPENTA") ",50.0,,,," node(i + 2, j, k) "," node(i + 2, j + 2, k + 2)
   else if (i + 2 == mx) { # the two tetrahedra with three corners there
      print "PLOAD4,3," elements - 5 ",50.0,,,," node(i + 2, j, k) "," node(i, j, k)
      print "PLOAD4,3," elements - 4 ",50.0,,,," node(i + 2, j, k) "," node(i, j, k)
   }
}
