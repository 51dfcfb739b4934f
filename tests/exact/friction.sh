# The Coulomb limit.

# all 11 elements at the end: p, tau, delta, slip
pushed_evenly() { # WORDS NAME TAU DELTA SLIP
   ask "$1" "$2" rows 'stage = 2 and increment = 10' count 11 all "pressure = 0.5 within 5e-10 and slip = $5" \
      all "tau_x = $3 within 1e-9*$3 and delta_x = $4 within 1e-9*($4)"
}

for method in STEP NEWTON; do
   pushed_block sticks $method 1 0.99 && run sticks &&
      pushed_evenly "0.99 of the limit sticks, $method" sticks 0.099 3.96e-4 0
done
pushed_block slips STEP 0 1.01 && run slips && pushed_evenly '1.01 of the limit, not analysed again' slips 0.101 4.04e-4 1
# each re-analysis moves the block by the excess over k_s, and the excess stays
for nrean in 1 5; do
   pushed_block slips STEP $nrean 1.01 && run slips && {
      pushed_evenly "1.01 of the limit, $nrean re-analyses" slips 0.101 "4.04e-4 + $nrean*4e-6" 1
      judge "1.01 of the limit: $nrean re-analyses remove nothing" -v nrean=$nrean '
         /RE-ANALYSES AFTER|RE-ANALYS.*STAGE 2/ { on = 1 }
         on && $1 == 10 && NF == 6 { n++; if ($5 + 0 != 0 || $6 != 11) print }
         / RESULTANTS/ { on = 0 }
         END { if (n != nrean) print n " lines"; print "checked " n }' "$work/slips.out"
   }
done
pushed_block slides NEWTON 1 1.01 && run slides 3 && says '1.01 of the limit, NEWTON names a node' "$work/slides.log" 'node [0-9]'
pushed_block slides STEP -1 1.01 && run slides 3 && says '1.01 of the limit, STEP to the end names a node' "$work/slides.log" 'node [0-9]'

# No equilibrium at all: small blocks pushed beyond the limit or pulled off. Never a result.
small_block() { # NAME METHOD ELEMENTS PRESS PUSH STATUS: pressed by 100, then PRESS and PUSH; all loads spread over the base or the top
   awk -v method="$2" -v nx="$3" -v press="$4" -v push="$5" 'BEGIN {
      print "METHOD = " method "\nSUBCASE 1\n  LOAD = 1\nSUBCASE 2\n  LOAD = 2\nBEGIN BULK"
      print "BLOCK2,1,1," nx ",1,0.0,0.0\n+,10.0,10.0\n+,20\nPMARK,20\nPSHELL,1,1,10.0\nMAT1,1,9500.0,,0.0"
      print "JOINT,1,1,20\nPJOINT,1,1,1,,0.2,-1\nJNORM,1,8.0-3,0.5,9500.0\nJSHEAR,1,100.0,300.0"
      for (i = 0; i <= nx; i++) {
         w = (i % nx ? 1 : 0.5) / nx
         printf "FORCE,1,%d,,%.9f,0.0,-1.0\nFORCE,2,%d,,%.9f,0.0,-1.0\nFORCE,2,%d,,%.9f,1.0,0.0\n", 2 * i + 2, 100 * w, 2 * i + 2, press * w, 2 * i + 1, push * w
      }
      print "ENDDATA" }' > "$work/$1.bdf"
   run "$1" $6
}
for method in NEWTON STEP; do
   for elements in 1 2 5; do
      for push in 20.2 30.0 60.0; do
         name=pushed-$method-$elements-$push
         small_block $name $method $elements 100.0 $push 3 &&
            says "$elements elements pushed by $push of 20, $method: names a node" "$work/$name.log" 'node [0-9]'
      done
   done
done
# What no limit bears: the missing force is that of statics, and it is found in few iterations.
for push in 20.2 30.0 60.0; do
   small_block missing-$push NEWTON 5 100.0 $push 3 && near "5 elements pushed by $push of 20: missing" \
      "$(missing missing-$push)" "$push - 20" 1e-2
