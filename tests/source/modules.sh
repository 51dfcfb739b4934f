#!/usr/bin/env bash
# Writes the list of modules, src/modules.md: for each module the first sentence of its first comment; then the folders whose
# modules each folder uses. `make modules` writes the page, tests/source/readme.sh checks that it is current.
#
#    modules.sh README SOURCE_FOLDER > PAGE
#
# The order of the folders is that of the line `base -> ...` in README.
set -eu
export LC_ALL=C
readme=$1 here=$(cd "$(dirname "$0")" && pwd)
order=$(sed -n 's/^ *\(base -> .*\)$/\1/p' "$readme" | head -n 1 | sed 's/ -> / /g')
[ -n "$order" ] || { echo "$readme draws no line 'base -> ...'" >&2; exit 1; }
cd "$2"
cat <<'END'
# The modules

This page is generated: `make modules` writes it from the first sentence of each module.
[README.md](README.md#folders) describes the folders.
END
awk -v order="$order" '
   function end_of_module() {
      if (module == "") return
      gsub(/(Eqs?|Figs?)\. /, "&\001", text) # the full stop of an abbreviation ends no sentence
      gsub(/ \001/, "\001", text)
      if (match(text, /\.( |$)/)) text = substr(text, 1, RSTART)
      gsub(/\001/, " ", text)
      gsub(/\|/, "\\|", text)
      rows[folder] = rows[folder] "| [" module "](" path ") | " text " |\n"
   }
   FNR == 1 {
      end_of_module()
      path = FILENAME
      split(FILENAME, part, "/")
      folder = part[1]
      module = part[2]
      sub(/\.f90$/, "", module)
      text = ""
      head = 1
   }
   head && /^ *!/ { line = $0; sub(/^ *![>!]? */, "", line); text = text (text == "" ? "" : " ") line; next }
   { head = 0 }
   END {
      end_of_module()
      n = split(order, name, " ")
      for (i = 1; i <= n; i++) printf "\n## `%s`\n\n| module | |\n|---|---|\n%s", name[i], rows[name[i]]
   }' */*.f90
cat <<'END'

## What uses what

On the left the folder that uses modules of those above.

```
END
awk -v order="$order" -f "$here/folder_uses.awk" */*.f90
echo '```'
