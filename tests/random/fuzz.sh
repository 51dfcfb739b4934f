#!/usr/bin/env bash
# Decks and test data made from good ones at random, through one or several builds of the programs.
#
#     fuzz.sh [-s SEED] [-m MINUTES | -n DECKS] [-f FROM] [-k KIND] [-a EVERY] [-j JOBS] FOLDER NAME=PROGRAM...
#
# Decks number 1 (FROM) and up, 60 MINUTES of them or as many as DECKS; KIND: only `bad`, `wild` or `mild` ones. Every build runs every
# deck; NAME begins with `asan` for one with sanitizers, whose memory cannot be limited and which takes EVERY such batch of 50 only. What fails is kept in FOLDER/failed, and
# how to run it again is printed. README.md says what must hold. Ends with "N passed, N failed"; exit status 1 if anything
# failed, 2 wrong usage.
set -u
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
seed=1 minutes=60 decks=0 from=1 kind='' jobs=2 size=50 every=1
while getopts 's:m:n:f:k:a:j:' option; do
   case $option in
   s) seed=$OPTARG ;; m) minutes=$OPTARG ;; n) decks=$OPTARG ;; f) from=$OPTARG ;; k) kind=$OPTARG ;; a) every=$OPTARG ;; j) jobs=$OPTARG ;;
   *) exit 2 ;;
   esac
