set multiplot layout 2, 1 title 'Fig. 7(d)  Pressures against the number of increments, half-load 800 kgf'
set ylabel 'p [kgf/mm^2]'
set key off
set logscale x
set rmargin 12
set xtics (3, 5, 10, 15, 20, 40, 80, 160, 320)
limit(k) = real(system(sprintf("awk -F, 'NR == 2 { print $%d }' %snewton.csv", k, folder)))
steps = folder . 'by_increments.csv'
# columns 3 to 12 of both files: the pressures of nodes 6, 11, ..., 51
do for [k = 9:12] { set label k sprintf('node %d', 5*k - 9) at graph 1.01, first limit(k) offset 0, (k == 12 ? 0.35 : k == 11 ? -0.35 : 0) }
set title 'nodes 36 to 51, towards the load: from below' font ',12'
plot [2.5:400] [0.35:0.65] for [k = 9:12] steps using 1:k with linespoints ls k - 8, for [k = 9:12] limit(k) with lines ls 9
unset label
set xlabel 'number of increments'
do for [k = 3:7] { set label k sprintf('node %d', 5*k - 9) at graph 1.01, first limit(k) }
set title 'nodes 6 to 26, towards the free end: from above (node 6 opens; dashed: NEWTON)'
plot [2.5:400] [-0.02:0.27] for [k = 3:7] steps using 1:k with linespoints ls k - 2, for [k = 3:7] limit(k) with lines ls 9
unset multiplot
