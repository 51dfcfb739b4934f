# RBE2M, RBE3M, NODEAT, SET with PMARK: the same as by lists of nodes; and --joints, whose cards make the joint that they suggest.

placed_row() { table "$1" 'NODES BY PLACE AND SURFACE' | awk -v name="$2" -v c="$3" '$2 == name { print $c }'; }

# a block on its joint, moved by a tool point over its upper side
block='BLOCK3,1,1,2,2,2,0.0,0.0,0.0;+,20.0,20.0,30.0;+,,,,,20,30;PMARK,20;PMARK,30;PSOLID,1,1;MAT1,1,9500.,,.25
JOINT,1,1,20;PJOINT,1,1,2,2,.3;JNORM,1,8.-3,.5;JSHEAR,2,60.;JINCR,5,3'
head='METHOD = NEWTON;LOAD = 1;INCR = 5'
top='3,6,9,12,15;+,18,21,24,27'
by_place() { # NAME GRID-AND-RIGID NODE [ENTRIES]
   cards "$1" <<DECK
$head;${4:-OUTPUT = ALL};BEGIN BULK;$block
$2;FORCE,1,$3,,100.0,1.0,2.0,-30.0;MOMENT,1,$3,,700.0,0.0,1.0,0.0;ENDDATA
DECK
   run "$1"
}
by_place rigid_list "GRID,901,,12.0,9.0,40.0;RBE2,905,901,123456,$top" 901
by_place rigid_mark "GRID,901,,12.0,9.0,40.0;RBE2M,905,901,123456,30" 901 &&
   same_rows 'RBE2M with GN' rigid_mark rigid_list 1e-12 $resultant
by_place rigid_list "GRID,901,,10.0,10.0,30.0;RBE2,905,901,123456,3,6,9,12,18;+,21,24,27,15" 901
by_place rigid_mark 'RBE2M,905,,123456,30;NODEAT,7001,10.,10.,30.' 7001 && {
   same_rows 'RBE2M with a node of its own' rigid_mark rigid_list 1e-9 $resultant
   same 'NODEAT: the new node, not node 15, which lies in its place' "$(placed_row rigid_mark 7001 1)" 7002
}
by_place rigid_mark 'RBE2M,905,,123456,30;NODEAT,7001,10.,10.,30.,30' 7001 &&
   same 'NODEAT on a surface: the new node of its RBE2M' "$(placed_row rigid_mark 7001 1)" 7002
by_place rigid_mark 'RBE2M,905,15,123456,30' 15 && same_rows 'RBE2M with GN on its surface' rigid_mark rigid_list 1e-9 $resultant
# weights are areas of influence: 1 at corners, 2 along edges, 4 in the middle
by_place mean_list 'GRID,901,,12.0,9.0,40.0;RBE3,905,,901,123456,1.,123,3,9;+,21,27,2.,123,6,12,18,24;+,4.,123,15' 901
by_place mean_mark 'GRID,901,,12.0,9.0,40.0;RBE3M,905,901,123456,123,30' 901 && same_rows 'RBE3M' mean_mark mean_list 1e-9 $resultant
by_place mean_list 'GRID,901,,10.0,10.0,30.0;RBE3,905,,901,123456,1.,123,3,9;+,21,27,2.,123,6,12,18,24;+,4.,123,15' 901
by_place mean_mark 'GRID,901,,12.0,9.0,40.0;RBE3M,905,901,123456,123456,30' 901 && {
   says 'RBE3M, 123456 in C: on the screen' "$work/mean_mark.log" 'without effect: 456 in C of RBE3M'
}
by_place mean_mark 'RBE3M,905,0,123456,123,30' 28 && {
   same_rows 'RBE3M: its node stands at the centroid, behind the last' mean_mark mean_list 1e-9 $resultant
   same 'RBE3M: the node' "$(placed_row mean_mark 0 1)" 28
   near 'RBE3M: x of the centroid' "$(placed_row mean_mark 0 5)" 10 1e-12
   near 'RBE3M: z of the centroid' "$(placed_row mean_mark 0 7)" 30 1e-12
}

