#!/usr/bin/env bash
# Compares every deck with its reference under the OpenBLAS kernels of other processors. A kernel is skipped if this processor lacks its
# instructions. The listings are the bytes of reference_output under all kernels, but for rows of CONVERGENCE HISTORY and ERROR OF PATH, and
# but for the decks of ten_digits.txt. The first kernel and the oldest run all short decks, the others one in four of them each; the decks
# that take longest are dealt out, one kernel each. With ALL=yes in the environment every kernel runs all decks.
#
#    processors.sh PROGRAM COMPARE BUILD_FOLDER
set -u
program=$1 compare=$2 build=$3
long=tests/compare/long_decks.txt
passed=0 failed=0
mkdir -p "$build/processors"

# the kernels whose INSTRUCTIONS this processor has
kernels=()
while read -r name instructions; do
   for instruction in $instructions; do
      grep -qw "$instruction" /proc/cpuinfo && continue
      echo "skipped: kernel $name: this processor has no $instruction"
      continue 2
   done
   kernels+=("$name")
done <<'KERNELS'
Haswell avx2 fma
Zen avx2 fma
SkylakeX avx512f avx512dq avx512bw avx512vl
Sandybridge avx
Nehalem sse4_2
Prescott pni
KERNELS

# share K N: one in N of the lines, from the K-th on
share() { awk -v k="$1" -v n="$2" '(NR - 1) % n == k % n'; }

count=${#kernels[@]}
for ((k = 0; k < count; k++)); do
   name=${kernels[k]} parts=4
   { [ $k -eq 0 ] || [ $k -eq $((count - 1)) ]; } && parts=1
   decks=$(for deck in input/*.bdf; do basename "$deck" .bdf; done)
   [ "${ALL:-}" ] || decks=$(grep -vxFf $long <<< "$decks" | share $k $parts; grep -xFf $long <<< "$decks" | share $k $count)
   rm -rf "$build/processors/$name"
   OPENBLAS_CORETYPE=$name tests/compare/check.sh "$program" "$compare" "$build/processors/$name" $decks > "$build/processors/$name.log" 2>&1
   set -- $(tail -n 1 "$build/processors/$name.log")
   passed=$((passed + ${1:-0})) failed=$((failed + ${3:-1}))
   [ "${3:-1}" = 0 ] || { echo "$name:"; cat "$build/processors/$name.log"; }
done

# make accept leaves a reference that is equal within the tolerances
same=0
for deck in input/*.bdf; do
   name=$(basename "$deck" .bdf) differs=
   grep -qx "$name" tests/compare/ten_digits.txt && continue
   for kernel in "${kernels[@]}"; do
      listing=$build/processors/$kernel/$name.out
      [ -f "$listing" ] || continue # not among the decks of this kernel
      cmp -s <(tests/compare/printed.sh "$listing") <(tests/compare/printed.sh reference_output/$name.out) && continue
      differs="$differs $kernel"
      diff <(tests/compare/printed.sh "$listing") <(tests/compare/printed.sh reference_output/$name.out) | head -n 20
   done
   if [ -z "$differs" ]; then
      same=$((same + 1))
   else
      failed=$((failed + 1))
      echo "$name.out is not the bytes of its reference under$differs: where it is right, BYTES=yes make accept CASE=$name"
   fi
done
echo "$same listings are the bytes of their references under ${kernels[*]}, but for CONVERGENCE HISTORY and ERROR OF PATH"
passed=$((passed + same))
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
