# Wrong commands, a part of run.sh, which has the functions. Every section works in the folder "$work/command", with the decks
# good.bdf and other.bdf (the same), faulty.bdf (a letter O in line 7) and free.bdf (nothing holds it in x).

# ---- the command line ----

mkdir "$work/command"
cd "$work/command" || exit 2
# a plate on a rigid base, pressed down in 20 increments
sed '/^TITLE/d; s/^JINCR.*/JINCR   5       20      ARITH   0.02/' "$here/base/plate.bdf" > good.bdf
sed 's/^GRID    1  /GRID    1O /' good.bdf > faulty.bdf
sed 's/^SPC1/$&/; s/^SPC = 1/LABEL = FREE/' good.bdf > free.bdf
cp good.bdf other.bdf
mkdir results

run;                                  check 'no deck' 1 'no deck given'
run -q;                               check 'options, no deck' 1 'no deck given'
run --quick good.bdf;                 check 'unknown option' 1 '--quick'
run -x good.bdf;                      check 'unknown short option' 1 '-x'
for n in 0 -1 x 1.5 '' 99999999999; do
   run --threads "$n" good.bdf;       check "--threads '$n'" 1 '--threads' 'expected a number of 1 or more'
done
run good.bdf --threads;               check '--threads without value' 1 '--threads needs a value'
for s in '' T =3 T= 'T=1,,2' 'T T=1' T=,1; do
   run --set "$s" good.bdf;            check "--set '$s'" 1 "--set $s: expected NAME=VALUE"
done
run --set T=1 --set T=2 good.bdf;     check '--set twice' 1 'given twice'
for s in 'T=${T}' 'T=1,${Q}' 'T=20$' $'T=1\t2' $'T=1\n2'; do
   LIMIT=20 run --set "$s" good.bdf;   check "--set '$s'" 1 'a value is a number or a word'
done
run --set A=1,2:B=3 good.bdf;         check '--set in pairs without a partner' 1 '--set A=1,2:B=3: B: 1 value, expected 2'
run --set A=1:A=2 good.bdf;           check '--set in pairs, a name twice' 1 '--set A: given twice'
# a CSV file of rows: content, message
while IFS='|' read -r content message; do
   printf '%b' "$content" > rows.csv
   run --set rows.csv good.bdf;       check "--set rows.csv with $content" 1 "rows.csv, $message"
done <<'ROWS'
|expected a line of names, then lines with their values
A,B\n|expected a line of names, then lines with their values
A,B C\n1,2\n|line 1, column 2: "B C": a name has letters, digits and underscores
A,\n1,2\n|line 1, column 2: "": a name has letters, digits and underscores
A,B\n1,2\n\n3\n|line 4: 1 value, expected 2
A,B\n1,2\n3,4,5\n|line 3: 3 values, expected 2
A,B\r\n1, \r\n|line 2, column 2: "": a value is a number or a word
A,B\n1,2\n3,${C}\n|line 3, column 2: "${C}": a value is a number or a word
A;B\n1;2\n|line 1, column 1: "A;B": a name has letters, digits and underscores
ROWS
printf 'A,A\n1,2\n' > rows.csv
run --set rows.csv good.bdf;          check '--set rows.csv with a name twice' 1 '--set A: given twice'
printf 'A,B\n1,2\n' > rows.csv
run --set B=2 --set rows.csv good.bdf; check '--set of a name of rows.csv' 1 '--set B: given twice'
run --set T=1,2 -;                    check '--set with several runs of the standard input' 1 'the standard input can be read only once'
run --set nowhere.csv good.bdf;       check '--set of a missing file' 1 '--set nowhere.csv: expected NAME=VALUE'
printf 'T\n1\n1\n' > rows.csv
run --set rows.csv -o results good.bdf; check '--set rows.csv with equal rows' 1 'would both write results/good_T=1.out'
rm rows.csv
for s in 1- -1 1-2-3 1-1 0-1; do
   run --watch "2,$s" --check good.bdf; check "--watch '$s'" 2 "--watch 2,$s: expected node numbers, or N-M"
