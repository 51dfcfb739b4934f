# For make.sh: the words with which the shell of a chapter writes into the page. The page is open as file descriptor 3; faults go to the
# standard output, through fail of ../exact/lib.sh. A case sets
#    floor      differences below it are printed as "< floor"
#    limit      larger ones are faults: a page with them is not written
#    formulas   functions in awk that its theory calls; those of numbers.awk are there too

page_numbers=$(cat tests/manual/numbers.awk)

# begin_case ID: called at the heading of every case
begin_case() { case_id=$1 floor=1e-9 limit=1e-9 formulas=; }

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
   answer=$(awk -v floor="$floor" "$page_numbers $formulas BEGIN { cells($2, ${3:-none}, floor) }" 2>&1)
   if [[ $answer != '| '*' |'$'\n'* ]]; then fail "$case_id, $1: $answer"; return; fi
   echo "| $1 ${answer%%$'\n'*}" >&3
   found "${answer##*$'\n'}" "$1"
}

# found DIFFERENCE WORDS: into the sum of the case, and judged
found() {
   echo "$case_id $1 $floor" >> "$work/found"
   if awk -v d="$1" -v limit="$limit" 'BEGIN { exit !(d <= limit) }'; then passed=$((passed + 1)); else fail "$case_id, $2: differs by $1, limit $limit"; fi
}

# fact CELLS THEORY PROGRAM: words that must be the same
fact() {
   echo "| $1 | $2 | $3 | $([ "$2" = "$3" ] && echo none || echo differs) |" >&3
   same "$case_id, $1" "$3" "$2"
}

# line CELL...: a row of another table; six and few print numbers of it: six digits, two digits
line() { local c; { printf '|'; printf ' %s |' "$@"; echo; } >&3; }
six() { awk "$page_numbers $formulas BEGIN { print six($1) }"; }
few() { awk "$page_numbers $formulas BEGIN { print few($1) }"; }

# theory EXPRESSION: its value, all digits
theory() { awk "$page_numbers $formulas BEGIN { printf \"%.17g\", $1 }"; }

# note NAME VALUE: what {{NAME}} in the text of any chapter becomes; {{3.1}} is the largest difference of case 3.1
note() { echo "$1 $2" >> "$work/notes"; }