# NODEAT, the nearest of all and of a surface; WATCH, by its number and by a surface
by_place near 'RBE2M,905,15,123456,30;NODEAT,7001,10.,10.,14.;NODEAT,7002,10.,10.,14.,30;NODEAT,7003,5.,5.,30.' 7002 'WATCH = SET 4;SET 4 = 7001, PMARK 30' && {
   same 'NODEAT: of all nodes' "$(placed_row near 7001 1)" 14
   same 'NODEAT: of a surface' "$(placed_row near 7002 1)" 15
   near 'NODEAT: distance' "$(placed_row near 7001 8)" 1 1e-9
   same 'NODEAT: of equally near ones the lowest' "$(placed_row near 7003 1)" 3
   same 'SET of NODEAT and PMARK' "$(awk -F, 'NR > 1 { n = n " " $2 } END { print n }' "$work/near.watch.csv")" ' 7003 6 9 12 7001 7002 18 21 24 27'
}
# results have the numbers of NODEAT, of two of one node the first: joint history, summary, messages; GN of an RBE2M may be one
by_place named 'RBE2M,905,15,123456,30;NODEAT,7004,,,;NODEAT,7005,,,' 15 'WATCH = SET 4;SET 4 = 7005' && {
   same 'NODEAT in the joint history' "$(awk -F, '$2 == 3 && $5 == 1 { print $6 }' "$work/named.joint.csv")" 7004
   same 'NODEAT in WATCH' "$(awk -F, 'END { print $2 }' "$work/named.watch.csv")" 7004
   "$program" -q -o "$work" --summary "$work/named.sum" "$work/named.bdf" > "$work/named.log" 2>&1
   same 'NODEAT in the summary' "$(awk -F, 'NR == 1 { for (c = 1; c <= NF; c++) if ($c == "watched") n = c } END { print $n }' "$work/named.sum")" 7004
}
sed 's/^\(JAMPL.*\)2$/\1 2       7004/; s/^ENDDATA/NODEAT,7004,,,\n&/' input/bolted_lap.bdf > "$work/named.bdf"
grep -q '7004$' "$work/named.bdf" && "$program" --check "$work/named.bdf" > "$work/named.log" 2>&1
same 'NODEAT as GID of JAMPL' $? 0
by_place near_gn 'RBE2M,905,7004,123456,30;NODEAT,7004,10.,10.,30.,30' 7004 && same_rows 'RBE2M with a GN of NODEAT' near_gn rigid_mark 1e-9 $resultant
by_place near_list 'RBE2M,905,15,123456,30' 15 && same_rows 'force on NODEAT' near near_list 0 $resultant

# an even traction by RBE3M on faces of second order: the pressure of the joint is even
for order in 1 2; do
   cards even <<DECK
$head;SPC = 1;BEGIN BULK;BLOCK3,1,1,3,2,2,0.0,0.0,0.0;+,30.0,20.0,30.0;+,,,,,20,30,,$order
PMARK,20;PMARK,30;PSOLID,1,1;MAT1,1,9500.,,.25;JOINT,1,1,20;PJOINT,1,1;JNORM,1,8.-3,.5;JINCR,5,2;SPC1,1,12,1;SPC1,1,2,25
RBE3M,905,,123,123,30;NODEAT,99,15.,10.,30.1,;FORCE,1,99,,1200.0,0.0,0.0,-1.0;ENDDATA
DECK
   run even && ask "RBE3M: even pressure, order $order" even rows 'increment = 2' all 'pressure = 2.0 within 1e-9'
done