done
# Two blocks on each other, pressed by 1000; the upper one slips on the lower one at 150. In one increment: within 60 iterations.
stacked() { # NAME PUSH STATUS
   cards "$1" <<END
METHOD = NEWTON;SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 4;  INCR = 1
BEGIN BULK;BLOCK2,1,1,12,2,0.,0.;+,120.,20.;+,20,,21;BLOCK2,2,1,8,2,20.,20.;+,100.,30.,,,,,101,101;+,22,,23
PMARK,20;PMARK,21;PMARK,22;PMARK,23;PSHELL,1,1,10.;MAT1,1,210000.,,0.3;JOINT,1,1,20;JOINT,2,2,22,21
PJOINT,1,1,1,,0.3;PJOINT,2,1,1,,0.15;JNORM,1,8.-3,0.5,95000.;JSHEAR,1,1000.,3000.
FORCEM,1,1000.,0.,-1.,0.,23;FORCEM,2,1.,$2,0.,0.,23;LOAD,4,1.,1.,1,1.,2;JINCR,1,1;ENDDATA
END
   rm -f "$work/$1".*.csv "$work/$1".out
   "$program" -q -o "$work" --summary "$work/$1.summary" "$work/$1.bdf" > "$work/$1.log" 2>&1
   same "two blocks, pushed by $2 of 150: status" $? $3
}
for push in 300. 1350.; do
   stacked stacked-$push $push 3
   near "two blocks, pushed by $push of 150: missing" \
      "$(missing stacked-$push)" "$push - 150" 1e-2
   judge "two blocks, pushed by $push of 150: iterations" '
      BEGIN { FS = "," }
      NR == 1 { for (i = 1; i <= NF; i++) if ($i == "iterations") at = i; next }
      $at < 1 || $at > 60 { print $at " iterations" }
      END { print "checked " NR - 1 }' "$work/stacked-$push.summary"
done
stacked stacked-held 149. 0
# A gib of weight 50 between a bed and a slide that 1000 clamps. Springs hold the slide when it is pulled off: the gib falls, which the
# pull does not push.
for pull in 1000. 4000.; do
   cards gib-$pull <<END
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 5;  INCR = 1;SUBCASE 2;  LOAD = 4;  INCR = 1
BEGIN BULK;BLOCK2,1,1,6,1,0.,0.;+,60.,10.;+,20,,21;BLOCK2,2,1,6,1,0.,10.;+,60.,20.,,,,,101,101;+,22,,23
PMARK,20;PMARK,21;PMARK,22;PMARK,23;PSHELL,1,1,10.;MAT1,1,210000.,,0.3;JOINT,1,1,20;JOINT,2,1,22,21
PJOINT,1,1,1,,0.2;JNORM,1,8.-3,0.5,95000.;JSHEAR,1,1000.,3000.;SPCM,1,1,23;CELAS2,901,5000.,108,2;CELAS2,902,5000.,114,2
FORCEM,1,1000.,0.,-1.,0.,23;FORCEM,2,1.,0.,$pull,0.,23;FORCEM,3,50.,1.,0.,0.,21
LOAD,5,1.,1.,1,1.,3;LOAD,4,1.,1.,1,1.,2,1.,3;JINCR,1,1;ENDDATA
END
   run gib-$pull 3
   n=$(iterations gib-$pull 2)
   same "a gib falls, pull $pull: $n iterations, within 60" "$((n > 0 && n <= 60))" 1
   says "a gib falls, pull $pull: its joint and its weight, or what friction does not bear of it" "$work/gib-$pull.log" \
      'joint [12] .*: [345][0-9]\(\.[0-9]*\)\? of force are missing'
done
for elements in 1 2 5; do
   small_block pulled-$elements NEWTON $elements -1.0 0.0 3 && says "$elements elements pulled off, NEWTON: names a node" "$work/pulled-$elements.log" 'node [0-9]'
   small_block sticks NEWTON $elements 100.0 19.8 0 &&
      ask "$elements elements pushed by 0.99 of the limit, NEWTON" sticks rows 'stage = 2' \
         all 'sum(tau_x*area) = 19.8 within 1e-7 and sum(slip) = 0'
done

sides() { cell "$1" 2 1 1 "$2" 1; }

