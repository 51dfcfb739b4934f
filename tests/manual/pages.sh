#!/usr/bin/env bash
# Checks README.md and the pages of input against the program: decks, examples of cards, exercises, messages, commands and numbers.
#
#    pages.sh PROGRAM QUERY WORK_FOLDER
set -u
query=$2 work=$3 guide=input/README.md cards=input/cards.md course=input/course.md
program=$(realpath "$1")
. tests/exact/lib.sh
. tests/exact/decks.sh
rm -rf "$work"
mkdir -p "$work"

# block PAGE HEADING N: the Nth block between ``` below a heading
block() {
   awk -v heading="$2" -v wanted="$3" '/^#+ / && !inside { on = substr($0, index($0, " ") + 1) == heading; n = 0 }
      /^```/ { inside = !inside; if (inside) n++; next } on && inside && n == wanted' "$1"
}
# thousandths NAME STAGE INCREMENT NODE COLUMN: with five decimals
thousandths() { awk -v x="$(cell "$@")" 'BEGIN { printf "%.5fE-3", 1000*x }'; }
# shown WORDS PAGE TEXT: the page has the text
shown() { if grep -qF -- "$3" "$2"; then passed=$((passed + 1)); else fail "$1: '$3' does not stand in $2"; fi; }

# README.md: the deck of the worked example, its two numbers by six runs
same 'README: the deck of the worked example' "$(block README.md 'The worked example' 1)" "$(grep -v '^\$' input/prism05.bdf )"
deflections='' pressures=''
for name in prism03 prism05 prism10 prism15 prism_back prism_newton prism05.NEWTON.40; do
   if [ $name = prism05.NEWTON.40 ]; then variant prism05 NEWTON 40; else run_input $name; fi
   last=$(awk -F, 'END { print $2 }' "$work/$name.joint.csv")
   deflections+=" $(awk -v x="$(cell $name 1 "$last" 51 lambda)" 'BEGIN { printf "%.5f", 1000*x }') |"
   pressures+=" $(awk -v x="$(cell $name 1 "$last" 51 pressure)" 'BEGIN { printf "%.6f", x }') |"
done
shown 'README: deflections of node 51' README.md "| deflection of node 51 [1E-3 mm] |$deflections"
shown 'README: pressures of node 51' README.md "| pressure at node 51 [kgf/mm2] |$pressures"

# README.md: what a run costs is in the table of the benchmark
costs=$(awk -F'|' 'FNR == NR { if ($0 ~ /^\| (Q4|hex8) .*\|/ && NF == 14) { gsub(/ /, ""); all[$3] = $12; most[$3] = $13 } next }
   /^\| model \| unknowns \| seconds/ { on = 1; next }
   on && /^\| [a-z]/ { n++; gsub(/[ ,]/, ""); if ($4 != all[$3] || $5 != most[$3]) print $2 ": " $4 " s, " $5 " MiB, in the benchmark " all[$3] " s, " most[$3] " MiB" }
   on && !/^\|/ { on = 0 }
   END { if (n != 4) print n + 0 " rows" }' tests/bench/README.md README.md)
same 'README: what a run costs' "$costs" ''

# options and targets that README.md names
"$program" --help > "$work/help.txt"
for option in $(awk '/^## Commands/ { on = 1; next } /^## / { on = 0 } on && /^    /' README.md | grep -oE -- '(^| )--?[a-z]+' | sort -u); do
   says "README: option $option" "$work/help.txt" "^   $option"
done
for target in $(grep -ohE '`make [a-z-]+' README.md input/*.md tests/README.md | awk '{ print $2 }' | sort -u); do
   if cat Makefile tests/*/*.mk | grep -qE "^$target:"; then passed=$((passed + 1)); else fail "make $target: no such target"; fi
done

# the first deck: it runs, and its increments are those of the table and the list
block $guide 'A first deck' 1 > "$work/block.bdf"
"$program" --check "$work/block.bdf" > "$work/check.log" 2>&1 || fail 'the first deck: --check'
run block
for k in 1 2 3 4 5; do shown "the first deck, increment $k" $guide "| $(thousandths block 1 $k 1 lambda) |"; done
sed 's/^SPC = 1/METHOD = NEWTON\nSPC = 1/' "$work/block.bdf" > "$work/newton.bdf"
run newton
shown 'the first deck by NEWTON' $guide "$(thousandths newton 1 5 1 lambda)"

# the message of an error
sed 's/^PSHELL .*/PSHELL  1       1       2O.0/' "$work/block.bdf" > "$work/wrong.bdf"
(cd "$work" && mkdir -p wrong && mv wrong.bdf wrong/block.bdf && cd wrong && "$program" block.bdf > /dev/null 2> ../wrong.log)
same 'the message of an error' "$(head -n 4 "$work/wrong.log")" "$(block $cards 'What is an error' 1 | head -n 4)"

# the exercises of the course and their answers
block $course 'A course of five lessons' 1 > "$work/course.sh"
grep -v '^bin/jointfem' "$work/course.sh" | sed "s#> input/#> $work/#" > "$work/make_lessons.sh"
bash "$work/make_lessons.sh"
cp -R input/vibration "$work"
for lesson in 1a 1b 2a 2b 2c 3 4 5; do "$program" -q -o "$work" "$work/lesson$lesson.bdf" > "$work/lesson$lesson.log" 2>&1 || fail "lesson $lesson does not run"; done
# largest LESSON STAGE: the largest displacement, as the listing has it
largest() { awk '/LARGEST DISPLACEMENT +[0-9]/ { print $3 }' "$work/lesson$1.out" | sed -n "$2p"; }
answer() { if grep -E "^\| $1 \|" $course | grep -qF -- "$2"; then passed=$((passed + 1)); else fail "the answer of exercise $1: '$2'"; fi; }
for stage in 1 2; do answer '1 \(a\)' "$(largest 1a $stage) mm"; answer '1 \(b\)' "$(largest 1b $stage) mm"; done
errors=
for run in 2a:20 2b:80 2c:320; do
   lambda=$(cell "lesson${run%:*}" 1 "${run#*:}" 51 lambda)
   answer 2 "$(awk -v x="$lambda" 'BEGIN { printf "%.4E", x }')"
   errors="$errors${errors:+, }$(awk -v x="$lambda" -v e="$(cell prism05.NEWTON.40 1 40 51 lambda)" 'BEGIN { printf "%.1f %%", 100*(x/e - 1) }')"
done
answer 2 "errors $errors"
answer 3 "$(largest 3 2)"
answer 3 "$(value lesson3 rows 'stage = 2 and increment = 10' print 'sum(slip)') node"
# field of the answer of the last stage: behind the joint or bolt number
answer 4 "contact $(awk '/JOINT CONTACT %/ { n = NR + 2 } NR == n { v = $2 } END { print v }' "$work/lesson4.out") %"
answer 4 "$(awk '/BOLT +ELEMENT +SURFACE/ { n = NR + 2 } NR == n { v = $6 } END { print v }' "$work/lesson4.out") of the load"
answer 5 "$(awk -v x="$(mode lesson5 1 frequency 2)" 'BEGIN { printf "%.1f", x }') Hz"

# every example of a card is read without an error but references to what the example does not show
awk -v folder="$work" '/^### / { section = $2; sub(/,$/, "", section) }
   /^```/ { inside = !inside; first = inside; if (!inside && file != "") { print "ENDDATA" > file; close(file); file = "" } next }
   first { first = 0; if (/^\$--1---/) { file = sprintf("%s/example_%d_%s.bdf", folder, ++n, section); print "BEGIN BULK" > file } }
   file != "" { print > file }' $cards
for deck in "$work"/example_*.bdf; do
   name=${deck##*/example_} name=${name%.bdf}
   "$program" --check "$deck" > "$deck.log" 2>&1
   wrong=$(awk '/^DECK ERROR/ { n = NR + 4 } /^DECK ERROR/ && /[0-9]$/ { head = $0 } /(field|:)/ && /^   [A-Z0-9]+(, |:)/' "$deck.log" |
      grep -vE 'there is no |no body has a mass|has no edge|no body element has|no element from ')
   if [ -z "$wrong" ] && [ -s "$deck.log" ]; then passed=$((passed + 1)); else echo "$wrong"; fail "the example of ${name#*_}"; fi
done

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
