# Temperatures and springs; the closed formulas: manual/08_bolts_and_warmth.md.

# ---- a bolted joint of aluminium on steel, warmed and cooled ----

for warmth in 2000 -2000; do
   warm_columns skyline "$((warmth + 20))." SKYLINE && warm_columns columns "$((warmth + 20))." TREE || continue
   if "$query" "$work/columns.bolt.csv" with "$work/skyline.bolt.csv" all 'force = other.force within 1e-8' > "$work/said" 2>&1; then
      passed=$((passed + 1))
   else
      cat "$work/said"; fail "bolts of two columns, $warmth degrees: SKYLINE and TREE"
   fi
   ask "joint of two columns, $warmth degrees" columns rows 'stage = 2 and increment = 4' count 2 \
      all "sum(force) = 2*$(awk -F, '$1 == 2 && $2 == 4 { n = $5 } END { print n }' "$work/columns.bolt.csv") within 1e-8"
done

# ---- the flange of input/: what is warm bears on nothing but the joint and its bolt ----

if run_input flange_warm; then
   while IFS=, read -r stage increment force; do
      ask "flange, stage $stage, increment $increment: bolt and joint" flange_warm rows "stage = $stage and increment = $increment" \
         count 25 all "sum(force) = $force within 1e-6*$force"
   done < <(awk -F, 'FNR > 1 { print $1 "," $2 "," $5 }' "$work/flange_warm.bolt.csv")
   judge 'flange: supports and loads' '
      / BALANCE OF FORCES/ { on = 1 }
      on && /LOADS|UNBALANCED/ { checked++; if ($NF + $(NF - 1) + $(NF - 2) != 0) print }
      END { print "checked " checked }' "$work/flange_warm.out"
fi

# ---- springs to the ground: they stand in the balance ----

if two_springs springs; then
   same 'springs: the ground' "$(table springs 'BALANCE OF FORCES' | awk '/GROUND/ { print $(NF - 1), $NF } /UNBALANCED/ { print $(NF - 1), $NF }' | tr '\n' ' ')" \
      '-1.20000E+01 0.00000E+00 0.00000E+00 0.00000E+00 '
fi

# ---- rigid elements with ALPHA ----

# A block with a rigid face that expands as it does, held without force: no stress, u = A (T - TREF) x from node 1, and so moves the node off
# the face, by an RBAR another one. Without ALPHA the warning has the strain that the face holds, and the size.
grown() { # NAME ALPHA-AND-TREF
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;SUBCASE 1;TEMP(LOAD) = 7;INCR = 2;OUTPUT = ALL,STRESS
BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,20.0,0.0,0.0;GRID,3,,20.0,10.0,0.0;GRID,4,,0.0,10.0,0.0;GRID,5,,0.0,0.0,30.0;GRID,6,,20.0,0.0,30.0
GRID,7,,20.0,10.0,30.0;GRID,8,,0.0,10.0,30.0;GRID,9,,5.0,5.0,50.0;GRID,10,,15.0,5.0,70.0;CHEXA,1,1,1,2,3,4,5,6;+,7,8;PSOLID,1,1
MAT1,1,70000.0,,0.33,,2.3-5,20.0;RBE2,91,9,123,5,6,7,8;${2:++,$2};RBAR,92,9,10,123456,,,,${2:+2.3-5};${2:++,20.0};SPC1,1,123,1;SPC1,1,23,2;SPC1,1,3,4;TEMPD,7,120.0
JINCR,2,2,LIST,0.25,0.75;ENDDATA
DECK
   run "$1"
}
grown expands 2.3-5,20.0 && {
   judge 'a rigid face that expands: displacements' '
      / DISPLACEMENTS OF NODES, STAGE 1, INCREMENT/ { share = /INCREMENT 1/ ? 0.25 : 1; on = 1; next } / ROTATIONS|STRESSES/ { on = 0 }
      on && NF == 7 && $1 + 0 > 0 { for (c = 2; c <= 4; c++) if (($(c + 3) - share*2.3e-3*$c)^2 > 1e-12) print; checked++ }
      END { print "checked " (checked >= 10 ? checked : 0) }' "$work/expands.out"
   judge '... no stress' '/ STRESSES/ { on = 1; next } /^ [A-Z]/ { on = 0 } on && NF >= 10 && $1 + 0 > 0 { for (c = 5; c <= NF; c++) if ($c > 1e-6 || $c < -1e-6) print; checked++ }
      END { print "checked " checked }' "$work/expands.out"
   same '... no warning' "$(grep -c 'RBE2 91' "$work/expands.log")" 0
}
grown squeezes '' && says 'a rigid face that does not expand' "$work/squeezes.log" \
   'RBE2 91 holds nodes up to 20 apart, where the warm body beside them would expand by 0.046: a strain of 0.0023, E times which is a stress of 161;'
