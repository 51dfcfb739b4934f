#!/usr/bin/env bash
# Models that do not fit into the memory, limited here by `ulimit -v`: the program refuses them with the memory needed and the model
# that would fit; where an allocation fails, it prints a message, ends with status 3 and leaves no results but finished stages.
#
#    memory.sh PROGRAM WORK_FOLDER
set -u
program=$1 work=$2
passed=0 failed=0
rm -rf "$work"
mkdir -p "$work"

deck() { # SHAPE SOLVER
   tests/bench/make_deck.sh "$1" "$2" NONE > "$work/$1.bdf"
}

# limited MIB DECK...: status, words, and the results that are there, complete or not; older ones are there before
limited() {
   local mib=$1 file
   shift
   find "$work" -type f ! -name '*.bdf' -delete
   for file; do
      [[ $file = *.bdf ]] || continue
      touch "${file%.bdf}".{out,vtu,joint.vtu,1.vtu}
      echo "file=\"$(basename "$file" .bdf).1.vtu\"" > "${file%.bdf}.pvd"
   done
   ( ulimit -v $(((mib + more)*1024)) && OPENBLAS_NUM_THREADS=1 timeout 60 "$program" -q --threads 1 -o "$work" "$@" ) > "$work/said" 2>&1
   status=$?
   results=$(find "$work" -type f ! -name '*.bdf' ! -name said | wc -l)
}

# The libraries of one system take more address space than those of another: MORE than the 252 MiB [MiB] that a small deck needs with
# gfortran 12 and OpenBLAS 0.3.21
least() {
   local mib
   deck q4_40x8 TREE
   for ((mib = 16; mib <= 1024; mib += 4)); do
      ( ulimit -v $((mib*1024)) && OPENBLAS_NUM_THREADS=1 timeout 20 "$program" -q --threads 1 -o "$work" "$work/q4_40x8.bdf" ) \
         > /dev/null 2>&1 && break
      # OpenBLAS 0.3.29 asks for ever where its library cannot be loaded, before the program begins
      [ $? -eq 124 ] && mib=$((mib + 28))
   done
   echo $mib
}

# check WHAT STATUS RESULTS WORDS...
check() {
   local what=$1 wanted="$2 $3" word
   shift 3
   for word; do
      grep -qE "$word" "$work/said" || { wanted="words '$word'"; break; }
   done
   if [ "$status $results" = "$wanted" ] && ! grep -qi 'backtrace' "$work/said"; then
      passed=$((passed + 1))
   else
      failed=$((failed + 1)); echo "FAILED $what: status $status, $results results, expected $wanted"
      head -n 5 "$work/said"
   fi
}

more=0
more=$(($(least) - 252))
echo "address space of the libraries: $((more + 252)) MiB for a small deck"

# ------------------------------------------------------------------ less than the first call of OpenBLAS takes, which asks for ever
deck q4_40x8 TREE
for ((mib = 128; mib <= 248; mib += 40)); do
   limited $mib "$work/q4_40x8.bdf"
   check "a small deck in $mib MiB" 3 0 'OpenBLAS needs at least [0-9]+ MiB of address space for 1 thread, and [0-9]+ MiB are left'
done

# ------------------------------------------------------------------ told from the cards, before a node is made
for solver in AUTO SKYLINE; do
   deck hex8_250x250x250 $solver
   limited 300 "$work/hex8_250x250x250.bdf"
   check "250 x 250 x 250 by $solver" 3 0 'nodes of the model need at least 7540 MiB' 'and [0-9]{2,3} MiB are available'
done
deck q4_4000x4000 TREE
limited 300 "$work/q4_4000x4000.bdf"
check 'a plate of 4000 x 4000' 3 0 'nodes of the model need at least 7633 MiB'

# ------------------------------------------------------------------ nothing is told, an allocation fails while the model is built
limited 200 --check "$work/hex8_250x250x250.bdf"
check '250 x 250 x 250, --check without room for OpenBLAS' 3 5 'OpenBLAS needs at least [0-9]+ MiB of address space'
limited 300 --check "$work/hex8_250x250x250.bdf"
check '250 x 250 x 250, --check, which leaves older results alone' 3 5 \
   'the memory of the machine, or the permitted part of it, does not suffice; no results'

# ------------------------------------------------------------------ GRID and CHEXA: told from the fronts as well
awk -v n=45 'BEGIN {
   m = n + 1
   print "SPC = 1\nECHO = NO\nSOLVER = TREE\nSUBCASE 1\nLOAD = 10\nINCR = 5\nOUTPUT = NONE\nBEGIN BULK"
   for (k = 0; k < m^3; k++) printf "GRID,%d,,%.1f,%.1f,%.1f\n", k + 1, k%m, int(k/m)%m, int(k/m^2)
   for (k = 0; k < n^3; k++) {
      a = 1 + k%n + m*(int(k/n)%n) + m^2*int(k/n^2)
      b = a + m^2
      printf "CHEXA,%d,1,%d,%d,%d,%d,%d,%d\n,%d,%d\n", k + 1, a, a + 1, a + 1 + m, a + m, b, b + 1, b + 1 + m, b + m
   }
   print "PSOLID,1,1\nMAT1,1,9500.0,,0.25\nFORCE,10," m^3 ",,1.0,0.0,0.0,1.0\nJINCR,5,1"
   for (k = 1; k <= m^2; k++) print "SPC1,1,123," k
   print "ENDDATA" }' > "$work/grid.bdf"
