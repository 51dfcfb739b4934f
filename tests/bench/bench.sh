#!/usr/bin/env bash
# Speed and memory: the phases of a run, shares of the DGEMM rate, growth, CHOLMOD beside it, friction, threads, SKYLINE against
# TREE. `make bench` builds what this needs and calls it; README.md beside this file says how the tables are read.
#
#    bench.sh PROGRAM FOLDER [WHAT...]
#
# FOLDER  where the programs of the benchmark are and its files go; FOLDER/measured holds every figure, FOLDER/tables the tables
# WHAT    all (if nothing is said), small, or any of: shapes as make_deck.sh has them, friction, threads, crossing, gmsh, lists,
#         modes, identify, foot, zoo, mpi; not of all: foot and mpi, which take hours, and zoo, which takes half an hour; FOOT_MODELS,
#         ZOO_MODELS, MPI_SHAPES and THREAD_SHAPES are the models they measure
#
# Programs run one after another, on one thread unless said otherwise, ours and CHOLMOD in turn; of several runs the fastest
# counts, long ones are not repeated. Status 1 where a run fails or CHOLMOD finds another answer.
set -u
program=$1 work=$2
shift 2
here=$(dirname "$0")
export LC_ALL=C OPENBLAS_NUM_THREADS=1
mkdir -p "$work"
measured=$work/measured
: > "$measured"

small='q4_100x20 q4_400x80 hex8_20x20x20'
large='q4_1000x200 q4_2000x400 hex8_30x30x30 hex8_40x40x40'
wide='q4_4000x20 hex8_58x58x3 hex8_58x58x10'
[ $# -gt 0 ] || set -- all
wanted=
for word; do
   case $word in
   all)   wanted="$wanted $small $large $wide gmsh friction threads crossing lists modes identify" ;;
   small) wanted="$wanted $small friction crossing" ;;
   q4_*|hex8_*|over_*|friction|threads|crossing|gmsh|lists|modes|identify|foot|zoo|mpi) wanted="$wanted $word" ;;
   *) echo "bench: '$word' is neither all, small, friction, threads, crossing, gmsh, lists, modes, identify, foot, zoo, mpi nor a shape like q4_100x20, hex8_20x20x20" >&2
      exit 1 ;;
   esac
done

fail() {
   echo "bench: $*" >&2
   exit 1
}

# All figures of the file $3 under the name of a table and a row.
record() {
   sed "s/^/$1 $2 /" "$3" >> "$measured"
}

# Of the files $1 and $2, what counts in their first lines, keep the faster in $2.
keep_faster() {
   if [ ! -f "$2" ] || awk 'FNR == 1 { s[NR > 1] = $2 } END { exit !(s[0] < s[1]) }' "$1" "$2"; then
      mv "$1" "$2"
   fi
}

# Run decks on $1 threads; FOLDER/clock holds user and system seconds of the whole program.
run_program() {
   local threads=$1 TIMEFORMAT=$'user %3U\nsystem %3S'
   shift
   { time "$program" --times -q --threads "$threads" -o "$work" "$@" > "$work/said" 2>&1; } 2> "$work/clock" ||
      { cat "$work/said" >&2; fail "$* failed"; }
}

# What --times printed of the deck $1, `phase seconds` a line; above it the seconds of the solution, by which runs are compared,
# and of everything.
figures() {
   awk -v prefix="$1: " 'index($0, prefix) == 1 {
         words = substr($0, length(prefix) + 1)
         n = split(words, w, " ")
         name = ""
         for (i = 1; i <= n && w[i] !~ /^[0-9.]/; i++) name = name (i > 1 ? "_" : "") w[i]
         if (name == "") next
         line[++lines] = name " " w[i]
         if (w[n] != "s") next
         all += w[i]
         if (name ~ /^(order|factor|increments|recover|modes)$/) solution += w[i]
      }
      END { print "solution", solution; print "all", all; for (i = 1; i <= lines; i++) print line[i] }' "$work/said"
}

