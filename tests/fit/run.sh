#!/usr/bin/env bash
# jointfit: the worked example, data with a known answer, bad data, and its cards read by jointfem.
#
#    run.sh JOINTFIT JOINTFEM
set -u
export LC_ALL=C

if [ $# -ne 2 ] || [ ! -x "$1" ] || [ ! -x "$2" ]; then
   echo 'usage: run.sh JOINTFIT JOINTFEM' >&2
   exit 2
fi
jointfit=$(realpath "$1") jointfem=$(realpath "$2")
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
passed=0 failed=0

# ---- tools ----

pass() { passed=$((passed + 1)); }
fail() {
   failed=$((failed + 1))
   echo "FAILED: $1"
   [ -s stderr ] && head -n 12 stderr | cut -c 1-160
}

# fit ARGUMENTS: jointfit, at most 300 seconds; sets STATUS, leaves `cards` and `stderr`
fit() {
   timeout 300 "$jointfit" "$@" > cards 2> stderr
   status=$?
}

# holds TITLE COMMAND...: one test, passed where the command succeeds
holds() {
   local title=$1
   shift
   if "$@"; then pass; else fail "$title"; fi
}

# says TITLE FILE FRAGMENT...: FILE holds every fragment
says() {
   local title=$1 file=$2 fragment
   shift 2
   for fragment in "$@"; do
      if ! grep -q -F -e "$fragment" "$file"; then
         fail "$title: nowhere '$fragment'"
         return
      fi
   done
   pass
}

# near TITLE TOLERANCE EXPECTED: the numbers of the cards and those of the file EXPECTED (lines of card_values.awk) are the
# same to TOLERANCE (relative to the expected number, or where that is zero absolute), none more, none less.
near() {
   if awk -f "$here/card_values.awk" cards > got && awk -v tolerance="$2" '
      NR == FNR { expected[$1 " " $2] = $3; n++; next }
      { key = $1 " " $2; m++
        if (!(key in expected)) { print key " is there: " $3; bad = 1; next }
        e = expected[key]; size = e < 0 ? -e : e; if (size == 0) size = 1
        off = $3 - e; if (off < 0) off = -off
        if (!(off <= tolerance * size)) { print key ": " $3 ", expected " e; bad = 1 } }
      END { if (n != m) { print m + 0 " numbers, expected " n + 0; bad = 1 } exit bad }' "$3" got; then pass
   else cat got | head -n 3; fail "$1"; fi
}

# The law of the synthetic data, a row of a11 a12 a21 a22 a31 a32 for each branch, and the cards' numbers that belong to it.
load_law='12.5 0.75 -1.25 0.04 0.3 -0.002'
unload_law='20 0.9 2.5 0.031 -0.21 0.0013'
reload_law='18 0.8 -2 0.012 0.4 0.0011'
law_fields() { # ID PMAX DMAX BRANCH...
   local id=$1 p=$2 d=$3
   shift 3
   { for branch in "$@"; do case $branch in
         LOAD) echo "2 $load_law" ;; UNLOAD) echo "9 $unload_law" ;; RELOAD) echo "17 $reload_law" ;; esac; done
   } | awk -v id="$id" -v p="$p" -v d="$d" 'BEGIN { print "JSHEAR 1 " id }
      { for (i = 2; i <= NF; i++) print "JSHEAR " $1 + i - 2 " " $i } END { print "JSHEAR 25 " p; print "JSHEAR 26 " d }'
}

