# The prism of the worked example against an independent computation (input/prism*.bdf; see *_reference.*).

variant prism05 NEWTON 1 && {
   near 'prism, NEWTON in one increment: lambda at node 51' "$(cell prism05.NEWTON.1 1 1 51 lambda)" 6.234906012806e-3 1e-10
   near 'prism, NEWTON in one increment: lambda at node 1' "$(cell prism05.NEWTON.1 1 1 1 lambda)" -1.722222094507e-4 1e-9
   same 'prism, NEWTON in one increment: node 1' "$(cell prism05.NEWTON.1 1 1 1 branch)" OPEN
}

# BACK: 15 iterations to its own TOL, a millionth; the laws' pressures of the last lie as near.
run_input prism_back && {
   near 'prism, BACK by its own TOL: lambda at node 51' "$(cell prism_back 1 1 51 lambda)" 6.234906012806e-3 1e-6
   same 'prism, BACK by its own TOL: iterations' "$(sed -n '/ITERATIONS, STAGE/,/RESULTANTS/p' "$work/prism_back.out" | grep -c '^ *1 *[0-9]')" 15
}
# Without averages the first secants lead too far and back, in turn, on and on; the listing warns, and shows all that it did.
sed 's/^METHOD = BACK/&\nAVERAGE = NO/' input/prism_back.bdf > "$work/prism_no_average.bdf"
run prism_no_average && {
   judge 'prism, BACK without averages: in turn too far and not far enough' '
      / ITERATIONS, STAGE/ { on = 1 } / RESULTANTS/ { on = 0 }
      on && $1 == 1 && NF == 5 { n++; if (($3 > 6.234906e-3) != n % 2) print }
      END { if (n != 24) print n " iterations"; print "checked " n }' "$work/prism_no_average.out"
   says 'prism, BACK without averages: the listing warns' "$work/prism_no_average.out" 'WARNING: STAGE 1, INCREMENT 1: THE SECANTS HAVE NOT CONVERGED IN 24 ITERATIONS'
}

# BACK and NEWTON in one increment have no history: the same answer.
sed 's/^METHOD = BACK/&\nTOL = 1.0E-11/' input/prism_back.bdf > "$work/prism_back.bdf"
run prism_back && {
   near 'prism, BACK: lambda at node 51' "$(cell prism_back 1 1 51 lambda)" 6.234906012806e-3 1e-8
   ask 'prism, BACK equals NEWTON in one increment' prism_back count 11 with "$work/prism05.NEWTON.1.joint.csv" on node1 \
      all 'branch = other.branch and lambda = other.lambda within 6e-11 and pressure = other.pressure within 6e-9'
}

# The cycle: all 30 increments, 11 nodes.
awk 'BEGIN { print "increment,node,lambda,pressure,branch"; split("LOAD UNLOAD RELOAD OPEN", b, " "); for (k in b) branch[substr(b[k], 1, 1)] = b[k] }
   /^#/ { next }
   NF == 13 { i = $1; letters = $2; for (k = 1; k <= 11; k++) lambda[k] = $(k + 2); next }
   { for (k = 1; k <= 11; k++) print i "," 5*k - 4 "," lambda[k] "e-3," $k "," branch[substr(letters, k, 1)] }' \
   tests/exact/prism_cycle_reference.txt > "$work/cycle.csv"
run_input prism_cycle && ask 'prism, cycle by NEWTON: branches, lambda and p of all increments' prism_cycle count 330 \
   with "$work/cycle.csv" on node=node1 on 'increment=increment + if(stage = 1, 0, if(stage = 2, 10, 19))' \
   all 'branch = other.branch and lambda = other.lambda within 6e-11 and pressure = other.pressure within 6e-9'