# The figures of a listing that the tables need.
of_listing() {
   awk '$1 == "UNKNOWNS" && NF == 2               { print "unknowns", $2 }
        /^ *UNKNOWNS LEFT AFTER CONDENSATION/     { print "left", $NF }
        /^ *ENTRIES OF THE FACTOR/                { print "entries", $NF }
        $1 == "PROFILE"                           { print "entries", $NF }
        /^ *METHOD .* SOLVER/                     { sub(/.* SOLVER [A-Z]*,? */, ""); gsub(/ +/, "_"); print "ordering", $0 }
        /^  INCR +SHARE +LOAD/                    { getline; if ($1 == "") getline; if ($1 == 1) print "deflection", $6 }' "$1"
}

remove_results() {
   rm -f "$work/$1".out "$work/$1".joint.csv "$work/$1".matrix
}

# CHOLMOD on the equations of the model $1: what cholmod_once prints, the seconds of the solution above it.
run_cholmod() {
   "$work/cholmod_once" "$work/$1.matrix" "$2" > "$work/said" || fail "CHOLMOD failed on $1"
   awk '{ line[NR] = $0 } $1 ~ /^(analyse|factor|solve)$/ { sum += $2 }
        END { print "solution", sum; for (i = 1; i <= NR; i++) print line[i] }' "$work/said" > "$work/one"
}

# The figures $2 of CHOLMOD for the model $1 under the table $3; it must have found our answer.
record_cholmod() {
   record "$3" "$1" "$2"
   awk '$1 == "deflection" { u[FILENAME] = $2 } $1 == "unknowns" { n[FILENAME] = $2 } $1 == "residual" { r = $2 }
        END { ours = ARGV[1]; theirs = ARGV[2]; difference = u[ours] - u[theirs]; if (difference < 0) difference = -difference
              exit !(n[ours] == n[theirs] && u[ours] > 0 && difference <= 2e-5*u[ours] && r < 1e-8) }' \
      "$work/ours" "$2" || fail "$1: CHOLMOD finds another answer: see deflection, residual in $measured"
}

# ------------------------------------------------------------------ one model: its phases, CHOLMOD on the same equations
measure_model() {
   local shape=$1 deck=$work/$1.bdf turn choice=
   echo "bench: $shape" >&2
   rm -f "$work/ours" "$work/metis" "$work/own"
   "$here/make_deck.sh" "$shape" TREE LAST > "$deck" || exit 1
   [ ! -x "$work/cholmod_once" ] || "$work/write_matrix" "$deck" "$work/$shape.matrix" || exit 1
   for turn in 1 2 3; do
      run_program 1 "$deck"
      { figures "$deck"; of_listing "$work/$shape.out"; cat "$work/clock"; } > "$work/one"
      keep_faster "$work/one" "$work/ours"
      if [ -x "$work/cholmod_once" ]; then
         run_cholmod "$shape" METIS
         keep_faster "$work/one" "$work/metis"
         if [ "$choice" != METIS ]; then
            run_cholmod "$shape" own
            choice=$(awk '$1 == "ordering" { print $2 }' "$work/one")
            [ "$choice" = METIS ] || keep_faster "$work/one" "$work/own"
         fi
      fi
      enough 60 "$work/ours" "$work/metis" "$work/own" && break
   done
   echo "turns $((turn > 3 ? 3 : turn))" >> "$work/ours"
   record ours "$shape" "$work/ours"
   [ ! -f "$work/metis" ] || record_cholmod "$shape" "$work/metis" cholmod
   [ ! -f "$work/own" ] || record_cholmod "$shape" "$work/own" own
   remove_results "$shape"
}

# Whether the solutions of the files $2... took more than $1 seconds in all: no further turn then.
enough() {
   local limit=$1
   shift
   cat "$@" 2> /dev/null | awk -v limit="$limit" '$1 == "solution" { s += $2 } END { exit !(s > limit) }'
}

