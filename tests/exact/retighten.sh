# Bolts tightened again in a later stage: a force once more that grows from the present tension to the new preload, then locked.

# retighten_columns NAME STAGES BOLTS: two columns, each 10 x 10 x 2, E = 1000, nu = 0, on each other, linear joint of 1/c = 50 between
# them, tied together at x = 0 and 10 by rods of k_b = 200 x 2/20 = 20; load 10 lifts the upper column by 12 on each rod.
retighten_columns() {
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;$2;BEGIN BULK;MAT1,1,1000.,,.0;MAT1,2,200.,,.0;PSHELL,1,1,2.;BLOCK2,1,1,1,1,0.,0.;+,10.,10.;+,20,,21
BLOCK2,2,1,1,1,0.,10.;+,10.,20.,,,,,101,101;+,,,,,1;PMARK,20;PMARK,21;SPCM,1,12,20;JOINT,1,1,21;PJOINT,1,1;JNORM,1,.02,1.,50.
CROD,301,3,1,102;CROD,302,3,3,104;PROD,3,2,2.;$3;FORCE,10,102,,1.,,12.;FORCE,10,104,,1.,,12.;SPC1,1,1,102,104;ENDDATA
DECK
   run "$1"
}
retighten_force() { "$query" "$work/$1.bolt.csv" rows "stage = $2 and bolt = $3" rows "increment = max(increment)" print "$4"; }
joint_force() { value "$1" rows "stage = $2" rows "increment = max(increment)" print 'sum(force)'; }

phi=$(number "20/(20 + 1/(2/1000 + 1/500))") # of a load, the part that a locked bolt takes
retighten_columns again 'SUBCASE 1;SUBCASE 2;LOAD = 10;SUBCASE 3;LOAD = 10;SUBCASE 4;SUBCASE 5;FROM = 2' \
   'BOLT,1,301,30.;BOLT,2,302,30.;BOLT,3,301,60.,3;BOLT,4,302,60.,3' && {
   near 'locked, the bolt takes its part of the load' "$(retighten_force again 2 1 force)" "30 + 12*$phi" 1e-9
   near 'tightened again under load, it has the new preload' "$(retighten_force again 3 1 force)" 60 1e-9
   near 'and the joint what the load leaves of it' "$(joint_force again 3)" '2*(60 - 12)' 1e-9
   near 'locked again, it gives back its part' "$(retighten_force again 4 2 force)" "60 - 12*$phi" 1e-9
   near 'as the joint does' "$(joint_force again 4)" "2*(60 - 12*$phi)" 1e-9
   near 'from the state before, unloaded: the first preload' "$(retighten_force again 5 1 force)" 30 1e-9
   near 'the force at the end of tightening is the new one' "$(retighten_force again 4 1 tightened)" 60 1e-9
   says 'the listing shows the second tightening' "$work/again.out" '301.*TIGHTENED'
}
# the way to the new preload is a straight one, from the tension at its start
retighten_columns way 'SUBCASE 1;SUBCASE 2;LOAD = 10;SUBCASE 3;LOAD = 10;INCR = 5' \
   'BOLT,1,301,30.;BOLT,2,302,30.;BOLT,3,301,60.,3;BOLT,4,302,60.,3;JINCR,5,2,LIST,.5,.5' && \
   near 'half way' "$("$query" "$work/way.bolt.csv" rows 'stage = 3 and bolt = 1 and increment = 1' print force)" "45 + 6*$phi" 1e-9
# in two steps or in one: a monotonic path has one end; of rods and of the pretension section of a solid bolt
retighten_columns two 'SUBCASE 1;SUBCASE 2' 'BOLT,1,301,25.;BOLT,2,302,25.;BOLT,3,301,60.,2;BOLT,4,302,60.,2' && \
   retighten_columns one 'SUBCASE 1' 'BOLT,1,301,60.;BOLT,2,302,60.' && \
   near 'rods in two steps' "$(cell two 2 1 2 lambda)" "$(cell one 1 1 2 lambda)" 1e-12
