#!/usr/bin/env bash
# Runs all parts of `make test` and prints one sum.
#
#    run_all.sh PROGRAM CHECKED_PROGRAM COMPARE QUERY BUILD_FOLDER [PROGRAM_MPI]
#
# CHECKED_PROGRAM is the program with run-time checks; it runs the bad decks and the random decks, so that an index out of bounds or
# a floating-point exception is detected. A part without a last line `N passed, N failed` has failed. One part more than there are
# cores runs side by side, for parts wait too (TOGETHER=n: n of them), each in a folder of its own. WITHOUT in the environment: a
# pattern of titles to skip. A part names what it skips in lines `skipped: WHAT: WHY`; these lines and the time of each part are
# printed before the sum.
set -u
export GOMP_SPINCOUNT=${GOMP_SPINCOUNT:-1000} # what the program sets itself: saves each run a start
program=$1 checked=$2 compare=$3 query=$4 build=$5 without=${WITHOUT:-}
# Where OpenBLAS does not know the processor, the program starts itself anew with another kernel. That kernel is set for all parts,
# which saves each run 0.02 s; kernel.sh and processors.sh set their own.
mkdir -p "$build/test"
kernel=$("$program" --times -q -o "$build/test" input/one_element.bdf 2>&1 |
   sed -n 's/.*: OpenBLAS kernel \([A-Za-z]*\); OpenBLAS itself takes .*/\1/p')
[ -z "$kernel" ] || export OPENBLAS_CORETYPE=$kernel
together=${TOGETHER:-$(($(nproc) + 1))}
passed=0 failed=0 begun=0 shown=0
titles=()
left_out=()
rm -rf "$build/test/logs"
mkdir -p "$build/test/logs"

# part TITLE COMMAND...: begins it as soon as fewer than TOGETHER parts run
part() {
   local log
   if [[ -n $without && $1 =~ $without ]]; then
      left_out+=("$1: WITHOUT names it")
      return
   fi
   show_finished
   while [ "$(jobs -rp | wc -l)" -ge "$together" ]; do wait -n; done
   log=$build/test/logs/$begun
   titles[begun]=$1
   echo "$1" > "$log.title"
   shift
   {
      local TIMEFORMAT='%0R %0U %0S' status
      { time { "$@" > "$log" 2>&1; status=$?; }; } 2> "$log.seconds"
      echo $status > "$log.status"
   } &
   begun=$((begun + 1))
}

# What the parts said, in the order in which they stand below, as far as they have ended
show_finished() {
   while [ $shown -lt $begun ] && [ -s "$build/test/logs/$shown.status" ]; do
      judge "${titles[shown]}" "$build/test/logs/$shown" "$(cat "$build/test/logs/$shown.status")"
      shown=$((shown + 1))
   done
}

# everything_so_far: what follows uses results of the parts above
everything_so_far() {
   wait
   show_finished
}

# judge TITLE LOG STATUS
judge() {
   local title=$1 status=$3 last
   echo "---- $title"
   cat "$2"
   while read -r last; do left_out+=("$title: ${last#skipped: }"); done < <(grep '^skipped: ' "$2")
   last=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$2" | tail -n 1)
   if [ -z "$last" ]; then
      echo "$title: ended without a count, with status $status"
      failed=$((failed + 1))
      return
   fi
   set -- $last
   passed=$((passed + $1)) failed=$((failed + $3))
   [ "$status" -ne 0 ] && [ "$3" -eq 0 ] && { echo "$title: status $status"; failed=$((failed + 1)); }
}

