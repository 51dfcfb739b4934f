# Joints between faces that do not match: input/meshed_apart.bdf, 7 elements over 5, by every method; a bolted joint in space. The
# projection forced on matching meshes: manual/06_faces.md.

# carries NAME STAGE SHEAR: the joint carries 100 along its normal and this shear force in every increment of the stage
carries() {
   ask "$1: force and shear force of stage $2" "$1" rows "stage = $2" by increment all \
      "sum(force) = $4 within 1e-6 and sum(tau_x*area) = $3 within 1e-6 and sum(area) = 500 within 1e-10"
}

run_input meshed_apart && {
   ask 'pressed evenly: p and lambda at every node' meshed_apart rows 'stage = 1' all \
      'pressure = 0.2*load within 1e-10 and lambda = 0.008*sqrt(0.2*load) within 1e-12'
   ask 'ends stand on nodes of SIDE2, the others on lists' meshed_apart all 'node2 = if(x = 0 within 1e-9, 3, if(x = 50 within 1e-9, 18, -1))'
   carries meshed_apart 1 0 '100*load'
   carries meshed_apart 2 '20*load' 100
   carries meshed_apart 3 '20*(1 - load)' 100
   carries meshed_apart 4 '-24*load' 100
   near 'pressed evenly: work put in' "$(table meshed_apart 'ENERGY OF JOINTS, STAGE 1' | awk 'NF >= 7 && $1 == 1 { print $2 }')" \
      '100*0.008*sqrt(0.2)/3' 1e-5   # integral of p dlambda: m/(1 + m) of F lambda
   ask 'no element beyond its friction limit' meshed_apart all 'abs(tau_x) <= 0.3*pressure + 1e-9'
   ask 'some slip' meshed_apart rows 'slip = 1' count 4
}

# The other side first: the forces are the same, the even pressure too; the shear has the other sense.
blocks_apart coarse_first && {
   ask 'coarser side first: p and lambda' coarse_first rows 'stage = 1' all \
      'pressure = 0.2*load within 1e-10 and lambda = 0.008*sqrt(0.2*load) within 1e-12'
   carries coarse_first 2 '-20*load' 100
   carries coarse_first 4 '24*load' 100
   says 'the coarser side is told of' "$work/coarse_first.out" 'SIDE1 OF JOINT 1 IS COARSER THAN SIDE2'
}

# STEP carries the loads as well where all excess over the friction limit is taken off; BACK loads once.
sed 's/METHOD = NEWTON/METHOD = STEP/' input/meshed_apart.bdf > "$work/apart_step.bdf"
run apart_step && {
   carries apart_step 1 0 '100*load'
   carries apart_step 2 '20*load' 100
   carries apart_step 3 '20*(1 - load)' 100
}
awk '/^SUBCASE 2/ { skip = 1 } /^BEGIN BULK/ { skip = 0 } !skip' input/meshed_apart.bdf | sed 's/METHOD = NEWTON/METHOD = BACK/' > "$work/apart_back.bdf"
run apart_back && {
   ask 'BACK: p and lambda' apart_back rows 'stage = 1' rows 'increment = max(increment)' all \
      'pressure = 0.2 within 1e-6 and lambda = 0.008*sqrt(0.2) within 1e-7'
}

# SIDE1 hangs over on both sides: it is told, and what stands over SIDE2 carries all.
blocks_apart overhang && {
   carries overhang 1 0 '100*load'
   carries overhang 2 '20*load' 100
   says 'overhang: the share of SIDE1' "$work/overhang.out" '0.769231'
   says 'overhang: a note' "$work/overhang.out" 'SIDE2 COVERS ONLY A PART OF SIDE1 OF JOINT 1'
   ask 'no force beyond SIDE2' overhang all 'x > -1e-9 and x < 50 + 1e-9'
}

# The bolted cantilever with a finer end plate, each bolt in a node of it: the bolts clamp what the joint carries.
sed 's/^BLOCK3  2       1       1       6       2/BLOCK3  2       1       1       6       4/; s/^BLOCK3  3       1       5       2       2/BLOCK3  3       1       5       2       4/
     s/^CROD    901 .*/CROD,901,90,5,243/; s/^CROD    902 .*/CROD,902,90,17,263/; s/^JOINT .*/JOINT,1,1,22,20/' input/bolted_cantilever.bdf > "$work/bolts_apart.bdf"
run bolts_apart && {
   says 'bolts: the joint hangs on lists' "$work/bolts_apart.out" 'JOINTS OF FACES THAT DO NOT MATCH'
   ask 'bolts: preload' bolts_apart rows 'stage = 1' by increment all 'sum(force) = 60000*load within 1e-3'
   ask 'bolts: shear' bolts_apart rows 'stage = 2' by increment all 'abs(sum(tau_x*area)) + abs(sum(tau_y*area)) = 2000*load within 2e-1'
   for method in SKYLINE TREE; do
      sed "s/^METHOD = NEWTON/METHOD = NEWTON\nSOLVER = $method/" "$work/bolts_apart.bdf" > "$work/bolts_$method.bdf"
      run bolts_$method
   done
   same_rows 'bolts, SKYLINE and TREE' bolts_SKYLINE bolts_TREE 1e-7 delta_x tau_x delta_y tau_y
}