done
run --watch 1-9999 --check good.bdf;  check '--watch with a pair of a missing node' 2 'WATCH: node 9999 is not a node of an element'
for s in '' x 1,b '3 4'; do
   run --watch "$s" good.bdf;          check "--watch '$s'" 1 "--watch $s: expected node numbers"
done
run --summary nowhere/s.csv -o results good.bdf; check '--summary that cannot be written' 4 'nowhere/s.csv cannot be written'
rm -f results/*
run good.bdf -o;                      check '-o without value' 1 '-o needs a value'
run -o results nowhere.bdf;           check 'missing file' 1 'nowhere.bdf: no such file'
run -o results '';                    check 'empty name' 1
run -o results results;               check 'a directory as deck' 1 'results' 'a directory'
if [ "$(id -u)" -ne 0 ]; then
   cp good.bdf locked.bdf; chmod 000 locked.bdf
   run -o results locked.bdf;         check 'a deck that may not be read' 1 'locked.bdf: cannot be read'
   rm -f locked.bdf
fi
holds results 'no file after wrong commands'
holds . 'none here either' faulty.bdf free.bdf good.bdf other.bdf results

for option in --help -h; do
   run "$option"; check "$option" 0
   if [ -s "$work/stderr" ]; then fail "$option: text on the standard error"; else prints "$option" '^usage: jointfem'; fi
   if [[ $(sed -n 4p "$work/stdout") = '   jointfem beam.bdf '* ]]; then pass; else fail "$option: no example first"; fi
done
run --help CROD; check '--help of a card' 0
prints '--help of a card: its entry' '^CROD  *EID '
if [ "$(tail -n 1 "$work/stdout" | awk '{ print $NF }')" = "$(awk '/^### CROD$/ { on = 1; next } /^### / { on = 0 } on && NF { last = $NF } END { print last }' "$here/../../input/cards.md")" ]; then pass
else fail '--help of a card: not its last word at the end'
fi
run --help output; check '--help of a key' 0
if grep -qE '[`|]|\]\(|\*[A-Za-z]' "$work/stdout"; then fail '--help of a key: it has marks of Markdown'; else pass; fi
prints '--help of a key: its entry' '^OUTPUT selects the tables of the listing'
run --help SPC; prints '--help of a name that key and card have: both' '^The number of a set of SPC'
prints '--help of a name that key and card have: both' '^SPC  *SID '
run --help NOCARD; check '--help of no card' 1 "the manual has no entry 'NOCARD'" 'CROD'
run --version; check '--version' 0
prints '--version' '^jointfem [0-9][0-9]*\.[0-9]'

run --check -o results good.bdf;      check '--check of a good deck' 0
prints '--check' '^good.bdf: no errors'
run --check -o results faulty.bdf;    check '--check of a faulty deck' 2 'DECK ERROR 1 OF' 'faulty.bdf, line 7'
run --check -o results faulty.bdf good.bdf; check '--check of two decks' 2 'faulty.bdf, line 7'
prints '--check, the second deck' '^good.bdf: no errors'
holds results '--check writes nothing'

# ---- what the terminal shows, the date ----

for option in '' -q; do
   run $option -o results good.bdf;   check "the answer ${option:+with $option}" 0
   if [ -s "$work/stderr" ] && ! grep -q 'STEP is up to\|warning' "$work/stderr"; then fail 'the answer: other words on the standard error'; fi
   prints 'the answer' '^ ANSWER AT THE END OF STAGE 1'
   if [ "$(tail -n 1 "$work/stdout")" = ' RESULTS: results/good.out (listing), results/good.joint.csv, .stage.csv, .reaction.csv' ]; then pass
   else fail 'the answer: the last line names the files'; fi
done
if cmp -s <(grep -A 99 '^ ANSWER' "$work/stdout" | grep -v RESULTS) <(grep -A 99 '^ ANSWER' results/good.out | grep -v 'END OF LISTING'); then pass
else fail 'the answer in the listing is that on the screen'; fi
grep -q '^  DECK good.bdf   JOINTFEM [0-9.]*$' results/good.out && pass || fail 'the head of the listing: deck and version, no date'
run --date -o results good.bdf
grep -q '^  DECK good.bdf   JOINTFEM [0-9.]*   20[0-9-]* [0-9][0-9]:[0-9][0-9]$' results/good.out && pass || fail '--date'
fresh results

# ---- two decks, one name; results over a deck ----

mkdir one two
cp good.bdf one/beam.bdf; cp good.bdf two/beam.bdf; cp good.bdf one/beam.dat
run -o results one/beam.bdf two/beam.bdf; check 'two decks of one name' 1 'one/beam.bdf' 'two/beam.bdf'
run -o results one/beam.bdf one/beam.dat; check 'two decks that differ in the extension' 1 'one/beam.dat'
run -o results good.bdf good.bdf;     check 'the same deck twice' 1 'good.bdf'
cp good.bdf one/beam.1.bdf; cp good.bdf two/beam.12.joint.bdf; cp good.bdf one/beam.joint.bdf; cp good.bdf one/beam.1a.bdf
run -o results one/beam.bdf one/beam.1.bdf
check 'a deck named as a stage of another' 1 'one/beam.bdf and one/beam.1.bdf could both write results/beam.1.vtu'
run -o results two/beam.12.joint.bdf good.bdf one/beam.bdf
check 'a deck named as the joint of a stage' 1 'both write results/beam.12.joint.vtu'
run -o results one/beam.bdf one/beam.joint.bdf; check 'a deck named as the joint of another' 1 'both write results/beam.joint.vtu'
holds results 'no file after decks of one name'
run -o results one/beam.bdf one/beam.1a.bdf good.bdf; check 'decks named nearly as a stage' 0
fresh results

# untouched FILE WHAT TEXT ARGUMENTS: a command in the folder over whose results would go over FILE is refused with TEXT, and
# FILE stays as it is
untouched() {
   local file=$1 what=$2 text=$3
   shift 3
   cp "over/$file" over.copy
   cd over || exit 2
   run "$@"
   cd ..
   if ! cmp -s over.copy "over/$file"; then fail "$what: the file is destroyed (exit status $status)"
   else check "$what" 1 "$text"
   fi
}

# refused FILE WHAT TEXT ARGUMENTS: untouched, with the decks good.bdf and other.bdf in the folder over
refused() {
   local file=$1
   fresh over
   cp good.bdf other.bdf over
   mkdir over/sub
   case $file in
      *.inc) sed '/^GRID/!d' good.bdf > "over/$file"; sed -i "s/^GRID    1 .*/INCLUDE '$file'/; /^GRID/d" over/good.bdf;;
      notes) echo 'what was measured' > over/notes;;
      *.csv) echo 'stage,increment,load' > "over/$file";;
      *) cp -n good.bdf "over/$file";;
   esac
   untouched "$@"
   if [ "$(ls over | grep -c '\.out$')" -ne 0 ]; then fail "$2: a deck ran"; else pass; fi
}
refused first.bdf '--summary *.bdf' 'first.bdf: the file exists and is no summary' --summary first.bdf good.bdf other.bdf
refused good.bdf '--summary of a deck of the run' 'would overwrite the deck good.bdf' --summary ./good.bdf good.bdf other.bdf
refused good.inc '--summary of an INCLUDE file' 'is no summary' --summary good.inc good.bdf
refused notes '--summary of notes' 'is no summary' --summary notes good.bdf
refused old.joint.csv '--summary of a history' 'is no summary' --summary old.joint.csv good.bdf
for name in good.out good.joint.csv good.stage.csv sub/../good.restart good.vtu; do
   refused other.bdf "--summary $name beside good.bdf" 'would overwrite the deck good.bdf or a file of its results' --summary $name good.bdf
