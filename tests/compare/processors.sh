#!/usr/bin/env bash
# Compares every deck with its reference under the OpenBLAS kernels of other processors, and compiled for this processor alone,
# which multiplies and adds in one instruction. A kernel is skipped if this processor lacks its instructions. At least LEAST
# listings must be identical under all kernels; the others are named with their first different line. They differ in rows of CONVERGENCE
# HISTORY alone, and reference_output/differs.md names them.
#
#    processors.sh PROGRAM COMPARE BUILD_FOLDER LEAST
set -u
program=$1 compare=$2 build=$3 least=$4
passed=0 failed=0

# decks WHAT PROGRAM FOLDER: one check, its differences and its share of the sum
decks() {
   local last
   tests/compare/check.sh "$2" "$compare" "$3" > "$3.log" 2>&1
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
   kernels+=("$name")
}
kernels=()
kernel Haswell avx2 fma
kernel Zen avx2 fma
kernel SkylakeX avx512f avx512dq avx512bw avx512vl
kernel Sandybridge avx
kernel Nehalem sse4_2
kernel Prescott pni

# without_history KERNEL LISTING: the listing without the rows of CONVERGENCE HISTORY and ERROR OF PATH
without_history() {
   awk '/^ [A-Z]/ { on = /^ (CONVERGENCE HISTORY|ERROR OF PATH)/ } !(on && /^ *[0-9]/)' "$build/processors/$1/$2"
}

same=0
for deck in input/*.bdf; do
   name=$(basename "$deck" .bdf).out
   differs=
   for kernel in "${kernels[@]}"; do
      cmp -s "$build/processors/$kernels/$name" "$build/processors/$kernel/$name" || differs=$kernel
   done
   if [ -z "$differs" ]; then
      same=$((same + 1))
   else
      echo "$name differs under $kernels and $differs:"
      diff "$build/processors/$kernels/$name" "$build/processors/$differs/$name" | awk '/^[<>]/ && !seen[$1]++'
      if grep -qx "${name%.out}" tests/compare/ten_digits.txt || # single last digits
         cmp -s <(without_history "$kernels" $name) <(without_history "$differs" $name); then passed=$((passed + 1))
      else failed=$((failed + 1)); echo "$name: not in rows of CONVERGENCE HISTORY and ERROR OF PATH alone"; fi
      if sed -n '/^Listings with such rows/,/^$/p' reference_output/differs.md | grep -qF "\`${name%.out}\`"; then passed=$((passed + 1))
      else failed=$((failed + 1)); echo "$name: reference_output/differs.md does not name it"; fi
   fi
done
echo "$same listings are the same bytes under ${kernels[*]}, at least $least expected"
if [ "$same" -ge "$least" ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi

# -O1 is compiled soonest
if ${MAKE:-make} --no-print-directory -s BUILD="$build/native" BIN="$build/native/bin" "$build/native/bin/jointfem" \
   FFLAGS='-O1 -march=native' > "$build/processors/native.log" 2>&1; then
   decks native "$build/native/bin/jointfem" "$build/processors/native"
else
   cat "$build/processors/native.log"
   failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
