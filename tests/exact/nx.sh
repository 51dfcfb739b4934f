# Contact, glue and bolts as NX and Femap write them, against the same models in cards of this program and against closed forms.

printf 'PJOINT,1,1,2,2,.15\nJNORM,1,1.-4,.5,1.+6\nJSHEAR,2,1.+4\n' > "$work/law.inc"
nx_flange() { awk -v form="$2" -v source="${3:-}" -v law="$work/law.inc" -f tests/exact/nx_cards.awk > "$work/$1.bdf"; }
nx_run() { "$program" -q -o "$work" --law "$work/law.inc" "$work/$1.bdf" > "$work/$1.log" 2>&1 || { cat "$work/$1.log"; fail "$1"; }; }

nx_flange own own && run own && {
   nx_flange faces nx BSURFS && nx_run faces
   for file in joint bolt; do
      same "faces: the same $file.csv" "$(cmp "$work/own.$file.csv" "$work/faces.$file.csv" && echo same)" same
   done
   says 'the listing names the contact' "$work/faces.out" 'CONTACT OF REGIONS 7 AND 8, SURFACES 7 AND 8: JOINT 1, PJOINT 1, MU 0.15'
   says 'and each bolt' "$work/faces.out" 'BOLT 2, ELEMENT 9102: TIGHTENED TO 5000'
   near 'tightened without the load, the joint bears the preloads' "$(value faces rows 'stage = 1' rows 'increment = max(increment)' print 'sum(force)')" 10000 1e-7
   nx_flange bodies nx BCPROPS && nx_run bodies && same_rows 'free faces of whole bodies' own bodies 1e-7 tau_x tau_y
   # each SUBCASE starts from the preload: the second is what it is alone
   awk '/^LOAD = 1$/ { next } /^BCSET/ { print; print "SUBCASE 3\nLOAD = 5\nSUBCASE 4\nLOAD = 1"; next } /^FORCE,1,/ { print; sub(/^FORCE,1,/, "FORCE,5,"); sub(/300\./, "200.") } { print }' \
      "$work/faces.bdf" > "$work/cases.bdf"
   nx_run cases && near 'a case from the preload' "$("$query" "$work/cases.bolt.csv" rows 'stage = 4 and bolt = 1' rows 'increment = max(increment)' print force)" \
      "$("$query" "$work/own.bolt.csv" rows 'stage = 2 and bolt = 1' rows 'increment = max(increment)' print force)" 1e-9
}

# nx_blocks NAME CONTROL CARDS [E P]: two blocks 10 x 10 x 10 on each other, the upper one pressed by P; the lower has 2 x 2 elements across, the upper 3 x 3.
nx_blocks() {
   cards "$1" <<DECK
SOL 101;CEND;$2;SPC = 1;LOAD = 1;BEGIN BULK;BLOCK3,1,1,2,2,2,0.,0.,0.;+,10.,10.,10.,,,,1,1;+,,,,,19;BLOCK3,2,2,3,3,2,0.,0.,10.
+,10.,10.,20.,,,,101,101;+,,,,,,29;PSOLID,1,1;PSOLID,2,1;MAT1,1,${4:-210000.},,.0;PMARK,19;PMARK,29;SPCM,1,3,19;SPC1,1,12,1;SPC1,1,1,4
SPC1,1,12,101;SPC1,1,1,104;PLOADM,1,${5:-5.},29;$3;ENDDATA
DECK
   run "$1"
}
# the default law: lambda = 4.6E-5 mm p^0.48, here in mm and N by E
nx_blocks default 'BCSET = 1' 'BCPROPS,1,1;BCPROPS,2,2;BCTSET,1,2,1' && {
   ask 'every node follows the default law' default all "lambda = $(number '4.6e-5*5^0.48') within 1e-7*$(number '4.6e-5*5^0.48')" all 'pressure = 5 within 1e-6'
   says 'the screen gives its numbers' "$work/default.log" 'C = 4.6E-5, M = 0.48, EU = 1.64E6'
   says 'and the listing' "$work/default.out" 'GROUND STEEL'
}
nx_blocks metre 'UNITS = M, N;BCSET = 1' 'BCPROPS,1,1;BCPROPS,2,2;BCTSET,1,2,1' 2.1+11 5.+6 && \
   ask 'in m and N' metre all "lambda = $(number '4.6e-8*5^0.48') within 1e-9*$(number '4.6e-8*5^0.48')"