# points NOISE BRANCH...: points of the law at p = 10, 25, 40, 60 and d up to 1.5, less far at the lower p (where all have the
# same d, one step and two give the same answer), with noise of NOISE times tau; 58 points a branch
points() {
   awk -v noise="$1" -v branches="${*:2}" -v LOAD="$load_law" -v UNLOAD="$unload_law" -v RELOAD="$reload_law" '
      function random() { seed = (seed * 16807) % 2147483647; return 2 * seed / 2147483647 - 1 }
      BEGIN {
         seed = 4711
         split(LOAD, law); for (i in law) a["LOAD", i] = law[i]
         split(UNLOAD, law); for (i in law) a["UNLOAD", i] = law[i]
         split(RELOAD, law); for (i in law) a["RELOAD", i] = law[i]
         nb = split(branches, b, " "); np = split("10 25 40 60", ps, " ")
         print "d tau p branch"
         for (k = 1; k <= nb; k++) for (i = 1; i <= np; i++) for (j = 0; j <= 15 && j <= 9 + 2 * i; j++) {
            p = ps[i]; d = 0.1 * j
            tau = (a[b[k], 1] + a[b[k], 2] * p) * d + (a[b[k], 3] + a[b[k], 4] * p) * d^2 + (a[b[k], 5] + a[b[k], 6] * p) * d^3
            tau *= 1 + noise * random()
            if (b[k] != "LOAD") tau += 0.3 * i * i       # every run from a point of its own
            printf "%.17g %.17g %.17g %s\n", d, tau, p, b[k]
         } }'
}

# ---- the worked example: Fig. 2 from Sanad's cubics ----

# the three straight lines, by the formulas of regression
awk '$5 == "RELOAD" { n++; for (k = 1; k <= 3; k++) { y = $(k + 1); sy[k] += y; sxy[k] += $1 * y } sx += $1; sxx += $1 * $1 }
     END { print "JSHEAR 1 1"
           for (k = 1; k <= 3; k++) { b = (n * sxy[k] - sx * sy[k]) / (n * sxx - sx * sx); a = (sy[k] - b * sx) / n
              printf "JSHEAR %d %.17g\nJSHEAR %d %.17g\n", 2 * k, a, 2 * k + 1, b }
           print "JSHEAR 25 128" }' "$here/sanad.dat" > sanad
fit --branch RELOAD --as LOAD "$here/sanad.dat"
holds 'sanad: status 0' [ $status -eq 0 ]
near 'sanad: the lines through c1, c2 and c3' 1e-10 sanad
says 'sanad: c1 = 260.86 + 3.798 p' cards 'a1 = 260.8581 + 3.798367 p'
says 'sanad: comments' cards '5 cubics given, p 24 to 128' 'taken from the RELOAD data' 'no data: left blank, as loading' \
   'DMAX     left blank' 'D AND TAU NOT PRINTED IN THE SOURCE' 'largest 63.7644 at p = 75'
printf 'JSHEAR 1 1\nJSHEAR 2 260.86\nJSHEAR 3 3.798\n' > c1
grep '^JSHEAR\*' cards | cut -c 1-56 > line; mv line cards
near 'sanad: c1 to the digits of the paper' 1e-4 c1
fit --branch RELOAD --as LOAD --dmax 0.8 --id 42 "$here/sanad.dat"
{ sed 's/^JSHEAR 1 1/JSHEAR 1 42/' sanad; echo 'JSHEAR 26 0.8'; } > sanad42
near 'sanad: --dmax and --id' 1e-10 sanad42
holds 'sanad: no slope is lost up to d = 0.8' [ ! -s stderr ]
fit "$here/sanad.dat"
holds 'sanad without loading data: status 2' [ $status -eq 2 ]
says 'sanad without loading data: the standard error' stderr 'no LOAD data' '--branch RELOAD --as LOAD'
holds 'sanad without loading data: no card' [ "$(grep -c '^[^$]' cards)" -eq 0 ]
{ echo 'JSHEAR*'; sed -n 's/^\$\*/*/p' cards; } > line
mv line cards
awk '$2 > 1 && $2 < 8 { print $1, $2 + 3, $3 }' sanad > continuation
near 'sanad without loading data: the continuation as a comment' 1e-10 continuation

# ---- data without noise give their law back ----

