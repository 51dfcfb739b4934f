# Compares displacements: those of CalculiX (NAME.dat of ccx, or displacements.dat with the deck -v name=NAME), then the listing;
# every stage, every node. A node differs where any component differs by more than TOLERANCE of its displacement. Prints the
# differences and a last line `checked N, largest difference D`.
function size(a, b, c) { return sqrt(a * a + b * b + c * c) }
FNR == 1 { file++ }
file == 1 && /displacements \(vx,vy,vz\)/ { stage++; next }
file == 1 && NF == 2 && $1 ~ /^[a-z]/ { stored = $1 == name; if (stored) components = $2; next }
file == 1 && stored { for (k = 1; k <= NF; k++) value[++values] = $k; next }
file == 1 && stage && NF == 4 && $1 + 0 == $1 { for (c = 1; c <= 3; c++) u[stage, $1, c] = $(c + 1); there[stage, $1] = 1; nodes++ }
file == 2 && /DISPLACEMENTS OF NODES/ { s++; on = 1; columns = 0; next }
file == 2 && /STRESSES|REACTIONS|BALANCE/ { on = 0 }
file == 2 && on && $1 == "NODE" { columns = (NF - 1) / 2; next }
file == 2 && on && columns && NF == 2 * columns + 1 && $1 + 0 == $1 {
   n++
   if (values >= n * components) { # of the deck, in the order of its nodes
      for (c = 1; c <= components; c++) u[s, $1, c] = value[(n - 1) * components + c]
      there[s, $1] = 1
   }
   if (!((s, $1) in there)) { print "stage " s ", node " $1 ": not there"; next }
   for (c = 1; c <= 3; c++) d[c] = (c <= columns ? $(1 + columns + c) : 0) - (c <= columns ? u[s, $1, c] : 0)
   l = size(u[s, $1, 1], u[s, $1, 2], columns > 2 ? u[s, $1, 3] : 0)
   e = size(d[1], d[2], d[3]); if (l > 0) e /= l
   if (e > worst) worst = e
   if (!(e <= tolerance)) { faults++; if (faults <= 5) print "stage " s ", node " $1 ": apart by " e }
}
END {
   if (values) nodes = values / components
   if (n != nodes || n == 0) print nodes + 0 " nodes of CalculiX, " n + 0 " of the listing"
   printf "checked %d, largest difference %.1e\n", n, worst
}