# which way x of the element and the normal of the spring point is not the matter here: sizes
size() { number "abs($(sides "$1" "$2"))"; }
sheared_spring spring STEP 5 13.86 && {
   near 'spring, 0.99: tau' "$(size spring tau_x)" 0.099 1e-12
   near 'spring, 0.99: delta' "$(size spring delta_x)" 3.96e-4 1e-12
   same 'spring, 0.99: sticks' "$(sides spring slip)" 0
}
sheared_spring spring STEP 5 14.14 && {
   same 'spring, 1.01: slips' "$(sides spring slip)" 1
   judge 'spring, 1.01: every re-analysis removes 28.57 per cent' '
      BEGIN { e = 0.1 }
      /RE-ANALYS.*STAGE 2/ { on = 1 }
      on && NF == 6 && $1 == 1 { n++; after = e * 5 / 7
         if ($5 != "28.57" || ($3 / e - 1)^2 > 1e-11 || ($4 / after - 1)^2 > 1e-11) print; e = after }
      / RESULTANTS/ { on = 0 }
      END { if (n != 5) print n " lines"; print "checked " n }' "$work/spring.out"
   near 'spring, 1.01: tau after five re-analyses' "$(size spring tau_x)" 0.10018593443208187 1e-12
   near 'spring, 1.01: delta after five re-analyses' "$(size spring delta_x)" 4.1214065567918144e-4 1e-12
}
sheared_spring spring STEP -1 14.14 && near 'spring, 1.01: excess gone' "$(size spring tau_x)" 0.1 2e-8
sheared_spring spring NEWTON 1 14.14 && {
   near 'spring, 1.01: NEWTON tau' "$(size spring tau_x)" 0.1 1e-9
   near 'spring, 1.01: NEWTON delta' "$(size spring delta_x)" 4.14e-4 1e-9
   same 'spring, 1.01: NEWTON slips' "$(sides spring slip)" 1
}
sheared_spring spring NEWTON 1 13.86 && {
   near 'spring, 0.99: NEWTON delta' "$(size spring delta_x)" 3.96e-4 1e-9
   same 'spring, 0.99: NEWTON sticks' "$(sides spring slip)" 0
}

# the points t_1 and t_1' of every pass: of 48 the first eight, and the last after a line of dots
sed 's/^METHOD = .*/METHOD = STEP/; s/^SUBCASE 2/&\n  OUTPUT = JOINT/; s/^\(PJOINT,1,1,1,,0.2\),.*/\1,-1,0.5/; s/^FORCE,12,1,.*/FORCE,12,1,,14.14,1.0/' "$work/spring.bdf" > "$work/spring_passes.bdf"
run spring_passes && {
   table spring_passes 'SLIPPING ELEMENTS BEFORE AND AFTER EACH RE-ANALYSIS' > "$work/passes"
   judge 'spring: deflection and stress before and after each re-analysis' '
      function size(a) { return a < 0 ? -a : a }
      function near(what, is, wanted) { if (size(size(is) - wanted) > 6e-6*wanted) print what " " is ", expected " wanted ": " $0 }
      $1 == "..." { dots++; if (last != 8) print "dots behind pass " last }
      $1 == 1 {
         n++; k = last = $2; f = 5/7
         near("DELTA", $6, 4.04e-4 + 1e-5*(1 - f^(k - 1))); near("DELTA AFTER", $9, 4.04e-4 + 1e-5*(1 - f^k))
         near("TAU", $7, 0.1 + 1e-3*f^(k - 1)); near("TAU AFTER", $10, 0.1 + 1e-3*f^k); near("LIMIT", $8, 0.1); near("LIMIT AFTER", $11, 0.1)
         if (k != n && n < 9) print "pass " k " in line " n
      }
      END { if (n != 9 || dots != 1 || last < 20) print n " rows, " dots " lines of dots, last pass " last; print "checked " n }' "$work/passes"
}

# NREAN -1: a foot in tension has the limit zero; each re-analysis reduces its excess, but never to zero. The other foot bears.
cards pulled_foot <<'END'
METHOD = STEP;MODEL = PLANE;SUBCASE 1;LOAD = 1;SUBCASE 2;LOAD = 2;BEGIN BULK
GRID,900,,50.,30.;GRID,1,,0.,0.;GRID,2,,100.,0.;RBE2,90,900,12,1,2;CELAS2,50,3.+4,900,1;CELAS2,51,1.+8,900,6
CJOINT,1,1,1,,2000.,0.,-1.;CJOINT,2,1,2,,200.,0.,-1.;PJOINT,1,1,1,,.2,-1,1.;JNORM,1,1.-3,1.,1.+3;JSHEAR,1,500.
FORCE,1,900,,1.,0.,-400.,0.;FORCE,2,900,,1.,40.,-400.,0.;MOMENT,2,900,,1.,0.,0.,-1.+5;ENDDATA
END
run pulled_foot && ask 'a pulled foot, NREAN -1: the other one is within its limit' pulled_foot rows 'stage = 2 and pressure > 0' \
   all 'abs(tau_x) <= 0.2*pressure*(1 + 1e-8)'