points 0 LOAD UNLOAD RELOAD > all.dat
law_fields 1 60 1.5 LOAD UNLOAD RELOAD > all
fit all.dat
holds 'exact cubics: status 0, and a warning of loops that do not close alone' [ "$status $(wc -l < stderr)" = '0 1' ]
near 'exact cubics: two steps' 1e-10 all
fit --joint-fit all.dat
near 'exact cubics: one step' 1e-10 all
fit --small all.dat
near 'exact cubics: eight columns' 5e-5 all
awk 'NR == 1 { print "Branch, P, Tau, D"; next } { print tolower($4) "," $3 " ,\t" $2 "," $1 "   # comment" }' all.dat | sed 's/$/\r/' > csv.dat
fit csv.dat
near 'commas, other columns, capitals, DOS line ends' 1e-10 all
fit - < all.dat
near 'standard input' 1e-10 all
says 'standard input has a name' cards 'standard input'
cp all.dat ./-all.dat
fit -- -all.dat
near 'a name that begins with a hyphen, behind --' 1e-10 all
{ points 0 LOAD; points 0 RELOAD; } > two_headers.dat
fit two_headers.dat
law_fields 1 60 1.5 LOAD RELOAD > load_reload
near 'two headers in one file, no unloading: a blank continuation' 1e-10 load_reload
holds 'a blank continuation is a lone +' [ "$(grep -c '^+$' cards)" -eq 1 ]
fit --branch RELOAD --as LOAD two_headers.dat
load_law=$reload_law law_fields 1 60 1.5 LOAD > as_load
near '--as LOAD: each run of the points keeps its own start' 1e-10 as_load
says '--as LOAD: what is left out is said' cards '58 rows of other branches left out'
sort -r all.dat > unsorted.dat
fit unsorted.dat
near 'points in any order' 1e-10 all
awk 'NR == 1 { print; next } { $3 = $3 * (1 + ($1 > 0.75 ? 1e-5 : -1e-5)); print }' all.dat > scatter.dat
fit --p-tolerance 1e-4 scatter.dat
near 'pressures within the tolerance are one group' 1e-4 <(sed 's/^JSHEAR 25 60/JSHEAR 25 60.0006/' all)
says 'pressures within the tolerance: four' cards '58 points at 4 pressures'
fit --p-tolerance 1e-6 scatter.dat
says 'pressures beyond the tolerance: eight' cards '58 points at 8 pressures'
awk 'BEGIN { print "p d tau branch"; for (i = 1; i <= 30; i++) { p = 10 + i; d = 0.05 * (1 + 7 * i % 30)
   printf "%.17g %.17g %.17g LOAD\n", p, d, (12.5 + 0.75 * p) * d + (-1.25 + 0.04 * p) * d^2 + (0.3 - 0.002 * p) * d^3 } }' > own_p.dat
fit --joint-fit own_p.dat
law_fields 1 40 1.5 LOAD > own_p
near 'one step, every point at its own pressure' 1e-10 own_p

for m in 0.3 0.5 1; do
   awk -v m=$m 'BEGIN { print "p,lambda"; for (i = 0; i <= 12; i++) printf "%.17g,%.17g\n", i / 4, i ? 8e-3 * (i / 4)^m : 0 }' > power.dat
   fit --id 9 power.dat
   printf 'JNORM 1 9\nJNORM 2 8e-3\nJNORM 3 %s\n' $m > power
   near "exact power law, m = $m" 1e-10 power
done
holds 'm = 1 but for rounding is no warning' [ ! -s stderr ]

# ---- noisy data give it nearly ----

points 0.01 LOAD UNLOAD RELOAD > noisy.dat
for option in --large --joint-fit; do
   fit $option noisy.dat
   # a coefficient alone may stray: judged is tau, at the corners of the range
   awk -f "$here/card_values.awk" cards > got
   holds "noisy cubics, $option: tau within 1.5 per cent" awk '
      NR == FNR { e[$2] = $3; next } { g[$2] = $3 }
      END { for (b = 0; b < 3; b++) for (p = 10; p <= 60; p += 50) for (d = 0.3; d < (p < 60 ? 1.15 : 1.6); d += 0.2) {
               first = b ? 8 * b + 1 : 2; te = tg = 0
               for (k = 0; k < 3; k++) { te += (e[first + 2*k] + e[first + 2*k + 1] * p) * d^(k + 1)
                                         tg += (g[first + 2*k] + g[first + 2*k + 1] * p) * d^(k + 1) }
               if (!((tg - te)^2 <= (0.015 * te)^2)) { print "branch " b ", p " p ", d " d ": " tg ", expected " te; bad = 1 } }
            exit bad }' all got
