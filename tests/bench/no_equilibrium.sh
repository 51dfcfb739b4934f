#!/usr/bin/env bash
# Machines of the zoo (zoo.sh) with a force that they do not bear: after how many iterations NEWTON says so.
#
#    no_equilibrium.sh PROGRAM WORK [MACHINE...]
#
# Each of the stages 2 to 4 alone, from the end of stage 1, with FACTOR (10) times its force; VARIANT (0.15_book_1_free) as in zoo.sh.
# LIMIT (300) is the seconds after which a run is stopped. A line of the table: machine, direction, exit status, iterations of the stage,
# what is missing. Status 1 where a run without equilibrium has taken more than 60 iterations in the
# stage, and 20 more where the limit load is not confirmed, or was stopped.
set -u
export LC_ALL=C OPENBLAS_NUM_THREADS=1
[ $# -ge 2 ] || { sed -n 's/^#    no_equilibrium.sh/usage: no_equilibrium.sh/p' "$0" >&2; exit 1; }
here=$(cd "$(dirname "$0")" && pwd)
program=$1 work=$2 factor=${FACTOR:-10} variant=${VARIANT:-0.15_book_1_free}
shift 2
[ $# -gt 0 ] || set -- lathe wedges motor vflat cross_slide knee gantry spindle dovetail rotary taper rings lap pipe
VARIANTS=$variant "$here/zoo.sh" - "$work" "$@" > /dev/null || exit 1
verdict=0
for machine; do
   stage=1
   for direction in x y z; do
      stage=$((stage + 1))
      name=${machine}_${direction}_times_$factor
      awk -v stage="$stage" -v factor="$factor" '
         /^SUBCASE/ { left_out = $2 != 1 && $2 != stage }
         /^BEGIN/ { left_out = 0 }
         left_out { next }
         $1 == "LOAD" && $2 == 29 + stage { print "LOAD," $2 ",1.0,1.0,10," factor ".0," 19 + stage; next }
         { print }' "$work/${machine}_$variant.bdf" > "$work/$name.bdf"
      timeout "${LIMIT:-300}" "$program" -q -o "$work" "$work/$name.bdf" > "$work/$name.said" 2>&1
      status=$?
      iterations=$(awk -v only=$stage -f "$here/iterations.awk" "$work/$name.out" 2> /dev/null | awk '{ print $2 }')
      printf '%-12s %s %4s %5s  %s\n' "$machine" $direction $status "${iterations:-0}" \
         "$(sed -n 's/.*: \([-+.0-9E]* of force are missing\).*/\1/p' "$work/$name.said" | head -n 1)"
      case $status in
      0) ;;
      3)
         most=60
         grep -q 'limit load is not confirmed' "$work/$name.said" && most=80
         [ "${iterations:-0}" -le $most ] || verdict=1 ;;
      *) verdict=1 ;;
      esac
   done
done
exit $verdict
