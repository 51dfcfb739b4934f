#!/bin/bash
# Decks with faults and wrong commands: the program must name the fault, return the right status, and leave no file that could be
# taken for a result.
#
#     run.sh PROGRAM
#
# expand.awk makes the decks from the tables of this folder (README.md); commands.sh and files.sh have the commands.
set -u
export LC_ALL=C

if [ $# -ne 1 ] || [ ! -x "$1" ]; then
   echo "usage: run.sh PROGRAM" >&2
   exit 2
fi
program=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0; failed=0

# ---- tools ----

pass() { passed=$((passed + 1)); }
fail() {
   failed=$((failed + 1))
   echo "FAILED: $1"
   if [ -s "$work/stderr" ]; then head -n 6 "$work/stderr" | cut -c 1-160; fi
}

# run ARGUMENTS: the program, at most 60 seconds (LIMIT); sets STATUS, leaves $work/stdout and $work/stderr
run() {
   timeout "${LIMIT:-60}" "$program" "$@" >"$work/stdout" 2>"$work/stderr"
   status=$?
}

# missing_fragment FILE: the first line of FILE, from the second on, that the standard error does not hold
missing_fragment() {
   awk 'function holds(text, fragment,   from, at, next_one) {
           for (from = 1; (at = index(substr(text, from), fragment)) > 0; from += at) {
              next_one = substr(text, from + at - 1 + length(fragment), 1)
              if (fragment !~ /line [0-9]+$/ || next_one !~ /[0-9]/) return 1
           }
           return 0
        }
        NR == FNR { said = said $0 "\n"; next }
        FNR > 1 && !holds(said, $0) { print; exit }' "$work/stderr" "$1"
}

# Errors of a deck are numbered 1 OF n to n OF n; prints what is wrong with the numbers.
wrong_numbers() {
   awk '/^DECK ERROR / { k++; if ($3 != k) print "error " k " has number " $3; if (n == "") n = $5; if ($5 != n) print "two totals" }
        /^and [0-9]+ more errors?, not printed/ { k += $2 }
        END { if (k == 0) print "no DECK ERROR"; else if (k != n) print k " errors of " n }' "$work/stderr"
}

# What no run may ever say: a fault that the run-time library caught, a path of this machine.
unseemly() { grep -a -m 1 -e 'Fortran runtime error' -e 'Backtrace' -e 'Program received' -e "$work" "$work/stderr"; }

# check WHAT STATUS [TEXT...]: status and texts of the last run
check() {
   local what=$1 expected=$2 text
   shift 2
   if [ "$status" -ne "$expected" ]; then fail "$what: exit status $status, expected $expected"; return; fi
   if [ -n "$(unseemly)" ]; then fail "$what: it says '$(unseemly)'"; return; fi
   for text in "$@"; do
      if ! grep -aqF -- "$text" "$work/stderr"; then fail "$what: the message lacks '$text'"; return; fi
   done
   pass
}

# prints WHAT PATTERN: the standard output of the last run has such a line
prints() { if grep -q "$2" "$work/stdout"; then pass; else fail "$1: no line '$2' on the standard output"; fi; }

# holds FOLDER WHAT FILES...: exactly these files are in FOLDER
holds() {
   local folder=$1 what=$2 found
   shift 2
   found=$(ls -A "$folder" | tr '\n' ' ')
   if [ "$found" = "$(printf '%s\n' "$@" | sort | tr '\n' ' ' | sed 's/^ $//')" ]; then pass
   else fail "$what: files '$found', expected '$*'"
   fi
}

fresh() { rm -rf "$1"; mkdir "$1"; }

# ---- the decks of the tables ----

mkdir "$work/decks"
cd "$here" || exit 2
cp ./*.inc "$work/decks"
awk -v bases=base -v into="$work/decks" -f expand.awk *.table 2>"$work/stderr" || fail 'the tables'
for deck in base/*.bdf; do
   run --check "$deck"
   [ "$status" -eq 0 ] || fail "$deck, on which bad decks stand, is not good itself"
done
cd "$work/decks" || exit 2

# check_deck NAME: run it where results of an earlier run lie, and look at everything
check_deck() {
   local name=$1 expected missing
   read -r _ expected < "$name.expected"
   fresh ../results
   echo old > "../results/$name.out"
   echo old > "../results/$name.joint.csv"
   run -o ../results "$name.bdf"
   if [ "$status" -ne "$expected" ]; then fail "$name: exit status $status, expected $expected"; return; fi
   if [ ! -s "$work/stderr" ]; then fail "$name: nothing is said"; return; fi
   if [ -n "$(unseemly)" ]; then fail "$name: it says '$(unseemly)'"; return; fi
   if [ -e "../results/$name.early" ] && [ "$expected" -eq 3 ]; then # the stages that had ended stay, with their answers
      if ! tail -n 1 "../results/$name.out" | grep -q '^ ENDED EARLY'; then fail "$name: the listing has no mark"; return; fi
      rm -f "../results/$name".*
   elif [ -s "$work/stdout" ]; then fail "$name: text on the standard output"; return; fi
   if [ "$expected" -eq 2 ] && [ -n "$(wrong_numbers)" ]; then fail "$name: $(wrong_numbers)"; return; fi
   missing=$(missing_fragment "$name.expected")
   if [ -n "$missing" ]; then fail "$name: the message lacks '$missing'"; return; fi
   if [ -n "$(ls -A ../results)" ]; then fail "$name: files left: $(ls -A ../results | tr '\n' ' ')"; return; fi
   pass
}

for deck in *.bdf; do check_deck "${deck%.bdf}"; done

# ---- commands ----

. "$here/commands.sh"
. "$here/files.sh"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
