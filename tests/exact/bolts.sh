# What a bolt bears of a load, and what its joint keeps: closed forms of springs beside each other.
of_bolt() { "$query" "$work/$1.bolt.csv" rows "stage = $2 and bolt = $3" rows "increment = max(increment)" print "$4"; }

# clamped NAME E FX FY [CARDS]: two columns, each 10 x 10 x 2, nu = 0, on each other, linear joint of 1/c = 50 between them; tied together at x = 0 and
# 10 by bolts of k_b = 200 x 2/20 = 20 while 40 presses on each node of the top, the second tightened in a stage of its own; then FX and FY on
# each of these nodes, and half of it again.
clamped() {
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;LOAD = 30;SUBCASE 1;SUBCASE 2;SUBCASE 3;  LOAD = 10;  INCR = 5;SUBCASE 4;  LOAD = 20
BEGIN BULK;MAT1,1,$2,,.0;MAT1,2,200.,,.0;+,100.;PSHELL,1,1,2.;BLOCK2,1,1,1,1,0.,0.;+,10.,10.;+,20,,21
BLOCK2,2,1,1,1,0.,10.;+,10.,20.,,,,,101,101;+,,,,,1;PMARK,20;PMARK,21;SPCM,1,12,20
JOINT,1,1,21;PJOINT,1,1,1,,.5;JNORM,1,.02,1.,50.;JSHEAR,1,40.
CROD,301,3,1,102;CROD,302,3,3,104;PROD,3,2,2.;BOLT,1,301,60.;BOLT,2,302,60.,2
FORCE,10,102,,1.,$3,$4;FORCE,10,104,,1.,$3,$4;FORCE,20,102,,.5,$3,$4;FORCE,20,104,,.5,$3,$4;
FORCE,30,102,,40.,,-1.;FORCE,10,102,,40.,,-1.;FORCE,20,102,,40.,,-1.
FORCE,30,104,,40.,,-1.;FORCE,10,104,,40.,,-1.;FORCE,20,104,,40.,,-1.;JINCR,5,4;${5:-$};ENDDATA
DECK
   run "$1"
}

# Along the bolts, on columns of k_c = 1000 x 10/10: ratio = k_b/(k_b + k_p) of the load, k_p of half of two columns and the joint in a row.
clamped axial 1000. 0. 12. && {
   phi=$(number "20/(20 + 1/(2/1000 + 1/500))")
   for b in 1 2; do
      n=$(of_bolt axial 2 $b force) # the second bolt relieves the first
      near "axial, bolt $b: share" "$(of_bolt axial 3 $b share)" "$phi/2" 1e-9 # of 24 on both
      near "axial, bolt $b: force" "$(of_bolt axial 3 $b force)" "$n + 12*$phi" 1e-9
      near "axial, bolt $b: largest" "$(of_bolt axial 4 $b largest)" "$(of_bolt axial 3 $b force)" 1e-12
      near "axial, bolt $b: share stays when it is relieved" "$(of_bolt axial 4 $b share)" "$phi/2" 1e-9
      near "axial, bolt $b: change of the stage" "$(of_bolt axial 4 $b change)" "-6*$phi" 1e-9
      near "axial, bolt $b: clamping" "$(of_bolt axial 3 $b clamping)" "$(of_bolt axial 2 $b clamping) - 12*(1 - $phi)" 1e-9
      near "axial, bolt $b: loss" "$(of_bolt axial 3 $b loss)" "12*(1 - $phi)/$(of_bolt axial 2 $b clamping)" 1e-9
      near "axial, bolt $b: stress" "$(of_bolt axial 4 $b stress)" "$(of_bolt axial 4 $b force)/2" 1e-12
      near "axial, bolt $b: of ST" "$(of_bolt axial 4 $b use)" "$(of_bolt axial 3 $b force)/200" 1e-12
      near "axial, bolt $b: whole load" "$(of_bolt axial 4 $b whole_load)" 24 1e-12
      near "axial, bolt $b: load of the stage" "$(of_bolt axial 4 $b load_change)" -12 1e-12
      near "axial, bolt $b: ratio" "$(of_bolt axial 3 $b ratio)" "$phi/2" 1e-9
      same "axial, bolt $b: its joint" "$(of_bolt axial 3 $b joint)" 1
   done
   near 'axial: the first at the end of tightening' "$(of_bolt axial 4 1 tightened)" 60 1e-9
   near 'axial: the second at the end of tightening' "$(of_bolt axial 4 2 tightened)" 60 1e-9
   says 'bolts in the answer' "$work/axial.log" 'TIGHTENED *LARGEST *WHOLE LOAD'
}

