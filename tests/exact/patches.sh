# The patch test of MacNeal and Harder as whole decks, of CHEXA, CPENTA and CTETRA, linear and of second order: the stress is the
# same in every element, to the six digits of the listing (to 1E-12: unit/test_element_patches.pf), and the nodes inside move as the
# corners do.

# equations: node 9, of which the elements have one more, moves by an equation of 21 terms that every linear field fulfils: as the
# trilinear functions of the cube interpolate, with 0.1 (u of the middle of an edge - mean of its ends) = 0 added for each edge. An
# element then has more unknowns than its own nodes.
cp tests/exact/patch.inc tests/exact/patch_*.bdf "$work/"
# CHEXA of 8 and CPENTA of 6 nodes with their modes, as PSOLID has them when ISOP is blank, and without
sed 's/^PSOLID,1,1$/&,,,,PLAIN/' "$work/patch.inc" > "$work/plain.inc"
for kind in hexa penta; do sed "s/'patch.inc'/'plain.inc'/" "$work/patch_$kind.bdf" > "$work/patch_${kind}_plain.bdf"; done
awk 'BEGIN { split("1 2 2 3 3 4 4 1 5 6 6 7 7 8 8 5 1 5 2 6 3 7 4 8", end)
             x[1] = 0.249; x[2] = 0.342; x[3] = 0.192; split("011001100011001100001111", digit, "") }
     function weight(k,   i, w) {                            # of corner k: the signs stand by axis in DIGIT
        w = 1
        for (i = 1; i <= 3; i++) w *= digit[8*(i - 1) + k] ? x[i] : 1 - x[i]
        return w
     }
     /^SPC = / { print; print "MPC = 7"; next }
     /^ENDDATA/ {
        for (k = 1; k <= 8; k++) a[k] = weight(k)
        for (k = 21; k <= 32; k++) { a[k] = 0.1; a[end[2*(k - 20) - 1]] -= 0.05; a[end[2*(k - 20)]] -= 0.05 }
        for (c = 1; c <= 3; c++) {
           line = sprintf("MPC,7,9,%d,-1.0", c); n = 1
           for (k = 1; k <= 32; k++) if (k in a) {
              if (n % 2 == 0) { print line ","; line = "," } # columns 2 to 8, field 9 blank
              line = line sprintf(",%d,%d,%s", k, c, n ? sprintf("%.16f", a[k]) : ""); n++
           }
           print line
        }
     }
     { print }' "$work/patch_hexa20.bdf" > "$work/patch_equations.bdf"
for kind in hexa hexa_plain penta penta_plain tetra hexa20 penta15 tetra10 equations; do
   run patch_$kind && judge "patch test of C${kind^^}" '
      function size(x) { return x < 0 ? -x : x }
      function check(found, expected) { n++; if (!(size(found - expected) <= 1e-9 + 2e-6 * size(expected))) print FNR ": " found ", expected " expected }
      / DISPLACEMENTS OF NODES/ { table = "nodes" }
      / STRESSES/ { table = "stresses" }
      / REACTIONS| BALANCE/ { table = "" }
      $1 + 0 != $1 || NF < 7 { next }
      table == "nodes" {
         nodes++
         check($5, 1e-3 * ($2 + $3 / 2 + $4 / 2)); check($6, 1e-3 * ($2 / 2 + $3 + $4 / 2)); check($7, 1e-3 * ($2 / 2 + $3 / 2 + $4))
      }
      table == "stresses" && NF == 10 { elements++; for (k = 5; k <= 7; k++) check($k, 2000); for (k = 8; k <= 10; k++) check($k, 400) }
      END { if (nodes < 16 || elements < 7) print nodes " nodes, " elements " elements"; print "checked " n }' "$work/patch_$kind.out"
done
