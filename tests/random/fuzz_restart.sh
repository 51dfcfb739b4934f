# Damaged restart files, taken up with --resume; part of fuzz.sh. A file that is not whole, of another deck or no restart file at all must
# be refused with a word, and leave no result; one that is whole is taken up.

# start_restarts PROGRAM WHERE: runs that leave a restart file, of every deck of tests/random; their names
start_restarts() {
   local deck name
   rm -rf "$2"
   mkdir "$2"
   for deck in "$here"/*.bdf; do
      name=$(basename "$deck" .bdf)
      sed 's/^METHOD = .*/&\nRESTART = 1/' "$deck" > "$2/$name.bdf"
      (cd "$2" && "$1" -q --threads 1 "$name.bdf" > stdout 2> stderr < /dev/null)
      [ -s "$2/$name.restart" ] && echo "$name"
   done
}

# damage_file FILE OTHER SIZE KIND AT BYTE: FILE of so many bytes is spoilt; prints how
damage_file() {
   local file=$1
   case $4 in
   0) head -c "$5" "$file" > "$file.new"; echo "cut behind byte $5" ;;
   1) { cat "$file"; head -c $(($6 + 1)) /dev/zero; } > "$file.new"; echo "$(($6 + 1)) bytes put behind it" ;;
   2) { tail -c "+$(($5 + 2))" "$file"; head -c $(($5 + 1)) "$file"; } > "$file.new"; echo "its parts swapped at byte $(($5 + 1))" ;;
   3) cat "$2" > "$file.new"; echo 'that of another deck' ;;
   4) { head -c "$5" "$file"; tail -c "+$(($5 + 2))" "$file"; } > "$file.new"; echo "without byte $(($5 + 1))" ;;
   5) { head -c "$5" "$file"; printf 'no byte of it%s' "$6"; tail -c "+$(($5 + 1))" "$file"; } > "$file.new"; echo "with a text behind byte $5" ;;
   *) { head -c "$5" "$file"; printf "\\x$(printf %x "$6")"; tail -c "+$(($5 + 2))" "$file"; } > "$file.new"; echo "byte $(($5 + 1)) is $6" ;;
   esac
   mv "$file.new" "$file"
}

# wrong_resume STATUS DAMAGED NAME: what is wrong with the run in this folder; nothing where all is well
wrong_resume() {
   local left
   left=$(find . -maxdepth 1 -name "$3.*" ! -name "$3.bdf" ! -name "$3.restart" | tr '\n' ' ')
   if [ "$1" -ge 124 ]; then echo "status $1: a crash, or still running after 10 seconds"
   elif grep -aqE 'Fortran runtime error|Program received|Backtrace|Sanitizer|runtime error:' stderr; then echo "it says '$(grep -aE -m 1 'Fortran runtime error|Program received|Sanitizer|runtime error:' stderr)'"
   elif [ "$2" = no ]; then [ "$1" -eq 0 ] || echo "status $1 of a file that is whole: $(tail -n 1 stderr)"
   elif [ "$1" -eq 0 ]; then echo 'a damaged file is taken up'
   elif [ ! -s stderr ]; then echo 'refused without a word'
   elif [ -n "$left" ]; then echo "refused, and left $left"
   fi
}

# Restart files FIRST to LAST with all builds that know --resume
batch_of_restarts() {
   local first=$1 last=$2 where=$3 build name program names other of kind at byte number how damaged what status size
   for build in "${builds[@]}"; do
      name=${build%%=*} program=${build#*=}
      "$program" --help | grep -q -e --resume || continue
      names=$(start_restarts "$program" "$where/whole")
      [ "$(echo "$names" | wc -l)" -ge 2 ] || { echo "FAILED: $name: no restart files to damage"; echo 1 >> "$where/failed"; return 0; }
      while read -r number of kind at byte; do
         set -- $names
         shift $((of % $#))
         rm -rf "$where/resume"
         mkdir "$where/resume"
         cp "$where/whole/$1.bdf" "$where/whole/$1.restart" "$where/resume"
         other=$(echo "$names" | grep -vx "$1" | head -n 1)
         size=$(wc -c < "$where/resume/$1.restart")
         damaged=no how='whole'
         [ "$kind" = 9 ] || how=$(damage_file "$where/resume/$1.restart" "$where/whole/$other.restart" "$size" "$kind" $((at % size)) "$byte")
         cmp -s "$where/whole/$1.restart" "$where/resume/$1.restart" || damaged=yes
         cd "$where/resume" || return 1
         (limits "$name" "$program" 10; exec "$program" -q --threads 1 --resume "$1.bdf") > stdout 2> stderr < /dev/null
         status=$?
         what=$(wrong_resume $status $damaged "$1")
         [ -n "$what" ] || [ $damaged = yes ] || for ending in out joint.csv stage.csv; do
            cmp -s "$1.$ending" "$where/whole/$1.$ending" || what="$1.$ending is not that of the run before"
         done
         cd "$root" || return 1
         echo 1 >> "$where/restart_runs"
         [ -n "$what" ] || continue
         mkdir -p "$folder/failed/s${seed}_$number"
         cp "$where/resume/$1.bdf" "$where/resume/$1.restart" "$folder/failed/s${seed}_$number"
         echo "FAILED: $name, restart file $number ($1, $how): $what" | cut -c 1-400
         echo "        again: cd $folder/failed/s${seed}_$number && $program --resume $1.bdf"
         echo 1 >> "$where/failed"
      done < <(awk -v seed="$seed" -v from="$first" -v to="$last" -f "$here/random.awk" -f <(echo 'BEGIN {
         for (k = from; k <= to; k++) { start_random(k); print k, random(100), random(10), random(1000000), random(256) } }'))
   done
}