limited 400 "$work/grid.bdf"
check '45 x 45 x 45 from GRID cards' 3 0 'factor of 285660 equations needs about [0-9]{4} MiB' 'about [0-9]+ equations of this shape would fit'

# ------------------------------------------------------------------ told from the fronts, and from the skyline
deck hex8_20x20x20 TREE
limited 352 "$work/hex8_20x20x20.bdf"
check '20 x 20 x 20 in 352 MiB' 3 0 'factor of 26901 equations needs about 1[0-9]{2} MiB' 'about [0-9]{5} equations of this shape would fit'
limited 1024 "$work/hex8_20x20x20.bdf"
check '20 x 20 x 20 in 1024 MiB' 0 4
deck hex8_20x20x19 TREE
limited 576 "$work/hex8_20x20x20.bdf" "$work/hex8_20x20x19.bdf"
check 'one after the other in 576 MiB' 0 8
deck hex8_20x20x20 SKYLINE
limited 576 "$work/hex8_20x20x20.bdf"
check '20 x 20 x 20 by SKYLINE in 576 MiB' 3 0 'skyline of 26901 equations needs [0-9]{3,4} MiB' 'SOLVER = TREE needs less'

# ------------------------------------------------------------------ an allocation that fails: wherever that is, no other end
deck hex8_16x16x16 TREE
deck q4_400x80 TREE
few=0
for shape in hex8_16x16x16 q4_400x80; do # the plate is large enough to be ordered by a coarse graph first
   for ((mib = 64; mib <= 400; mib += 16)); do
      limited $mib "$work/$shape.bdf"
      if [ "$status" -eq 0 ]; then
         check "$shape in $mib MiB" 0 4
      else
         few=$((few + 1))
         check "$shape in $mib MiB" 3 0 'MiB|memory'
      fi
   done
done

# ------------------------------------------------------------------ every allocation may be the first that fails, by failing_malloc.c
# requests ARGUMENT...: how many there are in a run that ends well
requests() {
   FAIL_COUNT="$work/count" LD_PRELOAD="$work/failing.so" "$program" "$@" > "$work/said" 2>&1 && cat "$work/count" || echo 0
}

# failing DECK THREADS: 40 runs, the first failure anywhere between the first request of the program and the last one
failing() {
   local deck=$1 threads=$2 first n k i
   first=$(requests --version) # most of them the run-time library's, before the program begins
   n=$(requests -q --threads "$threads" -o "$work" "$deck")
   if [ "$n" -lt $((first + 100)) ]; then
      failed=$((failed + 1)); echo "FAILED $deck: $n allocations"; return
   fi
   for ((i = 0; i < 40; i++)); do
      k=$((first + 1 + i*(n - first - 1)/40))
      find "$work" -type f ! -name '*.bdf' ! -name 'failing.so' -delete
      FAIL_FROM=$k LD_PRELOAD="$work/failing.so" timeout 60 "$program" -q --threads "$threads" -o "$work" "$deck" > "$work/said" 2>&1
      status=$?
      results=$(find "$work" -type f ! -name '*.bdf' ! -name 'failing.so' ! -name said | wc -l)
      check "$deck, $threads threads, allocation $k of $n" 3 0 'memory|llocat'
   done
}

if command -v gcc > /dev/null && gcc -shared -fPIC -O1 -o "$work/failing.so" tests/solver/failing_malloc.c 2> /dev/null; then
   tests/bench/make_deck.sh hex8_8x8x8 TREE NONE > "$work/one.bdf"
   tests/bench/make_deck.sh q4_200x6 TREE LAST > "$work/parts.bdf"
   tests/bench/make_deck.sh over_8x6x3 TREE NONE 2 > "$work/friction.bdf"
   tests/bench/make_deck.sh hex8_5x5x3 TREE NONE | sed '/^SPC =/i METHOD = NEWTON' > "$work/newton.bdf"
   tests/bench/make_deck.sh q4_40x8 SKYLINE VTU > "$work/skyline.bdf"
   for name in one parts friction newton skyline; do failing "$work/$name.bdf" 1; done
   failing "$work/one.bdf" 2
else
   echo 'skipped: the failure of every allocation: there is no gcc'
fi

# ------------------------------------------------------------------ an allocation fails in the second stage: the first one stays, marked
tests/bench/make_deck.sh q4_1x1 SKYLINE VTU 24 | sed -E -e 's/^BEGIN/SUBCASE 2\n  LOAD = 11\n  INCR = 6\nBEGIN/' \
   -e 's/^ENDDATA/LOAD,11,1.5,1.0,10\nJINCR,6,80000,ARITH,1.25-5\nENDDATA/' > "$work/long.bdf"
limited 256 "$work/long.bdf"
check 'a listing of two million re-analyses' 3 5 '' 'does not suffice$' 'long.out keeps the stages that had ended, up to stage 1, increment 20, marked'
if tail -n 1 "$work/long.out" | grep -q '^ ENDED EARLY   AT STAGE 1, INCREMENT 20' && [ "$(awk -F, 'END { print $1, $2 }' "$work/long.joint.csv")" = '1 20' ] &&
   grep -q '^long.joint.csv: ENDED EARLY at stage 1, increment 20$' "$work/long.early"; then passed=$((passed + 1))
else failed=$((failed + 1)); echo 'FAILED the first stage of a listing of two million re-analyses is not kept and marked'
fi
echo "$few runs did not fit"
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
