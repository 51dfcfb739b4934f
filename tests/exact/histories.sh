# Load histories: loops and their energy, joints that open and close again, ranges left.

# The shear loop of Masing: energy of a cycle -(4/3) a2 d0**3 - 2 a3 d0**4, times a; the end of each stage by hand.
run_input shear_loop && {
   near 'shear loop: pushed to d0' "$(cell shear_loop 2 10 1 delta_x)" 0.01 1e-9
   near 'shear loop: pushed back to -d0' "$(cell shear_loop 3 20 1 delta_x)" -0.01 1e-9
   near 'shear loop: pushed again to d0' "$(cell shear_loop 4 20 1 delta_x)" 0.01 1e-9
   kept=$(awk '/ENERGY OF JOINTS, STAGE [34]/ { for (i = 1; i <= 5; i++) getline; kept += $NF } END { print kept }' "$work/shear_loop.out")
   near 'shear loop: energy of the cycle from the listing' "$kept" 0.20666667 2e-5
   put_in=$(awk '/ENERGY OF JOINTS, STAGE 2/ { for (i = 1; i <= 5; i++) getline; print $5 }' "$work/shear_loop.out")
   near 'shear loop: work of the first push' "$put_in" 0.2908333 2e-6
}

# The loop closes at the mirror of A, whatever rounding says of the last digit there: at -d0 the loading of the other sense begins, and
# from there its own unloading branch leads back. So delta at one and the same load is the same for any number of increments.
back=$(awk 'function B(d) { return 52.25 * d + 775 * d^2 + 7500 * d^3 }
   BEGIN { low = 0; high = 0.01
      for (i = 0; i < 100; i++) { d = (low + high) / 2; if (0.53 - B(0.01) + B(d) > 0.318) high = d; else low = d }
      printf "%.12e", -d }')
for n in 5 10 15 20 25 40 50; do
   awk -v n=$n '/^JINCR +20/ { printf "JINCR,20,%d,ARITH,%.9f\n", n, 1 / n; next } { print }' input/shear_loop.bdf > "$work/loop.bdf"
   run loop || continue
   # a fifth of the way back the force is -31.8: 0.53 - B(d0) + B(d) = 0.318 on the mirror of the unloading branch
   near "shear loop in $n increments: a fifth of the way back from -d0" "$(cell loop 4 $((n / 5)) 1 delta_x)" $back 1e-7
   same "shear loop in $n increments: branch there" "$(cell loop 4 $((n / 5)) 1 branch_x)" UNLOAD
done

# ORIGIN BRANCH with B = C = 2 A(d/2), A = 60 d - 2500 d^2 + 5E4 d^3 at p = 0.5, all coefficients growing with p: loads A(d)*100 for d = 0.003,
# 0.006, 0.009 and their opposites. Each cycle ends where it began, at growing and falling amplitude, by both methods; its energy from the
# listing is -(4/3) a2 d^3 - 2 a3 d^4, times a.
masing_cycles origin NEWTON 7 BRANCH
run origin && {
   near 'ORIGIN BRANCH: closure' "$(awk '/^ +CLOSURE/ { print $2 }' "$work/origin.out")" 0 1e-6
   says 'ORIGIN BRANCH: the listing says so' "$work/origin.out" 'ORIGIN BRANCH: D OF UNLOAD AND RELOAD COUNTS FROM THEIR START'
   for i in 1 2 3; do
      for k in 1 2 3; do
         near "ORIGIN BRANCH: delta at the end of stage $((3*i + k - 2))" "$(cell origin $((3*i + k - 2)) 7 1 delta_x)" $((k == 2 ? -1 : 1))*0.003*$i 1e-8
      done
      kept=$(awk -v s=$((3*i - 0)) '$0 ~ "ENERGY OF JOINTS, STAGE (" s "|" s + 1 ")([^0-9]|$)" { for (i = 1; i <= 5; i++) getline; kept += $NF } END { print kept }' "$work/origin.out")
      near "ORIGIN BRANCH: energy of the cycle to 0.003*$i" "$kept" "100*((4/3)*2500*(0.003*$i)^3 - 2*5e4*(0.003*$i)^4)" 1e-5
   done
}
for n in 40 160; do
   masing_cycles origin_step STEP $n BRANCH
   run origin_step || continue
   near "ORIGIN BRANCH: STEP in $n increments tends to the same" "$(cell origin_step 10 $n 1 delta_x)" 0.009 "8/$n"
done
masing_cycles origin_curve NEWTON 7 CURVE
run origin_curve && same 'ORIGIN CURVE: another path' "$(cmp -s "$work/origin.joint.csv" "$work/origin_curve.joint.csv" || echo other)" other
sed 's/,CURVE$//' "$work/origin_curve.bdf" > "$work/origin_blank.bdf"
run origin_blank && same 'ORIGIN blank is CURVE' "$(cksum < "$work/origin_blank.joint.csv")" "$(cksum < "$work/origin_curve.joint.csv")"
# a law that unloads less steeply than it was loaded: warned of at the slopes where the branch begins
sed 's/^+,50.,20.,-1000.*$/+,30.,10.,0.,0.,0.,0./' "$work/origin.bdf" > "$work/origin_soft.bdf"
run origin_soft && says 'ORIGIN BRANCH: soft unloading' "$work/origin_soft.out" 'UNLOADING IS LESS STEEP THAN LOADING'

# k_b = E a/h = 1000 x 100/50 a node; a = 100
reopen reopen STEP && judge 'opens and closes again, STEP' -F, '
   FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
   function law() {   # branch and stiffness after an increment, section 4 of the paper; the questions one after another
      if (branch == "LOAD") { if (s < before) { la = l_before; branch = "UNLOAD" } }
      else if (branch == "UNLOAD") { if (s > before) branch = "RELOAD" }
      else if (branch == "RELOAD") { if (s < before) branch = "UNLOAD" }
      else if (l >= lb) branch = "RELOAD"
      if (branch == "UNLOAD" && s <= 0) { branch = "OPEN"; lb = l; s = 0 }
      if (branch == "RELOAD" && l >= la) branch = "LOAD"
      kn = branch == "OPEN" ? 0 : branch == "LOAD" ? sqrt(s / 100) * 100 / 4e-3 : 50000
      if (branch == "LOAD" && s == 0) kn = l / 8e-3 * a / 4e-3   # closed past A, nothing on it yet: the curve at its deflection
   }
   BEGIN { a = 100; kb = 2000; branch = "LOAD"; kn = sqrt(0.05) * a / 8e-3; split("100 -40 150", load, " ") }
   $(at["node1"]) == 1 {
      n++; before = s; l_before = l
      d = (load[$1] - load[$1 - 1]) / 8 / (kb + kn); l += d; s += kn * d; law(); seen[branch]++
      if (branch == "OPEN") opened = 1
      if (branch == "LOAD" && opened) again = 1
      if (($(at["lambda"]) - l)^2 > 1e-20 || ($(at["force"]) - s)^2 > 1e-14 || $(at["branch"]) != branch)
         print $1 "," $2 ": " $(at["lambda"]), $(at["force"]), $(at["branch"]) ", not " l, s, branch
   }
   END { if (n != 24 || !seen["OPEN"] || !seen["UNLOAD"] || !again) print n " rows, open " seen["OPEN"]; print "checked " n }' "$work/reopen.joint.csv"

reopen reopen NEWTON && judge 'opens and closes again, NEWTON' -F, '
   FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
   function p(l) { return l >= la ? (l > 0 ? (l / 8e-3)^2 : 0) : (pa - 500 * (la - l) > 0 ? pa - 500 * (la - l) : 0) }
   BEGIN { split("100 -40 150", load, " ") }
   $(at["node1"]) == 1 {
      n++; f = load[$1 - 1] + (load[$1] - load[$1 - 1]) * $3
      low = -1; high = 1
      for (i = 0; i < 200; i++) { l = (low + high) / 2; if (2000 * l + 100 * p(l) > f) high = l; else low = l }
      now = p(l); was = branch
      branch = l >= la ? "LOAD" : now <= 0 ? "OPEN" : l > before ? "RELOAD" : "UNLOAD"
      if (l >= la) { la = l; pa = now }
      before = l; seen[branch]++
      if (was == "RELOAD" && branch == "LOAD") again = 1
      if (($(at["lambda"]) - l)^2 > 1e-22 || ($(at["pressure"]) - now)^2 > 1e-18 || $(at["branch"]) != branch)
         print $1 "," $2 ": " $(at["lambda"]), $(at["pressure"]), $(at["branch"]) ", not " l, now, branch
   }
   END { if (n != 24 || !seen["OPEN"] || !seen["UNLOAD"] || !again) print n " rows, open " seen["OPEN"]; print "checked " n }' "$work/reopen.joint.csv"

# One element under shear: STEP is the sum of tangents, each at the pressure and the place reached; a softening cubic stops at slope 0.
cards range <<'DECK'
METHOD = STEP;SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2;  INCR = 1
BEGIN BULK;GRID,7;CJOINT,1,1,7,,100.0,0.0,-1.0
$ a spring of 1000 along x holds what the joint does not
CJOINT,2,2,7,,100.0,1.0,0.0;PJOINT,1,1,1,,,,0.5;JNORM,1,8.0-3,0.5,500.0;JSHEAR,1,20.0,100.0,-4.0+3,0.0;+;+;+,0.6,0.006
PJOINT,2,2,,,,,0.1;JNORM,2,0.1,1.0,10.0;FORCE,1,7,,50.0,0.0,-1.0;FORCE,9,7,,60.0,1.0,0.0;LOAD,2,1.0,1.0,1,1.0,9
JINCR,1,10,ARITH,0.1;ENDDATA
DECK
slope='if(100*(70 - 8000*before(delta_x)) > 0, 100*(70 - 8000*before(delta_x)), 0)'
run range && {
   ask 'a softening cubic: tangents by hand, never below zero' range rows 'stage = 2 and joint = 1' count 10 all 'min(k_sx) = 0' \
      all "k_sx = $slope within 1e-5 and delta_x = before(delta_x) + 6/(1000 + $slope) within 1e-10" \
      all "tau_x = before(tau_x) + $slope/100*6/(1000 + $slope) within 1e-8"
   first=$(value range rows 'stage = 2 and joint = 1 and delta_x > 0.006' print 'first(increment)' print 'last(delta_x*1000)')
   judge 'range left: a line a bound names elements, first increment, worst p and d' -v first="$first" '
      /WARNING: JOINT 1.*BEYOND D = 0.006/ {
         n++; split(first, v, " ")
         if ($0 !~ "STAGE 2: 1 ELEMENT BEYOND.*, FIRST NODE 7 .INCREMENT " v[1] "., WORST 7: ") print
         p = $0; sub(/.*: P = /, "", p); d = $0; sub(/.*, D = /, "", d)
         if ((p / 0.5 - 1)^2 > 1e-9 || (d * 1000 / v[2] - 1)^2 > 1e-9) print p, d ", not 0.5", v[2] / 1000
      }
      END { if (n != 1) print n + 0 " warnings"; print "checked " n }' "$work/range.out"
}
# p beyond PMAX, and within both no warning
sed 's/^+,0.6,0.006/+,0.4,0.1/' "$work/range.bdf" > "$work/range_p.bdf"
run range_p && says 'range of p left' "$work/range_p.out" 'WARNING: JOINT 1, STAGE 1: 1 ELEMENT BEYOND P = 0.4 OF THE SHEAR LAW, FIRST NODE 7 (INCREMENT 1)'
sed 's/^+,0.6,0.006/+,0.6,0.1/' "$work/range.bdf" > "$work/range_in.bdf"
run range_in && {
   same 'within the range no warning of it' "$(grep -c 'ELEMENT BEYOND' "$work/range_in.out")" 0
   says 'but one that the slope is lost' "$work/range_in.out" 'WITHOUT A POSITIVE SLOPE OF THE SHEAR LAW'
}

# Shear under a pressure that rises, one increment a curve (Fig. 4b), by hand: k_s of each increment at the pressure before it.
before='before(pressure)' d='before(delta_x)'
slope="100*(20 + 100*$before - 2*(1000 + 2000*$before)*$d + 3*(10000 + 40000*$before)*$d^2)"
run_input shear_pressure && ask 'shear under rising pressure, STEP' shear_pressure \
   all "stage != 2 or k_sx = $slope within 1e-10*k_sx and delta_x = $d + 2/($slope) within 1e-10*delta_x" rows 'stage = 2' count 10

# The first increment of an element is the first that reaches it: two elements with the same p, one loaded a stage later, and
# a stage without load before all others.
late() { # NAME STAGES-BEFORE
   cards "$1" <<DECK
$2SUBCASE 5;  LOAD = 1;  INCR = 1;SUBCASE 6;  LOAD = 2;  INCR = 1
BEGIN BULK;GRID,1,,0.0,0.0,0.0,,1;GRID,2,,10.0,0.0,0.0,,1;CJOINT,1,1,1,,100.0,0.0,1.0,0.0
CJOINT,2,2,2,,100.0,0.0,1.0,0.0;PJOINT,1,1,,,,,0.1;PJOINT,2,1,,,,,0.1;JNORM,1,8.0-3,0.5,9500.0
FORCE,1,1,,100.0,0.0,-1.0;FORCE,2,1,,100.0,0.0,-1.0;FORCE,2,2,,100.0,0.0,-1.0;JINCR,1,10,ARITH,0.1;ENDDATA
DECK
}
for before in '' 'SUBCASE 1
'; do
   late late "$before"
   run late && ask 'an element loaded a stage later goes the same way' late rows 'stage = 6 and increment = 10' count 2 \
      all 'lambda = 8.4809379e-3 within 8e-9' all 'lambda = first(lambda) within 8e-15'
done

# NORM asks its questions of the state that is reached (STEP). An element beside a bar of 8000, as a glue that does not let go would be
# seen: pressed by 100, then pulled by 200 in two increments of 150. By hand, a = 100, c = 8E-3, m = 0.5, P0 = 1, E_u = 9500:
#    1: k = sqrt(1) a/c = 12500,             d = 100/20500,      lambda = 4.878048780E-3,   force 60.97560976
#    2: k = 2 sqrt(.6097560976) a/c = 19521.72, d = -150/27521.72, lambda = -5.721919281E-4, force -45.42246458: found falling
#       from the loading curve and in tension in one call, it is removed at once; the tension is left unbalanced
#    3: the bar alone,                       d = -150/8000,      lambda = -1.932219193E-2,   force 0
cards glued <<'DECK'
SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2;  INCR = 2
BEGIN BULK;GRID,1,,0.0,0.0,,,1;GRID,2,,0.0,10.0,,,12;CROD,2,1,1,2;PROD,1,1,10.0;MAT1,1,8000.0,,0.0
CJOINT,1,1,1,,100.0,0.0,-1.0;PJOINT,1,1,,,,,1.0;JNORM,1,8.0-3,0.5,9500.0;FORCE,1,1,,100.0,0.0,-1.0
FORCE,2,1,,-200.0,0.0,-1.0;JINCR,2,2,ARITH,0.5;ENDDATA
DECK
run glued && {
   near 'pulled off a bar: pressed, lambda' "$(cell glued 1 1 1 lambda)" 4.878048780487805e-3 1e-12
   near 'pulled off a bar: pressed, force' "$(cell glued 1 1 1 force)" 60.97560975609756 1e-12
   same 'pulled off a bar: opens in the increment that makes it pull' "$(cell glued 2 1 1 branch)" OPEN
   near 'pulled off a bar: lambda there' "$(cell glued 2 1 1 lambda)" -5.721919280627617e-4 1e-12
   near 'pulled off a bar: lambda at the end' "$(cell glued 2 2 1 lambda)" -1.932219192806276e-2 1e-12
   near 'pulled off a bar: stiffness of the last increment' "$(cell glued 2 2 1 k_n)" 0 0
   judge 'pulled off a bar: nothing of tension is ever carried' -F, '
      FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
      { n++; if ($(at["force"]) < 0 || $(at["pressure"]) < 0) print $1 "," $2 ": " $(at["force"]), $(at["pressure"]) }
      END { if (n != 3) print n " rows"; print "checked " n }' "$work/glued.joint.csv"
   says 'pulled off a bar: what it pulled with is left unbalanced' "$work/glued.out" '  4.542E+01$'
}

# Reloaded past A: one increment to p = 1, one down to 0.8, two up to 3; E_u = 500. By hand, lambda_A = c sqrt(1) = 8E-3:
#    down:     k = 2 sqrt(1) a/c = 25000,    lambda = 8E-3 - 20/25000 = 7.2E-3
#    up, 1:    k = E_u a = 50000,            lambda = 7.2E-3 + 110/50000 = 9.4E-3, past A and force 190: on the loading curve
#    up, 2:    k = 2 sqrt(1.9) a/c = 34460.12188,  lambda = 9.4E-3 + 110/34460.12188 = 1.259209550E-2
cards past_a <<'DECK'
SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2;SUBCASE 3;  LOAD = 3;  INCR = 2
BEGIN BULK;GRID,1,,0.0,0.0,,,1;CJOINT,1,1,1,,100.0,0.0,-1.0;PJOINT,1,1;JNORM,1,8.0-3,0.5,500.0
FORCE,1,1,,100.0,0.0,-1.0;LOAD,2,0.8,1.0,1;LOAD,3,3.0,1.0,1;JINCR,2,2,ARITH,0.5;ENDDATA
DECK
run past_a && {
   near 'reloaded past A: relieved' "$(cell past_a 2 1 1 lambda)" 7.2e-3 1e-12
   same 'reloaded past A: relieved' "$(cell past_a 2 1 1 branch)" UNLOAD
   near 'reloaded past A: up the line' "$(cell past_a 3 1 1 lambda)" 9.4e-3 1e-12
   same 'reloaded past A: past it at once' "$(cell past_a 3 1 1 branch)" LOAD
   near 'reloaded past A: the second increment has the tangent of the loading curve' "$(cell past_a 3 2 1 k_n)" 34460.121880225546 1e-12
   near 'reloaded past A: lambda at the end' "$(cell past_a 3 2 1 lambda)" 1.2592095500484053e-2 1e-12
}

# ---- two leaves that slide under a constant pressure and move a million times the deflection of their joint: the rounding of the
# displacements takes no element from its loading curve
for tip in 41.0 57.0; do
   sed "s/^FORCEM  19      20.0 /FORCEM  19      $tip /" input/two_leaves.bdf > "$work/leaves.bdf"
   run leaves && ask "leaves under $tip: every element stays on its loading curve" leaves all 'branch = "LOAD"'
done
# ... in one increment a stage: what the rounding of the displacements leaves unbalanced, a thousandth of a millionth of the load, keeps no
# increment from its end; under a constant limit the answer does not hang on the increments
sed 's/^  LOAD = .*/&\n  INCR = 77/; s/^ENDDATA/JINCR,77,1\nENDDATA/' "$work/leaves.bdf" > "$work/whole.bdf"
run whole && {
   holds 'leaves in one increment: few iterations' \
      "$(awk '/CONVERGENCE HISTORY/ { p = 1 } /RESULTANTS/ { p = 0 } p && /E[-+]/' "$work/whole.out" | grep -c .) < 25"
   ask 'leaves in one increment: the answer' whole with "$work/leaves.joint.csv" all 'tau_x = other.tau_x within 1e-6*max(abs(tau_x))'
}
