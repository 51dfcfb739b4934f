# Test data as laboratories record them, a part of run.sh: numbered runs, records in the order of time, loops of normal tests,
# units, offsets, separators, pictures.

# ---- Fig. 1(b): three ways down at each of three pressures, exact ----

{ echo 'JSHEAR 1 1'
  for first in 2 9 17; do
     law='40 90 100 50 2000'; [ $first = 2 ] && law='60 100 -500 -300 1000'
     echo "$law" | awk -v first=$first '{ for (k = 1; k <= 5; k++) print "JSHEAR", first + k - 1, $k; print "JSHEAR", first + 5, 0 }'
  done
  printf 'JSHEAR 25 0.6\nJSHEAR 26 0.03\n'; } > fig1b
for form in record run words stretches turned; do
   awk -v form=$form -f "$here/fig1b.awk" > $form.dat
   fit $form.dat
   holds "Fig. 1(b), $form: status 0 and no word" [ "$status $(wc -c < stderr)" = '0 0' ]
   near "Fig. 1(b), $form: the coefficients" 1e-9 fig1b
   loading=75                # a name ends where it says, a record where the loading curve is met: in A already
   [[ $form = @(words|stretches) ]] || loading=81
   says "Fig. 1(b), $form: each way has a start of its own" cards "$loading points at 3 pressures" '72 points at 3 pressures' 'b0'
   holds "Fig. 1(b), $form: 9 of unloading, 6 of reloading" \
      [ "$(awk '$2 ~ /^[0-9]+$/ && NF == 7' cards | wc -l)" -eq 15 ]
   fit --joint-fit $form.dat
   near "Fig. 1(b), $form: in one step" 1e-9 fig1b
done
fit stretches.dat
holds 'stretches of one branch are runs, from 1 on' \
   [ "$(awk '$2 ~ /^[0-9]+$/ && NF == 7 { printf "%d ", $2 }' cards)" = '2 5 8 10 13 16 18 21 24 3 6 11 14 19 22 ' ]
fit record.dat
says 'a record: its turns and its noise band are said' cards '195 rows in the order of time, 3 tests, 15 turns; noise band 1 % of the range' \
   '3E-4 of d, 0.03015 of tau'
# reloading that goes on past A, d = 0.03, below the loading curve: five of its rows at each pressure
awk 'function load(d) { return (60 + 100 * p) * d - (500 + 300 * p) * d^2 + 1000 * d^3 }
   function row(d, tau) { printf "%.17g %.17g %g\n", d, tau, p }
   BEGIN { print "d tau p"
      for (i = 1; i <= 3; i++) { p = 0.2 * i; k = load(0.03) / 0.03
         for (j = 0; j <= 12; j++) row(0.03 * j / 12, load(0.03 * j / 12))
         for (j = 1; j <= 8; j++) row(0.03 - 0.012 * j / 8, load(0.03) - 1.5 * k * 0.012 * j / 8)
         for (j = 1; j <= 12; j++) row(0.018 + 0.02 * j / 12, load(0.03) - 1.5 * k * 0.012 + 0.6 * k * 0.02 * j / 12) } }' > past.dat