done
holds 'noisy cubics: one step lies nearer to the points than two, the separate cubics nearest' awk '
   /residual/ && match($0, /rms [0-9.E+-]+/) { r[++n] = substr($0, RSTART + 4, RLENGTH - 4) + 0 }
   END { for (i = 1; i <= 9; i += 3) if (!(r[i] < r[i + 2] && r[i + 2] < r[i + 1] && r[i] > 0)) bad = 1; exit bad || n != 9 }' cards
awk 'BEGIN { seed = 99; print "lambda p"
   for (i = 1; i <= 40; i++) { seed = (seed * 16807) % 2147483647; p = i / 4
      printf "%.17g %.17g\n", 0.8 * p^0.5 * (1 + 0.02 * (2 * seed / 2147483647 - 1)), p } }' > noisy_power.dat
fit noisy_power.dat
printf 'JNORM 1 1\nJNORM 2 0.8\nJNORM 3 0.5\n' > power
near 'noisy power law' 0.02 power
# the least sum of squares: every neighbour of the answer lies higher
awk -f "$here/card_values.awk" cards > got
holds 'noisy power law: a minimum' awk '
   function sum(c, m,   i, s) { for (i = 1; i <= n; i++) s += (c * p[i]^m - l[i])^2; return s }
   NR == FNR { v[$2] = $3; next } $1 != "lambda" { n++; l[n] = $1; p[n] = $2 }
   END { best = sum(v[2], v[3])
         for (i = -1; i <= 1; i++) for (j = -1; j <= 1; j++) if (i || j) if (sum(v[2] * (1 + i * 1e-5), v[3] + j * 1e-5) <= best) bad = 1
         exit bad }' got noisy_power.dat

# ---- warnings ----

# slope 10 - 2 (0.5 + 0.01 p) d: first zero at p = 50, d = 5
awk 'BEGIN { print "d tau p branch"; for (p = 10; p <= 50; p += 20) for (d = 0; d <= 6; d += 0.5)
   print d, 10 * d - (0.5 + 0.01 * p) * d^2, p, "LOAD" }' > bends.dat
fit bends.dat
holds 'a slope is lost: status 0' [ $status -eq 0 ]
says 'a slope is lost: on the standard error' stderr 'WARNING: LOAD' 'p = 50, d = 5, inside the tested range'
says 'a slope is lost: above the card' cards '$ WARNING' 'p = 50, d = 5, inside the tested range'
# unloading, slope 10 - 4 d + 0.1 p d: with falling d lost at the start, d = 4, p = 10; loading is straight
awk 'BEGIN { print "d tau p branch"; for (p = 10; p <= 50; p += 20) for (d = 0; d <= 4; d += 0.5) {
   print d, 10 * d, p, "LOAD"; print d, 7 + 10 * d - 2 * d^2 + 0.05 * p * d^2, p, "UNLOAD" } }' > bends.dat
fit bends.dat
says 'a slope is lost: unloading goes down from the largest d' stderr 'UNLOAD' 'p = 10, d = 4, inside the tested range'
# positive where it was tested, d = 0 to 2, but not on the way on past zero: slope 2 + 1.5 d is zero at d = -4/3
awk 'BEGIN { print "d tau p branch"; for (p = 10; p <= 50; p += 20) for (d = 0; d <= 2; d += 0.25) {
   print d, 10 * d, p, "LOAD"; printf "%.17g %.17g %.17g UNLOAD\n", d, 7 + 2 * d + 0.75 * d^2, p } }' > bends.dat