# The block of input/friction_once.bdf, NREAN 0, 1, 2, 5, against an independent computation.
for nrean in 0 1 2 5; do
   awk -v nrean=$nrean '/^PJOINT/ { $0 = "PJOINT,1,1,1,,0.2," nrean } { print }' input/friction_once.bdf > "$work/block$nrean.bdf"
   run block$nrean || continue
   ask "block pushed by 190, NREAN $nrean: p, tau, slip" block$nrean rows 'stage = 2 and increment = 10' count 11 \
      with tests/exact/friction_reference.csv on nrean=$nrean on node=node1 all 'slip = other.slip' \
      all 'lambda = other.lambda within 1e-8*lambda and pressure = other.pressure within 1e-8*pressure' \
      all 'delta_x = other.delta within 1e-8*abs(delta_x) and tau_x = other.tau within 1e-8*abs(tau_x)'
   [ $nrean = 0 ] && continue
   judge "block pushed by 190, NREAN $nrean: what each re-analysis removes" -v nrean=$nrean '
      function off(a, b) { return a != sprintf("%.5E", b) }
      FILENAME ~ /reference/ { split($0, v, ","); if (v[1] == nrean) { k = v[2] " " v[3]; before[k] = v[4]; after[k] = v[5]; passes++ }; next }
      /RE-ANALYS.*STAGE 2/ { on = 1 }
      on && NF == 6 && $1 ~ /^[0-9]+$/ {
         n++; k = $1 " " $2
         if (off($3, before[k]) || off($4, after[k]) || $5 != sprintf("%.2f", 100 * (1 - after[k] / before[k]))) print $0 ": " before[k], after[k]
      }
      / RESULTANTS/ { on = 0 }
      END { if (n != passes) print n " lines, not " passes; print "checked " n }' tests/exact/friction_passes_reference.csv "$work/block$nrean.out"
done

# Repeated until it is gone: no node beyond its limit by more than the tolerance, and the push is carried.
run_input friction_full && ask 'friction_full: excess gone, push carried' friction_full by stage by increment \
   all 'sum(max((abs(tau_x) - 0.2*pressure)*area, 0)) <= 1e-8*200' all 'sum(tau_x*area) = if(stage = 2, 190*load, 0) within 1e-7'

