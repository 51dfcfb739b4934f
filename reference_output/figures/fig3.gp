set title 'Fig. 3  Tangent steps of the step-wise method: node 51 of the prism, 5 increments'
set xlabel 'closing deflection {/Symbol l} [10^{-3} mm]'
set ylabel 'pressure p [kgf/mm^2]'
set key top left
set label 1 'O' at 0, 0 offset 1, 0.8
row(n, c) = real(system(sprintf("awk -F, '$2 == %d && $6 == 51 { print $%d }' %sprism05.joint.csv", n, c, folder)))
do for [i = 0:4] { set label 10 + i sprintf('A_%d', i) at 1000*row(i + 1, 13), row(i + 1, 14) offset 0.8, -0.6 }
do for [i = 1:4] { set label 20 + i sprintf('B_%d', i) at 8*sqrt(row(i, 14)), row(i, 14) offset -2.5, 0.3 }
plot [0:8] [0:0.95] \
   (x/8.0)**2 with lines ls 9 title '{/Symbol l} = c p^m', \
   "< awk -F, 'NR == 1 { print \"lambda,pressure\"; print \"0,0\"; next } $6 == 51 { print $13 \",\" $14 }' " . folder . "prism05.joint.csv" \
   using (1000*column('lambda')):'pressure' with linespoints ls 2 title 'steps along the tangents; the first is a secant', \
   "< awk -F, 'NR == 1 { print \"lambda,pressure\"; next } $6 == 51 && $2 < 5 { print 8e-3*sqrt($14) \",\" $14 }' " . folder . "prism05.joint.csv" \
   using (1000*column('lambda')):'pressure' with points ls 3 title 'points of the curve whose tangents the steps have'
