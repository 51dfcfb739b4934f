# A deck in NASTRAN's manner, everything in a system that is turned in space, against the same block in the program's own words.

# the cards of a block of 30 x 20 x 20, nodes and elements numbered as BLOCK3 does, marked 20 below and 21 above
block_cards() {
   awk 'function node(i, j, k) { return 1 + (i * 3 + j) * 3 + k }
      BEGIN {
         for (i = 0; i <= 3; i++) for (j = 0; j <= 2; j++) for (k = 0; k <= 2; k++)
            printf "GRID    %-8d        %-8.1f%-8.1f%-8.1f\n", node(i, j, k), 10 * i, 10 * j, 10 * k
         for (i = 0; i < 3; i++) for (j = 0; j < 2; j++) for (k = 0; k < 2; k++) {
            printf "CHEXA,%d,1,%d,%d,%d,%d", ++e, node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)
            printf ",%d,%d\n,%d,%d\n", node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)
         }
         for (k = 0; k <= 2; k += 2) for (i = 0; i < 3; i++) for (j = 0; j < 2; j++) {
            printf "CQUAD4,%d,%d,%d,%d", 101 + 50 * k + 2 * i + j, 20 + k / 2, node(i, j, k), node(i + 1, j, k)
            printf ",%d,%d,30.\n", node(i + 1, j + 1, k), node(i, j + 1, k)
         }
      }'
}

cards habits_own <<'END'
METHOD = NEWTON;SPC = 1;SUBCASE 1;  LOAD = 10;  INCR = 4;SUBCASE 2;  LOAD = 20;  INCR = 4
BEGIN BULK;BLOCK3,1,1,3,2,2,0.,0.,0.;+,30.,20.,20.;+,,,,,20,21;PMARK,20;PMARK,21;SPC1,1,1,28,THRU,36;SPC1,1,2,3
FORCE,10,6,,40.,.1,0.,-1.;FORCE,10,30,,20.,0.,0.,-1.;FORCE,20,6,,40.,.1,0.,-1.;PLOADM,20,.2,21;SPCD,20,30,1,-.003
PSOLID,1,1;MAT1,1,9500.,,.25;JOINT,1,1,20;PJOINT,1,1,2,2,.3,,.1;JNORM,1,8.-3,.5,500.;JSHEAR,2,60.,.4;JINCR,4,4;ENDDATA
END
cards habits_nastran <<'END'
NASTRAN SYSTEM(151)=1;ID block,turned;SOL 106;TIME 10;CEND;ECHO = NONE;METHOD = NEWTON;LINE = 60;SET 3 = 1,2,
  5 THRU 9;DISPLACEMENT(SORT1,;  REAL)=ALL;VELOCITY = 1,2,;  5 THRU 9,;  12;SPC = 9
SUBCASE 1;  SUBTITLE=Pressing;  LOAD = 10;  INCR = 4;  STRESS(PLOT) = 3
SUBCASE 2;  LOAD = 20;  INCR = 4;OUTPUT(PLOT);AXES X,Y,Z
BEGIN BULK;PARAM,POST,-1;PARAM   WTMASS  1.0;PLOTEL,900,1,2;PBARL,77,1,,ROD;+,5.
CORD2R  7       6       2.      30.     1.      2.      30.     2.;+       3.      90.     1.
CORD2C  6       5       10.     0.0     0.0     10.     3.0     4.0;+       12.     0.0     1.0
CORD1R  5       901     902     903
CORD2S  8               0.0     0.0     0.0     0.0     0.0     1.0;+       1.0     0.0     0.0
GRID    901     0       -100.   40.     30.     0;GRID    902     0       -99.    42.     31.     0
GRID    903     0       -100.   45.     20.     0;GRDSET          7                               7;PMARK,20;PMARK,21
SPC1,1,1,28,THRU,36;SPC,2,3,2,0.0;SPCADD,9,1,2;FORCE,11,6,7,40.,.1,0.,-1.;FORCE1,12,30,20.,30,28
LOAD,10,1.,1.,11,1.,12;LOAD,20,1.,1.,11,1.,13;PLOAD4,13,201,-.2,,,,THRU,250;SPCD,13,30,1,-.003
PSOLID,1,1,0,TWO,,,SMECH;MAT1,1,9500.,3800.;JOINT,1,1,20;PJOINT,1,1,2,2,.3,,.1;JNORM,1,8.-3,.5,500.;JSHEAR,2,60.,.4
JINCR,4,4
END
{ block_cards; echo ENDDATA; echo GRID,1,,5.,5.,5.; } >> "$work/habits_nastran.bdf"

run habits_own
if run habits_nastran; then
   same_rows 'turned in its own system' habits_nastran habits_own 1e-10 $resultant
   names='15 entries without effect: NASTRAN, ID, TIME, LINE, DISPLACEMENT, VELOCITY, SUBTITLE, STRESS, OUTPUT, SET, PLOTEL, text behind'
   for way in 'STEP TREE' 'STEP SKYLINE' 'NEWTON TREE' 'NEWTON SKYLINE'; do
      for deck in own nastran; do
         sed -e "s/^METHOD = NEWTON/METHOD = ${way% *}/" -e "s/^SPC = /SOLVER = ${way#* }\n&/" "$work/habits_$deck.bdf" > "$work/habits_way_$deck.bdf"
         run habits_way_$deck
      done
      same_rows "turned in its own system, $way" habits_way_nastran habits_way_own 1e-10 $resultant
   done
   same 'named once on the screen' "$(grep -c "habits_nastran.bdf: $names ENDDATA, PARAM POST, PBARL, CORD2S\$" "$work/habits_nastran.log")" 1
   same 'named once in the listing' "$(grep -c 'ENTRIES WITHOUT EFFECT: NASTRAN, ID, TIME' "$work/habits_nastran.out")" 1
   same 'SUBCASEs are stages: said once' "$(grep -c '2 SUBCASEs are stages of one history' "$work/habits_nastran.log")" 1
   same 'SUBCASEs are stages: not said of a deck of our own' "$(grep -c 'stages of one history' "$work/habits_own.log")" 0
fi
