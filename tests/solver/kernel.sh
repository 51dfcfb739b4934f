#!/usr/bin/env bash
# The kernel of OpenBLAS: where OpenBLAS takes one without AVX2 on a processor that has AVX2, the program starts itself anew with a better one
# that computes right. Names, flags and faults are those of other_openblas.c. And a thread that waits sleeps soon (GOMP_SPINCOUNT).
#
#    kernel.sh PROGRAM WORK_FOLDER
set -u
program=$1 work=$2
passed=0 failed=0
rm -rf "$work"
mkdir -p "$work"
if ! command -v gcc > /dev/null || ! gcc -shared -fPIC -O1 -o "$work/other.so" tests/solver/other_openblas.c -ldl 2> "$work/gcc"; then
   echo 'skipped: other kernels of OpenBLAS: there is no gcc'
   echo '0 passed, 0 failed'
   exit 0
fi
# what the flags of an AVX-512 processor lead to: where this processor has not these instructions, the kernel for them crashes
best=SkylakeX
for flag in avx512f avx512dq avx512cd avx512bw avx512vl; do grep -qw "$flag" /proc/cpuinfo || best=Haswell; done
echo 'flags : fpu sse2 avx fma avx2' > "$work/haswell"
echo 'flags : fpu sse2 avx fma avx2 avx512f avx512dq avx512cd avx512bw avx512vl' > "$work/skylake"
echo 'flags : fpu sse2 avx' > "$work/sandybridge"

# kernel NAME=VALUE...: words of --times about the kernel, the status, and whether the listing is that of the reference
kernel() {
   local said status
   rm -f "$work"/*.out "$work"/*.csv
   said=$(env -u OPENBLAS_CORETYPE LD_PRELOAD="$PWD/$work/other.so" "$@" timeout 60 "$program" --times -q -o "$work" input/prism05.bdf 2>&1 > /dev/null)
   status=$?
   said=$(sed -n 's/.*: OpenBLAS kernel //p' <<< "$said")
   cmp -s "$work/prism05.out" reference_output/prism05.out || said="$said, another listing"
   echo "$said, $status"
}

# same WHAT EXPECTED FOUND
same() {
   if [ "$2" = "$3" ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED $1: '$3', expected '$2'"; fi
}

instead() { echo "$1; OpenBLAS itself takes $2 on this processor, which is slower, 0"; }

same 'AVX-512' "$(instead $best Prescott)" "$(kernel CORENAME=Prescott CPUINFO="$work/skylake")"
same 'AVX2' "$(instead Haswell Nehalem)" "$(kernel CORENAME=Nehalem CPUINFO="$work/haswell")"
same 'AVX' 'Prescott, 0' "$(kernel CORENAME=Prescott CPUINFO="$work/sandybridge")"
same 'no flags' 'Prescott, 0' "$(kernel CORENAME=Prescott CPUINFO="$work/missing")"
same 'a good choice' 'Zen, 0' "$(kernel CORENAME=Zen CPUINFO="$work/skylake")"
same 'the choice of the user' 'Prescott, 0' "$(kernel CORENAME=Haswell OPENBLAS_CORETYPE=Prescott CPUINFO="$work/skylake")"
for fault in WRONG CRASH HANG; do
   same "$fault: the next kernel" "$(instead Haswell Prescott)" "$(kernel $fault=SkylakeX CORENAME=Prescott CPUINFO="$work/skylake")"
   same "$fault: no kernel" 'Prescott, 0' "$(kernel $fault=SkylakeX,Haswell CORENAME=Prescott CPUINFO="$work/skylake")"
done

# ------------------------------------------------------------------ said once, on a terminal; not with -q; arguments as they were
terminal() { # ARGUMENT...
   env -u OPENBLAS_CORETYPE LD_PRELOAD="$PWD/$work/other.so" CORENAME=Prescott CPUINFO="$work/skylake" \
      script -qec "$program $*" /dev/null 2>&1 < /dev/null | grep -c "jointfem: OpenBLAS kernel $best; OpenBLAS itself takes Prescott"
}
if command -v script > /dev/null; then
   same 'on a terminal, two decks' 1 "$(terminal -o "$work" input/prism05.bdf input/prism03.bdf)"
   same '-q' 0 "$(terminal -q -o "$work" input/prism05.bdf)"
else
   echo 'skipped: the words on a terminal: there is no script'
fi
mkdir "$work/a b"
cp input/prism05.bdf "$work/a b/it's *.bdf"
env -u OPENBLAS_CORETYPE LD_PRELOAD="$PWD/$work/other.so" CORENAME=Prescott CPUINFO="$work/skylake" \
   "$program" -q -o "$work/a b" "$work/a b/it's *.bdf" - < input/prism03.bdf > "$work/said" 2>&1
same 'arguments and standard input' 0 $?
cmp -s <(tail -n +5 "$work/a b/it's *.out") <(tail -n +5 reference_output/prism05.out); same 'the listing below its heading' 0 $?
grep -q 'PRISM ON A RIGID BASE, 3 INCREMENTS' "$work/said"; same 'the deck of the standard input' 0 $?

# ------------------------------------------------------------------ a thread that waits sleeps soon, but where the user has said otherwise
spins() { # NAME=VALUE...: GOMP_SPINCOUNT of the program that waits for its deck
   local i spins=
   rm -f "$work/seen"
   { until [ -e "$work/seen" ]; do sleep 0.02; done; cat input/prism05.bdf; } |
      env -u GOMP_SPINCOUNT -u OMP_WAIT_POLICY "$@" "$program" -q -o "$work" - > /dev/null 2>&1 &
   for ((i = 0; i < 50; i++)); do
      sleep 0.02
      [[ $(readlink "/proc/$!/exe") = */jointfem ]] || continue # not yet env's
      spins=$(tr '\0' '\n' < "/proc/$!/environ" | sed -n 's/^GOMP_SPINCOUNT=//p')
      [ -z "$spins" ] || break
   done
   touch "$work/seen"
   wait $! || spins="$spins, status $?"
   echo "$spins"
}
if [ "$(nproc)" -gt 1 ]; then
   same 'a thread that waits sleeps soon' "$([ "$(nproc)" -lt 8 ] && echo 1000 || echo 20000)" "$(spins A=1)"
   echo 'int omp_get_num_procs_(void) { return 8; }' | ${CC:-cc} -shared -fPIC -x c -o "$work/eight.so" - &&
      same 'later where there are many processors' 20000 "$(spins LD_PRELOAD="$PWD/$work/eight.so")"
else
   echo 'skipped: threads that wait: one processor'
fi
same 'GOMP_SPINCOUNT of the user' 77 "$(spins GOMP_SPINCOUNT=77)"
same 'OMP_WAIT_POLICY of the user' '' "$(spins OMP_WAIT_POLICY=active)"
# a kernel that is set: else a processor that OpenBLAS does not know has the program started anew, with what it has set
same 'one thread' '' "$(spins OMP_NUM_THREADS=1 OPENBLAS_CORETYPE=Prescott)"
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