# ------------------------------------------------------------------ what a re-analysis costs: the same deck without and with
measure_friction() {
   local shape=$1 nrean turn
   echo "bench: friction, $shape" >&2
   rm -f "$work"/with_*
   for turn in 1 2 3; do
      for nrean in 0 20; do
         "$here/make_deck.sh" "$shape" TREE NONE $nrean > "$work/$shape.bdf" || exit 1
         run_program 1 "$work/$shape.bdf"
         figures "$work/$shape.bdf" | awk '$1 == "increments" { print; exit }' > "$work/one"
         awk '/^ RE-ANALYSES AFTER THE COULOMB CHECK/ { inside = 1; next } inside && /^ [A-Z]/ { exit }
              inside && NF == 6 && $1 > 0 { n++ } END { print "passes", n + 0 }' "$work/$shape.out" >> "$work/one"
         keep_faster "$work/one" "$work/with_$nrean"
      done
   done
   for nrean in 0 20; do record "friction_$nrean" "$shape" "$work/with_$nrean"; done
   remove_results "$shape"
}

# ------------------------------------------------------------------ one thread, two, four ... all, and what the recorded tasks promise
measure_threads() {
   local shape=$1 threads turn same=yes list=1 n=2
   [ "$(nproc)" -gt 1 ] || { echo 'bench: one core, threads are not measured' >&2; return; }
   while [ $n -lt "$(nproc)" ]; do list="$list $n"; n=$((2*n)); done
   list="$list $(nproc)"
   rm -f "$work"/threads_*
   "$here/make_deck.sh" "$shape" TREE LAST > "$work/$shape.bdf" || exit 1
   for turn in 1 2; do
      for threads in $list; do
         echo "bench: $shape, threads: $threads" >&2
         run_program "$threads" "$work/$shape.bdf"
         figures "$work/$shape.bdf" > "$work/one"
         keep_faster "$work/one" "$work/threads_$threads"
         cat "$work/$shape.out" "$work/$shape.joint.csv" | cksum > "$work/sum_$threads"
         cmp -s "$work/sum_1" "$work/sum_$threads" || same=no
      done
      enough 10 "$work/threads_1" && break
   done
   echo "bench: $shape, its tasks" >&2
   JOINTFEM_TASKS=$work/tasks run_program 1 "$work/$shape.bdf"
   for threads in $list; do
      if [ -x "$work/pardiso_once" ]; then
         [ "$threads" != 1 ] || "$work/write_matrix" "$work/$shape.bdf" "$work/$shape.matrix" || exit 1
         "$work/pardiso_once" "$work/$shape.matrix" "$threads" > "$work/said" || fail "PARDISO failed on $shape"
         sed -n 's/^solution /pardiso /p' "$work/said" >> "$work/threads_$threads"
      fi
      record "threads_$threads" "$shape" "$work/threads_$threads"
   done
   figures "$work/$shape.bdf" > "$work/one"
   for threads in $(echo "$list 4 8 16 32" | tr ' ' '\n' | sort -nu); do
      echo "threads_$threads $shape same $same" >> "$measured"
      [ ! -f "$work/tasks" ] || awk -f "$here/schedule.awk" -v threads="$threads" "$work/tasks" |
         awk 'NR == FNR { if (NF >= 2) seconds[$1] = $2; next } FNR > 1 && seconds[$1] > 0 { print "predicted_" $1, seconds[$1]/(seconds[$1] - $3 + $5) }' \
            "$work/one" - | sed "s/^/threads_$threads $shape /" >> "$measured"
   done
   rm -f "$work/tasks"
   remove_results "$shape"
}

# ------------------------------------------------------------------ where TREE overtakes SKYLINE
measure_crossing() {
   local shape solver copy turn
   for shape in q4_10x4 q4_20x4 q4_30x6 q4_40x8 q4_60x12 q4_100x20 q4_400x4 hex8_3x3x3 hex8_4x4x4 hex8_5x5x5 hex8_6x6x6 \
                hex8_8x8x8 hex8_10x10x10; do
      echo "bench: SKYLINE against TREE, $shape" >&2
      rm -f "$work/SKYLINE" "$work/TREE"
      for turn in 1 2; do
         for solver in SKYLINE TREE; do
            for copy in 1 2 3 4 5; do "$here/make_deck.sh" "$shape" $solver NONE > "$work/copy_$copy.bdf"; done
            run_program 1 "$work"/copy_[1-5].bdf
            for copy in 1 2 3 4 5; do
               figures "$work/copy_$copy.bdf" > "$work/one"
               keep_faster "$work/one" "$work/$solver"
            done
            of_listing "$work/copy_1.out" >> "$work/$solver"
         done
      done
      for solver in SKYLINE TREE; do record "crossing_$solver" "$shape" "$work/$solver"; done
   done
   rm -f "$work"/copy_*
}

