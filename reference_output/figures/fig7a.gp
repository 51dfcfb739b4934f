set title 'Fig. 7(a)  Deflection along the interface of the prism, half-load 800 kgf'
set xlabel 'distance from the free end [mm]'
set ylabel 'closing deflection {/Symbol l} [10^{-3} mm]'
set key top left Left reverse
plot [0:150] \
   for [i = 1:4] increment('prism' . word('03 05 10 15', i), int(word('3 5 10 15', i))) using 'x':(1000*column('lambda')) \
      with linespoints ls i title 'STEP ' . word('3 5 10 15', i), \
   increment('prism_back', 1) using 'x':(1000*column('lambda')) with points ls 6 ps 2 title 'BACK, and NEWTON in one increment', \
   increment('NEWTON_40', 40) using 'x':(1000*column('lambda')) with lines ls 5 title 'the limit: NEWTON in 40 increments'
