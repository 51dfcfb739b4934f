set title 'Response of the column, bolts at 8 kN, to 1 N along x and y at a corner of its top'
rows(s, c) = "< awk -F, 'NR == 1 || ($1 == " . s . ' && $4 == "' . c . "\")' " . folder . 'column_modes_08.response.csv'
set multiplot layout 2, 1
set lmargin 11
set xrange [200:700]
set ylabel 'amplitude [10^{-3} mm]'
set logscale y
set yrange [0.01:40]
set format x ''
set bmargin 0.8
set key top right Left reverse
plot rows(1, 'y') using 'frequency':(1000*column('amplitude')) with lines ls 3 title 'along y, joint as it unloads', \
   rows(2, 'y') using 'frequency':(1000*column('amplitude')) with lines ls 5 title 'along y, joint as it loads', \
   rows(1, 'x') using 'frequency':(1000*column('amplitude')) with lines ls 2 title 'along x, joint as it unloads', \
   rows(2, 'x') using 'frequency':(1000*column('amplitude')) with lines ls 6 title 'along x, joint as it loads'
unset title
unset logscale y
set format x '%g'
set tmargin 0.8
set bmargin 3.5
set xlabel 'frequency of the force [Hz]'
set ylabel 'phase [degrees]'
set yrange [-190:10]
set ytics 45
unset key
plot rows(1, 'y') using 'frequency':'phase' with lines ls 3, rows(2, 'y') using 'frequency':'phase' with lines ls 5, \
   rows(1, 'x') using 'frequency':'phase' with lines ls 2, rows(2, 'x') using 'frequency':'phase' with lines ls 6
unset multiplot
