# A block 1e6 times stiffer than the joint under an eccentric load: lambda = d + t x.
# Against the numbers of a rigid block on the same nodes (to 3E-6: the block is 1e6 times stiffer, no more), and, as the nodes become dense, against the continuous formulas.


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

# Continuous formulas: full contact up to e = L/4 (m = 0.5), L/6 (m = 1): N = (b/c**2)(d**2 L + t**2 L**3/12), M = (b/c**2) d t L**3/6,
# and for m = 1 N = b L d/c, M = b t L**3/(12 c). Beyond it the contact length is (n + 2)(L/2 - e). The error falls as nodes double.
for case in '0.5 10.0' '0.5 24.0' '0.5 30.0' '0.5 40.0' '1.0 10.0' '1.0 24.0' '1.0 40.0'; do
   set -- $case
   before=
   for nx in 20 40 80 160; do
      rigid_block block $nx $1 $2 || continue
      n="1/$1" full="$2 <= if($1 = 0.5, 25, 100/6)"
      force="if($1 = 0.5, 20/8e-3^2*(($d)^2*100 + ($t)^2*100^3/12), 20/8e-3*$d*100)"
      moment="if($1 = 0.5, 20/8e-3^2*$d*$t*100^3/6, 20/8e-3*$t*100^3/12)"
      error=$(number "if($full, abs($force/1000 - 1) + abs($moment/(1000*$2) - 1), abs((50 + $d/$t)/(($n + 2)*(50 - $2)) - 1))")
      [ -n "$before" ] && holds "rigid block, m = $1, e = $2, $nx elements: error falls" "$error < 0.6 * $before"
      before=$error
   done
   holds "rigid block, m = $1, e = $2: close to the continuous formula" "$error < 1e-3"
done

# Separation begins at L/4 for m = 0.5 and at L/6 for m = 1.
rigid_block block 80 0.5 24.5 && same 'rigid block, m = 0.5, e below L/4: open nodes' "$open" 0
rigid_block block 80 0.5 25.5 && holds 'rigid block, m = 0.5, e above L/4: open nodes' "$open > 0"
rigid_block block 80 1.0 16.2 && same 'rigid block, m = 1, e below L/6: open nodes' "$open" 0
rigid_block block 80 1.0 17.2 && holds 'rigid block, m = 1, e above L/6: open nodes' "$open > 0"

# Pressed evenly: every node p = F/A_int, lambda = c p**m, also where the body is soft.
even_block patch && ask 'pressed evenly' patch count 4 \
   all 'pressure = 0.2 within 1e-8*0.2 and lambda = 8e-3*0.2^0.4 within 1e-8*lambda'
