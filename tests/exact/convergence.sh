# STEP tends to NEWTON: the error of the step-wise method on every loading deck, against NEWTON with many increments, as the number
# of increments of each stage is doubled. Prints one table; fails where an error does not fall. On one history with much unloading
# and reloading the error does not fall: that deck is shown, and its error must exceed 2 % somewhere in the second half of the
# counts. The tables of the verification manual (11.2) must have these errors.
#
# The error is the largest difference of lambda and delta_x over the nodes at the end of loading, relative to the largest lambda; a
# run without its rows fails. The order may be below 1: the first increment is a secant, and for m = 0.5 the secant alone leaves
# order 1/2.

counts='10 20 40 80 160'

# in_the_manual WORDS ERROR...: a row of the verification manual has these words and errors, each with as many decimals as it stands there
in_the_manual() {
   local words=$1
   shift
   if awk -F ' *[|] *' -v words="$words" -v errors="$*" '
         function decimals(text) { sub(/ %$/, "", text); return index(text, ".") ? length(text) - index(text, ".") : 0 }
         $2 == words && NF - 3 == split(errors, e, " ") {
            good = 1
            for (i = 1; i in e; i++) if ($(i + 2) != sprintf("%.*f %%", decimals($(i + 2)), 100*e[i])) good = 0
         }
         END { exit !good }' reference_output/README.md; then passed=$((passed + 1)); else fail "$words: the verification manual has not $*"; fi
}

printf '%-16s' deck; for n in $counts; do printf '%12s' "$n"; done; echo
while IFS='|' read -r deck stage newton history words; do
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
      holds "$deck: the error is small, the verification manual says that it is not" "max($4, $5) > 0.02"
      continue
   fi
   in_the_manual "$words" "$@"
   holds "$deck: the error does not fall" "$1 > $2 and $2 > $3 and $3 > $4 and $4 > $5 and $5 < 0.5*$1"
done <<'DECKS'
prism05|1|40||prism
normal_loop|1|40||one element
shear_pressure|2|640||shear under rising pressure
friction_full|2|640||block pushed towards its friction limit
lap_joint|2|160||lap joint
cantilever|2|160||cantilever
joint30|1|160||joint at 30 degrees
prism_history|3|160|history|
DECKS

# deflections and pressures of the history with many increments
for n in 320 640 1280; do variant prism_history STEP $n; done
for what in 'lambda deflections' 'pressure pressures'; do
   read -r column words <<< "$what"
   in_the_manual "$words" $(for n in $counts 320 640 1280; do
      value prism_history.STEP.$n rows "stage = 3 and increment = $n" with "$work/prism_history.NEWTON.160.joint.csv" \
         on stage on increment=160 on element print "max(abs($column - other.$column))/max(other.$column)"
   done)
done
