#!/usr/bin/env bash
# Decks made at random in which every pair of features meets; each as it is, by the other solver, renumbered, mirrored, turned, in other
# units, and cut and resumed. README.md says what must hold.
#
#     pairs.sh [-s SEED] [-n DECKS] [-f FROM] [-x] [-p] PROGRAM FOLDER
#
# -p: decks of NEWTON that divide their increments themselves, with PATHTOL.
# -x: decks in space whose top is a plate of shells or, every second one, bears a wall of shells tied by SHELLTO.
# FROM: the first deck, or several with commas, DECKS from each. What fails is kept in FOLDER/failed with how it is made again. Ends with
# "N passed, N failed"; exit status 1 if anything failed.
set -u
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
seed=1 decks=100 from=1 size=10 shell='' path=''
while getopts 's:n:f:xp' option; do
   case $option in
   s) seed=$OPTARG ;; n) decks=$OPTARG ;; f) from=$OPTARG ;; x) shell=1 ;; p) path=1 ;;
   *) exit 2 ;;
   esac
done
shift $((OPTIND - 1))
# whole NAME OPTION VALUE LEAST: the name of make and the option for it
whole() {
   [[ $3 =~ ^(0|[1-9][0-9]{0,14})$ ]] && [ "$3" -ge "$4" ] || { echo "pairs.sh: $1 ($2) is '$3', expected a whole number, $4 or more" >&2; exit 2; }
}
whole SEED -s "$seed" 0
whole N -n "$decks" 1; for start in "${from%%,*}" ${from//,/ }; do whole FROM -f "$start" 1; done
[ $# -eq 2 ] && [ -x "$1" ] || { sed -n 's/^#     pairs.sh/usage: pairs.sh/p' "$0" >&2; exit 2; }
program=$(realpath "$1")
mkdir -p "$2/failed" || exit 2
folder=$(realpath "$2")
work=$folder/work
rm -f "$folder"/failed/* "$folder/tallies"
failures=0

killer=$folder/kill_at.so
"${CC:-cc}" -O2 -shared -fPIC -o "$killer" "$here/../solver/kill_at.c" -ldl 2> /dev/null || { killer=''; echo 'without runs that are cut and resumed: no C compiler'; }

# run ARGUMENT...: the program on decks of the folder `work`; its messages behind those before
run() { (ulimit -c 0 -t 120; exec "$program" -q --threads 1 -o results "$@") > said 2>> messages < /dev/null; }

# one_by_one DECK...: after a crash
one_by_one() {
   local deck
   : > messages
   rm -f results/*
   for deck in "$@"; do run "$deck"; done
} 2> /dev/null # the shell tells of crashes; the judge does too

# keep NUMBER
keep() {
   cp "$work"/d"$1"?.bdf "$folder/failed"
   echo "        again: tests/random/pairs.sh ${shell:+-x }${path:+-p }-s $seed -f $1 -n 1 $program $folder; decks: $folder/failed/d$1?.bdf"
}

# cut NUMBER SHARE: the deck as it is, killed when SHARE per cent of its calls are made, goes on to the same bytes
cut() {
   local calls file
   rm -rf cut whole
   mkdir cut whole
   env KILL_COUNT=calls LD_PRELOAD="$killer" "$program" -q --threads 1 -o whole "d$1a.bdf" > said 2> error || return 0 # no answer, or a crash: not of RESTART
   read -r calls < calls
   env KILL_AT=$((calls * $2 / 100)) LD_PRELOAD="$killer" "$program" -q --threads 1 -o cut "d$1a.bdf" > said 2> error
   [ -e "cut/d$1a.restart" ] && taken=$((taken + 1))
   if ! "$program" -q --threads 1 --resume -o cut "d$1a.bdf" > said 2> error; then echo "resumed at $2 %: $(head -n 1 error)"; return 1; fi
   for file in whole/*; do
      cmp -s "$file" "cut/${file##*/}" || { echo "resumed at $2 %, ${file##*/} has other bytes"; return 1; }
   done
} 2> /dev/null

# again NUMBER: the last stage of the deck as it is, once more from the state before it, has the same rows in every table, but where a
# bolt is tightened in it
again() {
   local ending last
   [ -e "d$1a.bdf" ] || return 0
   last=$(grep -c '^SUBCASE' "d$1a.bdf")
   [ "$last" -lt 2 ] || grep -q "^BOLT.*,$last\$" "d$1a.bdf" && return 0
   awk -v last="$last" '/^SUBCASE/ && $2 == last { on = 1 }
      /^BEGIN BULK/ && on { printf "SUBCASE %d\n  FROM = %d\n%s", last + 1, last - 1, again; on = 0 }
      on && !/^SUBCASE/ { again = again $0 "\n" } { print }' "d$1a.bdf" > "d$1f.bdf"
   "$program" -q --threads 1 -o whole "d$1f.bdf" > said 2> error || { echo "its last stage once more: $(head -n 1 error)"; return 1; }
   repeated=$((repeated + 1))
   for ending in joint stage reaction bolt modes modes.energy; do
      [ -e "whole/d$1f.$ending.csv" ] || continue
      cmp -s <(sed -n "s/^$last,//p" "whole/d$1f.$ending.csv") <(sed -n "s/^$((last + 1)),//p" "whole/d$1f.$ending.csv") ||
         { echo "its last stage once more has other rows in .$ending.csv"; return 1; }
   done
} 2> /dev/null

cut_runs=0 taken=0 repeated=0
for start in ${from//,/ }; do for ((first = start; first < start + decks; first += size)); do
   last=$((first + size - 1))
   [ $last -lt $((start + decks)) ] || last=$((start + decks - 1))
   rm -rf "$work"
   mkdir -p "$work/results"
   cd "$work" || exit 2
   awk -v seed="$seed" -v shell="$shell" -v path="$path" -v from=$first -v to=$last -v folder=. -f "$here/random.awk" -f "$here/pairs_features.awk" -f "$here/pairs_model.awk" \
      -f "$here/pairs_write.awk" > list || { echo "FAILED: no decks $first to $last"; failures=$((failures + 1)); continue; }
   run d*.bdf 2> /dev/null
   [ $? -lt 5 ] || one_by_one d*.bdf
   awk -v folder=results -v tallies=tallies -f "$here/pairs_judge.awk" list messages > verdict || echo "FAILED: deck $first: the judge" >> verdict
   cat tallies >> "$folder/tallies"
   cat verdict
   for number in $(sed -n 's/^FAILED: deck \([0-9]*\) .*/\1/p' verdict | sort -nu); do keep "$number"; done
   [ -n "$killer" ] && for number in $(awk '$1 == "DECK" && $5 == "solved" && / restart/ { print $2 }' tallies); do
      cut_runs=$((cut_runs + 1))
      what=$(cut "$number" $((60 + 7 * number % 38)); echo "taken $taken")
      taken=${what##*taken }
      what=${what%taken *}
      [ -n "${what%$'\n'}" ] || continue
      echo "FAILED: deck $number: ${what%$'\n'}"
      keep "$number"
      awk -v n="$number" '$1 == "DECK" && $2 == n { $6++ } { print }' "$folder/tallies" > tallies && cp tallies "$folder/tallies"
   done
   for number in $(awk '$1 == "DECK" && $5 == "solved" { print $2 }' tallies); do
      what=$(again "$number"; echo "repeated $repeated")
      repeated=${what##*repeated }
      what=${what%repeated *}
      [ -n "${what%$'\n'}" ] || continue
      echo "FAILED: deck $number: ${what%$'\n'}"
      cp "$work/d${number}f.bdf" "$folder/failed"
      keep "$number"
      awk -v n="$number" '$1 == "DECK" && $2 == n { $6++ } { print }' "$folder/tallies" > tallies && cp tallies "$folder/tallies"
   done
done; done
echo "seed $seed, $decks decks from $from; $cut_runs runs cut, $taken of them behind a restart file; $repeated last stages once more"
awk -v matrix="$folder/pairs" -f "$here/pairs_table.awk" "$folder/tallies"
made=$(grep -c '^DECK' "$folder/tallies")
wrong=$(awk '$1 == "DECK" && $6 > 0' "$folder/tallies" | wc -l)
starts=(${from//,/ })
wanted=$((decks*${#starts[@]}))
[ "$made" -eq $wanted ] || failures=$((failures + wanted - made))
unsolved=$(awk '$1 == "DECK" && $5 == "unsolved"' "$folder/tallies" | wc -l)
if [ $((20 * unsolved)) -gt "$made" ] && [ "$made" -ge 100 ]; then echo "FAILED: $unsolved of $made decks have no answer"; failures=$((failures + 1)); fi
echo "$((made - wrong)) passed, $((wrong + failures)) failed"
[ $((wrong + failures)) -eq 0 ]
