# Frames, trusses and plates as they come from NASTRAN, all nodes in x-y: whether the model is plane or one of space, and what bars bear.

rotation() { table "$1" 'ROTATIONS OF REFERENCE NODES' | awk -v node="$2" -v c="$3" '$1 == node { v = $(1 + c) } END { print v }'; }
# said NAME WORDS PATTERN: the screen says it once
said() { same "$2" "$(grep -c -- "$3" "$work/$1.log")" 1; }
# of_kind NAME WORDS DIMENSION: the listing has as many components of displacements
of_kind() { same "$2: dimensions" "$(table "$1" 'DISPLACEMENTS OF NODES' | awk '/NODE/ { print (NF - 1)/2; exit }')" "$3"; }

# ---- a cantilever of a beam in x-y: loads along z, y and about x move it by P L^3/(3 E I) and M L/(G J) ----

# beam_deck LOAD [MODEL]
beam_deck() {
   cards frame_beam <<DECK
${2:-SOL 101};SPC = 1;LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,2.0,0.0,0.0;CBAR,1,1,1,2,0.0,1.0,0.0;PBAR,1,1,1.0,2.0,3.0,4.0
MAT1,1,1000.0,,0.25;SPC1,1,123456,1;$1;ENDDATA
DECK
}
beam_deck FORCE,1,2,,1.0,0.0,0.0,1.0
run frame_beam && {
   near 'beam in x-y: force along z' "$(moved frame_beam 2 3)" '8/(3*1000*3)' 3e-6
   said frame_beam 'beam in x-y: the screen says why' 'a model of space, because CBAR 1 is a beam; MODEL = PLANE makes it plane$'
}
beam_deck FORCE,1,2,,1.0,0.0,1.0,0.0
run frame_beam && near 'beam in x-y: force along y' "$(moved frame_beam 2 2)" '8/(3*1000*2)' 3e-6
of_kind frame_beam 'beam in x-y' 3
beam_deck FORCE,1,2,,1.0,0.0,1.0,0.0 'MODEL = PLANE'
run frame_beam && near 'beam in x-y, MODEL = PLANE' "$(moved frame_beam 2 2)" '8/(3*1000*2)' 3e-6
of_kind frame_beam 'beam in x-y, MODEL = PLANE' 2
same 'MODEL = PLANE: nothing to say' "$(grep -c 'MODEL =' "$work/frame_beam.log")" 0
beam_deck FORCE,1,2,,1.0,0.0,0.0,1.0 'MODEL = PLANE'
run frame_beam 2
said frame_beam 'a force along z in a plane model: the message names MODEL' 'a plane model lies in x-y (MODEL = SPACE makes it a model of space)$'

# ---- a cantilever with I12 and shear: statics gives moment and shear; the planes are coupled by I12 in bending alone ----

# coupled_deck LOAD
coupled_deck() {
   cards coupled_beam <<DECK
SOL 101;SPC = 1;LOAD = 2;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,4.,0.,0.;CBEAM,1,1,1,2,0.,0.,1.;PBEAM,1,1,2.,1.5,1.2,1.0,.3
MAT1,1,2.+5,,.25;SPC1,1,123456,1;$1;ENDDATA
DECK
}
bends='1/(2e5*(1.5*1.2 - 1.0^2))'
coupled_deck FORCE,2,2,,100.,0.,0.,1.
run coupled_beam && {
   near 'I12 and shear: along the force' "$(moved coupled_beam 2 3)" "100*(4^3/3*1.2*$bends + 4/(2*8e4))" 3e-6
   near 'I12 and shear: across it, no shear' "$(moved coupled_beam 2 2)" "100*4^3/3*1.0*$bends" 3e-6
}
coupled_deck PLOAD1,2,1,FZ,FR,0.,100.,1.,100.
run coupled_beam && {
   near 'I12 and shear: a load along the beam' "$(moved coupled_beam 2 3)" "100*(4^4/8*1.2*$bends + 4^2/2/(2*8e4))" 3e-6
   near 'I12 and shear: a load along the beam, across it' "$(moved coupled_beam 2 2)" "100*4^4/8*1.0*$bends" 3e-6
}

