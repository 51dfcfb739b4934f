# Obstructed result files, two runs in one folder, killed runs: a part of run.sh after commands.sh.

# ---- what has the name of a result ----

for target in target nothing; do
   fresh results
   [ $target = target ] && echo old > results/target
   for ending in out joint.csv stage.csv reaction.csv out.part joint.csv.part; do ln -s $target results/good.$ending; done
   run -o results good.bdf;              check "links to a $target of the names of results" 0
   holds results 'links are replaced, not followed' good.joint.csv good.joint.csv.part good.out good.out.part good.reaction.csv good.stage.csv \
      $([ $target = target ] && echo target)
   if [ -L results/good.out ] || [ -L results/good.joint.csv ]; then fail 'a link is no result'; else pass; fi
   if [ $target = nothing ] || [ "$(cat results/target)" = old ]; then pass; else fail 'what a link leads to is written to'; fi
done
for ending in out joint.csv stage.csv reaction.csv; do
   fresh results
   mkfifo results/good.$ending
   run -o results good.bdf;              check "a pipe good.$ending" 4 "results/good.$ending is a pipe and no file"
   holds results 'a pipe stays, and no other file' good.$ending
   rm results/good.$ending
   ln -s /dev/null results/good.$ending
   run -o results good.bdf;              check "a link to a device good.$ending" 4 "results/good.$ending is a device and no file"
   holds results 'a link to a device stays, and no other file' good.$ending
done
sed 's/^SUBCASE.*/&\n  OUTPUT = VTU, STEPS/' good.bdf > steps.bdf
grep -q STEPS steps.bdf || sed 's/^BEGIN BULK/OUTPUT = VTU, STEPS\n&/' good.bdf > steps.bdf
for ending in 1.7.vtu 1.20.joint.vtu pvd; do
   fresh results
   mkfifo results/steps.$ending
   run -o results steps.bdf;             check "a pipe steps.$ending" 4 "results/steps.$ending is a pipe and no file"
   holds results 'a pipe of the name of a VTU file stays, with the results but for those for ParaView' steps.$ending \
      steps.joint.csv steps.out steps.reaction.csv steps.stage.csv
done

# ---- two runs in one folder ----

# Two decks of one name: what is there in the end is all of the one or all of the other.
fresh one; fresh two; fresh of_one; fresh of_two
cp steps.bdf one/beam.bdf
sed 's/^JINCR.*/JINCR   5       18      ARITH   0.02/' steps.bdf > two/beam.bdf
run -q -o of_one one/beam.bdf
run -q -o of_two two/beam.bdf
if diff -rq of_one of_two >/dev/null; then fail 'two decks that differ: they do not'; fi
for ((i = 1; i <= 20; i++)); do
   fresh results
   "$program" -q --threads 1 -o results one/beam.bdf >/dev/null 2>"$work/stderr" &
   sleep "0.0$((i % 4))"
   "$program" -q --threads 1 -o results two/beam.bdf >/dev/null 2>"$work/stderr.two"; other=$?
   wait $!; status=$?
   if [ $status$other != 00 ]; then fail "two runs in one folder: exit statuses $status and $other"
   elif diff -rq results of_one >/dev/null || diff -rq results of_two >/dev/null; then pass
   else fail "two runs in one folder: $(diff -rq results of_one | head -n 3; diff -rq results of_two | head -n 3)"
   fi
done

# what another run that names its files holds is waited for
fresh results
{ flock 9; sleep 0.4; } 9< results &
holder=$!
sleep 0.1
run -q -o results good.bdf;            check 'a folder that another run holds' 0
if kill -0 $holder 2> /dev/null; then fail 'a folder that another run holds is written to'; else pass; fi
wait $holder

# ---- a run that is killed, interrupted, ended ----

fresh results
sed -e 's/^GRID.*//; s/^CQUAD4.*/BLOCK2  1       1       100     60      0.0     0.0/
   s/^CBAR.*/+       150.0   100.0\n+       20/; s/^SPC1.*/SPCM    1       1       20/
   s/^FORCE.* 3 .*/FORCE   10      61              50.0    0.0     -1.0/; s/^FORCE.* 4 .*//
   s/^JINCR.*/JINCR   5       10000   ARITH   1.0-4/' good.bdf > long.bdf
"$program" -o results long.bdf >"$work/stdout" 2>"$work/stderr" &
runner=$!
for ((i = 0; i < 200; i++)); do
   [ -n "$(find results -name '*.part' -size +8k)" ] && break
   kill -0 $runner 2>/dev/null || break
   sleep 0.05
done
kill -9 $runner 2>/dev/null
{ wait $runner; status=$?; } 2>/dev/null
check 'a run that is killed' 137
if ls -A results | grep -q '\.part$'; then pass; else fail 'a run that is killed: it had not begun to write'; fi
killed=$(ls -A results)
if ls -A results | grep -q -v '^long\.[a-z.]*\.[A-Za-z0-9]\{6\}\.part$'; then fail "a run that is killed: it left $(ls -A results | tr '\n' ' ')"; else pass; fi
sed 's/10000   ARITH   1.0-4/2/' long.bdf > short.bdf
for signal in INT TERM HUP; do
   timeout --preserve-status -s $signal 0.6 "$program" -o results long.bdf >"$work/stdout" 2>"$work/stderr"; status=$?
   check "a run that has got SIG$signal" $((128 + $(kill -l $signal)))
