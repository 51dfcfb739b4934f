# Iterations of conjugate gradients with GAMG on difficult problems, each in two sizes, the second with eight times the unknowns: no
# solution takes more iterations than stated here, and the larger problems take hardly more than the small ones.

# tetrahedra KIND N: a column of 1 : 6, clamped
tetrahedra() { awk -v kind="$1" -v n="$2" -v nz=$((6*$2)) -f tests/exact/elements.awk; }

head='ECHO = NO\nOUTPUT = NONE'
# springs N: a cube of bricks that eight soft springs hold, at its corners in all directions, one of them ten times as stiff
springs() {
   local n=$1 k=0 i
   printf "$head\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nBLOCK3,1,1,$n,$n,$n\n+,100.0,100.0,100.0\nPSOLID,1,1,,,,PLAIN\nMAT1,1,9500.0,,0.25\n"
   for i in 1 $((n + 1)) $((n*(n + 1) + 1)) $(((n + 1)**2)) $((n*(n + 1)**2 + 1)) $((n*(n + 1)**2 + n + 1)) $(((n + 1)**3 - n)) $(((n + 1)**3)); do
      for d in 1 2 3; do
         k=$((k + 1))
         echo "CELAS2,$((100000000 + k)),$([ $k -eq 3 ] && echo 100. || echo 10.),$i,$d"
      done
   done
   printf "FORCE,1,$(((n + 1)**3)),,100.0,0.3,0.5,-1.0\nENDDATA\n"
}

# wall N: 400 x 400 x 20, N bricks through its thickness, on a joint along its foot, a force across
wall() {
   local n=$1
   printf "$head\nSPC = 1\nSUBCASE 1\n  LOAD = 1\n  INCR = 1\nBEGIN BULK\nBLOCK3,1,1,$((20*n)),$n,$((20*n))\n+,400.0,20.0,400.0\n+,,,,,21,22\n"
   printf "PSOLID,1,1,,,,PLAIN\nMAT1,1,9500.0,,0.25\nPMARK,21\nPMARK,22\nSPC,1,1,12\nSPC1,1,1,$((n + 1))\nJOINT,1,1,21\nPJOINT,1,1\nJNORM,1,8.0-3,0.5\n"
   printf "FORCEM,1,2000.0,0.0,0.002,-1.0,22\nJINCR,1,4,ARITH,0.02\nSPCM,1,1,21\nSPCM,1,2,21\nENDDATA\n"
}

# relieved N: two cubes one on the other, pressed, then relieved to a thousandth: the joint nearly opens. The stiffness changes so much
# that a preconditioner of an earlier one is tried in vain first: its steps count
relieved() {
   tests/bench/make_deck.sh over_$1x$1x$(($1/2)) PETSC NONE | sed -e 's/^  INCR = 5/&\nSUBCASE 2\n  LOAD = 11\n  INCR = 6/' \
      -e 's/^JINCR,5.*/JINCR,5,4,ARITH,0.1\nJINCR,6,6\nLOAD,11,0.001,1.0,10/'
}

# most DECK: the most steps that a solution took, on two processes
most() {
   sed -e '/^SOLVER/d' -e '0,/^ECHO = NO/s//ECHO = NO\nSOLVER = PETSC/' "$1" > "$work/run.bdf"
   on_processes 2 "$work" --times "$work/run.bdf" > "$work/said" 2>&1 || { head -n 3 "$work/said" >&2; return 1; }
   sed -n 's/.*solutions.*at most \([0-9]*\)$/\1/p' "$work/said"
}

while read -r bound small large problem; do
   for size in $small $large; do
      $problem $size > "$work/problem.bdf"
      steps=$(most "$work/problem.bdf")
      if [ "${steps:-9999}" -le "$bound" ]; then
         pass
      else
         fail "$problem $size: ${steps:-no} steps, at most $bound were expected"
      fi
      printf '%s %s: %s steps, ' "$problem" "$size" "${steps:-no}"
   done
   echo "at most $bound"
done <<'END'
40 6 12 springs
60 4 8 tetrahedra CTETRA
80 2 4 tetrahedra CTETRA10
100 1 2 wall
120 8 16 relieved
END
