# Half and quarter models: what the mirror image balances has no part in T, MU N/T, M, SECANT and bending; stresses are those of the whole. By
# statics, and each against the whole model.
tenths() { printf '%.1f' "$(number "$1")"; }
of() { "$query" "$work/$1.$2.csv" "${@:3}"; }

# pressed NAME NX X1 NY Y1 SUPPORTS FX FY: a block from (X1, Y1) to (20, 10), 12 high, on a rigid base with shear and mu 0.15, pressed with
# 60 and then pushed with FX, FY; Poisson's ratio makes it spread over the base.
pressed() {
   local push="LOAD,20,1.,1.,10"
   [ "$7$8" = 00 ] || push="LOAD,20,1.,1.,10,1.,15;FORCEM,15,1.,$7.,$8.,0.,23"
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 10;SUBCASE 2;  LOAD = 20
BEGIN BULK;BLOCK3,1,1,$2,$4,2,$3.,$5.,0.;+,20.,10.,12.,,,,1,1;+,22,,24,,20,23;PMARK,20;PMARK,22;PMARK,23;PMARK,24
PSOLID,1,1;MAT1,1,70000.,,.33;JOINT,1,1,20;PJOINT,1,1,2,2,.15;JNORM,1,2.-4,.5;JSHEAR,2,2.+4;$6;PLOADM,10,60.,23;$push;ENDDATA
DECK
   run "$1"
}
nothing() { same "$1: no T" "$(awk -F, -v c="$3" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } $1 == c { print $at["t"] + 0, $at["safety"] }' \
                 "$work/$2.stage.csv")" '0 '; }

pressed whole 4 -20 4 -10 'SPC1,1,1,37' 0 1000 && {
   nothing 'whole, pressed' whole 1
   near 'whole, pushed: T' "$(of whole stage rows 'stage = 2' print t)" 1000 1e-8
   same 'whole: no plane of symmetry' "$(grep -c 'OF SYMMETRY' "$work/whole.log")" 0
}
# secants NAME: which it has in each stage
secants() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^secant/) at[++n] = i; next }
   { for (i = 1; i <= n; i++) printf "%d", $at[i] != "" }' "$work/$1.stage.csv"; }
