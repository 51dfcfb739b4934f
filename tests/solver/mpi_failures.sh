# Runs on several processes that cannot finish: one process is killed, has no memory, or cannot write its piece, or the equations
# are not solved. All processes end, the status of mpirun is not 0, and no result is left; where rank 0 is killed, which knows the
# names of the pieces, only their temporary parts are left.
tests/bench/make_deck.sh hex8_16x16x16 PETSC NONE > "$work/gamg.bdf"
sed 's/^SOLVER = .*/SOLVER = MUMPS/' "$work/gamg.bdf" > "$work/mumps.bdf"
sed 's/OUTPUT = NONE/OUTPUT = NONE, STEPS/' "$work/gamg.bdf" > "$work/pieces.bdf"

# check WHAT STATUS WORDS [PATTERN]: a run has ended with STATUS, a pattern, says WORDS, and has left nothing, but for files like
# PATTERN; none of its processes goes on
check() {
   local what=$1 wanted=$2 words=$3 left rank i
   left=$(find "$work" -type f ! -name '*.bdf' ! -name said ! -name 'pid?' ! -name "${4:-}" | wc -l)
   for rank in 0 1; do
      [ -e "$work/pid$rank" ] || continue
      for ((i = 0; i < 50; i++)); do # mpirun may be gone a little earlier than its processes
         kill -0 "$(cat "$work/pid$rank")" 2> /dev/null || break
         sleep 0.1
      done
      [ $i -lt 50 ] || { what="$what, and process $rank goes on"; wanted=none; }
   done
   if [[ $status =~ ^($wanted)$ ]] && [ "$left" -eq 0 ] && { [ -z "$words" ] || grep -qE "$words" "$work/said"; } &&
      ! grep -qi 'backtrace' "$work/said"; then
      pass
   else
      fail "$what: status $status for $wanted, $left files left; it says:"
      head -n 8 "$work/said"
   fi
   find "$work" -type f ! -name '*.bdf' -delete
}

# on_two FIRST ARGUMENT...: a run on two processes, their numbers in pid0 and pid1; rank 1 begins with the command FIRST of the shell.
# One command for both: mpirun of Open MPI 5.0.7 crashes where each has its own
on_two() {
   local first=$1
   shift
   timeout 60 mpirun $quiet --oversubscribe -n 2 sh -c "echo \$\$ > $work/pid\$OMPI_COMM_WORLD_RANK
      if [ \$OMPI_COMM_WORLD_RANK = 1 ]; then $first; fi; exec $distributed $*"
}

# start DECK FIRST: DECK in the background
start() {
   on_two "$2" -q -o "$work" "$1" > "$work/said" 2>&1 &
   job=$!
}

ended() {
   wait $job
   status=$?
}

# ------------------------------------------------------------------ killed in the midst of the increments
# killed DECK RANK PART: once there is a file PART of its results
killed() {
   start "$work/$1.bdf" :
   for ((i = 0; i < 600; i++)); do
      ls "$work/$1".$3.*.part > /dev/null 2>&1 && break
      sleep 0.05
   done
   [ $i -lt 600 ] || fail "$1: no part of a result is there before the kill"
   kill -KILL "$(cat "$work/pid$2")"
   ended
}
for way in gamg mumps; do
   killed $way 1 out
   check "$way: rank 1 is killed" '[1-9][0-9]*' ''
done
killed pieces 1 '*.p1.vtu'
check 'pieces: rank 1 is killed' '[1-9][0-9]*' ''
killed pieces 0 '*.p1.vtu'
check 'pieces: rank 0 is killed' '[1-9][0-9]*' '' '*.part'

# ------------------------------------------------------------------ no room for the piece of one of them
# A limit on the size of files stands for the full disk, as in tests/programs/vtu.sh; memory that processes share would be such a file
export OMPI_MCA_btl=self,tcp
on_two : -q -o "$work" "$work/pieces.bdf" > "$work/said" 2>&1 && can_send=yes || can_send=
find "$work" -type f ! -name '*.bdf' -delete
if [ $can_send ]; then
   start "$work/pieces.bdf" "trap '' XFSZ; ulimit -f 100"
   ended
   # listing and tables stay: a ParaView file that fails loses no other result
   check 'rank 1 has 100 kB for its piece' 4 'the files for ParaView cannot be written: ' '*.[oc]*'
else
   echo 'skipped: a process without room for its piece: processes cannot send to each other by TCP here'
fi
unset OMPI_MCA_btl

# ------------------------------------------------------------------ no memory for one of them
# How much of the address space rank 1 has when it waits for orders: rank 0 waits for a deck that does not come
{ sleep 60 & echo $! > "$work/pid2"; wait; } | on_two : -q - > "$work/said" 2>&1 &
size=0 before=-1
for ((i = 0; i < 20; i++)); do
   sleep 0.5
   before=$size
   size=$(awk '$1 == "VmSize:" { print $2 }' "/proc/$(cat "$work/pid1" 2> /dev/null || echo none)/status" 2> /dev/null)
   size=${size:-0}
   [ "$size" -gt 200000 ] && [ "$size" -eq "$before" ] && break
done
kill "$(cat "$work/pid2")"
wait
find "$work" -type f ! -name '*.bdf' -delete
for way in gamg mumps; do
   for more in 20 80; do # MiB: less than BLAS takes, and not enough for the equations besides
      start "$work/$way.bdf" "ulimit -v $((size + 1024*more))"
      ended
      check "$way: rank 1 has $more MiB" 3 'permitted memory|process 1 need about [0-9]+ MiB, and'
   done
done

# ------------------------------------------------------------------ no convergence
for n in 1 2; do
   PETSC_OPTIONS='-jointfem_pc_type none -jointfem_ksp_max_it 3' on_processes $n "$work" "$work/gamg.bdf" > "$work/said" 2>&1
   status=$?
   check "three steps on $n" 3 'PETSc does not solve the [0-9]+ equations: after [0-9]+ steps the residual is [0-9.E-]+ of the load'
done
