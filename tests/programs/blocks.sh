#!/usr/bin/env bash
# Two half-open blocks (blocks.awk) against contact of CalculiX with a table of pressure over overclosure: pressures of both
# programs on matching and non-matching faces, beside those of jointfem on matching faces. calculix.md has the table.
#
#    blocks.sh PROGRAM WORK_FOLDER
#
# Needs ccx. Status 1 where something fails, or where pressures on matching faces differ by more than 1E-4 of the largest.
set -u
export LC_ALL=C OMP_NUM_THREADS=1
program=$1 work=$2
here=$(dirname "$0")
mkdir -p "$work"
status=0
for lower in 16x4 11x3 22x5; do
   name=blocks_$lower
   awk -v form=deck -v upper=16x4 -v lower=$lower -v order=1 -f "$here/blocks.awk" > "$work/$name.bdf"
   awk -v form=ccx -v upper=16x4 -v lower=$lower -v order=1 -f "$here/blocks.awk" > "$work/$name.inp"
   "$program" -q -o "$work" "$work/$name.bdf" 2> "$work/said" && (cd "$work" && ccx "$name" > "$name.log" 2>&1) || { status=1; continue; }
   # last increment of the program on matching faces, of it here, and CalculiX here, node by node
   awk -v name="$lower" -v tolerance="$([ $lower = 16x4 ] && echo 1e-4 || echo 1)" '
      function add(kind, p, a) { d = p - reference[place]; sum[kind] += a * d^2; if (d < 0) d = -d; if (d > most[kind]) most[kind] = d }
      FNR == 1 { file++; FS = file < 3 ? "," : " "; $0 = $0 }
      file < 3 && FNR == 1 { for (k = 1; k <= NF; k++) column[$k] = k; next }
      file < 3 { place = $column["x"] " " $column["y"] " " $column["z"] }
      file == 1 { reference[place] = $column["pressure"]; if ($column["pressure"] > largest) largest = $column["pressure"]; next }
      file == 2 && $column["increment"] == 4 { node = $column["node1"]; at[node] = place; area[node] = $column["area"]; p[node] = $column["pressure"] }
      file == 3 && /contact stress/ { on = 1; next }
      file == 3 && on && NF == 4 { theirs[$1] = $2 }
      END {
         largest = 0; for (place in reference) if (reference[place] > largest) largest = reference[place]
         for (node in at) { place = at[node]; n++; all += area[node]; add("ours", p[node], area[node]); add("theirs", theirs[node], area[node]) }
         printf "| 16 x 4 over %s | %.5f | %.4f | %.5f | %.4f |\n", name, sqrt(sum["ours"] / all) / largest, most["ours"] / largest,
            sqrt(sum["theirs"] / all) / largest, most["theirs"] / largest
         exit !(n > 0 && (tolerance == 1 || most["theirs"] <= tolerance * largest))
      }' "$work/blocks_16x4.joint.csv" "$work/$name.joint.csv" "$work/$name.dat" || status=1
done
exit $status
