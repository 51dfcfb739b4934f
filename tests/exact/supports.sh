# Supports and constraint equations that differ by SUBCASE: in a history their forces are handed over, by hand; cases of a linear deck against
# decks of one case; SUBCOM; free modes by METHOD, SUPORT, EIGR.

# support_beam NAME SOLVER: two cantilevers along x of 2 elements of 100, E I = 1E9, one over the other; their stages are on the standard input
support_beams() {
   { printf 'MODEL = PLANE;SOLVER = %s;OUTPUT = ALL\n' "$2"; cat
     cat <<'END'
BEGIN BULK
GRID,1,,0.,0.;GRID,2,,100.,0.;GRID,3,,200.,0.;GRID,11,,0.,50.;GRID,12,,100.,50.;GRID,13,,200.,50.
CBAR,1,1,1,2;CBAR,2,1,2,3;CBAR,11,1,11,12;CBAR,12,1,12,13
PBAR,1,1,100.,1.+4,1.+4,1.+4;MAT1,1,1.+5,,.3,1.-9
SPC1,1,126,1,11;SPC1,2,2,2;SPC1,5,2,3;SPCADD,3,1,2;SPCADD,6,1,5;JINCR,7,4
FORCE,4,3,,30.,0.,1.;SPCD,5,3,2,-1.;MPC,8,3,2,1.,13,2,-1.;LOAD,10,1.,2.,4;EIGRL,9,,,4
ENDDATA
END
   } | cards "$1"
   run "$1"
}
# support_at NAME STAGE NODE C: displacement component C of a node at the end of a stage
support_at() {
   awk -v stage="STAGE $2," -v node="$3" -v c="$4" 'index($0, " DISPLACEMENTS OF NODES, " stage) == 1 { on = 1; next } /^ [A-Z]/ { on = 0 }
      on && $1 == node { v = $(1 + (NF - 1) / 2 + c) } END { print v }' "$work/$1.out"
}
support_force() { awk -F, -v s="$2" -v k="$3" -v i="$4" '$1 == s && $2 == k && $3 == i { print $10 }' "$work/$1.reaction.csv"; }

# ---- one element of area 16 on lambda = c (F/a)**0.5, its top held where it stands, let go, held and moved by -0.001, let go
for method in NEWTON STEP; do
   for solver in TREE SKYLINE; do
      name=support_top_${method}_$solver
      cards "$name" <<DECK
METHOD = $method;SOLVER = $solver;INCR = 2;RESTART = 0
SUBCASE 1;SPC = 1;LOAD = 12
SUBCASE 2;SPC = 2;LOAD = 20
SUBCASE 3;SPC = 1;LOAD = 20
SUBCASE 4;SPC = 2;LOAD = 4
SUBCASE 5;SPC = 1;LOAD = 25
SUBCASE 6;FROM = 2;SPC = 1;LOAD = 16
BEGIN BULK
BLOCK2,1,1,1,1,0.0,0.0;+,8.0,5.0;+,5
PSHELL,1,1,2.0;MAT1,1,9500.0,,0.0
PMARK,5;JOINT,1,1,5;PJOINT,1,1;JNORM,1,8.0-3,0.5,1000.0
SPC1,1,1,1,2,3,4;SPC1,3,2,2,4;SPCADD,2,1,3;JINCR,2,4
FORCE,1,2,,0.5,0.0,-1.0;FORCE,1,4,,0.5,0.0,-1.0
LOAD,12,1.0,12.0,1;LOAD,16,1.0,16.0,1;LOAD,20,1.0,20.0,1;LOAD,25,1.0,25.,1;SPCD,4,2,2,-0.001;SPCD,4,4,2,-0.001
ENDDATA
DECK
      run "$name"
   done
   same_rows "supports of a history: both solvers, $method" support_top_${method}_TREE support_top_${method}_SKYLINE 1e-12
