# The bodies in pieces, NAME.pvtu: each of two or three processes writes its own piece. compare_pieces.f90 joins the pieces and
# compares them with the bodies of one process, value by value. Also: results that are not written in pieces, and old pieces of an
# earlier run.
folders_of_decks "$work/decks"
mkdir -p "$work"/{one,two,three,serial,again}
compare=$work/compare_pieces
${FC:-gfortran} -O2 -std=f2018 -Wall -Wextra -Werror -fno-backtrace -fcheck=all -o "$compare" tests/solver/compare_pieces.f90 ||
   { fail 'compare_pieces.f90 does not compile'; return; }

# shown DECK SOLVER OUTPUT: the deck by SOLVER with this OUTPUT in all stages
shown() { with_solver "$1" "$2" | sed -e '/^ *OUTPUT *=/d' -e "s/^SOLVER = .*/&\nOUTPUT = $3/"; }

# run N FOLDER NAME [OPTION]
run() {
   local words
   words=$(on_processes "$1" "$work/$2" "${@:4}" "$work/decks/$3.bdf" 2>&1) || fail "$3 on $1: $(tail -n 1 <<< "$words")"
}

# pieces_of FOLDER NAME PIECES ELEMENTS NODES: the bodies in FOLDER are those of one process, in so many pieces, at least so many of them
# with elements and so many nodes in more than one
pieces_of() {
   local folder=$1 name=$2 pieces=$3 elements=$4 nodes=$5 n=0 file said ending with_elements common
   for file in "$work/one/$name".*vtu; do
      ending=${file#"$work/one/$name"}
      case $ending in *.joint.vtu|*.modes.vtu) continue;; esac
      n=$((n + 1))
      ending=${ending%vtu}
      if ! said=$("$compare" "$file" "$work/$folder/$name${ending}pvtu" 1e-9 2>&1); then fail "$name, $folder: $said"; return; fi
      read -r with_elements common <<< "$said"
      if [ "$(ls "$work/$folder/$name$ending"p[0-9]*.vtu | wc -l)" -ne "$pieces" ] || [ "$with_elements" -lt "$elements" ] ||
         [ "$common" -lt "$nodes" ]; then fail "$name, $folder: $said elements and common nodes in the pieces of ${ending}pvtu"; return; fi
   done
   if [ $n -eq 0 ] || [ "$(ls "$work/$folder/$name".*pvtu | wc -l)" -ne $n ] || ls "$work/$folder" | grep -q '\.part$'; then
      fail "$name, $folder: other indexes than the $n, or parts"
   elif [ -e "$work/one/$name.pvd" ] &&
      ! sed 's/\.pvtu"/.vtu"/' "$work/$folder/$name.pvd" | cmp -s - "$work/one/$name.pvd"; then fail "$name, $folder: another list"
   else pass
   fi
}

# two bricks one on the other: of three processes one has none
two_bricks='SPC = 1\nSUBCASE 1\n  LOAD = 1\nBEGIN BULK\nBLOCK3,1,1,1,1,2\n+,10.0,10.0,20.0\n+,,,,,21\nPMARK,21\nPSOLID,1,1\nMAT1,1,9500.0,,0.25
SPCM,1,123,21\nFORCE,1,12,,100.0,0.3,0.5,-1.0\nENDDATA'
printf "SOLVER = PETSC\nOUTPUT = VTU\n$two_bricks\n" > "$work/decks/bricks.bdf"

# of the plane, of the ring with temperatures, of second order, with the section of a bolt
# The solver, the fewest pieces that have elements, and the fewest common nodes on two processes, of which two bodies have none
while read -r name solver least common; do
   [ $name = bricks ] || shown "input/$name.bdf" $solver 'LAST, STEPS' > "$work/decks/$name.bdf"
   run 1 one $name
   run 2 two $name
   run 3 three $name
   pieces_of two $name 2 $least $common
   pieces_of three $name 3 $least 0
   if ls "$work/one/$name".*pvtu "$work/one/$name".*p0.vtu > /dev/null 2>&1; then fail "$name on one process: pieces"; else pass; fi
done <<'END'
prism_history PETSC 2 1
flange_warm PETSC 2 0
column_tetra10 MUMPS 2 1
solid_bolt PETSC 2 1
bricks PETSC 1 0
END

# ------------------------------------------------------------------ what is not in pieces; what an earlier run has left
# equations that are not dealt out: as without MPI, to the same bytes
shown input/flange_warm.bdf AUTO 'LAST, VTU' > "$work/decks/flange_warm.bdf"
"$program" -q --threads 1 -o "$work/serial" "$work/decks/flange_warm.bdf" > /dev/null 2>&1
run 2 two flange_warm
if diff -q <(cd "$work/serial" && cat flange_warm.*vtu) <(cd "$work/two" && cat flange_warm.*vtu) > /dev/null; then pass
else fail 'flange_warm by AUTO on two: not the files of the program without MPI, or the pieces of the run before'
fi
# the program without MPI takes the pieces of a run before away, with a list and without
for name in column_tetra10 bricks; do
   sed '/^SOLVER/d' "$work/decks/$name.bdf" > "$work/again/$name.bdf"
   "$program" -q -o "$work/three" "$work/again/$name.bdf" > /dev/null 2>&1
   if ls "$work/three/$name".*pvtu "$work/three/$name".*p[0-9]*.vtu > /dev/null 2>&1; then fail "$name: pieces of a run before are left"
   else pass
   fi
done

# ------------------------------------------------------------------ pieces pass through a restart file
sed 's/^OUTPUT.*/&\nRESTART = 1/' "$work/decks/prism_history.bdf" > "$work/again/prism_history.bdf"
cp "$work/again/prism_history.bdf" "$work/decks/"
run 2 again prism_history
mkdir "$work/first" && mv "$work/again"/prism_history.*vtu "$work/first"
run 2 again prism_history --resume
if diff -q <(cd "$work/first" && cat prism_history.*vtu) <(cd "$work/again" && cat prism_history.*vtu) > /dev/null &&
   [ -s "$work/first/prism_history.1.1.p1.vtu" ]; then pass; else fail 'prism_history: other pieces after --resume'; fi
