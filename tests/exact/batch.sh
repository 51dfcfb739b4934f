# Parameters of a deck by --set, nodes by --watch, the table of --summary: one element, c and F varied, lambda = c (F/a)**m by hand.
cat > "$work/varied.bdf" <<'DECK'
METHOD = NEWTON
SPC = 1
LOAD = 10
BEGIN BULK
$ a comment with ${NOTHING} in it
BLOCK2,1,1,1,1,0.0,0.0
+,8.0,5.0
+,5
PSHELL  1       1       ${T}    $ thickness
MAT1    1       9500.0          0.0
PMARK,5
JOINT,1,1,5
PJOINT,1,1
JNORM   1       ${C}    0.5     ${EU}
SPC1,1,1,1,2,3,4
FORCE,10,2,,${F},0.0,-1.0
FORCE,10,4,,${F},0.0,-1.0
ENDDATA
DECK
"$program" -q -o "$work" --set T=2.0 --set C=8.0-3,4.0-3 --set EU=1.0+6 --set F=6.0,12.0,7.25 --watch 2,4 --summary "$work/sum.csv" "$work/varied.bdf" \
   > "$work/varied.log" 2>&1
same 'six runs' "$?" 0
same '... one row each' "$(awk 'NR > 1' "$work/sum.csv" | wc -l)" 6
for c in 8.0 4.0; do
   for f in 6.0 12.0 7.25; do
      row=$(grep "varied.bdf, C=$c-3, F=$f\"" "$work/sum.csv" | sed 's/^"[^"]*",//')
      down=$(number "$c*1e-3*sqrt(2*$f/16) + 2*$f*5/(9500*16)")
      near "C $c F $f: largest displacement" "$(echo "$row" | cut -d, -f5)" "$down" 1e-9
      near "... stiffness at the first watched node" "$(echo "$row" | cut -d, -f12)" "2*$f/($down)" 1e-9
      same '... a listing of its own' "$(ls "$work" | grep -c "^varied_C=$c-3_F=$f.out")" 1
   done
done
says 'the answers name their runs' "$work/varied.log" '^ DECK: .*varied.bdf, C=4.0-3, F=7.25$'
says 'a table behind all answers' "$work/varied.log" '^ ALL RUNS'
same '... in which every run stands' "$(sed -n '/^ ALL RUNS/,$p' "$work/varied.log" | grep -c 'varied.bdf, C=')" 6
"$program" -q -o "$work" --set T=2.0 --set C=1.0 --set F=1.0 "$work/varied.bdf" > "$work/varied.log" 2>&1
same 'a parameter without a value' "$?" 2
says '...' "$work/varied.log" 'line 14: ${EU} has no value, expected --set EU=VALUE'
"$program" -q -o "$work" --set T=2.0 --set C=1.0 --set F=1.0 --set EU=1. --set Q=1 "$work/varied.bdf" > "$work/varied.log" 2>&1
same 'a value that nothing takes' "$?" 2
says '...' "$work/varied.log" 'there is no ${Q} in the deck'
"$program" -q -o "$work" --set T=2.0 --set C=1.23456789 --set EU=1.0 --set F=1.0 "$work/varied.bdf" > "$work/varied.log" 2>&1
same 'a value that does not fit' "$?" 2
says '...' "$work/varied.log" 'does not fit in front of what follows'
# 200,000 lines behind a parameter are read as fast as without: a copy of all lines for each of them took minutes
{ sed '/^ENDDATA/d' "$work/varied.bdf"; awk 'BEGIN { for (i = 1; i <= 200000; i++) printf "GRID    %-8d        1.0     2.0\n", 1000 + i; print "ENDDATA" }'
} > "$work/many.bdf"
timeout 10 "$program" -q --check --set T=2.0 --set C=1.0 --set EU=1.0 --set F=1.0 "$work/many.bdf" > "$work/varied.log" 2>&1
same '200,000 lines with parameters' "$?" 0
# a deck that cannot be solved has its row too
sed 's/^SPC = 1/TITLE = FREE/' "$work/varied.bdf" > "$work/free.bdf"
"$program" -q -o "$work" --set T=2.0 --set C=1.0 --set EU=1.0 --set F=1.0 --summary "$work/sum.csv" "$work/free.bdf" "$work/varied.bdf" > "$work/varied.log" 2>&1
same 'status of a batch' "$?" 3
same '... and of its runs' "$(awk -F, 'NR > 1 { printf "%s ", $2 }' "$work/sum.csv")" '3 0 '

