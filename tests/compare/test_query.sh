#!/usr/bin/env bash
# Tests query_results: right answers, and an error for a wrong value, a value that is not a number, a missing column or row. Every
# line below is one test.
#
#     test_query.sh QUERY_RESULTS
set -u
export LC_ALL=C
query=$(realpath "$1")
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2
passed=0 failed=0

cat > h.csv <<'END'
# made by hand
stage,increment,node1,branch,lambda,force,blank
1,1,5,LOAD, 1.0E-3,10.0,
1,1,9,OPEN,-2.5D-4,0.0,
1,2,5,LOAD,2.0E-3,20.0,
1,2,9,LOAD,5.0E-4,1.0,
END
sed 's/2.0E-3/NaN/' h.csv > nan.csv
sed 's/2.0E-3/1.0E+999/' h.csv > huge.csv
sed 's/2.0E-3/********/' h.csv > stars.csv
sed 's/2.0E-3/x/' h.csv > word.csv
sed 's/,20.0,$/,20.0/' h.csv > short.csv
sed 's/,20.0,$/,20.0,,/' h.csv > long.csv
sed 's/2.0E-3/2.1E-3/' h.csv > other.csv
sed '$d' h.csv > fewer.csv
head -n 2 h.csv > titles.csv
: > empty.csv
printf 'case,node,w\na,5,1.0\nb,5,2.0\na,9,3.0\n' > r.csv

# expect STATUS [WORDS] -- ARGUMENTS: the exit status, and WORDS in what it says
expect() {
   local status=$1 words=
   shift
   [ "$1" = -- ] || { words=$1; shift; }
   shift
   "$query" "$@" > said 2>&1
   local got=$?
   if [ $got -eq "$status" ] && { [ -z "$words" ] || grep -qF -- "$words" said; } && { [ $got -eq 0 ] || [ -s said ]; }; then
      passed=$((passed + 1))
   else
      failed=$((failed + 1)); echo "FAILED, status $got, not $status: $*"; head -n 3 said
   fi
}
# is VALUE EXPRESSION: of numbers alone
is() { expect 0 -- - all "($2) = $1 within 1e-15*abs($1)"; }

# ---- expressions
is 7 '1 + 2*3';  is 9 '(1 + 2)*3';  is -4 '-2^2';  is 2 '8/2/2';  is 0.125 '2^-3';  is 512 '2^3^2';  is 5 '8 - 2 - 1';  is -2 '-5 + 3'
is 3 'abs(-3)';  is 3 'sqrt(9)';  is 0 'log(exp(1)) - 1';  is 1 'sin(pi/2)';  is -1 'cos(pi)';  is -2 'int(-2.9)';  is 15 '1.5e+3/1E2'
is 1 'min(1, 2)';  is 2 'max(1, 2)';  is 4 'if(1 > 2, 3, 4)';  is 1 '1 < 2 and not 2 < 1';  is 1 '1 = 2 or 2 = 2';  is 0 '1 >= 2'
is 0 'not (1 = 2 or 2 = 2)';  is 1 '1 = 1.1 within 0.2';  is 0 '1 = 1.1 within 0.05';  is 1 '"a" != "b"';  is 1 '1 <= 1 and 1 != 2'
for wrong in '' '1 +' '1 2' '(1' '1)' 'f(1)' 'abs(1, 2)' 'min()' 'pi(1)' '"a' '"a" < "b"' '"a" + 1' 'not "a"' '1 = 1 within' '* 2' '1 . 2' '1 < 2 < 3' \
   '1/0 > 2' '1/0 < 2' '1/0 != 2' 'not 1/0 = 2' 'sqrt(-1) = 1' 'sqrt(-1) != 1' '1 = 1 within 1/0' 'log(0)' '"a"'; do
   expect 2 -- - all "$wrong"
done
expect 1 -- - all '1 = 2'
expect 1 -- - all '0'

