set title 'Fig. 1(a)  Normal deflection of a joint: loading, unloading, reloading'
set xlabel 'closing deflection {/Symbol l} [10^{-3} mm]'
set ylabel 'pressure p [kgf/mm^2]'
set key top left
set label 1 'A' at 8.0, 1.0 offset -2, 0.5
set label 2 'B' at 6.0, 0.0 offset -1.5, 0.7
plot [0:10] [0:1.6] \
   1e9*(x < 0) + (x/8.0)**2 with lines ls 9 title '{/Symbol l} = c p^m', \
   stage('normal_loop', 1) using (1000*column('lambda')):'pressure' with linespoints ls 1 title 'loading', \
   stage('normal_loop', 2) using (1000*column('lambda')):'pressure' with linespoints ls 2 title 'unloading along AB', \
   stage('normal_loop', 3) using (1000*column('lambda')):'pressure' with linespoints ls 3 title 'reloading, past A on the curve'
