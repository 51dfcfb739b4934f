# NEWTON without INCR follows the path: its answer is that of many increments, for at most 2.5 times the iterations of one where no
# element turns back on the way.
# With INCR its error of path is printed, and is the true one; above 1 % it is warned of. ALL=yes in the environment: the bracket too.

# contact NAME: the smallest share of the last stage; off NAME COLUMN STAGE
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

# Elements that are pressed, let go and slip on the way: one increment sees none of it at its start, half way and its end. In stage 16
# three of 21 are let go at once where others open: half way is found by iterations only, and parts come near by their number alone.
while read -r deck many stage limit; do
   in_increments $deck && in_increments $deck 1 && in_increments $deck $many || continue
   for name in path path1; do
      for column in lambda pressure; do
         off=$(value $deck.$name rows stage=$stage with "$work/$deck.path$many.joint.csv" on stage on increment=$many on element \
            rows 'branch != "OPEN" or other.branch != "OPEN"' print "sqrt(sum(area*($column - other.$column)^2)/sum(area))/max(other.$column)")
         [ $name = path1 ] || holds "$deck, stage $stage: $column of all elements, without INCR and in $many increments" "$off <= $limit"
      done
   done
   holds "$deck, stage $stage: p in one increment is farther away" "$off > 1e-3"
done <<'DECKS'
lap_joint 100 2 1e-3
flange_pair 300 2 1e-3
cantilever_cases 100 2 1e-3
cantilever_cases 100 16 4e-3
DECKS

# The error of one increment, as printed, is near the true one: of lambda and p the root mean square, of contact the area.
[ -e "$work/prism_newton.path640.joint.csv" ] && {
   true_error() { value prism_newton.path1 with "$work/prism_newton.path640.joint.csv" on increment=640 on element \
      rows 'branch != "OPEN" or other.branch != "OPEN"' print "sqrt(sum(area*($1 - other.$1)^2)/3000)/max(other.$1)*100"; }
   holds 'prism: error of lambda in one increment' "$(off prism_newton.path1 3)/$(true_error lambda) = 1.25 within 0.75"
   holds 'prism: error of p in one increment' "$(off prism_newton.path1 4)/$(true_error pressure) = 1.25 within 0.75"
   near 'prism: contact in one increment, per cent' "$(off prism_newton.path1 5)" 10 1e-6
   says 'prism: one increment is warned of' "$work/prism_newton.path1.out" 'WARNING: STAGE 1, INCREMENT 1: ERROR OF PATH 10 % OF THE AREA IN CONTACT'
   says 'prism: one increment is told of on the screen' "$work/prism_newton.path1.log" 'away from the path of many increments.*; without INCR it follows the path'
   near 'prism: error of lambda without INCR, per cent' "$(off prism_newton.path 3)" 0 0 1e-3
   same 'prism: the path has no warning' "$(grep -c 'WARNING.*PATH' "$work/prism_newton.path.out")" 0
}

# A deck without INCR is not told to leave INCR out.
[ -e "$work/flange_pair.path.bdf" ] && {
   sed 's/^METHOD = NEWTON/&\nPATHTOL = 0.05/' "$work/flange_pair.path.bdf" > "$work/coarse.bdf"
   run coarse && says 'without INCR: what shows the distance from the path' "$work/coarse.log" 'of the largest pressure away from the path .*; more increments, by INCR, show how far'
}

# A way whose middle corrections alone do not find: the distance from 400 increments is told.
cp tests/exact/let_go.bdf "$work/let_go.bdf"
for n in 1 400; do
   sed "s/^SUBCASE.*/&\nINCR = 777/; s/^ENDDATA/JINCR,777,$n,ARITH,$(awk "BEGIN { printf \"%.4f\", 1/$n }")\nENDDATA/" tests/exact/let_go.bdf > "$work/let_go.$n.bdf"
done
run let_go && run let_go.1 && run let_go.400 && {
   far=$(value let_go with "$work/let_go.400.joint.csv" on stage=2 on increment=400 on element rows 'stage = 2 and branch != "OPEN"' \
      print 'max(abs(lambda - other.lambda))/max(lambda)*100')
   told=$(sed -n 's/.*NEWTON is up to \([0-9.]*\) % of the largest lambda.*/\1/p' "$work/let_go.log")
   holds "let_go: the distance told, ${told:=0} %, is that from 400 increments" "($told) > 0.5*($far)"
   says 'let_go in one increment, farther away: it is warned of' "$work/let_go.1.out" 'WARNING: .* ERROR OF PATH .* OF THE LARGEST LAMBDA'
}

# Elements pressed more early in a stage and then let go, and parts that begin in equilibrium: their ways are measured too.
for name in heated_blocks moved_wall lifted_feet; do
   cp tests/exact/$name.bdf "$work"
   sed 's/^SUBCASE.*/&\nINCR = 777/; s/^ENDDATA/JINCR,777,400,ARITH,.0025\nENDDATA/' tests/exact/$name.bdf > "$work/$name.400.bdf"
   run $name && run $name.400 || continue
   far=$(for column in lambda pressure; do
      value $name with "$work/$name.400.joint.csv" on stage=2 on increment=400 on element rows 'stage = 2 and (branch != "OPEN" or other.branch != "OPEN")' \
         print "100*sqrt(sum(area*($column - other.$column)^2)/sum(area))/max(other.$column)"; done | sort -g | tail -n 1)
   told=$(sed -n 's/.*NEWTON is up to \([0-9.]*\) %.*/\1/p' "$work/$name.log")
   holds "$name: $far % from 400 increments, ${told:=0} % told" "($far) <= 0.1 + 2*($told)"
done

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
