# The backbone of brake_reuss beside the published points
points = "< awk '!/^#/ { print $1 \",\" $2 \",\" $3 }' input/published/brake_reuss.dat"
linear = real(system("awk -F, '$2 == 4 { print $3 }' " . folder . 'brake_reuss.modes.csv'))
ours = folder . 'brake_reuss.backbone.csv'
set logscale x
set xrange [0.7e-3:0.1]
set format '%g'
set lmargin 11
set key bottom left Left reverse
set multiplot layout 2, 1
set title 'Brake-Reuss beam, mode 1: frequency shift and damping of the joint against amplitude'
set ylabel 'shift of the frequency [%]'
set format x ''
set bmargin 0.8
plot points using 1:2 with points ls 1 pointsize 1.2 title 'published (Porter and Brake 2023)', \
   ours using 'amplitude':(100*(column('frequency')/linear - 1)) with linespoints ls 3 title 'brake\_reuss.bdf'
unset title
set logscale y
set yrange [1e-4:0.05]
set format x '%g'
set format y '10^{%L}'
set tmargin 0.8
set bmargin 3.5
set key top left
set xlabel 'amplitude [mm]'
set ylabel '{/Symbol z} of the joint'
plot points using 1:3 with points ls 1 pointsize 1.2 title 'published (Porter and Brake 2023)', \
   ours using 'amplitude':(column('loss_factor')/2) with linespoints ls 3 title 'brake\_reuss.bdf'
unset multiplot
