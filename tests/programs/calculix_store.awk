# Stores displacements of ccx: the deck and its components, and on the next line the displacements, stage after stage, node after
# node.
#    awk -v name=NAME -f calculix_store.awk NAME.bdf NAME.dat
/^CTETRA|^CPENTA|^CHEXA/ && FNR == NR { solid = 1 }
FNR == NR { next }
/displacements \(vx,vy,vz\)/ { stage++; next }
stage && NF == 4 && $1 + 0 == $1 { for (c = 2; c <= (solid ? 4 : 3); c++) line = line (line == "" ? "" : " ") sprintf("%.7g", $c) }
END { print name, solid ? 3 : 2; print line }