# ------------------------------------------------------------------ a joint on lists of nodes beside one of pairs
measure_lists() {
   local shape turn
   rm -f "$work"/lists_*
   for turn in 1 2; do
      for shape in "$@"; do
         echo "bench: $shape" >&2
         "$here/make_deck.sh" "$shape" TREE NONE > "$work/$shape.bdf" || exit 1
         run_program 1 "$work/$shape.bdf"
         { figures "$work/$shape.bdf"; of_listing "$work/$shape.out"; } > "$work/one"
         keep_faster "$work/one" "$work/lists_$shape"
      done
   done
   for shape in "$@"; do
      record lists "$shape" "$work/lists_$shape"
      remove_results "$shape"
   done
}

# ------------------------------------------------------------------ twenty natural modes beside the factorisation of the same run
measure_modes() {
   local shape turn
   for shape in "$@"; do
      echo "bench: 20 modes, $shape" >&2
      rm -f "$work/ours"
      "$here/make_deck.sh" "$shape" TREE NONE '' 20 > "$work/$shape.bdf" || exit 1
      for turn in 1 2; do
         run_program 1 "$work/$shape.bdf"
         { figures "$work/$shape.bdf"; of_listing "$work/$shape.out"; } > "$work/one"
         keep_faster "$work/one" "$work/ours"
         enough 60 "$work/ours" && break
      done
      record modes "$shape" "$work/ours"
      remove_results "$shape"
      rm -f "$work/$shape".*.csv
   done
}

# ------------------------------------------------------------------ four parameters of a joint from frequencies, beside one factorisation
measure_identify() {
   local shape
   for shape in "$@"; do
      echo "bench: laws of $shape" >&2
      "$here/identify.sh" "$program" "${program%jointfem}jointfit" "$work/identify" "$shape" > "$work/one" || fail "no laws of $shape"
      record identify "$shape" "$work/one"
   done
}

# ------------------------------------------------------------------ PETSC on one process and on two, beside TREE on as many threads
measure_mpi() {
   local shape n name
   [ -x "${program}_mpi" ] || fail "there is no ${program}_mpi: make mpi"
   export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1
   for shape in ${MPI_SHAPES:-hex8_20x20x20 hex8_30x30x30 hex8_40x40x40 hex8_60x60x60 hex8_80x80x80 hex8_100x100x100 bracket_16}; do
      "$here/make_deck.sh" "$shape" PETSC NONE > "$work/$shape.bdf" || exit 1
      for n in 1 2; do
         echo "bench: $shape by PETSC, processes: $n" >&2
         run_processes $n "$shape"
         record "mpi_$n" "$shape" "$work/one"
      done
      case $shape in hex8_[1-4]?x*)
         "$here/make_deck.sh" "$shape" TREE NONE > "$work/$shape.bdf" || exit 1
         for n in 1 2; do
            echo "bench: $shape by TREE, threads: $n" >&2
            run_program $n "$work/$shape.bdf"
            { figures "$work/$shape.bdf"; of_listing "$work/$shape.out"; cat "$work/clock"; } > "$work/one"
            record "tree_$n" "$shape" "$work/one"
         done ;;
      esac
      remove_results "$shape"
   done
   for shape in hex8_80x80x80 bracket_16; do
      [ -f "$work/$shape.bdf" ] || continue
      "$here/make_deck.sh" "$shape" TREE NONE > "$work/$shape.bdf" || exit 1
      "$work/partition_plan" "$work/$shape.bdf" 64 > "$work/one" || fail "no plan of $shape"
      record plan "$shape" "$work/one"
   done
}

