#!/usr/bin/env bash
# Decks to and from pyNastran, where it is installed: a deck written by pyNastran runs unchanged, with the sums of loads that
# pyNastran finds; pyNastran reads the decks of this program that have no joints.
#
#    pynastran.sh PROGRAM WORK_FOLDER
#
# PYTHON names a python3 that has pyNastran.
set -u
export LC_ALL=C
program=$1 work=$2
here=$(dirname "$0")
python=${PYTHON:-python3}
passed=0 failed=0
mkdir -p "$work"

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED: $1"; }

if ! "$python" -c 'import pyNastran' > /dev/null 2>&1; then
   echo 'skipped: decks to and from pyNastran: it is not installed (python3 -m pip install pyNastran)'
   echo '0 passed, 0 failed'
   exit 0
fi

# ---- it writes, the program runs ----

deck=$work/written.bdf
"$python" "$here/pynastran.py" write "$deck" > "$work/log" 2>&1 && pass || { fail 'written by pyNastran'; tail -n 3 "$work/log"; }
"$program" -q -o "$work" "$deck" > "$work/said" 2>&1 && pass || { fail 'the deck of pyNastran runs'; head -n 5 "$work/said"; }
"$python" "$here/pynastran.py" loads "$deck" > "$work/loads" 2> "$work/log" || fail 'loads by pyNastran'
# the table STAGES of the listing has the same sums, to its six digits
awk 'function size(x) { return x < 0 ? -x : x }
   FNR == NR { for (k = 2; k <= 4; k++) expected[$1, k] = $k; n++; next }
   /^ STAGES/ { on = 1; next }
   on && /^ [A-Z]/ { on = 0 }
   on && NF >= 7 && $1 + 0 == $1 {
      found++
      largest = size($5) + size($6) + size($7)
      for (k = 2; k <= 4; k++) if (!(size(expected[$1, k] - $(k + 3)) <= 2e-5 * largest)) print "case " $1 ": " $(k + 3) ", pyNastran " expected[$1, k]
   }
   END { if (n != 8 || found != n) print found + 0 " stages, " n + 0 " cases" }' "$work/loads" "$work/written.out" > "$work/differences"
[ -s "$work/differences" ] && { fail 'loads as pyNastran has them'; head -n 5 "$work/differences"; } || pass

# ---- the program's decks, it reads ----

for name in patch_hexa patch_penta patch_tetra; do
   cp tests/exact/patch.inc "$work"
   { echo 'SOL 101'; echo CEND; cat "tests/exact/$name.bdf"; } > "$work/$name.bdf" # without these pyNastran takes no case control
   "$python" "$here/pynastran.py" read "$work/$name.bdf" > "$work/read" 2> "$work/log" || { fail "$name read by pyNastran"; tail -n 3 "$work/log"; continue; }
   said=$("$program" --check "$work/$name.bdf" 2> /dev/null)
   read -r nodes elements < "$work/read"
   case $said in
      *"$nodes nodes, $elements body elements"*) pass ;;
      *) fail "$name: pyNastran reads $nodes nodes and $elements elements, the program: $said" ;;
   esac
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
