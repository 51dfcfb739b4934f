# Normal tests that are not zeroed, stiffnesses, forces, specimens between the gauges: a part of run.sh. The law is lambda = 1.1 p**0.5.

# law P0 L0 NOISE SEED: 'lambda p' at 41 points, p from 0 to 4 above the seating pressure P0, lambda from L0; NOISE of lambda is a share of the largest
law() {
   awk -v p0="$1" -v l0="$2" -v noise="${3:-0}" -v seed="${4:-1}" 'BEGIN {
      print "lambda p"; for (k = 0; k < 50; k++) gauss()
      for (i = 0; i <= 40; i++) { p = i/10; printf "%.17g %.17g\n", l0 + 1.1*(sqrt(p + p0) - sqrt(p0)) + 2.2*noise*gauss(), p } }
      function uniform() { seed = (seed*16807) % 2147483647; return seed/2147483647 }
      function gauss(  s, k) { s = 0; for (k = 0; k < 12; k++) s += uniform(); return s - 6 }'
}
printf 'JNORM 1 1\nJNORM 2 1.1\nJNORM 3 0.5\n' > root_of_p

# ---- the offset ----

law 0 0 > law.dat
fit law.dat
near 'the law itself' 1e-12 root_of_p
holds 'the law itself: no word' [ ! -s stderr ]
# both gauges zeroed at a pressure of 0.4; lambda alone, p from 0.4 on; a gauge that stands 0.35 too high, or too low
law 0.4 0 > both.dat
awk 'NR == 1 { print; next } { printf "%.17g %.17g\n", $1, $2 + 0.4 }' both.dat > lambda_alone.dat
law 0 0.35 > high.dat
law 0 -0.35 | awk 'NR != 2' > low.dat
for kind in both lambda_alone high low; do
   fit $kind.dat
   says "$kind: an offset is told" stderr 'the readings fit better with an offset' '--seat takes it'
   holds "$kind: m is wrong without it" awk '/^JNORM/ { exit !(($4 - 0.5)^2 > 0.03^2) }' cards
   fit --seat $kind.dat
   near "$kind: c and m by --seat" 1e-7 root_of_p
   says "$kind: it is significant" cards 'the offset is significant: F = '
   holds "$kind: no word with --seat" [ ! -s stderr ]
done
fit --seat both.dat
says 'both gauges: what is added' cards '0.4 added to p, 0.695701 to lambda (--seat)'
fit --seat lambda_alone.dat
says 'lambda alone: what is added' cards '0 added to p, 0.695701 to lambda (--seat)'
fit --seat high.dat
says 'a gauge too high: what is added' cards '0 added to p, -0.35 to lambda (--seat)'
# the offset belongs to unloading too
awk 'BEGIN { print "lambda p branch"; for (i = 0; i <= 20; i++) printf "%.17g %.17g LOAD\n", 1.1*(sqrt(i/5 + 0.4) - sqrt(0.4)), i/5
   for (i = 20; i >= 0; i -= 2) printf "%.17g %.17g UNLOAD\n", 1.1*(sqrt(4.4) - sqrt(0.4)) - (20 - i)/5/8, i/5 }' > seated_loop.dat
fit --seat seated_loop.dat
{ cat root_of_p; echo 'JNORM 4 8'; } > with_unloading
near 'unloading from a seating load' 1e-7 with_unloading
holds '... lambda at p = 0 is that of the law' awk '$2 == "UNLOAD" { exit !(($5 - (1.1*sqrt(4.4) - 4.4/8))^2 < 1e-9) }' cards

