#!/usr/bin/env bash
# The worked examples of src/additions.md: each patch applies to src as it stands, alone and with the others; the program with all
# four is built and runs their decks to their exact answers; the page shows the lines of the patches.
#
#    tour.sh QUERY WORK_FOLDER
#
# And the law of input/course.md, lambda = c p/(m + p): one file changed, linked with the objects of the program as it is.
#
# The program is built without optimisation; what an earlier run has built and nothing has changed is kept.
set -u
query=$1 top=$2
here=tests/source work=$2/decks program=$2/tree/bin/jointfem
. tests/exact/lib.sh
examples='card element law solver'
rm -rf "$work" "$top/alone" "$top/next"
mkdir -p "$work" "$top/tree"

# source_tree FOLDER: what the program is built from
source_tree() {
   local file
   mkdir -p "$1/input" "$1/tests"
   cp -R Makefile src "$1" && cp -R tests/runner "$1/tests" && cp input/cards.md "$1/input"
   for file in $(awk '$1 == "include" { print $2 }' Makefile); do
      mkdir -p "$1/$(dirname "$file")" && cp "$file" "$1/$file"
   done
}

# applies WORDS FOLDER EXAMPLE
applies() { if awk -v root="$2" -f $here/apply.awk $here/$3.patch; then passed=$((passed + 1)); else fail "$1"; fi; }

# becomes OLD NEW: files that are the same keep their times
becomes() {
   local file
   (cd "$2" && find . -type f) | while read -r file; do
      cmp -s "$2/$file" "$1/$file" || { mkdir -p "$(dirname "$1/$file")" && cp "$2/$file" "$1/$file"; }
   done
   (cd "$1" && find src -type f) | while read -r file; do [ -f "$2/$file" ] || rm "$1/$file"; done
}

source_tree "$top/next"
for example in $examples; do
   source_tree "$top/alone/$example"
   applies "$example alone" "$top/alone/$example" $example
   applies "$example with the others" "$top/next" $example
   if command -v git > /dev/null; then # which counts the lines of the hunks too
      if git apply --check $here/$example.patch; then passed=$((passed + 1)); else fail "git apply --check $here/$example.patch"; fi
   fi
done
becomes "$top/tree" "$top/next"
if [ $failed -gt 0 ] || ! ${MAKE:-make} --no-print-directory -s -C "$top/tree" BUILD=build BIN=bin \
   FFLAGS='-O0 -Wno-maybe-uninitialized -Werror' bin/jointfem \
   < /dev/null > "$top/build.log" 2>&1; then
   cat "$top/build.log"
   fail 'the program with the four examples is built'
   echo "$passed passed, $failed failed"
   exit 1
fi
passed=$((passed + 1))

# deck NAME [SED_SCRIPT [AS]]: run tests/source/NAME.bdf, changed
deck() {
   sed -E "${2:-}" $here/$1.bdf > "$work/${3:-$1}.bdf"
   run "${3:-$1}"
}
# refused WORDS NAME SED_SCRIPT PATTERN: tests/source/NAME.bdf, changed, has an error whose message holds PATTERN
refused() {
   sed -E "$3" $here/$2.bdf > "$work/bad.bdf"
   if cmp -s $here/$2.bdf "$work/bad.bdf"; then fail "$1: nothing changed"; else run bad 2 && says "$1" "$work/bad.log" "$4"; fi
}
stage_value() { "$query" "$work/$1.stage.csv" rows "stage = $2 and joint = ${4:-1}" print "$3"; }

# SPCP
exact='pressure = load within 1e-12 and lambda = 2e-3*load^0.5 within 1e-14'
deck card && {
   ask 'SPCP, an even pressure' card count 36 all "$exact"
   near 'SPCP, displacement of the top' "$(stage_value card 1 u_max)" 'sqrt(2*1.5e-5^2+2.1e-3^2)' 1e-10
   deck card 's/^SPCP +1 +1 .*/SPCM,1,1,23/; s/^SPCP +1 +2 .*/SPCM,1,2,24/' marked &&
      same 'SPCP is SPCM' "$(cksum < "$work/card.joint.csv")" "$(cksum < "$work/marked.joint.csv")"
   refused 'a plane without nodes' card 's/^(SPCP +1 +1 +)0.0 /\10.01/' 'SPCP, field 4, X: no GRID lies in this plane'
   refused 'a plane without a normal' card 's/-0.3$/0.0/' 'NX: the normal of the plane has no direction'
   "$program" --help SPCP > "$work/help.txt"
   says 'the manual knows the card' "$work/help.txt" 'Holds all nodes in a plane'
}