# Rows of --set: pairs on the command line and lines of a CSV file run side by side, and give the bytes of single runs and of runs one after
# another, the screen and the summary included but for its seconds. The second row is pulled off: status 3; the others go on.
batch_cell() { # SUMMARY VALUES COLUMN: of the row of the run with these values
   sed 's/, /;/g' "$1" | awk -F, -v deck=";${2//, /;}\"" -v name="$3" 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == name) at = k; next }
      index($1, deck) { print $at }'
}
batch_timeless() { sed 's/, /;/g' "$1" | awk -F, -v OFS=, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "seconds") at = k } { $at = ""; print }'; }
batch_run() { # FOLDER OPTION...: rows of varied.bdf; one of them ends with status 3
   local folder="$work/$1"
   shift
   mkdir -p "$folder"
   "$program" -q -o "$folder" --set T=2.0 --set EU=1.0+6 --summary "$folder/sum.csv" "$@" "$work/varied.bdf" > "$folder/said" 2> "$folder/told"
   same "status of rows, $*" "$?" 3
   sed -i "s|$folder|FOLDER|g" "$folder/said" "$folder/told"
   batch_timeless "$folder/sum.csv" > "$folder/timeless.csv"
}
printf 'C, F\r\n8.0-3,6.0\r\n\r\n8.0-3,-12.0\r\n4.0-3,7.25\r\n8.0-3,12.0' > "$work/rows.csv"
batch_run rows_1 --threads 1 --watch 2,4,1-2 --set "$work/rows.csv"
batch_run rows_all --watch 2,4,1-2 --set "$work/rows.csv"
batch_run rows_pairs --watch 2,4,1-2 --set C=8.0-3,8.0-3,4.0-3,8.0-3:F=6.0,-12.0,7.25,12.0
for batch_case in rows_all rows_pairs; do
   same "$batch_case: files, screen and summary as one after another" "$(diff -rq -x sum.csv "$work/rows_1" "$work/$batch_case")" ''
