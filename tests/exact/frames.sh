# Frames, trusses and plates as they come from NASTRAN, all nodes in x-y: whether the model is plane or one of space, and what bars bear.

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
