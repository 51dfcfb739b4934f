#!/usr/bin/env bash
# Models with friction made at random (friction_models.awk), run by one program or by two, one after the other, on one thread.
#
#    friction_models.sh [-j] [-s SEED] [-n DECKS] [-t SECONDS] FOLDER [PROGRAM...]
#
# FOLDER    where the decks go: FOLDER/f001.bdf and on. Without a PROGRAM nothing is run
# DECKS     200, of SEED 1, if nothing is said
# SECONDS   after which a run is stopped and counts as a failure: 60
#
# For every program a line: decks solved, increments, iterations in all, most iterations of an increment, increments that were divided,
# iterations of attempts that were given up (they are no part of the convergence history), iterations with these on average over the
# increments, failures, seconds of processor time. These sums are of the decks that all programs solve, failures and seconds of all. Then
# the decks on which a program fails, with its message, and those on which it does worse than the first one: divides increments that the
# first did not. ANSWERS is the largest difference of a pressure or shear stress from the first program's, over the largest pressure of
# the deck. FOLDER/table has a line for every deck and program. Status 1 where a later program is worse than the first, or where ANSWERS
# is above 1E-6. With -j each program is judged by itself too: status 1 where a deck fails, which statics allows for all decks (the
# loads are within friction, or springs hold what slides), where the average is above 8 or an increment takes more than 25 iterations,
# those given up counted.
set -u
export LC_ALL=C OPENBLAS_NUM_THREADS=1
seed=1 decks=200 limit=60 judge=0
while getopts 'js:n:t:' option; do
   case $option in
   j) judge=1 ;;
   s) seed=$OPTARG ;;
   n) decks=$OPTARG ;;
   t) limit=$OPTARG ;;
   *) exit 1 ;;
   esac
done
shift $((OPTIND - 1))
[ $# -ge 1 ] || { sed -n 's/^#    friction_models.sh/usage: friction_models.sh/p' "$0" >&2; exit 1; }
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
shift
mkdir -p "$folder"
rm -f "$folder"/f[0-9][0-9][0-9].bdf "$folder/table"
awk -v seed="$seed" -v from=1 -v to="$decks" -v folder="$folder" -f "$here/../random/random.awk" -f "$here/friction_models.awk" || exit 1
[ $# -gt 0 ] || exit 0

# run NUMBER PROGRAM DECK: a line `deck number status increments iterations most divided(list or -) seconds whole` for FOLDER/table; whole
# are the iterations of the summary, with those of attempts given up
run() {
   local results=$folder/results$1 name=$3 TIMEFORMAT='%U' seconds status whole
   mkdir -p "$results"
   rm -f "$results/$name".*
   seconds=$({ time timeout "$limit" "$2" -q --threads 1 -o "$results" --summary "$results/$name.summary" "$folder/$name.bdf" > "$results/$name.said" 2>&1; } 2>&1)
   [ -f "$results/$name.out" ] && ! grep -q '^ *RUN STOPPED' "$results/$name.out" && grep -q '^ END OF LISTING' "$results/$name.out"
   status=$?
   whole=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "iterations") at = i; next } { print $at }' "$results/$name.summary" 2> /dev/null)
   cat "$results/$name.out" 2> /dev/null | awk -v head="$name $1 $status" -v seconds="$seconds ${whole:-0}" -f "$here/iterations.awk"
}