"$program" -q -o "$work" --summary "$work/axial.sum" "$work/axial.bdf" > "$work/axial.log" 2>&1
bolts_summary() { awk -F, -v c="$1" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k } NR == 2 { print $at[c] }' "$work/axial.sum"; }
near 'axial, summary: the least force is that of tightening' "$(bolts_summary bolt_force)" 60 1e-9
near '... the largest use is that of the first bolt under the load' "$(bolts_summary bolt_use)" "($(of_bolt axial 2 1 force) + 12*$phi)/200" 1e-9

# Loads that no bolt feels, 1000 each, along x against each other on the upper column, on the lower one, and on its support: they have no part
# in any load of a bolt, whatever stage brings them.
clamped foreign 1000. 0. 12. 'FORCE,10,102,,1000.,1.;FORCE,10,104,,1000.,-1.;FORCE,20,2,,1000.,-1.;FORCE,20,4,,1000.,1.;FORCE,10,1,,1000.,1.,1.' &&
   for column in whole_load load_change share ratio largest; do for stage in 3 4; do for b in 1 2; do
      [ $column = whole_load ] || near "foreign loads, stage $stage, bolt $b: $column" "$(of_bolt foreign $stage $b $column)" \
         "$(of_bolt axial $stage $b $column)" 1e-9
      [ $column != whole_load ] || near "foreign loads, stage $stage, bolt $b: $column" "$(of_bolt foreign $stage $b $column)" 24 1e-9
   done; done; done

# Springs of 30 to the ground on both top nodes take their part of the load beside joint and bolts, 270 each: the bolts share what is left.
clamped beside 1000. 0. 12. 'CELAS2,901,30.,102,2;CELAS2,902,30.,104,2' && for b in 1 2; do
   near "a spring beside, bolt $b: whole load" "$(of_bolt beside 3 $b whole_load)" '24*270/300' 1e-8
   near "a spring beside, bolt $b: load along it" "$(of_bolt beside 3 $b load_change)" '24*270/300' 1e-8
   near "a spring beside, bolt $b: share" "$(of_bolt beside 3 $b share)" "$(of_bolt axial 3 $b share)" 1e-8
done

# Loads that press the columns together: a load below zero, a share of the same size.
clamped pressed 1000. 0. -12. && for b in 1 2; do
   near "pressed, bolt $b: load along it" "$(of_bolt pressed 3 $b load_change)" -24 1e-12
   near "pressed, bolt $b: ratio" "$(of_bolt pressed 3 $b ratio)" "$(of_bolt axial 3 $b ratio)" 1e-9
   near "pressed, bolt $b: share" "$(of_bolt pressed 3 $b share)" "-($(of_bolt axial 3 $b share))" 1e-9
done