# CPYRAM of thirteen nodes
deck element && {
   ask 'CPYRAM, an even pressure' element rows 'joint = 1 and stage = 1' count 12 \
      all 'pressure = 2*load within 1e-11 and lambda = 2e-3*(2*load)^0.5 within 1e-13'
   near 'CPYRAM, displacement of the top' "$(stage_value element 1 u_max)" 'sqrt(2*3e-5^2+(2e-3*2^0.5+1e-4)^2)' 1e-10
   near 'CPYRAM, an even stress' "$(stage_value element 1 mises_centre)" 2 1e-10
   ask 'CPYRAM, pressure on triangles' element rows 'joint = 2 and stage = 1' by increment all 'sum(force) = 200*load within 1e-9'
   ask 'CPYRAM, volume of the block' element rows 'joint = 1 and stage = 2' by increment all 'sum(force) = 200 + load within 1e-9'
   ask 'CPYRAM, volume of a pyramid' element rows 'joint = 2 and stage = 2' by increment \
      all 'sum(force) = 200 + load/3 within 1e-9'
   deck element 's/^  LABEL = PRESSED/  OUTPUT = LAST, VTU/' seen && od -An -v -tx1 "$work/seen.1.vtu" | tr -d ' \n' > "$work/seen.hex"
   says 'CPYRAM, seven pyramids for ParaView' "$work/seen.hex" '07000000000000001b1b1b1b1b1b1b'
   refused 'a pyramid turned round' element 's/^CPYRAM  7 .*/CPYRAM,7,1,14,13,12,11,15,,25/' \
      'element 7 has no positive volume'
   refused 'a face that is none' element 's/  11      12$/  11      13/; s/  14      11$/  14      15/' \
      'expected two opposite corners of the base, or the two'
}

# JNEXP
curve='2e-3*log(1 + pressure/0.5)'
deck law && {
   ask 'JNEXP, NEWTON on the curve' law rows 'stage = 1' count 6 \
      all "lambda = $curve within 1e-14 and pressure = 1.3*load within 1e-12 and branch = \"LOAD\""
   ask 'JNEXP, relieved along E_u' law rows 'stage = 2' count 6 \
      all 'lambda = 2e-3*log(3.6) - (1.3 - pressure)/9500 within 1e-14 and branch = "UNLOAD"'
   near 'JNEXP, work put in' "$(awk '/ENERGY OF JOINTS, STAGE 1/ { n = NR + 5 } NR == n { print $2 }' "$work/law.out")" \
      '100*(2e-3*1.3 - 0.5*2e-3*log(3.6))' 5e-6
   says 'the listing names the curve' "$work/law.out" 'EXPONENTIAL JOINTS, P = P_E (EXP(LAMBDA/C) - 1)'
   deck law 's/NEWTON/STEP/' law_step && ask 'JNEXP, STEP' law_step rows 'stage = 1' count 6 all "lambda = if(before(load) > 0,
      before(lambda) + (pressure - before(pressure))*2e-3/(0.5 + before(pressure)), $curve) within 1e-14"
   deck law 's/NEWTON/BACK/; /^SUBCASE 2/,/^BEGIN/{/^BEGIN/!d}' law_back && \
      near 'JNEXP, BACK' "$(cell law_back 1 1 1 lambda)" '2e-3*log(3.6)' 1e-9
   for method in BACK NEWTON; do # a law without M
      sed -E "s/^METHOD.*/METHOD = $method\nTOL = 1.E-12/; s/^JNORM .*/JNEXP   1       2.0-3   0.5/; s/^JINCR.*/JINCR,15,1/" input/prism15.bdf \
         > "$work/prism_$method.bdf"
      run prism_$method
   done
   same_rows 'JNEXP, the prism by BACK and by NEWTON' prism_BACK prism_NEWTON 1e-9
   refused 'one number, one law' law '/^JNEXP/{p;s/.*/JNORM,1,8.0-3,0.5/}' 'JNORM 1 is given twice'
   refused 'what the card needs' law 's/^JNEXP.*/JNEXP,1,2.0-3/' "JNEXP, field 4, PE: blank"
}