# ---- rows, groups, what holds, what is printed
expect 0 '4 1.7500000000000000E+000' -- h.csv count 4 print 'count()' print '1.75'
expect 0 2.0E-3 -- h.csv rows 'increment = 2 and node1 = 5' print lambda
expect 0 OPEN -- h.csv rows 'node1 = 9' rows 'increment = min(increment)' print branch
expect 0 1 -- h.csv print 'sum(branch = "OPEN")'
expect 0 31 -- h.csv print 'sum(force)'
expect 0 -- h.csv all 'max(lambda) = 2e-3 and min(lambda) = -2.5e-4 and first(node1) = 5 and last(node1) = 9'
expect 0 -- h.csv by increment all 'sum(force) = if(increment = 1, 10, 21) and count() = 2'
expect 0 -- h.csv by node1 all 'lambda - before(lambda) = if(node1 = 5, 1e-3, if(increment = 1, -2.5e-4, 7.5e-4)) within 1e-18'
expect 0 -- h.csv by branch by increment all 'count() = if(increment = 2, 2, 1)'
expect 0 -- h.csv by increment rows 'node1 = 9' rows 'increment = 2' all 'sum(force) = 1'
expect 1 "h.csv:4: lambda = -2.5D-4" -- h.csv all 'lambda > 0'
expect 1 '1 of 4 rows without lambda > 0' -- h.csv all 'lambda > 0'
expect 1 '4 rows, expected 3' -- h.csv count 3
expect 1 -- h.csv all 'lambda = 2e-3 within 9e-4'
expect 1 -- h.csv all 'branch = "LOAD"'
expect 1 -- h.csv all '1 = 1' all '1 = 2' all '1 = 1'
expect 2 'no row' -- h.csv rows 'node1 = 6' all '1 = 1'
expect 2 'not the same' -- h.csv print lambda
expect 2 'not the same' -- h.csv print branch
expect 2 "no column 'lamda'" -- h.csv all 'lamda > 0'
expect 2 "no column 'OPEN'" -- h.csv all 'branch = OPEN'
expect 2 "no column 'other.lambda'" -- h.csv all 'lambda = other.lambda'
expect 2 'a text' -- h.csv all 'branch + 1 > 0'
expect 2 'a text' -- h.csv all 'blank = 0'
expect 2 'a text' -- h.csv all 'lambda = "1.0E-3"'

# ---- what no file may hold
for file in nan huge stars word; do
   expect 2 -- $file.csv all 'lambda < 1'
   expect 2 -- $file.csv all 'lambda != 1'
   expect 2 -- $file.csv print 'max(lambda)'
   expect 2 -- h.csv with $file.csv all 'lambda = other.lambda within 1'
done
for file in nan stars; do expect 2 'in the column' -- $file.csv with $file.csv all 'lambda = other.lambda'; done
expect 2 'short.csv:5: fewer' -- short.csv count 4
expect 2 'long.csv:5: more' -- long.csv count 4
expect 2 'no row' -- titles.csv count 0
expect 2 'no titles' -- empty.csv count 0
expect 2 none.csv -- none.csv count 0
expect 2 none.csv -- h.csv with none.csv count 4

# ---- two files
expect 0 -- h.csv with h.csv all 'lambda = other.lambda and branch = other.branch and blank = other.blank'
expect 1 'other.lambda = 2.1E-3' -- h.csv with other.csv all 'lambda = other.lambda'
expect 0 -- h.csv with other.csv all 'lambda = other.lambda within 1.1e-4'
expect 2 'fewer.csv' -- h.csv with fewer.csv count 4
expect 2 'fewer.csv' -- fewer.csv with h.csv count 3
expect 0 -- h.csv with r.csv on node=node1 on 'case="a"' all 'other.w = if(node1 = 5, 1, 3)'
expect 0 -- h.csv with h.csv on node1 on 'increment=3 - increment' rows 'increment = 1' all 'other.lambda > lambda'
expect 0 -- r.csv rows 'node = 9' with h.csv on node1=node on increment=2 all 'other.force = 1'
expect 2 '2 rows of r.csv' -- h.csv with r.csv on node=node1 count 4
expect 2 '0 rows of r.csv' -- h.csv with r.csv on node=node1+1 on 'case="a"' count 4
expect 2 "no column 'nod'" -- h.csv with r.csv on nod=node1 count 4
expect 2 "no column 'node'" -- h.csv with r.csv on node count 4
expect 2 -- h.csv on node1 count 4

# ---- usage
for arguments in '' h.csv 'h.csv count' 'h.csv 4' 'h.csv sum force' 'count 4 h.csv'; do
   # shellcheck disable=SC2086
   expect 2 -- $arguments
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