fit past.dat
says 'a record past A: rows off the loading curve are left out' cards '5 rows left out: past point A and off the loading curve, p = 0.2' 'p = 0.4' 'p = 0.6'
# deflections that run against their stresses: no loading curve lies ahead of a path that turns back
awk 'NR > 1 { $1 = -$1 } { print }' record.dat > against.dat
fit --zero against.dat
holds 'd against tau: told that the slope is negative' [ "$status" -eq 0 ]
says 'd against tau: told that the slope is negative' stderr 'LOAD: the slope of tau becomes zero or negative'
awk -v form=unloading -f "$here/fig1b.awk" > unloading.dat
fit unloading.dat
says 'unloading alone: the continuation' cards 'The UNLOAD continuation' 'b1 = 40 + 90 p' 'b2 = 100 + 50 p' 'b3 = 2000 + 0 p'
says 'unloading alone: the option that helps' stderr '--branch UNLOAD --as LOAD'
fit --branch UNLOAD --as LOAD unloading.dat
awk '$2 < 8 || $2 == 25' fig1b | awk 'NR == 1 || $2 == 25 { print; next } { print $1, $2, a[split("40 90 100 50 2000 0", a) * 0 + $2 - 1] }' > as_load
{ cat as_load; echo 'JSHEAR 26 0.0285'; } > unload_as_load
near 'unloading alone, as LOAD' 1e-9 unload_as_load
# three stretches of one name in sequence, a part of each only: they end where d turns back
awk 'NR == 1 { print "d tau p branch"; next } { print $1, $2, $3, "UNLOAD" }' unloading.dat > sequence.dat
fit --branch UNLOAD --as LOAD sequence.dat
near 'three UNLOAD stretches in sequence' 1e-9 unload_as_load
holds 'three UNLOAD stretches in sequence: nine runs' [ "$(awk '$2 ~ /^[0-9]+$/ && NF == 7' cards | wc -l)" -eq 9 ]
awk 'NR == 1 { print "d tau p branch"; next } { print $1, $2, $3, "UNLOAD" }' unloading.dat | awk 'NR == 1 || NR % 2' > every_second.dat
fit --branch UNLOAD --as LOAD every_second.dat
holds 'every second row of them: nine runs' [ "$(awk '$2 ~ /^[0-9]+$/ && NF == 7' cards | wc -l)" -eq 9 ]
awk 'NR == 1 { print "d tau p branch"; next } { print $1, $2, $3, "UNLOAD" }' unloading.dat | awk 'NR > 1 { $1 += 2e-4 * (NR % 3 - 1) } { print }' > jitter.dat
fit --branch UNLOAD --as LOAD --noise 0.05 jitter.dat
holds 'noise of d is no turn of a stretch: nine runs' [ "$(awk '$2 ~ /^[0-9]+$/ && NF == 7' cards | wc -l)" -eq 9 ]
awk 'NR == 1 { print "d tau p branch"; next } { print }' run.dat > numbers.dat
fit numbers.dat
near 'numbers in the column branch are runs' 1e-9 fig1b
for n in 3 4 40; do
   awk -v form=record -v n=$n -f "$here/fig1b.awk" > sparse.dat
   fit sparse.dat
   near "a record with $n points a way" 1e-9 fig1b
done
# the same test once more, at the same pressure: back at the first reading a specimen starts anew
{ cat record.dat; sed -n '2,66p' record.dat; } > again.dat
fit again.dat
near 'a test is repeated' 1e-9 fig1b
says 'a test is repeated: four tests' cards '4 tests, 20 turns'
awk 'NR > 1 && $3 < 0.3' run.dat | sed '1i d tau p run' > one.dat
fit --one-pressure one.dat
says 'one pressure, with --one-pressure' cards 'a1 = 80 + 0 p' 'b1 = 58 + 0 p' 'b3 = 2000 + 0 p'
fit one.dat
says 'one pressure: the option that helps' stderr '--one-pressure'
awk 'NR > 1 { $3 *= 1 + 0.004 * (NR % 5) } { print }' record.dat > wobbly.dat
fit wobbly.dat
says 'pressures that wobble: the option that helps' stderr '--p-tolerance 0.05'
fit --p-tolerance 0.05 wobbly.dat
holds 'pressures that wobble: taken with --p-tolerance' [ $status -eq 0 ]
says 'pressures that wobble: three tests' cards '3 tests, 15 turns'

# ---- records made by jointfem: the law of the deck comes back ----

# its reloading meets the loading curve before point A
law_of_cycles='20 200 -2000 -12000 5e4 3e5 20 200 500 3000 0 0 35 200 0 3000 0 0'
echo "$law_of_cycles" | awk '{ print "JSHEAR 1 1"
   for (k = 1; k <= 18; k++) print "JSHEAR", k + 1 + (k > 6) + 2 * (k > 12), $k; print "JSHEAR 25 0.5"; print "JSHEAR 26 0.01" }' > cycles