# PRESSURE = EQ10 with MU: the check takes the pressure that is printed, p = k_n lambda/a. One element beside a spring, pushed past its
# limit: what slips carries MU p, what sticks less; SUMF/a is 0.5 in every increment, and by it the limit would be 0.1.
cards eq10 <<'DECK'
METHOD = STEP;PRESSURE = EQ10;SUBCASE 1;  LOAD = 1;  INCR = 1
SUBCASE 2;  LOAD = 2;  INCR = 1
BEGIN BULK;GRID,7;CJOINT,1,1,7,,100.0,0.0,-1.0;CJOINT,2,2,7,,100.0,1.0,0.0;PJOINT,1,1,1,,0.2,-1,0.05
JNORM,1,8.0-3,0.5,500.0;JSHEAR,1,100.0,300.0;PJOINT,2,2,,,,,0.1;JNORM,2,0.1,1.0,10.0;FORCE,1,7,,50.0,0.0,-1.0
FORCE,9,7,,60.0,1.0,0.0;LOAD,2,1.0,1.0,1,1.0,9;JINCR,1,10,ARITH,0.1;ENDDATA
DECK
run eq10 && {
   judge 'EQ10 with MU: the limit is MU times the pressure of Eq. (10)' -F, '
      FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
      $(at["joint"]) != 1 { next }
      { p = $(at["k_n"]) * $(at["lambda"]) / 100; limit = 0.2 * $(at["pressure"]); tau = $(at["tau_x"])
        if (($(at["pressure"]) / p - 1)^2 > 1e-24 || ($(at["force"]) / (50 * ($1 == 1 ? $3 : 1)) - 1)^2 > 1e-24)
           print $1 "," $2 ": p " $(at["pressure"]) ", not " p ", force " $(at["force"]) }
      $1 == 2 { n++; if (limit > 0.15) high++; if ($(at["slip"])) { slips++; if ((tau / limit - 1)^2 > 1e-14) print $2 ": tau " tau ", limit " limit }
                else if (tau > limit) print $2 ": sticks with " tau ", limit " limit }
      END { if (n != 10 || high != 10 || slips < 2 || slips > 8) print n " rows, " slips " slip"; print "checked " n }' "$work/eq10.joint.csv"
   judge 'EQ10 with MU: LIMIT of the listing is MU P' '
      /INTERFACE ELEMENTS OF JOINT 1,/ { table = "P" } /SHEAR IN DIRECTION X OF JOINT 1,/ { table = "LIMIT" }
      table == "P" && $1 == 1 && NF > 9 { p = $9; table = "" }
      table == "LIMIT" && $1 == 1 && NF > 7 { n++; if (($8 / (0.2 * p) - 1)^2 > 1e-10) print "P " p ", LIMIT " $8; table = "" }
      END { if (n != 2) print n + 0 " lines"; print "checked " n }' "$work/eq10.out"
}

# Coarse plates, clamped on few nodes or evenly, pushed below the limit, released and pushed again: where the body expands nearly all nodes
# slip, some one way and some the other, and branches change many at once. There is an equilibrium, and NEWTON finds it.
coarse_plate() { # NAME SOLVER nx=.. ny=.. l=.. h=.. t=.. e=.. mu=.. law=.. shear=.. p0=.. press=node:force,.. push=node:force,.. stages=increments:push,..
   local name=$1 solver=$2 settings=()
   shift 2
   for setting; do settings+=(-v "$setting"); done
   awk -v solver="$solver" "${settings[@]}" 'BEGIN {
      print "METHOD = NEWTON\nSOLVER = " solver
      n = split(stages, stage, ",")
      for (i = 1; i <= n; i++) printf "SUBCASE %d\n  LOAD = %d\n  INCR = %d\n", i, 100 + i, 200 + i
      printf "BEGIN BULK\nBLOCK2,1,1,%d,%d,0.,0.\n,%.1f,%.1f\n,20\nPMARK,20\nPSHELL,1,1,%.1f\nMAT1,1,%.1f,,0.25\n", nx, ny, l, h, t, e
      printf "JOINT,1,1,20\nPJOINT,1,1,1,,%s,-1,%s\nJNORM,1,%s\nJSHEAR,1,%s\n", mu, p0, law, shear
      for (i = split(press, at, ","); i >= 1; i--) { split(at[i], part, ":"); printf "FORCE,1,%d,,%.9f,0.,-1.\n", part[1], part[2] }
      for (i = split(push, at, ","); i >= 1; i--) { split(at[i], part, ":"); printf "FORCE,2,%d,,%.9f,1.,0.\n", part[1], part[2] }
      for (i = 1; i <= n; i++) {
         split(stage[i], part, ":")
         printf "LOAD,%d,1.,1.,1,%.4f,2\nJINCR,%d,%d,ARITH,%.15f\n", 100 + i, part[2], 200 + i, part[1], 1 / part[1]
      }
      print "ENDDATA" }' > "$work/$name.bdf"
   run "$name" || return
   ask "$name, $solver: the joint bears what presses and pushes" "$name" rows "stage = $n_stages" rows 'increment = max(increment)' \
      all "sum(pressure*area) = $pressed within 1e-6*$pressed and sum(tau_x*area) = $pushed within 1e-6*$pressed"
}
for solver in SKYLINE TREE; do
   n_stages=2 pressed=1 pushed=0.045
   coarse_plate evenly $solver nx=8 ny=4 l=100 h=20 t=1 e=21000 mu=0.05 law=.01,.3,20000. shear=30.,0. p0=1. stages=3:0,1:1 \
      press=5:.0625,10:.125,15:.125,20:.125,25:.125,30:.125,35:.125,40:.125,45:.0625 push=5:.0225,45:.0225
   n_stages=4 pressed=20 pushed=0.6
   coarse_plate corner $solver nx=10 ny=1 l=100 h=100 t=20 e=1000 mu=0.15 law=.008,.33,1000. shear=1000.,300. p0= stages=2:0,5:1,5:-1,3:1 \
      press=12:6.666667,14:6.666667,20:6.666666 push=2:.6
   n_stages=4 pressed=100 pushed=19.6
   coarse_plate three $solver nx=6 ny=2 l=100 h=100 t=1 e=1000 mu=0.2 law=.001,.5,20000. shear=1000.,0. p0= stages=5:0,10:1,1:0,2:1 \
      press=9:33.333333,12:33.333333,15:33.333334 push=21:19.6
   n_stages=4 pressed=30000 pushed=23520
   coarse_plate lifted $solver nx=6 ny=3 l=300 h=100 t=20 e=9500 mu=0.8 law=.05,.5,9500. shear=1000.,300. p0= stages=1:0,10:1,10:0,1:1 \
      press=4:2500,8:5000,12:5000,16:5000,20:5000,24:5000,28:2500 push=4:23520
   n_stages=5 pressed=1 pushed=-0.025
   coarse_plate ends $solver nx=12 ny=1 l=100 h=20 t=1 e=1000 mu=0.05 law=.008,.33,9500. shear=1000.,0. p0= stages=1:0,2:1,1:-1,2:1,1:-1 \
      press=2:.5,26:.5 push=26:.025
