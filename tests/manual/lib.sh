# For make.sh: the functions by which the shell code of a chapter writes into the page. The page is open as file descriptor 3;
# faults go to the standard output, through fail of ../exact/lib.sh. A case sets
#    floor      smaller differences are printed as "< floor"
#    digits     of theory and program, six
#    limit      larger differences are faults: a page with one is not written
#    formulas   functions in awk for its theory, beside those of numbers.awk

page_numbers=$(cat tests/manual/numbers.awk)

# begin_case ID: called at the heading of every case
begin_case() { case_id=$1 floor=1e-9 limit=1e-9 digits=6 formulas=; }

# columns TITLE... [QUANTITY:]: the head of a table of theory, program and difference of the QUANTITY behind these columns; titles
# TITLE...: the head of another
columns() {
   local last=${*: -1}
   if [[ $last = *: ]]; then titles "${@:1:$#-1}" "$last theory" program difference; else titles "$@" theory program difference; fi
}
titles() {
   local t line='|' rule='|'
   for t in "$@"; do line="$line $t |" rule="$rule---|"; done
   printf '\n%s\n%s\n' "$line" "$rule" >&3
}

# row CELLS THEORY PROGRAM: THEORY is an expression in awk, PROGRAM a number or an expression of numbers
row() {
   local answer
   answer=$(awk -v floor="$floor" -v digits="$digits" "$page_numbers $formulas BEGIN { cells($2, ${3:-none}, floor) }" 2>&1)
   if [[ $answer != '| '*' |'$'\n'* ]]; then fail "$case_id, $1: $answer"; return; fi
   echo "| $1 ${answer%%$'\n'*}" >&3
   found "${answer##*$'\n'}" "$1"
}

# found DIFFERENCE WORDS: into the sum of the case, and judged. One that lies at the floor would be printed on one processor and not on
# another: the case needs another floor.
found() {
   echo "$case_id $1 $floor" >> "$work/found"
   awk -v d="$1" -v limit="$limit" -v floor="$floor" 'BEGIN { exit !(d <= limit) ? 1 : floor < limit && d > 0.75*floor && d < 1.25*floor ? 2 : 0 }'
   case $? in
      0) passed=$((passed + 1)) ;;
      1) fail "$case_id, $2: differs by $1, limit $limit" ;;
      *) fail "$case_id, $2: differs by $1, at the floor $floor" ;;
   esac
}

# fact CELLS THEORY PROGRAM: words that must be the same
fact() {
   echo "| $1 | $2 | $3 | $([ "$2" = "$3" ] && echo none || echo differs) |" >&3
   same "$case_id, $1" "$3" "$2"
}

# line CELL...: a row of another table; six prints numbers of it, share differences
line() { local c; { printf '|'; printf ' %s |' "$@"; echo; } >&3; }
six() { awk "$page_numbers $formulas BEGIN { print six($1) }"; }
share() { awk "$page_numbers BEGIN { t = difference_text($1, $floor); sub(/^\\+/, \"\", t); print t }"; }

# theory EXPRESSION: its value, all digits
theory() { awk "$page_numbers $formulas BEGIN { printf \"%.17g\", $1 }"; }

# note NAME VALUE: what {{NAME}} in the text of any chapter becomes; {{3.1}} is the largest difference of case 3.1
note() { echo "$1 $2" >> "$work/notes"; }

# ---- what several chapters ask ----

# energy NAME STAGE FIELD: of the table of energies; normal 2 put in, 3 given back; shear 5, 6; kept 7
energy() {
   awk -v title="ENERGY OF JOINTS, STAGE $2" -v f="$3" 'index($0, title) { for (i = 1; i <= 5; i++) getline; print $f; exit }' "$work/$1.out"
}

# farthest NAME COLUMN EXACT [CONDITION]: the COLUMN that is farthest from EXACT at the end (of the rows for which CONDITION holds)
farthest() {
   value "$1" rows "${4:-stage = max(stage)}" rows 'increment = max(increment)' rows "abs($2 - $3) = max(abs($2 - $3))" print "first($2)"
}

# stress NAME COLUMN[,COLUMN...] EXACT [LAST]: of the stresses of stage 1, elements up to LAST, the one farthest from EXACT
stress() {
   awk -v columns="$2" -v exact="$3" -v last="${4:-99999}" '
      function size(x) { return x < 0 ? -x : x }
      function look(s) { if (!seen++ || size(s - exact) > worst) { worst = size(s - exact); v = s } }
      BEGIN { n = split(columns, c, ",") }
      / STRESSES/ { on = index($0, "STAGE 1"); next }
      / (REACTIONS|BALANCE|NODE STRESSES|ANSWER|DISPLACEMENTS)/ { on = 0 }
      on && $1 + 0 == $1 && $1 <= last { for (k = 1; k <= n; k++) look($c[k]) }
      END { print v }' "$work/$1.out"
}
