#!/usr/bin/env bash
# Makes the present results of decks of input/ their references.
#
#    accept.sh PROGRAM COMPARE WORK_FOLDER NAME...
#    accept.sh PROGRAM COMPARE WORK_FOLDER --failed CHECK_FOLDER      of the decks that failed the last check.sh in CHECK_FOLDER
#
# Listing and joint history always; the tables of stages, bolts, modes, their energy and response where a reference exists, or where
# TABLES='stage bolt modes modes.energy response backbone' in the environment asks for them.
#
# A reference that the comparison (tolerances.txt) finds equal is left as it is. Of another one those lines are written that differ beyond
# their tolerances, that are new, or gone: last digits, which depend on the processor, change nothing. With BYTES=yes in the environment a
# listing is written that is not the same bytes, its rows that rounding rules left out: a listing does not depend on the processor.
set -eu
export LC_ALL=C
here=$(dirname "$0")
program=$1 compare=$2 work=$3
shift 3
if [ "${1:-}" = --failed ]; then
   [ -e "$2/failed" ] || { echo "no check has been run: make check"; exit 1; }
   mapfile -t names < "$2/failed"
   set -- "${names[@]}"
   [ $# -gt 0 ] || { echo 'no deck has failed the last make check'; exit 0; }
fi
[ -n "${1:-}" ] || { echo 'usage: make accept CASE=name, for input/name.bdf, or ACCEPT=failed, for those that failed the last make check'; exit 1; }
mkdir -p "$work"

# equal REFERENCE ACTUAL [MERGED]
equal() { "$compare" "$here/tolerances.txt" "$@" > "$work/differences"; }

# joined FILE: its lines, and those below the title of a path, whose rows are not compared, as one line
joined() {
   awk -v tolerances="$here/tolerances.txt" '
      BEGIN { while ((getline line < tolerances) > 0) if (sub(/^path +/, "", line)) path[++n] = line }
      on && NF == 0 && rows > 0 { on = 0; print "" }
      on { rows += $1 ~ /^[-+0-9.]/; printf "\001%s", $0; next }
      { print; for (i = 1; i <= n; i++) if (index($0, path[i])) { on = 1; rows = 0 } }
      END { if (on) print "" }' "$1"
}

# masked FILE: its lines without real numbers and paths
masked() {
   awk -v csv="${1##*.}" '
      /^\001/ { print "#"; next }
      csv == "csv" { n = split($0, field, ",")
         for (i = 1; i <= n; i++) { if (field[i] ~ /^[-+0-9.EeDd ]+$/ && field[i] ~ /[.Ee]/) field[i] = "#"; printf "%s,", field[i] }
         print ""; next }
      { gsub(/[-+]?[0-9]*\.[0-9]*([EeDd]?[-+]?[0-9]+)?/, "#"); $1 = $1; print }' "$1"
}

# aligned REFERENCE ACTUAL: ACTUAL with the line of REFERENCE in place of each that is the same but for real numbers
aligned() {
   local old=$work/old.${1##*.} new=$work/new.${1##*.}
   joined "$1" > "$old"
   joined "$2" > "$new"
   masked "$old" > "$work/old.masked"
   masked "$new" > "$work/new.masked"
   { diff --old-line-format='-
' --new-line-format='+
' --unchanged-line-format='=
' "$work/old.masked" "$work/new.masked" || true; } |
      awk -v old_file="$old" -v new_file="$new" '
         /[-=]/ { getline old < old_file }
         /[+=]/ { getline new < new_file }
         /[+=]/ { line = /=/ ? old : new; sub(/^\001/, "", line); gsub(/\001/, "\n", line); print line }'
}

# stale REFERENCE LISTING: whether BYTES asks for this listing
stale() { [ -n "${BYTES:-}" ] && [ "${1##*.}" = out ] && ! grep -qx "$name" "$here/ten_digits.txt" && ! cmp -s <("$here/printed.sh" "$1") <("$here/printed.sh" "$2"); }

# accept FILE: that of WORK_FOLDER becomes the reference; counts the files that change
accept() {
   local reference=reference_output/$1 actual=$work/$1 merged=$work/merged.${1##*.} from=$work/aligned.${1##*.}
   if [ ! -e "$reference" ]; then
      cp "$actual" "$reference"
      echo "$1: new"
   elif stale "$reference" "$actual"; then
      cp "$actual" "$reference"
      echo "$1: as it is"
   elif cmp -s "$reference" "$actual" || equal "$reference" "$actual" "$merged"; then
      return
   else
      if ! equal "$merged" "$actual"; then # lines more or less
         aligned "$reference" "$actual" > "$from"
         equal "$from" "$actual" "$merged" || true
         equal "$merged" "$actual" || cp "$actual" "$merged"
      fi
      echo "$1: $(diff "$reference" "$merged" | grep -c '^>') of $(wc -l < "$merged") lines differ from the reference, $(diff "$reference" "$merged" | grep -c '^<') of it are gone"
      cp "$merged" "$reference"
   fi
   written=$((written + 1))
}

changed=0
for name; do
   [ -f "input/$name.bdf" ] || { echo "there is no deck input/$name.bdf"; exit 1; }
   "$program" -q -o "$work" "input/$name.bdf" > "$work/answer"
   written=0
   for suffix in out joint.csv; do accept "$name.$suffix"; done
   for table in stage bolt modes modes.energy response backbone; do
      [[ -f reference_output/$name.$table.csv || " ${TABLES:-} " = *" $table "* ]] || continue
      accept "$name.$table.csv"
   done
   changed=$((changed + written))
   if [ $written -gt 0 ]; then echo "$name: accepted"; else echo "$name: equal to its references within the tolerances, nothing is written"; fi
done
[ $changed -eq 0 ] || echo 'say in the commit message why the references changed'
