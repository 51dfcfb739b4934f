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
# numbers with twelve digits behind the point, the further ones are rounding
twelve() { sed -E 's/([0-9]\.[0-9]{12})[0-9]+E/\1E/g'; }
# shown WORDS PAGE TEXT: the page has the text
shown() { if grep -qF -- "$3" "$2"; then passed=$((passed + 1)); else fail "$1: '$3' does not stand in $2"; fi; }

# README.md: the chart is the banners of the main program; the deck and its listing; two numbers by seven runs
same 'README: the chart' "$(block README.md jointfem 1 | sed -E 's/ *(<-+|-+)?[-+| ]*$//; s/^ *//')" \
   "$(sed -nE 's/^ *! -{20,} //p' src/jointfem.f90 | grep -vE 'NOT IN THE CHART|ITERATE TO EQ|SECANTS UNTIL')"
same 'README: the deck of the worked example' "$(block README.md jointfem 2)" "$(grep -v '^\$' input/prism05.bdf )"
command=$(block README.md jointfem 3 | sed -n '1s/^\$ //p')
same 'README: the listing' "$(block README.md jointfem 3 | tail -n +2)" \
   "$(bash -c "${command/mine/reference_output}" | sed 's/ *$//')"
grep -oE '\[[0-9]+ lines\]\([a-z0-9_/.]+\)' README.md | tr '[]()' '    ' | while read -r n _ file; do echo "$n $(wc -l < "$file") $file"; done > "$work/lines"
same 'README: lines of a file' "$(awk '$1 != $2' "$work/lines")$(wc -l < "$work/lines")" 1
deflections='' pressures=''
for name in prism03 prism05 prism10 prism15 prism_back prism_newton prism05.NEWTON.40; do
   if [ $name = prism05.NEWTON.40 ]; then variant prism05 NEWTON 40; else run_input $name; fi
   last=$(awk -F, 'END { print $2 }' "$work/$name.joint.csv")
   deflections+=" $(awk -v x="$(cell $name 1 "$last" 51 lambda)" 'BEGIN { printf "%.5f", 1000*x }') |"
   pressures+=" $(awk -v x="$(cell $name 1 "$last" 51 pressure)" 'BEGIN { printf "%.6f", x }') |"
done
shown 'README: deflections of node 51' README.md "| deflection of node 51 [1E-3 mm] |$deflections"
shown 'README: pressures of node 51' README.md "| pressure at node 51 [kgf/mm2] |$pressures"

# README.md: the commands of Batch
block README.md Batch 1 | sed "s#mine#$work/mine#g; s#^bin/jointfem#$program#" > "$work/batch.sh"
same 'README: a batch' "$(bash -e "$work/batch.sh" 2> /dev/null | grep 'differ$'; ls "$work"/mine/*.out | wc -l; wc -l < "$work/mine/all.csv")" \
   "$(printf '%d\n%d' "$(ls input/prism*.bdf | wc -l)" $(($(ls input/prism*.bdf | wc -l) + 1)))"

# the page on rounding: its commands find nothing, and the difference that another Poisson's ratio makes
compare=$(dirname "$query")/compare_results differs=reference_output/differs.md
block $differs 'Which row differs' 1 | sed "s#mine#$work/rounding#; s#^bin/jointfem#$program#; s#build/compare/compare_results#$compare#
   s#build/compare/query_results#$query#" > "$work/rounding.sh"
same 'a number differs: none' "$(bash "$work/rounding.sh" 2> /dev/null | awk '/^[0-9.E+-]+$/ { print ($1 < 1e-9) } /^[<>]/'; echo "${PIPESTATUS[0]}")" '1
0'
mkdir "$work/nu"
sed 's/0\.25$/0.26/' input/prism05.bdf > "$work/nu/prism05.bdf"
sed "s#input/prism05.bdf#$work/nu/prism05.bdf#" "$work/rounding.sh" | bash > "$work/nu/log" 2> /dev/null
sed "s#$work/rounding#mine#" "$work/nu/log" > "$work/nu/said"
shown 'a number differs: the first difference' <(twelve < "$work/nu/said") "$(block $differs 'Which row differs' 2 | twelve)"
says 'a number differs: how many' "$work/nu/said" 'differences from reference_output/prism05.joint.csv: 253, shown: 20$'
shown 'a number differs: how far' $differs "$(awk 'NF == 1 && /E-/ { printf "prints %.1E", $1 }' "$work/nu/said")"

# options and targets that README.md names
"$program" --help > "$work/help.txt"
options=$(sed -nE 's/^\| `(--?[a-z]+)[ `].*/\1/p' README.md | sort -u)
same 'README: the options of --help' "$options" "$(sed -nE 's/^   (--?[a-z]+) .*/\1/p' "$work/help.txt" | sort -u)"
for target in $(grep -ohE '`make [a-z-]+' README.md input/*.md tests/README.md | awk '{ print $2 }' | sort -u); do
   if cat Makefile tests/*/*.mk | grep -qE "^$target:"; then passed=$((passed + 1)); else fail "make $target: no such target"; fi
done

# the pages of man, made from --help
for name in jointfem jointfit; do
   same "man $name" "$("${program%jointfem}$name" --help | awk -v name=$name -v version=1 -v about=it -f src/run/man_page.awk |
      awk '/^\.nf/ { n++ } /^\.fi/ { n-- } /^\.SH/ { sub(/^.SH /, ""); printf "%s %d, ", $0, n } END { print n }')" \
      'NAME 0, SYNOPSIS 0, EXAMPLES 0, DESCRIPTION 0, EXIT STATUS 0, SEE ALSO 0, 0'
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

