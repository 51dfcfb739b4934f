# JIWAN cards from made tests: loops of tau over d, and losses over amplitudes, by Segalman's closed forms and Masing's rule.

# iwan KIND [NAME=VALUE...]: KIND loops: each pressure of PS from rest through amplitudes of 0.3, 0.6, 0.9 and MOST times phi_max;
# loss: from LOW to MOST times phi_max, TIP=1 with tau. NOISE relative
iwan() {
   local kind=$1
   shift
   awk -v kind="$kind" '
      function random() { seed = (seed * 16807) % 2147483647; return 2 * seed / 2147483647 - 1 }
      function of(p) { ph = phi * p / pref; r = kt * (chi + 1) / ((1 + beta) * ph^(chi + 1)) }
      function tau(d) { return d < ph ? kt * d - r * d^(chi + 2) / ((chi + 1) * (chi + 2)) : fs * ph / phi }
      function loss(d) { return d < ph ? 4 * r * d^(chi + 3) / ((chi + 2) * (chi + 3)) : 4 * r * ph^(chi + 3) / ((chi + 2) * (chi + 3)) + 4 * fs * ph / phi * (d - ph) }
      function put(d, t, p) { printf "%.17g %.17g %.17g\n", d, t * (1 + noise * random()), p }
      BEGIN {
         seed = 4711; fs = 2.4; kt = 1600; chi = -0.6; beta = 0.4; pref = 8; noise = 0; low = 0.01; most = kind == "loops" ? 1.4 : 5; ps = "4 8"
         for (i = 1; i < ARGC; i++) { split(ARGV[i], x, "="); if (x[1] == "chi") chi = x[2]; if (x[1] == "beta") beta = x[2]; if (x[1] == "noise") noise = x[2]
            if (x[1] == "most") most = x[2]; if (x[1] == "tip") tip = x[2] }
         phi = fs * (1 + beta) / (kt * (beta + (chi + 1) / (chi + 2)))
         if (kind == "loss") {
            print tip ? "d loss tau p" : "d loss p"; of(pref)
            for (i = 0; i < 30; i++) { d = phi * low * (most / low)^(i / 29); printf "%.17g %.17g %s%.17g\n", d, loss(d) * (1 + noise * random()), tip ? tau(d) " " : "", pref }
            exit
         }
         n = split(ps, p, " ")
         for (k = 1; k <= n; k++) {
            print "d tau p"; of(p[k]); put(0, 0, p[k]); from = 0; before = 0
            for (a = 1; a <= 4; a++) {
               to = ph * (a == 4 ? most : 0.3 * a < most ? 0.3 * a : most)
               for (i = 1; i <= 25; i++) { d = from + (to - from) * i / 25; put(d, d > before ? tau(d) : 2 * tau((d - from) / 2) - tau(-from), p[k]) }
               for (i = 1; i <= 25; i++) { d = to - 2 * to * i / 25; put(d, tau(to) - 2 * tau((to - d) / 2), p[k]) }
               from = -to; before = to
            }
         }
      }' "$@"
}
iwan_fields() { printf 'JIWAN %d %.17g\n' 1 "${5:-1}" 2 "$1" 3 "$2" 4 "$3" 5 "$4"; }

iwan_fields 2.4 1600 -0.6 0.4 > card
iwan loops > loops.dat
fit --iwan --plot picture.gp loops.dat
near 'Iwan from loops' 0.01 card
says 'Iwan from loops: comments' cards 'PREF 8 on its continuation' 'the loss of small cycles grows as d^2.' 'standard errors: FS'
says 'Iwan from loops: the picture' picture.gp "set ylabel 'tau'" 'using 3:4 with lines'
iwan loops noise=0.03 > noisy.dat
fit --iwan noisy.dat
near 'Iwan from noisy loops' 0.03 card
iwan loss > loss.dat
fit --plot picture.gp --id 1 loss.dat
near 'Iwan from losses' 1e-5 card
says 'Iwan from losses: comments' cards 'the loss of small cycles grows as d^2.4'
says 'Iwan from losses: the picture' picture.gp 'set logscale xy' "set ylabel 'loss'"
iwan loss tip=1 noise=0.02 > loss.dat
fit loss.dat
near 'Iwan from noisy losses and the stresses of the tips' 0.02 card

