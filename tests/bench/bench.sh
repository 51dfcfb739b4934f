#!/usr/bin/env bash
# Speed on the prism of the worked example with finer and finer meshes, 20 increments each, all in one run: what counts are
# the ratios, the seconds are this machine's.
#
#    bench.sh PROGRAM WORK_FOLDER
#
# Columns: unknowns; entries of the profile; seconds for reading and checking alone; seconds for the whole run; seconds an
# increment; its growth exponent in the number of unknowns since the line before; peak memory where GNU time is installed.
set -eu
program=$1 work=$2
mkdir -p "$work"
export LC_ALL=C TIMEFORMAT=%R

deck() {
   sed -E "s/^BLOCK2 .*/BLOCK2,1,1,$1,$2,0.0,0.0/; s/^\\+ +150.0.*/+,150.0,100.0/; s/^\\+ +20 .*/+,20,21/
           s/^FORCE .*/FORCE,10,$((($1 + 1) * ($2 + 1))),,800.0,0.0,-1.0/; s/^(JINCR.*)/JINCR,20,20,ARITH,0.02/
           s/^( *INCR =).*/\\1 20/; s/^TITLE.*/TITLE = PRISM $1 X $2\\n ECHO = NO/; s/^( *INCR.*)/\\1\\n OUTPUT = NONE/" \
      input/prism05.bdf > "$work/prism_$1x$2.bdf"
}

printf '%10s %10s %12s %9s %9s %12s %8s %10s\n' mesh unknowns profile check_s run_s increment_s growth peak_MiB
before_n= before_t=
for mesh in '50 10' '100 20' '200 40' '400 80'; do
   set -- $mesh
   deck "$1" "$2"
   file=$work/prism_$1x$2
   check=$( { time "$program" --check "$file.bdf" > /dev/null; } 2>&1 )
   memory=-
   if [ -x /usr/bin/time ]; then
      { time /usr/bin/time -f '%M' -o "$work/memory" "$program" -q -o "$work" "$file.bdf"; } 2> "$work/seconds"
      memory=$(awk '{ printf "%.0f", $1 / 1024 }' "$work/memory")
   else
      { time "$program" -q -o "$work" "$file.bdf"; } 2> "$work/seconds"
   fi
   run=$(tail -n 1 "$work/seconds")
   unknowns=$(awk '$1 == "UNKNOWNS" { print $2 }' "$file.out")
   profile=$(awk '$1 == "PROFILE" { print $NF }' "$file.out")
   awk -v mesh="$1x$2" -v n="$unknowns" -v profile="$profile" -v check="$check" -v run="$run" -v memory="$memory" \
      -v n0="$before_n" -v t0="$before_t" 'BEGIN {
         t = (run - check) / 20; if (t < 5e-5) t = 5e-5
         growth = n0 == "" ? "-" : sprintf("%.2f", log(t / t0) / log(n / n0))
         printf "%10s %10d %12d %9.3f %9.3f %12.5f %8s %10s\n", mesh, n, profile, check, run, t, growth, memory
      }'
   before_n=$unknowns
   before_t=$(awk -v a="$run" -v b="$check" 'BEGIN { t = (a - b) / 20; if (t < 5e-5) t = 5e-5; print t }')
done
