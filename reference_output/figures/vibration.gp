set title 'The column on its bed: natural frequencies against the preload of its bolts'
set xlabel 'preload of each of the four bolts [kN]'
set ylabel 'frequency [Hz]'
set key outside below Left reverse
set bmargin 9.5
set logscale x
set xtics (1, 2, 4, 8, 16, 32, 64)
frequencies = folder . 'vibration.csv'
welded(mode) = real(system(sprintf("awk -F, '{ print $%d }' ", 1 + mode) . folder . 'welded.csv'))
set label 1 'mode 2: rocks about y, along its broad side' at 1.05, welded(2) + 18
set label 2 'mode 1: rocks about x, along its narrow side' at 1.05, welded(1) + 18
plot [0.9:75] [200:720] \
   frequencies using ($1/1000):'unload2' with linespoints ls 2 title 'mode 2, joint as it unloads (STIFFNESS = UNLOAD)', \
   frequencies using ($1/1000):'load2' with linespoints ls 6 title 'mode 2, joint as it loads (STIFFNESS = LOAD)', \
   frequencies using ($1/1000):'unload1' with linespoints ls 3 title 'mode 1, joint as it unloads', \
   frequencies using ($1/1000):'load1' with linespoints ls 5 title 'mode 1, joint as it loads', \
   welded(2) with lines ls 9 title 'foot welded to the bed, without a joint', welded(1) with lines ls 9 notitle