fit bends.dat
says 'a slope is lost: past zero, where the card is used' stderr 'UNLOAD' 'd = -1.33333' 'outside the tested range of the branch'
awk 'BEGIN { print "p lambda"; for (p = 1; p < 9; p++) print p, p^1.2 }' > steep.dat
fit steep.dat
says 'm above 1 is held at 1' stderr 'WARNING' 'm = 1.199997' 'm is set to 1'
awk -f "$here/card_values.awk" cards > got
holds 'm above 1 is held at 1, on the card' grep -q -x 'JNORM 3 1' got
awk 'NR > 1 { a += $1 * $2; b += $1 * $1 } END { printf "JNORM 1 1\nJNORM 2 %.17g\nJNORM 3 1\n", a / b }' steep.dat > steep
near 'm above 1 is held at 1: c of the straight line' 1e-5 steep
fit --joint-fit --branch RELOAD --as LOAD "$here/sanad.dat"
says '--joint-fit without points' stderr 'WARNING' 'there are no points for --joint-fit'

# ---- bad data: status 2, no card, every fault named ----

# bad TITLE FRAGMENT...: the data on standard input
bad() {
   local title="bad data, $1"
   shift
   cat > bad.dat
   fit bad.dat
   if [ $status -ne 2 ] || [ -s cards ]; then fail "$title: status $status"; return; fi
   says "$title" stderr "$@"
   if grep -q -e 'Fortran runtime error' -e Backtrace stderr; then fail "$title: a run-time error"; fi
}

bad 'empty' 'the file is empty' < /dev/null
bad 'comments only' 'no header line' <<< '# nothing'
bad 'no header' 'bad.dat, line 2' 'numbers before the header line' "expected a line with the names" <<< $'# x\n1 2 3 LOAD'
bad 'header only' 'no test data' <<< 'p lambda'
bad 'unknown column' 'line 1' "'tua' is not a column" '  ^^^' <<< $'d tua p branch\n1 2 3 LOAD'
bad 'column twice' "column 'p' given twice" '          ^' <<< $'lambda p p\n1 2 3'
bad 'columns of two kinds' 'not a known combination' <<< $'d tau lambda p\n1 2 3 4'
bad 'column missing' 'not a known combination' "'d tau p branch'" <<< $'d tau branch\n1 2 LOAD'
bad 'headers of two kinds' 'line 3' 'a different kind' <<< $'lambda p\n1 2\nd tau p branch\n1 2 3 LOAD'
bad 'letter O' 'line 3' "P: '1O' is not a number" '      ^^' <<< $'lambda p\n1.0 2\n2.0   1O\n3 4'
bad 'not a number' "LAMBDA: 'NaN' is not a number" <<< $'p lambda\n1 NaN\n2 1'
bad 'infinite' "'+Inf' is not a number" <<< $'p lambda\n1 +Inf\n2 1'
bad 'decimal comma' 'entries on this line: 4, expected 2' <<< $'p lambda\n1,0 2,0\n2 1'
bad 'semicolons' "'1,2,3' is not a number" 'entries on this line: 3, expected 2' <<< $'p lambda\n1;1,2,3\n1;2 3'
bad 'too few entries' 'line 2' 'entries on this line: 3, expected 4' <<< $'d tau p branch\n1 2 LOAD'
bad 'too many entries' '        ^' 'entries on this line: 3, expected 2' <<< $'lambda p\n1 2  3'
bad 'empty entry' 'nothing between two commas' <<< $'d,tau,p,branch\n1,,3,LOAD'
bad 'branch' "BRANCH: 'LOADING', expected LOAD, UNLOAD or RELOAD" <<< $'d tau p branch\n1 2 3 LOADING'
bad 'negative pressure' "P: '-1' is negative" <<< $'lambda p\n1 -1\n1 1'
bad 'negative d of loading' 'line 3' 'LOAD branch is negative' '^^' <<< $'p d tau branch\n1 1 1 LOAD\n1 -1 -1 LOAD'
bad 'huge' 'beyond 1E30' <<< $'lambda p\n1 1E200\n1 1'
bad 'huge, both senses' 'beyond 1E30' <<< $'lambda p\n0 0\n1 1\n1E308 2\n-1E308 1\n0.5 0\n1 1'
bad 'one pressure' 'line 2' 'LOAD: all data at one pressure, p = 5' <<< $'d tau p branch\n1 1 5 LOAD\n2 2 5 LOAD\n3 3 5 LOAD\n4 4 5 LOAD'
bad 'one cubic' 'UNLOAD: all data at one pressure' 'line 4' <<< $'c1 c2 c3 p branch\n1 1 1 5 LOAD\n1 1 1 6 LOAD\n1 1 1 5 UNLOAD'
bad 'few points' 'line 5' 'LOAD, p = 6: 2 points that fix no cubic, expected three different d' \
   <<< $'d tau p branch\n1 1 5 LOAD\n2 2 5 LOAD\n3 3 5 LOAD\n1 1 6 LOAD\n2 3 6 LOAD'
