#!/usr/bin/env bash
# Checks the order of the folders of src in README.md: a module uses only modules of its own folder and of folders to the left.
#
#    folders.sh README SOURCE_FOLDER
#
# Prints every `use` against the order, and every folder missing in README; N counts modules. The main programs may use all folders.
set -u
readme=$1 source=$2
order=$(sed -n 's/^ *\(base -> .*\)$/\1/p' "$readme" | head -n 1 | sed 's/ -> / /g')
[ -n "$order" ] || { echo "$readme draws no line 'base -> ...'"; exit 1; }
find "$source" -mindepth 2 -name '*.f90' | sort | xargs awk -v order="$order" '
   BEGIN { n = split(order, name, " "); for (i = 1; i <= n; i++) rank[name[i]] = i }
   FNR == 1 {
      parts = split(FILENAME, part, "/"); module = part[parts]; sub(/\.f90$/, "", module)
      home[module] = part[parts - 1]; modules[++m] = module
   }
   $1 == "use" { other = $2; sub(/,.*/, "", other); uses[module] = uses[module] " " other }
   END {
      for (i = 1; i <= m; i++) {
         module = modules[i]; wrong = 0
         if (!(home[module] in rank)) { print module ": README draws no folder " home[module]; failed++; continue }
         k = split(uses[module], list, " ")
         for (j = 1; j <= k; j++) if (list[j] in home && rank[home[list[j]]] > rank[home[module]]) {
            print module " of " home[module] " uses " list[j] " of " home[list[j]] ", which comes later"; wrong = 1
         }
         if (wrong) failed++; else passed++
      }
      print passed + 0 " passed, " failed + 0 " failed"
      exit failed > 0 || passed == 0
   }'
