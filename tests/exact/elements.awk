# A deck: a column of 100 x 100 mm, 600 mm high, clamped at its foot, 1000 N in the transverse direction spread over its top.
#
#    awk -v kind=KIND -v n=4 -v nz=24 -f elements.awk
#
# KIND: CTETRA, CPENTA, CHEXA, CPENTA_PLAIN, CHEXA_PLAIN, CTETRA10, CPENTA15 or CHEXA20; n x n x nz bricks, each cut into six
# tetrahedra or two wedges where needed. Corners 1, 2, 3, 4 of the top are the nodes 1 to 4.

BEGIN {
   card = kind; sub(/[0-9]+$/, "", card); sub(/_PLAIN$/, "", card)
   s = kind ~ /[0-9]$/ ? 2 : 1
   m = s * n; mz = s * nz
   print "UNITS = MM, N\nECHO = NO\nSPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK"
   node(0, 0, mz); node(m, 0, mz); node(0, m, mz); node(m, m, mz)
   edges["CHEXA"] = "1-2 2-3 3-4 4-1 1-5 2-6 3-7 4-8 5-6 6-7 7-8 8-5"; edges["CPENTA"] = "1-2 2-3 3-1 1-4 2-5 3-6 4-5 5-6 6-4"
   edges["CTETRA"] = "1-2 2-3 3-1 1-4 2-4 3-4"; edges["CQUAD"] = "1-2 2-3 3-4 4-1"; edges["CTRIA"] = "1-2 2-3 3-1"
   for (k = 0; k < mz; k += s) for (j = 0; j < m; j += s) for (i = 0; i < m; i += s) {
      a = at(i, j, k); b = at(i + s, j, k); c = at(i + s, j + s, k); d = at(i, j + s, k)
      A = at(i, j, k + s); B = at(i + s, j, k + s); C = at(i + s, j + s, k + s); D = at(i, j + s, k + s)
      if (card == "CHEXA") element(card, 1, a " " b " " c " " d " " A " " B " " C " " D)
      if (card == "CPENTA") { element(card, 1, a " " b " " c " " A " " B " " C); element(card, 1, a " " c " " d " " A " " C " " D) }
      if (card == "CTETRA") { # round the diagonal from a to C
         split(b " " c " " B " " b " " A " " B " " c " " d " " d " " D " " D " " A, pair, " ")
         for (p = 1; p <= 12; p += 2) element(card, 1, a " " pair[p] " " pair[p + 1] " " C)
      }
      if (k > 0 && k + s < mz) continue
      for (top = 0; top <= 1; top++) if (top ? k + s == mz : k == 0) {
         if (card == "CHEXA") element("CQUAD", 20 + top, top ? A " " B " " C " " D : a " " b " " c " " d)
         else { element("CTRIA", 20 + top, top ? A " " B " " C : a " " b " " c); element("CTRIA", 20 + top, top ? A " " C " " D : a " " c " " d) }
      }
   }
   print "PSOLID,1,1" (kind ~ /PLAIN/ ? ",,,,PLAIN" : "")
   print "MAT1,1,210000.0,,0.3\nPMARK,20\nPMARK,21\nSPCM,1,123,20\nFORCEM,1,1000.0,1.0,0.0,0.0,21\nENDDATA"
}

function at(i, j, k) { return i ":" j ":" k }
function node(i, j, k) {
   if (!((i, j, k) in number)) {
      number[i, j, k] = ++nodes
      printf "GRID,%d,,%.10f,%.10f,%.10f\n", nodes, 100 * i / m, 100 * j / m, 600 * k / mz
   }
   return number[i, j, k]
}

# element(CARD, PROPERTY, CORNERS): its nodes, those of second order at the middle of its edges
function element(card, property, corners,   count, q, e, c, u, v, w, line, fields) {
   count = split(corners, c, " ")
   if (s == 2) for (q = split(edges[card], e, " "); w < q; ) {
      split(e[++w], u, "-"); split(c[u[2]], v, ":"); split(c[u[1]], u, ":")
      c[++count] = at((u[1] + v[1]) / 2, (u[2] + v[2]) / 2, (u[3] + v[3]) / 2)
   }
   line = card (card ~ /^C(QUAD|TRIA)$/ ? count : "") "," ++elements "," property; fields = 2
   for (q = 1; q <= count; q++) {
      if (fields == 8) { line = line "\n+"; fields = 0 }
      split(c[q], u, ":"); line = line "," node(u[1], u[2], u[3]); fields++
   }
   print line
}
