#!/usr/bin/env bash
# Draws N single changes of src (mutate.awk), builds each and runs the tests, the quick ones first; prints the changes that no test
# noticed. Called by mutants.mk, which sets FC, FLAGS, LIBRARIES, AGAIN and JOBS in the environment.
#
#    mutants.sh BUILD RELEASE COMPARE QUERY N SEED
#
# BUILD holds the checked build and the unit tests, RELEASE the objects of the program. Mutants are built in BUILD/tree, a copy of
# all files that the tests read; the project is not touched. BUILD/results has a line for each mutant: its place in the draw,
# result, file, line, change.
set -u
export LC_ALL=C
export OPENBLAS_NUM_THREADS=1 OMP_WAIT_POLICY=passive # threads that wait leave the cores to others
build=$(realpath "$1") release=$(realpath "$2") compare=$(realpath "$3") query=$(realpath "$4") n=$5 seed=$6
program_flags="-O1 -fopenmp -w"
here=$(cd "$(dirname "$0")" && pwd)
checked=$build/checked units=$build/unit-fallback tree=$build/tree
# What takes most of the time: these decks no mutant goes through, these suites only where they use the module.
slow="bracket|flanged_column|column_foot"
slow_suites="tree_solver|front_kernel|law_error|fitted_joints|joints_on_lists|nested_dissection"
# Nor through these parts of run_all.sh: those above, what speaks of the tests themselves, and what takes long for little.
passed_over='unit tests|modules use|runner itself|decks against their|processors|run-time checks|comparison|queries|benchmark|do not fit'
passed_over+='|TREE and SKYLINE|STEP tends|errors of elements|Gmsh|pyNastran|at random|fuzzer|tour|pictures'
without=${WITHOUT:+|$WITHOUT}                    # more parts of run_all.sh that are passed over
# A mutant that hangs is ended after so many seconds of processor time in its unit tests, in its decks, in one program of another part:
# measure_limits.
unit_limit=3600 deck_limit=3600 rest_limit=3600

for number in "N $n 1" "SEED $seed 0" "JOBS $JOBS 1"; do
   read -r name value least <<< "$number"
   [[ $value =~ ^(0|[1-9][0-9]{0,14})$ ]] && [ "$value" -ge "$least" ] || { echo "mutants: $name is '$value', expected a whole number, $least or more" >&2; exit 2; }
done

mkdir -p "$tree"
rm -rf "${tree:?}"/*
cp -R Makefile README.md src tests input reference_output "$tree"
touch "$build/results"
if [ -n "$AGAIN" ]; then sed -i '/\tsurvived\t/d' "$build/results"; else : > "$build/results"; fi
awk -v seed="$seed" -v equivalent="$here/equivalent.txt" -f "$here/mutate.awk" src/*/*.f90 | sort -n > "$build/candidates" || exit 1

# A main program that runs the suites named on its command line.
awk 'BEGIN { print "program chosen_tests\n   use funit, only: finish_tests\n   implicit none\n   character(80) :: name\n   integer :: i"
             for (i = 1; i < ARGC; i++) print "   external :: " ARGV[i] "_suite"
             print "   do i = 1, command_argument_count()\n      call get_command_argument(i, name)\n      select case (name)"
             for (i = 1; i < ARGC; i++) printf "      case (\"%s\")\n         call %s_suite()\n", ARGV[i], ARGV[i]
             print "      case default\n         error stop \"no such suite\"\n      end select\n   end do\n   call finish_tests()\nend program chosen_tests"
   }' $(basename -s .pf tests/unit/*.pf) > "$build/chosen_tests.f90"
rm -f "$build/librelease.a"
ar rcs "$build/librelease.a" "$release"/*.o || exit 1
$FC $FLAGS -I"$checked" -I"$units" -J"$build" -c -o "$build/chosen_tests.main.o" "$build/chosen_tests.f90" || exit 1
for main in jointfem jointfit; do # without traps, as the program
   $FC $program_flags -I"$release" -J"$build" -c -o "$build/$main.main.o" "src/$main.f90" || exit 1
done
unit_objects=$(for file in tests/unit/*.pf tests/unit/*.f90; do file=${file##*/}; echo "$units/${file%.*}.o"; done; echo "$units/funit.o")

# ---- one mutant: the functions work in the folder $work ----