done
fresh results
run --summary results/runs.csv -o results good.bdf; check '--summary' 0
run --summary results/runs.csv -o results good.bdf other.bdf; check '--summary over an earlier summary' 0
if [ "$(wc -l < results/runs.csv)" -eq 3 ]; then pass; else fail '--summary over an earlier summary: not three lines'; fi
: > results/empty
run --summary results/empty -o results good.bdf; check '--summary over an empty file' 0

# unharmed WHAT DECK ARGUMENTS: the same for DECK, a copy of good.bdf or $from, beside good.bdf; link leads to where they stand
unharmed() {
   local what=$1 deck=$2
   shift 2
   fresh over
   cp good.bdf over/good.bdf
   cp "${from:-good.bdf}" "over/$deck"
   ln -s . over/link
   untouched "$deck" "$what" '' "$@"
}
unharmed 'a deck beam.out' beam.out beam.out
unharmed 'a deck ./beam.out' beam.out ./beam.out
unharmed '-o . beam.out' beam.out -o . beam.out
unharmed 'a deck link/beam.out' beam.out link/beam.out
unharmed '-o link beam.out' beam.out -o link beam.out
unharmed 'a deck good.out beside good.bdf' good.out good.bdf ./good.out
unharmed 'a deck beam.vtu' beam.vtu beam.vtu
unharmed 'a deck good.2.joint.vtu beside good.bdf' good.2.joint.vtu good.bdf good.2.joint.vtu
unharmed 'a deck beam.pvd' beam.pvd -o link ./beam.pvd
from=faulty.bdf unharmed 'a faulty deck ./beam.out' beam.out ./beam.out
for included in mesh.1.vtu mesh.out; do
   fresh over
   grep GRID good.bdf > over/$included
   sed "s/^GRID    1 .*/INCLUDE '$included'/; /^GRID/d" good.bdf > over/mesh.bdf
   untouched $included "an INCLUDE file $included" "would overwrite the INCLUDE file $included" mesh.bdf
