#!/usr/bin/env bash
# A zoo of machines (folder zoo): a geometry for Gmsh, which must be installed, and a piece of a deck each. Makes their decks and runs
# them by NEWTON, one after the other.
#
#    zoo.sh PROGRAM WORK [MACHINE...]
#
# PROGRAM    bin/jointfem; - makes the decks only
# WORK       folder of meshes, decks and results; WORK/table holds the table that is printed
# MACHINE    lathe, wedges, ...: all if nothing is said
#
# Five stages: bolts and weight, then a force along x, along y, along z, then back to bolts and weight. A variant is
# MU_SURFACES_ORDER_INCREMENTS:
#
# MU          0.08, 0.15, 0.3, or another coefficient of friction
# SURFACES    book: of input/surfaces, ways scraped, bolted faces ground; stiff: c/100, the shear 100 times as stiff
# ORDER       1, 2: of the elements
# INCREMENTS  free: no INCR; one: INCR of one increment; ten
#
# VARIANTS="0.08_stiff_1_ten ..." runs these; FULL=yes all of MU, SURFACES, ORDER with free and ten. Without either: 0.15_book_2_free,
# and of some machines more. LIMIT (60) is the seconds after which a run is stopped. SCALE (1) multiplies the sizes of all elements.
# THREADS (1).
#
# A line of the table: machine, variant, nodes, exit status (stopped: at LIMIT; parts: an increment ended in parts, but not as a whole),
# increments, iterations with those of attempts that were given up, their average, most in an increment, its stage.increment, increments
# of more than 25; increments that were divided; the largest unbalanced force of a stage over the largest load; how far pressures and
# shear stresses are from the laws, over the largest pressure; seconds. Below it what went wrong: messages, warnings, the last iteration;
# of variants that differ in INCREMENTS alone, how far their answers differ. Status 1 where a run does not end, or where an answer is in
# parts, not in balance or off the laws by more than 1E-6.
set -u
export LC_ALL=C OPENBLAS_NUM_THREADS=1
[ $# -ge 2 ] || { sed -n 's/^#    zoo.sh/usage: zoo.sh/p' "$0" >&2; exit 1; }
here=$(cd "$(dirname "$0")" && pwd)
program=$1 work=$2
shift 2
all='lathe wedges motor vflat cross_slide knee gantry spindle dovetail rotary taper rings lap pipe'
[ $# -gt 0 ] || set -- $all
mkdir -p "$work"
surfaces=$here/../../input/surfaces/mm_n

variants() {
   local mu surface order incr
   if [ -n "${VARIANTS:-}" ]; then echo "$VARIANTS"; return; fi
   if [ "${FULL:-no}" = yes ]; then
      for order in 2 1; do for surface in book stiff; do for mu in 0.08 0.15 0.3; do for incr in free ten; do
         echo "${mu}_${surface}_${order}_$incr"
      done; done; done; done
      return
   fi
   echo 0.15_book_2_free
   case $1 in
   lathe)  echo 0.08_book_2_free 0.3_book_2_free 0.15_stiff_2_free 0.15_book_1_free 0.15_book_2_ten ;;
   wedges|motor|vflat|cross_slide) echo 0.15_stiff_2_free 0.08_book_1_ten ;;
   esac
}

# JNORM and JSHEAR of the file $2 of input/surfaces under the number $1, stiff if $3 says so; without the range of the tests.
law() {
   awk -v id="$1" -v stiff="$3" '
      function real(text) { if (text ~ /[0-9.][-+][0-9]/ && text !~ /[eE]/) sub(/[-+][0-9]+$/, "E&", text); return text + 0 }
      BEGIN { f = stiff == "stiff" ? 100 : 1 }
      $1 == "JNORM"  { printf "JNORM,%d,%.6E,%s%s\n", id, real($3)/f, $4, f == 100 ? ",2.0E+6" : sprintf(",%.6E", real($5)) }
      $1 == "JSHEAR" { printf "JSHEAR,%d,%.6E,%.6E\n", id, real($3)*f, real($4)*f }' "$surfaces/$2.bdf"
}

