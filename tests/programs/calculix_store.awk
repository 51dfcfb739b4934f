# Displacements as ccx prints them, as they are stored: the deck and its components, and under it the displacements alone, stage
# after stage, node after node, a line as long as it may be.    awk -v name=NAME -f calculix_store.awk NAME.bdf NAME.dat
/^CTETRA|^CPENTA|^CHEXA/ && FNR == NR { solid = 1 }
FNR == NR { next }
/displacements \(vx,vy,vz\)/ { stage++; next }
stage && NF == 4 && $1 + 0 == $1 { for (c = 2; c <= (solid ? 4 : 3); c++) add(sprintf("%.7g", $c)) }
function add(number) {
   if (length(line) + length(number) > 130) { text = text line "\n"; line = "" }
   line = line (line == "" ? "" : " ") number
}
END { print name, solid ? 3 : 2; printf "%s%s\n", text, line }
