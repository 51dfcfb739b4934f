set title 'Error of the step-wise method against the number of increments, prism'
set xlabel 'increments'
set ylabel 'largest error of the deflections against NEWTON [mm]'
set logscale xy
set format y '10^{%T}'
set key top right
plot [2:400] folder . 'errors.csv' using 'increments':'error' with linespoints ls 2 title 'STEP, ARITH from 0.05 (equal from 20 on)', \
   2.2e-3*x**(-0.5) with lines ls 9 title 'slope -1/2'
