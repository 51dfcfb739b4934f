#!/usr/bin/env bash
# Runs on several processes. A part is skipped, and nothing counted, where mpirun or the program of `make mpi` is missing.
#
#    mpi.sh PROGRAM PROGRAM_MPI QUERY WORK_FOLDER [PART...]      all parts, or those named
#
# decks       SOLVER = PETSC and MUMPS, on one process and on two, against TREE of the program without MPI, within 1E-8: some decks,
#             or all decks with ALL=yes in the environment
# ranks       PETSC on one, two and three processes and MUMPS on one and three: histories equal to 1E-9; AUTO takes the solver of
#             the program without MPI for a small model, with the same bytes, and PETSC for a model whose factor does not fit into
#             the memory
# pieces, failures, iterations   mpi_PART.sh
set -u
export LC_ALL=C
program=$1 query=$3 top=$4
passed=0 failed=0
if ! [ -x "$2" ] || ! command -v mpirun > /dev/null; then
   echo 'skipped: runs on several processes: PETSc or mpirun is not installed (libpetsc-real-dev, pkg-config)'
   echo '0 passed, 0 failed'
   exit 0
fi
distributed=$(realpath "$2")
. tests/solver/lib.sh
shift 4
[ $# -gt 0 ] || set -- decks ranks pieces failures iterations

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED $1"; }

# folders_of_decks FOLDER: INCLUDE looks beside the deck
folders_of_decks() {
   local included
   mkdir -p "$1"
   for included in input/*/ tests/solver/*.inc; do ln -s "$PWD/${included%/}" "$1/"; done
}

# on_processes N FOLDER DECK...: results into FOLDER; more processes than cores take turns
export quiet=-q # without the remarks of mpirun; Open MPI 5 has no such option
mpirun -q --version > /dev/null 2>&1 || quiet=
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 OMPI_MCA_mpi_yield_when_idle=1
on_processes() {
   local n=$1 folder=$2
   shift 2
   timeout 900 mpirun $quiet --oversubscribe -n "$n" "$distributed" -q -o "$folder" "$@" < /dev/null
}

# compare_ways ORIGINAL WAY... -- NAME...: $work/decks/SOLVER/NAME.bdf by every WAY, `SOLVER PROCESSES`, all decks in one run of the program;
# their histories against those in $work/ORIGINAL
compare_ways() {
   local original=$1 way solver n folder name words ways=()
   shift
   while [ "$1" != -- ]; do ways+=("$1"); shift; done
   shift
   for way in "${ways[@]}"; do
      read -r solver n <<< "$way"
      folder=$work/${solver,,}$n
      mkdir -p "$folder"
      on_processes "$n" "$folder" "${@/#/$work/decks/$solver/}" > "$folder.log" 2>&1
      [ "$folder" = "$work/$original" ] && continue
      for name; do
         name=${name%.bdf}
         if words=$(same_history "$work/$original/$name" "$folder/$name"); then pass
         else fail "$name by $solver on $n: $(grep -hF "$name.bdf" "$folder.log" | head -n 3) $(head -n 5 <<< "$words")"; fi
      done
   done
}

# decks_by SOLVER DECK...: into $work/decks/SOLVER
decks_by() {
   local solver=$1 deck
   shift
   folders_of_decks "$work/decks/$solver"
   for deck; do with_solver "$deck" "$solver" > "$work/decks/$solver/$(basename "$deck")"; done
}

decks() {
   local deck solver
   compare_within 1e-8
   mkdir -p "$work/tree"
   if [ "${ALL:-}" ]; then set -- input/*.bdf tests/solver/*.bdf
   else set -- input/{prism_history,friction_once,gib,flange_warm,bracket_spiders,solid_bolt}.bdf \
      input/{meshed_apart,column_tetra10,one_element,normal_loop,frame,lap_sheets,box_column}.bdf tests/solver/{boxes,moved_newton}.bdf
   fi
   for solver in TREE PETSC MUMPS; do decks_by $solver "$@"; done
   "$program" -q -o "$work/tree" "$work"/decks/TREE/*.bdf > "$work/tree.log" 2>&1 || fail "decks by TREE: $(tail -n 3 "$work/tree.log")"
   compare_ways tree 'PETSC 1' 'PETSC 2' 'MUMPS 2' -- "${@##*/}"
}

ranks() {
   local name deck mib solver
   compare_within 1e-9
   mkdir -p "$work"/{auto,serial,limited}
   set -- input/{prism_history,flange_sector,solid_bolt,meshed_apart,column_tetra10,one_element}.bdf
   for solver in PETSC MUMPS; do decks_by $solver "$@"; done
   compare_ways petsc1 'PETSC 1' 'PETSC 2' 'PETSC 3' 'MUMPS 1' 'MUMPS 3' -- "${@##*/}"

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
   if grep -q 'SOLVER PETSC' "$work/limited/block.out" && grep -qE 'AUTO: TREE WOULD NEED [0-9]+ MIB, MORE THAN AVAILABLE' "$work/limited/block.out"
   then pass; else fail "24 x 24 x 24 in $mib MiB: $(grep SOLVER "$work/limited/block.out" || head -n 3 "$work/said")"; fi
}

for part in "$@"; do
   work=$top/$part
   rm -rf "$work"
   mkdir -p "$work"
   if [ -e "tests/solver/mpi_$part.sh" ]; then . "tests/solver/mpi_$part.sh"; else $part; fi
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