# ---- plates in x-y: MID2 makes shells; a strip of nu = 0 bends by P L^3/(3 E I) and P L/(5/6 G A) ----

# strip_deck PSHELL LOAD...
strip_deck() {
   { printf 'SOL 101\nCEND\nSPC = 1\nLOAD = 1\nBEGIN BULK\nMAT1,1,1000.0,,0.0\nPSHELL,1,1,0.2,%s\nSPC1,1,123456,1,11\n' "$1"
     for k in 1 2 3 4 5; do printf 'GRID,%d,,%d.0,0.0,0.0\nGRID,%d,,%d.0,1.0,0.0\n' $k $((k - 1)) $((k + 10)) $((k - 1)); done
     for k in 1 2 3 4; do printf 'CQUAD4,%d,1,%d,%d,%d,%d\n' $k $k $((k + 1)) $((k + 11)) $((k + 10)); done
     printf '%s\n' "${@:2}" ENDDATA; } > "$work/strip.bdf"
}
strip_deck 1 FORCE,1,5,,0.5,0.0,0.0,1.-3 FORCE,1,15,,0.5,0.0,0.0,1.-3
run strip && near 'plate in x-y: force along z' "$(moved strip 5 3)" '1e-3*(64/(3*1000*0.2^3/12))' 3e-3
said strip 'plate in x-y: the screen says why' 'a model of space, because PSHELL 1 bends (MID2); MODEL = PLANE makes it plane$'
strip_deck 1,,1 FORCE,1,5,,0.5,0.0,1.-3,0.0 FORCE,1,15,,0.5,0.0,1.-3,0.0
run strip && near 'plate in x-y: bent in its plane as a beam with shear' "$(moved strip 5 2)" '1e-3*(64/(3*1000*0.2/12) + 4/(5/6*500*0.2))' 3e-2
strip_deck '' FORCE,1,5,,0.5,1.-3,0.0,0.0 FORCE,1,15,,0.5,1.-3,0.0,0.0
run strip && near 'membrane in x-y' "$(moved strip 5 1)" '1e-3*4/(1000*0.2)' 3e-6
of_kind strip 'membrane in x-y' 2
said strip 'membrane in x-y: the screen says why' 'a plane model, because its PSHELL have no bending material; MID2 makes it a model of space$'
strip_deck '' FORCE,1,5,,0.5,0.0,0.0,1.-3
run strip 2
said strip 'a membrane in x-y bears no force along z' 'FORCE, field 8, N3: not zero, but a plane model lies in x-y'

# ---- what else only space has, without shells and beams: each entry alone makes a truss or springs a model of space ----

