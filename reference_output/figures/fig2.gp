set title 'Fig. 2  Coefficients of the reloading cubics against pressure, ground mild steel (Sanad)'
set xlabel 'pressure p [kgf/cm^2]'
set ylabel 'coefficients of {/Symbol t} = c_1 d + c_2 d^2 + c_3 d^3'
set key top left
set zeroaxis lt 1 lc rgb '#808080'
lines = folder . 'sanad.csv'
array a[3]
array b[3]
do for [i = 1:3] {
   a[i] = real(system("awk -F, 'NR == " . (i + 1) . " { print $2 }' " . lines))
   b[i] = real(system("awk -F, 'NR == " . (i + 1) . " { print $3 }' " . lines))
}
points = "< awk 'BEGIN { print \"p,c1,c2,c3\" } !/^#/ && $1 + 0 > 0 { print $1 \",\" $2 \",\" $3 \",\" $4 }' tests/fit/sanad.dat"
plot [0:140] [-500:1000] \
   for [i = 1:3] points using 1:(column(i + 1)) with points ls i ps 2 title sprintf('c_%d, published', i), \
   for [i = 1:3] a[i] + b[i]*x with lines ls i title sprintf('c_%d = %.2f %+.3f p, by jointfit', i, a[i], b[i])
