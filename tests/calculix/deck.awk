# The deck NAME, a cantilever of skewed elements under an end load and under its own weight: awk -v name=tetra -f deck.awk
#
# Nodes stand in rows of nx + 1 along x, these in layers, 120 x 24 mm or 120 x 20 x 16 mm. Those that are free to move along a line
# are off their places, but in `modes`, whose elements are bricks.

BEGIN {
   split("tetra CTETRA hexa CHEXA modes CHEXA tria CTRIA3 quad CQUAD4 strain CTRIA3", word, " ")
   for (w = 1; w in word; w += 2) if (word[w] == name) kind = word[w + 1]
   if (kind == "") { print "deck.awk: there is no deck " name > "/dev/stderr"; exit 1 }
   solid = kind !~ /CTRIA3|CQUAD4/
   nx = solid ? 6 : 10; ny = solid ? 2 : 4; nz = solid ? 2 : 0
   print "UNITS = MM, N\nSPC = 1\nSUBCASE 1\n  LABEL = END LOAD\n  LOAD = 1\nSUBCASE 2\n  LABEL = OWN WEIGHT\n  LOAD = 2\nBEGIN BULK"
   for (k = 0; k <= nz; k++) for (j = 0; j <= ny; j++) for (i = 0; i <= nx; i++) {
      off = name != "modes"
      x = 120 / nx * i + off * (i % nx ? 1.1 * (1 + j - 2 * k) : 0)
      y = (solid ? 10 : 6) * j + off * (j % ny ? 0.88 * (i % 3 - 1.3 + k) : 0)
      z = 8 * k + off * (k == 1 ? 0.77 * (1 - i % 3 + j) : 0)
      printf "GRID,%d,,%.4f,%.4f,%.4f\n", node(i, j, k), x, y, z
   }
   for (k = 0; k < (solid ? nz : 1); k++) for (j = 0; j < ny; j++) for (i = 0; i < nx; i++) {
      a = node(i, j, k); b = a + 1; d = a + nx + 1; c = d + 1; l = (nx + 1) * (ny + 1)
      if (kind == "CHEXA") element(a "," b "," c "," d "," a + l "," b + l "\n+," c + l "," d + l)
      if (kind == "CQUAD4") element(a "," b "," c "," d)
      if (kind == "CTRIA3" && (i + j) % 2 == 0) { element(a "," b "," d); element(b "," c "," d) }
      if (kind == "CTRIA3" && (i + j) % 2) { element(a "," b "," c); element(a "," c "," d) }
      if (kind == "CTETRA") { # round the diagonal from a to the corner above c
         split(b "," c " " b + l "," b " " a + l "," b + l " " c "," d " " d "," d + l " " d + l "," a + l, pair, " ")
         for (p = 1; p <= 6; p++) element(a "," pair[p] "," c + l)
      }
   }
   print solid ? "PSOLID,1,1" (name == "modes" ? ",,,,MODES" : "") : "PSHELL,1,1,8.0" (name == "strain" ? ",-1" : "")
   print "MAT1,1,210000.0,,0.3,7.85-6"
   for (k = 0; k <= nz; k++) for (j = 0; j <= ny; j++) print "SPC1,1," (solid ? "123," : "12,") node(0, j, k)
   for (k = 0; k <= nz; k++) for (j = 0; j <= ny; j++)
      print "FORCE,1," node(nx, j, k) ",," 100 + 10 * j + k (solid ? ".0,0.5,0.25,-1.0" : ".0,0.5,-1.0,0.0")
   print solid ? "GRAV,2,,9.81,0.3,0.2,-1.0" : "GRAV,2,,9.81,0.3,-1.0,0.0"
   print "ENDDATA"
}

function node(i, j, k) { return 1 + i + (nx + 1) * (j + (ny + 1) * k) }
function element(nodes) { print kind "," ++elements ",1," nodes }