# SOLVER = BAND
deck solver && deck solver 's/BAND/SKYLINE/' skyline && {
   same_rows 'BAND and SKYLINE, a bolted cantilever' solver skyline 1e-10 $both
   says 'the listing names BAND' "$work/solver.out" 'BAND'
   near 'BAND, displacements' "$(stage_value solver 2 u_max)" "$(stage_value skyline 2 u_max)" 1e-11
}
for solver in BAND SKYLINE; do # a section locked, increments by STEP
   for name in solid_bolt prism15; do
      sed "0,/^TITLE/s/^TITLE/SOLVER = $solver\nTOL = 1.E-12\nTITLE/" input/$name.bdf > "$work/$name.$solver.bdf"
      run $name.$solver
   done
   sed "s/BAND/$solver/; /^SPCM/d; /^SPC =/d; s/^SPCD.*//" $here/solver.bdf > "$work/loose.$solver.bdf"
   run loose.$solver 3
   cards "soft.$solver" <<DECK
SOLVER = $solver;SPC = 1;SUBCASE 1;  LOAD = 10
BEGIN BULK;BLOCK2,1,1,8,6,0.0,0.0;+,100.0,60.0;PSHELL,1,1,20.0;MAT1,1,9500.0,,0.0;MAT1,2,1.0-6,,0.0
GRID,900,,50.0,-100.0;CROD,901,2,29,900;PROD,2,2,100.0;SPC1,1,12,900;SPC1,1,1,1,THRU,63;FORCE,10,29,,800.0,0.0,-1.0
ENDDATA
DECK
   run soft.$solver
done
same_rows 'BAND and SKYLINE, a locked section' solid_bolt.BAND solid_bolt.SKYLINE 1e-10
same_rows 'BAND and SKYLINE, STEP' prism15.BAND prism15.SKYLINE 1e-12
same 'BAND, condition of a soft bar' "$(grep -o 'condition.*' "$work/soft.BAND.log")" "$(grep -o 'condition.*' "$work/soft.SKYLINE.log")"
says 'BAND, condition of a soft bar' "$work/soft.BAND.log" 'condition of the stiffness about'
same 'BAND names what is loose' "$(cut -d: -f2- "$work/loose.BAND.log")" "$(cut -d: -f2- "$work/loose.SKYLINE.log")"

# another law in one file
changed=$top/curve release=$(dirname "$query")/../release
mkdir -p "$changed/src/joint" && cp src/joint/normal_curve.f90 "$changed/src/joint"
applies 'the law of the course' "$changed" curve
if command -v git > /dev/null; then
   if git apply --check $here/curve.patch; then passed=$((passed + 1)); else fail "git apply --check $here/curve.patch"; fi
fi
if "${FC:-gfortran}" -O2 -fopenmp -I"$release" -J"$changed" -c "$changed/src/joint/normal_curve.f90" -o "$changed/normal_curve.o" &&
   "${FC:-gfortran}" -O2 -fopenmp -I"$release" -o "$changed/jointfem" src/jointfem.f90 "$changed/normal_curve.o" \
   $(ls "$release"/*.o | grep -v /normal_curve.o) $(sed -n 's/^LIBRARIES *= *//p' Makefile); then passed=$((passed + 1))
else fail 'the program with the law of the course is built'; fi
program=$changed/jointfem
sed 's/^TITLE/METHOD = NEWTON\nTITLE/' input/one_element.bdf > "$work/course.bdf"
run course && {
   ask 'the law of the course, on the curve' course rows 'stage = 1' count 4 \
      all 'lambda = 8e-3*pressure/(0.5 + pressure) within 1e-15 and pressure = load within 1e-12'
   ask '... relieved along E_u' course rows 'stage = 2' all 'lambda = 8e-3/1.5 - (1 - pressure)/9500 within 1e-15'
   near '... work put in' "$(awk '/ENERGY OF JOINTS, STAGE 1/ { n = NR + 5 } NR == n { print $2 }' "$work/course.out")" \
      '100*0.5*(8e-3*log(3) - 8e-3/1.5)' 5e-6
   for stage in 1 2; do
      says "... the answer in the course, stage $stage" input/course.md \
         "^| 6 |.* $(awk '/LARGEST DISPLACEMENT +[0-9]/ { print $3 }' "$work/course.out" | sed -n "${stage}p") mm"
   done
}
sed 's/^METHOD.*/METHOD = STEP/' "$work/course.bdf" > "$work/course_step.bdf"
run course_step && ask '... STEP' course_step rows 'stage = 1' all 'lambda = if(before(load) > 0,
   before(lambda) + (pressure - before(pressure))*0.5*8e-3/(0.5 + before(pressure))^2, 8e-3*pressure/(0.5 + pressure)) within 1e-15'
sed 's/^METHOD.*/METHOD = BACK/; /^SUBCASE 2/,/^BEGIN/{/^BEGIN/!d}' "$work/course.bdf" > "$work/course_back.bdf"
run course_back && near '... BACK' "$(cell course_back 1 1 1 lambda)" '8e-3/1.5' 1e-9

echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
