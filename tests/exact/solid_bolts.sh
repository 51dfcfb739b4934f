# Solid bolts: the balance of bolt and joints, by every method; a section may lie anywhere in the shank and face either way.

# bolted NAME METHOD SECTION [STAGES]: two discs between the head and the nut of a bolt on their axis, y 0 to 10 and 10 to 20, bore radius
# 2, shank radius 1.5. The lower disc is held, the bolt tightened to 1000, then the upper disc lifted by 300. Joints: 1 between the
# discs, 2 under the head, 3 on the nut. SECTION: the two nodes of the edge across the shank at which the bolt is cut.
bolted() {
   { printf 'METHOD = %s\nSPC = 1\nSUBCASE 1\n  INCR = 5\n' "$2"
     [ "${4:-2}" = 2 ] && printf 'SUBCASE 2\n  LOAD = 10\n  INCR = 5\n'
     tr ';' '\n' <<'DECK'
BEGIN BULK;MAT1,1,1000.0,,0.3;PAXIS,1,1;BLOCK2,1,1,3,2,2.0,0.0;+,8.0,10.0;+,,,20
BLOCK2,2,1,3,2,2.0,10.0;+,8.0,20.0,,,,,51,51;+,21,34;BLOCK2,3,1,1,2,0.0,0.0;+,1.5,10.0,,,,,101,101
BLOCK2,4,1,1,2,0.0,10.0;+,1.5,20.0,,,,,151,151;+,,,,,3
$ head and nut
GRID,201,,0.0,25.0;GRID,202,,1.5,25.0;GRID,203,,2.0,25.0;GRID,204,,4.0,25.0;GRID,205,,2.0,20.0;GRID,206,,4.0,20.0
GRID,211,,0.0,-5.0;GRID,212,,1.5,-5.0;GRID,213,,2.0,-5.0;GRID,214,,4.0,-5.0;GRID,215,,2.0,0.0;GRID,216,,4.0,0.0
CQUAD4,201,1,153,156,202,201;CQUAD4,202,1,156,205,203,202;CQUAD4,203,1,205,206,204,203;CQUAD4,211,1,211,212,104,101
CQUAD4,212,1,212,213,215,104;CQUAD4,213,1,213,214,216,215;CBAR,301,41,205,206;CBAR,302,42,215,216;CBAR,303,30,53,56
CBAR,304,31,1,4;PMARK,20;PMARK,21;PMARK,30;PMARK,31;PMARK,34;PMARK,40;PMARK,41;PMARK,42;JOINT,1,1,20,21
JOINT,2,1,30,41;JOINT,3,1,42,31;PJOINT,1,1;JNORM,1,1.0-2,0.5,1.0+5;SPC1,1,2,10;SPC1,1,1,101,102,103,152
SPC1,1,1,153,201,211;FORCEM,10,300.0,0.0,1.0,,34;JINCR,5,4;BOLT,1,,1000.0,1,40
DECK
     printf 'CBAR,305,40,%s\nENDDATA\n' "$3"; } > "$work/$1.bdf"
   run "$1"
}
# force NAME STAGE JOINT: normal force at the end of a stage
force() { value "$1" rows "stage = $2" rows "increment = max(increment) and joint = $3" print 'sum(force)'; }
# bolt NAME STAGE FIELD: what the listing has of the bolt at the end of a stage; tension and overlap NAME STAGE
bolt() { table "$1" "BOLT FORCES, SOLID BOLTS (TENSION POSITIVE), STAGE $2" | awk -v k="$3" '$2 == 1 && $3 == 40 { f = $k } END { print f }'; }
tension() { bolt "$@" 4; }
overlap() { bolt "$@" 5; }

for method in NEWTON STEP BACK; do
   stages=2
   [ $method = BACK ] && stages=1
   bolted discs $method 103,106 $stages && {
      near "$method: tightened, the bolt has its preload" "$(tension discs 1)" 1000 1e-5
      [ $method = STEP ] && continue # what opens on the way is left unbalanced
      for joint in 1 2 3; do near "$method: joint $joint bears the preload" "$(force discs 1 $joint)" 1000 1e-8; done
   }
done
bolted discs NEWTON 103,106 && {
   near 'locked: bolt force less joint force is the load' "$(force discs 2 2) - $(force discs 2 1)" 300 1e-7
   near 'locked: the head bears the bolt force' "$(tension discs 2)" "$(force discs 2 2)" 1e-5
   near 'locked: the nut bears what the head does' "$(force discs 2 3)" "$(force discs 2 2)" 1e-8
   near 'locked: the overlap stays' "$(overlap discs 2)" "$(overlap discs 1)" 0
   holds 'locked: bolt and joint share the load' "$(tension discs 2) = 1150 within 149"
   says 'the node of the section is none of the structure' "$work/discs.out" ' NODES  *46$'
}
# to move the section is to move the slice between by the overlap: nothing else changes
for section in 106,103 102,105 105,102 152,155; do
   bolted moved NEWTON $section && same_rows "section $section: the same joints" discs moved 1e-8 $along
done

# a bolt through two plates, in space
run_input solid_bolt && {
   for joint in 1 2 3; do near "plates: joint $joint bears the preload" "$(force solid_bolt 1 $joint)" 6000 1e-8; done
   near 'plates: the bolt has its preload' "$(tension solid_bolt 1)" 6000 1e-5
   near 'plates: bolt force less joint force is the load' "$(force solid_bolt 2 2) - $(force solid_bolt 2 1)" 3000 1e-8
   near 'plates: the head bears the bolt force' "$(tension solid_bolt 2)" "$(force solid_bolt 2 2)" 1e-5
}
