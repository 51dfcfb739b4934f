#!/usr/bin/env bash
# The same problems in 13 systems of units, powers of ten apart: the same results, to 1E-9 of the largest of their kind.
#
#     units.sh PROGRAM FOLDER
#
# Ends with "N passed, N failed".
set -u
export LC_ALL=C
program=$(realpath "$1")
mkdir -p "$2"
folder=$(cd "$2" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
passed=0 failed=0
cd "$folder" || exit 2
rm -f ./*

# systems: number, power of ten of the length, of the force; the first is that of the problem
systems() { awk 'BEGIN { print 0, 0, 0; for (i = 1; i <= 13; i++) print i, i - 7, 2*((5*i)%13 - 6) }'; }

for problem in block beams; do
   for method in STEP NEWTON BACK; do
      systems | while read -r n length force; do
         awk -v problem=$problem -v method=$method -v length_power="$length" -v force_power="$force" -f "$here/scaled.awk" \
            > "$problem-$method-$n.bdf"
      done
   done
done
"$program" -q --threads 1 -o . ./*.bdf > out 2> err
for problem in block beams; do
   for method in STEP NEWTON BACK; do
      while read -r n length force; do
         [ "$n" -eq 0 ] && continue
         for table in joint stage; do
            wrong=$(awk -v length_power="$length" -v force_power="$force" -v tolerance=1e-9 -f "$here/same.awk" \
                    "$problem-$method-0.$table.csv" "$problem-$method-$n.$table.csv" 2>&1 | head -n 3)
            if [ -z "$wrong" ]; then
               passed=$((passed + 1))
            else
               failed=$((failed + 1))
               echo "FAILED: $problem by $method, lengths by 1E$length, forces by 1E$force: $wrong"
            fi
         done
      done < <(systems)
   done
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