done

# Slip erases what an element remembers: from the first slip on the two senses are mirror images, stiffnesses included, and what has slid
# comes back. One element beside a spring, its three shear cubics different, pushed beyond the limit to and fro.
for method in STEP NEWTON; do
   cards mirror <<DECK
METHOD = $method;SUBCASE 1;  LOAD = 10;SUBCASE 2;  LOAD = 20;  INCR = 1
SUBCASE 3;  LOAD = 30;  INCR = 1;SUBCASE 4;  LOAD = 20;  INCR = 1
BEGIN BULK;GRID,1,,0.,0.,0.;CJOINT,9,1,1,,1.0,0.,1.;PJOINT,1,1,1,,0.3,-1;JNORM,1,8.-3,0.5,5000.
JSHEAR,1,100.,5.,-1000.,0.,0.,0.;+,,200.,10.,3000.,0.,0.,0.;+,,180.,9.,-500.,0.,0.,0.;CELAS2,900,50.,1,1
FORCE,1,1,,10.,0.,-1.;FORCE,2,1,,6.,1.,0.;LOAD,10,1.,1.,1;LOAD,20,1.,1.,1,1.,2;LOAD,30,1.,1.,1,-1.,2
JINCR,1,12,ARITH,0.05;ENDDATA
DECK
   run mirror && {
      ask "$method, to and fro: it slips in both senses" mirror rows 'stage > 2 and increment = 12' count 2 all 'slip = 1'
      judge "$method, to and fro: mirror images from the first slip on" -F, '
         function off(what, a, b, scale) { if (!(a - b < 1e-7 * scale && b - a < 1e-7 * scale)) print "increment " $2 ": " what " " a ", " b }
         $1 == 3 { n++; branch[$2] = $17; delta[$2] = $18; tau[$2] = $19; k[$2] = $20; slid[$2] = $26; next }
         $1 == 4 {
            if ($17 != branch[$2]) print "increment " $2 ": " $17 " and " branch[$2]
            off("delta", $18, -delta[$2], 0.06); off("tau", $19, -tau[$2], 3); off("k", $20, k[$2], 400)
            n++; back = $26 }
         $1 == 2 { first = $26 }
         END { off("slid", back, first, 0.1); if (n != 24) print n " rows"; print "checked " n }' "$work/mirror.joint.csv"
   }
done