for deck in "$folder"/f[0-9][0-9][0-9].bdf; do
   name=$(basename "$deck" .bdf)
   number=0
   for program; do
      number=$((number + 1))
      line=$(run $number "$program" "$name")
      difference=0
      if [ $number -gt 1 ] && [ -f "$folder/results1/$name.joint.csv" ] && [ -f "$folder/results$number/$name.joint.csv" ]; then
         difference=$(awk -F, '
            FNR == 1 { file++; delete at; for (i = 1; i <= NF; i++) at[$i] = i; next }
            file == 1 { n++; p[n] = $at["pressure"]; x[n] = $at["tau_x"]; y[n] = $at["tau_y"]; if (p[n] > largest) largest = p[n]; next }
            { m++; check(p[m], $at["pressure"]); check(x[m], $at["tau_x"]); check(y[m], $at["tau_y"]) }
            function check(a, b,   d) { d = a - b; if (d < 0) d = -d; if (!(d <= worst)) worst = d }
            END { printf "%.1e", (m == n && largest > 0 ? worst/largest : 9) }' \
            "$folder/results1/$name.joint.csv" "$folder/results$number/$name.joint.csv")
      fi
      echo "$line $difference" >> "$folder/table"
   done
done
awk -v judge=$judge '
   { if (!($1 in seen)) { seen[$1] = 1; order[++decks] = $1 }
     if ($2 > programs) programs = $2
     failed[$1, $2] = $3 != 0; increments[$1, $2] = $4; iterations[$1, $2] = $5; most[$1, $2] = $6; divided[$1, $2] = $7
     given_up[$1, $2] = $9 > $5 ? $9 - $5 : 0
     seconds[$2] += $8; if (failed[$1, $2]) bad[$1] = 1; failures[$2] += failed[$1, $2]
     if (!failed[$1, $2] && !failed[$1, 1] && $10 + 0 > 1e-6) other[$2] = other[$2] " " $1 ":" $10
     if (!failed[$1, $2] && !failed[$1, 1] && $10 + 0 > worst[$2] + 0) worst[$2] = $10 }
   END {
      printf "%-9s %7s %11s %11s %6s %8s %9s %8s %9s %9s %9s\n", "PROGRAM", "SOLVED", "INCREMENTS", "ITERATIONS", "MOST", "DIVIDED", "GIVEN UP", \
         "AVERAGE", "FAILURES", "SECONDS", "ANSWERS"
      for (p = 1; p <= programs; p++) {
         n = it = inc = div = high = lost = 0
         for (k = 1; k <= decks; k++) {
            d = order[k]
            if (d in bad) continue
            n++; inc += increments[d, p]; it += iterations[d, p]; lost += given_up[d, p]; if (most[d, p] > high) high = most[d, p]
            if (divided[d, p] != "-") div += split(divided[d, p], list, ",")
         }
         average[p] = inc ? (it + lost)/inc : 0
         printf "%-9d %7d %11d %11d %6d %8d %9d %8.2f %9d %9.1f %9s\n", p, decks - failures[p], inc, it, high, div, lost, average[p], \
            failures[p], seconds[p], (p > 1 ? worst[p] + 0 : "-")
      }
      for (p = 1; p <= programs; p++) for (k = 1; k <= decks; k++) {
         d = order[k]
         if (failed[d, p]) { print "program " p " fails on " d; if (judge || p > 1 && !failed[d, 1]) worse = 1 }
         else if (most[d, p] + given_up[d, p] > 25) {
            print "program " p " on " d ": at most " most[d, p] " iterations in an increment" (given_up[d, p] ? ", " given_up[d, p] " given up" : "")
            if (judge) worse = 1
         }
         if (p == 1 || failed[d, 1] || failed[d, p] || divided[d, p] == "-") continue
         m = split(divided[d, p], list, ",")
         for (i = 1; i <= m; i++) if (index("," divided[d, 1] ",", "," list[i] ",") == 0) { print "program " p " divides " d ", increment " list[i]; worse = 1 }
      }
      for (p = 2; p <= programs; p++) if (other[p] != "") { print "program " p " has other answers:" other[p]; worse = 1 }
      for (p = 1; p <= programs; p++) if (judge && average[p] > 8) { print "program " p ": above 8 iterations on average"; worse = 1 }
      exit worse
   }' "$folder/table" | while IFS= read -r line; do
   echo "$line"
   [[ $line =~ ^program\ ([0-9]+)\ fails\ on\ (f[0-9]+) ]] && grep -v -e '^ *$' -e OpenBLAS "$folder/results${BASH_REMATCH[1]}/${BASH_REMATCH[2]}.said" | head -n 2 | cut -c 1-300 | sed 's/^/   /'
done
exit "${PIPESTATUS[0]}"