done

# ---- what an earlier run left ----

for bad in faulty free; do
   fresh results
   cp good.bdf beam.bdf
   run -o results beam.bdf;           check 'a good deck' 0
   holds results 'results of a good deck' beam.joint.csv beam.out beam.reaction.csv beam.stage.csv
   cp $bad.bdf beam.bdf
   run --check -o results beam.bdf
   holds results "--check of a $bad deck removes nothing" beam.joint.csv beam.out beam.reaction.csv beam.stage.csv
   run -o results beam.bdf
   if [ "$status" -eq 2 ] || [ "$status" -eq 3 ]; then pass; else fail "$bad.bdf: exit status $status"; fi
   holds results "$bad.bdf: the results of an earlier run are removed"
done
rm -f beam.bdf

# ---- several decks: all run, the highest status counts ----

fresh results
run -o results nowhere.bdf good.bdf;  check 'a missing deck and a good one' 1 'nowhere.bdf'
holds results 'the good deck ran' good.joint.csv good.out good.reaction.csv good.stage.csv
fresh results
run -o results free.bdf faulty.bdf nowhere.bdf good.bdf other.bdf
check 'five decks' 3 'free.bdf' 'mechanism' 'faulty.bdf, line 7' 'nowhere.bdf: no such file'
holds results 'the good ones of five ran' good.joint.csv good.out good.reaction.csv good.stage.csv other.joint.csv other.out other.reaction.csv other.stage.csv
fresh results
run -o results good.bdf faulty.bdf;   check 'a good deck and a faulty one' 2
cp good.bdf ./-beam.bdf
run -o results -- -beam.bdf;          check 'a deck behind --' 0
holds results 'results of a deck behind --' -beam.joint.csv -beam.out -beam.reaction.csv -beam.stage.csv good.joint.csv good.out good.reaction.csv good.stage.csv
rm -f ./-beam.bdf

# ---- standard input and output ----

fresh results
fresh here
cd here || exit 2
run - < ../good.bdf;                  check 'a deck from the standard input' 0
cp "$work/stdout" ../listing
run - < ../faulty.bdf;                check 'a faulty deck from the standard input' 2 'DECK ERROR 1 OF' 'line 7'
run - < ../free.bdf;                  check 'a mechanism from the standard input' 3 'mechanism'
if [ -s "$work/stdout" ]; then fail 'a mechanism from the standard input: a listing all the same'; else pass; fi
run - < /dev/null;                    check 'an empty standard input' 2 'empty'
run - <&-;                            check 'a closed standard input' 1
cd ..
holds here 'a deck from the standard input writes no files'
run -o results good.bdf
without_deck() { grep -v '^  DECK ' "$1"; }
if [ -s listing ] && cmp -s <(without_deck listing) <(without_deck results/good.out); then pass
else fail 'the listing on the standard output is not that of the file'
fi
cp over/mesh.bdf include.bdf
cp over.copy mesh.out
run - < include.bdf;                  check 'INCLUDE in a deck from the standard input: relative to the current folder' 0
rm -f include.bdf mesh.out