# a beam and a bolt between two such nodes: CBAR and CROD take the numbers of NODEAT
cards spanned <<'DECK'
METHOD = NEWTON;SPC = 1;SUBCASE 1;SUBCASE 2;LOAD = 1;BEGIN BULK
BLOCK3,1,1,2,2,1,0.0,0.0,0.0;+,20.0,20.0,10.0;+,,,,,10,11;BLOCK3,2,1,2,2,1,0.0,0.0,10.0;+,20.0,20.0,20.0,,,,101,101;+,,,,,12,13
PSOLID,1,1;MAT1,1,210000.,,.3;PMARK,10;PMARK,11;PMARK,12;PMARK,13;JOINT,1,1,12,11;PJOINT,1,1;JNORM,1,8.-3,.5
RBE3M,501,,123456,123,10;RBE3M,502,,123456,123,13;NODEAT,9001,10.,10.,-.1;NODEAT,9002,10.,10.,20.1
CROD,601,6,9001,9002;PROD,6,1,50.;BOLT,1,601,2000.,1;SPC1,1,123,1,5,13;SPC1,1,12,101,103;FORCE,1,9002,,500.,0.,0.,1.;ENDDATA
DECK
run spanned && same 'bolt between NODEATs' "$(awk -F, 'NR > 1 && $1 == 1 { v = $5 } END { print v + 0 }' "$work/spanned.bolt.csv")" 2000

# ---- --joints: the two blocks meshed apart, its cards pasted into the deck ----

cards loose_blocks <<'DECK'
METHOD = NEWTON;LOAD = 1;INCR = 5;SPC = 1
BEGIN BULK
BLOCK3,1,1,2,2,2,0.0,0.0,0.0;+,20.0,20.0,10.0;BLOCK3,2,1,3,3,1,0.0,0.0,10.02;+,20.0,20.0,20.0,,,,101,101;+,,,,,,13
PSOLID,1,1;MAT1,1,9500.,,.25;PMARK,13;PJOINT,7,1;JNORM,1,8.-3,.5;JINCR,5,2;PLOADM,1,3.0,13;SPC1,1,12,101;SPC1,1,2,125;ENDDATA
DECK
"$program" --joints "$work/loose_blocks.bdf" > "$work/loose_blocks.cards" 2> "$work/loose_blocks.log"
same '--joints: exit status' $? 0
says '--joints: the pair' "$work/loose_blocks.cards" 'face each other: 9 and 4 sides, areas 400.0 and 400.0, gap 0.02'
says '--joints: the gap of the mesh' "$work/loose_blocks.cards" '^JGAP,1,TRUE$'
same '--joints: cards of faces' "$(grep -c '^CQUAD4' "$work/loose_blocks.cards")" 13
says '--joints: the law of the deck' "$work/loose_blocks.cards" '^JOINT,1,7,'
same '--joints writes nothing' "$(ls "$work"/loose_blocks.*.csv "$work"/loose_blocks.out 2> /dev/null)" ''
{ sed '/^ENDDATA/d' "$work/loose_blocks.bdf"; cat "$work/loose_blocks.cards"; echo 'SPC1,1,123,1,7,19,25'; echo ENDDATA; } > "$work/pasted.bdf"
run pasted && near '--joints: its joint bears the load' "$(value pasted rows 'increment = 2' print 'sum(force)' | tail -1)" 1200 1e-6
"$program" --joints "$work/pasted.bdf" > "$work/pasted.cards"
says '--joints: what is there' "$work/pasted.cards" 'JOINT 1 of the deck connects them there'
# the numbers of its elements are above those of each kind of card that shares them, its marks above those of properties
spring='PELAS,800,1.;CELAS1,900,800,25,1,26,1'
for taken in 'CONM2,900,25,,1.-9' 'CMASS2,900,1.-9,25,1' 'CELAS2,900,1.,25,1,26,1' 'CONROD,900,1,27,1,1.' 'RBE2,900,27,3,26' 'CROD,900,7,1,27;PROD,7,1,1.' "$spring"; do
   { sed '/^ENDDATA/d' "$work/loose_blocks.bdf"; echo "$taken" | tr ';' '\n'; echo ENDDATA; } > "$work/taken.bdf"
   "$program" --joints "$work/taken.bdf" > "$work/taken.cards" 2> "$work/taken.log"
   same "--joints beside ${taken%%,*}: numbers of elements" "$(awk -F, '/^CQUAD4/ && (!n || $2 < n) { n = $2 } END { print n }' "$work/taken.cards")" 901