part 'decks against their references' tests/compare/check.sh "$program" "$compare" "$build/check"
everything_so_far
part 'unit tests' ${MAKE:-make} --no-print-directory -s unit-test
part 'modules use what stands to the left' tests/source/folders.sh src/README.md src
part 'Fortran that every compiler takes' tests/source/compilers.sh src tests
part 'components in the restart file' tests/source/components.sh src
part 'the tour of the source' tests/source/readme.sh src/README.md src
part 'the test runner itself' env -u MAKELEVEL tests/runner/selftest.sh
part 'the tools of make mutants and make coverage' tests/source/selftest.sh
# the long ones first
part 'exact answers and independent computations' tests/exact/run.sh "$program" "$query" "$build/exact"
part 'laws from structures' tests/fit/structure.sh "$build/checked/jointfit" "$program"
part 'TREE and SKYLINE, one thread and several' tests/solver/tree_skyline.sh "$program" "$query" "$build/solver"
part 'bad decks and command lines' tests/bad/run.sh "$PWD/$checked"
part 'runs that are killed and go on' tests/solver/restart.sh "$program" "$build/restart"
part 'decks made at random' tests/random/fuzz.sh -s 1984 -n 2000 -j 1 "$build/test/fuzz" checked="$checked"
part 'decks in which every pair of features meets' tests/random/pairs.sh -s 1984 -n 100 "$program" "$build/test/pairs"
part 'decks of pairs that showed an error once' tests/random/pairs.sh -s 1 -f 102,3740,4498,4529 -n 1 "$program" "$build/test/pairs-again"
part 'decks of pairs with shells' tests/random/pairs.sh -x -s 1984 -n 40 "$program" "$build/test/pairs-shells"
part 'decks of pairs with PATHTOL' tests/random/pairs.sh -p -s 1 -n 20 "$program" "$build/test/pairs-path"
part 'the two fuzzers themselves' tests/random/selftest.sh "$program" "$build/test/random-selftest"
part 'decks on other processors' tests/compare/processors.sh "$program" "$compare" "$build"
part 'worked examples of the tour' tests/source/tour.sh "$query" "$build/tour"
part 'decks through the program with run-time checks' tests/compare/check.sh "$checked" "$compare" "$build/check-checked" \
   $(for deck in input/*.bdf; do basename "$deck" .bdf; done | grep -vx brake_reuss) # a minute more
part 'the verification manual as it stands' tests/manual/check.sh "$program" "$query" "$build/manual-check"
part 'decks, exercises and numbers of the manuals' tests/manual/pages.sh "$program" "$query" "$build/pages"
part 'the kernel of OpenBLAS' tests/solver/kernel.sh "$program" "$build/kernel"
part 'models that do not fit into the memory' tests/solver/memory.sh "$program" "$build/memory"
part 'linear decks and their frequencies against CalculiX' tests/programs/calculix.sh "$program" "$build/calculix"
part 'numbers of any size, systems of units' tests/exact/sweep.sh "$program" "$build/sweep"
part 'errors of elements as the manual has them' tests/exact/run.sh "$program" "$query" "$build/elements" elements
part 'STEP tends to NEWTON' tests/exact/run.sh "$program" "$query" "$build/convergence" convergence
part 'the comparison itself' tests/compare/test_compare.sh "$compare" reference_output tests/compare/tolerances.txt
part 'the queries of histories' tests/compare/test_query.sh "$query"
part 'from test data to cards' tests/fit/run.sh "$build/checked/jointfit" "$program"
part 'published surfaces' tests/fit/surfaces.sh "$program"
part 'files for ParaView' tests/programs/vtu.sh "$program" "$build/vtu" "$build"/check/{post_on_plate,column_tetra10}.pvd
part 'meshes from Gmsh' tests/programs/gmsh.sh "$program" "$query" "$build/gmsh"
part 'decks to and from pyNastran' tests/programs/pynastran.sh "$program" "$build/pynastran"
part 'meshes of Abaqus and Salome by meshio' tests/programs/meshio.sh "$program" "$query" "$build/meshio"
part 'pictures of a deck, flow charts' tests/programs/figures.sh "$program" "$build/test/figures"
part 'the benchmark, without measuring' tests/bench/test_bench.sh "$program" "$build/test/bench"
everything_so_far
# alone: several processes ask again and again whether the others are ready, and take ten times as long beside other parts
part 'on several processes' tests/solver/mpi.sh "$program" "${6:-none}" "$query" "$build/mpi-test"
everything_so_far
echo '---- seconds of each part, and of processor time, in the order of their end'
ls -tr "$build"/test/logs/*.seconds | while read -r seconds; do
   read -r elapsed user system < "$seconds"
   printf '%6d %6d  %s\n' "$elapsed" $((user + system)) "$(cat "${seconds%.seconds}.title")"
done
echo '---- skipped'
[ ${#left_out[@]} -eq 0 ] && left_out=(nothing)
printf '%s\n' "${left_out[@]}"
echo '----'
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