cycles() { # PRESSURE: rows d tau p of input/shear_cycles.bdf under it, the loads by its share of 0.5
   sed -E "s/50\.0( +0\.0 +-1\.0)/$(awk -v p=$1 'BEGIN { printf "%.1f", 100 * p }')\1/" "$here/../../input/shear_cycles.bdf" |
      awk -v share="$(awk -v p=$1 'BEGIN { print p / 0.5 }')" \
         '/^LOAD /{ printf "LOAD,%d,1.,1.,1,%.4f,12\n", $2, $6 * share; next } { print }' > cycles.bdf
   timeout 60 "$jointfem" -q cycles.bdf > /dev/null 2>&1
   awk -F, 'NR > 1 { print $18, $19, $14 }' cycles.joint.csv
}
{ echo 'd tau p'; cycles 0.5; cycles 0.4; } > own_record.dat
holds 'a record of jointfem: reloading meets the curve' [ "$(wc -l < own_record.dat)" -eq 163 ]
fit own_record.dat
near 'a record of jointfem gives the law of its deck back' 1e-6 cycles
sed '/^JSHEAR/,/^+ .*1\.0 .*0\.012/d' cycles.bdf | awk '/^ENDDATA/ { while (getline line < "cards") print line } { print }' > closes.bdf
timeout 60 "$jointfem" -q closes.bdf > /dev/null 2>&1
holds 'a record of jointfem: the closure is that of the listing' awk '
   FNR == NR { if ($2 == "closure") { share = $3; p = $11; d = $14 } next }
   $1 == "CLOSURE" { found = (share - $2)^2 < 0.0051^2 && (p / $11 - 1)^2 < 1e-8 && (d / $14 - 1)^2 < 1e-4 } END { exit !found }' \
   <(tr -d ',' < cards) closes.out
says 'a record of jointfem: that alone is warned of' stderr 'WARNING: reloading misses point A by more than 5 % of tau_r'
awk 'NR > 1 { seed = (seed * 16807 + 11) % 2147483647; $2 *= 1 + 0.004 * (2 * seed / 2147483647 - 1) } { print }' own_record.dat > noisy_record.dat
fit noisy_record.dat
awk -f "$here/card_values.awk" cards > got
holds 'a noisy record of jointfem: c1 at p = 0.45 within 5 per cent' awk '$2 == 17 || $2 == 18 { c += $2 == 17 ? $3 : 0.45 * $3 }
   END { exit !(c > 118 && c < 132) }' got

# thin loops that close, with noise: what lies in doubt near A stays with the reloading that comes to it
awk -v form=record -v n=20 -f "$here/fig1b.awk" | awk 'NR == 1 { print; next } { seed = (seed * 16807 + 11) % 2147483647
   $2 += 0.015 * (2 * seed / 2147483647 - 1); print }' > thin.dat
fit thin.dat
holds 'thin loops with noise: nine of ten points of reloading' awk '/RELOAD/ { exit !($3 >= 108 && $3 <= 122) }' cards

# ---- branches of one shape: d from zero or from the start of the branch ----