# truss_deck CARDS...: a triangle of rods, and whatever CARDS add
truss_deck() {
   { printf 'SPC = 1\nLOAD = 1\nBEGIN BULK\nGRID,1,,0.0,0.0,0.0\nGRID,2,,4.0,0.0,0.0\nGRID,3,,0.0,3.0,0.0\nCONROD,1,1,2,1,0.1\nCONROD,2,3,2,1,0.1\nCONROD,3,1,3,1,0.1\nMAT1,1,1000.0\n'
     printf '%s\n' "$@" ENDDATA; } > "$work/truss.bdf"
}
truss_deck SPC1,1,123456,1,3 FORCE,1,2,,6.0,0.0,-1.0,0.0
run truss && near 'truss in x-y' "$(moved truss 2 2)" '-(8*8*4/100 + 10*10*5/100)/6' 3e-6
of_kind truss 'truss in x-y, whose supports name all components' 2
said truss 'truss in x-y: the screen says why' 'a plane model, nothing in it leaves x-y; MODEL = SPACE makes it a model of space$'
truss_deck SPC1,1,123,1,3 CELAS2,9,50.0,2,3 FORCE,1,2,,5.0,0.0,0.0,1.0
run truss && near 'truss in x-y on a spring along z' "$(moved truss 2 3)" 5/50 3e-6
said truss 'a spring along z' 'a model of space, because the spring 9 acts out of x-y'
while read -r words cards; do
   truss_deck SPC1,1,123456,1,2,3 ${cards//;/ }
   "$program" --check "$work/truss.bdf" > "$work/truss.log" 2>&1
   said truss "truss with ${words//_/ }" "a model of space, because .*${words//_/ }"
done <<'LIST'
FORCE_on_node_2 FORCE,1,2,,5.0,1.0,0.0,1.0
FORCE_on_node_2 CORD2R,7,,0.0,0.0,0.0,1.0,0.0,0.0;+,0.0,0.0,1.0;FORCE,1,2,7,5.0,1.0,0.0,0.0
FORCE2_on_node_2 FORCE2,1,2,5.0,1,2,1,3
MOMENT_on_node_4 GRID,4,,1.0,1.0,0.0;RBE2,8,4,12,2;MOMENT,1,4,,5.0,1.0,0.0,0.0
GRAV_1_acts GRAV,1,,9.81,0.0,-1.0,1.0;CONM2,8,2,,0.1
RFORCE_1_turns RFORCE,1,1,,2.0,0.0,1.0,0.0;CONM2,8,2,,0.1
SPCD_of_node_2 SPCD,1,2,3,0.1
CONM2_stands CONM2,8,2,,0.1,0.0,0.0,1.0
LIST
# in the plane of a system turned about z, and a moment about z, they do not
for cards in 'CORD2R,7,,0.0,0.0,0.0,0.0,0.0,1.0;+,1.0,1.0,0.0;FORCE,1,2,7,5.0,1.0,0.0,0.0' 'GRID,4,,1.0,1.0,0.0;RBE2,8,4,12,2;MOMENT,1,4,,5.0,0.0,0.0,1.0' \
             'RFORCE,1,1,,2.0,0.0,0.0,1.0;CONM2,8,2,,0.1' 'SPCD,1,2,2,0.1'; do
   truss_deck SPC1,1,123456,1,2,3 ${cards//;/ }
   "$program" --check "$work/truss.bdf" > "$work/truss.log" 2>&1
   said truss "truss with $cards" 'a plane model'
done

# ---- rods: G J/L in torsion, weight on both ends ----

# a rod from a wall to the end of a beam across it, which bends by 3 E I/L; a moment about the rod acts where they meet
cards rod_torsion <<'DECK'
SPC = 1;LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,3.0,0.0,0.0;GRID,3,,3.0,2.0,0.0
CROD,1,1,1,2;PROD,1,1,1.0,6.0;CBAR,2,2,2,3,0.0,0.0,1.0;PBAR,2,1,1.0,1.5,1.0,1.0;MAT1,1,1.+6,,0.25
SPC1,1,123456,1;SPC1,1,12356,2;SPC1,1,123,3;MOMENT,1,2,,100.0,1.0,0.0,0.0;ENDDATA
DECK
both='100/(3*1e6*1.5/2 + 4e5*6/3)'
run rod_torsion && near 'torsion of CROD beside a beam' "$(rotation rod_torsion 2 1)" "$both" 3e-6
sed -e 's/^CROD.*/CONROD,1,1,2,1,1.0,6.0/' -e '/^PROD/d' "$work/rod_torsion.bdf" > "$work/conrod_torsion.bdf"
run conrod_torsion && near 'torsion of CONROD beside a beam' "$(rotation conrod_torsion 2 1)" "$both" 3e-6
# in two rods, whose middle node has no other rotation: the same; turned in space by a CP and CD of every node, too
sed -e 's/^CROD.*/CROD,1,1,1,4\nCROD,4,1,4,2\nGRID,4,,1.2,0.0,0.0\nSPC1,1,23,4/' "$work/rod_torsion.bdf" > "$work/rod_chain.bdf"
run rod_chain && near 'torsion of two rods in a row' "$(rotation rod_chain 2 1)" "$both" 3e-6
near 'torsion of two rods in a row: the middle' "$(rotation rod_chain 4 1)" "$both*1.2/3" 6e-6
sed -e 's/^GRID,4.*/&\nGRDSET,,7,,,,7\nCORD2R,7,,0.0,0.0,0.0,1.0,2.0,3.0\n+,3.0,-1.0,1.0/' -e 's/^MOMENT,1,2,,/MOMENT,1,2,7,/' -e 's/^SPC = 1/MODEL = SPACE\n&/' "$work/rod_chain.bdf" > "$work/rod_turned.bdf"
run rod_turned && near 'torsion of two rods in a row, turned in space: torque' "$(table rod_turned 'FORCES OF SPRINGS' | awk '$2 == 4 { print $6 }')" "$both*8e5" 3e-6
# a moment on the node between two rods, held at their ends, beside nothing else
cards rods_alone <<'DECK'
SPC = 1;LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,1.0,0.0,0.0;GRID,3,,3.0,0.0,0.0;CROD,1,1,1,2;CROD,2,1,2,3;PROD,1,1,1.0,6.0
MAT1,1,1.+6,,0.25;SPC1,1,123456,1,3;SPC1,1,123,2;MOMENT,1,2,,10.0,1.0,0.0,0.0;ENDDATA
DECK
run rods_alone && near 'torsion of rods alone' "$(table rods_alone 'FORCES OF SPRINGS' | awk '$2 == 1 { print $6 }')" '10*2/3' 3e-6

# weight: two rods side by side, RHO 2, A 1 and 0.5, L 2, NSM 3 of one; in the plane, in space, with ACCEL1 at one end, turning about z
for model in PLANE SPACE; do
   cards rod_weight <<DECK
MODEL = $model;SPC = 1;SUBCASE 1;  LOAD = 1;SUBCASE 2;  LOAD = 2;SUBCASE 3;  LOAD = 3;BEGIN BULK;GRID,1,,1.0,0.0,0.0;GRID,2,,1.0,2.0,0.0
CROD,9,9,1,2;PROD,9,1,1.0,,,3.0;CONROD,8,1,2,1,0.5;MAT1,1,1.+6,,0.3,2.0;SPC1,1,123456,1;SPC1,1,13,2
GRAV,1,,10.0,0.0,-1.0,0.0;ACCEL1,2,,10.0,0.0,-1.0,0.0;+,2;RFORCE,3,,,1.0,0.0,0.0,0.5;ENDDATA
DECK
   ea='(1e6*1 + 1e6*0.5)/2' m='2*(2*1 + 3) + 2*(2*0.5)'
   run rod_weight && {
      end_moved() { table rod_weight "DISPLACEMENTS OF NODES, STAGE $1" | awk -v d=$([ $model = PLANE ] && echo 2 || echo 3) '$1 == 2 { print $(1 + d + 2) }'; }
      near "$model: weight of rods, elongation" "$(end_moved 1)" "-0.5*10*($m)/($ea)" 3e-6
      near "$model: ACCEL1 on rods" "$(end_moved 2)" "-0.5*10*($m)/($ea)" 3e-6
      near "$model: rods that turn" "$(end_moved 3)" "(2*$pi*0.5)^2*2*($m)/3/($ea)" 3e-6
   }
done
# base excitation of half a rod as a mass on its stiffness
cards rod_base <<'DECK'
SPC = 1;MASS = LUMPED;SET 1 = 2;SUBCASE 1;  MODES = 3;  FREQUENCY = 5;  DLOAD = 1;  RESPONSE = SET 1;BEGIN BULK;EIGRL,3,,,1;FREQ1,5,1.0,1.0,1
GRID,1,,0.0,0.0;GRID,2,,1.0,0.0;CROD,9,9,1,2;PROD,9,1,1.0;MAT1,1,1.+6,,0.3,2.0;SPC1,1,12,1;SPC1,1,2,2;GRAV,1,,10.0,1.0,0.0,0.0
PARAM,G,1.-9;ENDDATA
DECK
run rod_base && near 'base excitation of a rod' "$(awk -F, 'NR > 1 && $4 == "x" && $2 < 1.5 { print $5 }' "$work/rod_base.response.csv")" "10/(1e6 - 4*$pi^2)" 3e-6

# ---- BAROR and BEAMOR: plane 1 and PID where a beam leaves them blank ----

# beam_of CARD DEFAULTS...: moved along y by 1; L = 2, I1 = 2, I2 = 1
beam_of() {
   { printf 'MODEL = SPACE\nSPC = 1\nLOAD = 1\nBEGIN BULK\nGRID,1,,0.0,0.0,0.0\nGRID,2,,2.0,0.0,0.0\nGRID,5,,1.0,0.0,7.0\nPBAR,3,1,1.0,2.0,1.0,1.0\nMAT1,1,1000.0,,0.3\nSPC1,1,123456,1\nFORCE,1,2,,1.0,0.0,1.0,0.0\n'
     printf '%s\n' "$@" ENDDATA; } > "$work/default.bdf"
   run default && moved default 2 2
}
in_1='8/(3*1000*2)' in_2='8/(3*1000*1)' skew='8/3000*(0.5/2 + 0.5/1)'
near 'BAROR gives plane 1' "$(beam_of CBAR,3,3,1,2 BAROR,,,,,0.0,0.0,1.0)" "$in_2" 3e-6
near 'BAROR gives plane 1 by a node' "$(beam_of CBAR,3,3,1,2 BAROR,,,,,5)" "$in_2" 3e-6
near 'BAROR gives the PID' "$(beam_of CBAR,7,,1,2,0.0,1.0,0.0 BAROR,,3)" "$in_1" 3e-6
near 'a blank PID is the EID' "$(beam_of CBAR,3,,1,2,0.0,1.0,0.0)" "$in_1" 3e-6
near 'the vector of a CBAR goes before BAROR' "$(beam_of CBAR,3,3,1,2,0.0,1.0,0.0 BAROR,,,,,0.0,0.0,1.0)" "$in_1" 3e-6
near 'the node of a CBAR goes before BAROR' "$(beam_of CBAR,3,3,1,2,5 BAROR,,,,,0.0,1.0,0.0)" "$in_2" 3e-6
near 'BAROR fills single blank components' "$(beam_of CBAR,3,3,1,2,,1.0 BAROR,,,,,0.0,0.0,1.0)" "$skew" 3e-6
near 'BEAMOR is for CBEAM' "$(beam_of CBEAM,3,3,1,2 BEAMOR,,,,,0.0,0.0,1.0 BAROR,,,,,0.0,1.0,0.0)" "$in_2" 3e-6
near 'BAROR is not for CBEAM' "$(beam_of CBEAM,3,3,1,2 BAROR,,,,,0.0,0.0,1.0 BEAMOR,,,,,0.0,1.0,0.0)" "$in_1" 3e-6

# ---- lumped mass: half of a beam at its end, without rotary inertia; f = sqrt(3 E I/L^3/(m/2))/(2 pi) ----

for word in 'MASS = LUMPED' 'PARAM,COUPMASS,-1'; do
   cards lumped_beam <<DECK
MODEL = SPACE;SPC = 1;$word;SUBCASE 1;  MODES = 3;BEGIN BULK;EIGRL,3,,,3;GRID,1,,0.0,0.0,0.0;GRID,2,,2.0,0.0,0.0;CBAR,1,1,1,2,0.0,1.0,0.0
PBAR,1,1,1.0,2.0,1.0,1.0;MAT1,1,1000.0,,0.3,1.-3;SPC1,1,123456,1;ENDDATA
DECK
   run lumped_beam && {
      near "lumped beam, $word: plane 2" "$(mode lumped_beam 1 frequency)" "sqrt(3*1000*1/8/(1e-3*2/2))/(2*$pi)" 3e-6
      near "lumped beam, $word: plane 1" "$(mode lumped_beam 3 frequency)" "sqrt(3*1000*2/8/(1e-3*2/2))/(2*$pi)" 3e-6
      near "lumped beam, $word: along" "$(mode lumped_beam 2 frequency)" "sqrt(1000*1/2/(1e-3*2/2))/(2*$pi)" 3e-6
   }
done
# a CBEAM keeps the inertia about its axis, rho (I1 + I2): it twists first; f = sqrt(G J/L/(rho (I1 + I2) L/2))/(2 pi)
sed 's/CBAR,/CBEAM,/; s/^PBAR,1,1,1.0,2.0,1.0,/PBEAM,1,1,1.0,2.0,1.0,,/; s/EIGRL,3,,,3/EIGRL,3,,,4/' "$work/lumped_beam.bdf" > "$work/lumped_cbeam.bdf"
run lumped_cbeam && near 'lumped CBEAM: twist' "$(mode lumped_cbeam 1 frequency)" "sqrt(1000/2.6*1/2/(1e-3*3*2/2))/(2*$pi)" 3e-6

# ---- T1 to T3 of CTRIA3, where NASTRAN has them: two triangles of a square pulled evenly, their mean thickness ----

cards corner_thickness <<'DECK'
SPC = 1;LOAD = 1;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,2.0,0.0,0.0;GRID,3,,2.0,2.0,0.0;GRID,4,,0.0,2.0,0.0
CTRIA3  1       1       1       2       3;+               0       0.5     0.5     0.5
CTRIA3  2       1       1       3       4;+                       0.5     0.5     0.5
PSHELL,1,1,9.0,1,,1;MAT1,1,1000.0,,0.3;SPC1,1,123,1;SPC1,1,13,4;SPC1,1,3,2;FORCE,1,2,,5.0,1.0,0.0,0.0;FORCE,1,3,,5.0,1.0,0.0,0.0;ENDDATA
DECK
run corner_thickness && near 'thickness at the corners of CTRIA3' "$(moved corner_thickness 3 1)" '10*2/(1000*2*0.5)' 3e-6

# ---- A section with one moment of inertia, the other 0: M z/I at the points of the section, for either of them. The load is along y; I2 belongs
# to y where the vector of the beam is along z, and z of the beam is then -y
for moment in 'PLANE 0.,1.,0. 800. +,5.,,-5. -1' 'SPACE 0.,0.,1. ,800. +,,5.,,-5. 1'; do
   set -- $moment
   cards one_moment <<DECK
MODEL = $1;SPC = 1;LOAD = 1;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,100.,0.,0.;CBAR,1,1,1,2,$2;PBAR,1,1,100.,$3;$4;MAT1,1,2.1+5,,.3
SPC1,1,123456,1;SPC1,1,345,2;FORCE,1,2,,10.,0.,1.,0.;ENDDATA
DECK
   run one_moment > "$work/one_moment.said" && near "one moment of inertia, $1: at C" "$(table one_moment 'STRESSES IN BEAMS' | awk '$2 == 1 { print $3 }')" "$5*10*100*5/800" 1e-5 &&
      near "one moment of inertia, $1: at D" "$(table one_moment 'STRESSES IN BEAMS' | awk '$2 == 1 { print $4 }')" "-($5)*10*100*5/800" 1e-5
done
