# What the tests of several processes share.

# has_processes PROGRAM_MPI: ends the part, with nothing counted, where there is no mpirun or no program by make mpi
has_processes() {
   if ! [ -x "$1" ] || ! command -v mpirun > /dev/null; then
      echo 'skipped: there is no program built by make mpi'
      echo '0 passed, 0 failed'
      exit 0
   fi
   distributed=$(realpath "$1")
}

# on_processes N FOLDER DECK...: results into FOLDER; more processes than cores take turns
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 OMPI_MCA_mpi_yield_when_idle=1
on_processes() {
   local n=$1 folder=$2
   shift 2
   timeout 300 mpirun -q --oversubscribe -n "$n" "$distributed" -q -o "$folder" "$@"
}
