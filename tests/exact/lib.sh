# For run.sh: run a deck, take a value out of its results, compare. Every comparison counts one test; a value that is not a
# number fails.

passed=0 failed=0

fail() { echo "FAILED $1"; failed=$((failed + 1)); }

# run NAME [STATUS]: the deck $work/NAME.bdf; its messages are in NAME.log
run() {
   local status
   "$program" -q -o "$work" "$work/$1.bdf" > "$work/$1.log" 2>&1
   status=$?
   [ $status -eq "${2:-0}" ] && return 0
   cat "$work/$1.log"
   fail "$1: exit status $status, not ${2:-0}"
   return 1
}

# run_input NAME: a deck of input/
run_input() { cp "input/$1.bdf" "$work/$1.bdf" && run "$1"; }

# cell NAME STAGE INCREMENT NODE1 COLUMN [JOINT]
cell() {
   awk -F, -v s="$2" -v i="$3" -v n="$4" -v c="$5" -v j="${6:-}" '
      FNR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
      $1 == s && $2 == i && $(at["node1"]) == n && (j == "" || $(at["joint"]) == j) { print $(at[c]); found = 1; exit }
      END { if (!found) print "missing" }' "$work/$1.joint.csv"
}

# near WORDS ACTUAL EXPECTED RELATIVE [ABSOLUTE]
near() {
   if awk -v a="$2" -v e="$3" -v r="$4" -v t="${5:-0}" 'BEGIN {
         number = "^[ \t]*[-+]?[0-9.]+([eE][-+]?[0-9]+)?[ \t]*$"
         if (a !~ number || e !~ number) exit 1
         d = a - e; if (d < 0) d = -d
         m = e < 0 ? -e : e + 0
         exit !(d <= r * m + t) }'; then
      passed=$((passed + 1))
   else
      fail "$1: $2, expected $3"
   fi
}

# same WORDS ACTUAL EXPECTED
same() { if [ "$2" = "$3" ]; then passed=$((passed + 1)); else fail "$1: '$2', expected '$3'"; fi; }

# holds WORDS EXPRESSION: an awk expression that must be true
holds() { if awk "BEGIN { exit !($2) }"; then passed=$((passed + 1)); else fail "$1: $2"; fi; }

# says WORDS FILE PATTERN
says() { if grep -q -- "$3" "$2"; then passed=$((passed + 1)); else fail "$1: no '$3' in $2"; fi; }

# judge WORDS AWK-ARGUMENTS...: an awk script that prints a line for every fault and 'checked N' at its end
judge() {
   local words=$1 log="$work/judge.log"
   shift
   if awk "$@" > "$log" 2>&1 && [ "$(grep -c -v '^checked ' "$log")" -eq 0 ] && grep -q '^checked [1-9]' "$log"; then
      passed=$((passed + 1))
   else
      head -n 20 "$log"
      fail "$words"
   fi
}

# same_states WORDS NAME-A NAME-B RELATIVE [TURN]: all rows of two histories, element by element in their order: branches equal,
# lambda, p, delta, tau within RELATIVE of the largest of their column. TURN = -1: shear has the other sense in B.
same_states() {
   judge "$1" -F, -v tolerance="$4" -v turn="${5:-1}" '
      FNR == 1 { file++; for (k = 1; k <= NF; k++) at[$k] = k; next }
      function value(c) { return $(at[c]) + 0 }
      function size(x) { return x < 0 ? -x : x }
      file == 1 {
         n++
         where[n] = $1 "," $2; branch[n] = $(at["branch"]); side[n] = $(at["branch_x"])
         for (k = 1; k <= 4; k++) { v[k, n] = value(name[k]); if (size(v[k, n]) > top[k]) top[k] = size(v[k, n]) }
      }
      file == 2 {
         m++
         if (where[m] != $1 "," $2) print "row " m ": other increments"
         if (branch[m] != $(at["branch"])) print where[m] ", row " m ": branch " $(at["branch"]) ", not " branch[m]
         for (k = 1; k <= 4; k++)
            if (!(size((k > 2 ? turn : 1) * value(name[k]) - v[k, m]) <= tolerance * top[k]))
               print where[m] ", row " m ": " name[k] " " $(at[name[k]]) ", not " v[k, m]
      }
      BEGIN { split("lambda pressure delta_x tau_x", name, " ") }
      END { if (n != m || top[1] == 0) print n " rows, " m " rows, lambda up to " top[1]; print "checked " n }' \
      "$work/$2.joint.csv" "$work/$3.joint.csv"
}