# with scatter m and c are within four of their standard errors, which follow from the derivatives of the law at these 41 points:
# both gauges, scatter 0.2 % of the largest lambda: 0.020 and 0.074; a gauge too high, 1 %: 0.0088 and 0.021
told=0
for seed in 1 2 3 4 5 6 7 8 9 10; do
   law 0.4 0 0.002 $seed > both.dat
   fit both.dat
   says "both, scatter $seed: told" stderr 'the readings fit better with an offset'
   fit --seat both.dat
   holds "both, scatter $seed: m and c" awk '/^JNORM/ { exit !(($4 - 0.5)^2 < 0.080^2 && ($3 - 1.1)^2 < 0.296^2) }' cards
   law 0 0.35 0.01 $seed > high.dat
   fit high.dat
   says "high, scatter $seed: told" stderr 'the readings fit better with an offset'
   fit --seat high.dat
   holds "high, scatter $seed: m and c" awk '/^JNORM/ { exit !(($4 - 0.5)^2 < 0.0352^2 && ($3 - 1.1)^2 < 0.084^2) }' cards
   law 0 0 0.01 $seed > law.dat
   fit law.dat
   [ -s stderr ] && told=$((told + 1))
   fit --seat law.dat
   grep -q 'the offset is not significant: F = ' cards || told=$((told + 1))
done
holds 'no offset, with scatter: none is found significant' [ $told -eq 0 ]
printf '%s\n' 'lambda p' '0 0' '1 1' '2 4' '3 9' > four.dat
fit --seat four.dat
says 'four points: too few for an offset' stderr '--seat: the points do not fix c, m and an offset: expected 5 points'
holds 'four points: status 2' [ $status -eq 2 ]
fit --seat words.dat
says 'an offset of a shear test' stderr '--seat is for points of normal tests'

# ---- stiffnesses ----

# k = p**0.5/(0.5 1.1)
stiff() { awk -v noise="${1:-0}" -v seed="${2:-1}" 'BEGIN { print "k p"; for (i = 1; i <= 40; i++) { seed = (seed*16807) % 2147483647
   printf "%.17g %.17g\n", sqrt(i/10)/0.55*(1 + noise*(2*seed/2147483647 - 1)), i/10 } }'; }
stiff > stiff.dat
fit stiff.dat
near 'stiffnesses' 1e-12 root_of_p
holds 'stiffnesses: no word' [ ! -s stderr ]
says 'stiffnesses: the residual is that of k' cards '40 points, p 0.1 to 4, k to 3.63636' 'residual of k: rms'
for seed in 1 2 3 4 5; do # four standard errors of m: 0.0212 under a uniform scatter of 20 % at these p
   stiff 0.2 $seed > noisy.dat
   fit noisy.dat
   holds "stiffnesses with scatter, $seed: m within 0.085" awk '/^JNORM/ { exit !(($4 - 0.5)^2 < 0.085^2 && ($3/1.1 - 1)^2 < 0.2^2) }' cards
done
# the same k in other units, to mm and N: c = 1.1E-3
printf 'JNORM 1 1\nJNORM 2 1.1e-3\nJNORM 3 0.5\n' > in_mm
for unit in 'N/um/mm2 1' 'MPa/um 1' 'N/mm3 1000' 'N/mm2/um 1' 'GPa/mm 1' 'kN/mm/mm2 1' 'N/mm/cm2 1e5' 'kgf/cm2/um 10.1971621297793' 'bar/nm 0.01'; do
   set -- $unit
   awk -v factor=$2 -v CONVFMT=%.17g -v unit="$1" 'NR == 1 { print "k [" unit "]; p [MPa]"; next } { print $1*factor "; " $2 }' stiff.dat > unit.dat
   fit --units mm,n unit.dat
   near "stiffnesses in $1" 1e-9 in_mm
done
for unit in N/um um/MPa N//mm2 /um; do
   awk -v unit="$unit" 'NR == 1 { print "k [" unit "]; p [MPa]"; next } { print $1 "; " $2 }' stiff.dat > unit.dat
   fit --units mm,n unit.dat
   says "stiffnesses in $unit" stderr "is no unit of k known to --units" 'of k N/um/mm2'
done
awk 'NR == 1 { print; next } { print 5/sqrt($2), $2 }' stiff.dat > falls.dat
fit falls.dat
says 'stiffness that falls: m is 1' stderr 'the fit gives m = 1.5, but the law allows at most 1'
awk 'NR == 1 { print; next } { print $2*$2, $2 }' stiff.dat > steep.dat
fit steep.dat
says 'stiffness that grows as p squared' stderr 'k grows as p to the power of 2, expected 1 - m'
for row in '0 1' '1 0' '-1 2'; do
   { cat stiff.dat; echo "$row"; } > zero_k.dat
   fit zero_k.dat
   says "stiffness and pressure $row" stderr 'expected p and k above 0 in every row'
