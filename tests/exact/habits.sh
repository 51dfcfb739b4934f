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

# One cube under tension, as several programs write it: 10 on E = 1000, a side of 1, no Poisson's ratio: the top rises by 0.01
habits_grid='GRID,1,,0.,0.,0.;GRID,2,,1.,0.,0.;GRID,3,,1.,1.,0.;GRID,4,,0.,1.,0.;GRID,5,,0.,0.,1.;GRID,6,,1.,0.,1.;GRID,7,,1.,1.,1.;GRID,8,,0.,1.,1.'
habits_cube='CHEXA,1,1,1,2,3,4,5,6;,7,8'
habits_load='SPC1,1,123,1,2,3,4;FORCE,2,5,,2.5,0.,0.,1.;FORCE,2,6,,2.5,0.,0.,1.;FORCE,2,7,,2.5,0.,0.,1.;FORCE,2,8,,2.5,0.,0.,1.'
habits_rest="PSOLID,1,1;MAT1,1,1000.,,0.;$habits_load"
habits_sol='SOL 101;CEND;SPC = 1;LOAD = 2'
# habit NAME [WARNING]: the deck on the standard input stretches as it should, and says WARNING
habit() {
   cards "habit_$1"
   run "habit_$1" || return
   near "the habit $1" "$(moved "habit_$1" 7 3)" 0.01 1e-4
   [ "${2:-}" = '' ] || says "the habit $1: said" "$work/habit_$1.log" "$2"
}
habit plain <<< "$habits_sol;BEGIN BULK;$habits_grid;$habits_cube;$habits_rest;ENDDATA"
# long names and short ones, requests without effect, a comment behind a card; a key given twice: the last one counts
habit long_words 'SPC: given twice in the same place; the last one counts' << END
ID CUBE,TENSION;APP DISP;SOL SESTATIC;CEND;TITL = cube;ECHO = SORTED;DISPLACEMENTS = ALL;STRESSES(PLOT,CORNER) = ALL;SPC = 7
SPC = 1;SUBCASE 1;ANALYSIS = STATICS;SUPER = ALL;LABE = tension;LOAD = 2;MPFACTOR = ALL;ELDATA(8,PRINT) = ALL;EQUILIBRIUM = YES;LOADSET = 9
OUTPUT(XYPLOT);XTITLE = FORCE;XYPLOT DISP /5(T3)
BEGIN BULK;$habits_grid;$habits_cube;$habits_rest;ENDDATA
END
# small fields with marks of letters, and text in columns 73 to 80 and behind; the name of a part in a comment
habit text_behind 'text in columns 73 to 80 that is no continuation mark is not read: 2 lines' << END
$habits_sol;BEGIN BULK;\$HMNAME COMP 1 "cube";$habits_grid
CHEXA          1       1       1       2       3       4       5       6+E000001
+E000001       7       8
PSOLID         1       1                                                SOLID
MAT1           1   1000.              0.                                STEEL
$habits_load;ENDDATA
END
# a mark of letters: + takes the place of its first letter in the line behind
habit letter_marks << END
$habits_sol;BEGIN BULK;$habits_grid
CHEXA          1       1       1       2       3       4       5       6CE000001
+E000001       7       8
$habits_rest;ENDDATA
END
same 'a mark of letters is no loose text' "$(grep -c 'columns 73' "$work/habit_letter_marks.log")" 0
habit past_80 'text past column 80 is not read: 1 line' << END
$habits_sol;BEGIN BULK;$habits_grid;$habits_cube
PSOLID         1       1                                                        a, b
MAT1,1,1000.,,0.;$habits_load;ENDDATA
END
# large fields, fields that touch, exponents without a letter or with D
habit large_fields << END
$habits_sol;BEGIN BULK;${habits_grid#*;GRID,2,,1.,0.,0.;}
GRID*                  1                            0.+0 0.0000000000D+00
*       0.0000000000E+00
GRID*                  2                1.0000000000D+000.0000000000D+00
*                     0.
$habits_cube;PSOLID*                1               1               0
MAT1*                  1           1.0+3                              0.
*
$habits_load;ENDDATA
END
# a tab to each field; more entries than fields on one long line; blanks around commas
habits_tab=$'\t'
habit tabs 'tabs are read as blanks up to the next column of eight: .*habit_tabs.bdf, line 3 (one of 10)' << END
SOL 101;CEND;SPC$habits_tab= 1;LOAD = 2;BEGIN BULK;${habits_grid//,/$habits_tab};$habits_cube;PSOLID${habits_tab}1${habits_tab}1
MAT1,1,1000.,,0.;$habits_load;ENDDATA
END
habit one_long_line << END
$habits_sol;BEGIN BULK;$habits_grid;CHEXA,1,1,1,2,3,4,5,6,7,8;$habits_rest;ENDDATA
END
habit blanks_and_commas << END
$habits_sol;BEGIN BULK;$habits_grid;CHEXA   ,       1,       1,       1,       2,       3,       4,       5,       6, +,
+       ,       7,       8;$habits_rest;ENDDATA
END
# zeros for blanks: absent mid-side nodes, PS, CID, fields behind the last one, the ground of a spring; components with a blank
habit zeros << END
$habits_sol;BEGIN BULK;${habits_grid/GRID,8,,0.,1.,1./GRID,8,0,0.,1.,1.,0,0,0};CHEXA,1,1,1,2,3,4,5,6;,7,8,0,0,0,0,0,0;,0,0,0,0,0,0
GRID,9,,5.,5.,5.;GRID,10,,6.,5.,5.;CONROD,2,9,10,1,1.,0.,0.,0.;SPC1,1,12 3,9,10;PBARL,7,1,,BAR;,.01,.1,0.,0.;CELAS2,3,1.-9,5,3,0,0,0.
${habits_rest//,,2.5/,0,2.5};ENDDATA
END
# temperatures of a set for all purposes, a node twice with one value, initial ones in place of TREF: a rise by 5 with A = 2.-3
habit temperatures << END
SOL 101;CEND;SPC = 1;TEMPERATURE = 3;TEMP(INIT) = 4;BEGIN BULK;$habits_grid;$habits_cube;PSOLID,1,1;MAT1,1,1000.,,0.,,2.-3,99.
SPC1,1,3,1,THRU,4;SPC1,1,12,1,THRU,8;TEMPD,3,25.,4,20.;TEMP,3,7,25.;TEMP,3,7,25.;ENDDATA
END
# cards alone, without case control and ENDDATA; cards without BEGIN BULK
habit cards_alone 'the only sets of their kinds are taken: SPC = 1, LOAD = 2' <<< "$habits_grid;$habits_cube;$habits_rest"
habit sums_alone 'the only sets of their kinds are taken: SPC = 9, LOAD = 2' << END
$habits_grid;$habits_cube;$habits_rest;SPC1,3,3,1;SPCADD,9,1,3;MPC,5,7,3,1.,8,3,-2.;MPC,6,7,3,1.,6,3,-2.
END
says 'sets of which none is chosen' "$work/habit_sums_alone.log" 'sets that no case control chooses have no effect: MPC'
habit numbers_again '1 number of rigid elements and masses are those of other elements too, the first 1; NASTRAN wants numbers of their own' << END
$habits_sol;BEGIN BULK;$habits_grid;$habits_cube;$habits_rest;CONM2,1,7,,5.0;ENDDATA
END
habit no_begin 'no BEGIN BULK: the cards begin in .*habit_no_begin.bdf, line 5' <<< "$habits_sol;$habits_grid;$habits_cube;$habits_rest;ENDDATA"
# other kinds of analysis: their cards have no effect on statics; SOL 200 analyses the design of the cards; DMAP is not followed
habit others 'SOL 200: the design of the property cards is analysed once' << END
SOL 200;CEND;DESOBJ = 1;DESSUB = 2;ANALYSIS = STATICS;SPC = 1;LOAD = 2;BEGIN BULK;$habits_grid;$habits_cube;$habits_rest;DEBUG,192,2;USET,U2,1,123;OMIT1,123,7
DESVAR,1,T,1.;DVPREL1,1,PSHELL,1,T;+,1,1.;DCONSTR,1,2,3.;AEROS,,,1.,1.,1.;CAERO1,1,1;SET1,1,1,THRU,8;SNORM,1,,0.,0.,1.;TABRND1,1;+,0.,1.,ENDT
ASET1,123,1,THRU,8;SEELT,2,1;MATT1,1,7;TABLEM1,7;+,0.,1.,1.,1.,ENDT;CDAMP2,91,5.,5,3;LSEQ,9,8,2;PARAM,SOLLIB,IntMKL,0,1,1.-6;PARAM,LGDISP,1;ENDDATA
END
says 'large displacements: said' "$work/habit_others.log" 'PARAM LGDISP: displacements are small here'
habit dmap 'COMPILE (.*line 2): the DMAP up to CEND is not followed' << END
SOL 101;COMPILE SEMG;ALTER 'KJJZ'(,-1);MATPRN KJJZ// \$;SPC = 9 \$;CEND;SPC = 1;LOAD = 2;BEGIN BULK;$habits_grid;$habits_cube;$habits_rest;ENDDATA
END
habit missing_dmap "INCLUDE: '/nowhere/alter.v9' cannot be read: .*line 2); before CEND such a file has DMAP, which is not followed" << END
SOL 101;include '/nowhere/alter.v9';CEND;SPC = 1;LOAD = 2;BEGIN BULK;$habits_grid;$habits_cube;$habits_rest;ENDDATA
END
for head in "CEND;include '/nowhere/cards.bdf'" "include '/nowhere/sol.inc';CEND"; do
   cards habit_missing <<< "$head;SPC = 1;LOAD = 2;BEGIN BULK;$habits_grid;$habits_cube;$habits_rest;ENDDATA"
   run habit_missing 2 && says "${head%%;*}, a file that is missing" "$work/habit_missing.log" 'cannot be read: no such file'
done
# an INCLUDE over two lines; the file of another, beside the deck although another folder has the INCLUDE
mkdir -p "$work/habit_parts/deeper"
cards habit_grid <<< "$habits_grid"
printf '%s\n' "INCLUDE 'habit_" "  grid.bdf'" > "$work/habit_parts/deeper/all.inc"
habit include << END
$habits_sol;BEGIN BULK;INCLUDE 'habit_parts/
   deeper/all.inc';$habits_cube;$habits_rest;ENDDATA
END

# E, G and NU that do not agree: G is that of torsion, E that of bending. With BGG the vector of the bar is in basic axes, beside a system
# CD that is turned; MOMENT1 acts along the line of two nodes
cards habits_bar << 'END'
SOL 101;CEND;SPC = 1;LOAD = 1;BEGIN BULK;CORD2C,5,,0.,0.,0.,0.,0.,1.;+,1.,0.,0.;GRID,1,,0.,1.,0.,5;GRID,2,,0.,3.,0.,5;GRID,3,,0.,9.,0.
CBAR,1,1,1,2,1.,0.,0.,BGG;PBAR,1,1,1.,2.,3.,4.;MAT1,1,9.+5,5.+5,.3;SPC1,1,123456,1;MOMENT1,1,2,3.,1,3;FORCE,1,2,,3.,1.,0.,0.;ENDDATA
END
if run habits_bar; then
   says 'E, G and NU' "$work/habits_bar.log" 'MAT1 1: G = 500000 does not agree with E and NU, which give G = 346153.85'
   near 'torsion by G' "$(table habits_bar 'ROTATIONS OF REFERENCE NODES' | awk '$1 == 2 { print $3 }')" '3*2/(5e5*4)' 1e-4
   near 'bending about the axis that a basic vector gives' "$(moved habits_bar 2 1)" '3*2^3/(3*9e5*2)' 1e-3
fi