# Two feet on one face and in one JOINT, each with two bolts to the ground, the second pulled: the bolts of the first feel nothing.
cards feet <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 10
BEGIN BULK;MAT1,1,1000.,,.0;MAT1,2,200.,,.0;PSHELL,1,1,2.;BLOCK2,1,1,1,1,0.,0.;+,10.,10.;+,20;BLOCK2,2,1,1,1,20.,0.;+,30.,10.,,,,,101,101
+,20;PMARK,20;JOINT,1,1,20;PJOINT,1,1;JNORM,1,.02,1.,50.;SPC1,1,1,1,101;GRID,902,,0.,-10.;GRID,904,,10.,-10.;GRID,912,,20.,-10.
GRID,914,,30.,-10.;SPC1,1,12,902,904,912,914;PROD,3,2,2.;CROD,301,3,2,902;CROD,302,3,4,904;CROD,303,3,102,912;CROD,304,3,104,914
BOLT,1,301,60.;BOLT,2,302,60.;BOLT,3,303,60.;BOLT,4,304,60.;FORCE,10,102,,12.,0.,1.;FORCE,10,104,,12.,0.,1.;ENDDATA
DECK
run feet && for b in 3 4; do
   near "feet, bolt $b: whole load" "$(of_bolt feet 2 $b whole_load)" 24 1e-12
   near "feet, bolt $b: share" "$(of_bolt feet 2 $b share)" '20/(20 + 1/(1/1000 + 1/500))/2' 1e-9
   near "feet, bolt $((b - 2)): no load" "$(of_bolt feet 2 $((b - 2)) whole_load)" 0 0
   same "feet, bolt $((b - 2)): no share" "$(awk -F, -v b=$((b - 2)) 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
      $1 == 2 && $4 == b { print $at["share"] $at["ratio"] }' "$work/feet.bolt.csv")" ''
done

# Across the bolts, on rigid columns: the load of 8 at 10 above the joint turns the upper column by t = 80/(2 25 (k_j + k_b)), k_j = 500
# of half the joint. No load is along the bolts, so no ratio; mu N/T of each half, which bears half of the load.
clamped cross 1.+10 4. 0. && for b in 1 2; do
   sign=$(number "if($b = 1, 1, -1)") n=$(of_bolt cross 2 $b clamping)
   near "across, bolt $b: share" "$(of_bolt cross 3 $b share)" "$sign*20*5*(80/(50*520))/8" 1e-6
   same "across, bolt $b: no load along it" "$(awk -F, -v b=$b '$1 == 3 && $4 == b { print $8 }' "$work/cross.bolt.csv" | sort -u)" ''
   near "across, bolt $b: loss" "$(of_bolt cross 3 $b loss)" "$sign*500*5*(80/(50*520))/$n" 1e-6
   near "across, bolt $b: slip" "$(of_bolt cross 3 $b safety)" "0.5*($n - $sign*500*5*(80/(50*520)))/4" 1e-6
   same "across, bolt $b: the balance at its joint" "$(of_bolt cross 3 $b joint)" 1
done

# A solid bolt: of its three joints the one between the plates is its own; bending of a round shank of the area 16.
run_input solid_bolt && {
   same 'solid: its joint' "$(of_bolt solid_bolt 2 1 joint)" 1
   near 'solid: clamping is bolt force less load' "$(of_bolt solid_bolt 2 1 clamping)" "$(of_bolt solid_bolt 2 1 force) - 3000" 1e-8
   near 'solid: loss' "$(of_bolt solid_bolt 2 1 loss)" "1 - $(of_bolt solid_bolt 2 1 clamping)/6000" 1e-8
   near 'solid: bending' "$(of_bolt solid_bolt 2 1 edge_stress)" \
        "$(of_bolt solid_bolt 2 1 stress) + 32/($pi*(4*16/$pi)^1.5)*$(of_bolt solid_bolt 2 1 bending)" 1e-10
}

# Four bolts on one joint: what is clamped around each adds up to the joint; warming alone makes no share.
run_input bracket_spiders && {
   for s in 1 2 3; do
      near "four bolts, stage $s" "$(number "$(for b in 1 2 3 4; do printf '%s + ' "$(of_bolt bracket_spiders $s $b clamping)"; done) 0")" \
           "$(value bracket_spiders rows "stage = $s" rows 'increment = max(increment)' rows 'joint = 1' print 'sum(force)')" 1e-10
   done
   for b in 1 2; do
      same "four bolts, bolt $b: warming is no share" "$(of_bolt bracket_spiders 3 $b share)" "$(of_bolt bracket_spiders 2 $b share)"
      near "four bolts, $b as its mirror image" "$(of_bolt bracket_spiders 2 $b clamping)" "$(of_bolt bracket_spiders 2 $((b + 2)) clamping)" 1e-6
   done
}