# glue of faces that do not match: a constant stress passes exactly, u = -p (z)/E at the top
nx_blocks glued 'METHOD = NEWTON;BGSET = 3;OUTPUT = ALL' 'BCPROPS,1,1;BCPROPS,2,2;BGADD,3,4;BGSET,4,2,1' && {
   for n in 103 124 148; do near "glued, node $n" "$(moved glued $n 3)" "-5*20/210000" 2e-6; done
   says 'the listing names the glue' "$work/glued.out" 'GLUE OF REGIONS 2 AND 1'
}
# a chain of three blocks whose faces match, glued, is one block: a cantilever under its end load
nx_chain() {
   cards "$1" <<DECK
SOL 101;CEND;${4:+BGSET = 1};SPC = 1;LOAD = 1;OUTPUT = ALL;BEGIN BULK;BLOCK3,1,1,4,2,2,0.,0.,0.;+,10.,5.,5.,,,,1,1;+,9
BLOCK3,2,2,4,2,2,10.,0.,0.;+,20.,5.,5.,,,,101,101$2;BLOCK3,3,3,4,2,2,20.,0.,0.;+,30.,5.,5.,,,,201,201;+,,8,,,,,$3
PSOLID,1,1;PSOLID,2,1;PSOLID,3,1;MAT1,1,210000.,,.3;PMARK,9;PMARK,8;SPCM,1,123,9;FORCEM,1,100.,0.,0.,1.,8;$4;ENDDATA
DECK
   run "$1"
}
nx_chain chain '' '' 'BCPROPS,1,1;BCPROPS,2,2;BCPROPS,3,3;BGSET,1,1,2;+,,2,3' && nx_chain whole ';+,,,,,,,1' 2 '' && {
   for n in 237 241 245; do near "chain, node $n" "$(moved chain $n 3)" "$(moved whole $n 3)" 1e-9; done
}

# solid bolts: the section by its nodes or by the elements on both sides of a node is that of a marked surface
nx_solid_bolt() {
   awk -v cards="$2" -v before="$3" '/^BOLT/ { gsub(/;/, "\n", cards); print cards; next }
      /^SUBCASE 1/ { print before == "" ? $0 "\nBOLTLD = 9" : "BOLTLD = 9\n" before; next } before != "" && /^SUBCASE 2/ { print "SUBCASE 30"; next }
      { print }' input/solid_bolt.bdf > "$work/$1.bdf"
   run "$1"
}
run_input solid_bolt
for section in '2,0,3,603,606,609,612' '3,0,3,603,,,;,601,602,651,652'; do
   nx_solid_bolt section "BOLT,1,$section;BOLTFOR,9,6000.,1" '' && \
      same "bolt of ETYPE ${section%%,*}: the same bytes" "$(cmp "$work/solid_bolt.joint.csv" "$work/section.joint.csv" && echo same)" same
done
# the preload acts along the axis IDIR, also at a section that is inclined to it: a column held at both ends
cards inclined <<'DECK'
SOL 101;CEND;SPC = 1;SUBCASE 1;BOLTLD = 9;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,4.,0.,0.;GRID,3,,4.,4.,0.;GRID,4,,0.,4.,0.;GRID,5,,0.,0.,4.
GRID,6,,4.,0.,6.;GRID,7,,4.,4.,6.;GRID,8,,0.,4.,4.;GRID,9,,0.,0.,9.;GRID,10,,4.,0.,9.;GRID,11,,4.,4.,9.;GRID,12,,0.,4.,9.
CHEXA,1,1,1,2,3,4,5,6;,7,8;CHEXA,2,1,5,6,7,8,9,10;,11,12;PSOLID,1,1;MAT1,1,1000.,,.0;SPC1,1,123,1,2,3,4;SPC1,1,123,9,10,11,12
BOLT,1,2,0,3,5,6,7,8;BOLTFOR,9,70.,1;ENDDATA
DECK
run inclined && {
   near 'inclined section: the reaction is the preload' \
      "$("$query" "$work/inclined.reaction.csv" rows 'kind = "SPC1" and z = 9 within 1e-6' print force_z)" 70 1e-9
   near 'and the stress that of the cross-section' "$("$query" "$work/inclined.bolt.csv" print stress)" 70/16 1e-9
}
# BOLTSEQ: a bolt tightened in two steps, in stages before the first SUBCASE; the monotonic path has one end
nx_solid_bolt sequence 'BOLT,1,2,0,3,603,606,609,612;BOLTFOR,3,2500.,1;BOLTFOR,4,6000.,1;BOLTSEQ,9;+,2,4;+,1,3' 'SUBCASE 20' && {
   near 'first step' "$("$query" "$work/sequence.bolt.csv" rows 'stage = 18' print force)" 2500 1e-9
   near 'second step' "$("$query" "$work/sequence.bolt.csv" rows 'stage = 19' print force)" 6000 1e-9
   says 'each step is named' "$work/sequence.log" 'bolt 1, section of surface 41: tightened to 2500 in SUBCASE 18'
}

