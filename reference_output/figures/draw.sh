#!/usr/bin/env bash
# The pictures of this folder, PNG and SVG, from the joint histories of the decks. Needs gnuplot.
#
#    draw.sh PROGRAM WORK_FOLDER
set -eu
program=$1 work=$2
here=$(dirname "$0")
command -v gnuplot > /dev/null || { echo 'make figures needs gnuplot: apt-get install gnuplot-nox'; exit 1; }
mkdir -p "$work"
"$program" -q -o "$work" input/prism03.bdf input/prism05.bdf input/prism10.bdf input/prism15.bdf
for script in "$here"/*.gp; do
   name=$(basename "$script" .gp)
   for terminal in 'pngcairo size 1000,700 font "Helvetica,14"' 'svg size 1000,700 font "Helvetica,14" background "white"'; do
      suffix=${terminal%% *}
      suffix=${suffix%cairo}
      gnuplot -e "set terminal $terminal; set output '$here/$name.$suffix'; folder = '$work/'" "$here/style.inc" "$script"
   done
   echo "$here/$name.png, .svg"
done
