#!/usr/bin/env bash
# The fuzzer of pairs itself: its judge notices every fault that it is there for, and it makes the same decks again.
#
#     selftest.sh PROGRAM FOLDER
#
# Ends with "N passed, N failed"; exit status 1 if anything failed.
set -u
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
program=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2/sound"
cd "$2" || exit 2
passed=0 failed=0

# holds WHAT COMMAND...
holds() {
   local what=$1
   shift
   if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED: $what"; fi
}

# decks FROM TO FOLDER
decks() {
   mkdir -p "$3"
   awk -v seed=11 -v from="$1" -v to="$2" -v folder="$3" -f "$here/../fuzz/random.awk" -f "$here/features.awk" -f "$here/model.awk" \
      -f "$here/write.awk" > "$3/list"
}

decks 1 40 all
decks 1 40 again
decks 17 17 one
holds 'the same decks again' diff -r all again
holds 'a deck does not depend on the others' cmp -s all/d17a.bdf one/d17a.bdf
holds 'decks that differ' [ "$(cat all/*.bdf | cksum)" != "$(decks 41 80 other; cat other/*.bdf | cksum)" ]

# of: the first solved deck in the list with METHOD (2nd word) and the features named
of() { awk -v method="$1" -v wanted="$2" '$1 == "DECK" && $4 == method { n = split(wanted, w, " "); for (k = 1; k <= n; k++) if (!index($0 " ", " " w[k] " ")) next
   if (/ part/) next
   print $2; exit }' list; }

# judge: what it says of the results in `now`
judge() { awk -v folder=now -v tallies=tallies -f "$here/judge.awk" "$1" messages > verdict; }

# prepare NUMBER: the deck's results, sound
prepare() {
   rm -rf sound
   mkdir sound
   awk -v n="$1" '$1 == "DECK" { on = $2 == n } on' list > one_list
   for v in a t r m q u; do "$program" -q --threads 1 -o sound "made/d$1$v.bdf" > /dev/null 2> messages; done
   : > messages
   fresh
   judge one_list
   holds "deck $1, as it is" [ ! -s verdict ]
   number=$1
}
fresh() { rm -rf now; cp -r sound now; }

# change FILE COLUMN EXPRESSION [CONDITION]: in the last row of a CSV file that meets CONDITION; x is the column
change() {
   awk -F, -v OFS=, -v column="$2" 'NR == FNR { if (FNR == 1) for (i = 1; i <= NF; i++) c[$i] = i; else if ('"${4:-1}"') last = FNR; next }
      FNR == last { x = $c[column]; $c[column] = '"$3"' } { print }' "$1" "$1" > changed && mv changed "$1"
}

# finds WHAT WORDS: the judge says WORDS of what has been changed
finds() { judge one_list; holds "$1" grep -q "$2" verdict; fresh; }

decks 1 400 made
mv made/list list

prepare "$(of NEWTON 'modes bolt vtu friction')"
change now/d${number}t.joint.csv pressure 'x * 1.00001';         finds 'another pressure by the other solver' 'pressure, t is off'
change now/d${number}r.joint.csv lambda 'x * 1.0001';            finds 'another deflection, renumbered' 'lambda, r is off'
change now/d${number}m.joint.csv force 'x + 1';                  finds 'another force, mirrored' 'force, m is off'
change now/d${number}u.joint.csv area 'x * 1.001';               finds 'another area in other units' 'area, u is off'
change now/d${number}q.joint.csv x 'x + 1' 'FNR == 2';           finds 'another place, turned' 'place of an element, q is off'
change now/d${number}a.joint.csv pressure 'x * 1.001' '$c["branch"] == "LOAD"'; finds 'off the loading curve' 'LOAD is off'
change now/d${number}a.joint.csv force 'x * 1.001';              finds 'a force that is not p a' 'force = p a is off'
change now/d${number}a.joint.csv tau_x 'x + 100';                finds 'more than friction' 'friction is off'
change now/d${number}a.joint.csv area 'x * 1.01' 'FNR == 2';     finds 'areas' 'area of joint'
change now/d${number}a.joint.csv pressure -1e-3;                 finds 'a pull' ': p -'
change now/d${number}a.joint.csv branch '"OPEN"';                finds 'open under pressure' 'open, with p'
change now/d${number}r.joint.csv branch '"OPEN"';                finds 'another branch' 'branch OPEN for'
change now/d${number}t.joint.csv slip '1 - x';                   finds 'another slip' 'slip . for'
sed -i '$d' now/d${number}t.joint.csv;                           finds 'a row less' 'rows, the model'
change now/d${number}m.modes.csv frequency 'x * 1.0001';         finds 'another frequency' 'frequency, m is off'
change now/d${number}u.bolt.csv force 'x * 1.0001';              finds 'another bolt' 'force, u is off'
change now/d${number}t.stage.csv u_max 'x * 1.0001';             finds 'another displacement' 'u_max of the answer, t'
change now/d${number}r.stage.csv p_max 'x * 1.0001';             finds 'another largest pressure' 'p_max of the answer, r'
awk '/BALANCE OF FORCES/ { on = 1 } on && /^  SUM/ { $NF = "1.0000E+01"; $0 = "  " $0; on = 0 } { print }' sound/d${number}a.out > now/d${number}a.out
finds 'no balance' 'balance of forces is off'
grep -v 'BALANCE OF FORCES' sound/d${number}a.out > now/d${number}a.out; finds 'a balance less' 'balances for'
for file in now/d${number}a*joint.vtu; do head -c 16500 "$file" > changed; mv changed "$file"; done
finds 'a file for ParaView that ends too early' 'bytes long'
rm -f now/d${number}a*[0-9a].vtu now/d${number}a.vtu;            finds 'no file for ParaView' 'no now/'
rm now/d${number}u.*;                                            finds 'no results without a word' 'no results and no message'
echo "d${number}m.bdf: no equilibrium; no results" > messages;   finds 'one variant without an answer' 'some not: m:unsolved'
echo "d${number}m.bdf: 2 errors, nothing solved" > messages;     finds 'one variant refused' 'is refused'
: > messages

prepare "$(awk '$1 == "DECK" { n = $2; taken = $4 == "NEWTON" && !/ (mpc|part|gap|temp)/ } $1 == "CARRIES" && taken { print n; exit }' list)"
change now/d${number}a.stage.csv n 'x * 1.001';                  finds 'a normal force against statics' 'by statics is off'

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