done
if fit --plot stiff.gp stiff.dat && grep -q "set xlabel 'p'" stiff.gp && grep -q "set ylabel 'k'" stiff.gp; then pass; else fail 'stiffnesses: the picture'; fi

# ---- forces ----

law 0 0 > law.dat
awk 'NR == 1 { print "lambda [um]; f [kN]"; next } { printf "%.17g; %.17g\n", $1, $2*1.6 }' law.dat > force.dat
fit --area 0.0016 force.dat
printf 'JNORM 1 1\nJNORM 2 %.15g\nJNORM 3 0.5\n' "$(awk 'BEGIN { printf "%.17g", 1.1/sqrt(1000) }')" > per_kilo
near 'a force over an area, without units' 1e-11 per_kilo # 1 kN/m2 is 1E-3 MPa
fit --units mm,n --area 1600 force.dat
near 'a force over an area' 1e-11 in_mm
says 'a force: said' cards 'p is the force f over the area 1600 (--area)' 'p [kN / area]'
fit --units m,n --area 1.6e-3 force.dat
printf 'JNORM 1 1\nJNORM 2 1.1e-9\nJNORM 3 0.5\n' > in_m
near 'a force over an area, in metres' 1e-11 in_m
fit --units mm,n force.dat
says 'a force without its area' stderr 'a column f, a force, needs --area, the area of the joint'
fit --area 1600 law.dat
says 'an area without a force' stderr '--area needs a column f, a force, in place of p'
sed 's/kN/MPa/' force.dat > wrong_force.dat
fit --units mm,n --area 1600 wrong_force.dat
says 'a force in MPa' stderr "'MPa' is no unit of p known to --units"

# ---- specimens between the gauges ----

awk 'NR == 1 { print; next } { printf "%.17g %.17g\n", $1 + 0.19*$2, $2 }' law.dat > specimen.dat
fit --bulk 100,19 specimen.dat
near 'a specimen' 1e-12 root_of_p
says 'a specimen: said' cards 'compression of the specimens taken off: lambda less 0.19 p (--bulk)'
fit --bulk 100,7,50,6 specimen.dat
near 'two specimens' 1e-12 root_of_p
awk 'NR == 1 { print "lambda [um]; p [MPa]"; next } { printf "%.17g; %.17g\n", $1 + 0.19*$2, $2 }' law.dat > specimen_um.dat
fit --units mm,n --bulk 210000,39.9 specimen_um.dat
near 'a specimen in other units than the data' 1e-10 in_mm
awk 'NR == 1 { print; next } { printf "%.17g %.17g\n", 1/(1/$1 + 0.19), $2 }' stiff.dat > specimen_k.dat
fit --bulk 100,19 specimen_k.dat
near 'a specimen in stiffnesses' 1e-11 root_of_p
fit --bulk 100,190 specimen_k.dat
says 'specimens softer than the whole' stderr 'and the specimens alone have 0.526316'
awk 'NR == 1 { print; next } { printf "%.17g %.17g %s\n", $1 - 1.1*sqrt(0.4) + 0 + 0.19*$2, $2, $3 }' seated_loop.dat |
   awk 'NR == 1 { print; next } { printf "%.17g %.17g %s\n", $1 + 1.1*sqrt(0.4), $2, $3 }' > specimen_loop.dat
fit --bulk 100,19 --seat specimen_loop.dat
near 'a specimen under unloading, and a seating load' 1e-7 with_unloading
fit --bulk 100,19 words.dat
says 'a specimen of a shear test' stderr '--bulk is for normal tests'
for value in '' 1 1,2,3 0,1 1,-2 a,b 1,2, ,1; do
   fit --bulk "$value" law.dat
   holds "--bulk '$value': status 1" [ $status -eq 1 ]
   says "--bulk '$value'" stderr "--bulk $value: expected modulus and height of the specimen"
done
for value in '' 0 -1 x; do
   fit --area "$value" law.dat
   says "--area '$value'" stderr "--area $value: expected an area above 0"
done