grown another 2.3-5,0.0 && says 'a rigid face that expands from another temperature' "$work/another.log" \
   'would expand by 0.0092 less than the RBE2: a strain of -4.6E-4, .*; its ALPHA 2.3E-5 and TREF 0 are not those of the body, 2.3E-5 and 20$'

# TREF left blank counts from 0, and is told.
cards from_zero <<'DECK'
SPC = 1;SUBCASE 1;TEMP(LOAD) = 7
BEGIN BULK;GRID,1,,0.0,0.0;GRID,2,,100.0,0.0;CROD,1,1,1,2;PROD,1,1,10.0;MAT1,1,1000.0,,0.25,,1.0-5;SPC1,1,12,1;SPC1,1,2,2;TEMPD,7,50.0;ENDDATA
DECK
run from_zero && {
   near 'TREF blank: from 0' "$(moved from_zero 2 1)" 0.05 1e-6
   says '... is told' "$work/from_zero.log" 'MAT1 1: TREF is blank, so that temperatures of 50 count from 0'
}

# An RBAR of 200 between a wall and a rod of 100, k = E A/L = 100, to another wall, warmed by 30: the rod has k (2E-5 x 200 + 1E-5 x 100) x 30.
# The same against a joint: the rod shortens by what the joint does not yield, k (0.12 - lambda) = a (lambda/c)^2, in STEP and NEWTON.
for method in STEP NEWTON; do
   cards walls <<DECK
METHOD = $method;SPC = 1;SUBCASE 1;TEMP(LOAD) = 7
BEGIN BULK;GRID,1,,0.0,0.0;GRID,2,,200.0,0.0;GRID,3,,300.0,0.0;RBAR,9,1,2,123456,,,12,2.0-5;+,20.0;GRID,4,,250.0,0.0;CROD,1,1,2,4;CROD,2,1,4,3;PROD,1,1,10.0
MAT1,1,1000.0,,0.25,,1.0-5,20.0;SPC1,1,126,1;SPC1,1,12,3;SPC1,1,2,4;TEMPD,7,50.0;ENDDATA
DECK
   run walls && near "a rod behind a rigid bar, $method" "$(table walls 'BOLT FORCES' | awk '$2 == 1 { print $5 }')" '-100*(2e-5*200 + 1e-5*100)*30' 1e-6
   cards pushes <<DECK
METHOD = $method;TOL = 1.0E-13;SPC = 1;SUBCASE 1;TEMP(LOAD) = 7;INCR = 3
BEGIN BULK;GRID,1,,0.0,0.0;GRID,2,,200.0,0.0;GRID,3,,300.0,0.0;RBAR,9,1,2,123456,,,12,2.0-5;+,20.0;CROD,1,1,2,3;PROD,1,1,10.0
MAT1,1,1000.0,,0.25,,0.0,20.0;SPC1,1,126,1;SPC1,1,2,3;CJOINT,5,1,3,,4.0,1.0,0.0;PJOINT,1,1,,,,,0.05;JNORM,1,8.0-3,0.5,1000.0;TEMPD,7,50.0
JINCR,3,400,,0.0025;ENDDATA
DECK
   run pushes && near "a rigid bar pushes a joint, $method" "$(value pushes rows 'increment = max(increment)' print lambda)" \
      "$(awk 'BEGIN { low = 0; high = 0.12; for (i = 0; i < 100; i++) { x = (low + high)/2; if (100*(0.12 - x) < 4*(x/8e-3)^2) high = x; else low = x } print x }')" \
      "$([ $method = STEP ] && echo 0.03 || echo 1e-5)"
done
# ... and a joint right at the dependent node: lambda is what the bar grows, and a rod beside it keeps an unknown.
cards at_joint <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;TEMP(LOAD) = 7;INCR = 3
BEGIN BULK;GRID,1,,0.0,0.0;GRID,2,,200.0,0.0;GRID,3,,300.0,0.0;RBAR,9,1,2,123456,,,12,2.0-6;+,20.0;CROD,1,1,2,3;PROD,1,1,10.0
MAT1,1,1000.0,,0.25,,0.0,20.0;SPC1,1,126,1;SPC1,1,2,3;CJOINT,5,1,2,,4.0,1.0,0.0;PJOINT,1,1,,,,,0.05;JNORM,1,8.0-3,0.5,1000.0;TEMPD,7,50.0
JINCR,3,4,ARITH;ENDDATA
DECK
run at_joint && ask 'a joint at the dependent node' at_joint all 'lambda = 0.012*load within 1e-12 and pressure = (lambda/8e-3)^2 within 1e-9'
