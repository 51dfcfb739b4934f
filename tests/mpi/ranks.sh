#!/usr/bin/env bash
# The number of processes does not matter: decks by PETSC on one, two and three processes and by MUMPS on one and three, histories
# equal to 1E-9; and to AUTO it is as if there were none: a small model gets the solver of the program without MPI, to the same bytes, and
# one whose factor TREE could not hold gets PETSC.
#
#    ranks.sh PROGRAM PROGRAM_MPI QUERY WORK_FOLDER
program=$1 query=$3
. tests/mpi/lib.sh
. tests/solver/lib.sh
begin "$2" "$4"
compare_within 1e-9
mkdir -p "$work"/{petsc1,petsc2,petsc3,mumps1,mumps3,auto,serial,limited}
folders_of_decks "$work/decks"

for name in ${DECKS:-prism_history flange_sector solid_bolt column_tetra10 one_element}; do
   for way in 'PETSC 1' 'PETSC 2' 'PETSC 3' 'MUMPS 1' 'MUMPS 3'; do
      read -r solver n <<< "$way"
      folder=$work/${solver,,}$n
      with_solver "input/$name.bdf" $solver > "$work/decks/$name.bdf"
      words=$(on_processes $n "$folder" "$work/decks/$name.bdf" 2>&1) || { fail "$name by $way: $words"; continue; }
      [ "$way" = 'PETSC 1' ] && continue
      if words=$(same_history "$work/petsc1/$name" "$folder/$name"); then pass; else fail "$name by $way: $words"; fi
   done
done

for deck in input/prism10.bdf input/flange_pair.bdf tests/solver/boxes.bdf; do
   name=$(basename "$deck" .bdf)
   "$program" -q --threads 1 -o "$work/serial" "$deck" > /dev/null 2>&1
   on_processes 1 "$work/auto" "$deck" > /dev/null 2>&1
   if cmp -s "$work/serial/$name.out" "$work/auto/$name.out"; then pass; else fail "$name by AUTO: another listing"; fi
done

# the address space is limited; Open MPI, PETSc and what BLAS reserves take part of it, so that the limit is found: the first in which it runs
tests/bench/make_deck.sh hex8_24x24x24 AUTO NONE | sed 's/^JINCR,5.*/JINCR,5,1/' > "$work/block.bdf"
for mib in 450 500 550 600 650 700 750 800; do
   ( ulimit -v $((1024*mib)); timeout 100 "$distributed" -q --threads 1 -o "$work/limited" "$work/block.bdf" ) > "$work/said" 2>&1 && break
done
if grep -q 'SOLVER PETSC' "$work/limited/block.out" && grep -qE 'AUTO: TREE WOULD NEED [0-9]+ MIB, MORE THAN THERE ARE' "$work/limited/block.out"
then pass; else fail "24 x 24 x 24 in $mib MiB: $(grep SOLVER "$work/limited/block.out" || head -n 3 "$work/said")"; fi
finish