# cut at x = 0 and pushed along the plane: half the forces, the same safety
pressed half 2 0 4 -10 'SPCM,1,1,22' 0 500 && {
   nothing 'half, pressed' half 1
   near 'half, pushed: T' "$(of half stage rows 'stage = 2' print t)" 500 1e-8
   near 'half, pushed: safety' "$(of half stage rows 'stage = 2' print safety)" '0.15*24000/500' 1e-8
   near 'half, pushed: the safety of the whole' "$(of half stage rows 'stage = 2' print safety)" "$(of whole stage rows 'stage = 2' print safety)" 1e-8
   holds 'half: the base holds more than T' "abs($(of half stage rows 'stage = 1' print 'sqrt(force_x^2+force_y^2)')) > 500"
   says 'half: what is left out' "$work/half.log" 'NOTE: A PLANE OF SYMMETRY CUTS THE BODIES OF JOINT 1: T, MU N/T, M AND SECANT'
   same 'half: told once' "$(grep -c 'OF SYMMETRY' "$work/half.log") $(grep -c 'OF SYMMETRY' "$work/half.out")" '1 1'
   near 'half, pressed: no M' "$(of half stage rows 'stage = 1' print m)" 0 0 1e-3
   near 'half, pushed: M' "$(of half stage rows 'stage = 2' print m)" '500*12' 1e-8
   holds 'half: the base bears moments about an axis in the plane' "abs($(of half stage rows 'stage = 1' print moment_y)) > 1000"
   for column in m secant_y secant_n secant_tilt_x; do
      near "half, pushed: $column of the whole" "2*$(of half stage rows 'stage = 2' print $column)" "$(of whole stage rows 'stage = 2' print $column)" 1e-8
   done
   for column in move_y move_n turn_x; do
      near "half, pushed: $column of the whole" "$(of half stage rows 'stage = 2' print $column)" "$(of whole stage rows 'stage = 2' print $column)" 1e-8
   done
   same 'half: no other secants, as of the whole' "$(secants half)" "$(secants whole)"
}
# cut at y = -10, a side plane: pushed along x
pressed side 2 0 2 -10 'SPCM,1,2,24' 300 0 && {
   near 'another side, pushed: T' "$(of side stage rows 'stage = 2' print t)" 300 1e-8
   near 'another side, pushed: M' "$(of side stage rows 'stage = 2' print m)" '300*12' 1e-8
}
# cut twice: nothing can move it sideways
pressed quarter 2 0 2 0 'SPCM,1,1,22;SPCM,1,2,24' 0 0 && {
   nothing 'quarter, pressed' quarter 1
   near 'quarter: no M' "$(of quarter stage rows 'stage = 2' print m)" 0 0 1e-3
   same 'quarter: SECANT along the normal only' "$(secants quarter)" 001000001000
   near 'quarter: SECANT of the whole' "4*$(of quarter stage rows 'stage = 1' print secant_n)" "$(of whole stage rows 'stage = 1' print secant_n)" 1e-8
   says 'quarter: what is left out' "$work/quarter.log" 'NOTE: PLANES OF SYMMETRY CUT THE BODIES OF JOINT 1'
}
# a foot beside the plane, which cuts the body on it: the other foot holds the body as well along the normal
cards foot <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 10;SUBCASE 2;  LOAD = 20
BEGIN BULK;BLOCK3,1,1,4,4,2,0.,-10.,4.;+,20.,10.,12.,,,,1,1;+,22,,,,,23;BLOCK3,2,1,2,4,1,10.,-10.,0.;+,20.,10.,4.,,,,1001,1001;+,,,,,20,,1
PMARK,20;PMARK,22;PMARK,23;PSOLID,1,1;MAT1,1,70000.,,.33;JOINT,1,1,20;PJOINT,1,1,2,2,.15;JNORM,1,2.-4,.5;JSHEAR,2,2.+4
SPCM,1,1,22;PLOADM,10,60.,23;LOAD,20,1.,1.,10,1.,15;FORCEM,15,500.,0.,1.,0.,23;ENDDATA
DECK
run foot && {
   nothing 'a foot beside the plane, pressed' foot 1
   near 'a foot beside the plane, pushed: T' "$(of foot stage rows 'stage = 2' print t)" 500 1e-8
   holds 'a foot beside the plane: the base holds more' "abs($(of foot stage rows 'stage = 1' print 'sqrt(force_x^2+force_y^2)')) > 500"
}
# one node left to a spring in place of its support: no plane of symmetry, as all the friction along x counts
pressed other 2 0 4 -10 'SPC1,1,1,2,THRU,15;CELAS2,1001,1.+9,1,1' 0 500 &&
   holds 'a node not held: T is all of the friction' "$(of other stage rows 'stage = 1' print t) > 500"

# A square shank of 4 x 4 in bending, tightened against a spring: cantilever of 60 with the section at 30. bent NAME Y1 SHARE SUPPORTS
bent() {
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 10
BEGIN BULK;BLOCK3,1,1,4,2,6,-2.,$2.,0.;+,2.,2.,30.,,,,1,1;+,,,60,,20,40;BLOCK3,2,1,4,2,6,-2.,$2.,30.;+,2.,2.,60.,,,,1001,1001;+,,,60,,,21,1
PSOLID,1,1;MAT1,1,210000.,,.3;PMARK,20;PMARK,21;PMARK,40;PMARK,60;BOLT,1,,$(tenths "8000*$3"),1,40
GRID,9001,,0.,$5,60.;RBE3M,9001,9001,123456,123,21;CELAS2,9002,$(tenths "40000*$3"),9001,3;SPCM,1,123,20;$4
FORCEM,10,$(tenths "300*$3"),1.,0.,0.,21;ENDDATA
DECK
   run "$1"
}
edge=$(number "8000/16 + 32*300*30/($pi*sqrt(4*16/$pi)^3)")
bent shank -2 1 '$' 0. && bent half_shank 0 0.5 'SPCM,1,2,60' 1. && {
   near 'shank: bending' "$(of shank bolt rows 'stage = 2 and load = 1' print bending)" 9000 1e-6
   near 'shank: edge stress' "$(of shank bolt rows 'stage = 2 and load = 1' print edge_stress)" "$edge" 1e-5
   near 'half a shank: bending of its part' "$(of half_shank bolt rows 'stage = 2 and load = 1' print bending)" 4500 1e-6
   near 'half a shank: edge stress of the whole' "$(of half_shank bolt rows 'stage = 2 and load = 1' print edge_stress)" "$edge" 1e-5
   near 'half a shank: tightened without bending' "$(of half_shank bolt rows 'stage = 1 and load = 1' print bending)" 0 0 1e-3
   says 'half a shank: told' "$work/half_shank.log" 'NOTE: A PLANE OF SYMMETRY CUTS BOLT 1: FORCES AND BENDING'
}
# a quarter of the bolt: its mirror images balance all bending
run_input solid_bolt && near 'quarter of a bolt: no bending' "$(of solid_bolt bolt rows 'stage = 2 and load = 1' print bending)" 0 0 1e-6

