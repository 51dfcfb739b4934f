set title 'The approach to the friction limit, {/Symbol t} = {/Symbol m}p: node 1 of the pushed block'
set xlabel 'push [kgf]'
set ylabel 'shear stress over pressure, {/Symbol t}/p'
set key top left
rows(file) = "< awk -F, 'NR == 1 || ($1 == 2 && $6 == 1)' " . folder . file . ".joint.csv"
plot [0:200] [-0.1:0.35] 0.2 with lines ls 9 title 'limit, {/Symbol m} = 0.2', \
   rows('friction_none') using (190*column('load')):(column('tau_x')/column('pressure')) with linespoints ls 2 \
      title 'no re-analysis', \
   rows('friction_once') using (190*column('load')):(column('tau_x')/column('pressure')) with linespoints ls 3 \
      title 'one re-analysis, as in the paper', \
   rows('friction_full') using (190*column('load')):(column('tau_x')/column('pressure')) with linespoints ls 1 \
      title 're-analyses until no excess remains'
