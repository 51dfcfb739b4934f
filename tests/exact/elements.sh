# The table of input/README.md, "Which elements to take": a column of 100 x 100 x 600 mm, clamped at its foot, with a transverse
# force on its top (elements.awk). Errors of the displacement of the top at equal numbers of nodes: 600 and 4,000. TABLE=yes in the
# environment adds 28,000 nodes (a minute) and prints the table.
#
# The exact displacement is the limit of CHEXA with twenty nodes, 3 to 10 elements along a side: the differences fall as n**-1.47
# and tend to 0.041575 mm, the last digit uncertain by one. (A beam with shear gives 0.0420 mm; a clamped foot cannot widen.)
exact=0.041575

# error KIND N NZ: of the movement along x of the corners of the top, in per cent
error() {
   awk -v kind="$1" -v n="$2" -v nz="$3" -f tests/exact/elements.awk > "$work/column.bdf"
   rm -f "$work/column.out"
   "$program" -q -o "$work" "$work/column.bdf" > /dev/null 2> "$work/said" || { cat "$work/said" >&2; return 1; }
   awk -v exact=$exact '/DISPLACEMENTS OF NODES/ { on = 1 } /STRESSES|REACTIONS/ { on = 0 } on && NF == 7 && $1 ~ /^[1-4]$/ { s += $5; n++ }
                        END { if (n != 4) exit 1; printf "%.2f", 100 * (s / 4 / exact - 1) }' "$work/column.out"
}

[ "${TABLE:-}" ] && printf '%s\n' '| elements | 600 nodes | 4,000 | 28,000 |' '|---|---|---|---|'
while read -r kind small middle large name; do
   row="| $name |"
   for size in $small $middle ${TABLE:+$large}; do
      if e=$(error "$kind" ${size/x/ }); then row="$row $e % |"; else fail "$kind $size"; fi
   done
   if [ "${TABLE:-}" ]; then echo "$row"
   elif grep -qF "$row" input/README.md; then passed=$((passed + 1))
   else fail "the manual does not have: $row"; fi
done <<'END'
CTETRA   4x24 8x48 16x96 CTETRA, 4 nodes
CPENTA_PLAIN 4x24 8x48 16x96 CPENTA, 6 nodes, PLAIN
CHEXA_PLAIN 4x24 8x48 16x96 CHEXA, 8 nodes, PLAIN
CPENTA   4x24 8x48 16x96 CPENTA, 6 nodes
CHEXA    4x24 8x48 16x96 CHEXA, 8 nodes
CTETRA10 2x12 4x24 8x48  CTETRA, 10 nodes
CPENTA15 2x18 4x36 8x72  CPENTA, 15 nodes
CHEXA20  2x20 5x30 10x60 CHEXA, 20 nodes
END
