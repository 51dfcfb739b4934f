#!/usr/bin/env bash
# The .vtu and .pvd files: meshio and vtk read back sample files, and files of decks with several stages, with temperatures and with
# modes; a full disk leaves no file.
#
#    vtu.sh PROGRAM WORK_FOLDER [X.pvd[@T0:T1:...] ...]
#
# Compiles vtu_sample.f90 with the modules that it needs, from the root of the project (FC, default gfortran). Collections of decks,
# and those named, are opened and checked for sizes, finite values and temperatures: all nodes are at T0, T1, ... at the times 0, 1,
# ... and on straight lines between; without @ there are none. PYTHON names a python3 that has meshio or vtk; without it meshio is
# installed in WORK_FOLDER/venv where pip can, and otherwise reading is skipped.
set -u
export LC_ALL=C
program=$1 work=$2
shift 2
here=$(dirname "$0")
passed=0 failed=0

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); echo "FAILED: $1"; }
finish() { echo "$passed passed, $failed failed"; [ $failed -eq 0 ] && [ $passed -gt 0 ]; exit; }

# ---- writing ----

mkdir -p "$work/object"
rm -rf "$work/sample" "$work/full"
mkdir "$work/sample" "$work/full"
sample=$work/vtu_sample
if ${FC:-gfortran} -O2 -std=f2018 -Wall -Wextra -Werror -fno-backtrace -J"$work/object" -o "$sample" \
   src/base/{kinds,c_library,incomplete_results,tolerances,text_tools,checksum,restart_stream}.f90 src/result/{output_file,vtu_file}.f90 "$here/vtu_sample.f90"
then pass; else fail 'vtu_sample.f90 does not compile'; finish; fi

"$sample" "$work/sample"
[ $? -eq 0 ] && pass || fail 'the sample files are not written'
[ -z "$(find "$work/sample" -name '*.part')" ] && pass || fail 'a .part file is left'

# A limit on the size of files stands for the full disk: with its signal ignored (and not caught for a backtrace), a
# write beyond it fails in the same way. The limits meet the header, an array, and the last bytes of the file.
limited() { (trap '' XFSZ; ulimit -f "$1"; shift; exec "$sample" "$work/full" "$@") > "$work/log" 2>&1; }
for n in 2000 100000; do
   "$sample" "$work/full" $n > "$work/log" && pass || fail "$n points: not written"
   size=$(wc -c < "$work/full/big.vtu")
   rm -f "$work/full/big.vtu"
   for kilobytes in 0 1 16 100 $(((size - 1) / 1024)); do
      limited $kilobytes $n
      status=$?
      [ $status -eq 1 ] && pass || fail "$n points, $kilobytes kB: status $status"
      [ -z "$(ls -A "$work/full")" ] && pass || fail "$n points, $kilobytes kB: left $(ls -A "$work/full")"
      rm -f "$work/full"/*
   done
done
limited 0
[ $? -eq 1 ] && [ -z "$(ls -A "$work/full")" ] && pass || fail "no room at all: left $(ls -A "$work/full")"
"$sample" "$work/full/no/folder" > "$work/log" 2>&1
[ $? -eq 1 ] && pass || fail 'a missing folder passes unseen'

# ---- decks ----

deck=$work/deck
mkdir -p "$deck/vibration"
cp input/vibration/beams.inc "$deck/vibration"
sed -E 's/^( *INCR = .*)/\1\n  OUTPUT = LAST, VTU/; /OUTPUT = (ALL|JOINT|LAST|NONE)$/d' input/prism_history.bdf > "$deck/history.bdf"
sed -e '/^ *TEMPERATURE(LOAD) = 20/d' -e 's/^OUTPUT = .*/OUTPUT = LAST, STEPS/' input/flange_warm.bdf > "$deck/warm.bdf"
sed 's/^OUTPUT = NONE/OUTPUT = VTU/' input/lap_beams.bdf > "$deck/lap_beams.bdf"
for name in history warm lap_beams; do "$program" -q -o "$deck" "$deck/$name.bdf" > "$work/log" 2>&1; done
set -- "$deck/history.pvd" "$deck/lap_beams.pvd" "$deck/warm.pvd@20:20:50:20" "$@"

# ---- reading ----

can_read() { "$1" -c 'import meshio' 2> /dev/null || "$1" -c 'import vtk' 2> /dev/null; }

python=${PYTHON:-python3}
if ! "$python" -c 'import xml.etree' 2> /dev/null; then
   echo 'skipped: reading .vtu files back: there is no python3'
   finish
fi
if ! can_read "$python"; then
   if [ ! -x "$work/venv/bin/python" ]; then # built once, used again
      "$python" -m venv "$work/venv" > "$work/log" 2>&1 || rm -rf "$work/venv"
   fi
   own=$work/venv/bin/python
   if [ -x "$own" ] && ! can_read "$own"; then
      timeout 180 "$own" -m pip install -q --retries 0 --timeout 15 --disable-pip-version-check meshio \
         > "$work/log" 2>&1
   fi
   if can_read "$own"; then
      python=$own
   else
      echo 'skipped: reading .vtu files back: neither meshio nor vtk is there, and pip cannot install meshio'
   fi
fi
"$python" "$here/vtu_read.py" "$work/sample" "$@" > "$work/log" 2>&1
status=$?
grep -v -E '^[0-9]+ passed, [0-9]+ failed$' "$work/log"
last=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$work/log" | tail -n 1)
if [ -z "$last" ]; then
   fail "vtu_read.py ended without a count, with status $status"
else
   set -- $last
   passed=$((passed + $1)) failed=$((failed + $3))
   [ $status -ne 0 ] && [ "$3" -eq 0 ] && fail "vtu_read.py: status $status"
fi
finish