bad 'few points of unloading' 'UNLOAD, p = 5: 3 points' 'expected four different d' \
   <<< $'d tau p branch\n1 1 5 LOAD\n2 2 5 LOAD\n3 3 5 LOAD\n1 1 6 LOAD\n2 3 6 LOAD\n3 4 6 LOAD\n1 1 5 UNLOAD\n2 2 5 UNLOAD\n3 3 5 UNLOAD'
bad 'one point of normal tests' 'two or more different p' <<< $'lambda p\n0 0\n1 1\n2 1'
bad 'falling deflection' 'lambda does not grow with p: m = -1' <<< $'lambda p\n4 1\n2 2\n1 4'
bad 'zero of a pressure that is almost none' 'lambda does not grow with p: m = -' <<< $'lambda p\n0 0\n2 1E-160\n1.9 0.5\n1.8 1\n1.7 2\n1.6 4'
bad 'too stiff a law' 'has a number of 1.00079E-90' 'none below 1E-75' <<< $'lambda p\n1E-90 1\n1.4E-90 2\n1.7E-90 3'
bad 'units of two kinds' 'line 3' "UNITS: 'MM, N', but above it was 'MM, KGF'" <<< $'UNITS = MM, KGF\nlambda p\nUNITS = MM, N\n1 1\n2 4'
bad 'binary' 'not text' < <(printf 'lambda p\n1 2\0 3\n')
bad 'all faults at once' 'DATA ERROR 1 OF 5' 'DATA ERROR 5 OF 5' 'line 2' 'line 3' 'line 5' 'bad.dat: 5 errors, no card written' \
   <<< $'d tau p branch\n1 x 3 LOAD\n1 2 -3 LOUD\n1 2 3 LOAD\n1 2\n-2 1 1 LOAD'

# ---- the command ----

usage() { # TITLE FRAGMENT ARGUMENTS...: status 1, nothing on standard output
   local title=$1 fragment=$2
   shift 2
   fit "$@"
   if [ $status -ne 1 ] || [ -s cards ]; then fail "$title: status $status"; else says "$title" stderr "$fragment"; fi
}
usage 'no data file' 'no data file given'
usage 'unknown option' 'unknown option --what' --what all.dat
usage 'no such file' 'missing.dat: no such file' missing.dat
usage 'a folder' '.: a directory' .
usage '--as alone' '--as needs --branch' --as LOAD all.dat
usage '--branch of no branch' 'expected LOAD, UNLOAD or RELOAD' --branch LOADING all.dat
usage '--id of no number' '--id x: expected a number' --id x all.dat
usage '--id without a value' '--id : expected a number' all.dat --id
usage '--dmax zero' 'expected a number above 0' --dmax 0 all.dat
usage '--p-tolerance negative' '--p-tolerance -1: expected' --p-tolerance -1 all.dat
usage '--id: the last of two beyond all' 'the laws of 2 files would have numbers beyond 2147483647' --id 2147483647 all.dat all.dat
usage '--id: nine digits in eight columns' 'they end at 99999999' --id 100000000 --small all.dat
usage '--id: the second of nine digits' 'the numbers of 2 files' --small --id 99999999 all.dat all.dat
fit --small --id 99999999 all.dat
says '--id of eight digits' cards 'JSHEAR  99999999'
fit --id 2147483647 all.dat
says '--id, the largest' cards 'JSHEAR* 2147483647  '
fit --branch UNLOAD two_headers.dat
holds '--branch without data: status 2' [ $status -eq 2 ]
says '--branch without data' stderr 'no UNLOAD data'
fit --branch UNLOAD all.dat
holds '--branch without --as stays that branch: status 2' [ $status -eq 2 ]
says '--branch without --as stays that branch' cards 'The UNLOAD continuation'
fit --branch RELOAD --as LOAD --dmax 1E300 "$here/sanad.dat"
holds '--dmax beyond all measure: status 2' [ $status -eq 2 ]
says '--dmax beyond all measure' stderr 'has a number of 1E300, and a deck accepts at most 1E75'
fit --branch RELOAD --as LOAD --dmax 1E-80 "$here/sanad.dat"
holds '--dmax below all measure: status 2' [ $status -eq 2 ]
says '--dmax below all measure' stderr 'has a number of 1E-80, and a deck accepts none below 1E-75'
awk '/^[0-9]/ { for (i = 1; i <= 4; i++) $i = $i "E-90" } { print }' "$here/sanad.dat" > tiny.dat
fit --branch RELOAD --as LOAD tiny.dat
says 'pressures and stresses below all measure' stderr 'has a number of 1.28E-88, and a deck accepts none below 1E-75'
fit --branch LOAD power.dat
says '--branch of normal tests' stderr 'have no branch'
fit --help
says '--help' cards 'usage: jointfit' '--joint-fit'
holds '--help: status 0' [ $status -eq 0 ]
fit --version
holds '--version' grep -q -E '^jointfit [0-9.]+$' cards
fit --id 5 power.dat missing.dat all.dat
holds 'several files: the rest still runs, the highest status is returned' [ $status -eq 1 ]
{ printf 'JNORM 1 5\nJNORM 2 8e-3\nJNORM 3 1\n'; law_fields 7 60 1.5 LOAD UNLOAD RELOAD; } > both
near 'several files: ids count up' 1e-10 both