# loop NAME AMPLITUDE PRESSURE BACK: the card in `cards` moved to the amplitude, to BACK and to the amplitude again; its loss is in LOSS
loop() {
   { printf '%s\n' 'METHOD = NEWTON' 'SPC = 1' 'SUBCASE 1' 'LOAD = 1' 'SUBCASE 2' 'LOAD = 2' 'SUBCASE 3' 'LOAD = 3' 'SUBCASE 4' 'LOAD = 2' \
      'BEGIN BULK' GRID,1 CJOINT,1,1,1,,1.,0.,-1. PJOINT,1,1,1 JNORM,1,1.,1.,1. SPC1,1,1,1
     for k in 1 2 3; do echo "FORCE,$k,1,,$3,0.,-1."; done
     printf 'SPCD,2,1,1,%.12f\nSPCD,3,1,1,%.12f\n' "$2" "$4"
     cat cards; echo ENDDATA; } > loop.bdf
   timeout 60 "$jointfem" -q loop.bdf > /dev/null 2>&1
   loss=$(awk '/ENERGY OF JOINTS, STAGE [34]/ { on = 1 } /ANSWER/ { on = 0 } on && $1 == 1 { kept += $NF } END { printf "%.9e", kept }' loop.out)
}
# losses NAME FORM TOLERANCE: of the card, against -(4/3) a2 h^3 - 2 a3 h^4, h half the way of the cycle
losses() {
   for p in 0.25 0.5 1.; do
      for top in 0.003 0.006 0.009 0.012; do
         back=$(awk -v form=$2 -v p=$p -f "$here/masing.awk" | awk -v p=$p -v top=$top '$3 == p + 0 { if (($1 / top - 1)^2 < 1e-12) n = NR
            if (n && NR == n + 12) { printf "%.15g", $1; exit } }')
         loop "$1" $top $p "$back"
         holds "$1: loss at p = $p, d = $top" awk -v p=$p -v h="$(awk -v a=$top -v b="$back" 'BEGIN { printf "%.15g", (a - b)/2 }')" \
            -v loss="$loss" -v e=$3 'BEGIN { x = 4/3*(1500 + 1000*p)*h^3 - 2*(2e4 + 2e4*p)*h^4; exit !((loss/x - 1)^2 < e^2) }'
      done
   done
}
{ echo 'JSHEAR 1 1'
  for first in 2 9 17; do
     law='50 40 -750 -500 5000 5000'; [ $first = 2 ] && law='50 40 -1500 -1000 2e4 2e4'
     echo "$law" | awk -v first=$first '{ for (k = 1; k <= 6; k++) print "JSHEAR", first + k - 1, $k }'
  done
  printf 'JSHEAR 25 1.0\nJSHEAR 26 0.012\nJSHEAR 27 BRANCH\n'; } > one_shape
for form in zero full words; do
   awk -v form=$form -f "$here/masing.awk" > masing.dat
   for option in '' --joint-fit; do
      fit $option masing.dat
      name="branches of one shape, $form${option:+, }$option"
      holds "$name: status 0 and no word" [ "$status $(wc -c < stderr)" = '0 0' ]
      near "$name: the coefficients" 1e-6 one_shape
      says "$name: said" cards 'from the start of the branch (BRANCH); BRANCH is nearer' 'one shape with unloading, fitted together'
   done
   [ $form = words ] || losses "branches of one shape, $form" $form 1e-3
done
# with noise of a thousandth of the largest stress: the losses of full cycles within 1 per cent
awk -v form=full -v n=60 -v noise=0.0008 -f "$here/masing.awk" > masing.dat
fit masing.dat
says 'one shape with noise' cards 'BRANCH is nearer' 'one shape with unloading'
losses 'one shape with noise' full 0.01
# one amplitude at each pressure: both readings say the same
awk -v form=zero -v most=1 -f "$here/masing.awk" > masing.dat
fit masing.dat
says 'one amplitude: said' cards 'no difference: CURVE, the default'
holds 'one amplitude: no ORIGIN' [ "$(awk -f "$here/card_values.awk" cards | grep -c ' 27 ')" -eq 0 ]
# reloading steeper by a twentieth: two shapes, each its own coefficients
awk -v form=words -v steeper=0.05 -f "$here/masing.awk" > masing.dat
fit masing.dat
says 'two shapes' cards 'BRANCH is nearer' 'b2 = -750 - 500 p' 'c2 = -787.5 - 525 p'
# data of the printed equations
fit record.dat
says 'branches as printed' cards 'CURVE is nearer'
fit own_record.dat
says 'a record of jointfem by the printed equations' cards 'CURVE is nearer'
# the picture has both
awk -v form=zero -f "$here/masing.awk" > masing.dat
fit --plot masing.gp masing.dat
holds 'the picture of both' [ "$(grep -c "title 'ORIGIN CURVE'" masing.gp) $(grep -c "title 'RELOAD, p = 0.5'" masing.gp)" = '1 1' ]

# ---- a residual that is warned of ----