done
same '--joints: marks above those of springs' "$(awk -F, '/^PMARK/ { print $2; exit }' "$work/taken.cards")" 801
sed '/^SPC = 1/d; /^SPC1/d' "$work/loose_blocks.bdf" > "$work/loose.bdf"
sed -i 's/;SPC = 1//' "$work/loose.bdf"
"$program" --joints "$work/loose.bdf" > "$work/loose.cards"
says '--joints: a support' "$work/loose.cards" '^SPCM,1,123,'
same '--joints: its faces' "$(grep -c '^CQUAD4' "$work/loose.cards")" 17

# edges of plane bodies and of rings, faces of tetrahedra, one of them on a wedge
places_edges() { cards places_edges <<DECK
SPC = 1;BEGIN BULK;BLOCK2,1,1,2,1,10.,0.;+,30.,10.;BLOCK2,2,1,3,1,10.,10.02;+,30.,20.,,,,,101,101;$1;MAT1,1,9500.,,.25;SPC1,1,12,1;ENDDATA
DECK
   "$program" --joints "$work/places_edges.bdf" > "$work/places_edges.cards" 2>&1; says "--joints: areas of edges, ${1%%,*}" "$work/places_edges.cards" "$2"; }
places_edges PSHELL,1,1,2. 'bodies 2 and 1 face each other: 3 and 2 sides, areas 40.0 and 40.0, gap 0.02'
places_edges PAXIS,1,1 "3 and 2 sides, areas 251[03]"
cards places_tetra <<'DECK'
SPC = 1;BEGIN BULK;GRID,1,,0.,0.,0.;GRID,2,,10.,0.,0.;GRID,3,,0.,10.,0.;GRID,4,,0.,0.,-10.;GRID,11,,0.,0.,.02;GRID,12,,10.,0.,.02
GRID,13,,0.,10.,.02;GRID,14,,0.,0.,10.;GRID,21,,0.,-9.,-2.;GRID,22,,10.,-9.,-2.;GRID,24,,0.,-9.,-10.;CPENTA,3,1,1,4,2,21,24,22
CTETRA,1,1,1,3,2,4;CTETRA,2,1,11,12,13,14;PSOLID,1,1;MAT1,1,9500.,,.25;SPC1,1,123,1,2,4;ENDDATA
DECK
"$program" --joints "$work/places_tetra.bdf" > "$work/places_tetra.cards" 2>&1
says '--joints: faces of tetrahedra' "$work/places_tetra.cards" '1 and 1 sides, areas 50.0 and 50.0, gap 0.02 to 0.02, normal (0, 0, 1)'