. "$here/records.sh"
. "$here/corrections.sh"
. "$here/iwan.sh"

# ---- the cards are read by jointfem ----

# deck CARDS...: a small deck that includes the files
deck() {
   printf '%s\n' 'UNITS = MM, KGF' 'SPC = 1' 'SUBCASE 1' '  LOAD = 10' '  INCR = 5' 'BEGIN BULK' \
      'BLOCK2  1       1       2       1       0.0     0.0' '+       20.0    10.0' '+       20      21' 'PMARK   20' 'PMARK   21' \
      'PSHELL  1       1       10.0' 'MAT1    1       9500.0          0.25' 'JOINT   1       1       20' \
      "PJOINT  1       1       $shear" 'SPCM    1       1       21' 'FORCE   10      6               100.0   0.0     -1.0' \
      'JINCR   5       5'
   cat "$@"
   echo ENDDATA
}
accepted() { # TITLE: deck.bdf is in order for jointfem; skipped where it does not know JSHEAR yet
   "$jointfem" --check deck.bdf > said 2> stderr
   if [ $? -eq 0 ]; then pass
   elif grep -q "'JSHEAR' is no card" stderr; then echo "skipped: $1: jointfem does not know JSHEAR yet"
   else fail "$1"; fi
}
printf 'JNORM   1       0.008   0.5\n' > norm
for option in --large --small; do
   shear=
   fit $option power.dat
   deck cards > deck.bdf
   accepted "JNORM card, $option"
   shear='1       1'
   fit $option all.dat
   deck norm cards > deck.bdf
   accepted "JSHEAR card, $option"
   fit $option two_headers.dat
   deck norm cards > deck.bdf
   accepted "JSHEAR card with a blank continuation, $option"
   fit $option --branch RELOAD --as LOAD "$here/sanad.dat"
   deck norm cards > deck.bdf
   accepted "JSHEAR card without DMAX, $option"
done

# ---- no room for the output ----

shear=
deck norm > deck.bdf
if [ -c /dev/full ]; then
   "$jointfem" - < deck.bdf > /dev/full 2> stderr
   if [ $? -eq 4 ]; then
      "$jointfit" power.dat > /dev/full 2> stderr
      holds 'no room for the output: status 4' [ $? -eq 4 ]
   else
      echo 'skipped: no room for the output: jointfem does not notice it either'
   fi
fi

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