# The file of a joint for ParaView has every interface element, also where side 1 is covered in part and one node of it is the
# nearest of two elements. elements_shown FILE: the numbers in the array `element`, each once
elements_shown() {
   local at skip offset n
   at=$(grep -abo '<AppendedData' "$1" | head -n 1 | cut -d: -f1)
   skip=$(tail -c +$((at + 1)) "$1" | head -c 200 | grep -abo _ | head -n 1 | cut -d: -f1)
   offset=$(grep -ao 'Name="element" format="appended" offset="[0-9]*"' "$1" | grep -o '[0-9]*')
   at=$((at + skip + 1 + offset))
   n=$(od -An -tu8 -j $at -N 8 "$1")
   od -An -v -td4 -w4 -j $((at + 8)) -N "$((n))" "$1" | awk '{ print $1 }' | sort -nu
}
for place in '7. 33. 20 21' '22. 61. 20 21' '-9. 31. 20 21' '-9. 31. 21 20'; do
   set -- $place
   cards covered <<DECK
SPC = 1;METHOD = NEWTON;SUBCASE 1;  LOAD = 10;  OUTPUT = LAST, VTU
BEGIN BULK;BLOCK2,1,1,3,1,0.,0.;+,60.,10.;+,23,,20;BLOCK2,2,1,3,1,$1,10.;+,$2,20.,,,,,101,101;+,21,,22;PMARK,23
PMARK,20;PMARK,21;PMARK,22;PSHELL,1,1,2.;MAT1,1,9500.,,.25;JOINT,1,1,$3,$4;PJOINT,1,1,,,,,0.1;JNORM,1,8.-3,0.5
SPCM,1,12,23;SPC1,1,1,101;PLOADM,10,1.,22;ENDDATA
DECK
   run covered
   same "side 1 covered in part ($place): elements in the VTU file of the joint" "$(elements_shown "$work/covered.joint.vtu")" \
      "$(awk -F, 'NR > 1 { print $5 }' "$work/covered.joint.csv" | sort -nu)"
done
# Faces with eight nodes, distorted: the order of nodes and elements does not matter, nor does a mirror.
solids_apart solids plain && {
   ask 'solids: the joint carries the load' solids by increment all 'sum(force) = 1440*load within 1e-6'
   for form in turned renumbered mirrored; do
      solids_apart $form $form || continue
      [ $form = mirrored ] && sense=-1 || sense=1
      apart=$(furthest_apart solids $form $sense)
      holds "solids, $form: pressures differ by $apart" "$apart >= 0 and $apart < 1e-9"
   done
}

# Nodes that stand up to TOL apart along the faces, divisions graded on one side only: no pair of them makes a moment of its own. The
# moments of reactions and of the joint are those of the load by statics; the free modes of the pair of blocks are those of a rigid body.
cards graded_apart <<'DECK'
METHOD = NEWTON;SPC = 1;LOAD = 1;MODES(FREE) = 4;BEGIN BULK
BLOCK3,1,1,3,2,1,0.0,0.0,0.0;+,60.0,30.0,8.0,,,,1,1;+,,,,,9,21;BLOCK3,2,1,3,2,1,0.0,0.0,8.0;+,60.0,30.0,20.0,1.5,,,101,101;+,,,,,22,10
PMARK,9;PMARK,10;PMARK,21;PMARK,22;PSOLID,1,1;MAT1,1,1.0E5,,0.3,7.0-9;SPCM,1,123,9;JOINT,1,1,22,21,5.0;PJOINT,1,1,1,1;JNORM,1,1.0-3,0.5,3.0E4;JSHEAR,1,1500.0
FORCEM,1,1000.0,0.1,-0.05,-1.0,10;EIGRL,4,,,7;ENDDATA
DECK
run graded_apart && {
   judge 'graded faces: moments of the reactions by statics' -F, '$2 == "ALL" { n += 3; for (k = 12; k <= 14; k++) if (($k - (k == 12 ? 14000 : k == 13 ? -32000 : 3000))^2 > 1e-8) print $0 }
      END { print "checked " n }' "$work/graded_apart.reaction.csv"
   ask 'graded faces: moments of the joint by statics' graded_apart all 'sum(force*(x - 30)) = 100*12 within 1e-6' all 'sum(force*(y - 15)) = -50*12 within 1e-6' \
      all 'abs(sum(tau_x*area*(y - 15)) + sum(tau_y*area*(x - 30))) < 1e-6'
   judge 'graded faces: modes of a rigid body' -F, 'NR > 1 { n++; if ($2 <= 6 ? $3 > 1 : $3 < 1e3) print $0 } END { print "checked " n }' "$work/graded_apart.modes.csv"
}
