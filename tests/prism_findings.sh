#!/usr/bin/env bash
# The paper's findings on the prism (section 6.1, Fig. 7), each asserted from the joint histories of the four decks, and the
# numbers of an independent computation (a dense stiffness matrix of the same mesh, written in another language).
#
#    prism_findings.sh QUERY FOLDER_WITH_THE_CSV_FILES
set -u
query=$1 work=$2
source tests/exact/lib.sh

# at N NODE COLUMN: of the deck with N increments, after the last of them
at() { cell "prism$(printf '%02d' "$1")" 1 "$1" "$2" "$3"; }

rows=0
for n in 03 05 10 15; do rows=$((rows + $(value prism$n print 'count()'))); done
same '11 interface elements in every increment of every deck' $rows $((11 * (3 + 5 + 10 + 15)))
# independent computation, 6 digits
near 'prism05: lambda at node 51' "$(at 5 51 lambda)" 7.62013e-3 5e-6
near 'prism05: p at node 51' "$(at 5 51 pressure)" 0.574067 5e-6
same 'prism05: node 1 is open' "$(at 5 1 branch)" OPEN
same 'prism05: node 6 is on the unloading branch' "$(at 5 6 branch)" UNLOAD
while read -r n lambda pressure; do
   holds "prism$n: lambda $lambda, p $pressure at node 51" \
      "$(at $n 51 lambda) = $lambda within 5e-6*$lambda and $(at $n 51 pressure) = $pressure within 5e-6*$pressure"
done <<'NUMBERS'
3 9.406482e-3 0.543063
10 6.921697e-3 0.588122
15 6.775946e-3 0.591572
NUMBERS
# the deflection of node 51 falls steadily as 3, 5, 10, 15 increments are used, much from 3 to 5, little from 10 to 15
set -- "$(at 3 51 lambda)" "$(at 5 51 lambda)" "$(at 10 51 lambda)" "$(at 15 51 lambda)"
holds 'deflection of node 51 falls with the increments' "$1 > $2 and $2 > $3 and $3 > $4"
holds 'it falls much from 3 to 5 and little from 10 to 15' "$1 - $2 > 5*($3 - $4)"
# the pressures of nodes 36 to 51 rise, those of nodes 6 to 26 fall or the node stays open
while read -r few many; do
   for node in 36 41 46 51 6 11 16 21 26; do
      ask "pressure of node $node from $few to $many increments" "prism$many" rows 'increment = max(increment)' rows "node1 = $node" \
         with "$work/prism$few.joint.csv" on node1 on increment=$few \
         all "if($node > 30, pressure > other.pressure, pressure < other.pressure or branch = \"OPEN\" and other.branch = \"OPEN\")"
   done
done <<'DECKS'
03 05
05 10
10 15
DECKS
# the joint carries every increment of the load in which no element was removed
for n in 03 05 10 15; do
   open_before=0 force_before=0 load_before=0
   for ((i = 1; i <= 10#$n; i++)); do
      read -r open force load <<< "$(value prism$n rows "increment = $i" print 'sum(branch = "OPEN")' print 'sum(force)' print load)"
      [ "$open" -gt $open_before ] || holds "prism$n, increment $i: joint force and load rise alike" \
         "$force - $force_before = 800*($load - $load_before) within 1e-10*800"
      open_before=$open force_before=$force load_before=$load
   done
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