# glued faces that do not match and overhang: forces and moments balance, either side first; glued shells carry the force of their lap
nx_overhang() {
   cards "$1" <<DECK
SOL 101;CEND;BGSET = 1;SPC = 1;LOAD = 1;BEGIN BULK;BLOCK3,1,1,5,2,2,0.,0.,0.;+,50.,20.,20.,,,,1,1;+,9;BLOCK3,2,2,7,3,2,23.,0.,20.
+,83.,20.,40.,,,,1001,1001;+,,8;PMARK,8;PMARK,9;PSOLID,1,1;PSOLID,2,1;MAT1,1,210000.,,.3;SPCM,1,123,9;FORCEM,1,1000.,0.,0.,1.,8
BCPROPS,1,1;BCPROPS,2,2;BGSET,1,$2;ENDDATA
DECK
   run "$1" && "$query" "$work/$1.reaction.csv" rows 'kind = "SPCM"' all 'force_z = -1000 within 1e-6' all 'moment_y = 83000 within 1e-3' > "$work/said" 2>&1 \
      && passed=$((passed + 1)) || { cat "$work/said"; fail "$1: balance"; }
}
nx_overhang over '1,2'
nx_overhang under '2,1'
# two strips of shells, 2 thick, the upper one on the lower one: by elements and by properties
cards nx_lap <<'DECK'
SOL 101;CEND;BGSET = 1;SPC = 1;LOAD = 1;BEGIN BULK;PSHELL,1,1,2.0,1,,1;PSHELL,2,1,2.0,1,,1;MAT1,1,210000.,,.3
GRID,1,,0.,0.,0.;GRID,2,,10.,0.,0.;GRID,3,,20.,0.,0.;GRID,4,,30.,0.,0.;GRID,11,,0.,10.,0.;GRID,12,,10.,10.,0.;GRID,13,,20.,10.,0.;GRID,14,,30.,10.,0.
GRID,21,,17.,0.,2.;GRID,22,,27.,0.,2.;GRID,23,,40.,0.,2.;GRID,31,,17.,10.,2.;GRID,32,,27.,10.,2.;GRID,33,,40.,10.,2.
CQUAD4,1,1,1,2,12,11;CQUAD4,2,1,2,3,13,12;CQUAD4,3,1,3,4,14,13;CQUAD4,4,2,21,22,32,31;CQUAD4,5,2,22,23,33,32
BSURF,1,2,3;BCPROP,2,2;BCRPARA,1,TOP;BCRPARA,2,BOT;BGSET,1,2,1;SPC1,1,123456,1,11;FORCE,1,23,,50.,1.,0.,2.;FORCE,1,33,,50.,1.,0.,2.;ENDDATA
DECK
run nx_lap && {
   near 'glued shells: force along' "$(total nx_lap SUPPORTS 1)" -100 1e-9
   near 'glued shells: force across' "$(total nx_lap SUPPORTS 3)" -200 1e-9
   near 'glued shells: moment' "$("$query" "$work/nx_lap.reaction.csv" print 'sum(moment_y)')" '200*40 - 100*2' 1e-6
}

# the script of the manual for .inp of CalculiX: contact with friction and a pretension section, in the numbers of the mesh
nx_python=${PYTHON:-python3}
if "$nx_python" -c '' > /dev/null 2>&1; then
   awk '/^A second script reads contact/ { here = 1 } here && /^```$/ { exit } on { print } here && /^```python/ { on = 1 }' input/README.md > "$work/joints_of_inp.py"
   tr ';' '\n' > "$work/columns.inp" <<'INP'
