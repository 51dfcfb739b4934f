# Test data made at random, through jointfit, and its cards through jointfem; part of fuzz.sh.

# data_seeds FOLDER: the files that others are made from
data_seeds() {
   local tests="$root/tests/fit"
   cp "$tests/sanad.dat" "$1"
   awk -v form=record -v n=4 -f "$tests/fig1b.awk" > "$1/record.dat"
   awk -v form=words -v n=4 -f "$tests/fig1b.awk" > "$1/words.dat"
   awk -v form=zero -v n=4 -f "$tests/masing.awk" > "$1/masing.dat"
   awk -v noise=0.01 -v seed=1 -f "$tests/normal_loops.awk" | awk 'NR == 1 || NR % 4 == 0' > "$1/loops.dat"
   awk -v into="$1/example_" '/^```/ { on = !on; next }
      on && /^(lambda|d) \[um\]/ { n++; file = into n ".dat" }
      !on { file = "" }
      file { print > file }' "$root/input/README.md"
}

# wrong_fit STATUS CARDS STDERR: what is wrong with a run of jointfit; nothing where all is well
wrong_fit() {
   if [ "$1" -ge 124 ]; then echo "status $1: a crash, or still running after 10 seconds"
   elif [ "$1" -ne 0 ] && [ "$1" -ne 1 ] && [ "$1" -ne 2 ]; then echo "exit status $1"
   elif grep -aqE 'Fortran runtime error|Program received|Backtrace|Sanitizer|runtime error:' "$3"; then echo "it says '$(grep -aE -m 1 'Fortran runtime error|Program received|Sanitizer|runtime error:' "$3")'"
   elif grep -aqE '(^|[^A-Za-z])(NaN|Infinity)([^A-Za-z]|$)|\*\*\*' "$2" "$3"; then echo "NaN, Infinity or asterisks: $(grep -aE -m 1 'NaN|Infinity|\*\*\*' "$2" "$3" | head -n 1)"
   elif [ "$1" -eq 0 ] && ! grep -aqE '^(JNORM|JSHEAR)' "$2"; then echo 'neither a card nor a word'
   elif [ "$1" -ne 0 ] && [ ! -s "$3" ]; then echo 'refused without a word'
   fi
}

# The number of the card in FILE: field 1, by its columns; one that fills a small field touches the next.
id_of_card() {
   awk '/^J(NORM|SHEAR)/ { print substr($0, 9, /\*/ ? 16 : 8) + 0; exit }' "$1"
}

# A deck with the cards of FILE
deck_of_cards() {
   local name id
   name=$(grep -aoE -m 1 '^J(NORM|SHEAR)' "$1")
   id=$(id_of_card "$1")
   printf 'SPC = 1\nSUBCASE 1\nLOAD = 10\nINCR = 5\nBEGIN BULK\nBLOCK2,1,1,1,1,0.,0.\n,10.,10.\n,20\nPSHELL,1,1,1.\nMAT1,1,9500.,,.25\nPMARK,20\n'
   printf 'JOINT,1,1,20\nSPC1,1,1,1\nFORCE,10,2,,1.,0.,-1.\nFORCE,10,4,,1.,0.,-1.\nJINCR,5,2\n'
   if [ "$name" = JNORM ]; then echo "PJOINT,1,$id"; else printf '%s\n' "JNORM,$((id % 7 + 1)),.01,.5" "PJOINT,1,$((id % 7 + 1)),$id,$id"; fi
   grep -a -v '^\$' "$1"
   echo ENDDATA
}

# Data FIRST to LAST through jointfit of all builds (beside jointfem)
batch_of_data() {
   local first=$1 last=$2 where=$3 build name program fit number entry id what status
   mkdir -p "$where/seeds"
   [ -e "$where/seeds/sanad.dat" ] || data_seeds "$where/seeds"
   rm -rf "$where/data"
   mkdir "$where/data"
   awk -v seed="$seed" -v from="$first" -v to="$last" -v folder="$where/data" -f "$here/random.awk" -f "$here/fuzz_data.awk" \
      "$where"/seeds/*.dat > "$where/data/list" || return 1
   cd "$where/data" || return 1
   for build in "${builds[@]}"; do
      name=${build%%=*} program=${build#*=}
      fit=$(dirname "$program")/jointfit
      [ -x "$fit" ] || continue
      while read -r number entry; do
         (limits "$name" "$program" 10; exec "$fit" ${entry%%:*} "data_${number%:}.dat") > cards 2> stderr < /dev/null
         status=$?
         what=$(wrong_fit $status cards stderr)
         if [ -z "$what" ] && [ $status -eq 0 ]; then
            id=$(grep -oE -e '--id [^ ]+' <<< "${entry%%:*}" | tail -n 1)
            [ "$(id_of_card cards)" = "$((10#0${id#--id }))" ] || [ -z "$id" ] || what="its card has the number $(id_of_card cards)"
         fi
         if [ -z "$what" ] && [ $status -eq 0 ]; then
            deck_of_cards cards > cards.bdf
            "$program" --check cards.bdf > stdout 2> stderr < /dev/null || what="its cards are refused: $(grep -a -m 1 ':' stderr)"
         fi
         echo 1 >> "$where/data_runs"
         [ -n "$what" ] || continue
         number=${number%:}
         cp "data_$number.dat" "$folder/failed/s${seed}_$number.dat"
         echo "FAILED: $name, data $number (${entry#*: }): $what" | cut -c 1-400
         echo "        again: cd $folder/failed && $fit ${entry%%:*} s${seed}_$number.dat"
         echo 1 >> "$where/failed"
      done < <(sed 's/^\([0-9]*\):/\1 :/' list)
   done
   cd "$root" || return 1
}
