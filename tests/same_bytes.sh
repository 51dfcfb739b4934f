#!/usr/bin/env bash
# How many listings are the same bytes under the kernels that OpenBLAS has for other processors. A listing that differs is named with
# the first line that differs; the check fails where fewer than LEAST are the same.
#
#    same_bytes.sh PROGRAM WORK_FOLDER LEAST [DECK...]     all decks of input, or those named
set -u
program=$1 work=$2 least=$3
shift 3
[ $# -gt 0 ] || set -- input/*.bdf
kernels='Haswell Nehalem Sandybridge Zen'
passed=0 failed=0 same=0

for kernel in $kernels; do
   rm -rf "${work:?}/$kernel"
   mkdir -p "$work/$kernel"
   for deck; do
      OPENBLAS_CORETYPE=$kernel "$program" -q --threads 1 -o "$work/$kernel" "$deck" > "$work/$kernel/log" 2>&1 ||
         { echo "FAILED $deck under $kernel: status $?"; failed=$((failed + 1)); }
   done
done
for deck; do
   name=$(basename "$deck" .bdf).out
   differs=
   for kernel in $kernels; do
      cmp -s "$work/Haswell/$name" "$work/$kernel/$name" && continue
      differs=$kernel
      break
   done
   if [ -z "$differs" ]; then
      same=$((same + 1))
   else
      echo "$name differs under Haswell and $differs:"
      diff "$work/Haswell/$name" "$work/$differs/$name" | awk '/^[<>]/ && !seen[$1]++'
   fi
done
echo "$same of $# listings are the same bytes, at least $least expected"
if [ "$same" -ge "$least" ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
