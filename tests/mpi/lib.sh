# What the tests of several processes share; they are run from the root of the project.
set -u
export LC_ALL=C

# begin PROGRAM_MPI WORK_FOLDER: an empty folder WORK, nothing counted yet. Ends the part, with nothing counted, where there is no
# mpirun or no program by make mpi
begin() {
   if ! [ -x "$1" ] || ! command -v mpirun > /dev/null; then
      echo 'skipped: runs on several processes: PETSc or mpirun is not installed (libpetsc-real-dev, pkg-config)'
      echo '0 passed, 0 failed'
      exit 0
   fi
   distributed=$(realpath "$1")
   work=$2
   rm -rf "$work"
   mkdir -p "$work"
   passed=0 failed=0
}

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED $1"; }

# finish: the count, and the status of the part
finish() {
   echo "$passed passed, $failed failed"
   [ $failed -eq 0 ] && [ $passed -gt 0 ]
}

# folders_of_decks FOLDER: INCLUDE looks beside the deck
folders_of_decks() {
   local included
   mkdir -p "$1"
   for included in input/*/ tests/solver/*.inc; do ln -s "$PWD/${included%/}" "$1/"; done
}

# on_processes N FOLDER DECK...: results into FOLDER; more processes than cores take turns
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 OMPI_MCA_mpi_yield_when_idle=1
on_processes() {
   local n=$1 folder=$2
   shift 2
   timeout 900 mpirun -q --oversubscribe -n "$n" "$distributed" -q -o "$folder" "$@" < /dev/null
}
