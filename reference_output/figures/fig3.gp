set title 'Fig. 3  Tangent steps of the step-wise method: node 51 of the prism, 5 increments'
set xlabel 'closing deflection {/Symbol l} [10^{-3} mm]'
set ylabel 'pressure p [kgf/mm^2]'
set key top left
set label 1 'O' at 0, 0 offset 1, 0.8
plot [0:8] [0:0.95] \
   (x/8.0)**2 with lines ls 9 title '{/Symbol l} = c p^m', \
   "< awk -F, 'NR == 1 { print \"lambda,pressure\"; print \"0,0\"; next } $6 == 51 { print $13 \",\" $14 }' " . folder . "prism05.joint.csv" \
   using (1000*column('lambda')):'pressure' with linespoints ls 2 title 'steps along the tangents; the first is a secant'