awk 'NR == 8 { $2 += 0.5 } { print }' words.dat > one_off.dat
fit one_off.dat
says 'a reading that is off' stderr 'LOAD: tau lies up to 0.' 'off the law on the card, more than 5 % of the largest tau'
awk 'NR == 8 { $2 += 0.01 } { print }' words.dat > one_off.dat
fit one_off.dat
holds 'a reading that is off by less' [ "$(grep -c 'off the law' stderr)" -eq 0 ]
awk 'BEGIN { print "lambda p"; for (i = 0; i <= 20; i++) print 0.8 * sqrt(i / 4) + (i == 7 ? 0.2 : 0), i / 4 }' > one_off.dat
fit --unordered one_off.dat
says 'a normal reading that is off' stderr 'lambda lies up to 0.1' 'more than 5 % of the largest lambda'

# a record may hold a little of a branch
awk -v form=words -f "$here/fig1b.awk" | awk '$4 == "RELOAD" && n[$3, $5]++ { next } { print $1, $2, $3 }' > little.dat
fit little.dat
holds 'a little of a branch: status 0' [ $status -eq 0 ]
says 'a little of a branch: it is left out with a warning' stderr 'WARNING: RELOAD, p = 0.2' 'fix no cubic' '--joint-fit'

# ---- normal tests with loops ----

printf 'JNORM 1 1\nJNORM 2 2.5\nJNORM 3 0.5\nJNORM 4 3\n' > loops
awk -f "$here/normal_loops.awk" > loops.dat
fit loops.dat
near 'loops without noise' 1e-5 loops
says 'loops: no part of the loading' cards '200 rows in the order of time, 1 test, 6 turns' '53 points of loading' \
   'from 6 lines through 153 points apart from loading'
says 'loops in um and MPa: the option that helps' stderr 'um and MPa are not consistent units of a deck: --units mm,n'
for seed in 1 2 3 4 5 6; do
   awk -v noise=0.01 -v seed=$seed -f "$here/normal_loops.awk" > noisy_loops.dat
   fit noisy_loops.dat
   awk -f "$here/card_values.awk" cards > got
   holds "loops with 1 per cent noise, $seed: c and m within 2, E_u within 5 per cent" awk '
      function off(expected) { return ($3 - expected) / expected < 0 ? (expected - $3) / expected : ($3 - expected) / expected }
      $2 == 2 && off(2.5) <= 0.02 || $2 == 3 && off(0.5) <= 0.02 || $2 == 4 && off(3) <= 0.05 { good++ } END { exit good != 3 }' got
   says "loops with noise, $seed: six lines" cards '1 test, 6 turns' 'from 6 lines'
done
fit --unordered noisy_loops.dat
says 'loops with --unordered: all rows are loading' cards '200 points, p'
holds 'loops with --unordered: no E_u' [ "$(awk -f "$here/card_values.awk" cards | wc -l)" -eq 3 ]
awk 'NR == 1 { print "p; lambda; run"; next }
     { split($0, v, "; "); if (NR > 3 && (v[2] - p) * way < 0) run++; if (v[2] != p) way = v[2] - p; p = v[2]; print v[2] "; " v[1] "; " run + 1 }' loops.dat > loop_runs.dat
fit loop_runs.dat
near 'loops with numbers of runs' 1e-5 loops
awk 'BEGIN { print "lambda p branch" }
     NR > 1 { split($0, v, "; "); print v[1], v[2], (v[1] > 2.5 * sqrt(v[2]) + 1e-4 ? (v[2] < p ? "UNLOAD" : "RELOAD") : "LOAD"); p = v[2] }' loops.dat > loop_words.dat
fit loop_words.dat
near 'loops with the names of branches' 1e-5 loops
printf '%s\n' 'lambda p' '0 0' '1 1' '2 4' '3 9' '2 6' '1 3' '0.5 1.5' '1 3' '2 6' '3 9' '4 16' > flat.dat
fit flat.dat
says 'E_u below the slope of the loading curve' stderr 'E_u = 3 is below the slope of the loading curve at p = 16, 8: unloading would be less steep than loading, and the set would be negative'
printf '%s\n' 'p lambda' '0 0' '1 2' '2 3' '3 3.5' '2 3.6' '1 3.7' '0 3.8' > back.dat
fit back.dat
says 'no line of unloading that rises' stderr 'lambda does not fall with p in unloading'
holds 'no line of unloading that rises: EU is blank' [ "$(awk -f "$here/card_values.awk" cards | wc -l)" -eq 3 ]