done
# every increment of stage 3 carries 12 and its share of what the support lets go, 8
ask 'a support of a history hands its force over' support_top_NEWTON_TREE rows 'stage = 3' count 8 all 'lambda = 8e-3*sqrt((12 + 8*load)/16) within 1e-9'
ask 'a support held anew keeps what it holds' support_top_NEWTON_TREE rows 'stage = 2' count 8 all 'lambda = 8e-3*sqrt(12/16) within 1e-12'
# F/(9500*16)*5 + c sqrt(F/16) is 0.001 more than under 20
support_f=$(awk 'BEGIN { g = 8e-3*sqrt(20/16) + 20*5/152000 + 1e-3; a = 20; b = 40
                         for (i = 0; i < 80; i++) { f = (a + b)/2; if (8e-3*sqrt(f/16) + f*5/152000 < g) a = f; else b = f } printf "%.15g", f }')
near 'SPCD of a support held anew counts from there' "$(support_force support_top_NEWTON_TREE 4 SPC1 3)" "-($support_f)" 1e-8
ask '... then the joint' support_top_NEWTON_TREE rows 'stage = 4 and increment = 4' count 2 all "lambda = 8e-3*sqrt($support_f/16) within 1e-9"
ask '... and it is let go' support_top_NEWTON_TREE rows 'stage = 5 and increment = 4' count 2 all 'lambda = 8e-3*sqrt(25/16) within 1e-9'
ask 'FROM a stage with other supports' support_top_NEWTON_TREE rows 'stage = 6' count 8 all 'lambda = 8e-3*sqrt((12 + 4*load)/16) within 1e-9'
# the tangents of STEP carry all of the load to the end
ask 'STEP: the forces of a support handed over' support_top_STEP_TREE rows 'stage = 3' count 8 all 'force = (12 + 8*load)/2 within 1e-9'
says 'the listing says so' "$work/support_top_STEP_TREE.out" '^ SUPPORTS OF STAGE 3: 2 COMPONENTS RELEASED, THEIR FORCES DECREASE TO ZERO'

# ---- cantilevers: a roller that comes at the bent middle, w = 5 P a**3/(6 E I), bears 5/2 P when P goes; an equation that comes keeps the distance
for solver in TREE SKYLINE; do
   support_beams support_roller_$solver $solver <<'END'
INCR = 7
SUBCASE 1;SPC = 1;LOAD = 4
SUBCASE 2;SPC = 3
SUBCASE 3;SPC = 1
SUBCASE 4;SPC = 1;LOAD = 4
SUBCASE 5;SPC = 1;MPC = 8;LOAD = 10
SUBCASE 6;SPC = 1;LOAD = 10
END
   near "a roller that comes, $solver: the middle stays" "$(support_at support_roller_$solver 2 2 2)" '5*30*1e6/6e9' 1e-5
   near '... what it bears' "$(support_force support_roller_$solver 2 SPC1 2)" '2.5*30' 1e-9
   near '... the end' "$(support_at support_roller_$solver 2 3 2)" '2.5*30*1e4*500/6e9' 1e-5
   near '... and gone, nothing is left' "$(support_at support_roller_$solver 3 3 2)" 0 0 1e-12
   near 'an equation that comes: half of what follows goes to the other beam' "$(support_at support_roller_$solver 5 3 2)" '1.5*30*8e6/3e9' 1e-5
   near '... which moves so' "$(support_at support_roller_$solver 5 13 2)" '0.5*30*8e6/3e9' 1e-5
   near '... and gone, the beam bears all' "$(support_at support_roller_$solver 6 3 2)" '2*30*8e6/3e9' 1e-5
   near '... the other nothing' "$(support_at support_roller_$solver 6 13 2)" 0 0 1e-12
done

# ---- a linear deck: every SUBCASE as if it were alone, byte by byte; its combination; supports that come again have one factor
support_cases=('SUBCASE 1;SPC = 1;LOAD = 4' 'SUBCASE 2;SPC = 3;LOAD = 4;MODES = 9' 'SUBCASE 3;SPC = 1;MPC = 8;LOAD = 4' 'SUBCASE 4;SPC = 6;LOAD = 5'
               'SUBCASE 5;SPC = 1;LOAD = 10')
