#!/usr/bin/env bash
# Prints a LISTING without the rows that rounding rules: those of CONVERGENCE HISTORY and ERROR OF PATH (differs.md).
#
#    printed.sh LISTING
awk '/^ [A-Z]/ { on = /^ (CONVERGENCE HISTORY|ERROR OF PATH)/ } !(on && /^ *[0-9]/)' "$1"