# ---- rows that are no record ----

sort -R --random-source=/dev/zero noisy_power.dat | grep -v lambda | sed '1i lambda p' > shuffled.dat
fit shuffled.dat
holds 'rows in no order: status 2' [ $status -eq 2 ]
says 'rows in no order: the options that help' stderr 'too often for a record' '--unordered' '--noise' 'a column branch or run'
fit --unordered shuffled.dat
printf 'JNORM 1 1\nJNORM 2 0.8\nJNORM 3 0.5\n' > power
near 'rows in no order, with --unordered' 0.02 power
printf '%s\n' 'lambda p' '2 4' '1.5 2.25' '1 1' > falling.dat
fit falling.dat
says 'a test that falls from the first row' stderr 'no loading: p falls' '--unordered'
fit --unordered falling.dat
printf 'JNORM 1 1\nJNORM 2 1\nJNORM 3 0.5\n' > root
near 'a test that falls, with --unordered' 1e-10 root
awk 'BEGIN { print "lambda p"; for (i = 0; i <= 40; i++) { p = i / 4; printf "%.17g %.17g\n", 0.8 * sqrt(p), p + (i % 3 == 1 ? 0.4 : 0) } }' > ripple.dat
fit ripple.dat
says 'a ripple on p is found to be noise' cards '1 test, 0 turns'
fit --noise 0.01 ripple.dat
says 'a ripple on p, with a narrow --noise' stderr 'too often for a record'
fit --noise 0.1 loops.dat
says '--noise is printed' cards 'noise band 10 % of the range (--noise)'

# ---- the first reading ----

awk 'NR > 1 { split($0, v, "; "); print v[1] - 0.05, v[2] - 0.03; next } { print "lambda p" }' loops.dat > offset.dat
fit offset.dat
near 'a first reading below zero is an offset' 1e-5 loops
says 'an offset is said' cards 'the first reading of lambda, -0.05, subtracted from 200 rows' 'the first reading of p, -0.03, subtracted from 200 rows'
awk 'NR > 1 { split($0, v, "; "); print v[1] + 3, v[2] - 1; next } { print "lambda p" }' loops.dat > far_off.dat
fit far_off.dat
says 'a first reading too far below zero: the options that help' stderr "P: '-1' is negative" '--zero' '--noise'
fit --zero far_off.dat
near '--zero' 1e-5 loops
awk -v CONVFMT=%.17g 'NR > 1 { $1 -= 1e-4; $2 -= 0.01 } { print }' record.dat > offset_shear.dat
fit offset_shear.dat
near 'an offset of a shear test' 1e-8 fig1b
awk -v CONVFMT=%.17g 'NR > 1 { $1 -= 1e-4; $2 -= 0.01 } { print }' words.dat > offset_words.dat
fit offset_words.dat
holds 'an offset of rows that name their branches: status 0' [ $status -eq 0 ]
says 'an offset of rows that name their branches' cards 'the first reading of d, -1E-4'

# ---- headings, separators, units ----

for units in 'mm,n 2.5e-3 0.5 3000' 'mm,kgf 7.8288761e-3 0.5 305.91486' 'm,n 2.5e-9 0.5 3e12' 'in,lbf 8.1725e-6 0.5 1.1052e7'; do
   set -- $units
   fit --units "$1" loops.dat
   printf 'JNORM 1 1\nJNORM 2 %s\nJNORM 3 %s\nJNORM 4 %s\n' "$2" "$3" "$4" > converted
   near "--units $1" 2e-4 converted
   holds "--units $1: no word" [ ! -s stderr ]