# other densities; without Dirac's share
for chi in -0.9 -0.3; do
   iwan loss chi=$chi beta=3 > loss.dat && fit loss.dat && iwan_fields 2.4 1600 $chi 3 > card && near "Iwan from losses, chi $chi" 1e-4 card
   iwan loops chi=$chi beta=1 > loops.dat && fit --iwan loops.dat && iwan_fields 2.4 1600 $chi 1 > card && near "Iwan from loops, chi $chi" 0.01 card
done
iwan loss beta=0 > loss.dat && fit --small loss.dat && iwan_fields 2.4 1600 -0.6 0 > card && near 'Iwan from losses, beta 0' 1e-4 card

# what small amplitudes alone fix: the power; with the stresses of the tips all but beta
iwan loss most=0.4 > loss.dat
fit loss.dat
holds 'microslip alone: status' [ $status -eq 2 ]
says 'microslip alone' stderr 'the data do not fix FS of a JIWAN card' 'CHI = -0.6'
iwan loss most=0.4 tip=1 > loss.dat
fit loss.dat
says 'microslip and tips' stderr 'WARNING: the data do not fix BETA, it is set to 0'
awk -f "$here/card_values.awk" cards > got
holds 'microslip and tips: KT and CHI' awk '$2 == 3 && ($3 - 1600)^2 < 1 { n++ } $2 == 4 && ($3 + 0.6)^2 < 1e-6 { n++ } END { exit n != 2 }' got

# units: loss in MPa*um, d in um
iwan_fields 2.4 1600 -0.6 0.4 > card
iwan loss | awk 'NR == 1 { print "d [um]; loss [MPa*um]; p [MPa]"; next } { printf "%.17g; %.17g; %.17g\n", 1e3 * $1, 1e3 * $2, $3 }' > units.dat
fit --units mm,n units.dat
near 'Iwan from losses in other units' 1e-5 card

# what does not go
printf 'd loss p\n0.1 0.2 3\n0.2 -0.3 3\n' > faulty.dat
fit faulty.dat
says 'a negative loss' stderr 'expected an amplitude d and a loss above 0 in every row'
sed 's/ 8$/ 0/' loops.dat > faulty.dat
fit --iwan faulty.dat
says 'no pressure' stderr 'expected p above 0 in every row'
fit --iwan power.dat
says '--iwan for a normal test' stderr '--iwan is for points of shear tests'
{ echo 'd tau p branch'; awk 'NR > 3 && NR < 60 { print $0, NR < 30 ? "LOAD" : "UNLOAD" }' loops.dat; } > faulty.dat
fit --iwan faulty.dat
says 'branches without an order' stderr 'expected rows in the order of time without a column branch or run'

# jointfem takes the card, and what it computes with it leads back to the card
fit noisy.dat --iwan
{
   printf '%s\n' 'METHOD = NEWTON' 'MODEL = SPACE' 'INCR = 9'
   for k in 1 2 3 4 5 6 7; do printf 'SUBCASE %d\n  LOAD = %d\n' $k $k; done
   printf '%s\n' 'BEGIN BULK' 'GRID,5,,1.,2.,3.' 'CJOINT,8,1,5,,50.,0.,0.,-1.' 'PJOINT,1,1,,,,,,1' '+,8.0' 'JNORM,1,2.-4,1.,5000.' 'JINCR,9,20,ARITH,0.05' \
      'CELAS2,1,2.+4,5,1' 'CELAS2,2,2.+4,5,2'
   for x in 1,0 2,60. 3,-60. 4,110. 5,-110. 6,220. 7,-220.; do printf 'FORCE,%s,5,,400.,0.,0.,-1.\nFORCE,%s,5,,%s,1.,0.,0.\n' ${x%,*} ${x%,*} ${x#*,}; done
   grep -v '^\$' cards
   echo ENDDATA
} | sed 's/,0,1\.,0\.,0\.$/,0.0,1.,0.,0./' > element.bdf
awk -f "$here/card_values.awk" cards > card
"$jointfem" -q element.bdf > stdout 2> stderr
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; print "d tau p"; next } $1 > 1 || $2 == 20 { print $at["delta_x"], $at["tau_x"], $at["pressure"] }' element.joint.csv > back.dat
fit --iwan back.dat
near 'from a card through jointfem to the card' 0.02 card
