#!/usr/bin/env bash
# Every deck against its reference on other processors and by other optimisations: under the kernels that OpenBLAS has for
# them, and built without optimisation and with more of it, contracted to this processor's instructions. A kernel whose instructions
# this processor does not have is skipped.
#
#    processors.sh PROGRAM COMPARE BUILD_FOLDER
set -u
program=$1 compare=$2 build=$3
passed=0 failed=0

# decks WHAT PROGRAM FOLDER: one check, its differences and its share of the sum
decks() {
   local last
   tests/check.sh "$2" "$compare" "$3" > "$3.log" 2>&1
   last=$(tail -n 1 "$3.log")
   set -- "$1" $last
   passed=$((passed + ${2:-0})) failed=$((failed + ${4:-1}))
   [ "${4:-1}" = 0 ] || { echo "$1:"; cat "$build/processors/$1.log"; }
}

mkdir -p "$build/processors"
# kernel NAME INSTRUCTIONS: the decks under this kernel where the processor has these INSTRUCTIONS
kernel() {
   local name=$1 instruction
   shift
   for instruction in "$@"; do
      grep -qw "$instruction" /proc/cpuinfo && continue
      echo "skipped: kernel $name: this processor has no $instruction"
      return
   done
   OPENBLAS_CORETYPE=$name decks $name "$program" "$build/processors/$name"
}
kernel Haswell avx2 fma
kernel Zen avx2 fma
kernel SkylakeX avx512f avx512dq avx512bw avx512vl
kernel Sandybridge avx
kernel Nehalem sse4_2
for flags in '-O0' '-O3 -march=native'; do
   name=${flags%% *} name=${name#-}
   if ${MAKE:-make} --no-print-directory -s -j2 BUILD="$build/$name" BIN="$build/$name/bin" "$build/$name/bin/jointfem" \
      FFLAGS="$flags" > "$build/processors/$name.log" 2>&1; then
      decks $name "$build/$name/bin/jointfem" "$build/processors/$name"
   else
      cat "$build/processors/$name.log"
      failed=$((failed + 1))
   fi
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