done
for batch_row in 8.0-3,6.0 4.0-3,7.25 8.0-3,12.0; do
   batch_c=${batch_row%,*} batch_f=${batch_row#*,}
   "$program" -q -o "$work/rows_one" --watch 2,4,1-2 --set T=2.0 --set EU=1.0+6 --set C=$batch_c --set F=$batch_f "$work/varied.bdf" > /dev/null 2>&1
   for batch_file in out joint.csv stage.csv reaction.csv watch.csv watch.energy.csv between.csv; do
      same "row $batch_row: $batch_file of the single run" "$(cmp "$work/rows_one/varied.$batch_file" "$work/rows_all/varied_C=${batch_c}_F=${batch_f}.$batch_file" 2>&1)" ''
   done
   batch_down=$(number "${batch_c/-/e-}*sqrt(2*$batch_f/16) + 2*$batch_f*5/(9500*16)")
   batch_of="C=$batch_c, F=$batch_f"
   near "row $batch_row: the second watched node" "$(batch_cell "$work/rows_all/sum.csv" "$batch_of" stiffness_4)" "2*$batch_f/($batch_down)" 1e-9
   near '... share of the joint' "$(batch_cell "$work/rows_all/sum.csv" "$batch_of" share_joint_1)" "1 - 2*$batch_f*5/(9500*16)/($batch_down)" 1e-9
   near '... the block between two nodes' "$(batch_cell "$work/rows_all/sum.csv" "$batch_of" along_1-2)" "-2*$batch_f*5/(9500*16)" 1e-9
done
same 'the row that is pulled off' "$(batch_cell "$work/rows_all/sum.csv" 'C=8.0-3, F=-12.0' ended)" '"NO RESULTS"'
same '... has no numbers' "$(batch_cell "$work/rows_all/sum.csv" 'C=8.0-3, F=-12.0' stiffness_4)" ''
says '... and its reason' "$work/rows_all/told" 'F=-12.0: .*; no results'

# Rows that take long, of two stages: one whose process is killed runs once more alone, with the same results; at an interrupt the complete row
# stays, the rows that go on keep their first stage, and the summary has them all.
cat > "$work/lasting.bdf" <<'DECK'
METHOD = NEWTON
SPC = 1
OUTPUT = NONE
SUBCASE 1
  LOAD = 10
SUBCASE 2
  LOAD = 20
  INCR = 5
BEGIN BULK
BLOCK2,1,1,30,30,0.0,0.0
+,8.0,5.0
+,5
PSHELL,1,1,2.0
MAT1,1,9500.0,,0.0
PMARK,5
JOINT,1,1,5
PJOINT,1,1
JNORM,1,8.0-3,0.5,1.0+6
SPCM,1,1,5
FORCE,10,961,,1.0,0.0,-1.0
FORCE,20,961,,2.0,0.0,-1.0
JINCR,5,${N},ARITH,${A}
ENDDATA
DECK
batch_start() { # FOLDER VALUES: rows of lasting.bdf in the background, until two processes of rows go on
   rm -rf "${work:?}/$1" && mkdir -p "$work/$1"
   "$program" -q -o "$work/$1" --threads 2 --summary "$work/$1/sum.csv" --set "$2" "$work/lasting.bdf" > "$work/$1.said" 2> "$work/$1.told" &
   batch_runner=$!
   for ((batch_i = 0; batch_i < 600; batch_i++)); do
      [ "$(find "$work/$1" -name '*.early.*.part' | wc -l)" -ge 2 ] && break
      sleep 0.02
   done
}
batch_start killed N=2,300,301,2:A=.5,3.333333333-3,3.322259136-3,.4
kill -9 "$(cat /proc/$batch_runner/task/*/children | awk '{ print $1; exit }')"
wait $batch_runner
same 'rows, one of which was killed' "$?" 0
"$program" -q -o "$work/whole" --threads 1 --summary "$work/whole.csv" --set N=2,300,301,2:A=.5,3.333333333-3,3.322259136-3,.4 "$work/lasting.bdf" > "$work/whole.said" 2>&1
same '... the same files' "$(diff -rq -x sum.csv -x '*.part' "$work/killed" "$work/whole")" ''
same '... the same summary' "$(batch_timeless "$work/killed/sum.csv")" "$(batch_timeless "$work/whole.csv")"
# killed twice, in the second one alone, a row is given up
"$program" -q -o "$work/killed" --threads 2 --set N=300,301 --set A=3.33-3 "$work/lasting.bdf" > "$work/killed.said" 2> "$work/killed.told" &
batch_runner=$!
while kill -0 $batch_runner 2> /dev/null; do
   cat /proc/$batch_runner/task/*/children 2> /dev/null | xargs -r kill -9 2> /dev/null
   sleep 0.02
done
wait $batch_runner
same 'rows, each killed twice: exit status' "$?" 3
same '... said of both' "$(grep -c 'lasting.bdf, N=30[01]: ended by signal 9; no results$' "$work/killed.told")" 2
batch_start stopped N=2,9000,9001,2:A=.5,1.111111111-4,1.110987668-4,.4
kill -s TERM $batch_runner
wait $batch_runner
same 'rows that are interrupted' "$?" 143
same '... the complete row' "$(cmp "$work/stopped/lasting_N=2_A=.5.joint.csv" "$work/whole/lasting_N=2_A=.5.joint.csv" 2>&1)" ''
for batch_of in N=9000_A=1.111111111-4 N=9001_A=1.110987668-4; do
   says "... $batch_of keeps its first stage" "$work/stopped/lasting_$batch_of.early" 'ENDED EARLY at stage 1, increment 1'
   says '... and tells it' "$work/stopped.told" "lasting_$batch_of.out keeps the stages that had ended, up to stage 1, increment 1, marked"
   same '... in the summary' "$(batch_cell "$work/stopped/sum.csv" "${batch_of/_/, }" ended)" '"INTERRUPTED"'
done
same '... as a row that had not begun' "$(batch_cell "$work/stopped/sum.csv" 'N=2, A=.4' ended)" '"INTERRUPTED"'
same '... and the first row with its numbers' "$(batch_cell "$work/stopped/sum.csv" 'N=2, A=.5' increments)" 3
same '... no part of a file' "$(find "$work/stopped" -name '*.part')" ''

# Strips that shear without friction: their elements open one after another and drop their shear. A row without an equilibrium, or one that
# NEWTON takes too many iterations for, which hangs on rounding, ends early; the rows beside it run.
cat > "$work/endless.bdf" <<'DECK'
METHOD = NEWTON
OUTPUT = NONE
LOAD = 10
INCR = 5
BEGIN BULK
BLOCK2,1,1,${N},1,0.0,0.0
+,${L},4.0
+,5
PSHELL,1,1,1.0
MAT1,1,200000.0,,0.3
PMARK,5
JOINT,1,1,5
PJOINT,1,1,1
JNORM,1,1.0-3,0.5,1.0+4
JSHEAR,1,5000.0
FORCE,10,${TIP},,${S},1.0,0.0
FORCE,10,${N},,1000.,0.0,-1.0
JINCR,5,1
ENDDATA
DECK
printf 'N,L,TIP,S\n40,40.,82,500.\n50,50.,102,5000.\n150,150.,302,9600.\n160,160.,322,9600.\n170,170.,342,9600.\n40,40.,82,400.\n' > "$work/endless_rows.csv"
"$program" -q -o "$work/endless" --summary "$work/endless.csv" --set "$work/endless_rows.csv" "$work/endless.bdf" > "$work/endless.said" 2> "$work/endless.told"
same 'rows that do not end' "$?" 3
sed 's/, /;/g' "$work/endless.csv" > "$work/endless.rows"
judge 'rows that do not end are told, the others run' -F, 'NR == FNR { if (/given up after 2[0-9][0-9][0-9] iterations/) { gsub(/, /, ";"); sub(/: .*/, ""); told[$0] = 1 }; next }
   FNR > 1 { deck = $1; gsub(/"/, "", deck); n++; given += $15 ~ /ENDED EARLY/
      if (($15 ~ /GIVEN UP/) != (deck in told)) print deck ": " $15
      if ((deck ~ /N=40;/) && $2 != 0) print deck ": status " $2 }
   END { if (n != 6) print n " rows"; print "checked " given }' "$work/endless.told" "$work/endless.rows"

# values far longer than their places: 40 forces of 1/4 on a rod, u = F L/(E A) = 10*100/(1000*2)
{ printf 'SPC = 1\nLOAD = 1\nOUTPUT = ALL\nBEGIN BULK\nGRID,1,,0.,0.\nGRID,2,,100.,0.\nCROD,1,1,1,2\nPROD,1,1,2.\nMAT1,1,1000.,,.3\nSPC1,1,12,1\nSPC1,1,2,2\n'
  for i in {1..40}; do echo 'FORCE,1,2,,${F},1.,0.'; done; echo ENDDATA; } > "$work/long_values.bdf"
"$program" -q -o "$work" --set F=0.25000000000000000000 "$work/long_values.bdf" > "$work/long_values.log" 2>&1 || cat "$work/long_values.log"
near 'long values of a parameter' "$(moved long_values 2 1)" '10*100/(1000*2)' 1e-6
