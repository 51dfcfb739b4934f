set title 'Fig. 7(b)  Pressure along the interface of the prism, half-load 800 kgf'
set xlabel 'distance from the free end [mm]'
set ylabel 'pressure p [kgf/mm^2]'
set key top left
plot [0:150] \
   for [i = 1:4] increment('prism' . word('03 05 10 15', i), int(word('3 5 10 15', i))) using 'x':'pressure' \
      with linespoints ls i title word('3 5 10 15', i) . ' increments', \
   increment('prism_back', 1) using 'x':'pressure' with points ls 6 ps 2 title 'BACK', \
   increment('prism_newton', 1) using 'x':'pressure' with lines ls 5 title 'NEWTON'
