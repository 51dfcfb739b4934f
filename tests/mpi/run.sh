#!/usr/bin/env bash
# Every deck of input/ by SOLVER = PETSC and by MUMPS, on one process and on two, against SOLVER = TREE of the program without MPI.
# Where there is no mpirun or no PETSc the part says so, and counts nothing.
#
#    run.sh PROGRAM PROGRAM_MPI QUERY WORK_FOLDER [DECK...]
program=$1 query=$3
. tests/mpi/lib.sh
. tests/solver/lib.sh
begin "$2" "$4"
shift 4
compare_within 1e-8
mkdir -p "$work"/{tree,petsc1,petsc2,mumps2}
folders_of_decks "$work/decks"

[ $# -gt 0 ] || set -- input/*.bdf tests/solver/*.bdf
for deck; do
   name=$(basename "$deck" .bdf)
   with_solver "$deck" TREE > "$work/decks/$name.bdf"
   if ! "$program" -q -o "$work/tree" "$work/decks/$name.bdf" > "$work/tree/$name.log" 2>&1; then
      echo "$name: does not run by TREE"; failed=$((failed + 1))
      continue
   fi
   for way in 'PETSC 1' 'PETSC 2' 'MUMPS 2'; do
      read -r solver n <<< "$way"
      folder=$work/${solver,,}$n
      with_solver "$deck" $solver > "$work/decks/$name.bdf"
      if words=$(on_processes $n "$folder" "$work/decks/$name.bdf" 2>&1) &&
         words=$(same_history "$work/tree/$name" "$folder/$name"); then
         pass
      else
         failed=$((failed + 1))
         echo "$name by $solver on $n: $words" | head -n 5
      fi
   done
done
finish
