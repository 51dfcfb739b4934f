set title 'Fig. 7(a)  Deflection along the interface of the prism, half-load 800 kgf'
set xlabel 'distance from the free end [mm]'
set ylabel 'closing deflection {/Symbol l} [10^{-3} mm]'
set key top left
last(n) = "< awk -F, 'NR == 1 || $2 == " . n . "' " . folder . "prism" . sprintf('%02d', n) . ".joint.csv"
plot [0:150] for [i = 1:4] last(int(word('3 5 10 15', i))) using 'x':(1000*column('lambda')) \
   with linespoints ls i title word('3 5 10 15', i) . ' increments'