done
fit --units mm,kgf loops.dat
says '--units is said' cards 'MM, KGF/MM2, converted from p [MPa], lambda [um]'
sed 's/\./,/g' loops.dat > german.dat
fit german.dat
near 'semicolons and decimal commas' 1e-5 loops
tr ';' '\t' < german.dat > tabs.dat
fit --decimal-comma tabs.dat
near 'tabs and decimal commas' 1e-5 loops
awk -F';' 'NR > 1 { printf "%.8e\t%.8e\n", $1, $2; next } { gsub(/;/, "\t"); print }' loops.dat > wide.dat
fit wide.dat
near 'tabs behind entries of fourteen characters' 1e-5 loops
fit tabs.dat
says 'decimal commas: the option that helps' stderr 'entries on this line: 4, expected 2' '--decimal-comma'
tr ';' ',' < loops.dat | sed 's/$/,ok/; 1s/.*/"p (MPa)","Weg","remark"/' > foreign.dat
fit foreign.dat
says 'foreign headings: the option that helps' stderr "'Weg' is not a column of jointfit (--columns"
fit --columns 'lambda [um],p [MPa],-' --units mm,n foreign.dat
printf 'JNORM 1 1\nJNORM 2 2.5e-3\nJNORM 3 0.5\nJNORM 4 3000\n' > converted
near '--columns' 1e-5 converted
sed 1d loops.dat > headless.dat
fit headless.dat
says 'no headings: the option that helps' stderr 'numbers before the header line' '--columns'
fit --columns 'lambda,p' headless.dat
near '--columns without headings' 1e-5 loops
{ echo 'UNITS = UM, MPA'; sed '1s/.*/lambda p/' loops.dat; } > named.dat
fit --units mm,n named.dat
near 'units of the line UNITS =' 1e-5 converted
sed '1s/.*/d [mm], tau [N\/mm²], p [MPa]/' record.dat > units_shear.dat
fit --units m,n units_shear.dat
awk '{ k = $2 > 1 && $2 < 25 ? int(($2 - 2) % 8 % 7 / 2) : 0 } $2 == 25 { $3 *= 1e6 } $2 == 26 { $3 *= 1e-3 }
     $2 > 1 && $2 < 25 { j = $2 < 8 ? $2 - 2 : $2 < 16 ? $2 - 9 : $2 - 17; k = int(j / 2) + 1; $3 *= 1e3^k; if (j % 2 == 0) $3 *= 1e6 }
     { printf "%s %d %.17g\n", $1, $2, $3 }' fig1b > fig1b_m
near '--units of a shear test' 1e-8 fig1b_m
{ echo 'UNITS = UM, MPA'; awk '!/^#|UNITS/' "$here/sanad.dat"; } > units_cubics.dat
fit --units mm,n --branch RELOAD --as LOAD units_cubics.dat
awk '$2 > 1 && $2 < 8 { $3 *= 1e3^int($2 / 2) } { print $1, $2, sprintf("%.17g", $3) }' sanad > sanad_mm
near '--units of cubics' 1e-10 sanad_mm

# ---- more bad data ----

bad 'mixed branches' 'line 3' 'BRANCH: a number, but other rows name it' <<< $'d tau p branch\n1 1 1 LOAD\n1 1 1 2'
bad 'run of no number' "RUN: '1.5' is not the number of a run" '      ^^^' <<< $'d tau p run\n1 1 1 1.5'
bad 'cubics with a run' "BRANCH: '1', expected LOAD, UNLOAD or RELOAD" <<< $'c1 c2 c3 p branch\n1 1 1 1 1'
bad 'units of two kinds in headings' 'line 3' 'p in kgf/mm2, but above in MPa: --units mm,n' \
   <<< $'lambda [um] p [MPa]\n1 1\nlambda [um] p [kgf/mm2]\n2 2'
bad 'columns that the tests do not have' 'these columns are not a known combination' '--columns' <<< $'d p\n1 2'
fit --units mm,n power.dat
says '--units without units' stderr 'the unit of p is missing' 'lambda [um]' 'UNITS = um, MPa'
sed '1s/.*/p [stone], lambda [um]/' power.dat > stones.dat
fit --units mm,n stones.dat
says '--units with a unit that is none' stderr "'stone' is no unit of p"
fit stones.dat
holds 'a unit that is none, without --units' [ $status -eq 0 ]
sed '1s/.*/d [mm] tau [N\/mm2] p [kgf\/mm2]/' record.dat > mixed.dat
fit mixed.dat
says 'two units of stress: the option that helps' stderr 'N/mm2 and kgf/mm2 are not consistent units of a deck: --units mm,n'
usage '--units of one' '--units mm: expected the units of length and force' --units mm all.dat
usage '--noise too wide' '--noise 0.7: expected a share' --noise 0.7 all.dat
usage '--columns without a value' '--columns : expected the names' all.dat --columns
usage '--plot without a value' '--plot : expected the name' all.dat --plot