# the exercises of the course and their answers; that of lesson 6 is in tests/source/tour.sh
awk '/^```/ { on = $0 == "```sh"; next } on && !/git apply/' $course | sed "s#lessons#$work/lessons#g; s#^bin/jointfem#$program#" > "$work/course.sh"
bash -e "$work/course.sh" > "$work/course.log" 2>&1 || fail 'a lesson does not run'
cp "$work"/lessons/lesson* "$work"
# largest LESSON STAGE: the largest displacement, as the listing has it
largest() { awk '/LARGEST DISPLACEMENT +[0-9]/ { print $3 }' "$work/lesson$1.out" | sed -n "$2p"; }
answer() { if grep -E "^\| $1 \|" $course | grep -qF -- "$2"; then passed=$((passed + 1)); else fail "the answer of exercise $1: '$2'"; fi; }
for stage in 1 2; do answer '1 \(a\)' "$(largest 1a $stage) mm"; answer '1 \(b\)' "$(largest 1b $stage) mm"; done
errors= lambdas=
for lesson in 2d 2a 2b 2c; do # LAMBDA of the row of NODE 1 = 51
   lambda=$(table lesson$lesson 'INTERFACE ELEMENTS OF JOINT 1' | awk '$2 == 51 { v = $8 } END { print v }')
   if [ $lesson = 2d ]; then limit=$lambda; continue; fi
   lambdas="$lambdas${lambdas:+, }$lambda"
   errors="$errors${errors:+, }$(awk -v x="$lambda" -v e="$limit" 'BEGIN { printf "%.1f %%", 100*(x/e - 1) }')"
done
answer '2 \(a\)' "$lambdas mm; by NEWTON $limit mm"
answer '2 \(a\)' "errors $errors"
for name in 'e one increment' 'f without INCR'; do # node 6; contact; error of path
   answer '2 \(b\)' "${name#* }: $(table "lesson2${name%% *}" 'INTERFACE ELEMENTS OF JOINT 1' | awk '$2 == 6 { print $8 " mm, " $7 }'); $(
      awk '/JOINT CONTACT %/ { n = NR + 2 } NR == n { v = $2 } END { print v }' "$work/lesson2${name%% *}.out") %; $(
      awk '/INCR +PARTS/ { n = NR + 1 } NR == n { v = $NF } END { print v }' "$work/lesson2${name%% *}.out") %"
done
answer '3 \(a\)' "LARGEST DISPLACEMENT $(largest 3 2) mm"
answer '3 \(a\)' "SLIPPING $(value lesson3 rows 'stage = 2 and increment = 10' print 'sum(slip)') node"
for origin in 'BRANCH 3b' 'CURVE 3c'; do
   halves=$(awk -F, -v w=: 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } $c["element"] == 1 { t[$1, $2] = $c["tau_x"] }
      END { for (k in t) if (split(k, s, SUBSEP) && s[1] == 2) top = t[k] > top ? t[k] : top
            printf "falls by %.2f and %.2f, rises by %.2f and %.2f", top - t[3, 1], t[3, 1] - t[3, 2], t[4, 1] - t[3, 2], t[4, 2] - t[4, 1] }' \
      "$work/lesson${origin#* }.joint.csv")
   answer '3 \(b\)' "${origin% *}: tau $halves"
   answer '3 \(b\)' "${origin% *} $(awk '/ENERGY OF JOINTS, STAGE [34]/ { on = 1 } /ANSWER/ { on = 0 } on && $1 == 1 { kept += $NF }
      END { printf "%.5f", kept }' "$work/lesson${origin#* }.out")"
