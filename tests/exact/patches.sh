# The patch test of MacNeal and Harder as whole decks, of CHEXA, CPENTA and CTETRA, linear and of second order: the stress is the
# same in every element, to the six digits of the listing (to 1E-12: unit/test_patch_decks.pf), and the nodes inside move as the
# corners do.

cp tests/exact/patch.inc tests/exact/patch_*.bdf "$work/"
# CHEXA of 8 and CPENTA of 6 nodes with their modes, as PSOLID has them when ISOP is blank, and without
sed 's/^PSOLID,1,1$/&,,,,PLAIN/' "$work/patch.inc" > "$work/plain.inc"
for kind in hexa penta; do sed "s/'patch.inc'/'plain.inc'/" "$work/patch_$kind.bdf" > "$work/patch_${kind}_plain.bdf"; done
for kind in hexa hexa_plain penta penta_plain tetra hexa20 penta15 tetra10; do
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