# ---- the worked examples of the manual ----

# block HEADING N: the Nth block between ``` below ### HEADING in input/README.md
block() {
   awk -v heading="### $1" -v wanted="$2" '/^### / { on = $0 == heading } !on { next }
      /^```/ { inside = !inside; n += inside; next } inside && n == wanted' "$here/../../input/README.md"
}
# alike FILE FILE: word for word, numbers but for their last digits, which the kernel of the BLAS rules
alike() {
   awk 'NR == FNR { line[FNR] = $0; n = FNR; next }
      { m = FNR; count = split($0, b); if (split(line[FNR], a) != count) bad = 1
        for (i = 1; i <= count; i++) { d = a[i] - b[i]; if (d < 0) d = -d; size = a[i] < 0 ? -a[i] : a[i] + 0
           if (a[i] "" != b[i] "" && !(size > 0 && d <= 1e-9 * size)) bad = 1 } }
      END { exit bad || n != m }' "$1" "$2"
}
block 'A normal test' 1 > normal.csv
block 'A normal test' 2 > expected
block 'A shear test' 1 > shear.csv
fit --units mm,n normal.csv
holds 'manual: the normal test' alike expected cards
fit --units mm,n --small --id 7 shear.csv
block 'A shear test' 2 > expected
tail -n "$(wc -l < expected)" cards > last_cards
holds 'manual: the shear test' alike expected last_cards

# ---- pictures ----

fit --plot fit.gp record.dat
holds '--plot: status 0' [ $status -eq 0 ]
says '--plot of shear' fit.gp "set output 'fit.svg'" "title 'UNLOAD, p = 0.4'" "set ylabel 'tau'"
fit --plot fit.gp --units mm,n loops.dat
says '--plot of a normal test' fit.gp "title 'LOAD'" "title 'RELOAD'" "set xlabel 'lambda [MM]'"
fit --plot pictures.gp --id 5 --branch RELOAD --as LOAD "$here/sanad.dat" all.dat
says '--plot of several files' pictures.gp "set output 'pictures_5.svg'" "set output 'pictures_6.svg'" "title 'a3'"
fit --plot nowhere/fit.gp record.dat
holds '--plot that cannot be written: status 4' [ $status -eq 4 ]
says '--plot that cannot be written' stderr 'nowhere/fit.gp cannot be written'
cp record.dat kept.dat
ln -s kept.dat soft.dat
ln kept.dat hard.dat
mkdir aside
for plot in kept.dat ./aside/../kept.dat soft.dat hard.dat; do
   fit --plot $plot kept.dat
   holds "--plot $plot, which is the data: status 1" [ $status -eq 1 ]
   says "--plot $plot, which is the data" stderr "--plot $plot would overwrite the data file kept.dat"
done
fit --plot kept.dat all.dat soft.dat
says '--plot of what a link to the data leads to' stderr '--plot kept.dat would overwrite the data file soft.dat'
timeout 60 "$jointfit" kept.dat >> kept.dat 2> stderr
says 'cards at the end of the data' stderr 'the cards would be written to the data file kept.dat'
holds 'the data are as they were' cmp -s record.dat kept.dat
mkfifo pipe.gp
fit --plot pipe.gp record.dat
holds '--plot onto a pipe: status 4' [ $status -eq 4 ]
says '--plot onto a pipe' stderr 'pipe.gp is a pipe and no file'
if command -v gnuplot > /dev/null; then
   gnuplot fit.gp pictures.gp > said 2>&1
   holds '--plot: gnuplot draws' [ ! -s said -a -s fit.svg -a -s pictures_5.svg -a -s pictures_6.svg ]
else
   echo 'skipped: pictures: there is no gnuplot'
fi