mesh() {
   local machine=$1 order=$2 out=$work/$1_$2_mesh.bdf
   [ "$out" -nt "$here/zoo/$machine.geo" ] && [ "$out" -nt "$here/zoo/parts.geo" ] && return
   gmsh -3 -order "$order" -format bdf -setnumber Mesh.SaveElementTagType 2 -setnumber Mesh.BdfFieldFormat 0 \
      -setnumber scale "${SCALE:-1}" -o "$out.part.bdf" "$here/zoo/$machine.geo" > "$work/$machine.log" 2>&1
   if grep -m 5 '^Error' "$work/$machine.log" >&2 || [ ! -s "$out.part.bdf" ]; then
      echo "zoo.sh: no mesh of $machine: see $work/$machine.log" >&2
      exit 1
   fi
   mv "$out.part.bdf" "$out"
}

deck() {
   local machine=$1 mu surface order incr words
   IFS=_ read -r mu surface order incr <<< "$2"
   ! grep -q '^\$ ORDER 1' "$here/zoo/$machine.bdf" || order=1 # sheets have no second order
   mesh "$machine" "$order" || exit 1
   case $incr in
   free) words= ;;
   one)  words='INCR = 1' ;;
   ten)  words='INCR = 2' ;;
   *)    echo "zoo.sh: increments are free, one or ten, not '$incr'" >&2; exit 1 ;;
   esac
   {
   cat <<END_OF_CASE
TITLE = ${machine^^}, MU $mu, SURFACES $surface, ORDER $order
UNITS = MM, N
METHOD = NEWTON
SOLVER = TREE
ECHO = NO
$(grep -q -e "^SPC" -e "^%anchor" -e "^%hold" "$here/zoo/$machine.bdf" && echo "SPC = 1" || echo "$ no support")
OUTPUT = NONE
${words:-$ no INCR}
SUBCASE 1
  LABEL = BOLTS AND WEIGHT
  LOAD = 10
SUBCASE 2
  LABEL = FORCE ALONG X
  LOAD = 31
SUBCASE 3
  LABEL = FORCE ALONG Y
  LOAD = 32
SUBCASE 4
  LABEL = FORCE ALONG Z
  LOAD = 33
SUBCASE 5
  LABEL = BACK
  LOAD = 10
BEGIN BULK
INCLUDE '${machine}_${order}_mesh.bdf'
JINCR   1       1
JINCR   2       10      ARITH   0.1
MAT1    1       120000.         0.26    7.2-9
MAT1    2       210000.         0.3     7.85-9
GRAV    10              9810.0  0.0     0.0     -1.0
LOAD    31      1.0     1.0     10      1.0     21
LOAD    32      1.0     1.0     10      1.0     22
LOAD    33      1.0     1.0     10      1.0     23
\$ 1: ways, scraped; 2: bolted faces, ground
PJOINT  1       1       1       1       $mu
PJOINT  2       2       2       2       $mu
END_OF_CASE
   law 1 scraped_20_25_spots_depth_6_8 "$surface"
   law 2 ground_on_ground "$surface"
   awk -F, -f "$here/zoo/zoo.awk" "$work/${machine}_${order}_mesh.bdf" "$here/zoo/$machine.bdf" && echo ENDDATA
   } > "$work/${machine}_$2.bdf" || exit 1
}

