#!/usr/bin/env bash
# Runs the program under the sanitizers of gcc: no access outside an array, no lost memory, no undefined behaviour, no data race
# between tasks of TREE.
#
#    sanitize.sh WORK_FOLDER [PART...]      parts: address bad threads memcheck; all without PART
#
# address   -fsanitize=address,undefined with leak detection: every deck of input, bad decks, jointfit on test data
# bad       the bad decks and command lines of tests/bad with the same program
# threads   -fsanitize=thread, with threads_in_view.c for OpenMP and plain_blas.f90 for BLAS, because libgomp is not instrumented
#           and every task would be reported as a race; programs broken in each of the parallel parts show that races are found
# memcheck  valgrind, where installed: uninitialised numbers too, on small decks, with the release program
#
# A part whose tool is missing is skipped. Takes some minutes; not a part of `make test`.
set -u
work=$1
shift
[ $# -gt 0 ] || set -- address bad threads memcheck
make=${MAKE:-make} fc=${FC:-gfortran} libraries=${LIBRARIES:--larpack -lmetis -lminpack -lopenblas}
passed=0 failed=0
# leaks.txt is compared with all callers that are noted: with the nearest alone
short=malloc_context_size=2 not_ours=print_suppressions=0:suppressions=$PWD/tests/source/leaks.txt
mkdir -p "$work/results"

# verdict WHAT STATUS LOG PATTERN [MOST]: LOG has nothing of PATTERN, and the exit status is one of the program's own, up to MOST (4)
verdict() {
   if [ "$2" -gt "${5:-4}" ] || grep -qE "$4" "$3"; then
      failed=$((failed + 1))
      echo "FAILED $1: status $2"
      grep -E -A 12 "$4" "$3" | head -n 40
   else
      passed=$((passed + 1))
   fi
}

# built FOLDER FLAGS OBJECTS: the programs of this project with other FLAGS. Where the compiler has these for a program of one line the
# failure is ours.
built() {
   "$make" --no-print-directory BUILD="$work/$1" BIN="$work/$1" FC="$fc" FFLAGS="-O1 -g -fbacktrace $2" \
      LIBRARIES="$3 $libraries" "$work/$1/jointfem" "$work/$1/jointfit" > "$work/$1.log" 2>&1 && return 0
   echo end > "$work/$1.f90"
   if "$fc" $2 -o "$work/$1.out" "$work/$1.f90" > /dev/null 2>&1; then
      failed=$((failed + 1)); echo "FAILED $1: it cannot be built"; tail -n 3 "$work/$1.log"
   else
      echo "$1: skipped, $fc has no $2"
   fi
   return 1
}

address() {
   local deck log="$work/address-run.log"
   built address '-fsanitize=address,undefined -fno-omit-frame-pointer' '' || return
   export ASAN_OPTIONS=detect_leaks=1:$short LSAN_OPTIONS=$not_ours UBSAN_OPTIONS=print_stacktrace=1
   for deck in input/*.bdf; do
      "$work/address/jointfem" -q -o "$work/results" "$deck" > "$log" 2>&1
      verdict "address: $deck" $? "$log" 'ERROR: .*Sanitizer|runtime error'
      awk 'NR % 7 == 3 { sub(/,[^,]*/, ",X") } { print }' "$deck" > "$work/bad.bdf"
      "$work/address/jointfem" -q -o "$work/results" "$work/bad.bdf" > "$log" 2>&1
      verdict "address: $deck, damaged" $? "$log" 'ERROR: .*Sanitizer|runtime error'
   done
   for deck in tests/fit/*.dat; do
      "$work/address/jointfit" "$deck" > "$log" 2>&1
      verdict "address: jointfit $deck" $? "$log" 'ERROR: .*Sanitizer|runtime error'
   done
}

bad() {
   local log="$work/bad-run.log"
   built address '-fsanitize=address,undefined -fno-omit-frame-pointer' '' || return
   LIMIT=600 ASAN_OPTIONS=detect_leaks=1:$short:exitcode=99 LSAN_OPTIONS=$not_ours UBSAN_OPTIONS=halt_on_error=1:exitcode=99 tests/bad/run.sh "$work/address/jointfem" > "$log" 2>&1
   grep FAILED -A 6 "$log"
   set -- $(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$log" | tail -n 1 || echo 0 passed, 1 failed)
   passed=$((passed + ${1:-0})) failed=$((failed + ${3:-1}))
}

threads() {
   local model name seed log="$work/threads-run.log"
   command -v gcc > /dev/null || { echo 'threads: skipped, there is no gcc'; return; }
   mkdir -p "$work/threads"
   gcc -O1 -g -c tests/source/threads_in_view.c -o "$work/threads/view.o" &&
      "$fc" -O1 -g -fsanitize=thread -c tests/source/plain_blas.f90 -o "$work/threads/blas.o" || return
   rm -f "$work"/threads/joint* # linked anew with what is made here
   built threads '-fsanitize=thread' "$work/threads/view.o $work/threads/blas.o" || return
   if nm -u "$work/threads/jointfem" | grep -E 'GOMP_|omp_'; then # left to libgomp, all of it were out of sight
      failed=$((failed + 1)); echo 'FAILED threads: threads_in_view.c does not have what is named above'; return
   fi
   export TSAN_OPTIONS=detect_deadlocks=0 # libgfortran locks its units in either order
   # the second has a front in tiles; the fourth: more nodes than layouts of fronts are tried one by one for, more rows than a table prints at once
   for model in 'hex8_10x10x10 NONE' 'hex8_15x15x15 LAST' 'q4_160x40 ALL' 'q4_2600x8 LAST' 'over_10x8x4 NONE 2'; do
      set -- $model
      tests/bench/make_deck.sh "$1" TREE "$2" ${3:-} | sed 's/^JINCR,5,20,.*/JINCR,5,3,ARITH,0.1/' > "$work/$1.bdf"
      for seed in 1 2; do
         OMP_NUM_THREADS=4 TASKS_SEED=$seed "$work/threads/jointfem" -q -o "$work/results" "$work/$1.bdf" > "$log" 2>&1
         verdict "threads: $1, seed $seed" $? "$log" 'ThreadSanitizer' 0
      done
   done
   TASKS_SEED=1 JOINTFEM_TASKS="$work/tasks" "$work/threads/jointfem" -q --threads 1 -o "$work/results" "$work/hex8_15x15x15.bdf" > "$log" 2>&1
   if ! grep -q subtract "$work/tasks"; then
      failed=$((failed + 1)); echo 'FAILED threads: hex8_15x15x15 has no front in tiles'
   fi
   mkdir -p "$work/broken"
   cp "$work"/threads/release/*.mod "$work/broken"
   broken 'times that the fronts of a factorisation add up in no order' solver/front_factor hex8_10x10x10 '/omp atomic/ { next }'
   broken 'solutions whose fronts leave all in one place' solver/front_solve hex8_10x10x10 '{ gsub(/%left \+/, "%r*0 +") }'
   broken 'tiles that do not wait for the tiles that they read' solver/front_tiles hex8_15x15x15 '/depend\(in: ready\(i, k\)/ { sub(/ready\(i, k\), ready\(j, k\), /, "") }'
   broken 'fronts that count their places together' solver/front_tree q4_2600x8 \
      '/front%left|fronts\(f\)%left/ { next } /tree%n_left = / { next } /allocate \(front%rows\(front%r\)\)/ {
       print "            front%left = tree%n_left"; print "            tree%n_left = tree%n_left + front%r" }'
   broken 'layouts that share one order' solver/front_layout q4_2600x8 '/omp parallel/ { sub(/ private\(postponed\)/, "") }'
   broken 'rows of a table written over each other' result/body_tables q4_2600x8 '/%put|print_row/ { sub(/pieces\(part\)/, "pieces(1)") }'
   broken 'stresses of elements in one place' result/body_tables q4_2600x8 '/stress\(:n_stresses/ { sub(/%state\), e\)/, "%state), 1)") }'
   broken 'stresses that are compared in one place' result/body_values q4_2600x8 '/omp parallel do/ { n = 3 } n-- > 0 { sub(/size_of\(e\)/, "size_of(1)") }'
}

# broken WHAT SOURCE DECK AWK: what the sanitizer must see, else nothing said above were worth much
broken() {
   local what=$1 source=$2 deck=$3 name=${2##*/} seed log="$work/threads-run.log"
   awk "$4 { print }" "src/$source.f90" > "$work/broken/$name.f90"
   if cmp -s "src/$source.f90" "$work/broken/$name.f90"; then
      failed=$((failed + 1)); echo "FAILED threads: $source.f90 has no longer what is to be broken: $what"
      return
   fi
   "$fc" -O1 -g -fopenmp -fsanitize=thread -std=f2018 -J"$work/broken" -c "$work/broken/$name.f90" -o "$work/broken/$name.o" &&
   "$fc" -O1 -g -fopenmp -fsanitize=thread -I"$work/threads/release" -o "$work/broken/jointfem" src/jointfem.f90 \
      $(ls "$work"/threads/release/*.o | grep -v "/$name.o") "$work/broken/$name.o" "$work/threads/view.o" \
      "$work/threads/blas.o" $libraries
   # on a busy machine one thread may happen to do all; a broken program that waits for ever waits in the sanitizer's own exit too
   for seed in 1 2 3 4 5 6; do
      { OMP_NUM_THREADS=4 TASKS_SEED=$seed timeout -s KILL 120 "$work/broken/jointfem" -q -o "$work/results" "$work/$deck.bdf" > "$log" 2>&1; } 2> /dev/null
      grep -q 'ThreadSanitizer: data race' "$log" && break
   done
   if grep -q 'ThreadSanitizer: data race' "$log"; then
      passed=$((passed + 1))
   else
      failed=$((failed + 1)); echo "FAILED threads: $what: nothing is seen"
   fi
}

memcheck() {
   local deck log="$work/memcheck-run.log"
   command -v valgrind > /dev/null || { echo 'memcheck: skipped, valgrind is not installed'; return; }
   for deck in prism05 flange_pair bracket_spiders solid_bolt meshed_apart friction_full; do
      # valgrind has no AVX-512: OpenBLAS takes kernels that it can follow; with both variables set the program does not start itself anew
      OPENBLAS_CORETYPE=Haswell GOMP_SPINCOUNT=1000 OPENBLAS_NUM_THREADS=1 valgrind --leak-check=full --errors-for-leak-kinds=definite \
         bin/jointfem -q --threads 1 -o "$work/results" "input/$deck.bdf" > "$log" 2>&1
      verdict "memcheck: $deck" $? "$log" 'Invalid (read|write)|uninitialised|definitely lost: [1-9]' 0
   done
}

for part; do "$part"; done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