# The model $2 by PETSC on $1 processes: its figures, and the steps of its first solution and of all on the average.
run_processes() {
   local quiet=-q TIMEFORMAT=$'user %3U\nsystem %3S'
   mpirun -q --version > /dev/null 2>&1 || quiet= # Open MPI 5 has no such option
   { time PETSC_OPTIONS="${PETSC_OPTIONS-} -jointfem_ksp_converged_reason" mpirun $quiet --oversubscribe -n "$1" "${program}_mpi" \
      --times -q --threads 1 -o "$work" "$work/$2.bdf" > "$work/said" 2>&1; } 2> "$work/clock" ||
      { cat "$work/said" >&2; fail "$2 on $1 processes failed"; }
   { figures "$work/$2.bdf"; of_listing "$work/$2.out"; cat "$work/clock"
     awk '/ solve converged .* iterations / { n++; all += $NF; if (n == 1) first = $NF }
          END { if (n) print "first_steps " first "\nsteps " all/n }' "$work/said"; } > "$work/one"
}

# ------------------------------------------------------------------ meshes from Gmsh: two blocks of linear tetrahedra, a column of second order
measure_gmsh() {
   command -v gmsh > /dev/null || { echo 'bench: gmsh is not installed, its meshes are left out' >&2; return; }
   "$here/../programs/gmsh_fine.sh" "$work" || fail 'no mesh from gmsh'
   measure_mesh two_blocks "$work/two_blocks_fine.bdf" "$work/gmsh/two_blocks_fine_mesh.bdf"
   "$here/../programs/column.sh" --mesh "$work" 15.7 || fail 'no column from gmsh'
   measure_mesh column "$work/column.bdf" "$work/column_mesh.bdf"
}

# The deck $2 with the mesh $3 under the name $1.
measure_mesh() {
   local turn name
   name=$(basename "$2" .bdf)
   echo "bench: $1 from Gmsh" >&2
   rm -f "$work/ours"
   for turn in 1 2; do
      run_program 1 "$2"
      { figures "$2"; of_listing "$work/$name.out"; } > "$work/one"
      keep_faster "$work/one" "$work/ours"
      enough 10 "$work/ours" && break
   done
   awk '/^GRID/ { n++ } END { print "nodes", n }' "$3" >> "$work/ours"
   record gmsh "$1" "$work/ours"
   remove_results "$name"
}

# ------------------------------------------------------------------ the foot of a column, bolted, with friction: iterations
# FOOT_MODELS  SIZE_BOLTS, SIZE_BOLTS_none without MU, SIZE_cut_0.15_linear for CalculiX's law: the arguments of foot.sh
# FOOT_LIMIT   seconds, after which a run is stopped; its row says so
measure_foot() {
   local model words name status threads
   command -v gmsh > /dev/null || { echo 'bench: gmsh is not installed, the foot is left out' >&2; return; }
   threads=$(nproc)
   for model in ${FOOT_MODELS:-small_cut small_bars small_cut_none small_bars_none medium_cut medium_bars large_cut large_bars \
                               huge_cut huge_bars small_cut_0.15_linear medium_cut_0.15_linear}; do
      echo "bench: foot, $model" >&2
      read -ra words <<< "${model//_/ }"
      "$here/foot.sh" "$work" "${words[@]}" || fail "no foot $model"
      name=foot_${model/_0.15/}
      remove_results "$name"
      timeout "${FOOT_LIMIT:-1800}" "$program" --times -q --threads "$threads" -o "$work" "$work/$name.bdf" > "$work/said" 2>&1
      status=$?
      {
         case $status in
         0)   echo 'ends yes' ;;
         124) echo 'ends stopped' ;;
         *)   echo "ends status $status" ;;
         esac
         echo "threads $threads"
         figures "$work/$name.bdf"
         [ ! -f "$work/$name.out" ] || { of_listing "$work/$name.out"; iterations "$work/$name.out"; }
         awk '/^GRID/ { n++ } END { print "nodes", n }' "$work/foot_${words[0]}_${words[1]}_mesh.bdf"
      } > "$work/one"
      record foot "$model" "$work/one"
      case $model in *_linear) measure_ccx "$model" "$work/foot_${words[0]}_${words[1]}_mesh.bdf" ;; esac
      remove_results "$name"
      rm -f "$work/$name".*.csv
   done
}