# the tables and the answer of stage S
support_stage() { awk -v s="$2" '/^ STAGE [0-9]+, INCREMENT/ || /^ CASES/ || /WARNING/ { on = index($0, " STAGE " s ",") == 1 } on' "$work/$1.out"; }
for solver in TREE SKYLINE; do
   printf '%s\n' "${support_cases[@]}" 'SUBCOM 6;SUBSEQ = -2.0,;  1.5' | sed 's/SUBCOM 6/SUBCASE 6;SPC = 1;MPC = 8;SUBCASE 7;SPC = 1;MPC = 8;LOAD = 10;SUBCOM 8/' |
      support_beams support_all_$solver $solver
   for s in 1 2 3 4 5; do
      support_beams support_one $solver <<< "${support_cases[s - 1]}"
      support_stage support_all_$solver $s > "$work/support_a"
      support_stage support_one $s > "$work/support_b"
      same "case $s of five, $solver, is that of its own deck" "$(cmp "$work/support_a" "$work/support_b" 2>&1; [ -s "$work/support_a" ] && grep -c ANSWER "$work/support_a")" 1
   done
   near "SUBCOM: factors of the last SUBCASEs, $solver" "$(support_at support_all_$solver 8 3 2)" '1.5*0.5*60*8e6/3e9' 1e-5
   near 'an SPCD in the case that has its support' "$(support_at support_all_$solver 4 3 2)" -1 1e-9
done
says 'the listing says that cases start from rest' "$work/support_all_TREE.out" 'EVERY STAGE IS A CASE BY ITSELF, WHICH STARTS FROM REST'
says '... and what a SUBCOM is' "$work/support_all_TREE.out" '  STAGE 8 = -2.* STAGE 6 + 1.5.* STAGE 7'

# ---- temperatures, weight and a support movement in a combination: bars of 2 and 3 in a line, warm by 10 and pulled
cards support_warm <<'END'
SPC = 1;OUTPUT = ALL
SUBCASE 1;TEMPERATURE(LOAD) = 1
SUBCASE 2;LOAD = 2
SUBCASE 3;LOAD = 3
SUBCOM 4;SUBSEQ = 2.0, -0.5, 3.0
SUBCOM 5;SUBSEQ = -0.5, 3.0
BEGIN BULK
GRID,1,,0.,0.,0.;GRID,2,,2.,0.,0.;GRID,3,,5.,0.,0.;CBAR,1,1,1,2,0.,1.,0.;CBAR,2,1,2,3,0.,1.,0.
PBAR,1,1,4.,1.,1.,1.;MAT1,1,1000.,,.3,,1.-3,20.;TEMPD,1,30.
SPC1,1,123456,1;SPC1,1,1,3;FORCE,2,2,,70.,1.;SPCD,3,3,1,.5;ENDDATA
END
if run support_warm; then
   # alone: warm, node 2 stays at 0 (both stretch alike: u = 2*0.01 - N 2/4000, N = 40); F: u = 70/(4000/2 + 4000/3); moved: 0.5*2/5
   near 'SUBCOM with temperatures' "$(support_at support_warm 4 2 1)" '-0.5*70/(4000/2 + 4000/3) + 3*0.2' 1e-5
   # N of the second bar: -40 warm, -28 of F, 400 moved
   near '... the force of the warm bars' "$(awk -F, '$1 == 4 && $2 == "SPC1" && $6 == 5 { print $9 }' "$work/support_warm.reaction.csv")" '2*(-40) - 0.5*(-28) + 3*400' 1e-6
   near 'the last two SUBCASEs' "$(support_at support_warm 5 3 1)" 1.5 1e-9
fi

