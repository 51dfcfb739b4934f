# STEP tends to NEWTON: the error of the step-wise method on every loading deck, against NEWTON with many increments, as the number
# of increments of each stage is doubled. Prints one table; fails where an error does not fall. On one history with much unloading
# and reloading the error does not fall: that deck is shown, and its error must exceed 2 % somewhere in the second half of the
# counts.
#
# The error is the largest difference of lambda and delta_x over the nodes at the end of loading, relative to the largest lambda; a
# run without its rows fails. The order may be below 1: the first increment is a secant, and for m = 0.5 the secant alone leaves
# order 1/2.

counts='10 20 40 80 160'

printf '%-16s' deck; for n in $counts; do printf '%12s' "$n"; done; echo
while read -r deck stage newton history; do
   variant "$deck" NEWTON "$newton" || continue
   errors=
   printf '%-16s' "$deck"
   for n in $counts; do
      variant "$deck" STEP "$n" || continue 2
      errors="$errors $(value "$deck.STEP.$n" rows "stage = $stage and increment = $n" \
         with "$work/$deck.NEWTON.$newton.joint.csv" on stage on increment=$newton on element \
         print 'max(max(abs(lambda - other.lambda), abs(delta_x - other.delta_x)))/max(other.lambda)')"
   done
   printf '%12.3e' $errors
   echo
   # sixteen times as many increments leave less than half of it, also where the order is 1/2 or a little below
   set -- $errors
   [ $# -eq 5 ] || { fail "$deck: an error is missing"; continue; }
   if [ "$history" ]; then
      holds "$deck: the error is small, README says that it is not" "max($4, $5) > 0.02"
      continue
   fi
   holds "$deck: the error does not fall" "$1 > $2 and $2 > $3 and $3 > $4 and $4 > $5 and $5 < 0.5*$1"
done <<'DECKS'
prism05 1 40
normal_loop 1 40
shear_pressure 2 640
friction_full 2 640
lap_joint 2 160
cantilever 2 160
joint30 1 160
prism_history 3 160 history
DECKS