# A block on a rigid base, pressed by a bolt to the ground through its middle, then pulled with 800 and pushed with 600: the load of the bolt,
# whole and half. clamped_block NAME NX X1 NODE SHARE SUPPORTS
clamped_block() {
   cards "$1" <<DECK
METHOD = NEWTON;UNITS = MM, N;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 10
BEGIN BULK;BLOCK3,1,1,$2,4,1,$3.,-10.,0.;+,20.,10.,12.,,,,1,1;+,22,,,,20,23;PMARK,20;PMARK,22;PMARK,23
PSOLID,1,1;MAT1,1,70000.,,.33;JOINT,1,1,20;PJOINT,1,1,2,2,.15;JNORM,1,2.-4,.5;JSHEAR,2,2.+4;GRID,901,,0.,0.,-30.;SPC1,1,123,901;$6
CROD,801,80,$4,901;PROD,80,1,$(tenths "50*$5");BOLT,1,801,$(tenths "20000*$5"),1,,M10,8.8,1.6
FORCEM,10,$(tenths "1000*$5"),0.,.6,.8,23;ENDDATA
DECK
   run "$1"
}
clamped_block bolted 4 -20 26 1 'SPC1,1,1,26' && clamped_block half_bolted 2 0 6 0.5 'SPCM,1,1,22' && {
   for case in 'bolted 1' 'half_bolted 0.5'; do
      set -- $case
      near "$1: load along it" "$(of $1 bolt rows 'stage = 2 and load = 1' print load_change)" "800*$2" 1e-9
      near "$1: whole load" "$(of $1 bolt rows 'stage = 2 and load = 1' print whole_load)" "1000*$2" 1e-9
      near "$1: joint, T" "$(of $1 stage rows 'stage = 2' print t)" "600*$2" 1e-8
   done
   for column in share ratio stress loss safety assembly_force working_load residual amplitude yield slip opening; do
      near "half a bolt: $column" "$(of half_bolted bolt rows 'stage = 2 and load = 1' print "$column")" \
           "$(of bolted bolt rows 'stage = 2 and load = 1' print "$column")" 1e-7
   done
}

# half a bolt on the plane of symmetry whose foot stands on a face that slides: that face is no plane through the bolt
cards half_on_roller <<'DECK'
UNITS = MM, N;METHOD = NEWTON;SPC = 1;SUBCASE 1;SUBCASE 2;  LOAD = 10;BEGIN BULK;BLOCK2,1,1,4,2,0.0,0.0;+,40.0,20.0,,,,,1,1;+,22,,20,24
BLOCK2,2,1,4,2,0.0,20.0;+,40.0,40.0,,,,,101,101;+,21,,23,24;PSHELL,1,1,20.0;MAT1,1,210000.,,0.3;PMARK,20;PMARK,21;PMARK,22;PMARK,23;PMARK,24
JOINT,1,1,20,21;PJOINT,1,1,1,,0.2;JNORM,1,1.0-3,0.5,2.0+5;JSHEAR,1,2.0+4;PROD,91,1,18.3;CROD,901,91,1,103;BOLT,901,901,3000.0,1,,M8,8.8
SPCM,1,1,24;SPCM,1,2,22;FORCE,10,115,,1500.,0.0,1.0;ENDDATA
DECK
run half_on_roller && near 'half a bolt with its foot on a roller: the whole one' \
   "$(of half_on_roller bolt rows 'stage = 2 and load = 1' print assembly_force)" 6000 1e-9