# Shear without MU drops at once where an element opens: said once, where one has opened that NEWTON iterates, in STEP only under gaps
# and interference; not where none opens. tells_drop NAME TIMES METHOD MU GAP PULL: pressed, then pulled off at an angle
drop_said='without MU on PJOINT has opened'
tells_drop() {
   cards "$1" <<DECK
METHOD = $3;SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2;BEGIN BULK;GRID,1;CJOINT,1,1,1,,100.,0.,-1.;PJOINT,1,1,1,,$4,,.5;JNORM,1,8.0-3,0.5,500.
JSHEAR,1,100.;CELAS2,11,10.,1,1;CELAS2,12,10.,1,2;FORCE,1,1,,50.,0.,-1.;FORCE,2,1,,$6,.1,1.;JGAP,1,CONST,$5;ENDDATA
DECK
   run "$1" && same "$1: shear without MU that drops, said" "$(grep -c "JOINT 1, node 1: .*$drop_said" "$work/$1.log")" "$2"
}
tells_drop drops_newton 1 NEWTON '' 0. 100.
tells_drop drops_friction 0 NEWTON 0.3 0. 100.
tells_drop drops_pressed 0 NEWTON '' 0. -40.
tells_drop drops_step 0 STEP '' 0. 100.
tells_drop drops_step_apart 0 STEP '' 0.01 10.
same 'shear without MU, nothing opens: not said' "$("$program" -q -o "$work" input/two_blocks.bdf 2>&1 | grep -c "$drop_said")" 0

# A point on springs slides along x, and then its load turns towards y: the stress follows the turn. The error falls with the square of the
# number of increments, and by default is within PATHTOL. In the limit f = k u + a l n and l dn/dx = e - n (n . e), which is integrated here.
turned_push() { # NAME CONTROL [INCREMENTS]
   cards "$1" <<DECK
METHOD = NEWTON;MODEL = SPACE;${2}SUBCASE 1;  INCR = 8;  LOAD = 1;SUBCASE 2;  LOAD = 2;$([ -n "${3:-}" ] && echo '  INCR = 9;')BEGIN BULK
GRID,5,,1.,2.,3.;CJOINT,8,1,5,,50.,0.,0.,-1.;PJOINT,1,1,1,1,.3;JNORM,1,2.-4,1.,5000.;JSHEAR,1,1600.
CELAS2,11,20000.,5,1;CELAS2,12,20000.,5,2;CELAS2,13,1000.,5,3;JINCR,8,1;JINCR,9,${3:-1},ARITH,$(awk "BEGIN { printf \"%.15f\", 1/${3:-1} }")
FORCE,1,5,,400.,0.,0.,-1.;FORCE,1,5,,300.,1.,0.,0.;FORCE,2,5,,400.,0.,0.,-1.;FORCE,2,5,,300.,1.,0.,0.;FORCE,2,5,,300.,0.,1.,0.;ENDDATA
DECK
   run "$1"
}
turn_errors=()
for increments in 4 8 16; do
   turned_push turned "" $increments && turn_errors+=("$("$query" "$work/turned.joint.csv" rows 'stage = 2' rows "increment = $increments" print 'delta_y')")
done
turned_push turned_default "" && turn_errors+=("$("$query" "$work/turned_default.joint.csv" rows 'stage = 2' print 'delta_y')")
turn_p=$("$query" "$work/turned.joint.csv" rows 'stage = 2' rows 'increment = 16' print pressure)
judge "slip turns with the load: ${turn_errors[*]}" -v p="$turn_p" -v movements="${turn_errors[*]}" '
   # f = 20000 u + 50 l n; n at an angle b; over the load s from 0 to 1: 20000 (ux, uy) = f - 50 l (cos b, sin b), l db = 1600 (uy cos b - ux sin b)
   # so l (1 + 50*1600/20000) db = 1600/20000 dfy cos b
   BEGIN { l = 0.3*p; b = 0; n = 20000; h = 1/n
      for (i = 0; i < n; i++) { r1 = rate(b); r2 = rate(b + h*r1/2); r3 = rate(b + h*r2/2); r4 = rate(b + h*r3); b += h*(r1 + 2*r2 + 2*r3 + r4)/6 }
      u = (300 - 50*l*sin(b))/20000; split(movements, m, " ")
      for (i = 1; i <= 4; i++) e[i] = (-m[i] - u)/u
      if (e[1]^2 > 1e-4 || e[2]^2 > (0.3*e[1])^2 || e[3]^2 > (0.3*e[2])^2 || e[4]^2 > 1e-6) print e[1] " " e[2] " " e[3] ", by default " e[4]
      print "checked 1"; exit }
   function rate(b) { return 1600/20000*300*cos(b)/(l*(1 + 50*1600/20000)) }'