# edges in the plane, triangles of tetrahedra; a small body before a face whose centre sees nothing of it has no joint
cards strips <<'DECK'
METHOD = NEWTON;SPC = 1;LOAD = 1;INCR = 5;BEGIN BULK
BLOCK2,1,1,4,2,0.0,0.0;+,40.0,20.0,,,,,1,1;BLOCK2,2,1,2,2,0.0,20.0;+,40.0,40.0,,,,,101,101;PSHELL,1,1,1.0;MAT1,1,9500.,,.25
PJOINT,1,1;JNORM,1,8.-3,1.0;JINCR,5,2;SPC1,1,12,1,4,7,10,13;FORCE,1,106,,10.,0.,-1.;SPC1,1,1,103,106;ENDDATA
DECK
"$program" --joints "$work/strips.bdf" > "$work/strips.cards"
same '--joints in the plane: edges' "$(grep -c '^CBAR' "$work/strips.cards")" 6
{ sed '/^ENDDATA/d' "$work/strips.bdf"; cat "$work/strips.cards"; echo ENDDATA; } > "$work/pasted.bdf"
run pasted && near '--joints in the plane: its joint bears the load' "$(value pasted rows 'increment = 2' print 'sum(force)' | tail -1)" 10 1e-9
cards tetras <<'DECK'
METHOD = NEWTON;LOAD = 1;SPC = 1;MODEL = SPACE;BEGIN BULK
GRID,1,,0.,0.,0.;GRID,2,,10.,0.,0.;GRID,3,,0.,10.,0.;GRID,4,,0.,0.,10.;GRID,11,,0.,0.,0.;GRID,12,,10.,0.,0.;GRID,13,,0.,10.,0.;GRID,14,,0.,0.,-10.
CTETRA,1,1,1,2,3,4;CTETRA,2,1,11,13,12,14;PSOLID,1,1;MAT1,1,9500.,,.25;FORCE,1,4,,10.,0.,0.,-1.;SPC1,1,123,11,12,13,14;ENDDATA
DECK
same '--joints of tetrahedra' "$("$program" --joints "$work/tetras.bdf" | grep '^CTRIA3' | paste -sd' ')" 'CTRIA3,3,2,1,3,2 CTRIA3,4,3,11,12,13'
cards beside <<'DECK'
METHOD = NEWTON;SPC = 1;LOAD = 1;INCR = 5;BEGIN BULK
BLOCK3,1,1,1,1,1,0.0,0.0,0.0;+,10.0,10.0,10.0,,,,1,1;BLOCK3,2,1,1,1,1,10.19,1.0,1.0;+,12.19,3.0,3.0,,,,201,201
PSOLID,1,1;MAT1,1,9500.,,.25;JINCR,5,2;FORCE,1,202,,100.,0.,0.,-1.;SPC1,1,123,1,2,3,201,202,203;ENDDATA
DECK
"$program" --joints "$work/beside.bdf" > "$work/beside.cards"
says '--joints: one body alone sees the other' "$work/beside.cards" 'only body 2 has sides opposite to the other, apart: no JOINT'
# a joint for each plane and distance: a step of the lower body under the upper one, 0 below, 0.5 above, 0.02 beside it. Without PJOINT
# its comments have a published surface
cards places_step <<'DECK'
METHOD = NEWTON;SPC = 1;LOAD = 1;INCR = 5;BEGIN BULK
BLOCK3,1,1,4,2,1,0.0,0.0,0.0;+,40.0,20.0,10.0,,,,1,1;BLOCK3,2,1,2,2,1,20.0,0.0,10.0;+,40.0,20.0,19.5,,,,201,201;+,,,,,,,1
BLOCK3,3,1,4,2,1,0.0,0.0,20.0;+,40.0,20.0,30.0,,,,401,401;BLOCK3,4,1,2,2,1,0.0,0.0,10.0;+,19.98,20.0,20.0,,,,601,601;+,,,,,,,3
PSOLID,1,1;MAT1,1,9500.,,.25;JINCR,5,2;FORCE,1,402,,100.,0.,0.,-1.;SPC1,1,123,1,3,5;SPC1,1,12,401,430;ENDDATA
DECK
"$program" --joints "$work/places_step.bdf" > "$work/places_step.cards"
places_kinds() { awk -F'[ ,]+' '/gap/ { sub(/.*gap /, ""); print }' "$work/$1.cards" | paste -sd';'; }
same '--joints: planes and distances' "$(places_kinds places_step)" \
   '0.0 to 0.0, normal (0, 0, 1);0.5 to 0.5, normal (0, 0, 1);0.02 to 0.02, normal (-1, 0, 0)'