awk '/^BOLT/ { print "BOLT,1,,2000.,1,40"; print "BOLT,2,,6000.,2,40"; next } /^SUBCASE 2/ { print "SUBCASE 2\n  INCR = 5\nSUBCASE 3"; next } { print }' \
   input/solid_bolt.bdf > "$work/steps.bdf"
run steps && run_input solid_bolt && {
   near 'a solid bolt in two steps has the preload' "$(retighten_force steps 2 1 force)" 6000 1e-8
   near 'and later the force of one that was tightened at once' "$(retighten_force steps 3 1 force)" "$(retighten_force solid_bolt 2 1 force)" 1e-4
   near 'its joints too' "$(value steps rows 'stage = 3 and joint = 1' rows 'increment = max(increment)' print 'sum(force)')" \
      "$(value solid_bolt rows 'stage = 2 and joint = 1' rows 'increment = max(increment)' print 'sum(force)')" 1e-4
}

# FROM a stage of other supports, or of other equations, than the stage that has just ended: bolts stay tightened, screw and solid bolt
from_other() { # NAME STAGE
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 10;$2;SUBCASE 6;  FROM = 2;  LOAD = 11;BEGIN BULK;BLOCK2,1,1,2,2,0.,0.;+,40.,40.
+,20;PMARK,20;PSHELL,1,1,10.;MAT1,1,2.1+5,,.3;JOINT,1,1,20;PJOINT,1,1,1,,,,1.;JNORM,1,2.-3,0.5,2.+4;JSHEAR,1,3.+3;FORCE,10,9,,800.,.1,-1.
FORCE,11,9,,400.,.1,-1.;SPC1,1,12,99;SPC1,2,1,9;SPCADD,5,1,2;MPC,7,9,1,1.,6,1,-1.;GRID,99,,0.,0.;CROD,901,6,98,5;PROD,6,1,50.
BOLT,1,901,2000.,1;GRID,98,,20.,-20.;SPC1,1,12,98;ENDDATA
DECK
   run "$1"
}
last_bolt() { "$query" "$work/$1.bolt.csv" rows 'stage = 6' rows 'increment = max(increment)' print force; }
if from_other from_2 'TITLE = FROM'; then
   for other in 'SUBCASE 3;  SPC = 5;  LOAD = 10' 'SUBCASE 3;  MPC = 7;  LOAD = 10'; do
      from_other from_3 "$other" || continue
      near "FROM past $other: the bolt" "$(last_bolt from_3)" "$(last_bolt from_2)" 1e-9
      near "FROM past $other: the supports take the load" "$(total from_3 SUPPORTS 2)" "$(total from_2 SUPPORTS 2)" 1e-9
   done
fi
# ... and a stage that tightens a bolt again, FROM a stage that tightened it, with other supports than it
cards from_again <<'DECK'
METHOD = NEWTON;SUBCASE 1;  SPC = 1;SUBCASE 2;  SPC = 1;SUBCASE 3;  FROM = 1;  SPC = 2;BEGIN BULK;BLOCK2,1,1,2,1,0.0,0.0;+,40.,20.,,,,,1,1;+,,,20
BLOCK2,2,1,2,1,0.0,20.0;+,40.0,40.0,,,,,11,11;+,21;PSHELL,1,1,20.0;MAT1,1,210000.,,0.3;PMARK,20;PMARK,21;JOINT,1,1,20,21;PJOINT,1,1,1;JNORM,1,1.0-3,0.5,2.0+5
JSHEAR,1,2.0+4;CROD,901,90,3,14;PROD,90,1,60.0;BOLT,1,901,2000.,1;BOLT,2,901,9000.,3;SPC1,1,12,1,3,5;SPC1,2,12,1,5;ENDDATA
DECK
run from_again && near 'FROM, tightened again, other supports: the preload' \
   "$("$query" "$work/from_again.bolt.csv" rows 'stage = 3' rows 'increment = max(increment)' print force)" 9000 1e-9