# until_failure LOGS COMMAND...: ends with the command, or at the first line in the folder LOGS that tells of a failure
until_failure() {
   local logs=$1 id
   shift
   setsid "$@" > "$work/command.log" 2>&1 &
   id=$!
   while kill -0 $id 2> /dev/null; do
      if tells "$logs"; then kill -KILL -- -$id; break; fi
      sleep 0.2
   done
   wait $id 2> /dev/null && ! tells "$logs"
}
failure="FAILED|[^0-9][1-9][0-9]* failed"
tells() { cat "$1"/* 2> /dev/null | grep -qE "$failure"; }

# The part of run_all.sh that failed; where it ended without a word, the last that had
part_that_failed() {
   local log
   log=$(grep -lE "$failure" "$work/test/logs"/* | head -n 1)
   if [ -n "$log" ]; then cat "$log.title"; else sed -n 's/^---- //p' "$work/command.log" | tail -n 1; fi
}

# The suites that use the module, and all others
suites_of() { (cd "$tree" && grep -liE "^ *use +$1 *(,|$)" tests/unit/*.pf | xargs -r -n 1 basename -s .pf); }
other_suites() {
   (cd "$tree" && grep -LiE "^ *use +$1 *(,|$)" tests/unit/*.pf | xargs -r -n 1 basename -s .pf) | grep -vE "_($slow_suites)$"
}

# Killed by unit tests? The pipe breaks at the first that fails.
suites_fail() {
   [ $# -gt 0 ] || return 1
   rm -rf "$work/scratch"; mkdir "$work/scratch"
   (cd "$tree"; ulimit -t $unit_limit; UNIT_SCRATCH=$work/scratch TIMEFORMAT='%U %S'; export UNIT_SCRATCH
    time "$work/unit_tests" "$@" 2>&1) 2>> "$work/unit.seconds" | tee "$work/unit.log" | awk '/ FAILED$/ { exit 1 }' || return 0
   ! tail -n 1 "$work/unit.log" | grep -q '^[1-9][0-9]* passed, 0 failed$'
}

# Killed by decks of input?
decks_fail() {
   local name suffix
   rm -rf "$work/check"; mkdir "$work/check"
   (cd "$tree"; ulimit -t $deck_limit; TIMEFORMAT='%U %S'
    time "$work/jointfem" -q -o "$work/check" $(printf 'input/%s.bdf ' "$@") > "$work/decks.log" 2>&1) 2>> "$work/deck.seconds" || return 0
   for name; do
      for suffix in out joint.csv; do
         cmp -s "$tree/reference_output/$name.$suffix" "$work/check/$name.$suffix" ||
            "$compare" "$here/../compare/tolerances.txt" "$tree/reference_output/$name.$suffix" "$work/check/$name.$suffix" \
               > "$work/decks.log" 2>&1 || return 0
      done
   done
   return 1
}

# Killed by anything else that make test runs?
rest_fails() {
   local own=../${work##*/} # run_all.sh puts the folder in front of it
   rm -rf "$work/test"
   mkdir -p "$work/checked" "$work/test"
   ln -f "$work/jointfem" "$work/jointfit" "$work/checked"
   (cd "$tree"; ulimit -t $rest_limit
    WITHOUT="$passed_over$1" \
       TOGETHER=1 until_failure "$work/test/logs" tests/run_all.sh "$own/jointfem" "$own/checked/jointfem" "$compare" "$query" "$own")
   [ $? -ne 0 ]
}

# fate FILE LINE NOW: what becomes of it, one word
fate() {
   local file=$1 line=$2 now=$3 module decks
   module=$(basename "$file" .f90)
   line=$line now=$now awk 'NR == ENVIRON["line"] + 0 { print ENVIRON["now"]; next } { print }' "$tree/src/$file" > "$work/$module.f90"
   (cd "$work" && ulimit -t 300 && $FC $FLAGS -I"$checked" -J"$work/modules" -c -o mutant.o "$module.f90") > "$work/build.log" 2>&1 ||
      { echo unbuilt; return; }
   (cd "$work" && $FC $program_flags -I"$release" -J"$work/modules" -c -o program.o "$module.f90") >> "$work/build.log" 2>&1
   $FC $FLAGS -o "$work/unit_tests" "$build/chosen_tests.main.o" $unit_objects "$work/mutant.o" "$checked/libjointfem.a" $LIBRARIES \
      >> "$work/build.log" 2>&1 || { echo unbuilt; return; }
   for main in jointfem jointfit; do
      $FC $program_flags -o "$work/$main" "$build/$main.main.o" "$work/program.o" "$build/librelease.a" $LIBRARIES >> "$work/build.log" 2>&1
   done
   decks=$(cd "$tree/input" && basename -s .bdf *.bdf | grep -vxE "$slow")
   if suites_fail $(suites_of "$module"); then echo 'killed by its unit tests'
   elif decks_fail $decks; then echo 'killed by decks'
   elif suites_fail $(other_suites "$module"); then echo 'killed by other unit tests'
   elif rest_fails "$without"; then echo "killed by: $(part_that_failed)"
   else echo survived
   fi
}

# ---- the draw, shared out to JOBS workers ----

# worker K: takes every JOBS-th candidate, as long as there are fewer than N results
worker() {
   local k=$1 place file line what was now count=0
   work=$build/work$k
   rm -rf "$work"
   mkdir -p "$work/modules"
   while IFS=$'\t' read -r place file line what was now; do
      count=$((count + 1))
      [ $((count % JOBS)) -eq $((k - 1)) ] || continue
      [ "$(grep -cv $'\tunbuilt\t' "$build/results")" -ge "$n" ] && break
      grep -qF "$place"$'\t' "$build/results" && continue
      result=$(fate "${file#src/}" "$line" "$now" < /dev/null)
      printf '%s\t%s\t%s:%s\t%s\t%s\t%s\n' "$place" "$result" "$file" "$line" "$what" "${was#"${was%%[! ]*}"}" "${now#"${now%%[! ]*}"}" >> "$build/results"
   done < "$build/candidates"
}

# Unchanged, all tests must pass; else every mutant would seem killed.
sound() {
   local result
   result=$(fate base/kinds.f90 0 '')
   [ "$result" = survived ] || { echo "mutants: the tests do not pass on the unchanged source: $result"; return 1; }
   measure_limits
}

# Limits of processor time, from what the unchanged source took
measure_limits() {
   local units decks
   units=$(seconds unit.seconds) decks=$(seconds deck.seconds)
   unit_limit=$((30 + 3*units)) deck_limit=$((30 + 3*decks)) rest_limit=$((30 + 3*(units + decks)))
   echo "the unchanged source: $units s of processor time in unit tests, $decks s in decks; a mutant may take $unit_limit s and $deck_limit s"
}
seconds() { awk 'NF == 2 { t += $1 + $2 } END { print int(t) + 1 }' "$work/$1"; }

work=$build/work0
rm -rf "$work"
mkdir -p "$work/modules"
# (part of the checks of the engine itself: SOUND= passes it over)
[ -n "${SOUND-1}" ] && { sound || exit 1; }
for ((k = 1; k <= JOBS; k++)); do worker $k & done
wait
"$here/mutants_table.awk" < "$build/results"
