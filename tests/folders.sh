#!/usr/bin/env bash
# The folders of src in the order that README.md draws: a module uses modules of its own folder and of those to the left of it.
#
#    folders.sh README SOURCE_FOLDER
#
# Prints every `use` against the order, and every folder that is not drawn; ends with `N passed, N failed`, N modules.
set -u
readme=$1 source=$2
order=$(sed -n 's/^ *\(base -> .*\)$/\1/p' "$readme" | head -n 1 | sed 's/ -> / /g')
[ -n "$order" ] || { echo "$readme draws no line 'base -> ...'"; exit 1; }
find "$source" -name '*.f90' | sort | xargs awk -v order="$order" '
   BEGIN { n = split(order, name, " "); for (i = 1; i <= n; i++) rank[name[i]] = i }
   FNR == 1 {
      parts = split(FILENAME, part, "/"); module = part[parts]; sub(/\.f90$/, "", module)
      home[module] = part[parts - 1]; file[module] = FILENAME; modules[++m] = module
   }
   $1 == "use" { used = $2; sub(/,.*/, "", used); uses[module] = uses[module] " " used }
   END {
      for (i = 1; i <= m; i++) {
         module = modules[i]; wrong = 0
         if (file[module] ~ /^[^\/]*src\/[^\/]*$/) { passed++; continue } # a main program uses what it wants
         if (!(home[module] in rank)) { print file[module] ": the folder " home[module] " is not in the order"; failed++; continue }
         k = split(uses[module], used, " ")
         for (j = 1; j <= k; j++) if (used[j] in home && rank[home[used[j]]] > rank[home[module]]) {
            print file[module] ": uses " used[j] " of " home[used[j]] ", which comes after " home[module]; wrong = 1
         }
         if (wrong) failed++; else passed++
      }
      print passed + 0 " passed, " failed + 0 " failed"
      exit failed > 0 || passed == 0
   }'