done
shift $((OPTIND - 1))
# whole NAME OPTION VALUE LEAST: the name of make and the option for it
whole() {
   [[ $3 =~ ^(0|[1-9][0-9]{0,14})$ ]] && [ "$3" -ge "$4" ] || { echo "fuzz.sh: $1 ($2) is '$3', expected a whole number, $4 or more" >&2; exit 2; }
}
whole SEED -s "$seed" 0
whole MINUTES -m "$minutes" 1
whole DECKS -n "$decks" 0
whole FROM -f "$from" 1
whole EVERY -a "$every" 1
whole JOBS -j "$jobs" 1
[ $# -ge 2 ] || { sed -n 's/^#     fuzz.sh/usage: fuzz.sh/p' "$0" >&2; exit 2; }
mkdir -p "$1/failed" || exit 2
folder=$(realpath "$1")
rm -rf "$folder"/work_*
shift
builds=()
for build in "$@"; do
   [ -x "${build#*=}" ] || { echo "no program: $build" >&2; exit 2; }
   builds+=("${build%%=*}=$(realpath "${build#*=}")")
done
export ASAN_OPTIONS=detect_leaks=1:max_allocation_size_mb=2000:allocator_may_return_null=1:malloc_context_size=2 \
   LSAN_OPTIONS=exitcode=0:print_suppressions=0:suppressions=$(cd "$here/../source" && pwd)/leaks.txt UBSAN_OPTIONS=print_stacktrace=1

# the decks that others are made from: small ones; the meshes of Gmsh in every field format; a backbone of one amplitude
mkdir -p "$folder/meshes"
sed -e 's/^JAMPL .*/JAMPL,6,1,0.01,1,0.1,0,1/' -e 's/^ENDDATA/+,0.1\n&/' "$root/input/bolted_lap.bdf" > "$folder/meshes/bolted_lap_short.bdf"
for deck in "$root"/tests/programs/bar_*.bdf; do
   for form in free large; do
      awk -v form=$form -f "$root/tests/programs/field_format.awk" "$deck" > "$folder/meshes/$(basename "$deck" .bdf)_$form.bdf"
   done
done
seeds=()
for deck in "$root"/input/*.bdf "$root"/tests/{random,bad/base,exact,solver,programs}/*.bdf "$folder"/meshes/*.bdf; do
   case ${deck##*/} in
   hexa_on_tetra.bdf | pin_in_bore.bdf | two_blocks.bdf | bracket*.bdf | flange*_*.bdf | flanged_column.bdf | column_foot.bdf | solid_bolt.bdf | \
      bolted_lap.bdf | brake_reuss*.bdf | konter*.bdf | slideway_crown.bdf | column_modes_*.bdf | post_on_plate.bdf | boxes.bdf | strips.bdf | largest.bdf | bar_tetra10_large.bdf)
      [[ $deck = */bad/base/two_blocks.bdf ]] || continue ;;
   esac
   seeds+=("$deck")
done

# Where the decks of a folder find what they INCLUDE
link_includes() {
   ln -sfn "$root/input/gmsh" "$1/gmsh"
   ln -sfn "$root/input/surfaces" "$1/surfaces"
   ln -sfn "$root/input/vibration" "$1/vibration"
   cp "$root"/tests/exact/*.inc "$root"/tests/solver/*.inc "$1"
}
link_includes "$folder/failed"

. "$here/fuzz_data.sh"
. "$here/fuzz_restart.sh"

# limits NAME PROGRAM SECONDS: processor time and memory of what follows in this shell
limits() {
   ulimit -c 0
   case $1 in
   asan*) ulimit -t $((4 * $3)) ;;
   *) ulimit -t "$3"; ulimit -v 4000000 ;;
   esac
}

# run_decks NAME PROGRAM SECONDS LIST WHERE: the decks of LIST in one process; prints what is wrong
run_decks() {
   local status
   rm -rf "$5/results"
   mkdir "$5/results"
   (cd "$5/decks" && limits "$1" "$2" "$3" && exec timeout -k 5 $((20 * $3)) "$2" -q --threads 1 -o ../results $(cut -d' ' -f1 "$4" | sed 's/$/.bdf/')) \
      > "$5/stdout" 2> "$5/stderr" < /dev/null
   status=$?
   : > "$5/statuses"
   case $status in
   124 | 137 | 152) echo "- still running after $3 seconds" ;;
   esac
   awk -v status=$status -v results="$5/results" -v statuses="$5/statuses" -f "$here/fuzz_judge.awk" "$4" "$5/stderr"
   grep -aqE '(^|[^A-Za-z])(NaN|Infinity)([^A-Za-z]|$)|[ ]\*\*\*\*' "$5/stdout" && echo '- NaN, Infinity or asterisks on the standard output'
   return 0
}

# keep NAME PROGRAM NUMBER WHERE WHAT
keep() {
   cp "$4/decks/fuzz_$3.bdf" "$folder/failed/s${seed}_$3.bdf"
   echo "FAILED: $1, deck $3 ($(sed -n "s/^$3 //p" "$4/list" | cut -c 1-150)): $5" | cut -c 1-400
   echo "        again: cd $folder/failed && $2 -o . s${seed}_$3.bdf"
}

# One deck after the other, with the first build in which the batch failed
run_singly() {
   local number found=0 what name=$1 program=$2 where=$3
   while read -r deck of_kind; do
      echo "$deck $of_kind" > "$where/single"
      what=$(run_decks "$name" "$program" 10 "$where/single" "$where" | head -n 1)
      cat "$where/statuses" >> "$where/statuses.$name"
      [ -n "$what" ] || continue
      found=$((found + 1))
      number=${deck#fuzz_}
      keep "$name" "$program" "$number" "$where" "$what"
   done < "$where/all"
   if [ $found -eq 0 ]; then
      found=1
      echo "FAILED: $name, decks $(head -n 1 "$where/all") to $(tail -n 1 "$where/all") together, none of them alone: $(head -n 1 "$where/wrong")"
   fi
   echo "$found" >> "$where/failed"
}

# Decks FIRST to LAST through all builds
batch() {
   local first=$1 last=$2 where=$3 build name program before differ
   rm -rf "$where/decks"
   mkdir -p "$where/decks"
   link_includes "$where/decks"
   awk -v seed="$seed" -v from="$first" -v to="$last" -v only="$kind" -v folder="$where/decks" -f "$here/random.awk" -f "$here/fuzz_damage.awk" \
      -f "$here/fuzz_cards.awk" -f "$here/fuzz_changes.awk" -f "$here/fuzz_decks.awk" "$root/input/cards.md" "${seeds[@]}" > "$where/list" || return 1
   awk '{ print "fuzz_" $1, $2 }' "$where/list" > "$where/all"
   before=''
   for build in "${builds[@]}"; do
      name=${build%%=*} program=${build#*=}
      case $name in asan*) [ $(((first - 1) / size % every)) -eq 0 ] || continue ;; esac
      run_decks "$name" "$program" 60 "$where/all" "$where" > "$where/wrong"
      cp "$where/statuses" "$where/statuses.$name"
      if [ -s "$where/wrong" ]; then : > "$where/statuses.$name"; run_singly "$name" "$program" "$where"; fi
      awk '{ count[$2]++ } END { for (s in count) print s, count[s] }' "$where/statuses.$name" >> "$where/tally.$name"
      if [ -n "$before" ]; then
         differ=$(diff "$where/statuses.$before" "$where/statuses.$name" | grep '^[<>]' | tr '\n' ' ')
         [ -z "$differ" ] || echo "DIFFER: $before and $name: $differ" | cut -c 1-300
      fi
      before=$name
      echo $((last - first + 1)) >> "$where/runs"
   done
   echo $((last - first + 1)) >> "$where/done"
}

# The first ten numbers of every fourth batch are those of test data too, the first five those of restart files.
some_data() {
   local last=$(($1 + 9))
   if [ $((($1 - 1) / size % 4)) -ne 0 ] && { [ "$decks" -eq 0 ] || [ "$decks" -ge "$size" ]; }; then return 0; fi
   [ "$last" -le "$2" ] || last=$2
   batch_of_data "$1" "$last" "$3" && batch_of_restarts "$1" $((($1 + last)/2)) "$3"
}

# Every JOBS-th batch, until the time is over
work() {
   local me=$1 first=$((from + $1 * size)) where="$folder/work_$1" last
   rm -rf "$where"
   mkdir -p "$where"
   while [ "$decks" -gt 0 ] && [ "$first" -lt $((from + decks)) ] || [ "$decks" -eq 0 ] && [ $SECONDS -lt $((60 * minutes)) ]; do
      last=$((first + size - 1))
      [ "$decks" -gt 0 ] && [ "$last" -ge $((from + decks)) ] && last=$((from + decks - 1))
      batch "$first" "$last" "$where" && some_data "$first" "$last" "$where" || { echo "FAILED: no decks $first to $last"; echo 1 >> "$where/failed"; return; }
      first=$((first + jobs * size))
   done
}

echo "seed $seed"
for ((job = 0; job < jobs; job++)); do work $job 2>> "$folder/shell" & done # the shell tells of crashes too
wait
count() { cat "$folder"/work_*/"$1" 2> /dev/null | awk '{ n += $1 } END { print n + 0 }'; }
for build in "${builds[@]}"; do
   cat "$folder"/work_*/tally."${build%%=*}" | sort -n | awk -v name="${build%%=*}" '{ n[$1] += $2; all += $2 } END { printf "%s: %d decks, status", name, all
      for (s = 0; s <= 4; s++) if (n[s]) printf "  %d: %d", s, n[s]
      print "" }'
done
made=$(count done) failed=$(count failed)
data=$(count data_runs)
restarts=$(count restart_runs)
echo "test data: $data runs, restart files: $restarts"
runs=$(($(count runs) + data + restarts))
echo "$((runs - failed)) passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$made" -gt 0 ]