# A line of the table, from what the program showed ($1.shown), the listing and the answers, with head $2, status $3, seconds $4, laws
# $5. The convergence history of the listing holds all attempts of an increment that ended, and says how many rows it leaves out; the
# summary counts all iterations of the run, the numbers shown those of an increment that did not end (not every one is shown).
row() {
   cat "$1.shown" "$1.summary" "$1.out" "$1.said" 2> /dev/null | awk -v head="$2" -v status="$3" -v seconds="$4" -v laws="${5:--}" '
      /^stage [0-9]+, increment [0-9]+, iteration [0-9]+:/ { split($0, w, "[ ,:]+"); see(w[2] "." w[4], w[6]); next }
      /^deck,status,/ { n = split($0, w, ","); for (i = 1; i <= n; i++) if (w[i] == "iterations") at = i
                        getline; split($0, w, ","); total = w[at] }
      /^ CONVERGENCE HISTORY, STAGE / { on = 1; stage = $4 + 0; next }
      /^ [A-Z]/ { on = 0 }
      on && $2 == "..." { key = stage "." $1; count[key] += $3; next }
      on && $1 + 0 > 0 && NF >= 6 { key = stage "." $1; count[key]++; see(key, count[key]); if ($2 > 1) parts[key] = 1 }
      $1 == "LOADS" { for (i = 3; i <= 5; i++) if (size($i) > force) force = size($i) }
      $1 == "LEFT"  { for (i = 2; i <= 4; i++) if (size($i) > left) left = size($i) }
      function size(x) { return x < 0 ? -x : x + 0 }
      function see(key, n) { if (!(key in number)) order[++increments] = key; if (n + 0 > number[key] + 0) number[key] = n + 0 }
      END { split(head, w, " ")
            for (i = 1; i <= increments; i++) {
               key = order[i]
               iterations += number[key]
               if (number[key] > most) { most = number[key]; where = key }
               if (number[key] > 25) { over++ }
               if (key in parts) divided++
            }
            if (total + 0 > iterations) iterations = total
            printf "%-12s %-18s %6d %8s %5d %6d %7.1f %5d %7s %6d %7d %8.1e %8s %8.1f\n", w[1], w[2], w[3], status, increments, \
               iterations, (increments ? iterations/increments : 0), most, (where == "" ? "-" : where), over, divided, \
               (force > 0 ? left/force : 0), laws, seconds }'
}

# Whether the run $1 came to its end
whole() { [ -f "$work/$1.stage.csv" ] && grep -q '^ END OF LISTING' "$work/$1.out"; }

# How far the interface elements of the run $1 are from their laws, over the largest pressure: p on the loading curve of an element that
# loads, p above 0, |tau| within MU p, the force p times the area; computed from the deck and the joint history
laws() {
   awk -F'[ ,]+' '
      FNR == 1 { file++ }
      file == 1 && $1 == "JNORM"  { c[$2] = $3; m[$2] = $4 }
      file == 1 && $1 == "PJOINT" { law[$2] = $3; mu[$2] = $6 }
      file == 1 && $1 == "JOINT"  { of[$2] = $3 }
      file == 1 { next }
      FNR == 1 { n = split($0, w, ","); for (i = 1; i <= n; i++) at[w[i]] = i; next }
      {
         split($0, w, ",")
         k = of[w[at["joint"]]]; p = w[at["pressure"]]; lambda = w[at["lambda"]]
         if (p > largest) largest = p
         far(-p)
         far(p - w[at["force"]]/w[at["area"]]); far(w[at["force"]]/w[at["area"]] - p)
         far(sqrt(w[at["tau_x"]]^2 + w[at["tau_y"]]^2) - mu[k]*p)
         if (w[at["branch"]] == "OPEN") far(p)
         if (w[at["branch"]] == "LOAD") { q = lambda > 0 ? (lambda/c[law[k]])^(1/m[law[k]]) : 0; far(p - q); far(q - p) }
      }
      function far(d) { if (!(d <= worst)) worst = d }
      END { printf "%.1e", (largest > 0 ? worst/largest : 0) }' "$work/$1.bdf" "$work/$1.joint.csv"
}

# Run the deck $1_$2 and print its lines of the table
run() {
   local name=$1_$2 status seconds TIMEFORMAT=%R mesh
   rm -f "$work/$name".{out,early,said,errors,shown,summary,restart,joint.csv,stage.csv,reaction.csv,bolt.csv,spring.csv}
   # on a terminal of `script` the program shows its iterations
   seconds=$({ time script -qec "timeout ${LIMIT:-60} nice $program --threads ${THREADS:-1} -o $work --summary $work/$name.summary \
      $work/$name.bdf > $work/$name.said" \
      "$work/$name.errors" > /dev/null 2>&1 < /dev/null; } 2>&1)
   status=$?
   [ $status -ne 124 ] || status=stopped
   [ $status != 0 ] || whole "$name" || status=no_end
   [ $status != 0 ] || ! grep -q 'DID NOT CONVERGE' "$work/$name.out" || status=parts
   tr '\r' '\n' < "$work/$name.errors" | sed 's/\x1b\[[0-9;]*[A-Za-z]//g; s/ *$//; s/.*\.bdf: //' |
      grep -v -e '^$' -e '^Script' -e 'OpenBLAS' -e 'RESTART would keep' -e '^build$' -e '^order$' -e '^factor$' -e '^read$' -e '^write$' \
         -e 'warnings* in the listing' -e 'all bodies are of linear' -e ' s left$' > "$work/$name.shown"
   mesh=$(sed -n "s/^INCLUDE '\(.*\)'/\1/p" "$work/$name.bdf")
   row "$work/$name" "$1 $2 $(grep -c '^GRID' "$work/$mesh")" "$status" "$seconds" "$(whole "$name" && laws "$name")"
   [ ! -f "$work/$name.out" ] || awk '/DID NOT CONVERGE/ { print before; print "   " $0 } { before = "   " $0 }' "$work/$name.out" | head -n 6
   [ "$status" = 0 ] || awk '/^stage .* left/ { last = $0; next }
                             !/^stage .* into/ { print "    " substr($0, 1, 300) }
                             END { if (last != "" && status != "parts") print "    " last }' status="$status" "$work/$name.shown"
}

