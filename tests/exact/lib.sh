# For run.sh, other test scripts and the verification manual: run a deck, ask its results, compare. Every comparison counts one test; a
# value that is not a number fails.

export LC_ALL=C
passed=0 failed=0

fail() { echo "FAILED $1"; failed=$((failed + 1)); }

# cards NAME: the deck $work/NAME.bdf of the lines on the standard input; a semicolon ends a line too, as in the unit tests
cards() { tr ';' '\n' > "$work/$1.bdf"; }

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

# ask WORDS NAME ACTION...: whether the history of NAME is so; value NAME ACTION...: what it prints. See compare/query_results.f90
ask() {
   local words=$1
   shift
   if value "$@" > "$work/said" 2>&1; then passed=$((passed + 1)); else cat "$work/said"; fail "$words"; fi
}
value() { "$query" "$work/$1.joint.csv" "${@:2}"; }

# cell NAME STAGE INCREMENT NODE1 COLUMN [JOINT]
cell() { value "$1" rows "stage = $2 and increment = $3 and node1 = $4${6:+ and joint = $6}" print "$5"; }

# holds WORDS CONDITION, near WORDS ACTUAL EXPECTED RELATIVE [ABSOLUTE], number EXPRESSION: numbers without a history
holds() { if "$query" - all "$2" > "$work/said" 2>&1; then passed=$((passed + 1)); else cat "$work/said"; fail "$1"; fi; }
near() { holds "$1: $2, expected $3" "($2) = ($3) within ($4)*abs($3) + (${5:-0})"; }
number() { "$query" - print "$1"; }

# same WORDS ACTUAL EXPECTED
same() { if [ "$2" = "$3" ]; then passed=$((passed + 1)); else fail "$1: '$2', expected '$3'"; fi; }

# says WORDS FILE PATTERN
says() { if grep -q -- "$3" "$2"; then passed=$((passed + 1)); else fail "$1: no '$3' in $2"; fi; }

# missing NAME: the force that is missing where NEWTON has found no equilibrium; last_state NAME: the share of the stage where the results end
missing() { sed -n 's/.*: \([0-9.E+-]*\) of force are missing.*/\1/p' "$work/$1.log"; }
last_state() { sed -n 's/.*last state in equilibrium is at \([0-9.]*\) of stage.*/\1/p' "$work/$1.log"; }

# iterations NAME [STAGE]: of NEWTON, in all stages or one; those that a long history leaves out count too
iterations() { awk -v only="${2:-}" -f tests/bench/iterations.awk "$work/$1.out" | awk '{ print $2; exit }'; }

# table NAME TITLE: the lines of the tables of the listing that are titled so
table() { awk -v title=" $2" 'index($0, title) == 1 { on = 1; next } /^ [A-Z]/ { on = 0 } on' "$work/$1.out"; }

# total NAME LINE [C]: component C, or the last one, of a line of the last balance of forces
total() {
   table "$1" 'BALANCE OF FORCES' | awk -v line="  $2 " -v c="${3:-}" \
      'index($0, line) == 1 { $0 = substr($0, length(line)); v = c ? $c : $NF } END { print v }'
}
# moved NAME NODE C: component C of the last displacements of a node
moved() { table "$1" 'DISPLACEMENTS OF NODES' | awk -v node="$2" -v c="$3" '$1 == node { v = $(1 + (NF - 1) / 2 + c) } END { print v }'; }

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

# same_rows WORDS NAME-A NAME-B RELATIVE SHEAR...: all rows of two histories in their order, branches and slips equal, lambda, p and
# each SHEAR within RELATIVE of the largest of its column. SHEAR: a column, or an expression of A = one of B
same_rows() {
   local words=$1 a b actions=(all 'stage = other.stage and increment = other.increment and branch = other.branch and slip = other.slip')
   for a in lambda pressure "${@:5}"; do
      b=${a#*=} a=${a%%=*}
      [ "$a" = "$b" ] && b=other.$a
      actions+=(all "$a = $b within $4*max(abs($a))")
   done
   ask "$words" "$2" all 'max(abs(lambda)) > 0 and max(abs(pressure)) > 0' with "$work/$3.joint.csv" "${actions[@]}"
}
along='delta_x tau_x'
against='delta_x=-other.delta_x tau_x=-other.tau_x'
both='delta_x delta_y tau_x tau_y'
resultant='sqrt(delta_x^2+delta_y^2)=sqrt(other.delta_x^2+other.delta_y^2) sqrt(tau_x^2+tau_y^2)=sqrt(other.tau_x^2+other.tau_y^2)'

# mode NAME MODE COLUMN [STAGE]: a cell of NAME.modes.csv; mode_energy NAME MODE KIND ID COLUMN: of NAME.modes.energy.csv
mode() { "$query" "$work/$1.modes.csv" rows "mode = $2 and stage = ${4:-1}" print "$3"; }
mode_energy() { awk -F, -v m="$2" -v kind="$3" -v id="$4" -v c="$5" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k }
   $2 == m && $3 == kind && $4 == id { print $at[c] }' "$work/$1.modes.energy.csv"; }
pi=3.14159265358979324

# backbone NAME COLUMN [AMPLITUDE NUMBER, 1 the smallest]; loss_of, frequency_of: expected figures as expressions of the amplitude there
backbone() { awk -F, -v name="$2" -v row="${3:-1}" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i } NR == row + 1 { print $c }' \
                "$work/$1.backbone.csv"; }

# Against free decay, integrated in time by ring_down.awk
# ring_down NAME V STEP TIME [OTHERS [RIGID]]: what ring_down.awk makes of the system in NAME.system, appended to NAME.rows
ring_down() { awk -v V="$2" -v step="$3" -v time="$4" -v others="${5:-0}" -v rigid="${6:-0}" -v cycles=2 -v skip=1 -f tests/exact/ring_down.awk "$work/$1.system" >> "$work/$1.rows"; }
# decays_like NAME: NAME.rows against the backbone of NAME, interpolated: frequency within 0.5 %, loss factor within 2 %. The energy at a turning
# point grows with the tangent of the force there, x dF/dx, the loss factor of the backbone has the secant F/x ~ f^2: the decrement of
# the same loop is that loss over 1 + 2 d(ln f)/d(ln x), up to 5 % more in what follows
decays_like() {
   judge "$1: free decay" -v name="$1" -F'[, ]' 'NR == FNR { if (FNR > 1) { x[++n] = log($3); f[n] = $4; d[n] = $5; if ($5 > largest) largest = $5 } next }
      { a = log($1); for (i = 1; i < n - 1 && x[i + 1] < a; i++) ; w = (a - x[i])/(x[i + 1] - x[i])
        if (w < 0 || w > 1) next
        fb = f[i] + w*(f[i + 1] - f[i]); db = d[i] + w*(d[i + 1] - d[i])
        if (db < 0.6*largest) next
        db /= 1 + 2*log(f[i + 1]/f[i])/(x[i + 1] - x[i])
        rows++
        if (($2/fb - 1)^2 > 0.005^2 || ($3/db - 1)^2 > 0.02^2) print "amplitude " $1 ": frequency " $2 ", loss " $3 "; backbone " fb ", " db }
      END { if (rows < 5) print rows " rows"; print "checked " rows }' "$work/$1.backbone.csv" "$work/$1.rows"
}
