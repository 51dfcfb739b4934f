set title 'Contact of the clamped flange pair beside its bolt circle'
set xlabel 'thickness of each flange [mm]'
set ylabel 'outward extent of the contact from the bolt circle [mm]'
set key bottom right
plot [0:12] [0:21] folder . 'flange.csv' using 'thickness':'flexible' with linespoints ls 2 title 'flexible joint of the deck, {/Symbol l} = 10^{-3} p^{0.5}', \
   '' using 'thickness':'stiff' with linespoints ls 3 title 'a stiff joint, {/Symbol l} = 10^{-5} p^{0.5}', \
   x with lines ls 9 title '45 degrees (Roetscher)', \
   20 with lines ls 1 dt 3 title 'edge of the flange'