# ---- A block that slides on as a whole against a spring: the tangents of the sliding joint lead from an increment to the next. All nodes
# slide from increment 7 on, until in 18 and 19 two of them open; the force of the joint is 0.2*2000, the spring takes the rest
cards slides_on <<'DECK'
METHOD = NEWTON;MODEL = PLANE;SUBCASE 1;  LOAD = 10;SUBCASE 2;  LOAD = 20;  INCR = 3;BEGIN BULK
BLOCK2,1,1,8,2,0.0,0.0;+,100.0,20.0;+,14,,12;PMARK,12;PMARK,14;PSHELL,1,1,10.0;MAT1,1,2.1+5,,0.3
JOINT,1,1,14;PJOINT,1,1,2,,0.2;JNORM,1,1.0-3,0.5,2.0+4;JSHEAR,2,5.0+3;JINCR,3,20;CELAS2,71,1000.0,3,1
PLOADM,9,2.0,12;FORCE,19,27,,2000.0,1.0,0.0;LOAD,10,1.0,1.0,9;LOAD,20,1.0,1.0,9,1.0,19;ENDDATA
DECK
run slides_on && {
   ask 'sliding on: all nodes are at mu p' slides_on rows 'stage = 2 and increment = 20' all 'tau_x = 0.2*pressure within 1e-6'
   ask 'sliding on: the joint bears mu N' slides_on rows 'stage = 2 and increment = 20' all 'sum(tau_x*area) = 0.2*2000 within 1e-4'
   same 'sliding on: one iteration an increment' \
      "$(awk '/CONVERGENCE HISTORY/ { on = 1; next } /RESULTANTS/ { on = 0 } on && $1 >= 7 && $1 <= 17 && $3 > 1' "$work/slides_on.out")" ''
}

# BACK with two shear laws, 100 and 1000: below the limit of 30 of the resultant nothing slips; beyond it, beside springs of 50, both
# stresses are cut in proportion
for push in 9 40; do
   cards back_cut <<< "METHOD = BACK;MODEL = SPACE;SUBCASE 1;LOAD = 1;BEGIN BULK;GRID,1,,0.,0.,0.;CJOINT,1,1,1,,1.,0.,0.,1.;PJOINT,1,1,1,2,.3
JNORM,1,8.-3,.5,9500.;JSHEAR,1,100.;JSHEAR,2,1000.;CELAS2,8,50.,1,1;CELAS2,9,50.,1,2;FORCE,1,1,,1.,$push.,$push.,-100.;ENDDATA"
   run back_cut || continue
   set -- $("$query" "$work/back_cut.joint.csv" rows 'stage = 1' print 'abs(tau_x)') $("$query" "$work/back_cut.joint.csv" rows 'stage = 1' print 'abs(tau_y)') \
      $("$query" "$work/back_cut.joint.csv" rows 'stage = 1' print 'abs(delta_x)') $("$query" "$work/back_cut.joint.csv" rows 'stage = 1' print 'abs(delta_y)')
   if [ $push = 9 ]; then
      near 'BACK below the limit of the resultant: delta x' $3 9/150 1e-9
      near 'BACK below the limit of the resultant: delta y' $4 9/1050 1e-9
      same 'BACK below the limit of the resultant: slip' "$(cell back_cut 1 1 1 slip)" 0
   else
      near 'BACK beyond the limit: resultant' "sqrt($1*$1 + $2*$2)" 30 1e-4
      near 'BACK beyond the limit: direction' "$1*1000*$4" "$2*100*$3" 1e-4
      same 'BACK beyond the limit: slip' "$(cell back_cut 1 1 1 slip)" 1
   fi
done

# MU without a law of shear has no effect, and a warning says so
cards without_shear <<< "METHOD = NEWTON;MODEL = PLANE;SUBCASE 1;LOAD = 1;BEGIN BULK;GRID,1,,0.,0.,0.,,1;CJOINT,1,1,1,,1.,0.,1.;PJOINT,1,1,,,.3
JNORM,1,8.-3,.5,9500.;FORCE,1,1,,1.,0.,-100.;ENDDATA"
run without_shear && says 'MU without a law of shear' "$work/without_shear.log" 'joint 1: MU has no effect, because the joint has no law of shear'
