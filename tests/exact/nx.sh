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
   says 'the screen gives its numbers' "$work/default.log" 'C = 4.6E-5, M = 0.48, EU = 216590'
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
SOL 101;CEND;BGSET = 1;SPC = 1;LOAD = 1;OUTPUT = ALL;BEGIN BULK;BLOCK3,1,1,4,2,2,0.,0.,0.;+,10.,5.,5.,,,,1,1;+,9
BLOCK3,2,2,4,2,2,10.,0.,0.;+,20.,5.,5.,,,,101,101$2;BLOCK3,3,3,4,2,2,20.,0.,0.;+,30.,5.,5.,,,,201,201;+,,8,,,,,$3
PSOLID,1,1;PSOLID,2,1;PSOLID,3,1;MAT1,1,210000.,,.3;PMARK,9;PMARK,8;SPCM,1,123,9;FORCEM,1,100.,0.,0.,1.,8;$4;ENDDATA
DECK
   run "$1"
}
nx_chain chain '' '' 'BCPROPS,1,1;BCPROPS,2,2;BCPROPS,3,3;BGSET,1,1,2;+,,2,3' && nx_chain whole ';+,,,,,,,1' 2 '' && {
   for n in 237 241 245; do near "chain, node $n" "$(moved chain $n 3)" "$(moved whole $n 3)" 1e-9; done
}