# What the increments change: the answers of $1_$2 against those of the same variant with other increments, run before: the largest
# difference of a stage in u_max over the largest u_max, and in a joint's normal and shear force over the largest force of a joint.
paths() {
   local variant other=$work/$1_$2.stage.csv
   for variant in $3; do
      [ "$variant" != "$2" ] || return
      [ "${variant%_*}" = "${2%_*}" ] && whole "$1_$variant" && whole "$1_$2" || continue
      awk -F, -v words="$2 against ${variant##*_}" '
         FNR == 1 { file++; for (i = 1; i <= NF; i++) at[$i] = i; next }
         file == 1 { u[$1, $2] = $at["u_max"]; n[$1, $2] = $at["n"]; t[$1, $2] = $at["t"]
                     if (u[$1, $2] > largest) largest = u[$1, $2]; if (n[$1, $2] > force) force = n[$1, $2]; next }
         ($1, $2) in u { du = far(du, u[$1, $2], $at["u_max"]); df = far(df, n[$1, $2], $at["n"]); df = far(df, t[$1, $2], $at["t"]) }
         function far(d, a, b) { a -= b; if (a < 0) a = -a; return a > d ? a : d }
         END { if (largest > 0 && force > 0) printf "    %s: u_max differs by %.1e, forces of joints by %.1e\n", words, du/largest, df/force }' \
         "$work/$1_$variant.stage.csv" "$other"
   done
}

machines=$*
for machine in $machines; do
   for variant in $(variants "$machine"); do deck "$machine" "$variant"; done
done
[ "$program" != - ] || exit 0
{
   printf '%-12s %-18s %6s %8s %5s %6s %7s %5s %7s %6s %7s %8s %8s %8s\n' MACHINE VARIANT NODES STATUS INCR ITER AVERAGE MOST AT '> 25' \
      DIVIDED LEFT LAWS SECONDS
   for machine in $machines; do
      sed -n 's/^\$ HELD BY: \(.*\)/  '"$machine"': \1/p' "$here/zoo/$machine.bdf"
      for variant in $(variants "$machine"); do
         run "$machine" "$variant"
         paths "$machine" "$variant" "$(variants "$machine")"
      done
   done
} | tee "$work/table"
awk '$2 ~ /^[0-9.]+_/ {
        runs++
        seconds += $14
        if ($4 != "0") next
        ended++; increments += $5; iterations += $6; over += $10
        if ($8 > most) { most = $8; where = $1 " " $2 " " $9 }
        if ($12 + 0 > left + 0) left = $12
        if ($13 + 0 > laws + 0) laws = $13
     }
     END {
        printf "%d of %d ended; of these: %d increments, %d iterations, %.1f on average, most %d (%s), above 25 in %d; ", ended, runs, \
           increments, iterations, (increments ? iterations/increments : 0), most, where, over
        printf "left at most %s, off the laws %s; %.0f s in all\n", left + 0, laws + 0, seconds
        exit (ended < runs || left + 0 > 1e-6 || laws + 0 > 1e-6)
     }' "$work/table" > "$work/sum"
status=$?
tee -a "$work/table" < "$work/sum"
exit $status
