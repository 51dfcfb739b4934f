# Functions shared by the comparisons of solvers; QUERY must be set to the program query_results before same_history is called.

# with_solver DECK SOLVER [TOL]: the deck with SOLVER above its other case control. NEWTON stops where its tolerance is met, not at the
# same place by both solvers: it has to go on to the last digits.
with_solver() {
   awk -v solver="$2" -v tol="${3:-1.E-13}" '
      toupper($0) ~ /^ *BEGIN +BULK/ { bulk = 1 }
      !bulk && toupper($0) ~ /^ *(SOLVER|TOL) *=/ { next }
      !bulk && !done && toupper($0) ~ /^ *(TITLE|UNITS|METHOD|SPC|SUBCASE)/ {
         print "SOLVER = " solver
         print "TOL = " tol
         done = 1
      }
      { print }' "$1"
}

# compare_within SHARE: how far two histories may be apart. A number may be off by SHARE of the largest in its column, or of a
# thousandth of the largest of its kind where that is more: the columns of a direction in which nothing happens hold rounding alone.
rules=() worst=0
compare_within() {
   local column kind one two three scale
   rules=() worst=0
   for column in stage increment joint element node1 node2 branch branch_x branch_y slip; do rules+=(all "$column = other.$column"); done
   for column in load x y z area force k_n k_sx k_sy; do rules+=(all "$column = other.$column within $1*max(abs(other.$column))"); done
   for kind in 'lambda delta_x delta_y' 'pressure tau_x tau_y'; do
      read -r one two three <<< "$kind"
      for column in $kind; do
         scale="max(max(abs(other.$column)), 1e-3*max(max(abs(other.$one)), max(max(abs(other.$two)), max(abs(other.$three)))))"
         rules+=(all "$column = other.$column within $1*$scale")
         worst="max($worst, max(abs($column - other.$column))/max($scale, 1e-300))"
      done
   done
}

same_history() { # EXPECTED ACTUAL: without a joint both hold titles alone
   local off=0
   cmp -s "$1.joint.csv" "$2.joint.csv" || off=$("$query" "$2.joint.csv" with "$1.joint.csv" "${rules[@]}" print "$worst" 2>&1) ||
      { echo "$off"; return 1; }
   printf 'history within %.1E of its scales, ' $off
}