*NODE, NSET=ALL;11, 0., 0., 0.;12, 4., 0., 0.;13, 4., 4., 0.;14, 0., 4., 0.;21, 0., 0., 5.;22, 4., 0., 5.;23, 4., 4., 5.;24, 0., 4., 5.
** a second body;31, 0., 0., 5.;32, 4., 0., 5.;33, 4., 4., 5.;34, 0., 4., 5.;41, 0., 0., 9.;42, 4., 0., 9.;43, 4., 4., 9.;44, 0., 4., 9.
*ELEMENT, TYPE=C3D8R, ELSET=LOWER;7, 11,12,13,14,21,;22,23,24;*Element, type=C3D8, elset=UPPER;8, 31,32,33,34,41,42,43,44
*SURFACE, NAME=TOP;LOWER, S2;*SURFACE, NAME=FOOT;8, S1;*SURFACE INTERACTION, NAME=STEEL;*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
*FRICTION;0.2, 1.E5;*CONTACT PAIR, INTERACTION=STEEL, TYPE=SURFACE TO SURFACE;FOOT, TOP;*STEP;*STATIC;*END STEP
INP
   "$nx_python" "$work/joints_of_inp.py" "$work/columns.inp" "$work/columns.inc" > "$work/said" 2>&1 || cat "$work/said"
   same 'cards of the .inp' "$(tr '\n' ' ' < "$work/columns.inc")" \
      'PMARK,9001 CQUAD4,90000002,9001,5,8,7,6 PMARK,9002 CQUAD4,90000004,9002,9,10,11,12 BCTSET,1,9002,9001,0.2 '
   awk 'BEGIN { print "SOL 101\nCEND\nBCSET = 1\nSPC = 1\nLOAD = 1\nBEGIN BULK" }
      /^[0-9]/ && NF == 4 && $4 ~ /\./ { printf "GRID,%d,,%s%s%s\n", ++n, $2, $3, $4 }' "$work/columns.inp" > "$work/columns.bdf"
   { printf 'CHEXA,7,1,1,2,3,4,5,6\n,7,8\nCHEXA,8,1,9,10,11,12,13,14\n,15,16\nPSOLID,1,1\nMAT1,1,210000.,,.0\nSPC1,1,123,1,2,3,4\n'
     printf 'FORCE,1,%d,,40.,.1,0.,-1.\n' 13 14 15 16
     printf "INCLUDE 'columns.inc'\nENDDATA\n"; } >> "$work/columns.bdf"
   run columns && {
      near 'the contact of the .inp bears the load' "$(value columns print 'sum(force)')" 160 1e-9
      near 'and the friction' "$(value columns print 'sum(area*tau_x)')" 16 1e-9
   }
else
   echo 'skipped: the script for .inp: there is no python3'
fi
"$program" -q -o "$work" --law "$work/no_such.inc" "$work/default.bdf" > "$work/said" 2>&1
same 'a law that is not there: status' $? 2
says 'and its name' "$work/said" "--law $work/no_such.inc: the file cannot be read"

# A small foot glued on the middle of one large face: no node of the face is covered, and the screen says that nothing is tied; with SID and TID
# the other way round the foot bears its load. At a distance nothing balances the moment of the shear.
glued_foot() { # NAME SIDES HEIGHT
   cards "$1" <<DECK
METHOD = NEWTON;SPC = 1;BGSET = 20;LOAD = 10;BEGIN BULK;GRID,1,,0.0,0.0,0.0;GRID,2,,20.0,0.0,0.0;GRID,3,,0.0,16.0,0.0;GRID,4,,20.0,16.0,0.0;GRID,5,,0.0,0.0,8.0
GRID,6,,20.0,0.0,8.0;GRID,7,,0.0,16.0,8.0;GRID,8,,20.0,16.0,8.0;GRID,9,,5.0,4.0,$3;GRID,10,,15.0,4.0,$3;GRID,11,,5.0,12.0,$3;GRID,12,,15.0,12.0,$3
GRID,13,,5.0,4.0,14.0;GRID,14,,15.0,4.0,14.0;GRID,15,,5.0,12.0,14.0;GRID,16,,15.0,12.0,14.0;CHEXA,1,1,1,2,4,3,5,6;,8,7;CHEXA,2,1,9,10,12,11,13,14;,16,15
PSOLID,1,1;MAT1,1,210000.0,,0.3;PLOAD4,10,2,2.0,,,,13,16;BSURFS,1,,,,1,5,6,8;BSURFS,2,,,,2,9,10,12;BGSET,20,$2,1.0;SPC1,1,123,1,2,3,4;ENDDATA
DECK
}
glued_foot foot_nothing 1,2 8.0
run foot_nothing 3
says 'glue that ties nothing' "$work/foot_nothing.log" 'it ties 0 nodes of its side SID, as many as lie on the part that TID covers'
glued_foot foot_glued 2,1 8.0
run foot_glued && {
   near 'glue, the other way round: the load' "$(total foot_glued SUPPORTS 3)" 2*80 1e-9
   same 'glue, the other way round: nothing to say' "$(grep -c 'glue of surfaces.*:' "$work/foot_glued.log")" 0
}
glued_foot foot_apart 2,1 8.5
run foot_apart && says 'glue at a distance' "$work/foot_apart.log" 'its faces stand apart or overlap by up to 0.5, and are joined as if they touched; nothing balances'