# full ARGUMENTS: like run, onto a standard output that is full
full() { timeout 60 "$program" "$@" >/dev/full 2>"$work/stderr"; status=$?; }
full - < good.bdf;                    check 'a full standard output' 4 'cannot be written'
full --check good.bdf;                check 'a full standard output, --check' 4
full --help;                          check 'a full standard output, --help' 4
full --version;                       check 'a full standard output, --version' 4
fresh results
full -o results good.bdf;             check 'a full standard output, the answer' 4
holds results 'a full standard output: the files are there' good.joint.csv good.out good.reaction.csv good.stage.csv
timeout 60 "$program" - < good.bdf >&- 2>"$work/stderr"; status=$?
check 'a closed standard output' 4
timeout 60 "$program" faulty.bdf 2>/dev/full; status=$?
: > "$work/stderr"
check 'a full standard error' 2

# ---- output that cannot be written ----

fresh results
run -o nowhere/deeper good.bdf;       check 'a folder that is not there is made' 0
holds nowhere/deeper 'a folder that is not there: it has the results' good.joint.csv good.out good.reaction.csv good.stage.csv
rm -rf nowhere
run -o nowhere --check good.bdf;      check 'a folder that is not there, --check' 0
run -o nowhere faulty.bdf;            check 'a folder that is not there, a faulty deck' 2
if [ -e nowhere ]; then fail 'a folder is made without results'; else pass; fi
run -o good.bdf/deeper good.bdf;      check 'a folder in a file' 4 'good.bdf/deeper/good.out'
run -o good.bdf good.bdf;             check 'a file for a folder' 4
cmp -s good.bdf other.bdf || fail 'a file for a folder: the deck is destroyed'
mkdir results/good.out
run -o results good.bdf;              check 'a folder of the name of the listing' 4
holds results 'and no other file' good.out
fresh results
mkdir -p results/good.joint.csv/kept
run -o results good.bdf;              check 'a folder of the name of the history' 4
holds results 'and no other file again' good.joint.csv
if [ "$(id -u)" -ne 0 ]; then
   fresh results
   chmod 500 results
   run -o results good.bdf;           check 'a folder that may not be written to' 4
   holds results 'a folder that may not be written to' ''
   chmod 700 results
fi

