# NEWTON without INCR follows the path: its answer is that of many increments, for at most 2.5 times the iterations of one.
# With INCR its error of path is printed, and is the true one; above 1 % it is warned of. ALL=yes in the environment: the bracket too.

# iterations NAME; contact NAME: the smallest share of the last stage; off NAME COLUMN STAGE
# The rows of a long history are not all printed: the number of the last one of an increment counts.
iterations() { awk '/^ CONVERGENCE HISTORY, STAGE / { on = 1; stage++; next } /^ [A-Z]/ { on = 0 }
   on && $1 + 0 > 0 && $3 + 0 > 0 && NF >= 6 { last[stage, $1] = $3 } END { for (k in last) n += last[k]; print n + 0 }' "$work/$1.out"; }
contact() { awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next } { print $1, $2, sprintf("%.6f", $at["contact"]) }' "$work/$1.stage.csv"; }
off() { awk -v c="$2" -v stage="${3:-1}" '/^ ERROR OF PATH, STAGE / { on = $5 + 0 == stage; next } /^ [A-Z]/ { on = 0 }
   on && $1 + 0 > 0 { v = $c } END { print v }' "$work/$1.out"; }

# in_increments DECK N: the deck with N equal increments in every stage; DECK alone: without INCR
in_increments() {
   awk -v n="${2:-0}" '/^ *(INCR|OUTPUT|MODES)/ || /^JINCR/ { next } { print }
      /^SUBCASE/ && n { print "  INCR = 999" } /^SUBCASE/ { print "  OUTPUT = NONE" }
      /^BEGIN/ && n { if (n == 1) print "JINCR,999,1"; else printf "JINCR,999,%d,ARITH,%.12f\n", n, 1/n }' "input/$1.bdf" |
      sed "s|^INCLUDE '|INCLUDE '$PWD/input/|" > "$work/$1.path${2:-}.bdf"
   run "$1.path${2:-}"
}

while read -r deck many stages; do
   [ "$deck" != bracket ] || [ "${ALL:-}" ] || continue # a minute
   in_increments $deck && in_increments $deck 1 && in_increments $deck $many || continue
   for stage in $(seq $stages); do
      for column in lambda pressure; do
         largest="rows stage=$stage rows increment=max(increment) print max($column)"
         near "$deck, stage $stage: largest $column, without INCR and in $many increments" \
            "$(value $deck.path $largest)" "$(value $deck.path$many $largest)" 1e-3
      done
   done
   same "$deck: contact, without INCR and in $many increments" "$(contact $deck.path)" "$(contact $deck.path$many)"
   holds "$deck: iterations, of those of one increment" "$(iterations $deck.path) <= 2.5*$(iterations $deck.path1)"
done <<'DECKS'
prism_newton 640 1
prism3d 20 1
bracket 8 2
column_foot 10 3
DECKS

# The error of one increment, as printed, is near the true one: of lambda and p the root mean square, of contact the area.
[ -e "$work/prism_newton.path640.joint.csv" ] && {
   true_error() { value prism_newton.path1 with "$work/prism_newton.path640.joint.csv" on increment=640 on element \
      rows 'branch != "OPEN" or other.branch != "OPEN"' print "sqrt(sum(area*($1 - other.$1)^2)/3000)/max(other.$1)*100"; }
   holds 'prism: error of lambda in one increment' "$(off prism_newton.path1 3)/$(true_error lambda) = 1.25 within 0.75"
   holds 'prism: error of p in one increment' "$(off prism_newton.path1 4)/$(true_error pressure) = 1.25 within 0.75"
   near 'prism: contact in one increment, per cent' "$(off prism_newton.path1 5)" 10 1e-6
   says 'prism: one increment is warned of' "$work/prism_newton.path1.out" 'WARNING: STAGE 1, INCREMENT 1: ERROR OF PATH 10 % OF THE AREA IN CONTACT'
   says 'prism: one increment is told of on the screen' "$work/prism_newton.path1.log" 'away from the path of many increments'
   holds 'prism: error of lambda without INCR, per cent' "$(off prism_newton.path 3) <= 0.1"
   same 'prism: the path has no warning' "$(grep -c 'WARNING.*PATH' "$work/prism_newton.path.out")" 0
}

# PATHTOL: the smaller, the nearer to many increments, in more parts.
in_increments cantilever && in_increments cantilever 320 && for tolerance in 1.0-2 1.0-5; do
   sed "s/^METHOD = NEWTON/&\nPATHTOL = $tolerance/" "$work/cantilever.path.bdf" > "$work/path$tolerance.bdf"
   run path$tolerance
done && {
   away() { value $1 rows stage=1 with "$work/cantilever.path320.joint.csv" on stage on increment=320 on element \
      print 'max(abs(pressure - other.pressure))/max(other.pressure)'; }
   holds 'PATHTOL: the smaller, the nearer' "0 < $(away path1.0-5) and $(away path1.0-5) < 0.3*$(away path1.0-2)"
   holds 'PATHTOL: the smaller, the more parts' "$(off path1.0-5 2) > $(off path1.0-2 2)"
}

# Shear from no pressure: the joint moves as much at small loads as later. Most of the way lies in the first hundredth of the load. The
# printed error of equal increments is not below a third of the true one, and graded parts are within PATHTOL of many graded increments.
beginning() {
   { printf 'METHOD = NEWTON\nSPC = 1\nOUTPUT = NONE\nSUBCASE 1\n  LOAD = 1\n'; [ "$1" ] && echo '  INCR = 5'; printf 'BEGIN BULK\n'
     cat <<'CARDS'
BLOCK2,1,1,10,4,0.,0.
+,150.,100.
+,20,21
PMARK,20
PMARK,21
PSHELL,1,1,20.
MAT1,1,9500.,,.25
JOINT,1,1,20
JNORM,1,8.-3,.5
PJOINT,1,1,1,,.3,,.27
JSHEAR,1,.4,120.
SPCM,1,1,21
FORCE,1,55,,800.,.15,-1.
CARDS
     [ "$1" ] && awk -v n="$1" -v g="$2" 'BEGIN { t = "JINCR,5,,LIST"; for (k = 1; k <= n; k++) { x = (k/n)^g
        t = t sprintf(",%.15f", x - last) (k % 5 || k == n ? "" : "\n+"); last = x } print t }'
     echo ENDDATA; } > "$work/begins$1$2.bdf"
   run "begins$1$2"
}
beginning '' '' && beginning 1 1 && beginning 40 5 && beginning 80 5 && {
   true_error() { value begins$1 rows 'increment = max(increment)' with "$work/begins805.joint.csv" on increment=80 on element \
      print "sqrt(sum(area*($2 - other.$2)^2)/3000)/max(other.$2)*100"; }
   number=3
   for column in lambda pressure; do
      holds "shear from no pressure: $column of 40 graded increments, of PATHTOL" "$(true_error 405 $column) < 0.01"
      holds "shear from no pressure: $column of one increment is in error" "$(true_error 11 $column) > 0.2"
      holds "shear from no pressure: said error of $column in one increment" "$(off begins11 $number) > $(true_error 11 $column)/3"
      holds "shear from no pressure: $column without INCR is within PATHTOL" "$(true_error '' $column) <= 0.1"
      holds "shear from no pressure: said error of $column without INCR" "$(off begins $number) > $(true_error '' $column)/3"
      number=$((number + 1))
   done
}
