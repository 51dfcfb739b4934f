#!/usr/bin/env bash
# STEP tends to NEWTON: the error of the step-wise method on every loading deck, against NEWTON in many increments, as the
# number of increments of each stage is doubled. Prints one table; fails where an error does not fall.
#
#    convergence.sh PROGRAM WORK_FOLDER
#
# The error is the largest difference of lambda and delta_x over the nodes at the end of the loading, as a share of the largest
# lambda; a run without its rows is a failure. It need not fall at first order: the first increment is a secant, and for m = 0.5
# that alone leaves order 1/2.
set -u
program=$1 work=$2
mkdir -p "$work"
passed=0 failed=0
counts='10 20 40 80 160'

# the deck with METHOD $2 and $3 equal increments in every stage
variant() {
   awk -v method="$2" -v n="$3" '
      BEGIN { share = sprintf("%.7f", 1 / n) }
      /^METHOD/ { next }
      /^TITLE/ { print; print "METHOD = " method; next }
      /^ *OUTPUT/ { next }
      /^SUBCASE/ { print; print "  OUTPUT = NONE"; next }
      /^JINCR/ { gsub(",", " "); printf "JINCR,%d,%d,ARITH,%s\n", $2, n, share; next }
      { print }' "input/$1.bdf" > "$work/$1.$2.$3.bdf"
   "$program" -q -o "$work" "$work/$1.$2.$3.bdf" || { echo "FAILED $1 $2 $3"; failed=$((failed + 1)); return 1; }
}

printf '%-16s' deck; for n in $counts; do printf '%12s' "$n"; done; echo
while read -r deck stage newton; do
   variant "$deck" NEWTON "$newton" || continue
   before= first= falls=1
   printf '%-16s' "$deck"
   for n in $counts; do
      variant "$deck" STEP "$n" || continue 2
      error=$(awk -F, -v s="$stage" -v fine="$newton" -v n="$n" '
         FNR == 1 { file++; next }
         $1 != s { next }
         file == 1 && $2 == fine { lambda[$5] = $13; delta[$5] = $18; if ($13 > scale) scale = $13 }
         file == 2 && $2 == n {
            e = $13 - lambda[$5]; if (e < 0) e = -e; if (e > worst) worst = e
            e = $18 - delta[$5]; if (e < 0) e = -e; if (e > worst) worst = e
         }
         { if (file == 1 && $2 == fine) nodes++; if (file == 2 && $2 == n) compared++ }
         END { if (nodes > 0 && nodes == compared && scale > 0) printf "%.3e", worst / scale; else print "missing" }' "$work/$deck.NEWTON.$newton.joint.csv" "$work/$deck.STEP.$n.joint.csv")
      printf '%12s' "$error"
      # a missing error does not fall
      [ -n "$before" ] && ! awk -v a="$error" -v b="$before" 'BEGIN { exit !(a ~ /^[0-9]/ && b ~ /^[0-9]/ && a + 0 < b + 0) }' && falls=0
      first=${first:-$error} before=$error
   done
   echo
   # sixteen times as many increments leave less than half of it, also where the order is 1/2 or a little below
   awk -v a="$before" -v b="$first" 'BEGIN { exit !(a + 0 < 0.5 * b) }' || falls=0
   if [ $falls -eq 1 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED $deck: the error does not fall"; fi
done <<'DECKS'
prism05 1 40
normal_loop 1 40
shear_pressure 2 640
friction_full 2 640
lap_joint 2 160
cantilever 2 160
joint30 1 160
DECKS
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