# ------------------------------------------------------------------ a zoo of machines: iterations
# ZOO_MODELS   machines, all of zoo.sh if nothing is said; its other variables (VARIANTS, FULL, LIMIT, SCALE) count here too
measure_zoo() {
   command -v gmsh > /dev/null || { echo 'bench: gmsh is not installed, the zoo is left out' >&2; return; }
   echo 'bench: zoo' >&2
   "$here/zoo.sh" "$program" "$work/zoo" ${ZOO_MODELS:-} > "$work/said" || echo 'bench: machines of the zoo did not end' >&2
   awk '$2 ~ /^[0-9.]+_[a-z]+_[12]_/ {
           n = split("nodes ends increments iterations average most at over divided left laws all", name, " ")
           if ($4 == "0") $4 = "yes"
           for (i = 1; i <= n; i++) print "zoo", $1 "_" $2, name[i], $(i + 2)
        }' "$work/zoo/table" >> "$measured"
}

# The increments and iterations of the listing $1.
iterations() {
   awk -v head=x -v seconds=0 -f "$here/iterations.awk" "$1" |
      awk '{ print "increments_done", $2; print "iterations", $3; print "most", $4
             print "divided", ($5 == "-" ? 0 : split($5, list, ",")) }'
}

# The foot $1 of the mesh $2 by CalculiX, where there is ccx: seconds, increments and iterations of its table NAME.sta.
measure_ccx() {
   local name=ccx_$1 TIMEFORMAT='seconds %R' status
   command -v ccx > /dev/null || { echo 'bench: ccx is not installed, CalculiX is left out' >&2; return; }
   awk -F, -f "$here/foot_ccx.awk" "$2" > "$work/$name.inp" || fail "no input of CalculiX for $1"
   rm -f "$work/$name.sta"
   {
      { time (cd "$work" && OMP_NUM_THREADS=$(nproc) timeout "${FOOT_LIMIT:-1800}" ccx "$name" > "$name.log" 2>&1); } 2>&1
      status=$?
      [ ! -f "$work/$name.sta" ] || awk '$1 + 0 > 0 { n++; i += $4 } $1 + 0 == 2 && $6 > 0.999 { whole = 1 }
         END { print "increments_done", n + 0; print "iterations", i + 0; print "ends", (whole ? "yes" : "no") }' "$work/$name.sta"
   } > "$work/one"
   record foot_ccx "$1" "$work/one"
   rm -f "$work/$name".{dat,frd,cvg,12d,cel}
}

# ------------------------------------------------------------------ the machine
dgemm_rate() {
   echo 'bench: DGEMM' >&2
   "$work/dgemm_rate" > "$work/one" || fail 'DGEMM failed'
   record machine "$1" "$work/one"
}
{
   echo "machine - processor $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)"
   echo "machine - cores $(nproc)"
   echo "machine - memory $(awk '$1 == "MemTotal:" { printf "%.0f GiB", $2/1048576 }' /proc/meminfo)"
   echo "machine - date $(date +%Y-%m-%d)"
   echo "machine - load $(cut -d ' ' -f 1 /proc/loadavg)"
} >> "$measured"
dgemm_rate before
export OPENBLAS_CORETYPE=${OPENBLAS_CORETYPE:-$(sed -n 's/^kernel //p' "$work/one")} # CHOLMOD and jointfem use the same kernel
[ -x "$work/cholmod_once" ] || echo 'bench: no cholmod.h (Debian: libsuitesparse-dev): CHOLMOD is left out' >&2
for what in $wanted; do
   case $what in
   friction) measure_friction q4_400x80; measure_friction hex8_20x20x20 ;;
   threads)  for shape in ${THREAD_SHAPES:-hex8_30x30x30}; do measure_threads "$shape"; done ;;
   crossing) measure_crossing ;;
   gmsh)     measure_gmsh ;;
   foot)     measure_foot ;;
   zoo)      measure_zoo ;;
   mpi)      measure_mpi ;;
   lists)    measure_lists over_20x20x8 over_24x17x8 over_24x24x8 ;;
   identify) measure_identify hex8_11x11x64 hex8_20x20x23 ;;
   modes)    measure_modes q4_1000x200 hex8_40x40x40 hex8_50x50x50 ;;
   *)        measure_model "$what" ;;
   esac
done
dgemm_rate after
awk -f "$here/tables.awk" "$measured" | tee "$work/tables"