same '--joints: gaps of two of them' "$(grep '^JGAP' "$work/places_step.cards" | paste -sd' ')" 'JGAP,2,TRUE JGAP,3,TRUE'
says '--joints: a published surface' "$work/places_step.cards" "^\$ INCLUDE 'surfaces/mm_n/ground_on_ground.bdf'"
{ sed '/^ENDDATA/d' "$work/places_step.bdf"; cat "$work/places_step.cards"; echo 'PJOINT,1,1'; echo 'JNORM,1,8.-3,.5'; echo ENDDATA; } > "$work/places_stepped.bdf"
run places_stepped && near '--joints: the plane without a gap bears the load' \
   "$(value places_stepped rows 'increment = 2 and joint = 1' print 'sum(force)' | tail -1)" 100 1e-6
# marks of the deck divide a plane: half of the lower side is 31, the rest 32, on the upper body one mark, which both joints name
{ sed 's/^ENDDATA/PMARK,31\nPMARK,32\nPMARK,33/' "$work/places_step.bdf"
   sed -n 's/^CQUAD4,\(60[56]\),2,/CQUAD4,\1,31,/p; s/^CQUAD4,\(60[78]\),2,/CQUAD4,\1,32,/p; s/^\(CQUAD4,6[01][0-9],\)3,/\133,/p' "$work/places_step.cards"
   echo ENDDATA; } > "$work/places_marked.bdf"
"$program" --joints "$work/places_marked.bdf" > "$work/places_marked.cards"
same '--joints: by the marks of the deck' "$(awk -F, '/^JOINT/ { print $4, $5 }' "$work/places_marked.cards" | sort | paste -sd';')" '31 33;32 33;34 35;36 37'
# a mark over several planes is no side of a joint
sed 's/^CQUAD4,605,31,.*/&\nCQUAD4,801,31,202,208,210,204/' "$work/places_marked.bdf" > "$work/places_over.bdf"
"$program" --joints "$work/places_over.bdf" > "$work/places_over.cards"
same '--joints: no mark of two planes' "$(grep -c '^JOINT.*,31,' "$work/places_over.cards")" 0

# shells: the faces that lie on each other, half a thickness off the nodes, and a surface of Gmsh's mesh that is missing
cards sheets <<'DECK'
METHOD = NEWTON;SPC = 1;LOAD = 1;INCR = 5;MODEL = SPACE;BEGIN BULK
GRID,1,,0.,0.,0.;GRID,2,,10.,0.,0.;GRID,3,,10.,10.,0.;GRID,4,,0.,10.,0.;GRID,5,,0.,0.,4.;GRID,6,,10.,0.,4.;GRID,7,,10.,10.,4.;GRID,8,,0.,10.,4.
CQUAD4,1,1,1,2,3,4;CQUAD4,2,2,8,7,6,5;PSHELL,1,1,3.,1,,1;PSHELL,2,1,5.,1,,1;MAT1,1,9500.,,.25
PJOINT,7,1;JNORM,1,8.-3,.5;JINCR,5,2;PLOAD2,1,3.0,2;SPC1,1,123456,1,2,3,4;SPC1,1,126,5,6,7,8;ENDDATA
DECK
"$program" --joints "$work/sheets.bdf" > "$work/sheets.cards"
says '--joints: faces of shells' "$work/sheets.cards" 'face each other: 1 and 1 sides, areas 100.0 and 100.0, gap 0.0 to 0.0'
{ sed '/^ENDDATA/d' "$work/sheets.bdf"; cat "$work/sheets.cards"; echo ENDDATA; } > "$work/pasted.bdf"
run pasted && near '--joints: the joint of the sheets bears the load' "$(value pasted rows 'increment = 2' print 'sum(force)' | tail -1)" 300 1e-6
"$program" --joints "$work/pasted.bdf" > "$work/pasted.cards"
says '--joints: the sheets have it' "$work/pasted.cards" 'JOINT 1 of the deck connects them there'
sed "s|gmsh/|$PWD/input/gmsh/|; s/^PMARK   42\r*$/&\nPMARK   199/" input/bracket.bdf > "$work/groups.bdf"
run groups 2 > "$work/groups.said"
says 'a face in two groups of Gmsh' "$work/groups.log" 'Gmsh writes a face once'
