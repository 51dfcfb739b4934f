set title 'Fig. 7(c)  Deflection of node 51 against the number of increments, half-load 800 kgf'
set xlabel 'number of increments'
set ylabel 'closing deflection {/Symbol l} of node 51 [10^{-3} mm]'
set key top right Left reverse
set logscale x
set xtics (3, 5, 10, 15, 20, 40, 80, 160, 320)
limit = 1000*real(system("awk -F, 'NR == 2 { print $2 }' " . folder . 'newton.csv'))
plot [2.5:500] [5.8:10] folder . 'by_increments.csv' using 'increments':(1000*column('lambda')) with linespoints ls 2 \
      title 'STEP, first increment 5 % (equal increments from 20 on)', \
   limit with lines ls 9 title 'NEWTON in 40 increments: STEP tends to it from above', \
   folder . "by_increments.csv" using (column("increments") == 20 ? 1/0 : column("increments")):(1000*column("lambda")): \
      (sprintf("%+.1f %%", 100*(1000*column("lambda")/limit - 1))) \
      with labels offset 3, 0.7 notitle
