# The twisted beam of MacNeal and Harder, of solid elements as a pre-processor writes them, IN and ISOP of PSOLID blank. Its end moves
# by 5.424E-3 under a unit force along its width, by 1.754E-3 across it.
# Source: R. H. MacNeal, R. L. Harder, A proposed standard set of problems to test finite element accuracy, Finite Elements in Analysis
# and Design 1 (1985) 3-20, Fig. 4 and Table 6.

# twisted NAME CARD ALONG ISOP: 48 x 6 x 2 elements; CPENTA have their triangles across the beam. ALONG: 1 along the width, 0 across it
twisted() {
   awk -v card="$2" -v along="$3" -v isop="$4" 'BEGIN {
      nx = 48; ny = 6; nz = 2; right = atan2(0, -1) / 2
      print "ECHO = NO\nSPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK"
      for (i = 0; i <= nx; i++) for (j = 0; j <= ny; j++) for (k = 0; k <= nz; k++) {
         a = right * i / nx; y = 1.1 * (j / ny - 0.5); z = 0.32 * (k / nz - 0.5)
         printf "GRID,%d,,%.12f,%.12f,%.12f\n", at(i, j, k), 12 * i / nx, y * cos(a) - z * sin(a), y * sin(a) + z * cos(a)
         if (i == 0) print "SPC1,1,123," at(i, j, k)
         if (i == nx) printf "FORCE,1,%d,,%.12f,0.0,%s\n", at(i, j, k), (j % ny ? 1 : 0.5) * (k % nz ? 1 : 0.5) / (ny * nz), along ? "0.0,1.0" : "1.0,0.0"
      }
      for (i = 0; i < nx; i++) for (j = 0; j < ny; j++) for (k = 0; k < nz; k++) {
         a = at(i, j, k); b = at(i, j + 1, k); c = at(i, j + 1, k + 1); d = at(i, j, k + 1); n = at(i + 1, j, k) - a
         if (card == "CHEXA") printf "CHEXA,%d,1,%d,%d,%d,%d,%d,%d\n+,%d,%d\n", ++e, a, b, c, d, a + n, b + n, c + n, d + n
         else {
            printf "CPENTA,%d,1,%d,%d,%d,%d,%d,%d\n", ++e, a, b, c, a + n, b + n, c + n
            printf "CPENTA,%d,1,%d,%d,%d,%d,%d,%d\n", ++e, a, c, d, a + n, c + n, d + n
         }
      }
      print "PSOLID,1,1" (isop == "" ? "" : ",,,," isop) "\nMAT1,1,29.0+6,,0.22\nENDDATA"
   }
   function at(i, j, k) { return 1 + k + (nz + 1) * (j + (ny + 1) * i) }' > "$work/$1.bdf"
   run "$1"
}
# the node in the middle of the end
tip() { moved "$1" $((1 + 1 + 3*(3 + 7*48))) "$((2 + $2))"; }

for along in 1 0; do
   exact=$([ $along = 1 ] && echo 5.424e-3 || echo 1.754e-3)
   twisted twisted CHEXA $along '' && near "twisted beam of CHEXA, ISOP blank, along the width: $along" "$(tip twisted $along)" $exact 0.01
   twisted twisted_modes CHEXA $along MODES && near "twisted beam of CHEXA: blank is MODES, along the width: $along" \
      "$(tip twisted_modes $along)" "$(tip twisted $along)" 0
   twisted twisted_plain CHEXA $along PLAIN && holds "twisted beam of plain CHEXA is a sixth too stiff or more, along the width: $along" \
      "$(tip twisted_plain $along) < 0.84*$exact"
   twisted twisted_full CHEXA $along FULL && near "twisted beam of CHEXA: FULL is PLAIN, along the width: $along" \
      "$(tip twisted_full $along)" "$(tip twisted_plain $along)" 0
   twisted wedges CPENTA $along '' && near "twisted beam of CPENTA, ISOP blank, along the width: $along" "$(tip wedges $along)" $exact 0.02
   twisted wedges_plain CPENTA $along PLAIN && holds "twisted beam of plain CPENTA, along the width: $along" \
      "$(tip wedges_plain $along) < 0.84*$exact"
done
says 'twisted beam: the listing names the formulation of CHEXA' "$work/twisted.out" 'CHEXA OF 8 NODES, INCOMPATIBLE MODES  *576$'
says 'twisted beam: that of plain ones' "$work/twisted_full.out" 'CHEXA OF 8 NODES, PLAIN  *576$'
says 'twisted beam: that of CPENTA' "$work/wedges.out" 'CPENTA OF 6 NODES, INCOMPATIBLE MODES  *1152$'