# ---- modes of a free bar by METHOD, with SUPORT, by EIGR: those of MODES(FREE); held partly; no modes in statics
support_free() { # NAME CONTROL CARDS
   { printf '%s\n' "$2" 'BEGIN BULK' 'GRID,1,,0.,0.,0.;GRID,2,,1.,0.,0.;GRID,3,,2.,0.,.5;CBAR,1,1,1,2,0.,1.,0.;CBAR,2,1,2,3,0.,1.,0.' \
       'PBAR,1,1,1.,1.,1.,1.;MAT1,1,1000.,,.3,1.-3' "$3" ENDDATA; } | cards "$1"
   run "$1" ${4:-}
}
support_modes() { awk -F, 'NR > 1 { printf "%.9g ", $3 }' "$work/$1.modes.csv"; }
support_free support_own 'SUBCASE 1;MODES(FREE) = 1' 'EIGRL,1,,,9'
support_free support_method 'SOL 103;CEND;METHOD = 1' 'EIGRL,1,,,9'
same 'METHOD without supports' "$(support_modes support_method)" "$(support_modes support_own)"
support_free support_suport 'SOL 103;CEND;SUBCASE 1;METHOD = 1' 'EIGR,1,LAN,,,,9,,,+;+,MAX;SUPORT,3,123,3,456'
same 'SUPORT' "$(support_modes support_suport)" "$(support_modes support_own)"
support_free support_part 'SOL 103;CEND;SPC = 1;METHOD = 1' 'EIGR,1,MGIV,0.,1.+4;SPC1,1,23,1;SUPORT,1,1456'
support_free support_grounded 'SUBCASE 1;SPC = 1;MODES = 1' 'EIGRL,1,,1.+4;SPC1,1,23,1;CELAS2,9,1.-3,1,1;CELAS2,8,1.-3,1,4;CELAS2,7,1.-3,1,5;CELAS2,6,1.-3,1,6'
judge 'SUPORT beside SPC' -F, 'FNR == 1 { next } NR == FNR { f[++n] = $3; next } { m++; if (m <= 4 ? f[m] + 0 != 0 : ($3 - f[m])^2 > (1e-5*$3)^2) print "mode " m ": " f[m] ", " $3 }
   END { if (m != n || n < 8) print m " and " n " modes"; print "checked " n }' "$work/support_part.modes.csv" "$work/support_grounded.modes.csv"
support_free support_inv 'SOL 103;CEND;METHOD = 1' 'EIGR,1,INV,,,3'
same 'EIGR: three times NE where a method iterates' "$(support_modes support_inv)" "$(support_modes support_own)"
support_free support_point 'SOL 103;CEND;METHOD = 1' 'EIGR,1,GIV,100.,200.,,,,,+;+,POINT,3,2'
same 'EIGR: the range' "$(support_modes support_point)" "$(support_modes support_own | awk '{ for (i = 1; i <= NF; i++) if ($i > 100 && $i < 200) printf "%s ", $i }')"
says '... and what NORM = POINT does' "$work/support_point.log" 'EIGR 1: NORM = POINT, but the shapes are scaled as by MAX'
support_free support_static 'SOL 101;CEND;SPC = 1;METHOD = 1' 'EIGRL,1,,,9;SPC1,1,123456,1'
same 'METHOD in statics has no effect' "$(ls "$work"/support_static.modes.csv 2>/dev/null; grep -c 'without effect.*METHOD' "$work/support_static.log")" 1
# supports of all nodes that leave the motions in a plane, as GRDSET gives them: the plane structure, free
for support_model in SPACE PLANE; do
   support_control='SOL 103;CEND;MODEL = SPACE;METHOD = 1' support_ps=345
   [ $support_model = PLANE ] && support_control='MODEL = PLANE;SUBCASE 1;MODES(FREE) = 1' support_ps=
   cards support_in_$support_model <<END
$support_control;BEGIN BULK;GRDSET,,,,,,,$support_ps;EIGRL,1,,,7
GRID,1,,0.,0.,0.;GRID,2,,1.,0.,0.;GRID,3,,2.,.5,0.;CBAR,1,1,1,2,0.,1.,0.;CBAR,2,1,2,3,0.,1.,0.
PBAR,1,1,1.,1.,1.,1.;MAT1,1,1000.,,.3,1.-3;ENDDATA
END
   run support_in_$support_model
done
same 'METHOD: supports that leave rigid-body motions' "$(awk -F, 'NR > 1 { printf "%.7g ", $3 }' "$work/support_in_SPACE.modes.csv")" \
   "$(awk -F, 'NR > 1 { printf "%.7g ", $3 }' "$work/support_in_PLANE.modes.csv")"
# two cases of modes, one of them free
support_free support_two 'SOL 103;CEND;METHOD = 1;SUBCASE 1;SPC = 1;SUBCASE 2;LABEL = FREE' 'EIGRL,1,,,9;SPC1,1,123456,1'
same 'a case with supports and one without' "$(awk -F, '$1 == 2 { printf "%.9g ", $3 }' "$work/support_two.modes.csv")" "$(support_modes support_own)"