done
# field of the answer of the last stage: behind the joint or bolt number
answer 4 "CONTACT $(awk '/JOINT CONTACT %/ { n = NR + 2 } NR == n { v = $2 } END { print v }' "$work/lesson4.out") %"
answer 4 "CHANGE/LOAD $(awk '/BOLT +ELEMENT +SURFACE/ { n = NR + 2 } NR == n { v = $6 } END { print v }' "$work/lesson4.out") of the load"
answer 5 "$(awk -v x="$(mode lesson5 1 frequency 2)" 'BEGIN { printf "%.1f", x }') Hz"
answer 7 "CONTACT $(awk '/JOINT CONTACT %/ { n = NR + 2 } NR == n { v = $2 } END { print v }' "$work/lesson7.out") %"
answer 7 "P MAX $(awk '/JOINT CONTACT %/ { n = NR + 2 } NR == n { v = $3 } END { print v }' "$work/lesson7.out") N/mm2"
# pressures FOLDER NAME: of the first seven elements
pressures() { awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } NR < 9 { printf "%s%.1f", (NR > 2 ? ", " : ""), $c["pressure"] }' "$1/$2.joint.csv"; }
course_text=$(tr -s ' \n' ' ' < $course)
course() { case $course_text in *"$2"*) passed=$((passed + 1)) ;; *) fail "$1: '$2' does not stand in $course" ;; esac; }
course 'lesson 7' "the pressure goes $(pressures "$work" lesson7) from point to point, in \`hub.joint.csv\` $(pressures reference_output hub) from"
course 'lesson 5' "$(awk '/OF ST %/ { n = NR + 2 } NR == n { printf "%.0f", $6; exit }' "$work/lesson5.out") % of their proof stress"
# as soft as the bodies: no pressure between two others exceeds both, or falls below both, by a tenth of the largest
for name in hub lesson7; do
   deck=input/hub.bdf; [ $name = hub ] || deck=$work/lessons/lesson7.bdf
   sed 's/^JNORM,.*/JNORM,1,1.0-3,1.0,1.0+6/' "$deck" > "$work/soft_$name.bdf"
   run "soft_$name"
   same "lesson 7: $name, as soft as the bodies" "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) c[$i] = i; next } { p[++n] = $c["pressure"]; if (p[n] > most) most = p[n] }
      END { for (i = 2; i < n; i++) if ((p[i] - p[i-1])*(p[i] - p[i+1]) > (most/10)^2) print i }' "$work/soft_$name.joint.csv")" ''
done
# what the references of the decks say: without the change
reference() { awk -v title="$2" -v c="$3" '$0 ~ title { n = NR + 2 } NR == n { v = $c } END { print v }' "reference_output/$1.out"; }
largest_there() { awk '/LARGEST DISPLACEMENT +[0-9]/ { print $3 }' "reference_output/$1.out" | sed -n "$2p"; }
answer '1 \(a\)' "half of $(largest_there one_element 1); after"
answer '1 \(a\)' "more than half of $(largest_there one_element 2) "
answer '3 \(a\)' "instead of $(reference friction_full 'JOINT CONTACT %' 6);"
answer '3 \(a\)' "mm instead of $(largest_there friction_full 2) "
answer 4 "instead of $(reference flange_pair 'JOINT CONTACT %' 2) %;"
answer 7 "instead of $(reference hub 'JOINT CONTACT %' 2) %;"
answer 7 "instead of $(reference hub 'JOINT CONTACT %' 3) |"
answer 4 "instead of $(reference flange_pair 'BOLT +ELEMENT +SURFACE' 6) "
for preload in 02 08 32; do answer 5 "$(awk -F, '$1 == 2 && $2 == 1 { printf "%.1f", $3 }' reference_output/column_modes_$preload.modes.csv)"; done
for stress in lesson4:500 lesson5:408; do # of bolt 1 when it is tightened
   shown "the course: bolts of ${stress%:*}" $course "(${stress#*:} N/mm2 in its bolts)"
   same "the course: bolts of ${stress%:*}" "$(awk '/BOLT +TIGHTENED/ { n = NR + 2 } NR == n { printf "%.0f", $5; exit }' "$work/${stress%:*}.out")" "${stress#*:}"
done

holds 'README.md: its lines' "$(wc -l < README.md) <= 170"

# numbers of the guide and of the card manual
. tests/manual/pages_numbers.sh

# what --help CARD prints has no marks of the page
same '--help CARD: marks' "$(awk -f src/run/card_manual.awk $cards | grep -E '^      call add' | grep -nE '\]\(|`|\*\*[a-zA-Z]')" ''

# so has the list of the entries
same '--help NOCARD: columns' "$("$program" --help NOCARD 2>&1 | awk 'length > 100 || / ,/' )" ''

# every example of a card is read without an error but references to what the example does not show
awk -v folder="$work" '/^### / { section = $2; sub(/,$/, "", section) }
   /^```/ { inside = !inside; first = inside; if (!inside && file != "") { print "ENDDATA" > file; close(file); file = "" } next }
   first { first = 0; if (/^\$--1---/) { file = sprintf("%s/example_%d_%s.bdf", folder, ++n, section); print "BEGIN BULK" > file } }
   file != "" { print > file }' $cards
for deck in "$work"/example_*.bdf; do
   name=${deck##*/example_} name=${name%.bdf}
   "$program" --check "$deck" > "$deck.log" 2>&1
   wrong=$(awk '/^DECK ERROR/ { n = NR + 4 } /^DECK ERROR/ && /[0-9]$/ { head = $0 } /(field|:)/ && /^   [A-Z0-9]+(, |:)/' "$deck.log" |
      grep -vE 'there is no |no body has a mass|has no edge|no body element has|no element from |belongs to no element|nothing expands')
   if [ -z "$wrong" ] && [ -s "$deck.log" ]; then passed=$((passed + 1)); else echo "$wrong"; fail "the example of ${name#*_}"; fi
done

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