# A full disk: a file system of SIZE in memory, where users may mount one. All or nothing, and not all in 4 kilobytes.
fresh results
run -o results good.bdf
if unshare -rm mount -t tmpfs -o size=4k none results 2>/dev/null; then
   for size in 4k 8k 12k 16k 20k 24k 64k; do
      fresh disk
      fresh kept
      status=$(unshare -rm bash -c 'mount -t tmpfs -o size="$1" none disk
         timeout 60 "$2" -o disk good.bdf >/dev/null 2>"$3"; echo $?
         cp -R disk/. kept' - "$size" "$program" "$work/stderr")
      if [ "$status" = 4 ] && [ -z "$(ls -A kept)" ] && grep -q 'cannot be written' "$work/stderr"; then pass
      elif [ "$status" = 0 ] && [ "$size" != 4k ] && diff -r results kept >/dev/null; then pass
      else fail "a disk of $size: exit status $status with $(ls -A kept | tr '\n' ' ')"
      fi
   done
   rm -rf disk kept
else
   echo 'skipped: a full disk: no user may mount a file system here'
fi

# ---- writes that the system ends with a signal ----

fresh results
(ulimit -f 4; "$program" -o results good.bdf >"$work/stdout" 2>"$work/stderr"; echo $? >"$work/status")
status=$(cat "$work/status")
if [ "$status" = 4 ]; then check 'files may not be that large' 4 'cannot be written'; holds results 'files may not be that large'
else check 'files may be that large' 0; fi
{ "$program" - <good.bdf 2>"$work/stderr"; echo $? >"$work/status"; } | true
status=$(cat "$work/status")
check 'a listing into a pipe that nobody reads' 4 'cannot be written to the standard output'

# ---- faults of a long deck: two threads read it ----

{ sed '/^ENDDATA/d' good.bdf; echo 'MAT1,900,X'; seq -f 'GRID,%.0f,,0.0,0.0' 100001 106000; echo 'GRID,200001,Y'; echo ENDDATA; } > long.bdf
"$program" --threads 1 long.bdf >"$work/stdout" 2>"$work/one_thread"
"$program" --threads 2 long.bdf >"$work/stdout" 2>"$work/stderr"; status=$?
check 'faults of a long deck, of a node' 2 'GRID, field 3'
check 'faults of a long deck, of another card' 2 'MAT1, field 3'
if cmp -s "$work/one_thread" "$work/stderr"; then pass; else fail 'faults of a long deck: two threads say what one says'; fi

# ---- INCLUDE of what is no file ----

mkfifo pipe
for path in pipe /dev/zero .; do
   sed "s#^BEGIN BULK#&\nINCLUDE '$path'#" good.bdf > included.bdf
   timeout 20 "$program" -o results included.bdf >"$work/stdout" 2>"$work/stderr"; status=$?
   check "INCLUDE of $path" 2 'not a file'
done
rm -f pipe included.bdf

# ---- lines of 100 megabytes, many files ----

# long_line WHAT TEXT: run long.bdf, which must end in 30 seconds with a message that can be read and holds TEXT
long_line() {
   timeout 30 "$program" -o results long.bdf >"$work/stdout" 2>"$work/stderr"; status=$?
   if [ "$(wc -c < "$work/stderr")" -gt 100000 ]; then
      fail "$1: exit status $status, a message of $(wc -c < "$work/stderr") bytes" 2>/dev/null
      return
   fi
   check "$1" 2 'DECK ERROR 1 OF' "$2"
}
letters() { head -c 100000000 /dev/zero | tr '\0' "$1"; }
# good.bdf with the standard input in the place of its PMARK
around() { sed '/^PMARK/,$d' good.bdf; cat; sed '1,/^PMARK/d' good.bdf; }
fresh results
{ echo '$ a long key'; letters A; echo; cat good.bdf; } > long.bdf
long_line 'a line of 100 MB in case control' 'long.bdf, line 2'
{ printf 'PMARK   20      '; letters A; echo; } | around > long.bdf
long_line 'a card of 100 MB' 'where the field must be blank'
{ printf 'PMARK,20'; letters , | head -c 100000; echo X; } | around > long.bdf
long_line 'a card of 100,000 commas' 'where the field must be blank'
{ printf 'PMARK   20\nINCLUDE '; letters A; echo; } | around > long.bdf
long_line 'an INCLUDE of 100 MB' 'INCLUDE'
letters A > long.bdf
long_line 'a file of 100 MB in one line' 'DECK ERROR'
rm -f long.bdf
holds results 'no file after long lines'

for ((i = 1; i <= 30; i++)); do echo "INCLUDE 'deep$((i + 1)).inc'" > deep$i.inc; done
echo '$ the end' > deep31.inc
printf "PMARK   20\nINCLUDE 'deep1.inc'\n" | around > deep.bdf
run -o results deep.bdf;              check 'INCLUDE 30 deep' 2 'INCLUDE'
echo '$ nothing' > nothing.inc
{ echo 'PMARK   20'; for ((i = 1; i <= 700; i++)); do echo "INCLUDE 'nothing.inc'"; done; } | around > many.bdf
run -o results many.bdf;              check '700 INCLUDE files' 2 'INCLUDE'
{ echo 'PMARK   20'; for ((i = 1; i <= 3000; i++)); do echo "NOCARD  $i"; done; } | around > many.bdf
run -o results many.bdf;              check '3000 unknown cards' 2 'DECK ERROR 1 OF 3000' 'and 2999 more errors, not printed, of the kind of ERROR 1'
if [ "$(grep -c '^DECK ERROR' "$work/stderr")" = 1 ]; then pass; else fail '3000 unknown cards: said once'; fi
{ echo 'PMARK   20'; for ((i = 1; i <= 3000; i++)); do echo "PMARK   $i.5"; done; } | around > many.bdf
run -o results many.bdf;              check '3000 errors' 2 'DECK ERROR 10 OF 3000' 'and 2990 more errors, not printed, of the kind of ERROR 10'
if [ -z "$(wrong_numbers)" ]; then pass; else fail "3000 errors: $(wrong_numbers)"; fi
holds results 'no file after many INCLUDEs'

# ---- standard streams above 1 MiB, the terminal ----

cd "$work/command" || exit 2
fresh here
# 20,000 lines of comment, and a listing of 2,000 increments in full
{ sed '/^BEGIN/q; s/^SUBCASE.*/&\n  OUTPUT = ALL/' good.bdf; yes "\$ $(printf '%070d' 0)" | head -n 20000; sed '1,/^BEGIN/d; s/^JINCR.*/JINCR   5       2000    ARITH   2.0-4/' good.bdf
} > large.bdf
run -o here large.bdf;                check 'a deck above 1 MiB' 0
run - < <(cat large.bdf);              check 'a deck and a listing above 1 MiB through the standard streams' 0
if [ "$(wc -c < large.bdf)" -gt 1048576 ] && [ "$(wc -c < here/large.out)" -gt 1048576 ] && cmp -s <(without_deck here/large.out) <(without_deck "$work/stdout"); then pass
else fail 'a listing above 1 MiB on the standard output is not that of the file'
fi
run -o here /proc/self/mem;           check 'a file that cannot be read' 1 '/proc/self/mem: cannot be read'

run --times -q -o here large.bdf;     check '--times' 0 'memory' 'operations static' 'operations refactored' 's of factor'
if awk '$1 != "large.bdf:" { next } $NF == "s" { n++; if ($3 + 0 < 0 || $3 !~ /^[0-9.]+$/) bad = 1 } $2 == "memory" { m = $3 }
        END { exit bad || n != 9 || m < 1 }' "$work/stderr"; then pass
else fail '--times: not the seconds of nine phases and the memory'
fi
# a line for each increment, with the iterations, the seconds so far and those left; for each loop of a backbone
run --progress DOTS good.bdf;         check '--progress: no such form' 1 '--progress DOTS: expected LINES'
run -q --progress LINES -o here good.bdf; check '--progress LINES' 0
if awk '/^good.bdf, [0-9]+ s: stage 1, increment [0-9]+ of [0-9]+, [0-9]+ iterations?, [0-9]+ s left$/ { if ($7 != ++n) bad = 1; all = $9 }
        END { exit bad || n == 0 || n != all + 0 }' "$work/stderr"; then pass; else fail '--progress LINES: a line for each increment'; fi
run -o here good.bdf
if grep -q '^good.bdf, ' "$work/stderr"; then fail 'no terminal: lines in a short run'; else pass; fi
if command -v script > /dev/null; then
   # terminal OPTION...: what a terminal shows of a run
   terminal() { script -qec "$program $* -o here large.bdf" /dev/null < /dev/null > "$work/stdout"; tr '\r' '\n' < "$work/stdout" > "$work/stderr"; }
   terminal; status=0
   check 'on a terminal: the phases' 0 'large.bdf: build' 'large.bdf: order' 'large.bdf: factor'
   if awk '/: stage 1, increment/ { n++; k = $5; if ($7 != "2000," || k <= last || k > 2000 || $9 != "s" || $8 !~ /^[0-9]+$/) bad = 1; last = k }
           END { exit bad || !n }' "$work/stderr"; then pass; else fail 'on a terminal: increment of how many, seconds left'; fi
   if tr '\r' '\n' < "$work/stdout" | grep -q '^ \{60,\}$'; then pass; else fail 'on a terminal: the line is not cleared'; fi
   terminal -q
   if grep -q ", increment [0-9]* of" "$work/stderr"; then fail '-q on a terminal: progress'; else pass; fi
   # one increment by NEWTON, whose iterations take longer than the line stays
   "$here/../bench/make_deck.sh" hex8_24x24x16 TREE LAST | sed 's/^SPC = /METHOD = NEWTON\n&/; s/^JINCR.*/JINCR,5,1/' > large.bdf
   terminal; status=0
   check 'on a terminal: the increment in work' 0 'large.bdf: stage 1, increment 1, iteration '
   if awk '/, iteration [0-9]/ { n++; sub(/.*, iteration /, ""); if ($0 !~ /^[0-9]+: [0-9.E+-]+ left, changes of branch: [0-9]+ *$/) bad = 1 }
           END { exit bad || !n }' "$work/stderr"; then pass; else fail 'on a terminal: iteration, residual and changes of branch'; fi
fi
rm -rf here large.bdf

# ---- standard output full or closed, devices, a small stack ----

cd "$work/command" || exit 2
fresh here
for options in '-q -o here' '--check' '-q'; do
   deck=good.bdf; [ "$options" = -q ] && deck=-
   "$program" $options $deck < good.bdf > /dev/full 2> "$work/stderr"; status=$?
   check "$options $deck, standard output full" 4 'cannot be written'
   "$program" $options $deck < good.bdf >&- 2> "$work/stderr"; status=$?
   check "$options $deck, standard output closed" 4 'cannot be written'
done
sed 's/8\.0-3   /${C}    /' good.bdf > rows.bdf
"$program" -q -o here --set C=8.0-3,9.0-3 rows.bdf > /dev/full 2> "$work/stderr"; status=$?
check 'two runs of --set, standard output full' 4 'rows.bdf, C=8.0-3: the standard output cannot be written' 'rows.bdf, C=9.0-3: the standard'
rm -f rows.bdf
fresh here
"$program" --version > /dev/full 2> "$work/stderr"; status=$?
check '--version, standard output full' 4 'the standard output cannot be written'
run -o here good.bdf
cp -r here open
fresh here
"$program" -q -o here good.bdf > /dev/null 2>&-; status=$?
: > "$work/stderr"
check 'standard error closed' 0
if diff -rq here open > /dev/null; then pass; else fail 'standard error closed: other results'; fi
rm -rf open
LIMIT=20 run --check /dev/zero;       check 'a device without an end' 2 'byte 0 on this line is no text'
sed 's/^MAT1.*/MAT1    1       9500.0          0.25    7.8-9/; s/^FORCE .* 3 .*/GRAV    10              9.81    0.0     -1.0    0.0     0/; /^FORCE/d' good.bdf > grav.bdf
run --check grav.bdf;                 check 'GRAV with MB = 0, as pyNastran writes it' 0
sed 's/^SUBCASE.*/TEMPERATURE(INITIAL) = 1\nTEMPERATURE(LOAD) = 2\n&/' good.bdf > warm.bdf
run --check warm.bdf;                 check 'TEMPERATURE(INITIAL)' 2 'there is no TEMP or TEMPD with set 1'
if grep -q 'given twice' "$work/stderr"; then fail 'TEMPERATURE(INITIAL) beside (LOAD): given twice'; else pass; fi
if [ -z "${ASAN_OPTIONS:-}" ]; then # the address sanitizer itself needs more
   for deck in flange_warm solid_bolt column_tetra10; do
      (ulimit -s 128; exec "$program" -q -o here "$here/../../input/$deck.bdf" > /dev/null 2> "$work/stderr"); status=$?
      check "$deck with stacks of 128 kB" 0
   done
   # the threads of a larger model need more: with the user's 128 kB each would end the program (on one core there is only one)
   (cd "$here/../.." && tests/bench/make_deck.sh q4_200x6 TREE NONE) > wide.bdf
   (ulimit -c 0; ulimit -s 128; exec "$program" -q --threads 2 -o here wide.bdf > /dev/null 2> "$work/stderr"); status=$?
   check '200 x 6 on two threads with stacks of 128 kB' 0
fi
rm -rf here grav.bdf warm.bdf wide.bdf
