#!/usr/bin/env bash
# Compares every deck with its reference under the OpenBLAS kernels of other processors, and compiled for this processor alone,
# which multiplies and adds in one instruction. A kernel is skipped if this processor lacks its instructions. The listings are the same
# bytes under all kernels and in reference_output, but for rows of CONVERGENCE HISTORY and ERROR OF PATH, and but for the decks of
# ten_digits.txt. The first kernel and the oldest run all decks; the others share the decks, one in four each, without those that take
# longest, or run all but the longest with ALL=yes in the environment.
#
#    processors.sh PROGRAM COMPARE BUILD_FOLDER
set -u
program=$1 compare=$2 build=$3
long=tests/compare/long_decks.txt
passed=0 failed=0

# decks WHAT PROGRAM FOLDER [DECK...]: one check, its differences and its share of the sum
decks() {
   local last
   tests/compare/check.sh "$2" "$compare" "${@:3}" > "$3.log" 2>&1
   last=$(tail -n 1 "$3.log")
   set -- "$1" $last
   passed=$((passed + ${2:-0})) failed=$((failed + ${4:-1}))
   [ "${4:-1}" = 0 ] || { echo "$1:"; cat "$build/processors/$1.log"; }
}

mkdir -p "$build/processors"
short=$(for deck in input/*.bdf; do basename "$deck" .bdf; done | grep -vxFf $long)
share=0
# kernel NAME INSTRUCTIONS: the decks under this kernel where the processor has these INSTRUCTIONS
kernel() {
   local name=$1 instruction
   shift
   for instruction in "$@"; do
      grep -qw "$instruction" /proc/cpuinfo && continue
      echo "skipped: kernel $name: this processor has no $instruction"
      return
   done
   rm -rf "$build/processors/$name"
   case $name in
      Haswell|Prescott) OPENBLAS_CORETYPE=$name decks $name "$program" "$build/processors/$name" ;;
      *) OPENBLAS_CORETYPE=$name decks $name "$program" "$build/processors/$name" \
            $(if [ "${ALL:-}" ]; then echo "$short"; else awk -v of=$share 'NR % 4 == of' <<< "$short"; fi)
         share=$((share + 1)) ;;
   esac
   kernels+=("$name")
}
kernels=()
kernel Haswell avx2 fma
kernel Zen avx2 fma
kernel SkylakeX avx512f avx512dq avx512bw avx512vl
kernel Sandybridge avx
kernel Nehalem sse4_2
kernel Prescott pni

# without_history KERNEL LISTING
without_history() { tests/compare/printed.sh "$build/processors/$1/$2"; }

same=0 old=()
for deck in input/*.bdf; do
   name=$(basename "$deck" .bdf)
   grep -qx "$name" tests/compare/ten_digits.txt && continue
   # the reference too: make accept leaves a listing that is equal within the tolerances
   cmp -s <(without_history "$kernels" $name.out) <(tests/compare/printed.sh reference_output/$name.out) || old+=($name)
   differs=
   for kernel in "${kernels[@]}"; do
      [ -f "$build/processors/$kernel/$name.out" ] || continue # not among the decks of this kernel
      cmp -s <(without_history "$kernels" $name.out) <(without_history "$kernel" $name.out) || differs=$kernel
   done
   if [ -z "$differs" ]; then
      same=$((same + 1))
   else
      failed=$((failed + 1))
      echo "$name.out differs under $kernels and $differs:"
      diff <(without_history "$kernels" $name.out) <(without_history "$differs" $name.out) | head -n 20
   fi
done
echo "$same listings are the same bytes under ${kernels[*]}, but for CONVERGENCE HISTORY and ERROR OF PATH"
passed=$((passed + same))
[ ${#old[@]} -eq 0 ] || { failed=$((failed + 1)); echo "references that are not these bytes: ${old[*]}: BYTES=yes make accept CASE=name"; }

# -O1 is compiled soonest
if ${MAKE:-make} --no-print-directory -s BUILD="$build/native" BIN="$build/native/bin" "$build/native/bin/jointfem" \
   FFLAGS='-O1 -march=native' > "$build/processors/native.log" 2>&1; then
   decks native "$build/native/bin/jointfem" "$build/processors/native" $short
else
   cat "$build/processors/native.log"
   failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
