# A block 1e6 times stiffer than the joint under an eccentric load: lambda = d + t x.
# Against the numbers of a rigid block on the same nodes (to 3E-6: the block is 1e6 times stiffer, no more). The continuous formulas,
# the onset of separation and uniform pressure: manual/04_blocks.md.

for m in 0.5 1.0; do
   for e in 10.0 20.0 24.0 26.0 30.0; do
      for nx in 10 20 40; do
         rigid_block block $nx $m $e || continue
         read -r d_reference t_reference <<< "$("$query" tests/exact/rigid_block_reference.csv \
            rows "nx = $nx and m = $m and e = $e" print d print t)"
         near "rigid block, m = $m, e = $e, $nx elements: d" "$d" "$d_reference" 3e-6
         near "rigid block, m = $m, e = $e, $nx elements: t" "$t" "$t_reference" 3e-6
         holds "rigid block, m = $m, e = $e, $nx elements: it stays straight" "$worst < 1e-5"
      done
   done
done