done
if grep -q 'long.bdf: interrupted; nothing of this run is kept' "$work/stderr"; then pass; else fail 'a run that is interrupted says what is kept'; fi
holds results 'a run that is interrupted leaves no file, and those of a killed one alone' $killed
# while METIS orders the equations, which has handlers of its own; timeout sends the signal twice
sed 's/ 100     60 / 900     600/' long.bdf > large.bdf
fresh ordering
for seconds in 0.1 0.15 0.2 0.25 0.3; do
   "$program" -o ordering large.bdf >"$work/stdout" 2>"$work/stderr" &
   runner=$!
   for ((i = 0; i < 600; i++)); do
      [ -n "$(find ordering -name '*.part')" ] && break
      sleep 0.02
   done
   sleep $seconds
   kill -s TERM $runner; kill -s TERM $runner 2>/dev/null
   { wait $runner; status=$?; } 2>/dev/null
   check "a run that has got SIGTERM $seconds s behind the start of its results" 143
   holds ordering "a run that has got SIGTERM $seconds s behind the start of its results"
done
sed 's/^SPC = 1/RESTART = 1\n&/' long.bdf > keeps.bdf
timeout --preserve-status -s INT 1.5 "$program" -o results keeps.bdf >"$work/stdout" 2>"$work/stderr"; status=$?
check 'an interrupted run that has a restart file' 130
if grep -q 'keeps.restart keeps the state behind stage 1, increment [1-9][0-9]*: --resume goes on from there' "$work/stderr"; then pass
else fail 'an interrupted run names its restart file'; fi
rm -f results/keeps.restart
rm -f results/*.part

# of two stages the first is kept, and marked; a run that goes on to the end from its restart file has no mark
{ sed -n '1,/^BEGIN/p' good.bdf | sed 's/^\(  \)*INCR.*//; s/^LOAD = .*//; s/^SUBCASE.*//; s/^BEGIN.*//'
  echo 'SUBCASE 1'; echo '  LOAD = 10'; echo '  INCR = 5'; echo 'SUBCASE 2'; echo '  LOAD = 20'; echo '  INCR = 6'; echo 'BEGIN BULK'
  sed '1,/^BEGIN/d; /^ENDDATA/d' long.bdf; echo 'LOAD,20,2.,1.,10'; echo 'JINCR,6,10000,ARITH,1.0-4'; echo ENDDATA
} | sed 's/10000   ARITH   1.0-4/20/' > stages.bdf
sed 's/^JINCR,6,10000.*/JINCR,6,2/' stages.bdf > few.bdf
sed '/^SUBCASE 2/,/^  INCR = 6/s/^/$/; s/^LOAD,20/$&/' stages.bdf > first.bdf
fresh results
run -o results first.bdf;             check 'the first stage alone' 0
for signal in INT TERM; do
   timeout --preserve-status -s $signal 60 "$program" -o results stages.bdf >"$work/stdout" 2>"$work/stderr" &
   runner=$!
   for ((i = 0; i < 600; i++)); do # until the first stage has ended
      [ -n "$(find results -name 'stages.early.*.part')" ] && break
      sleep 0.05
   done
   sleep 0.2
   kill -s $signal $runner # which passes it on
   { wait $runner; status=$?; } 2>/dev/null
   check "a run of two stages that has got SIG$signal" $((128 + $(kill -l $signal))) \
      'results/stages.out keeps the stages that had ended, up to stage 1, increment 20, marked ENDED EARLY'
   for ending in joint.csv stage.csv reaction.csv; do
      if cmp -s results/stages.$ending results/first.$ending; then pass; else fail "SIG$signal: stages.$ending is not that of the first stage"; fi
      if grep -q "^stages.$ending: ENDED EARLY at stage 1, increment 20$" results/stages.early; then pass; else fail "SIG$signal: stages.early does not mark $ending"; fi
   done
   if tail -n 1 results/stages.out | grep -q '^ ENDED EARLY   AT STAGE 1, INCREMENT 20: 2 STAGES, 20 INCREMENTS,'; then pass; else fail "SIG$signal: the listing is not marked"; fi
   holds results "SIG$signal: nothing else is kept" first.joint.csv first.out first.reaction.csv first.stage.csv \
      stages.early stages.joint.csv stages.out stages.reaction.csv stages.stage.csv
done
cp few.bdf stages.bdf
run -o results stages.bdf;            check 'the stages again, with few increments' 0
if [ -e results/stages.early ]; then fail 'a complete run leaves the mark of an earlier one'; else pass; fi
fresh results
rm -f first.bdf few.bdf stages.bdf

mv short.bdf long.bdf
run -o results long.bdf;              check 'the same deck again, with fewer increments' 0
holds results 'the same deck again' long.joint.csv long.out long.reaction.csv long.stage.csv