# STEP in N increments, the force of removed elements left or carried on: lambda at nodes 51 and 1, p at node 51.
while read -r deck carry lambda51 p51 lambda1; do
   n=${deck#prism}; n=${n#0}
   awk -v carry=$carry '/^SPC *=/ { print "CARRY = " carry } { print }' "input/$deck.bdf" > "$work/$deck-$carry.bdf"
   run $deck-$carry || continue
   near "$deck, CARRY = $carry: lambda at node 51" "$(cell $deck-$carry 1 $n 51 lambda)" $lambda51 1e-9
   near "$deck, CARRY = $carry: p at node 51" "$(cell $deck-$carry 1 $n 51 pressure)" $p51 1e-9
   near "$deck, CARRY = $carry: lambda at node 1" "$(cell $deck-$carry 1 $n 1 lambda)" $lambda1 1e-8
done <<'NUMBERS'
prism03 NO 9.406481683775e-03 5.430625377673e-01 5.574753640e-04
prism05 NO 7.620129133321e-03 5.740665043155e-01 1.997947828e-04
prism10 NO 6.921696612300e-03 5.881223029364e-01 9.610276495e-05
prism15 NO 6.775946175503e-03 5.915719573766e-01 -4.248301188e-05
prism03 YES 9.406481683775e-03 5.430625377673e-01 5.574753640e-04
prism05 YES 7.623208079227e-03 5.745246910784e-01 2.783349884e-05
prism10 YES 6.923194327295e-03 5.883795751953e-01 9.354505709e-06
prism15 YES 6.776378150497e-03 5.916506456159e-01 -7.218664389e-05
NUMBERS

# newton NAME PROGRESSION LINES: the prism by NEWTON in these increments, with LINES more of case control
newton() {
   awk -v p="$2" -v lines="$3" '/^METHOD/ { print; if (lines != "") print lines; next } /^SUBCASE/ { print; print "  INCR = 77"; next }
      /^ENDDATA/ { print "JINCR,77," p } { print }' input/prism_newton.bdf > "$work/$1.bdf"
   run "$1"
}

# In increments node 6 unloads on the way, so the answer is another one than in one increment, but the same for all of these.
newton ten 10,ARITH,0.1 '' && near 'prism, NEWTON in 10 equal increments: lambda at node 51' "$(cell ten 1 10 51 lambda)" 6.233944579875e-3 1e-10
for progression in 3,ARITH,0.05 5,ARITH,0.05 10,ARITH,0.05 15,ARITH,0.05; do
   newton way $progression '' &&
      near "prism, NEWTON in $progression: lambda at node 51" "$(cell way 1 ${progression%%,*} 51 lambda)" 6.233944579875e-3 1e-9
done

# TOL: how much of the load NEWTON may leave unbalanced.
for tolerance in 1.0E-3 1.0E-6 1.0E-12; do
   newton tolerance 10,ARITH,0.1 "TOL = $tolerance" || continue
   judge "TOL = $tolerance: unbalanced force at the end of each increment" -v tolerance=$tolerance '
      function close_increment() { if (last > tolerance * 80 * i) print "increment " i ": " last }
      /CONVERGENCE HISTORY/ { on = 1 }
      { gsub(/BELOW TOL/, "0") }
      on && NF == 7 && $1 ~ /^[0-9]+$/ {
         if (n && $1 != i) close_increment()
         i = $1; last = $5; n++
         refined[i] += $4 <= tolerance * 80 * i # once: the iteration that squares what TOL leaves
         if (refined[i] > 1) print "increment " i ": iterated on from " $4
      }
      / RESULTANTS/ { on = 0 }
      END { close_increment(); if (i != 10) print i " increments"; print "checked " n }' "$work/tolerance.out"
   iterations=$(awk '/CONVERGENCE HISTORY/ { on = 1 } / RESULTANTS/ { on = 0 } { gsub(/BELOW TOL/, "0") } on && NF == 7 && $1 ~ /^[0-9]+$/ { n++ } END { print n }' "$work/tolerance.out")
   [ $tolerance != 1.0E-3 ] && holds "TOL = $tolerance takes more iterations" "$iterations > $fewer"
   fewer=$iterations
   near "TOL = $tolerance: lambda at node 51" "$(cell tolerance 1 10 51 lambda)" 6.233944579875e-3 "$tolerance" 1e-12
done

# The paper's findings (section 6.1, Fig. 7), each from the joint histories of the four decks.

# at N NODE COLUMN: of the deck with N increments, after the last of them
at() { cell "prism$(printf '%02d' "$1")" 1 "$1" "$2" "$3"; }

for n in 03 05 10 15; do run_input prism$n && same_rows "prism$n: CARRY blank is NO" prism$n prism$n-NO 1e-15; done
rows=0
for n in 03 05 10 15; do rows=$((rows + $(value prism$n print 'count()'))); done
same '11 interface elements in every increment of every deck' $rows $((11 * (3 + 5 + 10 + 15)))
same 'prism05: node 1 is open' "$(at 5 1 branch)" OPEN
same 'prism05: node 6 is on the unloading branch' "$(at 5 6 branch)" UNLOAD
# the deflection of node 51 falls steadily as 3, 5, 10, 15 increments are used, much from 3 to 5, little from 10 to 15
set -- "$(at 3 51 lambda)" "$(at 5 51 lambda)" "$(at 10 51 lambda)" "$(at 15 51 lambda)"
holds 'deflection of node 51 falls with the increments' "$1 > $2 and $2 > $3 and $3 > $4"
holds 'it falls much from 3 to 5 and little from 10 to 15' "$1 - $2 > 5*($3 - $4)"
# the pressures of nodes 36 to 51 rise, those of nodes 6 to 26 fall or the node stays open
while read -r few many; do
   for node in 36 41 46 51 6 11 16 21 26; do
      ask "pressure of node $node from $few to $many increments" "prism$many" rows 'increment = max(increment)' rows "node1 = $node" \
         with "$work/prism$few.joint.csv" on node1 on increment=$few \
         all "if($node > 30, pressure > other.pressure, pressure < other.pressure or branch = \"OPEN\" and other.branch = \"OPEN\")"
   done
done <<'DECKS'
03 05
05 10
10 15
DECKS
# the joint carries every increment of the load in which no element was removed
for n in 03 05 10 15; do
   open_before=0 force_before=0 load_before=0
   for ((i = 1; i <= 10#$n; i++)); do
      read -r open force load <<< "$(value prism$n rows "increment = $i" print 'sum(branch = "OPEN")' print 'sum(force)' print load)"
      [ "$open" -gt $open_before ] || holds "prism$n, increment $i: joint force and load rise alike" \
         "$force - $force_before = 800*($load - $load_before) within 1e-10*800"
      open_before=$open force_before=$force load_before=$load
   done
done
